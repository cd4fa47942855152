"""A first base and tool, of a robot that stands or holds something else than assumed: closed forms.

With flange frames F_i of the robot, measured poses M_i, base Z and tool X, M_i = Z F_i X
(docs/guide/calibrate.md, eq. 10 to 13).
"""

from __future__ import annotations

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin.calibration._measurements import Measurements

# Rounds in which base and tool point take turns, of measured positions.
ROUNDS = 100


def aligned(robot: Robot, measurements: Measurements, fit: frozenset[str]) -> Robot:
    """The robot with a base and a tool that fit its nominal table roughly."""
    bare = robot.with_base(np.eye(4)).with_tool(np.eye(4))
    flange = bare.fk(measurements.q)
    base, tool = robot.base, robot.tool
    fits_base, fits_tool = "base" in fit, "tool" in fit
    if measurements.rotation is None:
        base, tool = _from_positions(
            flange, measurements.position, base, tool, fits_base, fits_tool
        )
    else:
        turn_base, turn_tool = _turns(
            flange[:, :3, :3], measurements.rotation, base, tool, fits_base, fits_tool
        )
        base, tool = _shifts(
            flange, measurements.position, turn_base, turn_tool, base, tool, fits_base, fits_tool
        )
    return robot.with_base(base).with_tool(tool)


def _frame(rotation: Floats, position: Floats) -> Floats:
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = rotation, position
    return frame


def nearest_rotation(matrix: Floats) -> Floats:
    """The rotation nearest to a matrix."""
    left, _, right = np.linalg.svd(matrix)
    sign = np.diag([1.0, 1.0, np.linalg.det(left @ right)])
    rotation: Floats = left @ sign @ right
    return rotation


def _turns(
    flange: Floats, measured: Floats, base: Floats, tool: Floats, fits_base: bool, fits_tool: bool
) -> tuple[Floats, Floats]:
    """Rotations of base and tool (eq. 11): of both, the null vector of Z^T M_i - F_i X = 0."""
    if not fits_tool:
        known = flange @ tool[:3, :3]
        return nearest_rotation(np.einsum("mij,mkj->ik", measured, known)), tool[:3, :3]
    if not fits_base:
        known = base[:3, :3] @ flange
        return base[:3, :3], nearest_rotation(np.einsum("mji,mjk->ik", known, measured))
    return turns(flange, measured)


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


def _shifts(
    flange: Floats,
    measured: Floats,
    turn_base: Floats,
    turn_tool: Floats,
    base: Floats,
    tool: Floats,
    fits_base: bool,
    fits_tool: bool,
) -> tuple[Floats, Floats]:
    """Base and tool with the positions that fit best, by linear least squares (eq. 12)."""
    columns, wanted = [], measured - flange[:, :3, 3] @ turn_base.T
    if fits_base:
        columns.append(np.broadcast_to(np.eye(3), (len(flange), 3, 3)))
    else:
        wanted = wanted - base[:3, 3]
    levers = turn_base @ flange[:, :3, :3]
    if fits_tool:
        columns.append(levers)
    else:
        wanted = wanted - levers @ tool[:3, 3]
    matrix = np.concatenate(columns, axis=2).reshape(3 * len(flange), -1)
    solved = np.linalg.lstsq(matrix, wanted.ravel(), rcond=None)
    found = np.asarray(solved[0], dtype=np.float64)
    base_at = found[:3] if fits_base else base[:3, 3]
    tool_at = found[-3:] if fits_tool else tool[:3, 3]
    return _frame(turn_base, base_at), _frame(turn_tool, tool_at)


def _from_positions(
    flange: Floats, measured: Floats, base: Floats, tool: Floats, fits_base: bool, fits_tool: bool
) -> tuple[Floats, Floats]:
    """Base and tool point by turns: the base by the rotation between two sets of points, the point
    by linear least squares (eq. 13).
    """
    turn_base, turn_tool = base[:3, :3], tool[:3, :3]
    for _ in range(ROUNDS if fits_base and fits_tool else 1):
        if fits_base:
            points = flange[:, :3, :3] @ tool[:3, 3] + flange[:, :3, 3]
            off = points - points.mean(axis=0)
            turn_base = nearest_rotation((measured - measured.mean(axis=0)).T @ off)
        base, tool = _shifts(
            flange, measured, turn_base, turn_tool, base, tool, fits_base, fits_tool
        )
    return base, tool
