"""Robots from RobotStudio's files: what is in them is read, what contradicts itself is refused."""

import os
import subprocess
import sys

import numpy as np
import pytest
import robotstudio_files as files
from irbkin import Robot
from irbkin._robotstudio import elements
from irbkin.errors import InvalidModelError

SPELLINGS = ("attributes", "values")
ENDINGS = ("rslib", "rsstn", "rsstnx", "rspag")
STATION = (files.definition(), files.instance())
# At (10, 20, 30, 40, 50, 60) deg: calculated by other means than this package.
AT_Q = np.array(
    [
        [-0.159316396, 0.855331306, 0.492977324],
        [-0.121310106, 0.478609755, -0.869607130],
        [0.724727799, 0.172789065, 0.407480470],
    ]
)


def written(folder, content, name="arm.rsstnx"):
    path = folder / name
    path.write_bytes(content)
    return path


def refused(folder, content, words, name="arm.rsstnx", **options):
    """The message on a file, which begins with its path."""
    path = written(folder, content, name)
    with pytest.raises(InvalidModelError, match=words) as caught:
        Robot.from_robotstudio(path, **options)
    assert str(caught.value).startswith(f"{path}: ")
    return str(caught.value)


def is_the_arm(robot, limits=files.LIMITS):
    pose = robot.fk(files.Q)
    found = np.stack([pose[:3, 0], pose[:3, 2], pose[:3, 3]])
    np.testing.assert_allclose(found, AT_Q, atol=2e-9)
    assert robot.structure == "spherical wrist"
    np.testing.assert_allclose(robot.limits, limits, atol=1e-12)
    assert len(robot.ik(pose)) == 8


@pytest.mark.parametrize("spelling", SPELLINGS)
@pytest.mark.parametrize("ending", ENDINGS)
def test_the_arm_of_a_file_is_the_arm(tmp_path, ending, spelling):
    content = files.pim(*STATION, spelling=spelling)
    if ending in ("rslib", "rsstn"):
        content = files.archive({"PIM.xml": content, "Streams/1.gfx": b"\0" * 100})
    if ending == "rspag":
        inner = files.archive({"PIM.xml": content})
        content = files.archive({"Stations/My cell.rsstn": inner, "Other/a.txt": b"x"})
    robot = Robot.from_robotstudio(written(tmp_path, content, f"arm.{ending}"))
    is_the_arm(robot)
    assert robot.name == "SYN6_5_120__01"
    assert Robot.from_robotstudio(tmp_path / f"arm.{ending}", "syn6_5_120__01") == robot


def test_a_library_without_an_instance_is_named_by_its_model(tmp_path):
    robot = Robot.from_robotstudio(written(tmp_path, files.pim(files.definition())))
    is_the_arm(robot)
    assert robot.name == "SYN6_5_120"


def test_a_station_that_refers_to_a_library_has_axes_alone_and_says_so(tmp_path):
    station = files.pim(files.instance(document=1), more=files.REFERENCE)
    robot = Robot.from_robotstudio(written(tmp_path, station))
    assert robot.name == "SYN6_5_120__01 (without limits and flange)"
    assert np.isinf(robot.limits).all()
    np.testing.assert_allclose(robot.fk(files.Q), files.poses(files.Q)[-1], atol=1e-12)
    # A pose that is older than its joints does not matter.
    old = files.instance(document=1, q=files.Q, at=[np.eye(4), *files.poses(files.POSE)])
    again = Robot.from_robotstudio(written(tmp_path, files.pim(old, more=files.REFERENCE)))
    assert again == robot


def test_axes_in_millimeters_are_refused(tmp_path):
    links = [np.eye(4), *files.poses(np.zeros(6))]
    for link in links:
        link[:3, 3] *= 1e3
    station = files.pim(files.instance(document=1, links=links))
    refused(tmp_path, station, "1.01e.03 m from its base, at most 10 m .is it in millimeters")


def test_a_number_in_another_file_is_no_definition_of_its_own(tmp_path):
    content = files.pim(files.definition(base=np.eye(4)), files.instance(document=3))
    robot = Robot.from_robotstudio(written(tmp_path, content), "SYN6_5_120__01")
    assert robot.name.endswith("(without limits and flange)")


