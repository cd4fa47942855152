//! The URDF of a robot is read back as the robot.

use std::f64::consts::PI;

use crate::common::coupled_arm::{limited, odd, opposed, with_linkage};
use crate::common::{Rng, apart, random_pose, reach_of};
use crate::structures::spherical_wrist::kuka_kr6;
use irbkin::{JointLimits, Joints, PoseDifference, Robot, catalog, thresholds};
use irbkin_motion::{AnyArm, Arm, Error};

const CASES: usize = 100;

/// Rounding of a pose of the arm read back: two products of `N` transforms and three fixed ones,
/// whose elements are sums of four terms.
fn rounding<const N: usize>(robot: &Robot<N>) -> f64 {
    let lengths = [robot.base(), robot.tool()].map(|end| end.translation.vector.norm());
    let transforms = f64::from(u8::try_from(2 * (N + 3)).unwrap());
    4.0 * transforms * f64::EPSILON * (1.0 + reach_of(robot) + lengths.iter().sum::<f64>())
}

/// The text of a robot without a body.
fn urdf<const N: usize>(robot: &Robot<N>) -> String {
    Arm::from(robot.clone()).to_urdf()
}

/// The arm of the text of `robot`, after a comparison of everything but its solutions.
fn again<const N: usize>(robot: &Robot<N>) -> Arm<N>
where
    Robot<N>: Joints<N>,
{
    let read = Arm::<N>::from_urdf(&urdf(robot), None, None).unwrap();
    assert_eq!(read.name(), robot.name());
    assert_eq!(read.limits(), robot.limits());
    assert_eq!(read.max_velocity(), robot.max_velocity());
    assert_eq!(read.is_coupled(), robot.is_coupled());
    assert_eq!(read.structure(), robot.structure());
    let (mut rng, bound) = (Rng::new(1), rounding(robot));
    for _ in 0..CASES {
        let q = rng.inside(robot.limits());
        let off = PoseDifference::between(&read.fk(&q), &robot.fk(&q)).largest();
        assert!(off <= bound, "{}: off by {off:e}, {bound:e}", robot.name());
    }
    read
}

/// Both robots solve a pose by the same joint vectors in the same slots.
fn assert_same_solutions(robot: &Robot<6>, read: &Robot<6>) {
    let (mut rng, mut compared) = (Rng::new(2), 0);
    for _ in 0..CASES {
        let pose = robot.fk(&rng.inside(robot.limits()));
        let (wanted, found) = (robot.ik(&pose).unwrap(), read.ik(&pose).unwrap());
        let least = |q| robot.singularity(q).min_singular_value;
        let sigma = wanted.iter().map(|s| least(&s.q)).fold(f64::INFINITY, f64::min);
        if sigma < 1e-3 {
            continue;
        }
        compared += 1;
        assert_eq!(found.len(), wanted.len());
        for (a, b) in found.iter().zip(wanted.iter()) {
            assert_eq!((a.slot, a.is_within_limits()), (b.slot, b.is_within_limits()));
            assert!(apart(&a.q, &b.q) <= 4.0 * rounding(robot) / sigma, "{:?} {:?}", a.q, b.q);
        }
    }
    assert!(compared > CASES / 4, "{}: {compared}", robot.name());
}

#[test]
fn every_arm_of_the_catalog_is_read_back_with_its_solutions() {
    for arm in catalog() {
        let any = AnyArm::named(arm.name).unwrap();
        let text = any.to_urdf();
        match any {
            AnyArm::Six(robot) => {
                assert_eq!(text, robot.to_urdf());
                assert_same_solutions(&robot, &again(&robot));
            }
            AnyArm::Seven(robot) => {
                assert_eq!(text, robot.to_urdf());
                again(&robot);
            }
            AnyArm::Five(robot) => {
                assert_eq!(text, robot.to_urdf());
                again(&robot);
            }
        }
    }
}

