"""Maps: each number by its definition, whatever the blocks, threads, workers and interruptions."""

import inspect
import pickle
import signal
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


@pytest.mark.parametrize("options", [{"block": 1}, {"block": 7}, {"threads": 2}, {"block": 10**6}])
def test_the_map_does_not_depend_on_blocks_and_threads(options):
    assert irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, **options) == whole()


def test_more_orientations_than_are_solved_at_a_time_are_all_counted(monkeypatch):
    from irbkin.map import _reach

    wanted = whole()
    for size in (1, 5, 30):
        monkeypatch.setattr(_reach, "AT_A_TIME", size)
        assert whole() == wanted


def test_a_cluster_has_the_same_map(client):
    found = irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, client=client, block=4)
    assert found == whole()


def test_an_error_of_a_worker_is_raised_here(client):
    with pytest.raises(RuntimeError, match="no scene"):
        irbkin.map.plan_batch(ROBOT, paths(8), accept=broken, client=client, block=2)
    # And the cluster goes on.
    assert irbkin.map.reach(ROBOT, 1.0, 0.0, 1.0, SPREAD, client=client).reached.shape == (1, 1, 1)


def broken(q: np.ndarray) -> np.ndarray:
    raise RuntimeError("no scene")


def paths(count: int) -> list[np.ndarray]:
    rng = np.random.default_rng(8)
    made = []
    for number in range(count):
        ends = [
            irbkin.pose(rng.uniform([0.7, -0.4, 0.4], [1.1, 0.4, 0.8]), euler_zyx=[0, 2.7, 0.2])
            for _ in range(2)
        ]
        made.append(irbkin.paths.line(*ends, steps=20 + number))
    made[3][5, 2, 3] += 3.0
    made[4][2, 0, 0] = np.nan
    return made


def assert_same(found: tuple[object, ...], wanted: tuple[object, ...]) -> None:
    assert len(found) == len(wanted)
    for one, other in zip(found, wanted, strict=True):
        assert type(one) is type(other)
        if isinstance(one, irbkin.Plan):
            assert one == other
        else:
            assert str(one) == str(other)
            assert getattr(one, "plan", None) == getattr(other, "plan", None)


def test_a_cluster_takes_every_option_of_the_robot():
    def taken(function):
        return inspect.signature(function).parameters.keys()

    assert taken(ROBOT.plan_batch) < taken(irbkin.map.plan_batch)


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"rotation": 12, "block": 2},
        {"weights": [2, 1, 1, 1, 1, 1]},
        {"order": "sum", "limit_cost": 0.1, "singularity_cost": 0.2},
    ],
)
def test_plans_of_a_cluster_are_those_of_the_robot(client, options):
    given = paths(9)
    wanted = ROBOT.plan_batch(given, **{k: v for k, v in options.items() if k != "block"})
    assert_same(
        irbkin.map.plan_batch(ROBOT, given, client=client, **{"block": 4, **options}), wanted
    )
    assert_same(irbkin.map.plan_batch(ROBOT, iter(given), **options), wanted)
    kinds = [type(answer) for answer in wanted]
    assert kinds[3:5] == [irbkin.PathError, irbkin.InvalidPoseError]
    assert irbkin.Plan in kinds


def test_starts_and_times_go_with_their_paths(client):
    given = [path for index, path in enumerate(paths(9)) if index not in (3, 4)]
    starts = np.array([ROBOT.ik(path[0]).within_limits()[-1].q for path in given])
    times = [np.linspace(0, 60 + index, len(path)) for index, path in enumerate(given)]
    for options in ({"start": starts}, {"start": list(starts[0])}, {"times": times}):
        found = irbkin.map.plan_batch(ROBOT, given, client=client, block=3, **options)
        assert_same(found, ROBOT.plan_batch(given, **options))
    with pytest.raises(irbkin.InvalidMotionError, match="times must be 7 arrays"):
        irbkin.map.plan_batch(ROBOT, given, client=client, times=times[:-1])
    with pytest.raises(irbkin.InvalidJointsError, match=r"\(7, 6\)"):
        irbkin.map.plan_batch(ROBOT, given, client=client, start=starts[:-1])
    with pytest.raises(irbkin.InvalidPoseError, match=r"paths\[1\]"):
        irbkin.map.plan_batch(ROBOT, [given[0], given[1][:, :3]], client=client)
    with pytest.raises(ValueError, match="block is 0"):
        irbkin.map.plan_batch(ROBOT, given, block=0)


def test_a_map_is_written_and_read(tmp_path):
    output = tmp_path / "maps" / "reach.npz"
    with pytest.raises(FileNotFoundError, match="its folder does not exist"):
        irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, output=output)
    assert not output.parent.exists()
    output.parent.mkdir()
    found = irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, output=output, block=7)
    assert found == whole()
    assert irbkin.map.load(output) == found
    assert [path.name for path in output.parent.iterdir()] == ["reach.npz"]
    # It is ready: nothing is solved again.
    calls = []
    again = irbkin.map.reach(
        ROBOT, X, Y, Z, SPREAD, output=output, progress=lambda *done: calls.append(done)
    )
    assert again == found
    assert calls == [(60, 60)]
    assert pickle.loads(pickle.dumps(found)) == found


