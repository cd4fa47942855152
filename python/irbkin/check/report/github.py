"""A report as workflow commands of GitHub Actions: annotations at the lines of a pull request."""

from irbkin._words import visible
from irbkin.check.report import Report
from irbkin.check.report.text import heading


def render(report: Report) -> str:
    lines = []
    for found in report.findings:
        _, begin, end = report.place(found)
        properties = {
            "title": f"irbkin {found.code} {found.name}",
            "file": found.file.replace("\\", "/"),
            "line": found.line,
            "col": begin + 1,
            "endLine": found.line,
            "endColumn": end + 1,
        }
        words = ",".join(f"{key}={_escaped(value, ':,')}" for key, value in properties.items())
        text = _escaped(heading(found, is_colored=False, show=str), "")
        lines.append(f"::{found.severity.replace('note', 'notice')} {words}::{text}\n")
    if not report.is_quiet:
        lines.append(f"::notice title=irbkin::{_escaped(report.coverage, '')}\n")
    return "".join(lines)


def _escaped(value: object, beside: str) -> str:
    text = str(value)
    for character in f"%\r\n{beside}":
        text = text.replace(character, f"%{ord(character):02X}")
    return visible(text)
