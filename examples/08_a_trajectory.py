"""A quintic between two joint vectors of an IRB 2600, by duration and by limits."""

import irbkin
import numpy as np
from irbkin import trajectory

# Joint angles of the controller [deg]; as angles of a Denavit-Hartenberg table, J2 is less by 90
# and J6 by 180.
START = np.radians([0, 0, 0, 0, 90, 0])
END = np.radians([90, -10, 40, 10, 60, 60])
ACCELERATION = np.radians(500)  # of each joint: no catalog has it


def row(label: str, angles: list[float]) -> str:
    return f"{label:>12} " + " ".join(f"{np.degrees(angle):8.2f}" for angle in angles)


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65")
    move = trajectory.joint(START, END, steps=50, duration=1.0)
    print(f"{len(move)} samples over {move.duration:.3f} s, in degrees\n")
    print("       t [s]       J1       J2       J3       J4       J5       J6")
    for index in range(0, 50, 7):
        print(row(f"{move.t[index]:.3f}", move.q[index].tolist()))

    peaks = move.peaks()
    assert robot.max_velocity is not None
    print("\nthe largest velocity and acceleration, between samples too, per second")
    print(row("velocity", peaks.velocity.tolist()))
    print(row("catalog's", robot.max_velocity.tolist()))
    print(row("acceleration", peaks.acceleration.tolist()))

    # The same way as fast as the limits allow.
    fast = trajectory.joint(
        START, END, max_velocity=robot.max_velocity, max_acceleration=ACCELERATION
    )
    used = fast.peaks().acceleration / ACCELERATION
    print(f"\nwithin the catalog's velocities and 500 deg/s^2: {fast.duration:.3f} s")
    print(f"J{np.argmax(used) + 1} uses {100 * used.max():.1f} % of its acceleration")

    # The middle of the motion, exactly; nothing jumps at the ends.
    middle = move.sample(0.5)
    print(row("at 0.5 s", middle.q.tolist()))
    assert np.abs([move.dq[[0, -1]], move.ddq[[0, -1]]]).max() < 1e-12


if __name__ == "__main__":
    main()
