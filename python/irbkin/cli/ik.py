"""`irbkin ik`: joint angles of poses."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from irbkin._arm_options import check_millimeters, frame
from irbkin.cli.arguments import Parser, joints, read_q7, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.numbers import angle, confdata, joint_and_angle, number

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.cli.output import Rows

HELP = """Without --seed and --confdata all solutions are shown, each in its slot: confdata, angles,
the least distance from a limit (negative outside) and its joint, and the distances from the wrist,
elbow and shoulder singularities. A pose is given by --xyz and an orientation, or one a row in a
file: x_mm, y_mm, z_mm and qw, qx, qy, qz or rz_deg, ry_deg, rx_deg. The exit code is 1 if a pose
has no solution inside the limits."""
EXAMPLES = """  irbkin ik "IRB 2600-12/1.65" --xyz 850 320 640 --wxyz 0.2588 0 0.9659 0
  irbkin ik "IRB 2600-12/1.65" --xyz 850 320 640 --euler 0 150 0 --seed 0 0 0 0 0 0
  irbkin ik "IRB 2600-12/1.65" poses.csv --within --csv > joints.csv
  irbkin ik Panda --xyz 400 0 500 --wxyz 0 1 0 0 --q7 45
  irbkin ik Panda --xyz 400 0 500 --wxyz 0 1 0 0 --given 3=11.5
  irbkin ik UR5e - --seed 0 -90 90 0 90 0 -o joints.npy < poses.npy"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    parser.add_rows("poses")
    add = parser.add
    add("--xyz", nargs=3, type=number, metavar=("X", "Y", "Z"), help="position of the tool [mm]")
    add("--wxyz", nargs=4, type=number, metavar=tuple("WXYZ"), help="its quaternion, w first")
    add("--xyzw", nargs=4, type=number, metavar=tuple("XYZW"), help="or w last")
    add("--euler", nargs=3, type=number, metavar=("RZ", "RY", "RX"), help="or ZYX angles [deg]")
    add("--q7", type=angle, metavar="Q7", help="angle of joint 7 of a seven-axis arm [deg]")
    add(
        "--given",
        type=joint_and_angle,
        metavar="J=Q",
        help="or of another joint of it, as 3=11.5 [deg]",
    )
    add("--within", action="store_true", help="only solutions inside the limits")
    add(
        "--seed", nargs="+", type=number, metavar="Q", help="only the nearest to these joints [deg]"
    )
    add(
        "--confdata", nargs=4, type=confdata, metavar="CF", help="only the one with cf1 cf4 cf6 cfx"
    )
    add("--arm-angle", type=angle, metavar="A", help="with --confdata of a YuMi: its eax_a [deg]")
    parser.add_formats("joint angles, shape (m, slots, n) or (m, n), in radians")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    robot = read_robot(arguments)
    if arguments.arm_angle is not None and arguments.confdata is None:
        raise CommandError("--arm-angle goes with --confdata")
    if arguments.given is not None:
        others = (arguments.q7, arguments.seed, arguments.confdata)
        if any(other is not None for other in others):
            raise CommandError("--given goes without --q7, --seed and --confdata")
        if robot.dof != 7:
            raise CommandError(f"--given is for arms of seven joints, {robot.name} has {robot.dof}")
    poses, heading = _poses(arguments, robot)
    if arguments.seed is not None and arguments.confdata is not None:
        raise CommandError("--seed and --confdata: give one of them")
    if arguments.seed is not None or arguments.confdata is not None:
        return _write_one(arguments, robot, poses, heading)
    return _write_all(arguments, robot, poses, heading)


def _poses(arguments: argparse.Namespace, robot: Robot) -> tuple[Iterator[Floats], str]:
    """The poses in parts, and the words before the table."""
    if (arguments.file is None) == (arguments.xyz is None):
        raise CommandError("give a pose by --xyz, or a FILE of poses (irbkin ik --help)")
    if arguments.file is not None:
        from irbkin.cli.reading import read_poses

        return read_poses(arguments.file), robot.name
    if sum(it is not None for it in (arguments.wxyz, arguments.xyzw, arguments.euler)) > 1:
        raise CommandError("--wxyz, --xyzw and --euler: give one of them")
    if arguments.xyzw is not None:
        *vector, w = arguments.xyzw
        arguments.wxyz = [w, *vector]
    check_millimeters(arguments.xyz, "--xyz")
    turn = arguments.wxyz or arguments.euler or []
    one = frame([*arguments.xyz, *turn], "--wxyz" if arguments.wxyz else "--euler")[None]
    x, y, z = arguments.xyz
    name = "wxyz" if arguments.wxyz else "rz ry rx"
    words = f", {name} {' '.join(f'{number:g}' for number in turn)}" if turn else ""
    return iter([one]), f"{robot.name}: tool at {x:g} {y:g} {z:g} mm{words}"


