"""Bodies in URDF: where other programs see the shapes, and which shapes are read."""

import io
import re

import irbkin
import mujoco
import numpy as np
import pinocchio
import pytest
import yourdfpy
from irbkin import Robot
from irbkin.body import Body, Shape
from scipy.spatial.transform import Rotation

TORCH = [Shape.capsule([0, 0, 0.05], [0.05, 0, 0.3], 0.03), Shape.sphere(0.06, [0, 0, 0.06])]
ROBOTS = [
    Robot("IRB 2600-12/1.65").with_attached(TORCH).with_base(irbkin.pose([1, 2, 3])),
    Robot("UR5e").with_tool([0, 0, 0.2]).with_attached(TORCH),
    Robot("IRB 140-6/0.81"),
    Robot("IRB 2400-10/1.55").with_attached(TORCH[0]),
    Robot("Panda"),
]
IDS = [robot.name for robot in ROBOTS]


def frames(robot, q):
    """The frame of each link of the body, in the world."""
    flange = robot.with_tool(np.eye(4)).fk(q)
    return [robot.base, *robot.link_frames(q)[: robot.dof], flange]


def placed(robot, q):
    """Ends of the capsules in the world, and their radii."""
    body, poses = robot.body, frames(robot, q)
    found = []
    for link, row in zip(body.links, body.capsules, strict=True):
        found.append(
            [*(poses[link][:3, :3] @ row.reshape(-1)[:6].reshape(2, 3).T).T.ravel(), row[6]]
        )
        found[-1][:6] += np.tile(poses[link][:3, 3], 2)
    return np.array(found)


def spheres(robot, q):
    """Center and radius of every sphere that is written, sorted."""
    rows = placed(robot, q)
    ends = [rows[:, [0, 1, 2, 6]], rows[(rows[:, :3] != rows[:, 3:6]).any(axis=1)][:, 3:]]
    return ordered(np.vstack(ends))


def cylinders(robot, q):
    """Middle, radius and length of every cylinder that is written, sorted."""
    rows = placed(robot, q)
    length = np.linalg.norm(rows[:, :3] - rows[:, 3:6], axis=1)
    rows = np.column_stack([(rows[:, :3] + rows[:, 3:6]) / 2, rows[:, 6], length])
    return ordered(rows[length > 0])


def ordered(rows):
    rows = np.asarray(rows, float)
    return rows[np.lexsort(rows.round(6).T)]


def by_pinocchio(robot, q):
    text = robot.to_urdf(visual=True)
    model = pinocchio.buildModelFromXML(text, mimic=True)
    kinds = (pinocchio.GeometryType.COLLISION, pinocchio.GeometryType.VISUAL)
    made = [pinocchio.buildGeomFromUrdfString(model, text, kind) for kind in kinds]
    data, configuration = model.createData(), pinocchio.neutral(model)
    for number, angle in enumerate(q):
        joint = model.joints[model.getJointId(f"joint_{number + 1}")]
        configuration[joint.idx_q] = angle
    found = []
    for geometry in made:
        places = geometry.createData()
        pinocchio.updateGeometryPlacements(model, data, geometry, places, configuration)
        balls, rods = [], []
        for shape, place in zip(geometry.geometryObjects, places.oMg, strict=True):
            solid = shape.geometry
            if hasattr(solid, "halfLength"):
                rods.append([*place.translation, solid.radius, 2 * solid.halfLength])
            else:
                balls.append([*place.translation, solid.radius])
        found.append((ordered(balls), ordered(rods)))
    return found


def by_yourdfpy(robot, q):
    text = robot.to_urdf(visual=True)
    model = yourdfpy.URDF.load(io.BytesIO(text.encode()), load_meshes=False)
    names = [f"joint_{i + 1}" for i in range(robot.dof)]
    model.update_cfg(dict(zip(names, q, strict=True)))
    found = []
    for element in ("collisions", "visuals"):
        balls, rods = [], []
        for name, link in model.link_map.items():
            for shape in getattr(link, element):
                place = model.get_transform(name, model.base_link) @ shape.origin
                solid = shape.geometry
                if solid.cylinder is None:
                    balls.append([*place[:3, 3], solid.sphere.radius])
                else:
                    rods.append([*place[:3, 3], solid.cylinder.radius, solid.cylinder.length])
        found.append((ordered(balls), ordered(rods)))
    return found


