"""`load_backup`: the files of a backup, read and related to each other."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import zip_longest
from os import PathLike
from pathlib import Path
from typing import Literal

from irbkin.abb.arms import fitted
from irbkin.abb.backinfo import BackInfo, parse_backinfo
from irbkin.abb.backup import Backup, Controller, ControllerKind
from irbkin.abb.carriers import Machine
from irbkin.abb.cfg import CfgFile, lines_of, parse_cfg
from irbkin.abb.findings import Finding, limited
from irbkin.abb.folders import Folder, open_backup
from irbkin.abb.machine import read_machine
from irbkin.abb.tasks import Task, TaskReader
from irbkin.abb.units import RobotUnit

GENERATIONS: dict[int, ControllerKind] = {4: "S4C+", 5: "IRC5", 6: "IRC5", 7: "OmniCore"}
"""Controllers by the first number of their files' version, which is RobotWare's."""
SIGNALS = ("DI", "DO", "AI", "AO", "GI", "GO")
OF_CONTROLLER = re.compile(r"[A-Z0-9]+")
"""Names as of signals of the controller's own boards, such as DRV1BRAKE: no file has them."""


def load_backup(path: str | PathLike[str]) -> Backup:
    """Read the backup of a controller: S4C+, IRC5, OmniCore.

    Args:
        path: The folder of the backup, one in it or above it, or an archive (.zip, .rspag). Of an
            archive with several, the path goes on: `station.rspag/Backups/NAME`.

    Returns:
        Backup. What the files do not determine is in `findings`; half a backup is read, too.

    Raises:
        IrbkinError: There is no backup, or there are several; the message lists them.
    """
    folder = open_backup(Path(path).absolute())
    moc = parse_cfg(*folder.text("SYSPAR/MOC.cfg", "MOC.cfg"))
    sys = parse_cfg(*folder.text("SYSPAR/SYS.cfg", "SYS.cfg"))
    eio = parse_cfg(*folder.text("SYSPAR/EIO.cfg", "EIO.cfg"))
    info = parse_backinfo(*folder.text("BACKINFO/backinfo.txt", "backinfo.txt"))
    machine = read_machine(moc, info.arms) if moc.file else _by_wording(info)
    reader = TaskReader(folder, sys, moc, info, machine)
    tasks = reader.read()
    machine = _with_only_axes(machine, tasks, moc.file)
    checksums = _checksums(folder)
    findings = [
        *_missing(moc, sys, info, machine, tasks),
        *moc.findings,
        *sys.findings,
        *eio.findings,
        *(() if eio.findings else cross_findings(eio)),
        *info.findings,
        *machine.findings,
        *_undetermined(machine, moc.file),
        *reader.findings,
        *_home_differences(folder, sys, tasks),
        # Reading finds links and files that cannot be read.
        *folder.findings,
    ]
    return Backup(
        folder.root,
        folder.origin,
        _controller(moc, sys, info, machine),
        machine.robots,
        machine.units,
        tasks,
        limited(findings),
        checksums,
        {} if eio.findings else signals_of(eio),
        folder,
    )


def _by_wording(info: BackInfo) -> Machine:
    """Return the machine of a backup without MOC.cfg: the arms of backinfo.txt."""
    robots, findings = {}, []
    for number, wording in enumerate(info.arms, 1):
        found = fitted([wording], (), (), None)
        name = f"ROB_{number}"
        robots[name] = RobotUnit(name, wording, found.arm, found.robot)
        if found.robot is None:
            message = f"{name}: {found.reason}: its moves are not checked"
            findings.append(Finding(info.file, 0, "unknown-arm", "warning", message))
        else:
            message = f"{name}: {found.arm} by backinfo.txt, with the catalog's limits; its base "
            message += "frame is not determined: MOC.cfg is missing"
            findings.append(Finding(info.file, 0, "arm-by-wording", "warning", message))
    return Machine(robots, {}, findings)


def _with_only_axes(machine: Machine, tasks: Iterable[Task], file: str) -> Machine:
    """Return the machine where the only external axis of a task is eax_a, if MOC.cfg does not say.

    Logical axes count from 7 in each group, so that the only one is the first.
    """
    units, findings = dict(machine.units), list(machine.findings)
    for task in tasks:
        moving = [units[name] for name in task.units if units[name].axes]
        if len(moving) != 1 or len(moving[0].axes) != 1 or moving[0].axes[0].eax is not None:
            continue
        unit = moving[0]
        units[unit.name] = replace(unit, axes=(replace(unit.axes[0], eax="a"),))
        message = f"{unit.name}: its logical axis is not in MOC.cfg: taken as eax_a, as the only "
        message += f"external axis of {task.name}"
        findings.append(Finding(file, unit.line, "logical-axis", "note", message))
    return Machine(machine.robots, units, findings)


