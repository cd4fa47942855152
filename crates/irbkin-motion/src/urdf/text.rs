//! The elements of a URDF as text.

use core::fmt::Write as _;

use nalgebra::{Rotation3, Vector3};

use super::joint::LINKAGE;
use crate::body::Capsule;
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::thresholds::MOST_ANGLE;
use irbkin::pose::to_euler_zyx as pose_to_euler_zyx;

#[derive(Clone, Copy)]
pub(super) struct Hinge {
    /// The frame of its link in the parent at a joint angle of zero.
    pub(super) origin: Pose,
    /// Unit direction in the frame of its link [1].
    pub(super) axis: Vector3<f64>,
    /// Lower and upper limit [rad], infinite for none.
    pub(super) limits: [f64; 2],
    /// Largest velocity [rad/s]; if it is unknown, a file has [`MOST_ANGLE`], which every reader
    /// takes: some take zero for a limit, and some need the attribute.
    pub(super) velocity: Option<f64>,
}

impl Hinge {
    fn kind(&self) -> &'static str {
        let is_limited = self.limits.iter().any(|limit| f64::is_finite(*limit));
        if is_limited { "revolute" } else { "continuous" }
    }
}

/// A text that grows by elements.
pub(super) struct Text(String);

impl Text {
    pub(super) fn new(name: &str) -> Self {
        let name = if name.is_empty() { "robot".into() } else { escaped(name) };
        // Without an encoding, which is not the text's own as a str: lxml refuses one there.
        let mut text = Self(String::from("<?xml version=\"1.0\"?>\n"));
        text.line(format_args!("<robot name=\"{name}\">"));
        text
    }

    pub(super) fn finished(mut self) -> String {
        self.push("</robot>\n");
        self.0
    }

    fn push(&mut self, text: &str) {
        self.0.push_str(text);
    }

    /// Lines in the robot.
    pub(super) fn lines(&mut self, lines: &[&str]) {
        for line in lines {
            self.line(format_args!("  {line}"));
        }
    }

    fn line(&mut self, line: core::fmt::Arguments<'_>) {
        // Writing to a String does not fail.
        let _ = writeln!(self.0, "{line}");
    }

    pub(super) fn link(&mut self, name: &str) {
        self.line(format_args!("  <link name=\"{name}\"/>"));
    }

    /// A link with capsules in its frame: a sphere each, or a cylinder and the spheres at its ends.
    pub(super) fn solid_link(&mut self, name: &str, capsules: &[Capsule]) {
        if capsules.is_empty() {
            return self.link(name);
        }
        self.line(format_args!("  <link name=\"{name}\">"));
        for element in ["visual", "collision"] {
            for capsule in capsules {
                let ([a, b], radius) = (capsule.ends(), capsule.radius());
                let sphere = format!("<sphere radius=\"{radius}\"/>");
                self.solid(element, a, [0.0; 3], &sphere);
                if !capsule.is_sphere() {
                    self.solid(element, b, [0.0; 3], &sphere);
                    let (pose, length) = along(a, b);
                    let cylinder = format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>");
                    let (xyz, [yaw, pitch, roll]) = pose_to_euler_zyx(&pose);
                    self.solid(element, xyz, [roll, pitch, yaw], &cylinder);
                }
            }
        }
        self.push("  </link>\n");
    }

    fn solid(&mut self, element: &str, xyz: [f64; 3], rpy: [f64; 3], shape: &str) {
        let (xyz, rpy) = (numbers(xyz), numbers(rpy));
        self.line(format_args!(
            "    <{element}><origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><geometry>{shape}</geometry></{element}>"
        ));
    }

    pub(super) fn fixed(&mut self, name: &str, links: [&str; 2], pose: &Pose) {
        self.begin(name, "fixed", links, pose);
        self.push("  </joint>\n");
    }

    pub(super) fn hinge(&mut self, name: &str, links: [&str; 2], hinge: &Hinge) {
        self.turning(name, links, hinge);
        self.push("  </joint>\n");
    }

