"""The command `irbkin`: one verb a file, imported when it is called (docs/guide/cli.md)."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from irbkin.cli.errors import FINE, CommandError, guarded

__all__ = ["main"]

# A verb is the module `irbkin.cli.<verb>`, which has HELP, EXAMPLES, `add_arguments` and `run`.
# A new one needs its file and its line here. (`map` is here the verb, once it was called.)
VERBS = {
    "catalog": "list the arms, or show one",
    "fk": "pose of the tool of joint angles",
    "ik": "joint angles of a pose: all solutions, the nearest, or the one of a confdata",
    "check": "find what is wrong with the moves of RAPID modules, and correct confdata",
    "path": "joints along a path of poses, on one branch",
    "plan": "the best joints along a path of poses, over branches, turns and tool angles",
    "lsp": "serve findings, hovers and corrections to an editor, while one types",
    "rule": "explain a code of check",
    "diff": "find what differs between two backups: data, moves, targets",
    "rapid": "the moves of a RAPID routine as one motion: times, joints, findings",
    "map": "what an arm reaches: a grid of positions, each with many orientations",
    "plot": "draw solutions, paths and reach",
    "view": "show an arm, a program or a scene in the browser",
    "urdf": "write an arm as URDF",
}
OVERVIEW = """usage: irbkin VERB ... [--help]

Kinematics of industrial robot arms. Angles in degrees, lengths in millimeters, as headers say;
arrays in .npy files are as in the Python package, in radians and meters.

{verbs}

options:
  -h, --help   this text; irbkin VERB --help has the arguments and examples of a verb
  --version    the version

Exit codes: 0 fine, 1 findings or unreachable, 2 wrong usage or input, 130 interrupted.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        arguments: Without the program's name; the process's when not given.

    Returns:
        The exit code.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    return guarded(lambda: _run(given))


def _run(given: list[str]) -> int:
    if len(given) > 1 and given[0] == "help":
        given = [given[1], "--help"]
    if not given or given[0] in ("-h", "--help", "help"):
        width = max(len(verb) for verb in VERBS)
        lines = (f"  {verb:{width}}   {words}" for verb, words in VERBS.items())
        print(OVERVIEW.format(verbs="\n".join(lines)), end="")
        return FINE
    if given[0] == "--version" or given[1:] == ["--version"]:
        from irbkin import __version__

        print(f"irbkin {__version__}")
        return FINE
    verb, *rest = given
    if verb not in VERBS:
        import difflib

        close = difflib.get_close_matches(verb, VERBS, n=3, cutoff=0.5) or list(VERBS)
        raise CommandError(
            f"unknown verb {verb!r}: did you mean {', '.join(close)}? (irbkin --help)"
        )
    import importlib

    from irbkin.cli.arguments import Parser

    module = importlib.import_module(f"irbkin.cli.{verb}")
    parser = Parser(verb, VERBS[verb], module.HELP, module.EXAMPLES)
    module.add_arguments(parser)
    code: int = module.run(parser.parsed(rest))
    return code
