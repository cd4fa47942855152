"""Differences of two backups: targets in space and in joints, reach, robots, modules."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

from irbkin.abb.backup import Backup
from irbkin.abb.external import unit_rows
from irbkin.abb.load import load_backup

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.abb.external import UnitRow
    from irbkin.rapid import Program

LEAST_DISTANCE = 1e-3
"""Distance from which a target has moved [mm]: the last digit that RAPID writes."""
LEAST_ANGLE = 1e-3
"""Angle from which it has turned, or a joint has [deg]."""
UNMET = ("R101", "R102")
"""Codes of targets that are not reached."""


@dataclass(frozen=True)
class TargetChange:
    """A target that is another one than before, or is reached otherwise."""

    task: str
    """Name of the task."""
    module: str
    """Name of the module that declares it or moves to it."""
    target: str
    """Its name, with the index of an element, or the target of a move as it is written."""
    kind: str
    """"added", "removed", "moved" (in its work object), "confdata", "joints" (it is as it was, a
    tool, a work object or the robot is not), "unreachable" or "reachable": now, and not before.
    """
    distance_mm: float | None = None
    """How far it moved in its work object [mm]."""
    angle_deg: float | None = None
    """How far it turned there [deg]."""
    joint: int | None = None
    """The joint that differs most at the moves to it, from 1."""
    joint_deg: float | None = None
    """How far this joint differs [deg]."""
    file: str = ""
    """File of the new backup, of a target that was removed of the old one."""
    line: int = 0
    """Line of the declaration, else of the move."""

    def __str__(self) -> str:
        """Write it as linters do."""
        parts = []
        if self.distance_mm is not None and self.angle_deg is not None:
            parts.append(f"by {self.distance_mm:.3f} mm and {self.angle_deg:.3f} deg")
        if self.joint is not None:
            parts.append(f"J{self.joint} by {self.joint_deg:.3f} deg")
        words = f" {', '.join(parts)}" if parts else ""
        return f"{self.file}:{self.line}: {self.target}: {self.kind}{words}"


@dataclass(frozen=True)
class Difference:
    """The differences of two backups."""

    targets: tuple[TargetChange, ...]
    """Targets, in the order of tasks and modules."""
    robots: tuple[str, ...]
    """A line for each robot whose arm, limits or base differ."""
    modules: tuple[str, ...]
    """A line for each module that only one of them has."""


@dataclass(frozen=True, eq=False)
class Side:
    """A program with its robot."""

    program: Program
    robot: Robot | None = None
    units: Sequence[UnitRow] = ()


def diff(old: Backup | str | PathLike[str], new: Backup | str | PathLike[str]) -> Difference:
    """Compare two backups of one controller.

    Args:
        old: The earlier backup, or its path.
        new: The later one.

    Returns:
        Difference.

    Raises:
        IrbkinError: As `load_backup`.
    """
    old, new = (it if isinstance(it, Backup) else load_backup(it) for it in (old, new))
    before, after = _sides(old), _sides(new)
    targets: list[TargetChange] = []
    modules: list[str] = []
    for task in dict.fromkeys([*before, *after]):
        if task not in before or task not in after:
            modules.append(f"{task}: only the {'new' if task in after else 'old'} backup has it")
            continue
        own_targets, own_modules = compared(task, before[task], after[task])
        targets += own_targets
        modules += own_modules
    return Difference(tuple(targets), tuple(_robots(old, new)), tuple(modules))


def _sides(backup: Backup) -> dict[str, Side]:
    """The programs of a backup by task, with their robots where they are known."""
    sides = {}
    for task in backup.tasks:
        if task.name not in backup.programs:
            continue
        unit = backup.robots.get(task.robot or "")
        robot = unit.robot if unit is not None else None
        rows = unit_rows(backup, unit.name) if unit is not None else []
        sides[task.name] = Side(backup.programs[task.name], robot, rows)
    return sides


def compared(task: str, old: Side, new: Side) -> tuple[list[TargetChange], list[str]]:
    """Return the targets and the modules in which two programs differ."""
    before, after = _declared(old.program), _declared(new.program)
    moves = _met(old), _met(new)
    changes = []
    for key in dict.fromkeys([*before, *after, *moves[0], *moves[1]]):
        change = _change(task, key, (before.get(key), after.get(key)), moves)
        if change is not None:
            changes.append(change)
    names = [{it.name or "" for it in side.program.modules} for side in (old, new)]
    lines = [f"{task}: module {it} is only in the old backup" for it in sorted(names[0] - names[1])]
    lines += (f"{task}: module {it} is new" for it in sorted(names[1] - names[0]))
    return changes, lines


Key = tuple[str, str]
"""Module in lower case, target without blanks in lower case."""


@dataclass(frozen=True)
class _Declared:
    module: str
    name: str
    value: Any
    file: str
    line: int


@dataclass(frozen=True)
class _Met:
    """The moves to a target."""

    module: str
    text: str
    joints: tuple[float, ...] | None
    """Joint angles [deg] of the first one that has them."""
    is_unmet: bool
    file: str
    line: int


def _declared(program: Program) -> dict[Key, _Declared]:
    """The robtargets and jointtargets of a program."""
    found = {}
    for file, module in zip(program.files, program.modules, strict=True):
        for it in module.declarations:
            if it.data_type not in ("robtarget", "jointtarget"):
                continue
            for name, value in _elements(it.name, it.value):
                scope = f"{it.routine}." if it.routine else ""
                key = ((module.name or "").lower(), f"{scope}{name}".lower())
                place = (file.path, it.line)
                found[key] = _Declared(module.name or "", f"{scope}{name}", value, *place)
    return found


def _elements(name: str, value: Any, index: tuple[int, ...] = ()) -> Iterator[tuple[str, Any]]:
    """The elements of a value with their names."""
    if isinstance(value, list):
        for number, element in enumerate(value, 1):
            yield from _elements(name, element, (*index, number))
    elif value is not None:
        yield (f"{name}{{{','.join(map(str, index))}}}" if index else name), value


def _met(side: Side) -> dict[Key, _Met]:
    """The targets of the moves of a program, by the module that declares or else moves."""
    if side.robot is None:
        return {}
    checked = side.program.check(side.robot, codes=UNMET, units=side.units)
    unmet = {(it.module, it.line, it.column) for it in checked.findings}
    homes = {
        name.lower(): (module.name or "")
        for module in reversed(side.program.modules)
        for name in module.keys()  # noqa: SIM118 - a module is a mapping that is no dict
    }
    found: dict[Key, _Met] = {}
    for it in checked.moves:
        module = side.program.modules[it.module]
        text = "".join(it.target.split())
        home = module.name or ""
        if text not in module:
            home = homes.get(text.lower(), home)
        key = (home.lower(), text.lower())
        is_unmet = (it.module, it.line, it.column) in unmet
        before = found.get(key)
        q = None if it.q is None or is_unmet else tuple(map(math.degrees, it.q))
        if before is None or (before.joints is None and q is not None):
            place = (side.program.files[it.module].path, it.line)
            found[key] = _Met(home, text, q, is_unmet or bool(before and before.is_unmet), *place)
    return found


def _change(
    task: str,
    key: Key,
    declared: tuple[_Declared | None, _Declared | None],
    moves: tuple[Mapping[Key, _Met], Mapping[Key, _Met]],
) -> TargetChange | None:
    """The change of a target, if there is one."""
    old, new = declared
    old_met, new_met = (it.get(key) for it in moves)
    known = new or new_met or old or old_met
    assert known is not None
    name = known.name if isinstance(known, _Declared) else known.text
    given: dict[str, Any] = {"file": known.file, "line": known.line}
    if (new or new_met) and not (old or old_met):
        return TargetChange(task, known.module, name, "added", **given)
    if (old or old_met) and not (new or new_met):
        return TargetChange(task, known.module, name, "removed", **given)
    kind = ""
    if old and new and type(old.value) is type(new.value) and hasattr(old.value, "trans_mm"):
        given["distance_mm"] = math.dist(old.value.trans_mm, new.value.trans_mm)
        given["angle_deg"] = _angle(old.value.rot, new.value.rot)
        if given["distance_mm"] >= LEAST_DISTANCE or given["angle_deg"] >= LEAST_ANGLE:
            kind = "moved"
        elif old.value.robconf != new.value.robconf:
            kind = "confdata"
    if old_met and new_met:
        if old_met.joints and new_met.joints:
            turns = [abs(a - b) for a, b in zip(old_met.joints, new_met.joints, strict=True)]
            if max(turns) >= LEAST_ANGLE:
                given["joint"], given["joint_deg"] = turns.index(max(turns)) + 1, max(turns)
                kind = kind or "joints"
        if old_met.is_unmet != new_met.is_unmet:
            kind = "unreachable" if new_met.is_unmet else "reachable"
    return TargetChange(task, known.module, name, kind, **given) if kind else None


def _angle(one: Sequence[float], other: Sequence[float]) -> float:
    """The angle between two quaternions [deg], of any length; NaN where one is zero."""
    norm = math.hypot(*one) * math.hypot(*other)
    if norm == 0.0:
        return 0.0 if list(one) == list(other) else math.nan
    # The sine of a quarter: precise where they are close.
    sign = math.copysign(1.0, sum(a * b for a, b in zip(one, other, strict=True)))
    units = [[part / math.hypot(*it) for part in it] for it in (one, other)]
    chord = math.dist(units[0], [sign * part for part in units[1]])
    return math.degrees(4.0 * math.asin(min(chord / 2.0, 1.0)))


def _robots(old: Backup, new: Backup) -> Iterator[str]:
    """Lines for robots that differ."""
    import numpy as np

    for name in dict.fromkeys([*old.robots, *new.robots]):
        a, b = old.robots.get(name), new.robots.get(name)
        if a is None or b is None:
            yield f"{name}: only the {'new' if b else 'old'} backup has it"
            continue
        if (a.arm or a.type) != (b.arm or b.type):
            yield f"{name}: was {a.arm or a.type}, is {b.arm or b.type}"
        elif a.robot is not None and b.robot is not None:
            differ = np.degrees(np.abs(a.robot.limits - b.robot.limits)) >= LEAST_ANGLE
            for axis in np.flatnonzero(differ.any(axis=1)):
                limits = [np.degrees(it.robot.limits[axis]) for it in (a, b) if it.robot]
                words = [f"{lower:g}..{upper:g}" for lower, upper in limits]
                yield f"{name}: J{axis + 1} was limited to {words[0]} deg, is to {words[1]}"
        if a.base is not None and b.base is not None:
            shift = float(np.linalg.norm(a.base[:3, 3] - b.base[:3, 3])) * 1e3
            turn = np.linalg.norm(a.base[:3, :3] - b.base[:3, :3]) / (2.0 * math.sqrt(2.0))
            angle = math.degrees(2.0 * math.asin(min(float(turn), 1.0)))
            if shift >= LEAST_DISTANCE or angle >= LEAST_ANGLE:
                yield f"{name}: its base moved by {shift:.3f} mm and {angle:.3f} deg"
