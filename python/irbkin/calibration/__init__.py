"""Calibration: the parameters of an arm from measured poses or positions of its tool, or from its
contacts, a tool center point, a work object, a camera, and the calibration of a Universal Robots
machine.

`calibrate`, `calibrate_contact`, `hand_eye` and `robot_world` need scipy:
`pip install 'irbkin[calibrate]'`. What is fitted and how is in docs/guide/calibrate.md.
"""

from __future__ import annotations

from irbkin.calibration._bodies import PlaneContact, SphereContact
from irbkin.calibration._calibrate import calibrate
from irbkin.calibration._contact import calibrate_contact
from irbkin.calibration._hand_eye import HandEye, hand_eye, robot_world
from irbkin.calibration._records import (
    CalibratedParameter,
    Calibration,
    CalibrationResiduals,
    LeftOutParameter,
    Residuals,
)
from irbkin.calibration._touch import (
    ToolCenterPoint,
    WorkObject,
    tool_center_point,
    work_object,
)
from irbkin.calibration._ur import load_ur

__all__ = [
    "CalibratedParameter",
    "Calibration",
    "CalibrationResiduals",
    "HandEye",
    "LeftOutParameter",
    "PlaneContact",
    "Residuals",
    "SphereContact",
    "ToolCenterPoint",
    "WorkObject",
    "calibrate",
    "calibrate_contact",
    "hand_eye",
    "load_ur",
    "robot_world",
    "tool_center_point",
    "work_object",
]
