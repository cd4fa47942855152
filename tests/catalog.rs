//! Every arm of the catalog is compared with figures that are not irbkin's own.
#![allow(clippy::unreadable_literal)]

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

use crate::common::{Rng, apart, reach_of};
use irbkin::catalog::{CatalogArm, CatalogGeometry};
use irbkin::{Error, JointLimits, Pose, Robot, catalog, pose};
use nalgebra::Vector3;

/// The source of the figures that an arm is compared with. Only the first kind can detect a wrong
/// catalog; the second detects a wrong product, the third a typing error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Golden {
    /// A pose that others measured, recorded or published.
    MeasuredOrPublishedByOthers,
    /// Poses that another program computed from the table in the catalog.
    IndependentProductOfTheTable,
    /// The zero pose, summed from the maker's figures, which are also those of the catalog.
    TranscriptionOfTheSheet,
}

/// Arm, joint angles [deg], position of tool0 [mm], quaternion w x y z, source.
type Pair = (&'static str, [f64; 6], [f64; 3], [f64; 4], &'static str);

const UP: [f64; 4] = [std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0];
/// Universal Robots' flange at zero: its z along -y of the base.
const TO_THE_SIDE: [f64; 4] =
    [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0];
const HOME: [f64; 4] = [0.5, 0.0, 0.866_025_404, 0.0];
const HOME_JOINTS: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 30.0, 0.0];

#[rustfmt::skip]
const MEASURED_OR_PUBLISHED_BY_OTHERS: [Pair; 18] = [
    ("IRB 120-3/0.58", HOME_JOINTS, [364.353829, 0.0, 594.0], HOME, "RobotStudio home robtarget"),
    ("IRB 140-6/0.81", HOME_JOINTS, [506.291651, 0.0, 679.5], HOME, "RobotStudio home robtarget"),
    ("IRB 140-6/0.81", [0.0; 6], [515.0, 0.0, 712.0], UP,
     "Robot Web Services reference, robtarget and jointtarget pages"),
    ("IRB 1200-5/0.9", HOME_JOINTS, [522.014083, 0.0, 848.1], HOME, "RobotStudio home robtarget"),
    ("IRB 2600-12/1.85", HOME_JOINTS, [1018.612159, 0.0, 1417.5], HOME,
     "RobotStudio home robtarget"),
    ("IRB 4600-20/2.5", [0.0; 6], [1490.5, 0.0, 1765.0], UP, "Susta79/RF210001, README"),
    ("IRB 4600-20/2.5", [45.0; 6], [734.88, 794.99, -21.32],
     [0.353_545_455, -0.353_599_631, -0.853_545_455, 0.146_400_369], "Susta79/RF210001, README"),
    ("IRB 6640-235/2.55",
     [-79.740_641_207_9, 16.877_346_913_8, 164.702_460_756, 167.359_872_672, -123.259_290_596,
      169.413_401_434],
     [-107.491_424_219, 388.403_686_13, 1_800.372_279_7],
     [0.689_966_366_553, 0.256_058_176_935, 0.184_888_397_87, -0.651_304_002_278],
     "rpiRobotics/ik-geo test cases"),
    ("IRB 6640-235/2.55",
     [64.344_655_748_9, 92.786_447_008_2, 87.527_688_525, -38.798_272_967_7, 55.972_040_463_9,
      -118.372_792_388],
     [153.773_731_978, 80.276_836_2, 663.799_788_567],
     [0.759_671_110_762, 0.265_917_851_382, 0.323_738_818_68, -0.497_373_780_038],
     "rpiRobotics/ik-geo test cases"),
    ("UR3", [0.0; 6], [-456.9, -194.25, 66.55], TO_THE_SIDE,
     "py_ur_kin test_ur3, its base_link turned half a turn"),
    ("CRB 15000-5/0.95",
     [22.2673892974854, -19.6164798736572, 18.3290138244629, -20.6253910064697, 18.7832584381104,
      21.4719200134277],
     [400.2985060215, 180.359080433846, 846.928238868713],
     [0.594565212726593, -0.108096286654472, 0.792664468288422, 0.0805630683898926],
     "controller, eliasbitsch/MetaMove: jointtarget and robtarget of one moment, float32"),
    ("xArm6", [0.0; 6], [207.0, 0.0, 112.0], [0.0, 1.0, 0.0, 0.0], "viamrobotics/rdk, tests"),
    ("xArm6", [90.0, -90.0, 90.0, -90.0, 90.0, -90.0], [97.0, -207.0, -98.0],
     [0.5, -0.5, 0.5, -0.5], "viamrobotics/rdk, tests (position)"),
    ("CRX-10iA", [78.0, -41.0, -24.0, -42.0, -60.0, 10.0], [80.321, 287.676, 394.356 + 245.0],
     [0.503_359_11, -0.644_044_55, -0.565_547_13, -0.109_510_98], "Abbes and Poisson 2024, pose 1"),
    ("CRX-10iA", [44.611, 89.087, 198.28, 94.703, 121.416, 121.782],
     [80.321, 287.676, 394.356 + 245.0],
     [0.503_359_11, -0.644_044_55, -0.565_547_13, -0.109_510_98], "Abbes and Poisson 2024, pose 1"),
    ("CRX-10iA", [-14.478, 119.78, 197.781, -180.0, 168.001, -95.522], [600.0, 0.0, 345.0],
     [0.0, 0.819_152_044, 0.573_576_436, 0.0], "Abbes and Poisson 2024, pose 2"),
    ("CRX-10iA", [0.0, -45.0, -1.0, -37.0, -53.0, 0.0], [209.47, -42.894, 685.496 + 245.0],
     [0.316_710_1, -0.721_111_6, -0.019_368_98, -0.615_887_66], "Abbes and Poisson 2024, pose 3"),
    ("CRX-10iA", [47.115, -53.924, -18.002, 28.105, -41.924, -48.121],
     [209.47, -42.894, 685.496 + 245.0],
     [0.316_710_1, -0.721_111_6, -0.019_368_98, -0.615_887_66], "Abbes and Poisson 2024, pose 3"),
];

