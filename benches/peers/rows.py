"""The comparisons: which task, which arm, beside which yardstick; and the check that comes before
the clock.
"""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import motions
from .arms import IRB2600, PANDA, UR3, Arm, Floats
from .contenders import BUILDERS, OWN, Contender
from .contenders.contender import BATCHES, MOTIONS, Task
from .general_arms import CRX10IAL, GOFA5, MANSEUR_DOTY
from .measure import Effort, Timing, take_turns
from .recall import EXACT, branches_of, hits, residuals


@dataclass(frozen=True)
class Row:
    """A task of an arm; `still` are joints (from 0) that stay at zero."""

    title: str
    task: Task
    arm: Arm
    still: tuple[int, ...] = ()


ROWS = (
    Row("IK of one pose, every solution, IRB 2600", "ik", IRB2600),
    Row("IK of one pose, the solution nearest to a seed, IRB 2600", "ik_nearest", IRB2600),
    Row("FK of one joint vector, IRB 2600", "fk", IRB2600),
    Row("Jacobian of one joint vector, IRB 2600", "jacobian", IRB2600),
    Row("IK of a batch, every solution, IRB 2600", "ik_batch", IRB2600),
    Row("FK of a batch, IRB 2600", "fk_batch", IRB2600),
    Row("Jacobian of a batch, IRB 2600", "jacobian_batch", IRB2600),
    Row("IK of one pose, every solution, UR3", "ik", UR3),
    Row("IK of a batch, every solution, UR3", "ik_batch", UR3),
    Row("IK of one pose with q7 given, Panda", "ik", PANDA),
    Row("IK of a batch with q7 given, Panda", "ik_batch", PANDA),
    Row("IK of one pose, every solution, GoFa 5", "ik", GOFA5),
    Row("IK of one pose with axis 4 at zero, every solution, GoFa 5", "ik", GOFA5, (3,)),
    Row("IK of a batch, every solution, GoFa 5", "ik_batch", GOFA5),
    Row("IK of one pose, every solution, CRX-10iA/L", "ik", CRX10IAL),
    Row("IK of a batch, every solution, CRX-10iA/L", "ik_batch", CRX10IAL),
    Row("IK of one pose, every solution, Manseur and Doty's arm", "ik", MANSEUR_DOTY),
    Row("IK of a batch, every solution, Manseur and Doty's arm", "ik_batch", MANSEUR_DOTY),
    Row("Quintic of six joints, 50 samples", "quintic", IRB2600),
    Row("Quintic of six joints, 1,000 samples", "long_quintic", IRB2600),
    Row("Six joints from rest to rest within limits of jerk", "s_curve", IRB2600),
    Row("Line of the tool, 1,000 poses", "line", IRB2600),
    Row("That line followed, IRB 2600", "follow", IRB2600),
    Row("Path of 1,000 samples within limits of acceleration", "retime", IRB2600),
)
# How far from the joints a seed is drawn, in each joint [rad].
SEED_OFF = 0.05


@dataclass
class Result:
    """One row, measured.

    Attributes:
        row: The row.
        yardstick: Name of its yardstick.
        timings: Times by name; the yardstick's among them.
        checked: For each contender what the check says.
        remarks: For each contender that has one, its remark.
        absent: Who could not take part, and why.
    """

    row: Row
    yardstick: str
    timings: dict[str, Timing] = field(default_factory=dict)
    checked: dict[str, str] = field(default_factory=dict)
    remarks: dict[str, str] = field(default_factory=dict)
    absent: list[str] = field(default_factory=list)

    @property
    def own(self) -> str | None:
        """Name of irbkin's first contender, if it takes part."""
        return next((name for name in self.timings if name.split(",")[0] == OWN), None)


# By name of the arm: some packages prepare an arm for a minute.
_BUILT: dict[str, tuple[list[Contender], list[str]]] = {}


def gather(arm: Arm, missing: dict[str, str]) -> tuple[list[Contender], list[str]]:
    """All contenders for an arm, and who could not be built for it; packages that do not import go
    to `missing`.
    """
    if arm.name not in _BUILT:
        _BUILT[arm.name] = _gathered(arm, missing)
    contenders, absent = _BUILT[arm.name]
    return list(contenders), list(absent)


def _gathered(arm: Arm, missing: dict[str, str]) -> tuple[list[Contender], list[str]]:
    contenders, absent = [], []
    for package, builder in BUILDERS.items():
        if package in missing:
            continue
        try:
            contenders += builder(arm)
        except ImportError as error:
            missing[package] = str(error)
        except Exception as error:  # whatever a package raises, the others go on
            absent.append(excuse(package, error))
    return contenders, absent


