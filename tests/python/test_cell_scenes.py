"""Scenes of others as cells: URDF with doors and drawers, MoveIt's messages."""

import array
from types import SimpleNamespace

import irbkin
import numpy as np
import pytest
from irbkin.body import Body, Shape

# Its body is a ball at the flange: what is nearest is an obstacle, not the arm itself.
BALL = Body([6], [[0, 0, 0, 0, 0, 0, 1e-3]], [])
ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_body(BALL)
Q = np.random.default_rng(5).uniform(-2, 2, (400, 6))
NAN, INF = float("nan"), float("inf")


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
    return irbkin.Cell.load(path, joints=joints)


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
        irbkin.Cell.load(path, joints={"a": 1})
    with pytest.raises(irbkin.InvalidModelError, match="joints are of a URDF, and this is a"):
        irbkin.Cell.load({"world": {"collision_objects": []}}, joints={"a": 1})


TETRAHEDRON = [[0, 0, 0], [0.3, 0, 0], [0, 0.3, 0], [0, 0, 0.3]]
FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
BOX = {"type": "box", "dimensions": [0.3, 0.4, 0.5]}
AT = {"position": [1.0, 0.2, 0.3], "orientation": [0.0, 0.0, 0.6, 0.8]}
T_AT = shift(1, 0.2, 0.3) @ turn(2 * np.arctan2(0.6, 0.8), (0, 0, 1))
SHELF = {"position": {"x": 0.1, "y": 0.0, "z": -0.2}, "orientation": {"x": 0.6, "w": 0.8}}
T_SHELF = shift(0.1, 0, -0.2) @ turn(2 * np.arctan2(0.6, 0.8), (1, 0, 0))


def scene(*objects, **more):
    return {"world": {"collision_objects": list(objects)}, **more}


def box(name="box", **more):
    return {"id": name, "pose": AT, "primitives": [BOX]} | more


OBJECTS = [
    # A pose beside the poses of shapes is that of the object: they are in its frame.
    {"id": "box", "pose": AT, "primitives": [BOX], "primitive_poses": [SHELF]},
    {
        "id": "both",
        "primitives": [
            {"type": 2, "dimensions": [0.2]},
            {"type": "Cylinder", "dimensions": [0.5, 0.1]},
        ],
        "primitive_poses": [AT, SHELF],
    },
    {
        "id": "mesh",
        "pose": AT,
        "meshes": [
            {
                "vertices": [dict(zip("xyz", row, strict=True)) for row in TETRAHEDRON],
                "triangles": [{"vertex_indices": row} for row in FACES],
            }
        ],
    },
    {"id": "plane", "planes": [{"coef": [0.0, 0.0, 2.0, 1.0]}], "plane_poses": [{}]},
]
EXPECTED = {
    "box": Shape.box([0.3, 0.4, 0.5], T_AT @ T_SHELF),
    "both": Shape.union([Shape.sphere(0.2, T_AT[:3, 3]), Shape.cylinder(0.1, 0.5, T_SHELF)]),
    "mesh": Shape.mesh(np.array(TETRAHEDRON)[FACES], T_AT),
    "plane": Shape.half_space([0, 0, 1], [0, 0, -0.5]),
}


class Ros2:
    """A message of rclpy: its slots are private, its fields are listed."""

    def __init__(self, **fields):
        self._fields = {key: ros2(own) for key, own in fields.items()}

    def get_fields_and_field_types(self):
        return dict.fromkeys(self._fields, "")

    def __getattr__(self, name):
        if name not in self._fields:
            raise AttributeError(name)
        return self._fields[name]


def ros2(value):
    if isinstance(value, dict):
        return Ros2(**value)
    if isinstance(value, list):
        is_numbers = value and all(isinstance(own, float) for own in value)
        return array.array("d", value) if is_numbers else tuple(map(ros2, value))
    return value


def plain(value):
    """A message of ROS 1, whose fields are attributes."""
    if isinstance(value, dict):
        return SimpleNamespace(**{key: plain(own) for key, own in value.items()})
    return [plain(own) for own in value] if isinstance(value, list) else value


