"""Compare irbkin with its peers: `python -m benches.peers [--brief] [--quick] [--write]`, from
the repository's root.
"""

from __future__ import annotations

import argparse
import warnings
from pathlib import Path

from . import machine, report
from .arms import IRB2600, PANDA, UR3
from .contenders import BUILDERS
from .general_arms import GENERAL
from .measure import BRIEF, QUICK, Effort
from .recall import recall, sets_of
from .rows import ROWS, gather, run

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "evidence" / "benchmarks.md"


def main() -> None:
    """Count, time and print; write the page when asked to."""
    parser = argparse.ArgumentParser(prog="python -m benches.peers", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="tiny counts: shows that it runs, measures nothing"
    )
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.name}, too")
    parser.add_argument(
        "--brief", action="store_true", help="ratios with bars, two minutes; no count of solutions"
    )
    arguments = parser.parse_args()
    if arguments.brief:
        return in_brief(QUICK if arguments.quick else BRIEF)
    if arguments.quick and arguments.write:
        parser.error("--quick measures nothing that is worth writing")
    effort = QUICK if arguments.quick else Effort()
    # What a package warns of at its import is no part of the table.
    warnings.simplefilter("ignore")

    about = machine.describe(BUILDERS)
    print(*about, sep="\n")
    missing: dict[str, str] = {}
    recalls = {}
    for arm in (IRB2600, *GENERAL):
        built, absent = gather(arm, missing)
        if arm is IRB2600:
            print(*(f"{package}: skipped ({word})" for package, word in missing.items()), sep="\n")
        solvers = [contender for contender in built if contender.task == "ik"]
        recalls[arm.name] = [
            recall(arm, solvers, poses) for poses in sets_of(arm, effort.recall, effort.singular)
        ]
        print(
            f"\nSolutions missed, {arm.name}",
            report.plain(report.losses(recalls[arm.name])),
            *(absent if arm is not IRB2600 else ()),
            sep="\n",
            flush=True,
        )

    results = []
    for row in ROWS:
        result = run(row, effort, missing)
        results.append(result)
        print(
            f"\n{row.title}",
            report.plain(report.times(result)),
            *result.absent,
            sep="\n",
            flush=True,
        )

    if arguments.write:
        report.write(PAGE, report.document(about, recalls, results, missing))
        print(f"\nWrote {PAGE.relative_to(ROOT)}, from which make docs draws its pictures")


def in_brief(effort: Effort) -> None:
    """Print the rows of arms that every package prepares at once, as ratios with bars."""
    warnings.simplefilter("ignore")
    print(*machine.describe(BUILDERS), "x: time of irbkin's; checked before the clock.", sep="\n")
    missing: dict[str, str] = {}
    for row in ROWS:
        if row.arm in (IRB2600, UR3, PANDA):
            result = run(row, effort, missing)
            print(f"\n{row.title}", report.bars(result), *result.absent, sep="\n", flush=True)
    print("\nNot installed:", ", ".join(missing) or "none")


if __name__ == "__main__":
    main()
