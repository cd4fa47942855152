"""Maps of reach and dexterity over a grid of positions and orientations; docs/guide/recipes.md has
one of many processes.

>>> import irbkin, irbkin.map
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> spread = irbkin.map.orientations(20)
>>> found = irbkin.map.reach(robot, [0.6, 0.9], 0.0, [0.5, 1.0], spread)
>>> found.share.shape
(2, 1, 2)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from os import PathLike
from typing import IO, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report, check_robot, count, reporter
from irbkin._arrays import Floats, all_poses, as_array, finite, rotations
from irbkin._core import Cell, Robot
from irbkin._equality import by_value
from irbkin._files import write_columns
from irbkin._words import counted
from irbkin.errors import InvalidPoseError

__all__ = ["ReachMap", "orientations", "reach"]

# Poses of a block: a tenth of a second and more.
IN_A_BLOCK = 1 << 18


@by_value
class ReachMap(NamedTuple):
    """The reach of an arm: a grid of positions, each with every orientation."""

    x: Floats
    """Positions along x [m], shape (i,)."""
    y: Floats
    """Positions along y [m], shape (j,)."""
    z: Floats
    """Positions along z [m], shape (k,)."""
    orientations: Floats
    """Orientations of the tool, shape (o, 3, 3)."""
    reached: npt.NDArray[np.int64]
    """Number of orientations that are reached inside the limits and without a collision, shape (i,
    j, k).
    """
    solutions: npt.NDArray[np.int64]
    """Number of these solutions, all orientations together, shape (i, j, k)."""
    margin: Floats
    """The smallest margin of the orientations that are reached, the margin of an orientation being
    `IkMargin.margin`, shape (i, j, k). NaN where none is reached.
    """
    singularities: Floats
    """`IkMargin.singularities` in the same way: the worst distance from singularities."""

    @property
    def share(self) -> Floats:
        """Share of the orientations that are reached, shape (i, j, k)."""
        return self.reached / len(self.orientations)

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the positions as columns, of which `pandas.DataFrame` and `polars.DataFrame` make
        a table.

        Returns:
            Arrays of shape (i * j * k,) by name, z the fastest: `x`, `y`, `z` [m]; `reached`,
            `share`, `solutions`, `margin`, `singularities`.
        """
        places = np.meshgrid(self.x, self.y, self.z, indexing="ij")
        names = ("reached", "share", "solutions", "margin", "singularities")
        columns = dict(zip("xyz", places, strict=True), **{it: getattr(self, it) for it in names})
        return {name: column.flatten() for name, column in columns.items()}

    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write the columns of `to_dict`, separated by commas, under a line of their names.

        Args:
            path_or_file: A path, or a file that is open for text.

        Raises:
            OSError: It cannot be written.
        """
        write_columns(self.to_dict(), path_or_file)

    def __repr__(self) -> str:
        axes, share = (self.x, self.y, self.z), self.share
        sizes = " x ".join(map(str, share.shape))
        ends = (
            f"{name} {axis[0]:g}" + (f" .. {axis[-1]:g}" if len(axis) > 1 else "")
            for name, axis in zip("xyz", axes, strict=True)
        )
        best = np.unravel_index(share.argmax(), share.shape)
        place = ", ".join(f"{axis[i]:g}" for axis, i in zip(axes, best, strict=True))
        some, every = np.count_nonzero(share), np.count_nonzero(share == 1)
        return (
            f"<ReachMap: {sizes} positions, {counted(len(self.orientations), 'orientation')} each\n"
            f"{', '.join(ends)} m\n"
            f"reached: {share.mean():.1%} of all poses; {some:,} of {share.size:,} positions, "
            f"{every:,} in every orientation\n"
            f"best: {share.max():.1%} at ({place}) m>"
        )


def orientations(directions: int, turns: int = 1) -> Floats:
    """Return orientations that are spread evenly: directions of the tool's z axis on a spiral
    around the sphere, each with turns about it.

    Args:
        directions: Number of directions.
        turns: Number of turns of each, all around.

    Returns:
        Rotation matrices, shape (directions * turns, 3, 3).

    Raises:
        InvalidPoseError: A number that is not whole, or below 1.
    """
    directions = count(directions, "directions", InvalidPoseError)
    turns = count(turns, "turns", InvalidPoseError)
    indices = np.arange(directions)
    height = 1.0 - (2.0 * indices + 1.0) / directions
    # The golden angle.
    around = indices * np.pi * (3.0 - np.sqrt(5.0))
    tilt = np.arccos(height)
    first = rotations(2, around) @ rotations(1, tilt)
    second = rotations(2, 2 * np.pi * np.arange(turns) / turns)
    return (first[:, None] @ second)[..., :3, :3].reshape(-1, 3, 3)


def reach(
    robot: Robot,
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    z: npt.ArrayLike,
    orientations: npt.ArrayLike,
    *,
    q7: float | None = None,
    cell: Cell | None = None,
    threads: int = 1,
    block: int | None = None,
    progress: Report | Bar | None = None,
) -> ReachMap:
    """Map what an arm reaches: for each position of a grid, how many orientations are reached
    inside the limits and without a collision, in how many ways, and how near to limits and
    singularities.

    Solutions do not count at which the arm touches itself, or an obstacle of the cell. An arm
    without a body (`robot.body`, which `with_body(None)` takes away) is not tested. The answer does
    not depend on blocks or threads. Memory holds the answer and one block.

    Args:
        robot: The arm, with its tool and base.
        x: Positions along x [m], shape (i,); a number for one.
        y: Positions along y [m], shape (j,); a number for one.
        z: Positions along z [m], shape (k,); a number for one.
        orientations: Orientations of the tool, shape (o, 3, 3), or (3, 3) for one.
        q7: Angle of joint 7 of a seven-axis arm [rad].
        cell: Obstacles around the arm; none when not given.
        threads: Number of threads for each block; 0 for one a core.
        block: Positions of a block; about 260,000 poses when not given.
        progress: Called with the number of positions that are ready, and of all; or a bar as
            `tqdm.tqdm()`.

    Raises:
        InvalidPoseError: Positions that are not finite or have a wrong shape, or a matrix that is
            no rotation; the message has its index.
        InvalidModelError: The first six joints do not move the tool in six independent ways; with
            `cell`, the robot has no body.
        TypeError: `q7` of an arm of six joints, or none of one of seven.
    """
    check_robot(robot)
    report = reporter(progress)
    places = {
        name: finite(np.atleast_1d(np.asarray(values)), name, (None,), InvalidPoseError)
        for name, values in {"x": x, "y": y, "z": z}.items()
    }
    axes = [*places.values()]
    rotations = _rotations(robot, orientations, q7)
    at_once = max(1, IN_A_BLOCK // len(rotations))
    if block is not None:
        at_once = count(block, "block", InvalidPoseError)
    if cell is None and robot.body is not None:
        cell = Cell()
    shape = tuple(map(len, axes))
    size = math.prod(shape)
    reached, solutions = np.zeros((2, *shape), np.int64)
    margin, singularities = np.zeros((2, *shape))
    report(0, size)
    for low in range(0, size, at_once):
        high = min(low + at_once, size)
        own = slice(low, high)
        # Without a name, poses are gone before the next ones are made.
        found = robot.ik_margin(
            _poses(axes, rotations, np.arange(low, high)), q7, threads=threads, cell=cell
        )
        reached.flat[own] = (found.solutions > 0).sum(axis=1)
        solutions.flat[own] = found.solutions.sum(axis=1, dtype=np.int64)
        # NaN where there is no solution.
        margin.flat[own] = np.fmin.reduce(found.margin, axis=1)
        singularities.flat[own] = np.fmin.reduce(found.singularities, axis=1)
        report(high, size)
    return ReachMap(
        **places,
        orientations=rotations,
        reached=reached,
        solutions=solutions,
        margin=margin,
        singularities=singularities,
    )


def _poses(axes: Sequence[Floats], rotations: Floats, places: npt.NDArray[np.int_]) -> Floats:
    """Every rotation at positions by their numbers, of which x is the slowest."""
    poses = np.zeros((len(places), len(rotations), 4, 4))
    poses[..., :3, :3] = rotations
    poses[..., 3, 3] = 1.0
    indices = np.unravel_index(places, tuple(map(len, axes)))
    for column, (axis, index) in enumerate(zip(axes, indices, strict=True)):
        poses[..., column, 3] = axis[index, None]
    return poses


def _rotations(robot: Robot, given: npt.ArrayLike, q7: float | None) -> Floats:
    shape = (3, 3) if np.ndim(all_poses(given)) == 2 else (None, 3, 3)
    rotations = as_array(given, "orientations", shape, InvalidPoseError).reshape(-1, 3, 3)
    pose = np.eye(4)
    for index, rotation in enumerate(rotations):
        pose[:3, :3] = rotation
        try:
            robot.ik(pose) if q7 is None else robot.ik(pose, q7=q7)
        except InvalidPoseError as fault:
            raise InvalidPoseError(f"orientations[{index}]: {fault}") from None
    return rotations
