"""The page on loopback, with the engine of this process: `irbkin view` and `scene.serve`."""

from __future__ import annotations

import hmac
import json
import re
import secrets
import sys
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import SimpleNamespace
from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin.scene._data import Scene
from irbkin.scene._makers import of
from irbkin.scene._page import page
from irbkin.scene._solved import Engines, Joints

MOST_BYTES = 32_000_000
"""Bytes of a request."""
BEAT = 15.0
"""Time after which an event stream says that it is alive [s]."""
MOST_WAIT = 60.0
"""Time that a connection waits for the other side [s]."""
# The page holds its scripts and styles: nothing else is loaded, and nobody may frame it.
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; connect-src 'self'; form-action 'none'; frame-ancestors 'none'; "
    "base-uri 'none'",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 128

    def handle_error(self, request: Any, client_address: Any) -> None:
        if not isinstance(sys.exc_info()[1], OSError):
            super().handle_error(request, client_address)


class ServedView:
    """A scene in a browser of this machine, at `url`.

    Its first arm is moved by the page and by Python: `view.q` are its joint angles [rad], `view.T`
    is the pose of its tool; both can be set. So can `view.scene`: pages show it at once. Only pages
    with the token of `url` are answered. The server ends with `close()`, with a `with` statement,
    or with the process.

    >>> import irbkin
    >>> view = irbkin.scene.serve(irbkin.Robot("IRB 2600-12/1.65"))
    >>> view.q = [0.1, 0.2, 0.3, 0, 0.5, 0]
    >>> view.close()

    Args:
        scene: What it shows: a Scene, a Robot, or anything else that `irbkin.scene.of` takes.
        port: Port on 127.0.0.1; 0 takes a free one.

    Raises:
        TypeError: As `irbkin.scene.of`.
        ValueError: A number of the scene is not finite.
        OSError: The port is in use.
    """

    def __init__(self, scene: Any, *, port: int = 0) -> None:
        # Held by whoever changes the joints or the scene, and tells it.
        self._changed = threading.Condition()
        self._engines = Engines()
        # The newest of all that changed, which pages are to be told, and its number.
        self._pages: list[SimpleNamespace] = []
        self._number, self._is_closed = 0, False
        self._set(scene)
        self._is_first = True
        try:
            own = type("_Own", (_Handler,), {"view": self})
            self._server = _Server(("127.0.0.1", port), own)
        except OSError as error:
            words = f"port {port} cannot be used ({error.strerror}): 0 takes a free one"
            raise OSError(error.errno, words) from None
        self._token = secrets.token_urlsafe(18)
        self.url = f"http://127.0.0.1:{self._server.server_port}/{self._token}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def _set(self, scene: Any) -> None:
        own = scene if isinstance(scene, Scene) else of(scene)
        own.to_json()  # Refuses what no page reads.
        joints = Joints(own)
        with self._changed:
            self._scene, self._joints, self._q = own, joints, joints.start()
            self._tell({"scene": own.to_dict(), "q": self._q})

    @property
    def scene(self) -> Scene:
        """The scene that is shown."""
        return self._scene

    @scene.setter
    def scene(self, scene: Any) -> None:
        self._is_first = False
        self._set(scene)

    @property
    def q(self) -> Floats:
        """Joint angles of the first arm [rad], shape (n,); set them to move it."""
        return np.array(self._q)

    @q.setter
    def q(self, q: npt.ArrayLike) -> None:
        with self._changed:
            self._move(self._joints.checked(q))

    @property
    def T(self) -> Floats:
        """Pose of the tool of the first arm, shape (4, 4); set it to move it there, by the joint
        angles that are nearest to the present ones.
        """
        with self._changed:
            return self._joints.tool(self._q)

    @T.setter
    def T(self, T: npt.ArrayLike) -> None:
        with self._changed:
            self._move(self._joints.nearest(T, self._q))

    def _move(self, q: list[float], page: str = "") -> None:
        self._q = q
        self._tell({"q": q}, page)

    def _tell(self, event: dict[str, Any], page: str = "") -> None:
        """Tell all pages but one."""
        self._number += 1
        for it in self._pages:
            if it.page != page or not page:
                it.number = self._number
                it.event.update(event)
        self._changed.notify_all()

    def _moved(self, q: Any, page: str, seen: str) -> None:
        """Move as a page asks, unless it does not know yet what it is told."""
        with self._changed:
            known = float(seen or "inf")
            if all(it.page != page or it.number <= known for it in self._pages):
                self._move(self._joints.checked(q), page)

    def close(self) -> None:
        """End the server."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._server.shutdown()
        self._server.server_close()

    def __enter__(self) -> ServedView:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<ServedView {self._scene.title or 'scene'} at {self.url}>"


serve = ServedView


class _Handler(BaseHTTPRequestHandler):
    view: ServedView
    protocol_version = "HTTP/1.1"
    # An answer is one packet, sent at once.
    disable_nagle_algorithm = True
    wbufsize = 1 << 16
    timeout = MOST_WAIT

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""

    def _asked(self) -> tuple[str, str] | None:
        """The kind of request, and the name of the page; None if the request is refused: by another
        host's name, from another page, without the token, after the end.
        """
        token, _, rest = self.path[1:].partition("/")
        hosts = {f"{name}:{self.server.server_port}" for name in ("127.0.0.1", "localhost")}  # type: ignore[attr-defined]
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        own = host in hosts and origin in (None, f"http://{host}") and not self.view._is_closed
        if not own or not hmac.compare_digest(token.encode(), self.view._token.encode()):
            self._send(403, "not this page")
            return None
        kind, _, name = rest.partition("?")
        return kind, name

    def do_GET(self) -> None:
        if (asked := self._asked()) is None:
            return
        if asked[0] == "":
            self._send(200, page(self.view.scene, served=True), "text/html; charset=utf-8")
        elif asked[0] == "events":
            self._stream(asked[1])
        else:
            self._send(404, "no such file")

    def do_POST(self) -> None:
        if (asked := self._asked()) is None:
            return
        length = self.headers.get("Content-Length", "")
        if not re.fullmatch("[0-9]{1,9}", length) or int(length) > MOST_BYTES:
            words = f"Content-Length is {length[:20]!r}, it must be 0 to {MOST_BYTES}"
            return self._send(413, json.dumps({"error": words}))
        content = self.rfile.read(int(length))
        if len(content) < int(length):
            return
        text = content.decode("utf-8", "replace")
        if asked[0] == "ask":
            self._send(200, self.view._engines.answer(text, asked[1]), "application/json")
        elif asked[0] == "q":
            name, _, seen = asked[1].partition("&")
            try:
                self.view._moved(json.loads(text), name, seen)
            except (RecursionError, ValueError) as error:
                self._send(400, str(error))
            else:
                self._send(200, "")
        else:
            self._send(404, "no such file")

    def _send(self, code: int, text: str, kind: str = "text/plain; charset=utf-8") -> None:
        content = text.encode()
        # The rest of a request that is refused may be unread.
        closes = {"Connection": "close"} if code >= 400 else {}
        self._begin(code, {"Content-Type": kind, "Content-Length": str(len(content)), **closes})
        self.wfile.write(content)
        self.wfile.flush()

    def _begin(self, code: int, own: dict[str, str]) -> None:
        self.send_response(code)
        for name, value in {**HEADERS, **own}.items():
            self.send_header(name, value)
        self.end_headers()

    def _stream(self, page: str) -> None:
        """Send what Python and other pages change, until the page or the server ends."""
        view = self.view
        with view._changed:
            # All that changed between the page and its stream.
            scene = {} if view._is_first else {"scene": view._scene.to_dict()}
            event = {**scene, "q": view._q}
            own = SimpleNamespace(page=page, number=view._number, event=event)
            view._pages.append(own)
        try:
            self._begin(200, {"Content-Type": "text/event-stream", "Connection": "close"})
            while True:
                with view._changed:
                    view._changed.wait_for(lambda: own.event or view._is_closed, BEAT)
                    event, own.event = own.event, {}
                    head = f"id: {own.number}\ndata: " if event else ": "
                if not event and view._is_closed:
                    return
                self.wfile.write(f"{head}{json.dumps(event)}\n\n".encode())
                self.wfile.flush()
        finally:
            with view._changed:
                view._pages.remove(own)
