#!/usr/bin/env bash
# pathplanning 0.2.0: the optimal Reeds-Shepp path is dropped as a duplicate of a longer one.
#
# Guess: `calc_optimal_path` returns a shortest path, as OMPL 2.0.1 does, to 1e-6.
# Seen: at 85 of 1000 pairs of poses it is longer, by up to 1.3 turning radii or a factor of 1.6.
# The others agree. Each path that it returns does end at its goal. A candidate is taken for a
# duplicate of an earlier one of the same kind where the differences of their lengths add up to less
# than 0.01, with their signs: many a different path is a "duplicate" that way, at times the best.
# With the magnitudes of the differences added up, all 1000 agree with OMPL.
# Why it matters: such lengths are heuristic and last leg of planners for mobile bases. A heuristic
# that is too long makes an optimal search return what is not optimal, and nothing else shows it:
# the path is valid.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    pathplanning==0.2.0 ompl==2.0.1 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PYTHON'
import math

import numpy as np
from ompl import base
from pathplanning.geometry import reeds_shepp

space = base.ReedsSheppStateSpace(1.0)


def state(pose):
    made = space.allocState()
    made.setX(pose[0])
    made.setY(pose[1])
    made.setYaw(pose[2])
    return made


def replay(start, path):
    """The pose at the end of the path, from its kinds and lengths (turning radius 1)."""
    x, y, yaw = start
    for kind, length in zip(path.ctypes, path.lengths):
        if kind == "S":
            x, y = x + length * math.cos(yaw), y + length * math.sin(yaw)
            continue
        side = 1 if kind == "L" else -1
        turned = yaw + side * length
        x += side * (math.sin(turned) - math.sin(yaw))
        y -= side * (math.cos(turned) - math.cos(yaw))
        yaw = turned
    return x, y, yaw


def run(name, pairs):
    longer, missed = [], 0.0
    for start, goal in pairs:
        path = reeds_shepp.calc_optimal_path(*start, *goal, 1.0, step_size=0.5)
        x, y, yaw = replay(start, path)
        turn = abs(math.remainder(yaw - goal[2], 2 * math.pi))
        missed = max(missed, math.dist((x, y), goal[:2]), turn)
        assert abs(path.L - sum(map(abs, path.lengths))) < 1e-9
        shortest = space.distance(state(start), state(goal))
        longer.append((path.L - shortest, path.L / shortest, shortest, path))
    longer.sort(key=lambda item: -item[0])
    count = sum(extra > 1e-6 for extra, *_ in longer)
    print(f"{name}: {count} of {len(pairs)} longer than the shortest, by up to {longer[0][0]:.3f}")
    print(f"    or a factor of {max(item[1] for item in longer):.3f}; goals missed by {missed:.1e}")
    assert missed < 1e-9 and longer[-1][0] > -1e-6
    return count, longer[0]


ends = np.random.default_rng(0).uniform(-1, 1, (1000, 2, 3)) * [[2, 2, 3], [4, 4, 3]]
pairs = [tuple(tuple(map(float, pose)) for pose in both) for both in ends]
count, (extra, _, shortest, path) = run("as it is", pairs)
print(f"    worst: {path.L:.3f} for {shortest:.3f}, {path.ctypes}")
assert 40 < count < 110 and extra > 1


def set_path(paths, lengths, kinds):
    """As the package's, with the magnitudes of the differences."""
    for path in paths:
        differences = (abs(a - b) for a, b in zip(path.lengths, lengths))
        if path.ctypes == kinds and sum(differences) <= 0.01:
            return paths
    paths.append(reeds_shepp.PATH(lengths, kinds, sum(map(abs, lengths)), [], [], [], []))
    return paths


reeds_shepp.set_path = set_path
count, _ = run("with magnitudes", pairs)
assert count == 0
PYTHON
