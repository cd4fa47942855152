"""Many poses in one call: arrays in, arrays out, a status for every slot."""

import time
from collections.abc import Callable

import irbkin
import numpy as np

POSES = 20_000


def seconds(task: Callable[[], object]) -> float:
    """The best of five runs."""

    def once() -> float:
        start = time.perf_counter()
        task()
        return time.perf_counter() - start

    return min(once() for _ in range(5))


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65")
    # Joint vectors spread evenly over the limits: fractional parts of multiples of square roots.
    lower, upper = robot.limits.T
    q = lower + (upper - lower) * (
        np.arange(1.0, POSES + 1)[:, None] * np.sqrt([2.0, 3, 5, 7, 11, 13]) % 1
    )
    T = robot.fk(q)
    batch = robot.ik_batch(T)
    print(f"q {q.shape} -> T {T.shape} -> q {batch.q.shape}, status {batch.status.shape}")

    found = batch.status & irbkin.Status.FOUND != 0
    inside = batch.status & irbkin.Status.WITHIN_LIMITS != 0
    print(
        f"solutions: {found.sum()}, {found.sum() / POSES:.2f} a pose; "
        f"inside the limits: {inside.sum()}"
    )

    # The joints that made each pose are among its solutions, modulo 2 pi; empty slots are NaN.
    apart = np.abs((batch.q - q[:, None] + np.pi) % (2 * np.pi) - np.pi).max(axis=-1)
    print(f"poses whose own joints are missing: {(~(np.nanmin(apart, axis=1) < 1e-7)).sum()}")

    # An invalid row, and one out of reach, do not affect the others.
    T[1, 0, 0] = np.nan
    T[2, 0, 3] += 9.0
    again = robot.ik_batch(T, out=batch, threads=2)
    solutions = (again.status & irbkin.Status.FOUND != 0).sum(axis=1)
    invalid = (again.status & irbkin.Status.INVALID != 0).any(axis=1)
    for row in range(4):
        print(f"row {row}: {solutions[row]} solutions, {'invalid' if invalid[row] else 'valid'}")

    poses = robot.fk(q)
    one_call = seconds(lambda: robot.ik_batch(poses, out=batch))
    one_by_one = seconds(lambda: [robot.ik(pose) for pose in poses])
    forward = seconds(lambda: robot.fk(q, out=poses))
    print(f"\na batch takes {one_call / one_by_one:.2f} of the time of single calls,")
    print(f"eight solutions take {one_call / forward:.1f} times as long as forward kinematics")


if __name__ == "__main__":
    main()
