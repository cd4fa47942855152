"""The meaning of a code of `irbkin check`, its cure, and an example of RAPID that has it. Names
are taken, too. Without a code all are listed.

Examples:
  irbkin rule R102
  irbkin rule wrong-confdata
"""

import argparse
import textwrap

from irbkin.check.codes import close, code_of, codes, rules
from irbkin.cli.arguments import Parser
from irbkin.cli.errors import FINE, CommandError


def add_arguments(parser: Parser) -> None:
    parser.add("codes", metavar="CODE", nargs="*", help="a code or its name")


def run(arguments: argparse.Namespace) -> int:
    texts = [explained(word) for word in arguments.codes]
    print("\n".join(texts) if texts else listed(), end="")
    return FINE


def explained(word: str) -> str:
    code = code_of(word)
    if code not in rules():
        raise CommandError(f"unknown code {word!r}: did you mean {close(word)}? (irbkin rule)")
    rule = rules()[code]
    parts = [f"{code} {rule.name} ({codes()[code].severity})", rule.meaning, f"Cure: {rule.cure}"]
    for language, example in rule.examples:
        label = "Example" if language == "rapid" else language.upper()
        parts.append(f"{label}:\n{textwrap.indent(example.rstrip(), '    ')}")
    return "\n\n".join(parts) + "\n"


def listed() -> str:
    lines = [
        f"{it.id}  {it.name:22}  {it.severity:8}{'' if it.is_default else '(only if selected)'}"
        for it in codes().values()
    ]
    return "".join(f"{line.rstrip()}\n" for line in lines)
