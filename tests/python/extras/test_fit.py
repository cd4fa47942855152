"""Capsules fitted to meshes: they contain every triangle, and the pairs that are kept apart."""

import math

import irbkin
import numpy as np
import pytest
import trimesh
from irbkin import Robot
from irbkin._fit import capsules, solid
from irbkin._fit.urdf import ball
from irbkin.body import Body

ARM = Robot("IRB 1200-5/0.9")


def elbow():
    """Triangles of a bent, hollow shape: two boxes and a cone."""
    parts = [
        trimesh.creation.box([0.3, 0.1, 0.12]),
        trimesh.creation.box([0.1, 0.1, 0.4]).apply_translation([0.12, 0, 0.2]),
        trimesh.creation.cone(0.08, 0.2).apply_translation([-0.1, 0, 0.06]),
    ]
    return np.concatenate([part.triangles for part in parts])


def outside(points, rows):
    """How far points are outside capsules, at most."""
    return np.min([capsules.distances(points, row) - row[6] for row in rows], axis=0).max()


@pytest.fixture(scope="module")
def urdf(tmp_path_factory):
    """An arm whose links are rods, and a mesh in millimeters of a package."""
    folder = tmp_path_factory.mktemp("arm") / "rods" / "urdf"
    folder.mkdir(parents=True)
    (folder.parent / "meshes").mkdir()
    text, links = ARM.to_urdf(), {"link_2": [0.05, 0.05, 0.448], "link_4": [0.3, 0.04, 0.04]}
    for name, size in links.items():
        mesh = trimesh.creation.box(np.array(size) * 1000)
        place = "0 0 0.224" if name == "link_2" else "0.15 0 0"
        mesh.export(folder.parent / "meshes" / f"{name}.stl")
        path = f"package://rods/meshes/{name}.stl"
        text = text.replace(
            f'<link name="{name}"/>',
            f'<link name="{name}"><collision><origin xyz="{place}"/><geometry><mesh '
            f'filename="{path}" scale="0.001 0.001 0.001"/></geometry></collision></link>',
        )
    base = '<visual><geometry><cylinder radius="0.1" length="0.3"/></geometry></visual>'
    text = text.replace('<link name="base_link"/>', f'<link name="base_link">{base}</link>')
    path = folder / "arm.urdf"
    path.write_text(text)
    return path


@pytest.mark.parametrize("count", [1, 3])
def test_no_point_of_a_triangle_is_outside(count):
    triangles = elbow()
    rows, excess = capsules.fitted(solid.Solid(triangles), None, count)
    assert len(rows) <= count
    assert 0 < excess < 0.25
    assert outside(triangles.reshape(-1, 3), rows) <= 0
    # Every piece of a triangle is inside one capsule, so all of it is.
    pieces = solid.halved(triangles, 0.01)
    assert pieces.shape[0] > 5000
    corners = np.linalg.norm(pieces - np.roll(pieces, 1, axis=1), axis=2)
    assert corners.max() <= 0.01
    areas = solid.doubled_areas(pieces), solid.doubled_areas(triangles)
    np.testing.assert_allclose(areas[0].sum(), areas[1].sum(), rtol=1e-9)
    assert outside(solid.spread_over(triangles, 20_000), rows) <= 0


def test_more_capsules_are_nearer_and_an_excess_takes_the_fewest():
    whole = solid.Solid(elbow())
    least = [capsules.fitted(whole, None, count)[1] for count in (1, 2, 3)]
    assert least[0] > least[1] > least[2]
    rows, excess = capsules.fitted(whole, least[1], 4)
    assert len(rows) == 2
    assert excess <= least[1]


def test_the_inside_of_a_closed_mesh_is_covered():
    box = trimesh.creation.box([0.4, 0.4, 0.4]).triangles
    rows, _ = capsules.fitted(solid.Solid(box), None, 3)
    grid = np.stack(np.meshgrid(*[np.linspace(-0.19, 0.19, 12)] * 3), axis=-1).reshape(-1, 3)
    assert outside(grid, rows) <= 0.01
    opened = solid.Solid(box[:-2])
    assert len(opened.points) < len(solid.Solid(box).points)


