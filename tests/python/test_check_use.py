"""`irbkin check` day by day: what it is given, counts, watching, JUnit, a schema of its options."""

import json
import os
import re
import signal
import subprocess
import time
from collections import Counter
from pathlib import Path
from shutil import copytree
from xml.etree import ElementTree

import command
import irbkin
import numpy as np
import pytest
from irbkin.check.codes import codes
from irbkin.check.findings import Finding
from irbkin.check.report import Report, SourceText, rendered
from irbkin.check.settings import FORMATS, KEYS, schema
from irbkin.errors import IrbkinError
from test_check_manners import NAME, OPTIONS, SEAM, listed, output, run, seam  # noqa: F401

EXAMPLE = Path(__file__).parents[2] / "examples" / "backup"
# junit-10.xsd of Jenkins' xunit-plugin (src/main/resources/org/jenkinsci/plugins/xunit/types):
# attributes that an element must have, that it may have, and its children.
JUNIT = {
    "testsuites": ((), ("name", "tests", "failures", "errors"), ("testsuite",)),
    "testsuite": (("name", "tests", "failures", "errors"), ("skipped",), ("testcase",)),
    "testcase": (("name",), ("classname",), ("skipped", "failure", "system-out")),
    "failure": ((), ("type", "message"), ()),
    "skipped": ((), ("type", "message"), ()),
    "system-out": ((), (), ()),
}


def test_statistics_count_the_findings_of_each_code(seam):  # noqa: F811
    found = Counter(it["code"] for it in listed(output("--json", seam)))
    first, *lines, last = output("--statistics", seam).splitlines()
    assert first == "5 of 6 moves checked, 1 not: 1 by unknown tools."
    assert last == "Found 4 errors, 1 warning (1 fixable with --fix)."
    rows = [re.fullmatch(r" *(\d+)  (\w+)  \[([* ])\] ([\w-]+)", line).groups() for line in lines]
    assert {code: int(count) for count, code, _, _ in rows} == found
    assert [int(row[0]) for row in rows] == sorted(found.values(), reverse=True)
    assert {code for _, code, mark, _ in rows if mark == "*"} == {"C201"}
    record = json.loads(output("--statistics", "--json", seam))
    assert {it["code"]: it["count"] for it in record["statistics"]} == found
    assert "text or concise or json" in command.refused(
        "check", "--robot", NAME, "--statistics", "--output-format", "html", seam
    )


@pytest.mark.parametrize("form", FORMATS)
def test_every_format_has_the_moves_that_are_checked_and_the_reasons(seam, form):  # noqa: F811
    text = output("--output-format", form, seam)
    if form in ("json", "sarif"):
        record = json.loads(text)
        moves = record["moves"] if form == "json" else record["runs"][0]["properties"]["moves"]
        assert moves == {
            "checked": 5,
            "assumed": 0,
            "total": 6,
            "reasons": {"unknown tools": 1},
            "unread": 0,
        }
    else:
        assert "5 of 6 moves checked, 1 not: 1 by unknown tools." in text


def test_junit_is_valid_and_has_each_finding_once(seam):  # noqa: F811
    def checked(text):
        root = ElementTree.fromstring(text.encode())
        assert root.tag == "testsuites"
        for element in root.iter():
            must, may, children = JUNIT[element.tag]
            assert {*must} <= {*element.keys()} <= {*must, *may}
            assert {child.tag for child in element} <= {*children}
        for suite in (root, *root):
            for key, kind in (("tests", "testcase"), ("failures", "failure")):
                assert suite.get(key) == str(len([*suite.iter(kind)]))
        return root

    root = checked(output("--output-format", "junit", "--select", "ALL", seam))
    found = listed(output("--json", "--select", "ALL", seam))
    names = [it.get("name") for it in root.findall(f"testsuite[@name='{seam}']/testcase")]
    assert names == [f"{it['code']} {it['name']}, line {it['line']}" for it in found]
    failed = [it.get("message") for it in root.iter("failure")]
    assert failed == [it["message"] for it in found if it["severity"] != "note"]
    (skipped,) = root.findall("testsuite[@name='moves']/testcase[skipped]")
    assert skipped.get("name") == "1 move not checked by unknown tools"
    odd = Finding("a\udc80<.mod", 1, 1, "E001", "syntax", "error", 'a \x00\x1b "<&> \udcff')
    report = Report(NAME, [odd], {"sound.mod": SourceText("")}, 3)
    suites = {it.get("name"): it for it in checked(rendered(report, "junit"))}
    assert suites["sound.mod"].get("failures") == "0"
    assert suites["a\ufffd<.mod"].find("*/failure").get("message") == 'a \ufffd\ufffd "<&> \ufffd'


def test_the_schema_has_the_options_that_are_read():
    done = run("--schema")
    assert json.loads(done.stdout) == schema()
    keys = schema()["properties"]["check"]["properties"]
    assert list(keys) == list(KEYS)
    assert all(key["description"].endswith(".") for key in keys.values())
    assert keys["output-format"]["enum"] == list(FORMATS)
    assert keys["robot"]["anyOf"][0]["enum"] == list(irbkin.catalog())
    assert set(keys["ignore"]["items"]["anyOf"][0]["enum"]) >= set(codes())


