"""The program and the arm of a file: from its backup, its folder or its options."""

import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from irbkin._arm_options import robot_of
from irbkin.abb import Backup, Task, load_backup
from irbkin.abb.folders import backup_above
from irbkin.check.checker import Checker
from irbkin.check.jobs import Job, job_of_task
from irbkin.check.settings import Settings, options_of, settings_of
from irbkin.errors import IrbkinError
from irbkin.lsp.session import Session
from irbkin.rapid import Program
from irbkin.rapid.program import ENDINGS, FOLDERS, modules_in

NO_ARM = (
    'no arm is known for {}, only its text is checked: write robot = "IRB ..." into [check] of '
    "irbkin.toml, set irbkin.robot in the editor, or open the file in a backup"
)
UNREAD = Program((), ())
"""A placeholder: the modules are read for each check."""
MOST_FILES = 5_000


class Programs:
    """Finds the sessions of files, with the options of the command."""

    def __init__(self, options: Mapping[str, Any]) -> None:
        self._options, self.folder = options, os.getcwd()
        """`folder`: relative paths in the options of the editor refer to it."""
        self._backups: dict[Path, Backup] = {}

    def sessions(self, path: str, options: Mapping[str, Any]) -> Sequence[Session]:
        """Return the sessions of a file with the options of the editor; none if it is excluded."""
        try:
            own = options_of(options, self.folder)
            settings = settings_of([path])
            if settings.excludes(path):
                return []
            return self._sessions(path, {**settings.options, **self._options, **own}, settings)
        except (IrbkinError, OSError) as error:
            checker = Checker(self._options, Settings())
            return [Session(Job(None, UNREAD, path), [path], checker, [str(error)])]

    def _sessions(
        self, path: str, options: Mapping[str, Any], settings: Settings
    ) -> Sequence[Session]:
        checker = Checker(options, settings)
        if "robot" in options:
            arm = {**options, "tool": None}
            robot = robot_of(arm, lambda words: print(f"irbkin: {words}", file=sys.stderr))
            paths, notes = _paths(path, settings)
            return [Session(Job(robot, UNREAD, robot.name), paths, checker, notes)]
        root = backup_above(Path(path)) if os.path.isabs(path) else None
        if root is not None:
            return self._in_backup(root, path, checker)
        paths, notes = _paths(path, settings)
        notes.append(NO_ARM.format(os.path.basename(path)))
        return [Session(Job(None, UNREAD, os.path.dirname(path)), paths, checker, notes)]

    def _in_backup(self, root: Path, path: str, checker: Checker) -> Sequence[Session]:
        """The sessions of the tasks of a backup that contain a file."""
        if root not in self._backups:
            self._backups[root] = load_backup(root)
        backup = self._backups[root]
        found = []
        for task in backup.tasks:
            paths = _with([os.path.join(backup.path, module.path) for module in task.modules], path)
            if path in paths:
                job = job_of_task(backup, task, UNREAD)
                notes = [_no_arm(backup, task)] if not job.robot and task.moves is not False else []
                found.append(Session(job, paths, checker, notes))
        note = f"{path} is in no task of its backup, only its text is checked"
        return found or [Session(Job(None, UNREAD, path), [path], checker, [note])]

    def files_of_tasks(self, path: str) -> list[str]:
        backup = self._backups.get(backup_above(Path(path)) or Path())
        return [str(it.modules[0].path) for it in backup.tasks if it.modules] if backup else []

    def task_names(self) -> set[str]:
        tasks = (task for backup in [*self._backups.values()] for task in backup.tasks)
        return {"t_rob1", *(task.name.lower() for task in tasks)}

    def forget(self) -> None:
        """Read backups again."""
        self._backups.clear()


def _no_arm(backup: Backup, task: Task) -> str:
    unit = backup.robots.get(task.robot or "")
    why = f"its arm {unit.type} is not checked" if unit else "which robot it moves is not known"
    return f"{task.name}: {why}, only its text is"


def _paths(path: str, settings: Settings) -> tuple[list[str], list[str]]:
    folder, name = os.path.split(path)
    if not os.path.isabs(path) or not path.lower().endswith(ENDINGS):
        return [path], []
    if os.path.basename(folder).upper() in FOLDERS:
        paths = modules_in(os.path.dirname(folder))
    elif settings.file:
        paths = modules_in(os.path.dirname(settings.file))
    else:
        names = sorted(inner for inner in os.listdir(folder) if inner.lower().endswith(ENDINGS))
        paths = [os.path.join(folder, inner) for inner in names]
    paths = _with([file for file in paths if not settings.excludes(file)], path)
    if path not in paths:
        paths.append(path)
    if len(paths) <= MOST_FILES:
        return paths, []
    note = f"{os.path.dirname(path)}: has {len(paths)} modules, more than {MOST_FILES}: {name} is "
    return [path], [f"{note}checked without the others"]


def _with(paths: Sequence[str], path: str) -> list[str]:
    """Paths with one in the editor's spelling: its letter case may differ, and links lead to it."""
    places = [os.path.normcase(os.path.realpath(it)) for it in (path, *paths)]
    return [path if place == places[0] else it for it, place in zip(paths, places[1:], strict=True)]
