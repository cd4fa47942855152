"""Ctrl-C ends every call that takes long, on one thread and on two."""

import subprocess
import sys

import pytest

# The slow calls take a second.
COUNT = 300_000

CALLS = {
    "fk": "robot.fk(q, out=np.empty((n, 4, 4)))",
    "jacobian": "robot.jacobian(q, out=np.empty((n, 6, 6)))",
    "link_frames": "robot.link_frames(q)",
    "singularity": "robot.singularity(q)",
    "singularity on two threads": "robot.singularity(q, threads=2)",
    "configuration": "robot.configuration(q)",
    "ik_batch": "robot.ik_batch(T)",
    "ik_batch on two threads": "robot.ik_batch(T, threads=2)",
    "ik_nearest": "robot.ik_nearest(T, q)",
    "ik_nearest on two threads": "robot.ik_nearest(T, q, threads=2)",
    "ik_configured": "robot.ik_configured(T, (0, 0, 0, 0))",
    "follow": "robot.follow(T, q[0])",
    "follow of many": "robot.follow(T.reshape(-1, 50, 4, 4), q[0], threads=2)",
    "follow with a locked axis": "robot.follow(T, q[0], singularity_mode='lock_axis4')",
    "follow through a wrist": "robot.follow(T, q[0], singularity_mode='wrist', zone=0.9)",
    "plan": "robot.plan(T[:100_000], rotation=3)",
    "plan, the sum first": "robot.plan(T[:50_000], rotation=12, order='sum')",
    "go": "ball.go(*ends, rooms, seconds=100)",
    "retime": "irbkin.trajectory.retime(walk, 3.0, 10.0)",
    "spline": "irbkin.trajectory.spline(walk, max_velocity=3.0)",
    "pose": "irbkin.pose(T[:, :3, 3], rotation=T[:, :3, :3])",
    "to_xyz_wxyz": "irbkin.to_xyz_wxyz(T)",
    "check_path": "cell.check_path(robot, way)",
    "check_path of a trajectory": "cell.check_path(robot, motion)",
    "distance": "cell.distance(robot, way)",
    "convex": "Shape.convex(points)",
    "points": "Shape.points(points, 0.01)",
    "mesh": "Shape.mesh(triangles)",
    "surface": "Shape.mesh(triangles, solid=False)",
    "rapid.parse": "irbkin.rapid.parse(text)",
    "rapid.load": "irbkin.rapid.load(file)",
    "rapid.check": "irbkin.rapid.check(robot, module)",
    "rapid.check of calls that fan out": "irbkin.rapid.check(robot, fan)",
    "rapid.check of long moves": "irbkin.rapid.check(robot, module, step=3e-9)",
}

