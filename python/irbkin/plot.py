"""Curves of motions, with matplotlib: `pip install 'irbkin[plot]'`. Arms and paths of the tool are
drawn by `irbkin.scene`.

Each function returns a `matplotlib.figure.Figure` that a notebook shows as its last line; none
touches pyplot. Angles are in degrees, as engineers read them, lengths in meters. `figure=` takes a
figure to draw into: of `pyplot.figure()`, which `pyplot.show()` shows in a window, or a subfigure.

>>> import irbkin.plot
>>> move = irbkin.trajectory.joint([0, 0], [1, -2], duration=2.0)
>>> figure = irbkin.plot.trajectory(move, max_velocity=2.5)
>>> figure.axes[1].get_title()
'velocity'
"""

import io
from typing import Any

import numpy as np
import numpy.typing as npt

try:
    import matplotlib as _matplotlib  # noqa: F401
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure
except ImportError as _missing:
    raise ImportError(
        "irbkin.plot needs matplotlib: pip install 'irbkin[plot]'", name="matplotlib"
    ) from _missing

from irbkin import Robot
from irbkin._arguments import check_robot
from irbkin._arrays import Floats, as_array, limit_of_each
from irbkin.errors import InvalidJointsError, InvalidMotionError
from irbkin.records import Plan
from irbkin.trajectory import Trajectory

__all__ = ["plan", "singularity", "trajectory"]

Canvas = Figure | SubFigure

# Okabe and Ito's colors, which color-blind readers can tell apart.
COLORS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#000000")
VERMILION = COLORS[4]
BLACK = COLORS[6]
# With them, so that black and white does: solid, dashed, dash-dot, dotted, ...
DASHES: tuple[Any, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (2, 1)), (0, (9, 2)))
SHADE = "#f6d5c5"
FONT = 9
QUANTITIES = (("position", "deg"), ("velocity", "deg/s"), ("acceleration", "deg/s²"))
POINTS = 241
ALL = np.array([0.0, 100.0])
"""All of a range [%]."""


class Picture(Figure):
    """A figure of matplotlib, without pyplot, that notebooks show."""

    def _repr_svg_(self) -> str:
        file = io.StringIO()
        self.savefig(file, format="svg", transparent=False)
        text = file.getvalue()
        return text[text.index("<svg") :]


def line_style(index: int) -> dict[str, Any]:
    """The color and the dashes of joint `index`, from 0."""
    index %= len(COLORS)
    return {"color": COLORS[index], "linestyle": DASHES[index], "linewidth": 1.6}


def canvas(figure: Canvas | None, width: float, height: float) -> Canvas:
    """The figure that is given, or a new one of a size [inch]."""
    return Picture(figsize=(width, height), layout="constrained") if figure is None else figure


def whole(figure: Canvas) -> Figure:
    top = figure.get_figure(root=True)
    assert isinstance(top, Figure)
    return top


def tidy(axes: Axes) -> None:
    axes.grid(visible=True, color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=FONT)


def legend(drawn: Canvas, axes: Axes, columns: int) -> None:
    handles, labels = axes.get_legend_handles_labels()
    place: Any = {"loc": "outside lower center", "ncols": columns, "frameon": False}
    drawn.legend(handles, labels, fontsize=FONT, handlelength=3.2, **place)


def shade(axes: Axes, bounds: Floats) -> None:
    """Shade what is beyond limits, lower and upper, so that both are in view."""
    shown = [*axes.get_ylim(), *bounds[np.isfinite(bounds)]]
    margin = 0.1 * (max(shown) - min(shown)) if np.isfinite(bounds).any() else 0.0
    edges = min(shown) - margin, max(shown) + margin
    for limit, edge in zip(bounds, edges, strict=True):
        if np.isfinite(limit):
            axes.axhspan(min(limit, edge), max(limit, edge), color=SHADE, linewidth=0, zorder=0.5)
            axes.axhline(limit, color=VERMILION, linewidth=0.9, linestyle="--")
    axes.set_ylim(*edges)


def along_x(axes: Axes, along: Floats, words: str) -> None:
    """Give the lowest axes the label and the range of what panels share."""
    axes.set_xlabel(words, fontsize=FONT)
    axes.set_xlim(along[0], along[-1] if along[-1] > along[0] else along[0] + 1.0)


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


