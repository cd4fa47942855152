"""The parts of a map as files, so that a run that was ended goes on where it was."""

from __future__ import annotations

import errno
import hashlib
import pickle
import shutil
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._files import replaced
from irbkin._grids import ReachMap

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

Counts = npt.NDArray[np.int64]
# The numbers of some positions, in the order of FIELDS.
Part = tuple[Counts, Counts, Floats, Floats]
FIELDS: dict[str, type[np.generic]] = {
    "reached": np.int64,
    "solutions": np.int64,
    "margin": np.float64,
    "singularities": np.float64,
}


class Store:
    """The numbers of all positions, and the files that they are kept in."""

    def __init__(self, output: str | PathLike[str] | None, job: Any, count: int) -> None:
        self.fields: dict[str, npt.NDArray[Any]] = {
            name: np.zeros(count, dtype) for name, dtype in FIELDS.items()
        }
        self._is_done = np.zeros(count, dtype=bool)
        self._output = None if output is None else Path(output)
        self._job = hashlib.sha256(pickle.dumps(job, protocol=4)).hexdigest()
        if self._output is None:
            return
        if self._output.suffix != ".npz":
            raise ValueError(f"output must be a file .npz, got {self._output}")
        self._parts = self._output.with_name(self._output.name + ".parts")
        if self._parts.is_symlink():
            raise FileExistsError(f"{self._parts} is a link: remove it or choose another output")
        if not self._output.parent.is_dir():
            raise FileNotFoundError(
                errno.ENOENT, "cannot be written: its folder does not exist", str(self._output)
            )
        if self._output.exists():
            self._take(self._output, 0, count)
            return
        for path in sorted(self._parts.glob("*-*.npz")):
            first, last = map(int, path.stem.split("-"))
            self._take(path, first, last)

    def _take(self, path: Path, first: int, last: int) -> None:
        """Read what is ready.

        Raises:
            FileExistsError: It is of another map.
        """
        stored = _arrays(path)
        if str(stored.get("job")) != self._job:
            raise FileExistsError(
                f"{path} is of another map (robot, cell, positions or orientations differ): "
                f"delete it or choose another output"
            )
        for name, field in self.fields.items():
            field[first:last] = stored[name].reshape(-1)
        self._is_done[first:last] = True

    def missing(self, size: int) -> list[tuple[int, int]]:
        """Ranges of positions that are not ready, of at most a size."""
        edges = np.flatnonzero(np.diff(np.r_[True, self._is_done, True].astype(np.int8)))
        return [
            (first, min(first + size, int(stop)))
            for start, stop in edges.reshape(-1, 2)
            for first in range(int(start), int(stop), size)
        ]

    def add(self, first: int, last: int, part: Part) -> None:
        """Keep the numbers of a range of positions."""
        for field, values in zip(self.fields.values(), part, strict=True):
            field[first:last] = values
        self._is_done[first:last] = True
        if self._output is not None:
            self._parts.mkdir(exist_ok=True)
            path = self._parts / f"{first:012d}-{last:012d}.npz"
            self._write(path, dict(zip(FIELDS, part, strict=True)))

    def finish(self, found: ReachMap) -> None:
        """Write the map, and remove its parts."""
        if self._output is None or self._output.exists():
            return
        self._write(self._output, found._asdict())
        shutil.rmtree(self._parts, ignore_errors=True)

    def _write(self, path: Path, fields: Mapping[str, Any]) -> None:
        with replaced(path) as file:
            np.savez(file, job=np.array(self._job), **fields)


def _arrays(path: Path) -> dict[str, npt.NDArray[Any]]:
    """The arrays of a file.

    Raises:
        ValueError: It has none.
    """
    with path.open("rb") as file:
        try:
            stored = np.load(file)
            return {name: stored[name] for name in stored.files}
        except (AttributeError, ValueError, EOFError, zipfile.BadZipFile) as fault:
            raise ValueError(f"{path} is not a map: {fault}") from fault


def load(path: str | PathLike[str]) -> ReachMap:
    """Read a map that `reach` has written.

    Args:
        path: The file.

    Raises:
        OSError: The file cannot be read.
        ValueError: It is not a map.
    """
    stored = _arrays(Path(path))
    missing = sorted(set(ReachMap._fields) - set(stored))
    if missing:
        raise ValueError(f"{path} is not a map: it has no {missing[0]}")
    return ReachMap(**{name: stored[name] for name in ReachMap._fields})
