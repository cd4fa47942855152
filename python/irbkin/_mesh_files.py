"""Files of meshes, read by trimesh: `pip install 'irbkin[mesh]'`."""

import os

import numpy as np
import numpy.typing as npt

from irbkin._core import Shape
from irbkin.errors import InvalidModelError

ENDINGS = (".stl", ".obj", ".dae", ".ply", ".off", ".glb", ".gltf", ".3mf")
"""Formats that are read. An archive may unpack to anything."""


def mesh(
    triangles: npt.ArrayLike | str | os.PathLike[str], solid: bool, *, scale: float = 1.0
) -> Shape:
    """A solid mesh; unless `solid`, its surface if it is not closed or has no volume."""
    try:
        return Shape.mesh(triangles, scale=scale)
    except InvalidModelError:
        if solid:
            raise
    return Shape.mesh(triangles, scale=scale, solid=False)


def triangles(path: str | os.PathLike[str]) -> npt.NDArray[np.float64]:
    """The corners of all triangles of a file, in meters if it states its unit, shape (n, 3, 3)."""
    try:
        import trimesh
    except ImportError as missing:
        raise ImportError(
            "a file of a mesh is read by trimesh: pip install 'irbkin[mesh]', or give its "
            "triangles as an array of shape (n, 3, 3)",
            name="trimesh",
        ) from missing
    path = os.fspath(path)
    if not os.path.isfile(path):
        raise FileNotFoundError(f"there is no file of a mesh at {path}")
    if not path.lower().endswith(ENDINGS):
        raise InvalidModelError(f"{path}: a mesh is in a file that ends in {', '.join(ENDINGS)}")
    try:
        scene = trimesh.load_scene(path, process=False)
    # Its readers raise whatever a damaged file makes them raise.
    except Exception as error:
        raise InvalidModelError(f"{path} is no mesh that trimesh reads: {error}") from error
    for part in scene.geometry.values():
        faces, count = np.asarray(getattr(part, "faces", [])), len(part.vertices)
        if faces.size and not 0 <= faces.min() <= faces.max() < count:
            found = f"{faces.min()} to {faces.max()}"
            raise InvalidModelError(f"{path} has corners 0 to {count - 1}, triangles of {found}")
    if scene.units not in (None, "m", "meter", "meters"):
        scene = scene.convert_units("meters")
    mesh = scene.to_mesh()
    if not len(mesh.faces):
        raise InvalidModelError(f"{path} has no triangles")
    return np.array(mesh.vertices[mesh.faces], dtype=np.float64)
