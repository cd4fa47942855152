"""The command `irbkin` as a process: pipes, signals, files, memory, and no traceback."""

import glob
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from command import COMMAND, NAME, refused, run
from irbkin.cli import errors, files, progress


@pytest.mark.parametrize("words", [["catalog"], ["fk", NAME, "-", "--csv"], ["fk", NAME, "-"]])
def test_a_closed_pipe_is_no_error(words):
    command = shlex.join([*COMMAND, *words])
    rows = "np.savetxt(sys.stdout, np.zeros((100000, 6)), fmt='%d', delimiter=',')"
    source = f"{sys.executable} -c {shlex.quote('import sys, numpy as np; ' + rows)} 2>/dev/null"
    done = subprocess.run(
        ["bash", "-c", f"{source} | {command} | head -1; echo ${{PIPESTATUS[1]}}"],
        capture_output=True,
        timeout=60,
    )
    assert done.stderr == b""
    first, code = done.stdout.decode().splitlines()
    assert first
    assert int(code) in (0, errors.CLOSED_PIPE)
    assert int(code) == errors.CLOSED_PIPE or words == ["catalog"]


def is_writing(process, folder):
    """Whether it has a new file in a folder, or one that has no name yet (Linux's O_TMPFILE)."""
    opened = glob.glob(f"/proc/{process.pid}/fd/*")
    links = [os.readlink(it) for it in opened if os.path.islink(it)]
    return len(list(folder.iterdir())) > 1 or any(it.startswith(f"{folder}/#") for it in links)


@pytest.mark.parametrize(
    ("number", "code", "words"),
    [(signal.SIGINT, 130, b"irbkin: interrupted\n"), (signal.SIGTERM, 143, b"")],
)
def test_a_signal_leaves_no_traceback_and_no_half_written_file(number, code, words, tmp_path):
    file = tmp_path / "poses.csv"
    file.write_text("as it was\n")
    command = [*COMMAND, "fk", NAME, "-", "-o", str(file)]
    process = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stderr=subprocess.PIPE,
        # A shell's background job ignores it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    process.stdin.write(b"0,0,0,0,30,0\n" * 20_000)
    process.stdin.flush()
    deadline = time.monotonic() + 30
    while not is_writing(process, tmp_path) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert is_writing(process, tmp_path)
    process.send_signal(number)
    _, stderr = process.communicate(timeout=30)
    assert process.returncode == code
    assert stderr == words
    assert [it.name for it in tmp_path.iterdir()] == ["poses.csv"]
    assert file.read_text() == "as it was\n"


def test_a_file_is_replaced_only_when_it_is_whole(tmp_path):
    file, link = tmp_path / "poses.csv", tmp_path / "link.csv"
    file.write_text("as it was\n")
    file.chmod(0o640)
    link.symlink_to(file)
    refused("fk", NAME, "-", "-o", file, stdin="0,0,0,0,30,0\n" * 50 + "x,0,0,0,0,0\n")
    assert file.read_text() == "as it was\n"
    assert run("fk", NAME, *[0] * 6, "-o", link).returncode == 0
    assert link.is_symlink()
    assert file.read_text().startswith("x_mm,")
    assert file.stat().st_mode & 0o777 == 0o640
    assert sorted(it.name for it in tmp_path.iterdir()) == ["link.csv", "poses.csv"]


def test_what_cannot_be_written_is_one_line(tmp_path):
    assert "is a folder" in refused("fk", NAME, *[0] * 6, "-o", tmp_path)
    assert "cannot be written" in refused("fk", NAME, *[0] * 6, "-o", tmp_path / "no" / "a.csv")
    if Path("/sys/kernel").exists():
        # Nobody writes there, root neither.
        assert "/sys/a.csv: cannot be written" in refused("fk", NAME, *[0] * 6, "-o", "/sys/a.csv")
    if Path("/dev/full").exists():
        with open("/dev/full", "wb") as full:
            done = subprocess.run(
                [*COMMAND, "catalog"], stdout=full, stderr=subprocess.PIPE, timeout=60
            )
        assert done.returncode == 2
        assert done.stderr == b"irbkin: [Errno 28] No space left on device\n"


