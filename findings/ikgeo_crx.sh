#!/usr/bin/env bash
# py-ikgeo-kinematics 0.0.2: no solution at any pose of a Fanuc CRX, all of them once it is bent.
#
# Guess: the package is for arms whose wrist is not spherical, and its docstring names the CRX. So
# `inverse` finds the joints that `forward` started from at all, or nearly all, poses of that arm.
# Seen: it finds no solution at any of 100 poses of the CRX-10iA (540, 540, 150, 160 mm), in meters
# or in millimeters. On the CRX the axes 1 and 2 meet, 4 and 5 meet, 5 and 6 meet, and 2 and 3 are
# parallel. The package takes it for `two_intersecting_two_intersecting`: the parallel pair, which
# makes it an easy one, is not used. Move axis 2 away from axis 1 by 50 mm, and the family is
# `two_intersecting_two_parallel`: all joints are found, with six to eight solutions a pose.
# `batch_inverse` hides this: it continues from a seed by Newton's method, so that it follows the
# path where the seed is right, and gives NaN from the zero pose.
# Why it matters: an arm with *more* structure is solved worse than its neighbor without it. A
# search that may miss roots and one that never finds any look alike; the README warns of the first.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    py-ikgeo-kinematics==0.0.2 numpy==2.4.6 scipy==1.17.1
cd "$work"
"$work/venv/bin/python" - <<'PYTHON'
import numpy as np
from py_ikgeo_kinematics import KinematicModel, Robot

X, Y, Z = np.eye(3)


def crx(a1=0.0, unit=1.0):
    """CRX-10iA, upright at zero; a1 = 0 is the real arm. Lengths in meters times `unit`."""
    axes = np.array([Z, Y, Y, X, Y, X]).T
    upper, wrist, offset, flange = 0.54, 0.54, 0.15, 0.16
    points = [
        (0, 0, 0),
        (0, 0, 0.245),
        (a1, 0, 0.245),
        (a1, 0, 0.245 + upper),
        (a1, 0, 0.245 + upper),
        (a1 + wrist, 0, 0.245 + upper),
        (a1 + wrist, -offset, 0.245 + upper),
        (a1 + wrist + flange, -offset, 0.245 + upper),
    ]
    return Robot(KinematicModel(axes, unit * np.diff(points, axis=0).T), degrees=False)


def run(name, robot):
    rng = np.random.default_rng(0)
    hits = solutions = empty = from_far = 0
    for _ in range(100):
        q = rng.uniform(-2.5, 2.5, 6)
        pose = robot.forward(tuple(q))
        every = robot.inverse(pose)
        away = [np.abs((np.array(s) - q + np.pi) % (2 * np.pi) - np.pi).max() for s in every]
        hits += any(angle < 1e-5 for angle in away)
        solutions += len(every)
        empty += not every
        two = robot.batch_forward(np.array([q, q]))
        assert np.abs(robot.batch_inverse(two, current_joints=tuple(q)) - q).max() < 1e-9
        far = robot.batch_inverse(two, current_joints=(0.0,) * 6)
        from_far += not np.isnan(far).any()
    print(f"{name}: {robot.family}, joints found {hits} of 100, solutions {solutions},")
    print(f"    poses without a solution {empty}, solved by batch_inverse from zero {from_far}")
    return robot.family, hits, empty, solutions, from_far


for name, robot in ("CRX-10iA, m", crx()), ("CRX-10iA, mm", crx(unit=1000)):
    found = run(name, robot)
    assert found[:4] == ("two_intersecting_two_intersecting", 0, 100, 0)
    assert found[4] < 5
    pairs = {pair.pair: (pair.parallel, pair.intersecting) for pair in robot.axis_report()}
    assert pairs["1-2"][1] and pairs["2-3"][0] and pairs["4-5"][1] and pairs["5-6"][1]
family, hits, empty, solutions, _ = run("with a1 = 50 mm", crx(0.05))
assert (family, hits, empty) == ("two_intersecting_two_parallel", 100, 0)
assert 600 <= solutions <= 800
PYTHON
