"""Position, velocity and acceleration of the joints over time."""

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from irbkin import Robot
from irbkin._arguments import check_robot
from irbkin._arrays import Floats, as_array, limit_of_each
from irbkin.errors import InvalidMotionError
from irbkin.plot._style import FONT, Canvas, along_x, canvas, legend, line_style, shade, tidy, whole
from irbkin.trajectory import Trajectory

QUANTITIES = (("position", "deg"), ("velocity", "deg/s"), ("acceleration", "deg/s²"))
POINTS = 241


def trajectory(
    motion: Trajectory,
    *,
    robot: Robot | None = None,
    limits: npt.ArrayLike | None = None,
    max_velocity: npt.ArrayLike | None = None,
    max_acceleration: npt.ArrayLike | None = None,
    figure: Canvas | None = None,
) -> Figure:
    """Draw position, velocity and acceleration of all joints over time.

    Without limits, three panels show all joints. With limits, each joint has a row, and what is
    beyond a limit is shaded. The curves are the polynomials, not the samples.

    Args:
        motion: The trajectory.
        robot: Where `limits` and `max_velocity` come from if they are not given.
        limits: Lower and upper joint limits [rad], shape (n, 2).
        max_velocity: Limits [rad/s], a number or shape (n,).
        max_acceleration: Limits [rad/s^2], a number or shape (n,).
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure. Axes are in deg, deg/s and deg/s^2 over s.

    Raises:
        TypeError: `motion` is not a Trajectory, or `robot` not a Robot.
        InvalidMotionError: A limit has a wrong shape, is NaN, or is not positive; a robot has
            another number of joints.
    """
    if not isinstance(motion, Trajectory):
        raise TypeError(f"motion must be a Trajectory, got {type(motion).__name__}")
    dof = motion.dof
    if robot is not None:
        check_robot(robot)
        if robot.dof != dof:
            raise InvalidMotionError(f"robot has {robot.dof} joints, motion has {dof}")
        limits = robot.limits if limits is None else limits
        max_velocity = robot.max_velocity if max_velocity is None else max_velocity
    bounds = [
        _range(limits, dof),
        _symmetric(max_velocity, "max_velocity", dof),
        _symmetric(max_acceleration, "max_acceleration", dof),
    ]
    has_limits = any(bound is not None for bound in bounds)
    rows = [[joint] for joint in range(dof)] if has_limits else [list(range(dof))]
    drawn = canvas(figure, 9.6, max(1.15 * len(rows) + 0.6, 3.2))
    grid = drawn.subplots(len(rows), 3, sharex=True, squeeze=False)
    times = _times(motion)
    curves = [np.degrees(curve) for curve in motion.sample(times)]
    for row, joints in enumerate(rows):
        for column, (name, unit) in enumerate(QUANTITIES):
            axes = grid[row, column]
            for joint in joints:
                own, name_of = curves[column][:, joint], f"J{joint + 1}"
                axes.plot(times, own, label=name_of, **line_style(joint))
            tidy(axes)
            which = f"J{joints[0] + 1}" if len(rows) > 1 else name
            axes.set_ylabel(f"{which} [{unit}]", fontsize=FONT)
            bound = bounds[column]
            if bound is not None:
                shade(axes, np.degrees(bound[row]))
    for column, (name, _) in enumerate(QUANTITIES):
        grid[0, column].set_title(name, fontsize=FONT + 1)
        along_x(grid[-1, column], times, "time [s]")
    drawn.align_ylabels()
    if not has_limits and dof > 1:
        legend(drawn, grid[0, 0], dof)
    return whole(drawn)


def _times(motion: Trajectory) -> Floats:
    """Even times, and both sides of every knot, where an acceleration may jump."""
    even = np.linspace(0.0, motion.duration, POINTS)
    before = np.nextafter(motion.knots[1:], -np.inf)
    return np.unique(np.r_[even, motion.knots, np.maximum(before, 0.0)])


def _range(limits: npt.ArrayLike | None, dof: int) -> Floats | None:
    """The joint limits, if they are in order."""
    if limits is None:
        return None
    bounds = as_array(limits, "limits", (dof, 2), InvalidMotionError)
    for joint, (lower, upper) in enumerate(bounds):
        if not lower <= upper:
            raise InvalidMotionError(
                f"limits[{joint}] must be lower <= upper, got {lower} rad and {upper} rad"
            )
    return bounds


def _symmetric(limit: npt.ArrayLike | None, name: str, dof: int) -> Floats | None:
    """A limit of size as lower and upper limits."""
    if limit is None:
        return None
    sizes = limit_of_each(limit, name, dof)
    return np.column_stack([-sizes, sizes])
