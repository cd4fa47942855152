"""Options of `irbkin check` from `irbkin.toml` or `pyproject.toml`."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from irbkin.cli.codes import meant
from irbkin.cli.errors import CommandError
from irbkin.cli.files import STDIN
from irbkin.cli.report import FORMATS
from irbkin.errors import InvalidModelError

if TYPE_CHECKING:
    from irbkin._cell.entries import Entry

TABLES = {"irbkin.toml": ("check",), "pyproject.toml": ("tool", "irbkin", "check")}
"""Files that have options, and the table with them. In one folder the first file counts."""


class Settings(NamedTuple):
    """Options of a file."""

    file: str = ""
    options: Mapping[str, Any] = {}

    def fill(self, arguments: argparse.Namespace) -> None:
        """Set the arguments that are not given."""
        for name, value in self.options.items():
            if getattr(arguments, name, None) is None:
                setattr(arguments, name, value)

    def matches(self, name: str, patterns: Iterable[str]) -> bool:
        """Whether a file, a folder that it is in, or the name of one fits a pattern."""
        from fnmatch import fnmatch

        path = os.path.relpath(name, os.path.dirname(self.file)).replace(os.sep, "/")
        parts = path.split("/")
        ways = {"/".join(parts[:count]) for count in range(1, len(parts) + 1)} | {*parts}
        return any(fnmatch(way, it.rstrip("/")) for it in patterns for way in ways)


def settings_of(names: Sequence[str]) -> Settings:
    """Read the options nearest to some files: of their common folder or the next one above it."""
    paths = [os.path.abspath(it) for it in names if it != STDIN]
    folder = os.path.commonpath(paths) if paths else os.getcwd()
    while True:
        for name, keys in TABLES.items():
            file = os.path.join(folder, name)
            if os.path.isfile(file) and (entry := _table(file, keys)):
                return Settings(file, _guarded(file, _options, entry))
        if folder == os.path.dirname(folder):
            return Settings()
        folder = os.path.dirname(folder)


def _table(file: str, keys: Sequence[str]) -> Entry | None:
    """The table of a file; a file for other tools may lack it."""
    from irbkin.cli.files import opened

    with opened(file) as stream:
        content = stream.read()
    is_own = len(keys) == 1
    # Other tools read their own: without this word it is not parsed.
    if not is_own and b"irbkin" not in content:
        return None
    entry: Entry | None = _guarded(file, _found, content, os.path.dirname(file), keys)
    return entry


def _found(content: bytes, folder: str, keys: Sequence[str]) -> Entry | None:
    from irbkin._cell.entries import Entry, parsed

    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InvalidModelError(f"is not UTF-8: {error}") from None
    entry = Entry(text, folder, (), parsed(text))
    for key in keys:
        if key == "check":
            entry.check(key)
        if key not in entry.table:
            return None
        entry = entry.sub(key)
    return entry


def _guarded(file: str, read: Callable[..., Any], *arguments: Any) -> Any:
    """Read something of a file, with its name in errors."""
    try:
        return read(*arguments)
    except InvalidModelError as error:
        raise CommandError(f"{file}: {error}") from None


def options_of(table: Mapping[str, Any], folder: str) -> dict[str, Any]:
    """Read options from a table that is in no file, with paths relative to a folder.

    Raises:
        InvalidModelError: A key or a value is wrong.
    """
    from irbkin._cell.entries import Entry

    return _options(Entry("", folder, (), table))


def _options(entry: Entry) -> dict[str, Any]:
    entry.check(*KEYS)
    return {key.replace("-", "_"): KEYS[key](entry, key) for key in entry.table}


def _robot(entry: Entry, key: str) -> str:
    name = entry.name(key)
    return _path(entry, key) if name.lower().endswith(".urdf") else name


def _path(entry: Entry, key: str) -> str:
    return os.path.join(entry.folder, entry.name(key))


def _codes(entry: Entry, key: str) -> list[str]:
    words = entry.names(key)
    try:
        meant(words)
    except CommandError as error:
        entry.refuse(str(error), key)
    return words


def _format(entry: Entry, key: str) -> str:
    form = entry.name(key)
    if form not in FORMATS:
        entry.refuse(f"is {form!r}, it must be one of {', '.join(FORMATS)}", key)
    return form


def _frame(entry: Entry, key: str) -> list[float]:
    numbers = _numbers(entry, key)
    if len(numbers) not in (3, 6, 7):
        entry.refuse(f"has {len(numbers)} numbers, it must have 3, 6 or 7 as --{key}", key)
    return numbers


def _numbers(entry: Entry, key: str) -> list[float]:
    value = entry.table[key]
    count = len(value) if isinstance(value, list) and value else 1
    return [float(it) for it in entry.numbers(key, count)]


def _limits(entry: Entry, key: str) -> list[list[float]]:
    rows = entry.table[key]
    is_list = isinstance(rows, list) and all(isinstance(it, list) and len(it) == 3 for it in rows)
    if not is_list or not all(type(it) in (int, float) for row in rows for it in row):
        entry.refuse(f"is {rows!r}, it must be a list of [axis, lower, upper], in deg", key)
    return [[float(it) for it in row] for row in rows]


def _ignores(entry: Entry, key: str) -> dict[str, Collection[str]]:
    own = entry.sub(key)
    return {pattern: _codes(own, pattern) for pattern in own.table}


KEYS: dict[str, Callable[[Entry, str], Any]] = {
    "robot": _robot,
    "tool": _frame,
    "base": _frame,
    "limits": _limits,
    "linkage-limits": lambda entry, key: [*entry.numbers(key, 2)],
    "cell": _path,
    "step": lambda entry, key: entry.number(key),
    "select": _codes,
    "ignore": _codes,
    "per-file-ignores": _ignores,
    "exclude": lambda entry, key: entry.names(key),
    "strict": lambda entry, key: entry.truth(key, False),
    "output-format": _format,
}
"""How each option is read."""
