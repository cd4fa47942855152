"""Bodies from Python: approximate ones, and what the flange carries."""

import copy
import pickle

import irbkin
import numpy as np
import pytest
from irbkin import Robot
from irbkin.body import Body, Shape

ROBOT = Robot("IRB 2600-12/1.65")
ROD = Shape.cylinder(0.03, 0.4, irbkin.pose([0, 0, 0.2]))


def postures(robot, count):
    return np.random.default_rng(6).uniform(*robot.limits.T, (count, robot.dof))


def test_every_arm_has_a_body_and_says_which():
    bodies = {name: Robot(name).body for name in irbkin.catalog()}
    approximate = [name for name, body in bodies.items() if body.is_approximate]
    assert 30 < len(approximate) < len(bodies) - 33
    for name in approximate:
        assert bodies[name].source.startswith("approximate: ")
        assert len(bodies[name].excess) == 0
        assert bodies[name] == Robot(name).approximate_body()
    own = Robot.from_mdh(ROBOT.mdh, ROBOT.limits)
    assert own.body is None
    assert own.with_body(own.approximate_body()).body.is_approximate


def test_capsules_of_an_approximate_body_lie_along_the_arm():
    robot = Robot("IRB 140-6/0.81")
    body, q = robot.body, np.array([0.3, 0.2, -0.4, 0.5, 0.6, 0.7])
    frames = [np.eye(4), *robot.link_frames(q)[:6]]
    ends = np.array(
        [
            (frames[link] @ np.append(end, 1))[:3]
            for link, row in zip(body.links, body.capsules, strict=True)
            for end in row[:6].reshape(2, 3)
        ]
    )
    # The lines of one link begin where the one before ends, from the base to the flange.
    np.testing.assert_allclose(ends[0], 0, atol=1e-12)
    np.testing.assert_allclose(ends[-1], robot.fk(q)[:3, 3], atol=1e-12)
    gaps = np.linalg.norm(ends[2::2] - ends[1:-1:2], axis=1)
    assert gaps.max() < 1e-12
    assert (np.diff(body.capsules[:, 6]) <= 1e-12).all()


def test_what_the_flange_carries_is_in_its_frame():
    robot = ROBOT.with_tool([0, 0, 0.5]).with_attached(ROD)
    assert robot.body.links[-1] == 7
    assert len(robot.body.excess) == 8
    assert robot == ROBOT.with_attached([ROD]).with_tool([0, 0, 0.5])
    assert robot.body.pairs[: len(ROBOT.body.pairs)] == ROBOT.body.pairs
    shifted = ROBOT.with_attached(ROD, irbkin.pose([0, 0.1, 0]))
    off = shifted.body.capsules[-1] - robot.body.capsules[-1]
    np.testing.assert_allclose(off, [0, 0.1, 0, 0, 0.1, 0, 0], atol=1e-15)
    fine = ROBOT.with_attached(Shape.box([0.2, 0.1, 0.1]), excess=0.03)
    assert fine.body.excess[7] <= 0.03
    assert (fine.body.links == 7).sum() > 1


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "Panda", "IRB 2400-10/1.55"])
def test_rows_and_distances_agree_on_what_the_flange_carries(name):
    robot = Robot(name).with_attached(ROD).with_base(irbkin.pose([0.1, 0.2, 0.3]))
    q = postures(robot, 300)
    cell = irbkin.Cell({"wall": Shape.half_space([-1, 0, 0], [0.9, 0, 0])})
    near, alone = cell.distance(robot, q), irbkin.Cell().distance(robot, q)
    least = np.minimum(near.distance, alone.distance)
    collides = cell.collides(robot, q)
    assert collides[least < 0].all()
    assert not collides[least > 1e-8].any()
    assert 20 < collides.sum() < 280
    carried = f"link {robot.dof + 1}"
    assert sum(pair[0] == carried for pair in near.pair) > 20
    # The tip of the rod is inside: so far it is from the wall at most.
    flange = robot.fk(q)
    tips = (flange @ [0, 0, 0.4, 1])[:, 0]
    assert (near.distance <= 0.9 - tips + 1e-9).all()


