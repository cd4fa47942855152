"""The modules of a task: those in its folder, and those that SYS.cfg loads (CAB_TASK_MODULES)."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from irbkin._words import counted
from irbkin.abb.backinfo import LoadedModule, LoadedTask
from irbkin.abb.cfg import CfgFile, Instance
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
    is_hidden: bool
    """Whether it is hidden on the controller."""
    source: str
    """File that the controller loaded it from, as backinfo.txt or SYS.cfg has it, or empty."""


def modules_in(
    folder: Folder, path: Path | None, loaded: LoadedTask | None, backinfo: str
) -> tuple[list[TaskModule], list[Finding]]:
    """Return the modules in the folder of a task, as backinfo.txt orders them, and the missing
    and those that it does not list.
    """
    listed = {it.path.lower(): it for it in loaded.modules} if loaded else {}
    order = {key: place for place, key in enumerate(listed)}
    found: list[tuple[int, int, str, TaskModule]] = []
    unlisted: list[Finding] = []
    inside = folder.entries(path) if path else {}
    for place, (name, kind) in enumerate(FOLDERS):
        parent = inside.get(name.lower())
        for file in folder.modules(parent) if parent and parent.is_dir() else ():
            key = f"{name}/{file.name}".lower()
            entry = listed.pop(key, None)
            if loaded and order and entry is None:
                message = f"{loaded.name}: backinfo.txt does not list it: was it loaded?"
                shown = folder.shown(file)
                unlisted.append(Finding(shown, 0, "module-unlisted", "note", message))
            is_hidden, source = (entry.is_hidden, entry.source) if entry else (False, "")
            module = TaskModule(file, folder.shown(file), kind, is_hidden, source)
            found.append((place, order.get(key, len(order)), key, module))
    missing = [
        _missing(loaded.name, entry, backinfo)
        for entry in listed.values()
        if loaded and entry.path.lower().endswith(ENDINGS)
    ]
    modules = [module for *_, module in sorted(found, key=lambda it: it[:3])]
    return modules, [*missing, *unlisted]


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


class Loads:
    """The modules that SYS.cfg loads, by task."""

    def __init__(self, folder: Folder, sys: CfgFile, moving: Mapping[str, bool | None]) -> None:
        self.folder, self.sys = folder, sys
        self.findings: dict[Finding, None] = {}
        self.installed: set[str] = set()
        """Modules of the controller's installation and of its options."""
        self.by_task: dict[str, list[Instance]] = {}
        for it in sys.of("CAB_TASK_MODULES"):
            if any(map(it.switch, ("AllTask", "AllTasks", "Shared"))):
                tasks = list(moving)
            elif any(map(it.switch, ("AllMotionTask", "AllMotionTasks"))):
                tasks = [name for name, moves in moving.items() if moves is not False]
            else:
                # S4C+ names a task only where it is not each one.
                tasks = [it.text("Task")] if it.text("Task") else list(moving)
            for task in tasks:
                self.by_task.setdefault(task.lower(), []).append(it)

    def report(self, of: Instance, code: str, severity: Severity, message: str) -> None:
        """Add a finding, once."""
        self.findings[Finding(self.sys.file, of.line, code, severity, message)] = None

    def of(self, task: str, known: Iterable[TaskModule]) -> list[TaskModule]:
        """Return the modules of a task that are files of HOME and not among the known ones."""
        stems = {it.path.stem.lower() for it in known}
        found = []
        for it in self.by_task.get(task.lower(), ()):
            name = it.text("File").replace("\\", "/")
            stem = name.rsplit("/", 1)[-1].rsplit(":", 1)[-1].rsplit(".", 1)[0].lower()
            # The copy that was loaded counts, not the one in HOME.
            if not name or stem in stems or it.text("ModName").lower() in stems:
                continue
            path = self.path(it, name)
            if path is not None:
                stems.add(stem)
                shown, is_hidden = self.folder.shown(path), it.switch("Hidden")
                found.append(TaskModule(path, shown, "configured", is_hidden, name))
        return found

    def path(self, of: Instance, name: str) -> Path | None:
        """Return the file of HOME that a module is loaded from, or None."""
        prefix, _, rest = name.rpartition(":")
        if prefix and prefix.upper() != "HOME":
            self.installed.add(name.upper())
            return None
        parts = [part for part in rest.split("/") if part]
        if ".." in parts:
            message = f"the module {name} leads out of HOME: not read"
            self.report(of, "module-outside", "warning", message)
            return None
        path = self.folder.find("/".join(["HOME", *parts])) if parts else None
        if path is None or not path.is_file():
            self.report(of, "module-missing", "warning", f"the backup lacks the module {name}")
            return None
        return path

    def all_findings(self) -> list[Finding]:
        """Return the findings; the modules of the installation are one of them."""
        found = list(self.findings)
        if self.installed:
            prefixes = ", ".join(sorted({it.split(":")[0] for it in self.installed}))
            count = len(self.installed)
            modules = f"{counted(count, 'module')} of the controller's installation"
            message = f"{modules} {'is' if count == 1 else 'are'} not in a backup ({prefixes})"
            found.append(Finding(self.sys.file, 0, "module-installed", "note", message))
        return found
