"""Moves that are checked with saved values of PERS, or with given tools."""

import json
import re
from xml.etree import ElementTree

import command
import irbkin
import pytest
from backups import SMALL, written
from irbkin import pose, rapid
from irbkin.check.report import Report
from irbkin.rapid.program import ModuleFile, program_of
from test_check import module
from test_check_manners import NAME, listed, output, run

ROBOT = irbkin.Robot(NAME)
MOVES = (
    "MoveJ pNear,v100,fine,tGun;\nMoveJ pNear,v100,fine,tGrip;\nMoveJ pFar,v100,fine,tLong;\n"
    "MoveJ *,v100,fine,tGun;\n"
)


@pytest.fixture
def program(tmp_path):
    """A module with a tool that it declares and two that nothing declares."""
    (file := tmp_path / "grip.mod").write_text(module(MOVES))
    return file


def moves_of(text):
    return json.loads(text)["moves"]


def test_an_undeclared_tool_is_said_once_with_its_cure(tmp_path):
    (file := tmp_path / "twice.mod").write_text(module("MoveJ pNear,v100,fine,qqqq;\n" * 3))
    (found,) = listed(output("--json", file))
    assert found["code"] == "N602"
    wanted = "MoveJ pNear: qqqq is not declared (and 2 more moves); give it with --tool qqqq=X Y Z"
    assert found["message"] == wanted
    assert len(found["related"]) == 2


def test_a_given_tool_is_checked_and_counted_apart(program):
    words = ("--tool", "0", "0", "180")
    first, last = output(program, "-q", *words), output(program, *words)
    assert first == ""
    assert last.splitlines() == [
        "1 of 4 moves checked, 2 more with saved values or given tools; "
        "1 not: 1 by unknown values.",
        "No findings in the 3 moves checked.",
    ]
    assert run("-r", NAME, program, *words).returncode == 0
    named = ("--tool", "tLong=0", "0", "3000", "--tool", "TGRIP=0", "0", "180", "0", "0", "0")
    (found,) = listed(output("--json", program, *named))
    assert (found["code"], found["severity"]) == ("R101", "note")
    assert found["message"].endswith("(with the tool of --tool)")
    assert run("-r", NAME, program, *named).returncode == 0
    wanted = {"checked": 1, "assumed": 2, "total": 4, "reasons": {"unknown values": 1}, "unread": 0}
    assert moves_of(output("--json", program, *named)) == wanted
    (ran,) = json.loads(output("--output-format", "sarif", program, *named))["runs"]
    assert ran["properties"]["moves"] == wanted
    assert [it["level"] for it in ran["results"]] == ["note"]
    root = ElementTree.fromstring(output("--output-format", "junit", program, *named))
    cases = [it.get("name") for it in root.findall("testsuite[@name='moves']/testcase")]
    assert cases == [
        "1 move checked",
        "2 moves checked with saved values or given tools",
        "1 move not checked by unknown values",
    ]
    assert root.find(".//failure") is None
    assert output("--output-format", "html", program, *named).count("2 more with saved values") > 0
    assert "::notice title=irbkin R101" in output("--output-format", "github", program, *named)
    (row,) = re.findall(r"^main .*", output("--verdict", program, *named), re.MULTILINE)
    assert row.split()[:4] == ["main", "4", "2", "1"]


def test_all_is_passed_only_without_assumptions(tmp_path):
    (file := tmp_path / "grip.mod").write_text(module("MoveJ pNear,v100,fine,tGrip;\n"))
    done = run("-r", NAME, file, "--tool", "0", "0", "180")
    assert done.stdout.decode().splitlines() == [
        "0 of 1 move checked, 1 more with saved values or given tools.",
        "No findings in the 1 move checked.",
    ]
    assert done.returncode == 0
    assert not Report(NAME, [], {}, 0, 1, {"unknown tools": 1}).is_wrong
    assert Report(NAME, [], {}, 0, 0, {"unknown tools": 1}).is_wrong


