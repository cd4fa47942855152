"""Wall time of one call of the command `irbkin`, beside the import of NumPy.

The calls run in turn with `python -c "import numpy"`, so that both meet the same load. Medians;
the difference is what a call adds to NumPy's import. `CALLS` in the environment sets how many; 20.
"""

import os
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


def seconds(command: list[str]) -> float:
    """The wall time of a process."""
    start = time.perf_counter()
    done = subprocess.run(command, capture_output=True)
    elapsed = time.perf_counter() - start
    assert done.returncode == 0, done.stderr.decode()
    return elapsed


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "short.mod"
        file.write_text(MODULE)
        runs = {"python -c 'import numpy'": [sys.executable, "-c", "import numpy"]}
        for name, words in VERBS.items():
            extra = [str(file)] if name in ("check", "rapid") else []
            runs[f"irbkin {name}"] = [sys.executable, "-m", "irbkin", *words, *extra]
        times: dict[str, list[float]] = {name: [] for name in runs}
        for _ in range(CALLS):
            for name, command in runs.items():
                times[name].append(seconds(command))
    numpy, *_ = (statistics.median(own) for own in times.values())
    print(f"median of {CALLS} calls in turn [ms]      wall   beyond NumPy's import")
    for name, own in times.items():
        median = statistics.median(own)
        print(f"  {name:36} {median * 1e3:7.1f} {(median - numpy) * 1e3:+10.1f}")


if __name__ == "__main__":
    main()
