"""RAPID's records: millimetres and degrees, as their field names say; quaternions are w, x, y, z."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from irbkin._core import pose, to_xyz_quaternion
from irbkin.errors import RapidError
from irbkin.records import Configuration

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = ["JointTarget", "LoadData", "Pose", "RobTarget", "ToolData", "WobjData"]

Vector = tuple[float, ...]
NOT_THERE = 9e9
"""RAPID's value of an external axis that is not there."""
ZEROS = Configuration(0, 0, 0, 0)


def _set_numbers(record: object, field: str, count: int) -> None:
    """Makes a field a tuple of floats; anything iterable is taken."""
    value: Any = getattr(record, field)
    try:
        numbers = tuple(map(float, value))
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise RapidError(f"{type(record).__name__}: {field} must be {count} finite numbers, got {value!r}")
    object.__setattr__(record, field, numbers)


def _matrix(trans_mm: Vector, rot: Vector) -> npt.NDArray[np.float64]:
    return pose([mm / 1e3 for mm in trans_mm], quaternion=rot)


def _of_matrix(T: npt.ArrayLike) -> tuple[Vector, Vector]:
    xyz, wxyz = to_xyz_quaternion(T)
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
    def of(cls, T: npt.ArrayLike, robconf: Iterable[int], extax: Iterable[float] = (NOT_THERE,) * 6) -> RobTarget:
        """The target of a homogeneous matrix, shape (4, 4), translation [m]."""
        trans_mm, rot = _of_matrix(T)
        return cls(trans_mm, rot, Configuration(*robconf), tuple(extax))

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
        return cls(tuple(map(math.degrees, q)), tuple(extax))

    @property
    def q(self) -> npt.NDArray[np.float64]:
        """Joint angles [rad], shape (6,)."""
        import numpy as np

        return np.deg2rad(self.robax_deg)


@dataclass(frozen=True, slots=True)
class LoadData:
    """`loaddata`: mass and inertia of a load, of which kinematics takes no notice."""

    mass_kg: float = 0.001
    """Mass [kg]."""
    cog_mm: Vector = (0.0, 0.0, 0.001)
    """Centre of gravity [mm]."""
    aom: Vector = (1.0, 0.0, 0.0, 0.0)
    """Axes of moment, a quaternion w, x, y, z."""
    inertia: Vector = (0.0, 0.0, 0.0)
    """Moments of inertia ix, iy, iz [kg m^2]."""

    def __post_init__(self) -> None:
        _set_numbers(self, "cog_mm", 3)
        _set_numbers(self, "aom", 4)
        _set_numbers(self, "inertia", 3)
        object.__setattr__(self, "mass_kg", float(self.mass_kg))


@dataclass(frozen=True, slots=True)
class ToolData:
    """`tooldata`: a tool. The default is tool0."""

    robhold: bool = True
    """Whether the robot holds it; a tool that it does not hold is stationary."""
    tframe: Pose = Pose()
    """The tool's frame in that of the flange; in the world where it is stationary."""
    tload: LoadData = LoadData()
    """Its load."""


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


def _set_configuration(target: RobTarget) -> None:
    """Makes a target's `robconf` a Configuration of integers."""
    try:
        numbers = tuple(target.robconf)
        whole = tuple(int(number) for number in numbers)
    except (TypeError, ValueError, OverflowError):
        numbers, whole = (), ()
    if len(whole) != 4 or whole != numbers:
        raise RapidError(f"RobTarget: robconf must be 4 whole numbers, got {target.robconf!r}")
    object.__setattr__(target, "robconf", Configuration(*whole))
