"""Rows as a table, CSV, JSON or an array, written part by part."""

from __future__ import annotations

import argparse
import contextlib
import csv
import io
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple, TypeAlias

import numpy as np

from irbkin.cli.errors import CommandError
from irbkin.cli.files import STDIN, replaced

if TYPE_CHECKING:
    import numpy.typing as npt

Values: TypeAlias = Sequence[Any] | np.ndarray[Any, Any]


class Column(NamedTuple):
    """A column: its name, its unit, and how a table shows its values."""

    name: str
    unit: str
    form: str

    @property
    def key(self) -> str:
        """Its name with its unit, in CSV and JSON."""
        unit = self.unit.replace("/", "_")
        return f"{self.name}_{unit}" if unit else self.name


class Rows:
    """Where rows go: what each format has of its own is `begin`, `add` and `end`."""

    def __init__(self, file: BinaryIO, columns: Sequence[Column], heading: str) -> None:
        self.file, self.columns, self.heading = file, columns, heading
        self.notes: list[tuple[str, Any, str]] = []
        self.count = 0
        self._is_begun = False

    def put(self, text: str) -> None:
        """Write text."""
        self.file.write(text.encode("utf-8", "backslashreplace"))

    def write(self, columns: Sequence[Values], array: npt.NDArray[Any] | None = None) -> None:
        """Some rows, by columns, and the same as an array."""
        self._begin()
        self.add(columns, array)

    def note(self, key: str, value: Any, words: str) -> None:
        """Add a note on all rows, behind them."""
        self.notes.append((key, value, words))

    def close(self) -> None:
        """No more rows come."""
        self._begin()
        self.end()
        self.file.flush()

    def _begin(self) -> None:
        # Not before the first rows are there: they may be refused.
        if not self._is_begun:
            self._is_begun = True
            self.begin()

    def begin(self) -> None:
        """Write the part before the rows."""
        raise NotImplementedError

    def add(self, columns: Sequence[Values], array: npt.NDArray[Any] | None) -> None:
        """Some rows."""
        raise NotImplementedError

    def end(self) -> None:
        """Write the part behind the rows."""
        raise NotImplementedError


class Table(Rows):
    """Rows on paper, as they are read by people; empty without rows."""

    def begin(self) -> None:
        """The width of each column."""
        self.units = [f"[{column.unit}]" if column.unit else "" for column in self.columns]
        self.widths = []
        for column, unit in zip(self.columns, self.units, strict=True):
            sample = format("" if column.form.endswith("s") else 0, column.form)
            width = max(len(column.name), len(unit), len(sample))
            self.widths.append(f"{'<' if column.form.startswith('<') else '>'}{width}")

    def _line(self, cells: Iterable[str]) -> str:
        padded = (format(cell, width) for cell, width in zip(cells, self.widths, strict=True))
        return "  ".join(padded).rstrip() + "\n"

    def add(self, columns: Sequence[Values], array: npt.NDArray[Any] | None) -> None:
        """Some rows, under the heading if they are the first."""
        forms = [column.form for column in self.columns]
        for row in zip(*_lists(columns), strict=True):
            if not self.count:
                names = self._line(column.name for column in self.columns)
                units = self._line(self.units) if any(self.units) else ""
                self.put(f"{self.heading}\n\n{names}{units}")
            self.count += 1
            self.put(self._line(map(_cell, row, forms)))

    def end(self) -> None:
        """The notes that have words."""
        notes = [f"{words}\n" for _, _, words in self.notes if words]
        if notes:
            self.put("\n" + "".join(notes))


def _lists(columns: Sequence[Values]) -> list[Sequence[Any]]:
    """Columns of Python's own numbers."""
    return [values.tolist() if isinstance(values, np.ndarray) else values for values in columns]


def _cell(value: Any, form: str) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "-"
    # Whole numbers with gaps are floats.
    return format(int(value) if form.endswith("d") else value, form.lstrip("<"))


class Csv(Rows):
    """Rows for other programs: names with units, then numbers; empty where one is missing."""

    def begin(self) -> None:
        """The names."""
        self._put([[column.key for column in self.columns]])

    def add(self, columns: Sequence[Values], array: npt.NDArray[Any] | None) -> None:
        """Some rows."""
        rows = [[_text(value) for value in row] for row in zip(*_lists(columns), strict=True)]
        self.count += len(rows)
        self._put(rows)

    def _put(self, rows: list[list[str]]) -> None:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(rows)
        self.put(text.getvalue())

    def end(self) -> None:
        """Nothing."""


def _text(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "" if value is None or math.isnan(value) else f"{value:.12g}"


class Json(Rows):
    """One object with the rows, each an object, and what is said of all."""

    def begin(self) -> None:
        """Its beginning."""
        import json

        self.dumps = json.dumps
        self.put(f'{{"heading": {self.dumps(self.heading)},\n"rows": [')

    def add(self, columns: Sequence[Values], array: npt.NDArray[Any] | None) -> None:
        """Some rows."""
        keys = [column.key for column in self.columns]
        for row in zip(*_lists(columns), strict=True):
            comma = ",\n" if self.count else "\n"
            self.put(comma + self.dumps(dict(zip(keys, map(_plain, row), strict=True))))
            self.count += 1

    def end(self) -> None:
        """Its end."""
        notes = "".join(
            f",\n{self.dumps(key)}: {self.dumps(_plain(value))}" for key, value, _ in self.notes
        )
        self.put(f"\n]{notes}}}\n")


def _plain(value: Any) -> Any:
    """A value that JSON has, with as many digits as in CSV."""
    if isinstance(value, float):
        return float(f"{value:.12g}") if math.isfinite(value) else None
    return value.item() if isinstance(value, np.generic) else value


class Npy(Rows):
    """The rows of the array, in radians and meters."""

    def begin(self) -> None:
        """Nothing: the header needs the shape of the rows."""
        self.shape: tuple[int, ...] = ()

    def add(self, columns: Sequence[Values], array: npt.NDArray[Any] | None) -> None:
        """Some rows, behind a header if they are the first."""
        assert array is not None, "a verb with --output FILE.npy gives arrays"
        if not self.count:
            self.shape = array.shape[1:]
            self._head()
        self.count += len(array)
        self.file.write(np.ascontiguousarray(array, dtype="<f8").tobytes())

    def end(self) -> None:
        """The header again, with the number of rows: NumPy pads it to the same size."""
        self.file.seek(0)
        self._head()

    def _head(self) -> None:
        content = {"descr": "<f8", "fortran_order": False, "shape": (self.count, *self.shape)}
        np.lib.format.write_array_header_1_0(self.file, content)


ENDINGS = {".csv": Csv, ".json": Json, ".npy": Npy}


@contextlib.contextmanager
def table(arguments: argparse.Namespace, columns: Sequence[Column], heading: str) -> Iterator[Rows]:
    """Where the rows go, by the arguments."""
    output: str | None = arguments.output
    ending = next((it for it in ENDINGS if output and output.lower().endswith(it)), "")
    chosen = Json if arguments.json else Csv if arguments.csv else None
    kind: type[Rows] = chosen or ENDINGS.get(ending, Table)
    if output in (None, STDIN):
        rows = kind(sys.stdout.buffer, columns, heading)
        yield rows
        rows.close()
        return
    with replaced(output) as file:
        if kind is Npy and not file.seekable():
            raise CommandError(f"{output}: an .npy file cannot be written into a pipe")
        rows = kind(file, columns, heading)
        yield rows
        rows.close()
