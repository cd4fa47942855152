"""Cells from files: `Cell.load`. What is in them is in docs/guide/cell.md."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from irbkin.errors import InvalidModelError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from irbkin._core import Cell, Shape

__all__ = ["load"]


def load(
    path: str | os.PathLike[str], solid: bool = True, joints: Mapping[str, float] | None = None
) -> Cell:
    """Read the cell of a TOML file or of a URDF.

    `joints` has the positions of joints of a URDF by their names [rad or m].
    """
    return read(path, solid, joints)[0]


def read(
    path: str | os.PathLike[str], solid: bool = True, joints: Mapping[str, float] | None = None
) -> tuple[Cell, dict[str, list[Shape]]]:
    """Read a cell, and the shapes of tools and parts in the flange frame, by lower-case names."""
    path = os.fspath(path)
    ending = os.path.splitext(path)[1].lower()
    if ending not in (".toml", ".urdf", ".xml"):
        raise InvalidModelError(f"{path}: a cell is in a file that ends in .toml, .urdf or .xml")
    if joints is not None and ending == ".toml":
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
