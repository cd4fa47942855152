"""Free motions round a table and into a shelf: milliseconds, how many are found and go straight."""

import os
import time

import irbkin
import numpy as np
from irbkin.body import Shape

COUNT = 5 if os.environ.get("QUICK") else 200
ARMS = {"UR5e": 1.0, "IRB 2600-12/1.65": 1.8}

# Edges and centers of boxes, for an arm of size 1 [m].
TABLE = {
    "table": ([0.8, 1.6, 0.04], [0.65, 0, 0]),
    "box": ([0.2, 0.2, 0.3], [0.5, 0, 0.17]),
    "post": ([0.06, 0.06, 0.6], [0.6, 0.35, 0.32]),
}
SHELF = {
    "left": ([0.35, 0.02, 1], [0.72, 0.4, 0.5]),
    "right": ([0.35, 0.02, 1], [0.72, -0.4, 0.5]),
    "back": ([0.02, 0.8, 1], [0.9, 0, 0.5]),
    "lower": ([0.35, 0.8, 0.02], [0.72, 0, 0.1]),
    "middle": ([0.35, 0.8, 0.02], [0.72, 0, 0.45]),
    "upper": ([0.35, 0.8, 0.02], [0.72, 0, 0.8]),
}


def cell_of(boxes, size):
    """The boxes on a floor."""
    obstacles = {
        name: Shape.box(size * np.array(edges), irbkin.pose(size * np.array(center)))
        for name, (edges, center) in boxes.items()
    }
    floor = Shape.half_space([0, 0, 1], [0, 0, -0.02])
    return irbkin.Cell({**obstacles, "floor": floor}, margin=0.005)


def on_table(rng, size):
    """A pose above the table, with the tool down."""
    place = rng.uniform([0.35, -0.5, 0.08], [0.7, 0.5, 0.25])
    return irbkin.pose(size * place, euler_zyx=[rng.uniform(-1.5, 1.5), 0, np.pi])


def in_shelf(rng, size):
    """A pose in the shelf, with the tool towards its back."""
    place = rng.uniform([0.5, -0.25, 0.14], [0.65, 0.25, 0.22])
    place[2] += rng.choice([0.1, 0.45])
    return irbkin.pose(size * place, euler_zyx=[rng.uniform(-0.3, 0.3), np.pi / 2, 0])


def free_pose(robot, cell, rng, draw, size):
    """A pose with a solution that is free, and that solution."""
    while True:
        T = draw(rng, size)
        free = robot.ik(T).within_limits().filter(cell)
        if len(free):
            return T, free[0].q


def problems(robot, cell, rng, draw, size):
    """A third from any joints, a third from joints in the scene, a third from pose to pose."""
    low, high = np.clip(robot.limits, -3, 3).T
    for number in range(COUNT):
        T, q = free_pose(robot, cell, rng, draw, size)
        if number % 3 == 0:
            q = rng.uniform(low, high)
            while cell.collides(robot, q):
                q = rng.uniform(low, high)
        yield (T if number % 3 == 2 else q), free_pose(robot, cell, rng, draw, size)[0]


def main():
    """Print a row for each arm and scene."""
    print("| free motion | median [ms] | p99 [ms] | found | straight |")
    print("|---|---|---|---|---|")
    for name, size in ARMS.items():
        robot = irbkin.Robot(name)
        for scene, boxes, draw in (("table", TABLE, on_table), ("shelf", SHELF, in_shelf)):
            cell, rng = cell_of(boxes, size), np.random.default_rng(7)
            times, found, straight = [], 0, 0
            for start, goal in problems(robot, cell, rng, draw, size):
                begun = time.perf_counter()
                try:
                    motion = robot.go(start, goal, cell)
                except irbkin.UnreachableError:
                    motion = None
                times.append(1e3 * (time.perf_counter() - begun))
                if motion is not None:
                    found += 1
                    straight += len(motion.knots) <= 4
            median, p99 = np.percentile(times, [50, 99])
            print(
                f"| {name}, {scene} | {median:.2f} | {p99:.1f} | {found} of {COUNT} | {straight} |"
            )


if __name__ == "__main__":
    main()
