//! Robots from URDF: what is read, and the messages for what is refused.
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

use crate::common;

use std::f64::consts::PI;
use std::fmt::Write;

use nalgebra::{Rotation3, Unit, Vector3};

use crate::common::Rng;
use crate::structures::spherical_wrist::kuka_kr6;
use irbkin::{Pose, PoseDifference, Robot};
use irbkin_motion::{Arm, Error};

const IRB2600: &str = include_str!("data/irb2600.urdf");
const ROUNDED: &str = include_str!("data/irb2600_rounded.urdf");
const KUKA: &str = include_str!("data/kr6_r700.urdf");
const UR5E: &str = include_str!("data/ur5e.urdf");
const PANDA: &str = include_str!("data/panda_hand.urdf");
const SEVEN: &str = include_str!("data/iiwa14.urdf");

fn turn(axis: Vector3<f64>, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle)
}

fn six(text: &str, base: Option<&str>, tip: Option<&str>) -> Result<Arm<6>, Error> {
    Arm::serial_chain_from_urdf(text, base, tip)
}

fn words(text: &str) -> String {
    refused(six(text, None, None))
}

/// Whether it is the URDF or its arm that is refused.
fn is_of_model(error: &Error) -> bool {
    matches!(error, Error::InvalidUrdf(_) | Error::Robot(irbkin::Error::InvalidModel(_)))
}

fn refused<const N: usize>(robot: Result<Arm<N>, Error>) -> String {
    let error = robot.unwrap_err();
    assert!(is_of_model(&error), "{error}");
    error.to_string()
}

/// The arm of the URDF is where `other` is, and has its solutions in its slots.
fn agrees(text: &str, other: &Robot<6>, bound: f64) {
    let robot = Arm::<6>::from_urdf(text, None, None).unwrap();
    let mut rng = Rng::new(1);
    for _ in 0..500 {
        let q = rng.inside(other.limits());
        let pose = other.fk(&q);
        let off = PoseDifference::between(&robot.fk(&q), &pose).largest();
        assert!(off <= bound, "off by {off:e}");
        if other.singularity(&q).min_singular_value < 1e-3 {
            continue;
        }
        let (found, wanted) = (robot.ik(&pose).unwrap(), other.ik(&pose).unwrap());
        let slots =
            |solutions: &irbkin::Solutions<6>| solutions.iter().map(|s| s.slot).collect::<Vec<_>>();
        assert_eq!(slots(&found), slots(&wanted), "{q:?}");
        for (a, b) in found.iter().zip(wanted.iter()) {
            assert!(common::apart(&a.q, &b.q) <= 1e5 * bound, "{:?} {:?}", a.q, b.q);
        }
    }
}

#[test]
fn arms_of_known_structure_have_their_inverse_and_slots() {
    agrees(IRB2600, &Robot::named("IRB 2600-12/1.65").unwrap(), 1e-14);
    agrees(KUKA, &kuka_kr6().unwrap(), 1e-14);
    // Right angles with nine decimals are 2e-10 off; six of them, at most 2 m away.
    let upright = Arm::<6>::from_urdf(IRB2600, None, Some("link_6")).unwrap();
    let rounded = Arm::<6>::from_urdf(ROUNDED, None, None).unwrap();
    let mut rng = Rng::new(2);
    for _ in 0..500 {
        let q = rng.inside(upright.limits());
        // Their tips are rotated relative to each other.
        let (a, b) = (upright.fk(&q).translation.vector, rounded.fk(&q).translation.vector);
        assert!((a - b).norm() <= 3e-9);
        assert!(
            rounded
                .ik(&rounded.fk(&q))
                .unwrap()
                .iter()
                .all(|s| rounded.residual(&s.q, &rounded.fk(&q)).largest() < 1e-13)
        );
    }
}

#[test]
fn names_limits_and_velocities_arrive() {
    let robot = Arm::<6>::from_urdf(IRB2600, None, None).unwrap();
    let catalog = Robot::<6>::named("IRB 2600-12/1.65").unwrap();
    assert_eq!(robot.name(), "irb2600");
    assert_eq!(robot.limits(), catalog.limits());
    assert_eq!(robot.max_velocity(), catalog.max_velocity());
    assert_eq!(robot.mdh().base, irbkin::Pose::identity());
    let seven = Arm::<7>::from_urdf(SEVEN, None, None).unwrap();
    assert_eq!(seven.limits().to_array()[6], [-175.0_f64.to_radians(), 175.0_f64.to_radians()]);
}

#[test]
fn a_continuous_joint_has_no_limits_and_an_absent_limit_is_zero() {
    let change = |from: &str, to: &str| six(&IRB2600.replace(from, to), None, None).unwrap();
    let robot =
        change("name=\"joint_1\" type=\"revolute\"", "name=\"joint_1\" type=\"continuous\"");
    assert_eq!(robot.limits().to_array()[0], [f64::NEG_INFINITY, f64::INFINITY]);
    assert!(robot.max_velocity().is_some());
    let robot = change("lower=\"-3.141592653589793\" ", "");
    assert_eq!(robot.limits().to_array()[0], [0.0, PI]);
    assert_eq!(robot.limits().to_array()[2], [0.0, 75.0_f64.to_radians()]);
}

#[test]
fn a_velocity_that_is_no_positive_number_is_unknown() {
    let velocity = "velocity=\"8.726646259971648\"";
    assert!(IRB2600.contains(velocity));
    for unknown in ["", "0", "-0.0", "-2", "1e5", "inf", "nan", "1 3", "${v}"] {
        let unknown =
            if unknown.is_empty() { String::new() } else { format!("velocity='{unknown}'") };
        let robot = six(&IRB2600.replace(velocity, &unknown), None, None).unwrap();
        assert_eq!(robot.max_velocity(), None, "{unknown}");
    }
}

