"""EGM: bytes of messages, and what a session answers to datagrams."""

import struct
import tracemalloc

import irbkin
import numpy as np
import pytest
from controllers import ROBOT, START, PassThrough, swing
from irbkin.errors import StreamError
from irbkin.stream import Guard, egm
from irbkin.stream.egm import EgmHeader, EgmPose, EgmPosition, EgmRobot, EgmSensor
from irbkin.stream.egm._session import WORD, Session

CYCLE = egm.CYCLE
DEGREES = tuple(np.degrees(START).tolist())
WHOLE = EgmRobot(
    EgmHeader(2**32 - 1, 7, 2),
    EgmPosition((1.5, -0.0), EgmPose((1, 2, 3), (1, 0, 0, 0), (4, 5, 6)), (), (2**63, 1)),
    EgmPosition(time_stamp=egm.EgmTimestamp(None, 5)),
    motor_state=1,
    mci_state=-3,
    mci_convergence_met=False,
    test_signals=(1.0,),
    measured_force=egm.EgmData(True, (1.0, 2.0)),
    utilization_rate=float("inf"),
    collision_info=egm.EgmData(),
)


def message(seqno, *, tm=None, q=DEGREES, mci=3, external=None, **others):
    """A datagram of a controller."""
    header = EgmHeader(seqno % WORD, int(seqno * CYCLE * 1e3) if tm is None else tm, 2)
    feedback = EgmPosition(q, external_joints=external)
    return egm.encode(EgmRobot(header, feedback, mci_state=mci, **others))


def answers(session, numbers, **options):
    """What a session answers to sequence numbers, None where it does not."""
    found = []
    for seqno in numbers:
        data = session.answer(message(seqno, **options), "controller", seqno * CYCLE)
        found.append(data and egm.decode(data, EgmSensor))
    return found


def test_bytes_are_those_of_the_wire_format():
    """By hand: tag 1 x 8 + 2, length 4, tag 1 x 8, 150 as a varint of two bytes."""
    assert egm.encode(EgmSensor(EgmHeader(seqno=150))) == b"\x0a\x03\x08\x96\x01"
    planned = b"\x12\x0b\x0a\x09\x09" + struct.pack("<d", 2.5)
    assert egm.encode(EgmSensor(planned=EgmPosition((2.5,)))) == planned
    packed = b"\x12\x0c\x0a\x0a\x0a\x08" + struct.pack("<d", 2.5)
    assert egm.decode(packed, EgmSensor).planned.joints == (2.5,)


def test_a_message_is_read_as_it_was_written():
    data = egm.encode(WHOLE)
    assert egm.decode(data, EgmRobot) == WHOLE
    # Fields that egm.proto does not have, of each wire type.
    unknown = b"\xf8\x07\x05" + b"\xf9\x07" + bytes(8) + b"\xfa\x07\x02ab" + b"\xfd\x07" + bytes(4)
    assert egm.decode(unknown + data + unknown, EgmRobot) == WHOLE


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"\x00", "byte 1: message has the field number 0"),
        (b"\x08\x01", "byte 1: header has wire type 0, it must be 2"),
        (b"\x0b", "byte 1: header has wire type 3"),
        (b"\x0a\x05\x08", "byte 2: header ends in the middle, 4 bytes are missing"),
        (b"\x0a\x02\x08\xff", "byte 3: seqno ends in the middle"),
        (b"\x0a\x0c\x08" + b"\xff" * 11, "byte 3: seqno has a varint of more than 10 bytes"),
        (b"\x0a\x06\x08\xff\xff\xff\xff\x1f", "seqno is 8589934591, it must be at most 4294967295"),
        (b"\x22\x00", "motor_state lacks its required element 1 of 1"),
        (b"\x12\x04\x12\x02\x0a\x00", "pos lacks its required element 1 of 3"),
        (b"\xf9\x07\x00", "an unknown field ends in the middle, 7 bytes are missing"),
        (bytes(65_508), "message has 65508 bytes, a datagram has 65507 at most"),
    ],
)
def test_broken_bytes_are_refused_with_the_place(data, words):
    with pytest.raises(StreamError) as raised:
        egm.decode(data, EgmRobot)
    assert words in str(raised.value)
    assert isinstance(raised.value, irbkin.IrbkinError)


