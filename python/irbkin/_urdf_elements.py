"""Attributes of the elements of a URDF, checked."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np

from irbkin._core import pose
from irbkin.errors import InvalidModelError

if TYPE_CHECKING:
    import numpy.typing as npt


def attribute_of(element: ElementTree.Element, key: str) -> str:
    """An attribute that must be there."""
    value = element.get(key)
    if value is None:
        raise InvalidModelError(f"{element.tag} has no {key}")
    return value


def number_of(element: ElementTree.Element, key: str, default: float | None = None) -> float:
    return float(numbers_of(element, key, 1, default)[0])


def numbers_of(
    element: ElementTree.Element, key: str, count: int, default: float | None = None
) -> npt.NDArray[np.float64]:
    """So many numbers; the default for each if the attribute is not there."""
    if default is not None and key not in element.attrib:
        return np.full(count, default)
    text = attribute_of(element, key)
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.empty(0)
    if len(numbers) != count or not np.isfinite(numbers).all():
        many = f"{count} numbers" if count > 1 else "a number"
        raise InvalidModelError(f"{key} of {element.tag} is {text!r}, it must be {many}")
    return numbers


def mesh_path(
    name: str, folder: Path | None, packages: Mapping[str, str | os.PathLike[str]]
) -> Path | None:
    """The file of a mesh or None: `package://` of `packages`, else beside the URDF or above it."""
    if not name.startswith("package://"):
        paths = [(folder or Path()) / name.removeprefix("file://")]
    else:
        package, _, rest = name.removeprefix("package://").partition("/")
        above = [] if folder is None else [folder, *folder.parents]
        paths = [at / part for at in above for part in (f"{package}/{rest}", rest)]
        if package in packages:
            paths = [Path(packages[package]) / rest]
    return next(filter(os.path.isfile, paths), None)


def origin_of(element: ElementTree.Element) -> npt.NDArray[np.float64]:
    """The pose of an element in the one that it is in, by `rpy` or by URDF 1.1's `quat_xyzw`."""
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    xyz = numbers_of(origin, "xyz", 3, 0.0)
    if "quat_xyzw" not in origin.attrib:
        return pose(xyz, euler_zyx=numbers_of(origin, "rpy", 3, 0.0)[::-1])
    if "rpy" in origin.attrib:
        raise InvalidModelError("origin has rpy and quat_xyzw, it must have one of them")
    return pose(xyz, wxyz=np.roll(numbers_of(origin, "quat_xyzw", 4), 1))
