"""The verbs of the command `irbkin`: what they read, what they write, what they refuse."""

import json
import re
import shlex
import subprocess
import sys

import irbkin
import numpy as np
import pytest
from command import JOINTS, NAME, ROBOT, XYZ, joints_of, refused, rows, run
from irbkin.cli import VERBS, parser_of

EVERY_VERB = list(VERBS)
NAMES = "x_mm,y_mm,z_mm,rz_deg,ry_deg,rx_deg\n"


@pytest.fixture
def joints_csv(tmp_path):
    file = tmp_path / "joints.csv"
    np.savetxt(file, JOINTS, delimiter=",")
    return file


@pytest.mark.parametrize("verb", EVERY_VERB)
def test_help_has_examples_that_can_be_parsed(verb):
    done = run(verb, "--help")
    assert done.returncode == 0
    text = done.stdout.decode()
    examples = re.findall(r"^  irbkin (.*)$", text.partition("\nexamples:\n")[2], re.MULTILINE)
    assert len(examples) >= 2
    for example in examples:
        own, *words = shlex.split(re.split(r" [<>|]", example)[0])
        assert own == verb
        parser_of(verb).parsed(words)


def test_the_overview_lists_every_verb_and_needs_no_numpy():
    code = (
        "import sys; from irbkin.cli import main; code = main(['--help']); "
        "print('numpy' in sys.modules, code)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    text = done.stdout.decode()
    assert text.endswith("False 0\n")
    for verb in VERBS:
        assert re.search(rf"\n +{verb}\s", text)
    assert run().stdout.decode() == text.removesuffix("False 0\n")
    assert run("--version").stdout.decode() == f"irbkin {irbkin.__version__}\n"


def test_fk_gives_the_poses_of_the_library(joints_csv, tmp_path):
    table = rows(run("fk", NAME, joints_csv, "--csv"))
    wanted = ROBOT.fk(np.radians(JOINTS))
    xyz, wxyz = irbkin.to_xyz_wxyz(wanted)
    np.testing.assert_allclose(
        np.column_stack([table[f"{axis}_mm"] for axis in "xyz"]), xyz * 1e3, atol=1e-8
    )
    np.testing.assert_allclose(
        np.column_stack([table[it] for it in ("qw", "qx", "qy", "qz")]), wxyz, atol=1e-10
    )
    configuration = ROBOT.configuration(np.radians(JOINTS))
    for name in ("cf1", "cf4", "cf6", "cfx"):
        assert table[name].tolist() == getattr(configuration, name).tolist()
    np.testing.assert_allclose(
        table["wrist_deg"], np.degrees(ROBOT.singularity(np.radians(JOINTS)).wrist), atol=1e-9
    )
    file = tmp_path / "poses.npy"
    assert run("fk", NAME, joints_csv, "-o", file).returncode == 0
    np.testing.assert_allclose(np.load(file), wanted, atol=1e-12)


def test_one_joint_vector_is_given_as_arguments():
    table = rows(run("fk", NAME, 0, 0, "-1e-3", -10, 30, 0, "--csv", "--tool", 0, 0, 180))
    tool = irbkin.pose([0, 0, 0.18])
    wanted = ROBOT.with_tool(tool).fk(np.radians([0, 0, -1e-3, -10, 30, 0]))
    found = [float(table[f"{axis}_mm"][0]) for axis in "xyz"]
    np.testing.assert_allclose(found, wanted[:3, 3] * 1e3, atol=1e-8)
    assert "6 angles" in refused("fk", NAME, 1, 2, 3)
    assert "'x'" in refused("fk", NAME, 1, 2, 3, 4, 5, "x")


def test_ik_shows_every_solution():
    table = rows(run("ik", NAME, *XYZ, "--csv"))
    solutions = ROBOT.ik(irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0]))
    assert table["slot"].tolist() == [it.slot for it in solutions]
    np.testing.assert_allclose(joints_of(table), np.degrees(solutions.q), atol=1e-9)
    within = [it.is_within_limits for it in solutions]
    assert (table["limits"] == "inside").tolist() == within
    assert (table["margin_deg"] >= 0).tolist() == within
    inside = rows(run("ik", NAME, *XYZ, "--within", "--csv"))
    assert len(inside["slot"]) == sum(within)


