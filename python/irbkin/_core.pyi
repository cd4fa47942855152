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
    "FIRST_TAG",
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
    "port_program",
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
) -> tuple[str, ...]: ...
def catalog_entry(name: str) -> CatalogEntry: ...
def instruction_set() -> str: ...
def instruction_sets() -> tuple[str, ...]: ...
def use_instruction_set(name: str) -> None: ...
def pose(
    xyz: npt.ArrayLike,
    wxyz: npt.ArrayLike | None = None,
    xyzw: npt.ArrayLike | None = None,
    euler_zyx: npt.ArrayLike | None = None,
    rotation: npt.ArrayLike | _Rotation | None = None,
    rotvec: npt.ArrayLike | None = None,
) -> _Floats: ...
def to_xyz_wxyz(T: npt.ArrayLike) -> tuple[_Floats, _Floats]: ...
def to_xyz_euler_zyx(T: npt.ArrayLike) -> tuple[_Floats, _Floats]: ...
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
    @property
    def cf1(self) -> int: ...
    @property
    def cf4(self) -> int: ...
    @property
    def cf6(self) -> int: ...
    @property
    def cfx(self) -> int: ...
    def __new__(cls, cf1: int, cf4: int, cf6: int, cfx: int) -> Configuration: ...

@final
class IkBatch(_Record):
    @property
    def q(self) -> _Floats: ...
    @property
    def status(self) -> npt.NDArray[np.uint8]: ...
    def __new__(cls, q: _Floats, status: npt.NDArray[np.uint8]) -> IkBatch: ...
    @property
    def found(self) -> npt.NDArray[np.bool_]: ...
    @property
    def within_limits(self) -> npt.NDArray[np.bool_]: ...
    def to_dict(self) -> dict[str, npt.NDArray[Any]]: ...
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None: ...

@final
class FreeJoint(_Record):
    @property
    def joint(self) -> int: ...
    @property
    def fixed(self) -> str: ...
    def __new__(cls, joint: int, fixed: str) -> FreeJoint: ...

@final
class Break(_Record):
    @property
    def pose_index(self) -> int: ...
    @property
    def reason(self) -> str: ...
    @property
    def path(self) -> tuple[int, ...]: ...
    @property
    def kind(self) -> BreakReason: ...
    def __new__(
        cls, pose_index: int, reason: str, path: tuple[int, ...], kind: BreakReason
    ) -> Break: ...

@final
class FollowResult(_Record):
    @property
    def q(self) -> _Floats: ...
    @property
    def orientation_error(self) -> _Floats: ...
    @property
    def breaks(self) -> tuple[Break, ...]: ...
    def to_dict(self) -> dict[str, npt.NDArray[Any]]: ...
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None: ...
    def __new__(
        cls, q: _Floats, orientation_error: _Floats, breaks: tuple[Break, ...]
    ) -> FollowResult: ...

@final
class ConfigurationBatch(_Record):
    @property
    def cf1(self) -> npt.NDArray[np.int32]: ...
    @property
    def cf4(self) -> npt.NDArray[np.int32]: ...
    @property
    def cf6(self) -> npt.NDArray[np.int32]: ...
    @property
    def cfx(self) -> npt.NDArray[np.int32]: ...
    def __new__(
        cls,
        cf1: npt.NDArray[np.int32],
        cf4: npt.NDArray[np.int32],
        cf6: npt.NDArray[np.int32],
        cfx: npt.NDArray[np.int32],
    ) -> ConfigurationBatch: ...

@final
class CellContact(_Record):
    @property
    def at(self) -> float: ...
    @property
    def q(self) -> _Floats: ...
    @property
    def pair(self) -> tuple[str, str]: ...
    @property
    def depth(self) -> float: ...
    def __new__(cls, at: float, q: _Floats, pair: tuple[str, str], depth: float) -> CellContact: ...

@final
class CellDistance(_Record):
    @property
    def distance(self) -> _Floats: ...
    @property
    def pair(self) -> tuple[tuple[str, str], ...]: ...
    @property
    def points(self) -> _Floats: ...
    @property
    def gradient(self) -> _Floats: ...
    def __new__(
        cls,
        distance: _Floats,
        pair: tuple[tuple[str, str], ...],
        points: _Floats,
        gradient: _Floats,
    ) -> CellDistance: ...

