"""RAPID's records: millimeters and degrees, as their field names say; quaternions are w, x, y,
z.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from irbkin._core import pose, to_xyz_wxyz
from irbkin.errors import RapidError
from irbkin.records import Configuration

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = [
    "JointTarget",
    "LoadData",
    "Pose",
    "RobTarget",
    "SpeedData",
    "ToolData",
    "WobjData",
    "ZoneData",
]

Vector = tuple[float, ...]
NOT_THERE = 9e9
"""RAPID's value of an external axis that is not there."""
ZEROS = Configuration(0, 0, 0, 0)
MOST_WHOLE = 2**31 - 1


def _set_numbers(record: object, field: str, count: int) -> None:
    """Makes a field a tuple of floats; anything iterable is taken."""
    value: Any = getattr(record, field)
    numbers: Vector = ()
    # Texts and sets can be gone through, too.
    if not isinstance(value, (str, bytes, bytearray, set, frozenset, dict)):
        with contextlib.suppress(TypeError, ValueError, OverflowError):
            numbers = tuple(map(float, value))
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise RapidError(
            f"{type(record).__name__}: {field} must be {count} finite numbers, got {value!r}"
        )
    object.__setattr__(record, field, numbers)


def _set_number(record: object, field: str) -> None:
    """Makes a field a finite float."""
    value: Any = getattr(record, field)
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise RapidError(f"{type(record).__name__}: {field} must be a finite number, got {value!r}")
    object.__setattr__(record, field, number)


def _demand(record: object, field: str, of: type, words: str) -> None:
    """Refuses a field of another type."""
    value = getattr(record, field)
    if type(value) is not of:
        raise RapidError(f"{type(record).__name__}: {field} must be {words}, got {value!r}")


def _set_pose(record: object, field: str) -> None:
    """Makes a field a Pose; the position and quaternion of one are taken, as RAPID writes them."""
    value = getattr(record, field)
    if isinstance(value, (tuple, list)) and len(value) == 2:
        object.__setattr__(record, field, Pose(*value))
    _demand(record, field, Pose, "a Pose (Pose.of(T) makes one of a matrix)")


def _set_truth(record: object, field: str) -> None:
    """Makes a field True or False; NumPy's are taken, too."""
    value = getattr(record, field)
    truth = getattr(value, "item", lambda: value)()
    if not isinstance(truth, bool):
        raise RapidError(f"{type(record).__name__}: {field} must be True or False, got {value!r}")
    object.__setattr__(record, field, truth)


def _matrix(trans_mm: Vector, rot: Vector) -> npt.NDArray[np.float64]:
    return pose([mm / 1e3 for mm in trans_mm], wxyz=rot)


def _of_matrix(T: npt.ArrayLike) -> tuple[Vector, Vector]:
    xyz, wxyz = to_xyz_wxyz(T)
    return tuple((xyz * 1e3).tolist()), tuple(wxyz.tolist())


@dataclass(frozen=True, slots=True)
class Pose:
    """`pose`: a frame."""

    trans_mm: Vector = (0.0, 0.0, 0.0)
    """Position [mm]."""
    rot: Vector = (1.0, 0.0, 0.0, 0.0)
    """Quaternion w, x, y, z."""

    def __post_init__(self) -> None:
        _set_numbers(self, "trans_mm", 3)
        _set_numbers(self, "rot", 4)

    @classmethod
    def of(cls, T: npt.ArrayLike) -> Pose:
        """The frame of a homogeneous matrix, shape (4, 4), translation [m]."""
        return cls(*_of_matrix(T))

    def matrix(self) -> npt.NDArray[np.float64]:
        """Homogeneous matrix, shape (4, 4), translation [m]."""
        return _matrix(self.trans_mm, self.rot)


@dataclass(frozen=True, slots=True)
class RobTarget:
    """`robtarget`: a pose of the tool in the work object, which solution, and external axes."""

    trans_mm: Vector
    """Position [mm]."""
    rot: Vector = (1.0, 0.0, 0.0, 0.0)
    """Quaternion w, x, y, z."""
    robconf: Configuration = ZEROS
    """Quarter turns of axes 1, 4 and 6, and the slot."""
    extax: Vector = (NOT_THERE,) * 6
    """External axes [deg or mm]; 9e9 is one that is not there."""

    def __post_init__(self) -> None:
        _set_numbers(self, "trans_mm", 3)
        _set_numbers(self, "rot", 4)
        _set_configuration(self)
        _set_numbers(self, "extax", 6)

    @classmethod
    def of(
        cls, T: npt.ArrayLike, robconf: Iterable[int], extax: Iterable[float] = (NOT_THERE,) * 6
    ) -> RobTarget:
        """The target of a homogeneous matrix, shape (4, 4), translation [m]."""
        return cls(*_of_matrix(T), robconf, extax)  # type: ignore[arg-type]

    def matrix(self) -> npt.NDArray[np.float64]:
        """Homogeneous matrix of the tool in the work object, shape (4, 4), translation [m]."""
        return _matrix(self.trans_mm, self.rot)