@pytest.mark.parametrize("robot", ROBOTS, ids=IDS)
@pytest.mark.parametrize("build", [by_pinocchio, by_yourdfpy])
def test_shapes_are_where_the_link_frames_put_them(build, robot):
    for q in np.random.default_rng(3).uniform(-2, 2, (5, robot.dof)):
        for balls, rods in build(robot, q):
            np.testing.assert_allclose(balls, spheres(robot, q), rtol=0, atol=1e-9)
            np.testing.assert_allclose(rods, cylinders(robot, q), rtol=0, atol=1e-9)


def test_cylinders_lie_along_their_capsules():
    robot = ROBOTS[0]
    model = mujoco.MjModel.from_xml_string(robot.to_urdf(visual=True))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    rows = placed(robot, np.zeros(6))
    ways = (rows[:, 3:6] - rows[:, :3])[(rows[:, :3] != rows[:, 3:6]).any(axis=1)]
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    rods = model.geom_type == mujoco.mjtGeom.mjGEOM_CYLINDER
    assert rods.sum() == len(ways)
    found = data.geom_xmat[rods].reshape(-1, 3, 3)[:, :, 2]
    assert (np.abs(found @ ways.T).max(axis=1) > 1 - 1e-9).all()


@pytest.mark.parametrize("robot", ROBOTS, ids=IDS)
def test_the_body_is_read_back(robot):
    read = Robot.from_urdf(robot.to_urdf(visual=True), base="base_link", tip="tool0")
    assert (read.body.links == robot.body.links).all()
    np.testing.assert_allclose(read.body.capsules, robot.body.capsules, rtol=0, atol=1e-9)
    assert {pair for pair in read.body.pairs if pair[1] <= pair[0] + 1} == set()
    assert not read.body.is_approximate
    assert "URDF" in read.body.source
    assert (read.body.excess == 0).all()
    assert Robot.from_urdf(robot.to_urdf()).body is None


def arm(links):
    """A URDF of an IRB 2600 with elements in some links."""
    text = Robot("IRB 2600-12/1.65").to_urdf()
    for name, elements in links.items():
        assert f'<link name="{name}"/>' in text
        text = text.replace(f'<link name="{name}"/>', f'<link name="{name}">{elements}</link>')
    return text


def collision(shape, origin=""):
    return f"<collision>{origin}<geometry>{shape}</geometry></collision>"


def test_shapes_without_a_mesh_are_read():
    text = arm(
        {
            "base_link": collision('<cylinder radius="0.2" length="0.4"/>'),
            "link_2": collision('<box size="0.1 0.2 0.9"/>', '<origin xyz="0 0 0.35"/>'),
            "link_4": collision('<capsule radius="0.05" length="0.3"/>'),
            "tool0": collision('<sphere radius="0.1"/>', '<origin xyz="0 0 0.1" rpy="1 0 0"/>'),
        }
    )
    robot = Robot.from_urdf(text)
    body = robot.body
    assert set(body.links) == {0, 2, 4, 7}
    assert set(body.pairs) <= {(0, 2), (0, 4), (0, 7), (2, 4), (2, 7), (4, 7)}
    assert {(0, 4), (0, 7), (2, 7)} <= set(body.pairs)
    assert body.excess[[4, 7]].tolist() == [0, 0]
    assert 0 < body.excess[2] < 0.1
    # The box is upright at the lower arm: a corner of it is inside a capsule.
    q = [0.3, 0.2, -0.1, 0, 0, 0]
    other = Robot("IRB 2600-12/1.65")
    at_zero = np.eye(4)
    at_zero[:3, 3] = other.link_frames(np.zeros(6))[1, :3, 3]
    moved = other.link_frames(q)[1] @ np.linalg.inv(other.link_frames(np.zeros(6))[1]) @ at_zero
    alone = robot.with_body(Body(body.links[body.links == 2], body.capsules[body.links == 2], []))
    for corner in ([0.05, 0.1, 0.8], [-0.05, -0.1, -0.1], [0.05, -0.1, 0.35]):
        ball = irbkin.Cell({"ball": Shape.sphere(1e-6, (moved @ [*corner, 1])[:3])})
        assert ball.collides(alone, q)
    far = irbkin.Cell({"ball": Shape.sphere(1e-6, (moved @ [0.3, 0, 0.35, 1])[:3])})
    assert not far.collides(alone, q)


