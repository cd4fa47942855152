"""A controller's backup as one record, and its units as a check of RAPID takes them."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np

from irbkin import Robot
from irbkin._core import NOT_THERE
from irbkin._words import counted, listed
from irbkin.abb.carriers import carriers_of
from irbkin.abb.findings import Finding
from irbkin.abb.folders import Folder
from irbkin.abb.tasks import Task
from irbkin.abb.units import AXES, ExternalUnit, Pose, RobotUnit
from irbkin.errors import InvalidModelError
from irbkin.rapid import Program
from irbkin.rapid.program import ModuleFile, program_of

ControllerKind = Literal["S4C+", "IRC5", "OmniCore"]
NO_AXES = (NOT_THERE,) * 6
UnitRow = tuple[str, bool, bool, list[tuple[int, Pose, bool]]]
"""Name, whether it carries the robot, whether its axes are determined, and its axes: the external
axis from 0, its frame seen from the axis before it [m], and whether it turns."""


@dataclass(frozen=True)
class Controller:
    """The controller that a backup is of."""

    kind: ControllerKind | None
    """Generation, or None where the files do not say."""
    robotware: str
    """Version of RobotWare as backinfo.txt has it, "6.08.01.00", or empty."""
    cfg_version: str
    """Version of the configuration files, "6:0", or empty."""
    system: str
    """Name of the system, or empty."""
    is_real: bool
    """Whether motors have calibration offsets, which a virtual controller has not."""


@dataclass(frozen=True, eq=False, repr=False)
class Backup:
    """A controller's backup.

    Lengths are in meters, angles in radians, poses 4x4 matrices in the world, except where a name
    says `_mm_deg`.
    """

    path: Path
    """Root of the backup; of an archive, a temporary folder that lives as long as this record."""
    origin: Path
    """Root as it was given: of an archive, the path in it, which messages have."""
    controller: Controller
    """Generation and versions."""
    robots: Mapping[str, RobotUnit]
    """Robots by the name of their unit."""
    units: Mapping[str, ExternalUnit]
    """Tracks, positioners, gantries and servo axes by name."""
    tasks: tuple[Task, ...]
    """Tasks in the order of their folders."""
    findings: tuple[Finding, ...]
    """Findings on what is not determined, missing or broken, once for each unit or file."""
    checksums: Mapping[str, str] = field(default_factory=dict)
    """OmniCore: base64 of BACKINFO/checksum.txt by path in the backup, in lower case, with `/`."""
    signals: Mapping[str, str] = field(default_factory=dict)
    """Types of the signals of EIO.cfg, "DI" to "GO", by name; none if it cannot be read whole."""
    _folder: Folder | None = None

    def __repr__(self) -> str:
        machine = self.controller
        of = (machine.kind or "unknown controller", machine.robotware, machine.system)
        severities = Counter(it.severity for it in self.findings).items()
        lines = {
            f"<Backup of {self.origin}": " ".join(filter(None, of)),
            "robots": listed(f"{it.name} ({it.arm or it.type})" for it in self.robots.values()),
            "units": listed(self.units),
            "tasks": listed(
                f"{it.name} ({counted(len(it.modules), 'module')})" for it in self.tasks
            ),
            "findings": listed(counted(count, it) for it, count in sorted(severities)),
        }
        return "\n".join(f"{name}: {words or 'none'}" for name, words in lines.items()) + ">"

    def task(self, name: str) -> Task:
        """Return the task of a name, compared without case.

        Raises:
            KeyError: No task has the name.
        """
        found = next((it for it in self.tasks if it.name.lower() == name.lower()), None)
        if found is None:
            raise KeyError(f"no task {name!r}: {', '.join(it.name for it in self.tasks)}")
        return found

    def unit(self, name: str) -> RobotUnit | ExternalUnit | None:
        """Return the unit of a name, or the one of a MECHANICAL_UNIT of that name, compared without
        case; None without one.
        """
        return self._by_name.get(name.lower())

    @cached_property
    def _by_name(self) -> dict[str, RobotUnit | ExternalUnit]:
        units: list[RobotUnit | ExternalUnit] = [*self.units.values(), *self.robots.values()]
        named = {it.name.lower(): it for it in units}
        of_mechanical = {it.mechanical_unit.lower(): it for it in units}
        return {**of_mechanical, **named}

    def base_at(self, name: str, external_mm_deg: Sequence[float] = NO_AXES) -> Pose:
        """Return the base frame of a robot or unit in the world, moved by the units that carry it.

        Args:
            name: Name of the unit, case does not matter.
            external_mm_deg: The six external axes of a target [mm, deg]; 9E9 for none.

        Returns:
            Pose [m], shape (4, 4).

        Raises:
            InvalidModelError: The files do not determine it, or the target lacks an axis; the
                message names the unit.
        """
        unit = self._known(name)
        pose = _base_of(unit)
        carriers, wrong = carriers_of(unit, self.unit)
        if wrong:
            raise InvalidModelError(wrong)
        for carrier in carriers:
            # A unit that it carries is given in the world, with all external axes at zero.
            base = _base_of(carrier)
            pose = base @ carrier.moved(external_mm_deg) @ np.linalg.inv(base) @ pose
        return pose

    def frame_at(self, name: str, external_mm_deg: Sequence[float] = NO_AXES) -> Pose:
        """Return the frame that an external unit moves, in the world: base frame times motion.

        A track moves along x of its base frame, a positioner turns about z of it. Arguments and
        errors as for `base_at`.
        """
        unit = self._known(name)
        if isinstance(unit, RobotUnit):
            raise InvalidModelError(f"{unit.name} is a robot: external axes do not move it")
        return self.base_at(unit.name, external_mm_deg) @ unit.moved(external_mm_deg)

    def _known(self, name: str) -> RobotUnit | ExternalUnit:
        unit = self.unit(name)
        if unit is None:
            raise InvalidModelError(f"{name}: no such unit in the backup")
        return unit

    def robot_at(self, name: str, external_mm_deg: Sequence[float] = NO_AXES) -> Robot:
        """Return a robot with its limits in force and its base in the world.

        Arguments and errors as for `base_at`; the error of an arm that is not in the catalog has
        its type string.
        """
        unit = self._known(name)
        if not isinstance(unit, RobotUnit):
            raise InvalidModelError(f"{unit.name}: is no robot")
        if unit.robot is None:
            raise InvalidModelError(f"{unit.name}: its arm {unit.type!r} is not in the catalog")
        if not unit.carried_by and unit.base is not None:
            return unit.robot
        return unit.robot.with_base(self.base_at(unit.name, external_mm_deg))

    @cached_property
    def programs(self) -> Mapping[str, Program]:
        """The programs of the tasks that have modules, by name. A file of an archive has its path
        in it.
        """
        found = {}
        for task in (own for own in self.tasks if own.modules):
            named = ((str(self.origin / it.file), it.path) for it in task.modules)
            files = [ModuleFile(name, path.read_bytes()) for name, path in named]
            found[task.name] = program_of(files)
        return found


def _base_of(unit: RobotUnit | ExternalUnit) -> Pose:
    if unit.base is None:
        raise InvalidModelError(f"{unit.name}: its base frame is not determined")
    return unit.base


def unit_rows(backup: Backup, robot: str) -> list[UnitRow]:
    """Return the external units of a backup for a robot of it."""
    carrier = backup.robots[robot].carried_by
    rows = []
    for unit in backup.units.values():
        row = _unit_row(backup, unit, is_carrier=False)
        rows.append(row)
        # Work objects name the mechanical unit.
        if unit.mechanical_unit:
            rows.append((unit.mechanical_unit, *row[1:]))
    if carrier is not None:
        own_unit = backup.unit(carrier)
        own: UnitRow = (carrier, True, False, [])
        if isinstance(own_unit, ExternalUnit):
            own = _unit_row(backup, own_unit, is_carrier=True)
        rows = [own, *(row for row in rows if row[0] != own[0])]
    return rows


def _unit_row(backup: Backup, unit: ExternalUnit, *, is_carrier: bool) -> UnitRow:
    """Return a unit with the axes of the units that carry it before its own."""
    carriers, _ = carriers_of(unit, backup.unit)
    chain = [*reversed(carriers), unit]
    axes: list[tuple[int, Pose, bool]] = []
    before = np.eye(4)
    for part in chain:
        base = np.eye(4) if part.base is None else part.base
        for eax in (axis.eax for axis in part.axes if axis.eax is not None):
            is_rotation = part.kind == "positioner"
            axes.append((AXES.index(eax), np.linalg.inv(before) @ base, is_rotation))
            before = base
    is_determined = all(part.is_determined for part in chain)
    return unit.name, is_carrier, is_determined, axes