/// Arm, position of tool0 at zero [mm] from the lengths on the maker's sheet.
#[rustfmt::skip]
const TRANSCRIPTION_OF_THE_SHEET: [(&str, [f64; 3]); 14] = [
    ("UR3", [-243.65 - 213.25, -112.35 - 81.9, 151.9 - 85.35]),
    ("UR3e", [-243.55 - 213.2, -131.05 - 92.1, 151.85 - 85.35]),
    ("UR5", [-425.0 - 392.25, -109.15 - 82.3, 89.159 - 94.65]),
    ("UR5e", [-425.0 - 392.2, -133.3 - 99.6, 162.5 - 99.7]),
    ("UR7e", [-425.0 - 392.2, -133.3 - 99.6, 162.5 - 99.7]),
    ("UR8 Long", [-898.9 - 714.9, -182.4 - 143.4, 218.6 - 136.1]),
    ("UR10", [-612.0 - 572.3, -163.941 - 92.2, 127.3 - 115.7]),
    ("UR10e", [-612.7 - 571.55, -174.15 - 116.55, 180.7 - 119.85]),
    ("UR12e", [-612.7 - 571.55, -174.15 - 116.55, 180.7 - 119.85]),
    ("UR15", [-647.5 - 516.4, -182.4 - 143.4, 218.6 - 136.1]),
    ("UR16e", [-478.4 - 360.0, -174.15 - 116.55, 180.7 - 119.85]),
    ("UR18", [-475.0 - 338.9, -182.4 - 143.4, 218.6 - 136.1]),
    ("UR20", [-862.0 - 728.7, -201.0 - 154.3, 236.3 - 159.3]),
    ("UR30", [-637.0 - 503.7, -201.0 - 154.3, 236.3 - 159.3]),
];

#[test]
fn measured_or_published_by_others() {
    for (name, degrees, xyz_mm, wxyz, source) in MEASURED_OR_PUBLISHED_BY_OTHERS {
        // The sources print two to nine decimals.
        let digits = if source.starts_with("Susta79") {
            (0.01, 2e-4)
        } else if source.starts_with("controller") {
            // In float32.
            (1e-3, 1e-6)
        } else if source.starts_with("Abbes") {
            // Three decimals, over a meter.
            (0.01, 1e-8)
        } else {
            (1e-6, 1e-8)
        };
        assert_is_met(name, &degrees, &xyz_mm, &wxyz, digits);
    }
}

