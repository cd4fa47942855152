"""The files of a backup: .cfg and backinfo.txt, folders, archives, tasks."""

import os
import time
from collections import Counter

import irbkin
import pytest
from backups import LIMITS as ROBOT_LIMITS
from backups import MOC, MODULE, SMALL, SYS, arms, backinfo, cfg, robot, written, zipped
from irbkin.abb import load_backup, parse_backinfo, parse_cfg


def codes(backup):
    return sorted(it.code for it in backup.findings)


def files_of(backup, task):
    return [module.file for module in backup.task(task).modules]


def test_the_grammar_of_cfg_files():
    text = (
        "MOC:CFG_1.0:7:0::\r\n#\r\n# a comment\r\nROBOT:\r\n\r\n"
        '      -name "ROB: 1/2" -a -5\t-b 3.6E+006 -c\\\r\n'
        '-d 1E-007 -E 0.0500000007 -switch_on \r\n\r\n-name "plain" -off 0\r\n#\r\nARM:\r\n'
    )
    found = parse_cfg(text, "SYSPAR/MOC.cfg")
    assert (found.domain, found.version, found.findings) == ("MOC", "7:0", ())
    first, second = found.of("robot")
    assert (first.name, first.line, second.line) == ("ROB: 1/2", 6, 9)
    numbers = {key: first.number(key) for key in "abde"}
    assert numbers == {"a": -5.0, "b": 3.6e6, "d": 1e-7, "e": 0.0500000007}
    assert [first.switch(key) for key in ("c", "switch_on", "none")] == [True, True, False]
    assert not second.switch("off")
    assert second.number("missing", 7.0) == 7.0
    assert found.named("ROBOT", "PLAIN") is second
    assert found.of("ARM") == ()


@pytest.mark.parametrize(
    ("line", "finding"),
    [
        ("<<<<<<< HEAD", "4: warning: a marker of a merge conflict: both sides are read"),
        ("=======", "4: warning: a marker of a merge conflict: both sides are read"),
        (">>>>>>> branch", "4: warning: a marker of a merge conflict: both sides are read"),
        ("no key here", "4: warning: is not read: 'no key here'"),
        ('-name "X', "4: warning: ROBOT X: the string 'X' has no closing quote"),
        ('-name "X" "Y"', "4: warning: ROBOT X: 'Y' has no key"),
        ('-name "X" -name "Y"', "4: warning: ROBOT X: -name is given twice, the last one counts"),
        ('-name "X"\\', "5: warning: ROBOT X: `\\` announces another line, and none follows"),
        ('-name "X"\n-b 1', "5: warning: ROBOT X: goes on without `\\` in the line before"),
        ('-name "Rob" -a 1', "6: warning: ROBOT ROB is in line 4, too: the first one counts"),
    ],
)
def test_a_broken_line_is_a_finding_and_the_rest_is_read(line, finding):
    text = f'MOC:CFG_1.0:6:0::\nROBOT:\n\n{line}\n\n-name "ROB" -x 2\n'
    found = parse_cfg(text, "m")
    assert str(found.findings[0]).startswith(f"m:{finding}"), found.findings
    assert found.of("ROBOT")[-1].number("x") == 2.0
    assert len(found.findings) == 1


def test_a_text_that_is_encoded_is_not_read():
    found = parse_cfg("MOC\0CFG", "m")
    assert [it.code for it in found.findings] == ["not-text"]
    assert [it.code for it in parse_backinfo("a\0b").findings] == ["not-text"]