def test_ik_takes_what_fk_gives(joints_csv, tmp_path):
    poses = tmp_path / "poses.csv"
    poses.write_bytes(run("fk", NAME, joints_csv, "--csv").stdout)
    found = rows(run("ik", NAME, poses, "--csv"))
    nearest = {}
    for pose, q in zip(found["pose"], joints_of(found), strict=True):
        # To a turn.
        off = np.abs((q - JOINTS[int(pose)] + 180.0) % 360.0 - 180.0).max()
        nearest[pose] = min(off, nearest.get(pose, np.inf))
    assert len(nearest) == len(JOINTS)
    assert max(nearest.values()) < 1e-6
    seed = ["--seed", *map(str, JOINTS[0])]
    q = tmp_path / "q.npy"
    assert run("ik", NAME, poses, *seed, "-o", q).returncode == 0
    wanted = ROBOT.ik_nearest(ROBOT.fk(np.radians(JOINTS)), np.radians(JOINTS[0]))
    np.testing.assert_allclose(np.load(q), wanted, atol=1e-8)


def test_ik_by_confdata_gives_the_joints_back(joints_csv, tmp_path):
    q = np.radians(JOINTS[3])
    confdata = list(ROBOT.configuration(q))
    poses = tmp_path / "pose.npy"
    np.save(poses, ROBOT.fk(q))
    table = rows(run("ik", NAME, poses, "--confdata", *confdata, "--csv"))
    np.testing.assert_allclose(joints_of(table)[0], JOINTS[3], atol=1e-8)


def test_arrays_of_all_solutions_have_gaps(joints_csv, tmp_path):
    poses, q = tmp_path / "poses.npy", tmp_path / "q.npy"
    wanted = ROBOT.fk(np.radians(JOINTS))
    wanted[7, 0, 3] += 9.0
    np.save(poses, wanted)
    done = run("ik", NAME, "-", "-o", q, stdin=poses.read_bytes())
    assert done.returncode == 1
    assert b"1 of 40 poses have no solution inside the limits; the first is pose 7" in done.stderr
    np.testing.assert_array_equal(np.load(q), ROBOT.ik_batch(wanted).q)


def test_ik_says_where_there_may_be_more_solutions(tmp_path):
    arm, poses = irbkin.Robot("CRX-10iA"), tmp_path / "poses.npy"
    # Stretched to a self-motion, and not.
    pose = arm.fk(np.radians([[-22, -180, 90, 90, 5, -180], [10, 20, 30, 40, 50, 60]]))
    np.save(poses, pose)
    words = "of 1 of 2 poses there may be more solutions: their number is not certified"
    assert run("ik", "CRX-10iA", poses).stdout.decode().splitlines()[-1] == words
    assert json.loads(run("ik", "CRX-10iA", poses, "--json").stdout)["uncertified"] == 1
    answers = [arm.ik(one) for one in pose]
    assert [answer.certified for answer in answers] == [False, True]
    reservation = "; there may be more (not certified)"
    assert [answer.explain().endswith(reservation) for answer in answers] == [True, False]
    assert str(answers[0]).splitlines()[0] == answers[0].explain()
    np.save(poses, pose[1:])
    assert "certified" not in run("ik", "CRX-10iA", poses).stdout.decode()


def test_seven_axes_take_q7():
    table = rows(
        run("ik", "Panda", "--xyz", 400, 0, 500, "--wxyz", 0, 1, 0, 0, "--q7", 45, "--csv")
    )
    np.testing.assert_allclose(table["q7_deg"], 45.0)
    assert "give --q7" in refused("ik", "Panda", "--xyz", 400, 0, 500)
    assert "has 6" in refused("ik", NAME, "--xyz", 400, 0, 500, "--q7", 45)


def test_a_confdata_has_an_arm_angle_for_a_yumi_and_for_no_other():
    asked = ["--xyz", 300, 100, 300, "--confdata", 0, 0, 0, 0]
    assert "give --arm-angle with --confdata" in refused("ik", "IRB 14050", *asked)
    assert "has 6" in refused("ik", "GoFa 5", *asked, "--arm-angle", 5)
    assert "no ABB configuration" in refused("ik", "Panda", *asked)


