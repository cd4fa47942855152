//! The version of a URDF, and the attributes that it has: an unknown one of an origin, an axis or a
//! mimic that is skipped could be an arm of another shape.
//!
//! Reference: `urdfdom`'s versions 1.0 to 1.2.

use roxmltree::{Attribute, Node};

use crate::prelude::*;
use crate::urdf::fault::UrdfFault;

/// The minor number of a version 1.x.
pub(super) type Version = u32;

/// The newest version that is read, as its minor number [1].
pub(super) const NEWEST: Version = 2;

/// The attributes of the elements that place a joint, each with the version from which it has
/// effect.
const ATTRIBUTES: &[(&str, &[(&str, Version)])] = &[
    ("origin", &[("xyz", 0), ("rpy", 0), ("quat_xyzw", 1)]),
    ("axis", &[("xyz", 0)]),
    ("mimic", &[("joint", 0), ("multiplier", 0), ("offset", 0)]),
];

/// The version of a robot; 1.0 by default.
pub(super) fn version_of(robot: Node<'_, '_>) -> Result<Version, UrdfFault> {
    let Some(text) = robot.attribute("version") else { return Ok(0) };
    let minor = match text.trim().split_once('.') {
        Some(("1", minor)) => minor.strip_suffix(".0").unwrap_or(minor).parse().ok(),
        None if text.trim() == "1" => Some(0),
        _ => None,
    };
    minor
        .filter(|minor| *minor <= NEWEST)
        .ok_or_else(|| UrdfFault::Version { version: text.to_owned(), newest: NEWEST })
}

/// Reject an attribute that the version of the robot does not have. Attributes with a namespace
/// belong to other programs, and zeros neither turn nor move anything.
pub(super) fn check_attributes(
    joint: Node<'_, '_>,
    name: &str,
    version: Version,
) -> Result<(), UrdfFault> {
    let is_fixed = joint.attribute("type") == Some("fixed");
    for element in joint.children().filter(|it| !is_fixed || it.has_tag_name("origin")) {
        let of_element = |(name, _): &&(&str, _)| element.has_tag_name(*name);
        let Some((element_name, known)) = ATTRIBUTES.iter().find(of_element) else { continue };
        let is_own = |it: &Attribute<'_, '_>| it.namespace().is_none() && !is_zero(it.value());
        for attribute in element.attributes().filter(is_own) {
            let (joint, attribute) = (name.to_owned(), attribute.name());
            match known.iter().find(|(known, _)| *known == attribute) {
                Some((attribute, since)) if version < *since => {
                    return Err(UrdfFault::TooNew { joint, attribute, since: *since, version });
                }
                Some(_) => {}
                None => {
                    return Err(UrdfFault::Attribute {
                        joint,
                        element: element_name,
                        attribute: attribute.to_owned(),
                        known: known.iter().map(|(known, _)| known.to_string()).collect(),
                    });
                }
            }
        }
    }
    Ok(())
}

/// Whether a text is zeros: at least one number, and no other.
fn is_zero(text: &str) -> bool {
    let mut numbers = text.split_whitespace().map(|word| word.parse() == Ok(0.0)).peekable();
    numbers.peek().is_some() && numbers.all(|is_zero| is_zero)
}