class Missed:
    """Poses without a solution inside the limits; `reason` says why one has none."""

    def __init__(self, reason: Callable[[Floats], str]) -> None:
        self.reason = reason
        self.rows = 0
        self.count = 0
        self.first: tuple[int, Floats] | None = None

    def add(self, poses: Floats, is_met: npt.ArrayLike) -> None:
        """Some poses, and which have one."""
        import numpy as np

        wrong = np.flatnonzero(~np.asarray(is_met))
        if len(wrong) and self.first is None:
            self.first = (self.rows + int(wrong[0]), poses[wrong[0]])
        self.rows += len(poses)
        self.count += len(wrong)

    def note(self, rows: Rows) -> None:
        """Add the reason to the rows of a format that has room for it."""
        if self.first is not None:
            rows.note("reason", self.words(), "")

    def words(self) -> str:
        """What is missing, and why."""
        assert self.first is not None
        row, pose = self.first
        why = self.reason(pose)
        if self.rows == 1:
            nothing = "no solution inside the limits"
            return why if why.startswith(nothing) else f"{nothing}: {why}"
        return (
            f"{self.count} of {self.rows} poses have no solution inside the limits; "
            f"the first is pose {row}: {why}"
        )

    def code(self) -> int:
        """The exit code, with a word on stderr."""
        if self.first is None:
            return FINE
        complain(self.words())
        return FOUND


def _write_all(
    arguments: argparse.Namespace,
    robot: Robot,
    parts: Iterator[Floats],
    heading: str,
) -> int:
    """All solutions, a row each; the exit code."""
    import numpy as np

    from irbkin import Status
    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures
    from irbkin.cli.progress import Progress

    postures = Postures(robot)
    is_one = arguments.file is None
    first = () if is_one else (Column("pose", "", "6d"),)
    columns = (*first, Column("slot", "", "d"), *postures.columns)
    if arguments.given is None:
        q7 = read_q7(arguments, robot)
    else:
        joint, degrees = arguments.given
        q7, robot = None, robot.locked({joint: np.radians(degrees)})

    def reason(pose: Floats) -> str:
        if robot.dof == 6:
            return robot.check_pose(pose).reason
        return robot.ik(pose, q7).explain()

    missed, uncertain = Missed(reason), 0
    wanted = int(Status.WITHIN_LIMITS if arguments.within else Status.FOUND)
    with table(arguments, columns, heading) as rows, Progress("poses") as progress:
        for poses in parts:
            found = robot.ik_batch(poses, q7)
            is_within = (found.status & int(Status.WITHIN_LIMITS)).astype(bool)
            index, slot = (found.status & wanted).nonzero()
            q = found.q[index, slot]
            numbers = [] if is_one else [index + missed.rows]
            array = np.where((found.status & wanted)[..., None] != 0, found.q, np.nan)
            rows.write([*numbers, slot, *postures.values(q)], array)
            missed.add(poses, is_within.any(axis=1))
            is_uncertain = found.status & int(Status.UNCERTIFIED) != 0
            uncertain += int(is_uncertain.any(axis=1).sum())
            progress.add(len(poses))
            if is_one:
                for solution in robot.ik(poses[0], q7):
                    if free := solution.free_joint:
                        verb = "are" if "," in free.fixed else "is"
                        words = (
                            f"slot {solution.slot}: J{free.joint} is free, "
                            f"{free.fixed} {verb} fixed"
                        )
                        rows.note(f"free_joint_of_slot_{solution.slot}", free.joint, words)
        if uncertain:
            of = "" if is_one else f"of {uncertain} of {missed.rows} poses "
            words = f"{of}there may be more solutions: their number is not certified"
            rows.note("uncertified", uncertain, words)
        missed.note(rows)
    return missed.code()


def _write_one(
    arguments: argparse.Namespace,
    robot: Robot,
    parts: Iterator[Floats],
    heading: str,
) -> int:
    """One solution of each pose, a row each; the exit code."""
    import numpy as np

    from irbkin import UnreachableError
    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures
    from irbkin.cli.progress import Progress

    postures = Postures(robot)
    seed = joints(arguments.seed, "--seed", robot.dof)
    columns = (Column("pose", "", "6d"), *postures.columns)
    arm_angle = None if arguments.arm_angle is None else np.radians(arguments.arm_angle)
    if seed is None:
        heading = f"{heading}, confdata {arguments.confdata}"
        _check_arm_angle(arguments, robot)

    def solve(poses: Floats) -> Floats:
        if seed is not None:
            return robot.ik_nearest(poses, seed)
        return robot.ik_configured(poses, arguments.confdata, arm_angle=arm_angle)

    def reason(pose: Floats) -> str:
        try:
            solve(pose)
        except UnreachableError as error:
            return str(error)
        return robot.check_pose(pose).reason

    missed = Missed(reason)
    with table(arguments, columns, heading) as rows, Progress("poses") as progress:
        for poses in parts:
            q = solve(poses)
            rows.write([np.arange(len(q)) + missed.rows, *postures.values(q)], q)
            missed.add(poses, np.isfinite(q).all(axis=1))
            progress.add(len(poses))
        missed.note(rows)
    return missed.code()


def _check_arm_angle(arguments: argparse.Namespace, robot: Robot) -> None:
    """A YuMi takes an arm angle with a confdata, other arms take none."""
    import numpy as np

    # Refused for an arm without confdata.
    robot.configuration(np.zeros(robot.dof))
    if robot.dof == 7 and arguments.arm_angle is None:
        raise CommandError(f"{robot.name} has seven joints: give --arm-angle with --confdata")
    if robot.dof != 7 and arguments.arm_angle is not None:
        raise CommandError(f"--arm-angle is for arms of seven joints, {robot.name} has {robot.dof}")
