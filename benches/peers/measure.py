"""Times of contenders that take turns: every round runs each of them once, and ratios are taken
within a round.
"""

from __future__ import annotations

import gc
import math
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from .arms import Floats
from .contenders import Contender


@dataclass(frozen=True)
class Effort:
    """How much is measured.

    Attributes:
        rounds: Turns that each contender gets.
        batch_rounds: The same for batches, whose turns are long.
        turn: Seconds of one turn, at least.
        singles: Poses that a single call is timed on, one after the other.
        batch: Poses of a batch.
        recall: Random poses whose solutions are counted.
        singular: Singular poses whose solutions are counted.
    """

    rounds: int = 21
    batch_rounds: int = 15
    turn: float = 0.01
    singles: int = 64
    batch: int = 100_000
    recall: int = 1000
    singular: int = 200


BRIEF = Effort(rounds=7, batch_rounds=5, turn=0.004, singles=16, batch=10_000)
QUICK = Effort(rounds=2, batch_rounds=2, turn=0.0, singles=2, batch=20, recall=3, singular=2)


@dataclass(frozen=True)
class Timing:
    """Seconds a pose of one contender, one figure a round."""

    rounds: list[float]

    @property
    def median(self) -> float:
        """Seconds a pose."""
        return statistics.median(self.rounds)

    def ratio(self, other: Timing) -> float:
        """Median over the rounds of this time over the other's in the same round."""
        return statistics.median(a / b for a, b in zip(self.rounds, other.rounds, strict=True))


def turn(call: Callable[..., Any], arguments: Sequence[tuple[Any, ...]], repeats: int) -> float:
    """Seconds of `repeats` runs over all arguments."""
    start = time.perf_counter()
    for _ in range(repeats):
        for each in arguments:
            call(*each)
    return time.perf_counter() - start


def take_turns(
    contenders: Sequence[Contender],
    cases: Sequence[tuple[Floats, Floats]],
    rounds: int,
    least: float,
    poses: int,
) -> dict[str, Timing]:
    """Time contenders on the same cases.

    Args:
        contenders: Who takes part.
        cases: Poses, or batches, with their joints.
        rounds: Turns of each.
        least: Seconds of a turn, at least.
        poses: How many poses the cases hold in all.

    Returns:
        For each name its times.
    """
    arguments = {
        each.name: [each.prepare(pose, joints) for pose, joints in cases] for each in contenders
    }
    repeats: dict[str, int] = {}
    for each in contenders:
        turn(each.call, arguments[each.name], 1)
        once = turn(each.call, arguments[each.name], 1)
        repeats[each.name] = max(1, math.ceil(least / once))
    times: dict[str, list[float]] = {each.name: [] for each in contenders}
    collecting = gc.isenabled()
    gc.disable()
    try:
        for number in range(rounds):
            # Who goes first changes, so that nobody always follows the same neighbor.
            first = number % len(contenders)
            for each in (*contenders[first:], *contenders[:first]):
                seconds = turn(each.call, arguments[each.name], repeats[each.name])
                times[each.name].append(seconds / repeats[each.name] / poses)
            gc.collect()
    finally:
        if collecting:
            gc.enable()
    return {name: Timing(rounds) for name, rounds in times.items()}
