"""What nodes answer, without ROS: requests and responses are structures made of the .srv files."""

import array
import re
import threading
from pathlib import Path
from types import SimpleNamespace as Structure

import irbkin
import numpy as np
import pytest
from irbkin import IrbkinError, Robot, UnreachableError, ros

ROOT = Path(__file__).parents[2] / "ros"
ROBOT = Robot("IRB 1600-6/1.45")
Q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
TURN = np.array([0.0, 0.0, 0.0, 2 * np.pi, 0.0, 0.0])
PLAN = {"max_acceleration": np.full(6, 8.0)}


def header():
    return Structure(frame_id="", stamp=None)


def pose(T=None):
    message = Structure(
        position=Structure(x=0.0, y=0.0, z=0.0), orientation=Structure(x=0.0, y=0.0, z=0.0, w=1.0)
    )
    if T is not None:
        ros.write_pose(T, message)
    return message


def stamped(T, frame="base_link"):
    return Structure(header=Structure(frame_id=frame), pose=pose(T))


MADE = {
    "bool": bool,
    "string": str,
    "float64": float,
    "uint32": int,
    "float64[]": list,
    "uint8[]": bytes,
    "geometry_msgs/Pose": pose,
    "geometry_msgs/PoseStamped": lambda: Structure(header=header(), pose=pose()),
    "geometry_msgs/PoseArray": lambda: Structure(header=header(), poses=[]),
    "trajectory_msgs/JointTrajectory": lambda: Structure(
        header=header(), joint_names=[], points=[]
    ),
}


class Strict(Structure):
    """A structure that gets no field that its message does not have."""

    def __setattr__(self, name, value):
        assert hasattr(self, name), f"{name} is no field"
        super().__setattr__(name, value)


def halves(service):
    """The request and the response of a service with default values, as its .srv has them."""
    text = (ROOT / f"irbkin_interfaces/srv/{service}.srv").read_text()
    for half in text.split("---\n"):
        fields = re.findall(r"^([\w/\[\]]+) +(\w+)", half, re.MULTILINE)
        structure = Strict.__new__(Strict)
        structure.__dict__.update({name: MADE[kind]() for kind, name in fields})
        yield structure


def asked(kinematics, service, **fields):
    """The response to a request with these fields."""
    request, response = halves(service)
    for name, value in fields.items():
        setattr(request, name, value)
    method = {"FK": "fk", "IK": "ik", "CheckPose": "check_pose"}[service]
    assert getattr(kinematics, method)(request, response) is response
    return response


def planned(kinematics, T, frame="base_link", **fields):
    request, response = halves("PlanPath")
    request.path.header.frame_id = frame
    request.path.poses = [pose(each) for each in T]
    for name, value in fields.items():
        setattr(request, name, value)

    def point(q, dq, ddq, t):
        return Structure(q=q, dq=dq, ddq=ddq, t=t)

    return kinematics.plan_path(request, response, point)


def beyond():
    T = ROBOT.fk(Q)
    T[0, 3] += 5.0
    return T


def seam(steps=15):
    ends = (irbkin.pose([0.9, y, 0.7], euler_zyx=[0, 2.8, 0]) for y in (-0.2, 0.2))
    return irbkin.paths.line(*ends, steps=steps)


# As ROS 1 and ROS 2 hand over a float64[].
@pytest.mark.parametrize("kind", [tuple, list, lambda q: array.array("d", q), np.array])
def test_numbers_of_any_sequence_are_read(kind):
    answer = asked(ros.Kinematics(ROBOT), "FK", joints=kind(Q.tolist()))
    assert answer.success
    assert answer.message == ""
    assert answer.pose.header.frame_id == "base_link"
    np.testing.assert_allclose(ros.read_pose(answer.pose.pose), ROBOT.fk(Q), atol=1e-15)
    assert type(answer.pose.pose.position.x) is float


# As ROS 1 and ROS 2 hand over a uint8[].
@pytest.mark.parametrize("kind", [bytes, lambda values: array.array("B", values), list])
def test_solutions_of_any_byte_sequence_are_read(kind):
    answer = asked(ros.Kinematics(ROBOT), "IK", pose=pose(ROBOT.fk(Q)))
    received = Structure(
        joints=array.array("d", answer.joints),
        slots=kind(answer.slots),
        statuses=kind(answer.statuses),
    )
    wanted = ROBOT.ik(ROBOT.fk(Q))
    q, slot, status = ros.read_solutions(received)
    np.testing.assert_allclose(q, wanted.q, atol=1e-13)
    assert slot.tolist() == [s.slot for s in wanted]
    assert status.tolist() == [s.status for s in wanted]


