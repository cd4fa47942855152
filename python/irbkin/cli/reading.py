"""Rows of poses and joint angles, in parts, from CSV and .npy files, stdin and RAPID."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, BinaryIO, NamedTuple

import numpy as np

from irbkin import pose
from irbkin._arm_options import check_euler
from irbkin._core import NOT_THERE
from irbkin.cli.data import data_of, is_data, split
from irbkin.cli.errors import CommandError, complain
from irbkin.cli.files import opened, shown
from irbkin.cli.output import Floats
from irbkin.cli.text_rows import PART, Layout, read_text

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


def read_poses(words: Sequence[str]) -> Iterator[Part]:
    """Poses in parts, of a file or of robtargets."""
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
    """Joint angles in parts, of a file or of jointtargets."""
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
    """Poses of rows in meters and radians."""
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
    """Rows in parts: arrays of the layout's shape, or of text."""
    count = 0
    with opened(name) as file:
        start = file.peek(len(MAGIC))[: len(MAGIC)]  # type: ignore[attr-defined]
        if start[:2] in OTHERS:
            raise CommandError(f"{shown(name)}: {OTHERS[start[:2]]}")
        if start == MAGIC:
            parts = _array(file, shown(name), layout)
        else:
            parts = (Part(*pair) for pair in read_text(file, name, layout))
        for part in parts:
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
