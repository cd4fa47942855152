"""Pinocchio and the Robotics Toolbox agree on poses and Jacobians."""

import irbkin
import numpy as np
import pinocchio
import pytest
import roboticstoolbox
import spatialmath
from arms import ABB, PANDA, ur_rows
from reference import link, move, reach, rounding, turn

ARMS = {arm.name: arm for arm in (ABB["IRB 2600-12/1.65"], PANDA)}
TOOL = move(0.1, -0.2, 0.3) @ turn("x", 0.7)
SAMPLES = 50


@pytest.fixture(params=ARMS, scope="module")
def arm(request):
    return ARMS[request.param]


@pytest.fixture(scope="module")
def robot(arm):
    return irbkin.Robot(arm.name).with_tool(TOOL)


@pytest.fixture(scope="module")
def bound(arm):
    """Three programs at most stand between two answers: two forward kinematics and a lever of the
    reach.
    """
    return rounding(reach(arm.rows) + 1)


def sample(arm):
    low, high = np.deg2rad(arm.limits_deg).T
    return np.random.default_rng(1).uniform(low, high, (SAMPLES, len(low)))


@pytest.fixture(scope="module")
def by_pinocchio(arm):
    """(Pose, Jacobian in the base frame, Jacobian in the tool frame) of a model built joint by
    joint.
    """
    model = pinocchio.Model()
    joint = 0
    for i, row in enumerate(arm.rows):
        placed = link(*row)
        placement = pinocchio.SE3(placed[:3, :3], placed[:3, 3])
        joint = model.addJoint(joint, pinocchio.JointModelRZ(), placement, f"axis {i + 1}")
    tool = pinocchio.SE3(TOOL[:3, :3], TOOL[:3, 3])
    frame = model.addFrame(pinocchio.Frame("tool", joint, 0, tool, pinocchio.FrameType.OP_FRAME))
    data = model.createData()

    def solve(q):
        pinocchio.framesForwardKinematics(model, data, q)
        jacobians = [
            pinocchio.computeFrameJacobian(model, data, q, frame, reference).copy()
            for reference in (pinocchio.LOCAL_WORLD_ALIGNED, pinocchio.LOCAL)
        ]
        return data.oMf[frame].homogeneous.copy(), *jacobians

    return solve


@pytest.fixture(scope="module")
def by_toolbox(arm):
    """The same of a chain of the toolbox's own modified rows."""
    links = [
        roboticstoolbox.RevoluteMDH(alpha=alpha, a=a, d=d, offset=theta)
        for alpha, a, d, theta in arm.rows
    ]
    chain = roboticstoolbox.DHRobot(links, tool=spatialmath.SE3(TOOL, check=False))
    return lambda q: (chain.fkine(q).A, chain.jacob0(q), chain.jacobe(q))


@pytest.mark.parametrize("oracle", ["by_pinocchio", "by_toolbox"])
def test_poses_and_jacobians_agree(arm, robot, bound, oracle, request):
    solve = request.getfixturevalue(oracle)
    for q in sample(arm):
        pose, in_base, in_tool = solve(q)
        np.testing.assert_allclose(robot.fk(q), pose, rtol=0, atol=bound)
        np.testing.assert_allclose(robot.jacobian(q), in_base, rtol=0, atol=2 * bound)
        np.testing.assert_allclose(robot.jacobian(q, frame="tool"), in_tool, rtol=0, atol=2 * bound)
        if robot.structure == "spherical wrist":
            for solution in robot.ik(pose):
                np.testing.assert_allclose(solve(solution.q)[0], pose, rtol=0, atol=2 * bound)


def test_a_standard_table_is_the_chain_of_the_toolbox():
    rows = ur_rows("ur3")
    chain = roboticstoolbox.DHRobot(
        [
            roboticstoolbox.RevoluteDH(alpha=alpha, a=a, d=d, offset=theta)
            for alpha, a, d, theta in rows
        ]
    )
    robot = irbkin.Robot.from_sdh(rows)
    bound = rounding(reach(rows))
    for q in np.random.default_rng(13).uniform(-3, 3, (SAMPLES, 6)):
        np.testing.assert_allclose(robot.fk(q), chain.fkine(q).A, rtol=0, atol=bound)
        np.testing.assert_allclose(robot.jacobian(q), chain.jacob0(q), rtol=0, atol=2 * bound)
