"""Solutions and modules are values: they pickle, copy, compare, slice and print."""

import collections.abc
import copy
import operator
import pickle
import sys
import weakref

import irbkin
import numpy as np
import pytest
from arms import IRB2400
from irbkin import Robot, rapid
from reference import move

REGULAR = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7]
DUPLICATES = [
    copy.copy,
    copy.deepcopy,
    *(
        lambda value, p=p: pickle.loads(pickle.dumps(value, p))
        for p in range(pickle.HIGHEST_PROTOCOL + 1)
    ),
]


def answers():
    """Answers that differ from one another, of every outcome and number of joints."""
    robot, ur, panda = Robot("IRB 2600-12/1.65"), Robot("UR5e"), Robot("Panda")
    five = Robot("SO-101")
    turned = five.fk([0.1, 0.2, 0.3, 0.4, 0.5])
    turned[:3, :3] = turned[[1, 0, 2], :3] * [[-1], [1], [1]]
    general = Robot.from_mdh(robot.mdh + np.array([0.01, 0, 0, 0]))
    stretched = np.arctan2(0.115, 0.795) - np.pi / 2
    regular = robot.ik(robot.fk(REGULAR))
    seven = panda.ik(panda.fk([0.1, 0.2, 0.3, -1.5, 0.5, 1.6, 0.7]), q7=0.7)
    return {
        "regular": regular,
        "wrist": robot.ik(robot.fk([0.1, 0.2, 0.3, 0.4, 0.0, 0.6])),
        "elbow": robot.ik(robot.fk([0.1, 0.2, stretched, 0.4, 0.5, 0.6])),
        "too far": robot.ik(move(9, 0, 0)),
        "too near": Robot("IRB 120-3/0.58").ik(move(0.01, 0, 0.362)),
        "outside limits": robot.with_limits([[3.0, 3.1]] * 6).ik(robot.fk(REGULAR)),
        "within limits": regular.within_limits(),
        "turns": regular.turns(),
        "turns, filtered": regular.turns().filter(lambda q: q[5] > 0),
        "filtered": regular.filter(lambda q: q[0] > 0),
        "filtered out": regular.filter(lambda q: False),
        "none within limits": robot.with_limits([[3.0, 3.1]] * 6)
        .ik(robot.fk(REGULAR))
        .within_limits(),
        "tool": robot.with_tool(move(0, 0, 0.1)).ik(robot.fk(REGULAR)),
        "UR": ur.ik(ur.fk(REGULAR)),
        "UR, wrist": ur.ik(ur.fk([0.3, -1.2, 1.4, 0.5, 0.0, 0.7])),
        "general": general.ik(general.fk(REGULAR)),
        "general, too far": general.ik(move(9, 0, 0)),
        "five, turned": five.ik(turned),
        "seven": seven,
        "seven, within limits": seven.within_limits(),
    }


ANSWERS = answers()


def facts(solution):
    """Everything that a solution shows."""
    return (
        tuple(solution.q),
        solution.slot,
        solution.status,
        solution.singularities,
        solution.free_joint,
        solution.is_within_limits,
        solution.residual,
        repr(solution),
    )


def test_the_answers_are_of_every_kind():
    reaches = {answer.reach for answer in ANSWERS.values()}
    assert reaches == set(irbkin.Reach)
    assert ANSWERS["wrist"][0].free_joint == (4, "q4 + q6")
    assert any(solution.free_joint for solution in ANSWERS["UR, wrist"])
    assert irbkin.Status.MERGED in irbkin.Status(int(np.max(ANSWERS["elbow"].status)))
    assert len(ANSWERS["turns"]) > len(ANSWERS["within limits"]) > 0
    assert len(ANSWERS["none within limits"]) == len(ANSWERS["filtered out"]) == 0
    assert len(ANSWERS["seven"]) > 0