@final
class Singularity(_Record):
    @property
    def wrist(self) -> Any: ...
    @property
    def elbow(self) -> Any: ...
    @property
    def shoulder(self) -> Any: ...
    @property
    def min_singular_value(self) -> Any: ...
    @property
    def manipulability(self) -> Any: ...
    @property
    def kinds(self) -> Any: ...
    def __new__(
        cls,
        wrist: Any,
        elbow: Any,
        shoulder: Any,
        min_singular_value: Any,
        manipulability: Any,
        kinds: Any,
    ) -> Singularity: ...
    def near(self, angle: float = ..., length: float = ...) -> Any: ...

@final
class Margin(_Record):
    @property
    def limits(self) -> _Floats: ...
    @property
    def singularities(self) -> _Floats: ...
    def __new__(cls, limits: _Floats, singularities: _Floats) -> Margin: ...

@final
class IkMargin(_Record):
    @property
    def margin(self) -> _Floats: ...
    @property
    def singularities(self) -> _Floats: ...
    @property
    def solutions(self) -> npt.NDArray[np.uint8]: ...
    def __new__(
        cls, margin: _Floats, singularities: _Floats, solutions: npt.NDArray[np.uint8]
    ) -> IkMargin: ...

@final
class PoseCheck(_Record):
    @property
    def reachable(self) -> bool: ...
    @property
    def within_limits(self) -> bool: ...
    @property
    def reason(self) -> str: ...
    def __new__(cls, reachable: bool, within_limits: bool, reason: str) -> PoseCheck: ...

@final
class CatalogEntry(_Record):
    @property
    def name(self) -> str: ...
    @property
    def maker(self) -> Literal["ABB", "Universal Robots", "Franka", "FANUC", "UFACTORY"]: ...
    @property
    def aliases(self) -> tuple[str, ...]: ...
    @property
    def dof(self) -> int: ...
    @property
    def payload(self) -> float | None: ...
    @property
    def reach(self) -> float | None: ...
    @property
    def limits(self) -> _Floats: ...
    @property
    def max_velocity(self) -> _Floats | None: ...
    @property
    def max_acceleration(self) -> _Floats | None: ...
    @property
    def is_coupled(self) -> bool: ...
    @property
    def sources(self) -> int: ...
    @property
    def provenance(self) -> str: ...
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
    def to_dict(self) -> dict[str, Any]: ...

@final
class TrajectorySample(_Record):
    @property
    def q(self) -> _Floats: ...
    @property
    def dq(self) -> _Floats: ...
    @property
    def ddq(self) -> _Floats: ...
    def __new__(cls, q: _Floats, dq: _Floats, ddq: _Floats) -> TrajectorySample: ...

@final
class MotionPeaks(_Record):
    @property
    def velocity(self) -> _Floats: ...
    @property
    def acceleration(self) -> _Floats: ...
    @property
    def jerk(self) -> _Floats: ...
    def __new__(cls, velocity: _Floats, acceleration: _Floats, jerk: _Floats) -> MotionPeaks: ...

@final
class ToolSpeedLimits(_Record):
    @property
    def speed(self) -> _Floats: ...
    @property
    def joint(self) -> npt.NDArray[np.int64]: ...
    @property
    def fastest(self) -> float: ...
    @property
    def fastest_joint(self) -> int: ...
    @property
    def fastest_index(self) -> int: ...
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
    @property
    def leave(self) -> int | None: ...
    @property
    def enter(self) -> int | None: ...
    def __new__(cls, leave: int | None, enter: int | None) -> PlanBreak: ...

@final
class StrandEnd(_Record):
    @property
    def slot(self) -> int: ...
    @property
    def pose_index(self) -> int: ...
    @property
    def reason(self) -> str: ...
    def __new__(cls, slot: int, pose_index: int, reason: str) -> StrandEnd: ...

@final
class Plan(_Record):
    @property
    def q(self) -> _Floats: ...
    @property
    def tool_angle(self) -> _Floats: ...
    @property
    def slot(self) -> npt.NDArray[np.int64]: ...
    @property
    def external(self) -> _Floats: ...
    @property
    def tolerance(self) -> _Floats: ...
    @property
    def cost(self) -> float: ...
    @property
    def bottleneck(self) -> float: ...
    @property
    def breaks(self) -> tuple[PlanBreak, ...]: ...
    @property
    def certified(self) -> bool: ...
    @property
    def T(self) -> _Floats: ...
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
    def to_dict(self) -> dict[str, npt.NDArray[Any]]: ...
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None: ...

