"""Programs to check, each with its arm: of files, or of the tasks of a backup."""

import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from irbkin import Robot
from irbkin.abb import Backup, Task, load_backup
from irbkin.abb.backup import UnitRow, unit_rows
from irbkin.abb.folders import PARTS, archive_of, backups_of
from irbkin.check.findings import Finding, of_backup
from irbkin.check.settings import Settings
from irbkin.errors import IrbkinError
from irbkin.rapid import FileFinding, Module, ModuleFile, Program
from irbkin.rapid.program import ENDINGS, LIST, files_of, program_of


@dataclass(frozen=True)
class Job:
    """A program, and the arm that it moves."""

    robot: Robot | None
    """None if unknown: only the text is checked."""
    program: Program
    title: str
    units: Sequence[UnitRow] = ()
    """The units that external axes belong to, as `rapid.check_program` takes them."""
    is_whole: bool | None = None
    """Whether every module of the task is there; None if that is not known."""
    is_saved: bool = False
    """Whether each PERS has the value that it was saved with: in a backup."""
    given: Collection[str] | None = None
    """Files of the program that alone are corrected; all if None."""
    signals: Mapping[str, str] = field(default_factory=dict)
    """Signals of the controller, as `Backup.signals`; empty if they are not known."""
    tasks: Sequence[tuple[str, Sequence[Module]]] = ()
    """Tasks of the controller, as `rapid.check_program` takes them; empty if not known."""

    def is_given(self, file: str) -> bool:
        return self.given is None or file in self.given


def job_of_files(robot: Robot, given: Sequence[str | ModuleFile], settings: Settings) -> Job:
    files: list[ModuleFile] = []
    wrong: list[FileFinding] = []
    for name in given:
        before = len(wrong)
        own = [*files_of(name, wrong)] if isinstance(name, str) else [name]
        if not own and len(wrong) == before:
            raise IrbkinError(f"{name}: has no RAPID modules ({', '.join(ENDINGS)})")
        files += [file for file in own if not settings.excludes(file.path)]
    # A program's list has all of its modules.
    is_list = all(isinstance(name, str) and name.lower().endswith(LIST) for name in given)
    return Job(robot, program_of(files, wrong), robot.name, is_whole=is_list or None)


def only_job(robot: Robot, names: Sequence[str], settings: Settings) -> Job:
    """The job of files, of this arm, or of the one task of a backup that moves, of its own."""
    backup = backup_of(names)
    if backup is None:
        return job_of_files(robot, names, settings)
    every, _ = jobs_of_backup(backup, names)
    jobs = [job for job in every if any(module.moves for module in job.program.modules)] or every
    if len(jobs) > 1:
        titles = "; ".join(job.title for job in jobs)
        raise IrbkinError(f"{backup}: {len(jobs)} robots, give the files of one: {titles}")
    return jobs[0]


def job_of_task(backup: Backup, task: Task, program: Program) -> Job:
    unit = backup.robots.get(task.robot or "")
    if task.moves is False or unit is None or unit.robot is None:
        return Job(None, program, task.name, signals=backup.signals)
    title = f"{task.name}: {unit.name}, {unit.arm}"
    open_codes = {"module-missing", "module-unlisted"}
    is_whole = open_codes.isdisjoint(found.code for found in backup.findings)
    units, signals = unit_rows(backup, unit.name), backup.signals
    return Job(unit.robot, program, title, units, is_whole, is_saved=True, signals=signals)


def jobs_of_backup(path: str, names: Sequence[str] = ()) -> tuple[list[Job], list[Finding]]:
    """A job for each task of a backup with a known arm, and the findings on its files. Tasks with
    no file in `names` are left out, and of the others no other file is corrected.
    """
    backup = load_backup(path)
    programs = [(task, backup.programs[task.name]) for task in backup.tasks if task.modules]
    given = _given(backup, names)
    every = []
    for task, program in programs:
        job = job_of_task(backup, task, program)
        every.append(replace(job, given=given, tasks=_tasks(backup, task, job)))
    asked = [job for job in every if any(job.is_given(it.path) for it in job.program.files)]
    if given is not None and not asked:
        raise IrbkinError(f"{names[0]}: is in no task of {path}: give --robot, or the backup")
    jobs = [job for job in asked if job.robot is not None]
    left_open = of_backup(backup)
    if not jobs:
        reasons = "; ".join(found.message for found in left_open[:3])
        raise IrbkinError(f"{path}: has no task whose robot is known: {reasons}")
    return jobs, left_open


def _tasks(backup: Backup, task: Task, of: Job) -> list[tuple[str, Sequence[Module]]]:
    """Return the names of all tasks, the one of the job first, and modules of those read whole;
    nothing of part of a backup, or if a folder stands in for a name.
    """
    is_named = all(own.name != own.folder.rpartition("/")[2] for own in backup.tasks)
    order = sorted(backup.tasks, key=lambda own: own is not task)
    programs = {own.name: backup.programs.get(own.name) for own in order}
    rows = programs.items() if of.is_whole and is_named else ()
    return [(name, own.modules if own and not own.findings else ()) for name, own in rows]


def _given(backup: Backup, names: Sequence[str]) -> set[str] | None:
    """Return the files of a backup's programs that are given, or are in given folders; None if
    these have the whole backup.
    """
    real = {Path(os.path.realpath(name)) for name in names}
    root = Path(os.path.realpath(backup.origin))
    if not real or not real.isdisjoint((root, *root.parents)):
        return None
    given = set()
    for program in backup.programs.values():
        for file in program.files:
            own = root / Path(file.path).relative_to(backup.origin)
            if any(Path(os.path.realpath(it)) in real for it in (own, *own.parents)):
                given.add(file.path)
    return given


def backup_of(names: Sequence[str]) -> str | None:
    """The one backup that all paths are, are in, or are above; None if one of them is not."""
    found: dict[str, str] = {}
    for name in names:
        roots = [name] if is_backup(name) else list(map(str, backups_of(Path(name).absolute())))
        if not roots:
            return None
        for root in roots:
            found.setdefault(os.path.realpath(root), root)
    if len(found) > 1:
        listed = ", ".join(list(found.values())[:10])
        raise IrbkinError(f"{' and '.join(names)}: {len(found)} backups, give one: {listed}")
    return next(iter(found.values()), None)


def is_backup(name: str) -> bool:
    if archive_of(Path(name)) is not None:
        return True
    if not os.path.isdir(name):
        return False
    inside = {inner.upper() for inner in os.listdir(name)}
    return "SYSPAR" in inside or "BACKINFO" in inside or len(inside & {*PARTS, "HOME"}) > 1
