"""Shapes, bodies and cells from Python."""

import copy
import pickle
import re

import irbkin
import numpy as np
import pytest
from irbkin.body import Body, Shape

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
CELL = irbkin.Cell(
    {
        "table": Shape.box([0.8, 1.2, 0.05], irbkin.pose([1.0, 0, 0.3])),
        "ball": Shape.sphere(0.2, [0.6, 0.6, 1.0]),
        "rod": Shape.capsule([-0.6, 0.6, 0], [-0.6, 0.6, 1.5], 0.1),
        "post": Shape.cylinder(0.1, 1.5, irbkin.pose([-0.6, -0.6, 0.75])),
        "floor": Shape.half_space([0, 0, 1], [0, 0, -0.5]),
    },
    margin=0.02,
)


def postures(count):
    low, high = ROBOT.limits.T
    return np.random.default_rng(5).uniform(low, high, (count, 6))


def test_collisions_are_distances_up_to_the_margin():
    q = postures(400)
    alone = irbkin.Cell().distance(ROBOT, q).distance
    near = CELL.distance(ROBOT, q)
    collides = CELL.collides(ROBOT, q)
    obstacles = np.array(["link" not in other for _, other in near.pair])
    assert collides[(alone <= 0) | (obstacles & (near.distance <= 0.02))].all()
    assert not collides[(near.distance > 0.02 + 1e-8)].any()
    assert 20 < collides.sum() < 380
    assert {other for _, other in near.pair} >= {"table", "ball", "post"}
    assert near.points.shape == (400, 2, 3)
    apart = np.linalg.norm(near.points[:, 0] - near.points[:, 1], axis=1)
    free = near.distance > 1e-3
    np.testing.assert_allclose(apart[free], near.distance[free], atol=1e-6)


def test_shapes_of_arrays_out_and_threads():
    q = postures(600).reshape(2, 300, 6)
    once = CELL.collides(ROBOT, q)
    assert once.shape == (2, 300)
    assert once.dtype == bool
    out = np.zeros((2, 300), bool)
    assert CELL.collides(ROBOT, q, out, threads=2) is out
    assert (out == once).all()
    assert CELL.collides(ROBOT, q[0, 0]).shape == ()
    assert CELL.distance(ROBOT, q[0, 0]).distance.shape == ()
    assert CELL.collides(ROBOT, np.zeros((0, 6))).shape == (0,)
    assert CELL.distance(ROBOT, np.zeros((0, 6))).points.shape == (0, 2, 3)
    assert ROBOT.ik_nearest(np.zeros((0, 4, 4)), np.zeros((0, 6)), cell=CELL).shape == (0, 6)
    assert np.isnan(ROBOT.ik_nearest(np.full((2, 4, 4), np.nan), np.zeros((2, 6)), cell=CELL)).all()
    q[1, 7, 2] = np.nan
    for call in (CELL.collides, CELL.distance):
        with pytest.raises(irbkin.InvalidJointsError, match=r"q\[1, 7\]: q: joint 3 is NaN"):
            call(ROBOT, q)
        with pytest.raises(irbkin.InvalidJointsError, match=r"^q: joint 3 is NaN"):
            call(ROBOT, q[1, 7])


