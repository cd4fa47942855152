"""What is typed first works, or its cure is named in one line."""

import json
import os
import pty
import re
import struct
import subprocess

import irbkin
import numpy as np
import pytest
from command import COMMAND, NAME, ROBOT, XYZ, joints_of, refused, rows, run

fcntl = pytest.importorskip("fcntl")
termios = pytest.importorskip("termios")

NOT_THERE = "[9E9,9E9,9E9,9E9,9E9,9E9]"
VALUE = f"[[850,320,640],[0.2588190,0,0.9659258,0],[0,1,-2,1],{NOT_THERE}]"
OTHER = f"[[850,-320,640],[0.2588190,0,0.9659258,0],[-1,0,-1,0],{NOT_THERE}]"
JOINTS = f"[[10,0,-5,0,30,0],{NOT_THERE}]"
TOOL = "[TRUE,[[0,0,150],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]]"
WOBJ = '[FALSE,TRUE,"",[[100,0,0],[1,0,0,0]],[[0,50,0],[1,0,0,0]]]'


@pytest.fixture(autouse=True)
def no_robot_of_all_calls(monkeypatch, tmp_path):
    monkeypatch.delenv("IRBKIN_ROBOT", raising=False)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    "words",
    [
        [VALUE],
        [f"CONST robtarget p10 := {VALUE};"],
        [f"  LOCAL CONST robtarget p10:={VALUE}"],
        [f"p10:={VALUE};"],
        VALUE.replace(",[", ", [").split(" "),
    ],
)
def test_a_robtarget_is_a_pose(words):
    table = rows(run("ik", NAME, *words, "--csv"))
    wanted = rows(run("ik", NAME, *XYZ, "--csv"))
    np.testing.assert_allclose(joints_of(table), joints_of(wanted))
    # Its confdata is that of slot 1.
    assert table["confdata"].tolist() == ["", "yes", *[""] * 6]


def test_a_robtarget_without_its_confdata_says_so():
    done = run("ik", NAME, VALUE.replace("[0,1,-2,1]", "[3,3,3,3]"))
    last = done.stdout.decode().splitlines()[-1]
    assert last == "the robtarget has no solution inside the limits with the confdata"
    external = run("ik", NAME, VALUE.replace("[9E9", "[500"))
    assert external.stderr == b"irbkin: external axes of the targets are not considered\n"
    on_track = run("fk", NAME, JOINTS.replace("[9E9", "[500"))
    assert on_track.stderr == external.stderr


def test_several_robtargets_are_rows_with_their_names():
    table = rows(
        run("ik", NAME, f"CONST robtarget pA:={VALUE}; CONST robtarget pB:={OTHER};", "--csv")
    )
    assert sorted(set(zip(table["pose"], table["name"], strict=True))) == [(0.0, "pA"), (1.0, "pB")]
    assert sum(table["confdata"] == "yes") == 2


def test_a_module_gives_its_targets(tmp_path):
    text = f"""MODULE A
        CONST robtarget pA:={VALUE};
        CONST jointtarget jHome:={JOINTS};
        CONST robtarget pB:={OTHER};
        PROC main()
            MoveJ pA,v1000,fine,tool0;
        ENDPROC
    ENDMODULE"""
    (tmp_path / "a.mod").write_text(text)
    assert set(rows(run("ik", NAME, "a.mod", "--csv"))["name"]) == {"pA", "pB"}
    assert rows(run("fk", NAME, "a.mod", "--csv"))["name"].tolist() == ["jHome"]
    back = rows(run("ik", NAME, "a.mod:PB", "a.mod:pA", "--csv"))["name"]
    assert list(dict.fromkeys(back)) == ["pB", "pA"]
    tools = f"MODULE T\nPERS tooldata tA:={TOOL};\nPERS tooldata tB:={TOOL};\nENDMODULE"
    (tmp_path / "tools.sys").write_text(tools)
    found = run("ik", NAME, "a.mod:pA", "--tool", "tools.sys:tB")
    assert found.stdout == run("ik", NAME, "a.mod:pA", "--tool", 0, 0, 150).stdout
    two = refused("ik", NAME, VALUE, "--tool", "tools.sys")
    assert two == "irbkin: --tool takes one value, got 2 (FILE:NAME has one)\n"
    assert "a.mod:pC is no robtarget" in refused("ik", NAME, "a.mod:pC")
    (tmp_path / "b.mod").write_text("MODULE B ENDMODULE")
    assert "b.mod is no robtarget; a robtarget or pose is wanted" in refused("ik", NAME, "b.mod")
    assert "No such file" in refused("ik", NAME, "c.mod")


