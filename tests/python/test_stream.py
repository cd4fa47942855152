"""The guard from Python: what it answers, what it refuses and how, and its loop on a trajectory."""

import pickle
import threading
from concurrent.futures import ThreadPoolExecutor

import irbkin
import numpy as np
import pytest
from irbkin.body import Shape
from irbkin.stream import Guard, Step

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
START = np.array([0.0, 0.0, 0.0, 0.0, 0.5, 0.0])
LIMITS = {"max_velocity": 1.8, "max_acceleration": 8.0, "max_jerk": 60.0}
CYCLE = 0.004


def guard(**options):
    return Guard(ROBOT, **{"cycle": CYCLE, "start": START, **LIMITS, **options})


def sampled(motion):
    """Joint vectors of a trajectory, one a cycle, the last at its end."""
    times = np.arange(np.ceil(motion.duration / CYCLE) + 1) * CYCLE
    return motion.sample(np.minimum(times, motion.duration)).q


def rest(own):
    """Steps without a reference, until the guard holds."""
    steps = [own.step(None)]
    while steps[-1].state != "holding":
        steps.append(own.step(None))
        assert len(steps) < 1000
    return steps


def test_a_guard_at_rest_holds_its_start():
    own = guard()
    assert (own.robot, own.cycle, own.state) == (ROBOT, CYCLE, "holding")
    assert repr(own) == "<Guard: IRB 2600-12/1.65, cycle 0.004 s, holding>"
    step = own.step(None)
    assert isinstance(step, Step)
    assert step == (START, np.zeros(6), np.zeros(6), False, "holding", step.reason)
    assert step.reason == "no reference in this cycle"
    assert pickle.loads(pickle.dumps(step)) == step
    assert "proves nothing" in repr(guard(cell=False))


@pytest.mark.parametrize("on_violation", ["brake", "limit"])
def test_a_trajectory_is_followed_one_cycle_later(on_violation):
    goal = START + np.array([0.3, -0.2, 0.2, 0.5, -0.9, 0.4])
    motion = irbkin.trajectory.joint(START, goal, **LIMITS, profile="s_curve")
    own = guard(on_violation=on_violation)
    q = [START, START]
    for reference in [*sampled(motion), goal, goal, goal]:
        step = own.step(reference)
        assert step.accepted
        assert step.reason is None
        assert step.state == "following"
        q.append(step.q)
        assert np.allclose(
            step.dq, (step.q - q[-2]) / CYCLE, atol=LIMITS["max_acceleration"] * CYCLE
        )
    assert np.array_equal(q[-1], goal)
    # A set point is the mean of three references with weights 1, 4, 1.
    mean = (sampled(motion)[:-2] + 4 * sampled(motion)[1:-1] + sampled(motion)[2:]) / 6
    assert np.allclose(q[4 : 2 + len(sampled(motion))], mean, atol=1e-14)


def test_poses_are_followed_on_the_branch():
    goal = START + np.array([0.3, -0.2, 0.2, 0.5, 0.4, 0.4])
    motion = irbkin.trajectory.joint(START, goal, **LIMITS, profile="s_curve")
    own = guard()
    for T in ROBOT.fk(sampled(motion)):
        assert own.step(T).accepted
    assert np.allclose(own.q, goal, atol=1e-4)
    rest(own)
    flipped = ROBOT.ik(ROBOT.fk(own.q)).q
    assert len(flipped) > 2
    limited = guard(on_violation="limit")
    beyond = ROBOT.fk([3.0, 0, 0, 0, 0.5, 0])
    beyond[0, 3] = 3.0
    assert "reach" in limited.step(beyond).reason
    assert limited.step(np.full((4, 4), np.nan)).reason.startswith("the pose is not a rigid")


