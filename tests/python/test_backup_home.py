"""Modules in HOME that are not what was loaded."""

import pytest
from backups import MODULE, SMALL, backinfo, cfg, written
from irbkin.abb import load_backup

LOADED = "MODULE Main\n  PROC main()\n    Stop;\n  ENDPROC\nENDMODULE\n"
MAIN = "RAPID/TASK1/PROGMOD/Main.mod"


def notes(folder, files, main=LOADED):
    """The findings on a backup with these files, as texts."""
    own = load_backup(written(folder, {**SMALL, MAIN: main, **files}))
    return [str(it) for it in own.findings]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (LOADED, None),
        (LOADED.replace("\n", "\r\n"), None),
        (LOADED.replace("\n", " \t\n") + "\n\n", None),
        (LOADED.replace("Stop", "Break"), 3),
        (LOADED.replace("Stop", "STOP"), 3),
        (LOADED.replace("    Stop", "  Stop"), 3),
        (LOADED.replace("ENDMODULE\n", ""), 4),
        (LOADED + "! end\n", 6),
    ],
)
@pytest.mark.parametrize("name", ["Main.mod", "main.MOD"])
def test_a_file_in_home_has_the_text_that_was_loaded(tmp_path, name, text, line):
    found = notes(tmp_path, {f"HOME/{name}": text})
    first = 5 if line == 4 else line
    message = f"differs from {MAIN}, which was loaded, in line {first} first [home-differs]"
    assert found == ([f"HOME/{name}:{line}: note: {message}"] if line else [])


@pytest.mark.parametrize(
    "name", ["HOME:/Cell/Main.mod", "Home:\\cell\\MAIN.MOD", "HOME:Cell/Main.mod"]
)
def test_the_file_counts_that_the_configuration_loads(tmp_path, name):
    task = '-Name "T_ROB1" -Type "NORMAL" -MotionTask'
    files = {
        "SYSPAR/SYS.cfg": cfg("SYS", "6:0", CAB_TASKS=[task], CAB_TASK_MODULES=[f'-File "{name}"']),
        "HOME/Main.mod": MODULE,
    }
    assert not notes(tmp_path, {**files, "HOME/Cell/Main.mod": LOADED})
    (own,) = notes(tmp_path, {**files, "HOME/Cell/Main.mod": MODULE, "HOME/Main.mod": LOADED})
    assert own.startswith(f"HOME/Cell/Main.mod:2: note: differs from {MAIN}, which was loaded")


def test_older_copies_and_other_files_in_home_are_not_compared(tmp_path):
    files = {"HOME/Saved/RAPID/TASK1/PROGMOD/Main.mod": MODULE, "HOME/Other.mod": MODULE}
    assert not notes(tmp_path, {**files, "HOME/old/Main.mod": MODULE})
    assert not notes(tmp_path / "folder", {"HOME/Main.mod/x.txt": ""})
    assert not notes(tmp_path / "file", {"HOME": "no folder"})


def test_a_file_that_one_of_two_tasks_has_loaded_does_not_differ(tmp_path):
    files = {
        "BACKINFO/backinfo.txt": backinfo(("T_ROB1",), ("T_ROB2",)),
        "RAPID/TASK2/PROGMOD/Main.mod": MODULE,
    }
    assert "home-differs" not in str(notes(tmp_path, {**files, "HOME/Main.mod": MODULE}))
    other = notes(tmp_path, {**files, "HOME/Main.mod": MODULE + "!"})
    assert sum("home-differs" in it for it in other) == 1