def plan(
    robot: Robot,
    plan: Plan,
    *,
    times: npt.ArrayLike | None = None,
    figure: Canvas | None = None,
) -> Figure:
    """Draw a plan: the tool angle, the joints between their limits, and their velocities as parts
    of their limits. What is beyond a limit, and a part that is not planned, is shaded.

    Args:
        robot: The arm of the plan.
        plan: The answer of `robot.plan`, or the plan with breaks of a PathError.
        times: Times of the poses [s], shape (m,), as they were given to `robot.plan`. Without them
            velocities are at the fastest even pace, at which one reaches its limit.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: panels one above the other. The tool angle is in deg and left out where it is
        zero; joints and velocities are in %.

    Raises:
        TypeError: `robot` is not a Robot, or `plan` not a Plan.
        InvalidJointsError: The plan has another number of joints.
        InvalidMotionError: `times` has a wrong shape or does not increase.
    """
    check_robot(robot)
    if not isinstance(plan, Plan):
        raise TypeError(f"plan must be a Plan, got {type(plan).__name__}")
    q = as_array(plan.q, "plan.q", (None, robot.dof), InvalidJointsError)
    along = np.arange(len(q), dtype=np.float64)
    if times is not None:
        along = as_array(times, "times", (len(q),), InvalidMotionError)
        for index in np.flatnonzero(~(np.diff(along) > 0)):
            raise InvalidMotionError(
                f"times[{index + 1}] is {along[index + 1]} s, it must be after {along[index]} s"
            )
    has_angle = bool(np.any(plan.tool_angle))
    count = 3 if has_angle else 2
    drawn = canvas(figure, 6.4, 1.9 * count + 0.7)
    grid = drawn.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
    if has_angle:
        angle = np.where(np.isnan(plan.q).any(axis=1), np.nan, np.degrees(plan.tool_angle))
        grid[0].plot(along, angle, color=BLACK, linewidth=1.6)
        grid[0].set_ylabel("tool angle [deg]", fontsize=FONT)
    _joints(grid[-2], robot, plan, along)
    _velocities(grid[-1], robot, plan, along, times is not None)
    for axes in grid:
        for gap in plan.breaks:
            left = along[0] if gap.leave is None else along[gap.leave]
            right = along[-1] if gap.enter is None else along[gap.enter]
            axes.axvspan(left, right, color=SHADE, linewidth=0, zorder=0.5)
        tidy(axes)
    along_x(grid[-1], along, "pose" if times is None else "time [s]")
    drawn.align_ylabels()
    legend(drawn, grid[-2], robot.dof)
    return whole(drawn)


def _joints(axes: Axes, robot: Robot, plan: Plan, along: Floats) -> None:
    low, high = robot.limits.T
    # A joint without limits, or without a range, is in the middle.
    width = np.where(np.isfinite(high - low) & (high > low), high - low, np.inf)
    middle = np.where(np.isfinite(width), 0.5 * (low + high), 0.0)
    part = 100.0 * (0.5 + (plan.q - middle) / width)
    for joint in range(robot.dof):
        axes.plot(along, part[:, joint], label=f"J{joint + 1}", **line_style(joint))
    shade(axes, ALL)
    axes.set_ylabel("joint in its range [%]", fontsize=FONT)


def _velocities(axes: Axes, robot: Robot, plan: Plan, along: Floats, is_timed: bool) -> None:
    limit = np.ones(robot.dof) if robot.max_velocity is None else robot.max_velocity
    duration = np.diff(along)
    if not is_timed and plan.bottleneck > 0.0:
        duration = np.full(len(duration), plan.bottleneck / max(len(duration), 1))
    part = 100.0 * np.abs(np.diff(plan.q, axis=0)) / duration[:, None] / limit
    for joint in range(robot.dof):
        # Each is that between two poses.
        rows = np.r_[part[:, joint], part[-1:, joint]] if len(part) else np.zeros(1)
        axes.plot(along, rows, drawstyle="steps-post", **line_style(joint))
    shade(axes, ALL)
    axes.set_ylim(0.0, None)
    of = "its limit" if robot.max_velocity is not None else "1 rad/s"
    pace = "" if is_timed else "\nat the fastest even pace"
    axes.set_ylabel(f"velocity [% of {of}]{pace}", fontsize=FONT)


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
