"""The arms of the comparison, by their axes at zero joint angles: one description that every
contender is built from.

The forward kinematics here are products of exponentials in NumPy, and no contender's.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
X, Y, Z = np.eye(3)


@dataclass(frozen=True)
class Arm:
    """A serial arm of revolute joints, seen at zero joint angles [m, rad].

    Attributes:
        name: Name in irbkin's catalog.
        axes: Direction of each axis in the base frame, shape (n, 3).
        offsets: From the base to a point of axis 1, from there to one of axis 2, and so on to the
        tool, (n + 1, 3).
        tool: Rotation of the tool frame in the base frame, shape (3, 3).
        limits: Between which joints are drawn, shape (n, 2).
        branch: Joints that tell two solutions apart; of a spherical wrist without J4 and J6, which
            only turn along a family when J5 is zero.
        opw: Brandstoetter's parameters, where the arm has them.
        table: Its modified Denavit-Hartenberg table, if it is built from that and not by its name.
    """

    name: str
    axes: Floats
    offsets: Floats
    tool: Floats
    limits: Floats
    branch: tuple[int, ...]
    opw: dict[str, Any] = field(default_factory=dict)
    table: Floats | None = None

    @property
    def dof(self) -> int:
        """Number of joints."""
        return len(self.axes)

    def frames(self, q: Floats) -> tuple[Floats, Floats, Floats]:
        """Axes, points on them and the tool for joints (..., n): shapes (..., n, 3), (..., n, 3),
        (..., 4, 4).
        """
        rotation = np.broadcast_to(np.eye(3), (*q.shape[:-1], 3, 3))
        point = np.zeros((*q.shape[:-1], 3))
        axes, points = [], []
        for joint, (axis, offset) in enumerate(zip(self.axes, self.offsets[:-1], strict=True)):
            point = point + rotation @ offset
            axes.append(rotation @ axis)
            points.append(point)
            rotation = rotation @ turn(axis, q[..., joint])
        pose = np.zeros((*q.shape[:-1], 4, 4))
        pose[..., :3, :3] = rotation @ self.tool
        pose[..., :3, 3] = point + rotation @ self.offsets[-1]
        pose[..., 3, 3] = 1.0
        return np.stack(axes, axis=-2), np.stack(points, axis=-2), pose

    def fk(self, q: Floats) -> Floats:
        """Pose of the tool in the base frame, (..., n) to (..., 4, 4)."""
        return self.frames(q)[2]

    def jacobian(self, q: Floats) -> Floats:
        """Geometric Jacobian of the tool in the base frame, linear rows first, (..., n) to (..., 6,
        n).
        """
        axes, points, pose = self.frames(q)
        linear = np.cross(axes, pose[..., None, :3, 3] - points)
        return np.swapaxes(np.concatenate([linear, axes], axis=-1), -1, -2)

    def draw(self, rng: np.random.Generator, count: int) -> Floats:
        """Joint vectors, uniform between the limits, shape (count, n)."""
        return rng.uniform(self.limits[:, 0], self.limits[:, 1], size=(count, self.dof))

    def urdf(self) -> str:
        """The arm as a URDF from `link0` to `tool0`, for those who read no other description."""
        parts = ['<robot name="arm"><link name="link0"/>']
        for i, (axis, offset, (lower, upper)) in enumerate(
            zip(self.axes, self.offsets[:-1], self.limits, strict=True)
        ):
            parts.append(
                f'<link name="link{i + 1}"><inertial><mass value="1"/>'
                '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
                f'<joint name="joint{i + 1}" type="revolute"><origin xyz="{words(offset)}"/>'
                f'<parent link="link{i}"/><child link="link{i + 1}"/><axis xyz="{words(axis)}"/>'
                f'<limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/></joint>'
            )
        place = f'xyz="{words(self.offsets[-1])}" rpy="{words(rpy(self.tool))}"'
        parts.append(
            f'<link name="tool0"/><joint name="flange" type="fixed"><origin {place}/>'
            f'<parent link="link{self.dof}"/><child link="tool0"/></joint></robot>'
        )
        return "".join(parts)


def turn(axis: Floats, angle: Floats) -> Floats:
    """Rotation about a unit vector, (...) to (..., 3, 3)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    sine, versine = np.sin(angle)[..., None, None], 2.0 * np.sin(angle / 2)[..., None, None] ** 2
    rotation: Floats = np.eye(3) + sine * cross + versine * (cross @ cross)
    return rotation


