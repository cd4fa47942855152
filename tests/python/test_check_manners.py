"""`irbkin check`: formats, colors, differences, options of files, hooks of other tools."""

import json
import re
import subprocess
from collections import Counter
from pathlib import Path
from shutil import make_archive

import command
import irbkin
import pytest
from backups import SMALL, written
from hypothesis import given
from hypothesis import strategies as st
from irbkin import rapid
from irbkin._core import check_program
from irbkin.check.codes import codes, rules
from irbkin.check.findings import Finding
from irbkin.check.report import Report, SourceText, rendered
from irbkin.check.report.github import render as github
from irbkin.check.settings import FORMATS, KEYS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "guide" / "check.md").read_text()
NAME = "IRB 2600-12/1.65"
SEAM = re.search(r"^```rapid seam.mod\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)[1]
OPTIONS = re.search(r"^```toml irbkin.toml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)[1]
TASKS = re.search(r"^```json\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)[1]


def run(*arguments, **options):
    environment = {"NO_COLOR": "", "FORCE_COLOR": "", "IRBKIN_ROBOT": ""}
    return command.run("check", *arguments, **{**environment, **options})


def output(*arguments, **options):
    done = run("--robot", NAME, *arguments, **options)
    assert done.stderr == b"", done.stderr
    return done.stdout.decode()


def listed(text):
    """The findings of a report as JSON."""
    return json.loads(text)["findings"]


@pytest.fixture
def seam(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    return file


def test_each_finding_has_its_line_with_a_caret(seam):
    concise = output("--output-format", "concise", seam).splitlines()
    checked, *lines, last = output(seam).splitlines()
    assert [checked, last] == [concise[0], concise[-1]]
    assert [it for it in lines if it.startswith(str(seam))] == concise[1:-1]
    source = SEAM.splitlines()
    for at, heading in enumerate(lines):
        if heading.startswith(str(seam)):
            line, column = map(int, heading.removeprefix(str(seam)).split(":")[1:3])
            assert lines[at + 1] == f"{line} | {source[line - 1]}"
            caret = lines[at + 2].removeprefix("   | ")
            statement = source[line - 1].strip().rstrip(";")
            assert caret.startswith(f"{' ' * (column - 1)}{'^' * len(statement)} ")
    (fix,) = [it for it in lines if "= fix" in it]
    assert fix.startswith(
        "   = fix in line 5: CONST robtarget pCopy:=[[900,-200,500],[0,0,1,0],[-1,0,"
    )
    assert output("-q", "--output-format", "concise", seam).splitlines() == concise[1:-1]


def test_a_caret_is_below_its_statement_behind_tabs_and_odd_characters():
    found = Finding("a.mod", 1, 4, "R101", "out-of-reach", "error", "words")
    text = rendered(report([found], "\t\u00e4\x1bMoveJ p,v1; MoveJ q;"), "text")
    _, _, source, caret, _, _ = text.split("\n")[:6]
    assert source == "1 | \t\u00e4\ufffdMoveJ p,v1; MoveJ q;"
    assert caret == "  | \t  ^^^^^^^^^^ error"
    missing = rendered(report([found._replace(line=9)], ""), "text")
    assert "^" not in missing


def report(found, text, **fields):
    return Report(NAME, found, {"a.mod": SourceText(text)}, 1, **fields)


@given(st.text("a\u00e4\u20ac\r\n", max_size=30), st.data())
def test_places_of_bytes_are_lines_and_columns_in_characters(text, data):
    index = data.draw(st.integers(0, len(text)))
    own = SourceText(text)
    before = text[:index]
    wanted = (before.count("\n") + 1, len(before) - before.rfind("\n"))
    assert own.position(len(before.encode())) == wanted
    assert own.line(0) == own.line(text.count("\n") + 2) == ""
    end = index + len(text[index:].split("\n")[0])
    edit = (len(before.encode()), len(text[:end].encode()), "new")
    # What is shown begins behind a carriage return.
    shown = f"{before}new".split("\n")[-1].split("\r")[-1]
    assert own.corrected((edit,)) == {wanted[0]: shown.strip()}


def test_colors_are_for_terminals_and_as_chosen(seam):
    plain = output(seam)
    assert "\x1b" not in plain
    colored = output("--color", "always", seam)
    assert re.sub(r"\x1b\[[\d;]*m", "", colored) == plain
    assert "\x1b[1;31mR101\x1b[0m" in colored
    assert "\x1b[1;33mV401\x1b[0m" in colored
    assert output(seam, FORCE_COLOR="1") == colored
    for environment in ({"FORCE_COLOR": "0"}, {"FORCE_COLOR": "1", "NO_COLOR": "1"}):
        assert output(seam, **environment) == plain
    assert output("--color", "always", seam, NO_COLOR="1") == colored
    assert output("--color", "never", seam, FORCE_COLOR="1") == plain
    assert "\x1b[32m+" in run("--robot", NAME, "--diff", "--color", "always", seam).stdout.decode()


def test_json_has_the_findings(seam):
    found = listed(output("--json", seam))
    assert listed(output("--output-format", "json", seam)) == found
    plain = output("-q", "--output-format", "concise", seam).splitlines()
    assert len(found) == len(plain) > 3
    for it, line in zip(found, plain, strict=True):
        mark = "[*] " if it["fixable"] else ""
        place = f"{it['file']}:{it['line']}:{it['column']}"
        assert line == f"{place}: {it['code']} {mark}{it['message']}"
        assert it["severity"] == codes()[it["code"]].severity
        assert it["routine"] == "main"
    (fixable,) = [it for it in found if it["fixable"]]
    line = SEAM.splitlines()[4]
    for edit in fixable["edits"]:
        (row, begin), (last, end) = edit["begin"], edit["end"]
        assert row == last == 5
        assert (line[begin - 1 : end - 1], edit["text"]) == ("1", "-1")
    fast = next(it for it in found if it["code"] == "V401")
    assert (fast["joint"], round(fast["value"], 2), round(fast["bound"], 2)) == (1, 7.78, 3.05)
    nothing = run("--robot", NAME, "--json", "--select", "D", seam)
    assert (nothing.returncode, listed(nothing.stdout)) == (0, [])


def test_github_gets_a_command_for_each_finding(seam):
    *lines, last = output("--output-format", "github", seam).splitlines()
    assert last == "::notice title=irbkin::5 of 6 moves checked, 1 not: 1 by unknown tools."
    assert output("-q", "--output-format", "github", seam).splitlines() == lines
    pattern = r"::(error|warning|notice) title=irbkin (\w+) ([\w-]+),file=(.*),line=(\d+),col=(\d+)"
    found = [re.match(pattern, line).groups() for line in lines]
    assert [(it[0], it[1]) for it in found][:2] == [("warning", "V401"), ("error", "R103")]
    assert {it[3] for it in found} == {str(seam)}
    odd = Finding("a,b:c%.mod", 3, 5, "U801", "unknown-value", "note", "100 %\r\n::error::x")
    assert github(report([odd], "")) == (
        "::notice title=irbkin U801 unknown-value,file=a%2Cb%3Ac%25.mod,line=3,col=1,endLine=3,"
        "endColumn=2::a,b:c%25.mod:3:5: U801 100 %25%0D%0A::error::x\n"
        "::notice title=irbkin::1 of 1 move checked.\n"
    )


@pytest.mark.extra
def test_sarif_is_valid_and_has_rules_places_and_fixes(seam):
    import jsonschema

    schema = json.loads((ROOT / "tests" / "data" / "sarif-2.1.0.json").read_text())
    validator = jsonschema.validators.validator_for(schema)(schema)
    log = json.loads(output("--output-format", "sarif", "--select", "ALL", seam))
    assert list(validator.iter_errors(log)) == []
    (run_,) = log["runs"]
    known = run_["tool"]["driver"]["rules"]
    assert [it["id"] for it in known] == list(rules())
    found = listed(output("--json", "--select", "ALL", seam))
    lines = SEAM.splitlines()
    for result, it in zip(run_["results"], found, strict=True):
        assert known[result["ruleIndex"]]["id"] == result["ruleId"] == it["code"]
        assert (result["level"], result["message"]["text"]) == (it["severity"], it["message"])
        (location,) = result["locations"]
        assert location["physicalLocation"]["artifactLocation"]["uri"] == seam.as_uri()
        region = location["physicalLocation"]["region"]
        assert region["startLine"] == it["line"]
        part = lines[it["line"] - 1][region["startColumn"] - 1 : region["endColumn"] - 1]
        assert part == lines[it["line"] - 1].strip().rstrip(";")
        assert ("fixes" in result) == it["fixable"]
    (fix,) = next(it["fixes"] for it in run_["results"] if "fixes" in it)
    (change,) = fix["artifactChanges"]
    line = lines[4]
    for replacement in reversed(change["replacements"]):
        region = replacement["deletedRegion"]
        assert region["startLine"] == 5
        begin, end = region["startColumn"] - 1, region["endColumn"] - 1
        line = line[:begin] + replacement["insertedContent"]["text"] + line[end:]
    assert "[-1,0,-1,0]" in line
    odd = Finding("a b.mod", 3, 5, "U801", "unknown-value", "note", "it")
    broken = json.loads(rendered(report([odd, odd._replace(line=0, column=0)], ""), "sarif"))
    assert list(validator.iter_errors(broken)) == []
    uri = broken["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]
    assert uri == {"uri": "a%20b.mod"}


def shown_program(page):
    """What a page has of a program."""
    return json.loads(page.split("const PROGRAM = ")[1].split(";\n")[0])


def test_html_is_the_page_with_the_program_and_every_finding(seam):
    page = output("--output-format", "html", "--select", "ALL", seam)
    found = listed(output("--json", "--select", "ALL", seam))
    program = shown_program(page)
    keys = ("code", "name", "severity", "line", "column", "message")
    shown = [[it[key] for key in keys] for it in program["findings"]]
    assert shown == [[it[key] for key in keys] for it in found]
    fixable = [bool(it["edits"]) for it in program["findings"]]
    assert fixable == [it["fixable"] for it in found]
    (module,) = program["modules"]
    assert module["text"] == SEAM
    checked = check_program(irbkin.Robot(NAME), [rapid.parse(SEAM)])
    assert [it["line"] for it in program["moves"]] == [it.line for it in checked.moves]
    assert [it["q"] is None for it in program["moves"]] == [it.q is None for it in checked.moves]
    motion = program["motion"]["ok"]
    made = rapid.motion(irbkin.Robot(NAME), rapid.parse(SEAM))
    assert motion["duration"] == pytest.approx(made.duration)
    assert [it["line"] for it in motion["moves"]] == [it.line for it in made.moves]
    assert not re.search(r"https?://", page)


def test_a_page_has_files_that_were_not_read_and_no_text_that_ends_its_script(tmp_path):
    words = "</script><b>"
    file = tmp_path / "odd.mod"
    file.write_text(f"MODULE odd\n! {words}\nPROC one()\nMoveJ {words};\nENDPROC\nENDMODULE\n")
    broken = tmp_path / "broken.sys"
    broken.write_bytes(b"\x00\x01\x02")
    done = run("--robot", NAME, "--output-format", "html", file, broken)
    page = done.stdout.decode()
    assert page.count("</script>") == 1
    program = shown_program(page)
    assert [it["name"] for it in program["modules"]] == [str(file), str(broken)]
    assert {it["module"] for it in program["findings"]} == {0, 1}
    assert "error" in program["motion"]


def test_a_page_shows_the_obstacles_and_one_program_alone(seam, tmp_path):
    cell = tmp_path / "cell.toml"
    cell.write_text("[obstacles.post]\nsphere = 0.1\npose = {xyz = [3, 0, 0]}\n")
    page = output("--cell", cell, "--output-format", "html", seam)
    own = irbkin.scene.Scene.from_json(page.split("const SCENE = ")[1].split(";\n")[0])
    assert [it.name for it in own.obstacles] == ["post"]
    backup = ROOT / "examples" / "backup"
    words = command.refused("check", "-o", tmp_path / "report.html", backup)
    assert "a page shows one program, give the files of one of: T_ROB1" in words
    assert not (tmp_path / "report.html").exists()


def test_a_report_goes_to_a_file_in_the_format_of_its_ending(seam, tmp_path):
    for ending, begin in (
        (".json", "{"),
        (".xml", "<?xml"),
        (".sarif", "{"),
        (".html", "<!DOCTYPE"),
        (".txt", "5 of"),
    ):
        target = tmp_path / f"report{ending}"
        text = output("-o", target, seam)
        assert text.splitlines()[0] == "5 of 6 moves checked, 1 not: 1 by unknown tools."
        assert text.count("\n") == 2
        assert target.read_text().startswith(begin)
    assert output("-q", "-o", target, "--output-format", "json", seam) == ""
    json.loads(target.read_text())
    assert "must end in .json" in command.refused("check", "-o", "report.yaml", seam)


def test_the_last_line_is_right_about_what_was_checked():
    def last(found=(), fixed=(), checked=4, assumed=0, reasons=None, unread=0):
        words = [Finding("a", 1, 1, "C201", "", it, "") for it in found]
        counts = (checked, assumed, reasons or {}, unread)
        return Report("", words, {}, *counts, Counter(fixed)).conclusion

    assert last() == "All checks passed!"
    assert last(assumed=2) == "No findings in the 6 moves checked."
    for fields in ({"reasons": {"calls": 1}}, {"unread": 1}):
        assert last(**fields) == "No findings in the 4 moves checked."
    assert last(["error", "note", "error"]) == "Found 2 errors, 1 note."
    assert last(["warning"], ["error"]) == "Found 1 error, 1 warning (1 fixed, 1 remaining)."


def test_a_difference_is_what_a_fix_writes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for text in (SEAM, SEAM.replace("\n", "\r\n"), SEAM.rstrip("\n").replace("MODULE Seam\n", "")):
        # Declarations without a module may end without the end of a line.
        text = text if "MODULE Seam" in text else text.removesuffix("\nENDMODULE")
        Path("seam.mod").write_text(text, newline="")
        done = run("--robot", NAME, "--diff", "seam.mod")
        assert done.returncode == 1
        assert done.stderr == b"irbkin: --fix would remove 1 finding\n"
        assert Path("seam.mod").read_bytes() == text.encode()
        Path("fixed.mod").write_bytes(text.encode())
        patch = done.stdout
        subprocess.run(["patch", "--binary", "-s", "fixed.mod"], input=patch, check=True)
        run("--robot", NAME, "--fix", "seam.mod")
        assert Path("seam.mod").read_bytes() == Path("fixed.mod").read_bytes() != text.encode()
        after = run("--robot", NAME, "--diff", "seam.mod")
        assert (after.returncode, after.stdout, after.stderr) == (0, b"", b"")
    assert "not allowed with" in command.refused("check", "--fix", "--diff", "seam.mod")


def test_a_fix_in_a_backup_names_the_hash_that_no_longer_agrees(tmp_path):
    folder = tmp_path / "RAPID" / "TASK1" / "PROGMOD"
    folder.mkdir(parents=True)
    (tmp_path / "BACKINFO").mkdir()
    hashes = tmp_path / "BACKINFO" / "checksum.txt"
    for line, is_named in (
        ("/RAPID/TASK1/PROGMOD/seam.mod", True),
        (r"\rapid\task1\progmod\Seam.mod", True),
        ("/RAPID/TASK2/PROGMOD/seam.mod", False),
    ):
        hashes.write_text(f"ver:1\n{line}\n5qgBAmT0Hng=\n")
        (folder / "seam.mod").write_text(SEAM)
        done = run("--robot", NAME, "--fix", folder / "seam.mod")
        words = f"its hash in {hashes} no longer agrees with it".encode()
        assert (words in done.stderr) == is_named
        assert run("--robot", NAME, "--fix", folder / "seam.mod").stderr == b""


def test_an_archive_of_a_backup_is_checked_and_not_corrected(tmp_path):
    archive = Path(make_archive(tmp_path / "cell", "zip", ROOT / "examples" / "backup"))
    done = run("--json", archive)
    files = {it["file"] for it in listed(done.stdout)}
    assert done.returncode == 1
    assert f"{archive}/RAPID/TASK1/PROGMOD/MainModule.mod" in files
    assert f"{archive}/SYSPAR/SYS.cfg" in files
    assert all(it.startswith(str(archive)) for it in files)
    before = archive.read_bytes()
    assert "is an archive: unpack it" in command.refused("check", "--fix", archive)
    assert archive.read_bytes() == before


def test_options_come_from_the_nearest_file(seam, tmp_path):
    below = tmp_path / "cell" / "service"
    below.mkdir(parents=True)
    (below / "seam.mod").write_text(SEAM)
    plain = output("--ignore", "V", "--json", below / "seam.mod")
    own = tmp_path / "pyproject.toml"
    own.write_text(f'[tool.other]\n[tool.irbkin.check]\nrobot = "{NAME}"\nignore = ["V"]\n')
    assert run("--json", below / "seam.mod").stdout.decode() == plain
    # The nearer file counts alone, and of one folder irbkin.toml.
    (tmp_path / "cell" / "pyproject.toml").write_text("[tool.other]\n")
    assert run("--json", below / "seam.mod").stdout.decode() == plain
    (tmp_path / "irbkin.toml").write_text(f'[check]\nrobot = "{NAME}"\nselect = ["V4"]\n')
    assert {it["code"] for it in listed(run("--json", below / "seam.mod").stdout)} == {"V401"}
    # The command line counts more, and the environment more than the file.
    both = run("--select", "R", "--json", seam, below / "seam.mod")
    assert {it["code"] for it in listed(both.stdout)} == {"E003", "R101", "R103"}
    assert b"IRB 9999" in run(seam, IRBKIN_ROBOT="IRB 9999").stderr


def test_every_option_of_a_file_is_read(seam, tmp_path):
    assert set(re.findall(r"`([a-z-]+)`", PAGE.split("| key |")[1].split("\n## ")[0])) >= set(KEYS)
    (tmp_path / "post.toml").write_text("[obstacles.post]\nsphere = 0.1\n")
    (tmp_path / "old_seam.mod").write_text("broken")
    (tmp_path / "HOME").mkdir()
    (tmp_path / "HOME" / "seam.mod").write_text("broken")
    (tmp_path / "service").mkdir()
    (tmp_path / "service" / "way.mod").write_text(SEAM.replace("Seam", "Way"))
    (tmp_path / "irbkin.toml").write_text(OPTIONS)
    found = listed(run("--json", tmp_path).stdout)
    assert {Path(it["file"]).name for it in found} == {"seam.mod", "way.mod"}
    fast = {Path(it["file"]).name for it in found if it["code"] == "V401"}
    assert fast == {"seam.mod"}
    for line, wanted in (
        ("tool = [0, 0, 100]", True),
        ("base = [0, 0, 0, 90, 0, 0]", True),
        ("limits = [[1, -10, 10], [6, -300, 300]]", True),
        ('cell = "post.toml"', True),
        ("step = 20", True),
        ('output-format = "github"', True),
        ('output-format = "xml"', "output-format: is 'xml', it must be one of text, concise, json"),
        ('ouput-format = "github"', "unknown key; did you mean output-format?"),
        ("tool = [0, 0]", "tool: has 2 numbers, it must have 3, 6 or 7"),
        ("limits = [[1, 2]]", "limits: is [[1, 2]], it must be a list of [axis, lower, upper]"),
        ("limits = [[7, 0, 1]]", "--limits: axis 7 must be a whole number from 1 to 6"),
        ("linkage-limits = [-70]", "it must be a list of 2 numbers"),
        ('select = "R"', "select: is 'R', it must be a list of texts"),
        ('select = ["R999"]', "select: unknown code 'R999'"),
        ("strict = 1", "strict: is 1, it must be true or false"),
        ("step = 0", "--step must be positive"),
        ("robot", "is not TOML"),
    ):
        text = f'[check]\nrobot = "{NAME}"\n{line}\n'
        (tmp_path / "irbkin.toml").write_text(text)
        done = run(seam)
        if wanted is True:
            assert done.returncode in (0, 1), done.stderr
        else:
            assert done.returncode == 2
            assert wanted in done.stderr.decode(), done.stderr
            if not wanted.startswith("--"):
                assert done.stderr.startswith(f"irbkin: {tmp_path}/irbkin.toml: ".encode())
    (tmp_path / "irbkin.toml").write_text("[chek]\n")
    assert b"unknown key; did you mean check?" in run(seam).stderr
    (tmp_path / "irbkin.toml").unlink()
    (tmp_path / "pyproject.toml").write_text("broken [")
    assert run("--robot", NAME, seam).returncode == 1
    (tmp_path / "pyproject.toml").write_text("[tool.irbkin.chek]\n")
    assert b"pyproject.toml: line 1, tool.irbkin.chek: unknown key; did you mean check?" in (
        run(seam).stderr
    )


def test_a_file_that_ignores_a_code_is_not_corrected_for_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # Of each module its own data, so that each correction is in the file of its finding.
    local = SEAM.replace("CONST robtarget", "LOCAL CONST robtarget")
    for name in "ab":
        Path(f"{name}.mod").write_text(local.replace("Seam", name).replace("main", f"go_{name}"))
    Path("irbkin.toml").write_text(
        f'[check]\nrobot = "{NAME}"\n[check.per-file-ignores]\n"a.mod" = ["C201"]\n'
    )
    before = {name: Path(f"{name}.mod").read_bytes() for name in "ab"}
    done = run("--diff", ".")
    assert re.findall(rb"^\+\+\+ .*?(\w)\.mod", done.stdout, re.MULTILINE) == [b"b"]
    assert done.stderr == b"irbkin: --fix would remove 1 finding\n"
    run("--fix", ".")
    assert Path("a.mod").read_bytes() == before["a"]
    assert Path("b.mod").read_bytes() != before["b"]
    Path("irbkin.toml").write_text(f'[check]\nrobot = "{NAME}"\n')
    run("--fix", ".")
    assert Path("a.mod").read_bytes() != before["a"]


def test_everything_may_be_excluded(seam, tmp_path):
    (tmp_path / "irbkin.toml").write_text(f'[check]\nrobot = "{NAME}"\nexclude = ["*.mod"]\n')
    done = run(seam)
    assert done.returncode == 0
    assert done.stdout.startswith(b"0 of 0 moves checked.\n")


def test_limits_of_the_machine_count(tmp_path):
    file = tmp_path / "wide.mod"
    far = "[9E9,9E9,9E9,9E9,9E9,9E9]"
    file.write_text(f"PROC main() MoveAbsJ [[0,0,0,0,30,420],{far}],v100,fine,tool0; ENDPROC")
    assert "J6" in output(file)
    assert "All checks passed!" in output("--limits", 6, -450, 450, file)
    assert "R102" in output("--limits", 6, -450, 450, "--limits", 5, -20, 20, file)
    for words in (["0", "-1", "1"], ["7", "-1", "1"], ["1.5", "-1", "1"]):
        message = command.refused("check", "--robot", NAME, "--limits", *words, file)
        assert f"--limits: axis {words[0]} must be a whole number from 1 to 6" in message
    assert "limit" in command.refused("check", "--robot", NAME, "--limits", 1, 20, -20, file)
    file.write_text(f"PROC main() MoveAbsJ [[0,-40,60,0,30,0],{far}],v100,fine,tool0; ENDPROC")
    coupled = ["--robot", "IRB 6660-205/1.9"]
    wide = run(*coupled, "--linkage-limits", -110, 110, file)
    assert wide.returncode == 0, wide.stdout
    narrow = run(*coupled, "--linkage-limits", -70, 70, file).stdout.decode()
    assert "the linkage (q3 - q2) is outside its limits by 30.0 deg" in narrow


def test_the_problem_matcher_of_the_page_matches_every_finding(seam):
    matchers = json.loads(TASKS)["tasks"][0]["problemMatcher"]
    lines = output("--output-format", "concise", "--select", "ALL", seam).splitlines()
    found = listed(output("--json", "--select", "ALL", seam))

    def matched(line):
        fits = []
        for matcher in matchers:
            pattern = matcher["pattern"]
            if it := re.match(pattern["regexp"], line):
                keys = ("file", "line", "column", "code", "message")
                fits.append((matcher["severity"], *(it[pattern[key]] for key in keys)))
        return fits

    shown = {"error": "error", "warning": "warning", "note": "info"}
    for line, it in zip(lines[1:-1], found, strict=True):
        (fit,) = matched(line)
        place = (it["file"], str(it["line"]), str(it["column"]), it["code"])
        assert fit[:5] == (shown[it["severity"]], *place)
        assert fit[5].endswith(it["message"])
    for code in codes().values():
        (fit,) = matched(f"a b:c.mod:1:2: {code.id} words")
        assert fit == (shown[code.severity], "a b:c.mod", "1", "2", code.id, "words")
    assert matched(lines[0]) == matched(lines[-1]) == []
    # The lines of the source in the longer form match neither.
    assert sum(map(len, map(matched, output(seam).splitlines()))) == len(
        output("-q", "--output-format", "concise", seam).splitlines()
    )


@pytest.mark.extra
def test_the_hook_for_pre_commit_runs(seam, tmp_path, monkeypatch):
    import yaml

    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    assert hook["id"] == "irbkin-check"
    for name in ("a.mod", "A.MODX", "b.sys", "c.SysX", "d.prg"):
        assert re.search(hook["files"], name)
    assert not re.search(hook["files"], "a.model")
    assert not hook["pass_filenames"]
    (tmp_path / "irbkin.toml").write_text(f'[check]\nrobot = "{NAME}"\n')
    monkeypatch.chdir(tmp_path)
    program, verb = hook["entry"].split()
    assert (program, verb) == ("irbkin", "check")
    done = run(*hook["args"])
    assert done.returncode == 1
    assert b"R101" in done.stdout


@pytest.mark.parametrize("form", FORMATS)
def test_every_format_takes_a_broken_file(form, tmp_path):
    (tmp_path / "broken.mod").write_bytes(b"MODULE M\r\nCONST robtarget p:=[[\xe4;\r\nENDMODULE")
    done = run("--robot", NAME, "--output-format", form, tmp_path / "broken.mod")
    assert done.returncode == 1
    assert b"E001" in done.stdout
    done = run("--robot", NAME, "--ignore", "E", tmp_path)
    # No move is checked.
    assert (done.returncode, b"E001" in done.stdout) == (1, False)


def test_findings_of_python_have_severities():
    found = rapid.check(irbkin.Robot(NAME), rapid.parse(SEAM))
    assert {it.severity for it in found} == {"error", "warning", "note"}


HOSTILE = "\x1b]0;owned\x07\u202e\x9b31m"


@pytest.mark.parametrize(
    "options",
    [
        (),
        ("--output-format", "concise"),
        ("--output-format", "github"),
        ("--verdict",),
        ("--diff",),
        ("--fix",),
    ],
)
def test_names_and_comments_do_not_reach_the_terminal(tmp_path, monkeypatch, options):
    monkeypatch.chdir(tmp_path)
    name = f"x\n::error::owned{HOSTILE}.mod"
    source = SEAM.replace("tGun;\n", f"tGun; ! {HOSTILE}\n")
    (tmp_path / name).write_text(source, encoding="utf-8")
    done = command.run("check", NAME, name, *options)
    assert done.returncode == 1 or options == ("--fix",)
    for text in (done.stdout.decode(), done.stderr.decode()):
        assert not set(text) & set("\x1b\x07\u202e\x9b")
        if "github" not in options:
            assert "\n::error::owned" not in text
    assert b"\\x1b" in done.stdout
    # The file keeps what it had.
    assert HOSTILE in (tmp_path / name).read_text(encoding="utf-8")


def test_the_names_of_a_table_do_not_reach_the_terminal(tmp_path):
    robot = irbkin.Robot("UR5e").to_urdf().replace('name="UR5e"', 'name="UR5e&#10;&#27;[31m"', 1)
    (tmp_path / "a.urdf").write_text(robot)
    done = command.run("fk", tmp_path / "a.urdf", "--joints", *"000000")
    assert b"\x1b" not in done.stdout + done.stderr
    assert command.run("diff", NAME, "a\x1b[31m.mod", "b.mod").stderr.count(b"\x1b") == 0


def test_lines_count_from_one(tmp_path):
    backup = written(tmp_path, SMALL)
    (backup / "SYSPAR" / "SYS.cfg").unlink()
    for form in ("text", "concise", "json", "github", "sarif", "junit"):
        text = command.run("check", backup, "--output-format", form).stdout.decode()
        assert "SYS.cfg is missing" in text
        assert not re.search(r'[.\w]:0|line(=|": )0\b|[lL]ine": 0|line 0|col(umn": |=)0', text), (
            text
        )
