"""Count the lines of each room without unit tests; fail if one is above its budget.

Usage: python tests/rooms.py. The budgets are in ARCHITECTURE.md.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
ROW = re.compile(r"^\| `([\w/]+)` \| ([\d,]+) \|", re.MULTILINE)
ENDINGS = {".rs", ".h", ".hpp", ".py", ".pyi", ".js", ".css", ".html", ".md"}
TESTS = re.compile(r"(^|[/_])tests?(/|\.rs$)|/exhaustive\.rs$")
UNIT_TESTS = re.compile(r"^#\[cfg\((?:all\()?test\b.*\]\n(?:#\[.*\n)*mod \w+ \{", re.MULTILINE)


def lines(file: Path) -> int:
    """The lines of a file above its unit tests."""
    text = file.read_text()
    if file.suffix == ".rs" and (tests := UNIT_TESTS.search(text)):
        text = text[: tests.start()]
    return text.count("\n")


def counted() -> dict[str, tuple[int, int]]:
    """Lines and budget of each room; a file is of the longest path that it is in."""
    section = (ROOT / "ARCHITECTURE.md").read_text().split("\n## Budgets\n")[1].split("\n## ")[0]
    budgets = {room: int(budget.replace(",", "")) for room, budget in ROW.findall(section)}
    sums = dict.fromkeys(budgets, 0)
    for top in ("src", "crates", "python"):
        for file in (ROOT / top).rglob("*"):
            name = file.relative_to(ROOT).as_posix()
            if file.suffix not in ENDINGS or TESTS.search(name.removeprefix(f"{top}/")):
                continue
            room = max((it for it in budgets if f"{name}/".startswith(f"{it}/")), key=len)
            sums[room] += lines(file)
    return {room: (sums[room], budgets[room]) for room in budgets}


if __name__ == "__main__":
    rooms = counted()
    if sys.argv[1:] == ["--all"]:
        for room, (found, most) in rooms.items():
            print(f"{found:7,} of {most:7,}  {room}")
        print(f"{sum(found for found, _ in rooms.values()):7,} lines")
    above = {room: pair for room, pair in rooms.items() if pair[0] > pair[1]}
    for room, (found, most) in above.items():
        print(f"{room} has {found} lines, its budget in ARCHITECTURE.md is {most}", file=sys.stderr)
    sys.exit(bool(above))
