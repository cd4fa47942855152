"""Flags and records that come out of irbkin.

Records are named tuples. Those that hold arrays are equal where every array has the same shape and
the same values, NaN being equal to NaN; they cannot be hashed. The others compare and hash as
tuples do.
"""

from __future__ import annotations

import enum
import operator
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeVar

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = [
    "Break",
    "BreakReason",
    "CatalogEntry",
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
    "SingularityBatch",
    "SingularityKind",
    "SingularityMode",
    "Status",
    "StrandEnd",
    "TrajectorySample",
]

_Record = TypeVar("_Record", bound=type)


def _same(first: Any, second: Any) -> bool:
    """Whether two fields have one value: arrays by shape and elements, NaN being equal to NaN."""
    import numpy as np

    if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
        first, second = np.asarray(first), np.asarray(second)
        is_real = all(array.dtype.kind == "f" for array in (first, second))
        return np.array_equal(first, second, equal_nan=is_real)
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(_same, first, second))
    # A number is equal to itself, NaN is not.
    return bool(first == second or (first != first and second != second))


def by_value(record: _Record) -> _Record:
    """Compare a record that holds arrays by value; without it, `==` would ask for the truth of an
    array.
    """

    def is_equal(self: tuple[object, ...], other: object) -> bool:
        return _same(self, other) if isinstance(other, tuple) else NotImplemented

    def is_unequal(self: tuple[object, ...], other: object) -> bool:
        return not _same(self, other) if isinstance(other, tuple) else NotImplemented

    for name, method in (("__eq__", is_equal), ("__ne__", is_unequal), ("__hash__", None)):
        setattr(record, name, method)
    return record


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
    """The slot is empty because its solution coincides with that of another slot at a
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
    """An arm without a closed form has no solution; how far the pose is out of reach is not known.
    """


class SingularityMode(str, enum.Enum):
    """What `Robot.follow` does at the wrist singularity; the plain words are taken, too."""

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


@by_value
class IkBatch(NamedTuple):
    """Solutions of many poses."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (..., slots, n), NaN where a slot is empty."""
    status: npt.NDArray[np.uint8]
    """`Status` of each slot, shape (..., slots)."""


class Configuration(NamedTuple):
    """ABB's confdata of one joint vector."""

    cf1: int
    """Quarter turn of axis 1: floor(q1 / 90 deg)."""
    cf4: int
    """Quarter turn of axis 4."""
    cf6: int
    """Quarter turn of axis 6."""
    cfx: int
    """The slot: 4 (wrist center behind axis 1) + 2 (behind the lower arm) + 1 (q5 < 0); 0 with
    coupled axes 2 and 3.
    """


@by_value
class ConfigurationBatch(NamedTuple):
    """ABB's confdata of many joint vectors."""

    cf1: npt.NDArray[np.int32]
    """Quarter turns of axis 1: floor(q1 / 90 deg), shape (...)."""
    cf4: npt.NDArray[np.int32]
    """Quarter turns of axis 4, shape (...)."""
    cf6: npt.NDArray[np.int32]
    """Quarter turns of axis 6, shape (...)."""
    cfx: npt.NDArray[np.int32]
    """The slots, shape (...): as `Configuration.cfx`."""


class FreeJoint(NamedTuple):
    """The joint that a singular pose leaves undetermined."""

    joint: int
    """Its number, from 1."""
    fixed: str
    """What stays fixed along the self-motion: "q4 + q6", "q4 - q6", "q2, q3", "q1, q3" or, with
    coupled axes 2 and 3, "q1, q3 - q2"; "q1, q5" of three parallel axes; "q1 + q3", "q1 - q3",
    "q4, q6" or "q4, q5" of seven axes. Of an arm without a closed form the joints that stand
    still, or "nothing".
    """


