"""Arms in GLB files that RobotStudio exported: extras of nodes, accepted only if the table puts the
links where the nodes are.
"""

from __future__ import annotations

import json
import struct
from functools import partial
from typing import Any

import numpy as np

from irbkin._core import pose
from irbkin._robotstudio import elements as xml
from irbkin._robotstudio.chains import Arm, arm_of, check_pose, poses_of
from irbkin._robotstudio.containers import MOST_XML
from irbkin._robotstudio.elements import Array, Element
from irbkin._robotstudio.mechanisms import Mechanism
from irbkin.errors import InvalidModelError

FAR = 1e-4
"""How far a node may be from where the table has it [m, 1]: nodes have few decimals."""
KEY = "ABB_ro_int_"
_Node = dict[str, Any]


def mechanisms_of_glb(path: str) -> list[Mechanism]:
    """The mechanisms of a GLB: its nodes that have kinematics."""
    nodes, found = _nodes(path), []
    for index, node in enumerate(nodes):
        extras = node.get("extras")
        text = extras.get(f"{KEY}kinematics") if isinstance(extras, dict) else None
        if isinstance(text, str):
            content = text.encode("utf-8", "surrogatepass")
            for table in xml.elements_of(content, "forwardkinematics"):
                joints = xml.integer(table, "numactivekjoints", "numactivejoints")
                read = partial(_arm, table, nodes, node)
                found.append(Mechanism([str(node.get("name"))], joints, index, read))
    return found


def _nodes(path: str) -> list[_Node]:
    """The nodes of the first chunk, which is JSON."""
    with open(path, "rb") as file:
        header = file.read(20).ljust(20, b"\0")
        version, length = struct.unpack_from("<4xI4xI", header)
        content = file.read(min(length, MOST_XML))
    if version != 2 or header[16:] != b"JSON" or len(content) != length:
        raise InvalidModelError(
            f"is GLB {version} with {len(content)} of {length} bytes of JSON: version 2 is read, "
            f"with at most {MOST_XML} bytes (is the file whole?)"
        )
    try:
        return [dict(node) for node in json.loads(content)["nodes"]]
    except (ValueError, TypeError, KeyError, RecursionError):
        raise InvalidModelError("its JSON is broken or has no nodes") from None


def _arm(table: Element, nodes: list[_Node], node: _Node) -> Arm:
    """The arm of a node with kinematics, proven by the nodes of its links."""
    extras, children = node["extras"], node.get("children")
    mount = extras.get(f"{KEY}mountLinkIndex")
    arm = arm_of(table, mount if isinstance(mount, int) else None)
    q = _floats(extras.get(f"{KEY}jointvalues"))
    if len(q) != len(arm.frames) or not np.isfinite(q).all():
        raise InvalidModelError(f"{KEY}jointvalues has {len(q)} numbers, not {len(arm.frames)}")
    for link, found in zip(arm.links, poses_of(arm, q), strict=True):
        try:
            own = nodes[children[link]]  # type: ignore[index]
            place = _place(own)
        except (LookupError, TypeError, ValueError):
            raise InvalidModelError(f"has no node of link {link} that proves its table") from None
        check_pose(f"link {link} ({own.get('name')})", found, place, FAR)
    offset = _floats(extras.get(f"{KEY}mountOffset"))
    if not offset:
        return arm
    return arm._replace(flange=arm.frames[-1] @ xml.rigid(offset, f"{KEY}mountOffset"))


def _place(node: _Node) -> Array:
    """The pose of a node in its parent."""
    if "matrix" in node:
        return np.reshape(np.array(node["matrix"], dtype=float), (4, 4)).T
    x, y, z, w = node.get("rotation", [0.0, 0.0, 0.0, 1.0])
    return pose(node.get("translation", [0.0, 0.0, 0.0]), wxyz=[w, x, y, z])


def _floats(value: Any) -> list[float]:
    """The numbers of a JSON value in their order: of lists, objects, texts."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for part in value for number in _floats(part)]
    return xml.floats(str(value))
