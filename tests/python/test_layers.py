"""A module uses only what is above it in the table of layers of ARCHITECTURE.md.

Of Rust the graph of crates shows it.
"""

import re

import pytest
from python_modules import PACKAGE, cycles, used_by

ARCHITECTURE = PACKAGE.parents[1] / "ARCHITECTURE.md"


def layers() -> list[list[str]]:
    """The first column of the table: rows of module paths."""
    after = ARCHITECTURE.read_text().split("\n## Layers of the Python package\n")[1]
    section = after.split("\n#")[0]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    return [re.findall(r"`([\w/]+?)/?`", row) for row in rows]


ROWS = {path: number for number, row in enumerate(layers()) for path in row}
USED = used_by()
# The package itself hands on the names of all others.
FILES = [module for module in USED if module != "irbkin"]


def entry(file: str) -> str | None:
    """The longest path of the table that a file is or is in."""
    found = [path for path in ROWS if file == path or file.startswith(f"{path}/")]
    return max(found, key=len, default=None)


def test_the_table_has_rows_and_each_path_is_a_module():
    assert len(layers()) > 10
    for path in ROWS:
        assert path == "_core" or (PACKAGE / path).is_dir() or (PACKAGE / f"{path}.py").is_file()


@pytest.mark.parametrize("file", FILES)
def test_every_module_has_a_layer(file):
    assert entry(file), f"{file} is in no row"


@pytest.mark.parametrize("file", FILES)
def test_a_module_uses_only_what_is_above_it(file):
    own = entry(file)
    # A row of several paths is of siblings, which do not use one another.
    wrong = [
        used
        for used in USED[file]
        if entry(used) not in (None, own) and ROWS[entry(used)] >= ROWS[own]
    ]
    assert not wrong, f"{file} uses {sorted(wrong)}"


def test_no_files_use_one_another_in_a_circle():
    graph = used_by()
    # A scene has a method that returns its view, which is made of it.
    graph["scene/_data"].remove("scene/_widget")
    assert cycles(graph) == []


def test_what_python_modules_import_is_seen():
    """Names that packages hand on, imports in functions, and names of a package imported whole."""
    assert "scene/_data" in USED["scene/_svg"]
    assert "lsp" in USED["cli/lsp"]
    assert "_core" in USED["cli/catalog"]
    assert "check/jobs" in USED["check/fixes"]