@pytest.mark.parametrize("duplicate", DUPLICATES)
@pytest.mark.parametrize("name", ANSWERS)
def test_copies_and_pickles_of_answers_have_the_same_bits(name, duplicate):
    answer = ANSWERS[name]
    twin = duplicate(answer)
    assert twin == answer
    assert hash(twin) == hash(answer)
    assert (twin.reach, np.nan_to_num(twin.shortfall, nan=-1.0), twin.explain()) == (
        answer.reach,
        np.nan_to_num(answer.shortfall, nan=-1.0),
        answer.explain(),
    )
    assert (str(twin), repr(twin)) == (str(answer), repr(answer))
    for array in ("q", "q_deg", "q_by_slot", "status"):
        np.testing.assert_array_equal(getattr(twin, array), getattr(answer, array))
    assert list(map(facts, twin)) == list(map(facts, answer))
    assert twin.within_limits() == answer.within_limits()


@pytest.mark.parametrize("duplicate", DUPLICATES)
def test_copies_and_pickles_of_solutions_have_the_same_bits(duplicate):
    for answer in ANSWERS.values():
        for solution in answer:
            twin = duplicate(solution)
            assert twin == solution
            assert hash(twin) == hash(solution)
            assert facts(twin) == facts(solution)
            if solution.free_joint:
                assert twin.with_free_joint(0.3) == solution.with_free_joint(0.3)


def test_answers_are_equal_by_value():
    again = answers()
    assert all(ANSWERS[name] == again[name] for name in ANSWERS)
    names = list(ANSWERS)
    for first in names:
        equal = [second for second in names if ANSWERS[first] == ANSWERS[second]]
        assert equal == [first]
    assert (ANSWERS["regular"] == 5) is False
    assert (ANSWERS["regular"] != None) is True  # noqa: E711
    with pytest.raises(TypeError):
        operator.lt(ANSWERS["regular"], ANSWERS["wrist"])


def test_a_solution_is_in_its_answer_and_equals_itself():
    s = ANSWERS["regular"]
    assert s[0] == s[0]
    assert s[0] != s[1]
    assert s[0] in s
    assert s[0] not in ANSWERS["wrist"]
    # The same joints of another robot solve another problem.
    tool = Robot("IRB 2600-12/1.65").with_tool(move(0, 0, 0.1))
    other = tool.ik(tool.fk(s[0])).nearest(s[0])
    np.testing.assert_allclose(other.q, s[0].q, atol=1e-12)
    assert other != s[0]
    assert len({*s, *s}) == len(s)
    np.testing.assert_array_equal(s[0] == s[0].q, [True] * 6)


@pytest.mark.parametrize("name", ANSWERS)
def test_an_answer_is_a_sequence(name):
    s = ANSWERS[name]
    every = tuple(s)
    assert s[:] == every
    assert (s[:2], s[-2:], s[::-1], s[5:2]) == (every[:2], every[-2:], every[::-1], ())
    assert tuple(reversed(s)) == every[::-1]
    for i, solution in enumerate(every):
        assert s[i] == s[i - len(s)] == solution
    with pytest.raises(IndexError, match=f"solution {len(s)} of {len(s)}: "):
        s[len(s)]
    with pytest.raises(TypeError):
        s["0"]


def test_a_solution_is_a_sequence_of_its_joints():
    solution = ANSWERS["regular"][0]
    angles = solution.q.tolist()
    assert list(solution) == angles
    assert list(reversed(solution)) == angles[::-1]
    assert (solution[0], solution[-1]) == (angles[0], angles[-1])
    np.testing.assert_array_equal(solution[1:3], angles[1:3])
    assert angles[3] in solution


def test_degrees_on_request():
    s = ANSWERS["regular"]
    np.testing.assert_allclose(s.q_deg, np.rad2deg(s.q), rtol=1e-15)
    np.testing.assert_array_equal([solution.q_deg for solution in s], s.q_deg)
    assert ANSWERS["too far"].q_deg.shape == (0, 6)
    assert ANSWERS["seven"].q_deg.shape == (len(ANSWERS["seven"]), 7)


