"""`Robot.plan`: its answers are ways that an arm can go, its refusals have reasons."""

import os
import pickle
import re

import irbkin
import numpy as np
import pytest
from irbkin.body import Shape

ROBOT = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))


def weld(poses: int, robot: irbkin.Robot = ROBOT) -> np.ndarray:
    """A circle, the torch 30 degrees off the vertical and turning with it."""
    return np.array(
        [
            irbkin.pose(
                [1.0 + 0.15 * np.cos(angle), 0.15 * np.sin(angle), 0.5],
                euler_zyx=[angle, np.pi - np.radians(30), 0],
            )
            for angle in np.linspace(0, 2 * np.pi, poses)
        ]
    )


def turned(T: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Poses, each turned about its own z axis."""
    return np.array(
        [
            pose @ irbkin.pose([0, 0, 0], euler_zyx=[a, 0, 0])
            for pose, a in zip(T, angles, strict=False)
        ]
    )


def random_path(robot: irbkin.Robot, rng: np.random.Generator, poses: int) -> np.ndarray:
    """A straight line with an even turn between two poses that the arm reaches."""
    low, high = np.clip(robot.limits, -np.pi, np.pi).T
    start = rng.uniform(low, high)
    end = start + rng.uniform(-0.6, 0.6, 6)
    return irbkin.paths.line(robot.fk(start), robot.fk(end), steps=poses)


def is_continuous(robot: irbkin.Robot, T: np.ndarray, plan: irbkin.Plan) -> bool:
    """Halve every step, on its branch, until the joints move by 0.05 rad: none may jump."""
    low, high = robot.limits.T
    for step in range(len(T) - 1):
        slots = sorted({int(slot) for slot in plan.slot[step : step + 2]})
        ends = [(T[k], plan.tool_angle[k], plan.q[k]) for k in (step, step + 1)]
        open_parts = [(*ends, 0)]
        while open_parts:
            first, last, depth = open_parts.pop()
            (pose, angle, q), (pose_last, angle_last, q_last) = first, last
            size = np.abs(q_last - q).max()
            if size < 1e-3:
                continue
            pose = irbkin.paths.line(pose, pose_last, steps=3)[1]
            angle = (angle + angle_last) / 2
            tool = pose @ irbkin.pose([0, 0, 0], euler_zyx=[np.remainder(angle, 2 * np.pi), 0, 0])
            if len(slots) == 1:
                way = robot.ik(tool).q_by_slot[slots[0]]
                way = way - 2 * np.pi * np.round((way - (q + q_last) / 2) / (2 * np.pi))
            else:
                way = robot.ik_nearest(tool, q)
            halves = max(np.abs(way - q).max(), np.abs(q_last - way).max())
            if not np.isfinite(halves) or (way < low - 1e-9).any() or (way > high + 1e-9).any():
                return False
            if size < 0.05 and halves < 0.8 * size:
                continue
            if depth == 22:
                return False
            middle = (pose, angle, way)
            open_parts += [(first, middle, depth + 1), (middle, last, depth + 1)]
    return True


@pytest.mark.parametrize("rotation", [None, 24, irbkin.ToolRotation(9, -0.4, 0.4)])
def test_a_plan_meets_every_pose_and_limit(rotation):
    T = weld(60)
    plan = ROBOT.plan(T, rotation=rotation)
    np.testing.assert_allclose(ROBOT.fk(plan.q), turned(T, plan.tool_angle), atol=1e-12)
    low, high = ROBOT.limits.T
    assert (plan.q >= low - 1e-9).all()
    assert (plan.q <= high + 1e-9).all()
    steps = np.diff(plan.q, axis=0)
    assert plan.cost == pytest.approx((steps**2).sum(), rel=1e-9)
    speed = np.abs(steps) / ROBOT.max_velocity * (len(T) - 1)
    assert plan.bottleneck == pytest.approx(speed.max(), rel=1e-9)
    assert plan.certified
    assert plan.external.shape == (len(plan.q), 0)
    assert plan.breaks == ()
    assert pickle.loads(pickle.dumps(plan)) == plan


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "UR5e"])
def test_no_plan_hides_a_jump(name):
    """`make evidence SUITE=plans` looks at 50,000 lines of each arm."""
    count = int(os.environ.get("IRBKIN_PLANS", "150"))
    robot, rng, found, gaps = irbkin.Robot(name), np.random.default_rng(5), 0, []
    hidden = []
    for number in range(count):
        T = random_path(robot, rng, 12)
        try:
            plan = robot.plan(T, rotation=12 if number % 4 == 3 else None)
        except irbkin.PathError as error:
            gaps.append(error)
            continue
        found += 1
        if not is_continuous(robot, T, plan):
            hidden.append(number)
    print(f"{name}: {count} lines, {found} plans, jumps between poses in {len(hidden)}: {hidden}")
    assert len(hidden) <= count * 4e-5
    assert found > 0.2 * count
    assert all(gap.reasons and gap.plan.breaks for gap in gaps)


def test_where_follow_finds_a_way_plan_finds_one():
    robot, rng, feasible, greedy = ROBOT, np.random.default_rng(6), 0, 0
    for _ in range(100):
        T = random_path(robot, rng, 20)
        solutions = robot.ik(T[0]).within_limits()
        strands = [not robot.follow(T, s.q).breaks for s in solutions.turns()]
        if not any(strands):
            continue
        feasible += 1
        assert robot.plan(T).breaks == ()
        greedy += not robot.follow(T, robot.ik_nearest(T[0], np.zeros(6))).breaks
    assert feasible > 20
    assert greedy <= feasible


def test_start_and_end_are_kept_with_their_turns():
    T = weld(60)
    free = ROBOT.plan(T, rotation=12)
    start = free.q[0] + [0, 0, 0, 0, 0, -2 * np.pi if free.q[0, 5] > 0 else 2 * np.pi]
    if not (ROBOT.limits[5, 0] <= start[5] <= ROBOT.limits[5, 1]):
        start = free.q[0]
    plan = ROBOT.plan(T, rotation=12, start=start)
    np.testing.assert_allclose(plan.q[0], start, atol=1e-12)
    again = ROBOT.plan(T, rotation=12, end=free.q[-1])
    np.testing.assert_allclose(again.q[-1], free.q[-1], atol=1e-12)


def test_a_closed_plan_ends_where_it_starts():
    plan = ROBOT.plan(weld(40), rotation=12, closed=True)
    np.testing.assert_allclose(plan.q[-1], plan.q[0], atol=1e-12)
    assert plan.certified


def test_times_bound_the_velocity():
    T = weld(60)
    least = ROBOT.plan(T).bottleneck
    plan = ROBOT.plan(T, times=np.linspace(0, 1.01 * least, 60))
    assert 0.98 < plan.bottleneck <= 1 + 1e-9
    with pytest.raises(irbkin.PathError, match="of its velocity limit"):
        ROBOT.plan(T, times=np.linspace(0, 0.5 * least, 60))


def test_an_axis_that_is_too_slow_is_named():
    T = seam(200, 2.5)
    track = irbkin.Track("y", -3, 3, max_velocity=0.2)
    reason = r"external axis 1 would have to move at \d+\.\d+ of its velocity limit"
    with pytest.raises(irbkin.PathError, match=reason):
        ROBOT.plan(T, carrier=track, times=np.linspace(0, 5, 200))


def test_a_pose_out_of_reach_is_named():
    T = weld(60)
    T[17, 2, 3] += 3.0
    with pytest.raises(irbkin.PathError) as caught:
        ROBOT.plan(T, rotation=12)
    error = caught.value
    assert error.index == 17
    assert all(end.pose_index <= 17 and end.reason for end in error.reasons)
    assert error.plan.breaks == (irbkin.records.PlanBreak(16, 18),)
    assert np.isnan(error.plan.q[17]).all()
    assert np.isfinite(error.plan.q[18]).all()


def test_accept_is_asked_in_blocks_and_obeyed():
    T, asked = weld(60), []
    free = ROBOT.plan(T, rotation=12)
    bound = np.median(free.tool_angle)

    def accept(q):
        asked.append(len(q))
        tool = ROBOT.fk(q)
        return tool[:, 2, 0] < np.median(ROBOT.fk(free.q)[:, 2, 0]) + 0.2

    assert np.isfinite(bound)
    plan = ROBOT.plan(T, rotation=12, accept=accept)
    assert accept(plan.q).all()
    assert len(asked) < 100

    def broken(q):
        raise RuntimeError("no scene")

    with pytest.raises(RuntimeError, match="no scene"):
        ROBOT.plan(T, accept=broken)
    with pytest.raises(ValueError, match="60 truth values"):
        ROBOT.plan(T, accept=lambda q: True)
    with pytest.raises(irbkin.PathError, match="rejected by accept;"):
        ROBOT.plan(T, accept=lambda q: np.zeros(len(q), bool))


def seats(robot, T, index):
    """A small obstacle at a pose of the tool's path."""
    return irbkin.Cell({"seat": Shape.box([0.2, 0.02, 0.2], irbkin.pose(T[index][:3, 3]))})


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "Panda"])
def test_a_path_that_a_cell_blocks_says_who_touches_whom_and_where(name):
    robot = irbkin.Robot(name)
    size = 0.9 if robot.dof == 6 else 0.5
    A, B = (irbkin.pose([size, y, 0.6], euler_zyx=[0, 2.8, 0]) for y in (-0.3, 0.3))
    T = irbkin.paths.line(A, B, steps=61)
    cell = seats(robot, T, 40)
    with pytest.raises(irbkin.PathError) as refused:
        robot.plan(T, cell=cell)
    assert "accept" not in str(refused.value)
    colliding = [end for end in refused.value.reasons if " and " in end.reason]
    assert colliding
    assert f"slot {colliding[0].slot} at pose {colliding[0].pose_index}: " in str(refused.value)
    for end in colliding:
        words = r"link \d and (seat|link \d)(, on the way from the pose before)?"
        assert re.fullmatch(words, end.reason)
    # The caller's own test and the cell's are told apart.
    with pytest.raises(irbkin.PathError) as refused:
        robot.plan(T, cell=irbkin.Cell(), accept=lambda q: np.zeros(len(q), bool))
    assert {end.reason for end in refused.value.reasons} >= {"rejected by accept"}
    assert " and seat" not in str(refused.value)