def test_the_hull_of_the_ball_contains_it():
    points = ball()
    ways = np.random.default_rng(2).normal(size=(4000, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    assert (points @ ways.T).max(axis=0).min() >= 1
    assert np.linalg.norm(points, axis=1).max() < 1.02


def test_a_body_is_fitted_to_a_urdf(urdf):
    calls = []
    body = Body.fit(urdf, most=2, progress=lambda *both: calls.append(both))
    assert body == Body.fit(urdf, most=2)
    count = len(set(body.links))
    assert calls == [(done, count) for done in range(1, count + 1)]
    assert set(body.links) == {0, 2, 4}
    assert body.source.startswith("capsules fitted to the meshes of IRB 1200")
    assert not body.is_approximate
    assert body.excess[[0, 2, 4]].min() > 0
    assert body.excess[[1, 3]].tolist() == [0, 0]
    assert set(body.pairs) <= {(0, 2), (0, 4), (2, 4)}
    assert (0, 4) in body.pairs
    # Where the mesh is at a posture, the capsules are: a corner of the rod of link 2.
    q = np.array([0.4, 0.3, -0.2, 0.1, 0.2, 0.3])
    upper, lower = ARM.link_frames(q)[[2, 1], :3, 3]
    robot = ARM.with_body(body)
    for part in (0, 0.3, 1):
        at = lower + part * (upper - lower)
        ball = irbkin.Cell({"ball": irbkin.body.Shape.sphere(1e-6, at)})
        assert ball.collides(robot.with_body(body), q)


def test_a_fitted_body_misses_nothing_of_its_meshes(urdf):
    body = Body.fit(urdf, excess=0.03)
    assert (body.excess <= 0.03).sum() >= 4
    rng = np.random.default_rng(4)
    robot, box = ARM.with_body(body), trimesh.creation.box([0.3, 0.04, 0.04])
    points = box.sample(200, seed=1) + np.array([0.15, 0, 0])
    zero = ARM.link_frames(np.zeros(6))[3]
    # Of the URDF, links are parallel to the base at zero.
    local = (points @ zero[:3, :3]).T
    for q in rng.uniform(*ARM.limits.T, (20, 6)):
        frame = ARM.link_frames(q)[3]
        for at in (frame[:3, :3] @ local + frame[:3, 3:]).T[:5]:
            ball = irbkin.Cell({"ball": irbkin.body.Shape.sphere(1e-6, at)})
            assert ball.collides(robot, q)


FINGER = """<link name="finger"><visual><origin xyz="0 0 0.05"/><geometry><box size="{}"/>
</geometry></visual></link><joint name="slide" type="{}"><parent link="{}"/><child link="finger"/>
<origin xyz="0 0.01 0.02"/><axis xyz="0 1 0"/><limit lower="0" upper="0.05"/></joint></robot>"""


@pytest.mark.parametrize("kind", ["prismatic", "revolute"])
def test_a_finger_is_in_a_fitted_body_wherever_its_joint_is(urdf, kind):
    finger = FINGER.format("0.02 0.03 0.1", kind, "tool0")
    # A prefix that is not declared, and an & alone: what reads the shapes takes them, too.
    text = urdf.read_text().replace("</robot>", "<drake:of a='1' b=' & '/>" + finger)
    path = urdf.with_name(f"{kind}.urdf")
    path.write_text(text)
    body = Body.fit(path, tip="tool0", most=1)
    assert 'wherever their joints are: "finger"' in body.source
    assert body.excess[7] > 0.005
    assert {(0, 7), (2, 7)} <= set(body.pairs)
    rows = body.capsules[body.links == 7]
    corners = np.array([*np.ndindex(2, 2, 2)]) * [0.02, 0.03, 0.1] - [0.01, 0.015, 0]
    for value in np.linspace(0, 0.05, 21):
        pose = irbkin.pose([0, value, 0]) if kind == "prismatic" else np.eye(4)
        if kind == "revolute":
            c, s = np.cos(value), np.sin(value)
            pose[:3, :3] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
        points = corners @ pose[:3, :3].T + pose[:3, 3] + [0, 0.01, 0.02]
        assert outside(points, rows) <= 1e-9


def test_a_fitted_body_is_of_what_a_rail_carries(urdf):
    rail = FINGER.format("9 9 9", "prismatic", "floor").replace("finger", "base_link")
    beam = '<link name="floor"><visual><geometry><box size="9 9 9"/></geometry></visual></link>'
    rail = beam + rail[rail.index("<joint") :]
    path = urdf.with_name("railed.urdf")
    path.write_text(urdf.read_text().replace("</robot>", rail))
    body, bare = (Body.fit(it, tip="tool0", most=1) for it in (path, urdf))
    np.testing.assert_allclose(body.capsules, bare.capsules, rtol=0, atol=1e-12)
    assert 'left out: "floor"' in body.source
    with pytest.raises(irbkin.InvalidModelError, match="rail or lift of the arm moves: leave"):
        Body.fit(path, tip="tool0", most=1, joints={"slide": 0.02})


def test_a_body_is_fitted_at_an_opening_of_a_gripper(urdf):
    finger = FINGER.format("0.02 0.03 0.1", "prismatic", "tool0")
    other = finger.replace("slide", "second").replace('"finger"', '"other"')
    other = other.replace("<limit", '<mimic joint="slide" multiplier="-1"/><limit')
    text = urdf.read_text().replace("</robot>", finger).replace("</robot>", other)
    path = urdf.with_name("gripper.urdf")
    path.write_text(text)
    fit = lambda **joints: Body.fit(path, tip="tool0", most=2, joints=joints)  # noqa: E731
    body = fit(slide=0.04)
    assert body.source.endswith("; slide at 0.04")
    rows = body.capsules[body.links == 7]
    corners = np.array([*np.ndindex(2, 2, 2)]) * [0.02, 0.03, 0.1] - [0.01, 0.015, 0]
    for value in (0.04, -0.04):
        assert outside(np.add(corners, [0, 0.01 + value, 0.02]), rows) <= 1e-9
    # Between them there is room.
    assert outside(np.array([[0, 0.01, 0.07]]), rows) > 0.005
    same = text.replace('"prismatic"', '"fixed"').replace('xyz="0 0.01 0.02"', 'xyz="{}"')
    same = same.replace("{}", "0 0.05 0.02", 1).replace("{}", "0 -0.03 0.02")
    same = Body.fit(same, tip="tool0", most=2, packages={"rods": path.parents[1]})
    np.testing.assert_allclose(rows, same.capsules[same.links == 7], atol=1e-9)
    for joints, words in [
        ({"slid": 0.02}, "there is no joint slid that moves; did you mean slide"),
        ({"slide": 0.06}, r"the joint slide \(0 to 0.05 m\) cannot be at 0.06"),
        ({"slide": np.nan}, "cannot be at nan"),
        ({"second": 0.0}, "the joint second follows slide: give where that is"),
        ({"joint_2": 0.1}, "the joint joint_2 is of the arm, and moves"),
    ]:
        with pytest.raises(irbkin.InvalidModelError, match=words):
            fit(**joints)


def test_what_a_fitted_body_cannot_contain_is_named(urdf):
    fit = lambda *finger: Body.fit(  # noqa: E731
        urdf.read_text().replace("</robot>", FINGER.format("0.02 0.02 0.1", *finger)),
        tip="tool0",
        most=1,
        packages={"rods": urdf.parent.parent},
    )
    with pytest.raises(irbkin.InvalidModelError, match=r'"finger" .* "slide", which is planar'):
        fit("planar", "tool0")
    assert fit("revolute", "base_link").source.endswith('; left out: "finger"')


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"excess": 0.0}, irbkin.InvalidModelError, "excess is 0.0 m"),
        ({"excess": np.nan}, irbkin.InvalidModelError, "excess is nan m"),
        ({"most": 0}, irbkin.InvalidModelError, "most is 0, it must be 1 to 12"),
        ({"packages": {"rods": "/nowhere"}}, FileNotFoundError, "link_2"),
        ({"base": "nothing"}, irbkin.InvalidModelError, "nothing"),
    ],
)
def test_what_cannot_be_fitted_is_named(urdf, change, error, words):
    with pytest.raises(error, match=words):
        Body.fit(urdf, **change)


