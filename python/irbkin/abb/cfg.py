r"""The configuration files of a controller (MOC.cfg, SYS.cfg): types, their instances, keys.

A file is a header `MOC:CFG_1.0:6:0::`, then types (`ROBOT:`) with instances. An instance is one
logical line of keys, continued by `\`; a key has a number, a string or nothing (a switch). Keys and
names are compared without case. Lengths are in meters, angles in radians.

    >>> text = '''MOC:CFG_1.0:6:0::
    ... #
    ... ROBOT:
    ...
    ...       -name "ROB_1" -use_robot_type "ROB1_4600_2.55_40"\\
    ...       -base_frame_pos_y 3 -valid_cal_offset
    ... '''
    >>> robot = parse_cfg(text, "SYSPAR/MOC.cfg").of("ROBOT")[0]
    >>> robot.name, robot.number("base_frame_pos_y"), robot.switch("valid_cal_offset"), robot.line
    ('ROB_1', 3.0, True, 5)
"""

import math
import re
from dataclasses import dataclass, field
from functools import cached_property

from irbkin.abb.findings import Finding, Severity

HEADER = re.compile(r"\s*(\w+):CFG_([\d.]+)((?::[^:]*)*)\s*$")
TYPE = re.compile(r"\s*([A-Za-z_]\w*):\s*$")
CONFLICT = re.compile(r"(?:<{7}|={7}|>{7}|\|{7})(?:\s|$)")
# An unclosed quote takes in the rest of its line.
TOKEN = re.compile(
    r'\s+|-(?P<key>[A-Za-z_]\w*)|"(?P<string>[^"]*)(?P<end>"?)|(?P<word>[^\s"]+)', re.DOTALL
)
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
UNIQUE = (
    *("ARM", "CAB_TASKS", "JOINT", "MECHANICAL_UNIT", "MECHANICAL_UNIT_GROUP"),
    *("ROBOT", "SINGLE", "SINGLE_TYPE"),
)
"""Types whose instances others refer to by name."""


@dataclass(frozen=True)
class Instance:
    """One instance of a type."""

    type: str
    line: int
    """Line on which it begins, from 1."""
    values: dict[str, str]
    """Keys in lower case, and the text of their values; empty for a switch."""

    @property
    def name(self) -> str:
        """The value of the key `name`."""
        return self.text("name")

    def text(self, key: str, default: str = "") -> str:
        """Return the text of a key, or the default where the key is absent."""
        return self.values.get(key.lower(), default)

    def number(self, key: str, default: float = 0.0) -> float:
        """Return the number of a key; the default where it is absent or has no finite number."""
        text = self.values.get(key.lower(), "")
        number = float(text) if NUMBER.fullmatch(text) else math.nan
        return number if math.isfinite(number) else default

    def has(self, key: str) -> bool:
        """Return whether the key is given."""
        return key.lower() in self.values

    def switch(self, key: str) -> bool:
        """Return whether a switch is on."""
        return self.has(key) and self.text(key).lower() not in ("0", "no", "false", "off")


@dataclass(frozen=True)
class CfgFile:
    """A configuration file."""

    file: str
    domain: str = ""
    """"MOC", "SYS"; empty without a header."""
    version: str = ""
    """Version and revision of the header, as "6:0"; empty where it has none."""
    types: dict[str, tuple[Instance, ...]] = field(default_factory=dict)
    """Instances by the name of their type in upper case, in the order of the file."""
    findings: tuple[Finding, ...] = ()
    """Lines that were not understood, and names that are given twice."""

    def of(self, type_name: str) -> tuple[Instance, ...]:
        """Return the instances of a type."""
        return self.types.get(type_name.upper(), ())

    def named(self, type_name: str, name: str) -> Instance | None:
        """Return the first instance of a type with this name, compared without case."""
        return self._names.get((type_name.upper(), name.lower()))

    @cached_property
    def _names(self) -> dict[tuple[str, str], Instance]:
        names: dict[tuple[str, str], Instance] = {}
        for type_name, instances in self.types.items():
            for it in instances:
                names.setdefault((type_name, it.name.lower()), it)
        return names


