"""Count the instructions of a call and compare them with the recorded ones.

`make evidence SUITE=instructions`; WRITE=1 records. With `--check` single calls alone are counted,
and one that takes 3 % more than recorded by the same compiler fails.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

from built import executable, toolchain

PAGE = Path(__file__).with_suffix(".md")
# valgrind has no AVX-512: it reports the processor as one
# without.
SETS = ("avx2", "baseline")
# The calls, and the number of poses of each.
WHAT = {
    "fk": 1,
    "jacobian": 1,
    "ik, 8 solutions": 1,
    "ik, wrist singular": 1,
    "UR3: ik, 8 solutions": 1,
    "Panda: ik, 8 solutions": 1,
    "ik_nearest": 1,
    "singularity": 1,
    "batch fk": 512,
    "batch jacobian": 512,
    "batch ik": 512,
    "batch singularity": 512,
}
# A single call may take so many times what is recorded.
MOST = 1.03
# The difference of two counts excludes start and preparation.
FEW, MANY = 2, 12


def counted(program: str, what: str, instructions: str, times: int) -> int:
    """Instructions of the whole program."""
    valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    run = subprocess.run(
        [*valgrind, program, what, instructions, str(times)], capture_output=True, text=True
    )
    found = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or found is None:
        sys.exit(f"valgrind cannot run {what} on {instructions}:\n{run.stderr}")
    return int(found[1])


def recorded() -> dict[str, list[int]]:
    """The table of the page: a row's counts by its name."""
    rows = (
        re.findall(r"^\| (.+?) \| (\d+) \| (\d+) \|$", PAGE.read_text(), re.MULTILINE)
        if PAGE.exists()
        else []
    )
    return {name: [int(count) for count in counts] for name, *counts in rows}


def page(counts: dict[str, list[int]]) -> str:
    """The page with these counts."""
    rows = "\n".join(f"| {name} | {' | '.join(map(str, row))} |" for name, row in counts.items())
    return f"""# Instructions of one pose

Counted by callgrind, without start and preparation. Batch figures are for one of 512 poses. The
counts depend on the compiler, not on the load of the machine. valgrind does not run AVX-512.

`make evidence SUITE=instructions` counts again and shows the difference; with `WRITE=1` it writes
this page. Recorded with {toolchain()}.

| IRB 2600-12/1.65 | {" | ".join(SETS)} |
|---|---:|---:|
{rows}
"""


def main() -> None:
    """Count, compare and, on request, record."""
    if shutil.which("valgrind") is None:
        print("valgrind is missing: nothing is counted (Debian: apt-get install valgrind)")
        return
    is_check = "--check" in sys.argv
    if is_check and f"Recorded with {toolchain()}." not in PAGE.read_text().replace("\n", " "):
        print(f"SKIPPED: instructions are recorded with another compiler than {toolchain()}")
        return
    program, before, now, above = executable(), recorded(), {}, []
    print(
        f"{toolchain()}\n"
        f"{'instructions a pose':24}{'set':10}{'recorded':>10}{'now':>10}{'change':>10}"
    )
    for what, poses in WHAT.items():
        if is_check and poses > 1:
            continue
        now[what] = []
        for number, instructions in enumerate(SETS):
            difference = counted(program, what, instructions, MANY) - counted(
                program, what, instructions, FEW
            )
            count = round(difference / (MANY - FEW) / poses)
            now[what].append(count)
            old = before[what][number] if what in before else None
            change = f"{(count / old - 1) * 100:+9.1f}%" if old else "new"
            print(f"{what:24}{instructions:10}{old or '':>10}{count:10}{change:>10}", flush=True)
            if is_check and (not old or count > MOST * old):
                above.append(f"{what} ({instructions})")
    if "--write" in sys.argv:
        PAGE.write_text(page(now))
    if above:
        sys.exit(f"more than {MOST} x the recorded instructions: {', '.join(above)}")


if __name__ == "__main__":
    main()