def test_what_is_no_message_is_refused():
    with pytest.raises(TypeError, match="a message is an EgmRobot or an EgmSensor, got tuple"):
        egm.encode((1, 2))
    with pytest.raises(TypeError, match="got EgmPose"):
        egm.decode(b"", EgmPose)
    with pytest.raises(TypeError, match=r"EgmRobot\.header"):
        egm.encode(EgmRobot(EgmHeader(seqno=2**32)))
    with pytest.raises(StreamError, match="datagram has 65507 at most"):
        egm.encode(EgmRobot(test_signals=(0.0,) * 10_000))


def test_a_set_point_is_in_degrees_with_its_speed():
    session = Session(PassThrough(), lambda feedback: START + 0.001 * (feedback.t > 0))
    first, second = answers(session, [5, 6])
    assert first.header.mtype == 3
    assert first.planned.joints == pytest.approx(DEGREES)
    assert np.subtract(second.planned.joints, DEGREES) == pytest.approx([np.degrees(0.001)] * 6)
    assert second.speed_ref.joints == pytest.approx([np.degrees(0.001) / CYCLE] * 6)
    assert second.planned.external_joints is None


def test_poses_are_in_millimeters():
    robot = ROBOT.with_tool([0, 0, 0.1])
    T = robot.fk(START)
    feedback = EgmPosition(DEGREES, EgmPose(tuple(T[:3, 3] * 1e3)))
    data = egm.encode(EgmRobot(EgmHeader(1, 4, 2), feedback))
    session = Session(PassThrough(robot), lambda feedback: T, mode="pose")
    sent = egm.decode(session.answer(data, "controller", 0.0), EgmSensor)
    assert sent.planned.cartesian.pos == pytest.approx(T[:3, 3] * 1e3)
    own = irbkin.pose(T[:3, 3], wxyz=sent.planned.cartesian.orient)
    assert own == pytest.approx(T, abs=1e-12)
    assert sent.planned.joints is None
    assert sent.speed_ref is None
    # The tool of the controller is 100 mm shorter.
    session = Session(PassThrough(), lambda feedback: None, mode="pose")
    with pytest.raises(StreamError, match=r"100\.0 mm from the robot's"):
        session.answer(data, "controller", 0.0)


def test_axis_seven_travels_with_the_external_axes():
    panda = irbkin.Robot("Panda")
    q = np.radians([10.0, -20, 30, -100, 50, 60, 70])
    session = Session(PassThrough(panda, start=q), lambda feedback: q + 0.001)
    sent = answers(session, [1], q=(10.0, -20, -100, 50, 60, 70), external=(30.0, 812.5))[0]
    moved = np.degrees(0.001)
    assert sent.planned.joints == pytest.approx(np.add([10, -20, -100, 50, 60, 70], moved))
    # The track behind it stays where it is.
    assert sent.planned.external_joints == pytest.approx((30 + moved, 812.5))
    assert sent.speed_ref.external_joints == pytest.approx((moved / CYCLE, 0))


def test_sequence_numbers_are_cycles_of_the_guard():
    guard = PassThrough()
    asked = []
    session = Session(guard, lambda feedback: asked.append(feedback.t) or START, bridge=3.5 * CYCLE)
    # 3 is lost, 5 comes late and again, 6 twice; of 8 to 12 three are bridged.
    found = answers(session, [1, 2, 4, 6, 5, 5, 6, 7, 13])
    assert [bool(it) for it in found] == [1, 1, 1, 1, 0, 0, 0, 1, 1]
    assert guard.steps == 13
    assert np.divide(asked, CYCLE).round() == pytest.approx([*range(10), 12])
    counted = session.statistics
    assert counted[:4] == (6, 6, 1, 2)
    assert counted.bridged == 5
    assert counted.stops == 1


