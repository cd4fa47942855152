"""Arms as bodies: the hulls or capsules of their links, in parallel projection."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PathCollection
from matplotlib.path import Path

from irbkin._arguments import check_robot
from irbkin._arrays import as_array
from irbkin.errors import InvalidJointsError
from irbkin.plot._style import AXIS_COLORS, arrow, canvas, title, whole
from irbkin.scene import Arm, LinkShape, arm_of
from irbkin.scene._arms import link_frames, rest, solids
from irbkin.scene._look import on_paper
from irbkin.scene._strokes import pieces

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.plot._style import Canvas

GHOST = "#b9c0ca"
"""The color of faint arms."""
SIDES = np.vstack([-np.eye(3), np.eye(3)])
ARROW = 0.12
"""Length of the axes of the tool, in parts of the picture."""


def arm(
    robot: Robot,
    q: npt.ArrayLike | None = None,
    *,
    frames: bool = True,
    capsules: bool = False,
    figure: Canvas | None = None,
) -> Figure:
    """Draw an arm as its body, with the frame of its tool: x red, y green, z blue.

    The body is the hulls of the arm's links, or the capsules of those without. They contain its
    public meshes or, of most arms, are made of the lengths of its kinematic table: then the title
    says so.

    Args:
        robot: The arm, with its tool, base and body.
        q: Joint angles [rad], shape (n,) or (k, n): the last is drawn, those before it faintly. At
            rest when not given.
        frames: Whether the frame of the tool is drawn.
        capsules: Whether all links are drawn as capsules, which cells compare first.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: one panel without axes, at one scale.

    Raises:
        InvalidJointsError: `q` has a wrong shape or is not finite.
        TypeError: `robot` is not a Robot.
    """
    check_robot(robot)
    angles = np.atleast_2d(rest(robot) if q is None else np.asarray(q, dtype=float))
    angles = as_array(angles, "q", (None, robot.dof), InvalidJointsError)
    robot.fk(angles[-1])
    if not np.isfinite(angles).all():
        raise InvalidJointsError("q has joint angles that are not finite")
    own = arm_of(robot)
    drawn = canvas(figure, 4.6, 4.6)
    axes = drawn.subplots()
    for ghost in angles[:-1]:
        draw_body(axes, own, ghost, capsules, is_ghost=True)
    draw_body(axes, own, angles[-1], capsules)
    points = np.concatenate([corners(own, it) for it in angles])
    extent(axes, points, drawn)
    if frames:
        size = float(np.ptp(on_paper(points), axis=0).max())
        draw_frame(axes, robot.fk(angles[-1]), ARROW * size)
    title(axes, robot, "approximate body" if own.is_approximate else "")
    return whole(drawn)


def corners(own: Arm, q: npt.ArrayLike) -> Floats:
    """Return points around an arm, for the extent of a picture, shape (k, 3)."""
    frames = link_frames(own, q)
    points = [frames[0, :3, 3], frames[-1, :3, 3]]
    for it in solids(own):
        frame = frames[min(it.link, len(own.joints))]
        ends = np.array([it.a, it.b] if isinstance(it, LinkShape) else it.points)
        placed = ends @ frame[:3, :3].T + frame[:3, 3]
        points += [end + it.radius * side for end in placed for side in SIDES]
    return np.array(points)


def extent(axes: Axes, points: Floats, drawn: Canvas) -> None:
    """Show points at one scale, without axes."""
    paper = on_paper(points)
    low, high = paper.min(axis=0), paper.max(axis=0)
    room = 0.04 * float((high - low).max())
    axes.set(aspect="equal", xlim=(low[0] - room, high[0] + room), xticks=[], yticks=[])
    axes.set(ylim=(low[1] - room, high[1] + room))
    axes.set_frame_on(False)


def draw_body(
    axes: Axes, own: Arm, q: npt.ArrayLike, capsules: bool = False, *, is_ghost: bool = False
) -> list[Any]:
    """Draw the body of an arm, far parts first; return what was added to the axes."""
    paths, colors = [], []
    for some, color in pieces(own, q, capsules=capsules, color=GHOST if is_ghost else ""):
        closed = [Path(np.vstack([it, it[:1]]), closed=True) for it in some]
        paths.append(Path.make_compound_path(*closed))
        colors.append(color)
    look = {"edgecolors": "#8d96a3", "alpha": 0.35} if is_ghost else {"edgecolors": colors}
    added = PathCollection(paths, facecolors=colors, linewidths=0.3, **look)
    axes.add_collection(added)
    return [added]


def draw_frame(axes: Axes, pose: Floats, length: float) -> list[Any]:
    """Draw the axes of a frame as arrows; return what was added to the axes."""
    ends = (pose[:3, 3] + np.outer([0.0, length], pose[:3, column]) for column in range(3))
    pairs = zip(ends, AXIS_COLORS, strict=True)
    return [arrow(axes, on_paper(it), color, 1.8) for it, color in pairs]
