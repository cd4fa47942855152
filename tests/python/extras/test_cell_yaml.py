"""Cells from MoveIt's scenes in YAML, and from meshes beside them."""

import sys

import irbkin
import numpy as np
import pytest
import trimesh
from irbkin.body import Shape

# As MotionBenchMaker, vamp and robowflex write problems.
SCENE = """
name: (noname)+
fixed_frame_transforms:
  - child_frame_id: world
    transform: {translation: [0, 0, 0], rotation: [0, 0, 0, 1]}
world:
  collision_objects:
    - id: Can1
      pose: {position: [1e-1, 0, 0], orientation: [0, 0, 0, 1]}
      primitives:
        - {type: cylinder, dimensions: [0.12, 0.03]}
      primitive_poses:
        - {position: [0.9, 1E-05, 0.8], orientation: [0, 0, 0, 1]}
    - id: part
      meshes:
        - {resource: "package://scenes/part.stl", dimensions: [1e-3, 0.001, 0.002]}
      mesh_poses:
        - {position: [0, 1, 0], orientation: [0, 0, 0, 1]}
"""


@pytest.fixture
def folder(tmp_path):
    trimesh.creation.box([200, 300, 400]).export(tmp_path / "part.stl")
    return tmp_path


def load(folder, text, **options):
    path = folder / "scene.yaml"
    path.write_text(text)
    return irbkin.Cell.load(path, **options)


def test_a_scene_in_yaml_is_the_cell_that_it_describes(folder):
    cell = load(folder, SCENE)
    can = Shape.cylinder(0.03, 0.12, irbkin.pose([1.0, 1e-5, 0.8]))
    part = Shape.box([0.2, 0.3, 0.8], irbkin.pose([0, 1, 0]))
    assert list(cell.obstacles) == ["Can1", "part"]
    ball = irbkin.body.Body([6], [[0, 0, 0, 0, 0, 0, 1e-3]], [])
    robot = irbkin.Robot("IRB 2600-12/1.65").with_body(ball)
    q = np.random.default_rng(6).uniform(-2, 2, (400, 6))
    one, other = (
        own.distance(robot, q) for own in (cell, irbkin.Cell({"Can1": can, "part": part}))
    )
    np.testing.assert_allclose(one.distance, other.distance, atol=1.1e-7)
    assert {name for _, name in one.pair} == {"Can1", "part"}
    # A recorded topic ends its documents with a line.
    assert load(folder, SCENE + "---\n") == cell


def test_an_open_mesh_of_a_scene_is_a_surface_only_when_that_is_asked_for(folder):
    box = trimesh.creation.box([200, 300, 400])
    trimesh.Trimesh(box.vertices, box.faces[:-1]).export(folder / "part.stl")
    with pytest.raises(irbkin.InvalidModelError, match=r"part.*: the mesh is not closed"):
        load(folder, SCENE)
    assert not load(folder, SCENE, solid=False).obstacles["part"].data()["shapes"][0]["solid"]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[0.12, 0.03]", "[0.12]", r"Can1.primitives\[0\].dimensions: is \[0.12\], .* 2 numbers"),
        ("[0.12, 0.03]", "[0.12, .nan]", "Can1: radius is NaN m"),
        ("[0.12, 0.03]", "[120, 30]", "Can1: cylinder length is 120 m, .*in millimeters"),
        ("[0.12, 0.03]", '[0.12, "3"]', "it must be a list of 2 numbers"),
        ("[1e-3, 0.001, 0.002]", "[0.001, 0.001]", r"part.meshes\[0\].dimensions: .* 3 numbers"),
        (
            "part.stl",
            "prt.stl",
            "part.*: the mesh package://scenes/prt.stl is neither beside the f",
        ),
        ("id: part", "id: part\n      id: other", "id is given twice"),
        ("world:\n", "world: []\n", "is not YAML"),
        ("world:", "---\nworld:", "has 2 documents"),
        ("name:", "start_state: {}\nname:", "start_state: unknown key"),
        ("name: (noname)+", "name: !robot x", "is not YAML: could not determine a constructor"),
    ],
)
def test_bad_scenes_are_named(folder, old, new, words):
    assert old in SCENE
    with pytest.raises(irbkin.InvalidModelError, match=words):
        load(folder, SCENE.replace(old, new, 1))


def test_the_error_names_the_extra(folder, monkeypatch):
    monkeypatch.setitem(sys.modules, "yaml", None)
    with pytest.raises(ImportError, match=r"read by PyYAML: pip install 'irbkin\[yaml\]'"):
        load(folder, SCENE)


def test_aliases_do_not_make_a_scene_larger_than_its_text(tmp_path):
    levels = "\n".join(f"b{n}: &b{n} [{', '.join([f'*b{n - 1}'] * 9)}]" for n in range(1, 6))
    (file := tmp_path / "scene.yaml").write_text(f"b0: &b0 [1, 2]\n{levels}\nworld: *b5\n")
    with pytest.raises(irbkin.InvalidModelError, match="repeats its parts by aliases"):
        irbkin.Cell.load(file)
