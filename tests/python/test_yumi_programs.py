"""Programs of a YuMi: targets with an arm angle, lines on which it goes evenly, old confdata."""

import json

import command
import irbkin
import numpy as np
import pytest
from backups import backinfo, cfg, robot, written
from irbkin import rapid
from irbkin.abb import load_backup

YUMI = irbkin.Robot("IRB 14050")
AXES = [0, 1, 3, 4, 5, 6]
RNG = np.random.default_rng(14050)


def joint_target(q):
    """The JointTarget of joints in the order of the chain."""
    return rapid.JointTarget(np.degrees(q[AXES]), (np.degrees(q[2]), *(rapid.NOT_THERE,) * 5))


def target(q):
    return rapid.calc_rob_t(YUMI, joint_target(q))


def program(*moves):
    """A module that makes moves of (instruction, target)."""
    data = [
        f"CONST {'jointtarget' if name == 'MoveAbsJ' else 'robtarget'} p{i}:={rapid.dump(value)};"
        for i, (name, value) in enumerate(moves)
    ]
    lines = [f"{name} p{i},v100,fine,tool0;" for i, (name, _) in enumerate(moves)]
    return rapid.parse(
        "\n".join(["MODULE M", *data, "PROC main()", *lines, "ENDPROC", "ENDMODULE"])
    )


def pairs(count, step):
    """Joints inside the limits, and others near them, away from singularities."""
    lower, upper = YUMI.limits.T
    found = []
    while len(found) < count:
        q = lower + (upper - lower) * (0.1 + 0.8 * RNG.random(7))
        other = q + step * RNG.uniform(-1, 1, 7)
        is_inside = (lower < other).all() and (other < upper).all()
        if is_inside and np.linalg.svd(YUMI.jacobian(q))[1][-1] > 0.05:
            found.append((q, other))
    return found


def codes(module):
    return [it.code for it in rapid.check(YUMI, module)]


def test_the_joints_of_a_move_are_the_ones_that_its_target_was_made_of():
    for q, other in pairs(8, 0.3):
        module = program(("MoveJ", target(q)), ("MoveAbsJ", joint_target(other)))
        made = rapid.motion(YUMI, module)
        np.testing.assert_allclose(made.moves[0].q, q, atol=1e-6)
        np.testing.assert_allclose(made.q[-1], other, atol=1e-12)
        assert made.findings == ()


def test_the_arm_angle_goes_evenly_on_a_line():
    for q, other in pairs(8, 0.1):
        made = rapid.motion(YUMI, program(("MoveJ", target(q)), ("MoveL", target(other))))
        assert made.moves[1].as_programmed, made.findings
        samples = made.q[made.move_index == 1]
        T = YUMI.fk(np.vstack([made.q[0], samples]))
        part = np.arange(1, len(samples) + 1) / len(samples)
        way = T[-1, :3, 3] - T[0, :3, 3]
        np.testing.assert_allclose(T[1:, :3, 3], T[0, :3, 3] + part[:, None] * way, atol=1e-9)
        angles = np.unwrap([YUMI.arm_angle(it) for it in (made.q[0], *samples)])
        change = angles[-1] - angles[0]
        np.testing.assert_allclose(angles[1:], angles[0] + part * change, atol=1e-7)
        np.testing.assert_allclose(samples[-1], other, atol=1e-6)


def test_a_line_that_leaves_the_limits_is_found():
    q = np.radians([10, -60, 20, 10, 30, 40, 50])
    other = q + 0.05
    limits = YUMI.limits.copy()
    limits[4, 1] = 0.5 * (q + other)[4]
    line = program(("MoveAbsJ", joint_target(q)), ("MoveL", target(other)))
    assert codes(line) == []
    found = rapid.check(YUMI.with_limits(limits), line)
    assert [it.code for it in found] == ["R103"]
    assert "J5" in found[0].message


def test_an_arm_angle_that_is_missing_is_asked_for():
    own = target(pairs(1, 0.1)[0][0])
    without = rapid.RobTarget(own.trans_mm, own.rot, own.robconf)
    (finding,) = rapid.check(YUMI, program(("MoveJ", without)))
    assert finding.code == "U801"
    assert "eax_a" in finding.message


def old_target(q, cfx):
    """The target of joints with quarters from 0 to 90 deg, as old confdata has them."""
    own = target(q)
    quarters = np.floor(np.degrees(q[[0, 4, 6]]) / 90).astype(int)
    return rapid.RobTarget(own.trans_mm, own.rot, (*map(int, quarters), cfx), own.extax)


def test_old_confdata_with_cfx_11_have_4_and_quarters_that_begin_at_zero():
    of_4 = [it for it, _ in pairs(60, 0.1) if YUMI.configuration(it).cfx == 4]
    assert len(of_4) > 3
    for q in of_4[:4]:
        module = program(("MoveJ", old_target(q, 11)))
        (finding,) = rapid.check(YUMI, module)
        assert finding.code == "C205"
        now = list(YUMI.configuration(q))
        assert f"cfx 11 is an old form of 4, now its confdata is {now}" in finding.message
        np.testing.assert_allclose(rapid.motion(YUMI, module).moves[0].q, q, atol=1e-6)


def test_an_old_cfx_that_nobody_explains_is_named_and_not_guessed():
    q = pairs(1, 0.1)[0][0]
    for cfx in (10, 100, 101, 110, 111):
        module = program(("MoveJ", old_target(q, cfx)))
        (finding,) = rapid.check(YUMI, module)
        assert finding.code == "C205"
        assert f"cfx {cfx} has an old form that is not known" in finding.message
        with pytest.raises(irbkin.RapidError, match=f"cfx {cfx} has an old form"):
            rapid.motion(YUMI, module)


