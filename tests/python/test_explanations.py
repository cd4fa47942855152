"""Why there is no solution: reach, shortfall, limits, and the sentences that say so."""

import pickle

import irbkin
import numpy as np
import pytest
from arms import ABB
from irbkin import Reach, UnreachableError
from reference import move, turn


def at_distance(name, r, angle):
    """A pose whose wrist center is at distance `r` from the shoulder, `angle` above the horizontal,
    with the flange forward.
    """
    a1, _, height, _, _, flange = ABB[name].lengths
    return move(a1 + r * np.cos(angle) + flange, 0, height + r * np.sin(angle)) @ turn(
        "y", np.pi / 2
    )


def reaches(name):
    """Shortest and longest distance of the wrist center from the shoulder."""
    _, elbow, _, upper, forearm, _ = ABB[name].lengths
    k = np.hypot(elbow, forearm)
    return abs(upper - k), upper + k


def test_the_shortfall_is_known_but_where_a_pose_has_no_roots():
    far = irbkin.pose([5, 0, 0.5])
    assert irbkin.Robot("GoFa 5").ik(far).shortfall == pytest.approx(3.995, abs=1e-3)
    table = irbkin.Robot("UR5e").mdh.copy()
    table[:, 0] += 0.1
    solutions = irbkin.Robot.from_mdh(table).ik(far)
    assert solutions.reach is irbkin.Reach.NO_ROOTS
    assert np.isnan(solutions.shortfall)


@pytest.mark.parametrize("beyond", [1.1e-9, 1e-6, 0.012, 3.0])
@pytest.mark.parametrize("name", ABB)
def test_shortfall_is_the_distance_beyond_the_stretched_arm(name, beyond):
    robot = irbkin.Robot(name)
    solutions = robot.ik(at_distance(name, reaches(name)[1] + beyond, 0.3))
    assert (len(solutions), solutions.reach) == (0, Reach.TOO_FAR)
    assert solutions.shortfall == pytest.approx(beyond, abs=1e-14, rel=1e-14)
    assert not solutions.status.any()
    assert solutions.explain().endswith(" mm beyond reach")


@pytest.mark.parametrize("name", ABB)
def test_the_shortfall_is_that_of_the_nearer_side_of_axis_1(name):
    """Straight above axis 1 a pose is equally far for both; behind it, the arm that turned round is
    the nearer.
    """
    a1, _, height, *_, flange = ABB[name].lengths
    robot, longest = irbkin.Robot(name), reaches(name)[1]
    for x in (2.0, -2.0):
        pose = move(x + np.copysign(flange, x), 0, height + 3) @ turn(
            "y", np.copysign(np.pi / 2, x)
        )
        shortfall = np.hypot(abs(x) - a1, 3) - longest
        if shortfall > 0:
            assert robot.ik(pose).shortfall == pytest.approx(shortfall, abs=1e-14)


@pytest.mark.parametrize("inside", [1.1e-9, 1e-4])
@pytest.mark.parametrize("name", ABB)
def test_shortfall_is_the_distance_within_the_folded_arm(name, inside):
    shortest = reaches(name)[0]
    a1 = ABB[name].lengths[0]
    pose = at_distance(name, shortest - inside, 0.3)
    solutions = irbkin.Robot(name).ik(pose)
    if a1 == 0:
        assert solutions.reach is Reach.TOO_NEAR
        assert solutions.shortfall == pytest.approx(inside, abs=1e-14)
        assert solutions.explain().endswith(" mm too near to be reached")
    else:
        # The arm turned by 180 deg is 2 a1 farther away and reaches it.
        assert (len(solutions), solutions.reach) == (4, Reach.REACHED)
        assert all(solution.slot >= 4 for solution in solutions)


def test_sentences():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = np.deg2rad([10, -20, 30, 40, 50, 60])
    inside = len(robot.ik(robot.fk(q)).within_limits())
    assert robot.ik(robot.fk(q)).explain() == f"8 solutions, {inside} inside limits"
    longest = reaches(robot.name)[1]
    assert (
        robot.ik(at_distance(robot.name, longest + 0.012, 0.3)).explain()
        == "wrist center 12.0 mm beyond reach"
    )
    assert (
        robot.ik(at_distance(robot.name, longest + 2e-6, 0.3)).explain()
        == "wrist center 2.0e-3 mm beyond reach"
    )


