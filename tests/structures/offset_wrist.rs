//! Arms with an offset wrist.

use irbkin::Mdh;

use super::Structure;
use super::by_table::{named, structure as of_tables, subject, table};
use crate::rng::Rng;

/// Not a real arm: every parameter has an effect.
pub const ODD: [[f64; 4]; 6] = [
    [20.0, 0.1, 0.2755, 30.0],
    [90.0, 0.1, 0.02, 10.0],
    [0.0, -0.41, -0.07, 20.0],
    [70.0, 0.05, -0.3, 30.0],
    [50.0, 0.0, -0.0741, 40.0],
    [40.0, 0.07, -0.16, 50.0],
];

/// Kinova's JACO2 with its lateral offset.
pub const JACO2: [[f64; 4]; 6] = [
    [0.0, 0.0, 0.2755, 0.0],
    [90.0, 0.0, 0.0, 0.0],
    [180.0, 0.41, 0.0098, 0.0],
    [90.0, 0.0, -0.2073, 0.0],
    [60.0, 0.0, -0.0741, 0.0],
    [60.0, 0.0, -0.16, 0.0],
];

/// Arms that are drawn.
const RANDOM: usize = 12;

pub fn structure() -> Structure<6> {
    let gofas = ["CRB 15000-5/0.95", "CRB 15000-10/1.52", "CRB 15000-12/1.27"];
    let makers = gofas.into_iter().chain(["CRX-10iA/L", "CRX-10iA", "xArm6"]);
    let others = [("JACO2", JACO2), ("odd", ODD)].map(|(name, rows)| subject(name, table(rows)));
    let subjects = makers.map(named).chain(others).collect();
    let mut rng = Rng::new(0x0ff5);
    of_tables("offset wrist", subjects, (0..RANDOM).map(move |_| random(&mut rng)))
}

/// Any arm with axis 2 at a right angle to axis 1, parallel to axis 3, and axes 4 and 5 meeting.
fn random(rng: &mut Rng) -> Mdh<6> {
    let mut rows: [[f64; 4]; 6] = std::array::from_fn(|_| {
        let alpha = rng.sign() * rng.between(25.0, 155.0);
        let lengths = [(); 2].map(|()| rng.sign() * rng.between(0.05, 0.5));
        [alpha, lengths[0], lengths[1], rng.angle().to_degrees()]
    });
    rows[1][0] = 90.0 * rng.sign();
    rows[2][0] = if rng.unit() < 0.5 { 0.0 } else { 180.0 };
    rows[4][1] = 0.0;
    table(rows)
}
