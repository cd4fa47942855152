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

from collections.abc import Iterable
from os import PathLike
from pathlib import Path

from irbkin._core import (
    NOT_THERE,
    Argument,
    Checked,
    CheckedMove,
    Declaration,
    Finding,
    JointTarget,
    LoadData,
    Module,
    MotionMove,
    MotionSettings,
    Move,
    Pose,
    RobTarget,
    Routine,
    RoutineMotion,
    Skipped,
    SpeedData,
    TargetTable,
    TextFault,
    ToolData,
    WobjData,
    ZoneData,
    calc_joint_t,
    calc_moves,
    calc_rob_t,
    calc_targets,
    check,
    dump,
    motion,
    parse,
    parse_module,
)
from irbkin.errors import RapidError
from irbkin.rapid.candidates import Candidate, Candidates, arms
from irbkin.rapid.plans import plan_module, plan_targets
from irbkin.rapid.porting import LeftMove, Ported, port
from irbkin.rapid.program import FileFinding, ModuleFile, Program, load_program

__all__ = [
    "NOT_THERE",
    "Argument",
    "Candidate",
    "Candidates",
    "Checked",
    "CheckedMove",
    "Declaration",
    "FileFinding",
    "Finding",
    "JointTarget",
    "LeftMove",
    "LoadData",
    "Module",
    "ModuleFile",
    "MotionMove",
    "MotionSettings",
    "Move",
    "Ported",
    "Pose",
    "Program",
    "RobTarget",
    "Routine",
    "RoutineMotion",
    "Skipped",
    "SpeedData",
    "TargetTable",
    "TextFault",
    "ToolData",
    "WobjData",
    "ZoneData",
    "arms",
    "calc_joint_t",
    "calc_moves",
    "calc_rob_t",
    "calc_targets",
    "check",
    "dump",
    "load",
    "load_program",
    "motion",
    "parse",
    "plan_module",
    "plan_targets",
    "port",
]


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
        return parse_module(content, context)
    except RapidError as error:
        error.args = (f"{path}: {error}",)
        raise


def __dir__() -> list[str]:
    """List what the module offers."""
    own = {*__all__, "candidates", "plans", "porting", "program"}
    return sorted({*own, *(n for n in globals() if n.startswith("__"))})
