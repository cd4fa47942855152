"""The ratchet: lines of the crates and of the Python package may only fall.

Usage: python tests/weight.py [--write]. `tests/weight.txt` holds the lines of each part, without
tests and the type stub, and the grants of issues. Fails if all parts together have more lines than
recorded and granted, or so much less that the record is out of date. --write records them: above
the last record only what is granted, and then the grants are spent.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
RECORD = ROOT / "tests" / "weight.txt"
# Data count as code does.
ENDINGS = {".rs", ".h", ".hpp", ".py", ".js", ".css", ".html", ".md", ".toml", ".csv", ".txt"}
TESTS = re.compile(r"(^|[/_])tests?(/|\.rs$)|/exhaustive\.rs$")
UNIT_TESTS = re.compile(r"^#\[cfg\((?:all\()?test\b.*\]\n(?:#\[.*\n)*mod \w+ \{", re.MULTILINE)
PART = re.compile(r"^([\w-]+) (\d+)$", re.MULTILINE)
GRANT = re.compile(r"^([+-]\d+) \S.*$", re.MULTILINE)
# A record that is above the lines by more is out of date.
SLACK = 0.01


def lines(file: Path) -> int:
    """The lines of a file above its unit tests."""
    text = file.read_text()
    if file.suffix == ".rs" and (tests := UNIT_TESTS.search(text)):
        text = text[: tests.start()]
    return text.count("\n")


def part(name: str) -> str:
    """The crate of a file, or the Python package."""
    top, below, *_ = name.split("/")
    if top == "crates":
        return below
    return "irbkin" if top == "src" else top


def counted() -> dict[str, int]:
    """Lines of each part."""
    sums: dict[str, int] = {}
    for top in ("src", "crates", "python"):
        for file in sorted((ROOT / top).rglob("*")):
            name = file.relative_to(ROOT).as_posix()
            if file.suffix in ENDINGS and not TESTS.search(name.removeprefix(f"{top}/")):
                sums[part(name)] = sums.get(part(name), 0) + lines(file)
    return sums


def main() -> int:
    """Compare the lines with the record."""
    record = RECORD.read_text()
    recorded = {name: int(count) for name, count in PART.findall(record)}
    granted = sum(int(grant) for grant in GRANT.findall(record))
    found = counted()
    total, most = sum(found.values()), sum(recorded.values()) + granted
    if "--write" in sys.argv[1:] and total <= most:
        kept = PART.sub("", record)
        if total > most - granted:
            kept = GRANT.sub("", kept)
        parts = "\n".join(f"{name} {count}" for name, count in found.items())
        RECORD.write_text(f"{kept.strip()}\n\n{parts}\n")
        return 0
    print("\n".join(f"{name:16}{count:8,}" for name, count in found.items()))
    print(f"{'all':16}{total:8,} of {most:,}")
    if total > most:
        print(f"{total - most} lines too many: what could go? A grant is an issue's (weight.txt)")
    elif total < (1 - SLACK) * most:
        print("the record is out of date: python tests/weight.py --write")
    else:
        return 0
    return 1


if __name__ == "__main__":
    sys.exit(main())
