"""A check that is made again whenever one of its files changes."""

import os
import re
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NoReturn

from irbkin.abb.folders import archive_of
from irbkin.check.report import counted
from irbkin.cli.errors import CommandError, complain
from irbkin.errors import IrbkinError

EVERY = 0.3
"""Time between two looks at the files [s]."""
SHARE = 20.0
"""A look that takes long is made after this many times its duration."""
MOST_FILES = 20_000
NAMING = (".toml", ".urdf", ".xml", ".pgf")
"""Endings of options, cells, robots and lists of modules."""
NAMED = re.compile(rb"""["'>]\s*([^"'<>\0\n]+?)\s*["'<]""")


def repeated(run: Callable[[], int], names: Sequence[str], output: str | None) -> NoReturn:
    """Run something, and again whenever files or files in folders change, until Ctrl-C. An error
    ends the command the first time; later ones are printed.
    """
    seen = last = None
    while True:
        began = time.monotonic()
        now = _stamps(names, os.path.realpath(output) if output else "")
        took = time.monotonic() - began
        # A change counts when it is over: files are not read half written.
        if now != seen and (seen is None or now == last):
            if sys.stdout.isatty():
                from rich.console import Console

                Console().clear()
            try:
                run()
            except (CommandError, IrbkinError, OSError) as error:
                if seen is None or isinstance(error, BrokenPipeError):
                    raise
                complain(error)
            seen = now
            sys.stdout.flush()
            complain(f"watching {counted(len(now), 'file')}, Ctrl-C ends")
        last = now
        time.sleep(max(EVERY, SHARE * took))


def _stamps(names: Iterable[str], output: str) -> dict[str, tuple[int, int, int]]:
    """Return what changes with the content of files, and of files that they name, by paths."""
    found: dict[str, tuple[int, int, int]] = {}
    left = [os.path.realpath(archive_of(Path(name)) or name) for name in names]
    while left:
        path = left.pop()
        try:
            of = os.stat(path)
            if os.path.isdir(path):
                # Neither hidden folders nor those behind links.
                inside = (it for it in os.scandir(path) if not (it.is_dir() and it.is_symlink()))
                left += (it.path for it in inside if it.name[0] != "." or it.is_file())
            elif path not in found and path != output:
                found[path] = (of.st_mtime_ns, of.st_size, of.st_ino)
                is_naming = path.lower().endswith(NAMING) and os.path.isfile(path)
                left += _named(path) if is_naming else ()
        except OSError:
            continue
        if len(found) > MOST_FILES:
            raise CommandError(f"--watch: there are more than {MOST_FILES} files, give fewer")
    return found


def _named(path: str) -> Iterator[str]:
    folder = os.path.dirname(path)
    for match in NAMED.finditer(Path(path).read_bytes()):
        own = os.path.join(folder, os.fsdecode(match[1]).replace("\\", "/"))
        if os.path.isfile(own):
            yield os.path.realpath(own)
