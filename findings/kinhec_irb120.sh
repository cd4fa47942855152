#!/usr/bin/env bash
# kinhec 1.1.0 and robotkinematicscatalogue 1.1.2: an IRB 120 whose axis 3 turns the wrong way.
#
# Guess: two packages with a table of the ABB IRB 120 give one pose for the same joints, or differ
# by a frame at the base or the flange that is the same at all joints.
# Seen: they agree to 1e-15 at zero, the pose that a table is usually checked at, and differ by up
# to 0.8 m elsewhere. The sign of axis 3 is the whole difference: with q3 negated they agree to
# 1e-15 at all joints. kinhec's forearm rises with q3 > 0, and its comment gives that as ABB's
# convention. ABB's forearm goes down: the xacro of ROS-Industrial turns joint 3 about +y, with
# -110 .. +70 degrees. kinhec has this range unmirrored, so that its arm also bends down by 110
# degrees, where the real one has 70, and up by 70, where it has 110.
# The other package has -90 for -110 degrees.
# Why it matters: kinhec makes data sets that hand-eye calibrations are compared on. Each pose in
# them is consistent with the others, so that no calibration of these data shows it. Joints of a
# real controller give another tool, and a path that stays within its limits leaves the arm's.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    kinhec==1.1.0 robotkinematicscatalogue==1.1.2 \
    matplotlib==3.11.2 numpy==2.4.6 pandas==2.3.3 pyarrow==26.0.1 scipy==1.17.1 sympy==1.14.0
cd "$work"
export MPLCONFIGDIR="$work" MPLBACKEND=agg
"$work/venv/bin/python" -W ignore - <<'PYTHON'
import numpy as np
from kinhec.kinematics import forward_kinematics
from kinhec.robots import get_robot
from robotkinematicscatalogue.inversekinematics.industrialRobots import ABB_IRB_120

one, other = get_robot("irb120"), ABB_IRB_120()


def poses(q):
    """The poses of both packages, in meters."""
    second = np.array(other.FK(q), float)
    second[:3, 3] /= 1000
    return forward_kinematics(one, q), second


def apart(a, b):
    return np.linalg.norm(a[:3, 3] - b[:3, 3]), np.abs(a - b).max()


at_zero = apart(*poses(np.zeros(6)))
print(f"at zero: {at_zero[1]:.1e} apart")
assert at_zero[1] < 1e-14

for degrees in (-70, 70):
    q = np.radians([0, 0, degrees, 0, 0, 0])
    a, b = poses(q)
    print(f"q3 = {degrees:+}: flange at z = {a[2, 3]:.4f} m (kinhec), {b[2, 3]:.4f} m (the other)")
    assert (a[2, 3] > b[2, 3]) == (degrees > 0)

rng = np.random.default_rng(0)
lower, upper = np.array(one.q_min), np.array(one.q_max)
worst = mirrored = 0.0
for _ in range(1000):
    q = rng.uniform(lower, upper)
    worst = max(worst, apart(*poses(q))[0])
    turned = q * [1, 1, -1, 1, 1, 1]
    mirrored = max(mirrored, apart(poses(q)[0], poses(turned)[1])[1])
print(f"1000 joints: up to {worst:.3f} m apart, with q3 negated {mirrored:.1e}")
assert 0.6 < worst < 1.0 and mirrored < 1e-14

limits = [round(float(np.degrees(x)), 6) for x in (lower[2], upper[2])]
print("axis 3:", limits, "degrees (kinhec),", [other.jointMin[2], other.jointMax[2]], "(the other)")
assert limits == [-110, 70] and [other.jointMin[2], other.jointMax[2]] == [-90, 70]
PYTHON
