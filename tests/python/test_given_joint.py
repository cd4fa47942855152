"""Seven-axis arms with any one joint locked at an angle."""

import itertools
import pickle
import re

import irbkin
import numpy as np
import pytest
from seven_axis_arms import ARMS, fk

# Modified rows alpha [rad], a [m], d [m], theta [rad]. An arm like KUKA's iiwa, and one with no
# special relation between its axes.
QUARTER = np.pi / 2
IIWA = [
    [0, 0, 0.36, 0],
    [-QUARTER, 0, 0, 0],
    [QUARTER, 0, 0.42, 0],
    [QUARTER, 0, 0, 0],
    [-QUARTER, 0, 0.4, 0],
    [-QUARTER, 0, 0, 0],
    [QUARTER, 0, 0.126, 0],
]
OBLIQUE = [
    [0.0, 0.0, 0.31, 0.1],
    [-1.1, 0.07, 0.12, -0.4],
    [0.9, -0.05, 0.29, 0.3],
    [1.3, 0.09, 0.05, 0.0],
    [-0.8, 0.11, 0.33, 0.6],
    [1.2, 0.03, -0.04, -0.2],
    [-0.7, 0.06, 0.15, 0.5],
]
LIMITS = np.array([[-2.9, 2.9]] * 7)


@pytest.fixture(params=["Panda", "IRB 14050", "iiwa", "oblique", *ARMS], scope="module")
def robot(request):
    tables = {"iiwa": IIWA, "oblique": OBLIQUE}
    tool = irbkin.pose([0.02, -0.03, 0.11], euler_zyx=[0.2, -0.4, 0.9])
    base = irbkin.pose([0.4, 0.1, -0.2], euler_zyx=[-0.7, 0.3, 0.5])
    if request.param in tables:
        bare = irbkin.Robot.from_mdh(tables[request.param], limits=LIMITS, name=request.param)
    elif request.param in ARMS:
        bare = irbkin.Robot.from_urdf(ARMS[request.param].urdf(), name=request.param)
    else:
        bare = irbkin.Robot(request.param)
    return bare.with_tool(tool).with_base(base)


def inside(robot, count, seed=11):
    low, high = robot.limits.T
    return np.random.default_rng(seed).uniform(low, high, (count, 7))


def apart(a, b):
    return np.abs((np.asarray(a) - b + np.pi) % (2 * np.pi) - np.pi).max(axis=-1)


@pytest.mark.parametrize("name", ARMS)
def test_two_sources_describe_an_arm_alike(name):
    robot = irbkin.Robot.from_urdf(ARMS[name].urdf())
    # Up to the digits of a quarter turn in both: 4e-6 rad each.
    for q in np.random.default_rng(3).uniform(-np.pi, np.pi, (20, 7)):
        assert np.abs(robot.fk(q) - fk(ARMS[name], q)).max() < 3e-5


@pytest.mark.parametrize("joint", range(1, 8))
def test_the_joints_that_made_a_pose_are_found_whichever_is_given(robot, joint):
    """Or the answer says that it may be incomplete: of an iiwa, whose axes meet in threes."""
    if robot.name == "iiwa" and joint == 4:
        with pytest.raises(irbkin.InvalidModelError, match="are not independent"):
            robot.locked({4: 0.3})
        return
    found = 0
    for q in inside(robot, 12):
        solutions = robot.locked({joint: q[joint - 1]}).ik(robot.fk(q))
        assert (solutions.q[:, joint - 1] == q[joint - 1]).all()
        assert max((solution.residual for solution in solutions), default=0.0) < 1e-11
        if len(solutions) and apart(solutions.q, q).min() < 1e-6:
            assert solutions[int(apart(solutions.q, q).argmin())].is_within_limits
            found += 1
        else:
            assert not solutions.certified
    assert found >= (10 if robot.name == "iiwa" else 12)


def test_q7_has_an_angle_for_each_pose(robot):
    q = inside(robot, 20)
    T = robot.fk(q)
    batch = robot.ik_batch(T, q[:, 6])
    assert batch.q.shape == (20, 8 if robot.structure == "spherical shoulder" else 16, 7)
    found = np.nanmin(apart(batch.q, q[:, None]), axis=1)
    is_open = ((batch.status & irbkin.Status.UNCERTIFIED) != 0).all(axis=1)
    assert ((found < 1e-6) | is_open).all()
    assert (found < 1e-6).sum() >= (18 if robot.name == "iiwa" else 20)
    broken = q[:, 6].copy()
    broken[3] = np.nan
    rows = robot.ik_batch(T, broken)
    assert (rows.status[3] == int(irbkin.Status.INVALID)).all()
    assert np.isnan(rows.q[3]).all()
    assert (rows.status[4] == batch.status[4]).all()


