"""Other libraries' readers in a process of their own, bounded in time and memory: what a hostile or
broken file makes them do ends there.
"""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from irbkin._files import read
from irbkin._words import visible
from irbkin.errors import InvalidModelError, IrbkinError

MOST_SECONDS = 1.0
"""CPU time of a reader: of 257 public files the slowest needs 0.4 s, with its start."""
MOST_MEMORY = 150 * 2**20
"""Bytes of a reader beside its library; bounded where there is a /proc, as on Linux."""
MOST_WAIT = 60.0
"""Wall time [s], for systems without a timer of CPU time (Windows)."""


@contextmanager
def source(path: str | os.PathLike[str]) -> Iterator[tuple[str, str | None]]:
    """The text of a file and its absolute path; a text that begins with "<" is given as it is. An
    error names the file.
    """
    text = os.fsdecode(path)
    file: str | None = None
    where = "the text"
    if not text.lstrip().startswith("<"):
        where = text
        file = os.path.abspath(text)
        text = read(text).decode("utf-8-sig", "replace")
    try:
        yield text, file
    except IrbkinError as error:
        words = visible(str(error)).removeprefix("URDF: ")
        raise InvalidModelError(words if words.startswith(where) else f"{where}: {words}") from None


def call(package: str, function: str, *arguments: Any) -> Any:
    """Call a function by its module and name, when a package that it needs has been imported.

    Arguments and result are of JSON.

    Raises:
        InvalidModelError: It failed or exceeded a bound.
    """
    if getattr(sys, "frozen", False) or not sys.executable:
        raise InvalidModelError(f"{package} runs in a Python of its own, and there is none")
    # -c puts the working folder into the path, which may be that of a stranger's file.
    code = f"import sys; sys.path[:] = {sys.path!r}; import irbkin._bounded as it; it.answer()"
    try:
        run = subprocess.run(
            [sys.executable, "-X", "utf8", "-c", code],
            input=json.dumps([package, function, arguments]).encode(),
            capture_output=True,
            timeout=MOST_WAIT,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )
    except subprocess.TimeoutExpired:
        raise InvalidModelError(f"takes more than {MOST_WAIT:g} s to read") from None
    if run.returncode and run.returncode == -getattr(signal, "SIGPROF", 0):
        raise InvalidModelError(f"takes more than {MOST_SECONDS:g} s to read")
    if run.returncode or not run.stdout:
        last = run.stderr.decode(errors="replace").strip().rpartition("\n")[2]
        raise InvalidModelError(f"{package} ended with code {run.returncode}: {last}")
    result, fault = json.loads(run.stdout)
    if fault is not None:
        raise InvalidModelError(fault)
    return result


def answer() -> None:
    """Call the function that stdin names; write its result or its error to stdout."""
    # What a library prints is not the answer.
    stdout = os.dup(1)
    os.dup2(2, 1)
    package, function, arguments = json.load(sys.stdin)
    module, _, name = function.rpartition(".")
    called = getattr(import_module(module), name)
    import_module(package)
    _bound()
    result = fault = None
    try:
        result = called(*arguments)
    except RecursionError:
        fault = "is nested too deeply, or calls itself without end"
    except MemoryError:
        fault = f"needs more than {MOST_MEMORY >> 20} MB to read"
    # A library raises whatever a broken file makes it raise.
    except Exception as error:
        fault = "; ".join(str(error).split("\n")).strip("; ") or type(error).__name__
    with open(stdout, "w") as file:
        json.dump([result, fault], file)


def _bound() -> None:
    """Bound what this process needs from here on."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS)
    if os.path.exists("/proc/self/statm"):
        import resource

        with open("/proc/self/statm") as file:
            data = int(file.read().split()[5]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_DATA, (data + MOST_MEMORY,) * 2)
