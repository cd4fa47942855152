"""The arm of a scene as a robot, and what answers pages: for faces that Python and a page move
together.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._core import PageEngine, Robot, catalog
from irbkin.errors import InvalidJointsError, InvalidModelError
from irbkin.scene._arms import link_frames, start
from irbkin.scene._data import Scene

MOST_ENGINES = 32
"""Engines that are kept: a page has one, and another one for its program."""


class Engines:
    """Engines of pages, of which those are kept that were asked last."""

    def __init__(self) -> None:
        self._of: Callable[[str], list[PageEngine]] = lru_cache(MOST_ENGINES)(lambda _: [])

    def answer(self, text: str, page: str) -> str:
        """Return the answer to a page; that all is lost if its engine is new."""
        own = self._of(page)
        if own:
            return own[0].answer(text)
        own.append(PageEngine())
        return '{"lost": true}'


class Joints:
    def __init__(self, scene: Scene) -> None:
        self.arm = scene.arms[0] if scene.arms else None
        self._robot: Robot | None = None

    def start(self) -> list[float]:
        """Joint angles at which the arm is drawn first [rad]; none without an arm."""
        return [] if self.arm is None else list(start(self.arm))

    def checked(self, value: npt.ArrayLike) -> list[float]:
        """Return joint angles [rad] as a list; an InvalidJointsError if they are not the arm's."""
        dof = 0 if self.arm is None else len(self.arm.joints)
        try:
            q = np.asarray(value, dtype=float)
        except (OverflowError, TypeError, ValueError):
            q = np.full(dof, np.nan)
        if q.shape != (dof,) or not np.isfinite(q).all():
            raise InvalidJointsError(
                f"q must be {dof} finite joint angles [rad], one for each joint of the first arm, "
                f"got {value!r:.200}"
            )
        joints: list[float] = q.tolist()
        return joints

    def tool(self, q: npt.ArrayLike) -> Floats:
        """Return the pose of the tool, shape (4, 4); the world's without an arm."""
        return np.array(np.eye(4) if self.arm is None else link_frames(self.arm, q)[-1])

    def nearest(self, T: npt.ArrayLike, q: npt.ArrayLike) -> list[float]:
        """The joint angles of a pose of the tool that are nearest to others [rad]."""
        if self._robot is None:
            self._robot = self._made()
        joints: list[float] = self._robot.ik_nearest(T, q).tolist()
        return joints

    def _made(self) -> Robot:
        arm = self.arm
        if arm is None or not (arm.urdf or arm.name in catalog()):
            name = "the scene has no arm" if arm is None else f"{arm.name} is not in the catalog"
            raise InvalidModelError(f"{name}: T cannot be set, q can")
        # As bytes a text of others names no file.
        urdf = arm.urdf.encode(errors="surrogatepass")
        bare: Any = Robot.from_urdf(urdf) if urdf else Robot(arm.name)
        # The scene has the tool behind the last joint, a robot behind the flange.
        flange = bare.with_base(np.eye(4)).fk(np.zeros(bare.dof))
        tool = np.linalg.solve(np.array(arm.base) @ flange, self.tool(np.zeros(bare.dof)))
        robot: Robot = bare.with_base(arm.base).with_tool(tool)
        return robot
