"""Round trips on joints, poses, seeds and tables that Hypothesis draws, beside forward kinematics
in NumPy. `HYPOTHESIS_PROFILE=long` draws others, and sixteen times as many.
"""

from dataclasses import dataclass

import irbkin
import numpy as np
import pytest
from arms import CATALOG, GOFA, IRB2400, PANDA
from hypothesis import assume, given, reject
from hypothesis import strategies as st
from irbkin import Reach, SingularityKind
from reference import apart, fk, fk_opw, jacobian, reach, reach_opw, rounding
from strategies import joints, numbers, poses


@dataclass(frozen=True)
class Subject:
    """A robot, its forward kinematics in NumPy, a bound of its reach [m]."""

    robot: irbkin.Robot
    fk: object
    reach: float

    def pose(self, q):
        """The pose of a drawn joint vector, which both compute alike."""
        T = self.robot.fk(q)
        np.testing.assert_allclose(T, self.fk(q), rtol=0, atol=rounding(self.reach))
        return T

    def ik(self, T, q7):
        return self.robot.ik(T, q7) if self.robot.dof == 7 else self.robot.ik(T)

    def check_closure(self, every_q, T):
        """Every joint vector brings the tool to the pose, by NumPy's forward kinematics; a
        stretched arm, to a pose that is up to 1e-9 m beyond its reach.
        """
        for q in every_q:
            kinds = self.robot.singularity(q).kinds
            slack = 1e-9 if SingularityKind.ELBOW in kinds else 0.0
            atol = slack + 2 * rounding(self.reach)
            np.testing.assert_allclose(self.fk(q), T, rtol=0, atol=atol)

    def conditioning(self, q):
        """Least singular value of the Jacobian of the joints that are solved for [1]."""
        rows = np.array([[1 / self.reach]] * 3 + [[1]] * 3)
        return np.linalg.svd(jacobian(self.fk, q)[:, :6] * rows, compute_uv=False)[-1]

    def slack(self, q):
        """How far a solution may be from the joints that made the pose [rad]: what rounding does to
        the pose, divided by the conditioning; infinite where the second order counts, too.
        """
        conditioning = self.conditioning(q)
        rounded = 4 * rounding(self.reach) / min(self.reach, 1)
        return rounded / conditioning if conditioning**2 > 100 * rounded else np.inf


def of_rows(name, arm):
    return Subject(irbkin.Robot(name), lambda q: fk(arm.rows, q), reach(arm.rows))


def coupled(q):
    """An IRB 2400: axis 3 of the controller is measured from the base."""
    return fk_opw(IRB2400, q - [0, 0, q[1], 0, 0, 0])


SUBJECTS = {
    **{name: of_rows(name, CATALOG[name]) for name in ("IRB 1600-6/1.45", "IRB 2600-12/1.65")},
    "UR3": of_rows("UR3", CATALOG["UR3"]),
    "Panda": of_rows("Panda", PANDA),
    "IRB 2400-12/1.55": Subject(irbkin.Robot("IRB 2400-12/1.55"), coupled, reach_opw(IRB2400)),
    "GoFa 5": of_rows("GoFa 5", GOFA),
}
Q7 = st.floats(*SUBJECTS["Panda"].robot.limits[6])
every_arm = pytest.mark.parametrize("subject", SUBJECTS.values(), ids=SUBJECTS)


# Limits are inclusive, with this tolerance (docs/guide/conventions.md) [rad].
TOLERANCE = 1e-9
# What is inside by the one and not by the other may be taken for either.
SLACKS = (-TOLERANCE, 2 * TOLERANCE)


def is_inside(every_q, limits):
    low, high = limits.T
    return ((low - TOLERANCE <= every_q) & (every_q <= high + TOLERANCE)).all()


def turns_inside(q, limits, slack):
    """For each joint the 2 pi equivalents of its angle inside its limits, widened by `slack`."""
    low, high = limits.T
    first = np.ceil((low - slack - q) / (2 * np.pi))
    last = np.floor((high + slack - q) / (2 * np.pi))
    return [
        angle + 2 * np.pi * np.arange(begin, end + 1)
        for angle, begin, end in zip(q, first, last, strict=True)
    ]


def least_cost(every_q, limits, seed, weights, slack):
    """The cost of the nearest of all solutions with all turns, by trying them; infinite if none is
    inside the limits.
    """
    costs = [np.inf]
    for q in every_q:
        turns = turns_inside(q, limits, slack)
        if all(len(angles) for angles in turns):
            steps = [
                np.abs(angles - start).min() for angles, start in zip(turns, seed, strict=True)
            ]
            costs.append(cost(np.array(steps), weights))
    return min(costs)


def every_solution(robot, T):
    """Every solution of a pose; of seven joints, those at 61 angles of joint 7."""
    if robot.dof == 6:
        return robot.ik(T).q
    by_slot = robot.ik_batch(T, np.linspace(*robot.limits[6], 61)).q.reshape(-1, 7)
    return by_slot[np.isfinite(by_slot).all(axis=1)]


def cost(step, weights):
    return np.sqrt(np.sum(weights * step**2))


@every_arm
def test_ik_holds_the_joints_of_fk(subject):
    drawn, held = [], []

    @given(joints(subject.robot))
    def law(q):
        drawn.append(q)
        T = subject.pose(q)
        solutions = subject.ik(T, q[-1])
        subject.check_closure(solutions.q, T)
        assert len(solutions) > 0
        slack = subject.slack(q)
        if slack < np.inf:
            assert apart(solutions.q, q).min() <= slack
            held.append(q)

    law()
    assert len(held) > len(drawn) / 3


