"""`irbkin plot`: pictures."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from irbkin._arm_options import frame
from irbkin.cli.arguments import Parser, read_q7, read_robot
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.files import replaced
from irbkin.cli.numbers import angle, number

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from irbkin import Robot

HELP = """solutions: the arm in every solution of a pose. path: the tool along joint vectors.
singularity: how far joint vectors are from the singularities. reach: where a tool of one
orientation can be. The format is by the ending of the file: .svg, .png, .pdf. This verb needs
matplotlib: pip install 'irbkin[plot]'."""
EXAMPLES = """  irbkin plot "IRB 2600-12/1.65" solutions --xyz 850 320 640 --euler 0 150 0 -o ik.svg
  irbkin plot "IRB 2600-12/1.65" path joints.csv -o path.svg
  irbkin plot "IRB 2600-12/1.65" singularity joints.npy -o singularity.png
  irbkin plot "IRB 2600-12/1.65" reach --euler 0 180 0 -o reach.svg"""
KINDS = ("solutions", "path", "singularity", "reach")


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    add = parser.add
    add("kind", choices=KINDS, help="what to draw")
    parser.add_rows("joint angles of path and singularity")
    add("--xyz", nargs=3, type=number, metavar=("X", "Y", "Z"), help="position of the tool [mm]")
    add("--wxyz", nargs=4, type=number, metavar=tuple("WXYZ"), help="its quaternion, w first")
    add("--euler", nargs=3, type=number, metavar=("RZ", "RY", "RX"), help="or ZYX angles [deg]")
    add("--q7", type=angle, metavar="Q7", help="angle of joint 7 of a seven-axis arm [deg]")
    add("-o", "--output", metavar="FILE", required=True, help="the picture: .svg, .png, .pdf")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    robot = read_robot(arguments)
    ending = os.path.splitext(arguments.output)[1].lstrip(".").lower()
    if not ending:
        raise CommandError(f"{arguments.output}: has no ending; give .svg, .png or .pdf")
    figure = _drawn(arguments, robot)
    known = figure.canvas.get_supported_filetypes()
    if ending not in known:
        raise CommandError(f"{arguments.output}: .{ending} is not among {', '.join(sorted(known))}")
    with replaced(arguments.output) as file:
        figure.savefig(file, format=ending)
    return FINE


def _drawn(arguments: argparse.Namespace, robot: Robot) -> Figure:
    from irbkin import plot

    kind: str = arguments.kind
    if kind in ("solutions", "reach"):
        q7 = read_q7(arguments, robot)
        if arguments.xyz is None and kind == "solutions":
            raise CommandError("solutions takes a pose: --xyz and --wxyz or --euler")
        turn = arguments.wxyz or arguments.euler or []
        name = "--wxyz" if arguments.wxyz else "--euler"
        pose = frame([*(arguments.xyz or (0, 0, 0)), *turn], name)
        if kind == "solutions":
            return plot.solutions(robot, pose, q7=q7)
        return plot.reach(robot, pose, q7=q7)
    if arguments.file is None:
        raise CommandError(f"{kind} takes a FILE of joint angles")
    from irbkin.cli.reading import read_all, read_joints

    q = read_all(read_joints(arguments.file, robot.dof))
    return plot.path(robot.fk(q)) if kind == "path" else plot.singularity(robot, q)
