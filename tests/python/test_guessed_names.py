"""The names that users guess: they are there, or the error says which one is."""

import inspect
import io
import math
import operator
import pickle
import re
from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import paths, rapid, ros, trajectory
from irbkin.body import Shape
from irbkin.errors import InvalidJointsError, InvalidModelError, InvalidMotionError

IRB = "IRB 2600-12/1.65"
Q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7]
ROBOT = irbkin.Robot(IRB)
T = ROBOT.fk(Q)
MOVE = trajectory.joint([0.0] * 6, Q, duration=1.5, steps=4)
# A program of one target, and one that is out of reach.
PROGRAM = """MODULE M
CONST robtarget p10:=[[900,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST robtarget p20:=[[9000,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
"""


def line():
    end = T.copy()
    end[1, 3] += 0.2
    return paths.line(T, end, steps=40)


def test_random_joints_are_inside_the_limits_and_fill_them():
    for name in (IRB, "UR5e", "Panda", "IRB 6660-205/1.9"):
        robot = irbkin.Robot(name)
        q = robot.random(4000, rng=1)
        assert q.shape == (4000, robot.dof)
        assert (robot.margin(q).limits >= 0.0).all()
        assert (np.ptp(q, axis=0) > 0.95 * np.ptp(robot.limits, axis=1)).all()
    assert irbkin.Robot("IRB 6660-205/1.9").linkage_limits is not None
    assert (ROBOT.random().shape, ROBOT.random(0).shape) == ((6,), (0, 6))
    assert not np.array_equal(ROBOT.random(), ROBOT.random())


def test_random_joints_repeat_with_their_seed():
    rng = np.random.default_rng(3)
    np.testing.assert_array_equal(ROBOT.random(5, rng=3), ROBOT.random(5, rng))
    assert not np.array_equal(ROBOT.random(5, rng), ROBOT.random(5, rng=3))


def test_random_joints_without_limits_are_within_a_turn_and_locked_ones_stay():
    limits = np.full((6, 2), [-np.inf, np.inf])
    limits[1, 0], limits[2, 1] = 1.0, 2.0
    q = ROBOT.with_limits(limits).random(4000, rng=1)
    ends = [[-math.pi, math.pi]] * 6
    ends[1], ends[2] = [1.0, 1.0 + math.tau], [2.0 - math.tau, 2.0]
    np.testing.assert_allclose(np.c_[q.min(axis=0), q.max(axis=0)], ends, atol=0.02)
    locked = irbkin.Robot("Panda").locked({3: 0.2})
    assert (locked.random(9)[:, 2] == 0.2).all()


def test_a_linkage_without_room_is_an_error():
    robot = irbkin.Robot("IRB 6660-205/1.9")
    limits = robot.limits.copy()
    limits[1:3] = [[0.0, 0.01], [0.0, 0.01]]
    with pytest.raises(InvalidModelError, match="leave the linkage no room"):
        robot.with_limits(limits).with_linkage_limits([1.0, 1.1]).random(2)


def test_joints_have_names():
    assert ROBOT.joint_names == ("J1", "J2", "J3", "J4", "J5", "J6")
    assert irbkin.Robot("Panda").joint_names[-1] == "J7"
    named = irbkin.Robot.from_urdf(ROBOT.to_urdf().replace("joint_4", "elbow"))
    named = named.with_body(ROBOT.body)
    own = ("joint_1", "joint_2", "joint_3", "elbow", "joint_5", "joint_6")
    tool = named.with_tool([0, 0, 0.1])
    for robot in (named, tool, pickle.loads(pickle.dumps(named)), named.with_limits(named.limits)):
        assert robot.joint_names == own
    motion = tool.go(np.zeros(6) + 0.1, np.zeros(6) + 0.2)
    for other in (motion, motion.resampled(5), motion.stretched(2.0), motion.slice(0.0, 0.01)):
        assert other.to_joint_trajectory()["joint_names"] == list(own)
    assert pickle.loads(pickle.dumps(motion)).to_joint_trajectory()["joint_names"] == list(own)
    assert ros.Kinematics(named).joint_names == list(own)


