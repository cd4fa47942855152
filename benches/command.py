"""Wall time of one call of the command `irbkin`, beside the import of NumPy.

The calls run in turn with `python -c "import numpy"`, so that both meet the same load. The least
and the median of the wall times, and the least time of the processor; the differences are what a
call adds to NumPy's import. `CALLS` in the environment sets how many; 20.
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CALLS = int(os.environ.get("CALLS", "20"))
ROBOT = "IRB 2600-12/1.65"
VERBS = {
    "--version": ["--version"],
    "catalog NAME": ["catalog", ROBOT],
    "fk": ["fk", ROBOT, *["0", "0", "0", "0", "30", "0"]],
    "ik": ["ik", ROBOT, *["--xyz", "850", "320", "640", "--wxyz", "0.2588", "0", "0.9659", "0"]],
    "check": ["check", "--robot", ROBOT],
    "rapid": ["rapid", ROBOT],
}
MODULE = """MODULE Short
    CONST robtarget p:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveJ p,v1000,fine,tool0;
    ENDPROC
ENDMODULE
"""


def times_of(command: list[str]) -> tuple[float, float]:
    """The wall time of a process and its time of the processor [ms]."""
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True)
    elapsed, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    assert done.returncode == 0, done.stderr.decode()
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return elapsed * 1e3, used * 1e3


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "short.mod"
        file.write_text(MODULE)
        script = Path(sys.executable).with_name("irbkin")
        irbkin = [str(script)] if script.exists() else [sys.executable, "-m", "irbkin"]
        runs = {"python -c 'import numpy'": [sys.executable, "-c", "import numpy"]}
        for name, words in VERBS.items():
            extra = [str(file)] if name in ("check", "rapid") else []
            runs[f"irbkin {name}"] = [*irbkin, *words, *extra]
        times: dict[str, list[tuple[float, float]]] = {name: [] for name in runs}
        for _ in range(CALLS):
            for name, command in runs.items():
                times[name].append(times_of(command))
    print(f"{CALLS} calls in turn [ms]          least            median         processor")
    base: tuple[float, float, float] | None = None
    for name, own in times.items():
        wall, used = zip(*own, strict=True)
        figures = (min(wall), statistics.median(wall), min(used))
        base = base or figures
        shown = (f"{it:7.1f} {it - of:+7.1f}" for it, of in zip(figures, base, strict=True))
        print(f"  {name:26} {'  '.join(shown)}")


if __name__ == "__main__":
    main()
