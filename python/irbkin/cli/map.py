"""`irbkin map`: what an arm reaches, position by position."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin._arm_options import frame
from irbkin.cli.arguments import Parser, read_q7, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError
from irbkin.cli.numbers import angle, count, number

if TYPE_CHECKING:
    from irbkin.map import ReachMap

HELP = """A grid of positions, each with every orientation of the tool: the share that is reached
inside the limits, the number of solutions, the smallest margin from limits and singularities. A
map in a file .npz (as of irbkin.map) goes on where a run was ended, and is shown level by level.
The exit code is 1 if nothing is reached."""
EXAMPLES = """  irbkin map "IRB 2600-12/1.65" --x 400 1600 --y -800 800 --z 0 1600 --step 200
  irbkin map "IRB 2600-12/1.65" --x 400 1600 --y 0 0 --z 0 1600 --euler 0 180 0 --csv
  irbkin map "IRB 120-3/0.58" --x -600 600 --y -600 600 --z 0 900 --step 25 -o reach.npz"""
MOST_POSITIONS = 10**9
MOST_ORIENTATIONS = 10**6
MOST_THREADS = 1024


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    add = parser.add
    for axis in "xyz":
        add(
            f"--{axis}",
            nargs=2,
            type=float,
            required=True,
            metavar=("FROM", "TO"),
            help=f"positions along {axis} [mm]",
        )
    add("--step", type=float, default=100.0, metavar="MM", help="their distance; 100 mm")
    many = count(1, MOST_ORIENTATIONS)
    add("--directions", type=many, default=20, help="directions of the tool, spread evenly; 20")
    add("--turns", type=many, default=1, help="turns of each about the tool's z; 1")
    add("--euler", nargs=3, type=number, metavar=("RZ", "RY", "RX"), help="or one, ZYX [deg]")
    add("--q7", type=angle, metavar="Q7", help="angle of joint 7 of a seven-axis arm [deg]")
    add(
        "--threads",
        type=count(0, MOST_THREADS),
        default=1,
        help="number of threads; 0 for one a core",
    )
    parser.add_formats("x, y, z [m], share, solutions, margin, shape (m, 6)", ".npz")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    from irbkin import map as maps
    from irbkin.cli.progress import Progress

    robot = read_robot(arguments)
    x, y, z = (_positions(name, getattr(arguments, name), arguments.step) for name in "xyz")
    positions = len(x) * len(y) * len(z)
    if positions > MOST_POSITIONS:
        raise CommandError(
            f"{positions:,} positions, at most {MOST_POSITIONS:,}: take a larger --step"
        )
    if arguments.euler is None:
        many = arguments.directions * arguments.turns
        if many > MOST_ORIENTATIONS:
            raise CommandError(
                f"--directions times --turns is {many:,}, it must be at most {MOST_ORIENTATIONS:,}"
            )
        orientations = maps.orientations(arguments.directions, arguments.turns)
    else:
        orientations = frame([0, 0, 0, *arguments.euler], "--euler")[None, :3, :3]
    output: str | None = arguments.output
    store = output if output and output.lower().endswith(".npz") else None
    done = 0
    with Progress("positions", positions) as progress:

        def report(ready: int, _: int) -> None:
            nonlocal done
            progress.add(ready - done)
            done = ready

        found = maps.reach(
            robot,
            x,
            y,
            z,
            orientations,
            q7=read_q7(arguments, robot),
            output=store,
            threads=arguments.threads,
            progress=report,
        )
    if store is not None:
        arguments.output = None
    heading = f"{robot.name}: {positions:,} positions, {len(orientations)} orientations each"
    if store is not None or not (arguments.csv or arguments.json or arguments.output):
        _levels(arguments, found, heading)
    else:
        _all(arguments, found, heading)
    return FINE if found.reached.any() else FOUND


def _positions(name: str, ends: list[float], step: float) -> list[float]:
    """Positions along an axis [m]."""
    import numpy as np

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


def _levels(arguments: argparse.Namespace, found: ReachMap, heading: str) -> None:
    """One row for each height."""
    import numpy as np

    from irbkin.cli.output import Column, table

    columns = (
        Column("z", "mm", "8.1f"),
        Column("reached", "percent", "7.1f"),
        Column("some", "percent", "7.1f"),
        Column("all", "percent", "7.1f"),
        Column("solutions", "", "d"),
        Column("best margin", "", "11.3f"),
    )
    share = found.share
    level = (0, 1)
    margin = np.where(found.reached > 0, found.margin, -np.inf).max(axis=level)
    margin[~np.isfinite(margin)] = np.nan
    values = [
        found.z * 1e3,
        100 * share.mean(axis=level),
        100 * (share > 0).mean(axis=level),
        100 * (share == 1).mean(axis=level),
        found.solutions.sum(axis=level),
        margin,
    ]
    with table(arguments, columns, heading) as rows:
        rows.write(values, np.column_stack(values))
        total = float(share.mean())
        rows.note("reached", total, f"reached: {100 * total:.1f} % of all poses")


def _all(arguments: argparse.Namespace, found: ReachMap, heading: str) -> None:
    """One row for each position."""
    import numpy as np

    from irbkin.cli.output import Column, table

    columns = (
        Column("x", "mm", "8.1f"),
        Column("y", "mm", "8.1f"),
        Column("z", "mm", "8.1f"),
        Column("reached", "percent", "7.1f"),
        Column("solutions", "", "d"),
        Column("margin", "", "7.3f"),
    )
    x, y, z = (axis.ravel() for axis in np.meshgrid(found.x, found.y, found.z, indexing="ij"))
    share, solutions = found.share.ravel(), found.solutions.ravel()
    margin = found.margin.ravel()
    with table(arguments, columns, heading) as rows:
        rows.write(
            [x * 1e3, y * 1e3, z * 1e3, 100 * share, solutions, margin],
            np.column_stack([x, y, z, share, solutions, margin]),
        )