def rpy(rotation: Floats) -> Floats:
    """Roll, pitch and yaw of URDF: Rz(yaw) Ry(pitch) Rx(roll)."""
    cosine = np.hypot(rotation[0, 0], rotation[1, 0])
    pitch = np.arctan2(-rotation[2, 0], cosine)
    if cosine < 1e-9:
        return np.array([0.0, pitch, np.arctan2(-rotation[0, 1], rotation[1, 1])])
    roll, yaw = (
        np.arctan2(rotation[2, 1], rotation[2, 2]),
        np.arctan2(rotation[1, 0], rotation[0, 0]),
    )
    return np.array([roll, pitch, yaw])


def words(numbers: Floats) -> str:
    """Numbers with all their digits, blanks between them."""
    return " ".join(repr(float(number)) for number in numbers)


# Maker's dimensions; ABB's tool0 has z out of the flange and x down.
IRB2600 = Arm(
    name="IRB 2600-12/1.65",
    axes=np.array([Z, Y, Y, X, Y, X]),
    offsets=np.array(
        [
            [0, 0, 0],
            [0.150, 0, 0.445],
            [0, 0, 0.700],
            [0.795, 0, 0.115],
            [0, 0, 0],
            [0, 0, 0],
            [0.085, 0, 0],
        ]
    ),
    tool=np.column_stack([-Z, Y, X]),
    limits=np.deg2rad([(-180, 180), (-95, 155), (-180, 75), (-400, 400), (-120, 120), (-400, 400)]),
    branch=(0, 1, 2, 4),
    opw={
        "a1": 0.150, "a2": -0.115, "b": 0.0, "c1": 0.445, "c2": 0.700, "c3": 0.795, "c4": 0.085,
        "offsets": (0.0, 0.0, -np.pi / 2, 0.0, 0.0, 0.0),
    },
)  # fmt: skip

# Universal Robots' standard Denavit-Hartenberg figures of the UR3: base is frame 0, tool frame 6.
UR3 = Arm(
    name="UR3",
    axes=np.array([Z, -Y, -Y, -Y, -Z, -Y]),
    offsets=np.array(
        [
            [0, 0, 0], [0, 0, 0.1519], [-0.24365, 0, 0], [-0.21325, 0, 0], [0, -0.11235, 0],
            [0, 0, -0.08535], [0, -0.0819, 0],
        ]
    ),
    tool=np.column_stack([X, Z, -Y]),
    limits=np.array([(-np.pi, np.pi)] * 6),
    branch=(0, 1, 2, 3, 4, 5),
)  # fmt: skip

# Franka's control parameters of the Panda; the tool is the flange, without the hand.
PANDA = Arm(
    name="Panda",
    axes=np.array([Z, Y, Z, -Y, Z, -Y, -Z]),
    offsets=np.array(
        [
            [0, 0, 0.333], [0, 0, 0], [0, 0, 0.316], [0.0825, 0, 0], [-0.0825, 0, 0.384], [0, 0, 0],
            [0.088, 0, 0], [0, 0, -0.107],
        ]
    ),
    tool=np.diag([1.0, -1.0, -1.0]),
    limits=np.array(
        [
            (-2.8973, 2.8973), (-1.7628, 1.7628), (-2.8973, 2.8973), (-3.0718, -0.0698),
            (-2.8973, 2.8973), (-0.0175, 3.7525), (-2.8973, 2.8973),
        ]
    ),
    branch=(0, 1, 2, 3, 4, 5, 6),
)  # fmt: skip