def test_with_a_mesh_there_is_no_body():
    shapes = {"link_2": collision('<box size="0.1 0.2 0.9"/>')}
    assert Robot.from_urdf(arm(shapes)).body is not None
    mesh = collision('<mesh filename="package://a/b.stl"/>')
    robot = Robot.from_urdf(arm({**shapes, "link_3": mesh}))
    assert robot.body is None
    with pytest.raises(irbkin.InvalidModelError, match=r'"link_3" has a mesh .*Body\.fit'):
        irbkin.Cell().collides(robot, np.zeros(6))
    assert Robot.from_urdf(arm({"link_2": "<visual/>"})).body is None


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        ('<box size="0 1 1"/>', 'link "link_2" collision box: size is 0 m'),
        ('<box size="1 1"/>', 'box size is "1 1", it must be 3 finite numbers'),
        ('<sphere radius="nan"/>', 'sphere radius is "nan"'),
        ("<sphere/>", "sphere has no radius"),
        ('<cylinder radius="-1" length="1"/>', "radius is -1 m"),
        ("", "has no geometry"),
    ],
)
def test_bad_shapes_are_named_where_a_body_is_wanted(shape, words):
    robot = Robot.from_urdf(arm({"link_2": collision(shape)}))
    assert robot.body is None
    assert len(robot.ik(robot.fk([0.1] * 6))) > 0
    for question in (irbkin.Cell().collides, irbkin.Cell().check_path, irbkin.Cell().distance):
        with pytest.raises(irbkin.InvalidModelError, match=re.escape(words)):
            question(robot, np.full((2, 6), 0.1))


def test_a_robot_without_a_body_has_no_shapes_to_write():
    with pytest.raises(irbkin.InvalidModelError, match="no body"):
        Robot("UR5e").with_body(None).to_urdf(visual=True)


def test_rotations_of_shapes_are_read():
    def rod(rotation):
        shape = '<capsule radius="0.05" length="0.3"/>'
        text = arm({"link_2": collision(shape, f'<origin xyz="0 0 0.1" {rotation}/>')})
        return Robot.from_urdf(text.replace("<robot", '<robot version="1.1"')).body.capsules

    at_rest = rod("")
    half = np.sqrt(0.5)
    about_x = rod('rpy="1.5707963267948966 0 0"')
    np.testing.assert_allclose(rod(f'quat_xyzw="{half} 0 0 {half}"'), about_x, atol=1e-12)
    assert np.abs(about_x - at_rest).max() > 0.1
    text = arm({"link_2": collision("<box/>", '<origin quat_xyzw="0 0 0 0.1"/>')})
    with pytest.raises(irbkin.InvalidModelError, match="link_2"):
        irbkin.Cell().collides(Robot.from_urdf(text), np.zeros(6))


def joint(name, kind, parent, child, at, axis, limits=None, mimic=""):
    """A joint, its origin a pose."""
    xyz, zyx = irbkin.to_xyz_euler_zyx(at)
    limit = "" if limits is None else '<limit lower="{}" upper="{}"/>'.format(*limits)
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz[0]} {xyz[1]} {xyz[2]}" rpy="{zyx[2]} {zyx[1]} {zyx[0]}"/>'
        f'<axis xyz="{axis[0]} {axis[1]} {axis[2]}"/>{limit}{mimic}</joint>'
    )


def moved_by(kind, axis, value):
    """The pose of a joint at a value."""
    axis = np.asarray(axis) / np.linalg.norm(axis)
    if kind == "prismatic":
        return irbkin.pose(axis * value)
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_rotvec(axis * value).as_matrix()
    return pose


def random_finger(rng, carrier, number):
    """Up to three joints and links with shapes, as text, and where points of them are.

    The function takes a part of the way of each joint, 0 to 1.
    """
    text, joints, solids, parent = "", [], [], carrier
    for level in range(rng.integers(1, 4)):
        name, kind = f"f{number}{level}", rng.choice(["prismatic", "revolute", "continuous"])
        at = irbkin.pose(rng.uniform(-0.1, 0.1, 3), euler_zyx=rng.uniform(-3, 3, 3))
        axis = rng.normal(size=3)
        low = rng.uniform(-0.1, 0) if kind == "prismatic" else rng.uniform(-1.5, 0.3)
        high = low + rng.uniform(0, 0.2 if kind == "prismatic" else 2.5)
        limits, mimic = ((low, high), "") if kind != "continuous" else (None, "")
        if level and kind == joints[-1][1] and kind != "continuous" and rng.uniform() < 0.5:
            # It goes farther than its own limits.
            factor, offset = rng.uniform(-2, 2, 2)
            mimic = f'<mimic joint="{joints[-1][4]}" multiplier="{factor}" offset="{offset}"/>'
            ends = factor * np.array(joints[-1][3]) + offset
            low, high = min(low, *ends), max(high, *ends)
        way = (-np.pi, np.pi) if kind == "continuous" else (low, high)
        size, place = rng.uniform(0.01, 0.15, 3), rng.uniform(-0.1, 0.1, 3)
        shape, points = random_shape(rng, size)
        origin = '<origin xyz="{} {} {}"/>'.format(*place)
        text += f'<link name="{name}">{collision(shape, origin)}</link>'
        text += joint(name, kind, parent, name, at, axis, limits, mimic)
        joints.append((at, kind, axis, way, name))
        solids.append(points + place)
        parent = name

    def places(parts):
        pose, found = np.eye(4), []
        for (at, kind, axis, (low, high), _), points, part in zip(
            joints, solids, parts, strict=False
        ):
            pose = pose @ at @ moved_by(kind, axis, low + part * (high - low))
            found.append(points @ pose[:3, :3].T + pose[:3, 3])
        return np.concatenate(found)

    return text, places