def test_a_jointtarget_is_joint_angles():
    plain = ["10", "0", "-5", "0", "30", "0"]
    wanted = run("fk", NAME, *plain).stdout
    assert run("fk", NAME, JOINTS).stdout == wanted
    named = run("fk", NAME, f"CONST jointtarget j1:={JOINTS};", "--csv")
    assert rows(named)["name"].tolist() == ["j1"]
    seeds = [run("ik", NAME, *XYZ, "--seed", *own).stdout for own in ([JOINTS], plain)]
    assert seeds[0] == seeds[1]


def test_tools_and_work_objects_are_rapid():
    for text in (TOOL, f"PERS tooldata tGun := {TOOL};"):
        found = run("ik", NAME, *XYZ, "--tool", text).stdout
        assert found == run("ik", NAME, *XYZ, "--tool", 0, 0, 150).stdout
    plain = rows(run("ik", NAME, *XYZ, "--csv"))
    moved = ["--xyz", 750, 270, 640, *XYZ[4:]]
    for words in ([WOBJ], [f"PERS wobjdata w:={WOBJ};"], [100, 50, 0]):
        table = rows(run("ik", NAME, *moved, "--wobj", *words, "--csv"))
        np.testing.assert_allclose(joints_of(table), joints_of(plain), atol=1e-9)
        back = rows(run("fk", NAME, *joints_of(table)[0], "--wobj", *words, "--csv"))
        np.testing.assert_allclose([back["x_mm"][0], back["y_mm"][0]], [750, 270], atol=1e-6)
        own = f"[[750,270,640],[0.2588190,0,0.9659258,0],[0,1,-2,1],{NOT_THERE}]"
        for q in joints_of(rows(run("ik", NAME, own, "--wobj", *words, "--csv"))):
            np.testing.assert_allclose(ROBOT.fk(np.radians(q))[:2, 3], [0.85, 0.32], atol=1e-9)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["fk", NAME, VALUE], "is a robtarget, a jointtarget is wanted (irbkin ik takes it)"),
        (["ik", NAME, JOINTS], "is a jointtarget, a robtarget or pose is wanted (irbkin fk takes"),
        (["ik", NAME, VALUE.replace(",0]", "]", 1)], "no robtarget: rot has 3 components, it must"),
        (["ik", NAME, "[850,320,640]"], "is no robtarget: 3 components, it must have 4"),
        (["ik", NAME, VALUE[:30]], "is no robtarget: "),
        (["ik", NAME, VALUE, "poses.csv"], "is no robtarget"),
        (["ik", NAME, *XYZ, "--tool", VALUE], "is a robtarget, a tooldata or pose is wanted"),
        (["ik", NAME, *XYZ, "--wobj", TOOL], "is a tooldata, a wobjdata or pose is wanted"),
        (["ik", NAME, *XYZ, "--tool", TOOL.replace("TRUE", "FALSE")], "a stationary tool"),
        (
            ["ik", NAME, *XYZ, "--wobj", WOBJ.replace("TRUE", "FALSE")],
            "a work object that is held or moved",
        ),
        (["ik", NAME, *XYZ, "--tool", "tGun"], "'tGun' is not a finite number"),
        (["ik", NAME, VALUE.replace("0.9659258", "0.8")], "norm"),
        (["ik", VALUE], "is no robot: give ROBOT first"),
        (["view", "good.mod"], "'good.mod' is no robot: give ROBOT first"),
        (["fk", "0", "0", "0", "0", "30", "0"], "'0' is no robot: give ROBOT first"),
        (["urdf"], "no robot: give ROBOT first"),
        (["view", "2600"], '"IRB 2600-12/1.65"'),
        (["ik", NAME, "--pos", 1, 2, 3], "--pos 1 2 3: did you mean --xyz? (irbkin ik --help)"),
        (["ik", NAME, "--workobject", 1], "did you mean --wobj?"),
        (["check", NAME, "a.mod", "--colour"], "did you mean --color?"),
        (["check", NAME, "a.mod", "--robto", NAME], "did you mean --robot?"),
        (["ik", NAME, "--wihtin"], "did you mean --within?"),
        (["check", "a.mod", "-r", "2600"], '"IRB 2600-12/1.65"'),
        (["completion", "csh"], "invalid choice"),
    ],
)
def test_wrong_text_says_what_it_looks_like_and_what_is_wanted(words, message):
    assert message in refused(*words)


