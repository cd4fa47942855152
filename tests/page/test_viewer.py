"""The viewer: joints follow the handle, motions play, a real Chromium shows it."""

import shutil
import time

import irbkin
import numpy as np
import pytest
from irbkin import rapid, trajectory
from irbkin.body import Shape

pytest.importorskip("viser")

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
MOVE = trajectory.joint(np.zeros(6), np.full(6, 0.4), duration=0.3)
CELL = irbkin.Cell({
    "post": Shape.cylinder(0.1, 1.0, irbkin.pose([0.9, 0.6, 0.5])),
    "floor": Shape.half_space([0, 0, 1], [0, 0, -0.1]),
    "two": Shape.union([Shape.sphere(0.1, [0, 1, 0]), Shape.box([0.1, 0.2, 0.3])]),
})  # fmt: skip


@pytest.fixture
def opened():
    viewers = []

    def open_viewer(*arguments):
        viewers.append(irbkin.viewer.Viewer(*arguments, port=8097))
        return viewers[-1]

    yield open_viewer
    for viewer in viewers:
        viewer.close()


def links(viewer):
    return dict(viewer._arms[0]._links)


@pytest.mark.parametrize("b", [(0.1, 0.2, 1.3), (0.1, 0.2, 0.3)])
def test_a_capsule_contains_its_ends(b):
    from irbkin.scene._meshes import capsule

    mesh = capsule(irbkin.scene.LinkShape(0, (0.1, 0.2, 0.3), b, 0.1))
    np.testing.assert_allclose(mesh.bounds, [[0, 0.1, 0.2], [0.2, 0.3, b[2] + 0.1]], atol=2e-3)


def test_the_links_are_where_the_robot_has_them(opened):
    viewer = opened(ROBOT)
    q = np.array([0.3, 0.2, 0.1, 0.4, 0.5, 0.6])
    viewer.q = q
    frames = ROBOT.link_frames(q)
    for link, handle in links(viewer).items():
        if 0 < link <= 6:
            np.testing.assert_allclose(handle.position, frames[link - 1, :3, 3], atol=1e-9)
    np.testing.assert_allclose(viewer._handle.position, frames[-1, :3, 3], atol=1e-9)


def test_the_joints_follow_the_handle_and_ghosts_are_the_other_solutions(opened):
    viewer = opened(ROBOT)
    viewer.q = [0.3, 0.2, 0.1, 0.4, 0.5, 0.6]
    T = ROBOT.fk(viewer.q)
    times = []
    for _ in range(20):
        T[2, 3] -= 0.005
        begun = time.perf_counter()
        viewer.move(T)
        times.append(time.perf_counter() - begun)
    np.testing.assert_allclose(ROBOT.fk(viewer.q), T, atol=1e-9)
    inside = [it for it in ROBOT.ik(T) if it.is_within_limits]
    scales = viewer._arms[0]._ghosts[0][1].batched_scales
    assert int(np.sum(scales)) == len(inside) - 1 > 0
    print("drag [ms]:", np.round(1e3 * np.median(times), 2))
    T[0, 3] += 9.0
    assert "beyond reach" in viewer.move(T)


def test_a_motion_plays_with_its_marks(opened):
    away = "[9E9,9E9,9E9,9E9,9E9,9E9]"
    moves = [f"MoveAbsJ [[{it},0,0,0,30,0],{away}],v1000,fine,tool0;" for it in (0, 9, 400)]
    made = rapid.motion(ROBOT, rapid.parse("\n".join(["PROC main()", *moves, "ENDPROC"])))
    viewer = opened(irbkin.scene.of(made, ROBOT) + irbkin.scene.of(CELL), ROBOT)
    viewer.at(made.duration)
    np.testing.assert_allclose(viewer.q, made.q[-1], atol=1e-9)
    assert len(viewer.scene.marks) == len(made.findings) > 0
    other = opened(MOVE, ROBOT)
    other.play()
    np.testing.assert_allclose(other.q, MOVE.q[-1], atol=1e-9)


def test_impossible_joints_are_refused_and_change_nothing(opened):
    viewer = opened(ROBOT)
    before = viewer.q
    for q in ([1.0], np.full(6, np.nan)):
        with pytest.raises(irbkin.InvalidJointsError):
            viewer.q = q
    np.testing.assert_array_equal(viewer.q, before)
    nothing = ROBOT.ik(irbkin.pose([9, 0, 0], wxyz=[1, 0, 0, 0]))
    assert opened(nothing, ROBOT).q.shape == (6,)


def test_arms_of_seven_joints_and_scenes_without_a_robot_are_shown(opened):
    yumi = irbkin.Robot("IRB 14050")
    viewer = opened(yumi)
    T = yumi.fk(viewer.q)
    T[2, 3] -= 0.01
    viewer.move(T)
    np.testing.assert_allclose(yumi.fk(viewer.q), T, atol=1e-9)
    still = opened(irbkin.scene.of(CELL, ROBOT))
    still.q = np.full(6, 0.1)
    assert still.url.startswith("http://127.0.0.1:")


def test_chromium_shows_it(opened, tmp_path):
    playwright = pytest.importorskip("playwright.sync_api")
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("there is no Chromium")
    viewer = opened(irbkin.scene.of(CELL, ROBOT), ROBOT)
    with playwright.sync_playwright() as started:
        arguments = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = started.chromium.launch(executable_path=chromium, args=arguments)
        page = browser.new_page(viewport={"width": 1200, "height": 800})
        page.goto(viewer.url)
        page.wait_for_selector("canvas", timeout=60_000)
        page.wait_for_timeout(6000)
        page.screenshot(path=tmp_path / "viewer.png")
        browser.close()
    Image = pytest.importorskip("PIL.Image")
    pixels = (
        np.asarray(Image.open(tmp_path / "viewer.png").convert("RGB")).reshape(-1, 3).astype(int)
    )
    assert (pixels[:, 0] - pixels[:, 2] > 80).mean() > 0.002
