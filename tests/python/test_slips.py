"""Slips of units, conventions and calls: the refusal names the value, the bound and what was
probably meant. Beside each, what is legitimate and stays accepted.
"""

import irbkin
import numpy as np
import pytest
from irbkin import InvalidModelError, InvalidPoseError, Robot, UnreachableError, rapid
from scipy.spatial.transform import Rotation

ROBOT = Robot("IRB 2600-12/1.65")
PANDA = Robot("Panda")
Q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
T = ROBOT.fk(Q)
OPW = {"a1": 0.15, "a2": -0.115, "b": 0, "c1": 0.445, "c2": 0.7, "c3": 0.795, "c4": 0.085}
UR5E = np.array(
    [
        [np.pi / 2, 0, 0.1625, 0],
        [0, -0.425, 0, 0],
        [0, -0.3922, 0, 0],
        [np.pi / 2, 0, 0.1333, 0],
        [-np.pi / 2, 0, 0.0997, 0],
        [0, 0, 0.0996, 0],
    ]
)
PUMA = np.array(
    [
        [1.5708, 0, 0.6718, 0],
        [0, 0.4318, 0, 0],
        [-1.5708, 0.0203, 0.15005, 0],
        [1.5708, 0, 0.4318, 0],
        [-1.5708, 0, 0, 0],
        [0, 0, 0, 0],
    ]
)
TARGET = rapid.parse("[[1018.6,0,1417.5],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]")
TOOL = rapid.parse("[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]")
WOBJ = rapid.parse('[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]')
JOINTS = rapid.parse("[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]")


def moved(z):
    return irbkin.pose([0, 0, z])


def in_millimeters(rows):
    return rows * [1, 1000, 1000, 1]


@pytest.mark.parametrize("seed", [Q, list(Q), tuple(Q)], ids=lambda seed: type(seed).__name__)
def test_a_seed_given_to_ik_names_q7_and_ik_nearest(seed):
    for call in (ROBOT.ik, ROBOT.ik_batch):
        with pytest.raises(TypeError, match=r"^q7 is joint 7 .* take ik_nearest\(T, seed\)\)$"):
            call(T, seed)
    seven = [*seed, 0.1]
    pose = PANDA.fk(seven)
    for wrong, got in (
        (np.array(seven), r"an array of shape \(7,\)"),
        (seven, "an object of type list"),
    ):
        words = rf"^q7 must be one real number, .*, got {got} \(.* take ik_nearest\(T, seed\)\)$"
        with pytest.raises(TypeError, match=words):
            PANDA.ik(pose, wrong)
    for angle in (0, 0.3, np.float64(0.3), np.float32(0.25), np.array(0.3)):
        PANDA.ik(pose, angle)


def test_poses_in_millimeters_are_asked_for_and_poses_far_away_are_not():
    far = T.copy()
    far[:3, 3] *= 1000
    words = "(is the pose in millimeters? meters are wanted)"
    assert ROBOT.ik(far).explain() == f"wrist center 1423411.5 mm beyond reach {words}"
    assert ROBOT.check_pose(far).reason.endswith(words)
    with pytest.raises(UnreachableError, match="is the pose in millimeters"):
        ROBOT.ik_nearest(far, Q)
    assert "millimeters" not in ROBOT.ik(moved(20)).explain()


def test_a_tool_in_millimeters_is_refused_and_long_ones_are_not():
    with pytest.raises(InvalidPoseError) as refused:
        ROBOT.with_tool(moved(110))
    assert str(refused.value) == (
        "the tool center point is 110.0 m from the flange, it must be at most 50 m (is the tool in "
        "millimeters? meters are wanted)"
    )
    for length in (0, 0.11, 3, 49.9, 50):
        ROBOT.with_tool(moved(length))
    # A base may be far: the world's frame is where it is.
    ROBOT.with_base(moved(5000))


@pytest.mark.parametrize(
    "build",
    [
        lambda: Robot.from_mdh(in_millimeters(ROBOT.mdh)),
        lambda: Robot.from_sdh(in_millimeters(UR5E)),
        lambda: Robot.from_mdh(in_millimeters(PANDA.mdh)),
        lambda: Robot.from_mdh(in_millimeters(UR5E)),
        lambda: Robot.from_opw(**{name: 1000 * length for name, length in OPW.items()}),
    ],
)
def test_an_arm_in_millimeters_is_refused(build):
    words = r"^the flange is \d+\.\d m from axis \d, it must be at most 100 m \(are the lengths in "
    with pytest.raises(InvalidModelError, match=words):
        build()


