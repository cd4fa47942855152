"""A call that is refused: the class of the error, and its words: the field, the value, the bound
and the likely slip. Beside it, what is legitimate and stays accepted.
"""

import inspect
import json

import irbkin
import numpy as np
import pytest
from arms import ABB, IRB2400
from general_arms import TABLES
from irbkin import (
    InvalidJointsError,
    InvalidModelError,
    InvalidPoseError,
    IrbkinError,
    RapidError,
    Robot,
    UnknownRobotError,
    UnreachableError,
    rapid,
)
from irbkin.scene._solved import Joints

ROBOT = Robot("IRB 2600-12/1.65")
PANDA = Robot("Panda")
Q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
T = ROBOT.fk(Q)


def put(array, place, value):
    """A copy with one element replaced."""
    array = np.array(array, dtype=float)
    array[place] = value
    return array


def sheared(by):
    """The pose with two columns `by` from a right angle, as a cosine."""
    return T @ put(np.eye(4), (0, 1), by)


def opw(**changed):
    return Robot.from_opw(**(IRB2400 | changed))


def millimeters(rows):
    return rows * [1, 1000, 1000, 1]


def limits(joint, pair):
    """Limits of six joints, one of them another."""
    return put([[-1.0, 2.0]] * 6, joint, pair)


