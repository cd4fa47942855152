"""Many poses at once give what each gives alone."""

import irbkin
import numpy as np
import pytest
from irbkin import IkBatch, Status
from reference import apart, random_pose

MANY = 203  # no multiple of any lane count


def assert_same_bits(found, wanted):
    """Equal with the signs of zeros; not numbers are one like the other."""
    found, wanted = np.asarray(found), np.asarray(wanted)
    np.testing.assert_array_equal(found, wanted)
    np.testing.assert_array_equal(
        np.signbit(found) & ~np.isnan(found), np.signbit(wanted) & ~np.isnan(wanted)
    )


@pytest.fixture(scope="module")
def robot():
    return irbkin.Robot("IRB 2600-12/1.65")


@pytest.fixture(scope="module")
def poses(robot):
    """Reachable poses, poses out of reach, wrist-singular ones."""
    rng = np.random.default_rng(5)
    low, high = robot.limits.T
    q = rng.uniform(low, high, (MANY, 6))
    q[::10, 4] = 0
    made = robot.fk(q)
    made[1::10] = [random_pose(rng, 2.0) for _ in made[1::10]]
    return made


def test_batch_equals_single(robot, poses):
    batch = robot.ik_batch(poses)
    assert isinstance(batch, IkBatch)
    assert (batch.q.shape, batch.status.shape, batch.status.dtype) == (
        (MANY, 8, 6),
        (MANY, 8),
        np.uint8,
    )
    for pose, q, status in zip(poses, *batch, strict=True):
        single = robot.ik(pose)
        np.testing.assert_array_equal(status, single.status)
        assert_same_bits(q, single.q_by_slot)
    assert 0 < (batch.status == 0).all(axis=1).sum() < MANY
    assert (batch.status & Status.WRIST).any()


def strided(values):
    """Put other numbers between the numbers."""
    wide = np.full((*values.shape[:-1], 2 * values.shape[-1]), 99.0, values.dtype)
    wide[..., ::2] = values
    return wide[..., ::2]


KINDS = {
    "strided": strided,
    "reversed": lambda values: values[::-1],
    "Fortran order": np.asfortranarray,
    "float32": lambda values: values.astype(np.float32),
    "strided float32": lambda values: strided(values.astype(np.float32)),
    "big-endian": lambda values: values.astype(">f8"),
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_batch_of_every_kind_of_array_equals_single(robot, poses, kind):
    """A rotation in single precision is repaired: the same in a batch and alone."""
    given = KINDS[kind](poses[:101])
    for pose, q, status in zip(given, *robot.ik_batch(given), strict=True):
        single = robot.ik(pose)
        np.testing.assert_array_equal(status, single.status)
        assert_same_bits(q, single.q_by_slot)


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "Panda"])
@pytest.mark.parametrize("kind", [None, *KINDS])
def test_forward_batches_equal_single(name, kind):
    robot = irbkin.Robot(name)
    robot = robot.with_limits(np.tile([-np.inf, np.inf], (robot.dof, 1)))
    most = np.repeat([0.0, 3.0, 400.0, 9e4, 2e5], 21)[
        :, None
    ]  # the lanes count turns up to 1e5 rad
    q = most * np.random.default_rng(7).uniform(-1, 1, (most.size, robot.dof))
    given = KINDS[kind](q) if kind else q
    for found, wanted in (
        (robot.fk(given), [robot.fk(row) for row in given]),
        (robot.link_frames(given), [robot.link_frames(row) for row in given]),
        (robot.jacobian(given), [robot.jacobian(row) for row in given]),
        (robot.jacobian(given, frame="tool"), [robot.jacobian(row, frame="tool") for row in given]),
    ):
        assert_same_bits(found, wanted)


@pytest.mark.parametrize("threads", [1, 2, 3, 7, 0, 5000])
def test_threads_and_chunks_change_no_bit(robot, poses, threads):
    whole = robot.ik_batch(poses)
    for part, first in ((poses, 0), (poses[501:], 501), (poses[3:4], 3)):
        batch = robot.ik_batch(part, threads=threads)
        np.testing.assert_array_equal(batch.q, whole.q[first : first + len(part)])
        np.testing.assert_array_equal(batch.status, whole.status[first : first + len(part)])


@pytest.mark.parametrize("lead", [(), (1,), (0,), (2, 3), (2, 0, 3), (2, 3, 4, 1)])
def test_leading_dimensions_are_kept(lead):
    robot = irbkin.Robot("IRB 140-6/0.81")
    q = np.random.default_rng(1).uniform(-0.5, 0.5, (*lead, 6))
    poses = robot.fk(q)
    assert poses.shape == (*lead, 4, 4)
    assert robot.jacobian(q).shape == (*lead, 6, 6)
    assert robot.link_frames(q).shape == (*lead, 7, 4, 4)
    batch = robot.ik_batch(poses)
    assert (batch.q.shape, batch.status.shape) == ((*lead, 8, 6), (*lead, 8))
    if 0 not in lead:
        assert np.nanmin(apart(batch.q, q[..., None, :]), axis=-1).max(initial=0.0) <= 1e-9
    if lead:
        record = robot.singularity(q)
        for field in (
            "wrist",
            "elbow",
            "shoulder",
            "min_singular_value",
            "manipulability",
            "kinds",
        ):
            assert getattr(record, field).shape == lead


