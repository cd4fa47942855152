"""A simulated controller, for tests and first steps: a model of what answers EGM's set points, on a
link that loses datagrams, in virtual time or on a socket.

What is from ABB's manual, and what is assumed, is in docs/guide/egm.md.
"""

import contextlib
import math
import random
import socket
import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, Literal, NamedTuple

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
from irbkin.stream.egm._session import WORD, Reference, Session, Statistics, axes_of, tool_at

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
            delay: From the first answer to the motion, as between EGMActJoint and EGMRunJoint [s].
        """
        self.robot, self.cycle, self.gain, self.ramp = robot, cycle, gain, ramp
        self.q: Floats = np.array(q, dtype=np.float64)
        self.dq = np.zeros_like(self.q)
        self.state: Literal["DISCONNECTED", "CONNECTED", "RUNNING"] = "DISCONNECTED"
        self.seqno, self.ticks = 0, 0
        self._axes = axes_of(robot)
        speeds = np.inf if robot.max_velocity is None else robot.max_velocity
        self._speeds = np.full(robot.dof, speeds)
        self._share = 1.0 if smoothing <= 0 else 1.0 - math.exp(-cycle / smoothing)
        self._timeout, self._delay = comm_timeout / cycle, delay / cycle
        self._set_points = deque([(self.q, self.dq)] * (1 + round(lag / cycle)))
        self._leaving = self.dq
        self._newest = self._smooth = (self.q, self.dq)
        self._last, self._since, self._silent = -1, 0, 0

    def receive(self, data: bytes) -> None:
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


class Link:
    """A way on which datagrams are lost, come twice, or late behind others (`simulated`)."""

    def __init__(
        self,
        seed: int,
        loss: float = 0.0,
        duplicate: float = 0.0,
        late: float = 0.0,
        cut: tuple[float, float] | None = None,
    ) -> None:
        self._random = random.Random(seed)
        self._rates, self._cut = (loss, duplicate, late), cut
        self._way: list[tuple[int, bytes]] = []

    def put(self, data: bytes, tick: int, t: float) -> None:
        lost, twice, behind = (self._random.random() < rate for rate in self._rates)
        if lost or (self._cut and self._cut[0] <= t < self._cut[1]):
            return
        due = tick + (self._random.randint(1, 5) if behind else 0)
        self._way += [(due, data)] * (1 + twice)

    def due(self, tick: int) -> list[bytes]:
        arrived = [data for due, data in self._way if due <= tick]
        self._way = [it for it in self._way if it[0] > tick]
        return arrived


class Simulated(NamedTuple):
    """The motion of a simulated robot."""

    t: Floats
    """Times [s], shape (m,)."""
    q: Floats
    """Its joints at them [rad], shape (m, n)."""
    statistics: Statistics
    """The counts of the session."""


def simulated(
    guard: Any,
    controller: Controller,
    reference: Reference,
    *,
    seconds: float | None = None,
    seed: int = 0,
    loss: float = 0.0,
    duplicate: float = 0.0,
    late: float = 0.0,
    cut: tuple[float, float] | None = None,
    **options: Any,
) -> Simulated:
    """Run a session with a model of a controller, without a socket and without waiting.

    Args:
        guard: As of `Server`.
        controller: The model.
        reference: As of `Server.run`.
        seconds: As of `Server.run`.
        seed: The same seed, the same losses.
        loss: Share of datagrams that are lost, on either way.
        duplicate: Share that comes twice.
        late: Share that comes one to five cycles late.
        cut: Times between which all are lost [s].
        options: `mode`, `bridge`, `watchdog`, `linger`, `max_following_error` as of `Server`.

    Raises:
        StreamError: As of `Server.run`.
    """
    session = Session(guard, reference, seconds=seconds, **options)
    there, back = (Link(2 * seed + way, loss, duplicate, late, cut) for way in (0, 1))
    rows = []
    while not session.is_done:
        message = controller.tick()
        tick, now = controller.ticks, controller.ticks * controller.cycle
        rows.append((now, controller.q))
        there.put(message, tick, now)
        for data in there.due(tick):
            if answer := session.answer(data, "controller", now):
                back.put(answer, tick, now)
        for data in back.due(tick):
            controller.receive(data)
        if now - (session.heard or 0.0) > session.watchdog:
            raise session.silence()
    if session.error:
        raise session.error
    t, q = zip(*rows, strict=True)
    return Simulated(np.array(t), np.array(q), session.statistics)


def play(
    controller: Controller,
    address: tuple[str, int],
    say: Callable[[str], object],
    *,
    seconds: float = np.inf,
    seed: int = 0,
    **losses: Any,
) -> None:
    """Send the messages of a model to a server, in real time.

    Args:
        controller: The model.
        address: Host and port of the server.
        say: Called with a line of each change of its state.
        seconds: Time after which it ends [s].
        seed: As of `simulated`.
        losses: `loss`, `duplicate`, `late` and `cut` as of `simulated`.
    """
    there, back = (Link(2 * seed + way, **losses) for way in (0, 1))
    state, begin = "", time.monotonic()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
        own.connect(address)
        while (now := controller.ticks * controller.cycle) < seconds:
            there.put(controller.tick(), controller.ticks, now)
            for data in there.due(controller.ticks):
                # There may be no server yet.
                with contextlib.suppress(ConnectionError):
                    own.send(data)
            for data in _received(own, begin + now + controller.cycle):
                back.put(data, controller.ticks, now)
            for data in back.due(controller.ticks):
                controller.receive(data)
            if controller.state != state:
                state = controller.state
                say(f"{now:7.3f} s  {state}")


def _received(own: socket.socket, until: float) -> Iterator[bytes]:
    while True:
        own.settimeout(max(until - time.monotonic(), 0.0))
        try:
            yield own.recv(65_536)
        except (BlockingIOError, TimeoutError):
            return
        except ConnectionError:
            continue
