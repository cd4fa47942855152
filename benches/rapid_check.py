"""Times `irbkin check` on a module of many moves, beside json.loads of the same file.

The whole command, from the start of the process to its end, and its parts: `rapid.parse` and
`rapid.check`. Each time is the least of some repetitions, in turn. `MOVES` in the environment sets
how many; 50,000.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import irbkin
import numpy as np
from irbkin import rapid

MOVES = int(os.environ.get("MOVES", "50000"))
REPEATS = 5
ROBOT = "IRB 2600-12/1.65"
TOOL = "[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]]"
FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def program(moves: int, distance: float) -> str:
    """Lines over a table, row by row, so far apart [mm], each with a target of its own."""
    columns = int(400 / distance)
    rows, places = np.divmod(np.arange(moves), columns)
    x = 700 + (rows % 200)
    y = -200 + distance * np.where(rows % 2, columns - 1 - places, places)
    targets, lines = [], []
    for number in range(moves):
        conf = "-1,0,-1,0" if y[number] < 0 else "0,0,0,0"
        pose = f"[{x[number]:.2f},{y[number]:.2f},400],[0,0,1,0]"
        targets.append(f"    CONST robtarget p{number}:=[{pose},[{conf}],{FAR}];")
        kind = "MoveJ" if number == 0 else "MoveL"
        lines.append(f"        {kind} p{number},v200,z{5 if distance >= 10 else 1},tGun;")
    head = ["MODULE Many", f"    PERS tooldata tGun:={TOOL};"]
    return "\n".join([*head, *targets, "    PROC main()", *lines, "    ENDPROC", "ENDMODULE", ""])


def least(runs: dict[str, Callable[[], object]]) -> dict[str, float]:
    """The least time of each [s], in turn."""
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(REPEATS):
        for name, run in runs.items():
            start = time.perf_counter()
            run()
            times[name].append(time.perf_counter() - start)
    return {name: min(own) for name, own in times.items()}


def main() -> None:
    """Print a table for each distance of the targets."""
    robot = irbkin.Robot(ROBOT)
    for distance in (20.0, 100.0):
        text = program(MOVES, distance)
        module, as_json = rapid.parse(text), json.dumps(text.splitlines())
        found = rapid.check(robot, module)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "many.mod"
            file.write_text(text)
            command = [sys.executable, "-m", "irbkin", "check", "--robot", ROBOT, str(file)]
            times = least(
                {
                    "irbkin check": lambda c=command: subprocess.run(c, stdout=subprocess.PIPE),
                    "python -c 'import numpy'": lambda: subprocess.run(
                        [sys.executable, "-c", "import numpy"], check=True
                    ),
                    "rapid.parse": lambda text=text: rapid.parse(text),
                    "rapid.check": lambda module=module: rapid.check(robot, module),
                    "json.loads of its lines": lambda text=as_json: json.loads(text),
                }
            )
        print(f"{MOVES} moves {distance:.0f} mm apart, {len(text) / 1e6:.1f} MB")
        print(f"  {len(found)} diagnostics of all codes")
        for name, seconds in times.items():
            print(f"  {name:26} {seconds * 1e3:8.1f} ms  {seconds / MOVES * 1e6:7.2f} us a move")


if __name__ == "__main__":
    main()
