"""Calls of routines in `irbkin check`: names that are meant, and modules that are missing."""

import json

import command
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
