"""Forward kinematics, link frames and Jacobian."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG, OPW, PANDA
from cases import read
from reference import (
    UNIT,
    fk,
    fk_opw,
    fk_sdh,
    frames,
    jacobian,
    move,
    random_pose,
    reach,
    reach_opw,
    rounding,
    turn,
)

SAMPLES = 100


def sample(arm, seed=1):
    """Joint vectors inside an arm's limits."""
    low, high = np.deg2rad(arm.limits_deg).T
    return np.random.default_rng(seed).uniform(low, high, (SAMPLES, len(low)))


@pytest.fixture(params=CATALOG, scope="module")
def arm(request):
    return CATALOG[request.param]


@pytest.fixture(scope="module")
def robot(arm):
    return irbkin.Robot(arm.name)


def test_every_catalog_arm_has_a_golden_table_or_pose():
    """The poses of the arms without a table here are checked in tests/catalog.rs."""
    posed = {row["robot"] for row in read("abb_catalog_poses.csv")}
    others = {name for name in irbkin.catalog() if name.startswith(("CRX", "IRB 140"))}
    assert set(irbkin.catalog()) == set(CATALOG) | posed | others
    assert len(others - set(CATALOG) - posed) == 5


def test_tables_are_the_golden_ones(arm, robot):
    np.testing.assert_allclose(robot.mdh, arm.rows, rtol=0, atol=8 * UNIT)
    np.testing.assert_array_equal(robot.flange, np.eye(4))


def test_fk_equals_the_reference(arm, robot):
    bound = rounding(reach(arm.rows))
    q = sample(arm)
    for pose, angles in zip(robot.fk(q), q, strict=True):
        np.testing.assert_allclose(pose, fk(arm.rows, angles), rtol=0, atol=bound)


@pytest.mark.parametrize("opw", OPW.values(), ids=OPW)
def test_fk_of_parameters_equals_the_reference(opw):
    robot = irbkin.Robot.from_opw(**opw)
    for q in np.random.default_rng(8).uniform(-4, 4, (SAMPLES, 6)):
        wanted = fk_opw(opw, q)
        np.testing.assert_allclose(robot.fk(q), wanted, rtol=0, atol=rounding(reach_opw(opw)))
        # The table that the robot shows is a table of the same arm, once the flange behind it is
        # added.
        np.testing.assert_allclose(
            fk(robot.mdh, q) @ robot.flange, wanted, rtol=0, atol=rounding(reach_opw(opw))
        )


def test_link_frames_equal_the_reference_and_end_in_the_tool(arm, robot):
    bound = rounding(reach(arm.rows) + 3)
    rng = np.random.default_rng(2)
    base, tool = random_pose(rng), random_pose(rng)
    moved = robot.with_base(base).with_tool(tool)
    q = sample(arm)
    for angles, found in zip(q, moved.link_frames(q), strict=True):
        wanted = base @ frames(arm.rows, angles)
        np.testing.assert_allclose(found[:-1], wanted, rtol=0, atol=bound)
        np.testing.assert_allclose(found[-1], wanted[-1] @ tool, rtol=0, atol=bound)
    np.testing.assert_array_equal(moved.link_frames(q)[:, -1], moved.fk(q))


def test_base_and_tool_are_outside_the_chain(arm, robot):
    rng = np.random.default_rng(3)
    base, tool = random_pose(rng), random_pose(rng)
    bound = rounding(reach(arm.rows) + 3)
    for q in sample(arm):
        wanted = base @ fk(arm.rows, q) @ tool
        np.testing.assert_allclose(
            robot.with_base(base).with_tool(tool).fk(q), wanted, rtol=0, atol=bound
        )


def test_a_new_base_or_tool_replaces_the_old_one():
    rng = np.random.default_rng(4)
    base, tool = random_pose(rng), random_pose(rng)
    robot = irbkin.Robot("IRB 2600-12/1.65")
    twice = (
        robot.with_base(random_pose(rng))
        .with_tool(random_pose(rng))
        .with_base(base)
        .with_tool(tool)
    )
    assert twice == robot.with_base(base).with_tool(tool)
    np.testing.assert_allclose(twice.base, base, rtol=0, atol=4 * UNIT)
    np.testing.assert_allclose(twice.tool, tool, rtol=0, atol=4 * UNIT)


