"""Collisions: times of a posture, of the solutions of a pose and of a move, in NumPy products."""

import os
import timeit

import irbkin
import numpy as np
from irbkin.body import Shape

COUNT = 1_000 if os.environ.get("QUICK") else 20_000
ARMS = ("IRB 1200-5/0.9", "IRB 2600-12/1.65", "IRB 6700-200/2.6", "UR5e", "CRB 15000-5/0.95")


def seconds(work, number=1):
    """The least of seven runs."""
    return min(timeit.repeat(work, number=number, repeat=7)) / number


def around(reach, count):
    """Boxes on a circle, partly within reach."""
    angles = 2 * np.pi * np.arange(count) / count
    size = 0.15 * reach * np.ones(3)
    return {
        f"box {i}": Shape.box(
            size, irbkin.pose(reach * np.array([0.9 * np.cos(a), 0.9 * np.sin(a), 0.15 * (i % 4)]))
        )
        for i, a in enumerate(angles)
    }


def row(name, product):
    """Times of an arm."""
    rng = np.random.default_rng(1)
    robot = irbkin.Robot(name)
    lower, upper = np.array(robot.limits).T
    q = rng.uniform(lower, upper, (COUNT, robot.dof))
    out = np.empty(COUNT, bool)
    reach = irbkin.catalog_entry(name).reach
    few, many = irbkin.Cell(around(reach, 10)), irbkin.Cell(around(reach, 100))
    crowds = [irbkin.Cell(around(reach, count)) for count in (1_000, 10_000)]
    alone = seconds(lambda: irbkin.Cell().collides(robot, q, out)) / COUNT
    boxes = seconds(lambda: few.collides(robot, q, out)) / COUNT
    crowded = [seconds(lambda own=own: own.collides(robot, q, out)) / COUNT for own in crowds]
    poses = [robot.ik(T) for T in robot.fk(q[:200])]
    pose = seconds(lambda: [it.filter(few) for it in poses]) / len(poses)
    free = q[~many.collides(robot, q)][:500]
    moves = [np.array([it, it + rng.uniform(-0.3, 0.3, robot.dof)]) for it in free]
    move = seconds(lambda: [many.check_path(robot, it) for it in moves]) / len(moves)
    print(
        f"{name}: alone {alone * 1e9:.0f} ns [{alone / product:.2f}], "
        f"10 boxes {boxes * 1e9:.0f} ns [{boxes / product:.2f}], "
        f"1,000 boxes {crowded[0] * 1e9:.0f} ns [{crowded[0] / product:.2f}], "
        f"10,000 boxes {crowded[1] * 1e9:.0f} ns [{crowded[1] / product:.2f}], "
        f"solutions of a pose {pose * 1e6:.1f} us [{pose / product:.1f}], "
        f"a move, 100 boxes {move * 1e6:.0f} us [{move / product:.0f}]"
    )


def main():
    """Print a row for each arm."""
    one, other = np.eye(4), np.eye(4)
    product = seconds(lambda: one @ other, 20_000)
    print(f"a product of two 4x4 arrays: {product * 1e9:.0f} ns; in brackets: in such products")
    for name in ARMS:
        row(name, product)


if __name__ == "__main__":
    main()
