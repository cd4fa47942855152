"""`irbkin lsp`: a language server."""

from __future__ import annotations

import argparse

from irbkin.cli.arguments import Parser
from irbkin.cli.check import add_arm, add_step, given
from irbkin.cli.errors import FINE

HELP = """A language server over stdin and stdout, which editors start (docs/guide/lsp.md). A file
is checked as one types, with all modules of its program: of its task in a backup, which gives the
arm, or of the folder of irbkin.toml or pyproject.toml, or else of its own folder. Options that are
not given here, nor by the editor, are taken from these files. This verb needs pygls:
pip install 'irbkin[lsp]'."""
EXAMPLES = """  irbkin lsp
  irbkin lsp --robot "IRB 2600-12/1.65\""""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add_arm(parser)
    add_step(parser)
    parser.add("--stdio", action="store_true", help="the default, for editors that give it")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    from irbkin.lsp import serve

    serve(given(arguments))
    return FINE
