"""Calls of routines in `irbkin check`: names that are meant, and modules that are missing."""

import json
import subprocess
import sys
import time

import command
import irbkin
import pytest
from irbkin._core import instructions

NAME = "IRB 2600-12/1.65"
CALLS = (
    "MODULE M VAR num x; VAR robtarget p; VAR string f;\nPROC main()\n{}\nENDPROC\n"
    "PROC rOpenGripper()\nENDPROC\nENDMODULE\n"
)


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
        'ConsoleWrite "a";\nIF HR_RobotInHome() HR_Exit;\nGetItmTgt s,t;\nPmWaitProjStart;\n'
        "AckItmTgt s,t,TRUE;\nPDispAdd p;\nSearch_Part p,p,v9,t;\np:=PoseAdd(p,p);\n"
        "f:=ReadStr(x\\Status:=x);"
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


T = "PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];\n"
P = "CONST robtarget p:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
KNOWN = "".join(f"g{number}:={number};\n" for number in range(900))
FANS = {
    "calls": ("", "", "{next};{next};", ""),
    "arguments": ("", "num x", "{next} x+1;{next} x+2;", " 1"),
    "arrays": ("VAR robtarget b{500};\n", "robtarget x{*}", "{next} x;{next} x;", " b"),
    "data of routines": ("", "", "VAR robtarget l{900};VAR num b:=1;\n{next};{next};", ""),
    "data": ("", "", "IF g1=1 THEN\ng2:={count};\nENDIF\n{next};{next};", ""),
    "loops": ("", "", "WHILE TRUE DO\n{next};{next};\nENDWHILE", ""),
    "labels": ("", "", "again:\ng2:=1;\n{next};{next};", ""),
}


@pytest.mark.parametrize("fan", FANS)
def test_calls_that_fan_out_take_a_second_and_150_mb(tmp_path, fan):
    data, parameter, body, given = FANS[fan]
    known = "".join(f"VAR num g{number}:=0;\n" for number in range(900))
    parts = ["MODULE M\n", T, P, data, known, f"PROC main()\n{KNOWN}a0{given};\nENDPROC\n"]
    size = sum(map(len, parts))
    count = 0
    while size < 98_000:
        calls = body.replace("{next}", f"a{count + 1}").replace("{count}", str(count))
        parts.append(f"PROC a{count}({parameter})\n{calls}\nENDPROC\n")
        size += len(parts[-1])
        count += 1
    parts.append(f"PROC a{count}({parameter})\nMoveJ p,v100,fine,t;\nENDPROC\nENDMODULE\n")
    (tmp_path / "m.mod").write_text("".join(parts))
    program = """
import resource, sys, time
import irbkin
robot, module = irbkin.Robot("IRB 2600-12/1.65"), irbkin.rapid.load(sys.argv[1])
used = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
began, before = time.process_time(), used()
irbkin.rapid.check(robot, module)
took, grown = time.process_time() - began, used() - before
text = open(sys.argv[1]).read()
began = time.process_time()
for _ in range(20):
    irbkin.rapid.parse(text)
print(took / (time.process_time() - began), grown / 1024)
"""
    command = [sys.executable, "-c", program, str(tmp_path / "m.mod")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    readings, megabytes = map(float, done.stdout.split())
    # In a second a quiet machine reads the text 100 times. Half as much again for other processes.
    assert 20 * readings < 150
    assert megabytes < 150.0


FAR = "[[2900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
GO = f"CONST robtarget pFar:={FAR};\nPROC go(robtarget p)\nMoveJ p,v100,fine,tool0;\nENDPROC\n"
STATION = "PROC station(num n)\ngo pFar;\nENDPROC\n"


def test_a_target_below_calls_is_one_finding_in_every_format(tmp_path):
    main = "MODULE Cell\nPROC main()\nstation 1;\nstation 2;\nENDPROC\nENDMODULE\n"
    (tmp_path / "cell.mod").write_text(main)
    other = tmp_path / "other.mod"
    other.write_text(f"MODULE Other\n{STATION}{GO}ENDMODULE\n")
    calls = [(str(tmp_path / "cell.mod"), line) for line in (3, 4)]

    def written(form):
        given = ("--output-format", form, "--robot", NAME, tmp_path)
        return command.run("check", *given).stdout.decode()

    [found] = json.loads(written("json"))["findings"]
    assert (found["code"], found["file"], found["line"]) == ("R101", str(other), 3)
    assert found["message"].endswith(" (called from Cell:3:1, Cell:4:1)")
    assert [(it["file"], it["line"]) for it in found["related"]] == calls
    [result] = json.loads(written("sarif"))["runs"][0]["results"]
    assert result["message"]["text"] == found["message"]
    assert len(result["relatedLocations"]) == 2
    for form in ("text", "concise", "github"):
        assert written(form).count("R101 go pFar") == 1
    assert written("junit").count("<failure") == 1


@pytest.mark.parametrize(
    ("speed", "zone", "meant"),
    [("v250", "fine", "v200, v300"), ("v75", "fine", "v60, v80"), ("v100", "z25", "z20, z30")],
)
def test_a_speed_or_a_zone_that_nothing_declares_is_between_numbers(tmp_path, speed, zone, meant):
    move = f"MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],{speed},{zone},tool0;"
    [(_, _, message)] = found(tmp_path, f"{move}\nrOpenGripper;")
    assert message.endswith(f"did you mean {meant}?")
