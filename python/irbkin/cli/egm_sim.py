"""A model of an ABB controller on this machine: it sends its joints each 4.032 ms by UDP, as EGM
does, and follows the set points that answer, until --seconds or Ctrl-C. What changes is printed
with its time. From ABB's manual: the messages, the states, speed = gain (reference - position) +
speed reference, CommTimeout. Assumed: the lag, the filter, the ramps, and a drive that follows
ideally. It is no test of a real controller (docs/guide/egm.md).

Examples:
  irbkin egm-sim "IRB 2600-12/1.65" --joints 0 0 0 0 30 0
  irbkin egm-sim "IRB 2600-12/1.65" --loss 0.1 --late 0.05 --cut 6 7.5 --seconds 10
"""

import argparse
import math

import numpy as np

from irbkin.cli.arguments import Parser, joints, read_robot
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.numbers import number

RATES = ("loss", "late")


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    add = parser.add
    parser.add_joints("joints", "where it starts [deg]; zeros, moved inside the limits")
    add("--host", default="127.0.0.1", metavar="HOST", help="of the server: this machine")
    add("--port", type=int, default=6510, metavar="PORT", help="of the server: 6510")
    add("--seconds", type=number, default=math.inf, metavar="S", help="end after it")
    add("--loss", type=number, default=0.0, metavar="P", help="share of datagrams that are lost")
    add("--late", type=number, default=0.0, metavar="P", help="that come late, behind others")
    add("--cut", nargs=2, type=number, metavar=("FROM", "TO"), help="all are lost between [s]")
    add("--seed", type=int, default=0, metavar="N", help="of what is lost")


def run(arguments: argparse.Namespace) -> int:
    from irbkin.stream import egm

    for name in RATES:
        value = getattr(arguments, name)
        if not 0.0 <= value <= 1.0:
            raise CommandError(f"--{name} is {value:g}, it must be 0 to 1")
    if not 0 < arguments.port < 65_536:
        raise CommandError(f"--port is {arguments.port}, it must be 1 to 65535")
    robot = read_robot(arguments)
    q = joints(arguments.joints, "--joints", robot.dof)
    if q is None:
        q = np.clip(np.zeros(robot.dof), *robot.limits.T)
    controller = egm.Controller(robot, q)
    where = (arguments.host, arguments.port)
    options = {name: getattr(arguments, name) for name in ("seconds", "cut", "seed", *RATES)}
    egm.play(controller, where, lambda line: print(line, flush=True), **options)
    print("joints [deg]", *(f"{angle:.3f}" for angle in np.degrees(controller.q) + 0.0))
    return FINE
