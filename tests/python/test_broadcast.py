"""Leading dimensions of arguments are broadcast; `out` and threads change nothing."""

import os

import irbkin
import numpy as np
import pytest
from irbkin import Status

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
Q = np.random.default_rng(11).uniform(-0.9, 0.9, (3, 4, 6))
T = ROBOT.fk(Q)
SEED = np.full(6, 0.1)
LEADS = [((), (3, 4)), ((3, 4), ()), ((4,), (3, 4)), ((3, 1), (4,)), ((1,), (3, 1)), ((0,), (1,))]


def rows(values, lead, core):
    """Values of the leading dimensions `lead`."""
    return np.resize(values, (*lead, *values.shape[-core:]))


def each(call, lead, *arguments):
    """The answer to each row alone, of arguments with the dimensions of their rows."""
    arrays = [
        np.broadcast_to(array, (*lead, *array.shape[array.ndim - core :]))
        for array, core in arguments
    ]
    answers = [call(*(array[index] for array in arrays)) for index in np.ndindex(*lead)]
    return np.array(answers).reshape(*lead, 6)


@pytest.mark.parametrize(("poses", "seeds"), LEADS)
def test_nearest_broadcasts_poses_and_seeds(poses, seeds):
    T_rows, seed_rows = rows(T, poses, 2), rows(Q + 0.2, seeds, 1)
    lead = np.broadcast_shapes(poses, seeds)
    found = ROBOT.ik_nearest(T_rows, seed_rows)
    assert found.shape == (*lead, 6)
    np.testing.assert_array_equal(
        found, each(ROBOT.ik_nearest, lead, (T_rows, 2), (seed_rows, 1)).reshape(found.shape)
    )


def test_nearest_of_seven_axes_broadcasts_too():
    panda = irbkin.Robot("Panda")
    q = np.array([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])
    seeds = q + np.array([[0.1], [-0.1], [0.0]])
    found = panda.ik_nearest(panda.fk(q), seeds)
    assert found.shape == (3, 7)
    for row, seed in zip(found, seeds, strict=True):
        np.testing.assert_array_equal(row, panda.ik_nearest(panda.fk(q), seed))


@pytest.mark.parametrize(("poses", "others"), LEADS)
def test_configured_broadcasts_poses_configurations_and_seeds(poses, others):
    T_rows, wanted = rows(T, poses, 2), rows(np.stack(ROBOT.configuration(Q), -1), others, 1)
    lead = np.broadcast_shapes(poses, others)
    found = ROBOT.ik_configured(T_rows, wanted, fallback="nearest", seed=SEED)
    alone = each(
        lambda T, c: ROBOT.ik_configured(T, c, fallback="nearest", seed=SEED),
        lead,
        (T_rows, 2),
        (wanted, 1),
    )
    assert found.shape == (*lead, 6)
    np.testing.assert_array_equal(found, alone.reshape(found.shape))
    many = ROBOT.ik_configured(T, (0, 0, 0, 0), fallback="nearest", seed=Q[:, :1])
    assert many.shape == (3, 4, 6)
    if lead:
        alone = each(ROBOT.ik_nearest, (3, 4), (T, 2), (Q[:, :1], 1)).reshape(3, 4, 6)
        missing = np.isnan(ROBOT.ik_configured(T, (0, 0, 0, 0)))
        np.testing.assert_array_equal(many[missing], alone[missing])


def test_follow_broadcasts_paths_and_seeds():
    path = ROBOT.fk(np.linspace(Q[0, 0], Q[0, 1], 20))
    paths = np.stack([path, path[::-1]])
    alone = [[ROBOT.follow(each, seed) for each in paths] for seed in (SEED, -SEED, Q[0, 0])]
    seeds = np.stack([SEED, -SEED, Q[0, 0]])
    for threads in (1, 2):
        many = ROBOT.follow(paths, seeds[:, None], threads=threads)
        assert many.q.shape == (3, 2, 20, 6)
        assert many.orientation_error.shape == (3, 2, 20)
        for i, row in enumerate(alone):
            for j, one in enumerate(row):
                np.testing.assert_array_equal(many.q[i, j], one.q)
    from_each = ROBOT.follow(path, seeds)
    for one, q in zip(alone, from_each.q, strict=True):
        np.testing.assert_array_equal(q, one[0].q)
    np.testing.assert_array_equal(ROBOT.follow(paths, SEED).q[1], alone[0][1].q)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: ROBOT.ik_nearest(T, Q[:2]),
            r"seed of shape \(2, 4, 6\) cannot be broadcast with T of",
        ),
        (lambda: ROBOT.ik_configured(T, np.zeros((3, 4))), r"configuration of shape \(3, 4\)"),
        (
            lambda: ROBOT.ik_configured(T, np.zeros(4), fallback="nearest", seed=Q[0, :3]),
            r"seed of shape \(3, 6\) cannot be broadcast with T of shape \(3, 4, 4, 4\) and",
        ),
        (
            lambda: ROBOT.follow(T, Q[0, :2]),
            r"seed of shape \(2, 6\) cannot be broadcast with T of shape",
        ),
    ],
)
def test_shapes_that_do_not_go_together_are_named(call, words):
    with pytest.raises(irbkin.InvalidJointsError, match=words):
        call()


