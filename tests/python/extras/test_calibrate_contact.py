"""Calibration by contact: simulated errors are recovered from spheres, ball bars and planes."""

import irbkin
import numpy as np
import pytest
from irbkin import CalibrationError, InvalidJointsError
from irbkin.calibration import PlaneContact, SphereContact, calibrate_contact

CENTERS = np.array([[0.55, 0.0, 0.35], [0.3, 0.45, 0.5], [0.35, -0.45, 0.25]])
LENGTH = 0.15
NAMES = ("IRB 1200-5/0.9", "UR5e")


def unit(rng):
    vector = rng.normal(size=3)
    return vector / np.linalg.norm(vector)


def arms(name, rng):
    """The nominal arm with its probe, and the arm as it is."""
    robot = irbkin.Robot(name).with_tool([0.02, 0.03, 0.2])
    return robot, robot.with_corrections(rng.normal(0, 3e-4, 42))


def touching(rng, robot, truth, point, count):
    """Joint vectors at which the tool of the true arm is at points, in several orientations."""
    found = []
    while len(found) < count:
        tilts = [rng.uniform(-1, 1), np.pi + rng.uniform(-0.6, 0.6), rng.uniform(-0.6, 0.6)]
        wanted = point()
        solutions = robot.ik(irbkin.pose(wanted, euler_zyx=tilts)).within_limits()
        if not len(solutions):
            continue
        q = np.array(solutions[rng.integers(len(solutions))].q)
        for _ in range(6):
            q += np.linalg.pinv(truth.jacobian(q)[:3]) @ (wanted - truth.fk(q)[:3, 3])
        if np.linalg.norm(wanted - truth.fk(q)[:3, 3]) < 1e-12:
            found.append(q)
    return np.array(found)


def sphere(rng, robot, truth, center, noise, count=40):
    def point():
        return center + (LENGTH + rng.normal(0, noise)) * unit(rng)

    return touching(rng, robot, truth, point, count)


def plane(rng, robot, truth, center, noise, count=30):
    normal = unit(rng)
    sides = np.linalg.svd(normal[None])[2][1:]

    def point():
        return center + rng.uniform(-0.15, 0.15, 2) @ sides + normal * rng.normal(0, noise)

    return touching(rng, robot, truth, point, count)


def worst(robot, truth):
    """How far positions all over the joint space are apart, with the base that fits best."""
    q = np.random.default_rng(9).uniform(*robot.limits.clip(-2.5, 2.5).T, (500, 6))
    own, wanted = (arm.fk(q)[:, :3, 3] for arm in (robot, truth))
    own, wanted = own - own.mean(axis=0), wanted - wanted.mean(axis=0)
    u, _, v = np.linalg.svd(own.T @ wanted)
    turn = u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v
    return np.linalg.norm(own @ turn - wanted, axis=1).max()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("noise", [0.0, 2e-5])
def test_spheres_and_planes_give_the_accuracy_of_the_contacts(name, noise):
    rng = np.random.default_rng(1)
    robot, truth = arms(name, rng)
    contacts = [
        *(SphereContact(sphere(rng, robot, truth, it, noise), LENGTH) for it in CENTERS),
        *(PlaneContact(plane(rng, robot, truth, it, noise)) for it in CENTERS),
    ]
    found = calibrate_contact(robot, contacts)
    # A complete model of six joints has 30 parameters, of a point 27; the base is not seen.
    assert len(found.parameters) == 21
    assert worst(robot, truth) > 1e-3
    assert worst(found.robot, truth) < 1e-7 + 10 * noise
    assert found.residuals.after.position_rms <= 1.15 * noise + 1e-9
    assert found.position_error.shape == (210,)
    assert {each.name for each in found.left_out} >= {"alpha 1", "tool rx"}
    for each in found.parameters:
        assert each.standard_error <= 1e-8 + 50 * noise, each.name


def test_a_known_center_shows_the_base():
    rng = np.random.default_rng(2)
    robot = irbkin.Robot("UR5e").with_tool([0, 0, 0.1])
    base = irbkin.pose([1e-3, -2e-3, 5e-4], euler_zyx=[1e-3, 0, -2e-3])
    truth = robot.with_base(base)
    contacts = [SphereContact(sphere(rng, robot, truth, it, 0), LENGTH, it) for it in CENTERS]
    found = calibrate_contact(robot, contacts, fit="base")
    np.testing.assert_allclose(found.robot.fk(np.ones(6)), truth.fk(np.ones(6)), atol=1e-8)
    assert [each.name for each in found.parameters] == [
        f"base {it}" for it in ["x", "y", "z", "rx", "ry", "rz"]
    ]


def test_an_outlier_does_not_lead_a_robust_loss_astray():
    rng = np.random.default_rng(3)
    robot, truth = arms("UR5e", rng)
    joints = [sphere(rng, robot, truth, it, 1e-5) for it in CENTERS]
    joints[1][5, 1] += 0.01
    contacts = [SphereContact(q, LENGTH) for q in joints]
    plain, robust = (calibrate_contact(robot, contacts, loss=it) for it in ("linear", "cauchy"))
    assert worst(robust.robot, truth) < 3e-4 < worst(plain.robot, truth)
    assert robust.position_error.argmax() == 45


def test_planes_alone_leave_one_length_open():
    rng = np.random.default_rng(4)
    robot, truth = arms("UR5e", rng)
    contacts = [PlaneContact(plane(rng, robot, truth, it, 0)) for it in CENTERS]
    assert len(calibrate_contact(robot, contacts).parameters) == 20


def test_contacts_that_show_too_little_are_refused_with_a_cure():
    rng = np.random.default_rng(5)
    robot, truth = arms("UR5e", rng)
    q = sphere(rng, robot, truth, CENTERS[0], 0)
    line = touching(rng, robot, truth, lambda: CENTERS[0] + [0.1 * rng.uniform(), 0, 0], 20)
    circle = touching(
        rng,
        robot,
        truth,
        lambda: CENTERS[0] + LENGTH * np.array([np.cos(a := rng.uniform(0, 6)), np.sin(a), 0]),
        20,
    )
    for contacts, error, words in [
        ([], CalibrationError, "contacts is empty"),
        ([SphereContact(q, 150.0)], CalibrationError, "is distance in meters"),
        ([SphereContact(q, 0.0)], CalibrationError, r"contacts\[0\].distance is 0.0 m, it must be"),
        ([SphereContact(q[:3], LENGTH)], CalibrationError, "a sphere needs 4 at least"),
        ([SphereContact(q[:15], LENGTH)], CalibrationError, "measure twice as many contacts"),
        ([PlaneContact(line)], CalibrationError, "touch it all over"),
        ([SphereContact(circle, LENGTH)], CalibrationError, "on more than one circle"),
        ([PlaneContact(np.degrees(q))], InvalidJointsError, "did you pass degrees"),
        ([PlaneContact(q[:, :5])], InvalidJointsError, r"contacts\[0\].q must have shape"),
        ([q], TypeError, r"contacts\[0\] must be a SphereContact or a PlaneContact"),
    ]:
        with pytest.raises(error, match=words):
            calibrate_contact(robot, contacts)
