"""Cells from URDF: the collision geometry of all that stands still.

Links that fixed joints hold at the root are obstacles. The first joint that moves begins the arm:
its parent is link 0, what is below it moves.
"""

from __future__ import annotations

import os
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from irbkin._core import Cell, Shape, _urdf_text, pose
from irbkin._mesh_files import mesh, triangles
from irbkin.errors import InvalidModelError, IrbkinError

_LAST_LINK = 7


def cell_of_urdf(content: bytes, path: str, solid: bool) -> Cell:
    """The cell of a URDF, and of an SRDF of its name beside it."""
    root = _xml(content)
    below: dict[str, list[ElementTree.Element]] = {}
    for joint in root.findall("joint"):
        below.setdefault(_end(joint, "parent"), []).append(joint)
    children = {_end(joint, "child") for joints in below.values() for joint in joints}
    links = {_attribute(link, "name"): link for link in root.findall("link")}
    if unknown := sorted({*below, *children} - {*links}):
        raise InvalidModelError(f"there is no link {unknown[0]}, of which a joint is")
    tops = [name for name in links if name not in children]
    if len(tops) != 1:
        raise InvalidModelError(f"must have one root link, has {tops}")
    poses, numbers = _walk(tops[0], below)
    shapes = {}
    for name, at in poses.items():
        folder = os.path.dirname(path)
        if name not in numbers and (parts := _shapes(links[name], folder, solid)):
            shapes[name] = Shape.union(parts).moved(at)
    return Cell(shapes, 0.0, _pairs(os.path.splitext(path)[0] + ".srdf", shapes, numbers))


def _xml(content: bytes) -> ElementTree.Element:
    try:
        return ElementTree.fromstring(_urdf_text(content))
    except ElementTree.ParseError as error:
        raise InvalidModelError(f"is not XML: {error}") from None


def _walk(
    top: str, below: dict[str, list[ElementTree.Element]]
) -> tuple[dict[str, npt.NDArray[np.float64]], dict[str, int]]:
    """The poses of links that stand still, and the numbers of the links of the arm."""
    poses: dict[str, npt.NDArray[np.float64]] = {top: np.eye(4)}
    numbers: dict[str, int] = {}
    first, seen, waiting = None, {top}, [top]
    while waiting:
        name = waiting.pop(0)
        for joint in below.get(name, []):
            child, kind = _end(joint, "child"), _attribute(joint, "type")
            if child in seen:
                raise InvalidModelError(f"two joints lead to the link {child}")
            seen.add(child)
            waiting.append(child)
            if kind == "fixed" and name in poses:
                poses[child] = poses[name] @ _origin(joint)
            elif kind == "fixed":
                numbers[child] = numbers[name]
            else:
                if name in poses:
                    own = _attribute(joint, "name")
                    if first is not None:
                        raise InvalidModelError(
                            f"the joints {first} and {own} both begin an arm: a cell is around one "
                            "arm; make the joints of the others fixed"
                        )
                    first, numbers[name] = own, 0
                numbers[child] = numbers[name] + 1
    return poses, numbers


def _shapes(link: ElementTree.Element, folder: str, solid: bool) -> list[Shape]:
    shapes = []
    for collision in link.findall("collision"):
        try:
            geometry = collision.find("geometry")
            if geometry is None or len(geometry) != 1:
                raise InvalidModelError("geometry must have one shape")
            shapes.append(_shape(geometry[0], folder, solid).moved(_origin(collision)))
        except IrbkinError as error:
            raise InvalidModelError(f"link {_attribute(link, 'name')}: {error}") from None
    return shapes


def _shape(element: ElementTree.Element, folder: str, solid: bool) -> Shape:
    if element.tag == "box":
        return Shape.box(_numbers(element, "size", 3))
    if element.tag == "sphere":
        return Shape.sphere(_number(element, "radius"), np.zeros(3))
    if element.tag == "cylinder":
        return Shape.cylinder(_number(element, "radius"), _number(element, "length"))
    if element.tag == "capsule":
        half = np.array([0.0, 0.0, 0.5 * _number(element, "length")])
        return Shape.capsule(-half, half, _number(element, "radius"))
    if element.tag == "mesh":
        scale = _numbers(element, "scale", 3) if "scale" in element.attrib else np.ones(3)
        return mesh(triangles(_file(_attribute(element, "filename"), folder)) * scale, solid)
    raise InvalidModelError(
        f"unknown shape {element.tag}; known: box, sphere, cylinder, capsule, mesh"
    )


def _file(name: str, folder: str) -> str:
    """The path of a mesh: of package://name/path, beside the URDF or in a folder above it."""
    scheme, _, rest = name.rpartition("://")
    if scheme == "file":
        return rest
    places = [rest]
    if scheme == "package":
        places.append(rest.partition("/")[2])
    here = os.path.abspath(folder)
    while True:
        for place in places:
            if os.path.isfile(path := os.path.join(here, place)):
                return path
        above = os.path.dirname(here)
        if scheme != "package" or above == here:
            raise InvalidModelError(f"the mesh {name} is neither beside the URDF nor above it")
        here = above


def _pairs(path: str, shapes: dict[str, Shape], numbers: dict[str, int]) -> list[tuple[str, int]]:
    """The pairs of an obstacle and a link that an SRDF leaves out."""
    if not os.path.isfile(path):
        return []
    with open(path, "rb") as file:
        root = _xml(file.read())
    pairs = []
    for disabled in root.findall("disable_collisions"):
        one, other = _attribute(disabled, "link1"), _attribute(disabled, "link2")
        for obstacle, link in [(one, other), (other, one)]:
            if obstacle in shapes and 1 <= numbers.get(link, 0) <= _LAST_LINK:
                pairs.append((obstacle, numbers[link]))
    return pairs


def _origin(element: ElementTree.Element) -> npt.NDArray[np.float64]:
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    xyz = _numbers(origin, "xyz", 3) if "xyz" in origin.attrib else np.zeros(3)
    roll_pitch_yaw = _numbers(origin, "rpy", 3) if "rpy" in origin.attrib else np.zeros(3)
    return pose(xyz, euler_zyx=roll_pitch_yaw[::-1])


def _end(joint: ElementTree.Element, which: str) -> str:
    end = joint.find(which)
    if end is None:
        raise InvalidModelError(f"the joint {_attribute(joint, 'name')} has no {which}")
    return _attribute(end, "link")


def _attribute(element: ElementTree.Element, key: str) -> str:
    value = element.get(key)
    if value is None:
        raise InvalidModelError(f"{element.tag} has no {key}")
    return value


def _number(element: ElementTree.Element, key: str) -> float:
    return float(_numbers(element, key, 1)[0])


def _numbers(element: ElementTree.Element, key: str, count: int) -> npt.NDArray[np.float64]:
    text = _attribute(element, key)
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.empty(0)
    if len(numbers) != count:
        raise InvalidModelError(f"{key} of {element.tag} is {text!r}, it must be {count} numbers")
    return numbers
