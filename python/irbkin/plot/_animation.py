"""A motion as moving picture: GIF, and HTML that needs nothing else."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rc_context
from matplotlib.animation import FuncAnimation, PillowWriter

from irbkin._arguments import check_robot
from irbkin._arrays import evenly
from irbkin._files import replaced, write_by_name
from irbkin.errors import InvalidMotionError
from irbkin.plot._bodies import ARROW, corners, draw_body, draw_frame, extent
from irbkin.plot._picture import Picture
from irbkin.plot._style import BLUE, FONT, title
from irbkin.scene import of
from irbkin.scene._look import on_paper

if TYPE_CHECKING:
    from irbkin import Plan, Robot
    from irbkin._arrays import Floats
    from irbkin.rapid import RoutineMotion
    from irbkin.records import FollowResult
    from irbkin.trajectory import Trajectory

MOST_FRAMES = 2000
MOST_MEGABYTES = 1000
SEEN = 60
"""Postures that the extent of the picture is made of."""


class Movie:
    """A motion, drawn frame by frame when it is saved or shown."""

    def __init__(self, figure: Picture, draw: Callable[[int], list[Any]], count: int, fps: float):
        self.figure = figure
        self.count, self.fps = count, fps
        self._draw = draw

    @property
    def _whole_fps(self) -> int:
        return max(round(self.fps), 1)

    def _animation(self) -> FuncAnimation:
        each = 1e3 / self.fps
        return FuncAnimation(self.figure, self._draw, frames=self.count, interval=each, blit=False)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the motion to a file: .gif or .html.

        Raises:
            ValueError: Another ending.
        """
        ending = os.path.splitext(path)[1].lower()
        if ending == ".gif":
            writer = PillowWriter(fps=self._whole_fps)
            write_by_name(path, lambda own: self._animation().save(own, writer=writer))
        elif ending in (".html", ".htm"):
            with replaced(path) as file:
                file.write(self.to_html().encode())
        else:
            raise ValueError(f"{os.fspath(path)}: must end in .gif or .html")

    def to_html(self) -> str:
        """Return the motion as HTML with its frames and buttons, which needs no other file."""
        # matplotlib leaves frames out beyond its own limit.
        with rc_context({"animation.embed_limit": MOST_MEGABYTES}):
            text: str = self._animation().to_jshtml(fps=self._whole_fps, embed_frames=True)
        return text

    def _repr_html_(self) -> str:
        return self.to_html()

    def __repr__(self) -> str:
        """Return the number of frames and the duration."""
        return f"<Movie: {self.count} frames, {self.count / self.fps:.1f} s>"


def motion(
    motion: Trajectory | Plan | FollowResult | RoutineMotion,
    robot: Robot,
    *,
    fps: float = 20.0,
    speed: float = 1.0,
) -> Movie:
    """Draw a motion of an arm as its body, with the way of its tool.

    Args:
        motion: A Trajectory or a RoutineMotion; a Plan or a FollowResult, whose poses follow each
            other by 0.02 s.
        robot: The arm.
        fps: Pictures in a second.
        speed: How many times faster than it is the motion is shown.

    Returns:
        Movie: `save("motion.gif")` or `save("motion.html")` writes it, a notebook shows it.

    Raises:
        InvalidMotionError: `fps` or `speed` is not positive, or the motion has more than 2000
            pictures.
        TypeError: As `irbkin.scene.of`.
    """
    check_robot(robot)
    for name, value in (("fps", fps), ("speed", speed)):
        if not 0.0 < value < np.inf:
            raise InvalidMotionError(f"{name} is {value}, it must be positive and finite")
    scene = of(motion, robot)
    own = scene.arms[0]
    if own.motion is None or not own.motion.q:
        raise InvalidMotionError("the motion has no joint angles")
    t, rows = np.array(own.motion.t), np.array(own.motion.q)
    count = math.ceil(t[-1] / speed * fps - 1e-9) + 1
    if count > MOST_FRAMES:
        raise InvalidMotionError(
            f"the motion of {t[-1]:.1f} s has {count} pictures, at most {MOST_FRAMES} are drawn: "
            "raise speed or lower fps"
        )
    times = np.minimum(np.arange(count) * speed / fps, t[-1])
    q = np.column_stack([np.interp(times, t, column) for column in rows.T])
    figure = Picture(figsize=(4.8, 4.8), layout="constrained")
    axes = figure.subplots()
    points = np.concatenate([corners(own, it) for it in rows[evenly(len(rows), SEEN)]])
    extent(axes, points, figure)
    axes.plot(*on_paper(np.array(scene.paths[0].points)).T, color=BLUE, linewidth=1.2, zorder=0.5)
    length = ARROW * float(np.ptp(on_paper(points), axis=0).max())
    title(axes, robot)
    clock = axes.text(0.99, 0.01, "", transform=axes.transAxes, ha="right", fontsize=FONT)
    drawn: list[Any] = []

    def draw(index: int) -> list[Any]:
        while drawn:
            drawn.pop().remove()
        drawn.extend(draw_body(axes, own, q[index]))
        pose: Floats = robot.fk(q[index])
        drawn.extend(draw_frame(axes, pose, length))
        clock.set_text(f"{times[index]:.2f} s")
        return drawn

    return Movie(figure, draw, count, fps)
