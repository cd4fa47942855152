"""One step of a guard beside a box, a cylinder and a floor: thread CPU time from Python.

References go by turns along smooth motions, to random goals, to obstacles, through singular poses,
and are broken or missing. CYCLES=40000 for the table of docs/evidence/performance.md.
"""

import os
import time

import irbkin
import numpy as np
from irbkin.body import Shape
from irbkin.stream import Guard

CYCLES = int(os.environ.get("CYCLES", "2000" if os.environ.get("QUICK") else "200000"))
CYCLE = 0.004
ARMS = ("IRB 2600-12/1.65", "UR5e", "GoFa 5", "Panda")
LIMITS = {"max_velocity": 1.8, "max_acceleration": 8.0, "max_jerk": 60.0}


def cell_of(robot):
    """A box, a cylinder and a floor around an arm."""
    reach = sum(abs(robot.mdh[:, 1])) + sum(abs(robot.mdh[:, 2]))
    obstacles = {
        "box": Shape.box([0.2 * reach] * 3, irbkin.pose(reach * np.array([0.5, 0.2, 0.15]))),
        "post": Shape.cylinder(0.04 * reach, reach, irbkin.pose(reach * np.array([-0.1, 0.5, 0]))),
        "floor": Shape.half_space([0, 0, 1], [0, 0, -0.01]),
    }
    return irbkin.Cell(obstacles, margin=0.005)


def inside(robot, rng):
    """A random joint vector inside the limits."""
    low, high = np.clip(robot.limits, -np.pi, np.pi).T
    return rng.uniform(low, high)


def free_start(robot, cell, rng):
    """A random joint vector that touches nothing."""
    while True:
        q = inside(robot, rng)
        if not cell.collides(robot, q):
            return q


def sampled(motion):
    """Joint vectors of a trajectory, one a cycle, the last at its end."""
    times = np.arange(np.ceil(motion.duration / CYCLE) + 1) * CYCLE
    return motion.sample(np.minimum(times, motion.duration)).q


def references(robot, guard, rng):
    """References of one kind for up to a second."""
    kind, count = rng.integers(7), int(rng.integers(1, 250))
    here = guard.q
    goal = here + rng.uniform(0, 1) * (inside(robot, rng) - here)
    if kind == 0:
        return [None] * count
    if kind == 1:
        return [np.full(robot.dof, rng.choice([np.nan, 1e9]))] * count
    if kind == 2:
        return [goal] * count
    if kind in (3, 4):
        motion = irbkin.trajectory.joint(here, goal, **LIMITS, profile="s_curve")
        q = sampled(motion)
        return list(q if kind == 3 else robot.fk(q))
    if kind == 5:
        # Through the wrist singularity.
        through = here.copy()
        through[4] = -here[4]
        motion = irbkin.trajectory.joint(here, through, **LIMITS, profile="s_curve")
        return list(robot.fk(sampled(motion)))
    return list(here + rng.normal(0, 1e-5, (count, robot.dof)).cumsum(axis=0))


def times(name, on_violation):
    """Nanoseconds of each step."""
    rng = np.random.default_rng(1)
    robot = irbkin.Robot(name)
    cell = cell_of(robot)
    start = free_start(robot, cell, rng)
    guard = Guard(robot, cycle=CYCLE, start=start, cell=cell, on_violation=on_violation, **LIMITS)
    taken, clock = [], time.thread_time_ns
    while len(taken) < CYCLES:
        for reference in references(robot, guard, rng):
            begun = clock()
            guard.step(reference)
            taken.append(clock() - begun)
    return np.array(taken)


def main():
    """Print a row for each arm and mode."""
    empty = [time.thread_time_ns() for _ in range(10001)]
    print(f"{CYCLES} steps each, the clock alone {np.median(np.diff(empty)) / 1e3:.2f} us")
    print(f"{'us':28}{'median':>8}{'99 %':>8}{'99.9 %':>8}{'99.99 %':>8}{'most':>8}")
    for name in ARMS:
        for on_violation in ("brake", "limit"):
            taken = times(name, on_violation) / 1e3
            row = [*np.percentile(taken, [50, 99, 99.9, 99.99]), taken.max()]
            print(f"{name + ', ' + on_violation:28}" + "".join(f"{one:8.1f}" for one in row))


if __name__ == "__main__":
    main()
