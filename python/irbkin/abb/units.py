"""Mechanical units of a controller: robots, tracks, positioners, gantries, servo axes.

Lengths are in meters, angles in radians, poses 4x4 matrices in the world.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from irbkin import Robot
from irbkin._arrays import Floats, rotations
from irbkin._core import NOT_THERE
from irbkin.errors import InvalidModelError

Pose = Floats
UnitKind = Literal["track", "positioner", "gantry", "servo"]
AXES = "abcdef"
"""External axes of a target, eax_a to eax_f: logical axes 7 to 12."""


@dataclass(frozen=True)
class LimitDifference:
    """A joint whose limits in the configuration are not the ones of the catalog."""

    joint: str
    """"J1" to "J7" as ABB counts the axes, or "linkage" (q3 - q2)."""
    lower: float
    """Lower limit in force [rad]."""
    upper: float
    """Upper limit in force [rad]."""
    catalog_lower: float
    """Lower limit of the catalog [rad]; NaN where it has none."""
    catalog_upper: float
    """Upper limit of the catalog [rad]; NaN where it has none."""


@dataclass(frozen=True, eq=False)
class RobotUnit:
    """A robot of a controller."""

    name: str
    """Name of the unit: "ROB_1"."""
    type: str
    """Type string of the configuration, "ROB1_4600_2.55_40", or the wording of backinfo.txt."""
    arm: str | None
    """Name in the catalog, or None where the type is not in it."""
    robot: Robot | None
    """The robot with the limits in force, limits of the linkage and its base; None without an arm.
    A robot that is carried is where it is with the external axes at zero: `Backup.robot_at` moves
    it.
    """
    base: Pose | None = None
    """Base frame in the world [m], with the axes of what carries the robot at zero; None where it
    is not determined.
    """
    carried_by: str | None = None
    """Name of the unit that carries the robot."""
    limits_differ: tuple[LimitDifference, ...] = ()
    """Joints whose limits are not the catalog's by more than 0.06 deg."""
    is_calibrated: bool = False
    """Whether the kinematics were measured (Absolute Accuracy). The robot has the nominal ones."""
    has_offsets: bool = False
    """Whether its motors have calibration offsets: a sign that the backup is of a real machine."""
    joints: tuple[str, ...] = ()
    """Names of its joints in the configuration, axis 1 first."""
    line: int = 0
    """Line of MOC.cfg; 0 where it has none."""
    mechanical_unit: str = ""
    """Name of the MECHANICAL_UNIT that uses this unit alone, or empty."""


@dataclass(frozen=True)
class ExternalAxis:
    """An axis of a unit that is no robot."""

    joint: str
    """Name of the joint in the configuration."""
    eax: str | None
    """The external axis of a target that moves it, "a" to "f"; None where it is not determined."""
    lower: float
    """Lower limit [rad], of a linear axis [m]; NaN where it is not given."""
    upper: float
    """Upper limit [rad], of a linear axis [m]; NaN where it is not given."""


@dataclass(frozen=True, eq=False)
class ExternalUnit:
    """A track, positioner, gantry or servo axis."""

    name: str
    """Name of the unit: "TRACK_1"."""
    type: str
    """Type string of the configuration: "IRBT4004_1"."""
    kind: UnitKind
    """Its kind. A track moves along x of its base frame, a positioner turns about z of it; how a
    gantry moves is not determined, and how a servo axis does neither.
    """
    base: Pose | None
    """Base frame in the world [m], with the axes of what carries it at zero; None where it is not
    determined.
    """
    carried_by: str | None
    """Name of the unit that carries it."""
    carries: tuple[str, ...]
    """Names of the units that it carries."""
    axes: tuple[ExternalAxis, ...]
    line: int
    """Line of MOC.cfg."""
    mechanical_unit: str = ""
    """Name of the MECHANICAL_UNIT that uses this unit alone, or empty."""

    @property
    def is_determined(self) -> bool:
        """Whether the pose of what it moves follows from the external axes of a target."""
        return self.base is not None and self.missing is None

    @property
    def missing(self) -> str | None:
        """The part of its motion that the configuration leaves open, or None."""
        if self.kind not in ("track", "positioner"):
            return f"how a {self.kind} moves is not determined by the configuration"
        if len(self.axes) != 1:
            return f"it has {len(self.axes)} axes: how they are arranged is not in MOC.cfg"
        if self.axes[0].eax is None:
            return "which external axis moves it (logical_axis) is not in MOC.cfg"
        return None

    def moved(self, external_mm_deg: Sequence[float]) -> Pose:
        """Return the pose of what it moves, relative to its base frame.

        Args:
            external_mm_deg: The six external axes of a target [mm, deg]; 9E9 where it gives none.

        Raises:
            InvalidModelError: The motion is not determined, or the target lacks the axis.
        """
        if self.missing is not None:
            raise InvalidModelError(f"{self.name}: {self.missing}")
        eax = self.axes[0].eax
        assert eax is not None
        place = AXES.index(eax)
        value = external_mm_deg[place] if place < len(external_mm_deg) else NOT_THERE
        if not abs(value) < NOT_THERE:
            raise InvalidModelError(f"{self.name}: the target gives no eax_{eax}, which moves it")
        is_track = self.kind == "track"
        (pose,) = rotations(2, np.radians([0.0 if is_track else value]))
        pose[0, 3] = value / 1e3 if is_track else 0.0
        return np.asarray(pose)
