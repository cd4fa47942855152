"""Which arms can run a program: `irbkin arms` and `rapid.arms` say what `check` says of each."""

import csv
import io
import json
import re

import irbkin
import irbkin.body
import numpy as np
import pytest
from command import refused, run
from irbkin import rapid
from irbkin.cli.postures import has_confdata

TOOL = "PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];"
AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
NAMES = [
    "IRB 120-3/0.58",
    "IRB 1200-5/0.9",
    "IRB 1300-7/1.4",
    "IRB 1600-10/1.45",
    "IRB 2600-12/1.65",
    "IRB 4600-45/2.05",
    "IRB 6640-180/2.55",
    "IRB 6660-205/1.9",
    "CRB 15000-10/1.52",
    "IRB 14050-0.5/0.5",
]
FIELDS = ["name", "payload", "reach", "moves", "met", "unchecked", "margin_deg", "singular"]
FIELDS.append("shift_mm")
UNITS = {"payload": "payload_kg", "reach": "reach_mm"}


def target(x, y, z):
    return f"[[{x},{y},{z}],[0,0,1,0],[0,0,0,0],{AXES}]"


# A target at which the tool is turned away from every wrist, one far out, calls with a target.
PROGRAM = f"""MODULE Seam
    {TOOL}
    CONST robtarget pNear:={target(900, -300, 500)};
    CONST robtarget pFar:={target(900, 300, 500)};
    CONST robtarget pAway:={target(1400, 200, 600)};
    CONST robtarget pIn:={target(520, 0, 560)};
    PROC main()
        MoveAbsJ [[0,0,0,0,60,0],{AXES}],v1000,fine,tGun;
        MoveJ pNear,v1000,z20,tGun;
        MoveL pFar,v500,fine,tGun;
        FOR i FROM 1 TO 4 DO
            MoveL Offs(pNear,0,100*i,0),v500,z10,tGun;
        ENDFOR
        weld pFar;
        weld pAway;
        weld pIn;
        MoveL Offs(pIn,-1000,0,0),v500,fine,tGun;
    ENDPROC
    PROC weld(robtarget p)
        MoveL Offs(p,0,0,80),v500,z10,tGun;
        MoveL p,v100,fine,tGun;
    ENDPROC
ENDMODULE
"""
UNKNOWN = PROGRAM.replace(TOOL, "")
EASY = re.sub(r"weld p(Away|In);|MoveL Offs\(pIn.*", "", PROGRAM)


def program(tmp_path, text=PROGRAM):
    file = tmp_path / "seam.mod"
    file.write_text(text)
    return file, rapid.load_program(file)


def expected(checked, robot):
    """What a row must say, move by move."""

    def has(move, kinds):
        place = (move.module, move.line, move.column)
        own = (it for it in checked.findings if it.code[0] in kinds)
        return any(place in ((it.module, it.line, it.column), *it.related) for it in own)

    known = [it for it in checked.moves if it.unchecked is None and it.q is not None]
    met = [it for it in known if not has(it, "RK")]
    low, high = np.degrees(robot.limits.T)
    distances = [min(*(q - low), *(high - q)) for q in (np.degrees(it.q) for it in met)]
    for own in met if robot.linkage_limits is not None else ():
        lower, upper = np.degrees(robot.linkage_limits)
        serial = (np.degrees(own.q[2] - own.q[1]) + 180.0) % 360.0 - 180.0
        distances += [serial - lower, upper - serial]
    unchecked = sum(it.unchecked is not None for it in checked.moves)
    singular = sum(has(it, "S") for it in checked.moves)
    return len(checked.moves), len(met), unchecked, min(distances, default=None), singular


@pytest.mark.parametrize("text", [PROGRAM, UNKNOWN, EASY])
def test_a_row_is_what_check_finds_of_its_arm(tmp_path, text):
    _, own = program(tmp_path, text)
    found = rapid.arms(own, names=NAMES)
    assert {it.name for it in found} == set(NAMES)
    for it in found:
        robot = irbkin.Robot(it.name)
        *counts, margin, singular = expected(own.check(robot), robot)
        assert [it.moves, it.met, it.unchecked] == counts
        assert it.margin_deg == pytest.approx(margin, abs=1e-9)
        assert (it.singular, it.shift_mm) == (singular, None)
        entry = irbkin.catalog_entry(it.name)
        assert (it.payload, it.reach) == (entry.payload, entry.reach)
    if text is PROGRAM:
        assert len({it.met for it in found}) > 3


