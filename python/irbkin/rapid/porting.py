"""A program for another arm: its confdata are solved anew, and nothing else changes."""

import os
import re
import shutil
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from irbkin import Robot
from irbkin._core import FIRST_TAG, Checked, Configuration, Module, port_program, read_modules
from irbkin._files import replaced
from irbkin._words import counted
from irbkin.rapid.program import Edits, ModuleFile, Program, edited, program_of

SKIPPED = re.compile(rb'"[^"\r\n]*"|![^\r\n]*')
"""Texts in quotes and comments."""
PART = rb"\s*(?:\[[^][]*\]|[\w{}.]+)\s*"
NUMBERS = rb"\[" + b",".join([rb"\s*([-+]?\d+)(?:\.0*)?\s*"] * 4) + rb"\]"
CONFDATA = re.compile(
    rb"\[(?:%b,){2}\s*%b\s*,%b\]|\bconfdata\s+\w+\s*:=\s*%b" % (PART, NUMBERS, PART, NUMBERS),
    re.IGNORECASE,
)
"""A robtarget with its confdata, and a datum that is one."""
MOST_SHOWN = 40
"""Letters of an instruction in a message, as a check shows it."""


class Place(NamedTuple):
    """Where a confdata is written: the module, and the bytes of the four numbers."""

    module: int
    numbers: list[tuple[int, int]]


class LeftMove(NamedTuple):
    """A move that the new arm cannot make as it is."""

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
    with the posture that follows from the one at its start. Moves to one target share its confdata,
    also with `Offs`, in arrays and as arguments.

    Then the program is checked. Moves are left to be ported by hand if they have joint angles, are
    not checked, or are made otherwise than programmed: reach, limits, paths (R), confdata (C).

    Args:
        program: The program, as of `load_program`.
        robot: The new arm, of six joints. Work objects are given in the world, in which its base
            is.
        to: A new or an empty folder, into which all files of the program are written, below it as
            they are below the folder that they have in common. Without it nothing is written.
        source: The arm before, of six joints, at its own base.
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
    places = list(_places(program))
    tagged = _with_tags(program, places)
    modules = list(program.modules)
    solved = port_program(robot, modules, tagged, source=source, **options)
    # A program may calculate a number that looks like one of these.
    changed = {number: confdata for number, confdata in solved if number < len(places)}
    files = _with_confdata(program, [(places[it], confdata) for it, confdata in changed.items()])
    if folder is not None:
        files = _write(files, folder)
    # What is wrong with these files is found in their copies, too.
    known = {file.path for file in program.files}
    ported = program_of(files, [it for it in program.findings if it.file not in known])
    left = tuple(_left(ported, ported.check(robot, **options)))
    return Ported(ported, len(changed), left)


def _places(program: Program) -> Iterator[Place]:
    """Where confdata are written, in the order of the texts."""
    for number, module in enumerate(program.modules):
        content = SKIPPED.sub(lambda it: b" " * len(it[0]), module.source.encode())
        for match in CONFDATA.finditer(content):
            numbers = [match.span(group) for group in range(1, 9) if match[group] is not None]
            yield Place(number, numbers)


def _with_tags(program: Program, places: Sequence[Place]) -> Sequence[Module]:
    """The modules with the number of each confdata as its cf1."""
    edits: list[Edits] = [{} for _ in program.modules]
    for number, place in enumerate(places):
        begin, end = place.numbers[0]
        edits[place.module][begin] = (end, str(FIRST_TAG + number))
    rows = zip(program.files, program.modules, edits, strict=True)
    return read_modules([file.encoded(edited(module.source, own)) for file, module, own in rows])


def _with_confdata(
    program: Program, changed: Iterable[tuple[Place, Configuration]]
) -> list[ModuleFile]:
    """The files with other confdata: numbers that do not differ stay as they are written."""
    edits: list[Edits] = [{} for _ in program.modules]
    contents = [module.source.encode() for module in program.modules]
    for place, confdata in changed:
        for (begin, end), value in zip(place.numbers, confdata, strict=True):
            if int(contents[place.module][begin:end]) != value:
                edits[place.module][begin] = (end, str(value))
    files = []
    for file, module, own in zip(program.files, program.modules, edits, strict=True):
        after = edited(module.source, own)
        files.append(replace(file, content=file.rewritten(module.source, after)) if own else file)
    return files


def _left(program: Program, checked: Checked) -> Iterator[LeftMove]:
    """The moves that are not checked, not made as programmed, or made with joint angles."""
    messages: dict[tuple[int, int, int], list[tuple[str, str]]] = {}
    for found in checked.findings:
        for place in ((found.module, found.line, found.column), *found.related):
            messages.setdefault(place, []).append((found.code, found.message))
    for move in checked.moves:
        place = (move.module, move.line, move.column)
        reasons = [
            words
            for code, words in messages.get(place, ())
            if code == move.unchecked or (code[0] in "RC" and code not in ("C203", "C204"))
        ]
        if not reasons and move.q is not None and move.confdata is None:
            words = f"MoveAbsJ {move.target}"
            words = words[:MOST_SHOWN] + "..." if len(words) > MOST_SHOWN else words
            reasons = [f"{words}: joint angles of the arm before, teach them again"]
        if not reasons and move.unchecked is not None:
            reasons = [f"{move.target}: is not checked"]
        for words in reasons[:1]:
            yield LeftMove(program.files[move.module].path, move.line, move.column, words)


def _write(files: Sequence[ModuleFile], folder: Path) -> list[ModuleFile]:
    """Write files below a folder, and return them there; without the folder if one fails."""
    top = os.path.commonpath([os.path.dirname(os.path.abspath(file.path)) for file in files])
    there = []
    try:
        for file in files:
            path = folder / os.path.relpath(os.path.abspath(file.path), top)
            path.parent.mkdir(parents=True, exist_ok=True)
            with replaced(path) as stream:
                stream.write(file.content)
            there.append(replace(file, path=str(path)))
    except BaseException:
        # The folder was new or empty: half a program is none.
        shutil.rmtree(folder, ignore_errors=True)
        raise
    return there
