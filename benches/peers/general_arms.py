"""Arms without a closed form, by their tables: an offset wrist, the same with square parallel axes,
and one with sixteen solutions.
"""

from __future__ import annotations

import numpy as np

from .arms import Arm, Floats

QUARTER = np.pi / 2


def of_table(name: str, table: Floats) -> Arm:
    """An arm by the rows of its modified Denavit-Hartenberg table: alpha, a, d, theta [rad, m]."""
    frame, axes, points = np.eye(4), [], [np.zeros(3)]
    for alpha, a, d, theta in table:
        frame = frame @ _link(alpha, a, d, theta)
        axes.append(frame[:3, 2])
        points.append(frame[:3, 3])
    offsets = np.diff(np.array([*points, points[-1]]), axis=0)
    limits = np.array([(-np.pi, np.pi)] * len(table))
    return Arm(
        name, np.array(axes), offsets, frame[:3, :3], limits, tuple(range(len(table))), table=table
    )


def _link(alpha: float, a: float, d: float, theta: float) -> Floats:
    """Rx(alpha) Tx(a) Rz(theta) Tz(d)."""
    (sa, ca), (st, ct) = (np.sin(alpha), np.cos(alpha)), (np.sin(theta), np.cos(theta))
    return np.array([
        [ct, -st, 0.0, a],
        [st * ca, ct * ca, -sa, -d * sa],
        [st * sa, ct * sa, ca, d * ca],
        [0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip


# ABB's dimensions of the CRB 15000-5/0.95 (GoFa 5), FANUC's of the CRX-10iA/L.
GOFA5 = of_table(
    "CRB 15000-5/0.95",
    np.array([
        [0, 0, 0.265, 0], [-QUARTER, 0, 0, -QUARTER], [0, 0.444, 0, 0], [-QUARTER, 0.110, 0.470, 0],
        [QUARTER, 0, 0, 0], [-QUARTER, 0.080, 0.101, np.pi],
    ]),
)  # fmt: skip
CRX10IAL = of_table(
    "CRX-10iA/L",
    np.array([
        [0, 0, 0.245, 0], [-QUARTER, 0, 0, -QUARTER], [0, 0.710, 0, 0], [-QUARTER, 0, 0.540, 0],
        [QUARTER, 0, 0.150, 0], [-QUARTER, 0, 0.160, np.pi],
    ]),
)  # fmt: skip
# Manseur and Doty, A Robot Manipulator with 16 Real Inverse Kinematic Solution Sets, 1989; their
# standard table, its twists and lengths one row down. The last twist is a tool's.
DEGREE = np.pi / 180
MANSEUR_DOTY = of_table(
    "Manseur and Doty's arm",
    np.array([
        [0, 0, 0, 0], [QUARTER, 0.3, 0, 0], [DEGREE, 1, 0.2, 0], [QUARTER, 0, 0, 0],
        [DEGREE, 1.5, 0, 0], [QUARTER, 0, 0, 0],
    ]),
)  # fmt: skip
GENERAL = (GOFA5, CRX10IAL, MANSEUR_DOTY)