def test_solutions_that_do_not_fit_together_are_refused():
    none = Structure(joints=(), slots=b"", statuses=b"")
    assert ros.read_solutions(none).q.shape[0] == 0
    for broken in (
        Structure(joints=(1.0,) * 12, slots=b"\1\2", statuses=b"\1"),
        Structure(joints=(1.0,) * 11, slots=b"\1\2", statuses=b"\1\1"),
        Structure(joints=(1.0,), slots=b"", statuses=b""),
    ):
        with pytest.raises(ValueError, match="one slot, one status and as many joints"):
            ros.read_solutions(broken)


def test_the_nearest_is_that_to_the_seed_or_to_the_last_target():
    kinematics = ros.Kinematics(ROBOT)
    T = ROBOT.fk(Q)
    for seed in (Q, -Q, Q + TURN):
        answer = asked(kinematics, "IK", pose=pose(T), seed=seed.tolist())
        np.testing.assert_allclose(answer.nearest, ROBOT.ik_nearest(T, seed), atol=1e-12)
    flipped = ROBOT.ik(T).within_limits()[1].q
    kinematics.joint_state(stamped(ROBOT.fk(flipped)), Structure(name=[], position=[]))
    kinematics = ros.Kinematics(ROBOT, start=flipped)
    answer = asked(kinematics, "IK", pose=pose(T))
    np.testing.assert_allclose(answer.nearest, flipped, atol=1e-12)


def test_weights_decide_what_is_nearest():
    T, weights = ROBOT.fk(Q), [1e-6, 1e-6, 1e-6, 1.0, 1.0, 1.0]
    other = 0
    for seed in np.random.default_rng(1).uniform(*ROBOT.limits.T, (50, 6)):
        equal, weighted = (
            asked(ros.Kinematics(ROBOT, weights=w), "IK", pose=pose(T), seed=seed.tolist()).nearest
            for w in (None, weights)
        )
        np.testing.assert_allclose(weighted, ROBOT.ik_nearest(T, seed, weights), atol=1e-12)
        other += not np.allclose(equal, weighted)
    assert other > 5


def test_what_is_out_of_limits_is_listed_and_has_no_nearest():
    limits = ROBOT.limits.copy()
    limits[0] = 2.9, 3.0
    robot = ROBOT.with_limits(limits)
    answer = asked(ros.Kinematics(robot), "IK", pose=pose(ROBOT.fk(Q)))
    assert (answer.success, answer.nearest) == (False, [])
    assert answer.message == robot.ik(ROBOT.fk(Q)).explain()
    assert len(ros.read_solutions(answer).slot) == 8


def test_a_wrong_request_says_why():
    kinematics = ros.Kinematics(ROBOT)
    assert asked(kinematics, "FK").message == "q must have shape (..., 6), got (0,)"
    nan = pose(ROBOT.fk(Q))
    nan.position.y = float("nan")
    answer = asked(kinematics, "IK", pose=nan)
    assert not answer.success
    assert "xyz[1] is NaN" in answer.message
    check = asked(kinematics, "CheckPose", pose=nan)
    assert (check.reachable, check.within_limits) == (False, False)
    assert check.reason == answer.message
    seed = asked(kinematics, "IK", pose=pose(ROBOT.fk(Q)), seed=[0.0])
    assert (seed.success, seed.message) == (False, "seed must have shape (6,), got (1,)")


def test_check_pose_is_that_of_the_robot():
    kinematics = ros.Kinematics(ROBOT)
    for T in (ROBOT.fk(Q), beyond()):
        answer = asked(kinematics, "CheckPose", pose=pose(T))
        check = ROBOT.check_pose(T)
        assert (answer.reachable, answer.within_limits, answer.reason) == tuple(check)


