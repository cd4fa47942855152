"""Axes, origins, limits and velocities, with the frames flange and tool0, in meters and
radians, as URDF has them.

Examples:
  irbkin urdf "IRB 2600-12/1.65" > irb2600.urdf
  irbkin urdf "IRB 2600-12/1.65" -o irb2600.urdf
"""

import argparse

from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE
from irbkin.cli.files import put_text


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    parser.add("-o", "--output", metavar="FILE", help="write to a file")


def run(arguments: argparse.Namespace) -> int:
    put_text(arguments.output, read_robot(arguments).to_urdf())
    return FINE
