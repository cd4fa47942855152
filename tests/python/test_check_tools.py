"""Loads of tools, and shapes of tools and parts in the file of a cell."""

import pytest
from irbkin import Cell, InvalidModelError, Robot, pose, rapid
from irbkin._cell import read
from irbkin.body import Shape
from test_check_manners import NAME, listed, run

ROBOT = Robot(NAME)
TOOL = "PERS tooldata {}:=[TRUE,[[0,0,{}],[1,0,0,0]],[{},[0,0,50],[1,0,0,0],0,0,0]];\n"
POINT = "[[{},{},{}],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
TABLE = "[obstacles.table]\nbox = [1.0, 1.6, 0.05]\npose = { xyz = [0.9, 0, 0.3] }\n"
GUN = "[tool.tGun]\ncylinder = { radius = 0.03, length = 0.3 }\npose = { xyz = [0, 0, 0.15] }\n"
FLANGE = Shape.cylinder(0.03, 0.3, pose([0, 0, 0.15]))


def module(data, moves, routines=""):
    return f"MODULE M\n{data}PROC main()\n{moves}\nENDPROC\n{routines}ENDMODULE\n"


def checked(folder, text, *arguments, code=None):
    """Findings as triples: the code, the source line, the message."""
    (file := folder / "m.mod").write_text(text)
    found = listed(run("--robot", NAME, "--json", *arguments, file).stdout)
    lines = text.split("\n")
    rows = [(it["code"], lines[it["line"] - 1], it["message"]) for it in found]
    return [row for row in rows if code is None or row[0] == code]


@pytest.mark.parametrize(
    ("mass", "code"),
    [
        (-1, "T301"),
        (-0.5, "T301"),
        (0, "T302"),
        (12.5, "T302"),
        (60, "T302"),
        (0.001, None),
        (12, None),
    ],
)
def test_a_load_is_above_zero_and_at_most_the_payload(tmp_path, mass, code):
    move = f"MoveJ {POINT.format(900, -300, 500)},v500,fine,tGun;"
    twice = f"{move}\n{move.replace('v500', 'v300')}"
    found = checked(tmp_path, module(TOOL.format("tGun", 150, mass), twice))
    assert [it[0] for it in found] == ([code] if code else [])
    for _, line, message in found:
        assert line.startswith("PERS tooldata tGun")
        assert message.startswith(f"tooldata tGun: its mass is {mass:g} kg")
    # In an array, in a routine that is given the tool, in a load.
    values = (TOOL.format("t", 150, own).split(":=")[1].rstrip(";\n") for own in (1, mass))
    data = f"PERS tooldata tGun{{2}}:=[{','.join(values)}];\n"
    indexed = module(data, move.replace("tGun", "tGun{2}"))
    assert [it[0] for it in checked(tmp_path, indexed)] == ([code] if code else [])
    go = f"PROC Go(PERS tooldata t)\n{move.replace('tGun', 't')}\nENDPROC\n"
    called = module(TOOL.format("tGun", 150, mass), "Go tGun;", go)
    assert [it[0] for it in checked(tmp_path, called)] == ([code] if code else [])
    load = f"PERS loaddata lPart:=[{mass},[0,0,50],[1,0,0,0],0,0,0];\n"
    gripped = module(load + TOOL.format("tGun", 150, 0.5), f"GripLoad lPart;\n{move}")
    # With the tool, 12 kg are too much.
    own = code or ("T302" if mass + 0.5 > 12 else None)
    assert [it[0] for it in checked(tmp_path, gripped)] == ([own] if own else [])
    # What the program assigns or nothing uses has no load in the text.
    for text in (f"tGun.tload.mass:=2;\n{move}", "! tGun", 'TPWrite "tGun";'):
        assert not checked(tmp_path, module(TOOL.format("tGun", 150, mass), text), code="T301")


