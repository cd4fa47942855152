"""How far motions exceed limits of velocity, acceleration and jerk: irbkin's, toppra's, and lines
sampled in time.

TRAJECTORIES random trajectories of irbkin (100,000), a tenth of them along paths; LINES random
lines of the tool (300) and as many random paths as a third of that, also for toppra, if it is
installed, and for samples in time as Pilz takes them. An excess is a part of the limit: 0.01 is
1 %; a negative one means that no limit is reached.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import NamedTuple

import irbkin
import numpy as np
import numpy.typing as npt
from irbkin import trajectory
from motion import installed, toppra_of

Floats = npt.NDArray[np.float64]

TRAJECTORIES = int(os.environ.get("TRAJECTORIES", "100000"))
LINES = int(os.environ.get("LINES", "300"))
ROBOT = irbkin.Robot("IRB 2600-12/1.65")
assert ROBOT.max_velocity is not None
VELOCITY, ACCELERATION, JERK = ROBOT.max_velocity, 5 * ROBOT.max_velocity, 100 * ROBOT.max_velocity
FINER = 10  # samples for each sample of a motion
# A line of the tool: its speed [m/s] and acceleration [m/s^2], and the time between samples [s].
TOOL_SPEED, TOOL_ACCELERATION, SAMPLING = 0.5, 2.0, 0.1
OVER = 0.001  # an excess that is counted


class Excess(NamedTuple):
    """How far each limit is exceeded, as a part of it; NaN where a motion has no such limit."""

    velocity: float
    acceleration: float
    jerk: float = np.nan


def of_states(dq: Floats, ddq: Floats) -> Excess:
    """The excess of samples."""
    return Excess(
        float((np.abs(dq) / VELOCITY).max()) - 1, float((np.abs(ddq) / ACCELERATION).max()) - 1
    )


def of_motion(move: irbkin.trajectory.Trajectory) -> Excess:
    """The excess of a trajectory: of its exact peaks and of ten times its samples."""
    peaks = move.peaks()
    fine = move.sample(np.linspace(0, move.duration, FINER * len(move)))
    sampled = of_states(fine.dq, fine.ddq)
    exact = of_states(peaks.velocity, peaks.acceleration)
    return Excess(
        max(sampled.velocity, exact.velocity),
        max(sampled.acceleration, exact.acceleration),
        float((peaks.jerk / JERK).max()) - 1,
    )


def row(name: str, excesses: list[Excess], limits: int, count: bool = False) -> None:
    """A row: the largest excess of the limits that hold, and how many motions exceed one."""
    worst = np.max(excesses, axis=0)
    cells = [f"{part:+.1e}" for part in worst[:limits]] + ["-"] * (3 - limits)
    over = sum(max(excess[:limits]) > OVER for excess in excesses)
    more = f" {over} |" if count else ""
    print(f"| {name} | {len(excesses):,} | {' | '.join(cells)} |{more}")


def moves(rng: np.random.Generator) -> None:
    """Profiles, splines and retimed paths of irbkin."""
    limits = {"max_velocity": VELOCITY, "max_acceleration": ACCELERATION, "max_jerk": JERK}
    paths = TRAJECTORIES // 20
    each = (TRAJECTORIES - 2 * paths) // 8
    print("| trajectories | number | velocity | acceleration | jerk |\n|---|---|---|---|---|")
    for profile, bound in (("quintic", 3), ("cubic", 2), ("trapezoid", 2), ("s_curve", 3)):
        for synchronization in ("time", "phase"):
            excesses = []
            for _ in range(each):
                # Long ways, short ways, and joints that stand still.
                ends = rng.uniform(-3, 3, (2, 6)) * 10.0 ** rng.uniform(-4, 0)
                ends[1] = np.where(rng.random(6) < 0.2, ends[0], ends[1])
                move = trajectory.joint(
                    *ends, profile=profile, synchronization=synchronization, **limits
                )
                excesses.append(of_motion(move))
            row(f"{profile}, by {synchronization}", excesses, bound)

    def waypoints() -> Floats:
        return rng.uniform(-2, 2, (int(rng.integers(2, 12)), 6)) * 10.0 ** rng.uniform(-2, 0)

    row(
        "quintic splines",
        [of_motion(trajectory.spline(waypoints(), **limits)) for _ in range(paths)],
        3,
    )
    row(
        "retimed random paths",
        [
            of_motion(trajectory.retime(waypoints(), VELOCITY, ACCELERATION, steps=100))
            for _ in range(paths)
        ],
        2,
    )


class Line(NamedTuple):
    """A line of the tool from a pose, with a turn about an axis of the tool."""

    start: Floats
    way: Floats
    axis: Floats
    angle: float
    seed: Floats

    def poses(self, s: Floats) -> Floats:
        """Poses at parts of the line, shape (m, 4, 4)."""
        x, y, z = self.axis
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        angles = (self.angle * s)[:, None, None]
        turns = np.eye(3) + np.sin(angles) * cross + (1 - np.cos(angles)) * cross @ cross
        poses = np.tile(self.start, (len(s), 1, 1))
        poses[:, :3, :3] = self.start[:3, :3] @ turns
        poses[:, :3, 3] += s[:, None] * self.way
        return poses

    def joints(self, s: Floats) -> Floats | None:
        """The joints there, or none if the arm cannot follow."""
        followed = ROBOT.follow(self.poses(s), self.seed)
        return None if followed.breaks else followed.q


def random_lines(rng: np.random.Generator, number: int) -> Iterator[Line]:
    """Lines of 0.2 to 0.8 m with turns up to 60 deg, which the arm can follow."""
    lower, upper = ROBOT.limits.T
    while number:
        seed = rng.uniform(0.7 * lower, 0.7 * upper)
        way, axis = rng.normal(size=(2, 3))
        way *= rng.uniform(0.2, 0.8) / np.linalg.norm(way)
        axis /= np.linalg.norm(axis)
        line = Line(ROBOT.fk(seed), way, axis, rng.uniform(0, np.pi / 3), seed)
        if line.joints(np.linspace(0, 1, 1000)) is not None:
            number -= 1
            yield line


def sampled_in_time(line: Line) -> tuple[Excess, Excess] | None:
    """The excess that samples in time show, by differences, and that of the line itself, ten times
    as densely; none if the arm cannot follow at these samples.
    """
    length = float(np.linalg.norm(line.way))
    pace = trajectory.joint(
        [0.0],
        [1.0],
        profile="trapezoid",
        max_velocity=TOOL_SPEED / length,
        max_acceleration=TOOL_ACCELERATION / length,
    )
    steps = int(np.ceil(pace.duration / SAMPLING))

    def by_differences(count: int) -> Excess | None:
        t = np.linspace(0, pace.duration, count + 1)
        q = line.joints(np.clip(pace.sample(t).q[:, 0], 0, 1))
        if q is None:
            return None
        dq = np.diff(q, axis=0) / (t[1] - t[0])
        # At rest before and after, as the controller is.
        ddq = np.diff(np.vstack([np.zeros(6), dq, np.zeros(6)]), axis=0) / (t[1] - t[0])
        return of_states(dq, ddq)

    seen, exact = by_differences(steps), by_differences(FINER * steps)
    return None if seen is None or exact is None else (seen, exact)


def compared(rng: np.random.Generator) -> None:
    """The same paths retimed by irbkin and toppra; lines sampled in time."""
    lines = list(random_lines(rng, LINES))
    third = max(LINES // 3, 1)
    along = [line.joints(np.linspace(0, 1, 200)) for line in lines]
    sets = {"lines of the tool": [q for q in along if q is not None][:third]}
    for count in (5, 20):
        sets[f"{count} random waypoints"] = [rng.uniform(-2, 2, (count, 6)) for _ in range(third)]
    toppra = installed("toppra")
    durations: dict[str, list[float]] = {}
    print(f"\n| retimed by | number | velocity | acceleration | jerk | over by {OVER:.1%} |")
    print("|---|---|---|---|---|---|")
    for name, paths in sets.items():
        own = [trajectory.retime(q, VELOCITY, ACCELERATION, steps=1000) for q in paths]
        row(f"irbkin, {name}", [of_motion(move) for move in own], 2, count=True)
        if toppra is None:
            continue
        for how, points in (("grid of 1,000", 1000), ("by default", None)):
            made = [toppra_of(q, VELOCITY, ACCELERATION, points)() for q in paths]
            theirs = [at_times(move) for move in made if move is not None]
            row(f"toppra {how}, {name}", theirs, 2, count=True)
            ratios = [
                mine.duration / other.duration
                for mine, other in zip(own, made, strict=True)
                if other is not None
            ]
            durations[f"{name}, toppra {how}"] = ratios
    print("\n| durations of irbkin over toppra's | number | median | largest |\n|---|---|---|---|")
    for name, ratios in durations.items():
        print(f"| {name} | {len(ratios)} | {np.median(ratios):.4f} | {max(ratios):.4f} |")
    pairs = [pair for pair in map(sampled_in_time, lines) if pair is not None]
    accepted = [pair for pair in pairs if max(pair[0][:2]) <= 0]
    print(
        f"\n{len(pairs)} lines at {TOOL_SPEED} m/s, sampled every {SAMPLING} s: "
        f"{len(pairs) - len(accepted)} are seen to exceed a limit, {len(accepted)} are not"
    )
    print(f"\n| lines in time | number | velocity | acceleration | jerk | over by {OVER:.1%} |")
    print("|---|---|---|---|---|---|")
    row("all, as their samples show", [seen for seen, _ in pairs], 2, count=True)
    row("all, ten times as dense", [exact for _, exact in pairs], 2, count=True)
    if accepted:
        row("those not seen, ten times as dense", [exact for _, exact in accepted], 2, count=True)


def at_times(move: Callable[..., Floats]) -> Excess:
    """The excess of a motion of toppra at ten times a thousand samples."""
    t = np.linspace(0, move.duration, FINER * 1000)  # type: ignore[attr-defined]
    return of_states(move(t, 1), move(t, 2))


def main() -> None:
    """Print the tables."""
    rng = np.random.default_rng(1)
    print("largest excess, as a part of the limit")
    moves(rng)
    compared(rng)


if __name__ == "__main__":
    main()