def test_a_loss_is_a_stop_and_the_next_reference_ends_it():
    goal = START + np.array([1.5, 0, 0, 0, 0, 0])
    motion = irbkin.trajectory.joint(START, goal, **LIMITS, profile="s_curve")
    own = guard(on_violation="limit")
    for reference in sampled(motion)[: len(sampled(motion)) // 2]:
        own.step(reference)
    assert own.step(None).state == "braking"
    assert own.step(goal).state == "following"
    stop = rest(own)
    assert all(abs(step.ddq).max() <= 8.0 + 1e-7 for step in stop)
    assert stop[-1].q[0] < goal[0]
    # The brake of a joint alone, in the least time of a jerk-limited one and three cycles.
    least = abs(stop[0].dq[0]) / 8.0 + 8.0 / 60.0
    assert len(stop) * CYCLE < least + 6 * CYCLE


def test_what_does_not_fit_is_refused_with_joint_value_and_bound():
    own = guard()
    for joint, value, words in [
        (1, np.nan, "joint 2 is NaN, it must be finite"),
        (1, 9.0, "joint 2 is 9.000000 rad, its limits are -1.658063 to"),
        (2, 0.1, "joint 3 would need a velocity of 25.0000 rad/s, its bound is 1.8000 rad/s"),
        (2, 1e-3, "joint 3 would need an acceleration of 62.5000 rad/s^2, its bound is 8.0000"),
        (2, 1e-5, "joint 3 would need a jerk of 156.2500 rad/s^3, its bound is 60.0000 rad/s^3"),
    ]:
        q = START.copy()
        q[joint] = value
        step = own.step(q)
        assert not step.accepted
        assert step.state == "holding"
        assert step.reason.startswith(words)
    assert np.array_equal(own.q, START)


def test_an_obstacle_in_the_way_is_named_and_not_touched():
    wall = irbkin.Cell({"wall": Shape.box([0.1, 2, 2], irbkin.pose([1.3, 0, 1]))}, margin=0.01)
    goal = START + np.array([0, 0.9, 0, 0, 0, 0])
    assert wall.collides(ROBOT, goal)
    for on_violation in ("brake", "limit"):
        own = guard(cell=wall, on_violation=on_violation, margin=0.005)
        motion = irbkin.trajectory.joint(START, goal, **LIMITS, profile="s_curve")
        steps = [own.step(q) for q in [*sampled(motion), *[goal] * 400]]
        assert any("and wall come too near" in (step.reason or "") for step in steps)
        nearest = wall.distance(ROBOT, np.array([step.q for step in steps])).distance
        assert nearest.min() > 0.015
        if on_violation == "limit":
            assert nearest[-1] < 0.05


def test_the_tool_keeps_its_speed():
    goal = START + np.array([2.0, 0, 0, 0, 0, 0])
    own = guard(max_tool_speed=0.5, on_violation="limit")
    steps = [own.step(goal) for _ in range(800)]
    speeds = [np.linalg.norm((ROBOT.jacobian(step.q) @ step.dq)[:3]) for step in steps]
    assert 0.3 < max(speeds) <= 0.5
    assert any("its bound is 0.5000 m/s" in (step.reason or "") for step in steps)


def test_bad_input_is_refused():
    with pytest.raises(irbkin.InvalidMotionError, match=r"cycle is 0\.0, it must be positive"):
        guard(cycle=0.0)
    with pytest.raises(irbkin.InvalidMotionError, match="did you pass milliseconds"):
        guard(cycle=4.0)
    with pytest.raises(irbkin.InvalidMotionError, match="max_acceleration"):
        guard(max_acceleration=0.0)
    with pytest.raises(irbkin.InvalidMotionError, match="max_velocity"):
        guard(max_velocity=np.inf)
    with pytest.raises(irbkin.InvalidMotionError, match="max_tool_speed"):
        guard(max_tool_speed=-1.0)
    with pytest.raises(irbkin.InvalidModelError, match="margin"):
        guard(margin=-1.0)
    with pytest.raises(irbkin.UnreachableError, match=r"start: joint 2 is 3\.000000 rad"):
        guard(start=[0, 3, 0, 0, 0, 0])
    with pytest.raises(irbkin.UnreachableError, match=r"start collides: .* with ball"):
        guard(cell=irbkin.Cell({"ball": Shape.sphere(0.3, [0.9, 0, 1.4])}))
    with pytest.raises(irbkin.InvalidJointsError, match="start"):
        guard(start=[0, np.nan, 0, 0, 0, 0])
    with pytest.raises(irbkin.InvalidJointsError, match="reference"):
        guard().step([0, 0, 0])
    with pytest.raises(ValueError, match="on_violation"):
        guard(on_violation="clamp")
    with pytest.raises(TypeError, match=r"cell must be an irbkin\.Cell"):
        guard(cell="table")


def test_velocities_that_nobody_knows_are_asked_for():
    own = irbkin.Robot.from_mdh(ROBOT.mdh, limits=ROBOT.limits)
    with pytest.raises(irbkin.InvalidModelError, match="give max_velocity"):
        Guard(own, cycle=CYCLE, start=START, max_acceleration=8.0, cell=False)
    nameless = Guard(own, cycle=CYCLE, start=START, **LIMITS, cell=False)
    assert repr(nameless) == "<Guard: cycle 0.004 s, holding, proves nothing free>"
    assert Guard(ROBOT, cycle=CYCLE, start=START, max_acceleration=8.0).state == "holding"


def test_seven_axes():
    panda = irbkin.Robot("Panda")
    start = np.array([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])
    own = Guard(panda, cycle=0.002, start=start, **LIMITS, on_violation="limit")
    goal = start + 0.2
    steps = [own.step(goal) for _ in range(600)]
    assert steps[-1].accepted
    assert np.array_equal(own.q, goal)
    T = panda.fk(own.q)
    assert own.step(T).accepted


def test_a_watchdog_in_another_thread_brakes_a_guard_that_is_in_a_step():
    own = guard(on_violation="limit")
    for _ in range(50):
        own.step(START + 1.0)
    inside, gone = threading.Event(), threading.Event()

    class Slow:
        """A reference whose conversion takes long, as a list of many numbers may."""

        def __array__(self, dtype=None, copy=None):
            inside.set()
            assert gone.wait(10.0)
            return START + 1.0

    with ThreadPoolExecutor(1) as pool:
        late = pool.submit(own.step, Slow())
        assert inside.wait(10.0)
        steps = rest(own)
        gone.set()
        assert late.result().state == "following"
    assert {step.state for step in steps} == {"braking", "holding"}
    assert own.state == "following"


@pytest.mark.parametrize("on_violation", ["brake", "limit"])
def test_noise_is_not_amplified(on_violation):
    noise = 1e-4 * np.random.default_rng(0).standard_normal((2000, 6))
    own = guard(on_violation=on_violation, cell=False)
    q = np.array([own.step(START + row).q for row in noise])
    assert abs(q - START).max() <= 3 * abs(noise).max()


@pytest.mark.parametrize("on_violation", ["brake", "limit"])
def test_references_at_30_hz_lead_a_loop_of_250_for_the_time_of_the_hold(on_violation):
    turn = np.array([1.0, 0, 0, 0, 0, 0])
    own = guard(on_violation=on_violation, hold=0.04, cell=False)
    assert own.hold == 0.04
    frames = np.floor(30 * CYCLE * np.arange(1000)) / 30
    clean = 0.2 * (1 - np.cos(frames))
    is_new = np.diff(frames, prepend=-1) > 0
    steps = [
        own.step(START + angle * turn if new else None)
        for angle, new in zip(clean, is_new, strict=True)
    ]
    assert {step.state for step in steps[100:]} == {"following"}
    late = abs(np.array([step.q[0] for step in steps]) - clean)
    assert late.max() <= 3 * 0.2 / 30
    assert guard().hold == 0.0
    states = [own.step(None).state for _ in range(200)]
    assert states[9] == "braking"
    assert states[-1] == "holding"
    with pytest.raises(
        irbkin.InvalidMotionError, match=r"hold is 40\.0 s, it must be from 0 to 10"
    ):
        guard(hold=40)
