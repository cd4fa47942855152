"""Kinematics of ABB IRB, Universal Robots and Franka arms.

All inverse-kinematics solutions, in stable slots, with limits and singularities reported. Meters,
radians, float64; poses are 4x4 homogeneous matrices.

    >>> import irbkin
    >>> robot = irbkin.Robot("IRB 2600-12/1.65")
    >>> solutions = robot.ik(robot.fk([0.3, -0.2, 0.4, 0.5, -0.6, 0.7]))
    >>> len(solutions)
    8
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from irbkin._core import (
    Cell,
    Robot,
    Solution,
    Solutions,
    __version__,
    catalog,
    catalog_entry,
    pose,
    to_xyz_euler_zyx,
    to_xyz_wxyz,
)
    Follower,
from irbkin.errors import (
    CalibrationError,
    InvalidJointsError,
    InvalidModelError,
    InvalidMotionError,
    InvalidPoseError,
    IrbkinError,
    PathError,
    RapidError,
    UnknownRobotError,
    UnreachableError,
)
from irbkin.freedom import Positioner, ToolCone, ToolOffset, ToolRotation, Track
from irbkin.records import (
    CatalogEntry,
    Configuration,
    FollowResult,
    IkBatch,
    Plan,
    Reach,
    SingularityKind,
    SingularityMode,
    Status,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from irbkin import abb as abb
    from irbkin import body as body
    from irbkin import calibration as calibration
    from irbkin import map as map
    from irbkin import paths as paths
    from irbkin import placement as placement
    from irbkin import plot as plot
    from irbkin import rapid as rapid
    from irbkin import ros as ros
    from irbkin import scene as scene
    from irbkin import trajectory as trajectory
    from irbkin.calibration import calibrate as calibrate

__all__ = [
    "CalibrationError",
    "CatalogEntry",
    "Cell",
    "Configuration",
    "FollowResult",
    "IkBatch",
    "InvalidJointsError",
    "InvalidModelError",
    "InvalidMotionError",
    "InvalidPoseError",
    "IrbkinError",
    "PathError",
    "Plan",
    "Positioner",
    "RapidError",
    "Follower",
    "Reach",
    "Robot",
    "SingularityKind",
    "SingularityMode",
    "Solution",
    "Solutions",
    "Status",
    "ToolCone",
    "ToolOffset",
    "ToolRotation",
    "Track",
    "UnknownRobotError",
    "UnreachableError",
    "__version__",
    "calibrate",
    "calibration",
    "catalog",
    "catalog_entry",
    "paths",
    "placement",
    "pose",
    "rapid",
    "ros",
    "to_xyz_euler_zyx",
    "to_xyz_wxyz",
    "trajectory",
]

# `plot` needs an extra: it is not in `__all__`, which a star import takes in whole. Nor are `abb`
# and `body`, which few users need, and `map`, which would then replace Python's own.
_MODULES = (
    "abb",
    "body",
    "calibration",
    "map",
    "paths",
    "placement",
    "plot",
    "rapid",
    "ros",
    "scene",
    "trajectory",
)


def __getattr__(name: str) -> ModuleType | Callable[..., Any]:
    """Import `irbkin.rapid` and the like when they are first asked for."""
    if name == "calibrate":
        from irbkin.calibration import calibrate

        return calibrate
    if name in _MODULES:
        import importlib

        return importlib.import_module(f"irbkin.{name}")
    raise AttributeError(f"module 'irbkin' has no attribute {name!r}")


def __dir__() -> list[str]:
    """List what the package offers, its modules before their import, too."""
    return sorted({*__all__, "errors", "records", *(n for n in globals() if n.startswith("__"))})