NAMES = {
    "irbkin": irbkin,
    "np": np,
    "nan": np.nan,
    "inf": np.inf,
    "rapid": rapid,
    "Robot": Robot,
    "robot": ROBOT,
    "panda": PANDA,
    "yumi": Robot("IRB 14050"),
    "T": T,
    "q": Q,
    "many": np.array([T] * 5),
    "rows": ABB[ROBOT.name].rows,
    "put": put,
    "sheared": sheared,
    "opw": opw,
    "millimeters": millimeters,
    "limits": limits,
    "tight": ROBOT.with_limits([[-0.1, 0.1]] * 6),
    "target": rapid.parse("[[1018.6,0,1417.5],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"),
    "tool": rapid.parse("[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]"),
    "wobj": rapid.parse('[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]'),
    "joints": rapid.parse("[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"),
}
POSES = [
    ("robot.ik(put(T, (0, 1), nan))", "pose[0, 1] is NaN: every element must be finite"),
    ("robot.ik(put(T, (2, 3), -inf))", "pose[2, 3] is -inf: every element must be finite"),
    ("robot.ik(put(T, (2, 3), -1.1e6))", "pose[2, 3] is -1.1e6 m, its size must be at most 1e6 m"),
    ("robot.ik(put(T, (3, 0), 0.5))", "pose row 3 must be [0, 0, 0, 1], got [0.5, 0, 0, 1]"),
    ("robot.ik(put(T, (3, 2), 2e-9))", "got [0, 0, 0.000000002, 1]"),
    ("robot.ik(T.T)", ", and column 3 is [0, 0, 0, 1] (is it transposed?)"),
    ("robot.ik(T @ np.diag([1, 1, -1, 1]))", "mirrors: its determinant is -1.000000, it must be 1"),
    ("robot.ik(T @ np.diag([2, 2, 2, 1]))", "off orthonormal by 3.000e0, more than the 1e-5"),
    ("robot.ik(sheared(1.1e-5))", "off orthonormal by 1.100e-5, more than the 1e-5"),
    ("robot.ik(np.diag([0.0, 0, 0, 1]))", "off orthonormal by 1.000e0"),
    ("robot.ik(many)", "T must have shape (4, 4), got (5, 4, 4) (for many poses take ik_batch)"),
    ("robot.ik(np.zeros(16))", "T must have shape (4, 4), got (16,)"),
    ("robot.ik_batch(np.zeros((5, 16)))", "T must have shape (..., 4, 4), got (5, 16)"),
    ("robot.with_tool(many)", "got (5, 4, 4): with_tool takes a single pose, call it for each"),
    ("robot.with_tool(irbkin.pose([0, 0, 110]))", "is 110.0 m from the flange, it must be at most "
     "12.0 m, ten times the size of the arm (is the tool in millimeters? meters are wanted)"),
    ("robot.with_tool([0, 0, 20])", "is 20.0 m from the flange, it must be at most 12.0 m"),
    ("robot.with_tool([0, nan, 0])", "xyz[1] is NaN: every element must be finite"),
    ("robot.follow(T, q)", "T must have shape (..., m, 4, 4), got (4, 4)"),
    ("irbkin.pose([0, 0, 2e6])", "xyz[2] is 2e6 m, its size must be at most 1e6 m"),
    ("irbkin.pose([0, nan, 0])", "xyz[1] is NaN: every element must be finite"),
    ("irbkin.pose([0] * 3, [1, 0, inf, 0])", "wxyz[2] is inf: every element must be finite"),
    ("irbkin.pose([0] * 3, [1.0021, 0, 0, 0])", "quaternion norm is 1.002100, it must be 1 within "
     "2e-3 (order is w, x, y, z)"),
    ("irbkin.pose([0] * 3, xyzw=np.zeros(3))", "xyzw must have shape (..., 4), got (3,)"),
    ("irbkin.pose([0] * 3, euler_zyx=[90, 0, 0])", "euler_zyx[0] is 90 rad, its size must be at "
     "most 6.2833 rad (did you pass degrees?)"),
]  # fmt: skip
JOINTS = [
    ("robot.fk(np.zeros((2, 5)))", "q must have shape (..., 6), got (2, 5)"),
    ("robot.fk(np.degrees([q, 2 * q, 0 * q]))", "row 0 of q: joint 5 is -34.38 rad, far outside "
     "its limits -2.09 to 2.09 rad (did you pass degrees? otherwise remove whole turns)"),
    ("robot.ik_nearest(many, np.degrees(2 * q))", "row 0 of seed: joint 1 is 34.38 rad, far"),
    ("irbkin.trajectory.retime(np.degrees([0 * q, 2 * q]), 1, 1)", "row 1 of q: joint 1 is 34.38 "
     "rad, beyond 25.13 rad as most joints are (did you pass degrees?)"),
    ("irbkin.trajectory.joint(q, np.degrees(2 * q))", "q1: joint 1 is 34.38 rad, beyond 25.13"),
    ("panda.fk(q)", "q must have shape (..., 7), got (6,)"),
    ("robot.fk([[1, 2], [3]])", "q must be an array of numbers"),
    ("robot.jacobian(put(q, 2, -inf))", "q: joint 3 is -inf, every angle must be finite [rad]"),
    ("robot.ik_nearest(T, put(q, 1, nan))", "seed: joint 2 is NaN, every angle must be finite"),
    ("robot.ik_nearest(T, put(q, 3, -1e15))", "seed: joint 4 is -1e15 rad, its size must be at "
     "most 1e5 rad (remove whole turns)"),
    ("robot.ik_nearest(T, q, weights=[1, 1, 1, 1, 1, -2])", "weights: joint 6 is -2, a weight must "
     "be finite and not negative"),
    ("robot.ik_nearest(T, q, weights=np.ones((1, 6)))", "weights must have shape (6,), got (1, 6)"),
    ("robot.ik_nearest(many, np.zeros((3, 6)))", "seed of shape (3, 6) cannot be broadcast with T "
     "of shape (5, 4, 4): leading dimensions must be equal, or 1, or left out"),
    ("robot.ik(T).nearest(put(q, 3, 1e6))", "seed: joint 4 is 1e6 rad, its size must be at most"),
    ("robot.ik(T).least_motion(q, weights=[-1] * 6)", "weights: joint 1 is -1"),
    ("robot.configuration(put(q, 3, 1e6))", "q: joint 4 is 1e6 rad, its size must be at most"),
    ("robot.ik_configured(T, [0, 0, 0])", "configuration must have shape (..., 4), got (3,)"),
    ("robot.ik_configured(T, [0, 0.5, 0, 0])", "cf4 is 0.5, it must be a whole number of at most "
     "2147483647"),
    ("robot.ik_configured(T, [0, 0, 0, 9])", "configuration: cfx is 9, it must be 0 to 7"),
    ("yumi.ik_configured(yumi.fk([0.1] * 7), [0] * 4)", "arm_angle is missing"),
    ("yumi.ik_configured(T, [0] * 4, arm_angle=1e9)", "arm_angle is 1000000000 rad, it must be "
     "finite and at most 1e5 rad in size"),
    ("panda.ik(T, nan)", "q7: joint 7 is NaN"),
    ("panda.ik(T, 1e15)", "q7: joint 7 is 1e15 rad, its size must be at most 1e5 rad"),
    ("panda.ik_batch(many, np.zeros(3))", "q7 of shape (3,) cannot be broadcast with T"),
    ("panda.locked({8: 0.2})", "given: there is no joint 8, it must be 1 to 7"),
]  # fmt: skip
MODELS = [
    ("Robot.from_mdh(np.zeros((6, 3)))",
     "rows must have shape (5, 4), (6, 4) or (7, 4), got (6, 3)"),
    ("Robot.from_mdh(put(rows, (2, 0), nan))", "alpha of row 3 is NaN, it must be finite"),
    ("Robot.from_mdh(put(rows, (2, 3), inf))", "theta of row 3 is inf, it must be finite"),
    # The twist and the length of a standard row belong to the next row of a modified table.
    ("Robot.from_sdh(put(rows, (2, 1), nan))", "a of row 4 is NaN, it must be finite"),
    ("Robot.from_sdh(put(rows, (2, 2), 1e7))", "d of row 3 is 1e7, its size must be at most 1e6"),
    ("Robot.from_mdh(put(rows, (1, 0), 90))", "alpha of row 2 is 90 rad, a multiple of 15 must be "
     "at most 12.57 rad (did you pass degrees? 90 deg is 1.57"),
    ("Robot.from_mdh(millimeters(rows))", "m from axis 1, it must be at most 100 m (are the "
     "lengths in millimeters? meters are wanted)"),
    ("Robot.from_mdh(put(rows, (2, slice(1, 3)), 0))", "it must be at least 1e-6 m"),
    ("Robot.from_mdh(put(rows, 5, [0, 0, 0, 0]))", "axes 5 and 6 are one line, so that the flange "
     "moves in 5 independent ways, it must be 6: change the table"),
    ("opw(c4=inf)", "c4 is inf, it must be finite"),
    ("opw(c2=-0.5)", "upper arm c2 is -0.5 m, it must be at least 1e-6 m"),
    ("opw(a2=0, c3=0)", "forearm hypot(a2, c3) is 0 m, it must be at least 1e-6 m"),
    ("opw(signs=[1, 1, 1, 1, 1, 0.5])", "joint 6 sign is 0.5, it must be 1 or -1"),
    ("opw(signs=[1, 1])", "signs must have shape (6,), got (2,)"),
    ("opw(offsets=[0, 0, -180, 0, 0, 0])", "offset of joint 3 is -180 rad, a multiple of 15 must"),
    ("robot.with_limits(limits(2, [1.2, -0.5]))", "joint 3 limit is empty: lower 1.2 rad > upper "
     "-0.5 rad"),
    ("Robot.from_mdh(rows, limits=limits(4, [nan, 1]))", "lower limit of joint 5 is NaN, it must "
     "not be NaN (-inf is allowed: no limit)"),
    ("opw(limits=limits(4, [1, -inf]))", "upper limit of joint 5 is -inf, it must be finite"),
    ("robot.with_limits(np.zeros((2, 6)))", "limits must have shape (6, 2), got (2, 6)"),
    ("robot.with_limits(np.degrees(robot.limits))", "joint 1 limit is -180 to 180 rad, beyond 50 "
     "rad as are the limits of most joints (did you pass degrees? for no limit give inf)"),
    ("robot.with_linkage_limits((-1, 1))", "no parallelogram linkage"),
    ("panda.follow(many, np.zeros(7), singularity_mode='error')", "seven pass a wrist singularity "
     "with \"through\"; lock one of them"),
    ("Robot('UR5e').configuration(q)", "has no ABB configuration: its structure is \"three "
     "parallel axes\", not a six-axis arm with a spherical wrist (the slot of a solution"),
    ("panda.ik_configured(T, [0] * 4)", "this robot has no ABB configuration"),
    ("Robot.from_urdf('<robot')", "URDF: line 1, column 7 is not XML: the text ends before the "),
    ("Robot.from_urdf(b\"<robot name='\\xff'/>\")", "URDF: byte 13 is not valid UTF-8"),
    # A text is no xacro file, whatever it ends with.
    ("Robot.from_urdf('<robot name=\\'a\\'/><!-- -->.xacro')", "line 1, column 26 is not XML"),
    ("Robot.from_urdf('<mujoco/>')", "URDF: the first element is <mujoco>, it must be <robot>"),
]  # fmt: skip
ARGUMENTS = [
    ("robot.ik(T, q)", TypeError, "q7 is joint 7 of an arm of seven joints: this one has six (for "
     "the solution nearest to a seed take ik_nearest(T, seed))"),
    ("panda.ik(T, list(q))", TypeError, "q7 must be one real number, the angle of joint 7 [rad], "
     "got list (for the solution nearest to a seed take ik_nearest(T, seed))"),
    ("panda.ik(T)", TypeError, "an arm of seven joints needs q7, the angle of joint 7 [rad]; take "
     "locked({3: 0.2}) for another joint, or ik_nearest"),
    ("panda.locked({'q3': 0.2})", TypeError, "q3 is not the number of a joint, from 1"),
    ("panda.locked({1: 0.1, 3: 0.2})", ValueError, "given has 2 joints"),
    ("robot.locked({3: 0.2})", TypeError, "given is for arms of seven joints"),
    ("robot.ik(target)", TypeError, "T must be real numbers, got a RobTarget: pass .matrix()"),
    ("robot.with_tool(tool._replace(robhold=False))", RapidError, "the tool is stationary (robhold "
     "FALSE), with_tool takes one that the robot holds"),
    ("robot.with_base(wobj)", TypeError, "got a WobjData: pass .uframe.matrix() @ its .oframe."),
    ("robot.fk(joints)", TypeError, "got a JointTarget: pass np.radians of its .robax_deg"),
    ("irbkin.pose([0] * 3, [1, 0, 0, 0], euler_zyx=[0] * 3)", TypeError, "give one orientation: "
     "wxyz or euler_zyx, not both"),
    ("robot.jacobian(q, frame='world')", ValueError, 'frame must be "base" or "tool", got "world"'),
    ("robot.ik_batch(T, threads=-1)", ValueError, "threads must be 0 (one per core) or more, got "),
    ("robot.ik_batch(T, threads=1.5)", TypeError, "'float' object cannot be interpreted as an int"),
    ("robot.ik_configured(T, [0] * 4, fallback='near')", ValueError, 'fallback must be "nearest" '
     'or None, got "near"'),
    ("robot.ik_configured(T, [0] * 4, fallback='nearest')", TypeError, "needs a seed"),
    ("robot.ik_configured(T, [0] * 4, seed=q)", TypeError, "a seed is for fallback"),
    ("robot.follow(many, q, singularity_mode='jump')", ValueError, 'must be "through", "error", '
     '"wrist" or "lock_axis4", got "jump"'),
    ("opw(a1='x')", TypeError, "must be real number, not str"),
    ("Robot(b'Panda')", TypeError, "str"),
    ("irbkin.catalog(reach=(0, 1400))", ValueError, "reach is 1400 m, it must be at most 100 m (is "
     "it in millimeters?)"),
    ("irbkin.catalog(reach=(2, 1))", ValueError, "reach is empty: least 2 m > most 1 m"),
    ("Robot('IRB 140')", UnknownRobotError, 'robot "IRB 140"; close names: "IRB 140-6/0.81'),
    ("Robot('zzzz')", UnknownRobotError, "no name of the catalog is close to it: catalog() lists "
     "all, from_urdf and from_mdh take other arms"),
    ("Robot('IRB 910SC')", UnknownRobotError, "; left out of the catalog: IRB 910SC-3, "),
    ("Robot('arm.urdf')", UnknownRobotError, "a file of a robot is read by from_urdf"),
    ("irbkin.pose(0.8, 0, 0.6)", TypeError, "xyz is one argument of three numbers"),
    ("robot.ik([0.8, 0, 0.6, 0, 0, 0, 1])", InvalidPoseError, "got (7,) (irbkin.pose makes"),
    ("irbkin.trajectory.retime([q, -q], Robot('UR15').max_velocity, 8)", TypeError, "max_velocity "
     "is None: the speeds of this arm are unknown, give yours for each of the 6 joints [rad/s]"),
    ("Robot.from_mdh(rows.round(4)).configuration(q)", InvalidModelError, "; its angles are "
     "rounded, snap=1e-5 gives it a closed form"),
    ("Robot('franka')", UnknownRobotError, '"Panda"'),
    ("robot.ik_nearest(put(T, (0, 3), 3000), q)", UnreachableError, " mm beyond reach (is the pose "
     "in millimeters? meters are wanted)"),
    ("tight.ik_nearest(T, np.degrees(q))", InvalidJointsError, "seed: joint 4 is 28.65 rad, far "
     "outside its limits -0.10 to 0.10 rad (did you pass degrees? otherwise remove whole turns)"),
    ("robot.fk(np.degrees(q))", InvalidJointsError, "q: joint 5 is -34.38 rad, far outside"),
    ("robot.follow(many, np.degrees(q))", InvalidJointsError, "did you pass degrees?"),
    ("robot.ik(T).nearest(np.degrees(q))", InvalidJointsError, "did you pass degrees?"),
    ("robot.ik_configured(T, [2, 0, 0, 0])", UnreachableError, "no solution inside the limits has "
     "the configuration [2, 0, 0, 0]; there are ["),
    ("rapid.parse('hello world')", irbkin.RapidError, "line 1, column 12: expected a comma or a "
     "semicolon, found the end of the text"),
    ("rapid.parse('cell/pick.mod')", irbkin.RapidError, "is a path, parse takes the text of a "),
]  # fmt: skip
REFUSED = [
    *((call, InvalidPoseError, words) for call, words in POSES),
    *((call, InvalidJointsError, words) for call, words in JOINTS),
    *((call, InvalidModelError, words) for call, words in MODELS),
    *ARGUMENTS,
]
ACCEPTED = [
    "robot.ik(sheared(0.9e-5))",
    "robot.ik(put(T, (3, 2), 0.5e-9))",
    "robot.with_tool(irbkin.pose([0, 0, 11]))",
    "robot.with_base(irbkin.pose([0, 0, 5000]))",
    "robot.fk([q, np.degrees(2 * q), 0 * q])",
    "irbkin.trajectory.retime(np.degrees([[0], [90]]), 1, 1)",
    "irbkin.trajectory.joint(q, q + [30, 30, 30, 0, 0, 0])",
    "Robot.from_mdh(rows * [1, 10, 10, 1])",
    "opw(offsets=[0, 2 * np.pi, -np.pi / 2, 14 * np.pi, 100.0, -7])",
    "irbkin.pose([0, 0, 0], euler_zyx=[-6.2832, 0, 0])",
    "robot.with_limits([[-49, 49]] * 6)",
    "robot.with_limits([[-1520, 1520], [-2, 2], [-2, 2], [-1520, 1520], [-2, 2], [-1520, 1520]])",
    "robot.with_limits(limits(0, [-inf, inf]))",
    "robot.with_limits(limits(0, [0.5, 0.5]))",
    "irbkin.catalog(reach=(0, inf))",
    "panda.ik(T, np.float32(0.25))",
    "panda.ik(T, np.array(0.3))",
]


