"""The declarations of the names of a program, and RAPID's own names."""

import re
from bisect import bisect
from collections import ChainMap
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, NamedTuple

from irbkin._core import instructions
from irbkin.lsp.text import Text
from irbkin.rapid import Module, Program

UNREAD = re.compile(r"(?:(LOCAL|TASK)\s+)?(CONST|PERS|VAR)\s+(\w+)\s+(\w+)", re.IGNORECASE)
"""A declaration of data whose type is not parsed."""
RECORD = re.compile(r"(LOCAL\s+)?(RECORD|ALIAS)\s+(?:\w+\s+(?=\w+\s*;))?(\w+)", re.IGNORECASE)
PARAMETER = "parameter"
ROUTINES = ("PROC", "FUNC", "TRAP")
HEADER = re.compile(
    r"(\\|\|\s*\\?)?\s*((?:(?:INOUT|VAR|PERS|REF)\s+)?\b(\w+)\s+(\w+))", re.IGNORECASE
)
NOWHERE = -1
"""The module that RAPID's own names are in."""
RETURNED = {
    "bool": "Present",
    "jointtarget": "CalcJointT CJointT",
    "num": "Abs ClkRead Distance EulerZYX",
    "orient": "OrientZYX",
    "pos": "CPos",
    "pose": "PoseInv PoseMult",
    "robtarget": "CalcRobT CRobT Offs RelTool",
    "string": "NumToStr ValToStr",
}
"""Functions by the types of their values; others are offered where any type fits."""
PERSISTENT = re.compile(r"\b(tooldata|wobjdata|loaddata)\b")
"""Types of data that moves take by reference."""
DATA = {
    "speeddata": "v5 v10 v20 v30 v40 v50 v60 v80 v100 v150 v200 v300 v400 v500 v600 v800 v1000 "
    "v1500 v2000 v2500 v3000 v4000 v5000 v6000 v7000 vmax",
    "zonedata": "fine z0 z1 z5 z10 z15 z20 z30 z40 z50 z60 z80 z100 z150 z200",
    "tooldata": "tool0",
    "wobjdata": "wobj0",
    "loaddata": "load0",
    "bool": "TRUE FALSE",
    "type": "num bool string pos orient pose robtarget jointtarget tooldata wobjdata speeddata "
    "zonedata loaddata confdata extjoint robjoint dnum byte clock intnum errnum triggdata",
    "keyword": "IF FOR WHILE TEST RETURN GOTO CONNECT RAISE RETRY TRYNEXT EXIT VAR CONST PERS",
}


class Parameter(NamedTuple):
    name: str
    kind: str
    is_optional: bool
    begin: int
    end: int
    """Offsets in the header."""


def parameters(header: str) -> list[Parameter]:
    found = HEADER.finditer(header, header.find("(") + 1 or len(header))
    return [Parameter(it[4], it[3].lower(), bool(it[1]), *it.span(2)) for it in found]


@dataclass(frozen=True)
class Declared:
    module: int
    name: str
    kind: str
    """RAPID's word: a type of data, PROC, FUNC, TRAP, RECORD, ALIAS or parameter."""
    words: str
    """The declaration without its value."""
    routine: str | None
    is_local: bool
    line: int
    column: int
    value: Any = None

    @property
    def type(self) -> str:
        """The type of its value, in lower case."""
        if self.kind == PARAMETER:
            return next(it.kind for it in parameters(self.words) if it.name == self.name)
        kind = self.words.upper().partition("FUNC ")[2] if self.kind == "FUNC" else self.kind
        return kind.split()[0].lower()

    @property
    def is_constant(self) -> bool:
        return "CONST" in self.words.upper().split()[:2]

    def span(self, text: Text) -> tuple[int, int]:
        begin = text.at(self.line, self.column)
        if self.kind == PARAMETER:
            begin = max(begin, text.source.find("(", begin))
        name = re.compile(rf"\b{re.escape(self.name)}\b", re.IGNORECASE)
        match = name.search(text.source, begin)
        return match.span() if match else (begin, begin + 1)


