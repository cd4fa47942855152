"""Backups of controllers: units, limits in force, tasks; facts of real ones."""

from pathlib import Path

import irbkin
import numpy as np
import pytest
from backups import LIMITS, MOC, SMALL, arms, backinfo, cfg, robot, written
from cases import numbers, read
from irbkin.abb import load_backup
from test_controller_cases import CONFDATA, frame, tool_pose

EXAMPLE = Path(__file__).parents[2] / "examples" / "backup"
FACTS = read("abb_backup_facts.csv")
NOT_THERE = 9e9


def codes(backup, *, but=()):
    """Codes of the findings."""
    return sorted(it.code for it in backup.findings if it.code not in but)


def controller_of(path):
    """The rows of the facts that one MOC.cfg holds."""
    return [row for row in FACTS if row["path"] == path]


PATHS = sorted({row["path"] for row in FACTS if row["record"] == "robot"})


@pytest.fixture(params=PATHS, ids=lambda path: path.split("/")[0])
def real(request, tmp_path):
    """A backup with the units, types, bases and limits of a real one, and its rows."""
    rows = controller_of(request.param)
    robots = [row for row in rows if row["record"] == "robot"]
    units, bounds = [], []
    for number, row in enumerate(robots, 1):
        base = numbers(row, ("base_x", "base_y", "base_z")) / 1e3
        wxyz = numbers(row, ("base_qw", "base_qx", "base_qy", "base_qz"))
        units.append(robot(row["unit"], row["robot_type"], f"r{number}", base, wxyz))
        own = [it for it in rows if it["record"] == "limit" and it["unit"] == row["unit"]]
        bounds += arms(f"r{number}", [numbers(it, ("lower", "upper")) for it in own])
    version = robots[0]["cfg_version"]
    tasks = [
        f'-Name "{row["task"]}" -Type "NORMAL" -UseMechanicalUnitGroup "g{i}" -MotionTask'
        for i, row in enumerate(robots)
    ]
    groups = [f'-Name "G{i}" -Robot "{row["unit"].lower()}"' for i, row in enumerate(robots)]
    files = {
        "SYSPAR/moc.cfg": cfg("MOC", version, ARM=bounds, ROBOT=units),
        "SYSPAR/SYS.CFG": cfg("SYS", version, CAB_TASKS=tasks, MECHANICAL_UNIT_GROUP=groups),
        "BACKINFO/backinfo.txt": backinfo(*[(row["task"],) for row in robots]),
    }
    return load_backup(written(tmp_path, files)), rows


def test_robots_of_real_controllers_have_their_arm_base_and_limits(real):
    backup, rows = real
    robots = [row for row in rows if row["record"] == "robot"]
    assert list(backup.robots) == [row["unit"] for row in robots]
    kinds = {"4:0": "S4C+", "7:0": "OmniCore"}
    assert backup.controller.kind == kinds[robots[0]["cfg_version"]]
    for row in robots:
        unit = backup.robots[row["unit"]]
        assert (unit.type, unit.arm) == (row["robot_type"], row["arm"])
        np.testing.assert_allclose(unit.robot.base, frame(row, "base"), atol=1e-9)
        assert backup.task(row["task"].lower()).robot == row["unit"]
    limits = [row for row in rows if row["record"] == "limit"]
    assert len(limits) == 6 * len(robots)
    for row in limits:
        own = np.degrees(backup.robots[row["unit"]].robot.limits[int(row["axis"]) - 1])
        np.testing.assert_allclose(own, numbers(row, ("lower", "upper")), atol=6e-4)


def test_targets_of_real_controllers_have_their_confdata(real):
    backup, rows = real
    unit = rows[0]["unit"]
    targets = [
        row
        for row in FACTS
        if row["repository"] == rows[0]["repository"] and row["record"] in ("target", "pair")
    ]
    assert {row["unit"] for row in targets} >= {unit}
    agreeing = 0
    for row in targets:
        arm = backup.robot_at(row["unit"]).with_tool(frame(row, "tool"))
        # The base is in the robot.
        pose = frame(row, "base") @ tool_pose(row)
        confdata = tuple(int(row[field]) for field in CONFDATA)
        if row["agrees"] == "0":
            with pytest.raises(irbkin.UnreachableError):
                arm.ik_configured(pose, confdata)
            continue
        q = np.degrees(arm.ik_configured(pose, confdata))
        # Three decimals; a pair has two, of a controller.
        bound = 0.015 if row["record"] == "pair" else 1e-3
        np.testing.assert_allclose(q, numbers(row, [f"j{i}" for i in range(1, 7)]), atol=bound)
        agreeing += 1
    assert agreeing >= 5


