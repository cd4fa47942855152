"""Poses from and to translations with quaternions and ZYX Euler angles."""

import irbkin
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference import UNIT, pose_of, rotation_apart, turn
from strategies import numbers, poses, quaternions

ROUNDING = (
    32 * UNIT
)  # a quaternion's products and a normalization, or three rotations, in elements of at most one
ANGLES = st.tuples(st.floats(-3, 3), st.floats(-1.5, 1.5), st.floats(-3, 3))


def euler(rz, ry, rx):
    return turn("z", rz) @ turn("y", ry) @ turn("x", rx)


@given(numbers(-5, 5, 3), quaternions())
def test_a_quaternion_s_pose_is_the_reference(xyz, wxyz):
    made = irbkin.pose(xyz, wxyz=wxyz)
    np.testing.assert_allclose(made, pose_of(xyz, wxyz), rtol=0, atol=ROUNDING)
    np.testing.assert_array_equal(made[:3, 3], xyz)
    np.testing.assert_array_equal(made[3], [0, 0, 0, 1])


@given(poses())
def test_quaternions_round_trip(pose):
    xyz, wxyz = irbkin.to_xyz_wxyz(pose)
    assert (xyz.shape, wxyz.shape) == ((3,), (4,))
    assert np.linalg.norm(wxyz) == pytest.approx(1, abs=8 * UNIT)
    assert wxyz[0] >= 0
    np.testing.assert_array_equal(xyz, pose[:3, 3])
    np.testing.assert_allclose(irbkin.pose(xyz, wxyz), pose, rtol=0, atol=ROUNDING)


@given(quaternions())
def test_a_quaternion_round_trips_up_to_its_sign(wxyz):
    _, found = irbkin.to_xyz_wxyz(irbkin.pose([0, 0, 0], wxyz))
    assert min(np.abs(found - wxyz).max(), np.abs(found + wxyz).max()) <= ROUNDING


@pytest.mark.parametrize("axis", np.eye(3))
def test_half_turns_have_a_quaternion(axis):
    wxyz = np.array([0, *axis])
    _, found = irbkin.to_xyz_wxyz(irbkin.pose([0, 0, 0], wxyz))
    np.testing.assert_allclose(np.abs(found), np.abs(wxyz), rtol=0, atol=ROUNDING)


@given(numbers(-5, 5, 3), quaternions())
def test_a_rotation_vector_is_axis_times_angle(xyz, wxyz):
    made = irbkin.pose(xyz, rotvec=rotvec_of(wxyz))
    np.testing.assert_allclose(made, pose_of(xyz, wxyz), rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("angle", [0, 1e-300, 1e-160, 1e-9, 1, np.pi - 1e-9, np.pi, 2 * np.pi])
def test_a_rotation_vector_is_right_at_any_angle(angle):
    for sign, name in [(1, "x"), (-1, "y"), (1, "z")]:
        rotvec = sign * angle * np.eye(3)["xyz".index(name)]
        made = irbkin.pose([0, 0, 0], rotvec=rotvec)
        np.testing.assert_allclose(made, turn(name, sign * angle), rtol=0, atol=ROUNDING)


@given(numbers(-5, 5, 3), ANGLES)
def test_euler_angles_are_rz_ry_rx(xyz, angles):
    made = irbkin.pose(xyz, euler_zyx=angles)
    np.testing.assert_allclose(made[:3, :3], euler(*angles)[:3, :3], rtol=0, atol=ROUNDING)
    np.testing.assert_array_equal(made[:3, 3], xyz)


@given(ANGLES)
def test_euler_angles_round_trip(angles):
    _, found = irbkin.to_xyz_euler_zyx(irbkin.pose([1, 2, 3], euler_zyx=angles))
    # Rounding of the matrix is divided by cos ry, which is 0.07 at 1.5 rad.
    np.testing.assert_allclose(found, angles, rtol=0, atol=ROUNDING / np.cos(angles[1]))


@given(poses())
def test_euler_angles_give_the_pose_back(pose):
    xyz, angles = irbkin.to_xyz_euler_zyx(pose)
    assert abs(angles[1]) <= np.pi / 2
    np.testing.assert_allclose(irbkin.pose(xyz, euler_zyx=angles), pose, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("ry", [np.pi / 2, -np.pi / 2])
@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-4])
def test_gimbal_poses_round_trip_to_rounding(ry, off):
    rng = np.random.default_rng(1)
    for rz, rx in rng.uniform(-3, 3, (50, 2)):
        pose = euler(rz, ry - np.sign(ry) * off, rx)
        _, angles = irbkin.to_xyz_euler_zyx(pose)
        assert rotation_apart(irbkin.pose([0, 0, 0], euler_zyx=angles), pose) <= 3 * ROUNDING


