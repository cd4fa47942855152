"""Scenes of others as cells: URDF with doors and drawers."""

import irbkin
import numpy as np
import pytest
from irbkin import _cell
from irbkin.body import Body, Shape

# Its body is a ball at the flange: what is nearest is an obstacle, not the arm itself.
BALL = Body([6], [[0, 0, 0, 0, 0, 0, 1e-3]], [])
ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_body(BALL)
Q = np.random.default_rng(5).uniform(-2, 2, (400, 6))
NAN = float("nan")


def assert_same(cell, obstacles):
    """Two cells are equally far from the arm, obstacle by obstacle."""
    assert list(cell.obstacles) == list(obstacles)
    for name, shape in obstacles.items():
        one = irbkin.Cell({name: cell.obstacles[name]}).distance(ROBOT, Q).distance
        other = irbkin.Cell({name: shape}).distance(ROBOT, Q).distance
        np.testing.assert_allclose(one, other, atol=1.1e-7, err_msg=name)
        assert np.ptp(one) > 0.5


def link(name, shape="", origin=""):
    geometry = f"<collision>{origin}<geometry>{shape}</geometry></collision>" if shape else ""
    return f'<link name="{name}">{geometry}</link>'


def joint(name, kind, parent, child, more=""):
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{more}</joint>'


def arm(count=6):
    """Links and joints of an arm on the link `foot`."""
    links = [link("foot"), *(link(f"l{at}") for at in range(1, count + 1))]
    names = ["foot", *(f"l{at}" for at in range(1, count + 1))]
    joints = [joint(f"j{at}", "revolute", names[at - 1], names[at]) for at in range(1, count + 1)]
    return "".join(links + joints)


HALF = 'quat_xyzw="0 0 0.70710678118654757 0.70710678118654757"'
DOORS = "".join(
    [
        link("world"),
        link("cupboard", '<box size="0.4 0.8 1"/>'),
        link("door", '<box size="0.02 0.4 1"/>', f'<origin xyz="0 0.2 0" {HALF}/>'),
        link("handle", '<capsule radius="0.02" length="0.1"/>'),
        link("other", '<box size="0.02 0.4 1"/>'),
        link("drawer", '<cylinder radius="0.2" length="0.1"/>'),
        joint("fix", "fixed", "world", "cupboard", '<origin xyz="1 0 0.5" rpy="0 0 0.3"/>'),
        joint(
            "door_joint",
            "revolute",
            "cupboard",
            "door",
            '<origin xyz="-0.2 -0.4 0" rpy="0.1 0 0"/><axis xyz="0 0 2"/>'
            '<limit lower="-1.5" upper="0.2"/>',
        ),
        joint("handle_joint", "continuous", "door", "handle", '<origin xyz="0 0.3 0"/>'),
        joint(
            "other_joint",
            "revolute",
            "cupboard",
            "other",
            '<origin xyz="-0.2 0.4 0"/><axis xyz="0 0 1"/><limit lower="0" upper="2"/>'
            '<mimic joint="door_joint" multiplier="-0.5" offset="0.1"/>',
        ),
        joint(
            "drawer_joint",
            "prismatic",
            "cupboard",
            "drawer",
            '<axis xyz="-1 0 0"/><limit lower="0" upper="0.4"/>',
        ),
    ]
)
ARM_TOO = joint("stand", "fixed", "world", "foot") + arm()


def urdf(folder, content, joints=None):
    path = folder / "scene.urdf"
    path.write_text(f"<robot name='scene'>{content}</robot>")
    return _cell.load(path, joints=joints)


