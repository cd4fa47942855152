"""RAPID routines as motions: what a program says is made, and what is wrong with it is found."""

import pickle

import irbkin
import numpy as np
import pytest
from irbkin import rapid

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
TOOL = rapid.ToolData(tframe=rapid.Pose((0, 0, 180)))
HOME = (0, 0, 0, 0, 60, 0)
DOWN = (0, 0, 1, 0)
NONE = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def joints(degrees, end="v1000,fine,t;"):
    return f"MoveAbsJ [[{','.join(map(str, degrees))}],{NONE}],{end}"


def target(xyz_mm, wxyz=DOWN, conf=None):
    """A target that the robot reaches from its home with its own configuration."""
    T = irbkin.pose([mm / 1e3 for mm in xyz_mm], wxyz=wxyz)
    if conf is None:
        arm = ROBOT.with_tool(TOOL.tframe.matrix())
        conf = arm.configuration(arm.ik_nearest(T, np.radians(HOME)))
    return rapid.dump(rapid.RobTarget.of(T, conf))


def module(moves, before="", routine="main"):
    return rapid.parse(
        f"MODULE M\nPERS tooldata t:={rapid.dump(TOOL)}; {before}\nPROC {routine}()\n"
        f"{joints(HOME)}\n{moves}\nENDPROC\nENDMODULE"
    )


def moved(moves, before="", **options):
    return rapid.motion(ROBOT, module(moves, before), **options)


def names(motion):
    return [finding.name for finding in motion.findings]


def tool(q):
    return ROBOT.with_tool(TOOL.tframe.matrix()).fk(q)


A, B = (900, -300, 600), (900, 300, 600)


def test_moves_become_one_motion_with_the_move_and_the_line_of_each_sample():
    motion = moved(f"MoveJ {target(A)},v1000,z10,t;\nMoveL {target(B)},v200,fine,t;")
    assert motion.findings == ()
    m = len(motion)
    assert (motion.t.shape, motion.q.shape) == ((m,), (m, 6))
    assert motion.move_index.shape == motion.lines.shape == (m,)
    assert not motion.t.flags.writeable
    assert not motion.q.flags.writeable
    np.testing.assert_array_equal(motion.lines, np.array([4, 5, 6])[motion.move_index])
    assert [(step.kind, step.module_index, step.line) for step in motion.moves] == [
        ("MoveAbsJ", 0, 4),
        ("MoveJ", 1, 5),
        ("MoveL", 2, 6),
    ]
    assert motion.trajectory.duration == motion.duration == motion.t[-1] == motion.moves[-1].end
    np.testing.assert_allclose(motion.trajectory.q, motion.q, atol=1e-9)
    assert (motion.trajectory.peaks().velocity <= ROBOT.max_velocity * (1 + 1e-9)).all()
    np.testing.assert_allclose(tool(motion.q[-1])[:3, 3] * 1e3, B, atol=1e-9)
    assert repr(motion).startswith('RoutineMotion("main": 3 moves, ')
    again = pickle.loads(pickle.dumps(motion))
    assert again == motion
    assert pickle.loads(pickle.dumps(motion.moves)) == motion.moves
    assert again != moved(f"MoveJ {target(A)},v1000,z10,t;")
    assert again.moves == motion.moves


def test_a_line_has_its_speed_and_v_and_t_replace_it():
    length = 0.6
    start = f"MoveJ {target(A)},v1000,fine,t;\n"
    for speed, seconds in (
        ("v200", length / 0.2),
        ("v200\\V:=50", length / 0.05),
        ("v200\\T:=4.5", 4.5),
        ("[100,1,1,1]", length / 0.1),
    ):
        motion = moved(f"{start}MoveL {target(B)},{speed},fine,t;")
        assert motion.findings == ()
        assert motion.moves[2].end - motion.moves[2].start == pytest.approx(seconds, rel=1e-9)
        assert motion.moves[2].length == pytest.approx(length, rel=1e-12)