@pytest.mark.extra
def test_the_schema_takes_what_the_reader_takes(tmp_path):
    import jsonschema
    from irbkin.check.settings import options_of

    whole = schema()
    jsonschema.Draft7Validator.check_schema(whole)
    validator = jsonschema.Draft7Validator(whole)
    values = [*("text", 3, 0.5, True, [1, 2], [1, 2, 3], [1] * 6, [1] * 7, [[1, 2, 3]], [[1, 2]])]
    values += [*(["R"], ["C201", "syntax"], [True, 1, 2], [[1, 2, True]], {}, {"*": ["V401"]})]
    values += [*({"*": [1]}, {"*": "V401"}, "json", [])]
    for key in (*KEYS, "robots"):
        for value in values:
            try:
                options_of({key: value}, str(tmp_path))
                is_read = True
            except IrbkinError:
                is_read = False
            assert validator.is_valid({"check": {key: value}}) == is_read, (key, value)
    try:
        import tomllib
    except ImportError:
        import tomli as tomllib
    assert validator.is_valid(tomllib.loads(OPTIONS))
    assert not validator.is_valid({"chek": {}})


def concise(*names):
    done = run("-q", "--output-format", "concise", *names)
    assert done.stderr == b""
    return done.stdout.decode().splitlines()


def test_a_folder_in_a_backup_or_above_it_is_checked_with_its_robots(tmp_path, monkeypatch):
    copytree(EXAMPLE, tmp_path / "cells" / "one")
    monkeypatch.chdir(tmp_path)
    whole = concise("cells/one")
    assert concise("cells") == concise("cells/one/RAPID") == whole
    own = {f"TASK{number}": concise(f"cells/one/RAPID/TASK{number}") for number in (1, 2)}
    for task, lines in own.items():
        assert [it for it in lines if task in it] == [it for it in whole if task in it]
        assert not [it for it in lines if "/TASK" in it and task not in it]
    file = "cells/one/RAPID/TASK2/PROGMOD/Unload.mod"
    assert concise(file) == own["TASK2"]
    assert concise(file, "cells/one/RAPID/TASK1") == whole
    # What is in no backup still needs a robot; one that is given counts.
    (tmp_path / "seam.mod").write_text(SEAM)
    assert "give --robot" in command.refused("check", "cells/one", "seam.mod")
    assert "is in no task of" in command.refused("check", "cells/one/SYSPAR")
    assert run("--robot", NAME, file).stdout != run(file).stdout
    copytree(EXAMPLE, tmp_path / "cells" / "two")
    assert "2 backups, give one: " in command.refused("check", "cells")


def test_a_backup_gets_the_same_answer_from_any_folder(tmp_path, monkeypatch):
    backup = copytree(EXAMPLE, tmp_path / "cells" / "one")
    task = backup / "RAPID" / "TASK1"
    (tmp_path / "beside").mkdir()
    (tmp_path / "link").symlink_to(backup)
    (tmp_path / "task").symlink_to(task)

    def answer(here, *names):
        monkeypatch.chdir(here)
        done = run(*names, "--json", "--select", "ALL")
        assert done.returncode == 1, (names, done.stderr)
        found = json.loads(done.stdout)["findings"]
        return {(os.path.realpath(it["file"]), it["line"], it["code"]) for it in found}

    wanted = answer(tmp_path, str(backup))
    assert len(wanted) > 10
    for here, *names in [
        (tmp_path / "beside", "../cells/one"),
        (tmp_path / "beside", "../cells/one/"),
        (tmp_path / "beside", "../link"),
        (tmp_path, "link"),
        (tmp_path, "beside/../cells/one", "link/RAPID"),
        (tmp_path, "cells/one", str(backup)),
        (task, "../.."),
        (tmp_path, "task/../.."),
    ]:
        assert answer(here, *names) == wanted, (here, names)
    # The task alone; and from a backup what is no part of it is another one.
    alone = answer(tmp_path, "cells/one/RAPID/TASK1")
    for here, name in [
        (tmp_path / "beside", "../cells/one/RAPID/TASK1"),
        (tmp_path, "task"),
        (task, "."),
        (backup / "SYSPAR", "../RAPID/TASK1/"),
    ]:
        assert answer(here, name) == alone, (here, name)
    copytree(backup, tmp_path / "cells" / "two")
    monkeypatch.chdir(backup)
    assert "2 backups, give one" in command.refused("check", "../../cells")
    assert command.run("diff", "../two", "../../link").stdout == b"Nothing differs.\n"
    with pytest.raises(IrbkinError, match="2 backups, give one"):
        irbkin.abb.load_backup("../../cells")


