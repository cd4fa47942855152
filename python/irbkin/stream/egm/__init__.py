"""ABB's Externally Guided Motion (EGM)."""

from irbkin._core import decode, encode
from irbkin.stream.egm._program import rapid_module
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
from irbkin.stream.egm._server import Server
from irbkin.stream.egm._session import Feedback, Statistics
from irbkin.stream.egm._simulated import CYCLE, Controller, Simulated, play, simulated

__all__ = [
    "CYCLE",
    "Controller",
    "EgmData",
    "EgmHeader",
    "EgmPose",
    "EgmPosition",
    "EgmRobot",
    "EgmSensor",
    "EgmSpeed",
    "EgmTimestamp",
    "Feedback",
    "MciState",
    "MessageType",
    "Server",
    "Simulated",
    "Statistics",
    "decode",
    "encode",
    "play",
    "rapid_module",
    "simulated",
]
