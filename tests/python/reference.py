"""Kinematics written once more, in NumPy and without irbkin: what the tests hold it against."""

import numpy as np

UNIT = 2.0**-53  # unit roundoff of float64


def link(alpha, a, d, theta):
    """Rx(alpha) Tx(a) Rz(theta) Tz(d): one row of a modified Denavit-Hartenberg table."""
    sa, ca, st, ct = np.sin(alpha), np.cos(alpha), np.sin(theta), np.cos(theta)
    return np.array([
        [ct, -st, 0.0, a],
        [st * ca, ct * ca, -sa, -d * sa],
        [st * sa, ct * sa, ca, d * ca],
        [0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip


def frames(rows, q):
    """Every frame of a modified table, the last one the flange, shape (n, 4, 4)."""
    pose, found = np.eye(4), []
    for (alpha, a, d, theta), angle in zip(rows, q, strict=True):
        pose = pose @ link(alpha, a, d, theta + angle)
        found.append(pose)
    return np.array(found)


def fk(rows, q):
    """The flange of a modified table."""
    return frames(rows, q)[-1]


def fk_sdh(rows, q):
    """The flange of a standard table: Rz Tz Tx Rx of each row."""
    pose = np.eye(4)
    for (alpha, a, d, theta), angle in zip(rows, q, strict=True):
        pose = pose @ link(0.0, 0.0, d, theta + angle) @ link(alpha, a, 0.0, 0.0)
    return pose


def fk_opw(opw, q):
    """The flange of an arm by Brandstoetter's parameters: straight up at zero theta."""
    t1, t2, t3, t4, t5, t6 = np.array(opw["signs"]) * q - np.array(opw["offsets"])
    shoulder = turn("z", t1) @ move(opw["a1"], opw["b"], opw["c1"])
    wrist = turn("y", t2) @ move(0, 0, opw["c2"]) @ turn("y", t3) @ move(opw["a2"], 0, opw["c3"])
    return shoulder @ wrist @ turn("z", t4) @ turn("y", t5) @ turn("z", t6) @ move(0, 0, opw["c4"])


def reach_opw(opw):
    """No point of the arm is further from its base than this [m]."""
    return sum(abs(opw[length]) for length in ("a1", "a2", "b", "c1", "c2", "c3", "c4"))


def jacobian(fk, q, step=np.pi / 4):
    """Geometric Jacobian by central differences of `fk`: three linear rows, three angular.

    A point that turns about an axis has p(q + h) - p(q - h) = 2 sin h dp/dq for any h, and the
    rotation between the two ends is one by 2 h about the axis: the differences are exact, and a
    wide step keeps their rounding that of `fk`.
    """
    columns = []
    for h in np.eye(len(q)) * step:
        ahead, behind = fk(q + h), fk(q - h)
        turn = ahead[:3, :3] @ behind[:3, :3].T
        linear = (ahead[:3, 3] - behind[:3, 3]) / np.sin(step)
        angular = np.array(
            [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
        ) / np.sin(2 * step)
        columns.append(np.concatenate([linear, angular]) / 2)
    return np.array(columns).T


def reach(rows):
    """No point of the arm is further from its base than this [m]."""
    return float(np.abs(np.asarray(rows)[:, 1:3]).sum())


def rounding(reach):
    """What rounding may do to a pose that two programs compute [m, 1].

    Eight transforms (seven joints and a tool) are multiplied twice; an element is a sum of four
    terms whose magnitudes add up to at most sqrt(3) (1 + reach). An angle of up to 8 rad is rounded
    once for each of seven joints.
    """
    return (2 * 8 * 4 * np.sqrt(3) + 7 * 8) * UNIT * (1 + reach)


def turn(axis, angle):
    """Homogeneous rotation by `angle` about the axis "x", "y" or "z"."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    pose = np.eye(4)
    pose[i, i] = pose[j, j] = np.cos(angle)
    pose[i, j], pose[j, i] = -np.sin(angle), np.sin(angle)
    return pose


def move(x, y, z):
    """Homogeneous translation."""
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def pose_of(xyz, wxyz):
    """Homogeneous matrix of a translation and a quaternion of any length but zero."""
    w, x, y, z = np.asarray(wxyz, dtype=float) / np.linalg.norm(wxyz)
    pose = move(*xyz)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return pose


def random_pose(rng, size=1.0):
    """A pose with any orientation, its origin in a cube of half width `size` [m]."""
    return pose_of(rng.uniform(-size, size, 3), rng.normal(size=4))


def apart(a, b):
    """Largest difference of joint vectors, full turns not counted [rad]."""
    difference = np.asarray(a) - np.asarray(b)
    return np.abs(difference - 2 * np.pi * np.round(difference / (2 * np.pi))).max(axis=-1)


def rotation_apart(a, b):
    """Angle between the orientations of two poses [rad], exact for small angles too."""
    chord = np.linalg.norm(np.asarray(a)[:3, :3] - np.asarray(b)[:3, :3]) / np.sqrt(8)
    return 2 * np.arcsin(min(1.0, chord))
