"""BACKINFO/backinfo.txt: versions, arms, and the modules that were loaded into each task."""

import re
from dataclasses import dataclass

from irbkin.abb.cfg import CONFLICT, lines_of
from irbkin.abb.findings import Finding

SECTION = re.compile(r">>\s*([A-Za-z_]+)(\d*)\s*:?\s*(?:\((.*)\))?")
MODULE = re.compile(r"(?:[^@\s][^@]*[\\/])?[^@\\/]+\.\w+\s*(?:@.*)?")
VERSION = re.compile(
    r"(?:RobotWare|RobotControl|BaseWare|System Pack)\D*(\d+(?:\.\d+)+)", re.IGNORECASE
)
NUMBERS = re.compile(r"\d+(?:\.\d+)+")
MOST_OF_A_LINE = 1000
"""Characters of a line that is looked at: longer ones are no path and no product."""
# "IRB 4600-40/2.55 Type C", "2600ID-8/2.00", "6600/2.55-175"
ARM = re.compile(
    r"(?:(?:ABB\s+)?(?:IRB|CRB)[\s_-]*)?\d{2,5}[A-Z]{0,3}[-/_ ]+\d+(?:\.\d+)?"
    r"\s*[-/_]\s*\d+(?:\.\d+)?(?:[\s_(,-].*)?",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class LoadedModule:
    """A module that was loaded when the backup was made."""

    path: str
    """Path in the folder of the task, with `/`: "PROGMOD/Main.mod"."""
    source: str
    """File that it was loaded from, as "home:/system/posrec.sys"; often only its name or empty."""
    is_hidden: bool
    line: int


@dataclass(frozen=True)
class LoadedTask:
    """A task as backinfo.txt lists it."""

    number: int | None
    """Number of its folder RAPID/TASKn."""
    name: str
    program: str
    """Name of the program that is loaded, or empty."""
    modules: tuple[LoadedModule, ...]
    line: int


@dataclass(frozen=True)
class BackInfo:
    """The content of backinfo.txt."""

    file: str = ""
    """Path in the backup; empty where there is no such file."""
    system: str = ""
    robotware: str = ""
    """Version of RobotWare, as "6.08.01.00"; empty where it is not found."""
    arms: tuple[str, ...] = ()
    """Arms by their wording, of ROBOT_TYPE or PRODUCTS_ID: "IRB 4600-40/2.55 Type C"."""
    tasks: tuple[LoadedTask, ...] = ()
    findings: tuple[Finding, ...] = ()

    def task(self, number: int, position: int) -> LoadedTask | None:
        """Return the task of folder TASKn: by its number, else by its position in the list."""
        of_number = next((it for it in self.tasks if it.number == number), None)
        if of_number or any(it.number is not None for it in self.tasks):
            return of_number
        return self.tasks[position] if position < len(self.tasks) else None


def parse_backinfo(text: str, file: str = "") -> BackInfo:
    """Parse backinfo.txt in linear time."""
    if "\0" in text:
        finding = Finding(file, 0, "not-text", "error", "is not text: not read")
        return BackInfo(file, findings=(finding,))
    findings: list[Finding] = []
    sections: dict[str, list[str]] = {}
    tasks: list[tuple[int | None, str, int, list[LoadedModule]]] = []
    section = ""
    for number, line in enumerate(lines_of(text), 1):
        stripped = line.strip()
        if CONFLICT.match(stripped):
            message = "a marker of a merge conflict: both sides are read"
            findings.append(Finding(file, number, "conflict-marker", "warning", message))
        elif (header := SECTION.match(stripped)) is not None:
            section = header[1].upper()
            if section == "TASK":
                of_folder = int(header[2]) if header[2] and len(header[2]) < 9 else None
                tasks.append((of_folder, header[3] or "", number, []))
        elif section == "TASK" and stripped:
            if len(stripped) < MOST_OF_A_LINE and MODULE.fullmatch(stripped):
                tasks[-1][3].append(_module(stripped, number))
            else:
                message = f"is not read: {stripped[:60]!r}"
                findings.append(Finding(file, number, "backinfo-line", "warning", message))
        elif stripped and len(stripped) < MOST_OF_A_LINE:
            sections.setdefault(section, []).append(stripped)
    products = sections.get("PRODUCTS_ID", [])
    return BackInfo(
        file,
        (sections.get("SYSTEM_ID") or [""])[0],
        _version(products),
        _arms(sections.get("ROBOT_TYPE", []), products),
        tuple(_task(*task) for task in tasks),
        tuple(findings),
    )


def _task(folder: int | None, text: str, line: int, modules: list[LoadedModule]) -> LoadedTask:
    name, _, rest = text.partition(",")
    return LoadedTask(folder, name.strip(), rest.split(",")[0].strip(), tuple(modules), line)


def _module(text: str, line: int) -> LoadedModule:
    path, _, source = text.partition("@")
    source = source.strip()
    is_hidden = source.upper() == "HIDDEN"
    path, source = (it.strip().replace("\\", "/") for it in (path, source))
    return LoadedModule(path, "" if is_hidden else source, is_hidden, line)


def _version(products: list[str]) -> str:
    """Return the version of RobotWare by its name, else the first line if it is a figure alone."""
    named = (found[1] for line in products if (found := VERSION.search(line[:200])))
    figures = (found[0] for line in products[:1] if (found := NUMBERS.fullmatch(line[:200])))
    return next(named, next(figures, ""))


def _arms(types: list[str], products: list[str]) -> tuple[str, ...]:
    """Return the lines that word an arm: of ROBOT_TYPE, or among the options of PRODUCTS_ID."""
    of_types, of_products = (
        tuple(line for line in lines if len(line) < 80 and ARM.fullmatch(line))
        for lines in (types, products)
    )
    return of_types or of_products
