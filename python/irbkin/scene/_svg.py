"""Small pictures of arms and curves, as SVG without any other package."""

from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin.scene._arms import link_frames, start
from irbkin.scene._data import Arm, Scene
from irbkin.scene._look import BASE, nearness, on_paper
from irbkin.scene._strokes import pieces

SIZE = 200
"""Width and height of a picture, in its own units."""
LARGE = 800
"""Width and height of a picture that is a file [px]."""
GHOST = "#98a2b3"
LINES = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#777777")
MOST_GHOSTS = 7


def drawn(arm: Arm, q: npt.ArrayLike, ghosts: Iterable[npt.ArrayLike] = ()) -> str:
    """Draw an arm's body, and other postures as faint chains."""
    return _picture([(arm, q, list(ghosts))], (), SIZE)


def of_scene(scene: Scene) -> str:
    """Draw the arms of a scene where they start, with their other postures, and its paths.

    Raises:
        ValueError: It has no arm.
    """
    if not scene.arms:
        raise ValueError("the scene has no arm: a picture (.svg) is of arms and paths")
    arms = [(it, start(it), [posture.q for posture in it.postures]) for it in scene.arms]
    return _picture(arms, [np.array(it.points) for it in scene.paths if it.points], LARGE)


def _picture(
    arms: Sequence[tuple[Arm, npt.ArrayLike, Sequence[npt.ArrayLike]]],
    paths: Iterable[Floats],
    size: int,
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
    lines += [f'<polyline points="{corners(it)}" fill="none" stroke="{LINES[0]}"/>' for it in ways]
    return _svg(lines, size)


def curves(x: Floats, rows: Floats, name: str, unit: str) -> str:
    """Draw a curve for each joint, a column of rows, over x."""
    low, high = float(rows.min()), float(rows.max())
    span, wide = max(high - low, 1e-9), max(float(x[-1] - x[0]), 1e-9)
    labels = f"{high:.4g}", f"{low:.4g}"
    # A digit of the font of 10 units is at most 6.5 wide.
    left = max(34.0, 4.0 + 6.5 * max(map(len, labels)))
    top, width, height = 18.0, SIZE - 6.0 - left, SIZE - 44.0
    u = left + width * (x - x[0]) / wide
    v = top + height * (high - rows) / span
    lines = [
        f'<path d="M{left} {top}V{top + height}H{left + width}" fill="none" stroke="#999"/>',
        *(
            f'<text x="{x:g}" y="{y:g}" font-size="10" fill="currentColor" text-anchor="{anchor}">'
            f"{words}</text>"
            for x, y, anchor, words in (
                (left - 4, top + 8, "end", labels[0]),
                (left - 4, top + height, "end", labels[1]),
                (left, SIZE - 12, "start", unit),
                (left + width, SIZE - 12, "end", f"{float(x[-1]):.4g} {name}"),
            )
        ),
    ]
    for joint, column in enumerate(v.T):
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(u, column, strict=True))
        color = LINES[joint % len(LINES)]
        lines.append(
            f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.4"/>'
            f'<text x="{left + 20 * joint:g}" y="11" font-size="10" fill="{color}">J{joint + 1}'
            "</text>"
        )
    return _svg(lines)


def _svg(parts: Iterable[str], size: int = SIZE) -> str:
    head = f'<svg viewBox="0 0 {SIZE} {SIZE}" width="{size}" height="{size}" role="img"'
    return (
        f'{head} stroke-linecap="round" xmlns="http://www.w3.org/2000/svg">{"".join(parts)}</svg>'
    )