def test_weak_references():
    robot = Robot("IRB 2600-12/1.65")
    answer = robot.ik(robot.fk(REGULAR))
    module = rapid.parse("MODULE M\nENDMODULE")
    for value in (robot, answer, answer[0], module):
        assert weakref.ref(value)() is value or value == answer[0]
    reference = weakref.ref(answer)
    del answer, value
    assert reference() is None


def test_an_answer_prints_as_a_table():
    lines = str(ANSWERS["wrist"]).splitlines()
    assert lines[0] == "7 solutions, 3 inside limits"
    assert lines[1].split() == [
        "slot",
        "q1",
        "[deg]",
        *[f"q{i}" for i in range(2, 7)],
        "limits",
        "margin",
        "confdata",
        "singularities",
    ]
    assert len(lines) == 2 + 7
    assert lines[2].endswith("wrist, J4 free (q4 + q6 fixed)")
    assert " inside " in lines[2]
    assert any(" J3 outside " in line for line in lines)
    for line, solution in zip(lines[2:], ANSWERS["wrist"], strict=True):
        assert line.split()[0] == str(solution.slot)
        np.testing.assert_allclose([float(x) for x in line.split()[1:7]], solution.q_deg, atol=6e-4)
    assert str(ANSWERS["too far"]) == ANSWERS["too far"].explain()
    assert "-0.000" not in str(ANSWERS["UR, wrist"])


def test_the_linkage_is_named_where_it_alone_is_outside():
    robot = Robot("IRB 2400-10/1.55") if "IRB 2400-10/1.55" in irbkin.catalog() else None
    robot = robot or next(r for r in map(Robot, irbkin.catalog()) if r.is_coupled)
    q = [0.1, 0.2, 0.1, 0.4, 0.5, 0.6]
    narrow = robot.with_linkage_limits([-0.05, 0.0])
    assert "linkage outside" in str(narrow.ik(robot.fk(q)))


def test_a_long_table_is_cut():
    robot = Robot("IRB 2600-12/1.65").with_limits([[-20.0, 20.0]] * 6)
    turns = robot.ik(robot.fk(REGULAR)).turns()
    assert len(turns) > 1000
    lines = str(turns).splitlines()
    assert len(lines) == 51
    assert lines[-1] == f"... {len(turns) - 48} more"


@pytest.mark.parametrize("name", ["wrist", "seven", "turns, filtered"])
def test_a_damaged_answer_is_refused(name):
    answer = ANSWERS[name]
    for value in (answer, answer[0]):
        restore, (kind, state) = value.__reduce__()
        assert restore(kind, state) == value
        for size in range(len(state)):
            with pytest.raises(irbkin.InvalidModelError, match=f"the pickled {kind} is damaged"):
                restore(kind, state[:size])
        rng = np.random.default_rng(3)
        refused = 0
        for index in range(len(state)):
            changed = bytearray(state)
            changed[index] = rng.integers(256)
            try:
                other = restore(kind, bytes(changed))
            except irbkin.IrbkinError:
                refused += 1
                continue
            # Another value, but one that does not break anything.
            repr(other), hash(other), other == value
        assert refused > 5


def test_a_robot_is_represented_by_its_name_or_its_structure():
    robot = Robot("IRB 2600-12/1.65")
    assert eval(repr(robot), {"Robot": Robot}) == robot
    for other in (robot.with_tool(move(0, 0, 0.1)), Robot.from_opw(**IRB2400, name=robot.name)):
        assert repr(other) == '<Robot "IRB 2600-12/1.65": 6 joints, spherical wrist>'
    assert repr(Robot.from_opw(**IRB2400)) == "<Robot: 6 joints, spherical wrist>"


PROGRAM = """MODULE Cell
CONST robtarget pPick:=[[600,0,800],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
CONST num nHeight:=shared;
PROC main()
VAR num nLocal:=4;
MoveL pPick, v100, fine, tGrip;
ENDPROC
ENDMODULE"""
CONTEXT = "MODULE Shared\nCONST num shared:=7;\nENDMODULE"


def module():
    return rapid.parse(PROGRAM, [rapid.parse(CONTEXT)])