@pytest.mark.parametrize("name", ABB)
def test_the_standard_table_of_an_arm_gives_the_same_poses(name):
    rows = ABB[name].rows
    # The twist and length of a modified row stand before its joint, those of a standard row behind
    # it.
    standard = np.column_stack([np.append(rows[1:, :2], [[0, 0]], axis=0), rows[:, 2:]])
    robot, same = irbkin.Robot(name), irbkin.Robot.from_sdh(standard)
    assert same.structure == "spherical wrist"
    for q in sample(ABB[name]):
        np.testing.assert_allclose(same.fk(q), robot.fk(q), rtol=0, atol=rounding(reach(rows)))
        np.testing.assert_allclose(
            same.fk(q), fk_sdh(standard, q), rtol=0, atol=rounding(reach(rows))
        )


def test_a_standard_table_keeps_the_transform_after_its_last_joint():
    rng = np.random.default_rng(5)
    rows = rng.uniform(-1, 1, (7, 4))
    robot = irbkin.Robot.from_sdh(rows)
    for q in rng.uniform(-3, 3, (20, 7)):
        np.testing.assert_allclose(robot.fk(q), fk_sdh(rows, q), rtol=0, atol=rounding(reach(rows)))


def test_jacobian_matches_central_differences(arm, robot):
    rng = np.random.default_rng(6)
    base, tool = random_pose(rng), random_pose(rng)
    moved = robot.with_base(base).with_tool(tool)
    bound = 2 * rounding(reach(arm.rows) + 3)
    for q in sample(arm)[:20]:
        by_hand = jacobian(lambda angles: base @ fk(arm.rows, angles) @ tool, q)
        np.testing.assert_allclose(moved.jacobian(q), by_hand, rtol=0, atol=bound)
        to_tool = np.kron(np.eye(2), (base @ fk(arm.rows, q) @ tool)[:3, :3].T)
        np.testing.assert_allclose(
            moved.jacobian(q, frame="tool"), to_tool @ by_hand, rtol=0, atol=4 * bound
        )


def test_batches_of_any_shape_equal_single_calls(arm, robot):
    q = sample(arm)[:24].reshape(2, 3, 4, -1)
    for method in (robot.fk, robot.link_frames, robot.jacobian):
        answers = method(q)
        assert answers.shape[:3] == (2, 3, 4)
        for index in np.ndindex(2, 3, 4):
            np.testing.assert_array_equal(answers[index], method(q[index]))


def test_out_gets_the_result_and_is_returned(robot, arm):
    q = sample(arm)
    for method, tail in ((robot.fk, (4, 4)), (robot.jacobian, (6, robot.dof))):
        out = np.empty((SAMPLES, *tail))
        assert method(q, out=out) is out
        np.testing.assert_array_equal(out, method(q))


def test_zero_pose_looks_forward_with_x_down():
    """ABB's tool0 at zero: z forward, x down."""
    for name, arm in ABB.items():
        a1, elbow, height, upper, forearm, flange = arm.lengths
        wanted = move(a1 + forearm + flange, 0, height + upper + elbow) @ turn("y", np.pi / 2)
        np.testing.assert_allclose(
            irbkin.Robot(name).fk([0] * 6), wanted, rtol=0, atol=rounding(reach(arm.rows))
        )


def test_positive_angles_turn_as_abb_arms_do():
    """Axis 1 to the left, axes 2, 3 and 5 downwards at zero, axes 4 and 6 clockwise seen along the
    flange.
    """
    axes = [irbkin.Robot("IRB 2600-12/1.65").jacobian([0] * 6)[3:, i] for i in range(6)]
    wanted = [(0, 0, 1), (0, 1, 0), (0, 1, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0)]
    np.testing.assert_allclose(axes, wanted, rtol=0, atol=16 * UNIT)


def test_panda_at_zero_is_as_high_as_its_drawing():
    robot = irbkin.Robot("Panda")
    assert (robot.dof, robot.structure, robot.jacobian(np.zeros(7)).shape) == (
        7,
        "spherical shoulder",
        (6, 7),
    )
    assert robot.fk(np.zeros(7))[2, 3] == pytest.approx(
        0.333 + 0.316 + 0.384 - 0.107, abs=rounding(reach(PANDA.rows))
    )