def test_solutions_are_filtered_by_a_cell():
    solutions = ROBOT.ik(irbkin.pose([0.9, 0.2, 0.5], euler_zyx=[0, 2.9, 0]))
    free = solutions.filter(CELL)
    assert {one.slot for one in free} == {
        one.slot for one in solutions if not CELL.collides(ROBOT, one)
    }
    assert 0 < len(free) < len(solutions)
    assert re.search(r"slot \d collides: link \d and \w+, [\d.]+ mm deep", free.explain())
    assert "collides" not in repr(free)
    assert pickle.loads(pickle.dumps(free)) == free
    assert free.filter(CELL) == free
    walls = irbkin.Cell({"all": Shape.sphere(3, [0, 0, 0])})
    none = solutions.filter(walls).explain()
    assert none.count("and all") == len(solutions)


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "UR5e", "Panda", "CRX-10iA"])
def test_the_nearest_solution_does_not_collide(name):
    robot = irbkin.Robot(name)
    rng = np.random.default_rng(7)
    low, high = np.clip(robot.limits, -3, 3).T
    q = rng.uniform(low, high, (60, robot.dof))
    reach = irbkin.catalog_entry(name).reach
    cell = irbkin.Cell({"wall": Shape.half_space([-1, 0, 0], [0.45 * reach, 0, 0])})
    T, seed = robot.fk(q), q + 0.1
    found = robot.ik_nearest(T, seed, cell=cell)
    is_there = ~np.isnan(found[:, 0])
    assert not cell.collides(robot, found[is_there]).any()
    np.testing.assert_allclose(robot.fk(found[is_there]), T[is_there], atol=1e-9)
    # The joints of a pose are an answer, unless they collide; the nearest is at most as far.
    free = ~cell.collides(robot, q)
    assert is_there[free].all()
    assert free.any()
    assert not free.all()
    cost = ((found - seed) ** 2).sum(axis=1)
    assert (cost[free] <= 0.01 * robot.dof + 1e-9).all()
    if robot.dof == 6:
        for row in range(60):
            free_ones = [s.q for s in robot.ik(T[row]).turns() if not cell.collides(robot, s.q)]
            costs = [((one - seed[row]) ** 2).sum() for one in free_ones]
            assert is_there[row] == bool(costs)
            if costs:
                np.testing.assert_allclose(cost[row], min(costs), atol=1e-9)
    row = int(np.argmin(is_there))
    if not is_there[row]:
        words = "collides, the nearest one link . with|out of reach|limits"
        with pytest.raises(irbkin.UnreachableError, match=words):
            robot.ik_nearest(T[row], seed[row], cell=cell)


def test_a_plan_stays_out_of_obstacles():
    # A bent torch: the wrist goes round it.
    robot = ROBOT.with_tool(irbkin.pose([0.3, 0, 0.2], euler_zyx=[0, 0.6, 0]))
    ends = (irbkin.pose([0.9, y, 0.4], euler_zyx=[0, 2.9, 0]) for y in (-0.2, 0.2))
    seam = irbkin.paths.line(*ends, steps=21)
    bare = robot.plan(seam, rotation=24)
    wrist = robot.link_frames(bare.q[10])[4, :3, 3]
    cell = irbkin.Cell({"ball": Shape.sphere(0.01, wrist)})
    assert cell.collides(robot, bare.q).any()
    plan = robot.plan(seam, rotation=24, cell=cell)
    assert not cell.collides(robot, plan.q).any()
    assert plan.bottleneck >= bare.bottleneck * (1 - 1e-9)
    wall = irbkin.Cell({"wall": Shape.half_space([-1, 0, 0], [0.3, 0, 0])})
    with pytest.raises(irbkin.PathError, match=r"link \d and wall"):
        robot.plan(seam[:3], cell=wall)
    seen = []
    both = robot.plan(
        seam[:3], cell=irbkin.Cell(), accept=lambda q: seen.append(1) or np.ones(len(q), bool)
    )
    assert seen
    assert both.q.shape == (3, 6)
    with pytest.raises(irbkin.InvalidMotionError, match="external axes"):
        ROBOT.plan(seam, cell=cell, carrier=irbkin.Track("y", -1, 1, steps=3))


def test_a_gradient_leads_away():
    q = np.array([[0.3, 0.4, 0.2, 0.1, 0.5, 0], [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]])
    near = CELL.distance(ROBOT, q)
    assert near.gradient.shape == (2, 6)
    away = q + 1e-4 * near.gradient
    gain = CELL.distance(ROBOT, away).distance - near.distance
    assert np.allclose(gain, 1e-4 * (near.gradient**2).sum(axis=1), rtol=0.05)
    assert CELL.distance(ROBOT, q[:0]).gradient.shape == (0, 6)


def test_a_motion_is_free_between_its_rows_or_says_where_it_is_not():
    q = np.array([[-0.6, 0.3, 0.2, 0, 0.5, 0], [0.6, 0.3, 0.2, 0, 0.5, 0]])
    middle = ROBOT.link_frames(q.mean(axis=0))[5, :3, 3]
    cell = irbkin.Cell({"ball": Shape.sphere(0.02, middle)})
    assert not cell.collides(ROBOT, q).any()
    assert irbkin.Cell().check_path(ROBOT, q) is None
    contact = cell.check_path(ROBOT, q)
    assert 0.2 < contact.at < 0.5
    assert contact.pair[1] == "ball"
    assert contact.depth > 0.01
    part = q[0] + contact.at * (q[1] - q[0])
    assert np.abs(part - contact.q).max() < 1e-9
    assert abs(float(cell.distance(ROBOT, contact.q).distance)) < 3e-4
    assert cell.check_path(ROBOT, [q[0], q[0] + 0.9 * contact.at * (q[1] - q[0])]) is None
    motion = irbkin.trajectory.joint(q[0], q[1], max_velocity=1, max_acceleration=2)
    timed = cell.check_path(ROBOT, motion)
    assert 0 < timed.at < motion.duration
    assert np.abs(motion.sample(timed.at).q - timed.q).max() < 1e-3
    assert irbkin.Cell().check_path(ROBOT, motion) is None