def test_limits_that_a_station_edits_are_its_own(tmp_path):
    limits = files.LIMITS * 0.5
    edited = files.instance(document=1, limits=files.matrix_of(limits))
    robot = Robot.from_robotstudio(written(tmp_path, files.pim(edited, more=files.REFERENCE)))
    assert robot.name == "SYN6_5_120__01 (without flange)"
    np.testing.assert_allclose(robot.limits, limits, atol=1e-12)
    edited = files.pim(files.definition(), files.instance(limits=files.matrix_of(limits)))
    is_the_arm(Robot.from_robotstudio(written(tmp_path, edited)), limits)


def test_a_library_that_is_packed_beside_its_station_is_read(tmp_path):
    station = files.pim(files.instance(document=1), more=files.REFERENCE)
    library = files.archive({"PIM.xml": files.pim(*STATION)})
    members = {"Libraries/SYN6_5_120__01.rslib": library, "Station/s.rsstnx": station}
    path = written(tmp_path, files.archive(members), "all.rspag")
    is_the_arm(Robot.from_robotstudio(path))


def test_of_several_arms_one_is_named(tmp_path):
    # Of one model, too.
    other = files.instance(key=100, name="SYN6_5_120__02")
    content = files.pim(*STATION, other, spelling="attributes")
    said = refused(tmp_path, content, "several arms, pass name= to choose one")
    assert '"SYN6_5_120__01" of 6 joints, "SYN6_5_120__02" of 6 joints' in said
    is_the_arm(Robot.from_robotstudio(tmp_path / "arm.rsstnx", name="SYN6_5_120__02"))
    with pytest.raises(InvalidModelError, match="no arm 'x' of 6 or 7 joints; it has \"SYN6"):
        Robot.from_robotstudio(tmp_path / "arm.rsstnx", name="x")


def test_what_is_no_arm_is_listed(tmp_path):
    def only(**options):
        return refused(tmp_path, files.pim(files.definition(**options)), "no arm of 6 or 7 joints")

    assert '"SYN6_5_120" of 4 joints' in only(
        active=4, rows=files.ROWS[:4], limits=files.matrix_of()
    )
    empty = np.empty((0, 0)), np.empty(0)
    assert '"tool" of 0 joints' in only(active=0, flange=None, model="tool", limits=empty)
    refused(tmp_path, files.pim(), "it has no mechanism")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"kinds": [True] * 5 + [False]}, "joint 6 is prismatic"),
        ({"following": [1, 2, 3, 4, 5, 1]}, "two links lead to one joint: closed loops"),
        ({"following": [1, 2, 3, 4, 5, 0]}, "two links lead to one joint|closed|loop"),
        ({"custom": "true"}, "a UsingCustomFwdKin .as closed loops have., which is not supported"),
        ({"dependency": np.diag([1, 1, 1, 1, 1, 0.7])}, "do not follow the 6 active ones"),
        ({"rows": [(0, 0, 0, 0), *np.multiply(files.ROWS[1:], [1, 1e3, 1, 1e3])]}, "millimeters"),
        ({"base": np.diag([1.0, 1.0, -1.0, 1.0])}, "element is not a rigid transform"),
        ({"limits": (np.eye(6), np.ones(6))}, "an upper and a lower limit of each"),
        ({"limits": (np.eye(6), np.ones(5))}, "36 numbers for 5 bounds"),
        ({"following": [1, 2, -1, 4, 5, -1]}, "behind 3 joints; an arm has 6 or 7"),
    ],
)
def test_a_table_that_is_no_arm_is_refused(tmp_path, options, words):
    refused(tmp_path, files.pim(files.definition(**options)), words)


@pytest.mark.parametrize(
    ("joint", "column", "by"), [(1, 1, 1e-4), (3, 3, -1e-4), (4, 2, np.radians(1))]
)
def test_a_table_that_its_own_links_contradict_is_refused(tmp_path, joint, column, by):
    rows = np.array(files.ROWS)
    rows[joint, column] += by
    content = files.pim(files.definition(rows=rows), files.instance())
    refused(tmp_path, content, f"link {joint + 1} .Link{joint + 1}. is .* from where the file")


