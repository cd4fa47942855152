"""The model of a controller, in virtual time and on loopback, with a server and its guard."""

import asyncio
import contextlib
import socket
import subprocess
import sys
import threading
import time

import irbkin
import numpy as np
import pytest
from controllers import ROBOT, START, PassThrough, swing
from irbkin import paths, trajectory
from irbkin.errors import StreamError
from irbkin.stream import Guard, egm
from irbkin.stream.egm import _simulated

CYCLE = egm.CYCLE
SECONDS = 20
"""Bound of every wait on a socket."""
LIMITS = {"max_acceleration": 12.0, "max_jerk": 120.0}
LOSSES = {"loss": 0.1, "late": 0.05, "duplicate": 0.02}


def seam():
    """Poses of a path with a corner and joints that follow it at 250 mm/s, each cycle."""
    corners = [irbkin.pose([0.9, y, z], euler_zyx=[0, np.pi, 0]) for y, z in CORNERS]
    T = paths.polyline(corners, zones=0.01, step=0.002)
    followed = ROBOT.follow(T, ROBOT.ik_nearest(T[0], START))
    assert not followed.breaks
    motion = trajectory.retime(
        followed.q, ROBOT.max_velocity, 10.0, max_jerk=100.0, T=T, max_tool_speed=0.25
    )
    rows = motion.sample(np.arange(0, motion.duration, CYCLE)).q
    return T, np.concatenate([rows, np.repeat(motion.q[-1:], 250, axis=0)])


CORNERS = ((-0.2, 0.6), (0.1, 0.6), (0.1, 0.8), (-0.1, 0.7))


def off_path(q, T):
    """How far the tool is from the path [m]: the largest of all times, and the mean."""
    own, path = ROBOT.fk(q)[:, :3, 3], T[:, :3, 3]
    a, way = path[:-1], np.diff(path, axis=0)
    length = (way**2).sum(1)
    apart = []
    for point in own:
        along = np.clip(((point - a) * way).sum(1) / length, 0, 1)
        apart.append(np.linalg.norm(a + along[:, None] * way - point, axis=1).min())
    return np.array([np.max(apart), np.mean(apart)])


def test_the_law_of_the_manual():
    """speed = k (reference - position) + speed reference, behind lag and ramp."""
    controller = egm.Controller(ROBOT, START, lag=0, smoothing=0, ramp=0, delay=0, gain=4)
    planned = egm.EgmPosition(tuple((np.degrees(START) + 1).tolist()))
    for dq in (0.0, 8.0):
        speed = egm.EgmSpeed((dq,) * 6)
        controller = egm.Controller(ROBOT, START, lag=0, smoothing=0, ramp=0, delay=0, gain=4)
        for seqno in range(1, 4):
            before = controller.q
            header = egm.EgmHeader(seqno, 0, 3)
            controller.receive(egm.encode(egm.EgmSensor(header, planned, speed)))
            controller.tick()
        assert controller.state == "RUNNING"
        wanted = np.radians(4 * (1 - np.degrees(before - START)) + dq)
        assert controller.dq == pytest.approx(wanted)
        assert controller.q == pytest.approx(before + CYCLE * wanted)


