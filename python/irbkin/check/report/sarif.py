"""A report as SARIF 2.1.0, which code hosts and editors read."""

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from irbkin import __version__
from irbkin.check.codes import codes, rules
from irbkin.check.findings import Finding
from irbkin.check.report import Report

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
REGION = ("startLine", "startColumn", "endLine", "endColumn")


def render(report: Report) -> str:
    driver = {"name": "irbkin", "version": __version__, "rules": [_rule(code) for code in rules()]}
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(found, report) for found in report.findings],
        "properties": {"robot": report.title, "moves": report.moves},
    }
    return json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=1) + "\n"


def _rule(code: str) -> dict[str, Any]:
    rule = rules()[code]
    meaning, cure = (" ".join(words.split()) for words in (rule.meaning, rule.cure))
    return {
        "id": code,
        "name": "".join(word.capitalize() for word in rule.name.split("-")),
        "shortDescription": {"text": f"{rule.title}."},
        "fullDescription": {"text": meaning},
        "help": {
            "text": f"{meaning} Cure: {cure}",
            "markdown": f"{rule.meaning}\n\n**Cure:** {rule.cure}\n\n{rule.blocks}",
        },
        "defaultConfiguration": {"level": codes()[code].severity},
    }


def _result(found: Finding, report: Report) -> dict[str, Any]:
    place: dict[str, Any] = _artifact(found.file)
    # A finding on a whole file has no line.
    if found.line:
        _, begin, end = report.place(found)
        place["region"] = _region((found.line, begin + 1), (found.line, end + 1))
    location: dict[str, Any] = {"physicalLocation": place}
    if found.routine:
        location["logicalLocations"] = [{"name": found.routine, "kind": "function"}]
    result: dict[str, Any] = {
        "ruleId": found.code,
        "ruleIndex": list(rules()).index(found.code),
        "level": found.severity,
        "message": {"text": found.message},
        "locations": [location],
    }
    if found.related:
        result["relatedLocations"] = [
            {"physicalLocation": {**_artifact(file), "region": _region(begin, ())}}
            for file, *begin in found.related
        ]
    numbers = {key: getattr(found, key) for key in ("joint", "value", "bound")}
    if known := {key: number for key, number in numbers.items() if number is not None}:
        result["properties"] = known
    if found.edits:
        result["fixes"] = [_fix(found, report)]
    return result


def _fix(found: Finding, report: Report) -> dict[str, Any]:
    changes: dict[str, list[dict[str, Any]]] = {}
    for file, begin, end, new in found.edits:
        position = report.text_of(file).position
        region = _region(position(begin), position(end))
        replacement = {"deletedRegion": region, "insertedContent": {"text": new}}
        changes.setdefault(file, []).append(replacement)
    artifacts = [
        {**_artifact(file), "replacements": replacements} for file, replacements in changes.items()
    ]
    return {"description": {"text": "Correct the confdata."}, "artifactChanges": artifacts}


def _region(begin: Sequence[int], end: Sequence[int]) -> dict[str, int]:
    return dict(zip(REGION, (*begin, *end), strict=False))


def _artifact(file: str) -> dict[str, Any]:
    """A file; a relative path stays relative: viewers look for it where they run."""
    uri = Path(file).as_uri() if os.path.isabs(file) else quote(file.replace(os.sep, "/"))
    return {"artifactLocation": {"uri": uri}}