def test_a_joint_that_is_too_fast_is_found_and_slowed():
    motion = moved(f"MoveJ {target(A)},v1000,fine,t;\nMoveL {target(B)},v7000,fine,t;")
    assert names(motion) == ["joint-too-fast"]
    finding = motion.findings[0]
    assert (finding.move_index, finding.line, finding.joint) == (2, 6, 1)
    assert finding.bound == ROBOT.max_velocity[0]
    assert finding.value > finding.bound
    # At this speed, if 50 m/s^2 from the start and to the end allow it, the joint turns so fast.
    slow = moved(f"MoveJ {target(A)},v1000,fine,t;\nMoveL {target(B)},v100,fine,t;")
    rows = np.flatnonzero(slow.move_index == 2)
    rows = np.r_[rows[0] - 1, rows]
    way = 0.1 * (slow.t[rows] - slow.t[rows[0]])
    left = np.maximum(way[-1] - way, 0.0)
    least = [np.diff(way) / 7.0, np.diff(np.sqrt(way / 25.0)), -np.diff(np.sqrt(left / 25.0))]
    speeds = np.abs(np.diff(slow.q[rows, 0])) / np.max(least, axis=0)
    assert finding.value == pytest.approx(speeds.max(), rel=1e-6)
    assert "J1 must turn at" in finding.message
    assert "slowed down to" in finding.message
    assert motion.trajectory.peaks().velocity[0] <= ROBOT.max_velocity[0] * (1 + 1e-9)
    assert motion.moves[2].as_programmed


def test_a_line_that_flips_on_the_way_is_found():
    # Joint 6 comes to its limit: the targets are reached, the way between them is not.
    steps = []
    for turn in np.arange(0, 540, 60):
        half = np.radians(turn) / 2
        steps.append(f"MoveL {target(A, (0, -np.sin(half), np.cos(half), 0))},v1000,fine,t;")
    motion = moved("ConfL\\Off;\n" + "\n".join(steps))
    flips = [finding for finding in motion.findings if finding.name == "flip"]
    assert len(flips) == 1
    # The other branch of the wrist, where joint 6 is half a turn back.
    assert flips[0].joint == 4
    assert abs(flips[0].value) == pytest.approx(np.pi, abs=1e-6)
    assert "J4 must turn by 180.0 deg on the spot" in flips[0].message
    broken = motion.moves[flips[0].move_index]
    assert not broken.as_programmed
    assert broken.q is not None
    # The moves after it go on.
    assert [step.as_programmed for step in motion.moves].count(False) == 1
    table = rapid.calc_moves(
        ROBOT, module("ConfL\\Off;\n" + "\n".join(steps)), fallback="nearest", seed=np.radians(HOME)
    )
    assert not np.isnan(table.q).any()


def test_a_line_that_leaves_the_limits_is_found_and_the_next_one_goes_on():
    behind = target((-700, -200, 600), conf=(-2, 0, -2, 0))
    motion = moved(
        f"ConfL\\Off;\nMoveJ {target((700, 200, 600))},v1000,fine,t;\n"
        f"MoveL {behind},v1000,fine,t;\n"
        f"MoveL {target((-700, -300, 600), conf=(-2, 0, -2, 0))},v100,fine,t;"
    )
    assert names(motion) == ["path-blocked"]
    words = "at 43 % of the way, no solution inside the limits (8 outside); nearest: J2"
    assert words in motion.findings[0].message
    assert motion.findings[0].joint == 2
    assert motion.findings[0].value > motion.findings[0].bound == 0
    assert [step.as_programmed for step in motion.moves] == [True, True, False, True]
    assert motion.moves[3].end - motion.moves[3].start == pytest.approx(1.0, rel=1e-9)


def test_an_arc_that_leaves_the_reach_is_found():
    motion = moved(
        f"ConfL\\Off;\nMoveJ {target(A)},v1000,fine,t;\n"
        f"MoveC {target((2200, 0, 600), conf=(0, 0, 0, 0))},{target(B)},v1000,fine,t;"
    )
    assert names(motion) == ["path-blocked"]
    assert "% of the way, wrist center" in motion.findings[0].message
    assert motion.findings[0].value > 0
    assert [step.as_programmed for step in motion.moves] == [True, True, False]
    np.testing.assert_allclose(tool(motion.q[-1])[:3, 3] * 1e3, B, atol=1e-9)


def test_a_path_that_is_none_is_found():
    start = f"MoveJ {target(A)},v1000,fine,t;\nConfL\\Off;\n"
    turned = target(B, (0, 1, 0, 0), conf=(0, 0, 0, 0))
    half = moved(f"{start}MoveL {turned},v100,fine,t;")
    assert names(half) == ["no-path"]
    assert "the tool turns by 180.0 deg, there are two ways: program" in half.findings[0].message
    line = moved(f"{start}MoveC {target((900, 0, 600))},{target(B)},v100,fine,t;")
    assert names(line) == ["no-path"]
    assert "must not lie on a line" in line.findings[0].message