@pytest.mark.parametrize(
    ("name", "x", "choice", "call"),
    [
        ("IRB 14050", 5000, ["--q7", 11.5], lambda robot, T: _given(robot, T, {7: 11.5})),
        ("IRB 14050", 300, ["--q7", 11.5], lambda robot, T: _given(robot, T, {7: 11.5})),
        ("Panda", 5000, ["--seed", *[0] * 7], lambda robot, T: robot.ik_nearest(T, np.zeros(7))),
        (
            "GoFa 5",
            300,
            ["--confdata", 3, 3, 3, 0],
            lambda robot, T: robot.ik_configured(T, [3, 3, 3, 0]),
        ),
        (
            "GoFa 5",
            5000,
            ["--confdata", 3, 3, 3, 0],
            lambda robot, T: robot.ik_configured(T, [3, 3, 3, 0]),
        ),
    ],
)
def test_what_has_no_solution_has_the_reason_of_the_library(name, x, choice, call):
    done = run("ik", name, "--xyz", x, 0, 900, *choice)
    with pytest.raises(irbkin.UnreachableError) as unreachable:
        call(irbkin.Robot(name), irbkin.pose([x / 1e3, 0, 0.9]))
    nothing, words = "no solution inside the limits", str(unreachable.value)
    assert done.returncode == 1
    wanted = words if words.startswith(nothing) else f"{nothing}: {words}"
    assert done.stderr.decode() == f"irbkin: {wanted}\n"


def _given(robot, T, given):
    """Why no solution with a joint [deg] given is inside the limits."""
    ((joint, angle),) = given.items()
    solutions = robot.locked({joint: np.radians(angle)}).ik(T)
    assert not len(solutions.within_limits())
    raise irbkin.UnreachableError(solutions.explain())


def test_json_has_the_rows_and_nulls():
    done = run("ik", NAME, *XYZ, "--json")
    content = json.loads(done.stdout)
    assert content["heading"].startswith(f"{NAME}: tool at 850 320 640 mm")
    assert [row["slot"] for row in content["rows"]] == list(range(8))
    nothing = run("ik", NAME, "--xyz", 8500, 320, 640, "--seed", *[0] * 6, "--json")
    assert nothing.returncode == 1
    assert json.loads(nothing.stdout)["rows"][0]["q1_deg"] is None