class _Reader:
    def __init__(self, file: str) -> None:
        self.file = file
        self.domain = self.version = self.type = ""
        self.types: dict[str, list[Instance]] = {}
        self.findings: list[Finding] = []
        self.instance: Instance | None = None
        self.first_key = ""
        self.key: str | None = None
        """The key whose value is next."""
        self.is_continued = False

    def report(self, line: int, code: str, severity: Severity, message: str) -> None:
        self.findings.append(Finding(self.file, line, code, severity, message))

    def read(self, number: int, line: str) -> None:
        stripped = line.strip()
        if CONFLICT.match(stripped):
            message = "a marker of a merge conflict: both sides are read"
            self.report(number, "conflict-marker", "warning", message)
        elif stripped.startswith("#") or not stripped:
            self.end(number)
        elif (header := HEADER.match(stripped)) is not None:
            self.end(number)
            self.domain = self.domain or header[1].upper()
            self.version = self.version or header[3].strip(":")
        elif (type_name := TYPE.match(stripped)) is not None:
            self.end(number)
            self.type = type_name[1].upper()
            self.types.setdefault(self.type, [])
        else:
            self.read_values(number, stripped)

    def end(self, number: int) -> None:
        if self.is_continued and self.instance is not None:
            message = f"{self.label()}: `\\` announces another line, and none follows"
            self.report(number, "cfg-line", "warning", message)
        self.instance, self.key, self.is_continued = None, None, False

    def label(self) -> str:
        assert self.instance is not None
        return f"{self.instance.type} {self.instance.name}".rstrip()

    def read_values(self, number: int, line: str) -> None:
        is_continued = line.endswith("\\")
        line = line.rstrip("\\") if is_continued else line
        first = TOKEN.match(line)
        key = first["key"].lower() if first and first["key"] else None
        if self.instance is None and key is None:
            self.report(number, "cfg-line", "warning", f"is not read: {_short(line)}")
            return
        if self.instance is not None and not self.is_continued:
            # Without a blank line between: the next instance begins with the key of this one.
            if key in (None, self.first_key):
                self.end(number)
                return self.read_values(number, line + ("\\" if is_continued else ""))
            message = f"{self.label()}: goes on without `\\` in the line before"
            self.report(number, "cfg-line", "warning", message)
        if self.instance is None:
            self.begin(number, key or "")
        for token in TOKEN.finditer(line):
            self.take(number, token)
        self.is_continued = is_continued

    def begin(self, number: int, key: str) -> None:
        if not self.type:
            self.report(number, "cfg-line", "warning", "an instance before the first type")
        self.instance = Instance(self.type, number, {})
        self.types.setdefault(self.type, []).append(self.instance)
        self.first_key = key

    def take(self, number: int, token: re.Match[str]) -> None:
        assert self.instance is not None
        values = self.instance.values
        if token["key"]:
            self.key = token["key"].lower()
            if self.key in values:
                message = f"{self.label()}: -{self.key} is given twice, the last one counts"
                self.report(number, "cfg-line", "warning", message)
            values[self.key] = ""
            return
        value = token["string"] if token["string"] is not None else token["word"]
        if value is None:
            return
        if self.key is None:
            message = f"{self.label()}: {_short(value)} has no key"
            self.report(number, "cfg-line", "warning", message)
            return
        values[self.key] = value
        self.key = None
        if token["end"] == "":
            message = f"{self.label()}: the string {_short(value)} has no closing quote"
            self.report(number, "cfg-line", "warning", message)


def lines_of(text: str) -> list[str]:
    """Split a text at its line ends, LF, CRLF or CR alone: as an editor counts lines."""
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def parse_cfg(text: str, file: str = "") -> CfgFile:
    """Parse a configuration file in linear time. A broken line is a finding; the rest is read."""
    reader = _Reader(file)
    lines = lines_of(text) if "\0" not in text else []
    if "\0" in text:
        reader.report(0, "not-text", "error", "is not text, or is encoded: not read")
    for number, line in enumerate(lines, 1):
        reader.read(number, line)
    reader.end(len(lines))
    if text.strip() and not reader.domain and not reader.findings:
        reader.report(1, "cfg-header", "warning", "has no header such as MOC:CFG_1.0:6:0::")
    types = {name: tuple(them) for name, them in reader.types.items()}
    findings = [*reader.findings, *_duplicates(types, file)]
    return CfgFile(file, reader.domain, reader.version, types, tuple(findings))


def _duplicates(types: dict[str, tuple[Instance, ...]], file: str) -> list[Finding]:
    found = []
    for name in UNIQUE:
        seen: dict[str, int] = {}
        for it in types.get(name, ()):
            first = seen.setdefault(it.name.lower(), it.line)
            if it.name and first != it.line:
                message = f"{name} {it.name} is in line {first}, too: the first one counts"
                found.append(Finding(file, it.line, "doubled-name", "warning", message))
    return found


def _short(text: str) -> str:
    return repr(text if len(text) <= 40 else text[:37] + "...")
