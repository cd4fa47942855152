//! How near a robot gets to a pose that it does not reach: for the explanation of an answer without
//! solutions, never in a solve.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{Matrix6, UnitQuaternion, Vector6};

use crate::error::Error;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::report::{Approach, Explanation};

/// Joint vectors from which the way is minimized.
const STARTS: usize = 32;

/// Steps from each, at most.
const STEPS: usize = 60;

/// Step below which a minimum is found [rad].
const CONVERGED: f64 = 1e-10;

/// Damping at first, and the least, relative to the squares of the lengths [1].
const DAMPING: f64 = 1e-2;
const LEAST_DAMPING: f64 = 1e-12;

impl Robot<6> {
    /// The nearest approach to a pose: the least root of the sum of squares of the distance [m] and
    /// of the angle [rad] times the sum of the arm's lengths, limits not regarded.
    ///
    /// For a pose out of reach: [`Self::ik`] does not search. Levenberg and Marquardt's method from
    /// 32 joint vectors takes a millisecond; a narrower minimum may be missed.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the pose is not finite or not a rigid transform.
    pub fn nearest_approach(&self, pose: &Pose) -> Result<Approach, Error> {
        Ok(self.approach_of(&checked_pose(pose)?))
    }

    /// The outcome of a solve in a sentence, with the nearest approach where no solution is.
    pub(crate) fn explained(&self, solutions: &Solutions<6>) -> Explanation {
        match solutions.explain() {
            Explanation::NoRoots { certified, .. } => {
                let approach = Some(self.approach_of(solutions.pose()));
                Explanation::NoRoots { certified, approach }
            }
            explanation => explanation,
        }
    }

    fn approach_of(&self, pose: &Pose) -> Approach {
        let rows = &self.mdh().rows;
        let lengths: f64 = rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
        let mut nearest = (f64::INFINITY, [0.0; 6]);
        for index in 0..STARTS {
            let found = self.minimized(pose, lengths, start(index));
            nearest = if found.0 < nearest.0 { found } else { nearest };
        }
        let residual = self.residual(&nearest.1, pose);
        Approach { position: residual.position, rotation: residual.rotation }
    }

    /// The square of the way that is left at a minimum, and its joints.
    fn minimized(&self, pose: &Pose, lengths: f64, start: [f64; 6]) -> (f64, [f64; 6]) {
        let (mut q, mut way) = (start, self.way(pose, lengths, &start));
        let mut damping = DAMPING;
        for _ in 0..STEPS {
            let mut jacobian = self.jacobian(&q, JacobianFrame::Base);
            jacobian.fixed_rows_mut::<3>(3).scale_mut(lengths);
            let square = jacobian.transpose() * jacobian;
            let damped = square + Matrix6::identity() * (damping * lengths * lengths);
            let Some(factors) = damped.cholesky() else { break };
            let step = factors.solve(&(jacobian.transpose() * way));
            let ahead = core::array::from_fn(|joint| q[joint] + step[joint]);
            let next = self.way(pose, lengths, &ahead);
            if next.norm_squared() < way.norm_squared() {
                (q, way, damping) = (ahead, next, (damping / 4.0).max(LEAST_DAMPING));
            } else {
                damping *= 4.0;
            }
            if step.amax() < CONVERGED {
                break;
            }
        }
        (way.norm_squared(), q)
    }

    /// What is missing to a pose: along, then about, each axis of the base [m].
    fn way(&self, pose: &Pose, lengths: f64, q: &[f64; 6]) -> Vector6<f64> {
        let tool = self.fk(q);
        let along = pose.translation.vector - tool.translation.vector;
        // By the arc tangent of a quaternion: the arc cosine of a matrix has half of the digits.
        let about =
            UnitQuaternion::from_rotation_matrix(&(pose.rotation * tool.rotation.inverse()));
        let about = about.scaled_axis() * lengths;
        Vector6::new(along.x, along.y, along.z, about.x, about.y, about.z)
    }
}

/// Joint vectors all over the range of joints: multiples of the roots of primes, which have no
/// common measure.
fn start(index: usize) -> [f64; 6] {
    const PRIMES: [f64; 6] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0];
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    PRIMES.map(|prime| wrap(index as f64 * prime.sqrt() * PI))
}
