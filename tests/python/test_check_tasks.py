"""Tasks of a MultiMove backup that wait for each other."""

import command
import pytest
from backups import LIMITS, arms, backinfo, cfg, robot, written
from irbkin.check.jobs import jobs_of_backup

DATA = """PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident meet; VAR syncident on; VAR syncident off;
CONST robtarget p:=[[1500,0,1500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""
GOOD = """WaitSyncTask meet,both;
SyncMoveOn on,both;
MoveJ p\\ID:=10,v100,fine,tool0;
SyncMoveOff off;"""
LATE = GOOD.replace("WaitSyncTask meet,both;\n", "") + "\nWaitSyncTask meet,both;"


def backup(folder, *programs, listed="", background=""):
    """A backup of two robots, whose tasks have these statements in `main`."""
    groups, tasks, robots, limits, loaded, files = [], [], [], [], [], {}
    for n, body in enumerate(programs, 1):
        groups.append(f'-Name "g{n}" -Robot "ROB_{n}"')
        tasks.append(f'-Name "T_ROB{n}" -Type "NORMAL" -UseMechanicalUnitGroup "g{n}" -MotionTask')
        robots.append(robot(f"ROB_{n}", "ROB1_4600_2.55_40", f"rob{n}"))
        limits += arms(f"rob{n}", LIMITS)
        loaded.append((f"T_ROB{n}", "PROGMOD/Main.mod", *filter(None, [listed])))
        text = f"MODULE Main\n{DATA}PROC main()\n{body}\nENDPROC\nENDMODULE\n"
        files[f"RAPID/TASK{n}/PROGMOD/Main.mod"] = text
    if background:
        tasks.append(f'-Name "{background}" -Type "SEMISTATIC"')
    files["BACKINFO/backinfo.txt"] = backinfo(*loaded)
    files["SYSPAR/MOC.cfg"] = cfg("MOC", "6:0", ARM=limits, ROBOT=robots)
    files["SYSPAR/SYS.cfg"] = cfg("SYS", "6:0", CAB_TASKS=tasks, MECHANICAL_UNIT_GROUP=groups)
    return written(folder / "backup", files)


def found(folder):
    done = command.run("check", "-q", "--output-format", "concise", "--select", "M", folder)
    lines = done.stdout.decode().splitlines()
    return [line.partition("TASK")[2] for line in lines if ": M1" in line]


def test_tasks_that_meet_have_no_finding(tmp_path):
    assert found(backup(tmp_path, GOOD, GOOD, background="T_BCK")) == []


def test_a_deadlock_is_found_in_each_task(tmp_path):
    assert found(backup(tmp_path, GOOD, LATE)) == [
        "1/PROGMOD/Main.mod:6:1: M101 WaitSyncTask meet,both: T_ROB2 waits for others before, in "
        "line 6 of Main",
        "2/PROGMOD/Main.mod:6:1: M101 SyncMoveOn on,both: T_ROB1 waits for others before, in "
        "line 6 of Main",
    ]


def test_a_missing_point_is_found(tmp_path):
    other = GOOD.replace("WaitSyncTask meet,both;", "!")
    assert found(backup(tmp_path, GOOD, other)) == [
        "1/PROGMOD/Main.mod:6:1: M101 WaitSyncTask meet,both: T_ROB2 of its list never waits there"
    ]


@pytest.mark.parametrize(
    ("other", "listed"),
    [("%%%\n!", ""), ("WaitTime 1;", "PROGMOD/More.mod"), ('Load "HOME:/more.mod";', "")],
)
def test_of_tasks_that_are_not_read_whole_nothing_is_found(tmp_path, other, listed):
    assert found(backup(tmp_path, GOOD, other, listed=listed)) == []


def test_names_of_tasks_are_compared_only_if_the_backup_has_them(tmp_path):
    folder = backup(tmp_path, GOOD)
    assert "T_ROB2 of its list is no task of the controller" in found(folder)[0]
    for file in ("SYSPAR/SYS.cfg", "BACKINFO/backinfo.txt"):
        (folder / file).unlink()
    [job], _ = jobs_of_backup(str(folder))
    assert job.tasks == []
