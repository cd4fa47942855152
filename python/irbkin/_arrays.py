"""Arrays of Python code: arguments, as the extension reads its own, and samples of long ones."""

from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin.errors import InvalidMotionError, IrbkinError

Floats = npt.NDArray[np.float64]


def evenly(count: int, most: int) -> npt.NDArray[np.int64]:
    """At most so many indices of a sequence, evenly chosen, both ends included."""
    if count <= most:
        return np.arange(count)
    return np.unique(np.linspace(0, count - 1, most).round().astype(np.int64))


def all_poses(value: Any) -> Any:
    """Return what NumPy is given for a value: of an object of several poses, as spatialmath's
    `SE3`, the list of their matrices, for NumPy would take the first alone; in lists, too.
    """
    if isinstance(value, (list, tuple)):
        if not value or isinstance(value[0], (float, int)):
            return value
        return [all_poses(one) for one in value]
    matrices = getattr(value, "A", None)
    return matrices if isinstance(matrices, list) else value


def as_array(
    value: npt.ArrayLike, name: str, shape: tuple[int | None, ...], error: type[IrbkinError]
) -> Floats:
    """An array of numbers; `None` in a shape is any length but 0. Others raise `error`."""
    wanted = ", ".join("m" if size is None else str(size) for size in shape)
    wanted = f"{name} must have shape ({wanted}{',' * (len(shape) == 1)})"
    try:
        array = np.asarray(all_poses(value), dtype=np.float64)
    except (TypeError, ValueError, RecursionError) as fault:
        raise error(f"{wanted}, got what is no array of numbers: {fault}") from fault
    is_fit = array.ndim == len(shape) and all(
        size == found or (size is None and found > 0)
        for size, found in zip(shape, array.shape, strict=True)
    )
    if not is_fit:
        raise error(f"{wanted}, got {array.shape}")
    return array


def finite(
    value: npt.ArrayLike, name: str, shape: tuple[int | None, ...], error: type[IrbkinError]
) -> Floats:
    """An array without NaN and infinity."""
    array = as_array(value, name, shape, error)
    for index in np.argwhere(~np.isfinite(array)):
        at = ", ".join(map(str, index))
        raise error(f"{name}[{at}] is {array[tuple(index)]}: every element must be finite")
    return array


def rotations(axis: int, angles: Floats) -> Floats:
    """Rotations about x (0), y (1) or z (2) as poses, shape (n, 4, 4)."""
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turns = np.tile(np.eye(4), (len(angles), 1, 1))
    turns[:, first, first] = turns[:, second, second] = np.cos(angles)
    turns[:, second, first] = np.sin(angles)
    turns[:, first, second] = -turns[:, second, first]
    return turns


def limit_of_each(value: npt.ArrayLike, name: str, dof: int) -> Floats:
    """A positive limit for each joint, of a number for all or of one for each."""
    shape = () if np.ndim(value) == 0 else (dof,)
    limits = np.broadcast_to(as_array(value, name, shape, InvalidMotionError), (dof,))
    for index in np.flatnonzero(~(limits > 0.0)):
        raise InvalidMotionError(f"{name}[{index}] is {limits[index]}, it must be positive")
    return limits
