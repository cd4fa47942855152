"""Calls of routines in `irbkin check`: names that are meant, and modules that are missing."""

import json
import time

import command
import irbkin
import pytest
from irbkin._core import instructions

NAME = "IRB 2600-12/1.65"
CALLS = "MODULE M\nPROC main()\n{}\nENDPROC\nPROC rOpenGripper()\nENDPROC\nENDMODULE\n"


def found(folder, calls):
    """The codes and messages on the calls of a module among the others of a folder."""
    (folder / "m.mod").write_text(CALLS.format(calls))
    done = command.run("check", "--robot", NAME, "--json", folder)
    own = json.loads(done.stdout)["findings"]
    return [(it["code"], it["line"], it["message"]) for it in own if it["code"][0] in "NU"]


@pytest.mark.parametrize(
    ("call", "meant"),
    [("rOpenGriper;", "rOpenGripper"), ("WaitTim 1;", "WaitTime"), ("x:=Offss(p,1,2,3);", "Offs")],
)
def test_a_call_that_nothing_declares_names_what_is_meant(tmp_path, call, meant):
    [(code, line, message)] = found(tmp_path, call)
    assert (code, line) == ("N606", 3)
    assert f"; did you mean {meant}" in message


def test_a_call_is_a_note_where_modules_are_missing(tmp_path):
    assert [it[0] for it in found(tmp_path, "rPart7;")] == ["N606"]
    [(code, line, message)] = found(tmp_path, 'Load "HOME:/Part7.mod";\nrPart7;\nrPart8;')
    assert (code, line) == ("U808", 4)
    assert message.startswith("no module that is here declares rPart7, rPart8")
    # A slip of a known name is an error all the same.
    assert [it[0] for it in found(tmp_path, "Load f;\nrOpenGriper;")] == ["N606"]
    (tmp_path / "encoded.mod").write_bytes(b"\xfc\x80\xe0\x26\x00\x01a\n")
    assert [it[0] for it in found(tmp_path, "rPart7;")] == ["U808"]


def test_instructions_and_functions_are_listed_for_editors():
    rows = {name: (kind, arguments) for name, kind, arguments in instructions()}
    assert len(rows) == len(instructions()) > 600
    assert rows["SetDO"] == (
        "instruction",
        r"\num SDelay|switch Sync,signaldo Signal,dionum Value",
    )
    assert rows["Offs"][0] == "function"
    assert rows["OpMode"] == ("function", "")
    assert rows["MoveL"][1].startswith(r"\switch Conc,robtarget ToPoint")


def test_what_a_module_of_the_system_or_a_call_by_name_lacks_is_a_note(tmp_path):
    for call in ('%"rPart7"%;', '% "Part7:rPart8" % 1;'):
        [(code, line, message)] = found(tmp_path, call)
        assert (code, line) == ("U808", 3)
        assert message.startswith(f"{call[:-1]}: no module that is here declares it")
    assert found(tmp_path, '%"M:rOpenGripper"%;') == []
    # A file .sys is a module of the system, whatever its attributes.
    (tmp_path / "n.sys").write_text("MODULE N\nPROC go()\nrDriver;\nENDPROC\nENDMODULE\n")
    assert [it[0] for it in found(tmp_path, "rPart7;")] == ["N606", "U808"]


def test_names_that_options_have_are_no_errors(tmp_path):
    calls = (
        "CornerPathWarning FALSE;\nLinked_m_exe;\nEventLog 1,2;\nSoftElbow\\On;\n"
        "FitSphere ps,pc,r,e;\nCnvPredictReach p;\nTcPickupTool t;\nSMoveL p,v100,z10,t;\n"
        'ConsoleWrite "a";\nIF HR_RobotInHome() HR_Exit;\nGetItmTgt s,t;\nPmWaitProjStart;'
    )
    assert [it for it in found(tmp_path, calls) if it[0].startswith("N")] == []


def test_many_unknown_names_are_found_within_a_second():
    robot = irbkin.Robot(NAME)
    calls = "".join(f"rOpenGriper{number} 1;\n" for number in range(5000))
    data = "".join(f"VAR robtarget alikeAlikeAlike{number};\n" for number in range(1200))
    moves = "".join(f"MoveJ alikeAlikeAlice{number},v9,fine,t;\n" for number in range(1200))
    for text in (CALLS.format(calls), CALLS.format(moves).replace("PROC", f"{data}PROC", 1)):
        module = irbkin.rapid.parse(text)
        begin = time.process_time()
        found = irbkin.rapid.check(robot, module)
        assert time.process_time() - begin < 1.0
        assert len(found) >= 1200
        assert "did you mean" in found[0].message
