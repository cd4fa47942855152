"""Tools of moves: their loads, and their shapes among what an arm must not touch."""

import math
import re
from collections import Counter
from collections.abc import Collection, Iterator
from functools import cache
from typing import Any

from irbkin import Robot, catalog_entry
from irbkin.check.codes import TOOLS
from irbkin.errors import UnknownRobotError
from irbkin.rapid import Finding, Program

NO_CODE = re.compile(r'"[^"\n]*"|![^\n]*')
UNSET, DOUBTFUL, SHAPELESS = (code for code, *_ in TOOLS)
FLANGE = "tool0"
"""The tool that has no shape."""


def tool_findings(
    program: Program, robot: Robot, cell: str, shapes: Collection[str]
) -> Iterator[Finding]:
    """Yield findings on the loads that a program uses, and on tools without a shape in a cell."""
    try:
        payload = catalog_entry(robot.name).payload or math.inf
    except UnknownRobotError:
        payload = math.inf
    declared = [
        (index, it)
        for index, module in enumerate(program.modules)
        for it in module.declarations
        if it.data_type in ("tooldata", "loaddata") and it.value is not None
    ]
    times = Counter(it.name.lower() for _, it in declared)

    @cache
    def codes() -> list[str]:
        return [NO_CODE.sub("", module.source).lower() for module in program.modules]

    def count(pattern: str) -> int:
        return sum(len(re.findall(pattern, code, re.MULTILINE)) for code in codes())

    for index, it in declared:
        name = it.name.lower()
        wrong: dict[str, tuple[str, float | None, float | None]] = {}
        for value in _values(it.value):
            mass = getattr(value, "tload", value).mass_kg
            if mass < 0.0:
                words = f"its mass is {mass:g} kg, as of new data: a controller refuses to move"
                wrong[UNSET] = (words, mass, 0.0)
            elif mass == 0.0:
                wrong[DOUBTFUL] = ("its mass is 0 kg: identify or enter its load", mass, 0.0)
            elif mass > payload:
                words = f"its mass is {mass:g} kg, more than the {payload:g} kg of {robot.name}"
                wrong[DOUBTFUL] = (words, mass, payload)
        if wrong and count(rf"^[ \t]*{name}(?:\.\w+)*[ \t]*:="):
            wrong = {}
        is_tool = it.data_type == "tooldata" and name != FLANGE and name not in shapes
        if cell and is_tool and any(value.robhold for value in _values(it.value)):
            others = f", which has {', '.join(shapes)}" if shapes else ""
            words = f"it has no shape in {cell}{others}: it is not part of the proof"
            wrong[SHAPELESS] = (words, None, None)
        if wrong and count(rf"\b{name}\b") <= times[name]:
            continue
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
