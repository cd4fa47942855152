"""`irbkin fk`: poses of joint angles."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, joints, read_robot
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.numbers import number

if TYPE_CHECKING:
    from irbkin._arrays import Floats

HELP = """Joint angles are given in degrees: as arguments, or one joint vector a row in a file.
The columns are the pose of the tool as position, quaternion and ZYX Euler angles, the confdata,
the angles, the least distance from a limit (negative outside) and its joint, and the distances
from the wrist, elbow and shoulder singularities."""
EXAMPLES = """  irbkin fk "IRB 2600-12/1.65" 0 0 0 0 30 0
  irbkin fk "IRB 2600-12/1.65" 0 0 0 0 30 0 --tool 0 0 180
  irbkin fk "IRB 120-3/0.58" joints.csv --csv > poses.csv
  irbkin fk UR5e joints.npy -o poses.npy"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    parser.add("joints", metavar="Q", nargs="+", help="joint angles [deg], or a file of rows, or -")
    parser.add_formats("poses, shape (m, 4, 4), in meters")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    from irbkin.cli.output import table
    from irbkin.cli.postures import EULER, POSE, Postures, euler_values, pose_values
    from irbkin.cli.progress import Progress

    robot = read_robot(arguments)
    given: list[str] = [word.strip() for word in arguments.joints]
    if len(given) == 1:
        from irbkin.cli.reading import read_joints

        parts = read_joints(given[0], robot.dof)
    else:
        parts = iter([_one(given, robot.dof)])
    postures = Postures(robot, with_joints=False)
    columns = (*POSE, *EULER, *postures.columns)
    with table(arguments, columns, robot.name) as rows, Progress("joint vectors") as progress:
        for q in parts:
            poses = robot.fk(q)
            rows.write([*pose_values(poses), *euler_values(poses), *postures.values(q)], poses)
            progress.add(len(q))
    return FINE


def _one(given: list[str], dof: int) -> Floats:
    """The joint vector of arguments [rad], shape (1, dof)."""
    try:
        numbers = [number(word) for word in given]
    except argparse.ArgumentTypeError as error:
        raise CommandError(f"joint angles: {error}") from None
    q = joints(numbers, "fk", dof)
    assert q is not None
    return q[None]
