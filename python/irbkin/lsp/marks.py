"""Findings, corrections and declarations in the words of the protocol."""

import os
import re
from bisect import bisect
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from lsprotocol import types

from irbkin.check.codes import LEVELS, PAGE, rules
from irbkin.check.findings import Finding
from irbkin.check.report import span
from irbkin.lsp.names import ROUTINES, Declared
from irbkin.lsp.session import Result
from irbkin.lsp.text import Text

SOURCE = "irbkin"
"""The source of diagnostics, as editors show it."""
FIX_ALL = "source.fixAll.irbkin"
KINDS = {
    "PROC": types.SymbolKind.Function,
    "FUNC": types.SymbolKind.Function,
    "TRAP": types.SymbolKind.Event,
    "RECORD": types.SymbolKind.Struct,
    "ALIAS": types.SymbolKind.Struct,
}
COMMENTS = re.compile(r"^[ \t]*!.*(?:\n[ \t]*!.*)+", re.MULTILINE)
Edits = dict[str, dict[tuple[int, int], types.TextEdit]]
"""Edits by file and bytes."""


def uri_of(path: str) -> str:
    """Return the URI of a file; an unsaved document keeps its own."""
    return Path(path).as_uri() if os.path.isabs(path) else path


def found_in(results: Iterable[Result], path: str) -> Iterator[tuple[Result, Finding, types.Range]]:
    for result in results:
        module = result.modules.get(path)
        text = Text("") if module is None else result.text(module)
        for found in result.found_in.get(path, ()):
            start = text.at(found.line, 1)
            begin, end = span(found, text.row(found.line))
            yield result, found, text.range(start + begin, min(start + end, len(text.source)))


def diagnostics(results: Iterable[Result], path: str) -> list[types.Diagnostic]:
    marks: dict[tuple[int, int, str, str], types.Diagnostic] = {}
    for _, found, area in found_in(results, path):
        key = (found.line, found.column, found.code, found.message)
        if key not in marks:
            rule = types.CodeDescription(
                f"{PAGE.as_uri()}#{found.code.lower()}-{rules()[found.code].name}"
            )
            severity = types.DiagnosticSeverity(LEVELS.index(found.severity) + 1)
            marks[key] = types.Diagnostic(area, found.message, severity, found.code, rule, SOURCE)
    return list(marks.values())


def actions(
    results: Sequence[Result], path: str, params: types.CodeActionParams
) -> list[types.CodeAction]:
    """Return the corrections of the findings in a range of a file, and of all in it."""
    quick: dict[str, types.CodeAction] = {}
    everything: Edits = {}
    for result, found, area in found_in(results, path):
        edits: Edits = {}
        for file, begin, end, new in found.edits:
            edit = types.TextEdit(result.text(result.modules[file]).range_of_bytes(begin, end), new)
            for own in (edits, everything):
                own.setdefault(uri_of(file), {})[begin, end] = edit
        if edits and area.start <= params.range.end and params.range.start <= area.end:
            at = [
                mark
                for mark in params.context.diagnostics
                if (mark.code, mark.range.start) == (found.code, area.start)
            ]
            title = f"Correct the confdata of {_target(result, found)} ({found.code})"
            kind = types.CodeActionKind.QuickFix
            quick[title] = types.CodeAction(title, kind, at, is_preferred=True, edit=_edit(edits))
    offered = list(quick.values())
    if everything:
        title = "Correct all confdata of this file"
        offered.append(types.CodeAction(title, FIX_ALL, edit=_edit(everything)))
    return [action for action in offered if _is_wanted(action, params.context.only)]


def _target(result: Result, found: Finding) -> str:
    moves = result.moves.get(result.modules[found.file], ())
    own = (it.target for it in moves if (it.line, it.column) == (found.line, found.column))
    return next(own, "a target")


def _is_wanted(action: types.CodeAction, only: Sequence[types.CodeActionKind | str] | None) -> bool:
    """Whether an action is of one of the kinds that an editor asks for, or of a kind in it."""
    kind, *wanted = (str(getattr(word, "value", word)) for word in (action.kind, *(only or ())))
    return only is None or any(kind == word or kind.startswith(f"{word}.") for word in wanted)


def _edit(edits: Edits) -> types.WorkspaceEdit:
    return types.WorkspaceEdit({uri: list(own.values()) for uri, own in edits.items()})


def location(result: Result, declared: Declared) -> types.Location:
    begin, end = declared.span(text := result.text(declared.module))
    path = result.job.program.files[declared.module].path
    return types.Location(uri_of(path), text.range(begin, end))


def symbols(result: Result, module: int) -> list[types.DocumentSymbol]:
    text, outer = result.text(module), list[types.DocumentSymbol]()
    blocks = text.blocks
    routines: dict[str, list[types.DocumentSymbol]] = {}
    for declared in result.names.of_modules[module]:
        is_routine = declared.kind in ROUTINES
        begin, end = declared.span(text)
        start = min(text.at(declared.line, declared.column), begin)
        # LOCAL may be ahead of its block.
        at = bisect(blocks, (start,))
        is_block = is_routine and at < len(blocks) and blocks[at][0] < begin
        stop = blocks[at][1] if is_block else text.statement_end(end) + 1
        kind = KINDS.get(declared.kind, types.SymbolKind.Variable)
        if declared.is_constant:
            kind = types.SymbolKind.Constant
        inside: list[types.DocumentSymbol] = []
        areas = text.range(start, max(stop, end)), text.range(begin, end)
        words = "" if is_routine else declared.kind
        symbol = types.DocumentSymbol(declared.name, kind, *areas, words, children=inside)
        routines.get((declared.routine or "").lower(), outer).append(symbol)
        if is_routine:
            routines[declared.name.lower()] = inside
    return outer


def folds(result: Result, module: int) -> list[types.FoldingRange]:
    text = result.text(module)
    parts = [(begin, end) for begin, end, _ in text.blocks]
    parts += [match.span() for match in COMMENTS.finditer(text.source)]
    rows = ([text.place(offset)[0] - 1 for offset in part] for part in parts)
    return [types.FoldingRange(begin, end) for begin, end in rows if begin < end]


def places(
    named: Iterable[tuple[Result, Declared]], *, is_whole: bool = True
) -> list[types.Location]:
    """Return where something is named, once for all its programs, perhaps without declarations."""
    found: dict[tuple[str, int], types.Location] = {}
    for result, declared in named:
        own = location(result, declared)
        for module, at in result.references(declared):
            area = result.text(module).range(at, at + len(declared.name))
            place = types.Location(uri_of(result.job.program.files[module].path), area)
            if is_whole or place != own:
                found[place.uri, at] = place
    return list(found.values())