class Break(NamedTuple):
    """A place where the joints cannot follow a path without a jump."""

    pose_index: int
    """Index of the pose that is not met, or at which the joints arrive by a jump."""
    reason: str
    """Where and why, in a sentence."""
    path: tuple[int, ...] = ()
    """Index of the path among several; empty for one."""
    kind: BreakReason = BreakReason.UNREACHABLE
    """Why."""


@by_value
class FollowResult(NamedTuple):
    """A joint path along a path of poses."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (..., m, n), NaN where a pose is not met."""
    orientation_error: npt.NDArray[np.float64]
    """Angle between the tool's orientation and that of each pose [rad], shape (..., m), NaN where a
    pose is not met.
    """
    breaks: tuple[Break, ...]
    """Where the joints cannot follow, and why."""


class Singularity(NamedTuple):
    """Distances of one joint vector from the singularities; NaN where an arm has no such one."""

    wrist: float
    """Angle of joint 5 from 0 or 180 deg [rad]; of seven axes, between the plane of axes 5 and 6
    and the line to the shoulder.
    """
    elbow: float
    """Angle between upper arm and forearm from stretched or folded [rad]."""
    shoulder: float
    """Distance of the wrist center from axis 1 [m]; with a lateral offset, from the plane through
    it along axis 2; of seven axes, distance of the upper arm's end from axis 1.
    """
    min_singular_value: float
    """Smallest singular value of the Jacobian at the tool, its rows in m and rad as they are."""
    manipulability: float
    """sqrt(det(J J^T)), the product of the singular values."""
    kinds: SingularityKind
    """The singularities that the joint vector is at."""


@by_value
class SingularityBatch(NamedTuple):
    """Distances of many joint vectors from the singularities: arrays of shape (...), with the units
    of `Singularity`. NaN where an arm has no such singularity.
    """

    wrist: npt.NDArray[np.float64]
    """As `Singularity.wrist` [rad]."""
    elbow: npt.NDArray[np.float64]
    """As `Singularity.elbow` [rad]."""
    shoulder: npt.NDArray[np.float64]
    """As `Singularity.shoulder` [m]."""
    min_singular_value: npt.NDArray[np.float64]
    """Smallest singular values of the Jacobians."""
    manipulability: npt.NDArray[np.float64]
    """sqrt(det(J J^T))."""
    kinds: npt.NDArray[np.uint8]
    """Values of `SingularityKind`."""


@by_value
class Margin(NamedTuple):
    """How far joint vectors are from limits and singularities, each as a part of the farthest that
    they can be: 1 in the middle, 0 at one, negative outside limits.
    """

    limits: npt.NDArray[np.float64]
    """The least over all joints of 1 - |q - middle| / half the range, shape (...)."""
    singularities: npt.NDArray[np.float64]
    """The least of three distances, each at most 1, shape (...): that from the wrist singularity
    and that from the elbow singularity as a part of 90 deg, and that from the shoulder singularity
    as a part of half the length of upper arm and forearm. NaN if the structure of the arm is
    unknown.
    """


@by_value
class IkMargin(NamedTuple):
    """How much room the solutions of poses leave."""

    margin: npt.NDArray[np.float64]
    """The largest margin (the smaller part of `Margin`) of the solutions inside the limits, each
    with the full turns that leave the most room, shape (...). NaN where there is none.
    """
    singularities: npt.NDArray[np.float64]
    """Their largest `Margin.singularities`, shape (...). NaN where there is none."""
    solutions: npt.NDArray[np.uint8]
    """Their number, shape (...)."""


class PlanBreak(NamedTuple):
    """A part of a path that the joints cannot follow."""

    leave: int | None
    """The last pose before it; None where the path begins with it."""
    enter: int | None
    """The first pose after it; None where the path ends with it."""


class StrandEnd(NamedTuple):
    """Where and why a branch of a path ends."""

    slot: int
    """Its slot."""
    pose_index: int
    """The first pose that it does not reach."""
    reason: str
    """The reason in a sentence."""


