"""A slice of the reach: how many solutions a tool of fixed orientation has in a plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm, ListedColormap

from irbkin._arguments import check_robot
from irbkin._arrays import as_array
from irbkin.errors import InvalidPoseError, UnreachableError
from irbkin.plot._style import BLACK, FONT, MANY, canvas, scale, whole
from irbkin.records import Status

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt
    from matplotlib.figure import Figure

    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.plot._style import Canvas

COARSE = 61


def reach(
    robot: Robot,
    orientation: npt.ArrayLike,
    *,
    azimuth: float = 0.0,
    steps: int = 161,
    q7: float | None = None,
    figure: Canvas | None = None,
) -> Figure:
    """Draw how many solutions inside the limits a tool of fixed orientation has, in a vertical
    plane through z of the frame that poses are in (the base frame of a robot without a base).

    Each cell is the exact answer of `ik_batch` at its middle, not an interpolation.

    Args:
        robot: The arm, with its tool, base and limits.
        orientation: Orientation of the tool, shape (3, 3), or (4, 4) of a pose.
        azimuth: Direction of the plane [rad], from x about z.
        steps: Number of cells across the longer side.
        q7: Angle of joint 7 of a seven-axis arm [rad].
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: the distance along `azimuth` and the height, in m.

    Raises:
        InvalidPoseError: `orientation` has a wrong shape or is not a rotation; `azimuth` is not
            finite.
        ValueError: Fewer than 2 or more than 2000 steps.
        TypeError: `robot` is not a Robot.
        UnreachableError: No cell has a solution inside the limits.
    """
    check_robot(robot)
    if not 2 <= steps <= 2000:
        raise ValueError(f"steps must be 2 to 2000, got {steps}")
    if not np.isfinite(azimuth):
        raise InvalidPoseError(f"azimuth is {azimuth}, it must be finite")
    turned = _pose(robot, orientation, q7)
    along = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])

    def counts(across: Floats, up: Floats) -> npt.NDArray[np.int64]:
        poses = np.empty((len(up), len(across), 4, 4))
        poses[...] = turned
        poses[..., :3, 3] = across[None, :, None] * along + up[:, None, None] * [0.0, 0.0, 1.0]
        batch = robot.ik_batch(poses) if q7 is None else robot.ik_batch(poses, q7)
        inside: npt.NDArray[np.int64] = ((batch.status & Status.WITHIN_LIMITS) != 0).sum(axis=-1)
        return inside

    left, right, bottom, top = _extent(robot, counts)
    cell = max(right - left, top - bottom) / steps
    # Even numbers: in a slice through axis 1 no cell is on it, where solutions merge.
    sizes = [2 * max(1, round(side / cell / 2)) for side in (right - left, top - bottom)]
    across, up = (
        low + (high - low) * (np.arange(size) + 0.5) / size
        for low, high, size in zip((left, bottom), (right, top), sizes, strict=True)
    )
    found = counts(across, up)
    drawn = canvas(figure, 5.6, 4.8)
    axes = drawn.subplots()
    most = max(int(found.max()), 1)
    colors = ListedColormap(["#ffffff", *colormaps[MANY](np.linspace(0.08, 1.0, most)).tolist()])
    norm = BoundaryNorm(np.arange(most + 2) - 0.5, most + 1)
    place: Any = {"origin": "lower", "extent": (left, right, bottom, top)}
    image = axes.imshow(found, cmap=colors, norm=norm, interpolation="none", **place)
    base = (float(robot.base[:3, 3] @ along), float(robot.base[2, 3]))
    axes.plot(*base, marker="+", markersize=10, color=BLACK, linestyle="none")
    box: Any = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
    look: Any = {"textcoords": "offset points", "va": "center", "fontsize": FONT - 1, "bbox": box}
    axes.annotate("base", base, (7, 0), **look)
    axes.grid(visible=False)
    axes.tick_params(labelsize=FONT)
    axes.set_xlabel(f"along {np.degrees(azimuth):.0f} deg [m]", fontsize=FONT)
    axes.set_ylabel("z [m]", fontsize=FONT)
    scale(drawn, axes, image, "solutions inside the limits", ticks=np.arange(most + 1))
    return whole(drawn)


def _pose(robot: Robot, orientation: npt.ArrayLike, q7: float | None) -> Floats:
    """The orientation as a pose that `ik` has accepted: a batch would only mark a wrong one."""
    shape = (4, 4) if np.shape(orientation) == (4, 4) else (3, 3)
    rotation = as_array(orientation, "orientation", shape, InvalidPoseError)
    pose = np.eye(4)
    pose[:3, :3] = rotation[:3, :3]
    try:
        robot.ik(pose) if q7 is None else robot.ik(pose, q7=q7)
    except InvalidPoseError as fault:
        raise InvalidPoseError(f"orientation: {fault}") from None
    return pose


def _extent(
    robot: Robot, counts: Callable[[Floats, Floats], npt.NDArray[np.int64]]
) -> tuple[float, float, float, float]:
    """Left, right, bottom and top of what is reached [m], found on a coarse grid."""
    lengths = np.abs(robot.mdh[:, 1:3]).sum()
    ends = [
        np.linalg.norm(end[:3, 3]) for end in (robot.base, robot._root, robot.flange, robot.tool)
    ]
    most = float(lengths + sum(ends))
    places = np.linspace(-most, most, COARSE)
    up, across = np.nonzero(counts(places, places))
    if not len(up):
        raise UnreachableError(
            "no cell has a solution inside the limits: the tool cannot have this orientation there"
        )
    margin = 1.5 * (places[1] - places[0])
    (left, right), (bottom, top) = (places[[it.min(), it.max()]] for it in (across, up))
    return left - margin, right + margin, bottom - margin, top + margin
