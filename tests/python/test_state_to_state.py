"""`trajectory.state_to_state` by laws."""

import irbkin
import numpy as np
import pytest
from irbkin import trajectory

DOF = 6
LIMITS = {"max_velocity": 2.0, "max_acceleration": 8.0, "max_jerk": 60.0}
# Rounding of positions of a few rad [rad]: a way that takes three cube roots of it over the jerk.
ROUNDING = 4e-15


def random_case(rng):
    """Two states from which the limits can be kept, and limits, as keywords."""
    limits = {
        "max_velocity": rng.uniform(1.5, 4, DOF),
        "max_acceleration": rng.uniform(6, 15, DOF),
        "max_jerk": rng.uniform(20, 200, DOF),
    }
    # At most a quarter of the velocity changes while an acceleration is brought to zero.
    rates = {}
    for end in ("start", "end"):
        rates[f"{end}_velocity"] = 0.7 * limits["max_velocity"] * rng.uniform(-1, 1, DOF)
        most = np.sqrt(0.5 * limits["max_velocity"] * limits["max_jerk"])
        most = np.minimum(most, limits["max_acceleration"])
        rates[f"{end}_acceleration"] = most * rng.uniform(-1, 1, DOF)
    return rng.uniform(-3, 3, (2, DOF)), limits, rates


def test_it_keeps_the_limits():
    rng = np.random.default_rng(2)
    for _ in range(300):
        ends, limits, rates = random_case(rng)
        move = trajectory.state_to_state(*ends, **limits, **rates)
        for found, limit in zip(move.peaks(), limits.values(), strict=True):
            assert (found <= limit * (1 + 1e-9)).all()


def test_position_velocity_and_acceleration_are_continuous():
    rng = np.random.default_rng(3)
    for _ in range(50):
        ends, limits, rates = random_case(rng)
        move = trajectory.state_to_state(*ends, **limits, **rates)
        knots = move.knots[1:-1]
        before, after = move.sample(np.nextafter(knots, 0)), move.sample(knots)
        for left, right in zip(before, after, strict=True):
            np.testing.assert_allclose(left, right, rtol=0, atol=1e-11)


def test_from_rest_to_rest_it_takes_the_time_of_the_s_curve():
    rng = np.random.default_rng(4)
    for _ in range(100):
        ends = rng.uniform(-3, 3, (2, DOF))
        own = trajectory.joint(*ends, profile="s_curve", **LIMITS)
        move = trajectory.state_to_state(*ends, **LIMITS)
        np.testing.assert_allclose(move.duration, own.duration, rtol=1e-9)


@pytest.mark.extra
def test_an_end_at_rest_is_reached_as_fast_as_by_ruckig():
    import ruckig

    rng = np.random.default_rng(9)
    for _ in range(300):
        ends, limits, rates = random_case(rng)
        del rates["end_velocity"], rates["end_acceleration"]
        problem = ruckig.InputParameter(DOF)
        problem.current_position, problem.target_position = ends
        problem.current_velocity = rates["start_velocity"]
        problem.current_acceleration = rates["start_acceleration"]
        for name, value in limits.items():
            setattr(problem, name, value)
        answer = ruckig.Trajectory(DOF)
        assert ruckig.Ruckig(DOF).calculate(problem, answer) == ruckig.Result.Working
        move = trajectory.state_to_state(*ends, **limits, **rates)
        assert move.duration <= answer.duration * (1 + 1e-9)


def test_it_continues_a_motion_that_is_cut():
    first = trajectory.joint(np.zeros(3), np.ones(3), profile="s_curve", **LIMITS)
    cut = first.slice(0, 0.4 * first.duration)
    goal = [-1.0, 0.5, 2.0]
    rest = trajectory.state_to_state(
        cut.q[-1], goal, start_velocity=cut.dq[-1], start_acceleration=cut.ddq[-1], **LIMITS
    )
    whole = cut + rest
    sides = whole.sample([np.nextafter(cut.duration, 0), cut.duration])
    for quantity in sides:
        np.testing.assert_allclose(quantity[0], quantity[1], rtol=0, atol=1e-9)
    np.testing.assert_allclose(whole.q[-1], goal, rtol=0, atol=1e-9)


def random_limits(rng, dof):
    return {
        name: np.round(10 ** rng.uniform(*powers, dof), 2)
        for name, powers in (
            ("max_velocity", (-1, 1)),
            ("max_acceleration", (-1, 2)),
            ("max_jerk", (0, 4)),
        )
    }


