"""A report as JSON: an array with an object for each finding."""

from __future__ import annotations

import json
from typing import Any

from irbkin.cli.report import Report


def render(report: Report) -> str:
    """Return the array."""
    records: list[dict[str, Any]] = []
    for it in report.found:
        record = it._asdict()
        record["related"] = [place._asdict() for place in it.related]
        record["fixable"] = bool(it.edits)
        position = report.text_of(it.file).position
        record["edits"] = [
            {
                "begin": position(begin),
                "end": position(end),
                "text": text,
            }
            for begin, end, text in it.own_edits
        ]
        records.append(record)
    return json.dumps(records, indent=1) + "\n"
