"""Arms as their sources print them, in mm and deg: golden tables, not read from irbkin."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Arm:
    """Modified table (alpha [deg], a [mm], d [mm], theta offset [deg]), limits [deg], velocities
    [deg/s].
    """

    name: str
    rows_mm_deg: tuple
    limits_deg: tuple
    velocity_deg_s: tuple | None

    @property
    def rows(self):
        alpha, a, d, theta = np.array(self.rows_mm_deg, dtype=float).T
        return np.column_stack([np.deg2rad(alpha), a / 1e3, d / 1e3, np.deg2rad(theta)])

    @property
    def lengths(self):
        """Of an ABB arm [m]: axis 2 off axis 1, elbow offset, height of axis 2, upper arm, forearm,
        wrist to flange.
        """
        a, d = self.rows[:, 1], self.rows[:, 2]
        return a[1], a[3], d[0], a[2], d[3], d[5]


# Nine ABB arms: tables, limits and velocities as most public sources have them
# (RobotComponents/RobotComponents @ 8eaaf1a2cc, visose/Robots @ 1573995b4d,
# ros-industrial/abb_experimental @ 20b9cf86ad, 4rtur1t0/ARTE @ a8df0b121e,
# SaltworkerMLU/robotkinematicscatalogue @ ea88ef98a3). Where they disagree, the majority is used,
# but for speeds of the IRB 1600-6/1.45: those of ABB's data sheet.
# fmt: off
ABB = {
    arm.name: arm
    for arm in (
        Arm("IRB 120-3/0.58",
            ((0, 0, 290, 0), (-90, 0, 0, -90), (0, 270, 0, 0), (-90, 70, 302, 0),
             (90, 0, 0, 0), (-90, 0, 72, 180)),
            ((-165, 165), (-110, 110), (-110, 70), (-160, 160), (-120, 120), (-400, 400)),
            (250, 250, 250, 320, 320, 420)),
        Arm("IRB 140-6/0.81",
            ((0, 0, 352, 0), (-90, 70, 0, -90), (0, 360, 0, 0), (-90, 0, 380, 0),
             (90, 0, 0, 0), (-90, 0, 65, 180)),
            ((-180, 180), (-90, 110), (-230, 50), (-200, 200), (-115, 115), (-400, 400)),
            (200, 200, 260, 360, 360, 450)),
        Arm("IRB 1200-5/0.9",
            ((0, 0, 399.1, 0), (-90, 0, 0, -90), (0, 448, 0, 0), (-90, 42, 451, 0),
             (90, 0, 0, 0), (-90, 0, 82, 180)),
            ((-170, 170), (-100, 130), (-200, 70), (-270, 270), (-130, 130), (-400, 400)),
            (288, 240, 300, 400, 405, 600)),
        Arm("IRB 1600-6/1.45",
            ((0, 0, 486.5, 0), (-90, 150, 0, -90), (0, 700, 0, 0), (-90, 0, 600, 0),
             (90, 0, 0, 0), (-90, 0, 65, 180)),
            ((-180, 180), (-90, 120), (-245, 65), (-200, 200), (-115, 115), (-400, 400)),
            (150, 160, 170, 320, 400, 460)),
        Arm("IRB 2600-12/1.65",
            ((0, 0, 445, 0), (-90, 150, 0, -90), (0, 700, 0, 0), (-90, 115, 795, 0),
             (90, 0, 0, 0), (-90, 0, 85, 180)),
            ((-180, 180), (-95, 155), (-180, 75), (-400, 400), (-120, 120), (-400, 400)),
            (175, 175, 175, 360, 360, 500)),
        Arm("IRB 2600-12/1.85",
            ((0, 0, 445, 0), (-90, 150, 0, -90), (0, 900, 0, 0), (-90, 115, 795, 0),
             (90, 0, 0, 0), (-90, 0, 85, 180)),
            ((-180, 180), (-95, 155), (-180, 75), (-400, 400), (-120, 120), (-400, 400)),
            None),
        Arm("IRB 4600-20/2.5",
            ((0, 0, 495, 0), (-90, 175, 0, -90), (0, 1095, 0, 0), (-90, 175, 1230.5, 0),
             (90, 0, 0, 0),
             (-90, 0, 85, 180)),
            ((-180, 180), (-90, 150), (-180, 75), (-400, 400), (-120, 120), (-400, 400)),
            (175, 175, 175, 360, 360, 500)),
        Arm("IRB 6640-235/2.55",
            ((0, 0, 780, 0), (-90, 320, 0, -90), (0, 1075, 0, 0), (-90, 200, 1142.5, 0),
             (90, 0, 0, 0),
             (-90, 0, 200, 180)),
            ((-170, 170), (-65, 85), (-180, 70), (-300, 300), (-120, 120), (-360, 360)),
            (100, 90, 90, 170, 120, 190)),
        Arm("IRB 6700-150/3.2",
            ((0, 0, 780, 0), (-90, 320, 0, -90), (0, 1280, 0, 0), (-90, 200, 1592.5, 0),
             (90, 0, 0, 0),
             (-90, 0, 200, 180)),
            ((-170, 170), (-65, 85), (-180, 70), (-300, 300), (-130, 130), (-360, 360)),
            (100, 90, 90, 170, 120, 190)),
    )
}
# fmt: on

# Franka's control parameters; limits and velocities of the maker's description, in radians
# (frankaemika/franka_description @ b299b39d96, robots/fer/joint_limits.yaml).
PANDA = Arm(
    "Panda",
    ((0, 0, 333, 0), (-90, 0, 0, 0), (90, 0, 316, 0), (90, 82.5, 0, 0),
     (-90, -82.5, 384, 0), (90, 0, 0, 0), (90, 88, 107, 0)),
    tuple(np.rad2deg([(-2.8973, 2.8973), (-1.7628, 1.7628), (-2.8973, 2.8973), (-3.0718, -0.0698),
                      (-2.8973, 2.8973), (-0.0175, 3.7525), (-2.8973, 2.8973)])),
    tuple(np.rad2deg([2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61])),
)  # fmt: skip

# Franka Research 3: the Panda's geometry between other limits (robots/fr3/joint_limits.yaml).
FR3 = Arm(
    "FR3",
    PANDA.rows_mm_deg,
    tuple(np.rad2deg([(-2.7437, 2.7437), (-1.7837, 1.7837), (-2.9007, 2.9007), (-3.0421, -0.1518),
                      (-2.8065, 2.8065), (0.5445, 4.5169), (-3.0159, 3.0159)])),
    tuple(np.rad2deg([2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26])),
)  # fmt: skip

# Universal Robots' figures in standard Denavit-Hartenberg form: d1, a2, a3, d4, d5, d6 [m].
UR_FIGURES = {
    "UR3": (0.1519, -0.24365, -0.21325, 0.11235, 0.08535, 0.0819),
    "UR3e": (0.15185, -0.24355, -0.2132, 0.13105, 0.08535, 0.0921),
    "UR5": (0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823),
    "UR5e": (0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996),
    "UR7e": (0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996),
    "UR8 Long": (0.2186, -0.8989, -0.7149, 0.1824, 0.1361, 0.1434),
    "UR10": (0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922),
    "UR10e": (0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655),
    "UR12e": (0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655),
    "UR15": (0.2186, -0.6475, -0.5164, 0.1824, 0.1361, 0.1434),
    "UR16e": (0.1807, -0.4784, -0.36, 0.17415, 0.11985, 0.11655),
    "UR18": (0.2186, -0.475, -0.3389, 0.1824, 0.1361, 0.1434),
    "UR20": (0.2363, -0.8620, -0.7287, 0.2010, 0.1593, 0.1543),
    "UR30": (0.2363, -0.6370, -0.5037, 0.2010, 0.1593, 0.1543),
}
# Joint speeds of their user manuals [deg/s].
UR_SPEEDS = {
    **dict.fromkeys(("UR3", "UR3e"), (180, 180, 180, 360, 360, 360)),
    **dict.fromkeys(("UR5", "UR5e", "UR7e"), (180,) * 6),
    **dict.fromkeys(("UR10", "UR10e", "UR12e", "UR16e"), (120, 120, 180, 180, 180, 180)),
    **dict.fromkeys(("UR20", "UR30"), (120, 120, 150, 210, 210, 210)),
}
UR_TWISTS_DEG = (90, 0, 0, 90, -90, 0)


def ur_rows(name):
    """Standard rows of a Universal Robots arm [rad, m]."""
    d1, a2, a3, d4, d5, d6 = {key.lower(): figures for key, figures in UR_FIGURES.items()}[
        name.lower()
    ]
    return np.column_stack(
        [np.deg2rad(UR_TWISTS_DEG), [0, a2, a3, 0, 0, 0], [d1, 0, 0, d4, d5, d6], np.zeros(6)]
    )


def ur_arm(name):
    """The same as modified rows: twist and length move on by one row."""
    d1, a2, a3, d4, d5, d6 = (1e3 * length for length in UR_FIGURES[name])
    rows = (
        (0, 0, d1, 0),
        (90, 0, 0, 0),
        (0, a2, 0, 0),
        (0, a3, d4, 0),
        (90, 0, d5, 0),
        (-90, 0, d6, 0),
    )
    return Arm(name, rows, ((-360, 360),) * 6, UR_SPEEDS.get(name))


UR = {name: ur_arm(name) for name in UR_FIGURES}

# CRB 15000-5/0.95: axes 5 and 6 pass 80 mm apart.
GOFA_ROWS_MM_DEG = (
    (0, 0, 265, 0), (-90, 0, 0, -90), (0, 444, 0, 0), (-90, 110, 470, 0), (90, 0, 0, 0),
    (-90, 80, 101, 180),
)  # fmt: skip
GOFA = Arm(
    "CRB 15000-5/0.95",
    GOFA_ROWS_MM_DEG,
    ((-180, 180), (-180, 180), (-225, 85), (-180, 180), (-180, 180), (-270, 270)),
    (125, 125, 140, 200, 200, 200),
)
# Of the upper arm, 53.5 mm are forward and 284.5 mm up (UFACTORY's documentation).
XARM6 = Arm(
    "xArm6",
    (
        (0, 0, 267, 0),
        (-90, 0, 0, -np.rad2deg(np.arctan2(284.5, 53.5))),
        (0, np.hypot(284.5, 53.5), 0, np.rad2deg(np.arctan2(284.5, 53.5))),
        (-90, 77.5, 342.5, 0),
        (90, 0, 0, 0),
        (-90, 76, 97, 0),
    ),
    ((-360, 360), (-118, 120), (-225, 11), (-360, 360), (-97, 180), (-360, 360)),
    (180,) * 6,
)
CATALOG = {**ABB, **UR, "Panda": PANDA, "FR3": FR3, GOFA.name: GOFA, "xArm6": XARM6}

# An article's table of an IRB 1410-4/1.45, with the upper arm along -x of its frame.
IRB1410 = Arm(
    "IRB 1410-4/1.45",
    (
        (0, 0, 475, 0),
        (-90, 150, 0, 90),
        (0, -600, 0, 0),
        (90, -120, 720, 0),
        (-90, 0, 0, 0),
        (90, 0, 85, 0),
    ),
    ((-170, 170), (-70, 70), (-70, 70), (-150, 150), (-115, 115), (-300, 300)),
    None,
)

QUARTER = np.pi / 2

# Arms by Brandstoetter's parameters [m, rad].
IRB2400 = {
    "a1": 0.1, "a2": -0.135, "b": 0.0, "c1": 0.615, "c2": 0.705, "c3": 0.755, "c4": 0.085,
    "offsets": (0, 0, -QUARTER, 0, 0, 0), "signs": (1, 1, 1, 1, 1, 1),
}  # fmt: skip
KUKA_KR6 = {
    "a1": 0.025, "a2": -0.035, "b": 0.0, "c1": 0.4, "c2": 0.315, "c3": 0.365, "c4": 0.08,
    "offsets": (0, -QUARTER, 0, 0, 0, 0), "signs": (-1, 1, 1, -1, 1, -1),
}  # fmt: skip
COMAU_NJ165 = {
    "a1": 0.400333, "a2": -0.251449, "b": 0.0, "c1": 0.83, "c2": 1.177556, "c3": 1.443593,
    "c4": 0.23, "offsets": (0, 0, 0, 0, 0, 0), "signs": (-1, 1, -1, -1, 1, -1),
}  # fmt: skip
# Not a real arm: every parameter has an effect, the wrist center is 50 mm off the plane through
# axis 1.
LATERAL = {
    "a1": 0.15, "a2": -0.11, "b": 0.05, "c1": 0.45, "c2": 0.6, "c3": 0.64, "c4": 0.1,
    "offsets": (0.3, -0.2, -QUARTER, 0.1, -0.4, 0.5), "signs": (1, -1, 1, 1, -1, -1),
}  # fmt: skip
OPW = {
    "IRB 2400 serial": IRB2400,
    "KUKA KR 6 R700": KUKA_KR6,
    "Comau NJ-165": COMAU_NJ165,
    "lateral offset": LATERAL,
}
