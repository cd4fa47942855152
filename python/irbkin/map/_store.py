"""Maps in files, whole or in slabs: written block by block, so that memory does not grow with them
and a run that was ended goes on where it was.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import pickle
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._files import continued, replaced
from irbkin._grids import ReachMap
from irbkin._words import listed
from irbkin.errors import IrbkinError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from os import PathLike

FIELDS = {"reached": "<i8", "solutions": "<i8", "margin": "<f8", "singularities": "<f8"}
RECORD = np.dtype([*FIELDS.items()])
"""The numbers of a position."""
CHUNK = 1 << 20
"""Bytes that are copied at a time."""
JOB = ("robot", "q7", "cell", "version of irbkin")
"""Inputs of a map beside its grid."""


class Slab(NamedTuple):
    """A part of a map, as its file has it beside the numbers."""

    job: npt.NDArray[Any]
    """Digests of JOB."""
    slab: npt.NDArray[np.int64]
    """Its number from 1, and how many there are."""
    x: Floats
    y: Floats
    z: Floats
    orientations: Floats

    @classmethod
    def of(cls, number: Sequence[int], job: Sequence[Any], grid: Sequence[Floats]) -> Slab:
        """A slab of a map."""
        digests = [hashlib.sha256(pickle.dumps(it, protocol=4)).hexdigest() for it in job]
        return cls(np.array(digests), np.array(number), *grid)

    @classmethod
    def read(cls, path: Path) -> Slab:
        """The slab in a file.

        Raises:
            IrbkinError: It has no slab.
        """
        return cls(**_arrays(path, cls._fields))

    @property
    def name(self) -> str:
        """Its number, as 3/64."""
        return "{}/{}".format(*self.slab)

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of positions of the whole map."""
        return len(self.x), len(self.y), len(self.z)

    @property
    def span(self) -> tuple[int, int]:
        """Its positions, x the slowest, end exclusive."""
        (number, of), count = self.slab.tolist(), int(np.prod(self.shape))
        return count * (number - 1) // of, count * number // of

    def differences(self, other: Slab) -> str:
        """Inputs of another slab that are not its own, if it is of another map."""
        names = [it for it, own, its in zip(JOB, self.job, other.job, strict=True) if own != its]
        grid = ("x", "y", "z", "orientations")
        names += [it for it in grid if not np.array_equal(getattr(self, it), getattr(other, it))]
        return ", ".join([*names, *["number of slabs"] * bool(self.slab[1] != other.slab[1])])

    def is_in(self, path: Path) -> bool:
        """Whether it is in a file already.

        Raises:
            FileExistsError: The file has something else.
        """
        if not path.exists():
            return False
        try:
            found = Slab.read(path)
            what = self.differences(found) or f"slab {found.name}" * (found.name != self.name)
        except IrbkinError as error:
            what = str(error)
        if what:
            raise _another(path, what)
        return True


def _another(path: Path, what: str) -> FileExistsError:
    return FileExistsError(f"{path} is of another map ({what}): delete it or choose another output")


@contextlib.contextmanager
def records(path: Path, slab: Slab) -> Iterator[tuple[BinaryIO, int]]:
    """A file beside `path` that records are appended to, and how many it has; with all, it becomes
    the file. Two processes that write one slab at once write the same.

    Raises:
        FileExistsError: The file beside it is of another map, or a link.
        FileNotFoundError: The folder does not exist.
    """
    beside = path.with_name(f".{path.name}.part")
    if not path.parent.is_dir():
        words = "cannot be written: its folder does not exist"
        raise FileNotFoundError(errno.ENOENT, words, str(path))
    begin = hashlib.sha256(b"".join(it.tobytes() for it in slab)).digest()
    with continued(beside) as file:
        if not begin.startswith(file.read(len(begin))):
            raise _another(beside, "a run of it was ended")
        file.seek(0)
        file.write(begin)
        count = (file.seek(0, os.SEEK_END) - len(begin)) // RECORD.itemsize
        file.seek(len(begin) + count * RECORD.itemsize)
        yield file, count

        def column(name: str) -> Iterator[bytes]:
            file.seek(len(begin))
            while content := file.read(CHUNK):
                yield np.frombuffer(content, RECORD)[name].tobytes()

        _write(path, slab, column)
    beside.unlink(missing_ok=True)