#[test]
fn a_seven_axis_arm_is_read_back_with_its_solutions() {
    let robot: Robot<7> = Robot::named("Panda").unwrap();
    let (read, mut rng) = (again(&robot), Rng::new(3));
    let mut found = 0;
    for _ in 0..CASES {
        let q = rng.inside(robot.limits());
        let [one, two] = [&robot, &read].map(|robot| robot.ik_with(&robot.fk(&q), q[6]).unwrap());
        assert_eq!(one.len(), two.len());
        found += one.len();
        assert!(two.iter().any(|s| apart(&s.q, &q) < 1e-9));
    }
    assert!(found >= CASES);
}

/// Some programs round an axis along none of x, y and z, or turn about one of the three.
#[test]
fn every_axis_is_along_x_y_or_z() {
    let arms = catalog().map(|arm| AnyArm::named(arm.name).unwrap().to_urdf());
    let mut mdh = kuka_kr6().unwrap().mdh().clone();
    // Axes 2 and 3 stay parallel.
    for joint in [0, 1, 3, 4, 5] {
        mdh.rows[joint].alpha += 1e-3;
    }
    let crooked = Robot::from_mdh(mdh).unwrap().with_name("crooked");
    let crooked =
        [crooked.clone().coupled().unwrap(), crooked].map(|robot| again(&robot).to_urdf());
    for text in arms.chain(crooked) {
        for axis in text.split("<axis xyz=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
            let along: Vec<_> = axis.split(' ').filter(|part| *part != "0").collect();
            assert!(along == ["1"] || along == ["-1"], "{axis}");
        }
    }
}

/// Zero is a limit to some readers, and some need the attribute.
#[test]
fn an_unknown_velocity_is_written_as_one_that_does_not_bind() {
    let robot: Robot<6> = Robot::named("UR5e").unwrap();
    let unknown = urdf(&robot.clone().with_max_velocity(None).unwrap());
    assert_eq!(unknown.matches("velocity=\"100000\"").count(), 6);
    assert!(!unknown.contains("velocity=\"0\"") && !unknown.contains("velocity=\"inf\""));
    assert!(!urdf(&robot).contains("velocity=\"100000\""));
}

#[test]
fn base_and_tool_are_links_of_their_own() {
    let mut rng = Rng::new(4);
    for robot in [limited(), kuka_kr6().unwrap(), Robot::named("UR5e").unwrap()] {
        let robot = robot.with_base(&random_pose(&mut rng, 3.0)).unwrap();
        let robot = robot.with_tool(&random_pose(&mut rng, 0.5)).unwrap();
        again(&robot.clone().with_name("placed"));
        // Each end can be left out.
        let text = urdf(&robot);
        let between = |base, tip| Arm::<6>::from_urdf(&text, Some(base), Some(tip)).unwrap();
        let q = rng.inside(robot.limits());
        let inner = between("base_link", "tool0").fk(&q);
        let off = PoseDifference::between(&(robot.base() * inner * robot.tool()), &robot.fk(&q));
        assert!(off.largest() <= rounding(&robot), "{off:?}");
        let flange = between("base_link", "flange");
        // z of tool0 is x of the flange.
        let x = flange.fk(&q).rotation * nalgebra::Vector3::x();
        assert!((x - inner.rotation * nalgebra::Vector3::z()).norm() < 1e-14);
    }
}

#[test]
fn a_linkage_is_a_joint_that_mimics_joint_2_and_keeps_its_limits() {
    for robot in [limited(), with_linkage(), opposed()] {
        let robot = robot.with_name("coupled");
        let read = again(&robot);
        assert_eq!(read.limits().linkage(), robot.limits().linkage());
        assert_same_solutions(&robot, &read);
    }
    let text = urdf(&limited());
    assert!(text.contains("<mimic joint=\"joint_2\" multiplier=\"-1\" offset=\"0\"/>"));
    assert!(!urdf(&limited().uncoupled()).contains("mimic"));
    again(&limited().uncoupled().with_name("uncoupled"));
    // Signs, offsets, a lateral offset; joints without limits.
    let odd = odd().with_name("odd");
    again(&odd);
    assert!(urdf(&odd).contains("<joint name=\"joint_2-linkage\" type=\"continuous\">"));
}

