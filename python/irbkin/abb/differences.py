"""Differences of two backups: data, moves, targets in space and in joints, robots, modules."""

import math
import re
from bisect import bisect
from collections import Counter, defaultdict, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from os import PathLike
from typing import Any, TypeVar

import numpy as np

from irbkin.abb.backup import Backup, unit_rows
from irbkin.abb.load import load_backup
from irbkin.abb.sides import Declared, Key, Moved, Side
from irbkin.rapid import Pose

LEAST_DISTANCE = 1e-3
"""Distance from which a frame or a target has moved [mm]: the last digit that RAPID writes."""
LEAST_ANGLE = 1e-3
"""Angle from which it has turned, or a joint has [deg]."""
DATA = {
    "tooldata": "tool",
    "wobjdata": "work object",
    "loaddata": "load",
    "speeddata": "speed",
    "zonedata": "zone",
}
"""Types of data that moves have beside targets, in the order of the report, and their words."""
FRAMES = {"tframe": "TCP", "uframe": "user frame", "oframe": "object frame"}
SETTING = re.compile(
    r"(?:^|;)[ \t]*((?:Conf[JL]|SingArea|CirPathMode|AccSet|VelSet|WorldAccLim|PathAccLim|GripLoad"
    r"|SpeedRefresh|PDisp(?:On|Off|Set)|EOffs(?:On|Off|Set))\b[^;]*)",
    re.IGNORECASE | re.MULTILINE,
)
"""Instructions that say how the moves behind them are made."""
COMMENT = re.compile(r'("[^"\n]*")|![^\n]*')
NAMED = 3
"""Moves of a change that are named."""
TARGETS = ("robtarget", "jointtarget")
ROBOT: Key = ("", "robot")
"""Stands for the robot among data."""
CARRIED = {"tool", "work object"}
"""Fields of moves that change the joints at their targets."""
T = TypeVar("T")


@dataclass(frozen=True)
class Change:
    """A datum, the settings of a routine, or moves of a routine that differ in one way."""

    task: str
    module: str
    """Name of the module that has it."""
    subject: str
    """"tool tGun", "settings of main" or "move to pA, pB, pC, .."."""
    kind: str
    """"changed", "added", "removed" or, of moves, "in another order"."""
    file: str
    """File of the new program, of what was removed of the old one."""
    line: int
    """Line of the declaration, the first setting or the first move."""
    was: Mapping[str, Any] = field(default_factory=dict)
    """Fields that differ, by their names, as they were."""
    now: Mapping[str, Any] = field(default_factory=dict)
    """As they are."""
    frames: Mapping[str, tuple[float, float | None]] = field(default_factory=dict)
    """How far frames moved [mm] and turned [deg]; None for a quaternion of length zero."""
    moves: int = 0
    """Number of moves that it touches."""
    targets: int = 0
    """Number of targets that have other joints for this reason and are not listed themselves."""
    joint: int | None = None
    """The joint that differs most at these, from 1."""
    joint_deg: float | None = None
    """How far it differs [deg]."""

    def __str__(self) -> str:
        parts = [
            f"{it} moved by {mm:.3f} mm, {angle_text(deg)}" for it, (mm, deg) in self.frames.items()
        ]
        parts += [f"{it} was {_shown(self.was[it])}, is {_shown(self.now[it])}" for it in self.was]
        words = f"{', '.join(parts or [self.kind])} ({self.moves} move{'s' * (self.moves != 1)}"
        if self.joint is not None:
            words += f"; {self.targets} target{'s' * (self.targets != 1)}, "
            words += f"J{self.joint} by up to {self.joint_deg:.3f} deg"
        place = f"{self.file}:{self.line}: " if self.file else ""
        return f"{place}{self.subject}: {words})"


def angle_text(degrees: float | None) -> str:
    """How far something turned, in words."""
    return "its orientation is no rotation" if degrees is None else f"{degrees:.3f} deg"


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return f"[{','.join(map(_shown, value))}]"
    return f"{value:g}" if isinstance(value, float) else str(value)


