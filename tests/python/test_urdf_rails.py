"""Arms on the rail or lift of their URDF, against a chain of NumPy that slides and turns."""

import pickle
from pathlib import Path
from xml.etree import ElementTree

import irbkin
import numpy as np
import pytest
from irbkin import Robot, rapid
from reference import move, turn

DATA = Path(__file__).parents[1] / "data"
RAIL = """<link name="floor"/><link name="beam"/><link name="carriage"/>
<joint name="stand" type="fixed"><parent link="floor"/><child link="beam"/>
 <origin xyz="0.4 -1.5 0.2" rpy="0.1 -0.2 0.7"/></joint>
<joint name="rail" type="prismatic"><parent link="beam"/><child link="carriage"/>
 <origin xyz="0.1 0 0.3" rpy="0 0.3 0"/><axis xyz="0.1 2 0"/>
 <limit lower="{}" upper="{}" velocity="0.6"/></joint>
<joint name="mount" type="fixed"><parent link="carriage"/><child link="{}"/>
 <origin xyz="0 0.05 0.1" rpy="0 0 0.5"/></joint></robot>"""
LIMITS = [(-0.5, 2.5), (0.5, 2.0), (-2.0, -0.75)]
Q = np.array([0.2, -0.4, 0.6, 0.5, -0.7, 0.3])


def on_rail(name="irb2600", limits=LIMITS[0], root="base_link"):
    return (DATA / f"{name}.urdf").read_text().replace("</robot>", RAIL.format(*limits, root))


def fk(text, tip, at):
    """The tip in the root of a URDF, its joints where `at` has them."""
    joints = {it.find("child").get("link"): it for it in ElementTree.fromstring(text).iter("joint")}
    pose = np.eye(4)
    while tip in joints:
        joint = joints[tip]
        tip = joint.find("parent").get("link")
        origin, axis = joint.find("origin"), joint.find("axis")
        value = at.get(joint.get("name"), 0.0)
        motion = np.eye(4)
        if axis is not None:
            axis = np.array(axis.get("xyz").split(), dtype=float)
            axis /= np.linalg.norm(axis)
            K = np.cross(np.eye(3), axis)
            if joint.get("type") == "prismatic":
                motion[:3, 3] = value * axis
            else:
                motion[:3, :3] += np.sin(value) * K + (1 - np.cos(value)) * K @ K
        if origin is not None:
            roll, pitch, yaw = np.array(origin.get("rpy", "0 0 0").split(), dtype=float)
            place = move(*np.array(origin.get("xyz", "0 0 0").split(), dtype=float))
            motion = place @ turn("z", yaw) @ turn("y", pitch) @ turn("x", roll) @ motion
        pose = motion @ pose
    return pose


@pytest.mark.parametrize("limits", LIMITS)
@pytest.mark.parametrize(
    ("name", "root", "tip"),
    [("irb2600", "base_link", "tool0"), ("ur5e", "base_link", "tool0"),
     ("iiwa14", "link_0", "link_ee")],
)  # fmt: skip
def test_fk_at_a_position_is_the_files(name, root, tip, limits):
    text = on_rail(name, limits, root)
    robot = Robot.from_urdf(text, tip=tip)
    start = min(max(0.0, limits[0]), limits[1])
    rng = np.random.default_rng(1)
    for x in [start, *limits, *rng.uniform(*limits, 20)]:
        q = rng.uniform(-2, 2, robot.dof)
        at = dict(zip(robot.joint_names, q, strict=True), rail=x)
        # Right angles with a few digits are made exact.
        np.testing.assert_allclose(robot.at(x).fk(q), fk(text, tip, at), rtol=0, atol=1e-8)
    np.testing.assert_allclose(robot.base, robot.at(start).base, rtol=0, atol=1e-15)
    np.testing.assert_allclose(robot.base, fk(text, "carriage", {"rail": start}), atol=1e-14)
    track = robot.carrier
    assert isinstance(track, irbkin.Track)
    assert (track.lower, track.upper, track.max_velocity, track.steps) == (*limits, 0.6, 21)
    way = fk(text, "carriage", {"rail": 1.0}) - fk(text, "carriage", {})
    np.testing.assert_allclose(track.axis, way[:3, 3], rtol=0, atol=1e-15)
    assert "rail" not in robot.joint_names


