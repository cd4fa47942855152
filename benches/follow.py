"""What share of the moves in a folder of programs is checked, and what keeps the others unseen.

Usage: FOLDER=programs [ROBOT="IRB 120-3/0.58"] make evidence SUITE=follow

Each backup below FOLDER is a program, as is each other folder with modules; without a backup's own
arm ROBOT makes the moves. Each program counts with at most 100 moves, so that no writer decides.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from irbkin.rapid.program import ENDINGS

MOST = 100
ROBOT = "IRB 120-3/0.58"
MECHANISMS = (
    ("where the robot is", r"C(RobT|JointT|Pos)\b|alc(Rob|Joint)T"),
    ("an undeclared tool or work object", r"^N60[23]|nothing declares|not in this module"),
    ("a unit that is not known", r"^U804|unit"),
    ("a displacement", r"displaces"),
    ("a call that is not followed", r"^U802"),
    ("a function", r"is not evaluated"),
    ("a parameter of a routine that nothing calls", r"a parameter of"),
    ("the variable of a loop", r"variable of a loop"),
    ("data without a value", r"has no value"),
    ("assigned data", r"assigns|value is not known"),
)
"""Why a move is not checked: the first one whose words a finding has."""


def programs(folder: Path) -> Iterator[tuple[Path, bool]]:
    """Yield the programs below a folder, and whether each is a backup."""
    backups = {it.parent.parent for it in folder.rglob("*") if it.name.lower() == "backinfo.txt"}
    yield from ((backup, True) for backup in sorted(backups))
    modules = (it for it in folder.rglob("*") if it.suffix.lower() in ENDINGS)
    for own in sorted({module.parent for module in modules}):
        if not backups & {own, *own.parents}:
            yield own, False


def checked(program: Path, robot: str | None) -> dict[str, Any] | None:
    """The report of a program; None if it cannot be checked."""
    command = [sys.executable, "-m", "irbkin", "check", "--json", "--select", "ALL"]
    command += ["--robot", robot] if robot else []
    done = subprocess.run([*command, str(program)], capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.stdout.startswith("{") else None


def main() -> None:
    """Print the shares and the ranking."""
    folder, robot = os.environ.get("FOLDER"), os.environ.get("ROBOT", ROBOT)
    if not folder:
        sys.exit("FOLDER= names no folder with programs")
    shares: list[list[float]] = []
    places, capped = Counter[str](), Counter[str]()
    hindered: dict[str, set[Path]] = defaultdict(set)
    for program, is_backup in programs(Path(folder)):
        report = checked(program, None if is_backup else robot)
        if not report or not report["moves"]["total"]:
            continue
        moves = report["moves"]
        shares.append([moves[key] / moves["total"] for key in ("checked", "assumed")])
        weights = [min(MOST, moves["total"]) * share for share in shares[-1]]
        shares[-1] += [min(MOST, moves["total"]), *weights]
        own = Counter[str]()
        for finding in report["findings"]:
            words = f"{finding['code']} {finding['message']}"
            if not re.match(r"U80[124]|N60[123]", words):
                continue
            name = next((name for name, own in MECHANISMS if re.search(own, words)), "other")
            own[name] += 1 + len(finding.get("related") or ())
            hindered[name].add(program)
        places += own
        capped += Counter({name: min(MOST, count) for name, count in own.items()})
    if not shares:
        sys.exit(f"{folder}: no program has moves")
    total = sum(row[2] for row in shares)
    part = [100 * sum(row[column] for row in shares) / total for column in (3, 4)]
    unseen = 100 * sum(row[0] + row[1] <= 0.0 for row in shares) / len(shares)
    print(f"{len(shares)} programs with moves, each with at most {MOST}")
    print(
        f"checked {part[0]:.1f} %, assumed {part[1]:.1f} %; neither in {unseen:.0f} % of programs"
    )
    print(f"\n{'why moves are not checked':46}programs  places  capped")
    for name, count in capped.most_common():
        print(f"{name:46}{len(hindered[name]):8}{places[name]:8}{count:8}")


if __name__ == "__main__":
    main()
