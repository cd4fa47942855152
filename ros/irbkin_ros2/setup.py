"""The ament_python package of the ROS 2 node."""

from setuptools import setup

NAME = "irbkin_ros2"

setup(
    name=NAME,
    version="0.1.0",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/launch", ["launch/kinematics.launch.xml"]),
    ],
    entry_points={"console_scripts": [f"kinematics = {NAME}.node:main"]},
)
