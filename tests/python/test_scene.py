"""Scenes: plain data of everything that can be looked at, the same arm in every face."""

import json
from dataclasses import replace

import irbkin
import irbkin.map
import numpy as np
import pytest
from irbkin import rapid, scene, trajectory
from irbkin.body import Body, Shape
from irbkin.scene._arms import link_frames, outward, solids
from irbkin.scene._data import plain
from irbkin.scene._svg import UPWARD, pieces

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
RNG = np.random.default_rng(41)
MOVE = trajectory.joint(np.zeros(6), np.full(6, 0.4), steps=50)
MODULE = rapid.parse("""MODULE M
CONST robtarget a:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST robtarget far:=[[2900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC main() MoveJ a,v100,fine,tool0; MoveL far,v100,fine,tool0; ENDPROC
ENDMODULE""")
AXES = (np.linspace(-1, 1.6, 6), np.linspace(-1, 1, 5), np.linspace(0, 1.8, 4))
MAP = irbkin.map.reach(ROBOT, *AXES, irbkin.map.orientations(6))
SHAPES = {
    "box": Shape.box([1, 2, 3], irbkin.pose([1, 0, 0], wxyz=[0.6, 0.8, 0, 0])),
    "ball": Shape.sphere(0.2, [0, 1, 0]),
    "pin": Shape.capsule([0, 0, 0], [0, 0, 1], 0.1),
    "post": Shape.cylinder(0.1, 0.8, irbkin.pose([1, 1, 1], wxyz=[0.6, 0, 0.8, 0])),
    "floor": Shape.half_space([0, 0, 1], [0, 0, -0.1]),
    "hull": Shape.convex(np.eye(4, 3) + 0.1),
    "sheet": Shape.mesh(np.eye(3)[None], solid=False),
    "scan": Shape.points(np.eye(3), 0.01),
    "two": Shape.union([Shape.sphere(0.2, [0, 1, 0]), Shape.sphere(0.2, [0, 2, 0])]),
}


def every_scene():
    """A scene of everything that one can be made of."""
    return {
        "robot": scene.of(ROBOT),
        "postures": scene.of(ROBOT, q=np.zeros((3, 6))),
        "solutions": scene.of(ROBOT.ik(T), ROBOT),
        "trajectory": scene.of(MOVE, ROBOT),
        "follow": scene.of(ROBOT.follow(ROBOT.fk(MOVE.q), MOVE.q[0]), ROBOT),
        "plan": scene.of(ROBOT.plan(ROBOT.fk(MOVE.q)), ROBOT),
        "routine": scene.of(rapid.motion(ROBOT, MODULE), ROBOT),
        "cell": scene.of(irbkin.Cell(SHAPES), ROBOT),
        "map": scene.of(MAP),
        "several": scene.of([ROBOT, irbkin.Cell(SHAPES)]),
    }


@pytest.mark.parametrize("name", irbkin.catalog())
def test_a_face_draws_the_arm_where_the_robot_is(name):
    base = irbkin.pose([0.3, -0.2, 0.7], wxyz=[0.6, 0, 0.8, 0])
    tool = irbkin.pose([0.1, 0.2, 0.3], wxyz=[0, 1, 0, 0])
    robot = irbkin.Robot(name).with_base(base).with_tool(tool)
    arm = scene.arm_of(robot)
    bound = 1e-12 * max(1.0, np.abs(robot.fk(np.zeros(robot.dof))).max())
    for q in RNG.uniform(-3, 3, (3, robot.dof)):
        frames = link_frames(arm, q)
        np.testing.assert_allclose(frames[0], base, atol=bound)
        np.testing.assert_allclose(frames[1:], robot.link_frames(q), atol=bound)
    assert len(arm.body) == len(robot.body.capsules) > 0


@pytest.mark.parametrize("name", every_scene())
def test_a_scene_is_the_same_after_json(name, tmp_path):
    own = every_scene()[name]
    assert scene.Scene.from_json(own.to_json()) == own
    own.save(tmp_path / "own.json")
    assert scene.Scene.load(tmp_path / "own.json") == own
    assert json.loads(own.to_json())["format"] == "irbkin scene"


@pytest.mark.parametrize("name", SHAPES)
def test_a_shape_is_made_again_of_its_data(name):
    def made(data):
        kind = data.pop("kind")
        if kind == "union":
            data["shapes"] = [made(it) for it in data["shapes"]]
        return getattr(Shape, kind)(**data)

    data = json.loads(json.dumps(SHAPES[name].data()))
    again = made(data).data()
    for key, value in SHAPES[name].data().items():
        if key not in ("kind", "solid", "shapes"):
            np.testing.assert_allclose(again[key], value, atol=1e-15)
    assert again["kind"] == SHAPES[name].data()["kind"]


FACED = [name for name in irbkin.catalog() if irbkin.Robot(name).body.hulls]


