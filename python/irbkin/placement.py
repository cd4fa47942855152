"""Where a robot should stand: the base from which it reaches targets with the largest margin, on a
grid, then around the best of it.

>>> import irbkin
>>> from irbkin.placement import Region, best_base
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> down = irbkin.pose([1.2, 0.3, 0.5], euler_zyx=[0, 3.1, 0])
>>> found = best_base(robot, [down], Region(x=(-0.5, 0.5), y=(-0.5, 0.5)), steps=5)
>>> found.reachable
1.0
>>> len(robot.with_base(found.base).ik(down).within_limits()) > 0
True
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin import Cell, Robot
from irbkin._arguments import Bar, Report, check_robot, reporter
from irbkin._arrays import Floats, as_array, rotations
from irbkin._equality import by_value
from irbkin._words import listed
from irbkin.errors import (
    InvalidModelError,
    InvalidMotionError,
    InvalidPoseError,
    PathError,
    UnreachableError,
)
from irbkin.freedom import ToolRotation
from irbkin.records import Plan, Status

__all__ = ["BaseGrid", "Placement", "Region", "best_base"]

MOST_BASES = 10**7
# Poses that are solved at a time: a tenth of a second and more.
IN_A_BLOCK = 1 << 18
# Paths that are planned between two looks at what is already better, for each thread.
PLANS_AT_A_TIME = 8
NOT_REACHED = -np.inf
# Bases of the grid around which is searched, how often steps are halved, and how many steps of one
# size are made at most.
STARTS, HALVINGS, MOVES = 5, 10, 100


class Region(NamedTuple):
    """Where a base may be: a box of positions, and a range of turns about z.

    A number fixes a coordinate, a pair is a range.
    """

    x: float | tuple[float, float] = 0.0
    """[m]"""
    y: float | tuple[float, float] = 0.0
    """[m]"""
    z: float | tuple[float, float] = 0.0
    """[m]"""
    turn: float | tuple[float, float] = 0.0
    """Angle about z [rad]. Of a full turn the upper end is the lower one."""


@by_value
class BaseGrid(NamedTuple):
    """The bases of the grid that were tried."""

    x: Floats
    """Positions along x [m], shape (i,)."""
    y: Floats
    """Positions along y [m], shape (j,)."""
    z: Floats
    """Positions along z [m], shape (k,)."""
    turn: Floats
    """Angles about z [rad], shape (l,)."""
    reachable: Floats
    """Share of the targets that are reached inside the limits, shape (i, j, k, l)."""
    margin: Floats
    """The smallest margin of all targets, shape (i, j, k, l). NaN where not all are reached, or
    where a path has no plan.
    """
    frame: Floats
    """The frame of these positions in the world, shape (4, 4)."""


@by_value
class Placement(NamedTuple):
    """Where a robot should stand."""

    base: Floats
    """The best base, shape (4, 4): `robot.with_base(base)`."""
    margin: float
    """The smallest margin of all targets there; NaN if they cannot all be reached."""
    reachable: float
    """Share of the targets that are reached there."""
    slack: Floats
    """The margin of each target, shape (m,); NaN where it is not reached."""
    q: Floats
    """Joint angles with that margin [rad], shape (m, 6); of a path, the joints of its plan. NaN
    where a target is not reached.
    """
    tool_angle: Floats
    """The angle that the tool is turned by [rad], shape (m,); zeros without a free rotation."""
    nowhere: tuple[int, ...]
    """The targets that are reached from no base that was tried."""
    plan: Plan | None
    """The plan of a path; None without `path` or without a plan."""
    grid: BaseGrid
    """The values of the grid."""
    reason: str
    """The outcome in a sentence."""

    def __repr__(self) -> str:
        return f"<Placement: {self.reason}; {self.grid.margin.size:,} bases on the grid>"


@dataclass(frozen=True, slots=True)
class Bases:
    """The bases of a region: x, y, z [m] and turn [rad] each."""

    low: Floats
    high: Floats
    steps: tuple[int, ...]
    """Values across each coordinate."""
    start: Floats
    """From which positions are given, with the orientation of the base, shape (4, 4)."""
    mounting: Floats
    """Orientation of the base where the turn is zero, shape (4, 4)."""

    @classmethod
    def of(
        cls,
        region: Region,
        steps: int | Sequence[int],
        frame: npt.ArrayLike | None,
        robot: Robot,
    ) -> Bases:
        """Read a region; an InvalidPoseError for a range or steps that are none."""
        if not isinstance(region, Region):
            raise InvalidPoseError(
                f"region must be a Region, got {region!r}: give Region(x=(lower, upper), ...)"
            )
        ranges = np.array([_range(name, getattr(region, name)) for name in Region._fields])
        low, high = ranges.T
        if high[3] - low[3] > 2 * np.pi + 1e-9:
            raise InvalidPoseError(
                f"region.turn is {region.turn}, more than a full turn (did you pass degrees?)"
            )
        counts = tuple(steps) if isinstance(steps, Sequence) else (steps,) * 4
        if len(counts) != 4 or any(not isinstance(n, int) or n < 1 for n in counts):
            raise InvalidPoseError(f"steps must be 1 or more, or four such numbers, got {steps!r}")
        counts = tuple(n if b > a else 1 for n, a, b in zip(counts, low, high, strict=True))
        if np.prod(counts, dtype=float) > MOST_BASES:
            raise InvalidPoseError(f"steps {counts} are more than {MOST_BASES} bases")
        mounting = np.eye(4)
        mounting[:3, :3] = robot.base[:3, :3]
        start = np.eye(4)
        if frame is not None:
            try:
                start = robot.with_base(frame).base
            except InvalidPoseError as fault:
                raise InvalidPoseError(f"frame: {fault}") from None
        return cls(low, high, counts, start, mounting)

    @property
    def is_full_turn(self) -> bool:
        """Whether the turns go all around."""
        return bool(self.high[3] - self.low[3] > 2 * np.pi - 1e-9)

    def axes(self) -> list[Floats]:
        ends = [True, True, True, not self.is_full_turn]
        return [
            np.linspace(a, b, n, endpoint=end) if n > 1 else np.array([0.5 * (a + b)])
            for a, b, n, end in zip(self.low, self.high, self.steps, ends, strict=True)
        ]

    def grid(self) -> Floats:
        """Every base of the grid, shape (k, 4)."""
        axes = np.meshgrid(*self.axes(), indexing="ij")
        return np.stack(axes, axis=-1).reshape(-1, 4)

    def spacing(self) -> Floats:
        """The distance of neighbors on the grid, shape (4,); half the range of one value."""
        width = self.high - self.low
        count = np.array(self.steps) - np.array([1, 1, 1, 0 if self.is_full_turn else 1])
        return np.where(count > 0, width / np.maximum(count, 1), width / 2)

    def around(self, values: Floats, step: Floats) -> Floats:
        """The neighbors of a base, one step along each coordinate or several, shape (k, 4)."""
        free = np.flatnonzero(self.high > self.low)
        moves = np.zeros((3 ** len(free), 4))
        moves[:, free] = list(product((0.0, -1.0, 1.0), repeat=len(free)))
        near = values + moves[1:] * step
        if self.is_full_turn:
            near[:, 3] = self.low[3] + (near[:, 3] - self.low[3]) % (2 * np.pi)
        near = np.clip(near, self.low, self.high)
        return np.asarray(near[(near != values).any(axis=1)])

    def poses(self, values: Floats) -> Floats:
        placed = rotations(2, values[:, 3])
        placed[:, :3, 3] = values[:, :3]
        return self.start @ placed @ self.mounting


def _range(name: str, given: float | tuple[float, float]) -> tuple[float, float]:
    try:
        ends = np.broadcast_to(np.asarray(given, dtype=float), 2)
    except (TypeError, ValueError) as fault:
        raise InvalidPoseError(
            f"region.{name} must be a number or a pair (lower, upper), got {given!r}"
        ) from fault
    low, high = ends.tolist()
    if not (np.isfinite(ends).all() and low <= high):
        raise InvalidPoseError(
            f"region.{name} is {given!r}: lower and upper must be finite, in this order"
        )
    return low, high


def ranked(scores: Floats) -> npt.NDArray[np.int64]:
    """Indices of rows of `Scene.scores`, the best first; of equal ones, the first first."""
    reached, progress, margin = scores.T
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
        self.anywhere = np.zeros(len(self.targets), dtype=bool)
        """Which targets some base that was tried reaches, shape (m,)."""

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

    def scores(self, bases: Floats, above: float | None = None) -> Floats:
        """Return the value of bases, shape (k, 4, 4), as rows of which the first number that
        differs decides: how many targets are reached; of a path that is reached, how far a plan
        comes, 1 for a whole one; the smallest margin of the targets that are reached.

        Of a path, plans are left out that cannot have a margin above one that is given.
        """
        reached, margin = np.zeros(len(bases)), np.full(len(bases), np.inf)
        views = np.linalg.inv(bases)
        at_once = max(1, IN_A_BLOCK // (len(self.targets) * len(self.angles)))
        for first in range(0, len(bases), at_once):
            rows = slice(first, first + at_once)
            seen = views[rows, None, None] @ self.turned
            best = np.fmax.reduce(self.robot.ik_margin(seen, threads=self.threads).margin, axis=2)
            is_reached = ~np.isnan(best)
            self.anywhere |= is_reached.any(axis=0)
            reached[rows] = is_reached.sum(axis=1)
            margin[rows] = np.where(is_reached, best, np.inf).min(axis=1)
        margin[reached == 0] = NOT_REACHED
        scores = np.column_stack([reached, np.ones(len(bases)), margin])
        return self._planned(bases, scores, above) if self.path else scores

    def _planned(self, bases: Floats, bounds: Floats, above: float | None) -> Floats:
        """Plans from the bases that reach all of a path, as long as one can be the best."""
        reached, _, most = bounds.T
        progress, margin = np.zeros(len(bases)), most.copy()
        whole = reached == len(self.targets)
        margin[whole] = NOT_REACHED
        order = [int(index) for index in ranked(bounds) if whole[index]]
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
        return np.column_stack([reached, progress, margin])

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


def best_base(
    robot: Robot,
    T: npt.ArrayLike,
    region: Region,
    *,
    path: bool = False,
    rotation: ToolRotation | int | None = None,
    steps: int | Sequence[int] = 9,
    refine: bool = True,
    frame: npt.ArrayLike | None = None,
    cell: Cell | None = None,
    threads: int = 1,
    progress: Report | Bar | None = None,
) -> Placement:
    """Where a robot should stand so that it reaches all targets with the largest margin.

    The margin of a base is the smallest of all targets, the margin of a target the largest of its
    solutions inside the limits: their distance from limits and singularities, `Robot.margin`. With
    `path`, it is taken along the joints of `robot.plan`, without breaks. First each base of a grid
    is tried, then steps that are halved ten times are made around the five best ones.

    Args:
        robot: The arm, with its tool. The orientation of its base is the mounting: a
            hanging robot is one whose base is turned over. Its position does not count.
        T: Targets, shape (m, 4, 4), translation [m].
        region: Where the base may be.
        path: Whether the targets are a path that the robot follows from one to the next.
        rotation: The angles by which the tool may be turned, as for `robot.plan`.
        steps: Number of values across each range of the region, or four such numbers.
        refine: Whether to search around the best of the grid.
        frame: Frame in which the region is given, shape (4, 4); the world where not given.
        cell: Obstacles in the world among which the plan of a path is proven free; with `path`.
        threads: Number of threads; 0 for one a core.
        progress: Called with the number of steps that are done, and of all: the bases of the grid,
            then each halving around one of the best; or a bar as `tqdm.tqdm()`.

    Returns:
        The best base, with what was tried. Where no base reaches all targets, that which reaches
        most; `reason` says which targets are reached nowhere. There is no exception for that.

    Raises:
        InvalidPoseError: T has a wrong shape or a matrix that is not a pose, or a region, steps
            or frame that are none.
        InvalidMotionError: A rotation that is empty; of a path, two poses half a turn apart; a cell
            without path.
        InvalidModelError: The arm has seven joints.
    """
    check_robot(robot)
    report = reporter(progress)
    bases = Bases.of(region, steps, frame, robot)
    scene = Scene(robot, T, rotation, path, cell, threads)
    values = bases.grid()
    poses = scene.turned.shape[0] * scene.turned.shape[1]
    # A plan of a path takes longer than all of its poses.
    size = max(1, IN_A_BLOCK // poses) if not path else PLANS_AT_A_TIME * max(threads, 1)
    total = len(values) + (HALVINGS * min(STARTS, len(values)) if refine else 0)
    ordered = []
    for first in range(0, len(values), size):
        ordered.append(scene.scores(bases.poses(values[first : first + size])))
        report(min(first + size, len(values)), total)
    scores = np.concatenate(ordered)
    starts = [Start(values[i], scores[i].tolist()) for i in ranked(scores)[:STARTS]]
    best = starts[0]
    for number, start in enumerate(starts if refine else []):
        end = _refined(scene, bases, start, (report, len(values) + number * HALVINGS, total))
        if end.score > best.score:
            best = end
    return _answer(scene, bases, scores, best)


class Start(NamedTuple):
    """A base from which is searched, or that was found."""

    value: Floats
    """x, y, z [m] and turn [rad]."""
    score: list[float]
    """Its row of `Scene.scores`."""


def _refined(scene: Scene, bases: Bases, start: Start, watched: tuple[Report, int, int]) -> Start:
    """The best base that steps of falling size lead to."""
    value, score = start
    report, done, total = watched
    step = 0.5 * bases.spacing()
    for halving in range(HALVINGS):
        for _ in range(MOVES):
            around = bases.around(value, step)
            if not len(around):
                break
            above = score[2] if score[1] == 1.0 else NOT_REACHED
            scores = scene.scores(bases.poses(around), above)
            best = ranked(scores)[0]
            found: list[float] = scores[best].tolist()
            if found <= score:
                break
            value, score = around[best], found
        step = 0.5 * step
        report(done + halving + 1, total)
    return Start(value, score)


def _answer(scene: Scene, bases: Bases, scores: Floats, found: Start) -> Placement:
    value, score = found
    base = bases.poses(value[None])[0]
    count = len(scene.targets)
    is_reached = score[0] == count and score[1] == 1.0
    q, angles, slack = _joints(scene, base)
    plan, end = None, ""
    if scene.path and score[0] == count:
        answer = scene.plans(base[None])[0]
        if isinstance(answer, Plan):
            plan, q, angles = answer, answer.q, answer.tool_angle
            slack = np.fmin(*scene.robot.margin(q))
        else:
            end = str(answer)
    nowhere = tuple(np.flatnonzero(~scene.anywhere).tolist())
    reached, progress, margin = scores.T
    whole = (reached == count) & (progress == 1.0)
    axes = bases.axes()
    shape = tuple(map(len, axes))
    share = (reached / count).reshape(shape)
    tightest = np.where(whole, margin, np.nan).reshape(shape)
    x, y, z, turn = axes
    grid = BaseGrid(x, y, z, turn, share, tightest, bases.start)
    *xyz, angle = value.tolist()
    place = "({:.3f}, {:.3f}, {:.3f}) m, turned by {:.1f} deg".format(*xyz, np.degrees(angle))
    if is_reached:
        tight = int(np.argmin(slack))
        reason = (
            f"all {count} targets are reached from {place}, with a margin of {score[2]:.3f} at "
            f"target {tight}"
        )
    elif score[0] == count:
        reason = f"all {count} targets are reached from {place}, but no plan follows them: {end}"
    else:
        reason = f"at most {int(score[0])} of {count} targets are reached, from {place}"
        if nowhere:
            reason += (
                f"; from no base that was tried: target{'s' * (len(nowhere) > 1)} {listed(nowhere)}"
            )
    return Placement(
        base=base,
        margin=score[2] if is_reached else np.nan,
        reachable=score[0] / count,
        slack=slack,
        q=q,
        tool_angle=angles,
        nowhere=nowhere,
        plan=plan,
        grid=grid,
        reason=reason,
    )


def _joints(scene: Scene, base: Floats) -> tuple[Floats, Floats, Floats]:
    """Joint angles, tool angle (else 0) and margin of each target from a base; NaN if unreached."""
    seen = np.linalg.inv(base) @ scene.turned
    by_angle = scene.robot.ik_margin(seen, threads=scene.threads).margin
    best = np.argmax(np.where(np.isnan(by_angle), NOT_REACHED, by_angle), axis=1)
    rows = np.arange(len(best))
    solved = scene.robot.ik_batch(seen[rows, best], threads=scene.threads)
    low, high = scene.robot.limits.T
    middle = 0.5 * (low + high)
    turns = np.round((middle - solved.q) / (2 * np.pi))
    q = solved.q + 2 * np.pi * np.where(np.isfinite(turns), turns, 0.0)
    margin = np.fmin(*scene.robot.margin(q))
    margin[(solved.status & Status.WITHIN_LIMITS) == 0] = NOT_REACHED
    slot = np.argmax(margin, axis=1)
    slack = margin[rows, slot]
    is_reached = slack > NOT_REACHED
    return (
        np.where(is_reached[:, None], q[rows, slot], np.nan),
        np.where(is_reached, scene.angles[best], 0.0),
        np.where(is_reached, slack, np.nan),
    )
