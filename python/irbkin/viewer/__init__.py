"""Scenes in a window of the browser that Python moves, with viser: `pip install 'irbkin[viewer]'`.

>>> import irbkin  # doctest: +SKIP
>>> viewer = irbkin.viewer.Viewer(irbkin.Robot("IRB 2600-12/1.65"))
>>> viewer.q = [0, 0.2, 0.1, 0, 0.5, 0]
"""

from __future__ import annotations

try:
    import viser as _viser  # noqa: F401
except ImportError as _missing:
    raise ImportError(
        "irbkin.viewer needs viser: pip install 'irbkin[viewer]'", name="viser"
    ) from _missing

from irbkin.viewer._viewer import Viewer

__all__ = ["Viewer"]
