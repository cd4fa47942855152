"""Seven-axis arms that are not in the catalog, by the figures of two sources each.

Rethink's Sawyer: RethinkRobotics/sawyer_robot @ 2fe61d9148, sawyer_base.urdf.xacro. Kinova's Gen3
with seven joints: Kinovarobotics/ros_kortex @ 5fce8b7ab9, arms/gen3/7dof/urdf/gen3_macro.xacro.
Flexiv's Rizon 4: flexivrobotics/flexiv_description @ 1f5dc02cec, config/Rizon4. The second source
of each is google-deepmind/mujoco_menagerie: @ 28ffb48b5c, @ 3966424703 and @ 946194e0bd.
"""

from dataclasses import dataclass

import numpy as np

HALF, QUARTER = 3.1416, 1.5708  # as Kinova rounds them
PI = np.pi
FREE = (-PI, PI)
# w x y z of quarter turns about x, as Menagerie has them.
FORWARD, BACK = (1, 1, 0, 0), (1, -1, 0, 0)
AROUND, AHEAD = (0, 0, 0, 1), (1, 0, 0, 0)


@dataclass(frozen=True)
class Arm:
    """Rows of xyz [m] and rpy [rad] of the first source, quaternion w x y z of the second, limits
    [rad]; the axes of the joints.
    """

    joints: list
    axes: str = "zzzzzzz"

    def urdf(self):
        parts = ['<robot name="arm"><link name="link0"/>']
        for i, ((xyz, rpy, _, limits), axis) in enumerate(
            zip(self.joints, self.axes, strict=True), start=1
        ):
            numbers = {"xyz": xyz, "rpy": rpy, "axis": [int(axis == name) for name in "xyz"]}
            text = {key: " ".join(map(repr, values)) for key, values in numbers.items()}
            parts.append(
                f'<link name="link{i}"/><joint name="joint{i}" type="revolute">'
                f'<parent link="link{i - 1}"/><child link="link{i}"/>'
                f'<origin xyz="{text["xyz"]}" rpy="{text["rpy"]}"/><axis xyz="{text["axis"]}"/>'
                f'<limit lower="{limits[0]}" upper="{limits[1]}" effort="1" velocity="1"/></joint>'
            )
        return "".join([*parts, "</robot>"])


ARMS = {
    "Sawyer": Arm(
        [
            ((0, 0, 0.08), (0, 0, 0), AHEAD, (-3.0503, 3.0503)),
            ((0.081, 0.05, 0.237), (-PI / 2, PI / 2, 0), (1, -1, 1, 1), (-3.8095, 2.2736)),
            ((0, -0.14, 0.1425), (PI / 2, 0, 0), FORWARD, (-3.0426, 3.0426)),
            ((0, -0.042, 0.26), (-PI / 2, 0, 0), BACK, (-3.0439, 3.0439)),
            ((0, -0.125, -0.1265), (PI / 2, 0, 0), FORWARD, (-2.9761, 2.9761)),
            ((0, 0.031, 0.275), (-PI / 2, 0, 0), BACK, (-2.9761, 2.9761)),
            (
                (0, -0.11, 0.1053),
                (-PI / 2, -0.17453, 3.1416),
                (0.0616248, 0.06163, -0.704416, 0.704416),
                (-4.7124, 4.7124),
            ),
        ]
    ),
    "Gen3": Arm(
        [
            ((0, 0, 0.15643), (HALF, 0, 0), (0, 1, 0, 0), FREE),
            ((0, 0.005375, -0.12838), (QUARTER, 0, 0), FORWARD, (-2.41, 2.41)),
            ((0, -0.21038, -0.006375), (-QUARTER, 0, 0), BACK, FREE),
            ((0, 0.006375, -0.21038), (QUARTER, 0, 0), FORWARD, (-2.66, 2.66)),
            ((0, -0.20843, -0.006375), (-QUARTER, 0, 0), BACK, FREE),
            ((0, 0.00017505, -0.10593), (QUARTER, 0, 0), FORWARD, (-2.23, 2.23)),
            ((0, -0.10593, -0.00017505), (-QUARTER, 0, 0), BACK, FREE),
        ]
    ),
    "Rizon 4": Arm(
        [
            ((0, 0, 0.155), (0, 0, -PI), AROUND, (-2.8798, 2.8798)),
            ((0, 0.03, 0.21), (0, 0, 0), AHEAD, (-2.3562, 2.3562)),
            ((0, 0.035, 0.205), (0, 0, 0), AHEAD, (-3.0543, 3.0543)),
            ((-0.02, -0.03, 0.19), (0, 0, -PI), AROUND, (-1.9548, 2.7751)),
            ((-0.02, 0.025, 0.195), (0, 0, -PI), AROUND, (-3.0543, 3.0543)),
            ((0, 0.03, 0.19), (0, 0, 0), AHEAD, (-1.4835, 4.6251)),
            ((-0.015, 0.073, 0.11), (0, -PI / 2, 0), (1, 0, -1, 0), (-3.0543, 3.0543)),
        ],
        axes="zyzyzyz",
    ),
}


def turned(axis, angle):
    """A turn about x, y or z, (4, 4)."""
    turn, (i, j) = np.eye(4), {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    turn[i, i] = turn[j, j] = np.cos(angle)
    turn[i, j], turn[j, i] = -np.sin(angle), np.sin(angle)
    return turn


def of_quaternion(wxyz):
    w, *v = np.array(wxyz) / np.linalg.norm(wxyz)
    v, turn = np.array(v), np.eye(4)
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    turn[:3, :3] = (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross
    return turn


def fk(arm, q):
    """The last link of an arm by the second source's quaternions."""
    pose = np.eye(4)
    for (xyz, _, wxyz, _), axis, angle in zip(arm.joints, arm.axes, q, strict=True):
        place = of_quaternion(wxyz)
        place[:3, 3] = xyz
        pose = pose @ place @ turned(axis, angle)
    return pose
