"""Arms of MJCF against MuJoCo, and what is refused."""

import re
import sys

import mujoco
import numpy as np
import pytest
from irbkin import Robot
from irbkin.errors import InvalidModelError

# Degrees, classes, a frame, two joints in one body, joints beside their body's origin, references,
# a joint without limits; meshes and textures that are not there.
JOINTS = """
<body name="b1" pos="0 0 0.3" quat="0.9 0.1 -0.3 0.2">
 <joint name="j1" axis="0 0 1" range="-170 160"/><geom type="mesh" mesh="shell" material="paint"/>
 <body name="b2" pos="0.1 0.05 0.2" euler="10 20 30">
  <joint name="j2" axis="0 1 0.2" pos="0.02 -0.03 0.1" ref="25" range="-45 110"/>
  <joint name="j3" class="free" axis="1 1 0" pos="0.1 0 0" springref="40"/>
  <frame pos="0 0.1 0.3" axisangle="1 0 0 50">
   <body name="b4" pos="0.2 0 0"><joint name="j4" axis="1 0 0" range="-180 180"/>
    <body name="b5" pos="0 0 0.1"><joint name="j5" axis="0 1 0" ref="-60" range="-90 90"/>
     <body name="b6" pos="0.05 0 0" xyaxes="0 1 0 -1 0 0"><joint name="j6" axis="0 0 1"/>{end}
     </body></body></body></frame></body></body>"""
SITE = '<site name="tcp" pos="0 0 0.15" euler="5 0 90" material="paint"/>'
MODEL = """<mujoco model="lab arm"><compiler eulerseq="zyx" meshdir="nowhere"/>
<asset><mesh name="shell" file="shell.stl"/><texture name="wood" type="2d" file="wood.png"/>
 <material name="paint" texture="wood"/></asset>
<default><geom material="paint"/><joint damping="1"/>
 <default class="free"><joint limited="false"/></default></default>
<worldbody><geom type="plane" size="1 1 1"/><body name="crate" pos="0 1 0"><freejoint/></body>
 <body name="stand" pos="1 2 3" euler="30 0 0">{joints}</body></worldbody>{rest}</mujoco>"""


def model(end=SITE, rest="", joints=JOINTS):
    return MODEL.format(joints=joints.format(end=end), rest=rest)


def oracle(text):
    """MuJoCo's model of the text without what needs a file."""
    text = re.sub(
        r'<asset>.*</asset>|<geom type="mesh".*?/>| material="paint"', "", text, flags=re.S
    )
    text = text.replace("<compiler", '<compiler boundmass="1" boundinertia="1"')
    return mujoco.MjModel.from_xml_string(text)


def poses(own, names, base, tip, q):
    """The poses of a site or body in a body, joints of these names at rows of q."""
    data = mujoco.MjData(own)
    found = []
    for row in q:
        for name, angle in zip(names, row, strict=True):
            data.joint(name).qpos[0] = angle
        mujoco.mj_kinematics(own, data)
        frames = []
        is_site = mujoco.mj_name2id(own, mujoco.mjtObj.mjOBJ_SITE, tip) >= 0
        for it in (data.body(base), data.site(tip) if is_site else data.body(tip)):
            frame = np.eye(4)
            frame[:3, 3], frame[:3, :3] = it.xpos, it.xmat.reshape(3, 3)
            frames.append(frame)
        found.append(np.linalg.inv(frames[0]) @ frames[1])
    return np.array(found)


def fault(text, *arguments):
    with pytest.raises(InvalidModelError) as caught:
        Robot.from_mjcf(text, *arguments)
    words = str(caught.value)
    assert "\n" not in words
    return words


@pytest.mark.parametrize(
    ("base", "tip", "root", "end"),
    [
        (None, None, "stand", "tcp"),
        (None, "b6", "stand", "b6"),
        ("world", "tcp", "world", "tcp"),
        ("stand", "b6", "stand", "b6"),
    ],
)
def test_fk_is_mujocos(base, tip, root, end):
    robot = Robot.from_mjcf(model(), base, tip)
    q = np.random.default_rng(1).uniform(-4, 4, (200, 6))
    own = oracle(model())
    np.testing.assert_allclose(
        robot.fk(q), poses(own, robot.joint_names, root, end, q), rtol=0, atol=1e-12
    )
    assert robot.joint_names == ("j1", "j2", "j3", "j4", "j5", "j6")
    assert robot.name == "lab arm"
    limits = own.jnt_range[1:].copy()
    limits[[2, 5]] = [-np.inf, np.inf]
    np.testing.assert_array_equal(robot.limits, limits)


