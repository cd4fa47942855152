//! Every arm of the catalogue against figures that are not irbkin's own.
#![allow(clippy::unwrap_used, clippy::unreadable_literal, missing_docs)]

use nalgebra::Vector3;

use irbkin::{CatalogueGeometry, Error, Robot, catalogue, pose_to_quaternion};

/// Arm, joint angles [deg], position of tool0 [mm], quaternion w x y z, source.
type Golden = (&'static str, [f64; 6], [f64; 3], [f64; 4], &'static str);

const UP: [f64; 4] = [std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0];
/// Universal Robots' flange at zero: its z along -y of the base.
const TO_THE_SIDE: [f64; 4] = [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0];
const HOME: [f64; 4] = [0.5, 0.0, 0.866_025_404, 0.0];
const HOME_JOINTS: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 30.0, 0.0];

#[rustfmt::skip]
const GOLDEN: [Golden; 27] = [
    ("IRB 120-3/0.58", HOME_JOINTS, [364.353829, 0.0, 594.0], HOME, "RobotStudio home robtarget"),
    ("IRB 140-6/0.81", HOME_JOINTS, [506.291651, 0.0, 679.5], HOME, "RobotStudio home robtarget"),
    ("IRB 140-6/0.81", [0.0; 6], [515.0, 0.0, 712.0], UP, "Robot Web Services reference, robtarget and jointtarget pages"),
    ("IRB 1200-5/0.9", HOME_JOINTS, [522.014083, 0.0, 848.1], HOME, "RobotStudio home robtarget"),
    ("IRB 2600-12/1.85", HOME_JOINTS, [1018.612159, 0.0, 1417.5], HOME, "RobotStudio home robtarget"),
    ("IRB 4600-20/2.5", [0.0; 6], [1490.5, 0.0, 1765.0], UP, "Susta79/RF210001, README"),
    ("IRB 4600-20/2.5", [45.0; 6], [734.88, 794.99, -21.32], [0.353_545_455, -0.353_599_631, -0.853_545_455, 0.146_400_369], "Susta79/RF210001, README"),
    ("IRB 6640-235/2.55", [-79.740_641_207_9, 16.877_346_913_8, 164.702_460_756, 167.359_872_672, -123.259_290_596, 169.413_401_434],
     [-107.491_424_219, 388.403_686_13, 1_800.372_279_7], [0.689_966_366_553, 0.256_058_176_935, 0.184_888_397_87, -0.651_304_002_278], "rpiRobotics/ik-geo test cases"),
    ("IRB 6640-235/2.55", [64.344_655_748_9, 92.786_447_008_2, 87.527_688_525, -38.798_272_967_7, 55.972_040_463_9, -118.372_792_388],
     [153.773_731_978, 80.276_836_2, 663.799_788_567], [0.759_671_110_762, 0.265_917_851_382, 0.323_738_818_68, -0.497_373_780_038], "rpiRobotics/ik-geo test cases"),
    // No taught pose is public for these: the zero pose is the sum of the drawing's lengths.
    ("IRB 2600-12/1.65", [0.0; 6], [150.0 + 795.0 + 85.0, 0.0, 445.0 + 700.0 + 115.0], UP, "drawing"),
    ("IRB 1600-6/1.45", [0.0; 6], [150.0 + 600.0 + 65.0, 0.0, 486.5 + 700.0], UP, "drawing"),
    ("UR3", [0.0; 6], [-456.9, -194.25, 66.55], TO_THE_SIDE, "py_ur_kin test_ur3, its base_link turned half a turn"),
    ("UR3", [0.0; 6], [-243.65 - 213.25, -112.35 - 81.9, 151.9 - 85.35], TO_THE_SIDE, "published figures"),
    ("UR3e", [0.0; 6], [-243.55 - 213.2, -131.05 - 92.1, 151.85 - 85.35], TO_THE_SIDE, "published figures"),
    ("UR5", [0.0; 6], [-425.0 - 392.25, -109.15 - 82.3, 89.159 - 94.65], TO_THE_SIDE, "published figures"),
    ("UR5e", [0.0; 6], [-425.0 - 392.2, -133.3 - 99.6, 162.5 - 99.7], TO_THE_SIDE, "published figures"),
    ("UR7e", [0.0; 6], [-425.0 - 392.2, -133.3 - 99.6, 162.5 - 99.7], TO_THE_SIDE, "published figures"),
    ("UR8 Long", [0.0; 6], [-898.9 - 714.9, -182.4 - 143.4, 218.6 - 136.1], TO_THE_SIDE, "published figures"),
    ("UR10", [0.0; 6], [-612.0 - 572.3, -163.941 - 92.2, 127.3 - 115.7], TO_THE_SIDE, "published figures"),
    ("UR10e", [0.0; 6], [-612.7 - 571.55, -174.15 - 116.55, 180.7 - 119.85], TO_THE_SIDE, "published figures"),
    ("UR12e", [0.0; 6], [-612.7 - 571.55, -174.15 - 116.55, 180.7 - 119.85], TO_THE_SIDE, "published figures"),
    ("UR15", [0.0; 6], [-647.5 - 516.4, -182.4 - 143.4, 218.6 - 136.1], TO_THE_SIDE, "published figures"),
    ("UR16e", [0.0; 6], [-478.4 - 360.0, -174.15 - 116.55, 180.7 - 119.85], TO_THE_SIDE, "published figures"),
    ("UR18", [0.0; 6], [-475.0 - 338.9, -182.4 - 143.4, 218.6 - 136.1], TO_THE_SIDE, "published figures"),
    ("UR20", [0.0; 6], [-862.0 - 728.7, -201.0 - 154.3, 236.3 - 159.3], TO_THE_SIDE, "published figures"),
    ("UR30", [0.0; 6], [-637.0 - 503.7, -201.0 - 154.3, 236.3 - 159.3], TO_THE_SIDE, "published figures"),
    ("IRB 6700-150/3.2", [0.0; 6], [320.0 + 1592.5 + 200.0, 0.0, 780.0 + 1280.0 + 200.0], UP, "drawing"),
];

