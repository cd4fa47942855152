"""Python calls on one pose and on a batch, as ratios to a 4x4 matrix product measured in turn in the same run."""

from __future__ import annotations

import statistics
import subprocess
import sys
import timeit
from collections.abc import Callable

import irbkin
import numpy as np

# What the project wants to reach, as a ratio to the same yardstick.
GOALS = {"ik(T).q, 8 solutions": 1.0, "ik_batch, out=": 6.0}
RUST_GOALS = (
    "Rust, one pose with 8 solutions: 150 ns (AVX2 up); a batch, one thread: 30 ns a pose (AVX-512), 60 ns (AVX2)"
)
ROUNDS = 15
POSES = 100_000


def seconds(call: Callable[[], object], repeats: int) -> float:
    """Seconds a call takes, over `repeats` of them."""
    return timeit.timeit(call, number=repeats) / repeats


def main() -> None:
    """Measure and print the table."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
    T = robot.fk(q)
    rng = np.random.default_rng(1)
    poses = robot.fk(rng.uniform(*robot.limits.T, size=(POSES, 6)))
    batch = irbkin.IkBatch(np.empty((POSES, 8, 6)), np.empty((POSES, 8), np.uint8))
    product, fill = "A @ B, two 4x4 arrays", f"out.fill(0.0) of {POSES} answers"
    calls: dict[str, tuple[str, Callable[[], object], int]] = {
        product: (product, lambda: T @ T, 2000),
        "fk(q)": (product, lambda: robot.fk(q), 2000),
        "jacobian(q)": (product, lambda: robot.jacobian(q), 2000),
        "ik(T).q, 8 solutions": (product, lambda: robot.ik(T).q, 2000),
        "ik_nearest(T, q)": (product, lambda: robot.ik_nearest(T, q), 2000),
        fill: (fill, lambda: batch.q.fill(0.0), 1),
        "ik_batch, out=": (fill, lambda: robot.ik_batch(poses, out=batch), 1),
    }
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(ROUNDS):
        for name, (_, call, repeats) in calls.items():
            times[name].append(seconds(call, repeats))
    for name, (yardstick, _, _) in calls.items():
        ratio = statistics.median(a / b for a, b in zip(times[name], times[yardstick], strict=True))
        goal = f"  (goal {GOALS[name]:.0f} x)" if name in GOALS else ""
        print(f"{name:34} {statistics.median(times[name]) * 1e6:12.3f} us {ratio:8.2f} x  {yardstick}{goal}")
    code = "import numpy, time; start = time.perf_counter(); import irbkin; print(time.perf_counter() - start)"
    imports = [
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout) for _ in range(5)
    ]
    print(f"{'import irbkin, numpy loaded':34} {statistics.median(imports) * 1e6:12.0f} us           (goal 5000 us)")
    print(f"Goals of the Rust figures. {RUST_GOALS}")


if __name__ == "__main__":
    main()
