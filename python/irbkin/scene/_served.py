"""The page on loopback, with the engine of this process: `irbkin view` and `scene.serve`."""

from __future__ import annotations

import hmac
import json
import queue
import secrets
import threading
from collections import OrderedDict
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin._core import PageEngine
from irbkin.errors import InvalidJointsError
from irbkin.scene._data import Scene
from irbkin.scene._makers import of
from irbkin.scene._page import page
from irbkin.scene._solved import Joints

if TYPE_CHECKING:
    import numpy.typing as npt

MOST_ENGINES = 32
"""Engines that are kept: a page has one, and another one for its program."""
MOST_BYTES = 32_000_000
"""Bytes of a request."""
BEAT = 15.0
"""Time after which an event stream says that it is alive [s]."""
# The page holds its scripts and styles: nothing else is loaded, and nobody may frame it.
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "connect-src 'self'; form-action 'none'; frame-ancestors 'none'; base-uri 'none'"
)


class ServedView:
    """A scene in a browser of this machine, at `url`.

    Its first arm is moved by the page and by Python: `view.q` are its joint angles [rad], `view.T`
    is the pose of its tool; both can be set. So can `view.scene`: pages show it at once. Only pages
    with the token of `url` are answered. The server ends with `close()`, with a `with` statement,
    or with the process.

    Args:
        scene: What it shows: a Scene, a Robot, or anything else that `irbkin.scene.of` takes.
        port: Port on 127.0.0.1; 0 takes a free one.

    Raises:
        TypeError: As `irbkin.scene.of`.
        OSError: The port is in use.
    """

    def __init__(self, scene: Any, *, port: int = 0) -> None:
        self._lock = threading.Lock()
        self._engines: OrderedDict[str, PageEngine] = OrderedDict()
        self._pages: dict[queue.SimpleQueue[str], str] = {}
        self._set(scene)
        try:
            self._server = ThreadingHTTPServer(("127.0.0.1", port), _Handler)
        except OSError as error:
            words = f"port {port} cannot be used ({error.strerror}): 0 takes a free one"
            raise OSError(error.errno, words) from None
        self._server.daemon_threads = True
        self._server.view = self  # type: ignore[attr-defined]
        self._token = secrets.token_urlsafe(18)
        self.url = f"http://127.0.0.1:{self._server.server_port}/{self._token}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def _set(self, scene: Any) -> None:
        self._scene = scene if isinstance(scene, Scene) else of(scene)
        self._joints = Joints(self._scene)
        self._q = self._joints.start()

    @property
    def scene(self) -> Scene:
        """What is shown."""
        return self._scene

    @scene.setter
    def scene(self, scene: Any) -> None:
        self._set(scene)
        self._tell({"scene": self._scene.to_dict()})

    @property
    def q(self) -> npt.NDArray[np.float64]:
        """Joint angles of the first arm [rad], shape (n,); set them to move it."""
        return np.array(self._q)

    @q.setter
    def q(self, q: npt.ArrayLike) -> None:
        self._move(self._joints.checked(q))

    @property
    def T(self) -> npt.NDArray[np.float64]:
        """Pose of the tool of the first arm, shape (4, 4); set it to move it there, by the joint
        angles that are nearest to the present ones.
        """
        return self._joints.tool(self._q)

    @T.setter
    def T(self, T: npt.ArrayLike) -> None:
        self._move(self._joints.nearest(T, self._q))

    def _move(self, q: list[float], page: str = "") -> None:
        self._q = q
        self._tell({"q": q}, page)

    def _tell(self, event: dict[str, Any], page: str = "") -> None:
        """Send an event to all pages but one."""
        text = json.dumps(event)
        with self._lock:
            for waiting, own in self._pages.items():
                if own != page or not page:
                    waiting.put(text)

    def close(self) -> None:
        """End the server."""
        with self._lock:
            for waiting in self._pages:
                waiting.put("")
        self._server.shutdown()
        self._server.server_close()

    def __enter__(self) -> ServedView:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<ServedView {self._scene.title or 'scene'} at {self.url}>"

    # What requests are answered, by their kind.

    def _answer(self, text: str, page: str) -> str:
        with self._lock:
            engine = self._engines.pop(page, None)
            self._engines[page] = engine or PageEngine()
            if len(self._engines) > MOST_ENGINES:
                self._engines.popitem(last=False)
        return json.dumps({"lost": True}) if engine is None else engine.answer(text)


