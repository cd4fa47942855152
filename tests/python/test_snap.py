"""Right angles that were written with few digits are made exact: of a URDF where its digits allow
that, else where it is asked for, and the refusal says how.
"""

import pickle
import re
from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import InvalidModelError, Robot

DATA = Path(__file__).parents[1] / "data" / "few_digits"
# PUMA 560 as textbooks print it, standard rows: alpha, a, d, theta. Right angles with four
# decimals.
PUMA = [
    [1.5708, 0, 0.6718, 0],
    [0, 0.4318, 0, 0],
    [-1.5708, 0.0203, 0.15005, 0],
    [1.5708, 0, 0.4318, 0],
    [-1.5708, 0, 0, 0],
    [0, 0, 0, 0],
]


def test_a_table_is_accepted_with_the_proposed_snap():
    for build, rows in (
        (Robot.from_sdh, PUMA),
        (Robot.from_mdh, Robot.from_sdh(PUMA).mdh),
    ):
        told = str(build(rows))
        assert re.search(r"they are 0\.000210 deg off.*; snap=1e-5 would take it$", told)
        assert "snap=1e-5 would take it" in str(build(rows, snap=1e-6))
        robot = build(rows, snap=1e-5)
        assert robot.structure == "spherical wrist"
        text = build(rows)
        assert text.structure == "general"
        q = np.random.default_rng(3).uniform(-np.pi, np.pi, (500, 6))
        # Four right angles, each at most 1e-5 rad off; the arm is 1.6 m long.
        assert 0 < np.abs(robot.fk(q) - text.fk(q)).max() <= 4 * 1e-5 * 1.6
        poses = robot.fk(q)
        counts = []
        for pose, joints in zip(poses, q, strict=True):
            solutions = robot.ik(pose)
            assert max(solution.residual for solution in solutions) <= 1e-14
            difference = solutions.q - joints
            assert (
                np.abs(difference - 2 * np.pi * np.round(difference / 2 / np.pi)).max(axis=1).min()
                <= 1e-8
            )
            counts.append(len(solutions))
        assert counts.count(8) > 200
        assert pickle.loads(pickle.dumps(robot)) == robot
        assert pickle.loads(pickle.dumps(text)) == text


@pytest.mark.parametrize("snap", [-1e-9, 2e-3, np.nan, np.inf])
def test_a_snap_has_bounds(snap):
    for build in (
        lambda: Robot.from_mdh(PUMA, snap=snap),
        lambda: Robot.from_sdh(PUMA, snap=snap),
        lambda: Robot.from_urdf(DATA / "puma560.urdf", snap=snap),
    ):
        with pytest.raises(InvalidModelError, match=r"^snap is .* rad, it must be 0 to 1e-3 rad$"):
            build()


def test_a_snap_is_a_keyword_and_a_number():
    with pytest.raises(TypeError):
        Robot.from_mdh(PUMA, None, "", 1e-5)
    with pytest.raises(TypeError, match="must be real number, not str"):
        Robot.from_mdh(PUMA, snap="1e-5")


def test_an_exact_arm_is_the_same_with_any_snap():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    for snap in (0.0, 1e-9, 1e-3):
        np.testing.assert_array_equal(Robot.from_mdh(robot.mdh, snap=snap).mdh, robot.mdh)


def test_a_snap_that_gives_a_faster_structure_is_proposed_too():
    text = irbkin.Robot("CRB 15000-5/0.95").to_urdf()
    start, name, rest = text.partition('<joint name="joint_2"')
    rounded = start + name + rest.replace('rpy="0 0 0"', 'rpy="0.0002 0 0"', 1)
    robot = Robot.from_urdf(rounded)
    gives = "general (by rounded angles: snap=1e-3 gives offset wrist, moves the tool by up to "
    assert gives in repr(robot)
    assert Robot.from_urdf(rounded, snap=1e-3).structure == "offset wrist"


# The digits and signs of public files: of Doosan's, with two and three, and of UFACTORY's.
DOOSAN = [
    ("0 0 0.1525", "0 0 0"),
    ("0 0.006 0", "0 -1.571 -1.571"),
    ("0.411 0 0", "0 0 1.571"),
    ("0 -0.368 0", "1.571 0 0"),
    ("0 0 0", "-1.571 0 0"),
    ("0 -0.121 0", "1.571 0 0"),
]
XARM6 = [
    ("0 0 0.267", "0 0 0"),
    ("0 0 0", "-1.571 0 0"),
    ("0.053 -0.2845 0", "0 0 0"),
    ("0.0775 0.3425 0", "-1.571 0 0"),
    ("0 0 0", "1.571 0 0"),
    ("0.076 0.097 0", "-1.571 0 0"),
]


def urdf(origins, right_angle="1.571"):
    joints = "".join(
        f'<link name="{i}"/><joint name="j{i}" type="continuous"><parent link="{i - 1}"/>'
        f'<child link="{i}"/><origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="0 0 1"/></joint>'
        for i, (xyz, rpy) in enumerate(origins, 1)
    )
    return f'<robot name="own"><link name="0"/>{joints}</robot>'.replace("1.571", right_angle)


