"""A report as SARIF 2.1.0, which code hosts and editors read."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any
from urllib.parse import quote

from irbkin.cli.codes import codes, rules
from irbkin.cli.findings import Found
from irbkin.cli.report import Report

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def render(report: Report) -> str:
    """Return the log."""
    from irbkin import __version__

    driver = {"name": "irbkin", "version": __version__, "rules": [_rule(it) for it in rules()]}
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(it, report) for it in report.found],
        "properties": {"robot": report.robot, "moves": report.coverage._asdict()},
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


def _result(found: Found, report: Report) -> dict[str, Any]:
    begin, end = found.span(report.text_of(found.file).line(found.line))
    # A finding on a whole file has no line.
    region = _region((found.line, begin + 1), (found.line, end + 1)) if found.line else None
    location: dict[str, Any] = {"physicalLocation": _physical(found.file, region)}
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
            {
                "physicalLocation": _physical(
                    it.file, {"startLine": it.line, "startColumn": it.column}
                ),
                "message": {"text": it.message},
            }
            for it in found.related
        ]
    numbers = {key: getattr(found, key) for key in ("joint", "value", "bound")}
    if known := {key: it for key, it in numbers.items() if it is not None}:
        result["properties"] = known
    if found.edits:
        result["fixes"] = [_fix(found, report)]
    return result


def _fix(found: Found, report: Report) -> dict[str, Any]:
    changes: dict[str, list[dict[str, Any]]] = {}
    for file, begin, end, new in found.edits:
        text = report.text_of(file)
        region = _region(text.position(begin), text.position(end))
        replacement = {"deletedRegion": region, "insertedContent": {"text": new}}
        changes.setdefault(file, []).append(replacement)
    artifacts = [
        {"artifactLocation": {"uri": _uri(file)}, "replacements": replacements}
        for file, replacements in changes.items()
    ]
    return {"description": {"text": "Correct the confdata."}, "artifactChanges": artifacts}


def _physical(file: str, region: dict[str, int] | None) -> dict[str, Any]:
    location: dict[str, Any] = {"artifactLocation": {"uri": _uri(file)}}
    return location if region is None else {**location, "region": region}


def _region(begin: tuple[int, int], end: tuple[int, int]) -> dict[str, int]:
    return {
        "startLine": begin[0],
        "startColumn": begin[1],
        "endLine": end[0],
        "endColumn": end[1],
    }


def _uri(file: str) -> str:
    """A relative path stays relative: viewers look for it where they run."""
    return Path(file).as_uri() if os.path.isabs(file) else quote(file.replace(os.sep, "/"))
