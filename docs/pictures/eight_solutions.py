"""Make the picture of the README: the eight solutions of one pose of an IRB 2600, as skeletons.

Run without arguments: it writes eight_solutions.svg next to itself and prints its name. It needs
matplotlib. The same irbkin and matplotlib give the same file.
"""

from pathlib import Path

import irbkin
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from singularities import STYLE
from slots import joints

Floats = NDArray[np.float64]

HERE = Path(__file__).parent
# Okabe and Ito's colors, which color-blind readers can tell apart.
BASE, UPPER, FOREARM, HAND, AXIS_5, GHOST = (
    "#555555",
    "#0072b2",
    "#e69f00",
    "#000000",
    "#d55e00",
    "#dcdcdc",
)
FACING = ("facing the target", "reaching over backward")
ELBOW = ("elbow up", "elbow down")
ARROW = 0.45  # length of the arrow along axis 5 [m]
FOOT = 0.22  # radius of the base [m]
# Seen from the front on the right, from above, in parallel projection.
AZIMUTH, ELEVATION = np.radians([-29.0, 20.0])
SIDEWAYS = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
UPWARD = np.array(
    [
        -np.sin(ELEVATION) * np.cos(AZIMUTH),
        -np.sin(ELEVATION) * np.sin(AZIMUTH),
        np.cos(ELEVATION),
    ]
)


def on_paper(points: Floats) -> Floats:
    """Project points of the base frame, shape (..., 3), to the paper, (..., 2)."""
    drawn: Floats = points @ np.column_stack([SIDEWAYS, UPWARD])
    return drawn


def stroke(axes: Axes, points: Floats, color: str, width: float = 4.0, order: float = 2.0) -> None:
    """A polyline of points of the base frame."""
    axes.plot(
        *on_paper(points).T,
        color=color,
        linewidth=width,
        solid_joinstyle="round",
        solid_capstyle="round",
        zorder=order,
    )


def draw(axes: Axes, robot: irbkin.Robot, solution: irbkin.Solution, others: list[Floats]) -> None:
    """One solution in front of the seven others in gray."""
    for other in others:
        stroke(axes, joints(robot, other), GHOST, 2.5, 1.0)
    frames = robot.link_frames(solution.q)
    shoulder, elbow, wrist, tool = (frames[i, :3, 3] for i in (1, 2, 4, 6))
    corner = elbow + robot.mdh[3, 1] * frames[2, :3, 0]
    turn = np.linspace(0, 2 * np.pi, 61)
    disc = on_paper(FOOT * np.column_stack([np.cos(turn), np.sin(turn), 0 * turn]))
    axes.fill(*disc.T, color="#c8c8c8", zorder=1.5)
    stroke(axes, np.array([[0, 0, 0], [0, 0, shoulder[2]], shoulder]), BASE, 6.0)
    stroke(axes, np.array([shoulder, elbow]), UPPER)
    stroke(axes, np.array([elbow, corner, wrist]), FOREARM)
    stroke(axes, np.array([wrist, tool]), HAND, 3.0)
    for joint in (shoulder, elbow, wrist):
        axes.plot(
            *on_paper(joint),
            marker="o",
            markersize=6,
            color="white",
            markeredgecolor="#333333",
            zorder=3,
        )
    tail, head = on_paper(np.array([wrist, wrist + ARROW * frames[4, :3, 2]]))
    arrow = {"arrowstyle": "-|>", "color": AXIS_5, "linewidth": 1.6, "shrinkA": 3, "shrinkB": 0}
    axes.annotate("", head, tail, arrowprops=arrow, zorder=4)
    axes.set(aspect="equal", xlim=(-0.42, 1.08), ylim=(-0.33, 1.2))
    axes.axis("off")


def title(axes: Axes, robot: irbkin.Robot, solution: irbkin.Solution) -> None:
    """The slot and its meaning, then the joint angles and the limits that they exceed."""
    lower, upper = robot.limits.T
    beyond = [
        f"J{joint + 1}"
        for joint in range(6)
        if not lower[joint] <= solution.q[joint] <= upper[joint]
    ]
    slot = int(solution.slot)
    axes.set_title(
        f"slot {slot}: {ELBOW[bool(slot & 2) != bool(slot & 4)]}, J5 {'<' if slot & 1 else '>'} 0\n"
        f"{FACING[bool(slot & 4)]}",
        fontsize=9,
    )
    angles = " ".join(f"{angle:.0f}" for angle in np.degrees(solution.q))
    limits = "outside limits: " + ", ".join(beyond) if beyond else "inside limits"
    axes.text(
        0.5,
        -0.02,
        f"{angles} deg\n{limits}",
        transform=axes.transAxes,
        ha="center",
        va="top",
        fontsize=8,
        color="#666666" if beyond else "#000000",
    )


def main() -> None:
    """Write the picture."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
    solutions = robot.ik(T)
    with mpl.rc_context(STYLE):
        figure, grid = plt.subplots(2, 4, figsize=(9, 6.3), sharex=True, sharey=True)
        for solution, axes in zip(solutions, grid.flat, strict=True):
            others = [other.q for other in solutions if other.slot != solution.slot]
            draw(axes, robot, solution, others)
            title(axes, robot, solution)
        figure.subplots_adjust(0.01, 0.13, 0.99, 0.93, 0.05, 0.52)
        parts = [
            Line2D([], [], color=color, linewidth=width, label=label)
            for color, width, label in (
                (BASE, 6.0, "base"),
                (UPPER, 4.0, "upper arm"),
                (FOREARM, 4.0, "forearm"),
                (HAND, 3.0, "wrist to flange"),
                (AXIS_5, 1.6, "axis 5"),
                (GHOST, 2.5, "the other solutions"),
            )
        ]
        figure.legend(handles=parts, loc="lower center", ncols=6, frameon=False, fontsize=8)
        figure.savefig(HERE / "eight_solutions.svg", metadata={"Date": None, "Creator": None})
        plt.close(figure)
    print(HERE / "eight_solutions.svg")


if __name__ == "__main__":
    main()
