"""The cost of a map of reach, on one and on two threads.

POSES is about the number of poses, 10^6 if not given; QUICK=1 takes 10^5. Each row runs in a
process of its own; memory is its peak.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time

import irbkin
import irbkin.map
import numpy as np

QUICK = bool(os.environ.get("QUICK"))
POSES = 1e5 if QUICK else float(os.environ.get("POSES", "1e6"))
ROWS = {
    "one thread": 1,
    "two threads": 2,
}


def grid() -> tuple[irbkin.Robot, list[np.ndarray], np.ndarray]:
    """Positions around an arm, each with a hundred orientations."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    steps = round((POSES / 100) ** (1 / 3))
    axes = [np.linspace(*ends, steps) for ends in ((-1.9, 1.9), (-1.9, 1.9), (-0.9, 2.2))]
    return robot, axes, irbkin.map.orientations(25, 4)


def usage() -> tuple[float, int]:
    """CPU time [s] and peak memory [kB] of this process."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime, used.ru_maxrss


def mapped(threads: int) -> None:
    """Make the map, and print what it took."""
    robot, axes, orientations = grid()
    before, begin = usage(), time.perf_counter()
    found = irbkin.map.reach(robot, *axes, orientations, threads=threads)
    duration, after = time.perf_counter() - begin, usage()
    poses = found.reached.size * len(orientations)
    print(
        f"{poses:12,} poses {duration:8.1f} s {1e9 * duration / poses:6.0f} ns a pose"
        f" {1e9 * (after[0] - before[0]) / poses:6.0f} ns of CPU"
        f" {after[1] / 1024:6.0f} MB   {found.reached.sum():,} reached"
    )


def main() -> None:
    """Print the table."""
    if len(sys.argv) > 1:
        mapped(int(sys.argv[1]))
        return
    for name, threads in ROWS.items():
        command = [sys.executable, __file__, str(threads)]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        print(f"{name:18}{run.stdout.strip()}", flush=True)


if __name__ == "__main__":
    main()
