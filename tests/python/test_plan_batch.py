"""`Robot.plan_batch`: the answers of `plan`, in their places, on any number of threads."""

import pickle
import threading
import time

import irbkin
import numpy as np
import pytest

ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))


def seams(count: int, poses: int = 60) -> list[np.ndarray]:
    """Straight seams of different lengths; in every fifth one a pose is out of reach."""
    rng = np.random.default_rng(8)
    paths = []
    for number in range(count):
        ends = [
            irbkin.pose(rng.uniform([0.7, -0.4, 0.4], [1.1, 0.4, 0.8]), euler_zyx=[0, 2.7, 0.2])
            for _ in range(2)
        ]
        path = irbkin.paths.line(*ends, steps=poses + number)
        if number % 5 == 4:
            path[number, 2, 3] += 3.0
        paths.append(path)
    return paths


def alone(path: np.ndarray, **options: object) -> irbkin.Plan | irbkin.IrbkinError:
    try:
        return ROBOT.plan(path, **options)
    except irbkin.IrbkinError as error:
        return error


def assert_equal(found: object, wanted: object) -> None:
    if isinstance(wanted, irbkin.Plan):
        assert found == wanted
        return
    assert type(found) is type(wanted)
    assert str(found) == str(wanted)
    if isinstance(wanted, irbkin.PathError):
        assert isinstance(found, irbkin.PathError)
        assert (found.index, found.reasons) == (wanted.index, wanted.reasons)
        assert found.plan == wanted.plan


@pytest.mark.parametrize("options", [{}, {"rotation": 24}, {"weights": [3, 1, 1, 1, 1, 1]}])
@pytest.mark.parametrize("threads", [1, 2, 0])
def test_each_path_has_the_answer_that_it_has_alone(threads, options):
    # With 90 paths there is work for two threads.
    paths = seams(90)
    answers = ROBOT.plan_batch(paths, threads=threads, **options)
    assert len(answers) == len(paths)
    for answer, path in zip(answers, paths, strict=True):
        assert_equal(answer, alone(path, **options))
    kinds = [type(answer) for answer in answers]
    assert kinds.count(irbkin.Plan) > 20
    assert kinds.count(irbkin.PathError) >= 18


def test_one_array_of_paths_is_as_good():
    paths = np.array([path[:50] for path in seams(6)])
    for answer, path in zip(ROBOT.plan_batch(paths), paths, strict=True):
        assert_equal(answer, alone(path))
    assert ROBOT.plan_batch([]) == ()
    assert ROBOT.plan_batch(path for path in paths[:2]) == ROBOT.plan_batch(paths[:2])


def test_starts_ends_and_times_are_of_each_path_or_of_all():
    path = seams(1)[0]
    first = ROBOT.ik(path[0]).within_limits()
    starts = np.array([first[0].q, first[1].q])
    answers = ROBOT.plan_batch([path, path], start=starts)
    for answer, start in zip(answers, starts, strict=True):
        assert_equal(answer, alone(path, start=start))
    for answer in ROBOT.plan_batch([path, path], start=starts[0]):
        assert_equal(answer, alone(path, start=starts[0]))
    times = [np.linspace(0, duration, len(path)) for duration in (0.01, 60.0)]
    answers = ROBOT.plan_batch([path, path], times=times)
    for answer, own in zip(answers, times, strict=True):
        assert_equal(answer, alone(path, times=own))
    assert [type(answer) for answer in answers] == [irbkin.PathError, irbkin.Plan]


def test_a_path_that_is_none_has_its_error_in_its_place():
    good, nan, flipped = seams(1)[0], seams(1)[0], seams(1)[0]
    nan[3, 1, 3] = np.nan
    flipped[1:, :3, :3] = flipped[1:, :3, :3] @ np.diag([1.0, -1.0, -1.0])
    empty = good[:0]
    paths = [good, nan, empty, flipped, good]
    answers = ROBOT.plan_batch(paths, threads=2)
    for answer, path in zip(answers, paths, strict=True):
        assert_equal(answer, alone(path))
    wanted = [
        irbkin.Plan,
        irbkin.InvalidPoseError,
        irbkin.InvalidMotionError,
        irbkin.InvalidMotionError,
        irbkin.Plan,
    ]
    assert [type(answer) for answer in answers] == wanted
    assert "T[3]" in str(answers[1])


