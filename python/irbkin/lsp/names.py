"""Where the names of a program are declared."""

from __future__ import annotations

import re
from bisect import bisect
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from irbkin.lsp.text import Text
    from irbkin.rapid import Module, Program

UNREAD = re.compile(r"(?:(LOCAL|TASK)\s+)?(CONST|PERS|VAR)\s+(\w+)\s+(\w+)", re.IGNORECASE)
"""A declaration of a type that is not read."""
RECORD = re.compile(r"(LOCAL\s+)?(RECORD|ALIAS)\s+(?:\w+\s+(?=\w+\s*;))?(\w+)", re.IGNORECASE)
PARAMETER = "parameter"
ROUTINES = ("PROC", "FUNC", "TRAP")
END = re.compile(r"^[ \t]*END(?:PROC|FUNC|TRAP)\b[^\n]*", re.IGNORECASE | re.MULTILINE)


@dataclass(frozen=True)
class Declared:
    """A declaration."""

    module: int
    name: str
    kind: str
    """RAPID's word: a type of data, PROC, FUNC, TRAP, RECORD, ALIAS or parameter."""
    words: str
    """The declaration without its value."""
    routine: str | None
    """The routine that it is in."""
    is_local: bool
    line: int
    column: int
    value: Any = None

    def span(self, text: Text) -> tuple[int, int]:
        """Return the offsets of its name in the text of its module."""
        begin = text.at(self.line, self.column)
        if self.kind == PARAMETER:
            begin = max(begin, text.source.find("(", begin))
        name = re.compile(rf"\b{re.escape(self.name)}\b", re.IGNORECASE)
        match = name.search(text.source, begin)
        return match.span() if match else (begin, begin + 1)


class Names:
    """The declarations of a program."""

    def __init__(self, program: Program) -> None:
        self.program = program

    @cached_property
    def of_modules(self) -> list[list[Declared]]:
        """All declarations of each module, in the order of the text."""
        return [declarations(it, index) for index, it in enumerate(self.program.modules)]

    @cached_property
    def _own(self) -> list[dict[tuple[str, str], Declared]]:
        """The declarations of each module by their routines and names in lower case."""
        tables = []
        for declared in self.of_modules:
            table: dict[tuple[str, str], Declared] = {}
            for it in declared:
                table.setdefault(((it.routine or "").lower(), it.name.lower()), it)
            tables.append(table)
        return tables

    @cached_property
    def _shared(self) -> dict[str, Declared]:
        """The first declaration of each name that all modules see."""
        shared: dict[str, Declared] = {}
        for declared in self.of_modules:
            for it in declared:
                if it.routine is None and not it.is_local:
                    shared.setdefault(it.name.lower(), it)
        return shared

    def routine_at(self, module: int, line: int) -> str | None:
        """Return the routine that a line of a module is in."""
        routines = self.program.modules[module].routines
        place = bisect([it.line for it in routines], line)
        return routines[place - 1].name if place else None

    def find(self, module: int, routine: str | None, name: str) -> Declared | None:
        """Return the declaration that a name refers to in a routine of a module."""
        own, lower = self._own[module], name.lower()
        inner = own.get((routine.lower(), lower)) if routine else None
        return inner or self._parameter(module, routine, name) or self.outer(module, lower)

    def outer(self, module: int, lower: str) -> Declared | None:
        """Return the declaration that a name in lower case refers to outside routines."""
        return self._own[module].get(("", lower)) or self._shared.get(lower)

    def _parameter(self, module: int, routine: str | None, name: str) -> Declared | None:
        """The parameter of a routine."""
        own = self._own[module].get(("", (routine or "").lower()))
        if own is None or own.kind not in ROUTINES:
            return None
        inside = own.words.partition("(")[2]
        if not re.search(rf"\w\s+{re.escape(name)}\s*(?:[,){{|]|$)", inside, re.IGNORECASE):
            return None
        place = (own.name, True, own.line, own.column)
        return Declared(module, name, PARAMETER, own.words, *place)


def declarations(module: Module, index: int) -> list[Declared]:
    """Return the declarations of a module, in the order of the text."""
    found = []
    for it in module.declarations:
        words = " ".join(filter(None, (it.scope, it.storage, it.data_type, it.name)))
        place = (it.routine, it.scope == "LOCAL", it.line, it.column)
        found.append(Declared(index, it.name, it.data_type, words, *place, it.value))
    for of in module.routines:
        words = " ".join(of.header.split())
        is_local = words[:6].upper() == "LOCAL "
        found.append(Declared(index, of.name, of.kind, words, None, is_local, of.line, of.column))
    for part in module.skipped:
        if match := UNREAD.match(part.text):
            name, kind, scope = match[4], match[3], match[1]
        elif match := RECORD.match(part.text):
            name, kind, scope = match[3], match[2].upper(), match[1]
        else:
            continue
        is_local = (scope or "").strip().upper() == "LOCAL"
        place = (part.routine, is_local, part.line, part.column)
        found.append(Declared(index, name, kind, " ".join(match[0].split()), *place))
    return sorted(found, key=lambda it: (it.line, it.column))


def end_of(text: Text, begin: int) -> int:
    """Return the offset at which the routine that begins at another one ends."""
    match = END.search(text.source, begin)
    return match.end() if match else len(text.source.rstrip())