def test_a_robot_takes_its_tool_and_base():
    tool, base = [0.0, 0.0, 0.1], irbkin.pose([1.0, 2.0, 0.5])
    robot = irbkin.Robot(IRB, tool=tool, base=base)
    assert robot == irbkin.Robot(IRB).with_tool(tool).with_base(base)
    data = rapid.ToolData(tframe=rapid.Pose.of(robot.tool))
    assert irbkin.Robot(IRB, tool=data, base=[1.0, 2.0, 0.5]) == robot
    with pytest.raises(irbkin.InvalidPoseError, match="T must have shape"):
        irbkin.Robot(IRB, tool=[1.0, 2.0])


def test_a_solution_has_its_configuration():
    for solution in ROBOT.ik(T):
        assert solution.configuration == ROBOT.configuration(solution.q)
    robot = irbkin.Robot("UR5e")
    assert robot.ik(robot.fk(Q))[0].configuration is None


def test_the_table_of_solutions_has_margin_and_confdata():
    solutions = ROBOT.ik(T)
    _, head, *rows = str(solutions).splitlines()
    assert head.split()[-4:] == ["limits", "margin", "confdata", "singularities"]
    lower, upper = ROBOT.limits.T
    for solution, row in zip(solutions, rows, strict=True):
        room = np.minimum(solution.q - lower, upper - solution.q)
        joint = room.argmin()
        assert f"{np.degrees(room[joint]):.1f} J{joint + 1} " in row
        assert "[" + ",".join(str(number) for number in solution.configuration) + "]" in row
    free = irbkin.Robot("UR5e").with_limits(np.full((6, 2), [-np.inf, np.inf]))
    text = str(free.ik(free.fk(Q)))
    assert not re.search(r"confdata|J\d", text)


def test_a_plan_has_its_tool_poses():
    plan = ROBOT.plan(line(), rotation=12)
    np.testing.assert_array_equal(plan.T, ROBOT.fk(plan.q))
    np.testing.assert_allclose(plan.T[:, :3, 3], line()[:, :3, 3], atol=1e-9)
    assert pickle.loads(pickle.dumps(plan)) == plan
    far = line()
    far[20:, 0, 3] += 9.0
    with pytest.raises(irbkin.PathError) as caught:
        ROBOT.plan(far)
    broken = caught.value.plan
    np.testing.assert_array_equal(np.isnan(broken.T).all(axis=(1, 2)), np.isnan(broken.q[:, 0]))


def test_a_batch_shows_which_slots_are_found_and_inside():
    poses = np.stack([T, np.full((4, 4), np.nan), ROBOT.fk(np.zeros(6))])[:, None]
    batch = ROBOT.ik_batch(poses)
    assert batch.found.shape == batch.within_limits.shape == batch.status.shape == (3, 1, 8)
    assert batch.found.dtype == batch.within_limits.dtype == bool
    np.testing.assert_array_equal(batch.found, ~np.isnan(batch.q[..., 0]))
    inside = [[s.is_within_limits for s in ROBOT.ik(pose)] for pose in poses[[0, 2], 0]]
    assert batch.within_limits.sum() == np.concatenate(inside).sum()
    q, status = batch
    assert (q is batch.q, status is batch.status) == (True, True)


def test_a_called_trajectory_gives_joint_angles():
    np.testing.assert_array_equal(MOVE(0.4), MOVE.sample(0.4).q)
    assert MOVE([0.0, 0.4, 1.5]).shape == (3, 6)


@pytest.mark.parametrize(("dt", "count"), [(0.1, 16), (0.4, 5), (1.5, 2), (9.0, 2)])
def test_a_trajectory_is_resampled_by_a_time(dt, count):
    t = MOVE.resampled(dt=dt).t
    assert len(t) == count
    assert (t[0], t[-1]) == (0.0, 1.5)
    assert np.diff(t).max() <= dt * (1 + 1e-9)
    assert np.ptp(np.diff(t)) < 1e-12


