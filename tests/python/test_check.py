"""`irbkin check` and `rapid.check`: codes, places, corrections, manners of a linter."""

import json
import os
import re
from pathlib import Path

import command
import irbkin
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from irbkin import rapid
from irbkin._core import check_codes, check_program
from irbkin.body import Shape
from irbkin.check.checker import Checker
from irbkin.check.codes import TOOLS, codes, rules, selected
from irbkin.check.fixes import corrected
from irbkin.check.jobs import Job
from irbkin.check.settings import Settings
from irbkin.rapid.program import ModuleFile, program_of

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "docs" / "guide" / "check.md").read_text()
RULES = (ROOT / "python" / "irbkin" / "check" / "rules.md").read_text()
NAME = "IRB 2600-12/1.65"
ROBOT = irbkin.Robot(NAME)
YUMI = irbkin.Robot("IRB 14050")
CODES = [code for code, *_ in check_codes()]
BLOCK = re.compile(r"^```rapid (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCKS = dict(BLOCK.findall(RULES))
SEAM, DATA = (dict(BLOCK.findall(GUIDE))[it] for it in ("seam.mod", "data"))
CELL = irbkin.Cell({"post": Shape.cylinder(0.05, 0.8, irbkin.pose([0.9, 0, 0.4]))})
"""As the rules have it in cell.toml."""
FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def module(moves, data=DATA):
    return f"MODULE M\n{data}PROC main()\n{moves}ENDPROC\nENDMODULE\n"


def run(*arguments, **options):
    return command.run("check", *arguments, **options)


def check(file, *arguments):
    return run("--robot", NAME, *arguments, file)


@pytest.mark.parametrize("code", [code for code in BLOCKS if code != "E001"])
def test_the_example_of_a_code_has_it(code, tmp_path):
    robot = YUMI if code == "C205" else ROBOT
    own = [line for line in BLOCKS[code].splitlines(True) if line.startswith("PERS ")]
    text = module(BLOCKS[code].replace("".join(own), ""), DATA + "".join(own))
    if BLOCKS[code].startswith("FUNC"):
        text = module("", DATA + BLOCKS[code])
    texts = re.findall(r"^MODULE .*ENDMODULE$", BLOCKS[code], re.M) or [text]
    if code in CODES:
        modules = [rapid.parse(it) for it in texts]
        options = {"codes": [code], "cell": CELL, "tasks": [("T_ROB1", modules)]}
        found = check_program(robot, modules, **options).findings
    else:
        (tmp_path / "cell.toml").write_text("[tool.tGun]\nsphere = 0.01\n")
        checker = Checker({"select": [code], "cell": str(tmp_path / "cell.toml")}, Settings())
        _, found = checker.check(Job(robot, program_of([ModuleFile("m.mod", text.encode())]), ""))
    assert code in {it.code for it in found}, found


def test_the_rules_have_every_code_with_its_name_in_order():
    headings = re.findall(r"^### (\w\d+) (.*)$", RULES, re.MULTILINE)
    assert headings == [(it.id, it.name) for it in codes().values()]
    assert list(BLOCKS) == ["E001", *(code for code, *_ in TOOLS), *CODES]


def test_the_page_has_every_group_and_what_is_found_only_if_selected():
    chapter = GUIDE.split("\n## 5. Codes\n")[1]
    groups = re.findall(r"^\| ([A-Z](?:, [A-Z])*) \|", chapter, re.MULTILINE)
    assert ", ".join(groups).split(", ") == list(dict.fromkeys(it[0] for it in codes()))
    sentence = chapter.split("are found only if")[0].split("\n\n")[-1]
    named = re.findall(r"([A-Z]\d+)(?: to [A-Z](\d+))?", sentence)
    own = {f"{a[0]}{it}" for a, b in named for it in range(int(a[1:]), int(b or a[1:]) + 1)}
    assert own == {it.id for it in codes().values() if not it.is_default}


def test_every_rule_has_all_its_parts():
    assert list(rules()) == list(codes())
    for code, rule in rules().items():
        assert rule.name == codes()[code].name
        assert rule.meaning
        assert rule.cure.endswith(".")
        assert 10 < len(rule.title) <= 120, rule.title
        assert "\n" not in rule.title
        if code == "E001" or code in CODES:
            assert [language for language, _ in rule.examples][-1] == "rapid"


def test_a_rule_is_explained_by_its_code_or_its_name():
    done = command.run("rule", "C201")
    assert done.returncode == 0
    assert done.stdout == command.run("rule", "wrong-confdata").stdout
    assert done.stdout == command.run("rule", "c201").stdout
    text = done.stdout.decode()
    assert text.startswith("C201 wrong-confdata (error)\n\nNo solution inside the limits ")
    assert "\n\nCure: `--fix` writes " in text
    assert f"\n\nExample:\n    {BLOCKS['C201']}" in text
    assert "[obstacles.post]" in command.run("rule", "K901").stdout.decode()
    assert "did you mean R10" in command.refused("rule", "R110")
    assert "did you mean C201, C205, C204?" in command.refused("rule", "wrong-confdta")
    assert "did you mean B, C, D, E, K" in command.refused("rule", "apple")


def test_a_code_has_a_severity():
    severities = {code.id: code.severity for code in codes().values()}
    assert {severities[it] for it in severities if it[0] in "RKMN"} == {"error"}
    assert {severities[it] for it in severities if it[0] in "SVZ"} == {"warning"}
    notes = {it for it in severities if severities[it] == "note"}
    assert notes == {"C204", "T303", "T305", *(it for it in severities if it[0] == "U")}
    assert severities["C203"] == severities["D703"] == "warning"
    for it in rapid.check(ROBOT, rapid.parse(SEAM)):
        assert it.severity == severities[it.code]


def test_a_move_that_touches_something_says_when_and_what(tmp_path):
    text = re.search(r"^```toml cell.toml\n(.*?)^```$", RULES, re.MULTILINE | re.DOTALL)[1]
    (tmp_path / "cell.toml").write_text(text)
    assert irbkin.Cell.load(tmp_path / "cell.toml") == CELL
    file = tmp_path / "post.mod"
    file.write_text(module(BLOCKS["K901"]))
    assert "K9" not in check(file).stdout.decode()
    done = check(file, "--cell", tmp_path / "cell.toml", "--select", "K")
    assert done.returncode == 1
    line = next(it for it in done.stdout.decode().splitlines() if "K901" in it)
    assert re.search(
        r"MoveL pFar: link \d touches post after \d+ % of the way, [\d.]+ mm deep", line
    )
    text = module(BLOCKS["K901"])
    (finding,) = rapid.check(ROBOT, rapid.parse(text), cell=CELL, codes=["K901"])
    part = int(re.search(r"after (\d+) %", finding.message)[1])
    assert 0 < part < 50
    bare = ROBOT.with_body(None)
    with pytest.raises(irbkin.InvalidModelError, match="body"):
        rapid.check(bare, rapid.parse(module(BLOCKS["K901"])), cell=CELL)
    missing = check(file, "--cell", tmp_path / "missing.toml")
    assert missing.returncode == 2
    assert b"missing.toml" in missing.stderr


def test_a_broken_text_has_its_line_and_column(tmp_path):
    file = tmp_path / "broken.mod"
    file.write_text(module(BLOCKS["E001"]))
    done = check(file)
    assert done.returncode == 1
    line = module(BLOCKS["E001"]).splitlines().index(BLOCKS["E001"].strip()) + 1
    checked, first, source, caret, _, last = done.stdout.decode().splitlines()
    words = "1 by instructions or calls that are not followed."
    assert checked == f"0 of 1 move checked, 1 not: {words}"
    assert first.startswith(f"{file}:{line}:13: E001 expected ")
    assert source == f"{line} | {BLOCKS['E001'].strip()}"
    assert caret == f"{' ' * len(str(line))} | {' ' * 12}^ error"
    assert last == "Found 1 error."
    assert done.stderr == b""


def test_diagnostics_have_the_place_of_their_move():
    found = rapid.check(ROBOT, rapid.parse(SEAM), codes=["N602", "R101"])
    lines = SEAM.splitlines()
    assert [it.code for it in found] == ["N602", "R101"]
    for it, word in zip(found, ("MoveL Offs", "MoveJ pAway"), strict=True):
        assert lines[it.line - 1][it.column - 1 :].startswith(word)
        assert it.routine == "main"


def test_names_that_are_spelled_alike_are_given():
    texts = {code: BLOCKS[code] for code in ("N601", "N602", "N604", "N605")}
    close = {"N601": "pNear", "N602": "tGun", "N604": "v1000", "N605": "z5"}
    for code, moves in texts.items():
        (found,) = rapid.check(ROBOT, rapid.parse(module(moves)), codes=[code])
        assert "is not declared; did you mean " in found.message
        assert close[code] in found.message.rpartition("did you mean")[2]
    # Never the name itself, which another module has, nor one name twice.
    data = "LOCAL CONST robtarget {}:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9,9,9,9,9,9]];\n"
    others = [data.format(name) for name in ("pAway", "pAways", "pAways")]
    texts = [f"MODULE M{at}\n{it}ENDMODULE\n" for at, it in enumerate(others)]
    texts.append("MODULE M\nPROC main()\nMoveJ paway,v100,fine,tool0;\nENDPROC\nENDMODULE\n")
    found = program_of(ModuleFile(f"{at}.mod", it.encode()) for at, it in enumerate(texts))
    (found,) = found.check(ROBOT, codes=["N601"]).findings
    assert found.message.endswith("did you mean pAways?")


def test_a_fix_changes_confdata_and_nothing_else(tmp_path):
    for encoding, mark in (
        ("utf-8", b""),
        ("utf-8", b"\xef\xbb\xbf"),
        ("utf-16-le", b"\xff\xfe"),
        ("utf-16-be", b"\xfe\xff"),
        ("latin-1", b""),
    ):
        for newline in ("\n", "\r\n"):
            text = SEAM.replace("! copied", "! copied \xe4\xb5 \t ").replace("\n", newline)
            file = tmp_path / "seam.mod"
            file.write_bytes(mark + text.encode(encoding))
            file.chmod(0o640)
            before = check(file, "--select", "C")
            assert before.stdout.count(b"[*]") == 1
            assert b"Found 1 error (1 fixable with --fix)." in before.stdout
            done = check(file, "--select", "C", "--fix")
            last = done.stdout.splitlines()[-1]
            assert last == b"Found 1 error (1 fixed, 0 remaining).", done
            assert done.returncode == 0
            wanted = text.replace(
                "[1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]; ! c", f"[-1,0,-1,0],{FAR}]; ! c"
            )
            assert file.read_bytes() == mark + wanted.encode(encoding)
            assert file.stat().st_mode & 0o777 == 0o640
            assert [it.name for it in tmp_path.iterdir()] == ["seam.mod"]


@settings(max_examples=30, deadline=None)
@given(data=st.data())
def test_a_fixed_module_has_right_confdata_and_differs_in_nothing_else(data):
    seed = data.draw(st.integers(0, 2**32 - 1))
    kinds = data.draw(st.lists(st.sampled_from(["MoveJ", "MoveL"]), min_size=1, max_size=6))
    rng = np.random.default_rng(seed)
    targets, moves = [], []
    for number, kind in enumerate(kinds):
        q = np.radians(rng.uniform([-40, -15, -10, -40, 30, -40], [40, 20, 20, 40, 70, 40]))
        T = ROBOT.fk(q)
        confdata = list(ROBOT.configuration(q))
        if rng.random() < 0.7:
            confdata[rng.integers(3)] += int(rng.choice([-1, 1]))
        else:
            confdata[3] = int(rng.integers(8))
        target = rapid.RobTarget.of(T, confdata)
        targets.append(f"CONST robtarget p{number}:={rapid.dump(target)}; ! {seed}\r\n")
        moves.append(f"{kind} p{number},v50,fine,tool0;\r\n")
    text = module("".join(moves), "".join(targets))
    job = Job(ROBOT, program_of([ModuleFile("unused.mod", text.encode())]), "main")
    assert job.program.findings == ()
    checker = Checker({"select": ["C201", "C202", "C204"]}, Settings())
    _, before = checker.check(job)
    (own,), texts, fixed = corrected(checker, [job], pytest.fail)
    _, left = checker.check(own)
    assert not [it for it in left if it.edits], "each target is its own"
    assert fixed.total() == len(before) - len(left)
    after = own.program.modules[0].source
    assert [new for *_, new in texts] == [after] * (after != text)
    # The branch that cfx names stays.
    pattern = re.compile(r"(\[\[[^]]*\],\[[^]]*\],)\[[-0-9]+,[-0-9]+,[-0-9]+(?=,\d\])")
    assert pattern.sub(r"\1", after) == pattern.sub(r"\1", text)


def test_a_target_that_another_file_moves_to_is_left(tmp_path):
    one, other = tmp_path / "one.mod", tmp_path / "other.mod"
    # With the flange the joints are as confdata says; with the tool of the first file axis 6 is
    # half a turn away.
    confdata = ROBOT.configuration(
        ROBOT.ik_nearest(irbkin.pose([0.9, 0.2, 0.5], wxyz=[0, 0, 1, 0]), np.zeros(6))
    )
    target = f"CONST robtarget p:=[[900,200,500],[0,0,1,0],{list(confdata)},{FAR}];\n"
    tool = "PERS tooldata tSide:=[TRUE,[[0,400,0],[0,0,0,1]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
    one.write_text(module("MoveJ p,v100,fine,tSide;\n", DATA + tool + target))
    text = one.read_text()
    for name, is_left in (("p", True), ("pNear", False)):
        one.write_text(text)
        other.write_text(
            f"MODULE Other\nPROC go()\nMoveJ {name},v100,fine,tool0;\nENDPROC\nENDMODULE\n"
        )
        done = run("--robot", NAME, "--fix", one, other)
        assert (done.returncode == 1) == is_left, done
        assert (one.read_text() == text) == is_left
        assert done.stderr == b""


def test_a_file_with_bytes_that_are_no_text_is_not_written(tmp_path):
    file = tmp_path / "odd.mod"
    text = SEAM.replace("! copied", "! copied ")
    content = b"\xff\xfe" + text.encode("utf-16-le")
    # Half of a character, in a comment.
    content = content.replace(
        "copied ".encode("utf-16-le"), "copied".encode("utf-16-le") + b"\x00\xd8"
    )
    file.write_bytes(content)
    done = check(file, "--fix")
    assert done.returncode == 2
    assert b"cannot be written back as it is" in done.stderr
    assert file.read_bytes() == content


def test_a_code_that_does_not_exist_is_refused():
    for words in (["C999"], "C201"):
        with pytest.raises(irbkin.RapidError, match="is no code; there are R101"):
            rapid.check(ROBOT, rapid.parse(SEAM), codes=words)


def test_files_are_one_program(tmp_path):
    tools, program = tmp_path / "tools.sys", tmp_path / "program.mod"
    tools.write_text(f"MODULE Tools(SYSMODULE)\n{DATA.splitlines()[0]}\nENDMODULE\n")
    program.write_text(module("MoveJ pNear,v100,fine,tGun;\n", DATA.partition("\n")[2]))
    assert check(program).returncode == 1
    done = run("--robot", NAME, program, tools)
    passed = b"1 of 1 move checked.\nAll checks passed!\n"
    assert (done.returncode, done.stdout) == (0, passed)
    (tmp_path / "notes.txt").write_text("no module")
    # A file that is given twice is one module.
    listed = tmp_path / "all.pgf"
    listed.write_text("<Module>program.mod</Module><Module>tools.sys</Module>")
    for names in ((program, tools, program), (listed, tools), (tmp_path, program, listed)):
        assert run("--robot", NAME, *names).stdout == passed
    listed.unlink()
    program.rename(tmp_path / "PROGRAM.MOD")
    done = check(tmp_path)
    assert (done.returncode, done.stdout) == (0, passed)


def test_codes_are_selected_and_ignored(tmp_path):
    default = {it for it, _, _, is_default in check_codes() if is_default}
    tools = {code for code, *_ in TOOLS}
    files = {"E001", "E002", "E003", "B001"}
    assert selected(None, []) == {*files, *tools, *default}
    assert {code for code in CODES if code not in default} == {
        "Z501",
        "U801",
        "U802",
        "U803",
        "U807",
    }
    assert selected(["ALL"], []) == {*files, *tools, *CODES}
    unknown = rapid.parse("PROC main() MoveJ *,v100,fine,tool0; ENDPROC")
    assert {it.code for it in rapid.check(ROBOT, unknown)} == {"U801"}
    assert rapid.check(ROBOT, unknown, codes=default) == ()
    assert selected(["c2", " R101"], ["C202", "C204", "C205"]) == {*files, "C201", "C203", "R101"}
    assert selected(["wrong-confdata"], []) == {*files, "C201"}
    assert selected(["E"], []) == files
    assert selected(["C201"], ["E", "B"]) == {"C201"}
    strict = selected(["C201"], [], is_strict=True)
    assert strict == {*files, "C201", "U801", "U802", "U804"}
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    done = check(file, "--select", "X1")
    assert done.returncode == 2
    assert done.stderr.startswith(b"irbkin: unknown code 'X1': did you mean ")
    for nothing in (["--select", ""], ["--select", ","], ["--select", "C2", "--ignore", "C"]):
        done = check(file, *nothing)
        assert (done.returncode, done.stdout) == (2, b"")
        assert b"leave no code to check" in done.stderr
    listed = command.run("rule").stdout.decode()
    assert [line.split()[0] for line in listed.splitlines()] == [*codes()]


def test_comments_silence(tmp_path):
    file = tmp_path / "seam.mod"
    for comment, is_silent in (
        ("! noqa", True),
        ("! NOQA: N602", True),
        ("! noqa:R, N6", True),
        ("! noqa: N601", False),
        ("", False),
    ):
        right = "MoveJ pNear,v100,fine,tGun;\n"
        file.write_text(module(f"{right}MoveJ pNear,v100,fine,tGum; {comment}\n"))
        assert check(file).returncode == (0 if is_silent else 1), comment


def test_what_is_not_checked_is_counted(tmp_path):
    file = tmp_path / "taught.mod"
    taught = "MoveJ *,v100,fine,tGun;\nMoveJ pNear,v100,fine,tGun;\n"
    file.write_text(module(taught))
    done = check(file)
    assert done.returncode == 0
    assert done.stdout == (
        b"1 of 2 moves checked, 1 not: 1 by unknown values.\nNo findings in the 1 move checked.\n"
    )
    noted = check(file, "--select", "U801,U803")
    assert noted.returncode == 0
    assert b": U801 MoveJ *: " in noted.stdout
    assert noted.stdout.endswith(b"Found 2 notes.\n")
    strict = check(file, "--strict")
    assert strict.returncode == 1
    assert b"^ error" in strict.stdout
    assert strict.stdout.endswith(b"Found 1 error.\n")
    for silenced in (["--strict", "--ignore", "U801"], ["--no-strict"]):
        assert check(file, *silenced).returncode == 0
    # A comment silences the finding; the move is not checked all the same.
    file.write_text(module(taught.replace(";", "; ! noqa", 1)))
    assert check(file, "--strict").stdout == done.stdout
    search = '%"weld"+sSide%;\nrGo;\n'
    file.write_text(module(f"{taught}{BLOCKS['N602']}{search}"))
    first = check(file).stdout.decode().splitlines()[0]
    assert first == (
        "1 of 4 moves checked, 3 not: 1 by unknown values, 1 by unknown tools, "
        "1 by instructions or calls that are not followed."
    )
    file.write_text(module(""))
    assert check(file).stdout == b"0 of 0 moves checked.\nNo findings in the 0 moves checked.\n"


def test_the_robot_comes_from_the_environment_and_must_be_given(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    assert run(file, IRBKIN_ROBOT=NAME).returncode == 1
    done = run(file, IRBKIN_ROBOT="")
    assert done.returncode == 2
    assert b"--robot" in done.stderr
    done = run("--robot", "IRB 2600", file)
    assert done.returncode == 2
    assert NAME.encode() in done.stderr
    done = run("--robot", "UR5e", file)
    assert done.returncode == 2
    assert done.stderr.count(b"\n") == 1


def test_an_arm_without_speeds_says_so(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(module(BLOCKS["V401"]))
    done = run("--robot", "IRB 2600-12/1.85", file)
    assert done.returncode == 0
    assert b"V401 is not checked" in done.stderr
    done = run("--robot", "IRB 2600-12/1.85", "--ignore", "V", file)
    assert done.stderr == b""


def test_stdin_is_checked_and_not_fixed():
    done = run("--robot", NAME, "-", stdin=SEAM.encode())
    assert b"\n<stdin>:10:9: V401 " in done.stdout
    done = run("--robot", NAME, "--fix", "-", stdin=SEAM.encode())
    assert done.returncode == 2
    assert done.stderr.count(b"\n") == 1


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_a_read_only_folder_is_left_as_it_is(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    tmp_path.chmod(0o555)
    try:
        done = check(file, "--fix")
    finally:
        tmp_path.chmod(0o755)
    assert done.returncode == 2
    assert b"seam.mod: cannot be written" in done.stderr
    assert file.read_text() == SEAM


def test_what_is_no_file_is_one_line(tmp_path):
    (tmp_path / "empty").mkdir()
    for name, words in (("nowhere.mod", b"No such file"), ("empty", b"has no RAPID modules")):
        done = check(tmp_path / name)
        assert words in done.stderr
        assert done.returncode == 2
        assert done.stderr.startswith(b"irbkin: ")
        assert done.stderr.count(b"\n") == 1


def test_a_routine_has_the_findings_of_its_motion():
    before = "MoveJ pNear,v100,fine,tGun;\n"
    codes = set(CODES) - {"Z501", "Z502", "C203", "U803", "U806", "U807", "R107", "R108", "D703"}
    examples = [f"{before}{BLOCKS[code]}" for code in BLOCKS if code[0] in "SRV"]
    for text in (
        SEAM.replace("tGum", "tGun"),
        (ROOT / "examples" / "pick_and_place.mod").read_text(),
        *map(module, examples),
    ):
        program = rapid.parse(text)
        motion = rapid.motion(ROBOT, program)
        found = rapid.check(ROBOT, program, codes=codes)
        # Of a target that is not met, a check says nothing of the way to it.
        unmet = {(it.line, it.column) for it in found if it.code in ("R101", "R102")}
        # What a controller refuses when it loads a program.
        found = [it for it in found if it.code not in ("N608", "N610", "D705", "D706", "U805")]
        on_way = [it for it in motion.findings if it.code in ("R103", "R104")]
        own, others = (
            sorted((it.line, it.column, it.code, it.joint or 0, it.value or 0.0) for it in findings)
            for findings in (
                found,
                [
                    it
                    for it in motion.findings
                    if it not in on_way or (it.line, it.column) not in unmet
                ],
            )
        )
        assert own == others


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_no_text_breaks_the_check(data):
    words = re.findall(r"\w+|[^\w\s]", SEAM)
    words += ["IF", "THEN", "ENDIF", "GOTO", "ERROR", "FOR", "-9E9"]
    count = data.draw(st.integers(1, 6))
    parts = re.findall(r"\w+|\s+|[^\w\s]", SEAM)
    for _ in range(count):
        place = data.draw(st.integers(0, len(parts) - 1))
        parts[place] = data.draw(st.sampled_from(words))
    try:
        program = rapid.parse("".join(parts))
    except irbkin.RapidError:
        return
    source = program.source.encode()
    for it in rapid.check(ROBOT, program):
        assert 1 <= it.line <= program.source.count("\n") + 1
        assert it.column >= 1
        assert "\n" not in it.message
        for own, begin, end, text in it.edits:
            assert own == 0
            confdata = rb"[-+]?\s*[\d.]+(?:[eE]\d+)?|\[[^]]*\]|\w+"
            assert re.fullmatch(confdata, source[begin:end])
            assert text


def test_what_nothing_names_is_unused():
    text = """MODULE M
    CONST robtarget pUsed:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pOld:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST num nOld:=1; ! pOld, rOld
    PERS tooldata tOld:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    PROC main() rPart1; %"rPart2"%; TPWrite "no ! comment"; rLocal; ENDPROC
    PROC rPart1() MoveJ PUSED,v100,fine,tool0; ENDPROC
    PROC rPart2() ENDPROC
    PROC rLocal() VAR jointtarget jOld; ENDPROC
    PROC rOld() ENDPROC
    FUNC num fOld() RETURN 1; ENDFUNC
    ENDMODULE"""
    found = rapid.check(ROBOT, rapid.parse(text), codes=["U807"])
    words = [(it.line, it.message.partition(":")[0]) for it in found]
    assert words == [
        (3, "robtarget pOld"), (5, "tooldata tOld"), (9, "jointtarget jOld"), (10, "PROC rOld"),
        (11, "FUNC fOld"),
    ]  # fmt: skip
    other = rapid.parse(
        "MODULE Other\nPROC rGo() MoveJ pOld,v100,fine,tOld; rOld; ENDPROC\nENDMODULE"
    )
    both = check_program(ROBOT, [rapid.parse(text, [other]), other], codes=["U807"]).findings
    assert {it.message.partition(":")[0] for it in both} == {
        "jointtarget jOld", "FUNC fOld", "PROC rGo"
    }  # fmt: skip


def test_the_verdict_has_the_nearest_limit_and_singularity_of_each_routine(tmp_path):
    moves = "MoveJ pNear,v1000,fine,tGun;\nMoveL pFar,v200,fine,tGun;\nMoveJ pOut,v5,fine,tNone;\n"
    file = tmp_path / "two.mod"
    file.write_text(module(moves, DATA) + "")
    checked = check_program(ROBOT, [rapid.parse(file.read_text())]).moves
    q = np.array([it.q for it in checked if it.q is not None])
    assert len(checked) == 3
    assert len(q) == 2
    lower, upper = ROBOT.limits.T
    rooms = np.degrees(np.minimum(q - lower, upper - q))
    at = ROBOT.singularity(q)
    angles = np.degrees([at.wrist, at.elbow])
    lines = check(file, "--verdict").stdout.decode().splitlines()
    begin = lines.index(f"{file} ({NAME})")
    assert lines[begin + 1].split() == (
        [
            "routine",
            "moves",
            "assumed",
            "not",
            "checked",
            "errors",
            "warnings",
            "nearest",
            "limit",
            "nearest",
            "singularity",
        ]
    )
    words = lines[begin + 2]
    joint = rooms.min(axis=0).argmin() + 1
    kind = ("wrist", "elbow")[angles.min(axis=1).argmin()]
    assert re.match(rf"main +3 +1 +\d+ .*J{joint} {rooms.min():.1f} deg, line \d+", words), words
    assert re.search(rf"{kind} {angles.min():.1f} deg, line \d+$", words), words


CALLS = """MODULE M
VAR num nStack{10};
VAR num nOff;
%s
PROC main()
    %s
ENDPROC
PROC Pick(robtarget p,num z)
    MoveJ Offs(p,0,0,50),v1000,z10,tGun;
    MoveL Offs(p,0,0,z),v200,fine,tGun;
    MoveL Offs(p,0,0,50),v1000,fine,tGun;
ENDPROC
%s
ENDMODULE
"""
TWICE = "PROC Twice(robtarget p,num z)\nPick p,10;\nPick p,z;\nENDPROC"


@pytest.mark.parametrize(
    ("calls", "checked", "unchecked"),
    [
        ("Pick pNear,nStack{3};", 2, 1),
        ("nOff:=GInput(giZ);\nPick pNear,nOff;", 2, 1),
        ("WHILE TRUE DO\nnOff:=nOff+GInput(giZ);\nPick pNear,nOff;\nENDWHILE", 2, 1),
        ("Twice pNear,nStack{3};", 5, 1),
        ("Pick pNear,10;\nPick pNear,20;", 6, 0),
        ("FOR i FROM 1 TO 3 DO\nPick pNear,10*i;\nENDFOR", 3, 0),
        ("FOR i FROM 1 TO 3 DO\nPick pNear,nStack{i};\nENDFOR", 2, 1),
    ],
)
def test_moves_below_a_call_are_counted_each(tmp_path, calls, checked, unchecked):
    file = tmp_path / "calls.mod"
    file.write_text(CALLS % (DATA, calls, TWICE if "Twice" in calls else ""))
    first, *_, last = check(file).stdout.decode().splitlines()
    assert first.startswith(f"{checked} of {checked + unchecked} moves checked")
    assert (last == "All checks passed!") == (unchecked == 0)
    assert check(file, "--strict").returncode == min(unchecked, 1)
    [ran] = json.loads(check(file, "--output-format", "sarif").stdout)["runs"]
    moves = ran["properties"]["moves"]
    assert (moves["checked"], sum(moves["reasons"].values())) == (checked, unchecked)
    listed = json.loads(check(file, "--strict", "--output-format", "json").stdout)["findings"]
    assert ("U801" in {it["code"] for it in listed}) == (unchecked > 0)
    page = check(file, "--output-format", "html").stdout.decode()
    assert first in page
    assert ("All checks passed!" in page) == (unchecked == 0)


def test_the_subject_of_a_finding_is_its_whole_instruction():
    """Also where the instruction has a colon: nothing is read out of the words of a finding."""
    program = rapid.parse(module('%"weld: "+sSide%;\nMoveJ fFar("a: b"),v100,fine,tGun;\n'))
    found = check_program(ROBOT, [program])
    assert [it.target for it in found.moves] == ['%"weld: "+sSide%', 'fFar("a: b")']
    assert found.findings[0].message.startswith('%"weld: "+sSide%: ')


TURNS = """MODULE M
PERS tooldata tG:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
CONST robtarget pT:=[[%s],[%s],%s,[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC main()
MoveAbsJ [%s,[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tG;
MoveJ pT,v500,fine,tG;
ENDPROC
ENDMODULE
"""


def test_a_correction_is_the_configuration_nearest_to_the_written_one(tmp_path):
    rng, tool = np.random.default_rng(5), irbkin.pose([0, 0, 0.18])
    low, high = np.degrees(ROBOT.limits).T
    corrected = 0
    for number in range(60):
        # The axis of a taught target, a little over a quarter now.
        q = rng.uniform(low, high)
        axis = rng.choice([0, 3, 5])
        edge = 90 * np.ceil(rng.uniform(low[axis], high[axis]) / 90)
        q[axis] = edge + rng.uniform(91, 130)
        if not low[axis] < edge < q[axis] < high[axis]:
            continue
        own = ROBOT.configuration(np.radians(q))
        written = list(own)
        written[[0, 3, 5].index(axis)] -= 2
        T = ROBOT.with_tool(tool).fk(np.radians(q))
        xyz, wxyz = irbkin.to_xyz_wxyz(T)
        start = rng.uniform(low, high).round(3).tolist()
        words = [",".join(map(repr, values.tolist())) for values in (xyz * 1e3, wxyz)]
        source = TURNS % (*words, written, start)
        found = rapid.check(ROBOT, rapid.parse(source))
        [finding] = [it for it in found if it.code == "C201"] or [None]
        if finding is None:
            # Another posture has what is written.
            continue
        assert f"that of the nearest is {list(own)}" in finding.message
        file = tmp_path / f"{number}.mod"
        file.write_text(source)
        assert check(file, "--fix").returncode in (0, 1)
        text = file.read_text()
        assert str(list(own)).replace(" ", "") in text.replace(" ", "")
        assert not [it for it in rapid.check(ROBOT, rapid.parse(text)) if it.code == "C201"]
        corrected += 1
    assert corrected >= 10
    # On a branch without a solution inside the limits: nothing is offered.
    pose = irbkin.pose([0.9, 0, 0.6], wxyz=[0, 0, 1, 0])
    inside = {it.slot for it in ROBOT.with_tool(tool).ik(pose).within_limits()}
    cfx = min(set(range(8)) - inside)
    source = TURNS % ("900,0,600", "0,0,1,0", [0, 0, 0, cfx], [0] * 6)
    [finding] = [it for it in rapid.check(ROBOT, rapid.parse(source)) if it.code == "C201"]
    assert finding.edits == ()
