"""Kinematics of robot arms. Meters, radians, float64; poses are 4x4 homogeneous matrices.

    >>> import irbkin
    >>> robot = irbkin.Robot("IRB 2600-12/1.65")
    >>> solutions = robot.ik(robot.fk([0.3, -0.2, 0.4, 0.5, -0.6, 0.7]))
    >>> len(solutions)
    8

The names to begin with:

    catalog()                   names of the arms
    Robot(name), .from_urdf()   an arm: .limits, .with_tool(T), .with_base(T), .with_limits(limits)
    robot.fk(q), .jacobian(q)   the pose of the tool and its derivatives
    robot.ik(T), .ik_batch(T)   all solutions, of one pose or of many
    robot.ik_nearest(T, seed)   the solution inside the limits that is nearest to a joint vector
    robot.follow(T, seed)       one joint path along a path of poses; Follower takes pose by pose
    robot.plan(T)               the best joint path along it
    robot.go(start, goal, cell) a motion free of collisions in a Cell
    pose(xyz, wxyz)             a pose of position and orientation
    paths, trajectory           lines and arcs of the tool; motions of the joints over time
    rapid, abb, ros             RAPID programs, backups of controllers, ROS
    IrbkinError                 the class of all errors; UnreachableError and others in `errors`
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from irbkin import _other_names
from irbkin._core import (
    Cell,
    Follower,
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
from irbkin.freedom import Positioner, ToolCone, ToolRotation, Track
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
    from irbkin import stream as stream
    from irbkin import trajectory as trajectory
    from irbkin.calibration import calibrate as calibrate

__all__ = [
    "CalibrationError",
    "CatalogEntry",
    "Cell",
    "Configuration",
    "FollowResult",
    "Follower",
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
    "Reach",
    "Robot",
    "SingularityKind",
    "SingularityMode",
    "Solution",
    "Solutions",
    "Status",
    "ToolCone",
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
    "stream",
    "trajectory",
)
_EXTRAS = {"plot": "matplotlib"}

_other_names.add_to_robot()


def __getattr__(name: str) -> ModuleType | Callable[..., Any]:
    """Import `irbkin.rapid` and the like when they are first asked for; one that lacks its extra is
    an AttributeError, so that `hasattr` says no.
    """
    if name == "calibrate":
        from irbkin.calibration import calibrate

        return calibrate
    if name in _MODULES:
        import importlib

        try:
            return importlib.import_module(f"irbkin.{name}")
        except ImportError as missing:
            raise AttributeError(str(missing)) from missing
    own = _other_names.by_other(_other_names.OF_PACKAGE).get(name)
    instead = f": use {own}" if own else ""
    raise AttributeError(f"module 'irbkin' has no attribute {name!r}{instead}")


def __dir__() -> list[str]:
    """List what the package offers, its modules before their import, too; not those that lack their
    extra, which whoever asks for every name of the list would have to import.
    """
    from importlib.util import find_spec

    own = {name for name in globals() if name.startswith("__")}
    lacking = {name for name, extra in _EXTRAS.items() if find_spec(extra) is None}
    return sorted({*__all__, *_MODULES, *own, "errors", "freedom", "records"} - lacking)
