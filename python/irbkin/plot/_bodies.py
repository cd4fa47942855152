"""Arms as bodies: the capsules of their links, in parallel projection."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection

from irbkin._arguments import check_robot
from irbkin._arrays import as_array
from irbkin.errors import InvalidJointsError
from irbkin.plot._style import AXIS_COLORS, canvas, title, whole
from irbkin.scene import Arm, arm_of
from irbkin.scene._arms import capsules_at, link_frames, rest
from irbkin.scene._look import link_color, nearness, on_paper

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.plot._style import Canvas

CARRIED, GHOST = "#6f7a88", "#b9c0ca"
"""Colors of what the flange carries, and of faint arms."""
LIGHT = np.array([-0.25, 0.35])
"""Where the light comes from on the paper, in parts of a capsule's radius."""
TONES = ((1.0, -0.16), (0.82, 0.0), (0.5, 0.18))
"""Layers of a capsule: part of its radius, and how much lighter than its color."""
CAP = 13
"""Corners of a round end."""
SIDES = np.vstack([-np.eye(3), np.eye(3)])
ARROW = 0.12
"""Length of the axes of the tool, in parts of the picture."""


def arm(
    robot: Robot,
    q: npt.ArrayLike | None = None,
    *,
    frames: bool = True,
    figure: Canvas | None = None,
) -> Figure:
    """Draw an arm as its body, with the frame of its tool: x red, y green, z blue.

    The body is the arm's capsules. They contain its public meshes or, of most arms, are made of the
    lengths of its kinematic table: then the title says so.

    Args:
        robot: The arm, with its tool, base and body.
        q: Joint angles [rad], shape (n,) or (k, n): the last is drawn, those before it faintly. At
            rest when not given.
        frames: Whether the frame of the tool is drawn.
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
        draw_body(axes, own, ghost, is_ghost=True)
    draw_body(axes, own, angles[-1])
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
    for it, ends in capsules_at(own, q):
        points += [end + it.radius * side for end in ends for side in SIDES]
    return np.array(points)


def extent(axes: Axes, points: Floats, drawn: Canvas) -> None:
    """Show points at one scale, without axes."""
    paper = on_paper(points)
    low, high = paper.min(axis=0), paper.max(axis=0)
    room = 0.04 * float((high - low).max())
    axes.set(aspect="equal", xlim=(low[0] - room, high[0] + room), xticks=[], yticks=[])
    axes.set(ylim=(low[1] - room, high[1] + room))
    axes.set_frame_on(False)


def draw_body(axes: Axes, own: Arm, q: npt.ArrayLike, *, is_ghost: bool = False) -> list[Any]:
    """Draw the capsules of an arm, far ones first; return what was added to the axes."""
    shapes = []
    for it, ends in capsules_at(own, q):
        color = CARRIED if it.link > len(own.joints) else link_color(it.link)
        shapes.append((float(nearness(ends).mean()), on_paper(ends), it.radius, color))
    shapes.sort(key=lambda shape: shape[0])
    polygons, colors = [], []
    for _, ends, radius, color in shapes:
        for part, lighter in ((1.0, 0.0),) if is_ghost else TONES:
            polygons.append(_stadium(ends + (1.0 - part) * radius * LIGHT, part * radius))
            colors.append(GHOST if is_ghost else _toned(color, lighter))
    look = {"edgecolors": "#8d96a3", "alpha": 0.35} if is_ghost else {"edgecolors": "none"}
    added = PolyCollection(polygons, facecolors=colors, linewidths=0.3, **look)
    axes.add_collection(added)
    return [added]


def draw_frame(axes: Axes, pose: Floats, length: float) -> list[Any]:
    """Draw the axes of a frame as arrows; return what was added to the axes."""
    added = []
    for column, color in enumerate(AXIS_COLORS):
        tail, head = on_paper(np.array([pose[:3, 3], pose[:3, 3] + length * pose[:3, column]]))
        look = {"arrowstyle": "-|>", "color": color, "linewidth": 1.8, "shrinkA": 0, "shrinkB": 0}
        added.append(
            axes.annotate("", (head[0], head[1]), (tail[0], tail[1]), arrowprops=look, zorder=4)
        )
    return added


def _stadium(ends: Floats, radius: float) -> Floats:
    """The outline of a capsule on the paper, shape (k, 2)."""
    along = ends[1] - ends[0]
    turn = np.arctan2(along[1], along[0]) if np.hypot(*along) > 0.0 else 0.0
    angles = turn + np.linspace(-np.pi / 2, np.pi / 2, CAP)
    cap = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    outline: Floats = np.vstack([ends[1] + cap, ends[0] - cap])
    return outline


def _toned(color: str, lighter: float) -> tuple[float, ...]:
    """A color mixed with white, or with black if it is to be darker."""
    own = np.array([int(color[begin : begin + 2], 16) / 255 for begin in (1, 3, 5)])
    mixed: Sequence[float] = ((1 - abs(lighter)) * own + max(lighter, 0.0)).tolist()
    return tuple(mixed)