def test_the_example_says_what_holds():
    backup = load_backup(EXAMPLE)
    assert backup.controller == irbkin.abb.Controller(
        "IRC5", "6.08.01.00", "6:0", "Example_Cell", True
    )
    assert [(it.name, it.robot, it.units, it.moves) for it in backup.tasks] == [
        ("T_ROB1", "ROB_1", ("STN_1",), True),
        ("T_ROB2", "ROB_2", ("TRACK_2", "M7DM1"), True),
        ("T_WATCH", None, (), False),
    ]
    assert [it.file for it in backup.task("T_ROB1").modules] == [
        "RAPID/TASK1/PROGMOD/MainModule.mod",
        "RAPID/TASK1/PROGMOD/Moves.mod",
        "RAPID/TASK1/SYSMOD/user.sys",
        "HOME/cell/CellData.sys",
    ]
    assert all(it.path.is_file() for it in backup.task("T_ROB2").modules)
    assert [str(it) for it in backup.findings] == [
        "SYSPAR/MOC.cfg:116: note: ROB_2: J2 is limited to -75..150 deg, -90..150 deg in the "
        "catalog [limits-differ]",
        "SYSPAR/SYS.cfg:11: warning: the backup lacks the module HOME:/cell/Gripper.sys "
        "[module-missing]",
        "SYSPAR/SYS.cfg: note: 1 module of the controller's installation is not in a backup "
        "(RELEASE) [module-installed]",
    ]


def test_a_track_carries_its_robot_and_a_positioner_turns():
    backup = load_backup(EXAMPLE)
    at = [1500.0, *[NOT_THERE] * 5]
    base = backup.robot_at("rob_2", at).base
    np.testing.assert_allclose(base[:3, 3], [-0.5 + 1.5, 3.2, 0.3], atol=1e-15)
    np.testing.assert_allclose(base[:3, 0], [0, 1, 0], atol=1e-6)
    # Its base is turned by 90 deg about x: turning about z of it turns x of the object up.
    turned = backup.frame_at("STN_1", [90.0, *[NOT_THERE] * 5])
    np.testing.assert_allclose(turned[:3, 0], [0, 0, 1], atol=1e-6)
    np.testing.assert_allclose(turned[:3, 3], [1.6, -1.2, 0.8], atol=1e-15)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda it: it.robot_at("ROB_2"), "TRACK_2: the target gives no eax_a, which moves it"),
        (lambda it: it.base_at("ROB_9"), "ROB_9: no such unit in the backup"),
        (lambda it: it.robot_at("STN_1"), "STN_1: is no robot"),
        (lambda it: it.frame_at("ROB_1"), "ROB_1 is a robot: external axes do not move it"),
        (lambda it: it.frame_at("M7DM1", [0] * 6), "M7DM1: how a servo moves is not determined by"),
    ],
)
def test_what_is_not_determined_is_an_error_that_names_the_unit(call, message):
    with pytest.raises(irbkin.InvalidModelError) as error:
        call(load_backup(EXAMPLE))
    assert str(error.value).startswith(message)


def machine(tmp_path, **types):
    """A backup with these types in MOC.cfg, and its task."""
    types = {"ARM": arms("rob1", LIMITS), **types}
    return load_backup(written(tmp_path, {**SMALL, "SYSPAR/MOC.cfg": cfg("MOC", "6:0", **types)}))


def test_limits_in_force_are_the_files_and_differ_by_name(tmp_path):
    own = [(-180, 180), (-75.0003, 150), (-180, 75), (-99000, 99000), (-125, 120.05), (-400, 400)]
    unit = machine(
        tmp_path, ARM=arms("rob1", own), ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1")]
    ).robots["ROB_1"]
    np.testing.assert_allclose(np.degrees(unit.robot.limits), own, rtol=1e-5)
    assert [it.joint for it in unit.limits_differ] == ["J2", "J4"]
    assert np.degrees(unit.limits_differ[0].catalog_lower) == pytest.approx(-90)


def test_limits_of_the_linkage_are_read(tmp_path):
    coupled = "-upper_joint_coupl_bound 1.0472 -lower_joint_coupl_bound -1.22173"
    bounds = arms(
        "rob1", [(-180, 180), (-42, 85), (-20, 120.5), (-300, 300), (-120, 120), (-360, 360)]
    )
    bounds[2] += " " + coupled
    unit = machine(
        tmp_path, ARM=bounds, ROBOT=[robot("ROB_1", "ROB1_6660_1.90_205", "rob1")]
    ).robots["ROB_1"]
    np.testing.assert_allclose(np.degrees(unit.robot.linkage_limits), [-70, 60], atol=1e-3)
    assert [it.joint for it in unit.limits_differ] == ["linkage"]