def test_a_gap_is_bridged_for_the_hold_of_the_guard():
    def bridged(hold, **options):
        own = Guard(ROBOT, cycle=CYCLE, start=START, max_acceleration=8.0, cell=False, hold=hold)
        session = Session(own, lambda feedback: START, **options)
        answers(session, [1, 40])
        return session.statistics.bridged

    assert bridged(0.02) == int(0.02 / CYCLE)
    assert bridged(0.0) == int(0.04 / CYCLE)
    assert bridged(0.02, bridge=3.5 * CYCLE) == 3


def test_sequence_numbers_wrap():
    guard = PassThrough()
    session = Session(guard, swing)
    for i, number in enumerate([WORD - 2, WORD - 1, 1, 0, 2]):
        data = message(number, tm=(WORD - 8 + 4 * i) % WORD)
        answer = session.answer(data, "controller", i * CYCLE)
        assert (answer is None) == (number == 0)
    assert session.statistics[:4] == (4, 0, 1, 0)
    assert guard.steps == 5


def test_old_datagrams_are_not_answered():
    session = Session(PassThrough(), swing, bridge=0.02)
    assert session.answer(message(1), "controller", CYCLE)
    assert session.answer(message(2), "controller", 2 * CYCLE + 0.05) is None
    assert session.answer(message(16), "controller", 16 * CYCLE)
    assert session.statistics.late == 1
    assert session.statistics.lost == 13


def test_numbers_before_the_first_are_late_and_nothing_else():
    guard = PassThrough()
    session = Session(guard, swing)
    assert [bool(it) for it in answers(session, [10, 9, 8, 9, 11, 12])] == [1, 0, 0, 0, 1, 1]
    assert session.statistics[:4] == (3, 0, 2, 1)
    assert guard.steps == 3


def test_a_number_far_ahead_after_a_slow_reference_costs_no_memory():
    slow = Slow({1: 3.0})
    session = Session(PassThrough(), slow, clock=lambda: slow.now)
    assert answers(session, [1])[0]
    tracemalloc.start()
    assert session.answer(message(2**31 - 1, tm=4000), "controller", 4.0)
    assert tracemalloc.get_traced_memory()[1] < 1e6
    tracemalloc.stop()


@pytest.mark.parametrize("first", [0, WORD - 20])
@pytest.mark.parametrize("seed", range(10))
def test_every_number_is_counted_once_in_any_order(first, seed):
    """What came is answered, late or a duplicate; what never came is lost, never less than 0."""
    draw = np.random.default_rng(seed)
    numbers = np.repeat(np.arange(300), draw.choice([0, 1, 2], 300, p=[0.1, 0.8, 0.1]))
    numbers = numbers[np.argsort(numbers + draw.uniform(0, 8, len(numbers)))]
    session = Session(PassThrough(), swing)
    newest = -1
    for number in numbers.tolist():
        newest = max(newest, number)
        tm = (int(number * CYCLE * 1e3) - 50) % WORD
        session.answer(message(first + number, tm=tm), "controller", newest * CYCLE)
        assert session.statistics.lost >= 0
    counted = session.statistics
    assert counted.received + counted.late + counted.duplicate == len(numbers)
    within = [number for number in {*numbers.tolist()} if number >= numbers[0]]
    assert counted.lost == newest - numbers[0] + 1 - len(within)


