"""Columns of joint vectors and poses, which several verbs show."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from irbkin import Robot, to_xyz_euler_zyx, to_xyz_wxyz
from irbkin._words import singularities
from irbkin.cli.output import Column, Columns, Floats
from irbkin.errors import InvalidModelError

NO_CONFDATA = np.iinfo(np.int32).min
"""The numbers of `configuration` in rows of angles that are too large for one."""


def pose_columns(poses: Floats) -> Columns:
    """Position, quaternion and Euler angles of poses, shape (k, 4, 4)."""
    xyz = zip("xyz", _zeros(poses[:, :3, 3].T * 1e3), strict=True)
    euler = _zeros(np.degrees(to_xyz_euler_zyx(poses)[1]))
    turns = zip(("rz", "ry", "rx"), np.where(euler < -180.0 + 1e-9, 180.0, euler).T, strict=True)
    wxyz = zip(("qw", "qx", "qy", "qz"), _zeros(to_xyz_wxyz(poses)[1]).T, strict=True)
    return {
        **{Column(name, "9.2f", "mm"): own for name, own in xyz},
        **{Column(name, "8.5f"): own for name, own in wxyz},
        **{Column(name, "8.2f", "deg"): own for name, own in turns},
    }


def joint_columns(q: Floats) -> Columns:
    values = _zeros(np.degrees(q)).T
    return {Column(f"q{number}", "7.2f", "deg"): own for number, own in enumerate(values, 1)}


def word_columns(names: Mapping[str, Sequence[str]]) -> Columns:
    return {Column(name, "<12s"): own for name, own in names.items()}


def posture_columns(robot: Robot, q: Floats, *, with_joints: bool = True) -> Columns:
    """Confdata, angles, limits and singularities of joint vectors, shape (k, n)."""
    known = np.asarray(np.isfinite(q).all(axis=1))
    filled = np.where(known[:, None], q, 0.0)

    def masked(values: Any, is_shown: Any = known) -> Any:
        return values if is_shown.all() else np.where(is_shown, values, np.nan)

    confdata: Columns = {}
    if has_confdata(robot):
        numbers = robot.configuration(filled)
        is_shown = known & (numbers.cf1 != NO_CONFDATA)
        names = ("cf1", "cf4", "cf6", "cfx")
        confdata = {
            Column(name, "3d"): masked(own, is_shown)
            for name, own in zip(names, numbers, strict=True)
        }
    each = np.minimum(filled - robot.limits[:, 0], robot.limits[:, 1] - filled)
    joint = each.argmin(axis=1)
    margin = each[np.arange(len(q)), joint]
    near = np.array([f"J{number + 1}" for number in range(robot.dof)])[joint]
    at = robot.singularity(filled)
    flags = zip(at.kinds.tolist(), at.near().tolist(), strict=True)
    words = np.array([singularities(*both) for both in flags], dtype=str)
    return {
        **confdata,
        **(joint_columns(q) if with_joints else {}),
        Column("limits", "<7s"): np.where(known, np.where(margin >= 0, "inside", "outside"), ""),
        Column("margin", "6.1f", "deg"): masked(np.degrees(margin)),
        Column("joint", "<5s"): np.where(known, near, ""),
        Column("wrist", "6.1f", "deg"): masked(np.degrees(at.wrist)),
        Column("elbow", "6.1f", "deg"): masked(np.degrees(at.elbow)),
        Column("shoulder", "7.1f", "mm"): masked(np.asarray(at.shoulder) * 1e3),
        Column("singular", "<12s"): np.where(known, words, ""),
    }


def has_confdata(robot: Robot) -> bool:
    try:
        robot.configuration(np.zeros(robot.dof))
    except InvalidModelError:
        return False
    return True


def _zeros(values: Floats) -> Floats:
    """Without what rounds to a negative zero."""
    return np.where(np.abs(values) < 1e-9, 0.0, values)
