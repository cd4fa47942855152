"""`irbkin.calibrate`: recovery, counts of parameters, standard errors, and what is refused."""

import pickle

import irbkin
import numpy as np
import pytest
from irbkin.calibration import Residuals
from reference import random_pose, rotation_apart

IRB2600, UR5 = irbkin.Robot("IRB 2600-12/1.65"), irbkin.Robot("UR5")
PANDA = irbkin.Robot("Panda")
ROBOTS = {robot.name: robot for robot in (IRB2600, UR5, PANDA)}


def drawn(robot, count, seed):
    low, high = np.clip(robot.limits, -np.pi, np.pi).T
    return np.random.default_rng(seed).uniform(low, high, (count, robot.dof))


def perturbed(robot, size, seed):
    """The arm with all parameters off."""
    numbers = np.random.default_rng(seed).normal(0, size, 12 + 5 * robot.dof)
    return robot.with_corrections(numbers)


def noisy(poses, position, rotation, seed):
    """Poses as an instrument reads them."""
    rng = np.random.default_rng(seed)
    read = poses.copy()
    read[:, :3, 3] += rng.normal(0, position, (len(poses), 3))
    for matrix, vector in zip(read, rng.normal(0, rotation, (len(poses), 3)), strict=True):
        angle = np.linalg.norm(vector)
        x, y, z = vector / angle
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        matrix[:3, :3] = turn @ matrix[:3, :3]
    return read


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("size", [1e-4, 3e-3])
def test_a_perturbed_arm_is_recovered_from_exact_poses(name, size):
    robot = ROBOTS[name]
    truth = perturbed(robot, size, 1)
    q, fresh = drawn(robot, 60, 2), drawn(robot, 200, 3)
    calibration = irbkin.calibrate(robot, q, truth.fk(q))
    np.testing.assert_allclose(calibration.robot.fk(fresh), truth.fk(fresh), rtol=0, atol=1e-9)
    before, after = calibration.residuals.before, calibration.residuals.after
    assert after.position_worst < 1e-9 < size / 10 < before.position_rms
    assert calibration.residuals.cross_validated.position_worst < 1e-9


@pytest.mark.parametrize("name", ROBOTS)
def test_positions_are_recovered_from_exact_positions(name):
    robot = ROBOTS[name].with_tool(irbkin.pose([0.05, -0.08, 0.15]))
    truth = perturbed(robot, 1e-3, 4)
    q, fresh = drawn(robot, 80, 5), drawn(robot, 200, 6)
    calibration = irbkin.calibrate(robot, q, truth.fk(q)[:, :3, 3])
    found = calibration.robot.fk(fresh)[:, :3, 3]
    np.testing.assert_allclose(found, truth.fk(fresh)[:, :3, 3], rtol=0, atol=1e-9)
    assert np.isnan(calibration.residuals.after.rotation_rms)
    assert calibration.rotation_error.shape == (0,)


@pytest.mark.parametrize("seed", range(5))
def test_any_table_is_recovered(seed):
    rng = np.random.default_rng(seed)
    rows = rng.uniform(-1, 1, (6, 4)) * [np.pi, 0.5, 0.5, np.pi]
    robot = irbkin.Robot.from_mdh(rows)
    truth = robot.with_corrections(rng.normal(0, 2e-3, 42))
    q, fresh = rng.uniform(-3, 3, (2, 60, 6))
    calibration = irbkin.calibrate(robot, q, truth.fk(q))
    assert len(calibration.parameters) == 30
    np.testing.assert_allclose(calibration.robot.fk(fresh), truth.fk(fresh), rtol=0, atol=1e-9)