def test_a_row_in_a_cell_at_a_base_with_a_given_tool_is_what_check_finds(tmp_path):
    _, own = program(tmp_path, UNKNOWN)
    wall = irbkin.body.Shape.box([0.2, 4, 4], irbkin.pose([1.05, 0, 0]))
    cell = irbkin.Cell({"wall": wall})
    tool, base = irbkin.pose([0, 0, 0.18]), irbkin.pose([-0.2, 0.1, 0])
    names = NAMES[2:5]
    found = rapid.arms(own, names=names, cell=cell, tool=tool, base=base)
    for it in found:
        robot = irbkin.Robot(it.name).with_base(base)
        checked = own.check(robot, cell=cell, tools={None: tool})
        *counts, margin, singular = expected(checked, robot)
        assert [it.moves, it.met, it.unchecked, it.singular] == [*counts, singular]
        assert it.margin_deg == pytest.approx(margin, abs=1e-9)
    free = rapid.arms(own, names=names, tool={"tGun": tool}, base=base)
    assert sum(it.met for it in free) > sum(it.met for it in found)
    # What rests on a given tool is a note of check, and misses all the same.
    assert all(it.met < it.moves for it in found)


def test_every_arm_has_as_many_moves_and_those_without_confdata_meet_none(tmp_path):
    _, own = program(tmp_path)
    found = rapid.arms(own)
    assert sorted(it.name for it in found) == sorted(irbkin.catalog())
    (moves,) = {it.moves for it in found}
    for it in found:
        robot = irbkin.Robot(it.name)
        if not has_confdata(robot):
            assert (it.met, it.unchecked, it.margin_deg) == (0, moves, None)
        else:
            assert it.moves == len(own.check(robot, codes=[]).moves)
            assert it.met + it.unchecked <= moves


def test_most_moves_come_first_then_the_least_reach(tmp_path):
    _, own = program(tmp_path, EASY)
    found = rapid.arms(own, payload=5)
    keys = [(-it.met, it.reach) for it in found]
    assert keys == sorted(keys)
    assert found[0].met == found[0].moves
    assert all(it.payload >= 5 for it in found)
    assert found == rapid.arms(own, payload=5, threads=1)


def test_shift_is_the_nearest_stand_that_meets_most(tmp_path):
    _, own = program(tmp_path, EASY)
    names = ["IRB 1200-5/0.9", "IRB 1300-7/1.4", "IRB 120-3/0.58", "UR5"]
    before = {it.name: it for it in rapid.arms(own, names=names)}
    found = {it.name: it for it in rapid.arms(own, names=names, shift=True)}
    assert found["IRB 1300-7/1.4"] == before["IRB 1300-7/1.4"]
    assert found["UR5"] == before["UR5"]
    for name in ("IRB 1200-5/0.9", "IRB 120-3/0.58"):
        it, robot, tried = found[name], irbkin.Robot(name), {}
        for way in range(-500, 501, 20):
            at = robot.with_base(irbkin.pose([way / 1e3, 0, 0]))
            tried[way] = expected(own.check(at), at)[1]
        most = max(tried.values())
        assert it.met == most
        assert (it.shift_mm or 0) == min((w for w in tried if tried[w] == most), key=abs)
    moved = found["IRB 1200-5/0.9"]
    assert moved.met > before["IRB 1200-5/0.9"].met
    assert moved.stand == f"{moved.shift_mm} mm forward"
    assert moved._replace(shift_mm=-240).stand == "240 mm back"


def test_answers_show_themselves_and_are_columns(tmp_path):
    _, own = program(tmp_path)
    found = rapid.arms(own, names=NAMES[:4])
    able = sum(it.met == it.moves for it in found)
    assert repr(found).startswith(f"<Candidates: {able} of 4 arms can make all {found[0].moves} ")
    assert all(f"{it.name}: {it.met} met" in repr(found) for it in found)
    html = found._repr_html_()
    assert html.count("<tr>") == html.count("background") == 4
    assert list(found.to_dict()) == FIELDS
    text = io.StringIO()
    found.to_csv(text)
    head, first, *_ = csv.reader(io.StringIO(text.getvalue()))
    assert head == FIELDS
    assert first[0] == found[0].name
    assert float(first[2]) == found[0].reach
    with pytest.raises(AttributeError):
        found.rows = ()


