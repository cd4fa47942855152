"""The command `irbkin` in processes of its own."""

import csv
import io
import subprocess
import sys

import irbkin
import numpy as np

NAME = "IRB 2600-12/1.65"
ROBOT = irbkin.Robot(NAME)
COMMAND = [sys.executable, "-m", "irbkin"]
JOINTS = np.degrees(np.random.default_rng(5).uniform(*(0.6 * ROBOT.limits.T), (40, 6)).round(6))
XYZ = ["--xyz", "850", "320", "640", "--wxyz", "0.2588190", "0", "0.9659258", "0"]


def run(*arguments, stdin=None, **options):
    """The command to its end: one line on stderr at most, and no traceback."""
    content = stdin.encode() if isinstance(stdin, str) else stdin
    done = subprocess.run(
        [*COMMAND, *map(str, arguments)], input=content, capture_output=True, timeout=60, **options
    )
    assert b"Traceback" not in done.stderr
    return done


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
