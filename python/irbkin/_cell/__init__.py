"""Cells from files: `Cell.load`. What is in them is in docs/guide/cell.md."""

import os
from collections.abc import Mapping
from typing import Any

from irbkin._core import Cell, Shape
from irbkin.errors import InvalidModelError

_URDF = (".urdf", ".xml")


def load(source: Any, solid: bool = True, joints: Mapping[str, float] | None = None) -> Cell:
    """Read the cell of a file, or of a PlanningScene message of ROS or its dict.

    `joints` has the positions of joints of a URDF by their names [rad or m].
    """
    if isinstance(source, str | bytes | os.PathLike):
        return read(source, solid, joints)[0]
    from irbkin._cell.moveit import cell_of_message

    if joints is not None:
        raise InvalidModelError("joints are of a URDF, and this is a message")
    return cell_of_message(source, solid)


def read(
    path: str | os.PathLike[str] | bytes,
    solid: bool = True,
    joints: Mapping[str, float] | None = None,
) -> tuple[Cell, dict[str, list[Shape]]]:
    """Read a cell, and the shapes of tools and parts in the flange frame, by lower-case names."""
    path = os.fsdecode(path)
    ending = os.path.splitext(path)[1].lower()
    if ending not in (".toml", *_URDF):
        raise InvalidModelError(f"{path}: a cell is in a file that ends in .toml, .urdf or .xml")
    if joints is not None and ending not in _URDF:
        raise InvalidModelError(f"{path}: joints are of a URDF, not of a file in {ending}")
    with open(path, "rb") as file:
        content = file.read()
    try:
        if ending == ".toml":
            from irbkin._cell.tables import cell_of

            return cell_of(content, os.path.dirname(path), solid)
        from irbkin._cell.urdf import cell_of_urdf

        return cell_of_urdf(content, path, joints or {}, solid), {}
    except InvalidModelError as error:
        raise InvalidModelError(f"{path}: {error}") from None
    except RecursionError:
        raise InvalidModelError(f"{path}: values or frames are nested too deeply") from None