def test_a_pose_of_numbers_alone_names_its_orientation():
    table = run("ik", NAME, 850, 320, 640, 0, 150, 0).stdout
    assert table == run("ik", NAME, "--xyz", 850, 320, 640, "--euler", 0, 150, 0).stdout
    heading = run("ik", NAME, "--xyz", 850, 320, 640).stdout.decode().splitlines()[0]
    assert heading.endswith("mm, wxyz 1 0 0 0, as no orientation is given")


@pytest.mark.parametrize("way", ["environment", "toml", "pyproject", "option"])
def test_a_robot_is_given_once_for_all_calls(way, tmp_path):
    environment, option = {}, []
    if way == "environment":
        environment = {"IRBKIN_ROBOT": NAME}
    elif way == "option":
        option = ["--robot", NAME]
    else:
        name, head = ("irbkin", "check") if way == "toml" else ("pyproject", "tool.irbkin.check")
        (tmp_path / f"{name}.toml").write_text(f'[{head}]\nrobot = "{NAME}"\n')
    (tmp_path / "q.csv").write_text("0,0,0,0,30,0\n")
    for verb, *words in (
        ["fk", 0, 0, 0, 0, 30, 0],
        ["fk", "q.csv", "--csv"],
        ["ik", VALUE],
        ["ik", *XYZ],
        ["urdf"],
    ):
        done = run(verb, *words, *option, **environment)
        assert done.stdout == run(verb, NAME, *words).stdout, verb
        assert not done.returncode
        words = f"irbkin: robot of {tmp_path / name}.toml\n" if way in ("toml", "pyproject") else ""
        assert done.stderr.decode() == words
    # One that is on the line counts first, a misspelled one too.
    other = run("urdf", "IRB 120-3/0.58", **environment).stdout
    assert other == irbkin.Robot("IRB 120-3/0.58").to_urdf().encode()
    assert "close names" in refused("urdf", "IRB 2600", **environment)


def test_the_options_of_an_arm_come_with_it(tmp_path):
    text = f'[check]\nrobot = "{NAME}"\ntool = [0, 0, 150]\nlimits = [[6, -10, 10]]\n'
    (tmp_path / "irbkin.toml").write_text(text)
    done = run("fk", 0, 0, 0, 0, 30, 20, "--csv")
    assert done.stderr.decode() == f"irbkin: robot, tool, limits of {tmp_path / 'irbkin.toml'}\n"
    assert rows(done)["limits"].tolist() == ["outside"]
    assert (
        rows(done)["x_mm"]
        == rows(run("fk", NAME, 0, 0, 0, 0, 30, 20, "--tool", 0, 0, 150, "--csv"))["x_mm"]
    )
    plain = run("fk", NAME, 0, 0, 0, 0, 30, 20, "--csv")
    assert rows(plain)["limits"].tolist() == ["inside"]
    assert not plain.stderr


def test_the_catalog_is_filtered_by_names_as_robots_are():
    found = rows(run("catalog", "irb2600", "--csv"))["name"].tolist()
    assert len(found) == 5
    for words in (["2600"], ["IRB", "2600"], ["irb_2600"]):
        assert rows(run("catalog", *words, "--csv"))["name"].tolist() == found


