"""Tool center points of poses that touch a point, and work objects of points."""

import irbkin
import numpy as np
import pytest
from irbkin.calibration import tool_center_point, work_object
from irbkin.errors import CalibrationError, InvalidPoseError

TIP, POINT = np.array([0.05, -0.02, 0.3]), np.array([1.0, 0.2, 0.6])
FRAME = irbkin.pose([0.7, 0.1, 0.3], euler_zyx=[0.4, 0.1, -0.2])


def touching(angles):
    """Poses of the flange whose tip is at the point, of rotations rz, ry, rx."""
    poses = irbkin.pose(np.zeros((len(angles), 3)), euler_zyx=angles)
    poses[:, :3, 3] = POINT - poses[:, :3, :3] @ TIP
    return poses


MILLIMETERS = np.array([[1, 1, 1, 1e3]] * 3 + [[1, 1, 1, 1]])
POSES = touching([[0, 3.1, 0], [1, 2.7, 0.3], [2, 3.4, -0.4], [-1, 3.0, 0.5], [0.4, 2.6, -0.3]])


def seen(points):
    return np.asarray(points) @ FRAME[:3, :3].T + FRAME[:3, 3]


def test_a_tool_center_point_is_found_to_rounding():
    found = tool_center_point(POSES[:4])
    np.testing.assert_allclose(found.tool[:3, 3], TIP, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(found.tool[:3, :3], np.eye(3))
    np.testing.assert_allclose(found.point, POINT, rtol=0, atol=1e-14)
    assert found.error.max() < 1e-14


def test_errors_of_a_tool_center_point_are_those_of_the_poses():
    poses = POSES.copy()
    poses[2, 0, 3] += 1e-3
    found = tool_center_point(poses)
    assert found.error.argmax() == 2
    assert np.linalg.norm(found.tool[:3, 3] - TIP) < 5e-3


@pytest.mark.parametrize(
    ("poses", "words"),
    [
        (POSES[:3], "flange has 3 poses, at least 4 are needed"),
        (touching([[turn, 3.1, 0] for turn in (0, 1, 2, 3)]), "differ by .* tilt the tool by 30"),
        (POSES[[0, 0, 0, 0]], "differ by 0 rad"),
        (POSES * MILLIMETERS, "pass millimeters"),
    ],
)
def test_poses_that_do_not_determine_a_tool_are_refused(poses, words):
    with pytest.raises(CalibrationError, match=words):
        tool_center_point(poses)


def test_a_work_object_has_x_through_two_points_and_its_origin_below_the_third():
    frame, error, *_ = work_object(seen([[0.1, 0, 0], [0.4, 0, 0], [0, 0.3, 0]]))
    np.testing.assert_allclose(frame, FRAME, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(error, np.zeros(3))
    apart = work_object(*seen([[0.1, 0, 0], [0.4, 0, 0], [0, 0.3, 0]]))
    np.testing.assert_array_equal(apart.frame, frame)
    for place, name in enumerate(("X1", "X2", "Y1")):
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        points[place] = [[0, 0, 0]]
        with pytest.raises(InvalidPoseError, match=rf"{name} must have shape \(3,\)"):
            work_object(*points)


def test_a_work_object_is_fitted_to_nominal_points():
    nominal = np.random.default_rng(1).uniform(-0.5, 0.5, (6, 3))
    frame, error, measured, fitted = work_object(seen(nominal), nominal)
    np.testing.assert_allclose(frame, FRAME, rtol=0, atol=1e-14)
    assert error.max() < 1e-14
    np.testing.assert_array_equal(measured, seen(nominal))
    np.testing.assert_allclose(fitted, measured, rtol=0, atol=1e-14)
    # Three points suffice, in a plane.
    flat = nominal[:3] * [1, 1, 0]
    np.testing.assert_allclose(work_object(seen(flat), flat).frame, FRAME, rtol=0, atol=1e-13)


SOLID = np.random.default_rng(2).uniform(-0.5, 0.5, (7, 3))


@pytest.mark.parametrize(
    ("points", "nominal", "error", "words"),
    [
        ([[0, 0, 0], [1, 0, 0], [2, 0, 0]], None, CalibrationError, "sine 0: at least"),
        ([[0, 0, 0], [0, 0, 0], [0, 1, 0]], None, CalibrationError, "are 0 and 1 m apart"),
        ([[0, 0, 0], [900, 0, 0], [0, 900, 0]], None, CalibrationError, "pass millimeters"),
        ([[0, 0, 0], [1, 0, 0]], None, InvalidPoseError, "shape"),
        ([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]], None, InvalidPoseError, "finite"),
        (np.eye(3), np.ones((3, 3)), CalibrationError, "nominal are on one line"),
        (np.eye(3), np.ones((4, 3)), InvalidPoseError, "shape"),
        (
            SOLID * [-1, 1, 1],
            SOLID,
            CalibrationError,
            "points and nominal do not fit: half are",
        ),
        (SOLID[::-1], SOLID, CalibrationError, "do not fit"),
    ],
)
def test_points_that_span_no_frame_are_refused(points, nominal, error, words):
    with pytest.raises(error, match=words):
        work_object(points, nominal)