def test_a_given_tool_has_the_forms_of_tools(program, tmp_path):
    data = "PERS tooldata tOther:=[TRUE,[[0,0,3000],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];"
    (tmp_path / "tools.sys").write_text(f"MODULE T\n{data}\nENDMODULE\n")
    wanted = output(program, "--tool", "tLong=0", "0", "3000")
    assert "R101" in wanted
    for words in (
        ["tLong=0", "0", "3000", "1", "0", "0", "0"],
        ["tLong=[TRUE,[[0,0,3000],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]"],
        [f"tLong={tmp_path / 'tools.sys'}:tOther"],
        [f"tLong={data}"],
    ):
        assert output(program, "--tool", *words) == wanted, words
    for words, message in (
        (["tLong=0", "0"], "--tool takes 3 numbers"),
        (["0", "0", "x"], "--tool: 'x' is not a finite number"),
        (["tLong="], "--tool: '' is not a finite number"),
        (["0", "0", "0.18"], "are these meters?"),
    ):
        assert message in command.refused("check", "-r", NAME, program, "--tool", *words), words
    (tmp_path / "irbkin.toml").write_text(f'[check]\nrobot = "{NAME}"\ntool = [0, 0, 180]\n')
    assert output(program) == output(program, "--tool", "0", "0", "180")


def test_a_given_tool_that_stands_for_none_is_named(program):
    for name, words in (
        ("tGun", "--tool tGun: the program declares it, and its own value counts"),
        ("tGrap", "--tool tGrap: no move uses it"),
    ):
        done = run("-r", NAME, program, "--tool", f"{name}=0", "0", "100")
        assert done.stderr.decode() == f"irbkin: {words}\n"
        assert done.stdout == run("-r", NAME, program).stdout


def test_tools_are_given_in_python():
    own = program_of([ModuleFile("m.mod", module(MOVES).encode())])
    tool = rapid.ToolData(tframe=rapid.Pose.of(pose([0, 0, 0.18])))
    for tools in (
        {"tGrip": tool, "tlong": pose([0, 0, 0.18])},
        {None: tool},
        {None: [0, 0, 3.0], "TGRIP": tool, "tLong": tool},
    ):
        checked = own.check(ROBOT, tools=tools)
        assert [it.assumed for it in checked.moves] == [False, True, True, False]
        assert [it.unchecked for it in checked.moves] == [None, None, None, "U801"]
        assert {it.severity for it in checked.findings} <= {"note"}
    (far,) = own.check(ROBOT, tools={None: [0, 0, 3.0], "tGrip": tool}, codes=["R101"]).findings
    assert (far.severity, far.line) == (
        "note",
        module(MOVES).split("\n").index(MOVES.split("\n")[2]) + 1,
    )


SAVED = """MODULE Saved
TASK PERS wobjdata wActive:=[FALSE,TRUE,"",[[9000,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
CONST robtarget pIn:=[[1500,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST robtarget pOut:=[[9500,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC Pick(robtarget p,PERS wobjdata wobj)
    MoveJ p,v100,fine,tool0\\WObj:=wobj;
ENDPROC
PROC rTeach()
    wActive:=DefFrame(CRobT(),CRobT(),CRobT());
ENDPROC
PROC main()
    MoveJ pIn,v100,fine,tool0;
    MoveJ pIn,v100,fine,tool0\\WObj:=wActive;
    Pick pIn,wActive;
    MoveJ pOut,v100,fine,tool0;
ENDPROC
ENDMODULE
"""


def test_a_backup_is_checked_with_its_saved_values(tmp_path):
    file = "RAPID/TASK1/PROGMOD/Main.mod"
    backup = written(tmp_path / "backup", {**SMALL, file: SAVED})
    record = json.loads(run("--json", backup).stdout)
    found = [it for it in record["findings"] if it["code"] == "R101"]
    rows = {SAVED.split("\n")[it["line"] - 1].split(",")[0].strip(): it for it in found}
    assert {name: it["severity"] for name, it in rows.items()} == {
        "MoveJ pIn": "note",
        "Pick pIn": "note",
        "MoveJ pOut": "error",
    }
    for it in found:
        is_said = it["message"].endswith("(with the saved value of wActive)")
        assert is_said == (it["severity"] == "note")
    assert (record["moves"]["checked"], record["moves"]["assumed"]) == (2, 2)
    # Elsewhere such moves are not checked, unless that is asked for.
    given = ("--robot", "IRB 4600-40/2.55", backup / file)
    assert moves_of(run("--json", *given).stdout)["reasons"] == {"unknown values": 2}
    assert moves_of(run("--json", "--last-values", *given).stdout)["assumed"] == 2
