"""Times of trajectories and paths, against other packages where they are installed.

Each time is the least of many calls from Python to arrays, in one run. Packages: roboticstoolbox
(`jtraj`), toppra, ruckig; one that is missing is named and left out. `MOVES` in the environment
sets how many moves the RAPID routine has; 50,000.
"""

from __future__ import annotations

import importlib
import os
import time
from collections.abc import Callable
from types import ModuleType

import irbkin
import numpy as np
from irbkin import paths, rapid, trajectory

START = np.radians([0, -90, 0, 0, 90, -180])
END = np.radians([90, -100, 40, 10, 60, -120])


def least(call: Callable[[], object], calls: int) -> float:
    """The least time of a call [us]."""
    times = []
    for _ in range(calls):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return min(times) * 1e6


def installed(name: str) -> ModuleType | None:
    """A package, or none."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        print(f"{name} is left out: {error}")
        return None


def show(what: str, own: float, other: float | None = None, than: str = "") -> None:
    """A row of the table."""
    against = "" if other is None else f"{other:12.1f}{own / other:8.3f} x {than}"
    print(f"{what:44}{own:10.1f}{against}")


def toppra_of(
    q: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray, points: int | None
) -> Callable[[], object]:
    """A call that retimes a path with toppra, on the same spline: on a grid of so many points, or
    as toppra does by default.
    """
    import toppra
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")
    lengths = np.r_[0, np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))]

    grid = {
        "gridpoints": np.linspace(0, lengths[-1], points or 2),
        "parametrizer": "ParametrizeConstAccel",
    }

    def call() -> object:
        return algorithm.TOPPRA(
            [
                constraint.JointVelocityConstraint(np.c_[-velocity, velocity]),
                constraint.JointAccelerationConstraint(np.c_[-acceleration, acceleration]),
            ],
            toppra.SplineInterpolator(lengths, q),
            **(grid if points else {}),
        ).compute_trajectory()

    return call


def excess(dq: np.ndarray, ddq: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray) -> str:
    """How far limits are exceeded, as a part of them."""
    parts = (np.abs(dq) / velocity).max() - 1, (np.abs(ddq) / acceleration).max() - 1
    return f"velocity {parts[0]:+.1e}, acceleration {parts[1]:+.1e}"


def routine(moves: int) -> rapid.Module:
    """A seam of short lines with rounded corners, and of turns of the tool."""
    i = np.arange(moves)
    x, z = 900 + 200 * np.sin(i * 2 * np.pi / 97), 600 + 50 * np.cos(i * 2 * np.pi / 53)
    y, half = -300 + 600 * i / moves, 0.1 * np.sin(i * 2 * np.pi / 71)
    lines = [
        f"MoveL [[{x:.2f},{y:.2f},{z:.2f}],[0,{a:.9f},{b:.9f},0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]],v200,z5,tGun;"
        for x, y, z, a, b in zip(x, y, z, np.sin(half), np.cos(half), strict=True)
    ]
    tool = rapid.dump(rapid.ToolData(tframe=rapid.Pose((0, 0, 180))))
    return rapid.parse(
        f"MODULE Seam\nPERS tooldata tGun:={tool};\nPROC main()\nConfL\\Off;\n"
        + "\n".join(lines)
        + "\nENDPROC\nENDMODULE"
    )


def show_routine(robot: irbkin.Robot, moves: int) -> None:
    """The row of a routine as one motion, against the same poses solved and not timed."""
    seam = routine(moves)
    poses = robot.fk(rapid.motion(robot, seam).q)

    def call() -> object:
        motion = rapid.motion(robot, seam)
        return motion.t, motion.q, motion.move_index, motion.lines, motion.findings

    own, other = least(call, 3), least(lambda: robot.ik_batch(poses), 3)
    show(f"{moves:,} moves of RAPID, {len(poses):,} samples", own, other, "ik_batch of as many")


def main() -> None:
    """Print the table."""
    toolbox, toppra = installed("roboticstoolbox"), installed("toppra")
    robot = irbkin.Robot("IRB 2600-12/1.65")
    assert robot.max_velocity is not None
    velocity, acceleration = robot.max_velocity, 5 * robot.max_velocity
    print(f"{'us':44}{'irbkin':>10}{'other':>12}")
    for steps, calls in ((50, 2000), (1000, 500)):
        own = least(lambda steps=steps: trajectory.joint(START, END, steps=steps), calls)
        other = None
        if toolbox:
            t = np.linspace(0, 1, steps)
            other = least(lambda t=t: toolbox.jtraj(START, END, t), calls)
        show(f"quintic, {steps} samples", own, other, "jtraj")
    limits = {"max_velocity": velocity, "max_acceleration": acceleration, "max_jerk": 100.0}
    call = lambda: trajectory.joint(START, END, steps=2, profile="s_curve", **limits)  # noqa: E731
    show("jerk-limited rest to rest, 2 samples", least(call, 2000))
    a = irbkin.pose([0.85, -0.4, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
    b = irbkin.pose([0.85, 0.4, 0.64], wxyz=[0.5, 0.1, 0.8602325267, 0])
    show("line, 1,000 poses", least(lambda: paths.line(a, b, steps=1000), 500))
    met = paths.line(a, b, steps=11)
    met[1::2, 2, 3] += 0.05
    show("spline through 11 poses, 1,000", least(lambda: paths.spline(met, steps=1000), 100))
    line = paths.line(a, b, steps=1000)
    show("that line followed", least(lambda: robot.follow(line, np.zeros(6)), 50))
    followed = robot.follow(line, np.zeros(6)).q
    call = lambda: trajectory.at_tool_speed(followed, line, 0.3, velocity)  # noqa: E731
    show("that line at a constant tool speed", least(call, 100))
    rng = np.random.default_rng(1)
    sets = {"that line": followed}
    sets |= {f"{n} random waypoints": rng.uniform(-2, 2, (n, 6)) for n in (5, 20, 100)}
    for name, q in sets.items():
        own = least(lambda q=q: trajectory.retime(q, velocity, acceleration, steps=1000), 30)
        move = trajectory.retime(q, velocity, acceleration)
        fine = move.sample(np.linspace(0, move.duration, 10_000))
        if toppra is None:
            show(f"{name} retimed", own)
            continue
        call = toppra_of(q, velocity, acceleration, 1000)
        show(f"{name} retimed", own, least(call, 5), "toppra")
        theirs = call()
        t = np.linspace(0, theirs.duration, 10_000)
        print(f"  duration {move.duration / theirs.duration:.4f} x toppra; largest excess")
        print(f"    irbkin  {excess(fine.dq, fine.ddq, velocity, acceleration)}")
        print(f"    toppra  {excess(theirs(t, 1), theirs(t, 2), velocity, acceleration)}")
    show_routine(robot, int(os.environ.get("MOVES", "50000")))


if __name__ == "__main__":
    main()