def test_a_shape_is_turned_by_a_quaternion_as_by_angles(urdf):
    whole = urdf.read_text()
    place = '<origin xyz="0.15 0 0"'
    assert whole.count(place) == 1
    bodies = [
        Body.fit(
            whole.replace(place, f"{place} {turn}"), most=1, packages={"rods": urdf.parents[1]}
        )
        for turn in ('rpy="0 0 1.2"', f'quat_xyzw="0 0 {math.sin(0.6)} {math.cos(0.6)}"')
    ]
    np.testing.assert_allclose(bodies[0].capsules, bodies[1].capsules, atol=1e-6)
    with pytest.raises(irbkin.InvalidModelError, match="has rpy and quat_xyzw"):
        Body.fit(
            whole.replace(place, f'{place} rpy="0 0 0" quat_xyzw="0 0 0 1"'),
            packages={"rods": urdf.parents[1]},
        )


def test_shapes_of_links_are_named():
    def with_shape(shape):
        text = f'<link name="link_2"><collision><geometry>{shape}</geometry></collision></link>'
        return ARM.to_urdf().replace('<link name="link_2"/>', text)

    with pytest.raises(irbkin.InvalidModelError, match="neither collision nor visual"):
        Body.fit(ARM.to_urdf())
    for shape, words in [
        ("<plane/>", "shape <plane>"),
        ('<box size="1 1"/>', r'link "link_2": size of box is .1 1., it must be 3 numbers'),
        ('<box size="1 1 0"/>', 'link "link_2".* size'),
        ('<mesh filename="a.stl" scale="1 1"/>', r'"link_2": scale of mesh is .1 1., .* 3 numbers'),
        ("", "without geometry|has no geometry"),
    ]:
        with pytest.raises(irbkin.InvalidModelError, match=words):
            Body.fit(with_shape(shape))


