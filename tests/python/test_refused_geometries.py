"""Geometries that have no closed form: `str(robot)` names the axes and the figure."""

import pickle
import re

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG, GOFA_ROWS_MM_DEG, ur_rows
from reference import fk, reach


def changed(row, column, value):
    """The table of an IRB 2600 with one number changed."""
    rows = ABB["IRB 2600-12/1.65"].rows.copy()
    rows[row, column] += value
    return rows


DEG = np.deg2rad(1)
REFUSED = {
    "axes 1 and 2 must be at right angles, they are 10.000000 deg off": changed(1, 0, 10 * DEG),
    "axes 2 and 3 must be parallel, they are 1.000000 deg off": changed(2, 0, DEG),
    "axes 3 and 4 must be at right angles, they are 0.500000 deg off": changed(3, 0, -0.5 * DEG),
    "axes 4 and 5 must be at right angles, they are 2.000000 deg off": changed(4, 0, 2 * DEG),
    "axes 5 and 6 must be at right angles, they are 45.000000 deg off": changed(5, 0, 45 * DEG),
    "axes 4 and 5 must meet, they pass 5.000000 mm apart": changed(4, 1, 0.005),
    "axes 5 and 6 must meet, they pass 10.000000 mm apart": changed(5, 1, -0.01),
    "axes 4 and 6 must meet, they pass 7.000000 mm apart": changed(4, 2, 0.007),
}


@pytest.mark.parametrize("message", REFUSED)
def test_what_is_missing_names_the_axes_and_the_figure(message):
    robot = irbkin.Robot.from_mdh(REFUSED[message])
    assert robot.structure in ("general", "offset wrist")
    assert message in str(robot)
    assert str(robot).count("axes") == 1
    assert (
        str(robot).splitlines()[1].startswith("for a spherical wrist on an ortho-parallel base, ")
    )


def test_what_is_missing_names_every_condition():
    rows = changed(2, 0, DEG)
    rows[5, 1] = 0.01
    missing = str(irbkin.Robot.from_mdh(rows))
    assert re.search(r"axes 2 and 3 must be parallel.*; axes 5 and 6 must meet", missing)


def gofa_rows():
    rows = np.array(GOFA_ROWS_MM_DEG, dtype=float)
    return np.column_stack([np.deg2rad(rows[:, 0]), rows[:, 1:3] / 1e3, np.deg2rad(rows[:, 3])])


def tilted_ur5e():
    rows = ur_rows("ur5e")
    rows[2, 0] += np.deg2rad(1)
    return rows


# Arms that engineers have and that are of other forms: (how to build, structure, what is said).
OTHERS = {
    "GoFa": (
        lambda **more: irbkin.Robot.from_mdh(gofa_rows(), **more),
        "offset wrist",
        r"axes 5 and 6 must meet, they pass 80\.000000 mm apart",
    ),
    "UR5e with axis 4 tilted": (
        lambda **more: irbkin.Robot.from_sdh(tilted_ur5e(), **more),
        "offset wrist",
        r"for three parallel axes, axes 3 and 4 must be parallel, they are 1\.000000 deg off",
    ),
}


@pytest.mark.parametrize("name", OTHERS)
def test_an_arm_without_closed_form_is_solved_in_general(name):
    build, structure, words = OTHERS[name]
    robot = build(name="mine")
    assert (robot.structure, robot.name, robot.dof) == (structure, "mine", 6)
    assert re.search(words, str(robot))
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (50, 6))
    for joints, pose in zip(q, robot.fk(q), strict=True):
        solutions = robot.ik(pose)
        assert solutions.certified
        assert solutions.q_by_slot.shape == (16, 6)
        assert max(solution.residual for solution in solutions) <= 1e-13
        off = solutions.q - joints
        off -= 2 * np.pi * np.round(off / 2 / np.pi)
        assert np.abs(off).max(axis=1).min() < 1e-9
        assert np.abs(robot.ik_nearest(pose, joints) - joints).max() < 1e-9
        assert robot.check_pose(pose).reachable
    batch = robot.ik_batch(robot.fk(q))
    assert batch.q.shape == (50, 16, 6)
    assert not (batch.status & irbkin.Status.UNCERTIFIED).any()


