"""The joint path of a weld seam: fixed torch, then free to turn about its own axis."""

import irbkin
import numpy as np

POSES = 501


def seam() -> np.ndarray:
    """A spiral of two and a half turns, the torch 30 degrees off the vertical, turning with it."""
    angles = 5 * np.pi * np.arange(POSES) / (POSES - 1)
    poses = [
        irbkin.pose(
            [1.0 + 0.01 * angle * np.cos(angle), 0.01 * angle * np.sin(angle), 0.5],
            euler_zyx=[angle % (2 * np.pi), np.radians(150), 0],
        )
        for angle in angles
    ]
    return np.array(poses)


def show(name: str, plan: irbkin.Plan) -> None:
    least, most = np.degrees([plan.tool_angle.min(), plan.tool_angle.max()])
    print(f"{name}: slot {plan.slot[0]}, certified, at least {plan.bottleneck:.2f} s")
    # Adding zero turns -0.0 into 0.0.
    print(f"  torch turned by {round(least, 1) + 0.0:.1f} to {round(most, 1) + 0.0:.1f} deg")


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
    T = seam()
    try:
        robot.plan(T)
    except irbkin.PathError as error:
        last = max(error.reasons, key=lambda end: end.pose_index)
        print(f"fixed torch: no plan reaches pose {error.index}: {last.reason}")
    show("free torch", robot.plan(T, rotation=36))

    T[120, 2, 3] += 2.0
    try:
        robot.plan(T, rotation=36)
    except irbkin.PathError as error:
        gap = error.plan.breaks[0]
        print(f"pose {error.index} moved away: leave at {gap.leave}, enter at {gap.enter}")


if __name__ == "__main__":
    main()
