"""Hovers: values of data; joints, confdata and distances of moves."""

import math
from collections.abc import Iterator
from typing import Any

from irbkin import Robot, rapid
from irbkin.check.codes import rules
from irbkin.check.findings import Finding
from irbkin.lsp.names import Declared
from irbkin.lsp.session import Result
from irbkin.lsp.text import NAME, Text
from irbkin.rapid import CheckedMove, Pose

MOST_MOVES = 3


def hover(result: Result, module: int, offset: int) -> tuple[str, tuple[int, int]]:
    """Return Markdown on the name or move at an offset in a module, if any, and its range."""
    text, declared = result.text(module), result.declared(module, offset)
    span = text.word(offset)
    moves = ((_span(text, move), move) for move in result.moves.get(module, ()))
    at = (pair for pair in moves if pair[0][0] <= offset <= pair[0][1])
    own, move = next(at, (span, None))
    parts: list[str] = []
    if declared is not None:
        parts += [f"```rapid\n{declared.words}\n```", *_value(declared.value)]
    if declared is not None and declared.kind in ("robtarget", "jointtarget"):
        name = text.source[slice(*span)].lower()
        if move is None or name not in map(str.lower, NAME.findall(move.target)):
            return "\n\n".join([*parts, *_moves_to(result, declared)]), span
    elif declared is not None:
        move = None
    if move is not None:
        parts += [*_move(result, module, move), *_rules(result, module, move)]
        span = span if declared else own
    return "\n\n".join(parts), span


def _span(text: Text, move: CheckedMove) -> tuple[int, int]:
    begin = text.at(move.line, move.column)
    return begin, text.statement_end(begin)


def _moves_to(result: Result, declared: Declared) -> Iterator[str]:
    """Yield the moves to a declared target, each joint vector once."""
    seen = set[tuple[float, ...]]()
    total = 0
    for module, moves in result.moves.items():
        for move in moves:
            if result.names.find(module, move.routine, move.target) != declared:
                continue
            total += 1
            joints = () if move.q is None else tuple(round(float(angle), 6) for angle in move.q)
            if len(seen) < MOST_MOVES and joints not in seen:
                seen.add(joints)
                yield from _move(result, module, move, result.job.program.files[module].path)
    if total == 0 and result.job.robot is not None:
        yield "No checked move goes to it."


def _move(result: Result, module: int, move: CheckedMove, file: str = "") -> Iterator[str]:
    """Yield joints, confdata and margins of a move at its target, or why they are missing."""
    robot = result.job.robot
    place = f"{file.replace(chr(92), '/').rpartition('/')[2]}:{move.line}: " if file else ""
    yield f"**{place}{move.target}** ({result.job.title})"
    if move.q is None or robot is None:
        found = _found_at(result, module, move)
        reasons = [it.message for it in found if it.code[0] in "RUNDC"]
        yield "\n".join(f"- {reason}" for reason in reasons) or "not checked"
        return
    degrees = [math.degrees(angle) + 0.0 for angle in move.q]
    head = "|".join(f"J{number}" for number in range(1, len(degrees) + 1))
    numbers = "|".join(f"{angle:.2f}" for angle in degrees)
    yield f"|{head}|\n|{'--:|' * len(degrees)}\n|{numbers}|"
    lines = [_confdata(robot, move), _limit(robot, move.q), *_singularity(robot, move.q)]
    yield "\n".join(f"- {line}" for line in lines)


def _confdata(robot: Robot, move: CheckedMove) -> str:
    own = [*robot.configuration(move.q)]  # type: ignore[arg-type]
    written = own if move.confdata is None else [*move.confdata]
    words = " as written" if move.confdata is not None else ""
    return f"confdata {own}" + (words if own == written else f", written is {written}")


def _limit(robot: Robot, q: Any) -> str:
    lower, upper = robot.limits.T
    rooms = [(float(low), axis, "lower") for axis, low in enumerate(q - lower, 1)]
    rooms += [(float(high), axis, "upper") for axis, high in enumerate(upper - q, 1)]
    room, axis, side = min(rooms)
    words = f"J{axis}, {abs(math.degrees(room)):.1f} deg"
    if room < 0.0:
        return f"outside limits: {words} beyond the {side} limit"
    margin = float(robot.margin(q).limits)
    return f"nearest limit: {words} to the {side} one (margin {margin:.2f})"


def _singularity(robot: Robot, q: Any) -> Iterator[str]:
    at = robot.singularity(q)
    distances = {
        f"wrist {math.degrees(at.wrist):.1f} deg": at.wrist,
        f"elbow {math.degrees(at.elbow):.1f} deg": at.elbow,
        f"shoulder {1e3 * float(at.shoulder):.0f} mm": at.shoulder,
    }
    if known := [words for words, distance in distances.items() if math.isfinite(distance)]:
        yield f"from singularities: {', '.join(known)}"


def _rules(result: Result, module: int, move: CheckedMove) -> Iterator[str]:
    for code in dict.fromkeys(found.code for found in _found_at(result, module, move)):
        rule = rules()[code]
        words = " ".join(f"{rule.meaning}\n\nCure: {rule.cure}".split())
        yield f"**{code}** {rule.name}: {words}"


def _found_at(result: Result, module: int, move: CheckedMove) -> list[Finding]:
    found = result.found_in.get(result.job.program.files[module].path, ())
    return [it for it in found if (it.line, it.column) == (move.line, move.column)]


def _value(value: Any) -> Iterator[str]:
    if isinstance(value, rapid.ToolData):
        held = "held by the robot" if value.robhold else "stationary"
        load = value.tload
        cog = ", ".join(f"{part:g}" for part in load.cog_mm)
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
    xyz = ", ".join(f"{part:g}" for part in pose.trans_mm)
    wxyz = ", ".join(f"{part:g}" for part in pose.rot)
    return f"({xyz}) mm, [{wxyz}]"