def test_q7_is_joint_7_locked():
    panda = irbkin.Robot("Panda")
    T = panda.fk([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])
    one, other = panda.ik(T, q7=0.6), panda.locked({7: 0.6}).ik(T)
    assert len(one) == len(other) > 0
    for solution in one:
        assert apart(other.q, solution.q).min() < 1e-7


def test_a_locked_robot_answers_as_the_robot_does(robot):
    q = inside(robot, 5)
    T, given = robot.fk(q), {3: q[0, 2]}
    locked = robot.locked(given)
    assert locked.dof == 7
    assert locked != robot
    np.testing.assert_array_equal(locked.ik_batch(T[0]).q, locked.ik(T[0]).q_by_slot)
    nearest = locked.ik_nearest(T[0], q[0])
    assert np.abs(nearest - q[0]).max() < 1e-6
    np.testing.assert_array_equal(locked.ik_nearest(T[:1], q[0])[0], nearest)
    assert locked.check_pose(T[0]).within_limits
    six = locked.six_joints.ik(T[0])
    np.testing.assert_array_equal(np.insert(six.q, 2, q[0, 2], axis=1), locked.ik(T[0]).q)
    again = pickle.loads(pickle.dumps(locked))
    assert again == locked != robot
    assert hash(again) == hash(locked)
    tool = irbkin.pose([0.0, 0.0, 0.1])
    assert locked.with_tool(tool) == robot.with_tool(tool).locked(given)
    assert repr(locked) == f"{robot!r}.locked({{3: {float(q[0, 2])!r}}})"


def test_a_robot_with_another_joint_locked_releases_it_for_q7(robot):
    q = inside(robot, 1)[0]
    T = robot.fk(q)
    locked = robot.locked({3: q[2]})
    np.testing.assert_array_equal(locked.ik(T, q[6]).q, robot.ik(T, q[6]).q)
    for other in (locked, robot.locked({1: q[0]})):
        rows = other.ik_batch([T], q[6]).q
        np.testing.assert_array_equal(rows, robot.ik_batch([T], q[6]).q)
    assert locked.locked({2: q[1]}) == robot.locked({2: q[1]})


def test_a_path_is_followed_with_a_joint_given(robot):
    start = inside(robot, 1, seed=5)[0] * 0.5
    locked = robot.locked({3: start[2]})
    way = np.linspace(0, 0.05, 12)[:, None] * [1, -1, 0, 1, 1, -1, 1]
    T = robot.fk(start + way)
    followed = locked.follow(T, start)
    assert followed.q.shape == (12, 7)
    assert not followed.breaks
    assert np.abs(followed.q - (start + way)).max() < 1e-6


def test_the_nearest_along_the_redundancy_is_not_beaten_by_any_given_angle(robot):
    """A grid of angles of joint 7 finds nothing nearer, and the search finds something."""
    for q in inside(robot, 4, seed=3):
        T, seed = robot.fk(q), np.clip(q + 0.2, *robot.limits.T)
        nearest = robot.ik_nearest(T, seed)
        assert np.abs(robot.fk(nearest) - T).max() < 1e-8
        best = np.linalg.norm(nearest - seed)
        assert best <= np.linalg.norm(q - seed) + 1e-9
        for angle in np.linspace(*robot.limits[6], 60):
            inner = robot.ik(T, q7=angle).within_limits()
            if len(inner):
                assert best <= np.linalg.norm(inner.nearest(seed).q - seed) + 1e-6


def test_a_given_angle_outside_its_limits_leaves_no_solution_inside():
    panda = irbkin.Robot("Panda")
    q = np.array([0.1, -0.7, 3.0, -2.2, 0.1, 1.7, 0.6])
    T, locked = panda.fk(q), panda.locked({3: 3.0})
    solutions = locked.ik(T)
    assert len(solutions)
    assert not len(solutions.within_limits())
    assert "no solution inside the limits" in locked.check_pose(T).reason
    with pytest.raises(irbkin.UnreachableError, match="no solution inside the limits"):
        locked.ik_nearest(T, q)


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ({8: 0.2}, irbkin.InvalidJointsError, "given: there is no joint 8, it must be 1 to 7"),
        ({0: 0.2}, irbkin.InvalidJointsError, "given: there is no joint 0, it must be 1 to 7"),
        ({"q3": 0.2}, TypeError, "q3 is not the number of a joint, from 1"),
        ({True: 0.2}, TypeError, "True is not the number of a joint, from 1"),
        ({3: np.nan}, irbkin.InvalidJointsError, "joint 3 is NaN"),
        ({3: [0.1, 0.2]}, TypeError, "must be one real number"),
        ({1: 0.1, 3: 0.2}, ValueError, "given has 2 joints"),
        ({}, ValueError, "given has 0 joints"),
        (0.3, TypeError, "must map a joint, from 1, to its angle"),
    ],
)
def test_what_is_no_joint_is_refused_with_its_words(given, error, words):
    panda = irbkin.Robot("Panda")
    with pytest.raises(error, match=words):
        panda.locked(given)