def test_states_and_the_end_after_the_timeout():
    controller = egm.Controller(ROBOT, START, delay=0.02, comm_timeout=0.1, ramp=0.05)
    states, speeds = [], []
    for tick in range(120):
        data = egm.decode(controller.tick(), egm.EgmRobot)
        assert (data.mci_state == 3) == (controller.state == "RUNNING")
        states.append(controller.state)
        speeds.append(np.abs(controller.dq).max())
        if 2 < tick < 50:
            position = egm.EgmPosition(tuple((np.degrees(START) + 5).tolist()))
            header = egm.EgmHeader(tick, 0, 3)
            controller.receive(egm.encode(egm.EgmSensor(header, position)))
    for tool in (egm.EgmPose((np.nan,) * 3, (1, 0, 0, 0)), egm.EgmPose((9e9,) * 3, (1, 0, 0, 0))):
        wrong = egm.EgmSensor(egm.EgmHeader(tick, 0, 3), egm.EgmPosition(cartesian=tool))
        controller.receive(egm.encode(wrong))
        assert controller.state == "DISCONNECTED"
    assert states[2] == "DISCONNECTED"
    assert states[5] == "CONNECTED"
    assert states[20] == "RUNNING"
    lost = states.index("DISCONNECTED", 20)
    assert lost == pytest.approx(49 + 0.1 / CYCLE, abs=2)
    # It goes on after the last set point until then.
    assert speeds[lost - 1] > 0.01
    assert speeds[-1] == 0


def test_a_link_loses_what_it_says():
    link = _simulated.Link(1, 0.2, 0.1, 0.3)
    arrived = []
    for tick in range(20_000):
        link.put(tick.to_bytes(4, "big"), tick, 0.0)
        arrived += [(int.from_bytes(it, "big"), tick) for it in link.due(tick)]
    sent, came = np.array(arrived).T
    assert len({*sent}) / 20_000 == pytest.approx(0.8, abs=0.01)
    assert len(sent) / len({*sent}) == pytest.approx(1.1, abs=0.01)
    assert np.mean(came > sent) == pytest.approx(0.3, abs=0.02)
    assert (came - sent).max() == 5


@pytest.mark.parametrize("mode", ["joint", "pose"])
def test_a_robot_arrives_where_the_reference_ends(mode):
    guard = Guard(ROBOT, cycle=CYCLE, start=START, **LIMITS)
    reference = swing if mode == "joint" else lambda feedback: ROBOT.fk(swing(feedback))
    controller = egm.Controller(ROBOT, START)
    done = egm.simulated(guard, controller, reference, seconds=2.0, mode=mode, linger=2.0)
    assert done.statistics.refused == 0
    assert np.abs(done.q - START).max() > 0.05
    # exp(-k t) of what is left when the guard holds.
    assert controller.q == pytest.approx(guard.q, abs=1e-4)


@pytest.mark.parametrize(("losses", "most"), [({}, 1.2), (LOSSES, 1.2)])
def test_a_path_is_followed_as_well_as_the_lag_of_the_controller_allows(losses, most):
    T, rows = seam()
    off = {}
    for name, guard in (
        ("alone", PassThrough(start=rows[0])),
        ("guarded", Guard(ROBOT, cycle=CYCLE, start=rows[0], **LIMITS)),
    ):
        controller = egm.Controller(ROBOT, rows[0])
        options = losses if name == "guarded" else {}
        done = egm.simulated(guard, controller, rows, seed=4, **options)
        assert done.statistics.refused == done.statistics.stops == 0
        off[name] = off_path(done.q, T)
    print(off, off["guarded"] / off["alone"])
    assert (off["guarded"] <= most * off["alone"]).all()


class Recorded:
    """A guard whose steps are kept."""

    def __init__(self, guard):
        self.guard, self.rows = guard, []

    def __getattr__(self, name):
        return getattr(self.guard, name)

    def step(self, reference):
        if len(self.rows) > 20_000:
            assert_bounded(self)
            self.rows = self.rows[-1:]
        self.rows.append(self.guard.step(reference))
        return self.rows[-1]


