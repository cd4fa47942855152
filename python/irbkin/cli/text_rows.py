"""Rows of numbers in a text, and the place of what is wrong with them."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

import numpy as np

from irbkin.cli.errors import CommandError
from irbkin.cli.files import shown
from irbkin.cli.numbers import check_millimeters

if TYPE_CHECKING:
    from irbkin._arrays import Floats

PART = 1 << 21
"""Bytes of a part: some ten thousand rows."""
HEADING = re.compile(r'\s*"?([a-z]+\d*)\s*(?:[ _(\[]\s*(mm|m|deg|rad)[)\]]?)?"?\s*')
SCALES = {"mm": 1e-3, "m": 1.0, "deg": np.pi / 180, "rad": 1.0, "": 1.0}


class Heading(NamedTuple):
    """A column that rows may have: its name, and its unit where none is given."""

    name: str
    unit: str = ""


@dataclass(frozen=True)
class Layout:
    """The meaning of rows."""

    what: str
    choices: tuple[tuple[Heading, ...], ...]
    """The columns that they may have, without a heading told apart by their number."""
    shape: tuple[int, ...]
    """The shape of a row of an array."""

    def words(self) -> str:
        """The columns in words."""
        named = (
            ", ".join(f"{it.name}_{it.unit}" if it.unit else it.name for it in choice)
            for choice in self.choices
        )
        return " or ".join(named)


class Text:
    """Rows of a text: separated by commas, semicolons, tabs or blanks, with or without headings."""

    def __init__(self, file: BinaryIO, name: str, layout: Layout) -> None:
        self.lines = io.TextIOWrapper(file, encoding="utf-8-sig", errors="surrogateescape")
        self.name, self.layout = shown(name), layout
        self.separator: str | None = None
        self.columns: list[int] | None = None
        self.count = 0
        self.scales = np.ones(0)
        self.assumed: list[int] = []
        self.number = 0

    def rows(self) -> Iterator[Floats]:
        """The rows, in meters and radians."""
        is_first = True
        while lines := self.lines.readlines(PART):
            begin, self.number = self.number, self.number + len(lines)
            kept = [line for line in lines if line.strip() and not line.lstrip().startswith("#")]
            if kept and is_first:
                is_first = False
                if self._begin(kept[0], begin + lines.index(kept[0]) + 1):
                    kept = kept[1:]
            if kept:
                rows = self._numbers(kept, lines, begin)
                if self.assumed:
                    self._check_millimeters(rows[:, self.assumed])
                yield rows
        # The file belongs to the caller.
        self.lines.detach()

    def _check_millimeters(self, lengths: Floats) -> None:
        """Refuse the first rows whose lengths [m] have no unit, if all of them are tiny."""
        largest = lengths[np.abs(lengths).max(axis=1).argmax()] * 1e3
        check_millimeters(largest.tolist(), f"{self.name}: the largest of the rows")
        self.assumed = []

    def _split(self, line: str) -> list[str]:
        fields = line.rstrip("\r\n").split(self.separator)
        return [field.replace(",", ".") for field in fields] if self.separator == ";" else fields

    def _begin(self, line: str, number: int) -> bool:
        """Find out about the columns from the first line; whether it is a heading."""
        self.separator = next((it for it in ",;\t" if it in line), None)
        if self.separator == "," and ";" in line:
            self.separator = ";"
        fields = self._split(line)
        if not all(_is_number(field) for field in fields) and any(
            HEADING.fullmatch(field.lower()) for field in fields
        ):
            self._name(fields, number)
            return True
        for choice in self.layout.choices:
            if len(choice) == len(fields):
                self.scales = np.array([SCALES[it.unit] for it in choice])
                self.assumed = [place for place, it in enumerate(choice) if it.unit == "mm"]
                self.count = len(fields)
                return False
        raise CommandError(
            f"{self.name}:{number}: {len(fields)} columns; a {self.layout.what} has "
            f"{self.layout.words()}"
        )

    def _name(self, fields: Sequence[str], number: int) -> None:
        """The columns of a heading."""
        found: dict[str, tuple[int, str]] = {}
        for place, field in enumerate(fields):
            if match := HEADING.fullmatch(field.lower()):
                found.setdefault(match[1].replace("j", "q", 1), (place, match[2] or ""))
        for choice in self.layout.choices:
            if all(it.name in found for it in choice):
                self.columns = [found[it.name][0] for it in choice]
                self.scales = np.array([SCALES[found[it.name][1] or it.unit] for it in choice])
                self.assumed = [
                    place
                    for place, it in enumerate(choice)
                    if it.unit == "mm" and not found[it.name][1]
                ]
                self.count = len(fields)
                return
        missing = next(it.name for it in self.layout.choices[0] if it.name not in found)
        raise CommandError(
            f"{self.name}:{number}: no column {missing!r}; a {self.layout.what} has "
            f"{self.layout.words()}"
        )

    def _numbers(self, kept: list[str], lines: list[str], begin: int) -> Floats:
        if self.separator == ";":
            kept = [line.replace(",", ".") for line in kept]
        try:
            rows = np.loadtxt(
                kept, delimiter=self.separator, usecols=self.columns, comments=None, ndmin=2
            )
        except ValueError as error:
            self._find_fault(lines, begin)
            raise CommandError(f"{self.name}: {error}") from None
        if rows.shape[1] != len(self.scales):
            self._find_fault(lines, begin)
        if not np.isfinite(rows).all():
            self._find_fault(lines, begin)
        return np.asarray(rows * self.scales, dtype=np.float64)

    def _find_fault(self, lines: list[str], begin: int) -> None:
        """Complain of the first line that is wrong."""
        for number, line in enumerate(lines, begin + 1):
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            fields, column = self._split(line), 1
            if len(fields) != self.count and not (number == 1 and self.columns):
                raise CommandError(
                    f"{self.name}:{number}: {len(fields)} columns, the first line has {self.count}"
                )
            for place, field in enumerate(fields):
                is_used = self.columns is None or place in self.columns
                is_heading = number == 1 and self.columns is not None
                if is_used and not is_heading and not _is_finite(field):
                    word = field.strip().encode("utf-8", "replace").decode()[:40]
                    raise CommandError(
                        f"{self.name}:{number}:{column}: {word!r} is not a finite number"
                    )
                column += len(field) + 1


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return "_" not in field


def _is_finite(field: str) -> bool:
    return _is_number(field) and math.isfinite(float(field))
