//! What can be wrong with a URDF.

use core::fmt;

use alloc::string::String;
use alloc::vec::Vec;

use super::names::Counts;
pub use super::names::Names;

/// What is wrong with a URDF.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum UrdfFault {
    /// The bytes are no UTF-8.
    NotUtf8 {
        /// Index of the first byte that is none.
        byte: usize,
    },
    /// The text is no XML.
    NotXml {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the parser says.
        what: String,
    },
    /// The text declares more namespaces than can be read in linear time.
    Namespaces {
        /// Line of the first that is one too many, from 1.
        line: usize,
        /// The most that are read.
        bound: usize,
    },
    /// An element has more attributes than can be read in linear time.
    Attributes {
        /// Line of the element, from 1.
        line: usize,
        /// Name of the element.
        element: String,
        /// The most that are read.
        bound: usize,
    },
    /// The first element is no robot.
    NotRobot {
        /// Name of the first element.
        found: String,
    },
    /// The text is xacro, from which URDF is made.
    Xacro {
        /// Line, from 1.
        line: usize,
        /// Name of the first element that is xacro's.
        element: String,
    },
    /// An element lacks something.
    Missing {
        /// Line of the element, from 1.
        line: usize,
        /// Name of the element.
        element: &'static str,
        /// What it lacks.
        missing: &'static str,
    },
    /// Two links or two joints have the same name.
    SameName {
        /// Name of the element.
        element: &'static str,
        /// The name.
        name: String,
    },
    /// A joint has an element twice.
    Twice {
        /// The joint.
        joint: String,
        /// Name of the element.
        element: &'static str,
    },
    /// A joint is fixed to a link that is not there.
    UnknownLink {
        /// The joint.
        joint: String,
        /// `parent` or `child`.
        role: &'static str,
        /// Name of the link.
        link: String,
    },
    /// A link is the child of two joints.
    TwoParents {
        /// The link.
        link: String,
        /// The joints.
        joints: [String; 2],
    },
    /// Links form a loop.
    Loop {
        /// The links of the loop.
        links: Names,
    },
    /// Not one link is without a parent, but none or several, and `base` does not choose.
    Roots {
        /// The links without a parent.
        links: Names,
    },
    /// `base` or `tip` is no link.
    NoSuchLink {
        /// `base` or `tip`.
        field: &'static str,
        /// The name.
        name: String,
        /// Every link, or those whose names are close.
        links: Names,
    },
    /// The tip does not hang on the base.
    NotBelow {
        /// The tip.
        tip: String,
        /// The base.
        base: String,
    },
    /// Several links could be the tip.
    SeveralTips {
        /// The base.
        base: String,
        /// The number of joints that the arm must have.
        wanted: Vec<usize>,
        /// The links.
        tips: Names,
    },
    /// No link at the end of a chain could be the tip.
    NoTip {
        /// The base.
        base: String,
        /// The number of joints that the arm must have.
        wanted: Vec<usize>,
        /// The links at the end of a chain, and what keeps each from being the tip.
        ends: Names,
    },
    /// A joint between base and tip is neither revolute, continuous nor fixed.
    JointType {
        /// The joint.
        joint: String,
        /// Its type.
        kind: String,
    },
    /// A joint between base and tip follows another one.
    Mimic {
        /// The joint.
        joint: String,
        /// The joint that it follows.
        of: String,
    },
    /// The arm has another number of joints.
    JointCount {
        /// The base.
        base: String,
        /// The tip.
        tip: String,
        /// Revolute joints between them.
        found: usize,
        /// The number of joints that the arm must have.
        wanted: Vec<usize>,
    },
    /// A revolute joint has no limit.
    NoLimit {
        /// The joint.
        joint: String,
    },
    /// An attribute does not hold its numbers.
    NotNumbers {
        /// The joint.
        joint: String,
        /// Element and attribute.
        field: &'static str,
        /// What the attribute holds.
        text: String,
        /// How many numbers it must hold.
        wanted: usize,
    },
    /// A number is NaN or infinite.
    NotFinite {
        /// The joint.
        joint: String,
        /// Element and attribute.
        field: &'static str,
        /// The number.
        value: f64,
    },
    /// A number is too large to calculate with.
    TooLarge {
        /// The joint.
        joint: String,
        /// Element and attribute.
        field: &'static str,
        /// The number.
        value: f64,
        /// The largest size.
        bound: f64,
    },
    /// The axis of a joint has no length.
    NoAxis {
        /// The joint.
        joint: String,
    },
}

impl fmt::Display for UrdfFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotUtf8 { .. }
            | Self::NotXml { .. }
            | Self::Namespaces { .. }
            | Self::Attributes { .. }
            | Self::NotRobot { .. }
            | Self::Xacro { .. }
            | Self::Missing { .. } => self.fmt_text(f),
            Self::SameName { .. }
            | Self::Twice { .. }
            | Self::UnknownLink { .. }
            | Self::TwoParents { .. }
            | Self::Loop { .. }
            | Self::Roots { .. }
            | Self::NoSuchLink { .. }
            | Self::NotBelow { .. }
            | Self::SeveralTips { .. }
            | Self::NoTip { .. } => self.fmt_tree(f),
            Self::JointType { .. }
            | Self::Mimic { .. }
            | Self::JointCount { .. }
            | Self::NoLimit { .. }
            | Self::NotNumbers { .. }
            | Self::NotFinite { .. }
            | Self::TooLarge { .. }
            | Self::NoAxis { .. } => self.fmt_joint(f),
        }
    }
}

