"""The calibration of a machine by Universal Robots, as its controller or the ROS driver stores it.

References: Universal Robots, DH parameters for calculations of kinematics and dynamics;
`ur_calibration` of the Universal Robots ROS driver, whose file has a pose for each joint.
"""

import os
import re

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot, pose, to_xyz_euler_zyx
from irbkin.errors import InvalidModelError

DELTAS = ("delta_theta", "delta_a", "delta_d", "delta_alpha")
LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
FIELDS = ("x", "y", "z", "roll", "pitch", "yaw")
# Farthest that a calibrated arm may be from the nominal one, as a part of its length [1].
SAME_ARM = 0.05
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def load_ur(robot: Robot, text_or_path: str | os.PathLike[str]) -> Robot:
    """Return a Universal Robots arm with the calibration of a machine.

    The answer is of structure "general". `with_nominal(robot)` of it solves it from the branches of
    the nominal arm. Tool, base and limits are those of `robot`.

    Args:
        robot: The arm of the catalog, such as `Robot("UR5e")`.
        text_or_path: `calibration.conf` of the controller, or the yaml that `ur_calibration` writes
            (`my_robot_calibration.yaml`): the path of the file, or its text.

    Raises:
        InvalidModelError: The text has no such calibration, a number is missing, or the calibrated
            arm is not near `robot`.
        OSError: The file cannot be read.
    """
    if robot.dof != 6 or "three parallel axes" not in robot.structure:
        raise InvalidModelError(
            f"robot is {robot!r}, it must be an arm of Universal Robots, such as Robot('UR5e')"
        )
    text = _text(text_or_path)
    frames = _of_deltas(robot, text) if "delta_theta" in text else _of_poses(text)
    bare = Robot.from_urdf(_urdf(frames, robot), name=robot.name)
    found = bare.with_base(robot.base).with_tool(robot.tool)
    off = np.linalg.norm(found.fk(np.zeros(6))[:3, 3] - robot.fk(np.zeros(6))[:3, 3])
    if off > SAME_ARM * np.abs(robot.mdh[:, 1:3]).sum():
        raise InvalidModelError(
            f"the calibrated arm is {off:.3g} m off {robot.name} at zero joint angles: is it the "
            "calibration of another arm?"
        )
    return found


def _text(text_or_path: str | os.PathLike[str]) -> str:
    if isinstance(text_or_path, str) and ("\n" in text_or_path or "=" in text_or_path):
        return text_or_path
    with open(text_or_path, encoding="utf-8", errors="replace") as file:
        return file.read()


def _of_deltas(robot: Robot, text: str) -> list[Floats]:
    """Frames at zero joint angles between the axes: Tz(d) Tx(a) Rx(alpha), each after its Rz."""
    deltas = [_array(text, name) for name in DELTAS]
    alpha, a, d, theta = robot.mdh.T
    standard = np.array([theta, np.r_[a[1:], 0.0], d, np.r_[alpha[1:], 0.0]])
    frames = [np.eye(4)]
    for theta, a, d, alpha in (standard + deltas).T:
        turn = pose(np.zeros(3), euler_zyx=[theta, 0.0, 0.0])
        shift = pose(np.zeros(3), euler_zyx=[0.0, 0.0, alpha])
        shift[:3, 3] = a, 0.0, d
        frames.append(turn @ shift)
    return frames


def _array(text: str, name: str) -> Floats:
    found = re.search(rf"^\s*{name}\s*=\s*\[([^\]]*)\]", text, re.MULTILINE)
    numbers = re.findall(NUMBER, found[1]) if found else []
    if len(numbers) != 6:
        raise InvalidModelError(
            f"{name} of the calibration has {len(numbers)} numbers, it must have 6: "
            f"{name} = [0.1, ...]"
        )
    return np.array(numbers, dtype=np.float64)


def _of_poses(text: str) -> list[Floats]:
    """The origin of each joint in the link before."""
    frames = []
    for link in LINKS:
        block = re.search(rf"^(\s*){link}\s*:\s*\n((?:\1\s+.*\n?)+)", text, re.MULTILINE)
        if block is None:
            raise InvalidModelError(
                f"the calibration has no {link}: it must be calibration.conf of a controller or "
                "the yaml of ur_calibration"
            )
        values = []
        for field in FIELDS:
            found = re.search(rf"^\s*{field}\s*:\s*({NUMBER})\s*$", block[2], re.MULTILINE)
            if found is None:
                raise InvalidModelError(f"{link} of the calibration has no number {field}")
            values.append(float(found[1]))
        frame = pose(np.zeros(3), euler_zyx=values[:2:-1])
        frame[:3, 3] = values[:3]
        frames.append(frame)
    return [*frames, np.eye(4)]


def _urdf(frames: list[Floats], robot: Robot) -> str:
    """The chain as URDF: frames between axes along z, the last one of the tool."""
    velocity = np.zeros(robot.dof) if robot.max_velocity is None else robot.max_velocity
    lines = ['<robot name="ur"><link name="l0"/>']
    for joint, frame in enumerate(frames, 1):
        xyz, zyx = to_xyz_euler_zyx(frame)
        place = " ".join(map(repr, map(float, xyz))), " ".join(map(repr, map(float, zyx[::-1])))
        kind = "revolute" if joint <= 6 else "fixed"
        lines.append(
            f'<link name="l{joint}"/><joint name="j{joint}" type="{kind}"><parent '
            f'link="l{joint - 1}"/><child link="l{joint}"/><origin xyz="{place[0]}" '
            f'rpy="{place[1]}"/><axis xyz="0 0 1"/>'
        )
        if joint <= 6:
            lower, upper = np.clip(robot.limits[joint - 1], -1e5, 1e5).tolist()
            speed = float(velocity[joint - 1])
            lines.append(f'<limit lower="{lower!r}" upper="{upper!r}" velocity="{speed!r}"/>')
        lines.append("</joint>")
    return "".join([*lines, "</robot>"])
