"""`trajectory.state_to_state` against ruckig's own evaluation, and by laws."""

import sys

import irbkin
import numpy as np
import pytest
from irbkin import trajectory

ruckig = pytest.importorskip("ruckig")

DOF = 6
LIMITS = {"max_velocity": 2.0, "max_acceleration": 8.0, "max_jerk": 60.0}
# What ruckig may miss the end by [rad], and the peaks of the quintic that spreads it (eq. 8b).
MISSED, PEAKS = 1e-8, (15 / 8, 10 / np.sqrt(3), 60)


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


def solved(ends, limits, rates):
    """ruckig's answer."""
    problem = ruckig.InputParameter(DOF)
    problem.current_position, problem.target_position = ends
    problem.current_velocity = rates["start_velocity"]
    problem.target_velocity = rates["end_velocity"]
    problem.current_acceleration = rates["start_acceleration"]
    problem.target_acceleration = rates["end_acceleration"]
    for name, value in limits.items():
        setattr(problem, name, value)
    answer = ruckig.Trajectory(DOF)
    assert ruckig.Ruckig(DOF).calculate(problem, answer) == ruckig.Result.Working
    return answer


def test_it_is_ruckig_s_motion_with_ends_that_are_met():
    rng = np.random.default_rng(1)
    for _ in range(300):
        ends, limits, rates = random_case(rng)
        move = trajectory.state_to_state(*ends, **limits, **rates)
        reference = solved(ends, limits, rates)
        assert move.duration == reference.duration
        times = np.linspace(0, move.duration, 60)
        # ruckig ends within 1e-8 rad. Spread over T this is 6e-8 / T^2 of an acceleration.
        assert move.duration > 0.3
        for found, wanted in zip(
            move.sample(times), zip(*map(reference.at_time, times), strict=True), strict=True
        ):
            np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-6)
        np.testing.assert_allclose(move.q[[0, -1]], ends, rtol=0, atol=1e-9)
        for name, found in (("velocity", move.dq), ("acceleration", move.ddq)):
            wanted = [rates[f"start_{name}"], rates[f"end_{name}"]]
            np.testing.assert_allclose(found[[0, -1]], wanted, rtol=0, atol=1e-9)


def test_it_keeps_the_limits():
    rng = np.random.default_rng(2)
    for _ in range(300):
        ends, limits, rates = random_case(rng)
        move = trajectory.state_to_state(*ends, **limits, **rates)
        for order, (found, limit) in enumerate(zip(move.peaks(), limits.values(), strict=True)):
            spread = MISSED * PEAKS[order] / move.duration ** (order + 1)
            assert (found <= limit * (1 + 1e-12) + spread).all(), order


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


def test_it_continues_a_motion_that_is_cut():
    first = trajectory.joint(np.zeros(3), np.ones(3), profile="s_curve", **LIMITS)
    cut = first.slice(0, 0.4 * first.duration)
    # A cut within rounding of the limits may be beyond them by rounding.
    wider = {name: 1.001 * value for name, value in LIMITS.items()}
    goal = [-1.0, 0.5, 2.0]
    rest = trajectory.state_to_state(
        cut.q[-1], goal, start_velocity=cut.dq[-1], start_acceleration=cut.ddq[-1], **wider
    )
    whole = cut + rest
    sides = whole.sample([np.nextafter(cut.duration, 0), cut.duration])
    for quantity in sides:
        np.testing.assert_allclose(quantity[0], quantity[1], rtol=0, atol=1e-9)
    np.testing.assert_allclose(whole.q[-1], goal, rtol=0, atol=1e-9)


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
            {"start_velocity": [3.0, 0]},
            irbkin.InvalidMotionError,
            r"current velocity .* joint 1 ",
        ),
        (
            {"end_acceleration": [0, 9.0]},
            irbkin.InvalidMotionError,
            r"target acc.* joint 2 ",
        ),
        ({"steps": 1}, irbkin.InvalidMotionError, "steps must be 2 to 10000000, got 1"),
    ],
)
def test_what_cannot_be_is_named(changed, kind, words):
    arguments = {"q0": [0.0, 0.0], "q1": [1.0, -1.0], **LIMITS, **changed}
    with pytest.raises(kind, match=words):
        trajectory.state_to_state(arguments.pop("q0"), arguments.pop("q1"), **arguments)


def test_without_ruckig_the_error_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "ruckig", None)
    with pytest.raises(ImportError, match=r"needs ruckig: pip install 'irbkin\[time\]'$"):
        trajectory.state_to_state([0.0], [1.0], **LIMITS)
