"""Arms of five axes: pan, three parallel axes, roll."""

import math
import pickle
from collections.abc import Callable

import irbkin
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from irbkin import Reach, Robot

SO101 = Robot("SO-101")
VIPERX = Robot("ViperX 300")
ARMS = pytest.mark.parametrize("robot", [SO101, VIPERX], ids=lambda robot: robot.name)

# Origins of the SO-101's joints in its maker's URDF (TheRobotStudio/SO-ARM100): position [mm],
# rotation about fixed x, y and z [deg]; then the tip. Every joint turns about z.
ORIGINS = [
    ((20.7909, -23.0745, 94.8817), (180, 0, 90)),
    ((-30.3992, -18.2778, -54.2), (-90, -90, 0)),
    ((-112.57, -28, 0), (0, 0, 90)),
    ((-134.9, 5.2, 0), (0, 0, -90)),
    ((0, -61.1, 18.1), (90, 0, 180)),
    ((-7.9, -0.218121, -98.1274), (90, 0, 90)),
]


def turn(axis: int, angle: float) -> np.ndarray:
    """Homogeneous rotation about an axis, 0 for x."""
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(4)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def product_of_origins(q: np.ndarray) -> np.ndarray:
    pose = np.eye(4)
    for (xyz, rpy), angle in zip(ORIGINS, [*q, None], strict=True):
        roll, pitch, yaw = np.radians(rpy)
        origin = turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)
        origin[:3, 3] = np.array(xyz) / 1e3
        pose = pose @ origin
        if angle is not None:
            pose = pose @ turn(2, angle)
    return pose


def turned(pose: np.ndarray, angle: float) -> np.ndarray:
    """The pose turned in place about the vertical."""
    result = turn(2, angle) @ pose
    result[:3, 3] = pose[:3, 3]
    return result


def inside(robot: Robot) -> st.SearchStrategy[np.ndarray]:
    parts = st.lists(st.floats(0.001, 0.999), min_size=5, max_size=5)
    low, high = robot.limits.T
    return parts.map(lambda parts: low + (high - low) * np.array(parts))


@given(inside(SO101))
def test_forward_kinematics_are_the_product_of_the_urdf(q):
    np.testing.assert_allclose(SO101.fk(q), product_of_origins(q), atol=1e-15)


@given(inside(SO101), st.floats(-math.pi, math.pi))
def test_a_turned_pose_has_the_joints_that_made_it(q, angle):
    target = turned(SO101.fk(q), angle)
    solutions = SO101.ik(target, heading_tolerance=math.pi)
    if SO101.singularity(q).wrist > 1e-3:
        off = np.abs(np.exp(1j * solutions.q) - np.exp(1j * q)).max(axis=1)
        assert off.min() < 1e-6
    for solution in solutions:
        reached = turned(target, solution.heading_error)
        np.testing.assert_allclose(SO101.fk(solution.q), reached, atol=1e-13)
        assert SO101.heading_error(solution.q, target) == solution.heading_error


@ARMS
def test_the_tolerance_bounds_every_way_to_solve(robot):
    q = np.array([0.3, -0.4, 0.5, -0.6, 0.7])
    target = turned(robot.fk(q), 0.01)
    assert robot.heading_tolerance == 1e-5
    empty = robot.ik(target)
    assert (len(empty), empty.reach, empty.shortfall) == (0, Reach.TURNED, 0.0)
    assert "turned about axis 1 by 0.573 deg (heading_tolerance admits it)" in empty.explain()
    assert not robot.check_pose(target).reachable
    assert (robot.ik_batch([target]).status == 0).all()
    with pytest.raises(irbkin.UnreachableError, match="turned about axis 1"):
        robot.ik_nearest(target, q, heading_tolerance=1e-3)

    wide = robot.with_heading_tolerance(0.02)
    found = wide.ik(target)
    assert found == robot.ik(target, heading_tolerance=0.02)
    batch = robot.ik_batch([target], heading_tolerance=0.02)
    np.testing.assert_array_equal(batch.q[0], found.q_by_slot)
    np.testing.assert_array_equal(batch.status[0], found.status)
    np.testing.assert_allclose(robot.ik_nearest(target, q), q, atol=1e-12)
    np.testing.assert_allclose(wide.follow([target], q).q, [q], atol=1e-12)
    assert found.nearest(q).heading_error == pytest.approx(-0.01)


