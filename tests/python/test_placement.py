"""`best_base` against brute force, and by its own answer: each target is solved again from it."""

import itertools
import pickle

import irbkin
import numpy as np
import pytest
from irbkin.placement import Region, best_base

ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
REGION = Region(x=(-0.4, 0.8), y=(-0.6, 0.6), z=0.2, turn=(-1.0, 1.0))


def targets(count: int = 12) -> np.ndarray:
    rng = np.random.default_rng(4)
    return np.array(
        [
            irbkin.pose(rng.uniform([1.0, -0.5, 0.3], [1.6, 0.5, 0.6]), euler_zyx=[0.2, 2.9, 0])
            for _ in range(count)
        ]
    )


def base_of(x: float, y: float, z: float, turn: float) -> np.ndarray:
    return irbkin.pose([x, y, z], euler_zyx=[turn, 0, 0])


def margin(robot: irbkin.Robot, T: np.ndarray) -> float:
    """The margin of a pose by its definition: every solution with every turn."""
    best = np.nan
    for turn in robot.ik(T).within_limits().turns():
        best = np.fmax(best, min(map(float, robot.margin(turn.q))))
    return best


def turned(T: np.ndarray, angle: float) -> np.ndarray:
    return T @ irbkin.pose([0, 0, 0], euler_zyx=[angle, 0, 0])


def assert_verified(found: irbkin.placement.Placement, T: np.ndarray) -> None:
    """Each target is reached inside the limits from the base, with the margin that is claimed."""
    robot = ROBOT.with_base(found.base)
    low, high = robot.limits.T
    for index, pose in enumerate(T):
        tool = turned(pose, found.tool_angle[index])
        q = found.q[index]
        np.testing.assert_allclose(robot.fk(q), tool, atol=1e-9)
        assert ((q >= low - 1e-9) & (q <= high + 1e-9)).all()
        assert found.slack[index] == pytest.approx(min(map(float, robot.margin(q))), abs=1e-9)
        if found.plan is None:
            assert found.slack[index] == pytest.approx(margin(robot, tool), abs=1e-9)
    assert found.margin == pytest.approx(found.slack.min(), abs=1e-9)
    assert found.reachable == 1.0


@pytest.mark.parametrize("rotation", [None, irbkin.ToolRotation(5, -0.8, 0.8), 4])
def test_the_grid_is_brute_force(rotation):
    T = targets()
    found = best_base(ROBOT, T, REGION, rotation=rotation, steps=(4, 4, 3, 3), refine=False)
    angles = {None: [0.0], 4: np.linspace(-np.pi, np.pi, 5)[:-1]}.get(
        rotation, np.linspace(-0.8, 0.8, 5)
    )
    axes = (np.linspace(-0.4, 0.8, 4), np.linspace(-0.6, 0.6, 4), [0.2], np.linspace(-1, 1, 3))
    for axis, wanted in zip(found.grid[:4], axes, strict=True):
        np.testing.assert_allclose(axis, wanted)
    best = -np.inf
    for place, values in zip(
        itertools.product(*map(range, found.grid.margin.shape)),
        itertools.product(*axes),
        strict=True,
    ):
        robot = ROBOT.with_base(base_of(*values))
        each = [np.fmax.reduce([margin(robot, turned(t, a)) for a in angles]) for t in T]
        assert found.grid.reachable[place] == pytest.approx(np.isfinite(each).mean())
        np.testing.assert_allclose(found.grid.margin[place], np.min(each), atol=1e-9)
        best = max(best, np.nan_to_num(np.min(each), nan=-np.inf))
    assert found.margin == pytest.approx(best, abs=1e-9)
    assert np.isnan(found.grid.margin).any()
    assert_verified(found, T)


@pytest.mark.parametrize("rotation", [None, 12])
def test_steps_around_the_best_find_more_and_are_true(rotation):
    T = targets()
    coarse = best_base(ROBOT, T, REGION, rotation=rotation, steps=5, refine=False)
    found = best_base(ROBOT, T, REGION, rotation=rotation, steps=5)
    assert found.margin > coarse.margin + 0.01
    assert_verified(found, T)
    x, y, z = found.base[:3, 3]
    assert -0.4 <= x <= 0.8
    assert -0.6 <= y <= 0.6
    assert z == pytest.approx(0.2)
    assert found.grid == coarse.grid
    assert "all 12 targets are reached" in found.reason


