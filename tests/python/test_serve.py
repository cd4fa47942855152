"""The page on loopback: whom it answers, what it answers, and the joints that both sides move."""

import http.client
import json
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
from contextlib import closing
from pathlib import Path
from urllib.parse import urlsplit

import command
import irbkin
import numpy as np
import pytest
from irbkin import scene
from irbkin._core import PageEngine
from irbkin.scene import _served

DATA = Path(__file__).parents[1] / "data"
NAME = "IRB 2600-12/1.65"
ROBOT = irbkin.Robot(NAME)
HOME = [0.1, 0.2, 0.1, 0.3, 0.5, 0.2]


@pytest.fixture
def view():
    with scene.serve(scene.of(ROBOT.with_tool([0, 0, 0.1]).with_base([0.5, 0, 0]), q=HOME)) as own:
        yield own


def ask(view, path="", body=None, token=None, **headers):
    """The code and the text of an answer."""
    url = urlsplit(view.url)
    method = "GET" if body is None else "POST"
    whole = url.path if token is None else f"/{token}/"
    with closing(http.client.HTTPConnection(url.hostname, url.port, timeout=20)) as connection:
        connection.request(method, whole + path, body, headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()


def raw(view, text):
    """All that is answered to a text, until the other side closes."""
    with socket.create_connection(("127.0.0.1", urlsplit(view.url).port), timeout=20) as own:
        own.sendall(text.encode("latin-1"))
        own.shutdown(socket.SHUT_WR)
        return b"".join(iter(lambda: own.recv(65536), b""))


class Events:
    """The events that a page is sent."""

    def __init__(self, view, name):
        url = urlsplit(view.url)
        self.connection = http.client.HTTPConnection(url.hostname, url.port, timeout=20)
        self.connection.request("GET", f"{url.path}events?{name}")
        self.answer = self.connection.getresponse()
        assert self.answer.getheader("Content-Type") == "text/event-stream"

    def next(self):
        while True:
            line = self.answer.readline()
            if not line:
                return None
            if line.startswith(b"id: "):
                self.number = int(line[4:])
            if line.startswith(b"data: "):
                return json.loads(line[6:])


def test_the_page_is_served_to_whom_has_its_token_alone(view):
    code, text = ask(view)
    assert code == 200
    assert 'const ENGINE = "served";' in text
    assert view.scene.to_json().replace("<", "\\u003c") in text
    port = urlsplit(view.url).port
    for token, headers in (
        ("x" * 24, {}),
        ("", {}),
        (None, {"Host": f"irbkin.example:{port}"}),
        (None, {"Origin": "http://irbkin.example"}),
        (None, {"Origin": "null"}),
    ):
        for path, body in (("", None), ("events", None), ("ask?a", "{}"), ("q?a", "[]")):
            assert ask(view, path, body, token, **headers)[0] == 403
    # What follows a request that is refused is not read: no page writes a request in a body.
    inner = f"GET {urlsplit(view.url).path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n"
    outer = f"POST /x/q HTTP/1.1\r\nContent-Length: {len(inner)}\r\n\r\n"
    assert raw(view, outer + inner).count(b"HTTP/1.1 ") == 1
    assert ask(view, Host=f"localhost:{port}", Origin=f"http://localhost:{port}")[0] == 200
    np.testing.assert_array_equal(view.q, HOME)


@pytest.mark.parametrize("path", ["app.js", "../../pyproject.toml", "%2e%2e/etc", "irbkin.wasm.gz"])
def test_nothing_else_is_read(view, path):
    assert ask(view, path)[0] == 404
    assert ask(view, path, "{}")[0] == 404


def test_a_page_has_an_engine_of_its_own(view):
    robot = json.dumps({"do": "robot", "name": NAME})
    fk = json.dumps({"do": "fk", "q": HOME})
    own = PageEngine()
    for text in (robot, fk):
        assert "error" not in json.loads(own.answer(text))
    # The first request of a page is lost, so that the page tells what it has set.
    assert json.loads(ask(view, "ask?one", robot)[1]) == {"lost": True}
    assert ask(view, "ask?one", robot) == (200, PageEngine().answer(robot))
    assert ask(view, "ask?one", fk) == (200, own.answer(fk))
    ask(view, "ask?two", fk)
    assert "there is no robot" in ask(view, "ask?two", fk)[1]
    for index in range(40):
        ask(view, f"ask?other{index}", fk)
    assert json.loads(ask(view, "ask?one", fk)[1]) == {"lost": True}


def test_pages_and_python_move_the_same_joints(view):
    first, second = Events(view, "first"), Events(view, "second")
    assert first.next() == second.next() == {"q": HOME}
    view.q = np.zeros(6)
    assert first.next() == second.next() == {"q": [0.0] * 6}
    # A page is not told what it told itself.
    assert ask(view, "q?first", json.dumps(HOME)) == (200, "")
    assert second.next() == {"q": HOME}
    np.testing.assert_array_equal(view.q, HOME)
    own = ROBOT.with_tool([0, 0, 0.1]).with_base([0.5, 0, 0])
    np.testing.assert_allclose(view.T, own.fk(HOME), atol=1e-12)
    T = view.T
    T[2, 3] -= 0.1
    view.T = T
    np.testing.assert_allclose(own.fk(view.q), T, atol=1e-9)
    np.testing.assert_allclose(view.q, own.ik_nearest(T, HOME), atol=1e-9)
    assert first.next() == second.next() == {"q": view.q.tolist()}
    view.scene = irbkin.Robot("UR5e")
    assert first.next()["scene"]["arms"][0]["name"] == "UR5e"
    view.close()
    assert second.next() is not None
    assert second.next() is None
    for it in (first, second):
        it.connection.close()


@pytest.mark.parametrize("q", [[1, 2, 3], [0, 0, 0, 0, 0, np.nan], "far", [[0] * 6]])
def test_wrong_joints_are_refused_on_both_sides(view, q):
    with pytest.raises(irbkin.InvalidJointsError, match="q must be 6 finite joint angles"):
        view.q = q
    code, text = ask(view, "q?one", json.dumps(q))
    assert (code, "q must be 6 finite" in text) == (400, True)
    assert ask(view, "q?one", "{")[0] == 400
    np.testing.assert_array_equal(view.q, HOME)


@pytest.mark.parametrize("length", ["99999999999", "9" * 5000, "-5", "abc", "1_0", "\xb2", None])
def test_a_request_of_no_length_that_is_read_is_refused(view, length, capsys):
    head = (
        f"POST {urlsplit(view.url).path}ask?one HTTP/1.1\r\nHost: {urlsplit(view.url).netloc}\r\n"
    )
    own = "" if length is None else f"Content-Length: {length}\r\n"
    assert raw(view, f"{head}{own}\r\n{{}}").startswith(b"HTTP/1.1 413 ")
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    "text", ["[" * 100000, f"[{'9' * 400}, 0, 0, 0, 0, 0]", f"[{'9' * 5000}]", "\udcff"]
)
def test_texts_that_are_no_joints_are_refused(view, text, capsys):
    assert ask(view, "q?one", text.encode("utf-8", "surrogatepass"))[0] == 400
    assert capsys.readouterr().err == ""


