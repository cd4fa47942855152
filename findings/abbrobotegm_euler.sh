#!/usr/bin/env bash
# abbrobotegm 1.0.7: the Euler angles of every pose that a controller reports are 0, 0, 0.
#
# Guess: `state.cartesian.euler`, by its docstring "the Euler angles representing the orientation",
# in radians, are computed of the quaternion, or are what the controller sent, or are missing.
# Seen: they are three zeros, whatever the quaternion is, and also where the message itself has
# Euler angles (EgmPose has both). The quaternion beside them is right. A tool that points down and
# is turned by 30 degrees about z has `orient` of that turn, and `euler` of no turn at all; the same
# in `cartesian_planned`.
# Why it matters: zeros are valid angles, and nothing says that they were not read. A program that
# makes its first target of them turns the tool over; and ABB's egm.proto has Euler angles go before
# the quaternion where there are both.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    abbrobotegm==1.0.7 protobuf==7.36.2 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" - <<'PYTHON'
import math
import socket

from ABBRobotEGM import EGM
from ABBRobotEGM._egm_protobuf import egm_pb2

# Rz(30 deg) Ry(180 deg): the tool points down.
half = math.radians(15)
DOWN = (0.0, -math.sin(half), math.cos(half), 0.0)
ANGLES = (0.0, 180.0, 30.0)


def message(has_euler):
    robot = egm_pb2.EgmRobot()
    robot.header.seqno, robot.header.tm, robot.header.mtype = 1, 4, 2
    for position in (robot.feedBack, robot.planned):
        position.joints.joints.extend([0, 0, 0, 0, 90, 0])
        pose = position.cartesian
        pose.pos.x, pose.pos.y, pose.pos.z = 900.0, 0.0, 1000.0
        pose.orient.u0, pose.orient.u1, pose.orient.u2, pose.orient.u3 = DOWN
        if has_euler:
            pose.euler.x, pose.euler.y, pose.euler.z = ANGLES
    return robot.SerializeToString()


with EGM(port=0) as client, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as controller:
    address = ("127.0.0.1", client.socket.getsockname()[1])
    for has_euler in (False, True):
        controller.sendto(message(has_euler), address)
        is_there, state = client.receive_from_robot(timeout=2.0)
        assert is_there
        for pose in (state.cartesian, state.cartesian_planned):
            sent = "with" if has_euler else "without"
            print(f"{sent} Euler angles sent: {pose.orient} {pose.euler}")
            assert tuple(pose.orient) == DOWN
            assert tuple(pose.euler) == (0, 0, 0)
PYTHON
