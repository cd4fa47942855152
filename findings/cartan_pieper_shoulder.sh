#!/usr/bin/env bash
# cartan-bindings 0.4.2: one millimeter between axis 1 and axis 2, and every pose is "unreachable".
#
# Guess: `solve_pieper_6r` solves each six-axis arm whose last three axes meet in a point. It finds
# the joints that its own forward kinematics started from, or reports a geometry it does not solve.
# Seen: an arm with axis 2 on axis 1 has all 8 solutions at 200 of 200 poses. With axis 2 beside
# axis 1, by 150 mm as on an IRB 2600 or by 1 mm, it has none at any of them. The status is
# `unreachable`, not `degenerate_geometry`, with 0.3 to 2.8 as distance to the workspace.
# `solve_all` picks this solver for six joints and says the same. Offsets of the elbow (115 mm) or
# along the axes of the shoulder (100 mm) are no trouble; `solve_opw_6r` of the same package
# returns the right joints of the same arm at the same poses.
# Why it matters: nearly every industrial arm has this offset. A program that drops unreachable
# targets drops all of them, and a layout study finds a workspace that is empty.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    cartan-bindings==0.4.2 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" - <<'PYTHON'
from collections import Counter

import cartan
import numpy as np
from cartan import analytical

X, Y, Z = np.eye(3)


def arm(a1, a2, b):
    """An arm with a spherical wrist, upright at zero; a1 lies between axes 1 and 2."""
    elbow, wrist = 1.145, 1.145 + a2
    home = np.eye(4)
    home[:3, :3] = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    home[:3, 3] = a1 + 0.88, b, wrist
    axes = [
        (Z, (0, 0, 0)),
        (Y, (a1, 0, 0.445)),
        (Y, (a1, 0, elbow)),
        (X, (0, b, wrist)),
        (Y, (a1 + 0.795, 0, wrist)),
        (X, (0, b, wrist)),
    ]
    screws = [cartan.ScrewAxis.revolute(axis, np.array(point, float)) for axis, point in axes]
    limits = [cartan.JointLimits(-np.pi, np.pi)] * 6
    return cartan.KinematicChain(cartan.SE3.from_matrix(home), screws, limits)


def found(solutions, q):
    """Whether q is among the solutions, up to whole turns."""
    return any(np.abs((s - q + np.pi) % (2 * np.pi) - np.pi).max() < 1e-5 for s in solutions)


def run(a1, a2, b):
    chain, rng = arm(a1, a2, b), np.random.default_rng(0)
    opw = analytical.OPWParameters(
        a1, -a2, b, 0.445, 0.7, 0.795, 0.085, [0, 0, -np.pi / 2, 0, 0, 0], [1] * 6
    )
    statuses, hits, every, by_opw, distance = Counter(), 0, set(), 0, []
    for _ in range(200):
        q = rng.uniform(-2.5, 2.5, 6)
        pose = cartan.forward_kinematics(chain, q)
        result = analytical.solve_pieper_6r(chain, pose)
        statuses[result.status.name] += 1
        hits += found(result.solutions, q)
        distance.append(result.error_metric)
        every.add(analytical.solve_all(chain, pose).status.name)
        by_opw += found(analytical.solve_opw_6r(chain, opw, pose).solutions, q)
    print(f"a1 {a1:5.3f} m, a2 {a2:5.3f} m, b {b:.1f} m: {dict(statuses)}, joints found {hits},")
    print(
        f"    distance {min(distance):.2f} to {max(distance):.2f}, solve_all {sorted(every)},"
        f" joints found by solve_opw_6r {by_opw}"
    )
    return dict(statuses), hits, every, by_opw, min(distance)


for a2, b in (0, 0), (0.115, 0), (0, 0.1):
    statuses, hits, every, by_opw, _ = run(0, a2, b)
    assert (statuses, hits, every, by_opw) == ({"ok": 200}, 200, {"ok"}, 200)
for a1, a2 in (0.001, 0), (0.15, 0), (0.15, 0.115):
    statuses, hits, every, by_opw, distance = run(a1, a2, 0)
    assert (statuses, hits) == ({"unreachable": 200}, 0)
    assert every == {"unreachable"} and by_opw == 200 and distance > 0.2
PYTHON
