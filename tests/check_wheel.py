"""Check a wheel: its name, size, bill of materials and stub, and paths of the machine.

Usage: python tests/check_wheel.py dist/irbkin-*.whl
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

# 1.3 MB are wanted. Motions of RAPID, plans and splines through poses brought 0.27 MB to 1.59, free
# axes of plans, the check of RAPID modules, margins, URDF and the command 0.24 more, the solvers of
# arms without a closed form, whose determinant is compiled for each instruction set, 0.74 more,
# their self-motions and the nearest approach of seven joints 0.07 more, what is next to their
# singularities, eight at once, 0.04 more, batches of arms without a closed form in lanes 0.09 more,
# self-motions in two directions 0.03 more, what tells nearly merged solutions apart, with the
# command's checks of numbers, 0.02 more, the nearest joints on surfaces of seven axes, with
# confdata where axes are one line, 0.03 more, and rooms that are not filled before they are used,
# with solutions that are singular in two directions and joints given at ever new angles, 0.02 more,
# solutions that are put in order in lanes, and the last step of an offset wrist, 0.03 more, plans
# that are smoothed in lanes and timed 0.05 more, joint 3 coupled in either sense, paths and plans
# of seven joints, limits of jerk, bodies and cells 0.16 more; motions proven free, meshes, hulls,
# cells of files, fitted bodies and free motion 0.36 more, programs of RAPID that are followed, with
# functions, records and the reading behind faults 0.29 more, backups, reports and the server of
# editors 0.08 more, the same programs of seven axes 0.05 more, scenes, pictures of arms and the
# page's scripts 0.06 more, columns, hints and followers 0.04 more, motions between any states and
# questions for interrupts in everything that takes long 0.015 more, instructions of RAPID and calls
# with shapes of tools 0.1 more, files of RobotStudio, scenes of MoveIt, reasons of plans 0.08 more,
# hulls of links 0.13 more, words and rows of answers, RAPID in the command 0.08 more,
# the engine of pages 0.12, its renderer and programs 0.03, free motions in lanes 0.07 more.
# The rest is room for compilers.
# Tried for these: code folded by the linker, 8 kB smaller, which GNU's ld lacks; readers of arrays
# and pickles optimized for size, 6 kB larger; pyo3 for size, 3 kB larger; lists in place of maps of
# robots, 22 kB smaller, taken. The engine of pages as a crate that the extension links is 500 kB,
# since what it instantiates is there twice.
# A build with `-C llvm-args=-inline-threshold=100` is 7 % smaller, but its batches of singularities
# and configurations are 17 % and 60 % slower: it was not taken.
# Set points for control loops (guards of six and seven joints, EGM) and proofs along lines, for
# each instruction set, are 220 kB.
# RAPID, the page and the bindings as crates: what they instantiate of the core is there up to three
# times. Kernels of cells for any number of joints, and closed forms that a static names, are
# compiled in the core alone: 1.2 MB smaller. Arms with bodies as a crate are 140 kB. 5.6 MB are
# wanted. pyo3 and numpy for size first save nothing; to fold equal functions (lld's icf) is not
# tried. Programs of RAPID for size are 60 kB smaller, their checks 10 % slower: taken. What a
# controller refuses when it loads a program, world zones and loads are 28 kB.
MOST_BYTES = 5_600_000

SBOM = re.compile(r"irbkin-[^/]+\.dist-info/sboms/irbkin\.cyclonedx\.json")


def machine_paths() -> set[bytes]:
    """Folders whose names must not be in a wheel."""
    home = Path.home()
    rustc = subprocess.run(
        ["rustc", "--print", "sysroot"], capture_output=True, text=True, check=True
    )
    folders = {
        home,
        Path(os.environ.get("CARGO_HOME", home / ".cargo")),
        Path(os.environ.get("CARGO_TARGET_DIR", "target")).resolve(),
        Path(rustc.stdout.strip()),
        Path(__file__).resolve().parents[1],
        Path(tempfile.gettempdir()),
    }
    # The root folder is part of every path: a home of "/" cannot be looked for.
    return {f"{folder}/".encode() for folder in folders if folder != Path("/")}


def faults(wheel: Path) -> list[str]:
    """What is wrong with a wheel, a line each."""
    found = []
    size = wheel.stat().st_size
    if size > MOST_BYTES:
        found.append(f"{wheel.name} has {size} bytes, it must have at most {MOST_BYTES}")
    if "-cp310-abi3-" not in wheel.name:
        found.append(f"{wheel.name} is not of the stable ABI: its name has no cp310-abi3")
    with zipfile.ZipFile(wheel) as files:
        if not any(SBOM.fullmatch(name) for name in files.namelist()):
            found.append(f"{wheel.name} has no bill of materials: nothing matches {SBOM.pattern}")
        if b'"""Return' not in files.read("irbkin/_core.pyi"):
            found.append(f"{wheel.name} has a stub without docstrings: ship/documented.sh")
        for name in files.namelist():
            content = files.read(name)
            for path in sorted(machine_paths()):
                if path in content:
                    at = content.index(path)
                    text = content[at : at + 100].split(b"\0")[0].decode(errors="replace")
                    found.append(f"{name} contains a path of this machine: {text}")
    return found


if __name__ == "__main__":
    lines = [line for wheel in sys.argv[1:] for line in faults(Path(wheel))]
    for wheel in sys.argv[1:]:
        print(f"{Path(wheel).name}: {Path(wheel).stat().st_size} bytes")
    sys.exit("\n".join(lines) or 0)