def test_the_sentence_names_the_joint_that_is_outside_and_by_how_much():
    limits = np.deg2rad([[-180, 180]] * 6)
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = np.deg2rad([10, -20, 30, 40, 50, 60])
    # Axis 1 is 10 deg or -170 deg in every solution: limits from 13.1 deg on leave it outside by
    # 3.1 deg.
    limits[0] = np.deg2rad([13.1, 20])
    solutions = robot.with_limits(limits).ik(robot.fk(q))
    assert solutions.explain() == "all 8 outside limits; nearest: J1 by 3.1 deg"
    for choose in (solutions.nearest, solutions.least_motion):
        with pytest.raises(
            UnreachableError, match=r"all 8 outside limits; nearest: J1 by 3\.1 deg"
        ):
            choose(q)
    with pytest.raises(UnreachableError, match=r"J1 by 3\.1 deg"):
        robot.with_limits(limits).ik_nearest(robot.fk(q), q)
    assert solutions.within_limits().explain() == "all 8 outside limits; nearest: J1 by 3.1 deg"


def test_check_pose_answers_the_three_questions():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = np.deg2rad([10, -20, 30, 40, 50, 60])
    good = robot.check_pose(robot.fk(q))
    assert (good.reachable, good.within_limits) == (True, True)
    assert good.reason == robot.ik(robot.fk(q)).explain()
    limits = np.deg2rad([[13.1, 20], *[[-180, 180]] * 5])
    outside = robot.with_limits(limits).check_pose(robot.fk(q))
    assert (outside.reachable, outside.within_limits) == (True, False)
    assert outside.reason == "all 8 outside limits; nearest: J1 by 3.1 deg"
    far = robot.check_pose(move(9, 0, 0))
    assert (far.reachable, far.within_limits) == (False, False)
    assert far.reason.endswith(" mm beyond reach")


@pytest.mark.parametrize("name", ABB)
def test_a_pose_that_joints_inside_the_limits_make_is_within_limits(name):
    """Also where the pose leaves axis 4 free, and its limits or those of axis 6 leave little of the
    family.
    """
    rng = np.random.default_rng(1)
    for q in rng.uniform([-2, -0.4, -0.5, -2, 0.3, -2], [2, 0.6, 0.4, 2, 1.5, 2], (50, 6)):
        for q5 in (q[4], 0.0):
            q[4] = q5
            robot = irbkin.Robot(name).with_limits(
                np.column_stack([q - rng.uniform(0, 1, 6), q + rng.uniform(0, 1, 6)])
            )
            pose = robot.fk(q)
            assert robot.ik_nearest(pose, q) == pytest.approx(q, abs=1e-9)
            assert robot.check_pose(pose).within_limits


def test_an_unreachable_pose_reports_the_reason():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    with pytest.raises(UnreachableError, match=r"wrist center .* mm beyond reach"):
        robot.ik_nearest(move(9, 0, 0), np.zeros(6))
    with pytest.raises(IndexError, match=r"solution 0 of 0: wrist center .* mm beyond reach"):
        robot.ik(move(9, 0, 0))[0]
    assert robot.ik(move(9, 0, 0)).q.shape == (0, 6)
    assert list(robot.ik(move(9, 0, 0))) == []


