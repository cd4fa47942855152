"""`irbkin record`: an arm, a program or a scene as a file of rerun."""

from __future__ import annotations

import argparse

from irbkin.cli.arguments import Parser
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.scenes import INPUTS, add_scene, read_scene

HELP = f"""The file is for the viewer of rerun (rerun.io): the motion over time, curves of the
joints, findings as marks and as a log. It needs rerun: pip install 'irbkin[rerun]'.
{INPUTS}"""
EXAMPLES = """  irbkin record "IRB 2600-12/1.65" program.mod --cell cell.toml -o program.rrd
  irbkin record scene.json -o scene.rrd"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add_scene(parser)
    parser.add("-o", "--output", metavar="FILE", required=True, help="the file to write (.rrd)")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    output: str = arguments.output
    if not output.lower().endswith(".rrd"):
        raise CommandError(f"--output: {output} must end in .rrd")
    read_scene(arguments).save(output)
    return FINE
