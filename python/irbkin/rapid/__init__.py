"""ABB's RAPID: read and write modules, convert robtargets to joint angles and back.

    >>> from irbkin import Robot, rapid
    >>> p10 = rapid.parse(
    ...     "[[1018.6,0,1417.5],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    ... )
    >>> joints = rapid.calc_joint_t(Robot("IRB 2600-12/1.85"), p10)
    >>> abs(round(joints.robax_deg[4], 1))
    30.0

Millimeters and degrees, as the names of fields say; the robot's own numbers stay in meters and
radians.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from irbkin import _core
from irbkin._core import (
    Module,
    RoutineMotion,
    calc_joint_t,
    calc_moves,
    calc_rob_t,
    calc_targets,
    check,
    motion,
)
from irbkin.errors import RapidError
from irbkin.rapid.plans import plan_module, plan_targets
from irbkin.rapid.program import (
    Argument,
    Declaration,
    Diagnostic,
    Finding,
    MotionMove,
    MotionSettings,
    Move,
    Skipped,
    TargetTable,
)
from irbkin.rapid.records import (
    JointTarget,
    LoadData,
    Pose,
    RobTarget,
    SpeedData,
    ToolData,
    WobjData,
    ZoneData,
)

__all__ = [
    "Argument",
    "Declaration",
    "Diagnostic",
    "Finding",
    "JointTarget",
    "LoadData",
    "Module",
    "MotionMove",
    "MotionSettings",
    "Move",
    "Pose",
    "RobTarget",
    "RoutineMotion",
    "Skipped",
    "SpeedData",
    "TargetTable",
    "ToolData",
    "WobjData",
    "ZoneData",
    "calc_joint_t",
    "calc_moves",
    "calc_rob_t",
    "calc_targets",
    "check",
    "dump",
    "load",
    "motion",
    "parse",
    "plan_module",
    "plan_targets",
]


def parse(text: str | bytes, context: Iterable[Module] = ()) -> Any:
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
        RapidError: The text is broken; the message has the line and the column. What is not known
            is no error: it is skipped and listed in `Module.skipped`.
    """
    source = text if isinstance(text, str) else _core.decode(text)
    return (
        _core.parse_record(source)
        if source.lstrip().startswith("[")
        else _core.parse(source, context)
    )


def load(path: str | PathLike[str], context: Iterable[Module] = ()) -> Module:
    """Parse the module of a file (.mod, .sys, .prg).

    Args:
        path: The file: UTF-8, UTF-16 with its mark, else Latin-1.
        context: As for `parse`.

    Raises:
        RapidError: As `parse`; the message begins with the path.
        OSError: The file cannot be read.
    """
    content = Path(path).read_bytes()
    try:
        return _core.parse(content, context)
    except RapidError as error:
        error.args = (f"{path}: {error}",)
        raise


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
        RapidError: A value is no RAPID data or not finite, or a name is none.
    """
    is_data = isinstance(value, Mapping) and not isinstance(value, Module)
    return _core.dump(dict(value) if is_data else value, name)


def __dir__() -> list[str]:
    """List what the module offers."""
    return sorted(
        {*__all__, "plans", "program", "records", *(n for n in globals() if n.startswith("__"))}
    )
