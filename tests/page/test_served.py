"""The page that Python serves, in a real Chromium: `irbkin view` and `scene.serve`."""

import itertools
import threading
from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import scene
from irbkin.cli import main
from irbkin.scene._page import engine

DATA = Path(__file__).parents[1] / "data"
ROBOT = irbkin.Robot("IRB 2600-12/1.65")
HOME = np.array([0.1, 0.2, 0.1, 0.3, 0.5, 0.2])


@pytest.fixture
def served():
    """Serve scenes until all pages are closed."""
    views = []

    def serve(thing):
        views.append(scene.serve(thing))
        return views[-1]

    yield serve
    for view in views:
        view.close()


def agrees(page, view):
    """Wait until a page and Python have the same joints."""
    page.wait_for_function(
        "(q) => !irbkin.solving && q.every((it, i) => Math.abs(it - irbkin.state.q[i]) < 1e-12)",
        arg=view.q.tolist(),
    )


def test_two_pages_and_python_move_one_arm(served, opened):
    robot = ROBOT.with_tool([0, 0, 0.1]).with_base([0.2, 0, 0])
    view = served(scene.of(robot, q=HOME))
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


def test_pages_and_python_agree_after_all_moved_at_once(served, opened):
    view = served(scene.of(ROBOT, q=HOME))
    page, other = opened(view.url), opened(view.url)
    for _ in range(6):
        done = threading.Event()

        def move(done=done):
            for step in itertools.count():
                if done.wait(0.01):
                    return
                view.q = HOME + 0.1 * np.sin(step / 10)

        threads = [threading.Thread(target=move) for _ in range(2)]
        for it in threads:
            it.start()
        page.evaluate("""async () => {
            for (let i = 0; i < 25; i++) {
                irbkin.setJoints(irbkin.state.q.map((it, joint) => it + 0.003 * (joint + 1)));
                await new Promise((resolve) => setTimeout(resolve, 8));
            }
        }""")
        done.set()
        for it in threads:
            it.join()
        page.wait_for_timeout(300)
        agrees(page, view)
        agrees(other, view)
    for name in ("UR5e", "IRB 1200-5/0.9", ROBOT.name) * 3:
        view.scene = irbkin.Robot(name)
        view.q = HOME + 0.2
    for it in (page, other):
        it.wait_for_function("(name) => irbkin.robot.name === name", arg=ROBOT.name)
        agrees(it, view)
    np.testing.assert_array_equal(view.q, HOME + 0.2)


def test_an_arm_of_a_file_is_solved_as_it_is(served, opened):
    ur = irbkin.Robot.from_urdf(DATA / "ur5e.urdf", tip="tool0").with_tool([0, 0.1, 0.2])
    view = served(scene.of(ur, q=HOME))
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


OTHER = """MODULE Other
  PROC other()
    MoveJ p1,v1000,z20,tGun;
    MoveL Offs(p1,0,0,100),v200,fine,tGun;
  ENDPROC
ENDMODULE
"""


def test_a_report_of_check_shows_what_it_found_and_plays(opened, tmp_path, monkeypatch):
    monkeypatch.setattr("irbkin.scene._page.engine", str)
    files = [tmp_path / "weld.mod", tmp_path / "other.mod"]
    own = MODULE.replace("  ENDPROC", "    other;\n    nothing 3;\n  ENDPROC")
    for file, text in zip(files, (own, OTHER), strict=True):
        file.write_text(text)
    names = list(map(str, files))
    target = tmp_path / "report.html"
    assert main(["check", ROBOT.name, *names, "--select", "ALL", "-o", str(target)]) == 1
    page = opened(f"file://{target}")
    assert page.locator(".program p").inner_text().startswith("5 of 5 moves checked. Found ")
    rows = page.locator(".moves tr.error").all_inner_texts()
    assert len(rows) == 2
    assert "weld.mod:8" in rows[0]
    assert "R101" in rows[0]
    assert "weld.mod:10" in rows[1]
    margin = page.locator(".margin div")
    assert margin.nth(7).get_attribute("class") == "error"
    page.get_by_label("time", exact=True).evaluate(
        "(it) => { it.value = it.max; it.dispatchEvent(new Event('input')); }"
    )
    assert page.get_by_label("module", exact=True).input_value() == "1"
    assert page.evaluate("() => irbkin.program.source.line") == 4
    made = irbkin.rapid.motion(ROBOT, irbkin.rapid.parse(OTHER, [irbkin.rapid.parse(MODULE)]))
    np.testing.assert_allclose(page.evaluate("() => irbkin.state.q"), made.q[-1], atol=1e-9)


