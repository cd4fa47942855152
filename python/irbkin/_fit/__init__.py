"""Capsules and hulls that contain the meshes of an arm: `irbkin.body.Body.fit`.

`urdf` reads the solids of the links, `solid` makes points and distances of one, `capsules` and
`hulls` fit it, `pairs` finds the links that are kept apart.
"""

import os
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report, reporter
from irbkin._core import Body, Robot, _urdf_swept
from irbkin._fit.capsules import fitted
from irbkin._fit.hulls import hulls_of
from irbkin._fit.pairs import pairs_of
from irbkin._fit.solid import Array, Solid
from irbkin._fit.urdf import fixed, links_of, text_and_folder
from irbkin._mesh_files import triangles
from irbkin.errors import InvalidModelError

# Capsules of a link, at most.
MOST = 12
# Of a hull that is a capsule.
NO_FACES = np.empty((0, 3), np.intp)


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
    """Return the body of a URDF; see `Body.fit`."""
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
        hulls += hulls_of(link, solid.triangles)
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
