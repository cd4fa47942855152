"""The modules that SYS.cfg loads into tasks (CAB_TASK_MODULES)."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from irbkin._words import counted
from irbkin.abb.cfg import CfgFile, Instance
from irbkin.abb.findings import Finding, Severity
from irbkin.abb.folders import Folder
from irbkin.abb.programs import TaskModule


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
                shared, hidden = it.switch("Shared"), it.switch("Hidden")
                shown = self.folder.shown(path)
                found.append(TaskModule(path, shown, "configured", shared, hidden, name))
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
