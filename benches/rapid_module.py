"""Times a RAPID module of many targets: read, solved, written. `TARGETS` in the environment sets
how many; 50,000.

Each time is the least of some repetitions, beside a yardstick measured in turn: the same numbers
read by json, and the same poses solved by `ik_batch`.
"""

import json
import os
import time
from collections.abc import Callable

import irbkin
import numpy as np
from irbkin import rapid

TARGETS = int(os.environ.get("TARGETS", "50000"))
REPEATS = 5
ROBOT = irbkin.Robot("IRB 2600-12/1.65")
TOOL = rapid.ToolData(tframe=rapid.Pose((0, 0, 180)))
WOBJ = rapid.WobjData(uframe=rapid.Pose((750, -300, 420)), oframe=rapid.Pose((50, 50, 25)))


def targets() -> dict[str, rapid.RobTarget]:
    """Targets with their configurations, of random joint vectors inside the limits."""
    joints = np.random.default_rng(7).uniform(*ROBOT.limits.T, (TARGETS, 6))
    return {
        f"p{number}": rapid.calc_rob_t(ROBOT, rapid.JointTarget.of(q), TOOL, WOBJ)
        for number, q in enumerate(joints)
    }


def least(run: Callable[[], object]) -> float:
    """The least time of a run [s]."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    """Prints the table."""
    data = targets()
    text = rapid.dump(data)
    numbers = json.dumps([[*t.trans_mm, *t.rot, *t.robconf, *t.extax] for t in data.values()])
    module = rapid.parse(text)
    table = rapid.calc_targets(ROBOT, module, TOOL, WOBJ)
    poses = ROBOT.fk(table.q)
    assert not any(table.findings), "every target has its joint angles"
    print(f"{TARGETS} robtargets, {len(text) / 1e6:.1f} MB")
    for what, run, yardstick, than in (
        (
            "read: parse",
            lambda: rapid.parse(text),
            lambda: json.loads(numbers),
            "json.loads of the same numbers",
        ),
        (
            "solved: calc_targets",
            lambda: rapid.calc_targets(ROBOT, module, TOOL, WOBJ),
            lambda: ROBOT.ik_batch(poses),
            "ik_batch of the same poses, all eight slots",
        ),
        (
            "written: dump",
            lambda: rapid.dump(module),
            lambda: json.dumps(json.loads(numbers)),
            "json there and back",
        ),
    ):
        own, other = least(run), least(yardstick)
        print(
            f"  {what:22} {own * 1e3:8.1f} ms  {own / TARGETS * 1e9:6.0f} ns a target  "
            f"{own / other:6.2f} x {than}"
        )


if __name__ == "__main__":
    main()