def assert_bounded(guard):
    """Set points of each cycle are those of one motion within bounds: whichever arrive are."""
    q, dq = (np.array([getattr(step, name) for step in guard.rows]) for name in ("q", "dq"))
    assert (np.abs(dq) <= ROBOT.max_velocity * (1 + 1e-9)).all()
    ddq = np.diff(dq, axis=0) / CYCLE
    assert np.abs(ddq).max() <= LIMITS["max_acceleration"] * (1 + 1e-6)
    # Of the cubic of q and dq at both ends, as it is assumed to be.
    first = 6 * np.diff(q, axis=0) / CYCLE**2 - (4 * dq[:-1] + 2 * dq[1:]) / CYCLE
    last = -6 * np.diff(q, axis=0) / CYCLE**2 + (2 * dq[:-1] + 4 * dq[1:]) / CYCLE
    assert np.abs([first, last]).max() <= LIMITS["max_acceleration"] * (1 + 1e-6)
    assert np.abs(last - first).max() / CYCLE <= LIMITS["max_jerk"] * (1 + 1e-4)


def test_losses_stop_nothing_and_no_bound_is_violated():
    guard = Recorded(Guard(ROBOT, cycle=CYCLE, start=START, **LIMITS))
    controller = egm.Controller(ROBOT, START)
    done = egm.simulated(guard, controller, swing, seconds=60, seed=1, **LOSSES)
    counted = done.statistics
    assert counted.lost > 1000
    assert counted.late > 400
    assert counted.duplicate > 200
    assert counted.stops == counted.refused == 0
    assert_bounded(guard)


@pytest.mark.evidence
@pytest.mark.parametrize("bridge", [0.0, 0.02, 0.04])
def test_stops_of_an_hour_with_losses(bridge):
    """A tenth of the datagrams lost and a twentieth late, each way, in virtual time."""
    guard = Recorded(Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **LIMITS))
    controller = egm.Controller(ROBOT, START)
    rates = {"loss": 0.1, "late": 0.05}
    done = egm.simulated(guard, controller, swing, seconds=3600, bridge=bridge, seed=2, **rates)
    print(f"bridge {bridge} s: {done.statistics}")
    assert done.statistics.received > 700_000
    assert_bounded(guard)
    assert done.statistics.stops <= 1 or bridge < 0.04


def test_a_cut_stops_and_the_reference_is_caught_up_with():
    guard = Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **LIMITS)
    guard = Recorded(guard)
    controller = egm.Controller(ROBOT, START)
    done = egm.simulated(guard, controller, swing, seconds=5, cut=(2.0, 2.2))
    assert done.statistics.stops >= 1
    assert "braking" in {step.state for step in guard.rows}
    assert guard.rows[-400].accepted
    assert_bounded(guard)
    # Longer than the watchdog.
    guard = Recorded(Guard(ROBOT, cycle=CYCLE, start=START, **LIMITS))
    with pytest.raises(StreamError, match=r"no datagram for 0\.25 s \(watchdog\)"):
        egm.simulated(guard, egm.Controller(ROBOT, START), swing, seconds=5, cut=(2.0, 4.0))
    assert guard.state == "holding"
    assert_bounded(guard)


@pytest.fixture
def playing():
    """Start a model in a thread that ends by itself."""
    threads = []

    def start(address, seconds=1.2, q=START, **options):
        controller, lines = egm.Controller(ROBOT, q, delay=0.05), []
        options |= {"seconds": seconds}
        own = threading.Thread(
            target=egm.play, args=(controller, address, lines.append), kwargs=options
        )
        own.start()
        threads.append(own)
        return controller, lines

    yield start
    for thread in threads:
        thread.join(SECONDS)
        assert not thread.is_alive()


def served(guard, run, **options):
    """What a server counts, that is run in one of two ways."""
    options = {"connect": SECONDS, "watchdog": 5.0, "bridge": 0.5, "linger": 0.1} | options
    with egm.Server(guard, port=0, **options) as server:
        assert server.address[0] == "127.0.0.1"
        assert sum(server.statistics) == 0
        return run(server)


def blocking(reference, seconds, before=lambda address: None):
    def run(server):
        before(server.address)
        return server.run(reference, seconds=seconds)

    return run


def looping(reference, seconds, before=lambda address: None):
    def run(server):
        before(server.address)
        own = server.run_async(reference, seconds=seconds)
        return asyncio.run(asyncio.wait_for(own, SECONDS))

    return run