#[test]
fn what_moves_no_axis_stops_no_file() {
    let whole = six(IRB2600, None, None).unwrap();
    let (limit, axis) = ("<limit", "<axis");
    for (from, to) in [
        (limit, "<limit start_stop='411' k_velocity='x'"),
        (axis, "<axis rpy='0 0 0'"),
        (axis, "<axis rpy=' 0 -0.0 0e3 '"),
        ("<origin", "<origin quat_wxyz='0 0 0'"),
        (axis, "<drake:gear_ratio value='1'/><axis"),
        (axis, "<foo:rotor/><axis bar:of='foo' drake:is='1'"),
        (axis, "<safety_controller k_velocity='?'/><calibration rising='x'/><axis"),
        (
            "<robot name=\"irb2600\"",
            "<!-- <!DOCTYPE a [ -->\n<!DOCTYPE\n robot>\n<robot name=\"irb2600\"",
        ),
        ("<robot name", "<!DOCTYPE robot PUBLIC \"-//A//B\" 'http://a/b.dtd'>\n<robot name"),
        ("<robot", "<!-- a & b --><robot"),
        ("<robot", "<!-- a -- b\n --><robot"),
        ("<robot name", "<robot version='1.0.0' name"),
        (axis, "<drake:limit lower='0'/><drake:axis xyz='1 2 3'/><axis"),
        ("<link", "<drake:joint type='fixed'/><drake:link/><link"),
    ] {
        let at = IRB2600.find(from).unwrap();
        let text = format!("{}{}", &IRB2600[..at], IRB2600[at..].replacen(from, to, 1));
        let text = text.strip_prefix("<?xml version=\"1.0\"?>").unwrap_or(&text);
        assert_eq!(six(text, None, None).as_ref(), Ok(&whole), "{to}");
    }
    let named = |name: &str| IRB2600.replace("\"irb2600\"", &format!("\"{name}\""));
    let robot = six(&named("A & B &amp; C&D; &#65; &"), None, None);
    assert!(robot.unwrap_err().to_string().contains("unknown entity reference 'D'"));
    let robot = six(&named("A & B &amp; C && &#65; &; &"), None, None).unwrap();
    assert_eq!(robot.name(), "A & B & C && A &; &");
    let unlimited = IRB2600.replace("lower=\"-6.981317007977318\"", "lower=\"-1e10\"");
    let unlimited = unlimited.replace("upper=\"6.981317007977318\"", "upper=\"inf\"");
    let limits = six(&unlimited, None, None).unwrap().limits().to_array();
    assert_eq!(limits[3], [f64::NEG_INFINITY, f64::INFINITY]);
    // A fixed joint has no axis and follows nothing.
    let fixed = "<axis xyz='0 0 0' rpy='1 2 3'/><mimic joint='joint_2'/>";
    let text =
        IRB2600.replace("<parent link=\"flange\"/>", &format!("<parent link='flange'/>{fixed}"));
    assert_ne!(text, IRB2600);
    assert_eq!(six(&text, None, None), Ok(whole));
}

#[test]
fn what_moves_an_axis_and_entities_are_refused() {
    let rpy = third("<axis", "<axis rpy=\"0 0 1e-3\"");
    assert!(words(&rpy).contains("joint \"joint_3\" <axis> has the attribute \"rpy\""));
    for kind in [
        "<!DOCTYPE r [<!ENTITY a \"b\">]>",
        "<!DOCTYPE r SYSTEM 'a' [\n]>",
        "<!DOCTYPE r [<!ATTLIST origin xyz CDATA '1 2 3'>]>",
    ] {
        let text = IRB2600.replacen("<robot", &format!("{kind}<robot"), 1);
        assert!(words(&text).ends_with("it has a document type, which is not read"), "{kind}");
    }
}

#[test]
fn the_joint_of_a_gripper_is_not_counted_silently() {
    let behind = |parent: &str, child: &str, joint: &str, kind: &str| {
        format!(
            "<link name='{child}'/><joint name='{joint}' type='{kind}'><parent link='{parent}'/>\
             <child link='{child}'/><limit lower='0' upper='1'/><origin xyz='0.1 0.2 0.3' \
             rpy='1 2 3'/></joint>"
        )
    };
    // `versioned` has six joints; a joint more makes seven.
    let seven = |more: String| {
        let text = versioned("", "", &more);
        irbkin_motion::AnyArm::from_urdf(&text, None, None).unwrap_err().to_string()
    };
    let asked = |joint: &str, ends: &str| {
        format!(
            "URDF: joint {joint:?} may be a gripper's: revolute joints lead from \"l0\" to {ends}; \
             tip must name the end of the arm"
        )
    };
    let jaw = |name: &str| behind("l6", "moving", name, "revolute");
    for name in ["gripper", "Moving_Jaw", "leftFinger", "claw_1"] {
        let end = format!(
            "no end of a chain: \"moving\" (behind joint {name:?}, which may be a gripper's); 6 axes and a \
             gripper; pass tip=\"l6\" (6 joints)"
        );
        assert!(seven(jaw(name)).ends_with(&end), "{}", seven(jaw(name)));
    }
    // A frame before the last joint: then both ends are of six or seven joints, or one is shorter.
    let both = seven(jaw("j7") + &behind("l6", "tcp", "f", "fixed"));
    assert!(both.contains("several ends: \"moving\" (7), \"tcp\" (6)"), "{both}");
    let text = versioned("", "", &behind("l5", "tcp", "f", "fixed"));
    assert_eq!(words(&text), asked("j6", "\"l6\" (6), \"tcp\" (5)"));
    let text = versioned("", "", &behind("l4", "tcp", "f", "fixed"));
    assert_eq!(words(&text), asked("j6", "\"l6\" (6), \"tcp\" (4)"));
    assert!(six(&text, None, Some("l6")).is_ok());
    // Frames nearer to the base are of no gripper.
    for link in ["l0", "l1", "l2", "l3"] {
        assert!(six(&versioned("", "", &behind(link, "camera", "f", "fixed")), None, None).is_ok());
    }
}

