"""The ROS 2 node over a real middleware: `make test-ros` runs it in ROS 2's environment."""

import contextlib
import json
import os
import random
import sys
import tempfile
import threading
import time
from pathlib import Path

import checks
import rclpy
from checks import KINDS, Process, fill, wait_for
from geometry_msgs.msg import Pose, PoseArray, PoseStamped
from irbkin_interfaces import srv
from rcl_interfaces.srv import DescribeParameters
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from sensor_msgs.msg import JointState

INSTALLED = Path(__file__).parents[2] / ".venv-ros2/ws/install"
NODE = INSTALLED / "irbkin_ros2/lib/irbkin_ros2/kinematics"

# The node, shut down as by rclpy's signal handler if the node waits again too early: the handler
# wakes who waits, and shuts the context down after that, without waking anybody. Run with rclpy's
# own `spin`, the node then waits forever.
LATE = """
import sys, threading, rclpy, irbkin_ros2.node as node

def shut_down():
    handle = rclpy.get_default_context().handle
    with handle:
        handle.shutdown()

class Node(node.KinematicsNode):
    def __init__(self):
        super().__init__()
        threading.Timer(1.0, shut_down).start()

class Executor(node.SingleThreadedExecutor):
    def spin_once(self, timeout_sec=None):
        super().spin_once()

node.KinematicsNode = Node
if sys.argv.pop(1) == "spin":
    node.SingleThreadedExecutor = Executor
node.main()
"""


class Node:
    """The node as a client sees it."""

    pose = Pose

    def __init__(self, process):
        self.log = process.text
        self.states = []
        self.clients = {}
        self.node = rclpy.create_node("check")
        self.targets = self.node.create_publisher(PoseStamped, "/target_pose", 10)
        self.node.create_subscription(JointState, "/joint_states", self.states.append, 10)
        # A client's `call` is answered by a thread that spins; it is ten times as fast as
        # `spin_until_future_complete`.
        threading.Thread(target=self.spin).start()
        assert wait_for(lambda: self.services() >= {*checks.SERVICES, "/plan_path"}, 20), (
            process.text()
        )
        assert wait_for(lambda: self.node.count_subscribers("/target_pose"), 20), process.text()
        assert wait_for(lambda: self.node.count_publishers("/joint_states"), 20), process.text()

    def spin(self):
        executor = SingleThreadedExecutor()
        executor.add_node(self.node)
        # As the node itself waits.
        with contextlib.suppress(ExternalShutdownException):
            while rclpy.ok():
                executor.spin_once(timeout_sec=0.5)

    def services(self):
        return {name for name, _ in self.node.get_service_names_and_types()}

    def client(self, kind, name):
        if name not in self.clients:
            self.clients[name] = self.node.create_client(kind, name)
            assert self.clients[name].wait_for_service(20), name
        return self.clients[name]

    def call(self, name, **fields):
        kind = KINDS[name.rsplit("/", 1)[-1]]
        client = self.client(getattr(srv, kind), name)
        return client.call(self.request(kind, **fields))

    def request(self, kind, **fields):
        return getattr(srv, kind).Request(**fields)

    def response(self, kind):
        return getattr(srv, kind).Response()

    def publish(self, pose, frame):
        message = PoseStamped(pose=pose)
        message.header.frame_id = frame
        self.targets.publish(message)

    def pose_array(self, poses, frame):
        message = PoseArray(poses=[fill(Pose(), T) for T in poses])
        message.header.frame_id = frame
        return message

    def clear(self):
        self.states.clear()

    def joint_state(self, seconds):
        return self.states[-1] if wait_for(lambda: self.states, seconds) else None

    def stamp(self, message):
        return self.seconds(message.header.stamp)

    def seconds(self, duration):
        return duration.sec + 1e-9 * duration.nanosec


def parameters_are_described(node):
    """Every parameter has its description, and cannot be changed while the node runs."""
    names = [parameter.name for parameter in checks.ros.PARAMETERS]
    client = node.client(DescribeParameters, "/irbkin/describe_parameters")
    described = client.call(DescribeParameters.Request(names=names)).descriptors
    assert [d.description for d in described] == [p.description for p in checks.ros.PARAMETERS]
    assert all(d.read_only for d in described)
    print("  parameters are described")


def a_shutdown_that_wakes_nobody_ends_the_node(start):
    assert code_after_late_shutdown(start, "bounded") == 0
    assert code_after_late_shutdown(start, "spin") is None
    print("  a shutdown that wakes nobody ends the node; with rclpy's spin it waits forever")


def code_after_late_shutdown(start, spin):
    """The exit code, None for a node that has not ended."""
    process = start(["-c", LATE, spin, *assignments(checks.PARAMETERS)])
    try:
        assert wait_for(lambda: "ready" in process.text()), process.text()
        code = process.code(5)
        assert "Traceback" not in process.text(), process.text()
        return code
    finally:
        process.end()


def assignments(parameters):
    pairs = (f"{name}:={json.dumps(value)}" for name, value in parameters.items())
    return ["--ros-args", *(part for pair in pairs for part in ("-p", pair))] if parameters else []


def main(folder):
    began = time.perf_counter()
    os.environ.update(
        ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
        ROS_DOMAIN_ID=str(random.randint(1, 101)),
        ROS_LOG_DIR=str(folder),
    )
    count = 0

    def start(arguments):
        nonlocal count
        count += 1
        log = folder / f"process_{count}.txt"
        return Process([sys.executable, *arguments], os.environ, log)

    def start_node(parameters):
        return start([str(NODE), *assignments(parameters)])

    process = start_node(checks.PARAMETERS)
    try:
        rclpy.init()
        node = Node(process)
        print(f"  node is up and discovered: {time.perf_counter() - began:.2f} s")
        checks.run(node, [*checks.CHECKS, *checks.PATH_CHECKS])
        parameters_are_described(node)
        assert process.end() == 0, process.text()
        assert "Traceback" not in process.text(), process.text()
        checks.refuses_its_parameters(start_node)
        a_shutdown_that_wakes_nobody_ends_the_node(start)
    finally:
        process.end()
        # Ends the thread that spins, too.
        rclpy.try_shutdown()
    print(f"ROS 2: {time.perf_counter() - began:.1f} s")


if __name__ == "__main__":
    print(f"ROS 2, Python {sys.version.split()[0]}")
    with tempfile.TemporaryDirectory() as temporary:
        main(Path(temporary))
