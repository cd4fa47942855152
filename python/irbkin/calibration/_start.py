"""A first base and tool, of a robot that stands or holds something else than assumed: closed forms.

With flange frames F_i of the robot, measured poses M_i, base Z and tool X, M_i = Z F_i X
(docs/theory/calibrate.md, eq. 10 to 13).
"""

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin.calibration._measurements import Measurements

# Rounds in which base and tool point take turns, of measured positions.
ROUNDS = 100


def aligned(robot: Robot, measurements: Measurements, fit: frozenset[str]) -> Robot:
    """The robot with a base and a tool that fit its nominal table roughly."""
    flange = robot.with_base(np.eye(4)).with_tool(np.eye(4)).fk(measurements.q)
    base, tool = np.array(robot.base), np.array(robot.tool)
    # The rotations of Z, X and F_i; the first two are parts of the frames.
    z, x, f = base[:3, :3], tool[:3, :3], flange[:, :3, :3]
    measured, rotation = measurements.position, measurements.rotation
    is_alternating = rotation is None and {"base", "tool"} <= fit
    for _ in range(ROUNDS if is_alternating else 1):
        if rotation is None:
            if "base" in fit:
                # Least squares of the rotation between two sets of points (eq. 13).
                points = f @ tool[:3, 3] + flange[:, :3, 3]
                off = points - points.mean(axis=0)
                z[:] = nearest_rotation((measured - measured.mean(axis=0)).T @ off)
        # Of measured rotations (eq. 11).
        elif "tool" not in fit:
            z[:] = nearest_rotation(np.einsum("mij,mkj->ik", rotation, f @ x))
        elif "base" not in fit:
            x[:] = nearest_rotation(np.einsum("mji,mjk->ik", z @ f, rotation))
        else:
            z[:], x[:] = turns(f, rotation)
        fit_shift(flange, measured, base, tool, fit)
    return robot.with_base(base).with_tool(tool)


def nearest_rotation(matrix: Floats) -> Floats:
    left, _, right = np.linalg.svd(matrix)
    sign = np.diag([1.0, 1.0, np.linalg.det(left @ right)])
    return np.asarray(left @ sign @ right)


def turns(flange: Floats, measured: Floats) -> tuple[Floats, Floats]:
    """Z and X of M_i = Z F_i X, all of them rotations: the null vector of Z^T M_i - F_i X."""
    eye = np.eye(3)
    rows = [
        np.hstack([np.kron(eye, m.T), -np.kron(f, eye)])
        for f, m in zip(flange, measured, strict=True)
    ]
    null = np.linalg.svd(np.vstack(rows), full_matrices=True)[2][-1]
    inverse, turn = null[:9].reshape(3, 3), null[9:].reshape(3, 3)
    sign = np.sign(np.linalg.det(turn)) or 1.0
    return nearest_rotation(sign * inverse).T, nearest_rotation(sign * turn)


def fit_shift(
    flange: Floats, measured: Floats, base: Floats, tool: Floats, fit: frozenset[str]
) -> None:
    """Move base and tool to where they fit best, by linear least squares (eq. 12)."""
    columns, wanted = [], measured - flange[:, :3, 3] @ base[:3, :3].T
    if "base" in fit:
        columns.append(np.broadcast_to(np.eye(3), (len(flange), 3, 3)))
    else:
        wanted = wanted - base[:3, 3]
    levers = base[:3, :3] @ flange[:, :3, :3]
    if "tool" in fit:
        columns.append(levers)
    else:
        wanted = wanted - levers @ tool[:3, 3]
    matrix = np.concatenate(columns, axis=2).reshape(3 * len(flange), -1)
    found = np.linalg.lstsq(matrix, wanted.ravel(), rcond=None)[0]
    if "base" in fit:
        base[:3, 3] = found[:3]
    if "tool" in fit:
        tool[:3, 3] = found[-3:]
