"""Distances from the singularities, and the figures of the Jacobian."""

import command
import irbkin
import numpy as np
import pytest
from arms import CATALOG
from hypothesis import given
from irbkin import SingularityKind
from reference import UNIT
from strategies import subjects_with_joints


def figures(jacobian):
    values = np.linalg.svd(jacobian, compute_uv=False)
    return values[-1], np.prod(values)


@given(subjects_with_joints())
def test_singular_values_are_those_of_numpy(drawn):
    subject, q = drawn
    jacobian = subject.robot.jacobian(q)
    record = subject.robot.singularity(q)
    least, product = figures(jacobian)
    # Either decomposition is exact for a matrix that is off by a few roundings of the largest
    # singular value.
    largest = np.linalg.norm(jacobian, 2)
    assert record.min_singular_value == pytest.approx(least, abs=64 * UNIT * largest)
    assert record.manipulability == pytest.approx(
        abs(np.linalg.det(jacobian)), abs=6 * 64 * UNIT * largest**6
    )
    assert record.manipulability == pytest.approx(product, abs=6 * 64 * UNIT * largest**6)


def test_an_arm_of_unknown_structure_has_the_figures_and_no_names():
    rows = CATALOG["Panda"].rows + 1e-3
    record = irbkin.Robot.from_mdh(rows).singularity(np.full(7, 0.4))
    assert record.min_singular_value > 0
    assert np.isnan([record.wrist, record.elbow, record.shoulder]).all()
    assert record.kinds == SingularityKind(0)


def test_a_batch_is_a_record_of_arrays():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = np.random.default_rng(5).uniform(*robot.limits.T, (3, 4, 6))
    q[0, 0, 4] = 0
    batch = robot.singularity(q)
    for index in np.ndindex(3, 4):
        single = robot.singularity(q[index])
        for field in (
            "wrist",
            "elbow",
            "shoulder",
            "min_singular_value",
            "manipulability",
            "kinds",
        ):
            assert getattr(batch, field)[index] == getattr(single, field)
            assert isinstance(
                getattr(single, field), SingularityKind if field == "kinds" else float
            )
    assert batch.kinds.dtype == np.uint8
    assert SingularityKind(batch.kinds[0, 0]) == SingularityKind.WRIST


def beside_the_wrist(q5):
    return [0.3, 0.2, 0.1, 0.5, q5, 0.4]


def test_near_names_what_kinds_has_left_in_single_and_batch():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    wrist, none = SingularityKind.WRIST, SingularityKind(0)
    for q5, kinds, near in (
        (0.0, wrist, wrist),
        (1e-8, none, wrist),
        (np.radians(0.99), none, wrist),
        (np.radians(1.01), none, none),
    ):
        record = robot.singularity(beside_the_wrist(q5))
        assert (record.kinds, record.near()) == (kinds, near)
        assert isinstance(record.near(), SingularityKind)
    q = np.array([beside_the_wrist(q5) for q5 in (0.0, 1e-8, 0.3, np.nan)])
    batch = robot.singularity(q[:, None])
    near = batch.near()
    assert near.dtype == np.uint8
    np.testing.assert_array_equal(near, [[4], [4], [0], [irbkin.Status.INVALID]])
    # Bounds of the distances that the record has.
    record = robot.singularity(beside_the_wrist(0.3))
    assert record.near(angle=0.31) == wrist
    assert record.near(angle=0.29) == none
    assert record.near(length=record.shoulder) == SingularityKind.SHOULDER
    assert record.near(angle=record.elbow, length=1e-300) == wrist | SingularityKind.ELBOW


def test_near_of_an_arm_without_names_is_by_the_least_singular_value():
    for robot in (irbkin.Robot("GoFa 5"), irbkin.Robot.from_mdh(CATALOG["Panda"].rows + 1e-3)):
        record = robot.singularity(np.full(robot.dof, 0.4))
        least = record.min_singular_value
        assert record.near(angle=1.01 * least, length=1e300) == SingularityKind.ELBOW
        assert record.near(angle=0.99 * least, length=1e300) == SingularityKind(0)


@pytest.mark.parametrize("bound", [0.0, -1e-3, np.nan, np.inf])
@pytest.mark.parametrize("name", ["angle", "length"])
def test_a_zone_is_positive_and_finite(name, bound):
    record = irbkin.Robot("UR5e").singularity(np.full(6, 0.4))
    with pytest.raises(ValueError, match=f"^{name} is .*, it must be positive and finite$"):
        record.near(**{name: bound})


def test_a_person_meets_the_wrist_one_degree_beside_it(tmp_path):
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = beside_the_wrist(np.radians(0.9))
    assert repr(robot.singularity(q)).endswith("near wrist>")
    assert repr(robot.singularity(beside_the_wrist(0.0))).endswith("at wrist>")
    assert repr(robot.singularity(beside_the_wrist(0.5))).endswith("near none>")
    assert "2 near one" in repr(robot.singularity([q, q, beside_the_wrist(0.5)]))
    assert str(robot.ik(robot.fk(q))).count("near wrist") == 2
    many = [q, beside_the_wrist(0.0), beside_the_wrist(0.5)]
    np.save(tmp_path / "poses.npy", robot.fk(many))
    table = command.rows(command.run("ik", robot.name, tmp_path / "poses.npy", "--csv"))
    assert table["singular"][table["slot"] == 0].tolist() == ["near wrist", "at wrist", ""]
