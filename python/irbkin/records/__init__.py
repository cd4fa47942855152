"""Flags and records that come out of irbkin.

Records are named tuples. Those that hold arrays are equal where every array has the same shape and
the same values, NaN being equal to NaN; they cannot be hashed. The others compare and hash as
tuples do.
"""

from __future__ import annotations

from irbkin.records._answers import (
    Break,
    CatalogEntry,
    Configuration,
    ConfigurationBatch,
    FollowResult,
    FreeJoint,
    IkBatch,
    IkMargin,
    Margin,
    PoseCheck,
    Singularity,
    SingularityBatch,
)
from irbkin.records._flags import (
    BreakReason,
    Reach,
    SingularityKind,
    SingularityMode,
    Status,
)
from irbkin.records._motions import (
    MotionPeaks,
    ToolSpeedLimits,
    TrajectorySample,
)
from irbkin.records._plans import (
    Plan,
    PlanBreak,
    StrandEnd,
)

__all__ = [
    "Break",
    "BreakReason",
    "CatalogEntry",
    "Configuration",
    "ConfigurationBatch",
    "FollowResult",
    "FreeJoint",
    "IkBatch",
    "IkMargin",
    "Margin",
    "MotionPeaks",
    "Plan",
    "PlanBreak",
    "PoseCheck",
    "Reach",
    "Singularity",
    "SingularityBatch",
    "SingularityKind",
    "SingularityMode",
    "Status",
    "StrandEnd",
    "ToolSpeedLimits",
    "TrajectorySample",
]
