"""Cells from URDF: the collision geometry of all that stands still.

Links at the root are obstacles, behind fixed joints and behind those whose positions are given. One
joint that is not may begin the arm: its parent is link 0, what is below it moves.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import NoReturn
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from irbkin._core import Cell, Shape, _urdf_text
from irbkin._mesh_files import mesh, triangles
from irbkin._urdf import (
    attribute_of,
    described,
    fix,
    follows,
    mesh_path,
    number_of,
    numbers_of,
    origin_of,
)
from irbkin.errors import InvalidModelError, IrbkinError

_LAST_LINK = 7
# Joints of the shortest arm that irbkin solves.
_LEAST_JOINTS = 6


def cell_of_urdf(content: bytes, path: str, joints: Mapping[str, float], solid: bool) -> Cell:
    """The cell of a URDF with some joints at positions, and of an SRDF of its name beside it."""
    root = _xml(content)
    below: dict[str, list[ElementTree.Element]] = {}
    for joint in root.findall("joint"):
        below.setdefault(_end(joint, "parent"), []).append(joint)
    children = {_end(joint, "child") for joints in below.values() for joint in joints}
    links, joint_of = _by_name(root, "link"), _by_name(root, "joint")
    if unknown := sorted({*below, *children} - {*links}):
        raise InvalidModelError(f"there is no link {unknown[0]}, of which a joint is")
    tops = [name for name in links if name not in children]
    if len(tops) != 1:
        raise InvalidModelError(f"must have one root link, has {tops}")
    fix(joint_of, joints, ())
    movable = {name: it for name, it in joint_of.items() if attribute_of(it, "type") != "fixed"}
    poses, numbers = _walk(tops[0], below, movable)
    if lost := sorted({*links} - {*poses, *numbers}):
        raise InvalidModelError(f"the link {lost[0]} hangs on itself, by joints in a circle")
    shapes, folder = {}, Path(os.path.abspath(path)).parent
    for name, at in poses.items():
        if name not in numbers and (parts := _shapes(links[name], folder, solid)):
            shapes[name] = Shape.union(parts).moved(at)
    seen = [own for own in poses if own not in numbers and links[own].find("visual") is not None]
    if seen and not shapes:
        raise InvalidModelError(f"only visual shapes stand still, none of collision: {seen[0]}")
    return Cell(shapes, 0.0, _pairs(os.path.splitext(path)[0] + ".srdf", shapes, numbers))


def _xml(content: bytes) -> ElementTree.Element:
    try:
        return ElementTree.fromstring(_urdf_text(content))
    except ElementTree.ParseError as error:
        raise InvalidModelError(f"is not XML: {error}") from None


def _by_name(root: ElementTree.Element, tag: str) -> dict[str, ElementTree.Element]:
    found: dict[str, ElementTree.Element] = {}
    for element in root.findall(tag):
        if found.setdefault(name := attribute_of(element, "name"), element) is not element:
            raise InvalidModelError(f"two {tag}s have the name {name}")
    return found


def _walk(
    top: str,
    below: dict[str, list[ElementTree.Element]],
    movable: dict[str, ElementTree.Element],
) -> tuple[dict[str, npt.NDArray[np.float64]], dict[str, int]]:
    """The poses of links that stand still, and the numbers of the links of the arm."""
    poses: dict[str, npt.NDArray[np.float64]] = {top: np.eye(4)}
    numbers: dict[str, int] = {}
    # The joint that each link is behind which moves, and the most joints behind each of these.
    first: dict[str, str] = {}
    most: dict[str, int] = {}
    seen, waiting = {top}, [top]
    while waiting:
        parent = waiting.pop(0)
        for joint in below.get(parent, []):
            child, name = _end(joint, "child"), attribute_of(joint, "name")
            if child in seen:
                raise InvalidModelError(f"two joints lead to the link {child}")
            seen.add(child)
            waiting.append(child)
            if parent in poses and name not in movable:
                poses[child] = poses[parent] @ origin_of(joint)
                continue
            first[child] = first.get(parent, name)
            numbers[child] = numbers.setdefault(parent, 0) + (name in movable)
            most[first[child]] = max(most.get(first[child], 0), numbers[child])
    arms = [name for name, count in most.items() if count >= _LEAST_JOINTS]
    if len(most) > len(arms) or len(arms) > 1:
        given = {
            name: joint
            for name, joint in movable.items()
            if not (len(arms) == 1 and first.get(_end(joint, "child")) == arms[0])
        }
        own = [name for name in most if not follows(movable[name], movable)]
        _ask(own or [*most], given, movable)
    return poses, numbers


def _ask(
    names: list[str],
    given: dict[str, ElementTree.Element],
    movable: dict[str, ElementTree.Element],
) -> NoReturn:
    """Ask for the positions of joints, of which some begin what moves."""
    free = [joint for joint in given.values() if not follows(joint, movable)]
    begin = f"{' and '.join(names)} {['begins', 'both begin', 'all begin'][min(len(names), 3) - 1]}"
    raise InvalidModelError(
        f"the joint{'s' * (len(names) > 1)} {begin} an arm or what moves beside it: a cell is "
        f"around one arm, of {_LEAST_JOINTS} joints or more. Give where the others are, as "
        f'joints={{"{next(iter(given))}": 0}}: {", ".join(map(described, free))}'
    )


def _shapes(link: ElementTree.Element, folder: Path, solid: bool) -> list[Shape]:
    shapes = []
    for collision in link.findall("collision"):
        try:
            geometry = collision.find("geometry")
            if geometry is None or len(geometry) != 1:
                raise InvalidModelError("geometry must have one shape")
            shapes.append(_shape(geometry[0], folder, solid).moved(origin_of(collision)))
        except IrbkinError as error:
            raise InvalidModelError(f"link {attribute_of(link, 'name')}: {error}") from None
    return shapes


def _shape(element: ElementTree.Element, folder: Path, solid: bool) -> Shape:
    if element.tag == "box":
        return Shape.box(numbers_of(element, "size", 3))
    if element.tag == "sphere":
        return Shape.sphere(number_of(element, "radius"), np.zeros(3))
    if element.tag == "cylinder":
        return Shape.cylinder(number_of(element, "radius"), number_of(element, "length"))
    if element.tag == "capsule":
        half = np.array([0.0, 0.0, 0.5 * number_of(element, "length")])
        return Shape.capsule(-half, half, number_of(element, "radius"))
    if element.tag == "mesh":
        scale, name = numbers_of(element, "scale", 3, 1.0), attribute_of(element, "filename")
        path = mesh_path(name, folder, {})
        if path is None:
            raise InvalidModelError(f"the mesh {name} is neither beside the file nor above it")
        return mesh(triangles(path) * scale, solid)
    raise InvalidModelError(
        f"unknown shape {element.tag}; known: box, sphere, cylinder, capsule, mesh"
    )


def _pairs(path: str, shapes: dict[str, Shape], numbers: dict[str, int]) -> list[tuple[str, int]]:
    if not os.path.isfile(path):
        return []
    with open(path, "rb") as file:
        root = _xml(file.read())
    pairs = []
    for disabled in root.findall("disable_collisions"):
        one, other = attribute_of(disabled, "link1"), attribute_of(disabled, "link2")
        for obstacle, link in [(one, other), (other, one)]:
            if obstacle in shapes and 1 <= numbers.get(link, 0) <= _LAST_LINK:
                pairs.append((obstacle, numbers[link]))
    return pairs


def _end(joint: ElementTree.Element, which: str) -> str:
    end = joint.find(which)
    if end is None:
        raise InvalidModelError(f"the joint {attribute_of(joint, 'name')} has no {which}")
    return attribute_of(end, "link")
