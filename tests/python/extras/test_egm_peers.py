"""EGM beside protobuf, with messages that are described here, and beside abbrobotegm."""

import os
import random
import resource
import socket
import threading
import time

import numpy as np
import pytest
from controllers import ROBOT, START, PassThrough, swing
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from irbkin.errors import StreamError
from irbkin.stream import egm

MESSAGES = int(os.environ.get("IRBKIN_MESSAGES", "2000"))
#: Fields of each message by number: name, type, and where it is not optional the label.
DESCRIBED = {
    "EgmHeader": "seqno uint32, tm uint32, mtype Kind",
    "Cartesian": "x double required, y double required, z double required",
    "Quaternion": "u0 double required, u1 double required, u2 double required, u3 double required",
    "Clock": "sec uint64 required, usec uint64 required",
    "EgmTimestamp": "sec uint64, nsec uint64",
    "EgmPose": "pos Cartesian, orient Quaternion, euler Cartesian",
    "CartesianSpeed": "value double repeated",
    "Joints": "joints double repeated",
    "EgmPosition": "joints Joints, cartesian EgmPose, external_joints Joints, time Clock, "
    "time_stamp EgmTimestamp",
    "EgmSpeed": "joints Joints, cartesians CartesianSpeed, external_joints Joints",
    "State": "state Kind required",
    "EgmData": "flag bool, values double repeated",
    "EgmRobot": "header EgmHeader, feedback EgmPosition, planned EgmPosition, motor_state State, "
    "mci_state State, mci_convergence_met bool, test_signals Joints, rapid_exec_state State, "
    "measured_force EgmData, utilization_rate double, move_index uint32, collision_info EgmData, "
    "rapid_from_robot EgmData, torque_ref Joints",
    "EgmSensor": "header EgmHeader, planned EgmPosition, speed_ref EgmSpeed, "
    "rapid_to_robot EgmData",
}
KINDS = 5


def described():
    """The classes of protobuf."""
    file = descriptor_pb2.FileDescriptorProto(name="egm.proto", package="egm", syntax="proto2")
    kind = file.enum_type.add(name="Kind")
    for number in range(KINDS):
        kind.value.add(name=f"K{number}", number=number)
    for name, fields in DESCRIBED.items():
        message = file.message_type.add(name=name)
        for number, field in enumerate(fields.split(", "), 1):
            own, of, *label = field.split()
            added = message.field.add(name=own, number=number)
            added.label = {"required": 2, "repeated": 3}[label[0]] if label else 1
            types = {"double": 1, "uint64": 4, "bool": 8, "uint32": 13, "Kind": 14}
            added.type = types.get(of, 11)
            if added.type in (11, 14):
                added.type_name = f".egm.{of}"
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file) if hasattr(pool, "Add") else pool.AddSerializedFile(file.SerializeToString())
    names = ("EgmRobot", "EgmSensor")
    found = (pool.FindMessageTypeByName(f"egm.{name}") for name in names)
    return dict(zip(names, map(message_factory.GetMessageClass, found), strict=True))


PEERS = described()


def drawn(of, draw):
    """A random value of a type of protobuf."""
    if of.enum_type:
        return draw.randrange(KINDS)
    bits = {4: 64, 13: 32}.get(of.type)
    if bits:
        return draw.getrandbits(draw.choice([1, 7, 8, bits])) & (2**bits - 1)
    if of.type == 8:
        return draw.random() < 0.5
    if draw.random() < 0.1:
        return draw.choice([0.0, -0.0, float("inf"), 5e-324, 1.7e308])
    return draw.uniform(-180, 180)


def filled(message, draw):
    """Fill a message at random, and return the record of it."""
    values = []
    for field in message.DESCRIPTOR.fields:
        if field.is_repeated:
            values.append(tuple(drawn(field, draw) for _ in range(draw.choice([0, 1, 6, 40]))))
            getattr(message, field.name).extend(values[-1])
        elif not field.is_required and draw.random() < 0.3:
            values.append(None)
        elif field.message_type:
            inner = getattr(message, field.name)
            inner.SetInParent()
            values.append(filled(inner, draw))
        else:
            values.append(drawn(field, draw))
            setattr(message, field.name, values[-1])
    name = message.DESCRIPTOR.name
    if name in egm.__all__:
        return getattr(egm, name)(*values)
    # What only wraps something is that here.
    return values[0] if name in ("State", "Joints", "CartesianSpeed") else tuple(values)


