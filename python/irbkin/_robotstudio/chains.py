"""The chain of an arm in an element of forward kinematics: its axes, its linkage, its limits.

Rows are modified Denavit-Hartenberg rows: Rx(Twist) Tx(Length) Rz(Rotation + q) Tz(Offset). A joint
may have several, one for each link that goes on from it.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._robotstudio import elements as xml
from irbkin._robotstudio.elements import Element
from irbkin.errors import InvalidModelError

MOST_NUMBER = 10.0
"""The largest number of a row, and of a position [m, rad]: arms reach up to 5 m."""
MOST_JOINTS = 7
MOST_LIMITS = 1_000
"""Limits of an arm: a lower and an upper one of each joint, and some of linkages."""
_NUMBERS = ("twist", "length", "rotation", "offset")


class Arm(NamedTuple):
    frames: Floats
    """Its axes in the base at zero joints, z along the axis, shape (n, 4, 4)."""
    links: list[int]
    """The number of the link behind each axis."""
    linkage: float
    """The multiple of joint 2 that turns joint 3: -1 or 1 of a parallelogram linkage, else 0."""
    flange: Floats | None = None
    """In the base at zero joints."""
    limits: tuple[Floats, Floats] | None = None
    """A and b of the joints q that are within limits: A q <= b."""


class _Row(NamedTuple):
    joint: int
    step: Floats
    following: int


def poses_of(arm: Arm, q: npt.ArrayLike) -> Floats:
    """Poses of the links behind the axes in the base, shape (n, 4, 4)."""
    angles = np.array(q, dtype=float)
    angles[2] += arm.linkage * angles[1]
    before = np.linalg.inv([np.eye(4), *arm.frames[:-1]])
    pose, poses = np.eye(4), []
    for fixed, angle in zip(before @ arm.frames, angles, strict=True):
        pose = pose @ fixed @ _step(0.0, 0.0, angle, 0.0)
        poses.append(pose)
    return np.array(poses)


def check_pose(name: str, found: Floats, wanted: Floats, most: float) -> None:
    """Refuse a frame of a table that is not where the file itself has it."""
    off = np.linalg.norm(found[:3, 3] - wanted[:3, 3])
    turned = np.abs(found[:3, :3] - wanted[:3, :3]).max()
    if not (off <= most and turned <= most):
        raise InvalidModelError(
            f"{name} is {off:.2g} m and {turned:.2g} of its axes from where the file has it, at "
            f"most {most:g}: the table is of another arm or convention, or not in meters"
        )


def arm_of(kinematics: Element, flange_link: int | None) -> Arm:
    """The chain from the base to a link; to the only end of all joints when not given."""
    active = xml.integer(kinematics, "numactivekjoints")
    if not 6 <= active <= MOST_JOINTS:
        raise InvalidModelError(f"its table has {active} active joints, an arm has 6 or 7")
    rows, is_revolute = _rows(kinematics)
    starts = _starts(kinematics)
    before = {row.following: link for link, row in rows.items() if row.following >= 0}
    if sum(row.following >= 0 for row in rows.values()) != len(before) or {*starts} & {*before}:
        raise InvalidModelError("two links lead to one joint: closed loops are not supported")
    if flange_link is None:
        ends = [it for it in rows if len(_path(it, rows, before)) == active]
        if len(ends) != 1:
            raise InvalidModelError(f"has no flange, and {len(ends)} links could carry it")
        flange_link = ends[0]
    links = _path(flange_link, rows, before)
    if not 6 <= len(links) <= MOST_JOINTS:
        what = f"{len(links)} joints" if len(links) < 6 else "more than seven joints, or a loop"
        raise InvalidModelError(
            f"its flange is on link {flange_link}, behind {what}; an arm has 6 or 7"
        )
    joints = [rows[link].joint for link in links]
    if sliding := [joint + 1 for joint in joints if not is_revolute[joint]]:
        raise InvalidModelError(f"joint {sliding[0]} is prismatic, it must be revolute")
    if joints[0] not in starts:
        raise InvalidModelError(f"joint {joints[0] + 1} does not start at the base")
    pose, frames = starts[joints[0]], []
    for link in links:
        pose = pose @ rows[link].step
        frames.append(pose)
    linkage = _linkage(kinematics, joints, active, len(is_revolute))
    return Arm(np.array(frames), links, linkage, None, limits_of(kinematics, active))


def _rows(kinematics: Element) -> tuple[dict[int, _Row], list[bool]]:
    joints = xml.parts(kinematics, "jointinfos")
    rows: dict[int, _Row] = {}
    for index, joint in enumerate(joints):
        own = [it for it in joint.iter() if all(xml.word(it, name) for name in _NUMBERS)]
        if not own or xml.word(joint, "isrevolutejoint").lower() not in ("true", "false"):
            raise InvalidModelError(
                f"joint {index + 1} has no IsRevoluteJoint or no row of {', '.join(_NUMBERS)}"
            )
        for row in own:
            values = [xml.number(row, name) for name in _NUMBERS]
            if not max(map(abs, values)) <= MOST_NUMBER:
                raise InvalidModelError(
                    f"joint {index + 1} has the row {values}, each must be at most {MOST_NUMBER:g} "
                    "m or rad (is it in millimeters or degrees?)"
                )
            link, following = xml.integer(row, "link"), xml.integer(row, "nextjoint")
            if link in rows or link < 1 or not -1 <= following < len(joints):
                raise InvalidModelError(
                    f"joint {index + 1}: its Link {link} must be positive and of no other row, its "
                    f"NextJoint {following} one of -1 to {len(joints) - 1}"
                )
            rows[link] = _Row(index, _step(*values), following)
    return rows, [xml.word(it, "isrevolutejoint").lower() == "true" for it in joints]


def _starts(kinematics: Element) -> dict[int, Floats]:
    bases = xml.parts(kinematics, "kinematicbaseframes")
    frames = [xml.transform(it) for it in bases if len(it) == 4]
    joints = [int(it) for it in xml.numbers(xml.child(kinematics, "basejoints"))] or [0]
    if len(joints) != len(frames):
        raise InvalidModelError(
            f"has {len(frames)} KinematicBaseFrames of {len(joints)} joints at the base"
        )
    return dict(zip(joints, frames, strict=True))


def _path(link: int | None, rows: dict[int, _Row], before: dict[int, int]) -> list[int]:
    """The links from the base to a link, each behind one joint; of more than seven, the last."""
    path: list[int] = []
    while link in rows and len(path) <= MOST_JOINTS:
        path.insert(0, link)
        link = before.get(rows[link].joint)
    return path


def _linkage(kinematics: Element, joints: list[int], active: int, count: int) -> float:
    """The multiple of joint 2 that turns joint 3; apart from it, each joint must turn alone."""
    own, alone = np.eye(count, active)[joints], np.eye(len(joints))
    # Without the matrix the first joints are the active ones. RobotStudio writes columns.
    if given := xml.numbers(xml.child(kinematics, "jointdependency")):
        is_whole = len(given) == count * active
        own = np.reshape(given, (active, count)).T[joints] if is_whole else np.empty(0)
    if own.shape == alone.shape and own[2, 1] in (-1.0, 1.0):
        alone[2, 1] = own[2, 1]
    if own.shape != alone.shape or (own != alone).any():
        raise InvalidModelError(
            f"the {len(joints)} joints to the flange do not follow the {active} active ones one by "
            "one; only a joint 3 that turns with joint 2 is supported"
        )
    return float(own[2, 1])


def limits_of(element: Element, active: int) -> tuple[Floats, Floats] | None:
    """A and b of A q <= b, A of shape (m, active); None where an element has no limits."""
    given = xml.numbers(xml.child(element, "jointlimitsmatrix"))
    bounds = np.array(xml.numbers(xml.child(element, "jointlimitsvector")))
    if not given and not len(bounds):
        return None
    if len(bounds) > MOST_LIMITS:
        raise InvalidModelError(f"has {len(bounds)} limits, at most {MOST_LIMITS} are read")
    if len(given) == len(bounds) * active:
        # RobotStudio writes columns.
        matrix = np.reshape(given, (active, -1)).T
        alone = matrix[(matrix != 0.0).sum(axis=1) == 1]
        if (alone > 0.0).any(axis=0).all() and (alone < 0.0).any(axis=0).all():
            return matrix, bounds
    raise InvalidModelError(
        f"JointLimitsMatrix has {len(given)} numbers for {len(bounds)} bounds of {active} joints, "
        "or not an upper and a lower limit of each"
    )


def _step(twist: float, length: float, rotation: float, offset: float) -> Floats:
    (s, c), (t, u) = ((np.sin(it), np.cos(it)) for it in (rotation, twist))
    rows = [[c, -s, 0.0, length], [s * u, c * u, -t, -offset * t], [s * t, c * t, u, offset * u]]
    return np.array([*rows, [0.0, 0.0, 0.0, 1.0]])
