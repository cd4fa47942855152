"""Write the hulls of the catalog's bodies, hulls.bin of irbkin-motion, from meshes of their links.

python tests/write_hulls.py FRAMES: a YAML file, by arm and link a list of meshes: `path`, `scale`
and `pose`, three rows of four [m], in the frame of the link. The sources of the meshes are in
`crates/irbkin-motion/src/body/arms`; they are not part of this repository.
"""

from __future__ import annotations

import struct
import sys
from pathlib import Path

import numpy as np
import yaml
from irbkin._fit.capsules import axes_of
from irbkin._fit.hulls import around, parts_of, rounded
from irbkin._mesh_files import triangles
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

TO = Path(__file__).parent.parent / "crates/irbkin-motion/src/body/arms/hulls.bin"
# Lengths of points and of radii [m].
POINT, RADIUS = 1e-4, 1e-5
# Arms with one body, which contains the meshes of both.
SAME = {"FR3": "Panda"}


def placed(mesh: dict) -> np.ndarray:
    """The triangles of a mesh in the frame of its link."""
    pose = np.array(mesh["pose"])
    return mesh["scale"] * triangles(mesh["path"]) @ pose[:, :3].T + pose[:, 3]


def row_of(link: int, corners: np.ndarray) -> bytes:
    """A hull as it is stored: its points rounded, then its radius."""
    points = np.round(rounded(corners)[0] / POINT)
    points = points[ConvexHull(points).vertices]
    points = points[np.lexsort(points.T[::-1])]
    faces, radius = around(points * POINT, corners)
    turn = faces.argmin(axis=1)[:, None] + np.arange(3)
    faces = np.take_along_axis(faces, turn % 3, axis=1)
    faces = faces[np.lexsort(faces.T[::-1])]
    head = struct.pack("<3BH", link, len(points), len(faces), int(np.ceil(radius / RADIUS)))
    # Of each axis the lower bytes, then the higher ones.
    pairs = points.T.astype("<i2", order="C").view("u1").reshape(3, -1, 2)
    columns = pairs.transpose(0, 2, 1).tobytes() + faces.T.astype("u1").tobytes()
    return head + core(points).astype("<i2").tobytes() + columns


def core(points: np.ndarray) -> np.ndarray:
    """Ends and radius of a large capsule inside of the hull of points, in whole numbers.

    Along each principal axis, of some lengths, the middle with the largest radius is a linear
    program.
    """
    planes = ConvexHull(points).equations
    normals, offsets = planes[:, :3], -planes[:, 3]
    best = (0.0, np.zeros(7))
    for way in axes_of(points):
        for length in np.linspace(0, np.ptp(points @ way), 20):
            beyond = np.abs(normals @ way) * length / 2
            rows = np.column_stack([normals, np.ones(len(normals))])
            free = [(None, None)] * 3 + [(0, None)]
            found = linprog([0, 0, 0, -1], rows, offsets - beyond, bounds=free)
            if found.status == 0:
                half = way * length / 2
                ends = np.round([*(found.x[:3] - half), *(found.x[:3] + half)])
                heights = np.max(normals @ ends.reshape(2, 3).T, axis=1)
                radius = np.floor((offsets - heights).min())
                volume = radius**2 * (length + 4 / 3 * radius)
                if radius > 0 and volume > best[0]:
                    best = volume, np.array([*ends, radius])
    return best[1]


def main() -> None:
    """Write the file."""
    arms: dict[str, dict[int, list[np.ndarray]]] = {}
    for arm, links in yaml.safe_load(Path(sys.argv[1]).read_text()).items():
        for link, meshes in links.items():
            if link.isdecimal():
                own = arms.setdefault(SAME.get(arm, arm), {}).setdefault(int(link), [])
                own.extend(map(placed, meshes))
    found = bytearray()
    for arm, links in arms.items():
        rows = [
            row_of(link, part.corners)
            for link, meshes in links.items()
            for part in parts_of(np.concatenate(meshes))
        ]
        found += bytes([len(arm)]) + arm.encode() + bytes([len(rows)]) + b"".join(rows)
        print(f"{arm}: {len(rows)} hulls")
    TO.write_bytes(found)
    print(f"{len(found)} bytes")


if __name__ == "__main__":
    main()
