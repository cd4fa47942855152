"""Convex hulls, meshes and point clouds from Python, and against coal."""

import pickle
import sys

import coal
import irbkin
import numpy as np
import pytest
import trimesh
from irbkin.body import Body, Shape

# An arm whose only capsule is of link 1, so that it is where link 1 is.
CAPSULE = [-0.1, 0.05, 0, 0.2, 0.1, 0.1, 0.03]
ROBOT = irbkin.Robot("UR5e").with_body(Body([6], [CAPSULE], []))
TORUS = trimesh.creation.torus(0.4, 0.15, major_sections=40, minor_sections=20)
PART = TORUS.vertices[TORUS.faces]
PLACE = irbkin.pose([0.3, -0.2, 0.4], euler_zyx=[0.3, 0.5, -0.7])


def postures(count, seed=1):
    return np.random.default_rng(seed).uniform(-3, 3, (count, 6))


def distances(shape, q):
    return irbkin.Cell({"shape": shape}).distance(ROBOT, q).distance


def coal_distances(geometry, q, place=PLACE):
    """The distance of the capsule by coal; 0 or less where they touch."""
    ends = np.array([CAPSULE[:3], CAPSULE[3:6]])
    length = np.linalg.norm(ends[1] - ends[0])
    z = (ends[1] - ends[0]) / length
    x = np.cross(z, [1, 0, 0])
    x /= np.linalg.norm(x)
    own = np.eye(4)
    own[:3] = np.column_stack([x, np.cross(z, x), z, ends.mean(axis=0)])
    capsule, there = coal.Capsule(CAPSULE[6], length), coal.Transform3s(place[:3, :3], place[:3, 3])
    found = []
    for frame in ROBOT.link_frames(q)[:, 5]:
        at = frame @ own
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        here = coal.Transform3s(at[:3, :3], at[:3, 3])
        found.append(coal.distance(capsule, here, geometry, there, request, result))
    return np.array(found)


def coal_mesh(triangles):
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(triangles), 3 * len(triangles))
    for a, b, c in triangles:
        model.addTriangle(a, b, c)
    model.endModel()
    return model


def check(shape, geometry, q):
    own, other = distances(shape, q), coal_distances(geometry, q)
    free = other > 1e-6
    assert 50 < free.sum() < len(q) - 50
    # coal stops within 1e-6 of the distance.
    np.testing.assert_allclose(own[free], other[free], atol=2e-6)
    assert (own[~free] <= 1e-6).all()
    touches = irbkin.Cell({"shape": shape}).collides(ROBOT, q)
    np.testing.assert_array_equal(touches, own <= 1e-9)


def near_postures(count):
    """Postures in which link 6 is near the place of the shapes."""
    q = postures(30 * count)
    apart = np.linalg.norm(ROBOT.link_frames(q)[:, 5, :3, 3] - PLACE[:3, 3], axis=1)
    return q[apart < 0.6][:count]


def test_a_mesh_is_as_near_as_coal_finds_it():
    check(Shape.mesh(PART, PLACE, solid=False), coal_mesh(PART), near_postures(600))


def test_a_hull_is_as_near_as_coal_finds_it():
    points = np.random.default_rng(2).normal(size=(60, 3)) * 0.12
    corners = coal.StdVec_Vec3s()
    for point in points:
        corners.append(point)
    hull = coal.Convex.convexHull(corners, True, "Qt")
    check(Shape.convex(points, PLACE), hull, near_postures(600))


def test_a_cloud_is_as_near_as_its_nearest_point():
    points = np.random.default_rng(3).normal(size=(500, 3)) * 0.2
    q = near_postures(300)
    ends = np.einsum(
        "nij,kj->nki", ROBOT.link_frames(q)[:, 5], [[*CAPSULE[k : k + 3], 1] for k in (0, 3)]
    )
    a, b = ends[:, :1, :3], ends[:, 1:, :3]
    there = points @ PLACE[:3, :3].T + PLACE[:3, 3]
    part = np.clip(((there - a) * (b - a)).sum(-1) / ((b - a) ** 2).sum(-1), 0, 1)
    apart = np.linalg.norm(a + part[..., None] * (b - a) - there, axis=-1).min(axis=1)
    np.testing.assert_allclose(
        distances(Shape.points(points, 0.02, PLACE), q), apart - 0.05, atol=1e-12
    )


