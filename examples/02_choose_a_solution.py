"""Choose a solution: limits, 2 pi equivalents, nearest, least motion, your own test."""

import irbkin
import numpy as np


def show(what: str, solution: irbkin.Solution) -> None:
    print(
        f"{what:28} slot {solution.slot}  "
        + " ".join(f"{np.degrees(angle):7.1f}" for angle in solution)
    )


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65")
    T = irbkin.pose([0.850, 0.320, 0.640], wxyz=[0.2588190, 0, 0.9659258, 0])
    solutions = robot.ik(T)
    print(f"{solutions.explain()}; with 2 pi equivalents: {len(solutions.turns())}\n")

    # The current joints, halfway between two wrist configurations.
    seed = np.radians([20, 0, 40, 55, -25, 127])
    show("nearest (root of squares)", solutions.nearest(seed))
    show("least motion (sum)", solutions.least_motion(seed))
    show("nearest, J5 weighted 9", solutions.nearest(seed, weights=[1, 1, 1, 1, 9, 1]))

    # J6 is wound back by most of a turn; the answer stays near it.
    wound = np.radians([20, 0, 40, -30, 25, -300])
    show("nearest to J6 = -300", solutions.nearest(wound))

    # Your own test, for a cable that must not twist or for collisions.
    untwisted = solutions.within_limits().filter(lambda solution: abs(solution[3]) < np.pi / 2)
    print(f"\ninside the limits with |J4| < 90: slots {[solution.slot for solution in untwisted]}")

    # frames[2] is the frame of joint 3: its origin is the elbow.
    low = solutions.filter(lambda solution: robot.link_frames(solution)[2, 2, 3] < 0.3)
    print(f"elbow below 300 mm: slots {[solution.slot for solution in low]}")
    print(f"and of those inside the limits: {low.within_limits().explain()}")

    # With tighter limits, the message names the joint that exceeds them.
    limits = robot.limits.copy()
    limits[0] = np.radians([-90, 90])
    limits[4] = np.radians([-20, 20])
    try:
        robot.with_limits(limits).ik_nearest(T, seed)
    except irbkin.UnreachableError as error:
        print(f"with J1 in +-90 and J5 in +-20: {error}")


if __name__ == "__main__":
    main()
