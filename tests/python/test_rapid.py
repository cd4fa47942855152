"""RAPID through Python: what is written is read again, invalid text is reported, what is computed
is ABB's.
"""

import inspect
import pickle
import subprocess
import sys

import irbkin
import numpy as np
import pytest
from cases import RAX, numbers, read
from hypothesis import given
from hypothesis import strategies as st
from irbkin import Configuration, RapidError, rapid
from irbkin.rapid import JointTarget, LoadData, Pose, RobTarget, ToolData, WobjData

FLOATS = st.floats(allow_nan=False, allow_infinity=False).map(lambda number: number + 0.0)
SMALL = st.integers(-9, 9)


def tuples(count, of=FLOATS):
    return st.tuples(*[of] * count)


POSES = st.builds(Pose, tuples(3), tuples(4))
TARGETS = st.builds(
    RobTarget, tuples(3), tuples(4), st.builds(Configuration, SMALL, SMALL, SMALL, SMALL), tuples(6)
)
JOINTS = st.builds(JointTarget, tuples(6), tuples(6))
LOADS = st.builds(LoadData, FLOATS, tuples(3), tuples(4), tuples(3))
TOOLS = st.builds(ToolData, st.booleans(), POSES, LOADS)
TEXTS = st.text(
    st.characters(
        codec="utf-8", exclude_characters="\n\r", exclude_categories=("Cc", "Cs", "Zl", "Zp")
    ),
    max_size=20,
)
WOBJS = st.builds(WobjData, st.booleans(), st.booleans(), TEXTS, POSES, POSES)
RECORDS = st.one_of(TARGETS, JOINTS, TOOLS, WOBJS, POSES, LOADS)
ANY = st.one_of(
    RECORDS,
    FLOATS,
    tuples(3),
    tuples(4),
    tuples(6),
    st.builds(Configuration, SMALL, SMALL, SMALL, SMALL),
)
ARRAYS = st.integers(1, 3).flatmap(
    lambda count: st.one_of(
        [st.lists(of, min_size=count, max_size=count) for of in (TARGETS, FLOATS)]
    )
)
NAMES = st.integers(0, 10**6).map("d{}".format)

PROGRAM = """%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
MODULE Weld(NOSTEPIN)
  ! The gun, and where the fixture stands.
  PERS tooldata tGun := [TRUE,[[0,0,110],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wFix := [FALSE,TRUE,"",[[300,-175,1],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  LOCAL CONST robtarget p10 := [[425,325,308],[0,-0.707106781,0.707106781,0],[0,0,-1,0],\
[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget path{2} := [p10, Offs(p10,0,0,10)];
  VAR num free;
  CONST speeddata vSlow := [10,10,10,10];
  PROC main()
    MoveJ P10, v100, fine, tGun\\WObj:=wFix;
    MoveL RelTool(path{2},0,0,5), vSlow, z10, tGun\\WObj:=wFix;
    SetDO do1, 1;
  ENDPROC
ENDMODULE
"""


@given(RECORDS)
def test_a_record_that_was_dumped_is_read_again(record):
    assert rapid.parse(rapid.dump(record)) == record


@pytest.mark.parametrize("value", [rapid.SpeedData(100), (0.0, 0.0, 1.0), [1.0, 2.0], 5.5])
def test_a_value_whose_shape_does_not_determine_its_type_is_read_in_a_module_only(value):
    with pytest.raises(irbkin.RapidError):
        rapid.parse(rapid.dump(value))
    assert rapid.parse(rapid.dump({"value": value}))["value"] == value


@given(st.dictionaries(NAMES, st.one_of(ANY, ARRAYS), max_size=6))
def test_data_that_were_dumped_are_read_again_by_their_names(data):
    module = rapid.parse(rapid.dump(data, name="Targets"))
    assert module.name == "Targets"
    assert dict(module.data) == data
    assert rapid.parse(rapid.dump(module)) == module


def test_a_module_says_what_it_declares_and_how_it_moves():
    module = rapid.parse(PROGRAM)
    assert (module.name, module.attributes) == ("Weld", ("NOSTEPIN",))
    assert list(module.data) == ["tGun", "wFix", "p10", "path", "free", "vSlow"]
    assert module["PATH"][1].trans_mm == (425, 325, 318)
    assert module["free"] is None
    assert "nothing" not in module
    with pytest.raises(KeyError, match="nothing"):
        module["nothing"]
    p10 = module.declarations[2]
    assert (p10.data_type, p10.scope, p10.storage, p10.routine, p10.line) == (
        "robtarget",
        "LOCAL",
        "CONST",
        None,
        9,
    )
    joint, line = module.moves
    assert (joint.kind, joint.routine, joint.speed, joint.zone) == ("MoveJ", "main", "v100", "fine")
    assert (joint.target.value, joint.tool.value, joint.wobj.value) == (
        module["p10"],
        module["tGun"],
        module["wFix"],
    )
    # The tool looks down: 5 mm along its z are 5 mm less.
    np.testing.assert_allclose(line.target.value.trans_mm, (425, 325, 313), atol=1e-6)
    assert [(part.line, part.what) for part in module.skipped] == [
        (16, "SetDO is not an instruction that is read"),
    ]
    assert rapid.parse(rapid.dump(module)) == module
    assert repr(module) == 'Module("Weld": 6 data, 2 moves, 1 skipped)'
    with pytest.raises(TypeError):
        hash(module)


