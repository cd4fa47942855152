"""The shapes of arms and obstacles: what `Robot.body` and `Cell` are made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from irbkin._arguments import check_extra
from irbkin._core import Body, Shape

if TYPE_CHECKING:
    import os

    import numpy.typing as npt

__all__ = ["Body", "Shape", "cover"]


def cover(
    mesh: str | os.PathLike[str] | npt.ArrayLike,
    *,
    scale: float = 1.0,
    excess: float | None = None,
    most: int = 4,
) -> list[Shape]:
    """Return capsules that contain a mesh, as a tool for `Robot.with_attached`.

    They contain every triangle, and the inside of a closed mesh. It needs `pip install
    'irbkin[mesh]'`, and takes some seconds.

    Args:
        mesh: A file (STL, OBJ, DAE), or the corners of triangles, shape (n, 3, 3).
        scale: Factor of its lengths: 0.001 of a file in millimeters.
        excess: How far 95 % of their surface may be outside the mesh [m]: the fewest that meet it
            are taken. When not given, or not met, as many as `most` allows.
        most: Capsules at most, 1 to 12.

    Raises:
        InvalidModelError: A file is no mesh, the triangles have no size or are not finite.
        FileNotFoundError: There is no such file.
        ImportError: trimesh or scipy is not installed.
    """
    check_extra("irbkin.body.cover", "mesh", "scipy", "trimesh")
    from irbkin._fit import capsules_around

    rows = capsules_around(mesh, scale, excess, most)
    return [Shape.capsule(row[:3], row[3:6], row[6]) for row in rows]


def _fit_body(*arguments: Any) -> Body:
    check_extra("irbkin.body.Body.fit", "mesh", "scipy", "trimesh")
    from irbkin._fit import body_of

    return body_of(*arguments)
