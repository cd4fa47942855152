"""Forward kinematics against poses that others published or recorded."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG, COMAU_NJ165, IRB2400
from cases import RAX, XYZ, half_digit, matrix, numbers, pose_mm, read
from reference import move, pose_of, reach, rotation_apart, rounding, turn

QUATERNION = ("q1_w", "q2_x", "q3_y", "q4_z")


def ids(rows, *fields):
    return [" ".join(row[field] for field in fields) for row in rows]


PAIRS = read("abb_fk_pairs.csv")
IRB6640 = read("abb_irb6640_fk.csv")
COMAU = read("comau_opw_fk.csv")
UR = read("ur_fk_pairs.csv")
PANDAS = read("panda_fk_pairs.csv")


@pytest.mark.parametrize("row", PAIRS, ids=ids(PAIRS, "robot", "rax_2"))
def test_published_pairs_are_met_to_a_hundredth(row):
    robot = (
        irbkin.Robot.from_opw(**IRB2400)
        if row["robot"].startswith("IRB 2400")
        else irbkin.Robot(row["robot"])
    )
    found, wanted = robot.fk(np.deg2rad(numbers(row, RAX))), pose_mm(row)
    assert np.linalg.norm(found[:3, 3] - wanted[:3, 3]) <= 1e-5
    assert np.rad2deg(rotation_apart(found, wanted)) <= 0.01


@pytest.mark.parametrize("row", IRB6640, ids=ids(IRB6640, "rax_1"))
def test_a_6640_agrees_with_every_printed_digit(row):
    arm = ABB["IRB 6640-235/2.55"]
    found, wanted = irbkin.Robot(arm.name).fk(np.deg2rad(numbers(row, RAX))), pose_mm(row)
    # Six joints of a rounded text turn the arm, and the pose itself is rounded.
    turned = 6 * np.deg2rad(half_digit(row, RAX)) + rounding(reach(arm.rows))
    assert (
        np.abs(found[:3, 3] - wanted[:3, 3]).max()
        <= turned * reach(arm.rows) + half_digit(row, XYZ) / 1e3
    )
    assert rotation_apart(found, wanted) <= turned + 4 * half_digit(row, QUATERNION)


@pytest.mark.parametrize(
    ("name", "x", "z"),
    [
        ("IRB 120-3/0.58", 364.353829, 594),
        ("IRB 140-6/0.81", 506.291651, 679.5),
        ("IRB 1200-5/0.9", 522.014083, 848.1),
        ("IRB 2600-12/1.85", 1018.612159, 1417.5),
    ],
)
def test_robotstudio_home_poses(name, x, z):
    found = irbkin.Robot(name).fk(np.deg2rad([0, 0, 0, 0, 30, 0]))
    wanted = pose_of([x / 1e3, 0, z / 1e3], [0.5, 0, 0.866025404, 0])
    assert np.abs(found[:3, 3] - wanted[:3, 3]).max() <= 0.5e-9 + rounding(reach(ABB[name].rows))
    assert rotation_apart(found, wanted) <= 4 * 0.5e-9


@pytest.mark.parametrize("row", COMAU, ids=ids(COMAU, "q1", "q2"))
def test_joint_signs_of_a_comau(row):
    found = irbkin.Robot.from_opw(**COMAU_NJ165).fk(
        np.deg2rad(numbers(row, [f"q{i}" for i in range(1, 7)]))
    )
    assert np.abs(found[:3, 3] - numbers(row, XYZ) / 1e3).max() <= 0.5e-6 + rounding(4)


@pytest.mark.parametrize("row", UR, ids=ids(UR, "robot", "q3"))
def test_universal_robots_in_the_frames_of_their_sources(row):
    robot = irbkin.Robot(row["robot"])
    if row["base_frame"] == "base_link":
        robot = robot.with_base(turn("z", np.pi))
    if row["tip_frame"] == "ee_link":
        tip = np.eye(4)
        tip[:3, :3] = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]]).T
        robot = robot.with_tool(tip)
    found, wanted = robot.fk(numbers(row, [f"q{i}" for i in range(1, 7)])), matrix(row)
    exact = row["kind"] == "exact"
    assert np.linalg.norm(found[:3, 3] - wanted[:3, 3]) <= (1e-12 if exact else 3e-3)
    assert rotation_apart(found, wanted) <= (1e-12 if exact else 1e-2)


@pytest.mark.parametrize("row", PANDAS, ids=ids(PANDAS, "tip_frame"))
def test_panda_poses(row):
    robot = irbkin.Robot("Panda")
    if row["tip_frame"] == "link7":
        robot = robot.with_tool(move(0, 0, -0.107))
    found, wanted = robot.fk(numbers(row, [f"q{i}" for i in range(1, 8)])), matrix(row)
    tolerance = float(row["tolerance"].removesuffix(" m"))
    np.testing.assert_allclose(found, wanted, rtol=0, atol=tolerance)


def test_closed_form_of_a_2600():
    """The flange position of an IRB 2600-12/1.65, expanded by hand; theta 2 = q2 - 90 deg,
    millimeters.
    """
    robot = irbkin.Robot("IRB 2600-12/1.65")
    low, high = robot.limits.T
    for q in np.random.default_rng(7).uniform(low, high, (100, 6)):
        theta_2 = q[1] - np.pi / 2
        s1, c1, s2, c2 = np.sin(q[0]), np.cos(q[0]), np.sin(theta_2), np.cos(theta_2)
        s23, c23 = np.sin(theta_2 + q[2]), np.cos(theta_2 + q[2])
        s4, c4, s5, c5 = np.sin(q[3]), np.cos(q[3]), np.sin(q[4]), np.cos(q[4])
        k = -s23 * (85 * c5 + 795) + 115 * c23 + 700 * c2 + 150
        wanted = [
            c1 * k - 85 * s5 * (c1 * c23 * c4 + s1 * s4),
            s1 * k - 85 * s5 * (s1 * c23 * c4 - c1 * s4),
            85 * s23 * c4 * s5 - c23 * (85 * c5 + 795) - 115 * s23 - 700 * s2 + 445,
        ]
        np.testing.assert_allclose(
            robot.fk(q)[:3, 3], np.array(wanted) / 1e3, rtol=0, atol=rounding(3)
        )


def test_no_row_is_left_out():
    """Every arm that the tables name was built, none was skipped."""
    assert {row["robot"] for row in PAIRS} - {"IRB 2400-10/1.55"} <= set(CATALOG)
    assert [len(rows) for rows in (PAIRS, IRB6640, COMAU, UR, PANDAS)] == [4, 4, 3, 4, 2]