@pytest.mark.parametrize("at", [2, 13, 60])
@pytest.mark.parametrize(("wrong", "is_set"), [(16_000, False), (-45, True), (45, True), (-9e8, 1)])
def test_the_number_counts_where_the_time_is_wrong(at, wrong, is_set):
    """One wrong time, and a clock that is set: neither ends a session, nor makes others late."""
    session = Session(PassThrough(), swing)
    for number in range(1, 200):
        is_off = number >= at if is_set else number == at
        tm = (int(number * CYCLE * 1e3) + int(wrong) * is_off) % WORD
        assert session.answer(message(number, tm=tm), "controller", number * CYCLE)
    assert session.statistics[:4] == (199, 0, 0, 0)
    # A datagram that is too old is still seen to be.
    data = message(200, tm=(int(200 * CYCLE * 1e3) + int(wrong) * bool(is_set)) % WORD)
    assert session.answer(data, "controller", 200 * CYCLE + 0.06) is None


class Slow:
    """A reference that takes some seconds at some calls, by a clock of its own."""

    def __init__(self, calls, reference=swing):
        self.calls, self.reference, self.now, self.count = calls, reference, 0.0, 0

    def __call__(self, feedback):
        self.count += 1
        self.now += self.calls.get(self.count, 0.0)
        return self.reference(feedback)


def test_a_slow_reference_is_named():
    """In motion the guard brakes: the controller got no set point for so long."""
    slow = Slow({50: 0.3})
    guard = PassThrough()
    session = Session(guard, slow, clock=lambda: slow.now, linger=0.05)
    number = 0
    while not session.is_done:
        number += 1 + 74 * (slow.count == 50 and session.error is not None and session.held == 0)
        assert answers(session, [number])[0]
        assert number < 1000
    assert str(session.error).startswith("the reference took 300 ms, at most 0.25 s")
    assert guard.state == "holding"
    assert session.statistics.slow == 1


@pytest.mark.parametrize("took", [0.06, 0.24, 0.25, 1.0, 3.0])
def test_a_slow_first_reference_only_delays(took):
    """The robot rests: time does not go on meanwhile, and the motion is without a step."""
    slow = Slow({1: took})
    guard = PassThrough()
    session = Session(guard, slow, clock=lambda: slow.now)
    assert answers(session, [1])[0]
    # A socket keeps the oldest: the newest of them is late, too.
    behind = 1 + int(took / CYCLE)
    numbers = range(2, min(behind, 270))
    for number in numbers:
        session.take(message(number), "controller", behind * CYCLE)
    session.reply()
    assert all(answers(session, range(behind + 1, behind + 100)))
    assert session.error is None
    assert np.abs(np.diff(guard.set_points, axis=0)).max() < 0.1 * 0.5 * CYCLE
    assert session.statistics.slow == 1


def test_of_what_waits_the_newest_is_answered():
    guard = PassThrough()
    session = Session(guard, swing)
    assert answers(session, [1])[0]
    for number in range(2, 9):
        session.take(message(number), "controller", 8 * CYCLE)
    assert session.reply()
    assert session.reply() is None
    assert session.statistics[:4] == (2, 0, 6, 0)
    assert guard.steps == 8


@pytest.mark.parametrize(("drift", "is_late"), [(5e-4, False), (-5e-4, False), (5e-3, True)])
def test_clocks_that_drift_apart_make_nothing_late(drift, is_late):
    """Over 100 s, as the crystals of two clocks do; a link that gets ever slower is none."""
    session = Session(PassThrough(), swing)
    for seqno in range(1, 25_000, 40):
        session.answer(message(seqno), "controller", seqno * CYCLE * (1 + drift))
        if session.statistics.late:
            break
    assert bool(session.statistics.late) == is_late


def test_only_the_first_sender_is_answered():
    session = Session(PassThrough(), swing)
    assert session.answer(b"\x00", "a stranger", 0.0) is None
    assert session.answer(message(1), "controller", CYCLE)
    assert session.answer(message(2), "a stranger", 2 * CYCLE) is None
    assert session.answer(message(2), "controller", 2 * CYCLE)
    assert session.statistics.foreign == 1
    assert session.statistics.broken == 1


