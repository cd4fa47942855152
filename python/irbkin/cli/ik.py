"""Without --seed and --confdata all solutions are shown, each in its slot. A pose is a robtarget or
pose of RAPID, --xyz and an orientation, or one a row in a file: x_mm, y_mm, z_mm and qw, qx, qy, qz
or rz_deg, ry_deg, rx_deg. The exit code is 1 if a pose has no solution inside the limits.

Examples:
  irbkin ik "IRB 2600-12/1.65" --xyz 850 320 640 --euler 0 150 0 --seed 0 0 0 0 0 0
  irbkin ik "IRB 2600-12/1.65" "CONST pose p10 := [[850,320,640],[0.2588,0,0.9659,0]];"
  irbkin ik "IRB 2600-12/1.65" poses.csv --within --csv > joints.csv
  irbkin ik Panda --xyz 400 0 500 --wxyz 0 1 0 0 --q7 45
  irbkin ik UR5e - --seed 0 -90 90 0 90 0 -o joints.npy < poses.npy
"""

import argparse
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from irbkin import Robot, Status, UnreachableError
from irbkin.cli.arguments import Parser, joints, pose_of, read_pose, read_robot, read_wobj
from irbkin.cli.data import is_data
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.numbers import angle, confdata, number
from irbkin.cli.output import Column, Columns, Floats, table
from irbkin.cli.postures import has_confdata, posture_columns, word_columns
from irbkin.cli.progress import Progress
from irbkin.cli.reading import Part, read_poses


def add_arguments(parser: Parser) -> None:
    add = parser.add
    parser.add_robot()
    parser.add_wobj()
    words = "poses: a CSV or .npy file, - for stdin, or robtargets of RAPID"
    add("file", metavar="FILE", nargs="*", help=words)
    add("--xyz", nargs=3, type=number, metavar=(*"XYZ",), help="position of the tool [mm]")
    add("--wxyz", nargs=4, type=number, metavar=(*"WXYZ",), help="its quaternion")
    turn = ("RZ", "RY", "RX")
    add("--euler", nargs=3, type=number, metavar=turn, help="or ZYX angles [deg]")
    add("--q7", type=angle, metavar="Q7", help="angle of joint 7 of a seven-axis arm [deg]")
    add("--within", action="store_true", help="only solutions inside the limits")
    parser.add_joints("seed", "only the nearest to these joints [deg]")
    add("--confdata", nargs=4, type=confdata, metavar="CF", help="only with cf1 cf4 cf6 cfx")
    add("--arm-angle", type=angle, metavar="A", help="with --confdata of a YuMi: its eax_a [deg]")
    parser.add_formats("joint angles, shape (m, slots, n) or (m, n), in radians")


def run(arguments: argparse.Namespace) -> int:
    robot = read_robot(arguments)
    _check(arguments, robot)
    parts, heading = _poses(arguments)
    wobj, count, missed, words = read_wobj(arguments), 0, 0, ""
    first: tuple[int, Floats] | None = None
    own = arguments.confdata
    is_all = arguments.seed is None and own is None
    find = (_All if is_all else _One)(arguments, robot, is_one=bool(heading))
    heading = f"{robot.name}{heading}" + ("" if own is None else f", confdata {own}")
    with table(arguments, heading) as rows, Progress("poses") as progress:
        for part in parts:
            world = wobj @ part.values
            columns, q, is_met = find.solve(part, world, count)
            rows.write(columns, q)
            if first is None and not is_met.all():
                at = int(is_met.argmin())
                first = count + at, world[at]
            count, missed = count + len(world), missed + int((~is_met).sum())
            progress.add(len(world), part.total)
        rows.notes += find.notes(count)
        if first is not None:
            words = find.words(first, missed, count)
            rows.notes.append(("reason", words, ""))
    if words:
        complain(words)
    return FOUND if words else FINE


def _check(arguments: argparse.Namespace, robot: Robot) -> None:
    seed, own, arm_angle = (
        getattr(arguments, name) is not None for name in ("seed", "confdata", "arm_angle")
    )
    if arm_angle and not own:
        raise CommandError("--arm-angle goes with --confdata")
    if seed and own:
        raise CommandError("--seed and --confdata: give one of them")
    is_all = not (seed or own)
    if robot.dof != 7:
        q7 = is_all and arguments.q7 is not None
        for name in ("arm-angle",) * arm_angle + ("q7",) * q7:
            words = f"--{name} is for arms of seven joints, {robot.name} has {robot.dof}"
            raise CommandError(words)
    elif is_all and arguments.q7 is None:
        raise CommandError(f"{robot.name} has seven joints: give --q7, the angle of joint 7 [deg]")
    if own:
        # Refused for an arm without confdata.
        robot.configuration(np.zeros(robot.dof))
        if robot.dof == 7 and not arm_angle:
            raise CommandError(f"{robot.name} has seven joints: give --arm-angle with --confdata")