def test_backinfo_of_each_generation_is_read():
    old = parse_backinfo(
        "#\n# Generated backup file, do not edit.\n#\n>>PRODUCTS_ID:\n"
        "3HAC6811-2.27 0986 System Pack 4.0\n  IRB 6600/2.55-175\n\n>>ROBOT_TYPE:\n6600/2.55-175\n"
        ">>TASK0: (MAIN)\nSYSMOD\\USER.sys @ user.sys\nPROGMOD\\X.mod @ \n"
        "SYSMOD/LINKEDM.sys @ HIDDEN\nSYSMOD/PosRec.sys @ home:/system/posrec.sys\n>>EOF:\n"
    )
    assert (old.robotware, old.arms) == ("4.0", ("6600/2.55-175",))
    (task,) = old.tasks
    assert (task.number, task.name, task.program) == (0, "MAIN", "")
    assert [(it.path, it.source, it.is_hidden) for it in task.modules] == [
        ("SYSMOD/USER.sys", "user.sys", False),
        ("PROGMOD/X.mod", "", False),
        ("SYSMOD/LINKEDM.sys", "", True),
        ("SYSMOD/PosRec.sys", "home:/system/posrec.sys", False),
    ]
    new = parse_backinfo(
        ">>SYSTEM_ID:\r\nCell\r\n>>PRODUCTS_ID:\r\nRobotOS Version: 17.1.0\r\n"
        "RobotControl Version: 7.19.1\r\n  709-1 Master/Slave Single\r\n"
        "  IRB 4600-40/2.55 Type C\r\n  3119-1 RobotStudio Connect\r\n"
        ">>TASK1: (T_ROB1,Weld,)\r\n>>>>>>> main\r\n>>TASK2: (T_ROB2,,)\r\n"
    )
    assert (new.system, new.robotware) == ("Cell", "7.19.1")
    assert new.arms == ("IRB 4600-40/2.55 Type C",)
    assert [(it.name, it.program) for it in new.tasks] == [("T_ROB1", "Weld"), ("T_ROB2", "")]
    assert [(it.line, it.code) for it in new.findings] == [(10, "conflict-marker")]


@pytest.mark.parametrize("start", ["", "SYSPAR", "SYSPAR/MOC.cfg", "RAPID/TASK1/PROGMOD", ".."])
def test_a_backup_is_found_from_within_and_from_above(tmp_path, start):
    written(tmp_path / "stations" / "one", SMALL)
    backup = load_backup(tmp_path / "stations" / "one" / start)
    assert backup.path.resolve() == tmp_path / "stations" / "one"
    assert codes(backup) == []


def test_a_backup_in_home_is_another_one_and_several_are_listed(tmp_path):
    nested = {f"HOME/old/{name}": content for name, content in SMALL.items()}
    written(tmp_path / "a", {**SMALL, **nested})
    assert codes(load_backup(tmp_path)) == []
    written(tmp_path / "b", SMALL)
    with pytest.raises(irbkin.IrbkinError, match=r"has 2 backups, give one: .*a, .*b$"):
        load_backup(tmp_path)


def test_no_backup_is_an_error(tmp_path):
    with pytest.raises(
        irbkin.IrbkinError, match="is no backup of a controller, it has no BACKINFO"
    ):
        load_backup(written(tmp_path, {"notes.txt": ""}))
    with pytest.raises(irbkin.IrbkinError, match="no such file or folder"):
        load_backup(tmp_path / "missing")


@pytest.mark.parametrize("inside", ["", "Backups/Cell/", "Controller Data\\Cell\\"])
def test_a_backup_in_an_archive_is_read(tmp_path, inside):
    files = {f"{inside}{name}": content for name, content in SMALL.items()}
    archive = zipped(tmp_path / "station.rspag", {**files, "../outside.mod": MODULE})
    backup = load_backup(archive)
    assert codes(backup) == []
    assert files_of(backup, "T_ROB1") == ["RAPID/TASK1/PROGMOD/Main.mod"]
    file = backup.task("T_ROB1").modules[0].path
    assert file.read_text() == MODULE
    assert not list(tmp_path.rglob("outside.mod"))
    del backup
    assert not file.exists()


def test_one_of_several_backups_in_an_archive_is_given_by_its_path(tmp_path):
    files = {f"Backups/{it}/{name}": text for it in "ab" for name, text in SMALL.items()}
    archive = zipped(tmp_path / "station.zip", files)
    with pytest.raises(irbkin.IrbkinError, match=r"station.zip/Backups/a, .*station.zip/Backups/b"):
        load_backup(archive)
    assert load_backup(archive / "Backups" / "b").path.name == "b"
    archive.write_bytes(archive.read_bytes()[:200])
    with pytest.raises(irbkin.IrbkinError, match=r"station.zip: cannot be unpacked: "):
        load_backup(archive)


@pytest.mark.parametrize(
    ("without", "robots", "found"),
    [
        ("SYSPAR/MOC.cfg", 0, ["file-missing"]),
        ("SYSPAR/SYS.cfg", 1, ["file-missing"]),
        ("BACKINFO/backinfo.txt", 1, ["file-missing"]),
        ("RAPID/TASK1/PROGMOD/Main.mod", 1, ["file-missing", "module-missing"]),
    ],
)
def test_half_a_backup_works_with_what_is_there(tmp_path, without, robots, found):
    backup = load_backup(written(tmp_path, {k: v for k, v in SMALL.items() if k != without}))
    assert len(backup.robots) == robots
    assert codes(backup) == found
    (task,) = backup.tasks
    assert (task.name, task.robot) == ("T_ROB1", "ROB_1" if robots else None)


