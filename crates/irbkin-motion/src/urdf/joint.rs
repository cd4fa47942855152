//! A joint of a URDF: its names, and its numbers if it is between base and tip.

use nalgebra::{Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::attributes::{Version, check_attributes};
use crate::prelude::*;
use crate::urdf::fault::UrdfFault;
use irbkin::internal::thresholds::{MOST_ANGLE, MOST_LENGTH, QUATERNION_NORM_BOUND};
use irbkin::internal::{constant_pose, snapped, unit};
use irbkin::pose::to_euler_zyx as pose_to_euler_zyx;
use irbkin::{JointAxis, Pose};

/// Most characters of an attribute that a message repeats.
const REPEATED: usize = 60;

/// The element of a linkage's joint that has the limits of the linkage: irbkin's own, since URDF has
/// none.
pub(super) const LINKAGE: &str = "linkage";

/// A joint between two links, which are given by their indices.
pub(super) struct Joint<'a> {
    pub(super) name: &'a str,
    pub(super) kind: &'a str,
    pub(super) parent: usize,
    pub(super) child: usize,
    node: Node<'a, 'a>,
}

/// The numbers of a joint, as in the text.
pub(crate) struct Placed {
    /// The child's origin in the parent [m].
    pub(super) xyz: [f64; 3],
    /// Roll, pitch and yaw of the child in the parent [rad].
    pub(super) rpy: [f64; 3],
    /// Roll, pitch and yaw with rounded right angles made exact [rad].
    pub(super) exact_rpy: [f64; 3],
    /// The motion; `None` for a fixed joint, and for a linkage's.
    pub(super) motion: Option<Motion>,
    /// The linkage that the joint stands for, if it does.
    pub(super) linkage: Option<Linkage>,
}

/// A joint that turns or slides: its axis in the child's frame, limits [rad, m] and velocity.
pub(crate) struct Motion {
    pub(super) direction: Vector3<f64>,
    pub(super) limits: [f64; 2],
    pub(super) velocity: Option<f64>,
}

/// A parallelogram linkage that couples axes 2 and 3, as a joint on axis 3 that takes joint 2 back.
pub(super) struct Linkage {
    /// The axis about which it turns by -q2.
    pub(super) direction: Vector3<f64>,
    /// Its angle about that axis where joint 2 is at zero [rad].
    offset: f64,
    /// Limits of the serial joint 3 [rad].
    pub(super) limits: Option<[f64; 2]>,
    /// The fault of a joint that turns another way.
    pub(super) fault: UrdfFault,
}

impl Placed {
    /// The child's frame in the parent's at a joint angle of zero; angles within `snap`, or their
    /// rounding, of a multiple of 90 deg [rad] are made exact.
    pub(super) fn origin(&self, snap: Option<f64>) -> Pose {
        let made_exact = |snap| self.rpy.map(|angle| snapped(angle, snap));
        let [roll, pitch, yaw] = snap.map_or(self.exact_rpy, made_exact);
        constant_pose(self.xyz, [yaw, pitch, roll])
    }
}

impl Linkage {
    /// The child's frame, seen from where the joint is at an angle of zero.
    pub(super) fn turned(&self, snap: f64) -> Pose {
        let axis = Unit::new_unchecked(snapped_direction(self.direction, snap));
        let rotation = Rotation3::from_axis_angle(&axis, snapped(self.offset, snap));
        Pose::from_parts(Translation3::identity(), rotation)
    }
}

/// An axis of the child in the base frame, for the child's frame at zero joint angles.
pub(super) fn axis(direction: Vector3<f64>, t_base_child: &Pose, snap: Option<f64>) -> JointAxis {
    let direction = t_base_child.rotation * snapped_direction(direction, snap.unwrap_or(0.0));
    JointAxis { direction: direction.into(), point: t_base_child.translation.vector.into() }
}

/// The coordinate axis within `snap` of a unit direction [rad], or the direction.
pub(super) fn snapped_direction(direction: Vector3<f64>, snap: f64) -> Vector3<f64> {
    let rest = direction.map(|component| if component.abs() <= snap { 0.0 } else { component });
    let along = rest.map(|component| if component == 0.0 { 0.0 } else { component.signum() });
    if along.norm_squared() < 1.5 && (direction - along).norm() <= snap { along } else { direction }
}

