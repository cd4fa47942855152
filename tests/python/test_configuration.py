"""ABB's confdata through Python: shapes, the batch, what is refused, and taught targets."""

import irbkin
import numpy as np
import pytest
from irbkin import Configuration

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
Q = np.array([0.3, 0.2, 0.1, 0.4, 0.5, 0.7])


def random_joints(count, seed=1):
    low, high = ROBOT.limits.T
    return np.random.default_rng(seed).uniform(low, high, (count, 6))


def test_a_configuration_is_four_integers():
    configuration = ROBOT.configuration(np.deg2rad([-10, 20, -85, 100, -30, -280]))
    assert configuration == Configuration(cf1=-1, cf4=1, cf6=-4, cfx=3)
    assert all(type(number) is int for number in configuration)


def test_configurations_of_many_are_arrays_of_their_shape():
    q = random_joints(12).reshape(3, 4, 6)
    configurations = ROBOT.configuration(q)
    for number in configurations:
        assert number.shape == (3, 4)
        assert number.dtype == np.int32
    assert ROBOT.configuration(q[2, 1]) == tuple(int(number[2, 1]) for number in configurations)
    np.testing.assert_array_equal(configurations.cf4, np.floor(q[..., 3] / (np.pi / 2)))


def test_joint_vectors_are_found_again_by_their_configuration():
    q = random_joints(500)
    poses, configurations = ROBOT.fk(q), ROBOT.configuration(q)
    np.testing.assert_allclose(ROBOT.ik_configured(poses, configurations), q, rtol=0, atol=1e-8)
    for one, pose, *configuration in zip(q[:50], poses[:50], *configurations, strict=False):
        np.testing.assert_allclose(ROBOT.ik_configured(pose, configuration), one, rtol=0, atol=1e-8)


def test_one_configuration_goes_for_many_poses_and_rows_without_it_are_nan():
    poses = np.stack([ROBOT.fk(Q), np.full((4, 4), np.nan), ROBOT.fk([2.0, *Q[1:]])])
    found = ROBOT.ik_configured(poses, (0, 0, 0, 0))
    np.testing.assert_allclose(found[0], Q, rtol=0, atol=1e-12)
    assert np.isnan(found[1:]).all()
    found = ROBOT.ik_configured(poses, (0, 0, 0, 0), fallback="nearest", seed=Q)
    np.testing.assert_allclose(found[2], [2.0, *Q[1:]], rtol=0, atol=1e-12)
    assert np.isnan(found[1]).all()


def test_an_empty_batch_is_an_empty_answer():
    configurations = ROBOT.configuration(np.zeros((0, 6)))
    assert [number.shape for number in configurations] == [(0,)] * 4
    for configuration in ((0, 0, 0, 0), np.zeros((0, 4)), configurations):
        assert ROBOT.ik_configured(np.zeros((0, 4, 4)), configuration).shape == (0, 6)


def test_an_invalid_row_of_a_batch_is_nan_and_an_invalid_pose_an_error():
    skew, mirrored = ROBOT.fk(Q), ROBOT.fk(Q)
    skew[0, 0] += 0.1
    mirrored[:3, 0] *= -1
    found = ROBOT.ik_configured(np.stack([skew, ROBOT.fk(Q), mirrored]), (0, 0, 0, 0))
    assert np.isnan(found[[0, 2]]).all()
    np.testing.assert_allclose(found[1], Q, rtol=0, atol=1e-12)
    for broken in (skew, mirrored, np.full((4, 4), np.nan)):
        with pytest.raises(irbkin.InvalidPoseError):
            ROBOT.ik_configured(broken, (0, 0, 0, 0))
    seeds = np.stack([Q, np.full(6, np.nan)])
    found = ROBOT.ik_configured(
        np.stack([ROBOT.fk(Q)] * 2), (2, 0, 0, 0), fallback="nearest", seed=seeds
    )
    np.testing.assert_allclose(found[0], Q, rtol=0, atol=1e-12)
    assert np.isnan(found[1]).all()


def test_a_single_pose_without_the_configuration_lists_those_that_exist():
    with pytest.raises(
        irbkin.UnreachableError, match=r"has the configuration \[2, 0, 0, 0\]; there are \[0, -4,"
    ) as caught:
        ROBOT.ik_configured(ROBOT.fk(Q), (2, 0, 0, 0))
    existing = caught.value.configurations
    assert Configuration(0, 0, 0, 0) in existing
    assert set(existing) == {ROBOT.configuration(turn.q) for turn in ROBOT.ik(ROBOT.fk(Q)).turns()}
    nearest = ROBOT.ik_configured(ROBOT.fk(Q), (2, 0, 0, 0), fallback="nearest", seed=Q)
    np.testing.assert_allclose(nearest, Q, rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", [None, Q])
def test_a_slot_that_the_arm_does_not_have_is_refused_in_a_batch_too(seed):
    pose = np.stack([ROBOT.fk(Q)] * 2)
    fallback = None if seed is None else "nearest"
    with pytest.raises(irbkin.InvalidJointsError, match="cfx is 9, it must be 0 to 7"):
        ROBOT.ik_configured(pose, [(0, 0, 0, 0), (0, 0, 0, 9)], fallback=fallback, seed=seed)
    with pytest.raises(irbkin.InvalidJointsError, match="its four numbers have different shapes"):
        ROBOT.ik_configured(pose, irbkin.records.ConfigurationBatch(np.zeros(2), 0, 0, 0))
    with pytest.raises(
        irbkin.InvalidJointsError, match="it must be a whole number of at most 2147483647"
    ):
        ROBOT.ik_configured(pose, (2**31, 0, 0, 0))


@pytest.mark.parametrize("value", [np.inf, np.nan, -2e5])
def test_a_row_that_is_not_finite_has_the_least_numbers_and_no_solution(value):
    """A single joint vector is refused; in a batch the other rows stay as they are."""
    q = random_joints(4).reshape(2, 2, 6)
    wanted, poses = np.stack(ROBOT.configuration(q), axis=-1), ROBOT.fk(q)
    q[1, 0, 3] = value
    with pytest.raises(irbkin.InvalidJointsError, match="q: joint 4 is"):
        ROBOT.configuration(q[1, 0])
    counted = ROBOT.configuration(q)
    wanted[1, 0] = np.iinfo(np.int32).min
    np.testing.assert_array_equal(np.stack(counted, axis=-1), wanted)
    for fallback in ({}, {"fallback": "nearest", "seed": np.zeros(6)}):
        found = ROBOT.ik_configured(poses, counted, **fallback)
        assert (np.isnan(found).any(axis=-1) == [[False, False], [True, False]]).all()
