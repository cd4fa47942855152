"""The page on loopback: whom it answers, what it answers, and the joints that both sides move."""

import http.client
import json
import signal
import subprocess
import sys
import threading
from contextlib import closing
from pathlib import Path
from urllib.parse import urlsplit

import command
import irbkin
import numpy as np
import pytest
from irbkin import scene
from irbkin._core import PageEngine

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


def test_a_request_that_is_too_long_is_refused(view):
    assert ask(view, "ask?one", "", **{"Content-Length": "99999999999"})[0] == 413


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