def test_closed_streams_are_no_traceback():
    for closed, name in ((">&-", "stdout"), ("<&-", "stdin")):
        command = shlex.join([*COMMAND, "fk", NAME, "-"])
        done = subprocess.run(
            ["bash", "-c", f"{command} {closed}"],
            capture_output=True,
            stdin=subprocess.DEVNULL,
            timeout=60,
        )
        assert done.returncode == 2, closed
        assert done.stderr == f"irbkin: {name} is closed\n".encode()


def test_rows_before_a_broken_one_are_written_before_the_message():
    content = "0,0,0,0,30,0\n" * 200_000 + "x,0,0,0,0,0\n"
    command = [*COMMAND, "fk", NAME, "-", "--csv"]
    done = subprocess.run(
        command,
        input=content.encode(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=60,
    )
    *lines, last = done.stdout.decode().splitlines()
    assert last == "irbkin: stdin:200001:1: 'x' is not a finite number"
    assert len(lines) > 100_000
    assert len({line.count(",") for line in lines}) == 1


def peak_memory(count, tmp_path):
    """The most memory that `fk` of so many rows takes [MB]."""
    code = (
        "import resource, sys; from irbkin.cli import main; "
        f"code = main(['fk', {NAME!r}, '-', '-o', sys.argv[1]]); "
        "print(code, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code, str(tmp_path / "poses.npy")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    part = b"10,20,-30.5,40,50,60\n" * 100_000
    for _ in range(count // 100_000):
        process.stdin.write(part)
    stdout, _ = process.communicate(timeout=120)
    code, memory = stdout.split()
    assert code == b"0"
    assert np.load(tmp_path / "poses.npy", mmap_mode="r").shape == (count, 4, 4)
    return float(memory)


@pytest.mark.skipif(sys.platform != "linux", reason="the unit of ru_maxrss differs")
def test_memory_does_not_grow_with_the_rows(tmp_path):
    few, many = peak_memory(200_000, tmp_path), peak_memory(1_500_000, tmp_path)
    # 1.3 million rows more would be 62 MB as joint angles and 166 MB as poses.
    assert many < few + 15.0


def test_progress_has_its_rate_and_remaining_time_on_a_terminal(monkeypatch, capsys):
    monkeypatch.setattr(progress, "AFTER", 0.0)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    # Where nothing is known of a terminal, rich writes the last state alone, without escapes.
    monkeypatch.setenv("TTY_COMPATIBLE", "0")
    with progress.Progress("rows", 200) as bar:
        time.sleep(0.01)
        bar.add(100)
        assert not bar.bar.finished
        (task,) = bar.bar.tasks
        assert (task.completed, task.total, task.description) == (100, 200, "rows")
        row = "".join(str(own.render(task)) for own in bar.bar.columns if hasattr(own, "render"))
        assert "100/200" in row
        assert re.search(r"-:--:--|\d:\d\d", row)
        assert float(task.fields["rate"].replace(",", "")) > 0.0
    monkeypatch.setattr(sys.stderr, "isatty", lambda: False)
    capsys.readouterr()
    with progress.Progress("rows") as bar:
        bar.add(100)
        assert bar.bar is None
    assert capsys.readouterr().err == ""


def test_the_total_of_an_array_is_known(monkeypatch, tmp_path):
    np.save(tmp_path / "q.npy", np.zeros((5, 6)))
    totals = []
    monkeypatch.setattr(progress.Progress, "add", lambda _, count, total=None: totals.append(total))
    assert run("fk", NAME, tmp_path / "q.npy").returncode == 0
    assert run("fk", NAME, "-", stdin="0,0,0,0,0,0\n").returncode == 0
    assert totals == [5, None]


def test_an_error_of_our_own_is_one_line(capsys, monkeypatch):
    def fail():
        raise ZeroDivisionError("of\ntwo lines")

    monkeypatch.delenv("IRBKIN_TRACEBACK", raising=False)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    assert errors.guarded(fail) == 2
    message = capsys.readouterr().err
    assert message.startswith("irbkin: internal error, please report it (ZeroDivisionError: of two")
    assert message.count("\n") == 1


def test_a_pipe_is_written_directly(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = subprocess.Popen(["cat", str(pipe)], stdout=subprocess.PIPE)
    with files.replaced(str(pipe)) as file:
        file.write(b"rows")
    assert reader.communicate(timeout=30)[0] == b"rows"
    assert [it.name for it in tmp_path.iterdir()] == ["pipe"]
