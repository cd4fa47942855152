"""An arm in a window: a mesh for each link, and faint copies for other postures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin import to_xyz_wxyz
from irbkin.scene import Arm
from irbkin.scene._arms import link_frames
from irbkin.scene._look import GHOST, link_color
from irbkin.scene._meshes import joined

if TYPE_CHECKING:
    import numpy.typing as npt
    import viser

MOST_GHOSTS = 16
"""Copies that are kept ready: no more solutions are drawn."""


class DrawnArm:
    """The links of an arm, and of copies of it."""

    def __init__(self, server: viser.ViserServer, name: str, arm: Arm, *, ghosts: bool) -> None:
        self.arm = arm
        self._links: list[tuple[int, Any]] = []
        self._ghosts: list[tuple[int, Any]] = []
        for link in sorted({it.link for it in arm.body}):
            mesh = joined([it for it in arm.body if it.link == link])
            color = tuple(bytes.fromhex(link_color(link)[1:]))
            scene, parts = server.scene, (np.asarray(mesh.vertices), np.asarray(mesh.faces))
            handle = scene.add_mesh_simple(f"/{name}/link_{link}", *parts, color=color)
            self._links.append((link, handle))
            if ghosts and link > 0:
                turns, places = (
                    np.tile([1.0, 0, 0, 0], (MOST_GHOSTS, 1)),
                    np.zeros((MOST_GHOSTS, 3)),
                )
                copies = scene.add_batched_meshes_simple(
                    f"/{name}/others_{link}", *parts, turns, places,
                    batched_scales=np.zeros(MOST_GHOSTS), batched_colors=GHOST, opacity=0.18,
                    cast_shadow=False, receive_shadow=False,
                )  # fmt: skip
                self._ghosts.append((link, copies))

    def show(self, q: npt.ArrayLike) -> None:
        """Move the links to joint angles [rad]."""
        xyz, wxyz = to_xyz_wxyz(self._frames(q))
        for link, handle in self._links:
            handle.position, handle.wxyz = xyz[link], wxyz[link]

    def show_ghosts(self, postures: Sequence[npt.ArrayLike]) -> None:
        """Move the copies to other joint angles [rad]; those that are left over vanish."""
        shown = list(postures)[:MOST_GHOSTS]
        scales = np.zeros(MOST_GHOSTS)
        scales[: len(shown)] = 1.0
        frames = np.tile(np.eye(4), (MOST_GHOSTS, len(self.arm.joints) + 2, 1, 1))
        for index, q in enumerate(shown):
            frames[index] = self._frames(q)
        xyz, wxyz = to_xyz_wxyz(frames)
        for link, copies in self._ghosts:
            copies.batched_positions, copies.batched_wxyzs = xyz[:, link], wxyz[:, link]
            copies.batched_scales = scales

    def _frames(self, q: npt.ArrayLike) -> Any:
        """The frames of the base, the links, and of what the flange carries."""
        frames = link_frames(self.arm, q)
        frames[-1] = frames[-2]
        return frames
