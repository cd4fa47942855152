"""Programs to check, each with its robot: of files, or of the tasks of a backup."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from irbkin.cli.codes import BACKUP, codes
from irbkin.cli.errors import CommandError
from irbkin.cli.files import STDIN, opened, shown
from irbkin.cli.findings import Found

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.abb import Backup, RobotUnit, Task
    from irbkin.abb.external import UnitRow
    from irbkin.cli.settings import Settings
    from irbkin.rapid import FileFinding, ModuleFile, Program

SHOWN_STDIN = "<stdin>"
"""How findings name stdin."""


@dataclass
class Job:
    """A program with the robot that it moves."""

    robot: Robot
    program: Program
    title: str
    """The task and the arm."""
    units: Sequence[UnitRow] = ()
    """The units that external axes belong to, as `rapid.check_program` takes them."""
    found: Sequence[Found] = ()
    """Findings on its files."""

    @property
    def unread(self) -> int:
        """Number of files that were not read."""
        return sum(it.code == "E002" for it in self.found)


def job_of_files(robot: Robot, names: Sequence[str], settings: Settings) -> Job:
    """Return the job of files and folders, those that are excluded left out."""
    from irbkin.rapid.program import ENDINGS, ModuleFile, files_of, program_of

    files: list[ModuleFile] = []
    findings: list[FileFinding] = []
    for name in names:
        if name == STDIN:
            with opened(name) as stream:
                files.append(ModuleFile(SHOWN_STDIN, stream.read()))
            continue
        wrong: list[FileFinding] = []
        own = files_of(name, wrong)
        if not own and not wrong:
            raise CommandError(f"{name}: has no RAPID modules ({', '.join(ENDINGS)})")
        files += own
        findings += wrong
    excluded = settings.options.get("exclude", ())
    kept = [it for it in files if not (excluded and settings.matches(it.path, excluded))]
    program = program_of(kept, findings)
    return Job(robot, program, robot.name, found=found_in(program))


def jobs_of_backup(path: str) -> tuple[list[Job], list[Found]]:
    """Return a job for each task of a backup that moves a robot, and what the files leave open."""
    from irbkin.abb import load_backup
    from irbkin.abb.external import unit_rows

    backup = load_backup(path)
    jobs = []
    for task in backup.tasks:
        unit = unit_of(backup, task)
        if unit is None or unit.robot is None or not task.modules:
            continue
        program = backup.programs[task.name]
        rows = unit_rows(backup, unit.name)
        title = title_of(task, unit)
        jobs.append(Job(unit.robot, program, title, rows, found_in(program)))
    left_open = []
    for it in backup.findings:
        file = shown(str(backup.origin / it.file))
        left_open.append(Found(file, it.line, 1, BACKUP, it.code, it.severity, it.message))
    return jobs, left_open


def unit_of(backup: Backup, task: Task) -> RobotUnit | None:
    """Return the robot that a task moves, if its moves can be checked."""
    unit = backup.robots.get(task.robot or "")
    if task.moves is False or unit is None or unit.robot is None:
        return None
    return unit


def title_of(task: Task, unit: RobotUnit) -> str:
    """Return how reports name a task and its arm."""
    return f"{task.name}: {unit.name}, {unit.arm}"


def is_backup(name: str) -> bool:
    """Whether a path is a backup, or leads into one in an archive."""
    from pathlib import Path

    from irbkin.abb.archives import archive_of
    from irbkin.abb.roots import PARTS

    if name == STDIN:
        return False
    if archive_of(Path(name)) is not None:
        return True
    if not os.path.isdir(name):
        return False
    inside = {it.upper() for it in os.listdir(name)}
    return "SYSPAR" in inside or "BACKINFO" in inside or len(inside & {*PARTS, "HOME"}) > 1


def found_in(program: Program) -> list[Found]:
    """Return what is wrong with the files of a program."""
    return [
        Found(
            shown(it.file), it.line, it.column, it.code, codes()[it.code].name, it.severity,
            it.message,
        )
        for it in program.findings
    ]  # fmt: skip