def test_a_move_is_checked_with_the_shape_of_its_own_tool(tmp_path):
    data = TOOL.format("tGun", 300, 2) + TOOL.format("tLong", 300, 2)
    points = [POINT.format(900, y, 320) for y in (-300, -200, -100)]
    moves = [
        f"MoveJ {p},v500,fine,{tool};"
        for p, tool in zip(points, ("tLong", "tGun", "tGun"), strict=True)
    ]
    (cell := tmp_path / "cell.toml").write_text(TABLE)
    text = module(data, "\n".join(moves))
    none = checked(tmp_path, text, "--cell", cell)
    assert {it[0] for it in none} == {"T303"}
    assert [it[2].split(":")[0] for it in none] == ["tooldata tGun", "tooldata tLong"]
    assert "it has no shape in cell.toml: it is not part of the proof" in none[0][2]
    cell.write_text(TABLE + GUN)
    found = checked(tmp_path, text, "--cell", cell)
    hit = [it for it in found if it[0] == "K901"]
    assert [it[1] for it in hit] == moves[1:]
    (other,) = (it[2] for it in found if it[0] == "T303")
    assert other.startswith("tooldata tLong: it has no shape in cell.toml, which has tgun")
    # As the arm with this tool on its flange.
    arm, bare = ROBOT.with_attached(FLANGE), Cell.load(cell)
    own = rapid.check(arm, rapid.parse(text), cell=bare, codes=["K901"])
    assert [it.message for it in own][1:] == [it[2] for it in hit]
    assert not rapid.check(ROBOT, rapid.parse(text), cell=bare, codes=["K901"])


def test_a_call_has_the_tool_that_it_is_given_or_that_its_routine_has(tmp_path):
    data = TOOL.format("tGun", 300, 2)
    point = f"CONST robtarget pA:={POINT.format(900, -300, 320)};\n"
    (cell := tmp_path / "cell.toml").write_text(TABLE + GUN)
    go = "PROC Go(robtarget p{})\nMoveJ p,v500,fine,{};\nENDPROC\n"
    for call, routine in (
        ("Go pA;", go.format("", "tGun")),
        ("Go pA,tGun;", go.format(",PERS tooldata t", "t")),
    ):
        found = checked(tmp_path, module(data + point, call, routine), "--cell", cell)
        assert [it[0] for it in found] == ["K901"]
        # Also below another call, with a tool that has no shape in it.
        bare = TOOL.format("tBare", 300, 2)
        outer = routine + "PROC Outer(PERS tooldata t)\n" + call + "\nENDPROC\n"
        text = module(data + bare + point, "Outer tBare;", outer)
        assert "K901" in [it[0] for it in checked(tmp_path, text, "--cell", cell)]
    # A parameter that is passed on has the shape of what is given, and no other.
    bare = TOOL.format("tBare", 300, 2)
    outer = go.format(",PERS tooldata t", "t") + (
        "PROC Outer(robtarget p,PERS tooldata u)\nGo p,u;\nENDPROC\n"
    )
    for tool, codes in (("tGun", ["K901"]), ("tBare", [])):
        text = module(data + bare + point, f"Outer pA,{tool};", outer)
        found = checked(tmp_path, text, "--cell", cell)
        assert [it[0] for it in found if it[0] != "T303"] == codes
    bare = module(data + point.replace(",320]", ",620]"), "Go pA;", go.format("", "tool0"))
    assert checked(tmp_path, bare, "--cell", cell) == []


def test_a_part_is_carried_with_its_work_object(tmp_path):
    data = 'PERS wobjdata wPart:=[TRUE,TRUE,"",[[0,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
    data += (
        "PERS tooldata tFixed:=[FALSE,[[900,-300,700],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];\n"
    )
    target = "[[0,0,300],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    text = module(data, f"MoveJ {target},v500,fine,tFixed\\WObj:=wPart;")
    part = "[part.wPart]\nbox = [0.2, 0.2, 0.8]\n"
    (cell := tmp_path / "cell.toml").write_text(TABLE.replace("0.3] }", "0.9] }"))
    assert not checked(tmp_path, text, "--cell", cell, code="K901")
    cell.write_text(TABLE.replace("0.3] }", "0.9] }") + part)
    assert checked(tmp_path, text, "--cell", cell, code="K901")
    # What stands beside the robot is an obstacle, and not on its flange.
    cell.write_text(TABLE.replace("0.3] }", "0.9] }") + part.replace("part.wPart", "tool.tFixed"))
    assert not checked(tmp_path, text, "--cell", cell, code="K901")
    assert not checked(tmp_path, text, "--cell", cell, code="T303")