@pytest.mark.parametrize("name", PEERS)
def test_messages_are_those_of_protobuf_in_both_directions(name):
    draw = random.Random(name)
    for _ in range(MESSAGES // 2):
        peer = PEERS[name]()
        record = filled(peer, draw)
        data = peer.SerializeToString(deterministic=True)
        assert egm.encode(record) == data
        own = egm.decode(data, getattr(egm, name))
        assert own == record
        assert str(own) == str(record), "zeros have a sign"


def test_what_is_split_and_merged_is_read_as_protobuf_reads_it():
    draw = random.Random(5)
    for _ in range(200):
        first, second = PEERS["EgmSensor"](), PEERS["EgmSensor"]()
        filled(first, draw), filled(second, draw)
        data = first.SerializeToString() + second.SerializeToString()
        merged = PEERS["EgmSensor"].FromString(data)
        assert egm.encode(egm.decode(data, egm.EgmSensor)) == merged.SerializeToString()


def broken(count):
    """Datagrams that are cut off, changed at random, or noise."""
    draw = random.Random(9)
    good = egm.encode(
        egm.EgmRobot(
            egm.EgmHeader(7, 28, 2),
            egm.EgmPosition(tuple(np.degrees(START)), egm.EgmPose((1, 2, 3), (1, 0, 0, 0))),
            mci_state=3,
        )
    )
    for number in range(count):
        data = bytearray(good)
        if number % 3 == 0:
            del data[draw.randrange(len(data)) :]
        elif number % 3 == 1:
            for _ in range(draw.randint(1, 4)):
                data[draw.randrange(len(data))] = draw.getrandbits(8)
        else:
            data = bytearray(draw.randbytes(draw.randrange(200)))
        yield bytes(data)


def test_broken_datagrams_raise_or_are_what_protobuf_reads_and_nothing_grows():
    """What protobuf reads in another way: it skips known fields of a wrong type."""
    count = refused = read = 0
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for data in broken(10 * MESSAGES):
        count += 1
        try:
            record = egm.decode(data, egm.EgmRobot)
        except StreamError as error:
            refused += str(error).startswith("byte ")
        else:
            read += 1
            again = egm.decode(egm.encode(record), egm.EgmRobot)
            assert str(again) == str(record)
            assert PEERS["EgmRobot"].FromString(data)
    assert refused + read == count
    assert min(refused, read) > MESSAGES
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 4096


def test_abbrobotegm_reads_the_controller_and_moves_it():
    """The peer as the server: it takes the model for a controller."""
    from ABBRobotEGM import EGM

    controller = egm.Controller(ROBOT, START, delay=0.05)
    with EGM(port=0) as peer:
        address = ("127.0.0.1", peer.socket.getsockname()[1])
        own = threading.Thread(
            target=egm.play, args=(controller, address, str), kwargs={"seconds": 1.0}
        )
        own.start()
        wanted = np.degrees(START) + 0.5
        seen = []
        while own.is_alive():
            is_there, state = peer.receive_from_robot(timeout=0.2)
            if is_there:
                seen.append(state)
                peer.send_to_robot(wanted, speed_ref=np.zeros(6))
        own.join()
    assert len(seen) > 50
    assert seen[0].joint_angles == pytest.approx(np.degrees(START))
    assert seen[0].cartesian.pos == pytest.approx(ROBOT.fk(START)[:3, 3] * 1e3)
    assert seen[-1].rapid_running
    assert seen[-1].motors_on
    assert seen[-1].joint_angles == pytest.approx(np.degrees(controller.q), abs=0.1)
    assert (np.degrees(controller.q - START) > 0.2).all()


def test_abbrobotegm_reads_the_set_points_of_a_server():
    """The messages of the peer as the controller, which it has classes for."""
    from ABBRobotEGM._egm_protobuf import egm_pb2

    guard = PassThrough()
    with (
        egm.Server(guard, port=0, linger=0.02, connect=20, watchdog=2) as server,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as controller,
    ):
        controller.settimeout(20)
        own = threading.Thread(target=server.run, args=(swing,), kwargs={"seconds": 0.1})
        own.start()
        # What comes before the run is dropped.
        time.sleep(0.2)
        for seqno in range(1, 60):
            sent = egm_pb2.EgmRobot()
            sent.header.seqno, sent.header.tm, sent.header.mtype = seqno, int(seqno * 4.032), 2
            sent.feedBack.joints.joints.extend(np.degrees(START))
            sent.mciState.state = egm_pb2.EgmMCIState.MCI_RUNNING
            controller.sendto(sent.SerializeToString(), server.address)
            own.join(0.002)
            if not own.is_alive():
                break
            got = egm_pb2.EgmSensor.FromString(controller.recv(4096))
            assert got.header.mtype == egm_pb2.EgmHeader.MSGTYPE_CORRECTION
            assert got.planned.joints.joints == pytest.approx(np.degrees(guard.q))
        own.join(20)
    assert not own.is_alive()