# Points on a sphere around the arm, between which a motion is proven slowly.
CELL = """
points = np.random.default_rng(2).normal(size=({count}, 3))
points *= 2.6 / np.linalg.norm(points, axis=1)[:, None]
cell = irbkin.Cell({{"sphere": Shape.points(points[:100_000], 0.01)}})
way = one + 0.2 * np.sin(np.linspace(0, 2e4, 100_000)[:, None] + np.arange(6))
"""
TORUS = """
turn = np.linspace(0, 2 * np.pi, 600, endpoint=False)
a, b = turn[:, None], 1 + 0.3 * np.cos(turn)
A = np.stack([b * np.cos(a), b * np.sin(a), 0.3 * np.sin(turn) + 0 * a], axis=-1)
B, D = np.roll(A, -1, axis=0), np.roll(A, -1, axis=1)
C = np.roll(B, -1, axis=1)
triangles = np.concatenate([np.stack(three, axis=2) for three in ([A, B, C], [A, C, D])])
triangles = triangles.reshape(-1, 3, 3)
"""
TEXT = """
import pathlib, tempfile
move = "MoveL [[{{}},0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;"
moves = [move.format(900 + i % 100) for i in range({count})]
text = "\\n".join(["MODULE M", "PROC main()", *moves, "ENDPROC", "ENDMODULE"])
file = pathlib.Path(tempfile.mkdtemp(), "M.mod")
file.write_text(text)
"""
# Routines that call the next one twice.
FAN = """
move = "MoveJ [[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;"
names = [f"rCalls{{at}}" for at in range(3000)]
calls = [f"PROC {{name}}() {{next}};{{next}}; ENDPROC" for name, next in zip(names, names[1:])]
fan = irbkin.rapid.parse(
    "\\n".join(["MODULE M", *calls, f"PROC {{names[-1]}}() {{move}} ENDPROC", "ENDMODULE"])
)
"""
BUILT = {
    "rapid.check of calls that fan out": FAN.format(),
    "check_path": CELL.format(count=100_000),
    "check_path of a trajectory": CELL.format(count=100_000)
    + "motion = irbkin.trajectory.spline(way, max_velocity=3.0)",
    "distance": CELL.format(count=100_000),
    "convex": CELL.format(count=3 * COUNT),
    "points": CELL.format(count=3 * COUNT),
    "mesh": TORUS,
    "surface": TORUS,
    "rapid.parse": TEXT.format(count=COUNT // 3),
    "rapid.load": TEXT.format(count=COUNT // 3),
    "rapid.check": TEXT.format(count=COUNT // 3) + "module = irbkin.rapid.parse(text)",
    "rapid.check of long moves": TEXT.format(count=6) + "module = irbkin.rapid.parse(text)",
}

# Calls over and over, so that the signal comes during one however fast it is. What is measured is
# the time from the signal to the exception, of this process alone: others may have the processor.
# A timer needs no lock of the interpreter, which a call may hold.
PROGRAM = """
import signal, time
import numpy as np
import irbkin

signal.signal(signal.SIGPROF, signal.default_int_handler)
robot = irbkin.Robot("IRB 2600-12/1.65")
n = {count}
one = np.array([0.3, -0.2, 0.4, 0.5, 0.6, 0.7])
q = np.repeat(one[None], n, axis=0)
T = np.repeat(robot.fk(one)[None], n, axis=0)
# A ball in one of four rooms, and a goal in another.
ball = robot.with_body(irbkin.body.Body([6], [[0, 0, 0, 0, 0, 0, 0.05]], []))
sizes = {{"one": [6, 0.02, 6], "other": [0.02, 6, 6]}}
rooms = irbkin.Cell({{name: irbkin.body.Shape.box(size) for name, size in sizes.items()}})
ends = [[q1, 0.5, 0, 0, 0.5, 0] for q1 in (0.7, 2.3)]
walk = np.cumsum(np.random.default_rng(1).uniform(-0.1, 0.1, (n // 5, 6)), axis=0)
Shape = irbkin.body.Shape
{built}
start = time.process_time()
signal.setitimer(signal.ITIMER_PROF, 0.2)
try:
    while True:
        {call}
except KeyboardInterrupt:
    print(time.process_time() - start - 0.2)
"""


@pytest.mark.parametrize("name", CALLS)
def test_an_interrupt_ends_the_call(name):
    program = PROGRAM.format(call=CALLS[name], built=BUILT.get(name, ""), count=COUNT)
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True
    )
    assert float(run.stdout) < 0.2


def test_a_handler_that_raises_nothing_ends_no_call():
    """And a call in another thread hears no signals."""
    program = """
import os, signal, threading, time
import numpy as np
import irbkin

robot = irbkin.Robot("IRB 2600-12/1.65")
q = np.full((100_000, 6), 0.3)
heard = []
signal.signal(signal.SIGALRM, lambda *_: heard.append(time.monotonic()))
signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
ends = []
worker = threading.Thread(target=lambda: (robot.singularity(q), ends.append(time.monotonic())))
worker.start()
# Calls over and over, so that a signal comes during one however fast it is: it is heard before
# the call's end and well after its start.
for _ in range(10_000):
    start = time.monotonic()
    answer = robot.singularity(q, threads=2)
    end = time.monotonic()
    assert (answer.min_singular_value == answer.min_singular_value[0]).all()
    if any(start + 1e-3 < at < end for at in heard):
        break
else:
    raise AssertionError((heard, start, end))
worker.join()
signal.setitimer(signal.ITIMER_REAL, 0)
assert ends
"""
    subprocess.run([sys.executable, "-c", program], timeout=120, check=True)


def test_what_was_calculated_stays_in_out():
    """The rest of it is as it was, and the array is free again."""
    program = """
import os, signal, threading, time
import numpy as np
import irbkin

signal.signal(signal.SIGINT, signal.default_int_handler)
robot = irbkin.Robot("IRB 2600-12/1.65")
q = np.repeat(np.full((1, 6), 0.3), 400_000, axis=0)
T = np.repeat(robot.fk(q[:1]), len(q), axis=0)
out = np.full((len(q), 6), 7.0)
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    while True:
        out[:] = 7.0
        robot.ik_nearest(T, q, out=out)
except KeyboardInterrupt:
    pass
wanted = robot.ik_nearest(T[0], q[0])
done = (out == wanted).all(axis=1)
assert (out[~done] == 7.0).all()
robot.ik_nearest(T[:10], q[:10], out=out[:10])
assert (out[:10] == wanted).all()
"""
    subprocess.run([sys.executable, "-c", program], timeout=120, check=True)