@every_arm
def test_every_solution_of_a_pose_closes(subject):
    reached, missed = [], []

    @given(poses(1.2 * subject.reach), Q7)
    def law(T, q7):
        solutions = subject.ik(T, q7)
        subject.check_closure(solutions.q, T)
        if len(solutions):
            assert solutions.reach is Reach.REACHED
            reached.append(T)
        else:
            assert solutions.reach is not Reach.REACHED
            assert not solutions.shortfall <= 0
            assert solutions.explain()
            missed.append(T)

    law()
    assert min(len(reached), len(missed)) > 10


@pytest.mark.parametrize("name", [name for name in SUBJECTS if name != "GoFa 5"])
def test_a_branch_keeps_its_slot_on_a_path_without_singularity(name):
    """A singular value changes by at most 6 for each radian: none vanishes within a thirtieth of
    the least. A GoFa's slots are ordinals.
    """
    subject, kept = SUBJECTS[name], []

    @given(joints(subject.robot), numbers(-1, 1, 6))
    def law(q, direction):
        conditioning = subject.conditioning(q)
        assume(conditioning > 1e-3 and np.linalg.norm(direction) > 0.1)
        ahead = q.copy()
        ahead[:6] += direction / np.linalg.norm(direction) * conditioning / 30
        slots = []
        for on_path in (q, ahead):
            by_slot = subject.ik(subject.robot.fk(on_path), q[-1]).q_by_slot
            distances = apart(by_slot, on_path)
            assert np.nanmin(distances) <= subject.slack(on_path)
            slots.append(int(np.nanargmin(distances)))
        assert slots[0] == slots[1]
        kept.append(slots[0])

    law()
    assert len(set(kept)) > 3


@every_arm
def test_the_nearest_is_nearest_by_brute_force(subject):
    """Of seven joints beside 61 angles of joint 7: at least as near."""
    robot, found = subject.robot, []

    @given(joints(robot), joints(robot), numbers(0.1, 4, robot.dof))
    def law(q, seed, weights):
        T = subject.pose(q)
        every_q = every_solution(robot, T)
        strict, loose = (
            least_cost(every_q, robot.limits, seed, weights, slack) for slack in SLACKS
        )
        try:
            nearest = robot.ik_nearest(T, seed, weights)
        except irbkin.UnreachableError:
            assert strict == np.inf
            return
        subject.check_closure([nearest], T)
        assert is_inside(nearest, robot.limits)
        slack = 1e-9 * (1 + cost(nearest - seed, weights))
        assert cost(nearest - seed, weights) <= strict + slack
        if robot.dof == 6 and not any(solution.free_joint for solution in robot.ik(T)):
            assert cost(nearest - seed, weights) >= loose - slack
        found.append(nearest)

    law()
    assert len(found) > 30


@every_arm
def test_turns_are_every_equivalent_inside_the_limits(subject):
    limits, most = subject.robot.limits, []

    @given(joints(subject.robot))
    def law(q):
        T = subject.pose(q)
        solutions = subject.ik(T, q[-1])
        turns = solutions.turns().q
        subject.check_closure(turns, T)
        assert is_inside(turns, limits)
        counts = [
            sum(
                np.prod([len(angles) for angles in turns_inside(solution, limits, slack)])
                for solution in solutions.q
            )
            for slack in SLACKS
        ]
        assert counts[0] <= len(turns) <= counts[1]
        assert len(np.unique(turns.round(6), axis=0)) == len(turns)
        most.append(len(turns))

    law()
    assert max(most) >= 4


@every_arm
def test_a_batch_equals_single_poses_to_the_bit(subject):
    robot = subject.robot

    @given(st.lists(st.one_of(joints(robot).map(robot.fk), poses(subject.reach)), min_size=1), Q7)
    def law(every_pose, q7):
        given_q7 = [q7] if robot.dof == 7 else []
        batch = robot.ik_batch(np.array(every_pose), *given_q7)
        singles = [subject.ik(T, q7) for T in every_pose]
        np.testing.assert_array_equal(batch.q, [single.q_by_slot for single in singles])
        np.testing.assert_array_equal(batch.status, [single.status for single in singles])

    law()


lengths = st.integers(-1000, 1000).map(lambda millimeters: millimeters / 1e3)
twists = st.one_of(
    st.sampled_from([0.0, np.pi / 2, -np.pi / 2]),
    st.integers(-179, 179).map(np.deg2rad),
)
tables = st.lists(st.tuples(twists, lengths, lengths, twists), min_size=6, max_size=6)


def test_certified_answers_of_any_table_hold_the_joints_of_fk():
    """A table whose joints do not move the tool in six ways is refused."""
    certified, uncertified = [], []

    @given(tables, numbers(-np.pi, np.pi, 6))
    def law(rows, q):
        rows = np.array(rows)
        try:
            robot = irbkin.Robot.from_mdh(rows)
        except irbkin.InvalidModelError:
            reject()
        subject = Subject(robot, lambda q: fk(rows, q), max(reach(rows), 0.1))
        T = subject.pose(q)
        solutions = robot.ik(T)
        subject.check_closure(solutions.q, T)
        slack = subject.slack(q)
        if solutions.certified and slack < np.inf:
            assert apart(solutions.q, q).min() <= slack
            certified.append(rows)
        else:
            uncertified.append(rows)

    law()
    assert len(certified) > len(uncertified)
