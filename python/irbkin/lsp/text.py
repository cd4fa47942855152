"""The text of a document, with the positions of editors, modules and edits."""

from __future__ import annotations

import re
from bisect import bisect
from functools import cached_property
from itertools import accumulate

from lsprotocol import types

from irbkin.lsp.code import Span, blocks

END_OF_LINE = re.compile(r"\r\n|\n|\r")
NAME = re.compile(r"[^\W\d]\w*")


class Text:
    """A text. Offsets count characters, positions of the protocol units of UTF-16."""

    def __init__(self, source: str) -> None:
        self.source = _sound(source)

    @cached_property
    def _starts(self) -> list[int]:
        if "\r" not in self.source:
            return self._rows
        return [0, *(match.end() for match in END_OF_LINE.finditer(self.source))]

    @cached_property
    def _rows(self) -> list[int]:
        """The offset of each line as modules count them: a line feed ends one, nothing else."""
        return [0, *accumulate(len(row) + 1 for row in self.source.split("\n")[:-1])]

    @cached_property
    def _bytes(self) -> bytes:
        return self.source.encode()

    @cached_property
    def blocks(self) -> list[Span]:
        return blocks(self.source)

    def position(self, offset: int) -> types.Position:
        line = bisect(self._starts, offset) - 1
        units = self.source[self._starts[line] : offset].encode("utf-16-le")
        return types.Position(line, len(units) // 2)

    def offset(self, position: types.Position) -> int:
        """Return the offset of a position, clamped to the end of its line and of the text."""
        if position.line >= len(self._starts):
            return len(self.source)
        begin = self._starts[position.line]
        end = self._starts[position.line + 1] if position.line + 1 < len(self._starts) else None
        line = self.source[begin:end].rstrip("\r\n")
        if self.source.isascii():
            return begin + min(position.character, len(line))
        units = line.encode("utf-16-le")[: 2 * position.character]
        # Half of a surrogate pair is dropped.
        return begin + len(units.decode("utf-16-le", "ignore"))

    def at(self, line: int, column: int) -> int:
        """Return the offset of a line and a column of a module, both from 1."""
        if not 0 < line <= len(self._rows):
            return len(self.source) if line > 0 else 0
        return min(self._rows[line - 1] + max(column - 1, 0), len(self.source))

    def place(self, offset: int) -> tuple[int, int]:
        """Return the line and the column of an offset, both from 1, as modules count them."""
        line = bisect(self._rows, offset)
        return line, offset - self._rows[line - 1] + 1

    def row(self, line: int) -> str:
        """Return a line by its number from 1, without its end; empty beyond the last."""
        if not 0 < line <= len(self._rows):
            return ""
        end = self._rows[line] - 1 if line < len(self._rows) else None
        return self.source[self._rows[line - 1] : end].rstrip("\r")

    def statement_end(self, begin: int) -> int:
        """Return the offset of the next semicolon, or the end of the text."""
        end = self.source.find(";", begin)
        return len(self.source) if end < 0 else end

    def range(self, begin: int, end: int) -> types.Range:
        return types.Range(self.position(begin), self.position(end))

    def range_of_bytes(self, begin: int, end: int) -> types.Range:
        if not self.source.isascii():
            begin, end = (len(self._bytes[:byte].decode(errors="ignore")) for byte in (begin, end))
        return self.range(begin, end)

    def changed(self, change: types.TextDocumentContentChangeEvent) -> Text:
        if isinstance(change, types.TextDocumentContentChangeWholeDocument):
            return Text(change.text)
        begin, end = self.offset(change.range.start), self.offset(change.range.end)
        return Text(self.source[:begin] + change.text + self.source[max(begin, end) :])

    def word(self, offset: int) -> tuple[int, int]:
        line, column = self.place(offset)
        for match in NAME.finditer(self.row(line)):
            if match.start() < column <= match.end() + 1:
                begin = self._rows[line - 1]
                return begin + match.start(), begin + match.end()
        return offset, offset


def _sound(text: str) -> str:
    """A text without lone surrogates, which no file can contain."""
    units = b"" if text.isascii() else text.encode("utf-16-le", "surrogatepass")
    return units.decode("utf-16-le", "replace") or text
