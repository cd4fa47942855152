"""Messages of EGM by the names of egm.proto: what is None is not in the message."""

from __future__ import annotations

import enum
from typing import NamedTuple

_Numbers = tuple[float, ...]


class MessageType(enum.IntEnum):
    """`EgmHeader.mtype`."""

    UNDEFINED = 0
    COMMAND = 1
    DATA = 2
    """The controller's."""
    CORRECTION = 3
    """To the controller."""
    PATH_CORRECTION = 4


class MciState(enum.IntEnum):
    """`EgmRobot.mci_state`: whether EGM moves the robot."""

    UNDEFINED = 0
    ERROR = 1
    STOPPED = 2
    RUNNING = 3


class EgmHeader(NamedTuple):
    """What every message begins with."""

    seqno: int | None = None
    """Sequence number, 32 bits, after the largest again 0."""
    tm: int | None = None
    """When it was sent [ms], by the sender's clock."""
    mtype: int | None = None
    """`MessageType`."""


class EgmPose(NamedTuple):
    """A pose of the tool in the work object."""

    pos: _Numbers | None = None
    """Position x, y, z [mm]."""
    orient: _Numbers | None = None
    """Quaternion w, x, y, z."""
    euler: _Numbers | None = None
    """Euler angles x, y, z [deg], which go before the quaternion where there are both."""


class EgmTimestamp(NamedTuple):
    """A time of the precision time protocol."""

    sec: int | None = None
    """Seconds."""
    nsec: int | None = None
    """Nanoseconds."""


class EgmPosition(NamedTuple):
    """Where the robot is, or is to be."""

    joints: _Numbers | None = None
    """Axes 1 to 6 [deg]."""
    cartesian: EgmPose | None = None
    """The tool."""
    external_joints: _Numbers | None = None
    """External axes [deg or mm]; the first is axis 7 of seven."""
    time: tuple[int, int] | None = None
    """Seconds and microseconds since 1970."""
    time_stamp: EgmTimestamp | None = None
    """The same of another clock."""


class EgmSpeed(NamedTuple):
    """Speeds that go with a position."""

    joints: _Numbers | None = None
    """Axes 1 to 6 [deg/s]."""
    cartesians: _Numbers | None = None
    """The tool: x, y, z [mm/s], and what follows."""
    external_joints: _Numbers | None = None
    """External axes [deg/s or mm/s]."""


class EgmData(NamedTuple):
    """A flag and numbers: of a measured force whether it is active, of a collision whether one was
    detected, of RAPID's data the digital value and up to 40 numbers.
    """

    flag: bool | None = None
    """The flag."""
    values: _Numbers = ()
    """The numbers."""


class EgmRobot(NamedTuple):
    """A message of the controller."""

    header: EgmHeader | None = None
    """Number, time and kind."""
    feedback: EgmPosition | None = None
    """Where the robot is."""
    planned: EgmPosition | None = None
    """Where the controller wants it to be."""
    motor_state: int | None = None
    """Motors: 1 on, 2 off."""
    mci_state: int | None = None
    """`MciState`."""
    mci_convergence_met: bool | None = None
    """Whether the condition that ends the motion is met."""
    test_signals: _Numbers | None = None
    """Test signals."""
    rapid_exec_state: int | None = None
    """The RAPID program: 1 stopped, 2 running."""
    measured_force: EgmData | None = None
    """Measured force [N, Nm]."""
    utilization_rate: float | None = None
    """How much of what the robot can do is used [%]."""
    move_index: int | None = None
    """Number of the move, in path correction."""
    collision_info: EgmData | None = None
    """Whether a collision was detected, and the level of each axis."""
    rapid_from_robot: EgmData | None = None
    """What RAPID sends."""
    torque_ref: _Numbers | None = None
    """Torque of each axis."""


class EgmSensor(NamedTuple):
    """A message to the controller."""

    header: EgmHeader | None = None
    """Number, time and kind."""
    planned: EgmPosition | None = None
    """Where the robot is to be."""
    speed_ref: EgmSpeed | None = None
    """Speeds there."""
    rapid_to_robot: EgmData | None = None
    """What RAPID receives."""
