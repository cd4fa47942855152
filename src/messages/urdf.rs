//! Messages of a URDF.

use std::vec;
use std::vec::Vec;

use super::{Row, Table, rows};
use crate::error::{Names, UrdfFault};

pub(super) fn tables() -> Vec<Table> {
    vec![Table { name: "urdf", rows: faults() }]
}

fn links(names: &[&str]) -> Names {
    names.iter().map(|name| std::format!("{name:?}")).collect()
}

fn faults() -> Vec<Row> {
    let [joint, link] = ["joint_1", "link_1"].map(std::string::String::from);
    rows! { UrdfFault;
        UrdfFault::NotUtf8 { .. } => UrdfFault::NotUtf8 { byte: 13 },
            "bytes in another encoding", "save the file as UTF-8";
        UrdfFault::NotXml { .. } =>
            UrdfFault::NotXml { line: 1, column: 1, what: "unknown token".into() },
            "broken XML, or a path that does not exist as text",
            "mend the place; pass a path that ends in .urdf";
        UrdfFault::Namespaces { .. } => UrdfFault::Namespaces { line: 3, bound: 64 },
            "a text made to take long", "remove them";
        UrdfFault::Attributes { .. } =>
            UrdfFault::Attributes { line: 3, element: "link".into(), bound: 64 },
            "the same", "remove them";
        UrdfFault::NotRobot { .. } => UrdfFault::NotRobot { found: "sdf".into() },
            "SDF, MJCF or other XML", "convert it to URDF";
        UrdfFault::Xacro { .. } =>
            UrdfFault::Xacro { line: 2, element: "xacro:macro".into() },
            "xacro", "expand it as it says";
        UrdfFault::Missing { .. } =>
            UrdfFault::Missing { line: 4, element: "joint", missing: "parent" },
            "an incomplete element", "add what is missing";
        UrdfFault::SameName { .. } =>
            UrdfFault::SameName { element: "link", name: link.clone() },
            "two elements of one name", "rename one";
        UrdfFault::Twice { .. } => UrdfFault::Twice { joint: joint.clone(), element: "axis" },
            "an element written twice", "remove one";
        UrdfFault::UnknownLink { .. } =>
            UrdfFault::UnknownLink { joint: joint.clone(), role: "child", link: "x".into() },
            "a name that is misspelt", "write the name of a link";
        UrdfFault::TwoParents { .. } =>
            UrdfFault::TwoParents { link: link.clone(), joints: ["a".into(), "b".into()] },
            "a closed chain", "cut it open";
        UrdfFault::Loop { .. } => UrdfFault::Loop { links: links(&["a", "b"]) },
            "a closed chain", "cut it open";
        UrdfFault::Roots { .. } => UrdfFault::Roots { links: links(&["a", "b"]) },
            "several robots in one text", "pass `base=`";
        UrdfFault::Roots { .. } => UrdfFault::Roots { links: links(&[]) },
            "a text without links", "add them";
        UrdfFault::NoSuchLink { .. } => UrdfFault::NoSuchLink {
            field: "tip", name: "tool".into(), links: links(&["tool0", "link_6"]),
        },
            "`base=` or `tip=`", "take one that is listed";
        UrdfFault::NoSuchLink { .. } =>
            UrdfFault::NoSuchLink { field: "base", name: "zz".into(), links: links(&[]) },
            "the same, with a name like no other", "look up the link's name";
        UrdfFault::NotBelow { .. } =>
            UrdfFault::NotBelow { tip: "base".into(), base: "tool0".into() },
            "`base` and `tip` swapped", "swap them";
        UrdfFault::SeveralTips { .. } => UrdfFault::SeveralTips {
            base: "base".into(), wanted: vec![6, 7], tips: links(&["tool0", "camera"]),
        },
            "several ends of a chain", "pass `tip=`";
        UrdfFault::NoTip { .. } => UrdfFault::NoTip {
            base: "base".into(), wanted: vec![6, 7], ends: links(&["finger"]),
        },
            "no end that could be meant", "pass `tip=`";
        UrdfFault::JointType { .. } =>
            UrdfFault::JointType { joint: joint.clone(), kind: "prismatic".into() },
            "a linear axis in the chain", "choose `base` behind it";
        UrdfFault::Mimic { .. } => UrdfFault::Mimic { joint: joint.clone(), of: "joint_2".into() },
            "a joint that follows another", "choose `tip` before it";
        UrdfFault::JointCount { .. } => UrdfFault::JointCount {
            base: "base".into(), tip: "tool0".into(), found: 5, wanted: vec![6, 7],
        },
            "an arm of another number of joints", "choose `base` and `tip`";
        UrdfFault::NoLimit { .. } => UrdfFault::NoLimit { joint: joint.clone() },
            "a revolute joint without limits", "add `<limit>`, or make it continuous";
        UrdfFault::NotNumbers { .. } => UrdfFault::NotNumbers {
            joint: joint.clone(), field: "origin xyz", text: "${a} 0 0".into(), wanted: 3,
        },
            "xacro that was not expanded", "expand it";
        UrdfFault::NotFinite { .. } => UrdfFault::NotFinite {
            joint: joint.clone(), field: "origin xyz", value: f64::NAN,
        },
            "NaN or inf", "give a number";
        UrdfFault::TooLarge { .. } => UrdfFault::TooLarge {
            joint: joint.clone(), field: "origin xyz", value: 1e7, bound: 1e6,
        },
            "a number too large to keep its digits", "meters and radians are wanted";
        UrdfFault::NoAxis { .. } => UrdfFault::NoAxis { joint },
            "`<axis xyz=\"0 0 0\">`", "give a direction";
    }
}
