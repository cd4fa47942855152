from collections.abc import (
    Callable,
    Collection,
    ItemsView,
    Iterable,
    Iterator,
    KeysView,
    Mapping,
    Sequence,
    ValuesView,
)
from os import PathLike
from typing import (
    IO,
    Any,
    ClassVar,
    Literal,
    Protocol,
    TypeAlias,
    TypeVar,
    final,
    overload,
    type_check_only,
)

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report
from irbkin.freedom import Positioner, ToolCone, ToolRotation, Track
from irbkin.records import BreakReason, Reach, SingularityKind, SingularityMode, Status
from irbkin.stream.egm._records import EgmRobot, EgmSensor

_Floats = npt.NDArray[np.float64]
# One joint vector; the shape of an array is known at the call alone.
_Vector: TypeAlias = "Sequence[float] | Solution"
_Message = TypeVar("_Message", EgmRobot, EgmSensor)

@type_check_only
class _Rotation(Protocol):
    """A rotation of another package, such as SciPy's."""

    def as_matrix(self) -> npt.NDArray[Any]: ...

__all__ = [
    "NOT_THERE",
    "Argument",
    "Body",
    "Break",
    "CatalogEntry",
    "Cell",
    "CellContact",
    "CellDistance",
    "Checked",
    "CheckedMove",
    "Configuration",
    "ConfigurationBatch",
    "Declaration",
    "Finding",
    "FollowResult",
    "Follower",
    "FreeJoint",
    "Guard",
    "IkBatch",
    "IkMargin",
    "JointTarget",
    "LoadData",
    "Margin",
    "Module",
    "MotionMove",
    "MotionPeaks",
    "MotionSettings",
    "Move",
    "PageEngine",
    "Plan",
    "PlanBreak",
    "Pose",
    "PoseCheck",
    "RobTarget",
    "Robot",
    "Routine",
    "RoutineMotion",
    "Shape",
    "Singularity",
    "Skipped",
    "Solution",
    "Solutions",
    "SpeedData",
    "Step",
    "StrandEnd",
    "TargetTable",
    "TextFault",
    "ToolData",
    "ToolSpeedLimits",
    "Trajectory",
    "TrajectorySample",
    "WobjData",
    "ZoneData",
    "__version__",
    "_between",
    "_restore",
    "_urdf_links",
    "_urdf_swept",
    "_urdf_text",
    "arc",
    "at_tool_speed",
    "calc_joint_t",
    "calc_moves",
    "calc_rob_t",
    "calc_targets",
    "catalog",
    "catalog_entry",
    "check",
    "check_codes",
    "check_program",
    "decode",
    "differing_names",
    "dump",
    "encode",
    "instruction_set",
    "instruction_sets",
    "instructions",
    "joint",
    "line",
    "motion",
    "parse",
    "parse_module",
    "path_spline",
    "polyline",
    "pose",
    "read_module",
    "read_modules",
    "retime",
    "spline",
    "to_xyz_euler_zyx",
    "to_xyz_wxyz",
    "tool_speed_limits",
    "use_instruction_set",
]

__version__: str

def catalog(
    reach: float | tuple[float, float] | None = None,
    payload: float | tuple[float, float] | None = None,
) -> tuple[str, ...]:
    """Return the names of the arms in the catalog, ABB's by type number first; of all, or of those
    with a reach and a payload. `catalog_entry(name)` has the data of one.

    Args:
        reach: Reach as the type name or the data sheet has it [m]: a number for at least that much,
            a pair for (least, most).
        payload: Payload [kg], in the same way.

    Returns:
        Names in catalog order. An arm whose reach or payload is not known is left out where it is
        asked for.

    Raises:
        ValueError: A filter is neither a number nor a pair, is NaN or negative, or its least is
            more than its most.
    """

def catalog_entry(name: str) -> CatalogEntry:
    """Return what the catalog has of an arm: payload, reach, limits, speeds, accelerations,
    sources.

    Args:
        name: Catalog name or alias, as `Robot` takes it.

    Returns:
        CatalogEntry.

    Raises:
        UnknownRobotError: No arm of that name; the message has the close names, or why the arm is
            left out.
    """

def instruction_set() -> str:
    """Return the name of the instruction set in use: "avx512", "avx2" or "baseline"."""

def instruction_sets() -> tuple[str, ...]:
    """Return the names of the instruction sets that this CPU supports, the narrowest first."""

def use_instruction_set(name: str) -> None:
    """Use another instruction set from now on, in the whole process: for tests and measurements.

    Args:
        name: One of `instruction_sets()`.

    Raises:
        ValueError: This CPU does not support it.
    """

def pose(
    xyz: npt.ArrayLike,
    wxyz: npt.ArrayLike | None = None,
    xyzw: npt.ArrayLike | None = None,
    euler_zyx: npt.ArrayLike | None = None,
    rotation: npt.ArrayLike | _Rotation | None = None,
    rotvec: npt.ArrayLike | None = None,
) -> _Floats:
    """Poses from translations and orientations.

    Give one orientation, or none for the orientation of the base. All arguments are broadcast.

    Args:
        xyz: Translations [m], shape (..., 3).
        wxyz: Quaternions w, x, y, z, shape (..., 4); normalized.
        xyzw: Quaternions x, y, z, w, as SciPy and ROS order them, shape (..., 4); normalized.
        euler_zyx: Angles rz, ry, rx [rad], shape (..., 3): Rz(rz) Ry(ry) Rx(rx).
        rotation: Rotation matrices, shape (..., 3, 3), or a `scipy.spatial.transform.Rotation`.
        rotvec: Rotation vectors rx, ry, rz [rad], shape (..., 3), axis times angle, as Universal
            Robots' controllers show them.

    Returns:
        Homogeneous matrices, shape (..., 4, 4).

    Raises:
        InvalidPoseError: A wrong shape, an element that is not finite, a quaternion whose norm is
            off one by more than 2e-3, a matrix that is not a rotation. Of many the message has the
            index of the first.
        TypeError: Several orientations are given, or an argument is not a number.
    """

def to_xyz_wxyz(T: npt.ArrayLike) -> tuple[_Floats, _Floats]:
    """Translations and quaternions of poses.

    Args:
        T: Homogeneous matrices, shape (..., 4, 4), translation [m].

    Returns:
        Translations [m], shape (..., 3), and quaternions w, x, y, z with w >= 0, shape (..., 4). In
        a batch, an invalid row gives NaN.

    Raises:
        InvalidPoseError: A wrong shape, or a single pose that is not a rigid transform.
    """

def to_xyz_euler_zyx(T: npt.ArrayLike) -> tuple[_Floats, _Floats]:
    """Translations and ZYX Euler angles of poses.

    Args:
        T: Homogeneous matrices, shape (..., 4, 4), translation [m].

    Returns:
        Translations [m], shape (..., 3), and rz, ry, rx [rad], shape (..., 3), ry in -pi/2 .. pi/2.
        Where ry is +-pi/2 only rz - rx or rz + rx is determined: rz is 0 there. In a batch, a row
        that is invalid gives NaN.

    Raises:
        InvalidPoseError: A wrong shape, or a single pose that is not a rigid transform.
    """

def _restore(kind: str, state: bytes) -> Any: ...
def _urdf_links(
    text_or_path: str | bytes | PathLike[str], base: str | None, tip: str | None
) -> tuple[list[tuple[str, int, _Floats | None]], str]: ...
def _urdf_swept(
    text_or_path: str | bytes | PathLike[str],
    base: str | None,
    tip: str | None,
    name: str,
    links: list[int],
    capsules: npt.ArrayLike,
) -> tuple[_Floats, float]: ...
def _urdf_text(text: str | bytes) -> str | bytes: ...
def _between(
    start: list[list[float]], end: list[list[float]], limits: list[list[float]]
) -> Trajectory: ...

@type_check_only
class _Record:
    """A record is also the sequence of its fields."""

    def __len__(self) -> int: ...
    def __getitem__(self, index: Any, /) -> Any: ...
    def __iter__(self) -> Iterator[Any]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Configuration(_Record):
    """ABB's confdata `[cf1, cf4, cf6, cfx]`: quarter turns of axes 1, 4 and 6, and the branch of
    the arm.

    A quarter turn's number is `floor(angle / 90 deg)`. `cfx` is 4 (wrist center behind axis 1) + 2
    (behind the lower arm) + 1 (q5 < 0). Arms of other structures count as their
    [`ConfigurationRule`] says.
    """

    @property
    def cf1(self) -> int:
        """Quarter turn of axis 1."""
    @property
    def cf4(self) -> int:
        """Quarter turn of axis 4."""
    @property
    def cf6(self) -> int:
        """Quarter turn of axis 6."""
    @property
    def cfx(self) -> int:
        """The branch of an arm that bends backwards; zero for one with coupled axes 2 and 3."""
    def __new__(cls, cf1: int, cf4: int, cf6: int, cfx: int) -> Configuration: ...

@final
class IkBatch(_Record):
    """Solutions of many poses."""

    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (..., slots, n), NaN where a slot is empty."""
    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """`Status` of each slot, shape (..., slots)."""
    def __new__(cls, q: _Floats, status: npt.NDArray[np.uint8]) -> IkBatch: ...
    @property
    def found(self) -> npt.NDArray[np.bool_]:
        """Whether each slot holds a solution, bool, shape (..., slots)."""
    @property
    def within_limits(self) -> npt.NDArray[np.bool_]:
        """Whether each slot holds a solution inside the joint limits, bool, shape (..., slots)."""
    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the slots as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
        table: a row for each slot of each pose, empty or not.

        Returns:
            Arrays of shape (poses * slots,) by name: `pose`, its index in row-major order; `slot`;
            `found` and `within_limits`, bool; `status`, uint8; `q1` .. [rad], NaN where the slot is
            empty.
        """
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write comma-separated values: the columns of `to_dict` under their names, each number
        with all of its digits, nothing for None.

        Args:
            path_or_file: Path of the file, or a file that is open for text.

        Raises:
            OSError: The file cannot be written.
        """

@final
class FreeJoint(_Record):
    """The joint that a singular pose leaves undetermined."""

    @property
    def joint(self) -> int:
        """Its number, from 1."""
    @property
    def fixed(self) -> str:
        """Joints that stay fixed along the self-motion: "q4 + q6", "q4 - q6", "q2, q3", "q1, q3"
        or, with coupled axes 2 and 3, "q1, q3 - q2" or "q1, q3 + q2"; "q1, q5" of three parallel
        axes; "q1 + q3", "q1 - q3", "q4, q6" or "q4, q5" of seven axes. Of an arm without a
        closed form the joints that stand still, or "nothing".
        """
    def __new__(cls, joint: int, fixed: str) -> FreeJoint: ...

@final
class Break(_Record):
    """A place where the joints cannot follow a path without a jump."""

    @property
    def pose_index(self) -> int:
        """Index of the pose that is not met, or at which the joints arrive by a jump."""
    @property
    def reason(self) -> str:
        """Where and why, in a sentence."""
    @property
    def path(self) -> tuple[int, ...]:
        """Index of the path among several; empty for one."""
    @property
    def kind(self) -> BreakReason:
        """The cause, a `BreakReason`."""
    def __new__(
        cls, pose_index: int, reason: str, path: tuple[int, ...], kind: BreakReason
    ) -> Break: ...

@final
class FollowResult(_Record):
    """A joint path along a path of poses."""

    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (..., m, n), NaN where a pose is not met."""
    @property
    def orientation_error(self) -> _Floats:
        """Angle between the orientations of tool and pose [rad], shape (..., m), NaN where a
        pose is not met.
        """
    @property
    def breaks(self) -> tuple[Break, ...]:
        """Each `Break`: where the joints cannot follow, and why."""
    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the rows as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
        table.

        Returns:
            Arrays of shape (paths * m,) by name: `path`, its index in row-major order; `pose`;
            `q1` .. [rad] and `orientation_error` [rad], NaN where a pose is not met.
        """
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write comma-separated values: the columns of `to_dict` under their names, each number
        with all of its digits, nothing for None.

        Args:
            path_or_file: Path of the file, or a file that is open for text.

        Raises:
            OSError: The file cannot be written.
        """
    def __new__(
        cls, q: _Floats, orientation_error: _Floats, breaks: tuple[Break, ...]
    ) -> FollowResult: ...

@final
class ConfigurationBatch(_Record):
    """ABB's confdata of many joint vectors: int32 arrays of shape (...)."""

    @property
    def cf1(self) -> npt.NDArray[np.int32]:
        """Quarter turns of axis 1: floor(q1 / 90 deg)."""
    @property
    def cf4(self) -> npt.NDArray[np.int32]:
        """Quarter turns of axis 4."""
    @property
    def cf6(self) -> npt.NDArray[np.int32]:
        """Quarter turns of axis 6."""
    @property
    def cfx(self) -> npt.NDArray[np.int32]:
        """The slots, as `Configuration.cfx`."""
    def __new__(
        cls,
        cf1: npt.NDArray[np.int32],
        cf4: npt.NDArray[np.int32],
        cf6: npt.NDArray[np.int32],
        cfx: npt.NDArray[np.int32],
    ) -> ConfigurationBatch: ...

@final
class CellContact(_Record):
    """Where a motion first touches something."""

    @property
    def at(self) -> float:
        """When: the index of the row before it, plus the part of the way to the next row that is
        behind; of a trajectory the time [s].
        """
    @property
    def q(self) -> _Floats:
        """The joint angles there [rad], shape (n,)."""
    @property
    def pair(self) -> tuple[str, str]:
        """The names of the two that touch: "link 3", "table"."""
    @property
    def depth(self) -> float:
        """How deep the two get into each other, or into the margin, until they are apart [m]: of
        16 postures to the next row or knot and one at each that follows.
        """
    def __new__(cls, at: float, q: _Floats, pair: tuple[str, str], depth: float) -> CellContact: ...

@final
class CellDistance(_Record):
    """The nearest two of links and obstacles."""

    @property
    def distance(self) -> _Floats:
        """How far they are apart [m], shape (...); less than zero if they touch, infinite if
        there is nothing to compare.
        """
    @property
    def pair(self) -> tuple[tuple[str, str], ...]:
        """The names of each two, one after the other: "link 3", "table"."""
    @property
    def points(self) -> _Floats:
        """The nearest points of the two in the world [m], shape (..., 2, 3)."""
    @property
    def gradient(self) -> _Floats:
        """How the distance changes with each joint [m/rad], shape (..., n); NaN if that is not
        known: where the points are one, and of the axis of a capsule inside a solid.
        """
    def __new__(
        cls,
        distance: _Floats,
        pair: tuple[tuple[str, str], ...],
        points: _Floats,
        gradient: _Floats,
    ) -> CellDistance: ...

@final
class Singularity(_Record):
    """Distances of joint vectors from the singularities: numbers for one, arrays of shape (...)
    for many. NaN where an arm has no such singularity.
    """

    @property
    def wrist(self) -> Any:
        """Angle of joint 5 from 0 or 180 deg [rad]; of seven axes, between the plane of axes 5
        and 6 and the line to the shoulder.
        """
    @property
    def elbow(self) -> Any:
        """Angle between upper arm and forearm from stretched or folded [rad]."""
    @property
    def shoulder(self) -> Any:
        """Distance of the wrist center from axis 1 [m]; with a lateral offset, from the plane
        through it along axis 2; of seven axes, distance of the upper arm's end from axis 1.
        """
    @property
    def min_singular_value(self) -> Any:
        """Smallest singular value of the Jacobian at the tool, its rows in m and rad as they
        are.
        """
    @property
    def manipulability(self) -> Any:
        """sqrt(det(J J^T)), the product of the singular values."""
    @property
    def kinds(self) -> Any:
        """The singularities that the joint vector is at, those at which branches merge, a
        `SingularityKind`; for many its values, uint8. Empty beside them, however near; `near`
        has a zone.
        """
    def __new__(
        cls,
        wrist: Any,
        elbow: Any,
        shoulder: Any,
        min_singular_value: Any,
        manipulability: Any,
        kinds: Any,
    ) -> Singularity: ...
    def near(self, angle: float = ..., length: float = ...) -> Any:
        """The singularities that joint vectors are at or near.

        Args:
            angle: Distance from the wrist and from the elbow singularity [rad]; 1 deg by default.
                Of an arm whose singularities have no names the least singular value, which then
                counts as an elbow.
            length: Distance from the shoulder singularity [m]; 10 mm by default.

        Returns:
            SingularityKind, with those in `kinds`; for many its values, uint8, shape (...).

        Raises:
            ValueError: A distance that is not positive and finite.
        """

@final
class Margin(_Record):
    """How far joint vectors are from limits and singularities, each as a part of the farthest
    that they can be: 1 in the middle, 0 at one, negative outside limits.
    """

    @property
    def limits(self) -> _Floats:
        """The least over all joints of 1 - |q - middle| / half the range, shape (...)."""
    @property
    def singularities(self) -> _Floats:
        """The least of three distances, each at most 1, shape (...): from the wrist and from the
        elbow singularity as a part of 90 deg, from the shoulder singularity as a part of half
        the length of upper arm and forearm. Of six joints of another structure the distance in
        joint space to first order, as a part of 90 deg. NaN of other arms.
        """
    def __new__(cls, limits: _Floats, singularities: _Floats) -> Margin: ...

@final
class IkMargin(_Record):
    """How much room the solutions of poses leave."""

    @property
    def margin(self) -> _Floats:
        """The largest margin (the smaller part of `Margin`) of the solutions inside the limits,
        each with the full turns that leave the most room, shape (...). NaN without an answer.
        """
    @property
    def singularities(self) -> _Floats:
        """Their largest `Margin.singularities`, shape (...). NaN without an answer."""
    @property
    def solutions(self) -> npt.NDArray[np.uint8]:
        """Their number, shape (...)."""
    def __new__(
        cls, margin: _Floats, singularities: _Floats, solutions: npt.NDArray[np.uint8]
    ) -> IkMargin: ...

@final
class PoseCheck(_Record):
    """Whether a pose can be reached."""

    @property
    def reachable(self) -> bool:
        """Some joint vector brings the tool there."""
    @property
    def within_limits(self) -> bool:
        """One of them is inside the joint limits."""
    @property
    def reason(self) -> str:
        """The outcome in a sentence."""
    def __new__(cls, reachable: bool, within_limits: bool, reason: str) -> PoseCheck: ...