# Everett, Driels and Mooring, Kinematic modelling for robot calibration, 1987: a complete model of
# an arm of n revolute joints has 4 n + 6 parameters. A point has three fewer: its orientation.
@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize(
    ("fit", "of_poses", "of_positions"),
    [
        (("base", "table", "tool"), lambda n: 4 * n + 6, lambda n: 4 * n + 3),
        (("base", "tool"), lambda n: 12, lambda n: 9),
        (("base",), lambda n: 6, lambda n: 6),
        (("tool",), lambda n: 6, lambda n: 3),
    ],
)
def test_the_number_of_parameters_is_that_of_the_literature(name, fit, of_poses, of_positions):
    robot = ROBOTS[name].with_tool(irbkin.pose([0.05, -0.08, 0.15], euler_zyx=[0.3, 0.5, 0.7]))
    q = drawn(robot, 60, 7)
    T = perturbed(robot, 1e-4, 8).fk(q)
    for measured, count in ((T, of_poses), (T[:, :3, 3], of_positions)):
        calibration = irbkin.calibrate(robot, q, measured, fit=fit, folds=0)
        assert len(calibration.identifiable) == count(robot.dof)
        assert calibration.condition < 1e3
        left = {each.name for each in calibration.left_out}
        assert left.isdisjoint(calibration.identifiable)
        assert all(each.reason.startswith("which ") for each in calibration.left_out)


def test_next_to_parallel_axes_beta_takes_the_place_of_d():
    calibration = irbkin.calibrate(UR5, drawn(UR5, 40, 9), UR5.fk(drawn(UR5, 40, 9)))
    assert {"beta 3", "beta 4", "d 2"} <= set(calibration.identifiable)
    reasons = dict(calibration.left_out)
    assert reasons["d 3"] == "which moves the tool as d 2 in every pose"
    # With d in the place of beta, a tilt of 1 mrad is a parameter of 400 m.
    assert calibration.condition < 20


def test_standard_errors_cover():
    """Corrections over their standard errors are standard normal: of 1200, correlated within a fit
    but not between the 40, the mean square is 1 within 4 sqrt(2 / 40) at worst.
    """
    truth = perturbed(IRB2600, 1e-3, 10)
    q = drawn(IRB2600, 50, 11)
    exact = truth.fk(q)
    wanted = irbkin.calibrate(IRB2600, q, exact, folds=0)
    values = np.array([parameter.fitted for parameter in wanted.parameters])
    scores, squares = [], []
    for trial in range(40):
        measured = noisy(exact, 1e-4, 5e-4, 100 + trial)
        calibration = irbkin.calibrate(IRB2600, q, measured, folds=0)
        assert calibration.identifiable == wanted.identifiable
        fitted = np.array([parameter.fitted for parameter in calibration.parameters])
        errors = np.array([parameter.standard_error for parameter in calibration.parameters])
        scores.append((fitted - values) / errors)
        off = calibration.position_error / 1e-4, calibration.rotation_error / 5e-4
        squares.append(np.sum(np.square(off)))
    scores = np.array(scores)
    assert abs(np.mean(scores**2) - 1) < 4 * np.sqrt(2 / 40)
    # Each parameter by itself: 40 squares of standard normal numbers.
    assert np.all(np.abs(np.mean(scores**2, axis=0) - 1) < 4 * np.sqrt(2 / 40))
    assert 0.93 < np.mean(np.abs(scores) < 1.96) < 0.97
    # Of 50 x 6 squares the 30 parameters take one each; their sum has a variance of 2 x 270.
    assert abs(np.mean(squares) - 270) < 4 * np.sqrt(2 * 270 / 40)


def test_cross_validation_foretells_the_error_at_fresh_poses():
    truth = perturbed(IRB2600, 1e-3, 12)
    q, fresh = drawn(IRB2600, 40, 13), drawn(IRB2600, 2000, 14)
    calibration = irbkin.calibrate(IRB2600, q, noisy(truth.fk(q), 1e-4, 5e-4, 15))
    measured = noisy(truth.fk(fresh), 1e-4, 5e-4, 16)
    off = np.linalg.norm((calibration.robot.fk(fresh) - measured)[:, :3, 3], axis=1)
    foretold = calibration.residuals.cross_validated.position_rms
    assert calibration.residuals.after.position_rms < foretold
    # 40 poses know a root mean square to a fifth at best.
    assert abs(np.sqrt(np.mean(off**2)) / foretold - 1) < 0.3
    few = irbkin.calibrate(IRB2600, q[:6], truth.fk(q[:6]))
    assert few.residuals.cross_validated is None
    assert "cross-validated: none" in str(few)


