"""While a batch writes to an array without the interpreter's lock, no other call reads or writes it."""

import threading
import time

import irbkin
import numpy as np
import pytest

FIRST_COUNT, MOST = 50_000, 10_000_000  # poses of a batch
UNWRITTEN = -1.0


@pytest.fixture(scope="module")
def robot():
    return irbkin.Robot("IRB 2600-12/1.65")


class Writing:
    """A batch that is being written by another thread; `q` and `status` are where it writes to."""

    def __init__(self, robot, count):
        self.robot = robot
        self.poses = robot.fk(np.random.default_rng(8).uniform(-1.0, 1.0, (count, 6)))
        self.q, self.status = np.full((count, 8, 6), UNWRITTEN), np.zeros((count, 8), np.uint8)
        self.thread = threading.Thread(target=lambda: robot.ik_batch(self.poses, out=(self.q, self.status)))

    def meanwhile(self, *calls):
        """What calls that are made while the batch is written return or raise; none if it was done before them."""
        self.thread.start()
        given_up = time.monotonic() + 60
        while self.q[0, 0, 0] == UNWRITTEN:
            assert time.monotonic() < given_up, "the batch does not begin"
        outcomes = [outcome(call, self) for call in calls]
        still_writing = self.q[-1, 0, 0] == UNWRITTEN
        self.thread.join()
        return outcomes if still_writing else None


def outcome(call, batch):
    try:
        return call(batch)
    except ValueError as error:
        return error


def during_a_batch(robot, *calls):
    """A batch and the outcomes of calls made during it; on a quick machine it takes a larger one to last so long."""
    count = FIRST_COUNT
    while count < MOST:
        batch = Writing(robot, count)
        outcomes = batch.meanwhile(*calls)
        if outcomes is not None:
            return batch, outcomes
        count *= 2
    pytest.fail(f"a batch of {count // 2} poses was done before the calls that it should meet")


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


def assert_refused(error, words):
    assert isinstance(error, ValueError), error
    assert words in str(error)


@pytest.mark.parametrize("kind", READS)
def test_an_array_that_is_being_written_is_not_read(robot, kind):
    _, [error] = during_a_batch(robot, READS[kind])
    assert_refused(error, "is being written by another call")


@pytest.mark.parametrize("kind", WRITES)
def test_an_array_that_is_in_use_is_not_written(robot, kind):
    _, [error] = during_a_batch(robot, WRITES[kind])
    assert_refused(error, "out must be writable")


def test_other_arrays_are_read_and_written_meanwhile(robot):
    q, out = np.full(6, 0.1), np.zeros((4, 4))
    wanted = robot.fk(q)
    batch, (written, read, slots) = during_a_batch(
        robot,
        lambda _: robot.fk(q, out=out).copy(),
        lambda _: robot.fk(q[None])[0],
        # The input of the batch is only read.
        lambda batch: robot.ik(batch.poses[7]).slots,
    )
    np.testing.assert_array_equal(written, wanted)
    np.testing.assert_array_equal(read, wanted)
    np.testing.assert_array_equal(slots, robot.ik(batch.poses[7]).slots)
    np.testing.assert_array_equal(batch.q[7], slots)
    # And all is free again, after a call that was refused too.
    np.testing.assert_array_equal(robot.fk(batch.q[7, 0]), robot.fk(batch.q[7, 0].tolist()))
    robot.fk(q, out=batch.q[0].ravel()[:16].reshape(4, 4))


def test_a_refused_call_changes_no_row(robot):
    batch, errors = during_a_batch(robot, *WRITES.values())
    for error in errors:
        assert_refused(error, "out must be writable")
    alone = robot.ik_batch(batch.poses)
    np.testing.assert_array_equal(batch.q, alone.q)
    np.testing.assert_array_equal(batch.status, alone.status)