def goes_on(first, at, goal, limits):
    """The motion to a goal from a time of a motion, whose limits and ends are checked."""
    state = first.sample(at)
    rest = trajectory.state_to_state(
        state.q, goal, start_velocity=state.dq, start_acceleration=state.ddq, **limits
    )
    for found, limit in zip(rest.peaks(), limits.values(), strict=True):
        assert (found <= limit * (1 + 2e-9)).all()
    np.testing.assert_allclose(rest.q[-1], goal, rtol=0, atol=1e-9)
    np.testing.assert_allclose(rest.dq[0], state.dq, rtol=0, atol=1e-8)
    return rest


@pytest.mark.parametrize("dof", [1, DOF])
@pytest.mark.parametrize("own", [True, False], ids=["state_to_state", "s_curve"])
def test_every_state_of_a_trajectory_is_a_start_and_the_rest_takes_no_longer(dof, own):
    rng = np.random.default_rng(5)
    for _ in range(12):
        limits = random_limits(rng, dof)
        ends = rng.uniform(-2, 2, (2, dof))
        first = (
            trajectory.state_to_state(*ends, **limits)
            if own
            else trajectory.joint(*ends, profile="s_curve", **limits)
        )
        parts = [*rng.uniform(0, 1, 4), 0, 1 - 1e-3, 1 - 1e-6, 1 - 1e-9, 1]
        for at in [part * first.duration for part in parts] + list(first.knots):
            rest = goes_on(first, at, ends[1], limits)
            late = 3 * np.cbrt(ROUNDING / limits["max_jerk"].min())
            assert rest.duration <= first.duration - at + late
            goes_on(first, at, ends[0], limits)


def test_a_start_above_a_limit_brakes_to_it_and_stays_inside():
    rng = np.random.default_rng(6)
    for _ in range(200):
        limits = random_limits(rng, 3)
        velocity = limits["max_velocity"] * rng.uniform(1, 3, 3) * rng.choice([-1, 1], 3)
        # Little enough that a joint does not come to exceed the opposite limit.
        most = np.sqrt(2 * limits["max_jerk"] * limits["max_velocity"])
        most = np.minimum(2 * limits["max_acceleration"], most)
        acceleration = most * rng.uniform(-1, 1, 3)
        move = trajectory.state_to_state(
            rng.uniform(-2, 2, 3),
            np.zeros(3),
            start_velocity=velocity,
            start_acceleration=acceleration,
            steps=400,
            **limits,
        )
        np.testing.assert_allclose(move.q[-1], 0, rtol=0, atol=1e-9)
        np.testing.assert_array_less(move.peaks().jerk, limits["max_jerk"] * (1 + 2e-9))
        above = np.abs(move.dq) > limits["max_velocity"] * (1 + 2e-9)
        # Once inside, a joint does not leave the limit again.
        assert (np.diff(above.astype(int), axis=0) <= 0).all()
        assert not above[-1].any()


@pytest.mark.parametrize("scale", [1e-8, 1e-4, 1e4, 1e8])
def test_units_do_not_matter(scale):
    """As much slower motions, and limits far from 1."""
    rng = np.random.default_rng(7)
    for _ in range(20):
        ends, limits, rates = random_case(rng)
        move = trajectory.state_to_state(*ends, **limits, **rates)
        slower = {
            name: value * scale ** (1 + ("acceleration" in name) + 2 * ("jerk" in name))
            for name, value in {**limits, **rates}.items()
        }
        other = trajectory.state_to_state(*ends, **slower)
        np.testing.assert_allclose(other.duration * scale, move.duration, rtol=1e-7)


def test_an_end_that_moves_is_met():
    rng = np.random.default_rng(8)
    for _ in range(100):
        ends, limits, rates = random_case(rng)
        move = trajectory.state_to_state(*ends, **limits, **rates)
        for found, limit in zip(move.peaks(), limits.values(), strict=True):
            assert (found <= limit * (1 + 1e-9)).all()
        np.testing.assert_allclose(move.q[[0, -1]], ends, rtol=0, atol=1e-9)
        for name, found in (("velocity", move.dq), ("acceleration", move.ddq)):
            wanted = [rates[f"start_{name}"], rates[f"end_{name}"]]
            np.testing.assert_allclose(found[[0, -1]], wanted, rtol=0, atol=1e-9)
        inner = move.knots[1:-1]
        for left, right in zip(
            move.sample(np.nextafter(inner, 0)), move.sample(inner), strict=True
        ):
            np.testing.assert_allclose(left, right, rtol=0, atol=1e-9)


