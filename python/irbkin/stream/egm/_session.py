"""One session with a controller: datagrams in, datagrams out, no socket and no clock."""

import logging
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from irbkin import Robot
from irbkin._arrays import Floats
from irbkin._core import decode, encode, to_xyz_wxyz
from irbkin.errors import StreamError
from irbkin.stream.egm._records import (
    EgmHeader,
    EgmPose,
    EgmPosition,
    EgmRobot,
    EgmSensor,
    EgmSpeed,
    MciState,
    MessageType,
)

log = logging.getLogger("irbkin.stream.egm")
log.addHandler(logging.NullHandler())

WORD = 2**32
"""Sequence numbers and times [ms] are 32 bits."""
WINDOW = 1024
"""Of so many of the last sequence numbers it is known whether they came."""
BRIDGE = 0.04
"""Time without datagrams in which the reference is asked, for guards without a hold [s]."""
TOLERANCE = 0.01
"""How far the robot may be from a guard at rest [rad]."""
TOLERANCE_MM = 1.0
"""How far the tool of a controller may be from the robot's [mm]."""
DRIFT = 1e-3
"""By how much the controller's clock may be slower at most [1]."""
JITTER = 0.002
"""By how much a time of the controller is off at most [s]: it is rounded to 1 ms."""
OBSERVED = 12
"""Cycles over which the cycle time is measured: a time is rounded to 1 ms, 2 % of them."""
FOLLOWING = {"joint": 0.2, "pose": 0.4}
"""How far behind a robot may be by default, in time at the guard's fastest speed until then [s]:
0.18 s are needed with a lag of 0.1 s and a ramp of 0.5 s, and 1 / k more without speeds."""


class Statistics(NamedTuple):
    """Datagrams of a session, and how its references fared."""

    received: int = 0
    """Datagrams that were answered."""
    lost: int = 0
    """Sequence numbers that never came."""
    late: int = 0
    """Datagrams behind a later one, or too old, or read together with a later one: not answered."""
    duplicate: int = 0
    """Datagrams that came again: not answered."""
    broken: int = 0
    """No messages of a controller, or of this robot."""
    foreign: int = 0
    """Datagrams by other senders."""
    bridged: int = 0
    """Cycles without a datagram in which the reference went on."""
    refused: int = 0
    """References that the guard did not take as they are."""
    stops: int = 0
    """Times that the guard stopped following a reference, before the end."""
    slow: int = 0
    """Answers for which the reference took longer than a cycle."""


class Feedback(NamedTuple):
    """The argument of a reference."""

    t: float
    """Time since the robot follows [s], in cycles of the controller."""
    q: Floats
    """The robot's joints [rad], shape (n,), by the last datagram."""
    step: Any
    """The last `Step` of the guard; None at first."""
    message: EgmRobot
    """The last message."""


Reference: TypeAlias = "Callable[[Feedback], Any] | Iterable[Any]"


