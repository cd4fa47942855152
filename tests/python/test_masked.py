"""Masked elements are never read: a single argument is refused by name, a row of a batch is
invalid.
"""

import irbkin
import numpy as np
import pytest
from irbkin import InvalidJointsError, InvalidModelError, InvalidPoseError

ROBOTS = {
    name: irbkin.Robot(name) for name in ("IRB 2600-12/1.65", "IRB 2400-10/1.55", "UR5e", "Panda")
}
Q = {6: np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]), 7: np.array([0.1, 0.2, 0.3, -1.4, 0.5, 1.6, 0.7])}
SIX = ROBOTS["IRB 2600-12/1.65"]
POSE = SIX.fk(Q[6])


def masked(array, *index, dtype=None):
    """The array as a masked one, an element of it masked."""
    array = np.ma.array(array, dtype=dtype)
    array[index] = np.ma.masked
    return array


def forms(array, *index):
    """The same masked array in every form in which it may come, contiguous float64 first."""
    whole = masked(array, *index)
    yield whole
    yield masked(array, *index, dtype=np.float32)
    yield masked(np.asfortranarray(array), *index)
    yield list(whole)
    yield tuple(whole)
    wide = np.ma.array(np.repeat(array, 2, axis=-1))
    wide[(*index[:-1], 2 * index[-1])] = np.ma.masked
    yield wide[..., ::2]


SINGLE = {
    "fk": lambda v: SIX.fk(v),
    "jacobian": lambda v: SIX.jacobian(v),
    "link_frames": lambda v: SIX.link_frames(v),
    "singularity": lambda v: SIX.singularity(v),
    "configuration": lambda v: SIX.configuration(v),
    "a seed": lambda v: SIX.ik_nearest(POSE, v),
    "a seed of all poses": lambda v: SIX.ik_nearest(POSE[None], v),
    "weights": lambda v: SIX.ik_nearest(POSE, Q[6], weights=v),
    "a choice": lambda v: SIX.ik(POSE).nearest(v),
    "a path's seed": lambda v: SIX.follow(POSE[None], v),
}
FIELDS = {
    "fk": "q",
    "jacobian": "q",
    "link_frames": "q",
    "singularity": "q",
    "configuration": "q",
    "weights": "weights",
}


@pytest.mark.parametrize("name", SINGLE)
def test_a_joint_vector_with_a_masked_element_is_refused(name):
    field = FIELDS.get(name, "seed")
    for value in forms(Q[6], 2):
        if not isinstance(value, np.ma.MaskedArray):
            # Elements of a masked vector are numbers; a list of them contains NaN, also an error.
            continue
        with pytest.raises(
            InvalidJointsError, match=rf"^{field}\[2\] is masked: every element must be given"
        ):
            SINGLE[name](value)


TAKING_A_POSE = {
    "ik": lambda v: SIX.ik(v),
    "ik_nearest": lambda v: SIX.ik_nearest(v, Q[6]),
    "check_pose": lambda v: SIX.check_pose(v),
    "ik_batch": lambda v: SIX.ik_batch(v),
    "ik_configured": lambda v: SIX.ik_configured(v, [0, 0, 0, 0]),
    "with_tool": lambda v: SIX.with_tool(v),
    "with_base": lambda v: SIX.with_base(v),
    "to_xyz_wxyz": irbkin.to_xyz_wxyz,
    "to_xyz_euler_zyx": irbkin.to_xyz_euler_zyx,
}


@pytest.mark.parametrize("name", TAKING_A_POSE)
def test_a_pose_with_a_masked_element_is_refused(name):
    for value in forms(POSE, 1, 3):
        with pytest.raises(
            InvalidPoseError, match=r"^T\[1, 3\] is masked: every element must be given"
        ):
            TAKING_A_POSE[name](value)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: irbkin.pose(masked([0.1, 0.2, 0.3], 1)), InvalidPoseError, r"xyz\[1\] is masked"),
        (
            lambda: irbkin.pose([0, 0, 0], masked([1.0, 0, 0, 0], 3)),
            InvalidPoseError,
            r"wxyz\[3\] is masked",
        ),
        (
            lambda: SIX.with_limits(masked(SIX.limits, 4, 1)),
            InvalidModelError,
            r"limits\[4, 1\] is masked",
        ),
        (
            lambda: irbkin.Robot.from_mdh(masked(SIX.mdh, 2, 0)),
            InvalidModelError,
            r"rows\[2, 0\] is masked",
        ),
        (
            lambda: irbkin.Robot.from_sdh(list(masked(SIX.mdh, 2, 0))),
            InvalidModelError,
            r"rows\[2, 0\] is masked",
        ),
        (
            lambda: SIX.ik_configured(POSE, masked([0, 0, 0, 0], 3)),
            InvalidJointsError,
            r"configuration\[3\] is masked",
        ),
        (
            lambda: SIX.ik_configured(POSE[None], irbkin.Configuration(*[masked([0], 0)] * 4)),
            InvalidJointsError,
            r"configuration\[0, 0\] is masked",
        ),
    ],
)
def test_other_arguments_with_masked_elements_are_refused(call, error, words):
    with pytest.raises(error, match=words):
        call()


