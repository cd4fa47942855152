"""Inverse kinematics against complete solution sets and taught targets that others published."""

from collections import Counter

import irbkin
import numpy as np
import pytest
from arms import ABB, IRB1410, IRB2400, KUKA_KR6
from cases import RAX, XYZ, half_digit, numbers, pose_mm, read
from reference import apart, fk, pose_of, reach, reach_opw, rounding

Q = tuple(f"q{joint}" for joint in range(1, 7))
WXYZ = ("qw", "qx", "qy", "qz")
SETS = {"abb_irb2400_10_ik8.csv": IRB2400, "kuka_kr6_r700_sixx_ik8.csv": KUKA_KR6}
TARGETS = read("abb_robtargets_with_confdata.csv")
EDGE_DEG = 0.01


@pytest.mark.parametrize("name", SETS)
def test_published_sets_are_complete_and_nothing_is_added(name):
    robot, rows = irbkin.Robot.from_opw(**SETS[name]), read(name)
    exact = Counter()
    for row in rows:
        count = int(row["n_solutions"])
        fields = [[f"s{k}_{joint}" for joint in Q] for k in range(1, count + 1)]
        wanted = np.deg2rad([numbers(row, of_one) for of_one in fields])
        solutions = robot.ik(pose_mm(row, wxyz=WXYZ))
        # The text rounds the answer, and the pose, which the inverse of the Jacobian turns into
        # joints.
        pose_rounding = np.sqrt(3) * half_digit(row, XYZ) / 1e3 + 4 * half_digit(row, WXYZ)
        sigma = min(robot.singularity(solution.q).min_singular_value for solution in solutions)
        bound = (
            np.deg2rad(max(half_digit(row, of_one) for of_one in fields)) + pose_rounding / sigma
        )
        assert bound < 1e-7, "the row says too little: it would have to be left out by name"
        assert len(solutions) == count
        distances = apart(wanted[:, None], solutions.q[None])
        assert sorted(distances.argmin(axis=1)) == list(range(count)), (
            "one solution for each of the set"
        )
        assert distances.min(axis=1).max() <= bound
        exact[count] += 1
    # All 128 rows of each file were compared; none is at a singularity.
    assert (
        exact
        == {
            "abb_irb2400_10_ik8.csv": {8: 120, 4: 8},
            "kuka_kr6_r700_sixx_ik8.csv": {8: 110, 4: 18},
        }[name]
    )


@pytest.mark.parametrize("name", SETS)
def test_published_poses_are_met(name):
    opw = SETS[name]
    robot = irbkin.Robot.from_opw(**opw)
    for row in read(name):
        found, wanted = robot.fk(np.deg2rad(numbers(row, Q))), pose_mm(row, wxyz=WXYZ)
        bound = half_digit(row, XYZ) / 1e3 + rounding(reach_opw(opw))
        assert np.abs(found - wanted)[:3, 3].max() <= bound
        assert np.abs(found - wanted)[:3, :3].max() <= 8 * half_digit(row, WXYZ) + rounding(0)


def quarters(angle):
    """The quarter turns that an angle may be said to stand in: two within a hundredth of a degree
    of their edge.
    """
    return {int(np.floor((angle + nudge) / 90)) for nudge in (-EDGE_DEG, 0, EDGE_DEG)}


def stands_in(solution, row):
    """Whether a solution has the confdata of a row."""
    deg = np.rad2deg(solution.q)
    said = [int(row[field]) for field in ("cf1", "cf4", "cf6")]
    in_quarters = all(cf in quarters(deg[axis]) for cf, axis in zip(said, (0, 3, 5), strict=True))
    return in_quarters and solution.slot == int(row["cfx"])


def frame(row, name):
    """A tool or work object frame of a row [m]."""
    xyz, wxyz = (np.array(row[f"{name}_{part}"].split(), dtype=float) for part in ("pos", "quat"))
    return pose_of(xyz / 1e3, wxyz)


def robot_of(row):
    """The robot that a target was taught with, holding its tool."""
    shortened = {
        "IRB140": "IRB 140-6/0.81",
        "IRB120": "IRB 120-3/0.58",
        "IRB1200-5/0.9": "IRB 1200-5/0.9",
        "IRB2400": "IRB 2400-10/1.55",
    }
    robot = irbkin.Robot(shortened.get(row["robot"], row["robot"]))
    return robot.with_tool(frame(row, "tool"))


@pytest.mark.parametrize("row", TARGETS, ids=[f"{row['robot']} {row['name']}" for row in TARGETS])
def test_exactly_one_solution_has_the_taught_configuration(row):
    target = frame(row, "uframe") @ frame(row, "oframe") @ pose_mm(row)
    solutions = robot_of(row).ik(target)
    matching = [solution for solution in solutions.turns() if stands_in(solution, row)]
    assert len(matching) == 1
    derived = [f"{axis}_derived" for axis in RAX]
    # The text of a derived angle is rounded, its own computation to a hundredth of that.
    bound = np.deg2rad(1.01 * half_digit(row, derived))
    assert np.abs(matching[0].q - np.deg2rad(numbers(row, derived))).max() <= bound
    taught = [int(row[field]) for field in ("cf1", "cf4", "cf6", "cfx")]
    np.testing.assert_allclose(
        robot_of(row).ik_configured(target, taught), matching[0].q, rtol=0, atol=1e-12
    )


def test_every_taught_target_was_compared():
    assert len(TARGETS) == 23
    assert {int(row["cfx"]) for row in TARGETS} == {0, 1}


SINGLE_MOVES = [tuple((10 * row).tolist()) for row in np.eye(6, dtype=int)]


@pytest.mark.parametrize(
    "deg", [(0,) * 6, (90, 0, 0, 0, 0, 0), (0, 45, -30, 0, 0, 0), *SINGLE_MOVES], ids=str
)
def test_the_article_s_poses_round_trip_through_the_inverse(deg):
    """Its verification: FK of these, through IK, contains them. All but the move of axis 5 are
    wrist-singular.
    """
    rows, q = IRB1410.rows, np.deg2rad(deg)
    robot = irbkin.Robot.from_mdh(rows, limits=np.deg2rad(IRB1410.limits_deg), name=IRB1410.name)
    assert robot.structure == "spherical wrist"
    pose = robot.fk(q)
    np.testing.assert_allclose(pose, fk(rows, q), rtol=0, atol=rounding(reach(rows)))
    solutions = robot.ik(pose)
    assert all(solution.residual <= 1e-14 for solution in solutions)
    # A pose with q5 = 0 determines only q4 + q6: the representative has q4 = 0.
    given = q if deg[4] else [*q[:3], 0, 0, q[3] + q[5]]
    assert apart(solutions.q, given).min() <= 1e-9
    np.testing.assert_allclose(robot.ik_nearest(pose, seed=q), q, rtol=0, atol=1e-9)


def test_the_article_s_table_is_that_of_a_1410_with_abb_s_angles():
    robot = irbkin.Robot.from_mdh(IRB1410.rows)
    np.testing.assert_allclose(
        robot.fk(np.zeros(6))[:3, 3], [0.955, 0, 1.195], rtol=0, atol=rounding(2)
    )
    np.testing.assert_allclose(
        irbkin.Robot("IRB 1410-4/1.45").fk(np.zeros(6)),
        robot.fk(np.zeros(6)),
        rtol=0,
        atol=rounding(2),
    )
    assert "IRB 1600-6/1.45" in ABB
    assert not np.allclose(
        robot.fk(np.zeros(6)), irbkin.Robot("IRB 1600-6/1.45").fk(np.zeros(6)), atol=0.01
    )