@by_value
class Plan(NamedTuple):
    """The best joint path along a path of poses."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (m, n); NaN where a plan with breaks has none."""
    tool_angle: npt.NDArray[np.float64]
    """The angle that the tool is turned by at each pose [rad], shape (m,), without jumps of a full
    turn; zeros without a free rotation.
    """
    slot: npt.NDArray[np.int64]
    """The slot of the branch at each pose, shape (m,); -1 where there is none."""
    external: npt.NDArray[np.float64]
    """Values of the external axes of `carrier` at each pose [m, rad], shape (m, k); NaN where a
    plan with breaks has none.
    """
    tolerance: npt.NDArray[np.float64]
    """What is used of `tolerance` at each pose, shape (m, t): of a cone the tilts about the two
    axes that the tool does not point in [rad], of an offset the shift [m].
    """
    cost: float
    """Weighted sum of the squares of all joint steps [rad^2]."""
    bottleneck: float
    """The largest velocity of a joint as a part of its limit. Without `times`, the time [s] that
    the path takes at least if its poses are equally far apart in time.
    """
    breaks: tuple[PlanBreak, ...]
    """Where the joints cannot follow: empty, but of the plan of a `PathError`."""
    certified: bool
    """Whether every step, apart from breaks, was shown to be continuous between its two poses."""

    def __repr__(self) -> str:
        count = len(self.breaks)
        breaks = "no breaks" if count == 0 else "1 break" if count == 1 else f"{count} breaks"
        proof = "certified" if self.certified else "not certified"
        return (
            f"Plan({len(self.q)} poses, cost {self.cost:.6g}, bottleneck {self.bottleneck:.6g}, "
            f"{breaks}, {proof})"
        )


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


@by_value
class ToolSpeedLimits(NamedTuple):
    """The constant speed of the tool along a path that the limits of the joints allow."""

    speed: npt.NDArray[np.float64]
    """The highest at each sample [m/s], shape (m,); infinite where no limit binds."""
    joint: npt.NDArray[np.int64]
    """The joint that limits it, from 1, shape (m,); 0 where none does."""
    fastest: float
    """The fastest constant speed on the whole path [m/s], between the samples too."""
    fastest_joint: int
    """The joint that limits that, from 1; 0 where none does."""
    fastest_index: int
    """The sample at which it does, or the last one before the place."""


class PoseCheck(NamedTuple):
    """Whether a pose can be reached."""

    reachable: bool
    """Some joint vector brings the tool there."""
    within_limits: bool
    """One of them is inside the joint limits."""
    reason: str
    """The outcome in a sentence."""


@by_value
class CatalogEntry(NamedTuple):
    """What the catalog has of an arm."""

    name: str
    """The maker's type name."""
    maker: Literal["ABB", "Universal Robots", "Franka", "FANUC", "UFACTORY"]
    """"ABB", "Universal Robots", "Franka", "FANUC" or "UFACTORY"."""
    aliases: tuple[str, ...]
    """Other names that `Robot` takes for it, beside spellings in which case, blanks and dashes
    differ.
    """
    dof: int
    """Number of joints."""
    payload: float | None
    """Payload [kg], as the type name or the data sheet gives it; of several generations the least.
    None where it is not known.
    """
    reach: float | None
    """Reach [m], as the type name or the data sheet gives it: rounded, of ABB's arms to the wrist
    center. None where it is not known.
    """
    limits: npt.NDArray[np.float64]
    """Lower and upper limit of each joint [rad], shape (n, 2)."""
    max_velocity: npt.NDArray[np.float64] | None
    """Largest velocity of each joint [rad/s], shape (n,), or None where no source has it."""
    is_coupled: bool
    """Whether a parallelogram linkage couples axes 2 and 3."""
    sources: int
    """Number of independent sources of the figures."""
    provenance: str
    """The sources, and where they disagree."""