def test_a_base_and_a_tool_far_off_are_found():
    rng = np.random.default_rng(17)
    true_arm = IRB2600.with_base(random_pose(rng, 5.0)).with_tool(random_pose(rng, 0.4))
    q = drawn(IRB2600, 60, 18)
    for fit in (("base", "tool"), ("base", "table", "tool")):
        for position_only in (False, True):
            measured = true_arm.fk(q)
            calibration = irbkin.calibrate(
                IRB2600, q, measured[:, :3, 3] if position_only else measured, fit=fit, folds=0
            )
            found = calibration.robot.fk(q)
            np.testing.assert_allclose(found[:, :3, 3], measured[:, :3, 3], rtol=0, atol=1e-9)
            if not position_only:
                assert max(map(rotation_apart, found, measured)) < 1e-9
            assert calibration.nominal != IRB2600
            if fit == ("base", "tool"):
                assert calibration.robot.structure == "spherical wrist"
    for fit in ("base", "tool"):
        known = true_arm.with_tool(np.eye(4)) if fit == "tool" else true_arm.with_base(np.eye(4))
        for measured in (true_arm.fk(q), true_arm.fk(q)[:, :3, 3]):
            calibration = irbkin.calibrate(known, q, measured, fit=(fit,), folds=0)
            np.testing.assert_allclose(
                getattr(calibration.robot, fit)[:3, 3], getattr(true_arm, fit)[:3, 3], atol=1e-9
            )


@pytest.mark.parametrize("loss", ["soft_l1", "huber", "cauchy", "arctan"])
def test_a_robust_loss_is_not_led_astray_by_outliers(loss):
    truth = perturbed(IRB2600, 1e-3, 19)
    q, fresh = drawn(IRB2600, 80, 20), drawn(IRB2600, 500, 21)
    measured = noisy(truth.fk(q), 1e-4, 5e-4, 22)
    measured[::10, :3, 3] += 5e-3

    def off(calibration):
        found = calibration.robot.fk(fresh) - truth.fk(fresh)
        return np.sqrt(np.mean(np.sum(found[:, :3, 3] ** 2, axis=1)))

    led = off(irbkin.calibrate(IRB2600, q, measured, folds=0))
    robust = irbkin.calibrate(IRB2600, q, measured, loss=loss, folds=0)
    assert off(robust) < led / 4
    clean = irbkin.calibrate(IRB2600, q, noisy(truth.fk(q), 1e-4, 5e-4, 22), loss=loss, folds=0)
    for with_outliers, without in zip(robust.parameters, clean.parameters, strict=True):
        assert 0.3 < with_outliers.standard_error / without.standard_error < 3


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
@pytest.mark.parametrize("loss", ["huber", "cauchy"])
def test_one_gross_outlier_does_not_refuse_a_robust_loss(robot, loss):
    truth, q = perturbed(robot, 5e-4, 21), drawn(robot, 60, 22)
    measured = noisy(truth.fk(q), 5e-5, 2e-4, 23)
    measured[7, 0, 3] += 1.0
    away = robot.with_base(irbkin.pose([0.5, 0.3, 0], euler_zyx=[1, 0, 0]))
    for nominal in (robot, away):
        found = irbkin.calibrate(nominal, q, measured, loss=loss, folds=0)
        assert np.median(found.position_error) < 5e-4
        assert found.position_error.argmax() == 7


