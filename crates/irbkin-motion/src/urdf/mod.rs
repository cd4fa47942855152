//! Robots from URDF: the chain between two links as joint axes, limits and velocities. And back:
//! the text of a robot.
//!
//! Reference: ROS wiki, urdf/XML/robot, link and joint.

mod attributes;
mod chain;
mod collision;
pub(crate) mod fault;
mod joint;
mod shape;
mod sweep;
mod text;
mod tree;
mod write;

use alloc::borrow::ToOwned as _;
use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use nalgebra::Vector3;

use self::chain::{chain_between, take_rail};
use self::collision::{Solid, body_of, carriers, places, remark, shaped, solids};
use self::joint::{Joint, Motion, Placed, axis, snapped_direction};
pub use self::sweep::Carrier;
use self::tree::Tree;
pub use self::tree::read_document;
use crate::arm::{AnyArm, Arm};
use crate::error::Error;
use crate::plan::ExternalAxis;
use crate::plan::rail::Rail;
use crate::urdf::fault::UrdfFault;
use irbkin::internal::thresholds::FORM_TOLERANCE;
use irbkin::internal::{ModelFault, OFFSET_WRIST, SNAPS, check_snap};
use irbkin::{JointAxis, JointLimits, Joints, Mdh, Pose, Robot};

