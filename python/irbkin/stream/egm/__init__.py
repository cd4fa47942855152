"""ABB's Externally Guided Motion (EGM)."""

from __future__ import annotations

from irbkin._core import decode, encode
from irbkin.stream.egm._records import (
    EgmData,
    EgmHeader,
    EgmPose,
    EgmPosition,
    EgmRobot,
    EgmSensor,
    EgmSpeed,
    EgmTimestamp,
    MciState,
    MessageType,
)

__all__ = [
    "EgmData",
    "EgmHeader",
    "EgmPose",
    "EgmPosition",
    "EgmRobot",
    "EgmSensor",
    "EgmSpeed",
    "EgmTimestamp",
    "MciState",
    "MessageType",
    "decode",
    "encode",
]