class Names:
    def __init__(self, program: Program, known: dict[int, tuple[Module, list[Declared]]]) -> None:
        self.program, self._known = program, known
        """The declarations of modules that are perhaps the same as before."""

    @cached_property
    def of_modules(self) -> list[list[Declared]]:
        for at, module in enumerate(self.program.modules):
            if at not in self._known or self._known[at][0] is not module:
                self._known[at] = (module, declarations(module, at))
        return [self._known[at][1] for at in range(len(self.program.modules))]

    @cached_property
    def _own(self) -> list[dict[str, dict[str, Declared]]]:
        """The declarations of each module by their routines, then by names, in lower case."""
        found = []
        for declared in self.of_modules:
            own: dict[str, dict[str, Declared]] = {}
            # The first of several declarations takes precedence.
            for it in reversed(declared):
                own.setdefault((it.routine or "").lower(), {})[it.name.lower()] = it
            found.append(own)
        return found

    @cached_property
    def shared(self) -> dict[str, Declared]:
        """The first declaration of each name that all modules see."""
        return {
            it.name.lower(): it
            for declared in reversed(self.of_modules)
            for it in reversed(declared)
            if it.routine is None and not it.is_local
        }

    @cached_property
    def _routines(self) -> list[list[tuple[int, str]]]:
        return [[(it.line, it.name) for it in of.routines] for of in self.program.modules]

    def routine_at(self, module: int, line: int) -> str | None:
        routines = self._routines[module]
        place = bisect(routines, line, key=lambda routine: routine[0])
        return routines[place - 1][1] if place else None

    def visible(self, module: int, routine: str | None) -> Mapping[str, Declared]:
        """Return what a routine of a module sees, by names in lower case."""
        own, name = self._own[module], (routine or "").lower()
        inner, outer = own.get(name, {}), own.get("", {})
        return ChainMap(inner, self.parameters(outer.get(name)), outer, self.shared)

    def find(self, module: int, routine: str | None, name: str) -> Declared | None:
        return self.visible(module, routine).get(name.lower())

    def parameters(self, of: Declared | None) -> dict[str, Declared]:
        """Return the parameters of a routine, by names in lower case."""
        if of is None or of.kind not in ROUTINES:
            return {}
        place, names = (of.name, True, of.line, of.column), [it.name for it in parameters(of.words)]
        return {it.lower(): Declared(of.module, it, PARAMETER, of.words, *place) for it in names}


def declarations(module: Module, index: int) -> list[Declared]:
    found = []
    for data in module.declarations:
        words = " ".join(filter(None, (data.scope, data.storage, data.data_type, data.name)))
        place = (data.routine, data.scope == "LOCAL", data.line, data.column)
        found.append(Declared(index, data.name, data.data_type, words, *place, data.value))
    for of in module.routines:
        words = " ".join(of.header.split())
        is_local = words[:6].upper() == "LOCAL "
        found.append(Declared(index, of.name, of.kind, words, None, is_local, of.line, of.column))
    for part in module.skipped:
        if (one := unread(part.text)) is not None:
            name, kind, words, is_local = one
            place = (part.routine, is_local, part.line, part.column)
            found.append(Declared(index, name, kind, words, *place))
    return sorted(found, key=lambda declared: (declared.line, declared.column))


def unread(statement: str) -> tuple[str, str, str, bool] | None:
    """Return name, kind, words and whether LOCAL of a declaration that is not read, else None."""
    if match := UNREAD.match(statement):
        name, kind = match[4], match[3]
    elif match := RECORD.match(statement):
        name, kind = match[3], match[2].upper()
    else:
        return None
    return name, kind, " ".join(match[0].split()), (match[1] or "").strip().upper() == "LOCAL"


@cache
def known() -> Mapping[str, Declared]:
    """Return RAPID's own instructions, functions, data, types and words, by names in lower case."""
    found = {}
    types = {name: kind for kind, names in RETURNED.items() for name in names.split()}
    for name, kind, arguments in instructions():
        begin = "PROC" if kind == "instruction" else f"FUNC {types.get(name, 'anytype')}"
        written = PERSISTENT.sub(r"PERS \1", arguments).replace(",", ", ").replace("|", " | ")
        header = f"{begin} {name}({written})"
        found[name.lower()] = Declared(NOWHERE, name, begin[:4], header, None, False, 0, 0)
    for kind, names in DATA.items():
        for name in names.split():
            words = "" if kind in ("type", "keyword") else f"CONST {kind} {name}"
            found[name.lower()] = Declared(NOWHERE, name, kind, words, None, False, 0, 0)
    return found
