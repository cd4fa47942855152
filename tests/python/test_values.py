"""A robot is a value; the package is light and its names are all there."""

import copy
import pickle
import re
import subprocess
import sys
from pathlib import Path

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG, IRB2400, KUKA_KR6, LATERAL, ur_rows
from irbkin import Robot, SingularityKind, Status
from reference import move, random_pose


def variants():
    """Robots that differ from one another in one thing each."""
    plain = Robot("IRB 2600-12/1.65")
    rows = ABB["IRB 140-6/0.81"].rows
    return {
        "catalog": plain,
        "other arm": Robot("IRB 2600-12/1.85"),
        "Panda": Robot("Panda"),
        "tool": plain.with_tool(move(0, 0, 0.1)),
        "base": plain.with_base(move(0, 0, 0.1)),
        "limits": plain.with_limits(np.array([[-1.0, 1.0]] * 6)),
        "infinite limits": plain.with_limits([[-np.inf, np.inf]] * 6),
        "opw": Robot.from_opw(**LATERAL),
        "opw, named": Robot.from_opw(**LATERAL, name="mine"),
        "opw, signs": Robot.from_opw(**KUKA_KR6),
        "mdh": Robot.from_mdh(rows),
        "mdh, limits": Robot.from_mdh(rows, limits=np.array([[-1.0, 1.0]] * 6), name="mine"),
        "sdh": Robot.from_sdh(ur_rows("ur5e")),
        "seven": Robot.from_mdh(CATALOG["Panda"].rows),
        "everything": Robot.from_opw(**KUKA_KR6, name="ü")
        .with_tool(random_pose(np.random.default_rng(1)))
        .with_base(move(1, 2, 3)),
    }


VARIANTS = variants()
NAMES = list(VARIANTS)


@pytest.mark.parametrize("name", NAMES)
def test_equal_robots_are_equal_and_have_one_hash(name):
    robot, same = VARIANTS[name], variants()[name]
    assert robot is not same
    assert robot == same
    assert hash(robot) == hash(same)
    assert len({robot, same}) == 1


def test_robots_that_differ_are_not_equal():
    for first in NAMES:
        assert [VARIANTS[first] == VARIANTS[second] for second in NAMES] == [
            first == second for second in NAMES
        ]
    assert len(set(VARIANTS.values())) == len(VARIANTS)
    assert (VARIANTS["catalog"] == "IRB 2600-12/1.65") is False
    assert (VARIANTS["catalog"] != object()) is True


@pytest.mark.parametrize(
    "duplicate",
    [
        copy.copy,
        copy.deepcopy,
        *(
            lambda robot, p=p: pickle.loads(pickle.dumps(robot, p))
            for p in range(pickle.HIGHEST_PROTOCOL + 1)
        ),
    ],
)
@pytest.mark.parametrize("name", NAMES)
def test_copies_and_pickles_are_equal_and_compute_the_same_bits(name, duplicate):
    robot = VARIANTS[name]
    twin = duplicate(robot)
    assert twin == robot
    assert hash(twin) == hash(robot)
    assert (twin.name, twin.structure, twin.dof, repr(twin)) == (
        robot.name,
        robot.structure,
        robot.dof,
        repr(robot),
    )
    np.testing.assert_array_equal(twin.limits, robot.limits)
    np.testing.assert_array_equal(twin.max_velocity, robot.max_velocity)
    q = np.linspace(-0.3, 0.6, robot.dof)
    np.testing.assert_array_equal(twin.fk(q), robot.fk(q))
    if robot.structure == "spherical wrist":
        np.testing.assert_array_equal(
            twin.ik(robot.fk(q)).q_by_slot, robot.ik(robot.fk(q)).q_by_slot
        )


def test_a_damaged_pickle_is_refused():
    restore, (kind, state) = VARIANTS["everything"].__reduce__()
    assert restore(kind, state) == VARIANTS["everything"]
    assert len(state) < 600
    for size in range(len(state)):
        with pytest.raises(irbkin.InvalidModelError, match="the pickled Robot is damaged"):
            restore(kind, state[:size])
    with pytest.raises(irbkin.InvalidModelError, match="the pickled Other is damaged"):
        restore("Other", state)
    rng = np.random.default_rng(2)
    for index in range(len(state)):
        changed = bytearray(state)
        changed[index] = rng.integers(256)
        try:
            restore(kind, bytes(changed))
        except irbkin.IrbkinError:
            continue


