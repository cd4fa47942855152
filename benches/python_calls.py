"""Python calls on one pose and on a batch, as ratios to a yardstick that is measured in turn in the
same run.
"""

from __future__ import annotations

import itertools
import os
import statistics
import subprocess
import sys
import timeit
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import irbkin
import numpy as np
from peers.machine import cpu

QUICK = bool(os.environ.get("QUICK"))
ROUNDS = 1 if QUICK else 15
CALLS = 20 if QUICK else 2000
POSES = 5_000 if QUICK else 100_000


class Row(NamedTuple):
    """A call, and what the project wants of it: a ratio to the yardstick, or a time of one pose in
    a batch.
    """

    name: str
    call: Callable[[], object]
    yardstick: str
    goal: str = ""


def single_calls(robot: irbkin.Robot) -> list[Row]:
    """One pose of eight solutions, against a product of two 4x4 arrays."""
    q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
    T = robot.fk(q)
    xyz, quaternion = irbkin.to_xyz_wxyz(T)
    pose_out, jacobian_out = np.empty((4, 4)), np.empty((6, 6))
    product = "A @ B"
    # The goals of fk, jacobian and ik_nearest are fractions of other packages' times, in the same
    # unit.
    return [
        Row("A @ B", lambda: T @ T, product),
        Row("fk(q)", lambda: robot.fk(q), product, "0.58 x"),
        Row("fk(q, out=)", lambda: robot.fk(q, out=pose_out), product),
        Row("jacobian(q)", lambda: robot.jacobian(q), product, "0.68 x"),
        Row("jacobian(q, out=)", lambda: robot.jacobian(q, out=jacobian_out), product),
        Row("ik(T)", lambda: robot.ik(T), product),
        Row("ik(T).q, 8 solutions", lambda: robot.ik(T).q, product, "1.00 x"),
        Row("ik_nearest(T, q)", lambda: robot.ik_nearest(T, q), product, "1.92 x"),
        Row("check_pose(T)", lambda: robot.check_pose(T), product),
        Row("singularity(q)", lambda: robot.singularity(q), product),
        Row("link_frames(q)", lambda: robot.link_frames(q), product),
        Row("pose(xyz, quaternion)", lambda: irbkin.pose(xyz, quaternion), product),
        Row("to_xyz_wxyz(T)", lambda: irbkin.to_xyz_wxyz(T), product),
    ]


def seven_joints() -> list[Row]:
    """One pose of a Panda, nearest to a seed, and of a YuMi, each time at another given angle."""
    panda, q = irbkin.Robot("Panda"), np.array([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])
    above, far = panda.fk(q + 0.01), np.array([-1.0, 0.5, -0.8, -1.2, 1.0, 2.5, -1.0])
    yumi, angles = irbkin.Robot("IRB 14050"), itertools.cycle(np.linspace(0.1, 0.3, 7))
    T_yumi, product = yumi.fk(q), "A @ B"
    return [
        Row("A @ B", lambda: above @ above, product),
        Row("Panda: ik_nearest, near", lambda: panda.ik_nearest(above, q), product),
        Row("Panda: ik_nearest, far", lambda: panda.ik_nearest(above, far), product),
        # 35 us for the chain, 5 for the pose.
        Row(
            "YuMi: locked({3: angle}).ik(T)",
            lambda: yumi.locked({3: next(angles)}).ik(T_yumi),
            product,
            "42 x",
        ),
    ]


def batches(robot: irbkin.Robot) -> list[list[Row]]:
    """Many poses, each kind of answer against filling it with zeros."""
    q = np.random.default_rng(1).uniform(*robot.limits.T, size=(POSES, 6))
    T = robot.fk(q)
    poses, jacobians = np.empty((POSES, 4, 4)), np.empty((POSES, 6, 6))
    out = irbkin.IkBatch(np.empty((POSES, 8, 6)), np.empty((POSES, 8), np.uint8))
    nearest = np.empty((POSES, 6))
    seeds = q + np.random.default_rng(2).normal(0.0, 0.05, size=q.shape)
    counted = robot.configuration(q)
    zero_poses, zero_jacobians, zero_joints, one_thread = (
        "poses.fill(0.0)",
        "jacobians.fill(0.0)",
        "joints.fill(0.0)",
        "ik_batch",
    )
    return [
        [
            Row(zero_poses, lambda: poses.fill(0.0), zero_poses),
            Row("fk", lambda: robot.fk(q, out=poses), zero_poses, "32 ns"),
        ],
        [
            Row(zero_jacobians, lambda: jacobians.fill(0.0), zero_jacobians),
            Row("jacobian", lambda: robot.jacobian(q, out=jacobians), zero_jacobians),
        ],
        [
            Row(zero_joints, lambda: out.q.fill(0.0), zero_joints),
            Row(one_thread, lambda: robot.ik_batch(T, out=out), zero_joints, "6.00 x, 67 ns"),
            Row(
                "ik_batch, threads=2",
                lambda: robot.ik_batch(T, out=out, threads=2),
                one_thread,
                "0.59 x",
            ),
            Row(
                "ik_nearest",
                lambda: robot.ik_nearest(T, seeds, out=nearest),
                one_thread,
                "120 ns",
            ),
            Row("ik_configured", lambda: robot.ik_configured(T, counted, out=nearest), one_thread),
            Row(
                "singularity",
                lambda: robot.singularity(q),
                one_thread,
                "300 ns",
            ),
            Row("configuration", lambda: robot.configuration(q), one_thread, "40 ns"),
        ],
    ]