#[test]
fn base_and_tip_choose_the_chain() {
    let tool = six(UR5E, None, Some("tool0")).unwrap();
    let inner = six(UR5E, Some("base_link_inertia"), Some("wrist_3_link")).unwrap();
    let q = [0.1, -0.2, 0.3, -0.4, 0.5, -0.6];
    let half_turn = irbkin::pose::from_euler_zyx([0.0; 3], [PI, 0.0, 0.0]).unwrap();
    let off = PoseDifference::between(&tool.fk(&q), &(half_turn * inner.fk(&q)));
    // The tool frame of the description is the last link's.
    assert!(off.largest() <= 1e-14, "{off:?}");
    assert!(
        (Arm::<7>::from_urdf(PANDA, None, None).unwrap().mdh().rows[6].d - 0.2104).abs() <= 1e-15
    );
}

/// An arm of six axes with an origin at joint 2, of a version, and more elements.
fn versioned(version: &str, origin: &str, more: &str) -> String {
    let origins = ["xyz='0 0 0.4'", origin, "xyz='0 0 0.7'", "xyz='0.3 0 0.115'", "xyz='0.45 0 0'"];
    let axes = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"];
    let mut text = format!("<robot name='a' {version}><link name='l0'/>");
    for (i, axis) in axes.into_iter().enumerate() {
        let (child, origin) = (i + 1, origins.get(i).unwrap_or(&"xyz='0.085 0 0'"));
        write!(
            text,
            "<link name='l{child}'/><joint name='j{child}' type='revolute'><parent link='l{i}'/>\
             <child link='l{child}'/><origin {origin}/><axis xyz='{axis}'/>\
             <limit lower='-3' upper='3' acceleration='2'/></joint>"
        )
        .unwrap();
    }
    format!("{text}{more}</robot>")
}

#[test]
fn a_quaternion_of_an_origin_turns_it_from_version_1_1_on() {
    let turned = "xyz='0.1 0 0.1' quat_xyzw='0 0 0.70710678118654757 0.70710678118654757'";
    let rpy = six(&versioned("", "xyz='0.1 0 0.1' rpy='0 0 1.5707963267948966'", ""), None, None);
    let rpy = rpy.unwrap();
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    for version in ["version='1.1'", "version='1.2'"] {
        let read = six(&versioned(version, turned, ""), None, None).unwrap();
        assert!(PoseDifference::between(&read.fk(&q), &rpy.fk(&q)).largest() < 1e-15);
    }
    for version in ["", "version='1.0'"] {
        assert_eq!(
            words(&versioned(version, turned, "")),
            "URDF: joint \"j2\" has the attribute quat_xyzw, which URDF has from version 1.1 on, \
             and the robot is of version 1.0: write <robot version=\"1.1\">"
        );
    }
    let of_1_2 = |origin: &str| words(&versioned("version='1.2'", origin, ""));
    for (origin, wanted) in [
        ("rpy='0 0 1' quat_xyzw='0 0 0 1'", "origin has rpy and quat_xyzw, it must have one"),
        ("quat_xyzw='0 0 1 1'", "origin quat_xyzw has norm 1.414214, it must be 1 to 0.002"),
        ("quat_xyzw='0 0 1'", "origin quat_xyzw is \"0 0 1\", it must be four numbers"),
        ("rpy_deg='0 0 90'", "<origin> has the attribute \"rpy_deg\", which URDF does not have"),
    ] {
        assert!(of_1_2(origin).contains(wanted), "{}", of_1_2(origin));
    }
    let newer = words(&versioned("version='1.3'", "", ""));
    assert_eq!(newer, "URDF: the robot has the version \"1.3\", it must be 1.0 to 1.2");
}

#[test]
fn a_message_names_the_links_to_pass() {
    let behind = |link: &str, kind: &str| {
        format!(
            "<link name='f{link}{kind}'/><joint name='{link}{kind}' type='{kind}'><parent \
             link='{link}'/><child link='f{link}{kind}'/><limit lower='0' upper='1'/></joint>"
        )
    };
    let fingers = behind("l6", "prismatic") + &behind("l5", "prismatic");
    assert!(words(&versioned("", "", &fingers)).ends_with("; pass tip=\"l6\" (6 joints)"));
    let tip = six(&versioned("", "", &fingers), None, Some("fl6prismatic"));
    assert!(refused(tip).ends_with("; pass tip=\"l6\" (6 joints)"));
    let gantry = "<link name='w'/><link name='v'/><joint name='x' type='prismatic'><parent link='w'/>\
                  <child link='v'/></joint><joint name='y' type='prismatic'><parent link='v'/>\
                  <child link='l0'/></joint>";
    let carried = words(&versioned("", "", gantry));
    assert!(carried.ends_with("; pass base=\"l0\" and tip=\"l6\" (6 joints)"), "{carried}");
    let eight = behind("l6", "revolute") + &behind("fl6revolute", "revolute");
    let longer = words(&versioned("", "", &eight));
    let wanted = "; pass tip=\"l6\" (6 joints) or base=\"l2\" and tip=\"ffl6revoluterevolute\" \
                  (6 joints)";
    assert!(longer.ends_with(wanted), "{longer}");
}

#[test]
fn a_tip_is_never_guessed() {
    assert_eq!(
        words(&UR5E.replace("tool0", "camera")),
        "URDF: 6 revolute joints lead from \"base_link\" to several ends: \"ft_frame\" (6), \
         \"camera\" (6); tip must name the one to take"
    );
    assert_eq!(
        words(SEVEN),
        "URDF: 6 revolute joints lead from \"link_0\" to no end of a chain: \"link_ee\" (7)"
    );
    let ends = "\"panda_hand_tcp\" (7), \"panda_leftfinger\" (behind joint \
        \"panda_finger_joint1\", prismatic), \"panda_rightfinger\" (behind \
                joint \"panda_finger_joint2\", prismatic)";
    assert_eq!(
        words(PANDA),
        format!("URDF: 6 revolute joints lead from \"panda_link0\" to no end of a chain: {ends}")
    );
}

