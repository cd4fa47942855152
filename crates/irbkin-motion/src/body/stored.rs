//! A body as serde reads and writes it: the name of the catalog's arm, or its capsules.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::arms::body_of;
use super::links::Body;
use crate::body::fault::BodyFault;
use crate::prelude::*;

#[derive(Serialize, Deserialize)]
#[serde(rename = "Body")]
enum Stored {
    OfArm(String),
    GivenBody(#[serde(with = "Body")] Body),
}

impl Serialize for Body {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.arm {
            Some(arm) => Stored::OfArm(arm.to_string()),
            None => Stored::GivenBody(self.clone()),
        }
        .serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Stored::deserialize(deserializer)? {
            Stored::OfArm(arm) => body_of(&arm).ok_or_else(|| D::Error::custom(BodyFault::NoBody)),
            Stored::GivenBody(body) => {
                body.check_pairs().map_err(D::Error::custom)?;
                Ok(body)
            }
        }
    }
}
