//! The configuration of a joint vector: pure functions of the joint angles (docs/guide/abb.md).

use core::f64::consts::FRAC_PI_2;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::robot::Robot;
use crate::kinematics::thresholds::MOST_ANGLE;
use crate::lanes::{nearest_whole, whole_below};
use crate::report::{Configuration, ConfigurationRule};

/// Largest number of quarter turns of an angle within [`MOST_ANGLE`].
#[expect(clippy::cast_possible_truncation, reason = "some ten thousands")]
const MOST_QUARTERS: i32 = (MOST_ANGLE / FRAC_PI_2) as i32;

/// ABB's axis 3 of a YuMi below which its elbow counts as bent backwards [rad]: controllers' data
/// put it between -88.5 and -64.8 deg; -75 deg is in the middle, 3 deg from where the elbow is
/// stretched.
const YUMI_ELBOW: f64 = -75.0 * core::f64::consts::PI / 180.0;

/// How a rule counts quarter turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quarters {
    /// The joints of ABB's axes 1, 4 and 6, from 0.
    pub(super) joints: [usize; 3],
    /// Where quarter 0 begins [quarter turns].
    begin: f64,
}

impl Quarters {
    pub(super) const fn of(rule: &ConfigurationRule) -> Self {
        match rule {
            ConfigurationRule::SphericalWrist | ConfigurationRule::OffsetWrist => {
                Self { joints: [0, 3, 5], begin: 0.0 }
            }
            // The order of the axes from the base is 1, 2, 7, 3, 4, 5, 6.
            ConfigurationRule::ArmAngle { .. } => Self { joints: [0, 4, 6], begin: -0.5 },
        }
    }

    /// The quarter turn of an angle; of an edge, the one that begins there. An angle that differs
    /// from an edge only by the rounding of degrees to radians counts as that edge.
    #[expect(clippy::cast_possible_truncation, reason = "no more than MOST_QUARTERS")]
    fn quarter(&self, angle: f64) -> i32 {
        let quarters = angle / FRAC_PI_2 - self.begin;
        let edge = nearest_whole(quarters);
        if (quarters - edge).abs() <= 2.0 * f64::EPSILON * edge.abs().max(self.begin.abs()) {
            edge as i32
        } else {
            whole_below(quarters) as i32
        }
    }

    /// The ranges [rad] that a configuration permits for its joints, widened by `edge` [rad].
    pub(super) fn ranges(&self, wanted: Configuration, edge: f64) -> [(usize, [f64; 2]); 3] {
        let quarters = [wanted.cf1, wanted.cf4, wanted.cf6].map(f64::from);
        core::array::from_fn(|i| {
            let from = quarters[i] + self.begin;
            (self.joints[i], [from * FRAC_PI_2 - edge, (from + 1.0) * FRAC_PI_2 + edge])
        })
    }
}

impl Configuration {
    /// Check that the arm can have a configuration with these numbers.
    pub(crate) fn check(&self, coupled: bool) -> Result<(), Error> {
        let quarters = [-MOST_QUARTERS, MOST_QUARTERS];
        let slots = if coupled { [0, 0] } else { [0, 7] };
        for (field, value, bounds) in [
            ("cf1", self.cf1, quarters),
            ("cf4", self.cf4, quarters),
            ("cf6", self.cf6, quarters),
            ("cfx", self.cfx, slots),
        ] {
            if value < bounds[0] || value > bounds[1] {
                return Err(JointFault::Configuration { field, value, bounds }.into());
            }
        }
        Ok(())
    }
}

impl<const N: usize> Robot<N> {
    /// How the controller of this arm counts configurations.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] for an arm without a spherical wrist that is not a GoFa or YuMi of
    /// the catalog: its controller counts in another way, or not at all.
    pub fn configuration_rule(&self) -> Result<ConfigurationRule, Error> {
        if let Some(rule) = self.own_rule() {
            return Ok(rule);
        }
        if self.singular_wrist().is_some() {
            return Ok(ConfigurationRule::SphericalWrist);
        }
        let snap = self.missing_form().and_then(|missing| missing.snap());
        Err(ModelFault::NoConfiguration { structure: self.structure(), snap }.into())
    }

    /// ABB's confdata of a joint vector [rad]. On the edge of a quarter turn, the one that begins
    /// there counts.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] when an angle is not finite or exceeds [`MOST_ANGLE`];
    /// [`Error::InvalidModel`] as [`Robot::configuration_rule`].
    pub fn configuration(&self, q: &[f64; N]) -> Result<Configuration, Error> {
        let rule = self.configuration_rule()?;
        check_seed("q", q)?;
        Ok(self.counted_by(&rule, q))
    }

    /// The joints of ABB's axes 1, 4 and 6, from 0, and where their quarter 0 begins [rad].
    #[doc(hidden)]
    pub fn counted_joints(&self) -> Result<([usize; 3], f64), Error> {
        let Quarters { joints, begin } = Quarters::of(&self.configuration_rule()?);
        Ok((joints, begin * FRAC_PI_2))
    }

    pub(super) fn counted_by(&self, rule: &ConfigurationRule, q: &[f64; N]) -> Configuration {
        let quarters = Quarters::of(rule);
        let [cf1, cf4, cf6] = quarters.joints.map(|joint| quarters.quarter(q[joint]));
        let cfx = match rule {
            ConfigurationRule::SphericalWrist if self.is_coupled() => 0,
            ConfigurationRule::SphericalWrist => {
                self.slot_of(q).map_or(0, crate::kinematics::Slot::number)
            }
            _ => self.sides(rule, q).iter().fold(0, |bits, side| 2 * bits + i32::from(*side < 0.0)),
        };
        Configuration { cf1, cf4, cf6, cfx }
    }

    /// The three quantities, angles [rad] or parts of the arm's length [1], whose signs are the
    /// bits 4, 2 and 1 of cfx (docs/guide/abb.md, eq. A1 to A3).
    pub(super) fn sides(&self, rule: &ConfigurationRule, q: &[f64; N]) -> [f64; 3] {
        let ([_, second, third, fourth, fifth, rest @ ..], [_, axis_2, axis_3, axis_4, ..]) =
            (&q[..], &self.mdh().rows[..])
        else {
            return [0.0; 3];
        };
        if let ConfigurationRule::ArmAngle { .. } = rule {
            return [*second, fourth - YUMI_ELBOW, rest.first().copied().unwrap_or(0.0)];
        }
        let (upper, forearm, offset) = (axis_3.a, axis_4.d, axis_4.a);
        let ahead = |angle: f64| forearm * angle.cos() + offset * angle.sin();
        let length = forearm.hypot(offset);
        let shoulder = axis_2.a + upper * second.sin() + ahead(second + third);
        [shoulder / (axis_2.a.abs() + upper.abs() + length), ahead(*third) / length, *fifth]
    }
}