# Taught by hand, with tool0 or a gripper of the same direction: TechnoX/ABB-YUMI-LIB. All that the
# joints inside the limits can have of these poses and arm angles.
OLD = [
    ("left", [428.802, 107.913, 336.046], [0.969237, 0.186976, 0.159937, -0.0062316], [-1, -1, -2],
     157.51),
    ("left", [400, 200, 400], [0.962975, -0.00425686, -0.269271, -0.0124256], [-2, -1, -2],
     110.128),
    ("right", [431.13, -60, 337.42], [0.963594, 0.0128811, -0.26702, 0.00459979], [1, -1, 1],
     -102.057),
    ("right", [368.07, -60, 424.92], [0.963598, 0.0129005, -0.267003, 0.0046068], [1, -1, 1],
     -102.03),
    ("right", [425.57, -60, 457.94], [0.963591, 0.0128538, -0.267033, 0.0046038], [1, 0, 1],
     -102.11),
    ("right", [395.6, -295.28, 111.92], [6.11021e-05, -0.526551, -0.850144, 2.23703e-05],
     [0, -2, 0], -158.118),
]  # fmt: skip


def test_taught_targets_with_cfx_11_are_met_with_4_and_floor_alone():
    for side, trans, rot, quarters, angle in OLD:
        arm = irbkin.Robot(f"IRB 14000-0.5/0.5 ({side})")
        T = irbkin.pose(np.array(trans) / 1e3, wxyz=rot)
        every = arm.ik_configured(T, None, arm_angle=np.radians(angle), every=True)
        lower, upper = arm.limits.T
        # An arm that is guided by hand passes its limits by a degree.
        inside = [q for q in every if (lower - 0.02 <= q).all() and (q <= upper + 0.02).all()]
        written = [
            arm.configuration(q).cfx
            for q in inside
            if (np.floor(np.degrees(q[[0, 4, 6]]) / 90) == quarters).all()
        ]
        assert written == [4]


def test_confdata_of_another_branch_is_found_and_corrected():
    own = target(pairs(1, 0.1)[0][0])
    confdata = (*own.robconf[:3], own.robconf.cfx ^ 1)
    module = program(("MoveJ", rapid.RobTarget(own.trans_mm, own.rot, confdata, own.extax)))
    (finding,) = rapid.check(YUMI, module)
    assert finding.code == "C201"
    source = module.source.encode()
    for _, begin, end, text in reversed(finding.edits):
        source = source[:begin] + text.encode() + source[end:]
    assert codes(rapid.parse(source.decode())) == []


HOMES = {
    side: json.loads(target) for side, target in (
        ("R", "[[89.387946422,-156.622117956,147.913470217],[0.066010726,-0.842420918,-0.111214912,"
         "-0.523068661],[0,0,0,4],-101.964427132]"),
        ("L", "[[89.388081176,174.575150508,147.913525533],[0.06601065,0.842420935,-0.111215019,"
         "0.52306862],[0,0,0,4],101.964427489]"),
    )
}  # fmt: skip
"""Home of each arm, of a controller: tests/data/abb_yumi_confdata.csv."""
HOME_JOINTS = {
    "R": [0, -130, -135, 30, 0, 40, 0],
    "L": [-0.828, -128.627, 131.988, 29.234, -0.775, 41.236, -2.244],
}


def test_both_arms_of_a_backup_are_checked_with_their_own_targets(tmp_path):
    tool = "PERS tooldata servo:=[TRUE,[[0,0,114.2],[1,0,0,0]],[0.2,[0,0,50],[1,0,0,0],0,0,0]];"
    files = {
        "BACKINFO/backinfo.txt": backinfo(
            ("T_ROB_R", "PROGMOD/Own.mod @ "), ("T_ROB_L", "PROGMOD/Own.mod @ ")
        ),
        "SYSPAR/MOC.cfg": cfg(
            "MOC", "6:0",
            ROBOT=[robot(f"ROB_{it}", "14000_05_05_TYPEA", f"rob_{it.lower()}") for it in "RL"],
            SINGLE=[f'-name "ROB_{it}_7" -use_joint "rob_{it.lower()}_7"' for it in "RL"],
        ),
        "SYSPAR/SYS.cfg": cfg(
            "SYS", "6:0",
            CAB_TASKS=[
                f'-Name "T_ROB_{it}" -Type "NORMAL" -UseMechanicalUnitGroup "rob_{it}" -MotionTask'
                for it in "RL"
            ],
            MECHANICAL_UNIT_GROUP=[f'-Name "rob_{it}" -Robot "ROB_{it}"' for it in "RL"],
        ),
    }  # fmt: skip
    for number, (xyz, wxyz, confdata, angle) in enumerate(HOMES.values(), 1):
        extax = [angle, *["9E9"] * 5]
        home = f"[{xyz},{wxyz},{confdata},[{','.join(map(str, extax))}]]"
        files[f"RAPID/TASK{number}/PROGMOD/Own.mod"] = (
            f"MODULE Own\n{tool}\nPROC main()\nMoveJ {home},v100,fine,servo;\n"
            f"MoveL {home.replace('147.9', '187.9')},v100,fine,servo;\nENDPROC\nENDMODULE\n"
        )
    backup = load_backup(written(tmp_path, files))
    for side, wanted in HOME_JOINTS.items():
        program, unit = backup.programs[f"T_ROB_{side}"], backup.robots[f"ROB_{side}"]
        first, second = program.check(unit.robot).moves
        np.testing.assert_allclose(np.degrees(first.q), wanted, atol=2e-3)
        assert second.q is not None
    done = command.run("check", tmp_path)
    assert done.stdout.startswith(b"4 of 4 moves checked"), done.stdout
