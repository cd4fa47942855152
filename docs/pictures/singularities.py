"""Draw the pictures of docs/theory/singularities.md: joint traces through singularities,
and the answers of `ik` next to them.

Run without arguments. It needs `irbkin[plot]`.
"""

from collections.abc import Callable
from itertools import pairwise

import irbkin
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from drawing import HERE, STYLE, save
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Joints = list[float]

SAMPLES = 201
PATH = np.linspace(-1, 1, SAMPLES)
COLORS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#555555")
ROBOT = irbkin.Robot("IRB 2600-12/1.65")
# Its lengths [m], named as in docs/guide/conventions.md, and J3 of the stretched arm.
A1, A2, C1, C2, C3, C4 = 0.150, -0.115, 0.445, 0.700, 0.795, 0.085
STRETCHED = float(np.arctan2(-A2, C3) - np.pi / 2)
LEANING = -0.6
# From the shoulder to the wrist center for J3 = LEANING: along the upper arm and across it [m].
ALONG = C2 - C3 * np.sin(LEANING) - A2 * np.cos(LEANING)
ACROSS = C3 * np.cos(LEANING) - A2 * np.sin(LEANING)
LENGTH = float(np.hypot(ALONG, ACROSS))


def over_the_base(x: float) -> float:
    """J2 that puts the wrist center `x` [m] before axis 1 for J3 = LEANING."""
    return float(np.arcsin((x - A1) / LENGTH) - np.arctan2(ACROSS, ALONG))


def joint_path(*joints: float | Floats) -> Floats:
    """A path of joint vectors from a number or an array for each joint."""
    return np.stack([np.broadcast_to(joint, SAMPLES) for joint in joints], axis=1)


def line(middle: Joints, along: Joints, part: Floats = PATH) -> Floats:
    """Poses of the tool on a straight line through the pose of `middle`: `part` of the way `along`
    [m].
    """
    poses = np.repeat(ROBOT.fk(middle)[None], SAMPLES, axis=0)
    poses[:, :3, 3] += np.outer(part, along)
    return poses


def summary(followed: irbkin.FollowResult) -> str:
    """Describe the largest joint step, the orientation error and the number of breaks."""
    step = np.degrees(np.abs(np.diff(followed.q, axis=0)).max())
    error = np.degrees(followed.orientation_error.max())
    orientation = "exact" if error < 1e-9 else f"within {error:.2f} deg"
    breaks = len(followed.breaks) or "no"
    return f"steps up to {step:.1f} deg, orientation {orientation}, {breaks} breaks"


def trace(axes: Axes, followed: irbkin.FollowResult, title: str) -> None:
    """Draw J1 to J6 [deg] along the path."""
    for joint, color in enumerate(COLORS):
        axes.plot(PATH, np.degrees(followed.q[:, joint]), color=color, label=f"J{joint + 1}")
    axes.set(
        title=f"{title}\n{summary(followed)}",
        xlabel="along the path",
        xlim=(-1, 1),
        xticks=[-1, -0.5, 0, 0.5, 1],
    )


def panels(count: int) -> tuple[Figure, list[Axes]]:
    """A row of panels for joint traces."""
    figure, grid = plt.subplots(
        1, count, figsize=(4.3 * count, 3.3), layout="constrained", squeeze=False
    )
    grid[0, 0].set_ylabel("joint angle [deg]")
    return figure, list(grid[0])


def save_traces(figure: Figure, axes: Axes, name: str) -> None:
    """Name the six joints once for all panels and write the picture."""
    figure.legend(
        *axes.get_legend_handles_labels(), loc="outside lower center", ncols=6, frameon=False
    )
    save(figure, name)


def wrist() -> None:
    """J5 through 0 with J4 moving, and a line past J5 = 0 by 2e-3 rad in two singularity modes."""
    figure, axes = panels(3)
    made = joint_path(0.3 * PATH, 0.2, 0.1, 0.7 + 0.4 * PATH, 0.5 * PATH, -0.4)
    trace(axes[0], ROBOT.follow(ROBOT.fk(made), made[0]), "J5 through 0 while J4 moves")
    poses = line([0.3, 0.2, 0.1, np.pi / 2, 2e-3, 0.2], [0.0, 0.15, 0.02])
    seed = ROBOT.ik_nearest(poses[0], [0.3, 0.2, 0.1, 0.0, 0.3, 0.2])
    trace(
        axes[1],
        ROBOT.follow(poses, seed, singularity_mode="through"),
        'tool past J5 = 0 by 0.11 deg, "through"',
    )
    trace(axes[2], ROBOT.follow(poses, seed, singularity_mode="wrist"), 'the same line, "wrist"')
    axes[2].sharey(axes[1])
    save_traces(figure, axes[0], "singularities_wrist")


def shoulder() -> None:
    """The wrist center through axis 1, and a line that passes axis 1 by 5 mm."""
    figure, axes = panels(2)
    made = joint_path(
        0.4 * PATH, over_the_base(0.0) + 0.3 * PATH, LEANING, 0.3, 0.8 + 0.1 * PATH, 0.2 * PATH
    )
    trace(axes[0], ROBOT.follow(ROBOT.fk(made), made[0]), "wrist center through axis 1")
    middle = [0.0, over_the_base(0.005), LEANING, 0.3, 0.8, 0.0]
    poses = line(middle, [0.0, 0.15, 0.0])
    seed = ROBOT.ik_nearest(poses[0], [-1.5, *middle[1:]])
    trace(axes[1], ROBOT.follow(poses, seed), "wrist center past axis 1 by 5 mm")
    save_traces(figure, axes[0], "singularities_shoulder")