def test_of_a_motion_between_poses_too():
    # A thin wall between two poses, which the arm passes in one step.
    A, B = (irbkin.pose([0.9, y, 0.7], euler_zyx=[0, 2.8, 0]) for y in (-0.4, 0.4))
    wall = irbkin.Cell({"wall": Shape.box([1.0, 1e-3, 3.0], irbkin.pose([1.2, 0.0, 0.7]))})
    with pytest.raises(irbkin.PathError, match=r"link \d and wall, on the way from the pose bef"):
        ROBOT.plan(np.array([A, B]), cell=wall)


def test_bad_input_is_refused_with_its_place():
    T = weld(6)
    bad = T.copy()
    bad[3, 0, 0] = np.nan
    refused = [
        ({"T": bad}, irbkin.InvalidPoseError, r"T\[3\]"),
        ({"T": T[:0]}, irbkin.InvalidMotionError, "0 poses"),
        ({"T": T[None]}, irbkin.InvalidPoseError, r"\(m, 4, 4\)"),
        ({"T": T, "times": [0, 1, 1, 2, 3, 4]}, irbkin.InvalidMotionError, r"times\[2\]"),
        ({"T": T, "rotation": 0}, irbkin.InvalidMotionError, "2 to 3600"),
        (
            {"T": T, "rotation": irbkin.ToolRotation(36, -180, 180)},
            irbkin.InvalidMotionError,
            "degrees",
        ),
        ({"T": T, "rotation": "z"}, TypeError, "ToolRotation"),
        ({"T": T, "start": np.zeros(6)}, irbkin.InvalidJointsError, "start"),
        ({"T": T[:3], "closed": True}, irbkin.InvalidMotionError, "closed"),
        ({"T": T, "weights": [-1, 1, 1, 1, 1, 1]}, irbkin.InvalidJointsError, "weight"),
    ]
    for arguments, error, message in refused:
        with pytest.raises(error, match=message):
            ROBOT.plan(**arguments)
    with pytest.raises(TypeError, match="redundancy is for arms of seven joints"):
        ROBOT.plan(T, redundancy=36)
    assert ROBOT.plan(T[:1]).q.shape == (1, 6)


