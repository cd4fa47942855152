"""Arms of scenes: the chain of a robot, its body, its postures and its motion."""

import contextlib
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin._arguments import check_robot
from irbkin._arrays import Floats, as_array, evenly, rotations
from irbkin._core import Robot, catalog
from irbkin.body import Body
from irbkin.errors import InvalidJointsError, InvalidModelError
from irbkin.scene._data import Arm, LinkHull, LinkShape, Motion, Posture

MOST_SAMPLES = 2000
"""Samples of a motion; more are thinned."""
UNLIMITED = 1e9
"""Limits of a joint without any [rad]."""


def rows(values: npt.ArrayLike) -> Any:
    def tupled(it: Any) -> Any:
        return tuple(map(tupled, it)) if isinstance(it, list) else it

    return tupled(np.asarray(values, dtype=float).tolist())


def rest(robot: Robot) -> Floats:
    """Joint angles of zero, or those inside the limits that are nearest to it [rad]."""
    lower, upper = robot.limits.T
    return np.clip(np.zeros(robot.dof), lower, upper)


def arm_of(
    robot: Robot,
    postures: Iterable[Posture] | None = None,
    motion: Motion | None = None,
) -> Arm:
    """Return the arm of a robot.

    Args:
        robot: The arm, with its tool, base and body.
        postures: Where it is drawn; at rest when neither they nor a motion are given.
        motion: How it moves.

    Raises:
        TypeError: `robot` is not a Robot.
    """
    check_robot(robot)
    if postures is None:
        postures = () if motion else (Posture(rows(rest(robot))),)
    base = np.asarray(robot.base)
    frames = [base, *robot.link_frames(np.zeros(robot.dof))]
    between = [np.linalg.solve(one, other) for one, other in pairwise(frames)]
    # As axes 2 and 3 turn in the same sense or in opposite ones.
    coupling = -float(np.sign(np.cos(robot.mdh[2, 0]))) if robot.is_coupled else 0.0
    # A robot of the catalog is known by its name.
    bare = robot.with_base(np.eye(4)).with_tool(np.eye(4))
    is_known = bare.name in catalog() and bare == Robot(bare.name)
    urdf = "" if is_known else bare.to_urdf(visual=False)
    body = robot.body
    if body is None:
        # Some lengths give none.
        with contextlib.suppress(InvalidModelError):
            body = robot.approximate_body()
    shapes = () if body is None else zip(body.links.tolist(), body.capsules, strict=True)
    return Arm(
        robot.name,
        rows(base),
        tuple(rows(it) for it in between[:-1]),
        rows(between[-1]),
        coupling,
        rows(np.clip(robot.limits, -UNLIMITED, UNLIMITED)),
        tuple(LinkShape(link, rows(c[:3]), rows(c[3:6]), float(c[6])) for link, c in shapes),
        bool(body is not None and body.is_approximate),
        tuple(postures),
        motion,
        _hulls(body),
        urdf,
    )


def _hulls(body: Body | None) -> tuple[LinkHull, ...]:
    """The hulls of links all of whose hulls have faces, or are capsules: of two points."""
    rows_of = [] if body is None else body.hulls
    open_ones = {link for link, points, faces, _ in rows_of if len(points) > 2 and not len(faces)}
    return tuple(
        LinkHull(link, rows(np.round(points, 4)), tuple(map(tuple, faces)), radius)
        for link, points, faces, radius in rows_of
        if link not in open_ones
    )


def motion_of(t: npt.ArrayLike, q: npt.ArrayLike, lines: npt.ArrayLike = ()) -> Motion:
    """Return a motion of samples, thinned evenly to a number that a face can draw."""
    times, angles = np.asarray(t, dtype=float), as_array(q, "q", (None, None), InvalidJointsError)
    kept = evenly(len(times), MOST_SAMPLES)
    numbers = np.asarray(lines, dtype=int)
    own = tuple(numbers[kept].tolist()) if len(numbers) else ()
    return Motion(rows(times[kept]), rows(angles[kept]), own)


def link_frames(arm: Arm, q: npt.ArrayLike) -> Floats:
    """Return the frames of the base, links 1 to n and the tool in the world at joint angles [rad],
    shape (n + 2, 4, 4), as faces calculate them.
    """
    angles = np.array(q, dtype=float)
    if arm.coupling:
        angles[2] += arm.coupling * angles[1]
    frames = [np.array(arm.base)]
    for fixed, turn in zip(arm.joints, rotations(2, angles), strict=True):
        frames.append(frames[-1] @ np.array(fixed) @ turn)
    frames.append(frames[-1] @ np.array(arm.tool))
    return np.array(frames)


def solids(arm: Arm) -> list[LinkShape | LinkHull]:
    having = {it.link for it in arm.hulls}
    bare = [
        LinkShape(it.link, it.points[0], it.points[-1], it.radius)
        for it in arm.hulls
        if not it.faces
    ]
    others = [it for it in arm.body if it.link not in having]
    return [*(it for it in arm.hulls if it.faces), *bare, *others]


def outward(hull: LinkHull) -> Floats:
    """Return the points of a hull moved out by its radius along the mean normal of their faces,
    weighted by their angles, shape (k, 3): what is drawn of them contains the hull of the points,
    and is in the rounded one.
    """
    points, faces = np.array(hull.points), np.array(hull.faces)
    mean = np.zeros_like(points)
    corners = points[faces]
    sides = [np.roll(corners, step, axis=1) - corners for step in (1, 2)]
    one, other = (it / np.linalg.norm(it, axis=2, keepdims=True) for it in sides)
    angles = np.arccos(np.clip(np.sum(one * other, axis=2, keepdims=True), -1.0, 1.0))
    np.add.at(mean, faces, angles * face_normals(points, faces)[:, None])
    return np.asarray(points + hull.radius * mean / np.linalg.norm(mean, axis=1, keepdims=True))


def face_normals(points: Floats, faces: npt.NDArray[np.int_]) -> Floats:
    """Return the normals of triangles out of a hull, shape (t, 3)."""
    first, second, third = np.moveaxis(points[faces], 1, 0)
    normals = np.cross(second - first, third - first)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300))


def start(arm: Arm) -> Sequence[float]:
    shown = [it.q for it in arm.postures if not it.is_ghost]
    if shown:
        return shown[0]
    return arm.motion.q[0] if arm.motion and arm.motion.q else (0.0,) * len(arm.joints)
