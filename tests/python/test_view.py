"""`irbkin view`: what it writes, and what it refuses."""

import json
from pathlib import Path

import command
import irbkin
import numpy as np
from irbkin import scene
from irbkin.scene._page import ENGINE, SCRIPTS, page, scripts

NAME = "IRB 2600-12/1.65"
ROBOT = irbkin.Robot(NAME)
MODULE = Path(__file__).parents[2] / "examples" / "pick_and_place.mod"


def test_an_arm_is_written_as_its_scene(tmp_path):
    file = tmp_path / "arm.json"
    joints = [10, 20, -10, 5, 30, 5]
    done = command.run("view", NAME, "--joints", *map(str, joints), "-o", file)
    assert done.returncode == 0, done.stderr
    assert scene.Scene.load(file) == scene.of(ROBOT, q=np.radians(joints))
    again = tmp_path / "again.json"
    assert command.run("view", file, "-o", again).returncode == 0
    assert again.read_text() == file.read_text()


def test_a_module_is_written_with_its_source_and_findings(tmp_path):
    file = tmp_path / "program.json"
    assert command.run("view", NAME, MODULE, "-o", file).returncode == 0
    written = scene.Scene.load(file)
    made = irbkin.rapid.motion(ROBOT, irbkin.rapid.load(MODULE))
    motion = written.arms[0].motion
    assert motion.source == MODULE.read_text()
    assert motion.lines == tuple(made.lines)
    assert len(written.marks) == len(made.findings) > 0
    assert written.title == MODULE.name


def test_a_page_is_written_or_its_engine_is_asked_for(tmp_path):
    file = tmp_path / "arm.html"
    if ENGINE.exists():
        assert command.run("view", NAME, "-o", file).returncode == 0
        text = file.read_text()
        assert scene.of(ROBOT).to_json() in text
        assert f"<title>irbkin: {NAME}</title>" in text
    else:
        assert "make page" in command.refused("view", NAME, "-o", file)
        assert not file.exists()


def test_a_text_in_a_scene_does_not_end_the_script(monkeypatch):
    monkeypatch.setattr("irbkin.scene._page.engine", lambda: "")
    own = scene.Scene(title="</script><b>", marks=(scene.Mark((0.0, 0.0, 0.0), "</script>"),))
    text = page(own)
    assert text.count("</script>") == 1
    assert "<title>irbkin: &lt;/script>&lt;b></title>" in text
    shown = text.split("const SCENE = ")[1].split(";\n")[0]
    assert scene.Scene.from_json(shown) == own
    folder = Path(scene.__file__).parent / "page"
    own_scripts = {f"{name}.js" for name in (*SCRIPTS, "widget")}
    assert own_scripts == {it.name for it in folder.glob("*.js")}
    assert "/*wasm*/" not in scripts()


def test_wrong_files_are_refused(tmp_path):
    assert "must end in .html or .json" in command.refused("view", NAME, "-o", "arm.pdf")
    broken = tmp_path / "broken.json"
    broken.write_text(json.dumps({"format": "irbkin scene", "version": 1, "arms": 3}))
    assert "scene.arms is 3" in command.refused("view", broken, "-o", tmp_path / "x.json")
    assert "line" in command.refused("view", NAME, __file__, "-o", tmp_path / "x.json")