def test_what_stands_for_all_rows_is_refused_and_a_row_is_nan():
    with pytest.raises(irbkin.InvalidPoseError, match="pose row 3"):
        ROBOT.ik_nearest(2 * T[0, 0], Q)
    with pytest.raises(irbkin.InvalidJointsError, match="seed: joint 1 is NaN"):
        ROBOT.ik_nearest(T, np.full(6, np.nan))
    found = ROBOT.ik_nearest(np.stack([T[0, 0], 2 * T[0, 0]])[:, None], Q[0])
    np.testing.assert_array_equal(np.isnan(found).any(axis=(1, 2)), [False, True])
    np.testing.assert_array_equal(found[0], ROBOT.ik_nearest(T[0, 0], Q[0]))


OUT = {
    "ik_nearest": (lambda **out: ROBOT.ik_nearest(T, Q + 0.1, **out), lambda a: a),
    "ik_nearest of one": (lambda **out: ROBOT.ik_nearest(T[0, 0], SEED, **out), lambda a: a),
    "ik_configured": (
        lambda **out: ROBOT.ik_configured(T, ROBOT.configuration(Q), **out),
        lambda a: a,
    ),
    "ik_configured of one": (
        lambda **out: ROBOT.ik_configured(T[0, 0], ROBOT.configuration(Q[0, 0]), **out),
        lambda a: a,
    ),
    "link_frames": (lambda **out: ROBOT.link_frames(Q, **out), lambda a: a),
    "follow": (lambda **out: ROBOT.follow(T, SEED, **out), lambda a: (a[0], a[1])),
}


@pytest.mark.parametrize("name", OUT)
def test_out_is_written_and_returned(name):
    call, arrays = OUT[name]
    wanted = arrays(call())
    wanted = wanted if isinstance(wanted, tuple) else (wanted,)
    given = tuple(np.full_like(array, 7) for array in wanted)
    found = arrays(call(out=given if len(given) > 1 else given[0]))
    found = found if isinstance(found, tuple) else (found,)
    for one, other, right in zip(found, given, wanted, strict=True):
        assert one is other
        np.testing.assert_array_equal(one, right)
    for wrong in (tuple(np.zeros((2, 2)) for _ in given), tuple(a.astype("f4") for a in given)):
        with pytest.raises((TypeError, ValueError), match="out must be"):
            call(out=wrong if len(wrong) > 1 else wrong[0])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: ROBOT.ik_nearest(T, Q, out=Q), "must not overlap"),
        (lambda: ROBOT.follow(T, SEED, out=np.zeros((3, 4, 6))), "tuple of two arrays"),
    ],
)
def test_an_out_that_cannot_be_is_refused(call, words):
    with pytest.raises((TypeError, ValueError), match=words):
        call()


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "Panda"])
def test_threads_change_no_bit(name):
    robot = irbkin.Robot(name)
    rng = np.random.default_rng(12)
    count = 400 if name == "Panda" else 9_001
    q = rng.uniform(*np.clip(robot.limits.T, -7, 7), (count, robot.dof))
    poses, seeds = robot.fk(q), q + 0.1
    poses[::97] *= 2
    q[::89] = np.nan
    for call in (
        lambda threads: (robot.ik_nearest(poses, seeds, threads=threads),),
        lambda threads: robot.singularity(q, threads=threads),
    ):
        wanted = call(1)
        for threads in (2, 3, 0):
            for one, other in zip(call(threads), wanted, strict=True):
                np.testing.assert_array_equal(one, other)
    assert (robot.singularity(q).kinds[::89] == Status.INVALID).all()


def test_a_forked_process_has_threads_of_its_own():
    """The parent's are not there any more: nothing waits for them, and nothing ends."""
    poses = np.repeat(T.reshape(-1, 4, 4), 1_000, axis=0)
    wanted = ROBOT.ik_batch(poses, threads=2)
    child = os.fork()
    if child == 0:
        found = [ROBOT.ik_batch(poses, threads=2) for _ in range(3)]
        same = all(np.array_equal(one.q, wanted.q, equal_nan=True) for one in found)
        os._exit(0 if same else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    np.testing.assert_array_equal(ROBOT.ik_batch(poses, threads=2).q, wanted.q)
