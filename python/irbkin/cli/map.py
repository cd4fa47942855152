"""A grid of positions, each with every orientation of the tool: the share that is reached
inside the limits without a collision, the number of solutions, the smallest margin from limits and
singularities. A map in a file .npz (as of irbkin.map) goes on where a run was ended, and is shown
level by level. The exit code is 1 if nothing is reached.

Examples:
  irbkin map "IRB 2600-12/1.65" --x 400 1600 --y -800 800 --z 0 1600 --step 200
  irbkin map "IRB 120-3/0.58" --x -600 600 --y -600 600 --z 0 900 --step 25 -o reach.npz
"""

import argparse
import os

import numpy as np

from irbkin import map as maps
from irbkin._arm_options import frame
from irbkin.cli.arguments import Parser, read_cell, read_q7, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError
from irbkin.cli.numbers import angle, count, number
from irbkin.cli.output import Column, Columns, Floats, show
from irbkin.cli.progress import Progress
from irbkin.map import ReachMap

MOST_POSITIONS = 10**9
MOST_ORIENTATIONS = 10**6
MOST_THREADS = 1024


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    add = parser.add
    for axis in "xyz":
        ends, words = ("FROM", "TO"), f"positions along {axis} [mm]"
        add(f"--{axis}", nargs=2, type=float, metavar=ends, help=words)
    add("--step", type=float, default=100.0, metavar="MM", help="their distance; 100 mm")
    many = count(1, MOST_ORIENTATIONS)
    add("--directions", type=many, default=20, help="directions of the tool, spread evenly; 20")
    add("--turns", type=many, default=1, help="turns of each about the tool's z; 1")
    add("--euler", nargs=3, type=number, metavar=("RZ", "RY", "RX"), help="or one, ZYX [deg]")
    add("--q7", type=angle, metavar="Q7", help="angle of joint 7 of a seven-axis arm [deg]")
    parser.add_cell()
    threads = count(0, MOST_THREADS)
    add("--threads", type=threads, default=1, help="number of threads; 0 for one a core")
    parser.add_formats("x, y, z [m], share, solutions, margin, shape (m, 6)", ".npz")


def run(arguments: argparse.Namespace) -> int:
    output: str | None = arguments.output
    is_map = os.path.splitext(output or "")[1].lower() == ".npz"
    ends = [getattr(arguments, axis) for axis in "xyz"]
    robot = read_robot(arguments)
    if None in ends:
        raise CommandError("give --x, --y and --z (irbkin map --help)")
    x, y, z = (_positions(*it, arguments.step) for it in zip("xyz", ends, strict=True))
    positions = len(x) * len(y) * len(z)
    if positions > MOST_POSITIONS:
        words = f"{positions:,} positions, at most {MOST_POSITIONS:,}"
        raise CommandError(f"{words}: take a larger --step")
    orientations = _orientations(arguments)
    with Progress("positions", positions) as progress:
        options = {"threads": arguments.threads, "progress": progress.at}
        options |= {"q7": read_q7(arguments, robot), "cell": read_cell(arguments)}
        options["output"] = output if is_map else None
        found = maps.reach(robot, x, y, z, orientations, **options)
    heading = f"{robot.name}: {positions:,} positions, {len(orientations)} orientations each"
    if is_map or not (arguments.csv or arguments.json or arguments.output):
        total = float(found.share.mean())
        words = f"reached: {100 * total:.1f} % of all poses"
        arguments.output = None
        show(arguments, heading, _levels(found), None, ("reached", total, words))
    else:
        show(arguments, heading, *_every(found))
    return FINE if found.reached.any() else FOUND


def _orientations(arguments: argparse.Namespace) -> Floats:
    """Orientations of the tool."""
    if arguments.euler is not None:
        return frame([0, 0, 0, *arguments.euler], "--euler")[None, :3, :3]
    many = arguments.directions * arguments.turns
    if many > MOST_ORIENTATIONS:
        words = f"it must be at most {MOST_ORIENTATIONS:,}"
        raise CommandError(f"--directions times --turns is {many:,}, {words}")
    return maps.orientations(arguments.directions, arguments.turns)


def _positions(name: str, ends: list[float], step: float) -> list[float]:
    """Positions along an axis [m]."""
    first, last = ends
    if not (np.isfinite(ends).all() and first <= last):
        raise CommandError(f"--{name} {first:g} {last:g}: FROM must be at most TO")
    if not 0.0 < step < np.inf:
        raise CommandError(f"--step {step:g}: it must be positive")
    count = (last - first) / step
    if count > MOST_POSITIONS:
        raise CommandError(f"--step {step:g}: more than {MOST_POSITIONS:,} positions along {name}")
    positions: list[float] = (first + step * np.arange(int(count + 1e-9) + 1)).tolist()
    return [position / 1e3 for position in positions]


def _levels(found: ReachMap) -> Columns:
    """One row for each height."""
    share, level = found.share, (0, 1)
    margin = np.where(found.reached > 0, found.margin, -np.inf).max(axis=level)
    return {
        Column("z", "8.1f", "mm"): found.z * 1e3,
        Column("reached", "7.1f", "percent"): 100 * share.mean(axis=level),
        Column("some", "7.1f", "percent"): 100 * (share > 0).mean(axis=level),
        Column("all", "7.1f", "percent"): 100 * (share == 1).mean(axis=level),
        Column("solutions"): found.solutions.sum(axis=level),
        Column("best margin", "11.3f"): np.where(np.isfinite(margin), margin, np.nan),
    }


def _every(found: ReachMap) -> tuple[Columns, Floats]:
    """One row for each position, and the same in meters and as shares."""
    grid = np.meshgrid(found.x, found.y, found.z, indexing="ij")
    parts = (*grid, found.share, found.solutions, found.margin)
    array: Floats = np.column_stack([it.ravel() for it in parts])
    heads = (
        *(Column(axis, "8.1f", "mm") for axis in "xyz"),
        Column("reached", "7.1f", "percent"),
        Column("solutions"),
        Column("margin", "7.3f"),
    )
    values = (array * [1e3, 1e3, 1e3, 100, 1, 1]).T
    return dict(zip(heads, values, strict=True)), array