@pytest.mark.parametrize("way", [blocking, looping])
def test_a_server_moves_the_robot_on_loopback(way, playing):
    guard = Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **LIMITS)
    found = []
    run = way(swing, 0.5, lambda address: found.extend(playing(address, loss=0.05, late=0.02)))
    counted = served(guard, run)
    assert counted.received > 60
    assert counted.foreign == counted.broken == 0
    controller, lines = found
    assert np.abs(controller.q - START).max() > 1e-3
    assert [line.split()[-1] for line in lines if "DIS" not in line] == ["CONNECTED", "RUNNING"]


@pytest.mark.parametrize("way", [blocking, looping])
def test_a_server_says_that_no_controller_came(way):
    with pytest.raises(StreamError, match=r"no controller sent a datagram to 127\.0\.0\.1:\d+ in"):
        served(PassThrough(), way(swing, 1.0), connect=0.1)


@pytest.mark.parametrize("way", [blocking, looping])
def test_a_server_says_that_a_controller_fell_silent(way, playing):
    guard = Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **LIMITS)
    run = way(swing, 60.0, lambda address: playing(address, seconds=0.6))
    with pytest.raises(StreamError, match="watchdog"):
        served(guard, run, watchdog=0.3)
    assert guard.state == "holding"


@pytest.mark.parametrize("way", [blocking, looping])
def test_a_server_refuses_a_robot_that_is_elsewhere(way, playing):
    run = way(
        swing, 60.0, lambda address: playing(address, seconds=0.3, q=START + 0.1 * np.eye(6)[0])
    )
    with pytest.raises(StreamError, match=r"joint 1 of the robot is at 11\.46 deg"):
        served(PassThrough(), run)


@pytest.mark.parametrize("way", [blocking, looping])
def test_a_server_counts_strangers(way, playing):
    def before(address):
        def stray(feedback):
            # What waits when a session begins is dropped: they come in the middle of it.
            if feedback.t == 0:
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
                    for data in (b"", b"\xff" * 100, b"\x0a"):
                        own.sendto(data, address)
            return swing(feedback)

        reference.append(stray)
        playing(address)

    reference = []
    guard = Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **LIMITS)
    counted = served(guard, way(lambda feedback: reference[0](feedback), 0.2, before))
    assert (counted.foreign, counted.broken) == (3, 0)


@pytest.mark.parametrize("way", [blocking, looping])
def test_what_a_reference_raises_is_raised_after_braking(way, playing):
    guard = Guard(ROBOT, cycle=CYCLE, start=START, on_violation="limit", **LIMITS)

    def wrong(feedback):
        if feedback.t > 0.1:
            raise ZeroDivisionError("of the reference")
        return swing(feedback)

    with pytest.raises(ZeroDivisionError, match="of the reference"):
        served(guard, way(wrong, 60.0, playing))
    assert guard.state == "holding"


@pytest.mark.parametrize("mode", ["joint", "pose"])
@pytest.mark.parametrize("losses", [{}, LOSSES])
def test_a_lag_of_100_ms_at_full_speed_is_no_following_error(mode, losses):
    def full(feedback):
        q = START.copy()
        q[0] += 1.2 * (1 - np.cos(2.4 * feedback.t))
        q[5] += 1.5 * (1 - np.cos(3 * feedback.t))
        return q if mode == "joint" else ROBOT.fk(q)

    guard = Guard(ROBOT, cycle=CYCLE, start=START, cell=False, on_violation="limit", **LIMITS)
    guard = Recorded(guard)
    controller = egm.Controller(ROBOT, START, lag=0.1)
    egm.simulated(guard, controller, full, seconds=6, mode=mode, seed=3, **losses)
    fastest = np.abs([step.dq for step in guard.rows]).max(axis=0)
    assert fastest[0] > 0.9 * ROBOT.max_velocity[0]


