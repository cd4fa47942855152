"""Answers of a ROS node, without ROS: the nodes of ROS 1 and ROS 2 in `ros/` share it.

`Kinematics` reads requests and fills responses of the services of `irbkin_interfaces`: objects with
these attributes, of ROS 1 (as `geometry_msgs.msg.Pose` of genpy), of ROS 2 (of rosidl), or plain
structures with the same fields. Numbers of a sequence arrive as a tuple, a list, an `array.array`
or, of `uint8[]` in ROS 1, as `bytes`. The parameters of a node are the same in ROS 1 and ROS 2.

>>> from types import SimpleNamespace as Structure
>>> import irbkin, irbkin.ros
>>> node = irbkin.ros.Kinematics(irbkin.Robot("IRB 1600-6/1.45"))
>>> beyond = Structure(
...     position=Structure(x=3.0, y=0.0, z=0.5), orientation=Structure(x=0.0, y=0.0, z=0.0, w=1.0)
... )
>>> node.check_pose(Structure(pose=beyond), Structure()).reason
'wrist center 1550.5 mm beyond reach'
"""

import contextlib
import re
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arguments import check_robot
from irbkin._arrays import Floats, finite, limit_of_each
from irbkin._core import Robot, Trajectory, pose, retime, to_xyz_wxyz
from irbkin.errors import (
    InvalidJointsError,
    InvalidModelError,
    InvalidMotionError,
    InvalidPoseError,
    IrbkinError,
)
from irbkin.freedom import Track

__all__ = [
    "PARAMETERS",
    "IkSolutions",
    "Kinematics",
    "Parameter",
    "kinematics_of",
    "read_pose",
    "read_solutions",
    "service_prefix",
    "write_pose",
]

# A message, or a request or response of a service of irbkin_interfaces: its fields are in the .msg
# and .srv files, which Python's types do not know.
Message = Any
# How far a start may exceed a limit [rad], as everywhere: rounding of what was reported there. It
# is moved to the limit.
START_TOLERANCE = 1e-6

# A point of a trajectory, of which a node makes a message: positions [rad], velocities [rad/s],
# accelerations [rad/s^2] and the time from the start [s].
Point = Callable[[list[float], list[float], list[float], float], Any]


class IkSolutions(NamedTuple):
    """The solutions in the response of an IK service."""

    q: Floats
    """Joint angles [rad], shape (k, n), inside the limits or not."""
    slot: npt.NDArray[np.uint8]
    """Slot of each, shape (k,)."""
    status: npt.NDArray[np.uint8]
    """`irbkin.Status` of each, shape (k,)."""


def read_pose(message: Message) -> Floats:
    """Return the homogeneous matrix of a `geometry_msgs/Pose`, shape (4, 4).

    Raises:
        InvalidPoseError: A number is not finite, or the quaternion's norm is not one.
    """
    p, o = message.position, message.orientation
    return pose([p.x, p.y, p.z], xyzw=[o.x, o.y, o.z, o.w])


def read_poses(messages: Sequence[Message]) -> Floats:
    """As `read_pose` of many, shape (m, 4, 4); an error has the index of the first."""
    p = [[m.position.x, m.position.y, m.position.z] for m in messages]
    o = [[m.orientation.x, m.orientation.y, m.orientation.z, m.orientation.w] for m in messages]
    return pose(p, xyzw=o) if p else np.empty((0, 4, 4))


def write_pose(T: npt.ArrayLike, message: Message) -> None:
    """Write a homogeneous matrix into a `geometry_msgs/Pose`."""
    xyz, wxyz = to_xyz_wxyz(T)
    p, o = message.position, message.orientation
    p.x, p.y, p.z = xyz.tolist()
    o.w, o.x, o.y, o.z = wxyz.tolist()


def read_solutions(response: Message) -> IkSolutions:
    """Return the solutions of the response of an IK service, of ROS 1 or ROS 2, as arrays.

    Args:
        response: `irbkin_interfaces/IK` response: its `joints`, `slots` and `statuses`.

    Raises:
        ValueError: The lengths do not fit together.
    """
    joints: Sequence[float] = response.joints
    # `bytes` in ROS 1, `array.array` in ROS 2; both give integers when iterated.
    fields = response.slots, response.statuses
    slots, statuses = (np.frombuffer(bytes(field), dtype=np.uint8) for field in fields)
    if len(slots) != len(statuses) or (len(joints) % len(slots) if len(slots) else len(joints)):
        raise ValueError(
            f"response has {len(joints)} joints, {len(slots)} slots and {len(statuses)} statuses: "
            "there must be one slot, one status and as many joints as the arm has a solution"
        )
    q = np.asarray(joints, dtype=np.float64).reshape(len(slots), -1 if len(slots) else 0)
    return IkSolutions(q, slots, statuses)