def test_a_file_includes_others_of_its_folder_and_has_a_name_of_the_users(tmp_path, monkeypatch):
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "arm.xml").write_text(model())
    scene = tmp_path / "scene" / "scene.xml"
    scene.write_text('<mujoco model="scene"><include file="arm.xml"/></mujoco>')
    monkeypatch.chdir(tmp_path)
    robot = Robot.from_mjcf("scene/scene.xml", name="mine")
    np.testing.assert_array_equal(robot.fk(np.ones(6)), Robot.from_mjcf(model()).fk(np.ones(6)))
    assert robot.name == "mine"
    scene.write_text('<mujoco><include file="gone.xml"/></mujoco>')
    words = fault("scene/scene.xml")
    assert words.startswith("scene/scene.xml: ")
    assert "gone.xml" in words
    scene.write_text('<mujoco><include file="scene.xml"/></mujoco>')
    assert "already included" in fault(scene)


def test_of_several_tips_each_is_named_with_its_joints():
    text = model(SITE + '<site name="camera" pos="0.1 0 0"/>').replace('"tcp"', '"probe"')
    words = fault(text)
    assert '"probe" (6)' in words
    assert '"camera" (6)' in words
    assert Robot.from_mjcf(text, tip="camera").fk(np.zeros(6))[:3, 3].shape == (3,)
    assert '"probe"' in fault(text, None, "prbe")
    assert "base" in fault(text, "stnd")


def test_a_site_with_the_name_of_a_body_has_another():
    text = model(SITE.replace("tcp", "b6"))
    at = [Robot.from_mjcf(text, tip=tip).fk(np.zeros(6))[:3, 3] for tip in ("b6", "b6 (site)")]
    assert np.linalg.norm(at[0] - at[1]) == pytest.approx(0.15)


def test_of_two_arms_the_tip_chooses_the_base():
    arm = f'<body name="post" pos="0 1 0">{JOINTS.format(end="")}</body>'
    pair = [re.sub(' name="', f' name="{side}_', arm) for side in ("left", "right")]
    stand = r'<body name="stand".*</body>'
    text = re.sub(stand, "".join(pair), model(), flags=re.S)
    assert '"right_b6" (6)' in fault(text)
    robot = Robot.from_mjcf(text, tip="right_b6")
    q = np.random.default_rng(2).uniform(-2, 2, (20, 6))
    want = poses(oracle(text), robot.joint_names, "right_post", "right_b6", q)
    np.testing.assert_allclose(robot.fk(q), want, rtol=0, atol=1e-12)


def test_a_gripper_is_not_the_arms():
    jaws = "".join(
        f'<body name="{side}_finger"><joint name="{side}_finger" type="slide" axis="0 1 0" '
        'range="0 0.04"/></body>'
        for side in ("left", "right")
    )
    mirror = '<equality><joint joint1="left_finger" joint2="right_finger"/></equality>'
    assert Robot.from_mjcf(model(SITE + jaws, mirror), tip="tcp").dof == 6


SLIDE = '<body name="cart" pos="0.1 0 0.4" euler="0 20 0"><joint name="rail" type="slide" {}/>'


