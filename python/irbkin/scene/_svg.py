"""Small pictures of arms, as SVG without any other package."""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin.scene._arms import face_normals, link_frames, outward, solids, start
from irbkin.scene._data import Arm, LinkHull, LinkShape, Scene

# Seen from the front on the right, from above.
AZIMUTH, ELEVATION = np.radians([-29.0, 20.0])
SIDEWAYS = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
LEVEL = np.array([np.cos(AZIMUTH), np.sin(AZIMUTH), 0.0])
UPWARD = np.cos(ELEVATION) * np.array([0.0, 0.0, 1.0]) - np.sin(ELEVATION) * LEVEL
TOWARD = np.cross(SIDEWAYS, UPWARD)
LIGHT = SIDEWAYS * -0.35 + UPWARD * 0.75 + TOWARD * 0.56
"""The direction to the light, of length 1."""
BASE, LINKS, CARRIED = "#5b6470", ("#e8912d", "#f3ae5c"), "#6f7a88"
"""Colors of the base, of the links in turn, and of what the flange carries."""
Filled = Iterator[tuple[float, list[Floats], float]]
"""How near, polygons of the paper, and how much lighter than the color of the link."""
LAYERS = ((1.0, -0.16), (0.82, 0.0), (0.5, 0.18))
"""Layers of a capsule: part of its radius, and how much lighter than its color."""
TONES = 9
"""Tones from black to white of the faces of a hull."""
CAP = 11
"""Corners of a round end."""
SIZE = 200
"""Width and height of a picture, in its own units."""
LARGE = 800
"""Width and height of a picture that is a file [px]."""
GHOST = "#98a2b3"
WAY = "#0072b2"
MOST_GHOSTS = 7


def toned(color: str, lighter: float) -> str:
    """Return a color mixed with white, or with black if it is to be darker."""
    own = np.array(list(bytes.fromhex(color[1:])))
    mixed = (1 - abs(lighter)) * own + 255 * max(lighter, 0.0)
    return "#" + bytes(mixed.round().astype(int).tolist()).hex()


def on_paper(points: Floats) -> Floats:
    """Project points of the world, shape (..., 3), to the paper, (..., 2)."""
    return np.asarray(points @ np.column_stack([SIDEWAYS, UPWARD]))


def nearness(points: Floats) -> Floats:
    """Return how near points are to the eye [m], shape (...): far ones are drawn first."""
    return points @ TOWARD


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
        color = BASE if it.link == 0 else LINKS[it.link % 2]
        own = CARRIED if it.link > len(arm.joints) else color
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
    points, faces = outward(it) @ frame[:3, :3].T + frame[:3, 3], np.array(it.faces)
    normals, paper = face_normals(points, faces), on_paper(points)
    tones = np.round(TONES * (0.6 * normals @ LIGHT - 0.3)) / TONES
    seen = nearness(normals) > 0.0
    for tone in np.unique(tones[seen]):
        outlines = _outlines(faces[seen & (tones == tone)].tolist())
        yield float(nearness(points).mean()), [paper[it] for it in outlines], float(tone)


def _outlines(faces: list[list[int]]) -> list[list[int]]:
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


def of_scene(scene: Scene) -> str:
    """Draw the arms of a scene where they start, with their other postures, and its paths."""
    if not scene.arms:
        raise ValueError("the scene has no arm: a picture (.svg) is of arms and paths")
    arms = [(it, start(it), [posture.q for posture in it.postures]) for it in scene.arms]
    return picture(arms, [np.array(it.points) for it in scene.paths if it.points], LARGE)


def picture(
    arms: Sequence[tuple[Arm, npt.ArrayLike, Sequence[npt.ArrayLike]]],
    paths: Iterable[Floats] = (),
    size: int = SIZE,
) -> str:
    """Draw arms at joint angles, each with other postures, and ways of their tools."""
    arms = sorted(arms, key=lambda it: float(nearness(np.array(it[0].base)[:3, 3])))
    own = [it for arm, q, _ in arms for it in pieces(arm, q)]
    chains = [(GHOST, arm, it) for arm, _, ghosts in arms for it in ghosts[:MOST_GHOSTS]]
    chains += [(BASE, arm, q) for arm, q, _ in arms if not arm.body]
    others = [(color, on_paper(link_frames(arm, it)[:, :3, 3])) for color, arm, it in chains]
    ways = [on_paper(it) for it in paths]
    filled = [polygon for some, _ in own for polygon in some]
    points = np.vstack([*filled, *(places for _, places in others), *ways])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = SIZE / (1.04 * float((high - low).max()) + 1e-9)
    middle = 0.5 * (low + high)

    def corners(places: Floats) -> str:
        drawn = SIZE / 2 + scale * (places - middle) * [1, -1]
        return " ".join(f"{x:.1f} {y:.1f}" for x, y in drawn)

    look = 'fill="none" stroke-width="5" opacity=".35"'
    lines = [f'<polyline points="{corners(it)}" {look} stroke="{color}"/>' for color, it in others]
    lines.append('<g stroke-width=".3">')
    for some, color in own:
        text = "".join(f"M{corners(it)}Z" for it in some)
        lines.append(f'<path d="{text}" fill="{color}" stroke="{color}"/>')
    lines.append("</g>")
    lines += [f'<polyline points="{corners(it)}" fill="none" stroke="{WAY}"/>' for it in ways]
    head = f'<svg viewBox="0 0 {SIZE} {SIZE}" width="{size}" height="{size}" role="img"'
    return (
        f'{head} stroke-linecap="round" xmlns="http://www.w3.org/2000/svg">{"".join(lines)}</svg>'
    )