@pytest.mark.skipif(not engine(), reason="the engine of pages is not built")
def test_a_report_with_the_engine_plays_any_routine_and_is_not_checked_again(opened, tmp_path):
    other = "  PROC one()\n    MoveJ p1,v100,z1,tGun;\n  ENDPROC\n"
    file, target = tmp_path / "weld.mod", tmp_path / "report.html"
    file.write_text(MODULE.replace("  PROC main()", f"{other}  PROC main()"))
    main(["check", ROBOT.name, str(file), "--ignore", "R", "-o", str(target)])
    page = opened(f"file://{target}")
    assert page.locator(".program p").inner_text().startswith("4 of 4 moves checked. Found ")
    # A code that the check leaves out is not asked of the engine.
    assert page.locator(".moves", has_text="C204").count() == 1
    assert page.locator(".moves", has_text="R101").count() == 0
    page.select_option("[aria-label=routine]", label="one")
    page.wait_for_function("() => irbkin.program.motion?.moves.length === 1")
    assert page.evaluate("() => irbkin.program.source.line") == 6


def test_a_file_without_an_arm_and_the_engine_draws(opened, tmp_path, monkeypatch):
    monkeypatch.setattr("irbkin.scene._page.engine", str)
    box = irbkin.body.Shape.box([0.4, 0.3, 0.2], irbkin.pose([3, 4, 1]))
    scene.of(irbkin.Cell({"box": box})).save(tmp_path / "cell.html")
    page = opened(f"file://{tmp_path}/cell.html")
    x, y, _ = page.evaluate("() => irbkin.view.camera.project([3, 4, 1])")
    page.mouse.move(x, y)
    page.locator(".label", has_text="box").wait_for()


def test_a_page_that_nobody_looks_at_lets_go_of_its_stream(served, opened):
    hide = """(hidden) => {
        Object.defineProperty(document, "hidden", { configurable: true, value: hidden });
        document.dispatchEvent(new Event("visibilitychange"));
    }"""
    view = served(scene.of(ROBOT, q=HOME))
    page = opened(view.url)
    agrees(page, view)
    page.evaluate(hide, True)
    page.wait_for_timeout(200)
    view.scene = irbkin.Robot("UR5e")
    view.q = HOME + 0.1
    page.wait_for_timeout(300)
    assert page.evaluate("() => irbkin.robot.name") == ROBOT.name
    page.evaluate(hide, False)
    page.wait_for_function("() => irbkin.robot.name === 'UR5e'")
    agrees(page, view)


def test_a_page_says_when_python_has_ended(served, opened):
    view = served(ROBOT)
    page = opened(view.url, passes="Failed to load resource")
    view.close()
    page.evaluate("() => irbkin.setJoints([0.1, 0, 0, 0, 0.5, 0])")
    page.wait_for_function("() => irbkin.state.reason?.includes('irbkin has ended')")
    assert page.locator(".verdict").inner_text() == "irbkin has ended: start irbkin view again"