def _undetermined(machine: Machine, file: str) -> list[Finding]:
    """Say once of each unit what is not determined of its motion."""
    found = []
    for unit in machine.units.values():
        if unit.missing is None or (unit.kind == "servo" and not unit.carries):
            continue
        severity: Literal["warning", "note"] = "warning" if unit.carries else "note"
        message = f"{unit.name}: {unit.missing}"
        if unit.carries:
            message += f": where it carries {', '.join(unit.carries)} is not determined"
        found.append(Finding(file, unit.line, "unit-motion", severity, message))
    return found


def _missing(
    moc: CfgFile, sys: CfgFile, info: BackInfo, machine: Machine, tasks: tuple[Task, ...]
) -> list[Finding]:
    found: list[tuple[Literal["warning", "note"], str]] = []
    if not moc.file:
        arms = "" if machine.robots else "robots, "
        message = f"MOC.cfg is missing: {arms}limits in force and base frames are not determined"
        found.append(("warning", message))
    if not sys.file:
        only = "none is assigned"
        if len(machine.robots) == 1:
            only = "the only robot is taken for all of them"
        message = f"SYS.cfg is missing: which robot a task moves is not determined, {only}"
        found.append(("warning", message))
    if not info.file:
        message = "BACKINFO/backinfo.txt is missing: tasks are named in the order of SYS.cfg"
        found.append(("note", message))
    if not any(task.folder for task in tasks):
        found.append(("warning", "RAPID has no folder TASKn: there are no programs"))
    return [Finding("", 0, "file-missing", severity, message) for severity, message in found]


def _home_differences(folder: Folder, sys: CfgFile, tasks: Iterable[Task]) -> Iterator[Finding]:
    """Yield the files of modules, where SYS.cfg loads them from HOME or directly in it, that have
    another text than every task has loaded.
    """
    names = [it.text("File").replace("\\", "/") for it in sys.of("CAB_TASK_MODULES")]
    of_home = [name[5:] for name in names if name.upper().startswith("HOME:")]
    places = {name.rsplit("/", 1)[-1].lower(): name for name in of_home}
    loaded: dict[str, list[str]] = {}
    for own in (it for task in tasks for it in task.modules if it.kind != "configured"):
        name = own.path.name
        file = folder.find(f"HOME/{places.get(name.lower(), name)}")
        if file is not None and file.is_file():
            loaded.setdefault(folder.shown(file), []).append(own.file)
    for name, files in loaded.items():
        contents = (lines_of(folder.text(it)[0].rstrip()) for it in (name, *files))
        text, *others = ([line.rstrip() for line in lines] for lines in contents)
        if text not in others:
            pairs = enumerate(zip_longest(text, others[0]), 1)
            line = next(number for number, (one, other) in pairs if one != other)
            message = f"differs from {files[0]}, which was loaded, in line {line} first"
            yield Finding(name, min(line, len(text)), "home-differs", "note", message)


def _controller(moc: CfgFile, sys: CfgFile, info: BackInfo, machine: Machine) -> Controller:
    version = moc.version or sys.version
    numbers = [re.match(r"\d{1,4}", it) for it in (version, info.robotware)]
    kinds = [GENERATIONS.get(int(number[0])) for number in numbers if number]
    is_real = any(robot.has_offsets for robot in machine.robots.values())
    kind = next((it for it in kinds if it is not None), None)
    return Controller(kind, info.robotware, version, info.system, is_real)


def _checksums(folder: Folder) -> dict[str, str]:
    """Read BACKINFO/checksum.txt: a line with a path, then one with its base64."""
    text, _ = folder.text("BACKINFO/checksum.txt")
    lines = [line.strip() for line in lines_of(text) if line.strip()]
    # The first line is the version of the file.
    lines = lines[1:] if lines and lines[0].startswith("ver:") else lines
    names = [line.replace("\\", "/").lower().lstrip("./") for line in lines[::2]]
    return dict(zip(names, lines[1::2], strict=False))


def signals_of(cfg: CfgFile) -> dict[str, str]:
    """Return the type of each signal, "DI" to "GO", by its name as EIO.cfg has it."""
    rows = ((it.name, it.text("SignalType").upper()) for it in cfg.of("EIO_SIGNAL"))
    return {name: kind for name, kind in rows if name and kind in SIGNALS}


def cross_findings(cfg: CfgFile) -> Iterator[Finding]:
    """Yield the actors and resultants of cross connections that are no signals."""
    names = {"", *(it.name.lower() for it in cfg.of("EIO_SIGNAL"))}
    for it in cfg.of("EIO_CROSS"):
        for key, name in it.values.items():
            is_known = name.lower() in names or OF_CONTROLLER.fullmatch(name)
            if re.fullmatch(r"res|act\d+", key) and not is_known:
                message = (
                    f"cross connection {it.name}: {name} of its -{key} is no signal of EIO.cfg"
                )
                yield Finding(cfg.file, it.line, "cross-signal", "warning", message)