@pytest.mark.parametrize(
    ("text", "structure"),
    [
        (urdf(DOOSAN), "spherical wrist"),
        (urdf(DOOSAN, "1.57"), "spherical wrist"),
        (urdf(XARM6), "offset wrist"),
    ],
)
def test_a_file_with_three_digits_says_what_snap_gives_and_by_how_much_it_moves_the_tool(
    text, structure
):
    robot, snapped = Robot.from_urdf(text), Robot.from_urdf(text, snap=1e-3)
    found = re.search(r"snap=1e-3 gives (.*), moves the tool by up to (\S+) m\)", repr(robot))
    assert (robot.structure, snapped.structure) == ("general", structure)
    assert found[1] == structure
    q = np.random.default_rng(8).uniform(-np.pi, np.pi, (5000, 6))
    moved = np.linalg.norm((robot.fk(q) - snapped.fk(q))[:, :3, 3], axis=1).max()
    # Of 64 postures and of 5000, in two digits.
    assert 0.8 * moved < float(found[2]) < 1.05 * moved
    assert found[2] in str(robot)


def elbow(angle, scale=1.0):
    """XARM6's first joints with a spherical wrist, whose right angles are as given."""
    lengths = [("0 0 %g", 0.3), ("%g 0 0", 0.1), ("%g 0 0", 0.4), ("0 %g 0", 0.5)]
    places = [words % (scale * length) for words, length in lengths] + ["0 0 0"] * 2
    turns = [0, -1, 0, -1, 1, -1]
    origins = zip(places, turns, strict=True)
    return urdf(
        [(place, f"{'-' * (turn < 0)}{angle if turn else 0} 0 0") for place, turn in origins], angle
    )


Q = np.random.default_rng(9).uniform(-np.pi, np.pi, (2000, 6))
MOVES = re.compile(r"made exact, which moves the tool by up to (\S+) m, (\S+) rad \(snap=0 keeps")


@pytest.mark.parametrize(
    "angle",
    ["1.5708", "1.57080", "1.570796", "1.5707963", "1.57079633", "1.570796325", "1.57079629"],
)
def test_rounded_right_angles_of_a_file_are_made_exact(angle):
    text = elbow(angle)
    robot, kept, exact = (
        Robot.from_urdf(text),
        Robot.from_urdf(text, snap=0),
        Robot.from_urdf(elbow(repr(np.pi / 2))),
    )
    error = abs(float(angle) - np.pi / 2)
    assert (robot.structure, kept.structure) == ("spherical wrist", "general")
    np.testing.assert_array_equal(robot.mdh, exact.mdh)
    moves, turns = map(float, MOVES.search(repr(robot)).groups())
    assert "made exact" in str(robot)
    assert "made exact" not in repr(kept) + repr(exact)
    assert turns == pytest.approx(4 * error, rel=0.06)
    moved = np.linalg.norm((robot.fk(Q) - kept.fk(Q))[:, :3, 3], axis=1).max()
    # In two digits.
    assert 0 < moved < 1.05 * moves < 1e-4
    assert pickle.loads(pickle.dumps(robot)) == robot
    assert all(robot.ik(pose).certified for pose in robot.fk(Q[:200]))


@pytest.mark.parametrize(
    "angle",
    [
        "1.571",
        "1.57",
        "1.5707",
        "1.5709",
        "1.5690",
        "1.57079",
        "1.570797",
        "1.5708e0",
        "1.570796200000",
        "1.5707963000000",
    ],
)
def test_angles_that_the_digits_of_a_file_do_not_explain_are_kept(angle):
    text = elbow(angle)
    robot = Robot.from_urdf(text)
    assert robot.structure == "general"
    assert "right angles" not in repr(robot)
    np.testing.assert_array_equal(robot.mdh, Robot.from_urdf(text, snap=0).mdh)


def test_right_angles_that_would_move_the_tool_too_far_are_kept():
    text = elbow("1.5708", scale=40)
    robot = Robot.from_urdf(text)
    told = r"right angles kept: exact ones would move the tool by up to 1\.\de-4 m, 1\.5e-5 rad"
    assert re.search(told, repr(robot))
    assert robot.structure == "general"
    np.testing.assert_array_equal(robot.mdh, Robot.from_urdf(text, snap=0).mdh)
    asked = Robot.from_urdf(text, snap=1e-5)
    assert asked.structure == "spherical wrist"
    assert "right angles kept" not in repr(asked)


def test_a_written_robot_with_rounded_angles_is_read_as_it_is_with_a_snap_of_zero():
    robot = Robot.from_sdh(PUMA)
    text = robot.to_urdf()
    np.testing.assert_allclose(Robot.from_urdf(text, snap=0).fk(Q), robot.fk(Q), rtol=0, atol=1e-14)
    read = Robot.from_urdf(text)
    assert read.structure == "spherical wrist"
    moved = np.linalg.norm((read.fk(Q) - robot.fk(Q))[:, :3, 3], axis=1).max()
    assert 0 < moved < 1.05 * float(MOVES.search(repr(read))[1])
