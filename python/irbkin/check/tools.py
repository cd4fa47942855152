"""Tools of moves: their loads, and their shapes among what an arm must not touch."""

import math
import re
from collections import Counter
from collections.abc import Collection, Iterator
from functools import cache
from typing import Any

from irbkin import Robot, catalog_entry
from irbkin.abb.sides import elements
from irbkin.check.codes import TOOLS
from irbkin.errors import UnknownRobotError
from irbkin.rapid import Finding, Program

NO_CODE = re.compile(r'"[^"\n]*"|![^\n]*')
UNSET, DOUBTFUL, SHAPELESS, UNITS, NOTED = (code for code, *_ in TOOLS)
FLANGE = "tool0"
"""The tool that has no shape."""
LOAD0 = (0.001, (0.0, 0.0, 0.001))
"""Mass [kg] and center of gravity [mm] of load0."""
ROUNDING = 0.01
"""Relative rounding of inertias and quaternions that are entered by hand [1]."""


def tool_findings(
    program: Program, robot: Robot, cell: str, shapes: Collection[str]
) -> Iterator[Finding]:
    """Yield findings on the loads that a program uses, and on tools without a shape in a cell."""
    try:
        payload = catalog_entry(robot.name).payload or math.inf
    except UnknownRobotError:
        payload = math.inf
    declared = [
        (index, it, [own for _, own in elements(it.name, it.value)])
        for index, module in enumerate(program.modules)
        for it in module.declarations
        if it.data_type in ("tooldata", "loaddata") and it.value is not None
    ]
    times = Counter(it.name.lower() for _, it, _ in declared)

    @cache
    def codes() -> list[str]:
        return [NO_CODE.sub("", module.source).lower() for module in program.modules]

    @cache
    def count(pattern: str) -> int:
        return sum(len(re.findall(pattern, code)) for code in codes())

    def is_used(name: str) -> bool:
        return count(rf"\b{name}\b") > times[name]

    def is_assigned(name: str) -> bool:
        return count(rf"(?<!\\)\b{name}(?:[.{{][^;:=\\]*)?\s*:=") > times[name]

    @cache
    def lightest_tool() -> tuple[float, str]:
        """The mass and the name of the lightest tool that is used; 0 kg if it is assigned."""
        tools = (
            (own, it) for _, it, values in declared for own in values if "tool" in it.data_type
        )
        held = sorted((own.tload.mass_kg, it.name) for own, it in tools if own.robhold)
        mass, name = next((it for it in held if is_used(it[1].lower())), (0.0, ""))
        return 0.0 if is_assigned(name.lower()) else mass, name

    for index, it, values in declared:
        name = it.name.lower()
        wrong = [fault for own in values for fault in _faults(own, robot.name, payload)]
        if it.data_type == "loaddata":
            mass, (tool, holder) = min(own.mass_kg for own in values), lightest_tool()
            if mass <= payload < mass + tool and count(rf"\bgripload\s+{name}\b"):
                words = f"its {mass:g} kg and the {tool:g} kg of {holder} are more than the "
                words += f"{payload:g} kg of {robot.name}"
                wrong.append((DOUBTFUL, words, mass + tool, payload))
        # What a routine declares may be filled by any call before its use.
        if wrong and (is_assigned(name) or (it.routine and it.storage == "VAR")):
            wrong = []
        is_tool = it.data_type == "tooldata" and name != FLANGE and name not in shapes
        if cell and is_tool and any(value.robhold for value in values):
            others = f", which has {', '.join(shapes)}" if shapes else ""
            words = f"it has no shape in {cell}{others}: it is not part of the proof"
            wrong.append((SHAPELESS, words, None, None))
        if wrong and not is_used(name):
            continue
        for code, own, severity, _ in TOOLS:
            for _, words, number, bound in dict.fromkeys(row for row in wrong if row[0] == code):
                place = (index, it.line, it.column, it.routine, 0)
                text = f"{it.data_type} {it.name}: {words}"
                yield Finding(code, own, severity, *place, text, None, number, bound, (), ())


def _faults(of: Any, arm: str, payload: float) -> Iterator[Any]:
    load = getattr(of, "tload", of)
    mass, inertia, cog = load.mass_kg, max(load.inertia), math.hypot(*load.cog_mm)
    others, length = sum(load.inertia) - inertia, math.hypot(*load.aom)
    tcp = math.hypot(*of.tframe.trans_mm) if getattr(of, "robhold", False) else 0.0
    if mass < 0.0:
        words = f"its mass is {mass:g} kg, as of new data: a controller refuses to move"
        yield UNSET, words, mass, 0.0
        return
    if mass == 0.0:
        yield DOUBTFUL, "its mass is 0 kg: identify or enter its load", mass, 0.0
    elif mass > payload:
        words = f"its mass is {mass:g} kg, more than the {payload:g} kg of {arm}"
        yield DOUBTFUL, words, mass, payload
    if inertia > mass > 0.0:
        words = f"its inertia is {inertia:g} kg m^2, more than {mass:g} kg have at 1 m: kg mm^2?"
        yield UNITS, words, inertia, mass
    elif all(load.inertia) and inertia > others * (1.0 + ROUNDING):
        words = (
            f"its inertia of {inertia:g} kg m^2 is more than the other two, {others:g}, together"
        )
        yield DOUBTFUL, words, inertia, others
    if abs(length - 1.0) > ROUNDING:
        yield DOUBTFUL, f"its aom has the length {length:g}, a quaternion has 1", length, 1.0
    if tcp > 0.0 and (mass, load.cog_mm) == LOAD0:
        yield NOTED, "it has a TCP, but load0: identify or enter its load", None, None
    elif mass > 0.0 and cog == 0.0:
        yield NOTED, "its center of gravity is [0,0,0], as of new data: enter it", cog, None
    elif cog > 3.0 * tcp > 0.0:
        words = f"its center of gravity is {cog:g} mm from the flange, the TCP {tcp:g} mm"
        yield NOTED, words, cog, 3.0 * tcp
