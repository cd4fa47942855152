"""Read a program again and again: only what a change affects."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from irbkin._core import differing_names, read_module
from irbkin.rapid.program import FileFinding, ModuleFile, program_from

if TYPE_CHECKING:
    from irbkin.rapid import Module, Program

MOST_BYTES = 4_000_000
"""Size of a file that is read while one types: 30,000 moves, which are checked in a second."""
NAME = re.compile(r"[^\W\d]\w*")


@dataclass(eq=False)
class _Entry:
    """A file, as it was when it was read."""

    stamp: object
    """Changes with its content."""
    file: ModuleFile
    content: str | bytes = field(repr=False)
    alone: Module
    """Without the others."""
    module: Module | None = None
    """With the others; None to read it again."""

    @cached_property
    def names(self) -> set[str]:
        """All names in the text, in lower case."""
        return set(NAME.findall(self.alone.source.lower()))


class Reading:
    """The files of a program, read as often as they change."""

    def __init__(self, paths: Iterable[str]) -> None:
        self.paths = list(paths)
        self._entries: dict[str, _Entry] = {}

    def program(self, texts: Mapping[str, str]) -> Program:
        """Return the program.

        A module is read again if its text is another one, or if it has a name that other modules
        declare, assign or call in another way than before.

        Args:
            texts: Texts that take the place of files, by path.
        """
        names, findings = set[str](), list[FileFinding]()
        for path in self.paths:
            names |= self._read(path, texts.get(path), findings)
        entries = [self._entries[path] for path in self.paths if path in self._entries]
        for entry in entries:
            if entry.module is None or (names and not names.isdisjoint(entry.names)):
                context = [other.alone for other in entries if other is not entry]
                entry.module = read_module(entry.content, context) if context else entry.alone
        modules = [entry.module for entry in entries if entry.module is not None]
        return program_from([entry.file for entry in entries], modules, findings)

    def _read(self, path: str, text: str | None, findings: list[FileFinding]) -> set[str]:
        """Read a file if it is another one; return the names that differ to other modules."""
        old = self._entries.get(path)
        try:
            stamp: object = _stamp(path) if text is None else text
            if old and old.stamp == stamp:
                return set()
            content = _content(path) if text is None else text
        except OSError as error:
            # A file that was removed is no longer in the program.
            if not isinstance(error, FileNotFoundError):
                message = f"cannot be read: {error.strerror or error}"
                findings.append(FileFinding(path, 0, 0, "E002", message))
            self._entries.pop(path, None)
            return differing_names(old.alone, EMPTY) if old else set()
        alone = read_module(content)
        file = ModuleFile(path, content.encode() if isinstance(content, str) else content)
        self._entries[path] = _Entry(stamp, file, content, alone)
        return differing_names(old.alone if old else EMPTY, alone)


EMPTY = read_module("")


def is_large(content: Sequence[object]) -> bool:
    """Whether a text or a file is larger than what is read while one types."""
    return len(content) > MOST_BYTES


def _stamp(path: str) -> tuple[int, int]:
    of = os.stat(path)
    return of.st_mtime_ns, of.st_size


def _content(path: str) -> bytes:
    if os.path.getsize(path) > MOST_BYTES:
        raise OSError(f"is larger than {MOST_BYTES / 1e6:g} MB: irbkin check reads it")
    with open(path, "rb") as file:
        return file.read()
