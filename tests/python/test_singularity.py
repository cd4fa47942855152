"""Distances from the singularities, and the figures of the Jacobian."""

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
