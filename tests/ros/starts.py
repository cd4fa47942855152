"""Start a node many times and end each with SIGTERM: every one must end by itself.

    make evidence SUITE=ros-starts COUNT=200

The first half is ended shortly after it is ready, the second at any time of its start. `spin` is
the ROS 2 node with rclpy's own `spin`, for comparison: it waits forever now and then.
"""

import os
import random
import socket
import sys
import tempfile
import time
from pathlib import Path

from checks import Process, wait_for

ROOT = Path(__file__).parents[2]
ROS1 = ROOT / "target/ros1/install_isolated/lib/irbkin_ros1/kinematics"
ROS2 = ROOT / ".venv-ros2/ws/install/irbkin_ros2/lib/irbkin_ros2/kinematics"
ROBOT = "IRB 1600-6/1.45"
SPIN = """
import rclpy, irbkin_ros2.node
rclpy.init()
try:
    rclpy.spin(irbkin_ros2.node.KinematicsNode())
except rclpy.executors.ExternalShutdownException:
    pass
"""
AS_ROS2 = ["--ros-args", "-p", f"robot:={ROBOT}"]
COMMANDS = {
    "ros1": [str(ROS1), f"_robot:={ROBOT}"],
    "ros2": [str(ROS2), *AS_ROS2],
    "spin": ["-c", SPIN, *AS_ROS2],
}
# Longest delays from being ready, and from the start, to the signal [s].
AFTER_READY, FROM_START = 0.03, 0.8


def main(kind, count, folder):
    """Print how the processes ended; returns whether all did by themselves."""
    environment = dict(
        os.environ,
        ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
        ROS_DOMAIN_ID=str(random.randint(1, 101)),
        ROS_LOG_DIR=str(folder),
        ROS_HOME=str(folder),
    )
    master = None
    if kind == "ros1":
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        environment.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
        command = [sys.executable, "/usr/bin/rosmaster", "--core", "-p", str(port)]
        master = Process(command, environment, folder / "master.txt")
        assert wait_for(lambda: is_open(port)), master.text()
    try:
        endings = [ended(kind, 2 * i < count, environment, folder) for i in range(count)]
    finally:
        if master is not None:
            master.end()
    hung = sum(seconds is None for seconds, _ in endings)
    failed = [how for _, how in endings if how]
    longest = max((seconds for seconds, _ in endings if seconds is not None), default=0.0)
    print(
        f"{kind}: {count} starts, {hung} hung, {len(failed)} failed, the others ended within "
        f"{longest:.2f} s"
    )
    for how in failed[:3]:
        print(how)
    return not hung and not failed


def ended(kind, is_ready, environment, folder):
    """Seconds from the signal to the end, None for a node that hung; and what is wrong with it."""
    command = [sys.executable, *COMMANDS[kind]]
    process = Process(command, environment, folder / "node.txt")
    if is_ready:
        assert wait_for(lambda: "ready" in process.text(), 30), process.text()
    time.sleep(random.uniform(0.0, AFTER_READY if is_ready else FROM_START))
    start = time.monotonic()
    code = process.end()
    if code is None:
        return None, process.text()
    # Before its middleware is up, the signal ends a process at once.
    is_good = code == 0 or (not is_ready and code == -15)
    wrong = "" if is_good and "Traceback" not in process.text() else f"{code}: {process.text()}"
    return time.monotonic() - start, wrong


def is_open(port):
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        good = main(sys.argv[1], int(sys.argv[2]), Path(temporary))
    sys.exit(not good)
