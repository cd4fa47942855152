from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, ClassVar, Literal, Protocol, final, overload, type_check_only

import numpy as np
import numpy.typing as npt

from irbkin.rapid.program import Declaration, Move, Skipped, TargetTable
from irbkin.rapid.records import JointTarget, RobTarget, ToolData, WobjData
from irbkin.records import (
    Configuration,
    FollowResult,
    FreeJoint,
    IkBatch,
    PoseCheck,
    Reach,
    Singularity,
    SingularityKind,
    Status,
)

_Floats = npt.NDArray[np.float64]
_State = tuple[
    str,
    str,
    list[float],
    list[float],
    list[float],
    list[float],
    list[float] | None,
    list[float] | None,
]

@type_check_only
class _Rotation(Protocol):
    """A rotation of another package, such as SciPy's."""

    def as_matrix(self) -> npt.NDArray[Any]: ...

__all__ = [
    "Module",
    "Robot",
    "Solution",
    "Solutions",
    "__version__",
    "_restore_robot",
    "calc_joint_t",
    "calc_moves",
    "calc_rob_t",
    "calc_targets",
    "catalog",
    "decode",
    "dump",
    "instruction_set",
    "instruction_sets",
    "parse",
    "parse_record",
    "pose",
    "to_xyz_euler_zyx",
    "to_xyz_wxyz",
    "use_instruction_set",
]

__version__: str

def catalog(
    *,
    reach: float | tuple[float, float] | None = None,
    payload: float | tuple[float, float] | None = None,
) -> tuple[str, ...]: ...
def instruction_set() -> str: ...
def instruction_sets() -> tuple[str, ...]: ...
def use_instruction_set(name: str) -> None: ...
def pose(
    xyz: npt.ArrayLike,
    wxyz: npt.ArrayLike | None = None,
    xyzw: npt.ArrayLike | None = None,
    euler_zyx: npt.ArrayLike | None = None,
    rotation: npt.ArrayLike | _Rotation | None = None,
) -> _Floats: ...
def to_xyz_wxyz(T: npt.ArrayLike) -> tuple[_Floats, _Floats]: ...
def to_xyz_euler_zyx(T: npt.ArrayLike) -> tuple[_Floats, _Floats]: ...
def _restore_robot(state: _State) -> Robot: ...

@final
class Robot:
    def __new__(cls, name: str) -> Robot: ...
    @staticmethod
    def from_mdh(
        rows: npt.ArrayLike,
        limits: npt.ArrayLike | None = None,
        name: str = "",
        *,
        closed_form: bool = True,
        snap: float = 0.0,
    ) -> Robot: ...
    @staticmethod
    def from_sdh(
        rows: npt.ArrayLike,
        limits: npt.ArrayLike | None = None,
        name: str = "",
        *,
        closed_form: bool = True,
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
        closed_form: bool = True,
        snap: float = 0.0,
    ) -> Robot: ...
    @property
    def name(self) -> str: ...
    @property
    def dof(self) -> int: ...
    @property
    def structure(self) -> str: ...
    @property
    def mdh(self) -> _Floats: ...
    @property
    def root(self) -> _Floats: ...
    @property
    def flange(self) -> _Floats: ...
    @property
    def base(self) -> _Floats: ...
    @property
    def tool(self) -> _Floats: ...
    @property
    def limits(self) -> _Floats: ...
    @property
    def max_velocity(self) -> _Floats | None: ...
    def with_tool(self, T: npt.ArrayLike) -> Robot: ...
    def with_base(self, T: npt.ArrayLike) -> Robot: ...
    def with_limits(self, limits: npt.ArrayLike) -> Robot: ...
    @property
    def is_coupled(self) -> bool: ...
    @property
    def linkage_limits(self) -> _Floats | None: ...
    def with_linkage_limits(self, limits: npt.ArrayLike | None) -> Robot: ...
    def serial(self) -> Robot: ...
    def coupled(self) -> Robot: ...
    def fk(self, q: npt.ArrayLike, out: _Floats | None = None) -> _Floats: ...
    def link_frames(self, q: npt.ArrayLike, out: _Floats | None = None) -> _Floats: ...
    def jacobian(
        self, q: npt.ArrayLike, frame: Literal["base", "tool"] = "base", out: _Floats | None = None
    ) -> _Floats: ...
    def singularity(
        self,
        q: npt.ArrayLike,
        *,
        out: Singularity | tuple[npt.NDArray[Any], ...] | None = None,
        threads: int = 1,
    ) -> Singularity: ...
    def ik(self, T: npt.ArrayLike, q7: float | None = None) -> Solutions: ...
    def ik_batch(
        self,
        T: npt.ArrayLike,
        q7: npt.ArrayLike | None = None,
        *,
        out: tuple[_Floats, npt.NDArray[np.uint8]] | _Floats | None = None,
        threads: int = 1,
    ) -> IkBatch: ...
    def ik_nearest(
        self,
        T: npt.ArrayLike,
        seed: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        *,
        out: _Floats | None = None,
        threads: int = 1,
    ) -> _Floats: ...
    def follow(
        self,
        T: npt.ArrayLike,
        seed: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        *,
        singularity_mode: Literal["through", "error", "wrist", "lock_axis4"] = "through",
        zone: float | None = None,
        out: tuple[_Floats, _Floats] | None = None,
        threads: int = 1,
    ) -> FollowResult: ...
    def configuration(self, q: npt.ArrayLike) -> Configuration: ...
    def ik_configured(
        self,
        T: npt.ArrayLike,
        configuration: Configuration | npt.ArrayLike,
        *,
        fallback: Literal["nearest"] | None = None,
        seed: npt.ArrayLike | None = None,
        out: _Floats | None = None,
        threads: int = 1,
    ) -> _Floats: ...
    def check_pose(self, T: npt.ArrayLike) -> PoseCheck: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Callable[[_State], Robot], tuple[_State]]: ...

@final
class Solution:
    @property
    def q(self) -> _Floats: ...
    @property
    def slot(self) -> int: ...
    @property
    def is_within_limits(self) -> bool: ...
    @property
    def singularities(self) -> SingularityKind: ...
    @property
    def free_joint(self) -> FreeJoint | None: ...
    def with_free_joint(self, value: float) -> Solution: ...
    @property
    def status(self) -> Status: ...
    @property
    def residual(self) -> float: ...
    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int, /) -> float: ...
    @overload
    def __getitem__(self, index: slice | Sequence[int], /) -> _Floats: ...
    def __iter__(self) -> Iterator[float]: ...

@final
class Solutions:
    @property
    def q(self) -> _Floats: ...
    @property
    def q_by_slot(self) -> _Floats: ...
    @property
    def status(self) -> npt.NDArray[np.uint8]: ...
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
    def filter(self, accept: Callable[[Solution], object]) -> Solutions: ...
    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int, /) -> Solution: ...
    def __iter__(self) -> Iterator[Solution]: ...

@final
class Module:
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
    def moves(self) -> tuple[Move, ...]: ...
    @property
    def skipped(self) -> tuple[Skipped, ...]: ...
    def rewritten(self, values: Mapping[str, Any]) -> str: ...
    def __getitem__(self, name: str, /) -> Any: ...
    def __contains__(self, name: str, /) -> bool: ...
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def parse(text: str | bytes, context: Iterable[Module] | None = None) -> Module: ...
def decode(text: str | bytes) -> str: ...
def parse_record(text: str) -> Any: ...
def dump(value: Any, name: str) -> str: ...
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