@pytest.mark.parametrize("name", FACED)
def test_a_hull_that_is_drawn_contains_its_points_and_is_within_its_radius(name):
    body = irbkin.Robot(name).body
    arm = scene.arm_of(irbkin.Robot(name))
    assert len(arm.hulls) == len(body.hulls)
    directions = RNG.normal(size=(200, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for own, (link, points, faces, radius) in zip(arm.hulls, body.hulls, strict=True):
        assert (own.link, own.radius) == (link, radius)
        assert own.faces == tuple(map(tuple, faces))
        beyond = (outward(own) @ directions.T).max(axis=0) - (points @ directions.T).max(axis=0)
        # To 0.1 mm: half of it along each axis.
        assert -1e-4 < beyond.min() <= beyond.max() < radius + 1e-4
    assert len(json.dumps(plain(arm.hulls))) < 80_000


def test_links_with_hulls_are_drawn_as_them_and_the_others_as_capsules():
    arm = scene.arm_of(irbkin.Robot("UR5e"))
    assert solids(arm) == list(arm.hulls)
    upper = replace(arm, hulls=tuple(it for it in arm.hulls if it.link == 2))
    assert {type(it).__name__ for it in solids(upper) if it.link == 2} == {"LinkHull"}
    assert [it for it in solids(upper) if it.link != 2] == [it for it in arm.body if it.link != 2]
    held = irbkin.Robot("UR5e").with_attached(Shape.capsule([0, 0, 0], [0, 0, 0.2], 0.03))
    (pin,) = (it for it in solids(scene.arm_of(held)) if it.link == 7)
    assert (pin.a, pin.b, pin.radius) == ((0, 0, 0), (0, 0, 0.2), 0.03)
    bare = [(link, points, [], radius) for link, points, _, radius in ROBOT.body.hulls]
    body = Body(ROBOT.body.links, ROBOT.body.capsules, [], hulls=bare)
    arm = scene.arm_of(ROBOT.with_body(body))
    assert solids(arm) == list(arm.body)


@pytest.mark.parametrize("name", irbkin.catalog())
def test_every_arm_of_the_catalog_is_drawn(name):
    robot = irbkin.Robot(name)
    q = np.clip(0.3 * np.arange(1, robot.dof + 1), *robot.limits.T)
    drawn = pieces(scene.arm_of(robot), q)
    having = {hull[0] for hull in robot.body.hulls}
    others = [link for link in robot.body.links if link not in having]
    # A capsule in three tones, of a hull those of its faces that are seen.
    assert len(drawn) >= 3 * len(others) + 2 * len(robot.body.hulls)


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "IRB 140-6/0.81", "Panda"])
def test_a_picture_of_a_body_is_where_its_capsules_or_hulls_are(name):
    robot = irbkin.Robot(name)
    q = np.clip(np.zeros(robot.dof), *robot.limits.T)
    body, frames = robot.body, np.vstack([np.eye(4)[None], robot.link_frames(q)])

    def height(link, points):
        return max(points @ frames[link, :3, :3].T @ UPWARD + frames[link, :3, 3] @ UPWARD)

    polygons = [polygon for some, _ in pieces(scene.arm_of(robot), q) for polygon in some]
    top = np.vstack(polygons)[:, 1].max()
    if body.hulls:
        highest = max(height(link, points) for link, points, _, _ in body.hulls)
        # The points are to 0.1 mm, and moved out by the radius at most.
        assert -1e-4 <= top - highest <= max(hull[3] for hull in body.hulls) + 1e-4
    else:
        capsules = zip(body.links, body.capsules, strict=True)
        tops = [height(link, row[:6].reshape(2, 3)) + row[6] for link, row in capsules]
        # The outline has corners on the circle.
        assert -1e-12 <= max(tops) - top < 5e-3


def test_the_first_solution_is_drawn_and_the_others_are_ghosts():
    solutions = ROBOT.ik(T)
    (arm,) = every_scene()["solutions"].arms
    assert [it.is_ghost for it in arm.postures] == [False] + [True] * 7
    assert [it.label for it in arm.postures] == [f"slot {it.slot}" for it in solutions]
    np.testing.assert_allclose([it.q for it in arm.postures], solutions.q)
    (frame,) = every_scene()["solutions"].frames
    np.testing.assert_allclose(frame.pose, T, atol=1e-12)


def test_a_motion_has_its_times_lines_and_findings():
    own = every_scene()["routine"]
    made = rapid.motion(ROBOT, MODULE)
    motion = own.arms[0].motion
    assert motion.lines == tuple(made.lines)
    assert own.duration == motion.t[-1] == made.duration
    assert [it.severity for it in own.marks] == [it.severity for it in made.findings]
    assert own.marks[0].text.startswith("R103 MoveL far: ")
    long = scene.of(trajectory.joint(np.zeros(6), np.full(6, 0.4), steps=9000), ROBOT)
    assert len(long.arms[0].motion.t) == 2000
    assert long.duration == MOVE.duration
    assert len(long.paths[0].points) == 500