@pytest.mark.parametrize("duplicate", DUPLICATES)
def test_a_module_is_read_again_by_copies_and_pickles(duplicate):
    first = module()
    twin = duplicate(first)
    assert twin == first
    assert (twin.source, twin.declarations, twin.moves, twin.skipped) == (
        first.source,
        first.declarations,
        first.moves,
        first.skipped,
    )
    assert twin["nHeight"] == 7.0


def test_a_module_is_a_mapping():
    m = module()
    assert isinstance(m, collections.abc.Mapping)
    names = ["pPick", "tGrip", "nHeight"]
    assert (len(m), list(m), list(reversed(m))) == (3, names, names[::-1])
    assert list(m.keys()) == names
    assert list(m.values()) == [m[name] for name in names]
    assert list(m.items()) == [(name, m[name]) for name in names]
    assert dict(m) == dict(m.data)
    assert m.get("PPICK") == m["pPick"]
    assert m.get("other") is None
    assert m.get("other", 5) == 5
    assert "ppick" in m
    assert "nLocal" not in m
    assert 5 not in m
    with pytest.raises(TypeError):
        hash(m)
    # It is dumped as the module that it is.
    assert rapid.parse(rapid.dump(m)) == rapid.parse(str(m))
    assert "PROC main" in rapid.dump(m)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("pPlck", "did you mean pPick?"),
        ("tgripper", "did you mean tGrip?"),
        ("zz", r"it has 3 others: list\(module\)"),
        (5, r"it has 3 others: list\(module\)"),
    ],
)
def test_an_unknown_name_of_a_module_says_which_are_close(name, hint):
    with pytest.raises(KeyError, match=hint) as unknown:
        module()[name]
    assert isinstance(unknown.value, irbkin.errors.UnknownNameError)
    assert str(unknown.value).startswith(f"the module has no data of the name {name!r}; ")


def test_an_empty_module_says_that_it_has_no_data():
    with pytest.raises(irbkin.errors.UnknownNameError, match="declares none outside its routines"):
        rapid.parse("MODULE M\nENDMODULE")["p"]


@pytest.mark.parametrize(
    "make",
    [
        lambda r, q: r.ik_batch(r.fk(q)),
        lambda r, q: r.ik_batch(np.full((2, 4, 4), np.nan)),
        lambda r, q: r.configuration(q),
        lambda r, q: r.singularity(q),
        lambda r, q: r.follow(np.stack([r.fk(q[0]), move(9, 0, 0)]), q[0]),
        lambda r, q: irbkin.catalog_entry("Panda"),
    ],
)
def test_records_with_arrays_are_equal_by_value(make):
    robot, q = Robot("IRB 2600-12/1.65"), np.array([REGULAR, REGULAR[::-1]])
    record = make(robot, q)
    assert record == make(robot, q)
    assert not operator.ne(record, make(robot, q))
    assert record == tuple(record)
    assert tuple(record) == record
    assert record != tuple(record)[:-1]
    assert record != "record"
    assert record == pickle.loads(pickle.dumps(record)) == copy.deepcopy(record)
    changed = (np.array([5.0]), *tuple(record)[1:])
    assert record != changed
    assert not operator.eq(record, changed)
    with pytest.raises(TypeError, match="unhashable"):
        hash(record)


def test_a_record_is_frozen_and_unpacks():
    robot = Robot("IRB 2600-12/1.65")
    q, status = batch = robot.ik_batch(robot.fk([REGULAR]))
    assert (q is batch.q is batch[0], status is batch.status is batch[-1]) == (True, True)
    assert len(batch) == 2
    with pytest.raises(AttributeError):
        batch.q = q
    with pytest.raises(IndexError):
        batch[2]
    assert repr(robot.configuration(REGULAR)) == "Configuration(cf1=0, cf4=0, cf6=0, cfx=1)"
    assert repr(robot.ik_margin(np.stack([robot.fk(REGULAR)] * 17))) == (
        "IkMargin(margin=<array of float64 of shape (17,)>, singularities=<array of float64 of "
        "shape (17,)>, solutions=<array of uint8 of shape (17,)>)"
    )


