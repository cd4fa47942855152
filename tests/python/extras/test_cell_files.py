"""Cells from files: TOML, URDF with SRDF."""

import re
import textwrap
import time
from pathlib import Path

import irbkin
import numpy as np
import pytest
import trimesh
from irbkin.body import Shape

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
CUBE = [[x, y, z] for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
FACES = [[1, 4, 3, 2], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]]


def write_cube(path, half):
    """An OBJ file of a cube."""
    corners = (f"v {half * x} {half * y} {half * z}" for x, y, z in CUBE)
    faces = (f"f {a} {b} {c} {d}" for a, b, c, d in FACES)
    path.write_text("\n".join([*corners, *faces]))


# A triangle, the last corner of which is to be filled in.
PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 {}
"""

CELL = """
margin = 0.01
may_touch = [["table", 1], ["left, link 2", 6]]

[frames]
table = { xyz = [1.0, 0.2, 0.3], euler_zyx_deg = [90, 0, 0] }
fixture = { xyz = [0.1, 0, 0], wxyz = [1, 0, 0, 0], frame = "table" }

[obstacles.table]
box = [0.8, 1.2, 0.05]
pose = { frame = "table" }

[obstacles.ball]
sphere = 0.2
pose = { xyz = [0, 0.1, 0.2], frame = "fixture" }

[obstacles.rod]
capsule = { a = [0, 0, 0], b = [0, 0, 1.5], radius = 0.1 }
pose = { xyz = [-0.6, 0.6, 0] }

[obstacles.post]
cylinder = { radius = 0.1, length = 1.5 }
pose = { xyz = [-0.6, -0.6, 0.75], euler_zyx = [0, 0.1, 0] }

[obstacles.floor]
half_space = [0, 0, 1]
pose = { xyz = [0, 0, -0.5] }

[obstacles.cube]
mesh = "cube.obj"
scale = 0.001
pose = { xyz = [0, -1.5, 0.5] }

[obstacles.hull]
convex = [[0, 0, 0], [0.2, 0, 0], [0, 0.2, 0], [0, 0, 0.2]]
pose = { xyz = [0.3, 0.8, 0.9] }

[obstacles.scan]
points = "scan.npy"
radius = 0.01

