"""The parameters, names and packages of the nodes."""

import array
import re
from pathlib import Path
from xml.etree import ElementTree

import irbkin
import numpy as np
import pytest
from irbkin import IrbkinError, Robot, ros

ROOT = Path(__file__).parents[2] / "ros"
ROBOT = Robot("IRB 1600-6/1.45")
Q = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])


def test_parameters_make_the_same_node():
    tool = [0.1, 0.0, 0.2, 0.0, 0.0, 1.0, 0.0]
    kinematics = ros.kinematics_of(
        {
            "robot": "irb 1600 6/1.45",
            "robot_description": "",
            "tool": array.array("d", tool),
            "base_frame": "cell",
            "joint_names": tuple("abcdef"),
            "start": [0, 1, 0, 0, 0, 0],
            "weights": None,
            "max_acceleration": [8] * 6,
        }
    )
    assert kinematics.robot == ROBOT.with_tool(irbkin.pose(tool[:3], xyzw=tool[3:]))
    assert kinematics.base_frame == "cell"
    assert kinematics.joint_names == list("abcdef")
    np.testing.assert_array_equal(kinematics.last, [0, 1, 0, 0, 0, 0])


def test_a_urdf_is_a_robot_whose_joints_it_names(tmp_path):
    text = ROBOT.to_urdf()
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    for description in (text, str(path)):
        values = {"robot_description": description, "joint_names": list("abcdef")}
        kinematics = ros.kinematics_of(values)
        np.testing.assert_allclose(kinematics.robot.fk(Q), ROBOT.fk(Q), atol=1e-14)
    own = ros.kinematics_of({"robot_description": text.replace("joint_4", "elbow")})
    assert own.joint_names == ["joint_1", "joint_2", "joint_3", "elbow", "joint_5", "joint_6"]
    flange = ros.kinematics_of({**values, "tip_link": "flange"})
    assert not np.allclose(flange.robot.fk(Q)[:3, :3], ROBOT.fk(Q)[:3, :3])


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({}, 'robot is empty: give a catalog name such as "IRB 1600-6/1.45"'),
        ({"robot": "IRB 1600"}, 'close names: "IRB 1600-6/1.2"'),
        ({"robot": 1600}, "robot is 1600, it must be a text"),
        ({"robot": "UR5", "robot_description": "<robot/>"}, "robot and robot_description are both"),
        ({"robot_description": "no.urdf"}, "robot_description: [Errno 2] No such file"),
        ({"robot": "UR5e", "weights": [-1.0] * 6}, "weights[0] is -1.0, it must be 0 or more"),
        ({"robot": "UR5", "tool": [1.0, 2.0]}, "tool must have shape (7,), got (2,)"),
        ({"robot": "UR5", "tool": [0.0] * 7}, "quaternion norm is 0.000000"),
        ({"robot": "UR5", "start": "zero"}, "start is 'zero', it must be an array of numbers"),
        ({"robot": "UR5", "start": ["a"] * 6}, "it must be an array of numbers"),
        ({"robot": "UR5", "start": [True] * 6}, "it must be an array of numbers"),
        ({"robot": "UR5", "joint_names": "abc"}, "joint_names is 'abc', it must be an array of te"),
        (
            {"robot": "UR5", "service_prefix": "my robot"},
            "service_prefix is 'my robot', it must be",
        ),
        ({"robot": "UR5", "service_prefix": "5axes"}, "service_prefix is '5axes', it must be"),
        ({"robot": "UR5", "joint_names": [1, 2]}, "it must be an array of texts"),
    ],
)
def test_wrong_parameters_are_named(values, words):
    with pytest.raises(IrbkinError) as refused:
        ros.kinematics_of(values)
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("name", "prefix"),
    [
        ("IRB 1600-6/1.45", "irb1600_kinematics"),
        ("IRB 2600ID-15/1.85", "irb2600id_kinematics"),
        ("UR5e", "ur5e_kinematics"),
        ("UR8 Long", "ur8long_kinematics"),
        ("Panda", "panda_kinematics"),
        ("2600", "robot2600_kinematics"),
        ("", "robot_kinematics"),
        ("ロボット", "robot_kinematics"),
        ("abb_irb2400", "abb_irb2400_kinematics"),
    ],
)
def test_services_are_named_after_the_robot(name, prefix):
    robot = Robot.from_mdh(ROBOT.mdh, name=name)
    assert ros.service_prefix(robot) == prefix
    assert re.fullmatch("[a-z][a-z0-9_]*", prefix)


def test_every_arm_of_the_catalog_has_a_name_for_its_services():
    prefixes = {ros.service_prefix(Robot(name)) for name in irbkin.catalog()}
    assert len(prefixes) > 50
    assert all(re.fullmatch("[a-z][a-z0-9_]*", prefix) for prefix in prefixes)


@pytest.mark.parametrize("name", ["IRB 1600-6/1.45", "IRB 2400-10/1.55", "Panda"])
def test_joints_have_the_names_that_a_description_gives_them(name):
    robot = Robot(name)
    joints = ElementTree.fromstring(robot.to_urdf()).iter("joint")
    names = [
        joint.get("name")
        for joint in joints
        if joint.get("type") == "revolute" and joint.find("mimic") is None
    ]
    assert ros.Kinematics(robot).joint_names == names


@pytest.mark.parametrize(
    "file",
    ["irbkin_ros1/launch/kinematics.launch", "irbkin_ros2/launch/kinematics.launch.xml"],
)
def test_launch_files_set_parameters_that_exist(file):
    launch = ElementTree.parse(ROOT / file)
    names = {parameter.name for parameter in ros.PARAMETERS}
    set_ = [param.get("name") for param in launch.iter("param")]
    assert "robot" in set_
    assert set(set_) <= names
    [node] = launch.iter("node")
    package = node.get("pkg")
    assert ElementTree.parse(ROOT / package / "package.xml").findtext("name") == package


def test_packages_have_the_version_of_irbkin():
    for package in ROOT.glob("*/package.xml"):
        assert ElementTree.parse(package).findtext("version") == irbkin.__version__
    setup = (ROOT / "irbkin_ros2/setup.py").read_text()
    assert f'version="{irbkin.__version__}"' in setup