impl UrdfFault {
    /// Of a text, and of an element of it.
    fn fmt_text(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotUtf8 { byte } => write!(f, "byte {byte} is not valid UTF-8"),
            Self::NotXml { line, column, what } => {
                write!(f, "line {line}, column {column} is not XML: {what}")
            }
            Self::Namespaces { line, bound } => {
                write!(
                    f,
                    "line {line} declares one namespace (xmlns) too many: at most {bound} are read"
                )
            }
            Self::Attributes { line, element, bound } => {
                write!(
                    f,
                    "line {line}: <{element}> has too many attributes: at most {bound} are read"
                )
            }
            Self::NotRobot { found } => {
                write!(f, "the first element is <{found}>, it must be <robot>")
            }
            Self::Xacro { line, element } => {
                write!(
                    f,
                    "line {line} is xacro, <{element}>: it must be expanded first \
                     (xacro arm.urdf.xacro > arm.urdf)"
                )
            }
            Self::Missing { line, element, missing } => {
                write!(f, "line {line}: <{element}> has no {missing}")
            }
            _ => Ok(()),
        }
    }

    /// Of links and of how joints connect them.
    fn fmt_tree(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SameName { element, name } => {
                write!(f, "two {element}s are named {name:?}, each must have a name of its own")
            }
            Self::Twice { joint, element } => {
                write!(f, "joint {joint:?} has two <{element}>, it must have at most one")
            }
            Self::UnknownLink { joint, role, link } => {
                write!(f, "joint {joint:?} has the {role} {link:?}, which is not a link")
            }
            Self::TwoParents { link, joints: [one, two] } => {
                write!(
                    f,
                    "link {link:?} is the child of joints {one:?} and {two:?}, it must be that of \
                     one"
                )
            }
            Self::Loop { links } => {
                write!(f, "the links {links} form a loop, they must form a tree")
            }
            Self::Roots { links } if links.listed.is_empty() => write!(f, "the robot has no links"),
            Self::Roots { links } => write!(
                f,
                "several links have no parent: {links}; base must name the one to begin at"
            ),
            Self::NoSuchLink { field, name, links } if links.listed.is_empty() => {
                write!(f, "{field} {name:?} is not a link, and no link has a name close to it")
            }
            Self::NoSuchLink { field, name, links } => {
                write!(f, "{field} {name:?} is not a link; there are {links}")
            }
            Self::NotBelow { tip, base } => {
                write!(f, "tip {tip:?} is not below base {base:?}: no joints lead from base to tip")
            }
            Self::SeveralTips { base, wanted, tips } => {
                let wanted = Counts(wanted);
                write!(
                    f,
                    "{wanted} revolute joints lead from {base:?} to several ends: {tips}; tip \
                     must name the one to take"
                )
            }
            Self::NoTip { base, wanted, ends } => {
                write!(
                    f,
                    "{} revolute joints lead from {base:?} to no end of a chain: {ends}",
                    Counts(wanted)
                )
            }
            _ => Ok(()),
        }
    }

    /// Of a joint between base and tip.
    fn fmt_joint(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::JointType { joint, kind } => {
                write!(
                    f,
                    "joint {joint:?} is {kind:?}, between base and tip it must be revolute, \
                     continuous or fixed"
                )
            }
            Self::Mimic { joint, of } => write!(
                f,
                "joint {joint:?} mimics {of:?}, between base and tip each joint must turn by itself"
            ),
            Self::JointCount { base, tip, found, wanted } => {
                write!(
                    f,
                    "{found} revolute joints lead from {base:?} to {tip:?}, there must be {}",
                    Counts(wanted)
                )
            }
            Self::NoLimit { joint } => write!(
                f,
                "joint {joint:?} is revolute and has no <limit>; a joint without limits is \
                 continuous"
            ),
            Self::NotNumbers { joint, field, text, wanted } => {
                let of = if *wanted == 1 { "a number" } else { "three numbers" };
                write!(f, "joint {joint:?} {field} is {text:?}, it must be {of}")?;
                if text.contains('$') {
                    write!(f, " (is it xacro that was not expanded?)")
                } else {
                    Ok(())
                }
            }
            Self::NotFinite { joint, field, value } => {
                write!(f, "joint {joint:?} {field} is {value}, it must be finite")
            }
            Self::TooLarge { joint, field, value, bound } => {
                write!(
                    f,
                    "joint {joint:?} {field} is {value:e}, its size must be at most {bound:e}"
                )
            }
            Self::NoAxis { joint } => {
                write!(f, "joint {joint:?} axis is 0 0 0, it must have a length")
            }
            _ => Ok(()),
        }
    }
}
