"""Maps: each number by its definition, whatever the blocks and threads."""

import pickle
import subprocess
import sys

import irbkin
import irbkin.map
import numpy as np
import pytest

ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0, 0, 0.2]))
X, Y, Z = np.linspace(-1.2, 1.6, 5), np.linspace(-0.9, 0.9, 3), np.linspace(0.1, 1.9, 4)
SPREAD = irbkin.map.orientations(7, 2)


def whole() -> irbkin.map.ReachMap:
    return irbkin.map.reach(ROBOT, X, Y, Z, SPREAD)


def test_each_number_is_its_definition():
    found = whole()
    assert found.reached.shape == (5, 3, 4)
    for place in np.ndindex(5, 3, 4):
        reached, solutions, margins, distances = 0, 0, [], []
        for rotation in SPREAD:
            pose = np.eye(4)
            pose[:3, :3] = rotation
            pose[:3, 3] = X[place[0]], Y[place[1]], Z[place[2]]
            inside = ROBOT.ik(pose).within_limits()
            inside = inside.filter(irbkin.Cell())
            solutions += len(inside)
            if len(inside):
                reached += 1
                rooms = [ROBOT.margin(turn.q) for turn in inside.turns()]
                margins.append(max(min(map(float, room)) for room in rooms))
                distances.append(max(float(room.singularities) for room in rooms))
        assert (found.reached[place], found.solutions[place]) == (reached, solutions)
        assert found.share[place] == reached / 14
        for field, values in ((found.margin, margins), (found.singularities, distances)):
            wanted = min(values) if values else np.nan
            assert field[place] == pytest.approx(wanted, abs=1e-9, nan_ok=True)
    assert 0.0 in found.share
    assert found.share.max() > 0.7


TABLE = irbkin.Cell({"table": irbkin.body.Shape.box([1, 2, 0.1], [1.1, 0, 0.5])})


def test_what_collides_is_not_reached():
    bare = irbkin.map.reach(ROBOT.with_body(None), X, Y, Z, SPREAD)
    own, among = whole(), irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, cell=TABLE)
    assert (own.solutions <= bare.solutions).all()
    assert (among.solutions <= own.solutions).all()
    assert bare.solutions.sum() > own.solutions.sum() > among.solutions.sum() > 0
    assert irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, cell=irbkin.Cell()) == own
    # In its own foot an arm reaches nothing.
    bare = ROBOT.with_tool(np.eye(4))
    foot = irbkin.map.reach(bare, -0.2, 0.0, 0.0, SPREAD)
    assert foot.reached.sum() == 0
    assert np.isnan(foot.margin).all()
    assert irbkin.map.reach(bare.with_body(None), -0.2, 0.0, 0.0, SPREAD).reached.sum() > 0
    with pytest.raises(irbkin.InvalidModelError, match="no body"):
        irbkin.map.reach(ROBOT.with_body(None), X, Y, Z, SPREAD, cell=TABLE)


def test_a_margin_in_a_cell_is_that_of_the_solutions_that_are_free():
    poses = ROBOT.fk(ROBOT.random(300, rng=2))
    found = ROBOT.ik_margin(poses, cell=TABLE)
    seen = set()
    for index, pose in enumerate(poses):
        free = ROBOT.ik(pose).within_limits().filter(TABLE)
        assert found.solutions[index] == len(free)
        rooms = [min(map(float, ROBOT.margin(turn.q))) for turn in free.turns()]
        wanted = max(rooms, default=np.nan)
        assert found.margin[index] == pytest.approx(wanted, abs=1e-9, nan_ok=True)
        seen.add(len(free) > 0)
    assert seen == {True, False}


@pytest.mark.parametrize("options", [{"block": 1}, {"block": 7}, {"threads": 2}, {"block": 10**6}])
def test_the_map_does_not_depend_on_blocks_and_threads(options):
    assert irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, **options) == whole()


def test_a_map_is_stored_by_numpy(tmp_path):
    found = whole()
    np.savez(tmp_path / "reach.npz", **found._asdict())
    assert irbkin.map.ReachMap(**np.load(tmp_path / "reach.npz")) == found
    assert pickle.loads(pickle.dumps(found)) == found


# The peak of the process [kB]; getrusage has that of the parent, too.
PEAK = """
import re
def peak():
    with open("/proc/self/status") as file:
        return int(re.search(r"VmHWM:\\s+(\\d+) kB", file.read())[1])
"""


