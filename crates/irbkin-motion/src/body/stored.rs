//! A body as serde reads and writes it: the name of the catalog's arm, or its capsules.

use alloc::borrow::Cow;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::arms::body_of;
use super::links::{Body, LinkCapsule, LinkHull};
use crate::body::fault::BodyFault;

#[derive(Serialize, Deserialize)]
#[serde(rename = "Body")]
enum Stored {
    OfArm(String),
    GivenBody(GivenBody),
}

#[derive(Serialize, Deserialize)]
struct GivenBody {
    links: Vec<LinkCapsule>,
    parts: Vec<LinkCapsule>,
    #[serde(default)]
    hulls: Vec<LinkHull>,
    pairs: Vec<[usize; 2]>,
    source: String,
    excess: Vec<f64>,
    is_approximate: bool,
}

impl Serialize for Body {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.arm {
            Some(arm) => Stored::OfArm(arm.to_string()),
            None => Stored::GivenBody(GivenBody {
                links: self.links.clone(),
                parts: self.parts.clone(),
                hulls: self.hulls.clone(),
                pairs: self.pairs.clone(),
                source: self.source().to_string(),
                excess: self.excess.clone(),
                is_approximate: self.is_approximate,
            }),
        }
        .serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Stored::deserialize(deserializer)? {
            Stored::OfArm(arm) => body_of(&arm).ok_or_else(|| D::Error::custom(BodyFault::NoBody)),
            Stored::GivenBody(GivenBody {
                links,
                parts,
                hulls,
                pairs,
                source,
                excess,
                is_approximate,
            }) => {
                let (arm, source) = (None, Cow::Owned(source));
                let body = Self { arm, links, parts, hulls, pairs, source, excess, is_approximate };
                body.check_pairs().map_err(D::Error::custom)?;
                Ok(body)
            }
        }
    }
}
