"""Each arm of the catalog is checked as by `irbkin check`, at --base or where a backup has its
robot. A move is met if it is checked, has joints, and nothing is wrong with reach, limits, path or
collisions. Confdata do not count: of another arm they are wrong by nature, and `irbkin port` solves
them anew. Most moves met come first, then the least reach. tool, base and cell are taken from
irbkin.toml if they are not given. Exit codes: 0 some arm meets all moves, 1 none, 2 wrong usage.

Examples:
  irbkin arms program.mod tools.sys --payload 10
  irbkin arms backups/cell_3 --cell cell.toml --shift
  irbkin arms program.mod --tool tGun=0 0 180 --arm "IRB 1300-7/1.4" --arm "IRB 1600-10/1.45"
"""

import argparse
import json
import shlex
from dataclasses import replace

from irbkin import Robot, rapid
from irbkin._arm_options import robot_of
from irbkin.check.checker import Checker
from irbkin.check.jobs import only_job
from irbkin.check.report import report_of
from irbkin.check.settings import settings_of
from irbkin.cli.arguments import Parser
from irbkin.cli.check import check_tools, given
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.files import put_text, shown
from irbkin.cli.numbers import number
from irbkin.cli.output import Column, show
from irbkin.cli.postures import has_confdata
from irbkin.cli.progress import Progress
from irbkin.rapid.candidates import STAND_IN

COLUMNS = (
    Column("name", "<24s"),
    Column("payload", "7.1f", "kg"),
    Column("reach", "6.0f", "mm"),
    Column("moves"),
    Column("met"),
    Column("unchecked"),
    Column("margin", "6.1f", "deg"),
    Column("singular"),
    Column("shift", "+d", "mm"),
)


def add_arguments(parser: Parser) -> None:
    add = parser.add
    add("files", metavar="FILE", nargs="+", help="modules, folders, a .pgf, or a backup")
    add("--arm", metavar="NAME", action="append", help="only this arm; may be repeated")
    add("--payload", type=number, default=0.0, metavar="KG", help="payload at least [kg]")
    words = "move the base of an arm that misses moves by up to 500 mm along its x axis"
    add("--shift", action="store_true", help=words)
    parser.add_tools()
    parser.add_frame("base", "base in the world", "pose")
    parser.add_cell()
    parser.add_formats("not of names")
    parser.endings = (".csv", ".json", ".txt")


def run(arguments: argparse.Namespace) -> int:
    names: list[str] = arguments.files
    settings = settings_of(names)
    options = {**settings.options, **given(arguments)}
    checker = Checker(options, settings)
    stand_in = robot_of({"robot": STAND_IN, "base": options.get("base")}, complain)
    job = only_job(stand_in, names, settings)
    robot = stand_in if arguments.base or job.robot is None else job.robot
    check_tools(checker.tools, [job])
    for it in job.program.findings:
        if it.severity == "error":
            complain(f"{shown(it.file)}:{it.line}: {it.code} {it.message}")
    with Progress("arms") as progress:
        found = rapid.arms(
            job.program,
            names=arguments.arm,
            cell=checker.cell,
            payload=arguments.payload,
            tool=checker.tools,
            base=robot.base,
            shift=arguments.shift,
            progress=lambda done, total: progress.add(done - progress.done, total),
            units=job.units,
            last_values=job.is_saved,
            carried=checker.shapes,
        )
    best = found[0]
    notes = [found.summary]
    own = Robot(best.name).with_base(robot.base)
    if not has_confdata(own):
        notes.append(f"{best.name} has no confdata of ABB: its moves are not checked.")
    elif best.unchecked:
        notes.append(f"{best.name}: {report_of(checker, [replace(job, robot=own)]).coverage}")
        if "unknown tools" in notes[1]:
            notes[1] += " --tool X Y Z gives the TCP of tools that nothing declares."
        if best.unchecked == best.moves:
            raise CommandError(notes[1], FOUND)
    is_able = best.met == best.moves
    stand = f"{best.name} {best.stand}: " if best.stand else ""
    verb, to = ("port", " --to DIR") if is_able else ("check", "")
    notes.append(f'{stand}irbkin {verb} "{best.name}" {shlex.join(names)}{to}')
    rows = [it._replace(reach=it.reach and round(it.reach * 1e3, 6)) for it in found]
    if arguments.json or (arguments.output or "").lower().endswith(".json"):
        text = json.dumps({"arms": [it._asdict() for it in rows]}, indent=1)
        put_text(arguments.output, f"{text}\n")
    else:
        columns = dict(zip(COLUMNS, zip(*rows, strict=True), strict=True))
        show(arguments, ", ".join(names), columns, None, *(("", None, words) for words in notes))
    return FINE if is_able else FOUND
