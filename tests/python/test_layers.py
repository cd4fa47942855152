"""A module of the Rust core uses only what stands before it."""

import re
from pathlib import Path

import pytest

SRC = Path(__file__).parents[2] / "src"
# ARCHITECTURE.md, "Layers". `error` holds the explanations and reasons of the core: the one that looks both ways.
LAYERS = [
    "thresholds",
    "angles",
    "rotation",
    "pose",
    "dh",
    "joint_axes",
    "axes",
    "coupling",
    "chain",
    "forward",
    "jacobian",
    "limits",
    "status",
    "solutions",
    "select",
    "free_choice",
    "branches",
    "singularity",
    "placement",
    "surroundings",
    "recognition",
    "block",
    "planar_arm",
    "zyz",
    "spherical_wrist",
    "three_parallel",
    "spherical_shoulder",
    "geometry",
    "robot",
    "family",
    "inverse",
    "configuration",
    "self_motion",
    "redundancy",
    "follow",
    "crossing",
]
OUTER = ["lanes", "kinematics", "catalogue", "batch", "urdf", "rapid", "python"]


def modules_used(path: Path) -> set[str]:
    """First names of what a file uses from `super::` of `kinematics` or from `crate::`."""
    text = path.read_text().split("#[cfg(test)]")[0]
    used = set()
    for statement in re.findall(r"^use ((?:super|crate)::[^;]*);", text, re.MULTILINE | re.DOTALL):
        inside = path.parent.name == "kinematics" and statement.startswith("super::")
        if inside or statement.startswith("crate::kinematics::"):
            used.add(statement.removeprefix("crate::kinematics::").removeprefix("super::").split("::")[0])
    return {name for name in used if name in LAYERS}


@pytest.mark.parametrize("name", LAYERS)
def test_a_module_of_the_kinematics_uses_those_before_it(name):
    files = [SRC / "kinematics" / f"{name}.rs", *sorted((SRC / "kinematics" / name).glob("*.rs"))]
    files = [path for path in files if path.exists()]
    assert files
    for path in files:
        later = {used for used in modules_used(path) if LAYERS.index(used) > LAYERS.index(name)}
        assert not later, f"{path.name} uses {sorted(later)}"


def test_the_list_of_layers_is_complete():
    found = {path.stem if path.is_file() else path.name for path in (SRC / "kinematics").iterdir()} - {"mod"}
    assert found == set(LAYERS)


@pytest.mark.parametrize("name", OUTER)
def test_an_outer_module_uses_those_before_it(name):
    later = OUTER[OUTER.index(name) + 1 :]
    files = [SRC / f"{name}.rs", *sorted((SRC / name).rglob("*.rs"))]
    for path in filter(Path.exists, files):
        for other in later:
            assert f"crate::{other}" not in path.read_text(), f"{path} uses {other}"