def test_every_arm_of_the_catalog_would_be_refused_in_millimeters_and_ten_times_as_large_not():
    for name in irbkin.catalog():
        robot = Robot(name)
        if robot.is_coupled:
            robot = robot.uncoupled()
        Robot.from_mdh(robot.mdh * [1, 10, 10, 1])
        with pytest.raises(InvalidModelError, match="are the lengths in millimeters"):
            Robot.from_mdh(in_millimeters(robot.mdh))


def test_a_reach_in_millimeters_is_refused():
    for reach in (1400, (0, 1400), (1400, np.inf)):
        with pytest.raises(ValueError, match=r"^reach is 1400 m, it must be at most 100 m \(is it"):
            irbkin.catalog(reach=reach)
    assert irbkin.catalog(reach=(0, np.inf))
    assert irbkin.catalog(reach=(0, 100)) == irbkin.catalog(reach=0)
    assert irbkin.catalog(payload=500)


@pytest.mark.parametrize("name", irbkin.catalog())
def test_limits_in_degrees_are_refused(name):
    robot = Robot(name)
    robot.with_limits(robot.limits)
    with pytest.raises(
        InvalidModelError,
        match=r"^joint \d limit is .* rad, beyond 50 rad as are those of most joints \(did you",
    ):
        robot.with_limits(np.degrees(robot.limits))


def test_wide_limits_of_wrists_and_of_everything_are_taken():
    wide = 242 * 2 * np.pi
    for limits in (
        [[-wide, wide], [-2, 2], [-2, 2], [-wide, wide], [-2, 2], [-wide, wide]],
        [[-1e4, 1e4]] * 6,
        [[-49, 49]] * 6,
        [[-np.inf, np.inf]] * 6,
    ):
        ROBOT.with_limits(limits)


@pytest.mark.parametrize("angle", [90, -90, 180, 45, 30, 15, 360])
def test_angles_in_degrees_are_refused(angle):
    words = rf"is {angle} rad, a multiple of 15 must be at most 12\.57 rad \(did you pass degrees\?"
    with pytest.raises(InvalidModelError, match=f"^offset of joint 3 {words}"):
        Robot.from_opw(**OPW, offsets=[0, 0, angle, 0, 0, 0])
    for column, field in ((0, "alpha"), (3, "theta")):
        rows = ROBOT.mdh.copy()
        rows[1, column] = angle
        with pytest.raises(InvalidModelError, match=f"^{field} of row 2 {words}"):
            Robot.from_mdh(rows)
    if abs(angle) > 2 * np.pi:
        with pytest.raises(
            InvalidPoseError,
            match=rf"^euler_zyx\[0\] is {angle} rad, its size must be at most 6\.2833 rad \(did",
        ):
            irbkin.pose([0, 0, 0], euler_zyx=[angle, 0, 0])


def test_angles_of_whole_turns_are_taken():
    Robot.from_opw(**OPW, offsets=[0, 2 * np.pi, -np.pi / 2, 14 * np.pi, 100.0, -7])
    for angle in (2 * np.pi, -6.2832, 3.2):
        irbkin.pose([0, 0, 0], euler_zyx=[angle, 0, 0])


READINGS = {
    "standard as modified": (
        Robot.from_mdh,
        UR5E,
        "; as a standard table it has three parallel axes: use from_sdh",
    ),
    "standard with four decimals": (
        Robot.from_mdh,
        PUMA,
        "; as a standard table it has a spherical wrist: use from_sdh",
    ),
    "modified as standard": (
        Robot.from_sdh,
        Robot.from_sdh(UR5E).mdh,
        "; as a modified table it has three parallel axes: use from_mdh",
    ),
    "d, theta, a, alpha": (
        Robot.from_sdh,
        UR5E[:, [2, 3, 1, 0]],
        "; with its columns as d, theta, a, alpha it has three parallel axes: reorder them to "
        "alpha, a, d, theta",
    ),
    "theta, d, a, alpha of the other convention": (
        Robot.from_mdh,
        UR5E[:, [3, 2, 1, 0]],
        "; with its columns as theta, d, a, alpha, as a standard table it has three parallel axes: "
        "reorder them to alpha, a, d, theta and use from_sdh",
    ),
    "1.5708": (
        Robot.from_sdh,
        np.round(UR5E, 4),
        " (write the angles with all their digits); snap=1e-5 would take it",
    ),
}


