"""A plan as RAPID: its targets and its module give the joints of the plan again."""

import re

import irbkin
import numpy as np
import pytest
from irbkin import rapid

ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
TORCH = rapid.ToolData(tframe=rapid.Pose.of(irbkin.pose([0.05, 0, 0.35])))
TABLE = rapid.WobjData(
    uframe=rapid.Pose.of(irbkin.pose([0.5, 0.1, 0.2], euler_zyx=[0.3, 0, 0])),
    oframe=rapid.Pose.of(irbkin.pose([0, 0, 0.1])),
)
BOUND = np.radians(0.01)


def seam(poses: int = 41) -> np.ndarray:
    ends = [irbkin.pose([0.9, y, 0.7], euler_zyx=[0.0, 2.8, 0]) for y in (-0.3, 0.3)]
    return irbkin.paths.line(*ends, steps=poses)


PLAN = ROBOT.plan(seam(), rotation=36)


@pytest.mark.parametrize("wobj", [None, TABLE])
@pytest.mark.parametrize("tool", [None, TORCH])
def test_each_target_has_the_joints_of_the_plan(tool, wobj):
    targets = rapid.plan_targets(ROBOT, PLAN, tool, wobj)
    text = rapid.dump({f"p{index}": target for index, target in enumerate(targets)})
    read = rapid.parse(text)
    for index, q in enumerate(PLAN.q):
        again = rapid.calc_joint_t(ROBOT, read[f"p{index}"], tool, wobj)
        np.testing.assert_allclose(again.q, q, atol=BOUND)
        assert again.extax == (rapid.NOT_THERE,) * 6


def test_a_target_is_the_pose_with_the_tool_angle_that_was_found():
    T = seam()
    for target, pose, angle in zip(
        rapid.plan_targets(ROBOT, PLAN), T, PLAN.tool_angle, strict=True
    ):
        turned = pose @ irbkin.pose([0, 0, 0], euler_zyx=[angle, 0, 0])
        np.testing.assert_allclose(target.matrix(), turned, atol=1e-9)
    assert np.ptp(PLAN.tool_angle) > 0.01


def test_turns_of_j6_come_back():
    start = PLAN.q[0] + [0, 0, 0, 0, 0, 2 * np.pi * (1 if PLAN.q[0, 5] < 0 else -1)]
    plan = ROBOT.plan(seam(), rotation=36, start=start)
    assert abs(plan.q[0, 5]) > np.pi
    for target, q in zip(rapid.plan_targets(ROBOT, plan), plan.q, strict=True):
        np.testing.assert_allclose(rapid.calc_joint_t(ROBOT, target).q, q, atol=BOUND)


def test_a_coupled_arm_has_its_confdata():
    robot = irbkin.Robot("IRB 2400-16/1.55")
    assert robot.is_coupled
    plan = robot.plan(seam(), rotation=12)
    table = rapid.calc_moves(robot, rapid.plan_module(robot, plan))
    np.testing.assert_allclose(table.q, plan.q, atol=BOUND)


def test_a_module_moves_along_the_plan():
    module = rapid.plan_module(ROBOT, PLAN, "Seam", wobj=TABLE, speed="v20", zone="z0")
    read = rapid.parse(rapid.dump(module))
    assert read.name == "Seam"
    assert [move.kind for move in read.moves] == ["MoveJ", *["MoveL"] * (len(PLAN.q) - 1)]
    assert [move.zone for move in read.moves] == ["fine", *["z0"] * (len(PLAN.q) - 2), "fine"]
    table = rapid.calc_moves(ROBOT, read)
    assert set(table.findings) == {None}
    np.testing.assert_allclose(table.q, PLAN.q, atol=BOUND)
    motion = rapid.motion(ROBOT, read)
    assert motion.findings == ()
    assert motion.duration == pytest.approx(0.6 / 0.020, rel=1e-3)