def random_shape(rng, size):
    """A shape and points at its surface."""
    ways = rng.normal(size=(60, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    kind, (radius, _, length) = rng.integers(4), size
    if kind == 0:
        box = ways / np.abs(ways).max(axis=1)[:, None]
        return '<box size="{} {} {}"/>'.format(*size), box * size / 2
    if kind == 1:
        return f'<sphere radius="{radius}"/>', radius * ways
    along = rng.uniform(-length / 2, length / 2, 60)
    if kind == 2:
        angle = rng.uniform(0, 2 * np.pi, 60)
        round_ = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), along])
        return f'<cylinder radius="{radius}" length="{length}"/>', round_
    ends = np.array([0, 0, length / 2]) * rng.choice([-1, 1], 60)[:, None]
    return f'<capsule radius="{radius}" length="{length}"/>', radius * ways + ends


def outside(points, body, frames):
    """How far the farthest point is outside of the capsules."""
    nearest = np.full(len(points), np.inf)
    for link, row in zip(body.links, body.capsules, strict=True):
        ends = row[:6].reshape(2, 3) @ frames[link][:3, :3].T + frames[link][:3, 3]
        way = ends[1] - ends[0]
        part = np.clip((points - ends[0]) @ way / max(way @ way, 1e-30), 0, 1)
        off = np.linalg.norm(points - ends[0] - part[:, None] * way, axis=1)
        nearest = np.minimum(nearest, off - row[6])
    return nearest.max()


def test_links_behind_a_joint_beside_the_arm_are_in_the_body_wherever_it_is():
    rng = np.random.default_rng(5)
    bare = Robot("IRB 2600-12/1.65")
    at_zero, largest = frames(bare, np.zeros(6)), 0
    for _ in range(20):
        # At the tip, and on the lower arm, whose frames the text has parallel to the base.
        tip, lower = random_finger(rng, "tool0", 0), random_finger(rng, "link_2", 1)
        text = bare.to_urdf().replace("</robot>", tip[0] + lower[0] + "</robot>")
        body = Robot.from_urdf(text, tip="tool0").body
        assert '"f00"' in body.source
        assert '"f10"' in body.source
        largest = max(largest, len(body.capsules))
        upper_arm = irbkin.pose(at_zero[2][:3, 3])
        for parts in [*rng.uniform(size=(60, 3)), *np.ndindex(2, 2, 2)]:
            for pose, places in ((at_zero[7], tip[1]), (upper_arm, lower[1])):
                points = places(parts) @ pose[:3, :3].T + pose[:3, 3]
                assert outside(points, body, at_zero) < 1e-12
    assert largest < 1000


FINGER = collision('<box size="0.02 0.02 0.1"/>', '<origin xyz="0 0 0.05"/>')


