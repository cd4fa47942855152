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