def test_a_run_that_was_ended_goes_on_where_it_was(tmp_path):
    output = tmp_path / "reach.npz"

    class EndedError(Exception):
        pass

    def ended(done, count):
        if done >= 21:
            raise EndedError

    with pytest.raises(EndedError):
        irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, output=output, block=7, progress=ended)
    assert not output.exists()
    calls = []
    # Blocks of another size fit into what is left.
    found = irbkin.map.reach(
        ROBOT,
        X,
        Y,
        Z,
        SPREAD,
        output=output,
        block=10,
        progress=lambda *done: calls.append(done),
    )
    assert calls == [(21, 60), (31, 60), (41, 60), (51, 60), (60, 60)]
    assert found == whole() == irbkin.map.load(output)


PROGRAM = """
import sys
import numpy as np
import irbkin, irbkin.map

robot = irbkin.Robot("IRB 2600-12/1.65")
axis = np.linspace(-1.5, 1.5, 40)
spread = irbkin.map.orientations(25, 2)
found = irbkin.map.reach(
    robot, axis, axis, axis, spread, output=sys.argv[1], block=400,
    progress=lambda done, count: print(done, flush=True),
)
print("whole", found.reached.sum())
"""


def test_a_run_that_was_killed_goes_on_where_it_was(tmp_path):
    output = tmp_path / "reach.npz"
    command = [sys.executable, "-c", PROGRAM, str(output)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as run:
        for line in run.stdout:
            if int(line) >= 4000:
                break
        run.send_signal(signal.SIGKILL)
    assert run.returncode == -signal.SIGKILL
    assert not output.exists()
    again = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    lines = again.stdout.splitlines()
    assert 4000 <= int(lines[0]) < 64000
    axis = np.linspace(-1.5, 1.5, 40)
    robot = irbkin.Robot("IRB 2600-12/1.65")
    wanted = irbkin.map.reach(robot, axis, axis, axis, irbkin.map.orientations(25, 2))
    assert lines[-1] == f"whole {wanted.reached.sum()}"
    assert irbkin.map.load(output) == wanted
    assert [path.name for path in tmp_path.iterdir()] == ["reach.npz"]


def test_the_map_of_something_else_is_not_touched(tmp_path):
    output = tmp_path / "reach.npz"
    irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, output=output)
    before = output.read_bytes()
    for arguments in ((ROBOT, X + 1, Y, Z, SPREAD), (ROBOT.with_tool(np.eye(4)), X, Y, Z, SPREAD)):
        with pytest.raises(FileExistsError, match="is of another map"):
            irbkin.map.reach(*arguments, output=output)
    assert output.read_bytes() == before
    with pytest.raises(ValueError, match=r"output must be a file \.npz"):
        irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, output=tmp_path / "reach.csv")
    np.savez(tmp_path / "other.npz", a=1)
    with pytest.raises(ValueError, match="is no map: it has no margin"):
        irbkin.map.load(tmp_path / "other.npz")
    with pytest.raises(FileExistsError, match="is of another map"):
        irbkin.map.reach(ROBOT, X, Y, Z, SPREAD, output=tmp_path / "other.npz")
    np.save(tmp_path / "array.npy", X)
    (tmp_path / "half.npz").write_bytes(before[: len(before) // 2])
    (tmp_path / "empty.npz").touch()
    for name in ("array.npy", "half.npz", "empty.npz"):
        with pytest.raises(ValueError, match="is no map"):
            irbkin.map.load(tmp_path / name)
    with pytest.raises(FileNotFoundError):
        irbkin.map.load(tmp_path / "none.npz")


def test_memory_does_not_grow_with_the_poses():
    """4 million poses, each of 128 bytes alone, in less than 60 MB more than the import needs."""
    program = """
import resource
import numpy as np
import irbkin, irbkin.map

robot = irbkin.Robot("IRB 2600-12/1.65")
spread = irbkin.map.orientations(50, 2)
irbkin.map.reach(robot, 1.0, 0.0, 1.0, spread)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
axis = np.linspace(-3, 3, 40)
irbkin.map.reach(robot, axis, axis, np.linspace(0, 2, 25), spread)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=120
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
    with pytest.raises(TypeError, match="robot must be a Robot"):
        irbkin.map.plan_batch("UR5e", [])
    for number in (2.5, "3"):
        with pytest.raises(irbkin.InvalidPoseError, match="it must be a whole number"):
            irbkin.map.orientations(number)


def test_a_cluster_is_not_needed_for_the_import():
    """Nor does a star import replace Python's own map."""
    program = """
import sys
sys.modules["distributed"] = sys.modules["dask"] = None
import irbkin, irbkin.map
irbkin.map.reach(irbkin.Robot("UR5e"), 0.4, 0.1, 0.3, irbkin.map.orientations(3))
from irbkin import *
assert map is __builtins__.map
"""
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)
