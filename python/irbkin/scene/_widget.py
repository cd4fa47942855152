"""The page in a notebook, with anywidget: `pip install 'irbkin[widget]'`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin.scene._arms import link_frames, start
from irbkin.scene._page import module

try:
    import anywidget
    import traitlets
except ImportError as missing:
    raise ImportError(
        "a view in a notebook needs anywidget: pip install 'irbkin[widget]'", name="anywidget"
    ) from missing

if TYPE_CHECKING:
    from irbkin.scene._data import Scene


class View(anywidget.AnyWidget):  # type: ignore[misc]
    """A scene in a notebook. Its first arm is moved by the handle and by Python.

    `view.q` are its joint angles [rad], a list: setting them moves the arm, and dragging the handle
    sets them; `view.observe(f, "q")` calls f then. `view.T` is the pose of its tool.
    """

    scene = traitlets.Unicode("").tag(sync=True)
    height = traitlets.Int(560).tag(sync=True)
    q = traitlets.List(traitlets.Float()).tag(sync=True)

    def __init__(self, scene: Scene, height: int = 560) -> None:
        self._arm = scene.arms[0] if scene.arms else None
        q = [] if self._arm is None else list(start(self._arm))
        super().__init__(_esm=module(), scene=scene.to_json(), height=height, q=q)

    @property
    def T(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        """The pose of the tool of the first arm, shape (4, 4)."""
        if self._arm is None:
            return np.eye(4)
        tool: np.ndarray[Any, np.dtype[np.float64]] = link_frames(self._arm, self.q)[-1]
        return tool