def test_only_chosen_parameters_are_fitted():
    truth, q = perturbed(IRB2600, 5e-4, 24), drawn(IRB2600, 60, 25)
    found = irbkin.calibrate(IRB2600, q, truth.fk(q), fit=("theta 3", "d 1", "tool z"), folds=0)
    assert found.identifiable == ("d 1", "theta 3", "tool z")
    assert {parameter.name for parameter in found.left_out} == set()


def test_the_record_shows_and_stores_what_was_fitted():
    truth = perturbed(IRB2600, 1e-3, 23)
    q = drawn(IRB2600, 30, 24)
    calibration = irbkin.calibrate(IRB2600, q, noisy(truth.fk(q), 1e-4, 5e-4, 25))
    assert calibration.nominal == IRB2600
    assert calibration.nominal.with_corrections(calibration.corrections) == calibration.robot
    assert pickle.loads(pickle.dumps(calibration)) == calibration
    assert repr(calibration).startswith("<Calibration of IRB 2600-12/1.65: 30 parameters from 30 ")
    lines = str(calibration).splitlines()
    assert lines[0] == "IRB 2600-12/1.65: 30 parameters from 30 measurements"
    assert sum(line.startswith("left out: ") for line in lines) == len(calibration.left_out) == 12
    alpha = next(each for each in calibration.parameters if each.name == "alpha 2")
    assert (alpha.unit, alpha.nominal) == ("rad", IRB2600.mdh[1, 0])
    assert alpha.correction == alpha.fitted - alpha.nominal
    position = (calibration.robot.fk(q) - noisy(truth.fk(q), 1e-4, 5e-4, 25))[:, :3, 3]
    np.testing.assert_allclose(calibration.position_error, np.linalg.norm(position, axis=1))
    worst = calibration.residuals.after
    assert worst.position_worst == calibration.position_error.max()
    assert worst.rotation_worst == calibration.rotation_error.max()
    assert np.isnan(Residuals.of(np.zeros(0), np.zeros(0)).position_rms)


Q = drawn(IRB2600, 20, 26)
T = IRB2600.fk(Q)


def changed(array, index, value):
    array = np.array(array)
    array[index] = value
    return array


@pytest.mark.parametrize(
    ("q", "measured", "options", "error", "words"),
    [
        (Q[:, :5], T, {}, irbkin.InvalidJointsError, r"q must have shape \(m, 6\), got \(20, 5\)"),
        (changed(Q, (3, 1), np.nan), T, {}, irbkin.InvalidJointsError, r"q\[3, 1\] is nan"),
        (np.degrees(Q), T, {}, irbkin.InvalidJointsError, "did you pass degrees?"),
        (Q, T[:19], {}, irbkin.InvalidPoseError, r"shape \(20, 4, 4\) or \(20, 3\)"),
        (Q, changed(T, (2, 0, 3), np.inf), {}, irbkin.InvalidPoseError, r"measured\[2, 0, 3\]"),
        (Q, changed(T, 4, np.diag([1, 1, -1, 1])), {}, irbkin.InvalidPoseError, r"measured\[4\]"),
        (Q, changed(T, (5, 3), [0.1, 0, 0, 1]), {}, irbkin.InvalidPoseError, "last row"),
        (Q, T[:, :3, 3] * 1e3, {}, irbkin.CalibrationError, "did you pass millimeters?"),
        (Q[:5], T[:5], {}, irbkin.CalibrationError, "5 different joint vectors, 6 are needed"),
        (Q[[0] * 20], T[[0] * 20], {}, irbkin.CalibrationError, "1 different joint vectors"),
        (
            changed(Q, (slice(None), 2), 0.5), T, {}, irbkin.CalibrationError,
            "joint 3 moves by 0 rad in q, 0.05 rad are needed",
        ),
        (Q[::-1], T, {}, irbkin.CalibrationError, r"off measured \(rms\), .* at most"),
        (Q, T, {"fit": ()}, ValueError, r"fit must be some of base, table, tool, got \(\)"),
        (Q, T, {"fit": "links"}, ValueError, "fit must be some of"),
        (Q, T, {"position_std": 0.0}, ValueError, "position_std is 0.0, it must be positive"),
        (Q, T, {"rotation_std": np.inf}, ValueError, "rotation_std is inf"),
        (Q, T, {"loss": "lp"}, ValueError, 'loss must be one of .* got "lp"'),
        (Q, T, {"folds": 1}, ValueError, "folds is 1, it must be 0 for none, or 2 at least"),
    ],
)  # fmt: skip
def test_what_cannot_be_fitted_is_refused_in_words(q, measured, options, error, words):
    with pytest.raises(error, match=words):
        irbkin.calibrate(IRB2600, q, measured, **options)


