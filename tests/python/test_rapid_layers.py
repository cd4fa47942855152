"""A layer of the RAPID reader uses only those below it, and no files of it use each other in a
circle.
"""

import re
from pathlib import Path

RAPID = Path(__file__).parents[2] / "crates" / "irbkin-abb" / "src" / "rapid"


def layers() -> list[str]:
    """The layers, lowest first, as the module's own documentation lists them."""
    return re.findall(r"^//! \d+\. `(\w+)`", (RAPID / "mod.rs").read_text(), re.MULTILINE)


def uses(path: Path) -> set[str]:
    """What a file uses of the reader, as "layer/file", and as "layer/mod" what is not in a file of
    its own.
    """
    layer = path.parent.name
    text = path.read_text().split("#[cfg(test)]")[0]
    used = set()
    for root, rest in re.findall(
        r"^\s*(?:pub(?:\([^)]*\))? )?use (crate::rapid|super|self)::([\w:]+)", text, re.MULTILINE
    ):
        names = rest.split("::")
        if root != "crate::rapid":
            names.insert(0, layer)
        file = RAPID / names[0] / f"{names[1] if len(names) > 1 else 'mod'}.rs"
        used.add(f"{names[0]}/{file.stem if file.exists() else 'mod'}")
    return used


FILES = {
    f"{path.parent.name}/{path.stem}": uses(path)
    for layer in layers()
    for path in (RAPID / layer).glob("*.rs")
}


def test_the_documentation_lists_every_layer():
    assert sorted(layers()) == sorted(
        path.name for path in RAPID.iterdir() if path.is_dir() and path.name != "tests"
    )


def test_every_file_is_in_a_layer():
    assert {path.name for path in RAPID.glob("*.rs")} == {"mod.rs"}
    assert sum(map(len, FILES.values())) > 100


def test_a_layer_uses_those_below_it():
    order = layers()
    above = {
        (file, used)
        for file, all_used in FILES.items()
        for used in all_used
        if order.index(used.split("/")[0]) > order.index(file.split("/")[0])
    }
    assert not above


def test_no_files_use_each_other_in_a_circle():
    left = {file: used & FILES.keys() - {file} for file, used in FILES.items()}
    while free := {file for file, used in left.items() if not used & left.keys()}:
        left = {file: used for file, used in left.items() if file not in free}
    assert not left
