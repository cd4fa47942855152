"""One of two programs that are compared: its data, and its moves as they are written."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from irbkin import Robot
from irbkin.abb.backup import UnitRow
from irbkin.rapid import CheckedMove, Program

UNMET = ("R101", "R102")
"""Codes of targets that are not reached."""
WORD = re.compile(r"[^\W\d]\w*")

Place = tuple[int, int, int]
"""Module, line and column."""
Key = tuple[str, str]
"""Module in lower case; in it a name without blanks in lower case, behind its routine and a dot."""


class Declared(NamedTuple):
    """A value that a module declares."""

    module: str
    text: str
    file: str
    line: int
    data_type: str
    is_local: bool
    value: Any


class Moved(NamedTuple):
    """A move as it is written: an instruction, or a call with a target as an argument."""

    module: str
    text: str
    """The target without blanks."""
    file: str
    line: int
    home: Key
    """The target in the module that declares it, else in its own."""
    routine: Key
    fields: Mapping[str, str]
    """What it has beside its target, by name."""
    words: frozenset[str]
    joints: tuple[float, ...] | None
    """At its target [deg], if it is checked and reached."""
    is_unmet: bool


@dataclass(frozen=True, eq=False)
class Side:
    """A program with its robot."""

    program: Program
    robot: Robot | None = None
    units: Sequence[UnitRow] = ()

    def declared(self, types: Iterable[str]) -> dict[Key, Declared]:
        """Return the data of some types, elements of arrays one by one."""
        found = {}
        for file, module in zip(self.program.files, self.program.modules, strict=True):
            for it in (own for own in module.declarations if own.data_type in types):
                scope = f"{it.routine}." if it.routine else ""
                is_local = it.scope == "LOCAL" or it.routine is not None
                for name, value in elements(f"{scope}{it.name}", it.value):
                    place = (module.name or "", name, file.path, it.line)
                    own = Declared(*place, it.data_type, is_local, value)
                    found[own.module.lower(), name.lower()] = own
        return found

    @cached_property
    def moves(self) -> list[Moved]:
        """Moves in the order of the text; calls, too, where the robot is known."""
        modules, unmet = self.program.modules, set()
        rows: list[tuple[Place, CheckedMove | None]] = []
        written = {
            (at, it.line, it.column): it for at, own in enumerate(modules) for it in own.moves
        }
        if self.robot is not None:
            checked = self.program.check(self.robot, codes=UNMET, units=self.units)
            rows += (((it.module, it.line, it.column), it) for it in checked.moves)
            unmet = {(it.module, it.line, it.column) for it in checked.findings}
        rows += ((place, None) for place in written.keys() - {place for place, _ in rows})
        names = [module.name or "" for module in modules]
        homes = {
            name.lower(): own
            for own, module in zip(reversed(names), reversed(modules), strict=True)
            for name in module.keys()  # noqa: SIM118 - a module is a mapping that is no dict
        }
        sources, found = [module.source.split("\n") for module in modules], []
        for place, met in sorted(rows, key=lambda row: row[0]):
            at, line, _ = place
            it: Any = written.get(place) or met
            text, fields = _written(sources[at], place, it)
            home = names[at] if text in modules[at] else homes.get(text.lower(), names[at])
            keys = (home.lower(), text.lower()), (names[at].lower(), (it.routine or "").lower())
            words = frozenset(WORD.findall(" ".join([text, *fields.values()]).lower()))
            q = None if met is None or place in unmet else met.q
            joints = None if q is None else tuple(map(math.degrees, q))
            path = self.program.files[at].path
            row = (names[at], text, path, line, *keys, fields, words, joints)
            found.append(Moved(*row, place in unmet))
        return found


def _written(lines: Sequence[str], place: Place, it: Any) -> tuple[str, dict[str, str]]:
    """The target and the fields of a move; of a call its text."""
    if not hasattr(it, "zone"):
        _, line, column = place
        text = "\n".join([lines[line - 1][column - 1 :], *lines[line : line + 20]])
        return "".join(it.target.split()), {"call": " ".join(text.partition(";")[0].split())}
    fields = {"instruction": it.instruction, "speed": it.speed, "zone": it.zone}
    fields |= {"tool": it.tool.text, "work object": it.wobj.text if it.wobj else "wobj0"}
    fields |= {"circle point": it.via.text} if it.via else {}
    fields |= {f"\\{name}": value or "given" for name, value in it.options}
    return "".join(it.target.text.split()), fields


def elements(name: str, value: Any, index: tuple[int, ...] = ()) -> Iterator[tuple[str, Any]]:
    """Yield the elements of an array of any shape with their names, or a value; nothing of None."""
    if isinstance(value, list):
        for number, element in enumerate(value, 1):
            yield from elements(name, element, (*index, number))
    elif value is not None:
        yield (f"{name}{{{','.join(map(str, index))}}}" if index else name), value
