"""What `irbkin check` writes: what was asked for alone, and nothing if the request is wrong."""

import re

import command
import pytest
from backups import LIMITS, arms, backinfo, cfg, robot, written
from test_check_manners import NAME, SEAM, listed, run, seam  # noqa: F401

FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"
ONE, TWO, SHARED = "RAPID/TASK1/PROGMOD/One.mod", "RAPID/TASK2/PROGMOD/Two.mod", "HOME/Shared.sys"


def target(name, y):
    """A target with confdata that no solution has."""
    return f"CONST robtarget {name}:=[[1500,{y},1000],[0,0,1,0],[3,0,3,0],{FAR}];\n"


def module(name, *others, data=""):
    """A module that moves to its own target and to others."""
    moves = "".join(f"MoveJ {it},v100,fine,tool0;\n" for it in (f"p{name}", *others))
    text = f"MODULE {name}\n{target(f'p{name}', -300)}{data}"
    return f"{text}PROC r{name}()\n{moves}ENDPROC\nENDMODULE\n"


@pytest.fixture
def backup(tmp_path):
    """Two robots of one kind, whose tasks have a module in common."""
    groups, tasks, robots, limits = [], [], [], []
    for n in (1, 2):
        groups.append(f'-Name "g{n}" -Robot "ROB_{n}"')
        tasks.append(f'-Name "T{n}" -Type "NORMAL" -UseMechanicalUnitGroup "g{n}" -MotionTask')
        robots.append(robot(f"ROB_{n}", "ROB1_4600_2.55_40", f"rob{n}"))
        limits += arms(f"rob{n}", LIMITS)
    loaded = ['-File "HOME:/Shared.sys" -ModName "Shared" -AllMotionTask']
    of_sys = {"CAB_TASKS": tasks, "CAB_TASK_MODULES": loaded, "MECHANICAL_UNIT_GROUP": groups}
    files = {
        "BACKINFO/backinfo.txt": backinfo(("T1", "PROGMOD/One.mod"), ("T2", "PROGMOD/Two.mod")),
        "SYSPAR/MOC.cfg": cfg("MOC", "6:0", ARM=limits, ROBOT=robots),
        "SYSPAR/SYS.cfg": cfg("SYS", "6:0", **of_sys),
        ONE: module("One", "pLeft"),
        TWO: module("Two", "pRight"),
        SHARED: module("Shared", data=target("pLeft", -200) + target("pRight", 200)),
    }
    return written(tmp_path / "backup", files)


@pytest.mark.parametrize(
    ("given", "files", "count"),
    [
        ([""], {ONE, TWO, SHARED}, 5),
        ([ONE], {ONE}, 1),
        ([SHARED], {SHARED}, 3),
        (["RAPID/TASK2"], {TWO}, 1),
        (["RAPID"], {ONE, TWO}, 2),
        ([TWO, "HOME"], {TWO, SHARED}, 4),
    ],
)
def test_the_files_that_are_given_are_corrected_and_no_others(backup, given, files, count):
    names = [backup / name for name in given]
    before = {name: (backup / name).read_text() for name in (ONE, TWO, SHARED)}
    found = [it for it in listed(run("--json", *names).stdout) if it["fixable"]]
    last = run(*names).stdout.decode().splitlines()[-1]
    difference = run("--diff", *names)
    shown = re.findall(r"^\+\+\+ (.*)$", difference.stdout.decode(), re.MULTILINE)
    assert sorted(shown) == sorted(str(backup / name) for name in files)
    done = run("--fix", *names).stdout.decode().splitlines()[-1]
    after = {name: (backup / name).read_text() for name in before}
    assert {name for name in before if before[name] != after[name]} == files
    # A finding in a module of two tasks is one.
    assert len(found) == count
    assert f"({count} fixable with --fix)" in last
    assert difference.stderr.decode().startswith(f"irbkin: --fix would remove {count} finding")
    assert f"({count} fixed, " in done
    assert run("--diff", *names).returncode == 0


def test_a_target_that_two_robots_need_with_different_confdata_is_left(backup):
    kind, limits = "ROB1_4600_2.55_40", [*arms("rob1", LIMITS), *arms("rob2", LIMITS)]
    across = robot("ROB_2", kind, "rob2", (3, 0, 0), (0, 0, 0, 1))
    robots = [robot("ROB_1", kind, "rob1"), across]
    (backup / "SYSPAR" / "MOC.cfg").write_text(cfg("MOC", "6:0", ARM=limits, ROBOT=robots))
    (backup / TWO).write_text(module("Two", "pLeft"))
    before = (backup / SHARED).read_text()
    for codes in ("C201", "C"):
        done = run("--fix", "--select", codes, backup / SHARED)
        assert (done.returncode, done.stderr) == (1, b"")
        assert (backup / SHARED).read_text() == before
    (backup / TWO).write_text(module("Two"))
    run("--fix", "--select", "C", backup / SHARED)
    (line,) = set((backup / SHARED).read_text().splitlines()) - set(before.splitlines())
    assert line == target("pLeft", -200).strip().replace("[3,0,3,0]", "[-1,0,-1,0]")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--statistics", "--output-format", "html"], "--statistics is written as"),
        (["-o", "report.yaml"], "must end in .json"),
        (["-o", "none/report.json"], "cannot be written: No such file"),
        (["--select", "X"], "unknown code 'X'"),
    ],
)
def test_a_wrong_request_writes_nothing(seam, options, words):  # noqa: F811
    names = [seam.parent / it if "/" in it else it for it in options]
    assert words in command.refused("check", "--robot", NAME, "--fix", *names, seam)
    assert seam.read_text() == SEAM


@pytest.mark.parametrize(
    "options",
    [["-o", "r.json"], ["--json"], ["--output-format", "text"], ["--statistics"], ["--verdict"]],
)
def test_a_difference_is_no_report(seam, options):  # noqa: F811
    words = command.refused("check", "--robot", NAME, "--diff", *options, seam)
    assert "--diff has no report: leave out its format, -o, --statistics and" in words


def test_what_is_excluded_is_said(seam):  # noqa: F811
    toml = seam.with_name("irbkin.toml")
    toml.write_text(f'[check]\nrobot = "{NAME}"\nexclude = ["*.mod"]\n')
    for name in (seam, seam.parent):
        done = run(name)
        assert done.returncode == 0
        words = f"irbkin: {name}: excluded by {toml}: nothing is checked\n"
        assert done.stderr.decode() == words
    seam.with_name("other.sys").write_text("MODULE Other\nENDMODULE\n")
    assert run(seam.parent).stderr == b""


def test_junit_fails_where_the_exit_code_does(seam):  # noqa: F811
    for text, select in ((SEAM, "D"), (SEAM.replace("tGun;", "tGum;"), "D"), (SEAM, "ALL")):
        seam.write_text(text)
        done = run("--robot", NAME, "--select", select, "--output-format", "junit", seam)
        assert (b"<failure" in done.stdout) == (done.returncode == 1)
