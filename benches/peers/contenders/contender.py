"""One way of doing one task: what is timed, and what is done before and after the clock."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..arms import Floats

Task = Literal[
    "ik",
    "ik_nearest",
    "fk",
    "jacobian",
    "ik_batch",
    "fk_batch",
    "jacobian_batch",
    "quintic",
    "long_quintic",
    "s_curve",
    "line",
    "follow",
    "retime",
]
BATCHES: tuple[Task, ...] = ("ik_batch", "fk_batch", "jacobian_batch")
MOTIONS: tuple[Task, ...] = ("quintic", "long_quintic", "s_curve", "line", "follow", "retime")


def from_pose(pose: Floats, joints: Floats) -> tuple[Any, ...]:
    """The pose alone."""
    return (pose,)


def from_joints(pose: Floats, joints: Floats) -> tuple[Any, ...]:
    """The joints alone."""
    return (joints,)


def from_both(pose: Floats, joints: Floats) -> tuple[Any, ...]:
    """The pose, and the joints: a seed, or what is free."""
    return (pose, joints)


def as_it_is(answer: Any) -> Any:
    """The answer, in the common form already."""
    return answer


@dataclass(frozen=True)
class Contender:
    """A call of a package, from arrays to an array.

    Attributes:
        task: What it does.
        name: Package, and which of its ways.
        call: What is timed.
        prepare: A pose (or a batch) and its joints to the arguments of `call`, not timed: frames
            are changed and the package's own layout is made here, in favor of the package.
        read: The answer of `call` to the common form, not timed: solutions (k, n), a pose (4, 4), a
            Jacobian (6, n) with linear rows first; of a batch of poses one (k, n) each; of motions
            what `motions.check` compares.
        flagged: Which of the solutions the package itself calls least squares: near the pose, not
        on it.
        bound: How far a pose or a Jacobian may be off [m, m/rad, 1].
        remark: What a reader must know to compare.
    """

    task: Task
    name: str
    call: Callable[..., Any]
    prepare: Callable[[Floats, Floats], tuple[Any, ...]]
    read: Callable[[Any], Any] = as_it_is
    flagged: Callable[..., NDArray[np.bool_]] | None = None
    bound: float = 1e-9
    remark: str = ""

    def answer(self, pose: Floats, joints: Floats) -> Any:
        """The answer in the common form."""
        return self.read(self.call(*self.prepare(pose, joints)))

    def solutions(self, pose: Floats, joints: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """The solutions of one pose, shape (k, n), and which of them are called least squares."""
        found = np.asarray(self.answer(pose, joints), dtype=float).reshape(-1, joints.shape[-1])
        flags = np.zeros(len(found), dtype=bool)
        if self.flagged is not None and len(found):
            flags = np.asarray(self.flagged(*self.prepare(pose, joints)), dtype=bool)
        known = np.isfinite(found).all(axis=1)
        return found[known], flags[known]