def seam(poses: int, length: float) -> np.ndarray:
    ends = [irbkin.pose([1.1, y, 0.6], euler_zyx=[0, 2.7, 0]) for y in (-length, length)]
    return irbkin.paths.line(*ends, steps=poses)


@pytest.mark.parametrize("rotation", [None, 12])
def test_a_track_carries_the_robot_along_a_seam(rotation):
    T, track = seam(200, 2.5), irbkin.Track("y", -3, 3)
    with pytest.raises(irbkin.PathError):
        ROBOT.plan(T, rotation=rotation)
    plan = ROBOT.plan(T, rotation=rotation, carrier=track)
    assert plan.external.shape == (200, 1)
    for q, x, pose in zip(plan.q, plan.external[:, 0], turned(T, plan.tool_angle), strict=True):
        placed = ROBOT.with_base(irbkin.pose([0, x, 0]))
        np.testing.assert_allclose(placed.fk(q), pose, atol=1e-9)
    # The seam is 5 m long; a track that follows it all along would be as fast.
    speed = np.abs(np.diff(plan.external[:, 0])).max() * 199
    assert speed <= 5.0
    # One in coordinates of its own is the same.
    same = ROBOT.plan(T, rotation=rotation, carrier=[irbkin.Track([0, 7, 0], -3, 3)])
    np.testing.assert_array_equal(same.q, plan.q)


