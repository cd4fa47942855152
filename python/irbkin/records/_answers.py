"""Answers of a robot about joint vectors and poses, and what the catalog has of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

from irbkin._equality import by_value
from irbkin.records._flags import BreakReason, SingularityKind

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


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
