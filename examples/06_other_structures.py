"""Other arms than ABB's: three parallel axes, seven axes, and tables and URDFs that are
recognized.
"""

from pathlib import Path

import irbkin
import numpy as np

URDF = Path(__file__).parents[1] / "tests" / "data" / "ur5e.urdf"
SLOT = (("left", "right"), ("q3 >= 0", "q3 < 0"), ("q5 >= 0", "q5 < 0"))


def degrees(q: irbkin.Solution) -> str:
    # Adding zero turns -0.0 into 0.0.
    return " ".join(f"{round(np.degrees(angle), 2) + 0.0:8.2f}" for angle in q)


def three_parallel_axes() -> None:
    robot = irbkin.Robot("UR3")
    T = robot.fk(np.radians([25, -105, 85, -35, 65, 15]))
    solutions = robot.ik(T)
    print(f"{robot.name}: {robot.structure}, {solutions.explain()}")
    for solution in solutions:
        words = ", ".join(
            word[bool(solution.slot & bit)] for word, bit in zip(SLOT, (4, 2, 1), strict=True)
        )
        print(f"  {solution.slot} {degrees(solution)}   {words}")

    # Axis 6 parallel to axes 2, 3 and 4: joint 6 is free.
    singular = robot.ik(robot.fk(np.radians([25, -80, 75, -45, 0, 40])))[0]
    assert singular.free_joint is not None
    joint, fixed = singular.free_joint.joint, singular.free_joint.fixed
    print(f"  with q5 = 0: J{joint} is free, {fixed} stay fixed")
    print(f"  {singular.slot} {degrees(singular)}")
    print(f"  {singular.slot} {degrees(singular.with_free_joint(np.radians(40)))}\n")


def seven_axes() -> None:
    robot = irbkin.Robot("Panda")
    here = np.radians([5, -40, 10, -130, 5, 95, 35])
    T = robot.fk(here)
    solutions = robot.ik(T, q7=here[6])
    print(f"{robot.name}: {robot.structure}, q7 = 35 deg: {solutions.explain()}")
    for solution in solutions:
        print(
            f"  {solution.slot} {degrees(solution)}   "
            f"{'inside' if solution.is_within_limits else 'outside'}"
        )
    T[2, 3] += 0.050
    print("  50 mm higher, q7 chosen too:")
    print(f"    {' '.join(f'{angle:8.2f}' for angle in np.degrees(robot.ik_nearest(T, here)))}\n")


def recognized() -> None:
    robot = irbkin.Robot.from_urdf(URDF, tip="tool0")
    print(f"{URDF.name}: {robot.structure}")
    # An IRB 2600 in standard form, with unusual frames and zero pose.
    rows = np.array(
        [
            [90, 0.150, 0.445, 0],
            [0, 0.700, 0, 60],
            [90, 0.115, 0, 20],
            [-90, 0, 0.795, 0],
            [90, 0, 0, 45],
            [0, 0, 0.085, 0],
        ]
    )
    rows[:, [0, 3]] = np.radians(rows[:, [0, 3]])
    robot = irbkin.Robot.from_sdh(rows)
    solutions = robot.ik(robot.fk(np.radians([10, 20, 30, 40, 50, 60])))
    print(f"a standard table with unusual frames: {robot.structure}, {len(solutions)} solutions")

    tilted = rows.copy()
    tilted[1, 0] += np.radians(0.2)
    tilted[4, 1] = 0.002
    try:
        irbkin.Robot.from_sdh(tilted)
    except irbkin.InvalidModelError as error:
        print(f"the same with errors:\n  {error}")


def main() -> None:
    three_parallel_axes()
    seven_axes()
    recognized()


if __name__ == "__main__":
    main()
