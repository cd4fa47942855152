"""Triangles of capsules, hulls and obstacles, by trimesh."""

from __future__ import annotations

from typing import Any

import numpy as np
import trimesh

from irbkin.scene import LinkHull, LinkShape
from irbkin.scene._arms import face_normals, outward

SMOOTH = np.cos(np.radians(42.0))
"""Faces whose normals have a larger product look round."""
HALF_SPACE = 3.0
"""Half of the edge of the square that is drawn of a half space [m]."""


def capsule(shape: LinkShape) -> Any:
    """Return the mesh of a capsule in the frame of its link."""
    a, b = np.array(shape.a), np.array(shape.b)
    long = float(np.linalg.norm(b - a))
    if long == 0.0:
        return _ball(a, shape.radius)
    mesh = trimesh.creation.capsule(height=long, radius=shape.radius, count=(16, 16))
    # Versions of trimesh differ in where it is.
    mesh.apply_translation(-mesh.bounds.mean(axis=0))
    mesh.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], (b - a) / long))
    mesh.apply_translation(0.5 * (a + b))
    return mesh


def hull(shape: LinkHull) -> Any:
    """Return the mesh of a hull in the frame of its link, each triangle with corners of its own:
    their normals are even across edges that look round.
    """
    points, faces = outward(shape), np.array(shape.faces)
    flat = face_normals(points, faces)
    beside = (faces[:, :, None, None] == faces).any(axis=3) & (flat @ flat.T > SMOOTH)[:, None]
    corners, normals = points[faces].reshape(-1, 3), (beside @ flat).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    triangles = np.arange(len(corners)).reshape(-1, 3)
    return trimesh.Trimesh(corners, triangles, vertex_normals=normals, process=False)


def joined(shapes: list[LinkShape | LinkHull]) -> Any:
    """Return one mesh of several capsules and hulls."""
    made = [hull(it) if isinstance(it, LinkHull) else capsule(it) for it in shapes]
    return trimesh.util.concatenate(made)


def obstacle(shape: dict[str, Any]) -> Any:
    """Return the mesh of a shape as `irbkin.body.Shape.data` has it."""
    kind = shape["kind"]
    if kind == "union":
        return trimesh.util.concatenate([obstacle(it) for it in shape["shapes"]])
    if kind == "sphere":
        return _ball(shape["center"], shape["radius"])
    if kind == "capsule":
        return capsule(LinkShape(0, tuple(shape["a"]), tuple(shape["b"]), shape["radius"]))
    if kind == "half_space":
        turn = trimesh.geometry.align_vectors([0, 0, 1], shape["normal"])
        turn[:3, 3] = shape["point"]
        flat = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * HALF_SPACE
        mesh = trimesh.Trimesh(flat, [[0, 1, 2], [0, 2, 3]])
        mesh.apply_transform(turn)
        return mesh
    mesh = _framed(kind, shape)
    mesh.apply_transform(np.array(shape["pose"]))
    return mesh


def _framed(kind: str, shape: dict[str, Any]) -> Any:
    """The mesh of a shape in the frame of its pose."""
    if kind == "box":
        return trimesh.creation.box(shape["size"])
    if kind == "cylinder":
        return trimesh.creation.cylinder(shape["radius"], shape["length"])
    if kind == "convex":
        return trimesh.convex.convex_hull(np.array(shape["points"]))
    if kind == "points":
        return trimesh.util.concatenate([_ball(it, shape["radius"]) for it in shape["points"]])
    triangles = np.array(shape["triangles"])
    return trimesh.Trimesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def _ball(center: Any, radius: float) -> Any:
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=radius)
    mesh.apply_translation(center)
    return mesh
