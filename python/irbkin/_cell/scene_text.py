"""Cells from the `.scene` texts of MoveIt, as its RViz panel and its warehouse write them.

A name; for each object "* id", its pose (in texts since MoveIt 1.1), the number of shapes, and for
each shape its kind, sizes, pose and color; the number of subframes with poses; at the end ".".
"""

from __future__ import annotations

import re
from itertools import islice
from typing import Any

from irbkin._cell.moveit import cell_of_tables
from irbkin._core import Cell
from irbkin.errors import InvalidModelError

# Numbers of the sizes; a cylinder's are radius and length, in messages height and radius.
_SIZES = {"box": 3, "sphere": 1, "cylinder": 2}


def cell_of_text(content: bytes, folder: str, solid: bool) -> Cell:
    """The cell of a text."""
    text = content.decode("utf-8-sig", "replace")
    if text.split()[-1:] != ["."]:
        raise InvalidModelError("does not end with the line . of a MoveIt scene: is it cut off?")
    parts = re.split(r"^[ \t]*\*", text.rstrip()[:-1], flags=re.MULTILINE)[1:]
    objects = [_Part(part).object() for part in parts]
    return cell_of_tables({"collision_objects": objects}, folder, solid)


class _Part:
    """The text of an object, whose words are taken one after the other."""

    def __init__(self, text: str) -> None:
        name, _, rest = text.partition("\n")
        self.name, self.words = name.strip(), iter(rest.split())
        self.has_pose = len(rest.partition("\n")[0].split()) > 1

    def refuse(self, cause: str) -> InvalidModelError:
        return InvalidModelError(f"{self.name}: {cause}")

    def numbers(self, count: int) -> list[float]:
        words = list(islice(self.words, count))
        try:
            numbers = [float(word) for word in words]
        except ValueError:
            numbers = []
        if len(numbers) != count:
            raise self.refuse(f"{' '.join(words)!r} must be {count} numbers")
        return numbers

    def count(self) -> int:
        word = next(self.words, "")
        if not word.isdecimal():
            raise self.refuse(f"{word!r} must be a count")
        return int(word)

    def pose(self) -> dict[str, list[float]]:
        return {"position": self.numbers(3), "orientation": self.numbers(4)}

    def object(self) -> dict[str, Any]:
        """The table of a CollisionObject."""
        table: dict[str, Any] = {"id": self.name, "pose": self.pose() if self.has_pose else {}}
        for _ in range(self.count()):
            kinds, poses, shape = self.shape(next(self.words, ""))
            table.setdefault(kinds, []).append(shape)
            table.setdefault(poses, []).append(self.pose())
            self.numbers(4)
        for _ in range(self.count() if self.has_pose else 0):
            next(self.words, "")
            self.pose()
        if rest := next(self.words, ""):
            raise self.refuse(f"{rest!r} is behind its last shape")
        return table

    def shape(self, kind: str) -> tuple[str, str, dict[str, Any]]:
        if kind == "plane":
            return "planes", "plane_poses", {"coef": self.numbers(4)}
        if kind == "mesh":
            vertices, faces = self.count(), self.count()
            corners = [self.numbers(3) for _ in range(vertices)]
            rows = [[self.count() for _ in range(3)] for _ in range(faces)]
            return "meshes", "mesh_poses", {"vertices": corners, "triangles": rows}
        if kind not in _SIZES:
            raise self.refuse(f"unknown shape {kind}; known: {', '.join(_SIZES)}, mesh, plane")
        sizes = self.numbers(_SIZES[kind])
        sizes = sizes[::-1] if kind == "cylinder" else sizes
        return "primitives", "primitive_poses", {"type": kind, "dimensions": sizes}
