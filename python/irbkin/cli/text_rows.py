"""Rows of numbers in CSV, and the place of what is wrong with them."""

import contextlib
import csv
import io
import itertools
import re
from argparse import ArgumentTypeError
from collections.abc import Iterator, Sequence
from typing import Any, BinaryIO, NamedTuple

import numpy as np

from irbkin._arm_options import check_millimeters
from irbkin._words import counted
from irbkin.cli.errors import CommandError
from irbkin.cli.files import shown
from irbkin.cli.numbers import number
from irbkin.cli.output import Floats

PART = 20_000
"""Rows of a part."""
SCALES = {"mm": 1e-3, "m": 1.0, "deg": np.pi / 180, "rad": 1.0, "": 1.0}
OTHER_UNITS = {"mm": "m", "deg": "rad"}
OWN = ("limits", "joint", "confdata")
"""Columns of words that the command writes itself."""
Row = tuple[int, str]
"""The number of a line, and its text."""


class Layout(NamedTuple):
    """The meaning of rows: the columns that they may have, as `x_mm`, and the shape in an array."""

    what: str
    choices: tuple[tuple[str, ...], ...]
    shape: tuple[int, ...]

    def words(self) -> str:
        """The columns in words."""
        return " or ".join(", ".join(choice) for choice in self.choices)

    def placed(self, fields: Sequence[str]) -> dict[str, int]:
        """Where columns are in a row, by names or numbers; a ValueError says what it lacks."""
        fields = [field.strip() for field in fields]
        if len(fields) == 1 or any(map(_is_number, fields)):
            for choice in self.choices:
                if len(choice) == len(fields):
                    return {name: at for at, name in enumerate(choice)}
            raise ValueError(counted(len(fields), "column"))
        both = [[(it, _other(it)) for it in choice] for choice in self.choices]
        lacking = [[pair for pair in pairs if not {*pair} & {*fields}] for pairs in both]
        best = min(range(len(both)), key=lambda it: len(lacking[it]))
        if lacking[best]:
            raise ValueError(f"no column {' or '.join(dict.fromkeys(lacking[best][0]))}")
        names = (next(it for it in pair if it in fields) for pair in both[best])
        return {name: fields.index(name) for name in names}


def read_text(
    file: BinaryIO, name: str, layout: Layout
) -> Iterator[tuple[Floats, dict[str, list[str]]]]:
    """The rows of CSV in parts, in meters and radians, and their columns of words.

    The first row may name the columns with their units. Without names, the number of columns
    chooses among the layout's choices.
    """
    lines = io.TextIOWrapper(file, encoding="utf-8-sig", errors="surrogateescape")
    rows = ((at, it) for at, it in enumerate(lines, 1) if it.strip() and it[0] != "#")
    name, part = shown(name), list(itertools.islice(rows, PART))
    first, second = (_fields(it) for _, it in (*part, (0, ""), (0, ""))[:2])
    try:
        places = layout.placed(first) if part else {}
    except ValueError as lack:
        found = f"{_quoted(part[0][1])} has {lack}; a {layout.what} has {layout.words()}"
        how = "separated by commas, with decimal points"
        raise CommandError(f"{name}:{part[0][0]}: {found}, {how}") from None
    words, is_named = {}, not any(map(_is_number, first))
    if is_named:
        part = part[1:]
        own = enumerate(zip(first, second, strict=False))
        words = {it.strip(): at for at, (it, value) in own if re.search(r"[^\W\d]", value)}
        words = {it: at for it, at in words.items() if it not in (*OWN, *places)}
    scales = [SCALES[it.partition("_")[2]] for it in places]
    while part:
        values = _numbers(part, name, [*places.values()], 0 if is_named else len(first)) * scales
        if not is_named and layout.choices[0][0] == "x_mm":
            largest = values[np.abs(values[:, :3]).max(axis=1).argmax(), :3] * 1e3
            check_millimeters(largest.tolist(), f"{name}: the largest of the rows")
        # A row may end before them.
        fields = [(*_fields(it), *[""] * len(first)) for _, it in part if words]
        yield values, {it: [row[at] for row in fields] for it, at in words.items()}
        part = list(itertools.islice(rows, PART))
    # The file belongs to the caller.
    lines.detach()


def _numbers(rows: Sequence[Row], name: str, places: Sequence[int], width: int) -> Floats:
    """The values of rows, all of one width if there is one; a CommandError has a wrong place."""
    form: Any = {"delimiter": ",", "comments": None, "ndmin": 2, "quotechar": '"'}
    with contextlib.suppress(ValueError):
        values = np.loadtxt([it for _, it in rows], usecols=None if width else places, **form)
        if values.shape[1] == len(places) and np.isfinite(values).all():
            return values
    for line, text in rows:
        row = _fields(text)
        if len(row) != width if width else len(row) <= max(places):
            found = f"{_quoted(text)} has {counted(len(row), 'column')}, the first row has"
            cure = f"{width or 'more'}: separate them by commas, write decimal points"
            raise CommandError(f"{name}:{line}: {found} {cure}")
        for at in (it for it in sorted(places) if not _is_number(row[it])):
            place = f"{name}:{line}:{len(','.join([*row[:at], ''])) + 1}"
            raise CommandError(f"{place}: {_quoted(row[at])} is not a finite number")
    raise CommandError(f"{name}: has no finite rows")


def _fields(text: str) -> list[str]:
    try:
        return next(csv.reader([text]), [])
    except csv.Error:
        return [text]


def _other(column: str) -> str:
    """The column in the other unit; itself if it has no unit."""
    name, _, unit = column.partition("_")
    return f"{name}_{OTHER_UNITS[unit]}" if unit else name


def _is_number(field: str) -> bool:
    try:
        number(field)
    except ArgumentTypeError:
        return False
    return True


def _quoted(text: str) -> str:
    return repr(text.strip().encode("utf-8", "replace").decode()[:60])
