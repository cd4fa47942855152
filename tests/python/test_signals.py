"""Ctrl-C ends every batch, on one thread and on two."""

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
}

# Calls over and over, so that the signal comes during one however fast it is. What is measured is
# the time from the signal to the exception, of this process alone: others may have the processor.
PROGRAM = """
import os, signal, threading, time
import numpy as np
import irbkin

signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job ignores it
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
sent = []

def interrupt():
    time.sleep(0.2)
    sent.append(time.process_time())
    os.kill(os.getpid(), signal.SIGINT)

try:
    threading.Thread(target=interrupt).start()
    while True:
        {call}
except KeyboardInterrupt:
    print(time.process_time() - sent[0])
"""


@pytest.mark.parametrize("name", CALLS)
def test_an_interrupt_ends_the_call(name):
    program = PROGRAM.format(call=CALLS[name], count=COUNT)
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