impl<const N: usize> Arm<N>
where
    Robot<N>: Joints<N>,
{
    /// An arm from the text of a URDF, with the solver of its kinematic structure.
    ///
    /// `base` is the link in whose frame poses are given; by default the link without a parent.
    /// `tip` is the link whose poses are given; by default the only one at the end of a chain of
    /// `N` revolute joints or, if all such ends are fixed to one link, the first of `tool0`, `tcp`,
    /// `flange` and `grasp`. Joints are numbered from base to tip; fixed joints, and joints that are
    /// not between them, are not counted. A joint turns in the sense of its axis. Limits and
    /// velocities are the text's; a limit beyond 1e5 rad is none. A velocity that is no positive
    /// number below 1e5 rad/s is unknown, and one unknown velocity leaves the robot without
    /// velocities. [`Robot::joint_names`] are the text's. A joint
    /// that takes joint 2 back on the axis of joint 3, by mimicking it with the multiplier -1, or 1
    /// about the reverse axis, and any offset, is a parallelogram linkage: the arm is then
    /// [`Robot::coupled`].
    ///
    /// A prismatic joint before all that turn is a rail or a lift ([`Arm::carrier`], [`Arm::at`]): the
    /// robot's own base is the link behind it, at the joint's zero or at the limit nearest to it.
    ///
    /// Right angles rounded to four or more decimals, as 1.5708, are made exact, unless that may move
    /// the tool by more than 1e-4 m; [`Arm::from_urdf_snapped`] with 0 keeps them.
    ///
    /// The body of the robot has capsules that contain the collision shapes of all links that move
    /// with the chain: boxes, cylinders, spheres and capsules. Links behind joints beside the chain,
    /// as of a gripper, are in it wherever these joints may be; another arm on the same base is
    /// not. [`Body::source`](crate::body::Body::source) names both. Links that are not neighbors are
    /// kept apart, unless they touch in each of 64 postures that fill the limits. With a mesh among
    /// the shapes, or another one that is not read, there is no body, and where one is needed the
    /// error says why.
    ///
    /// # Errors
    ///
    /// [`irbkin::Error::InvalidModel`] when the text is not a URDF, `base` or `tip` are not links of a
    /// chain of `N` revolute joints or are ambiguous, a joint may be a gripper's and `tip` is not
    /// given, or six joints are not independent.
    /// [`Arm::serial_chain_from_urdf`] accepts such an arm, without its inverse.
    pub fn from_urdf(text: &str, base: Option<&str>, tip: Option<&str>) -> Result<Self, Error> {
        UrdfArm::read(text, base, tip, &[N])?.solved(None)
    }

    /// As [`Arm::from_urdf`], with each angle of an origin, and each axis, that is within `snap`
    /// of a multiple of 90 deg [rad] made exact, so that 1.5708 becomes a right angle.
    ///
    /// # Errors
    ///
    /// As [`Arm::from_urdf`], and when `snap` is not 0 to 1e-3 rad.
    pub fn from_urdf_snapped(
        text: &str,
        base: Option<&str>,
        tip: Option<&str>,
        snap: f64,
    ) -> Result<Self, Error> {
        UrdfArm::read(text, base, tip, &[N])?.solved(Some(snap))
    }

    /// As [`Arm::from_urdf`], of joints that are not independent too: then without the inverse.
    ///
    /// # Errors
    ///
    /// As [`Arm::from_urdf`], except that such an arm is accepted.
    pub fn serial_chain_from_urdf(
        text: &str,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> Result<Self, Error> {
        UrdfArm::read(text, base, tip, &[N])?.arm(None)
    }
}

impl AnyArm {
    /// The arm of five, six or seven joints between two links of a URDF; see [`Arm::from_urdf`].
    ///
    /// # Errors
    ///
    /// As [`Arm::from_urdf`].
    pub fn from_urdf(text: &str, base: Option<&str>, tip: Option<&str>) -> Result<Self, Error> {
        UrdfArm::read_any(text, base, tip)?.any_arm(None)
    }
}

/// A link that moves with the chain: its name, the link of the body, its way in the frame of that.
type Moving = (String, usize, Carrier);

/// The arm of a URDF, with any number of joints.
pub struct UrdfArm {
    name: String,
    /// Base and tip.
    ends: [String; 2],
    joint_names: Vec<String>,
    /// On the tip, and on exact right angles.
    remarks: [String; 2],
    /// The joints of the rail, the last of which slides; none without a rail.
    rail: Vec<Placed>,
    slide: String,
    joints: Vec<Placed>,
    /// The shapes of its links, if all are read, and a remark on those beside the chain.
    solids: Result<(Vec<Solid>, String), UrdfFault>,
}

impl UrdfArm {
    /// Read the chain between two links; its number of joints must be in `wanted`.
    #[doc(hidden)]
    pub fn read(
        text: &str,
        base: Option<&str>,
        tip: Option<&str>,
        wanted: &[usize],
    ) -> Result<Self, Error> {
        read_document(text, |document, skipped| {
            let tree = Tree::new(document, skipped)?;
            let (base, mut chain, remark) = chain_between(&tree, base, tip, wanted)?;
            let rail = take_rail(&mut chain);
            let base = rail.last().map_or(base, |joint| joint.child);
            let tip = chain.last().map_or(base, |joint| joint.child);
            let ends = [base, tip].map(|link| tree.links[link].to_string());
            let solids = solids(&tree, document.root_element(), base, &chain);
            let turning = chain.iter().filter(|joint| joint.turns());
            let joint_names = turning.map(|joint| joint.name.to_string()).collect();
            let slide = rail.last().map_or("", |joint| joint.name).to_string();
            let placed = |joint: &&Joint<'_>| joint.placed(tree.version);
            let mut all = rail.iter().chain(&chain).map(placed).collect::<Result<Vec<_>, _>>()?;
            let remarks = [remark, check_rounding(&mut all)];
            let joints = all.split_off(rail.len());
            let name = tree.name.to_string();
            Ok(Self { name, ends, joint_names, remarks, rail: all, slide, joints, solids })
        })
    }

    /// Read the chain of six or seven joints between two links or, if there is none, of five.
    #[doc(hidden)]
    pub fn read_any(text: &str, base: Option<&str>, tip: Option<&str>) -> Result<Self, Error> {
        let is_none = |read: &Result<Self, Error>| {
            let Err(Error::InvalidUrdf(fault)) = read else { return false };
            matches!(fault, UrdfFault::NoTip { .. } | UrdfFault::JointCount { .. })
        };
        let read = Self::read(text, base, tip, &[6, 7]);
        if !is_none(&read) {
            return read;
        }
        let of_five = Self::read(text, base, tip, &[5]);
        if is_none(&of_five) { read } else { of_five }
    }

    /// Every link with shapes that moves with the chain, and a remark on those beside the chain.
    #[doc(hidden)]
    pub fn links(
        text: &str,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> Result<(Vec<Moving>, String), Error> {
        let arm = Self::read_any(text, base, tip)?;
        let count = [arm.joint_names.len()];
        let places = match arm.any_arm(None)? {
            AnyArm::Six(own) => places(&own, &arm.joints, None),
            AnyArm::Seven(own) => places(&own, &arm.joints, None),
            AnyArm::Five(own) => places(&own, &arm.joints, None),
        };
        read_document(text, |document, skipped| {
            let tree = Tree::new(document, skipped)?;
            let (base, mut chain, _) = chain_between(&tree, base, tip, &count)?;
            let base = take_rail(&mut chain).last().map_or(base, |joint| joint.child);
            let carriers = carriers(&tree, base, &chain);
            let has_shapes = shaped(document.root_element(), &["collision", "visual"]);
            let remark = remark(&tree, &carriers, &has_shapes);
            let mut links = Vec::new();
            for (link, carrier) in carriers.into_iter().enumerate().filter(|it| has_shapes[it.0]) {
                let Some(mut carrier) = carrier.transpose()? else { continue };
                if let Some((number, place)) = places[carrier.after] {
                    let first = carrier.beside.first_mut().map(|(pose, _)| pose);
                    let first = first.unwrap_or(&mut carrier.pose);
                    *first = place * *first;
                    links.push((tree.links[link].to_owned(), number, carrier));
                }
            }
            Ok((links, remark))
        })
    }

    fn motions(&self) -> impl Iterator<Item = &Motion> {
        self.joints.iter().filter_map(|joint| joint.motion.as_ref())
    }

    /// As [`Self::arm`], of five, six or seven joints.
    #[doc(hidden)]
    pub fn any_arm(&self, snap: Option<f64>) -> Result<AnyArm, Error> {
        match self.motions().count() {
            5 => self.solved::<5>(snap).map(AnyArm::Five),
            7 => self.solved::<7>(snap).map(AnyArm::Seven),
            _ => self.solved::<6>(snap).map(AnyArm::Six),
        }
    }

    /// As [`Self::arm`], with its inverse; a refusal names the chain.
    fn solved<const N: usize>(&self, snap: Option<f64>) -> Result<Arm<N>, Error>
    where
        Robot<N>: Joints<N>,
    {
        self.arm(snap).and_then(|arm| Ok(arm.map(Robot::with_inverse)?)).map_err(
            |error| match error {
                Error::Robot(irbkin::Error::InvalidModel(ModelFault::Snap { .. })) => error,
                Error::Robot(irbkin::Error::InvalidModel(fault)) => {
                    let [base, tip] = self.ends.clone();
                    UrdfFault::Chain { base, tip, fault: Box::new(fault) }.into()
                }
                _ => error,
            },
        )
    }

    /// The arm, which must have `N` joints. Angles within `snap`, or their rounding, of a multiple
    /// of 90 deg [rad] are made exact. If the arm has no closed form, or no table, and would have
    /// one with a larger snap, that is proposed.
    fn arm<const N: usize>(&self, snap: Option<f64>) -> Result<Arm<N>, Error>
    where
        Robot<N>: Joints<N>,
    {
        check_snap(snap.unwrap_or(0.0))?;
        let snaps = || (0..).zip(SNAPS);
        let closed = |(index, snap): (u8, f64)| {
            Some((index, Robot::in_closed_form(self.table::<N>(Some(snap)).ok()?)?))
        };
        let proposal = || snaps().find_map(closed);
        let robot = match self.robot::<N>(snap) {
            Ok(robot) if robot.missing_form().is_some() => match proposal() {
                None if robot.structure() == "general" => {
                    // To recognize it takes milliseconds: the largest is tried first.
                    let wrist = |(index, snap): (u8, f64)| {
                        let other = self.robot::<N>(Some(snap)).ok()?;
                        (other.structure() == OFFSET_WRIST).then_some((index, other))
                    };
                    let largest = snaps().last().and_then(wrist);
                    robot.proposing(largest.and_then(|_| snaps().find_map(wrist)))
                }
                closed => robot.proposing(closed),
            },
            Err(Error::Robot(irbkin::Error::InvalidModel(ModelFault::NearlyParallel {
                axes,
                off,
                distance,
                bound,
                ..
            }))) => {
                let snap = proposal().map(|(index, _)| SNAPS[usize::from(index)]);
                return Err(ModelFault::NearlyParallel { axes, off, distance, bound, snap }.into());
            }
            other => other?,
        };
        let remarks = self.remarks.iter().take(if snap.is_none() { 2 } else { 1 });
        let remarks: Vec<_> = remarks.filter(|it| !it.is_empty()).cloned().collect();
        let labels = (self.joint_names.clone(), remarks.join(", "));
        let arm = Arm::from(self.limited(robot.with_labels(Some(labels)))?);
        let arm = self.carried(arm, snap)?;
        match &self.solids {
            Ok((solids, remark)) => {
                let body = body_of(&arm, solids, &self.joints, snap, remark);
                arm.with_body(body)
            }
            Err(fault) => Ok(arm.without_body(fault.to_string())),
        }
    }

    /// The arm on its rail, if it has one: at zero, or at the limit nearest to it.
    fn carried<const N: usize>(&self, arm: Arm<N>, snap: Option<f64>) -> Result<Arm<N>, Error> {
        let Some(Placed { motion: Some(motion), .. }) = self.rail.last() else { return Ok(arm) };
        let [lower, upper] = motion.limits;
        let direction = snapped_direction(motion.direction, snap.unwrap_or(0.0)).into();
        let track = ExternalAxis::rail(direction, motion.limits, motion.velocity.unwrap_or(1.0));
        let track =
            track.map_err(|_| UrdfFault::Rail { joint: self.slide.clone(), lower, upper })?;
        let base = self.rail.iter().fold(Pose::identity(), |base, joint| base * joint.origin(snap));
        let mut arm = arm.map(|robot| robot.with_base(&base))?;
        arm.rail = Some(Rail { track, position: 0.0 });
        arm.at(0.0_f64.clamp(lower, upper))
    }

    fn table<const N: usize>(&self, snap: Option<f64>) -> Result<Mdh<N>, Error> {
        let (axes, t_base_tip) = self.axes(snap)?;
        let axes = <[JointAxis; N]>::try_from(axes)
            .map_err(|axes| ModelFault::JointCount { found: axes.len(), wanted: N })?;
        Ok(Mdh::from_joint_axes(&axes, &t_base_tip)?)
    }

    fn robot<const N: usize>(&self, snap: Option<f64>) -> Result<Robot<N>, Error>
    where
        Robot<N>: Joints<N>,
    {
        Ok(Robot::of_table(self.table(snap)?)?)
    }

    /// The axes of the joints that turn, and the tip, both in the base at zero joint angles.
    fn axes(&self, snap: Option<f64>) -> Result<(Vec<JointAxis>, Pose), UrdfFault> {
        let mut t_base_tip = Pose::identity();
        let mut axes = Vec::new();
        let mut linkage = None;
        for joint in &self.joints {
            t_base_tip *= joint.origin(snap);
            axes.extend(
                joint.motion.as_ref().map(|motion| axis(motion.direction, &t_base_tip, snap)),
            );
            if let Some(found) = &joint.linkage {
                linkage = Some((axis(found.direction, &t_base_tip, snap), found));
                t_base_tip *= found.turned(snap.unwrap_or(0.0));
            }
        }
        match (linkage, &axes[..]) {
            (Some((axis, linkage)), [_, second, third, ..])
                if !(are_on_one_line(&axis, third) && turn_alike(&axis, second)) =>
            {
                Err(linkage.fault.clone())
            }
            _ => Ok((axes, t_base_tip)),
        }
    }

    /// The robot under its name, with limits and velocities.
    fn limited<const N: usize>(&self, robot: Robot<N>) -> Result<Robot<N>, Error> {
        let (mut limits, mut velocities, mut all_known) = ([[0.0; 2]; N], [0.0; N], true);
        for (i, motion) in self.motions().enumerate().take(N) {
            limits[i] = motion.limits;
            velocities[i] = motion.velocity.unwrap_or(f64::INFINITY);
            all_known &= motion.velocity.is_some();
        }
        let mut robot = robot;
        if let Some(linkage) = self.joints.iter().find_map(|joint| joint.linkage.as_ref()) {
            robot = robot.coupled()?.with_linkage_limits(linkage.limits)?;
        }
        let robot = robot
            .with_name(self.name.clone())
            .with_limits(JointLimits::new(limits)?)
            .with_max_velocity(all_known.then_some(velocities))?;
        Ok(robot)
    }
}

/// How far exact right angles move and turn the tool in any posture, in words. Where that is more
/// than `MOST_SHIFT`, the angles of the text are kept.
fn check_rounding(joints: &mut [Placed]) -> String {
    /// The farthest that the tool may be moved unasked [m]: less than calibrations move it.
    const MOST_SHIFT: f64 = 1e-4;
    let mut moves = 0.0;
    let mut turns = 0.0;
    let mut reach = 0.0;
    for joint in joints.iter().rev() {
        let errors = Vector3::from(joint.exact_rpy) - Vector3::from(joint.rpy);
        turns += errors.abs().sum();
        moves += errors.abs().sum() * reach;
        reach += Vector3::from(joint.xyz).norm();
    }
    let shift = format!("the tool by up to {moves:.1e} m, {turns:.1e} rad");
    if turns <= FORM_TOLERANCE {
        return String::new();
    }
    if moves <= MOST_SHIFT {
        return format!("rounded right angles made exact, which moves {shift} (snap=0 keeps them)");
    }
    for joint in joints {
        joint.exact_rpy = joint.rpy;
    }
    format!("rounded right angles kept: exact ones would move {shift} (snap= makes them exact)")
}

/// Whether two axes are on one line, in whatever sense.
fn are_on_one_line(one: &JointAxis, two: &JointAxis) -> bool {
    let [direction, other] = [one, two].map(|axis| Vector3::from(axis.direction));
    let between = Vector3::from(two.point) - Vector3::from(one.point);
    [other, between].iter().all(|along| direction.cross(along).norm() <= FORM_TOLERANCE)
}

/// Whether two axes, parallel or nearly so, turn in one sense.
fn turn_alike(one: &JointAxis, two: &JointAxis) -> bool {
    Vector3::from(one.direction).dot(&Vector3::from(two.direction)) > 0.0
}
