"""Limits and speeds of the catalogue against the golden figures."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOGUE


@pytest.mark.parametrize("name", CATALOGUE)
def test_limits_are_the_golden_ones(name):
    np.testing.assert_allclose(np.rad2deg(irbkin.Robot(name).limits), CATALOGUE[name].limits_deg, rtol=4e-16, atol=0)


@pytest.mark.parametrize("name", CATALOGUE)
def test_speeds_are_the_golden_ones_or_none(name):
    found, golden = irbkin.Robot(name).max_velocity, CATALOGUE[name].velocity_deg_s
    if golden is None:
        assert found is None
    else:
        np.testing.assert_allclose(np.rad2deg(found), golden, rtol=4e-16, atol=0)


@pytest.mark.parametrize("name", ABB)
def test_an_arm_reaches_about_what_its_name_says(name):
    """The number behind the stroke is the maker's reach [m], to the wrist centre, in steps of 50 mm at worst."""
    a1, elbow, _, upper, forearm, _ = ABB[name].lengths
    assert a1 + upper + np.hypot(elbow, forearm) == pytest.approx(float(name.split("/")[1]), abs=0.05)


@pytest.mark.parametrize("name", CATALOGUE)
def test_the_zero_pose_of_an_abb_arm_is_inside_its_limits(name):
    low, high = irbkin.Robot(name).limits.T
    assert (low < high).all()
    if name in ABB:
        assert (low < 0).all()
        assert (high > 0).all()