def test_a_wrong_resampling_says_what_to_pass():
    with pytest.raises(TypeError, match=r"got 0\.01: pass dt=0\.01"):
        MOVE.resampled(0.01)
    with pytest.raises(TypeError, match=r"resampled takes steps, or dt \[s\]"):
        MOVE.resampled(9, dt=0.1)
    for dt in (0.0, -1.0, math.nan):
        with pytest.raises(InvalidMotionError, match=r"dt is .*, it must be positive"):
            MOVE.resampled(dt=dt)
    with pytest.raises(InvalidMotionError, match="steps must be 2 to 10000000"):
        MOVE.resampled(dt=1e-300)


def test_a_trajectory_is_written_as_csv(tmp_path):
    file = io.StringIO()
    MOVE.to_csv(file)
    MOVE.to_csv(tmp_path / "move.csv")
    assert (tmp_path / "move.csv").read_text() == file.getvalue()
    head = file.getvalue().splitlines()[0].split(",")
    assert head == list(MOVE.to_dict())
    rows = np.loadtxt(io.StringIO(file.getvalue()), delimiter=",", skiprows=1)
    np.testing.assert_array_equal(rows, np.c_[MOVE.t, MOVE.q, MOVE.dq, MOVE.ddq])


def test_a_trajectory_is_a_message_of_ros():
    message = MOVE.to_joint_trajectory()
    assert message["joint_names"] == [f"joint_{i}" for i in range(1, 7)]
    times = [point["time_from_start"] for point in message["points"]]
    assert times[2] == {"sec": 1, "nanosec": 0}
    assert times[3] == {"sec": 1, "nanosec": 500_000_000}
    fields = {"positions": MOVE.q, "velocities": MOVE.dq, "accelerations": MOVE.ddq}
    for field, rows in fields.items():
        assert [point[field] for point in message["points"]] == rows.tolist()
    assert MOVE.to_joint_trajectory(ROBOT.joint_names)["joint_names"] == list(ROBOT.joint_names)
    with pytest.raises(InvalidJointsError, match="has 1 names, the motion has 6 joints"):
        MOVE.to_joint_trajectory(["a"])


def tables():
    yield ROBOT.ik(T), 8
    yield ROBOT.ik(irbkin.pose([9.0, 0.0, 0.0])), 0
    yield ROBOT.ik_batch(np.stack([T, T])[None]), 16
    yield ROBOT.plan(line()), 40
    yield MOVE, 4
    yield rapid.calc_targets(ROBOT, rapid.parse_module(PROGRAM)), 2


@pytest.mark.parametrize(("answer", "count"), list(tables()))
def test_an_answer_is_columns_of_one_length(answer, count):
    columns = answer.to_dict()
    assert {np.shape(column) for column in columns.values()} == {(count,)}
    q = np.column_stack([columns[f"q{joint}"] for joint in range(1, 7)])
    np.testing.assert_array_equal(q, answer.q.reshape(-1, 6))
    for column in columns.values():
        assert isinstance(column, list) or column.flags.writeable
    assert all(name.isidentifier() for name in columns)


def test_columns_have_what_the_answers_have():
    solutions = ROBOT.ik(T).to_dict()
    assert {"cf1", "cf4", "cf6", "cfx"} < set(solutions)
    assert solutions["within_limits"].tolist() == [s.is_within_limits for s in ROBOT.ik(T)]
    assert set(solutions) == set(ROBOT.ik(irbkin.pose([9.0, 0.0, 0.0])).to_dict())
    batch = ROBOT.ik_batch(np.stack([T, T])).to_dict()
    assert (batch["pose"] * 8 + batch["slot"]).tolist() == [*range(16)]
    targets = rapid.calc_targets(ROBOT, rapid.parse_module(PROGRAM)).to_dict()
    assert targets["name"] == ["p10", "p20"]
    assert targets["finding"][1]
    rows = [irbkin.catalog_entry(name).to_dict() for name in irbkin.catalog()]
    assert {row["name"] for row in rows} == set(irbkin.catalog())


@pytest.mark.parametrize("name", ["limits", "tool", "base", "mdh", "max_velocity"])
def test_arrays_of_a_robot_are_read_only(name):
    with pytest.raises(ValueError, match="read-only"):
        getattr(ROBOT, name)[0] = 1.0
    assert "Read-only" in getattr(irbkin.Robot, name).__doc__