@final
class Robot:
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
    ) -> Robot: ...
    @staticmethod
    def from_sdh(
        rows: npt.ArrayLike,
        limits: npt.ArrayLike | None = None,
        name: str = "",
        *,
        snap: float = 0.0,
    ) -> Robot: ...
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
    ) -> Robot: ...
    @staticmethod
    def from_urdf(
        text_or_path: str | bytes | PathLike[str],
        base: str | None = None,
        tip: str | None = None,
        name: str = "",
        *,
        snap: float | None = None,
        args: Mapping[str, str] | None = None,
        packages: Mapping[str, str | PathLike[str]] | None = None,
    ) -> Robot: ...
    @staticmethod
    def from_mjcf(
        path: str | PathLike[str],
        base: str | None = None,
        tip: str | None = None,
        name: str = "",
        *,
        snap: float = 0.0,
    ) -> Robot: ...
    @staticmethod
    def from_robotstudio(
        path: str | PathLike[str], name: str | None = None, *, coupled_limits: bool = True
    ) -> Robot: ...
    def to_urdf(self, visual: bool = False) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def dof(self) -> int: ...
    @property
    def joint_names(self) -> tuple[str, ...]: ...
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
        "pan, three parallel axes, roll",
        "general",
        "refined spherical wrist",
        "refined three parallel axes",
        "unknown",
    ]: ...
    @property
    def mdh(self) -> _Floats: ...
    @property
    def _root(self) -> _Floats:
        """Fixed transform from the base to the frame before the first row of `mdh`, shape (4,
        4).
        """
    @property
    def flange(self) -> _Floats: ...
    @property
    def base(self) -> _Floats: ...
    @property
    def carrier(self) -> Track | None: ...
    @property
    def tool(self) -> _Floats: ...
    @property
    def limits(self) -> _Floats: ...
    @property
    def max_velocity(self) -> _Floats | None: ...
    @property
    def body(self) -> Body | None: ...
    def approximate_body(self) -> Body: ...
    def with_attached(
        self,
        shapes: Shape | Sequence[Shape],
        pose: npt.ArrayLike | None = None,
        *,
        excess: float | None = None,
    ) -> Robot: ...
    def with_body(self, body: Body | None) -> Robot: ...
    def random(
        self, n: int | None = None, rng: np.random.Generator | int | None = None
    ) -> _Floats: ...
    def with_tool(self, T: npt.ArrayLike | ToolData) -> Robot: ...
    def with_base(self, T: npt.ArrayLike) -> Robot: ...
    def at(self, position: npt.ArrayLike) -> Robot: ...
    def _carried(
        self, carrier: Track | Positioner | Sequence[Track | Positioner], values: Sequence[float]
    ) -> Robot: ...
    def with_limits(self, limits: npt.ArrayLike) -> Robot: ...
    @property
    def is_coupled(self) -> bool: ...
    @property
    def linkage_limits(self) -> _Floats | None: ...
    def with_linkage_limits(self, limits: npt.ArrayLike | None) -> Robot: ...
    def uncoupled(self) -> Robot: ...
    def coupled(self) -> Robot: ...
    def fk(self, q: npt.ArrayLike, out: _Floats | None = None) -> _Floats: ...
    def link_frames(self, q: npt.ArrayLike, out: _Floats | None = None) -> _Floats: ...
    def jacobian(
        self, q: npt.ArrayLike, frame: Literal["base", "tool"] = "base", out: _Floats | None = None
    ) -> _Floats: ...
    def with_nominal(self, nominal: Robot | str) -> Robot: ...
    def with_corrections(self, corrections: npt.ArrayLike) -> Robot: ...
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
    ) -> Singularity: ...
    @property
    def heading_tolerance(self) -> float | None: ...
    def with_heading_tolerance(self, tolerance: float) -> Robot: ...
    def heading_error(self, q: npt.ArrayLike, T: npt.ArrayLike) -> float: ...
    def ik(
        self, T: npt.ArrayLike, q7: float | None = None, *, heading_tolerance: float | None = None
    ) -> Solutions: ...
    def ik_batch(
        self,
        T: npt.ArrayLike,
        q7: npt.ArrayLike | None = None,
        *,
        out: IkBatch | tuple[_Floats, npt.NDArray[np.uint8]] | _Floats | None = None,
        threads: int = 1,
        heading_tolerance: float | None = None,
    ) -> IkBatch: ...
    def ik_nearest(
        self,
        T: npt.ArrayLike,
        seed: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        *,
        out: _Floats | None = None,
        threads: int = 1,
        cell: Cell | None = None,
        heading_tolerance: float | None = None,
        position_only: bool = False,
    ) -> _Floats: ...
    def margin(self, q: npt.ArrayLike, *, threads: int = 1) -> Margin: ...
    def ik_margin(
        self,
        T: npt.ArrayLike,
        q7: npt.ArrayLike | None = None,
        *,
        threads: int = 1,
        cell: Cell | None = None,
    ) -> IkMargin: ...
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
    ) -> Plan: ...
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
    ) -> Trajectory: ...
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
    ) -> FollowResult: ...
    @overload
    def configuration(self, q: _Vector) -> Configuration: ...
    @overload
    def configuration(self, q: npt.ArrayLike) -> Configuration | ConfigurationBatch: ...
    def locked(self, given: Mapping[int, float]) -> Robot: ...
    @property
    def six_joints(self) -> Robot | None: ...
    @overload
    def arm_angle(self, q: _Vector) -> float: ...
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
    ) -> _Floats: ...
    def check_pose(self, T: npt.ArrayLike) -> PoseCheck: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Solution:
    @property
    def q(self) -> _Floats: ...
    @property
    def q_deg(self) -> _Floats: ...
    @property
    def slot(self) -> int: ...
    @property
    def is_within_limits(self) -> bool: ...
    @property
    def configuration(self) -> Configuration | None: ...
    @property
    def singularities(self) -> SingularityKind: ...
    @property
    def free_joint(self) -> FreeJoint | None: ...
    @property
    def heading_error(self) -> float: ...
    def with_free_joint(self, value: float) -> Solution: ...
    @property
    def status(self) -> Status: ...
    @property
    def residual(self) -> float: ...
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
    @property
    def q(self) -> _Floats: ...
    @property
    def q_deg(self) -> _Floats: ...
    @property
    def q_by_slot(self) -> _Floats: ...
    @property
    def status(self) -> npt.NDArray[np.uint8]: ...
    @property
    def certified(self) -> bool: ...
    @property
    def reach(self) -> Reach: ...
    @property
    def shortfall(self) -> float: ...
    def explain(self) -> str: ...
    def within_limits(self) -> Solutions: ...
    def turns(self) -> Solutions: ...
    def nearest(self, seed: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> Solution: ...
    def least_motion(
        self, seed: npt.ArrayLike, weights: npt.ArrayLike | None = None
    ) -> Solution: ...
    def filter(self, accept: Callable[[Solution], object] | Cell) -> Solutions: ...
    def to_dict(self) -> dict[str, npt.NDArray[Any]]: ...
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None: ...
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
    def __new__(
        cls, robot: Robot, seed: npt.ArrayLike, weights: npt.ArrayLike | None = None
    ) -> Follower: ...
    @property
    def q(self) -> _Floats: ...
    @property
    def last_break(self) -> Break | None: ...
    def step(self, T: npt.ArrayLike) -> _Floats: ...

@final
class Step(_Record):
    @property
    def q(self) -> _Floats: ...
    @property
    def dq(self) -> _Floats: ...
    @property
    def ddq(self) -> _Floats: ...
    @property
    def accepted(self) -> bool: ...
    @property
    def state(self) -> Literal["following", "braking", "holding"]: ...
    @property
    def reason(self) -> str | None: ...
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
    def robot(self) -> Robot: ...
    @property
    def cycle(self) -> float: ...
    @property
    def state(self) -> Literal["following", "braking", "holding"]: ...
    @property
    def hold(self) -> float: ...
    @property
    def q(self) -> _Floats: ...
    def step(self, reference: npt.ArrayLike | None) -> Step: ...

# What Python's records of RAPID take: array-likes and iterables of numbers.
_Numbers: TypeAlias = npt.ArrayLike | Iterable[float]
_Pose: TypeAlias = "Pose | tuple[_Numbers, _Numbers] | list[_Numbers]"
FIRST_TAG: int
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
    @property
    def trans_mm(self) -> tuple[float, ...]: ...
    @property
    def rot(self) -> tuple[float, ...]: ...
    def __new__(
        cls,
        trans_mm: _Numbers = ...,
        rot: _Numbers = ...,
    ) -> Pose: ...
    @staticmethod
    def of(T: npt.ArrayLike) -> Pose: ...
    def matrix(self) -> _Floats: ...

@final
class RobTarget(_RapidRecord):
    @property
    def trans_mm(self) -> tuple[float, ...]: ...
    @property
    def rot(self) -> tuple[float, ...]: ...
    @property
    def robconf(self) -> Configuration: ...
    @property
    def extax(self) -> tuple[float, ...]: ...
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
    ) -> RobTarget: ...
    def matrix(self) -> _Floats: ...

