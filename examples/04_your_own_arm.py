"""An arm that is not in the catalog: from a table, from parameters, and what is rejected."""

import irbkin
import numpy as np


def refused(what: str, error: irbkin.IrbkinError) -> None:
    print(f"{what}\n  {type(error).__name__}: {error}")


def main() -> None:
    # alpha, a, d, theta offset of each joint, after Craig; degrees and meters here.
    table = np.array(
        [
            [0, 0, 0.445, 0],
            [-90, 0.150, 0, -90],
            [0, 0.700, 0, 0],
            [-90, 0.115, 0.795, 0],
            [90, 0, 0, 0],
            [-90, 0, 0.085, 180],
        ]
    )
    table[:, [0, 3]] = np.radians(table[:, [0, 3]])
    arm = irbkin.Robot.from_mdh(table, name="from a table")
    T = irbkin.pose([0.850, 0.320, 0.640], wxyz=[0.2588190, 0, 0.9659258, 0])
    print(f"{arm.name}: {arm.structure}, {arm.ik(T).explain()}")

    # OPW parameters [m]; this maker counts axes 1, 4 and 6 in the opposite sense.
    kuka = irbkin.Robot.from_opw(
        a1=0.025,
        a2=-0.035,
        b=0,
        c1=0.400,
        c2=0.315,
        c3=0.365,
        c4=0.080,
        offsets=np.radians([0, -90, 0, 0, 0, 0]),
        signs=[-1, 1, 1, -1, 1, -1],
        name="KR 6 R700",
    )
    q = np.radians([0, -90, 90, 0, 30, 0])
    print(f"{kuka.name}: {kuka.structure}, {kuka.ik(kuka.fk(q)).explain()}\n")

    # A wrist whose axes 5 and 6 are 80 mm apart has no closed form: polynomials solve it.
    offset_wrist = table.copy()
    offset_wrist[5, 1] = 0.080
    arm = irbkin.Robot.from_mdh(offset_wrist)
    solutions = arm.ik(arm.fk(np.radians([10, 20, 30, 40, 50, 60])))
    certainty = "certified" if solutions.certified else "not certified"
    print(f"axes 5 and 6 apart: {arm.structure}, {len(solutions)} solutions, {certainty}")
    print(f"  {arm}\n")

    mirrored = np.diag([1.0, 1.0, -1.0, 1.0])
    try:
        kuka.ik(mirrored)
    except irbkin.InvalidPoseError as error:
        refused("a left-handed pose", error)
    try:
        kuka.with_limits(np.array([[-3, 3], [0.5, -2], [-3, 3], [-3, 3], [-2, 2], [-6, 6]]))
    except irbkin.InvalidModelError as error:
        refused("exchanged limits", error)
    try:
        irbkin.Robot("IRB 2600-12/1.56")
    except irbkin.UnknownRobotError as error:
        refused("a misspelled name", error)


if __name__ == "__main__":
    main()