def test_a_robot_that_is_held_in_the_middle_stops_the_guard():
    """It stands from the second second on: the guard brakes near it, and `run` raises."""

    class Held(egm.Controller):
        def tick(self):
            if self.ticks * CYCLE > 2:
                self._speeds[:] = 0.0
            return super().tick()

    guard = Guard(ROBOT, cycle=CYCLE, start=START, cell=False, **LIMITS)
    controller = Held(ROBOT, START)
    with pytest.raises(StreamError, match=r"more than .* deg apart \(max_following_error\)"):
        egm.simulated(guard, controller, swing, seconds=20)
    assert guard.state == "holding"
    assert np.abs(guard.q - controller.q).max() < 0.06


def test_three_runs_of_one_server_move_as_one_does():
    """Beside the command: with pauses the robot moves at once, and never faster than it is told."""
    guard = Guard(
        ROBOT,
        cycle=CYCLE,
        start=START,
        max_velocity=1.0,
        cell=False,
        on_violation="limit",
        **LIMITS,
    )
    with egm.Server(guard, port=0, connect=SECONDS, watchdog=5.0, linger=0.3) as server:
        where = ["--port", str(server.address[1]), "--joints", *map(str, np.degrees(START))]
        command = [sys.executable, "-m", "irbkin", "egm-sim", ROBOT.name, "--seconds", "15"]
        with subprocess.Popen([*command, *where], stdout=subprocess.DEVNULL) as controller:
            try:
                for pause in (0.0, 0.5, 2.0):
                    rows, begin = [], guard.q[0]

                    def onward(feedback, rows=rows, begin=begin):
                        header = feedback.message.header
                        rows.append((time.monotonic(), header.seqno, feedback.q[0]))
                        return START + (begin - START[0] + 0.5 * feedback.t) * np.eye(6)[0]

                    start = time.monotonic()
                    counted = server.run(onward, seconds=0.5)
                    t, seqno, q = np.array(rows).T
                    # No burst: the guard's cycles are not ahead of the time.
                    assert counted.received * CYCLE < time.monotonic() - start + 0.05
                    speed = np.diff(q) / np.maximum(np.diff(seqno), 1) / CYCLE
                    assert np.abs(speed).max() < 1.0
                    # The guard and the robot arrive, and the first motion is soon.
                    assert guard.q[0] - begin == pytest.approx(0.25, abs=0.05)
                    assert pause == 0.0 or t[0] - start < 1.0
                    time.sleep(pause)
            finally:
                controller.kill()


@pytest.mark.parametrize("way", [blocking, looping])
def test_what_waits_before_a_run_is_dropped(way):
    """300 datagrams of a controller that goes on after a run: none of them is a cycle."""
    guard = PassThrough()
    asked = []

    def reference(feedback):
        asked.append(feedback.message.header.seqno)
        return START

    def send(own, seqno):
        header = egm.EgmHeader(seqno, int(seqno * CYCLE * 1e3), 2)
        feedback = egm.EgmPosition(tuple(np.degrees(START).tolist()))
        own.send(egm.encode(egm.EgmRobot(header, feedback, mci_state=3)))

    def before(address):
        own.connect(address)
        for seqno in range(300):
            send(own, seqno)
        thread.start()

    def later():
        time.sleep(0.3)
        # Until the session has ended, and its socket is closed.
        with contextlib.suppress(ConnectionError):
            for seqno in range(375, 425):
                send(own, seqno)
                time.sleep(CYCLE)

    thread = threading.Thread(target=later)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
        counted = served(guard, way(reference, 0.1, before), linger=0.02)
        thread.join(SECONDS)
    assert min(asked) >= 375
    assert counted.lost == 0


def test_a_port_in_use_is_an_error():
    with egm.Server(PassThrough(), port=0) as server, pytest.raises(OSError, match="in use"):
        egm.Server(PassThrough(), port=server.address[1])
