//! The request for a solution besides its pose: its configuration, and what completes it.

use crate::error::Error;
use crate::kinematics::answer::check::{check_arm_angle, check_seed};
use crate::report::Configuration;

/// A configuration, with what a pose and a configuration may leave open.
///
/// ```
/// use irbkin::{Configuration, ConfigurationRequest};
///
/// let configuration = Configuration { cf1: 0, cf4: -1, cf6: 0, cfx: 0 };
/// let of_gofa = ConfigurationRequest::from(configuration).near([0.0; 6]);
/// let of_yumi = ConfigurationRequest::<7>::from(configuration).at_arm_angle(1.2);
/// # assert!(of_gofa.arm_angle.is_none() && of_yumi.seed.is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfigurationRequest<const N: usize> {
    /// The configuration.
    pub configuration: Configuration,
    /// The arm angle of a YuMi [rad].
    pub arm_angle: Option<f64>,
    /// If a configuration names more than one solution, the one nearest to these joint angles [rad]
    /// is meant; `None` for angles of zero, or the middle of limits without zero.
    pub seed: Option<[f64; N]>,
    /// Whether the solution nearest to the seed is meant if none has the configuration.
    pub or_nearest: bool,
}

impl<const N: usize> From<Configuration> for ConfigurationRequest<N> {
    fn from(configuration: Configuration) -> Self {
        Self { configuration, arm_angle: None, seed: None, or_nearest: false }
    }
}

impl<const N: usize> ConfigurationRequest<N> {
    /// With the arm angle of a YuMi [rad].
    #[must_use]
    pub fn at_arm_angle(self, arm_angle: f64) -> Self {
        Self { arm_angle: Some(arm_angle), ..self }
    }

    /// Of several solutions with the configuration, the one nearest to `seed` [rad].
    #[must_use]
    pub fn near(self, seed: [f64; N]) -> Self {
        Self { seed: Some(seed), ..self }
    }

    /// As [`Self::near`] and, if no solution has the configuration, the nearest one of all: many
    /// programs contain `[0, 0, 0, 0]` without having computed it.
    #[must_use]
    pub fn or_nearest(self, seed: [f64; N]) -> Self {
        Self { seed: Some(seed), or_nearest: true, ..self }
    }

    /// Check the seed and the arm angle.
    #[doc(hidden)]
    pub fn check(&self) -> Result<(), Error> {
        if let Some(angle) = self.arm_angle {
            check_arm_angle(angle)?;
        }
        self.seed.map_or(Ok(()), |seed| check_seed("seed", &seed))
    }
}
