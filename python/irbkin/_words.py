"""Words that messages and representations share."""

from __future__ import annotations

from collections.abc import Iterable

MOST = 10


def listed(things: Iterable[object]) -> str:
    """The first ten of several, and how many more there are."""
    words = list(map(str, things))
    more = f" and {len(words) - MOST} more" if len(words) > MOST else ""
    return ", ".join(words[:MOST]) + more


def counted(count: int, noun: str) -> str:
    """A number of things: "1 pose", "2,000 poses"."""
    return f"{count:,} {noun}{'s' * (count != 1)}"
