"""The ROS 2 node: the kinematics of one robot as services and topics.

`irbkin.ros` has the answers; here they get their names.
"""

from __future__ import annotations

import sys
from typing import Any

import rclpy
from geometry_msgs.msg import PoseStamped
from irbkin import IrbkinError, ros
from irbkin_interfaces.srv import FK, IK, CheckPose, PlanPath
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectoryPoint

# How long the node may wait before it looks whether it must end [s]. rclpy 7.1 wakes a waiting
# node on SIGTERM and shuts down after that: a node that waits again in between, without a bound,
# waits forever.
LONGEST_WAIT = 0.5


class KinematicsNode(Node):
    """Services fk, ik, check_pose and plan_path, and target poses to joint states.

    Raises:
        IrbkinError: A parameter is invalid; the message names it.
    """

    def __init__(self) -> None:
        super().__init__("irbkin")
        values = {parameter.name: self._declared(parameter) for parameter in ros.PARAMETERS}
        self.kinematics = kinematics = ros.kinematics_of(values)
        prefix = values["service_prefix"] or ros.service_prefix(kinematics.robot)
        self.create_service(FK, f"{prefix}/fk", kinematics.fk)
        self.create_service(IK, f"{prefix}/ik", kinematics.ik)
        self.create_service(CheckPose, f"{prefix}/check_pose", kinematics.check_pose)
        self.create_service(PlanPath, "plan_path", self._plan_path)
        self.joint_states = self.create_publisher(JointState, "joint_states", 10)
        self.create_subscription(PoseStamped, "target_pose", self._follow_target, 10)
        self.get_logger().info(f"{kinematics.robot.name}: {prefix}/fk, ik, check_pose are ready")

    def _declared(self, parameter: ros.Parameter) -> Any:
        """The value of a parameter; None for an array that is not set."""
        # Any type is read, and `irbkin.ros` checks it: whole numbers are numbers, too.
        descriptor = ParameterDescriptor(
            description=parameter.description, read_only=True, dynamic_typing=True
        )
        default = None if parameter.is_array else parameter.default
        return self.declare_parameter(parameter.name, default, descriptor).value

    def _follow_target(self, target: PoseStamped) -> None:
        try:
            state = self.kinematics.joint_state(target, JointState())
        except IrbkinError as error:
            self.get_logger().warning(f"target_pose: {error}")
            return
        state.header.stamp = self.get_clock().now().to_msg()
        self.joint_states.publish(state)

    def _plan_path(
        self, request: PlanPath.Request, response: PlanPath.Response
    ) -> PlanPath.Response:
        self.kinematics.plan_path(request, response, trajectory_point)
        response.trajectory.header.stamp = self.get_clock().now().to_msg()
        return response


def trajectory_point(
    q: list[float], dq: list[float], ddq: list[float], t: float
) -> JointTrajectoryPoint:
    """Return a point of a JointTrajectory, `t` seconds from its start."""
    return JointTrajectoryPoint(
        positions=q,
        velocities=dq,
        accelerations=ddq,
        time_from_start=Duration(seconds=t).to_msg(),
    )


def main() -> None:
    """Run the node until Ctrl-C or SIGTERM."""
    rclpy.init()
    try:
        executor = SingleThreadedExecutor()
        executor.add_node(KinematicsNode())
        while rclpy.ok():
            executor.spin_once(timeout_sec=LONGEST_WAIT)
    except IrbkinError as error:
        rclpy.logging.get_logger("irbkin").fatal(str(error))
        sys.exit(1)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except Exception:
        # A signal while the node is made, or waits, invalidates what it works with.
        if rclpy.ok():
            raise
    finally:
        rclpy.try_shutdown()