def test_a_contact_far_along_a_path_has_its_row():
    rows = np.zeros((5000, 6))
    rows[4000:, 0] = 1.5
    ball = Shape.sphere(0.05, ROBOT.link_frames([0.75, 0, 0, 0, 0, 0])[4, :3, 3])
    contact = irbkin.Cell({"ball": ball}).check_path(ROBOT, rows)
    assert 3999 < contact.at < 4000


def test_a_contact_is_as_deep_wherever_it_is_in_a_path():
    """It begins behind row 2046 and is the deepest at row 2080."""
    start, way = np.array([-0.6, 0.3, 0.2, 0, 0.5, 0]), np.array([1.2, 0, 0, 0, 0, 0])
    cell = irbkin.Cell({"ball": Shape.sphere(0.02, ROBOT.link_frames(start + way / 2)[5, :3, 3])})
    first = cell.check_path(ROBOT, [start, start + way]).at
    before, behind = np.linspace(0, 0.99 * first, 2047), np.linspace(1.01 * first, 0.5, 34)
    rows = start + np.concatenate([before, behind, behind[::-1]])[:, None] * way
    whole, rest = cell.check_path(ROBOT, rows), cell.check_path(ROBOT, rows[1000:])
    assert 2046 < whole.at <= 2047
    assert whole.depth == rest.depth > 2 * cell.check_path(ROBOT, rows[:2049]).depth
    assert whole.at == pytest.approx(1000 + rest.at)
    assert whole.pair == rest.pair


def test_paths_of_one_row_of_none_and_in_collision():
    inside = irbkin.Cell({"all": Shape.sphere(3, [0, 0, 0])})
    q = np.zeros((3, 6))
    assert inside.check_path(ROBOT, q).at == 0
    assert inside.check_path(ROBOT, q[0]).at == 0
    assert irbkin.Cell().check_path(ROBOT, q[0]) is None
    assert inside.check_path(ROBOT, q[:0]) is None
    with pytest.raises(irbkin.InvalidJointsError, match=r"motion\[1\]"):
        inside.check_path(ROBOT, [[0] * 6, [0, 0, np.inf, 0, 0, 0]])
    of_two = irbkin.trajectory.joint([0, 0], [1, 1], max_velocity=1, max_acceleration=2)
    with pytest.raises(ValueError, match="trajectory"):
        inside.check_path(ROBOT, of_two)


def test_a_plan_goes_round_what_is_between_its_poses():
    robot = ROBOT.with_tool(irbkin.pose([0.3, 0, 0.2], euler_zyx=[0, 0.6, 0]))
    ends = [irbkin.pose([0.9, y, 0.4], euler_zyx=[0, 2.9, 0]) for y in (-0.2, 0.2)]
    for steps in (2, 3, 5):
        seam = irbkin.paths.line(*ends, steps=steps)
        bare = robot.plan(seam, rotation=24)
        between = 0.5 * (bare.q[0] + bare.q[1])
        ball = Shape.sphere(0.01, robot.link_frames(between)[4, :3, 3])
        cell = irbkin.Cell({"ball": ball})
        assert cell.check_path(robot, bare.q) is not None
        plan = robot.plan(seam, rotation=24, cell=cell)
        assert cell.check_path(robot, plan.q) is None
        with pytest.raises(irbkin.PathError, match=r"link \d and ball"):
            robot.plan(robot.fk(bare.q), start=bare.q[0], end=bare.q[-1], cell=cell)


