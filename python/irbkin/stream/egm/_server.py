"""The socket of a session: blocking, or in a loop of asyncio."""

from __future__ import annotations

import asyncio
import socket
import time
from collections.abc import Iterator
from typing import Any, Literal

import numpy.typing as npt

from irbkin.errors import StreamError
from irbkin.stream.egm._session import Reference, Session, Statistics

MOST_BYTES = 65_536
MOST_WAITING = 65_536
"""Datagrams that are read at once: far more than a socket keeps, and an end of a flood."""


class Server:
    """The sensor, as ABB calls it: the controller sends first, each of its datagrams is answered
    by a set point of the guard.

    The first sender of a message is the only one of a session; what others send is counted. What
    waits in the socket when a session begins is dropped; later the newest is answered. Each
    sequence number is one cycle of the guard. Of cycles whose datagrams are missing, the reference
    is asked in the first ones (`bridge`), in further ones the guard brakes; none is left out, so
    that set points are of one motion within the bounds, whichever of them arrive. Where the
    reference ends, raises, or Ctrl-C comes, the guard brakes and holds, and only then `run` ends.
    """

    def __init__(
        self,
        guard: Any,
        port: int = 6510,
        host: str = "127.0.0.1",
        *,
        mode: Literal["joint", "pose"] = "joint",
        bridge: float | None = None,
        watchdog: float = 0.25,
        connect: float = 60.0,
        linger: float = 1.0,
        max_following_error: npt.ArrayLike | None = None,
    ) -> None:
        """Bind a socket.

        Args:
            guard: A `Guard` of the controller's cycle, at the robot's joints.
            port: UDP port, the controller's Remote Port; 0 for a free one.
            host: Address to bind: this machine alone unless another one is given.
            mode: "joint", or "pose" for a program that runs EGMRunPose; then the tool and the base
                of the robot are as of EGMActPose.
            bridge: Time without datagrams in which the reference is asked [s]; when not given, the
                `hold` of the guard, 0.04 if it is 0.
            watchdog: Time without datagrams after which the session ends [s].
            connect: Time to wait for the first datagram [s].
            linger: Time in which the last set point is held after the end [s].
            max_following_error: How far the robot may be from the guard while it follows [rad], a
                number or shape (n,): beyond it the guard brakes, and `run` raises. By default
                0.01 rad and the way in 0.2 s (pose: 0.4 s) at the guard's fastest speed until then.

        Raises:
            OSError: The address cannot be bound.
            StreamError: An option that is not positive, or of a wrong shape.
        """
        self._guard, self._connect = guard, connect
        self._options: dict[str, Any] = {
            "mode": mode,
            "bridge": bridge,
            "watchdog": watchdog,
            "linger": linger,
            "max_following_error": max_following_error,
            "clock": time.monotonic,
        }
        self._session: Session | None = None
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.bind((host, port))
        except BaseException:
            self._socket.close()
            raise

    @property
    def address(self) -> tuple[str, int]:
        """Host and port of the socket."""
        host, port = self._socket.getsockname()
        return host, port

    @property
    def statistics(self) -> Statistics:
        """The counts of the last session; zeros before the first."""
        return self._session.statistics if self._session else Statistics()

    def run(self, reference: Reference, *, seconds: float | None = None) -> Statistics:
        """Serve one session.

        Args:
            reference: Called once a cycle with a `Feedback`, or an iterable: joints [rad], shape
                (n,), or a pose, shape (4, 4), or None to brake. StopIteration ends it.
            seconds: Time of the controller after which it ends [s].

        Raises:
            StreamError: No datagram in time, or the controller does not go with the guard.
        """
        session, until = self._begin(reference, seconds)
        while not session.is_done:
            try:
                self._socket.settimeout(max(until - time.monotonic(), 1e-6))
                data, sender = self._socket.recvfrom(MOST_BYTES)
                if answer := self.answer(session, data, sender):
                    self._socket.sendto(answer, session.peer)
            except (TimeoutError, BlockingIOError, ConnectionError):
                # On Windows, ConnectionError: the one before was sent to a port that is closed.
                pass
            except KeyboardInterrupt as interrupt:
                if session.error or session.heard is None:
                    raise
                session.end(interrupt)
            until = self._until(session, until)
        return self._end(session)

    async def run_async(self, reference: Reference, *, seconds: float | None = None) -> Statistics:
        """Serve one session in the running loop: as `run`. A task that is canceled brakes first."""
        session, until = self._begin(reference, seconds)
        loop = asyncio.get_running_loop()
        failed: asyncio.Future[None] = loop.create_future()
        transport, _ = await loop.create_datagram_endpoint(
            lambda: _Protocol(self, session, failed),
            sock=self._socket.dup(),
        )
        try:
            while not session.is_done:
                try:
                    left = max(until - time.monotonic(), 1e-6)
                    await asyncio.wait([failed], timeout=min(left, 0.5 * session.watchdog))
                except asyncio.CancelledError as canceled:
                    if session.error or session.heard is None:
                        raise
                    session.end(canceled)
                if failed.done():
                    failed.result()
                until = self._until(session, until)
        finally:
            transport.close()
        return self._end(session)

    def _begin(self, reference: Reference, seconds: float | None) -> tuple[Session, float]:
        sent = self._session.sent if self._session else 0
        options = {"seconds": seconds, "sent": sent, **self._options}
        self._session = Session(self._guard, reference, **options)
        for _ in self._waiting():
            pass
        return self._session, time.monotonic() + self._connect

    def answer(self, session: Session, data: bytes, sender: object) -> bytes | None:
        """Take a datagram and those that wait behind it, and answer the newest."""
        now = time.monotonic()
        session.take(data, sender, now)
        for behind in self._waiting():
            session.take(*behind, now)
        return session.reply()

    def _waiting(self) -> Iterator[tuple[bytes, object]]:
        self._socket.settimeout(0.0)
        for _ in range(MOST_WAITING):
            try:
                yield self._socket.recvfrom(MOST_BYTES)
            except BlockingIOError:
                return
            except ConnectionError:
                continue

    def _until(self, session: Session, until: float) -> float:
        """The time until which a datagram must come; raise if it is over."""
        if session.heard is not None:
            until = session.heard + session.watchdog
        if session.is_done or time.monotonic() < until:
            return until
        if session.held:
            # The program of the controller has ended, too.
            session.is_done = True
            return until
        if session.heard is not None:
            raise session.silence() from session.error
        host, port = self.address
        raise StreamError(
            f"no controller sent a datagram to {host}:{port} in {self._connect:g} s (connect): are "
            "Remote Address and Remote Port of its UDPUC device these, does EGMRun wait there?"
        )

    def _end(self, session: Session) -> Statistics:
        if session.error is not None:
            raise session.error
        return session.statistics

    def close(self) -> None:
        self._socket.close()

    def __enter__(self) -> Server:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


class _Protocol(asyncio.DatagramProtocol):
    def __init__(self, server: Server, session: Session, failed: asyncio.Future[None]) -> None:
        self.server, self.session, self.failed = server, session, failed

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport: Any = transport

    def datagram_received(self, data: bytes, sender: Any) -> None:
        if self.failed.done():
            return
        try:
            if answer := self.server.answer(self.session, data, sender):
                self.transport.sendto(answer, self.session.peer)
        except Exception as error:
            self.failed.set_exception(error)
            return
        if self.session.is_done:
            self.failed.set_result(None)
