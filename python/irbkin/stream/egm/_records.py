"""Messages of EGM by the names of egm.proto: what is None is not in the message."""

import enum
from typing import NamedTuple

_Numbers = tuple[float, ...]


class MessageType(enum.IntEnum):
    """`EgmHeader.mtype`: DATA is the controller's, CORRECTION is to it."""

    UNDEFINED = 0
    COMMAND = 1
    DATA = 2
    CORRECTION = 3
    PATH_CORRECTION = 4


class MciState(enum.IntEnum):
    """`EgmRobot.mci_state`: whether EGM moves the robot."""

    UNDEFINED = 0
    ERROR = 1
    STOPPED = 2
    RUNNING = 3


class EgmHeader(NamedTuple):
    """Sequence number (32 bits, after the largest again 0), time by the sender's clock [ms] and
    `MessageType`.
    """

    seqno: int | None = None
    tm: int | None = None
    mtype: int | None = None


class EgmPose(NamedTuple):
    """A pose of the tool in the work object: position x, y, z [mm], quaternion w, x, y, z; Euler
    angles x, y, z [deg], which go before the quaternion where there are both.
    """

    pos: _Numbers | None = None
    orient: _Numbers | None = None
    euler: _Numbers | None = None


class EgmTimestamp(NamedTuple):
    """Seconds and nanoseconds of the precision time protocol."""

    sec: int | None = None
    nsec: int | None = None


class EgmPosition(NamedTuple):
    """Where the robot is, or is to be: axes 1 to 6 [deg], the tool, external axes [deg or mm], of
    which the first is axis 7 of seven; seconds and microseconds since 1970.
    """

    joints: _Numbers | None = None
    cartesian: EgmPose | None = None
    external_joints: _Numbers | None = None
    time: tuple[int, int] | None = None
    time_stamp: EgmTimestamp | None = None


class EgmSpeed(NamedTuple):
    """Speeds that go with a position: axes 1 to 6 [deg/s]; the tool: x, y, z [mm/s], and what
    follows; external axes [deg/s or mm/s].
    """

    joints: _Numbers | None = None
    cartesians: _Numbers | None = None
    external_joints: _Numbers | None = None


class EgmData(NamedTuple):
    """A flag and numbers: of a measured force whether it is active, of a collision whether one was
    detected, of RAPID's data the digital value and up to 40 numbers.
    """

    flag: bool | None = None
    values: _Numbers = ()


class EgmRobot(NamedTuple):
    """A message of the controller: where the robot is (`feedback`), and where the controller wants
    it to be (`planned`).

    `motor_state` is 1 for on and 2 for off, `mci_state` a `MciState`, `rapid_exec_state` 1 for
    stopped and 2 for running. `mci_convergence_met` is whether the condition that ends the motion
    is met, `utilization_rate` how much of what the robot can do is used [%].
    """

    header: EgmHeader | None = None
    feedback: EgmPosition | None = None
    planned: EgmPosition | None = None
    motor_state: int | None = None
    mci_state: int | None = None
    mci_convergence_met: bool | None = None
    test_signals: _Numbers | None = None
    rapid_exec_state: int | None = None
    measured_force: EgmData | None = None
    utilization_rate: float | None = None
    move_index: int | None = None
    collision_info: EgmData | None = None
    rapid_from_robot: EgmData | None = None
    torque_ref: _Numbers | None = None


class EgmSensor(NamedTuple):
    """A message to the controller: where the robot is to be (`planned`), and the speed there."""

    header: EgmHeader | None = None
    planned: EgmPosition | None = None
    speed_ref: EgmSpeed | None = None
    rapid_to_robot: EgmData | None = None
