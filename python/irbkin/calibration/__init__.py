"""Calibration: the parameters of an arm from measured poses or positions of its tool.

`irbkin.calibrate` needs the extra scipy: `pip install 'irbkin[calibrate]'`. What is fitted and how
is in docs/guide/calibrate.md.
"""

from __future__ import annotations

from irbkin.calibration._calibrate import calibrate
from irbkin.calibration._records import (
    CalibratedParameter,
    Calibration,
    CalibrationResiduals,
    LeftOutParameter,
    Residuals,
)

__all__ = [
    "CalibratedParameter",
    "Calibration",
    "CalibrationResiduals",
    "LeftOutParameter",
    "Residuals",
    "calibrate",
]
