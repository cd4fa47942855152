//! Starts for joints that a singular pose leaves undetermined, perhaps several at once: at the
//! seed, at the limits, and over the whole range.

use core::f64::consts::{PI, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::solve::nearest::NearestSearch;
use crate::kinematics::thresholds::LIMIT_SLACK;

/// Steps of axis 1 if two joints of the arm are undetermined.
const OTHER_STEPS: u32 = 12;

/// Steps of axis 2 at which the wrist is put straight there.
const UPPER_STEPS: u32 = 8;

/// How far the tool at a seed may be off the pose for its joints to be moved onto it [m, rad].
const SEED_OFF: f64 = 1e-2;

impl<const N: usize> NearestSearch<'_, N> {
    /// Search where several undetermined joints may be inside narrow limits: at the limits, or near
    /// the seed inside them.
    pub(super) fn start_from_limits(&mut self, solution: &Solution<N>) {
        self.move_onto_pose(&solution.q, LIMIT_SLACK, solution);
        let limits = self.wanted.limits.to_array();
        let seed = core::array::from_fn(|joint| {
            let [low, high] = limits[joint];
            self.wanted.seed[joint].max(low).min(high)
        });
        let middle = core::array::from_fn(|joint| {
            let middle = 0.5 * (limits[joint][0] + limits[joint][1]);
            if middle.is_finite() { middle } else { seed[joint] }
        });
        for start in [seed, middle] {
            self.move_onto_pose(&start, 0.0, solution);
            self.start_with_straight_wrist(&start, solution);
        }
    }

    /// Search the joints near the seed that reach the pose.
    pub(super) fn start_from_seed(&mut self, solutions: &Solutions<N>) {
        let seed = *self.wanted.seed;
        if self.is_done()
            || !self.must_meet()
            || self.robot.residual(&seed, self.known.pose()).largest() > SEED_OFF
        {
            return;
        }
        if let Some(next) = solutions.closest_to(&seed).copied() {
            self.move_onto_pose(&seed, LIMIT_SLACK, &next);
        }
    }

    /// Search along the self-motion of a solution with axis 1 at several angles, if the wrist
    /// center is on that axis as well.
    pub(super) fn turn_other_joints(&mut self, solution: &Solution<N>) {
        if N != 6
            || !solution
                .singularities()
                .contains(SingularityKind::SHOULDER | SingularityKind::ELBOW)
        {
            return;
        }
        let [low, high] = self.wanted.limits.to_array()[0];
        let (low, high) = (low.max(-PI), high.min(PI).max(low));
        for step in 0..=OTHER_STEPS {
            if self.best.is_some() {
                break;
            }
            let mut turned = *solution;
            turned.q[0] = low + (high - low) * f64::from(step) / f64::from(OTHER_STEPS);
            self.self_motions = [0; MOST_SLOTS];
            self.look_along_self_motion(&turned, self.upper());
            for part in 0..UPPER_STEPS {
                let mut start = turned.q;
                start[1] += f64::from(part) * TAU / f64::from(UPPER_STEPS);
                self.start_with_straight_wrist(&start, solution);
            }
        }
    }
}

impl<const N: usize> Solutions<N> {
    /// The solution closest to joint angles [rad], turns not counted.
    pub(super) fn closest_to(&self, q: &[f64; N]) -> Option<&Solution<N>> {
        let apart = |solution: &Solution<N>| -> f64 {
            solution.q.iter().zip(q).map(|(own, q)| wrap(own - q).powi(2)).sum()
        };
        self.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))
    }
}
