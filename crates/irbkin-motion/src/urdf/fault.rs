//! URDF texts that are refused.

use crate::prelude::*;
use thiserror::Error;

use irbkin::internal::{Listed, ModelFault, Names};

/// Why a URDF is refused. Lines and columns count from 1.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum UrdfFault {
    /// `fault`: why the arm between two links is refused.
    #[error("the arm from {base:?} to {tip:?} is refused: {fault}")]
    Chain { base: String, tip: String, fault: Box<ModelFault> },
    #[error("byte {byte} is not valid UTF-8")]
    NotUtf8 { byte: usize },
    /// `what`: the parser's words.
    #[error("line {line}, column {column} is not XML: {what}")]
    NotXml { line: usize, column: usize, what: String },
    /// More could not be read in linear time.
    #[error("line {line} declares one namespace (xmlns) too many: at most {bound} are read")]
    Namespaces { line: usize, bound: usize },
    /// More could not be read in linear time.
    #[error("line {line}: <{element}> has too many attributes: at most {bound} are read")]
    Attributes { line: usize, element: String, bound: usize },
    #[error(
        "the first element is <{found}>, it must be <robot>: convert the file to URDF{}",
        match &**.found {
            "mujoco" => " (in Python Robot.from_mjcf reads it)",
            "sdf" => ", or take the one that it was made of: irbkin knows no converter",
            _ => "",
        }
    )]
    NotRobot { found: String },
    /// `newest`: the minor number of the newest version that is read.
    #[error("the robot has the version {version:?}, it must be 1.0 to 1.{newest}")]
    Version { version: String, newest: u32 },
    /// `since`, `version`: the minor numbers of the version that has the attribute, and the robot's.
    #[error(
        "joint {joint:?} has the attribute {attribute}, which URDF has from version 1.{since} on, \
         and the robot is of version 1.{version}: write <robot version=\"1.{since}\">"
    )]
    TooNew { joint: String, attribute: &'static str, since: u32, version: u32 },
    #[error(
        "joint {joint:?} <{element}> has the attribute {attribute:?}, which URDF does not have; it \
         has {known}: remove or rename it"
    )]
    Attribute { joint: String, element: &'static str, attribute: String, known: Names },
    #[error("joint {joint:?} origin has rpy and quat_xyzw, it must have one of them")]
    TwoRotations { joint: String },
    #[error("joint {joint:?} origin quat_xyzw has norm {norm:.6}, it must be 1 to {bound}")]
    QuaternionNorm { joint: String, norm: f64, bound: f64 },
    #[error(
        "line {line} is xacro, <{element}>: it must be expanded first (xacro arm.urdf.xacro > \
         arm.urdf; in Python Robot.from_urdf takes a .xacro file)"
    )]
    Xacro { line: usize, element: String },
    #[error("line {line}: <{element}> has no {missing}")]
    Missing { line: usize, element: &'static str, missing: &'static str },
    #[error("two {element}s are named {name:?}, each must have a name of its own")]
    SameName { element: &'static str, name: String },
    #[error("joint {joint:?} has two <{element}>, it must have at most one")]
    Twice { joint: String, element: &'static str },
    /// `role`: "parent" or "child".
    #[error("joint {joint:?} has the {role} {link:?}, which is not a link")]
    UnknownLink { joint: String, role: &'static str, link: String },
    #[error(
        "link {link:?} is the child of joints {:?} and {:?}, it must be the child of one",
        .joints[0], .joints[1]
    )]
    TwoParents { link: String, joints: [String; 2] },
    #[error("the links {links} form a loop, they must form a tree")]
    Loop { links: Names },
    /// The links without a parent.
    #[error("several links have no parent: {links}; base must name the one to begin at")]
    Roots { links: Names },
    #[error("the robot has no links")]
    NoLinks,
    /// `field`: "base" or "tip". `links`: all, or those with names that are close.
    #[error(
        "{field} {name:?} is not a link{}",
        if .links.is_empty() {
            String::from(", and no link has a name close to it")
        } else {
            format!("; there are {links}")
        }
    )]
    NoSuchLink { field: &'static str, name: String, links: Names },
    #[error("tip {tip:?} is not below base {base:?}: no joints lead from base to tip")]
    NotBelow { tip: String, base: String },
    /// `tips`: each with its number of revolute joints.
    #[error(
        "{} revolute joints lead from {base:?} to several ends: {tips}; tip must name the one to \
         take",
        Listed(.wanted, " or ")
    )]
    SeveralTips { base: String, wanted: Vec<usize>, tips: Names },
    /// `ends`: those behind the joint and before it, each with its number of revolute joints.
    #[error(
        "joint {joint:?} may be a gripper's: revolute joints lead from {base:?} to {ends}; tip must \
         name the end of the arm"
    )]
    MayBeGripper { base: String, joint: String, ends: Names },
    /// The ends of chains, each with the reason why it is not the tip. `most`: joints of the longest,
    /// before a gripper's if it `grips`.
    #[error(
        "{} revolute joints lead from {base:?} to no end of a chain: {ends}{}{}",
        Listed(.wanted, " or "),
        if *.grips { format!("; {most} axes and a gripper") } else { String::new() },
        too_few(*.most, .wanted)
    )]
    NoTip { base: String, wanted: Vec<usize>, ends: Names, most: usize, grips: bool },
    #[error("{fault}{SLIDING}")]
    Sliding { fault: Box<Self> },
    /// `chains`: the bases and tips of chains that could be taken.
    #[error("{fault}; pass {}", Listed(.chains, " or "))]
    Proposing { fault: Box<Self>, chains: Vec<String> },
    #[error(
        "joint {joint:?} is {kind:?}, between base and tip it must be revolute, continuous or \
         fixed (choose base and tip beside it){}",
        if .kind == "prismatic" { SLIDING } else { "" }
    )]
    JointType { joint: String, kind: String },
    #[error(
        "joint {joint:?} slides from {lower} to {upper} m before the arm, it must have a range, \
         within 1000 m of zero: write <limit lower=\"0\" upper=\"2.5\" .../>, in MJCF \
         range=\"0 2.5\", or make it fixed"
    )]
    Rail { joint: String, lower: f64, upper: f64 },
    #[error(
        "joint {joint:?} mimics {of:?} with multiplier {multiplier}, between base and tip each \
         joint must turn by itself, except a linkage: it takes joint 2 back on the axis of joint \
         3, with multiplier -1, or 1 about the reverse axis (make the joint fixed or choose base \
         and tip beside it; snap makes angles with few digits exact)"
    )]
    Mimic { joint: String, of: String, multiplier: String },
    #[error(
        "{found} revolute joints lead from {base:?} to {tip:?}, there must be {} (choose base and \
         tip){}",
        Listed(.wanted, " or "), too_few(*.found, .wanted)
    )]
    JointCount { base: String, tip: String, found: usize, wanted: Vec<usize> },
    #[error("joint {joint:?} is revolute and has no <limit>; a joint without limits is continuous")]
    NoLimit { joint: String },
    /// `field`: element and attribute. `wanted`: one, three or four numbers.
    #[error(
        "joint {joint:?} {field} is {text:?}, it must be {}{}",
        match *.wanted { 1 => "a number", 3 => "three numbers", _ => "four numbers" },
        if .text.contains('$') { " (is it xacro that was not expanded?)" } else { "" }
    )]
    NotNumbers { joint: String, field: &'static str, text: String, wanted: usize },
    #[error("joint {joint:?} {field} is {value}, it must be finite")]
    NotFinite { joint: String, field: &'static str, value: f64 },
    #[error("joint {joint:?} {field} is {value:e}, its size must be at most {bound:e}")]
    TooLarge { joint: String, field: &'static str, value: f64, bound: f64 },
    #[error("joint {joint:?} axis is 0 0 0, it must have a length")]
    NoAxis { joint: String },
    #[error("link {link:?} collision {what}")]
    Shape { link: String, what: String },
    #[error(
        "link {link:?} has a mesh among its collision shapes, which from_urdf does not read: \
         irbkin.body.Body.fit makes a body of it"
    )]
    MeshOfBody { link: String },
    /// `what`: the type of the joint, and what is wrong with it.
    #[error(
        "link {link:?} hangs beside the arm on joint {joint:?}, which is {what}: a body must \
         contain it wherever it is (give the joint limits, make it fixed, or choose base and tip \
         beside it)"
    )]
    Beside { link: String, joint: String, what: String },
    #[error("the links have more than {bound} collision shapes, or too many that are swept")]
    Shapes { bound: usize },
}

/// Why a joint may not slide.
const SLIDING: &str = "; one joint may slide, before all others (a rail, a lift), but \
                                  SCARA, telescopes and gantries have no inverse here";

/// Why so many joints are not enough, of a number that arms have.
fn too_few(count: usize, wanted: &[usize]) -> String {
    match count {
        3..=5 if !wanted.contains(&count) => {
            format!("; {count} are not enough, since a pose has six coordinates")
        }
        _ => String::new(),
    }
}
