"""Calibration: the parameters of an arm from measured poses or positions of its tool, the place of
a camera, and the calibration of a Universal Robots machine.

`calibrate` and `robot_world` need scipy: `pip install 'irbkin[calibrate]'`. What is
fitted and how is in docs/guide/calibrate.md.
"""

from irbkin.calibration._calibrate import (
    CalibratedParameter,
    Calibration,
    CalibrationResiduals,
    LeftOutParameter,
    Residuals,
    calibrate,
)
from irbkin.calibration._hand_eye import HandEye, robot_world
from irbkin.calibration._ur import load_ur

__all__ = [
    "CalibratedParameter",
    "Calibration",
    "CalibrationResiduals",
    "HandEye",
    "LeftOutParameter",
    "Residuals",
    "calibrate",
    "load_ur",
    "robot_world",
]