def test_a_shape_that_no_flange_carries_is_refused_by_its_tool(tmp_path):
    (cell := tmp_path / "cell.toml").write_text(TABLE + "[tool.tGun]\nhalf_space = [0, 0, 1]\n")
    move = f"MoveJ {POINT.format(900, -300, 500)},v500,fine,tGun;"
    (tmp_path / "m.mod").write_text(module(TOOL.format("tGun", 150, 1), move))
    message = run("--robot", NAME, "--cell", cell, tmp_path / "m.mod").stderr.decode()
    assert message.startswith("irbkin: cell.toml: tgun: ")
    assert "half space" in message


def test_shapes_of_tools_are_read_as_obstacles_are(tmp_path):
    (cell := tmp_path / "cell.toml").write_text(
        TABLE + '[tool.tGun.neck]\nsphere = 0.1\n[tool."tGun".tip]\nsphere = 0.05\n'
        "pose = { xyz = [0, 0, 0.2] }\n[part.wPart]\nbox = [0.1, 0.1, 0.1]\n"
    )
    own, shapes = read(cell)
    assert list(own.obstacles) == ["table"]
    assert {name: len(parts) for name, parts in shapes.items()} == {"tgun": 2, "wpart": 1}
    for text, words in (
        ("[tool.tGun]\nspere = 0.1\n", "line 5, tool.tGun.spere: unknown key"),
        ("[tool.tGun]\n", "has no shape"),
        ('[tool.tGun]\nsphere = 0.1\npose = { frame = "table" }\n', "there is no frame table"),
        ("[tool.tGun]\nsphere = 0.1\n[part.TGUN]\nsphere = 0.1\n", "TGUN is given twice"),
        ("[tool]\ntGun = 3\n", "must be a table"),
    ):
        cell.write_text(TABLE + text)
        with pytest.raises(InvalidModelError, match=words):
            Cell.load(cell)


LOAD = "PERS loaddata {}:=[{},[{}],[{}],{}];\n"
MOVE = f"MoveJ {POINT.format(900, -300, 500)},v500,fine,tGun;"