@pytest.mark.parametrize(("call", "error", "words"), REFUSED, ids=[row[0] for row in REFUSED])
def test_a_call_is_refused_with_its_words(call, error, words):
    with pytest.raises(error) as refused:
        eval(call, dict(NAMES))
    assert type(refused.value) is error
    assert words in str(refused.value)


@pytest.mark.parametrize("call", ACCEPTED)
def test_a_legitimate_call_is_accepted(call):
    assert eval(call, dict(NAMES)) is not None


JOINT_CALLS = ("fk", "link_frames", "jacobian", "singularity", "configuration")
POSE_CALLS = ("ik", "check_pose", "with_tool", "with_base")
# Arms with a closed form, with an offset wrist, in general.
ARMS = [ROBOT, *(Robot.from_mdh(TABLES[name]) for name in ("GoFa 5", "random 0"))]
NOT_NUMBERS = {
    "text": "abc",
    "texts": ["1"] * 6,
    "complex": Q * 1j,
    "bool": Q > 0,
    "object": Q.astype(object),
    "None": None,
    "dict": {},
    "dates": np.zeros(6, dtype="M8[s]"),
    "records": np.zeros(6, dtype=[("a", "f8")]),
    "integers beyond 64 bits": [10**30] * 6,
}


@pytest.mark.parametrize("robot", ARMS, ids=lambda robot: robot.structure)
def test_every_function_checks_its_joints_and_poses(robot):
    for name in JOINT_CALLS[: None if robot is ROBOT else -1]:
        with pytest.raises(InvalidJointsError, match=r"^q: joint 3 is NaN"):
            getattr(robot, name)(put(Q, 2, np.nan))
    for name in POSE_CALLS:
        with pytest.raises(InvalidPoseError, match="mirrors"):
            getattr(robot, name)(np.diag([1.0, 1, -1, 1]))
    pose = robot.fk(Q)
    for call in (robot.ik_nearest, lambda T, seed: robot.follow(T[None], seed)):
        with pytest.raises(InvalidJointsError, match=r"^seed: joint 2 is 1e9 rad"):
            call(pose, put(Q, 1, 1e9))
    answer = robot.ik_batch(np.stack([pose, put(pose, (0, 0), 3), pose]))
    assert (answer.status[1] == irbkin.Status.INVALID).all()
    assert np.isnan(answer.q[1]).all()
    np.testing.assert_array_equal(answer.q[[0, 2]], [robot.ik(pose).q_by_slot] * 2)