def test_a_single_configuration_file_is_enough(tmp_path):
    backup = load_backup(written(tmp_path, {"moc.cfg": MOC.replace(":6:0::", "::")}) / "moc.cfg")
    assert backup.robots["ROB_1"].arm == "IRB 4600-40/2.55"
    assert backup.controller.kind is None


def test_two_robots_without_sys_are_not_assigned(tmp_path):
    second = robot("ROB_2", "ROB2_4600_2.55_40", "rob1", (0, 3, 0))
    units = [robot("ROB_1", "ROB1_4600_2.55_40", "rob1"), second]
    moc = cfg("MOC", "6:0", ARM=arms("rob1", ROBOT_LIMITS), ROBOT=units)
    files = {**SMALL, "SYSPAR/MOC.cfg": moc}
    del files["SYSPAR/SYS.cfg"]
    backup = load_backup(written(tmp_path, files))
    assert codes(backup) == ["file-missing", "task-robot"]
    assert backup.findings[-1].message == (
        "which of ROB_1, ROB_2 the tasks T_ROB1 move is not determined: SYS.cfg, which assigns "
        "them, is missing"
    )
    assert backup.task("T_ROB1").robot is None


def test_arms_of_backinfo_replace_a_missing_moc(tmp_path):
    products = "RobotWare Version: 6.08\n  IRB 2600ID-8/2.00\n  IRB 660-180/3.15"
    files = {"BACKINFO/backinfo.txt": backinfo(("T_ROB1",), products=products)}
    backup = load_backup(written(tmp_path, {**files, "SYSPAR/SYS.cfg": SYS}))
    assert [it.arm for it in backup.robots.values()] == ["IRB 2600ID-8/2.0", None]
    with pytest.raises(irbkin.InvalidModelError, match="ROB_1: its base frame is not determined"):
        backup.robot_at("ROB_1")


def test_modules_that_sys_loads_are_found_in_home(tmp_path):
    loads = [
        '-File "HOME:/cell/A.sys" -ModName "A" -Task "t_rob1" -Hidden',
        '-File "home:\\cell\\b.SYS" -AllMotionTask -Shared',
        '-File "HOME:/cell/MAIN.mod" -Task "T_ROB1"',
        '-File "HOME:/../../outside.sys" -Task "T_ROB1"',
        '-File "HOME:/cell/none.sys" -Task "T_ROB1"',
        '-File "RELEASE:/options/x.sys" -AllTask',
        '-File "SMARTGRIPPER:/y.sys" -AllTask',
        '-File "MAINPROG.prg" -Task "T_ROB1"',
    ]
    tasks = ['-Name "T_ROB1" -Type "NORMAL" -MotionTask']
    files = {
        **SMALL,
        "SYSPAR/SYS.cfg": cfg("SYS", "6:0", CAB_TASK_MODULES=loads, CAB_TASKS=tasks),
        "HOME/Cell/a.sys": MODULE,
        "HOME/Cell/B.sys": MODULE,
        "HOME/Cell/Main.mod": MODULE,
        "HOME/MAINPROG.PRG": MODULE,
        "HOME/Cell/other.mod": MODULE,
    }
    written(tmp_path, {"outside.sys": MODULE})
    backup = load_backup(written(tmp_path / "backup", files))
    modules = backup.task("T_ROB1").modules
    # What was loaded counts, not the copy in HOME.
    assert [(it.file, it.kind) for it in modules] == [
        ("RAPID/TASK1/PROGMOD/Main.mod", "program"),
        ("HOME/Cell/a.sys", "configured"),
        ("HOME/Cell/B.sys", "configured"),
        ("HOME/MAINPROG.PRG", "configured"),
    ]
    assert [it.is_hidden for it in modules[1:3]] == [True, False]
    assert codes(backup) == ["module-installed", "module-missing", "module-outside"]


