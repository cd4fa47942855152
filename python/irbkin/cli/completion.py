"""Completion of verbs, options and files in bash, zsh, fish, tcsh or PowerShell: a file that the
shell reads when it starts.

Examples:
  irbkin completion bash > ~/.local/share/bash-completion/completions/irbkin
  irbkin completion zsh > ~/.zfunc/_irbkin
"""

import argparse

import shtab

from irbkin.cli import parser_of, root
from irbkin.cli.arguments import Parser
from irbkin.cli.errors import FINE

FILES = ("FILE", "OLD", "NEW", "OTHER", "Q")


def add_arguments(parser: Parser) -> None:
    parser.add("shell", choices=shtab.SUPPORTED_SHELLS, help="of which shell")


def run(arguments: argparse.Namespace) -> int:
    print(shtab.complete(root(_fill), arguments.shell))
    return FINE


def _fill(verb: str, own: Parser) -> None:
    for action in parser_of(verb, own)._actions:
        if action.metavar in FILES:
            action.complete = shtab.FILE  # type: ignore[attr-defined]