def test_numbers_of_a_module_have_the_digits_of_a_controller():
    text = rapid.dump(rapid.plan_module(ROBOT, PLAN, wobj=TABLE))
    targets = re.findall(r"robtarget p\d+:=\[\[(.*?)\],\[(.*?)\]", text)
    assert len(targets) == len(PLAN.q)
    for numbers in targets:
        for part, decimals in zip(numbers, (3, 7), strict=True):
            assert all(float(it) == round(float(it), decimals) for it in part.split(","))
    target = rapid.RobTarget.of(irbkin.pose([1.12, 1e-16, 0.66], [0.5, 0.5, 0.5, 0.5]), [0] * 4)
    assert rapid.dump(target).startswith("[[1120,0,660],[0.5,0.5,0.5,0.5]")


def test_data_are_speeds_and_zones_too():
    module = rapid.plan_module(
        ROBOT, PLAN, speed=rapid.SpeedData(12.5), zone=rapid.ZoneData(False, 0.5)
    )
    assert module.moves[3].speed_data.value == rapid.SpeedData(12.5)
    assert module.moves[3].zone_data.value == rapid.ZoneData(False, 0.5)
    assert module.moves[0].tool.value == TORCH
    assert module.moves[0].wobj is None


def test_one_pose_is_one_move():
    module = rapid.plan_module(ROBOT, ROBOT.plan(seam()[:1]))
    assert [(move.kind, move.zone) for move in module.moves] == [("MoveJ", "fine")]


def test_external_axes_are_those_of_the_caller():
    track = np.linspace(0, 400, len(PLAN.q))[:, None]
    targets = rapid.plan_targets(ROBOT, PLAN, extax=track)
    assert [target.extax[0] for target in targets] == track[:, 0].tolist()
    assert targets[0].extax[1:] == (rapid.NOT_THERE,) * 5
    moved = irbkin.Plan(*PLAN[:3], track / 1e3, *PLAN[4:])
    with pytest.raises(irbkin.RapidError, match=r"plan.external has 1 axes in rad or m"):
        rapid.plan_targets(ROBOT, moved)
    assert rapid.plan_targets(ROBOT, moved, extax=track) == targets
    for wrong in (track[:-1], np.zeros((len(PLAN.q), 7)), track[:, 0]):
        with pytest.raises(irbkin.RapidError, match="extax must have shape"):
            rapid.plan_targets(ROBOT, moved, extax=wrong)


def test_what_is_no_plan_of_this_arm_is_refused():
    T = seam()
    T[7, 2, 3] += 3.0
    with pytest.raises(irbkin.PathError) as caught:
        ROBOT.plan(T)
    with pytest.raises(irbkin.RapidError, match=r"plan.q\[7\] has no joint angles"):
        rapid.plan_targets(ROBOT, caught.value.plan)
    robot = irbkin.Robot("UR5e")
    line = irbkin.paths.line(
        robot.fk([0.1, -1.2, 1.4, -1, -1.5, 0]), robot.fk([0.3, -1.2, 1.4, -1, -1.5, 0]), steps=5
    )
    with pytest.raises(irbkin.InvalidModelError):
        rapid.plan_targets(robot, robot.plan(line))
    for arguments, words in [
        ({"speed": "v17"}, "v17 is no speed or zone of RAPID's own"),
        ({"zone": "z1;"}, "MoveL"),
        ({"name": "1a"}, "1a"),
        ({"speed": "v100, v100"}, "arguments"),
    ]:
        with pytest.raises(irbkin.RapidError, match=words):
            rapid.plan_module(ROBOT, PLAN, **arguments)


def test_a_carrier_fills_the_external_axes():
    ends = [irbkin.pose([1.1, y, 0.6], euler_zyx=[0, 2.7, 0]) for y in (-2.0, 2.0)]
    T = irbkin.paths.line(*ends, steps=30)
    carrier = [
        irbkin.Track([0, 2, 0], -2, 2, 9),
        irbkin.Positioner([1.1, 0, 0.4], "z", -0.5, 0.5, 5),
        irbkin.Positioner([1.1, 0, 0.4], "x", -0.2, 0.2, 3),
    ]
    plan = ROBOT.plan(T, carrier=carrier)
    targets = rapid.plan_targets(ROBOT, plan, carrier=carrier)
    for target, pose, values in zip(targets, T, plan.external, strict=True):
        np.testing.assert_allclose(target.matrix(), pose, atol=1e-9)
        track, *turns = target.extax[:3]
        assert track == pytest.approx(1e3 * values[0])
        assert turns == pytest.approx(np.degrees(values[1:]))
    with pytest.raises(irbkin.RapidError, match="carrier has 1 axes"):
        rapid.plan_targets(ROBOT, plan, carrier=carrier[0])