def test_modules_have_the_order_of_backinfo_and_missing_ones_are_said(tmp_path):
    names = ("PROGMOD/B.mod @ ", "PROGMOD/Gone.mod @ ", "SYSMOD/Secret.sys @ HIDDEN")
    files = {
        **SMALL,
        "BACKINFO/backinfo.txt": backinfo(("T_ROB1", *names, "PROGMOD/Main.mod @ ")),
        "RAPID/TASK1/PROGMOD/A.modx": MODULE,
        "RAPID/TASK1/PROGMOD/b.mod": MODULE,
        "RAPID/TASK1/PROGMOD/readme.txt": "",
        "RAPID/TASK1/SYSMOD/b.sys": MODULE,
    }
    backup = load_backup(written(tmp_path, files))
    order = [file.removeprefix("RAPID/TASK1/") for file in files_of(backup, "T_ROB1")]
    assert order == ["PROGMOD/b.mod", "PROGMOD/Main.mod", "PROGMOD/A.modx", "SYSMOD/b.sys"]
    found = {it.code: (it.severity, it.message) for it in reversed(backup.findings)}
    assert found["module-missing"] == (
        "warning",
        "T_ROB1: the backup lacks its module PROGMOD/Gone.mod",
    )
    assert found["module-unlisted"][0] == "note"
    counts = Counter(codes(backup))
    assert counts == {"doubled-module": 1, "module-missing": 2, "module-unlisted": 2}


def test_a_s4c_backup_has_one_task_that_moves(tmp_path):
    files = {
        "BACKINFO/backinfo.txt": ">>PRODUCTS_ID:\n4.0.100\n>>TASK0: (MAIN)\nPROGMOD\\P.prg @ \n",
        "SYSPAR/MOC.cfg": cfg(
            "MOC",
            "4:0",
            ARM=arms(
                "rob1", [(-180, 180), (-65, 85), (-180, 70), (-300, 300), (-120, 120), (-360, 360)]
            ),
            ROBOT=[robot("master", "6600_2.55_175", "rob1")],
        ),
        "SYSPAR/SYS.cfg": cfg("SYS", "4:0", CAB_TASKS=['-Name "MAIN"']),
        "RAPID/TASK0/PROGMOD/P.prg": MODULE,
    }
    backup = load_backup(written(tmp_path, files))
    assert codes(backup) == []
    assert backup.controller.kind == "S4C+"
    (task,) = backup.tasks
    assert (task.name, task.moves, task.robot) == ("MAIN", True, "master")


def test_links_out_of_the_backup_are_not_followed(tmp_path):
    written(tmp_path, {"secret.mod": MODULE, "folder/x.mod": MODULE})
    backup_path = written(tmp_path / "backup", SMALL)
    program = backup_path / "RAPID" / "TASK1" / "PROGMOD"
    (program / "Link.mod").symlink_to(tmp_path / "secret.mod")
    (program / "Same.mod").symlink_to(program / "Main.mod")
    (program / "Round.mod").symlink_to(program / "Round.mod")
    (backup_path / "RAPID" / "TASK2").symlink_to(tmp_path / "folder")
    backup = load_backup(backup_path)
    assert files_of(backup, "T_ROB1") == [
        "RAPID/TASK1/PROGMOD/Main.mod",
        "RAPID/TASK1/PROGMOD/Same.mod",
    ]
    links = {it.file for it in backup.findings if it.code == "symlink"}
    assert {"RAPID/TASK2", "RAPID/TASK1/PROGMOD/Link.mod"} <= links
    assert len(backup.tasks) == 1


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root reads everything")
def test_a_file_that_cannot_be_read_is_a_finding(tmp_path):
    written(tmp_path, SMALL)
    (tmp_path / "SYSPAR" / "SYS.cfg").chmod(0)
    assert codes(load_backup(tmp_path)) == ["file-missing", "unreadable"]


def test_checksums_of_an_omnicore_are_by_file(tmp_path):
    sums = "ver:1\n/RAPID/TASK1/PROGMOD/Main.mod\nq83vEjRWeJA=\n.\\SYSPAR\\SYS.cfg\nEjRWeJCrze8=\n"
    backup = load_backup(written(tmp_path, {**SMALL, "BACKINFO/checksum.txt": sums}))
    assert backup.checksums == {
        "rapid/task1/progmod/main.mod": "q83vEjRWeJA=",
        "syspar/sys.cfg": "EjRWeJCrze8=",
    }


def test_a_backup_of_many_modules_is_read_in_time(tmp_path):
    modules = {f"RAPID/TASK1/PROGMOD/M{i}.mod": MODULE for i in range(300)}
    written(tmp_path, {**SMALL, **modules})
    start = time.perf_counter()
    assert len(load_backup(tmp_path).task("T_ROB1").modules) == 301
    assert time.perf_counter() - start < 1.0
