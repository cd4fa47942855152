"""Completion by the place: instructions, options, data by their types, targets by reach."""

import contextlib
import re
from collections.abc import Mapping
from heapq import nsmallest

from lsprotocol import types

from irbkin.errors import IrbkinError
from irbkin.lsp.code import BEGINNING, NOTHING, TYPE, Call, calls_at
from irbkin.lsp.names import NOWHERE, ROUTINES, Declared, Parameter, known, parameters
from irbkin.lsp.session import Result
from irbkin.lsp.text import NAME, Text
from irbkin.rapid import JointTarget, calc_targets

KINDS = {
    "PROC": types.CompletionItemKind.Function,
    "FUNC": types.CompletionItemKind.Function,
    "keyword": types.CompletionItemKind.Keyword,
    "type": types.CompletionItemKind.Class,
}
MOST = 1_000
ANY = ("", "var", "anytype")
"""Types of parameters and places that take all."""
OF_TARGETS = ("R101", "R102", "R106", "C201", "C203")
"""Codes of findings on a target by itself."""
Place = tuple[Result, int, Text, int]
"""The last check of a program, a module of it, the text of that as it is now, and an offset."""


def completions(at: Place, trigger: str | None) -> list[types.CompletionItem]:
    """Return what may be written at a place; as many as MOST if there is more than that."""
    result, module, text, offset = at
    calls, seen = calls_at(text.source, offset), _seen(at)
    call, faults = calls[-1], dict[str, str]()
    own, parameter = _parameters(call, seen)
    if call.option == "":
        left = (it for it in own or () if it.is_optional and it.name.lower() not in call.options)
        texts = ((it, it.name if it.kind == "switch" else f"{it.name}:=") for it in left)
        return [types.CompletionItem(it.name, detail=it.kind, insert_text=to) for it, to in texts]
    if calls is NOTHING or (calls is BEGINNING and trigger == " ") or (own and not parameter):
        return []
    kind = parameter.kind if parameter else call.kind
    if call.assigned.lower() in seen:
        kind = seen[call.assigned.lower()].type

    def is_wanted(it: Declared) -> bool:
        if it.kind in ("type", "keyword"):
            return calls is (TYPE if it.kind == "type" else BEGINNING)
        if calls is TYPE or it.kind in ("RECORD", "ALIAS"):
            return calls is TYPE and it.kind in ("RECORD", "ALIAS")
        if calls is BEGINNING:
            return it.kind == "PROC" or not (it.is_constant or it.kind in ROUTINES)
        is_signal = kind == "signal" and it.type.startswith(kind)
        return it.kind not in ("PROC", "TRAP") and (kind in ANY or it.type == kind or is_signal)

    wanted = {lower: it for lower, it in seen.items() if is_wanted(it)}
    if len(wanted) > MOST:
        typed = text.source[text.word(offset)[0] : offset].lower()
        near = (pair for pair in wanted.items() if typed in pair[0])
        wanted = dict(nsmallest(MOST, near, lambda pair: _depth(pair[1], module)))
    if kind in ("robtarget", "jointtarget"):
        faults = _faults(result, module, text.place(offset)[0], wanted)
    return [_item(it, module, faults.get(lower)) for lower, it in wanted.items()]


def signature(at: Place) -> types.SignatureHelp | None:
    _, _, text, offset = at
    seen = _seen(at)
    for call in reversed(calls_at(text.source, offset)):
        own, parameter = _parameters(call, seen)
        if own is not None:
            shown = [types.ParameterInformation((it.begin, it.end)) for it in own]
            active = own.index(parameter) if parameter else len(own)
            label = seen[call.name.lower()].words
            one = types.SignatureInformation(label, parameters=shown, active_parameter=active)
            return types.SignatureHelp([one], 0, active)
    return None


def _seen(at: Place) -> Mapping[str, Declared]:
    """All names that a place sees, in lower case."""
    result, module, text, offset = at
    routine = result.names.routine_at(module, text.place(offset)[0])
    signals = {
        name.lower(): Declared(NOWHERE, name, kind, f"{kind} {name}", None, False, 0, 0)
        for name, kind in ((it, f"signal{of.lower()}") for it, of in result.job.signals.items())
    }
    return {**known(), **signals, **result.names.visible(module, routine)}


def _parameters(
    call: Call, seen: Mapping[str, Declared]
) -> tuple[list[Parameter] | None, Parameter | None]:
    of = seen.get(call.name.lower())
    if of is None or of.kind not in ROUTINES:
        return None, None
    own = parameters(of.words)
    if call.option is not None:
        named = (it for it in own if it.is_optional and it.name.lower() == call.option.lower())
        return own, next(named, None)
    required = [it for it in own if not it.is_optional]
    return own, required[call.argument] if call.argument < len(required) else None


def _depth(it: Declared, module: int) -> int:
    return 0 if it.routine else 1 if it.module == module else 3 if it.module == NOWHERE else 2


def _item(it: Declared, module: int, fault: str | None) -> types.CompletionItem:
    rank = 5 if fault else 4 if it.kind in ("FUNC", "keyword") else _depth(it, module)
    order = re.sub(r"\d+", lambda number: number[0].zfill(6), it.name.lower())
    kind = KINDS.get(it.kind, types.CompletionItemKind.Variable)
    detail, order = fault or it.words, f"{rank} {order}"
    return types.CompletionItem(it.name, kind=kind, detail=detail, sort_text=order)


def _faults(result: Result, module: int, line: int, seen: Mapping[str, Declared]) -> dict[str, str]:
    """Why the arm does not reach targets, by names: in the moves that use them, else with the tool
    and the work object of the move before a line.
    """
    robot, modules = result.job.robot, result.job.program.modules
    if robot is None:
        return {}
    targets = {name: it for name, it in seen.items() if it.kind == "robtarget"}
    used = _faults_in_moves(result, targets)
    found = {name: own[0] for name, own in used.items() if all(own)}
    moves = [move for move in modules[module].moves if move.tool.value is not None]
    ahead = [move for move in moves if move.line < line]
    tool = wobj = None
    for move in ahead[-1:] or moves[:1]:
        tool, wobj = move.tool.value, move.wobj.value if move.wobj else None
    for index in {it.module for name, it in targets.items() if name not in used}:
        with contextlib.suppress(IrbkinError):
            table = calc_targets(robot, modules[index], tool, wobj)
            pairs = zip(map(str.lower, table.names), table.findings, strict=True)
            found |= {name: f"{it.code} {it.name}" for name, it in pairs if it and name not in used}
    lower, upper = robot.limits.T
    for name, it in seen.items():
        q = it.value.q if isinstance(it.value, JointTarget) else lower
        if len(q) == len(lower) and ((q < lower) | (q > upper)).any():
            found[name] = "outside limits"
    return found


def _faults_in_moves(result: Result, targets: Mapping[str, Declared]) -> dict[str, list[str]]:
    """What is wrong with targets in each checked move that uses them, by names; else empty."""
    found: dict[str, list[str]] = {}
    for module, moves in result.moves.items():
        own = result.found_in.get(result.job.program.files[module].path, ())
        wrong = {(it.line, it.column): it for it in own if it.code in OF_TARGETS}
        for move in (it for it in moves if it.unchecked is None):
            for name in targets.keys() & NAME.findall(move.target.lower()):
                it = targets[name]
                is_own = it.module == module and it.routine in (None, move.routine)
                if is_own or not (it.is_local or it.routine):
                    fault = wrong.get((move.line, move.column))
                    found.setdefault(name, []).append(f"{fault.code} {fault.name}" if fault else "")
    return found