def excuse(name: str, error: Exception) -> str:
    """A line about who does not take part."""
    words = "not yet" if name.split(",")[0] == OWN else "left out"
    message = str(error).splitlines()[0] if str(error) else "no message"
    return f"{name}: {words} ({type(error).__name__}: {message})"


def yardstick(row: Row) -> Contender:
    """The product of two 4x4 arrays, or filling the array of a batch's answers."""
    task, dof = row.task, row.arm.dof
    shapes: dict[Task, tuple[int, ...]] = {
        "ik_batch": (8 if row.arm.table is None else 16, dof),
        "fk_batch": (4, 4),
        "jacobian_batch": (6, dof),
    }
    if task in shapes:
        shape = shapes[task]
        return Contender(
            task,
            "out.fill(0.0)",
            lambda out: out.fill(0.0),
            lambda poses, joints: (np.empty((len(poses), *shape)),),
        )
    if task in MOTIONS:
        return Contender(task, "A @ B", operator.matmul, lambda poses, joints: (poses[0], poses[1]))
    return Contender(task, "A @ B", operator.matmul, lambda pose, joints: (pose, pose))


def check(row: Row, contender: Contender, poses: Floats, joints: Floats, seeds: Floats) -> str:
    """What the answers of a contender are worth, in words.

    Raises:
        ArithmeticError: It is too far off for its time to mean anything.
    """
    arm, task = row.arm, row.task
    if task in MOTIONS:
        return motions.check(contender)
    if task in ("fk", "jacobian", "fk_batch", "jacobian_batch"):
        truth = arm.fk(joints) if task.startswith("fk") else arm.jacobian(joints)
        if task in BATCHES:
            answers = contender.answer(poses, joints)
        else:
            answers = np.array(
                [contender.answer(*case) for case in zip(poses, joints, strict=True)]
            )
        error = float(np.abs(answers - truth).max())
        if not error <= contender.bound:
            raise ArithmeticError(f"off by {error:.1e}, allowed {contender.bound:.0e}")
        return f"error {error:.0e}"
    if task == "ik_batch":
        answers = list(contender.answer(poses, joints))
    else:
        second = seeds if task == "ik_nearest" else joints
        answers = [contender.answer(*case) for case in zip(poses, second, strict=True)]
    good, total, back = 0, 0, 0
    for answer, pose, q in zip(answers, poses, joints, strict=True):
        found = np.asarray(answer, dtype=float).reshape(-1, arm.dof)
        found = found[np.isfinite(found).all(axis=1)]
        exact = found[residuals(arm, found, pose) <= EXACT] if len(found) else found
        good += len(branches_of(arm, pose, exact)) if len(exact) else 0
        total += len(found)
        back += int(hits(arm, q[None], exact)[0])
    if total == 0 or good == 0:
        raise ArithmeticError("no answer meets its pose")
    if task == "ik_nearest":
        return f"nearest in {back} of {len(poses)}"
    return f"{good / len(poses):.2f} solutions a pose"


def run(row: Row, effort: Effort, missing: dict[str, str]) -> Result:
    """Check and time a row."""
    stick = yardstick(row)
    result = Result(row, stick.name)
    built, result.absent = gather(row.arm, missing)
    rng = np.random.default_rng(2)
    batch = row.task in BATCHES
    joints = row.arm.draw(rng, effort.batch if batch else effort.singles)
    joints[:, row.still] = 0.0
    poses, seeds = row.arm.fk(joints), joints + rng.uniform(-SEED_OFF, SEED_OFF, joints.shape)
    few = slice(0, effort.singles)
    taking_part = [stick]
    for contender in (each for each in built if each.task == row.task):
        try:
            result.checked[contender.name] = check(
                row, contender, poses[few], joints[few], seeds[few]
            )
        except Exception as error:  # whatever a package raises, the others go on
            result.absent.append(excuse(contender.name, error))
            continue
        taking_part.append(contender)
        if contender.remark:
            result.remarks[contender.name] = contender.remark
    second = seeds if row.task == "ik_nearest" else joints
    rounds = effort.batch_rounds if batch else effort.rounds
    cases: Sequence[tuple[Any, Any]] = (
        [(poses, joints)] if batch else list(zip(poses, second, strict=True))
    )
    if row.task in MOTIONS:
        cases = [motions.case(row.task)]
    count = len(poses) if batch else len(cases)
    result.timings = take_turns(taking_part, cases, rounds, effort.turn, count)
    return result