@final
class JointTarget(_RapidRecord):
    @property
    def robax_deg(self) -> tuple[float, ...]: ...
    @property
    def extax(self) -> tuple[float, ...]: ...
    def __new__(
        cls,
        robax_deg: _Numbers,
        extax: _Numbers = ...,
    ) -> JointTarget: ...
    @staticmethod
    def of(q: _Numbers, extax: _Numbers = ...) -> JointTarget: ...
    @property
    def q(self) -> _Floats: ...

@final
class LoadData(_RapidRecord):
    @property
    def mass_kg(self) -> float: ...
    @property
    def cog_mm(self) -> tuple[float, ...]: ...
    @property
    def aom(self) -> tuple[float, ...]: ...
    @property
    def inertia(self) -> tuple[float, ...]: ...
    def __new__(
        cls,
        mass_kg: float = ...,
        cog_mm: _Numbers = ...,
        aom: _Numbers = ...,
        inertia: _Numbers = ...,
    ) -> LoadData: ...

@final
class ToolData(_RapidRecord):
    @property
    def robhold(self) -> bool: ...
    @property
    def tframe(self) -> Pose: ...
    @property
    def tload(self) -> LoadData: ...
    def __new__(
        cls,
        robhold: bool = ...,
        tframe: _Pose = ...,
        tload: LoadData = ...,
    ) -> ToolData: ...

