"""Position, quaternion and ZYX Euler angles of the tool, confdata, the least distance from a limit
(negative outside) and its joint, the distances from wrist, elbow and shoulder singularities.

Examples:
  irbkin fk "IRB 2600-12/1.65" 0 0 0 0 30 0 --tool 0 0 180
  irbkin fk "IRB 120-3/0.58" joints.csv --csv > poses.csv
  irbkin fk "IRB 120-3/0.58" "CONST jointtarget j1 := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"
"""

import argparse

import numpy as np

from irbkin.cli.arguments import Parser, joints, read_robot, read_wobj
from irbkin.cli.data import is_data
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.numbers import number
from irbkin.cli.output import table
from irbkin.cli.postures import pose_columns, posture_columns, word_columns
from irbkin.cli.progress import Progress
from irbkin.cli.reading import Part, read_joints


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    parser.add_wobj()
    parser.add("joints", metavar="Q", nargs="+", help="joints [deg], a jointtarget, a file, or -")
    parser.add_formats("poses, shape (m, 4, 4), in meters")


def run(arguments: argparse.Namespace) -> int:
    robot = read_robot(arguments)
    words: list[str] = [word.strip() for word in arguments.joints]
    is_read = len(words) == 1 or is_data(words[0])
    parts = read_joints(words, robot.dof) if is_read else iter([_one(words, robot.dof)])
    to_wobj = np.linalg.inv(read_wobj(arguments))
    with table(arguments, robot.name) as rows, Progress("joint vectors") as progress:
        for part in parts:
            world = robot.fk(part.values)
            postures = posture_columns(robot, part.values, with_joints=False)
            poses = to_wobj @ world if arguments.wobj else world
            rows.write({**word_columns(part.names), **pose_columns(poses), **postures}, poses)
            progress.add(len(poses), part.total)
    return FINE


def _one(words: list[str], dof: int) -> Part:
    """The joint vector of arguments [rad], shape (1, dof)."""
    try:
        q = joints([number(word) for word in words], "fk", dof)
    except argparse.ArgumentTypeError as error:
        raise CommandError(f"joint angles: {error}") from None
    assert q is not None
    return Part(q[None])