@pytest.mark.parametrize(
    ("cog", "aom", "inertia", "code", "words"),
    [
        ("0,0,50", "1,0,0,0", "0.01,0.02,0.02", None, ""),
        ("0,0,50", "1,0,0,0", "5,5,5", None, ""),
        ("0,0,50", "1,0,0,0", "100,200,300", "T304", "its inertia is 300 kg m^2, more than 5 kg"),
        ("0,0,50", "1,0,0,0", "0.01,0.01,0.0201", None, ""),
        ("0,0,50", "1,0,0,0", "0.01,0.01,0.03", "T302", "its inertia of 0.03 kg m^2 is more than"),
        ("0,0,50", "1,0,0,0", "0,0,0.03", None, ""),
        ("0,0,50", "0.7071,0.7071,0,0", "0,0,0", None, ""),
        ("0,0,50", "1,1,0,0", "0,0,0", "T302", "its aom has the length 1.41421, a quaternion has"),
        ("0,0,50", "0,0,0,0", "0,0,0", "T302", "its aom has the length 0"),
        ("0,0,0", "1,0,0,0", "0,0,0", "T305", "its center of gravity is [0,0,0]"),
        ("0,0,450", "1,0,0,0", "0,0,0", None, ""),
        ("0,0,451", "1,0,0,0", "0,0,0", "T305", "its center of gravity is 451 mm from the flange"),
    ],
)
def test_a_load_is_a_body_in_the_units_of_rapid(tmp_path, cog, aom, inertia, code, words):
    data = f"PERS tooldata tGun:=[TRUE,[[0,0,150],[1,0,0,0]],[5,[{cog}],[{aom}],{inertia}]];\n"
    found = checked(tmp_path, module(data, MOVE))
    assert [it[0] for it in found] == ([code] if code else [])
    assert all(it[2].startswith(f"tooldata tGun: {words}") for it in found)
    severity = {"T304": "error", "T302": "warning", "T305": "note"}
    own = listed(run("--robot", NAME, "--json", tmp_path / "m.mod").stdout)
    assert [it["severity"] for it in own] == ([severity[code]] if code else [])
    # A load has no TCP.
    load = LOAD.format("lPart", 5, cog, aom, inertia)
    gripped = module(load + TOOL.format("tGun", 150, 1), f"GripLoad lPart;\n{MOVE}")
    is_far = "from the flange" in words
    assert [it[0] for it in checked(tmp_path, gripped)] == ([code] if code and not is_far else [])
    # What the program assigns or does not use is not checked.
    for moves in (f"tGun.tload.cog.z:=40;\n{MOVE}", f"IF TRUE tGun:=tool0;\n{MOVE}", "! tGun"):
        assert not checked(tmp_path, module(data, moves), code=code)
    # What a routine declares may be filled by any call.
    own = data.replace("PERS", "VAR")
    assert not checked(tmp_path, module("", f'{own}GetDataVal "t",tGun;\n{MOVE}'), code=code)
    stationary = module(data.replace("TRUE", "FALSE"), f"ConfJ\\Off;\nStop;\n{MOVE}")
    assert not is_far or not checked(tmp_path, stationary, code=code)


def test_several_faults_of_a_load_are_all_reported(tmp_path):
    data = "PERS tooldata tGun:=[TRUE,[[0,0,150],[1,0,0,0]],[15,[0,0,0],[2,0,0,0],20,1,1]];\n"
    found = checked(tmp_path, module(data, MOVE))
    assert [it[0] for it in found] == ["T302", "T302", "T304", "T305"]


def test_a_tool_that_has_a_tcp_has_a_load(tmp_path):
    data = "PERS tooldata tGun:=[TRUE,[[{}],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];\n"
    ((code, _, message),) = checked(tmp_path, module(data.format("0,0,150"), MOVE))
    assert code == "T305"
    assert message == "tooldata tGun: it has a TCP, but load0: identify or enter its load"
    assert not checked(tmp_path, module(data.format("0,0,0"), MOVE))


def test_a_tool_and_what_it_grips_are_at_most_the_payload(tmp_path):
    load = LOAD.format("lPart", 8, "0,0,50", "1,0,0,0", "0,0,0")
    grip = f"GripLoad lPart;\n{MOVE}"
    for mass, count in ((4, 0), (4.5, 1)):
        found = checked(tmp_path, module(load + TOOL.format("tGun", 150, mass), grip))
        assert [it[0] for it in found] == ["T302"] * count
    words = "loaddata lPart: its 8 kg and the 4.5 kg of tGun are more than the 12 kg of IRB 2600"
    assert found[0][2].startswith(words)
    assert found[0][1].startswith("PERS loaddata lPart")
    heavy = load + TOOL.format("tGun", 150, 4.5)
    # With a lighter tool it may be right; what is assigned or not gripped is not known.
    light = TOOL.format("tLight", 150, 1)
    also = f"{grip}\n{MOVE.replace('tGun', 'tLight').replace('v500', 'v300')}"
    assert not checked(tmp_path, module(heavy + light, also))
    assert len(checked(tmp_path, module(heavy + light, grip))) == 1
    assert not checked(tmp_path, module(heavy, f"tGun.tload.mass:=1;\n{grip}"))
    assert not checked(tmp_path, module(heavy, f"lPart.mass:=1;\n{grip}"))
    assert not checked(tmp_path, module(heavy, f"! GripLoad lPart;\n{MOVE}"))