@dataclass(frozen=True, slots=True)
class JointTarget:
    """`jointtarget`: angles of the robot's axes, and external axes."""

    robax_deg: Vector
    """The controller's angles [deg]."""
    extax: Vector = (NOT_THERE,) * 6
    """External axes [deg or mm]; 9e9 is one that is not there."""

    def __post_init__(self) -> None:
        _set_numbers(self, "robax_deg", 6)
        _set_numbers(self, "extax", 6)

    @classmethod
    def of(cls, q: Iterable[float], extax: Iterable[float] = (NOT_THERE,) * 6) -> JointTarget:
        """The target of joint angles [rad], shape (6,)."""
        radians = cls(q, extax)  # type: ignore[arg-type]
        return cls(tuple(map(math.degrees, radians.robax_deg)), radians.extax)

    @property
    def q(self) -> npt.NDArray[np.float64]:
        """Joint angles [rad], shape (6,)."""
        import numpy as np

        return np.deg2rad(self.robax_deg)


@dataclass(frozen=True, slots=True)
class LoadData:
    """`loaddata`: mass and inertia of a load; kinematics does not use them."""

    mass_kg: float = 0.001
    """Mass [kg]."""
    cog_mm: Vector = (0.0, 0.0, 0.001)
    """Center of gravity [mm]."""
    aom: Vector = (1.0, 0.0, 0.0, 0.0)
    """Axes of moment, a quaternion w, x, y, z."""
    inertia: Vector = (0.0, 0.0, 0.0)
    """Moments of inertia ix, iy, iz [kg m^2]."""

    def __post_init__(self) -> None:
        _set_numbers(self, "cog_mm", 3)
        _set_numbers(self, "aom", 4)
        _set_numbers(self, "inertia", 3)
        _set_number(self, "mass_kg")


@dataclass(frozen=True, slots=True)
class ToolData:
    """`tooldata`: a tool. The default is tool0."""

    robhold: bool = True
    """Whether the robot holds it; a tool that it does not hold is stationary."""
    tframe: Pose = Pose()
    """The tool's frame in that of the flange; in the world where it is stationary."""
    tload: LoadData = LoadData()
    """Its load."""

    def __post_init__(self) -> None:
        _set_truth(self, "robhold")
        _set_pose(self, "tframe")
        _demand(self, "tload", LoadData, "a LoadData")


@dataclass(frozen=True, slots=True)
class WobjData:
    """`wobjdata`: a work object, `uframe @ oframe`. The default is wobj0."""

    robhold: bool = False
    """Whether the robot holds it, under a stationary tool."""
    ufprog: bool = True
    """Whether the user frame is fixed; where not, `ufmec` moves it."""
    ufmec: str = ""
    """The mechanical unit that moves the user frame."""
    uframe: Pose = Pose()
    """User frame in the world; in the frame of the flange where the robot holds the work object."""
    oframe: Pose = Pose()
    """Object frame in the user frame."""

    def __post_init__(self) -> None:
        _set_truth(self, "robhold")
        _set_truth(self, "ufprog")
        _demand(self, "ufmec", str, "a str")
        _set_pose(self, "uframe")
        _set_pose(self, "oframe")


@dataclass(frozen=True, slots=True)
class SpeedData:
    """`speeddata`: how fast a move is."""

    v_tcp_mm_s: float
    """Speed of the tool center point [mm/s]."""
    v_ori_deg_s: float = 500.0
    """Speed of its reorientation [deg/s]."""
    v_leax_mm_s: float = 5000.0
    """Speed of linear external axes [mm/s]."""
    v_reax_deg_s: float = 1000.0
    """Speed of rotating external axes [deg/s]."""

    def __post_init__(self) -> None:
        for field in ("v_tcp_mm_s", "v_ori_deg_s", "v_leax_mm_s", "v_reax_deg_s"):
            _set_number(self, field)


@dataclass(frozen=True, slots=True)
class ZoneData:
    """`zonedata`: how a move ends. The default is fine."""

    finep: bool = True
    """Whether the robot stops at the target."""
    pzone_tcp_mm: float = 0.0
    """Radius around the target in which the tool center point leaves the line [mm]."""
    pzone_ori_mm: float = 0.0
    """Radius in which the reorientation leaves its way [mm]."""
    pzone_eax_mm: float = 0.0
    """Radius for external axes [mm]."""
    zone_ori_deg: float = 0.0
    """Reorientation that is left where it leaves its way [deg]."""
    zone_leax_mm: float = 0.0
    """The same for linear external axes [mm]."""
    zone_reax_deg: float = 0.0
    """The same for rotating external axes [deg]."""

    def __post_init__(self) -> None:
        _set_truth(self, "finep")
        for field in ("pzone_tcp_mm", "pzone_ori_mm", "pzone_eax_mm"):
            _set_number(self, field)
        for field in ("zone_ori_deg", "zone_leax_mm", "zone_reax_deg"):
            _set_number(self, field)


def _set_configuration(target: RobTarget) -> None:
    """Makes a target's `robconf` a Configuration of integers."""
    try:
        numbers = tuple(target.robconf)
        whole = tuple(int(number) for number in numbers)
    except (TypeError, ValueError, OverflowError):
        numbers, whole = (), ()
    if len(whole) != 4 or whole != numbers or any(abs(number) > MOST_WHOLE for number in whole):
        raise RapidError(
            f"RobTarget: robconf must be 4 whole numbers of at most {MOST_WHOLE}, "
            f"got {target.robconf!r}"
        )
    object.__setattr__(target, "robconf", Configuration(*whole))


Record = (
    RobTarget
    | JointTarget
    | ToolData
    | WobjData
    | Pose
    | LoadData
    | SpeedData
    | ZoneData
    | Configuration
    | Vector
    | float
)
"""The value of a RAPID datum: a record, a tuple of 3 (pos), 4 (orient) or 6 (extjoint) numbers, or
a number.
"""