def data_changes(task: str, old: Side, new: Side) -> dict[Key, Change]:
    """Return the data that differ, and how many moves name them."""
    found: dict[Key, Change] = {}
    sides = old.declared(DATA), new.declared(DATA)
    both, types = {**sides[0], **sides[1]}, list(DATA)
    for key in sorted(both, key=lambda it: types.index(both[it].data_type)):
        (before, after), it = (own.get(key) for own in sides), both[key]
        what = (task, it.module, f"{DATA[it.data_type]} {it.text}")
        if before is None or after is None or before.data_type != after.data_type:
            kind = "added" if after else "removed"
            found[key] = Change(*what, kind, it.file, it.line)
            continue
        (was, frames), (now, others) = _parts(before.value), _parts(after.value)
        differ = [name for name in now if now[name] != was.get(name)]
        shifts = {FRAMES[name]: shift(frames[name], others[name]) for name in others}
        shifts = {name: by for name, by in shifts.items() if not is_same(*by)}
        if differ or shifts:
            was, now = ({name: of.get(name) for name in differ} for of in (was, now))
            found[key] = Change(*what, "changed", it.file, it.line, was, now, shifts)
    counts = Counter[Key]()
    for side, own in zip((old, new), sides, strict=True):
        # A datum that is gone was named by moves of the old program.
        keys = [key for key, it in found.items() if (it.kind == "removed") == (side is old)]
        counts.update(key for _, key in named(side.moves, keys, own))
    return {key: replace(it, moves=counts[key]) for key, it in found.items()}


def named(
    moves: Iterable[Moved], keys: Iterable[Key], data: Mapping[Key, Declared]
) -> Iterator[tuple[Moved, Key]]:
    """Yield moves with the data that they name; what is nearer hides what all modules know."""
    by_name: dict[str, list[Key]] = defaultdict(list)
    for key in keys:
        by_name[key[1].rpartition(".")[2].partition("{")[0]].append(key)
    for move in moves:
        module, routine = move.routine
        for word in move.words & by_name.keys():
            for key in by_name[word]:
                is_near = key[0] == module and key[1].rpartition(".")[0] in ("", routine)
                if is_near or not (data[key].is_local or (module, word) in data):
                    yield move, key


