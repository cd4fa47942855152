"""The observed worst case of one pose: `ik`, `ik_nearest` and `Follower.step` of every catalog arm
and of one of the general method at hard poses, and other packages at these in the same run.

`python -m benches.peers.worst_case [--write]`; POSES poses of each set.
"""

from __future__ import annotations

import os
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import irbkin
import numpy as np

from .arms import IRB2600, UR3, Arm, Floats
from .contenders import BUILDERS
from .general_arms import CRX10IAL, MANSEUR_DOTY
from .machine import describe

POSES = int(os.environ.get("POSES", "60"))
PAGE = Path(__file__).parents[2] / "docs" / "evidence" / "worst_case.md"
PEERS = ("py-opw-kinematics", "eaik", "ur-analytic-ik", "crx-kinematics")
NAMED = {arm.name: arm for arm in (IRB2600, UR3, CRX10IAL)}
CALLS = 3

HEAD = """# Observed worst case

Written by `make evidence SUITE=worst-case`. Microseconds of a call from Python on one thread: half
of all calls, 99 % and all took no longer. These are observations, **not bounds**.

The poses, {poses} of each set: random joint vectors; all joints at zero; all at multiples of 90 and
of 45 deg; J5 at zero and 1e-6 rad off; the elbow straight; the wrist center on axis 1; stretched,
1e-9 m towards the base and away from it. A set is left out where an arm has none within its limits.
The seed is the joints that made the pose, each off by up to 0.01 rad. A call counts with the least
processor time of three.

{machine}

| arm | `ik` | `ik_nearest` | `Follower.step` |
|---|---:|---:|---:|
"""
OTHERS = """
## Other packages

At the same poses in turn with irbkin, all solutions of a pose: times in units of irbkin's `ik`. A
package that has no solution, or raises an error, counts as it is.

| arm | package | half | 99 % | most |
|---|---|---:|---:|---:|
"""


def least(robot: irbkin.Robot, q: Floats, joint: int, field: str) -> Floats:
    """Joint vectors with a joint at the angle, by four scans, where a distance is least: three
    leave some nanometers, and the arm is not singular there.
    """
    low, high = np.clip(robot.limits[joint], -np.pi, np.pi)
    for _ in range(4):
        all_of = np.repeat(q[None], 2001, axis=0)
        all_of[:, joint] = np.linspace(low, high, len(all_of))
        best = all_of[np.argmin(getattr(robot.singularity(all_of), field)), joint]
        step = 2.0 * (high - low) / 2000
        low, high = best - step, best + step
    return np.where(np.arange(len(q)) == joint, best, q)


def sets(robot: irbkin.Robot, q: Floats) -> Iterator[Floats]:
    """A joint vector changed to each kind of pose."""
    yield q
    yield np.zeros_like(q)
    for step in (np.pi / 2, np.pi / 4):
        yield step * np.round(q / step)
    for angle in (0.0, 1e-6):
        yield np.where(np.arange(len(q)) == len(q) - 2, angle, q)
    if len(q) == 6 and np.isfinite(robot.singularity(q).elbow):
        yield least(robot, q, 2, "elbow")
        yield least(robot, q, 1, "shoulder")


def poses(robot: irbkin.Robot) -> list[tuple[Floats, Floats]]:
    """Poses and seeds."""
    rng = np.random.default_rng(1)
    found = []
    for _ in range(POSES):
        for q in sets(robot, robot.random(rng=rng)):
            if ((robot.limits[:, 0] <= q) & (q <= robot.limits[:, 1])).all():
                found.append((robot.fk(q), q + rng.uniform(-0.01, 0.01, q.shape)))
                if robot.structure == "spherical wrist" and robot.singularity(q).elbow < 1e-6:
                    for off in (-1e-9, 1e-9):
                        beyond = found[-1][0].copy()
                        away = beyond[:3, 3] / np.linalg.norm(beyond[:3, 3])
                        beyond[:3, 3] += off * away
                        found.append((beyond, found[-1][1]))
    return found


def timed(call: Callable[..., object], *arguments: object) -> float:
    """The least processor time of a few calls [us]; an error out of reach is an answer."""
    best = np.inf
    for _ in range(CALLS):
        begin = time.thread_time_ns()
        try:
            call(*arguments)
        except Exception:
            end = time.thread_time_ns()
        else:
            end = time.thread_time_ns()
        best = min(best, 1e-3 * (end - begin))
    return best


def ends(times: list[float]) -> Floats:
    """What half of the times, 99 % of them and all are below."""
    return np.quantile(times, [0.5, 0.99, 1.0])


def row(robot: irbkin.Robot) -> str:
    """The row of an arm."""
    times: list[list[float]] = [[], [], []]
    for T, seed in poses(robot):
        if robot.dof == 6:
            times[0].append(timed(robot.ik, T))
        times[1].append(timed(robot.ik_nearest, T, seed))
        times[2].append(timed(irbkin.Follower(robot, seed).step, T))
    cells = (" / ".join(f"{end:.1f}" for end in ends(each)) if each else "" for each in times)
    return f"| {robot.name} | {' | '.join(cells)} |"


def others(arm: Arm) -> Iterator[str]:
    """The rows of other packages for an arm."""
    robot = irbkin.Robot(arm.name)
    for package in PEERS:
        try:
            offered = [one for one in BUILDERS[package](arm) if one.task == "ik"]
        except ImportError:
            print(f"{package} is not installed: left out", file=sys.stderr)
            continue
        for one in offered[-1:]:
            own, its = [], []
            for T, seed in poses(robot):
                its.append(timed(one.call, *one.prepare(T, seed)))
                own.append(timed(robot.ik, T))
            ratios = " | ".join(f"{ratio:.2g} x" for ratio in ends(its) / ends(own))
            yield f"| {arm.name} | {one.name} | {ratios} |"


def main() -> None:
    """Print or write the page."""
    machine = "\n\n".join(textwrap.fill(line, 100) for line in describe(["irbkin", *PEERS]))
    general = irbkin.Robot.from_mdh(MANSEUR_DOTY.table, name=MANSEUR_DOTY.name)
    robots = [*map(irbkin.Robot, irbkin.catalog()), general]
    lines = [HEAD.format(poses=POSES, machine=machine) + "\n".join(map(row, robots))]
    lines.append(OTHERS + "\n".join(line for arm in NAMED.values() for line in others(arm)))
    text = "\n".join(lines) + "\n"
    if "--write" in sys.argv:
        PAGE.write_text(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