def test_a_name_is_no_robot():
    with pytest.raises(TypeError, match=r"got str: give Robot\('UR5e'\)"):
        irbkin.calibrate("UR5e", Q, T)


@pytest.mark.parametrize("name", ["IRB 2400-10/1.55", "CRX-10iA"])
def test_a_coupled_arm_is_calibrated_by_its_controllers_joints(name):
    robot = irbkin.Robot(name).coupled()
    q = drawn(robot, 40, 27)
    corrections = np.zeros(42)
    corrections[6:36] = 1e-3 * np.sin(np.arange(30))
    real = robot.with_corrections(corrections)
    found = irbkin.calibrate(robot, q, real.fk(q)).robot
    assert found.is_coupled
    np.testing.assert_array_equal(found.limits, robot.limits)
    others = drawn(robot, 100, 28)
    np.testing.assert_allclose(found.fk(others), real.fk(others), rtol=0, atol=1e-8)
    assert np.abs(real.fk(others) - robot.fk(others)).max() > 1e-3


def test_the_ends_of_a_coupled_arm_are_calibrated():
    robot = irbkin.Robot("IRB 2400-10/1.55")
    q = drawn(robot, 20, 27)
    moved = robot.with_tool(irbkin.pose([0.0, 0.0, 0.1]))
    calibration = irbkin.calibrate(robot, q, moved.fk(q), fit=("base", "tool"))
    np.testing.assert_allclose(calibration.robot.tool, moved.tool, atol=1e-9)
    assert calibration.robot.is_coupled


def test_poses_that_do_not_separate_parameters_are_said_to():
    q = drawn(IRB2600, 40, 28)
    # Joint 5 near its zero: axes 4 and 6 all but coincide.
    q[:, 4] = np.random.default_rng(29).uniform(-3e-4, 3e-4, 40) + 1e-4
    q[:2, 4] = [-0.03, 0.03]
    q[2:, 3] = 0.2 + 1e-6 * q[2:, 3]
    calibration = irbkin.calibrate(IRB2600, q[2:], IRB2600.fk(q[2:]), fit=("base", "tool"), folds=0)
    assert len(calibration.parameters) == 12
    narrow = IRB2600.fk(q[2:])
    with pytest.raises(irbkin.CalibrationError, match="joint 4 moves by"):
        irbkin.calibrate(IRB2600, q[2:], narrow)


def test_scipy_is_needed_and_named(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "scipy", None)
    monkeypatch.setitem(__import__("sys").modules, "scipy.optimize", None)
    with pytest.raises(ImportError, match=r"pip install 'irbkin\[calibrate\]'"):
        irbkin.calibrate(IRB2600, Q, T)


def test_a_calibration_reports_its_fits():
    q = drawn(IRB2600, 40, 3)
    measured = noisy(perturbed(IRB2600, 1e-3, 1).fk(q), 1e-5, 1e-5, 2)
    calls = []
    found = irbkin.calibrate(IRB2600, q, measured, progress=lambda *both: calls.append(both))
    assert list(dict.fromkeys(calls)) == [(done, 7) for done in range(1, 8)]
    assert found == irbkin.calibrate(IRB2600, q, measured)
    irbkin.calibrate(IRB2600, q, measured, folds=0, progress=lambda *both: calls.append(both))
    assert calls[-1] == (2, 2)