@pytest.mark.parametrize(
    "content",
    [
        "900,0,600,0,160,0\n800,0,600,0,160,0\n",
        "\ufeffx_mm,y_mm,z_mm,rz_deg,ry_deg,rx_deg\r\n900,0,600,0,160,0\r\n800,0,600,0,160,0",
        "# made by hand\n\n900, 0, 600, 0, 160, 0\n\n800, 0, 600, 0, 160, 0\n",
        "ry_deg,rz_deg,rx_deg,name,z_m,y_m,x_m\n160,0,0,a,.6,0,.9\n160,0,0,b,.6,0,.8\n",
        'note,"x_m",y_m,z_m,rz_rad,ry_deg,rx_rad\n"a,b",.9,0,.6,0,160,0\n"c,d",".8",0,.6,0,160,0\n',
        "x_m,y_m,z_m,rz_rad,ry_rad,rx_rad\n.9,0,.6,0,2.792526803190927,0\n.8,0,.6,0,2.792526803190927,0",
        "x_mm,y_mm,z_mm,qw,qx,qy,qz\n900,0,600,0.17364818,0,0.98480775,0\n800,0,600,0.17364818,0,0.98480775,0\n",
    ],
)
def test_rows_are_csv_with_names_or_without(content):
    done = run("ik", NAME, "-", "--seed", *[0] * 6, "--csv", stdin=content)
    poses = irbkin.pose([[0.9, 0, 0.6], [0.8, 0, 0.6]], euler_zyx=np.radians([0, 160, 0]))
    wanted = np.degrees(ROBOT.ik_nearest(poses, np.zeros(6)))
    np.testing.assert_allclose(joints_of(rows(done)), wanted, atol=1e-5)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("900,0,600,0,160,0\n900,O,600,0,160,0\n", "stdin:2:5: 'O' is not a finite number"),
        ("900,0,600,0,160,0\n\n900,0,600,0,160\n", "stdin:3: '900,0,600,0,160' has 5 columns, "),
        (
            f"{NAMES}900,0,600,,160,0\n",
            "stdin:2:11: '' is not a finite number",
        ),
        (
            "x,y,z,rz,ry,rx\n900,0,600,0,160,0\n",
            "stdin:1: 'x,y,z,rz,ry,rx' has no column x_mm or x_m; a pose has x_mm, y_mm, z_mm, qw",
        ),
        (
            "x_mm,y_mm,z_mm,rz_deg,ry_deg\n900,0,600,0,160\n",
            "stdin:1: 'x_mm,y_mm,z_mm,rz_deg,ry_deg' has no column rx_deg or rx_rad; a pose has",
        ),
        ("900,0\n", "stdin:1: '900,0' has 2 columns; a pose has x_mm, y_mm, z_mm, qw"),
        (
            "900;0;600;0;160;0\n",
            "stdin:1: '900;0;600;0;160;0' has 1 column; a pose has x_mm, y_mm, z_mm, qw, qx, qy, "
            "qz or x_mm, y_mm, z_mm, rz_deg, ry_deg, rx_deg, separated by commas, with decimal "
            "points",
        ),
        ("900 0 600 0 160 0\n", "stdin:1: '900 0 600 0 160 0' has 1 column"),
        ("900\t0\t600\t0\t160\t0\n", "separated by commas"),
        (
            "900,5;0,5;600;0;160;0\n",
            "stdin:1: '900,5;0,5;600;0;160;0' has 3 columns; a pose has",
        ),
        ("900,0,600,0,160,0\n800;0;600;0;160;0\n", "stdin:2: '800;0;600;0;160;0' has 1 column, "),
        ("", "stdin: has no rows"),
        (NAMES, "stdin: has no rows"),
        ("900,0,600,2,0,0,0\n", "stdin: row 1: the quaternion qw, qx, qy, qz has norm 2"),
        ("900,0,1_0,0,160,0\n", "'1_0' is not a finite number"),
        ("9" * 200_000, "has 1 column; a pose has"),
        (b"900,0,600,0,160,0\n900,\xff,600,0,160,0\n", "stdin:2:5: '?' is not a finite number"),
        (b"\xff\xfe9\x00", "UTF-16"),
        (b"PK\x03\x04", "archive"),
        (b"\x93NUMPY\x09", "is not a .npy file that can be read"),
    ],
)
def test_broken_rows_have_their_line_and_column(content, message):
    assert message in refused("ik", NAME, "-", stdin=content)


def test_broken_arrays_are_refused(tmp_path):
    file = tmp_path / "a.npy"
    for array, words in (
        (
            np.zeros((3, 6)),
            "float64 of shape (3, 6), wanted an array of numbers of shape (m, 4",
        ),
        (np.asfortranarray(np.zeros((3, 4, 4))), "in Fortran's order"),
        (np.zeros((3, 4, 4), dtype="U3"), "<U3"),
        (np.zeros((0, 4, 4)), "has no rows"),
    ):
        np.save(file, array)
        assert words in refused("ik", NAME, file)
    np.save(file, np.zeros((3, 4, 4)))
    file.write_bytes(file.read_bytes()[:-200])
    assert "ends after row 1 of 3" in refused("ik", NAME, file)


def test_unknown_names_have_the_close_ones():
    assert "did you mean ik?" in refused("ikk")
    assert '"IRB 2600-12/1.65"' in refused("ik", "IRB 2600-12", *XYZ)
    assert "unrecognized arguments: --xzy" in refused("fk", NAME, "--xzy", 1)
    assert "No such file" in refused("fk", NAME, "nowhere.csv")
    assert refused("ik", NAME) == (
        "irbkin: give a pose by --xyz, as a robtarget, or a FILE of poses (irbkin ik --help)\n"
    )
    assert "3 numbers" in refused("ik", NAME, *XYZ, "--tool", 1, 2)


