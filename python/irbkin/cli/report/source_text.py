"""The text of a file by lines, and the places of bytes in it."""

from __future__ import annotations

from bisect import bisect
from functools import cached_property
from itertools import accumulate


class SourceText:
    """The text of a file, taken apart when it is asked for."""

    def __init__(self, text: str) -> None:
        self.text = text

    @cached_property
    def lines(self) -> list[str]:
        """Its lines, without their ends."""
        return [it.rstrip("\r") for it in self.text.split("\n")]

    @cached_property
    def _rows(self) -> list[bytes]:
        return self.text.encode().split(b"\n")

    @cached_property
    def _starts(self) -> list[int]:
        """The first byte of each line."""
        return list(accumulate((len(it) + 1 for it in self._rows[:-1]), initial=0))

    def line(self, number: int) -> str:
        """A line by its number from 1, empty if there is none."""
        return self.lines[number - 1] if 0 < number <= len(self.lines) else ""

    def position(self, byte: int) -> tuple[int, int]:
        """Line and column, from 1 and in characters, of a byte of the text in UTF-8."""
        number = bisect(self._starts, byte)
        before = self._rows[number - 1][: byte - self._starts[number - 1]]
        return number, len(before.decode()) + 1

    def corrected(self, edits: tuple[tuple[int, int, str], ...]) -> dict[int, str]:
        """Lines by their numbers with edits, none of which goes beyond its line."""
        lines: dict[int, bytes] = {}
        for begin, end, new in sorted(edits, reverse=True):
            number = bisect(self._starts, begin)
            start = self._starts[number - 1]
            line = lines.get(number, self._rows[number - 1])
            lines[number] = line[: begin - start] + new.encode() + line[end - start :]
        return {number: lines[number].decode().strip() for number in sorted(lines)}
