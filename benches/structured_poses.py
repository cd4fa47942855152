"""The time of one pose of arms without a closed form, by how near it is to singularities.

Each pose is solved several times from Python, on one thread, and the least time counts, as a ratio
to that of a product of two 4x4 arrays in the same run. The goal is 20 us for structured poses of
the general method. QUICK=1 takes fewer poses.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable

import irbkin
import numpy as np
from numpy.typing import NDArray
from peers.machine import cpu

Floats = NDArray[np.float64]

POSES, ROUNDS = (20, 1) if os.environ.get("QUICK") else (500, 5)


def with_zero(joint: int) -> Callable[[Floats], Floats]:
    """Joint vectors with one joint, from 1, at zero."""
    return lambda q: np.where(np.arange(6) == joint - 1, 0.0, q)


def multiples(angle: float) -> Callable[[Floats], Floats]:
    """Joint vectors at multiples of an angle [rad]."""
    return lambda q: angle * np.round(q / angle)


SETS: dict[str, Callable[[Floats], Floats]] = {
    "random": lambda q: q,
    "q4 = 0": with_zero(4),
    "q5 = 0": with_zero(5),
    "multiples of 45 deg": multiples(np.pi / 4),
    "multiples of 90 deg": multiples(np.pi / 2),
}


def manseur_doty() -> irbkin.Robot:
    """The arm with sixteen solutions."""
    right, skew = np.pi / 2, np.radians(1)
    alpha, a = [0, right, skew, right, skew, right], [0, 0.3, 1.0, 0, 1.5, 0]
    rows = np.column_stack([alpha, a, [0, 0, 0.2, 0, 0, 0], np.zeros(6)])
    return irbkin.Robot.from_mdh(rows, name="Manseur and Doty")


def least(call: Callable[[Floats], object], argument: Floats) -> float:
    """The least time of a call [s]."""
    times = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        call(argument)
        times.append(time.perf_counter() - begin)
    return min(times)


def row(robot: irbkin.Robot, T: Floats) -> str:
    """Times of poses [us], that of the median in products too, each measured in turn with a pose;
    which answers are certified, and which have a self-motion.
    """
    A = np.eye(4)
    pairs = [(least(robot.ik, pose), least(A.__matmul__, A)) for pose in T]
    times, products = 1e6 * np.array(pairs).T
    answers = [robot.ik(pose) for pose in T]
    certified = np.mean([answer.certified for answer in answers])
    moving = np.mean([any(one.free_joint for one in answer) for answer in answers])
    median = float(np.median(times))
    figures = [median, median / float(np.median(products)), float(times.mean())]
    figures += [float(np.quantile(times, 0.9)), float(times.max())]
    shares = "".join(f"{100 * share:11.0f}%" for share in (certified, moving))
    return "".join(f"{figure:12.1f}" for figure in figures) + shares


def main() -> None:
    """Print the table."""
    print(f"{', '.join(cpu())}: one pose in us and, for the median, in products A @ B")
    columns = ("median", "A @ B", "mean", "p90", "most", "certified", "self-motion")
    print(f"{'':36}" + "".join(f"{column:>12}" for column in columns))
    named = [irbkin.Robot(name) for name in ("GoFa 5", "CRX-10iA/L", "CRX-10iA")]
    for robot in (*named, manseur_doty()):
        rng = np.random.default_rng(1)
        for title, change in SETS.items():
            T = robot.fk(change(rng.uniform(-np.pi, np.pi, (POSES, 6))))
            print(f"{robot.name + ', ' + title:36}{row(robot, T)}")


if __name__ == "__main__":
    main()