@pytest.mark.parametrize("name", OTHERS)
def test_an_offset_wrist_out_of_reach_says_by_how_much(name):
    robot = OTHERS[name][0]()
    far = np.eye(4)
    far[0, 3] = 9.0
    solutions = robot.ik(far)
    assert len(solutions) == 0
    assert solutions.certified
    assert solutions.reach is irbkin.Reach.TOO_FAR
    assert 7.0 < solutions.shortfall < 9.0
    assert not robot.check_pose(far).reachable


def test_a_general_arm_out_of_reach_says_so():
    rows = gofa_rows()
    rows[2, 0] = 0.02
    robot = irbkin.Robot.from_mdh(rows)
    assert robot.structure == "general"
    far = np.eye(4)
    far[0, 3] = 9.0
    solutions = robot.ik(far)
    assert len(solutions) == 0
    assert solutions.certified
    assert solutions.reach is irbkin.Reach.NO_ROOTS
    assert np.isnan(solutions.shortfall)
    words = r"out of reach: no closed form; 0 real roots; nearest approach (.+) mm and (.+) deg"
    nearest = re.fullmatch(words, solutions.explain())
    # The arm with its lengths in a line toward the pose, turned as the lengths are worth.
    assert 9000 - 1390 < float(nearest[1]) < 9000
    assert 0 <= float(nearest[2]) < 180
    assert robot.check_pose(far).reason == solutions.explain()
    assert not robot.check_pose(far).reachable
    with pytest.raises(irbkin.UnreachableError, match="0 real roots"):
        robot.ik_nearest(far, np.zeros(6))
    assert pickle.loads(pickle.dumps(solutions)).explain() == solutions.explain()


def test_a_certain_answer_is_told_from_another():
    # The CRX-10iA/L at multiples of 90 deg: joints move with the tool standing still.
    turn = np.pi / 2
    rows = [[0, 0, 0.245, 0], [-turn, 0, 0, -turn], [0, 0.71, 0, 0], [-turn, 0, 0.54, 0]]
    robot = irbkin.Robot.from_mdh([*rows, [turn, 0, 0.15, 0], [-turn, 0, 0.16, 0]])
    pose = robot.fk(np.array([0.0, 0.0, turn, turn, 0.0, 0.0]))
    solutions = robot.ik(pose)
    uncertified = (robot.ik_batch(pose).status & irbkin.Status.UNCERTIFIED) != 0
    assert solutions.certified is not bool(uncertified.all())
    assert uncertified.all() == uncertified.any()
    assert pickle.loads(pickle.dumps(solutions)).certified == solutions.certified


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({(4, 0): 0.0}, "axes 4 and 5 are one line, so that the flange moves in 5 independent"),
        ({(3, 0): 0.0, (4, 0): 0.0, (4, 1): 0.1}, "axes 2 to 5 are parallel, so that"),
    ],
)
def test_joints_that_are_not_independent_are_refused(change, words):
    rows = gofa_rows()
    for at, value in change.items():
        rows[at] = value
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.Robot.from_mdh(rows)


def test_a_seven_axis_arm_says_that_it_has_no_closed_form():
    robot = irbkin.Robot.from_mdh(CATALOG["Panda"].rows + 1e-3)
    assert (
        "spherical shoulder and an offset elbow, axes 1 and 2 must be at right angles, they are "
        "0.057296 deg" in str(robot)
    )
    q = np.array([0.1, 0.2, 0.3, -1.4, 0.5, 1.6, 0.7])
    solutions = robot.ik(robot.fk(q), q7=q[6])
    assert np.abs(solutions.q - q).max(axis=1).min() < 1e-8


@pytest.mark.parametrize(("off", "taken"), [(5e-10, True), (2e-9, False)])
def test_a_table_in_text_is_made_exact(off, taken):
    rows = changed(5, 1, off)
    rows[2, 0] += off
    if taken:
        robot = irbkin.Robot.from_mdh(rows)
        q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
        assert max(solution.residual for solution in robot.ik(robot.fk(q))) <= 1e-14
        assert np.abs(robot.fk(q) - fk(rows, q)).max() <= 2 * off * reach(rows)
    else:
        assert "axes 5 and 6 must meet" in str(irbkin.Robot.from_mdh(rows))


@pytest.mark.parametrize("row", [2, 3], ids=["upper arm", "forearm"])
def test_a_link_without_length_is_told(row):
    rows = ABB["IRB 140-6/0.81"].rows.copy()
    rows[row, 1:3] = 0
    words = r"(upper arm|forearm) .*is 0 m, it must be at least 1e-6 m"
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.Robot.from_mdh(rows)
