//! Arms of which the tests know the table alone: their slots are ordinals.

use irbkin::{DhRow, JointLimits, Mdh, Pose, Robot, Solution, Solutions};
use proptest::prelude::*;
use proptest::sample::Index;

use super::place::{At, Made, Place, Verdict};
use super::{Arm, SIX, Structure, Subject};
use crate::rng::Rng;

/// An arm by its table. The robot is prepared once.
#[derive(Clone, Debug)]
pub struct TableArm(pub Robot<6>);

impl From<Mdh<6>> for TableArm {
    fn from(mdh: Mdh<6>) -> Self {
        Self(Robot::from_mdh(mdh).unwrap())
    }
}

/// A table of alpha [deg], a [m], d [m], theta [deg].
pub fn table(rows: [[f64; 4]; 6]) -> Mdh<6> {
    let row =
        |[alpha, a, d, theta]: [f64; 4]| DhRow::new(alpha.to_radians(), a, d, theta.to_radians());
    Mdh { base: Pose::identity(), rows: rows.map(row), flange: Pose::identity() }
}

/// The same arm, its joints zero elsewhere: `zero[i]` of the new joint i is zero of the old one.
pub fn with_zeros_at(mut mdh: Mdh<6>, zeros: [f64; 6]) -> Mdh<6> {
    for (row, zero) in mdh.rows.iter_mut().zip(zeros) {
        row.theta -= zero;
    }
    mdh
}

/// These arms, the robots of which may have limits, and random ones.
///
/// Preparing a robot takes milliseconds: random ones are drawn once.
pub fn structure(
    name: &'static str,
    subjects: Vec<Subject<6>>,
    random: impl Iterator<Item = Mdh<6>>,
) -> Structure<6> {
    let first = subjects[0].robot.mdh().clone();
    let many_turns = with_zeros_at(first, [50.0, -49.0, 31.4, -3.2, 12.5, 7.0]);
    let random: Vec<_> = random.map(|mdh| subject("random", mdh)).collect();
    Structure {
        name,
        subjects,
        many_turns: subject("zeros of many turns", many_turns),
        random: any::<Index>().prop_map(move |index| index.get(&random).clone()).boxed(),
    }
}

pub fn subject(name: &str, mdh: Mdh<6>) -> Subject<6> {
    Subject::new(name, TableArm::from(mdh), &SIX)
}

/// An arm of the catalog, with its limits.
pub fn named(name: &str) -> Subject<6> {
    let robot = Robot::<6>::named(name).unwrap();
    Subject::new(name, TableArm(robot.clone().with_limits(JointLimits::UNLIMITED)), &SIX)
        .with_robot(|_| robot)
}

impl Arm<6> for TableArm {
    fn robot(&self) -> Robot<6> {
        self.0.clone()
    }

    fn reach(&self) -> f64 {
        let mdh = self.0.mdh();
        let ends = [mdh.base, mdh.flange].map(|end| end.translation.vector.norm());
        let rows = mdh.rows.iter().map(|row| row.a.abs() + row.d.abs());
        rows.chain(ends).sum()
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        *q
    }

    fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        theta
    }

    /// No joint vector tells its ordinal.
    fn slot(&self, _theta: &[f64; 6]) -> usize {
        0
    }

    fn has_slots(&self) -> bool {
        false
    }

    fn determinant(&self, robot: &Robot<6>, q: &[f64; 6]) -> f64 {
        robot.jacobian_determinant(q).unwrap()
    }

    fn wrist_flip(&self, _slots: [&Solution<6>; 2]) -> Result<(), String> {
        Err("the wrist is not spherical".into())
    }

    /// Twenty roundings, each 2e-15 of the lengths: those between joints 1 and 6 are the unit of
    /// angles.
    fn closure(&self, reach: f64) -> [f64; 2] {
        let rows = &self.0.mdh().rows;
        let between: f64 = (1..6).map(|i| rows[i].a.abs() + rows[i - 1].d.abs()).sum();
        let between = between - rows[0].d.abs();
        [4e-14 * reach, 8e-14 * reach / between]
    }

    fn singular_places(&self) -> &'static [At] {
        &[]
    }

    fn at(&self, _place: &Place, _rng: &mut Rng) -> Option<[f64; 6]> {
        None
    }

    fn beyond(&self, _beyond: f64, _rng: &mut Rng) -> Option<Made<6>> {
        None
    }

    fn judge(&self, _: &Robot<6>, _: &Made<6>, _: &Solutions<6>, _: &mut Rng) -> Verdict {
        Verdict::default()
    }
}
