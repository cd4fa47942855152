"""Programs: modules of files that know each other, written back as they were."""

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

from irbkin import Robot
from irbkin._core import Checked, Module, check_program, read_modules
from irbkin._files import STREAMS, is_plain, read, shown
from irbkin.errors import IrbkinError

SYSTEM = (".sys", ".sysx")
"""Endings of files of modules of the system."""
ENDINGS = (".mod", ".modx", *SYSTEM, ".prg")
"""Endings of files of modules."""
LIST = ".pgf"
"""Ending of a list of modules."""
MARKS = {b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be", b"\xef\xbb\xbf": "utf-8"}
FOLDERS = ("PROGMOD", "SYSMOD")
"""Folders of a task in a backup. HOME has older copies beside them."""
ENCODED = "encoded module"
"""Words of the fault of a module that is no text."""
Edits = dict[int, tuple[int, str]]
"""The end and the replacement of each edit of a text, by its first byte."""
LISTED = re.compile(r"<Module>([^<]*)</Module>", re.IGNORECASE)


@dataclass(frozen=True)
class FileFinding:
    """Something wrong with a file of a program."""

    file: str
    """Path as it was given or found."""
    line: int
    """Line, from 1; 0 for the file."""
    column: int
    """Column, from 1; 0 for the file."""
    code: str
    """E001 for broken text, E002 for a file that is not read, E003 for a doubled name."""
    message: str
    """The finding in words, in one line."""
    severity: str = "error"
    """"error", "warning" or "note"."""


@dataclass(frozen=True, eq=False)
class ModuleFile:
    """A file with the text of a module."""

    path: str
    """Path as it was given or found."""
    content: bytes = field(repr=False)

    @property
    def mark(self) -> bytes:
        """Its byte order mark, perhaps empty."""
        return next((mark for mark in MARKS if self.content.startswith(mark)), b"")

    @property
    def encoding(self) -> str:
        """Its encoding: UTF-16 or UTF-8, else Latin-1, which keeps the bytes of any code page."""
        try:
            self.content.decode("utf-8")
        except UnicodeDecodeError:
            return MARKS.get(self.mark, "latin-1")
        return MARKS.get(self.mark, "utf-8")

    def encoded(self, text: str) -> bytes:
        """Return a text as bytes of this file.

        Raises:
            UnicodeEncodeError: The encoding lacks a character.
        """
        return self.mark + text.encode(self.encoding)

    def rewritten(self, before: str, after: str) -> bytes:
        """Return the bytes of this file with another text in place of its own.

        Raises:
            IrbkinError: It has bytes that are no text.
        """
        if self.encoded(before) != self.content:
            raise IrbkinError(
                f"{shown(self.path)}: has bytes that are no {self.encoding} text, so it cannot be "
                "written back as it is: repair them first"
            )
        return self.encoded(after)


@dataclass(frozen=True, eq=False)
class Program:
    """Modules of one task: global data and routines of each are known in all."""

    modules: tuple[Module, ...]
    """The modules that could be read."""
    files: tuple[ModuleFile, ...]
    """The file of each module."""
    findings: tuple[FileFinding, ...] = ()
    """Findings on files that could not be read, and on names that are doubled."""

    def check(self, robot: Robot, **options: Any) -> Checked:
        """Check every move: routines are followed from `main` through their calls.

        Args:
            robot: The arm. Work objects are given in the world, in which the robot's base is.
            options: As of `rapid.check`; units, last_values, tools, carried: docs/guide/check.md.

        Returns:
            `Checked`, whose `module` numbers are indices of `modules`.

        Raises:
            IrbkinError: As `rapid.check`.
        """
        names = [file.path.lower() for file in self.files]
        of_system = [index for index, name in enumerate(names) if name.endswith(SYSTEM)]
        return check_program(robot, list(self.modules), of_system=of_system, **options)

    def __repr__(self) -> str:
        """Return the numbers of modules, moves and findings."""
        moves = sum(len(module.moves) for module in self.modules)
        return f"Program({len(self.modules)} modules, {moves} moves, {len(self.findings)} findings)"


def edited(source: str, edits: Edits) -> str:
    """Return a text after edits."""
    content = source.encode()
    parts: list[bytes] = []
    copied = 0
    for begin, (end, text) in sorted(edits.items()):
        parts += [content[copied:begin], text.encode()]
        copied = end
    return b"".join([*parts, content[copied:]]).decode()


def load_program(path: str | PathLike[str] | Iterable[str | PathLike[str]]) -> Program:
    """Read the modules of a task, which know each other.

    What is broken is a finding, and the rest is read: statements, modules, missing files.

    Args:
        path: A module (.mod, .modx, .sys, .sysx, .prg), a list of modules (.pgf), a folder of
            modules, or several of these. Of a task's folder PROGMOD and SYSMOD are read. Links
            that lead out of a folder are not followed.

    Raises:
        OSError: A path that is given does not exist or cannot be read.
    """
    given = [path] if isinstance(path, str | PathLike) else list(path)
    findings: list[FileFinding] = []
    files = [file for it in given for file in files_of(os.fspath(it), findings)]
    return program_of(files, findings)


def program_of(files: Iterable[ModuleFile], findings: Iterable[FileFinding] = ()) -> Program:
    """Return the program of files that are read, each once; findings on them as before."""
    files = list({os.path.realpath(file.path): file for file in files}.values())
    return program_from(files, read_modules([file.content for file in files]), findings)


def program_from(
    files: Sequence[ModuleFile],
    modules: Sequence[Module],
    findings: Iterable[FileFinding] = (),
) -> Program:
    """Return the program of modules that are read, each with its file; findings as before."""
    found = list(findings)
    for file, module in zip(files, modules, strict=True):
        for fault in module.faults:
            place = (file.path, fault.line, fault.column)
            if ENCODED in fault.message:
                # Options of a controller are so.
                found.append(FileFinding(file.path, 1, 1, "E002", fault.message, "note"))
            else:
                found.append(FileFinding(*place, "E001", fault.message))
    found += _doubled(files, modules)
    return Program(tuple(modules), tuple(files), tuple(found))


def files_of(path: str, findings: list[FileFinding]) -> Iterator[ModuleFile]:
    """Yield the files of a module, a list or a folder; add what is wrong with them to findings."""
    if os.path.isdir(path):
        for name in modules_in(path):
            try:
                yield ModuleFile(name, read(name))
            except OSError as error:
                message = f"cannot be read: {error.strerror}"
                findings.append(FileFinding(name, 0, 0, "E002", message))
    elif not (path.startswith(STREAMS) or is_plain(os.stat(path))):
        message = "is a pipe, a socket or a device: it is not read"
        findings.append(FileFinding(path, 0, 0, "E002", message))
    elif path.lower().endswith(LIST):
        yield from _listed(path, findings)
    else:
        yield ModuleFile(path, read(path))


def modules_in(folder: str) -> list[str]:
    """Return the files of modules in a folder; of a task's those that a controller has loaded."""
    inside = {name.upper(): name for name in os.listdir(folder)}
    tops = [os.path.join(folder, inside[name]) for name in FOLDERS if name in inside] or [folder]
    root = os.path.realpath(folder)
    found = (
        os.path.join(at, name) for top in tops for at, _, names in os.walk(top) for name in names
    )
    return sorted(
        path
        for path in found
        if path.lower().endswith(ENDINGS) and is_inside(os.path.realpath(path), root)
    )


def is_inside(path: str, root: str) -> bool:
    """Whether a path is a folder or below it, both without links."""
    return os.path.commonpath([path, root]) == root


def _listed(path: str, findings: list[FileFinding]) -> Iterator[ModuleFile]:
    """Yield the files that a .pgf lists."""
    text = Path(path).read_bytes().decode("utf-8", "replace")
    folder = os.path.dirname(path)
    for match in LISTED.finditer(text):
        name = match[1].strip().replace("\\", "/")
        line = text.count("\n", 0, match.start()) + 1
        target = os.path.join(folder, name)
        wrong = ""
        if os.path.isabs(name) or ".." in name.split("/"):
            wrong = "leads out of the folder: it is not read"
        elif not name.lower().endswith(ENDINGS):
            wrong = f"is no module ({', '.join(ENDINGS)})"
        elif not os.path.isfile(target):
            wrong = "does not exist"
        elif not is_inside(os.path.realpath(target), os.path.realpath(folder)):
            wrong = "is a link out of the folder: it is not read"
        if wrong:
            findings.append(FileFinding(path, line, 1, "E002", f"{name}: {wrong}"))
            continue
        yield ModuleFile(target, Path(target).read_bytes())


def _doubled(files: Sequence[ModuleFile], modules: Sequence[Module]) -> Iterator[FileFinding]:
    """Yield modules of a name that another one has."""
    first: dict[str, str] = {}
    for file, module in zip(files, modules, strict=True):
        name = (module.name or "").lower()
        if name and name in first:
            message = f"module {module.name} is in {first[name]}, too: which one counts is unknown"
            yield FileFinding(file.path, 1, 1, "E003", message, "warning")
        elif name:
            first[name] = file.path
