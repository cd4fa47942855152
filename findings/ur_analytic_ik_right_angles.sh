#!/usr/bin/env bash
# ur-analytic-ik 0.1.0.post3: regular postures at multiples of 45 degrees are not among the answers.
#
# Guess: `inverse_kinematics` of `forward_kinematics(q)` has q among its solutions (a turn apart),
# wherever q is not singular.
# Seen: of random joint vectors none is lost. Of regular ones at multiples of 45 degrees one in ten
# is, as (0, 45, -90, 45, 90, 0): six solutions come back, the nearest of them 172 degrees off in a
# joint, and two lines on stdout say "Detected and filtered incorrect IK solution". What is filtered
# are the two elbows of its branch, with wrong angles of joints 2 to 4.
# Why it matters: poses that people program by hand, tool straight down, are such postures. The
# posture at which a robot stands is reported as not reachable there, or a planner turns the arm over.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    ur-analytic-ik==0.1.0.post3 numpy==2.4.6
cd "$work"
cat >postures.py <<'PYTHON'
import sys

import numpy as np
from ur_analytic_ik import ur3


def off(q):
    """The number of solutions, and how far the nearest one is from q in a joint [deg]."""
    solutions = np.reshape(ur3.inverse_kinematics(ur3.forward_kinematics(*q)), (-1, 6))
    apart = np.abs((solutions - q + np.pi) % (2 * np.pi) - np.pi).max(axis=1)
    return len(solutions), np.degrees(apart.min(initial=np.pi))


def is_regular(q):
    """Whether the hand can move in all six ways, by differences of its pose."""
    columns, step = [], 1e-6
    for joint in range(6):
        a, b = (
            ur3.forward_kinematics(*(q + side * step * np.eye(6)[joint])) for side in (-1, 1)
        )
        turned = b[:3, :3] @ a[:3, :3].T
        axis = [turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]
        columns.append([*(b[:3, 3] - a[:3, 3]), *np.multiply(axis, 0.5)])
    columns = np.array(columns) / (2 * step)
    return np.linalg.svd(columns, compute_uv=False)[-1] > 0.02


def lost(draw, count):
    """How many of regular postures are more than half a degree from every solution."""
    postures = [q for q in (np.radians(draw()) for _ in range(count)) if is_regular(q)]
    return sum(off(q)[1] > 0.5 for q in postures), len(postures)


rng = np.random.default_rng(0)
print("one", *off(np.radians([0.0, 45, -90, 45, 90, 0])), file=sys.stderr)
print("random", *lost(lambda: rng.uniform(-180, 180, 6), 2000), file=sys.stderr)
print("45", *lost(lambda: 45.0 * rng.integers(-4, 5, 6), 4000), file=sys.stderr)
PYTHON
"$work/venv/bin/python" postures.py >said 2>counted
cat counted
grep -q "Detected and filtered incorrect IK solution" said
"$work/venv/bin/python" - <<'PYTHON'
rows = {name: list(map(float, rest)) for name, *rest in map(str.split, open("counted"))}
count, nearest = rows["one"]
assert count == 6 and nearest > 170, rows
assert rows["random"][0] == 0 and rows["random"][1] > 1000, rows
assert rows["45"][0] > 0.05 * rows["45"][1] > 10, rows
PYTHON
echo "As seen: postures at multiples of 45 degrees are lost, random ones are not."
