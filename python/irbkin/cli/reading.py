"""Rows of poses and joint angles, in parts, from CSV and .npy files, stdin and RAPID."""

import contextlib
import csv
import io
import itertools
import re
from argparse import ArgumentTypeError
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, BinaryIO, NamedTuple

import numpy as np

from irbkin import pose
from irbkin._arm_options import check_euler, check_millimeters
from irbkin._core import NOT_THERE
from irbkin._words import counted
from irbkin.cli.data import data_of, is_data, split
from irbkin.cli.errors import CommandError, complain
from irbkin.cli.files import opened, shown
from irbkin.cli.numbers import number
from irbkin.cli.output import Floats

PART = 20_000
"""Rows of a part."""
SCALES = {"mm": 1e-3, "m": 1.0, "deg": np.pi / 180, "rad": 1.0, "": 1.0}
OTHER_UNITS = {"mm": "m", "deg": "rad"}
OWN = ("limits", "joint", "confdata")
"""Columns of words that the command writes itself."""
Row = tuple[int, str]
MAGIC = b"\x93NUMPY"
OTHERS = {
    b"PK": "is an archive (.npz, .zip); save one array by numpy.save",
    b"\xff\xfe": "is UTF-16 text; save it as UTF-8",
    b"\xfe\xff": "is UTF-16 text; save it as UTF-8",
}
"""How files begin that are not read."""
QUATERNION_TOLERANCE = 2e-3
MOST_EULER = 2.0 * np.pi + 1e-4
"""The largest Euler angle that the library takes [rad]."""


class Layout(NamedTuple):
    """The meaning of rows: the columns that they may have, as `x_mm`, and the shape in an array."""

    what: str
    choices: tuple[tuple[str, ...], ...]
    shape: tuple[int, ...]

    def words(self) -> str:
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


_XYZ, _EULER = ("x_mm", "y_mm", "z_mm"), ("rz_deg", "ry_deg", "rx_deg")
POSES = Layout("pose", ((*_XYZ, "qw", "qx", "qy", "qz"), (*_XYZ, *_EULER)), (4, 4))


class Part(NamedTuple):
    """Some rows: poses, shape (k, 4, 4) [m], or joint angles, shape (k, dof) [rad]."""

    values: Floats
    names: Mapping[str, Sequence[str]] = {}
    """Columns of words, which are in the output, too."""
    targets: Sequence[Any] = ()
    """The robtargets that they are, or poses."""
    total: int | None = None
    """Number of rows of all parts, if it is known."""


def _text(file: BinaryIO, name: str, layout: Layout) -> Iterator[Part]:
    """The rows of CSV in parts, in meters and radians, and their columns of words.

    The first row may name the columns with their units. Without names, the number of columns
    chooses among the layout's choices.
    """
    lines = io.TextIOWrapper(file, encoding="utf-8-sig", errors="surrogateescape")
    rows = ((at, it) for at, it in enumerate(lines, 1) if it.strip() and it[0] != "#")
    part = list(itertools.islice(rows, PART))
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
        yield Part(values, {it: [row[at] for row in fields] for it, at in words.items()})
        part = list(itertools.islice(rows, PART))
    # The file belongs to the caller.
    lines.detach()


def _numbers(rows: Sequence[Row], name: str, places: Sequence[int], width: int) -> Floats:
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


def read_poses(words: Sequence[str]) -> Iterator[Part]:
    if is_data(words[0]):
        targets, names = _declared(words, 0, "robtarget", "pose")
        yield Part(np.array([it.matrix() for it in targets]), names, targets, len(targets))
        return
    row, name = 0, _one(words)
    for part in _parts(name, POSES):
        is_text = part.values.ndim == 2
        yield part._replace(values=_as_poses(part.values, shown(name), row)) if is_text else part
        row += len(part.values)


