"""Findings in files, and their output."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import NamedTuple

SYNTAX = "E001"
"""The code of a text that is broken."""


class Found(NamedTuple):
    """Something wrong at a place of a file."""

    file: str
    line: int
    column: int
    code: str
    name: str
    message: str
    edits: tuple[tuple[int, int, str], ...]

    def text(self) -> str:
        """A line as linters print it."""
        fixable = "[*] " if self.edits else ""
        return f"{self.file}:{self.line}:{self.column}: {self.code} {fixable}{self.message}"


def report(
    found: Sequence[Found], fixed: int, unchecked: int, *, as_json: bool, is_quiet: bool
) -> None:
    """Print what was found, and how many."""
    if as_json:
        import json

        keys = ("file", "line", "column", "code", "name", "message")
        records = [
            {**dict(zip(keys, it[: len(keys)], strict=True)), "fixable": bool(it.edits)}
            for it in found
        ]
        print(json.dumps(records, indent=1))
        return
    sys.stdout.write("".join(f"{it.text()}\n" for it in found))
    if is_quiet:
        return
    if fixed:
        print(f"Found {_errors(len(found) + fixed)} ({fixed} fixed, {len(found)} remaining).")
    elif found:
        fixable = sum(bool(it.edits) for it in found)
        hint = f" ({fixable} fixable with --fix)" if fixable else ""
        print(f"Found {_errors(len(found))}{hint}.")
    else:
        print("All checks passed!")
    if unchecked:
        places = "1 place is" if unchecked == 1 else f"{unchecked} places are"
        print(f"{places} not checked (--select U shows why).")


def _errors(count: int) -> str:
    return "1 error" if count == 1 else f"{count} errors"
