"""All solutions that bring the tool of an IRB 2600 to one pose."""

import irbkin
import numpy as np
import numpy.typing as npt

HOME = np.radians([0, 0, 0, 0, 30, 0])


def outside(limits: npt.NDArray[np.float64], q: npt.NDArray[np.float64]) -> str:
    joints = [f"J{i + 1}" for i in range(6) if not limits[i, 0] <= q[i] <= limits[i, 1]]
    return "outside: " + " ".join(joints) if joints else "inside"


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65")
    # 850, 320, 640 mm from the base; the tool points forward and down, 60 deg below the horizon.
    T = irbkin.pose([0.850, 0.320, 0.640], wxyz=[0.2588190, 0, 0.9659258, 0])
    xyz, wxyz = irbkin.to_xyz_wxyz(T)
    solutions = robot.ik(T)

    print(f"{robot.name}: {robot.dof} axes, {robot.structure}")
    print("pose  xyz  " + " ".join(f"{1e3 * v:9.1f}" for v in xyz) + "            mm")
    print("      wxyz " + " ".join(f"{v:9.6f}" for v in wxyz))
    print(f"{solutions.explain()}\n")

    print("slot      J1      J2      J3      J4      J5      J6  residual  limits")
    for solution in solutions:
        angles = " ".join(f"{np.degrees(angle):7.2f}" for angle in solution)
        print(
            f"   {solution.slot} {angles}     {solution.residual:.0e}  "
            f"{outside(robot.limits, solution.q)}"
        )
    print("(degrees; the slot is ABB's cfx; the residual is the larger of meters and radians)\n")

    nearest = solutions.nearest(HOME)
    s = robot.singularity(nearest.q)
    print(f"nearest to home: slot {nearest.slot}")
    print(f"  from the wrist singularity    {np.degrees(s.wrist):6.1f} deg")
    print(f"  from the elbow singularity    {np.degrees(s.elbow):6.1f} deg")
    print(f"  from the shoulder singularity {1e3 * s.shoulder:6.1f} mm\n")

    T[0, 3] += 1.0
    print(f"the same pose one meter farther out: {robot.ik(T).explain()}")


if __name__ == "__main__":
    main()
