"""The modules in the folder of a task."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from irbkin.abb.backinfo import LoadedModule, LoadedTask
from irbkin.abb.findings import Finding, Severity
from irbkin.abb.folders import Folder
from irbkin.rapid.program import ENDINGS

ModuleKind = Literal["program", "system", "configured"]
FOLDERS: tuple[tuple[str, ModuleKind], ...] = (("PROGMOD", "program"), ("SYSMOD", "system"))


@dataclass(frozen=True)
class TaskModule:
    """The file of a module of a task."""

    path: Path
    file: str
    """Path in the backup, with `/`."""
    kind: ModuleKind
    """"program" (PROGMOD), "system" (SYSMOD), or "configured": a file of HOME that SYS.cfg loads
    and that is in neither.
    """
    is_shared: bool
    """Whether SYS.cfg loads it for all tasks (-Shared)."""
    is_hidden: bool
    """Whether it is hidden on the controller."""
    source: str
    """File that the controller loaded it from, as backinfo.txt or SYS.cfg has it, or empty."""


def modules_in(
    folder: Folder, path: Path | None, loaded: LoadedTask | None, backinfo: str
) -> tuple[list[TaskModule], list[Finding]]:
    """Return the modules in the folder of a task, as backinfo.txt orders them, and the missing."""
    listed = {it.path.lower(): it for it in loaded.modules} if loaded else {}
    order = {key: place for place, key in enumerate(listed)}
    found: list[tuple[int, int, str, TaskModule]] = []
    inside = folder.entries(path) if path else {}
    for place, (name, kind) in enumerate(FOLDERS):
        parent = inside.get(name.lower())
        for file in folder.modules(parent) if parent and parent.is_dir() else ():
            key = f"{name}/{file.name}".lower()
            entry = listed.pop(key, None)
            is_hidden, source = (entry.is_hidden, entry.source) if entry else (False, "")
            module = TaskModule(file, folder.shown(file), kind, False, is_hidden, source)
            found.append((place, order.get(key, len(order)), key, module))
    missing = [
        _missing(loaded.name, entry, backinfo)
        for entry in listed.values()
        if loaded and entry.path.lower().endswith(ENDINGS)
    ]
    return [module for *_, module in sorted(found, key=lambda it: it[:3])], missing


def _missing(task: str, entry: LoadedModule, backinfo: str) -> Finding:
    severity: Severity = "note" if entry.is_hidden else "warning"
    message = f"{task}: the backup lacks its module {entry.path}"
    return Finding(backinfo, entry.line, "module-missing", severity, message)


def doubled(task: str, modules: Iterable[TaskModule]) -> list[Finding]:
    """Report modules of one name in a task."""
    seen: dict[str, str] = {}
    found = []
    for module in modules:
        first = seen.setdefault(module.path.stem.lower(), module.file)
        if first != module.file:
            message = f"{task}: its module {module.path.stem} is in {first}, too"
            found.append(Finding(module.file, 0, "doubled-module", "warning", message))
    return found
