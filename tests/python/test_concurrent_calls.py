"""While a batch writes to an array without the interpreter's lock, no other call reads or writes it."""

import ctypes
import mmap
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

    def __init__(self, robot, poses, q=None, status=None):
        self.robot, self.poses = robot, poses
        self.q = np.empty((COUNT, 8, 6)) if q is None else q
        self.status = np.zeros((COUNT, 8), np.uint8) if status is None else status
        self.q[:] = UNWRITTEN
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


class Interface:
    """An array by its address alone: NumPy takes this for the owner of the memory."""

    def __init__(self, array):
        self.array = array
        self.__array_interface__ = array.__array_interface__


def buffers(count, dtype=float):
    """Two arrays over the same memory that have no owner in common, for each way to make such a pair."""
    size = count * np.dtype(dtype).itemsize
    for buffer in (bytearray(size), mmap.mmap(-1, size)):
        yield [np.frombuffer(memoryview(buffer), dtype=dtype) for _ in range(2)]
    own = np.zeros(count, dtype)
    of_address = ctypes.cast(own.ctypes.data, ctypes.POINTER(ctypes.c_char * size)).contents
    yield [own, np.frombuffer(of_address, dtype=dtype)]
    yield [np.asarray(Interface(own)), np.asarray(Interface(own))]


WAYS = ["bytearray", "mmap", "address", "interface"]


@pytest.mark.parametrize("way", range(len(WAYS)), ids=WAYS)
def test_memory_that_is_being_written_is_not_read_through_another_array(robot, poses, way):
    written, seen = (array.reshape(COUNT, 8, 6) for array in list(buffers(COUNT * 48))[way])
    with Writing(robot, poses, q=written) as writing:
        writing.q = seen
        for name, read in READS.items():
            with pytest.raises(ValueError, match="is being written by another call"):
                read(writing)
            assert name
        # A strided view whose ends lie in what is written, and bytes of it in another type.
        for q in (seen[::7, 0][::-1], seen[:3, 0].view(">f8"), seen.view(np.float32)[:3, 0, 6:]):
            with pytest.raises(ValueError, match="is being written by another call"):
                robot.fk(q)
        for write in WRITES.values():
            with pytest.raises(ValueError, match="out must be writable"):
                write(writing)
        writing.q = written
    np.testing.assert_array_equal(seen, robot.ik_batch(poses).q)


@pytest.mark.parametrize("way", range(len(WAYS)), ids=WAYS)
def test_memory_that_is_being_read_is_not_written_through_another_array(robot, poses, way):
    read, seen = (array.reshape(COUNT, 4, 4) for array in list(buffers(COUNT * 16))[way])
    read[:] = poses
    with Writing(robot, read) as writing:
        for write in (
            lambda: robot.fk(np.zeros(6), out=seen[COUNT - 1]),
            lambda: robot.fk(np.zeros((2, 6)), out=seen[:2]),
            lambda: robot.ik_batch(poses[:1], out=seen.ravel()[-48:].reshape(1, 8, 6)),
        ):
            with pytest.raises(ValueError, match=r"out must be writable.*another call uses its memory"):
                write()
        # Reading what is read is no conflict.
        np.testing.assert_array_equal(robot.ik(seen[7]).slots, robot.ik_batch(seen[7:8]).q[0])
    np.testing.assert_array_equal(writing.q, robot.ik_batch(poses).q)
    robot.fk(np.zeros(6), out=seen[0])


def test_neighbours_in_one_buffer_are_read_and_written_meanwhile(robot, poses):
    """What begins where the written memory ends is free; so is what lies between the ends of no written array."""
    buffer = bytearray(8 * (COUNT * 48 + 12))
    whole = np.frombuffer(memoryview(buffer))
    q = np.frombuffer(memoryview(buffer), count=COUNT * 48, offset=48).reshape(COUNT, 8, 6)
    wanted = robot.fk(np.zeros(6))
    with Writing(robot, poses, q=q):
        for vector in (whole[:6], whole[-6:], whole[5::-1]):
            np.testing.assert_array_equal(robot.fk(vector), wanted)
        for vector in (whole[1:7], whole[-7:-1], whole[[0]].repeat(6)[::-1], whole[:: len(whole) // 5][:6]):
            if np.shares_memory(vector, whole):
                with pytest.raises(ValueError, match="is being written by another call"):
                    robot.fk(vector)
            else:
                np.testing.assert_array_equal(robot.fk(vector), wanted)


def test_single_calls_cost_the_same_before_and_after_a_batch(robot, poses):
    """No borrow is left over: single calls take the short way again."""
    q, out = np.full(6, 0.1), np.zeros((4, 4))

    def cost():
        start = time.perf_counter()
        for _ in range(20_000):
            robot.fk(q, out=out)
        return time.perf_counter() - start

    before = min(cost() for _ in range(5))
    robot.ik_batch(poses[:1000])
    with pytest.raises(irbkin.InvalidPoseError):
        robot.ik_batch(poses[:1000, :3])
    with pytest.raises(ValueError, match="out must be"):
        robot.ik_batch(poses[:2], out=poses[:2])
    assert min(cost() for _ in range(5)) < 3 * before
