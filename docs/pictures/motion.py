"""Draw the pictures of docs/guide/plot.md: a quintic, a line through the wrist singularity.

Run without arguments. It needs `irbkin[plot]`.
"""

import irbkin
import matplotlib as mpl
import numpy as np
from drawing import STYLE, save
from irbkin import paths, plot, trajectory
from numpy.typing import NDArray

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
# Joint angles of the article's example, whose zero of axes 2 and 6 is the table's.
START, END = np.radians([[0, -90, 0, 0, 90, -180], [90, -100, 40, 10, 60, -120]])


def quintic() -> None:
    """The article's example: fifty samples of a quintic, without limits."""
    save(plot.trajectory(trajectory.joint(START, END, steps=50)), "motion_quintic")


def within_limits() -> None:
    """The same way by limits of velocity, acceleration and jerk, each joint in its row."""
    start, end = START + np.radians([0, 90, 0, 0, 0, 180]), END + np.radians([0, 90, 0, 0, 0, 180])
    limits = {"max_velocity": ROBOT.max_velocity, "max_acceleration": 8.0}
    move = trajectory.joint(start, end, profile="s_curve", max_jerk=60.0, **limits)
    save(plot.trajectory(move, robot=ROBOT, max_acceleration=8.0), "motion_limits")


def through_the_wrist() -> NDArray[np.float64]:
    """The joints of a line on which J5 goes through zero in the middle."""
    middle = ROBOT.fk([0.3, 0.2, 0.1, 0.7, 0.0, -0.4])
    first, last = middle.copy(), middle.copy()
    first[:3, 3] -= [0.10, 0.25, 0.05]
    last[:3, 3] += [0.10, 0.25, 0.05]
    line = paths.line(first, last, steps=200)
    seed = ROBOT.ik_nearest(first, [0.0, 0.2, 0.1, 0.7, 0.2, -0.4])
    return ROBOT.follow(line, seed).q


def line() -> None:
    """A line of the tool through the wrist singularity: distances, joints in time."""
    q = through_the_wrist()
    assert ROBOT.max_velocity is not None
    timed = trajectory.retime(q, ROBOT.max_velocity, 8.0)
    save(plot.singularity(ROBOT, timed.q, t=timed.t), "motion_singularity")
    save(
        plot.trajectory(timed, max_velocity=ROBOT.max_velocity, max_acceleration=8.0),
        "motion_line",
    )


def main() -> None:
    """Draw all pictures."""
    with mpl.rc_context(STYLE):
        for picture in (quintic, within_limits, line):
            picture()


if __name__ == "__main__":
    main()