@final
class WobjData(_RapidRecord):
    @property
    def robhold(self) -> bool: ...
    @property
    def ufprog(self) -> bool: ...
    @property
    def ufmec(self) -> str: ...
    @property
    def uframe(self) -> Pose: ...
    @property
    def oframe(self) -> Pose: ...
    def __new__(
        cls,
        robhold: bool = ...,
        ufprog: bool = ...,
        ufmec: str = ...,
        uframe: _Pose = ...,
        oframe: _Pose = ...,
    ) -> WobjData: ...
    @staticmethod
    def of(T: npt.ArrayLike) -> WobjData: ...

@final
class SpeedData(_RapidRecord):
    @property
    def v_tcp_mm_s(self) -> float: ...
    @property
    def v_ori_deg_s(self) -> float: ...
    @property
    def v_leax_mm_s(self) -> float: ...
    @property
    def v_reax_deg_s(self) -> float: ...
    def __new__(
        cls,
        v_tcp_mm_s: float,
        v_ori_deg_s: float = ...,
        v_leax_mm_s: float = ...,
        v_reax_deg_s: float = ...,
    ) -> SpeedData: ...

@final
class ZoneData(_RapidRecord):
    @property
    def finep(self) -> bool: ...
    @property
    def pzone_tcp_mm(self) -> float: ...
    @property
    def pzone_ori_mm(self) -> float: ...
    @property
    def pzone_eax_mm(self) -> float: ...
    @property
    def zone_ori_deg(self) -> float: ...
    @property
    def zone_leax_mm(self) -> float: ...
    @property
    def zone_reax_deg(self) -> float: ...
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
    @property
    def name(self) -> str: ...
    @property
    def data_type(self) -> str: ...
    @property
    def scope(self) -> Literal["LOCAL", "TASK", ""]: ...
    @property
    def storage(self) -> Literal["CONST", "PERS", "VAR"]: ...
    @property
    def routine(self) -> str | None: ...
    @property
    def value(self) -> Any: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
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
    @property
    def kind(self) -> Literal["PROC", "FUNC", "TRAP"]: ...
    @property
    def name(self) -> str: ...
    @property
    def header(self) -> str: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
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
    @property
    def text(self) -> str: ...
    @property
    def value(self) -> Any: ...
    @property
    def reason(self) -> str | None: ...
    def __new__(
        cls,
        text: str,
        value: Any,
        reason: str | None,
    ) -> Argument: ...

