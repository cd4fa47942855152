"""Other libraries' readers in a process of their own, with bounds of time and memory: a hostile or
broken file may make them run on, fill the memory, or crash.
"""

import json
import os
import signal
import subprocess
import sys
from importlib import import_module
from typing import Any

from irbkin.errors import InvalidModelError

MOST_SECONDS = 1.0
"""CPU time of a reader: the slowest public file needs 0.3 s."""
MOST_MEMORY = 150 * 2**20
"""Bytes of a reader, beyond its library's own; bounded where there is /proc, as in Linux."""
MOST_WAIT = 60.0
"""Wall time [s]: of a loaded machine, and the bound of systems without timers (Windows)."""


def call(package: str, function: str, *arguments: Any) -> Any:
    """Call a function of a module of irbkin that uses a package; all must be of JSON.

    Raises:
        InvalidModelError: It failed, or exceeded a bound.
    """
    # The path first: "-c" puts the working folder there, which may be a stranger's.
    code = f"import sys; sys.path[:] = {sys.path!r}; import irbkin._bounded as it; it.answer()"
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    try:
        run = subprocess.run(
            [sys.executable, "-X", "utf8", "-c", code],
            input=json.dumps([package, function, arguments]).encode(),
            capture_output=True,
            timeout=MOST_WAIT,
            env=environment,
        )
    except subprocess.TimeoutExpired:
        raise InvalidModelError(f"takes more than {MOST_WAIT:g} s to read") from None
    if run.returncode == -getattr(signal, "SIGPROF", 0) != 0:
        raise InvalidModelError(f"takes more than {MOST_SECONDS:g} s to read")
    if run.returncode or not run.stdout:
        last = run.stderr.decode(errors="replace").strip().rpartition("\n")[2]
        raise InvalidModelError(f"{package} ended with code {run.returncode}: {last}")
    result, fault = json.loads(run.stdout)
    if fault is not None:
        raise InvalidModelError(fault)
    return result


def answer() -> None:
    """Call what stdin names, and write result and error to stdout."""
    # What the library prints is no answer.
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
        fault = " ".join(str(error).split()) or type(error).__name__
    with open(stdout, "w") as file:
        json.dump([result, fault], file)


def _bound() -> None:
    """Bound this process from here on."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS)
    if os.path.exists("/proc/self/statm"):
        import resource

        with open("/proc/self/statm") as file:
            data = int(file.read().split()[5]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_DATA, (data + MOST_MEMORY,) * 2)
