"""The codes of a check: names, severities, rules and selection."""

import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import NamedTuple

from irbkin._core import check_codes
from irbkin.errors import IrbkinError

UNREAD = "E002"
BACKUP = "B001"
FILES = (
    ("E001", "syntax", "error", True),
    (UNREAD, "unread-file", "error", True),
    ("E003", "doubled-module", "warning", True),
    (BACKUP, "backup", "warning", True),
)
TOOLS = (
    ("T301", "unset-load", "error", True),
    ("T302", "doubtful-load", "warning", True),
    ("T303", "tool-without-shape", "note", True),
    ("T304", "load-units", "error", True),
    ("T305", "load-note", "note", True),
)
NOT_CHECKED = ("U801", "U802", "U804")
"""Codes of moves that are not checked: errors with --strict."""
REASONS = {
    "U801": "unknown values",
    "U802": "instructions or calls that are not followed",
    "U804": "unknown units",
    "N601": "unknown targets",
    "N602": "unknown tools",
    "N603": "unknown work objects",
    "R106": "absent axes",
    "C205": "old confdata",
    "D701": "invalid frames",
    "D704": "indices outside arrays",
}
"""Why a move is not checked, by the code of the finding on it."""
LEVELS = ("error", "warning", "note")
"""Severities, the worst first."""
PAGE = Path(__file__).with_name("rules.md")


class Code(NamedTuple):
    """A code, and whether it is in the default selection."""

    id: str
    name: str
    severity: str
    is_default: bool


class Rule(NamedTuple):
    """The rule behind a code: a chapter of `PAGE`."""

    code: str
    name: str
    meaning: str
    cure: str
    blocks: str
    """The example, in fenced blocks of Markdown."""

    @property
    def title(self) -> str:
        return re.split(r"(?<=\S)\. |\.$|: ", " ".join(self.meaning.split()), maxsplit=1)[0]

    @property
    def examples(self) -> list[tuple[str, str]]:
        """The blocks of the example: a language and the text."""
        return re.findall(r"^```(\w+)[^\n]*\n(.*?)^```$", self.blocks, re.MULTILINE | re.DOTALL)


@cache
def codes() -> dict[str, Code]:
    """Every code, with the codes of files first."""
    return {row[0]: Code(*row) for row in (*FILES, *TOOLS, *check_codes())}


@cache
def rules() -> dict[str, Rule]:
    found = {}
    for chapter in re.split(r"^### ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]:
        heading, _, body = chapter.partition("\n\n")
        prose, fence, blocks = body.partition("```")
        meaning, _, cure = prose.partition("Cure: ")
        code, name = heading.split()
        found[code] = Rule(code, name, meaning.strip(), cure.strip(), f"{fence}{blocks.strip()}\n")
    return found


def code_of(word: str) -> str:
    """Return the code with this name, or the word in upper case."""
    return next((code.id for code in codes().values() if code.name == word.lower()), word.upper())


def meant(words: Iterable[str]) -> set[str]:
    """Return the codes of words: codes, prefixes, names or ALL."""
    found = set()
    for word in filter(None, (word.strip() for word in words)):
        begin = code_of(word)
        these = [code for code in codes() if begin == "ALL" or code.startswith(begin)]
        if not these:
            raise IrbkinError(f"unknown code {word!r}: did you mean {close(word)}? (irbkin rule)")
        found.update(these)
    return found


def close(word: str) -> str:
    import difflib

    near = difflib.get_close_matches(word.upper(), codes(), 3)
    if not near:
        names = {code.name: code.id for code in codes().values()}
        near = [names[name] for name in difflib.get_close_matches(word.lower(), names, 3)]
    near = near or [code for code in codes() if code[0] == word[:1].upper()]
    return ", ".join(near or sorted({code[0] for code in codes()}))


def selected(
    select: Iterable[str] | None, ignore: Iterable[str], *, is_strict: bool = False
) -> set[str]:
    """Return the selected codes; codes of files are selected unless they are ignored."""
    wanted = {code.id for code in codes().values() if code.is_default}
    if select is not None:
        wanted = meant(select)
    if is_strict:
        wanted.update(NOT_CHECKED)
    ignored = meant(ignore)
    if not wanted - ignored:
        raise IrbkinError(
            "--select and --ignore leave no code to check: select codes or their beginnings, or "
            "ALL (irbkin rule lists them)"
        )
    return (wanted | {code for code, *_ in FILES}) - ignored
