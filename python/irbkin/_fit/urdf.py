"""The triangles of the links of a URDF, in the frames of the arm."""

from __future__ import annotations

import os
from collections.abc import Mapping
from itertools import product
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from scipy.spatial import ConvexHull  # type: ignore[import-untyped]

from irbkin._core import Robot, _urdf_links, _urdf_text
from irbkin._fit.solid import Array
from irbkin._mesh_files import triangles
from irbkin._urdf import attribute_of, fix, mesh_path, numbers_of, origin_of
from irbkin.errors import InvalidModelError, IrbkinError

# Sides of the prism around a cylinder.
SIDES = 32

Packages = Mapping[str, "str | os.PathLike[str]"]


def fixed(
    text: str | bytes, base: str | None, tip: str | None, joints: Mapping[str, float]
) -> bytes:
    """The text with joints beside the arm, as of a gripper, fixed where they are given."""
    try:
        arm = Robot.from_urdf(text, base, tip)
        moving, rail = arm.joint_names, arm.carrier
    except InvalidModelError:
        # Without these joints there may be an arm.
        moving, rail = (), None
    root = ElementTree.fromstring(_urdf_text(text))
    fix({attribute_of(it, "name"): it for it in root.findall("joint")}, joints, moving)
    text = ElementTree.tostring(root)
    if rail is not None and Robot.from_urdf(text, base, tip).carrier is None:
        raise InvalidModelError("the rail or lift of the arm moves: leave its joint out")
    return text


def links_of(
    text: str | bytes, folder: Path | None, base: str | None, tip: str | None, packages: Packages
) -> tuple[dict[int, Array], dict[str, tuple[int, Array]], str]:
    """The triangles of each link by its number, shape (n, 3, 3), in the frame of the link [m].

    Of the collision elements of a URDF link, or of the visual ones where it has no others. Then, by
    their names, the numbers and triangles, in their own frames, of links behind joints beside the
    arm; and a remark on these.
    """
    root = ElementTree.fromstring(_urdf_text(text))
    elements = {link.get("name"): link for link in root.findall("link")}
    found: dict[int, list[Array]] = {}
    beside: dict[str, tuple[int, Array]] = {}
    links, remark = _urdf_links(text, base, tip)
    for name, number, placed in links:
        link = elements[name]
        parts = []
        for shape in link.findall("collision") or link.findall("visual"):
            try:
                solid = solid_of(shape, name, folder, packages)
                turned = (np.eye(4) if placed is None else placed) @ origin_of(shape)
            except IrbkinError as error:
                raise InvalidModelError(f'link "{name}": {error}') from None
            parts.append(solid @ turned[:3, :3].T + turned[:3, 3])
        if parts and placed is None:
            beside[name] = number, np.concatenate(parts)
        elif parts:
            found.setdefault(number, []).extend(parts)
    if not found and not beside:
        raise InvalidModelError("the links of the URDF have neither collision nor visual elements")
    return {number: np.concatenate(parts) for number, parts in found.items()}, beside, remark


def text_and_folder(urdf: str | bytes | os.PathLike[str]) -> tuple[str | bytes, Path | None]:
    """The text of a URDF, and the folder of its file where it has one."""
    if isinstance(urdf, bytes) or str(urdf).lstrip("\ufeff \t\r\n").startswith("<"):
        return (urdf if isinstance(urdf, bytes) else str(urdf).strip("\ufeff \t\r\n")), None
    path = Path(os.fspath(urdf))
    return path.read_bytes().strip(), path.resolve().parent


def solid_of(
    shape: ElementTree.Element, link: str, folder: Path | None, packages: Packages
) -> Array:
    kinds = [*shape.iterfind("geometry/*")]
    if not kinds:
        raise InvalidModelError("has a shape without geometry")
    kind = kinds[0]

    def given(name: str) -> Array:
        values = numbers_of(kind, name, 3 if name == "size" else 1)
        if not (values > 0).all():
            what = f'{kind.tag} {name} is "{kind.get(name, "")}"'
            raise InvalidModelError(f"{what}, it must be positive")
        return values

    if kind.tag == "mesh":
        scale, name = numbers_of(kind, "scale", 3, 1.0), kind.get("filename", "")
        path = mesh_path(name, folder, packages)
        if path is None:
            raise FileNotFoundError(
                f'the mesh {name} of link "{link}" is not found: pass the folder of its package as '
                "packages={name: folder}"
            )
        return triangles(path) * scale
    if kind.tag == "box":
        return hull(np.array([*product((-1, 1), repeat=3)]) * given("size") / 2)
    if kind.tag == "sphere":
        return hull(ball() * given("radius"))
    if kind.tag in ("cylinder", "capsule"):
        radius, half = given("radius")[0], given("length")[0] / 2
        points = ball() if kind.tag == "capsule" else ring()
        ends = [points * [radius, radius, radius] + [0, 0, half * sign] for sign in (-1, 1)]
        return hull(np.concatenate(ends))
    raise InvalidModelError(f"has a shape <{kind.tag}>, which is not known")


def ring() -> Array:
    angle = np.arange(SIDES) * 2 * np.pi / SIDES
    points = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    return np.asarray(points / np.cos(np.pi / SIDES))


def ball() -> Array:
    """Points whose hull is around the unit ball."""
    heights = np.sin(np.linspace(-np.pi / 2, np.pi / 2, SIDES // 2 + 1))
    rings = [ring() * [np.sqrt(1 - z * z), np.sqrt(1 - z * z), 0] + [0, 0, z] for z in heights]
    return np.asarray(np.concatenate(rings) / np.cos(np.pi / SIDES) ** 2)


def hull(points: Array) -> Array:
    return np.asarray(points[ConvexHull(points).simplices])
