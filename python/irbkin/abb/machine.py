"""MOC.cfg as a machine: its robots with base frames and limits, its external units."""

import math
from functools import cached_property

from irbkin import Robot, pose
from irbkin.abb.arms import Fitted, fitted
from irbkin.abb.carriers import Machine, check_carriers, related
from irbkin.abb.cfg import CfgFile, Instance
from irbkin.abb.findings import Finding, Severity
from irbkin.abb.units import AXES, ExternalAxis, ExternalUnit, Pose, RobotUnit, UnitKind

FIRST_LOGICAL_AXIS = 7
"""The logical axis of eax_a."""


class _Reader:
    def __init__(self, moc: CfgFile, wording: tuple[str, ...]) -> None:
        self.moc = moc
        self.wording = wording
        self.findings: list[Finding] = []

    def report(self, line: int, code: str, severity: Severity, message: str) -> None:
        self.findings.append(Finding(self.moc.file, line, code, severity, message))

    def arm_of(self, joint: str) -> Instance | None:
        """Return the ARM of a joint: by JOINT, by its own name, or by its arm type."""
        named = self.moc.named("JOINT", joint)
        arm = named.text("use_arm", joint) if named else joint
        named_arm = self.moc.named("ARM", arm) or self.moc.named("ARM", joint)
        # Of a track: joint "track1", ARM "T4004_3.9_1" with the arm type "track1".
        return named_arm or self.arms_by_type.get(joint.lower())

    @cached_property
    def arms_by_type(self) -> dict[str, Instance]:
        return {it.text("use_arm_type").lower(): it for it in reversed(self.moc.of("ARM"))}

    def bounds(self, joint: str) -> tuple[float, float]:
        """Return the limits in force of a joint [rad or m], NaN where they are not given."""
        arm = self.arm_of(joint)
        if arm is None:
            return math.nan, math.nan
        keys = ("lower_joint_bound", "upper_joint_bound")
        lower, upper = (arm.number(key, math.nan) for key in keys)
        return lower, upper

    def linkage(self, joints: tuple[str, ...]) -> tuple[float, float] | None:
        """Return the limits of the linkage [rad], if an axis has them."""
        for arm in filter(None, map(self.arm_of, joints)):
            keys = ("lower_joint_coupl_bound", "upper_joint_coupl_bound")
            if all(map(arm.has, keys)):
                lower, upper = (arm.number(key, math.nan) for key in keys)
                if lower < upper:
                    return lower, upper
                message = f"ARM {arm.name}: the limits of the linkage are empty: not used"
                self.report(arm.line, "linkage-limits", "warning", message)
        return None

    def base(self, of: Instance, robot: Robot | None = None) -> tuple[Pose | None, Robot | None]:
        """Return the base frame of an instance [m], and a robot there. An absent key has its
        default; u0 is 1.
        """
        position = [of.number(f"base_frame_pos_{axis}") for axis in "xyz"]
        wxyz = [of.number(f"base_frame_orient_u{i}", float(i == 0)) for i in range(4)]
        try:
            base = pose(position, wxyz)
            return base, None if robot is None else robot.with_base(base)
        except ValueError as error:
            message = f"{of.name}: its base frame is not determined: {error}"
            self.report(of.line, "base-frame", "error", message)
            return None, robot

    def joints_of(self, robot: Instance) -> tuple[str, ...]:
        """Return the joints of a robot, axis 1 first; axis 7 of a YuMi is a SINGLE beside it."""
        keys = (key for key in robot.values if key.startswith("use_joint_"))
        ordered = sorted(keys, key=lambda key: (len(key), key))
        joints = [robot.text(key) for key in ordered]
        seventh = self.seventh_of(robot)
        return (*joints, seventh.text("use_joint", seventh.name)) if seventh else tuple(joints)

    def seventh_of(self, robot: Instance) -> Instance | None:
        return self.moc.named("SINGLE", f"{robot.name}_7")

    def robot(self, of: Instance) -> RobotUnit:
        type_name = of.text("use_robot_type")
        joints = self.joints_of(of)
        limits = [self.bounds(joint) for joint in joints]
        # A name that lacks a side has it in the name of the unit: ROB_L.
        names = [type_name, f"{of.name}_{type_name}"] if type_name else []
        only = len(self.moc.of("ROBOT")) == 1
        found = fitted(names, self.wording if only else (), limits, self.linkage(joints))
        self.report_fit(of, type_name, found)
        base, robot = self.base(of, found.robot)
        calibration = of.text("use_robot_calib").lower()
        is_calibrated = calibration.endswith("_calib") and self.has_errors(joints)
        if is_calibrated:
            message = f"{of.name}: its kinematics were measured (Absolute Accuracy): "
            self.report(of.line, "calibrated", "note", f"{message}the nominal ones are used")
        return RobotUnit(
            of.name, type_name, found.arm, robot, base, _carrier(of), found.differences,
            is_calibrated, self.has_offsets(joints), joints, of.line,
        )  # fmt: skip

    def report_fit(self, of: Instance, type_name: str, found: Fitted) -> None:
        if found.robot is None:
            message = f"{of.name}: {found.reason}: its moves are not checked"
            self.report(of.line, "unknown-arm", "warning", message)
        elif found.by_wording:
            message = f"{of.name}: {type_name or 'a robot without a type'} is not in the catalog: "
            message += f"taken as {found.arm}, the arm of backinfo.txt"
            self.report(of.line, "arm-by-wording", "warning", message)
        for it in found.differences:
            own = _degrees(it.lower, it.upper)
            catalog = _degrees(it.catalog_lower, it.catalog_upper)
            message = f"{of.name}: {it.joint} is limited to {own} deg, {catalog} deg in the catalog"
            self.report(of.line, "limits-differ", "note", message)
        if found.without_limits:
            axes = ", ".join(map(str, found.without_limits))
            message = f"{of.name}: no limits of axis {axes} in the file: the catalog's are used"
            self.report(of.line, "limits-missing", "warning", message)

    def has_errors(self, joints: tuple[str, ...]) -> bool:
        found = filter(None, (self.moc.named("ARM_CALIB", joint) for joint in joints))
        return any(key.startswith("error_") and it.number(key) for it in found for key in it.values)

    def has_offsets(self, joints: tuple[str, ...]) -> bool:
        motors = filter(None, (self.moc.named("MOTOR_CALIB", joint) for joint in joints))
        return any(motor.number("cal_offset") for motor in motors)

    def axis(self, joint: str) -> ExternalAxis:
        named = self.moc.named("JOINT", joint)
        logical = int(named.number("logical_axis")) if named else 0
        place = logical - FIRST_LOGICAL_AXIS
        eax = AXES[place] if 0 <= place < len(AXES) else None
        return ExternalAxis(joint, eax, *self.bounds(joint))

    def single(self, of: Instance) -> ExternalUnit:
        type_name = of.text("use_single_type")
        single_type = self.moc.named("SINGLE_TYPE", type_name)
        kind = _kind(type_name, single_type.text("mechanics") if single_type else "")
        return self.external(of, type_name, kind, (of.text("use_joint", of.name),))

    def gantry(self, of: Instance) -> ExternalUnit:
        """Return a robot whose kinematics are a gantry's or a positioner's."""
        type_name = of.text("use_robot_type")
        kind: UnitKind = "positioner" if type_name.upper().startswith("IRBP") else "gantry"
        return self.external(of, type_name, kind, self.joints_of(of))

    def external(
        self, of: Instance, type_name: str, kind: UnitKind, joints: tuple[str, ...]
    ) -> ExternalUnit:
        base, _ = self.base(of)
        axes = tuple(map(self.axis, joints))
        return ExternalUnit(of.name, type_name, kind, base, _carrier(of), (), axes, of.line)

    def is_gantry(self, of: Instance) -> bool:
        type_name = of.text("use_robot_type")
        of_type = self.moc.named("ROBOT_TYPE", type_name)
        is_general = of_type is not None and of_type.text("type").upper() == "GEN_KIN"
        return is_general or type_name.upper().startswith("IRBP")


