"""Robots from URDF: Pinocchio reads the same text, and what is refused says why."""

import pickle
from pathlib import Path

import numpy as np
import pinocchio
import pytest
from irbkin import InvalidModelError, Robot
from reference import rounding, turn

DATA = Path(__file__).parents[2] / "data"
TEXTS = {path.stem: path.read_text() for path in DATA.glob("*.urdf")}
# (base, tip) of each; the tip is given where there are several.
CHAINS = {
    "irb2600": (None, None, "tool0"),
    "irb2600_rounded": (None, None, "link_6"),
    "kr6_r700": (None, None, "tool0"),
    "ur5e": (None, "tool0", "tool0"),
    "panda_hand": (None, None, "panda_hand_tcp"),
    "tilted": (None, None, "tip"),
    "iiwa14": (None, None, "link_ee"),
}
SAMPLES = 200


def by_pinocchio(text, base, tip):
    """Forward kinematics from base to tip of the model that Pinocchio makes of the same text."""
    model = pinocchio.buildModelFromXML(text)
    data = model.createData()
    frames = [
        model.getFrameId(link, pinocchio.FrameType.BODY)
        for link in (base or model.frames[1].name, tip)
    ]

    def fk(q):
        configuration = pinocchio.neutral(model)
        for joint, angle in zip(list(model.joints)[1:], q, strict=False):
            # A continuous joint has the cosine and sine of its angle.
            values = [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
            configuration[joint.idx_q : joint.idx_q + joint.nq] = values
        pinocchio.framesForwardKinematics(model, data, configuration)
        t_base, t_tip = (data.oMf[frame].homogeneous for frame in frames)
        return np.linalg.inv(t_base) @ t_tip

    return fk


def reach(robot):
    """Lengths that a pose is summed from [m]."""
    ends = np.linalg.norm(robot._root[:3, 3]) + np.linalg.norm(robot.flange[:3, 3])
    return ends + np.hypot(robot.mdh[:, 1], robot.mdh[:, 2]).sum()


def assert_agrees(robot, fk, bound):
    for q in np.random.default_rng(1).uniform(-np.pi, np.pi, (SAMPLES, robot.dof)):
        np.testing.assert_allclose(robot.fk(q), fk(q), rtol=0, atol=bound)


def test_every_description_is_tried():
    assert TEXTS.keys() == CHAINS.keys()


@pytest.mark.parametrize("name", CHAINS)
def test_poses_are_those_of_pinocchio(name):
    base, tip, last = CHAINS[name]
    robot = Robot.from_urdf(TEXTS[name], base, tip, snap=0)
    # Right angles with nine decimals are 2e-10 off, and are taken as such: for six joints, on the
    # way there and back.
    bound = (
        12 * 2.1e-10 * reach(robot) if name == "irb2600_rounded" else 2 * rounding(reach(robot) + 1)
    )
    assert_agrees(robot, by_pinocchio(TEXTS[name], base, last), bound)


@pytest.mark.parametrize("position", [-0.3, 0, 0.8])
def test_a_rail_is_where_pinocchio_has_it(position):
    rail = (
        '<link name="floor"/><joint name="rail" type="prismatic"><parent link="floor"/>'
        '<child link="world"/><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/><axis xyz="1 -2 3"/>'
        '<limit lower="-0.5" upper="1" effort="0" velocity="2"/></joint></robot>'
    )
    text = TEXTS["tilted"].replace("</robot>", rail)
    robot = Robot.from_urdf(text, snap=0).at(position)
    fk = by_pinocchio(text, "floor", "tip")
    assert_agrees(robot, lambda q: fk([position, *q]), 2 * rounding(reach(robot) + 2))


@pytest.mark.parametrize(
    ("base", "tip"), [("base_link", "tip"), ("world", "link_6"), ("base_link", "link_6")]
)
def test_poses_from_and_to_other_links(base, tip):
    text = TEXTS["tilted"]
    robot = Robot.from_urdf(text, base, tip, snap=0)
    assert_agrees(robot, by_pinocchio(text, base, tip), 2 * rounding(reach(robot) + 1))


def test_the_table_with_both_ends_is_the_arm():
    robot = Robot.from_urdf(TEXTS["tilted"])
    assert np.abs(robot._root - np.eye(4)).max() > 0.1
    rows = Robot.from_mdh(robot.mdh)
    q = np.linspace(-1, 1, 6)
    np.testing.assert_allclose(robot._root @ rows.fk(q) @ robot.flange, robot.fk(q), atol=1e-14)
    for other in ("irb2600", "kr6_r700", "iiwa14"):
        np.testing.assert_array_equal(Robot.from_urdf(TEXTS[other])._root, np.eye(4))
    np.testing.assert_array_equal(Robot("IRB 2600-12/1.65")._root, np.eye(4))


@pytest.mark.parametrize(
    ("name", "tip", "other", "family"),
    [
        # ROS turns base_link half a turn about z from frame 0 of the maker's table.
        ("ur5e", "tool0", Robot("UR5e").with_base(turn("z", np.pi)), "three parallel axes"),
        (
            "panda_hand",
            "panda_hand",
            Robot("Panda").with_tool(turn("z", -np.pi / 4)),
            "spherical shoulder",
        ),
    ],
)
def test_the_other_structures_have_the_same_slots(name, tip, other, family):
    robot = Robot.from_urdf(TEXTS[name], tip=tip)
    assert robot.structure == other.structure == family
    low, high = other.limits.T
    compared = 0
    for q in np.random.default_rng(2).uniform(low, high, (SAMPLES, robot.dof)):
        pose, told = other.fk(q), {"q7": q[6]} if robot.dof == 7 else {}
        np.testing.assert_allclose(robot.fk(q), pose, atol=2e-9)
        found, wanted = robot.with_limits(other.limits).ik(pose, **told), other.ik(pose, **told)
        # A URDF in nine decimals is off by 1e-9: the joints by that over the least singular value.
        if all(
            np.linalg.svd(other.jacobian(s.q)[:, :6], compute_uv=False)[-1] > 1e-2 for s in wanted
        ):
            np.testing.assert_allclose(found.q_by_slot, wanted.q_by_slot, atol=1e-6)
            compared += 1
    assert compared > SAMPLES / 4


def test_limits_velocities_and_names_arrive():
    robot = Robot.from_urdf(TEXTS["irb2600"])
    catalog = Robot("IRB 2600-12/1.65")
    np.testing.assert_array_equal(robot.limits, catalog.limits)
    np.testing.assert_array_equal(robot.max_velocity, catalog.max_velocity)
    assert robot.name == "irb2600"
    assert Robot.from_urdf(TEXTS["irb2600"], name="mine").name == "mine"
    tilted = Robot.from_urdf(TEXTS["tilted"])
    np.testing.assert_array_equal(
        tilted.limits, [[-np.inf, np.inf], *[[-2.0, 2.5]] * 4, [-np.inf, np.inf]]
    )
    assert tilted.max_velocity is None


def test_a_robot_of_a_urdf_is_a_value():
    robot = Robot.from_urdf(TEXTS["tilted"])
    assert pickle.loads(pickle.dumps(robot)) == robot == Robot.from_urdf(TEXTS["tilted"])
    assert hash(robot) == hash(pickle.loads(pickle.dumps(robot)))


def test_text_bytes_and_paths_are_taken(tmp_path):
    text = TEXTS["irb2600"]
    path = DATA / "irb2600.urdf"
    robot = Robot.from_urdf(text)
    for given in (
        text.encode(),
        "\n \ufeff" + text,
        b"\xef\xbb\xbf" + text.encode(),
        path,
        str(path),
    ):
        assert Robot.from_urdf(given) == robot
    # A path may hold what is no UTF-8.
    odd = tmp_path / "arm\udcff.urdf"
    odd.write_text(text)
    assert Robot.from_urdf(odd) == Robot.from_urdf(str(odd)) == robot


@pytest.mark.parametrize("given", ["missing.urdf", Path("missing.urdf"), "", " "])
def test_a_missing_file_is_pythons_error(given):
    with pytest.raises(FileNotFoundError):
        Robot.from_urdf(given)


def test_an_argument_that_is_neither_text_nor_path_is_refused(tmp_path):
    with pytest.raises(IsADirectoryError):
        Robot.from_urdf(tmp_path)
    for given in (5, None, 1.5, ["<robot/>"], 0):
        with pytest.raises(TypeError):
            Robot.from_urdf(given)
    with pytest.raises(ValueError, match="null byte"):
        Robot.from_urdf("arm\0.urdf")


def chain(kinds, extra=""):
    """A chain of joints of these types, about z and x in turn."""
    links = "".join(f'<link name="l{i}"/>' for i in range(len(kinds) + 1))
    joints = "".join(
        f'<joint name="j{i}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/>'
        f'<origin xyz="0 0 0.2"/><axis xyz="{i % 2} 0 {1 - i % 2}"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for i, kind in enumerate(kinds)
    )
    return f'<robot name="chain">{links}{joints}{extra}</robot>'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<robot", "line 1, column 7 is not XML: the text ends before the robot does"),
        (b"<robot name='\xff'/>", "byte 13 is not valid UTF-8"),
        ("<robot name='\ud800'/>", "byte 13 is not valid UTF-8"),
        (
            chain(["revolute"] * 4),
            '6 or 7 revolute joints lead from "l0" to no end of a chain: "l4" (4); 4 are not '
            "enough, since a pose has six coordinates",
        ),
    ],
)
def test_a_refusal_reports_the_reason(text, words):
    with pytest.raises(InvalidModelError) as refused:
        Robot.from_urdf(text)
    assert str(refused.value) == f"URDF: {words}"


def test_an_unknown_link_is_named():
    with pytest.raises(InvalidModelError) as refused:
        Robot.from_urdf(TEXTS["kr6_r700"], tip="tool")
    links = ["base_link", *(f"link_{i}" for i in range(1, 7)), "tool0"]
    words = 'URDF: tip "tool" is not a link; there are ' + ", ".join(f'"{link}"' for link in links)
    assert str(refused.value) == words
    with pytest.raises(
        InvalidModelError,
        match=r'^URDF: tip "base" is not below base "link_1": no joints lead from base to tip$',
    ):
        Robot.from_urdf(TEXTS["irb2600"], "link_1", "base")


def test_an_arm_without_closed_form_is_general():
    text = chain(["revolute", "continuous"] * 3)
    robot = Robot.from_urdf(text)
    assert_agrees(robot, by_pinocchio(text, None, "l6"), 2 * rounding(reach(robot) + 1))
