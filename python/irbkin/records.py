"""Flags and records that irbkin returns.

A record is a frozen class of documented fields, and the sequence of them: it unpacks, and equals a
tuple of equal fields. Arrays are equal if their shapes and elements are, NaN being equal to NaN.
"""

import enum
import operator
from typing import Any

from irbkin._core import (
    Break,
    CatalogEntry,
    CellContact,
    CellDistance,
    Configuration,
    ConfigurationBatch,
    FollowResult,
    FreeJoint,
    IkBatch,
    IkMargin,
    Margin,
    MotionPeaks,
    Plan,
    PlanBreak,
    PoseCheck,
    Singularity,
    StrandEnd,
    ToolSpeedLimits,
    TrajectorySample,
)

__all__ = [
    "Break",
    "BreakReason",
    "CatalogEntry",
    "CellContact",
    "CellDistance",
    "Configuration",
    "ConfigurationBatch",
    "FollowResult",
    "FreeJoint",
    "IkBatch",
    "IkMargin",
    "Margin",
    "MotionPeaks",
    "Plan",
    "PlanBreak",
    "PoseCheck",
    "Reach",
    "Singularity",
    "SingularityKind",
    "SingularityMode",
    "Status",
    "StrandEnd",
    "ToolSpeedLimits",
    "TrajectorySample",
]


class Flags(enum.IntFlag):
    """Flags that NumPy's integers are taken for, too."""

    @classmethod
    def _missing_(cls, value: object) -> Any:
        """An integer of another type, as the elements of a status array are."""
        return super()._missing_(operator.index(value))  # type: ignore[arg-type]


class Status(Flags):
    """Flags of one slot."""

    FOUND = 1
    """The slot holds a solution."""
    WITHIN_LIMITS = 2
    """The solution is inside the joint limits."""
    WRIST = 4
    """sin q5 = 0: axes 4 and 6 of a spherical wrist coincide, only q4 + q6 or q4 - q6 is
    determined; axis 6 of a three-parallel arm is parallel to axes 2 to 4. Of seven axes: the
    shoulder is in the plane of axes 5 and 6. Of an arm without a closed form: its joints can move
    with the tool standing still.
    """
    ELBOW = 8
    """The arm is stretched or folded: both elbow branches coincide. Of an arm without a closed
    form: any two branches coincide.
    """
    SHOULDER = 16
    """The wrist center is on axis 1: q1 is not determined. With a lateral offset: front and back
    meet. Of seven axes: axes 1 and 3 coincide.
    """
    MERGED = 32
    """The slot is empty because its solution coincides with another slot's at a
    singularity.
    """
    INVALID = 64
    """The input of this row was invalid."""
    UNCERTIFIED = 128
    """It is not certain that the slots hold every solution of the pose: on every slot of a row, or
    on none. Never where the structure has a closed form.
    """


class SingularityKind(Flags):
    """Singularities, with the values that they have in `Status`."""

    WRIST = 4
    """sin q5 = 0; of seven axes, the shoulder is in the plane of axes 5 and 6."""
    ELBOW = 8
    """The arm is stretched or folded."""
    SHOULDER = 16
    """The wrist center is on axis 1; of seven axes, axes 1 and 3 coincide."""


class Reach(enum.Enum):
    """Whether the arm reaches a pose, limits not regarded."""

    REACHED = "reached"
    """It does."""
    TOO_FAR = "too far"
    """The wrist center lies beyond the stretched arm."""
    TOO_NEAR = "too near"
    """The wrist center lies closer than the folded arm, or inside the cylinder of the lateral
    offset.
    """
    NO_ROOTS = "no roots"
    """An arm in general, or one with an offset wrist, has no solution; how far the pose is out of
    reach is not known.
    """
    TURNED = "turned"
    """An arm of five axes reaches the pose only turned about axis 1 by more than its heading
    tolerance.
    """


class SingularityMode(str, enum.Enum):
    """Behavior of `Robot.follow` at the wrist singularity; the plain words are taken, too."""

    THROUGH = "through"
    """Meet every pose exactly, however fast axes 4 and 6 turn."""
    ERROR = "error"
    """Stop where joint 5 enters the zone, and where a joint must jump, as SingArea \\Off."""
    WRIST = "wrist"
    """Interpolate axes 4, 5, 6 across the zone, the position exact, as SingArea \\Wrist."""
    LOCK_AXIS4 = "lock_axis4"
    """Keep axis 4 at 0 or +-180 deg, the position exact, as SingArea \\LockAxis4."""


class BreakReason(enum.Enum):
    """Why the joints cannot follow a path."""

    UNREACHABLE = "unreachable"
    """No solution inside the limits reaches the pose."""
    JUMP = "jump"
    """A joint must turn while the tool stands still."""
    LOCKED = "locked"
    """No joints inside the limits bring the tool there with the wrist or axis 4 locked."""
    STOPPED = "stopped"
    """Joint 5 enters the zone of the wrist singularity in the mode "error"."""
