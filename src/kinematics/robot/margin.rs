//! How much room joint angles leave: to limits, and to singularities.

use core::f64::consts::{FRAC_PI_2, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use nalgebra::Vector3;

use super::Robot;
use crate::kinematics::JacobianFrame;
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
    /// of half the length of upper arm and forearm. Of six joints of another structure, such as an
    /// offset wrist, the distance in joint space to first order, as a part of 90 deg. NaN of other
    /// arms.
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

    /// How near `q` is to each limit: the sum of the squares of 1 minus its margin.
    #[doc(hidden)]
    pub fn nearness_to_limits(&self, q: &[f64; N]) -> f64 {
        of_limits(&self.limits, q).map(squared_lack).sum()
    }

    /// How near `q` is to each singularity, likewise.
    #[doc(hidden)]
    pub fn nearness_to_singularities(&self, q: &[f64; N]) -> f64 {
        self.of_singularities(q).into_iter().flatten().map(squared_lack).sum()
    }

    /// The margins to the singularities of wrist, elbow and shoulder; some are more than 1.
    fn of_singularities(&self, q: &[f64; N]) -> Option<[f64; 3]> {
        let Some(distances) = self.singular_distances(q) else {
            return Some([self.first_order_distance(q)? / FRAC_PI_2, 1.0, 1.0]);
        };
        // Upper arm and forearm: all links between axis 1 and the wrist [m].
        let links = self.mdh().rows.iter().skip(1).take(3);
        let reach: f64 = links.map(|row| row.a.abs() + row.d.abs()).sum();
        let shoulder = distances.shoulder / (0.5 * reach);
        Some([distances.wrist / FRAC_PI_2, distances.elbow / FRAC_PI_2, shoulder])
    }

    /// How far six joints are from the nearest singularity, to first order [rad]: |w| / |grad w| of
    /// w = det J, with dw/dq_k = w tr(J^-1 dJ/dq_k). Column i of dJ/dq_k is (z_k x v_i, z_k x z_i)
    /// for k <= i and else (z_i x v_k, 0), with v the linear and z the angular rows of J.
    /// Reference: Haviland and Corke, Manipulator differential kinematics, part 2, 2024.
    fn first_order_distance(&self, q: &[f64; N]) -> Option<f64> {
        if N != 6 || self.coupling() != 0.0 {
            return None;
        }
        let jacobian = self.jacobian(q, JacobianFrame::Base).fixed_view::<6, 6>(0, 0).into_owned();
        let Some(inverse) = jacobian.try_inverse() else { return Some(0.0) };
        let linear = |joint| jacobian.fixed_view::<3, 1>(0, joint).into_owned();
        let angular = |joint| jacobian.fixed_view::<3, 1>(3, joint).into_owned();
        let slope = |k: usize| -> f64 {
            let of_column = |i: usize| {
                let [first, last] = [k.min(i), k.max(i)];
                // Products of matrices are calls; these are a few instructions.
                let row = |first| Vector3::from_fn(|j, _| inverse[(i, first + j)]);
                let moved = row(0).dot(&angular(first).cross(&linear(last)));
                moved + if k < i { row(3).dot(&angular(k).cross(&angular(i))) } else { 0.0 }
            };
            (0..N).map(of_column).sum()
        };
        let squares: f64 = (0..N).map(|k| slope(k) * slope(k)).sum();
        Some(if squares.is_finite() { 1.0 / squares.sqrt() } else { 0.0 })
    }

    /// [`Self::margin`] with each joint at the 2 pi equivalent that leaves the most room.
    pub(crate) fn margin_of_any_turn(&self, q: &[f64; N]) -> Margin {
        self.margin(&centered(&self.limits, q))
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

fn squared_lack(margin: f64) -> f64 {
    (1.0 - margin.min(1.0)) * (1.0 - margin.min(1.0))
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
    use crate::rng::Rng;

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
    fn the_margin_of_an_offset_wrist_is_its_distance_in_joint_space() {
        let mut rng = Rng::new(12);
        let mut crossings = 0;
        for name in ["CRB 15000-5/0.95", "CRX-10iA", "xArm6"] {
            let robot: Robot<6> = Robot::named(name).unwrap();
            let det = |q: &[f64; 6]| robot.jacobian_determinant(q).unwrap();
            let distance = |q: &[f64; 6]| FRAC_PI_2 * robot.margin(q).singularities;
            for _ in 0..200 {
                let [q, end] = [rng.inside(robot.limits()), rng.inside(robot.limits())];
                // Its definition, by central differences.
                let step = 1e-5;
                let slope = |joint: usize| {
                    let at = |by: f64| {
                        det(&core::array::from_fn(|i| q[i] + if i == joint { by } else { 0.0 }))
                    };
                    (at(step) - at(-step)) / (2.0 * step)
                };
                let gradient = (0..6).map(|joint| slope(joint).powi(2)).sum::<f64>().sqrt();
                let wanted = (det(&q) / gradient).abs();
                let found = distance(&q);
                assert!(
                    (found - wanted.min(FRAC_PI_2)).abs() <= 1e-6 * wanted + 1e-7,
                    "{name} {found} {wanted}"
                );
                // Along a line through a singularity it falls to zero, no faster than the way to it.
                let at = |part: f64| core::array::from_fn(|i| q[i] + part * (end[i] - q[i]));
                let [mut low, mut high] = [0.0, 1.0];
                if det(&at(low)) * det(&at(high)) >= 0.0 {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    let is_before = det(&at(low)) * det(&at(middle)) > 0.0;
                    if is_before { low = middle } else { high = middle }
                }
                crossings += 1;
                let length = (0..6).map(|i| (end[i] - q[i]).powi(2)).sum::<f64>().sqrt();
                assert!(distance(&at(low)) < 1e-6, "{name} {}", distance(&at(low)));
                let near = distance(&at(low + 1e-4 / length));
                assert!(near <= 1.01e-4, "{name} {near}");
            }
        }
        assert!(crossings > 100, "{crossings}");
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