def serve(scene: Any, *, port: int = 0) -> ServedView:
    """Serve a scene on loopback; open `.url` in a browser of this machine.

    >>> import irbkin
    >>> view = irbkin.scene.serve(irbkin.Robot("IRB 2600-12/1.65"))
    >>> view.q = [0.1, 0.2, 0.3, 0, 0.5, 0]
    >>> view.close()

    Args and errors: as `ServedView`.
    """
    return ServedView(scene, port=port)


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    # An answer is one packet, sent at once.
    disable_nagle_algorithm = True
    wbufsize = 1 << 16

    @property
    def view(self) -> ServedView:
        view: ServedView = self.server.view  # type: ignore[attr-defined]
        return view

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""

    def _asked(self) -> tuple[str, str] | None:
        """What is asked for, and the name of the page; None if the request is refused: by another
        host's name, from another page, without the token.
        """
        token, _, rest = self.path[1:].partition("/")
        hosts = {f"{name}:{self.server.server_port}" for name in ("127.0.0.1", "localhost")}  # type: ignore[attr-defined]
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        own = host in hosts and origin in (None, f"http://{host}")
        if not own or not hmac.compare_digest(token.encode(), self.view._token.encode()):
            self._send(403, "not this page")
            return None
        kind, _, name = rest.partition("?")
        return kind, name

    def do_GET(self) -> None:
        if (asked := self._asked()) is None:
            return
        if asked[0] == "":
            own = self.view.scene
            self._send(200, page(own, served=True), "text/html; charset=utf-8")
        elif asked[0] == "events":
            self._stream(asked[1])
        else:
            self._send(404, "no such file")

    def do_POST(self) -> None:
        if (asked := self._asked()) is None:
            return
        length = int(self.headers.get("Content-Length", -1))
        if not 0 <= length <= MOST_BYTES:
            self.close_connection = True
            self._send(413, json.dumps({"error": f"a request has at most {MOST_BYTES} bytes"}))
            return
        text = self.rfile.read(length).decode("utf-8", "replace")
        if asked[0] == "ask":
            self._send(200, self.view._answer(text, asked[1]), "application/json")
        elif asked[0] == "q":
            try:
                self.view._move(self.view._joints.checked(json.loads(text)), asked[1])
            except (InvalidJointsError, ValueError) as error:
                self._send(400, str(error))
            else:
                self._send(200, "")
        else:
            self._send(404, "no such file")

    def _send(self, code: int, text: str, kind: str = "text/plain; charset=utf-8") -> None:
        content = text.encode()
        self.send_response(code)
        self._headers({"Content-Type": kind, "Content-Length": str(len(content))})
        self.wfile.write(content)
        self.wfile.flush()

    def _headers(self, own: dict[str, str]) -> None:
        every = {
            "Cache-Control": "no-store",
            "Content-Security-Policy": POLICY,
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
        }
        for name, value in {**every, **own}.items():
            self.send_header(name, value)
        self.end_headers()

    def _stream(self, page: str) -> None:
        """Send what Python and other pages change, until the page or the server ends."""
        waiting: queue.SimpleQueue[str] = queue.SimpleQueue()
        view = self.view
        with view._lock:
            view._pages[waiting] = page
        self.close_connection = True
        self.send_response(200)
        self._headers({"Content-Type": "text/event-stream"})
        try:
            # What changed between the page and its stream.
            waiting.put(json.dumps({"q": view._q}))
            while True:
                try:
                    text = waiting.get(timeout=BEAT)
                except queue.Empty:
                    text = None
                if text == "":
                    return
                self.wfile.write(b": \n\n" if text is None else f"data: {text}\n\n".encode())
                self.wfile.flush()
        except OSError:
            return
        finally:
            with view._lock:
                del view._pages[waiting]