def test_limits_that_couple_axes_are_a_linkages_or_an_error(tmp_path):
    limits = files.matrix_of(coupled=files.COUPLED)
    content = files.pim(files.definition(limits=limits))
    refused(tmp_path, content, r"its limit 1 q2 \+ 1 q3 <= 140 deg couples axes")
    is_the_arm(Robot.from_robotstudio(tmp_path / "arm.rsstnx", coupled_limits=False))
    # Joint 3 of the table is turned by -q2: the controller's is measured from the base.
    linkage = np.eye(6)
    linkage[2, 1] = -1.0
    rod = [([0, -1, 1, 0, 0, 0], 70.0), ([0, 1, -1, 0, 0, 0], 40.0)]
    for own, wanted in ((rod, [-40, 70]), ((), None)):
        limits = files.matrix_of(coupled=own)
        content = files.pim(files.definition(dependency=linkage, limits=limits))
        robot = Robot.from_robotstudio(written(tmp_path, content))
        assert robot.is_coupled
        np.testing.assert_allclose(robot.limits, files.LIMITS, atol=1e-12)
        serial = files.Q - [0, 0, files.Q[1], 0, 0, 0]
        np.testing.assert_allclose(
            robot.fk(files.Q), files.poses(serial)[-1] @ files.OFFSET, atol=1e-12
        )
        if wanted:
            np.testing.assert_allclose(np.degrees(robot.linkage_limits), wanted, atol=1e-9)
    other = files.matrix_of(coupled=[([0, 1, 1, 0, 0, 0], 70.0)])
    content = files.pim(files.definition(dependency=linkage, limits=other))
    refused(tmp_path, content, "couples axes")


def test_rods_of_a_station_show_the_linkage_or_are_an_error(tmp_path):
    serial = files.Q - [0, 0, files.Q[1], 0, 0, 0]
    turned = [np.eye(4), *files.poses(serial)]
    own = files.instance(document=1, q=files.Q, at=turned, extra=["LinkS1"])
    robot = Robot.from_robotstudio(written(tmp_path, files.pim(own)))
    assert robot.is_coupled
    np.testing.assert_allclose(robot.fk(files.Q), turned[-1], atol=1e-12)
    at_zero = files.pim(files.instance(document=1, extra=["LinkS1"]))
    refused(tmp_path, at_zero, "whether LinkS1 turns joint 3 with joint 2: save the station")
    # Links of a hose are none of its own.
    Robot.from_robotstudio(written(tmp_path, files.pim(files.instance(document=1, extra=["c1"]))))


@pytest.mark.parametrize("part", [0.01, 0.3, 0.7, 0.99])
def test_a_file_that_is_not_whole_is_refused(tmp_path, part):
    for name, content in {
        "arm.rslib": files.archive({"PIM.xml": files.pim(*STATION)}),
        "arm.rsstnx": files.pim(*STATION),
    }.items():
        refused(tmp_path, content[: int(part * len(content))], "is not XML|broken", name)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is no .rslib, .rsstn, .rspag or .rsstnx"),
        (b"version https://git-lfs.github.com/spec/v1", "is no .rslib"),
        (b"PK\3\4broken", "is a broken archive"),
        (b"<!DOCTYPE a [<!ENTITY b 'bb'>]><a>&b;</a>", "has a <!DOCTYPE>"),
        ("<?xml version='1.0' encoding='utf-16'?><!DOCTYPE a><a/>".encode("utf-16"), "is no"),
        (b"<a>\xff</a>", "is not UTF-8 at byte 3"),
        (b"<a>" * 100_000, "is not XML"),
    ],
)
def test_what_is_none_of_these_files_is_refused(tmp_path, content, words):
    refused(tmp_path, content, words)


def test_sizes_are_checked_before_they_are_read(tmp_path, monkeypatch):
    monkeypatch.setattr(elements, "MOST_XML", 10_000)
    held = files.archive({"PIM.xml": b"<a>" + b" " * 50_000_000 + b"</a>"})
    assert len(held) < 100_000
    said = refused(tmp_path, held, "PIM.xml has 50000007 bytes, at most 10000 are read", "a.rslib")
    assert said
    # A size that is too small is no way around.
    lie = held.replace((50_000_007).to_bytes(4, "little"), (100).to_bytes(4, "little"))
    refused(tmp_path, lie, "broken archive|not XML", "a.rslib")
    refused(tmp_path, b"<a>" + b" " * 20_000 + b"</a>", "more than 10000 bytes")
    monkeypatch.setattr(elements, "MOST_BYTES", 10_000)
    several = {f"Libraries/{i}.rslib": files.archive({"PIM.xml": bytes(6_000)}) for i in range(3)}
    refused(tmp_path, files.archive(several), "a", "a.rspag")


