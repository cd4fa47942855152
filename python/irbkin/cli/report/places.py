"""Where the targets of moves are: top view and side view."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from irbkin.cli.codes import LEVELS
from irbkin.cli.report.pictures import WIDTH, svg, text

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.cli.findings import Found
    from irbkin.rapid import Argument, Module

STYLES = (*LEVELS[:2], "fine")
GAP = 24
"""Height of the line of words below a view."""
FARTHEST = 1e5
"""Distance from the base beyond which a target is no place [mm]: 9E9 of a record not taught."""
Dots = Sequence[tuple[float, float, str]]


class Places(NamedTuple):
    """Positions in the base frame [mm] with the worst severity of their moves."""

    points: Sequence[tuple[float, float, float, str]]
    reach: float | None


def places_of(robot: Robot, modules: Mapping[str, Module], found: Iterable[Found]) -> Places:
    """Return the robtargets of moves in modules, by files, whose values are known."""
    import numpy as np

    import irbkin
    from irbkin.rapid import RobTarget

    worst: dict[tuple[str, int, int], str] = {}
    for it in sorted(found, key=lambda it: -LEVELS.index(it.severity)):
        worst[it.file, it.line, it.column] = it.severity
    points = []
    base = np.linalg.inv(robot.base)
    for file, module in modules.items():
        for move in module.moves:
            target = move.target.value
            if not isinstance(target, RobTarget) or move.displaced is not None:
                continue
            frame = _frame(move.wobj)
            if frame is None or not max(map(abs, target.trans_mm)) < FARTHEST:
                continue
            xyz = frame[:3, :3] @ target.trans_mm + 1e3 * frame[:3, 3]
            x, y, z = base[:3, :3] @ xyz + 1e3 * base[:3, 3]
            severity = worst.get((file, move.line, move.column), "fine")
            points.append((x, y, z, severity if severity in STYLES else "fine"))
    reach = irbkin.catalog_entry(robot.name).reach if robot.name in irbkin.catalog() else None
    return Places(points, reach and reach * 1e3)


def _frame(argument: Argument | None) -> Floats | None:
    """The frame of a work object; None if it is unknown, invalid or moved."""
    import numpy as np

    from irbkin import InvalidPoseError

    if argument is None:
        return np.eye(4)
    wobj = argument.value
    if wobj is None or wobj.robhold or wobj.ufmec:
        return None
    try:
        frame: Floats = wobj.uframe.matrix() @ wobj.oframe.matrix()
    except InvalidPoseError:
        return None
    return frame


def views(places: Places) -> str:
    """Draw the top view, with the reach of the arm, and the side view around axis 1."""
    if not places.points:
        return ""
    reach = places.reach or 0.0
    top = [(x, y, style) for x, y, _, style in places.points]
    side = [(math.hypot(x, y), z, style) for x, y, z, style in places.points]
    left = min(-reach, *(x for x, *_ in top))
    right = max(reach, *(x for x, *_ in side))
    scale = (WIDTH - 16) / max(right - left, 1.0)
    circle = f"; circle: reach of {reach:.0f} mm" if reach else ""
    drawn, height = _view(top, reach, left, scale, 0.0, f"from above, x to the right{circle}")
    words = "from the side, distance from axis 1 to the right"
    below, height = _view(side, 0.0, left, scale, height, words)
    return svg([*drawn, *below], height)


def _view(
    dots: Dots, reach: float, left: float, scale: float, begin: float, words: str
) -> tuple[list[str], float]:
    """Draw points and words from a height on; return the parts and the height behind them."""
    low = min(-reach, *(y for _, y, _ in dots))
    high = max(reach, *(y for _, y, _ in dots))
    origin = (8 - scale * left, begin + 8 + scale * high)
    drawn = [_circle(*origin, scale * reach, "axis")] if reach else []
    drawn += [_base(*origin), *_dots(dots, origin, scale)]
    end = begin + scale * (high - low) + 16
    return [*drawn, text(0, end + 12, words, "dim")], end + GAP


def _dots(points: Dots, origin: tuple[float, float], scale: float) -> list[str]:
    """Draw points, those with errors last; many at one place are one."""
    places = {
        (STYLES.index(style), round(origin[0] + scale * x), round(origin[1] - scale * y))
        for x, y, style in points
    }
    return [_circle(x, y, 3, STYLES[style]) for style, x, y in sorted(places, reverse=True)]


def _circle(x: float, y: float, radius: float, style: str) -> str:
    return f'<circle class="{style}" cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}"/>'


def _base(x: float, y: float) -> str:
    return f'<path class="axis" d="M{x - 6:.1f} {y:.1f}h12M{x:.1f} {y - 6:.1f}v12"/>'
