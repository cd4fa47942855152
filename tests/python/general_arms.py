"""Arms without a closed form, and other solvers' answers for them."""

import numpy as np
from reference import link

QUARTER, DEGREE = np.pi / 2, np.pi / 180

# ABB's CRB 15000-5/0.95 (GoFa 5) and FANUC's CRX-10iA/L by their makers' dimensions; Manseur and
# Doty, A Robot Manipulator with 16 Real Inverse Kinematic Solution Sets, 1989, its standard table
# one row down, without the last twist, which is a tool's. Rows of modified tables [rad, m].
TABLES = {
    "GoFa 5": [
        (0, 0, 0.265, 0), (-QUARTER, 0, 0, -QUARTER), (0, 0.444, 0, 0), (-QUARTER, 0.11, 0.47, 0),
        (QUARTER, 0, 0, 0), (-QUARTER, 0.08, 0.101, np.pi),
    ],
    "CRX-10iA/L": [
        (0, 0, 0.245, 0), (-QUARTER, 0, 0, -QUARTER), (0, 0.71, 0, 0), (-QUARTER, 0, 0.54, 0),
        (QUARTER, 0, 0.15, 0), (-QUARTER, 0, 0.16, np.pi),
    ],
    "Manseur-Doty": [
        (0, 0, 0, 0), (QUARTER, 0.3, 0, 0), (DEGREE, 1, 0.2, 0), (QUARTER, 0, 0, 0),
        (DEGREE, 1.5, 0, 0), (QUARTER, 0, 0, 0),
    ],
}  # fmt: skip
for _seed in range(2):
    _drawn = np.random.default_rng(_seed).uniform(-1, 1, (6, 4))
    TABLES[f"random {_seed}"] = _drawn * [np.pi, 0.5, 0.5, np.pi]
TABLES = {name: np.array(rows, dtype=float) for name, rows in TABLES.items()}


def frames(rows, q):
    """Every frame of a modified table for joints (..., n), shape (n, ..., 4, 4)."""
    pose, found = np.broadcast_to(np.eye(4), (*q.shape[:-1], 4, 4)), []
    for i, (alpha, a, d, theta) in enumerate(rows):
        turn = np.zeros((*q.shape[:-1], 4, 4))
        angle = q[..., i] + theta
        turn[..., 0, 0] = turn[..., 1, 1] = np.cos(angle)
        turn[..., 1, 0] = np.sin(angle)
        turn[..., 0, 1] = -np.sin(angle)
        turn[..., 2, 2] = turn[..., 3, 3] = 1.0
        pose = pose @ link(alpha, a, 0.0, 0.0) @ turn @ link(0.0, 0.0, d, 0.0)
        found.append(pose)
    return np.array(found)


def fk(rows, q):
    """The last frame, (..., n) to (..., 4, 4)."""
    return frames(rows, q)[-1]


def missing(rows, q, pose):
    """The way to a pose [m, rad], shape (..., 6), and the Jacobian (..., 6, n), in the base frame.

    The rotation is half the sum of the cross products of the axes: the sine of the angle.
    """
    found = frames(rows, q)
    axes, points, tool = found[..., :3, 2], found[..., :3, 3], found[-1]
    linear = np.cross(axes, tool[..., :3, 3] - points)
    jacobian = np.moveaxis(np.concatenate([linear, axes], axis=-1), 0, -1)
    turn = np.cross(tool[..., :3, :3], pose[..., :3, :3], axis=-2).sum(axis=-1) / 2
    return np.concatenate([pose[..., :3, 3] - tool[..., :3, 3], turn], axis=-1), jacobian


def residual(rows, q, pose):
    """Largest difference of an element of the pose [m, 1]."""
    return np.abs(fk(rows, q) - pose).max(axis=(-2, -1))


def least_singular_value(rows, q):
    """Of the Jacobian, its rows in m and rad as they are."""
    return np.linalg.svd(missing(rows, q, np.eye(4))[1], compute_uv=False)[..., -1]


def multi_start_newton(rows, pose, seeds=200, steps=60, rng=None):
    """Solutions of a pose that damped Newton steps find from random joint vectors, shape (k, n),
    each once: what no elimination can have forgotten.
    """
    rng = np.random.default_rng(0) if rng is None else rng
    q = rng.uniform(-np.pi, np.pi, (seeds, len(rows)))
    for _ in range(steps):
        way, jacobian = missing(rows, q, pose)
        damping = 1e-3 * np.minimum(np.sum(way**2, axis=-1), 1.0)[:, None, None] * np.eye(6)
        normal = jacobian @ np.swapaxes(jacobian, -1, -2) + damping + 1e-15 * np.eye(6)
        step = np.swapaxes(jacobian, -1, -2) @ np.linalg.solve(normal, way[..., None])
        longest = np.abs(step).max(axis=(-2, -1), keepdims=True)
        q = q + (step * np.minimum(1.0, 0.5 / np.maximum(longest, 1e-300)))[..., 0]
    return distinct(q[residual(rows, q, pose) <= 1e-11])


def distinct(q, bound=1e-6):
    """Joint vectors without those that repeat an earlier one, turns not counted."""
    kept = np.zeros((0, q.shape[-1]))
    for each in q:
        if not len(kept) or apart(kept, each).min() > bound:
            kept = np.vstack([kept, each])
    return kept


def apart(a, b):
    """Largest difference of joints, full turns not counted [rad]."""
    return np.abs((a - b + np.pi) % (2 * np.pi) - np.pi).max(axis=-1)