def test_records_of_one_joint_vector_are_hashable():
    robot = Robot("IRB 2600-12/1.65")
    assert len({robot.configuration(REGULAR), robot.configuration(REGULAR)}) == 1
    assert len({robot.singularity(REGULAR), robot.singularity(REGULAR)}) == 1
    assert type(robot.configuration(REGULAR)) is irbkin.Configuration
    assert type(robot.configuration([REGULAR])) is irbkin.records.ConfigurationBatch
    assert type(robot.singularity(REGULAR)) is irbkin.records.Singularity
    assert type(robot.singularity([REGULAR]).kinds) is np.ndarray


def test_a_batch_of_configurations_goes_back_in():
    robot, q = Robot("IRB 2600-12/1.65"), np.array([REGULAR] * 4) * [[1], [-1], [2], [0.5]]
    batch = robot.configuration(q)
    found = robot.ik_configured(robot.fk(q), batch)
    np.testing.assert_allclose(found, q, atol=1e-9)
    each = [robot.configuration(row) for row in q]
    np.testing.assert_array_equal(robot.ik_configured(robot.fk(q), each), found)


def test_a_break_has_its_kind():
    robot = Robot("IRB 2600-12/1.65")
    there = robot.fk(REGULAR)
    far = robot.follow(np.stack([there, move(9, 0, 0)]), REGULAR)
    assert [broken.kind for broken in far.breaks] == [irbkin.records.BreakReason.UNREACHABLE]
    q = np.linspace([0.1, 0.2, 0.3, 0.4, 0.3, 0.6], [0.1, 0.2, 0.3, 0.4, -0.3, 0.6], 41)
    for mode in (irbkin.SingularityMode.ERROR, "error"):
        stopped = robot.follow(robot.fk(q), q[0], singularity_mode=mode)
        assert stopped.breaks[0].kind is irbkin.records.BreakReason.STOPPED
    for mode in irbkin.SingularityMode:
        assert robot.follow(robot.fk(q[:5]), q[0], singularity_mode=mode) == robot.follow(
            robot.fk(q[:5]), q[0], singularity_mode=mode.value
        )


@pytest.mark.parametrize("name", ["irbkin", "irbkin.rapid"])
def test_dir_lists_what_there_is(name):
    import importlib

    listed = dir(importlib.import_module(name))
    public = [word for word in listed if not word.startswith("_")]
    assert set(importlib.import_module(name).__all__) <= set(listed)
    assert not {"Any", "TYPE_CHECKING", "annotations", "Path", "Iterable"} & set(public)
    if name == "irbkin":
        modules = "abb body calibration map paths placement rapid ros scene trajectory"
        assert {*modules.split(), "errors", "freedom", "records"} <= set(public)
    for word in listed:
        getattr(importlib.import_module(name), word)


def test_modules_without_their_extra_are_not_listed(monkeypatch):
    """Else `help(irbkin)`, which takes every name of `dir`, would end with an ImportError."""
    import inspect

    monkeypatch.setattr(irbkin, "_EXTRAS", {"plot": "no_such_package"})
    assert "plot" not in dir(irbkin)
    monkeypatch.setattr(irbkin, "_EXTRAS", {"plot": "json"})
    assert "plot" in dir(irbkin)
    monkeypatch.undo()
    assert "map" in dict(inspect.getmembers(irbkin))


def test_a_module_without_its_extra_is_no_attribute_and_names_the_extra(monkeypatch):
    """Also where matplotlib is installed: it is taken away."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for name in [name for name in sys.modules if name.startswith("irbkin.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr(irbkin, "plot", raising=False)
    assert not hasattr(irbkin, "plot")
    with pytest.raises(AttributeError, match=r"needs matplotlib: pip install 'irbkin\[plot\]'$"):
        _ = irbkin.plot
    with pytest.raises(ImportError, match=r"needs matplotlib: pip install 'irbkin\[plot\]'$"):
        from irbkin import plot  # noqa: F401
