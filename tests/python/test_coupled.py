"""Arms with coupled axes 2 and 3 through Python."""

import pickle

import irbkin
import numpy as np
import pytest
from arms import IRB2400

LIMITS = np.deg2rad([(-180, 180), (-100, 110), (-60, 65), (-200, 200), (-120, 120), (-400, 400)])
ROBOT = irbkin.Robot.from_opw(**IRB2400, name="2400").coupled().with_limits(LIMITS)
LINKAGE = np.deg2rad((-100, 40))


def random_joints(count, seed=1):
    return np.random.default_rng(seed).uniform(*LIMITS.T, (count, 6))


def serial(q):
    return q - np.array([0, 0, 1, 0, 0, 0]) * q[..., 1:2]


def test_joints_are_the_controllers_and_the_twins_differ_by_axis_2():
    q = random_joints(200)
    twin = ROBOT.uncoupled()
    assert ROBOT.is_coupled
    assert not twin.is_coupled
    np.testing.assert_array_equal(ROBOT.fk(q), twin.fk(serial(q)))
    derivative = np.eye(6)
    derivative[2, 1] = -1
    np.testing.assert_allclose(
        ROBOT.jacobian(q), twin.jacobian(serial(q)) @ derivative, rtol=0, atol=1e-14
    )
    batch, single = ROBOT.ik_batch(ROBOT.fk(q)), twin.ik_batch(ROBOT.fk(q))
    apart = serial(batch.q) - single.q
    apart -= 2 * np.pi * np.round(apart / (2 * np.pi))
    assert np.nanmax(np.abs(apart)) < 1e-13
    np.testing.assert_array_equal(np.isnan(batch.q), np.isnan(single.q))
    assert twin.uncoupled() == twin
    assert ROBOT.coupled() == ROBOT


def test_the_linkage_has_limits_where_they_are_given():
    robot = ROBOT.with_linkage_limits(LINKAGE)
    assert ROBOT.linkage_limits is None
    np.testing.assert_array_equal(robot.linkage_limits, LINKAGE)
    np.testing.assert_array_equal(robot.with_limits(LIMITS * 0.9).linkage_limits, LINKAGE)
    assert robot.with_linkage_limits(None) == ROBOT
    q = np.deg2rad([10, -60, 20, 20, 30, 40])
    assert ROBOT.check_pose(ROBOT.fk(q)).within_limits
    check = robot.check_pose(robot.fk(q))
    assert (check.reachable, check.within_limits) == (True, False)
    np.testing.assert_array_equal(robot.uncoupled().limits[2], LINKAGE)
    with pytest.raises(irbkin.InvalidModelError, match="linkage limit is empty"):
        ROBOT.with_linkage_limits((1, 0))
    with pytest.raises(irbkin.InvalidModelError, match="no parallelogram linkage"):
        ROBOT.uncoupled().with_linkage_limits(LINKAGE)


@pytest.mark.parametrize(
    "robot",
    [ROBOT, ROBOT.with_linkage_limits(LINKAGE), ROBOT.uncoupled()],
    ids=["coupled", "linkage", "uncoupled"],
)
def test_the_coupling_belongs_to_the_value(robot):
    again = pickle.loads(pickle.dumps(robot))
    assert again == robot
    assert hash(again) == hash(robot)
    assert again.is_coupled == robot.is_coupled
    others = {ROBOT, ROBOT.with_linkage_limits(LINKAGE), ROBOT.uncoupled()} - {robot}
    assert len(others) == 2
    assert robot not in others


def test_a_coupled_arm_reports_its_coupling():
    named = irbkin.Robot("IRB 2400-10/1.55")
    assert repr(named) == 'Robot("IRB 2400-10/1.55")'
    assert repr(named.uncoupled()) == '<Robot "IRB 2400-10/1.55": 6 joints, spherical wrist>'
    twin = irbkin.Robot("IRB 2600-12/1.65").coupled()
    assert repr(twin) == '<Robot "IRB 2600-12/1.65": 6 joints, spherical wrist, coupled>'