class Kinematics:
    """Answer the services of `irbkin_interfaces` and target poses, for one robot.

    Each method reads a request, fills the response that it is given and returns it. What is wrong
    with a request, or out of reach, is in the response: `success` is False, `message` is the
    reason. No method but `joint_state` raises. Calls from several threads are safe.

    Args:
        robot: The arm. Poses are of its tool, in `base_frame`.
        base_frame: Frame in which poses are given.
        joint_names: Names of its joints; when not given, as in the URDF that the robot was read
            from, else `joint_1` .. as in `robot.to_urdf()`.
        start: Joint vector [rad] to which the first target pose's solution is the nearest, shape
            (n,); zeros, moved inside the limits, when not given.
        weights: Cost of moving each joint, shape (n,); ones when not given.
        max_velocity: Limits of planned paths [rad/s], shape (n,); the robot's when not given.
        max_acceleration: Limits of planned paths [rad/s^2], shape (n,). No catalog has them:
            without them `plan_path` plans nothing.
        track: A track under the robot, along which `plan_path` may move it.
        track_name: Its name, behind the joint names.
        track_acceleration: Its limit [m/s^2].

    Raises:
        InvalidJointsError, InvalidMotionError: A vector has a wrong length, is not finite or not
            positive, `start` is outside the limits, or there are not as many different names as
            joints.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        base_frame: str = "base_link",
        joint_names: Sequence[str] | None = None,
        start: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        max_velocity: npt.ArrayLike | None = None,
        max_acceleration: npt.ArrayLike | None = None,
        track: Track | None = None,
        track_name: str = "track",
        track_acceleration: float = 1.0,
    ) -> None:
        check_robot(robot)
        self.robot = robot
        self.base_frame = base_frame
        numbered = [f"joint_{i + 1}" for i in range(robot.dof)]
        self.joint_names = list(joint_names or robot._file_joint_names or numbered)
        if len(self.joint_names) != robot.dof:
            raise InvalidJointsError(
                f"joint_names has {len(self.joint_names)} names, {robot.name} has {robot.dof} "
                "joints"
            )
        names = [*self.joint_names, *([] if track is None else [track_name])]
        for index, name in enumerate(names):
            if not name or name in names[:index]:
                raise InvalidJointsError(
                    f"joint_names and track_name have {name!r} twice or empty: each joint must "
                    "have a name of its own"
                )
        self._weights = None if weights is None else _weights(weights, robot)
        self._lock = threading.Lock()
        self._last = _start(start, robot)

        def each(limit: npt.ArrayLike | None, name: str) -> Floats | None:
            return None if limit is None else limit_of_each(limit, name, robot.dof)

        max_velocity = robot.max_velocity if max_velocity is None else max_velocity
        self._max_velocity = each(max_velocity, "max_velocity")
        self._max_acceleration = each(max_acceleration, "max_acceleration")
        self._track, self._track_name = track, track_name
        self._track_acceleration = track_acceleration

    @property
    def last(self) -> Floats:
        """The last solution of a target pose, or the start [rad], shape (n,)."""
        with self._lock:
            return self._last.copy()

    def fk(self, request: Message, response: Message) -> Message:
        """Answer `FK`: the pose of the tool for joint angles."""
        with _answered(response):
            write_pose(self.robot.fk(_vector(request.joints)), response.pose.pose)
            response.pose.header.frame_id = self.base_frame
        return response

    def ik(self, request: Message, response: Message) -> Message:
        """Answer `IK`: every solution of a pose, and the one that is nearest to a seed."""
        with _answered(response):
            T = read_pose(request.pose)
            seven = self.robot.dof == 7
            solutions = self.robot.ik(T, request.q7) if seven else self.robot.ik(T)
            response.joints = solutions.q.ravel().tolist()
            # bytes fit `uint8[]` of both: ROS 1 sends nothing else, ROS 2 takes any sequence.
            response.slots = bytes(solution.slot for solution in solutions)
            response.statuses = bytes(solution.status for solution in solutions)
            # The filled fields stay if no solution is inside the limits.
            seed = _vector(request.seed) if len(request.seed) else self.last
            response.nearest = solutions.nearest(seed, self._weights).q.tolist()
            response.message = solutions.explain()
        return response

    def check_pose(self, request: Message, response: Message) -> Message:
        """Answer `CheckPose`: whether a pose can be reached, and the reason if it cannot."""
        try:
            check = self.robot.check_pose(read_pose(request.pose))
        except IrbkinError as error:
            response.reachable, response.within_limits, response.reason = False, False, str(error)
        else:
            response.reachable, response.within_limits, response.reason = check
        return response

    def plan_path(self, request: Message, response: Message, point: Point) -> Message:
        """Answer `PlanPath`: the best joint path along poses, in the shortest time.

        Args:
            request: `path`, `start`, `tool_angles` and `max_tool_speed`.
            response: Its `trajectory` is filled, but for the time stamp.
            point: Makes a `trajectory_msgs/JointTrajectoryPoint` of positions, velocities,
                accelerations and the time from the start [s].
        """
        with _answered(response):
            self._check_frame(request.path)
            poses = read_poses(request.path.poses)
            if len(poses) < 2:
                raise InvalidMotionError(
                    f"path has {len(poses)} poses, a trajectory needs at least 2"
                )
            trajectory = self._planned(poses, request)
            message = response.trajectory
            message.header.frame_id = self.base_frame
            track = [] if self._track is None else [self._track_name]
            message.joint_names = [*self.joint_names, *track]
            rows = (trajectory.q, trajectory.dq, trajectory.ddq, trajectory.t)
            message.points = [
                point(*row) for row in zip(*(part.tolist() for part in rows), strict=True)
            ]
            response.message = f"{len(poses)} poses in {trajectory.duration:.3f} s"
        return response

    def joint_state(self, target: Message, message: Message) -> Message:
        """Fill a `sensor_msgs/JointState` with the solution of a target pose that is nearest to the
        last one, which it becomes.

        Args:
            target: `geometry_msgs/PoseStamped`.
            message: Its `name` and `position` are filled, the time stamp is not.

        Raises:
            UnreachableError: No solution is inside the limits; the message says what is missing.
            InvalidPoseError: The pose is invalid, or given in another frame.
        """
        self._check_frame(target)
        T = read_pose(target.pose)
        with self._lock:
            self._last = self.robot.ik_nearest(T, self._last, self._weights)
            position = self._last.tolist()
        message.name, message.position = list(self.joint_names), position
        return message

    def _check_frame(self, message: Message) -> None:
        frame = message.header.frame_id
        # tf2 has no leading slash; old publishers do.
        if frame.lstrip("/") not in ("", self.base_frame):
            raise InvalidPoseError(
                f'the pose is given in frame "{frame}", it must be in "{self.base_frame}": '
                "transform it with tf2 first"
            )

    def _planned(self, T: Floats, request: Message) -> Trajectory:
        velocity, acceleration = self._max_velocity, self._max_acceleration
        if velocity is None or acceleration is None:
            missing = "max_velocity" if velocity is None else "max_acceleration"
            raise InvalidMotionError(
                f"the time of a path depends on limits of the joints that are not known: set the "
                f"parameter {missing}"
            )
        start = _vector(request.start) if len(request.start) else None
        plan = self.robot.plan(
            T,
            rotation=request.tool_angles or None,
            start=start,
            weights=self._weights,
            carrier=self._track,
        )
        q = np.hstack([plan.q, plan.external])
        if self._track is not None:
            velocity = np.append(velocity, self._track.max_velocity)
            acceleration = np.append(acceleration, self._track_acceleration)
        if request.max_tool_speed == 0.0:
            return retime(q, velocity, acceleration)
        return retime(q, velocity, acceleration, T=T, max_tool_speed=request.max_tool_speed)


def _start(start: npt.ArrayLike | None, robot: Robot) -> Floats:
    """A joint vector inside the limits; zeros, moved inside them, when not given."""
    lower, upper = robot.limits.T
    if start is None:
        return np.clip(np.zeros(robot.dof), lower, upper)
    q = finite(start, "start", (robot.dof,), InvalidJointsError)
    excess = np.maximum(lower - q, q - upper)
    for index in np.flatnonzero(excess > START_TOLERANCE):
        raise InvalidJointsError(
            f"start[{index}] is {q[index]:.4g} rad, joint {index + 1} must be "
            f"{lower[index]:.4g} to {upper[index]:.4g} rad, exceeded by {excess[index]:.2g} rad"
        )
    return np.clip(q, lower, upper)


def _weights(weights: npt.ArrayLike, robot: Robot) -> Floats:
    costs = finite(weights, "weights", (robot.dof,), InvalidJointsError)
    for index in np.flatnonzero(costs < 0.0):
        raise InvalidJointsError(f"weights[{index}] is {costs[index]}, it must be 0 or more")
    return costs


@contextlib.contextmanager
def _answered(response: Message) -> Iterator[None]:
    """Say in a response whether it is filled, or why not."""
    response.message, response.success = "", True
    try:
        yield
    except IrbkinError as error:
        response.message, response.success = str(error), False


def _vector(values: Sequence[float]) -> Floats:
    return np.asarray(values, dtype=np.float64)


class Parameter(NamedTuple):
    """A parameter of a node. An empty value stands for none."""

    name: str
    description: str
    """Its meaning, with the unit."""
    default: str = ""
    """Its default as text; "" for none."""
    kind: type[str] | type[float] = str
    """str, or float for an array of numbers."""
    is_array: bool = False


def _numbers(name: str, description: str) -> Parameter:
    return Parameter(name, description, kind=float, is_array=True)


PARAMETERS = (
    Parameter("robot", "Catalog name of the robot, such as IRB 1600-6/1.45"),
    Parameter("robot_description", "Text or path of a URDF, in place of robot"),
    Parameter("tip_link", "Link of robot_description whose poses are given; its only tip if empty"),
    Parameter("base_frame", "Frame of poses; the base link of robot_description", "base_link"),
    _numbers("tool", "Tool center point in the flange: x y z [m] and quaternion x y z w"),
    Parameter(
        "joint_names",
        "Names of the joints; if empty as in robot_description, else joint_1 ..",
        is_array=True,
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
    Parameter("track_name", "Name of the track in planned trajectories", "track"),
    Parameter("service_prefix", "Of the names of services; irb1600_kinematics for an IRB 1600"),
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
