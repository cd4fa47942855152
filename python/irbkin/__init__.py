"""Kinematics of ABB IRB robots and their kin.

Every inverse-kinematics solution, each in a named slot, with limits and singularities told. Meters,
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
    Robot,
    Solution,
    Solutions,
    __version__,
    catalog,
    instruction_set,
    instruction_sets,
    pose,
    to_xyz_euler_zyx,
    to_xyz_wxyz,
    use_instruction_set,
)
from irbkin.errors import (
    InvalidJointsError,
    InvalidModelError,
    InvalidPoseError,
    IrbkinError,
    RapidError,
    UnknownRobotError,
    UnreachableError,
)
from irbkin.records import (
    Break,
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

if TYPE_CHECKING:
    from irbkin import rapid as rapid

__all__ = [
    "Break",
    "Configuration",
    "FollowResult",
    "FreeJoint",
    "IkBatch",
    "InvalidJointsError",
    "InvalidModelError",
    "InvalidPoseError",
    "IrbkinError",
    "PoseCheck",
    "RapidError",
    "Reach",
    "Robot",
    "Singularity",
    "SingularityKind",
    "Solution",
    "Solutions",
    "Status",
    "UnknownRobotError",
    "UnreachableError",
    "__version__",
    "catalog",
    "instruction_set",
    "instruction_sets",
    "pose",
    "rapid",
    "to_xyz_euler_zyx",
    "to_xyz_wxyz",
    "use_instruction_set",
]


def __getattr__(name: str) -> Any:
    """`irbkin.rapid` is imported when it is first asked for."""
    if name == "rapid":
        import importlib

        return importlib.import_module("irbkin.rapid")
    raise AttributeError(f"module 'irbkin' has no attribute {name!r}")
