"""The best base: on a grid, then around the best of it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin import Cell, Robot
from irbkin._arguments import Bar, Report, check_robot, reporter
from irbkin._arrays import Floats
from irbkin._grids import BaseGrid, Placement, Region
from irbkin._words import listed
from irbkin.freedom import ToolRotation
from irbkin.placement._region import Bases
from irbkin.placement._scene import NOT_REACHED, PLANS_AT_A_TIME, Flags, Scene, Scores
from irbkin.records import Plan, Status

# Bases of the grid around which is searched, how often steps are halved, and how many steps of one
# size are made at most.
STARTS, HALVINGS, MOVES = 5, 10, 100
# Poses of a block of bases: a tenth of a second and more.
IN_A_BLOCK = 1 << 18


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
    scores = Scores(
        np.concatenate([part.values for part in ordered]),
        np.any([part.anywhere for part in ordered], axis=0),
    )
    best_ones = scores.ranked()[:STARTS]
    starts = [Start(values[i], scores.values[i].tolist(), scores.anywhere) for i in best_ones]
    best = starts[0]
    if refine:
        for number, start in enumerate(starts):
            end = _refined(scene, bases, start, (report, len(values) + number * HALVINGS, total))
            best = best._replace(anywhere=best.anywhere | end.anywhere)
            if end.score > best.score:
                best = end._replace(anywhere=best.anywhere)
    return _answer(scene, bases, scores, best)


class Start(NamedTuple):
    """A base from which is searched, or that was found."""

    value: Floats
    """x, y, z [m] and turn [rad]."""
    score: list[float]
    """A row of `Scores.values`."""
    anywhere: Flags
    """Which targets some base that was tried reaches."""


def _refined(scene: Scene, bases: Bases, start: Start, watched: tuple[Report, int, int]) -> Start:
    """The best base that steps of falling size lead to."""
    value, score, anywhere = start
    report, done, total = watched
    step = 0.5 * bases.spacing()
    for halving in range(HALVINGS):
        for _ in range(MOVES):
            around = bases.around(value, step)
            if not len(around):
                break
            above = score[2] if score[1] == 1.0 else NOT_REACHED
            scores = scene.scores(bases.poses(around), above)
            anywhere = anywhere | scores.anywhere
            best = scores.ranked()[0]
            found: list[float] = scores.values[best].tolist()
            if found <= score:
                break
            value, score = around[best], found
        step = 0.5 * step
        report(done + halving + 1, total)
    return Start(value, score, anywhere)


def _answer(scene: Scene, bases: Bases, scores: Scores, found: Start) -> Placement:
    value, score, anywhere = found
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
    nowhere = tuple(np.flatnonzero(~anywhere).tolist())
    reached, progress, margin = scores.values.T
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