def test_a_linkage_is_pickled():
    for limits in (LINKAGE, None):
        robot = ROBOT.with_linkage_limits(limits)
        again = pickle.loads(pickle.dumps(robot))
        assert again == robot
        np.testing.assert_array_equal(again.linkage_limits, robot.linkage_limits)


def test_configurations_do_not_count_the_slot():
    q = random_joints(300)
    assert not np.any(ROBOT.configuration(q).cfx)
    with pytest.raises(
        irbkin.InvalidJointsError,
        match="cfx is 1, it must be 0 for a robot with coupled axes 2 and 3",
    ):
        ROBOT.ik_configured(ROBOT.fk(q[0]), (0, 0, 0, 1))


def test_arms_that_cannot_have_a_linkage_are_refused():
    with pytest.raises(irbkin.InvalidModelError, match=r"90\.0 deg off parallel, at most 2\.9 deg"):
        irbkin.Robot("Panda").coupled()
    with pytest.raises(irbkin.InvalidModelError, match="measures joint 3 from the upper arm"):
        irbkin.Robot("GoFa 5").coupled()


FANUC = irbkin.Robot.from_opw(
    a1=0.05,
    a2=-0.035,
    b=0,
    c1=0.33,
    c2=0.33,
    c3=0.335,
    c4=0.08,
    offsets=[0, 0, -np.pi / 2, 0, 0, 0],
    signs=[1, 1, -1, -1, -1, -1],
    name="LR Mate 200iD",
).with_limits(np.deg2rad([[-170, 170], [-100, 145], [-70, 205], *[[-190, 190]] * 3]))


@pytest.mark.parametrize("robot", [irbkin.Robot("CRX-10iA"), FANUC], ids=["CRX", "LR Mate"])
def test_a_fanuc_pendant_measures_joint_3_from_the_base(robot):
    pendant = robot.coupled()
    q = np.array([0.1, 0.5467, -0.0352, 0.2, -1.1, 0.3])
    shown = np.array([0.1, 0.5467, -0.5819, 0.2, -1.1, 0.3])
    assert np.degrees(shown[2]) == pytest.approx(-33.342, abs=0.005)
    T = pendant.fk(shown)
    np.testing.assert_allclose(T, robot.fk(q), rtol=0, atol=1e-12)
    np.testing.assert_allclose(pendant.ik_nearest(T, shown), shown, rtol=0, atol=1e-9)
    derivative = np.eye(6)
    derivative[2, 1] = 1
    np.testing.assert_allclose(
        pendant.jacobian(shown), robot.jacobian(q) @ derivative, rtol=0, atol=1e-14
    )
    np.testing.assert_array_equal(pendant.linkage_limits, robot.limits[2])
    limits = pendant.limits.copy()
    limits[2] = [-0.5, 0.5]
    assert pendant.check_pose(T).within_limits
    assert not any(
        abs(s.q[2] + 0.5819) < 1e-6 for s in pendant.with_limits(limits).ik(T) if s.is_within_limits
    )
    narrow = pendant.with_linkage_limits((0.0, 1.0))
    assert not any(abs(s.q[2] + 0.5819) < 1e-6 for s in narrow.ik(T) if s.is_within_limits)
    for coupled in (pendant, narrow):
        again = pickle.loads(pickle.dumps(coupled))
        assert again == coupled
        assert again.is_coupled
        np.testing.assert_array_equal(again.linkage_limits, coupled.linkage_limits)


@pytest.mark.parametrize("robot", [irbkin.Robot("CRX-10iA"), FANUC], ids=["CRX", "LR Mate"])
def test_paths_follow_the_pendants_joints(robot):
    pendant = robot.coupled()
    q = np.linspace([0.1, 0.4, -0.3, 0.2, -1.1, 0.3], [0.4, 0.8, -0.6, 0.4, -0.9, 0.1], 60)
    T = pendant.fk(q)
    np.testing.assert_allclose(pendant.follow(T, q[0]).q, q, rtol=0, atol=1e-7)
    planned = pendant.plan(T, start=q[0])
    np.testing.assert_allclose(pendant.fk(planned.q), T, rtol=0, atol=1e-6)
    inside = [pendant.limits[:, 0] - 1e-9 <= row for row in planned.q]
    assert np.all(inside)