/// Only where all ends are fixed to the last link: anything else is a question.
#[test]
fn a_tool_frame_is_the_tip_among_frames_of_one_link() {
    assert_eq!(six(UR5E, None, None), six(UR5E, None, Some("tool0")));
    for name in ["tcp", "flange", "grasp"] {
        let named = UR5E.replace("flange", "mount").replace("tool0", name);
        assert_eq!(six(&named, None, None), six(&named, None, Some(name)));
    }
    let fixed = |link: &str, child: &str| {
        format!(
            "<link name='{child}'/><joint name='{child}_joint' type='fixed'>\
             <parent link='{link}'/><child link='{child}'/></joint>"
        )
    };
    let tool = fixed("l6", "flange") + &fixed("flange", "tool0");
    let frames = versioned("", "", &(tool.clone() + &fixed("l6", "camera")));
    assert_eq!(six(&frames, None, None), six(&frames, None, Some("tool0")));
    let jaw = "<link name='jaw'/><joint name='j7' type='revolute'><parent link='l6'/>\
               <child link='jaw'/><limit lower='0' upper='1'/></joint>";
    let any = |more: &str| irbkin_motion::AnyArm::from_urdf(&versioned("", "", more), None, None);
    for more in [jaw.to_owned() + &tool, fixed("l5", "camera") + &tool + &fixed("l6", "a")] {
        let asked = any(&more).unwrap_err().to_string();
        assert!(asked.contains("\"tool0\" (6)"), "{asked}");
        assert!(asked.contains("1 of a gripper") || asked.contains("\"camera\" (5)"), "{asked}");
        assert!(asked.contains("tip must name"), "{asked}");
    }
}

#[test]
fn joints_have_the_names_of_the_file() {
    let names = |robot: &Robot<6>| robot.joint_names().map(<[String]>::to_vec);
    let robot = six(UR5E, None, None).unwrap();
    let wanted = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
    assert_eq!(names(&robot).unwrap(), wanted.map(|name| format!("{name}_joint")));
    let tool = irbkin::pose::from_euler_zyx([0.0, 0.0, 0.1], [0.0; 3]).unwrap();
    let mut corrections = irbkin::Corrections::NONE;
    corrections.rows[1][0] = 1e-4;
    for other in [
        robot.clone().map(|robot| Ok(robot.with_tool(&tool)?.with_name("own"))).unwrap(),
        robot.with_corrections(&corrections).unwrap(),
    ] {
        assert_eq!(names(&other), names(&robot));
    }
    assert_eq!(names(&Robot::named("UR5e").unwrap()), None);
}

#[test]
fn base_and_tip_must_be_links_one_below_the_other() {
    let of = |base, tip| refused(six(UR5E, base, tip));
    assert_eq!(
        of(Some("tool0"), Some("base")),
        "URDF: tip \"base\" is not below base \"tool0\": no joints lead from base to tip"
    );
    assert_eq!(
        of(None, Some("base_link")),
        "URDF: 0 revolute joints lead from \"base_link\" to \"base_link\", there must be 6 \
         (choose base and tip)"
    );
    let all = "\"base_link\", \"base\", \"base_link_inertia\", \"shoulder_link\", \
        \"upper_arm_link\", \"forearm_link\", \"wrist_1_link\", \
               \"wrist_2_link\", \"wrist_3_link\", \"ft_frame\", \"flange\", \"tool0\"";
    assert_eq!(
        of(None, Some("tool")),
        format!("URDF: tip \"tool\" is not a link; there are {all}")
    );
    let many = UR5E.replace("</robot>", "<link name=\"a\"/></robot>");
    assert_eq!(
        refused(six(&many, Some("wrist"), None)),
        "URDF: base \"wrist\" is not a link; there are \"wrist_1_link\", \"wrist_2_link\", \"wrist_3_link\""
    );
    assert_eq!(
        refused(six(&many, Some("zz"), None)),
        "URDF: base \"zz\" is not a link, and no link has a name close to it"
    );
    assert_eq!(
        words(&many),
        "URDF: several links have no parent: \"base_link\", \"a\"; base must name the one to \
         begin at"
    );
    assert!(six(&many, Some("base_link"), Some("tool0")).is_ok());
}

#[test]
fn invalid_urdf_is_reported_with_its_line() {
    for (text, reason) in [
        ("", "line 1, column 1 is not XML: the text ends before the robot does"),
        ("arm.urdf", "line 1, column 1 is not XML: unknown token"),
        (
            "<robot>\n <link name='a'/>",
            "line 2, column 18 is not XML: the text ends before the robot does",
        ),
        (
            "<robot>\n <link name='a'>\n</robot>",
            "line 3, column 1 is not XML: expected 'link' tag, not 'robot'",
        ),
        (
            "\n\n<robot>\n <link name='a' name='b'/>",
            "line 4, column 17 is not XML: attribute 'name' is already defined",
        ),
        (
            "<!DOCTYPE r [<!ENTITY a 'b'>]><robot/>",
            "line 1, column 1 is not XML: it has a document type, which is not read",
        ),
        (
            "<sdf version='1.6'/>",
            "the first element is <sdf>, it must be <robot>: convert the file to URDF, or take the \
             one that it was made of: irbkin knows no converter",
        ),
        (
            "<mujoco/>",
            "the first element is <mujoco>, it must be <robot>: convert the file to URDF \
             (in Python Robot.from_mjcf reads it)",
        ),
        ("<a/>", "the first element is <a>, it must be <robot>: convert the file to URDF"),
        ("<robot name='a'/>", "the robot has no links"),
        ("<robot>\n<link/></robot>", "line 2: <link> has no name"),
        ("<robot><joint/></robot>", "line 1: <joint> has no name"),
        (
            "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'>\n\n<link name='a'><xacro:box/>\
             </link></robot>",
            "line 3 is xacro, <xacro:box>: it must be expanded first (xacro arm.urdf.xacro > \
             arm.urdf; in Python Robot.from_urdf takes a .xacro file)",
        ),
        (
            "<robot>\n<xacro:arm/></robot>",
            "line 2 is xacro, <xacro:...>: it must be expanded first (xacro arm.urdf.xacro > \
             arm.urdf; in Python Robot.from_urdf takes a .xacro file)",
        ),
    ] {
        assert_eq!(words(text), format!("URDF: {reason}"));
    }
}

#[test]
fn blanks_or_a_byte_order_mark_before_the_text_do_not_matter() {
    for before in ["\n  ", "\u{feff}", "\u{feff}\r\n\t"] {
        assert!(six(&format!("{before}{IRB2600}"), None, None).is_ok(), "{before:?}");
    }
}

