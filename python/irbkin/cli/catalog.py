"""`irbkin catalog`: the arms that are known by name."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser
from irbkin.cli.errors import FINE, FOUND, CommandError
from irbkin.cli.numbers import number

if TYPE_CHECKING:
    from irbkin import CatalogEntry

HELP = """Without words all arms are listed; with words, those whose names contain them all. The
name of one arm shows its joints: limits, speeds and where the figures are from."""
EXAMPLES = """  irbkin catalog
  irbkin catalog 2600
  irbkin catalog "IRB 2600-12/1.65"
  irbkin catalog --reach 2500 --payload 100
  irbkin catalog --csv > arms.csv"""
MOST_REACH = 100e3
"""The longest reach that the library takes [mm]."""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add("words", metavar="WORD", nargs="*", help="a part of a name, or a whole one")
    parser.add("--reach", type=number, metavar="MM", help="reach at least [mm]")
    parser.add("--payload", type=number, metavar="KG", help="payload at least [kg]")
    parser.add_formats("limits of one arm, shape (n, 2), in radians")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    import irbkin

    words = [word.strip() for word in arguments.words]
    name = " ".join(words)
    known = _filtered(arguments.reach, arguments.payload)
    if name in irbkin.catalog():
        _show_one(arguments, irbkin.catalog_entry(name))
        return FINE
    named = [it for it in irbkin.catalog() if all(word.lower() in it.lower() for word in words)]
    found = [it for it in named if it in known]
    if named and not found:
        whose = f" with {name!r} in its name" if words else ""
        raise CommandError(f"no arm of the catalog{whose} has {_bounds(arguments)}", FOUND)
    if not found:
        # It may be another spelling; if not, the error has the close names.
        _show_one(arguments, irbkin.catalog_entry(name))
        return FINE
    _show_all(arguments, [irbkin.catalog_entry(it) for it in found])
    return FINE


def _filtered(reach: float | None, payload: float | None) -> tuple[str, ...]:
    """The names of arms with at least a reach [mm] and a payload [kg]."""
    import irbkin

    if reach is not None and not 0.0 <= reach <= MOST_REACH:
        raise CommandError(f"--reach is {reach:g} mm, it must be 0 to {MOST_REACH:g} mm")
    if payload is not None and payload < 0.0:
        raise CommandError(f"--payload is {payload:g} kg, it must be 0 or more")
    return irbkin.catalog(reach=None if reach is None else reach / 1e3, payload=payload)


def _bounds(arguments: argparse.Namespace) -> str:
    """The filter in words."""
    reach, payload = arguments.reach, arguments.payload
    bounds = (
        "" if reach is None else f"a reach of {reach:g} mm or more",
        "" if payload is None else f"a payload of {payload:g} kg or more",
    )
    return " and ".join(filter(None, bounds))


def _show_all(arguments: argparse.Namespace, entries: list[CatalogEntry]) -> None:
    from irbkin.cli.output import Column, table

    if arguments.output and arguments.output.lower().endswith(".npy"):
        raise CommandError("names are no array: -o FILE.npy takes one arm")
    columns = (
        Column("name", "", "<24s"),
        Column("maker", "", "<16s"),
        Column("joints", "", "d"),
        Column("payload", "kg", "7.1f"),
        Column("reach", "mm", "6.0f"),
        Column("coupled", "", "<3s"),
        Column("speeds", "", "<3s"),
        Column("sources", "", "d"),
    )
    with table(arguments, columns, f"{len(entries)} arms") as rows:
        rows.write(
            [
                [it.name for it in entries],
                [it.maker for it in entries],
                [it.dof for it in entries],
                [_number(it.payload) for it in entries],
                [_number(it.reach) * 1e3 for it in entries],
                ["yes" if it.is_coupled else "" for it in entries],
                ["" if it.max_velocity is None else "yes" for it in entries],
                [it.sources for it in entries],
            ]
        )


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def _linkage(name: str) -> str:
    """The limits of the linkage in words, if they are known."""
    import numpy as np

    import irbkin

    limits = irbkin.Robot(name).linkage_limits
    return "" if limits is None else " (q3 - q2 {:g}..{:g} deg)".format(*np.degrees(limits))


def _show_one(arguments: argparse.Namespace, entry: CatalogEntry) -> None:
    import numpy as np

    from irbkin.cli.output import Column, table

    columns = (
        Column("joint", "", "<5s"),
        Column("lower", "deg", "8.1f"),
        Column("upper", "deg", "8.1f"),
        Column("speed", "deg/s", "7.1f"),
    )
    limits = np.degrees(entry.limits)
    speeds = np.full(entry.dof, np.nan)
    if entry.max_velocity is not None:
        speeds = np.degrees(entry.max_velocity)
    facts: list[str] = [entry.maker]
    if entry.payload is not None:
        facts.append(f"payload {entry.payload:g} kg")
    if entry.reach is not None:
        facts.append(f"reach {entry.reach * 1e3:g} mm")
    if entry.is_coupled:
        facts.append("axes 2 and 3 coupled" + _linkage(entry.name))
    with table(arguments, columns, f"{entry.name}: {', '.join(facts)}") as rows:
        names = [f"J{number + 1}" for number in range(entry.dof)]
        rows.write([names, limits[:, 0], limits[:, 1], speeds], entry.limits)
        for other in entry.aliases:
            rows.note("alias", other, f"also {other}")
        provenance = entry.provenance.replace("; ", "\n- ")
        rows.note("provenance", entry.provenance, f"sources: {provenance}")