def _write(path: Path, slab: Slab, column: Callable[[str], Iterator[bytes]]) -> None:
    """Write a slab as `numpy.savez` would; the only one is a map."""
    form, (first, last) = np.lib.format, slab.span
    shape = slab.shape if slab.slab[1] == 1 else (last - first,)
    with replaced(path) as file, zipfile.ZipFile(file, "w") as archive:
        for name, array in slab._asdict().items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                form.write_array(entry, array)
        for name, kind in FIELDS.items():
            head = {"descr": kind, "fortran_order": False, "shape": shape}
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                form.write_array_header_1_0(entry, head)
                for content in column(name):
                    entry.write(content)


def merge(parts: Iterable[str | PathLike[str]], output: str | PathLike[str]) -> None:
    """Put the slabs of a map together: byte by byte the file of a map that was made in one piece.
    Memory holds a megabyte of it.

    Args:
        parts: The files of all slabs, which `slab` has written, in any order.
        output: File (.npz) of the map, which `load` reads.

    Raises:
        OSError: A file cannot be read or written.
        IrbkinError: A file is no slab, or of another map than the first one (the message has what
            differs); a slab is missing, or given twice.
    """
    path, files = checked_output(output), dict[int, Path]()
    slab = origin = None
    for part in map(Path, parts):
        own = Slab.read(part)
        slab, origin = slab or own, origin or part
        if what := slab.differences(own):
            raise IrbkinError(f"{part} is of another map than {origin}: other {what}")
        if twin := files.get(number := int(own.slab[0])):
            raise IrbkinError(f"{twin} and {part} are both slab {own.name}: leave one out")
        files[number] = part
    if slab is None:
        raise IrbkinError("parts is empty, it must have the files of all slabs")
    count = int(slab.slab[1])
    if missing := [f"{it}/{count}" for it in range(1, count + 1) if it not in files]:
        raise IrbkinError(f"no file has slab {listed(missing)}")

    def column(name: str) -> Iterator[bytes]:
        for number, part in sorted(files.items()):
            first, last = slab._replace(slab=np.array([number, count])).span
            yield from _column(part, name, last - first)

    _write(path, slab._replace(slab=np.array([1, 1])), column)


def _column(path: Path, name: str, count: int) -> Iterator[bytes]:
    """The bytes of a field of a slab."""
    with _named(path), zipfile.ZipFile(path) as archive, archive.open(f"{name}.npy") as entry:
        np.lib.format.read_magic(entry)
        shape, is_fortran, kind = np.lib.format.read_array_header_1_0(entry)
        if (int(np.prod(shape)), is_fortran, kind.str) != (count, False, FIELDS[name]):
            raise ValueError(f"{name} has {kind} of shape {shape}")
        while content := entry.read(CHUNK):
            yield content


@contextlib.contextmanager
def _named(path: Path) -> Iterator[None]:
    """Name the file that is no map."""
    try:
        yield
    except (AttributeError, TypeError, ValueError, EOFError, zipfile.BadZipFile) as fault:
        raise IrbkinError(f"{path} is not a map: {fault}") from fault


def _arrays(path: Path, names: Sequence[str]) -> dict[str, npt.NDArray[Any]]:
    """Some arrays of a file, all of which it must have."""
    with path.open("rb") as file, _named(path):
        stored = np.load(file)
        if missing := sorted({*names} - {*stored.files}):
            raise ValueError(f"it has no {missing[0]}")
        return {name: stored[name] for name in names}


def checked_output(output: str | PathLike[str]) -> Path:
    """The path of a map.

    Raises:
        IrbkinError: It does not end in .npz.
    """
    if (path := Path(output)).suffix != ".npz":
        raise IrbkinError(f"output must be a file .npz, got {path}")
    return path


def load(path: str | PathLike[str]) -> ReachMap:
    """Read a map that `reach` or `merge` has written.

    Args:
        path: The file.

    Raises:
        OSError: The file cannot be read.
        IrbkinError: It is not a map, or one slab of it.
    """
    fields = _arrays(Path(path), (*ReachMap._fields, "slab"))
    if (of := fields.pop("slab").tolist())[1] != 1:
        raise IrbkinError(f"{path} is slab {of[0]}/{of[1]} of a map: merge them, then load the map")
    return ReachMap(**fields)
