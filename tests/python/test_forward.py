"""Forward kinematics, link frames and Jacobian."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG
from cases import read
from reference import (
    UNIT,
    fk,
    move,
    random_pose,
    reach,
    rounding,
    turn,
)

SAMPLES = 100
HAND = turn("z", -np.pi / 4) @ move(0, 0, 0.1034)  # Franka's, in its flange


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
    others = {
        name for name in irbkin.catalog() if name.startswith(("CRX", "IRB 140", "SO-101", "ViperX"))
    }
    assert set(irbkin.catalog()) == set(CATALOG) | posed | others
    assert len(others - set(CATALOG) - posed) == 7


def test_tables_are_the_golden_ones(arm, robot):
    np.testing.assert_allclose(robot.mdh, arm.rows, rtol=0, atol=8 * UNIT)
    np.testing.assert_array_equal(robot.flange, np.eye(4))


def test_fk_equals_the_reference(arm, robot):
    bound = rounding(reach(arm.rows))
    q = sample(arm)
    for pose, angles in zip(robot.fk(q), q, strict=True):
        np.testing.assert_allclose(pose, fk(arm.rows, angles), rtol=0, atol=bound)


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


@pytest.mark.parametrize(
    ("name", "degrees", "tool", "millimeters"),
    [
        # What UFACTORY's controller shows at zero, and Franka's where it is ready, with the hand.
        ("xArm6", [0, 0, 0, 0, 0, 0], np.eye(4), [207, 0, 112]),
        ("Panda", [0, -45, 0, -135, 0, 90, 45], HAND, [306.9, 0, 486.9]),
    ],
)
def test_poses_are_in_the_base_frame_of_the_controller(name, degrees, tool, millimeters):
    pose = irbkin.Robot(name).with_tool(tool).fk(np.radians(degrees))
    np.testing.assert_allclose(1e3 * pose[:3, 3], millimeters, rtol=0, atol=0.05)
    np.testing.assert_allclose(pose[:3, :3], np.diag([1, -1, -1]), rtol=0, atol=1e-12)
