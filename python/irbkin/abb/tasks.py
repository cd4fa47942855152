"""Tasks of a controller: which robot each moves, and the files of its modules.

Task -> mechanical unit group -> robot and external units, by SYS.cfg; folder RAPID/TASKn -> task by
backinfo.txt, else by the order of SYS.cfg.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from irbkin.abb.backinfo import BackInfo, LoadedTask
from irbkin.abb.carriers import USES, Machine
from irbkin.abb.cfg import CfgFile, Instance
from irbkin.abb.findings import Finding
from irbkin.abb.folders import Folder
from irbkin.abb.programs import Loads, TaskModule, doubled, modules_in


@dataclass(frozen=True)
class Task:
    """A task of a controller."""

    name: str
    """Name of the task: "T_ROB1"."""
    folder: str
    """Its folder in the backup, "RAPID/TASK1"; empty where it has none."""
    kind: str
    """"NORMAL", "STATIC" or "SEMISTATIC"; empty where SYS.cfg does not say."""
    program: str
    """Name of the program that was loaded, or empty."""
    moves: bool | None
    """Whether it may move a unit; None where it is not determined."""
    group: str
    """Name of its mechanical unit group, or empty."""
    robot: str | None
    """Name of the robot that it moves, or None."""
    units: tuple[str, ...]
    """Names of the external units that it moves."""
    modules: tuple[TaskModule, ...]
    """Its modules: PROGMOD, then SYSMOD, in the order in which backinfo.txt lists them, then
    those that SYS.cfg loads from HOME.
    """


@dataclass(frozen=True)
class _Source:
    name: str
    path: Path | None
    loaded: LoadedTask | None
    configured: Instance | None


class TaskReader:
    """The tasks while they are read."""

    def __init__(
        self, folder: Folder, sys: CfgFile, moc: CfgFile, info: BackInfo, machine: Machine
    ) -> None:
        self.folder, self.sys, self.moc, self.info, self.machine = folder, sys, moc, info, machine
        self.findings: list[Finding] = []
        self.robots = {name.lower(): name for name in machine.robots}
        self.units = {name.lower(): name for name in machine.units}

    def read(self) -> tuple[Task, ...]:
        """Return all tasks: of the folders first, then those that SYS.cfg alone has."""
        sources = list(self.sources())
        moving = _moving(sources)
        loads = Loads(self.folder, self.sys, moving)
        tasks = [self.task(source, moving[source.name], loads) for source in sources]
        self.findings += loads.all_findings()
        self.report_unassigned(tasks)
        return tuple(tasks)

    def sources(self) -> Iterator[_Source]:
        """Yield each task of the folders, of backinfo.txt if there are none, and of SYS.cfg."""
        configured = self.sys.of("CAB_TASKS")
        names: set[str] = set()
        folders = self.folder.tasks()
        found: list[tuple[str, Path | None, LoadedTask | None]] = []
        for position, (number, path) in enumerate(folders):
            loaded = self.info.task(number, position)
            name = loaded.name if loaded else ""
            if not name and position < len(configured):
                name = configured[position].name
            found.append((name or path.name, path, loaded))
        if not folders:
            found = [(loaded.name, None, loaded) for loaded in self.info.tasks]
        found += [(it.name, None, None) for it in configured]
        for name, folder, loaded in found:
            if name and (folder or name.lower() not in names):
                names.add(name.lower())
                yield _Source(name, folder, loaded, self.sys.named("CAB_TASKS", name))

    def task(self, source: _Source, moves: bool | None, loads: Loads) -> Task:
        """Return a task."""
        of = source.configured
        group = of.text("UseMechanicalUnitGroup") if of else ""
        robot, units = self.moved(source, group) if moves is not False else (None, ())
        modules, missing = modules_in(self.folder, source.path, source.loaded, self.info.file)
        modules += loads.of(source.name, modules)
        self.findings += [*missing, *doubled(source.name, modules)]
        return Task(
            source.name,
            self.folder.shown(source.path) if source.path else "",
            _kind(of),
            source.loaded.program if source.loaded else "",
            moves,
            group,
            robot,
            units,
            tuple(modules),
        )

    def moved(self, source: _Source, group: str) -> tuple[str | None, tuple[str, ...]]:
        """Return the robot and the external units that a task moves."""
        robots, units = tuple(self.machine.robots), tuple(self.machine.units)
        # Of one robot, every unit is its task's.
        all_of_one = (robots[0], units) if len(robots) == 1 else (None, ())
        if not group:
            return all_of_one
        type_name = "MECHANICAL_UNIT_GROUP"
        found = self.sys.named(type_name, group) or self.moc.named(type_name, group)
        if found is None:
            if len(robots) != 1:
                line = source.configured.line if source.configured else 0
                message = f"{source.name}: its mechanical unit group {group} is in no file"
                self.findings.append(Finding(self.sys.file, line, "group", "warning", message))
            return all_of_one
        keys = sorted(key for key in found.values if key.startswith("mechanicalunit"))
        named = [it for it in (found.text("Robot"), *map(found.text, keys)) if it]
        names = [it for mechanical in named for it in self.resolved(mechanical)]
        # Axis 7 of a robot is a unit, too.
        known = {*self.robots, *(f"{it}_7" for it in self.robots), *self.units}
        for name in names:
            if self.moc.file and name.lower() not in known:
                message = f"{source.name}: {name} of its group {group} is no unit of MOC.cfg"
                self.findings.append(
                    Finding(self.sys.file, found.line, "group", "warning", message)
                )
        lower = [name.lower() for name in names]
        robot = next((self.robots[it] for it in lower if it in self.robots), None)
        return robot, tuple(dict.fromkeys(self.units[it] for it in lower if it in self.units))

    def resolved(self, name: str) -> list[str]:
        """Return the names of units that a name means: a MECHANICAL_UNIT stands for its units."""
        mechanical = self.moc.named("MECHANICAL_UNIT", name)
        if mechanical is None or name.lower() in {*self.robots, *self.units}:
            return [name]
        return [mechanical.text(key) for key in sorted(mechanical.values) if key.startswith(USES)]

    def report_unassigned(self, tasks: list[Task]) -> None:
        """Report which tasks have no robot although there are several, once."""
        without = [it.name for it in tasks if it.moves is not False and it.robot is None]
        robots = list(self.machine.robots)
        # A task that is configured with a group of units alone has no robot.
        if len(robots) < 2 or not without or any(it.robot for it in tasks):
            return
        why = "" if self.sys.file else ": SYS.cfg, which assigns them, is missing"
        message = f"which of {', '.join(robots)} the tasks {', '.join(without)} move is not "
        message += f"determined{why}"
        self.findings.append(Finding(self.sys.file, 0, "task-robot", "warning", message))


def _kind(of: Instance | None) -> str:
    return of.text("Type").upper() if of else ""


def _moving(sources: list[_Source]) -> dict[str, bool | None]:
    motion = {it.name: it.configured.switch("MotionTask") for it in sources if it.configured}
    if any(motion.values()):
        return {it.name: motion.get(it.name) for it in sources}
    # S4C+ has one task that moves, and no word for it.
    normal = [it.name for it in sources if _kind(it.configured) in ("", "NORMAL")]
    only = normal if len(normal) == 1 else []
    return {it.name: it.name in only or (None if it.name in normal else False) for it in sources}
