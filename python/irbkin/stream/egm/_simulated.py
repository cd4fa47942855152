"""A model of a controller on a link that loses datagrams: in virtual time, or on a socket."""

import contextlib
import random
import socket
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from irbkin._arrays import Floats
from irbkin.stream.egm._controller import Controller
from irbkin.stream.egm._session import Reference, Session, Statistics


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
        """Send a datagram in a cycle, at a time [s]."""
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
    """The datagrams that come until a time."""
    while True:
        own.settimeout(max(until - time.monotonic(), 0.0))
        try:
            yield own.recv(65_536)
        except (BlockingIOError, TimeoutError):
            return
        except ConnectionError:
            continue
