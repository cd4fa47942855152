"""Targets as they are seen from bases: which are reached, and with what margin."""

import os
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin import Cell, Robot
from irbkin._arrays import Floats, as_array, rotations
from irbkin.errors import (
    InvalidModelError,
    InvalidMotionError,
    InvalidPoseError,
    PathError,
    UnreachableError,
)
from irbkin.freedom import ToolRotation
from irbkin.records import Plan, Status

Flags = npt.NDArray[np.bool_]

# Poses that are solved at a time: some megabytes.
AT_A_TIME = 1 << 15
# Paths that are planned between two looks at what is already better, for each thread.
PLANS_AT_A_TIME = 8
NOT_REACHED = -np.inf


class Scores(NamedTuple):
    """The value of bases."""

    values: Floats
    """Number of targets that are reached; of a path that is reached, how far a plan comes, 1 for a
    whole one; smallest margin of the targets that are reached; shape (k, 3). The first that differs
    decides.
    """
    anywhere: Flags
    """Which targets some of the bases reaches, shape (m,)."""

    def ranked(self) -> npt.NDArray[np.int64]:
        """Indices, the best first; of equal ones, the first first."""
        reached, progress, margin = self.values.T
        return np.lexsort((-np.arange(len(margin)), margin, progress, reached))[::-1]


class Scene:
    """Targets or a path, and the arm that is to reach them."""

    def __init__(
        self,
        robot: Robot,
        T: npt.ArrayLike,
        rotation: ToolRotation | int | None,
        path: bool,
        cell: Cell | None,
        threads: int,
    ) -> None:
        if cell is not None and not path:
            raise InvalidMotionError(
                "cell goes with path=True: a plan is proven free, not a target"
            )
        if robot.dof != 6:
            raise InvalidModelError(
                f"best_base takes arms of six joints, {robot.name} has {robot.dof}"
            )
        self.robot = robot.with_base(np.eye(4))
        self.targets = as_array(T, "T", (None, 4, 4), InvalidPoseError)
        if rotation is not None and not isinstance(rotation, ToolRotation):
            given = rotation if isinstance(rotation, tuple) else (rotation,)
            rotation = ToolRotation(*given)
        self.rotation = rotation
        self.path, self.cell, self.threads = path, cell, threads
        self._check()
        own = ToolRotation(1, 0.0, 0.0) if rotation is None else rotation
        is_full = own.upper - own.lower > 2 * np.pi - 1e-9
        self.angles = np.linspace(own.lower, own.upper, own.steps, endpoint=not is_full)
        """The angles of the tool [rad], shape (b,)."""
        self.turned = self.targets[:, None] @ rotations("xyz".index(own.axis), self.angles)

    def _check(self) -> None:
        """Refuse what is not a pose, and what no plan would take, as `ik` and `plan` do."""
        invalid = (self.robot.ik_batch(self.targets).status & Status.INVALID).any(axis=1)
        for index in np.flatnonzero(invalid):
            try:
                self.robot.ik(self.targets[index])
            except InvalidPoseError as fault:
                raise InvalidPoseError(f"T[{index}]: {fault}") from None
        try:
            self.robot.plan(self.targets if self.path else self.targets[:1], rotation=self.rotation)
        except UnreachableError:
            return

    def scores(self, bases: Floats, above: float | None = None) -> Scores:
        """Return the value of bases, shape (k, 4, 4).

        Of a path, plans are left out that cannot have a margin above one that is given.
        """
        reached, margin = np.zeros(len(bases)), np.full(len(bases), np.inf)
        anywhere = np.zeros(len(self.targets), dtype=bool)
        views = np.linalg.inv(bases)
        block = max(1, AT_A_TIME // len(self.angles))
        for first in range(0, len(self.targets), block):
            turned = self.turned[first : first + block]
            at_once = max(1, AT_A_TIME // (len(turned) * len(self.angles)))
            for base in range(0, len(bases), at_once):
                seen = views[base : base + at_once, None, None] @ turned
                found = self.robot.ik_margin(seen, threads=self.threads).margin
                best = np.fmax.reduce(found, axis=2)
                is_reached = ~np.isnan(best)
                anywhere[first : first + block] |= is_reached.any(axis=0)
                reached[base : base + at_once] += is_reached.sum(axis=1)
                least = np.where(is_reached, best, np.inf).min(axis=1)
                margin[base : base + at_once] = np.minimum(margin[base : base + at_once], least)
        margin[reached == 0] = NOT_REACHED
        scores = Scores(np.column_stack([reached, np.ones(len(bases)), margin]), anywhere)
        return self._planned(bases, scores, above) if self.path else scores

    def _planned(self, bases: Floats, bounds: Scores, above: float | None) -> Scores:
        """Plans from the bases that reach all of a path, as long as one can be the best."""
        reached, _, most = bounds.values.T
        progress, margin = np.zeros(len(bases)), most.copy()
        whole = reached == len(self.targets)
        margin[whole] = NOT_REACHED
        order = [int(index) for index in bounds.ranked() if whole[index]]
        block = PLANS_AT_A_TIME * max(self.threads, 1)
        best = NOT_REACHED if above is None else above
        while order:
            now, order = order[:block], order[block:]
            # A plan has angles beside those on the grid: then its margin has no bound.
            is_bounded = above is not None and self.rotation is None
            if is_bounded and most[now[0]] <= best:
                break
            for index, answer in zip(now, self.plans(bases[now]), strict=True):
                if isinstance(answer, Plan):
                    progress[index] = 1.0
                    margin[index] = np.fmin(*self.robot.margin(answer.q)).min()
                    best = max(best, margin[index])
                else:
                    progress[index] = answer.index / len(self.targets)
        return Scores(np.column_stack([reached, progress, margin]), bounds.anywhere)

    def plans(self, bases: Floats) -> list[Plan | PathError]:
        """The plan of the path from each base; threads plan without the interpreter's lock."""
        if self.threads == 1:
            return [self._plan(base) for base in bases]
        with ThreadPoolExecutor(self.threads or os.cpu_count()) as pool:
            return list(pool.map(self._plan, bases))

    def _plan(self, base: Floats) -> Plan | PathError:
        robot = self.robot.with_base(base)
        try:
            return robot.plan(self.targets, rotation=self.rotation, cell=self.cell)
        except PathError as error:
            return error