@pytest.mark.parametrize("ref", [0, 0.4, -0.2])
@pytest.mark.parametrize(("base", "root"), [(None, "stand"), ("world", "world")])
def test_a_slide_before_the_hinges_carries_the_arm(base, root, ref):
    rail = SLIDE.format(f'axis="1 2 0" pos="0.3 0.1 0" range="-0.5 2" ref="{ref}"')
    text = model(joints=rail + JOINTS + "</body>")
    robot = Robot.from_mjcf(text, base)
    assert (robot.carrier.lower, robot.carrier.upper) == (-0.5, 2)
    own = oracle(text)
    rng = np.random.default_rng(1)
    for x in (0.0, -0.5, 1.3):
        q = rng.uniform(-2, 2, (20, 6))
        names = ["rail", *robot.joint_names]
        want = poses(own, names, root, "tcp", np.column_stack([np.full(20, x), q]))
        np.testing.assert_allclose(robot.at(x).fk(q), want, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(robot.base, robot.at(0).base)


def test_a_slide_and_a_hinge_of_one_body():
    both = JOINTS.replace('<joint name="j1"', '<joint name="rail" type="slide" range="0 1"/>'
                          '<joint name="j1"')  # fmt: skip
    robot = Robot.from_mjcf(model(joints=both), "stand")
    q = np.random.default_rng(2).uniform(-2, 2, (20, 6))
    rows = np.column_stack([np.full(20, 0.3), q])
    want = poses(oracle(model(joints=both)), ["rail", *robot.joint_names], "stand", "tcp", rows)
    np.testing.assert_allclose(robot.at(0.3).fk(q), want, rtol=0, atol=1e-12)


def test_a_slide_without_a_range_or_coupled_is_refused():
    endless = fault(model(joints=SLIDE.format("") + JOINTS + "</body>"))
    assert 'joint "rail" slides from -inf to inf m' in endless
    assert 'in MJCF range="0 2.5"' in endless
    twin = SLIDE.format('range="0 1"') + JOINTS + "</body>"
    twin += '<body name="twin"><joint name="other" type="slide" range="0 1"/></body>'
    rest = '<equality><joint joint1="other" joint2="rail"/></equality>'
    assert 'joint "rail", coupled prismatic' in fault(model(joints=twin, rest=rest))


@pytest.mark.parametrize(("kind", "word"), [("slide", "prismatic"), ("ball", "ball")])
def test_joints_that_do_not_turn_about_an_axis_are_refused(kind, word):
    joint = f'<joint name="odd" type="{kind}"/>'
    words = fault(model(f'<body name="end">{joint}</body>'), None, "end")
    assert f'joint "odd" is "{word}"' in words


@pytest.mark.parametrize(
    ("rest", "words"),
    [
        ('<equality><joint joint1="j2" joint2="j3"/></equality>', "an equality acts on j2 and j3"),
        (
            '<tendon><fixed name="belt" limited="true" range="0 1"><joint joint="j5" coef="1"/>'
            '<joint joint="j6" coef="1"/></fixed></tendon>',
            "the tendon 'belt' acts on j5 and j6",
        ),
        (
            '<tendon><fixed name="belt"><joint joint="j5" coef="1"/></fixed></tendon>'
            '<equality><tendon tendon1="belt"/></equality>',
            "the tendon 'belt' acts on j5",
        ),
    ],
)
def test_couplings_of_the_arm_are_refused(rest, words):
    assert words in fault(model(rest=rest))


def test_what_couples_nothing_does_not_matter():
    rest = (
        '<tendon><fixed><joint joint="j5" coef="1"/><joint joint="j6" coef="1"/></fixed>'
        '<spatial name="rope"><site site="tcp"/><site site="camera"/></spatial></tendon>'
        '<equality><joint joint1="j2" joint2="j3" active="false"/></equality>'
        '<actuator><general tendon="rope"/></actuator><sensor><tendonpos tendon="rope"/></sensor>'
    )
    text = model(SITE + '<site name="camera"/>', rest)
    assert Robot.from_mjcf(text, tip="tcp").dof == 6


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<mujoco", "XML parse error"),
        ("<mujoco><worldbody><limb/></worldbody></mujoco>", "unrecognized element"),
        ('<robot name="a"><link name="b"/></robot>', "is a URDF: Robot.from_urdf reads it"),
        (model(joints=""), "6 or 7 revolute joints"),
        (
            '<mujoco><worldbody><replicate count="1000000000"><body><joint/></body></replicate>'
            "</worldbody></mujoco>",
            "takes more than 1 s to read",
        ),
        ("<mujoco><worldbody>" + "<body>" * 7000, "too deep"),
    ],
)
def test_broken_and_hostile_models_are_refused_in_bounded_time(text, words):
    assert words in fault(text)


def test_without_the_extra_its_name_is_in_the_error(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(ImportError, match=r"Robot.from_mjcf needs mujoco: .*irbkin\[mjcf\]"):
        Robot.from_mjcf("<mujoco/>")