/// The text of a coupled arm with a part of its linkage's joint, and then a part of joint 3, replaced.
fn linkage_replaced(linkage: &[[&str; 2]], third: &[[&str; 2]]) -> Result<Arm<6>, Error> {
    let text = urdf(&limited().with_name("coupled"));
    let [first, second] = ["<joint name=\"joint_2-linkage\"", "<joint name=\"joint_3\""]
        .map(|start| text.find(start).unwrap());
    let replaced = |text: &str, parts: &[[&str; 2]]| {
        parts.iter().fold(text.to_string(), |text, [from, to]| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        })
    };
    let (linkage, third) =
        (replaced(&text[first..second], linkage), replaced(&text[second..], third));
    Arm::from_urdf(&format!("{}{linkage}{third}", &text[..first]), None, Some("tool0"))
}

#[test]
fn a_joint_that_takes_joint_2_back_on_axis_3_is_a_linkage_however_it_is_written() {
    let robot = limited().with_name("coupled");
    let plain = linkage_replaced(&[], &[]).unwrap();
    let (mimic, reverse) = ("multiplier=\"-1\" offset=\"0\"", ["\"0 1 0\"", "\"0 -1 0\""]);
    // About the reverse axis; under another name.
    let reversed = linkage_replaced(&[reverse, [mimic, ""]], &[]).unwrap();
    assert_eq!(reversed, plain);
    let named = linkage_replaced(&[["joint_2-linkage", "parallel_rod"]], &[]).unwrap();
    assert_eq!(named, plain);
    // With an offset; behind joint 3; with axis 3 in the opposite sense, as Fanuc has it.
    let offset = linkage_replaced(&[[mimic, "multiplier=\"-1\" offset=\"0.1\""]], &[]).unwrap();
    let turned = [reverse, [mimic, "multiplier=\"1\" offset=\"-0.1\""]];
    let turned = linkage_replaced(&turned, &[]).unwrap();
    let mimicking = "<mimic joint=\"joint_2\" multiplier=\"-1\" offset=\"0\"/>";
    let behind = linkage_replaced(
        &[["joint_2-linkage", "third"], [mimicking, ""]],
        &[["joint_3", "passive"], ["<axis", "<mimic joint=\"joint_2\" multiplier=\"-1\"/><axis"]],
    );
    let (behind, opposed) = (behind.unwrap(), linkage_replaced(&[], &[reverse]).unwrap());
    let mut rng = Rng::new(5);
    for _ in 0..100 {
        let q = rng.inside(robot.limits());
        let third = |angle: f64| [q[0], q[1], angle, q[3], q[4], q[5]];
        for (read, q3) in [
            (&plain, q[2]),
            (&offset, q[2] - 0.1),
            (&turned, q[2] - 0.1),
            (&behind, q[2]),
            (&opposed, -q[2]),
        ] {
            assert!(read.is_coupled());
            let off = PoseDifference::between(&read.fk(&third(q3)), &robot.fk(&q));
            assert!(off.largest() <= rounding(&robot), "{off:?}");
        }
    }
}

