"""Maps of reach and dexterity over a grid of positions and orientations; docs/guide/recipes.md has
one of many processes.

A map in a file is written block by block, so that a run that was ended goes on where it was.

>>> import irbkin, irbkin.map
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> spread = irbkin.map.orientations(20)
>>> found = irbkin.map.reach(robot, [0.6, 0.9], 0.0, [0.5, 1.0], spread)
>>> found.share.shape
(2, 1, 2)
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import pickle
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import IO, Any, BinaryIO, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin import __version__
from irbkin._arguments import Bar, Report, check_robot, count, reporter
from irbkin._arrays import Floats, all_poses, as_array, finite, rotations
from irbkin._core import Cell, Robot
from irbkin._equality import by_value
from irbkin._files import continued, replaced, write_columns
from irbkin._words import counted
from irbkin.errors import InvalidPoseError, IrbkinError

__all__ = ["ReachMap", "load", "orientations", "reach"]

FIELDS = {"reached": "<i8", "solutions": "<i8", "margin": "<f8", "singularities": "<f8"}
RECORD = np.dtype([*FIELDS.items()])
"""The numbers of a position."""
INPUTS = ("robot", "q7", "cell", "version of irbkin")
"""Inputs of a map beside its grid."""
GRID = ("x", "y", "z", "orientations")
Job = Mapping[str, npt.NDArray[Any]]
"""The inputs of a map, as its file has them beside the numbers: digests, "job", and GRID."""
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
        """The grid, how much of it is reached, and the best position."""
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
    made = np.concatenate([*grid.blocks(0)]).reshape(grid.shape)
    columns = {name: made[name].copy() for name in FIELDS}
    return ReachMap(*grid.axes, grid.orientations, **columns)


def _write(grid: Grid, path: Path) -> None:
    """Write the map of a grid into a file, from where a run was ended."""
    inputs = (grid.robot, grid.q7, grid.cell, __version__)
    digests = [hashlib.sha256(pickle.dumps(it, protocol=4)).hexdigest() for it in inputs]
    places = dict(zip(GRID, (*grid.axes, grid.orientations), strict=True))
    job = {"job": np.array(digests), **places}
    if is_in(path, job):
        grid.report(grid.size, grid.size)
        return
    with records(path, job) as (file, ready):
        for found in grid.blocks(ready):
            file.write(found.tobytes())
            file.flush()


class Grid:
    """The grid to map: the arguments of `reach`, checked."""

    def __init__(
        self,
        robot: Robot,
        axes: Sequence[npt.ArrayLike],
        orientations: npt.ArrayLike,
        q7: float | None,
        cell: Cell | None,
        threads: int,
        block: int | None,
        progress: Report | Bar | None,
    ) -> None:
        check_robot(robot)
        self.report, self.threads = reporter(progress), threads
        x, y, z = (
            finite(np.atleast_1d(np.asarray(values)), name, (None,), InvalidPoseError)
            for name, values in zip("xyz", axes, strict=True)
        )
        self.axes = x, y, z
        self.shape = tuple(map(len, self.axes))
        self.orientations = _rotations(robot, orientations, q7)
        self.robot, self.q7 = robot, None if q7 is None else float(q7)
        self.cell = Cell() if cell is None and robot.body is not None else cell
        self.block = max(1, IN_A_BLOCK // len(self.orientations))
        if block is not None:
            self.block = count(block, "block", InvalidPoseError)

    @property
    def size(self) -> int:
        return int(np.prod(self.shape))

    def blocks(self, first: int) -> Iterator[npt.NDArray[Any]]:
        """The records of positions from `first` on, in blocks."""
        self.report(first, self.size)
        for low in range(first, self.size, self.block):
            high = min(low + self.block, self.size)
            yield self.solved(low, high)
            self.report(high, self.size)

    def solved(self, first: int, last: int) -> npt.NDArray[Any]:
        """The records of positions by their numbers, of which x is the slowest."""
        poses = np.zeros((last - first, len(self.orientations), 4, 4))
        poses[..., :3, :3] = self.orientations
        poses[..., 3, 3] = 1.0
        indices = np.unravel_index(np.arange(first, last), self.shape)
        for column, (axis, index) in enumerate(zip(self.axes, indices, strict=True)):
            poses[..., column, 3] = axis[index, None]
        found = self.robot.ik_margin(poses, self.q7, threads=self.threads, cell=self.cell)
        made = np.zeros(last - first, RECORD)
        made["reached"] = (found.solutions > 0).sum(axis=1)
        made["solutions"] = found.solutions.sum(axis=1, dtype=np.int64)
        # NaN where there is no solution.
        made["margin"] = np.fmin.reduce(found.margin, axis=1)
        made["singularities"] = np.fmin.reduce(found.singularities, axis=1)
        return made


def _rotations(robot: Robot, given: npt.ArrayLike, q7: float | None) -> Floats:
    """Rotations that `ik` takes, one by one."""
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


def is_in(path: Path, job: Job) -> bool:
    """Whether the map of a job is in a file already; a FileExistsError if something else is."""
    if not path.exists():
        return False
    try:
        other = _arrays(path, [*job])
    except IrbkinError as error:
        raise _another(path, str(error)) from None
    digests = zip(INPUTS, job["job"], other["job"], strict=True)
    names = [name for name, own, its in digests if own != its]
    names += [name for name in GRID if not np.array_equal(job[name], other[name])]
    if names:
        raise _another(path, ", ".join(names))
    return True


def _another(path: Path, what: str) -> FileExistsError:
    return FileExistsError(f"{path} is of another map ({what}): delete it or choose another output")


@contextlib.contextmanager
def records(path: Path, job: Job) -> Iterator[tuple[BinaryIO, int]]:
    """A file beside `path` that records are appended to, and how many it has; with all, it becomes
    the file. Two processes that write one map at once write the same.

    Raises:
        FileExistsError: The file beside it is of another map, or a link.
        FileNotFoundError: The folder does not exist.
    """
    beside = path.with_name(f".{path.name}.part")
    if not path.parent.is_dir():
        words = "cannot be written: its folder does not exist"
        raise FileNotFoundError(errno.ENOENT, words, str(path))
    begin = hashlib.sha256(b"".join(it.tobytes() for it in job.values())).digest()
    with continued(beside) as file:
        if not begin.startswith(file.read(len(begin))):
            raise _another(beside, "a run of it was ended")
        file.seek(0)
        file.write(begin)
        count = (file.seek(0, os.SEEK_END) - len(begin)) // RECORD.itemsize
        file.seek(len(begin) + count * RECORD.itemsize)
        yield file, count
        file.flush()
        # Of the columns only what is written at a time is in memory.
        whole = np.memmap(file, RECORD, "r", len(begin), tuple(len(job[it]) for it in "xyz"))
        columns: dict[str, Any] = {**job, **{name: whole[name] for name in FIELDS}}
        with replaced(path) as archive:
            np.savez(archive, **columns)
        # Windows removes no file that is mapped.
        del whole
    beside.unlink(missing_ok=True)


def _arrays(path: Path, names: Sequence[str]) -> dict[str, npt.NDArray[Any]]:
    """Some arrays of a file, all of which it must have."""
    with path.open("rb") as file:
        try:
            stored = np.load(file)
            if missing := sorted({*names} - {*stored.files}):
                raise ValueError(f"it has no {missing[0]}")
            return {name: stored[name] for name in names}
        except (AttributeError, TypeError, ValueError, EOFError, zipfile.BadZipFile) as fault:
            raise IrbkinError(f"{path} is not a map: {fault}") from fault


def load(path: str | PathLike[str]) -> ReachMap:
    """Read a map that `reach` has written.

    Raises:
        OSError: The file cannot be read.
        IrbkinError: It is not a map.
    """
    return ReachMap(**_arrays(Path(path), ReachMap._fields))
