"""A report as JSON: the moves that were checked, and an object for each finding."""

import json
from typing import Any

from irbkin.check.report import Report


def render(report: Report) -> str:
    records: list[dict[str, Any]] = []
    for found in report.findings:
        position = report.text_of(found.file).position
        edits = [
            {"begin": position(begin), "end": position(end), "text": text}
            for file, begin, end, text in found.edits
            if file == found.file
        ]
        related = [
            {"file": file, "line": line, "column": column} for file, line, column in found.related
        ]
        others = {"edits": edits, "related": related, "fixable": bool(found.edits)}
        records.append({**found._asdict(), **others})
    rows = {"statistics": report.statistics} if report.is_counted else {"findings": records}
    return json.dumps({"robot": report.title, "moves": report.moves, **rows}, indent=1) + "\n"
