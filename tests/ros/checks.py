"""What a node of either ROS must do, asked over the real middleware.

`check_ros1.py` and `check_ros2.py` start a node and hand a `Node` to `run`.
"""

import math
import signal
import subprocess
import time
from pathlib import Path

import irbkin
import numpy as np
from irbkin import ros

ROBOT = "IRB 1600-6/1.45"
PREFIX = "/irb1600_kinematics"
# Whole numbers are numbers, too.
PARAMETERS = {"robot": ROBOT, "max_acceleration": [8] * 6, "start": [0.0] * 6}
SERVICES = {f"{PREFIX}/fk", f"{PREFIX}/ik", f"{PREFIX}/check_pose"}
KINDS = {"fk": "FK", "ik": "IK", "check_pose": "CheckPose", "plan_path": "PlanPath"}
JOINT_NAMES = [f"joint_{i}" for i in range(1, 7)]
Q = (0.3, -0.2, 0.4, 0.5, -0.6, 0.7)
# Longest wait for a message, and for one that must not come [s].
LONGEST, SILENCE = 10.0, 0.5
CALLS = 1000

robot = irbkin.Robot(ROBOT)


def fill(message, T):
    """The `geometry_msgs/Pose` of a matrix."""
    ros.write_pose(T, message)
    return message


def beyond():
    """A pose out of reach."""
    T = robot.fk(Q)
    T[0, 3] += 5.0
    return T


def fk_is_the_pose(node):
    answer = node.call(f"{PREFIX}/fk", joints=list(Q))
    assert answer.success, answer.message
    assert answer.pose.header.frame_id == "base_link"
    np.testing.assert_allclose(ros.read_pose(answer.pose.pose), robot.fk(Q), atol=1e-15)


def fk_of_wrong_joints_says_why(node):
    answer = node.call(f"{PREFIX}/fk", joints=[1.0, 2.0])
    assert not answer.success
    assert answer.message == "q must have shape (..., 6), got (2,)"
    assert "joint 2 is NaN" in node.call(f"{PREFIX}/fk", joints=[0.0, math.nan] + 4 * [0.0]).message


def ik_has_all_solutions_and_the_nearest(node):
    T = robot.fk(Q)
    answer = node.call(f"{PREFIX}/ik", pose=fill(node.pose(), T), seed=list(Q))
    assert answer.success
    assert answer.message == robot.ik(T).explain()
    found, wanted = ros.read_solutions(answer), robot.ik(T)
    assert found.q.shape == (8, 6)
    np.testing.assert_allclose(found.q, wanted.q, atol=1e-12)
    assert found.slot.tolist() == [s.slot for s in wanted]
    assert found.status.tolist() == [s.status for s in wanted]
    np.testing.assert_allclose(answer.nearest, Q, atol=1e-12)


def ik_out_of_reach_says_why(node):
    answer = node.call(f"{PREFIX}/ik", pose=fill(node.pose(), beyond()))
    assert not answer.success
    assert answer.message == robot.ik(beyond()).explain()
    assert "beyond reach" in answer.message
    assert len(answer.joints) == len(answer.nearest) == len(ros.read_solutions(answer).slot) == 0


def ik_of_what_is_no_pose_says_why(node):
    pose = node.pose()
    pose.orientation.w = 0.0
    answer = node.call(f"{PREFIX}/ik", pose=pose)
    assert not answer.success
    assert "quaternion norm is 0.000000" in answer.message


def check_pose_has_the_reason(node):
    inside = node.call(f"{PREFIX}/check_pose", pose=fill(node.pose(), robot.fk(Q)))
    assert (inside.reachable, inside.within_limits) == (True, True)
    outside = node.call(f"{PREFIX}/check_pose", pose=fill(node.pose(), beyond()))
    assert (outside.reachable, outside.within_limits) == (False, False)
    assert outside.reason == robot.check_pose(beyond()).reason


def a_target_gives_the_joint_state_nearest_to_the_last(node):
    last = np.zeros(6)
    for angle in np.linspace(0.0, 1.5, 4):
        T = robot.fk((angle, *Q[1:]))
        node.clear()
        node.publish(fill(node.pose(), T), "base_link")
        state = node.joint_state(LONGEST)
        assert state is not None, "no joint state"
        assert list(state.name) == JOINT_NAMES
        last = robot.ik_nearest(T, last)
        np.testing.assert_allclose(state.position, last, atol=1e-12)
        assert not len(state.velocity)
        assert node.stamp(state) > 0


def a_target_out_of_reach_is_logged_and_publishes_nothing(node):
    for T, frame, words in (
        (beyond(), "base_link", "target_pose: wrist center"),
        (robot.fk(Q), "camera", 'the pose is given in frame "camera", it must be in "base_link"'),
    ):
        node.clear()
        node.publish(fill(node.pose(), T), frame)
        assert node.joint_state(SILENCE) is None
        assert wait_for(lambda words=words: words in node.log()), (words, node.log())
    # It goes on with the last solution that there was.
    node.publish(fill(node.pose(), robot.fk(Q)), "")
    assert node.joint_state(LONGEST) is not None


def seam(steps=25):
    """Poses along a line."""
    a, b = (irbkin.pose([0.9, y, 0.7], euler_zyx=[0, 2.8, 0]) for y in (-0.3, 0.3))
    return irbkin.paths.line(a, b, steps=steps)