def test_new_values_change_nothing_else_in_the_text():
    module = rapid.parse(PROGRAM)
    target = RobTarget((1, 2, 3), (1, 0, 0, 0), (0, 1, -1, 2))
    text = module.rewritten({"p10": target, "path": [target, target], "free": 2.5})
    again = rapid.parse(text)
    assert (again["p10"], again["path"], again["free"]) == (target, [target, target], 2.5)
    assert again["tGun"] == module["tGun"]
    before, after = PROGRAM.splitlines(), text.splitlines()
    assert [
        number
        for number, lines in enumerate(zip(before, after, strict=True), 1)
        if lines[0] != lines[1]
    ] == [
        9,
        10,
        11,
    ]
    with pytest.raises(RapidError, match="the module has no data named"):
        module.rewritten({"nothing": target})
    with pytest.raises(RapidError, match=r"path has dimensions \[2\], the new value has \[1\]"):
        module.rewritten({"path": [target]})
    with pytest.raises(RapidError, match="p10 is jointtarget, it must be robtarget"):
        module.rewritten({"p10": JointTarget((0,) * 6)})


def test_frames_may_be_written_as_rapid_writes_them():
    assert ToolData(True, [[1, 2, 3], [1, 0, 0, 0]]) == ToolData(tframe=Pose((1, 2, 3)))
    assert WobjData(uframe=((1, 2, 3), (0, 1, 0, 0))).uframe == Pose((1, 2, 3), (0, 1, 0, 0))
    with pytest.raises(RapidError, match="Pose: trans_mm must be 3 finite numbers"):
        WobjData(oframe=((1, 2), (0, 1, 0, 0)))


def test_numpy_s_numbers_and_truths_are_taken():
    assert RobTarget(np.array([1, 2, 3]), robconf=np.array([0, 1, 2, 3])) == RobTarget(
        (1, 2, 3), robconf=(0, 1, 2, 3)
    )
    assert ToolData(robhold=np.bool_(False)).robhold is False
    assert (rapid.dump(np.int64(3)), rapid.dump(np.array([1.0, 2.0, 3.0]))) == ("3", "[1,2,3]")
    assert rapid.parse(b"[[1,2,3],[1,0,0,0]]") == Pose((1, 2, 3))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_files_are_of_any_usual_encoding(tmp_path, encoding):
    path = tmp_path / "Modul.mod"
    frames = "[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]"
    text = f'MODULE M\n! größe\nCONST wobjdata w:=[FALSE,FALSE,"STÄTION",{frames}];\nENDMODULE'
    path.write_bytes(text.encode(encoding))
    assert rapid.load(path)["w"].ufmec == "STÄTION"


def test_an_invalid_file_is_reported_with_its_path_line_and_column(tmp_path):
    path = tmp_path / "broken.mod"
    path.write_text(
        "MODULE M\n"
        "  CONST robtarget p:=[[1,2],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "ENDMODULE"
    )
    with pytest.raises(
        RapidError,
        match=r"broken\.mod: line 2, column \d+: robtarget p: trans has 2 components, "
        r"it must have 3",
    ) as caught:
        rapid.load(path)
    assert caught.value.line == 2
    assert caught.value.column > 0
    with pytest.raises(OSError, match=r"nothing\.mod"):
        rapid.load(tmp_path / "nothing.mod")