def test_a_mesh_of_a_tool_is_covered(tmp_path):
    path = tmp_path / "torch.stl"
    torch = trimesh.creation.cone(30, 200)
    torch.export(path)
    shapes = irbkin.body.cover(path, scale=0.001, most=2)
    robot = ARM.with_attached(shapes)
    carried = robot.body.capsules[robot.body.links == 7]
    assert 1 <= len(carried) <= 2
    # The file has single precision.
    assert outside(np.array(torch.vertices) / 1000, carried) <= 1e-7
    assert irbkin.body.cover(path, scale=0.001, most=2) == shapes


@pytest.mark.parametrize(
    ("mesh", "change", "words"),
    [
        (np.zeros((2, 3)), {}, r"shape \(2, 3\)"),
        (np.zeros((2, 3, 3)), {}, "no area"),
        (np.full((1, 3, 3), np.nan), {}, "not finite"),
        (np.eye(3)[None], {"scale": 0}, "scale is 0"),
        (np.eye(3)[None], {"most": 13}, "most is 13"),
    ],
)
def test_meshes_that_are_none_are_named(mesh, change, words):
    with pytest.raises(irbkin.InvalidModelError, match=words):
        irbkin.body.cover(mesh, **change)


def test_a_flat_mesh_is_covered():
    shapes = irbkin.body.cover(np.eye(3)[None], most=3)
    assert 1 <= len(shapes) <= 3