HINTS = (
    "set_tool with_tool, set_base with_base, set_limits with_limits, joint_limits limits, n dof, "
    "inverse ik, ikine ik, forward fk, fkine fk, jacob0 jacobian, qlim limits, random_q random, "
    "inverse_kinematics ik_nearest, forward_kinematics fk, SolveIK_All ik, "
    "JointsConfig configuration"
)
PAGE = (Path(__file__).parents[2] / "docs/guide/coming_from.md").read_text()


def names_of_others():
    """The first name of each code of the page's table that is another package's, and its row."""
    table = PAGE.split("\n## ")[0]
    rows = [line.strip("|").split("|") for line in table.splitlines() if line.startswith("| ")]
    for what, *others, _ in rows[1:]:
        for code in re.findall("`(.*?)`", "|".join(others)):
            name = re.sub(r"^(rtb|RDK|robot)\.", "", code)
            if not name.startswith("Robot."):
                yield what.strip(), name


@pytest.mark.parametrize(("wrong", "right"), [pair.split() for pair in HINTS.split(", ")])
def test_a_wrong_name_is_answered_with_the_right_one(wrong, right):
    assert hasattr(ROBOT, right)
    with pytest.raises(AttributeError, match=f"Robot has no attribute '{wrong}': use {right}$"):
        getattr(ROBOT, wrong)
    assert {wrong, right} & set(dir(ROBOT)) == {right}


def is_offered(name):
    """Whether irbkin has the name, or says which extra it needs for it."""
    try:
        return bool(operator.attrgetter(name)(irbkin))
    except AttributeError as error:
        return "pip install 'irbkin[" in str(error)


@pytest.mark.parametrize(("what", "code"), list(names_of_others()))
def test_the_names_of_other_packages_are_answered(what, code):
    """Of all that the page names: by the robot, or by the package."""
    if " = " in code:
        name, _ = code.split(" = ")
        with pytest.raises(AttributeError, match=f"cannot be set: use with_{name}$"):
            setattr(ROBOT, name, T)
        return
    name = re.match(r"\w+", code)[0]
    answers = []
    for place in (ROBOT, irbkin):
        try:
            getattr(place, name)
        except AttributeError as error:
            answers.append(str(error))
    assert any(f"'{name}': use " in answer for answer in answers), (what, answers)
    for answer in answers:
        for own in re.findall(r": use irbkin\.([\w.]+)", answer):
            assert is_offered(own)


def test_the_page_of_other_packages_is_read():
    assert len(list(names_of_others())) > 30


def test_a_robot_is_frozen_and_says_how_it_is_changed():
    for name in ("limits", "body"):
        with pytest.raises(AttributeError, match=f"a Robot is frozen, '{name}' .* with_{name}$"):
            setattr(ROBOT, name, None)
    with pytest.raises(AttributeError, match="'speed' cannot be set: use a name of your own"):
        ROBOT.speed = 3


@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("rpy", r"euler_zyx=\[yaw, pitch, roll\] \[rad\]"),
        ("euler", "euler_zyx"),
        ("quat", "wxyz, or xyzw as SciPy"),
        ("R", "rotation"),
        ("other", "xyz and one of wxyz"),
    ],
)
def test_a_wrong_argument_of_pose_is_answered_with_the_right_one(name, own):
    with pytest.raises(TypeError, match=f"pose has no argument '{name}': use {own}"):
        irbkin.pose([1, 2, 3], **{name: [0, 0, 1]})
    assert "others" not in str(inspect.signature(irbkin.pose))


def test_the_nearest_solution_without_a_seed_is_nearest_to_the_middle():
    limits = ROBOT.limits.copy()
    limits[1] = [-1.0, 2.0]
    limits[3], limits[4, 1] = [-7.0, 7.0], np.inf
    robot = ROBOT.with_limits(limits)
    middle = limits.mean(axis=1)
    middle[3:5] = 0.0
    for arm, seed in ((robot, middle), (irbkin.Robot("UR5e"), np.zeros(6))):
        poses = arm.fk(arm.random(50, rng=1))
        for pose in poses:
            np.testing.assert_array_equal(arm.ik_nearest(pose), arm.ik_nearest(pose, seed))
        np.testing.assert_array_equal(arm.ik_nearest(poses), arm.ik_nearest(poses, seed))
    panda = irbkin.Robot("Panda")
    pose = panda.fk(panda.random(rng=1))
    middle = panda.limits.mean(axis=1)
    np.testing.assert_array_equal(panda.ik_nearest(pose), panda.ik_nearest(pose, middle))
    # Two turns have a middle, more have none.
    for lower, turned in ((-3 * np.pi, Q[5] - math.tau), (-3 * np.pi - 1e-6, Q[5])):
        limits = ROBOT.limits.copy()
        limits[5] = [lower, np.pi]
        assert ROBOT.with_limits(limits).ik_nearest(T)[5] == pytest.approx(turned, abs=1e-9)