def four_arms() -> None:
    """Print the median and the longest time of `ik(T).q` over poses spread inside the limits, of
    five turns the least: what another process does is not counted.
    """
    count, calls = (10, 1) if QUICK else (1000, 20)
    print(f"\n{'ik(T).q, us':24}{'p50':>12}{'most':>12}")
    for name in ("IRB 1600-6/1.45", "IRB 2600-12/1.65", "UR3", "Panda"):
        robot = irbkin.Robot(name)
        times = []
        for q in np.random.default_rng(3).uniform(*robot.limits.T, size=(count, robot.dof)):
            given = q[6:].tolist()
            solve = partial(robot.ik, robot.fk(q), *given)
            turns = timeit.repeat(lambda solve=solve: solve().q, number=calls, repeat=5)
            times.append(min(turns) / calls * 1e6)
        print(f"{name:24}{np.median(times):12.2f}{max(times):12.2f}")


def sizes(robot: irbkin.Robot) -> None:
    """Print the time of a pose in batches of many sizes, on one thread and on two: the threads are
    worth it from 5,000 poses on, and a million poses are written to memory, not to a cache.
    """
    most = 10_000 if QUICK else 1_000_000
    q = np.random.default_rng(1).uniform(*robot.limits.T, size=(most, 6))
    T, out = robot.fk(q), (np.empty((most, 8, 6)), np.empty((most, 8), np.uint8))
    print(f"\n{'ik_batch(out=) of':24}{'ns a pose':>12}{'2 threads':>12}{'gain':>9}")
    for count in (512, 5_000, *(() if QUICK else (10_000, 50_000, 100_000)), most):
        answer = tuple(array[:count] for array in out)
        calls = [partial(robot.ik_batch, T[:count], out=answer, threads=n) for n in (1, 2)]
        times = np.full((2, ROUNDS), np.inf)
        for turn in range(ROUNDS):
            for i, call in enumerate(calls):
                repeat = max(1, 50_000 // count)
                times[i, turn] = timeit.timeit(call, number=repeat) / repeat / count * 1e9
        one, two = times.min(axis=1)
        print(f"{count:<24,}{one:12.1f}{two:12.1f}{one / two:8.2f}x")


def measure(rows: list[Row], calls: int, poses: int) -> None:
    """Time the rows in turn and print them; a call does `poses` poses, the time is that of one."""
    times: dict[str, list[float]] = {row.name: [] for row in rows}
    for _ in range(ROUNDS):
        for row in rows:
            times[row.name].append(timeit.timeit(row.call, number=calls) / calls / poses)
    for row in rows:
        ratio = statistics.median(
            a / b for a, b in zip(times[row.name], times[row.yardstick], strict=True)
        )
        time = statistics.median(times[row.name]) * 1e9
        print(f"{row.name:24}{time:12.1f}{ratio:9.2f}  {row.yardstick:20}{row.goal}".rstrip())


def import_time() -> float:
    """Time to import irbkin when NumPy is already imported [s]."""
    code = (
        "import numpy, time; start = time.perf_counter(); "
        "import irbkin; print(time.perf_counter() - start)"
    )
    run = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout
        for _ in range(5)
    ]
    return statistics.median(float(seconds) for seconds in run)


def main() -> None:
    """Measure and print the tables."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    print(f"{cpu()[0]}, irbkin calculates with {irbkin._core.instruction_set()}; {robot.name}")
    columns = f"{'ratio':>9}  {'against':20}goal"
    print(f"\n{'One pose':24}{'ns a call':>12}{columns}")
    measure(single_calls(robot), CALLS, 1)
    measure(seven_joints(), CALLS // 10, 1)
    four_arms()
    print(f"\n{f'{POSES} poses, out=':24}{'ns a pose':>12}{columns}")
    for rows in batches(robot):
        measure(rows, 1, POSES)
    sizes(robot)
    print(f"\nimport irbkin, NumPy loaded: {import_time() * 1e3:.1f} ms (goal 5 ms)")
    print(
        "Goals in Rust, one thread: 150 ns a pose of 8 solutions (AVX2 up), "
        "30 ns in a batch (AVX-512), 60 ns (AVX2)"
    )


if __name__ == "__main__":
    main()