@ARMS
def test_a_vertical_tool_is_reached_exactly(robot):
    low, high = robot.limits.T
    q = 0.5 * (low + high)
    q[0] = 0.3
    # The elevation is the sum of three angles: axis 5 down.
    frame = robot.link_frames(q)[4]
    tilt = math.atan2(np.hypot(*frame[:2, 2]), frame[2, 2])
    for sign in (1, -1):
        down = q + np.array([0, 0, 0, sign * (math.pi - tilt), 0])
        if abs(robot.link_frames(down)[4][2, 2]) > 1 - 1e-12:
            break
    for heading in (0.0, 1.0, -2.5):
        target = turned(robot.fk(down), heading)
        solutions = robot.ik(target)
        assert len(solutions) >= 2
        assert max(abs(solution.heading_error) for solution in solutions) < 1e-12
        assert max(solution.residual for solution in solutions) < 1e-13
        assert all(irbkin.SingularityKind.WRIST in one.singularities for one in solutions)


@given(inside(SO101), inside(SO101))
def test_a_position_alone_keeps_the_roll(q, seed):
    target = SO101.fk(q)
    try:
        found = SO101.ik_nearest(target, seed, position_only=True)
    except irbkin.UnreachableError:
        return
    np.testing.assert_allclose(SO101.fk(found)[:3, 3], target[:3, 3], atol=1.1e-9)
    np.testing.assert_array_equal(found, SO101.ik_nearest(target[:3, 3], seed, position_only=True))
    assert SO101.limits[:, 0].min() - 1e-9 <= found.min()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda T: SO101.ik(T, heading_tolerance=-1.0),
            "heading_tolerance is -1 rad, it must be 0 to",
        ),
        (lambda T: SO101.ik(T, heading_tolerance=math.nan), "heading_tolerance is NaN rad"),
        (lambda T: SO101.with_heading_tolerance(3.2), "heading_tolerance is 3.2 rad"),
        (lambda T: Robot("UR5e").ik(T, heading_tolerance=0.1), "arms of five axes: this one has 6"),
        (lambda T: SO101.ik(T, 0.3), "q7 is joint 7 of an arm of seven joints"),
        (lambda T: SO101.fk([0.0] * 6), r"q must have shape \(\.\.\., 5\), got \(6,\)"),
        (lambda T: SO101.configuration([0.0] * 5), "no ABB configuration"),
        (
            lambda T: SO101.plan([T], rotation=irbkin.ToolRotation()),
            "rotation is for arms of six or",
        ),
        (lambda T: SO101.follow([T], [0.0] * 5, singularity_mode="wrist"), "arms of six joints"),
        (
            lambda T: SO101.ik_nearest(T, [0.0] * 5, position_only=True, heading_tolerance=0.1),
            "position_only leaves the heading free",
        ),
    ],
)
def test_what_five_axes_do_not_have_is_named(call: Callable[[np.ndarray], object], words: str):
    with pytest.raises((irbkin.IrbkinError, TypeError, ValueError), match=words):
        call(SO101.fk([0.1] * 5))


@ARMS
def test_a_pose_out_of_reach_has_no_solution_and_says_so(robot):
    pose = robot.fk([0.1] * 5)
    pose[:3, 3] += [9.0, 0.0, 0.0]
    solutions = robot.ik(pose, heading_tolerance=math.pi)
    assert len(solutions) == 0
    assert solutions.reach is Reach.TOO_FAR
    assert solutions.shortfall > 7.0
    q, status = robot.ik_batch(pose)
    assert np.isnan(q).all()
    assert not status.any()