#[test]
fn links_and_joints_must_form_a_tree() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='fixed'><parent link='{parent}'/><child link='{child}'/>\
             </joint>"
        )
    };
    let fixed = |inside: &str| format!("<joint name='j' type='fixed'>{inside}</joint>");
    for (inside, reason) in [
        (
            "<link name='b'/>".to_owned(),
            "two links are named \"b\", each must have a name of its own",
        ),
        (
            joint("j", "a", "b") + &joint("j", "b", "c"),
            "two joints are named \"j\", each must have a name of its own",
        ),
        (joint("j", "a", "x"), "joint \"j\" has the child \"x\", which is not a link"),
        (joint("j", "y", "a"), "joint \"j\" has the parent \"y\", which is not a link"),
        (
            joint("i", "a", "c") + &joint("j", "b", "c"),
            "link \"c\" is the child of joints \"i\" and \"j\", it must be the child of one",
        ),
        (
            joint("i", "a", "b") + &joint("j", "b", "c") + &joint("k", "c", "a"),
            "the links \"b\", \"c\", \"a\" form a loop, they must form a tree",
        ),
        (
            joint("i", "b", "c") + &joint("j", "c", "b"),
            "the links \"b\", \"c\" form a loop, they must form a tree",
        ),
        (joint("j", "a", "a"), "the links \"a\" form a loop, they must form a tree"),
        ("<joint name='j'/>".to_owned(), "line 1: <joint> has no type"),
        (fixed("<child link='a'/>"), "line 1: <joint> has no <parent link=\"...\">"),
        (fixed("<parent link='a'/><child/>"), "line 1: <joint> has no <child link=\"...\">"),
        (
            fixed("<parent link='a'/><parent link='b'/><child link='c'/>"),
            "joint \"j\" has two <parent>, it must have at most one",
        ),
    ] {
        let links = "<link name='a'/><link name='b'/><link name='c'/>";
        let text = format!("<robot name='r'>{links}{inside}</robot>");
        assert_eq!(words(&text), format!("URDF: {reason}"));
    }
}

const SLIDING: &str = "; one joint may slide, before all others (a rail, a lift), but SCARA, \
                       telescopes and gantries have no inverse here";

/// The IRB 2600 on a rail of other limits, between fixed joints.
fn railed(limit: &str) -> String {
    let rail = format!(
        "<link name='floor'/><joint name='stand' type='fixed'><parent link='floor'/>\
         <child link='beam'/><origin xyz='1 2 3' rpy='0 0 0.5'/></joint><link name='beam'/>\
         <joint name='rail' type='prismatic'><parent link='beam'/><child link='slide'/>\
         <origin xyz='0 0 0.5' rpy='0 0.3 0'/><axis xyz='0 2 1'/>{limit}</joint>\
         <link name='slide'/><joint name='mount' type='fixed'><parent link='slide'/>\
         <child link='base_link'/><origin xyz='0 0 0.1'/></joint></robot>"
    );
    IRB2600.replace("</robot>", &rail)
}

#[test]
fn a_rail_carries_the_base() {
    let bare = six(IRB2600, None, None).unwrap();
    let way = Vector3::new(0.0, 2.0, 1.0) / 5.0_f64.sqrt();
    let stand = Pose::from_parts(Vector3::new(1.0, 2.0, 3.0).into(), turn(Vector3::z(), 0.5));
    let beam = Pose::from_parts(Vector3::new(0.0, 0.0, 0.5).into(), turn(Vector3::y(), 0.3));
    let mount = Pose::translation(0.0, 0.0, 0.1);
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    for (limits, first) in [([-0.5, 2.5], 0.0), ([0.5, 2.0], 0.5), ([-2.0, -1.0], -1.0)] {
        let [lower, upper] = limits;
        let limit = format!("<limit lower='{lower}' upper='{upper}' velocity='1.5'/>");
        let arm = Arm::<6>::from_urdf(&railed(&limit), None, None).unwrap();
        let places =
            [arm.clone(), arm.at(lower).unwrap(), arm.at(upper).unwrap().at(lower).unwrap()];
        for (arm, position) in places.iter().zip([first, lower, lower]) {
            let base =
                stand * beam * Pose::from_parts((way * position).into(), Rotation3::identity());
            let off = PoseDifference::between(&arm.fk(&q), &(base * mount * bare.fk(&q)));
            assert!(off.largest() < 4e-15, "{off:?}");
        }
        let carrier = arm.carrier().unwrap();
        assert_eq!((carrier.range(), carrier.max_velocity()), (limits, 1.5));
        let off = Vector3::from(carrier.direction()) - (stand * beam).rotation * way;
        assert!(off.norm() < 1e-15, "{off}");
        for outside in [lower - 1e-6, upper + 1e-6, f64::NAN, f64::INFINITY] {
            let error = arm.at(outside).unwrap_err();
            assert!(matches!(error, Error::InvalidPlan(_)), "{error}");
        }
    }
    assert_eq!(bare.carrier(), None);
    assert!(bare.at(0.0).unwrap_err().to_string().contains("with_base"));
    // A velocity that is not known is a track's.
    let slow = six(&railed("<limit lower='0' upper='1' velocity='0'/>"), None, None).unwrap();
    assert!((slow.carrier().unwrap().max_velocity() - 1.0).abs() < f64::EPSILON);
}

/// What it carries moves with it; what is before it is no part of the arm.
#[test]
fn a_rail_is_no_part_of_the_body() {
    let shape = |size: f64| {
        format!("<collision><geometry><sphere radius='{size}'/></geometry></collision></link>")
    };
    let text = railed("<limit lower='0' upper='1'/>")
        .replace("<link name='beam'/>", &format!("<link name='beam'>{}", shape(0.9)))
        .replace("<link name='slide'/>", &format!("<link name='slide'>{}", shape(0.2)));
    let arm = Arm::<6>::from_urdf(&text, None, None).unwrap();
    let body = arm.at(0.7).unwrap().body().cloned().unwrap();
    assert_eq!(Some(&body), arm.body());
    let balls: Vec<_> = body.capsules().iter().filter(|it| it.capsule.is_sphere()).collect();
    assert_eq!((balls.len(), balls[0].link), (1, 0));
    assert!((balls[0].capsule.radius() - 0.2).abs() < 1e-12);
    assert!(Vector3::from(balls[0].capsule.ends()[0]).norm() < 1e-12);
}

