"""Any array-like goes in, `out` is written or refused: what kinds of arrays are taken, and how."""

from array import array

import irbkin
import numpy as np
import pytest

Q = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])


@pytest.fixture(scope="module")
def robot():
    return irbkin.Robot("IRB 2600-12/1.65")


@pytest.fixture(scope="module")
def many(robot):
    """Twenty joint vectors."""
    return np.random.default_rng(1).uniform(-0.7, 0.7, (20, 6))


def strided(values):
    """Put other numbers between the numbers."""
    wide = np.full((*values.shape, 2), 99.0)
    wide[..., 0] = values
    return wide[..., 0]


def read_only(values):
    copy = values.copy()
    copy.flags.writeable = False
    return copy


def misaligned(values):
    """Put the numbers at an odd address, as a packed binary record holds them."""
    record = np.zeros(1, dtype=np.dtype([("tag", "u1"), ("values", "f8", values.shape)]))
    record["values"][0] = values
    return record["values"][0]


EXACT = {
    "list": np.ndarray.tolist,
    "tuple": lambda values: tuple(map(tuple, values)),
    "list of arrays": list,
    "Fortran order": np.asfortranarray,
    "strided": strided,
    "reversed": lambda values: np.ascontiguousarray(values[::-1, ::-1])[::-1, ::-1],
    "read-only": read_only,
    "big-endian": lambda values: values.astype(">f8"),
    "long double": lambda values: values.astype(np.longdouble),
    "memoryview": memoryview,
}


@pytest.mark.parametrize("kind", EXACT)
def test_every_kind_of_array_gives_the_same_answer(robot, many, kind):
    for method in (robot.fk, robot.link_frames, robot.jacobian):
        np.testing.assert_array_equal(method(EXACT[kind](many)), method(many))
    poses = robot.fk(many)
    other = memoryview(poses) if kind == "memoryview" else [EXACT[kind](pose) for pose in poses]
    np.testing.assert_array_equal(robot.ik_batch(other).q, robot.ik_batch(poses).q)
    np.testing.assert_array_equal(robot.ik(EXACT[kind](poses[0])).q, robot.ik(poses[0]).q)


def test_a_single_vector_may_be_any_sequence_of_numbers(robot):
    wanted = robot.fk(Q)
    for given in (Q.tolist(), tuple(Q), array("d", Q), strided(Q), Q.astype(">f8"), read_only(Q)):
        np.testing.assert_array_equal(robot.fk(given), wanted)
    np.testing.assert_array_equal(robot.fk(robot.ik(wanted)[0]), robot.fk(robot.ik(wanted).q[0]))


def test_a_list_of_any_numbers_is_read_as_its_array_is(robot):
    for given in ([0, 1, 0, -1, 0.5, 0], list(Q), [np.float32(0.1), 0, 0, 0, 0, 0]):
        np.testing.assert_array_equal(robot.fk(given), robot.fk(np.array(given, dtype=float)))
    for wrong in (
        [0.1] * 5,
        [*Q[:5], "0.6"],
        [*Q[:5], None],
        [*Q[:5], 1j],
        [*Q[:5], np.nan],
        [*Q[:5], 10**400],
        [*Q[:5], [0.6]],
        [True] * 6,
    ):
        with pytest.raises((TypeError, ValueError)) as by_list:
            robot.fk(wrong)
        with pytest.raises((TypeError, ValueError)) as by_tuple:
            robot.fk(tuple(wrong))
        assert (by_list.type, str(by_list.value)) == (by_tuple.type, str(by_tuple.value))


def test_a_misaligned_array_is_taken_too(robot, many):
    """Records that were read from a packed file stand at odd addresses."""
    assert not misaligned(Q).flags.aligned
    np.testing.assert_array_equal(robot.fk(misaligned(Q)), robot.fk(Q))
    np.testing.assert_array_equal(robot.fk(misaligned(many)), robot.fk(many))
    np.testing.assert_array_equal(robot.ik(misaligned(robot.fk(Q))).q, robot.ik(robot.fk(Q)).q)


