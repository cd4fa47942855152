"""RAPID text as it is typed: its words outside strings and comments, blocks, calls."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise

HIDDEN = re.compile(r'"[^"\n]*"?|![^\n]*')
"""Strings and comments; both end with their line."""
PARTS = re.compile(rf"{HIDDEN.pattern}|[^\W\d]\w*|\d[\w.]*|:=|\S")
BLOCKS = {"MODULE", "PROC", "FUNC", "TRAP", "RECORD", "IF", "FOR", "WHILE", "TEST"}
EDGES = re.compile(
    rf"{HIDDEN.pattern}|\b(?:(?:END)?(?:{'|'.join(BLOCKS)})|THEN)\b|;", re.IGNORECASE
)
COUNTER, COMPONENT = re.compile(r"\w+\s+(\w+)"), re.compile(r"(\w+)\s*;")
STORAGE = {"LOCAL", "TASK", "CONST", "PERS", "VAR"}
VALUES = {"IF", "ELSEIF", "WHILE", "FOR", "TEST", "CASE", "RETURN", "RAISE", "CONNECT"}
"""Words in front of values, which are no call."""
NAMELESS = {"MODULE", "PROC", "FUNC", "TRAP", "RECORD", "ALIAS", "GOTO"}
ENDS = {"THEN", "ELSE", "DO", "ERROR", "UNDO", "BACKWARD", *(f"END{word}" for word in BLOCKS)}
"""Words behind which a statement begins."""
OPERATORS = {"AND", "OR", "XOR", "NOT", "DIV", "MOD"}
MOST_ROWS = 30
"""Lines of a statement."""


def before(source: str, at: int) -> str | None:
    """Return the character before a place in a line without blanks; None in a string or comment."""
    row, end = source.rfind("\n", 0, at) + 1, source.find("\n", at)
    hidden = HIDDEN.finditer(source, row, len(source) if end < 0 else end)
    if any(part.start() <= at < part.end() for part in hidden):
        return None
    return source[row:at].rstrip()[-1:]


def occurrences(source: str, name: str) -> Iterator[int]:
    for match in re.finditer(rf"\b{re.escape(name)}\b", source, re.IGNORECASE):
        if before(source, match.start()) is not None:
            yield match.start()


Span = tuple[int, int, str]


def blocks(source: str) -> list[Span]:
    found, open_ = list[Span](), list[tuple[int, str]]()
    for match in EDGES.finditer(source):
        word = match[0].upper()
        if word == ";":
            # An IF without THEN ends with its statement.
            while open_ and open_[-1][1] == "IF":
                open_.pop()
        elif word == "THEN" and open_ and open_[-1][1] == "IF":
            open_.append((open_.pop()[0], "THEN"))
        elif word in BLOCKS:
            open_.append((match.start(), word))
        elif (own := word[3:].replace("IF", "THEN")) in {it for _, it in open_}:
            while open_[-1][1] != own:
                open_.pop()
            found.append((open_.pop()[0], match.end(), own))
    return sorted(found)


def own_names(source: str, blocks: Iterable[Span]) -> Iterator[Span]:
    """Yield the begin, the end and the name of what only a block has: counters, components."""
    for begin, end, word in blocks:
        if word == "FOR" and (counter := COUNTER.match(source, begin)):
            yield begin, end, counter[1]
        elif word == "RECORD":
            yield from ((begin, end, it[1]) for it in COMPONENT.finditer(source, begin, end))


@dataclass
class Call:
    """A call, as far as it is written."""

    name: str
    """Empty for a bracket and for a statement that is no call: a value."""
    argument: int = 0
    """The number of required arguments before the place."""
    option: str | None = None
    """The optional argument at the place; empty behind its backslash."""
    options: list[str] = field(default_factory=list)
    """All that are written, in lower case."""
    kind: str = ""
    """The type of the datum that a value is declared for."""
    assigned: str = ""
    """The datum that a value is assigned to."""
    _is_required: bool = False

    def take(self, part: str, before: str) -> None:
        if part == ",":
            self.argument += self._is_required
            self.option, self._is_required = None, False
        elif part == "\\":
            self.option = ""
        elif before == "\\":
            self.option = part
            self.options.append(part.lower())
        elif self.option is None:
            self._is_required = True


BEGINNING, NOTHING, TYPE = ([Call(f"!{name}")] for name in ("beginning", "nothing", "type"))
"""Places that are in no call: where a statement begins, nothing is offered, a type is named."""


def calls_at(source: str, offset: int) -> list[Call]:
    begin = offset
    for _ in range(MOST_ROWS):
        begin = max(source.rfind("\n", 0, begin), 0)
    parts, last = list[str](), begin
    for match in PARTS.finditer(source, begin, offset):
        part = match[0]
        is_open = part[0] == "!" or (part[0] == '"' and (len(part) == 1 or part[-1] != '"'))
        if is_open and match.end() == offset:
            return NOTHING
        if part[0] == "!":
            continue
        is_word = part[0].isalpha()
        is_new = is_word and part.upper() not in OPERATORS
        if is_new and _is_over(parts, source[last : match.start()]):
            parts.clear()
        last = match.end()
        if is_word and match.end() == offset:
            break
        if part == ";" or part.upper() in ENDS or (part == ":" and "(" not in parts):
            parts.clear()
        else:
            parts.append(part)
    else:
        if _is_over(parts, source[last:offset]):
            parts.clear()
    return _calls(parts) if parts else BEGINNING


def _is_over(parts: list[str], gap: str) -> bool:
    """Whether a name behind a gap begins a statement: in a new line, or behind an IF condition."""
    if not parts or parts[-1].upper() in OPERATORS or not re.search(r'[\w)\]}"]$', parts[-1]):
        return False
    is_condition = parts[0].upper() == "IF" and len(parts) > 1
    return "\n" in gap or (is_condition and parts.count("(") == parts.count(")"))


def _calls(parts: list[str]) -> list[Call]:
    word = parts[0].upper()
    if word in NAMELESS or parts[-1] == ".":
        return NOTHING
    open_ = [Call("" if word in VALUES else parts[0])]
    if word in STORAGE:
        names = [part for part in parts if part.upper() not in STORAGE]
        if ":=" not in parts:
            return NOTHING if names else TYPE
        open_ = [Call("", kind=names[0].lower())]
    elif ":=" in parts and "\\" not in parts[: parts.index(":=")]:
        open_ = [Call("", assigned=parts[0] if parts[1:2] == [":="] else "")]
    for ahead, part in pairwise(parts):
        if part in "([{":
            is_call = part == "(" and ahead[-1].isalnum() and ahead.upper() not in OPERATORS
            open_[-1].take(part, ahead)
            open_.append(Call(ahead if is_call else ""))
        elif part in ")]}":
            open_ = open_[:-1] or [Call("")]
        else:
            open_[-1].take(part, ahead)
    return open_
