"""Which units carry others, and which MECHANICAL_UNIT stands for each."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from irbkin.abb.cfg import CfgFile
from irbkin.abb.findings import Finding, Severity
from irbkin.abb.units import ExternalUnit, RobotUnit

MOST_CARRIERS = 8
"""Units that carry each other in a row: more are a circle."""
USES = ("use_robot", "use_single")
"""Beginnings of the keys of MECHANICAL_UNIT that name its units."""


@dataclass
class Machine:
    """The mechanical units of a controller."""

    robots: dict[str, RobotUnit]
    units: dict[str, ExternalUnit]
    findings: list[Finding]

    def all_units(self) -> list[RobotUnit | ExternalUnit]:
        """Return robots and other units."""
        return [*self.robots.values(), *self.units.values()]


def related(moc: CfgFile, machine: Machine) -> Machine:
    """Return the machine with what units carry, and what MECHANICAL_UNIT says of them."""
    carried: dict[str, list[str]] = {}
    for unit in machine.all_units():
        carried.setdefault((unit.carried_by or "").lower(), []).append(unit.name)
    mechanical: dict[str, str] = {}
    for it in moc.of("MECHANICAL_UNIT"):
        used = [value.lower() for key, value in it.values.items() if key.startswith(USES)]
        if len(used) == 1:
            mechanical.setdefault(used[0], it.name)
    units = {
        name: replace(
            unit,
            carries=tuple(carried.get(name.lower(), ())),
            mechanical_unit=mechanical.get(name.lower(), ""),
        )
        for name, unit in machine.units.items()
    }
    robots = {
        name: replace(robot, mechanical_unit=mechanical.get(name.lower(), ""))
        for name, robot in machine.robots.items()
    }
    return Machine(robots, units, machine.findings)


def carriers_of(
    unit: RobotUnit | ExternalUnit,
    find: Callable[[str], RobotUnit | ExternalUnit | None],
) -> tuple[list[ExternalUnit], str]:
    """Return the units that carry one, the nearest first, and what is wrong with them, or ""."""
    found: list[ExternalUnit] = []
    name = unit.carried_by
    while name:
        carrier = find(name)
        if not isinstance(carrier, ExternalUnit):
            return found, f"{unit.name}: {name}, which carries it, is no unit of MOC.cfg"
        if len(found) == MOST_CARRIERS:
            return found, f"{unit.name}: the units that carry it carry each other"
        found.append(carrier)
        name = carrier.carried_by
    return found, ""


def check_carriers(machine: Machine, file: str) -> None:
    """Report units whose carrier is missing, or that are carried in a circle."""
    units = {name.lower(): unit for name, unit in machine.units.items()}
    for unit in machine.all_units():
        carriers, wrong = carriers_of(unit, lambda name: units.get(name.lower()))
        if wrong:
            severity: Severity = "error" if len(carriers) == MOST_CARRIERS else "warning"
            message = f"{wrong}: its place is not determined"
            machine.findings.append(Finding(file, unit.line, "carrier", severity, message))
