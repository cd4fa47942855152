"""The errors of irbkin. Every message names the field, the value and the bound."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from irbkin.records import Configuration, Plan, StrandEnd

__all__ = [
    "CalibrationError",
    "InvalidJointsError",
    "InvalidModelError",
    "InvalidMotionError",
    "InvalidPoseError",
    "IrbkinError",
    "PathError",
    "RapidError",
    "StreamError",
    "UnknownNameError",
    "UnknownRobotError",
    "UnreachableError",
]


class IrbkinError(ValueError):
    """The base of every error of irbkin."""


class InvalidPoseError(IrbkinError):
    """A pose is not a rigid transform, or its array has a wrong shape."""


class InvalidJointsError(IrbkinError):
    """A joint vector is not finite, or its array has a wrong shape."""


class InvalidModelError(IrbkinError):
    """An arm cannot be built from these figures, or its structure does not support the call."""


class InvalidMotionError(IrbkinError):
    """A trajectory, a path or a limit of it cannot be what was asked for."""


class CalibrationError(IrbkinError):
    """Measurements cannot calibrate the arm; raised by `irbkin.calibrate`."""


class StreamError(IrbkinError):
    """A datagram is broken, or a controller and a guard do not go together."""


class UnreachableError(IrbkinError):
    """No solution inside the limits, none of the wanted configuration, or no free motion."""

    configurations: tuple[Configuration, ...] = ()
    """The configurations that exist, where another one was asked for."""
    rapid_error: Literal["ERR_OUTSIDE_REACH", "ERR_ROBLIMIT"] | None = None
    """RAPID's name of the error, in errors of `irbkin.rapid`: ERR_OUTSIDE_REACH or ERR_ROBLIMIT."""
    proven: bool = False
    """Whether it is proven that `Robot.go` has no motion, not that none was found in the time."""


class PathError(UnreachableError):
    """The joints cannot follow a path without a break; raised by `Robot.plan`."""

    index: int = 0
    """The first pose that no branch reaches from the start."""
    end_index: int = 0
    """The last pose from which no branch reaches the end."""
    reasons: tuple[StrandEnd, ...] = ()
    """Where and why each branch ends."""
    plan: Plan
    """The plan with the fewest breaks."""


class RapidError(IrbkinError):
    """A RAPID text is broken, or RAPID data do not fit together."""

    line: int = 0
    """Line of the text, from 1; 0 where it has none."""
    column: int = 0
    """Column of the text, from 1; 0 where it has none."""


class UnknownNameError(RapidError, KeyError):
    """A RAPID module has no data of that name; the message has the close ones."""

    # KeyError would put the message in quotes.
    __str__ = IrbkinError.__str__


class UnknownRobotError(IrbkinError, KeyError):
    """The catalog has no arm of that name; the message has the close ones, or why it is left
    out.
    """

    # KeyError would put the message in quotes.
    __str__ = IrbkinError.__str__