def test_a_shape_is_placed_by_three_numbers():
    place = [1.0, 0.0, 0.42]
    for make in (
        lambda at: Shape.box([1, 1, 0.1], at),
        lambda at: Shape.cylinder(0.1, 0.5, pose=at),
        lambda at: Shape.convex(np.vstack([np.eye(3), -np.eye(3)]), at),
        lambda at: ROBOT.with_attached(Shape.sphere(0.05, [-0.9, 0, -0.4]), at),
    ):
        assert make(place) == make(irbkin.pose(place))
    with pytest.raises(irbkin.InvalidPoseError, match=r"pose must have shape \(4, 4\), got \(2,\)"):
        Shape.box([1, 1, 0.1], [1.0, 2.0])
    with pytest.raises(irbkin.InvalidPoseError, match=r"\[1\] is NaN"):
        Shape.box([1, 1, 0.1], [1.0, np.nan, 0.0])


def test_a_work_object_is_made_of_a_pose():
    frame = irbkin.pose([0.5, 0.1, 0.2], euler_zyx=[0.3, 0.1, 0.0])
    wobj = rapid.WobjData.of(frame)
    np.testing.assert_allclose(wobj.uframe.matrix(), frame, atol=1e-12)
    assert wobj._replace(uframe=rapid.WobjData().uframe) == rapid.WobjData()


def test_a_robot_prints_its_table():
    head, words, joints, *rows = str(ROBOT).splitlines()
    assert (head, joints.split()) == (repr(ROBOT), ["J1", "J2", "J3", "J4", "J5", "J6"])
    assert words == "6 joints, spherical wrist, reach 1.65 m, payload 12 kg"
    columns = {row[:13].strip(): np.array(row[13:].split(), dtype=float) for row in rows}
    alpha, a, d, theta = ROBOT.mdh.T
    wanted = {
        "alpha [deg]": np.degrees(alpha),
        "a [mm]": 1e3 * a,
        "d [mm]": 1e3 * d,
        "theta [deg]": np.degrees(theta),
        "from [deg]": np.degrees(ROBOT.limits[:, 0]),
        "to [deg]": np.degrees(ROBOT.limits[:, 1]),
        "speed [deg/s]": np.degrees(ROBOT.max_velocity),
    }
    assert list(columns) == list(wanted)
    for name, values in wanted.items():
        np.testing.assert_allclose(columns[name], values, atol=6e-4)
    assert "-0 " not in str(ROBOT)
    assert "tool at (0.0, 0.0, 100.0) mm" in str(ROBOT.with_tool([0, 0, 0.1]))
    free = irbkin.Robot.from_mdh(ROBOT.mdh)
    assert "inf" in str(free)
    assert "speed" not in str(free)


def test_a_wrong_name_of_the_package_is_answered_with_the_right_one():
    with pytest.raises(AttributeError, match=r"no attribute 'load_urdf': use Robot\.from_urdf$"):
        irbkin.load_urdf  # noqa: B018
    with pytest.raises(AttributeError, match=r"no attribute 'robots': use catalog$"):
        irbkin.robots  # noqa: B018
    with pytest.raises(AttributeError, match=r"no attribute 'nothing'$"):
        irbkin.nothing  # noqa: B018


def test_the_help_of_the_package_is_a_screen():
    assert len(irbkin.__doc__.strip().splitlines()) <= 25
    for name in ("Robot", "catalog", "ik_nearest", "plan", "UnreachableError", "rapid"):
        assert name in irbkin.__doc__