def test_six_joints_take_nothing():
    with pytest.raises(TypeError, match="given is for arms of seven joints"):
        irbkin.Robot("UR3").locked({3: 0.2})
    assert irbkin.Robot("UR3").six_joints is None


@pytest.mark.parametrize("joint", [1, 7])
def test_a_joint_at_an_end_fills_the_same_slots_alone_and_in_rows(robot, joint):
    for q in inside(robot, 20, seed=5):
        T, locked = robot.fk(q), robot.locked({joint: q[joint - 1]})
        alone = locked.ik(T).q_by_slot
        for rows in (locked.ik_batch(T).q, locked.ik_batch([T]).q[0]):
            np.testing.assert_array_equal(rows, alone)
        if joint == 7:
            q7 = q[6]
            np.testing.assert_array_equal(robot.ik_batch(T, q7).q, robot.ik(T, q7).q_by_slot)


@pytest.mark.parametrize("joint", range(1, 8))
def test_another_angle_is_prepared_from_one_or_from_nothing_alike(robot, joint):
    if robot.name == "iiwa" and joint == 4:
        pytest.skip("the other six joints are not independent")
    for q in inside(robot, 5, seed=6):
        T, angle = robot.fk(q), q[joint - 1]
        fresh = robot.locked({joint: angle})
        moved = robot.locked({joint: 1.2}).locked({joint: angle})
        assert moved == fresh
        np.testing.assert_array_equal(moved.ik(T).q_by_slot, fresh.ik(T).q_by_slot)
        # Another robot, which has prepared nothing.
        again = pickle.loads(pickle.dumps(robot)).locked({joint: angle})
        np.testing.assert_array_equal(again.ik(T).q_by_slot, fresh.ik(T).q_by_slot)
        assert apart(fresh.ik(T).q, q).min() < 1e-6


def test_angles_at_which_the_six_joints_have_another_structure_or_none():
    yumi, panda = irbkin.Robot("IRB 14050"), irbkin.Robot("Panda")
    assert yumi.locked({3: 0.7}).six_joints.structure == "general"
    for robot, joint in itertools.product((yumi, panda), range(2, 7)):
        moved = robot.locked({joint: 0.7})
        for angle in np.radians([-180, -90, 0, 90, 180]):
            try:
                fresh = robot.locked({joint: angle})
            except irbkin.InvalidModelError as refused:
                with pytest.raises(irbkin.InvalidModelError, match=re.escape(str(refused))):
                    moved.locked({joint: angle})
                continue
            assert moved.locked({joint: angle}) == fresh
    with pytest.raises(irbkin.InvalidJointsError, match="joint 3 is NaN"):
        yumi.locked({3: 0.7}).locked({3: np.nan})


def test_slots_do_not_depend_on_whether_a_pose_is_a_row():
    robot = irbkin.Robot("IRB 14000-0.5/0.5 (left)")
    q = np.array(
        [
            -1.796795876136143,
            0.21686754447093204,
            0.4966708583483306,
            0.9978618712725247,
            1.8298147142471244,
            -0.5810295112785746,
            -np.pi / 2,
        ]
    )
    T, locked = robot.fk(q), robot.locked({1: q[0]})
    alone = locked.ik(T)
    assert len(alone) == 8
    np.testing.assert_array_equal(locked.ik_batch(T).q, alone.q_by_slot)


def test_an_angle_that_leaves_axes_nearly_parallel_is_refused_by_name():
    with pytest.raises(irbkin.InvalidModelError) as refusal:
        irbkin.Robot("IRB 14050").locked({4: np.pi / 2 + 1e-8})
    assert str(refusal.value) == (
        "joint 4 at 1.5707963367948965 rad leaves axes 3 and 5 1.0e-8 rad off parallel, they must "
        "be parallel or at least 8.1e-8 rad off"
    )
    irbkin.Robot("IRB 14050").locked({4: np.pi / 2 + 9e-8})