def test_a_target_out_of_reach_is_left_out_and_the_line_after_it_replaced():
    far = target((3000, 0, 600), conf=(0, 0, 0, 0))
    motion = moved(
        f"MoveJ {target(A)},v1000,fine,t;\nMoveL {far},v100,fine,t;\nMoveJ {far},v100,z10,t;\n"
        f"MoveL {target(B)},v100,fine,t;\nMoveL {target(A)},v200,fine,t;"
    )
    assert names(motion) == ["path-blocked", "out-of-reach", "out-of-reach"]
    assert "ERR_OUTSIDE_REACH" in motion.findings[1].message
    assert [step.as_programmed for step in motion.moves] == [True, True, False, False, False, True]
    assert motion.moves[2].q is None
    assert motion.moves[4].q is not None
    # What is replaced goes at the limits of the joints.
    assert motion.moves[4].end - motion.moves[4].start < 0.5
    assert motion.moves[5].end - motion.moves[5].start == pytest.approx(3.0, rel=1e-9)


def test_a_line_through_the_wrist_singularity_is_found_unless_sing_area_says_how():
    # Joint 5 from 20 to -20 deg, with joint 4 at 0.
    arm = ROBOT.with_tool(TOOL.tframe.matrix())
    ends = np.radians([[0, 0, 10, 0, 20, 0], [0, 0.3, 10, 0, -20, 0]])
    line = [rapid.dump(rapid.RobTarget.of(arm.fk(q), arm.configuration(q))) for q in ends]
    steps = (
        f"MoveAbsJ [[{','.join(map(str, np.degrees(ends[0])))}],{NONE}],v1000,fine,t;\n{{}}"
        f"MoveL {line[1]},v100,fine,t;"
    )
    plain = moved(steps.format(""))
    assert names(plain) == ["wrist-singularity"]
    assert plain.findings[0].value == 0.0
    assert "crosses the wrist singularity" in plain.findings[0].message
    for mode in ("Wrist", "LockAxis4"):
        motion = moved(steps.format(f"SingArea\\{mode};\n"))
        assert names(motion) == []
        assert motion.moves[2].as_programmed


def test_lock_axis_4_needs_axis_4_in_the_plane_of_the_arm():
    steps = f"{joints((0, 0, 10, 40, 50, 0))}\nSingArea\\LockAxis4;\nConfL\\Off;\n"
    motion = moved(f"{steps}MoveL {target(B)},v100,fine,t;")
    assert names(motion) == ["path-blocked"]
    assert "wrist locked" in motion.findings[0].message


def test_conf_l_and_conf_j_say_whether_the_configuration_counts():
    wrong = target(B, conf=(0, 0, 3, 0))
    start = f"MoveJ {target(A)},v1000,fine,t;\n"
    for setting, found in (("", ["other-configuration"]), ("ConfL\\Off;\n", [])):
        motion = moved(f"{start}{setting}MoveL {wrong},v100,fine,t;")
        assert names(motion) == found
        assert motion.moves[2].as_programmed
    nowhere = target(B, conf=(3, 0, 3, 0))
    for setting, found in (("", ["wrong-confdata"]), ("ConfJ\\Off;\n", [])):
        motion = moved(f"{start}{setting}MoveJ {nowhere},v100,fine,t;")
        assert names(motion) == found
        np.testing.assert_allclose(tool(motion.q[-1])[:3, 3] * 1e3, B, atol=1e-9)


def test_the_robot_rests_before_a_move_that_is_replaced():
    behind = target((-700, -200, 600), conf=(-2, 0, -2, 0))
    motion = moved(
        f"ConfL\\Off;\nMoveJ {target((900, 200, 600))},v1000,fine,t;\n"
        f"MoveL {target((700, 200, 600))},v100,z20,t;\nMoveL {behind},v1000,fine,t;",
        max_acceleration=5.0,
    )
    assert names(motion) == ["path-blocked"]
    assert [step.as_programmed for step in motion.moves] == [True, True, True, False]
    corner = np.flatnonzero(motion.move_index == 2)[-1]
    np.testing.assert_allclose(motion.trajectory.dq[corner], 0, atol=1e-9)
    assert (motion.trajectory.peaks().acceleration <= 5 * (1 + 1e-9)).all()


def test_what_is_not_known_is_found():
    motion = moved(
        f"MoveJ *,v1000,z10,t;\nMoveL {target(A)},vJob,zJob,t;\n"
        f"MoveL {target(B)},v100,fine,tOther;\n"
        f"MoveL {target(B)},v0,fine,t;",
        "CONST speeddata v0:=[0,500,5000,1000];",
    )
    assert [(finding.name, finding.move_index) for finding in motion.findings] == [
        ("unknown-value", 1),
        ("unknown-speed", 2),
        ("unknown-zone", 2),
        ("unknown-tool", 3),
        ("invalid-number", 4),
    ]
    assert "speed vJob: refers to vJob" in motion.findings[1].message
    assert "zone zJob: refers to zJob" in motion.findings[2].message
    assert str(motion.findings[4]).startswith("line 8: MoveL [[900,300,600],")
    assert motion.findings[4].message.endswith(
        "...: v_tcp is 0, it must be finite and positive; it is left out"
    )