def test_quaternions_go_on_without_a_change_of_sign():
    # A tool that points down: w is nearly 0, and its sign is a rounding's.
    down = [irbkin.pose([0.9, y, 0.7], euler_zyx=[0, np.pi, 0.1 * y]) for y in (-0.3, 0.3)]
    path = irbkin.paths.line(*down, steps=80)
    robot = irbkin.Robot("IRB 2600-12/1.65")
    plan = robot.plan(path, rotation=36)
    module = rapid.plan_module(robot, plan)
    targets = [module[f"p{number}"] for number in range(1, 81)]
    rot = np.array([target.rot for target in targets])
    assert (np.einsum("ij,ij->i", rot[1:], rot[:-1]) > 0).all()
    np.testing.assert_allclose(rapid.calc_moves(robot, module).q, plan.q, atol=1e-4)


def test_a_motion_is_a_module_of_joint_targets():
    torch = irbkin.body.Shape.cylinder(0.04, 0.3, irbkin.pose([0, 0, 0.15]))
    wall = irbkin.Cell(
        {"wall": irbkin.body.Shape.box([0.6, 0.05, 1.6], irbkin.pose([1.1, 0, 0.8]))}
    )
    robot = ROBOT.with_attached(torch)
    way = robot.go([-0.6, 0.3, 0.2, 0, 0.6, 0], [0.6, 0.3, 0.2, 0, 0.6, 0], wall)
    read = rapid.parse(rapid.dump(rapid.plan_module(robot, way)))
    assert {move.kind for move in read.moves} == {"MoveAbsJ"}
    assert [move.zone for move in read.moves] == ["fine", *["z1"] * (len(way.q) - 2), "fine"]
    motion = rapid.motion(robot, read)
    np.testing.assert_allclose([move.q for move in motion.moves], way.q, atol=1e-8)
    assert not rapid.check(robot, read, cell=wall, codes=["K901"])
    assert wall.check_path(robot, way.q[[0, -1]]) is not None
    tracked = rapid.plan_module(robot, way, extax=np.zeros((len(way.q), 1)))
    assert tracked.moves[3].target.value.extax[0] == 0.0
    with pytest.raises(irbkin.RapidError, match=r"extax must have shape \(100, k\)"):
        rapid.plan_module(robot, way, extax=np.zeros((3, 1)))


def test_a_plan_that_a_controller_would_not_repeat_is_refused():
    """Few poses, few rotations: between two targets the tool turns otherwise than in the plan."""
    robot, rng = irbkin.Robot("IRB 120-3/0.58"), np.random.default_rng(1)
    lower, upper = np.transpose(robot.limits) * 0.8
    refused = written = 0
    for _ in range(900):
        first = robot.fk(rng.uniform(lower, upper))
        last = (
            irbkin.pose(first[:3, 3] + rng.uniform(-0.4, 0.4, 3))
            @ irbkin.pose(-first[:3, 3])
            @ first
        )
        path = irbkin.paths.line(first, last, steps=int(rng.integers(3, 7)))
        try:
            plan = robot.plan(path, rotation=int(rng.integers(3, 9)))
            module = rapid.plan_module(robot, plan)
        except irbkin.PathError:
            continue
        except irbkin.RapidError as error:
            refused += "a controller would not move as planned: MoveL p" in str(error)
            continue
        written += 1
        found = rapid.check(robot, module)
        assert not [it for it in found if it.severity == "error" and it.code[0] in "CR"]
    assert refused >= 1
    assert written >= 50
