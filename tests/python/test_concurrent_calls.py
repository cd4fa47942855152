"""While a batch writes to an array without the interpreter's lock, no other call reads or writes it."""

import threading
import time

import irbkin
import numpy as np
import pytest

COUNT = 200_000  # a third of a second: more than the calls that come meanwhile take
UNWRITTEN = -1.0


@pytest.fixture(scope="module")
def robot():
    """An arm whose limits are more than a turn away, so that each pose is solved carefully, some microseconds long."""
    half_turn = [-np.pi, np.pi]
    return irbkin.Robot("IRB 2600-12/1.65").with_limits([[4.0, 7.0], *[half_turn] * 5])


@pytest.fixture(scope="module")
def poses(robot):
    return robot.fk(np.random.default_rng(8).uniform(-1.0, 1.0, (COUNT, 6)))


class Writing:
    """A batch that is being written by another thread; `q` and `status` are where it writes to."""

    def __init__(self, robot, poses):
        self.robot, self.poses = robot, poses
        self.q, self.status = np.full((COUNT, 8, 6), UNWRITTEN), np.zeros((COUNT, 8), np.uint8)
        self.thread = threading.Thread(target=lambda: robot.ik_batch(poses, out=(self.q, self.status)))

    def __enter__(self):
        self.thread.start()
        given_up = time.monotonic() + 60
        while self.q[0, 0, 0] == UNWRITTEN:
            assert time.monotonic() < given_up, "the batch does not begin"
        return self

    def __exit__(self, *_):
        # Nothing is told by calls that came after the last row.
        still_writing = self.q[-1, 0, 0] == UNWRITTEN
        self.thread.join()
        assert still_writing, "the batch was done before the calls that it should meet"


@pytest.fixture
def writing(robot, poses):
    with Writing(robot, poses) as batch:
        yield batch


READS = {
    "one vector": lambda b: b.robot.fk(b.q[0, 0]),
    "a strided vector": lambda b: b.robot.fk(b.q[0, 0, ::-1]),
    "one pose": lambda b: b.robot.ik(b.q[0].ravel()[:16].reshape(4, 4)),
    "many vectors": lambda b: b.robot.jacobian(b.q[:5, 0]),
    "many poses": lambda b: b.robot.ik_batch(b.q[0].ravel()[:32].reshape(2, 4, 4)),
    "a seed": lambda b: b.robot.ik_nearest(b.poses[0], b.q[0, 0]),
    "a weight": lambda b: b.robot.ik_nearest(b.poses[0], np.zeros(6), weights=b.q[0, 0]),
}

WRITES = {
    "one answer": lambda b: b.robot.fk(np.zeros(6), out=b.q[0].ravel()[:16].reshape(4, 4)),
    "many answers": lambda b: b.robot.fk(np.zeros((2, 6)), out=b.q[0].ravel()[:32].reshape(2, 4, 4)),
    "the same batch": lambda b: b.robot.ik_batch(b.poses, out=(b.q, b.status)),
    "the status": lambda b: b.robot.ik_batch(b.poses[:2], out=(np.zeros((2, 8, 6)), b.status[:2])),
    "over the input": lambda b: b.robot.fk(np.zeros(6), out=b.poses[0]),
}


@pytest.mark.parametrize("kind", READS)
def test_an_array_that_is_being_written_is_not_read(writing, kind):
    with pytest.raises(ValueError, match="is being written by another call"):
        READS[kind](writing)


@pytest.mark.parametrize("kind", WRITES)
def test_an_array_that_is_in_use_is_not_written(writing, kind):
    with pytest.raises(ValueError, match="out must be writable"):
        WRITES[kind](writing)


def test_other_arrays_are_read_and_written_meanwhile(robot, poses):
    q, out = np.full(6, 0.1), np.zeros((4, 4))
    wanted, slots = robot.fk(q), robot.ik(poses[7]).slots
    with Writing(robot, poses) as writing:
        robot.fk(q, out=out)
        np.testing.assert_array_equal(out, wanted)
        np.testing.assert_array_equal(robot.fk(q[None])[0], wanted)
        # The input of the batch is only read.
        np.testing.assert_array_equal(robot.ik(poses[7]).slots, slots)
    np.testing.assert_array_equal(writing.q[7], slots)
    # And all is free again, after a call that was refused too.
    np.testing.assert_array_equal(robot.fk(writing.q[7, 0]), robot.fk(writing.q[7, 0].tolist()))
    robot.fk(q, out=writing.q[0].ravel()[:16].reshape(4, 4))


def test_a_refused_call_changes_no_row(robot, poses):
    alone = robot.ik_batch(poses)
    with Writing(robot, poses) as writing:
        for write in WRITES.values():
            with pytest.raises(ValueError, match="out must be writable"):
                write(writing)
    np.testing.assert_array_equal(writing.q, alone.q)
    np.testing.assert_array_equal(writing.status, alone.status)