@pytest.mark.parametrize(
    "attribute", ["name", "dof", "family", "mdh", "limits", "max_velocity", "base", "tool", "new"]
)
def test_a_robot_is_frozen(attribute):
    with pytest.raises(AttributeError):
        setattr(Robot("Panda"), attribute, None)


def test_arrays_of_a_robot_are_read_only():
    robot = Robot("IRB 2400-16/1.55").with_linkage_limits([-1, 2])
    for show in ("mdh", "flange", "base", "tool", "limits", "max_velocity", "linkage_limits"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(robot, show)[...] = 9
    limits = robot.limits.copy()
    limits[0] = [0, 1]
    np.testing.assert_array_equal(robot.with_limits(limits).limits, limits)


def test_a_new_robot_leaves_the_old_one_as_it_was():
    robot = Robot("IRB 120-3/0.58")
    robot.with_tool(move(1, 0, 0)), robot.with_base(move(1, 0, 0)), robot.with_limits([[0, 1]] * 6)
    assert robot == Robot("IRB 120-3/0.58")
    changed = robot.with_tool(move(1, 0, 0)).with_base(move(2, 0, 0)).with_limits([[0, 1]] * 6)
    assert changed.name == "IRB 120-3/0.58"
    np.testing.assert_array_equal(changed.max_velocity, robot.max_velocity)


def test_representations():
    robot = Robot("IRB 2600-12/1.65")
    assert repr(robot) == 'Robot("IRB 2600-12/1.65")'
    assert eval(repr(robot), {"Robot": Robot}) == robot
    assert repr(Robot.from_opw(**IRB2400)) == "<Robot: 6 joints, spherical wrist>"
    assert repr(Robot.from_opw(**IRB2400, name="mine")) == (
        '<Robot "mine": 6 joints, spherical wrist>'
    )
    solutions = robot.ik(robot.fk(np.deg2rad([10, -20, 30, 40, 50, 60])))
    assert repr(solutions) == "Solutions(8 solutions, 4 inside limits)"
    assert (
        repr(solutions[0])
        == "Solution(slot 0: [10.000, -20.000, 30.000, 40.000, 50.000, 60.000] deg, inside limits)"
    )


def test_the_catalog_is_a_tuple_of_names_without_doubles():
    names = irbkin.catalog()
    assert isinstance(names, tuple)
    assert len(set(names)) == len(names) > 0
    assert all(Robot(name).name == name for name in names)


@pytest.mark.parametrize("name", ["IRB 2400-10/1.55", "UR5e", "Panda", "CRB 15000-5/0.95"])
def test_an_entry_of_the_catalog_has_what_the_robot_has(name):
    entry, robot = irbkin.catalog_entry(name), Robot(name)
    assert (entry.name, entry.dof, entry.is_coupled) == (name, robot.dof, robot.is_coupled)
    np.testing.assert_array_equal(entry.limits, robot.limits)
    np.testing.assert_array_equal(entry.max_velocity, robot.max_velocity)
    assert entry.maker in ("ABB", "Universal Robots", "Franka", "FANUC", "UFACTORY")
    assert entry.sources >= 1
    assert entry.provenance
    assert all(Robot(alias) == robot for alias in entry.aliases)
    assert Robot(f"{entry.maker} {name}") == robot
    assert name in irbkin.catalog(reach=entry.reach and (entry.reach, entry.reach))
    assert name in irbkin.catalog(payload=entry.payload and (entry.payload, entry.payload))


def test_an_unknown_name_has_no_entry():
    with pytest.raises(irbkin.UnknownRobotError, match="close names"):
        irbkin.catalog_entry("IRB 2600-12/1.66")


def test_status_and_kind_have_the_bits_of_rust():
    """The declaration of the flags in Rust, and in Python."""
    source = (Path(__file__).parents[2] / "src/kinematics/answer/status.rs").read_text()
    bits = {
        name: int(value)
        for name, value in re.findall(r"^ +const (\w+) = (\d+);", source, re.MULTILINE)
    }
    assert len(bits) == 8
    assert {flag.name: flag.value for flag in Status} == bits
    assert {flag.name: flag.value for flag in SingularityKind} == {
        name: bits[name] for name in ("WRIST", "ELBOW", "SHOULDER")
    }


def test_status_and_kind_are_what_a_solve_returns():
    """A pose for each flag: which bits Rust writes there is read by the names that Python has for
    them.
    """
    robot = Robot("IRB 2600-12/1.65")
    stretched = np.arctan2(0.115, 0.795) - np.pi / 2
    along, across = 0.7, np.hypot(0.795, 0.115)
    # q2 that puts the wrist center on axis 1, the forearm square to the upper arm.
    over_axis_1 = np.arcsin(-0.15 / np.hypot(along, across)) - np.arctan2(across, along)
    postures = {
        Status.WRIST: [0.1, 0.2, 0.3, 0.4, 0.0, 0.6],
        Status.ELBOW: [0.1, 0.2, stretched, 0.4, 0.5, 0.6],
        Status.SHOULDER: [0.1, over_axis_1, stretched + np.pi / 2, 0.4, 0.5, 0.6],
    }
    for flag, q in postures.items():
        T = robot.fk(q)
        assert Status(robot.singularity(q).kinds) == flag
        status = robot.ik_batch(T[None]).status[0]
        assert any(Status.FOUND | flag in Status(bits) for bits in status)
        assert any(Status(bits) == Status.MERGED | flag for bits in status)
        assert flag.value in [solution.singularities.value for solution in robot.ik(T)]
        assert all(type(solution.singularities) is SingularityKind for solution in robot.ik(T))
    regular = robot.ik_batch(robot.fk([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])[None]).status[0]
    assert {Status(bits) for bits in regular} == {Status.FOUND, Status.FOUND | Status.WITHIN_LIMITS}
    assert {Status(bits) for bits in robot.ik_batch(np.full((1, 4, 4), np.nan)).status[0]} == {
        Status.INVALID
    }


@pytest.mark.parametrize("module", ["irbkin", "irbkin.errors", "irbkin.records"])
def test_every_exported_name_is_there(module):
    __import__(module)
    exported = sys.modules[module].__all__
    assert len(set(exported)) == len(exported)
    for name in exported:
        assert getattr(sys.modules[module], name) is not None


def test_the_root_has_few_names():
    assert len(irbkin.__all__) <= 42


def test_every_public_thing_has_a_docstring():
    for name in irbkin.__all__:
        thing = getattr(irbkin, name)
        if callable(thing):
            assert thing.__doc__, name
    records = [getattr(irbkin.records, name) for name in irbkin.records.__all__]
    for owner in (Robot, irbkin.Solution, irbkin.Solutions, *records):
        for name in dir(owner):
            assert name.startswith("_") or getattr(owner, name).__doc__, f"{owner.__name__}.{name}"


def test_the_version_is_that_of_the_distribution():
    from importlib.metadata import version

    assert irbkin.__version__ == version("irbkin")


def fresh(code):
    """The output of a new interpreter."""
    return subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    ).stdout


def test_a_status_is_made_from_an_element_of_a_status_array():
    """In a new interpreter: once a combination has been made from an int, it is found for any
    number.
    """
    assert fresh("import numpy, irbkin; print(int(irbkin.Status(numpy.uint8(44))))") == "44\n"


def test_importing_brings_nothing_but_numpy():
    code = """
import sys
before = set(sys.modules)
import irbkin
print(*sorted({name.partition(".")[0] for name in set(sys.modules) - before}))
"""
    brought = set(fresh(code).split())
    assert brought - set(sys.stdlib_module_names) - {"numpy"} == {"irbkin"}


def test_a_tool_is_a_pose_a_translation_or_tooldata():
    robot = irbkin.Robot("UR5e")
    wanted = robot.with_tool(irbkin.pose([0.01, 0.02, 0.1]))
    assert robot.with_tool([0.01, 0.02, 0.1]) == wanted
    tool = irbkin.rapid.ToolData(tframe=irbkin.rapid.Pose.of(wanted.tool))
    assert robot.with_tool(tool) == wanted
    assert robot.with_base([0.01, 0.02, 0.1]) == robot.with_base(wanted.tool)
