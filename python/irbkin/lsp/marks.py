"""Findings, corrections and declarations in the words of the protocol."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from lsprotocol import types

from irbkin.lsp.names import ROUTINES, Declared, end_of
from irbkin.lsp.text import Text

if TYPE_CHECKING:
    from irbkin.lsp.work import Desk, Found, Result

SOURCE = "irbkin"
"""How editors name where a diagnostic is from."""
FIX_ALL = "source.fixAll.irbkin"
SEVERITIES = {
    "error": types.DiagnosticSeverity.Error,
    "warning": types.DiagnosticSeverity.Warning,
    "note": types.DiagnosticSeverity.Information,
}
KINDS = {
    "PROC": types.SymbolKind.Function,
    "FUNC": types.SymbolKind.Function,
    "TRAP": types.SymbolKind.Event,
    "RECORD": types.SymbolKind.Struct,
    "ALIAS": types.SymbolKind.Struct,
}


def uri_of(path: str) -> str:
    """Return the address of a file; a document that is not saved keeps its own."""
    return Path(path).as_uri() if os.path.isabs(path) else path


def diagnostics(results: Iterable[Result], path: str, desk: Desk) -> list[types.Diagnostic]:
    """Return what is found in a file, once for all its tasks."""
    marks: dict[tuple[int, int, str, str], types.Diagnostic] = {}
    for result in results:
        module = result.modules.get(path)
        text = Text("") if module is None else result.text(module)
        for it in result.found_in.get(path, ()):
            key = (it.line, it.column, it.code, it.message)
            if key not in marks:
                marks[key] = _diagnostic(it, text, desk)
    return list(marks.values())


def _diagnostic(it: Found, text: Text, desk: Desk) -> types.Diagnostic:
    begin, end = it.span(text.row(it.line))
    start = text.at(it.line, 1)
    related = [
        types.DiagnosticRelatedInformation(
            types.Location(uri_of(os.path.abspath(other.file)), _point(other.line, other.column)),
            other.message,
        )
        for other in it.related
    ]
    return types.Diagnostic(
        text.range(start + begin, min(start + end, len(text.source))),
        it.message,
        SEVERITIES[it.severity],
        it.code,
        types.CodeDescription(desk.rule(it.code)[0]),
        SOURCE,
        related_information=related or None,
    )


def _point(line: int, column: int) -> types.Range:
    at = types.Position(max(line - 1, 0), max(column - 1, 0))
    return types.Range(at, at)


def actions(
    results: Sequence[Result], path: str, params: types.CodeActionParams
) -> list[types.CodeAction]:
    """Return the corrections of the findings in a range of a file, and of all in it."""
    quick: dict[str, types.CodeAction] = {}
    everything: dict[str, dict[tuple[int, int], types.TextEdit]] = {}
    for result in results:
        module = result.modules.get(path)
        if module is None:
            continue
        text = result.text(module)
        for it in result.found_in.get(path, ()):
            if not it.edits:
                continue
            edits = _edits(result, it)
            for uri, own in edits.items():
                everything.setdefault(uri, {}).update(own)
            start = text.at(it.line, 1)
            begin, end = it.span(text.row(it.line))
            if _meets(text.range(start + begin, start + end), params.range):
                at = [mark for mark in params.context.diagnostics if _is_of(mark, it, text)]
                title = f"Correct the confdata: {it.message.partition(':')[0]} ({it.code})"
                kind = types.CodeActionKind.QuickFix
                edit = _edit(edits)
                quick[title] = types.CodeAction(title, kind, at, is_preferred=True, edit=edit)
    found = list(quick.values())
    if everything:
        title = "Correct all confdata of this file"
        found.append(types.CodeAction(title, FIX_ALL, edit=_edit(everything)))
    return [it for it in found if _is_wanted(it, params.context.only)]


def _is_wanted(action: types.CodeAction, only: Sequence[types.CodeActionKind | str] | None) -> bool:
    """Whether an action is of one of the kinds that an editor asks for, or of a kind in it."""
    kind = str(getattr(action.kind, "value", action.kind))
    wanted = [str(getattr(it, "value", it)) for it in only or ()]
    return only is None or any(kind == it or kind.startswith(f"{it}.") for it in wanted)


def _edits(result: Result, it: Found) -> dict[str, dict[tuple[int, int], types.TextEdit]]:
    """The edits of a finding by file and bytes."""
    edits: dict[str, dict[tuple[int, int], types.TextEdit]] = {}
    for file, begin, end, new in it.edits:
        text = result.text(result.modules[file])
        edit = types.TextEdit(text.range_of_bytes(begin, end), new)
        edits.setdefault(uri_of(file), {})[begin, end] = edit
    return edits


def _edit(edits: dict[str, dict[tuple[int, int], types.TextEdit]]) -> types.WorkspaceEdit:
    return types.WorkspaceEdit({uri: list(own.values()) for uri, own in edits.items()})


def _is_of(mark: types.Diagnostic, it: Found, text: Text) -> bool:
    at = text.position(text.at(it.line, it.column))
    return (mark.code, mark.range.start) == (it.code, at)


def _meets(one: types.Range, other: types.Range) -> bool:
    def point(at: types.Position) -> tuple[int, int]:
        return at.line, at.character

    return point(one.start) <= point(other.end) and point(other.start) <= point(one.end)


def location(result: Result, declared: Declared) -> types.Location:
    """Return the place of a declaration."""
    begin, end = declared.span(text := result.text(declared.module))
    path = result.program.files[declared.module].path
    return types.Location(uri_of(path), text.range(begin, end))


def symbols(result: Result, module: int) -> list[types.DocumentSymbol]:
    """Return the routines and data of a module, the data of routines in these."""
    text, outer = result.text(module), list[types.DocumentSymbol]()
    routines: dict[str, types.DocumentSymbol] = {}
    for it in result.names.of_modules[module]:
        begin, end = it.span(text)
        start = min(text.at(it.line, it.column), begin)
        stop = end_of(text, end) if it.kind in ROUTINES else max(_statement_end(text, end), end)
        kind = KINDS.get(it.kind, types.SymbolKind.Variable)
        if "CONST" in it.words.upper().split()[:2]:
            kind = types.SymbolKind.Constant
        detail = "" if it.kind in ROUTINES else it.kind
        whole, own = text.range(start, stop), text.range(begin, end)
        symbol = types.DocumentSymbol(it.name, kind, whole, own, detail, children=[])
        inside = routines.get((it.routine or "").lower())
        if inside is not None and inside.children is not None:
            inside.children = [*inside.children, symbol]
        else:
            outer.append(symbol)
        if it.kind in ROUTINES:
            routines[it.name.lower()] = symbol
    return outer


def _statement_end(text: Text, begin: int) -> int:
    end = text.source.find(";", begin)
    return len(text.source) if end < 0 else end + 1