def test_memory_does_not_grow_with_the_poses():
    """4 million poses, each of 128 bytes alone, in less than 60 MB more than the import needs."""
    program = """
import numpy as np
import irbkin, irbkin.map

robot = irbkin.Robot("IRB 2600-12/1.65")
spread = irbkin.map.orientations(50, 2)
irbkin.map.reach(robot, 1.0, 0.0, 1.0, spread)
before = peak()
axis = np.linspace(-3, 3, 40)
irbkin.map.reach(robot, axis, axis, np.linspace(0, 2, 25), spread)
print(peak() - before)
"""
    run = subprocess.run(
        [sys.executable, "-c", PEAK + program],
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    assert int(run.stdout) < 60_000


def test_orientations_are_spread_evenly():
    spread = irbkin.map.orientations(200, 4).reshape(200, 4, 3, 3)
    flat = spread.reshape(-1, 3, 3)
    np.testing.assert_allclose(
        flat @ np.swapaxes(flat, 1, 2), np.tile(np.eye(3), (800, 1, 1)), atol=1e-12
    )
    np.testing.assert_allclose(np.linalg.det(flat), 1.0)
    directions = spread[:, 0, :, 2]
    np.testing.assert_allclose(spread[:, 2, :, 2], directions, atol=1e-12)
    np.testing.assert_allclose(directions.mean(axis=0), 0, atol=0.01)
    cosines = directions @ directions.T - 2 * np.eye(200)
    nearest = np.degrees(np.arccos(cosines.max(axis=1)))
    # Were they on a grid of triangles, neighbors would be 15.4 deg apart.
    assert nearest.min() > 11
    quarter = np.swapaxes(spread[:, 0], 1, 2) @ spread[:, 1]
    np.testing.assert_allclose(quarter[:, 1, 0], 1.0)
    for arguments in ((0,), (5, 0)):
        with pytest.raises(irbkin.InvalidPoseError, match="must be at least 1"):
            irbkin.map.orientations(*arguments)


def test_an_arm_of_seven_joints_has_a_map_for_an_angle_of_joint_7():
    panda = irbkin.Robot("Panda")
    found = irbkin.map.reach(panda, [0.4, 0.6], 0.0, 0.4, SPREAD, q7=0.3)
    pose = np.eye(4)
    counts = []
    for x in (0.4, 0.6):
        for rotation in SPREAD:
            pose[:3, :3], pose[:3, 3] = rotation, (x, 0.0, 0.4)
            counts.append(len(panda.ik(pose, q7=0.3).within_limits()))
    assert found.solutions.ravel().tolist() == np.reshape(counts, (2, -1)).sum(axis=1).tolist()
    assert found.reached.sum() > 0
    with pytest.raises(TypeError, match="q7"):
        irbkin.map.reach(panda, 0.4, 0.0, 0.4, SPREAD)


def test_bad_input_is_refused_with_its_name():
    mirrored = SPREAD.copy()
    mirrored[3] = np.diag([1.0, 1.0, -1.0])
    for change, error, message in [
        ({"x": [0.0, np.nan]}, irbkin.InvalidPoseError, r"x\[1\] is nan"),
        ({"y": []}, irbkin.InvalidPoseError, "y must have shape"),
        ({"z": [[1.0]]}, irbkin.InvalidPoseError, "z must have shape"),
        ({"x": "far"}, irbkin.InvalidPoseError, "x must have shape"),
        ({"orientations": mirrored}, irbkin.InvalidPoseError, r"orientations\[3\]: "),
        ({"orientations": np.eye(4)}, irbkin.InvalidPoseError, "orientations must have shape"),
        ({"block": 0}, irbkin.InvalidPoseError, "block is 0"),
        ({"block": 2.5}, irbkin.InvalidPoseError, "block is 2.5, it must be a whole number"),
        ({"robot": "UR5e"}, TypeError, r"robot must be a Robot, got str: give Robot\('UR5e'\)"),
        ({"q7": 0.1}, TypeError, "q7"),
    ]:
        arguments = {"robot": ROBOT, "x": X, "y": Y, "z": Z, "orientations": SPREAD, **change}
        with pytest.raises(error, match=message):
            irbkin.map.reach(**arguments)
    for number in (2.5, "3"):
        with pytest.raises(irbkin.InvalidPoseError, match="it must be a whole number"):
            irbkin.map.orientations(number)
