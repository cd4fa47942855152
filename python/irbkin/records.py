"""Flags and records that come out of irbkin."""

from __future__ import annotations

import enum
import operator
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = [
    "Break",
    "Configuration",
    "FollowResult",
    "FreeJoint",
    "IkBatch",
    "MotionPeaks",
    "PoseCheck",
    "Reach",
    "Singularity",
    "SingularityKind",
    "Status",
    "TrajectorySample",
]


class Flags(enum.IntFlag):
    """Flags that NumPy's integers are taken for, too."""

    @classmethod
    def _missing_(cls, value: object) -> Any:
        """An integer of another type, as the elements of a status array are."""
        return super()._missing_(operator.index(value))  # type: ignore[arg-type]


class Status(Flags):
    """What a solve says of one slot."""

    FOUND = 1
    """The slot holds a solution."""
    WITHIN_LIMITS = 2
    """The solution is inside the joint limits."""
    WRIST = 4
    """sin q5 = 0: axes 4 and 6 of a spherical wrist are one, only q4 + q6 or q4 - q6 is determined;
    axis 6 of a three-parallel arm is parallel to axes 2 to 4. Of seven axes: the shoulder is in the
    plane of axes 5 and 6.
    """
    ELBOW = 8
    """The arm is stretched or folded: both elbow branches coincide."""
    SHOULDER = 16
    """The wrist center is on axis 1: q1 is not determined. With a lateral offset: front and back
    meet. Of seven axes: axes 1 and 3 are one.
    """
    MERGED = 32
    """The slot is empty because its solution coincides with that of another slot at a
    singularity.
    """
    INVALID = 64
    """The input of this row was invalid."""


class SingularityKind(Flags):
    """Kinds of singularity, with the values that they have in `Status`."""

    WRIST = 4
    """sin q5 = 0; of seven axes, the shoulder in the plane of axes 5 and 6."""
    ELBOW = 8
    """The arm is stretched or folded."""
    SHOULDER = 16
    """The wrist center is on axis 1; of seven axes, axes 1 and 3 are one."""


class Reach(enum.Enum):
    """Whether the wrist center gets to where a pose wants it."""

    REACHED = "reached"
    TOO_FAR = "too far"
    """It lies beyond the stretched arm."""
    TOO_NEAR = "too near"
    """It lies closer than the folded arm, or inside the cylinder of the lateral offset."""


class IkBatch(NamedTuple):
    """Solutions of many poses."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (..., 8, n), NaN where a slot is empty."""
    status: npt.NDArray[np.uint8]
    """`Status` of each slot, shape (..., 8)."""


class Configuration(NamedTuple):
    """ABB's confdata: integers for one joint vector, arrays for many."""

    cf1: Any
    """Quarter turn of axis 1: floor(q1 / 90 deg)."""
    cf4: Any
    """Quarter turn of axis 4."""
    cf6: Any
    """Quarter turn of axis 6."""
    cfx: Any
    """The slot: 4 (wrist center behind axis 1) + 2 (behind the lower arm) + 1 (q5 < 0); 0 with
    coupled axes 2 and 3.
    """


class FreeJoint(NamedTuple):
    """The joint that a singular pose leaves free."""

    joint: int
    """Its number, from 1."""
    fixed: str
    """What stays fixed along the family: "q4 + q6", "q4 - q6", "q2, q3", "q1, q3" or, with coupled
    axes 2 and 3, "q1, q3 - q2"; "q1, q5" of three parallel axes; "q1 + q3", "q1 - q3", "q4, q6" or
    "q4, q5" of seven axes.
    """


class Break(NamedTuple):
    """A place where the joints cannot follow a path without a jump."""

    pose_index: int
    """Index of the pose that is not met, or at which the joints arrive by a jump."""
    reason: str
    """Where and why, in a sentence."""
    path: tuple[int, ...] = ()
    """Index of the path among several; empty for one."""


class FollowResult(NamedTuple):
    """A joint path along a path of poses."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (..., m, n), NaN where a pose is not met."""
    orientation_error: npt.NDArray[np.float64]
    """How far the tool's orientation is from that of each pose [rad], shape (..., m), NaN where a
    pose is not met.
    """
    breaks: tuple[Break, ...]
    """Where the joints cannot follow, and why."""


class Singularity(NamedTuple):
    """How far joint vectors are from the singularities; numbers for one, arrays for many."""

    wrist: Any
    """Angle of joint 5 from 0 or 180 deg [rad]; of seven axes, between the plane of axes 5 and 6
    and the line to the shoulder.
    """
    elbow: Any
    """Angle between upper arm and forearm from stretched or folded [rad]."""
    shoulder: Any
    """Distance of the wrist center from axis 1 [m]; with a lateral offset, from the plane through
    it along axis 2; of seven axes, distance of the upper arm's end from axis 1.
    """
    min_singular_value: Any
    """Smallest singular value of the Jacobian at the tool, its rows in m and rad as they are."""
    manipulability: Any
    """sqrt(det(J J^T)), the product of the singular values."""
    kinds: Any
    """`SingularityKind` of the singularities at which the joint vector stands; for many, an array
    of its values, uint8.
    """


class TrajectorySample(NamedTuple):
    """The state of the joints at times."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (..., n)."""
    dq: npt.NDArray[np.float64]
    """Joint velocities [rad/s], shape (..., n)."""
    ddq: npt.NDArray[np.float64]
    """Joint accelerations [rad/s^2], shape (..., n)."""


class MotionPeaks(NamedTuple):
    """The largest sizes of each joint's derivatives."""

    velocity: npt.NDArray[np.float64]
    """Velocities [rad/s], shape (n,)."""
    acceleration: npt.NDArray[np.float64]
    """Accelerations [rad/s^2], shape (n,)."""
    jerk: npt.NDArray[np.float64]
    """Jerks [rad/s^3], shape (n,)."""


class PoseCheck(NamedTuple):
    """Whether a pose can be reached."""

    reachable: bool
    """Some joint vector brings the tool there."""
    within_limits: bool
    """One of them is inside the joint limits."""
    reason: str
    """The outcome in a sentence."""