def test_unusable_limits_are_the_catalogs_and_said(tmp_path):
    bounds = [*arms("rob1", LIMITS)[:4], '-name "rob1_5" -upper_joint_bound -2']
    backup = machine(tmp_path, ARM=bounds, ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1")])
    catalog = irbkin.Robot("IRB 4600-40/2.55").limits
    np.testing.assert_array_equal(backup.robots["ROB_1"].robot.limits, catalog)
    assert codes(backup) == ["limits-missing"]
    assert "no limits of axis 5, 6 in the file" in backup.findings[0].message


def test_both_arms_of_a_yumi_are_read_with_axis_seven(tmp_path):
    wide = [(-168.5, 168.5), (-143.5, 43.5), (-123.5, 80), (-290, 290), (-88, 138), (-229, 229)]
    singles = [f'-name "ROB_{side}_7" -use_joint "rob_{side.lower()}_7"' for side in "LR"]
    types = {
        "ARM": [
            *arms("rob_l", [*wide, (-160, 168.5)]),
            *arms("rob_r", [*wide, (-168.5, 168.5)]),
        ],
        "ROBOT": [
            robot(f"ROB_{side}", "14000_05_05_TYPEA", f"rob_{side.lower()}") for side in "LR"
        ],
        "SINGLE": singles,
    }
    backup = machine(tmp_path, **types)
    assert [unit.arm for unit in backup.robots.values()] == [
        "IRB 14000-0.5/0.5 (left)",
        "IRB 14000-0.5/0.5 (right)",
    ]
    assert not backup.units
    # Axis 7 is third from the base.
    assert np.degrees(backup.robots["ROB_L"].robot.limits[2]) == pytest.approx(
        [-160, 168.5], abs=6e-4
    )
    assert [it.joint for it in backup.robots["ROB_L"].limits_differ] == ["J7"]
    assert backup.robots["ROB_R"].limits_differ == ()


@pytest.mark.parametrize(
    ("type_name", "message"),
    [
        ("ROB1_760_3.2_450", "left out of the catalog: IRB 260, 460"),
        ("ROB1_4600_2.55_41", 'close names: "IRB 4600-40/2.55"'),
        ("", "its type is not given"),
    ],
)
def test_an_unknown_arm_is_a_finding_that_says_why(tmp_path, type_name, message):
    backup = machine(tmp_path, ROBOT=[robot("ROB_1", type_name, "rob1")])
    unit = backup.robots["ROB_1"]
    assert (unit.robot, unit.arm, unit.type) == (None, None, type_name)
    assert codes(backup) == ["unknown-arm"]
    assert backup.findings[0].message.startswith("ROB_1: ")
    assert message in backup.findings[0].message
    with pytest.raises(irbkin.InvalidModelError, match="ROB_1: its arm"):
        backup.robot_at("ROB_1")


def test_the_wording_of_backinfo_stands_in_for_an_unknown_type(tmp_path):
    products = "RobotWare Version: 5.15.01\n  English\n  IRB 4600-40/2.55 Type C"
    files = {
        **SMALL,
        "SYSPAR/MOC.cfg": MOC.replace("ROB1_4600_2.55_40", "ROB1_OURS"),
        "BACKINFO/backinfo.txt": backinfo(("T_ROB1", "PROGMOD/Main.mod @"), products=products),
    }
    backup = load_backup(written(tmp_path, files))
    assert backup.robots["ROB_1"].arm == "IRB 4600-40/2.55"
    assert codes(backup) == ["arm-by-wording"]


@pytest.mark.parametrize(
    ("keys", "code"),
    [
        ("-base_frame_orient_u1 0.5", "base-frame"),
        ("-base_frame_pos_x 1E9", "base-frame"),
        ('-base_frame_coordinated "TRACK_9"', "carrier"),
    ],
)
def test_a_base_that_is_not_determined_is_said_once(tmp_path, keys, code):
    backup = machine(tmp_path, ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1", more=keys)])
    assert codes(backup) == [code]
    assert backup.findings[0].message.startswith("ROB_1: ")
    with pytest.raises(irbkin.InvalidModelError, match="ROB_1: "):
        backup.robot_at("ROB_1", [0.0] * 6)


def test_a_quaternion_without_its_first_part_has_one(tmp_path):
    keys = "-base_frame_orient_u1 -5.97904E-05 -base_frame_orient_u3 0.0012"
    backup = machine(tmp_path, ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1", more=keys)])
    assert codes(backup) == []
    assert backup.robots["ROB_1"].base[1, 0] == pytest.approx(0.0024, rel=1e-3)


def test_units_that_carry_each_other_are_an_error(tmp_path):
    singles = [
        f'-name "T{i}" -use_single_type "IRBT4004" -base_frame_coordinated "T{3 - i}"'
        for i in (1, 2)
    ]
    more = '-base_frame_coordinated "T1"'
    backup = machine(
        tmp_path,
        SINGLE=singles,
        JOINT=['-name "T1" -logical_axis 7', '-name "T2" -logical_axis 8'],
        ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1", more=more)],
    )
    assert codes(backup) == ["carrier"] * 3
    with pytest.raises(irbkin.InvalidModelError, match="ROB_1: the units that carry it carry each"):
        backup.robot_at("ROB_1", [0.0] * 6)


def test_the_only_external_axis_of_a_task_is_eax_a(tmp_path):
    backup = machine(
        tmp_path,
        SINGLE=['-name "TRACK_1" -use_single_type "IRBT4004_1" -base_frame_pos_y 2'],
        ROBOT=[
            robot(
                "ROB_1",
                "ROB1_4600_2.55_40",
                "rob1",
                (0, 2, 0),
                more='-base_frame_coordinated "TRACK_1"',
            )
        ],
    )
    assert codes(backup) == ["logical-axis"]
    assert (
        "TRACK_1: its logical axis is not in MOC.cfg: taken as eax_a" in backup.findings[0].message
    )
    np.testing.assert_allclose(backup.base_at("ROB_1", [700.0] * 6)[:3, 3], [0.7, 2, 0])


def test_the_base_of_a_carried_robot_is_in_the_world_with_the_track_at_zero(tmp_path):
    """As two calibrated tracks have it (ebruun/ECL_robotic_cell, 4600-COMPAS_RRC_BACKUP): the base
    of ROB_1 has the position of its track, whose x points back. Relative to the track, both robots
    would be at one place.
    """
    place = (3.69928, 3.45103, 0.0175951)
    at = " ".join(
        f"-base_frame_pos_{axis} {value}" for axis, value in zip("xyz", place, strict=True)
    )
    back = "-base_frame_orient_u0 8.91218E-06 -base_frame_orient_u1 -0.000726608 "
    back += "-base_frame_orient_u2 0.000932384 -base_frame_orient_u3 0.999999"
    turned = (0.707061, 0.000751788, -0.000145575, -0.707152)
    track = '-base_frame_coordinated "TRACK_1"'
    backup = machine(
        tmp_path,
        SINGLE=[f'-name "TRACK_1" -use_single_type "IRBT4004_1" -use_joint "track1" {at} {back}'],
        ARM=[
            *arms("rob1", LIMITS),
            '-name "T4004_3.9_1" -use_arm_type "track1" -upper_joint_bound 3.901 '
            "-lower_joint_bound -0.001",
        ],
        ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1", place, turned, track)],
    )
    np.testing.assert_allclose(backup.robots["ROB_1"].robot.base[:3, 3], place)
    np.testing.assert_allclose(backup.base_at("ROB_1", [0.0] * 6)[:3, 3], place)
    moved = backup.base_at("ROB_1", [1000.0, *[NOT_THERE] * 5])
    np.testing.assert_allclose(moved[:3, 3], [2.69928, 3.45103, 0.0175951], atol=2e-3)
    # It faces the other track.
    np.testing.assert_allclose(moved[:3, 0], [0, -1, 0], atol=2e-3)
    (axis,) = backup.units["TRACK_1"].axes
    assert (axis.eax, axis.lower, axis.upper) == ("a", -0.001, 3.901)


def test_a_gantry_of_general_kinematics_is_a_note(tmp_path):
    backup = machine(
        tmp_path,
        ROBOT=[robot("Gantry1", "ZX_GANTRY", "rob1")],
        ROBOT_TYPE=['-name "ZX_GANTRY" -type "GEN_KIN" -no_of_joints 3'],
    )
    assert not backup.robots
    assert backup.units["Gantry1"].kind == "gantry"
    found = [it for it in backup.findings if it.code == "unit-motion"]
    assert [it.severity for it in found] == ["note"]
    assert found[0].message.startswith("Gantry1: how a gantry moves is not determined")


def test_measured_kinematics_are_flagged(tmp_path):
    calibrated = robot("ROB_1", "ROB1_4600_2.55_40", "rob1", more='-use_robot_calib "r1_calib"')
    backup = machine(
        tmp_path,
        ROBOT=[calibrated],
        ARM_CALIB=['-name "rob1_2" -error_offset_x 0.0003'],
        MOTOR_CALIB=['-name "rob1_1" -cal_offset 2.5 -valid_cal_offset'],
    )
    unit = backup.robots["ROB_1"]
    assert unit.is_calibrated
    assert unit.has_offsets
    assert backup.controller.is_real
    assert codes(backup) == ["calibrated"]
    nominal = machine(tmp_path, ROBOT=[calibrated.replace("r1_calib", "r1_uncalib")])
    assert not nominal.robots["ROB_1"].is_calibrated
