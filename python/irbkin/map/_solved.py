"""A grid of positions and orientations, solved block by block."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report, check_robot, count, reporter
from irbkin._arrays import Floats, all_poses, as_array, finite
from irbkin._core import Cell, Robot
from irbkin.errors import InvalidPoseError
from irbkin.map._store import FIELDS, RECORD

# Poses that are solved at a time, and poses of a block: a tenth of a second and more.
AT_A_TIME, IN_A_BLOCK = 1 << 14, 1 << 18


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

    def blocks(self, first: int) -> Iterator[tuple[slice, npt.NDArray[Any]]]:
        """The records of positions from `first` on, in blocks."""
        self.report(first, self.size)
        for low in range(first, self.size, self.block):
            high = min(low + self.block, self.size)
            yield slice(low, high), self.solved(low, high)
            self.report(high, self.size)

    def solved(self, first: int, last: int) -> npt.NDArray[Any]:
        count = last - first
        made = np.zeros(count, RECORD)
        reached, solutions, margin, singularities = (made[name] for name in FIELDS)
        margin[:] = singularities[:] = np.nan
        for start in range(0, len(self.orientations), AT_A_TIME):
            rotations = self.orientations[start : start + AT_A_TIME]
            at_once = min(count, max(1, AT_A_TIME // len(rotations)))
            poses = np.zeros((at_once, len(rotations), 4, 4))
            poses[..., :3, :3] = rotations
            poses[..., 3, 3] = 1.0
            for low in range(0, count, at_once):
                high = min(low + at_once, count)
                rows, now = slice(low, high), poses[: high - low]
                # By their number, x the slowest.
                indices = np.unravel_index(np.arange(first + low, first + high), self.shape)
                for column, (axis, index) in enumerate(zip(self.axes, indices, strict=True)):
                    now[..., column, 3] = axis[index, None]
                found = self.robot.ik_margin(now, self.q7, threads=self.threads, cell=self.cell)
                reached[rows] += (found.solutions > 0).sum(axis=1)
                solutions[rows] += found.solutions.sum(axis=1, dtype=np.int64)
                # NaN where there is no solution.
                margin[rows] = np.fmin(margin[rows], np.fmin.reduce(found.margin, axis=1))
                least = np.fmin.reduce(found.singularities, axis=1)
                singularities[rows] = np.fmin(singularities[rows], least)
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
