"""A path followed pose by pose."""

import time

import irbkin
import numpy as np
import pytest
from irbkin.records import Break, BreakReason

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
Q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "UR5e", "GoFa 5", "Panda", "locked"])
def test_a_follower_takes_the_steps_of_follow(name):
    robot = irbkin.Robot("Panda" if name == "locked" else name)
    if name == "locked":
        robot = robot.locked({3: 0.2})
    seed = robot.limits.mean(axis=1) + 0.3
    if name == "locked":
        seed[2] = 0.2
    path = robot.fk(seed + np.linspace(0.0, 0.2, 30)[:, None] * (seed != 0.2))
    followed = robot.follow(path, seed)
    assert not followed.breaks
    follower = irbkin.Follower(robot, seed)
    np.testing.assert_array_equal(follower.q, seed)
    q = np.stack([follower.step(pose) for pose in path])
    np.testing.assert_allclose(q, followed.q, atol=1e-9)
    np.testing.assert_array_equal(follower.q, q[-1])
    assert follower.last_break is None


def test_weights_choose_as_they_do_of_follow():
    robot, weights = irbkin.Robot("Panda"), [9.0, 1.0, 1.0, 1.0, 1.0, 1.0, 5.0]
    seed = robot.random(rng=4)
    path = robot.fk(seed + np.linspace(0.0, 0.2, 9)[:, None])
    follower = irbkin.Follower(robot, seed, weights)
    q = [follower.step(pose) for pose in path]
    np.testing.assert_array_equal(q, robot.follow(path, seed, weights).q)


def test_a_step_out_of_reach_is_an_error_and_the_next_one_starts_anew():
    follower = irbkin.Follower(ROBOT, Q)
    pose = ROBOT.fk(Q)
    follower.step(pose)
    far = pose.copy()
    far[0, 3] += 9.0
    with pytest.raises(irbkin.UnreachableError, match="beyond reach") as caught:
        follower.step(far)
    last = follower.last_break
    assert isinstance(last, Break)
    assert (last.pose_index, last.kind) == (1, BreakReason.UNREACHABLE)
    assert str(caught.value) in last.reason
    np.testing.assert_allclose(follower.q, Q, atol=1e-9)
    np.testing.assert_allclose(follower.step(pose), Q, atol=1e-9)
    assert follower.last_break is None


def test_a_jump_is_reported_as_follow_reports_it():
    # J4 reaches its limit: the way goes on upon another branch.
    upper = ROBOT.limits[3, 1]
    q = np.tile(Q, (60, 1))
    q[:, 3] = np.linspace(upper - 0.3, upper + 0.3, 60)
    path = ROBOT.fk(q)
    followed = ROBOT.follow(path, q[0])
    assert followed.breaks
    follower, breaks = irbkin.Follower(ROBOT, q[0]), []
    for pose, row in zip(path, followed.q, strict=True):
        np.testing.assert_array_equal(follower.step(pose), row)
        breaks.append(follower.last_break)
    assert tuple(one for one in breaks if one) == followed.breaks
    assert followed.breaks[0].kind is BreakReason.JUMP


def test_bad_input_is_refused_and_changes_nothing():
    follower = irbkin.Follower(ROBOT, Q)
    with pytest.raises(irbkin.InvalidPoseError, match="step takes a single pose"):
        follower.step(np.tile(np.eye(4), (2, 1, 1)))
    with pytest.raises(irbkin.InvalidPoseError):
        follower.step(np.zeros((4, 4)))
    np.testing.assert_array_equal(follower.q, Q)
    with pytest.raises(irbkin.InvalidJointsError, match="seed"):
        irbkin.Follower(ROBOT, Q[:5])
    with pytest.raises(irbkin.InvalidJointsError, match="weights"):
        irbkin.Follower(ROBOT, Q, [-1.0] * 6)
    with pytest.raises(TypeError):
        irbkin.Follower("IRB 2600-12/1.65", Q)


def test_a_follower_keeps_its_robot():
    follower = irbkin.Follower(irbkin.Robot("UR5e"), Q)
    np.testing.assert_allclose(follower.step(irbkin.Robot("UR5e").fk(Q)), Q, atol=1e-9)


def test_a_step_is_far_shorter_than_a_millisecond():
    q = Q + np.linspace(0.0, 0.2, 500)[:, None]
    path = list(ROBOT.fk(q))
    follower = irbkin.Follower(ROBOT, Q)
    start = time.perf_counter()
    for pose in path:
        follower.step(pose)
    assert (time.perf_counter() - start) / len(path) < 1e-4


def continued(robot, start, end, q, parts):
    """The joints to which Newton's steps lead on a straight way between two poses; None where a
    step is no small one."""
    for pose in irbkin.paths.line(start, end, steps=parts + 1)[1:]:
        for _ in range(8):
            tool = robot.fk(q)
            turn = pose[:3, :3] @ tool[:3, :3].T
            sines = [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
            missing = np.r_[pose[:3, 3] - tool[:3, 3], np.array(sines) / 2]
            if abs(missing).max() < 1e-12:
                break
            step = np.linalg.solve(robot.jacobian(q), missing)
            if abs(step).max() > 0.2:
                return None
            q = q + step
        else:
            return None
    return q


def test_a_large_step_without_a_break_ends_where_the_way_leads():
    rng, large = np.random.default_rng(1), 0
    for name in ("UR5e", "IRB 2600-12/1.65", "IRB 120-3/0.58", "GoFa 5"):
        robot = irbkin.Robot(name)
        low, high = np.clip(robot.limits, -6.28, 6.28).T
        for _ in range(120):
            start = rng.uniform(low, high)
            end = np.clip(start + rng.uniform(-0.3, 0.3, 6), low, high)
            line = irbkin.paths.line(robot.fk(start), robot.fk(end), step=0.005)
            followed = robot.follow(line, start)
            if followed.breaks:
                continue
            for row in np.nonzero(abs(np.diff(followed.q, axis=0)).max(axis=1) > 0.5)[0]:
                arrived = continued(robot, line[row], line[row + 1], followed.q[row], 5000)
                if arrived is not None:
                    large += 1
                    np.testing.assert_allclose(arrived, followed.q[row + 1], atol=1e-6)
    assert large >= 5


def test_a_step_to_another_branch_is_a_break_with_its_reason():
    # Steps of 0.13, 0.32, 1.03 rad before: growth alone does not show the jump of 2.3 rad.
    robot = irbkin.Robot("UR5e")
    start = [5.8706, -0.6777, -3.7195, 3.9383, -3.3205, -6.2325]
    end = [6.2832, -0.7472, -3.9316, 3.9228, -3.0129, -6.2168]
    line = irbkin.paths.line(robot.fk(start), robot.fk(end), step=0.005)
    [broken] = robot.follow(line, start).breaks
    assert (broken.pose_index, broken.kind) == (15, BreakReason.JUMP)
    assert "must turn by" in broken.reason
