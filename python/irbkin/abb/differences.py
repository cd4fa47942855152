"""Differences of two backups: data, moves, targets in space and in joints, robots, modules."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import Any

import numpy as np

from irbkin.abb.backup import Backup
from irbkin.abb.changes import (
    DATA,
    LEAST_ANGLE,
    Change,
    angle_text,
    data_changes,
    is_same,
    move_changes,
    named,
    setting_changes,
    shift,
)
from irbkin.abb.external import unit_rows
from irbkin.abb.load import load_backup
from irbkin.abb.sides import Declared, Key, Moved, Side
from irbkin.rapid import Pose

TARGETS = ("robtarget", "jointtarget")
ROBOT: Key = ("", "robot")
"""Stands for the robot among data."""
CARRIED = {"tool", "work object"}
"""Fields of moves that change the joints at their targets."""


@dataclass(frozen=True)
class TargetChange:
    """A target that is another one than before, or is reached otherwise."""

    task: str
    module: str
    """Name of the module that declares it or moves to it."""
    target: str
    """Its name, with the index of an element, or the target of a move as it is written."""
    kind: str
    """"added", "removed", "moved" (in its work object), "confdata", "external" (axes), "joints" (it
    is as it was, and no tool, work object or robot explains it), "unreachable" or "reachable": now,
    and not before.
    """
    distance_mm: float | None = None
    """How far it moved in its work object [mm]."""
    angle_deg: float | None = None
    """How far it turned there [deg]; None for a quaternion of length zero."""
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
        if self.distance_mm is not None:
            parts.append(f"by {self.distance_mm:.3f} mm and {angle_text(self.angle_deg)}")
        if self.joint is not None:
            parts.append(f"J{self.joint} by {self.joint_deg:.3f} deg")
        words = f" {', '.join(parts)}" if parts else ""
        return f"{self.file}:{self.line}: {self.target}: {self.kind}{words}"


@dataclass(frozen=True)
class Difference:
    """The differences of two backups."""

    data: tuple[Change, ...]
    """Tools, work objects, loads, speeds, zones, robots and motion settings of routines."""
    moves: tuple[Change, ...]
    """Moves with another speed, zone, tool, ..: a routine's that differ in one way are one."""
    targets: tuple[TargetChange, ...]
    """Targets, in the order of tasks and modules."""
    robots: tuple[str, ...]
    """A line for each robot whose arm, limits or base differ."""
    modules: tuple[str, ...]
    """A line for each module that only one of them has."""


def diff(old: Backup | str | PathLike[str], new: Backup | str | PathLike[str]) -> Difference:
    """Compare two backups of one controller.

    Args:
        old: The earlier backup, or its path.
        new: The later one.

    Raises:
        IrbkinError: As `load_backup`.
    """
    old, new = (it if isinstance(it, Backup) else load_backup(it) for it in (old, new))
    before, after = _sides(old), _sides(new)
    parts, modules = [], list[str]()
    for task in dict.fromkeys([*before, *after]):
        if task not in before or task not in after:
            modules.append(f"{task}: only the {'new' if task in after else 'old'} backup has it")
        else:
            parts.append(compared(task, before[task], after[task]))
    robots = tuple(_robots(old, new))
    data, moves, targets, others = (
        tuple(it for part in parts for it in getattr(part, name))
        for name in ("data", "moves", "targets", "modules")
    )
    return Difference(data, moves, targets, robots, (*modules, *others))


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