def test_seven_axes_take_q7_and_a_target_finds_one():
    panda = Robot("Panda")
    kinematics = ros.Kinematics(panda)
    q = np.array([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])
    answer = asked(kinematics, "IK", pose=pose(panda.fk(q)), q7=0.6, seed=q.tolist())
    assert answer.success
    np.testing.assert_allclose(answer.nearest, q, atol=1e-9)
    assert ros.read_solutions(answer).q.shape[1] == 7
    # Zeros are outside the limits of joint 4: the first seed is inside.
    assert ((panda.limits[:, 0] <= kinematics.last) & (kinematics.last <= panda.limits[:, 1])).all()
    state = kinematics.joint_state(stamped(panda.fk(q)), Structure(name=[], position=[]))
    np.testing.assert_allclose(panda.fk(state.position), panda.fk(q), atol=1e-12)
    line = irbkin.paths.line(panda.fk(q), panda.fk(q + 0.1), steps=5)
    answer = planned(ros.Kinematics(panda, max_acceleration=np.ones(7)), line)
    assert answer.success, answer.message
    assert len(answer.trajectory.points[0].q) == 7


def test_targets_are_followed_from_the_start():
    start = Q + TURN
    robot = ROBOT.with_limits(np.tile([-7.0, 7.0], (6, 1)))
    kinematics = ros.Kinematics(robot, start=start, joint_names=list("abcdef"))
    expected = start
    for angle in np.linspace(0.3, 1.2, 10):
        T = robot.fk([angle, *Q[1:]])
        state = kinematics.joint_state(stamped(T), Structure(name=[], position=[]))
        expected = robot.ik_nearest(T, expected)
        np.testing.assert_allclose(state.position, expected, atol=1e-12)
        np.testing.assert_array_equal(kinematics.last, state.position)
        assert state.name == list("abcdef")
    assert expected[3] > np.pi


def test_a_target_that_is_refused_changes_nothing():
    kinematics = ros.Kinematics(ROBOT, start=Q)
    state = Structure(name=[], position=[])
    with pytest.raises(UnreachableError, match="beyond reach"):
        kinematics.joint_state(stamped(beyond()), state)
    with pytest.raises(irbkin.InvalidPoseError, match='frame "world", it must be in "base_link"'):
        kinematics.joint_state(stamped(ROBOT.fk(-Q), "world"), state)
    assert state.position == []
    np.testing.assert_array_equal(kinematics.last, Q)
    # No frame, and the slash of old publishers.
    for frame in ("", "/base_link"):
        assert kinematics.joint_state(stamped(ROBOT.fk(Q), frame), state) is state


