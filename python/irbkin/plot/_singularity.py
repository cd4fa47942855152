"""Distances from the singularities along a path of joint vectors."""

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from irbkin import Robot
from irbkin._arguments import check_robot
from irbkin._arrays import as_array
from irbkin.errors import InvalidJointsError
from irbkin.plot._style import FONT, VERMILION, Canvas, along_x, canvas, line_style, tidy, whole


def singularity(
    robot: Robot,
    q: npt.ArrayLike,
    *,
    t: npt.ArrayLike | None = None,
    figure: Canvas | None = None,
) -> Figure:
    """Draw the distances from the singularities and the manipulability along a path.

    A cross marks a joint vector that is at a singularity.

    Args:
        robot: The arm.
        q: Joint angles [rad], shape (m, n), of `robot.follow` for instance. Where a row is NaN,
            the curves have gaps.
        t: Times of the rows [s], shape (m,), of a trajectory; the index of the row if not given.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: panels, one above the other, with the distances in deg (wrist, elbow) and in mm
        (shoulder), the smallest singular value of the Jacobian, and the manipulability; the last
        two have rows in m and rad as they are. A singularity that the arm does not have is left
        out.

    Raises:
        InvalidJointsError: `q` or `t` has a wrong shape.
        TypeError: `robot` is not a Robot.
    """
    check_robot(robot)
    rows = as_array(q, "q", (None, robot.dof), InvalidJointsError)
    along = np.arange(len(rows), dtype=np.float64)
    if t is not None:
        along = as_array(t, "t", (len(rows),), InvalidJointsError)
    at = robot.singularity(rows)
    curves = {
        "wrist [deg]": np.degrees(at.wrist),
        "elbow [deg]": np.degrees(at.elbow),
        "shoulder [mm]": 1e3 * np.asarray(at.shoulder),
        "smallest singular\nvalue [m or 1]": np.asarray(at.min_singular_value),
        "manipulability\n[m³]": np.asarray(at.manipulability),
    }
    # The singularities that an arm does not have are NaN everywhere.
    curves = {label: curve for label, curve in curves.items() if not np.isnan(curve).all()}
    is_singular = np.asarray(at.kinds) != 0
    drawn = canvas(figure, 6.4, 1.2 * len(curves) + 0.5)
    grid = drawn.subplots(len(curves), 1, sharex=True, squeeze=False)[:, 0]
    for index, (axes, (label, curve)) in enumerate(zip(grid, curves.items(), strict=True)):
        axes.plot(along, curve, **line_style(index))
        if is_singular.any():
            axes.plot(along[is_singular], curve[is_singular], "x", color=VERMILION, markersize=7)
        tidy(axes)
        axes.set_ylabel(label, fontsize=FONT)
        axes.set_ylim(bottom=0.0)
    along_x(grid[-1], along, "row of q" if t is None else "time [s]")
    drawn.align_ylabels()
    return whole(drawn)