def test_inside_of_a_solid_and_of_a_surface():
    cube = trimesh.creation.box([6, 6, 6]).triangles
    q = postures(50)
    assert irbkin.Cell({"cube": Shape.mesh(cube)}).collides(ROBOT, q).all()
    assert not irbkin.Cell({"cube": Shape.mesh(cube, solid=False)}).collides(ROBOT, q).any()
    with pytest.raises(irbkin.InvalidModelError, match=r"not closed: .* one triangle only"):
        Shape.mesh(cube[1:])
    Shape.mesh(cube[1:], solid=False)


@pytest.mark.parametrize("ending", ["stl", "obj", "ply", "dae"])
def test_files_are_read(tmp_path, ending):
    path = tmp_path / f"part.{ending}"
    TORUS.export(path)
    q = near_postures(100)
    np.testing.assert_allclose(
        distances(Shape.mesh(path, PLACE), q), distances(Shape.mesh(PART, PLACE), q), atol=1e-6
    )
    half = Shape.mesh(str(path), PLACE, scale=0.5)
    np.testing.assert_allclose(
        distances(half, q), distances(Shape.mesh(PART * 0.5, PLACE), q), atol=1e-6
    )
    np.testing.assert_allclose(
        distances(Shape.convex(path, PLACE), q),
        distances(Shape.convex(PART.reshape(-1, 3), PLACE), q),
        atol=1e-6,
    )


def test_files_that_are_no_meshes(tmp_path):
    path = tmp_path / "part.stl"
    path.write_text("nothing")
    with pytest.raises(irbkin.InvalidModelError, match=r"part\.stl"):
        Shape.mesh(path)
    with pytest.raises(FileNotFoundError, match=r"none\.stl"):
        Shape.mesh(tmp_path / "none.stl")
    TORUS.copy().apply_scale(1000).export(path)
    with pytest.raises(irbkin.InvalidModelError, match=r"millimeters\? scale=0.001"):
        Shape.mesh(path)
    Shape.mesh(path, scale=0.001)


def test_a_file_without_trimesh_names_the_extra(tmp_path, monkeypatch):
    TORUS.export(tmp_path / "part.stl")
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match=r"irbkin\[mesh\]"):
        Shape.mesh(tmp_path / "part.stl")
    assert Shape.mesh(PART) == Shape.mesh(PART)


def test_values_are_pickled_moved_and_united():
    points = PART.reshape(-1, 3)
    shapes = [
        Shape.mesh(PART, PLACE),
        Shape.mesh(PART, solid=False),
        Shape.convex(points),
        Shape.points(points[:50], 0.02),
        Shape.union([Shape.sphere(0.1, [0, 0, 0]), Shape.mesh(PART)]),
        Shape.half_space([0, 0.3, 1], [0, 0, 0.1]),
    ]
    q = postures(100)
    for shape in shapes:
        again = pickle.loads(pickle.dumps(shape))
        assert again == shape
        np.testing.assert_array_equal(distances(again, q), distances(shape, q))
        moved = irbkin.Cell({"shape": shape.moved(PLACE)}).distance(ROBOT.with_base(PLACE), q)
        np.testing.assert_allclose(moved.distance, distances(shape, q), atol=1e-9)
    assert repr(shapes[0]) == "<Shape.mesh: 1600 triangles at [0.3, -0.2, 0.4]>"
    assert repr(shapes[1]) == "<Shape.mesh: 1600 triangles, a surface at [0.0, 0.0, 0.0]>"
    assert repr(shapes[3]) == "<Shape.points: 50 points, 0.02 m, at [0.0, 0.0, 0.0]>"
    assert repr(shapes[4]) == "<Shape.union: 2 shapes>"
    both = distances(shapes[4], q)
    parts = [distances(Shape.sphere(0.1, [0, 0, 0]), q), distances(Shape.mesh(PART), q)]
    np.testing.assert_array_equal(both, np.minimum(*parts))


def test_pairs_that_may_touch_are_not_compared():
    arm = irbkin.Robot("IRB 2600-12/1.65")
    table = {"table": Shape.box([2, 2, 0.4], irbkin.pose([0, 0, 0.2]))}
    q = np.zeros(6)
    assert irbkin.Cell(table).collides(arm, q)
    cell = irbkin.Cell(table, may_touch=[("table", 1), ("table", 2)])
    assert not cell.collides(arm, q)
    assert cell.distance(arm, q).pair[0] != ("link 1", "table")
    assert cell.may_touch == [("table", 1), ("table", 2)]
    assert pickle.loads(pickle.dumps(cell)) == cell != irbkin.Cell(table)


