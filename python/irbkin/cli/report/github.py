"""A report as workflow commands of GitHub Actions: annotations at the lines of a pull request."""

from __future__ import annotations

from irbkin.cli.report import Report

COMMANDS = {"error": "error", "warning": "warning", "note": "notice"}


def render(report: Report) -> str:
    """Return one command for each finding."""
    lines = []
    for it in report.found:
        begin, end = it.span(report.text_of(it.file).line(it.line))
        properties = {
            "title": f"irbkin {it.code} {it.name}",
            "file": it.file.replace("\\", "/"),
            "line": it.line,
            "col": begin + 1,
            "endLine": it.line,
            "endColumn": end + 1,
        }
        words = ",".join(f"{key}={_escaped(value, ':,')}" for key, value in properties.items())
        lines.append(f"::{COMMANDS[it.severity]} {words}::{_escaped(it.text(), '')}\n")
    return "".join(lines)


def _escaped(value: object, beside: str) -> str:
    """A value without the characters that end a command, a property or a value."""
    text = str(value)
    for character in f"%\r\n{beside}":
        text = text.replace(character, f"%{ord(character):02X}")
    return text