def test_what_is_no_pose_moves_nothing(served, opened):
    view = served(scene.of(ROBOT, q=HOME))
    page = opened(view.url)
    before = page.evaluate("() => irbkin.state.T")
    field = page.get_by_label("paste a target, a tool, a pose, joints or a module")
    field.fill("1 0 0 1 0 1 0 0 0 0 -1 1 0 0 0 1")
    page.wait_for_function("() => irbkin.parts.verdict.textContent.includes('mirrors')")
    np.testing.assert_allclose(page.evaluate("() => irbkin.state.T"), before, atol=1e-12)
    field.fill("no target")
    page.get_by_text('"no target" is no target').wait_for()
    field.fill(MODULE)
    checked(page)
    page.wait_for_function("() => irbkin.parts.pasteWords.textContent === ''")
    # The time grows with the text, and not with its square.
    took = page.evaluate(
        """(text) => {
        const begun = performance.now();
        try { meaningOf(text, 6, irbkin.units); } catch {}
        return performance.now() - begun;
    }""",
        "x" + " \n" * 200000 + "x",
    )
    assert took < 2000


MODULE = """MODULE Weld
  PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
  CONST robtarget p1:=[[900,-300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pFar:=[[2900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p1,v1000,z20,tGun;
    MoveL Offs(p1,0,0,50),v200,fine,tGun;
    MoveL pFar,v200,fine,tGun;
  ENDPROC
ENDMODULE
"""


def checked(page):
    """Wait until the program is checked; what is said of it."""
    page.wait_for_function("() => irbkin.program.words.textContent.includes('moves checked')")
    page.wait_for_function("() => !irbkin.solving")
    return page.locator(".program p").inner_text()


def test_a_module_shows_what_is_found_and_the_lines_that_correct_it(served, opened):
    view = served(ROBOT)
    page = opened(view.url)
    page.get_by_label("paste a target, a tool, a pose, joints or a module").fill(MODULE)
    assert "3 of 3 moves checked" in checked(page)
    margin = page.locator(".margin div")
    assert margin.nth(7).get_attribute("class") == "error"
    assert "R101" in margin.nth(7).get_attribute("title")
    text = page.get_by_label("text of the module")
    assert not text.is_editable()
    assert text.input_value() == MODULE
    line = "CONST robtarget p1:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"
    assert page.locator(".moves code").all_inner_texts() == [f"fix: {line}"]
    margin.nth(6).click()
    page.wait_for_function("() => !irbkin.solving")
    z = page.evaluate("() => irbkin.state.T[14]")
    assert z == pytest.approx(0.55 + 0.18, abs=1e-6)
    page.get_by_role("button", name="close the program").click()
    assert not page.locator(".program").is_visible()


def test_the_lines_that_edits_change_are_shown_whole_but_long_ones(served, opened):
    page = opened(served(ROBOT).url)
    shown = """([text, edits]) => corrected(new TextEncoder().encode(text), edits)"""
    text = "  ä:=[1,2];\nb:=3;\n" + "c" * 1000 + "d" * 1000
    edits = [
        {"begin": len(text[:at].encode()), "end": len(text[: at + 1].encode()), "text": it}
        for at, it in ((text.index("2"), "20"), (text.index("1"), "10"), (text.index("d"), "D"))
    ]
    lines = page.evaluate(shown, [text, edits])
    assert lines == ["ä:=[10,20];", "c" * 200 + "D" + "d" * 200]
    assert page.evaluate(shown, ["1", [{"begin": 0, "end": 1, "text": "2"}]]) == ["2"]


def test_what_is_checked_is_the_newest_program_alone(served, opened):
    view = served(ROBOT)
    page = opened(view.url)
    page.evaluate("(text) => irbkin.paste(text)", MODULE)
    checked(page)
    # Each check waits until it is let go: all but the first and the last are left out.
    page.evaluate("""() => {
        const { engine } = irbkin.program;
        const answer = engine.answer.bind(engine);
        window.asked = [];
        engine.answer = async (request) => {
            if (request.do === "check") window.asked.push(request.modules[0].text.length);
            if (window.asked.length === 1) await new Promise((go) => { window.go ??= go; });
            return answer(request);
        };
    }""")
    for count in range(1, 4):
        page.evaluate("(text) => irbkin.paste(text)", "! line\n" * count + MODULE)
        page.wait_for_timeout(100)
        # Places of what was found are of another text.
        assert page.locator(".margin .error").count() == 0
    page.evaluate("() => window.go()")
    checked(page)
    page.wait_for_function("() => window.asked.length === 2")
    assert page.evaluate("() => window.asked") == [len(MODULE) + 7, len(MODULE) + 21]
    page.locator(".margin .error").wait_for()
    assert page.locator(".margin div").nth(10).get_attribute("class") == "error"


