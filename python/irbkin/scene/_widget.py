"""The page in a notebook, with anywidget: `pip install 'irbkin[widget]'`."""

from __future__ import annotations

from typing import Any

from irbkin._arrays import Floats
from irbkin.scene._page import module
from irbkin.scene._solved import Engines, Joints

try:
    import anywidget
    import traitlets
except ImportError as missing:
    raise ImportError(
        "a view in a notebook needs anywidget: pip install 'irbkin[widget]'", name="anywidget"
    ) from missing
import numpy.typing as npt

from irbkin.scene._data import Scene


class _Joints(traitlets.List):  # type: ignore[misc]
    """Joint angles [rad] of the arm of a view: a list, given as any sequence or array."""

    def validate(self, obj: View, value: npt.ArrayLike) -> list[float]:
        """Return the angles as a list; raise a TraitError if they are not those of the arm."""
        try:
            joints: list[float] = super().validate(obj, obj._joints.checked(value))
        except ValueError as error:
            raise traitlets.TraitError(str(error)) from None
        return joints


class View(anywidget.AnyWidget):  # type: ignore[misc]
    """A scene in a notebook. Its first arm is moved by the handle and by Python.

    `view.q` are its joint angles [rad], a list, set from any array: it moves the arm. Dragging the
    handle sets them; `view.observe(f, "q")` calls f then. `view.T` is the pose of its tool, which
    can be set, too. The kernel solves, unless irbkin was built with the engine of pages.
    """

    scene = traitlets.Unicode("").tag(sync=True)
    height = traitlets.Int(560).tag(sync=True)
    q = _Joints(traitlets.Float()).tag(sync=True)

    def __init__(self, scene: Scene, height: int = 560) -> None:
        self._joints = Joints(scene)
        self._engines = Engines()
        q = self._joints.start()
        super().__init__(_esm=module(), scene=scene.to_json(), height=height, q=q)
        self.on_msg(self._answer)

    def _answer(self, _: Any, asked: dict[str, str], __: Any) -> None:
        answer = self._engines.answer(asked["text"], asked["page"])
        self.send({"id": asked["id"], "answer": answer})

    @property
    def T(self) -> Floats:
        """The pose of the tool of the first arm, shape (4, 4)."""
        return self._joints.tool(self.q)

    @T.setter
    def T(self, T: npt.ArrayLike) -> None:
        self.q = self._joints.nearest(T, self.q)
