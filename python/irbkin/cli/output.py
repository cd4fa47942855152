"""Rows as a table, CSV, JSON or an array, written part by part."""

import argparse
import contextlib
import csv
import io
import json
import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, BinaryIO, NamedTuple, TypeAlias

import numpy as np

from irbkin._words import visible
from irbkin.cli.errors import CommandError
from irbkin.cli.files import STDIN, replaced


class Column(NamedTuple):
    """A column: its name, how a table shows its values, and their unit."""

    name: str
    form: str = "d"
    unit: str = ""

    @property
    def key(self) -> str:
        return "_".join(filter(None, (self.name, self.unit.replace("/", "_"))))

    def cell(self, value: Any) -> str:
        if value is None or (isinstance(value, float) and math.isnan(value)):
            return "-"
        # Whole numbers with gaps are floats.
        own = visible(value) if isinstance(value, str) else value
        return format(int(own) if self.form[-1] == "d" else own, self.form.lstrip("<"))


Floats: TypeAlias = np.ndarray[Any, np.dtype[np.float64]]
"""Without numpy.typing, which takes 5 ms."""
Columns: TypeAlias = Mapping[Column, Sequence[Any] | np.ndarray[Any, Any]]
Cells: TypeAlias = Sequence[tuple[Any, ...]]
KEYS = ("pose", "slot", "line", "name")
"""Columns that each block of a table has which is wider than the terminal."""
GAP = 2
PAGE = 200
"""Rows of a terminal that are laid out at once: rich takes 0.1 ms for a cell."""
STYLES = {"outside": "red", "left out": "red", "joint move": "yellow"}


class Rows:
    """Where rows go: what each format has of its own is `_begin`, `_add` and `_end`."""

    def __init__(self, file: BinaryIO, heading: str) -> None:
        self.file, self.heading = file, heading
        self.columns: tuple[Column, ...] = ()
        self.notes: list[tuple[str, Any, str]] = []
        self.count = 0

    def put(self, text: str) -> None:
        self.file.write(text.encode("utf-8", "backslashreplace"))

    def write(self, values: Columns, array: Any = None) -> None:
        if not self.columns:
            self.columns = tuple(values)
            self._begin()
        lists = (it.tolist() if isinstance(it, np.ndarray) else it for it in values.values())
        rows = list(zip(*lists, strict=True))
        self._add(rows, array)
        self.count += len(rows)

    def _begin(self) -> None:
        """Nothing comes before the rows."""

    def _add(self, rows: Cells, array: Any) -> None:
        raise NotImplementedError

    def _end(self) -> None:
        """Nothing comes behind the rows."""


class Table(Rows):
    """Rows as text of any width and number; empty without rows."""

    def _begin(self) -> None:
        self.heads = [(it.name, f"[{it.unit}]" if it.unit else "") for it in self.columns]
        self.signs = ["<" if it.form[0] == "<" else ">" for it in self.columns]
        least = (it.cell("" if it.form[-1] == "s" else 0) for it in self.columns)
        cells = zip(self.heads, least, strict=True)
        self.widths = [max(map(len, (*head, it))) for head, it in cells]

    def _add(self, rows: Cells, array: Any) -> None:
        pairs = zip(self.signs, self.widths, strict=True)
        form = (" " * GAP).join(f"{{:{sign}{width}}}" for sign, width in pairs)
        lines = [[it.cell(own) for it, own in zip(self.columns, row, strict=True)] for row in rows]
        if rows and not self.count:
            self.put(f"{visible(self.heading)}\n\n")
            lines = [[*it] for it in zip(*self.heads, strict=True) if any(it)] + lines
        self.put("".join(f"{form.format(*line).rstrip()}\n" for line in lines))

    def _end(self) -> None:
        if notes := [words for _, _, words in self.notes if words]:
            self.put("\n".join(["", *notes, ""]))