    /// The joint that takes joint 2 back, with the limits of the linkage, for which URDF has no
    /// element.
    pub(super) fn linkage(&mut self, links: [&str; 2], second: &Hinge, limits: Option<[f64; 2]>) {
        let [lower, upper] = second.limits;
        self.turning("joint_2-linkage", links, &Hinge { limits: [-upper, -lower], ..*second });
        self.push("    <mimic joint=\"joint_2\" multiplier=\"-1\" offset=\"0\"/>\n");
        if let Some([lower, upper]) = limits.map(finite) {
            self.push("    <!-- Limits of the angle between link_2 and link_3, for irbkin. -->\n");
            self.line(format_args!("    <{LINKAGE} lower=\"{lower}\" upper=\"{upper}\"/>"));
        }
        self.push("  </joint>\n");
    }

    fn turning(&mut self, name: &str, links: [&str; 2], hinge: &Hinge) {
        self.begin(name, hinge.kind(), links, &hinge.origin);
        let axis = numbers(hinge.axis.into());
        self.line(format_args!("    <axis xyz=\"{axis}\"/>"));
        let velocity = hinge.velocity.unwrap_or(MOST_ANGLE).min(MOST_ANGLE);
        let rest = format_args!("effort=\"0\" velocity=\"{velocity}\"");
        if hinge.kind() == "continuous" {
            return self.line(format_args!("    <limit {rest}/>"));
        }
        let [lower, upper] = finite(hinge.limits);
        self.line(format_args!("    <limit lower=\"{lower}\" upper=\"{upper}\" {rest}/>"));
    }

    /// The elements that each joint has, without its end.
    fn begin(&mut self, name: &str, kind: &str, [parent, child]: [&str; 2], pose: &Pose) {
        self.line(format_args!("  <joint name=\"{name}\" type=\"{kind}\">"));
        self.line(format_args!("    <parent link=\"{parent}\"/>"));
        self.line(format_args!("    <child link=\"{child}\"/>"));
        let (xyz, [yaw, pitch, roll]) = pose_to_euler_zyx(pose);
        let (xyz, rpy) = (numbers(xyz), numbers([roll, pitch, yaw]));
        self.line(format_args!("    <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>"));
    }
}

/// The frame in the middle of a line, with z along it, and the length of the line [m].
fn along(a: [f64; 3], b: [f64; 3]) -> (Pose, f64) {
    let [a, b] = [a, b].map(Vector3::from);
    let way = b - a;
    // Upward, so that no half turn is needed.
    let up = if way.z < 0.0 { -way } else { way };
    let about = Vector3::z().cross(&up);
    let (sin, cos) = (about.norm(), up.z);
    let turn = if sin > 0.0 { about * (sin.atan2(cos) / sin) } else { about };
    let rotation = Rotation3::new(turn);
    (Pose::from_parts(((a + b) * 0.5).into(), rotation), way.norm())
}

/// Three numbers with the digits to be read back as they are. Adding zero removes minus zero.
fn numbers(values: [f64; 3]) -> String {
    let [x, y, z] = values.map(|value| value + 0.0);
    format!("{x} {y} {z}")
}

/// Limits as text has them, which has no infinity.
fn finite(limits: [f64; 2]) -> [f64; 2] {
    limits.map(|limit| limit.clamp(-MOST_ANGLE, MOST_ANGLE) + 0.0)
}

/// A name as the value of an attribute; a character that XML cannot have becomes U+FFFD.
fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for character in name.chars() {
        match character {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            // Unescaped, a reader takes them for blanks.
            '\t' => text.push_str("&#9;"),
            '\n' => text.push_str("&#10;"),
            '\r' => text.push_str("&#13;"),
            '\0'..' ' | '\u{fffe}' | '\u{ffff}' => text.push('\u{fffd}'),
            other => text.push(other),
        }
    }
    text
}
