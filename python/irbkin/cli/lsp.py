"""A language server over stdin and stdout, which editors start (docs/guide/lsp.md). A file is
checked as one types, with all modules of its program. Options that are not given here, nor by the
editor, are taken from irbkin.toml or pyproject.toml. It needs pygls: pip install 'irbkin[lsp]'.

Examples:
  irbkin lsp
  irbkin lsp "IRB 2600-12/1.65"
"""

import argparse

from irbkin.cli.arguments import ROBOT_HELP, Parser
from irbkin.cli.check import add_arm, given
from irbkin.cli.errors import FINE


def add_arguments(parser: Parser) -> None:
    parser.add("arm", metavar="ROBOT", nargs="?", help=ROBOT_HELP)
    add_arm(parser)
    parser.add("--stdio", action="store_true", help="the default, for editors that give it")


def run(arguments: argparse.Namespace) -> int:
    from irbkin.lsp import serve

    arguments.robot = vars(arguments).pop("arm") or arguments.robot
    serve(given(arguments))
    return FINE
