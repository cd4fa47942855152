"""Files of a ported program: where they are written, and what is found in them."""

import contextlib

import irbkin
import pytest
from command import refused, run
from irbkin import rapid

ARM = irbkin.Robot("IRB 1660ID-6/1.55")
SOURCE = irbkin.Robot("IRB 1600-6/1.45")
TEXT = """MODULE Seam
    PERS tooldata tGun:=[TRUE,[[60,0,350],[0.9553365,0,0.2955202,0]],[4,[0,0,120],[1,0,0,0],0,0,0]];
    CONST robtarget pStart:=[[750,-250,400],[0,1,0,0],[-1, 1 ,-1,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pEnd:=[[750,250,400],[0,1,0,0],[0,2,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveJ pStart,v100,fine,tGun;
        MoveL pEnd,v10,fine,tGun;
    ENDPROC
ENDMODULE"""


def test_a_program_is_not_ported_into_a_folder_that_is_read(tmp_path):
    source = tmp_path / "cell"
    source.mkdir()
    (source / "seam.mod").write_text(TEXT)
    call = ("port", ARM.name, source, "--from", SOURCE.name, "--to")
    assert "which is read" in refused(*call, source / "new")
    assert [path.name for path in source.iterdir()] == ["seam.mod"]
    assert run(*call, tmp_path / "new").returncode == 0


def test_what_is_wrong_with_a_file_is_said_once(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "seam.mod").write_text(TEXT)
    program = rapid.load_program([tmp_path / "a", tmp_path / "b"])
    ported = rapid.port(program, ARM, source=SOURCE, to=tmp_path / "new")
    assert len(program.findings) == 1
    (found,) = ported.program.findings
    assert found.file == str(tmp_path / "new" / "b" / "seam.mod")


def test_half_a_program_is_not_left(tmp_path, monkeypatch):
    for name in ("a.mod", "b.mod"):
        (tmp_path / name).write_text(TEXT.replace("Seam", name[0]))
    program = rapid.load_program([tmp_path / "a.mod", tmp_path / "b.mod"])
    written = []

    @contextlib.contextmanager
    def full(path):
        written.append(path)
        if len(written) == 2:
            raise OSError(28, "No space left on device")
        with open(path, "wb") as file:
            yield file

    monkeypatch.setattr("irbkin.rapid.porting.replaced", full)
    with pytest.raises(OSError, match="No space"):
        rapid.port(program, ARM, source=SOURCE, to=tmp_path / "new")
    assert len(written) == 2
    assert not (tmp_path / "new").exists()