def mechanism(inside, key=1, document=-1):
    definition = f'<Definition DocID="{document}" ID="5"/>'
    return f'<MechanismInstance ID="{key}" NumJoints="6">{definition}{inside}</MechanismInstance>'


def link(count):
    frame = f"<CorrectionTransform>{'<a/>' * count}1 2 3</CorrectionTransform>"
    return (
        f'<MechanismLinkInstance ID="5">{frame}<Transform>1 2 3</Transform></MechanismLinkInstance>'
    )


CHILDREN = "<ChildInstances>" + "<c ID='5'/>" * 4_000 + "</ChildInstances>"
SEVERAL = "".join(mechanism("", key) for key in range(500))


def limits(inside):
    return mechanism(f"<JointLimitsVector>{inside}</JointLimitsVector>")


@pytest.mark.parametrize(
    ("body", "is_packed"),
    [
        (mechanism(CHILDREN) + link(12_000), False),
        (mechanism(CHILDREN) + link(100_000), True),
        ('<MechanismDef ID="5">' + "<a/>" * 12_000 + "</MechanismDef>" + SEVERAL, False),
        (
            '<DocRef ID="1">'
            + "<a/>" * 12_000
            + "</DocRef>"
            + "".join(mechanism("", key, 1) for key in range(500)),
            False,
        ),
        (limits("<a>" * 900 + "<b/>" * 20_000 + "</a>" * 900), False),
        (limits(f"<a>{'1 ' * 450_000}</a>" * 9), True),
        ("<a/>" * 2_400_000, True),
        (mechanism("<a/>" * 2_400_000), True),
    ],
)
def test_a_file_of_100_kb_takes_a_second_and_150_mb(tmp_path, body, is_packed):
    file = tmp_path / "a.rslib"
    content = f"<P>{body}</P>".encode()
    if is_packed:
        # Geometry, which is not read, lets so much be unpacked.
        content = files.archive({"PIM.xml": content, "shape.bin": os.urandom(85_000)})
    assert len(content) < 110_000
    file.write_bytes(content)
    words = (
        "import irbkin, numpy, resource, sys, time\n"
        "used = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "from irbkin._robotstudio import mechanisms\n"
        "began, before = time.process_time(), used()\n"
        "try:\n"
        "    irbkin.Robot.from_robotstudio(sys.argv[1])\n"
        "except irbkin.InvalidModelError:\n"
        "    print(time.process_time() - began, (used() - before) / 1024)\n"
    )
    command = [sys.executable, "-c", words, str(file)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    seconds, megabytes = map(float, done.stdout.split())
    # Half as much again for the other processes of this machine.
    assert seconds < 1.5
    assert megabytes < 150.0


def test_what_is_unpacked_is_bounded_by_the_size_of_the_file(tmp_path):
    held = files.archive({"PIM.xml": b"<a>" + b" " * 2_000_000 + b"</a>"})
    refused(tmp_path, held, "PIM.xml has 2000007 bytes, at most 1048576 are read", "a.rslib")


def test_a_missing_file_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError):
        Robot.from_robotstudio(tmp_path / "none.rslib")


def test_commands_take_such_a_file_in_place_of_a_name(tmp_path):
    def fk(robot):
        words = [sys.executable, "-m", "irbkin", "fk", robot, *map(str, range(10, 70, 10)), "--csv"]
        return subprocess.run(words, capture_output=True, text=True, timeout=60)

    other = files.instance(key=100, name="SYN6_5_120__02", of=40)
    path = written(tmp_path, files.pim(*STATION, other, files.definition(key=40)))
    done = fk(f"{path}:SYN6_5_120__02")
    assert done.returncode == 0, done.stderr
    row = [float(word) for word in done.stdout.splitlines()[1].split(",")[:3]]
    np.testing.assert_allclose(row, AT_Q[2] * 1e3, atol=1e-5)
    done = fk(str(path))
    assert done.returncode == 2
    assert 'several arms, give FILE:NAME to choose one: "SYN6_5_120__01" of' in done.stderr
