"""What a person sees of `make`: progress, and no warnings that mean nothing."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
STEP = ROOT / "tests" / "step.sh"
pytestmark = pytest.mark.skipif(
    any(shutil.which(it) is None for it in ("bash", "make")), reason="no make or bash"
)


def step(*words):
    environment = {**os.environ, "STEP_SECONDS": "1"}
    return subprocess.run(
        [STEP, *words], capture_output=True, text=True, env=environment, timeout=60
    )


def test_progress_counts_the_crates_that_cargo_compiles():
    bar = r"    Building [====>    ]  7/43: nalgebra, irbkin(test)\r"
    done = step("-q", "Step", "sh", "-c", f"printf '   Compiling x\\n{bar}' >&2; sleep 2.5")
    first, *lines = done.stderr.splitlines()
    assert first == "== Step"
    assert lines
    assert all(
        line.startswith("   Step, ") and line.endswith(" s, 7 of 43 crates") for line in lines
    )
    assert done.returncode == 0


def test_what_a_quiet_step_prints_is_shown_if_it_fails():
    done = step("-q", "Step", "sh", "-c", "echo broken; echo here >&2; exit 3")
    assert done.returncode == 3
    assert done.stderr == "== Step\nbroken\nhere\n"
    assert done.stdout == ""


@pytest.mark.skipif(shutil.which("rustc") is None, reason="no rustc")
def test_no_compiler_warns_of_the_jobs_of_make():
    rules = "include Makefile\nprobe:\n\t@rustc --print sysroot"
    done = subprocess.run(
        ["make", "-j3", "-f", "-", "probe"],
        cwd=ROOT, input=rules, capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0
    assert done.stderr == ""
