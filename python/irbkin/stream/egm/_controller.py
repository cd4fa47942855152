"""A controller on loopback: a model of what answers EGM's set points, for tests and first steps.

What is from ABB's manual, and what is assumed, is in docs/guide/egm.md.
"""

import math
from collections import deque
from typing import Literal

import numpy as np
import numpy.typing as npt

from irbkin import Robot
from irbkin._arrays import Floats
from irbkin._core import decode, encode, pose
from irbkin.errors import IrbkinError
from irbkin.stream.egm._records import (
    EgmHeader,
    EgmPosition,
    EgmRobot,
    EgmSensor,
    EgmSpeed,
    MciState,
    MessageType,
)
from irbkin.stream.egm._session import WORD, axes_of, tool_at

CYCLE = 0.004032
"""The controller's cycle [s]."""


class Controller:
    """A robot behind a model of its controller. `tick` is a cycle, `receive` takes a set point."""

    def __init__(
        self,
        robot: Robot,
        q: npt.ArrayLike,
        *,
        cycle: float = CYCLE,
        gain: float = 5.0,
        lag: float = 0.016,
        smoothing: float = 0.004,
        ramp: float = 0.5,
        comm_timeout: float = 1.0,
        max_speed: float = math.inf,
        delay: float = 0.2,
    ) -> None:
        """Start at rest.

        Args:
            robot: The arm.
            q: Its joints [rad], shape (n,).
            cycle: Time between messages [s].
            gain: k of the law [1/s].
            lag: From a set point to the motion [s].
            smoothing: Time constant of the low pass [s]; 0 for level 0, raw.
            ramp: RampInTime and RampOutTime [s].
            comm_timeout: CommTimeout [s].
            max_speed: MaxSpeedDeviation [rad/s].
            delay: From the first answer to the motion, as between EGMActJoint and EGMRunJoint [s].
        """
        self.robot, self.cycle, self.gain, self.ramp = robot, cycle, gain, ramp
        self.q: Floats = np.array(q, dtype=np.float64)
        self.dq = np.zeros_like(self.q)
        self.state: Literal["DISCONNECTED", "CONNECTED", "RUNNING"] = "DISCONNECTED"
        self.seqno, self.ticks = 0, 0
        self._axes = axes_of(robot)
        self._speeds = np.full(robot.dof, max_speed)
        if robot.max_velocity is not None:
            self._speeds = np.minimum(self._speeds, robot.max_velocity)
        self._share = 1.0 if smoothing <= 0 else 1.0 - math.exp(-cycle / smoothing)
        self._timeout, self._delay = comm_timeout / cycle, delay / cycle
        self._set_points = deque([(self.q, self.dq)] * (1 + round(lag / cycle)))
        self._leaving = self.dq
        self._newest = self._smooth = (self.q, self.dq)
        self._last, self._since, self._silent = -1, 0, 0

    def receive(self, data: bytes) -> None:
        """Take a set point; an older one than the last is not taken."""
        try:
            sensor = decode(data, EgmSensor)
            seqno = (sensor.header or EgmHeader()).seqno or 0
            newest = self._wanted(sensor.planned or EgmPosition(), sensor.speed_ref or EgmSpeed())
        except IrbkinError:
            return
        if self._last >= 0 and not 0 < (seqno - self._last) % WORD < WORD // 2:
            return
        self._newest, self._last, self._silent = newest, seqno, 0
        if self.state == "DISCONNECTED":
            self.state, self._since = "CONNECTED", self.ticks

    def _wanted(self, planned: EgmPosition, speed: EgmSpeed) -> tuple[Floats, Floats]:
        """Joints [rad] and speeds of a message, in the robot's order."""
        q, dq = self.q.copy(), np.zeros_like(self.q)
        external = len(q) - min(len(q), 6)
        if planned.cartesian and planned.cartesian.pos and planned.cartesian.orient:
            T = pose(np.divide(planned.cartesian.pos, 1e3), wxyz=planned.cartesian.orient)
            return self.robot.ik_nearest(T, self._newest[0]), dq
        for own, joints, others in (
            (q, planned.joints, planned.external_joints),
            (dq, speed.joints, speed.external_joints),
        ):
            numbers = np.radians((*(joints or ()), *(others or ())[:external]))
            if len(numbers) == len(own) and np.isfinite(numbers).all():
                own[self._axes] = numbers
        return q, dq

    def tick(self) -> bytes:
        """Move for one cycle, and return the message to send."""
        self.ticks += 1
        self._silent += 1
        if self.state != "DISCONNECTED" and self._silent > self._timeout:
            self.state, self._since, self._last = "DISCONNECTED", self.ticks, -1
            self._leaving = self.dq
        if self.state == "CONNECTED" and self.ticks - self._since > self._delay:
            self.state, self._since = "RUNNING", self.ticks
        self._set_points.append(self._newest)
        lagging = self._set_points.popleft()
        self._smooth = tuple(
            own + self._share * (new - own) for own, new in zip(self._smooth, lagging, strict=True)
        )  # type: ignore[assignment]
        steps = (self.ticks - self._since) * self.cycle / self.ramp if self.ramp > 0 else 1.0
        if self.state == "RUNNING":
            reference, speed = self._smooth
            wanted = self.gain * (reference - self.q) + speed
            self.dq = np.clip(min(steps, 1.0) * wanted, -self._speeds, self._speeds)
        else:
            self.dq = self._leaving * max(1.0 - steps, 0.0)
        self.q = self.q + self.cycle * self.dq
        self.seqno = (self.seqno + 1) % WORD
        return self._message()

    def _message(self) -> bytes:
        """Where the robot is, and what state it is in."""
        header = EgmHeader(self.seqno, int(self.ticks * self.cycle * 1e3) % WORD, MessageType.DATA)
        feedback, planned = map(self._position, (self.q, self._newest[0]))
        mci = MciState.RUNNING if self.state == "RUNNING" else MciState.STOPPED
        is_met = bool(np.abs(self.dq).max() < 1e-4)
        # Motors on, the program running.
        return encode(EgmRobot(header, feedback, planned, 1, mci, is_met, rapid_exec_state=2))

    def _position(self, q: Floats) -> EgmPosition:
        degrees = np.degrees(q)[self._axes].tolist()
        external = tuple(degrees[6:]) or None
        return EgmPosition(tuple(degrees[:6]), tool_at(self.robot, q), external)
