"""Capsules and hulls that contain the meshes of an arm: `irbkin.body.Body.fit`.

`urdf` reads the solids of the links, `solid` makes points and distances of one, `capsules` and
`hulls` fit it; then the pairs of links that are kept apart are found by random postures.
"""

import os
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report, reporter
from irbkin._core import Body, Cell, Robot, _urdf_swept
from irbkin._fit.capsules import fitted
from irbkin._fit.hulls import parts_of, rounded
from irbkin._fit.solid import Array, Solid, doubled_areas, spread_over
from irbkin._fit.urdf import fixed, links_of, text_and_folder
from irbkin._mesh_files import triangles
from irbkin.errors import InvalidModelError

# Capsules of a link, at most.
MOST = 12
# Of a hull that is a capsule.
NO_FACES = np.empty((0, 3), np.intp)
# Random postures, and those at which meshes are compared.
POSTURES, COMPARED = 2000, 300
# Part of the postures with touching capsules above which meshes are compared [1].
OFTEN = 0.02
# Points of the surface of a mesh.
POINTS = 600


def check(excess: float | None, most: int) -> None:
    if excess is not None and not 0 < excess < np.inf:
        raise InvalidModelError(f"excess is {excess} m, it must be positive")
    if not 1 <= most <= MOST:
        raise InvalidModelError(f"most is {most}, it must be 1 to {MOST} capsules")


def capsules_around(
    mesh: str | os.PathLike[str] | npt.ArrayLike, scale: float, excess: float | None, most: int
) -> Array:
    """Return capsules around a mesh, shape (k, 7); see `irbkin.body.cover`."""
    check(excess, most)
    given = triangles(mesh) if isinstance(mesh, str | os.PathLike) else np.array(mesh, float)
    if given.ndim != 3 or given.shape[1:] != (3, 3) or not len(given):
        raise InvalidModelError(f"mesh has shape {given.shape}, it must have (n, 3, 3)")
    if not 0 < scale < np.inf:
        raise InvalidModelError(f"scale is {scale}, it must be positive")
    return fitted(Solid(given * scale), excess, most)[0]


def body_of(
    urdf: str | bytes | os.PathLike[str],
    base: str | None,
    tip: str | None,
    excess: float | None,
    most: int,
    packages: Mapping[str, str | os.PathLike[str]] | None,
    joints: Mapping[str, float] | None,
    progress: Report | Bar | None,
) -> Body:
    check(excess, most)
    report = reporter(progress)
    text, folder = text_and_folder(urdf)
    if joints:
        text = fixed(text, base, tip, joints)
    robot = Robot.from_urdf(text, base, tip)
    triangles, beside, remark = links_of(text, folder, base, tip, packages or {})
    remark += "".join(f"; {name} at {position:g}" for name, position in (joints or {}).items())
    solids = {link: Solid(corners) for link, corners in sorted(triangles.items())}
    found, hulls = [], []
    for link, solid in solids.items():
        found.append((link, *fitted(solid, excess, most)))
        hulls += [(link, *rounded(part.corners)) for part in parts_of(solid.triangles)]
        report(len(found), len(solids) + len(beside))
    for name, (link, corners) in beside.items():
        rows, outside = fitted(Solid(corners), excess, most)
        rows, growth = _urdf_swept(text, base, tip, name, [link] * len(rows), rows)
        found.append((link, rows, outside + growth))
        hulls += [(link, row[:6].reshape(2, 3), NO_FACES, row[6]) for row in rows]
        report(len(found), len(solids) + len(beside))
    links = np.concatenate([np.full(len(rows), link) for link, rows, _ in found])
    capsules = np.concatenate([rows for _, rows, _ in found])
    outsides = np.zeros(links.max() + 1)
    for link, _, outside in found:
        outsides[link] = max(outsides[link], outside)
    body = Body(links, capsules, [], hulls=hulls)
    pairs = pairs_of(robot, body, solids, {link for link, _ in beside.values()})
    source = f"capsules fitted to the meshes of {robot.name}{remark}"
    return Body(links, capsules, pairs, hulls=hulls, source=source, excess=outsides)


def pairs_of(
    robot: Robot, body: Body, solids: dict[int, Solid], moving: set[int]
) -> list[tuple[int, int]]:
    """The pairs of links that are not neighbors and whose capsules do not always touch.

    Where they touch in more than 2 % of the postures, their meshes are compared: left out are those
    that touch in none. Links with parts that move are not compared: their meshes are where the
    joints of these are.
    """
    dof = robot.dof
    lower, upper = np.clip(robot.limits, -np.pi, np.pi).T
    q = np.random.default_rng(1).uniform(lower, upper, (POSTURES, dof))
    frames = frames_of(robot, q)
    links = np.unique(body.links).tolist()
    found = []
    for one in links:
        # What the flange carries has the neighbors of the last link.
        for other in (link for link in links if min(link, dof) > one + 1):
            chosen = np.isin(body.links, [one, other])
            hulls = [hull for hull in body.hulls if hull[0] in (one, other)]
            alone = Body(body.links[chosen], body.capsules[chosen], [(one, other)], hulls=hulls)
            touches = Cell().collides(robot.with_body(alone), q)
            if touches.all():
                continue
            if touches.mean() > OFTEN and moving.isdisjoint((one, other)):
                places = np.flatnonzero(touches)[:COMPARED]
                both = [(frames[link][places], solids[link]) for link in (one, other)]
                if not (meet(*both) or meet(*both[::-1])):
                    continue
            found.append((one, other))
    return found


def frames_of(robot: Robot, q: Array) -> list[Array]:
    """The frame of each link of a body at each posture, the flange the last."""
    robot = robot.with_base(np.eye(4)).with_tool(np.eye(4))
    moving = robot.link_frames(q)
    base = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    return [base, *(moving[:, joint] for joint in range(robot.dof)), robot.fk(q)]


def meet(one: tuple[Array, Solid], other: tuple[Array, Solid]) -> bool:
    """Whether a point of the surface of a mesh comes to another, within what the grid is off."""
    (frames, solid), (others, around) = one, other
    points = spread_over(solid.triangles, POINTS)
    spacing = np.sqrt(doubled_areas(solid.triangles).sum() / POINTS)
    moved = np.linalg.inv(others) @ frames
    seen = points @ moved[:, :3, :3].transpose(0, 2, 1) + moved[:, None, :3, 3]
    nearest = around.signed(seen.reshape(-1, 3)).min()
    return bool(nearest <= 0.5 * (spacing + around.cell))