def test_an_arm_that_stands_still_is_an_obstacle():
    arm = irbkin.Robot("IRB 2600-12/1.65")
    left = irbkin.Robot("UR5e").with_base(irbkin.pose([0.2, 1.1, 0], euler_zyx=[-np.pi / 2, 0, 0]))
    posture = np.array([0.1, -1.3, 1.2, 0.4, 0.5, 0])
    cell = irbkin.Cell(margin=0.02).with_robot("left", left, posture)
    assert list(cell.obstacles) == [f"left, link {link}" for link in range(7)]
    assert cell.margin == 0.02
    frames = np.concatenate([[left.base], left.link_frames(posture)])
    capsules = {}
    for link, row in zip(left.body.links, left.body.capsules, strict=True):
        a, b = (frames[link] @ [*row[at : at + 3], 1] for at in (0, 3))
        capsules[f"left, link {link}: {len(capsules)}"] = Shape.capsule(a[:3], b[:3], row[6])
    q = np.random.default_rng(6).uniform(*arm.limits.T, (500, 6))
    near, same = cell.distance(arm, q), irbkin.Cell(capsules).distance(arm, q)
    # How deep two are that touch is by all capsules of the one, or by one.
    is_apart = same.distance > 0
    np.testing.assert_array_equal(near.distance > 0, is_apart)
    np.testing.assert_allclose(near.distance[is_apart], same.distance[is_apart], atol=1e-12)
    found, wanted = (
        [near.pair[row][1] for row in np.flatnonzero(is_apart)] for near in (near, same)
    )
    assert found == [other.split(":")[0] for other in wanted]
    assert len({other for other in found if other.startswith("left")}) >= 3
    pairs = [(name, link) for name in cell.obstacles for link in range(1, 7)]
    apart = irbkin.Cell(cell.obstacles, 0.02, pairs)
    np.testing.assert_array_equal(apart.collides(arm, q), irbkin.Cell().collides(arm, q))


def test_motions_are_checked_between_meshes_too():
    arm = irbkin.Robot("IRB 2600-12/1.65")
    size = [0.3, 0.6, 0.8]
    place = irbkin.pose([0.9, 0.1, 0.5], euler_zyx=[0.3, 0, 0])
    part = trimesh.creation.box(size)
    box, *others = (
        irbkin.Cell({"part": shape}, 0.01)
        for shape in [
            Shape.box(size, place),
            Shape.mesh(part.triangles, place),
            Shape.convex(part.vertices, place),
        ]
    )
    ways = np.random.default_rng(8).uniform(-0.7, 0.7, (30, 2, 6)) * [2, 1, 1, 1, 1, 1]
    found = [box.check_path(arm, q) for q in ways]
    assert 5 < sum(contact is not None for contact in found) < 25
    for q, contact in zip(ways, found, strict=True):
        for other in others:
            same = other.check_path(arm, q)
            assert (same is None) == (contact is None)
            if contact is not None:
                np.testing.assert_allclose(same.at, contact.at, atol=1e-6)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: Shape.convex([[0, 0, 0]] * 3), "3 points, it must have 4"),
        (lambda: Shape.convex(PART[:, 0] * [1, 1, 0]), "in a plane"),
        (lambda: Shape.convex([1, 2, 3]), r"points must have shape \(n, 3\)"),
        (lambda: Shape.mesh(PART[:, :2]), r"triangles must have shape \(n, 3, 3\)"),
        (lambda: Shape.mesh(PART * 1e3), "millimeters"),
        (lambda: Shape.mesh(PART, scale=0), "scale is 0, it must be positive"),
        (lambda: Shape.mesh(PART * np.nan), "point 0 has the coordinate NaN"),
        (lambda: Shape.points([[0, 0, np.inf]], 0.1), "point 0 has the coordinate inf"),
        (lambda: Shape.points(np.zeros((0, 3)), 0.1), "points has 0 points"),
        (lambda: Shape.points([[0, 0, 0]], -1), "radius is -1 m"),
        (lambda: Shape.union([]), "no shape"),
        (lambda: irbkin.Cell(may_touch=[("tabel", 1)]), 'no obstacle has the name "tabel"'),
        (
            lambda: irbkin.Cell({"ball": Shape.sphere(1, [0, 0, 0])}, may_touch=[("ball", 9)]),
            "no link 9",
        ),
        (
            lambda: irbkin.Cell().with_robot("a", ROBOT.with_body(None), np.zeros(6)),
            "with_body",
        ),
        (
            lambda: irbkin.Cell({"a, link 6": Shape.sphere(1, [0, 0, 0])}).with_robot(
                "a", ROBOT, np.zeros(6)
            ),
            "name of another",
        ),
    ],
)
def test_shapes_and_cells_that_cannot_be_are_named(call, words):
    with pytest.raises(irbkin.InvalidModelError, match=words):
        call()


