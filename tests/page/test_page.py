"""The page in a real Chromium: `make test-page`. Its answers are compared with irbkin's."""

import json
import os
import re
from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import rapid
from irbkin.body import Shape

ROOT = Path(__file__).parents[2]
PAGE = Path(os.environ.get("IRBKIN_PAGE", ROOT / "target" / "page" / "irbkin.html"))
PICTURES = ROOT / "target" / "page"
# Of it the packed engine has 1,203 kB in base 85 (page/README.md). Programs of RAPID whose data
# have several values, and that know where the robot is, are 30 kB of it; what a controller refuses
# when it loads a program, and world zones, 20 kB.
MOST_BYTES = 1_350_000
ONE_OF_EACH = {irbkin.Robot(name).structure: name for name in irbkin.catalog()}
PHONE = {"width": 390, "height": 844}
MODULE = """MODULE Weld
  PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
  CONST robtarget p1:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pFar:=[[2900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p1,v1000,z20,tGun;
    MoveL p2,v200,fine,tGun;
    MoveL pFar,v200,fine,tGun;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def opened(opened):
    """Open the page."""

    def open_page(hash="", **options):
        return opened(f"file://{PAGE}{hash and '#' + hash}", **options)

    return open_page


def state(page):
    """The state of the page, when all that it asked is answered."""
    return page.evaluate("""async () => {
        for (let last; last !== irbkin.engine.last || irbkin.solving;) {
          last = irbkin.engine.last;
          await Promise.all([last, irbkin.solving, new Promise((go) => setTimeout(go))]);
        }
        return irbkin.state;
    }""")


def pose(state):
    return np.array(state["T"]).reshape(4, 4).T


def settled(page):
    page.wait_for_timeout(250)
    return state(page)


def test_the_page_is_one_small_file_without_addresses():
    text = PAGE.read_text()
    assert len(text.encode()) <= MOST_BYTES
    assert not re.search(r"https?://", text)


@pytest.mark.parametrize("name", ONE_OF_EACH.values())
def test_the_solutions_are_the_ones_of_python(opened, name):
    robot = irbkin.Robot(name)
    q = np.clip(0.3 * np.arange(1, robot.dof + 1), *robot.limits.T)
    page = opened()
    page.evaluate("([name, q]) => irbkin.setArm({ name }, q)", [name, q.tolist()])
    own = state(page)
    T = pose(own)
    np.testing.assert_allclose(T, robot.fk(q), atol=1e-9)
    # The page takes any heading of five axes, so that a tool can be dragged.
    given = {5: {"heading_tolerance": np.pi}, 6: {}, 7: {"q7": q[-1]}}[robot.dof]
    found = robot.ik(T, **given)
    assert [it["slot"] for it in own["solutions"]] == [it.slot for it in found]
    theirs = np.array([it["q"] for it in own["solutions"]])
    np.testing.assert_allclose(np.sin(theirs - found.q), 0, atol=1e-9)
    assert [it["within_limits"] for it in own["solutions"]] == [it.is_within_limits for it in found]


def test_every_arm_of_the_catalog_opens_and_is_drawn(opened):
    page = opened()
    for name in irbkin.catalog():
        page.evaluate("(name) => irbkin.setArm({ name })", name)
        own = state(page)
        robot = irbkin.Robot(name)
        np.testing.assert_allclose(pose(own), robot.fk(own["q"]), atol=1e-9)
        assert page.evaluate("() => irbkin.arm.meshes.some((it) => it.index.length)")


def choose_arm(page, name):
    """Type the name of an arm, as a person does."""
    page.get_by_label("arm", exact=True).fill(name)
    page.keyboard.press("Enter")
    page.wait_for_function("(name) => irbkin.state.name === name", arg=name)
    state(page)


def test_another_arm_is_seen_whole(opened):
    """Also one with more axes or fewer than the arm before."""
    page = opened()
    for name in ("Panda", "UR5e", "IRB 14000-0.5/0.5 (left)", "IRB 8700-800/3.5"):
        choose_arm(page, name)
        target = page.evaluate("() => irbkin.view.camera.target")
        at = page.evaluate("""() => {
            const { camera } = irbkin.view;
            const points = irbkin.arm.points(irbkin.state.q).map((it) => camera.project(it));
            return points.map(([x, y]) => [x / camera.size[0], y / camera.size[1]]);
        }""")
        # JSON has no NaN: a number that is none is null.
        assert None not in target, name
        assert 0 < np.min(at) < np.max(at) < 1, name
        # And no smaller than it needs to be.
        assert np.ptp(at, axis=0).max() > 0.4, name


def test_the_page_says_whether_an_arm_moves_toward_what_it_does_not_reach(opened):
    page = opened()
    for q, words, moves in (
        ([0.1, 0.3, 0.2, 0.4, 0.5, 0.6], "as near as it gets on the straight way.", True),
        # Of this pose no solution is inside the limits.
        ([2.2, -2.9, 1.4, -2.0, 2.3, 0.3], "The arm stays where it is.", False),
    ):
        page.evaluate("(q) => irbkin.setJoints(q)", q)
        page.fill("aside textarea", "")
        page.fill("aside textarea", "2900 -300 500 180 0 180")
        assert (state(page)["q"] != q) == moves
        assert page.locator(".verdict").inner_text().endswith(words)


def test_confdata_are_not_the_reason_where_reach_is(opened):
    page = opened()
    words = page.locator("textarea + p")
    conf = "[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    page.fill("aside textarea", f"[[2900,-300,500],[0,0,1,0],{conf}")
    state(page)
    assert words.inner_text() == "read as a robtarget"
    page.fill("aside textarea", f"[[900,-300,500],[0,0,1,0],{conf}")
    state(page)
    assert "no solution inside the limits has its confdata [0, -1, 0, 0]" in words.inner_text()


def test_what_was_said_with_an_arm_is_gone_with_it(opened):
    page = opened(hash="arm=UR5e&tool=0,0,150,0,0,0")
    page.fill("aside textarea", "hello")
    words = page.locator("textarea + p")
    assert "hello" in words.inner_text()
    choose_arm(page, "Panda")
    assert words.inner_text() == ""
    np.testing.assert_allclose(np.reshape(state(page)["tool"], (4, 4)), np.eye(4))


def test_dragging_the_handle_changes_the_solutions(opened):
    page = opened()
    before = settled(page)
    x, y, _ = page.evaluate("() => irbkin.view.camera.project(place(irbkin.state.T))")
    page.mouse.move(x, y)
    page.mouse.down()
    times = []
    for step in range(1, 13):
        page.mouse.move(x + 5 * step, y - 4 * step)
        times.append(page.evaluate("() => irbkin.view.frameTime"))
    page.mouse.up()
    after = settled(page)
    assert np.abs(np.subtract(before["T"], after["T"])[12:15]).max() > 0.02
    assert before["solutions"][0]["q"] != after["solutions"][0]["q"]
    robot = irbkin.Robot(after["name"])
    np.testing.assert_allclose(robot.fk(after["q"]), pose(after), atol=1e-9)
    print("frame [ms]:", np.round(sorted(times), 1))


HULLED = [name for name in irbkin.catalog() if irbkin.Robot(name).body.hulls]


def test_what_is_drawn_contains_the_hulls_and_is_near_them(opened):
    page = opened()
    rng = np.random.default_rng(5)
    directions = rng.normal(size=(100, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for name in HULLED[::3]:
        page.evaluate("(name) => irbkin.setArm({ name })", name)
        meshes = page.evaluate("() => irbkin.arm.meshes.map((it) => it.position)")
        hulls = irbkin.Robot(name).body.hulls
        for link in {hull[0] for hull in hulls}:
            drawn = np.reshape(meshes[link], (-1, 3))
            own = [(points, radius) for at, points, _, radius in hulls if at == link]
            wanted = np.max([(points @ directions.T).max(axis=0) for points, _ in own], axis=0)
            beyond = (drawn @ directions.T).max(axis=0) - wanted
            # Faces are bent by the radius at most.
            most = 2 * max(radius for _, radius in own)
            assert -1e-9 <= beyond.min() <= beyond.max() <= most, (name, link)


def test_collision_shapes_are_drawn_where_they_are_asked_for(opened):
    page = opened()
    drawn = """() => irbkin.view.links(irbkin.arm, irbkin.state.q).map(
        ([mesh]) => ["meshes", "capsules"].filter((kind) => irbkin.arm[kind].includes(mesh)))"""
    assert page.evaluate(drawn)[:7] == [["meshes"]] * 7
    page.get_by_label("collision shapes").check()
    assert page.evaluate(drawn)[:7] == [["capsules"]] * 7
    page.evaluate("() => irbkin.setArm({ name: 'IRB 140-6/0.81' })")
    assert page.evaluate("() => irbkin.arm.capsules === irbkin.arm.meshes")


def picture(page, quality, tmp_path):
    """The pixels of the canvas after a frame of a quality."""
    Image = pytest.importorskip("PIL.Image")
    page.evaluate("(quality) => irbkin.view.draw(quality)", quality)
    page.locator("canvas").screenshot(path=tmp_path / "arm.png")
    return np.asarray(Image.open(tmp_path / "arm.png").convert("RGB")).astype(int)


def test_edges_are_smooth_and_the_arm_has_a_shadow(opened, tmp_path):
    page = opened()
    settled(page)
    # Nothing else draws, nor the handle.
    page.evaluate("() => { irbkin.view.ask = () => {}; Handle.draw = () => {}; }")
    plain, shaded, smooth = (picture(page, quality, tmp_path) for quality in (0, 1, 2))
    darker = plain.sum(axis=2) - shaded.sum(axis=2)
    assert (darker > 30).mean() > 0.01
    assert (darker < -30).sum() == 0
    orange = np.array([plain, smooth])[..., 0] - np.array([plain, smooth])[..., 2] > 60
    changed = np.abs(shaded - smooth).sum(axis=2) > 30
    # Pixels change at edges alone.
    assert 200 < changed.sum() < 0.1 * orange[0].sum()
    assert page.evaluate("() => irbkin.view.drawing.samples") == 4


def test_shadow_and_smooth_edges_go_where_frames_take_long(opened):
    page = opened()
    settled(page)
    falls = page.evaluate("""() => {
        const { view } = irbkin;
        const now = () => performance.now();
        const wait = (ms) => { for (const end = now() + ms; now() < end;); };
        const after = [];
        Object.assign(view, { quality: 2, late: 0, count: 0 });
        for (const ms of [0, 30]) {
          view.drawing.finish = () => wait(ms);
          view.drawing.mesh = () => {};
          for (let i = 0; i < 40; i++) view.draw();
          after.push(view.quality);
        }
        return after;
    }""")
    assert falls[1] == 0 < falls[0]


def test_what_the_mouse_is_on_is_named(opened, tmp_path):
    page = opened()
    cell = irbkin.Cell({"table": Shape.box([0.5, 0.5, 0.4], irbkin.pose([0.4, -1.0, 0.2]))})
    pose = irbkin.pose([0.2, 0.9, 0.3])
    frame = irbkin.scene.Frame("fixture", tuple(map(tuple, pose.tolist())))
    seam = irbkin.scene.Path("seam", ((0.9, -0.9, 0.8), (0.9, -0.5, 0.8)))
    arm = irbkin.Robot("IRB 2600-12/1.65")
    own = irbkin.scene.of(arm) + irbkin.scene.of(cell)
    (own + irbkin.scene.Scene(frames=(frame,), paths=(seam,))).save(tmp_path / "own.json")
    page.set_input_files("input[type=file]", tmp_path / "own.json")
    page.wait_for_function("() => irbkin.view.obstacles.length === 1")

    def label(point):
        x, y, _ = page.evaluate("(point) => irbkin.view.camera.project(point)", point)
        page.mouse.move(x, y)
        label = page.locator(".label")
        return label.inner_text() if label.is_visible() else ""

    frames = arm.link_frames(np.zeros(6))
    for link in (2, 4):
        (middle,) = (points.mean(axis=0) for at, points, *_ in arm.body.hulls if at == link)
        assert label((frames[link - 1] @ [*middle, 1])[:3].tolist()) == f"link {link}"
    assert label([0, 0, 0.1]) == "base"
    assert label([0.4, -1.0, 0.4]) == "table"
    assert label([0.2, 0.9, 0.3]) == "fixture"
    assert label([0.9, -0.9, 0.8]) == "seam"
    page.mouse.move(20, 30)
    assert not page.locator(".label").is_visible()


def test_the_floor_has_a_scale(opened):
    page = opened()
    settled(page)
    words = page.locator(".words span").all_inner_texts()
    assert {"500", "1500 mm", "x", "y"} <= set(words)
    page.select_option("select[aria-label=units]", "m")
    page.wait_for_timeout(200)
    assert {"0.5", "1.5 m"} <= set(page.locator(".words span").all_inner_texts())


def test_the_picture_is_not_blank_and_the_arm_is_seen(opened, tmp_path):
    Image = pytest.importorskip("PIL.Image")
    page = opened()
    page.wait_for_timeout(300)
    page.locator("canvas").screenshot(path=tmp_path / "arm.png")
    pixels = np.asarray(Image.open(tmp_path / "arm.png").convert("RGB")).reshape(-1, 3).astype(int)
    orange = (pixels[:, 0] > 150) & (pixels[:, 2] < 110) & (pixels[:, 0] - pixels[:, 2] > 80)
    assert orange.mean() > 0.02


def test_without_webgl_everything_is_solved(opened):
    page = opened(script="HTMLCanvasElement.prototype.getContext = () => null;")
    assert "8 solutions" in page.locator(".verdict").inner_text()
    assert "no WebGL 2" in page.locator(".notes").inner_text()


TARGET = "[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
PASTED = {
    "robtarget": f"CONST robtarget p10:={TARGET};",
    "target": TARGET,
    "move": f"MoveL {TARGET},v100,fine,tool0;",
    "quaternion": "900 -300 500 0 0 1 0",
    "angles": "900 -300 500 180 0 180",
    "labels": "x: 900, y: -300, z: 500, rz: 180, ry: 0, rx: 180",
    "matrix": "[[-1,0,0,0.9],[0,1,0,-0.3],[0,0,-1,0.5],[0,0,0,1]]",
    "jointtarget": "[[10,20,-10,5,30,5],[9E9,9E9,9E9,9E9,9E9,9E9]]",
    "joints": "10, 20, -10, 5, 30, 5",
}


@pytest.mark.parametrize("kind", PASTED)
def test_what_is_pasted_is_read(opened, kind):
    page = opened()
    page.fill("aside textarea", PASTED[kind])
    own = state(page)
    robot = irbkin.Robot(own["name"])
    if kind in ("jointtarget", "joints"):
        np.testing.assert_allclose(np.degrees(own["q"]), [10, 20, -10, 5, 30, 5], atol=1e-9)
        return
    T = rapid.parse(PASTED["target"]).matrix()
    np.testing.assert_allclose(pose(own), T, atol=1e-12)
    if "v" in kind or kind in ("robtarget", "target", "move"):
        assert own["confdata"] == [-1, 0, -1, 0]
        np.testing.assert_allclose(own["q"], robot.ik_configured(T, (-1, 0, -1, 0)), atol=1e-9)


def test_an_angle_that_is_typed_stays_what_it_is(opened):
    page = opened(hash="arm=IRB 2600-12/1.65&q=0,0,0,0,30,0")
    fields = [page.get_by_label(name, exact=True).first for name in ("rz", "ry", "rx")]
    fields[1].fill("")
    fields[1].press_sequentially("120.5", delay=20)
    turn = pose(state(page))[:3, :3]
    angles = [float(it.input_value()) for it in fields]
    assert angles[1] == 120.5
    wanted = irbkin.pose([0, 0, 0], euler_zyx=np.radians(angles))[:3, :3]
    np.testing.assert_allclose(turn, wanted, atol=1e-6)


def test_one_field_of_a_frame_leaves_the_others_as_they_are(opened):
    page = opened(hash="arm=IRB 2600-12/1.65&q=0.123456789,0.2,0.3,0.4,0.5,0.6")
    wanted = pose(state(page))
    wanted[1, 3] = 0.25
    page.get_by_label("y", exact=True).first.fill("250")
    np.testing.assert_allclose(pose(state(page)), wanted, atol=1e-9)


def test_a_scene_has_its_own_tool_base_and_arm(opened, tmp_path):
    base = irbkin.pose([0.3, -0.2, 0.5], wxyz=[0.6, 0, 0, 0.8])
    robot = irbkin.Robot("IRB 2600-12/1.65").with_tool([0, 0, 0.2]).with_base(base)
    q = np.array([0.1, 0.3, 0.2, 0.4, 0.5, 0.6])
    own, other = tmp_path / "own.json", tmp_path / "other.json"
    irbkin.scene.of(robot, q=q).save(own)
    ur = irbkin.Robot.from_urdf(ROOT / "tests" / "data" / "ur5e.urdf", tip="tool0")
    irbkin.scene.of(ur).save(other)
    page = opened()
    page.set_input_files("input[type=file]", own)
    page.wait_for_function("() => irbkin.state.base[14] === 0.5")
    np.testing.assert_allclose(pose(state(page)), robot.fk(q), atol=1e-9)
    page.set_input_files("input[type=file]", other)
    page.wait_for_function("(name) => irbkin.robot.name === name", arg=ur.name)
    np.testing.assert_allclose(pose(state(page)), ur.fk(np.zeros(6)), atol=1e-9)
    assert page.evaluate("() => irbkin.arm.meshes.some((it) => it.index.length)")


def test_rubbish_in_the_address_starts_the_page(opened):
    for hash in ("q=1e999,0,0,0,0,0", "tool=1e999,0,0,0,0,0", "base=9e9,0,0,0,0,0", "arm=x&q=a"):
        own = state(opened(hash=hash))
        assert len(own["q"]) == 6, hash
        assert all(np.isfinite(own["q"])), hash


def test_an_unreachable_drag_stays_unreachable(opened):
    page = opened()
    page.evaluate("() => irbkin.setPose(Handle.shifted(irbkin.state.T, [2, 0, 0]), { drag: true })")
    page.evaluate("() => irbkin.settled()")
    page.wait_for_timeout(400)
    assert page.locator(".verdict").inner_text().startswith("Not reached")


def test_impossible_numbers_are_marked_and_nothing_stops(opened):
    page = opened()
    for text in (
        "1 2 3",
        "900 -300 500 0 0 3 0",
        "hello world",
        "1e9 0 0 0 0 0",
        "MoveL pX,v1,fine,t;",
    ):
        page.fill("aside textarea", text)
        state(page)
        assert page.locator("textarea + p").inner_text(), text
    field = page.get_by_label("x", exact=True).first
    field.fill("abc")
    assert "wrong" in field.get_attribute("class")
    field.fill("99999999")
    assert "wrong" in field.get_attribute("class")
    field.fill("5000")
    assert "wrong" not in (field.get_attribute("class") or "")
    state(page)
    assert "beyond reach" in page.locator(".verdict").inner_text()
    page.get_by_label("arm", exact=True).fill("IRB 9999")
    page.keyboard.press("Enter")
    state(page)
    assert "IRB 9999" in page.locator(".words-of-arm").inner_text()
    page.evaluate("() => irbkin.setJoints([NaN, 0, 0, 0, 0, 0])")
    assert all(np.isfinite(state(page)["q"]))


def test_a_module_is_a_table_that_plays(opened, tmp_path):
    page = opened()
    file = tmp_path / "weld.mod"
    file.write_text(MODULE)
    page.set_input_files("input[type=file]", file)
    page.wait_for_selector(".program tbody tr")
    rows = page.locator(".program tbody tr")
    assert rows.count() == 3
    robot = irbkin.Robot(state(page)["name"])
    motion = rapid.motion(robot, rapid.parse(MODULE))
    assert "R101" in rows.nth(2).inner_text()
    rows.nth(1).click()
    np.testing.assert_allclose(state(page)["q"], motion.moves[1].q, atol=1e-9)
    line = page.evaluate("() => irbkin.program.source.line")
    assert "MoveL p2" in MODULE.splitlines()[line - 1]
    assert page.locator(".margin .here").inner_text() == str(line)
    page.locator(".player button").click()
    page.wait_for_timeout(400)
    page.locator(".player button").click()
    assert 0 < float(page.locator(".player input").input_value()) <= motion.duration
    large = tmp_path / "large.mod"
    large.write_text("! " + "x" * 20_000_000)
    page.set_input_files("input[type=file]", large)
    page.wait_for_function("() => document.querySelector('.notes').innerText.includes('20.0 MB')")


def test_modules_are_read_together_and_a_routine_is_chosen(opened, tmp_path):
    page = opened()
    data, moves = tmp_path / "Data.sysx", tmp_path / "Moves.mod"
    data.write_text("""MODULE Data
    PERS tooldata tGun:=[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    PERS robtarget p1:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
""")
    moves.write_text("""MODULE Moves
    PROC first()
        MoveJ p1,v100,fine,tGun;
    ENDPROC
    PROC second()
        MoveJ p1,v100,fine,tGun;
        MoveL Offs(p1,0,200,0),v100,fine,tGun;
    ENDPROC
ENDMODULE
""")
    page.set_input_files("input[type=file]", [data, moves])
    page.wait_for_selector(".program tbody tr")
    assert "3 of 3 moves checked" in page.locator(".program").inner_text()
    assert "Moves.mod:3" in page.locator(".program tbody tr").first.inner_text()
    assert page.evaluate("() => irbkin.program.motion.moves.length") == 1
    page.select_option("[aria-label=routine]", label="second")
    robot = irbkin.Robot(state(page)["name"])
    module = rapid.parse(moves.read_text(), [rapid.parse(data.read_text())])
    motion = rapid.motion(robot, module, "second")
    played = page.evaluate("() => ({ ...irbkin.program.motion })")
    assert played["duration"] == pytest.approx(motion.duration, abs=1e-9)
    np.testing.assert_allclose(played["way"][-3:], [0.9, 0.2, 0.9], atol=1e-9)
    np.testing.assert_allclose(page.evaluate("() => irbkin.view.way[0]"), [0.9, 0, 0.9], atol=1e-9)


def test_a_urdf_and_a_scene_are_opened(opened, tmp_path):
    page = opened()
    ur = ROOT / "tests" / "data" / "ur5e.urdf"
    page.set_input_files("input[type=file]", ur)
    page.wait_for_function("() => irbkin.robot.structure === 'three parallel axes'")
    own = state(page)
    robot = irbkin.Robot.from_urdf(ur, tip="tool0")
    np.testing.assert_allclose(pose(own), robot.fk(own["q"]), atol=1e-9)
    arm = irbkin.Robot("IRB 2600-12/1.65")
    cell = irbkin.Cell({"post": Shape.cylinder(0.1, 1.2, irbkin.pose([0.8, 0, 0.6]))})
    q = [0.0, 0.5, 0.2, 0.0, 0.5, 0.0]
    file = tmp_path / "scene.json"
    (irbkin.scene.of(arm, q=q) + irbkin.scene.of(cell)).save(file)
    page.set_input_files("input[type=file]", file)
    page.wait_for_function("() => irbkin.view.obstacles.length === 1")
    page.wait_for_timeout(300)
    own = state(page)
    np.testing.assert_allclose(own["q"], q, atol=1e-12)
    assert own["posture"]["contact"]["collides"] == bool(cell.collides(arm, q))


def test_paths_of_a_scene_are_apart_and_its_frames_have_axes(opened, tmp_path):
    page = opened()
    pose = irbkin.pose([0.5, 0.6, 0.7], euler_zyx=[0.3, 0.2, 0.1])
    own = irbkin.scene.Scene(
        frames=(irbkin.scene.Frame("table", tuple(map(tuple, pose.tolist()))),),
        paths=tuple(
            irbkin.scene.Path("way", ((x, 0.0, 1.0), (x, 1.0, 1.0), (x, 1.0, 2.0)))
            for x in (0.5, 0.8)
        ),
    )
    own.save(tmp_path / "own.json")
    page.evaluate(
        "() => { irbkin.view.drawing.lines = (points, color) => (window.drawn ??= [])"
        ".push({ points, color }) }"
    )
    page.set_input_files("input[type=file]", tmp_path / "own.json")
    page.wait_for_function("() => irbkin.view.frames.length && window.drawn?.length > 4")
    drawn = page.evaluate("() => window.drawn")
    ways = [it["points"] for it in drawn if len(it["points"]) == 8]
    for a, b in zip(ways[0][::2], ways[0][1::2], strict=True):
        assert np.linalg.norm(np.subtract(b, a)) == 1.0
    x, y, z = [it["points"] for it in drawn if len(it["points"]) == 2][:3]
    for axis, (start, end) in enumerate((x, y, z)):
        np.testing.assert_allclose(start, pose[:3, 3], atol=1e-12)
        np.testing.assert_allclose(np.subtract(end, start), 0.15 * pose[:3, axis], atol=1e-12)


def test_the_state_is_in_the_address_and_comes_back(opened):
    page = opened(hash="arm=UR5e&q=10,-80,90,-100,-90,0&tool=0,0,150,0,0,0")
    own = settled(page)
    assert own["name"] == "UR5e"
    np.testing.assert_allclose(np.degrees(own["q"]), [10, -80, 90, -100, -90, 0], atol=1e-9)
    robot = irbkin.Robot("UR5e").with_tool(irbkin.pose([0, 0, 0.15], wxyz=[1, 0, 0, 0]))
    np.testing.assert_allclose(pose(own), robot.fk(own["q"]), atol=1e-9)
    page.evaluate("() => irbkin.setJoints(irbkin.state.q.map((it) => it + 0.1))")
    after = settled(page)
    again = opened(hash=page.evaluate("() => location.hash.slice(1)"))
    np.testing.assert_allclose(state(again)["q"], after["q"], atol=1e-5)


def test_copies_are_programs(opened):
    page = opened()
    texts = page.evaluate(
        "() => [asPython, asRapid, asCsv].map((it) => it({ ...irbkin.state, robot: irbkin.robot }))"
    )
    own = state(page)
    names = {}
    exec(texts[0].replace("print", "found ="), names)
    np.testing.assert_allclose(names["q"], own["q"], atol=1e-8)
    module = rapid.parse(f"MODULE M\n{texts[1]}ENDMODULE")
    robot = irbkin.Robot(own["name"])
    joints = rapid.calc_joint_t(robot, module["pHere"])
    np.testing.assert_allclose(joints.robax_deg, np.degrees(own["q"]), atol=1e-2)
    np.testing.assert_allclose(module["jHere"].robax_deg, np.degrees(own["q"]), atol=1e-4)
    assert len(texts[2].splitlines()) == 1 + len(own["solutions"])


def test_the_keyboard_chooses_and_moves(opened):
    page = opened()
    page.locator("canvas").focus()
    before = state(page)
    page.keyboard.press("ArrowUp")
    after = state(page)
    np.testing.assert_allclose(
        np.subtract(after["T"], before["T"])[12:15], [0.01, 0, 0], atol=1e-12
    )
    page.keyboard.press("]")
    assert state(page)["own"] != after["own"]
    page.keyboard.press("1")
    assert state(page)["own"] == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pictures_for_people(opened, scheme):
    page = opened(scheme=scheme)
    page.wait_for_timeout(400)
    page.screenshot(path=PICTURES / f"desktop_{scheme}.png")
    phone = opened(viewport=PHONE, scheme=scheme)
    phone.wait_for_timeout(400)
    assert phone.evaluate("() => document.documentElement.scrollWidth") <= 390
    phone.screenshot(path=PICTURES / f"phone_{scheme}.png", full_page=True)
    assert json.loads(page.evaluate("() => JSON.stringify(irbkin.state.q)"))


def test_the_first_solutions_come_soon(opened):
    page = opened()
    ready = float(page.evaluate("() => document.documentElement.dataset.ready"))
    print("ready [ms]:", ready)
    assert ready < 3000
