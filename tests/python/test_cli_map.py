"""`irbkin map`: the shares of `irbkin.map`, level by level and position by position."""

import irbkin
import irbkin.map
import numpy as np
import pytest
from command import NAME, ROBOT, refused, rows, run

GRID = ["--x", "400", "1600", "--y", "-400", "400", "--z", "0", "1200", "--step", "400"]


def test_levels_and_positions_are_those_of_the_map(tmp_path):
    x, y, z = np.arange(0.4, 1.7, 0.4), np.arange(-0.4, 0.5, 0.4), np.arange(0.0, 1.3, 0.4)
    found = irbkin.map.reach(ROBOT, x, y, z, irbkin.map.orientations(20))
    done = run("map", NAME, *GRID, "--csv")
    assert done.returncode == 0
    table = rows(done)
    np.testing.assert_allclose(table["reached_percent"], 100 * found.share.ravel(), atol=1e-9)
    np.testing.assert_array_equal(table["solutions"], found.solutions.ravel())
    told = run("map", NAME, *GRID).stdout.decode()
    assert f"reached: {100 * found.share.mean():.1f} % of all poses" in told
    assert len(told.splitlines()) == 2 + 2 + 4 + 2
    store = tmp_path / "reach.npz"
    assert run("map", NAME, *GRID, "-o", str(store)).stdout.decode() == told
    np.testing.assert_array_equal(irbkin.map.load(store).reached, found.reached)


def test_a_cell_takes_positions_away(tmp_path):
    wall = "[obstacles.wall]\nbox = [0.3, 3, 3]\npose = { xyz = [1, 0, 0] }\n"
    (file := tmp_path / "cell.toml").write_text(wall)
    cell = irbkin.Cell.load(file)
    x, y, z = np.arange(0.4, 1.7, 0.4), np.arange(-0.4, 0.5, 0.4), np.arange(0.0, 1.3, 0.4)
    wanted = irbkin.map.reach(ROBOT, x, y, z, irbkin.map.orientations(20), cell=cell)
    table = rows(run("map", NAME, *GRID, "--cell", file, "--csv"))
    np.testing.assert_array_equal(table["solutions"], wanted.solutions.ravel())
    assert wanted.solutions.sum() < rows(run("map", NAME, *GRID, "--csv"))["solutions"].sum()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([NAME], "give --x, --y and --z"),
        (GRID, "no robot: give ROBOT first"),
    ],
)
def test_what_is_missing_is_named(words, message):
    assert message in refused("map", *words)


def test_nothing_reached_is_a_finding():
    far = ["--x", "9000", "9100", "--y", "0", "0", "--z", "0", "0"]
    assert run("map", NAME, *far).returncode == 1


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (["--x", "1", "0"], "--x 1 0"),
        (["--step", "0"], "--step 0"),
        (["--step", "nan"], "--step nan"),
        (["--step", "1e-9"], "more than"),
        (["--directions", "0"], "--directions: 0 must be 1 to 1000000"),
        (["--directions", "1000", "--turns", "2000"], "it must be at most 1,000,000"),
        (["--threads", "-1"], "--threads: -1 must be 0 to 1024"),
        (["--threads", "9" * 20], "must be 0 to 1024"),
        (["--euler", "0", "0", "400"], "--euler: rx is 400 deg"),
    ],
)
def test_grids_that_make_no_sense_are_refused(changed, words):
    assert words in refused("map", NAME, *GRID, *changed)
