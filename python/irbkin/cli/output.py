"""Rows as a table, CSV, JSON or an array, written part by part."""

from __future__ import annotations

import argparse
import contextlib
import io
import math
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple, TypeAlias

import numpy as np

from irbkin.cli.errors import CommandError
from irbkin.cli.files import replaced

if TYPE_CHECKING:
    import numpy.typing as npt

Values: TypeAlias = "Sequence[Any] | npt.NDArray[Any]"
HEADER = 128
"""Bytes of the header of an .npy file, whose shape is written when it is known."""


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


class Table:
    """Rows on paper, as they are read by people."""

    def __init__(self, file: BinaryIO, columns: Sequence[Column], heading: str) -> None:
        self.file, self.columns, self.heading = file, columns, heading
        self.notes: list[tuple[str, Any, str]] = []
        self.rows = 0

    def put(self, text: str) -> None:
        """Write text."""
        self.file.write(text.encode("utf-8", "backslashreplace"))

    def begin(self) -> None:
        """What stands before the rows."""
        self.widths = []
        names, units = [], []
        for column in self.columns:
            unit = f"[{column.unit}]" if column.unit else ""
            sample = format("" if column.form.endswith("s") else 0, column.form)
            width = max(len(column.name), len(unit), len(sample))
            align = "<" if column.form.startswith("<") else ">"
            self.widths.append(f"{align}{width}")
            names.append(format(column.name, self.widths[-1]))
            units.append(format(unit, self.widths[-1]))
        self.put(f"{self.heading}\n\n{'  '.join(names).rstrip()}\n")
        if any(column.unit for column in self.columns):
            self.put(f"{'  '.join(units).rstrip()}\n")

    def write(self, columns: Sequence[Values], array: npt.NDArray[Any] | None = None) -> None:
        """Some rows, by columns, and the same as an array."""
        lists = [
            values.tolist() if isinstance(values, np.ndarray) else values for values in columns
        ]
        forms = [column.form for column in self.columns]
        self.rows += len(lists[0])
        for row in zip(*lists, strict=True):
            cells = (
                format(_cell(value, form), width)
                for value, form, width in zip(row, forms, self.widths, strict=True)
            )
            self.put(f"{'  '.join(cells).rstrip()}\n")

    def note(self, key: str, value: Any, words: str) -> None:
        """What is said of all rows, behind them."""
        self.notes.append((key, value, words))

    def end(self) -> None:
        """What stands behind the rows."""
        if self.notes:
            self.put("\n" + "".join(f"{words}\n" for _, _, words in self.notes))


def _cell(value: Any, form: str) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "-"
    # Whole numbers with gaps are floats.
    return format(int(value) if form.endswith("d") else value, form.lstrip("<"))


class Csv(Table):
    """Rows for other programs: names with units, then numbers; nothing where there is none."""

    def begin(self) -> None:
        """The names."""
        self.put(",".join(column.key for column in self.columns) + "\n")
        self.form = ",".join("%s" if c.form.endswith("s") else "%.12g" for c in self.columns)

    def write(self, columns: Sequence[Values], array: npt.NDArray[Any] | None = None) -> None:
        """Some rows."""
        lists = []
        has_gaps = False
        for values, column in zip(columns, self.columns, strict=True):
            if column.form.endswith("s"):
                lists.append([_quoted("" if value is None else str(value)) for value in values])
                continue
            numbers = np.asarray(values, dtype=np.float64)
            has_gaps = has_gaps or bool(np.isnan(numbers).any())
            lists.append(numbers.tolist())
        self.rows += len(lists[0])
        rows = zip(*lists, strict=True)
        if has_gaps:
            lines = [",".join(map(_number, row)) for row in rows]
        else:
            lines = [self.form % row for row in rows]
        self.put("\n".join([*lines, ""]))

    def end(self) -> None:
        """Nothing."""


def _number(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "" if math.isnan(value) else f"{value:.12g}"


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if any(it in text for it in ',"\n') else text


class Json(Table):
    """One object with the rows, each an object, and what is said of all."""

    def begin(self) -> None:
        """Its beginning."""
        import json

        self.dumps = json.dumps
        self.put(f'{{"heading": {self.dumps(self.heading)},\n"rows": [')

    def write(self, columns: Sequence[Values], array: npt.NDArray[Any] | None = None) -> None:
        """Some rows."""
        keys = [column.key for column in self.columns]
        lists = [
            values.tolist() if isinstance(values, np.ndarray) else values for values in columns
        ]
        for row in zip(*lists, strict=True):
            comma = ",\n" if self.rows else "\n"
            self.put(comma + self.dumps(dict(zip(keys, map(_plain, row), strict=True))))
            self.rows += 1

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


class Npy(Table):
    """The rows of the array, in radians and meters."""

    def begin(self) -> None:
        """Room for the header."""
        self.shape: tuple[int, ...] = ()
        self.put(" " * HEADER)

    def write(self, columns: Sequence[Values], array: npt.NDArray[Any] | None = None) -> None:
        """Some rows."""
        assert array is not None, "a verb with --output FILE.npy gives arrays"
        self.shape = array.shape[1:]
        self.rows += len(array)
        self.file.write(np.ascontiguousarray(array, dtype="<f8").tobytes())

    def end(self) -> None:
        """The header."""
        header = io.BytesIO()
        content = {"descr": "<f8", "fortran_order": False, "shape": (self.rows, *self.shape)}
        text = repr(content)
        header.write(b"\x93NUMPY\x01\x00" + (HEADER - 10).to_bytes(2, "little"))
        header.write(text.ljust(HEADER - 11).encode() + b"\n")
        self.file.seek(0)
        self.file.write(header.getvalue())


ENDINGS = {".csv": Csv, ".json": Json, ".npy": Npy}


@contextlib.contextmanager
def table(
    arguments: argparse.Namespace, columns: Sequence[Column], heading: str
) -> Iterator[Table]:
    """Where the rows go, by the arguments."""
    output: str | None = arguments.output
    ending = next((it for it in ENDINGS if output and output.lower().endswith(it)), None)
    kind = Json if arguments.json else Csv if arguments.csv else ENDINGS.get(ending or "", Table)
    if output == "-":
        output = None
    if output is None:
        sys.stdout.flush()
        yield from _filled(kind(sys.stdout.buffer, columns, heading))
        return
    with replaced(output) as file:
        if kind is Npy and not file.seekable():
            raise CommandError(f"{output}: an .npy file cannot be written into a pipe")
        yield from _filled(kind(file, columns, heading))


def _filled(rows: Table) -> Iterator[Table]:
    rows.begin()
    yield rows
    rows.end()
    rows.file.flush()
