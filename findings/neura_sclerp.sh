#!/usr/bin/env bash
# neura-dual-quaternions 0.0.4: `sclerp` is no screw motion; another package's is, up to 0.4 m away.
#
# Guess: the screw interpolation of two poses, "sclerp", is A exp(t log(A^-1 B)) in each package
# that has a function of this name: one path, whichever frame of the tool the poses are given for.
# Seen: dual-quaternions 0.4.0 agrees with that to 1e-14. neura-dual-quaternions interpolates the
# rotation, and the position on a straight line beside it: between two poses of a cube of 2 m that
# are up to 69 degrees apart, it is up to 0.4 m off the screw. Start, goal and rotations agree. Its
# own `power(t)` of the relative pose is the screw, to 1e-14. Given for another point of the tool,
# 0.2 m away, its path is another one, by up to 35 mm.
# At 25 % of pairs of random rotations it also turns the long way around, by up to 360 degrees:
# where `fromTransformation` gives the two quaternions on opposite sides.
# Why it matters: a motion that was checked for collisions as a screw is not the one that is
# executed. Which way a part turns around its own point depends on the frame that it was given by.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    neura-dual-quaternions==0.0.4 dual-quaternions==0.4.0 numpy==2.4.6 pyquaternion==0.9.9
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PYTHON'
import numpy as np
from dual_quaternions import DualQuaternion as Other
from neura_dual_quaternions import DualQuaternion as Neura


def cross(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def screw(w, v):
    """The motion of a twist with rotation w (below a half turn) and translation v."""
    angle, wx = np.linalg.norm(w), cross(w)
    a = np.sin(angle) / angle
    b = (1 - np.cos(angle)) / angle**2
    c = (1 - a) / angle**2
    pose = np.eye(4)
    pose[:3, :3] = np.eye(3) + a * wx + b * wx @ wx
    pose[:3, 3] = (np.eye(3) + b * wx + c * wx @ wx) @ v
    return pose


def neura(a, b, t):
    return np.array(
        Neura.sclerp(Neura.fromTransformation(a), Neura.fromTransformation(b), t).asTransformation()
    )


def power(a, b, t):
    relative = Neura.fromTransformation(np.linalg.inv(a) @ b)
    return a @ np.array(relative.power(t).asTransformation())


def other(a, b, t):
    ends = [Other.from_homogeneous_matrix(x) for x in (a, b)]
    return np.array(Other.sclerp(*ends, t).homogeneous_matrix())


rng = np.random.default_rng(0)
tool = np.eye(4)
tool[:3, 3] = 0, 0, 0.2
names = ("rotation", "ends", "power", "other", "line", "other, moved", "position", "tool moved")
off = dict.fromkeys(names, 0.0)


def note(name, difference):
    off[name] = max(off[name], np.linalg.norm(difference))


def pair(first, second):
    """Two poses in a cube of 2 m, turned by up to `first`, and by `second` more."""
    turns = [axis / np.linalg.norm(axis) for axis in rng.normal(size=(2, 3))]
    w = turns[1] * rng.uniform(0.1, second)
    a = screw(turns[0] * rng.uniform(0.1, first), np.zeros(3))
    b = a @ screw(w, np.zeros(3))
    a[:3, 3], b[:3, 3] = rng.uniform(-1, 1, (2, 3))
    columns = np.array([screw(w, e)[:3, 3] for e in np.eye(3)]).T
    return a, b, w, np.linalg.solve(columns, (np.linalg.inv(a) @ b)[:3, 3])


for _ in range(300):
    a, b, w, v = pair(0.4, 1.2)
    for t in (0.25, 0.5, 0.75):
        right, found = a @ screw(t * w, t * v), neura(a, b, t)
        note("rotation", found[:3, :3] - right[:3, :3])
        note("power", power(a, b, t) - right)
        note("other", other(a, b, t) - right)
        note("line", found[:3, 3] - (1 - t) * a[:3, 3] - t * b[:3, 3])
        note("position", found[:3, 3] - right[:3, 3])
        again = neura(a @ tool, b @ tool, t) @ np.linalg.inv(tool)
        note("tool moved", again[:3, 3] - found[:3, 3])
        again = other(a @ tool, b @ tool, t) @ np.linalg.inv(tool)
        note("other, moved", again[:3, 3] - right[:3, 3])
    note("ends", neura(a, b, 0.0) - a)
    note("ends", neura(a, b, 1.0) - b)
for name, value in off.items():
    print(f"{name:13}{value:.2e}")
assert max(off[name] for name in names[:6]) < 1e-12
assert 0.3 < off["position"] < 0.8 and 0.03 < off["tool moved"] < 0.1

long = 0
for _ in range(400):
    a, b, w, _ = pair(3.0, 3.0)
    sides = [np.array(Neura.fromTransformation(x).real.asVector()).ravel() for x in (a, b)]
    turned = np.abs(neura(a, b, 0.5)[:3, :3] - (a @ screw(w / 2, np.zeros(3)))[:3, :3]).max()
    assert (turned > 1e-9) == (sides[0] @ sides[1] < 0)
    long += turned > 1e-9
print(f"random rotations: {long} of 400 turn the long way")
assert 60 < long < 140
PYTHON