def test_progress_counts_arms_and_an_interrupt_ends_the_work(tmp_path):
    _, own = program(tmp_path)
    seen = []
    rapid.arms(own, names=NAMES, progress=lambda *done: seen.append(done))
    assert seen == [(count, 10) for count in range(1, 11)]

    def interrupted(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rapid.arms(own, shift=True, progress=interrupted)


def test_the_command_writes_the_rows(tmp_path):
    file, own = program(tmp_path, EASY)
    names = [word for name in NAMES[:4] for word in ("--arm", name)]
    done = run("arms", file, *names, "--json")
    found = rapid.arms(own, names=NAMES[:4])
    assert done.returncode == 0
    answer = json.loads(done.stdout)
    assert list(answer) == ["arms"]
    assert [list(it) for it in answer["arms"]] == [FIELDS] * 4
    for it, row in zip(answer["arms"], found, strict=True):
        assert it == {**row._asdict(), "reach": pytest.approx(1e3 * row.reach)}
    done = run("arms", file, *names, "--csv")
    head = next(csv.reader(io.StringIO(done.stdout.decode())))
    assert head == [UNITS.get(it, it) for it in FIELDS]
    text = run("arms", file, *names).stdout.decode()
    assert "2 of 4 arms can make all" in text
    assert f'irbkin port "{found[0].name}"' in text
    done = run("arms", file, "--arm", "IRB 120-3/0.58")
    assert done.returncode == 1
    assert b'irbkin check "IRB 120-3/0.58"' in done.stdout
    output = tmp_path / "arms.json"
    assert run("arms", file, *names, "-o", output).stdout == b""
    assert json.loads(output.read_text()) == answer


def test_the_command_moves_the_base_and_takes_options_of_a_file(tmp_path, monkeypatch):
    _, own = program(tmp_path, re.sub(re.escape(TOOL), "", EASY))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "irbkin.toml").write_text("[check]\ntool = [0, 0, 180]\nbase = [-300, 0, 0]\n")
    name = "IRB 1200-5/0.9"
    done = run("arms", "seam.mod", "--arm", name, "--shift", "--json")
    (row,) = json.loads(done.stdout)["arms"]
    (there,) = rapid.arms(
        own,
        names=[name],
        tool=irbkin.pose([0, 0, 0.18]),
        base=irbkin.pose([-0.3, 0, 0]),
        shift=True,
    )
    assert (row["met"], row["shift_mm"]) == (there.met, there.shift_mm)
    assert row["shift_mm"] > 380
    text = run("arms", "seam.mod", "--arm", name, "--shift", "--base", 0, 0, 0).stdout.decode()
    assert re.search(r'IRB 1200-5/0.9 \d+ mm forward: irbkin port "IRB 1200', text)


WRONG = {
    "unknown arm": (["--arm", "IRB 2600"], 'close names: "IRB 2600-12/1.65"'),
    "payload": (["--payload", "900"], "payload is 900 kg, it must be 0 to 800 kg"),
    "negative": (["--payload", "-1"], "payload is -1 kg, it must be 0 to 800 kg"),
    "file": (["missing.mod"], "missing.mod: No such file"),
    "an arm": (["IRB 2600-12/1.65"], "IRB 2600-12/1.65: No such file"),
    "cell": (["--cell", "seam.mod"], "a cell is in a file that ends in .toml"),
    "meters": (["--tool", "0", "0", "0.18"], "are these meters?"),
    "array": (["-o", "arms.npy"], "must end in .csv, .json, .txt"),
    "robot": (["--robot", "UR5"], "did you mean --arm?"),
    "option": (["--shifts"], "did you mean --shift?"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_named(tmp_path, monkeypatch, name):
    program(tmp_path)
    monkeypatch.chdir(tmp_path)
    words, message = WRONG[name]
    assert message in refused("arms", "seam.mod", *words)


def test_a_program_without_moves_or_with_unknown_tools_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty.mod").write_text("")
    (tmp_path / "data.mod").write_text(f"MODULE Data\n{TOOL}\nENDMODULE\n")
    for name in ("data.mod", "empty.mod"):
        assert f"no move in {name}" in refused("arms", name)
    (tmp_path / "seam.mod").write_text(re.sub("MoveAbsJ.*", "", UNKNOWN))
    done = run("arms", "seam.mod")
    assert done.returncode == 1
    assert done.stderr.count(b"\n") == 1
    assert b"by unknown tools. --tool X Y Z gives" in done.stderr
    assert run("arms", "seam.mod", "--tool", "tGun=0", 0, 180, "--payload", 10).returncode == 0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"threads": -2}, "threads is -2, it must be at least 1"),
        ({"names": []}, "names is empty"),
        ({"payload": float("nan")}, "payload is nan kg, it must be 0 to 800 kg"),
    ],
)
def test_wrong_arguments_are_named(tmp_path, options, words):
    _, own = program(tmp_path)
    with pytest.raises(irbkin.IrbkinError, match=words):
        rapid.arms(own, **options)


def test_an_arm_without_confdata_is_a_row(tmp_path):
    file, _ = program(tmp_path)
    done = run("arms", file, "--arm", "UR5", "--json")
    (row,) = json.loads(done.stdout)["arms"]
    assert (done.returncode, row["met"], row["unchecked"]) == (1, 0, row["moves"])
    assert b"UR5 has no confdata of ABB" in run("arms", file, "--arm", "UR5").stdout


def test_a_backup_of_two_robots_must_be_given_by_one():
    backup = "examples/backup"
    message = refused("arms", backup)
    assert "2 robots, give the files of one: T_ROB1: ROB_1" in message
    done = run("arms", f"{backup}/RAPID/TASK2", "--payload", 20, "--json")
    rows = json.loads(done.stdout)["arms"]
    checked = json.loads(run("check", f"{backup}/RAPID/TASK2", "--json").stdout)["moves"]
    assert {it["moves"] for it in rows} == {checked["total"]}
