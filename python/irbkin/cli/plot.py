"""arm: the arm at --joints, or at rest. solutions: the arm in every solution of a pose. path: the
tool along joint vectors. singularity: how far joint vectors are from the singularities. reach:
where a tool of one orientation can be. The format is by the ending of the file: .svg, .png, .pdf;
without one it is a picture that is opened. This verb needs matplotlib: pip install 'irbkin[plot]'.

Examples:
  irbkin plot "IRB 2600-12/1.65" -o arm.svg
  irbkin plot "IRB 2600-12/1.65" solutions --xyz 850 320 640 --euler 0 150 0 -o ik.svg
  irbkin plot "IRB 2600-12/1.65" reach --euler 0 180 0 -o reach.svg
"""

import argparse
import os
import tempfile
import webbrowser
from typing import TYPE_CHECKING

from irbkin import Robot
from irbkin.cli.arguments import Parser, joints, read_pose, read_q7, read_robot
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.files import replaced
from irbkin.cli.reading import read_all, read_joints

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KINDS = ("arm", "solutions", "path", "singularity", "reach")


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    parser.add("kind", choices=KINDS, nargs="?", default="arm", help="what to draw: arm")
    parser.add_rows("joint angles of path and singularity", "jointtargets")
    parser.add_joints("joints", "joint angles of the arm [deg]")
    parser.add_pose()
    parser.add("-o", "--output", metavar="FILE", help="the picture: .svg, .png, .pdf")


def run(arguments: argparse.Namespace) -> int:
    robot = read_robot(arguments)
    path: str = arguments.output or os.path.join(tempfile.mkdtemp(prefix="irbkin-"), "arm.svg")
    ending = os.path.splitext(path)[1].lstrip(".").lower()
    if not ending:
        raise CommandError(f"{path}: has no ending; give .svg, .png or .pdf")
    figure = _drawn(arguments, robot)
    known = figure.canvas.get_supported_filetypes()
    if ending not in known:
        raise CommandError(f"{path}: .{ending} is not among {', '.join(sorted(known))}")
    with replaced(path) as file:
        figure.savefig(file, format=ending)
    if arguments.output is None:
        print(path)
        webbrowser.open(f"file://{path}")
    return FINE


def _drawn(arguments: argparse.Namespace, robot: Robot) -> "Figure":
    from irbkin import plot

    kind: str = arguments.kind
    if kind == "arm":
        return plot.arm(robot, joints(arguments.joints, "--joints", robot.dof))
    if kind in ("solutions", "reach"):
        q7 = read_q7(arguments, robot)
        if arguments.xyz is None and kind == "solutions":
            raise CommandError("solutions takes a pose: --xyz and --wxyz or --euler")
        pose, _ = read_pose(arguments)
        draw = plot.solutions if kind == "solutions" else plot.reach
        return draw(robot, pose, q7=q7)
    if not arguments.file:
        raise CommandError(f"{kind} takes a FILE of joint angles")
    q = read_all(read_joints(arguments.file, robot.dof))
    return plot.path(robot.fk(q)) if kind == "path" else plot.singularity(robot, q)
