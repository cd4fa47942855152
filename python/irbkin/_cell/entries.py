"""Tables of a TOML file, and values that are checked when they are taken out."""

from __future__ import annotations

import re
import reprlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from irbkin._arguments import check_extra, close
from irbkin._arrays import Floats
from irbkin.errors import InvalidModelError, IrbkinError

MOST_CHARACTERS = 10_000_000
"""Characters of a TOML text, which take seconds to parse."""
MOST_PARTS = 32
"""Parts of a dotted key: a parser takes time and memory with the square of their number."""
PART = r"""(?:[\w-]+|"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*(?:"|(?=[\\\n]|\Z))|'[^'\n]*(?:'|(?=\n|\Z)))"""
TOKEN = re.compile(
    r"#[^\n]*"
    r'|"{3}[^"\\]*(?:(?:\\.|"(?!""))[^"\\]*)*(?:"{3}|\\?\Z)'
    r"|'{3}.*?(?:'{3}|\Z)"
    rf"|(?P<key>{PART}(?:[ \t]*\.[ \t]*{PART})*)"
    r"""|[^\w#"'-]+|.""",
    re.DOTALL,
)
"""Comments, texts of several lines, dotted keys or single values, and what is between them."""


class EntryError(InvalidModelError):
    """An error that names an entry of a file."""


@dataclass(frozen=True)
class Entry:
    """A table of a file, with the keys that lead to it, the folder, and if meshes are solid."""

    text: str
    folder: str
    keys: tuple[str, ...]
    table: Mapping[str, Any]
    solid: bool = True

    def refuse(self, cause: str | IrbkinError, key: str = "") -> NoReturn:
        """Raise an error that names the entry and its line; an error that does is raised again."""
        if isinstance(cause, EntryError):
            raise cause
        keys = (*self.keys, key) if key else self.keys
        line = line_of(self.text, keys)
        names = ".".join(keys)
        places = ([f"line {line}"] if line else []) + ([names] if names else [])
        raise EntryError(": ".join([", ".join(places), str(cause)]) if places else str(cause))

    def check(self, *known: str) -> None:
        for key in self.table:
            if key not in known:
                self.refuse(f"unknown key; {close(key, known)}", key)

    def sub(self, key: str) -> Entry:
        """The table of a key, empty if it is not there."""
        table = self.table.get(key, {})
        if not isinstance(table, Mapping):
            self.refuse(f"is {table!r}, it must be a table", key)
        return Entry(self.text, self.folder, (*self.keys, key), table, self.solid)

    def subs(self, key: str) -> dict[str, Entry]:
        own = self.sub(key)
        return {name: own.sub(name) for name in own.table}

    def _value(self, key: str, kind: str, is_fit: Callable[[Any], bool], default: Any) -> Any:
        value = self.table.get(key, default)
        if value is None:
            self.refuse(f"{key} is missing, {kind}")
        if not is_fit(value):
            self.refuse(f"is {reprlib.repr(value)}, it must be {kind}", key)
        return value

    def number(self, key: str, default: float | None = None) -> float:
        return float(self._value(key, "a number", _is_number, default))

    def numbers(self, key: str, count: int) -> Floats:
        def is_fit(value: Any) -> bool:
            return isinstance(value, list) and len(value) == count and all(map(_is_number, value))

        return np.array(self._value(key, f"a list of {count} numbers", is_fit, None), dtype=float)

    def name(self, key: str) -> str:
        return str(self._value(key, "a text", lambda it: isinstance(it, str), None))

    def names(self, key: str) -> list[str]:
        def is_fit(value: Any) -> bool:
            return isinstance(value, list) and all(isinstance(it, str) for it in value)

        return list(self._value(key, "a list of texts", is_fit, None))

    def truth(self, key: str, default: bool) -> bool:
        return bool(self._value(key, "true or false", lambda it: isinstance(it, bool), default))


def parsed(text: str) -> dict[str, Any]:
    _bound(text)
    try:
        import tomllib
    except ImportError:
        check_extra("TOML in Python 3.10", "mesh", "tomli")
        import tomli as tomllib  # type: ignore[import-not-found, no-redef, unused-ignore]
    try:
        return tomllib.loads(text)
    # Python refuses whole numbers of thousands of digits.
    except ValueError as error:
        raise InvalidModelError(f"is not TOML: {error}") from None
    except RecursionError:
        raise InvalidModelError("is not TOML that can be read: it is nested too deeply") from None


def _bound(text: str) -> None:
    """Refuse a text that takes a parser long."""
    if len(text) > MOST_CHARACTERS:
        raise InvalidModelError(f"has more than {MOST_CHARACTERS} characters, the most of TOML")
    for token in TOKEN.finditer(text):
        key = token["key"]
        if key is not None and key.count(".") >= MOST_PARTS:
            parts = len(re.findall(PART, key))
            if parts > MOST_PARTS:
                line = text.count("\n", 0, token.start()) + 1
                raise InvalidModelError(
                    f"line {line}: the key {key[:20]}.. has {parts} parts, at most {MOST_PARTS}"
                )


def _is_number(value: object) -> bool:
    return isinstance(value, float) or (type(value) is int and abs(value) < 1e308)


def line_of(text: str, keys: tuple[str, ...]) -> int | None:
    """The line of the last of some keys, each of which is in or after the line of the one before.

    None if one is in no line, written with escapes for instance.
    """
    lines = [re.sub(r"#.*", "", line) for line in text.splitlines()]
    at = None
    for key in keys:
        word = re.compile(rf"(?<![\w-]){re.escape(key)}(?![\w-])")
        at = next((row for row in range(at or 0, len(lines)) if word.search(lines[row])), None)
        if at is None:
            return None
    return None if at is None else at + 1
