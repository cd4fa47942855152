"""Maps in files: written block by block, so that a run that was ended goes on where it was."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import pickle
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._files import continued, replaced
from irbkin._grids import ReachMap
from irbkin.errors import IrbkinError

FIELDS = {"reached": "<i8", "solutions": "<i8", "margin": "<f8", "singularities": "<f8"}
RECORD = np.dtype([*FIELDS.items()])
"""The numbers of a position."""
INPUTS = ("robot", "q7", "cell", "version of irbkin")
"""Inputs of a map beside its grid."""
GRID = ("x", "y", "z", "orientations")
Job = Mapping[str, npt.NDArray[Any]]
"""The inputs of a map, as its file has them beside the numbers: digests, "job", and GRID."""


def job_of(inputs: Sequence[Any], grid: Sequence[Floats]) -> Job:
    digests = [hashlib.sha256(pickle.dumps(it, protocol=4)).hexdigest() for it in inputs]
    return {"job": np.array(digests), **dict(zip(GRID, grid, strict=True))}


def is_in(path: Path, job: Job) -> bool:
    """Whether the map of a job is in a file already; a FileExistsError if something else is."""
    if not path.exists():
        return False
    try:
        other = _arrays(path, [*job])
    except IrbkinError as error:
        raise _another(path, str(error)) from None
    digests = zip(INPUTS, job["job"], other["job"], strict=True)
    names = [name for name, own, its in digests if own != its]
    names += [name for name in GRID if not np.array_equal(job[name], other[name])]
    if names:
        raise _another(path, ", ".join(names))
    return True


def _another(path: Path, what: str) -> FileExistsError:
    return FileExistsError(f"{path} is of another map ({what}): delete it or choose another output")


@contextlib.contextmanager
def records(path: Path, job: Job) -> Iterator[tuple[BinaryIO, int]]:
    """A file beside `path` that records are appended to, and how many it has; with all, it becomes
    the file. Two processes that write one map at once write the same.

    Raises:
        FileExistsError: The file beside it is of another map, or a link.
        FileNotFoundError: The folder does not exist.
    """
    beside = path.with_name(f".{path.name}.part")
    if not path.parent.is_dir():
        words = "cannot be written: its folder does not exist"
        raise FileNotFoundError(errno.ENOENT, words, str(path))
    begin = hashlib.sha256(b"".join(it.tobytes() for it in job.values())).digest()
    with continued(beside) as file:
        if not begin.startswith(file.read(len(begin))):
            raise _another(beside, "a run of it was ended")
        file.seek(0)
        file.write(begin)
        count = (file.seek(0, os.SEEK_END) - len(begin)) // RECORD.itemsize
        file.seek(len(begin) + count * RECORD.itemsize)
        yield file, count
        file.flush()
        # Of the columns only what is written at a time is in memory.
        whole = np.memmap(file, RECORD, "r", len(begin), tuple(len(job[it]) for it in "xyz"))
        columns: dict[str, Any] = {**job, **{name: whole[name] for name in FIELDS}}
        with replaced(path) as archive:
            np.savez(archive, **columns)
        # Windows removes no file that is mapped.
        del whole
    beside.unlink(missing_ok=True)


def _arrays(path: Path, names: Sequence[str]) -> dict[str, npt.NDArray[Any]]:
    """Some arrays of a file, all of which it must have."""
    with path.open("rb") as file:
        try:
            stored = np.load(file)
            if missing := sorted({*names} - {*stored.files}):
                raise ValueError(f"it has no {missing[0]}")
            return {name: stored[name] for name in names}
        except (AttributeError, TypeError, ValueError, EOFError, zipfile.BadZipFile) as fault:
            raise IrbkinError(f"{path} is not a map: {fault}") from fault


def load(path: str | PathLike[str]) -> ReachMap:
    """Read a map that `reach` has written.

    Raises:
        OSError: The file cannot be read.
        IrbkinError: It is not a map.
    """
    return ReachMap(**_arrays(Path(path), ReachMap._fields))