#[test]
fn a_rail_needs_limits_and_is_the_first_joint() {
    for (limit, range) in [
        ("", "-inf to inf"),
        ("<limit/>", "0 to 0"),
        ("<limit lower='2' upper='1'/>", "2 to 1"),
        ("<limit lower='0' upper='1001'/>", "0 to 1001"),
        ("<limit lower='0' upper='1e9'/>", "0 to inf"),
    ] {
        let text = words(&railed(limit));
        assert!(
            text.starts_with(&format!("URDF: joint \"rail\" slides from {range} m ")),
            "{text}"
        );
        assert!(text.contains("write <limit lower=\"0\" upper=\"2.5\" .../>"), "{text}");
    }
    let limited = railed("<limit lower='0' upper='1'/>");
    let two = limited.replace("name='mount' type='fixed'", "name='mount' type='prismatic'");
    let ends = words(&two);
    assert!(ends.contains("\"tool0\" (behind joint \"mount\", prismatic)"), "{ends}");
    assert!(ends.contains(SLIDING), "{ends}");
    let upper = two.replace("<origin xyz='0 0 0.1'/>", "<mimic joint='rail'/>");
    let upper = upper.replace("name='rail' type='prismatic'", "name='rail' type='fixed'");
    let mimic = refused(six(&upper, None, Some("tool0")));
    assert!(mimic.starts_with("URDF: joint \"mount\" mimics \"rail\""), "{mimic}");
    let zero = limited.replace("<axis xyz='0 2 1'/>", "<axis xyz='0 0 0'/>");
    assert_eq!(words(&zero), "URDF: joint \"rail\" axis is 0 0 0, it must have a length");
    // The carriage as the base leaves the rail out.
    let carriage = six(&limited, Some("slide"), None).unwrap();
    assert_eq!((carriage.carrier(), *carriage.base()), (None, Pose::identity()));
}

/// The IRB 2600 with a part of its third joint's text changed.
fn third(from: &str, to: &str) -> String {
    let at = IRB2600.find("name=\"joint_3\"").unwrap();
    let (before, after) = IRB2600.split_at(at);
    assert!(after.contains(from));
    format!("{before}{}", after.replacen(from, to, 1))
}

#[test]
fn only_independent_revolute_joints_may_be_between_base_and_tip() {
    let tool = |text: &str| refused(six(text, None, Some("tool0")));
    for kind in ["prismatic", "planar", "floating", "revolut", "Revolute", ""] {
        let wanted = format!(
            "URDF: joint \"joint_3\" is {kind:?}, between base and tip it must be revolute, \
             continuous or fixed (choose base and tip beside it){}",
            if kind == "prismatic" { SLIDING } else { "" }
        );
        assert_eq!(tool(&third("revolute", kind)), wanted);
    }
    let mimic = third("<axis", "<mimic joint=\"joint_2\"/><axis");
    assert_eq!(
        tool(&mimic),
        "URDF: joint \"joint_3\" mimics \"joint_2\" with multiplier 1, between base and tip each \
         joint must turn by itself, except a linkage: it takes joint 2 back on the axis of joint \
         3, with multiplier -1, or 1 about the reverse axis (make the joint fixed or choose base \
         and tip beside it; snap makes angles with few digits exact)"
    );
    let ends = "URDF: 6 revolute joints lead from \"base_link\" to no end of a chain: \"base\" (0)";
    let behind = format!("{ends}, \"tool0\" (behind joint \"joint_3\", ");
    assert_eq!(words(&mimic), format!("{ends}, \"tool0\" (5, and a mimic)"));
    let doubled = third("<axis", "<mimic joint=\"joint_2\" multiplier=\"2\"/><axis");
    assert_eq!(words(&doubled), format!("{behind}a mimic)"));
    assert_eq!(words(&third("revolute", "prismatic")), format!("{behind}prismatic){SLIDING}"));
    let fixed = third("revolute", "fixed");
    assert_eq!(
        tool(&fixed),
        "URDF: 5 revolute joints lead from \"base_link\" to \"tool0\", there must be 6 (choose \
         base and tip); 5 are not enough, since a pose has six coordinates"
    );
    assert_eq!(
        words(&fixed),
        format!("{ends}, \"tool0\" (5); 5 are not enough, since a pose has six coordinates")
    );
    // What is not between them does not matter.
    let aside = IRB2600.replace(
        "name=\"base_link-base\" type=\"fixed\"",
        "name=\"base_link-base\" type=\"floating\"",
    );
    assert!(six(&aside, None, None).is_ok());
}

#[test]
fn numbers_are_named_with_their_joint() {
    let xyz = "xyz=\"0 0 0.7\"";
    for (from, to, reason) in [
        (xyz, "xyz=\"0 0\"", "origin xyz is \"0 0\", it must be three numbers"),
        (xyz, "xyz=\"0 0 0.7 1\"", "origin xyz is \"0 0 0.7 1\", it must be three numbers"),
        (xyz, "xyz=\"0 0 0,7\"", "origin xyz is \"0 0 0,7\", it must be three numbers"),
        (
            xyz,
            "xyz=\"0 0 ${a}\"",
            "origin xyz is \"0 0 ${a}\", it must be three numbers (is it xacro that was not \
             expanded?)",
        ),
        (xyz, "xyz=\"0 0 nan\"", "origin xyz is NaN, it must be finite"),
        (xyz, "xyz=\"0 0 1e999\"", "origin xyz is inf, it must be finite"),
        (xyz, "xyz=\"0 0 1e7\"", "origin xyz is 1e7, its size must be at most 1e6"),
        (xyz, "rpy=\"0 0 1e9\"", "origin rpy is 1e9, its size must be at most 1e5"),
        ("xyz=\"0 1 0\"", "xyz=\"0 0 0\"", "axis is 0 0 0, it must have a length"),
        ("xyz=\"0 1 0\"", "xyz=\"0 inf 0\"", "axis is inf, it must be finite"),
        (
            "lower=\"-3",
            "lower=\"x-3",
            "limit lower is \"x-3.141592653589793\", it must be a number",
        ),
        (
            "<limit",
            "<limits",
            "is revolute and has no <limit>; a joint without limits is continuous",
        ),
        ("<axis", "<axis/><axis", "has two <axis>, it must have at most one"),
    ] {
        assert_eq!(words(&third(from, to)), format!("URDF: joint \"joint_3\" {reason}"));
    }
    assert_eq!(
        words(&third("lower=\"-", "lower=\"9")),
        "joint 3 limit is empty: lower 93.1415926535898 rad > upper 1.3089969389957472 rad"
    );
}

