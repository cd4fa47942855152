"""Tools of moves: their loads, and their shapes among what an arm must not touch."""

from __future__ import annotations

import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from irbkin.check.codes import TOOLS
from irbkin.errors import InvalidModelError, UnknownRobotError

if TYPE_CHECKING:
    from irbkin import Robot, rapid
    from irbkin.body import Shape
    from irbkin.rapid import Checked, Finding, Move, Program

WORD = re.compile(r"[^\W\d]\w*")
COMMENT = re.compile(r'("[^"\n]*")|![^\n]*')
SET = re.compile(r"^[ \t]*(\w+)(?:\.\w+)*[ \t]*:=", re.MULTILINE)
COLLISION = "K901"
UNSET, DOUBTFUL, SHAPELESS = (code for code, *_ in TOOLS)
FLANGE = "tool0"
"""The tool that has no shape."""


class Carried(NamedTuple):
    """Shapes of tools and parts that moves carry."""

    file: str
    """The file that they are in."""
    shapes: Mapping[str, Sequence[Shape]]
    """In the flange frame, by the names of tool and work object in lower case."""

    def checked(
        self, checked: Checked, program: Program, robot: Robot, options: Mapping[str, Any]
    ) -> Checked:
        """Return a result with the collisions of each move with what it carries.

        The program is checked again with each tool on the flange, for the moves that have it.
        """
        carrying = _Carrying(program, self.shapes)
        found = [it for it in checked.findings if it.code != COLLISION or not carrying.of(it)]
        for group in carrying.groups(checked):
            try:
                own = robot.with_attached([it for name in group for it in self.shapes[name]])
            except InvalidModelError as error:
                names = ", ".join(sorted(group))
                raise InvalidModelError(f"{self.file}: {names}: {error}") from None
            again = program.check(own, **{**options, "codes": [COLLISION]})
            found += (it for it in again.findings if group in carrying.of(it))
        found.sort(key=lambda it: (it.module, it.line, it.column))
        return type(checked)(tuple(found), checked.moves)


class _Carrying:
    """Finds the tools and parts that the moves of a program carry."""

    def __init__(self, program: Program, names: Iterable[str]) -> None:
        self._names, self._cached = frozenset(names), cache(self._within)
        self._sources = [module.source.split("\n") for module in program.modules]
        self._written = {
            (index, it.line, it.column): it
            for index, module in enumerate(program.modules)
            for it in module.moves
        }
        declared = (it for module in program.modules for it in module.declarations)
        self._tools = {FLANGE, *(it.name.lower() for it in declared if it.data_type == "tooldata")}
        self._moves: dict[str, list[str]] = defaultdict(list)
        self._others: dict[str, list[str]] = defaultdict(list)
        for module in program.modules:
            for it in module.moves:
                self._moves[(it.routine or "").lower()].append(_of(it))
            for other in module.skipped:
                self._others[(other.routine or "").lower()].append(other.text)

    def _in(self, text: str) -> frozenset[str]:
        return self._names.intersection(WORD.findall(text.lower()))

    def _by(self, text: str, given: Set[str]) -> Set[str]:
        """What a move with a tool and a work object carries: what is given, by a parameter."""
        is_known = text.partition(" ")[0].lower() in self._tools
        return self._in(text) or (frozenset() if is_known else given)

    def _within(self, routine: str, given: frozenset[str]) -> Set[str]:
        """What the moves of a routine, and of those that it calls, carry."""
        found, left, seen = set[str](), [routine], set[str]()
        while left:
            if (name := left.pop()) not in seen:
                seen.add(name)
                found.update(*(self._by(text, given) for text in self._moves[name]))
                for text in self._others[name]:
                    found |= self._in(text)
                    left += WORD.findall(text.lower())[:1]
        return found

    def of(self, at: Finding | rapid.CheckedMove) -> set[frozenset[str]]:
        """Return what is carried at a place: of a call each tool that it, or a routine, has."""
        if it := self._written.get((at.module, at.line, at.column)):
            if own := self._in(_of(it)):
                return {frozenset(own)}
            return {frozenset([name]) for name in self._by(_of(it), self._names)}
        lines = self._sources[at.module]
        text = "\n".join([lines[at.line - 1][at.column - 1 :], *lines[at.line : at.line + 20]])
        call = text.partition(";")[0]
        words = WORD.findall(call.lower())
        if own := self._in(call):
            return {frozenset([name]) for name in own}
        # Without a tool in the call a parameter may be any.
        given = self._names if self._tools.isdisjoint(words) else frozenset[str]()
        return {frozenset([name]) for own in words[:1] for name in self._cached(own, given)}

    def groups(self, checked: Checked) -> set[frozenset[str]]:
        """Return what is carried together anywhere."""
        return {group for move in checked.moves for group in self.of(move)}


def _of(move: Move) -> str:
    return f"{move.tool.text} {move.wobj.text if move.wobj else ''}"


def tool_findings(program: Program, robot: Robot, carried: Carried | None) -> Iterator[Finding]:
    """Yield findings on the loads that a program uses, and on tools without a shape in a cell."""
    from irbkin import catalog_entry
    from irbkin.rapid import Finding

    try:
        payload = catalog_entry(robot.name).payload or math.inf
    except UnknownRobotError:
        payload = math.inf
    codes = [COMMENT.sub(lambda it: it[1] or "", module.source) for module in program.modules]
    uses = Counter(name for code in codes for name in WORD.findall(code.lower()))
    assigned = {name.lower() for code in codes for name in SET.findall(code)}
    declared = [
        (index, it)
        for index, module in enumerate(program.modules)
        for it in module.declarations
        if it.data_type in ("tooldata", "loaddata") and it.value is not None
    ]
    uses.subtract(it.name.lower() for _, it in declared)
    for index, it in declared:
        name = it.name.lower()
        if uses[name] <= 0:
            continue
        wrong: dict[str, tuple[str, float | None, float | None]] = {}
        for value in _values(it.value) if name not in assigned else ():
            mass = getattr(value, "tload", value).mass_kg
            if mass < 0.0:
                words = f"its mass is {mass:g} kg, as of new data: a controller refuses to move"
                wrong[UNSET] = (words, mass, 0.0)
            elif mass == 0.0:
                wrong[DOUBTFUL] = ("its mass is 0 kg: identify or enter its load", mass, 0.0)
            elif mass > payload:
                words = f"its mass is {mass:g} kg, more than the {payload:g} kg of {robot.name}"
                wrong[DOUBTFUL] = (words, mass, payload)
        if carried and it.data_type == "tooldata" and name not in (*carried.shapes, FLANGE):
            words = f"it has no shape in {carried.file}: it is not part of the proof"
            wrong[SHAPELESS] = (words, None, None)
        for code, own, severity, _ in TOOLS:
            if code in wrong:
                words, number, bound = wrong[code]
                place = (index, it.line, it.column, it.routine, 0)
                text = f"{it.data_type} {it.name}: {words}"
                yield Finding(code, own, severity, *place, text, None, number, bound, (), ())


def _values(value: Any) -> Iterator[Any]:
    """Yield the records of a value that may be an array."""
    for own in value if isinstance(value, list) else ():
        yield from _values(own)
    if not isinstance(value, list | None):
        yield value