/// Half a unit of the last decimal of a number in the text, or of the seventh: files have
/// 3.1415926926 and 1.570796325. 0 with fewer than four decimals, of a float's own digits, and near
/// zero.
fn rounding_of(word: &str) -> f64 {
    let (whole, decimals) = word.split_once('.').unwrap_or_default();
    let is_far = whole.parse().is_ok_and(|whole: i32| whole != 0);
    let half_unit = decimals.bytes().take(7).fold(0.5, |half_unit, _| half_unit / 10.0);
    if is_far && (4..13).contains(&decimals.len()) { half_unit } else { 0.0 }
}

impl<'a> Joint<'a> {
    /// The joint of an element. `missing` describes what the element lacks, `link_of` gives the
    /// index of a link by its name.
    pub(super) fn new(
        node: Node<'a, 'a>,
        missing: impl Fn(&'static str) -> UrdfFault,
        link_of: impl Fn(&str) -> Option<usize>,
    ) -> Result<Self, UrdfFault> {
        let name = node.attribute("name").ok_or_else(|| missing("name"))?;
        let kind = node.attribute("type").ok_or_else(|| missing("type"))?;
        let link = |role, lacking| {
            let element = element(node, name, role)?.and_then(|element| element.attribute("link"));
            let link = element.ok_or_else(|| missing(lacking))?;
            link_of(link).ok_or_else(|| UrdfFault::UnknownLink {
                joint: name.to_owned(),
                role,
                link: link.to_owned(),
            })
        };
        let parent = link("parent", "<parent link=\"...\">")?;
        Ok(Self { name, kind, parent, child: link("child", "<child link=\"...\">")?, node })
    }

    /// Whether the joint is revolute and does not stand for a linkage.
    pub(super) fn turns(&self) -> bool {
        self.is_revolute() && !self.is_linkage()
    }

    /// Whether the joint may be a rail or a lift.
    pub(super) fn slides(&self) -> bool {
        self.kind == "prismatic"
    }

    fn is_revolute(&self) -> bool {
        matches!(self.kind, "revolute" | "continuous")
    }

    /// Whether the joint turns as far as another one, as a linkage's does; whether it is one depends
    /// on the other joints.
    pub(super) fn is_linkage(&self) -> bool {
        self.multiplier_and_offset().is_some()
    }

    /// The multiplier, 1 or -1, and the offset [rad] of a joint that turns as far as another one.
    fn multiplier_and_offset(&self) -> Option<[f64; 2]> {
        let [multiplier, offset] = self.mimic_numbers().ok()?.filter(|_| self.is_revolute())?;
        let is_linkage = [1.0, -1.0].contains(&multiplier) && offset.abs() <= MOST_ANGLE;
        is_linkage.then_some([multiplier, offset])
    }

    /// The multiplier and the offset of a joint that follows another one.
    pub(super) fn mimic_numbers(&self) -> Result<Option<[f64; 2]>, UrdfFault> {
        let Some(mimic) = self.element("mimic")? else { return Ok(None) };
        let number = |name, field, default| match mimic.attribute(name) {
            Some(text) => self.numbers::<1>(field, text, f64::MAX).map(|[number]| number),
            None => Ok(default),
        };
        let multiplier = number("multiplier", "mimic multiplier", 1.0)?;
        Ok(Some([multiplier, number("offset", "mimic offset", 0.0)?]))
    }

    /// The limits of a joint that may be beside the chain [rad or m], infinite for none.
    pub(super) fn range(&self) -> Result<[f64; 2], UrdfFault> {
        match self.limit() {
            _ if self.kind == "fixed" => Ok([0.0; 2]),
            Err(UrdfFault::NoLimit { .. }) => Ok([f64::NEG_INFINITY, f64::INFINITY]),
            limit => limit.map(|(range, _)| range),
        }
    }

    /// The reason why the joint may not be between base and tip, or not behind one that moves.
    pub(super) fn fault(&self, is_behind: bool) -> Result<(), UrdfFault> {
        let may_slide = self.slides() && !is_behind;
        if !self.is_revolute() && !may_slide && self.kind != "fixed" {
            return Err(UrdfFault::JointType {
                joint: self.name.to_owned(),
                kind: self.kind.to_owned(),
            });
        }
        match self.element("mimic")? {
            Some(_) if self.kind != "fixed" && !self.is_linkage() => Err(self.mimic()),
            _ => Ok(()),
        }
    }

    /// The fault of a joint that follows another one.
    pub(super) fn mimic(&self) -> UrdfFault {
        let multiplier = self.mimicking("multiplier").unwrap_or("1");
        UrdfFault::Mimic {
            joint: self.name.to_owned(),
            of: self.followed().to_owned(),
            multiplier: multiplier.chars().take(REPEATED).collect(),
        }
    }

    /// The name of the joint that it follows; empty if it does not.
    pub(super) fn followed(&self) -> &'a str {
        self.mimicking("joint").unwrap_or_default()
    }

