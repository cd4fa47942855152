"""Motions of joints over time: from one joint vector to another, through many, along a path.

>>> from irbkin import trajectory
>>> move = trajectory.joint([0, 0], [1, -2], duration=2.0)
>>> move.q[-1]
array([ 1., -2.])
>>> move.sample(1.0).dq
array([ 0.9375, -1.875 ])
"""

from irbkin._core import (
    Trajectory,
    at_tool_speed,
    joint,
    retime,
    spline,
    tool_speed_limits,
)
from irbkin._state_to_state import state_to_state
from irbkin.records import MotionPeaks, ToolSpeedLimits, TrajectorySample

__all__ = [
    "MotionPeaks",
    "ToolSpeedLimits",
    "Trajectory",
    "TrajectorySample",
    "at_tool_speed",
    "joint",
    "retime",
    "spline",
    "state_to_state",
    "tool_speed_limits",
]