HOLDS_ITSELF = []
HOLDS_ITSELF.append(HOLDS_ITSELF)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: RobTarget((1, 2)), "RobTarget: trans_mm must be 3 finite numbers, got \\(1, 2\\)"),
        (lambda: RobTarget((1, 2, 3), robconf=(0, 0.5, 0, 0)), "robconf must be 4 whole numbers"),
        (lambda: JointTarget("abcdef"), "robax_deg must be 6 finite numbers"),
        (lambda: rapid.dump(object()), "is not RAPID data"),
        (lambda: rapid.dump(float("inf")), "not finite"),
        (lambda: rapid.dump({"no name": 1.0}), '"no name" is not a RAPID identifier'),
        (lambda: LoadData(mass_kg=np.inf), "mass_kg must be a finite number"),
        (lambda: rapid.dump({"a": [[1.0], [1.0, 2.0]]}), "its lists have different lengths"),
        (lambda: rapid.dump({"a": []}), "at least one element"),
        (lambda: rapid.dump(HOLDS_ITSELF), "an array has one to 3 dimensions"),
        (
            lambda: rapid.parse("[[1,2,3]]"),
            "is not a robtarget, jointtarget, tooldata, wobjdata, pose or loaddata",
        ),
        (lambda: rapid.dump({1: 1.0}), "1 is not a RAPID identifier"),
        (lambda: rapid.dump(b"abc"), "is not RAPID data"),
        (lambda: rapid.dump(True), "is not RAPID data"),
        (lambda: rapid.parse("[[1,2,3],[1,0,0,0]"), r"line 1, column 1: \[ is not closed"),
        (lambda: RobTarget("123"), "trans_mm must be 3 finite numbers, got '123'"),
        (
            lambda: RobTarget((1, 2, 3), robconf=(2**40, 0, 0, 0)),
            "4 whole numbers of at most 2147483647",
        ),
        (
            lambda: ToolData(tframe=np.eye(4)),
            r"ToolData: tframe must be a Pose \(Pose.of\(T\) makes one",
        ),
        (lambda: ToolData(Pose((1, 2, 3))), "ToolData: robhold must be True or False"),
        (lambda: WobjData(ufmec=None), "WobjData: ufmec must be a str, got None"),
        (lambda: LoadData(mass_kg="abc"), "LoadData: mass_kg must be a finite number, got 'abc'"),
        (lambda: JointTarget.of("abcdef"), "robax_deg must be 6 finite numbers"),
        (lambda: RobTarget.of(np.eye(4), None), "robconf must be 4 whole numbers"),
        (
            lambda: rapid.calc_joint_t(irbkin.Robot("UR3"), RobTarget((1, 2, 3))),
            "this robot has no ABB configuration",
        ),
        (
            lambda: rapid.calc_joint_t(irbkin.Robot("IRB 140-6/0.81"), "p10"),
            "target must be a RobTarget, got str",
        ),
        (
            lambda: rapid.calc_joint_t(
                irbkin.Robot("IRB 140-6/0.81"), RobTarget((1, 2, 3)), WobjData()
            ),
            "tool must be a ToolData",
        ),
    ],
)
def test_invalid_rapid_data_are_refused(make, message):
    with pytest.raises(irbkin.IrbkinError, match=message):
        make()


def taught():
    """The targets that ABB's tools wrote, with their tools and work objects."""
    robots = {"IRB140": "IRB 140-6/0.81", "IRB120": "IRB 120-3/0.58", "IRB2400": "IRB 2400-10/1.55"}
    for row in read("abb_robtargets_with_confdata.csv"):
        pose = {
            name: Pose(
                tuple(map(float, row[f"{name}_pos"].split())),
                tuple(map(float, row[f"{name}_quat"].split())),
            )
            for name in ("tool", "uframe", "oframe")
        }
        trans, rot = (
            numbers(row, ("x_mm", "y_mm", "z_mm")),
            numbers(row, ("q1_w", "q2_x", "q3_y", "q4_z")),
        )
        target = RobTarget(trans, rot, numbers(row, ("cf1", "cf4", "cf6", "cfx")))
        wobj = WobjData(uframe=pose["uframe"], oframe=pose["oframe"])
        name = robots.get(row["robot"], row["robot"].replace("IRB", "IRB "))
        derived = numbers(row, [f"{axis}_derived" for axis in RAX])
        yield pytest.param(
            irbkin.Robot(name),
            target,
            ToolData(tframe=pose["tool"]),
            wobj,
            derived,
            id=f"{name} {row['name']}",
        )


@pytest.mark.parametrize(("robot", "target", "tool", "wobj", "derived"), list(taught()))
def test_taught_targets_have_the_joints_that_they_were_taught_with(
    robot, target, tool, wobj, derived
):
    joints = rapid.calc_joint_t(robot, target, tool, wobj)
    np.testing.assert_allclose(joints.robax_deg, derived, rtol=0, atol=5.1e-5)
    np.testing.assert_allclose(joints.q, np.deg2rad(joints.robax_deg))
    again = rapid.calc_rob_t(robot, joints, tool, wobj)
    np.testing.assert_allclose(again.trans_mm, target.trans_mm, rtol=0, atol=1e-3)
    assert again.extax == target.extax
    of_angles = rapid.calc_rob_t(robot, joints.q, tool, wobj)
    np.testing.assert_allclose(of_angles.trans_mm, again.trans_mm, rtol=0, atol=1e-9)
    assert of_angles.robconf == again.robconf