def test_the_robot_may_come_first(seam, tmp_path, monkeypatch):  # noqa: F811
    expected = output(seam)
    for name in (NAME, "irb2600_12/1.65"):
        assert run(name, seam).stdout.decode() == expected
        assert run(name, seam, IRBKIN_ROBOT="IRB 120-3/0.58").stdout.decode() == expected
    assert run(NAME, "--color", "never", seam).stdout.decode() == expected
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(irbkin.Robot(NAME).to_urdf())
    assert run(urdf, seam).stdout.decode().splitlines()[0] == expected.splitlines()[0]
    assert "IRB 2600-12/1.85" in command.refused("check", "IRB 2600", seam)
    assert "no FILE to check" in command.refused("check", NAME)
    assert "no such file" in command.refused("check", "nowhere", seam)
    # A file of that name is a file.
    monkeypatch.chdir(tmp_path)
    Path("UR5").mkdir()
    Path("UR5", "a.mod").write_text(SEAM.replace("Seam", "Other"))
    assert run("--robot", NAME, "UR5").returncode == 1
    assert "give --robot" in command.refused("check", "UR5", seam)


def until(file, count):
    """Wait until a file has so many ends of a check."""
    end = time.monotonic() + 60
    while (text := file.read_text()).count("Ctrl-C ends") < count:
        assert time.monotonic() < end, text
        time.sleep(0.05)
    return text


def watching(log, *given):
    with log.open("wb") as stream:
        # Behind an `&` of a shell SIGINT would be ignored.
        return subprocess.Popen(
            [*command.COMMAND, "check", "--watch", *given],
            stdout=stream,
            stderr=stream,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_what_options_and_cells_name_is_watched(tmp_path):
    (tmp_path / "meshes").mkdir()
    (tmp_path / "programs").mkdir()
    (mesh := tmp_path / "meshes" / "post.npy").write_bytes(b"")
    toml, cell = tmp_path / "irbkin.toml", tmp_path / "own.toml"
    (file := tmp_path / "programs" / "seam.mod").write_text(SEAM)
    process = watching(log := tmp_path / "log", NAME, file)
    try:
        assert "5 of 6 moves checked" in until(log, 1)
        toml.write_text("[check]\ncell = 'own.toml'\n")
        assert "own.toml: No such file" in until(log, 2)
        cell.write_text("[obstacles.post]\npoints = 'meshes/post.npy'\nradius = 0.05\n")
        assert "points: " in until(log, 3)
        np.save(mesh, [[0.9, 0.0, height] for height in np.linspace(0.0, 0.8, 41)])
        assert "K901" in until(log, 4)
        np.save(mesh, [[9.0, 9.0, 9.0]])
        assert "K901" not in until(log, 5).rpartition("moves checked")[2]
        file.rename(away := file.with_name("seam.txt"))
        assert "seam.mod: No such file" in until(log, 6)
        away.rename(file)
        until(log, 7)
    finally:
        process.kill()
        process.wait()


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_the_whole_backup_of_a_file_is_watched(tmp_path):
    copytree(EXAMPLE, backup := tmp_path / "backup")
    process = watching(log := tmp_path / "log", backup / "RAPID" / "TASK1")
    try:
        until(log, 1)
        with (backup / "HOME" / "cell" / "CellData.sys").open("a") as stream:
            # What is written for a while is read when that is over.
            for _ in range(10):
                stream.write("\n")
                stream.flush()
                time.sleep(0.1)
        until(log, 2)
        (backup / "SYSPAR" / "MOC.cfg").unlink()
        until(log, 3)
    finally:
        process.kill()
        process.wait()
    assert log.read_text().count("Ctrl-C ends") == 3


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_a_check_that_watches_is_made_again_for_each_change(tmp_path):
    folder, log = tmp_path / "cell", tmp_path / "log"
    folder.mkdir()
    (folder / "seam.mod").write_text(SEAM)
    given = ["--robot", NAME, "--statistics", "-o", folder / "r.txt", folder]
    process = watching(log, *given)
    try:
        assert until(log, 1).startswith("5 of 6 moves checked")
        (folder / "seam.mod").write_text(SEAM.replace("tGum", "tGun"))
        assert "6 of 6 moves checked" in until(log, 2)
        (folder / "other.mod").write_text(SEAM.replace("Seam", "Other").replace("main", "Next"))
        assert "11 of 12 moves checked" in until(log, 3)
        (folder / "irbkin.toml").write_text("[chek]")
        assert "did you mean check?" in until(log, 4)
        (folder / "irbkin.toml").unlink()
        until(log, 5)
        # Its own report, and nothing, are no change.
        time.sleep(1.0)
        assert log.read_text().count("Ctrl-C ends") == 5
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 130
    finally:
        process.kill()
    assert log.read_text().endswith("irbkin: interrupted\n")
    # Nobody reads it any longer.
    given = [*command.COMMAND, "check", "--watch", "--robot", NAME, folder]
    with subprocess.Popen(given, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        process.stdout.readline()
        process.stdout.close()
        (folder / "seam.mod").write_text(SEAM * 40)
        assert process.wait(30) == 141
    assert "Traceback" not in log.read_text()
    assert "takes files" in command.refused("check", "--robot", NAME, "--watch", "-")
    assert "not allowed with" in command.refused("check", "--watch", "--fix", folder)
    assert "cell.mod: No such file" in command.refused(
        "check", "--robot", NAME, "--watch", "cell.mod"
    )
