"""A program for another arm: its confdata are solved anew, and nothing else changes."""

import contextlib
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from irbkin import Robot
from irbkin._core import port_program
from irbkin._words import counted
from irbkin.rapid.program import ModuleFile, Program, edited, program_of


class LeftMove(NamedTuple):
    """A move that stays as it is, although it belongs to the arm before."""

    file: str
    """Path of the ported file."""
    line: int
    """Line, from 1."""
    column: int
    """Column, from 1."""
    message: str
    """The instruction and why it is not ported, in one line."""


@dataclass(frozen=True, eq=False)
class Ported:
    """A program for another arm."""

    program: Program
    """The program with its new confdata; its files are where they are written."""
    changed: int
    """Number of confdata that are new."""
    left: tuple[LeftMove, ...]
    """The moves that are not ported, in the order of the text."""

    def __repr__(self) -> str:
        """Return the program, and the numbers of new confdata and of moves that are left."""
        left = counted(len(self.left), "move")
        return f"Ported({self.program!r}, {self.changed} new confdata, {left} left)"


def port(
    program: Program,
    robot: Robot,
    *,
    to: str | PathLike[str] | None = None,
    source: Robot | None = None,
    **options: Any,
) -> Ported:
    """Solve the confdata of a program anew for another arm. Nothing else changes, not one byte.

    Along the moves the postures are chosen that are nearest, in the sum of squares, to those of
    `source` at the same targets; without it, to those at the targets before. A line or an arc ends
    with the posture that follows from the one at its start. Moves to one target share its confdata.
    What cannot be ported stays as it is and is listed: joint angles, and targets that are not
    reached, are calculated, or have external axes of unknown units.

    Args:
        program: The program, as of `load_program`.
        robot: The new arm, of six joints. Work objects are given in the world, in which its base
            is.
        to: A new or an empty folder, into which all files of the program are written, below it as
            they are below the folder that they have in common. Without it nothing is written.
        source: The arm before, of six joints.
        options: `units`, `last_values` and `tools`, as of `Program.check`.

    Returns:
        `Ported`: docs/guide/replace.md.

    Raises:
        InvalidModelError: An arm has no confdata, or seven joints.
        IrbkinError: A file that changes has bytes that are no text.
        FileExistsError: `to` is a file, or a folder that is not empty.
        OSError: `to` cannot be written.
    """
    folder = None if to is None else Path(to)
    if folder is not None and (folder.is_file() or (folder.is_dir() and any(folder.iterdir()))):
        raise FileExistsError(f"{to}: is there already, it must be a new or an empty folder")
    modules = list(program.modules)
    edits, changed, left = port_program(robot, modules, source=source, **options)
    files = []
    for number, (file, module) in enumerate(zip(program.files, modules, strict=True)):
        own = {begin: (end, text) for place, begin, end, text in edits if place == number}
        after = edited(module.source, own)
        files.append(replace(file, content=file.rewritten(module.source, after)) if own else file)
    if folder is not None:
        files = _written(files, folder)
    moves = [LeftMove(files[module].path, *others) for module, *others in left]
    # What is wrong with these files is found in their copies, too.
    known = {file.path for file in program.files}
    others = [found for found in program.findings if found.file not in known]
    return Ported(program_of(files, others), changed, tuple(moves))


def _written(files: Sequence[ModuleFile], folder: Path) -> list[ModuleFile]:
    """Write files below a folder, and return them there; without the folder if one fails."""
    top = os.path.commonpath([os.path.dirname(os.path.abspath(file.path)) for file in files])
    there = [
        replace(file, path=str(folder / os.path.relpath(os.path.abspath(file.path), top)))
        for file in files
    ]
    try:
        for file in there:
            os.makedirs(os.path.dirname(file.path), exist_ok=True)
            Path(file.path).write_bytes(file.content)
    except BaseException:
        # The folder was new or empty: half a program is none.
        for file in there:
            with contextlib.suppress(OSError):
                os.remove(file.path)
        for path, _, _ in os.walk(folder, topdown=False):
            with contextlib.suppress(OSError):
                os.rmdir(path)
        raise
    return there
