//! An arm as serde reads and writes it: its robot, its body and its rail.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Arm;
use crate::body::Body;
use crate::plan::ExternalAxis;
use crate::plan::rail::Rail;
use irbkin::{Joints, Robot};

#[derive(Serialize, Deserialize)]
#[serde(rename = "Arm")]
struct Stored<R, B> {
    robot: R,
    body: Option<B>,
    /// Direction, limits, velocity and position.
    rail: Option<([f64; 3], [f64; 2], f64, f64)>,
}

impl<const N: usize> Serialize for Arm<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rail = self.rail.as_ref().map(|Rail { track, position }| {
            (track.direction(), track.range(), track.max_velocity(), *position)
        });
        Stored { robot: self.robot(), body: self.body(), rail }.serialize(serializer)
    }
}

impl<'de, const N: usize> Deserialize<'de> for Arm<N>
where
    Robot<N>: Joints<N>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Stored { robot, body, rail } = Stored::<Robot<N>, Body>::deserialize(deserializer)?;
        let mut arm = Self::from(robot).with_body(body).map_err(D::Error::custom)?;
        let Some((direction, range, velocity, position)) = rail else { return Ok(arm) };
        let track = ExternalAxis::rail(direction, range, velocity).map_err(D::Error::custom)?;
        arm.rail = Some(Rail { track, position });
        arm.at(position).map_err(D::Error::custom)
    }
}