@final
class MotionSettings(_Record):
    @property
    def conf_l(self) -> bool: ...
    @property
    def conf_j(self) -> bool: ...
    @property
    def sing_area(self) -> Literal["Off", "Wrist", "LockAxis4"]: ...
    @property
    def cir_path_mode(
        self,
    ) -> Literal["PathFrame", "ObjectFrame", "CirPointOri", "Wrist45", "Wrist46", "Wrist56"]: ...
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
    @property
    def kind(self) -> Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ", "MoveExtJ"]: ...
    @property
    def routine(self) -> str | None: ...
    @property
    def target(self) -> Argument: ...
    @property
    def via(self) -> Argument | None: ...
    @property
    def speed(self) -> str: ...
    @property
    def zone(self) -> str: ...
    @property
    def tool(self) -> Argument: ...
    @property
    def wobj(self) -> Argument | None: ...
    @property
    def options(self) -> tuple[tuple[str, str | None], ...]: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def displaced(self) -> int | None: ...
    @property
    def speed_data(self) -> Argument: ...
    @property
    def zone_data(self) -> Argument: ...
    @property
    def time(self) -> Argument | None: ...
    @property
    def settings(self) -> MotionSettings: ...
    @property
    def instruction(self) -> str: ...
    @property
    def extra(self) -> tuple[tuple[int, str], ...]: ...
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
    @property
    def kind(self) -> Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ"]: ...
    @property
    def module(self) -> int: ...
    @property
    def module_index(self) -> int: ...
    @property
    def line(self) -> int: ...
    @property
    def start(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def length(self) -> float: ...
    @property
    def q(self) -> _Floats | None: ...
    @property
    def as_programmed(self) -> bool: ...
    @property
    def tool(self) -> _Floats: ...
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
    @property
    def code(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def severity(self) -> Literal["error", "warning", "note"]: ...
    @property
    def module(self) -> int: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def routine(self) -> str | None: ...
    @property
    def move_index(self) -> int: ...
    @property
    def message(self) -> str: ...
    @property
    def joint(self) -> int | None: ...
    @property
    def value(self) -> float | None: ...
    @property
    def bound(self) -> float | None: ...
    @property
    def edits(self) -> tuple[tuple[int, int, int, str], ...]: ...
    @property
    def related(self) -> tuple[tuple[int, int, int], ...]: ...
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
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def routine(self) -> str | None: ...
    @property
    def what(self) -> str: ...
    @property
    def text(self) -> str: ...
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
    @property
    def module(self) -> int: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def routine(self) -> str | None: ...
    @property
    def target(self) -> str: ...
    @property
    def q(self) -> _Floats | None: ...
    @property
    def confdata(self) -> Configuration | None: ...
    @property
    def unchecked(self) -> str | None: ...
    @property
    def assumed(self) -> bool: ...
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
        assumed: bool,
    ) -> CheckedMove: ...

@final
class Checked(_Record):
    @property
    def findings(self) -> tuple[Finding, ...]: ...
    @property
    def moves(self) -> tuple[CheckedMove, ...]: ...
    def __new__(
        cls,
        findings: tuple[Finding, ...],
        moves: tuple[CheckedMove, ...],
    ) -> Checked: ...

@final
class TextFault(_Record):
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def message(self) -> str: ...
    def __new__(cls, line: int, column: int, message: str) -> TextFault: ...

@final
class TargetTable(_Record):
    @property
    def kinds(self) -> tuple[str, ...]: ...
    @property
    def names(self) -> tuple[str, ...]: ...
    @property
    def lines(self) -> npt.NDArray[np.int64]: ...
    @property
    def q(self) -> _Floats: ...
    @property
    def configuration(self) -> ConfigurationBatch: ...
    @property
    def wrist(self) -> _Floats: ...
    @property
    def elbow(self) -> _Floats: ...
    @property
    def shoulder(self) -> _Floats: ...
    @property
    def findings(self) -> tuple[Finding | None, ...]: ...
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
    def to_dict(self) -> dict[str, Any]: ...
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None: ...

# What a name stands for is the text's: records of any type, narrowed with isinstance.
@final
class Module(Mapping[str, Any]):
    @property
    def name(self) -> str | None: ...
    @property
    def attributes(self) -> tuple[str, ...]: ...
    @property
    def source(self) -> str: ...
    @property
    def data(self) -> Mapping[str, Any]: ...
    @property
    def declarations(self) -> tuple[Declaration, ...]: ...
    @property
    def routines(self) -> tuple[Routine, ...]: ...
    @property
    def moves(self) -> tuple[Move, ...]: ...
    @property
    def skipped(self) -> tuple[Skipped, ...]: ...
    @property
    def faults(self) -> tuple[TextFault, ...]: ...
    def rewritten(self, values: Mapping[str, Any]) -> str: ...
    def keys(self) -> KeysView[str]: ...
    def values(self) -> ValuesView[Any]: ...
    def items(self) -> ItemsView[str, Any]: ...
    def get(self, name: str, default: Any = None, /) -> Any: ...
    def __getitem__(self, name: str, /) -> Any: ...
    def __contains__(self, name: object, /) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def __reversed__(self) -> Iterator[str]: ...
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __reduce__(self) -> tuple[Callable[..., Module], tuple[str, tuple[Module, ...]]]: ...

# Text determines the type: a module, or any record.
def parse(text: str | bytes, context: Iterable[Module] | None = None) -> Any: ...
def parse_module(text: str | bytes, context: Iterable[Module] | None = None) -> Module: ...
def read_modules(contents: Iterable[str | bytes]) -> list[Module]: ...
def read_module(content: str | bytes, context: Iterable[Module] | None = None) -> Module: ...
def differing_names(before: Module, after: Module) -> set[str]: ...
def dump(value: Any, name: str = "Data") -> str: ...
def calc_joint_t(
    robot: Robot,
    target: RobTarget,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
    *,
    fallback: Literal["nearest"] | None = None,
    seed: npt.ArrayLike | None = None,
) -> JointTarget: ...
def calc_rob_t(
    robot: Robot,
    joints: JointTarget | npt.ArrayLike,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
) -> RobTarget: ...
def calc_moves(
    robot: Robot,
    module: Module,
    *,
    fallback: Literal["nearest"] | None = None,
    seed: npt.ArrayLike | None = None,
) -> TargetTable: ...
def calc_targets(
    robot: Robot,
    module: Module,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
    *,
    fallback: Literal["nearest"] | None = None,
    seed: npt.ArrayLike | None = None,
) -> TargetTable: ...
def check(
    robot: Robot,
    module: Module,
    *,
    codes: Collection[str] | None = None,
    max_velocity: npt.ArrayLike | None = None,
    step: float = 0.005,
    turn: float | None = None,
    cell: Cell | None = None,
) -> tuple[Finding, ...]: ...
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
    tools: Mapping[str | None, ToolData | npt.ArrayLike] | None = None,
    whole: bool | None = None,
    of_system: Sequence[int] | None = None,
    signals: Sequence[str] | None = None,
    carried: Mapping[str, Shape | Sequence[Shape]] | None = None,
    tasks: Sequence[tuple[str, Sequence[Module]]] | None = None,
) -> Checked: ...
def port_program(
    robot: Robot,
    modules: Sequence[Module],
    tagged: Sequence[Module],
    *,
    source: Robot | None = None,
    units: Sequence[tuple[str, bool, bool, Sequence[tuple[int, npt.ArrayLike, bool]]]]
    | None = None,
    last_values: bool = False,
    tools: Mapping[str | None, ToolData | npt.ArrayLike] | None = None,
) -> list[tuple[int, Configuration]]: ...
def check_codes() -> list[tuple[str, str, str, bool]]: ...
def instructions() -> list[tuple[str, str, str]]: ...
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
) -> RoutineMotion: ...

