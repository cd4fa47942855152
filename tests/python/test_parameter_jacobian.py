"""`parameter_jacobian` and `with_corrections` against a product of matrices in NumPy."""

import itertools

import irbkin
import numpy as np
import pytest
from arms import ABB, PANDA, UR
from reference import move, random_pose, rounding, turn

ARMS = {arm.name: arm for arm in (ABB["IRB 2600-12/1.65"], UR["UR5"], PANDA)}

# Derivatives of rotations about and translations along x, y, z at zero: generators of SE(3).
GENERATORS = {}
for _axis, (_i, _j) in {"x": (1, 2), "y": (2, 0), "z": (0, 1)}.items():
    _turned = np.zeros((4, 4))
    _turned[_i, _j], _turned[_j, _i] = -1.0, 1.0
    GENERATORS[f"r{_axis}"] = _turned
    _moved = np.zeros((4, 4))
    _moved["xyz".index(_axis), 3] = 1.0
    GENERATORS[_axis] = _moved


def step(generator, value):
    """The matrix exponential of one generator."""
    if generator[0] == "r":
        return turn(generator[1], value)
    return move(*(value * (axis == generator) for axis in "xyz"))


def frame(corrections):
    """The factors of D(x, y, z, rx, ry, rz), with the index of the correction of each."""
    order = ((0, "x"), (1, "y"), (2, "z"), (5, "rz"), (4, "ry"), (3, "rx"))
    return [(index, generator, corrections[index]) for index, generator in order]


def factors(robot, q, corrections):
    """The arm as a product: (index of the parameter or None, generator or matrix, value)."""
    dof = robot.dof
    product = [(None, robot.base @ robot._root, 0.0), *frame(corrections[:6])]
    for row, (alpha, a, d, theta) in enumerate(robot.mdh):
        first = 6 + 5 * row
        own = corrections[first : first + 5]
        product += [
            (first, "rx", alpha + own[0]),
            (first + 1, "x", a + own[1]),
            (first + 4, "ry", own[4]),
            (first + 3, "rz", theta + own[3] + q[row]),
            (first + 2, "z", d + own[2]),
        ]
    end = 6 + 5 * dof
    product.append((None, robot.flange @ robot.tool, 0.0))
    return product + [(end + i, g, v) for i, g, v in frame(corrections[end:])]


def matrix_of(factor):
    index, generator, value = factor
    return generator if index is None else step(generator, value)


def by_matrices(robot, q, corrections):
    """The pose, and the Jacobian by dT = A G B for T = A exp(G p) B: each column the twist dT T^-1
    with its linear part taken at the tool.
    """
    product = factors(robot, q, corrections)
    matrices = [matrix_of(factor) for factor in product]
    befores = list(itertools.accumulate(matrices, np.matmul, initial=np.eye(4)))
    backwards = itertools.accumulate(matrices[::-1], lambda behind, one: one @ behind)
    behinds = list(backwards)[::-1]
    pose = befores[-1]
    jacobian = np.zeros((6, len(corrections)))
    for place, (index, generator, _) in enumerate(product):
        if index is None:
            continue
        rate = befores[place] @ GENERATORS[generator] @ behinds[place]
        spin = rate[:3, :3] @ pose[:3, :3].T
        jacobian[:, index] = [*rate[:3, 3], spin[2, 1], spin[0, 2], spin[1, 0]]
    return pose, jacobian


@pytest.fixture(params=ARMS, scope="module")
def robot(request):
    rng = np.random.default_rng(5)
    named = irbkin.Robot(request.param)
    return named.with_base(random_pose(rng)).with_tool(random_pose(rng, 0.3))


@pytest.mark.parametrize("size", [0.0, 1e-3, 0.5])
def test_the_jacobian_is_that_of_a_product_of_matrices(robot, size):
    rng = np.random.default_rng(6)
    bound = 4 * rounding(5.0)
    for _ in range(10):
        q = rng.uniform(-3, 3, robot.dof)
        corrections = rng.uniform(-size, size, 12 + 5 * robot.dof)
        pose, jacobian = by_matrices(robot, q, corrections)
        found = robot._parameter_jacobian(q, corrections)
        np.testing.assert_allclose(found, jacobian, rtol=0, atol=bound)
        np.testing.assert_allclose(robot._corrected_fk(q, corrections), pose, rtol=0, atol=bound)


def test_a_corrected_robot_has_the_poses_of_the_product(robot):
    rng = np.random.default_rng(7)
    for size in (1e-4, 1e-2):
        corrections = rng.normal(0, size, 12 + 5 * robot.dof)
        corrected = robot.with_corrections(corrections)
        # A distant common normal is rounded in each of its rows.
        bound = 8 * rounding(5.0 + np.abs(corrected.mdh).max())
        for q in rng.uniform(-3, 3, (10, robot.dof)):
            pose, _ = by_matrices(robot, q, corrections)
            np.testing.assert_allclose(corrected.fk(q), pose, rtol=0, atol=bound)


def test_rows_are_as_single_calls_and_invalid_ones_are_nan(robot):
    q = np.random.default_rng(8).uniform(-3, 3, (2, 3, robot.dof))
    q[1, 2, 0] = np.nan
    width = 12 + 5 * robot.dof
    out = np.empty((2, 3, 6, width))
    assert robot._parameter_jacobian(q, out=out) is out
    assert np.isnan(out[1, 2]).all()
    assert np.isnan(robot._corrected_fk(q, np.zeros(width))[1, 2]).all()
    for index in np.ndindex(2, 3):
        if index != (1, 2):
            np.testing.assert_array_equal(out[index], robot._parameter_jacobian(q[index]))


def test_corrections_of_the_ends_keep_the_structure(robot):
    corrections = np.zeros(12 + 5 * robot.dof)
    corrections[:6] = corrections[-6:] = 1e-3
    corrected = robot.with_corrections(corrections)
    assert corrected.structure == robot.structure
    np.testing.assert_array_equal(corrected.mdh, robot.mdh)
    assert robot.with_corrections(np.zeros(12 + 5 * robot.dof)) == robot


def test_limits_velocities_and_name_are_kept():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    corrections = np.full(42, 1e-3)
    corrected = robot.with_corrections(corrections)
    assert corrected.name == robot.name
    np.testing.assert_array_equal(corrected.limits, robot.limits)
    np.testing.assert_array_equal(corrected.max_velocity, robot.max_velocity)


@pytest.mark.parametrize(
    ("corrections", "words"),
    [
        (np.zeros(30), r"corrections must have shape \(42,\), got \(30,\)"),
        (np.zeros((2, 42)), r"corrections must have shape \(42,\), got \(2, 42\)"),
        (np.full(42, np.nan), "correction 1 is NaN, it must be finite"),
        (np.full(42, 1e7), "size must be at most"),
    ],
)
def test_corrections_that_are_none_are_refused(corrections, words):
    robot = irbkin.Robot("IRB 2600-12/1.65")
    with pytest.raises(irbkin.InvalidModelError, match=words):
        robot.with_corrections(corrections)


def test_corrected_coupled_axes_stay_nearly_parallel():
    robot = irbkin.Robot("IRB 2400-10/1.55")
    assert robot.with_corrections(np.full(42, 1e-3)).is_coupled
    twist = np.zeros(42)
    twist[6 + 5 * 2] = 0.1
    with pytest.raises(irbkin.InvalidModelError, match=r"5\.7 deg off parallel, at most 2\.9 deg"):
        robot.with_corrections(twist)
