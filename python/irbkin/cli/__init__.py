"""The command `irbkin`: one verb a file, imported when it is called (docs/guide/cli.md)."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from irbkin.cli.errors import FINE, CommandError, guarded

if TYPE_CHECKING:
    from irbkin.cli.arguments import Parser

__all__ = ["main"]

# A verb is the module `irbkin.cli.<verb>`, with _ for -: its docstring is the help, it has
# `add_arguments` and `run`. A new one needs its file and its line here.
VERBS = {
    "catalog": "list the arms, or show one",
    "fk": "pose of the tool of joint angles",
    "ik": "joint angles of a pose: all solutions, the nearest, or the one of a confdata",
    "check": "find what is wrong with the moves of RAPID modules, and correct confdata",
    "arms": "which arms of the catalog can run a program, and from which stand",
    "lsp": "serve findings, hovers and corrections to an editor, while one types",
    "rule": "explain a code of check",
    "diff": "find what differs between two backups: data, moves, targets",
    "port": "solve the confdata of a program anew for another arm",
    "rapid": "the moves of a RAPID routine as one motion: times, joints, findings",
    "view": "show an arm, a program or a scene in the browser",
    "egm-sim": "a model of an ABB controller that follows set points of EGM on this machine",
    "urdf": "write an arm as URDF",
    "completion": "write what completes commands in a shell",
}
ABOUT = """Kinematics of industrial robot arms. Angles in degrees, lengths in millimeters, as
headers say; arrays in .npy files are as in the Python package, in radians and meters."""
CODES = """
Exit codes: 0 fine, 1 findings or unreachable, 2 wrong usage or input, 130 interrupted.
`irbkin VERB --help` has the arguments and examples of a verb.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with the arguments behind its name, and return the exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    return guarded(lambda: _run(given))


def _run(given: list[str]) -> int:
    if len(given) > 1 and given[0] == "help":
        given = [given[1], "--help"]
    verb, *rest = given or ["help"]
    if verb in ("-h", "--help", "help"):
        root(lambda verb, parser: None).print_help()
    elif verb == "--version" or rest == ["--version"]:
        from irbkin import __version__

        print(f"irbkin {__version__}")
    elif verb in VERBS:
        parser = parser_of(verb)
        code: int = importlib.import_module(module_of(verb)).run(parser.parsed(rest))
        return code
    else:
        from irbkin._arguments import close

        raise CommandError(f"unknown verb {verb!r}: {close(verb, VERBS)} (irbkin --help)")
    return FINE


def module_of(verb: str) -> str:
    return f"irbkin.cli.{verb.replace('-', '_')}"


def parser_of(verb: str, own: Parser | None = None) -> Parser:
    from irbkin.cli.arguments import Parser

    module = importlib.import_module(module_of(verb))
    parser = own or Parser(prog=f"irbkin {verb}")
    parser.description, _, examples = (module.__doc__ or "").partition("\nExamples:\n")
    parser.examples = f"\nexamples:\n{examples}"
    module.add_arguments(parser)
    return parser


def root(fill: Callable[[str, Parser], object]) -> Parser:
    from irbkin.cli.arguments import Parser

    parser = Parser(prog="irbkin", description=ABOUT, usage="irbkin VERB ...")
    parser.examples = CODES
    parser.add_argument("--version", action="store_true", help="the version")
    verbs = parser.add_subparsers(title="verbs", metavar="VERB")
    for verb, words in VERBS.items():
        fill(verb, verbs.add_parser(verb, help=words))
    return parser