def _parts(value: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    fields, frames = {}, {}
    for name in vars(type(value)):
        if name in FRAMES:
            frames[name] = getattr(value, name)
        elif name == "tload":
            fields.update(_parts(value.tload)[0])
        elif not name.startswith("_"):
            fields[name] = getattr(value, name)
    return fields, frames


def shift(old: Any, new: Any) -> tuple[float, float | None]:
    """How far a pose or a target moved [mm] and turned [deg]."""
    return math.dist(old.trans_mm, new.trans_mm), _angle(old.rot, new.rot)


def is_same(distance: float, angle: float | None) -> bool:
    """Whether that is within the digits of RAPID."""
    return distance < LEAST_DISTANCE and angle is not None and angle < LEAST_ANGLE


def _angle(one: Sequence[float], other: Sequence[float]) -> float | None:
    """The angle between two quaternions [deg], of any length; None where one is zero."""
    norm = math.hypot(*one) * math.hypot(*other)
    if norm == 0.0:
        return 0.0 if list(one) == list(other) else None
    # The sine of a quarter: precise where they are close.
    sign = math.copysign(1.0, sum(a * b for a, b in zip(one, other, strict=True)))
    units = [[part / math.hypot(*it) for part in it] for it in (one, other)]
    chord = math.dist(units[0], [sign * part for part in units[1]])
    return math.degrees(4.0 * math.asin(min(chord / 2.0, 1.0)))


def setting_changes(task: str, old: Side, new: Side) -> Iterator[Change]:
    """Yield the routines with other motion settings, and how many moves follow the first one."""
    settings = _settings(old), _settings(new)
    for key in dict.fromkeys([*settings[0], *settings[1]]):
        rows = [own.get(key, []) for own in settings]
        parts = _differing(rows[0], rows[1], lambda it: it[0].lower())
        side, own = (new, parts[1]) if parts[1] else (old, parts[0])
        if own:
            _, line, module, name = own[0]
            count = sum(it.routine == key and it.line > line for it in side.moves)
            was, now = ({"text": "; ".join(it[0] for it in part) or "none"} for part in parts)
            owner = side.program.modules[module].name or ""
            what = (task, owner, f"settings of {name or 'the module'}", "changed")
            place = (side.program.files[module].path, line)
            yield Change(*what, *place, was, now, moves=count)


def _settings(side: Side) -> dict[Key, list[tuple[str, int, int, str]]]:
    """The settings of each routine: texts, lines, modules, the name as it is written."""
    found: dict[Key, list[tuple[str, int, int, str]]] = defaultdict(list)
    for index, module in enumerate(side.program.modules):
        starts = [it.line for it in module.routines]
        text, line, end = COMMENT.sub(lambda it: it[1] or "", module.source), 1, 0
        for it in SETTING.finditer(text):
            line, end = line + text.count("\n", end, it.start(1)), it.start(1)
            at = bisect(starts, line)
            name = module.routines[at - 1].name if at else ""
            row = (" ".join(it[1].split()), line, index, name)
            found[(module.name or "").lower(), name.lower()].append(row)
    return found


def _differing(old: Sequence[T], new: Sequence[T], key: Callable[[T], Any]) -> list[Sequence[T]]:
    """The parts of two rows behind their common beginning and before their common end."""
    pairs = [[*map(key, row)] for row in (old, new)]
    most = min(map(len, pairs))
    first = next((at for at in range(most) if pairs[0][at] != pairs[1][at]), most)
    ends = range(1, most - first + 1)
    last = next((at - 1 for at in ends if pairs[0][-at] != pairs[1][-at]), most - first)
    return [row[first : len(row) - last] for row in (old, new)]


def move_changes(task: str, old: Side, new: Side) -> Iterator[tuple[Change, list[Moved]]]:
    """Yield the moves of each routine that differ in one way, and these moves."""
    rows: list[dict[Key, list[Moved]]] = [defaultdict(list), defaultdict(list)]
    for side, found in zip((old, new), rows, strict=True):
        for it in side.moves:
            found[it.routine].append(it)
    for key in dict.fromkeys([*rows[0], *rows[1]]):
        parts = _differing(rows[0][key], rows[1][key], lambda it: (it.home, it.fields))
        for (kind, fields), own in _paired(*parts).items():
            first, names = own[0], [*dict.fromkeys(it.text for it in own)]
            names[NAMED:] = [".."] if len(names) > NAMED else []
            what = (task, first.module, f"move to {', '.join(names)}", kind, first.file, first.line)
            was, now = ({name: row[at] for name, *row in fields} for at in (0, 1))
            yield Change(*what, was, now, moves=len(own)), own


Differing = tuple[str, tuple[tuple[str, str, str], ...]]
"""Kind of a change; the fields that differ, as they were and as they are."""


def _paired(old: Sequence[Moved], new: Sequence[Moved]) -> dict[Differing, list[Moved]]:
    """Moves by how they differ from the one to the same target, the first from the first."""
    waiting: dict[Key, deque[tuple[int, Moved]]] = defaultdict(deque)
    for number, it in enumerate(old):
        waiting[it.home].append((number, it))
    found: dict[Differing, list[Moved]] = defaultdict(list)
    latest = -1
    for it in new:
        if not waiting[it.home]:
            found["added", ()].append(it)
            continue
        number, before = waiting[it.home].popleft()
        pairs = (
            (name, before.fields.get(name, "none"), it.fields.get(name, "none"))
            for name in {**before.fields, **it.fields}
        )
        if fields := tuple(own for own in pairs if own[1] != own[2]):
            found["changed", fields].append(it)
        elif number < latest:
            found["in another order", ()].append(it)
        latest = max(number, latest)
    if removed := sorted(own for all_own in waiting.values() for own in all_own):
        found["removed", ()] = [it for _, it in removed]
    return found


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
    was: tuple[int, ...] | None = None
    """Its confdata before, if it differs."""
    now: tuple[int, ...] | None = None
    """Its confdata now."""

    def __str__(self) -> str:
        parts = []
        if self.kind == "confdata" and self.was is not None and self.now is not None:
            parts.append(f"was {[*self.was]}, is {[*self.now]}")
        elif self.distance_mm is not None:
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
                given["was"] = tuple(old.value.robconf)
                given["now"] = tuple(new.value.robconf)
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
