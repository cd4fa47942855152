"""Files that irbkin writes: whole or not at all, where the caller says, as their owner wants."""

import ast
import os
import re
import stat
import subprocess
import sys
from pathlib import Path

import irbkin
import numpy as np
import pytest
from command import NAME, ROBOT, run
from irbkin import _files, scene, trajectory
from irbkin.check import fixes
from irbkin.cli import VERBS, parser_of
from test_check import SEAM

PACKAGE = Path(irbkin.__file__).parent
T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
MOVE = trajectory.joint(np.zeros(6), np.full(6, 0.1), max_velocity=1.0, max_acceleration=9.0)
XYZ = ["--xyz", 850, 320, 640]


def by_command(*arguments):
    """A writer of the command."""

    def write(path):
        done = run(*arguments, "-o", path, stdin=SEAM)
        if done.returncode == 2:
            raise OSError(done.stderr.decode())

    return write


EXAMPLE = PACKAGE.parents[1] / "examples" / "pick_and_place.mod"
WRITERS = {
    "scene.json": lambda path: scene.of(ROBOT).save(path),
    "move.csv": MOVE.to_csv,
    "move.csv.gz": MOVE.to_csv,
    "solutions.csv": by_command("ik", NAME, *XYZ),
    "solutions.json": by_command("ik", NAME, *XYZ),
    "solutions.npy": by_command("ik", NAME, *XYZ),
    "arms.csv": by_command("catalog"),
    "poses.csv": by_command("fk", NAME, 10, 20, 10, 0, 30, 0),
    "moves.csv": by_command("rapid", NAME, "-"),
    "study.csv": by_command("arms", EXAMPLE, "--arm", NAME),
    "picture.svg": by_command("view", NAME),
    "arm.urdf": by_command("urdf", NAME),
    "arm.json": by_command("view", NAME),
    "report.txt": by_command("check", "--robot", NAME, PACKAGE.parents[1] / "examples"),
}


@pytest.fixture
def umask():
    old = os.umask(0o022)
    yield
    os.umask(old)


@pytest.mark.parametrize("name", WRITERS)
def test_nothing_is_written_through_a_link_out_of_the_folder(tmp_path, name):
    (here := tmp_path / "here").mkdir()
    (precious := tmp_path / "precious").write_text("precious")
    for number in (os.getpid(), *range(1, 200)):
        for foretold in (f".{name}.{number}.part", f"{Path(name).stem}.{number}.tmp"):
            if not (here / foretold).is_symlink():
                (here / foretold).symlink_to(precious)
    count = len(list(here.iterdir()))
    WRITERS[name](here / name)
    assert not (here / name).is_symlink()
    assert len(list(here.iterdir())) == count + 1
    (here / name).unlink()
    for target in (precious, tmp_path / "absent"):
        (here / name).symlink_to(target)
        with pytest.raises((OSError, ValueError), match="link out of its folder"):
            WRITERS[name](here / name)
        assert (here / name).is_symlink()
        (here / name).unlink()
    assert precious.read_text() == "precious"
    assert sorted(it.name for it in tmp_path.iterdir()) == ["here", "precious"]


