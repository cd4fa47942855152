//! How much room joint angles leave: to limits, and to singularities.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::Robot;
use crate::kinematics::chain::limits::JointLimits;
use crate::lanes::nearest_whole;

/// How far joint angles are from limits and singularities, each as a part of the farthest that they
/// can be: 1 in the middle, 0 at one, negative outside limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Margin {
    /// The least over all joints of 1 - |q - middle| / half the range, and the same of the linkage
    /// of coupled axes 2 and 3.
    pub limits: f64,
    /// The least of three distances, each at most 1: that from the wrist singularity and that from
    /// the elbow singularity as a part of 90 deg, and that from the shoulder singularity as a part
    /// of half the length of upper arm and forearm. NaN if the structure of the arm is unknown.
    pub singularities: f64,
}

impl Margin {
    /// The smaller one.
    #[must_use]
    pub fn least(&self) -> f64 {
        // NaN is not smaller.
        self.limits.min(self.singularities)
    }
}

impl<const N: usize> Robot<N> {
    /// How far `q` [rad] is from limits and singularities.
    #[must_use]
    pub fn margin(&self, q: &[f64; N]) -> Margin {
        let singularities = self.of_singularities(q);
        Margin {
            limits: of_limits(&self.limits, q).fold(1.0, f64::min),
            singularities: singularities
                .map_or(f64::NAN, |each| each.into_iter().fold(1.0, f64::min)),
        }
    }

    /// How near `q` is to each limit and to each singularity: the sums of the squares of 1 minus
    /// its margin.
    pub(crate) fn nearness(&self, q: &[f64; N]) -> [f64; 2] {
        let square = |margin: f64| (1.0 - margin.min(1.0)) * (1.0 - margin.min(1.0));
        let singularities = self.of_singularities(q).unwrap_or([1.0; 3]);
        [of_limits(&self.limits, q).map(square).sum(), singularities.into_iter().map(square).sum()]
    }

    /// The margins to the singularities of wrist, elbow and shoulder; some are more than 1.
    fn of_singularities(&self, q: &[f64; N]) -> Option<[f64; 3]> {
        let distances = self.singular_distances(q)?;
        let shoulder = distances.shoulder / (0.5 * self.reach_of_wrist());
        Some([distances.wrist / FRAC_PI_2, distances.elbow / FRAC_PI_2, shoulder])
    }

    /// [`Self::margin`] with each joint at the 2 pi equivalent that leaves the most room.
    pub(crate) fn margin_of_any_turn(&self, q: &[f64; N]) -> Margin {
        self.margin(&centered(&self.limits, q))
    }

    /// Length of upper arm and forearm: of all links between axis 1 and the wrist [m].
    fn reach_of_wrist(&self) -> f64 {
        self.mdh().rows.iter().skip(1).take(3).map(|row| row.a.abs() + row.d.abs()).sum()
    }
}

/// 1 - |q - middle| / half the range of each joint, and of the linkage at its best 2 pi equivalent.
fn of_limits<const N: usize>(limits: &JointLimits<N>, q: &[f64; N]) -> impl Iterator<Item = f64> {
    let linkage = limits.linkage().map(|range| part_of_half(range, limits.linkage_overrun(q)));
    let joints = limits.to_array().into_iter().zip(q).map(|(range, angle)| {
        let [lower, upper] = range;
        part_of_half(range, (lower - angle).max(angle - upper))
    });
    joints.chain(linkage)
}

/// The room to the nearer end of a range as a part of its half. One that has no ends, or no width,
/// does not count.
fn part_of_half([lower, upper]: [f64; 2], excess: f64) -> f64 {
    let half = 0.5 * (upper - lower);
    if half > 0.0 && half.is_finite() { -excess / half } else { 1.0 }
}

/// Each angle at its 2 pi equivalent nearest to the middle of its limits.
fn centered<const N: usize>(limits: &JointLimits<N>, q: &[f64; N]) -> [f64; N] {
    let ranges = limits.to_array();
    core::array::from_fn(|joint| {
        let [lower, upper] = ranges[joint];
        let turn = nearest_whole((0.5 * (lower + upper) - q[joint]) / TAU);
        if turn.is_finite() { q[joint] + TAU * turn } else { q[joint] }
    })
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::kinematics::Status;
    use crate::suite::rng::Rng;

    #[test]
    fn the_margin_is_one_in_the_middle_and_zero_at_a_limit_or_a_singularity() {
        let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
        let limits = robot.limits().to_array();
        let mut q = limits.map(|[lower, upper]| 0.5 * (lower + upper));
        assert!((robot.margin(&q).limits - 1.0).abs() < 1e-15);
        for joint in 0..6 {
            let [lower, upper] = limits[joint];
            let middle = q[joint];
            q[joint] = upper;
            assert!(robot.margin(&q).limits.abs() < 1e-15);
            q[joint] = lower + 0.25 * (upper - lower);
            assert!((robot.margin(&q).limits - 0.5).abs() < 1e-15);
            q[joint] = lower - 0.5 * (upper - lower);
            assert!((robot.margin(&q).limits + 1.0).abs() < 1e-15);
            q[joint] = middle;
        }
        q[4] = 0.0;
        assert_eq!(robot.margin(&q).singularities, 0.0);
        q[4] = 0.3;
        let Margin { limits, singularities } = robot.margin(&q);
        assert!((singularities - 0.3 / FRAC_PI_2).abs() < 1e-12);
        assert_eq!(robot.margin(&q).least(), limits.min(singularities));
    }

    #[test]
    fn a_full_turn_is_chosen_where_it_leaves_the_most_room() {
        let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
        let mut rng = Rng::new(11);
        for _ in 0..500 {
            let q = rng.inside(robot.limits());
            let solutions = robot.ik(&robot.fk(&q)).unwrap();
            for solution in solutions.iter().filter(|s| s.is_within_limits()) {
                let turns = solutions.turns();
                let all: Vec<_> = turns.filter(|turn| turn.slot == solution.slot).collect();
                let most = all.iter().map(|turn| robot.margin(&turn.q).limits).fold(-9.0, f64::max);
                assert!((robot.margin_of_any_turn(&solution.q).limits - most).abs() < 1e-12);
            }
            assert!(solutions.status().iter().any(|s| s.contains(Status::WITHIN_LIMITS)));
        }
    }

    #[test]
    fn a_joint_without_limits_or_without_a_range_does_not_count() {
        let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
        let free = robot.with_limits(JointLimits::UNLIMITED);
        assert_eq!(free.margin(&[9.0; 6]).limits, 1.0);
        let mut limits = [[-1.0, 1.0]; 6];
        limits[3] = [0.5, 0.5];
        let held = free.with_limits(JointLimits::new(limits).unwrap());
        assert_eq!(held.margin(&[0.5; 6]).limits, 0.5);
    }
}