@final
class RoutineMotion:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def routine(self) -> str | None: ...
    @property
    def duration(self) -> float: ...
    @property
    def trajectory(self) -> Trajectory: ...
    @property
    def t(self) -> _Floats: ...
    @property
    def q(self) -> _Floats: ...
    @property
    def move_index(self) -> npt.NDArray[np.int64]: ...
    @property
    def lines(self) -> npt.NDArray[np.int64]: ...
    @property
    def moves(self) -> tuple[MotionMove, ...]: ...
    @property
    def findings(self) -> tuple[Finding, ...]: ...
    def to_module(self, name: str = "Motion") -> Module: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(
        self,
    ) -> tuple[Callable[..., RoutineMotion], tuple[Robot, Module, str | None]]: ...

@final
class Shape:
    @staticmethod
    def box(size: npt.ArrayLike, pose: npt.ArrayLike | None = None) -> Shape: ...
    @staticmethod
    def sphere(radius: float, center: npt.ArrayLike) -> Shape: ...
    @staticmethod
    def capsule(a: npt.ArrayLike, b: npt.ArrayLike, radius: float) -> Shape: ...
    @staticmethod
    def cylinder(radius: float, length: float, pose: npt.ArrayLike | None = None) -> Shape: ...
    @staticmethod
    def convex(
        points: npt.ArrayLike | str | PathLike[str],
        pose: npt.ArrayLike | None = None,
        *,
        scale: float = 1.0,
    ) -> Shape: ...
    @staticmethod
    def mesh(
        triangles: npt.ArrayLike | str | PathLike[str],
        pose: npt.ArrayLike | None = None,
        *,
        scale: float = 1.0,
        solid: bool = True,
    ) -> Shape: ...
    @staticmethod
    def points(
        points: npt.ArrayLike, radius: float, pose: npt.ArrayLike | None = None
    ) -> Shape: ...
    @staticmethod
    def union(shapes: Sequence[Shape]) -> Shape: ...
    def data(self) -> dict[str, Any]: ...
    def moved(self, T: npt.ArrayLike) -> Shape: ...
    @staticmethod
    def half_space(normal: npt.ArrayLike, point: npt.ArrayLike) -> Shape: ...
    def __reduce__(self) -> tuple[Callable[[str, bytes], Any], tuple[str, bytes]]: ...