def test_the_answer_is_the_same_every_time_and_on_every_number_of_threads():
    T = targets()
    one = best_base(ROBOT, T, REGION, steps=5)
    assert best_base(ROBOT, T, REGION, steps=5, threads=2) == one
    assert pickle.loads(pickle.dumps(one)) == one


@pytest.mark.parametrize("path", [False, True])
def test_blocks_do_not_change_the_answer(monkeypatch, path):
    from irbkin import placement

    ends = [irbkin.pose([1.3, y, 0.5], euler_zyx=[0, 2.8, 0]) for y in (-0.4, 0.4)]
    T = irbkin.paths.line(*ends, steps=10) if path else targets()
    T[0, 2, 3] += 0.0 if path else 9.0
    wanted = best_base(ROBOT, T, REGION, steps=4, path=path)
    assert wanted.nowhere == (() if path else (0,))
    monkeypatch.setattr(placement, "IN_A_BLOCK", 100)
    assert best_base(ROBOT, T, REGION, steps=4, path=path) == wanted


def test_a_scene_that_is_moved_moves_the_answer():
    T, region = targets(), REGION._replace(turn=0.1)
    here = best_base(ROBOT, T, region, steps=5)
    moved = irbkin.pose([2.0, -1.0, 0.5], euler_zyx=[0.7, 0.2, -0.1])
    there = best_base(ROBOT, moved @ T, region, steps=5, frame=moved)
    assert there.margin == pytest.approx(here.margin, abs=1e-6)
    np.testing.assert_allclose(there.base, moved @ here.base, atol=1e-3)
    np.testing.assert_allclose(there.grid.margin, here.grid.margin, atol=1e-9)


def test_the_mounting_is_that_of_the_robot():
    hung = ROBOT.with_base(irbkin.pose([9, 9, 9], euler_zyx=[0, np.pi, 0]))
    T = targets()
    found = best_base(hung, T, Region(x=(0.0, 1.6), y=(-0.6, 0.6), z=(1.2, 2.4)), steps=5)
    np.testing.assert_allclose(found.base[:3, 2], [0, 0, -1], atol=1e-12)
    assert_verified(found, T)


def test_all_turns_are_no_end():
    T = targets(4)
    region = Region(x=(-0.4, 0.8), turn=(-np.pi, np.pi))
    found = best_base(ROBOT, T, region, steps=(5, 1, 1, 8))
    np.testing.assert_allclose(np.diff(found.grid.turn), np.pi / 4)
    assert len(found.grid.turn) == 8
    # Turned by a half turn, axis 1 is at its end.
    shifted = region._replace(turn=(0.1, 0.1 + 2 * np.pi))
    assert best_base(ROBOT, T, shifted, steps=(5, 1, 1, 8)).margin == pytest.approx(
        found.margin, abs=0.02
    )


@pytest.mark.parametrize("rotation", [None, 6])
def test_a_path_is_planned(rotation):
    ends = [irbkin.pose([1.3, y, 0.5], euler_zyx=[0, 2.8, 0]) for y in (-0.4, 0.4)]
    T = irbkin.paths.line(*ends, steps=25)
    region = Region(x=(-0.2, 0.6), y=(-0.5, 0.5), z=(0.0, 0.4))
    found = best_base(
        ROBOT, T, region, path=True, rotation=rotation, steps=(4, 3, 2, 1), refine=False
    )
    assert_verified(found, T)
    assert found.plan is not None
    assert found.plan.certified
    best = -np.inf
    for values in itertools.product(*found.grid[:4]):
        robot = ROBOT.with_base(base_of(*values))
        try:
            q = robot.plan(T, rotation=rotation).q
        except irbkin.PathError:
            continue
        best = max(best, np.fmin(*robot.margin(q)).min())
    assert found.margin == pytest.approx(best, abs=1e-9)
    finer = best_base(ROBOT, T, region, path=True, rotation=rotation, steps=(3, 2, 1, 1))
    assert_verified(finer, T)


def test_a_path_that_no_plan_follows_says_so():
    """Each pose is reached, but the tool turns on and on."""
    T = np.array(
        [
            irbkin.pose([1.1, 0, 0.6], euler_zyx=[angle % (2 * np.pi), np.pi, 0])
            for angle in np.linspace(0, 30, 200)
        ]
    )
    found = best_base(ROBOT, T, Region(x=(-0.2, 0.2)), path=True, steps=3)
    assert found.reachable == 1.0
    assert np.isnan(found.margin)
    assert found.plan is None
    assert "no plan follows them: no branch reaches pose" in found.reason


