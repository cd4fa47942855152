"""A program at a glance: its routines, where they come near limits, names that nothing uses."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from irbkin.cli.files import shown
from irbkin.cli.findings import Found, counted

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.cli.jobs import Job
    from irbkin.rapid import Checked, CheckedMove

UNUSED = "U807"
KINDS = {
    "robtarget": "target",
    "jointtarget": "target",
    "tooldata": "tool",
    "wobjdata": "work object",
}
"""First words of findings on unused data; other findings are on routines."""


class RoutineRow(NamedTuple):
    """A routine: where it is, its moves, its findings, and where it comes nearest to something."""

    robot: str
    file: str
    routine: str
    moves: int
    unchecked: int
    errors: int
    warnings: int
    limit: str
    singularity: str


class Verdict(NamedTuple):
    """The routines that move, and how many names of each kind nothing uses."""

    routines: Sequence[RoutineRow]
    unused: Counter[str]

    def unused_words(self) -> str:
        """A sentence on names that nothing uses, or nothing."""
        if not self.unused:
            return ""
        parts = [counted(count, kind) for kind, count in self.unused.items()]
        return f"Nothing in the program names: {', '.join(parts)} (--select {UNUSED})."


HEADINGS = (
    "routine", "moves", "not checked", "errors", "warnings", "nearest limit", "nearest singularity"
)  # fmt: skip

COUNTS = 5
"""The columns before this one, but the first, are numbers."""


def cells(row: RoutineRow) -> tuple[str, ...]:
    """Return the cells of a row, below `HEADINGS`."""
    numbers = (row.moves, row.unchecked, row.errors, row.warnings)
    return (row.routine, *(str(it) if it else "" for it in numbers), row.limit, row.singularity)


def verdict_of(programs: Iterable[tuple[Job, Checked]], found: Sequence[Found]) -> Verdict:
    """Return the verdict on programs, with the findings that are wanted on them."""
    counts: Counter[tuple[str, str, str]] = Counter(
        (it.file, it.routine or "", it.severity) for it in found
    )
    rows, unused = [], Counter[str]()
    for job, checked in programs:
        unused.update(
            KINDS.get(it.message.split(" ")[0], "routine")
            for it in checked.findings
            if it.code == UNUSED
        )
        groups: dict[tuple[int, str], list[CheckedMove]] = {}
        for move in checked.moves:
            groups.setdefault((move.module, move.routine or ""), []).append(move)
        for (module, routine), moves in groups.items():
            file = shown(job.program.files[module].path)
            rows.append(
                RoutineRow(
                    job.title, file, routine, len(moves),
                    sum(it.unchecked is not None for it in moves),
                    counts[file, routine, "error"], counts[file, routine, "warning"],
                    *_nearest(job.robot, [it for it in moves if it.q is not None]),
                )
            )  # fmt: skip
    return Verdict(rows, unused)


def _nearest(robot: Robot, moves: Sequence[CheckedMove]) -> tuple[str, str]:
    """The nearest limit and the nearest singularity of the targets of moves, each with its line."""
    import numpy as np

    if not moves:
        return "", ""
    q = np.array([it.q for it in moves])
    lower, upper = robot.limits.T
    rooms = np.minimum(q - lower, upper - q)
    index, joint = np.unravel_index(rooms.argmin(), rooms.shape)
    limit = f"J{joint + 1} {math.degrees(rooms[index, joint]):.1f} deg, line {moves[index].line}"
    at = robot.singularity(q)
    kinds = {"wrist": np.degrees(at.wrist), "elbow": np.degrees(at.elbow)}
    # Of the two that are angles, the nearest.
    known = {name: it for name, it in kinds.items() if np.isfinite(it).any()}
    if not known:
        return limit, ""
    name = min(known, key=lambda it: np.nanmin(known[it]))
    index = int(np.nanargmin(known[name]))
    return limit, f"{name} {known[name][index]:.1f} deg, line {moves[index].line}"
