"""Laws of plans: smooth, bounded in time, through singular poses, without arbitrary ties."""

from __future__ import annotations

import signal
import time

import irbkin
import numpy as np
import pytest

ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
TRACK = irbkin.Track("y", -0.4, 0.4)


def weld(count: int) -> np.ndarray:
    """A circle, the torch 30 degrees off the vertical and turning with it."""
    return np.array(
        [
            irbkin.pose(
                [1.0 + 0.15 * np.cos(angle), 0.15 * np.sin(angle), 0.5],
                euler_zyx=[angle, np.pi - np.radians(30), 0],
            )
            for angle in np.linspace(0, 2 * np.pi, count)
        ]
    )


def tilting(count: int) -> np.ndarray:
    """A seam along which the torch tilts."""
    return np.array(
        [
            irbkin.pose(
                [1.0, -0.5 + part, 0.5 + 0.1 * np.sin(6 * part)],
                euler_zyx=[0.8 * np.sin(9 * part), np.pi - 0.5 - 0.4 * np.sin(7 * part), 0],
            )
            for part in np.linspace(0, 1, count)
        ]
    )


def duration(plan: irbkin.Plan) -> float:
    return irbkin.trajectory.retime(plan.q, ROBOT.max_velocity, 8.0).duration


@pytest.mark.parametrize("path", [weld, tilting])
@pytest.mark.parametrize("order", ["bottleneck", "sum"])
@pytest.mark.parametrize("free", ["rotation", "tolerance"])
def test_what_is_free_never_slows_the_timed_motion_down(path, order, free):
    options = {"rotation": 36} if free == "rotation" else {"tolerance": irbkin.ToolCone(0.2)}
    times = []
    for count in (101, 401, 1601):
        T = path(count)
        plan = ROBOT.plan(T, order=order, **options)
        assert plan.certified
        times.append(duration(plan))
        assert times[-1] <= 1.02 * duration(ROBOT.plan(T, order=order))
    assert max(times) <= 1.1 * min(times)


@pytest.mark.parametrize("path", [weld, tilting])
@pytest.mark.parametrize("options", [{}, {"rotation": 36}, {"tolerance": irbkin.ToolCone(0.2)}])
def test_the_plan_for_time_is_the_fastest_of_all(path, options):
    T = path(201)
    plan = ROBOT.plan(T, objective="time", max_acceleration=8.0, **options)
    assert plan.certified
    for order in ("bottleneck", "sum"):
        assert duration(plan) <= duration(ROBOT.plan(T, order=order, **options)) + 1e-9
    each = ROBOT.plan(T, objective="time", max_acceleration=np.full(6, 8.0), **options)
    np.testing.assert_array_equal(each.q, plan.q)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"objective": "time"}, "needs max_acceleration"),
        ({"max_acceleration": 8.0}, "pass that, or time the plan"),
        ({"objective": "fast", "max_acceleration": 8.0}, 'must be "time" or None, got "fast"'),
        ({"objective": "time", "max_acceleration": 0.0}, r"max_acceleration\[0\]"),
        ({"objective": "time", "max_acceleration": np.nan}, r"max_acceleration\[0\] is NaN"),
        ({"objective": "time", "max_acceleration": np.ones(5)}, r"shape \(6,\), got \(5,\)"),
        ({"objective": "time", "max_acceleration": 1.0, "times": np.arange(9.0)}, "leave them out"),
    ],
)
def test_an_objective_that_does_not_fit_is_refused(options, words):
    with pytest.raises(ValueError, match=words):
        ROBOT.plan(weld(9), **options)


def test_a_tolerance_never_raises_the_bottleneck():
    for path in (weld, tilting):
        for count in (9, 40, 101):
            T = path(count)
            fixed = ROBOT.plan(T).bottleneck
            for angle in (0.01, 0.1):
                tolerant = ROBOT.plan(T, tolerance=irbkin.ToolCone(angle))
                assert tolerant.bottleneck <= fixed * (1 + 1e-9)


def seconds_of(call) -> float:
    begin = time.process_time()
    with pytest.raises(irbkin.PathError):
        call()
    return time.process_time() - begin


def test_the_work_on_a_path_is_bounded():
    robot = irbkin.Robot("GoFa 5")
    first, last = np.radians([[176, 175, -73, 162, 25, 57], [177, 177, -63, 161, 36, 58]])
    line = irbkin.paths.line(robot.fk(first), robot.fk(last), steps=3)
    two = irbkin.ToolRotation(steps=2, lower=-np.radians(23), upper=np.radians(23))
    assert seconds_of(lambda: robot.plan(line, rotation=two)) < 10
    with pytest.raises(irbkin.PathError, match="given up"):
        robot.plan(line, rotation=two)


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "UR5e", "GoFa 5"])
def test_a_thousand_poses_without_a_path_take_seconds(name):
    robot = irbkin.Robot(name)
    T = robot.fk(np.random.default_rng(3).uniform(-2, 2, (1000, 6)))
    assert seconds_of(lambda: robot.plan(T, rotation=5)) < 10