def _poses(arguments: argparse.Namespace) -> tuple[Iterator[Part], str]:
    """The poses in parts, and what the heading says of a single one."""
    words: list[str] = [word.strip() for word in arguments.file]
    if bool(words) == (arguments.xyz is not None):
        ways = "by --xyz, as a robtarget, or a FILE of poses"
        raise CommandError(f"give a pose {ways} (irbkin ik --help)")
    try:
        own = [number(word) for word in words]
        pose, heading = pose_of(own, "the pose") if own else read_pose(arguments)
        return iter([Part(pose[None])]), f": {heading}"
    except argparse.ArgumentTypeError:
        parts = read_poses(words)
    if not is_data(words[0]):
        return parts, ""
    part = next(parts)
    if len(part.targets) > 1:
        return iter([part]), ""
    (target,), (name,) = part.targets, part.names.get("name", ["tool"])
    xyz, wxyz = (" ".join(f"{it:g}" for it in own) for own in (target.trans_mm, target.rot))
    return iter([part._replace(names={})]), f": {name} at {xyz} mm, wxyz {wxyz}"


class _All:
    def __init__(self, arguments: argparse.Namespace, robot: Robot, *, is_one: bool) -> None:
        self.robot, self.is_one = robot, is_one
        self.q7 = None if arguments.q7 is None else math.radians(arguments.q7)
        self.wanted = int(Status.WITHIN_LIMITS if arguments.within else Status.FOUND)
        self.uncertain = 0
        self.said: list[tuple[str, Any, str]] = []

    def reason(self, pose: Floats) -> str:
        if self.robot.dof == 6:
            return self.robot.check_pose(pose).reason
        return self.robot.ik(pose, self.q7).explain()

    def solve(self, part: Part, poses: Floats, before: int) -> tuple[Columns, Floats, Any]:
        robot, found = self.robot, self.robot.ik_batch(poses, self.q7)
        is_wanted = (found.status & self.wanted) != 0
        index, slot = is_wanted.nonzero()
        names = {name: [own[at] for at in index] for name, own in part.names.items()}
        taken = self.slots(part, poses, found.q)
        columns = {
            **({} if self.is_one else {Column("pose", "6d"): index + before}),
            **word_columns(names),
            Column("slot"): slot,
            **{Column("confdata", "<8s"): np.where(slot == it[index], "yes", "") for it in taken},
            **posture_columns(robot, found.q[index, slot]),
        }
        self.uncertain += int((found.status & int(Status.UNCERTIFIED) != 0).any(axis=1).sum())
        for solution in robot.ik(poses[0], self.q7) if self.is_one else ():
            if free := solution.free_joint:
                verb = "are" if "," in free.fixed else "is"
                words = f"slot {solution.slot}: J{free.joint} is free, {free.fixed} {verb} fixed"
                self.said.append((f"free_joint_of_slot_{solution.slot}", free.joint, words))
        is_met = (found.status & int(Status.WITHIN_LIMITS) != 0).any(axis=1)
        return columns, np.where(is_wanted[..., None], found.q, np.nan), is_met

    def slots(self, part: Part, poses: Floats, q: Floats) -> list[Any]:
        """The slots of robtargets by their confdata, -1 where none has it; nothing if unknown."""
        targets = [it for it in part.targets if hasattr(it, "robconf")]
        if len(targets) != len(poses) or self.robot.dof != 6 or not has_confdata(self.robot):
            return []
        own = self.robot.ik_configured(poses, [it.robconf for it in targets])
        off = np.abs((q - own[:, None] + np.pi) % (2 * np.pi) - np.pi).max(axis=2)
        off = np.where(np.isfinite(off), off, np.inf)
        if lacking := int(np.isnan(own[:, 0]).sum()):
            of = f"{lacking} of {len(own)} robtargets have" if len(own) > 1 else "the robtarget has"
            words = f"{of} no solution inside the limits with the confdata"
            self.said.append(("without_confdata", lacking, words))
        return [np.where(off.min(axis=1) < 1e-6, off.argmin(axis=1), -1)]

    def notes(self, rows: int) -> list[tuple[str, Any, str]]:
        of = "" if self.is_one else f"of {self.uncertain} of {rows} poses "
        words = f"{of}there may be more solutions: their number is not certified"
        return self.said + [("uncertified", self.uncertain, words)] * (self.uncertain > 0)

    def words(self, first: tuple[int, Floats], missed: int, rows: int) -> str:
        """How many poses have no solution, and why."""
        (row, pose), nothing = first, "no solution inside the limits"
        why = self.reason(pose)
        if rows == 1:
            return why if why.startswith(nothing) else f"{nothing}: {why}"
        return f"{missed} of {rows} poses have {nothing}; the first is pose {row}: {why}"


class _One(_All):
    def __init__(self, arguments: argparse.Namespace, robot: Robot, *, is_one: bool) -> None:
        self.robot, self.said, self.uncertain, self.is_one = robot, [], 0, is_one
        seed, own = joints(arguments.seed, "--seed", robot.dof), arguments.confdata
        arm_angle = None if arguments.arm_angle is None else np.radians(arguments.arm_angle)
        self.joints: Callable[[Floats], Floats] = lambda poses: (
            robot.ik_configured(poses, own, arm_angle=arm_angle)
            if seed is None
            else robot.ik_nearest(poses, seed)
        )

    def reason(self, pose: Floats) -> str:
        try:
            self.joints(pose)
        except UnreachableError as error:
            return str(error)
        return self.robot.check_pose(pose).reason

    def solve(self, part: Part, poses: Floats, before: int) -> tuple[Columns, Floats, Any]:
        q = self.joints(poses)
        pose = {Column("pose", "6d"): np.arange(len(q)) + before}
        columns = {**pose, **word_columns(part.names), **posture_columns(self.robot, q)}
        return columns, q, np.isfinite(q).all(axis=1)