def test_what_is_out_of_reach_is_named():
    T = targets()
    T[3, 0, 3] += 9.0
    T[7, 2, 3] += 9.0
    found = best_base(ROBOT, T, REGION, steps=5)
    assert found.nowhere == (3, 7)
    assert found.reachable == pytest.approx(10 / 12)
    assert np.isnan(found.margin)
    assert np.flatnonzero(np.isnan(found.slack)).tolist() == [3, 7]
    assert np.isnan(found.grid.margin).all()
    assert found.grid.reachable.max() == pytest.approx(10 / 12)
    assert "at most 10 of 12 targets are reached" in found.reason
    assert "from no base that was tried: targets 3, 7" in found.reason
    # Two that exclude one another are each reached from somewhere.
    apart = targets(2)
    apart[1, 0, 3] += 4.0
    found = best_base(ROBOT, apart, Region(x=(-0.4, 5.0)), steps=30)
    assert (found.nowhere, found.reachable) == ((), 0.5)
    assert found.reason.startswith("at most 1 of 2 targets")


def test_one_base_is_tried_where_all_is_fixed():
    found = best_base(ROBOT, targets(), Region(x=0.1, turn=0.2))
    np.testing.assert_allclose(found.base, base_of(0.1, 0, 0, 0.2), atol=1e-12)
    assert found.grid.margin.shape == (1, 1, 1, 1)


def test_bad_input_is_refused_with_its_name():
    T = targets()
    bad = T.copy()
    bad[5, 0, 0] = np.nan
    for arguments, error, message in [
        ({"T": bad}, irbkin.InvalidPoseError, r"T\[5\]"),
        ({"T": T[0]}, irbkin.InvalidPoseError, r"\(m, 4, 4\)"),
        ({"T": T[:0]}, irbkin.InvalidPoseError, r"\(m, 4, 4\)"),
        ({"region": (0, 1)}, irbkin.InvalidPoseError, r"region must be a Region, got \(0, 1\)"),
        ({"robot": "UR5e"}, TypeError, r"got str: give Robot\('UR5e'\)"),
        ({"region": Region(x=(1, 0))}, irbkin.InvalidPoseError, r"region.x is \(1, 0\)"),
        ({"region": Region(y=np.inf)}, irbkin.InvalidPoseError, "region.y is inf"),
        ({"region": Region(z="low")}, irbkin.InvalidPoseError, "region.z must be a number"),
        ({"region": Region(turn=(-180, 180))}, irbkin.InvalidPoseError, "degrees"),
        ({"steps": 0}, irbkin.InvalidPoseError, "steps must be 1 or more"),
        ({"steps": 2.5}, irbkin.InvalidPoseError, "got 2.5"),
        ({"steps": (2, 2)}, irbkin.InvalidPoseError, "four such numbers"),
        ({"steps": 1000}, irbkin.InvalidPoseError, "10000000 bases"),
        ({"rotation": 0}, irbkin.InvalidMotionError, "2 to 3600"),
        ({"frame": np.ones((4, 4))}, irbkin.InvalidPoseError, "frame"),
        ({"robot": irbkin.Robot("Panda")}, irbkin.InvalidModelError, "six joints, Panda has 7"),
    ]:
        with pytest.raises(error, match=message):
            best_base(**{"robot": ROBOT, "T": T, "region": REGION, **arguments})


def test_the_plan_of_a_base_is_free_in_a_cell():
    arm = irbkin.Robot("IRB 2600-12/1.65")
    ends = [irbkin.pose([0.9, y, 0.4], euler_zyx=[0, 2.9, 0]) for y in (-0.2, 0.2)]
    seam, region = irbkin.paths.line(*ends, steps=11), Region(x=(-0.3, 0.3))
    options = {"path": True, "rotation": 12, "steps": 5, "refine": False}
    bare = best_base(arm, seam, region, **options)
    robot = arm.with_base(bare.base)
    elbow = robot.link_frames(bare.plan.q[5])[2, :3, 3]
    cell = irbkin.Cell({"ball": irbkin.body.Shape.sphere(0.05, elbow)})
    assert cell.check_path(robot, bare.plan.q) is not None
    found = best_base(arm, seam, region, cell=cell, **options)
    assert cell.check_path(arm.with_base(found.base), found.plan.q) is None
    assert found.margin <= bare.margin + 1e-9
    with pytest.raises(irbkin.InvalidMotionError, match="path=True"):
        best_base(arm, seam, region, cell=cell)
