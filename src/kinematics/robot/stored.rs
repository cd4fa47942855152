//! A robot as serde reads and writes it: its definition and its settings. Reading builds it anew,
//! with every check of the constructors.

use alloc::string::String;
use alloc::vec::Vec;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::build::check_heading_tolerance;
use super::{Definition, Joints, Robot, display};
use crate::error::{Error, ModelFault};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::report::ConfigurationRule;

#[derive(Serialize, Deserialize)]
#[serde(rename = "Robot")]
struct Stored<const N: usize> {
    name: String,
    definition: Definition<N>,
    coupled: bool,
    limits: JointLimits<N>,
    base: Pose,
    tool: Pose,
    /// `None` for a joint whose velocity is not limited: text has no infinity.
    max_velocity: Option<Vec<Option<f64>>>,
    /// How its controller counts configurations, if in a way of its own.
    #[serde(default)]
    rule: Option<ConfigurationRule>,
    /// The joint that is locked, from 1, and its angle [rad].
    #[serde(default)]
    locked: Option<(usize, f64)>,
    /// Of an arm of five axes [rad].
    #[serde(default)]
    heading_tolerance: Option<f64>,
    /// The names of its joints in its file, and a remark on its tip.
    #[serde(default)]
    labels: Option<display::Labels>,
}

impl<const N: usize> Serialize for Robot<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let finite = |velocity: &f64| velocity.is_finite().then_some(*velocity);
        Stored {
            name: self.name().into(),
            definition: self.definition().clone(),
            coupled: self.is_coupled(),
            limits: *self.limits(),
            base: *self.base(),
            tool: *self.tool(),
            max_velocity: self.max_velocity().map(|all| all.iter().map(finite).collect()),
            rule: self.own_rule(),
            locked: self.locked_joint(),
            heading_tolerance: (N == 5).then(|| self.chain.heading_tolerance()),
            labels: self.labels.as_deref().cloned(),
        }
        .serialize(serializer)
    }
}

impl<'de, const N: usize> Deserialize<'de> for Robot<N>
where
    Self: Joints<N>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Stored::deserialize(deserializer)?.build().map_err(D::Error::custom)
    }
}

impl<const N: usize> Stored<N>
where
    Robot<N>: Joints<N>,
{
    fn build(self) -> Result<Robot<N>, Error> {
        let mut robot = Robot::of_definition(self.definition)?.with_rule(self.rule);
        if let Some(tolerance) = self.heading_tolerance {
            check_heading_tolerance(tolerance)?;
            robot.chain = robot.chain.with_heading_tolerance(tolerance);
        }
        if self.coupled {
            robot.check_linkage()?;
            robot = robot.with_coupling(true);
        }
        let max_velocity = self.max_velocity.map(|all| {
            let all: Vec<f64> = all.iter().map(|one| one.unwrap_or(f64::INFINITY)).collect();
            let joint_count = |found: usize| ModelFault::JointCount { found, wanted: N };
            <[f64; N]>::try_from(all).map_err(|all| joint_count(all.len()))
        });
        robot
            .with_labels(self.labels)
            .with_name(self.name)
            .with_limits(self.limits)
            .with_linkage_limits(self.limits.linkage())?
            .with_max_velocity(max_velocity.transpose()?)?
            .with_base(&self.base)?
            .with_tool(&self.tool)?
            .with_lock(self.locked)
    }
}
