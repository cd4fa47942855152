"""EGM: bytes of messages, and what a session answers to datagrams."""

import struct

import irbkin
import numpy as np
import pytest
from controllers import ROBOT, START, PassThrough, swing
from irbkin.errors import StreamError
from irbkin.stream import egm
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


@pytest.mark.parametrize("release", ["RW6", "RW7"])
@pytest.mark.parametrize("mode", ["joint", "pose"])
def test_the_program_of_a_controller_has_no_findings(release, mode):
    robot = ROBOT.with_tool([0, 0, 0.1])
    text = egm.rapid_module(robot, START, release=release, mode=mode)
    assert f"EGMRun{mode.capitalize()} egmId,EGM_STOP_HOLD" in text
    assert ("option 689-1" in text) == (release == "RW6")
    module = irbkin.rapid.parse(text)
    found = irbkin.rapid.check(robot, module)
    assert {it.code for it in found} <= {"U802"}, "EGMRun moves it, and is not followed"
    assert module["jStart"].q == pytest.approx(START, abs=1e-7)
    speed = {"joint": np.ceil(np.degrees(ROBOT.max_velocity.max())), "pose": 1000}[mode]
    assert f"MaxSpeedDeviation:={speed:g};" in text


def test_a_program_names_what_it_lacks():
    with pytest.raises(StreamError, match="release is 'RW8'"):
        egm.rapid_module(ROBOT, START, release="RW8")
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
