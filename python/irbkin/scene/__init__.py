"""Scenes: everything that can be looked at, as plain data that every face draws.

A scene has arms with their bodies, postures and a motion, frames, paths, clouds of points,
obstacles and marks with texts. `of` makes one of a robot, of solutions, plans, trajectories, RAPID
motions, cells, maps and calibrations; scenes add up. Lengths are in meters, angles in radians,
times in seconds; all is in the world frame.

>>> import irbkin
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> scene = irbkin.scene.of(robot, q=[0, 0.2, 0.1, 0, 0.5, 0])
>>> scene.arms[0].name, len(scene.arms[0].joints)
('IRB 2600-12/1.65', 6)
>>> irbkin.scene.Scene.from_json(scene.to_json()) == scene
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from irbkin.scene._arms import arm_of
from irbkin.scene._data import (
    FACES,
    Arm,
    Cloud,
    Frame,
    LinkHull,
    LinkShape,
    Mark,
    Motion,
    Obstacle,
    Path,
    Posture,
    Scene,
)
from irbkin.scene._makers import of
from irbkin.scene._page import page
from irbkin.scene._served import ServedView, serve
from irbkin.scene._svg import of_scene

if TYPE_CHECKING:
    from irbkin.scene._widget import View as View

__all__ = [
    "Arm",
    "Cloud",
    "Frame",
    "LinkHull",
    "LinkShape",
    "Mark",
    "Motion",
    "Obstacle",
    "Path",
    "Posture",
    "Scene",
    "ServedView",
    "arm_of",
    "of",
    "serve",
]


# A scene is data: it does not know the faces that know it.
FACES.update({".html": page, ".htm": page, ".svg": of_scene})


def __getattr__(name: str) -> Any:
    """Import `View`, which needs an extra, when it is first asked for."""
    if name == "View":
        from irbkin.scene._widget import View

        return View
    raise AttributeError(f"module 'irbkin.scene' has no attribute {name!r}")