def test_a_finding_in_the_picture_leads_to_its_line(served, opened):
    view = served(ROBOT)
    page = opened(view.url)
    page.evaluate("(text) => irbkin.paste(text)", MODULE.replace("[0,0,0,0]", "[5,0,-1,0]", 1))
    checked(page)
    assert page.evaluate("() => irbkin.view.marks.length") > 0
    place = "irbkin.view.camera.project(irbkin.view.marks.find((it) => it.go).at)"
    x, y, _ = page.evaluate(f"() => {place}")
    page.mouse.click(x, y)
    assert page.evaluate("() => irbkin.program.source.line") is not None


def test_tools_and_work_objects_are_pasted_anywhere(served, opened):
    view = served(scene.of(ROBOT, q=HOME))
    page = opened(view.url)
    tool = "PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];"
    wobj = '[FALSE,TRUE,"",[[500,0,0],[1,0,0,0]],[[0,0,100],[1,0,0,0]]]'
    paste = """(text) => {
        const clipboardData = new DataTransfer();
        clipboardData.setData("text", text);
        const pasted = new ClipboardEvent("paste", { clipboardData, bubbles: true });
        irbkin.view.canvas.dispatchEvent(pasted);
    }"""
    page.evaluate(paste, tool)
    page.wait_for_function("() => irbkin.state.tool[14] === 0.18 && !irbkin.solving")
    page.evaluate(paste, wobj)
    page.wait_for_function("() => irbkin.state.wobj[12] + irbkin.state.wobj[14] === 0.6")
    T = ROBOT.with_tool([0, 0, 0.18]).fk(HOME)
    shown = page.get_by_label("z", exact=True).first.input_value()
    assert float(shown) == pytest.approx(1e3 * T[2, 3] - 100, abs=0.01)
    page.evaluate(paste, tool.replace("TRUE", "FALSE"))
    page.get_by_text("it must be TRUE here").wait_for()


def test_an_arm_reaches_towards_what_it_does_not_reach(served, opened):
    view = served(scene.of(ROBOT, q=HOME))
    page = opened(view.url)
    page.evaluate("() => irbkin.setPose(Handle.shifted(irbkin.state.T, [2, 0, 0]))")
    assert page.locator(".verdict").inner_text().startswith("Not reached")
    q = page.evaluate("() => irbkin.state.q")
    T, far = ROBOT.fk(q), ROBOT.fk(HOME)
    far[0, 3] += 2
    assert far[0, 3] > T[0, 3] > ROBOT.fk(HOME)[0, 3] + 0.05
    np.testing.assert_allclose(T[:3, :3], far[:3, :3], atol=1e-6)
    assert "old" in page.locator(".joints").get_attribute("class")
    shown = page.evaluate("() => irbkin.state.T")
    np.testing.assert_allclose(np.reshape(shown, (4, 4)).T, far, atol=1e-9)


def test_joints_that_are_outside_are_red_alone(served, opened):
    T = irbkin.pose([0.85, 0.32, 0.64], euler_zyx=np.radians([0, 150, 0]))
    q = ROBOT.ik_nearest(T)
    view = served(scene.of(ROBOT, q=q))
    page = opened(view.url)
    lower, upper = ROBOT.limits.T
    found = list(ROBOT.ik(ROBOT.fk(q)))
    wanted = [[bool(it) for it in (one.q < lower) | (one.q > upper)] for one in found]
    shown = page.evaluate(
        "() => [...document.querySelectorAll('.solutions tbody tr')].map((row) =>"
        " [...row.querySelectorAll('.angle')].map((it) => it.classList.contains('bad')))"
    )
    assert shown == wanted
    assert any(map(any, wanted))
