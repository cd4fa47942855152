"""RAPID modules as files: read, parsed together, and written back in their encoding."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from irbkin.cli.codes import SYNTAX
from irbkin.cli.errors import CommandError
from irbkin.cli.files import STDIN, opened, replaced, shown
from irbkin.cli.findings import Found

if TYPE_CHECKING:
    from irbkin.errors import RapidError
    from irbkin.rapid import Module

ENDINGS = (".mod", ".modx", ".sys", ".sysx", ".prg")
MARKS = {b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be", b"\xef\xbb\xbf": "utf-8"}


class Source:
    """A file with RAPID text."""

    def __init__(self, name: str, content: bytes) -> None:
        self.name, self.content = name, content
        self.is_stdin = name == STDIN
        self.shown = "<stdin>" if self.is_stdin else shown(name)
        self.mark = next((mark for mark in MARKS if content.startswith(mark)), b"")
        self.encoding = MARKS.get(self.mark) or _encoding(content)
        self.module: Module | None = None
        self.alone: Module | None = None
        """The module without its context."""
        self.context: Sequence[Module] = ()
        self.ignored: Collection[str] = ()
        """Codes that are not wanted of this file."""

    @property
    def text(self) -> str:
        """The text, also of a file that is broken."""
        if self.module is not None:
            return self.module.source
        return self.content[len(self.mark) :].decode(self.encoding, "replace")

    @classmethod
    def read(cls, name: str) -> Source:
        """The file of a name."""
        with opened(name) as file:
            return cls(name, file.read())

    def bytes_of(self, text: str) -> bytes:
        """A text in the encoding of the file."""
        return self.mark + text.encode(self.encoding, "replace")

    def write(self, module: Module) -> None:
        """Write a corrected module in the place of the file."""
        assert self.module is not None
        if self.bytes_of(self.module.source) != self.content:
            raise CommandError(
                f"{self.shown}: has bytes that are no {self.encoding} text, so it cannot be "
                "written back as it is: repair them first"
            )
        content = self.bytes_of(module.source)
        with replaced(self.name) as file:
            file.write(content)
        self.module, self.content = module, content


def checksum_of(name: str) -> str | None:
    """The list of hashes of a controller's backup that has a line for a file, if there is one."""
    path = os.path.abspath(name)
    root = os.path.dirname(path)
    while not os.path.isfile(file := os.path.join(root, "BACKINFO", "checksum.txt")):
        if root == os.path.dirname(root):
            return None
        root = os.path.dirname(root)
    own = f"/{os.path.relpath(path, root)}".replace("\\", "/").lower()
    with open(file, encoding="latin-1") as lines:
        return file if any(it.strip().replace("\\", "/").lower() == own for it in lines) else None


def _encoding(content: bytes) -> str:
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def expanded(names: Sequence[str]) -> list[str]:
    """The files of names, of which folders stand for the modules in them."""
    found: list[str] = []
    for name in names:
        if not os.path.isdir(name):
            found.append(name)
            continue
        inside = (
            os.path.join(folder, file) for folder, _, files in os.walk(name) for file in files
        )
        modules = sorted(path for path in inside if path.lower().endswith(ENDINGS))
        if not modules:
            raise CommandError(f"{name}: has no RAPID modules ({', '.join(ENDINGS)})")
        found += modules
    return found


def read_modules(sources: Sequence[Source]) -> list[Found]:
    """Parse sources, each with the others as its context; those that are broken have no module."""
    from irbkin._core import parse_module
    from irbkin.errors import RapidError

    broken = []
    for source in sources:
        try:
            source.module = source.alone = parse_module(source.content)
        except RapidError as error:
            broken.append(_fault(source, error))
    if len(sources) == 1:
        return broken
    for source in sources:
        others = (it.alone for it in sources if it is not source)
        source.context = [it for it in others if it is not None]
        if source.alone is None:
            continue
        try:
            source.module = parse_module(source.content, source.context)
        except RapidError as error:
            # A name of another module is of another type.
            source.module = None
            broken.append(_fault(source, error))
    return broken


def _fault(source: Source, error: RapidError) -> Found:
    place = f"line {error.line}, column {error.column}: "
    message = str(error).removeprefix(place)
    return Found(source.shown, error.line, error.column, SYNTAX, "syntax", "error", message)
