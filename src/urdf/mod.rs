//! Robots from URDF: the chain between two links as joint axes, limits and velocities.
//!
//! Reference: ROS wiki, urdf/XML/robot, link and joint.

mod chain;
mod joint;
mod shape;
mod tree;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use self::chain::chain_between;
use self::joint::Motion;
use self::tree::{Tree, parsed};
use crate::error::{Error, ModelFault};
use crate::kinematics::{JointAxis, JointLimits, Mdh, Pose, Robot};

impl<const N: usize> Robot<N> {
    /// A robot from the text of a URDF, with the closed form of its geometry.
    ///
    /// `base` is the link in whose frame poses are given: the one without a parent when not given. `tip` is the link that poses are of: when
    /// not given, the only one at the end of a chain of `N` revolute joints. Joints count from base to tip; what is fixed between them, and
    /// what is not between them, is none. A joint turns the way its axis points. Limits and velocities are those of the text; a velocity
    /// that is absent or zero is unknown, and one unknown leaves the robot without velocities.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when the text is no URDF, `base` or `tip` are no links of a chain of `N` revolute joints or several links
    /// could be meant, or, for six axes, the arm has no known form. [`Robot::serial_chain_from_urdf`] takes such an arm without its inverse.
    pub fn from_urdf(text: &str, base: Option<&str>, tip: Option<&str>) -> Result<Self, Error> {
        UrdfArm::read(text, base, tip, &[N])?.robot(true)
    }

    /// As [`Robot::from_urdf`]: with the closed form where the geometry has one, without where not.
    ///
    /// # Errors
    ///
    /// As [`Robot::from_urdf`], but for an arm that has no known form.
    pub fn serial_chain_from_urdf(
        text: &str,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> Result<Self, Error> {
        UrdfArm::read(text, base, tip, &[N])?.robot(false)
    }
}

/// An arm as a URDF has it, with however many joints.
pub(crate) struct UrdfArm {
    name: String,
    motions: Vec<Motion>,
    t_base_tip: Pose,
}

impl UrdfArm {
    /// Reads the chain between two links; its number of joints must be one of `wanted`.
    pub(crate) fn read(
        text: &str,
        base: Option<&str>,
        tip: Option<&str>,
        wanted: &[usize],
    ) -> Result<Self, Error> {
        let (document, skipped) = parsed(text)?;
        let tree = Tree::new(&document, skipped)?;
        let mut t_base_tip = Pose::identity();
        let mut motions = Vec::new();
        for joint in chain_between(&tree, base, tip, wanted)? {
            t_base_tip *= joint.origin()?;
            motions.extend(joint.motion(&t_base_tip)?);
        }
        Ok(Self { name: tree.name.to_string(), motions, t_base_tip })
    }

    /// Number of joints.
    #[cfg(feature = "python")]
    pub(crate) fn dof(&self) -> usize {
        self.motions.len()
    }

    /// The robot, which must have `N` joints; without `closed_form` an arm of no known form is taken too.
    pub(crate) fn robot<const N: usize>(self, closed_form: bool) -> Result<Robot<N>, Error> {
        let found = self.motions.len();
        let motions = <[Motion; N]>::try_from(self.motions)
            .map_err(|_| ModelFault::JointCount { found, wanted: N })?;
        let axes: [JointAxis; N] = core::array::from_fn(|i| motions[i].axis);
        let mdh = Mdh::from_joint_axes(&axes, &self.t_base_tip)?;
        let robot = if closed_form { Robot::from_mdh(mdh)? } else { Robot::serial_chain(mdh)? };
        let mut velocities = [0.0; N];
        let mut all_known = true;
        for (velocity, motion) in velocities.iter_mut().zip(&motions) {
            all_known &= motion.velocity.is_some();
            *velocity = motion.velocity.unwrap_or(f64::INFINITY);
        }
        robot
            .with_name(self.name)
            .with_limits(JointLimits::new(core::array::from_fn(|i| motions[i].limits))?)
            .with_max_velocity(all_known.then_some(velocities))
    }
}
