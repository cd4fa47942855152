"""What each contender finds: solutions of poses that are known, counted and checked by this
harness's own kinematics.

The truth about a pose is what any contender found and NumPy's forward kinematics confirm, and the
joints that the pose was made from: no contender is the judge, and what all of them miss is not
seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arms import Arm, Floats
from .contenders import Contender

# A solution counts when it meets the pose to this [m, 1]: an arc cosine at its end loses half the
# digits, no more.
EXACT = 1e-6
# Two solutions are one branch when no joint of `Arm.branch` differs by more [rad].
SAME = 1e-4
# And the same answer twice when no joint at all differs by more [rad].
TWICE = 1e-6


@dataclass(frozen=True)
class PoseSet:
    """Poses to solve and the joints they were made from."""

    name: str
    poses: Floats
    joints: Floats


@dataclass
class Tally:
    """Counts of one contender over one set."""

    found: int = 0
    flagged: int = 0
    inexact: int = 0
    twice: int = 0
    worst: float = 0.0


@dataclass(frozen=True)
class Recall:
    """What was found of a set: how many solutions there are, and each contender's tally."""

    poses: PoseSet
    known: int
    tallies: dict[str, Tally]


def sets_of(arm: Arm, count: int, singular: int) -> list[PoseSet]:
    """Random poses; for an arm with a spherical wrist also the home pose and poses with axis 5 at
    zero, for one without a closed form poses with axis 4 at zero.
    """
    rng = np.random.default_rng(1)
    joints = {f"{count} random poses": arm.draw(rng, count)}
    if arm.opw:
        straight = arm.draw(rng, singular)
        straight[:, 4] = 0.0
        joints |= {"home pose": np.zeros((1, arm.dof)), f"{singular} poses, J5 = 0": straight}
    if arm.table is not None:
        straight = arm.draw(rng, singular)
        straight[:, 3] = 0.0
        joints[f"{singular} poses, J4 = 0"] = straight
    return [PoseSet(name, arm.fk(q), q) for name, q in joints.items()]


def apart(a: Floats, b: Floats) -> Floats:
    """Differences of joints, full turns not counted [rad]."""
    return np.asarray(np.abs((a - b + np.pi) % (2 * np.pi) - np.pi))


def residuals(arm: Arm, solutions: Floats, pose: Floats) -> Floats:
    """How far each solution is from the pose: largest difference of an element [m, 1]."""
    return np.asarray(np.abs(arm.fk(solutions) - pose).max(axis=(-2, -1)))


def distinct(solutions: Floats, joints: Sequence[int], bound: float) -> Floats:
    """The solutions without those that repeat an earlier one."""
    kept: list[Floats] = []
    for q in solutions:
        if all(apart(q[list(joints)], other[list(joints)]).max() > bound for other in kept):
            kept.append(q)
    return np.array(kept).reshape(len(kept), solutions.shape[-1])


def hits(arm: Arm, branches: Floats, solutions: Floats) -> NDArray[np.bool_]:
    """Which of the branches are among the solutions."""
    if len(solutions) == 0:
        return np.zeros(len(branches), dtype=bool)
    columns = list(arm.branch)
    differences = apart(branches[:, None, columns], solutions[None, :, columns]).max(axis=-1)
    return np.asarray((differences <= SAME).any(axis=1))


def branches_of(arm: Arm, pose: Floats, candidates: Floats) -> Floats:
    """The branches among candidates that meet the pose, the most accurate of each."""
    residual = residuals(arm, candidates, pose)
    order = np.argsort(residual, kind="stable")
    return distinct(candidates[order[residual[order] <= EXACT]], arm.branch, SAME)


def recall(arm: Arm, contenders: Sequence[Contender], poses: PoseSet) -> Recall:
    """Solve every pose with every contender and count."""
    tallies = {contender.name: Tally() for contender in contenders}
    known = 0
    for pose, joints in zip(poses.poses, poses.joints, strict=True):
        answers = {contender.name: contender.solutions(pose, joints) for contender in contenders}
        branches = branches_of(
            arm, pose, np.concatenate([joints[None], *(q for q, _ in answers.values())])
        )
        known += len(branches)
        for name, (solutions, flags) in answers.items():
            add(tallies[name], arm, pose, branches, solutions, flags)
    return Recall(poses, known, tallies)


def add(
    tally: Tally,
    arm: Arm,
    pose: Floats,
    branches: Floats,
    solutions: Floats,
    flags: NDArray[np.bool_],
) -> None:
    """Count the answer of one contender for one pose."""
    if len(solutions) == 0:
        return
    residual = residuals(arm, solutions, pose)
    exact = residual <= EXACT
    said = solutions[exact & ~flags]
    in_said = hits(arm, branches, said)
    tally.found += int(in_said.sum())
    tally.flagged += int((hits(arm, branches, solutions[exact & flags]) & ~in_said).sum())
    tally.inexact += int((~exact & ~flags).sum())
    tally.twice += len(said) - len(distinct(said, range(arm.dof), TWICE))
    tally.worst = max(tally.worst, float(residual[exact & ~flags].max(initial=0.0)))