@final
class CatalogEntry(_Record):
    """Data of an arm in the catalog."""

    @property
    def name(self) -> str:
        """The maker's type name."""
    @property
    def maker(self) -> Literal["ABB", "Universal Robots", "Franka", "FANUC", "UFACTORY"]:
        """The maker: "ABB", "Universal Robots", "Franka", "FANUC" or "UFACTORY"."""
    @property
    def aliases(self) -> tuple[str, ...]:
        """Other names that `Robot` takes for it, beside spellings in which case, blanks and
        dashes differ.
        """
    @property
    def dof(self) -> int:
        """Number of joints."""
    @property
    def payload(self) -> float | None:
        """Payload [kg], as the type name or the data sheet gives it; of several generations the
        least. None where it is not known.
        """
    @property
    def reach(self) -> float | None:
        """Reach [m], as the type name or the data sheet gives it: rounded, of ABB's arms to the
        wrist center. None where it is not known.
        """
    @property
    def limits(self) -> _Floats:
        """Lower and upper limit of each joint [rad], shape (n, 2)."""
    @property
    def max_velocity(self) -> _Floats | None:
        """Largest velocity of each joint [rad/s], shape (n,), or None where no source has it."""
    @property
    def max_acceleration(self) -> _Floats | None:
        """Largest acceleration of each joint [rad/s^2], shape (n,), or None where no source has
        it.
        """
    @property
    def is_coupled(self) -> bool:
        """Whether a parallelogram linkage couples axes 2 and 3."""
    @property
    def sources(self) -> int:
        """Number of independent sources of the lengths: the confidence in them."""
    @property
    def provenance(self) -> str:
        """These sources; after semicolons, of other figures, what disagrees, what is not
        modeled.
        """
    def __new__(
        cls,
        name: str,
        maker: Literal["ABB", "Universal Robots", "Franka", "FANUC", "UFACTORY"],
        aliases: tuple[str, ...],
        dof: int,
        payload: float | None,
        reach: float | None,
        limits: _Floats,
        max_velocity: _Floats | None,
        max_acceleration: _Floats | None,
        is_coupled: bool,
        sources: int,
        provenance: str,
    ) -> CatalogEntry: ...
    def to_dict(self) -> dict[str, Any]:
        """Return the figures of the arm by name, a row of a table: `pandas.DataFrame` and
        `polars.DataFrame` take a list of them, `[irbkin.catalog_entry(name).to_dict() for name in
        irbkin.catalog()]`.

        Returns:
            `name`, `maker`, `dof`, `payload` [kg], `reach` [m], `is_coupled` and `sources`.
        """

@final
class TrajectorySample(_Record):
    """The state of the joints at times."""

    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (..., n)."""
    @property
    def dq(self) -> _Floats:
        """Joint velocities [rad/s], shape (..., n)."""
    @property
    def ddq(self) -> _Floats:
        """Joint accelerations [rad/s^2], shape (..., n)."""
    def __new__(cls, q: _Floats, dq: _Floats, ddq: _Floats) -> TrajectorySample: ...

@final
class MotionPeaks(_Record):
    """The largest sizes of each joint's derivatives."""

    @property
    def velocity(self) -> _Floats:
        """Velocities [rad/s], shape (n,)."""
    @property
    def acceleration(self) -> _Floats:
        """Accelerations [rad/s^2], shape (n,)."""
    @property
    def jerk(self) -> _Floats:
        """Jerks [rad/s^3], shape (n,)."""
    def __new__(cls, velocity: _Floats, acceleration: _Floats, jerk: _Floats) -> MotionPeaks: ...

@final
class ToolSpeedLimits(_Record):
    """The constant speed of the tool along a path that the limits of the joints allow."""

    @property
    def speed(self) -> _Floats:
        """The highest at each sample [m/s], shape (m,); infinite where no limit binds."""
    @property
    def joint(self) -> npt.NDArray[np.int64]:
        """The joint that limits it, from 1, shape (m,); 0 where none does."""
    @property
    def fastest(self) -> float:
        """The fastest constant speed on the whole path [m/s], between the samples too."""
    @property
    def fastest_joint(self) -> int:
        """The joint that limits the fastest speed, from 1; 0 where none does."""
    @property
    def fastest_index(self) -> int:
        """The sample at which it does, or the last one before the place."""
    def __new__(
        cls,
        speed: _Floats,
        joint: npt.NDArray[np.int64],
        fastest: float,
        fastest_joint: int,
        fastest_index: int,
    ) -> ToolSpeedLimits: ...

@final
class PlanBreak(_Record):
    """A part of a path that the joints cannot follow."""

    @property
    def leave(self) -> int | None:
        """The last pose before it; None where the path begins with it."""
    @property
    def enter(self) -> int | None:
        """The first pose after it; None where the path ends with it."""
    def __new__(cls, leave: int | None, enter: int | None) -> PlanBreak: ...

@final
class StrandEnd(_Record):
    """Where and why a branch of a path ends."""

    @property
    def slot(self) -> int:
        """Its slot."""
    @property
    def pose_index(self) -> int:
        """The first pose that it does not reach."""
    @property
    def reason(self) -> str:
        """The reason in a sentence."""
    def __new__(cls, slot: int, pose_index: int, reason: str) -> StrandEnd: ...