def test_values_are_frozen_equal_and_pickled():
    for value in [ROBOT.body, CELL, *CELL.obstacles.values()]:
        assert pickle.loads(pickle.dumps(value)) == value == copy.deepcopy(value)
        with pytest.raises((AttributeError, TypeError)):
            value.margin = 1
    robot = ROBOT.with_tool(irbkin.pose([0, 0, 0.1]))
    assert pickle.loads(pickle.dumps(robot)).body == ROBOT.body
    assert len(pickle.dumps(robot)) < 1500
    assert ROBOT.with_body(None) != ROBOT
    assert ROBOT.with_body(None).body is None
    calibrated = ROBOT.with_corrections(np.full(42, 1e-3))
    assert calibrated.body.source == ROBOT.body.source
    assert pickle.loads(pickle.dumps(calibrated)).body == calibrated.body
    assert calibrated != ROBOT
    assert "25 capsules" in repr(irbkin.Robot("IRB 1200-5/0.9").body)
    assert repr(Shape.sphere(0.5, [0, 0, 1])) == "Shape.sphere(0.5, [0.0, 0.0, 1.0])"


def test_a_body_of_ones_own_moves_with_its_links():
    rod = [0, 0, 0, 0, 0, 0.5, 0.05]
    robot = ROBOT.with_body(Body([6], [rod], []))
    tip = ROBOT.link_frames(np.zeros(6))[5] @ [0, 0, 0.5, 1]
    ball = irbkin.Cell({"ball": Shape.sphere(0.1, tip[:3])})
    assert ball.collides(robot, np.zeros(6))
    assert not ball.collides(robot, [1, 0, 0, 0, 0, 0])
    assert ball.distance(robot, np.zeros(6)).pair == (("link 6", "ball"),)
    assert irbkin.Cell().distance(robot, np.zeros(6)).distance == np.inf
    np.testing.assert_array_equal(robot.body.capsules, [rod])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: Shape.box([1, 0, 1]), "size is 0 m"),
        (lambda: Shape.sphere(1, [0, np.inf, 0]), "center"),
        (lambda: Shape.half_space([0, 0, 0], [0, 0, 0]), "length zero"),
        (lambda: irbkin.Cell(margin=-0.1), "margin is -0.1 m"),
        (lambda: Body([1], [[0] * 6], []), r"\(1, 7\)"),
        (lambda: Body([1], [[0] * 7], []), "radius is 0 m"),
        (lambda: ROBOT.with_body(Body([9], [[0] * 6 + [1]], [])), "link 9"),
        (lambda: irbkin.Cell().collides(ROBOT.with_body(None), np.zeros(6)), "with_body"),
    ],
)
def test_bad_shapes_are_named(call, words):
    with pytest.raises(irbkin.InvalidModelError, match=words):
        call()
    with pytest.raises(TypeError, match=r'obstacle "table" must be an irbkin\.body\.Shape'):
        irbkin.Cell({"table": [1, 1, 1]})


def test_a_row_alone_is_answered_as_in_a_batch():
    q = np.concatenate([postures(300), np.zeros((1, 6))])
    many = irbkin.Cell({f"ball {i}": Shape.sphere(0.05, [0.7, 0.01 * i, 0.9]) for i in range(120)})
    for cell in (CELL, irbkin.Cell(), many):
        batch = cell.collides(ROBOT, q)
        # Plain arrays, strided ones and lists are read in different ways.
        assert [bool(cell.collides(ROBOT, row)) for row in q] == batch.tolist()
        assert [bool(cell.collides(ROBOT, row)) for row in np.asfortranarray(q)] == batch.tolist()
        assert [bool(cell.collides(ROBOT, row.tolist())) for row in q] == batch.tolist()
        assert 0 < batch.sum() < len(q)
        # A motion of two rows, plain and not; one that starts in a collision ends there.
        for start in q[:60]:
            ends = np.array([start, start + 0.01])
            plain, read = cell.check_path(ROBOT, ends), cell.check_path(ROBOT, ends.tolist())
            assert repr(plain) == repr(read)
            assert bool(cell.collides(ROBOT, start)) == (plain is not None and plain.at == 0)
    for bad in (np.nan, np.inf):
        for ends in ([[0.0] * 6, [0.0, bad, 0, 0, 0, 0]], [[bad] + [0.0] * 5, [0.0] * 6]):
            with pytest.raises(irbkin.InvalidJointsError, match="joint"):
                CELL.check_path(ROBOT, np.array(ends))
            with pytest.raises(irbkin.InvalidJointsError, match="joint"):
                CELL.collides(ROBOT, np.array(next(row for row in ends if bad in row)))
