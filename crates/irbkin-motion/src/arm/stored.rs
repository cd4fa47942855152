//! An arm as serde reads and writes it: its robot and its body.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Arm;
use crate::body::Body;
use irbkin::{Joints, Robot};

#[derive(Serialize, Deserialize)]
#[serde(rename = "Arm")]
struct Stored<R, B> {
    robot: R,
    body: Option<B>,
}

impl<const N: usize> Serialize for Arm<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Stored { robot: self.robot(), body: self.body() }.serialize(serializer)
    }
}

impl<'de, const N: usize> Deserialize<'de> for Arm<N>
where
    Robot<N>: Joints<N>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Stored { robot, body } = Stored::<Robot<N>, Body>::deserialize(deserializer)?;
        Self::from(robot).with_body(body).map_err(D::Error::custom)
    }
}