[robots.left]
name = "IRB 120-3/0.58"
pose = { xyz = [0.0, 1.6, 0.0], euler_zyx_deg = [-90, 0, 0] }
q_deg = [0, 10, 20, 0, 30, 0]
"""


@pytest.fixture
def folder(tmp_path):
    write_cube(tmp_path / "cube.obj", 200)
    np.save(tmp_path / "scan.npy", np.linspace([0.5, -0.5, 0], [0.5, -0.5, 1], 101))
    return tmp_path


def load(folder, text, name="cell.toml"):
    (folder / name).write_text(textwrap.dedent(text))
    return irbkin.Cell.load(folder / name)


def test_a_file_is_the_cell_that_it_describes(folder):
    table = irbkin.pose([1.0, 0.2, 0.3], euler_zyx=[np.pi / 2, 0, 0])
    ball = table @ irbkin.pose([0.1, 0.1, 0.2])
    hull = [[0, 0, 0], [0.2, 0, 0], [0, 0.2, 0], [0, 0, 0.2]]
    left = irbkin.Robot("IRB 120-3/0.58").with_base(
        irbkin.pose([0, 1.6, 0], euler_zyx=[np.radians(-90), 0, 0])
    )
    cell = irbkin.Cell(
        {
            "table": Shape.box([0.8, 1.2, 0.05], table),
            "ball": Shape.sphere(0.2, ball[:3, 3]),
            "rod": Shape.capsule([-0.6, 0.6, 0], [-0.6, 0.6, 1.5], 0.1),
            "post": Shape.cylinder(
                0.1, 1.5, irbkin.pose([-0.6, -0.6, 0.75], euler_zyx=[0, 0.1, 0])
            ),
            "floor": Shape.half_space([0, 0, 1], [0, 0, -0.5]),
            "cube": Shape.box([0.4, 0.4, 0.4], irbkin.pose([0, -1.5, 0.5])),
            "hull": Shape.convex(hull, irbkin.pose([0.3, 0.8, 0.9])),
            "scan": Shape.points(np.linspace([0.5, -0.5, 0], [0.5, -0.5, 1], 101), 0.01),
        },
        0.01,
    ).with_robot("left", left, np.radians([0, 10, 20, 0, 30, 0]))
    loaded = load(folder, CELL)
    assert list(loaded.obstacles) == list(cell.obstacles)
    assert loaded.may_touch == [("table", 1), ("left, link 2", 6)]
    cell = irbkin.Cell(cell.obstacles, 0.01, loaded.may_touch)
    assert loaded.margin == 0.01
    low, high = ROBOT.limits.T
    q = np.random.default_rng(3).uniform(low, high, (2000, 6))
    one, other = loaded.distance(ROBOT, q), cell.distance(ROBOT, q)
    assert one.pair == other.pair
    np.testing.assert_allclose(one.distance, other.distance, atol=1.1e-7)
    near = {name for _, name in one.pair}
    assert near >= {"table", "rod", "cube", "hull", "scan"}
    assert any(name.startswith("left, link") for name in near)
    assert 100 < loaded.collides(ROBOT, q).sum() < 1990


def test_the_file_of_the_guide_is_read(folder):
    guide = Path(__file__).parents[3] / "docs" / "guide" / "cell.md"
    text = re.search(r"```toml\n(.*?)```", guide.read_text(), re.DOTALL)[1]
    trimesh.creation.box([100, 100, 100]).export(folder / "part.stl")
    cell = load(folder, text)
    assert list(cell.obstacles)[:2] == ["table", "part"]
    assert cell.may_touch == [("table", 1)]


def test_a_file_may_be_empty(folder):
    assert load(folder, "") == irbkin.Cell()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("margn = 1", r"cell\.toml: line 1, margn: unknown key; did you mean margin\?"),
        ("\n[obstacles.table]\nbox = [1, 1, 1]\npos = {}", "line 4, obstacles.table.pos: .* pose"),
        ("[obstacles]\ntable = { bx = [1, 1, 1] }", "line 2, obstacles.table.bx: unknown .* box"),
        ("[obstacles.a]\nbox = [1, 1]", r"line 2, obstacles.a.box: is \[1, 1\].* 3 numbers"),
        ("[obstacles.a]\nbox = [1, 1, 0]", "line 1, obstacles.a: size is 0 m"),
        ("[obstacles.a]\nbox = [1, 1, nan]", "obstacles.a: size is NaN m"),
        ("[obstacles.a]\nbox = [800, 1200, 50]", "a: box size is 800 m, .* 100 m: is it in milli"),
        (
            "[obstacles.a]\nsphere = 1\npose = { xyz = [850, 0, 0] }",
            "obstacles.a.*is 850 m, .*100 m",
        ),
        ("[obstacles.a]\nsphere = true", "is True, it must be a number"),
        ("[obstacles.a]\ncylinder = { radius = 1 }", "a.cylinder: length is missing"),
        ("[obstacles.a]\ncylinder = [1, 2]", "cylinder: is .* must be a table"),
        ("[obstacles.a]\ncapsule = { a = [0, 0, 0], r = 1 }", "line 2, .*capsule.r: .* radius"),
        ("[obstacles.a]\nbox = [1, 1, 1]\nsphere = 1", "has box and sphere, give one of"),
        ("[obstacles.a]\npose = {}", "has no shape, give one of box, sphere"),
        ("[obstacles.a]\nbox = [1, 1, 1]\nscale = 2", "line 3, obstacles.a.scale: unknown key"),
        ("[obstacles.a]\nmesh = 'b.stl'", r"a.mesh: there is no file .*b\.stl"),
        ("[obstacles.a]\nmesh = 'cube.obj'", "more than 100 m: are they in millimeters"),
        ("[obstacles.a]\nmesh = 'cube.obj'\nscale = -1", "scale is -1, it must be positive"),
        ("[obstacles.a]\nmesh = 'cube.obj'\nsolid = 1", "must be true or false"),
        ("[obstacles.a]\nconvex = [[0, 0], [1]]", "rows of numbers, or the name of a file"),
        ("[obstacles.a]\npoints = [[0, 0, 0]]", "radius is missing"),
        ("[frames]\na = { frame = 'b' }\nb = { frame = 'a' }", "circle: a in b in a"),
        ("[frames]\na = { frame = 'a' }", "circle: a in a"),
        ("[frames]\ntable = {}\na = { frame = 'tble' }", "no frame tble; did you mean table"),
        ("[frames]\na = { wxyz = [1, 0, 0, 0], euler_zyx = [0, 0, 0] }", "give one of them"),
        ("[frames]\na = { wxyz = [1, 1, 0, 0] }", "frames.a: quaternion norm"),
        ("[frames]\na = { euler_zyx = [90, 0, 0] }", "did you pass degrees"),
        ("[frames]\na = 3", "frames.a: is 3, it must be a table"),
        ("may_touch = [['tabel', 1]]\n[obstacles.table]\nsphere = 1", "did you mean table"),
        ("may_touch = [['table', 9]]\n[obstacles.table]\nsphere = 1", "links 1 to 8"),
        ("may_touch = [['table']]", r'as \[\["table", 1\]\]'),
        ("margin = -1", "line 1, margin: margin is -1 m"),
        ("[robots.left]\nname = 'IRB 12O-3/0.58'\nq = []", "robots.left: unknown robot"),
        ("[robots.left]\nname = 'IRB 120-3/0.58'\nq = [1]", "must be a list of 6 numbers"),
        ("[robots.left]\nname = 'IRB 120-3/0.58'", "one of q .rad. and q_deg"),
        ("margin = 1\nb = = 2", "is not TOML: .*line 2"),
        ("[obstacles.a]\nbox = [" + "9" * 4000 + ", 1, 1]", "a.box: is .* 3 numbers"),
        ("[obstacles.a]\nsphere = " + "9" * 400, "a.sphere: is 9+.* it must be a number"),
        ("[obstacles.a]\nsphere = " + "9" * 5000, "is not TOML: .*4300 digits"),
        ("[obstacles.a]\nconvex = [[" + "9" * 400 + "]]", "rows of numbers, or the name of a file"),
        ("[obstacles.a]\nmesh = 'far.ply'", r"far\.ply has corners 0 to 2, triangles of 0 to 7"),
        ("[obstacles.a]\nmesh = 'less.ply'\nsolid = false", "triangles of -1 to 1"),
        ("[obstacles.a]\nmesh = 'cube.zip'", r"cube\.zip: a mesh is in a file that ends in \.stl"),
        *(
            (f"[obstacles.a]\npoints = '{name}.npy'\nradius = 1", "a.points: must be rows of num")
            for name in ("empty", "endless", "many", "words")
        ),
    ],
)
def test_bad_files_are_named(folder, text, words):
    for name, corner in (("far", 7), ("less", -1)):
        (folder / f"{name}.ply").write_text(PLY.format(corner))
    (folder / "cube.zip").write_bytes(b"PK")
    (folder / "empty.npy").write_bytes(b"")
    header = (
        b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (10**11, 3), }"
    )
    (folder / "endless.npy").write_bytes(
        header.replace(b"10**11", b"1" + b"0" * 11).ljust(127) + b"\n"
    )
    np.savez(folder / "many.npz", np.zeros((1, 3)))
    (folder / "many.npz").rename(folder / "many.npy")
    np.save(folder / "words.npy", np.array([["a", "b", "c"]]))
    with pytest.raises(irbkin.InvalidModelError, match=words):
        load(folder, text)


def test_a_hundred_thousand_obstacles_are_a_cell():
    # Spheres of a scan. In quadratic time it would take minutes.
    shape = Shape.sphere(0.1, np.zeros(3))
    obstacles = {f"b{k}": shape.moved(irbkin.pose([k % 50, 0, 0])) for k in range(100_000)}
    start = time.perf_counter()
    cell = irbkin.Cell(obstacles, may_touch=[(f"b{k}", 1) for k in range(100_000)])
    assert time.perf_counter() - start < 5
    assert len(cell.obstacles) == len(cell.may_touch) == 100_000


def test_files_that_are_no_cells(folder):
    with pytest.raises(irbkin.InvalidModelError, match=r"ends in \.toml, \.urdf or \.xml"):
        load(folder, "", "cell.json")
    with pytest.raises(FileNotFoundError):
        irbkin.Cell.load(folder / "none.toml")
    (folder / "cell.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(irbkin.InvalidModelError, match="UTF-8"):
        irbkin.Cell.load(folder / "cell.toml")
    chain = "".join(f"f{at} = {{ frame = 'f{at + 1}' }}\n" for at in range(5000))
    for text in (f"[frames]\n{chain}f5000 = {{}}", "a = " + "[" * 5000):
        with pytest.raises(irbkin.InvalidModelError, match=r"nested too deeply|is not TOML"):
            load(folder, text)


URDF = """
<robot name="cell">
  <link name="world"/>
  <link name="table"><collision><origin xyz="0 0 -0.1" rpy="0.3 0.2 0.1"/>
    <geometry><box size="1 2 0.1"/></geometry></collision></link>
  <link name="fixture">
    <collision><geometry><mesh filename="package://cell/cube.obj" scale="1e-3 1e-3 2e-3"/>
    </geometry></collision>
    <collision><geometry><cylinder radius="0.1" length="1"/></geometry></collision></link>
  <link name="base_link"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
  <link name="link_1"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
  <link name="link_2"/><link name="tool"/>
  <link name="link_3"/><link name="link_4"/><link name="link_5"/><link name="link_6"/>
  <joint name="a" type="fixed"><parent link="world"/><child link="table"/>
    <origin xyz="1 0 0.3"/></joint>
  <joint name="b" type="fixed"><parent link="table"/><child link="fixture"/>
    <origin xyz="0 0.5 0.1" rpy="0 0 1"/></joint>
  <joint name="c" type="fixed"><parent link="world"/><child link="base_link"/></joint>
  <joint name="d" type="revolute"><parent link="base_link"/><child link="link_1"/></joint>
  <joint name="e" type="revolute"><parent link="link_1"/><child link="link_2"/></joint>
  <joint name="f" type="fixed"><parent link="link_2"/><child link="tool"/></joint>
  <joint name="g" type="revolute"><parent link="link_2"/><child link="link_3"/></joint>
  <joint name="h" type="revolute"><parent link="link_3"/><child link="link_4"/></joint>
  <joint name="i" type="revolute"><parent link="link_4"/><child link="link_5"/></joint>
  <joint name="j" type="revolute"><parent link="link_5"/><child link="link_6"/></joint>