def test_what_a_controller_would_refuse_has_its_error_name():
    robot = irbkin.Robot("IRB 140-6/0.81")
    module = rapid.parse(PROGRAM)
    far = RobTarget((9000, 0, 0), (1, 0, 0, 0))
    with pytest.raises(
        irbkin.UnreachableError, match=r"^ERR_OUTSIDE_REACH: wrist center"
    ) as caught:
        rapid.calc_joint_t(robot, far)
    assert caught.value.rapid_error == "ERR_OUTSIDE_REACH"
    target = RobTarget(module["p10"].trans_mm, module["p10"].rot, (3, 0, 0, 0))
    with pytest.raises(
        irbkin.UnreachableError, match=r"^ERR_ROBLIMIT: no solution inside the limits"
    ) as caught:
        rapid.calc_joint_t(robot, target, module["tGun"], module["wFix"])
    assert caught.value.rapid_error == "ERR_ROBLIMIT"
    assert Configuration(0, 0, -1, 0) in caught.value.configurations
    joints = rapid.calc_joint_t(
        robot, target, module["tGun"], module["wFix"], fallback="nearest", seed=np.zeros(6)
    )
    assert rapid.calc_rob_t(robot, joints, module["tGun"], module["wFix"]).robconf == Configuration(
        0, 0, -1, 0
    )


def test_a_whole_module_is_a_table():
    robot, module = irbkin.Robot("IRB 140-6/0.81"), rapid.parse(PROGRAM)
    table = rapid.calc_moves(robot, module)
    assert table.kinds == ("MoveJ", "MoveL")
    assert table.names == ("P10", "RelTool(path{2},0,0,5)")
    np.testing.assert_array_equal(table.lines, [14, 15])
    assert table.findings == (None, None)
    for q, step in zip(table.q, module.moves, strict=True):
        joints = rapid.calc_joint_t(robot, step.target.value, step.tool.value, step.wobj.value)
        np.testing.assert_allclose(q, joints.q, rtol=0, atol=1e-14)
    assert [int(number[0]) for number in table.configuration] == [0, 0, -1, 0]
    singularity = robot.singularity(table.q)
    for name in ("wrist", "elbow", "shoulder"):
        np.testing.assert_array_equal(getattr(table, name), getattr(singularity, name))
    declared = rapid.calc_targets(robot, module, module["tGun"], module["wFix"])
    assert declared.names == ("p10", "path{1}", "path{2}")
    np.testing.assert_array_equal(declared.q[0], table.q[0])


def test_rapid_is_imported_when_it_is_asked_for():
    loaded = "print('irbkin.rapid' in sys.modules)"
    code = f"import irbkin, sys; {loaded}; irbkin.rapid.parse; {loaded}"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["False", "True"]


def test_records_are_values():
    target = RobTarget([1, 2, 3], robconf=(0, 1, -1, 2))
    assert repr(target) == (
        "RobTarget(trans_mm=(1.0, 2.0, 3.0), rot=(1.0, 0.0, 0.0, 0.0), "
        "robconf=Configuration(cf1=0, cf4=1, cf6=-1, cfx=2), "
        f"extax=({', '.join(['9000000000.0'] * 6)}))"
    )
    moved = target._replace(trans_mm=np.zeros(3))
    assert (moved.trans_mm, moved.robconf) == ((0, 0, 0), target.robconf)
    assert moved != target
    assert hash(moved._replace(trans_mm=(1, 2, 3))) == hash(target)
    with pytest.raises(AttributeError):
        target.rot = (0, 1, 0, 0)
    with pytest.raises(RapidError, match="RobTarget: rot must be 4 finite numbers, got None"):
        target._replace(rot=None)
    T = target.matrix()
    assert RobTarget.of(T, target.robconf) == target
    assert Pose.of(T).matrix() == pytest.approx(T)
    assert JointTarget.of([0, np.pi / 2, 0, 0, 0, 0]).robax_deg == (0, 90, 0, 0, 0, 0)
    assert (ToolData(), WobjData()) == (
        rapid.parse("[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]"),
        rapid.parse('[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]'),
    )


def test_each_field_has_its_words_and_each_record_is_pickled():
    module = rapid.parse(PROGRAM)
    table = rapid.calc_moves(irbkin.Robot("IRB 140-6/0.81"), module)
    records = [
        module["p10"], module["tGun"], module["wFix"], module["vSlow"], module.declarations[0],
        module.moves[0], module.moves[0].target, module.moves[0].settings, module.skipped[0], table,
        module["tGun"].tframe, module["tGun"].tload, rapid.ZoneData(), JointTarget((0,) * 6),
    ]  # fmt: skip
    for record in records:
        assert pickle.loads(pickle.dumps(record)) == record
        fields = inspect.getmembers(type(record), inspect.isdatadescriptor)
        documented = {name: field.__doc__ for name, field in fields if not name.startswith("_")}
        assert documented, record
        assert all(words.endswith(".") for words in documented.values()), documented
