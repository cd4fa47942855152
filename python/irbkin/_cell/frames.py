"""Frames of a cell that hang on one another."""

from collections.abc import Mapping

import numpy as np

from irbkin._arguments import close
from irbkin._arrays import Floats
from irbkin._cell.entries import Entry
from irbkin._core import pose
from irbkin.errors import IrbkinError

_TURNS = ("wxyz", "euler_zyx", "euler_zyx_deg")


class Frames:
    """The frames of a file, each in another one or in the world."""

    def __init__(self, entries: Mapping[str, Entry]) -> None:
        self._entries = entries
        self._known: dict[str, Floats] = {}
        for name in entries:
            self._of(name, ())

    def pose_of(self, entry: Entry) -> Floats:
        """The pose of an entry in the world, by its key `pose`; the world's own without it."""
        return self._placed(entry.sub("pose"), ())

    def _of(self, name: str, inner: tuple[str, ...]) -> Floats:
        if name not in self._known:
            self._known[name] = self._placed(self._entries[name], (*inner, name))
        return self._known[name]

    def _placed(self, entry: Entry, inner: tuple[str, ...]) -> Floats:
        """The pose of a table in the world; `inner`: the frames that hang on it."""
        own = _pose(entry)
        if "frame" not in entry.table:
            return own
        name = entry.name("frame")
        if name in inner:
            circle = " in ".join([*inner[inner.index(name) :], name])
            entry.refuse(f"frames form a circle: {circle}", "frame")
        if name not in self._entries:
            entry.refuse(f"there is no frame {name}; {close(name, self._entries)}", "frame")
        return self._of(name, inner) @ own


def _pose(entry: Entry) -> Floats:
    entry.check("xyz", *_TURNS, "frame")
    turns = [key for key in _TURNS if key in entry.table]
    if len(turns) > 1:
        entry.refuse(f"{' and '.join(turns)} are given: give one of them")
    xyz = entry.numbers("xyz", 3) if "xyz" in entry.table else np.zeros(3)
    try:
        if not turns:
            return pose(xyz)
        if turns == ["wxyz"]:
            return pose(xyz, wxyz=entry.numbers("wxyz", 4))
        angles = entry.numbers(turns[0], 3)
        return pose(xyz, euler_zyx=np.radians(angles) if turns == ["euler_zyx_deg"] else angles)
    except IrbkinError as error:
        entry.refuse(error)
