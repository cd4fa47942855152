"""A report as JSON: an array with an object for each finding."""

from __future__ import annotations

import json
from typing import Any

from irbkin.cli.report import Report, position


def render(report: Report) -> str:
    """Return the array."""
    contents = {file: text.encode() for file, text in report.texts.items()}
    records: list[dict[str, Any]] = []
    for it in report.found:
        record = it._asdict()
        record["related"] = [place._asdict() for place in it.related]
        record["fixable"] = bool(it.edits)
        record["edits"] = [
            {
                "begin": position(contents[it.file], begin),
                "end": position(contents[it.file], end),
                "text": text,
            }
            for begin, end, text in it.edits
        ]
        records.append(record)
    return json.dumps(records, indent=1) + "\n"