@pytest.mark.parametrize(("build", "rows", "words"), READINGS.values(), ids=READINGS)
def test_a_table_that_is_known_in_another_reading_tells_it(build, rows, words):
    try:
        told = str(build(rows))
    except InvalidModelError as refused:
        # So read, two axes of some are one line.
        told = str(refused)
    assert told.endswith(words)


def test_a_standard_table_of_seven_axes_says_so_where_its_closed_form_is_asked_for():
    # The rows of a Panda as of a standard table: the flange is not in them.
    rows = np.roll(PANDA.mdh[:, :2], -1, axis=0)
    standard = np.column_stack([rows, PANDA.mdh[:, 2:]])
    robot = Robot.from_mdh(standard)
    assert robot.structure == "general"
    words = "; as a standard table it has a spherical shoulder: use from_sdh"
    assert str(robot).endswith(words)


OBJECTS = {
    "RobTarget": (TARGET, r"a RobTarget: pass \.matrix\(\)"),
    "ToolData": (TOOL, r"a ToolData: pass \.tframe\.matrix\(\)"),
    "WobjData": (WOBJ, r"a WobjData: pass \.uframe\.matrix\(\) @ its \.oframe\.matrix\(\)"),
    "Rotation": (Rotation.identity(), r"a Rotation: pass irbkin\.pose\(xyz, rotation=it\)"),
    "None": (None, "None$"),
    "text": ("abc", "an array of dtype"),
}


@pytest.mark.parametrize(("value", "words"), OBJECTS.values(), ids=OBJECTS)
def test_objects_in_place_of_poses_say_how_they_are_passed(value, words):
    for call in (ROBOT.ik, ROBOT.ik_batch, ROBOT.with_tool, ROBOT.check_pose):
        with pytest.raises(TypeError, match=f"^T must be real numbers, got {words}"):
            call(value)


def test_a_jointtarget_in_place_of_joints_says_how_it_is_passed():
    words = r"^q must be real numbers, got a JointTarget: pass np\.radians of its \.robax_deg$"
    with pytest.raises(TypeError, match=words):
        ROBOT.fk(JOINTS)
    assert ROBOT.fk(np.radians(JOINTS.robax_deg)).shape == (4, 4)


def test_a_rigid_transform_says_how_it_is_passed():
    transforms = pytest.importorskip("scipy.spatial.transform")
    if not hasattr(transforms, "RigidTransform"):
        pytest.skip("scipy has no RigidTransform")
    transform = transforms.RigidTransform.from_matrix(T)
    with pytest.raises(TypeError, match=r"got a RigidTransform: pass \.as_matrix\(\)$"):
        ROBOT.ik(transform)
    assert len(ROBOT.ik(transform.as_matrix())) == 8


def test_degrees_are_asked_for_where_a_seed_finds_nothing():
    tight = ROBOT.with_limits([[-0.1, 0.1]] * 6)
    with pytest.raises(UnreachableError, match=r"seed: joint 1 is 17\.18.* did you pass degrees\?"):
        tight.ik_nearest(T, np.degrees(Q))
    with pytest.raises(UnreachableError) as refused:
        tight.ik_nearest(T, Q)
    assert "degrees" not in str(refused.value)


def test_text_that_is_not_rapid_is_refused_in_plain_words():
    with pytest.raises(irbkin.RapidError) as refused:
        rapid.parse("hello world")
    assert (
        str(refused.value) == "line 1, column 12: expected a semicolon, found the end of the text"
    )
    for path in ("cell/pick.mod", "C:\\cell\\Pick.MODX", "user.sys"):
        with pytest.raises(irbkin.RapidError, match="is a path, parse takes the text of a module"):
            rapid.parse(path)