def test_half_a_request_moves_nothing(view):
    url = urlsplit(view.url)
    head = f"POST {url.path}q?one HTTP/1.1\r\nHost: {url.netloc}\r\nContent-Length: 100\r\n\r\n"
    assert raw(view, f"{head}[0,0,0,0,0,0]") == b""
    np.testing.assert_array_equal(view.q, HOME)


def test_a_connection_that_says_nothing_ends(view, monkeypatch):
    assert 0 < _served._Handler.timeout <= 60
    monkeypatch.setattr(_served._Handler, "timeout", 0.2)
    with socket.create_connection(("127.0.0.1", urlsplit(view.url).port), timeout=20) as own:
        own.sendall(b"GET / HT")
        assert own.recv(100) == b""


def test_a_page_that_goes_away_is_no_fault(view, capsys):
    url = urlsplit(view.url)
    for path in ("", "events?one"):
        with socket.create_connection(("127.0.0.1", url.port)) as own:
            linger = struct.pack("ii", 1, 0)
            own.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
            own.sendall(f"GET {url.path}{path} HTTP/1.1\r\nHost: {url.netloc}\r\n\r\n".encode())
    for _ in range(20):
        view.q = HOME
        time.sleep(0.01)
    assert capsys.readouterr().err == ""


def test_nothing_is_answered_after_the_end(view):
    url = urlsplit(view.url)
    with closing(http.client.HTTPConnection(url.hostname, url.port, timeout=20)) as connection:
        for q, code in ((HOME, 200), ([0] * 6, 403)):
            connection.request("POST", f"{url.path}q?one", json.dumps(q))
            answer = connection.getresponse()
            assert (answer.status, answer.read() != b"") == (code, code == 403)
            view.close()
    np.testing.assert_array_equal(view.q, HOME)