def elbow() -> None:
    """The arm stretched and bent again: in smooth joints, and by a tool that goes straight out to
    the edge of reach.
    """
    figure, axes = panels(2)
    made = joint_path(0.3 * PATH, 0.4, STRETCHED + 0.4 * PATH**2, 0.3, 0.8, 0.2)
    trace(axes[0], ROBOT.follow(ROBOT.fk(made), made[0]), "stretched and bent again by J3")
    outward = [0.1 * np.sin(0.4), 0.0, 0.1 * np.cos(0.4)]
    poses = line([0.0, 0.4, STRETCHED, 0.3, 0.8, 0.2], outward, -np.abs(PATH))
    seed = ROBOT.ik_nearest(poses[0], [0.0, 0.2, STRETCHED + 0.5, 0.3, 0.8, 0.2])
    trace(axes[1], ROBOT.follow(poses, seed), "tool straight out to the edge of reach and back")
    save_traces(figure, axes[0], "singularities_elbow")


BANDS = {
    "undetermined": ("#f2b8a0", "one solution for both branches, twin MERGED, free joint set to 0"),
    "free": ("#f7dfa5", "one solution, twin MERGED, free joint computed from the pose"),
    "merged": ("#bcd9ea", "one solution, twin MERGED, no joint free"),
    "both": ("#ffffff", "a solution for each branch, no flag"),
}


def band(solutions: irbkin.Solutions) -> str:
    """Return the key of `BANDS` that an answer belongs to."""
    if not any(status & irbkin.Status.MERGED for status in solutions.status):
        return "both"
    free = [
        solution[solution.free_joint.joint - 1] for solution in solutions if solution.free_joint
    ]
    if not free:
        return "merged"
    return "undetermined" if all(angle == 0.0 for angle in free) else "free"


def answers(axes: Axes, robot: irbkin.Robot, joints: Callable[[float], Joints], title: str) -> None:
    """Draw the number of solutions against the distance passed to `joints`, over the status."""

    def solve(distance: float) -> irbkin.Solutions:
        return robot.ik(robot.fk(joints(distance)))

    edges = [1e-17]
    distances = [float(distance) for distance in np.logspace(-17, -4, 131)]
    for below, above in pairwise(distances):
        if band(solve(below)) == band(solve(above)):
            continue
        low, high = below, above
        for _ in range(40):
            middle = float(np.sqrt(low * high))
            low, high = (
                (middle, high) if band(solve(middle)) == band(solve(below)) else (low, middle)
            )
        axes.text(high, 0.3, f" {high:.1e}", fontsize=8)
        edges.append(high)
    for first, last in pairwise([*edges, 1e-4]):
        inside = solve(float(np.sqrt(first * last)))
        axes.axvspan(first, last, color=BANDS[band(inside)][0], linewidth=0)
        axes.hlines(len(inside), first, last, color=COLORS[0], linewidth=2.5)
    axes.set(xscale="log", xlim=(1e-17, 1e-4), ylim=(0, 9), yticks=[0, 2, 4, 6, 8], title=title)


def branches() -> None:
    """Number of solutions and status against the distance from each singularity."""
    figure, grid = plt.subplots(
        2, 2, figsize=(8.6, 5.2), layout="constrained", sharex=True, sharey=True
    )
    # dx / dJ2 of the wrist center over the base.
    rate = float(np.sqrt(LENGTH**2 - A1**2))

    def beside_axis_1(x: float) -> Joints:
        return [0.3, over_the_base(0.0) + x / rate, LEANING, 0.5, 0.8, 0.4]

    lateral = irbkin.Robot.from_opw(
        a1=A1, a2=A2, b=0.05, c1=C1, c2=C2, c3=C3, c4=C4, offsets=[0, 0, -np.pi / 2, 0, 0, 0]
    )
    answers(grid[0, 0], ROBOT, lambda off: [0.3, 0.2, 0.1, 0.5, off, 0.4], "wrist: J5 from 0 [rad]")
    answers(
        grid[0, 1],
        ROBOT,
        lambda off: [0.3, 0.2, STRETCHED + off, 0.5, 0.8, 0.4],
        "elbow: from stretched [rad]",
    )
    answers(grid[1, 0], ROBOT, beside_axis_1, "shoulder: wrist center from axis 1 [m]")
    answers(
        grid[1, 1], lateral, beside_axis_1, "shoulder, lateral offset 50 mm: from the plane [m]"
    )
    for axes in grid[:, 0]:
        axes.set_ylabel("solutions")
    patches = [
        Patch(facecolor=color, edgecolor="#777777", label=label) for color, label in BANDS.values()
    ]
    figure.legend(handles=patches, loc="outside lower center", ncols=2, frameon=False, fontsize=8)
    save(figure, "singularities_branches", HERE)


def main() -> None:
    """Draw all pictures."""
    with mpl.rc_context(STYLE):
        for picture in (wrist, shoulder, elbow, branches):
            picture()


if __name__ == "__main__":
    main()
