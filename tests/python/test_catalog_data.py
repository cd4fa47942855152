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


SHEET, CAD = "data sheet", "speeds of work-r-labs/robots alone"
# ABB's data sheets (text in rox-architecture/RODEOS) and work-r-labs/robots: axis and limits [deg],
# speeds [deg/s].
FIGURES = {
    "IRB 8700-550/4.2": ({3: (-30, 132)}, (75, 60, 60, 85, 85, 115), SHEET),
    "IRB 8700-800/3.5": ({3: (-30, 132)}, (75, 60, 60, 85, 85, 115), SHEET),
    "IRB 1010-1.5/0.37": ({6: (-360, 360)}, (320, 320, 375, 500, 470, 500), SHEET),
    "IRB 1600-6/1.2": ({2: (-63, 110)}, (150, 160, 170, 320, 400, 460), SHEET),
    "IRB 1600-6/1.45": ({2: (-90, 120)}, (150, 160, 170, 320, 400, 460), SHEET),
    "IRB 1600-10/1.2": ({2: (-63, 110)}, (180, 180, 185, 385, 400, 460), SHEET),
    "IRB 1600-10/1.45": ({2: (-90, 120)}, (180, 180, 185, 385, 400, 460), SHEET),
    "IRB 6650S-90/3.9": ({2: (-40, 160)}, (100, 90, 90, 150, 120, 235), SHEET),
    "IRB 6650S-125/3.5": ({3: (-180, 70)}, (110, 90, 90, 150, 120, 235), SHEET),
    "IRB 6650S-200/3.0": ({5: (-120, 120)}, (110, 90, 90, 150, 120, 235), SHEET),
    "CRB 15000-10/1.52": ({}, (120, 120, 125, 200, 200, 200), CAD),
    "CRB 15000-12/1.27": ({}, (120, 120, 125, 200, 200, 200), CAD),
    "IRB 1100-4/0.475": ({}, (460, 360, 280, 560, 420, 750), CAD),
    "IRB 1100-4/0.58": ({}, (460, 360, 280, 560, 420, 750), CAD),
    "IRB 1520ID-4/1.5": ({}, (130, 140, 140, 320, 380, 460), CAD),
    "IRB 52-7/1.2": ({2: (-63, 110)}, (180, 180, 180, 320, 400, 460), CAD),
    "IRB 52-7/1.45": ({2: (-90, 120)}, (180, 180, 180, 320, 400, 460), CAD),
}


@pytest.mark.parametrize("name", FIGURES)
def test_figures_are_those_of_the_source_that_the_row_names(name):
    limits, speeds, source = FIGURES[name]
    robot = irbkin.Robot(name)
    for axis, ends in limits.items():
        np.testing.assert_allclose(np.rad2deg(robot.limits[axis - 1]), ends, rtol=4e-16)
    np.testing.assert_allclose(np.rad2deg(robot.max_velocity), speeds, rtol=4e-16)
    assert source in irbkin.catalog_entry(name).provenance


# libfranka, include/franka/rate_limiting.h: @ f3b8d775a9 (release 0.9.2), @ 6474466b74 [rad/s^2].
ACCELERATIONS = {"Panda": (15, 7.5, 10, 12.5, 15, 20, 20), "FR3": (10,) * 7}


@pytest.mark.parametrize("name", ACCELERATIONS)
def test_figures_of_franka_are_the_makers(name):
    entry = irbkin.catalog_entry(name)
    np.testing.assert_array_equal(entry.max_acceleration, ACCELERATIONS[name])
    assert "limits and speeds of frankaemika/franka_description" in entry.provenance
    assert "general knowledge" not in entry.provenance


def test_49_abb_arms_have_speeds():
    entries = [irbkin.catalog_entry(name) for name in irbkin.catalog()]
    abb = [it.max_velocity is not None for it in entries if it.maker == "ABB"]
    assert (sum(abb), len(abb)) == (49, 97)


# Figures of one source that the others do not have, and figures that no source decides.
DISAGREEING = {
    "CRB 1300-7/1.4": ["inferred: +-400 deg", "+-242 deg in the source are turns"],
    "CRB 1300-10/1.15": ["inferred: +-400 deg", "+-242 deg in the source are turns"],
    "CRB 1300-11/0.9": ["inferred: +-400 deg", "+-242 deg in the source are turns"],
    "IRB 1010-1.5/0.37": ["+-242 deg in RobotComponents: turns"],
    "IRB 1300-11/0.9": ["+-1520 rad, 242 turns"],
    "IRB 1200-7/0.7": ["axis 2 is to 130 deg", "unsettled", "+-400 deg", "224 and 297 deg/s"],
    "IRB 1200-5/0.9": ["224 and 297 deg/s", "unsettled"],
    "IRB 52-7/1.45": ["-63..110 and -235..55 deg", "unsettled"],
    "IRB 4400L-30/2.43": ["reach 2.478 m"],
    "IRB 6640-205/2.75": ["IFRA", "1280 mm"],
    "IRB 8700-550/4.2": ["-155..222 deg", "+-220 deg as an option"],
}


@pytest.mark.parametrize("name", DISAGREEING)
def test_a_figure_that_is_not_taken_is_named_with_its_source(name):
    provenance = irbkin.catalog_entry(name).provenance
    assert [it for it in DISAGREEING[name] if it not in provenance] == []


COUPLED = [it for it in irbkin.catalog() if irbkin.catalog_entry(it).is_coupled]


@pytest.mark.parametrize("name", COUPLED)
def test_axis_3_of_a_linkage_tilts_the_forearm_less_than_half_a_turn(name):
    """The controller measures it from the base: at 0 the forearm is level wherever axis 2 is. At
    +-90 deg the linkage is at its dead points, which it can pass on one side at most.
    """
    robot = irbkin.Robot(name)
    low, high = np.rad2deg(robot.limits[2])
    assert -90 < low < 0 < high < 180
    for q2 in robot.limits[1]:
        for q3 in robot.limits[2]:
            forearm = robot.link_frames([0, q2, q3, 0, 0, 0])[3, :3, 2]
            np.testing.assert_allclose(forearm, [np.cos(q3), 0, -np.sin(q3)], atol=1e-15)


def test_filters_take_a_least_figure_or_a_pair():
    # A figure that is not known meets no filter.
    names = tuple(name for name in irbkin.catalog() if name != "SO-101")
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