@pytest.mark.parametrize("number", ["0", "-5", "nan", "inf", "1e400", "-1e308", "1e12"])
def test_numbers_that_cannot_be_are_refused_or_answered_in_a_line(number):
    # `run` asserts that no error is one of our own.
    for words in (
        ["catalog", "--reach", number],
        ["catalog", "--payload", number],
        ["fk", NAME, number, 0, 0, 0, 0, 0],
        ["fk", NAME, 0, 0, 0, 0, 30, 0, "--tool", number, 0, 0],
        ["fk", NAME, 0, 0, 0, 0, 30, 0, "--base", 0, 0, 0, number, 0, 0, 0],
        ["ik", NAME, "--xyz", number, 0, 0],
        ["ik", NAME, "--xyz", 900, 0, 900, "--wxyz", number, 0, 0, 0],
        ["ik", NAME, "--xyz", 900, 0, 900, "--seed", number, 0, 0, 0, 0, 0],
        ["ik", NAME, "--xyz", 900, 0, 900, "--confdata", number, 0, 0, 0],
        ["ik", "Panda", "--xyz", 400, 0, 400, "--q7", number],
    ):
        done = run(*words)
        assert done.returncode in (0, 1, 2)
        assert done.returncode == 0 or done.stderr.startswith(b"irbkin: ")
        assert done.returncode != 2 or done.stderr.count(b"\n") == 1, done.stderr


def test_a_pose_out_of_reach_is_one_line_and_exit_code_1():
    done = run("ik", NAME, "--xyz", 8500, 0, 0)
    assert done.returncode == 1
    reason = ROBOT.check_pose(irbkin.pose([8.5, 0, 0])).reason
    assert done.stderr.decode() == f"irbkin: no solution inside the limits: {reason}\n"


def test_the_catalog_is_listed_and_filtered():
    assert tuple(rows(run("catalog", "--csv"))["name"]) == irbkin.catalog()
    big = rows(run("catalog", "--reach", 2500, "--payload", 100, "--csv"))
    assert tuple(big["name"]) == irbkin.catalog(reach=2.5, payload=100)
    one = rows(run("catalog", NAME, "--csv"))
    np.testing.assert_allclose(np.radians(one["lower_deg"]), ROBOT.limits[:, 0])
    assert run("catalog", "irb2600-12/1.65").stdout == run("catalog", NAME).stdout
    assert "close" in refused("catalog", "IRB 99999")
    assert run("catalog", "irb2600-12/1.65", "--payload", 5).returncode == 0
    conditional = (
        b"\n- conditional, not modeled: axis 2 goes to 136 deg while axis 1 is within +-100 deg"
    )
    assert conditional in run("catalog", "IRB 1600-8/1.2").stdout


def test_a_filter_that_leaves_no_arm_says_so():
    done = run("catalog", "--payload", "1e9")
    assert (done.returncode, done.stdout) == (1, b"")
    words = "irbkin: no arm of the catalog has a payload of 1e+09 kg or more\n"
    assert done.stderr.decode() == words
    done = run("catalog", 2600, "--payload", 500, "--reach", 1000)
    assert done.returncode == 1
    assert done.stderr.decode() == (
        "irbkin: no arm of the catalog with '2600' in its name has a reach of 1000 mm or more and "
        "a payload of 500 kg or more\n"
    )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["fk", NAME, "nan", 0, 0, 0, 0, 0], "joint angles: 'nan' is not a finite number"),
        (["fk", NAME, 0, "1e9", 0, 0, 0, 0], "joint 2 at 1e+09 deg is too large"),
        (["fk", NAME, *[0] * 6, "--tool", 0, 0, "inf"], "--tool: 'inf' is not a finite number"),
        (
            ["fk", NAME, *[0] * 6, "--tool", 0, 0, 100000],
            "100000 mm from the flange, more than ten times",
        ),
        (["fk", NAME, *[0] * 6, "--tool", 0, 0, 1, 0, -400, 0], "--tool: ry is -400 deg"),
        (["ik", NAME, "--xyz", 850, 0, 0, "--euler", 400, 0, 0], "--euler: rz is 400 deg"),
        (
            ["ik", NAME, "--xyz", 850, 0, 0, "--confdata", 0, 0, 0, 0.5],
            "'0.5' is not a whole number",
        ),
        (["ik", "Panda", "--xyz", 4, 0, 0, "--q7", "1e9"], "--q7: 1e+09 deg is too large"),
        (["catalog", "--reach", "1e9"], "--reach is 1e+09 mm, it must be 0 to 100000 mm"),
        (["urdf", "Wxyz"], "irbkin catalog lists all; another arm is given by a .urdf file"),
    ],
)
def test_wrong_numbers_are_named_in_the_units_of_the_command(words, message):
    assert message in refused(*words)


