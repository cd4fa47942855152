"""Scenes of calibrations: residuals as vectors between the right points, frames that were found."""

import irbkin
import numpy as np
import pytest
from irbkin import calibration, scene
from irbkin.scene._arms import link_frames

RNG = np.random.default_rng(11)
ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
Q = RNG.uniform(*ROBOT.limits.clip(-3, 3).T, size=(40, 6))
MEASURED = ROBOT.with_corrections(RNG.normal(0, 3e-4, 42)).fk(Q)
MEASURED[:, :3, 3] += RNG.normal(0, 5e-5, (40, 3))
FOUND = irbkin.calibrate(ROBOT, Q, MEASURED, folds=0)


def check_residuals(own, found, error):
    """Vectors go from the measured points by the residuals, and words name scale and largest."""
    scale = int(own.paths[0].name.split(" x ")[1])
    assert [it.name for it in own.paths] == [f"residual {i} x {scale}" for i in range(len(error))]
    at, ends = np.array([path.points for path in own.paths]).swapaxes(0, 1)
    off = (ends - at) / scale
    np.testing.assert_array_equal(at, found.measured)
    np.testing.assert_allclose(at + off, found.fitted, rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(off, axis=1), error, rtol=0, atol=1e-12)
    assert 0.08 <= scale * error.max() <= 0.2
    (cloud,), (mark,) = own.clouds, own.marks
    np.testing.assert_allclose(cloud.values, 1e3 * error, rtol=0, atol=1e-9)
    assert mark.point == tuple(found.measured[error.argmax()])
    assert f"measurement {error.argmax()}; " in mark.text
    assert f"{1e3 * error.max():.3g} mm" in mark.text
    assert f"{scale} times as long" in mark.text


def test_a_calibration_is_drawn_at_its_postures_with_its_residuals():
    own = scene.of(FOUND)
    np.testing.assert_array_equal(FOUND.measured, MEASURED[:, :3, 3])
    check_residuals(own, FOUND, FOUND.position_error)
    (arm,) = own.arms
    assert arm == scene.arm_of(FOUND.nominal, arm.postures)
    far = np.abs(link_frames(arm, Q[0])[-1] - FOUND.robot.fk(Q[0])).max()
    assert 0 < far < 2 * FOUND.residuals.before.position_worst
    shown = [Q.tolist().index(list(it.q)) for it in arm.postures]
    assert [it.label for it in arm.postures] == [f"measurement {i}" for i in shown]
    assert len(shown) == 8
    assert [it.is_ghost for it in arm.postures] == [False] + [True] * 7
    base, tool = own.frames
    np.testing.assert_allclose(base.pose, FOUND.robot.base, rtol=0, atol=1e-15)
    np.testing.assert_allclose(tool.pose, FOUND.robot.fk(Q[0]), rtol=0, atol=1e-12)
    assert own.title == ROBOT.name
    assert scene.Scene.from_json(own.to_json()) == own


def test_a_camera_is_drawn_on_the_hand_and_what_it_sees_in_the_base():
    x = irbkin.pose([0.05, 0.02, 0.1], euler_zyx=[0.3, 0.2, 1.5])
    y = irbkin.pose([1.0, 0.3, 0.2], euler_zyx=[1.0, 0.2, 3.0])
    hands = ROBOT.fk(Q)
    seen = np.linalg.inv(y) @ hands @ x
    seen[:, :3, 3] += RNG.normal(0, 1e-4, (40, 3))
    found = calibration.robot_world(hands, seen)
    own = scene.of(found, ROBOT, q=Q)
    check_residuals(own, found, found.position_error)
    camera, target = own.frames
    np.testing.assert_allclose(camera.pose, hands[0] @ found.x, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(target.pose, found.y)
    assert [it.name for it in scene.of(found).frames] == ["Y"]
    with pytest.raises(TypeError, match="robot is missing: q is given, but a HandEye has no arm"):
        scene.of(found, q=Q)
    with pytest.raises(TypeError, match="q is given, but a Calibration has its own joint angles"):
        scene.of(FOUND, q=Q)


def test_calibrations_are_part_of_several_things():
    both = scene.of([FOUND, irbkin.Cell()])
    assert both.paths == scene.of(FOUND).paths