def turn(angle, axis):
    """A rotation, by the formula of Rodrigues."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    T = np.eye(4)
    T[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return T


def shift(x, y, z):
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


@pytest.mark.parametrize("arms", ["", ARM_TOO])
@pytest.mark.parametrize(("door", "handle", "drawer"), [(0.0, 0.0, 0.0), (-1.2, 7.0, 0.31)])
def test_doors_and_drawers_are_where_their_joints_are_given(tmp_path, arms, door, handle, drawer):
    given = {"door_joint": door, "handle_joint": handle, "drawer_joint": drawer}
    cell = urdf(tmp_path, DOORS + arms, given)
    cupboard = shift(1, 0, 0.5) @ turn(0.3, (0, 0, 1))
    leaf = cupboard @ shift(-0.2, -0.4, 0) @ turn(0.1, (1, 0, 0)) @ turn(door, (0, 0, 1))
    grip = leaf @ shift(0, 0.3, 0) @ turn(handle, (1, 0, 0))
    other = cupboard @ shift(-0.2, 0.4, 0) @ turn(0.1 - 0.5 * door, (0, 0, 1))
    ends = [(grip @ [0, 0, z, 1])[:3] for z in (-0.05, 0.05)]
    expected = {
        "cupboard": Shape.box([0.4, 0.8, 1], cupboard),
        "door": Shape.box([0.02, 0.4, 1], leaf @ shift(0, 0.2, 0) @ turn(np.pi / 2, (0, 0, 1))),
        "other": Shape.box([0.02, 0.4, 1], other),
        "drawer": Shape.cylinder(0.2, 0.1, cupboard @ shift(-drawer, 0, 0)),
        "handle": Shape.capsule(*ends, 0.02),
    }
    assert_same(cell, expected)


GIVEN = {"door_joint": 0.0, "handle_joint": 0.0, "drawer_joint": 0.0}
PLANE = joint("p", "planar", "world", "slab") + link("slab")


@pytest.mark.parametrize(
    ("content", "joints", "words"),
    [
        # Each is asked for with its limits; what follows another one is not.
        (
            DOORS,
            None,
            r"the joints door_joint and drawer_joint both begin an arm or .* joints={\"door_joint\""
            r": 0}: door_joint \(-1.5 to 0.2 rad\), handle_joint \(any rad\), drawer_joint "
            r"\(0 to 0.4 m\)$",
        ),
        (
            DOORS + ARM_TOO,
            None,
            r"door_joint and drawer_joint and j1 all .* drawer_joint \(0 to 0.4 m\)$",
        ),
        # One door, alone or with its handle, is no arm that may be left out.
        (DOORS, {"drawer_joint": 0.1}, "the joint door_joint begins an arm or what moves beside"),
        (DOORS, GIVEN | {"door_joint": 0.3}, r"door_joint \(-1.5 to 0.2 rad\) cannot be at 0.3"),
        (DOORS, GIVEN | {"handle_joint": NAN}, "handle_joint .any rad. cannot be at nan"),
        (DOORS, GIVEN | {"dor_joint": 0.1}, "no joint dor_joint that moves; did you mean door_joi"),
        (DOORS, GIVEN | {"fix": 0.1}, "no joint fix that moves"),
        (DOORS, GIVEN | {"other_joint": 0.1}, "other_joint follows door_joint: give where that is"),
        (link("world") + PLANE, None, r"p \(planar: make it fixed\)"),
        (link("world") + PLANE, {"p": 0}, r"p \(planar: make it fixed\) cannot be at 0"),
        (arm(5), None, "the joint j1 begins an arm .* of 6 joints or more"),
        (
            DOORS.replace("collision", "visual"),
            GIVEN,
            "only visual shapes stand still, .* cupboard",
        ),
        (DOORS + link("door"), GIVEN, "two links have the name door"),
        (
            DOORS
            + link("a")
            + link("b")
            + joint("c", "fixed", "a", "b")
            + joint("d", "fixed", "b", "a"),
            GIVEN,
            "the link a hangs on itself",
        ),
        (
            DOORS.replace('xyz="0 0 2"', 'xyz="0 0 0"'),
            GIVEN,
            "axis of the joint door_joint is zero",
        ),
        (DOORS.replace('rpy="0 0 0.3"', f'rpy="0 0 0" {HALF}'), GIVEN, "has rpy and quat_xyzw"),
        (DOORS.replace("0.70710678118654757", "1"), GIVEN, "link door: quaternion norm"),
        (DOORS.replace('xyz="1 0 0.5"', 'xyz="1000 0 500"'), GIVEN, "1000 m, .* in millimeters"),
    ],
)
def test_nothing_that_moves_is_left_out_of_a_urdf(tmp_path, content, joints, words):
    with pytest.raises(irbkin.InvalidModelError, match=words):
        urdf(tmp_path, content, joints)


def test_joints_are_of_a_urdf_alone(tmp_path):
    path = tmp_path / "cell.toml"
    path.write_text("")
    with pytest.raises(irbkin.InvalidModelError, match=r"joints are of a URDF, not of .*\.toml"):
        _cell.load(path, joints={"a": 1})