@pytest.mark.parametrize("limits", LIMITS)
@pytest.mark.parametrize(("name", "root"), [("irb2600", "base_link"), ("iiwa14", "link_0")])
def test_a_plan_along_the_carrier_has_positions_of_the_file(name, root, limits):
    robot = Robot.from_urdf(on_rail(name, limits, root))
    q = np.append(Q, 0.4)[: robot.dof]
    ends = [robot.at(limits[0] + part * (limits[1] - limits[0])) for part in (0.1, 0.5, 0.9)]
    T = irbkin.paths.line(ends[0].fk(q), ends[2].fk(q), steps=25)
    plan = robot.plan(T, carrier=robot.carrier)
    assert np.ptp(plan.external) > 0.1
    for x, own, pose in zip(plan.external, plan.q, T, strict=True):
        np.testing.assert_allclose(robot.at(x).fk(own), pose, rtol=0, atol=1e-9)
    # Wherever the robot is, and however its rail is written.
    moved = ends[1].plan(T, carrier=robot.carrier)
    np.testing.assert_allclose(moved.external, plan.external, rtol=0, atol=1e-6)
    track = robot.carrier
    back = track._replace(axis=-np.array(track.axis), lower=-track.upper, upper=-track.lower)
    for x, own, pose in zip(*_rows(ends[1].plan(T, carrier=back)), T, strict=True):
        np.testing.assert_allclose(robot.at(-x).fk(own), pose, rtol=0, atol=1e-9)
    # Another track counts from where the robot is.
    across = irbkin.Track(np.cross(track.axis, [0, 0, 1]), -0.3, 0.3)
    T = irbkin.paths.line(ends[1].fk(q), ends[1].fk(q + 0.03), steps=5)
    for x, own, pose in zip(*_rows(ends[1].plan(T, carrier=[across])), T, strict=True):
        n = np.array(across.axis) / np.linalg.norm(across.axis)
        base = irbkin.pose(x * n) @ ends[1].base
        np.testing.assert_allclose(robot.with_base(base).fk(own), pose, rtol=0, atol=1e-9)


def _rows(plan):
    return plan.external, plan.q


def test_targets_are_seen_from_the_work_object():
    robot = Robot.from_urdf(on_rail(limits=LIMITS[1])).at(1.2)
    T = irbkin.paths.line(robot.at(0.7).fk(Q), robot.at(1.8).fk(Q), steps=12)
    plan = robot.plan(T, carrier=robot.carrier)
    targets = rapid.plan_targets(robot, plan, carrier=robot.carrier)
    np.testing.assert_allclose([it.trans_mm for it in targets], 1e3 * T[:, :3, 3], atol=1e-6)
    np.testing.assert_allclose([it.extax[0] for it in targets], 1e3 * plan.external[:, 0])


def test_the_rail_goes_with_the_base():
    robot = Robot.from_urdf(on_rail()).at(0.5)
    placed = robot.with_base(irbkin.pose([1, 2, 3], euler_zyx=[0.4, 0.5, 0.6]))
    relative = np.linalg.inv(robot.base) @ robot.at(1.7).base
    np.testing.assert_allclose(placed.at(1.7).base, placed.base @ relative, atol=1e-14)
    np.testing.assert_allclose(placed.at(0.5).base, placed.base, atol=1e-15)
    for changed in (
        robot.with_tool([0, 0, 0.1]),
        robot.with_limits(robot.limits * 0.9),
        robot.with_body(robot.approximate_body()),
        robot.coupled(),
    ):
        assert changed.carrier == robot.carrier
        np.testing.assert_array_equal(changed.at(1.7).base, robot.at(1.7).base)
        assert changed != robot
    seven = Robot.from_urdf(on_rail("iiwa14", root="link_0")).locked({3: 0.2})
    assert seven.at(0.3).carrier == seven.carrier is not None
    assert " on a rail of -0.5 to 2.5 m: 7 joints" in repr(seven)


def test_a_robot_on_a_rail_is_a_value():
    robot = Robot.from_urdf(on_rail())
    assert repr(robot) == '<Robot "irb2600" on a rail of -0.5 to 2.5 m: 6 joints, spherical wrist>'
    for one in (robot, robot.at(0.7), robot.at(2.5)):
        same = pickle.loads(pickle.dumps(one))
        assert same == one
        assert hash(same) == hash(one)
        assert same.carrier == one.carrier
        np.testing.assert_array_equal(same.at(0.1).base, one.at(0.1).base)
    assert robot.at(0.0) == robot != robot.at(0.7)
    bare = Robot.from_urdf((DATA / "irb2600.urdf").read_text())
    assert bare.carrier is None
    assert bare.with_base(robot.base) != robot
    # The rail is not written: the base is where it is.
    again = Robot.from_urdf(robot.at(0.7).to_urdf(), "world", "tool0", snap=0)
    assert again.carrier is None
    np.testing.assert_allclose(again.fk(Q), robot.at(0.7).fk(Q), rtol=0, atol=1e-14)


@pytest.mark.parametrize("position", [2.6, -0.6, 250, np.nan, np.inf, [np.nan]])
def test_a_position_is_inside_the_limits(position):
    with pytest.raises(irbkin.InvalidJointsError) as caught:
        Robot.from_urdf(on_rail()).at(position)
    assert str(caught.value).startswith("position is ")
    assert "it must be -0.5 to 2.5 m, the limits of the robot's carrier: pass" in str(caught.value)


def test_what_cannot_move_says_so():
    with pytest.raises(irbkin.InvalidModelError, match=r"has no carrier.*: with_base\(T\) moves"):
        Robot("UR5e").at(0.3)
    with pytest.raises(irbkin.InvalidJointsError, match=r"position must have shape \(\) or \(1,\)"):
        Robot.from_urdf(on_rail()).at([0.1, 0.2])
    with pytest.raises(TypeError, match="position must be real numbers"):
        Robot.from_urdf(on_rail()).at("0.1")
