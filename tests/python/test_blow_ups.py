"""Inputs of 100 kB that once took minutes or gigabytes: they are bounded, and said to be."""

import itertools
import os
import re
import socket
import time

import command
import pytest
from backups import SMALL, written
from irbkin import Cell, Robot, UnknownRobotError, catalog_entry
from irbkin._cell.entries import parsed
from irbkin.cli.watch import _stamps
from irbkin.errors import InvalidModelError

DEEP = ".".join("a" * 33)


@pytest.mark.parametrize(
    "text",
    [
        f"{'.'.join('a' * 50_000)} = 1",
        f"x = 1\n[{'.'.join('a' * 50_000)}]",
        f"x = {{ {'.'.join('a' * 50_000)} = 1 }}",
        f"{'.'.join([chr(34) + 'a.b' + chr(34)] * 15_000)} = 1",
        " . ".join(["'a'"] * 15_000) + " = 1",
    ],
)
def test_a_key_of_many_parts_is_refused_by_name(tmp_path, text):
    file = tmp_path / "cell.toml"
    file.write_text(text)
    began = time.process_time()
    with pytest.raises(InvalidModelError, match=r"line \d: the key .* parts, at most 32"):
        Cell.load(file)
    # An irbkin.toml is read unasked.
    (tmp_path / "irbkin.toml").write_text(text)
    (tmp_path / "a.mod").write_text("MODULE a\nENDMODULE\n")
    message = command.refused("check", "IRB 2600-12/1.65", tmp_path / "a.mod")
    assert "parts, at most 32" in message
    assert len(message) < 1000
    assert time.process_time() - began < 1.0


def test_dots_in_texts_and_comments_are_no_keys():
    text = f'x = "a\\"{DEEP}"\ny = \'{DEEP}\' # {DEEP}\nz = """\n{DEEP} \\""" "" {DEEP}"""\n'
    assert parsed(text)["y"] == DEEP
    assert parsed(".".join("a" * 32) + "=1")["a"]


LONG = {
    "10 MB": "a" * 10_000_000,
    "series": "IRB 2600-" * 10_000,
    "digits": "9" * 100_000,
    "dashes": "IRB 2600-12/1.65" + "-" * 200,
    "not ASCII": "\u00e4" * 100_000,
}


@pytest.mark.parametrize("name", LONG.values(), ids=LONG)
def test_a_name_longer_than_any_designation_is_refused_at_once(tmp_path, name):
    file = tmp_path / "cell.toml"
    file.write_text(f'[robots.r]\nname = "{name[:100_000]}"\nq = [0, 0, 0, 0, 0, 0]\n')
    began = time.process_time()
    for call in (Robot, catalog_entry):
        with pytest.raises(UnknownRobotError, match=r'^unknown robot "') as refusal:
            call(name)
        assert len(str(refusal.value)) < 200
    with pytest.raises(InvalidModelError, match=r'robots\.r: unknown robot "') as refusal:
        Cell.load(file)
    assert len(str(refusal.value)) < 300
    message = command.refused("fk", name[:100_000], *"000000")
    assert len(message) < 300
    assert time.process_time() - began < 0.5


FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"
DATA = f"CONST robtarget p:=[[9000,0,500],[0,0,1,0],[0,0,0,0],{FAR}];"
MOVE = "MoveL Offs(p,0,0,0),v100,z10,tool0;"


def one_line(file, count, end=""):
    body = (MOVE + end) * count
    file.write_text(f"MODULE a\n{DATA}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n", newline="")


@pytest.mark.parametrize("end", ["", "\r"])
@pytest.mark.parametrize("form", ["text", "concise", "html", "json", "sarif", "github", "junit"])
def test_a_report_grows_with_the_text_although_it_is_one_line(tmp_path, form, end):
    file = tmp_path / "a.mod"
    sizes = []
    for count in (200, 800):
        one_line(file, count, end)
        done = command.run("check", "IRB 2600-12/1.65", file, "--output-format", form)
        assert done.stdout.count(b"R101") >= count
        sizes.append(len(done.stdout))
    assert sizes[1] < 4.5 * sizes[0]


def test_an_excerpt_has_the_statement_below_which_the_caret_is(tmp_path):
    file = tmp_path / "a.mod"
    for end in ("", "\r"):
        one_line(file, 100, end)
        lines = command.run("check", "IRB 2600-12/1.65", file).stdout.decode().split("\n")
        rows = [pair for pair in itertools.pairwise(lines) if "^" in pair[1]]
        assert len(rows) >= 100
        for above, below in rows:
            marked = above[below.index("^") : below.rindex("^") + 1]
            assert marked == MOVE[:-1], (above, below)
            assert len(above) < 220
            assert end == "" or above.count("MoveL") == 1


def test_a_correction_in_a_long_line_shows_its_part(tmp_path):
    target = f"[[900,-300,500],[0,0,1,0],[1,0,1,0],{FAR}]"
    moves = f"MoveJ {target},v100,fine,tool0;" * 100
    file = tmp_path / "a.mod"
    file.write_text(f"MODULE a\nPROC main()\n{moves}\nENDPROC\nENDMODULE\n")
    text = command.run("check", "IRB 2600-12/1.65", file).stdout.decode()
    fixes = [line for line in text.split("\n") if "fix in line 3" in line]
    assert len(fixes) >= 100
    assert all(len(line) < 250 and "[-1,0,-1,0]" in line.replace(" ", "") for line in fixes)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes with names")
def test_pipes_and_sockets_among_files_are_passed_over_by_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    one_line(tmp_path / "a.mod", 1)
    os.mkfifo("pipe.mod")
    os.mkfifo(tmp_path / "list.pgf")
    assert "E002" in command.run("check", "IRB 2600-12/1.65", "list.pgf").stdout.decode()
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket.mod")
        for names in (["."], ["a.mod", "pipe.mod", "socket.mod"]):
            done = command.run("check", "IRB 2600-12/1.65", *names)
            lines = [it for it in done.stdout.decode().split("\n") if "E002" in it]
            assert len(lines) == 2, done.stdout
            assert "pipe.mod:1:1: E002" in lines[0]
            assert "is a pipe, a socket or a device" in lines[0]
            assert "R101" in done.stdout.decode()
    backup = written(tmp_path / "backup", SMALL)
    os.mkfifo(backup / "RAPID" / "TASK1" / "PROGMOD" / "Pipe.mod")
    (backup / "SYSPAR" / "SYS.cfg").unlink()
    os.mkfifo(backup / "SYSPAR" / "SYS.cfg")
    text = command.run("check", backup, "--output-format", "concise").stdout.decode()
    assert len(re.findall(r"(Pipe.mod|SYS.cfg):1:1: B001 is a pipe, a socket", text)) == 2
    (tmp_path / "irbkin.toml").write_text('[check]\nrobot = "IRB 2600-12/1.65"\n')
    os.mkfifo("pipe.urdf")
    assert [*_stamps([str(tmp_path)], "")]