def test_a_positioner_turns_the_object():
    point = np.array([1.1, 0.0, 0.4])
    T = np.array(
        [
            irbkin.pose(
                point + np.array([0.3 * np.cos(a), 0.3 * np.sin(a), 0.2]),
                euler_zyx=[a, np.radians(135), 0],
            )
            for a in np.linspace(0, 2 * np.pi, 120)
        ]
    )
    wide = irbkin.Positioner(point, "z", -2 * np.pi, 2 * np.pi, 73, max_velocity=20)
    plan = ROBOT.plan(T, carrier=wide)
    for q, angle, pose in zip(plan.q, plan.external[:, 0], T, strict=True):
        turn = irbkin.pose(point) @ irbkin.pose([0, 0, 0], euler_zyx=[angle, 0, 0])
        turn = turn @ irbkin.pose(-point)
        np.testing.assert_allclose(ROBOT.fk(q), turn @ pose, atol=1e-9)
    # Turned against the path, the arm stays nearly where it is.
    assert np.ptp(plan.external[:, 0]) > np.pi
    assert plan.bottleneck < 0.7 * ROBOT.plan(T).bottleneck


def test_a_tolerance_tilts_the_tool():
    T = weld(100)
    plan = ROBOT.plan(T, tolerance=irbkin.ToolCone(0.2))
    assert plan.tolerance.shape == (100, 2)
    tilt = np.hypot(*plan.tolerance.T)
    assert tilt.max() <= 0.2 + 1e-9
    assert tilt.max() > 0.05
    tool = ROBOT.fk(plan.q)
    np.testing.assert_allclose(tool[:, :3, 3], T[:, :3, 3], atol=1e-9)
    angles = np.arccos(np.clip(np.einsum("mi,mi->m", tool[:, :3, 2], T[:, :3, 2]), -1, 1))
    np.testing.assert_allclose(angles, tilt, atol=1e-6)
    assert plan.bottleneck < ROBOT.plan(T).bottleneck


@pytest.mark.parametrize("rotation", [36, 360, irbkin.ToolRotation(181, -1.5, 1.5)])
def test_a_given_end_stays_on_long_paths(rotation):
    T = weld(300)
    first = ROBOT.ik_nearest(turned(T[:1], np.array([0.123]))[0], np.zeros(6))
    plan = ROBOT.plan(T, rotation=rotation, start=first)
    np.testing.assert_allclose(plan.q[0], first, atol=1e-12)
    np.testing.assert_allclose(plan.tool_angle[0], 0.123, atol=1e-9)


def test_ramps_are_better_than_steps_of_the_grid():
    T = weld(1000)
    plan = ROBOT.plan(T, rotation=36)
    # Best way of the exact search over as many angles as ramps are refined to.
    assert plan.bottleneck < 0.95
    assert is_continuous(ROBOT, T, plan)