def cpu_of(call) -> float:
    begin = time.process_time()
    call()
    return time.process_time() - begin


@pytest.mark.parametrize(
    "options",
    [
        {"rotation": 36},
        {"rotation": 18, "objective": "time", "max_acceleration": 10.0},
        {"rotation": 6, "tolerance": irbkin.ToolCone(0.2)},
        {"rotation": 6, "carrier": TRACK},
        {"rotation": 18, "carrier": TRACK, "order": "sum"},
        {"rotation": 6, "carrier": TRACK, "objective": "time", "max_acceleration": 10.0},
    ],
)
def test_a_limit_cost_takes_at_most_three_times_as_long(options):
    """Joints of +-360 degrees have 64 combinations of turns at each node; few of them may win."""

    def stop(*_):
        pytest.fail("the plan with a limit cost takes too long")

    robot = irbkin.Robot("UR5e")
    q = np.array([[0.67, 4.09, 2.38, 2.53, 2.25, 0.84], [0.57, 3.81, 2.39, 2.19, 1.92, 1.28]])
    line = irbkin.paths.line(*robot.fk(q), steps=7)
    # The clock of CPU time has steps of some milliseconds.
    plain = max(0.05, *(cpu_of(lambda: robot.plan(line, **options)) for _ in range(3)))
    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, 3 * plain)
    try:
        robot.plan(line, limit_cost=10.0, **options)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def test_failing_takes_time_in_proportion_to_the_poses():
    ends = [irbkin.pose([x, 0, 0.7], euler_zyx=[0, 2.8, 0]) for x in (0.9, 2.5)]
    robot = irbkin.Robot("IRB 2600-12/1.65")

    def least(count):
        T = irbkin.paths.line(*ends, steps=count)
        return min(seconds_of(lambda: robot.plan(T)) for _ in range(3))

    # Eight times as many poses: 64 times the time if it grew with the square.
    assert least(16_000) < 24 * least(2_000)


@pytest.mark.parametrize("name", ["UR5e", "UR3", "IRB 2600-12/1.65"])
def test_a_line_into_and_out_of_a_wrist_singularity_has_a_plan(name):
    robot, rng = irbkin.Robot(name), np.random.default_rng(5)
    lower, upper = 0.9 * np.clip(robot.limits, -np.pi, np.pi).T
    found = tried = 0
    for _ in range(60):
        last = rng.uniform(lower, upper)
        last[4] = 0.0
        first = last + rng.uniform(-0.1, 0.1, 6)
        T = irbkin.paths.line(robot.fk(first), robot.fk(last), steps=9)
        fine = irbkin.paths.line(T[0], T[-1], steps=4001)[:-1]
        follows = robot.follow(fine, first)
        if follows.breaks or np.abs(np.diff(follows.q, axis=0)).max() > 0.02:
            continue
        for path, options in [(T, {}), (T[::-1], {}), (T, {"start": first})]:
            tried += 1
            try:
                plan = robot.plan(path, **options)
            except irbkin.PathError:
                continue
            found += 1
            assert plan.certified
            np.testing.assert_allclose(robot.fk(plan.q), path, atol=1e-9)
    assert tried > 60
    assert found >= 0.97 * tried


@pytest.mark.parametrize("count", [5, 101, 1000])
def test_of_equal_branches_the_one_amid_its_limits_is_taken(count):
    robot = irbkin.Robot("IRB 2600-12/1.65")
    ends = [irbkin.pose([0.9, y, 0.7], euler_zyx=[0, 2.8, 0]) for y in (-0.3, 0.3)]
    plan = robot.plan(irbkin.paths.line(*ends, steps=count))
    assert np.abs(plan.q[:, 3]).max() < np.radians(20)


@pytest.mark.parametrize("name", ["UR5e", "IRB 2600-12/1.65"])
@pytest.mark.parametrize(
    "free",
    [
        {"rotation": irbkin.ToolRotation(steps=9, lower=-0.3, upper=0.3)},
        {"tolerance": irbkin.ToolCone(0.2)},
    ],
)
def test_the_shortest_motion_is_never_longer_than_that_of_a_fixed_tool(name, free):
    rng, robot, found = np.random.default_rng(5), irbkin.Robot(name), 0
    limits = {"max_acceleration": 8.0}
    for _ in range(12):
        q = rng.uniform(-1.5, 1.5, 6)
        T = irbkin.paths.line(robot.fk(q), robot.fk(q + rng.uniform(-0.5, 0.5, 6)), steps=33)
        try:
            fixed = robot.plan(T)
        except irbkin.PathError:
            continue
        best = robot.plan(T, objective="time", **limits, **free)
        times = [
            irbkin.trajectory.retime(plan.q, robot.max_velocity, 8.0).duration
            for plan in (best, fixed)
        ]
        assert times[0] <= times[1] * (1 + 1e-9)
        found += 1
    assert found > 5