#[test]
fn a_mimic_is_a_linkage_beside_joint_3_on_its_axis_alone() {
    let text = urdf(&limited());
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        let read = Arm::<6>::from_urdf(&text.replacen(from, to, 1), None, Some("tool0"));
        assert!(matches!(read, Err(Error::InvalidUrdf(_))));
        read.unwrap_err().to_string()
    };
    let wanted = |of: &str, multiplier: &str| {
        format!(
            "URDF: joint \"joint_2-linkage\" mimics \"{of}\" with multiplier {multiplier}, between \
             base and tip each joint must turn by itself, except a linkage: it takes joint 2 back \
             on the axis of joint 3, with multiplier -1, or 1 about the reverse axis (make the \
             joint fixed or choose base and tip beside it; snap makes angles with few digits exact)"
        )
    };
    let mimic = "<mimic joint=\"joint_2\" multiplier=\"-1\" offset=\"0\"/>";
    for (of, multiplier) in
        [("2", "1"), ("2", "-1.5"), ("2", "2"), ("2", "minus"), ("1", "-1"), ("3", "-1")]
    {
        let of = format!("joint_{of}");
        let other = format!("<mimic joint=\"{of}\" multiplier=\"{multiplier}\"/>");
        assert_eq!(refused(mimic, &other), wanted(&of, multiplier));
    }
    for offset in ["nan", "1e9"] {
        let other = format!("<mimic joint=\"joint_2\" multiplier=\"-1\" offset=\"{offset}\"/>");
        assert_eq!(refused(mimic, &other), wanted("joint_2", "-1"));
    }
    let refuses = |origin: &str, axis: &str| {
        let start = text.find("<joint name=\"joint_3\"").unwrap();
        let (before, after) = text.split_at(start);
        let moved = after.replacen("xyz=\"0 0 0\"", origin, 1);
        let moved = moved.replacen("<axis xyz=\"0 1 0\"/>", axis, 1);
        assert_ne!(moved, after);
        let read = Arm::<6>::from_urdf(&format!("{before}{moved}"), None, None);
        assert_eq!(read.unwrap_err().to_string(), wanted("joint_2", "-1"));
    };
    refuses("xyz=\"0 0 0.1\"", "<axis xyz=\"0 1 0\"/>");
    refuses("xyz=\"0 0 0\"", "<axis xyz=\"0 1 1e-3\"/>");
    // A gripper's finger that mimics another joint is no tip, and leaves the tip what it is.
    let finger = text.replace(
        "</robot>",
        "<link name=\"finger\"/><joint name=\"f\" type=\"revolute\"><parent link=\"link_6\"/>\
         <child link=\"finger\"/><mimic joint=\"joint_6\" multiplier=\"-1\"/></joint></robot>",
    );
    assert_eq!(Arm::<6>::from_urdf(&finger, None, None), Arm::from_urdf(&text, None, None));
}

#[test]
fn a_joint_without_limits_is_continuous_and_one_side_gets_the_largest_angle() {
    let robot = kuka_kr6().unwrap();
    let mut limits = robot.limits().to_array();
    limits[0] = [f64::NEG_INFINITY, f64::INFINITY];
    limits[5] = [-PI, f64::INFINITY];
    let robot = robot.with_limits(JointLimits::new(limits).unwrap());
    let text = urdf(&robot);
    assert!(text.contains("<joint name=\"joint_1\" type=\"continuous\">"));
    let read = Arm::<6>::from_urdf(&text, None, None).unwrap().limits().to_array();
    assert_eq!(read[..5], limits[..5]);
    assert_eq!(read[5], [-PI, thresholds::MOST_ANGLE]);
}

#[test]
fn any_name_is_written_and_read_back() {
    let named = |name: &str| urdf(&kuka_kr6().unwrap().with_name(name.to_owned()));
    let read = |text: &str| Arm::<6>::from_urdf(text, None, None).unwrap().name().to_owned();
    for name in ["a\"b<c>&d'", "--><!--", "IRB 2600-12/1.65", "\t\n\r x", "ロボット", "]]>"] {
        assert_eq!(read(&named(name)), name);
    }
    assert_eq!(read(&named("a\0b\u{1f}\u{fffe}")), "a\u{fffd}b\u{fffd}\u{fffd}");
    assert_eq!(read(&named("")), "robot");
}

#[test]
fn an_arm_of_unknown_structure_is_written_too() {
    let text = include_str!("data/tilted.urdf");
    let robot = Arm::<6>::serial_chain_from_urdf(text, None, None).unwrap();
    assert!(robot.missing_form().is_some());
    let read = Arm::<6>::serial_chain_from_urdf(&robot.to_urdf(), None, None).unwrap();
    let mut rng = Rng::new(5);
    for _ in 0..CASES {
        let q = [0; 6].map(|_| rng.between(-PI, PI));
        let off = PoseDifference::between(&read.fk(&q), &robot.fk(&q)).largest();
        assert!(off <= 10.0 * rounding(&robot), "{off:e}");
    }
}