@pytest.mark.parametrize("form", [dict, plain, Ros2], ids=["dict", "ros1", "ros2"])
def test_a_planning_scene_is_the_cell_that_it_describes(form):
    message = scene(*OBJECTS)
    if form is not dict:
        message = plain(message) if form is plain else ros2(message)
    assert_same(irbkin.Cell.load(message), EXPECTED)
    world = message["world"] if form is dict else message.world
    assert irbkin.Cell.load(world) == irbkin.Cell.load(message)


@pytest.mark.parametrize("remove", [1, "remove", b"\x01", "\x01"])
def test_operations_are_done_in_their_order(remove):
    gone = {"id": "box", "operation": remove}
    cell = irbkin.Cell.load(scene(box(), box("left"), gone, box(operation=b"\x00")))
    assert list(cell.obstacles) == ["left", "box"]
    assert irbkin.Cell.load(scene(box(), {"operation": remove})) == irbkin.Cell()
    more = box(operation="append", primitives=[{"type": "sphere", "dimensions": [0.6]}])
    both = Shape.union([Shape.box([0.3, 0.4, 0.5], T_AT), Shape.sphere(0.6, T_AT[:3, 3])])
    assert_same(irbkin.Cell.load(scene(box(), more)), {"box": both})


def framed(frame, **more):
    return box(header={"frame_id": frame}, **more)


def fixed(frame, planning="world"):
    transform = {"translation": SHELF["position"], "rotation": SHELF["orientation"]}
    return {
        "header": {"frame_id": frame},
        "child_frame_id": planning,
        "transform": transform,
    }


def test_an_object_in_a_known_frame_is_placed_by_it():
    """MoveIt names the planning frame as the child of the others."""
    there = Shape.box([0.3, 0.4, 0.5], T_SHELF @ T_AT)
    here = Shape.box([0.3, 0.4, 0.5], T_AT)
    frames = [fixed("shelf"), fixed("world")]
    for frame, shape in [("shelf", there), ("/world", here), ("", here)]:
        message = scene(framed(frame), fixed_frame_transforms=frames)
        assert_same(irbkin.Cell.load(message), {"box": shape})
    # One frame of all objects is the world where nothing else says what is.
    assert_same(irbkin.Cell.load(scene(framed("base"))), {"box": here})


