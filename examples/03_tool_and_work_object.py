"""A target taught in a work object, for a tool, as in a robot program."""

import irbkin
import numpy as np
import numpy.typing as npt

HOME = np.radians([0, 0, 0, 0, 30, 0])


def show(what: str, q: npt.NDArray[np.float64]) -> None:
    print(f"{what:26} " + " ".join(f"{np.degrees(angle):7.2f}" for angle in q))


def main() -> None:
    arm = irbkin.Robot("IRB 2600-12/1.65")
    # A gripper whose center point is 180 mm in front of the flange and tilted by 30 deg.
    t_flange_tool = irbkin.pose([0.040, 0, 0.180], euler_zyx=np.radians([0, 30, 0]))
    # A pallet rotated by 15 deg, and a part on it.
    t_base_pallet = irbkin.pose([0.700, -0.500, 0.350], euler_zyx=np.radians([15, 0, 0]))
    t_pallet_target = irbkin.pose([0.200, 0.150, 0.060], wxyz=[0, 0, 1, 0])

    # Frames cancel from left to right; poses of a robot with a tool are poses of the tool's center
    # point.
    gripper = arm.with_tool(t_flange_tool)
    q = gripper.ik_nearest(t_base_pallet @ t_pallet_target, HOME)
    show("through the pallet", q)

    # Or once for all: the base relative to the pallet. Then targets are used as taught.
    on_pallet = gripper.with_base(np.linalg.inv(t_base_pallet))
    show("with_base", on_pallet.ik_nearest(t_pallet_target, HOME))

    # Forward kinematics returns poses in the frame of the pallet, too.
    xyz, _ = irbkin.to_xyz_wxyz(on_pallet.fk(q))
    print("tool in the pallet's frame  " + " ".join(f"{1e3 * v:.1f}" for v in xyz) + " mm")
    print(f"flange in the base          {1e3 * arm.fk(q)[2, 3]:.1f} mm above the floor\n")

    # The pallet was measured again: the program stays, the joints change.
    t_base_pallet = irbkin.pose([0.712, -0.488, 0.351], euler_zyx=np.radians([16.5, 0, 0]))
    moved = gripper.with_base(np.linalg.inv(t_base_pallet))
    show("pallet moved", moved.ik_nearest(t_pallet_target, q))

    # Robots are immutable: with_ returns a new one. Robots compare by value.
    equal = arm.with_tool(t_flange_tool) == gripper
    print(f"\nthe same tool on the same arm is an equal robot: {'yes' if equal else 'no'}")


if __name__ == "__main__":
    main()
