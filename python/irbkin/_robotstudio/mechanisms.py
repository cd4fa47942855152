"""Mechanisms of stations and libraries: definitions, and instances that refer to them; the choice
of one, and the robot that it is.
"""

import re
from collections.abc import Callable, Hashable, Iterable
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot, to_xyz_euler_zyx
from irbkin._robotstudio import elements as xml
from irbkin._robotstudio.chains import MOST_NUMBER, Arm, arm_of, check_pose, limits_of, poses_of
from irbkin._robotstudio.elements import Element
from irbkin._words import listed
from irbkin.errors import InvalidModelError

SNAP = 1e-6
"""Angles within it of a multiple of 90 deg are made exact [rad]: all of six decimals."""
DECIMALS = 12
"""Of lengths [m]: files have 0.0300000000000276."""
CLOSE = 1e-5
"""How far a robot may be from its file for these two [m, 1]."""
PROBES = np.array([[0.9, 0.7, -0.8, 1.1, 0.6, -1.2, 0.5], [-0.4, 1.3, 0.2, -2.0, -1.1, 0.8, 1.7]])
"""Joints at which it is compared with it [rad]."""
FAR = 1e-6
"""How far apart a file may have the same frame [m, 1]."""
INSTANCE, LINK, DEFINITION = "mechanisminstance", "mechanismlinkinstance", "mechanismdef"
TABLE, REFERENCE = "forwardkinematicsdh", "docref"
_Elements = dict[str, dict[int, Element]]


class Mechanism(NamedTuple):
    """A mechanism of a file: an arm, a positioner, a gripper, a tool."""

    names: list[str]
    """Its own, and its model's."""
    joints: int
    same: Hashable
    """Equal for two of one definition."""
    read: Callable[[], Arm]


def chosen(mechanisms: list[Mechanism], name: str | None) -> Mechanism:
    """The mechanism of a name; the only arm when not given."""
    arms = [it for it in mechanisms if it.joints in (6, 7)]
    if name is not None:
        arms = [it for it in arms if name.lower() in (own.lower() for own in it.names)]
    if len({(it.names[0].lower(), it.same) for it in arms}) == 1:
        return arms[0]
    words = listed(f'"{it.names[0]}" of {it.joints} joints' for it in arms or mechanisms)
    if arms:
        raise InvalidModelError(f"has several arms, pass name= to choose one: {words}")
    what = "arm" if name is None else f"arm {name!r}"
    raise InvalidModelError(f"has no {what} of 6 or 7 joints; it has {words or 'no mechanism'}")


def robot_of_arm(arm: Arm, name: str, coupled_limits: bool) -> Robot:
    """The robot of an arm. Its name says what the file does not have."""
    if lacks := [what for what in ("limits", "flange") if getattr(arm, what) is None]:
        name += f" (without {' and '.join(lacks)})"
    end = arm.frames[-1] if arm.flange is None else arm.flange
    if not (far := np.abs([*arm.frames[:, :3, 3], end[:3, 3]]).max()) <= MOST_NUMBER:
        where = f"an axis or its flange {far:.3g} m from its base, at most {MOST_NUMBER:g} m"
        raise InvalidModelError(f"has {where} (is it in millimeters?)")
    robot = Robot.from_urdf(_urdf([*arm.frames, end], name), snap=SNAP)
    if arm.linkage:
        robot = robot.coupled()
    for q in PROBES[:, : robot.dof]:
        flange = poses_of(arm, q)[-1] @ np.linalg.inv(arm.frames[-1]) @ end
        check_pose("the flange of the robot", robot.fk(q), flange, CLOSE)
    return robot if arm.limits is None else _limited(robot, arm, coupled_limits)


def _urdf(frames: list[Floats], name: str) -> str:
    """A URDF of axes and flange: at zero joints its links are parallel to the base."""
    text, parent, at = [f'<robot name={quoteattr(name)}><link name="base"/>'], "base", np.zeros(3)
    for index, frame in enumerate(frames, 1):
        link, kind, turn = f"link_{index}", "continuous", np.zeros(3)
        if index == len(frames):
            link, kind, turn = "tool0", "fixed", to_xyz_euler_zyx(frame)[1][::-1]
        step = np.round(frame[:3, 3] - at, DECIMALS)
        text.append(
            f'<link name="{link}"/><joint name="joint_{index}" type="{kind}">'
            f'<parent link="{parent}"/><child link="{link}"/><origin xyz="{_words(step)}" '
            f'rpy="{_words(turn)}"/><axis xyz="{_words(frame[:3, 2])}"/></joint>'
        )
        parent, at = link, frame[:3, 3]
    return "".join([*text, "</robot>"])


def _words(values: Floats) -> str:
    return " ".join(repr(float(value)) for value in values)


