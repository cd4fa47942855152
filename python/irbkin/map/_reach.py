"""Reach and dexterity over a grid of positions and orientations."""

from os import PathLike
from pathlib import Path

import numpy as np
import numpy.typing as npt

from irbkin import Cell, Robot, __version__
from irbkin._arguments import Bar, Report, count
from irbkin._arrays import Floats, rotations
from irbkin._grids import ReachMap
from irbkin.errors import InvalidPoseError, IrbkinError
from irbkin.map._solved import Grid
from irbkin.map._store import FIELDS, is_in, job_of, load, records


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
            was; blocks that are ready are kept in a file beside it until the map is whole.
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
        FileExistsError: `output` is the map of something else.
        FileNotFoundError: The folder of `output` does not exist.
    """
    path = None if output is None else Path(output)
    if path is not None and path.suffix != ".npz":
        raise IrbkinError(f"output must be a file .npz, got {path}")
    grid = Grid(robot, (x, y, z), orientations, q7, cell, threads, block, progress)
    if path is not None:
        _write(grid, path)
        return load(path)
    fields = {name: np.zeros(grid.size, kind) for name, kind in FIELDS.items()}
    for rows, found in grid.blocks(0):
        for name, field in fields.items():
            field[rows] = found[name]
    whole = {name: field.reshape(grid.shape) for name, field in fields.items()}
    return ReachMap(*grid.axes, grid.orientations, **whole)


def _write(grid: Grid, path: Path) -> None:
    """Write the map of a grid into a file, from where a run was ended."""
    inputs = (grid.robot, grid.q7, grid.cell, __version__)
    job = job_of(inputs, (*grid.axes, grid.orientations))
    if is_in(path, job):
        grid.report(grid.size, grid.size)
        return
    with records(path, job) as (file, ready):
        for _, found in grid.blocks(ready):
            file.write(found.tobytes())
            file.flush()
