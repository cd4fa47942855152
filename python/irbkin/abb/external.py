"""Units of a backup as a check of RAPID takes them: axes from the world on."""

import numpy as np

from irbkin.abb.backup import Backup
from irbkin.abb.carriers import carriers_of
from irbkin.abb.units import AXES, ExternalUnit, Pose

UnitRow = tuple[str, bool, bool, list[tuple[int, Pose, bool]]]
"""Name, whether it carries the robot, whether its axes are determined, and its axes: the external
axis from 0, its frame seen from the axis before it [m], and whether it turns."""


def unit_rows(backup: Backup, robot: str) -> list[UnitRow]:
    """Return the external units of a backup for a robot of it."""
    carrier = backup.robots[robot].carried_by
    rows = []
    for unit in backup.units.values():
        row = _row(backup, unit, is_carrier=False)
        rows.append(row)
        # Work objects name the mechanical unit.
        if unit.mechanical_unit:
            rows.append((unit.mechanical_unit, *row[1:]))
    if carrier is not None:
        own_unit = backup.unit(carrier)
        own: UnitRow = (carrier, True, False, [])
        if isinstance(own_unit, ExternalUnit):
            own = _row(backup, own_unit, is_carrier=True)
        rows = [own, *(row for row in rows if row[0] != own[0])]
    return rows


def _row(backup: Backup, unit: ExternalUnit, *, is_carrier: bool) -> UnitRow:
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
