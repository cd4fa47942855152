"""What motions are asked for, and the check of their answers that comes before the clock."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from .arms import IRB2600, Floats
from .contenders import Contender
from .contenders.contender import Task
from .contenders.motion import ACCELERATION, FEW, MANY, VELOCITY

# Joint angles of the example of docs/guide/motion.md [rad].
START = np.radians([0.0, -90, 0, 0, 90, -180])
END = np.radians([90.0, -100, 40, 10, 60, -120])
# Joint angles of the ends of the line [rad].
LINE = np.array([[-0.4, 0.3, 0.2, 0.4, 0.6, -0.3], [0.5, 0.5, 0.0, 0.1, 0.9, 0.3]])


def case(task: Task) -> tuple[Floats, Floats]:
    """The poses and joint vectors of a motion."""
    ends = IRB2600.fk(LINE)
    if task == "follow":
        return line(ends), LINE
    if task == "retime":
        s = np.linspace(0, 1, MANY)[:, None]
        return ends, START + s * (END - START) + 0.3 * np.sin(2 * np.pi * s * np.arange(1, 7))
    return ends, np.array([START, END])


def line(ends: Floats) -> Floats:
    """The poses of the line, by SciPy."""
    s = np.linspace(0, 1, MANY)
    poses = np.tile(np.eye(4), (MANY, 1, 1))
    poses[:, :3, 3] = ends[0, :3, 3] + s[:, None] * (ends[1, :3, 3] - ends[0, :3, 3])
    poses[:, :3, :3] = Slerp([0, 1], Rotation.from_matrix(ends[:, :3, :3]))(s).as_matrix()
    return poses


def quintic(steps: int) -> Floats:
    """Joint angles, velocities and accelerations from rest to rest in a second."""
    s = np.linspace(0, 1, steps)[:, None]
    way = END - START
    return np.stack(
        [
            START + way * s**3 * (10 - 15 * s + 6 * s**2),
            way * 30 * s**2 * (1 - s) ** 2,
            way * 60 * s * (1 - s) * (1 - 2 * s),
        ]
    )


def check(contender: Contender) -> str:
    """What the answer of a contender is worth, in words.

    Raises:
        ArithmeticError: It is too far off for its time to mean anything.
    """
    task = contender.task
    poses, joints = case(task)
    answer: Any = contender.answer(poses, joints)
    if task in ("retime", "s_curve"):
        duration, velocity, acceleration = answer
        parts = (np.abs(velocity) / VELOCITY).max(), (np.abs(acceleration) / ACCELERATION).max()
        if not max(parts) < 1.5:
            raise ArithmeticError(f"exceeds a limit {max(parts):.1f} times")
        return f"{duration:.4f} s; of the limits at most {max(parts):.6f}"
    if task == "follow":
        q, reached = answer
        error = float(np.abs(reached - poses).max())
        if not np.isfinite(q).all():
            raise ArithmeticError("a pose is not reached")
    else:
        truth = line(poses) if task == "line" else quintic(FEW if task == "quintic" else MANY)
        error = float(np.abs(answer - truth).max())
    if not error <= contender.bound:
        raise ArithmeticError(f"off by {error:.1e}, allowed {contender.bound:.0e}")
    return f"error {error:.0e}"
