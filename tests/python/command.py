"""The command `irbkin`, called in this process with streams of its own."""

import csv
import io
import os
import signal
import sys
from types import SimpleNamespace
from unittest import mock

import irbkin
import numpy as np
from irbkin.cli import main

NAME = "IRB 2600-12/1.65"
ROBOT = irbkin.Robot(NAME)
COMMAND = [sys.executable, "-m", "irbkin"]
JOINTS = np.degrees(np.random.default_rng(5).uniform(*(0.6 * ROBOT.limits.T), (40, 6)).round(6))
XYZ = ["--xyz", "850", "320", "640", "--wxyz", "0.2588190", "0", "0.9659258", "0"]


def run(*arguments, stdin=b"", **environment):
    """The command to its end: its exit code and what it wrote. No traceback."""
    content = stdin.encode() if isinstance(stdin, str) else stdin
    streams = {
        "stdin": io.TextIOWrapper(io.BufferedReader(io.BytesIO(content))),
        "stdout": io.TextIOWrapper(io.BytesIO(), write_through=False),
        "stderr": io.TextIOWrapper(io.BytesIO(), write_through=True),
    }
    terminated = signal.getsignal(signal.SIGTERM)
    try:
        with mock.patch.multiple(sys, **streams), mock.patch.dict(os.environ, environment):
            code = main([*map(str, arguments)])
            streams["stdout"].flush()
    except SystemExit as end:
        # Of --help.
        streams["stdout"].flush()
        code = end.code
    finally:
        signal.signal(signal.SIGTERM, terminated)
    stdout, stderr = (streams[name].buffer.getvalue() for name in ("stdout", "stderr"))
    assert b"Traceback" not in stderr
    assert b"internal error" not in stderr
    return SimpleNamespace(returncode=code, stdout=stdout, stderr=stderr)


def refused(*arguments, **options):
    """The message of a refusal."""
    done = run(*arguments, **options)
    assert done.returncode == 2, done
    message = done.stderr.decode()
    assert message.startswith("irbkin: ")
    assert message.count("\n") == 1
    return message


def rows(done):
    """The columns of CSV by their names: numbers where all are numbers."""
    assert done.returncode == 0, done.stderr
    names, *records = csv.reader(io.StringIO(done.stdout.decode()))
    columns = {}
    for name, values in zip(names, zip(*records, strict=True), strict=True):
        try:
            columns[name] = np.array([float(it or "nan") for it in values])
        except ValueError:
            columns[name] = np.array(values)
    return columns


def joints_of(table):
    return np.column_stack([table[f"q{number}_deg"] for number in range(1, 7)])