@pytest.mark.parametrize("value", NOT_NUMBERS.values(), ids=NOT_NUMBERS)
def test_non_numeric_input_is_a_type_error(value):
    calls = [getattr(ROBOT, name) for name in (*JOINT_CALLS, *POSE_CALLS, "ik_batch")]
    calls += [ROBOT.with_limits, Robot.from_mdh, Robot.from_sdh, irbkin.pose, irbkin.to_xyz_wxyz]
    for call in calls:
        words = r"^\w+ must be real numbers, got (an array of dtype|None)"
        with pytest.raises(TypeError, match=words):
            call(value)


@pytest.mark.parametrize("name", irbkin.catalog())
def test_limits_in_degrees_and_lengths_in_millimeters_are_refused(name):
    robot = Robot(name)
    with pytest.raises(InvalidModelError, match="did you pass degrees"):
        robot.with_limits(np.degrees(robot.limits))
    rows = (robot.uncoupled() if robot.is_coupled else robot).mdh
    with pytest.raises(InvalidModelError, match="are the lengths in millimeters"):
        Robot.from_mdh(millimeters(rows))


def test_errors_are_value_errors_with_a_common_base():
    for error in (InvalidPoseError, InvalidJointsError, InvalidModelError, UnreachableError):
        assert issubclass(error, IrbkinError)
    assert issubclass(UnknownRobotError, IrbkinError)
    assert issubclass(UnknownRobotError, KeyError)
    assert issubclass(IrbkinError, ValueError)


