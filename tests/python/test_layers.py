"""A module uses only what is above it in the tables of layers of ARCHITECTURE.md."""

import re

import pytest
import python_modules
from python_modules import PACKAGE
from rust_modules import SRC, cycles, expanded, home, modules, used_by

ARCHITECTURE = SRC.parent / "ARCHITECTURE.md"


def layers(title: str) -> list[list[str]]:
    """The first column of the table under a title: rows of module paths."""
    section = ARCHITECTURE.read_text().split(f"\n{title}\n")[1].split("\n#")[0]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    return [re.findall(r"`([\w/]+?)/?`", row) for row in rows]


RUST, PYTHON = "## Layers", "### Layers of the Python package"
LAYERS = {title: layers(title) for title in (RUST, PYTHON)}
ROWS = {
    title: {path: number for number, row in enumerate(table) for path in row}
    for title, table in LAYERS.items()
}
USED = {RUST: used_by(), PYTHON: python_modules.used_by()}


def entry(title: str, file: str) -> str | None:
    """The longest path of a table that a file is or is in."""
    name = re.sub(r"(/mod)?\.rs$", "", file)
    found = [path for path in ROWS[title] if name == path or name.startswith(f"{path}/")]
    return max(found, key=len, default=None)


FILES = [(RUST, str(module)) for module in modules().values() if not module.is_index]
# The package itself hands on the names of all others.
FILES += [(PYTHON, module) for module in USED[PYTHON] if module != "irbkin"]


def test_the_tables_have_rows_and_each_path_is_a_module():
    assert min(map(len, LAYERS.values())) > 10
    for path in ROWS[RUST]:
        assert (SRC / path).is_dir() or (SRC / f"{path}.rs").is_file(), path
    for path in ROWS[PYTHON]:
        assert path == "_core" or (PACKAGE / path).is_dir() or (PACKAGE / f"{path}.py").is_file()


@pytest.mark.parametrize(("title", "file"), FILES)
def test_every_module_has_a_layer(title, file):
    assert entry(title, file), f"{file} is in no row"


@pytest.mark.parametrize(("title", "file"), FILES)
def test_a_module_uses_only_what_is_above_it(title, file):
    own, rows = entry(title, file), ROWS[title]
    # A row of several paths is of siblings, which do not use one another.
    wrong = [
        used
        for used in USED[title][file]
        if entry(title, used) not in (None, own) and rows[entry(title, used)] >= rows[own]
    ]
    assert not wrong, f"{file} uses {sorted(wrong)}"


def test_no_files_use_one_another_in_a_circle():
    assert cycles(used_by()) == []
    graph = python_modules.used_by()
    # For its type alone: a scene has a method that returns its view, which is made of it.
    graph["scene/_data"].remove("scene/_widget")
    assert cycles(graph) == []


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


def test_what_python_modules_import_is_seen():
    """Names that packages hand on, imports in functions, and names of a package imported whole."""
    seen = USED[PYTHON]
    assert "scene/_data" in seen["scene/_strokes"]
    assert "lsp" in seen["cli/lsp"]
    assert "_core" in seen["cli/catalog"]
    assert "check/jobs" in seen["check/fixes"]


NAMED = re.compile(r"^pub(?:\(crate\))? (?:const|static|struct|enum) (\w+)", re.MULTILINE)
#: Rooms for what several rooms raise, answer or ask.
SHARED = ("error", "interrupt", "report")
#: Names that no code of their room uses.
ELSEWHERE = {
    "Boxes": "the blocks inside of it, which no other room sees",
    "MOST_SIN_COS": "the domain of the functions beside it",
    "Outline": "its radii are bounds that bodies calculate",
}


def test_a_name_is_in_a_room_that_uses_it():
    """No constant, error or type is below its lowest user, where two rooms do not share it."""
    room = {str(module): re.split("[/.]", str(module))[0] for module in modules().values()}
    users: dict[tuple[str, str], set[str]] = {}
    for file, module in ((str(module), module) for module in modules().values()):
        # What the one `Error` joins it does not use.
        for path in module.uses if file != "error/mod.rs" else ():
            for name in path:
                users.setdefault((str(home(path)), name), set()).add(room[file])
    wrong = {}
    for file, module in ((str(module), module) for module in modules().values()):
        rest = re.sub(r"\b(?:impl\b[^{;]*|(?:struct|enum|const) \w+)", "", module.text)
        for name in NAMED.findall(module.text):
            rooms = users.get((file, name), set())
            is_used = room[file] in rooms or re.search(rf"\b{name}\b", rest)
            # The extension module is an interface.
            rooms = rooms - {"python"}
            if rooms and not is_used and (room[file] not in SHARED or len(rooms) == 1):
                wrong[name] = (file, sorted(rooms))
    assert wrong.keys() == ELSEWHERE.keys(), wrong