@ARMS
def test_a_pose_that_is_not_finite_is_an_error_and_an_invalid_row(robot):
    poses = robot.fk(np.linspace([0.1] * 5, [0.2] * 5, 3))
    whole = robot.ik_batch(poses)
    poses[1, 2, 3] = np.nan
    with pytest.raises(irbkin.InvalidPoseError, match=r"pose\[2, 3\] is NaN"):
        robot.ik(poses[1])
    q, status = robot.ik_batch(poses)
    assert (status[1] == irbkin.Status.INVALID).all()
    assert np.isnan(q[1]).all()
    np.testing.assert_array_equal(q[::2], whole.q[::2])
    np.testing.assert_array_equal(status[::2], whole.status[::2])


@ARMS
@pytest.mark.parametrize("tolerance", [None, 0.5])
def test_an_empty_batch_has_an_empty_answer(robot, tolerance):
    q, status = robot.ik_batch(np.empty((0, 4, 4)), heading_tolerance=tolerance)
    assert q.shape == (0, *status.shape[1:], 5)
    assert len(status) == 0
    assert robot.fk(np.empty((0, 5))).shape == (0, 4, 4)


@ARMS
def test_a_plan_is_the_best_of_the_paths_from_every_solution(robot):
    q = np.linspace([0.1, -0.3, 0.4, -0.5, 0.6], [0.6, 0.1, 0.2, -0.2, -0.4], 30)
    path = robot.fk(q)
    plan = robot.plan(path)
    assert plan.certified
    assert not plan.breaks
    np.testing.assert_allclose(robot.fk(plan.q), path, atol=1e-12)
    assert plan.cost <= np.square(np.diff(q, axis=0)).sum() + 1e-9
    far = path.copy()
    far[20:, :3, 3] += 5.0
    with pytest.raises(irbkin.PathError, match="no branch reaches pose 20 from the start"):
        robot.plan(far)
    gap = path.copy()
    gap[10:15, :3, 3] += 5.0
    with pytest.raises(irbkin.PathError, match="no branch reaches pose 10") as caught:
        robot.plan(gap)
    partial = caught.value.plan
    assert [(b.leave, b.enter) for b in partial.breaks] == [(9, 15)]
    assert np.isnan(partial.q[10:15]).all()
    np.testing.assert_allclose(robot.fk(partial.q[15:]), path[15:], atol=1e-12)


@ARMS
def test_a_robot_with_a_tolerance_is_a_value(robot):
    wide = robot.with_heading_tolerance(0.5)
    assert wide != robot
    assert pickle.loads(pickle.dumps(wide)) == wide
    assert wide.with_tool(np.eye(4)).heading_tolerance == 0.5
    assert pickle.loads(pickle.dumps(wide.ik(robot.fk([0.1] * 5)))) == wide.ik(robot.fk([0.1] * 5))


@ARMS
def test_a_urdf_of_five_axes_is_read_back(robot):
    again = Robot.from_urdf(robot.to_urdf())
    assert (again.dof, again.structure) == (5, "pan, three parallel axes, roll")
    q = np.array([0.3, -0.4, 0.5, -0.6, 0.7])
    np.testing.assert_allclose(again.fk(q), robot.fk(q), atol=1e-14)
    assert len(again.ik(robot.fk(q))) >= 2


def test_five_joints_of_another_structure_are_refused_by_their_axes():
    rows = [
        [0, 0, 0.3, 0],
        [1.2, 0, 0, 0],
        [0, 0.3, 0, 0],
        [0, 0.3, 0, 0],
        [math.pi / 2, 0, 0.1, 0],
    ]
    with pytest.raises(irbkin.InvalidModelError, match="axes 1 and 2 must be at right angles"):
        Robot.from_mdh(rows)
