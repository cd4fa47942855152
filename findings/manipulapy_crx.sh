#!/usr/bin/env bash
# ManipulaPy 1.4.2 and crx-kinematics 0.1.2: a CRX-30iA that ends 0.6 m before the real one.
#
# Guess: a package that ships the URDF of five arms of one series, and names Fanuc's own description
# as their source, has their lengths; another package for the series agrees to 1e-9 with each.
# Seen: the CRX-10iA, 10iA/L and 20iA/L do. The CRX-30iA has 560, 540, 120, 160 mm (upper arm,
# forearm, offset of the wrist, flange), where the other package has 950, 750, 185, 180: stretched
# out, it reaches 1.27 m from axis 2 instead of 1.89 m, no farther than a CRX-10iA. The CRX-5iA has
# 420, 420, 84, 80 for 410, 430, 130, 145. Fanuc's public description has the numbers of the other
# package. All inertias of the five files are equal to the digit, while their masses differ.
# Why it matters: the files load, are self-consistent and have names of real products. A reach study
# finds a third of the space of the CRX-30iA; a program that is right there leaves the tool 0.6 m
# from where it goes on the arm.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
pip=("$work/venv/bin/pip" install --quiet --disable-pip-version-check)
"${pip[@]}" crx-kinematics==0.1.2 numpy==2.4.6
"${pip[@]}" --no-deps --target "$work/files" ManipulaPy==1.4.2
cd "$work"
"$work/venv/bin/python" - <<'PYTHON'
import glob
import xml.etree.ElementTree as ET

import crx_kinematics
import numpy as np

ARMS = {
    "crx5ia": "crx5ia",
    "crx10ia": "crx10ia",
    "crx10ia_l": "crx10ial",
    "crx20ia_l": "crx20ial",
    "crx30ia": "crx30ia",
}


def turn(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def numbers(element, name):
    return np.array([float(x) for x in element.get(name).split()])


def chain(root):
    """Joints in order: offset, axis (none for the flange)."""
    parts = []
    for joint in root.findall("joint"):
        origin = joint.find("origin")
        assert not numbers(origin, "rpy").any()
        axis = numbers(joint.find("axis"), "xyz") if joint.get("type") == "revolute" else None
        parts.append((numbers(origin, "xyz"), axis))
    return parts[:7]


def flange(parts, q):
    position, rotation, i = np.zeros(3), np.eye(3), 0
    for offset, axis in parts:
        position = position + rotation @ offset
        if axis is not None:
            rotation = rotation @ turn(axis, q[i])
            i += 1
    return position


rng = np.random.default_rng(0)
lengths, inertias, masses, worst = {}, {}, {}, {}
for name, other in ARMS.items():
    (path,) = glob.glob(f"files/**/{name}.urdf", recursive=True)
    root = ET.parse(path).getroot()
    parts = chain(root)
    o = [1000 * offset for offset, _ in parts]
    arm = getattr(crx_kinematics.Crx, other)()
    ours = [float(x) for x in (o[2][2], o[4][0], -o[5][1], o[6][0])]
    theirs = [arm.z1, arm.x1, arm.y1, arm.x2]
    lengths[name] = [round(x, 6) for x in ours], theirs
    inertias[name] = [sorted(i.attrib.items()) for i in root.iter("inertia")]
    masses[name] = [float(mass.get("value")) for mass in root.iter("mass")]
    # the controller's frame is at axis 2, and its J3 is counted from the horizontal
    apart = 0.0
    for degrees in rng.uniform(-180, 180, (500, 6)):
        joints = np.radians(degrees)
        joints[2] += joints[1]
        a = 1000 * (flange(parts, joints) - parts[0][0])
        apart = max(apart, np.linalg.norm(a - arm.fk(degrees)[:3, 3]))
    worst[name] = apart
    print(f"{name:10}{lengths[name][0]} mm, {theirs} mm: up to {apart:.1f} mm apart")
print("masses:", {name: round(sum(value), 3) for name, value in masses.items()}, "kg")
print("inertias equal:", all(value == inertias["crx5ia"] for value in inertias.values()))
reach = {n: [np.hypot(v[0] + v[1] + v[3], v[2]) for v in both] for n, both in lengths.items()}
print("CRX-30iA, reach from axis 2:", [f"{value:.0f} mm" for value in reach["crx30ia"]])

assert lengths["crx30ia"] == ([560, 540, 120, 160], [950, 750, 185, 180])
assert lengths["crx5ia"] == ([420, 420, 84, 80], [410, 430, 130, 145])
for name in ("crx10ia", "crx10ia_l", "crx20ia_l"):
    assert lengths[name][0] == lengths[name][1] and worst[name] < 1e-6
assert all(value == inertias["crx5ia"] for value in inertias.values())
assert sum(masses["crx30ia"]) > 1.5 * sum(masses["crx5ia"])
assert worst["crx30ia"] > 600 and reach["crx30ia"][0] < reach["crx10ia"][0] + 30
PYTHON
