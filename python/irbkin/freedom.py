"""The freedom that `Robot.plan` has at each pose besides the joints."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    import numpy.typing as npt

__all__ = ["Positioner", "ToolCone", "ToolRotation", "Track"]


class ToolRotation(NamedTuple):
    """The angles by which `Robot.plan` may turn the tool about one of its axes at each pose.

    Of a full turn the upper end is the lower one: 36 steps are 10 degrees apart. Of less, both ends
    count: `ToolRotation(7, -np.pi / 6, np.pi / 6)` is every 10 degrees, too.
    """

    steps: int = 36
    """Number of angles."""
    lower: float = -math.pi
    """Lower end [rad]."""
    upper: float = math.pi
    """Upper end [rad]."""
    axis: Literal["x", "y", "z"] = "z"
    """Axis of the tool."""


class ToolCone(NamedTuple):
    """A cone about the axis in which the tool points: the axis of the `ToolRotation`, or z.

    `Robot.plan` tilts the tool by the angles of a grid inside the cone, which it then refines to
    half a degree.
    """

    angle: float
    """The largest tilt [rad], up to pi / 2."""
    steps: int = 5
    """Number of tilts across, odd."""


class Track(NamedTuple):
    """A linear track that carries the robot, as ABB's IRBT does.

    The base stands at `x` times `axis` from where the robot has it; along the rail of its own
    `carrier`, from the rail's zero. The poses stay where they are.
    """

    axis: Literal["x", "y", "z"] | npt.ArrayLike
    """Direction of the track, in the frame of the poses: a letter, or shape (3,)."""
    lower: float
    """Lower end [m]."""
    upper: float
    """Upper end [m]."""
    steps: int = 21
    """Number of places, refined to 5 mm."""
    max_velocity: float = 1.0
    """Velocity limit [m/s]."""
    weight: float = 1.0
    """Cost of moving it, beside the weights of the joints."""


class Positioner(NamedTuple):
    """An axis that turns the work object, as ABB's IRBP do.

    The poses are those where every axis is at zero; at an angle, the object with its poses is
    turned about the line through `point` along `axis`. Of several, each carries those after it: the
    one on the floor comes first.
    """

    point: npt.ArrayLike
    """A point of the line [m], shape (3,), in the frame of the poses."""
    axis: Literal["x", "y", "z"] | npt.ArrayLike
    """Direction of the line: a letter, or shape (3,)."""
    lower: float = -math.pi
    """Lower end [rad]."""
    upper: float = math.pi
    """Upper end [rad]."""
    steps: int = 37
    """Number of angles, refined to half a degree."""
    max_velocity: float = 1.0
    """Velocity limit [rad/s]."""
    weight: float = 1.0
    """Cost of moving it, beside the weights of the joints."""