class Screen(Table):
    """A table that fits the terminal: in blocks of columns if they are too many."""

    def put(self, text: str) -> None:
        """Write words around the rows."""
        self.console.print(text, end="")

    def _begin(self) -> None:
        from rich.console import Console

        self.console = Console(highlight=False, markup=False, emoji=False)
        super()._begin()

    def _add(self, rows: Cells, array: Any) -> None:
        if rows and not self.count:
            self.console.print(visible(self.heading), style="bold")
        for start in range(0, len(rows), PAGE):
            own = zip(self.columns, zip(*rows[start : start + PAGE], strict=True), strict=True)
            self._page([[*map(it.cell, values)] for it, values in own])

    def _page(self, cells: Sequence[Sequence[str]]) -> None:
        """Write columns, as many beside each other as the terminal has room for."""
        from rich.table import Table as Block

        widths = [max(own, *map(len, it)) for own, it in zip(self.widths, cells, strict=True)]
        room = self.console.width
        gap = GAP if sum(widths) + GAP * len(widths) <= room else 1
        keys = [at for at, it in enumerate(self.columns) if it.name in KEYS]
        left = [at for at in range(len(cells)) if at not in keys]
        while left:
            block = [*keys, left.pop(0)]
            while left and sum(widths[at] + gap for at in (*block, left[0])) <= room:
                block.append(left.pop(0))
            table = Block(box=None, pad_edge=False, padding=(0, gap, 0, 0), header_style="cyan")
            for at in block:
                side: Any = "left" if self.signs[at] == "<" else "right"
                head = "\n".join(filter(None, self.heads[at]))
                table.add_column(head, justify=side, no_wrap=True, width=widths[at])
            for row in zip(*(cells[at] for at in block), strict=True):
                table.add_row(*row, style=next((STYLES[it] for it in row if it in STYLES), None))
            self.console.print("", table, sep="\n")


class Csv(Rows):
    """Rows for other programs: names with units, then numbers; empty where one is missing."""

    def _begin(self) -> None:
        self._add([tuple(column.key for column in self.columns)], None)

    def _add(self, rows: Cells, array: Any) -> None:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows([map(_short, row) for row in rows])
        self.put(text.getvalue())


def _short(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "" if value is None or math.isnan(value) else f"{value:.12g}"


class Json(Rows):
    """One object with the rows, each an object, and what is said of all."""

    def _begin(self) -> None:
        self.put(f'{{"heading": {json.dumps(self.heading)},\n"rows": [')

    def _add(self, rows: Cells, array: Any) -> None:
        keys = [column.key for column in self.columns]
        texts = (json.dumps(dict(zip(keys, map(_plain, row), strict=True))) for row in rows)
        if rows:
            self.put((",\n" if self.count else "\n") + ",\n".join(texts))

    def _end(self) -> None:
        notes = (f",\n{json.dumps(key)}: {json.dumps(_plain(it))}" for key, it, _ in self.notes)
        self.put(f"\n]{''.join(notes)}}}\n")


def _plain(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.12g}") if math.isfinite(value) else None
    return value.item() if isinstance(value, np.generic) else value


class Npy(Rows):
    """The rows of the array, in radians and meters."""

    shape: tuple[int, ...] = ()

    def write(self, values: Columns, array: Any = None) -> None:
        if not self.shape:
            self.shape = (0, *array.shape[1:])
            self._head()
        self.shape = (self.shape[0] + len(array), *self.shape[1:])
        self.file.write(np.ascontiguousarray(array, dtype="<f8").tobytes())

    def _end(self) -> None:
        # With the number of rows: NumPy pads it to the same size.
        self.file.seek(0)
        self._head()

    def _head(self) -> None:
        content = {"descr": "<f8", "fortran_order": False, "shape": self.shape}
        np.lib.format.write_array_header_1_0(self.file, content)


FORMATS = {".csv": Csv, ".json": Json, ".npy": Npy}


@contextlib.contextmanager
def table(arguments: argparse.Namespace, heading: str) -> Iterator[Rows]:
    output: str = arguments.output or STDIN
    ending = ".json" if arguments.json else ".csv" if arguments.csv else output.lower()
    kind: type[Rows] = next((it for end, it in FORMATS.items() if ending.endswith(end)), Table)
    stream = contextlib.nullcontext(sys.stdout.buffer) if output == STDIN else replaced(output)
    if output == STDIN and kind is Table and sys.stdout.isatty():
        kind = Screen
    with stream as file:
        if kind is Npy and not file.seekable():
            raise CommandError(f"{output}: an .npy file cannot be written into a pipe")
        rows = kind(file, heading)
        yield rows
        rows._end()
        file.flush()


def show(
    arguments: argparse.Namespace, heading: str, values: Columns, array: Any = None, *notes: Any
) -> None:
    """Write rows that are all there, and notes behind them: a key, a value, words."""
    with table(arguments, heading) as rows:
        rows.write(values, array)
        rows.notes += notes
