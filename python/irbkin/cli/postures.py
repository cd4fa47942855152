"""Columns of joint vectors and poses, which several verbs show."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin import to_xyz_euler_zyx, to_xyz_wxyz
from irbkin.cli.output import Column, Values
from irbkin.errors import InvalidModelError

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats

POSE = (
    *(Column(name, "mm", "9.2f") for name in "xyz"),
    *(Column(name, "", "8.5f") for name in ("qw", "qx", "qy", "qz")),
)
NO_CONFDATA = np.iinfo(np.int32).min
"""The numbers of `configuration` in rows of angles that are too large for one."""
EULER = tuple(Column(name, "deg", "8.2f") for name in ("rz", "ry", "rx"))


def pose_values(poses: Floats) -> list[Values]:
    """The columns POSE of poses, shape (k, 4, 4)."""
    xyz, wxyz = to_xyz_wxyz(poses)
    return [*_zeros(xyz * 1e3).T, *_zeros(wxyz).T]


def euler_values(poses: Floats) -> list[Values]:
    """The columns EULER of poses."""
    degrees = _zeros(np.degrees(to_xyz_euler_zyx(poses)[1]))
    return list(np.where(degrees < -180.0 + 1e-9, 180.0, degrees).T)


def _zeros(values: Floats) -> Floats:
    """Without what rounds to a negative zero."""
    return np.where(np.abs(values) < 1e-9, 0.0, values)


def has_confdata(robot: Robot) -> bool:
    """Whether the controller of a robot has configurations."""
    try:
        robot.configuration(np.zeros(robot.dof))
    except InvalidModelError:
        return False
    return True


class Postures:
    """Joint vectors of a robot: confdata, angles, limits, singularities."""

    def __init__(self, robot: Robot, *, with_joints: bool = True) -> None:
        self.robot, self.with_joints = robot, with_joints
        self.has_confdata = has_confdata(robot)
        confdata = ("cf1", "cf4", "cf6", "cfx") if self.has_confdata else ()
        self.columns = (
            *(Column(name, "", "3d") for name in confdata),
            *(self.joints(robot.dof) if with_joints else ()),
            Column("limits", "", "<7s"),
            Column("margin", "deg", "6.1f"),
            Column("joint", "", "<5s"),
            Column("wrist", "deg", "6.1f"),
            Column("elbow", "deg", "6.1f"),
            Column("shoulder", "mm", "7.1f"),
        )

    @staticmethod
    def joints(dof: int) -> tuple[Column, ...]:
        """The columns of the joint angles alone."""
        return tuple(Column(f"q{number + 1}", "deg", "7.2f") for number in range(dof))

    def values(self, q: Floats) -> list[Values]:
        """The columns of joint vectors, shape (k, n)."""
        robot = self.robot
        known = np.asarray(np.isfinite(q).all(axis=1))
        filled = np.where(known[:, None], q, 0.0)

        def masked(values: Any, is_shown: Any = known) -> Any:
            return values if is_shown.all() else np.where(is_shown, values, np.nan)

        confdata: list[Values] = []
        if self.has_confdata:
            numbers = robot.configuration(filled)
            has_numbers = known & (numbers.cf1 != NO_CONFDATA)
            confdata = [masked(it, has_numbers) for it in numbers]
        margin, joint = margins(robot, filled)
        names = np.array([f"J{number + 1}" for number in range(robot.dof)])[joint]
        at = robot.singularity(filled)

        def words(values: Any) -> list[str]:
            texts: list[str] = np.where(known, values, "").tolist()
            return texts

        return [
            *confdata,
            *(_zeros(np.degrees(q)).T if self.with_joints else ()),
            words(np.where(margin >= 0.0, "inside", "outside")),
            masked(np.degrees(margin)),
            words(names),
            masked(np.degrees(at.wrist)),
            masked(np.degrees(at.elbow)),
            masked(np.asarray(at.shoulder) * 1e3),
        ]


def margins(robot: Robot, q: Floats) -> tuple[Floats, Any]:
    """How far joint vectors are inside the limits [rad], negative outside, and of which joint."""
    lower, upper = robot.limits.T
    each = np.minimum(q - lower, upper - q)
    joint = each.argmin(axis=1)
    return each[np.arange(len(q)), joint], joint
