"""`rapid.port` and `irbkin port`: a program for another arm."""

from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import Robot, rapid
from irbkin.errors import InvalidModelError, IrbkinError

OLD, NEW = Robot("IRB 1600-6/1.45"), Robot("IRB 2600-12/1.65")
NOWHERE = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def target(robot: Robot, q: np.ndarray) -> str:
    """The robtarget of joint angles, as a controller of the arm writes it."""
    own = rapid.calc_rob_t(robot, rapid.JointTarget.of(q))
    return rapid.dump(own)


def program(robot: Robot, rows: np.ndarray, moves: str, ending: str = "\n") -> bytes:
    """A module with the targets of joint angles, p0, p1, .., and moves."""
    data = [f"CONST robtarget p{n}:={target(robot, q)};" for n, q in enumerate(rows)]
    lines = ["MODULE Cell", "! größer", *data, "PROC main()", moves, "ENDPROC", "ENDMODULE"]
    return ending.join(lines).encode("latin-1")


def loaded(folder: Path, content: bytes, name: str = "cell.mod") -> rapid.Program:
    path = folder / name
    path.write_bytes(content)
    return rapid.load_program(path)


def postures(robot: Robot, seed: int, count: int) -> np.ndarray:
    """Postures in front of the arm, away from singularities."""
    rng = np.random.default_rng(seed)
    low, high = [-1.2, -0.4, -0.3, -2.5, 0.3, -2.5], [1.2, 0.6, 0.5, 2.5, 1.4, 2.5]
    return rng.uniform(low, high, (count, 6))


def codes(checked: rapid.Checked) -> set[str]:
    return {found.code for found in checked.findings}


def nearest(robot: Robot, pose: np.ndarray, old: np.ndarray) -> np.ndarray:
    """The joints inside the limits nearest to old ones, of all solutions and turns."""
    every = np.concatenate([one.q for one in [robot.ik(pose).turns()]])
    return every[np.argmin(np.square(every - old).sum(axis=1))]


