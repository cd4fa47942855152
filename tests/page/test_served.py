"""The page that Python serves, in a real Chromium: `irbkin view` and `scene.serve`."""

import shutil
from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import scene

playwright = pytest.importorskip("playwright.sync_api")

DATA = Path(__file__).parents[1] / "data"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
ROBOT = irbkin.Robot("IRB 2600-12/1.65")
HOME = np.array([0.1, 0.2, 0.1, 0.3, 0.5, 0.2])


@pytest.fixture(scope="module")
def browser():
    if CHROMIUM is None:
        pytest.skip("there is no Chromium")
    with playwright.sync_playwright() as started:
        arguments = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = started.chromium.launch(executable_path=CHROMIUM, args=arguments)
        yield browser
        browser.close()


@pytest.fixture
def opened(browser):
    """Open an address; no error may be on the console in the end."""
    errors, pages = [], []

    def open_page(address):
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        pages.append(page)
        page.on("console", lambda it: errors.append(it.text) if it.type == "error" else None)
        page.on("pageerror", lambda it: errors.append(str(it)))
        page.goto(address)
        page.wait_for_selector("html[data-ready]")
        return page

    yield open_page
    for page in pages:
        page.close()
    # Chromium says where nobody listens any more.
    assert [it for it in errors if "ERR_CONNECTION_REFUSED" not in it] == []


def agrees(page, view):
    """Wait until a page and Python have the same joints."""
    page.wait_for_function(
        "(q) => !irbkin.solving && q.every((it, i) => Math.abs(it - irbkin.state.q[i]) < 1e-12)",
        arg=view.q.tolist(),
    )


def test_two_pages_and_python_move_one_arm(opened):
    robot = ROBOT.with_tool([0, 0, 0.1]).with_base([0.2, 0, 0])
    with scene.serve(scene.of(robot, q=HOME)) as view:
        page, other = opened(view.url), opened(view.url)
        assert "8 solutions" in page.locator(".verdict").inner_text()
        view.q = HOME + 0.1
        agrees(page, view)
        agrees(other, view)
        T = view.T
        T[2, 3] -= 0.05
        view.T = T
        agrees(page, view)
        x, y, _ = page.evaluate("() => irbkin.view.camera.project(place(irbkin.state.T))")
        page.mouse.move(x, y)
        page.mouse.down()
        for step in range(20):
            page.mouse.move(x + 2 * step, y - 2 * step)
            page.wait_for_timeout(16)
        page.mouse.up()
        page.wait_for_timeout(500)
        assert np.abs(robot.fk(view.q)[:3, 3] - T[:3, 3]).max() > 0.02
        agrees(page, view)
        agrees(other, view)
        shown = page.evaluate("() => irbkin.state.T")
        np.testing.assert_allclose(np.reshape(shown, (4, 4)).T, robot.fk(view.q), atol=1e-9)
        view.scene = irbkin.Robot("UR5e")
        page.wait_for_function("() => irbkin.robot.name === 'UR5e'")


def test_an_arm_of_a_file_is_solved_as_it_is(opened):
    ur = irbkin.Robot.from_urdf(DATA / "ur5e.urdf", tip="tool0").with_tool([0, 0.1, 0.2])
    with scene.serve(scene.of(ur, q=HOME)) as view:
        page = opened(view.url)
        agrees(page, view)
        assert page.evaluate("() => irbkin.state.solutions.length") == len(ur.ik(ur.fk(HOME)))
        shown = page.evaluate("() => irbkin.state.T")
        np.testing.assert_allclose(np.reshape(shown, (4, 4)).T, ur.fk(HOME), atol=1e-9)


def test_a_file_without_the_engine_draws_and_plays(opened, tmp_path, monkeypatch):
    monkeypatch.setattr("irbkin.scene._page.engine", str)
    move = irbkin.trajectory.joint(np.zeros(6), HOME, duration=0.5)
    scene.of(move, ROBOT).save(tmp_path / "move.html")
    page = opened(f"file://{tmp_path}/move.html")
    assert "solves nothing" in page.locator(".verdict").inner_text()
    assert not page.locator(".solutions").is_visible()
    page.get_by_role("button", name="play").click()
    page.wait_for_function("() => Math.abs(irbkin.state.q[4] - 0.5) < 1e-9")
    page.get_by_label("J1", exact=True).first.fill("30")
    page.wait_for_function("() => Math.abs(irbkin.state.q[0] - Math.PI / 6) < 1e-9")
    robot = np.reshape(page.evaluate("() => irbkin.state.T"), (4, 4)).T
    q = HOME.copy()
    q[0] = np.pi / 6
    np.testing.assert_allclose(robot, ROBOT.fk(q), atol=1e-9)


def test_a_page_says_when_python_has_ended(opened):
    with scene.serve(ROBOT) as view:
        page = opened(view.url)
    page.evaluate("() => irbkin.setJoints([0.1, 0, 0, 0, 0.5, 0])")
    page.wait_for_function("() => irbkin.state.reason?.includes('irbkin has ended')")
