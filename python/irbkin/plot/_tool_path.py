"""The path of a tool in space."""

from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from irbkin._arrays import Floats, as_array, evenly
from irbkin.errors import InvalidPoseError
from irbkin.plot._style import BLACK, FONT, Canvas, canvas, legend, whole

# x, y and z of a frame: a color and dashes each.
AXES: tuple[tuple[str, str, Any], ...] = (
    ("tool x", "#d62728", "-"),
    ("tool y", "#2ca02c", "--"),
    ("tool z", "#1f77b4", ":"),
)
# Parts of the longest extent: the arrows of a frame, and the least extent of an axis that is shown.
FRAME, LEAST = 0.12, 0.3
# Between tick labels and the label of an axis [pt].
PAD = 9


def path(poses: npt.ArrayLike, *, frames: int = 6, figure: Canvas | None = None) -> Figure:
    """Draw the path of the tool in space, with the frame of the tool at some poses.

    Args:
        poses: Poses of the tool, shape (m, 4, 4), of `irbkin.paths` or `robot.fk(q)`. Where a pose
            is NaN, the line has a gap.
        frames: How many poses show their frame, evenly over the indices; 0 for none.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: one 3-D panel, its axes in m at one scale.

    Raises:
        InvalidPoseError: `poses` has a wrong shape, or no pose without NaN.
        ValueError: `frames` is negative.
    """
    rows = as_array(poses, "poses", (None, 4, 4), InvalidPoseError)
    if frames < 0:
        raise ValueError(f"frames is {frames}, it must be at least 0")
    known = rows[np.isfinite(rows).all(axis=(1, 2))]
    if not len(known):
        raise InvalidPoseError("poses has no pose without NaN or infinity")
    drawn = canvas(figure, 5.6, 4.6)
    # matplotlib has no types of 3-D axes.
    axes: Any = drawn.add_subplot(projection="3d")
    points = rows[:, :3, 3]
    axes.plot(*points.T, color=BLACK, linewidth=1.6, label="path of the tool")
    start = known[0, :3, 3]
    axes.plot(*start[:, None], color=BLACK, marker="o", linestyle="none", label="start")
    size = float(np.ptp(known[:, :3, 3], axis=0).max()) or 0.1
    shown = known[evenly(len(known), frames)]
    for column, (name, color, dashes) in enumerate(AXES if frames else ()):
        ends = shown[:, :3, 3] + FRAME * size * shown[:, :3, column]
        for index, (tail, head) in enumerate(zip(shown[:, :3, 3], ends, strict=True)):
            line = np.array([tail, head]).T
            look = {"color": color, "linestyle": dashes, "linewidth": 1.5}
            axes.plot(*line, label=None if index else name, **look)
    _view(axes, known[:, :3, 3], size)
    legend(drawn, axes, 5, FONT - 1)
    return whole(drawn)


def _view(axes: Any, points: Floats, size: float) -> None:
    """One scale for all axes, none of them flat, the frames inside."""
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    half = 0.5 * np.maximum(np.ptp(points, axis=0), LEAST * size) + FRAME * size
    axes.set(
        **{f"{name}lim": (m - h, m + h) for name, m, h in zip("xyz", middle, half, strict=True)}
    )
    axes.set_box_aspect(tuple(half / half.max()))
    for name, axis in zip("xyz", (axes.xaxis, axes.yaxis, axes.zaxis), strict=True):
        axis.set_label_text(f"{name} [m]", fontsize=FONT)
        axis.labelpad = PAD
        axis.set_tick_params(labelsize=FONT - 1)
        # Few ticks: the sides of a box are short on paper.
        axis.set_major_locator(MaxNLocator(4))