FAR = irbkin.pose([0, 100.1, 0])
SHAPES = [
    ("box size is 800 m", lambda: Shape.box([800, 1200, 50], irbkin.pose([1000, 0, 400]))),
    (r"box pose\[0\] is 1000 m", lambda: Shape.box([1, 1, 1], irbkin.pose([1000, 0, 400]))),
    ("sphere radius is 101 m", lambda: Shape.sphere(101, [0, 0, 0])),
    (r"sphere center\[2\] is -500 m", lambda: Shape.sphere(1, [0, 0, -500])),
    ("capsule radius is 150 m", lambda: Shape.capsule([0, 0, 0], [0, 0, 1], 150)),
    (r"capsule a\[1\] is 200 m", lambda: Shape.capsule([0, 200, 0], [0, 0, 0], 1)),
    (r"capsule b\[0\] is 900 m", lambda: Shape.capsule([0, 0, 0], [900, 0, 0], 1)),
    ("cylinder radius is 250 m", lambda: Shape.cylinder(250, 1)),
    ("cylinder length is 1000 m", lambda: Shape.cylinder(1, 1000)),
    (r"cylinder pose\[1\] is 100.1 m", lambda: Shape.cylinder(1, 1, FAR)),
    (r"half space point\[0\] is 1500 m", lambda: Shape.half_space([-1, 0, 0], [1500, 0, 0])),
    (r"convex hull pose\[1\]", lambda: Shape.convex(PART[:, 0], FAR)),
    (r"convex hull points\[2\] is", lambda: Shape.convex(PART[:, 0] + np.array([0, 0, 400]))),
    (r"mesh pose\[1\]", lambda: Shape.mesh(PART, FAR)),
    (r"mesh triangles\[0\] is", lambda: Shape.mesh(PART + np.array([700, 0, 0]))),
    (r"point cloud points\[0\]", lambda: Shape.points([[300, 0, 0]], 0.1)),
    ("point cloud radius is 300 m", lambda: Shape.points([[0, 0, 0]], 300)),
    (r"moved shape middle\[1\]", lambda: Shape.box([1, 1, 1]).moved(FAR)),
    (r"moved shape middle\[1\]", lambda: Shape.mesh(PART).moved(FAR).moved(FAR)),
    (r"half space point\[1\]", lambda: Shape.half_space([0, 1, 0], [0, 0, 0]).moved(FAR)),
    (
        r"moved shape middle\[1\]",
        lambda: Shape.union([Shape.sphere(1, [0, 0, 0]), Shape.box([1, 1, 1])]).moved(FAR),
    ),
    (r"capsule b\[2\] is 400 m", lambda: Body([1], [[0, 0, 0, 0, 0, 400, 80]], [])),
]


@pytest.mark.parametrize(("words", "make"), SHAPES, ids=[words for words, _ in SHAPES])
def test_a_shape_in_millimeters_is_asked_about(words, make):
    with pytest.raises(irbkin.InvalidModelError, match=words) as refused:
        make()
    assert "at most 100 m: is it in millimeters? Meters are wanted" in str(refused.value)


def test_a_large_cell_in_meters_is_taken():
    pose = irbkin.pose([100, -100, 100])
    shapes = [
        Shape.box([100, 100, 100], pose),
        Shape.cylinder(100, 100, pose),
        Shape.sphere(100, [100, 100, -100]),
        Shape.half_space([3e5, 0, 4e5], [100, 0, 0]),
        # Beside the origin of its frame, which is beyond the bound.
        Shape.sphere(1, [-90, 0, 0]).moved(irbkin.pose([150, 0, 0])),
    ]
    cell = irbkin.Cell({str(number): shape for number, shape in enumerate(shapes)})
    assert cell.collides(ROBOT, np.zeros(6))


def test_corners_of_a_file_within_a_micrometer_are_one(tmp_path):
    # In the thousandths of a millimeter that a file may have.
    rng, path = np.random.default_rng(5), tmp_path / "part.stl"
    for by in (1e-9, 1e-7, 4e-7):
        way = rng.normal(size=PART.shape)
        way *= by / np.linalg.norm(way, axis=2, keepdims=True)
        trimesh.Trimesh(**trimesh.triangles.to_kwargs(PART + way)).export(path)
        own = Shape.mesh(path, PLACE)
        assert own.data()["solid"]
        q = near_postures(200)
        off = distances(own, q) - distances(Shape.mesh(PART, PLACE), q)
        assert np.abs(off).max() < 3 * by + 2e-7
    with pytest.raises(irbkin.InvalidModelError, match=r"not closed: .* by more than a micrometer"):
        Shape.mesh(PART + rng.choice([-2e-6, 2e-6], PART.shape))