def _limited(robot: Robot, arm: Arm, coupled_limits: bool) -> Robot:
    """The robot with limits: of joints, and of a linkage of axes 2 and 3."""
    assert arm.limits is not None
    limits = np.tile([-np.inf, np.inf], (robot.dof + 1, 1))
    for row, bound in zip(*arm.limits, strict=True):
        joints = np.flatnonzero(row)
        is_linkage = arm.linkage and [*joints] == [1, 2]
        if len(joints) == 1:
            _narrow(limits[joints[0]], row[joints[0]], bound)
        elif is_linkage and np.isclose(row[1], arm.linkage * row[2]):
            _narrow(limits[-1], row[2], bound)
        elif coupled_limits:
            terms = " + ".join(f"{row[joint]:g} q{joint + 1}" for joint in joints)
            raise InvalidModelError(
                f"its limit {terms} <= {np.degrees(bound):.6g} deg couples axes, which only a "
                "linkage of axes 2 and 3 can: pass coupled_limits=False to leave such limits out, "
                "and check them yourself"
            )
    robot = robot.with_limits(limits[:-1])
    return robot.with_linkage_limits(limits[-1]) if np.isfinite(limits[-1]).any() else robot


def _narrow(limits: Floats, factor: float, bound: float) -> None:
    """Narrow limits to factor * q <= bound, to 1e-10 deg: files carry noise."""
    value = np.radians(np.round(np.degrees(bound / factor), 10))
    if factor > 0.0:
        limits[1] = min(limits[1], value)
    else:
        limits[0] = max(limits[0], value)


class _Model(NamedTuple):
    """A definition, by which each of its instances is read."""

    definition: Element | None
    table: Element | None
    name: str
    joints: int | None


class _Link(NamedTuple):
    name: str
    frame: Floats
    """In the base at zero joints."""
    pose: Floats
    """In the base at the joints of the instance."""


def mechanisms_of(documents: Iterable[tuple[str, bytes]]) -> list[Mechanism]:
    """The mechanisms of documents: instances, then definitions that have none."""
    read = [(name, _by_kind(content)) for name, content in documents]
    libraries, found = dict(read), []
    models: dict[tuple[str, int], _Model] = {}
    for name, own in read:
        locations = {key: xml.word(it, "location") for key, it in own[REFERENCE].items()}
        for instance in own[INSTANCE].values():
            same = _definition(name, locations, instance)
            if same not in models:
                models[same] = _model(libraries.get(same[0], {}), same[1])
            found.append(_mechanism(models[same], same, instance, own))
    for name, own in read:
        unused = [(name, key) for key in own[DEFINITION] if (name, key) not in models]
        found += [_mechanism(_model(own, same[1]), same, None, own) for same in unused]
    return found


def _by_kind(content: bytes) -> _Elements:
    elements: _Elements = {kind: {} for kind in (INSTANCE, LINK, DEFINITION, TABLE, REFERENCE)}
    for element in xml.elements_of(content, *elements):
        elements[xml.local(element)][xml.integer(element, "id")] = element
    return elements


def _definition(name: str, locations: dict[int, str], instance: Element) -> tuple[str, int]:
    reference = xml.child(instance, "definition")
    if reference is None:
        return name, -1
    key, library = xml.integer(reference, "id"), xml.word(reference, "docid") or "-1"
    if library == "-1":
        return name, key
    location = locations.get(xml.integer(reference, "docid"), "")
    return re.split(r"[\\/]", location)[-1].lower(), key


def _links(own: _Elements, instance: Element) -> list[_Link]:
    """The links of an instance, in the order in which a table counts them."""
    keys = [xml.integer(reference, "id") for reference in xml.parts(instance, "childinstances")]
    # One that is referred to more than once is read once.
    known = {key: _link(own[LINK].get(key)) for key in dict.fromkeys(keys)}
    return [link for link in map(known.__getitem__, keys) if link is not None]


def _link(element: Element | None) -> _Link | None:
    correction, pose = (xml.child(element, it) for it in ("correctiontransform", "transform"))
    if correction is None or pose is None:
        return None
    frame = np.asarray(np.linalg.inv(xml.transform(correction)), dtype=float)
    return _Link(xml.word(element, "name"), frame, xml.transform(pose) @ frame)


def _model(home: _Elements, key: int) -> _Model:
    definition = home.get(DEFINITION, {}).get(key)
    reference = xml.child(definition, "forwardkinematics")
    table = None if reference is None else home[TABLE].get(xml.integer(reference, "id"))
    joints = None if table is None else xml.integer(table, "numactivekjoints")
    return _Model(definition, table, xml.word(definition, "modelname"), joints)


def _mechanism(
    model: _Model, same: tuple[str, int], instance: Element | None, own: _Elements
) -> Mechanism:
    definition, table = model.definition, model.table
    names = [it for it in (xml.word(instance, "name"), model.name) if it]
    names = names or ["an arm without a name"]
    joints = model.joints
    if joints is None:
        joints = 0 if instance is None else xml.integer(instance, "numjoints")

    def read() -> Arm:
        links = [] if instance is None else _links(own, instance)
        if instance is not None and any(xml.numbers(xml.child(instance, "jointmodeloffset"))):
            raise InvalidModelError("has a JointModelOffset, which is not supported")
        if definition is not None and table is not None:
            arm = _by_definition(definition, table, links)
        else:
            assert instance is not None
            arm = _by_links(instance, links, joints)
        limits = None if instance is None else limits_of(instance, joints)
        return arm if limits is None else arm._replace(limits=limits)

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
