"""Show where the time of a pose goes, stage by stage: `make evidence SUITE=stages`.

Needs Linux's perf, nm and addr2line.

perf samples a call that is repeated. A sample belongs to the stage that lists the innermost of the
functions, inlined ones too, that it fell into.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from built import executable

SAMPLES_A_SECOND = 5000


class Work(NamedTuple):
    """What is repeated how often, the poses of a time, and its stages by file and beginning of the
    function.
    """

    what: str
    times: int
    poses: int
    stages: dict[str, tuple[str, ...]]


SINES = ("forward.rs sines",)
WORK = (
    Work(
        "fk",
        10_000_000,
        1,
        {"sines": SINES, "frames": ("axes.rs", "forward.rs run", "forward.rs tool")},
    ),
    Work("jacobian", 5_000_000, 1, {"sines": SINES, "frames, columns": ("axes.rs", "jacobian.rs")}),
    Work(
        "ik, 8 solutions",
        3_000_000,
        1,
        {
            "check": ("pose.rs",),
            "end frames": ("solver.rs",),
            "branches": ("branch.rs", "lanes.rs of"),
            "arc tangents": ("lanes.rs angles",),
            "wrap": ("columns.rs", "lanes.rs wrapped"),
            "answer": ("inverse.rs", "lanes.rs"),
        },
    ),
    Work(
        "batch fk",
        30_000,
        512,
        {"sines": SINES, "write": ("axes.rs write",), "frames": ("axes.rs", "dispatch.rs")},
    ),
    Work(
        "batch jacobian",
        10_000,
        512,
        {
            "sines": SINES,
            "write": ("jacobian.rs run",),
            "frames, columns": ("axes.rs", "jacobian.rs"),
        },
    ),
    Work(
        "batch ik",
        10_000,
        512,
        {
            "read": ("poses.rs read",),
            "check": ("poses.rs check",),
            "end frames": ("poses.rs seen_from_shoulder",),
            "branches": ("branch.rs", "lanes.rs branches"),
            "arc tangents": ("lanes.rs angles",),
            "wrap": ("columns.rs", "lanes.rs wrap"),
            "write": ("lanes.rs write",),
        },
    ),
)


def lines(*command: str, stdin: str | None = None) -> list[str]:
    """What a program prints."""
    return subprocess.run(
        command, input=stdin, stdout=subprocess.PIPE, check=True, text=True
    ).stdout.splitlines()


def samples(program: str, work: Work, instructions: str) -> Counter[str]:
    """Addresses inside the program, and how often they were met."""
    symbols = {
        fields[2]: int(fields[0], 16)
        for fields in map(str.split, lines("nm", program))
        if len(fields) == 3
    }
    addresses: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        data = str(Path(folder) / "perf.data")
        record = (
            "perf",
            "record",
            "-q",
            "-F",
            str(SAMPLES_A_SECOND),
            "-e",
            "cpu-clock:u",
            "-o",
            data,
        )
        lines(*record, program, work.what, instructions, str(work.times))
        for line in lines("perf", "script", "-i", data, "--no-demangle", "-F", "ip,sym,symoff"):
            symbol, _, offset = line.split()[-1].partition("+")
            addresses[
                hex(symbols[symbol] + int(offset or "0", 16)) if symbol in symbols else ""
            ] += 1
    return addresses


def functions(program: str, addresses: Counter[str]) -> dict[str, list[str]]:
    """File and name of the functions that an address is in, the innermost first."""
    places: dict[str, list[str]] = {}
    found = iter(
        lines("addr2line", "-aifC", "-e", program, stdin="\n".join(filter(None, addresses)))
    )
    address = ""
    for line in found:
        if line.startswith("0x"):
            address = hex(int(line, 16))
            places[address] = []
        else:
            name = line.partition("<")[0].rpartition("::")[2]
            places[address].append(f"{Path(next(found).partition(':')[0]).name} {name}")
    return places


def main() -> None:
    """Sample and print a table for each work."""
    missing = [tool for tool in ("perf", "nm", "addr2line") if shutil.which(tool) is None]
    if missing:
        sys.exit(f"missing: {', '.join(missing)} (Debian: linux-perf, binutils)")
    program = executable()
    sets = sys.argv[1:] or lines(program, "sets")
    for work in WORK:
        print(f"\n{work.what}, ns a pose\n{'':16}" + "".join(f"{name:>12}" for name in sets))
        columns = []
        for instructions in sets:
            addresses = samples(program, work, instructions)
            places = functions(program, addresses)
            stages: Counter[str] = Counter()
            for address, count in addresses.items():
                innermost = (
                    stage
                    for place in places.get(address, ())
                    for stage, names in work.stages.items()
                    if place.startswith(names)
                )
                stages[next(innermost, "rest")] += count
            columns.append(stages)
        for stage in (*work.stages, "rest", "all"):
            row = [stages.total() if stage == "all" else stages[stage] for stages in columns]
            print(
                f"{stage:16}"
                + "".join(
                    f"{count / SAMPLES_A_SECOND / work.times / work.poses * 1e9:12.1f}"
                    for count in row
                )
            )


if __name__ == "__main__":
    main()
