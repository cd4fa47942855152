"""Arms without a closed form: a GoFa with its sixteen solutions, an IRB 2600 after its calibration,
solved completely and tracked, and a YuMi with one of its seven joints given.

The calibration needs scipy: pip install 'irbkin[calibrate]'.
"""

import irbkin
import numpy as np

# CRB 15000-5/0.95 (GoFa 5): alpha [deg], a [m], d [m], theta [deg]. Axes 5 and 6 do not meet.
GOFA = [
    (0, 0, 0.265, 0),
    (-90, 0, 0, -90),
    (0, 0.444, 0, 0),
    (-90, 0.110, 0.470, 0),
    (90, 0, 0, 0),
    (-90, 0.080, 0.101, 180),
]


def degrees(q: irbkin.Solution) -> str:
    # Adding zero turns -0.0 into 0.0.
    return " ".join(f"{round(np.degrees(angle), 2) + 0.0:8.2f}" for angle in q)


def offset_wrist() -> None:
    rows = np.array(GOFA)
    rows[:, [0, 3]] = np.radians(rows[:, [0, 3]])
    gofa = irbkin.Robot.from_mdh(rows, name="GoFa 5")
    T = gofa.fk(np.radians([83, -84, 132, 45, 116, 62]))
    solutions = gofa.ik(T)
    print(f"{gofa.name}: {len(solutions)} solutions")
    for solution in solutions:
        print(f"  {degrees(solution)}")


def measurements(robot: irbkin.Robot) -> tuple[np.ndarray, np.ndarray]:
    """Sixty joint vectors, and noisy poses of an arm whose parameters are all a little off."""
    rng = np.random.default_rng(9)
    arm = robot.with_corrections(rng.normal(0, 5e-4, 42))
    low, high = robot.limits.clip(-3, 3).T
    q = rng.uniform(low, high, (60, 6))
    measured = arm.fk(q)
    measured[:, :3, 3] += rng.normal(0, 5e-5, (60, 3))
    return q, measured


def calibrated() -> None:
    nominal = irbkin.Robot("IRB 2600-12/1.65")
    found = irbkin.calibrate(nominal, *measurements(nominal))
    residuals = found.residuals
    print(f"\n{nominal.name}: {len(found.parameters)} parameters calibrated")
    for name, stage in (("before", residuals.before), ("after", residuals.after)):
        print(f"  {name:6} {1e3 * stage.position_rms:.2f} mm rms")

    T = found.robot.fk(np.radians([10, 20, 30, 40, 50, 60]))
    print(f"  all solutions: {len(found.robot.ik(T))}, structure {found.robot.structure}")
    tracking = found.robot.with_nominal(nominal)
    print(f"  branches of the nominal arm: {len(tracking.ik(T))}, {tracking.structure}")

    # A line of 300 mm, followed by the calibrated arm.
    T_end = T.copy()
    T_end[1, 3] += 0.3
    line = irbkin.paths.line(T, T_end, steps=100)
    followed = tracking.follow(line, np.radians([10, 20, 30, 40, 50, 60]))
    off = np.linalg.norm((tracking.fk(followed.q) - line)[:, :3, 3], axis=1)
    print(
        f"  a line of 100 poses: breaks {followed.breaks}, within a nanometer: {off.max() < 1e-9}"
    )


def seven_axes() -> None:
    yumi = irbkin.Robot("IRB 14050")
    q = np.radians([10, -60, 40, 20, 30, 70, 50])
    T = yumi.fk(q)
    print(f"\n{yumi.name}, seven axes")
    for joint in (7, 3):
        elbow = yumi.locked({joint: q[joint - 1]})
        certainty = "certain to be all" if elbow.ik(T).certified else "not certain to be all"
        print(f"  joint {joint} given: {len(elbow.ik(T))} solutions, {certainty}")
    seed = q + 0.1
    away = [np.degrees(np.linalg.norm(joints - seed)) for joints in (q, yumi.ik_nearest(T, seed))]
    print(f"  {away[0]:.1f} deg from a seed; with joint 7 chosen, the nearest is {away[1]:.1f} deg")


def main() -> None:
    offset_wrist()
    calibrated()
    seven_axes()


if __name__ == "__main__":
    main()
