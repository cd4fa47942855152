"""A module of the Rust crate uses only what is above it in ARCHITECTURE.md's table of layers."""

import re

import pytest
from rust_modules import SRC, cycles, expanded, home, modules, used_by

ARCHITECTURE = SRC.parent / "ARCHITECTURE.md"
LINES = 400


def layers() -> list[list[str]]:
    """The first column of the table under "Layers": rows of module paths."""
    section = ARCHITECTURE.read_text().split("\n## Layers\n")[1].split("\n## ")[0]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    return [re.findall(r"`([\w/]+?)/?`", row) for row in rows]


LAYERS = layers()
ROWS = {path: number for number, row in enumerate(LAYERS) for path in row}


def entry(file: str) -> str | None:
    """The longest path of the table that a file is or is in."""
    name = re.sub(r"(/mod)?\.rs$", "", file)
    found = [path for path in ROWS if name == path or name.startswith(f"{path}/")]
    return max(found, key=len, default=None)


FILES = [str(module) for module in modules().values() if not module.is_index]


def test_the_table_has_rows_and_each_path_is_a_module():
    assert len(LAYERS) > 10
    for path in ROWS:
        assert (SRC / path).is_dir() or (SRC / f"{path}.rs").is_file(), path


@pytest.mark.parametrize("file", FILES)
def test_every_module_has_a_layer(file):
    assert entry(file), f"{file} is in no row"


@pytest.mark.parametrize("file", FILES)
def test_a_module_uses_only_what_is_above_it(file):
    own = entry(file)
    # A row of several paths is of siblings, which do not use one another.
    wrong = [
        used
        for used in used_by()[file]
        if entry(used) not in (None, own) and ROWS[entry(used)] >= ROWS[own]
    ]
    assert not wrong, f"{file} uses {sorted(wrong)}"


def test_no_files_use_one_another_in_a_circle():
    assert cycles() == []


@pytest.mark.parametrize(
    "file", [path.relative_to(SRC).as_posix() for path in sorted(SRC.rglob("*.rs"))]
)
def test_a_file_is_no_longer_than_it_may_be(file):
    # The arms of the catalog and their bodies are blocks of numbers.
    if not file.startswith(("catalog/", "body/arms/")):
        assert len((SRC / file).read_text().splitlines()) <= LINES


def test_nested_braces_are_taken_apart():
    assert expanded("super::{a, b::{c, d::e}, f::{self, g as h}}") == [
        "super::a",
        "super::b::c",
        "super::b::d::e",
        "super::f::self",
        "super::f::g as h",
    ]


@pytest.mark.parametrize(
    ("path", "file"),
    [
        ("kinematics::Robot", "kinematics/robot/mod.rs"),
        ("kinematics::JointLimits::new", "kinematics/chain/limits.rs"),
        ("kinematics::thresholds::MOST_ANGLE", "kinematics/thresholds.rs"),
        ("kinematics::pose::Pose", "kinematics/pose/mod.rs"),
        ("Error", "error/mod.rs"),
    ],
)
def test_a_name_is_found_where_it_is_defined(path, file):
    assert str(home(tuple(path.split("::")))) == file


def test_what_folders_and_their_modules_use_is_seen():
    """The uses that a reader of `kinematics/*.rs` alone does not see."""
    seen = used_by()
    shoulder = "kinematics/structure/spherical_shoulder"
    assert {f"{shoulder}/geometry.rs", "kinematics/thresholds.rs"} <= seen[f"{shoulder}/mod.rs"]
    assert len(seen["kinematics/robot/mod.rs"]) > 5