@pytest.mark.parametrize("sign", [1, -1])
def test_at_the_gimbal_rz_is_zero_and_rx_takes_all(sign):
    rz, rx = 0.3, 0.4
    exact = np.eye(4)
    # Rz(rz) Ry(+-90) Rx(rx) has only rx -+ rz in it; cos(pi/2) is made exactly zero.
    angle = rx - sign * rz
    exact[:3, :3] = [
        [0, sign * np.sin(angle), sign * np.cos(angle)],
        [0, np.cos(angle), -np.sin(angle)],
        [-sign, 0, 0],
    ]
    _, angles = irbkin.to_xyz_euler_zyx(exact)
    np.testing.assert_allclose(angles, [0, sign * np.pi / 2, angle], rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(exact, euler(rz, sign * np.pi / 2, rx), rtol=0, atol=ROUNDING)


def test_without_an_orientation_the_axes_are_those_of_the_base():
    np.testing.assert_array_equal(irbkin.pose([1, 2, 3])[:3, :3], np.eye(3))


def test_a_rounded_quaternion_is_normalized():
    """RAPID text has a few digits; the direction is kept."""
    wxyz = np.array([0.707, 0, 0.707, 0])
    made = irbkin.pose([0, 0, 0], wxyz)
    np.testing.assert_allclose(made, pose_of([0, 0, 0], wxyz), rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(made[:3, :3] @ made[:3, :3].T, np.eye(3), rtol=0, atol=ROUNDING)


@given(poses(), st.floats(-9e-6, 9e-6), st.integers(0, 2), st.integers(0, 2))
def test_a_rotation_that_is_a_little_off_becomes_the_nearest(pose, off, i, j):
    rough = pose.copy()
    rough[i, j] += off / 3
    # The polar factor: the nearest rotation in the Frobenius norm.
    u, _, vt = np.linalg.svd(rough[:3, :3])
    xyz, wxyz = irbkin.to_xyz_wxyz(rough)
    np.testing.assert_allclose(irbkin.pose(xyz, wxyz)[:3, :3], u @ vt, rtol=0, atol=2 * ROUNDING)


def test_single_precision_and_text_are_repaired():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    pose = robot.fk([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    for rough in (pose.astype(np.float32), np.round(pose, 6)):
        solutions = robot.ik(rough)
        assert len(solutions) == 8 or len(solutions) == 4
        assert max(solution.residual for solution in solutions) <= 1e-14
        u, _, vt = np.linalg.svd(rough[:3, :3].astype(float))
        for solution in solutions:
            np.testing.assert_allclose(
                robot.fk(solution.q)[:3, :3], u @ vt, rtol=0, atol=3 * ROUNDING
            )


def orientations(many):
    """The same orientations in every way of giving them, by keyword."""
    wxyz = irbkin.to_xyz_wxyz(many)[1]
    return {
        "wxyz": wxyz,
        "xyzw": np.roll(wxyz, -1, axis=-1),
        "euler_zyx": irbkin.to_xyz_euler_zyx(many)[1],
        "rotation": many[..., :3, :3],
        "rotvec": rotvec_of(wxyz),
    }


def rotvec_of(wxyz):
    half = np.linalg.norm(wxyz[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(half, wxyz[..., :1])
    return wxyz[..., 1:] * np.divide(angle, half, out=np.full_like(half, 2), where=half > 0)


MANY = np.stack([irbkin.pose([i, 2, 3], euler_zyx=[0.1 * i, 0.2, -0.3]) for i in range(6)])
MANY = MANY.reshape(2, 3, 4, 4)


@pytest.mark.parametrize("way", ["wxyz", "xyzw", "euler_zyx", "rotation", "rotvec"])
def test_poses_are_broadcast_and_each_is_the_one_made_alone(way):
    turns = orientations(MANY)[way]
    xyz = MANY[..., :3, 3]
    made = irbkin.pose(xyz, **{way: turns})
    assert made.shape == (2, 3, 4, 4)
    np.testing.assert_allclose(made, MANY, rtol=0, atol=ROUNDING)
    for index in np.ndindex(2, 3):
        alone = irbkin.pose(xyz[index], **{way: turns[index]})
        np.testing.assert_array_equal(made[index], alone)
        np.testing.assert_array_equal(
            irbkin.pose(xyz[index].tolist(), **{way: turns[index]}), alone
        )
    np.testing.assert_array_equal(
        irbkin.pose(xyz, **{way: turns[0, 0]})[1, 2], irbkin.pose(xyz[1, 2], **{way: turns[0, 0]})
    )
    np.testing.assert_array_equal(
        irbkin.pose(xyz[0, 0], **{way: turns})[1, 2], irbkin.pose(xyz[0, 0], **{way: turns[1, 2]})
    )
    assert irbkin.pose(np.zeros((0, 3)), **{way: turns[0, 0]}).shape == (0, 4, 4)


def test_translations_alone_are_poses_too():
    made = irbkin.pose(MANY[..., :3, 3])
    np.testing.assert_array_equal(made[1, 2], irbkin.pose(MANY[1, 2, :3, 3]))
    assert made.shape == (2, 3, 4, 4)


@pytest.mark.extra
def test_a_scipy_rotation_is_taken():
    from scipy.spatial.transform import Rotation

    turns = orientations(MANY)
    many = Rotation.from_quat(turns["xyzw"].reshape(-1, 4))
    made = irbkin.pose(np.zeros(3), rotation=many)
    np.testing.assert_allclose(
        made, irbkin.pose(np.zeros(3), turns["wxyz"].reshape(-1, 4)), rtol=0, atol=ROUNDING
    )
    np.testing.assert_array_equal(irbkin.pose(np.zeros(3), rotation=many[2]), made[2])
    np.testing.assert_allclose(
        irbkin.pose([0, 0, 0], xyzw=many[2].as_quat()), made[2], rtol=0, atol=ROUNDING
    )


def test_poses_come_apart_as_each_does_alone():
    for take in (irbkin.to_xyz_wxyz, irbkin.to_xyz_euler_zyx):
        spoiled = MANY.copy()
        spoiled[0, 1] *= 2
        spoiled[1, 0, 0, 0] = np.nan
        for parts in zip(
            take(spoiled), zip(*map(take, MANY.reshape(-1, 4, 4)), strict=True), strict=True
        ):
            together, alone = parts[0], np.array(parts[1]).reshape(parts[0].shape)
            alone[0, 1] = alone[1, 0] = np.nan
            np.testing.assert_array_equal(together, alone)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"wxyz": [[1, 0, 0, 0], [1, 1, 0, 0]]}, r"row \[1\]: quaternion norm .* w, x, y, z"),
        ({"xyzw": [[1, 0, 0, 0], [1, 1, 0, 0]]}, r"row \[1\]: quaternion norm .* x, y, z, w"),
        ({"xyzw": [0, 0, np.nan, 1]}, r"^xyzw\[2\] is NaN"),
        ({"xyzw": [2, 0, 0, 1]}, r"^quaternion norm is .* \(order is x, y, z, w\)"),
        ({"euler_zyx": [[0, 0, 0], [0, np.inf, 0]]}, r"row \[1\]: euler_zyx\[1\] is inf"),
        ({"rotvec": [0, 90, 0]}, r"^rotvec\[1\] is 90 rad, .* \(did you pass degrees\?\)"),
        ({"rotvec": [0, 0, np.nan]}, r"^rotvec\[2\] is NaN"),
        ({"rotation": np.diag([1, 1, -1])}, "^pose rotation mirrors"),
        ({"rotation": [np.eye(3), 2 * np.eye(3)]}, r"row \[1\]: pose rotation is off orthonormal"),
        ({"rotation": np.full((3, 3), np.nan)}, r"^pose\[0, 0\] is NaN"),
        ({"rotation": np.eye(4)}, r"rotation must have shape \(\.\.\., 3, 3\), got \(4, 4\)"),
        ({"xyz": [[0, 0, 0], [0, np.nan, 0]]}, r"row \[1\]: xyz\[1\] is NaN"),
        ({"xyz": [1e200, 0, 0], "rotation": np.eye(3)}, r"^xyz\[0\] is 1e200 m"),
        (
            {"xyz": np.zeros((2, 3)), "wxyz": np.zeros((3, 4))},
            r"wxyz of shape \(3, 4\) cannot be broadcast with xyz of shape \(2, 3\)",
        ),
    ],
)
def test_what_makes_no_pose_is_refused_with_its_row(given, words):
    with pytest.raises(irbkin.InvalidPoseError, match=words):
        irbkin.pose(**({"xyz": [0, 0, 0]} | given))


@pytest.mark.parametrize("other", ["xyzw", "euler_zyx", "rotation"])
def test_one_orientation_is_enough(other):
    with pytest.raises(TypeError, match=f"give one orientation: wxyz or {other}, not both"):
        irbkin.pose([0, 0, 0], wxyz=[1, 0, 0, 0], **{other: [0, 0, 0]})