def _carrier(of: Instance) -> str | None:
    return of.text("base_frame_coordinated") or None


def _degrees(lower: float, upper: float) -> str:
    return f"{math.degrees(lower):.4g}..{math.degrees(upper):.4g}"


def _kind(type_name: str, mechanics: str) -> UnitKind:
    """Return the kind of a single: by the mechanics of its type, else by ABB's catalog names."""
    mechanics, type_name = mechanics.upper(), type_name.upper()
    if "TRACK" in mechanics or "LIN" in mechanics or type_name.startswith("IRBT"):
        return "track"
    if "ROT" in mechanics or type_name.startswith("IRBP"):
        return "positioner"
    return "servo"


def read_machine(moc: CfgFile, wording: tuple[str, ...]) -> Machine:
    """Read the units of MOC.cfg; `wording`: arms of backinfo.txt, for a type string not known."""
    reader = _Reader(moc, wording)
    robots: dict[str, RobotUnit] = {}
    units: dict[str, ExternalUnit] = {}
    sevenths = {single.line for it in moc.of("ROBOT") if (single := reader.seventh_of(it))}
    for it in moc.of("ROBOT"):
        if it.name in robots or it.name in units:
            continue
        if reader.is_gantry(it):
            units[it.name] = reader.gantry(it)
        else:
            robots[it.name] = reader.robot(it)
    for it in moc.of("SINGLE"):
        if it.line not in sevenths and it.name not in units:
            units[it.name] = reader.single(it)
    machine = related(moc, Machine(robots, units, reader.findings))
    check_carriers(machine, moc.file)
    return machine