def test_broken_datagrams_are_counted_and_change_nothing():
    rng = np.random.default_rng(3)
    guard = PassThrough()
    session = Session(guard, swing)
    answers(session, [1])
    good = message(2)
    wrong = [
        message(2, q=(*DEGREES[:5], float("nan"))),
        message(2, q=DEGREES[:3]),
        egm.encode(EgmRobot(EgmHeader(2, 8, 3), EgmPosition(DEGREES))),
        egm.encode(EgmRobot(EgmHeader(2, None, 2), EgmPosition(DEGREES))),
        *(good[:end] for end in range(len(good) - 20)),
        *(rng.bytes(60) for _ in range(1000)),
    ]
    for data in wrong:
        assert session.answer(data, "controller", 2 * CYCLE) is None
    assert session.statistics.broken == len(wrong)
    assert guard.steps == 1
    assert session.answer(good, "controller", 2 * CYCLE)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"q": DEGREES[:5]}, r"5 joints and 0 external ones.*the guard's has 6 joints"),
        ({"q": (*DEGREES[:5], DEGREES[5] + 1)}, "joint 6 of the robot is at 12.46 deg.*11.46 deg"),
    ],
)
def test_a_controller_that_does_not_go_with_the_guard_is_refused(options, words):
    with pytest.raises(StreamError, match=words):
        answers(Session(PassThrough(), swing), [1], **options)


def test_a_robot_that_was_moved_while_it_was_stopped_is_refused():
    session = Session(PassThrough(), swing)
    answers(session, [1, 2])
    answers(session, [3], mci=2)
    with pytest.raises(StreamError, match="start a Guard where the robot is"):
        answers(session, [4], q=(*DEGREES[:5], DEGREES[5] + 1), mci=2)


def test_a_robot_that_is_not_moved_by_egm_gets_no_reference():
    asked = []
    session = Session(PassThrough(), lambda feedback: asked.append(feedback.t) or START)
    answers(session, [1, 2], mci=2)
    answers(session, [3], motor_state=2)
    assert asked == []
    answers(session, [4, 5])
    assert asked == pytest.approx([0, CYCLE])


def follow(speed, robot_at, **options):
    """Answer until the end a robot that is somewhere, by the time and the reference."""
    guard = PassThrough()
    session = Session(guard, lambda it: START + speed * it.t, linger=0.02, **options)
    for number in range(1, 400):
        q = robot_at(number * CYCLE, guard.q)
        answers(session, [number], q=tuple(np.degrees(q).tolist()))
        if session.is_done:
            break
    return guard, session


STANDS = {"stands": lambda t, q: START, "jumps": lambda t, q: q + (t > 0.4) * np.eye(6)[2]}


@pytest.mark.parametrize("robot_at", STANDS.values(), ids=STANDS)
@pytest.mark.parametrize("speed", [0.05, 0.7, 2.0])
def test_a_robot_that_does_not_follow_is_noticed(robot_at, speed):
    """The guard brakes before it is farther away than the default bound, and says so."""
    guard, session = follow(speed, robot_at)
    assert isinstance(session.error, StreamError)
    assert "of the robot is at" in str(session.error)
    assert "max_following_error" in str(session.error)
    assert guard.state == "holding"
    assert np.abs(guard.q - START).max() <= max(0.01 + 0.2 * speed + 2 * speed * CYCLE, 0.5 * speed)


def test_a_following_error_of_each_joint():
    stands = STANDS["stands"]
    bounds = [9, 9, 0.05, 9, 9, 9]
    guard, session = follow(0.7, stands, max_following_error=bounds)
    assert str(session.error).startswith("joint 3 of the robot")
    assert np.abs(guard.q - START).max() == pytest.approx(0.05, abs=2 * 0.7 * CYCLE)
    assert follow(0.7, stands, max_following_error=np.inf)[1].error is None
    for wrong in (0, -1, float("nan"), [0.1] * 5, [0.1, 0.1, 0, 0.1, 0.1, 0.1]):
        with pytest.raises(StreamError, match=r"max_following_error is .* it must be positive"):
            Session(PassThrough(), swing, max_following_error=wrong)


