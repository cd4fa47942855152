"""Arms as flat pieces on paper, each of one color."""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin.scene._arms import face_normals, link_frames, outward, solids
from irbkin.scene._data import Arm, LinkHull, LinkShape
from irbkin.scene._look import CARRIED, LIGHT, link_color, nearness, on_paper, toned

Filled = Iterator[tuple[float, list[Floats], float]]
"""How near, polygons of the paper, and how much lighter than the color of the link."""
LAYERS = ((1.0, -0.16), (0.82, 0.0), (0.5, 0.18))
"""Layers of a capsule: part of its radius, and how much lighter than its color."""
TONES = 9
"""Tones from black to white of the faces of a hull."""
CAP = 11
"""Corners of a round end."""


def pieces(arm: Arm, q: npt.ArrayLike) -> list[tuple[list[Floats], str]]:
    """Return the body of an arm at joint angles [rad] as pieces, far ones first: polygons of the
    paper, shape (k, 2) [m], that are filled together, and their color, as "#0072b2".
    """
    frames = link_frames(arm, q)[:-1]
    found = []
    for it in solids(arm):
        # Parts that the flange carries move with the last link.
        frame = frames[min(it.link, len(frames) - 1)]
        layers = _stadiums(it, frame) if isinstance(it, LinkShape) else _faces(it, frame)
        own = CARRIED if it.link > len(arm.joints) else link_color(it.link)
        found += [(near, some, toned(own, tone)) for near, some, tone in layers]
    return [(some, fill) for _, some, fill in sorted(found, key=lambda layer: layer[0])]


def _stadiums(it: LinkShape, frame: Floats) -> Filled:
    """The outline of a capsule, and smaller ones towards the light."""
    points = np.array([it.a, it.b]) @ frame[:3, :3].T + frame[:3, 3]
    ends = on_paper(points)
    along = ends[1] - ends[0]
    turn = np.arctan2(along[1], along[0]) if np.hypot(*along) > 0.0 else 0.0
    angles = turn + np.linspace(-np.pi / 2, np.pi / 2, CAP)
    cap = it.radius * np.column_stack([np.cos(angles), np.sin(angles)])
    for part, lighter in LAYERS:
        middle = ends + (1.0 - part) * it.radius * np.array([-0.25, 0.35])
        outline = np.vstack([middle[1] + part * cap, middle[0] - part * cap])
        yield float(nearness(points).mean()), [outline], lighter


def _faces(it: LinkHull, frame: Floats) -> Filled:
    """The faces of a hull that are seen, those of one tone together."""
    points, faces = outward(it) @ frame[:3, :3].T + frame[:3, 3], np.array(it.faces)
    normals, paper = face_normals(points, faces), on_paper(points)
    tones = np.round(TONES * (0.6 * normals @ LIGHT - 0.3)) / TONES
    seen = nearness(normals) > 0.0
    for tone in np.unique(tones[seen]):
        outlines = _outlines(faces[seen & (tones == tone)].tolist())
        yield float(nearness(points).mean()), [paper[it] for it in outlines], float(tone)


def _outlines(faces: list[list[int]]) -> list[list[int]]:
    """The edges around triangles, where no other of them is: closed loops of points."""
    edges = {(face[i - 1], face[i]) for face in faces for i in range(3)}
    following: dict[int, list[int]] = {}
    for one, other in sorted(edges):
        if (other, one) not in edges:
            following.setdefault(one, []).append(other)
    loops = []
    while following:
        at, loop = next(iter(following)), []
        while at in following:
            loop.append(at)
            at = following[at].pop()
            if not following[loop[-1]]:
                del following[loop[-1]]
        loops.append(loop)
    return loops
