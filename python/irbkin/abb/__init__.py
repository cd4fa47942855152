"""Backups of ABB's controllers: robots, limits in force, units and tasks.

    >>> import irbkin.abb
    >>> backup = irbkin.abb.load_backup("examples/backup")  # doctest: +SKIP
    >>> backup.robots["ROB_2"].robot  # doctest: +SKIP

docs/guide/backup.md has an example.
"""

from irbkin.abb.backinfo import BackInfo, parse_backinfo
from irbkin.abb.backup import Backup, Controller
from irbkin.abb.cfg import CfgFile, Instance, parse_cfg
from irbkin.abb.differences import Change, Difference, TargetChange, diff
from irbkin.abb.findings import Finding
from irbkin.abb.load import load_backup
from irbkin.abb.programs import TaskModule
from irbkin.abb.tasks import Task
from irbkin.abb.units import ExternalAxis, ExternalUnit, LimitDifference, RobotUnit

__all__ = [
    "BackInfo",
    "Backup",
    "CfgFile",
    "Change",
    "Controller",
    "Difference",
    "ExternalAxis",
    "ExternalUnit",
    "Finding",
    "Instance",
    "LimitDifference",
    "RobotUnit",
    "TargetChange",
    "Task",
    "TaskModule",
    "diff",
    "load_backup",
    "parse_backinfo",
    "parse_cfg",
]