@pytest.mark.parametrize(
    ("first", "second", "widest"),
    [
        # 0.03 .. 0.04 of a joint that goes to 0.02 itself, and is taken to 0.04.
        ('multiplier="2"', 'multiplier="1" offset="0.01"', 0.05),
        # The first joint turns without an end, and neither moves the second one.
        ('multiplier="0" offset="0.03"', 'multiplier="1"', 0.03),
    ],
)
def test_a_joint_that_follows_a_follower_goes_where_the_first_takes_it(first, second, widest):
    kind = "continuous" if "0.03" in first else "prismatic"
    slides = [("a", "", (0, 0.02)), ("b", "a", (0, 0.01)), ("c", "b", (0, 0.01))]
    text = ""
    for (name, of, limits), how in zip(slides, ["", first, second], strict=True):
        mimic = f'<mimic joint="{of}" {how}/>' if of else ""
        own = (kind, None) if kind == "continuous" and not of else ("prismatic", limits)
        shape = collision('<sphere radius="0.01"/>') if name == "c" else ""
        text += f'<link name="{name}">{shape}</link>'
        text += joint(name, own[0], "tool0", name, np.eye(4), (0, 1, 0), own[1], mimic)
    text = Robot("IRB 2600-12/1.65").to_urdf().replace("</robot>", text + "</robot>")
    body = Robot.from_urdf(text, tip="tool0").body
    reached = (body.capsules[:, [1, 4]] + body.capsules[:, 6:]).max()
    assert widest + 0.01 <= reached < widest + 0.016
    # In a circle, no joint has an end.
    circle = text.replace('<mimic joint="a"', '<mimic joint="c"')
    with pytest.raises(irbkin.InvalidModelError, match='joint "c", which is a mimic behind'):
        irbkin.Cell().collides(Robot.from_urdf(circle, tip="tool0"), np.zeros(6))


def with_finger(kind, limits=(0, 0.04), parent="tool0"):
    shapes = {"link_5": collision('<sphere radius="0.05"/>')}
    hand = joint("slide", kind, parent, "finger", irbkin.pose([0, 0, 0.06]), (0, 1, 0), limits)
    return arm(shapes).replace("</robot>", f'<link name="finger">{FINGER}</link>{hand}</robot>')


@pytest.mark.parametrize("kind", ["fixed", "prismatic", "revolute", "continuous"])
def test_a_ball_at_a_finger_touches_it(kind):
    robot = Robot.from_urdf(with_finger(kind), tip="tool0")
    ball = Shape.sphere(0.005, robot.fk(np.zeros(6))[:3] @ [0, 0, 0.12, 1])
    assert irbkin.Cell({"ball": ball}).collides(robot, np.zeros(6))


def test_go_keeps_a_finger_out_of_a_wall():
    robot = Robot.from_urdf(with_finger("prismatic"), tip="tool0")
    start, goal = np.array([[0.6, 0, 0, 0, 0.5, 0], [-0.6, 0, 0, 0, 0.5, 0]])
    # The wall is beyond the flange, and the finger reaches into it.
    tip = robot.fk([0, 0, 0, 0, 0.5, 0])[:3] @ [0, 0, 0.1, 1]
    middle = tip + np.array([0.15, 0, 0])
    wall = Shape.box([0.3, 0.1, 2], irbkin.pose(middle))
    cell = irbkin.Cell({"wall": wall})
    motion = robot.go(start, goal, cell)
    for q in motion.sample(np.linspace(0, motion.duration, 400)).q:
        flange = robot.fk(q)
        for slide in (0, 0.02, 0.04):
            corners = np.array(list(np.ndindex(2, 2, 11))) * [0.02, 0.02, 0.01] - [0.01, 0.01, 0]
            points = corners + np.array([0, slide, 0.06])
            points = points @ flange[:3, :3].T + flange[:3, 3]
            assert (np.abs(points - middle) > [0.15, 0.05, 1]).any(axis=1).all()


@pytest.mark.parametrize(
    ("kind", "limits", "words"),
    [
        ("planar", None, 'link "finger" hangs beside the arm on joint "slide", which is planar'),
        ("floating", None, "which is floating"),
        ("prismatic", None, "which is prismatic, with limits inf m apart"),
        ("prismatic", (-1e10, 1e10), "with limits inf m apart"),
        ("prismatic", (0, "x"), 'joint "slide" limit upper is "x"'),
    ],
)
def test_a_joint_without_an_end_is_named_where_a_body_is_wanted(kind, limits, words):
    robot = Robot.from_urdf(with_finger(kind, limits), tip="tool0")
    assert robot.body is None
    with pytest.raises(irbkin.InvalidModelError, match=words):
        robot.go(np.zeros(6), np.full(6, 0.1), irbkin.Cell())
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.Cell().collides(robot, np.zeros(6))


def test_another_arm_on_the_base_is_left_out_and_named():
    for kind in ("revolute", "floating"):
        body = Robot.from_urdf(with_finger(kind, parent="base_link"), tip="tool0").body
        assert body.source == 'collision shapes of a URDF; left out: "finger"'
        assert set(body.links) == {5}
    assert 'left out: "finger"' in repr(body)
