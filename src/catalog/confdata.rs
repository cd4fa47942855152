//! Arms whose controllers count configurations in a way of their own.
//!
//! This is known of these arms, not of their structure: other makers' arms with the same axes have
//! no confdata.

use super::CatalogArm;
use super::abb::YUMI_RULES;
use crate::report::ConfigurationRule;

/// Type names of the GoFa family, with the part before the payload.
const GOFA: &str = "CRB 15000-";

impl CatalogArm {
    /// How the controller of the arm counts configurations, if in a way of its own:
    /// docs/guide/abb.md.
    #[must_use]
    pub fn own_configuration_rule(&self) -> Option<ConfigurationRule> {
        if self.maker == "ABB" && self.name.starts_with(GOFA) {
            return Some(ConfigurationRule::OffsetWrist);
        }
        YUMI_RULES.into_iter().find(|(name, _)| *name == self.name).map(|(_, rule)| rule)
    }
}