@pytest.mark.parametrize("name", WRITERS)
def test_permissions_are_kept_whatever_the_umask_is(tmp_path, umask, name):
    WRITERS[name](file := tmp_path / name)
    assert stat.S_IMODE(file.stat().st_mode) == 0o644
    for mode in (0o666, 0o664, 0o640, 0o600, 0o755):
        file.chmod(mode)
        WRITERS[name](file)
        assert stat.S_IMODE(file.stat().st_mode) == mode
    if os.geteuid() == 0:
        os.chown(file, 65534, 65533)
        WRITERS[name](file)
        assert (file.stat().st_uid, file.stat().st_gid) == (65534, 65533)
    old = file.read_bytes()
    file.chmod(0o444)
    with pytest.raises(OSError, match="is read-only: make it writable"):
        WRITERS[name](file)
    assert file.read_bytes() == old
    assert [it.name for it in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("name", WRITERS)
def test_on_a_full_disk_the_old_file_is_whole(tmp_path, name):
    file = tmp_path / name
    file.write_bytes(b"as it was")
    # Files may have 100 bytes.
    code = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
    code += "import resource, signal, test_files\nsignal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
    code += "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
    code += f"try: test_files.WRITERS[{name!r}]({str(file)!r})\n"
    code += "except OSError as error: assert 'written: File too large' in str(error); sys.exit(3)"
    done = subprocess.run(
        [sys.executable, "-B", "-c", code], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 3, done.stderr
    left = {it.name for it in tmp_path.rglob("*") if it.is_file()}
    assert left == {name}
    assert file.read_bytes() == b"as it was"


def opened_to_write(call):
    """Whether a call opens, moves or copies a file that is then another one."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    of = getattr(getattr(call.func, "value", None), "id", "")
    if name in ("write_text", "write_bytes", "tofile", "copyfile", "symlink_to", "touch"):
        return True
    if of in ("os", "shutil") and name in ("open", "replace", "rename", "link", "copy", "move"):
        return ast.unparse(call.args[0]) != "os.devnull"
    if name not in ("open", "fdopen"):
        return False
    given = call.args[name == "fdopen" or isinstance(call.func, ast.Name) :][:1]
    modes = [*given, *(it.value for it in call.keywords if it.arg == "mode")]
    # A mode that is calculated may be any; methods of the package's own take texts and options.
    texts = [it.value for it in modes if isinstance(it, ast.Constant)]
    is_own = isinstance(call.func, ast.Name) or of == "os"
    return any(set(str(it)) & set("wax+") for it in texts) or (is_own and len(texts) < len(modes))


def calls(file):
    tree = ast.parse(file.read_text(encoding="utf-8"))
    return [node for node in ast.walk(tree) if isinstance(node, ast.Call)]


def test_only_one_module_of_the_package_writes_files():
    found = {
        file.relative_to(PACKAGE).as_posix()
        for file in PACKAGE.rglob("*.py")
        if any(map(opened_to_write, calls(file)))
    }
    # An archive is unpacked into a temporary folder; the server of editors and a reader in its own
    # process take stdout.
    assert found == {"_bounded.py", "_files.py", "abb/folders.py", "lsp/__init__.py"}


@pytest.mark.parametrize(
    ("text", "is_writing"),
    [
        *(
            (it, False)
            for it in ("open(p)", "open(p, 'rb')", "queue.open(p, options)", "p.open('rb')")
        ),
        *(
            (it, True)
            for it in ("open(p, 'w')", "open(p, mode='ab')", "open(p, kind)", "p.open('x')")
        ),
        *((it, True) for it in ("open(p, 'r+')", "p.write_text(t)", "os.replace(a, b)")),
        *((it, True) for it in ("os.fdopen(h, 'wb')", "os.open(p, flags)", "shutil.move(a, b)")),
    ],
)
def test_calls_that_write_files_are_known(text, is_writing):
    assert opened_to_write(ast.parse(text, mode="eval").body) == is_writing


def test_what_libraries_write_goes_through_it():
    names = {"save", "savez", "savetxt", "savefig", "write_image", "to_csv", "to_file", "export"}
    found = {
        (file.relative_to(PACKAGE).as_posix(), call.func.attr, ast.unparse(call.args[0]))
        for file in PACKAGE.rglob("*.py")
        for call in calls(file)
        if isinstance(call.func, ast.Attribute) and call.func.attr in names
    }
    assert found == {
        # Files of `replaced`, or in memory.
        ("plot.py", "savefig", "file"),
        # A scene, which is a writer above.
        ("cli/view.py", "save", "output"),
    }


def test_every_verb_with_an_output_is_a_writer_above():
    own = set(re.findall(r'by_command\("(\w+)"', Path(__file__).read_text(encoding="utf-8")))
    found = set()
    for verb in VERBS:
        actions = parser_of(verb)._actions
        if "-o" in {option for it in actions for option in it.option_strings}:
            found.add(verb)
    assert own == found


def fix(*arguments):
    return run("check", "--robot", NAME, "--fix", *arguments)


def test_an_edit_that_comes_during_the_check_is_kept(tmp_path, monkeypatch):
    (file := tmp_path / "seam.mod").write_text(SEAM)
    corrected = fixes.corrected

    def edited(*arguments):
        with file.open("a") as stream:
            stream.write("! an edit\n")
        return corrected(*arguments)

    monkeypatch.setattr(fixes, "corrected", edited)
    done = fix(file)
    assert done.returncode == 2
    assert b"seam.mod: has changed since it was read" in done.stderr
    assert file.read_text() == SEAM + "! an edit\n"
    monkeypatch.undo()
    assert b"fixed" in fix(file).stdout
    assert file.read_text() not in (SEAM, SEAM + "! an edit\n")
    assert file.read_text().endswith("! an edit\n")
    assert [it.name for it in tmp_path.iterdir()] == ["seam.mod"]


def test_corrections_go_to_no_file_behind_a_link_or_lock(tmp_path):
    (tmp_path / "own").mkdir()
    (tmp_path / "sub").mkdir()
    (outside := tmp_path / "own" / "seam.mod").write_text(SEAM)
    (link := tmp_path / "sub" / "seam.mod").symlink_to("../own/seam.mod")
    (pgf := tmp_path / "sub" / "p.pgf").write_text("<Module>seam.mod</Module>")
    done = fix(link)
    assert done.returncode == 2
    assert b"is a link out of its folder: give" in done.stderr
    assert b"seam.mod: is a link out of the folder: it is not read" in fix(pgf).stdout
    assert outside.read_text() == SEAM
    outside.chmod(0o444)
    done = fix(outside)
    assert done.returncode == 2
    assert b"is read-only" in done.stderr
    assert outside.read_text() == SEAM


def test_a_file_is_on_the_disk_before_it_has_its_name(tmp_path, monkeypatch):
    calls = []

    def counted(name, real):
        return lambda *arguments: (calls.append(name), real(*arguments))

    for name in ("fsync", "replace"):
        monkeypatch.setattr(os, name, counted(name, getattr(os, name)))
    with _files.replaced(tmp_path / "a") as file:
        file.write(b"rows")
    assert calls == ["fsync", "replace"]


def test_a_file_of_several_names_keeps_them(tmp_path):
    file, other = tmp_path / "seam.mod", tmp_path / "other.mod"
    file.write_text(SEAM)
    os.link(file, other)
    run("check", NAME, "--fix", file)
    assert file.samefile(other)
    assert file.read_text() == other.read_text() != SEAM
    assert sorted(os.listdir(tmp_path)) == ["other.mod", "seam.mod"]


@pytest.mark.skipif(not hasattr(os, "setxattr"), reason="needs extended attributes")
def test_extended_attributes_are_kept(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    try:
        os.setxattr(file, "user.origin", b"cell 3")
    except OSError:
        pytest.skip("the file system has no extended attributes")
    run("check", NAME, "--fix", file)
    assert file.read_text() != SEAM
    assert os.getxattr(file, "user.origin") == b"cell 3"


@pytest.mark.skipif(not hasattr(os, "O_TMPFILE"), reason="needs files without a name")
def test_a_killed_process_leaves_nothing(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    words = (
        "import sys, time\n"
        "from irbkin._files import replaced\n"
        "with replaced(sys.argv[1]) as file:\n"
        "    file.write(b'rows' * 10_000)\n"
        "    file.flush()\n"
        "    print(flush=True)\n"
        "    time.sleep(60)\n"
    )
    command = [sys.executable, "-c", words, str(file)]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        process.stdout.readline()
        process.kill()
    assert os.listdir(tmp_path) == ["seam.mod"]
    assert file.read_text() == SEAM