@pytest.mark.parametrize("dtype", ["f2", "f4", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8"])
def test_every_real_number_type_is_accepted_with_its_value(robot, dtype):
    given = np.array([1, 0, 1, 2, 1, 3], dtype=dtype)
    np.testing.assert_array_equal(robot.fk(given), robot.fk(given.astype(float)))
    np.testing.assert_array_equal(
        robot.jacobian(given[None]), robot.jacobian(given[None].astype(float))
    )


def test_the_input_is_not_changed(robot, many):
    q, poses = many.copy(), robot.fk(many)
    kept = poses.copy()
    (
        robot.fk(q),
        robot.jacobian(q),
        robot.link_frames(q),
        robot.singularity(q),
        robot.ik_batch(poses),
        robot.ik(poses[0]),
    )
    np.testing.assert_array_equal(q, many)
    np.testing.assert_array_equal(poses, kept)


def test_answers_are_new_arrays_that_may_be_written(robot):
    for answer in (
        robot.fk(Q),
        robot.jacobian(Q),
        robot.ik(robot.fk(Q)).q,
    ):
        assert answer.dtype == np.float64
        assert answer.flags.c_contiguous
        answer[...] = 7
    assert robot == irbkin.Robot("IRB 2600-12/1.65")


@pytest.mark.skipif(np.__version__ < "2", reason="NumPy 1 copies")
def test_an_array_without_a_copy_is_refused_only_where_a_copy_is_needed(robot):
    solutions = robot.ik(robot.fk(Q))
    for given in (solutions, solutions[0]):
        assert np.asarray(given, dtype=np.float32).dtype == np.float32
        assert np.array(given, copy=True).dtype == np.float64
        with pytest.raises(ValueError, match="without a copy"):
            np.array(given, copy=False)


WRONG_OUT = {
    "dtype": (
        lambda: np.zeros((4, 4), "f4"),
        TypeError,
        r"out must be an array of dtype float64, got .*float32",
    ),
    "byte order": (
        lambda: np.zeros((4, 4), ">f8"),
        TypeError,
        r"out must be an array of dtype float64, got .*>f8",
    ),
    "shape": (
        lambda: np.zeros((3, 4)),
        ValueError,
        r"out must be C-contiguous with shape \(4, 4\), got .*\(3, 4\)",
    ),
    "flat": (lambda: np.zeros(16), ValueError, r"shape \(4, 4\), got .*shape \(16,\)"),
    "Fortran order": (lambda: np.zeros((4, 4), order="F"), ValueError, "not C-contiguous"),
    "strided": (lambda: strided(np.zeros((4, 4))), ValueError, "not C-contiguous"),
    "read-only": (lambda: read_only(np.zeros((4, 4))), ValueError, "out must be writable"),
    "list": (lambda: [[0.0] * 4] * 4, TypeError, "out must be an array of dtype float64, got list"),
    "text": (lambda: "x", TypeError, "out must be an array of dtype float64, got str"),
}


@pytest.mark.parametrize("kind", WRONG_OUT)
def test_a_wrong_out_is_refused_and_described(robot, kind):
    make, error, words = WRONG_OUT[kind]
    with pytest.raises(error, match=words):
        robot.fk(Q, out=make())


def test_a_wrong_out_of_a_jacobian_or_a_batch_is_refused(robot, many):
    poses = robot.fk(many)
    q, status = np.zeros((20, 8, 6)), np.zeros((20, 8), np.uint8)
    with pytest.raises(ValueError, match=r"shape \(6, 6\)"):
        robot.jacobian(Q, out=np.zeros((6, 7)))
    for out, error, words in (
        (q[:19], ValueError, r"shape \(20, 8, 6\), got .*\(19, 8, 6\)"),
        ((q, status.astype(np.int64)), TypeError, "dtype uint8, got .*int64"),
        ((q, status[:, :7]), ValueError, r"shape \(20, 8\)"),
        ((q, status, status), TypeError, r"out must be \(q, status\), got a tuple of 3"),
        ((q, read_only(status)), ValueError, "out must be writable"),
        ([q, status], TypeError, "got list"),
    ):
        with pytest.raises(error, match=words):
            robot.ik_batch(poses, out=out)


def test_a_call_that_fails_writes_nothing(robot, many):
    out, status = np.full((20, 8, 6), 5.0), np.full((20, 8), 5, np.uint8)
    for wrong, error, words in (
        (
            np.zeros((20, 3, 4)),
            irbkin.InvalidPoseError,
            r"T must have shape \(\.\.\., 4, 4\), got \(20, 3, 4\)",
        ),
        (np.zeros((20, 4, 4), complex), TypeError, "dtype complex128"),
        (np.zeros((19, 4, 4)), ValueError, r"out must be C-contiguous with shape \(19, 8, 6\)"),
    ):
        with pytest.raises(error, match=words):
            robot.ik_batch(wrong, out=(out, status))
    single = np.full((4, 4), 5.0)
    with pytest.raises(irbkin.InvalidJointsError, match="joint 1"):
        robot.fk([np.nan] * 6, out=single)
    assert (out == 5).all()
    assert (status == 5).all()
    assert (single == 5).all()


def test_out_that_overlaps_the_input_is_refused(robot):
    memory = np.zeros(64)
    with pytest.raises(ValueError, match="must not overlap"):
        robot.fk(memory[:6], out=memory[2:18].reshape(4, 4))
    with pytest.raises(ValueError, match="must not overlap"):
        robot.jacobian(memory[:6], out=memory[5:41].reshape(6, 6))
    memory[:16] = np.eye(4).ravel()
    with pytest.raises(ValueError, match="must not overlap"):
        robot.ik_batch(memory[:16].reshape(4, 4), out=memory[15:63].reshape(8, 6))
    q = np.zeros((8, 6))
    with pytest.raises(ValueError, match="must not overlap"):
        robot.ik_batch(np.eye(4), out=(q, q.view(np.uint8).ravel()[:8]))


def test_out_may_share_a_buffer_with_the_input_without_overlap(robot):
    memory = np.zeros(22)
    memory[:6] = Q
    robot.fk(memory[:6], out=memory[6:].reshape(4, 4))
    np.testing.assert_array_equal(memory[6:].reshape(4, 4), robot.fk(Q))


def test_overlap_is_seen_through_two_views_of_a_buffer(robot, many):
    """Views of shared memory have no array in common as their base."""
    buffer = bytearray(20 * 16 * 8)
    q, out = np.frombuffer(buffer)[: 20 * 6].reshape(20, 6), np.frombuffer(buffer).reshape(20, 4, 4)
    q[...] = many
    with pytest.raises(ValueError, match="must not overlap"):
        robot.fk(q, out=out)


class Several:
    """Poses in one object, as spatialmath's `SE3`: NumPy sees the first alone."""

    def __init__(self, matrices):
        self.A = list(matrices)
        self.__array_interface__ = self.A[0].__array_interface__


def spatialmath_poses(matrices):
    from spatialmath import SE3

    return SE3(list(matrices), check=False)


SEVERAL = [
    pytest.param(Several, id="stand-in"),
    pytest.param(spatialmath_poses, id="spatialmath", marks=pytest.mark.extra),
]


@pytest.mark.parametrize("make", SEVERAL)
def test_an_object_of_several_poses_is_all_of_them(robot, many, make):
    matrices = robot.fk(many[:3])
    poses = make(matrices)
    assert np.asarray(poses).shape == (4, 4)
    np.testing.assert_array_equal(robot.ik_batch(poses).q, robot.ik_batch(matrices).q)
    np.testing.assert_array_equal(
        robot.ik_batch([poses, poses]).q, robot.ik_batch([matrices, matrices]).q
    )
    seed = many[0]
    np.testing.assert_array_equal(robot.ik_nearest(poses, seed), robot.ik_nearest(matrices, seed))
    assert robot.plan(poses) == robot.plan(matrices)
    assert robot.follow(poses, seed) == robot.follow(matrices, seed)
    assert irbkin.to_xyz_wxyz(poses)[0].shape == (3, 3)
    region = irbkin.placement.Region(x=(0.0, 0.1))
    placed = irbkin.placement.best_base(robot, poses, region, steps=2)
    assert placed.slack.shape == (3,)


@pytest.mark.parametrize("make", SEVERAL)
def test_an_object_of_several_poses_is_refused_where_one_is_wanted(robot, many, make):
    poses = make(robot.fk(many[:3]))
    for call in (
        robot.ik,
        robot.check_pose,
        robot.with_tool,
        robot.with_base,
        lambda T: robot.go(Q, T, irbkin.Cell()),
        lambda T: irbkin.paths.line(T, T, steps=2),
        lambda T: irbkin.body.Shape.box([1.0, 1.0, 1.0], pose=T),
        lambda T: irbkin.Cell({"box": irbkin.body.Shape.box([1.0, 1.0, 1.0], T)}),
        lambda T: irbkin.placement.best_base(
            robot, [np.eye(4)], irbkin.placement.Region(), steps=1, frame=T
        ),
    ):
        with pytest.raises(irbkin.InvalidPoseError, match=r"\(4, 4\), got \(3, 4, 4\)"):
            call(poses)
    with pytest.raises(irbkin.InvalidPoseError, match="for many poses take ik_batch"):
        robot.ik(poses)


@pytest.mark.extra
def test_rotations_of_several_in_one_object_are_all_of_them():
    from spatialmath import SO3, UnitQuaternion

    angles = [0.1, 0.2]
    many = np.array([SO3.Rx(angle).A for angle in angles])
    rotations = SO3([SO3.Rx(angle) for angle in angles])
    quaternions = UnitQuaternion([UnitQuaternion.Rx(angle) for angle in angles])
    origin = [0.0, 0.0, 0.0]
    np.testing.assert_array_equal(irbkin.pose(origin, rotation=rotations)[:, :3, :3], many)
    reached = irbkin.map.reach(irbkin.Robot("UR5e"), 0.4, 0.1, 0.3, rotations)
    np.testing.assert_array_equal(reached.orientations, many)
    np.testing.assert_allclose(irbkin.pose(origin, wxyz=quaternions)[:, :3, :3], many, atol=1e-15)
