"""A X = Y B: exact poses, noise, outliers, and what does not determine X."""

import irbkin
import numpy as np
import pytest
from irbkin.calibration import robot_world
from irbkin.errors import CalibrationError, InvalidPoseError

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
RNG = np.random.default_rng(4)
X = irbkin.pose([0.05, 0.02, 0.1], euler_zyx=[0.3, 0.2, 1.5])
Y = irbkin.pose([1.0, 0.3, 0.2], euler_zyx=[1.0, 0.2, 3.0])
A = ROBOT.fk(RNG.uniform(*ROBOT.limits.clip(-2, 2).T, (20, 6)))
B = np.linalg.inv(Y) @ A @ X
# The camera in the hand sees a fixed target.
SEEN = np.linalg.inv(B)
MILLIMETERS = np.array([[1, 1, 1, 1e3]] * 3 + [[1, 1, 1, 1]])
MIRROR = np.diag([-1.0, 1, 1, 1])
MOVES = np.linalg.inv(A[1:]) @ A[:-1], SEEN[1:] @ np.linalg.inv(SEEN[:-1])


def test_exact_poses_give_exact_transforms():
    found = robot_world(A, B)
    np.testing.assert_allclose(found.x, X, rtol=0, atol=1e-13)
    np.testing.assert_allclose(found.y, Y, rtol=0, atol=1e-13)
    assert max(found.position_error.max(), found.rotation_error.max()) < 1e-13


def test_moves_are_poses_once_they_are_chained():
    # A X = X B: the hand's moves in any order, and those that its camera sees.
    hands, seen = [np.eye(4)], [np.eye(4)]
    for a, b in zip(MOVES[0][::-1], MOVES[1][::-1], strict=True):
        hands.append(hands[-1] @ np.linalg.inv(a))
        seen.append(seen[-1] @ np.linalg.inv(b))
    found = robot_world(hands, seen)
    np.testing.assert_allclose(found.x, X, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.y, X, rtol=0, atol=1e-12)


def test_noise_is_averaged():
    noisy = B.copy()
    noisy[:, :3, 3] += RNG.normal(0, 1e-4, (20, 3))
    found = robot_world(A, noisy)
    assert np.abs(found.x - X).max() < 4e-4
    assert found.position_error.max() < 1e-3


@pytest.mark.parametrize("loss", ["huber", "cauchy"])
def test_a_robust_loss_bears_an_outlier(loss):
    wrong = B.copy()
    wrong[3, 0, 3] += 0.5
    assert np.abs(robot_world(A, wrong).x - X).max() > 1e-2
    found = robot_world(A, wrong, loss=loss)
    assert np.abs(found.x - X).max() < 1e-3
    assert found.position_error.argmax() == 3


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: robot_world(A[:2], B[:2]), CalibrationError, "a has 2 poses, at least 3"),
        (lambda: robot_world(A[:3], B[:4]), CalibrationError, "a has 3 poses and b 4"),
        (lambda: robot_world(A[[0] * 4], B[[0] * 4]), CalibrationError, "about a second axis"),
        (lambda: robot_world(A[0], B[0]), InvalidPoseError, "shape"),
        (lambda: robot_world(2 * A, B), InvalidPoseError, "row"),
        (lambda: robot_world(MILLIMETERS * A, B), CalibrationError, "did you pass millimeters"),
        (lambda: robot_world(A, B, loss="none"), ValueError, "loss must be one of"),
        (lambda: robot_world(A, B, position_std=0), ValueError, "position_std is 0"),
        # Inverted, in another order, mirrored.
        (lambda: robot_world(A, SEEN), CalibrationError, "a and b do not fit.*inverted"),
        (lambda: robot_world(A, B[::-1]), CalibrationError, "half are"),
        (lambda: robot_world(A, MIRROR @ B @ MIRROR), CalibrationError, "mirrored"),
    ],
)
def test_what_determines_no_transform_is_refused(call, error, words):
    with pytest.raises(error, match=words):
        call()
