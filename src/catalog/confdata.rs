//! Arms whose controllers count configurations in a way of their own.
//!
//! This is known of these arms, not of their structure: other makers' arms with the same axes have
//! no confdata.

use super::CatalogArm;
use crate::report::ConfigurationRule;

/// Type names of the GoFa family, with the part before the payload.
const GOFA: &str = "CRB 15000-";

impl CatalogArm {
    /// How the controller of the arm counts configurations, if in a way of its own:
    /// docs/guide/abb.md.
    #[must_use]
    pub fn own_configuration_rule(&self) -> Option<ConfigurationRule> {
        match self.name {
            "IRB 14000-0.5/0.5 (left)" => Some(outward(-1.0)),
            "IRB 14000-0.5/0.5 (right)" | "IRB 14050-0.5/0.5" => Some(outward(1.0)),
            name if name.starts_with(GOFA) => Some(ConfigurationRule::OffsetWrist),
            _ => None,
        }
    }
}

/// Where an arm of a YuMi counts its arm angle from, in the frame of the body: its outer side.
const fn outward(y: f64) -> ConfigurationRule {
    ConfigurationRule::ArmAngle { reference: [0.0, y, 0.0] }
}