@final
class Plan(_Record):
    """The best joint path along a path of poses."""

    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (m, n); NaN where a plan with breaks has none."""
    @property
    def tool_angle(self) -> _Floats:
        """The angle by which the tool is turned at each pose [rad], shape (m,), without jumps of
        a full turn; zeros without a free rotation.
        """
    @property
    def slot(self) -> npt.NDArray[np.int64]:
        """The slot of the branch at each pose, shape (m,); -1 without a branch."""
    @property
    def external(self) -> _Floats:
        """Values of the external axes of `carrier` at each pose [m, rad], shape (m, k); NaN
        where a plan with breaks has none.
        """
    @property
    def tolerance(self) -> _Floats:
        """Deviation within `tolerance` at each pose, shape (m, t): the tilts about the two axes
        that the tool does not point in [rad]; t is 0 without a cone.
        """
    @property
    def cost(self) -> float:
        """Weighted sum of the squares of all joint steps, with the costs of being near limits
        and singularities [rad^2].
        """
    @property
    def bottleneck(self) -> float:
        """The largest velocity of a joint as a part of its limit. Without `times`, the time [s]
        that the path takes at least if its poses are equally far apart in time.
        """
    @property
    def breaks(self) -> tuple[PlanBreak, ...]:
        """Each `PlanBreak`: empty, but for the plan of a `PathError`."""
    @property
    def certified(self) -> bool:
        """Whether every step, apart from breaks, was shown to be continuous between its two
        poses.
        """
    @property
    def T(self) -> _Floats:
        """Pose of the tool at each pose of the path, `robot.fk(plan.q)`, shape (m, 4, 4),
        translation [m]: with all that `rotation` and `tolerance` add to the path, and with
        external axes as the arm sees it, its base where the robot has it. NaN where `q` is.
        """
    def __new__(
        cls,
        q: _Floats,
        tool_angle: _Floats,
        slot: npt.NDArray[np.int64],
        external: _Floats,
        tolerance: _Floats,
        cost: float,
        bottleneck: float,
        breaks: tuple[PlanBreak, ...],
        certified: bool,
        T: _Floats,
    ) -> Plan: ...
    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the plan as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
        table.

        Returns:
            Arrays of shape (m,) by name: `q1` .. [rad]; `tool_angle` [rad]; `slot`; `external1` ..
            [m, rad] and `tolerance1` .. [rad, m] of a plan that has them; `x`, `y`, `z` of `T` [m].
        """
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write comma-separated values: the columns of `to_dict` under their names, each number
        with all of its digits, nothing for None.

        Args:
            path_or_file: Path of the file, or a file that is open for text.

        Raises:
            OSError: The file cannot be written.
        """

@final
class Robot:
    """A robot arm of six or seven joints: `Robot("IRB 2600-12/1.65")`.

    Frozen, hashable, equal by value, picklable. Other arms come from `from_mdh`, `from_sdh`,
    `from_opw`, `from_urdf` and `from_robotstudio`. Its arrays are read-only: change a copy, and
    pass that to `with_limits`, `with_tool` or `with_base`.

    Args:
        name: Catalog name or alias, the maker's name before it or not; case, blanks, -, _, /,
            commas and parentheses do not matter. `irbkin.catalog()` lists the names.
        tool: As of `with_tool`; the flange when not given.
        base: As of `with_base`; the world when not given.

    Raises:
        UnknownRobotError: No arm of that name; the message has up to six close ones, the closest
            first, or why the arm is left out of the catalog.
        InvalidPoseError, RapidError: As `with_tool` and `with_base`.
    """

    def __new__(
        cls,
        name: str,
        *,
        tool: npt.ArrayLike | ToolData | None = None,
        base: npt.ArrayLike | None = None,
    ) -> Robot: ...
    @staticmethod
    def from_mdh(
        rows: npt.ArrayLike,
        limits: npt.ArrayLike | None = None,
        name: str = "",
        *,
        snap: float = 0.0,
    ) -> Robot:
        """Robot from a modified (Craig) Denavit-Hartenberg table: Rx(alpha) Tx(a) Rz(theta + q)
        Tz(d).

        Args:
            rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, shape (6, 4) or (7,
                4).
            limits: Lower and upper limit of each joint [rad], shape (n, 2); none when not given.
            name: A name of your own.
            snap: An alpha or theta offset within this of a multiple of 90 deg is made exact [rad],
                at most 1e-3: 1e-5 takes 1.5708 for a right angle. Lengths stay as they are.

        Raises:
            InvalidModelError: A number is not finite, a limit is empty, or six joints are not
                independent: the message names the axes. Of a robot of structure "general",
                `print(robot)` shows what keeps it from a closed form, and a `snap` that suffices.
        """
    @staticmethod
    def from_sdh(
        rows: npt.ArrayLike,
        limits: npt.ArrayLike | None = None,
        name: str = "",
        *,
        snap: float = 0.0,
    ) -> Robot:
        """Robot from a standard Denavit-Hartenberg table: Rz(theta + q) Tz(d) Tx(a) Rx(alpha).

        Args:
            rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, in this order too,
                shape (6, 4) or (7, 4).
            limits: As of `from_mdh`.
            name: As of `from_mdh`.
            snap: As of `from_mdh`.

        Raises:
            InvalidModelError: As `from_mdh`.
        """
    @staticmethod
    def from_opw(
        *,
        a1: float,
        a2: float,
        b: float,
        c1: float,
        c2: float,
        c3: float,
        c4: float,
        offsets: npt.ArrayLike | None = None,
        signs: npt.ArrayLike | None = None,
        limits: npt.ArrayLike | None = None,
        name: str = "",
    ) -> Robot:
        """Robot from Brandstoetter's parameters of an ortho-parallel arm with a spherical wrist,
        which is straight up along z at zero theta.

        Args:
            a1: Distance of axis 2 from axis 1 [m].
            a2: Elbow offset [m]: distance of axis 4 from axis 3, negative where it lifts the
                forearm of an ABB arm at zero.
            b: Lateral offset of the wrist center from the plane through axis 1 [m].
            c1: Height of axis 2 [m].
            c2: Upper arm [m]: distance of axis 3 from axis 2.
            c3: Forearm [m]: distance of the wrist center from axis 3, along axis 4.
            c4: Distance of the flange from the wrist center [m].
            offsets: Joint offsets [rad], shape (6,): theta = sign * q - offset, as opw_kinematics
                has it; zeros when not given.
            signs: Joint signs, each 1 or -1, shape (6,); ones when not given.
            limits: Lower and upper limit of each joint [rad], shape (6, 2); none when not given.
            name: A name of your own.

        Raises:
            InvalidModelError: A number is not finite, a sign is not 1 or -1, a limit is empty, or a
                link has no length.
        """
    @staticmethod
    def from_urdf(
        text_or_path: str | bytes | PathLike[str],
        base: str | None = None,
        tip: str | None = None,
        name: str = "",
        *,
        snap: float = 0.0,
    ) -> Robot:
        """Robot from a URDF: the revolute and continuous joints between two links, with their
        limits and velocities, and a body of the collision shapes.

        Links behind joints beside the arm, as of a gripper, are in the body wherever these joints
        may be. With a mesh, or a shape that is not valid, there is no body. See
        docs/guide/bodies.md.

        Args:
            text_or_path: The text, str that begins with "<" or bytes, or the path of a file, of
                URDF 1.0 to 1.2. Xacro must be expanded first. Of a text that others send give
                bytes, which name no file.
            base: Link in whose frame poses are given; the one without a parent when not given.
            tip: Link that poses are of; when not given, the only one at the end of a chain of six
                or seven joints, if the last of these can be no gripper's.
            name: A name of your own; the URDF's when not given.
            snap: An angle of an origin, or an axis, within this of a multiple of 90 deg is made
                exact [rad], at most 1e-3: 1e-5 takes 1.5708 for a right angle. Lengths stay as they
                are.

        Raises:
            InvalidModelError: The text is not a URDF, several links could be meant, there are not
                six or seven joints, a joint between base and tip is not revolute, continuous or
                fixed, an unknown attribute could move a joint, or six joints are not independent;
                the message names what is wrong, and the base and tip that could be passed.
            OSError: The file cannot be read.
        """
    @staticmethod
    def from_robotstudio(
        path: str | PathLike[str], name: str | None = None, *, coupled_limits: bool = True
    ) -> Robot:
        """Robot from a file of ABB's RobotStudio: its table, base frame, flange and limits.

        A station that only refers to ABB's libraries has the axes alone: the robot then has no
        limits, its flange is the frame of the last axis, and its name says so. See
        docs/guide/robotstudio.md.

        Args:
            path: A library, .rslib, or a station, .rsstn, .rsstnx or .rspag.
            name: Name of the arm in the file; needed if the file has several.
            coupled_limits: False to leave out limits that couple axes. Only a robot with a linkage
                can have them, and only of axes 2 and 3: of any other they are an error.

        Raises:
            InvalidModelError: The file has another format, is broken or too large, no arm or
                several could be meant, a joint is not revolute or follows others, or the file
                contradicts itself; the message names the element and the bound.
            OSError: The file cannot be read.
        """
    def to_urdf(self, visual: bool = False) -> str:
        """Return the text of a URDF of the robot, which `from_urdf` reads back.

        Links are `base_link`, `link_1` .., `flange` and `tool0` (irbkin's flange, z out of it);
        `world` with a base, `tool` with a tool. Joints are `joint_1` .., velocities 1e5 if unknown.
        A parallelogram linkage is a joint that mimics `joint_2`; `uncoupled().to_urdf()` has none.
        See docs/guide/urdf.md.

        Args:
            visual: Whether links get the capsules of `body` as `visual` and `collision` elements, a
                cylinder and two spheres each. What the flange carries is of `tool0`.

        Raises:
            InvalidModelError: visual, and the robot has no body.
        """
    @property
    def name(self) -> str:
        """Catalog name, or the name given by the caller."""
    @property
    def dof(self) -> int:
        """Number of joints."""
    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints, as in the URDF that the robot was read from; "J1" .. of any
        other.
        """
    @property
    def _file_joint_names(self) -> list[str] | None:
        """The names that a file gives the joints; None without a file."""
    @property
    def structure(
        self,
    ) -> Literal[
        "spherical wrist",
        "three parallel axes",
        "spherical shoulder",
        "offset wrist",
        "general",
        "refined spherical wrist",
        "refined three parallel axes",
        "unknown",
    ]:
        """Kinematic structure: "spherical wrist", "three parallel axes", "spherical shoulder",
        "offset wrist", or "general" for any other; "refined spherical wrist" or "refined three
        parallel axes" after `with_nominal`; "unknown" if the first six joints are not
        independent. `print(robot)` shows what keeps the arm from a structure with a closed form,
        which is faster, and a `snap` or another reading of its table that would give it one.
        """
    @property
    def mdh(self) -> _Floats:
        """Modified Denavit-Hartenberg rows: alpha [rad], a [m], d [m], theta offset [rad], shape
        (n, 4). `flange` follows the last row. Read-only: `from_mdh` takes another table.
        """
    @property
    def _root(self) -> _Floats:
        """Fixed transform from the base to the frame before the first row of `mdh`, shape (4,
        4).
        """
    @property
    def flange(self) -> _Floats:
        """Fixed transform from the last frame of `mdh` to the flange, shape (4, 4)."""
    @property
    def base(self) -> _Floats:
        """Pose of the base in the world, shape (4, 4). Read-only: `with_base` takes another one."""
    @property
    def tool(self) -> _Floats:
        """Pose of the tool center point in the flange frame, shape (4, 4). Read-only:
        `with_tool` takes another one.
        """
    @property
    def limits(self) -> _Floats:
        """Lower and upper limit of each joint [rad], shape (n, 2); infinite where a joint has
        none. Read-only: change a copy, and pass that to `with_limits`.
        """
    @property
    def max_velocity(self) -> _Floats | None:
        """Largest velocity of each joint [rad/s], shape (n,), or None where it is not known.
        Read-only.
        """
    @property
    def body(self) -> Body | None:
        """The shapes of its links, an `irbkin.body.Body`: of an arm of the catalog, capsules
        that contain a public mesh or, without one, `approximate_body()`. None of an arm of your
        own until `with_body`.
        """
    def approximate_body(self) -> Body:
        """Return a body made of the lengths of the kinematic table: capsules along its lines,
        thicker towards the base. The arm may be outside of it; see docs/guide/cell.md.

        Raises:
            InvalidModelError: The lengths of the table are more than ten times the size of the arm.
        """
    def with_attached(
        self,
        shapes: Shape | Sequence[Shape],
        pose: npt.ArrayLike | None = None,
        *,
        excess: float | None = None,
    ) -> Robot:
        """Return the robot with shapes that its flange carries, besides those it has: a tool, a
        work piece. They are link n + 1 of its body, in the flange frame.

        Capsules contain each shape. They are kept apart from links 0 to n - 2, unless they touch
        one in each of 64 postures that fill the limits.

        Args:
            shapes: A `Shape`, or several.
            pose: Pose of the shapes in the flange frame `tool0`, shape (4, 4), or its position
                alone [m], shape (3,); the identity when not given. The tool center point does not
                move them: pass `robot.tool` if they are in its frame.
            excess: How far the capsules may be outside the shape [m]; when not given, at most four
                capsules with the least excess, which `body.excess[n + 1]` has.

        Raises:
            InvalidModelError: The robot has no body, a shape is a half space or reaches farther
                from the flange than the arm, or the excess needs more than 100 capsules for a
                shape.
            InvalidPoseError: pose is not a rigid transform.
        """
    def with_body(self, body: Body | None) -> Robot:
        """Return the robot with other shapes of its links, or without.

        Raises:
            InvalidModelError: A capsule of a link that the arm does not have.
        """
    def random(self, n: int | None = None, rng: np.random.Generator | int | None = None) -> _Floats:
        """Draw joint vectors uniformly inside the limits, of a linkage too. A joint without limits
        is within +-180 deg, one with a single limit within a full turn of it; a joint of `locked`
        stays at its angle.

        Args:
            n: Number of joint vectors; one alone, without a leading dimension, when not given.
            rng: A `numpy.random.Generator`, or a seed for one; a seed of the system's when not
                given.

        Returns:
            Joint vectors [rad], shape (n, dof), or (dof,) without n.

        Raises:
            InvalidModelError: The limits of axes 2 and 3 leave a linkage no room.
        """
    def with_tool(self, T: npt.ArrayLike | ToolData) -> Robot:
        """Return the robot with another tool, in place of the one that it had.

        Args:
            T: Pose of the tool center point in the flange frame, shape (4, 4), translation [m]; or
                its translation alone, shape (3,); or a `rapid.ToolData` that the robot holds.

        Raises:
            InvalidPoseError: T is not a rigid transform, has a wrong shape, or is longer than ten
                times the size of the arm.
            RapidError: The tool is stationary.
        """
    def with_base(self, T: npt.ArrayLike) -> Robot:
        """Return the robot with another base, in place of the one that it had; poses are then given
        in the world.

        Args:
            T: Pose of the base in the world, shape (4, 4), translation [m]; or its translation
                alone, shape (3,).

        Raises:
            InvalidPoseError: T is not a rigid transform or has a wrong shape.
        """
    def with_limits(self, limits: npt.ArrayLike) -> Robot:
        """Return the robot with other joint limits; limits of a linkage stay.

        Args:
            limits: Lower and upper limit of each joint [rad], shape (n, 2); infinite for none.

        Raises:
            InvalidModelError: A limit is NaN, a lower one is above the upper one, or the shape is
                wrong.
        """
    @property
    def is_coupled(self) -> bool:
        """Whether axes 2 and 3 are coupled, by a parallelogram linkage or by the controller: q3
        is then measured from the base.
        """
    @property
    def linkage_limits(self) -> _Floats | None:
        """Lower and upper limit of the serial joint 3 [rad], shape (2,), of a robot with coupled
        axes 2 and 3: of q3 of `uncoupled()`. None where none are known.
        """
    def with_linkage_limits(self, limits: npt.ArrayLike | None) -> Robot:
        """Return the robot, whose axes 2 and 3 are coupled, with other limits of the serial joint
        3, the angle of a parallelogram linkage.

        Args:
            limits: Lower and upper limit of q3 of `uncoupled()` [rad], shape (2,), met by any 2 pi
                equivalent; None for none.

        Raises:
            InvalidModelError: A limit is NaN, the lower one is above the upper one, or axes 2 and 3
                are not coupled.
        """
    def uncoupled(self) -> Robot:
        """Return the twin without the coupling of axes 2 and 3: its q3 is this robot's q3 - q2 or,
        if the axes turn in opposite senses, q3 + q2. The robot itself where it has no coupling.

        The limits of its joint 3 are `linkage_limits` or, where these are not known, the range of
        its q3 inside the limits of both axes. Its velocity is the sum of both. `coupled()` of the
        twin therefore has wider limits and a higher velocity than this robot.
        """
    def coupled(self) -> Robot:
        """Return the twin whose axes 2 and 3 are coupled: it measures q3 from the base, as
        controllers do of arms with a parallelogram linkage, and Fanuc's pendants of all. Its q3 is
        this robot's q3 + q2 or, if axes 2 and 3 turn in opposite senses, as in Fanuc's URDFs, q3 -
        q2.

        The limits of joint 3 become `linkage_limits`. The limits of its joint 3 are the range that
        axis 2 and the linkage allow, and its velocity is the sum of both. `uncoupled()` of the twin
        therefore has wider limits and a higher velocity than this robot.

        Raises:
            InvalidModelError: Axes 2 and 3 are not parallel, the arm has seven joints, or it is a
                GoFa, whose controller measures joint 3 from the upper arm.
        """
    def fk(self, q: npt.ArrayLike, out: _Floats | None = None) -> _Floats:
        """Forward kinematics: the pose of the tool.

        Args:
            q: Joint angles [rad], shape (..., n).
            out: Array to write to, shape (..., 4, 4), float64, C-contiguous; it is returned.

        Returns:
            Homogeneous matrices, shape (..., 4, 4), translation [m]. In a batch, a row with a NaN
            or inf gives NaN.

        Raises:
            InvalidJointsError: A wrong shape, a single joint vector that is not finite, or one, or
                most of many, more than four turns outside the limits, as degrees are.
        """
    def link_frames(self, q: npt.ArrayLike, out: _Floats | None = None) -> _Floats:
        """Every frame of the modified Denavit-Hartenberg table after its joint, then the tool.

        Args:
            q: Joint angles [rad], shape (..., n).
            out: Array to write to, shape (..., n + 1, 4, 4), float64, C-contiguous; it is returned.

        Returns:
            Homogeneous matrices, shape (..., n + 1, 4, 4), translation [m]. In a batch, a row with
            a NaN or inf gives NaN.

        Raises:
            InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
        """
    def jacobian(
        self, q: npt.ArrayLike, frame: Literal["base", "tool"] = "base", out: _Floats | None = None
    ) -> _Floats:
        """Geometric Jacobian of the tool.

        Args:
            q: Joint angles [rad], shape (..., n).
            frame: "base", the frame in which poses are given, or "tool".
            out: Array to write to, shape (..., 6, n), float64, C-contiguous; it is returned.

        Returns:
            Shape (..., 6, n): three linear rows [m/rad], then three angular [1].

        Raises:
            InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
            ValueError: Another frame.
        """
    def with_nominal(self, nominal: Robot | str) -> Robot:
        """Return the robot, of a calibrated table, solved from the branches of its nominal robot:
        each is brought onto the pose by Newton's method, in a microsecond more than the closed
        form.

        Slots are the nominal robot's. The answer is not complete: a pair of branches that the
        nominal robot does not have is not seen, which happens next to a fold; and a branch whose
        refinement fails has its slot flagged MERGED. Meant for tracking, `ik_nearest`, `follow` and
        `plan`. Rates: docs/guide/calibrate.md.

        Args:
            nominal: A Robot with a closed form, or its catalog name. Its base, tool, limits and
                coupling do not count.

        Raises:
            UnknownRobotError: No arm of that name.
            InvalidModelError: The nominal robot has no closed form, or its tool is more than 0.05
                rad, or 0.05 of its reach, from this robot's.
        """
    def with_corrections(self, corrections: npt.ArrayLike) -> Robot:
        """Return the robot with corrected base, table and tool: what `irbkin.calibrate` makes of
        it.

        Corrections of base and tool alone leave the structure as it is. Limits, velocities, name
        and a coupling of axes 2 and 3 are kept: `theta` of row 3 corrects the serial joint 3. See
        docs/guide/calibrate.md.

        Args:
            corrections: What is added to each parameter, shape (12 + 5 n,): x, y, z [m], rx, ry, rz
                [rad] of the frame before the first row of `mdh`, along and about its own axes; of
                each row alpha [rad], a [m], d [m], theta [rad] and beta [rad], a rotation about y
                after alpha and a; x, y, z, rx, ry, rz of the tool.

        Raises:
            InvalidModelError: A correction is not finite, the shape is wrong, the corrected table
                is not a table, or it leaves coupled axes 2 and 3 more than 0.05 rad off parallel.
        """
    def _parameter_jacobian(
        self,
        q: npt.ArrayLike,
        corrections: npt.ArrayLike | None = None,
        out: _Floats | None = None,
    ) -> _Floats:
        """Jacobian of the tool in the parameters of the robot: how each of them moves it.

        Args:
            q: Joint angles [rad], shape (..., n).
            corrections: Where it is taken, shape (12 + 5 n,), as in `with_corrections`; at the
                robot as it is when not given.
            out: Array to write to, shape (..., 6, 12 + 5 n), float64, C-contiguous; it is returned.

        Returns:
            Shape (..., 6, 12 + 5 n), columns as the corrections: three linear rows [m/rad] or
            [m/m], then three angular [1] or [rad/m], in the frame of the poses.

        Raises:
            InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
            InvalidModelError: Corrections of a wrong shape, or one that is not finite.
        """
    def _corrected_fk(self, q: npt.ArrayLike, corrections: npt.ArrayLike) -> _Floats: ...
    def singularity(
        self,
        q: npt.ArrayLike,
        *,
        threads: int = 1,
    ) -> Singularity:
        """How far joint vectors are from the singularities.

        Args:
            q: Joint angles [rad], shape (..., n).
            threads: Number of threads; 0 for one a core.

        Returns:
            Singularity; numbers for (n,), arrays of shape (...) for (..., n). NaN where an arm has
            no such singularity. In a batch, a row with a NaN or inf gives NaN, and its `kinds` are
            `irbkin.Status.INVALID`, 64.

        Raises:
            InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
        """
    def ik(
        self,
        T: npt.ArrayLike,
        q7: float | None = None,
        *,
        given: Mapping[int, float] | None = None,
    ) -> Solutions:
        """Every joint vector that brings the tool to a pose.

        Args:
            T: Pose of the tool, shape (4, 4), translation [m].
            q7: Angle of joint 7 [rad], of an arm of seven joints.
            given: In place of q7, another joint of seven with its angle, as {3: 0.2}: joints count
                from 1. `robot.ik(T, given={3: 0.2})` is `robot.locked({3: 0.2}).ik(T)`.

        Returns:
            Solutions, each in its slot, limits not regarded; empty with `reach` and `shortfall`
            when out of reach.

        Raises:
            InvalidPoseError: T has a wrong shape, is not finite or not a rigid transform.
            InvalidJointsError: q7 is not finite, or the joint does not exist.
            InvalidModelError: The other six joints do not move the tool in six independent ways.
            TypeError, ValueError: q7 is missing, or the arm has six joints and it is not; given
                does not map one joint, or stands beside q7.
        """
    def ik_batch(
        self,
        T: npt.ArrayLike,
        q7: npt.ArrayLike | None = None,
        *,
        given: Mapping[int, npt.ArrayLike] | None = None,
        out: IkBatch | tuple[_Floats, npt.NDArray[np.uint8]] | _Floats | None = None,
        threads: int = 1,
    ) -> IkBatch:
        """Every joint vector of many poses.

        Args:
            T: Poses of the tool, shape (..., 4, 4), translation [m].
            q7: Angles of joint 7 [rad] of an arm of seven joints, of a shape that goes with (...):
                T and q7 are broadcast.
            given: In place of q7, another joint of seven with its angle, as {3: 0.2}. The angles of
                the first and the last joint may be an array that goes with (...).
            out: Where to write: an IkBatch or tuple of arrays (..., slots, n) float64 and (...,
                slots) uint8, or the first of them alone.
            threads: Number of threads; 0 for one a core.

        Returns:
            IkBatch(q, status): joint angles [rad], shape (..., slots, n), NaN where a slot is
            empty, and `irbkin.Status` of each slot, shape (..., slots), uint8. Slots are 8 or 16,
            as the structure has them. A row whose pose or q7 is invalid has status INVALID; it
            does not affect the others.

        Raises:
            InvalidPoseError: T has a wrong shape.
            InvalidJointsError: q7 has a wrong shape.
            InvalidModelError: The first six joints do not move the tool in six independent ways.
            TypeError: q7 is missing, or the arm has six joints and it is not.
        """
    def ik_nearest(
        self,
        T: npt.ArrayLike,
        seed: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        *,
        out: _Floats | None = None,
        threads: int = 1,
        cell: Cell | None = None,
    ) -> _Floats:
        """The solution inside the limits that is nearest to `seed`, turns considered; without a
        seed nearest to the middle of the limits.

        Args:
            T: Poses of the tool, shape (..., 4, 4), translation [m].
            seed: Joint vectors [rad], shape (..., n). T and seed are broadcast: one seed for many
                poses, one pose for many seeds. Of joints that the pose leaves free, the nearest
                angles are taken. When not given, the middle of the limits; 0 for a joint without
                a limit, or that turns by more than 720 deg.
            weights: Cost of moving each joint, shape (n,); ones when not given.
            out: Array to write to, shape (..., n), float64, C-contiguous; it is returned.
            threads: Number of threads; 0 for one a core.
            cell: Only solutions that do not collide in an `irbkin.Cell`; with seven joints, of
                those that the search passes.

        Returns:
            Joint vectors [rad], shape (..., n). In a batch, a row without a solution, or whose pose
            or seed is invalid, is NaN.

        Raises:
            UnreachableError: A single pose has no solution inside the limits, or all collide; the
                message says what is missing, or what collides.
            InvalidPoseError, InvalidJointsError, InvalidModelError: As `ik`; a seed or weight that
                is not finite; a seed, or most of many, more than four turns outside the limits; a
                single pose or seed for a whole batch that is invalid.
        """
    def margin(self, q: npt.ArrayLike, *, threads: int = 1) -> Margin:
        """How far joint vectors are from limits and singularities, as parts of the farthest that
        they can be.

        Args:
            q: Joint angles [rad], shape (..., n).
            threads: Number of threads; 0 for one a core.

        Returns:
            Margin: two arrays of shape (...), 1 in the middle, 0 at a limit or a singularity,
            negative outside limits. Of many rows, one with a NaN or inf gives NaN.

        Raises:
            InvalidJointsError: A wrong shape, or a single row with a NaN or inf.
        """
    def ik_margin(
        self,
        T: npt.ArrayLike,
        q7: npt.ArrayLike | None = None,
        *,
        threads: int = 1,
        cell: Cell | None = None,
    ) -> IkMargin:
        """How much room the solutions of poses leave to limits and singularities: `ik_batch` and
        `margin` in one call, which keeps the best of each pose.

        Args:
            T: Poses of the tool, shape (..., 4, 4), translation [m].
            q7: Angle of joint 7 [rad], shape (...), of an arm of seven joints.
            threads: Number of threads; 0 for one a core.
            cell: Only solutions that do not collide in an `irbkin.Cell`.

        Returns:
            IkMargin: the largest margin of the solutions inside the limits, their largest distance
            from singularities, and their number, arrays of shape (...).

        Raises:
            InvalidPoseError: A wrong shape. An invalid pose has no solution.
            InvalidModelError: The first six joints do not move the tool in six independent ways;
                with `cell`, the robot has no body.
            TypeError: `q7` of an arm of six joints, or none of one of seven.
        """
    def plan(
        self,
        T: npt.ArrayLike,
        *,
        rotation: ToolRotation | int | None = None,
        times: npt.ArrayLike | None = None,
        start: npt.ArrayLike | None = None,
        end: npt.ArrayLike | None = None,
        closed: bool = False,
        weights: npt.ArrayLike | None = None,
        accept: Callable[[_Floats], npt.ArrayLike] | None = None,
        cell: Cell | None = None,
        carrier: Track | Positioner | Sequence[Track | Positioner] | None = None,
        tolerance: ToolCone | None = None,
        redundancy: int | None = None,
        order: Literal["bottleneck", "sum"] = "bottleneck",
        limit_cost: float = 0.0,
        singularity_cost: float = 0.0,
        objective: Literal["time"] | None = None,
        max_acceleration: npt.ArrayLike | None = None,
        progress: Report | Bar | None = None,
    ) -> Plan:
        """The best joint path along a path of poses, over every branch, every turn of the joints
        and, with `rotation`, every angle of the tool.

        Of all continuous joint paths inside the limits, that with the smallest bottleneck: the
        largest joint velocity relative to `max_velocity` (1 rad/s where that is not known). Of
        those, that with the smallest weighted sum of squared joint steps and of what being near
        limits and singularities costs; `order` makes the sum come first. Both are exact over the
        tool angles of `rotation`, which are then refined around the best ones, to half a degree. A
        path of 64 poses or more with free axes is planned along some of its poses first, then in
        bands around that plan. At last, free axes leave their grid: they are smoothed, so that
        joints accelerate little; that raises the bottleneck by at most 3 %, never above the one
        with nothing free, and never the sum if it comes first. Every step of the answer is shown
        to be continuous between its two poses.

        Of seven joints, joint 7 is one more external axis, or joint 1 if that makes the better
        plan. Where neither leads through, since the other six are singular on the way, the plan is
        a path of `follow`. Costs of limits and singularities are of the other six.

        Args:
            T: Poses of the tool, shape (m, 4, 4), translation [m].
            rotation: The angles by which the tool may be turned about its own axis: an
                `irbkin.ToolRotation`, or the number of angles all around z. None where the poses
                fix the orientation.
            times: Time of each pose [s], shape (m,), increasing. Then no joint may exceed its
                `max_velocity`, if that is known.
            start: Joint vector at the first pose [rad], shape (n,), with the values of the external
                axes behind it, if there are any, shape (n + k,); any when not given.
            end: The same at the last pose.
            closed: Whether the joints must end where they start, turns included. The last pose
                repeats the first.
            weights: Cost of moving each joint, shape (n,); ones when not given.
            accept: Your own test, of collisions for instance: called with joint vectors of shape
                (k, n), it returns k truth values. It is asked only for joint vectors near the best
                path, and once for those that differ by full turns.
            cell: An `irbkin.Cell` in which the plan is proven free (`Cell.check_path`): at the
                poses and between them, each joint moving evenly from one to the next; not with a
                carrier, which moves the base.
            carrier: External axes: an `irbkin.Track`, an `irbkin.Positioner`, or up to three of
                them. Their steps count for bottleneck and cost as steps of joints do.
            tolerance: How far the tool may be tilted from the poses: an `irbkin.ToolCone`.
            redundancy: Number of angles of joint 7 or 1 that are searched first, of an arm of seven
                joints none of which is locked; 36 when not given. The joint is one of at most three
                external axes.
            order: What of two paths makes the better one: "bottleneck", then the sum; or "sum"
                alone.
            limit_cost: What a joint at its limit costs [rad^2/s^2], added to the sum: as much as
                one of weight 1 that moves with the root of it [rad/s]. Half way from the middle to
                the limit it costs a quarter. Without `times` the path takes one second.
            singularity_cost: The same of each singularity that `Margin` counts.
                Nothing for arms without a closed form.
            objective: "time": of the best paths in either order from each branch of the first pose,
                the one whose motion `irbkin.trajectory.retime` makes the shortest, everything that
                is free smoothed for that. None: the pace is even, or given by `times`.
            max_acceleration: Limits of that motion [rad/s^2]: a number, or one for each joint and
                external axis, shape (n + k,).
            progress: Called with how much work is done, and with all that is known of so far, which
                grows while the plan is refined; or a bar as `tqdm.tqdm()`.

        Returns:
            Plan: joints [rad], shape (m, n); tool angles; slots; external axes, shape (m, k);
                tolerances; cost; bottleneck; no breaks.

        Raises:
            PathError: No continuous joint path: `index` is the first pose that no branch reaches
                from the start, `end_index` the last one from which none reaches the end, `reasons`
                says where and why each branch ends, `plan` is the plan with the fewest breaks.
            InvalidPoseError: T has a wrong shape or holds an invalid pose; the message has its
                index.
            InvalidJointsError: A start, end or weight that is not finite, or a start or end that
                does not fit its pose or the limits.
            InvalidMotionError: No poses, two poses half a turn apart, times that do not increase, a
                rotation, carrier or tolerance that is empty, an open path with `closed`, a cost
                that is negative or not finite.
            ValueError: Another `order`.
            TypeError: redundancy of an arm of six joints.
            Exception: Whatever `accept` raises.
        """
    def go(
        self,
        start: npt.ArrayLike,
        goal: npt.ArrayLike,
        cell: Cell | None = None,
        *,
        seconds: float = 2.0,
        seed: int = 0,
        max_velocity: npt.ArrayLike | None = None,
        max_acceleration: npt.ArrayLike | None = None,
        steps: int = 100,
    ) -> Trajectory:
        """Move from joint angles or a pose to joint angles or a pose, from rest to rest, without
        touching anything: the motion is proven free at every instant (`Cell.check_path`).

        A pose is left or reached by any of its solutions inside the limits, at the turns of the
        joints that are near the other end; of seven joints with joint 7 at 24 angles. If the joints
        can move evenly to a goal, they do. Otherwise a path is sought by samples from both ends
        (RRT-Connect), shortened, its corners rounded as far as that is free, and timed. One seed
        gives one motion. A locked joint stays at its angle.

        Args:
            start: Joint angles [rad], shape (n,), or a pose of the tool, shape (4, 4).
            goal: The same.
            cell: What is around the arm; when not given, the arm stays clear of itself.
            seconds: How long is sought [s].
            seed: Which samples are taken, a whole number from 0 on.
            max_velocity: Limits [rad/s], a number or shape (n,); the robot's when not given,
                1 rad/s where they are unknown.
            max_acceleration: Limits [rad/s^2], a number or shape (n,); when not given, those that
                reach the velocities in 0.5 s.
            steps: Number of samples of the answer.

        Returns:
            The `irbkin.trajectory.Trajectory`.

        Raises:
            UnreachableError: `proven` is True where no motion can be: the start or every solution
                of the goal collides (the message names the two that touch and the depth), is not
                reached, or is outside the limits. It is False where none was found in the time, or
                where not all solutions of the pose were tried.
            InvalidPoseError, InvalidJointsError: A wrong shape, or an element that is not finite.
            InvalidMotionError: A limit or a time that is not positive.
            InvalidModelError: The robot has no body.
        """
    def follow(
        self,
        T: npt.ArrayLike,
        seed: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        *,
        singularity_mode: SingularityMode
        | Literal["through", "error", "wrist", "lock_axis4"] = "through",
        zone: float | None = None,
        out: tuple[_Floats, _Floats] | None = None,
        threads: int = 1,
    ) -> FollowResult:
        r"""One continuous joint path along a path of poses: inside the limits, turns considered,
        through singularities without a jump where there is a way. Of seven joints each step is the
        smallest along the self-motion of its pose.

        Args:
            T: Poses of the tool, shape (m, 4, 4), or several paths, shape (..., m, 4, 4),
                translation [m].
            seed: Joint vectors from which the paths start [rad], shape (..., n). T and seed are
                broadcast: one seed for many paths, one path from many seeds.
            weights: Cost of moving each joint, shape (n,); ones when not given.
            singularity_mode: What to do at the wrist singularity. "through": meet every pose,
                however fast axes 4 and 6 turn. "error": stop where joint 5 comes into the zone, and
                where a joint must jump, as SingArea \Off. "wrist": inside the zone axes 4, 5, 6 go
                straight from where they enter to where they leave, position exact, as SingArea
                \Wrist. "lock_axis4": axis 4 stays at 0 or +-180 deg all along, position exact,
                orientation where it can be, as SingArea \LockAxis4.
            zone: |sin q5| below which `singularity_mode` acts; 0.0175, that is one degree, when not
                given.
            out: Where to write: arrays (..., m, n) and (..., m), float64, of the joints and of the
                orientation error.
            threads: Number of threads, for several paths; 0 for one a core.

        Returns:
            FollowResult: joints [rad], shape (..., m, n), NaN where a pose is not met; orientation
                error [rad], shape (..., m); the breaks.

        Raises:
            InvalidPoseError: T has a wrong shape or holds an invalid pose; the message has its
                index.
            InvalidJointsError: A seed or weight that is not finite, or a zone that is not 0 to 1.
            InvalidModelError: "wrist" or "lock_axis4" for an arm without a spherical wrist, or
                another mode than "through" for seven joints.
            ValueError: Another `singularity_mode`.
        """
    @overload
    def configuration(self, q: _Vector) -> Configuration:
        """ABB's confdata of joint vectors: quarter turns of axes 1, 4 and 6, and the branch.

        Args:
            q: Joint angles [rad], shape (..., n).

        Returns:
            Configuration(cf1, cf4, cf6, cfx): integers for one joint vector, int32 arrays of shape
            (...) for many. cf is floor(angle / 90 deg), of a YuMi the nearest whole number. cfx is
            the slot of a spherical wrist, 0 for an arm with coupled axes 2 and 3, whose controller
            does not use it; docs/guide/abb.md has the rules of GoFa and YuMi. In a batch, a row
            that is not finite, or has an angle beyond 1e5 rad, has -2147483648, the least int32, in
            all four: `ik_configured` gives NaN for it.

        Raises:
            InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
            InvalidModelError: The arm has no spherical wrist and is not a GoFa or YuMi of the
                catalog: its controller counts otherwise.
        """
    @overload
    def configuration(self, q: npt.ArrayLike) -> Configuration | ConfigurationBatch: ...
    def locked(self, given: Mapping[int, float]) -> Robot:
        """Return the same arm of seven joints with one of them locked: its `ik`, `ik_batch`,
        `ik_nearest`, `follow` and `check_pose` take poses alone, and its answers have seven angles.

        The robot prepares a joint once, in milliseconds, and each other angle of one between the
        first and the last in a tenth of one. Slots and structure belong to the other six
        joints or, if joint 7 is locked, to the arm. A joint that was locked before is released.

        Args:
            given: A joint and its angle [rad], as {3: 0.2}: joints count from 1.

        Raises:
            InvalidJointsError: There is no such joint, or its angle is not finite.
            InvalidModelError: The other six joints do not move the tool in six independent ways.
            TypeError, ValueError: The arm has six joints; given does not map one joint.
        """
    @property
    def six_joints(self) -> Robot | None:
        """The other six joints of an arm with a locked one as a robot, with the arm's base,
        tool, limits and velocities; None if no joint is locked. Its joints are numbered 1 to 6.
        """
    @overload
    def arm_angle(self, q: _Vector) -> float:
        """The arm angle of a YuMi's joint vectors: eax_a of a robtarget.

        Args:
            q: Joint angles [rad], shape (..., 7), in the order of the axes from the base: 1, 2, 7,
                3, 4, 5, 6.

        Returns:
            Arm angles [rad]: a number for one joint vector, shape (...) for many; NaN where axis 3
            points from the shoulder to the wrist, and for a row of a batch that is not finite.

        Raises:
            InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
            InvalidModelError: The arm is not a YuMi of the catalog.
        """
    @overload
    def arm_angle(self, q: npt.ArrayLike) -> float | _Floats: ...
    def ik_configured(
        self,
        T: npt.ArrayLike,
        configuration: Configuration | ConfigurationBatch | npt.ArrayLike | None,
        *,
        arm_angle: npt.ArrayLike | None = None,
        fallback: Literal["nearest"] | None = None,
        seed: npt.ArrayLike | None = None,
        every: bool = False,
        out: _Floats | None = None,
        threads: int = 1,
    ) -> _Floats:
        """The solution inside the limits that has a configuration, which chooses the turns of axes
        1, 4 and 6, too.

        An angle within 0.01 deg of the edge of a quarter turn is taken for either side of it. A
        GoFa may have two solutions with one configuration: `every` returns both. Its joints, and a
        YuMi's, may be up to 1.5 deg beyond the limits where none is inside.

        Args:
            T: Poses of the tool, shape (..., 4, 4), translation [m].
            configuration: (cf1, cf4, cf6, cfx): an `irbkin.Configuration`, or whole numbers of
                shape (..., 4). T, configuration, arm_angle and seed are broadcast. None with
                `every` and an arm_angle: any configuration, inside the limits or not.
            arm_angle: Arm angles [rad] of a YuMi, shape (...): eax_a of its robtargets.
            fallback: With "nearest", the solution nearest to `seed` where none has the
                configuration: many programs write [0, 0, 0, 0] without having calculated it.
            seed: Joint vectors [rad], shape (..., n): of the fallback, and those to which the
                solution of a GoFa or YuMi is the nearest; angles of zero when not given.
            every: Whether to return every such solution of one pose, the nearest to `seed` first.
                For an arm angle alone, self-motions are searched that turn the first or the last
                joint by a degree or more; one joint vector represents those that differ in two
                axes of one line.
            out: Array to write to, shape (..., n), float64, C-contiguous; it is returned.
            threads: Number of threads; 0 for one a core.

        Returns:
            Joint vectors [rad], shape (..., n); with `every` shape (k, n). In a batch, a row
            without such a solution, or whose pose, seed or configuration (that which
            `configuration` gives an invalid row) is invalid, is NaN.

        Raises:
            UnreachableError: A single pose has no solution inside the limits with that
                configuration; the message, and its attribute `configurations`, have those that
                exist.
            InvalidPoseError, InvalidJointsError: A wrong shape, an invalid pose, a number of the
                configuration that is not whole or that the arm does not have, a YuMi without
                arm_angle.
            InvalidModelError: As `configuration`; arm_angle of another arm than a YuMi.
            TypeError, ValueError: Another fallback, or one without a seed; a seed alone where the
                configuration names one solution.
        """
    def check_pose(self, T: npt.ArrayLike) -> PoseCheck:
        """Whether a pose can be reached, inside the limits or not, and why not; with seven joints,
        with any angle of joint 7 inside its limits.

        Args:
            T: Pose of the tool, shape (4, 4), translation [m].

        Returns:
            PoseCheck(reachable, within_limits, reason).

        Raises:
            InvalidPoseError, InvalidModelError: As `ik`.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Solution:
    """One joint vector that brings the tool to the pose.

    `solution[0]` is the angle of J1, `numpy.asarray(solution)` is `solution.q`. Frozen, hashable,
    equal by value to a solution of the same robot and pose, picklable.
    """

    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (n,)."""
    @property
    def q_deg(self) -> _Floats:
        """Joint angles [deg], shape (n,)."""
    @property
    def slot(self) -> int:
        """Index of the slot, from 0; for spherical-wrist arms ABB's cfx."""
    @property
    def is_within_limits(self) -> bool:
        """Whether every joint is inside its limits."""
    @property
    def configuration(self) -> Configuration | None:
        """ABB's confdata, as `Robot.configuration` of it; None of an arm that has none."""
    @property
    def singularities(self) -> SingularityKind:
        """Singularities of the pose on this branch: an `irbkin.SingularityKind`, 0 for none."""
    @property
    def free_joint(self) -> FreeJoint | None:
        """The joint that a singular pose leaves undetermined and what stays fixed along its
        self-motion, as FreeJoint(joint, fixed); None at a regular pose.
        """
    def with_free_joint(self, value: float) -> Solution:
        """Return the solution of the same pose with the free joint at another angle.

        Args:
            value: Angle of the free joint [rad].

        Returns:
            The solution. The tool stays at the pose to rounding at the singularity, and within 3e-9
            rad or m next to it.

        Raises:
            InvalidJointsError: No joint is free, or the value is not finite.
            UnreachableError: The arm does not reach the pose with the free joint at that angle.
        """
    @property
    def status(self) -> Status:
        """Flags of the slot, an `irbkin.Status`."""
    @property
    def residual(self) -> float:
        """Distance of the tool from the pose: the larger of the position's [m] and the
        rotation's [rad].
        """
    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[np.float64]: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int, /) -> float: ...
    @overload
    def __getitem__(self, index: slice | Sequence[int], /) -> _Floats: ...
    def __iter__(self) -> Iterator[float]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Solutions:
    """All solutions of a pose in the order of their slots, or the reason why there are none.

    Holds each `Solution`: `solutions[0]`, `solutions[-1]`, iteration, `len`, `in`; a slice is a
    tuple of `Solution`. `numpy.asarray(solutions)` is `solutions.q`. `print(solutions)` shows a
    table in degrees. Frozen, hashable, equal by value to the same answer of the same robot and
    pose, picklable.
    """

    @property
    def q(self) -> _Floats:
        """Joint angles of every solution [rad], shape (k, n), inside the limits or not."""
    @property
    def q_deg(self) -> _Floats:
        """Joint angles of every solution [deg], shape (k, n), inside the limits or not."""
    @property
    def q_by_slot(self) -> _Floats:
        """Joint angles of each slot [rad], shape (slots, n), NaN where the slot is empty;
        `status` has the flags of its rows.
        """
    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """Flags of each slot, `irbkin.Status`, shape (slots,), uint8, as the rows of
        `q_by_slot`.
        """
    @property
    def certified(self) -> bool:
        """Whether these are certain to be all solutions of the pose, limits not regarded. Always
        where the structure has a closed form, never where it is a refined one. For other arms:
        their number equals the roots of a polynomial, and no joint moves freely.
        """
    @property
    def reach(self) -> Reach:
        """Whether the arm reaches the pose, limits not regarded, or is too short or too long for
        it: an `irbkin.Reach`.
        """
    @property
    def shortfall(self) -> float:
        """Distance missing to reach [m]: of the wrist center from where the arm can bring it; 0
        when it is reached, NaN where it is not known: when `reach` is `Reach.NO_ROOTS`.
        """
    def explain(self) -> str:
        """Return the outcome in a sentence: how many solutions, or why there are none. For an
        arm without a closed form that has none, how near it gets is then searched, which takes
        milliseconds. Of solutions that a cell took away, it names what each touches.
        """
    def within_limits(self) -> Solutions:
        """Return the solutions inside the joint limits."""
    def turns(self) -> Solutions:
        """Return every 2 pi equivalent of every solution that is inside the limits. A joint without
        limits keeps its own angle.

        Raises:
            ValueError: There are more than a million.
        """
    def nearest(self, seed: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> Solution:
        """Return the solution inside the limits that is nearest to `seed`, 2 pi equivalents
        considered: least root of the sum of weights * difference^2.

        Args:
            seed: Joint vector [rad], shape (n,).
            weights: Cost of moving each joint, shape (n,); ones when not given.

        Raises:
            UnreachableError: None is inside the limits; the message is `explain()`.
            InvalidJointsError: The seed or the weights are not finite or have a wrong shape.
        """
    def least_motion(self, seed: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> Solution:
        """Return the solution inside the limits that moves the joints the least from `seed`, 2
        pi equivalents considered: least sum of weights * |difference|. Arguments and errors are
        those of `nearest`.
        """
    def filter(self, accept: Callable[[Solution], object] | Cell) -> Solutions:
        """Return the solutions for which `accept(solution)` is true, or that do not collide in a
        cell.

        Args:
            accept: Called with each `Solution`, which is also the sequence of its joint angles
                [rad]; an exception of it is passed on. Or a `Cell`.
        """
    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the solutions as columns, of which `pandas.DataFrame` and `polars.DataFrame` make
        a table.

        Returns:
            Arrays of shape (k,) by name: `slot`; `q1` .. [rad]; `within_limits`, bool;
            `singularities`, the values of `irbkin.SingularityKind`; and `cf1`, `cf4`, `cf6`, `cfx`
            of an arm that has confdata.
        """
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write comma-separated values: the columns of `to_dict` under their names, each number
        with all of its digits, nothing for None.

        Args:
            path_or_file: Path of the file, or a file that is open for text.

        Raises:
            OSError: The file cannot be written.
        """
    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[np.float64]: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int, /) -> Solution: ...
    @overload
    def __getitem__(self, index: slice, /) -> tuple[Solution, ...]: ...
    def __iter__(self) -> Iterator[Solution]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Follower:
    """A path that is followed pose by pose, as `Robot.follow` does a whole one: each step is the
    solution inside the limits that continues the previous joints, turns considered.

    For control loops: a step takes a few microseconds. A Follower changes with each step.

    Args:
        robot: The arm.
        seed: Joint vector from which the path starts [rad], shape (n,).
        weights: Cost of moving each joint, shape (n,); ones when not given.

    Raises:
        InvalidJointsError: A seed or weight that is not finite, a weight that is negative, or a
            wrong shape.
    """

    def __new__(
        cls, robot: Robot, seed: npt.ArrayLike, weights: npt.ArrayLike | None = None
    ) -> Follower: ...
    @property
    def q(self) -> _Floats:
        """The joints of the last step that reached its pose [rad], shape (n,); before it, the
        seed.
        """
    @property
    def last_break(self) -> Break | None:
        """Why the joints could not follow in the last step, an `irbkin.records.Break` whose
        `pose_index` counts the steps from 0; None if they did.
        """
    def step(self, T: npt.ArrayLike) -> _Floats:
        """Return the joints at the next pose of the path.

        Args:
            T: Pose of the tool, shape (4, 4), translation [m].

        Returns:
            Joint vector [rad], shape (n,). If `last_break` is then not None, the joints arrive
            there by a jump.

        Raises:
            UnreachableError: No solution inside the limits; the message says what is missing. The
                next step starts anew from the last joints.
            InvalidPoseError, InvalidModelError: As `Robot.ik`; the step does not count.
        """

@final
class Step(_Record):
    """A set point of a `Guard`."""

    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (n,)."""
    @property
    def dq(self) -> _Floats:
        """Velocities [rad/s], shape (n,)."""
    @property
    def ddq(self) -> _Floats:
        """Accelerations [rad/s^2], shape (n,)."""
    @property
    def accepted(self) -> bool:
        """Whether the reference is followed as it is."""
    @property
    def state(self) -> Literal["following", "braking", "holding"]:
        """What the guard is doing: "following" the reference or going towards it, "braking", or
        "holding" its place.
        """
    @property
    def reason(self) -> str | None:
        """Why the reference is not followed as it is, with the joint, the value and the bound;
        None if it is.
        """
    def __new__(
        cls,
        q: _Floats,
        dq: _Floats,
        ddq: _Floats,
        accepted: bool,
        state: str,
        reason: str | None,
    ) -> Step: ...

@final
class Guard:
    """A guard in front of a control loop: in each cycle a reference, or none, and a set point
    within bounds. This is no safety function.

    Every set point is inside the limits of the joints and within the bounds, and so is the motion
    to it: the cubic of the joint angles and velocities at both ends. After every cycle a braking
    motion exists that is so too. Both are proven free in the cell (docs/guide/stream.md). The first
    set points are at rest at `start`; a set point follows its reference one cycle later. Steps of
    several threads follow one another.

    Args:
        robot: The arm.
        cycle: Time from one set point to the next [s], at most 0.5.
        start: Joint vector at which the arm rests [rad], shape (n,).
        max_velocity: Limits [rad/s], a number or shape (n,); the robot's when not given.
        max_acceleration: Limits [rad/s^2], a number or shape (n,).
        max_jerk: Limits [rad/s^3], a number or shape (n,); none when not given.
        cell: What is around the arm; when not given, the arm stays clear of itself. False proves
            nothing.
        margin: How far the arm stays from obstacles, beyond the margin of the cell [m].
        max_tool_speed: Limit of the speed of the tool center point [m/s]; none when not given.
        on_violation: "brake" refuses a reference that does not fit, and brakes; "limit" goes
            towards it as far and as fast as the bounds allow. In "brake", too, the guard goes on
            towards references that stay near, as those with noise, jitter or rounding do.
        hold: For how long None goes on towards the last reference, before it brakes [s].

    Raises:
        InvalidMotionError: A cycle or a limit that is not positive, a cycle above 0.5 s, a hold
            below 0 or above 10 s.
        InvalidModelError: Neither `max_velocity` nor limits of the robot; no body; a negative
            margin.
        InvalidJointsError: A start of a wrong shape or that is not finite.
        UnreachableError: The start is outside the limits or collides.
        ValueError: Another `on_violation`.
    """

    def __new__(
        cls,
        robot: Robot,
        *,
        cycle: float,
        start: npt.ArrayLike,
        max_velocity: npt.ArrayLike | None = None,
        max_acceleration: npt.ArrayLike,
        max_jerk: npt.ArrayLike | None = None,
        cell: Cell | Literal[False] | None = None,
        margin: float = 0.0,
        max_tool_speed: float | None = None,
        on_violation: Literal["brake", "limit"] = "brake",
        hold: float = 0.0,
    ) -> Guard: ...
    @property
    def robot(self) -> Robot:
        """The arm, an `irbkin.Robot`."""
    @property
    def cycle(self) -> float:
        """Time from one set point to the next [s]."""
    @property
    def state(self) -> Literal["following", "braking", "holding"]:
        """The state: "following", "braking" or "holding"."""
    @property
    def hold(self) -> float:
        """For how long None goes on towards the last reference [s]."""
    @property
    def q(self) -> _Floats:
        """The last set point [rad], shape (n,)."""
    def step(self, reference: npt.ArrayLike | None) -> Step:
        """Return the next set point.

        Args:
            reference: Joint vector [rad], shape (n,); or a pose of the tool, shape (4, 4),
                translation [m], which is solved nearest to the last reference on its branch; or
                None if none came in this cycle: the guard goes on for its `hold`, then it brakes.

        Returns:
            The `irbkin.stream.Step`. Numbers that are not finite are refused in its `reason`.

        Raises:
            InvalidJointsError, InvalidPoseError: A wrong shape; the guard stays as it is.
        """

# What Python's records of RAPID take: array-likes and iterables of numbers.
_Numbers: TypeAlias = npt.ArrayLike | Iterable[float]
_Pose: TypeAlias = "Pose | tuple[_Numbers, _Numbers] | list[_Numbers]"
NOT_THERE: float

_R = TypeVar("_R", bound="_RapidRecord")

@type_check_only
class _RapidRecord:
    """A frozen record of RAPID: compared by value, hashable, picklable."""

    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def _replace(self: _R, **changes: Any) -> _R: ...

@final
class Pose(_RapidRecord):
    """`pose`: a frame."""

    @property
    def trans_mm(self) -> tuple[float, ...]:
        """Position [mm]."""
    @property
    def rot(self) -> tuple[float, ...]:
        """Quaternion w, x, y, z."""
    def __new__(
        cls,
        trans_mm: _Numbers = ...,
        rot: _Numbers = ...,
    ) -> Pose: ...
    @staticmethod
    def of(T: npt.ArrayLike) -> Pose:
        """Return the frame of a homogeneous matrix, shape (4, 4), translation [m]."""
    def matrix(self) -> _Floats:
        """Return the homogeneous matrix, shape (4, 4), translation [m]."""

@final
class RobTarget(_RapidRecord):
    """`robtarget`: a pose of the tool in the work object, a configuration, and external axes."""

    @property
    def trans_mm(self) -> tuple[float, ...]:
        """Position [mm]."""
    @property
    def rot(self) -> tuple[float, ...]:
        """Quaternion w, x, y, z."""
    @property
    def robconf(self) -> Configuration:
        """Quarter turns of axes 1, 4 and 6, and the slot."""
    @property
    def extax(self) -> tuple[float, ...]:
        """External axes [deg or mm]; 9e9 for an axis that does not exist."""
    def __new__(
        cls,
        trans_mm: _Numbers,
        rot: _Numbers = ...,
        robconf: Iterable[int] | Configuration = ...,
        extax: _Numbers = ...,
    ) -> RobTarget: ...
    @staticmethod
    def of(
        T: npt.ArrayLike, robconf: Iterable[int] | Configuration, extax: _Numbers = ...
    ) -> RobTarget:
        """Return the target of a homogeneous matrix, shape (4, 4), translation [m]."""
    def matrix(self) -> _Floats:
        """Return the homogeneous matrix of the tool in the work object, shape (4, 4),
        translation [m].
        """

@final
class JointTarget(_RapidRecord):
    """`jointtarget`: angles of the robot's axes, and external axes."""

    @property
    def robax_deg(self) -> tuple[float, ...]:
        """The controller's angles [deg]."""
    @property
    def extax(self) -> tuple[float, ...]:
        """External axes [deg or mm]; 9e9 for an axis that does not exist."""
    def __new__(
        cls,
        robax_deg: _Numbers,
        extax: _Numbers = ...,
    ) -> JointTarget: ...
    @staticmethod
    def of(q: _Numbers, extax: _Numbers = ...) -> JointTarget:
        """Return the target of joint angles [rad], shape (6,)."""
    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (6,)."""

@final
class LoadData(_RapidRecord):
    """`loaddata`: mass and inertia of a load; kinematics does not use them."""

    @property
    def mass_kg(self) -> float:
        """Mass [kg]."""
    @property
    def cog_mm(self) -> tuple[float, ...]:
        """Center of gravity [mm]."""
    @property
    def aom(self) -> tuple[float, ...]:
        """Axes of moment, a quaternion w, x, y, z."""
    @property
    def inertia(self) -> tuple[float, ...]:
        """Moments of inertia ix, iy, iz [kg m^2]."""
    def __new__(
        cls,
        mass_kg: float = ...,
        cog_mm: _Numbers = ...,
        aom: _Numbers = ...,
        inertia: _Numbers = ...,
    ) -> LoadData: ...

@final
class ToolData(_RapidRecord):
    """`tooldata`: a tool. The default is tool0."""

    @property
    def robhold(self) -> bool:
        """Whether the robot holds it; a tool that it does not hold is stationary."""
    @property
    def tframe(self) -> Pose:
        """The frame of the tool in the flange frame; in the world frame if it is stationary."""
    @property
    def tload(self) -> LoadData:
        """Its load."""
    def __new__(
        cls,
        robhold: bool = ...,
        tframe: _Pose = ...,
        tload: LoadData = ...,
    ) -> ToolData: ...

@final
class WobjData(_RapidRecord):
    """`wobjdata`: a work object, at `uframe * oframe`. The default is wobj0."""

    @property
    def robhold(self) -> bool:
        """Whether the robot holds it, under a stationary tool."""
    @property
    def ufprog(self) -> bool:
        """Whether the user frame is fixed; otherwise `ufmec` moves it."""
    @property
    def ufmec(self) -> str:
        """The mechanical unit that moves the user frame."""
    @property
    def uframe(self) -> Pose:
        """User frame in the world frame; in the flange frame if the robot holds the work object."""
    @property
    def oframe(self) -> Pose:
        """Object frame in the user frame."""
    def __new__(
        cls,
        robhold: bool = ...,
        ufprog: bool = ...,
        ufmec: str = ...,
        uframe: _Pose = ...,
        oframe: _Pose = ...,
    ) -> WobjData: ...
    @staticmethod
    def of(T: npt.ArrayLike) -> WobjData:
        """Return the work object of a homogeneous matrix, its user frame in the world, shape (4,
        4), translation [m].
        """

@final
class SpeedData(_RapidRecord):
    """`speeddata`: how fast a move is."""

    @property
    def v_tcp_mm_s(self) -> float:
        """Speed of the tool center point [mm/s]."""
    @property
    def v_ori_deg_s(self) -> float:
        """Speed of its reorientation [deg/s]."""
    @property
    def v_leax_mm_s(self) -> float:
        """Speed of linear external axes [mm/s]."""
    @property
    def v_reax_deg_s(self) -> float:
        """Speed of rotating external axes [deg/s]."""
    def __new__(
        cls,
        v_tcp_mm_s: float,
        v_ori_deg_s: float = ...,
        v_leax_mm_s: float = ...,
        v_reax_deg_s: float = ...,
    ) -> SpeedData: ...

@final
class ZoneData(_RapidRecord):
    """`zonedata`: how a move ends. The default is fine."""

    @property
    def finep(self) -> bool:
        """Whether the robot stops at the target."""
    @property
    def pzone_tcp_mm(self) -> float:
        """Radius around the target in which the tool center point leaves the line [mm]."""
    @property
    def pzone_ori_mm(self) -> float:
        """Radius in which the reorientation leaves its way [mm]."""
    @property
    def pzone_eax_mm(self) -> float:
        """Radius for external axes [mm]."""
    @property
    def zone_ori_deg(self) -> float:
        """Reorientation that is left where it leaves its way [deg]."""
    @property
    def zone_leax_mm(self) -> float:
        """Way of linear external axes that is left where they leave it [mm]."""
    @property
    def zone_reax_deg(self) -> float:
        """Way of rotating external axes that is left where they leave it [deg]."""
    def __new__(
        cls,
        finep: bool = ...,
        pzone_tcp_mm: float = ...,
        pzone_ori_mm: float = ...,
        pzone_eax_mm: float = ...,
        zone_ori_deg: float = ...,
        zone_leax_mm: float = ...,
        zone_reax_deg: float = ...,
    ) -> ZoneData: ...

@final
class Declaration(_Record):
    """A data declaration. Values are as declared: assignments of a program are not followed."""

    @property
    def name(self) -> str:
        """Its name, as it is written."""
    @property
    def data_type(self) -> str:
        """RAPID's name of its type."""
    @property
    def scope(self) -> Literal["LOCAL", "TASK", ""]:
        """Its scope: "LOCAL", "TASK" or ""."""
    @property
    def storage(self) -> Literal["CONST", "PERS", "VAR"]:
        """Its storage class: "CONST", "PERS" or "VAR"."""
    @property
    def routine(self) -> str | None:
        """The routine that declares it; None for the module."""
    @property
    def value(self) -> Any:
        """A record; nested lists of records for an array; None without a value."""
    @property
    def line(self) -> int:
        """Line of the text, from 1."""
    @property
    def column(self) -> int:
        """Column of the text, from 1."""
    def __new__(
        cls,
        name: str,
        data_type: str,
        scope: Literal["LOCAL", "TASK", ""],
        storage: Literal["CONST", "PERS", "VAR"],
        routine: str | None,
        value: Any,
        line: int,
        column: int,
    ) -> Declaration: ...

@final
class Routine(_Record):
    """A routine of a module."""

    @property
    def kind(self) -> Literal["PROC", "FUNC", "TRAP"]:
        """Its kind: "PROC", "FUNC" or "TRAP"."""
    @property
    def name(self) -> str:
        """Its name, as it is written."""
    @property
    def header(self) -> str:
        """Its first line, from `LOCAL` or `PROC` to the parameters."""
    @property
    def line(self) -> int:
        """Line of the text, from 1."""
    @property
    def column(self) -> int:
        """Column of the text, from 1."""
    def __new__(
        cls,
        kind: Literal["PROC", "FUNC", "TRAP"],
        name: str,
        header: str,
        line: int,
        column: int,
    ) -> Routine: ...

@final
class Argument(_Record):
    """An argument as it is written, without its name, and its value by the declarations.

    Data that the module assigns have no value.
    """

    @property
    def text(self) -> str:
        """The argument as it is written."""
    @property
    def value(self) -> Any:
        """Its value; None if the declarations do not give it."""
    @property
    def reason(self) -> str | None:
        """Why the value is unknown; None if it is known."""
    def __new__(
        cls,
        text: str,
        value: Any,
        reason: str | None,
    ) -> Argument: ...

@final
class MotionSettings(_Record):
    """How a move is made: by the instructions before it in its routine, or else by the settings
    that a program starts with.
    """

    @property
    def conf_l(self) -> bool:
        """ConfL: whether MoveL and MoveC must arrive with the configuration of the target."""
    @property
    def conf_j(self) -> bool:
        """ConfJ: whether MoveJ must arrive with the configuration of the target."""
    @property
    def sing_area(self) -> Literal["Off", "Wrist", "LockAxis4"]:
        """SingArea, near the wrist singularity: "Off", "Wrist" or "LockAxis4"."""
    @property
    def cir_path_mode(
        self,
    ) -> Literal["PathFrame", "ObjectFrame", "CirPointOri", "Wrist45", "Wrist46", "Wrist56"]:
        """CirPathMode, the orientation in a MoveC: "PathFrame", "ObjectFrame", "CirPointOri",
        "Wrist45", "Wrist46" or "Wrist56".
        """
    def __new__(
        cls,
        conf_l: bool,
        conf_j: bool,
        sing_area: Literal["Off", "Wrist", "LockAxis4"],
        cir_path_mode: Literal[
            "PathFrame", "ObjectFrame", "CirPointOri", "Wrist45", "Wrist46", "Wrist56"
        ],
    ) -> MotionSettings: ...

@final
class Move(_Record):
    """A move instruction."""

    @property
    def kind(self) -> Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ", "MoveExtJ"]:
        """How it moves: "MoveJ", "MoveL", "MoveC", "MoveAbsJ", or "MoveExtJ" for external axes
        only.
        """
    @property
    def routine(self) -> str | None:
        """The routine that contains it."""
    @property
    def target(self) -> Argument:
        """The target: an `Argument` with a RobTarget, of MoveAbsJ and MoveExtJ with a
        JointTarget.
        """
    @property
    def via(self) -> Argument | None:
        """The point on the circle of a MoveC."""
    @property
    def speed(self) -> str:
        """The speed as it is written, such as "v1000"."""
    @property
    def zone(self) -> str:
        """The zone as it is written, such as "z50"; empty for an instruction without one, which
        meets its target.
        """
    @property
    def tool(self) -> Argument:
        """The tool: a ToolData."""
    @property
    def wobj(self) -> Argument | None:
        r"""The work object of \WObj; without it wobj0."""
    @property
    def options(self) -> tuple[tuple[str, str | None], ...]:
        """The other optional arguments: name and text; no text for a switch."""
    @property
    def line(self) -> int:
        """Line of the text, from 1."""
    @property
    def column(self) -> int:
        """Column of the text, from 1."""
    @property
    def displaced(self) -> int | None:
        """Line of the PDispOn or PDispSet that displaces it, which is not followed."""
    @property
    def speed_data(self) -> Argument:
        r"""The data of `speed`: a SpeedData, with the speed of \V."""
    @property
    def zone_data(self) -> Argument:
        r"""The data of `zone`: a ZoneData, with the radius of \Z."""
    @property
    def time(self) -> Argument | None:
        r"""The duration of \T, which replaces the speed [s]."""
    @property
    def settings(self) -> MotionSettings:
        """The settings of ConfL, ConfJ, SingArea and CirPathMode before it."""
    @property
    def instruction(self) -> str:
        """The instruction as it is written, such as "MoveL" or "ArcLStart"."""
    @property
    def extra(self) -> tuple[tuple[int, str], ...]:
        """The other required arguments, of a process: the number of required arguments before
        each, and its text.
        """
    def __new__(
        cls,
        kind: Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ", "MoveExtJ"],
        routine: str | None,
        target: Argument,
        via: Argument | None,
        speed: str,
        zone: str,
        tool: Argument,
        wobj: Argument | None,
        options: tuple[tuple[str, str | None], ...],
        line: int,
        column: int,
        displaced: int | None,
        speed_data: Argument,
        zone_data: Argument,
        time: Argument | None,
        settings: MotionSettings,
        instruction: str,
        extra: tuple[tuple[int, str], ...],
    ) -> Move: ...

@final
class MotionMove(_Record):
    """A move of a motion."""

    @property
    def kind(self) -> Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ"]:
        """The instruction: "MoveJ", "MoveL", "MoveC" or "MoveAbsJ"."""
    @property
    def module(self) -> int:
        """Index of its module: 0 for the module itself, from 1 for modules of its context."""
    @property
    def module_index(self) -> int:
        """Its index in `Module.moves`."""
    @property
    def line(self) -> int:
        """Line of the instruction."""
    @property
    def start(self) -> float:
        """When it begins [s], halfway through the corner before it."""
    @property
    def end(self) -> float:
        """When it ends [s], halfway through the corner behind it."""
    @property
    def length(self) -> float:
        """The length of the tool's way in the work object [m]."""
    @property
    def q(self) -> _Floats | None:
        """The joints at its target [rad], shape (6,), which is met or passed; None if the move
        is left out.
        """
    @property
    def as_programmed(self) -> bool:
        """Whether it is made as it is programmed. Otherwise the joints go straight to its target
        at their limits or, without `q`, it is left out.
        """
    @property
    def tool(self) -> _Floats:
        """The tool in the flange frame, shape (4, 4); of a stationary tool, the work object that
        the robot carries.
        """
    def __new__(
        cls,
        kind: Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ"],
        module: int,
        module_index: int,
        line: int,
        start: float,
        end: float,
        length: float,
        q: _Floats | None,
        as_programmed: bool,
        tool: _Floats,
    ) -> MotionMove: ...

@final
class Finding(_Record):
    """Something wrong with a move, in a table, a motion or a check. `str` has the line, too."""

    @property
    def code(self) -> str:
        """A letter for the group and three digits, such as "C201"; `irbkin rule` explains it."""
    @property
    def name(self) -> str:
        """The code in words, such as "wrong-confdata"."""
    @property
    def severity(self) -> Literal["error", "warning", "note"]:
        """How much it matters: "error", "warning" or, where nothing is wrong, "note"."""
    @property
    def module(self) -> int:
        """Index of the module among those that are checked."""
    @property
    def line(self) -> int:
        """Line of the instruction, from 1."""
    @property
    def column(self) -> int:
        """Column of the instruction, from 1."""
    @property
    def routine(self) -> str | None:
        """The routine that contains it."""
    @property
    def move_index(self) -> int:
        """Index of the move in `RoutineMotion.moves`, or of the row in a TargetTable; for an
        instruction that is not read, of the next move.
        """
    @property
    def message(self) -> str:
        """The instruction and what is wrong with it, in one line."""
    @property
    def joint(self) -> int | None:
        """The joint that it is about, from 1."""
    @property
    def value(self) -> float | None:
        """The value that was found, in SI units: the speed of a joint, its step in a flip, how
        far outside limits or reach, the distance from a singularity, a duration.
        """
    @property
    def bound(self) -> float | None:
        """The bound that the value must not exceed or, of a singularity, must not be below."""
    @property
    def edits(self) -> tuple[tuple[int, int, int, str], ...]:
        """The corrections: index of the module, first byte and end in its `source` as UTF-8, and
        the text that takes their place. Empty if nothing corrects it.
        """
    @property
    def related(self) -> tuple[tuple[int, int, int], ...]:
        """Where else its cause shows: index of the module, line and column, both from 1."""
    def __new__(
        cls,
        code: str,
        name: str,
        severity: str,
        module: int,
        line: int,
        column: int,
        routine: str | None,
        move_index: int,
        message: str,
        joint: int | None,
        value: float | None,
        bound: float | None,
        edits: tuple[tuple[int, int, int, str], ...],
        related: tuple[tuple[int, int, int], ...],
    ) -> Finding: ...

@final
class Skipped(_Record):
    """A part of the text that is not read."""

    @property
    def line(self) -> int:
        """Line of the text, from 1."""
    @property
    def column(self) -> int:
        """Column of the text, from 1."""
    @property
    def routine(self) -> str | None:
        """The routine that contains it; None for the module."""
    @property
    def what(self) -> str:
        """Its kind and, of a datum, why it is not read."""
    @property
    def text(self) -> str:
        """The part as it is written."""
    def __new__(
        cls,
        line: int,
        column: int,
        routine: str | None,
        what: str,
        text: str,
    ) -> Skipped: ...

@final
class CheckedMove(_Record):
    """A place at which a program moves, checked."""

    @property
    def module(self) -> int:
        """Index of the module among those that are checked."""
    @property
    def line(self) -> int:
        """Line of the instruction, or of the call that its target is an argument of, from 1."""
    @property
    def column(self) -> int:
        """Column of it, from 1."""
    @property
    def routine(self) -> str | None:
        """The routine that contains it."""
    @property
    def target(self) -> str:
        """The target as it is written."""
    @property
    def q(self) -> _Floats | None:
        """The joints at its target [rad], one an axis; None if it has none or is not checked."""
    @property
    def confdata(self) -> Configuration | None:
        """The confdata of its target; None for joint angles, or if the target is not known."""
    @property
    def unchecked(self) -> str | None:
        """The code of the finding for which it is not checked; None if its target, tool and work
        object are known in each pass.
        """
    def __new__(
        cls,
        module: int,
        line: int,
        column: int,
        routine: str | None,
        target: str,
        q: _Floats | None,
        confdata: Configuration | None,
        unchecked: str | None,
    ) -> CheckedMove: ...

@final
class Checked(_Record):
    """The result of a check: findings on moves, and the moves."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings, in the order of the modules and of their texts: a tuple of `Finding`."""
    @property
    def moves(self) -> tuple[CheckedMove, ...]:
        """The moves in the same order, passes of a loop as one; those below a call that they
        depend on have its place, and are as many as there are: a tuple of `CheckedMove`.
        """
    def __new__(
        cls,
        findings: tuple[Finding, ...],
        moves: tuple[CheckedMove, ...],
    ) -> Checked: ...

@final
class TextFault(_Record):
    """A fault of a text that was read in spite of it. `str` has the place, too."""

    @property
    def line(self) -> int:
        """Line of the text, from 1."""
    @property
    def column(self) -> int:
        """Column of the text, from 1."""
    @property
    def message(self) -> str:
        """The fault in words, without the place."""
    def __new__(cls, line: int, column: int, message: str) -> TextFault: ...

@final
class TargetTable(_Record):
    """The joint angles of m targets."""

    @property
    def kinds(self) -> tuple[str, ...]:
        """The instruction of each target, or "robtarget"."""
    @property
    def names(self) -> tuple[str, ...]:
        """Each target as it is written, or the name of its declaration."""
    @property
    def lines(self) -> npt.NDArray[np.int64]:
        """Line of the instruction or of the declaration, shape (m,)."""
    @property
    def q(self) -> _Floats:
        """Joint angles [rad], shape (m, n), NaN if there are none."""
    @property
    def configuration(self) -> ConfigurationBatch:
        """The configuration of the joint angles, int32 arrays of shape (m,); without joint
        angles the configuration of the target.
        """
    @property
    def wrist(self) -> _Floats:
        """Angle of joint 5 from 0 or 180 deg [rad], shape (m,)."""
    @property
    def elbow(self) -> _Floats:
        """Angle between upper arm and forearm from stretched or folded [rad], shape (m,)."""
    @property
    def shoulder(self) -> _Floats:
        """Distance of the wrist center from axis 1 [m], shape (m,)."""
    @property
    def findings(self) -> tuple[Finding | None, ...]:
        """For each target a `Finding`, if there are no joint angles, or others than the target
        requests.
        """
    def __new__(
        cls,
        kinds: tuple[str, ...],
        names: tuple[str, ...],
        lines: npt.NDArray[np.int64],
        q: _Floats,
        configuration: ConfigurationBatch,
        wrist: _Floats,
        elbow: _Floats,
        shoulder: _Floats,
        findings: tuple[Finding | None, ...],
    ) -> TargetTable: ...
    def to_dict(self) -> dict[str, Any]:
        """Return the targets as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
        table.

        Returns:
            Columns of m elements by name: `kind`, `name`, `line`; `q1` .. [rad]; `cf1`, `cf4`,
            `cf6`, `cfx`; `wrist` and `elbow` [rad], `shoulder` [m]; `finding`, the message or None.
        """
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write comma-separated values: the columns of `to_dict` under their names, each number
        with all of its digits, nothing for None.

        Args:
            path_or_file: Path of the file, or a file that is open for text.

        Raises:
            OSError: The file cannot be written.
        """

# What a name stands for is the text's: records of any type, narrowed with isinstance.
@final
class Module(Mapping[str, Any]):
    """A RAPID module: its data by name, its moves in order, and what was skipped.

    A mapping of the names of the module's own data to their values: `module["p10"]`, `len`,
    iteration, `in`, `get`, `keys`, `values`, `items`. Names are taken as RAPID takes them, in upper
    or lower case. Frozen and picklable; two modules are equal where they declare and move the same,
    whatever the lines. `parse` and `load` make one.
    """

    @property
    def name(self) -> str | None:
        """Its name; None for declarations without a module around them."""
    @property
    def attributes(self) -> tuple[str, ...]:
        """Its attributes, such as "SYSMODULE"."""
    @property
    def source(self) -> str:
        """The text that it was read from."""
    @property
    def data(self) -> Mapping[str, Any]:
        """The data of the module itself, in the order of the text: names to records, to nested
        lists of records for arrays, to None if the declaration has no value. Data of routines
        are in `declarations`.
        """
    @property
    def declarations(self) -> tuple[Declaration, ...]:
        """Every declaration, of routines too: a tuple of `Declaration`."""
    @property
    def routines(self) -> tuple[Routine, ...]:
        """Its procedures, functions and traps, in the order of the text: a tuple of `Routine`."""
    @property
    def moves(self) -> tuple[Move, ...]:
        """The instructions that move, MoveL as well as TriggL and ArcL, in the order of the
        text, whatever branch or loop they are in.
        """
    @property
    def skipped(self) -> tuple[Skipped, ...]:
        """The parts that were not read, in the order of the text: a tuple of `Skipped`."""
    @property
    def faults(self) -> tuple[TextFault, ...]:
        """The faults of the text, in its order: a tuple of `TextFault`, which is empty for
        modules of `parse` and `load`; modules of `load_program` may have faults.
        """
    def rewritten(self, values: Mapping[str, Any]) -> str:
        """Return the source with other values for some data; everything else, comments included,
        stays as it is, character for character.

        Args:
            values: Names of the module's data to records of their type, to nested lists of as many
                for arrays. None leaves a declaration without a value as it is.

        Returns:
            The text.

        Raises:
            RapidError: The module has no such data, or a value is of another type or size.
        """
    def keys(self) -> KeysView[str]:
        """Return the names of the module's own data, in the order of the text."""
    def values(self) -> ValuesView[Any]:
        """Return the values of the module's own data, in the order of the text."""
    def items(self) -> ItemsView[str, Any]:
        """Return the pairs (name, value) of the module's own data, in the order of the text."""
    def get(self, name: str, default: Any = None, /) -> Any:
        """Return the value of a datum of the module; `default` if the module has no such name."""
    def __getitem__(self, name: str, /) -> Any: ...
    def __contains__(self, name: object, /) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def __reversed__(self) -> Iterator[str]: ...
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __reduce__(self) -> tuple[Callable[..., Module], tuple[str, tuple[Module, ...]]]: ...

# Text determines the type: a module, or any record.
def parse(text: str | bytes, context: Iterable[Module] | None = None) -> Any:
    """Parse a RAPID module, with or without MODULE around it, or a single record.

    Args:
        text: RAPID text, or the bytes of a file: UTF-8, UTF-16 with its mark, else Latin-1. Text
            that begins with a bracket is one robtarget, jointtarget, tooldata, wobjdata, pose or
            loaddata, as `dump` writes them, determined by its shape.
        context: Modules in which names that the text does not declare are looked for: their data
            that are not LOCAL.

    Returns:
        Module; or RobTarget, JointTarget, ToolData, WobjData, Pose or LoadData.

    Raises:
        RapidError: The text is broken; the message and the attributes `line` and `column` have the
            place. Unknown statements are no error: they are skipped and listed in `Module.skipped`.
    """

def parse_module(text: str | bytes, context: Iterable[Module] | None = None) -> Module:
    """Parse a RAPID module, as `parse`; a record is refused."""

def read_modules(contents: Iterable[str | bytes]) -> list[Module]:
    """Read the modules of a program in spite of their faults: each knows the data of the others.

    Args:
        contents: Texts, or bytes of files, as for `parse`.

    Returns:
        A list of Module.
    """

def read_module(content: str | bytes, context: Iterable[Module] | None = None) -> Module:
    """Read a RAPID module in spite of its faults, which are `Module.faults`.

    Args:
        content: RAPID text, or the bytes of a file, as for `parse`.
        context: Modules in which names that the text does not declare are looked for.
    """

def differing_names(before: Module, after: Module) -> set[str]:
    """Return the names in lower case by which two versions of a module differ to other modules.

    A module that has none of them in its text is read as before.

    Args:
        before: Module.
        after: Module.
    """

def dump(value: Any, name: str = "Data") -> str:
    """Return the RAPID text of a record, of a module, or of a mapping of names to values.

    `parse` gives back modules with all their data, and single RobTarget, JointTarget, ToolData,
    WobjData, Pose and LoadData. The text of any other single value belongs into a declaration:
    alone its shape does not determine its type, and `parse` refuses it.

    Args:
        value: RobTarget, JointTarget, ToolData, WobjData, Pose, LoadData, SpeedData, ZoneData,
            Configuration, a number, a tuple of 3 (pos), 4 (orient) or 6 (extjoint) numbers, nested
            lists of these for an array: the text of the value. A Module, or a mapping of names to
            values: the text of a module, with tools and work objects as PERS, others as CONST.
        name: Name of the module that is made of a mapping.

    Raises:
        RapidError: A value is not RAPID data or not finite, or a name is not an identifier.
    """

def calc_joint_t(
    robot: Robot,
    target: RobTarget,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
    *,
    fallback: Literal["nearest"] | None = None,
    seed: npt.ArrayLike | None = None,
) -> JointTarget:
    """Return the jointtarget of a robtarget, as RAPID's CalcJointT: joint angles inside the limits
    that have its configuration.

    Args:
        robot: The arm. Work objects are given in the world, in which the robot's base is.
        target: RobTarget.
        tool: ToolData; by default the robot's own tool.
        wobj: WobjData; by default the world.
        fallback: With "nearest", the solution nearest to `seed` where none has the configuration.
        seed: Joint vector [rad], shape (n,), of the fallback, and to which the solution of a GoFa
            is the nearest where its configuration names two.

    Returns:
        JointTarget, with the target's external axes. eax_a of a YuMi is the arm angle in the target
        and axis 7 in the answer.

    Raises:
        UnreachableError: Its `rapid_error` is "ERR_OUTSIDE_REACH" where the arm is too short or too
            long, "ERR_ROBLIMIT" where solutions exist but none inside the limits with the
            configuration; `configurations` has those that exist.
        InvalidPoseError: A quaternion's norm is off one by more than 2e-3.
        InvalidJointsError: The arm has no such cfx.
        RapidError: The robot holds both tool and work object or neither, or a mechanical unit moves
            the work object.
        InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa or YuMi
            of the catalog.
    """

def calc_rob_t(
    robot: Robot,
    joints: JointTarget | npt.ArrayLike,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
) -> RobTarget:
    """Return the robtarget of a jointtarget, with its configuration, as RAPID's CalcRobT. Limits
    are not checked.

    Args:
        robot: The arm. Work objects are given in the world, in which the robot's base is.
        joints: JointTarget, or joint angles [rad], shape (n,).
        tool: ToolData; by default the robot's own tool.
        wobj: WobjData; by default the world.

    Returns:
        RobTarget, with the external axes of `joints`; eax_a of a YuMi is its arm angle.

    Raises:
        InvalidPoseError, RapidError, InvalidModelError: As `calc_joint_t`.
    """

def calc_moves(
    robot: Robot,
    module: Module,
    *,
    fallback: Literal["nearest"] | None = None,
    seed: npt.ArrayLike | None = None,
) -> TargetTable:
    """Return the joint angles of every target of a module's moves, in their order, each with its
    own tool and work object; a MoveC has two. The motion between targets is not checked: `follow`
    does.

    Args:
        robot: The arm.
        module: Module.
        fallback: With "nearest", a target whose configuration no solution has gets the one nearest
            to the joints before it.
        seed: Joint vector [rad] before the first target, shape (n,).

    Returns:
        TargetTable. `findings` says what is wrong with the target of a row.

    Raises:
        InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa or YuMi
            of the catalog.
    """

def calc_targets(
    robot: Robot,
    module: Module,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
    *,
    fallback: Literal["nearest"] | None = None,
    seed: npt.ArrayLike | None = None,
) -> TargetTable:
    """Return the joint angles of every robtarget that a module declares, in the order of the text,
    all with one tool and work object.

    Args:
        robot: The arm.
        module: Module.
        tool: ToolData; by default the robot's own tool.
        wobj: WobjData; by default the world.
        fallback: As of `calc_moves`.
        seed: As of `calc_moves`.

    Returns:
        TargetTable. `findings` says what is wrong with the target of a row.

    Raises:
        InvalidPoseError, RapidError, InvalidModelError: As `calc_joint_t`, of the tool and the work
            object.
    """

def check(
    robot: Robot,
    module: Module,
    *,
    codes: Collection[str] | None = None,
    max_velocity: npt.ArrayLike | None = None,
    step: float = 0.005,
    turn: float | None = None,
    cell: Cell | None = None,
) -> tuple[Finding, ...]:
    """Check every move of a module, of all routines.

    Routines are followed from `main` through calls, with their arguments; those that nothing calls,
    by themselves. A branch is checked from where the robot is before it, a loop in each pass if its
    bounds are known and else in the first. Behind a branch that moves, behind a label and in a
    handler, the next move is checked as a target only.

    Args:
        robot: The arm. Work objects are given in the world, in which the robot's base is.
        module: Module; calls of routines of its context are followed, too.
        codes: The codes that are wanted, such as "C201"; without it all but U807: unused names.
        max_velocity: Limits [rad/s], a number or one an axis; without it the robot's own. Without
            either no joint is found to be too fast.
        step: Largest distance of the tool between two samples of a MoveL or MoveC [m].
        turn: Largest turn of the tool between two samples [rad]; 5 deg without it.
        cell: An `irbkin.Cell` in which each move is proven to touch nothing; without it collisions
            are not looked for.

    Returns:
        A tuple of `Finding`, in the order of the text.

    Raises:
        RapidError: A code that does not exist.
        InvalidMotionError: A limit or a step that is not positive and finite, or more than ten
            million samples.
        InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa
            or YuMi of the catalog.
    """

def check_program(
    robot: Robot,
    modules: Sequence[Module],
    *,
    codes: Collection[str] | None = None,
    max_velocity: npt.ArrayLike | None = None,
    step: float = 0.005,
    turn: float | None = None,
    cell: Cell | None = None,
    units: Sequence[tuple[str, bool, bool, Sequence[tuple[int, npt.ArrayLike, bool]]]]
    | None = None,
    last_values: bool = False,
    whole: bool | None = None,
    of_system: Sequence[int] | None = None,
    carried: Mapping[str, Shape | Sequence[Shape]] | None = None,
) -> Checked:
    """Check every move of a program: modules that know each other.

    Args:
        robot: The arm. Work objects are given in the world, in which the robot's base is.
        modules: Module of the task; each is parsed with the others as its context.
        codes: As of `check`.
        max_velocity: As of `check`.
        step: As of `check`.
        turn: As of `check`.
        cell: As of `check`.
        units: The mechanical units of the controller: tuples of a name, whether it carries the
            robot, whether its axes are determined, and its axes: tuples of the external axis from
            0, the frame of shape (4, 4) [m], and whether it turns about its z axis or else moves
            along its x axis. An external axis of no unit, which is not at zero, is not checked.
        last_values: Whether a PERS that the program assigns has the value of its declaration.
        carried: Shapes in the flange frame, by the name of the tool or work object they move with.
        whole: Whether every module of the task is given: a call of what none declares is an error
            then, and a note if some are missing. None if it is not known.
        of_system: Indices of modules of the system that do not say so by their attributes: a call
            of what none declares is a note there.

    Returns:
        `Checked`.

    Raises:
        RapidError: A code that does not exist.
        InvalidMotionError: As of `check`.
        InvalidModelError: As of `check`.
    """

def check_codes() -> list[tuple[str, str, str, bool]]:
    """Every code of a check: code, name, severity, whether it is shown without a selection."""

def instructions() -> list[tuple[str, str, str]]:
    """Return RAPID's own instructions and functions: rows of name, kind and arguments.

    The kind is "instruction" or "function". The arguments are as in the header of a routine, with
    `...` for those that are not known.
    """

def motion(
    robot: Robot,
    module: Module,
    routine: str | None = None,
    *,
    start: npt.ArrayLike | JointTarget | None = None,
    max_velocity: npt.ArrayLike | None = None,
    max_acceleration: npt.ArrayLike | None = None,
    step: float = 0.005,
    turn: float | None = None,
) -> RoutineMotion:
    """Make one motion of the moves of a routine: MoveAbsJ, MoveJ, MoveL and MoveC in order, each
    followed from the joints before it, timed at its programmed speed and checked.

    Everything that is wrong with a move is a finding, no error: an unknown value, a target out of
    reach, a flip on the way, a singularity, another configuration than the target's, a joint too
    fast at the programmed speed. A MoveL or MoveC that cannot be followed is replaced by a joint
    move to its target; a move whose target has no joints is left out.

    Args:
        robot: The arm. Work objects are given in the world, in which the robot's base is.
        module: Module.
        routine: Name of the routine; without it main, or the only one that moves. Calls are
            followed, into the module's context too, and loops with known bounds; other branches and
            loops must not contain moves.
        start: Joint angles [rad], shape (6,), or a JointTarget, from which the first move begins.
            Without it the motion begins at the first target.
        max_velocity: Limits [rad/s], a number or shape (6,); without it the robot's own.
        max_acceleration: Limits [rad/s^2], a number or shape (6,). No catalog has them: without
            them speeds change at once, and the duration is a kinematic lower bound.
        step: Largest distance of the tool between two samples of a MoveL or MoveC [m].
        turn: Largest turn of the tool between two samples of a MoveL or MoveC, and of a joint
            between two of a MoveJ or MoveAbsJ [rad]; 5 deg without it.

    Returns:
        RoutineMotion. Its `findings` say what is wrong.

    Raises:
        RapidError: No such routine, no move in it, a branch, loop or jump around a move (with its
            line), or not one move that can be made.
        InvalidMotionError: A limit or a step that is not positive and finite, a robot without
            velocities, or more than ten million samples.
        InvalidJointsError: A start that is not finite or has a wrong shape.
        InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa
            or YuMi of the catalog.
    """

@final
class RoutineMotion:
    """The moves of a routine as one motion: followed, timed and checked.

    `motion` makes one. Frozen and picklable; a motion that is unpickled is made again.
    """

    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def routine(self) -> str | None:
        """The routine; None for moves outside routines."""
    @property
    def duration(self) -> float:
        """Duration [s]; without `max_acceleration` a kinematic lower bound, no cycle time."""
    @property
    def trajectory(self) -> Trajectory:
        """The joints over time: a Trajectory with these samples. Without `max_acceleration` the
        joints go evenly from sample to sample.
        """
    @property
    def t(self) -> _Floats:
        """Times of the samples [s], shape (m,)."""
    @property
    def q(self) -> _Floats:
        """Joint angles of the samples [rad], shape (m, 6), of a YuMi (m, 7)."""
    @property
    def move_index(self) -> npt.NDArray[np.int64]:
        """The move, by its index in `moves`, that each sample belongs to, shape (m,). A corner
        is shared by two: the sample halfway through it is the last one of the first move.
        """
    @property
    def lines(self) -> npt.NDArray[np.int64]:
        """Line of the instruction that each sample belongs to, shape (m,)."""
    @property
    def moves(self) -> tuple[MotionMove, ...]:
        """The moves of the routine, in order: a tuple of `MotionMove`."""
    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings on moves, in order: a tuple of `Finding`."""
    def to_module(self, name: str = "Motion") -> Module:
        r"""Return the motion as a module: a MoveAbsJ to the joints of each target that is met or
        passed, with its external axes, speed, zone, \T, tool and work object.

        Between the targets the joints move evenly. Tools and work objects are declared as
        PERS; speeds and zones that are not RAPID's own are written as numbers.

        Args:
            name: Name of the module.

        Returns:
            Module, which `dump` writes.

        Raises:
            RapidError: The name is not a RAPID identifier.
        """
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(
        self,
    ) -> tuple[Callable[..., RoutineMotion], tuple[Robot, Module, str | None]]: ...

@final
class Shape:
    """A box, sphere, capsule, cylinder, half space, convex hull, triangle mesh, point cloud, or
    several of them. Lengths are in meters.
    """

    @staticmethod
    def box(size: npt.ArrayLike, pose: npt.ArrayLike | None = None) -> Shape:
        """A box.

        Args:
            size: Lengths of its edges along x, y and z [m], shape (3,).
            pose: Pose of its middle, shape (4, 4), or its position alone [m], shape (3,); the
                identity when not given.

        Raises:
            InvalidModelError: A length that is not positive or more than 100 m, or a pose
                farther away.
            InvalidPoseError: pose is not a rigid transform.
        """
    @staticmethod
    def sphere(radius: float, center: npt.ArrayLike) -> Shape:
        """A sphere.

        Args:
            radius: Its radius [m].
            center: Its center [m], shape (3,).

        Raises:
            InvalidModelError: A radius that is not positive or more than 100 m, or a center
                farther away.
        """
    @staticmethod
    def capsule(a: npt.ArrayLike, b: npt.ArrayLike, radius: float) -> Shape:
        """All points within a radius of a line segment.

        Args:
            a: One end of the segment [m], shape (3,).
            b: The other end [m], shape (3,).
            radius: The radius [m].

        Raises:
            InvalidModelError: A radius that is not positive or more than 100 m, or an end
                farther away.
        """
    @staticmethod
    def cylinder(radius: float, length: float, pose: npt.ArrayLike | None = None) -> Shape:
        """A cylinder along the z axis of its pose.

        Args:
            radius: Its radius [m].
            length: Its length [m].
            pose: As of `box`.

        Raises:
            InvalidModelError: A length that is not positive or more than 100 m, or a pose
                farther away.
            InvalidPoseError: pose is not a rigid transform.
        """
    @staticmethod
    def convex(
        points: npt.ArrayLike | str | PathLike[str],
        pose: npt.ArrayLike | None = None,
        *,
        scale: float = 1.0,
    ) -> Shape:
        """The convex hull of points.

        Args:
            points: At least four points that are in no plane [m], shape (n, 3); or a file of a
                mesh, whose corners they are.
            pose: Pose of the frame of the points, shape (4, 4); the identity when not given.
            scale: Meters of a unit of the points: 0.001 of millimeters.

        Raises:
            InvalidModelError: Points that are not finite, in a plane, or more than 100 m apart.
            InvalidPoseError: pose is not a rigid transform.
            ImportError: A file is given and trimesh is not installed.
        """
    @staticmethod
    def mesh(
        triangles: npt.ArrayLike | str | PathLike[str],
        pose: npt.ArrayLike | None = None,
        *,
        scale: float = 1.0,
        solid: bool = True,
    ) -> Shape:
        """A triangle mesh: what is inside belongs to it.

        Args:
            triangles: The corners of its triangles [m], shape (n, 3, 3); or a file (STL, OBJ, DAE,
                PLY, OFF, GLB, glTF, 3MF). A solid mesh is closed; its corners are counterclockwise,
                seen from outside. If it is not, corners within 1e-6 m, or a millionth of its size,
                are made one: it is off by as much.
            pose: Pose of the frame of the mesh, shape (4, 4); the identity when not given.
            scale: Meters of a unit of the mesh: 0.001 of millimeters. A file that states its unit
                is converted to meters first.
            solid: False for its surface alone, which need not be closed. Inside of it is free.

        Raises:
            InvalidModelError: Corners that are not finite or more than 100 m apart, a solid mesh
                that is not closed or has no volume.
            InvalidPoseError: pose is not a rigid transform.
            ImportError: A file is given and trimesh is not installed.
        """
    @staticmethod
    def points(points: npt.ArrayLike, radius: float, pose: npt.ArrayLike | None = None) -> Shape:
        """A cloud of points, each with a ball around it.

        Args:
            points: The points [m], shape (n, 3).
            radius: The radius of the balls [m]; the distance of neighboring points leaves no gaps
                between them.
            pose: Pose of the frame of the points, shape (4, 4); the identity when not given.

        Raises:
            InvalidModelError: Points that are not finite or more than 100 m apart, a radius that
                is not positive.
            InvalidPoseError: pose is not a rigid transform.
        """
    @staticmethod
    def union(shapes: Sequence[Shape]) -> Shape:
        """Several shapes as one.

        Args:
            shapes: At least one shape.

        Raises:
            InvalidModelError: No shape.
        """
    def data(self) -> dict[str, Any]:
        """Return the shape as plain data, which JSON takes: the name of its constructor as `kind`,
        and the arguments that make it again.

        Returns:
            A dict of numbers and nested lists; lengths in meters, a pose as four rows.
        """
    def moved(self, T: npt.ArrayLike) -> Shape:
        """Return the shape moved from a frame, whose pose is given, into the frame of the pose.

        Args:
            T: Pose of the frame that the shape is in, shape (4, 4).

        Raises:
            InvalidModelError: The shape is more than 100 m away then.
            InvalidPoseError: T is not a rigid transform.
        """
    @staticmethod
    def half_space(normal: npt.ArrayLike, point: npt.ArrayLike) -> Shape:
        """Everything behind a plane.

        Args:
            normal: Normal of the plane, which points out of the solid: (0, 0, 1) of a floor.
            point: A point of the plane [m], shape (3,).

        Raises:
            InvalidModelError: A normal of length zero, or a point more than 100 m away.
        """
    def __reduce__(self) -> tuple[Callable[[str, bytes], Any], tuple[str, bytes]]: ...

@final
class Body:
    """Capsules that contain the links of an arm, and the pairs of links that are kept apart."""

    def __new__(
        cls,
        links: Sequence[int] | npt.NDArray[np.integer[Any]],
        capsules: npt.ArrayLike,
        pairs: Sequence[tuple[int, int]],
        *,
        hulls: Sequence[tuple[int, npt.ArrayLike, Any, float]] | None = None,
        source: str = "given",
        excess: Sequence[float] | npt.NDArray[np.float64] | None = None,
    ) -> Body: ...
    def with_capsules(
        self, links: Sequence[int] | npt.NDArray[np.integer[Any]], capsules: npt.ArrayLike
    ) -> Body:
        """Return the body with more capsules: a hose, a dress pack. Rods and cylinders that move
        beside the links stay.

        Args:
            links: The link of each capsule, shape (k,).
            capsules: Both ends of the axis and the radius of each [m], shape (k, 7).

        Raises:
            InvalidModelError: A radius that is not positive, a wrong shape.
        """
    @staticmethod
    def fit(
        urdf: str | bytes | PathLike[str],
        base: str | None = None,
        tip: str | None = None,
        *,
        excess: float | None = None,
        most: int = 4,
        packages: Mapping[str, str | PathLike[str]] | None = None,
        joints: Mapping[str, float] | None = None,
        progress: Report | Bar | None = None,
    ) -> Body:
        """Fit capsules to the meshes of a URDF: they contain every triangle, and the inside of
        closed meshes. It needs `pip install 'irbkin[mesh]'`, and takes 15 to 60 s for an arm.

        Of each link, the meshes and shapes of its `collision` elements, or of its `visual` ones
        where it has none; of links behind joints beside the arm, as of a gripper, wherever these
        joints may be. `source` names them. Links that are not neighbors are kept apart; left out
        are pairs that touch in all of 2,000 random postures inside the limits, and pairs whose
        capsules touch in more than 2 % of these and whose meshes do in none. The same body comes
        out each time.

        Args:
            urdf: As of `Robot.from_urdf`.
            base: As of `Robot.from_urdf`.
            tip: As of `Robot.from_urdf`.
            excess: How far 95 % of the surface of the capsules of a link may be outside its mesh
                [m]: the fewest that meet it are taken. When not given, or not met, as many as
                `most` allows.
            most: Capsules of a link at most, 1 to 12.
            packages: Folder of each package that `package://` names; a folder of that name above
                the URDF when not given.
            joints: Where joints beside the arm are, by their names [rad or m]: their links, and
                links of joints that mimic them, are in the body there alone.
            progress: Called with the number of links that are fitted, and of all; or a bar as
                `tqdm.tqdm()`.

        Raises:
            InvalidModelError: As `Robot.from_urdf`; a file is no mesh, no link has a shape, the
                joint in front of one has no end, or a joint is unknown, of the arm, or cannot be
                where it is given.
            FileNotFoundError: A mesh is not found.
            ImportError: trimesh or scipy is not installed.
        """
    @property
    def links(self) -> npt.NDArray[np.int64]:
        """The link of each capsule, shape (k,)."""
    @property
    def capsules(self) -> _Floats:
        """Both ends of the axis and the radius of each capsule [m], shape (k, 7), in the frame
        of its link: of link k `Robot.link_frames(q)[k - 1]`, of link 0 the base, of link n + 1
        the flange.
        """
    @property
    def hulls(self) -> list[tuple[int, _Floats, list[list[int]], float]]:
        """The hulls, as they are given: link, points [m], shape (p, 3), faces, radius [m]."""
    @property
    def pairs(self) -> list[tuple[int, int]]:
        """The pairs of links that are kept apart. The others may touch by construction or, of a
        body of the catalog, never do inside the catalog's limits.
        """
    @property
    def is_approximate(self) -> bool:
        """Whether it is made of the lengths of the kinematic table alone: the arm may be
        outside.
        """
    @property
    def source(self) -> str:
        """Repository, commit, file and license of the meshes that it contains; or what else it
        is of.
        """
    @property
    def excess(self) -> _Floats:
        """How far outside its mesh 95 % of the surface of the capsules of each link are at most
        [m], and all of the surface of what the flange carries, shape (n + 1,) or (n + 2,); empty
        if it is not known.
        """
    def __reduce__(self) -> tuple[Callable[[str, bytes], Any], tuple[str, bytes]]: ...

@final
class Cell:
    """Obstacles around an arm: whether it touches them or itself.

    Args:
        obstacles: The `Shape` of each by its name, in the world; none when not given.
        margin: How far the arm is to stay from them [m].
        may_touch: Pairs of an obstacle's name and a link that are not compared, as
            ("table", 1); none when not given.

    Raises:
        InvalidModelError: A margin that is negative or not finite, a name that no obstacle has, a
            link other than 1 to 7.
    """

    def __new__(
        cls,
        obstacles: Mapping[str, Shape] | None = None,
        margin: float = 0.0,
        may_touch: Sequence[tuple[str, int]] | None = None,
    ) -> Cell: ...
    @staticmethod
    def load(path: Any, *, joints: Mapping[str, float] | None = None, solid: bool = True) -> Cell:
        """Read a cell of TOML, of URDF or of MoveIt, as described in docs/guide/cell.md.

        Args:
            path: A file in .toml, .urdf or .xml, or a PlanningScene or its dict.
            joints: Where the joints of a URDF are that are of no arm, by name [rad or m].
            solid: False to take open meshes by their surface alone, inside of which is free.

        Raises:
            InvalidModelError: An unknown key or frame, a shape that cannot be; the message names
                the entry and, where there is one, the line.
            ImportError: A mesh is in the file and trimesh is not installed.
            OSError: The file cannot be read.
        """
    def with_robot(self, name: str, robot: Robot, q: npt.ArrayLike | Solution) -> Cell:
        """Return the cell with another arm in it, which stands still.

        Args:
            name: The arm's name: its link 3 is the obstacle "left, link 3" if the name is "left".
            robot: The arm, at its base (`Robot.with_base`).
            q: Its joint angles [rad], shape (n,).

        Raises:
            InvalidJointsError: A wrong shape, or joints that are not finite.
            InvalidModelError: The robot has no body, or an obstacle has one of these names.
        """
    @property
    def may_touch(self) -> list[tuple[str, int]]:
        """The pairs of an obstacle's name and a link that are not compared."""
    @property
    def obstacles(self) -> dict[str, Shape]:
        """The `Shape` of each obstacle, by its name."""
    @property
    def margin(self) -> float:
        """How far the arm is to stay from the obstacles [m]."""
    def collides(
        self,
        robot: Robot,
        q: npt.ArrayLike | Solution,
        out: npt.NDArray[np.bool_] | None = None,
        *,
        threads: int = 1,
    ) -> npt.NDArray[np.bool_]:
        """Whether an arm touches itself, or comes nearer to an obstacle than the margin.

        The links are inside the capsules of `robot.body`: what does not collide is free, what
        collides may be free by as much as `robot.body.excess`. The base, link 0, is not compared
        with obstacles: it stands on one.

        Args:
            robot: The arm.
            q: Joint angles [rad], shape (..., n).
            out: Array to write to, shape (...), bool.
            threads: Number of threads; 0 for one a core.

        Returns:
            Truth values, shape (...).

        Raises:
            InvalidJointsError: A wrong shape, or joints that are not finite.
            InvalidModelError: The robot has no body.
        """
    def distance(self, robot: Robot, q: npt.ArrayLike | Solution) -> CellDistance:
        """How far the nearest two are apart: two links of the arm, or a link and an obstacle.

        Args:
            robot: The arm.
            q: Joint angles [rad], shape (..., n).

        Returns:
            CellDistance: distances [m], names of the pairs, nearest points [m], gradients [m/rad].

        Raises:
            InvalidJointsError: A wrong shape, or joints that are not finite.
            InvalidModelError: The robot has no body.
        """
    def check_path(self, robot: Robot, motion: npt.ArrayLike | Trajectory) -> CellContact | None:
        """Where a motion first touches something, between its samples too: `None` if it is proven
        that it never does.

        Between two rows each joint moves evenly. Parts of the motion are proven by bounds of how
        far the links move, and halved where that fails; what comes nearer than 0.1 mm to a
        collision counts as one.

        Args:
            robot: The arm.
            motion: Joint angles [rad], shape (m, n), or a `Trajectory`.

        Returns:
            CellContact: the first instant, the joint angles, the two that touch, the depth; or
            None.

        Raises:
            InvalidJointsError: A wrong shape, or joints that are not finite.
            InvalidModelError: The robot has no body.
            ValueError: A trajectory of another number of joints.
        """
    def __reduce__(self) -> tuple[Callable[[str, bytes], Any], tuple[str, bytes]]: ...

@final
class PageEngine:
    """The engine of a page in a browser, with the robot, the cell and the program that requests
    set.
    """

    def __new__(cls) -> PageEngine: ...
    def answer(self, request: str) -> str:
        """Return the answer to a request, both JSON (page/README.md)."""

@final
class Trajectory:
    """Joint angles, velocities and accelerations over time.

    The arrays are samples of it; `sample` gives the motion at any time, exactly. Between its knots
    each joint is a polynomial in time.
    """

    @property
    def _joint_names(self) -> list[str] | None:
        """Names of the joints, of a robot with a file."""
    @property
    def t(self) -> _Floats:
        """Times of the samples [s], shape (m,)."""
    @property
    def q(self) -> _Floats:
        """Joint angles of the samples [rad], shape (m, n)."""
    @property
    def dq(self) -> _Floats:
        """Joint velocities of the samples [rad/s], shape (m, n)."""
    @property
    def ddq(self) -> _Floats:
        """Joint accelerations of the samples [rad/s^2], shape (m, n)."""
    @property
    def dof(self) -> int:
        """Number of joints."""
    @property
    def duration(self) -> float:
        """Duration [s]."""
    @property
    def knots(self) -> _Floats:
        """Times at which one polynomial ends and the next begins [s], both ends included, shape
        (k,).
        """
    def sample(self, t: npt.ArrayLike) -> TrajectorySample:
        """Joint angles, velocities and accelerations at any time.

        Args:
            t: Times [s], shape (...). Before the start and after the end the joints rest.

        Returns:
            TrajectorySample(q, dq, ddq) [rad, rad/s, rad/s^2], arrays of shape (..., n).

        Raises:
            InvalidMotionError: A time is NaN.
        """
    def peaks(self) -> MotionPeaks:
        """The largest velocity, acceleration and jerk of each joint, exact between samples too.

        Returns:
            MotionPeaks(velocity, acceleration, jerk) [rad/s, rad/s^2, rad/s^3], arrays of shape
            (n,). A jump of the acceleration at a knot does not count as jerk.
        """
    def range(self) -> _Floats:
        """Return the least and the greatest angle of each joint, exact between samples too.

        Returns:
            Angles [rad], shape (n, 2), as `robot.limits` has them.
        """

    def check_limits(self, limits: npt.ArrayLike) -> None:
        """Refuse the motion if a joint leaves limits by more than 1e-9 rad, between samples too.

        Args:
            limits: Lower and upper limits of the joint angles [rad], shape (n, 2).

        Raises:
            InvalidMotionError: The joint that leaves them farthest, with the time, its angle and
                the limit; or a wrong shape.
        """

    def __call__(self, t: npt.ArrayLike) -> _Floats: ...
    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the samples as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
        table.

        Returns:
            Arrays of shape (m,) by name: `t` [s], `q1` .. [rad], `dq1` .. [rad/s], `ddq1` ..
            [rad/s^2].
        """
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write comma-separated values: the columns of `to_dict` under their names, each number
        with all of its digits, nothing for None.

        Args:
            path_or_file: Path of the file, or a file that is open for text.

        Raises:
            OSError: The file cannot be written.
        """
    def to_joint_trajectory(self, joint_names: Sequence[str] | None = None) -> dict[str, Any]:
        """Return the samples with the fields of ROS' `trajectory_msgs/JointTrajectory`. It needs no
        ROS; `rosidl_runtime_py.set_message_fields` fills a message with it.

        Args:
            joint_names: Names of the joints in ROS; when not given, as in the file of the robot
                whose `go` made the motion, else `joint_1` .. as in `robot.to_urdf()`.

        Returns:
            {"joint_names": [..], "points": [..]}. A point has `positions` [rad], `velocities`
            [rad/s] and `accelerations` [rad/s^2], lists of n floats, and `time_from_start`:
            {"sec": .., "nanosec": ..}.

        Raises:
            InvalidJointsError: There is not one name for each joint.
        """
    def resampled(self, steps: int | None = None, *, dt: float | None = None) -> Trajectory:
        """Return the motion with other samples, evenly over the duration, both ends included.

        Args:
            steps: Number of samples.
            dt: Instead of `steps`, the largest time between two samples [s]: they are `dt` apart
                or, unless that divides the duration, a little less.

        Raises:
            InvalidMotionError: Fewer than two or more than ten million samples, or `dt` is not
                positive.
            TypeError: Not one of both is given, or steps is not a whole number.
        """
    def stretched(self, factor: float) -> Trajectory:
        """Return the motion at another pace.

        Args:
            factor: What every time is multiplied by; 2 is half the speed.

        Raises:
            InvalidMotionError: The factor is not positive and finite.
        """
    def slice(self, start: float, end: float) -> Trajectory:
        """The part between two times, which begins at t = 0.

        Args:
            start: Its start [s].
            end: Its end [s].

        Returns:
            The part, with the samples that lie in it and both ends.

        Raises:
            InvalidMotionError: Unless 0 <= start < end <= duration.
        """
    def __add__(self, next: Trajectory, /) -> Trajectory: ...
    def __radd__(self, value: Trajectory, /) -> Trajectory: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

def joint(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    *,
    steps: int = 50,
    duration: float | None = None,
    profile: Literal["quintic", "cubic", "trapezoid", "s_curve"] = "quintic",
    start_velocity: npt.ArrayLike | None = None,
    end_velocity: npt.ArrayLike | None = None,
    start_acceleration: npt.ArrayLike | None = None,
    end_acceleration: npt.ArrayLike | None = None,
    max_velocity: npt.ArrayLike | None = None,
    max_acceleration: npt.ArrayLike | None = None,
    max_jerk: npt.ArrayLike | None = None,
    synchronization: Literal["time", "phase"] = "time",
    limits: npt.ArrayLike | None = None,
) -> Trajectory:
    """Move from one joint vector to another.

    Args:
        q0: Joint angles at the start [rad], shape (n,).
        q1: Joint angles at the end [rad], shape (n,).
        steps: Number of samples, both ends included.
        duration: Duration [s]; 1 where neither it nor a limit is given, the shortest that the
            limits allow where only limits are given.
        profile: "quintic", "cubic", "trapezoid" (constant acceleration, a third of the duration
            each) or "s_curve" (the same with constant jerk).
        start_velocity: Velocities at the start [rad/s], of a quintic or a cubic; zero.
        end_velocity: Velocities at the end [rad/s], of a quintic or a cubic; zero.
        start_acceleration: Accelerations at the start [rad/s^2], of a quintic; zero.
        end_acceleration: Accelerations at the end [rad/s^2], of a quintic; zero.
        max_velocity: Limits [rad/s], a number or shape (n,).
        max_acceleration: Limits [rad/s^2], a number or shape (n,).
        max_jerk: Limits [rad/s^3], a number or shape (n,).
        synchronization: With limits alone: "time", each joint has a profile of its own, slowed down
            to the slowest; or "phase", a straight line in joint space.
        limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
            instance: the motion must stay inside, between waypoints too.

    Returns:
        The trajectory, which meets both ends. With a duration and limits it is checked against
        them.

    Raises:
        InvalidMotionError: A limit or the duration is not positive, the duration is too short for
            a limit, a joint moves and no limit binds it or leaves `limits`, or the profile cannot
            have what is given for an end.
        InvalidJointsError: A wrong shape, or angles in degrees without `limits`.
    """

def spline(
    q: npt.ArrayLike,
    *,
    t: npt.ArrayLike | None = None,
    steps: int = 100,
    duration: float | None = None,
    profile: Literal["quintic", "cubic"] = "quintic",
    max_velocity: npt.ArrayLike | None = None,
    max_acceleration: npt.ArrayLike | None = None,
    max_jerk: npt.ArrayLike | None = None,
    limits: npt.ArrayLike | None = None,
) -> Trajectory:
    """Move through many joint vectors on a smooth curve, at rest at both ends.

    Args:
        q: Waypoints [rad], shape (m, n).
        t: Times of the waypoints [s], shape (m,), increasing. The trajectory begins at 0: only
            their differences count. Without them they are spaced by the distances of the waypoints.
        steps: Number of samples.
        duration: Duration without `t` [s]; 1 where no limit is given.
        profile: "quintic" (zero acceleration at both ends, four continuous derivatives) or "cubic"
            (two).
        max_velocity: Limits [rad/s], a number or shape (n,): without `t` and `duration` the curve
            is as fast as they allow.
        max_acceleration: Limits [rad/s^2], in the same way.
        max_jerk: Limits [rad/s^3], in the same way.
        limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
            instance: the motion must stay inside, between waypoints too.

    Returns:
        The trajectory, which passes every waypoint.

    Raises:
        InvalidMotionError: Fewer than two waypoints, waypoints that repeat the one before without
            `t`, times that do not increase, a limit that is exceeded or not positive, or a joint
            that leaves `limits`: the message has the joint, the time, its angle and the limit.
        InvalidJointsError: A wrong shape, or angles in degrees without `limits`.
    """

def retime(
    q: npt.ArrayLike,
    max_velocity: npt.ArrayLike | None,
    max_acceleration: npt.ArrayLike,
    *,
    max_jerk: npt.ArrayLike | None = None,
    T: npt.ArrayLike | None = None,
    max_tool_speed: float | None = None,
    start_velocity: npt.ArrayLike | None = None,
    end_velocity: npt.ArrayLike | None = None,
    limits: npt.ArrayLike | None = None,
    steps: int | None = None,
) -> Trajectory:
    """Move along a path in the shortest time within limits.

    The path is a cubic spline through the samples. No joint exceeds a velocity, an acceleration
    or a jerk anywhere; with `limits` its angle is checked between the samples too. Catalogs have no
    accelerations: they are the caller's.

    Args:
        q: Samples of the path [rad], shape (m, n), of `robot.follow` for instance.
        max_velocity: Limits [rad/s], a number or shape (n,); `robot.max_velocity` has a robot's.
        max_acceleration: Limits [rad/s^2], a number or shape (n,).
        max_jerk: Limits [rad/s^3] of a motion from rest to rest, a number or shape (n,). Without
            them the accelerations jump.
        T: With `max_tool_speed`, the poses of the tool at the samples, shape (m, 4, 4).
        max_tool_speed: Speed along `T` [m/s] that is not exceeded: the tool has it where the limits
            allow.
        start_velocity: Velocities of the joints at the start [rad/s], shape (n,), in the direction
            of the path: `dq` of a motion along it. Rest if not given.
        end_velocity: Velocities of the joints at the end, in the same way.
        limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
            instance: the motion must stay inside, between waypoints too.
        steps: Number of samples of the answer; as many as `q` has where it is not given.

    Returns:
        The trajectory.

    Raises:
        InvalidMotionError: No rows, a limit that is not positive, a path that no limit binds, a
            duration that is not between 1e-9 and 1e9 s, a velocity at an end that is not along the
            path or too fast for it, a joint that leaves `limits` (the message has the joint, the
            time, its angle and the limit) or, with `max_tool_speed`, a part of the path on which
            the tool only turns, or a step of a joint above 0.1 rad, between whose samples the tool
            would leave `T`.
        InvalidJointsError: A wrong shape, an angle that is not finite, or angles in degrees without
            `limits`.
        InvalidPoseError: A pose is not a rigid transform or in millimeters, or `T` has another
            number of poses.
        TypeError: `max_velocity` is None.
    """

def at_tool_speed(
    q: npt.ArrayLike,
    T: npt.ArrayLike,
    speed: float,
    max_velocity: npt.ArrayLike | None,
    max_acceleration: npt.ArrayLike | None = None,
    *,
    limits: npt.ArrayLike | None = None,
    steps: int | None = None,
) -> Trajectory:
    """Move along a path at a constant speed of the tool, which moves at both ends.

    The joints are a cubic spline over the length of the tool's path, a polygon through its poses.
    `retime` with `max_tool_speed` begins and ends at rest, and is slower where limits demand it.

    Args:
        q: As of `retime`.
        T: Poses of the tool at the samples, shape (m, 4, 4).
        speed: Speed of the tool along `T` [m/s].
        max_velocity: As of `retime`.
        max_acceleration: Limits [rad/s^2], a number or shape (n,); none where it is not given.
        limits: As of `retime`.
        steps: Number of samples of the answer; as many as `q` has where it is not given.

    Returns:
        The trajectory.

    Raises:
        InvalidMotionError: A joint does not allow the speed: the message names it, the sample and
            the speed that it allows; the speed or a limit is not positive, a joint leaves
            `limits`, or the tool only turns on a part of the path.
        InvalidJointsError, InvalidPoseError: As `retime`.
    """

def tool_speed_limits(
    q: npt.ArrayLike,
    T: npt.ArrayLike,
    max_velocity: npt.ArrayLike | None,
    max_acceleration: npt.ArrayLike | None = None,
) -> ToolSpeedLimits:
    """Return the highest constant speed of the tool that the limits of the joints allow, and which
    joint limits it.

    Args:
        q: As of `retime`.
        T: Poses of the tool at the samples, shape (m, 4, 4).
        max_velocity: As of `retime`.
        max_acceleration: Limits [rad/s^2], a number or shape (n,); none where it is not given.

    Returns:
        ToolSpeedLimits(speed [m/s], joint, fastest [m/s], fastest_joint, fastest_index): speed and
        joint for each sample, shape (m,), and the fastest constant speed of the whole path, between
        the samples too, which `at_tool_speed` takes.

    Raises:
        InvalidMotionError: No rows, a limit that is not positive, or a part of the path on which
            the tool only turns.
        InvalidJointsError, InvalidPoseError: As `retime`.
    """

def path_spline(
    T: npt.ArrayLike,
    *,
    steps: int | None = None,
    step: float | None = None,
    turn: float | None = None,
    speed: float | None = None,
    dt: float | None = None,
) -> _Floats:
    """Move the tool on a smooth curve through poses, all of which are met.

    The position is a cubic spline with continuous second derivative; angular velocity and
    acceleration are continuous along it. Where the tool only turns it stops, and turns about one
    axis. Through two poses the curve is a line.

    Args:
        T: Poses, shape (m, 4, 4). One that repeats the one before it, within 1e-9 m and rad, is
            left out.
        steps: As of `line`.
        step: As of `line`, along the path.
        turn: As of `line`.
        speed: As of `line`.
        dt: As of `line`.

    Returns:
        Poses, shape (k, 4, 4), with the poses of `T` among them: from each to the next in equal
        steps along the curve.

    Raises:
        InvalidPoseError: A pose is not a rigid transform, or in millimeters.
        InvalidMotionError: No pose, a turn by 180 deg between two poses, fewer `steps` than poses,
            or a spacing that does not say how many poses there are.
    """

def line(
    T0: npt.ArrayLike,
    T1: npt.ArrayLike,
    *,
    steps: int | None = None,
    step: float | None = None,
    turn: float | None = None,
    speed: float | None = None,
    dt: float | None = None,
    axis: npt.ArrayLike | None = None,
) -> _Floats:
    """Move the tool on a straight line, its orientation turning evenly about one axis (slerp).

    Args:
        T0: Pose at the start, shape (4, 4).
        T1: Pose at the end, shape (4, 4).
        steps: Number of poses, both ends included.
        step: Instead of `steps`, the largest distance of two poses [m].
        turn: With or instead of `step`, the largest turn between two poses [rad].
        speed: Instead of `step`, the speed of the tool [m/s]: poses `dt` apart in time move it so
            fast or, for a whole number of steps, a little slower.
        dt: With `speed`, the time from one pose to the next [s].
        axis: Axis of a turn by 180 deg, shape (3,), in the frame of the poses: the tool turns
            counterclockwise about it. Without it such a turn is refused, for there are two ways.

    Returns:
        Poses, shape (m, 4, 4). Of equal poses with `step`: one.

    Raises:
        InvalidPoseError: A pose is not a rigid transform, or in millimeters.
        InvalidMotionError: The tool turns by 180 deg and `axis` does not say how, or neither
            `step` nor `turn` says how many poses there are.
    """

def arc(
    T0: npt.ArrayLike,
    T_via: npt.ArrayLike,
    T1: npt.ArrayLike,
    *,
    orientation: Literal["path", "object", "via"] = "path",
    steps: int | None = None,
    step: float | None = None,
    turn: float | None = None,
    speed: float | None = None,
    dt: float | None = None,
) -> _Floats:
    r"""Move the tool on a circular arc through three poses.

    Args:
        T0: Pose at the start, shape (4, 4).
        T_via: Pose that the arc passes, shape (4, 4).
        T1: Pose at the end, shape (4, 4).
        orientation: "path", the tool turns evenly relative to the path (ABB's \PathFrame);
            "object", evenly relative to the base (\ObjectFrame); "via", evenly to the orientation
            of `T_via` and then of `T1` (\CirPointOri).
        steps: As of `line`.
        step: As of `line`, along the path.
        turn: As of `line`.
        speed: As of `line`.
        dt: As of `line`.

    Returns:
        Poses, shape (m, 4, 4).

    Raises:
        InvalidPoseError: A pose is not a rigid transform, or in millimeters.
        InvalidMotionError: The points lie on a line or coincide, or the tool turns by 180 deg.
    """

def polyline(
    T: npt.ArrayLike,
    zones: float | str | Sequence[float | str] | _Floats,
    *,
    steps: int | None = None,
    step: float | None = None,
    turn: float | None = None,
    speed: float | None = None,
    dt: float | None = None,
) -> _Floats:
    """Move the tool on lines from pose to pose, with rounded corners.

    Inside a zone the position runs on a parabola, as ABB's manual describes its corners; the
    orientation is blended over its own zone. A zone reaches half of the way to a neighbor at most.

    Args:
        T: Poses, shape (m, 4, 4).
        zones: For each pose a radius [m] or one of ABB's names, "fine", "z0" .. "z200"; or one for
            all. Zones of the first and the last pose do not matter: both are met.
        steps: As of `line`.
        step: As of `line`, along the path.
        turn: As of `line`.
        speed: As of `line`.
        dt: As of `line`.

    Returns:
        Poses, shape (k, 4, 4). A corner with a zone of radius r, where the direction changes by an
        angle a, is passed at a distance of r / 2 sin(a / 2).

    Raises:
        InvalidPoseError: A pose is not a rigid transform, or in millimeters.
        InvalidMotionError: No pose, another number of zones, a zone that is negative or not known,
            or a turn by 180 deg between two poses.
    """

def encode(message: EgmRobot | EgmSensor) -> bytes:
    """Return the bytes of a message, its fields in the order of their numbers.

    Args:
        message: An EgmRobot or an EgmSensor.

    Raises:
        TypeError: It is neither, or a field has another type or more bits.
        StreamError: It is longer than a datagram.
    """

def decode(data: bytes, kind: type[_Message]) -> _Message:
    """Return the message of a datagram. Fields that egm.proto does not have are skipped.

    Args:
        data: The bytes.
        kind: EgmRobot, what a controller sends, or EgmSensor, what it receives.

    Raises:
        TypeError: `kind` is another class.
        StreamError: The bytes are no such message: the byte, the field and the reason.
    """