def test_a_call_that_is_none_fails_before_any_work():
    path = seams(1)[0]
    for arguments, error, message in [
        ({"paths": [path, path[0]]}, irbkin.InvalidPoseError, r"paths\[1\] must have shape"),
        ({"paths": path}, irbkin.InvalidPoseError, r"paths\[0\] must have shape \(m, 4, 4\)"),
        ({"paths": 3}, TypeError, "iterable"),
        ({"paths": [path], "threads": -1}, ValueError, "threads"),
        ({"paths": [path], "rotation": 0}, irbkin.InvalidMotionError, "2 to 3600"),
        ({"paths": [path], "times": [[0, 1]] * 2}, irbkin.InvalidMotionError, "1 arrays"),
        ({"paths": [path], "times": [3.0]}, irbkin.InvalidMotionError, r"times\[0\]"),
        ({"paths": [path], "start": np.zeros((2, 6))}, irbkin.InvalidJointsError, r"\(1, 6\)"),
        ({"paths": [path], "weights": [1, 2]}, irbkin.InvalidJointsError, "weights"),
    ]:
        with pytest.raises(error, match=message):
            ROBOT.plan_batch(**arguments)
    with pytest.raises(irbkin.InvalidModelError, match="plan_batch"):
        irbkin.Robot("Panda").plan_batch([path])


def test_accept_is_asked_by_all_threads_and_its_exception_ends_the_call():
    paths, threads = seams(90), set()

    def accept(q):
        threads.add(threading.get_ident())
        return q[:, 0] < 0.3

    answers = ROBOT.plan_batch(paths, accept=accept, threads=2)
    for answer, path in zip(answers[:10], paths[:10], strict=True):
        assert_equal(answer, alone(path, accept=accept))
    planned = [answer for answer in answers if isinstance(answer, irbkin.Plan)]
    assert planned
    assert all((plan.q[:, 0] < 0.3).all() for plan in planned)
    assert any("rejected by accept" in str(answer) for answer in answers)

    def broken(q):
        raise RuntimeError("no scene")

    for count in (1, 2):
        with pytest.raises(RuntimeError, match="no scene"):
            ROBOT.plan_batch(paths, accept=broken, threads=count)


def test_answers_pickle():
    """So that they can come from another machine."""
    answers = ROBOT.plan_batch(seams(5))
    again = pickle.loads(pickle.dumps(answers))
    assert [type(answer) for answer in answers][3:] == [irbkin.Plan, irbkin.PathError]
    for found, wanted in zip(again, answers, strict=True):
        assert_equal(found, wanted)


def test_other_threads_go_on_meanwhile():
    worker = threading.Thread(target=lambda: ROBOT.plan_batch(seams(90), rotation=36, threads=2))
    worker.start()
    ticks = 0
    while worker.is_alive():
        time.sleep(1e-3)
        ticks += 1
    # With the interpreter's lock held there is a tick at the beginning and one at the end.
    assert ticks > 20


def test_carriers_and_tolerances_are_those_of_plan():
    ends = [irbkin.pose([1.1, y, 0.6], euler_zyx=[0, 2.7, 0]) for y in (-2.0, 2.0)]
    T = irbkin.paths.line(*ends, steps=30)
    options = {"carrier": irbkin.Track("y", -2, 2, 9), "tolerance": irbkin.ToolOffset(-0.01, 0.01)}
    plan = ROBOT.plan(T, **options)
    start = np.concatenate([plan.q[0], plan.external[0]])
    both = ROBOT.plan_batch([T, T[:20]], start=start, threads=2, **options)
    assert both[0] == ROBOT.plan(T, start=start, **options)
    np.testing.assert_array_equal(both[1].external[0], plan.external[0])