#[test]
fn absent_numbers_have_the_values_of_the_format() {
    // Axis 1 0 0, origin at rest.
    let robot = six(&third("<axis xyz=\"0 1 0\"/>", ""), None, None).unwrap();
    let along_x =
        six(&third("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"1 0 0\"/>"), None, None).unwrap();
    assert_eq!(robot, along_x);
    assert_eq!(
        six(&third("<origin xyz=\"0 0 0.7\"/>", ""), None, None),
        six(&third("xyz=\"0 0 0.7\"", ""), None, None)
    );
    assert_eq!(
        six(&third("xyz=\"0 0 0.7\"", "xyz=\" \t0\n0  .7 \""), None, None),
        six(IRB2600, None, None)
    );
}

#[test]
fn an_arm_without_a_closed_form_is_reported_and_solved() {
    let bent = third("xyz=\"0 1 0\"", "xyz=\"0 1 0.1\"");
    let robot = Arm::<6>::from_urdf(&bent, None, None).unwrap();
    assert!(robot.missing_form().is_some());
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let solutions = robot.ik(&robot.fk(&q)).unwrap();
    assert!(solutions.iter().any(|found| crate::common::apart(&found.q, &q) < 1e-9));
}

/// A chain of fixed joints with an arm's six joints at its end, or links side by side.
fn long(links: usize, parent: impl Fn(usize) -> usize) -> String {
    let mut text = String::from("<robot name='long'><link name='l0'/>");
    for i in 1..=links {
        let kind = if i + 6 > links { "continuous" } else { "fixed" };
        let parent = parent(i);
        write!(
            text,
            "<link name='l{i}'/><joint name='j{i}' type='{kind}'><parent \
            link='l{parent}'/><child link='l{i}'/>"
        )
        .unwrap();
        write!(text, "<origin xyz='0.1 0 0' rpy='1e-5 0 {}'/></joint>", i % 3).unwrap();
    }
    text + "</robot>"
}

#[test]
fn a_hundred_thousand_links_are_read() {
    let deep = six(&long(100_000, |i| i - 1), None, None).unwrap();
    assert!(deep.fk(&[0.1; 6]).translation.vector.norm() > 0.0);
    let message = words(&long(100_000, |_| 0));
    assert!(message.ends_with("\"l12\" (0) and 99988 more"), "{message}");
    // A spine with a rib on each vertebra: every rib is an end.
    let message = words(&long(100_000, |i| if i % 2 == 0 { i - 1 } else { i.saturating_sub(2) }));
    assert!(
        message.starts_with("URDF: 6 revolute joints lead from \"l0\" to no end of a chain: "),
        "{message}"
    );
    let mut ring = long(100_000, |i| i - 1);
    ring.insert_str(
        ring.len() - 8,
        "<joint name='j' type='fixed'><parent link='l100000'/><child link='l0'/></joint>",
    );
    assert!(words(&ring).ends_with("and 99989 more form a loop, they must form a tree"));
}

#[test]
fn hostile_text_is_refused_without_a_panic() {
    let nested = "<robot><link name='a'>".to_owned()
        + &"<x>".repeat(200_000)
        + &"</x>".repeat(200_000)
        + "</link></robot>";
    assert_eq!(
        words(&nested),
        "URDF: 6 revolute joints lead from \"a\" to no end of a chain: \"a\" (0)"
    );
    words(&"<x>".repeat(500_000));
    let mut bomb = String::from("<!DOCTYPE r [<!ENTITY e0 'lol'>");
    for i in 1..10 {
        write!(bomb, "<!ENTITY e{i} '{}'>", format!("&e{};", i - 1).repeat(10)).unwrap();
    }
    bomb += "]><robot name='&e9;'/>";
    assert_eq!(
        words(&bomb),
        "URDF: line 1, column 1 is not XML: it has a document type, which is not read"
    );
    assert_eq!(
        words("<robot name='&lol;'/>"),
        "URDF: line 1, column 14 is not XML: unknown entity reference 'lol'"
    );
    let huge = format!("xyz=\"0 0 {}\"", "9".repeat(400));
    assert_eq!(
        words(&third("xyz=\"0 0 0.7\"", &huge)),
        "URDF: joint \"joint_3\" origin xyz is inf, it must be finite"
    );
    let endless = format!("xyz=\"{}\"", "x".repeat(1_000_000));
    assert!(words(&third("xyz=\"0 0 0.7\"", &endless)).len() < 200);
    assert!(words("<robot><link name='a&#10;\u{1b}[31m'/></robot>").contains("is not XML"));
    for end in 0..IRB2600.len() {
        assert!(six(&IRB2600[..end], None, None).is_err() || IRB2600[end..].trim().is_empty());
    }
}

#[test]
fn damaged_text_never_panics() {
    let mut rng = Rng::new(3);
    let mut below = |bound: usize| (rng.unit() * f64::from(u32::try_from(bound).unwrap())) as usize;
    let pieces = [
        "<",
        ">",
        "\"",
        "/",
        "0",
        "-",
        "e9",
        ".",
        " ",
        "nan",
        "&",
        "<joint",
        "link=",
        "\u{0}",
        "é",
        "<axis/>",
        "base_link",
    ];
    let mut taken = 0;
    for _ in 0..5000 {
        let mut text = IRB2600.to_owned();
        for _ in 0..=below(4) {
            let (at, piece) = (below(text.len()), pieces[below(pieces.len())]);
            let end = (at + below(12)).min(text.len());
            if text.is_char_boundary(at) && text.is_char_boundary(end) {
                text.replace_range(at..end, piece);
            }
        }
        match six(&text, None, None) {
            Ok(robot) => {
                taken += usize::from(robot.fk(&[0.1; 6]).translation.vector.norm().is_finite());
            }
            Err(error) => assert!(is_of_model(&error), "{error}"),
        }
    }
    // A name, a comment or a digit can be changed without harm.
    assert!((100..4900).contains(&taken), "{taken}");
}

