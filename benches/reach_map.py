"""The cost of a map of reach: here on one and two threads, and on a cluster of one and two workers.

POSES is about the number of poses, 10^6 if not given; QUICK=1 takes 10^5. Each row runs in a
process of its own. Times are from the call to the map, without the start of the cluster; CPU time
is that of all processes that work. Memory is the peak of the process that calls, and of the largest
worker.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time
from typing import Any

import irbkin
import irbkin.map
import numpy as np

QUICK = bool(os.environ.get("QUICK"))
POSES = 1e5 if QUICK else float(os.environ.get("POSES", "1e6"))
ROWS = {
    "one thread": (0, 1),
    "two threads": (0, 2),
    "dask, one worker": (1, 1),
    "dask, two workers": (2, 1),
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


def mapped(workers: int, threads: int) -> None:
    """Make the map, and print what it took."""
    robot, axes, orientations = grid()
    options: dict[str, Any] = {"threads": threads}
    clients: list[Any] = []
    if workers:
        import distributed

        cluster: Any = distributed.LocalCluster(  # type: ignore[no-untyped-call]
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            host="127.0.0.1",
        )
        clients = [distributed.Client(cluster), cluster]  # type: ignore[no-untyped-call]
        options["client"] = clients[0]
        # The workers import what they need.
        irbkin.map.reach(robot, 1.0, 0.0, 1.0, orientations, **options)

    def used() -> tuple[float, int, int]:
        """CPU time of all, peak memory of this process and of the largest worker."""
        theirs = list(clients[0].run(usage).values()) if clients else []
        own = usage()
        cpu = own[0] + sum(one[0] for one in theirs)
        return cpu, own[1], max((one[1] for one in theirs), default=0)

    before, begin = used(), time.perf_counter()
    found = irbkin.map.reach(robot, *axes, orientations, **options)
    duration, after = time.perf_counter() - begin, used()
    poses = found.reached.size * len(orientations)
    worker = f"{after[2] / 1024:6.0f} MB a worker" if workers else ""
    print(
        f"{poses:12,} poses {duration:8.1f} s {1e9 * duration / poses:6.0f} ns a pose"
        f" {1e9 * (after[0] - before[0]) / poses:6.0f} ns of CPU"
        f" {after[1] / 1024:6.0f} MB {worker}   {found.reached.sum():,} reached"
    )
    for one in clients:
        one.close()


def main() -> None:
    """Print the table."""
    if len(sys.argv) > 1:
        mapped(*map(int, sys.argv[1:]))
        return
    for name, arguments in ROWS.items():
        command = [sys.executable, __file__, *map(str, arguments)]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        print(f"{name:18}{run.stdout.strip()}", flush=True)


if __name__ == "__main__":
    main()
