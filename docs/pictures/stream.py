"""Draw an hour of a guard, compressed: for each half minute the least and the greatest reference,
set point, velocity and acceleration of a joint, between their bounds.

Run without arguments. It needs `irbkin[plot]`.
"""

import irbkin
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from drawing import STYLE, save
from irbkin.stream import Guard
from numpy.typing import NDArray

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
START = np.array([0.0, 0.0, 0.0, 0.0, 0.5, 0.0])
BOUNDS = {"max_velocity": 1.8, "max_acceleration": 8.0, "max_jerk": 60.0}
CYCLE, HOUR, PART = 0.004, 3600.0, 30.0
JOINT = 1
COLORS = {"reference": "#c8c8c8", "set point": "#1f6fb4"}


def hour() -> NDArray[np.float64]:
    """Reference, angle, velocity and acceleration of a joint in each cycle: the goal jumps a few
    times a minute, noise is added to it, one packet in ten is lost.
    """
    rng = np.random.default_rng(60)
    guard = Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **BOUNDS)
    low, high = np.clip(ROBOT.limits * 0.6, -1.5, 1.5).T
    rows, goal = [], START
    for _ in range(int(HOUR / CYCLE)):
        if rng.random() < CYCLE / 12.0:
            goal = rng.uniform(low, high)
        reference = goal + rng.normal(0.0, 1e-3, 6)
        step = guard.step(None if rng.random() < 0.1 else reference)
        rows.append([reference[JOINT], step.q[JOINT], step.dq[JOINT], step.ddq[JOINT]])
    return np.array(rows)


def main() -> None:
    """Draw the picture."""
    rows = hour().reshape(int(HOUR / PART), -1, 4)
    low, high = rows.min(axis=1), rows.max(axis=1)
    minutes = (np.arange(len(low)) + 0.5) * PART / 60.0
    bounds = [ROBOT.limits[JOINT], BOUNDS["max_velocity"], BOUNDS["max_acceleration"]]
    names = ["J2 [rad]", "velocity [rad/s]", "acceleration [rad/s²]"]
    with mpl.rc_context(STYLE):
        figure, axes = plt.subplots(3, sharex=True, figsize=(7, 5), layout="constrained")
        for axis, column, bound, name in zip(axes, (1, 2, 3), bounds, names, strict=True):
            if column == 1:
                axis.fill_between(
                    minutes, low[:, 0], high[:, 0], color=COLORS["reference"], label="reference"
                )
            axis.fill_between(
                minutes,
                low[:, column],
                high[:, column],
                color=COLORS["set point"],
                alpha=0.7,
                label="set point",
            )
            for value in np.ravel([bound, -bound] if column > 1 else bound):
                axis.axhline(value, color="#333333", linewidth=0.8)
            axis.set_ylabel(name)
        axes[0].legend(loc="upper right")
        axes[-1].set_xlabel("minutes")
        save(figure, "stream_hour")


if __name__ == "__main__":
    main()