def compared(task: str, old: Side, new: Side) -> Difference:
    """Return the differences of two programs; those in their robots are not looked for."""
    data, moves = data_changes(task, old, new), [*move_changes(task, old, new)]
    before, after = old.declared(TARGETS), new.declared(TARGETS)
    met, reasons = (_met(old), _met(new)), _reasons(old, new, data, moves)
    targets, explained = [], defaultdict[Key | int, list[TargetChange]](list)
    for key in dict.fromkeys([*before, *after, *met[0], *met[1]]):
        change = _change(task, key, (before.get(key), after.get(key)), met)
        if change is not None and change.kind == "joints" and key in reasons:
            explained[reasons[key]].append(change)
        elif change is not None:
            targets.append(change)
    if ROBOT in explained:
        data[ROBOT] = Change(task, "", "robot", "changed", "", 0, moves=len(new.moves))

    def complete(reason: Key | int, change: Change) -> Change:
        if not (own := explained.get(reason)):
            return change
        most = max(own, key=lambda it: it.joint_deg or 0.0)
        return replace(change, targets=len(own), joint=most.joint, joint_deg=most.joint_deg)

    all_data = [complete(key, change) for key, change in data.items()]
    all_moves = (complete(number, change) for number, (change, _) in enumerate(moves))
    names = [{it.name or "" for it in side.program.modules} for side in (old, new)]
    lines = [f"{task}: module {it} is only in the old backup" for it in sorted(names[0] - names[1])]
    lines += (f"{task}: module {it} is new" for it in sorted(names[1] - names[0]))
    settings = setting_changes(task, old, new)
    return Difference((*all_data, *settings), tuple(all_moves), tuple(targets), (), tuple(lines))


def _reasons(
    old: Side, new: Side, data: Mapping[Key, Change], moves: Sequence[tuple[Change, list[Moved]]]
) -> dict[Key, Key | int]:
    """Why the joints at a target may differ: a datum, or the number of a change of moves."""
    found: dict[Key, Key | int] = {}
    if None not in (old.robot, new.robot) and old.robot != new.robot:
        found.update((move.home, ROBOT) for move in new.moves)
    shifted = (key for key, it in data.items() if it.frames)
    found.update((move.home, key) for move, key in named(new.moves, shifted, new.declared(DATA)))
    for number, (change, own) in enumerate(moves):
        if not CARRIED.isdisjoint(change.was):
            found.update((move.home, number) for move in own)
    return found


def _met(side: Side) -> dict[Key, Moved]:
    """The first move to each target whose joints are known, else the first; unmet if any is."""
    found: dict[Key, Moved] = {}
    for it in side.moves:
        before = found.get(it.home, it)
        first = it if before.joints is None and it.joints is not None else before
        found[it.home] = first._replace(is_unmet=before.is_unmet or it.is_unmet)
    return found


def _change(
    task: str,
    key: Key,
    declared: tuple[Declared | None, Declared | None],
    moves: tuple[Mapping[Key, Moved], Mapping[Key, Moved]],
) -> TargetChange | None:
    old, new = declared
    old_met, new_met = (it.get(key) for it in moves)
    known = new or new_met or old or old_met
    assert known is not None
    what = (task, known.module, known.text)
    given: dict[str, Any] = {"file": known.file, "line": known.line}
    if (old or old_met) is None or (new or new_met) is None:
        # Targets that no data are have their moves among the moves.
        kind = "added" if new else "removed"
        return TargetChange(*what, kind, **given) if old or new else None
    kind = ""
    if old and new and type(old.value) is type(new.value):
        if hasattr(old.value, "trans_mm"):
            given["distance_mm"], given["angle_deg"] = by = shift(old.value, new.value)
            kind = "" if is_same(*by) else "moved"
            if not kind and old.value.robconf != new.value.robconf:
                kind = "confdata"
        else:
            kind = _turned(given, old.value.robax_deg, new.value.robax_deg)
        if not kind and old.value.extax != new.value.extax:
            kind = "external"
    if old_met and new_met:
        if old_met.joints and new_met.joints:
            turned = _turned(given, old_met.joints, new_met.joints)
            kind = kind or turned
        if old_met.is_unmet != new_met.is_unmet:
            kind = "unreachable" if new_met.is_unmet else "reachable"
    return TargetChange(*what, kind, **given) if kind else None


def _turned(given: dict[str, Any], old: Sequence[float], new: Sequence[float]) -> str:
    """Add the joint that differs most [deg] to what is known of a change, and return its kind."""
    turns = [abs(a - b) for a, b in zip(old, new, strict=True)]
    if max(turns) < LEAST_ANGLE:
        return ""
    given["joint"], given["joint_deg"] = turns.index(max(turns)) + 1, max(turns)
    return "joints"


def _robots(old: Backup, new: Backup) -> Iterator[str]:
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
            distance, angle = shift(Pose.of(a.base), Pose.of(b.base))
            if not is_same(distance, angle):
                yield f"{name}: its base moved by {distance:.3f} mm and {angle_text(angle)}"
