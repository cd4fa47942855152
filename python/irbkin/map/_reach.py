"""Reach and dexterity over a grid of positions and orientations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from irbkin._arguments import check_robot, count, reporter
from irbkin._arrays import as_array, finite
from irbkin._core import Cell, Robot, __version__
from irbkin._grids import ReachMap
from irbkin.errors import InvalidPoseError
from irbkin.map._store import Store

if TYPE_CHECKING:
    from os import PathLike

    import numpy.typing as npt

    from irbkin._arguments import Bar, Report
    from irbkin._arrays import Floats
    from irbkin.map._store import Part

# Poses that are solved at a time, and poses of a block: a tenth of a second and more.
AT_A_TIME, IN_A_BLOCK = 1 << 14, 1 << 18


@dataclass(frozen=True, slots=True)
class Grid:
    """The grid to map."""

    robot: Robot
    axes: tuple[Floats, Floats, Floats]
    orientations: Floats
    q7: float | None
    cell: Cell | None
    """In which solutions do not count that collide."""
    threads: int

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of positions."""
        return tuple(map(len, self.axes))

    def positions(self, first: int, last: int) -> Floats:
        """Positions by their number, x the slowest, shape (last - first, 3)."""
        indices = np.unravel_index(np.arange(first, last), self.shape)
        return np.stack([axis[index] for axis, index in zip(self.axes, indices, strict=True)], -1)


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
    first, second = (
        _turn(2, around) @ _turn(1, tilt),
        _turn(2, 2 * np.pi * np.arange(turns) / turns),
    )
    spread: Floats = (first[:, None] @ second).reshape(-1, 3, 3)
    return spread


def reach(
    robot: Robot,
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    z: npt.ArrayLike,
    orientations: npt.ArrayLike,
    *,
    q7: float | None = None,
    cell: Cell | None = None,
    output: str | PathLike[str] | None = None,
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
        output: File (.npz) of the map, which `load` reads. A run that was ended goes on where it
            was; blocks that are ready are kept in a folder beside it until the map is whole.
        threads: Number of threads for each block; 0 for one a core.
        block: Positions of a block; about 260,000 poses when not given.
        progress: Called with the number of positions that are ready, and of all; or a bar as
            `tqdm.tqdm()`.

    Returns:
        The map.

    Raises:
        InvalidPoseError: Positions that are not finite or have a wrong shape, or a matrix that is
            no rotation; the message has its index.
        InvalidModelError: The first six joints do not move the tool in six independent ways; with
            `cell`, the robot has no body.
        TypeError: `q7` of an arm of six joints, or none of one of seven.
        FileExistsError: `output` is the map of something else.
        FileNotFoundError: The folder of `output` does not exist.
    """
    check_robot(robot)
    report = reporter(progress)
    axes = (_axis("x", x), _axis("y", y), _axis("z", z))
    if cell is None and robot.body is not None:
        cell = Cell()
    grid = Grid(robot, axes, _rotations(robot, orientations, q7), q7, cell, threads)
    positions = int(np.prod(grid.shape))
    size = max(1, IN_A_BLOCK // len(grid.orientations))
    if block is not None:
        size = count(block, "block", InvalidPoseError)
    store = Store(output, (__version__, robot, *axes, grid.orientations, q7, cell), positions)
    blocks = store.missing(size)
    done = positions - sum(last - first for first, last in blocks)
    report(done, positions)
    for first, last in blocks:
        store.add(first, last, solved(grid, first, last))
        done += last - first
        report(done, positions)
    fields = {name: field.reshape(grid.shape) for name, field in store.fields.items()}
    found = ReachMap(*axes, grid.orientations, **fields)
    store.finish(found)
    return found


def solved(grid: Grid, first: int, last: int) -> Part:
    """Return the numbers of a range of positions."""
    count = last - first
    reached, solutions = np.zeros(count, np.int64), np.zeros(count, np.int64)
    margin, singularities = np.full(count, np.inf), np.full(count, np.inf)
    for start in range(0, len(grid.orientations), AT_A_TIME):
        rotations = grid.orientations[start : start + AT_A_TIME]
        at_once = min(count, max(1, AT_A_TIME // len(rotations)))
        poses = np.zeros((at_once, len(rotations), 4, 4))
        poses[..., :3, :3] = rotations
        poses[..., 3, 3] = 1.0
        for low in range(0, count, at_once):
            high = min(low + at_once, count)
            rows, now = slice(low, high), poses[: high - low]
            now[..., :3, 3] = grid.positions(first + low, first + high)[:, None]
            found = grid.robot.ik_margin(now, grid.q7, threads=grid.threads, cell=grid.cell)
            reached[rows] += (found.solutions > 0).sum(axis=1)
            solutions[rows] += found.solutions.sum(axis=1, dtype=np.int64)
            # NaN where there is no solution.
            margin[rows] = np.fmin(margin[rows], np.fmin.reduce(found.margin, axis=1))
            least = np.fmin.reduce(found.singularities, axis=1)
            singularities[rows] = np.fmin(singularities[rows], least)
    for field in (margin, singularities):
        field[reached == 0] = np.nan
    return reached, solutions, margin, singularities


def _axis(name: str, values: npt.ArrayLike) -> Floats:
    """The positions along one axis."""
    return finite(np.atleast_1d(np.asarray(values)), name, (None,), InvalidPoseError)


def _rotations(robot: Robot, given: npt.ArrayLike, q7: float | None) -> Floats:
    """Rotations that `ik` takes, one by one."""
    shape = (3, 3) if np.ndim(given) == 2 else (None, 3, 3)
    rotations = as_array(given, "orientations", shape, InvalidPoseError).reshape(-1, 3, 3)
    pose = np.eye(4)
    for index, rotation in enumerate(rotations):
        pose[:3, :3] = rotation
        try:
            robot.ik(pose) if q7 is None else robot.ik(pose, q7=q7)
        except InvalidPoseError as fault:
            raise InvalidPoseError(f"orientations[{index}]: {fault}") from None
    return rotations


def _turn(axis: int, angles: Floats) -> Floats:
    """Rotations about y (1) or z (2), shape (n, 3, 3)."""
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turns = np.tile(np.eye(3), (len(angles), 1, 1))
    turns[:, first, first] = turns[:, second, second] = np.cos(angles)
    turns[:, second, first] = np.sin(angles)
    turns[:, first, second] = -turns[:, second, first]
    return turns
