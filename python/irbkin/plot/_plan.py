"""A plan: tool angle, joints and velocities along its path."""

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from irbkin import Robot
from irbkin._arguments import check_robot
from irbkin._arrays import Floats, as_array
from irbkin.errors import InvalidJointsError, InvalidMotionError
from irbkin.plot import _style
from irbkin.plot._style import BLACK, FONT, SHADE, Canvas, canvas, line_style, tidy, whole
from irbkin.records import Plan

ALL = np.array([0.0, 100.0])
"""All of a range [%]."""


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
    panels = [_joints, _velocities]
    if np.any(plan.tool_angle):
        panels.insert(0, _tool_angle)
    drawn = canvas(figure, 6.4, 1.9 * len(panels) + 0.7)
    grid = drawn.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(grid, panels, strict=True):
        panel(axes, robot, plan, along, times is not None)
        for gap in plan.breaks:
            left = along[0] if gap.leave is None else along[gap.leave]
            right = along[-1] if gap.enter is None else along[gap.enter]
            axes.axvspan(left, right, color=SHADE, linewidth=0, zorder=0.5)
        tidy(axes)
    _style.along_x(grid[-1], along, "pose" if times is None else "time [s]")
    drawn.align_ylabels()
    _style.legend(drawn, grid[-2], robot.dof)
    return whole(drawn)


def _tool_angle(axes: Axes, robot: Robot, plan: Plan, along: Floats, is_timed: bool) -> None:
    angle = np.where(np.isnan(plan.q).any(axis=1), np.nan, np.degrees(plan.tool_angle))
    axes.plot(along, angle, color=BLACK, linewidth=1.6)
    axes.set_ylabel("tool angle [deg]", fontsize=FONT)


def _joints(axes: Axes, robot: Robot, plan: Plan, along: Floats, is_timed: bool) -> None:
    low, high = robot.limits.T
    # A joint without limits, or without a range, is in the middle.
    width = np.where(np.isfinite(high - low) & (high > low), high - low, np.inf)
    middle = np.where(np.isfinite(width), 0.5 * (low + high), 0.0)
    part = 100.0 * (0.5 + (plan.q - middle) / width)
    for joint in range(robot.dof):
        axes.plot(along, part[:, joint], label=f"J{joint + 1}", **line_style(joint))
    _style.shade(axes, ALL)
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
    _style.shade(axes, ALL)
    axes.set_ylim(0.0, None)
    of = "its limit" if robot.max_velocity is not None else "1 rad/s"
    pace = "" if is_timed else "\nat the fastest even pace"
    axes.set_ylabel(f"velocity [% of {of}]{pace}", fontsize=FONT)
