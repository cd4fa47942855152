"""The ROS 1 node under a real rosmaster: `make test-ros` runs it with Debian's Python."""

import json
import os
import socket
import subprocess
import sys
import tempfile
import time
import xmlrpc.client
from pathlib import Path

import checks
import rospy
import rosservice
from checks import KINDS, Process, wait_for
from geometry_msgs.msg import Pose
from irbkin_interfaces import srv

INSTALLED = Path(__file__).parents[2] / "target/ros1/install_isolated"
NODE = INSTALLED / "lib/irbkin_ros1/kinematics"


class Node:
    """The node as a client sees it."""

    pose = Pose

    def __init__(self, process):
        self.proxies = {}
        assert wait_for(lambda: self.services() >= checks.SERVICES), process.text()

    def services(self):
        return set(rosservice.get_service_list())

    def call(self, name, **fields):
        if name not in self.proxies:
            kind = getattr(srv, KINDS[name.rsplit("/", 1)[-1]])
            self.proxies[name] = rospy.ServiceProxy(name, kind, persistent=True)
        return self.proxies[name](**fields)

    def request(self, kind, **fields):
        return getattr(srv, f"{kind}Request")(**fields)

    def response(self, kind):
        return getattr(srv, f"{kind}Response")()


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def assignments(parameters):
    return [f"_{name}:={json.dumps(value)}" for name, value in parameters.items()]


def shell(command, env):
    """What a command line of ROS prints."""
    done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=30)
    assert done.returncode == 0, done.stdout + done.stderr
    print("  $", " ".join(f'"{part}"' if " " in part else part for part in command))
    for line in done.stdout.splitlines():
        print("   ", line)
    return done.stdout


def main(folder):
    began = time.perf_counter()
    port = free_port()
    os.environ.update(
        ROS_MASTER_URI=f"http://127.0.0.1:{port}",
        ROS_IP="127.0.0.1",
        ROS_LOG_DIR=str(folder),
        ROS_HOME=str(folder),
        ROS_PACKAGE_PATH=str(INSTALLED / "share"),
        CMAKE_PREFIX_PATH=str(INSTALLED),
        PATH="/usr/bin:/bin",
    )
    env = dict(os.environ)
    python = ["/usr/bin/python3"]
    count = 0

    def start(command):
        nonlocal count
        count += 1
        return Process(command, env, folder / f"process_{count}.txt")

    def start_node(parameters):
        return start([*python, str(NODE), *assignments(parameters)])

    def restart_node(parameters):
        forget_parameters()
        return start_node(parameters)

    master = start([*python, "/usr/bin/rosmaster", "--core", "-p", str(port)])
    processes = [master]
    try:
        uri = os.environ["ROS_MASTER_URI"]
        assert wait_for(lambda: answers(uri)), master.text()
        node_process = start_node(checks.PARAMETERS)
        processes.append(node_process)
        rospy.init_node("check", disable_signals=True)
        node = Node(node_process)
        print(f"  master and node are up: {time.perf_counter() - began:.2f} s")
        checks.run(node, checks.CHECKS)
        prefix = checks.PREFIX
        assert prefix in shell(["rosservice", "list"], env)
        fk = shell(["rosservice", "call", f"{prefix}/fk", "[0, 0, 0, 0, 0, 0]"], env)
        assert "success: True" in fk
        assert "x: 0.815" in fk
        pose = "pose: {position: {x: 0.9, y: 0.1, z: 0.8}, orientation: {y: 1.0}}"
        ik = shell(["rosservice", "call", f"{prefix}/ik", pose], env)
        assert "8 solutions" in ik
        pose = "pose: {position: {x: 5.0, z: 0.5}, orientation: {w: 1.0}}"
        assert "beyond reach" in shell(["rosservice", "call", f"{prefix}/check_pose", pose], env)
        assert node_process.end() == 0, node_process.text()
        assert "Traceback" not in node_process.text(), node_process.text()
        checks.refuses_its_parameters(restart_node)
        forget_parameters()
        launched = start(["roslaunch", "irbkin_ros1", "kinematics.launch", "robot:=UR5e"])
        processes.append(launched)
        assert wait_for(lambda: "/ur5e_kinematics/fk" in node.services(), 20), launched.text()
        print("  roslaunch irbkin_ros1 kinematics.launch robot:=UR5e")
        assert launched.end(20) == 0, launched.text()
    finally:
        for process in reversed(processes):
            process.end()
    print(f"ROS 1: {time.perf_counter() - began:.1f} s")


def forget_parameters():
    """Those of a node stay with the master when it has ended."""
    if rospy.has_param("/irbkin"):
        rospy.delete_param("/irbkin")


def answers(uri):
    try:
        return xmlrpc.client.ServerProxy(uri).getPid("/check")[0] == 1
    except OSError:
        return False


if __name__ == "__main__":
    print(f"ROS 1, Python {sys.version.split()[0]}")
    with tempfile.TemporaryDirectory() as temporary:
        main(Path(temporary))
