"""The Python seam and the URDF reader are layered: no file of a folder comes back to itself through
what it uses.
"""

import re
from pathlib import Path

import pytest

SRC = Path(__file__).parents[2] / "src"
MOST_LINES = 400


def uses(folder: Path) -> dict[str, set[str]]:
    """For each file or folder of a folder, but for its `mod`, the others that it uses by `super::`
    or by `crate::`.
    """
    rooms = {path.stem for path in folder.iterdir()} - {"mod"}
    graph = {}
    for room in rooms:
        text = ""
        for path in [folder / f"{room}.rs", *sorted((folder / room).rglob("*.rs"))]:
            if path.exists():
                text += path.read_text().split("#[cfg(test)]")[0]
        inner = "super::super::" if (folder / room).is_dir() else "super::"
        prefixes = rf"(?:(?<![:\w]){inner}|crate::{folder.name}::)"
        names = re.findall(prefixes + r"(\w+)", text)
        for group in re.findall(prefixes + r"\{(.*?)\};", text, re.DOTALL):
            names += re.findall(r"(?:^|,)\s*(\w+)", re.sub(r"\{[^{}]*\}", "", group))
        graph[room] = {name for name in names if name in rooms} - {room}
    return graph


def reached(graph: dict[str, set[str]], room: str) -> set[str]:
    """Every room that one leads to."""
    found: set[str] = set()
    following = [room]
    while following:
        for other in graph[following.pop()] - found:
            found.add(other)
            following.append(other)
    return found


@pytest.mark.parametrize("folder", ["python", "urdf"])
def test_no_file_comes_back_to_itself(folder):
    graph = uses(SRC / folder)
    assert sum(map(len, graph.values())) >= len(graph), "the arrows are found"
    assert {room: sorted(graph[room]) for room in graph if room in reached(graph, room)} == {}


@pytest.mark.parametrize("folder", ["python", "urdf"])
def test_no_file_is_too_long(folder):
    long = {
        path.name: n
        for path in (SRC / folder).rglob("*.rs")
        if (n := len(path.read_text().splitlines())) > MOST_LINES
    }
    assert long == {}