#[test]
fn transcription_of_the_sheet() {
    for (name, xyz_mm) in TRANSCRIPTION_OF_THE_SHEET {
        assert_is_met(name, &[0.0; 6], &xyz_mm, &TO_THE_SIDE, (1e-6, 1e-8));
    }
}

#[test]
fn the_crx_10ial_meets_the_lengths_of_its_urdf() {
    // FANUC-CORPORATION/fanuc_description: forward l_4 + l_6, aside l_5, up l_base + l_2.
    let xyz = [540.0 + 160.0, -150.0, 245.0 + 710.0];
    assert_is_met("CRX-10iA/L", &[0.0; 6], &xyz, &[0.0, UP[0], 0.0, UP[2]], (1e-6, 1e-8));
}

/// Compares a pose, to the given digits of its position [mm] and quaternion.
fn assert_is_met(
    name: &str,
    degrees: &[f64; 6],
    xyz_mm: &[f64; 3],
    wxyz: &[f64; 4],
    (position, rotation): (f64, f64),
) {
    let robot: Robot<6> = Robot::named(name).unwrap();
    let (xyz, found) = pose::to_wxyz(&robot.fk(&degrees.map(f64::to_radians)));
    for (axis, mm) in xyz_mm.iter().enumerate() {
        assert!((xyz[axis] * 1e3 - mm).abs() < position, "{name}: {xyz:?} m, not {xyz_mm:?} mm");
    }
    let dot: f64 = found.iter().zip(wxyz).map(|(a, b)| a * b).sum();
    assert!(1.0 - dot.abs() < rotation, "{name}: {found:?}, not {wxyz:?}");
}

/// Arm, joint angles [deg] with a serial axis 3, position of tool0 [mm], quaternion w x y z.
type Product = (String, [f64; 6], [f64; 3], [f64; 4]);