def test_a_gap_is_seen_from_both_ends():
    T = seam(81, 0.4)
    T[30:50, 2, 3] += 3.0
    with pytest.raises(irbkin.PathError) as caught:
        ROBOT.plan(T)
    assert (caught.value.index, caught.value.end_index) == (30, 49)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"carrier": 3}, TypeError, "irbkin.Track"),
        ({"carrier": [irbkin.Track("y", 0, 1), None]}, TypeError, "irbkin.Track"),
        ({"carrier": irbkin.Track("w", 0, 1)}, ValueError, '"x", "y" or "z"'),
        ({"carrier": irbkin.Track("y", 1, 0)}, irbkin.InvalidMotionError, "from 1 to 0"),
        ({"carrier": irbkin.Track("y", 0, 1, 1)}, irbkin.InvalidMotionError, "2 to 1001"),
        ({"carrier": irbkin.Track("y", 0, 1, 2.5)}, TypeError, "steps of Track"),
        ({"carrier": irbkin.Track("y", 0, 1, 5, 0)}, irbkin.InvalidMotionError, "max_velocity"),
        ({"carrier": [irbkin.Track("y", 0, 1)] * 4}, irbkin.InvalidMotionError, "at most 3"),
        ({"carrier": irbkin.Positioner([0, 0, 0], [0, 0, 0])}, irbkin.InvalidMotionError, "length"),
        ({"tolerance": irbkin.ToolCone(15)}, irbkin.InvalidMotionError, "degrees"),
        ({"tolerance": irbkin.ToolCone(0.1, 4)}, irbkin.InvalidMotionError, "odd"),
        ({"tolerance": [irbkin.ToolCone(0.1)]}, TypeError, "must be an irbkin.ToolCone, got"),
        (
            {"carrier": irbkin.Track("y", 0, 1), "start": np.zeros(6)},
            irbkin.InvalidJointsError,
            r"\(7,\)",
        ),
    ],
)
def test_carriers_and_tolerances_that_make_no_sense_are_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        ROBOT.plan(weld(6), **arguments)


def test_a_plan_is_shown_in_a_line_and_a_line_for_each_break():
    T = weld(40)
    plan = ROBOT.plan(T, rotation=8)
    assert repr(plan) == str(plan)
    assert repr(plan).startswith("<Plan: 40 poses, 6 joints, certified, bottleneck ")
    assert repr(plan).endswith(f"{plan.bottleneck:.4g}, cost {plan.cost:.4g} rad^2, no break>")
    T[7, 0, 3] += 9.0
    with pytest.raises(irbkin.PathError) as broken:
        ROBOT.plan(T)
    shown = repr(broken.value.plan)
    assert shown.endswith(" rad^2, 1 break\nbetween poses 6 and 8>")
    assert len(shown.splitlines()) == 2


def test_seven_joints_are_planned_with_their_redundancy():
    panda = irbkin.Robot("Panda")
    start = np.array([0.1, -0.6, 0.2, -2.2, 0.1, 1.7, 0.6])
    T = panda.fk(start + np.linspace(0, 1, 9)[:, None] * [0.3, 0.1, -0.2, 0.1, 0.2, -0.1, 0.1])
    followed = panda.follow(T, start).q
    plan = panda.plan(T, start=start, order="sum", redundancy=24)
    assert plan.q.shape == (9, 7)
    assert plan.external.shape == (9, 0)
    assert plan.certified
    assert np.abs(panda.fk(plan.q) - T).max() < 1e-11
    assert plan.cost <= (np.diff(followed, axis=0) ** 2).sum() * (1 + 1e-6)
    # With a free tool angle, a track, and a test of all seven joints.
    seen = []
    track = irbkin.Track("y", -0.2, 0.2, steps=3)
    free = panda.plan(
        T,
        rotation=6,
        carrier=track,
        redundancy=8,
        accept=lambda q: seen.append(q.shape[1]) or np.ones(len(q), bool),
    )
    assert set(seen) == {7}
    assert free.external.shape == (9, 1)
    shifted = panda.fk(free.q)
    shifted[:, 1, 3] += free.external[:, 0]
    assert np.abs(shifted[:, :3, 3] - T[:, :3, 3]).max() < 1e-11
    # One joint locked leaves six.
    locked = panda.locked({3: 0.2}).plan(T[:1])
    assert locked.q.shape == (1, 7)
    assert locked.q[0, 2] == 0.2
    timed = panda.plan(T[:3], start=start, objective="time", max_acceleration=[5.0] * 7)
    assert timed.q.shape == (3, 7)
    with pytest.raises(irbkin.InvalidMotionError, match="redundancy"):
        panda.plan(T, redundancy=1)