def test_instructions_and_calls_that_may_move_are_found():
    text = (
        f"MODULE M\nPERS tooldata t:={rapid.dump(TOOL)};\nPROC main()\n{joints(HOME)}\n"
        f"ArcRepL *,v1,a,fine,t;\nMoveL {target(A)},v100,fine,t;\npick;\n"
        f"MoveL {target(B)},v100,fine,t;\nSetDO a,1;\ncount;\nMoveL {target(A)},v100,fine,t;\n"
        f"ConfL\\Perhaps;\nMoveL {target(B)},v100,fine,t;\nERROR\nMoveL *,v1,fine,t;\nENDPROC\n"
        f"PROC pick()\n{joints(HOME)}\nENDPROC\nPROC count()\nn:=n+1;\nENDPROC\nENDMODULE"
    )
    motion = rapid.motion(ROBOT, rapid.parse(text))
    assert [(finding.code, finding.line) for finding in motion.findings] == [
        ("U802", 5),
        ("U802", 12),
    ]
    made = [True, False, True, True, True, False]
    assert [step.as_programmed for step in motion.moves] == made


@pytest.mark.parametrize(
    ("lines", "word"),
    [
        ("IF a=1 THEN\n{}\nENDIF", "IF"),
        ("IF a=1 {}", "IF"),
        ("FOR i FROM 1 TO n DO\n{}\nENDFOR", "FOR"),
        ("WHILE TRUE DO\nSetDO a,1;\n{}\nENDWHILE", "WHILE"),
        ("TEST a\nCASE 1:\n{}\nENDTEST", "TEST"),
        ("IF a=1 THEN\nConfL\\Off;\nENDIF\n{}", "IF"),
        ("IF a=1 RETURN;\n{}", "IF"),
        ("again:\n{}\nGOTO again;", "GOTO"),
    ],
)
def test_a_branch_around_a_move_is_refused_with_its_line(lines, word):
    with pytest.raises(irbkin.RapidError, match=f"{word} decides which moves are made") as caught:
        moved(lines.format(f"MoveL {target(A)},v100,fine,t;"))
    assert caught.value.line == (7 if word == "GOTO" else 5)


def test_a_branch_without_moves_and_moves_after_return_do_not_matter():
    motion = moved(
        f"IF a=1 THEN\nSetDO a,1;\nELSE\nSetDO a,0;\nENDIF\nMoveL {target(A)},v100,fine,t;\n"
        f"RETURN;\nMoveL *,v100,fine,t;"
    )
    assert len(motion.moves) == 2
    assert motion.findings == ()


def test_calls_and_loops_with_known_bounds_are_followed():
    there = f"MoveL {target(A)},v100,fine,t;"
    loop = moved(f"FOR i FROM 1 TO 3 DO\nMoveL Offs({target(A)},0,0,-10*i),v100,fine,t;\nENDFOR")
    assert [step.line for step in loop.moves] == [4, 6, 6, 6]
    assert loop.findings == ()
    called = moved(f"go {target(A)};\nENDPROC\nPROC go(robtarget p)\nMoveL p,v100,fine,t;")
    alone = moved(there)
    np.testing.assert_array_equal(called.q, alone.q)
    assert called.findings == alone.findings == ()


def test_the_routine_is_named_main_or_the_only_one():
    assert rapid.motion(ROBOT, module("", routine="MAIN")).routine == "MAIN"
    assert rapid.motion(ROBOT, module("", routine="other")).routine == "other"
    assert rapid.motion(ROBOT, module("", routine="other"), "OTHER").routine == "other"
    two = rapid.parse(
        f"MODULE M\nPROC a()\n{joints(HOME)}\nENDPROC\nPROC b()\n{joints(HOME)}\nENDPROC\n"
        "PROC c()\nENDPROC\nENDMODULE"
    )
    with pytest.raises(irbkin.RapidError, match="give routine, one that moves: a, b"):
        rapid.motion(ROBOT, two)
    with pytest.raises(irbkin.RapidError, match='no routine "d"; it has: a, b, c'):
        rapid.motion(ROBOT, two, "d")
    with pytest.raises(irbkin.RapidError, match="c has no move that is read"):
        rapid.motion(ROBOT, two, "c")
    with pytest.raises(irbkin.RapidError, match="the module has no move that is read"):
        rapid.motion(ROBOT, rapid.parse("MODULE M\nENDMODULE"))
    bare = rapid.motion(ROBOT, rapid.parse(joints(HOME, "v1000,fine,tool0;")))
    assert (bare.routine, len(bare), bare.duration) == (None, 1, 0.0)


