"""Mechanisms of stations and libraries: definitions, and instances that refer to them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from irbkin._robotstudio import elements as xml
from irbkin._robotstudio.chains import Arm, arm_of, check_pose, limits_of, poses_of
from irbkin._robotstudio.elements import Array, Element
from irbkin._robotstudio.mechanisms import Mechanism
from irbkin.errors import InvalidModelError

FAR = 1e-6
"""How far apart a file may have the same frame [m, 1]."""
INSTANCE, LINK, DEFINITION = "mechanisminstance", "mechanismlinkinstance", "mechanismdef"
TABLE, REFERENCE = "forwardkinematicsdh", "docref"
_Elements = dict[str, dict[int, Element]]


class _Link(NamedTuple):
    name: str
    frame: Array
    """In the base at zero joints."""
    pose: Array
    """In the base at the joints of the instance."""


def mechanisms_of(documents: Iterable[tuple[str, bytes]]) -> list[Mechanism]:
    """The mechanisms of documents: instances, then definitions that have none."""
    read = [(name, _by_kind(content)) for name, content in documents]
    libraries, found, used = dict(read), [], set()
    for name, own in read:
        for instance in own[INSTANCE].values():
            home, key = _definition(name, own, instance)
            used.add((home, key))
            links = _links(own, instance)
            found.append(_mechanism(libraries.get(home, {}), (home, key), instance, links))
    for name, own in read:
        unused = [key for key in own[DEFINITION] if (name, key) not in used]
        found += [_mechanism(own, (name, key), None, []) for key in unused]
    return found


def _by_kind(content: bytes) -> _Elements:
    elements: _Elements = {kind: {} for kind in (INSTANCE, LINK, DEFINITION, TABLE, REFERENCE)}
    for element in xml.elements_of(content, *elements):
        elements[xml.local(element)][xml.integer(element, "id")] = element
    return elements


def _definition(name: str, own: _Elements, instance: Element) -> tuple[str, int]:
    """The library and the number of the definition of an instance."""
    reference = xml.child(instance, "definition")
    if reference is None:
        return name, -1
    key, library = xml.integer(reference, "id"), xml.word(reference, "docid") or "-1"
    if library == "-1":
        return name, key
    location = xml.word(own[REFERENCE].get(xml.integer(reference, "docid")), "location")
    return re.split(r"[\\/]", location)[-1].lower(), key


def _links(own: _Elements, instance: Element) -> list[_Link]:
    """The links of an instance, in the order in which a table counts them."""
    links = []
    for reference in xml.parts(instance, "childinstances"):
        element = own[LINK].get(xml.integer(reference, "id"))
        correction, pose = (xml.child(element, it) for it in ("correctiontransform", "transform"))
        if correction is not None and pose is not None:
            frame = np.asarray(np.linalg.inv(xml.transform(correction)), dtype=float)
            links.append(_Link(xml.word(element, "name"), frame, xml.transform(pose) @ frame))
    return links


def _mechanism(
    home: _Elements, same: tuple[str, int], instance: Element | None, links: list[_Link]
) -> Mechanism:
    definition = home.get(DEFINITION, {}).get(same[1])
    reference = xml.child(definition, "forwardkinematics")
    table = None if reference is None else home[TABLE].get(xml.integer(reference, "id"))
    given = (xml.word(instance, "name"), xml.word(definition, "modelname"))
    names = [it for it in given if it] or ["an arm without a name"]
    counts = ((table, "numactivekjoints"), (instance, "numjoints"))
    joints = next((xml.integer(it, key) for it, key in counts if it is not None), 0)

    def read() -> Arm:
        if instance is not None and any(xml.numbers(xml.child(instance, "jointmodeloffset"))):
            raise InvalidModelError("has a JointModelOffset, which is not supported")
        if definition is not None and table is not None:
            arm = _by_definition(definition, table, links)
        else:
            assert instance is not None
            arm = _by_links(instance, links, joints)
        own = None if instance is None else limits_of(instance, joints)
        return arm if own is None else arm._replace(limits=own)

    own_limits = xml.numbers(xml.child(instance, "jointlimitsvector"))
    return Mechanism(names, joints, (same, *own_limits), read)


def _by_definition(definition: Element, table: Element, links: list[_Link]) -> Arm:
    """The arm of a definition; links of an instance must be where its table has them."""
    base = xml.child(definition, "modelbaseframe")
    odd = {
        "UsingCustomFwdKin": xml.word(definition, "usingcustomfwdkin").lower() == "true",
        "KinematicsCLSID": xml.word(definition, "kinematicsclsid") != "",
        "ModelBaseFrame": base is not None and (xml.transform(base) != np.eye(4)).any(),
        "JointZeroPosition": any(xml.numbers(xml.child(table, "jointzeroposition"))),
        "UserDefinedKinBaseFrame": any(xml.numbers(xml.child(table, "userdefinedkinbaseframe"))),
    }
    if found := [name for name, is_there in odd.items() if is_there]:
        raise InvalidModelError(f"has a {found[0]} (as closed loops have), which is not supported")
    flanges = xml.parts(definition, "flanges")
    if len(flanges) > 1:
        raise InvalidModelError(f"has {len(flanges)} flanges, an arm has one")
    arm = arm_of(table, xml.integer(flanges[0], "linkindex") if flanges else None)
    if links and max(arm.links) >= len(links):
        raise InvalidModelError(f"has {len(links)} links, none of the number {max(arm.links)}")
    for link, frame in zip(arm.links if links else (), arm.frames, strict=False):
        check_pose(f"link {link} ({links[link].name})", frame, links[link].frame, FAR)
    offset = xml.child(flanges[0], "offsettransform") if flanges else None
    return arm if offset is None else arm._replace(flange=xml.transform(offset))


def _by_links(instance: Element, links: list[_Link], joints: int) -> Arm:
    """The axes of an instance whose definition is in another file."""
    numbered = [it for it in links if re.fullmatch(r"link\d+", it.name.lower())]
    chain = links[1:] if len(links) == joints + 1 else numbered
    q = xml.numbers(xml.child(instance, "jointvalues"))
    if len(chain) != joints or len(q) != joints:
        raise InvalidModelError(f"has {len(chain)} links and {len(q)} values of {joints} joints")
    arms = [Arm(np.array([it.frame for it in chain]), [], linkage) for linkage in (0.0, -1.0, 1.0)]
    poses = np.array([it.pose for it in chain])
    fitting = [it for it in arms if np.abs(poses_of(it, q) - poses).max() < FAR]
    if len(fitting) == 1:
        return fitting[0]
    if rods := [it.name for it in links if re.match("link[a-z]", it.name.lower())]:
        raise InvalidModelError(
            f"its table is in a library, and its pose does not show whether {rods[0]} turns joint "
            "3 with joint 2: save the station with joint 2 off zero, or read the library"
        )
    # Without rods it is serial; a pose may be older than its joints.
    return arms[0]
