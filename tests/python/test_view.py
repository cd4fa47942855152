"""`irbkin view`: what it writes, and what it refuses."""

import base64
import json
from pathlib import Path
from xml.etree import ElementTree

import command
import irbkin
import numpy as np
import pytest
from irbkin import scene
from irbkin.scene import _page
from irbkin.scene._page import SCRIPTS, page, scripts

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


def test_a_picture_has_the_arms_and_the_way_of_the_tool(tmp_path):
    made = irbkin.rapid.motion(ROBOT, irbkin.rapid.load(MODULE))
    two = scene.of(made, ROBOT) + scene.of(ROBOT.with_base([2.0, 0, 0]))
    counts = []
    for own in (scene.of(ROBOT), two):
        own.save(tmp_path / "arm.svg")
        tags = [it.tag.rpartition("}")[2] for it in ElementTree.parse(tmp_path / "arm.svg").iter()]
        counts.append((tags.count("path"), tags.count("polyline")))
    (arm, _), (both, ways) = counts
    assert both == 2 * arm > 0
    assert ways > 0
    with pytest.raises(ValueError, match="no arm"):
        scene.Scene().save(tmp_path / "none.svg")
    assert not (tmp_path / "none.svg").exists()


@pytest.mark.parametrize("name", ["a.png", "a.pdf", "a", "a.json.txt", "a.xml"])
def test_an_ending_that_is_unknown_is_refused_with_those_known(tmp_path, name):
    with pytest.raises(ValueError, match=r"must end in \.json, \.html, \.htm, \.svg$"):
        scene.of(ROBOT).save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_page_is_written_with_and_without_the_engine(tmp_path, monkeypatch):
    file, engine = tmp_path / "arm.html", tmp_path / "irbkin.wasm.gz"
    monkeypatch.setattr(_page, "ENGINE", engine)
    for content in (b"", b"engine"):
        if content:
            engine.write_bytes(content)
        _page.engine.cache_clear()
        assert command.run("view", NAME, "-o", file).returncode == 0
        text = file.read_text()
        assert scene.of(ROBOT).to_json() in text
        assert f"<title>irbkin: {NAME}</title>" in text
        packed = base64.b85encode(content).decode().replace("<", ".")
        assert f'const ENGINE = "{packed}";' in text
    _page.engine.cache_clear()


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
    assert "/*engine*/" not in scripts()


def test_wrong_files_are_refused(tmp_path):
    assert "--output: arm.pdf: must end in .json" in command.refused("view", NAME, "-o", "arm.pdf")
    broken = tmp_path / "broken.json"
    broken.write_text(json.dumps({"format": "irbkin scene", "version": 1, "arms": 3}))
    assert "scene.arms is 3" in command.refused("view", broken, "-o", tmp_path / "x.json")
    assert "line" in command.refused("view", NAME, __file__, "-o", tmp_path / "x.json")