def test_a_pose_at_a_limit_is_inside():
    """A target taught at the stop is not lost to rounding, one beyond it is not taken in."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    for off, inside in ((0.5e-9, True), (2e-9, False)):
        q = np.array([0.3, robot.limits[1, 1] + off, 0.2, 0.4, 0.5, 0.6])
        found = min(robot.ik(robot.fk(q)), key=lambda solution: np.abs(solution.q - q).max())
        assert found.is_within_limits is inside


@pytest.mark.parametrize("name", ["GoFa 5", "IRB 2600-12/1.65", "UR5e", "IRB 14050", "Panda"])
def test_how_far_a_joint_is_outside_is_counted_at_its_best_turn(name):
    robot = irbkin.Robot(name)
    limits = np.full((robot.dof, 2), [-np.pi, np.pi])
    limits[0] = np.radians([-150, -149.9])
    arm = robot.with_limits(limits)
    for q in np.random.default_rng(4).uniform(-1.2, 1.2, (12, robot.dof)):
        q[0] = np.radians(175)
        solutions = arm.ik(arm.fk(q), *q[6:])
        # Every joint but the first has a full turn.
        off = (solutions.q[:, 0] - limits[0].mean() + np.pi) % (2 * np.pi) - np.pi
        least = np.degrees(np.abs(off).min()) - 0.05
        words = f"all {len(solutions)} outside limits; nearest: J1 by {least:.1f} deg"
        assert solutions.explain() == words
        assert least <= 35.0 + 1e-9


def test_a_given_angle_is_outside_by_what_it_is():
    robot = irbkin.Robot("Panda")
    q = np.array([0.1, -0.3, 0.2, -1.8, 0.3, 1.9, 0.4])
    T = robot.fk(q)
    # A turn more, which is not the angle that was asked for, is inside.
    words = robot.ik(T, q7=q[6] + 2 * np.pi).explain()
    excess = np.degrees(q[6] + 2 * np.pi - robot.limits[6, 1])
    assert words.endswith(f"outside limits; nearest: J7 by {excess:.1f} deg")


def out_of_reach_of_a_yumi():
    """A YuMi and a pose 5 m away, whose nearest approach is that far at least less two arms."""
    robot = irbkin.Robot("IRB 14050")
    T = robot.fk(np.zeros(7))
    T[0, 3] += 5.0
    return robot, T


def approach_of(words):
    """The distance [mm] of the nearest approach that a sentence has."""
    return float(words.split("nearest approach ")[1].split(" mm")[0])


def test_a_seven_axis_arm_without_a_closed_form_says_how_near_it_gets():
    robot, T = out_of_reach_of_a_yumi()
    check = robot.check_pose(T)
    assert (check.reachable, check.within_limits) == (False, False)
    assert check.reason.startswith("no solution found, which is not certain: no closed form")
    rng = np.random.default_rng(3)
    q = rng.uniform(*robot.limits.T, (20000, 7))
    away = np.linalg.norm(robot.fk(q)[:, :3, 3] - T[:3, 3], axis=-1).min() * 1e3
    assert away - 300 < approach_of(check.reason) < away + 100
    for call in (
        lambda: robot.ik_nearest(T, np.zeros(7)),
        lambda: robot.ik_configured(T, (0, 0, 0, 0), arm_angle=0.1),
    ):
        with pytest.raises(UnreachableError, match="no solution found, which is not certain"):
            call()


def test_joint_7_inside_its_limits_that_reaches_nothing_is_no_filter():
    robot = irbkin.Robot("IRB 14050")
    limits = robot.limits.copy()
    limits[6] = [-0.1, 0.1]
    narrow = robot.with_limits(limits)
    # The arm all but stretched, joint 7 far from there.
    T = narrow.fk([-1.809, -1.733, -0.464, -1.122, 3.355, 0.647, -2.258])
    assert len(narrow.ik(T, q7=-2.258)) == 2
    reason = narrow.check_pose(T).reason
    assert reason.startswith("no solution found, which is not certain: no closed form; nearest")
    # With any joint 7 it would be 0 mm.
    assert 10.0 < approach_of(reason) < 100.0
    with pytest.raises(UnreachableError, match="no solution found, which is not certain"):
        narrow.ik_nearest(T, np.zeros(7))


@pytest.mark.parametrize("joint", range(1, 8))
def test_with_a_joint_given_the_nearest_approach_is_that_of_the_other_six(joint):
    robot, T = out_of_reach_of_a_yumi()
    locked = robot.locked({joint: 0.1})
    words = locked.six_joints.check_pose(T).reason
    assert "nearest approach" in words
    solutions = robot.ik(T, given={joint: 0.1})
    assert solutions.explain() == words
    assert locked.check_pose(T).reason == words
    assert locked.ik(T).explain() == words
    assert pickle.loads(pickle.dumps(solutions)) == solutions
    assert pickle.loads(pickle.dumps(solutions)).explain() == words


def test_an_arm_angle_is_no_joint():
    robot = irbkin.Robot("IRB 14050")
    T = robot.fk(np.full(7, 0.3))
    for angle, figure in ((np.nan, "NaN"), (np.inf, "inf"), (1e9, "1000000000")):
        words = f"arm_angle is {figure} rad, it must be finite and at most 1e5 rad in size"
        for call in (
            lambda angle=angle: robot.ik_configured(T, None, arm_angle=angle, every=True),
            lambda angle=angle: robot.ik_configured(T, (0, 0, 0, 0), arm_angle=angle),
        ):
            with pytest.raises(irbkin.InvalidJointsError) as refused:
                call()
            assert str(refused.value) == words


def test_a_seven_axis_arm_is_told_that_any_joint_may_be_given():
    robot = irbkin.Robot("IRB 14050")
    T = robot.fk(np.full(7, 0.3))
    for call in (robot.ik, robot.ik_batch):
        with pytest.raises(TypeError, match=r"needs q7, .*given=\{3: 0\.2\}"):
            call(T)
    with pytest.raises(irbkin.InvalidModelError, match=r"locked\(\{3: 0\.2\}\)\.follow"):
        robot.follow(T[None], np.zeros(7))