def test_a_start_is_where_the_first_move_begins():
    lines = module(f"MoveL {target(A)},v100,fine,t;")
    start = np.array([0.1, 0.2, 0.3, 0.4, 1.0, 0.7])  # is no double of degrees
    motion = rapid.motion(ROBOT, lines, start=start)
    np.testing.assert_array_equal(motion.q[0], start)
    assert motion.moves[0].end > 0
    assert rapid.motion(ROBOT, lines, start=rapid.JointTarget.of(start)).q[0] == pytest.approx(
        start
    )
    assert pickle.loads(pickle.dumps(motion)) == motion
    with pytest.raises(irbkin.IrbkinError, match="no move can be made: line 1: MoveL"):
        rapid.motion(ROBOT, rapid.parse("MoveL *,v100,fine,tool0;"))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"max_velocity": 0.0}, r"max_velocity\[0\] is 0.0, it must be positive"),
        ({"max_velocity": [1, 1, 1, np.inf, 1, 1]}, r"max_velocity\[3\] is inf"),
        ({"max_velocity": [1, 1]}, r"max_velocity must be a number or have shape \(6,\)"),
        ({"max_acceleration": -1}, r"max_acceleration\[0\] is -1.0"),
        ({"max_acceleration": np.nan}, r"max_acceleration"),
        ({"step": 0.0}, "step is 0.0, it must be positive and finite"),
        ({"step": np.inf}, "step is inf, it must be positive and finite"),
        ({"turn": -0.1}, "turn is -0.1"),
        ({"step": 1e-12}, "at most 1e7 are given"),
        ({"start": [np.nan] * 6}, "start: joint 1 is NaN"),
        ({"start": [0, 0]}, r"start must have shape \(6,\), got \(2,\)"),
    ],
)
def test_bad_options_are_refused(options, words):
    with pytest.raises(irbkin.IrbkinError, match=words):
        moved(f"MoveL {target(A)},v100,fine,t;", **options)


def test_a_robot_without_velocities_needs_them():
    robot = irbkin.Robot.from_mdh(ROBOT.mdh, ROBOT.limits)
    lines = rapid.parse(joints(HOME, "v1000,fine,tool0;"))
    with pytest.raises(irbkin.InvalidMotionError, match="the robot has no joint velocities"):
        rapid.motion(robot, lines)
    assert rapid.motion(robot, lines, max_velocity=2.0).duration == 0
    with pytest.raises(irbkin.InvalidModelError):
        rapid.motion(irbkin.Robot("UR5e"), lines)


def test_a_motion_is_written_back_as_a_module_of_joint_targets():
    motion = moved(
        f"MoveJ {target(A)},v1000,z10,t;\nMoveL {target(B)},vOwn\\T:=5,z50\\Z:=7,t\\WObj:=w;",
        "CONST speeddata vOwn:=[150,500,5000,1000]; "
        'PERS wobjdata w:=[FALSE,TRUE,"",[[0,0,10],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];',
    )
    again = motion.to_module("Joints")
    assert (again.name, list(again)) == ("Joints", ["t", "w"])
    assert [step.kind for step in again.moves] == ["MoveAbsJ"] * 3
    assert [step.speed for step in again.moves] == ["v1000", "v1000", "[150,500,5000,1000]"]
    assert again.moves[2].time.value == 5.0
    assert again.moves[2].zone_data.value.pzone_tcp_mm == 7
    replayed = rapid.motion(ROBOT, again)
    for step, own in zip(replayed.moves, motion.moves, strict=True):
        np.testing.assert_allclose(step.q, own.q, atol=1e-14)
    assert rapid.parse(rapid.dump(again)) == again
    assert pickle.loads(pickle.dumps(again)) == again
    with pytest.raises(irbkin.RapidError, match="not a RAPID identifier"):
        motion.to_module("1")


def test_the_example_is_one_motion():
    module = rapid.load("examples/pick_and_place.mod")
    motion = rapid.motion(ROBOT, module)
    assert names(motion) == ["near-confdata", "near-confdata", "out-of-reach"]
    assert [step.as_programmed for step in motion.moves] == [True] * 10 + [False]
