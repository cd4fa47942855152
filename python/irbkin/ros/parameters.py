"""The parameters of a node, the same in ROS 1 and ROS 2."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from irbkin._arguments import check_robot
from irbkin._arrays import finite
from irbkin._core import Robot, pose
from irbkin.errors import InvalidModelError, InvalidMotionError, InvalidPoseError, IrbkinError
from irbkin.freedom import Track
from irbkin.ros.answers import Kinematics


class Parameter(NamedTuple):
    """A parameter of a node. An empty value stands for none."""

    name: str
    kind: type[str] | type[float]
    """str, or float for an array of numbers."""
    is_array: bool
    default: str
    """Its default as text; "" for none."""
    description: str
    """Its meaning, with the unit."""


def _text(name: str, default: str, description: str) -> Parameter:
    return Parameter(name, str, False, default, description)


def _numbers(name: str, description: str) -> Parameter:
    return Parameter(name, float, True, "", description)


PARAMETERS = (
    _text("robot", "", "Catalog name of the robot, such as IRB 1600-6/1.45"),
    _text("robot_description", "", "Text or path of a URDF, in place of robot"),
    _text("tip_link", "", "Link of robot_description whose poses are given; its only tip if empty"),
    _text("base_frame", "base_link", "Frame of poses; the base link of robot_description"),
    _numbers("tool", "Tool center point in the flange: x y z [m] and quaternion x y z w"),
    Parameter(
        "joint_names",
        str,
        True,
        "",
        "Names of the joints; if empty as in robot_description, else joint_1 ..",
    ),
    _numbers("start", "Joints to which the first target's solution is near [rad]; zeros if empty"),
    _numbers("weights", "Cost of moving each joint; ones if empty"),
    _numbers("max_velocity", "Limits of planned paths [rad/s]; the robot's if empty"),
    _numbers("max_acceleration", "Limits of planned paths [rad/s^2]; plan_path needs them"),
    _numbers(
        "track",
        "Track under the robot: its direction x y z, lower and upper end [m], limits of "
        "velocity [m/s] and acceleration [m/s^2]; none if empty",
    ),
    _text("track_name", "track", "Name of the track in planned trajectories"),
    _text("service_prefix", "", "Of the names of services; irb1600_kinematics for an IRB 1600"),
)


def kinematics_of(values: Mapping[str, Any]) -> Kinematics:
    """Return the answers of a node with these parameters.

    Args:
        values: Values of `PARAMETERS` by name; one that is missing has its default.

    Raises:
        IrbkinError: A value is invalid; the message names the parameter.
    """
    read = {parameter.name: _value(parameter, values) for parameter in PARAMETERS}
    base_frame, prefix = read["base_frame"], read["service_prefix"]
    if prefix and not re.fullmatch(r"/?[A-Za-z]\w*(/[A-Za-z]\w*)*", prefix, re.ASCII):
        raise IrbkinError(
            f"service_prefix is {prefix!r}, it must be a name: letters, digits and underscores, a "
            "letter first"
        )
    robot = _robot(read)
    if len(read["tool"]):
        tool = finite(read["tool"], "tool", (7,), InvalidPoseError)
        robot = robot.with_tool(pose(tool[:3], xyzw=tool[3:]))
    options = ("joint_names", "start", "weights", "max_velocity", "max_acceleration")
    given = {name: read[name] for name in options if len(read[name])}
    if len(read["track"]):
        x, y, z, lower, upper, velocity, acceleration = finite(
            read["track"], "track", (7,), InvalidMotionError
        ).tolist()
        if not (velocity > 0.0 and acceleration > 0.0 and lower < upper and (x, y, z) != (0, 0, 0)):
            raise InvalidMotionError(
                f"track is {read['track']!r}: its direction must have a length, its ends lower < "
                "upper, its limits must be positive"
            )
        given["track"] = Track((x, y, z), lower, upper, max_velocity=velocity)
        given["track_acceleration"] = acceleration
        given["track_name"] = read["track_name"]
    return Kinematics(robot, base_frame=base_frame, **given)


def service_prefix(robot: Robot) -> str:
    """Return the first part of the names of a robot's services: "irb1600_kinematics".

    It is the type without its variant: what is before the first "-", "/" or parenthesis.
    """
    check_robot(robot)
    kind = re.split(r"[-/(]", robot.name.lower())[0]
    kind = re.sub(r"[^a-z0-9_]", "", kind)
    return f"{kind if re.match('[a-z]', kind) else f'robot{kind}'}_kinematics"


def _robot(read: Mapping[str, Any]) -> Robot:
    if read["robot"]:
        if read["robot_description"]:
            raise InvalidModelError("robot and robot_description are both given: give one")
        return Robot(read["robot"])
    if not read["robot_description"]:
        raise InvalidModelError(
            'robot is empty: give a catalog name such as "IRB 1600-6/1.45", or robot_description'
        )
    try:
        return Robot.from_urdf(
            read["robot_description"], read["base_frame"] or None, read["tip_link"] or None
        )
    except OSError as error:
        raise InvalidModelError(f"robot_description: {error}") from error


def _value(parameter: Parameter, values: Mapping[str, Any]) -> Any:
    """The value of a parameter, checked to be of its type."""
    value = values.get(parameter.name)
    if value is None:
        return [] if parameter.is_array else parameter.default
    if not parameter.is_array:
        if not isinstance(value, str):
            raise IrbkinError(f"{parameter.name} is {value!r}, it must be a text")
        return value
    wanted = "texts" if parameter.kind is str else "numbers"
    is_sequence = isinstance(value, Sequence | np.ndarray) or hasattr(value, "tolist")
    elements = list(value) if is_sequence and not isinstance(value, str | bytes) else [None]
    fits = (str,) if parameter.kind is str else (int, float)
    if not all(isinstance(element, fits) and element is not True for element in elements):
        raise IrbkinError(f"{parameter.name} is {value!r}, it must be an array of {wanted}")
    return elements
