#!/usr/bin/env bash
# python-motion-planning 2.1: a Dubins curve of the shortest length that does not end at its goal.
#
# Guess: the points of `Dubins.generate` begin at the start and end at the goal, with its heading,
# to 1e-9.
# Seen: their length is that of the shortest curve: 300 of 300 agree with OMPL 2.0.1. The points are
# another curve. The last piece of each segment is started with y for the heading, so that the next
# segment leaves in a wrong direction: the ends are up to 10 m from the goal (2 m in the median),
# with headings off by up to a half turn. The Reeds-Shepp curve of the same package ends at its goal
# to 1e-12.
# It shows least where it is tried first: a goal straight ahead on the x axis is met exactly.
# Why it matters: success and length are reported as for the right curve, and these are what
# planners compare. The points are what is driven, and what collisions are checked on.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
pip=("$work/venv/bin/pip" install --quiet --disable-pip-version-check)
"${pip[@]}" numpy==2.4.6 ompl==2.0.1 scipy==1.17.1
"${pip[@]}" --no-deps python-motion-planning==2.1 # without 1 GB of viewers, which stay unused
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PYTHON'
import math
import sys
from unittest.mock import MagicMock

import numpy as np
from ompl import base

for unused in ("faiss", "gymnasium", "osqp", "pyvista", "pyvistaqt", "qtpy", "matplotlib"):
    sys.modules[unused] = MagicMock()
for unused in ("pyplot", "patheffects", "colors"):
    sys.modules["matplotlib." + unused] = MagicMock()
sys.modules["gymnasium"].Env = object
from python_motion_planning.traj_optimizer.curve_generator.pose_based.dubins import Dubins
from python_motion_planning.traj_optimizer.curve_generator.pose_based.reeds_shepp import ReedsShepp

space = base.DubinsStateSpace(1.0)


def wrap(angle):
    return (angle + math.pi) % (2 * math.pi) - math.pi


def state(pose):
    made = space.allocState()
    made.setX(pose[0])
    made.setY(pose[1])
    made.setYaw(wrap(pose[2]))
    return made


def run(generator, start, goal):
    """Length, distance of the last point from the goal, difference of the headings."""
    points, info = generator.generate([start, goal])
    assert info["success"] and math.dist(points[0][:2], start[:2]) < 1e-9
    end = points[-1]
    length = sum(math.dist(a[:2], b[:2]) for a, b in zip(points, points[1:]))
    return length, math.dist(end[:2], goal[:2]), abs(wrap(end[2] - goal[2]))


rng = np.random.default_rng(0)
dubins, reeds_shepp = Dubins(step=0.01, max_curv=1.0), ReedsShepp(step=0.01, max_curv=1.0)
found, control, shortest = [], [], []
for _ in range(300):
    start = tuple(rng.uniform([-2, -2, -3], [2, 2, 3]))
    goal = tuple(rng.uniform([-5, -5, -3], [5, 5, 3]))
    found.append(run(dubins, start, goal))
    control.append(run(reeds_shepp, start, goal))
    shortest.append(space.distance(state(start), state(goal)))
found, control, shortest = map(np.array, (found, control, shortest))

print(f"lengths: up to {np.abs(found[:, 0] - shortest).max():.1e} from the shortest of OMPL")
print(f"Dubins: end {np.median(found[:, 1]):.2f} m from the goal (median), up to", end=" ")
print(f"{found[:, 1].max():.2f} m, heading up to {np.degrees(found[:, 2].max()):.0f} degrees off")
print(f"Reeds-Shepp: {control[:, 1].max():.1e} m, {control[:, 2].max():.1e} rad")
assert np.abs(found[:, 0] - shortest).max() < 1e-3
assert 1.5 < np.median(found[:, 1]) < 2.5 and found[:, 1].max() > 8 and found[:, 2].max() > 3
assert control[:, 1:].max() < 1e-9

for goal in ((4, 0, 0), (4, 0, 0.5), (4, 1, 0), (4, 4, math.pi / 2)):
    _, away, turned = run(dubins, (0, 0, 0), goal)
    print(f"from the origin to {goal}: {away:.3f} m, {np.degrees(turned):.1f} degrees")
    assert (away < 1e-9) == (goal == (4, 0, 0))
PYTHON
