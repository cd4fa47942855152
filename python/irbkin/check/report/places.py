"""Where the targets of moves are: top view and side view."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from irbkin._files import shown
from irbkin.check.codes import LEVELS
from irbkin.check.report import Report
from irbkin.check.report.pictures import WIDTH, svg, text

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.rapid import Argument

STYLES = (*LEVELS[:2], "fine")
GAP = 24
"""Height of the line of words below a view."""
FARTHEST = 1e5
"""Largest distance from the base of a target in a view [mm]: an untaught record has 9E9."""


def points_of(report: Report, robot: Robot) -> list[tuple[float, float, float, str]]:
    """Return the robtargets of moves whose values are known: positions in the base frame [mm] with
    the worst severity of their moves.
    """
    import numpy as np

    from irbkin.rapid import RobTarget

    worst: dict[tuple[str, int, int], str] = {}
    for found in sorted(report.findings, key=lambda found: -LEVELS.index(found.severity)):
        worst[found.file, found.line, found.column] = found.severity
    points = []
    base = np.linalg.inv(robot.base)
    program = report.programs[0][0].program
    for file, module in zip(program.files, program.modules, strict=True):
        for move in module.moves:
            target = move.target.value
            if not isinstance(target, RobTarget) or move.displaced is not None:
                continue
            frame = _frame(move.wobj)
            if frame is None or not max(map(abs, target.trans_mm)) < FARTHEST:
                continue
            xyz = frame[:3, :3] @ target.trans_mm + 1e3 * frame[:3, 3]
            x, y, z = base[:3, :3] @ xyz + 1e3 * base[:3, 3]
            severity = worst.get((shown(file.path), move.line, move.column), "fine")
            points.append((x, y, z, severity if severity in STYLES else "fine"))
    return points


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


def views(report: Report) -> str:
    """Draw the targets of one program: the top view, with the reach of the arm, and the side view
    around axis 1.
    """
    import irbkin

    robots = [job.robot for job, _ in report.programs]
    if len(robots) != 1 or robots[0] is None or not (points := points_of(report, robots[0])):
        return ""
    name = robots[0].name
    known = irbkin.catalog_entry(name).reach if name in irbkin.catalog() else None
    reach = 1e3 * (known or 0.0)
    top = [(x, y, style) for x, y, _, style in points]
    side = [(math.hypot(x, y), z, style) for x, y, z, style in points]
    left = min(-reach, *(x for x, *_ in top))
    right = max(reach, *(x for x, *_ in side))
    scale = (WIDTH - 16) / max(right - left, 1.0)
    circle = f"; circle: reach of {reach:.0f} mm" if reach else ""
    drawn: list[str] = []
    height = 0.0
    for dots, radius, words in (
        (top, reach, f"from above, x to the right{circle}"),
        (side, 0.0, "from the side, distance from axis 1 to the right"),
    ):
        low = min(-radius, *(y for _, y, _ in dots))
        high = max(radius, *(y for _, y, _ in dots))
        x0, y0 = 8 - scale * left, height + 8 + scale * high
        drawn += [_circle(x0, y0, scale * radius, "axis")] if radius else []
        drawn.append(f'<path class="axis" d="M{x0 - 6:.1f} {y0:.1f}h12M{x0:.1f} {y0 - 6:.1f}v12"/>')
        # Targets with errors are drawn last, coincident ones once.
        places = {
            (STYLES.index(style), round(x0 + scale * x), round(y0 - scale * y))
            for x, y, style in dots
        }
        drawn += [_circle(x, y, 3, STYLES[style]) for style, x, y in sorted(places, reverse=True)]
        end = height + scale * (high - low) + 16
        drawn.append(text(0, end + 12, words, "dim"))
        height = end + GAP
    return svg(drawn, height)


def _circle(x: float, y: float, radius: float, style: str) -> str:
    return f'<circle class="{style}" cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}"/>'
