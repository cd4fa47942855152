"""Broken URDFs, scenes, cells and meshes: only the errors that the readers promise."""

from pathlib import Path

import irbkin
import numpy as np
import pytest
import robotstudio_files
from irbkin import scene
from irbkin.body import Shape
from mangling import INPUTS, dice, mangled

DATA = Path(__file__).parents[1] / "data"
ROBOT = irbkin.Robot("IRB 2600-12/1.65")
CELL = b"""margin = 0.01
[frames]
table = { xyz = [0.8, 0, 0.4], euler_zyx_deg = [0, 0, 90] }
[obstacles.top]
box = [1.2, 0.8, 0.05]
pose = { frame = "table" }
[obstacles.post]
cylinder = { radius = 0.05, length = 0.8 }
pose = { xyz = [0.8, 0.4, 0.4] }
"""


def read_urdf(content, path):
    path = path.with_suffix(".urdf")
    path.write_bytes(content)
    irbkin.Robot.from_urdf(path, tip="tool0")


def read_scene(content, path):
    scene.Scene.from_json(content)


def read_cell(content, path):
    path = path.with_suffix(".toml")
    path.write_bytes(content)
    irbkin.Cell.load(path)


def read_studio(content, path):
    path.write_bytes(content)
    irbkin.Robot.from_robotstudio(path)


def sound_scene():
    cell = irbkin.Cell({"post": Shape.box([0.1, 0.1, 1.0])})
    move = irbkin.trajectory.joint(np.zeros(6), np.full(6, 0.3), steps=3)
    whole = scene.of(move, ROBOT) + scene.of(cell)
    return whole.to_json().replace(",", ",\n").encode()


STATION = robotstudio_files.pim(robotstudio_files.definition(), robotstudio_files.instance())
READERS = {
    "urdf": (read_urdf, (DATA / "ur5e.urdf").read_bytes(), irbkin.IrbkinError),
    "scene": (read_scene, sound_scene(), ValueError),
    "cell": (read_cell, CELL, irbkin.IrbkinError),
    "station": (read_studio, STATION.replace(b"><", b">\n<"), irbkin.IrbkinError),
    "library": (read_studio, robotstudio_files.archive({"PIM.xml": STATION}), irbkin.IrbkinError),
}


@pytest.mark.parametrize("name", READERS)
def test_a_broken_file_raises_what_its_reader_promises(name, tmp_path):
    read, sound, promised = READERS[name]
    random_ = dice(name)
    read(sound, tmp_path / "sound")
    messages = []
    for _ in range(INPUTS // 5):
        content = mangled(random_, sound)
        try:
            read(content, tmp_path / "broken")
        except promised as error:
            messages.append(str(error))
    assert all(messages)
    assert 0 < len(messages) < INPUTS // 5
