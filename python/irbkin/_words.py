"""Words that messages and representations share."""

import re
from collections.abc import Iterable

MOST = 10
CONTROL = re.compile(
    "[\x00-\x08\x0a-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff]"
)
"""Characters that move the cursor, color, end a line or turn the direction of a terminal."""


def listed(things: Iterable[object]) -> str:
    """The first ten of several, and how many more there are."""
    words = list(map(str, things))
    more = f" and {len(words) - MOST} more" if len(words) > MOST else ""
    return ", ".join(words[:MOST]) + more


def counted(count: int, noun: str) -> str:
    """A number of things: "1 pose", "2,000 poses"."""
    return f"{count:,} {noun}{'s' * (count != 1)}"


def singularities(at: int, near: int) -> str:
    """The singularities among flags of `SingularityKind`: "at wrist, near elbow"."""
    kinds = (4, "wrist"), (8, "elbow"), (16, "shoulder")
    words = (f"{'at' if at & bit else 'near'} {word}" for bit, word in kinds if near & bit)
    return ", ".join(words)


def visible(text: str) -> str:
    """A text of a file or a user in one line, with escapes for what a terminal would obey."""
    return CONTROL.sub(lambda match: match[0].encode("unicode_escape").decode(), text)
