"""Figures of controllers: taught targets with confdata, joints and pose of one moment, limits."""

import re
from collections import Counter

import irbkin
import numpy as np
import pytest
from cases import numbers, read
from reference import pose_of

TAUGHT = read("abb_taught_confdata.csv")
PAIRS = read("abb_controller_pairs.csv")
LIMITS = read("abb_moc_limits.csv")
Q = tuple(f"j{axis}" for axis in range(1, 7))
CONFDATA = ("cf1", "cf4", "cf6", "cfx")
OUTSIDE = re.compile(r"q(\d) = (-?[\d.]+) deg is [\d.]+ deg outside the quarter of cf\d (-?\d+)")
BEYOND = re.compile(r"q(\d) = (-?[\d.]+) deg, limit (-?[\d.]+)")
DIFFERENT = {
    ("IRB 4600-40/2.55", "2"): "narrowed by its owner; another controller has the catalog's",
}
"""Axes whose limits in a controller's configuration are not the catalog's, and why."""


def frame(row, name):
    """A frame of a row [m]."""
    fields = [f"{name}_{part}" for part in ("x", "y", "z", "qw", "qx", "qy", "qz")]
    xyz, wxyz = np.split(numbers(row, fields), [3])
    return pose_of(xyz / 1e3, wxyz)


def tool_pose(row):
    """The pose of the tool in the base frame."""
    fields = ("trans_x", "trans_y", "trans_z", "rot_qw", "rot_qx", "rot_qy", "rot_qz")
    xyz, wxyz = np.split(numbers(row, fields), [3])
    in_world = frame(row, "wobj") @ pose_of(xyz / 1e3, wxyz)
    return np.linalg.inv(frame(row, "base")) @ in_world


def target(row):
    """Arm with its tool, pose and confdata of a row."""
    robot = irbkin.Robot(row["arm"]).with_tool(frame(row, "tool"))
    return robot, tool_pose(row), tuple(int(row[field]) for field in CONFDATA)


@pytest.mark.parametrize("agrees", ["1", "0"])
def test_taught_targets_have_their_confdata_or_the_reason(agrees):
    counts = Counter()
    for row in TAUGHT:
        if row["agrees"] != agrees:
            continue
        robot, pose, confdata = target(row)
        if agrees == "1":
            q = robot.ik_configured(pose, confdata)
            assert np.abs(robot.fk(q) - pose).max() < 1e-12, row
            of_quarters = zip(np.degrees(q)[[0, 3, 5]], confdata, strict=False)
            assert all(-0.01 <= angle - 90 * cf <= 90.01 for angle, cf in of_quarters), row
        else:
            with pytest.raises(irbkin.UnreachableError) as error:
                robot.ik_configured(pose, confdata)
            check_reason(row, robot, pose, error.value)
        counts[confdata[3]] += 1
    wanted = {0: 428, 1: 159, 2: 8, 4: 4, 5: 6} if agrees == "1" else {0: 27, 1: 8}
    assert counts == wanted


def check_reason(row, robot, pose, error):
    """The joint that the note of a row names has the angle that it says in some solution, and is
    outside the quarter or the limit by what it says.
    """
    reasons = [*OUTSIDE.findall(row["note"]), *BEYOND.findall(row["note"])]
    assert reasons, row["note"]
    solutions = [it.q_deg for it in robot.ik(pose)]
    for axis, degrees, _ in reasons:
        shown = float(degrees)
        apart = [abs((q[int(axis) - 1] - shown + 180) % 360 - 180) for q in solutions]
        # Four digits.
        assert min(apart) < 0.51 * 10.0 ** (len(str(int(abs(shown)))) - 4), row["note"]
    assert str(error)


@pytest.mark.parametrize("row", PAIRS, ids=lambda row: row["name"])
def test_joints_and_pose_of_one_moment_agree(row):
    robot = irbkin.Robot(row["arm"]).with_tool(frame(row, "tool"))
    found = robot.fk(np.radians(numbers(row, Q)))
    degrees = float(row["tol_deg"])
    if row["kind"] == "coupled_home":
        # The elevation of the flange's axes above the horizontal.
        named = {"z": row["flange_z_elevation_deg"], "x": row["flange_x_elevation_deg"]}
        elevations = {axis: float(text) for axis, text in named.items() if text}
        assert elevations
        for axis, wanted in elevations.items():
            own = np.degrees(np.arcsin(found[2, "xyz".index(axis)]))
            assert own == pytest.approx(wanted, abs=degrees)
        return
    wanted = tool_pose(row)
    assert np.linalg.norm(found[:3, 3] - wanted[:3, 3]) * 1e3 <= float(row["tol_mm"])
    turn = found[:3, :3].T @ wanted[:3, :3]
    assert np.degrees(np.arccos(min(1.0, (np.trace(turn) - 1) / 2))) <= degrees


def test_limits_of_controllers_are_the_catalogs_or_known_to_differ():
    differing = {}
    for row in LIMITS:
        lower, upper = np.degrees(irbkin.Robot(row["arm"]).limits[int(row["axis"]) - 1])
        own = numbers(row, ("lower_deg", "upper_deg"))
        if np.abs(own - (lower, upper)).max() > 0.06:
            differing[row["arm"], row["axis"]] = row["note"]
    assert len(LIMITS) == 109
    assert set(differing) == set(DIFFERENT)


def test_the_linkage_of_an_irb_6660_is_limited():
    robot = irbkin.Robot("IRB 6660-205/1.9")
    np.testing.assert_allclose(np.degrees(robot.linkage_limits), [-70, 70])
    beyond = np.radians([0, -40, 60, 0, 30, 0])
    assert "the linkage (serial joint 3) by 30.0 deg" in robot.check_pose(robot.fk(beyond)).reason
