"""A report as JUnit's XML, which Jenkins and GitLab read: a suite a file, a case a finding."""

import re
from collections import defaultdict
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from irbkin.check.findings import Finding
from irbkin.check.report import Report, counted
from irbkin.check.report.text import heading

FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML cannot have."""


def render(report: Report) -> str:
    """Return the document: notes are cases that pass, moves that are not checked are skipped."""
    found: dict[str, list[Finding]] = defaultdict(list)
    for it in report.findings:
        found[it.file].append(it)
    root = Element("testsuites", name="irbkin check")
    for file in dict.fromkeys([*report.texts, *found]):
        suite = SubElement(root, "testsuite", name=_text(file))
        for it in found[file]:
            case = _case(suite, f"{it.code} {it.name}, line {it.line}", file)
            kind = "system-out" if it.severity == "note" else "failure"
            what = {} if it.severity == "note" else {"type": it.severity, "message": it.message}
            below = SubElement(case, kind, {key: _text(value) for key, value in what.items()})
            below.text = _text(heading(it, is_colored=False))
        if not found[file]:
            _case(suite, "no findings", file)
    suite = SubElement(root, "testsuite", name="moves")
    case = _case(suite, f"{counted(report.checked, 'move')} checked", report.title)
    if report.is_wrong and root.find(".//failure") is None:
        SubElement(case, "failure", message=_text(report.coverage))
    if report.assumed:
        words = f"{counted(report.assumed, 'move')} checked with saved values or given tools"
        _case(suite, words, report.title)
    for reason, count in report.reasons.items():
        case = _case(suite, f"{counted(count, 'move')} not checked by {reason}", report.title)
        SubElement(case, "skipped", message=report.coverage)
    for suite in (root, *root):
        for key, kind in (("tests", "testcase"), ("failures", "failure"), ("errors", "error")):
            suite.set(key, str(sum(1 for _ in suite.iter(kind))))
    for suite in root:
        suite.set("skipped", str(sum(1 for _ in suite.iter("skipped"))))
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'


def _case(suite: Element, name: str, place: str) -> Element:
    return SubElement(suite, "testcase", name=_text(name), classname=_text(place))


def _text(words: str) -> str:
    return FORBIDDEN.sub("\ufffd", words)
