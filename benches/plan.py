"""Times and memory of plans: a weld circle of an IRB 2600, its growth, and greedy starts.

Each time is the least of many calls from Python to arrays, on one thread: as many as fit into two
seconds, but 7 to 200. Each row runs in a process of its own, whose peak memory is that beyond what
the imports and the path take. QUICK=1 runs each row once, on fewer poses.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time

import irbkin
import numpy as np

QUICK = bool(os.environ.get("QUICK"))
SECONDS = 2.0  # of calls in each row
ROWS: dict[str, dict[str, object]] = {
    "fixed orientation": {},
    "fixed orientation, start given": {"start": True},
    "36 rotations": {"rotation": 36},
    "36 rotations, start given": {"rotation": 36, "start": True},
    "36 rotations, without turns": {"rotation": 36, "flat": True},
    "36 rotations, closed": {"rotation": 36, "closed": True},
    "360 rotations": {"rotation": 360},
    "cone of 10 deg": {"tolerance": irbkin.ToolCone(np.radians(10))},
    "track along a seam of 5 m": {"carrier": irbkin.Track("y", -3, 3)},
    "the same, 36 rotations": {"carrier": irbkin.Track("y", -3, 3), "rotation": 36},
}


def weld(poses: int) -> tuple[irbkin.Robot, np.ndarray]:
    """A circle, the torch 30 degrees off the vertical and turning with it."""
    robot = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
    T = [
        irbkin.pose(
            [1.0 + 0.15 * np.cos(angle), 0.15 * np.sin(angle), 0.5],
            euler_zyx=[angle, np.pi - np.radians(30), 0],
        )
        for angle in np.linspace(0, 2 * np.pi, poses)
    ]
    return robot, np.array(T)


def row(name: str, poses: int) -> None:
    """Time one row and print it."""
    robot, T = weld(poses)
    arguments = dict(ROWS[name])
    if "carrier" in arguments:
        ends = [irbkin.pose([1.1, y, 0.6], euler_zyx=[0, 2.7, 0]) for y in (-2.5, 2.5)]
        T = irbkin.paths.line(*ends, steps=poses)
    if arguments.pop("flat", False):
        robot = robot.with_limits(np.clip(robot.limits, -np.pi, np.pi))
    if arguments.pop("start", False):
        arguments["start"] = robot.plan(T).q[0]
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    times = []
    least, most = (1, 1) if QUICK else (7, 200)
    while len(times) < least or (sum(times) < SECONDS and len(times) < most):
        begin = time.perf_counter()
        plan = robot.plan(T, **arguments)  # type: ignore[arg-type]
        times.append(time.perf_counter() - begin)
    memory = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    print(
        f"{name:34}{poses:8}{1e3 * min(times):11.2f} ms{memory:9.1f} MB"
        f"   bottleneck {plan.bottleneck:.6f}, cost {plan.cost:.6f}"
    )


def greedy(paths: int) -> None:
    """Of random lines that can be followed: how many the start nearest to zero does not follow."""
    robot, rng = irbkin.Robot("IRB 2600-12/1.65"), np.random.default_rng(1)
    feasible = failed = 0
    low, high = np.clip(robot.limits, -np.pi, np.pi).T
    for _ in range(paths):
        start = rng.uniform(low, high)
        end = start + rng.uniform(-1.0, 1.0, 6)
        T = irbkin.paths.line(robot.fk(start), robot.fk(end), steps=40)
        try:
            robot.plan(T)
        except irbkin.PathError:
            continue
        feasible += 1
        failed += bool(robot.follow(T, robot.ik_nearest(T[0], np.zeros(6))).breaks)
    print(
        f"\n{paths} random lines: {feasible} have a plan; the start nearest to zero fails on "
        f"{failed} of them ({100 * failed / max(feasible, 1):.0f} %)"
    )


def main() -> None:
    """Run every row in a process of its own."""
    if len(sys.argv) == 3:
        row(sys.argv[1], int(sys.argv[2]))
        return
    poses = 100 if QUICK else 1000
    sizes = [] if QUICK else [100, 10_000, 100_000]
    for name in ROWS:
        subprocess.run([sys.executable, __file__, name, str(poses)], check=True)
    for size in sizes:
        subprocess.run([sys.executable, __file__, "fixed orientation", str(size)], check=True)
    greedy(20 if QUICK else 1000)


if __name__ == "__main__":
    main()