@final
class Body:
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
    ) -> Body: ...
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
    ) -> Body: ...
    @property
    def links(self) -> npt.NDArray[np.int64]: ...
    @property
    def capsules(self) -> _Floats: ...
    @property
    def hulls(self) -> list[tuple[int, _Floats, list[list[int]], float]]: ...
    @property
    def pairs(self) -> list[tuple[int, int]]: ...
    @property
    def is_approximate(self) -> bool: ...
    @property
    def source(self) -> str: ...
    @property
    def excess(self) -> _Floats: ...
    def __reduce__(self) -> tuple[Callable[[str, bytes], Any], tuple[str, bytes]]: ...

@final
class Cell:
    def __new__(
        cls,
        obstacles: Mapping[str, Shape] | None = None,
        margin: float = 0.0,
        may_touch: Sequence[tuple[str, int]] | None = None,
    ) -> Cell: ...
    @staticmethod
    def load(
        path: Any, *, joints: Mapping[str, float] | None = None, solid: bool = True
    ) -> Cell: ...
    def with_robot(self, name: str, robot: Robot, q: npt.ArrayLike | Solution) -> Cell: ...
    @property
    def may_touch(self) -> list[tuple[str, int]]: ...
    @property
    def obstacles(self) -> dict[str, Shape]: ...
    @property
    def margin(self) -> float: ...
    def collides(
        self,
        robot: Robot,
        q: npt.ArrayLike | Solution,
        out: npt.NDArray[np.bool_] | None = None,
        *,
        threads: int = 1,
    ) -> npt.NDArray[np.bool_]: ...
    def distance(self, robot: Robot, q: npt.ArrayLike | Solution) -> CellDistance: ...
    def check_path(
        self, robot: Robot, motion: npt.ArrayLike | Trajectory
    ) -> CellContact | None: ...
    def __reduce__(self) -> tuple[Callable[[str, bytes], Any], tuple[str, bytes]]: ...

@final
class PageEngine:
    def __new__(cls) -> PageEngine: ...
    def answer(self, request: str) -> str: ...

@final
class Trajectory:
    @property
    def _joint_names(self) -> list[str] | None:
        """Names of the joints, of a robot with a file."""
    @property
    def t(self) -> _Floats: ...
    @property
    def q(self) -> _Floats: ...
    @property
    def dq(self) -> _Floats: ...
    @property
    def ddq(self) -> _Floats: ...
    @property
    def dof(self) -> int: ...
    @property
    def duration(self) -> float: ...
    @property
    def knots(self) -> _Floats: ...
    def sample(self, t: npt.ArrayLike) -> TrajectorySample: ...
    def peaks(self) -> MotionPeaks: ...
    def range(self) -> _Floats: ...
    def check_limits(self, limits: npt.ArrayLike) -> None: ...
    def __call__(self, t: npt.ArrayLike) -> _Floats: ...
    def to_dict(self) -> dict[str, npt.NDArray[Any]]: ...
    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None: ...
    def to_joint_trajectory(self, joint_names: Sequence[str] | None = None) -> dict[str, Any]: ...
    def resampled(self, steps: int | None = None, *, dt: float | None = None) -> Trajectory: ...
    def stretched(self, factor: float) -> Trajectory: ...
    def slice(self, start: float, end: float) -> Trajectory: ...
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
) -> Trajectory: ...
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
) -> Trajectory: ...
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
) -> Trajectory: ...
def at_tool_speed(
    q: npt.ArrayLike,
    T: npt.ArrayLike,
    speed: float,
    max_velocity: npt.ArrayLike | None,
    max_acceleration: npt.ArrayLike | None = None,
    *,
    limits: npt.ArrayLike | None = None,
    steps: int | None = None,
) -> Trajectory: ...
def tool_speed_limits(
    q: npt.ArrayLike,
    T: npt.ArrayLike,
    max_velocity: npt.ArrayLike | None,
    max_acceleration: npt.ArrayLike | None = None,
) -> ToolSpeedLimits: ...
def path_spline(
    T: npt.ArrayLike,
    *,
    steps: int | None = None,
    step: float | None = None,
    turn: float | None = None,
    speed: float | None = None,
    dt: float | None = None,
) -> _Floats: ...
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
) -> _Floats: ...
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
) -> _Floats: ...
def polyline(
    T: npt.ArrayLike,
    zones: float | str | Sequence[float | str] | _Floats,
    *,
    steps: int | None = None,
    step: float | None = None,
    turn: float | None = None,
    speed: float | None = None,
    dt: float | None = None,
) -> _Floats: ...
def encode(message: EgmRobot | EgmSensor) -> bytes: ...
def decode(data: bytes, kind: type[_Message]) -> _Message: ...
