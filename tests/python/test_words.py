"""Idioms that the field does not use stay rare in code and documents."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
FILES = [
    *ROOT.glob("src/**/*.rs"),
    *ROOT.glob("python/**/*.py"),
    *ROOT.glob("docs/**/*.md"),
    *ROOT.glob("*.md"),
]
CONTINUED = re.compile(r"\s*\n\s*(?://[/!]?|#)?\s*")
IDIOM = re.compile(r"\b(?:[Tt]hose|[Tt]hat) of\b|\bis none\b")
OPENING = re.compile(r'(?P<mark>//[/!]?|#|""") ?(?:The same|What|Those)\b')
MOST = 60


def openings(lines: list[str]) -> int:
    """Number of comments and docstrings that begin with a pronoun."""
    count, before = 0, ""
    for line in map(str.strip, lines):
        found = OPENING.match(line)
        count += found is not None and not before.startswith(found["mark"])
        # An empty comment line ends a paragraph.
        before = "" if line in ("///", "//!", "//", "#") else line
    return count


def idioms(file: Path) -> int:
    """Number of idioms of a file, also across lines."""
    text = file.read_text(encoding="utf-8")
    count = len(IDIOM.findall(CONTINUED.sub(" ", text)))
    return count + (openings(text.splitlines()) if file.suffix != ".md" else 0)


def test_idioms_are_rare():
    counts = {str(file.relative_to(ROOT)): idioms(file) for file in FILES}
    worst = sorted(counts.items(), key=lambda item: -item[1])[:10]
    assert sum(counts.values()) <= MOST, f"{sum(counts.values())}, most of them in {worst}"