def test_another_cycle_time_and_a_jump_are_refused():
    session = Session(PassThrough(cycle=0.008), swing)
    with pytest.raises(StreamError, match=r"cycle is 4\.\d\d ms, the guard's 8\.00 ms"):
        answers(session, range(1, 40))
    with pytest.raises(StreamError, match=r"seqno jumps by 1000, 4\.03 s.*0\.25 s"):
        answers(Session(PassThrough(), swing), [1, 1001])


@pytest.mark.parametrize("end", ["iterable", "seconds", "error", "interrupt", "shape"])
def test_a_session_brakes_and_holds_at_its_end(end):
    guard = PassThrough()

    def wrong(feedback):
        if feedback.t > 0.1:
            raise errors[end]
        return START

    errors = {"error": ZeroDivisionError, "interrupt": KeyboardInterrupt, "shape": TypeError}
    references = {"iterable": [START] * 25, "shape": [START] * 25 + ["here"], "seconds": swing}
    seconds = 0.1 if end == "seconds" else None
    session = Session(guard, references.get(end, wrong), seconds=seconds, linger=0.05)
    sent = 0
    while not session.is_done:
        sent += 1
        assert answers(session, [sent])[0]
    assert guard.state == "holding"
    # 25 cycles of the reference and 12 of linger.
    assert sent == pytest.approx(38, abs=2)
    assert isinstance(session.error, errors.get(end, object))
    assert (session.error is None) == (end in ("iterable", "seconds"))
    assert session.statistics.stops == 0


def test_refused_references_are_counted_and_a_stop_once():
    session = Session(PassThrough(), iter([START, np.full(6, np.nan), np.full(6, np.nan), START]))
    answers(session, range(1, 5))
    assert (session.statistics.refused, session.statistics.stops) == (2, 1)


@pytest.mark.parametrize("mode", ["joint", "pose"])
def test_the_program_of_a_controller_has_no_findings(mode):
    robot = ROBOT.with_tool([0, 0, 0.1])
    text = egm.rapid_module(robot, START, mode=mode)
    assert f"EGMRun{mode.capitalize()} egmId,EGM_STOP_HOLD" in text
    assert "option 689-1" in text
    assert "option 3124-1" in text
    module = irbkin.rapid.parse(text)
    found = irbkin.rapid.check(robot, module)
    assert {it.code for it in found} <= {"U802"}, "EGMRun moves it, and is not followed"
    assert module["jStart"].q == pytest.approx(START, abs=1e-7)
    speed = {"joint": np.ceil(np.degrees(ROBOT.max_velocity.max())), "pose": 1000}[mode]
    assert f"MaxSpeedDeviation:={speed:g};" in text


def test_a_program_names_what_it_lacks():
    with pytest.raises(StreamError, match="mode is 'path', it must be joint or pose"):
        egm.rapid_module(ROBOT, START, mode="path")
    with pytest.raises(irbkin.InvalidJointsError, match="start must have shape"):
        egm.rapid_module(ROBOT, START[:5])
    bare = irbkin.Robot.from_mdh(ROBOT.mdh, limits=ROBOT.limits)
    with pytest.raises(StreamError, match="give max_speed"):
        egm.rapid_module(bare, START)
    with pytest.raises(StreamError, match="max_speed is nan, it must be positive"):
        egm.rapid_module(ROBOT, START, max_speed=np.nan)
    with pytest.raises(irbkin.RapidError, match="expected the module's name"):
        egm.rapid_module(ROBOT, START, name="if")
    with pytest.raises(StreamError, match=r"bridge is -0\.1 s, it must be finite"):
        Session(PassThrough(), swing, bridge=-0.1)
    with pytest.raises(StreamError, match='"pose" of six axes'):
        Session(PassThrough(irbkin.Robot("Panda")), swing, mode="pose")
