"""What bad input gets from arms without a closed form: the same words as from others."""

import irbkin
import numpy as np
import pytest
from general_arms import TABLES

ARMS = {
    "offset wrist": "GoFa 5",
    "general": "random 0",
}
Q = np.array([0.3, -0.5, 0.9, 1.3, -0.7, 0.2])


@pytest.fixture(params=ARMS, scope="module")
def robot(request):
    robot = irbkin.Robot.from_mdh(TABLES[ARMS[request.param]])
    assert robot.structure == request.param
    return robot


def spoiled(pose, i, j, value):
    pose = pose.copy()
    pose[i, j] = value
    return pose


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        ((0, 3), np.nan, "must be finite"),
        ((1, 1), np.inf, "must be finite"),
        ((3, 3), 2.0, r"row 3 must be \[0, 0, 0, 1\]"),
        ((0, 0), 3.0, "rotation"),
    ],
)
def test_what_is_no_pose_is_refused_alone_and_flagged_in_a_batch(robot, place, value, words):
    good = robot.fk(Q)
    bad = spoiled(good, *place, value)
    for call in (robot.ik, robot.check_pose, lambda pose: robot.ik_nearest(pose, Q)):
        with pytest.raises(irbkin.InvalidPoseError, match=words):
            call(bad)
    answer = robot.ik_batch(np.stack([good, bad, good]))
    assert (answer.status[1] == irbkin.Status.INVALID).all()
    assert np.isnan(answer.q[1]).all()
    assert np.array_equal(answer.q[0], answer.q[2], equal_nan=True)
    assert np.array_equal(answer.q[0], robot.ik(good).q_by_slot, equal_nan=True)


def test_a_mirrored_pose_is_refused(robot):
    mirrored = robot.fk(Q)
    mirrored[:3, 0] *= -1
    with pytest.raises(irbkin.InvalidPoseError, match="mirrors"):
        robot.ik(mirrored)


def test_an_empty_batch_is_empty(robot):
    answer = robot.ik_batch(np.zeros((0, 4, 4)))
    assert answer.q.shape == (0, 16, 6)
    assert answer.status.shape == (0, 16)


def test_an_empty_row_of_a_batch_says_whether_that_is_certain(robot):
    far = robot.fk(Q)
    far[:3, 3] += 20.0
    answer = robot.ik_batch(far[None])
    assert np.isnan(answer.q).all()
    assert (answer.status == 0).all()
    solutions = robot.ik(far)
    assert (len(solutions), solutions.certified) == (0, True)
    assert not robot.check_pose(far).reachable


@pytest.mark.parametrize("size", [1e3, 1e5])
def test_joints_of_many_turns_are_those_of_few(robot, size):
    turns = 2 * np.pi * np.round(size / 2 / np.pi) * np.array([1, -1, 1, -1, 1, -1])
    pose = robot.fk(Q + turns)
    # The angles are rounded where turns are added.
    off = (robot.ik(pose).q - Q + np.pi) % (2 * np.pi) - np.pi
    assert np.abs(off).max(axis=1).min() < 1e-11 + 20 * size * 2.0**-52


def test_a_seed_that_is_not_finite_or_too_large_is_refused(robot):
    for value, words in [(np.nan, "joint 2 is NaN"), (1e9, "joint 2 is 1e9")]:
        with pytest.raises(irbkin.InvalidJointsError, match=words):
            robot.ik_nearest(robot.fk(Q), spoiled(Q[None], 0, 1, value)[0])


def test_limits_that_leave_no_solution_are_told_with_the_joint(robot):
    pose = robot.fk(Q)
    narrow = robot.with_limits(np.column_stack([Q + 0.1, Q + 0.2]))
    solutions = narrow.ik(pose)
    assert len(solutions) == len(robot.ik(pose))
    assert len(solutions.within_limits()) == 0
    assert "outside limits; nearest: J" in solutions.explain()
    with pytest.raises(irbkin.UnreachableError, match="outside limits"):
        narrow.ik_nearest(pose, Q)
    # A point is a limit too.
    point = robot.with_limits(np.column_stack([Q, Q]))
    assert np.abs(point.ik_nearest(pose, Q) - Q).max() < 1e-9


FEWER = {
    "every a and d is zero": lambda rows: [[row[0], 0, 0, row[3]] for row in rows],
    "axes 1 and 2 are one line": lambda rows: [rows[0], [0, 0, *rows[1][2:]], *rows[2:]],
    "axes 5 and 6 are one line": lambda rows: [*rows[:5], [0, 0, *rows[5][2:]]],
    "axes 3 to 6 are parallel": lambda rows: [*rows[:3], *[[0, 0.2, *row[2:]] for row in rows[3:]]],
    "moves in": lambda rows: [[0.7, 0, 0, row[3]] if i < 5 else [0.7, 0, 0.2, 0]
                              for i, row in enumerate(rows)],
}  # fmt: skip


@pytest.mark.parametrize("words", FEWER)
def test_a_chain_with_fewer_than_six_freedoms_is_refused_with_the_reason(words):
    rows = FEWER[words](TABLES["random 0"].tolist())
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.Robot.from_mdh(rows)


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        ((2, 0), np.nan, "alpha of row 3 is NaN, it must be finite"),
        ((4, 2), np.inf, "d of row 5 is inf, it must be finite"),
        ((1, 1), 1e7, "a of row 2 is 1e7"),
    ],
)
def test_a_table_with_a_wrong_number_names_it(place, value, words):
    rows = TABLES["random 0"].copy()
    rows[place] = value
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.Robot.from_mdh(rows)


@pytest.mark.parametrize("zero", range(1, 6))
@pytest.mark.parametrize("column", [1, 2], ids=["a", "d"])
def test_one_length_may_be_zero(zero, column):
    rows = TABLES["random 0"].copy()
    rows[zero, column] = 0.0
    robot = irbkin.Robot.from_mdh(rows)
    found = 0
    for q in np.random.default_rng(zero).uniform(-np.pi, np.pi, (20, 6)):
        solutions = robot.ik(robot.fk(q))
        off = np.abs((solutions.q - q + np.pi) % (2 * np.pi) - np.pi).max(axis=1).min(initial=9.0)
        found += off < 1e-7
        assert off < 1e-7 or not solutions.certified
    assert found == 20
