"""Hovers: values of data; joints, confdata and distances of moves."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from irbkin import rapid

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.lsp.names import Declared
    from irbkin.lsp.work import Desk, Found, Result
    from irbkin.rapid import CheckedMove, Pose

MOST_MOVES = 3
"""Moves to one target that are shown."""
TARGETS = ("robtarget", "jointtarget")
NAME = re.compile(r"[^\W\d]\w*")


def hover(result: Result, module: int, offset: int, desk: Desk) -> tuple[str, tuple[int, int]]:
    """Return Markdown on the place of an offset in a module, and the part of the text that it is
    about; empty where there is nothing to say.
    """
    text = result.text(module)
    begin, end = text.word(offset)
    line, _ = text.place(offset)
    name = text.source[begin:end]
    declared = None
    if name:
        declared = result.names.find(module, result.names.routine_at(module, line), name)
    move = move_at(result, module, offset)
    parts: list[str] = []
    if declared is not None:
        parts += [f"```rapid\n{declared.words}\n```", *_value(declared.value)]
    is_target = declared is not None and declared.kind in TARGETS
    if is_target and (move is None or not _is_of(move, name)):
        parts += _moves_to(result, declared)  # type: ignore[arg-type]
    elif move is not None and (declared is None or is_target):
        parts += [*_move(result, move), *_rules(result, module, move, desk)]
        begin, end = (begin, end) if declared else _span(result, module, move)
    return "\n\n".join(parts), (begin, end)


def move_at(result: Result, module: int, offset: int) -> CheckedMove | None:
    """Return the move whose statement an offset is in."""
    for move in result.moves.get(module, ()):
        begin, end = _span(result, module, move)
        if begin <= offset <= end:
            return move
    return None


def _span(result: Result, module: int, move: CheckedMove) -> tuple[int, int]:
    """The offsets of a statement without its semicolon."""
    text = result.text(module)
    begin = text.at(move.line, move.column)
    end = text.source.find(";", begin)
    return begin, len(text.source) if end < 0 else end


def _is_of(move: CheckedMove, name: str) -> bool:
    """Whether a name is in the target of a move."""
    return name.lower() in (it.lower() for it in NAME.findall(move.target))


def _moves_to(result: Result, declared: Declared) -> Iterator[str]:
    """Yield what is known of the moves to a declared target, each joint vector once."""
    seen = set[tuple[float, ...]]()
    lower, total = declared.name.lower(), 0
    for module, moves in result.moves.items():
        for move in moves:
            if move.target.lower() != lower:
                continue
            if result.names.find(module, move.routine, move.target) != declared:
                continue
            total += 1
            joints = () if move.q is None else tuple(round(float(it), 6) for it in move.q)
            if len(seen) < MOST_MOVES and joints not in seen:
                seen.add(joints)
                yield from _move(result, move, result.program.files[module].path)
    if total == 0 and result.checked is not None:
        yield "No checked move goes to it."


def _move(result: Result, move: CheckedMove, file: str = "") -> Iterator[str]:
    """Yield what is known of a move at its target."""
    robot = result.task.robot
    place = f"{file.replace(chr(92), '/').rpartition('/')[2]}:{move.line}: " if file else ""
    yield f"**{place}{move.target}** ({result.task.title})"
    if move.q is None or robot is None:
        reasons = [it.message for it in _found_at(result, move) if it.code[0] in "RUNDC"]
        yield "\n".join(f"- {it}" for it in reasons) or "not checked"
        return
    degrees = [math.degrees(it) + 0.0 for it in move.q]
    head = "|".join(f"J{number}" for number in range(1, len(degrees) + 1))
    numbers = "|".join(f"{it:.2f}" for it in degrees)
    yield f"|{head}|\n|{'--:|' * len(degrees)}\n|{numbers}|"
    lines = [*_confdata(robot, move), _limit(robot, move.q), *_singularity(robot, move.q)]
    yield "\n".join(f"- {it}" for it in lines)


def _confdata(robot: Robot, move: CheckedMove) -> Iterator[str]:
    of = robot.configuration(move.q)  # type: ignore[arg-type]
    own = [of.cf1, of.cf4, of.cf6, of.cfx]
    if move.confdata is None:
        yield f"confdata {own}"
        return
    it = move.confdata
    written = [it.cf1, it.cf4, it.cf6, it.cfx]
    yield f"confdata {own}" + (" as written" if own == written else f", written is {written}")


def _limit(robot: Robot, q: Any) -> str:
    """The nearest limit."""
    lower, upper = robot.limits.T
    rooms = [(float(low), axis, "lower") for axis, low in enumerate(q - lower, 1)]
    rooms += [(float(high), axis, "upper") for axis, high in enumerate(upper - q, 1)]
    room, axis, side = min(rooms)
    words = f"J{axis}, {abs(math.degrees(room)):.1f} deg"
    margin = float(robot.margin(q).limits)
    if room < 0.0:
        return f"outside limits: {words} beyond the {side} limit"
    return f"nearest limit: {words} to the {side} one (margin {margin:.2f})"


def _singularity(robot: Robot, q: Any) -> Iterator[str]:
    """The distances from singularities, of those that the arm has."""
    at = robot.singularity(q)
    angles = [
        f"{name} {math.degrees(value):.1f} deg"
        for name, value in (("wrist", float(at.wrist)), ("elbow", float(at.elbow)))
        if math.isfinite(value)
    ]
    shoulder = float(at.shoulder)
    if math.isfinite(shoulder):
        angles.append(f"shoulder {1e3 * shoulder:.0f} mm")
    if angles:
        yield f"from singularities: {', '.join(angles)}"


def _rules(result: Result, module: int, move: CheckedMove, desk: Desk) -> Iterator[str]:
    """Yield the rules of the findings on a move."""
    for code in dict.fromkeys(it.code for it in _found_at(result, move)):
        yield f"**{code}** {desk.rule(code)[1]}"


def _found_at(result: Result, move: CheckedMove) -> list[Found]:
    found = result.found_in.get(result.program.files[move.module].path, ())
    return [it for it in found if (it.line, it.column) == (move.line, move.column)]


def _value(value: Any) -> Iterator[str]:
    """Yield the value of a datum, in words where it has a frame."""
    if isinstance(value, rapid.ToolData):
        held = "held by the robot" if value.robhold else "stationary"
        load = value.tload
        cog = ", ".join(f"{it:g}" for it in load.cog_mm)
        yield f"Tool, {held}: {_frame(value.tframe)}; {load.mass_kg:g} kg at ({cog}) mm"
    elif isinstance(value, rapid.WobjData):
        moved = "" if value.ufprog else f", moved by {value.ufmec or 'an unnamed unit'}"
        held = ", held by the robot" if value.robhold else ""
        yield f"Work object{held}{moved}\n- user frame: {_frame(value.uframe)}\n" + (
            f"- object frame: {_frame(value.oframe)}"
        )
    elif value is not None and not isinstance(value, bool | str | list | tuple):
        yield f"```rapid\n{rapid.dump(value)}\n```"


def _frame(pose: Pose) -> str:
    xyz = ", ".join(f"{it:g}" for it in pose.trans_mm)
    wxyz = ", ".join(f"{it:g}" for it in pose.rot)
    return f"({xyz}) mm, [{wxyz}]"