/// Rows of tests/data/abb_catalog_poses.csv.
fn products_of_rows() -> Vec<Product> {
    let text = include_str!("data/abb_catalog_poses.csv");
    let row = |line: &str| {
        // A name may contain a comma; the thirteen numbers after it do not.
        let mut numbers: Vec<f64> =
            line.rsplitn(14, ',').take(13).map(|number| number.parse().unwrap()).collect();
        numbers.reverse();
        let name = line.rsplitn(14, ',').last().unwrap().trim_matches('"').to_owned();
        (
            name,
            numbers[..6].try_into().unwrap(),
            numbers[6..9].try_into().unwrap(),
            numbers[9..].try_into().unwrap(),
        )
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn independent_product_of_the_table() {
    for (name, degrees, xyz_mm, wxyz) in products_of_rows() {
        let robot: Robot<6> = Robot::named(&name).unwrap().uncoupled();
        let (xyz, found) = pose::to_wxyz(&robot.fk(&degrees.map(f64::to_radians)));
        // Half a unit of the last digit in the file, plus rounding.
        for (axis, mm) in xyz_mm.into_iter().enumerate() {
            assert!(
                (xyz[axis] * 1e3 - mm).abs() < 0.5e-6 + 1e-11,
                "{name}: {xyz:?} m, not {xyz_mm:?} mm"
            );
        }
        for (found, wanted) in found.into_iter().zip(wxyz) {
            assert!((found - wanted).abs() < 0.5e-9 + 1e-14, "{name}: {found}, not {wanted}");
        }
    }
}

#[test]
fn the_zero_pose_is_the_sum_of_the_lengths_in_the_drawing() {
    for arm in catalog() {
        let CatalogGeometry::Abb { a1, a2, c1, c2, c3, c4, .. } = arm.geometry else { continue };
        let pose: Pose = Robot::<6>::from_catalog(&arm).unwrap().fk(&[0.0; 6]);
        let wanted = Vector3::new(a1 + c3 + c4, 0.0, c1 + c2 - a2) / 1e3;
        assert!(
            (pose.translation.vector - wanted).amax() < 2e-15 * wanted.norm(),
            "{}: {pose}",
            arm.name
        );
    }
}

/// Arm, joint angles [rad], position of the tip [mm], quaternion w x y z.
type FiveAxes = (&'static str, [f64; 5], [f64; 3], [f64; 4]);

/// Products of the origins of the makers' URDFs, calculated with NumPy.
#[rustfmt::skip]
const FIVE_AXES: [FiveAxes; 4] = [
    ("SO-101", [0.0; 5], [20.394979, -375.6011, 258.9517], [1.0, 0.0, 0.0, 0.0]),
    ("SO-101", [0.3, -0.4, 0.5, -0.6, 0.7], [-70.001297138, -298.193253807, 326.534164952],
     [0.88727218768, -0.180145857997, 0.363237369728, -0.219895766329]),
    ("ViperX 300", [0.0; 5], [472.119, 0.0, 427.05], [1.0, 0.0, 0.0, 0.0]),
    ("ViperX 300", [0.3, -0.4, 0.5, -0.6, 0.7], [320.337241424, 99.091920872, 450.576588946],
     [0.88727218768, 0.363237369728, -0.180145857997, 0.219895766329]),
];

#[test]
fn arms_of_five_axes_meet_the_products_of_their_urdfs() {
    for (name, q, xyz_mm, wxyz) in FIVE_AXES {
        let (xyz, found) = pose::to_wxyz(&Robot::<5>::named(name).unwrap().fk(&q));
        for axis in 0..3 {
            assert!((xyz[axis] * 1e3 - xyz_mm[axis]).abs() < 1e-8, "{name}: {xyz:?}");
        }
        let dot: f64 = found.iter().zip(wxyz).map(|(a, b)| a * b).sum();
        assert!(1.0 - dot.abs() < 1e-10, "{name}: {found:?}");
    }
}

/// The best kind of figures that exists for an arm.
fn golden_of(name: &str, products: &[Product]) -> Option<Golden> {
    let has = |pairs: &[Pair]| pairs.iter().any(|pair| pair.0 == name);
    if has(&MEASURED_OR_PUBLISHED_BY_OTHERS)
        || SEVEN_AXES.contains(&name)
        || YUMI.iter().any(|pose| pose.0 == name)
    {
        Some(Golden::MeasuredOrPublishedByOthers)
    } else if products.iter().filter(|row| row.0 == name).count() == 2
        || FIVE_AXES.iter().any(|row| row.0 == name)
    {
        Some(Golden::IndependentProductOfTheTable)
    } else if TRANSCRIPTION_OF_THE_SHEET.iter().any(|arm| arm.0 == name) || name == "CRX-10iA/L" {
        Some(Golden::TranscriptionOfTheSheet)
    } else {
        None
    }
}

/// The counts are stated, so that a change of an arm to a weaker kind is noticed.
#[test]
fn every_arm_has_a_golden_pose_of_a_stated_kind() {
    let products = products_of_rows();
    let mut counts = BTreeMap::new();
    for arm in catalog() {
        let kind = golden_of(arm.name, &products);
        *counts.entry(kind.unwrap_or_else(|| panic!("{} has none", arm.name))).or_insert(0) += 1;
        if matches!(arm.geometry, CatalogGeometry::Abb { .. }) {
            // In addition to what others measured of a few.
            assert_eq!(products.iter().filter(|row| row.0 == arm.name).count(), 2, "{}", arm.name);
        }
    }
    let stated = [
        (Golden::MeasuredOrPublishedByOthers, 15),
        (Golden::IndependentProductOfTheTable, 89),
        (Golden::TranscriptionOfTheSheet, 14),
    ];
    assert_eq!(counts, BTreeMap::from(stated));
}

/// Compared with a recorded pose in a separate test.
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

/// Joints in the order of the chain, 1, 2, 7, 3, 4, 5, 6 [deg], the flange [mm] and its quaternion.
type YumiPose = (&'static str, [f64; 7], [f64; 3], [f64; 4], f64);

/// Of the IRB 14050 at zero: rpiRobotics/yumi-ik, unit_tests/compare_to_robotstudio.m, from
/// `RobotStudio`; test_gofa_yumi.py has the other nine. Of the IRB 14000: its home position, as
/// programs of `RobotStudio` have it (Home of anjaa7/ABB-Robo-Challenge-2022, a tool of 114.2 mm;
/// Target_INIT of rparak/ABB-RobotStudio-YUMI-Tower-of_Hanoi, 84 mm).
const YUMI: [YumiPose; 3] = [
    (
        "IRB 14050-0.5/0.5",
        [0.0; 7],
        [341.5, 0.0, 598.0],
        [FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2, 0.0],
        0.0,
    ),
    (
        "IRB 14000-0.5/0.5 (right)",
        [0.0, -130.0, -135.0, 30.0, 0.0, 40.0, 0.0],
        [89.387_946_422, -156.622_117_956, 147.913_470_217],
        [0.066_010_726, -0.842_420_918, -0.111_214_912, -0.523_068_661],
        114.2,
    ),
    (
        "IRB 14000-0.5/0.5 (left)",
        [0.0, -130.0, 135.0, 30.0, 0.0, 40.0, 161.827],
        [63.216_469_095, 163.494_541_752, 161.324_792_511],
        [0.506_079_495, -0.023_222_858, 0.849_413_008, -0.147_789_664],
        84.0,
    ),
];

#[test]
fn yumi_meets_the_poses_of_robotstudio() {
    for (name, degrees, millimeters, wxyz, tool) in YUMI {
        let tool = Pose::translation(0.0, 0.0, tool / 1e3);
        let robot: Robot<7> = Robot::named(name).unwrap().with_tool(&tool).unwrap();
        let pose = robot.fk(&degrees.map(f64::to_radians));
        let norm = wxyz.iter().map(|part| part * part).sum::<f64>().sqrt();
        let wanted =
            irbkin::pose::from_wxyz(millimeters.map(|mm| mm / 1e3), wxyz.map(|part| part / norm))
                .unwrap();
        // The joints of the left arm have three decimals.
        let bound = if name.contains("left") { 1e-5 } else { 1e-6 };
        assert!((pose.translation.vector - wanted.translation.vector).amax() < bound, "{name}");
        assert!((pose.rotation.matrix() - wanted.rotation.matrix()).amax() < 1e-5, "{name}");
    }
}

#[test]
fn the_reach_in_the_type_name_is_that_of_the_lengths_or_the_row_has_both() {
    let mut off = 0;
    for arm in catalog() {
        let CatalogGeometry::Abb { a1, a2, c2, c3, .. } = arm.geometry else { continue };
        let (reach, printed) = ((a1 + c2 + a2.hypot(c3)) / 1e3, arm.reach.unwrap());
        let text = printed.to_string();
        let decimals = text.split_once('.').map_or(1, |(_, decimals)| decimals.len());
        let half_digit = 0.5 * 10.0_f64.powi(-i32::try_from(decimals).unwrap());
        let is_off = (reach - printed).abs() > half_digit + 1e-12;
        off += usize::from(is_off);
        let note = arm.provenance.split("; ").find(|it| it.starts_with("the lengths reach "));
        assert_eq!(note.is_some(), is_off, "{}: {reach} m", arm.name);
        if let Some(note) = note {
            assert!(note.contains(&format!("the lengths reach {reach:.3} m")), "{}", arm.name);
        }
        // ABB rounds to 50 mm; of the one linkage that is known to stop an arm before it is
        // stretched, the same is likely of the others.
        assert!((reach - printed).abs() < if arm.is_coupled() { 0.06 } else { 0.051 });
    }
    assert_eq!(off, 15);
}

#[test]
fn a_provenance_starts_with_as_many_sources_as_are_counted() {
    for arm in catalog() {
        let first = arm.provenance.split(';').next().unwrap();
        let mut names: Vec<_> = first.split(", ").map(|it| it.split(" (").next()).collect();
        assert_eq!(names.len(), usize::from(arm.sources), "{}: {first}", arm.name);
        names.sort();
        names.dedup();
        assert_eq!(names.len(), usize::from(arm.sources), "{}: {first}", arm.name);
    }
}

#[test]
fn limits_of_axis_6_are_angles_and_not_turns() {
    // ABB's sheets have, beside the angle, the turns to which an axis may be set: 242, 288, ..
    for arm in catalog().filter(|arm| matches!(arm.geometry, CatalogGeometry::Abb { .. })) {
        let [lower, upper] = arm.limits[5];
        assert_eq!((lower, upper % 20.0), (-upper, 0.0), "{}", arm.name);
    }
}

/// The controller measures axis 3 from the base. Both ends of axes 2 and 3 are reached inside the
/// linkage: an end that is not would be one of the serial axis, or subtracted twice.
#[test]
fn each_end_of_axes_2_and_3_is_reached_inside_the_linkage() {
    let mut limited = 0;
    for arm in catalog().filter(CatalogArm::is_coupled) {
        let robot: Robot<6> = Robot::from_catalog(&arm).unwrap();
        let (two, three) = (arm.limits[1], arm.limits[2]);
        assert!(-90.0 < three[0] && three[1] < 180.0, "{}", arm.name);
        let Some(linkage) = robot.limits().linkage() else { continue };
        limited += 1;
        let [least, most] = linkage.map(f64::to_degrees);
        for end in three {
            assert!(end - two[1] <= most && least <= end - two[0], "{}", arm.name);
        }
        for end in two {
            assert!(three[0] - end <= most && least <= three[1] - end, "{}", arm.name);
        }
    }
    assert_eq!(limited, 1);
}

#[test]
fn limits_that_depend_on_another_axis_are_named() {
    for arm in catalog().filter(|arm| arm.name.starts_with("IRB 1600-")) {
        let wider = if arm.reach == Some(1.2) { "136 deg" } else { "150 deg" };
        let note = arm.provenance.split("; ").find(|it| it.starts_with("conditional"));
        let note = note.unwrap_or_else(|| panic!("{}", arm.name));
        assert!(note.contains(wider) && note.contains("while axis 1 is within"), "{note}");
    }
}

#[test]
fn payload_and_reach_of_an_abb_arm_are_those_of_its_name() {
    for arm in catalog().filter(|arm| matches!(arm.geometry, CatalogGeometry::Abb { .. })) {
        // "2600-12/1.65"; for the oldest, "6400R/2.5-150".
        let numbers: Vec<f64> =
            arm.name.split(['-', '/', ' ']).filter_map(|word| word.parse().ok()).collect();
        assert!(
            numbers.ends_with(&[arm.payload.unwrap(), arm.reach.unwrap()])
                || numbers.ends_with(&[arm.reach.unwrap(), arm.payload.unwrap()]),
            "{}",
            arm.name
        );
    }
}

#[test]
fn every_arm_has_sane_limits() {
    for arm in catalog() {
        assert!(arm.sources >= 1, "{}", arm.name);
        assert!(!arm.provenance.is_empty());
        assert!(
            arm.payload.is_none_or(|kilograms| kilograms > 0.0)
                && arm.reach.is_none_or(|meters| meters > 0.0)
        );
        for rates in [&arm.max_velocity, &arm.max_acceleration].into_iter().flatten() {
            assert!(rates.len() == arm.dof() && rates.iter().all(|rate| *rate > 0.0));
        }
        for [lower, upper] in &arm.limits {
            assert!(lower < upper, "{}", arm.name);
            if matches!(arm.geometry, CatalogGeometry::Abb { .. }) {
                assert!(*lower < 0.0 && *upper > 0.0, "{} cannot stand at zero", arm.name);
            }
        }
        if matches!(arm.geometry, CatalogGeometry::Abb { .. }) {
            // The widest ranges in any source: a larger one is a typing error.
            let most = [230.0, 180.0, 250.0, 400.0, 135.0, 400.0];
            for (limit, most) in arm.limits.iter().zip(most) {
                assert!(
                    limit.iter().all(|degrees| degrees.abs() <= most),
                    "{}: {limit:?}",
                    arm.name
                );
            }
        }
    }
}

const POSES: usize = 200;

/// Compares the answers for random poses with forward kinematics and with the joints that made the
/// poses.
fn closes<const N: usize>(
    robot: &Robot<N>,
    rng: &mut Rng,
    solve: impl Fn(&Pose, &[f64; N]) -> Vec<[f64; N]>,
) {
    let (name, reach) = (robot.name(), reach_of(robot));
    for _ in 0..POSES {
        let q = rng.inside(robot.limits());
        let pose = robot.fk(&q);
        let answers = solve(&pose, &q);
        for answer in &answers {
            let residual = robot.residual(answer, &pose);
            assert!(
                residual.position <= 3e-15 * reach && residual.rotation <= 1e-14,
                "{name}: {residual:?} of {answer:?}"
            );
        }
        assert!(answers.iter().any(|answer| apart(answer, &q) < 1e-9), "{name}: {q:?} is lost");
    }
}

#[test]
fn every_arm_closes_on_random_poses_and_finds_the_joints_that_made_them() {
    let mut rng = Rng::new(2026);
    for arm in catalog() {
        if arm.dof() == 5 {
            let robot: Robot<5> = Robot::from_catalog(&arm).unwrap();
            closes(&robot, &mut rng, |pose, _| {
                robot.ik(pose).unwrap().iter().map(|solution| solution.q).collect()
            });
            continue;
        }
        if arm.dof() == 7 {
            let robot: Robot<7> = Robot::from_catalog(&arm).unwrap();
            closes(&robot, &mut rng, |pose, q| {
                robot.ik(pose, q[6]).unwrap().iter().map(|solution| solution.q).collect()
            });
            continue;
        }
        let mut robot: Robot<6> = Robot::from_catalog(&arm).unwrap();
        if matches!(arm.geometry, CatalogGeometry::ThreeParallel { .. }) {
            // 2 pi equivalents make no new poses.
            robot = robot.with_limits(JointLimits::new([[-PI, PI]; 6]).unwrap());
        }
        closes(&robot, &mut rng, |pose, _| {
            robot.ik(pose).unwrap().iter().map(|solution| solution.q).collect()
        });
    }
}

#[test]
fn names_match_in_any_spelling() {
    for spelling in [
        "IRB 2600-12/1,65",
        "IRB 2600\u{2013}12/1.65",
        "IRB 2600-12/1.65",
        "irb2600-12/1.65",
        "IRB_2600_12_1.65",
        " irb 2600 12 1.65 ",
        "IRB 2600-12/1.650",
    ] {
        assert_eq!(Robot::<6>::named(spelling).unwrap().name(), "IRB 2600-12/1.65");
    }
    for spelling in ["IRB 6700-220/2.65 (MH6, LeanID)", "irb 6700-220/2.65 mh6 leanid"] {
        assert_eq!(
            irbkin::catalog::find(spelling).unwrap().name,
            "IRB 6700-220/2.65 (MH6, LeanID)"
        );
    }
    for spelling in ["IRB 6650S-200/3", "IRB 6650S-200/3.0", "irb6650s-200/3.00"] {
        assert_eq!(irbkin::catalog::find(spelling).unwrap().name, "IRB 6650S-200/3.0");
    }
    for spelling in ["2600-12/1.65", "ROB1_2600_1.65_12", "IRB 2600-12/1.65 Type C"] {
        assert_eq!(irbkin::catalog::find(spelling).unwrap().name, "IRB 2600-12/1.65");
    }
    let seven = Robot::<6>::named("Panda").unwrap_err();
    assert_eq!(seven.to_string(), "the robot has 7 joints, it must have 6");
}

#[test]
fn an_unknown_name_lists_close_ones_and_is_never_guessed() {
    let close = |name: &str| match irbkin::catalog::find(name) {
        Err(Error::UnknownRobot(unknown)) => unknown.close,
        other => unreachable!("{name}: {other:?}"),
    };
    let all_2600 = [
        "IRB 2600-12/1.65",
        "IRB 2600-12/1.85",
        "IRB 2600-20/1.65",
        "IRB 2600ID-8/2.0",
        "IRB 2600ID-15/1.85",
    ];
    assert_eq!(close("IRB 2600"), all_2600);
    assert_eq!(close("2600"), all_2600);
    assert_eq!(close("IRB 1600-6"), ["IRB 1600-6/1.2", "IRB 1600-6/1.45"]);
    assert_eq!(close("IRB 140")[0], "IRB 140-6/0.81");
    assert_eq!(close("2600-12/1.66"), ["IRB 2600-12/1.65", "IRB 2600-12/1.85"]);
    assert_eq!(close("IRB 4600-40/2.5 Type C"), ["IRB 4600-20/2.5", "IRB 4600-40/2.55"]);
    assert_eq!(close("14000_05_05"), ["IRB 14000-0.5/0.5 (left)", "IRB 14000-0.5/0.5 (right)"]);
    assert_eq!(close("irb2600-12-165")[0], "IRB 2600-12/1.65");
    assert_eq!(close("IRB 6700-220/2.65"), ["IRB 6700-220/2.65 (MH6, LeanID)"]);
    assert_eq!(close("IRB 5710-70/2.7"), ["IRB 5710-70/2.7 LID"]);
    assert_eq!(close("IRB 6700").len(), 6);
    assert_eq!(close("IRB 2601")[..5], all_2600);
    assert_eq!(close("UR3f")[..2], ["UR3", "UR3e"]);
    for unlike in ["", "?", "KUKA KR 6 R700", "IRB 9999", "IRB 910SC-3/0.45"] {
        assert_eq!(close(unlike), [""; 0], "{unlike}");
    }
}