def test_a_page_is_told_the_newest_alone(view):
    events = Events(view, "one")
    assert events.next() == {"q": HOME}
    # Nothing is sent while Python is at it.
    with view._changed:
        for _ in range(1000):
            view.q = np.zeros(6)
        view.scene = irbkin.Robot("UR5e")
        view.q = HOME
    event = events.next()
    assert (event["scene"]["arms"][0]["name"], event["q"]) == ("UR5e", HOME)
    view.q = np.zeros(6)
    assert events.next() == {"q": [0.0] * 6}
    # A stream that begins later has the scene, too.
    later = Events(view, "two")
    event = later.next()
    assert (event["scene"]["arms"][0]["name"], event["q"]) == ("UR5e", [0.0] * 6)
    for it in (events, later):
        it.connection.close()


def test_a_page_that_does_not_know_the_newest_moves_nothing(view):
    events = Events(view, "one")
    assert events.next() == {"q": HOME}
    seen = events.number
    view.q = np.zeros(6)
    assert ask(view, f"q?one&{seen}", json.dumps(HOME)) == (200, "")
    np.testing.assert_array_equal(view.q, np.zeros(6))
    assert events.next() == {"q": [0.0] * 6}
    assert ask(view, f"q?one&{events.number}", json.dumps(HOME)) == (200, "")
    np.testing.assert_array_equal(view.q, HOME)
    # What it told itself is nothing that it has to know.
    assert ask(view, f"q?one&{events.number}", json.dumps([0.0] * 6)) == (200, "")
    np.testing.assert_array_equal(view.q, np.zeros(6))
    assert ask(view, "q?one&x", json.dumps(HOME))[0] == 400
    events.connection.close()


def test_a_scene_with_a_number_that_no_page_reads_is_refused(view):
    before = view.scene
    place = r"scene\.marks\[0\]\.point\[1\] is nan"
    with pytest.raises(ValueError, match=place):
        view.scene = scene.Scene(marks=(scene.Mark((0.0, float("nan"), 0.0), "x"),))
    assert view.scene is before
    assert ask(view)[0] == 200


def test_an_arm_of_a_file_is_solved_by_its_urdf():
    ur = irbkin.Robot.from_urdf(DATA / "ur5e.urdf", tip="tool0")
    ur = ur.with_base(irbkin.pose([0.1, 0.2, 0.3], wxyz=[0.6, 0, 0, 0.8])).with_tool([0, 0.1, 0.2])
    assert not scene.of(ROBOT.with_base([1, 2, 3])).arms[0].urdf
    other = ROBOT.with_limits(0.5 * ROBOT.limits)
    for robot in (ur, other):
        with scene.serve(robot) as view:
            assert view.scene.arms[0].urdf
            T = robot.fk(np.array(HOME) + 0.05)
            view.q = HOME
            view.T = T
            np.testing.assert_allclose(view.q, np.array(HOME) + 0.05, atol=1e-9)
            with pytest.raises(irbkin.UnreachableError):
                view.T = irbkin.pose([9, 9, 9])


def test_the_command_serves_until_it_is_interrupted():
    arguments = [sys.executable, "-m", "irbkin", "view", NAME, "--no-browser"]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as done:
        timer = threading.Timer(60, done.kill)
        timer.start()
        url = urlsplit(done.stdout.readline().strip())
        with closing(http.client.HTTPConnection(url.hostname, url.port, timeout=20)) as connection:
            connection.request("GET", url.path)
            assert connection.getresponse().status == 200
        done.send_signal(signal.SIGINT)
        assert done.wait() != 0
        timer.cancel()
    words = command.refused("view", NAME, "--port", "99999")
    assert "port must be 0-65535" in words
    with scene.serve(ROBOT) as view:
        port = urlsplit(view.url).port
        assert f"port {port} cannot be used" in command.refused("view", NAME, "--port", port)