#[test]
fn golden_poses_are_met() {
    for (name, degrees, xyz_mm, wxyz, source) in GOLDEN {
        let robot: Robot<6> = Robot::named(name).unwrap();
        let (xyz, found) = pose_to_quaternion(&robot.fk(&degrees.map(f64::to_radians)));
        // The sources print two to nine decimals.
        let digits = if source.starts_with("Susta79") { (0.01, 2e-4) } else { (1e-6, 1e-8) };
        for (axis, mm) in xyz_mm.into_iter().enumerate() {
            assert!((xyz[axis] * 1e3 - mm).abs() < digits.0, "{name} ({source}): {xyz:?} m, not {xyz_mm:?} mm");
        }
        let dot: f64 = found.iter().zip(&wxyz).map(|(a, b)| a * b).sum();
        assert!(1.0 - dot.abs() < digits.1, "{name} ({source}): {found:?}, not {wxyz:?}");
    }
}

#[test]
fn every_arm_has_a_golden_pose() {
    let held = |name| GOLDEN.iter().any(|golden| golden.0 == name) || SEVEN_AXES.contains(&name);
    for arm in catalogue() {
        assert!(held(arm.name), "{} has none", arm.name);
    }
}

/// Held against a recorded pose by themselves.
const SEVEN_AXES: [&str; 2] = ["Panda", "FR3"];

#[test]
fn panda_and_fr3_meet_the_pose_recorded_on_a_machine() {
    // petercorke/robotics-toolbox-matlab#107, recorded from franka_ros.
    let [panda, fr3] = SEVEN_AXES.map(|name| Robot::<7>::named(name).unwrap());
    let q = [
        0.179_407_110_277_025,
        0.461_810_428_811_432,
        -0.074_742_374_192_204,
        -1.318_920_876_431_013,
        -0.018_208_485_350_013,
        1.825_240_688_090_595,
        0.809_489_307_880_827,
    ];
    let pose = panda.fk(&q);
    assert_eq!(pose, fr3.fk(&q));
    let recorded = [0.695_139_562_452_754, 0.081_864_847_706_614, 0.477_587_109_804_965];
    assert!((pose.translation.vector - Vector3::from(recorded)).amax() < 1e-9);
    assert!((pose.rotation[(0, 0)] - 0.768_176_030_504_295_6).abs() < 1e-9);
}

#[test]
fn the_reach_in_the_type_name_is_that_of_the_geometry() {
    for arm in catalogue() {
        let CatalogueGeometry::Abb { a1, a2, c2, c3, .. } = arm.geometry else { continue };
        let named: f64 = arm.name.split('/').next_back().unwrap().parse().unwrap();
        let reach = (a1 + c2 + a2.hypot(c3)) / 1e3;
        // Type names are rounded to a centimetre or, for large arms, to five.
        assert!((reach - named).abs() < 0.02, "{}: {reach} m", arm.name);
    }
}

#[test]
fn every_arm_closes_and_has_sane_limits() {
    for arm in catalogue() {
        assert!(arm.sources >= 2, "{}", arm.name);
        assert!(!arm.provenance.is_empty());
        for [lower, upper] in arm.limits {
            assert!(lower < upper);
        }
        if arm.dof() == 6 {
            let robot: Robot<6> = Robot::from_catalogue(arm).unwrap();
            let pose = robot.fk(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
            assert!(robot.ik(&pose).unwrap().len() >= 4);
        }
    }
}

#[test]
fn names_forgive_spelling_and_tell_the_close_ones() {
    for spelling in ["IRB 2600-12/1.65", "irb2600-12/1.65", "IRB_2600_12_1.65", " irb 2600 12 1.65 "] {
        assert_eq!(Robot::<6>::named(spelling).unwrap().name(), "IRB 2600-12/1.65");
    }
    let Err(Error::UnknownRobot(unknown)) = Robot::<6>::named("IRB 2600") else { unreachable!() };
    assert!(unknown.close.starts_with(&["IRB 2600-12/1.65", "IRB 2600-12/1.85"]), "{:?}", unknown.close);
    let seven = Robot::<6>::named("Panda").unwrap_err();
    assert_eq!(seven.to_string(), "the arm has 7 joints, 6 were asked for");
}
