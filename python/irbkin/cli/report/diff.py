"""Corrections as a unified diff, which `patch` and `git apply` read."""

from __future__ import annotations

import difflib

from irbkin.cli.report.text import styled


def render(file: str, before: str, after: str, is_colored: bool) -> str:
    """Return the diff of a file."""
    texts = (it.split("\n") for it in (before, after))
    # Lines end with \n alone: a \r before it belongs to the line.
    old, new = ([*(f"{line}\n" for line in lines[:-1]), *lines[-1:]] for lines in texts)
    rows = []
    for row in difflib.unified_diff([it for it in old if it], [it for it in new if it], file, file):
        is_head = row.startswith(("---", "+++"))
        style = {"+": "added", "-": "removed", "@": "frame"}.get(row[0])
        ended = row if row.endswith("\n") else f"{row}\n\\ No newline at end of file\n"
        if style is None or is_head:
            rows.append(ended)
        else:
            line, _, rest = ended.partition("\n")
            rows.append(f"{styled(line, style, is_colored)}\n{rest}")
    return "".join(rows)