</robot>
"""
SRDF = """<robot name="cell">
  <disable_collisions link1="tool" link2="fixture" reason="Never"/>
  <disable_collisions link1="table" link2="link_1" reason="Adjacent"/>
  <disable_collisions link1="table" link2="base_link" reason="Adjacent"/>
</robot>"""


def test_what_stands_still_in_a_urdf_is_an_obstacle(folder):
    cell = load(folder, URDF, "cell.urdf")
    assert list(cell.obstacles) == ["table", "fixture"]
    assert cell.may_touch == []
    table = irbkin.pose([1, 0, 0.3])
    at = table @ irbkin.pose([0, 0.5, 0.1], euler_zyx=[1, 0, 0])
    same = irbkin.Cell(
        {
            "table": Shape.box(
                [1, 2, 0.1], table @ irbkin.pose([0, 0, -0.1], euler_zyx=[0.1, 0.2, 0.3])
            ),
            "fixture": Shape.union([Shape.box([0.4, 0.4, 0.8], at), Shape.cylinder(0.1, 1, at)]),
        }
    )
    q = np.random.default_rng(4).uniform(-2, 2, (500, 6))
    one, other = cell.distance(ROBOT, q), same.distance(ROBOT, q)
    np.testing.assert_allclose(one.distance, other.distance, atol=1.1e-7)
    (folder / "cell.srdf").write_text(SRDF)
    assert load(folder, URDF, "cell.urdf").may_touch == [("table", 1), ("fixture", 2)]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('<link name="world"/>', '<link name="world"><drake:of a="1"/></link>'),
        ('<robot name="cell">', '<!DOCTYPE robot>\n<robot name="A & B" sim:of="c">'),
    ],
)
def test_what_is_of_no_shape_stops_no_urdf(folder, old, new):
    assert old in URDF
    cell = load(folder, URDF.replace(old, new).strip(), "cell.urdf")
    assert cell == load(folder, URDF, "cell.urdf")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("<box size", "<bx size", "link table: unknown shape bx; known: box"),
        ('size="1 2 0.1"', 'size="1 2"', "link table: size of box is '1 2', it must be 3 numbers"),
        ('size="1 2 0.1"', 'size="1 2 0"', "link table: size is 0 m"),
        ('size="1 2 0.1"', 'size="800 1200 50"', "link table: box size is 800 m, .*in millimeters"),
        ('xyz="0 0 -0.1"', 'xyz="0 0 -250"', r"link table: .*\[2\] is -250 m, .*in millimeters"),
        ("cube.obj", "cub.obj", r"link fixture: the mesh package://cell/cub\.obj is neither"),
        ('<link name="world"/>', "", "no link world"),
        ('<child link="tool"/>', '<child link="link_1"/>', "root link|two joints lead"),
        ("</robot>", "", "is not XML"),
    ],
)
def test_bad_urdf_is_named(folder, old, new, words):
    text = URDF.replace(old, new, 1)
    assert text != URDF
    with pytest.raises(irbkin.InvalidModelError, match=words):
        load(folder, text, "cell.urdf")


def test_one_arm_is_in_a_urdf_and_moves(folder):
    # Of the arm's own links nothing is read.
    text = URDF.replace("<sphere", "<ball")
    assert len(load(folder, text, "cell.urdf").obstacles) == 2
    text = URDF.replace('name="b" type="fixed"', 'name="b" type="prismatic"')
    with pytest.raises(irbkin.InvalidModelError, match=r"the joints . and . both begin an arm"):
        load(folder, text, "cell.urdf")


def test_an_open_mesh_of_a_file_is_a_surface_only_when_that_is_asked_for(folder):
    write_cube(folder / "closed.obj", 200)
    (folder / "cube.obj").write_text((folder / "cube.obj").read_text().rpartition("\n")[0])
    text = """
        [obstacles.open]
        mesh = "cube.obj"
        scale = 0.001
        [obstacles.closed]
        mesh = "closed.obj"
        scale = 0.001
    """
    for content, name in ((text, "cell.toml"), (URDF, "cell.urdf")):
        with pytest.raises(irbkin.InvalidModelError, match=r"not closed: .*solid=False"):
            load(folder, content, name)
        cell = irbkin.Cell.load(folder / name, solid=False)
        kinds = {own: shape.data() for own, shape in cell.obstacles.items()}
        if name == "cell.toml":
            assert not kinds["open"]["solid"]
            assert kinds["closed"]["solid"]
        else:
            assert not kinds["fixture"]["shapes"][0]["solid"]
    # What a file says counts, and other faults are errors.
    (folder / name).write_text(URDF.replace("1e-3 1e-3 2e-3", "1e3 1e3 1e3"))
    with pytest.raises(irbkin.InvalidModelError, match="millimeters"):
        irbkin.Cell.load(folder / name, solid=False)
    solid = text.replace("scale = 0.001", "scale = 0.001\nsolid = true")
    (folder / "cell.toml").write_text(textwrap.dedent(solid))
    with pytest.raises(irbkin.InvalidModelError, match="not closed"):
        irbkin.Cell.load(folder / "cell.toml", solid=False)
