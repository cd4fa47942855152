"""The codes of a check: their names, severities and rules, and the choice among them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from irbkin.cli.errors import CommandError

SYNTAX = "E001"
"""The code of a text that is broken. It is found while modules are read."""
BACKUP = "B001"
"""The code of what the files of a backup leave open."""
FILES = (
    (SYNTAX, "syntax", "error", True),
    ("E002", "unread-file", "error", True),
    ("E003", "doubled-module", "warning", True),
    (BACKUP, "backup", "warning", True),
)
"""Codes of files, which are found while they are read."""
NOT_CHECKED = ("U801", "U802", "U804")
"""Codes of moves that are not checked: errors with --strict."""
LEVELS = ("error", "warning", "note")
"""Severities, the worst first."""


class Code(NamedTuple):
    """A code, and whether it is shown unless codes are selected."""

    id: str
    name: str
    severity: str
    is_default: bool


class Rule(NamedTuple):
    """The rule behind a code: a chapter of `rules.md`."""

    code: str
    name: str
    meaning: str
    cure: str
    blocks: str
    """The example, between fences as Markdown has them."""

    @property
    def title(self) -> str:
        """The first sentence of the meaning."""
        return re.split(r"(?<=\S)\. |\.$|: ", " ".join(self.meaning.split()), maxsplit=1)[0]

    @property
    def examples(self) -> list[tuple[str, str]]:
        """The blocks of the example: a language and the text."""
        return re.findall(r"^```(\w+)[^\n]*\n(.*?)^```$", self.blocks, re.MULTILINE | re.DOTALL)


_codes: dict[str, Code] = {}
_rules: dict[str, Rule] = {}


def codes() -> dict[str, Code]:
    """Every code, with the codes of files first."""
    if not _codes:
        from irbkin._core import check_codes

        known = [Code(*row) for row in (*FILES, *check_codes())]
        _codes.update({code.id: code for code in known})
    return _codes


def rules() -> dict[str, Rule]:
    """The rule of every code."""
    if not _rules:
        _rules.update(_read_rules())
    return _rules


def _read_rules() -> dict[str, Rule]:
    from pathlib import Path

    text = Path(__file__).with_name("rules.md").read_text(encoding="utf-8")
    found = {}
    for chapter in re.split(r"^### ", text, flags=re.MULTILINE)[1:]:
        heading, _, body = chapter.partition("\n\n")
        prose, fence, blocks = body.partition("```")
        meaning, _, cure = prose.partition("Cure: ")
        code, name = heading.split()
        found[code] = Rule(code, name, meaning.strip(), cure.strip(), f"{fence}{blocks.strip()}\n")
    return found


def page() -> str:
    """The rules as the documents have them, with severities."""
    parts = []
    for code, rule in rules().items():
        it = codes()[code]
        shown = "" if it.is_default else ", only if selected"
        parts.append(
            f"### {code} {rule.name}\n\n*{it.severity}{shown}*\n\n{rule.meaning}\n\n"
            f"Cure: {rule.cure}\n\n{rule.blocks}".rstrip()
            + "\n"
        )
    return "\n".join(parts)


def meant(words: Iterable[str]) -> set[str]:
    """Return the codes of words: codes, their beginnings, names or ALL."""
    names = {code.name: code.id for code in codes().values()}
    found = set()
    for word in filter(None, (word.strip() for word in words)):
        begin = names.get(word.lower(), word.upper())
        these = [it for it in codes() if begin == "ALL" or it.startswith(begin)]
        if not these:
            raise CommandError(f"unknown code {word!r}: did you mean {close(word)}? (--codes)")
        found.update(these)
    return found


def close(word: str) -> str:
    """Return the codes that a word may mean, or the letters of the groups."""
    import difflib

    names = {code.name: code.id for code in codes().values()}
    near = difflib.get_close_matches(word.upper(), codes(), 3)
    near = near or [names[it] for it in difflib.get_close_matches(word.lower(), names, 3)]
    near = near or [it for it in codes() if it[0] == word[:1].upper()]
    return ", ".join(near or sorted({code[0] for code in codes()}))


def selected(
    select: Iterable[str] | None, ignore: Iterable[str], *, is_strict: bool = False
) -> set[str]:
    """Return the codes that are wanted. Codes of files are found whatever is selected."""
    wanted = {code.id for code in codes().values() if code.is_default}
    if select is not None:
        wanted = meant(select)
    if is_strict:
        wanted.update(NOT_CHECKED)
    ignored = meant(ignore)
    if not wanted - ignored:
        raise CommandError(
            "--select and --ignore leave no code to check: select codes or their beginnings, or "
            "ALL (--codes lists them)"
        )
    return (wanted | {code for code, *_ in FILES}) - ignored