def test_out_takes_both_arrays_or_the_angles_alone():
    robot = irbkin.Robot("IRB 140-6/0.81")
    poses = robot.fk(np.random.default_rng(2).uniform(-0.5, 0.5, (5, 6)))
    wanted = robot.ik_batch(poses)
    q, status = np.empty((5, 8, 6)), np.empty((5, 8), dtype=np.uint8)
    for out in ((q, status), IkBatch(q, status)):
        q[:], status[:] = -1, 255
        batch = robot.ik_batch(poses, out=out)
        assert batch.q is q
        assert batch.status is status
        np.testing.assert_array_equal(q, wanted.q)
        np.testing.assert_array_equal(status, wanted.status)
    q[:] = -1
    batch = robot.ik_batch(poses, out=q)
    assert batch.q is q
    np.testing.assert_array_equal(q, wanted.q)
    np.testing.assert_array_equal(batch.status, wanted.status)


def bad_poses():
    """One pose for each fault, by name."""
    good = irbkin.Robot("IRB 140-6/0.81").fk([0.1] * 6)
    faults = {
        "nan": (0, 0, np.nan),
        "inf": (1, 3, np.inf),
        "last row": (3, 0, 0.5),
        "sheared": (0, 1, good[0, 1] + 2e-5),
    }
    found = {"mirrored": good @ np.diag([1, 1, -1, 1]), "scaled": good @ np.diag([2, 2, 2, 1])}
    for name, (i, j, value) in faults.items():
        found[name] = good.copy()
        found[name][i, j] = value
    return found


@pytest.mark.parametrize("name", bad_poses())
@pytest.mark.parametrize("threads", [1, 2])
def test_an_invalid_row_is_flagged_and_the_other_rows_are_solved(name, threads):
    robot = irbkin.Robot("IRB 140-6/0.81")
    poses = robot.fk(np.random.default_rng(3).uniform(-0.5, 0.5, (9, 6)))
    wanted = robot.ik_batch(poses)
    spoiled = poses.copy()
    spoiled[4] = bad_poses()[name]
    batch = robot.ik_batch(spoiled, threads=threads)
    assert (batch.status[4] == Status.INVALID).all()
    assert np.isnan(batch.q[4]).all()
    others = [0, 1, 2, 3, 5, 6, 7, 8]
    np.testing.assert_array_equal(batch.q[others], wanted.q[others])
    np.testing.assert_array_equal(batch.status[others], wanted.status[others])


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_joints_that_are_not_finite_give_nan_rows(value):
    robot = irbkin.Robot("Panda")
    q = np.random.default_rng(4).uniform(-0.5, 0.5, (3, 7))
    spoiled = q.copy()
    spoiled[1, 6] = value
    for method in (robot.fk, robot.link_frames, robot.jacobian):
        answer = method(spoiled)
        assert np.isnan(answer[1]).all()
        np.testing.assert_array_equal(answer[[0, 2]], method(q[[0, 2]]))
    record = robot.singularity(spoiled)
    assert np.isnan([record.min_singular_value[1], record.manipulability[1]]).all()
    assert record.kinds[1] == Status.INVALID
    assert not (record.kinds[[0, 2]] & Status.INVALID).any()


def test_a_pose_beyond_reach_has_status_zero():
    robot = irbkin.Robot("IRB 140-6/0.81")
    batch = robot.ik_batch(irbkin.pose([[5.0, 0, 0]][0]))
    assert (batch.status == 0).all()
    assert np.isnan(batch.q).all()


def test_nearest_takes_any_leading_shape_and_one_seed_for_all(robot, poses):
    few = poses[:12].reshape(3, 4, 4, 4)
    seed, weights = np.full(6, 0.1), [1, 1, 1, 0.1, 0.1, 0.1]
    nearest = robot.ik_nearest(few, seed, weights)
    assert nearest.shape == (3, 4, 6)
    np.testing.assert_array_equal(
        nearest, robot.ik_nearest(few, np.broadcast_to(seed, (3, 4, 6)), weights)
    )
    assert robot.ik_nearest(poses[:0], seed).shape == (0, 6)


def test_invalid_rows_of_a_nearest_batch_are_nan(robot):
    poses, seeds = robot.fk(np.full((4, 6), 0.2)), np.zeros((4, 6))
    poses[1, 0, 0] = np.nan
    seeds[2, 3] = np.inf
    nearest = robot.ik_nearest(poses, seeds)
    np.testing.assert_array_equal(np.isnan(nearest).all(axis=1), [False, True, True, False])
    with pytest.raises(
        irbkin.InvalidJointsError,
        match=r"seed of shape \(3, 6\) cannot be broadcast with T of shape \(4, 4, 4\): leading",
    ):
        robot.ik_nearest(poses, seeds[:3])
    with pytest.raises(irbkin.InvalidJointsError, match="weights: joint 2 is -1"):
        robot.ik_nearest(poses, seeds, [1, -1, 1, 1, 1, 1])


def test_instruction_sets_are_named_and_chosen():
    before = irbkin._core.instruction_set()
    assert irbkin._core.instruction_sets()[0] == "baseline"
    assert before in irbkin._core.instruction_sets()
    try:
        for name in irbkin._core.instruction_sets():
            irbkin._core.use_instruction_set(name)
            assert irbkin._core.instruction_set() == name
    finally:
        irbkin._core.use_instruction_set(before)
    with pytest.raises(ValueError, match='the instruction set "mmx" is not supported by this CPU'):
        irbkin._core.use_instruction_set("mmx")
