"""Rows of numbers in CSV, and the place of what is wrong with them."""

import io
import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import BinaryIO, NamedTuple

import numpy as np

from irbkin._arm_options import check_millimeters
from irbkin.cli.errors import CommandError
from irbkin.cli.files import shown
from irbkin.cli.output import Floats

PART = 20_000
"""Rows of a part."""
SCALES = {"mm": 1e-3, "m": 1.0, "deg": np.pi / 180, "rad": 1.0, "": 1.0}
OTHER_UNITS = {"mm": "m", "deg": "rad"}
OWN = ("limits", "joint", "confdata")
"""Columns of words that the command writes itself."""


class Layout(NamedTuple):
    """The meaning of rows: the columns that they may have, as `x_mm`, and the shape in an array."""

    what: str
    choices: tuple[tuple[str, ...], ...]
    shape: tuple[int, ...]

    def words(self) -> str:
        """The columns in words."""
        return " or ".join(", ".join(choice) for choice in self.choices)


class _Columns(NamedTuple):
    """Where the columns are in a row of `width`, and their names with units."""

    width: int
    places: Sequence[int]
    names: Sequence[str]
    words: Mapping[str, int] | None
    """Where columns of words are; None without a row of names."""


Row = tuple[int, str]
"""The number of a line, and its text."""


def read_text(
    file: BinaryIO, name: str, layout: Layout
) -> Iterator[tuple[Floats, dict[str, list[str]]]]:
    """The rows of CSV in parts, in meters and radians, and their columns of words.

    The first row may name the columns with their units. Without names, the number of columns
    chooses among the layout's choices.
    """
    lines = io.TextIOWrapper(file, encoding="utf-8-sig", errors="surrogateescape")
    texts = ((at, it.strip("\r\n")) for at, it in enumerate(lines, 1))
    every = ((at, it) for at, it in texts if it.strip() and it[0] != "#")
    name, columns = shown(name), None
    while rows := list(itertools.islice(every, PART)):
        if columns is None:
            columns = _columns(rows, f"{name}:{rows[0][0]}", layout)
            rows = rows[columns.words is not None :]
        if rows:
            values = _numbers(rows, name, columns)
            if columns.words is None and layout.choices[0][0] == "x_mm":
                largest = values[np.abs(values[:, :3]).max(axis=1).argmax(), :3] * 1e3
                check_millimeters(largest.tolist(), f"{name}: the largest of the rows")
            words = (columns.words or {}).items()
            # A row may end before them.
            fields = [it.split(",") + [""] * columns.width for _, it in rows] if words else []
            yield values, {key: [it[at] for it in fields] for key, at in words}
    # The file belongs to the caller.
    lines.detach()


def _columns(rows: Sequence[Row], place: str, layout: Layout) -> _Columns:
    """The columns by the first row."""
    fields, *others = ([field.strip() for field in it.split(",")] for _, it in rows[:2])
    width = len(fields)
    lack = _counted(width)
    if width == 1 or any(map(_is_number, fields)):
        for choice in layout.choices:
            if len(choice) == width:
                return _Columns(width, range(width), choice, None)
    else:
        # In one unit or the other.
        both = [[(it, _other(it)) for it in choice] for choice in layout.choices]
        lacking = [[pair for pair in pairs if not {*pair} & {*fields}] for pairs in both]
        best = min(range(len(both)), key=lambda it: len(lacking[it]))
        if not lacking[best]:
            names = [next(it for it in pair if it in fields) for pair in both[best]]
            pairs = enumerate(zip(fields, *others, strict=False)) if others else ()
            words = {it: at for at, (it, own) in pairs if re.search(r"[^\W\d]", own)}
            for own in (*OWN, *names):
                words.pop(own, None)
            return _Columns(width, [fields.index(it) for it in names], names, words)
        lack = f"no column {' or '.join(dict.fromkeys(lacking[best][0]))}"
    raise CommandError(
        f"{place}: {_quoted(rows[0][1])} has {lack}; a {layout.what} has "
        f"{layout.words()}, separated by commas, with decimal points"
    )


def _other(column: str) -> str:
    """The column in the other unit; itself if it has no unit."""
    name, _, unit = column.partition("_")
    return f"{name}_{OTHER_UNITS[unit]}" if unit else name


def _numbers(rows: Sequence[Row], name: str, columns: _Columns) -> Floats:
    """The values of rows, or where and why the first invalid one is."""
    try:
        texts = [it for _, it in rows]
        usecols = None if columns.words is None else columns.places
        values = np.loadtxt(texts, delimiter=",", usecols=usecols, comments=None, ndmin=2)
        if values.shape[1] == len(columns.places) and np.isfinite(values).all():
            return values * [SCALES[it.partition("_")[2]] for it in columns.names]
    except ValueError:
        pass
    for number, text in rows:
        fields = text.split(",")
        if len(fields) != columns.width:
            raise CommandError(
                f"{name}:{number}: {_quoted(text)} has {_counted(len(fields))}, the "
                f"first row has {columns.width}: separate them by commas, write decimal points"
            )
        for place, field in enumerate(fields):
            if place in columns.places and not (_is_number(field) and math.isfinite(float(field))):
                column = len(",".join([*fields[:place], ""])) + 1
                words = f"{name}:{number}:{column}: {_quoted(field)}"
                raise CommandError(f"{words} is not a finite number")
    raise CommandError(f"{name}: has no finite rows")


def _counted(fields: int) -> str:
    return "1 column" if fields == 1 else f"{fields} columns"


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return "_" not in field


def _quoted(text: str) -> str:
    return repr(text.strip().encode("utf-8", "replace").decode()[:60])