#[test]
fn nearly_parallel_axes_are_distinguished_from_parallel_ones() {
    // Nine decimals: 2e-10 off, taken as parallel; seven are within the rounding of their text. Cut
    // off after seven, they are not: 5e-8 off, the common normal is too far away. One: two axes like
    // any other.
    let of = |roll: &str| {
        six(
            &third(
                "<origin xyz=\"0 0 0.7\"/>",
                &format!("<origin xyz=\"0.1 0.02 0.7\" rpy=\"{roll} 0 0\"/>"),
            ),
            None,
            None,
        )
    };
    assert_eq!(of("3.141592654").unwrap().mdh().rows[2].alpha, PI);
    assert_eq!(of("3.1415927").unwrap().mdh().rows[2].alpha, PI);
    assert_eq!(
        refused(of("3.1415926")),
        "axes 2 and 3 are 5.4e-8 rad off parallel, their common normal is 1.3e7 m away, it must be at most 1e6 m (write the angles with all their digits); snap=1e-7 would take it"
    );
    assert!((of("3.1").unwrap().mdh().rows[2].alpha.abs() - 3.1).abs() < 1e-12);
}

/// A joint on a link, and the link behind it.
fn behind(parent: &str, child: &str, joint: &str, more: &str) -> String {
    format!(
        "<link name='{child}'/><joint name='{joint}' type='revolute'><parent link='{parent}'/>\
         <child link='{child}'/><origin xyz='0.05 0.02 0.1'/><axis xyz='0 0 1'/>\
         <limit lower='-3' upper='3'/>{more}</joint>"
    )
}

/// An arm of so many axes, and more elements.
fn axes(count: usize, more: &str) -> String {
    let joints = (1..=count).map(|i| {
        let joint = behind(&format!("l{}", i - 1), &format!("l{i}"), &format!("j{i}"), "");
        joint.replace("0 0 1", ["1 0 0", "0 0 1", "0 1 0"][i % 3])
    });
    let joints: String = joints.collect();
    format!("<robot name='a'><link name='l0'/>{joints}{more}</robot>")
}

fn any(text: &str) -> Result<irbkin_motion::AnyArm, String> {
    irbkin_motion::AnyArm::from_urdf(text, None, None).map_err(|error| error.to_string())
}

#[test]
fn no_door_offers_a_grippers_joint_as_an_axis() {
    let follow = |of: &str| format!("<mimic joint='{of}' multiplier='-1'/>");
    let jaws = |left: &str, right: &str| {
        behind("l5", "left", left, "") + &behind("l5", "right", right, "")
    };
    let mimic = behind("l5", "gear", "servo", "") + &behind("gear", "tip", "t", &follow("servo"));
    // Five axes: one end, several, and none.
    for (more, joint) in [
        (behind("l5", "gear", "gripper", ""), "gripper"),
        (jaws("gripper_left", "gripper_right"), "gripper_left"),
        (jaws("servo_1", "servo_2"), "servo_1"),
        (mimic, "servo"),
        (behind("l5", "a", "thumb_yaw", "") + &behind("a", "b", "thumb_pitch", ""), "thumb_yaw"),
    ] {
        let error = any(&axes(5, &more)).unwrap_err();
        assert!(
            error.contains(&format!("behind joint \"{joint}\", which may be a gripper's")),
            "{error}"
        );
        let end = "; 5 axes and a gripper; pass tip=\"l5\" (5 joints)";
        assert!(error.ends_with(end), "{error}");
    }
    // Six: the arm's own end alone is offered.
    let pass = "; pass tip=\"l6\" (6 joints)";
    for name in ["left_knuckle", "thumb", "Proximal", "distal", "drive_joint", "palm", "Jaw"] {
        let hand = behind("l6", "hand", name, "");
        let error = any(&axes(6, &hand)).unwrap_err();
        assert!(error.ends_with(&format!("; 6 axes and a gripper{pass}")), "{error}");
        let frame = "<link name='tcp'/><joint name='f' type='fixed'><parent link='l6'/><child \
                     link='tcp'/></joint>";
        let error = any(&axes(6, &(hand + frame))).unwrap_err();
        let wanted = "to several ends: \"tcp\" (6), 1 of a gripper; tip must name the one to take";
        assert!(error.ends_with(wanted), "{error}");
    }
    let finger = |i: usize| {
        let [one, two] = [format!("k{i}"), format!("m{i}")];
        behind("l6", &one, &one, "") + &behind(&one, &two, &two, "")
    };
    let error = any(&axes(6, &(finger(1) + &finger(2)))).unwrap_err();
    assert!(error.ends_with(pass), "{error}");
}

#[test]
fn wrists_that_carry_a_gripper_are_axes() {
    for name in ["palm_yaw_joint", "gripper_roll", "wrist_3_joint", "joint_7"] {
        assert!(any(&axes(6, &behind("l6", "gripper_base", name, ""))).is_ok(), "{name}");
    }
    // A joint inside the wrist that others follow, and two arms on one body.
    let rod = behind("l4", "rod", "rod", "<mimic joint='j5' multiplier='0.5'/>");
    assert!(any(&axes(6, &rod)).is_ok());
}

#[test]
fn a_chain_that_is_refused_is_named() {
    let parallel = axes(6, "").replace("1 0 0", "0 0 1").replace("0 1 0", "0 0 1");
    let error = any(&parallel).unwrap_err();
    let wanted = "URDF: the arm from \"l0\" to \"l6\" is refused: no inverse kinematics for this \
                  arm: ";
    assert!(error.starts_with(wanted), "{error}");
}
