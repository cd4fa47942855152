"""Corrections as a unified diff, which `patch` and `git apply` read unless it has escapes."""

import difflib
import re

from irbkin._words import visible
from irbkin.check.report.text import styled


def render(file: str, before: str, after: str, is_colored: bool) -> str:
    """Return the diff of a file."""
    file = visible(file)
    # Lines end with \n alone: a \r before it belongs to the line.
    old, new = (re.findall(r"[^\n]*\n|[^\n]+", text) for text in (before, after))
    rows = []
    for row in difflib.unified_diff(old, new, file, file):
        line, end, _ = row.partition("\n")
        line = visible(line.removesuffix("\r")) + "\r" * line.endswith("\r")
        is_head = row.startswith(("---", "+++"))
        style = {"+": "green", "-": "red", "@": "note"}.get(row[0])
        rows.append(styled(line, style, is_colored) if style and not is_head else line)
        rows.append(end or "\n\\ No newline at end of file\n")
    return "".join(rows)
