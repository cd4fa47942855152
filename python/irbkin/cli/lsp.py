"""`irbkin lsp`: a language server, with the programs and arms of files."""

from __future__ import annotations

import argparse
import copy
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from irbkin.cli.arguments import Parser
from irbkin.cli.check import add_arm, add_step, checker_of, ignored_of, robot_of
from irbkin.cli.codes import codes, rules
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.jobs import Job, found_in, title_of, unit_of
from irbkin.cli.settings import Settings, options_of, settings_of
from irbkin.errors import IrbkinError

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.abb import Backup
    from irbkin.abb import Task as BackupTask
    from irbkin.abb.external import UnitRow
    from irbkin.cli.checker import Checker
    from irbkin.cli.findings import Found
    from irbkin.rapid import Checked, Program

HELP = """A language server over stdin and stdout, which editors start (docs/guide/lsp.md). A file
is checked as one types, with all modules of its program: of its task in a backup, which gives the
arm, or of the folder of irbkin.toml or pyproject.toml, or else of its own folder. Options that are
not given here, nor by the editor, are taken from these files. This verb needs pygls:
pip install 'irbkin[lsp]'."""
EXAMPLES = """  irbkin lsp
  irbkin lsp --robot "IRB 2600-12/1.65\""""
NO_ARM = (
    'no arm is known for {}, only its text is checked: write robot = "IRB ..." into [check] of '
    "irbkin.toml, set irbkin.robot in the editor, or open the file in a backup"
)
MOST_FILES = 5_000
"""Modules of a program."""
RULES = Path(__file__).with_name("rules.md")


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add_arm(parser)
    add_step(parser)
    parser.add("--stdio", action="store_true", help="the default, for editors that give it")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    from irbkin.lsp import serve

    serve(Desk(arguments))
    return FINE


@dataclass
class Task:
    """A program, and the arm that it moves."""

    title: str
    paths: Sequence[str]
    checker: Checker
    robot: Robot | None = None
    notes: Sequence[str] = ()
    units: Sequence[UnitRow] = field(default=(), repr=False)

    def check(self, program: Program) -> tuple[Checked | None, Sequence[Found]]:
        """Return what is wrong with the program; without an arm, with its text."""
        ignored, codes = self.checker.ignored, self.checker.codes
        found = [
            it
            for it in found_in(program)
            if it.code in codes and it.code not in ignored.get(it.file, ())
        ]
        if self.robot is None:
            return None, found
        job = Job(self.robot, program, self.title, self.units)
        checked = self.checker.checked(job)
        return checked, [*found, *self.checker.found(job, checked)]


class Desk:
    """Gives files their tasks, by the arguments of the command."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self._arguments = arguments
        self._backups: dict[Path, Backup] = {}

    def tasks(self, path: str, options: Mapping[str, Any]) -> Sequence[Task]:
        """Return the tasks of a file; of one that is excluded none."""
        arguments = copy.copy(self._arguments)
        try:
            for name, value in options_of(options, os.getcwd()).items():
                setattr(arguments, name, value)
            settings = settings_of([path])
            settings.fill(arguments)
            if settings.matches(path, settings.options.get("exclude", ())):
                return []
            return self._tasks(path, arguments, settings)
        except (CommandError, IrbkinError, OSError) as error:
            checker = checker_of(copy.copy(self._arguments))
            return [Task(path, [path], checker, notes=[str(error)])]

    def _tasks(self, path: str, arguments: argparse.Namespace, settings: Settings) -> list[Task]:
        checker = checker_of(arguments)
        root = self._root(path) if arguments.robot is None else None
        if root is not None:
            tasks = self._tasks_in(self._backup(root), path, checker)
        else:
            paths, notes = _paths(path, settings)
            robot = None if arguments.robot is None else robot_of(arguments)
            if robot is None:
                notes = [*notes, NO_ARM.format(os.path.basename(path))]
            title = robot.name if robot else os.path.dirname(path)
            tasks = [Task(title, paths, checker, robot, notes)]
        checker.ignored = ignored_of({it for task in tasks for it in task.paths}, settings)
        return tasks

    def _root(self, path: str) -> Path | None:
        """The backup that a file is in."""
        from irbkin.abb.roots import backup_above

        return backup_above(Path(path)) if os.path.isabs(path) else None

    def _backup(self, root: Path) -> Backup:
        from irbkin.abb import load_backup

        if root not in self._backups:
            self._backups[root] = load_backup(root)
        return self._backups[root]

    def _tasks_in(self, backup: Backup, path: str, checker: Checker) -> list[Task]:
        """The tasks of a backup that have a file."""
        found = []
        for task in backup.tasks:
            paths = _with([os.path.join(backup.path, it.path) for it in task.modules], path)
            if path in paths:
                found.append(_task_of(backup, task, paths, checker))
        note = f"{path} is in no task of its backup, only its text is checked"
        return found or [Task(path, [path], checker, notes=[note])]

    def forget(self) -> None:
        """Read options and backups again."""
        self._backups.clear()

    def rule(self, code: str) -> tuple[str, str]:
        """Return the address and the words of the rule of a code."""
        rule = rules().get(code)
        if rule is None:
            return RULES.as_uri(), codes()[code].name
        words = " ".join(f"{rule.meaning}\n\nCure: {rule.cure}".split())
        return f"{RULES.as_uri()}#{code.lower()}-{rule.name}", f"{rule.name}: {words}"


def _task_of(backup: Backup, task: BackupTask, paths: Sequence[str], checker: Checker) -> Task:
    """A task of a backup with its arm, or the reason why that is not known."""
    from irbkin.abb.external import unit_rows

    unit = unit_of(backup, task)
    if unit is not None:
        rows = unit_rows(backup, unit.name)
        return Task(title_of(task, unit), paths, checker, unit.robot, units=rows)
    notes = []
    if task.moves is not False:
        of = backup.robots.get(task.robot or "")
        why = f"its arm {of.type} is not checked" if of else "which robot it moves is not known"
        notes = [f"{task.name}: {why}, only its text is"]
    return Task(task.name, paths, checker, notes=notes)


def _with(paths: Sequence[str], path: str) -> list[str]:
    """Paths, one of them as an editor writes it: a drive or a name perhaps in another case."""
    own = os.path.normcase(path)
    return [path if os.path.normcase(it) == own else it for it in paths]


def _paths(path: str, settings: Settings) -> tuple[list[str], list[str]]:
    """The files of the program of a file that is in no backup, and what is wrong with them."""
    from irbkin.rapid.program import ENDINGS, FOLDERS, modules_in

    folder, name = os.path.split(path)
    if not os.path.isabs(path) or not path.lower().endswith(ENDINGS):
        return [path], []
    if os.path.basename(folder).upper() in FOLDERS:
        paths = modules_in(os.path.dirname(folder))
    elif settings.file:
        paths = modules_in(os.path.dirname(settings.file))
    else:
        names = sorted(it for it in os.listdir(folder) if it.lower().endswith(ENDINGS))
        paths = [os.path.join(folder, it) for it in names]
    excluded = settings.options.get("exclude", ())
    paths = [it for it in paths if not (excluded and settings.matches(it, excluded))]
    paths = _with(paths, path)
    if path not in paths:
        paths.append(path)
    if len(paths) <= MOST_FILES:
        return paths, []
    note = f"{os.path.dirname(path)}: has {len(paths)} modules, more than {MOST_FILES}: {name} is "
    return [path], [f"{note}checked without the others"]