def test_threads_share_the_last_solution():
    """Two publishers may be two threads: each target starts at the end of another."""
    kinematics = ros.Kinematics(ROBOT)
    targets = [stamped(ROBOT.fk([a, *Q[1:]])) for a in np.linspace(-1.0, 1.0, 200)]
    ends = []

    def follow():
        for target in targets:
            state = kinematics.joint_state(target, Structure(name=[], position=[]))
            ends.append(tuple(state.position))

    threads = [threading.Thread(target=follow) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(ends) == 800
    assert tuple(kinematics.last) in ends


def test_a_planned_path_is_timed():
    kinematics = ros.Kinematics(ROBOT, **PLAN)
    T = seam()
    answer = planned(kinematics, T, tool_angles=24, max_tool_speed=0.1)
    assert answer.success, answer.message
    points = answer.trajectory.points
    assert answer.trajectory.joint_names == [f"joint_{i}" for i in range(1, 7)]
    assert len(points) == len(T)
    assert answer.message == f"15 poses in {points[-1].t:.3f} s"
    assert points[-1].t > 4.0
    assert np.abs([point.dq for point in points]).max() <= ROBOT.max_velocity.max()
    np.testing.assert_allclose(ROBOT.fk(points[-1].q)[:3, 3], T[-1, :3, 3], atol=1e-9)
    fast = planned(kinematics, T, tool_angles=24)
    assert fast.trajectory.points[-1].t < 2.0
    fixed = planned(kinematics, T)
    np.testing.assert_allclose(ROBOT.fk(fixed.trajectory.points[0].q), T[0], atol=1e-9)


def test_a_track_is_one_more_joint_of_a_planned_path():
    kinematics = ros.kinematics_of(
        {
            "robot": ROBOT.name,
            "max_acceleration": [8.0] * 6,
            "track": [0, 1, 0, -3, 3, 0.8, 2.0],
            "track_name": "rail",
        }
    )
    ends = [irbkin.pose([0.9, y, 0.9], euler_zyx=[0, 2.8, 0]) for y in (-2.0, 2.0)]
    T = irbkin.paths.line(*ends, steps=40)
    answer = planned(kinematics, T)
    assert answer.success, answer.message
    assert answer.trajectory.joint_names[5:] == ["joint_6", "rail"]
    points = answer.trajectory.points
    tools = np.array(
        [kinematics.robot.with_base(irbkin.pose([0, p.q[6], 0])).fk(p.q[:6]) for p in points]
    )
    np.testing.assert_allclose(tools[[0, -1]], T[[0, -1]], atol=1e-8)
    # Between the poses the joints are splines.
    np.testing.assert_allclose(tools[:, [0, 2], 3], np.full((40, 2), 0.9), atol=5e-3)
    assert np.abs([point.dq[6] for point in points]).max() <= 0.8 + 1e-9
    assert not planned(ros.kinematics_of({"robot": ROBOT.name}), T).success
    with pytest.raises(irbkin.InvalidMotionError, match="track is"):
        ros.kinematics_of({"robot": ROBOT.name, "track": [0, 0, 0, 0, 1, 1, 1]})


def test_a_planned_path_begins_at_its_start():
    T = seam()
    starts = [s.q for s in ROBOT.ik(T[0]).within_limits()]
    for start in starts[:2]:
        answer = planned(ros.Kinematics(ROBOT, **PLAN), T, start=start.tolist())
        assert answer.success, answer.message
        np.testing.assert_allclose(answer.trajectory.points[0].q, start, atol=1e-9)


@pytest.mark.parametrize(
    ("options", "fields", "words"),
    [
        ({}, {}, "set the parameter max_acceleration"),
        (PLAN, {"tool_angles": 2**32 - 1}, "steps of the tool rotation must be 2 to 3600"),
        (PLAN, {"start": [0.0]}, "start must have shape (6,), got (1,)"),
        (PLAN, {"max_tool_speed": -1.0}, "max_tool_speed"),
        (PLAN, {"max_tool_speed": float("nan")}, "max_tool_speed"),
        (PLAN, {"frame": "camera"}, 'given in frame "camera"'),
    ],
)
def test_a_plan_that_cannot_be_says_why(options, fields, words):
    answer = planned(ros.Kinematics(ROBOT, **options), seam(), **fields)
    assert not answer.success
    assert words in answer.message
    assert answer.trajectory.points == []


def test_a_path_with_a_wrong_pose_names_it():
    kinematics = ros.Kinematics(ROBOT, **PLAN)
    T = seam()
    T[3, 0, 3] = 5.0
    assert "pose 3" in planned(kinematics, T).message
    assert planned(kinematics, T[:1]).message == "path has 1 poses, a trajectory needs at least 2"
    request, response = halves("PlanPath")
    request.path.poses = [pose(each) for each in seam()]
    request.path.poses[4].orientation.w = 9.0
    refusal = kinematics.plan_path(request, response, lambda *_: None).message
    assert refusal.startswith("row [4]: quaternion norm is 9.")


def test_without_known_velocities_they_must_be_given():
    robot = Robot.from_mdh(ROBOT.mdh, limits=ROBOT.limits)
    answer = planned(ros.Kinematics(robot, **PLAN), seam())
    assert "set the parameter max_velocity" in answer.message
    given = ros.Kinematics(robot, max_velocity=np.ones(6), **PLAN)
    assert planned(given, seam()).success


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"joint_names": ["a"]}, "joint_names has 1 names, IRB 1600-6/1.45 has 6 joints"),
        ({"start": [0.0] * 5}, "start must have shape (6,), got (5,)"),
        ({"start": [np.inf] * 6}, "start[0] is inf"),
        ({"start": [0, 0, 9, 0, 0, 0]}, "start[2] is 9 rad, joint 3 must be -4.276 to 1.134 rad"),
        ({"weights": [1.0] * 5 + [-1.0]}, "weights[5] is -1.0, it must be 0 or more"),
        ({"joint_names": [*"abcde", "a"]}, "joint_names and track_name have 'a' twice or empty"),
        ({"joint_names": [*"abcde", ""]}, "have '' twice or empty"),
        ({"weights": [1.0] * 7}, "weights must have shape (6,), got (7,)"),
        ({"max_velocity": [0.0] * 6}, "max_velocity[0] is 0.0, it must be positive"),
        ({"max_acceleration": [1.0] * 5}, "max_acceleration must have shape (6,), got (5,)"),
    ],
)
def test_options_are_checked(options, words):
    with pytest.raises(IrbkinError) as refused:
        ros.Kinematics(ROBOT, **options)
    assert words in str(refused.value)