def plan_path_gives_a_trajectory(node):
    poses = seam()
    answer = node.call(
        "/plan_path",
        path=node.pose_array(poses, "base_link"),
        tool_angles=24,
        max_tool_speed=0.2,
    )
    assert answer.success, answer.message
    trajectory = answer.trajectory
    assert list(trajectory.joint_names) == JOINT_NAMES
    t = np.array([node.seconds(point.time_from_start) for point in trajectory.points])
    q, dq, ddq = (
        np.array([getattr(point, field) for point in trajectory.points])
        for field in ("positions", "velocities", "accelerations")
    )
    assert q.shape == dq.shape == ddq.shape == (len(poses), 6)
    assert t[0] == 0
    assert (np.diff(t) > 0).all()
    # 0.6 m at 0.2 m/s, from rest to rest.
    assert t[-1] > 3.0
    np.testing.assert_allclose(dq[[0, -1]], 0, atol=1e-9)
    assert (np.abs(dq) <= robot.max_velocity * (1 + 1e-9)).all()
    assert (np.abs(ddq) <= 8.0 * (1 + 1e-9)).all()
    ends = robot.fk(q[[0, -1]])
    np.testing.assert_allclose(ends[:, :3, 3], poses[[0, -1], :3, 3], atol=1e-9)
    np.testing.assert_allclose(ends[:, :3, 2], poses[[0, -1], :3, 2], atol=1e-9)


def plan_path_says_why_there_is_no_way(node):
    poses = seam()
    poses[12, 0, 3] = 5.0
    answer = node.call("/plan_path", path=node.pose_array(poses, "base_link"))
    assert not answer.success
    assert "pose 12" in answer.message, answer.message
    assert not len(answer.trajectory.points)


def timings(node):
    """Print the times of a call beside those of the solve itself."""
    T = robot.fk(Q)
    fields = {"pose": fill(node.pose(), T), "seed": list(Q)}
    calls = measured(lambda: node.call(f"{PREFIX}/ik", **fields))
    solves = measured(lambda: robot.ik(T).nearest(Q))
    handler = ros.Kinematics(robot)
    request, response = node.request("IK", **fields), node.response("IK")
    handled = measured(lambda: handler.ik(request, response))
    for name, times in (("a call of ik", calls), ("its handler", handled), ("the solve", solves)):
        median, worst = np.percentile(times, [50, 99])
        print(
            f"  {name:14} {median * 1e6:8.1f} us median, {worst * 1e6:8.1f} us 99 %, "
            f"{1 / times.mean():9.0f} /s"
        )


def measured(call):
    """Seconds of each of many calls, one after the other."""
    for _ in range(20):
        call()
    times = np.empty(CALLS)
    for i in range(CALLS):
        start = time.perf_counter()
        call()
        times[i] = time.perf_counter() - start
    return times


def wait_for(condition, seconds=LONGEST):
    """Whether the condition becomes true in time."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


CHECKS = (
    fk_is_the_pose,
    fk_of_wrong_joints_says_why,
    ik_has_all_solutions_and_the_nearest,
    ik_out_of_reach_says_why,
    ik_of_what_is_no_pose_says_why,
    check_pose_has_the_reason,
    timings,
)
# Of ROS 2 alone.
PATH_CHECKS = (
    a_target_gives_the_joint_state_nearest_to_the_last,
    a_target_out_of_reach_is_logged_and_publishes_nothing,
    plan_path_gives_a_trajectory,
    plan_path_says_why_there_is_no_way,
)


def run(node, checks):
    """Run checks; the first that fails ends the run."""
    for check in checks:
        start = time.perf_counter()
        check(node)
        print(f"  {check.__name__.replace('_', ' ')}: {time.perf_counter() - start:.2f} s")


class Process:
    """A program in a process of its own; its output goes to a file, never to a pipe."""

    def __init__(self, command, env, log: Path):
        self.log = log
        with log.open("wb") as output:
            self.process = subprocess.Popen(
                command,
                env={**env, "PYTHONFAULTHANDLER": "1", "PYTHONUNBUFFERED": "1"},
                stdout=output,
                stderr=subprocess.STDOUT,
            )

    def text(self):
        return self.log.read_text(errors="replace")

    def code(self, seconds):
        """The exit code; None if it has not ended in time: then it is aborted, and its output ends
        with what each of its threads was at.
        """
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGABRT)
            time.sleep(0.5)
            return None
        finally:
            self.process.kill()
            self.process.wait()

    def end(self, seconds=5.0):
        """Send SIGTERM. Returns the exit code, or None after it had to be aborted."""
        self.process.terminate()
        return self.code(seconds)


def refuses_its_parameters(start):
    """A node with a wrong parameter ends with 1 and the reason, without a traceback."""
    for parameters, words in (
        ({"robot": "IRB 1601"}, "IRB 1600-6/1.45"),
        ({"robot": 1600}, "robot is 1600, it must be a text"),
        ({}, "robot is empty"),
        ({**PARAMETERS, "start": [0.0, 1.0]}, "start must have shape (6,), got (2,)"),
        ({**PARAMETERS, "max_velocity": [-1] * 6}, "max_velocity[0] is -1.0, it must be positive"),
        ({**PARAMETERS, "max_velocity": "fast"}, "max_velocity is 'fast', it must be an array of"),
    ):
        process = start(parameters)
        assert process.code(20) == 1, process.text()
        assert words in process.text(), process.text()
        assert "Traceback" not in process.text(), process.text()
    print("  wrong parameters are refused with the reason")
