"""The picture of `irbkin view`: the arm at --joints, or at rest.

Examples:
  irbkin plot "IRB 2600-12/1.65" -o arm.svg
  irbkin plot UR5e --joints 0 -90 90 0 90 0 -o arm.svg
"""

import argparse

from irbkin import scene
from irbkin.cli.arguments import Parser, joints, read_robot
from irbkin.cli.errors import FINE, CommandError


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    parser.add_joints("joints", "joint angles [deg]")
    parser.add("-o", "--output", metavar="FILE", help="the picture (.svg)")


def run(arguments: argparse.Namespace) -> int:
    output: str = arguments.output or ""
    if not output.lower().endswith(".svg"):
        raise CommandError(f"--output is {output!r}, it must be a FILE that ends in .svg")
    robot = read_robot(arguments)
    scene.of(robot, q=joints(arguments.joints, "--joints", robot.dof)).save(output)
    return FINE
