"""The answers of a ROS node, without ROS."""

import contextlib
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin._arguments import check_robot
from irbkin._arrays import Floats, finite, limit_of_each
from irbkin._core import Robot, Trajectory, retime
from irbkin.errors import InvalidJointsError, InvalidMotionError, InvalidPoseError, IrbkinError
from irbkin.freedom import Track
from irbkin.ros.messages import Message, read_pose, read_poses, write_pose

# How far a start may exceed a limit [rad], as everywhere: rounding of what was reported there. It
# is moved to the limit.
START_TOLERANCE = 1e-6

# A point of a trajectory, of which a node makes a message: positions [rad], velocities [rad/s],
# accelerations [rad/s^2] and the time from the start [s].
Point = Callable[[list[float], list[float], list[float], float], Any]


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
            self._write_trajectory(trajectory, response.trajectory, point)
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
        """The path in the shortest time within the limits."""
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

    def _write_trajectory(self, trajectory: Trajectory, message: Message, point: Point) -> None:
        message.header.frame_id = self.base_frame
        track = [] if self._track is None else [self._track_name]
        message.joint_names = [*self.joint_names, *track]
        rows = (trajectory.q, trajectory.dq, trajectory.ddq, trajectory.t)
        message.points = [
            point(*row) for row in zip(*(part.tolist() for part in rows), strict=True)
        ]


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
    """Numbers of a sequence; a tuple in ROS 1, an `array.array` in ROS 2."""
    return np.asarray(values, dtype=np.float64)
