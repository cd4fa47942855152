"""Rows of poses and joint angles, in parts, from CSV and .npy files and stdin."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from irbkin import pose
from irbkin._arm_options import check_euler
from irbkin.cli.errors import CommandError
from irbkin.cli.files import opened, shown
from irbkin.cli.text_rows import PART, Layout, read_text

if TYPE_CHECKING:
    from irbkin._arrays import Floats

MAGIC = b"\x93NUMPY"
QUATERNION_TOLERANCE = 2e-3
MOST_EULER = 2.0 * np.pi + 1e-4
"""The largest Euler angle that the library takes [rad]."""
_XYZ = ("x_mm", "y_mm", "z_mm")
POSES = Layout(
    "pose",
    ((*_XYZ, "qw", "qx", "qy", "qz"), (*_XYZ, "rz_deg", "ry_deg", "rx_deg")),
    (4, 4),
)


def read_poses(name: str) -> Iterator[Floats]:
    """Poses in parts, shape (k, 4, 4), translation [m]."""
    row = 0
    for rows, is_array in _parts(name, POSES):
        yield rows if is_array else _as_poses(rows, shown(name), row)
        row += len(rows)


def read_joints(name: str, dof: int) -> Iterator[Floats]:
    """Joint angles in parts, shape (k, dof) [rad]."""
    columns = tuple(f"q{number + 1}_deg" for number in range(dof))
    for rows, _ in _parts(name, Layout("joint vector", (columns,), (dof,))):
        yield rows


def read_all(parts: Iterator[Floats]) -> Floats:
    """All rows at once."""
    return np.concatenate(list(parts))


def _as_poses(rows: Floats, name: str, before: int) -> Floats:
    """Poses of rows in meters and radians."""
    xyz, turn = rows[:, :3], rows[:, 3:]
    if turn.shape[1] == 3:
        for row in np.flatnonzero((np.abs(turn) > MOST_EULER).any(axis=1))[:1]:
            check_euler(np.degrees(turn[row]).tolist(), f"{name}: row {before + row + 1}")
        return pose(xyz, euler_zyx=turn)
    norms = np.linalg.norm(turn, axis=1)
    wrong = ~(np.abs(norms - 1.0) <= QUATERNION_TOLERANCE)
    for row in np.flatnonzero(wrong):
        raise CommandError(
            f"{name}: row {before + row + 1}: the quaternion qw, qx, qy, qz has norm "
            f"{norms[row]:.6g}, it must be 1 to {QUATERNION_TOLERANCE}"
        )
    return pose(xyz, wxyz=turn)


def _parts(name: str, layout: Layout) -> Iterator[tuple[Floats, bool]]:
    """Rows in parts, and whether they come from an array."""
    count = 0
    with opened(name) as file:
        start = file.peek(len(MAGIC))[: len(MAGIC)]  # type: ignore[attr-defined]
        if start[:4] == b"PK\x03\x04":
            raise CommandError(
                f"{shown(name)}: is an archive (.npz, .zip); save one array by numpy.save"
            )
        if start[:2] in (b"\xff\xfe", b"\xfe\xff"):
            raise CommandError(f"{shown(name)}: is UTF-16 text; save it as UTF-8")
        is_array = start == MAGIC
        rows = _array(file, name, layout) if is_array else read_text(file, name, layout)
        for part in rows:
            count += len(part)
            yield part, is_array
    if not count:
        raise CommandError(f"{shown(name)}: has no rows; a {layout.what} has {layout.words()}")


def _array(file: BinaryIO, name: str, layout: Layout) -> Iterator[Floats]:
    """Rows of an .npy file, as the package has them."""
    wanted = f"an array of numbers of shape (m, {', '.join(map(str, layout.shape))}) or one row"
    try:
        version = np.lib.format.read_magic(file)
        read = getattr(np.lib.format, f"read_array_header_{version[0]}_0")
        shape, is_fortran, dtype = read(file)
    except (ValueError, AttributeError) as error:
        raise CommandError(f"{shown(name)}: is not a .npy file that can be read: {error}") from None
    if shape == layout.shape:
        shape = (1, *shape)
    if shape[1:] != layout.shape or dtype.kind not in "fiu" or is_fortran:
        order = " in Fortran's order" if is_fortran else ""
        raise CommandError(f"{shown(name)}: has {dtype} of shape {shape}{order}, wanted {wanted}")
    size = int(np.prod(layout.shape)) * dtype.itemsize
    total, done = shape[0], 0
    while done < total:
        rows = min(max(PART // size, 1), total - done)
        content = file.read(rows * size)
        if len(content) < rows * size:
            row = done + len(content) // size
            raise CommandError(f"{shown(name)}: ends after row {row} of {total}")
        part = np.frombuffer(content, dtype).reshape(rows, *layout.shape)
        yield part.astype(np.float64)
        done += rows
