"""A check that is made again whenever one of its files changes."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from typing import NoReturn

from irbkin.cli.errors import CommandError, complain
from irbkin.errors import IrbkinError

EVERY = 0.3
"""Time between two looks at the files [s]."""
SHARE = 20.0
"""A look that takes long is made after this many times its duration."""
MOST_FILES = 20_000
CLEAR = "\x1b[H\x1b[2J"


def repeated(run: Callable[[], int], names: Iterable[str], output: str | None) -> NoReturn:
    """Run something, and again whenever files or files in folders change, until Ctrl-C.

    Args:
        run: What ends the first time by an error ends the command; later errors are printed.
        names: Files and folders.
        output: A file that it writes, which is not looked at.
    """
    names, seen = list(names), None
    while True:
        began = time.monotonic()
        now = _stamps(names, os.path.realpath(output) if output else "")
        took = time.monotonic() - began
        if now != seen:
            if sys.stdout.isatty():
                print(CLEAR, end="")
            try:
                run()
            except (CommandError, IrbkinError, OSError) as error:
                if seen is None or isinstance(error, BrokenPipeError):
                    raise
                complain(error)
            seen = now
            sys.stdout.flush()
            complain(f"watching {len(now)} {'file' if len(now) == 1 else 'files'}, Ctrl-C ends")
        time.sleep(max(EVERY, SHARE * took))


def _stamps(names: Iterable[str], output: str) -> dict[str, tuple[int, int, int]]:
    """Return what changes with the content of files, by their paths."""
    found = {}
    for path in _files(names):
        try:
            of = os.stat(path)
        except OSError:
            continue
        if path != output:
            found[path] = (of.st_mtime_ns, of.st_size, of.st_ino)
        if len(found) > MOST_FILES:
            raise CommandError(f"--watch: there are more than {MOST_FILES} files, give fewer")
    return found


def _files(names: Iterable[str]) -> Iterator[str]:
    for name in names:
        path = os.path.realpath(name)
        # A path in an archive, or a file that an editor is about to write.
        while not os.path.exists(path):
            path = os.path.dirname(path)
        if not os.path.isdir(path):
            yield path
        for folder, inside, files in os.walk(path):
            inside[:] = (own for own in inside if not own.startswith("."))
            yield from (os.path.join(folder, own) for own in files)