@pytest.mark.parametrize("seed", range(5))
def test_each_target_has_the_posture_nearest_to_the_old_one(tmp_path: Path, seed: int) -> None:
    rows = postures(OLD, seed, 30)
    moves = "\n".join(f"MoveJ p{n},v100,fine,tool0;" for n in range(30))
    own = loaded(tmp_path, program(OLD, rows, moves))
    ported = rapid.port(own, NEW, source=OLD)
    reached = {move.line for move in own.check(NEW, codes=["R101", "R102"]).moves}
    reached -= {found.line for found in own.check(NEW, codes=["R101", "R102"]).findings}
    assert len(reached) > 20
    assert {left.line for left in ported.left}.isdisjoint(reached)
    checked = ported.program.check(NEW)
    assert not codes(checked) & {"C201", "C202", "C203", "C204"}
    for move in checked.moves:
        if move.line in reached:
            number = int(move.target.removeprefix("p"))
            pose = OLD.fk(rows[number])
            assert np.allclose(move.q, nearest(NEW, pose, rows[number]), atol=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_lines_end_with_the_confdata_that_follow_from_their_starts(
    tmp_path: Path, seed: int
) -> None:
    rows = postures(OLD, seed, 12)
    steps = ["MoveJ p0,v100,fine,tool0;"]
    for n in range(1, 12):
        steps += [f"MoveJ p{n},v100,fine,tool0;", f"MoveL Offs(p{n},20,-15,30),v100,z5,tool0;"]
    own = loaded(tmp_path, program(OLD, rows, "\n".join(steps)))
    ported = rapid.port(own, NEW, source=OLD)
    assert not codes(ported.program.check(NEW)) & {"C201", "C202"}


def test_a_program_for_its_own_arm_stays(tmp_path: Path) -> None:
    rows = postures(OLD, 7, 20)
    content = program(OLD, rows, "\n".join(f"MoveJ p{n},v100,fine,tool0;" for n in range(20)))
    ported = rapid.port(loaded(tmp_path, content), OLD, source=OLD)
    assert (ported.changed, ported.left) == (0, ())
    assert ported.program.files[0].content == content


@pytest.mark.parametrize("ending", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_nothing_but_confdata_changes(tmp_path: Path, ending: str, mark: bytes) -> None:
    rows = postures(OLD, 3, 8)
    content = program(
        OLD, rows, "\n".join(f"MoveJ p{n},v100,fine,tool0;" for n in range(8)), ending
    )
    content = mark + content.decode("latin-1").encode() if mark else content
    wrong = content.replace(b"[0,", b"[7,", 3)
    own = loaded(tmp_path, wrong)
    ported = rapid.port(own, NEW, to=tmp_path / "new", source=OLD)
    after = (tmp_path / "new" / "cell.mod").read_bytes()
    assert ported.changed > 0
    assert after != wrong
    assert mask(after) == mask(wrong)
    assert (tmp_path / "cell.mod").read_bytes() == wrong


def mask(content: bytes) -> bytes:
    """A module without its confdata."""
    import re

    return re.sub(
        rb"\],\[-?\d+,-?\d+,-?\d+,-?\d+\],\[9E", b"],[],[9E", content, flags=re.IGNORECASE
    )


def test_moves_to_one_target_share_its_confdata(tmp_path: Path) -> None:
    rows = postures(OLD, 11, 4)
    moves = "\n".join(f"MoveJ p{n % 4},v100,fine,tool0;" for n in range(12))
    ported = rapid.port(loaded(tmp_path, program(OLD, rows, moves)), NEW)
    assert not codes(ported.program.check(NEW)) & {"C201", "C202"}


def test_what_cannot_be_ported_is_listed_line_by_line(tmp_path: Path) -> None:
    text = f"""MODULE M
VAR robtarget pSearched;
PROC main()
MoveAbsJ [[0,0,0,0,30,0],{NOWHERE}],v100,fine,tool0;
MoveJ [[900,0,600],[0,0,1,0],[0,0,0,0],{NOWHERE}],v100,fine,tool0;
MoveJ [[2900,0,600],[0,0,1,0],[0,0,0,0],{NOWHERE}],v100,fine,tool0;
MoveJ [[900,0,600],[0,0,1,0],[0,0,0,0],[500,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
MoveJ pSearched,v100,fine,tool0;
ENDPROC
ENDMODULE
"""
    ported = rapid.port(loaded(tmp_path, text.encode()), NEW, source=OLD)
    reasons = {left.line: left.message for left in ported.left}
    assert list(reasons) == [4, 6, 7, 8]
    assert "joint angles of the arm before" in reasons[4]
    assert "beyond reach" in reasons[6]
    assert "eax_a is at 500" in reasons[7]
    assert "pSearched" in reasons[8]


@pytest.mark.parametrize(
    ("arm", "words"), [("UR5e", "no ABB configuration"), ("Panda", "seven joints")]
)
def test_arms_without_confdata_are_refused(tmp_path: Path, arm: str, words: str) -> None:
    own = loaded(tmp_path, program(OLD, postures(OLD, 0, 1), "MoveJ p0,v100,fine,tool0;"))
    with pytest.raises(InvalidModelError, match=words):
        rapid.port(own, Robot(arm), source=OLD)
    with pytest.raises(InvalidModelError, match=words):
        rapid.port(own, NEW, source=Robot(arm))


COUPLED = Robot("IRB 2400-10/1.55")
FORMS = {
    "arrays": "FOR i FROM 1 TO 3 DO MoveJ a{i},v100,fine,tool0; "
    "MoveL Offs(a{i},10,0,-20),v100,fine,tool0; ENDFOR",
    "arguments": "go p0; go p1; go p2;",
    "assigned": "pc:=Offs(p0,0,0,20); MoveJ p0,v100,fine,tool0; MoveL pc,v100,fine,tool0;",
    "off": "ConfJ\\Off; ConfL\\Off; MoveJ p0,v100,fine,tool0; "
    "MoveL Offs(p0,0,0,20),v100,fine,tool0; MoveJ p1,v100,fine,tool0; "
    "MoveL Offs(p1,0,0,20),v100,fine,tool0;",
    "lines": "MoveJ p0,v100,fine,tool0; MoveL p1,v100,fine,tool0; MoveJ p2,v100,fine,tool0;",
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("seed", range(6))
def test_confdata_are_found_through_arrays_arguments_and_assignments(
    tmp_path: Path, form: str, seed: int
) -> None:
    rows = postures(OLD, 100 + seed, 3)
    every = [target(OLD, q) for q in rows]
    data = [f"CONST robtarget p{n}:={own};" for n, own in enumerate(every)]
    lines = [
        "MODULE Cell",
        *data,
        f"CONST robtarget a{{3}}:=[{','.join(every)}];",
        "VAR robtarget pc;",
        f"PROC main() {FORMS[form]} ENDPROC",
        "PROC go(robtarget p) MoveJ Offs(p,0,0,30),v100,fine,tool0;",
        "MoveL p,v100,fine,tool0; ENDPROC",
        "ENDMODULE",
    ]
    own = loaded(tmp_path, "\n".join(lines).encode())
    assert rapid.port(own, OLD, source=OLD).changed == 0
    for arm in (COUPLED, NEW, Robot("IRB 1660ID-6/1.55")):
        ported = rapid.port(own, arm, source=OLD)
        checked = ported.program.check(arm)
        found = [it for it in checked.findings if it.code[0] in "RC"]
        # Lines between postures by chance may be beyond any confdata.
        if form != "lines":
            assert not {it.code for it in found} & {"C201", "C202", "C203"}
        wrong = {it.line for it in found if it.code not in ("C203", "C204")}
        # What a routine is not called with is not known.
        unknown = {it.line for it in checked.moves if it.unchecked is not None}
        assert {it.line for it in ported.left} == wrong | unknown


def test_a_line_that_ends_elsewhere_has_the_confdata_that_it_ends_with(tmp_path: Path) -> None:
    rotation = "[0.3726806,0.7718455,-0.3648212,0.3636884]"
    rows = {
        "p1": ("85.71,-564.58,831.48", "-1,-1,-2,1"),
        "p2": ("288.72,-759.49,1092.18", "-1,-3,-1,1"),
        "p3": ("43.01,-535.59,1277.63", "-1,-2,-1,1"),
    }
    data = [
        f"CONST robtarget {name}:=[[{xyz}],{rotation},[{confdata}],{NOWHERE}];"
        for name, (xyz, confdata) in rows.items()
    ]
    moves = ["MoveJ p1,v100,fine,tool0;", "MoveL p2,v100,fine,tool0;", "MoveL p3,v100,fine,tool0;"]
    text = "\n".join(["MODULE M", *data, "PROC main()", *moves, "ENDPROC", "ENDMODULE"])
    ported = rapid.port(loaded(tmp_path, text.encode()), COUPLED, source=OLD)
    assert codes(ported.program.check(COUPLED)) == {"R104"}
    (left,) = ported.left
    assert "on the spot" in left.message


def test_a_confdata_on_the_edge_of_a_quarter_stays(tmp_path: Path) -> None:
    move = f"MoveJ [[900,-0.001,700],[0,0,1,0],[0,0,0,0],{NOWHERE}],v100,fine,tool0;"
    own = loaded(tmp_path, f"MODULE M\nPROC main()\n{move}\nENDPROC\nENDMODULE".encode())
    assert rapid.port(own, OLD, source=OLD).changed == 0


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    content = program(OLD, postures(OLD, 0, 1), "MoveJ p0,v100,fine,tool0;")
    own = loaded(tmp_path, content)
    for folder in (tmp_path, tmp_path / "cell.mod"):
        with pytest.raises(FileExistsError, match="a new or an empty folder"):
            rapid.port(own, NEW, to=folder)
    assert [it.name for it in tmp_path.iterdir()] == ["cell.mod"]


def test_folders_are_kept_below_the_one_in_common(tmp_path: Path) -> None:
    for name in ("PROGMOD", "SYSMOD"):
        (tmp_path / name).mkdir()
    content = program(OLD, postures(OLD, 0, 1), "MoveJ p0,v100,fine,tool0;")
    (tmp_path / "PROGMOD" / "cell.mod").write_bytes(content)
    (tmp_path / "SYSMOD" / "user.sys").write_bytes(b"MODULE user\nENDMODULE")
    ported = rapid.port(rapid.load_program(tmp_path), NEW, to=tmp_path / "new", source=OLD)
    assert (tmp_path / "new" / "SYSMOD" / "user.sys").read_bytes() == b"MODULE user\nENDMODULE"
    assert repr(ported).startswith("Ported(Program(2 modules, 1 moves, 0 findings), ")
    assert [it.path for it in ported.program.files] == [
        str(tmp_path / "new" / "PROGMOD" / "cell.mod"),
        str(tmp_path / "new" / "SYSMOD" / "user.sys"),
    ]


def test_a_file_that_is_no_text_is_not_rewritten(tmp_path: Path) -> None:
    content = program(OLD, postures(OLD, 0, 1), "MoveJ p0,v100,fine,tool0;")
    # A mark of UTF-8 before bytes that are Latin-1.
    own = loaded(tmp_path, b"\xef\xbb\xbf" + content)
    with pytest.raises(IrbkinError, match=r"cell.mod: has bytes that are no utf-8 text"):
        rapid.port(own, NEW, to=tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_the_command_lists_what_is_left_and_checks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from irbkin.cli import main

    monkeypatch.chdir(tmp_path)
    Path("cell.mod").write_bytes(program(OLD, postures(OLD, 0, 2), "MoveJ p0,v100,fine,tool0;"))
    given = ["port", NEW.name, "cell.mod", "--from", OLD.name]
    assert main([*given, "--to", "new"]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"{NEW.name} instead of {OLD.name}: 1 file in new, ")
    assert "All checks passed!" in out
    assert main(["diff", NEW.name, "cell.mod", "new"]) in (0, 1)
    assert main([*given, "--to", "new"]) == 2
    assert "new: is there already" in capsys.readouterr().err
    for wrong in (["port", NEW.name, "-", "--to", "x"], ["port", "IRB 9", "cell.mod", "--to", "x"]):
        assert main(wrong) == 2
    Path("none.mod").write_text("MODULE none\nENDMODULE")
    assert main(["port", NEW.name, "none.mod", "--to", "x"]) == 2
    assert "no instruction moves" in capsys.readouterr().err
    assert not Path("x").exists()


def test_the_names_are_public() -> None:
    assert irbkin.rapid.port is rapid.port
    assert {"port", "Ported", "LeftMove"} <= set(rapid.__all__)
