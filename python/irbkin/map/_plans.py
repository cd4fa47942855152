"""Plans of many paths, in blocks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from irbkin._arguments import check_robot
from irbkin._blocks import worked
from irbkin.errors import InvalidMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    import numpy.typing as npt

    from irbkin import (
        IrbkinError,
        Plan,
        Positioner,
        Robot,
        ToolCone,
        ToolOffset,
        ToolRotation,
        Track,
    )
    from irbkin._arrays import Floats
    from irbkin._blocks import Client

# The number of the first path, the paths, and what each has of its own.
Job = tuple[int, list[Any], dict[str, Any]]

PATHS_IN_A_BLOCK = 32


def plan_batch(
    robot: Robot,
    paths: Iterable[npt.ArrayLike],
    *,
    rotation: ToolRotation | int | None = None,
    times: Iterable[npt.ArrayLike] | None = None,
    start: npt.ArrayLike | None = None,
    end: npt.ArrayLike | None = None,
    closed: bool = False,
    weights: npt.ArrayLike | None = None,
    accept: Callable[[Floats], npt.ArrayLike] | None = None,
    carrier: Track | Positioner | Sequence[Track | Positioner] | None = None,
    tolerance: ToolCone | ToolOffset | Sequence[ToolCone | ToolOffset] | None = None,
    order: Literal["bottleneck", "sum"] = "bottleneck",
    limit_cost: float = 0.0,
    singularity_cost: float = 0.0,
    client: Client | None = None,
    threads: int = 1,
    block: int = PATHS_IN_A_BLOCK,
) -> tuple[Plan | IrbkinError, ...]:
    """`Robot.plan_batch` by the workers of a cluster, with the same answers.

    Args:
        robot: The arm.
        paths: p paths, each of shape (m, 4, 4).
        rotation: As for `Robot.plan`, of all paths.
        times: Times of each path [s], p arrays of shape (m,).
        start: Joint vector at the first pose [rad], shape (6,) or (p, 6); with the values of k
            external axes behind it, (6 + k,) or (p, 6 + k).
        end: The same at the last pose.
        closed: As for `Robot.plan`, of all paths.
        weights: As for `Robot.plan`, of all paths.
        accept: As for `Robot.plan`; for a cluster a function that pickles.
        carrier: As for `Robot.plan`, of all paths.
        tolerance: As for `Robot.plan`, of all paths.
        order: As for `Robot.plan`, of all paths.
        limit_cost: As for `Robot.plan`, of all paths.
        singularity_cost: As for `Robot.plan`, of all paths.
        client: A `distributed.Client`; without one it is `Robot.plan_batch` itself.
        threads: Number of threads for each block; 0 for one a core.
        block: Paths of a block.

    Returns:
        One answer for each path, in order, as `Robot.plan_batch`.

    Raises:
        IrbkinError: As `Robot.plan_batch`.
        ValueError: A block below 1, or another `order`.
    """
    check_robot(robot)
    if block < 1:
        raise ValueError(f"block is {block}, it must be at least 1")
    options: dict[str, Any] = {
        "rotation": rotation,
        "closed": closed,
        "weights": weights,
        "accept": accept,
        "carrier": carrier,
        "tolerance": tolerance,
        "order": order,
        "limit_cost": limit_cost,
        "singularity_cost": singularity_cost,
        "threads": threads,
    }
    if client is None:
        return robot.plan_batch(paths, times=times, start=start, end=end, **options)
    rows = [np.asarray(path) for path in paths]
    given = None if times is None else list(times)
    # What is wrong with the call is found before any work.
    robot.plan_batch([row[:0] for row in rows], start=start, end=end, **options)
    if given is not None and len(given) != len(rows):
        raise InvalidMotionError(
            f"times must be {len(rows)} arrays, one for each path, got {len(given)}"
        )
    jobs = []
    for first in range(0, len(rows), block):
        now = slice(first, first + block)
        each = {
            "times": None if given is None else given[now],
            "start": _of(start, now),
            "end": _of(end, now),
        }
        jobs.append((first, rows[now], each))
    answers: dict[int, tuple[Plan | IrbkinError, ...]] = {}
    for job, planned in worked(client, _planned, (robot, options), jobs):
        answers[job[0]] = planned
    return tuple(answer for first in sorted(answers) for answer in answers[first])


def _of(q: npt.ArrayLike | None, now: slice) -> npt.ArrayLike | None:
    """The joint vectors of some paths; one for all paths stays one."""
    return q if q is None or np.ndim(q) < 2 else np.asarray(q)[now]


def _planned(shared: tuple[Robot, dict[str, Any]], job: Job) -> tuple[Plan | IrbkinError, ...]:
    robot, options = shared
    _, paths, each = job
    return robot.plan_batch(paths, **options, **each)
