"""A scene as a file of rerun (.rrd): `pip install 'irbkin[rerun]'`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin._files import write_by_name
from irbkin.scene._arms import link_frames, solids, start
from irbkin.scene._look import GHOST, OBSTACLE, PATH, SEVERITIES, link_color, value_colors
from irbkin.scene._svg import LINES

try:
    import rerun as rr

    from irbkin.scene._meshes import joined, obstacle
except ImportError as missing:
    raise ImportError(
        "a file of rerun needs rerun-sdk and trimesh: pip install 'irbkin[rerun]'", name="rerun"
    ) from missing

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin.scene._data import Arm, Mark, Motion, Scene

TIMELINE = "time"
LEVELS = {"error": "ERROR", "warning": "WARN", "note": "INFO"}
FAINT = 60
"""Opacity of other postures, of 255."""
AXES = 0.15
"""Length of the axes of a frame [m]."""
LINE, POINT, MARK = 0.002, 0.01, 0.02
"""Radii of paths, of points of clouds, of marks [m]."""


def write(scene: Scene, path: str) -> None:
    """Write a scene to a file of rerun: entities as in `docs/guide/view.md`, times in seconds.

    Raises:
        OSError: The file cannot be written.
    """
    write_by_name(path, lambda own: _write(scene, own))


def _write(scene: Scene, path: str) -> None:
    recording = rr.RecordingStream("irbkin")
    recording.save(path)
    recording.send_recording_name(scene.title or "irbkin")
    recording.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for index, arm in enumerate(scene.arms):
        _log_arm(recording, f"arm_{index}", arm)
    _log_surroundings(recording, scene)
    _log_marks(recording, scene.marks)
    recording.disconnect()


def _log_arm(recording: rr.RecordingStream, name: str, arm: Arm) -> None:
    """The links and the tool, over time if the arm moves; other postures as faint copies."""
    first = start(arm)
    motion = arm.motion if arm.motion and arm.motion.q else None
    t, q = (motion.t, motion.q) if motion else ((0.0,), (first,))
    frames = np.array([link_frames(arm, it) for it in q])
    others = [it.q for it in arm.postures if motion or it.q != first]
    copies = np.array([link_frames(arm, it) for it in others])
    parts = solids(arm)
    for link in sorted({it.link for it in parts}):
        # The flange carries what is behind the last link.
        row, color = min(link, len(arm.joints)), bytes.fromhex(link_color(link)[1:])
        shapes = joined([it for it in parts if it.link == link])
        recording.log(f"{name}/link_{link}", _mesh(shapes, color), static=True)
        _log_frames(recording, f"{name}/link_{link}", t, frames[:, row])
        if others and link > 0:
            path = f"{name}/others/link_{link}"
            poses = rr.InstancePoses3D(
                translations=copies[:, row, :3, 3], mat3x3=copies[:, row, :3, :3]
            )
            recording.log(path, _mesh(shapes, (*GHOST, FAINT)), poses, static=True)
    recording.log(f"{name}/tool", rr.TransformAxes3D(AXES), static=True)
    _log_frames(recording, f"{name}/tool", t, frames[:, -1])
    if motion:
        _log_joints(recording, name, motion)


def _log_frames(
    recording: rr.RecordingStream, path: str, t: Iterable[float], frames: npt.NDArray[np.float64]
) -> None:
    columns = rr.Transform3D.columns(translation=frames[:, :3, 3], mat3x3=frames[:, :3, :3])
    rr.send_columns(path, [rr.TimeColumn(TIMELINE, duration=t)], columns, recording=recording)


def _log_joints(recording: rr.RecordingStream, name: str, motion: Motion) -> None:
    """Curves of the joint angles [rad], and the line of the program where it changes."""
    q = np.array(motion.q)
    names = [f"J{joint + 1} [rad]" for joint in range(q.shape[1])]
    colors = [list(bytes.fromhex(LINES[it % len(LINES)][1:])) for it in range(q.shape[1])]
    recording.log(f"{name}/joints", rr.SeriesLines(names=names, colors=colors), static=True)
    curves = rr.Scalars.columns(scalars=q.ravel()).partition([q.shape[1]] * len(q))
    times = rr.TimeColumn(TIMELINE, duration=motion.t)
    rr.send_columns(f"{name}/joints", [times], curves, recording=recording)
    if motion.lines and motion.source:
        source = motion.source.split("\n")
        for index in np.flatnonzero(np.diff(motion.lines, prepend=0)):
            line = motion.lines[index]
            recording.set_time(TIMELINE, duration=motion.t[index])
            recording.log(f"{name}/program", rr.TextLog(f"{line}  {source[line - 1].strip()}"))


def _log_surroundings(recording: rr.RecordingStream, scene: Scene) -> None:
    """All that stands still. A number before a name tells two of the same apart."""

    def log(kind: str, index: int, name: str, *parts: Any) -> None:
        recording.log([kind, f"{index}_{name}"], *parts, static=True)

    for index, thing in enumerate(scene.obstacles):
        log("obstacles", index, thing.name, _mesh(obstacle(thing.shape), OBSTACLE))
    for index, frame in enumerate(scene.frames):
        pose = np.array(frame.pose)
        placed = rr.Transform3D(translation=pose[:3, 3], mat3x3=pose[:3, :3])
        log("frames", index, frame.name, placed, rr.TransformAxes3D(AXES))
    for index, path in enumerate(scene.paths):
        line = rr.LineStrips3D([path.points], colors=[PATH], radii=[LINE])
        log("paths", index, path.name, line)
    for index, cloud in enumerate(it for it in scene.clouds if it.points):
        points = rr.Points3D(cloud.points, colors=value_colors(cloud.values), radii=[POINT])
        log("clouds", index, cloud.name, points)


def _log_marks(recording: rr.RecordingStream, marks: Iterable[Mark]) -> None:
    """A point that shows its text when it is pointed at, and a line of the log at its time."""
    for index, mark in enumerate(marks):
        color = SEVERITIES.get(mark.severity, PATH)
        point = rr.Points3D(
            [mark.point], colors=[color], radii=[MARK], labels=[mark.text], show_labels=False
        )
        recording.log(f"marks/{index}", point, static=True)
        recording.set_time(TIMELINE, duration=mark.t or 0.0)
        words = f"{mark.place} {mark.text}".strip()
        recording.log("findings", rr.TextLog(words, level=LEVELS.get(mark.severity, "INFO")))


def _mesh(mesh: Any, color: Any) -> rr.Mesh3D:
    return rr.Mesh3D(
        vertex_positions=np.asarray(mesh.vertices),
        triangle_indices=np.asarray(mesh.faces),
        vertex_normals=np.asarray(mesh.vertex_normals),
        albedo_factor=list(color),
    )
