"""Rows of numbers in CSV, and the place of what is wrong with them."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

import numpy as np

from irbkin._arm_options import check_millimeters
from irbkin.cli.errors import CommandError
from irbkin.cli.files import shown

if TYPE_CHECKING:
    from irbkin._arrays import Floats

PART = 1 << 21
"""Bytes of a part: some ten thousand rows."""
SCALES = {"mm": 1e-3, "m": 1.0, "deg": np.pi / 180, "rad": 1.0, "": 1.0}
OTHER_UNITS = {"mm": "m", "deg": "rad"}


class Layout(NamedTuple):
    """The meaning of rows."""

    what: str
    choices: tuple[tuple[str, ...], ...]
    """The columns that they may have, by name and unit: `x_mm`."""
    shape: tuple[int, ...]
    """The shape of a row of an array."""

    def words(self) -> str:
        """The columns in words."""
        return " or ".join(", ".join(choice) for choice in self.choices)


class _Columns(NamedTuple):
    """Where the columns are in a row of `width`, and the units of their values [m, rad]."""

    width: int
    places: Sequence[int]
    scales: Floats
    are_named: bool


def read_text(file: BinaryIO, name: str, layout: Layout) -> Iterator[Floats]:
    """The rows of CSV in parts, in meters and radians.

    The first row may name the columns with their units. Without names, the number of columns
    chooses among the layout's choices.
    """
    lines = io.TextIOWrapper(file, encoding="utf-8-sig", errors="surrogateescape")
    name, number, columns = shown(name), 0, None
    while part := lines.readlines(PART):
        rows = [(at, it) for at, it in enumerate(part, number + 1) if it.strip() and it[0] != "#"]
        number += len(part)
        if columns is None and rows:
            columns = _columns(rows[0][1], f"{name}:{rows[0][0]}", layout)
            rows = rows[columns.are_named :]
        if columns and rows:
            values = _numbers(rows, name, columns)
            if not columns.are_named and layout.choices[0][0] == "x_mm":
                largest = values[np.abs(values[:, :3]).max(axis=1).argmax(), :3] * 1e3
                check_millimeters(largest.tolist(), f"{name}: the largest of the rows")
            yield values
    # The file belongs to the caller.
    lines.detach()


def _columns(line: str, place: str, layout: Layout) -> _Columns:
    """The columns by the first row."""
    fields = [field.strip() for field in line.split(",")]
    are_named = len(fields) > 1 and not any(map(_is_number, fields))
    if are_named:
        found = [[_either(it, fields) for it in choice] for choice in layout.choices]
        best = min(range(len(found)), key=lambda it: found[it].count(""))
        columns, choice = found[best], layout.choices[best]
    else:
        choice = next((it for it in layout.choices if len(it) == len(fields)), ())
        columns = list(choice)
    if columns and "" not in columns:
        scales = np.array([SCALES[it.partition("_")[2]] for it in columns])
        places = [fields.index(it) for it in columns] if are_named else range(len(fields))
        return _Columns(len(fields), places, scales, are_named)
    lack = _counted(fields)
    if are_named:
        name = choice[columns.index("")]
        lack = f"no column {name} or {_other(name)}" if "_" in name else f"no column {name}"
    raise CommandError(
        f"{place}: {_quoted(line)} has {lack}; a {layout.what} has {layout.words()}, separated by "
        "commas, with decimal points"
    )


def _other(column: str) -> str:
    """The column in the other unit; itself if it has no unit."""
    name, _, unit = column.partition("_")
    return f"{name}_{OTHER_UNITS[unit]}" if unit else name


def _either(column: str, fields: Sequence[str]) -> str:
    """Return the name of a column in a row, in one unit or the other; empty if it has none."""
    return next((it for it in (column, _other(column)) if it in fields), "")


def _numbers(rows: Sequence[tuple[int, str]], name: str, columns: _Columns) -> Floats:
    try:
        values = np.loadtxt(
            [line for _, line in rows],
            delimiter=",",
            usecols=columns.places if columns.are_named else None,
            comments=None,
            ndmin=2,
        )
    except ValueError as error:
        raise _fault(rows, name, columns) or CommandError(f"{name}: {error}") from None
    if values.shape[1] != len(columns.scales) or not np.isfinite(values).all():
        raise _fault(rows, name, columns) or CommandError(f"{name}: has no finite rows")
    return np.asarray(values * columns.scales, dtype=np.float64)


def _fault(rows: Sequence[tuple[int, str]], name: str, columns: _Columns) -> CommandError | None:
    """Find the first invalid row, and say where and why it is."""
    for number, line in rows:
        fields, column = line.rstrip("\r\n").split(","), 1
        if len(fields) != columns.width:
            return CommandError(
                f"{name}:{number}: {_quoted(line)} has {_counted(fields)}, the first row has "
                f"{columns.width}: separate them by commas, write decimal points"
            )
        for place, field in enumerate(fields):
            if place in columns.places and not (_is_number(field) and math.isfinite(float(field))):
                return CommandError(
                    f"{name}:{number}:{column}: {_quoted(field)} is not a finite number"
                )
            column += len(field) + 1
    return None


def _counted(fields: Sequence[str]) -> str:
    return "1 column" if len(fields) == 1 else f"{len(fields)} columns"


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return "_" not in field


def _quoted(text: str) -> str:
    return repr(text.strip().encode("utf-8", "replace").decode()[:60])
