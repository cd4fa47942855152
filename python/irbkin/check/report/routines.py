"""Summary of the routines of a report: nearest limits and singularities, unused names."""

import math
from collections import Counter
from collections.abc import Sequence

import numpy as np

from irbkin import Robot
from irbkin._files import shown
from irbkin.check.codes import UNUSED
from irbkin.check.report import Report, counted
from irbkin.rapid import CheckedMove

HEADINGS = (
    "routine", "moves", "assumed", "not checked", "errors", "warnings", "nearest limit",
    "nearest singularity",
)  # fmt: skip
COUNTS = 6
"""End of the numeric columns, which begin at 1."""
KINDS = {
    "robtarget": "target",
    "jointtarget": "target",
    "tooldata": "tool",
    "wobjdata": "work object",
}
"""Nouns for data by type; any other unused name is a routine."""


def routines(report: Report) -> dict[str, list[tuple[str, ...]]]:
    """Return the cells below `HEADINGS` of each routine that moves, by its file and arm."""
    counts = Counter((found.file, found.routine or "", found.severity) for found in report.findings)
    tables: dict[str, list[tuple[str, ...]]] = {}
    for job, checked in report.programs:
        groups: dict[tuple[int, str], list[CheckedMove]] = {}
        for move in checked.moves:
            groups.setdefault((move.module, move.routine or ""), []).append(move)
        for (module, routine), moves in groups.items():
            file = shown(job.program.files[module].path)
            assumed = sum(move.assumed for move in moves)
            left = sum(move.unchecked is not None for move in moves)
            wrong = [counts[file, routine, level] for level in ("error", "warning")]
            numbers = [str(count or "") for count in (len(moves), assumed, left, *wrong)]
            near = _nearest(job.robot, [move for move in moves if move.q is not None])
            tables.setdefault(f"{file} ({job.title})", []).append((routine, *numbers, *near))
    return tables


def unused(report: Report) -> str:
    """A sentence on unused names; empty without any."""
    kinds = Counter[str]()
    for job, checked in report.programs:
        found = (own for own in checked.findings if own.code == UNUSED)
        places = [(own.module, own.line, own.column) for own in found]
        types = {
            (index, data.line, data.column): data.data_type.lower()
            for index in {module for module, *_ in places}
            for data in job.program.modules[index].declarations
        }
        kinds.update(KINDS.get(types.get(place, ""), "routine") for place in places)
    parts = [counted(count, kind) for kind, count in kinds.items()]
    return f"Nothing in the program names: {', '.join(parts)} (--select {UNUSED})." if parts else ""


def _nearest(robot: Robot | None, moves: Sequence[CheckedMove]) -> tuple[str, str]:
    """The nearest limit and the nearest singularity of the targets of moves, each with its line."""
    if robot is None or not moves:
        return "", ""
    q = np.array([move.q for move in moves])
    lower, upper = robot.limits.T
    rooms = np.minimum(q - lower, upper - q)
    index, joint = np.unravel_index(rooms.argmin(), rooms.shape)
    limit = f"J{joint + 1} {math.degrees(rooms[index, joint]):.1f} deg, line {moves[index].line}"
    at = robot.singularity(q)
    # The shoulder distance is a length: only the two angles are comparable.
    angles = {"wrist": np.degrees(at.wrist), "elbow": np.degrees(at.elbow)}
    known = [name for name, own in angles.items() if np.isfinite(own).any()]
    if not known:
        return limit, ""
    name = min(known, key=lambda name: np.nanmin(angles[name]))
    index = int(np.nanargmin(angles[name]))
    return limit, f"{name} {angles[name][index]:.1f} deg, line {moves[index].line}"