def test_arguments_have_the_names_of_the_documentation():
    for call, names in {
        ROBOT.fk: "q out",
        ROBOT.jacobian: "q frame out",
        ROBOT.ik: "T q7 heading_tolerance",
        ROBOT.ik_batch: "T q7 out threads heading_tolerance",
        ROBOT.ik_nearest: "T seed weights out threads cell heading_tolerance position_only",
        ROBOT.with_tool: "T",
        ROBOT.with_limits: "limits",
    }.items():
        assert list(inspect.signature(call).parameters) == names.split()


def test_nothing_is_printed(capfd):
    for call in ("robot.ik(put(T, (0, 1), nan))", "robot.fk([nan] * 6)", "Robot('none')"):
        with pytest.raises(IrbkinError):
            eval(call, dict(NAMES))
    assert capfd.readouterr() == ("", "")


def test_joints_may_be_four_turns_outside_the_limits():
    """No farther, and as far as they like where a joint has no limits."""
    upper = ROBOT.limits[:, 1]
    for joint in range(6):
        ROBOT.fk(put(Q, joint, upper[joint] + 8 * np.pi))
        with pytest.raises(InvalidJointsError, match=f"joint {joint + 1} is .* far outside"):
            ROBOT.fk(put(Q, joint, upper[joint] + 8 * np.pi + 1e-3))
    ROBOT.with_limits(put([[-1.0, 2.0]] * 6, 0, [-np.inf, np.inf])).fk(put(Q, 0, 300.0))