@pytest.mark.parametrize("name", ROBOTS)
def test_a_row_of_a_batch_with_a_masked_element_is_invalid_and_no_other(name):
    robot = ROBOTS[name]
    q = np.tile(Q[robot.dof], (5, 1))
    poses = robot.fk(q)
    q7 = () if robot.dof == 6 else (0.7,)
    good = [0, 1, 3, 4]
    for value in forms(q, 2, 3):
        np.testing.assert_array_equal(
            robot.fk(value)[good], robot.fk(np.asarray(value, dtype=float))[good]
        )
        assert np.isnan(robot.fk(value)[2]).all()
        assert np.isnan(robot.jacobian(value)[2]).all()
        assert np.isnan(robot.link_frames(value)[2]).all()
        assert np.isnan(robot.singularity(value).manipulability[2])
        nearest = robot.ik_nearest(poses, value)
        assert np.isnan(nearest[2]).all()
        assert np.isfinite(nearest[good]).all()
    for value in forms(poses, 2, 0, 3):
        batch = robot.ik_batch(value, *q7)
        assert (batch.status[2] == irbkin.Status.INVALID).all()
        assert np.isnan(batch.q[2]).all()
        assert (batch.status[good, 0] & irbkin.Status.INVALID == 0).all()
        assert np.isfinite(batch.q[good]).any(axis=(1, 2)).all()
        assert np.isnan(robot.ik_nearest(value, q[0])[2]).all()
    if robot.dof == 7:
        batch = robot.ik_batch(poses, masked(np.full(5, 0.7), 2))
        assert (batch.status[2] == irbkin.Status.INVALID).all()
        assert np.isfinite(batch.q[good]).any(axis=(1, 2)).all()


def test_a_path_with_a_masked_pose_is_refused():
    path = SIX.fk(np.tile(Q[6], (5, 1)))
    with pytest.raises(InvalidPoseError, match=r"^T\[3\]: pose\[1, 2\] is NaN"):
        SIX.follow(masked(path, 3, 1, 2), Q[6])


def test_without_a_masked_element_the_numbers_are_taken():
    for value in (
        np.ma.array(Q[6]),
        np.ma.array(Q[6], mask=False),
        np.ma.array(Q[6], mask=[False] * 6),
    ):
        np.testing.assert_array_equal(SIX.fk(value), POSE)
    np.testing.assert_array_equal(SIX.ik(np.ma.array(POSE)).q, SIX.ik(POSE).q)
    np.testing.assert_array_equal(
        SIX.ik_batch(np.ma.array([POSE] * 3)).q, SIX.ik_batch(np.array([POSE] * 3)).q
    )
    np.testing.assert_array_equal(SIX.fk([np.ma.array(Q[6])] * 2), SIX.fk(np.array([Q[6]] * 2)))
    out = np.ma.zeros((4, 4))
    assert SIX.fk(Q[6], out=out) is out
    np.testing.assert_array_equal(out, POSE)


def test_an_answer_is_not_written_under_a_mask():
    for call in (
        lambda out: SIX.fk(Q[6], out=out),
        lambda out: SIX.fk(Q[6][None], out=out[None]),
    ):
        with pytest.raises(
            ValueError,
            match=r"^out\[(0, )?1, 1\] is masked: out must be an array without masked elem",
        ):
            call(masked(np.zeros((4, 4)), 1, 1))


def test_masked_non_numeric_input_is_a_type_error():
    for value in (
        np.ma.array(Q[6] * 1j, mask=True),
        np.ma.array(Q[6] > 0, mask=True),
        np.ma.array(["a"] * 6, mask=True),
    ):
        with pytest.raises(TypeError, match="must be real numbers, got an array of dtype"):
            SIX.fk(value)


def test_lists_in_lists_end():
    endless = []
    endless.append(endless)
    with pytest.raises((InvalidJointsError, TypeError), match=r"^q must be"):
        SIX.fk(endless)
