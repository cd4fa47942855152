"""Options of a check from `irbkin.toml`, `pyproject.toml` or an editor."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from irbkin import catalog
from irbkin._arm_options import is_arm_file
from irbkin._files import ways
from irbkin.check.codes import codes, meant
from irbkin.errors import InvalidModelError, IrbkinError

if TYPE_CHECKING:
    from irbkin._cell.entries import Entry

TABLES = {"irbkin.toml": ("check",), "pyproject.toml": ("tool", "irbkin", "check")}
"""Files with options, and the keys of their table; within a folder the first one is read."""
FORMATS = ("text", "concise", "json", "github", "sarif", "junit", "html")
"""Formats of reports."""
SCHEMA = Path(__file__).with_name("irbkin.schema.json")
"""The JSON schema of the first of them, which this module completes by what it knows."""


class Settings(NamedTuple):
    file: str = ""
    options: Mapping[str, Any] = {}

    def excludes(self, path: str) -> bool:
        return self._matches(path, self.options.get("exclude", ()))

    def ignored(self, path: str) -> set[str]:
        ignores = self.options.get("per_file_ignores", {}).items()
        return {code for pattern, own in ignores if self._matches(path, [pattern]) for code in own}

    def _matches(self, name: str, patterns: Iterable[str]) -> bool:
        if not patterns:
            return False
        from fnmatch import fnmatch

        path = os.path.relpath(ways(name)[0], os.path.dirname(self.file)).replace(os.sep, "/")
        parts = path.split("/")
        prefixes = {"/".join(parts[:count]) for count in range(1, len(parts) + 1)} | {*parts}
        return any(fnmatch(way, pattern.rstrip("/")) for pattern in patterns for way in prefixes)


def settings_of(names: Sequence[str]) -> Settings:
    found = (_read(file, TABLES[os.path.basename(file)]) for file in option_files(names))
    return next(filter(None, found), Settings())


def option_files(names: Sequence[str]) -> Iterator[str]:
    """Yield the files that may have the options of some files, the nearest first."""
    paths = [ways(name)[0] for name in names]
    folder = os.path.commonpath(paths) if paths else os.getcwd()
    for above in (it for way in ways(folder) for it in (way, *way.parents)):
        yield from (str(above / name) for name in TABLES)


def _read(file: str, keys: Sequence[str]) -> Settings | None:
    """The options in the table of a file; None if it has no such table."""
    if not os.path.isfile(file):
        return None
    from irbkin._cell.entries import MOST_CHARACTERS, Entry, parsed

    with open(file, "rb") as stream:
        content = stream.read(4 * MOST_CHARACTERS + 1)
    # The file belongs to other tools, too: it is not parsed without this word.
    if len(keys) > 1 and b"irbkin" not in content:
        return None
    try:
        text = content.decode("utf-8-sig")
        entry = Entry(text, os.path.dirname(file), (), parsed(text))
        for key in keys:
            if key == "check":
                entry.check(key)
            if key not in entry.table:
                return None
            entry = entry.sub(key)
        return Settings(file, _options(entry))
    except UnicodeDecodeError as error:
        raise IrbkinError(f"{file}: is not UTF-8: {error}") from None
    except InvalidModelError as error:
        raise IrbkinError(f"{file}: {error}") from None


def options_of(table: Mapping[str, Any], folder: str) -> dict[str, Any]:
    """Read options from a table, with paths relative to a folder."""
    from irbkin._cell.entries import Entry

    return _options(Entry("", folder, (), table))


def _options(entry: Entry) -> dict[str, Any]:
    entry.check(*KEYS)
    return {key.replace("-", "_"): KEYS[key](entry, key) for key in entry.table}


def _robot(entry: Entry, key: str) -> str:
    name = entry.name(key)
    return _path(entry, key) if is_arm_file(name) else name


def _path(entry: Entry, key: str) -> str:
    return os.path.join(entry.folder, entry.name(key))


def _codes(entry: Entry, key: str) -> set[str]:
    words = entry.names(key)
    try:
        return meant(words)
    except IrbkinError as error:
        entry.refuse(str(error), key)


def _format(entry: Entry, key: str) -> str:
    form = entry.name(key)
    if form not in FORMATS:
        entry.refuse(f"is {form!r}, it must be one of {', '.join(FORMATS)}", key)
    return form


def _frame(entry: Entry, key: str) -> list[float]:
    value = entry.table[key]
    count = len(value) if isinstance(value, list) and value else 1
    numbers = [float(number) for number in entry.numbers(key, count)]
    if count not in (3, 6, 7):
        entry.refuse(f"has {count} numbers, it must have 3, 6 or 7 as --{key}", key)
    return numbers


def _limits(entry: Entry, key: str) -> list[list[float]]:
    rows = entry.table[key]
    is_list = isinstance(rows, list) and all(isinstance(row, list) for row in rows)
    if not is_list or any([type(own) in (int, float) for own in row] != [True] * 3 for row in rows):
        entry.refuse(f"is {rows!r}, it must be a list of [axis, lower, upper], in deg", key)
    return [[float(number) for number in row] for row in rows]


def _ignores(entry: Entry, key: str) -> dict[str, set[str]]:
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
"""The reader of each option."""


def schema() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(SCHEMA.read_text(encoding="utf-8"))
    keys = found["properties"]["check"]["properties"]
    keys["robot"]["anyOf"][0]["enum"] = [*catalog()]
    keys["output-format"]["enum"] = [*FORMATS]
    words = ["ALL", *(word for code in codes().values() for word in (code.id, code.name))]
    for own in (keys["select"], keys["ignore"], keys["per-file-ignores"]["additionalProperties"]):
        own["items"]["anyOf"][0]["enum"] = words
    return found
