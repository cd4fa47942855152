"""`irbkin diff`: what differs first, with the moves that it touches; then moves; then targets."""

import json
from pathlib import Path

import pytest
from command import NAME, refused, run
from irbkin import abb, rapid

EXAMPLE = Path(__file__).parents[2] / "examples" / "backup"
TOOL = "PERS tooldata tWeld:=[TRUE,[[0,0,{z}],[1,0,0,0]],[{mass},[0,0,50],[1,0,0,0],0,0,0]];"
COUNT = 60
POINTS = [(f"p{n}", 900 + n, -300 + 5 * n, 500) for n in range(COUNT)]
SPEEDS = "PERS speeddata vWeld:=[{speed},500,5000,1000];\nPERS zonedata zWeld:={zone};"
ZONES = "[FALSE,{0},1,1,0.1,1,0.1]"


def module(*, z=180, mass=2, speed=30, zone=1, x=0, setting="", v="v30", targets=POINTS, more=""):
    """A program: a weld of many moves, and moves before it."""
    data = [TOOL.format(z=z, mass=mass), SPEEDS.format(speed=speed, zone=ZONES.format(zone))]
    data += ["PERS tooldata tOther:=[TRUE,[[0,0,90],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];"]
    tail = "[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    data += [f"CONST robtarget {name}:=[[{a + x},{b},{c}],{tail};" for name, a, b, c in targets]
    welds = [f"MoveL {name},vWeld,zWeld,tWeld;" for name, *_ in targets]
    moves = ["MoveJ p0,v500,fine,tOther;", setting, f"MoveL p1,{v},z1,tOther;", "Weld;"]
    lines = [*data, "PROC main()", *moves, "ENDPROC", "PROC Weld()", *welds, "ENDPROC", more]
    return "MODULE Main\n" + "\n".join(lines) + "\nENDMODULE\n"


@pytest.fixture
def compared(tmp_path):
    """The command on two programs: the lines of its text, and its JSON, with its exit code."""

    def compare(old, new, *robot):
        names = [tmp_path / "old.mod", tmp_path / "new.mod"]
        for name, text in zip(names, (old, new), strict=True):
            name.write_text(text)
        done = run("diff", *robot, *names)
        record = run("diff", "--json", *robot, *names)
        assert done.returncode == record.returncode
        lines = done.stdout.decode().replace(f"{tmp_path}/", "").splitlines()
        return done.returncode, lines, json.loads(record.stdout, parse_constant=pytest.fail)

    return compare


ROBOT = ("--robot", NAME)


@pytest.mark.parametrize("robot", [(), ROBOT])
def test_what_is_equal_differs_in_nothing(compared, robot):
    code, lines, record = compared(module(), module(), *robot)
    assert (code, lines) == (0, ["Nothing differs."])
    assert not any(record.values())


@pytest.mark.parametrize("robot", [(), ROBOT])
def test_a_speed_and_a_zone_of_a_move_are_named(compared, robot):
    new = module(v="v300").replace("v300,z1,", "v300,z100,")
    code, lines, record = compared(module(v="v30"), new, *robot)
    assert code == 1
    line = next(at for at, it in enumerate(new.splitlines(), 1) if "v300" in it)
    assert lines == [
        f"new.mod:{line}: move to p1: speed was v30, is v300, zone was z1, is z100 (1 move)",
        "Moves: 1.",
    ]
    (change,) = record["moves"]
    assert (change["was"], change["now"]) == (
        {"speed": "v30", "zone": "z1"},
        {"speed": "v300", "zone": "z100"},
    )


def test_a_tool_that_moved_explains_the_joints_of_its_targets(compared):
    # The targets of its last moves are only within reach of the shorter tool.
    far = [("pHigh1", 900, 0, 1350), ("pHigh2", 900, 0, 1355)]
    old, new = (module(z=z, targets=[*POINTS, *far]) for z in (180, 200))
    code, (first, *others, last), record = compared(old, new, *ROBOT)
    assert code == 1
    assert first.startswith("new.mod:2: tool tWeld: TCP moved by 20.000 mm, 0.000 deg (62 moves; ")
    (tool,) = record["data"]
    assert tool["frames"] == {"TCP": [20.0, 0.0]}
    assert tool["moves"] == COUNT + 2
    # p0 and p1 are met with the other tool first.
    assert COUNT - 2 <= tool["targets"] <= COUNT
    assert 1.0 < tool["joint_deg"] < 30.0
    kinds = {it["target"]: it["kind"] for it in record["targets"]}
    assert kinds == {"pHigh1": "unreachable", "pHigh2": "unreachable"}
    assert [it.split(": ")[1] for it in others] == ["pHigh1", "pHigh2"]
    assert last == "Data and settings: 1. Targets: 2 unreachable."


@pytest.mark.parametrize(
    ("change", "words", "moves"),
    [
        ({"mass": 5}, "tool tWeld: mass_kg was 2, is 5", COUNT),
        ({"speed": 35}, "speed vWeld: v_tcp_mm_s was 30, is 35", COUNT),
        ({"zone": 5}, "zone zWeld: pzone_tcp_mm was 1, is 5", COUNT),
        ({"setting": "ConfL\\Off;"}, "settings of main: text was none, is ConfL\\Off", 1),
        ({"setting": "VelSet 50,500;"}, "settings of main: text was none, is VelSet 50,500", 1),
        ({"setting": "! ConfL\\Off;"}, None, 0),
    ],
)
@pytest.mark.parametrize("robot", [(), ROBOT])
def test_data_and_settings_have_the_number_of_their_moves(compared, change, words, moves, robot):
    code, lines, record = compared(module(), module(**change), *robot)
    if words is None:
        assert (code, lines) == (0, ["Nothing differs."])
        return
    assert code == 1
    assert len(lines) == 2
    count = "1 move" if moves == 1 else f"{moves} moves"
    assert lines[0].split(": ", 1)[1] == f"{words} ({count})"
    assert record["data"][0]["moves"] == moves


@pytest.mark.parametrize("robot", [(), ROBOT])
@pytest.mark.parametrize("is_back", [False, True])
def test_a_quaternion_of_length_zero_is_said_to_be_no_rotation(compared, robot, is_back):
    sides = [module(), module().replace("[0,0,1,0]", "[0,0,0,0]", 1)]
    code, lines, record = compared(*reversed(sides) if is_back else sides, *robot)
    assert code == 1
    assert ": p0: " in lines[0]
    if robot:
        assert record["targets"][0]["kind"] in ("moved", "unreachable", "reachable")
    assert "by 0.000 mm and its orientation is no rotation" in lines[0]
    assert record["targets"][0]["angle_deg"] is None
    sides = [module(), module().replace("[0,0,180],[1,0,0,0]", "[0,0,180],[0,0,0,0]")]
    code, lines, record = compared(*reversed(sides) if is_back else sides, *robot)
    words = f": tool tWeld: TCP moved by 0.000 mm, its orientation is no rotation ({COUNT} moves)"
    assert lines[0].endswith(words)
    assert record["data"][0]["frames"] == {"TCP": [0.0, None]}


def test_the_robot_may_come_first(tmp_path):
    names = [tmp_path / "old.mod", tmp_path / "new.mod"]
    for name, z in zip(names, (180, 200), strict=True):
        name.write_text(module(z=z))
    expected = run("diff", *ROBOT, *names)
    assert b"J" in expected.stdout
    assert run("diff", NAME, *names) == expected
    assert run("diff", names[0], "--json", *ROBOT, names[1]) == run("diff", "--json", NAME, *names)
    assert "a robot is given twice" in refused("diff", NAME, *names, *ROBOT)
    assert 'unknown robot "IRB 2600"' in refused("diff", "IRB 2600", *names)
    words = "give two backups and no robot, or two programs"
    assert words in refused("diff", NAME, EXAMPLE, EXAMPLE)


def test_moves_that_differ_in_one_way_are_one_line(compared):
    old = module()
    new = old.replace(",vWeld,zWeld,tWeld", ",v200,zWeld,tOther")
    code, lines, record = compared(old, new, *ROBOT)
    assert code == 1
    (line, last) = lines
    words = (
        "move to p0, p1, p2, ..: speed was vWeld, is v200, tool was tWeld, is tOther (60 moves; "
    )
    assert line.split(": ", 1)[1].startswith(words)
    assert last == "Moves: 60."
    assert record["targets"] == []


def test_moves_that_are_new_gone_or_elsewhere_are_found(compared):
    old = module()
    gone = old.replace("MoveL p7,vWeld,zWeld,tWeld;\n", "")
    assert compared(old, gone)[1][0].endswith(": move to p7: removed (1 move)")
    assert compared(gone, old)[1][0].endswith(": move to p7: added (1 move)")
    a, b = (f"MoveL p{n},vWeld,zWeld,tWeld;\n" for n in (7, 8))
    assert compared(old, old.replace(a + b, b + a))[1][0].endswith("in another order (1 move)")


def test_what_a_module_or_a_routine_has_of_its_own_hides_what_all_know():
    tool = TOOL.format(z=100, mass=1)
    move = "PROC {}()\n{}\nMoveJ pX,v100,fine,tWeld;\nENDPROC\n"
    other = f"MODULE Other\nLOCAL {tool}\n{move.format('One', '')}ENDMODULE\n"
    more = move.format("Two", f"{tool.replace('PERS', 'VAR')}")
    from irbkin.abb.differences import compared
    from irbkin.abb.sides import Side
    from irbkin.rapid.program import ModuleFile, program_of

    def side(text, z):
        text = text.replace("[0,0,100]", f"[0,0,{z}]")
        files = [
            ModuleFile("a.mod", module(more=more).encode()),
            ModuleFile("b.mod", text.encode()),
        ]
        return Side(program_of(files))

    (change,) = compared("", side(other, 100), side(other, 101)).data
    assert (change.subject, change.module, change.moves) == ("tool tWeld", "Other", 1)


def test_a_datum_of_another_type_is_another_datum(compared):
    data = TOOL.format(z=1, mass=1).replace("tWeld", "tLast")
    old = module().replace("MODULE Main", f"MODULE Main\n{data}")
    value = 'wobjdata tLast:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];'
    lines = [f"PERS {value}" if "tLast" in it else it for it in old.splitlines()]
    (change,) = compared(old, "\n".join(lines))[2]["data"]
    assert (change["subject"], change["kind"]) == ("work object tLast", "added")


def test_a_robot_that_moved_explains_all_joints(tmp_path):
    from irbkin import Robot, pose
    from irbkin.abb.differences import compared
    from irbkin.abb.sides import Side

    (file := tmp_path / "a.mod").write_text(module())
    program, robot = rapid.load_program(file), Robot(NAME)
    found = compared("", Side(program, robot), Side(program, robot.with_base(pose([0.01, 0, 0]))))
    (change,) = found.data
    assert (change.subject, change.targets, change.moves) == ("robot", COUNT, COUNT + 2)
    assert found.targets == found.moves == ()
    assert isinstance(found, abb.Difference)