def test_small_slips_get_errors_of_our_own(tmp_path):
    robot = irbkin.Robot("IRB 2600-12/1.65")
    with pytest.raises(TypeError, match=r"plan must be a Plan, .*got int"):
        irbkin.rapid.plan_targets(robot, 5)
    for text in ("1" * 100_000, "[,]", b"\xff{", '{"format": "irbkin scene", "version": 2}'):
        with pytest.raises(irbkin.IrbkinError, match=r"not a scene: |version is 2"):
            irbkin.scene.Scene.from_json(text)
    data = json.loads(irbkin.scene.of(robot).to_json())
    data["arms"][0]["coupling"] = 10**400
    with pytest.raises(irbkin.IrbkinError, match="must be a finite number"):
        irbkin.scene.Scene.from_json(json.dumps(data))
    (file := tmp_path / "arm.urdf").write_text(robot.to_urdf())
    del data["arms"][0]["coupling"]
    data["arms"][0]["urdf"] = str(file)
    with pytest.raises(irbkin.InvalidModelError, match="XML"):
        Joints(irbkin.scene.Scene.from_dict(data)).nearest(np.eye(4), [0] * 6)
    for threads in (2**63, -(2**70), 10**30):
        with pytest.raises(ValueError, match="threads must be 0"):
            robot.ik_batch(np.eye(4)[None], threads=threads)
