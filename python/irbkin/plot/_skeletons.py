"""The solutions of a pose as skeletons, in parallel projection."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from irbkin._arguments import check_robot
from irbkin.errors import UnreachableError
from irbkin.plot._style import BLACK, BLUE, ORANGE, VERMILION, arrow, canvas, whole
from irbkin.scene._look import on_paper

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from irbkin import Robot, Solution
    from irbkin._arrays import Floats
    from irbkin.plot._style import Canvas

# Which link frames are shoulder, elbow and wrist.
JOINTS = {
    "spherical wrist": (1, 2, 4),
    "three parallel axes": (1, 2, 3),
    "spherical shoulder": (1, 3, 5),
}
OTHERS = {6: (1, 2, 4), 7: (1, 3, 5)}
"""Of other structures, by the number of joints."""
PARTS = (
    ("base", "#555555", 6.0),
    ("upper arm", BLUE, 4.0),
    ("forearm", ORANGE, 4.0),
    ("wrist to tool", BLACK, 3.0),
)
GHOST, GHOST_WIDTH = "#dcdcdc", 2.5
# Parts of the size of the arm: the arrow along axis 5, and the radius of the base.
ARROW, FOOT = 0.3, 0.13
COLUMNS = 4
# Width of a panel, height of the words above and below it, and of the legend [inch].
WIDTH, ABOVE, BELOW, LEGEND = 2.25, 0.45, 0.42, 0.3


@dataclass(frozen=True, slots=True)
class Skeleton:
    """The lines of an arm in space."""

    parts: list[Floats]
    """Base, upper arm, forearm, and wrist to tool: polylines, shape (k, 3)."""
    axis_5: Floats
    """Where axis 5 is, and its direction, shape (2, 3)."""

    @classmethod
    def of(cls, robot: Robot, q: npt.ArrayLike) -> Skeleton:
        """The skeleton of an arm at joint angles [rad]."""
        frames = robot.link_frames(q)
        # Between two frames a link goes along x of the first, then along z of the second.
        links = [np.array([robot.base[:3, 3], frames[0, :3, 3]])]
        for before, frame, row in zip(frames[:-2], frames[1:-1], robot.mdh[1:], strict=True):
            corner = before[:3, 3] + row[1] * before[:3, 0]
            links.append(np.array([before[:3, 3], corner, frame[:3, 3]]))
        links.append(frames[-2:, :3, 3])
        places = JOINTS.get(robot.structure or "", OTHERS[robot.dof])
        shoulder, elbow, wrist = (joint + 1 for joint in places)
        parts = [links[:shoulder], links[shoulder:elbow], links[elbow:wrist], links[wrist:]]
        return cls([np.vstack(part) for part in parts], frames[4, :3, [3, 2]])

    def points(self) -> Floats:
        """All points, shape (k, 3)."""
        return np.vstack(self.parts)


def solutions(
    robot: Robot, T: npt.ArrayLike, *, q7: float | None = None, figure: Canvas | None = None
) -> Figure:
    """Draw every solution of a pose as a skeleton, each in front of the others in gray.

    Under each are its joint angles and the joints that are outside their limits. The arrow is axis
    5 of a six-axis arm, whose sense tells the two wrists apart.

    Args:
        robot: The arm.
        T: Pose of the tool, shape (4, 4).
        q7: Angle of joint 7 of a seven-axis arm [rad], as `Robot.ik` takes it.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: one panel for each solution, in the order of the slots, titled by its slot.
        Joint angles are in deg.

    Raises:
        UnreachableError: The pose has no solution; the message has the reason.
        InvalidPoseError: `T` is not a pose.
        TypeError: `robot` is not a Robot.
    """
    check_robot(robot)
    found = robot.ik(T) if q7 is None else robot.ik(T, q7=q7)
    if not len(found):
        raise UnreachableError(f"T has no solution to draw: {found.explain()}")
    skeletons = [Skeleton.of(robot, solution.q) for solution in found]
    columns = min(COLUMNS, len(found))
    rows = -(-len(found) // columns)
    points = np.vstack([skeleton.points() for skeleton in skeletons])
    size = float(np.ptp(points, axis=0).max())
    has_axis_5 = robot.dof == 6
    foot = _foot(robot, FOOT * size)
    heads = [s.axis_5[0] + ARROW * size * s.axis_5[1] for s in skeletons if has_axis_5]
    corners = on_paper(np.vstack([points, foot, *heads]))
    low, high = corners.min(axis=0) - 0.04 * size, corners.max(axis=0) + 0.04 * size
    panel = WIDTH * (high - low)[1] / (high - low)[0] + ABOVE + BELOW
    drawn = canvas(figure, WIDTH * max(columns, 3), panel * rows + LEGEND, layout=None)
    panels = _panels(drawn, len(found), columns)
    for index, (solution, axes) in enumerate(zip(found, panels, strict=True)):
        for other in skeletons[:index] + skeletons[index + 1 :]:
            _stroke(axes, other.points(), GHOST, GHOST_WIDTH, 1.0)
        axes.fill(*on_paper(foot).T, color="#c8c8c8", zorder=1.5)
        _draw(axes, skeletons[index])
        if has_axis_5:
            _arrow(axes, skeletons[index], ARROW * size)
        axes.set(aspect="equal", xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        axes.set(xticks=[], yticks=[])
        axes.set_frame_on(False)
        axes.set_title(f"slot {solution.slot}", fontsize=9)
        _angles(axes, robot, solution)
    _legend(drawn, has_axis_5)
    drawn.text(0.01, 0.005, robot.name or f"{robot.dof} joints", fontsize=8, va="bottom")
    return whole(drawn)


def _panels(drawn: Canvas, count: int, columns: int) -> list[Axes]:
    """Axes of one size, and so arms of one scale, with room for the words; no layout moves them."""
    above, below, legend = np.array([ABOVE, BELOW, LEGEND]) / (drawn.bbox.height / drawn.dpi)
    width, height = 1.0 / columns, (1.0 - legend) / -(-count // columns)
    room = max(height - above - below, 0.2 * height)
    places = [divmod(index, columns) for index in range(count)]
    corners = [((column + 0.02) * width, 1 - (row + 1) * height + below) for row, column in places]
    return [drawn.add_axes((*corner, 0.96 * width, room)) for corner in corners]


def _foot(robot: Robot, radius: float) -> Floats:
    """The edge of the base, shape (k, 3)."""
    turn = np.linspace(0, 2 * np.pi, 61)
    disc = radius * np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    placed: Floats = disc @ robot.base[:3, :3].T + robot.base[:3, 3]
    return placed


def _stroke(axes: Axes, points: Floats, color: str, width: float, order: float) -> None:
    """A polyline of points of the base frame."""
    look: Any = {"color": color, "linewidth": width, "zorder": order}
    axes.plot(*on_paper(points).T, solid_joinstyle="round", solid_capstyle="round", **look)


def _draw(axes: Axes, skeleton: Skeleton) -> None:
    """One arm, with a ring at shoulder, elbow and wrist."""
    for points, (_, color, width) in zip(skeleton.parts, PARTS, strict=True):
        _stroke(axes, points, color, width, 2.0)
    joints = on_paper(np.array([points[0] for points in skeleton.parts[1:]]))
    ring: dict[str, Any] = {"color": "white", "markeredgecolor": "#333333", "markersize": 6}
    axes.plot(*joints.T, linestyle="none", marker="o", zorder=3, **ring)


def _arrow(axes: Axes, skeleton: Skeleton, length: float) -> None:
    """An arrow along axis 5."""
    place, direction = skeleton.axis_5
    ends = place + np.outer([0.0, length], direction)
    arrow(axes, on_paper(ends), VERMILION, 1.6, room=3.0)


def _angles(axes: Axes, robot: Robot, solution: Solution) -> None:
    """The joint angles, and the limits that they exceed."""
    lower, upper = robot.limits.T
    outside = [
        f"J{joint + 1}" for joint in np.flatnonzero((solution.q < lower) | (solution.q > upper))
    ]
    angles = " ".join(f"{angle:.0f}" for angle in solution.q_deg)
    words = f"outside limits: {', '.join(outside)}" if outside else "inside limits"
    color = "#666666" if outside else BLACK
    axes.set_xlabel(f"{angles} deg\n{words}", fontsize=8, color=color)


def _legend(drawn: Canvas, has_axis_5: bool) -> None:
    """The legend of the colors."""
    rows = [*PARTS, *[("axis 5", VERMILION, 1.6)] * has_axis_5, ("other solutions", GHOST, 2.5)]
    lines = [
        Line2D([], [], color=color, linewidth=width, label=name) for name, color, width in rows
    ]
    drawn.legend(handles=lines, loc="lower center", ncols=len(lines), frameon=False, fontsize=8)