def test_a_start_within_rounding_of_the_goal_does_not_move():
    move = trajectory.state_to_state([1.0 + 9e-10], [1.0], start_velocity=[1e-9], **LIMITS)
    assert move.duration == 0.0
    moving = trajectory.state_to_state([1], [1], start_velocity=[1], end_velocity=[1], **LIMITS)
    assert (moving.duration, moving.dq[0]) == (0.0, 1.0)
    assert trajectory.state_to_state([1.0 + 2e-9], [1.0], **LIMITS).duration > 0.0


def test_a_start_that_is_the_goal_is_a_still_motion():
    move = trajectory.state_to_state([1.0, 2.0], [1.0, 2.0], **LIMITS, steps=4)
    assert move.duration == 0.0
    np.testing.assert_array_equal(move.q, np.tile([1.0, 2.0], (4, 1)))


@pytest.mark.parametrize(
    ("changed", "kind", "words"),
    [
        ({"q0": [[0.0]]}, irbkin.InvalidJointsError, r"q0 must have shape \(m,\), got \(1, 1\)"),
        ({"q0": []}, irbkin.InvalidJointsError, r"q0 must have shape \(m,\), got \(0,\)"),
        ({"q1": [0.0]}, irbkin.InvalidJointsError, r"q1 must have shape \(2,\), got \(1,\)"),
        ({"q1": [0.0, np.nan]}, irbkin.InvalidJointsError, r"q1\[1\] is nan: every"),
        ({"start_velocity": 1.0}, irbkin.InvalidMotionError, r"start_velocity must have shape"),
        ({"end_acceleration": [0, np.inf]}, irbkin.InvalidMotionError, r"end_acceleration\[1\] is"),
        ({"max_jerk": 0.0}, irbkin.InvalidMotionError, r"max_jerk\[0\] is 0\.0, it must be pos"),
        ({"max_velocity": np.inf}, irbkin.InvalidMotionError, r"max_velocity\[0\] is inf: every"),
        (
            {"end_velocity": [0, -2.000001]},
            irbkin.InvalidMotionError,
            r"end_velocity\[1\] is -2, max_velocity\[1\] is 2 \(excess 1e-06\): lower",
        ),
        (
            {"end_acceleration": [0, 9.0]},
            irbkin.InvalidMotionError,
            r"end_acceleration\[1\] is 9, max_acceleration\[1\] is 8 \(excess 1\): lower",
        ),
        (
            {"end_velocity": [1.9, 0], "end_acceleration": [-7.0, 0]},
            irbkin.InvalidMotionError,
            r"velocity before end_acceleration\[0\] is 2.30833, max_velocity\[0\] is 2 ",
        ),
        (
            {"max_velocity": 1e-10},
            irbkin.InvalidMotionError,
            r"takes 1\S*e\+?10 s, it must take .* s: are the limits",
        ),
        (
            {"limits": [[-2, 2], [-0.5, 2]]},
            irbkin.InvalidMotionError,
            r"joint 2 is at -1.0+ rad at .* s, its limit is -0.50+ rad \(excess 5.00e-1 rad\)",
        ),
        ({"limits": [[-2, 2]]}, irbkin.InvalidMotionError, r"limits must have shape \(2, 2\)"),
        ({"steps": 1}, irbkin.InvalidMotionError, "steps must be 2 to 10000000, got 1"),
    ],
)
def test_what_cannot_be_is_named(changed, kind, words):
    arguments = {"q0": [0.0, 0.0], "q1": [1.0, -1.0], **LIMITS, **changed}
    with pytest.raises(kind, match=words):
        trajectory.state_to_state(arguments.pop("q0"), arguments.pop("q1"), **arguments)


def test_degrees_are_asked_back_unless_limits_answer():
    def move(q1, **limits):
        most = {"max_velocity": 3.0, "max_acceleration": 8.0, "max_jerk": 90.0}
        return trajectory.state_to_state([0.0] * 6, q1, **most, **limits)

    with pytest.raises(irbkin.InvalidJointsError, match=r"q1: joint 1 is 90.00 rad, .*degrees"):
        move([90.0, 0, 0, 0, 0, 0])
    assert move([90.0, 0, 0, 0, 0, 0], limits=[[-np.inf, np.inf]] * 6).duration > 30.0