    /// An attribute of how it follows another joint.
    fn mimicking(&self, attribute: &'static str) -> Option<&'a str> {
        self.element("mimic").ok()??.attribute(attribute)
    }

    /// The numbers of the joint.
    pub(super) fn placed(&self, version: Version) -> Result<Placed, UrdfFault> {
        check_attributes(self.node, self.name, version)?;
        let (mut xyz, mut rpy, mut exact_rpy) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        if let Some(origin) = self.element("origin")? {
            xyz = self.three(origin, "xyz", "origin xyz", MOST_LENGTH)?.unwrap_or(xyz);
            rpy = self.rpy(origin)?.unwrap_or(rpy);
            exact_rpy = rpy;
            let words = origin.attribute("rpy").unwrap_or_default().split_whitespace();
            for (angle, word) in exact_rpy.iter_mut().zip(words) {
                *angle = snapped(*angle, rounding_of(word));
            }
        }
        let linkage = self.multiplier_and_offset().map(|turns| self.linkage(turns)).transpose()?;
        Ok(Placed { xyz, rpy, exact_rpy, motion: self.motion()?, linkage })
    }

    /// The rotation of an origin as roll, pitch and yaw [rad].
    fn rpy(&self, origin: Node<'_, '_>) -> Result<Option<[f64; 3]>, UrdfFault> {
        let rpy = self.three(origin, "rpy", "origin rpy", MOST_ANGLE)?;
        let Some(text) = origin.attribute("quat_xyzw") else { return Ok(rpy) };
        if rpy.is_some() {
            return Err(UrdfFault::TwoRotations { joint: self.name.to_owned() });
        }
        let [x, y, z, w] = self.numbers("origin quat_xyzw", text, f64::MAX)?;
        let quaternion = Quaternion::new(w, x, y, z);
        let norm = quaternion.norm();
        if (norm - 1.0).abs() > QUATERNION_NORM_BOUND {
            let (joint, bound) = (self.name.to_owned(), QUATERNION_NORM_BOUND);
            return Err(UrdfFault::QuaternionNorm { joint, norm, bound });
        }
        let rotation = UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix();
        let turned = Pose::from_parts(Translation3::identity(), rotation);
        let (_, [yaw, pitch, roll]) = pose_to_euler_zyx(&turned);
        Ok(Some([roll, pitch, yaw]))
    }

    fn linkage(&self, [multiplier, offset]: [f64; 2]) -> Result<Linkage, UrdfFault> {
        let limits = self.element(LINKAGE)?.map(|linkage| {
            let limit = |name, field| match linkage.attribute(name) {
                Some(text) => self.numbers::<1>(field, text, MOST_ANGLE).map(|[limit]| limit),
                None => Ok(0.0),
            };
            Ok([limit("lower", "linkage lower")?, limit("upper", "linkage upper")?])
        });
        let (direction, limits) = (self.direction()? * -multiplier, limits.transpose()?);
        Ok(Linkage { direction, offset: -multiplier * offset, limits, fault: self.mimic() })
    }

    pub(super) fn direction(&self) -> Result<Vector3<f64>, UrdfFault> {
        let axis = match self.element("axis")? {
            Some(axis) => self.three(axis, "xyz", "axis", f64::MAX)?,
            None => None,
        };
        unit(axis.unwrap_or([1.0, 0.0, 0.0]))
            .ok_or_else(|| UrdfFault::NoAxis { joint: self.name.to_owned() })
    }

    /// The motion; `None` for a fixed joint, and for a linkage's.
    fn motion(&self) -> Result<Option<Motion>, UrdfFault> {
        if !self.turns() && !self.slides() {
            return Ok(None);
        }
        let (direction, (limits, velocity)) = (self.direction()?, self.limit()?);
        Ok(Some(Motion { direction, limits, velocity }))
    }

    /// Limits, infinite without any, and velocity. A missing limit is zero, as the
    /// format defines; one beyond [`MOST_ANGLE`] is none. A velocity that is no positive number below
    /// that is not known: it concerns no pose.
    fn limit(&self) -> Result<([f64; 2], Option<f64>), UrdfFault> {
        let unlimited = [f64::NEG_INFINITY, f64::INFINITY];
        let Some(limit) = self.element("limit")? else {
            let fault = UrdfFault::NoLimit { joint: self.name.to_owned() };
            return if self.kind == "revolute" { Err(fault) } else { Ok((unlimited, None)) };
        };
        let velocity = limit.attribute("velocity").and_then(|text| text.trim().parse().ok());
        let velocity = velocity.filter(|value: &f64| *value > 0.0 && *value < MOST_ANGLE);
        if self.kind == "continuous" {
            return Ok((unlimited, velocity));
        }
        let bound = |attribute, field| {
            let Some(text) = limit.attribute(attribute) else { return Ok(0.0) };
            let [value] = match text.trim().parse::<f64>() {
                Ok(value) if value.abs() > MOST_ANGLE => [value.signum() * f64::INFINITY],
                _ => self.numbers(field, text, MOST_ANGLE)?,
            };
            Ok(value)
        };
        Ok(([bound("lower", "limit lower")?, bound("upper", "limit upper")?], velocity))
    }

    fn three(
        &self,
        node: Node<'_, '_>,
        attribute: &str,
        field: &'static str,
        bound: f64,
    ) -> Result<Option<[f64; 3]>, UrdfFault> {
        node.attribute(attribute).map(|text| self.numbers(field, text, bound)).transpose()
    }

    fn numbers<const K: usize>(
        &self,
        field: &'static str,
        text: &str,
        bound: f64,
    ) -> Result<[f64; K], UrdfFault> {
        let joint = || self.name.to_owned();
        let not_numbers = || UrdfFault::NotNumbers {
            joint: joint(),
            field,
            text: text.chars().take(REPEATED).collect(),
            wanted: K,
        };
        let mut words = text.split_whitespace();
        let mut values = [0.0; K];
        for value in &mut values {
            *value =
                words.next().and_then(|word| word.parse::<f64>().ok()).ok_or_else(not_numbers)?;
        }
        if words.next().is_some() {
            return Err(not_numbers());
        }
        for value in values {
            if !value.is_finite() {
                return Err(UrdfFault::NotFinite { joint: joint(), field, value });
            }
            if value.abs() > bound {
                return Err(UrdfFault::TooLarge { joint: joint(), field, value, bound });
            }
        }
        Ok(values)
    }

    fn element(&self, name: &'static str) -> Result<Option<Node<'a, 'a>>, UrdfFault> {
        element(self.node, self.name, name)
    }
}

/// Whether a node is an element of a name, and not another program's, which has another namespace.
pub(super) fn is_own(node: Node<'_, '_>, name: &str) -> bool {
    let root = node.document().root_element().tag_name();
    let tag = node.tag_name();
    node.is_element() && tag.name() == name && tag.namespace() == root.namespace()
}

/// The only element with that name in a joint.
fn element<'a>(
    node: Node<'a, 'a>,
    joint: &str,
    name: &'static str,
) -> Result<Option<Node<'a, 'a>>, UrdfFault> {
    let mut found = node.children().filter(|child| is_own(*child, name));
    match (found.next(), found.next()) {
        (_, Some(_)) => Err(UrdfFault::Twice { joint: joint.to_owned(), element: name }),
        (first, None) => Ok(first),
    }
}