def test_the_way_of_a_program_is_of_its_tool():
    module = rapid.parse("""MODULE M
PERS tooldata tGun:=[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
CONST robtarget p:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC main() MoveJ p,v100,fine,tGun; MoveL Offs(p,0,200,0),v100,fine,tGun; ENDPROC
ENDMODULE""")
    made = rapid.motion(ROBOT, module)
    np.testing.assert_array_equal(made.moves[1].tool, irbkin.pose([0, 0, 0.2]))
    (way,) = scene.of(made, ROBOT).paths
    np.testing.assert_allclose([way.points[0], way.points[-1]], [[0.9, 0, 0.9], [0.9, 0.2, 0.9]])


def test_each_robot_of_several_things_stands_at_q():
    several = scene.of([ROBOT, irbkin.Cell(SHAPES), ROBOT.ik(T)], ROBOT, q=np.full(6, 0.3))
    firsts = [arm.postures[0].q for arm in several.arms]
    assert firsts == [(0.3,) * 6, (0.3,) * 6, tuple(ROBOT.ik(T)[0].q)]


def test_scenes_add_up():
    both = every_scene()["map"] + every_scene()["cell"]
    assert len(both.clouds) == len(both.arms) == 1
    assert len(both.obstacles) == len(SHAPES)
    assert both.title == ROBOT.name
    with pytest.raises(TypeError):
        both + 1


def test_what_is_no_scene_is_refused_with_its_place():
    data = every_scene()["robot"].to_dict()
    arm = data["arms"][0]
    hull = arm["hulls"][0]
    assert scene.Scene.from_dict({**data, "arms": [{**arm, "hulls": []}]}).arms[0].hulls == ()
    for change, words in (
        ({"version": 2}, "version is 2, this irbkin reads 1"),
        ({"format": "x"}, 'not a scene: it has no "format"'),
        ({"arms": 1}, "scene.arms is 1, it must be a list"),
        ({"robots": []}, "scene: has no field 'robots'"),
        ({"arms": [{**arm, "coupling": "a"}]}, r"arms\[0\].coupling is 'a', it must be a finite"),
        ({"arms": [{**arm, "name": 3}]}, r"scene.arms\[0\].name is 3, it must be a text"),
        ({"arms": [{}]}, r"scene.arms\[0\]: lacks the field 'name'"),
        (
            {"arms": [{**arm, "hulls": [{**hull, "faces": [[0, 1, 64]]}]}]},
            r"hulls\[0\].faces has \[0",
        ),
        (
            {"arms": [{**arm, "hulls": [{**hull, "points": []}]}]},
            r"arms\[0\].hulls\[0\].points must",
        ),
    ):
        with pytest.raises(ValueError, match=words):
            scene.Scene.from_dict({**data, **change})
    ball = {"kind": "sphere", "radius": 0.1, "center": [0, 0, 1]}
    union = {"kind": "union", "shapes": [ball]}
    for shape, words in (
        ({"kind": 5}, r"obstacles\[0\].shape: kind is 5, it must be one of sphere, capsule"),
        ({"kind": "moved"}, "kind is 'moved'"),
        ({"radius": 1}, "kind is None"),
        ({"kind": "sphere", "radius": 0.1}, r"obstacles\[0\].shape: .*center"),
        ({**ball, "radius": "a"}, r"obstacles\[0\].shape: "),
        ({**ball, "radius": -1.0}, "radius is -1 m"),
        ({"kind": "union"}, "shapes"),
        ({"kind": "union", "shapes": [3]}, r"obstacles\[0\].shape: "),
    ):
        with pytest.raises(ValueError, match=words):
            scene.Scene.from_dict({**data, "obstacles": [{"name": "a", "shape": shape}]})
    for shape in (ball, union):
        scene.Scene.from_dict({**data, "obstacles": [{"name": "a", "shape": shape}]})
    deep = '{"kind":"union","shapes":[' * 20_000
    for text in ("[" * 50_000, f'{{"obstacles":[{{"name":"a","shape":{deep}'):
        with pytest.raises(ValueError, match=r"nested too deeply|Expecting"):
            scene.Scene.from_json(text)
    with pytest.raises(TypeError, match="q is given, but a Solutions has its own joint angles"):
        scene.of(ROBOT.ik(T), ROBOT, q=np.zeros(6))
    with pytest.raises(TypeError, match="robot is missing: a Trajectory does not know its arm"):
        scene.of(MOVE)
    with pytest.raises(TypeError, match=r"thing must be a Robot, .* got int"):
        scene.of(1, ROBOT)
    with pytest.raises(irbkin.InvalidJointsError):
        scene.of(ROBOT, q=[1, 2])
