"""The RAPID program of a controller that follows a `Server`."""

import math
from typing import Literal

import numpy as np
import numpy.typing as npt

from irbkin import Robot
from irbkin._arrays import finite
from irbkin._core import JointTarget, Pose, ToolData, dump, parse
from irbkin.errors import InvalidJointsError, StreamError
from irbkin.stream.egm._session import axes_of

POSES = ("X", "Y", "Z", "Rx", "Ry", "Rz")


def rapid_module(
    robot: Robot,
    start: npt.ArrayLike,
    *,
    mode: Literal["joint", "pose"] = "joint",
    name: str = "EgmStream",
    device: str = "irbkin",
    max_speed: float | None = None,
) -> str:
    """Return the text of a RAPID module that moves to the start of a guard and then follows.

    EGMRun ends when the robot has been within 0.1 deg (or mm) of its reference for one second,
    after the end of a session. Without datagrams for a second it raises ERR_UDPUC_COMM.

    Args:
        robot: The arm with its tool.
        start: Joints at which the guard starts [rad], shape (n,).
        mode: As of `Server`.
        name: Name of the module and of its routine.
        device: Name of the UDPUC device, whose Remote Address and Remote Port are the server's.
        max_speed: MaxSpeedDeviation [deg/s or mm/s]; by default the speed of the fastest joint, or
            1000 mm/s. Without it a controller would move by 1 deg/s.

    Raises:
        StreamError: Another mode, no speed is known or it is not positive.
        RapidError: A name that RAPID does not read.
        InvalidJointsError: The start has another shape, or is not finite.
    """
    if mode not in ("joint", "pose"):
        raise StreamError(f"mode is {mode!r}, it must be joint or pose")
    q = finite(start, "start", (robot.dof,), InvalidJointsError)[axes_of(robot)]
    if max_speed is None and mode == "pose":
        max_speed = 1000.0
    elif max_speed is None:
        if robot.max_velocity is None:
            raise StreamError("the robot has no max_velocity: give max_speed [deg/s]")
        max_speed = math.ceil(np.degrees(robot.max_velocity).max())
    if not 0 < max_speed < math.inf:
        raise StreamError(f"max_speed is {max_speed}, it must be positive [deg/s or mm/s]")
    extax = np.degrees(q[6:]).round(6).tolist()
    target = JointTarget(np.degrees(q[:6]).round(6).tolist(), [*extax, *[9e9] * (6 - len(extax))])
    tool, declared = "tool0", ""
    if not np.array_equal(robot.tool, np.eye(4)):
        tool = "tEgm"
        frame = dump(ToolData(tframe=Pose.of(robot.tool)))
        declared = f"\n    ! The load is not known here.\n    PERS tooldata tEgm:={frame};"
    axes = [f"J{i}" for i in range(1, len(q) + 1)] if mode == "joint" else POSES
    kind = mode.capitalize()
    frames = ",egmFrame,EGM_FRAME_WOBJ,egmFrame,EGM_FRAME_WOBJ" if mode == "pose" else ""
    declared += "\n    CONST pose egmFrame:=[[0,0,0],[1,0,0,0]];" if mode == "pose" else ""
    within = "".join(f"\\{axis}:=egmWithin" for axis in axes)
    all_axes = "".join(f"\\{axis}" for axis in axes)
    text = f"""MODULE {name}
    ! RobotWare 7 with option 3124-1: the UDP Unicast Device {device};
    ! from 6.07.01 on with option 689-1: the Transmission Protocol {device} of type UDPUC.
    ! Its Remote Address and Remote Port lead to the server.
    CONST jointtarget jStart:={dump(target)};
    CONST egm_minmax egmWithin:=[-0.1,0.1];{declared}
    VAR egmident egmId;

    PROC {name}()
        ! EGM starts and ends in a fine point.
        MoveAbsJ jStart,v100,fine,{tool};
        EGMReset egmId;
        EGMGetId egmId;
        EGMSetupUC ROB_1,egmId,"default","{device}"\\{kind}\\CommTimeout:=1;
        EGMAct{kind} egmId\\Tool:={tool}\\WObj:=wobj0{frames}{within}
            \\LpFilter:=100\\SampleRate:=4\\MaxSpeedDeviation:={max_speed:g};
        EGMRun{kind} egmId,EGM_STOP_HOLD{all_axes}\\CondTime:=1\\RampInTime:=0.5;
        EGMReset egmId;
    ERROR
        IF ERRNO=ERR_UDPUC_COMM THEN
            TPWrite "{name}: no set points for one second";
            EGMReset egmId;
            RETURN;
        ENDIF
    ENDPROC
ENDMODULE
"""
    # A name may be none.
    parse(text)
    return text
