"""`irbkin urdf`: an arm as URDF."""

from __future__ import annotations

import argparse

from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE

HELP = """Axes, origins, limits and velocities, with the frames flange and tool0, in meters and
radians, as URDF has them."""
EXAMPLES = """  irbkin urdf "IRB 2600-12/1.65" > irb2600.urdf
  irbkin urdf "IRB 2600-12/1.65" -o irb2600.urdf"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    parser.add("-o", "--output", metavar="FILE", help="write to a file")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    text: str = read_robot(arguments).to_urdf()
    if arguments.output in (None, "-"):
        print(text, end="" if text.endswith("\n") else "\n")
        return FINE
    from irbkin.cli.files import replaced

    with replaced(arguments.output) as file:
        file.write(text.encode())
    return FINE
