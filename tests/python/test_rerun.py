"""Files of rerun: `Scene.save("x.rrd")` has the scene that every face draws."""

import itertools
import sys
from pathlib import Path

import command
import irbkin
import numpy as np
import pytest
from irbkin import rapid, scene
from irbkin.body import Shape
from irbkin.scene._arms import outward

NAME = "IRB 2600-12/1.65"
ROBOT = irbkin.Robot(NAME).with_tool(irbkin.pose([0.1, 0, 0.2]))
MODULE = Path(__file__).parents[2] / "examples" / "pick_and_place.mod"
CELL = irbkin.Cell({
    "post/left": Shape.cylinder(0.05, 1.2, irbkin.pose([0.8, 0.4, 0.6])),
    "floor": Shape.half_space([0, 0, 1], [0, 0, -0.1]),
    "hull": Shape.convex(np.eye(4, 3) + 2),
})  # fmt: skip
# A position of 2 m in single precision is off by half of its last digit.
SINGLE = 2.0 * 2.0**-24


def test_without_rerun_the_extra_is_named(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "rerun", None)
    monkeypatch.delitem(sys.modules, "irbkin.scene._rerun", raising=False)
    file = tmp_path / "arm.rrd"
    with pytest.raises(ImportError, match=r"pip install 'irbkin\[rerun\]'"):
        scene.of(ROBOT).save(file)
    assert not file.exists()


@pytest.fixture
def chunk():
    import rerun.chunk

    return rerun.chunk


class Recorded:
    """A file read back: the columns of each entity."""

    def __init__(self, chunk, file):
        self.entities = {}
        for it in chunk.RrdReader(file).stream():
            batch, own = it.to_record_batch(), self.entities.setdefault(it.entity_path, {})
            for name in (it for it in batch.schema.names if it == "time" or ":" in it):
                # Times are nanoseconds.
                column = batch[name].cast("int64") if name == "time" else batch[name]
                own.setdefault(name, []).extend(column.to_pylist())

    def __call__(self, entity, component):
        """The values of a component."""
        return self.entities[entity][component]

    def times(self, entity):
        return 1e-9 * np.array(self(entity, "time"))

    def frames(self, entity):
        """Positions and rotations, one of each row."""
        places = np.array(self(entity, "Transform3D:translation"), dtype=float)
        turns = np.array(self(entity, "Transform3D:mat3x3"), dtype=float)
        # rerun has matrices column by column.
        return places[:, 0], turns.reshape(-1, 3, 3).swapaxes(1, 2)


@pytest.mark.recipes
def test_a_program_is_recorded_with_its_motion_source_and_findings(chunk, tmp_path):
    played, file = tmp_path / "program.json", tmp_path / "program.rrd"
    assert command.run("view", NAME, MODULE, "-o", played).returncode == 0
    own = scene.Scene.load(played)
    own.save(file)
    recorded = Recorded(chunk, file)
    made = rapid.motion(irbkin.Robot(NAME), rapid.load(MODULE))
    motion = own.arms[0].motion
    frames = irbkin.Robot(NAME).link_frames(np.array(motion.q))
    for index, entity in enumerate([*(f"/arm_0/link_{i}" for i in range(1, 7)), "/arm_0/tool"]):
        np.testing.assert_allclose(recorded.times(entity), motion.t, rtol=0, atol=1e-9)
        places, turns = recorded.frames(entity)
        np.testing.assert_allclose(places, frames[:, index, :3, 3], rtol=0, atol=SINGLE)
        np.testing.assert_allclose(turns, frames[:, index, :3, :3], rtol=0, atol=SINGLE)
    hull = next(it for it in own.arms[0].hulls if it.link == 2)
    (corners,) = recorded("/arm_0/link_2", "Mesh3D:vertex_positions")
    wanted = outward(hull)[np.ravel(hull.faces)]
    np.testing.assert_allclose(corners, wanted, rtol=0, atol=SINGLE)
    assert len(motion.t) > 100
    np.testing.assert_array_equal(recorded("/arm_0/joints", "Scalars:scalars"), motion.q)
    lines = [it[0].split("  ")[0] for it in recorded("/arm_0/program", "TextLog:text")]
    changed = [str(it) for it, _ in itertools.groupby(motion.lines)]
    assert lines == changed
    words = [it[0] for it in recorded("/findings", "TextLog:text")]
    assert words == [f"{it.place} {it.text}" for it in own.marks]
    assert len(words) == len(made.findings) > 0
    places = [recorded(f"/marks/{i}", "Points3D:positions")[0][0] for i in range(len(words))]
    np.testing.assert_allclose(places, [it.point for it in own.marks], rtol=0, atol=SINGLE)


@pytest.mark.recipes
def test_solutions_and_their_cell_are_recorded(chunk, tmp_path):
    T = ROBOT.fk([0.3, 0.2, 0.1, 0.4, 0.5, 0.6])
    solutions = ROBOT.ik(T)
    cloud = scene.Cloud("reach", ((0.0, 0.0, 1.0), (1.0, 0.0, 1.0)), (0.0, 1.0))
    own = scene.of([solutions, CELL], ROBOT, q=solutions[0].q) + scene.Scene(clouds=(cloud,))
    own += scene.Scene(paths=(scene.Path("way", ((0.0, 0.0, 1.0), (1.0, 0.5, 1.0))),))
    own.save(tmp_path / "own.rrd")
    recorded = Recorded(chunk, tmp_path / "own.rrd")
    places, turns = recorded.frames("/arm_0/tool")
    np.testing.assert_allclose(places, [T[:3, 3]], rtol=0, atol=SINGLE)
    np.testing.assert_allclose(turns, [T[:3, :3]], rtol=0, atol=SINGLE)
    (others,) = recorded("/arm_0/others/link_6", "InstancePoses3D:translations")
    wanted = ROBOT.link_frames(solutions.q[1:])[:, 5, :3, 3]
    np.testing.assert_allclose(others, wanted, rtol=0, atol=SINGLE)
    assert len(others) == len(solutions) - 1 > 0
    (corners,) = recorded(r"/obstacles/2_hull", "Mesh3D:vertex_positions")
    np.testing.assert_allclose(sorted(corners), sorted((np.eye(4, 3) + 2).tolist()), atol=1e-6)
    (line,) = recorded("/paths/0_way", "LineStrips3D:strips")
    np.testing.assert_array_equal(line, [own.paths[-1].points])
    assert {
        "/arm_0/link_0", r"/obstacles/0_post\/left", "/obstacles/1_floor", "/frames/0_pose",
        "/clouds/0_reach", "/arm_1/tool",
    } <= set(recorded.entities)  # fmt: skip
    assert "/arm_0/joints" not in recorded.entities


@pytest.mark.recipes
def test_a_folder_that_is_missing_is_named(chunk, tmp_path):
    with pytest.raises(FileNotFoundError, match=r"arm\.rrd"):
        scene.of(ROBOT).save(tmp_path / "no" / "arm.rrd")
