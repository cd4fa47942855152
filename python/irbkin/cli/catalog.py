"""Without words all arms are listed; with words, those whose names contain them all: case, blanks
and - _ / do not matter. The name of one arm shows its joints: limits, speeds and where the figures
are from.

Examples:
  irbkin catalog irb2600
  irbkin catalog "IRB 2600-12/1.65"
  irbkin catalog --reach 2500 --payload 100 --csv
"""

import argparse
import re

import numpy as np

import irbkin
from irbkin import CatalogEntry
from irbkin.cli.arguments import Parser
from irbkin.cli.errors import FINE, FOUND, CommandError
from irbkin.cli.numbers import number
from irbkin.cli.output import Column, Columns, show

MOST_REACH = 100e3
"""The longest reach that the library takes [mm]."""


def add_arguments(parser: Parser) -> None:
    parser.add("words", metavar="WORD", nargs="*", help="a part of a name, or a whole one")
    parser.add("--reach", type=number, metavar="MM", help="reach at least [mm]")
    parser.add("--payload", type=number, metavar="KG", help="payload at least [kg]")
    parser.add_formats("limits of one arm, shape (n, 2), in radians")


def run(arguments: argparse.Namespace) -> int:
    words = [word.strip() for word in arguments.words]
    reach, payload, name = arguments.reach, arguments.payload, " ".join(words)
    if reach is not None and not 0.0 <= reach <= MOST_REACH:
        raise CommandError(f"--reach is {reach:g} mm, it must be 0 to {MOST_REACH:g} mm")
    if payload is not None and payload < 0.0:
        raise CommandError(f"--payload is {payload:g} kg, it must be 0 or more")
    known = irbkin.catalog(reach=None if reach is None else reach / 1e3, payload=payload)
    named = [it for it in irbkin.catalog() if all(_bare(word) in _bare(it) for word in words)]
    if not named or any(_bare(name) == _bare(it) for it in named):
        # It may be another spelling; if not, the error has the close names.
        _show_one(arguments, irbkin.catalog_entry(name))
        return FINE
    found = [irbkin.catalog_entry(it) for it in named if it in known]
    if not found:
        whose = f" with {name!r} in its name" if words else ""
        bounds = {"reach": (reach, "mm"), "payload": (payload, "kg")}.items()
        has = [f"a {it} of {least:g} {unit} or more" for it, (least, unit) in bounds if least]
        raise CommandError(f"no arm of the catalog{whose} has {' and '.join(has)}", FOUND)
    _show_all(arguments, found)
    return FINE


def _bare(name: str) -> str:
    return re.sub(r"[\s_/-]", "", name).lower()


def _show_all(arguments: argparse.Namespace, entries: list[CatalogEntry]) -> None:
    if arguments.output and arguments.output.lower().endswith(".npy"):
        raise CommandError("names are no array: -o FILE.npy takes one arm")
    columns: Columns = {
        Column("name", "<24s"): [it.name for it in entries],
        Column("maker", "<16s"): [it.maker for it in entries],
        Column("joints"): [it.dof for it in entries],
        Column("payload", "7.1f", "kg"): [it.payload for it in entries],
        Column("reach", "6.0f", "mm"): [it.reach and it.reach * 1e3 for it in entries],
        Column("coupled", "<3s"): ["yes" if it.is_coupled else "" for it in entries],
        Column("speeds", "<3s"): ["" if it.max_velocity is None else "yes" for it in entries],
        Column("sources"): [it.sources for it in entries],
    }
    show(arguments, f"{len(entries)} arms", columns)


def _show_one(arguments: argparse.Namespace, entry: CatalogEntry) -> None:
    limits, linkage = np.degrees(entry.limits), irbkin.Robot(entry.name).linkage_limits
    within = "" if linkage is None else " (q3 - q2 {:g}..{:g} deg)".format(*np.degrees(linkage))
    facts = (
        entry.maker,
        "" if entry.payload is None else f"payload {entry.payload:g} kg",
        "" if entry.reach is None else f"reach {entry.reach * 1e3:g} mm",
        f"axes 2 and 3 coupled{within}" if entry.is_coupled else "",
    )
    speeds = entry.max_velocity
    columns: Columns = {
        Column("joint", "<5s"): [f"J{number + 1}" for number in range(entry.dof)],
        Column("lower", "8.1f", "deg"): limits[:, 0],
        Column("upper", "8.1f", "deg"): limits[:, 1],
        Column("speed", "7.1f", "deg/s"): np.degrees(
            [np.nan] * len(limits) if speeds is None else speeds
        ),
    }
    if entry.max_acceleration is not None:
        accelerations = Column("acceleration", "7.0f", "deg/s^2")
        columns = {**columns, accelerations: np.degrees(entry.max_acceleration)}
    notes = [("alias", other, f"also {other}") for other in entry.aliases]
    provenance = entry.provenance.replace("; ", "\n- ")
    notes.append(("provenance", entry.provenance, f"sources: {provenance}"))
    heading = f"{entry.name}: {', '.join(filter(None, facts))}"
    show(arguments, heading, columns, entry.limits, *notes)
