"""A window with a scene: a handle at the tool, sliders, all solutions, a motion that plays."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np
import viser

from irbkin import Robot, pose, to_xyz_wxyz
from irbkin.errors import InvalidJointsError
from irbkin.scene import Scene, of
from irbkin.scene._arms import start
from irbkin.scene._look import OBSTACLE, PATH, SEVERITIES, value_colors
from irbkin.scene._meshes import obstacle
from irbkin.viewer._drawn import DrawnArm

if TYPE_CHECKING:
    import numpy.typing as npt

TICK = 1 / 30
"""Time between two pictures of a motion [s]."""


class Viewer:
    """A scene in a window of the browser, at `viewer.url`.

    With a robot, a handle moves the tool: the joints follow, every solution inside the limits is
    drawn faintly. `viewer.q` are the joints; setting them moves the arm.

    Args:
        thing: A Robot, or what `irbkin.scene.of` takes.
        robot: The arm of anything but a Robot.
        host: Address to listen at; "0.0.0.0" for other machines, too.
        port: Port; another free one if it is taken.

    Raises:
        TypeError: As `irbkin.scene.of`.
    """

    def __init__(
        self,
        thing: Any,
        robot: Robot | None = None,
        *,
        host: str = "127.0.0.1",
        port: int = 8080,
    ) -> None:
        self.robot = thing if isinstance(thing, Robot) else robot
        self.scene = thing if isinstance(thing, Scene) else of(thing, robot)
        self.server = viser.ViserServer(host=host, port=port, verbose=False)
        self.server.scene.set_up_direction("+z")
        self.server.scene.add_grid("/floor", width=6.0, height=6.0, cell_size=0.5)
        self._is_moving = False
        self.is_playing = False
        self._add_surroundings()
        self._arms = [
            DrawnArm(self.server, f"arm_{index}", arm, ghosts=index == 0 and self.robot is not None)
            for index, arm in enumerate(self.scene.arms)
        ]
        starts = [start(it) for it in self.scene.arms]
        for drawn, q in zip(self._arms, starts, strict=True):
            drawn.show(q)
        self._q = np.zeros(0)
        if self._arms:
            self._add_controls()
            self.q = starts[0]

    @property
    def url(self) -> str:
        """The address of the window."""
        return f"http://{self.server.get_host()}:{self.server.get_port()}"

    @property
    def q(self) -> npt.NDArray[np.float64]:
        """Joint angles of the first arm [rad]."""
        return self._q.copy()

    @q.setter
    def q(self, q: npt.ArrayLike) -> None:
        angles = np.array(q, dtype=float)
        if angles.shape != (len(self.scene.arms[0].joints),) or not np.isfinite(angles).all():
            raise InvalidJointsError(f"q must have {len(self.scene.arms[0].joints)} finite angles")
        self._q = angles
        self._arms[0].show(self._q)
        if self.robot is None:
            return
        T = self.robot.fk(self._q)
        if not self._is_moving:
            self._is_moving = True
            self._handle.position, self._handle.wxyz = (it[0] for it in to_xyz_wxyz(T[None]))
            self._is_moving = False
        self._update(T)

    def move(self, T: npt.ArrayLike) -> str:
        """Move the tool to a pose, as the handle does: the joints follow if they can.

        Args:
            T: Pose, shape (4, 4).

        Returns:
            What the window says: how many solutions there are, or why there is none.
        """
        assert self.robot is not None, "a scene without a robot has no handle"
        try:
            self._q = self.robot.ik_nearest(T, self._q)
            self._arms[0].show(self._q)
        except ValueError as error:
            self._words.content = f"**not reached**: {error}"
            return str(error)
        self._update(np.asarray(T))
        return str(self._words.content)

    def play(self) -> None:
        """Play the motion of the scene once, from where the slider is; return when it ends."""
        duration = self.scene.duration
        if self.is_playing or duration <= 0.0:
            return
        begun = time.perf_counter() - float(self._slider.value) % duration
        self.is_playing = True
        while self.is_playing:
            t = time.perf_counter() - begun
            self.at(min(t, duration))
            if t >= duration:
                break
            time.sleep(TICK)
        self.is_playing = False

    def at(self, t: float) -> None:
        """Show the motion of the scene at a time [s]."""
        for index, arm in enumerate(self.scene.arms):
            motion = arm.motion
            if motion is None:
                continue
            q = [np.interp(t, motion.t, column) for column in zip(*motion.q, strict=True)]
            if index == 0:
                self.q = q
            else:
                self._arms[index].show(q)
            if motion.lines and motion.source:
                line = motion.lines[int(np.searchsorted(motion.t, t).clip(0, len(motion.t) - 1))]
                text = motion.source.split("\n")[line - 1].strip()
                self._line.content = f"`{line}  {text}`"
        self._slider.value = t

    def close(self) -> None:
        """Close the window."""
        self.is_playing = False
        self.server.stop()

    def _update(self, T: npt.NDArray[np.float64]) -> None:
        """The words and the copies of the other solutions at a pose."""
        assert self.robot is not None
        q7 = None if self.robot.dof == 6 else float(self._q[6])
        solutions = self.robot.ik(T, q7=q7)
        inside = [it.q for it in solutions if it.is_within_limits]
        others = [it for it in inside if np.abs(np.sin((it - self._q) / 2)).max() > 1e-4]
        self._arms[0].show_ghosts(others)
        margin = self.robot.margin(self._q)
        self._words.content = f"{solutions.explain()}, margin {float(margin.limits):.2f}"

    def _add_controls(self) -> None:
        gui = self.server.gui
        self._words = gui.add_markdown("")
        self._line = gui.add_markdown("")
        self._slider = gui.add_slider(
            "time [s]", 0.0, max(self.scene.duration, 1e-3), 1e-3, 0.0,
            visible=self.scene.duration > 0,
        )  # fmt: skip
        self._slider.on_update(self._slide)
        button = gui.add_button("play", visible=self.scene.duration > 0)
        button.on_click(lambda _: self.play())
        if self.robot is None:
            return
        self._handle = self.server.scene.add_transform_controls("/handle", scale=0.35)
        self._handle.on_update(lambda _: self._drag())

    def _slide(self, event: Any) -> None:
        # `at` sets the slider itself.
        if event.client is not None:
            self.at(float(self._slider.value))

    def _drag(self) -> None:
        if not self._is_moving:
            self.move(pose(self._handle.position, wxyz=self._handle.wxyz))

    def _add_surroundings(self) -> None:
        scene = self.server.scene
        for it in self.scene.obstacles:
            mesh = obstacle(it.shape)
            parts = (np.asarray(mesh.vertices), np.asarray(mesh.faces))
            scene.add_mesh_simple(f"/obstacles/{it.name}", *parts, color=OBSTACLE)
        for frame in self.scene.frames:
            (xyz,), (wxyz,) = to_xyz_wxyz(np.array(frame.pose)[None])
            scene.add_frame(
                f"/frames/{frame.name}",
                axes_length=0.15,
                axes_radius=0.005,
                position=xyz,
                wxyz=wxyz,
            )
        for index, path in enumerate(self.scene.paths):
            points = np.array(path.points)
            if len(points) > 1:
                pairs = np.stack([points[:-1], points[1:]], axis=1)
                scene.add_line_segments(f"/paths/{index}_{path.name}", pairs, PATH, thickness=0.004)
        for cloud in (it for it in self.scene.clouds if it.points):
            colors = value_colors(cloud.values)
            scene.add_point_cloud(
                f"/clouds/{cloud.name}", np.array(cloud.points), colors, point_size=0.02
            )
        for index, mark in enumerate(self.scene.marks):
            color = SEVERITIES.get(mark.severity, PATH)
            scene.add_icosphere(f"/marks/{index}", 0.02, color, position=np.array(mark.point))
            scene.add_label(
                f"/marks/{index}/text", mark.text[:80], visible=mark.severity == "error"
            )
