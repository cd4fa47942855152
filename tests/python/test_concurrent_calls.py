"""While a batch writes to an array without the interpreter's lock, no other call reads or writes
it.
"""

import ctypes
import mmap
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
    """A batch that is being written by another thread; `q` and `status` are where it writes to.

    `memory` gives its arrays of poses and of joint angles, each as two arrays over the same memory:
    the batch has the first, `seen_poses` and `seen_q` are the second.
    """

    def __init__(self, robot, count, memory):
        self.robot = robot
        (self.poses, self.seen_poses), (self.q, self.seen_q) = memory(count)
        self.poses[:] = robot.fk(np.random.default_rng(8).uniform(-1.0, 1.0, (count, 6)))
        self.q[:] = UNWRITTEN
        self.status = np.zeros((count, 8), np.uint8)
        self.thread = threading.Thread(
            target=lambda: robot.ik_batch(self.poses, out=(self.q, self.status))
        )

    def meanwhile(self, *calls):
        """What calls that are made while the batch is written return or raise; none if it was done
        before them.
        """
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


def own_memory(count):
    poses, q = np.empty((count, 4, 4)), np.empty((count, 8, 6))
    return (poses, poses), (q, q)


def during_a_batch(robot, *calls, memory=own_memory):
    """A batch and the outcomes of calls made during it; on a quick machine it takes a larger one to
    last so long.
    """
    count = FIRST_COUNT
    while count < MOST:
        batch = Writing(robot, count, memory)
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
    "many answers": lambda b: b.robot.fk(
        np.zeros((2, 6)), out=b.q[0].ravel()[:32].reshape(2, 4, 4)
    ),
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
        lambda batch: robot.ik(batch.poses[7]).q_by_slot,
    )
    np.testing.assert_array_equal(written, wanted)
    np.testing.assert_array_equal(read, wanted)
    np.testing.assert_array_equal(slots, robot.ik(batch.poses[7]).q_by_slot)
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


class Interface:
    """An array by its address alone: NumPy takes this for the owner of the memory."""

    def __init__(self, array):
        self.array = array
        self.__array_interface__ = array.__array_interface__


def of_a_buffer(buffer):
    return [np.frombuffer(memoryview(buffer)) for _ in range(2)]


def of_an_address(size):
    own = np.zeros(size // 8)
    of_address = ctypes.cast(own.ctypes.data, ctypes.POINTER(ctypes.c_char * size)).contents
    return [own, np.frombuffer(of_address)]


def of_an_interface(size):
    own = np.zeros(size // 8)
    return [np.asarray(Interface(own)), np.asarray(Interface(own))]


# Two arrays over the same memory that have no owner in common, for each way to make such a pair.
PAIRS = {
    "bytearray": lambda size: of_a_buffer(bytearray(size)),
    "mmap": lambda size: of_a_buffer(mmap.mmap(-1, size)),
    "address": of_an_address,
    "interface": of_an_interface,
}


def paired(way):
    """The memory of a batch whose arrays each have a second one over the same bytes."""

    def memory(count):
        pairs = [PAIRS[way](8 * count * width) for width in (16, 48)]
        shapes = [(count, 4, 4), (count, 8, 6)]
        return [
            [array.reshape(shape) for array in pair]
            for pair, shape in zip(pairs, shapes, strict=True)
        ]

    return memory


@pytest.mark.parametrize("way", PAIRS)
def test_memory_that_is_being_written_is_not_read_through_another_array(robot, way):
    reads = [
        lambda b: b.robot.fk(b.seen_q[0, 0]),
        lambda b: b.robot.ik(b.seen_q[0].ravel()[:16].reshape(4, 4)),
        lambda b: b.robot.jacobian(b.seen_q[:5, 0]),
        # A strided view whose ends lie in what is written, and bytes of it in another type.
        lambda b: b.robot.fk(b.seen_q[::7, 0][::-1]),
        lambda b: b.robot.fk(b.seen_q[:3, 0].view(">f8")),
        lambda b: b.robot.fk(b.seen_q.view(np.float32)[:3, 0, 6:]),
    ]
    writes = [
        lambda b: b.robot.fk(np.zeros(6), out=b.seen_q[0].ravel()[:16].reshape(4, 4)),
        lambda b: b.robot.ik_batch(b.poses, out=(b.seen_q, b.status)),
    ]
    batch, errors = during_a_batch(robot, *reads, *writes, memory=paired(way))
    for error in errors[: len(reads)]:
        assert_refused(error, "is being written by another call")
    for error in errors[len(reads) :]:
        assert_refused(error, "out must be writable")
    np.testing.assert_array_equal(batch.seen_q, robot.ik_batch(batch.poses).q)


@pytest.mark.parametrize("way", PAIRS)
def test_memory_that_is_being_read_is_not_written_through_another_array(robot, way):
    writes = [
        lambda b: b.robot.fk(np.zeros(6), out=b.seen_poses[-1]),
        lambda b: b.robot.fk(np.zeros((2, 6)), out=b.seen_poses[:2]),
        lambda b: b.robot.ik_batch(
            b.poses[:1].copy(), out=b.seen_poses.ravel()[-48:].reshape(1, 8, 6)
        ),
    ]
    # Reading what is read is no conflict.
    batch, [*errors, solutions] = during_a_batch(
        robot, *writes, lambda b: robot.ik(b.seen_poses[7]), memory=paired(way)
    )
    for error in errors:
        assert_refused(error, "another call uses its memory")
    np.testing.assert_array_equal(solutions.q_by_slot, batch.q[7])
    np.testing.assert_array_equal(batch.q, robot.ik_batch(batch.poses).q)
    robot.fk(np.zeros(6), out=batch.seen_poses[0])


def test_neighbors_in_one_buffer_are_read_meanwhile(robot):
    """What begins where the written memory ends is free, and one number more of it is not."""

    def memory(count):
        buffer = bytearray(8 * (count * 48 + 12))
        whole = np.frombuffer(memoryview(buffer))
        q = np.frombuffer(memoryview(buffer), count=count * 48, offset=48).reshape(count, 8, 6)
        poses = np.empty((count, 4, 4))
        return (poses, poses), (q, whole)

    beside = [
        lambda b: robot.fk(b.seen_q[:6]),
        lambda b: robot.fk(b.seen_q[-6:]),
        lambda b: robot.fk(b.seen_q[5::-1]),
    ]
    across = [
        lambda b: robot.fk(b.seen_q[1:7]),
        lambda b: robot.fk(b.seen_q[-7:-1]),
        lambda b: robot.fk(b.seen_q[:: len(b.seen_q) // 5][:6]),
    ]
    _, outcomes = during_a_batch(robot, *beside, *across, memory=memory)
    for pose in outcomes[:3]:
        np.testing.assert_array_equal(pose, robot.fk(np.zeros(6)))
    for error in outcomes[3:]:
        assert_refused(error, "is being written by another call")
