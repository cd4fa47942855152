"""Exit codes, and what ends the command: one line on stderr, never a traceback."""

import contextlib
import os
import signal
import sys
from collections.abc import Callable

from irbkin._words import visible
from irbkin.errors import IrbkinError, UnreachableError

FINE = 0
FOUND = 1
"""Something is wrong with what was checked, or cannot be reached."""
WRONG = 2
"""Wrong usage, or input that is broken."""
INTERRUPTED = 128 + signal.SIGINT
CLOSED_PIPE = 141
"""The exit code of a program that writes into a closed pipe."""

OWN_WORDS = {
    " (is the pose in millimeters? meters are wanted)": (
        " (arguments and CSV are in millimeters, .npy files in meters)"
    ),
    "catalog() lists all, from_urdf and from_mdh take other arms": (
        "irbkin catalog lists all; another arm is given by a .urdf file"
    ),
    "pass name= to choose one:": "give FILE:NAME to choose one:",
    "pass coupled_limits=False to leave such limits out, and check them yourself": (
        "Robot.from_robotstudio(FILE, coupled_limits=False).to_urdf() leaves such limits out"
    ),
    " (did you pass degrees? otherwise remove whole turns)": " (remove whole turns)",
    "base must name the one to begin at": "--base-link must name the one to begin at",
    "tip must name the one to take": "--tip must name the one to take",
    'pass base="': 'give --base-link "',
    'pass tip="': 'give --tip "',
    ' and tip="': ' --tip "',
    ' or base="': ' or --base-link "',
    ' or tip="': ' or --tip "',
    "is step in m, or speed in m/s and dt in s?": "take a larger --step",
}
"""Words of the library in its units and calls, and the command's in their place."""


class CommandError(Exception):
    """An end of the command, with its exit code."""

    def __init__(self, message: str, code: int = WRONG) -> None:
        super().__init__(message)
        self.code = code


def complain(message: object) -> None:
    if isinstance(message, OSError) and message.filename:
        message = f"{message.filename}: {message.strerror}"
    line = " ".join(str(message).split())
    for words, own in OWN_WORDS.items():
        line = line.replace(words, own)
    print(f"irbkin: {visible(line)}", file=sys.stderr)


def guarded(run: Callable[[], int]) -> int:
    """Run the command and make an exit code of whatever ends it."""
    if hasattr(signal, "SIGTERM"):
        # Files that are being written are removed on the way out.
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    try:
        if sys.stdout is None:
            raise CommandError("stdout is closed")
        try:
            return run()
        finally:
            # Rows that were written come before the message.
            sys.stdout.flush()
    except BrokenPipeError:
        _give_up()
        return CLOSED_PIPE
    except KeyboardInterrupt:
        complain("interrupted")
        return INTERRUPTED
    except (CommandError, UnreachableError, IrbkinError, ImportError, OSError) as error:
        complain(error)
        if isinstance(error, OSError):
            _give_up()
        return getattr(error, "code", FOUND if isinstance(error, UnreachableError) else WRONG)
    except MemoryError:
        complain("not enough memory: give the rows in parts, or as a stream")
        return WRONG
    except Exception as error:
        if os.environ.get("IRBKIN_TRACEBACK"):
            raise
        words = f"internal error, please report it ({type(error).__name__}: {error})"
        complain(f"{words}; IRBKIN_TRACEBACK=1 shows where")
        return WRONG


def _give_up() -> None:
    """Write no more to a stdout that nobody reads: Python would flush it at its end."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, sys.stdout.fileno())
        os.close(null)