def test_angles_too_large_for_a_confdata_have_none():
    table = rows(run("fk", NAME, "-", "--csv", stdin="0,0,0,0,30,0\n1e9,0,0,0,30,0\n"))
    for name in ("cf1", "cf4", "cf6", "cfx"):
        np.testing.assert_array_equal(table[name], [0, np.nan])
    assert "row 2: ry is 400 deg" in refused("ik", NAME, "-", stdin="9,0,0,0,0,0\n9,0,0,0,400,0\n")


def test_a_pose_far_beyond_reach_is_explained_in_millimeters():
    done = run("ik", NAME, "--xyz", 850000, 0, 0)
    assert b"(arguments and CSV are in millimeters, .npy files in meters)" in done.stderr


PROGRAM = """MODULE Weld
    PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    CONST robtarget a:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget b:=[[900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveJ a,v1000,z20,tGun;
        MoveL b,v200,fine,tGun;
    ENDPROC
ENDMODULE
"""


def test_rapid_gives_moves_samples_and_a_module(tmp_path):
    file, q, joints = (tmp_path / name for name in ("weld.mod", "q.npy", "joints.mod"))
    file.write_text(PROGRAM)
    motion = irbkin.rapid.motion(ROBOT, irbkin.rapid.parse(PROGRAM))
    table = rows(run("rapid", NAME, file, "--csv"))
    assert table["move"].tolist() == ["MoveJ", "MoveL"]
    np.testing.assert_allclose(table["end_s"], [it.end for it in motion.moves])
    assert run("rapid", NAME, file, "-o", q).returncode == 0
    np.testing.assert_array_equal(np.load(q), np.column_stack([motion.t, motion.q]))
    assert run("rapid", NAME, file, "-o", joints).returncode == 0
    assert irbkin.rapid.load(joints) == motion.to_module()
    slow = rows(run("rapid", NAME, file, "--acceleration", 500, "--csv"))
    assert slow["end_s"][-1] > table["end_s"][-1]
    assert "no routine" in refused("rapid", NAME, file, "--routine", "mian").lower()
    file.write_text(PROGRAM.replace("MoveL b", "MoveL nowhere"))
    done = run("rapid", NAME, file)
    assert done.returncode == 1
    assert done.stderr.startswith(f"irbkin: {file}:7:9: MoveL nowhere: ".encode())
    file.write_text("MODULE M PROC main( ENDMODULE")
    assert f"{file}: line 1, column " in refused("rapid", NAME, file)


def test_rapid_takes_the_speeds_of_the_joints(tmp_path):
    file = tmp_path / "weld.mod"
    file.write_text(PROGRAM)
    longer, speeds = "IRB 2600-12/1.85", np.degrees(ROBOT.max_velocity)
    assert "1.85 are unknown: give --max-velocity" in refused("rapid", longer, file)
    table = rows(run("rapid", longer, file, "--max-velocity", *speeds, "--csv"))
    motion = irbkin.rapid.motion(
        irbkin.Robot(longer), irbkin.rapid.parse(PROGRAM), max_velocity=ROBOT.max_velocity
    )
    np.testing.assert_allclose(table["end_s"], [it.end for it in motion.moves])
    assert "takes 6 speeds" in refused("rapid", longer, file, "--max-velocity", 90)
    assert "0 must be positive" in refused("rapid", longer, file, "--max-velocity", 0)


@pytest.mark.skipif(not hasattr(irbkin.Robot, "to_urdf"), reason="needs Robot.to_urdf")
def test_urdf_is_read_back_as_the_same_arm(tmp_path):
    file = tmp_path / "arm.urdf"
    assert run("urdf", NAME, "-o", file).returncode == 0
    assert run("urdf", NAME).stdout == file.read_bytes()
    q = np.radians(JOINTS)
    found = rows(run("fk", file, "-", "--csv", stdin="0,0,0,0,30,0\n"))
    wanted = ROBOT.fk(np.radians([0, 0, 0, 0, 30, 0]))[:3, 3] * 1e3
    np.testing.assert_allclose([found[f"{axis}_mm"][0] for axis in "xyz"], wanted, atol=1e-6)
    np.testing.assert_allclose(irbkin.Robot.from_urdf(file).fk(q), ROBOT.fk(q), atol=1e-12)