def test_bodies_are_values():
    for robot in [ROBOT.with_attached(ROD), Robot("IRB 140-6/0.81"), Robot("GoFa 10")]:
        again = pickle.loads(pickle.dumps(robot))
        assert again == robot
        assert again.body == robot.body == copy.deepcopy(robot.body)
        assert again.body.is_approximate == robot.body.is_approximate
        assert again.body.source == robot.body.source
        np.testing.assert_array_equal(again.body.excess, robot.body.excess)
    body = Body([1], [[0, 0, 0, 0, 0, 1, 0.1]], [], source="drawn", excess=[0, 0.01])
    assert pickle.loads(pickle.dumps(body)) == body
    assert (body.source, body.excess.tolist()) == ("drawn", [0, 0.01])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: ROBOT.with_attached(Shape.box([9, 9, 9])), "shape 0 reaches .* from the flange"),
        (lambda: ROBOT.with_attached([ROD, Shape.sphere(0.1, [0, 0, 90])]), "shape 1 reaches 90"),
        (lambda: ROBOT.with_attached(Shape.half_space([0, 0, 1], [0, 0, 0])), "half space"),
        (lambda: ROBOT.with_attached(ROD, excess=1e-5), "excess is 0.00001 m, 100 capsules"),
        (lambda: ROBOT.with_attached(ROD, excess=np.nan), "excess is NaN m"),
        (lambda: ROBOT.with_body(None).with_attached(ROD), "no body"),
        (lambda: ROBOT.with_body(Body([8], [[0] * 6 + [1]], [])), "link 8"),
        (
            lambda: ROBOT.with_body(Body([6, 7], [[0] * 6 + [1]] * 2, [(6, 7)])),
            "links 6 and 7 are no pair",
        ),
        (lambda: Body([2], [[0] * 6 + [1]], [], excess=[0.1]), "excess has 1 lengths"),
        (lambda: Body([0], [[0] * 6 + [1]], [], excess=[-0.1]), "excess is -0.1 m"),
    ],
)
def test_what_cannot_be_a_body_is_named(call, words):
    with pytest.raises(irbkin.InvalidModelError, match=words):
        call()
    with pytest.raises(irbkin.InvalidPoseError):
        ROBOT.with_attached(ROD, np.zeros((4, 4)))
    with pytest.raises(TypeError):
        ROBOT.with_attached([1, 2])


def test_axes_that_are_parallel_but_for_a_calibration_give_no_approximate_body():
    rows = ROBOT.mdh.copy()
    rows[1, 2], rows[2, 2] = 400.0, -400.0
    robot = Robot.from_mdh(rows)
    with pytest.raises(irbkin.InvalidModelError, match="lengths in all"):
        robot.approximate_body()


def test_a_standing_arm_carries_its_tool_and_pairs_may_name_it():
    cell = irbkin.Cell().with_robot("left", ROBOT.with_attached(ROD), np.zeros(6))
    assert list(cell.obstacles)[-1] == "left, link 7"
    tip = ROBOT.fk(np.zeros(6)) @ [0, 0, 0.4, 1]
    ball = Shape.sphere(0.02, tip[:3])
    robot = ROBOT.with_attached(ROD)
    assert irbkin.Cell({"ball": ball}).collides(robot, np.zeros(6))
    free = irbkin.Cell({"ball": ball}, may_touch=[("ball", 7)])
    assert not free.collides(robot, np.zeros(6))


def test_more_capsules_keep_the_rods_beside_an_arm():
    robot = irbkin.Robot("IRB 2400-10/1.55")
    q = [1.204, -1.63, 1.016, -3.484, -1.694, -3.931]
    cell = irbkin.Cell({"ball": Shape.sphere(0.05, [-0.23971373, -0.75700134, 0.32978733])})
    assert cell.collides(robot, q)
    body = robot.body.with_capsules([3], [[0, 0.2, -0.1, 0, 0.2, 0.4, 0.05]])
    hose = robot.with_body(body)
    assert cell.collides(hose, q)
    assert len(hose.body.links) == len(robot.body.links) + 1
    assert cell.collides(pickle.loads(pickle.dumps(hose)), q)
    with pytest.raises(irbkin.InvalidModelError, match="radius"):
        robot.body.with_capsules([3], [[0, 0, 0, 0, 0, 0, 0]])


def test_hulls_are_given_back_as_numbers():
    body = ROBOT.body
    again = Body(body.links.tolist(), body.capsules, body.pairs, hulls=body.hulls)
    for one, other in zip(body.hulls, again.hulls, strict=True):
        np.testing.assert_array_equal(one[1], other[1])
        assert np.asarray(one[2]).shape[1] == 3
        assert one[0::2] + one[3:] == other[0::2] + other[3:]
    assert max(max(face) for _, points, faces, _ in body.hulls for face in faces) > 3