DEFAULT = {"default_entry_names": ["box"], "default_entry_values": [True]}
ACM = {"entry_names": ["link", "box"], "entry_values": [[False, True], {"enabled": [True, False]}]}


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (scene(box(primitives=[{"type": 4, "dimensions": [1, 1]}])), "box.*type: is 'cone'; known"),
        (scene(box(primitives=[{"type": 9, "dimensions": [1, 1]}])), "type: is 9; known: box"),
        (scene(box(primitives=[{"dimensions": [1, 1]}])), r"box\.primitives\[0\]\.type: is ''"),
        (scene(box(primitives=[BOX | {"dimensions": [1, 1]}])), r"box.*\[1, 1\].* 3 numbers"),
        (scene(box(primitives=[BOX | {"dimensions": [1, 1, 0]}])), "box: size is 0 m"),
        (scene(box(primitives=[BOX | {"dimensions": [1, -1, 1]}])), "box: size is -1 m"),
        (scene(box(primitives=[BOX | {"dimensions": [1, NAN, 1]}])), "box: size is NaN m"),
        (scene(box(primitives=[BOX | {"dimensions": [800, 1, 1]}])), "box.*800 m.*millimeters"),
        (scene(box(pose={"position": [850.0, 0, 0]})), "box: moved .* 850 m, .*millimeters"),
        (scene(box(pose={"position": [INF, 0, 0]})), r"box\.pose: xyz\[0\] is inf"),
        (scene(box(pose={"orientation": [0, 0, 1, 1]})), r"box\.pose: quaternion norm"),
        (scene(box(pose={"positon": [0, 0, 0]})), "positon: unknown key; did you mean position"),
        (scene(box(primitive_poses=[AT, AT])), "has 1 primitives and 2 primitive_poses"),
        (scene({"id": "box", "primitives": [BOX]}), "has 1 primitives and 0 primitive_poses"),
        (scene(box(primitives=[])), "box: has no shape"),
        (scene(box(size=[1, 1, 1])), "box.size: unknown key"),
        (scene(box(""), box()), r"collision_objects\[0\]: has no id"),
        (scene(box(), box()), "box: is added twice"),
        (scene(box(operation=3)), "box.operation: is 'move'"),
        (scene({"id": "bx", "operation": 1}), "bx: is removed, but was not added"),
        (scene(framed("tool0"), framed("base")), "box: is in the frame tool0; .* not known"),
        (
            scene(framed("tool0"), fixed_frame_transforms=[fixed("shelf")]),
            "box: is in the frame tool0; .* are world, shelf",
        ),
        (
            scene(framed("odom"), robot_state={"joint_state": {"header": {"frame_id": "map"}}}),
            "box: is in the frame odom; .* are map",
        ),
        (scene(fixed_frame_transforms=[fixed("a"), fixed("b", "c")]), "in c, another one in world"),
        (
            scene(
                robot_state={"attached_collision_objects": [{"link_name": "l", "object": box()}]}
            ),
            "box is attached to l and moves with the arm: .* robot.with_attached",
        ),
        (
            {"world": {"octomap": {"octomap": {"data": [1]}}}},
            "octomap: is not read: .*Shape.points",
        ),
        (
            scene(box(), link_padding=[{"link_name": "l", "padding": 0.1}]),
            "of l is 0.1: a cell has",
        ),
        (
            scene(box(), link_scale=[{"link_name": "l", "scale": 1.1}]),
            "of l is 1.1: a cell has a m",
        ),
        (scene(box(), allowed_collision_matrix=ACM), r"lets box be touched: .* may_touch=..\"box"),
        (scene(box(), wrld=1), "wrld: unknown key; did you mean world"),
        ({"start_state": {}}, "is no PlanningScene: it has no world"),
        ({"world": {"collision_objects": [3]}}, r"collision_objects\[0\] is 3, it must be a table"),
        ({"world": {"collision_objects": {}}}, "is {}, it must be a list"),
        (
            scene({"id": "m", "pose": {}, "meshes": [{"vertices": [[0, 0, 0]]}]}),
            "m.*must have vert",
        ),
        (
            scene(
                {
                    "id": "m",
                    "pose": {},
                    "meshes": [{"vertices": TETRAHEDRON, "triangles": [[0, 1, -1]]}],
                }
            ),
            "must have vertices of three numbers, and triangles of three of their numbers",
        ),
        (
            scene({"id": "p", "pose": {}, "planes": [{"coef": [0, 0, 0, 1]}]}),
            "p: normal has length",
        ),
    ],
)
def test_what_a_scene_has_and_a_cell_cannot_is_named(message, words):
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.Cell.load(message)


def test_what_of_a_robot_says_nothing_of_obstacles_is_passed_over():
    message = scene(
        box(type={"key": "", "db": ""}, subframe_names=[], subframe_poses=[]),
        name="(noname)+",
        robot_model_name="panda",
        robot_state={"joint_state": {"name": ["j"], "position": [0.1]}},
        link_padding=[{"link_name": "l", "padding": 0.0}],
        link_scale=[{"link_name": "l", "scale": 1.0}],
        object_colors=[],
        is_diff=True,
        allowed_collision_matrix=ACM | {"entry_names": ["link", "link_2"]},
    )
    assert_same(irbkin.Cell.load(message), {"box": Shape.box([0.3, 0.4, 0.5], T_AT)})


def test_what_is_no_scene_is_a_type_error():
    with pytest.raises(TypeError, match="a path, a PlanningScene or its dict, not int"):
        irbkin.Cell.load(3)


def test_an_open_mesh_of_a_message_is_a_surface_only_when_that_is_asked_for():
    part = {"id": "part", "pose": {}, "meshes": [{"vertices": TETRAHEDRON, "triangles": FACES[1:]}]}
    with pytest.raises(irbkin.InvalidModelError, match=r"part.*: the mesh is not closed"):
        irbkin.Cell.load(scene(part))
    cell = irbkin.Cell.load(scene(part), solid=False)
    assert not cell.obstacles["part"].data()["shapes"][0]["solid"]
