#!/usr/bin/env bash
# hecalib 1.3.0: on exact data, one calibration in five has minus the identity for its rotation.
#
# Guess: each of the six methods solves A X = X B to 1e-8 where the poses are exact and their axes
# differ; a method may need a few more of them, and gets better with more.
# Seen: Tsai, Chou, Li and Daniilidis are exact at 100 of 100 cameras, Park at 97 with four poses
# and at 100 with twelve. `Cal_Lu` is at 73 to 79. At the others the rotation that it returns is
# minus the identity to 1e-9, a reflection, and the camera is 0.1 to 88 m from where it is. There
# is no noise, and 4, 12 and 40 poses have the same share. Half of the cameras are right with each
# set of poses; for the other half a new set of poses is a toss of a coin.
# Why it matters: nothing is raised. The relative error that is returned, about 1 rad, shows it to
# those who look. Code that takes the rotation gets a reflection, which turns a part into its mirror
# image; a comparison of methods by the median error calls the method exact.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    hecalib==1.3.0 numpy==2.4.6 scipy==1.17.1
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PYTHON'
import hecalib
import numpy as np

METHODS = [name for name in dir(hecalib) if name.startswith("Cal_")]


def pose(rng, angle, size):
    axis = rng.normal(size=3)
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    made = np.eye(4)
    made[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    made[:3, 3] = rng.uniform(-size, size, 3)
    return made


def poses(rng, camera, count):
    """Exact poses of the hand, and of the camera in a frame of the target."""
    target = pose(rng, rng.uniform(0, 3), 1.0)
    hand = np.array([pose(rng, rng.uniform(0.2, 1.2), 0.5) for _ in range(count)])
    return hand, np.array([np.linalg.inv(target) @ a @ camera for a in hand])


def solve(name, camera, hand, seen):
    rotation, position, error = getattr(hecalib, name)().calibrate(hand, seen)
    rotation, position = np.array(rotation), np.ravel(position)
    right = np.abs(rotation - camera[:3, :3]).max() < 1e-6
    return right, rotation, np.linalg.norm(position - camera[:3, 3]), error


cameras = [pose(np.random.default_rng(k), 3.0 * (k + 1) / 100, 0.3) for k in range(100)]
for count in (4, 12):
    rng = np.random.default_rng(count)
    data = [(camera, *poses(rng, camera, count)) for camera in cameras]
    right = {}
    for name in METHODS:
        answers = [solve(name, *one) for one in data]
        right[name] = int(sum(answer[0] for answer in answers))
        if name == "Cal_Lu":
            wrong = [answer[1:] for answer in answers if not answer[0]]
    print(f"{count} poses:", right)
    away = [distance for _, distance, _ in wrong]
    stated = [error[0] for *_, error in wrong]
    minus = max(np.abs(rotation + np.eye(3)).max() for rotation, *_ in wrong)
    print(f"    Cal_Lu, the others: {minus:.0e} from minus the identity, camera off by", end=" ")
    print(f"{min(away):.2f} to {max(away):.1f} m, stated {np.median(stated):.2f} rad (median)")
    assert 60 < right.pop("Cal_Lu") < 95 and min(right.values()) >= 95
    assert count == 4 or right["Cal_Park"] == right["Cal_Chou"] == right["Cal_Tsai"] == 100
    assert minus < 1e-6 and min(away) > 0.01 and np.median(stated) > 0.5

rng = np.random.default_rng(0)
data = [(camera, *poses(rng, camera, 40)) for camera in cameras]
right = int(sum(solve("Cal_Lu", *one)[0] for one in data))
print("40 poses: Cal_Lu", right)
assert 60 < right < 95

hits = []
for camera in cameras[::5]:
    hits.append(int(sum(solve("Cal_Lu", camera, *poses(rng, camera, 6))[0] for _ in range(20))))
print("of 20 sets of poses, for 20 cameras:", hits)
assert 6 <= hits.count(20) <= 14 and sum(5 <= count <= 16 for count in hits) >= 6
PYTHON
