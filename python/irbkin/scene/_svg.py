"""Small pictures of arms and curves, as SVG without any other package."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from irbkin.scene._arms import capsules_at, link_frames, start
from irbkin.scene._look import link_color, nearness, on_paper

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin._arrays import Floats
    from irbkin.scene._data import Arm, Scene

SIZE = 200
"""Width and height of a picture, in its own units."""
LARGE = 800
"""Width and height of a picture that is a file [px]."""
GHOST = "#98a2b3"
LINES = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#777777")
MOST_GHOSTS = 7


def drawn(arm: Arm, q: npt.ArrayLike, ghosts: Iterable[npt.ArrayLike] = ()) -> str:
    """Draw an arm's capsules as thick lines, far ones first, and other postures as faint chains."""
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
    own = [it for arm, q, _ in arms for it in _capsules(arm, q)]
    others = [
        on_paper(link_frames(arm, it)[:, :3, 3])
        for arm, _, ghosts in arms
        for it in ghosts[:MOST_GHOSTS]
    ]
    ways = [on_paper(it) for it in paths]
    points = np.vstack([*(ends for ends, *_ in own), *others, *ways])
    low, high = points.min(axis=0), points.max(axis=0)
    room = max(radius for _, radius, *_ in own)
    scale = SIZE / (float((high - low).max()) + 2.2 * room)
    middle = 0.5 * (low + high)
    lines = []
    for other in others:
        places = SIZE / 2 + scale * (other - middle) * [1, -1]
        path = " ".join(f"{x:.0f},{y:.0f}" for x, y in places)
        look = f'stroke="{GHOST}" stroke-width="5" opacity=".35"'
        lines.append(f'<polyline points="{path}" fill="none" {look}/>')
    for ends, radius, link, _ in sorted(own, key=lambda it: it[-1]):
        lines.append(_line(ends, radius, link_color(link), scale, middle, ""))
        lines.append(_line(ends, 0.45 * radius, "#fff", scale, middle, ' opacity=".25"'))
    for way in ways:
        places = SIZE / 2 + scale * (way - middle) * [1, -1]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        lines.append(f'<polyline points="{path}" fill="none" stroke="{LINES[0]}"/>')
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


def _capsules(arm: Arm, q: npt.ArrayLike) -> list[tuple[Floats, float, int, float]]:
    """Both ends of each capsule on the paper, shape (2, 2); its radius, link and nearness."""
    found = [(ends, it.radius, it.link) for it, ends in capsules_at(arm, q)]
    if not found:
        places = link_frames(arm, q)[:, :3, 3]
        found = [(places[i : i + 2], 0.03, i) for i in range(len(places) - 1)]
    return [
        (on_paper(ends), size, link, float(nearness(ends).mean())) for ends, size, link in found
    ]


def _line(ends: Floats, radius: float, color: str, scale: float, middle: Floats, more: str) -> str:
    (x, y), (u, v) = SIZE / 2 + scale * (ends - middle) * [1, -1]
    # A line without a length has no round ends in all browsers.
    path = f"M{x:.1f} {y:.1f}L{u + 0.1:.1f} {v:.1f}"
    return f'<path d="{path}" stroke="{color}" stroke-width="{2 * scale * radius:.1f}"{more}/>'


def _svg(parts: Iterable[str], size: int = SIZE) -> str:
    head = f'<svg viewBox="0 0 {SIZE} {SIZE}" width="{size}" height="{size}" role="img"'
    return (
        f'{head} stroke-linecap="round" xmlns="http://www.w3.org/2000/svg">{"".join(parts)}</svg>'
    )