@pytest.mark.parametrize(
    "turns",
    [(-242, 242), (-65, 2), (-70, 70), (0, 255), (-1000, 2), (-15900, 15900)],
    ids=lambda turns: f"{turns[0]}..{turns[1]}",
)
@pytest.mark.parametrize("joints", [[5], [3, 5]])
@pytest.mark.parametrize("name", ["IRB 120-3/0.58", "UR5e", "GoFa 5"])
def test_limits_may_be_any_number_of_turns_apart(name, joints, turns):
    robot = irbkin.Robot(name)
    limits = robot.limits.copy()
    limits[joints] = 2 * np.pi * np.array(turns)
    robot = robot.with_limits(limits)
    start = np.array([0.3, 0.4, 0.2, 0.5, 0.7, 0.4])
    end = start + 0.1
    line = irbkin.paths.line(robot.fk(start), robot.fk(end), steps=12)
    for ends in ({}, {"start": start}, {"start": start, "end": end}):
        plan = robot.plan(line, **ends)
        assert not plan.breaks
        assert ((plan.q >= limits[:, 0]) & (plan.q <= limits[:, 1])).all()
        for row, given in ((0, ends.get("start")), (-1, ends.get("end"))):
            if given is not None:
                np.testing.assert_allclose(plan.q[row], given, atol=1e-9)
    plan = robot.plan(line, start=start, limit_cost=1.0)
    np.testing.assert_allclose(plan.q[0], start, atol=1e-9)
    if name != "GoFa 5":
        # A whole turn of the tool, whose turns have to be counted.
        end = start.copy()
        end[5] += 2 * np.pi
        around = irbkin.ToolRotation(12)
        plan = robot.plan(line[:1].repeat(40, 0), rotation=around, start=start, end=end)
        np.testing.assert_allclose(plan.q[-1], end, atol=1e-9)
        assert abs(np.diff(plan.q, axis=0)).max() < 1.0


def test_right_joints_are_a_start_with_a_cone():
    # A tool whose orientation is met to a rounding: nothing of the rotation between may be NaN.
    robot, refused = irbkin.Robot("IRB 2600-12/1.65"), []
    rng = np.random.default_rng(0)
    for _ in range(300):
        turn = np.radians(rng.uniform(-180, 180, 3))
        seam = np.array([irbkin.pose([0.96, y, 1], euler_zyx=turn) for y in (0.1, 0.11)])
        for start in robot.ik(seam[0]).within_limits().q:
            try:
                robot.plan(seam, start=start, tolerance=irbkin.ToolCone(0.1))
            except irbkin.PathError:
                pass
            except irbkin.InvalidMotionError as error:
                refused.append(str(error))
    assert refused == []


@pytest.mark.parametrize("name", ["IRB 120-3/0.58", "UR5e"])
@pytest.mark.parametrize(
    "limits", [(-242 * 2 * np.pi, 242 * 2 * np.pi), (-403, 10), (-1e5, 1e5), (-1e5, 3)]
)
def test_wide_limits_of_a_joint_hide_no_path(name, limits):
    q = np.array([0.3, 0.4, 0.2, 0.5, 0.7, -0.4])
    for joint in range(6):
        robot = irbkin.Robot(name)
        wide = robot.limits.copy()
        wide[joint] = limits
        robot = robot.with_limits(wide)
        T = robot.fk(q + np.linspace(0, 0.1, 12)[:, None])
        assert not robot.follow(T, q).breaks
        for options in ({}, {"rotation": 12}, {"limit_cost": 1.0}):
            plan = robot.plan(T, start=q, **options)
            assert plan.certified
            # Turns of 1e5 rad are taken off.
            np.testing.assert_allclose(plan.q[0], q, rtol=0, atol=3e-11)
