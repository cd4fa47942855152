"""Draw the pictures of the eight slots: the solutions of one pose of an IRB 2600 and of a UR3.

Run without arguments: it writes the SVG files next to itself and prints their names. The same
irbkin and matplotlib give the same files.
"""

from pathlib import Path

import irbkin
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from singularities import STYLE

Floats = NDArray[np.float64]

HERE = Path(__file__).parent
# Seen from above on the left: the directions of base x, y and z on paper.
PAPER = np.array([[0.85, -0.2], [0.42, 0.45], [0.0, 0.9]])
ARM, AXIS, TOOL = "#0072b2", "#bbbbbb", "#d55e00"


def on_paper(points: Floats) -> Floats:
    """Project points of the base frame, shape (..., 3), in parallel projection."""
    drawn: Floats = points @ PAPER
    return drawn


def joints(robot: irbkin.Robot, q: Floats) -> Floats:
    """Return the base, the origin of every link frame with the corner before it, and the tool.

    The shape is (k, 3).
    """
    frames = robot.link_frames(q)
    points = [np.zeros(3)]
    for before, frame, row in zip(frames[:-2], frames[1:-1], robot.mdh[1:], strict=True):
        points += [before[:3, 3], before[:3, 3] + row[1] * before[:3, 0], frame[:3, 3]]
    return np.array([*points, frames[-1][:3, 3]])


def draw(axes: Axes, robot: irbkin.Robot, q: Floats, title: str) -> None:
    """Draw one arm, with the frame of its tool."""
    line = on_paper(joints(robot, q))
    axis = on_paper(np.array([[0, 0, 0], [0, 0, 0.6]]))
    axes.plot(*axis.T, color=AXIS, linestyle=":", linewidth=1)
    axes.plot(*line.T, color=ARM, linewidth=2.5, solid_joinstyle="round")
    pose = robot.fk(q)
    for direction in pose[:3, :3].T:
        axes.plot(
            *on_paper(np.array([pose[:3, 3], pose[:3, 3] + 0.08 * direction])).T,
            color=TOOL,
            linewidth=1.2,
        )
    axes.plot(*on_paper(np.zeros((1, 3))).T, marker="s", color="#555555")
    axes.set_title(title)
    axes.set_aspect("equal")
    axes.axis("off")


def picture(
    name: str,
    robot: irbkin.Robot,
    q: Floats,
    words: tuple[tuple[str, str], ...],
    title: str = "{}: ",
) -> None:
    """Write the eight slots of the pose of `q` to `name`.

    `title` takes the number of a slot; the words for its bits follow.
    """
    pose = robot.fk(q)
    slots = (robot.ik(pose) if robot.dof == 6 else robot.ik(pose, q7=float(q[6]))).q_by_slot
    figure, grid = plt.subplots(2, 4, figsize=(9, 5.2), sharex=True, sharey=True)
    for slot, (axes, arm) in enumerate(zip(grid.flat, slots, strict=True)):
        bits = [word[bool(slot & bit)] for word, bit in zip(words, (4, 2, 1), strict=True)]
        draw(axes, robot, arm, title.format(slot) + ", ".join(bits))
    figure.tight_layout()
    figure.savefig(HERE / name, metadata={"Date": None})
    plt.close(figure)
    print(HERE / name)


def main() -> None:
    """Draw both pictures."""
    mpl.rcParams.update(STYLE)
    picture(
        "slots_abb.svg",
        irbkin.Robot("IRB 2600-12/1.65"),
        np.array([0.5, -0.1, 0.35, 0.9, 1.0, 0.2]),
        (("front of 1", "behind 1"), ("front of arm", "behind arm"), ("q5 > 0", "q5 < 0")),
        "cfx {}\n",
    )
    ur3 = np.array([0.4, -1.9, 1.5, -0.6, 1.1, 0.3])
    picture(
        "slots_three_parallel.svg",
        irbkin.Robot("UR3"),
        ur3,
        (("left", "right"), ("q3 > 0", "q3 < 0"), ("q5 > 0", "q5 < 0")),
    )


if __name__ == "__main__":
    main()