def test_columns_of_words_are_kept(tmp_path):
    file = tmp_path / "poses.csv"
    file.write_text(
        "id,name,x_mm,y_mm,z_mm,rz_deg,ry_deg,rx_deg\n1,left,900,-200,600,0,160,0\n2,right,900,200,600,0,160,0\n"
    )
    for words in (["--seed", *["0"] * 6], ["--within"]):
        table = rows(run("ik", NAME, file, *words, "--csv"))
        assert dict(zip(table["pose"], table["name"], strict=True)) == {0.0: "left", 1.0: "right"}
    short = "x_mm,y_mm,z_mm,rz_deg,ry_deg,rx_deg,name\n900,0,600,0,160,0,left\n900,0,600,0,160,0\n"
    table = rows(run("ik", NAME, "-", "--seed", *["0"] * 6, "--csv", stdin=short))
    assert table["name"].tolist() == ["left", ""]
    again = run("fk", NAME, "-", "--csv", stdin=run("ik", NAME, file, "--within", "--csv").stdout)
    assert list(rows(again))[:2] == ["name", "x_mm"]


def test_a_program_that_is_not_played_names_the_routines_that_are(tmp_path):
    (tmp_path / "a.mod").write_text(
        f"""MODULE A
            CONST robtarget p:={VALUE};
            PROC main()
                WHILE TRUE DO
                    MoveJ p,v1000,fine,tool0;
                ENDWHILE
            ENDPROC
            PROC Home()
                MoveJ p,v1000,fine,tool0;
            ENDPROC
        ENDMODULE"""
    )
    for verb in (["rapid"], ["view", "-o", "a.json"]):
        message = refused(verb[0], NAME, "a.mod", *verb[1:])
        assert message.startswith("irbkin: a.mod: line 4, column ")
        assert message.endswith("(--routine Home has none)\n")
        assert run(verb[0], NAME, "a.mod", "--routine", "Home", *verb[1:]).returncode == 0


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_has_verbs_and_options(shell):
    text = run("completion", shell).stdout.decode()
    assert all(word in text for word in ("catalog", "--wobj".lstrip("-"), "--within".lstrip("-")))


def on_terminal(width, *words):
    """What a terminal of a width shows of the command."""
    reader, writer = pty.openpty()
    fcntl.ioctl(writer, termios.TIOCSWINSZ, struct.pack("HHHH", 40, width, 0, 0))
    environment = {
        key: own for key, own in os.environ.items() if key not in ("COLUMNS", "NO_COLOR")
    }
    process = subprocess.Popen(
        [*COMMAND, *words],
        stdout=writer,
        stderr=writer,
        env={**environment, "TERM": "xterm-256color"},
    )
    os.close(writer)
    content = b""
    while True:
        try:
            part = os.read(reader, 1 << 16)
        except OSError:
            break
        if not part:
            break
        content += part
    os.close(reader)
    assert process.wait(timeout=60) == 0
    return content.decode().replace("\r\n", "\n")


@pytest.mark.parametrize("width", [60, 80, 160])
def test_tables_and_help_fit_the_terminal(width):
    whole = rows(run("ik", NAME, VALUE, "--csv"))
    for words in (["ik", NAME, VALUE], ["ik", "--help"], ["--help"]):
        text = on_terminal(width, *words)
        assert "\x1b[" in text
        plain = re.sub(r"\x1b\[[\d;]*m", "", text)
        body = plain.partition("\nexamples:")[0].partition("\nExit codes:")[0].splitlines()
        assert max(map(len, body)) <= width
        if words[0] == "ik" and "--help" not in words:
            # No column and no digit is lost.
            for name, column in whole.items():
                key = name.partition("_")[0]
                assert sum(f" {key} " in f" {line} " for line in body) >= 1, key
                if name == "q3_deg":
                    assert all(plain.count(f"{it:.2f}") for it in column)


def test_a_pipe_has_no_color_and_no_cut_lines():
    for words in (["ik", NAME, VALUE], ["catalog"], ["ik", "--help"]):
        text = run(*words, COLUMNS="60").stdout.decode()
        assert "\x1b" not in text
    assert max(map(len, run("ik", NAME, VALUE, COLUMNS="60").stdout.decode().splitlines())) > 120
    content = json.loads(run("ik", NAME, VALUE, "--json").stdout)
    assert [row["confdata"] for row in content["rows"]] == ["", "yes", *[""] * 6]
