"""Incremental reading of a program: only modules that a change affects."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from irbkin._core import differing_names, read_module
from irbkin._files import read
from irbkin.lsp.names import unread
from irbkin.lsp.text import NAME, Text
from irbkin.rapid import Module, Program
from irbkin.rapid.program import FileFinding, ModuleFile, program_from

MOST_BYTES = 4_000_000
"""Largest file that is read while editing: 30,000 moves, which are checked in a second."""
BLANKS = {byte: " " for byte in range(128) if not f"a{chr(byte)}".isidentifier()}
"""Characters that are in no name, as blanks."""


@dataclass(eq=False)
class _Entry:
    """A file at the time of its last reading."""

    stamp: object
    """Differs if the content may differ."""
    file: ModuleFile
    content: str | bytes = field(repr=False)
    alone: Module
    """Read without the other modules."""
    names: frozenset[str]
    shared: frozenset[str]
    """Those that it declares for other modules, and its own."""
    module: Module | None = None
    """Read with the other modules; None if that is pending."""


class Reading:
    """The files of a program, each read again when it changes."""

    def __init__(self, paths: Iterable[str]) -> None:
        self.paths = list(paths)
        self.groups: Sequence[Sequence[int]] = ()
        """The modules of the last program, in groups that have no name in common: what one of them
        does is the same without the other groups.
        """
        self._linked: Sequence[frozenset[str]] = ()
        self._entries: dict[str, _Entry] = {}

    def program(self, texts: Mapping[str, Text]) -> Program:
        """The program, with texts of open documents in place of their files.

        A module is read again if its text has changed, or if it contains a name whose declaration,
        assignments or calls in other modules have changed.
        """
        names, findings = set[str](), list[FileFinding]()
        for path in self.paths:
            names |= self._read(path, texts.get(path), findings)
        entries = [self._entries[path] for path in self.paths if path in self._entries]
        linked = [own for entry in entries for own in (entry.names, entry.shared)]
        if [*map(id, linked)] != [*map(id, self._linked)]:
            self._linked, self.groups = linked, _groups(entries)
        for group in self.groups:
            for index in group:
                entry = entries[index]
                if entry.module is None or (names and not names.isdisjoint(entry.names)):
                    context = [entries[other].alone for other in group if other != index]
                    entry.module = read_module(entry.content, context) if context else entry.alone
        modules = [entry.module for entry in entries if entry.module is not None]
        return program_from([entry.file for entry in entries], modules, findings)

    def _read(self, path: str, text: Text | None, findings: list[FileFinding]) -> set[str]:
        """Read a file if it has changed; return the names that differ for other modules."""
        old = self._entries.get(path)
        try:
            stamp: object = _stamp(path) if text is None else text.source
            if old and old.stamp == stamp:
                return set()
            content = _content(path) if text is None else text.source
        except OSError as error:
            # A removed file leaves the program without a finding.
            if not isinstance(error, FileNotFoundError):
                message = f"cannot be read: {error.strerror or error}"
                findings.append(FileFinding(path, 0, 0, "E002", message))
            self._entries.pop(path, None)
            return differing_names(old.alone, EMPTY) if old else set()
        file = ModuleFile(path, content.encode() if isinstance(content, str) else content)
        alone = read_module(content)
        differing = differing_names(old.alone if old else EMPTY, alone)
        names = shared = NONE
        if len(self.paths) > 1:
            names, shared = _names(alone.source), _shared(alone)
        if old is not None:
            # Equal names are the same object: groups are formed anew only if something differs.
            names = old.names if names == old.names else names
            shared = old.shared if shared == old.shared else shared
        self._entries[path] = _Entry(stamp, file, content, alone, names, shared)
        return differing


EMPTY = read_module("")
NONE: frozenset[str] = frozenset()


def _groups(entries: Sequence[_Entry]) -> list[list[int]]:
    """The indices of modules that are linked by names, in groups."""
    group = list(range(len(entries)))

    def first(index: int) -> int:
        while group[index] != index:
            group[index] = index = group[group[index]]
        return index

    owners: dict[str, int] = {}
    for index, entry in enumerate(entries):
        for name in entry.shared:
            group[first(owners.setdefault(name, index))] = first(index)
    for index, entry in enumerate(entries):
        for name in owners.keys() & entry.names:
            group[first(owners[name])] = first(index)
    found: dict[int, list[int]] = {}
    for index in range(len(entries)):
        found.setdefault(first(index), []).append(index)
    return list(found.values())


def _names(source: str) -> frozenset[str]:
    lower = source.lower()
    parts = lower.translate(BLANKS).split() if lower.isascii() else NAME.findall(lower)
    # Digits in front of a name are no part of it.
    return frozenset(name for part in set(parts) if (name := part.lstrip("0123456789")))


def _shared(module: Module) -> frozenset[str]:
    """The names that a module declares for others, in lower case, and its own."""
    own = {it.name.lower() for it in module.declarations if it.scope == "LOCAL"}
    others = [found[0] for part in module.skipped if (found := unread(part.text)) and not found[3]]
    names = (*module.keys(), *(it.name for it in module.routines), *others, module.name or "")
    return frozenset(map(str.lower, names)) - own


def _stamp(path: str) -> tuple[int, int, int]:
    of = os.stat(path)
    return of.st_mtime_ns, of.st_ctime_ns, of.st_size


def _content(path: str) -> bytes:
    if os.path.getsize(path) > MOST_BYTES:
        raise OSError(f"is larger than {MOST_BYTES / 1e6:g} MB: irbkin check reads it")
    return read(path)
