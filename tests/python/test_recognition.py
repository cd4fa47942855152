"""Arms given by Denavit-Hartenberg tables, their frames as odd as they come, are the same arms."""

from dataclasses import dataclass, field

import irbkin
import numpy as np
import pytest
from arms import ABB
from hypothesis import given
from hypothesis import strategies as st
from reference import apart, fk, reach, rounding, turn
from strategies import numbers

NAMES = sorted(ABB)


@dataclass
class Gauge:
    """A table that is changed without changing the arm: rows, the way from old to new joints, what
    is left over.
    """

    rows: np.ndarray
    signs: np.ndarray = field(default_factory=lambda: np.ones(6))
    shifts: np.ndarray = field(default_factory=lambda: np.zeros(6))
    left_over: np.ndarray = field(default_factory=lambda: np.eye(4))

    def joints(self, q):
        """Joints of the changed arm for those of the original."""
        return self.signs * q + self.shifts

    def about_z(self, i):
        """Frame i turned by pi about its z: Rz(pi) Rx(alpha) Tx(a) = Rx(-alpha) Tx(-a) Rz(pi)."""
        self.rows[i, 3] += np.pi
        if i < 5:
            self.rows[i + 1, :2] *= -1
            self.rows[i + 1, 3] += np.pi
        else:
            self.left_over = turn("z", np.pi) @ self.left_over

    def about_x(self, i):
        """Frame i turned by pi about its x: the joint turns the other way round."""
        self.rows[i, 0] += np.pi
        self.rows[i, 2:] *= -1
        self.signs[i] *= -1
        self.shifts[i] *= -1
        if i < 5:
            self.rows[i + 1, 0] -= np.pi
        else:
            self.left_over = turn("x", np.pi) @ self.left_over

    def zero(self, i, angle):
        """Joint i reads zero elsewhere."""
        self.rows[i, 3] += angle
        self.shifts[i] -= angle

    def slide(self, distance):
        """Along parallel axes the common normal may stand anywhere."""
        self.rows[1, 2] += distance
        self.rows[2, 2] -= distance * np.cos(self.rows[2, 0])

    def robot(self):
        return irbkin.Robot.from_mdh(self.rows).with_tool(self.left_over)


TURNS = st.tuples(st.sampled_from(["z", "x"]), st.integers(0, 5))


@st.composite
def gauges(draw):
    """(Name of an arm, a gauge that keeps its "up", its "front" and the side to which axis 5 points
    at zero).
    """
    name = draw(st.sampled_from(NAMES))
    gauge = Gauge(ABB[name].rows)
    # Axes 1 and 4 are shifted by less than a quarter: beyond, "front" and the sign of axis 5 are
    # read the other way.
    gauge.zero(0, draw(st.floats(-1.4, 1.4)))
    gauge.zero(3, draw(st.floats(-1.4, 1.4)))
    for joint in (1, 2, 4, 5):
        gauge.zero(joint, draw(st.floats(-3, 3)))
    for axis, i in draw(st.lists(TURNS, max_size=8)):
        gauge.about_z(i) if axis == "z" else gauge.about_x(i)
    gauge.slide(draw(st.floats(-1, 1)))
    return name, gauge


def limits_in_radians(name):
    return np.deg2rad(ABB[name].limits_deg).T


@given(gauges(), numbers(0, 1, 6))
def test_odd_frames_are_the_same_arm(drawn, parts):
    name, gauge = drawn
    original, odd = irbkin.Robot(name), gauge.robot()
    low, high = limits_in_radians(name)
    q = low + parts * (high - low)
    bound = rounding(reach(gauge.rows))
    np.testing.assert_allclose(odd.fk(gauge.joints(q)), original.fk(q), rtol=0, atol=bound)
    np.testing.assert_allclose(
        fk(gauge.rows, gauge.joints(q)) @ gauge.left_over, original.fk(q), rtol=0, atol=bound
    )


@given(gauges(), st.integers(0, 2**32 - 1))
def test_odd_frames_keep_every_solution_and_its_slot(drawn, seed):
    name, gauge = drawn
    original, odd = irbkin.Robot(name), gauge.robot()
    pose = original.fk(np.random.default_rng(seed).uniform(*limits_in_radians(name)))
    here, there = original.ik(pose), odd.ik(pose)
    sigma = min(original.singularity(solution.q).min_singular_value for solution in here)
    if sigma > 1e-3:
        bound = 2 * rounding(reach(gauge.rows)) * (1 + reach(gauge.rows)) / sigma
        assert [solution.slot for solution in there] == [solution.slot for solution in here]
        assert apart(there.q, gauge.joints(here.q)).max() <= bound
    assert max(solution.residual for solution in there) <= rounding(reach(gauge.rows))


@pytest.mark.parametrize("name", NAMES)
def test_half_turned_zeros_keep_every_solution(name):
    """With axis 1 or 4 read from behind, the slots may be others: the set is the same."""
    rng = np.random.default_rng(3)
    for joint in (0, 3):
        gauge = Gauge(ABB[name].rows)
        gauge.zero(joint, np.pi)
        original, odd = irbkin.Robot(name), gauge.robot()
        for q in rng.uniform(*limits_in_radians(name), (20, 6)):
            here, there = original.ik(original.fk(q)), odd.ik(original.fk(q))
            sigma = min(original.singularity(solution.q).min_singular_value for solution in here)
            assert len(here) == len(there)
            distances = apart(gauge.joints(here.q)[:, None], there.q[None])
            assert sorted(distances.argmin(axis=1)) == list(range(len(here)))
            assert distances.min(axis=1).max() <= max(
                1e-9, 2 * rounding(reach(gauge.rows)) * 4 / sigma
            )


def test_a_catalog_arm_is_recognized_in_its_own_table():
    for name, arm in ABB.items():
        robot = irbkin.Robot.from_mdh(arm.rows, limits=np.deg2rad(arm.limits_deg))
        q = np.deg2rad([10, 20, -30, 40, 50, 60])
        own, catalog = robot.ik(robot.fk(q)), irbkin.Robot(name).ik(robot.fk(q))
        assert robot.structure == "spherical wrist"
        np.testing.assert_array_equal(own.status, catalog.status)
        np.testing.assert_allclose(own.q, catalog.q, rtol=0, atol=1e-12)


def test_an_arm_with_a_flange_behind_its_wrist_closes():
    """c4 = 0 and c4 < 0 are arms too."""
    for length in (0.0, -0.085):
        rows = ABB["IRB 2600-12/1.65"].rows.copy()
        rows[5, 2] = length
        robot = irbkin.Robot.from_mdh(rows)
        q = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
        solutions = robot.ik(robot.fk(q))
        assert len(solutions) == 8
        assert apart(solutions.q, q).min() <= 1e-9