class Session:
    """The answers to the datagrams of one controller. Sequence number s is answered by the set
    point of cycle s of one motion of the guard: a datagram that is missing is a step, too.
    """

    def __init__(
        self,
        guard: Any,
        reference: Reference,
        *,
        mode: Literal["joint", "pose"] = "joint",
        bridge: float | None = None,
        watchdog: float = 0.25,
        linger: float = 1.0,
        max_following_error: npt.ArrayLike | None = None,
        seconds: float | None = None,
        sent: int = 0,
        clock: Callable[[], float] = lambda: 0.0,
    ) -> None:
        """`sent` is the last sequence number that was sent, by `clock` a reference is slow [s]."""
        bridge = (getattr(guard, "hold", 0.0) or BRIDGE) if bridge is None else bridge
        times = {"bridge": bridge, "watchdog": watchdog, "linger": linger}
        for name, time in times.items():
            if not 0 <= time < np.inf:
                raise StreamError(f"{name} is {time} s, it must be finite and not negative")
        self.guard, self.mode, self.watchdog = guard, mode, watchdog
        self.robot, self.cycle = guard.robot, float(guard.cycle)
        if mode not in ("joint", "pose") or (mode == "pose" and self.robot.dof != 6):
            raise StreamError(
                f'mode is {mode!r}, it must be "joint", or "pose" of six axes '
                f"(this robot has {self.robot.dof})"
            )
        bound = np.array(np.inf if max_following_error is None else max_following_error, float)
        if bound.shape not in ((), (self.robot.dof,)) or not (bound > 0).all():
            raise StreamError(
                f"max_following_error is {max_following_error!r}, it must be positive [rad], a "
                f"number or one for each of {self.robot.dof} joints"
            )
        self._bound = None if max_following_error is None else bound
        self.bridge, self.linger = int(bridge / self.cycle), int(linger / self.cycle)
        self.most = np.inf if seconds is None else seconds / self.cycle
        left = iter(()) if callable(reference) else iter(reference)
        self.ask = reference if callable(reference) else lambda feedback: next(left)
        self.axes = axes_of(self.robot)
        self.heard: float | None = None
        self.error: BaseException | None = None
        self.is_done = False
        # Cycles since the end.
        self.held = 0
        self.peer: Any = None
        self.sent = sent
        self._clock = clock
        self._count: Counter[str] = Counter()
        self._cycles = self._seen = self._span = self._disagreed = 0
        self._offset = self._took = self._measured = 0.0
        # The datagram to answer, and the number of the last that was answered.
        self._waiting: tuple[int, Floats, EgmRobot, float] | None = None
        self._last: int | None = None
        self._fastest = np.zeros(self.robot.dof)
        self._is_ending = self._was_running = self._was_following = False
        self._step: Any = None

    @property
    def statistics(self) -> Statistics:
        return Statistics(**self._count)

    def end(self, error: BaseException | None = None) -> None:
        """Brake from now on, hold, and be done; `error` is why."""
        self._is_ending, self.error = True, self.error or error

    def silence(self) -> StreamError:
        """Brake without a controller that listens, and return what is wrong."""
        while self.guard.step(None).state != "holding":
            pass
        return StreamError(
            f"no datagram for {self.watchdog:g} s (watchdog): the guard has braked, and the "
            "controller goes on by its last set point until its CommTimeout"
        )

    def answer(self, data: bytes, sender: object, now: float) -> bytes | None:
        """The datagram that answers one, or None: as `take` and `reply`."""
        self.take(data, sender, now)
        return self.reply()

    def take(self, data: bytes, sender: object, now: float) -> None:
        """Take a datagram, which came `now` [s] by any clock; of several, `reply` answers the
        newest. The first sender of a message is the only one.
        """
        if self.peer not in (None, sender):
            self._count["foreign"] += 1
            return
        is_message = False
        try:
            message = decode(data, EgmRobot)
            seqno, tm = _head(message)
            is_message = True
            q = self._joints(message)
        except StreamError:
            if is_message and self.peer is None:
                raise
            self._count["broken"] += 1
            return
        if self.peer is None:
            self.peer, self._newest, self._start = sender, (seqno - 1) % WORD, (seqno, tm)
            self._tm, self._time = tm, now
            external = (message.feedback or EgmPosition()).external_joints or ()
            # Axes that are none of the robot's [deg or mm].
            self._others = external[max(self.robot.dof - 6, 0) :]
        ahead = _signed(seqno - self._newest)
        if self._is_new(ahead):
            self._check_cycle(seqno, tm)
            is_late = self._is_late(tm, ahead, now)
            self._count["late"] += is_late or self._waiting is not None
            if not is_late:
                self._waiting = (seqno, q, message, now)

    def reply(self) -> bytes | None:
        """The answer to the newest datagram that was taken, or None."""
        if self._waiting is None:
            return None
        (seqno, q, message, now), self._waiting = self._waiting, None
        gap = 1 if self._last is None else (seqno - self._last) % WORD
        self._check_gap(gap)
        self._last = seqno
        self._count["received"] += 1
        is_resting = self._step is None or not np.any(self._step.dq)
        self._took = 0.0
        self._advance(gap, q, message)
        self.heard = now + self._took
        self._judge_reference(is_resting)
        return self._set_point(now)

    def _joints(self, message: EgmRobot) -> Floats:
        """The joints of a message [rad], in the robot's order."""
        feedback, dof = message.feedback or EgmPosition(), self.robot.dof
        joints, external = feedback.joints or (), feedback.external_joints or ()
        if len(joints) != min(dof, 6) or len(joints) + len(external) < dof:
            raise StreamError(
                f"feedback has {len(joints)} joints and {len(external)} external ones, the "
                f"guard's has {dof} joints (is it another robot?)"
            )
        q = np.empty(dof)
        q[self.axes] = np.radians((*joints, *external)[:dof])
        if not np.isfinite(q).all():
            raise StreamError(f"feedback.joints is {joints}: every joint must be finite")
        return q

    def _is_new(self, ahead: int) -> bool:
        """Whether a number is ahead of all others; count those that are missing, and old ones."""
        if ahead > 0:
            self._check_gap(ahead)
            self._seen = (self._seen << min(ahead, WINDOW) | 1) & (1 << WINDOW) - 1
            self._span += ahead
            self._count["lost"] += ahead - 1
            return True
        is_again = bool(self._seen >> -ahead & 1)
        self._seen |= 1 << -ahead if -ahead < WINDOW else 0
        self._count["duplicate" if is_again else "late"] += 1
        # One before the first was not missed.
        self._count["lost"] -= not is_again and -ahead < min(self._span, WINDOW)
        return False

    def _is_late(self, tm: int, ahead: int, now: float) -> bool:
        step, wanted = _signed(tm - self._tm) / 1e3, ahead * self.cycle
        self._newest, self._tm = (self._newest + ahead) % WORD, tm
        # The least delay is the clocks' difference, which drifts.
        self._offset += DRIFT * wanted
        self._time += step
        if abs(step - wanted) > JITTER + 0.1 * wanted:
            # The controller's clock was set, or its time is wrong: it says nothing of the delay.
            self._time = now - self._offset
        delay = now - self._time
        self._offset = min(self._offset, delay)
        return delay - self._offset > max(self.bridge, 1) * self.cycle

    def _check_gap(self, gap: int) -> None:
        """Refuse a controller that jumps, and answers that come too late."""
        if self._last is not None and gap * self.cycle > self.watchdog + self._took:
            raise StreamError(
                f"header.seqno jumps by {gap}, {gap * self.cycle:.3g} s: at most "
                f"{self.watchdog:g} s may be missing or late (watchdog)"
            )

    def _check_cycle(self, seqno: int, tm: int) -> None:
        """Refuse another cycle time if it is measured three times: one alone may be wrong."""
        cycles = (seqno - self._start[0]) % WORD
        if cycles < OBSERVED:
            return
        measured = (tm - self._start[1]) % WORD / 1e3 / cycles
        is_same = abs(measured - self._measured) <= 0.1 * measured
        is_other = abs(measured - self.cycle) > 0.1 * self.cycle
        self._disagreed = is_other * (1 + is_same * self._disagreed)
        self._start, self._measured = (seqno, tm), measured
        if self._disagreed > 2:
            raise StreamError(
                f"the controller's cycle is {measured * 1e3:.2f} ms, the guard's "
                f"{self.cycle * 1e3:.2f} ms: make a Guard of the controller's cycle"
            )

    def _judge_reference(self, is_resting: bool) -> None:
        """Say that a reference was slow, and end if the guard moved meanwhile for too long."""
        text = f"the reference took {self._took * 1e3:.0f} ms"
        self._count["slow"] += self._took > self.cycle
        if self._took <= max(self.bridge, 1) * self.cycle:
            return
        log.warning("cycle %d: %s", self._cycles, text)
        if is_resting or self._took > self.watchdog:
            # The next datagram is one cycle on, whatever its number is: meanwhile none was lost.
            self._last = None
        if not is_resting and self._took > self.watchdog:
            words = f"{text}, at most {self.watchdog:g} s are allowed while the guard moves "
            self.end(StreamError(f"{words}(watchdog): calculate ahead, or in another thread"))

    def _advance(self, gap: int, q: Floats, message: EgmRobot) -> None:
        """Step the guard for a message and for the cycles without one before it."""
        is_running = message.mci_state in (None, MciState.RUNNING) and message.motor_state != 2
        if not (is_running and self._was_running):
            self._check_posture(q, message)
        elif not self._is_ending:
            self._check_following(q)
        self._was_running = is_running
        for left in range(gap - 1, -1, -1):
            is_bridged = left > 0 and gap - 1 - left < self.bridge
            self._count["bridged"] += is_running and is_bridged
            self._cycle(is_running and (left == 0 or is_bridged), q, message)
            self._cycles += is_running
        is_held = self._is_ending and self._step.state == "holding"
        self.held = self.held + 1 if is_held else 0
        self.is_done = is_held and (not is_running or self.held > self.linger)

    def _cycle(self, is_asked: bool, q: Floats, message: EgmRobot) -> None:
        """Step the guard, by the reference if it is asked."""
        wanted = None
        begin = self._clock()
        self._is_ending |= self._cycles >= self.most
        try:
            if is_asked and not self._is_ending:
                wanted = self.ask(Feedback(self._cycles * self.cycle, q, self._step, message))
            self._step = self.guard.step(wanted)
        except BaseException as error:
            # It ends, is no reference, or Ctrl-C came in it: this cycle is a step all the same.
            self.end(None if isinstance(error, StopIteration) else error)
            wanted = None
            self._step = self.guard.step(None)
        self._took += self._clock() - begin
        self._fastest = np.maximum(self._fastest, np.abs(self._step.dq))
        is_refused = wanted is not None and not self._step.accepted
        self._count["refused"] += is_refused
        is_following = self._step.state == "following"
        if self._was_following and not is_following and not self._is_ending:
            self._count["stops"] += 1
            log.warning("cycle %d: %s", self._cycles, self._step.reason)
        self._was_following = is_following

    def _check_posture(self, q: Floats, message: EgmRobot) -> None:
        if apart := self._apart(q, TOLERANCE):
            raise StreamError(f"{apart}: start a Guard where the robot is")
        pose = message.feedback.cartesian if message.feedback else None
        if self.mode == "pose" and pose and pose.pos:
            off = float(np.linalg.norm(self.robot.fk(q)[:3, 3] * 1e3 - pose.pos))
            if not off <= TOLERANCE_MM:
                raise StreamError(
                    f"the tool of the controller is {off:.1f} mm from the robot's, more than "
                    f"{TOLERANCE_MM:g} mm: give the robot the tool and the base that EGMActPose has"
                )

    def _check_following(self, q: Floats) -> None:
        default = TOLERANCE + FOLLOWING[self.mode] * self._fastest
        if apart := self._apart(q, default if self._bound is None else self._bound):
            words = f"{apart} (max_following_error): the guard has braked; is the robot held, or "
            self.end(StreamError(f"{words}MaxSpeedDeviation too low?"))
            log.warning("cycle %d: %s", self._cycles, self.error)

    def _apart(self, q: Floats, most: npt.ArrayLike) -> str | None:
        """Which joint of the robot is farther from the guard's than its bound."""
        own, bound = np.asarray(self.guard.q), np.broadcast_to(most, len(q))
        joint = int((np.abs(q - own) - bound).argmax())
        if abs(q[joint] - own[joint]) <= bound[joint]:
            return None
        return (
            f"joint {joint + 1} of the robot is at {np.degrees(q[joint]):.2f} deg, of the "
            f"guard at {np.degrees(own[joint]):.2f} deg, more than "
            f"{np.degrees(bound[joint]):.2f} deg apart"
        )

    def _set_point(self, now: float) -> bytes:
        """The last step's message; in pose mode without speeds, whose units the manual lacks."""
        self.sent = (self.sent + 1) % WORD
        header = EgmHeader(self.sent, int(now * 1e3) % WORD, MessageType.CORRECTION)
        q, dq = (np.degrees(it)[self.axes].tolist() for it in (self._step.q, self._step.dq))
        external = (*q[6:], *self._others) or None
        if self.mode == "pose":
            pose = tool_at(self.robot, self._step.q)
            return encode(EgmSensor(header, EgmPosition(None, pose, external)))
        speeds = (*dq[6:], *(0.0 for _ in self._others)) or None
        planned = EgmPosition(tuple(q[:6]), external_joints=external)
        speed = EgmSpeed(tuple(dq[:6]), external_joints=speeds)
        return encode(EgmSensor(header, planned, speed))


def axes_of(robot: Robot) -> list[int]:
    """The robot's joints in the order of ABB's axes: axis 7 of seven is the third from the base."""
    return [0, 1, 3, 4, 5, 6, 2] if robot.dof == 7 else list(range(robot.dof))


def tool_at(robot: Robot, q: Floats) -> EgmPose:
    xyz, wxyz = to_xyz_wxyz(robot.fk(q))
    return EgmPose(tuple((xyz * 1e3).tolist()), tuple(wxyz.tolist()))


def _signed(difference: int) -> int:
    """A difference of numbers of 32 bits that wrap."""
    return (difference + WORD // 2) % WORD - WORD // 2


def _head(message: EgmRobot) -> tuple[int, int]:
    header = message.header or EgmHeader()
    if header.seqno is None or header.tm is None or header.mtype != MessageType.DATA:
        raise StreamError(f"header is {header}: it must have seqno, tm and mtype 2 (data)")
    return header.seqno, header.tm
