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
    import numpy.typing as npt

    from irbkin.scene._data import Scene


class _Joints(traitlets.List):  # type: ignore[misc]
    """Joint angles [rad] of the arm of a view: a list, given as any sequence or array."""

    def validate(self, obj: View, value: npt.ArrayLike) -> list[float]:
        """Return the angles as a list; raise a TraitError if they are not those of the arm."""
        dof = 0 if obj._arm is None else len(obj._arm.joints)
        try:
            q = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            q = np.full(dof, np.nan)
        if q.shape != (dof,) or not np.isfinite(q).all():
            raise traitlets.TraitError(
                f"q must be {dof} finite joint angles [rad], one for each joint of the first arm, "
                f"got {value!r}"
            )
        joints: list[float] = super().validate(obj, q.tolist())
        return joints


class View(anywidget.AnyWidget):  # type: ignore[misc]
    """A scene in a notebook. Its first arm is moved by the handle and by Python.

    `view.q` are its joint angles [rad], a list, set from any array: it moves the arm. Dragging the
    handle sets them; `view.observe(f, "q")` calls f then. `view.T` is the pose of its tool.
    """

    scene = traitlets.Unicode("").tag(sync=True)
    height = traitlets.Int(560).tag(sync=True)
    q = _Joints(traitlets.Float()).tag(sync=True)

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
