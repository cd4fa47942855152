"""Limits and speeds of the catalog against the golden figures; what its filters let through."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG


@pytest.mark.parametrize("name", CATALOG)
def test_limits_are_the_golden_ones(name):
    np.testing.assert_allclose(
        np.rad2deg(irbkin.Robot(name).limits), CATALOG[name].limits_deg, rtol=4e-16, atol=0
    )


@pytest.mark.parametrize("name", CATALOG)
def test_speeds_are_the_golden_ones_or_none(name):
    found, golden = irbkin.Robot(name).max_velocity, CATALOG[name].velocity_deg_s
    if golden is None:
        assert found is None
    else:
        np.testing.assert_allclose(np.rad2deg(found), golden, rtol=4e-16, atol=0)


@pytest.mark.parametrize("name", ABB)
def test_an_arm_reaches_about_what_its_name_says(name):
    """The number behind the stroke is the maker's reach [m], to the wrist center, in steps of 50 mm
    at worst.
    """
    a1, elbow, _, upper, forearm, _ = ABB[name].lengths
    assert a1 + upper + np.hypot(elbow, forearm) == pytest.approx(
        float(name.split("/")[1]), abs=0.05
    )


@pytest.mark.parametrize("name", CATALOG)
def test_the_zero_pose_of_an_abb_arm_is_inside_its_limits(name):
    low, high = irbkin.Robot(name).limits.T
    assert (low < high).all()
    if name in ABB:
        assert (low < 0).all()
        assert (high > 0).all()


def test_filters_take_a_least_figure_or_a_pair():
    names = irbkin.catalog()
    assert irbkin.catalog(reach=0, payload=0) == names
    assert irbkin.catalog(reach=(1.65, 1.65), payload=(12, 20)) == (
        "IRB 2600-12/1.65",
        "IRB 2600-20/1.65",
    )
    assert irbkin.catalog(payload=[3, 3], reach=(0.5, 0.6)) == (
        "IRB 120-3/0.58",
        "IRB 120T-3/0.58",
        "UR3",
        "UR3e",
    )
    assert irbkin.catalog(payload=500, reach=4) == ("IRB 8700-550/4.2",)
    assert irbkin.catalog(reach=100) == ()
    far = irbkin.catalog(reach=2.5)
    assert list(far) == [name for name in names if name in far]
    assert set(irbkin.catalog(reach=(0, 2.4))) | set(irbkin.catalog(reach=2.5)) | {
        "IRB 4400L-30/2.43"
    } == set(names)


@pytest.mark.parametrize(
    ("filters", "message"),
    [
        (
            {"reach": "far"},
            r"^reach must be a number \(at least that much\) or a pair \(least, most\) \[m\], "
            r"got 'far'$",
        ),
        ({"payload": (1, 2, 3)}, r"^payload must be a number .* \[kg\], got \(1, 2, 3\)$"),
        ({"payload": -1}, "^payload is -1 kg, it must be 0 or more$"),
        ({"reach": np.nan}, "^reach is NaN m, it must be 0 or more$"),
        ({"reach": (1, np.nan)}, "^reach is NaN m, it must be 0 or more$"),
        ({"reach": (2, 1.5)}, r"^reach is empty: least 2 m > most 1.5 m$"),
    ],
    ids=str,
)
def test_an_invalid_filter_is_refused(filters, message):
    with pytest.raises(ValueError, match=message):
        irbkin.catalog(**filters)


def test_filters_are_named_or_in_order():
    assert irbkin.catalog(4, 500) == irbkin.catalog(reach=4, payload=500) != ()
    assert irbkin.catalog((1.65, 1.65)) == irbkin.catalog(reach=(1.65, 1.65)) != ()
    assert irbkin.catalog(None, 500) == irbkin.catalog(payload=500) != ()
    with pytest.raises(TypeError):
        irbkin.catalog(1.5, 3, 5)