def read_joints(words: Sequence[str], dof: int) -> Iterator[Part]:
    if is_data(words[0]):
        targets, names = _declared(words, dof - 6, "jointtarget")
        angles = [[*it.robax_deg, *it.extax][:dof] for it in targets]
        yield Part(np.radians(angles), names, total=len(targets))
        return
    columns = tuple(f"q{number + 1}_deg" for number in range(dof))
    yield from _parts(_one(words), Layout("joint vector", (columns,), (dof,)))


def _declared(
    words: Sequence[str], axes: int, *kinds: str
) -> tuple[list[Any], dict[str, list[str]]]:
    """Values of RAPID of which so many external axes are read, and the column of their names."""
    pairs = [pair for text in split(words) for pair in data_of(text, *kinds)]
    names, targets = [name for name, _ in pairs], [it for _, it in pairs]
    if any(min(it.extax[axes:]) < NOT_THERE for it in targets if hasattr(it, "extax")):
        complain("external axes of the targets are not considered")
    return targets, {"name": names} if any(names) else {}


def _one(words: Sequence[str]) -> str:
    if len(words) > 1:
        raise CommandError(f"{' '.join(words)}: give one file, or RAPID in quotes")
    return words[0]


def _as_poses(rows: Floats, name: str, before: int) -> Floats:
    xyz, turn = rows[:, :3], rows[:, 3:]
    if turn.shape[1] == 3:
        for row in np.flatnonzero((np.abs(turn) > MOST_EULER).any(axis=1))[:1]:
            check_euler(np.degrees(turn[row]).tolist(), f"{name}: row {before + row + 1}")
        return pose(xyz, euler_zyx=turn)
    norms = np.linalg.norm(turn, axis=1)
    for row in np.flatnonzero(~(np.abs(norms - 1.0) <= QUATERNION_TOLERANCE)):
        raise CommandError(
            f"{name}: row {before + row + 1}: the quaternion qw, qx, qy, qz has norm "
            f"{norms[row]:.6g}, it must be 1 to {QUATERNION_TOLERANCE}"
        )
    return pose(xyz, wxyz=turn)


def _parts(name: str, layout: Layout) -> Iterator[Part]:
    count = 0
    with opened(name) as file:
        start = file.peek(len(MAGIC))[: len(MAGIC)]  # type: ignore[attr-defined]
        if start[:2] in OTHERS:
            raise CommandError(f"{shown(name)}: {OTHERS[start[:2]]}")
        read = _array if start == MAGIC else _text
        for part in read(file, shown(name), layout):
            count += len(part.values)
            yield part
    if not count:
        raise CommandError(f"{shown(name)}: has no rows; a {layout.what} has {layout.words()}")


def _array(file: BinaryIO, name: str, layout: Layout) -> Iterator[Part]:
    """Rows of an .npy file, as the package has them."""
    wanted = f"an array of numbers of shape (m, {', '.join(map(str, layout.shape))}) or one row"
    try:
        major, _ = np.lib.format.read_magic(file)
        shape, is_fortran, dtype = getattr(np.lib.format, f"read_array_header_{major}_0")(file)
    except (ValueError, AttributeError) as error:
        raise CommandError(f"{name}: is not a .npy file that can be read: {error}") from None
    if shape == layout.shape:
        shape = (1, *shape)
    if shape[1:] != layout.shape or dtype.kind not in "fiu" or is_fortran:
        order = " in Fortran's order" if is_fortran else ""
        raise CommandError(f"{name}: has {dtype} of shape {shape}{order}, wanted {wanted}")
    size, (total, *_), done = int(np.prod(layout.shape)) * dtype.itemsize, shape, 0
    while done < total:
        rows = min(PART, total - done)
        content = file.read(rows * size)
        if len(content) < rows * size:
            raise CommandError(f"{name}: ends after row {done + len(content) // size} of {total}")
        part = np.frombuffer(content, dtype).reshape(rows, *layout.shape)
        yield Part(part.astype(np.float64), total=total)
        done += rows
