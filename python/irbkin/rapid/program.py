"""What a RAPID module declares and moves, and the joint angles of its targets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

from irbkin._equality import by_value
from irbkin.rapid.records import JointTarget, RobTarget, SpeedData, ToolData, WobjData, ZoneData
from irbkin.records import ConfigurationBatch

if TYPE_CHECKING:
    from typing import TypeAlias

    import numpy as np
    import numpy.typing as npt

    from irbkin.rapid.records import Record

    _Elements: TypeAlias = list[Record] | list["_Elements"]

__all__ = [
    "Argument",
    "Declaration",
    "Diagnostic",
    "Finding",
    "MotionMove",
    "MotionSettings",
    "Move",
    "Skipped",
    "TargetTable",
]


class Declaration(NamedTuple):
    """A data declaration. Values are those of the text: what a program assigns is not followed."""

    name: str
    """Its name, as the text has it."""
    type: str
    """RAPID's name of it."""
    scope: Literal["LOCAL", "TASK", ""]
    """"LOCAL", "TASK" or nothing."""
    storage: Literal["CONST", "PERS", "VAR"]
    """"CONST", "PERS" or "VAR"."""
    routine: str | None
    """The routine that it is declared in; None for the module."""
    value: Record | _Elements | None
    """A record; nested lists of records for an array; None without a value."""
    line: int
    """Line of the text, from 1."""
    column: int
    """Column of the text, from 1."""


class Argument(NamedTuple):
    """An argument as it is written, without its name, and what it is by the declarations.

    What the module assigns has no value.
    """

    text: str
    """The argument as it is written."""
    value: RobTarget | JointTarget | ToolData | WobjData | SpeedData | ZoneData | float | None
    """What it is; None where the declarations do not give it."""
    reason: str | None
    """Why the value is not known, where it is None."""


class MotionSettings(NamedTuple):
    """How a move is made, by the instructions before it in its routine; by what a program starts
    with where there are none.
    """

    conf_l: bool = True
    """ConfL: whether MoveL and MoveC must arrive with the configuration of the target."""
    conf_j: bool = True
    """ConfJ: whether MoveJ must arrive with the configuration of the target."""
    sing_area: Literal["Off", "Wrist", "LockAxis4"] = "Off"
    """SingArea: what happens near the wrist singularity."""
    cir_path_mode: Literal[
        "PathFrame", "ObjectFrame", "CirPointOri", "Wrist45", "Wrist46", "Wrist56"
    ] = "PathFrame"
    """CirPathMode: what the orientation does in a MoveC."""


class Move(NamedTuple):
    """A move instruction."""

    kind: Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ"]
    """"MoveJ", "MoveL", "MoveC" or "MoveAbsJ"."""
    routine: str | None
    """The routine that it is in."""
    target: Argument
    """Where it goes: a RobTarget, of MoveAbsJ a JointTarget."""
    via: Argument | None
    """The point on the circle of a MoveC."""
    speed: str
    """The speed as it is written, such as "v1000"."""
    zone: str
    """The zone as it is written, such as "z50"."""
    tool: Argument
    """The tool: a ToolData."""
    wobj: Argument | None
    r"""The work object of \WObj; wobj0 is meant without one."""
    options: tuple[tuple[str, str | None], ...]
    """The other optional arguments: name and text; no text for a switch."""
    line: int
    """Line of the text, from 1."""
    column: int
    """Column of the text, from 1."""
    displaced: int | None
    """Line of the instruction that displaces it, which is not followed: PDispOn or PDispSet."""
    speed_data: Argument
    r"""The data of `speed`: a SpeedData, with the speed of \V."""
    zone_data: Argument
    r"""The data of `zone`: a ZoneData, with the radius of \Z."""
    time: Argument | None
    r"""The duration of \T, which replaces the speed [s]."""
    settings: MotionSettings
    """What ConfL, ConfJ, SingArea and CirPathMode set before it."""


@by_value
class MotionMove(NamedTuple):
    """A move of a motion."""

    kind: Literal["MoveJ", "MoveL", "MoveC", "MoveAbsJ"]
    """"MoveJ", "MoveL", "MoveC" or "MoveAbsJ"."""
    module_index: int
    """Its index in `Module.moves`."""
    line: int
    """Line of the instruction."""
    start: float
    """When it begins [s], halfway through the corner before it."""
    end: float
    """When it ends [s], halfway through the corner behind it."""
    length: float
    """The length of the tool's way in the work object [m]."""
    q: npt.NDArray[np.float64] | None
    """The joints at its target [rad], shape (6,), which is met or passed; None where it is left
    out.
    """
    as_programmed: bool
    """Whether it is made as it is programmed. Where not, the joints go straight to its target at
    their limits or, where `q` is None, it is left out.
    """


class Finding(NamedTuple):
    """What is wrong with a move of a motion."""

    kind: Literal[
        "unknown",
        "not_read",
        "setting",
        "unreachable",
        "limit",
        "path",
        "flip",
        "singularity",
        "configuration",
        "joint_speed",
        "duration",
    ]
    """What it is; docs/motion.md has the table."""
    move: int
    """Index of the move in `RoutineMotion.moves`; for an instruction that is not read, of the next
    one.
    """
    line: int
    """Line of the instruction."""
    column: int
    """Column of the instruction, from 1."""
    joint: int | None
    """The joint that it is about, from 1."""
    value: float | None
    """What was found, in SI units: the speed of the joint, its step in a flip, how far outside
    limits or reach, the distance from a singularity, the duration.
    """
    bound: float | None
    """What the value must not exceed; of a singularity, what it must not be below."""
    message: str
    """Line, move and what is wrong, in words."""


class Diagnostic(NamedTuple):
    """Something that is wrong at a place of a module; docs/check.md has the codes."""

    code: str
    """A letter for the group and three digits, such as "C201"."""
    name: str
    """The code in words, such as "wrong-confdata"."""
    line: int
    """Line of the instruction, from 1."""
    column: int
    """Column of the instruction, from 1."""
    routine: str | None
    """The routine that it is in."""
    message: str
    """What is wrong, in one line."""
    edits: tuple[tuple[int, int, str], ...]
    """What corrects it: first byte and end in `Module.source` as UTF-8, and the text that takes
    their place. Empty where nothing does.
    """


class Skipped(NamedTuple):
    """A part of the text that is not read."""

    line: int
    """Line of the text, from 1."""
    column: int
    """Column of the text, from 1."""
    routine: str | None
    """The routine that it is in; None for the module."""
    what: str
    """What it is and, of a datum, why it is not read."""
    text: str
    """The part as it is written."""


@by_value
class TargetTable(NamedTuple):
    """The joint angles of m targets."""

    kinds: tuple[str, ...]
    """"MoveL" and the like, or "robtarget"."""
    names: tuple[str, ...]
    """Each target as it is written, or the name of its declaration."""
    lines: npt.NDArray[np.int64]
    """Line of the instruction or of the declaration, shape (m,)."""
    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (m, 6), NaN where there are none."""
    configuration: ConfigurationBatch
    """That of the joint angles, int32 arrays of shape (m,); where there are none, that of the
    target.
    """
    wrist: npt.NDArray[np.float64]
    """Angle of joint 5 from 0 or 180 deg [rad], shape (m,)."""
    elbow: npt.NDArray[np.float64]
    """Angle between upper arm and forearm from stretched or folded [rad], shape (m,)."""
    shoulder: npt.NDArray[np.float64]
    """Distance of the wrist center from axis 1 [m], shape (m,)."""
    problems: tuple[str | None, ...]
    """Why there are no joint angles, or why they are others than the target asks for."""