URDF = """<robot name="a">%s<joint name="g" type="prismatic"><parent link="l6"/><child link="l7"/>
</joint></robot>"""


def with_a_finger(turn):
    """A URDF with a prismatic joint behind the sixth, a right angle of which is `turn`."""
    links = "".join(f'<link name="l{number}"/>' for number in range(8))
    places = ["0 0 0.4", "0.1 0 0.1", "0 0 0.7", "0.3 0 0.115", "0.45 0 0", "0.085 0 0"]
    axes = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"]
    joints = "".join(
        f'<joint name="j{i}" type="revolute"><parent link="l{i - 1}"/><child link="l{i}"/>'
        f'<origin xyz="{place}" rpy="{turn if i == 2 else 0} 0 0"/><axis xyz="{axis}"/>'
        f'<limit lower="-3" upper="3"/></joint>'
        for i, (place, axis) in enumerate(zip(places, axes, strict=True), 1)
    )
    return URDF % (links + joints)


def test_a_urdf_takes_its_links_and_a_snap(tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(with_a_finger(0))
    zeros = ["0"] * 6
    assert '; give --tip "l6" (6 joints)' in refused("fk", file, *zeros)
    found = rows(run("fk", file, *zeros, "--tip", "l6", "--csv"))
    assert found["x_mm"][0] == pytest.approx(935)
    assert "for an arm of five axes" in refused(
        "fk", file, *zeros, "--tip", "l6", "--base-link", "l1"
    )
    assert "go with a .urdf file" in refused("fk", NAME, *zeros, "--tip", "l6")
    file.write_text(with_a_finger(4e-6))
    note = run("fk", file, *zeros, "--tip", "l6").stderr.decode()
    assert "--snap 1e-5 gives spherical wrist, moves the tool by up to " in note
    assert not run("fk", file, *zeros, "--tip", "l6", "--snap", "1e-5").stderr


def test_lengths_in_meters_are_asked_for(tmp_path):
    words = ["ik", NAME, "--wxyz", "0.2588190", "0", "0.9659258", "0", "--xyz"]
    assert "are these meters?" in refused(*words, "0.85", "0.32", "0.64")
    assert run(*words, "0", "0", "0").returncode == 0
    file = tmp_path / "poses.csv"
    file.write_text("0.85,0.32,0.64,0.2588190,0,0.9659258,0\n")
    assert "are these meters?" in refused("ik", NAME, file)
    for unit, factor in (("m", 1), ("mm", 1e3)):
        x, y, z = (factor * it for it in (0.85, 0.32, 0.64))
        head = ",".join(f"{axis}_{unit}" for axis in "xyz")
        file.write_text(f"{head},qw,qx,qy,qz\n{x},{y},{z},0.2588190,0,0.9659258,0\n")
        assert run("ik", NAME, file).returncode == 0
    assert "are these meters?" in refused(*words, "850", "320", "640", "--tool", "0", "0", "0.18")


def test_an_ending_without_a_format_is_refused(tmp_path):
    for verb in (["ik", NAME, *XYZ], ["catalog"], ["fk", NAME, *["0"] * 6]):
        message = refused(*verb, "-o", tmp_path / "x.xlsx")
        assert "ends in .xlsx, it must end in .csv, .json, .npy, .txt" in message
    assert not list(tmp_path.iterdir())
    assert run("ik", NAME, *XYZ, "-o", tmp_path / "x.txt").returncode == 0


def test_the_reason_is_in_the_json():
    done = run("ik", NAME, "--xyz", "9850", "0", "0", "--json")
    assert done.returncode == 1
    assert "beyond reach" in json.loads(done.stdout)["reason"]


def test_help_and_version_are_taken_as_other_commands_take_them():
    assert run("help", "ik").stdout == run("ik", "--help").stdout
    assert run("ik", "--version").stdout == run("--version").stdout
    assert "give one of them" in refused("ik", NAME, *XYZ, "--euler", 0, 0, 0)
