//! How near a robot gets to a pose that it does not reach: for the explanation of an answer without
//! solutions, never in a solve.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{SMatrix, Vector6};

use crate::error::Error;
use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::pose::angles::{rotation_vector, wrap};
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

impl<const N: usize> Robot<N> {
    /// The nearest approach to a pose: the least root of the sum of squares of the distance [m] and
    /// of the angle [rad] times the sum of the arm's lengths, limits not regarded, except joint
    /// 7's.
    ///
    /// For a pose out of reach: [`Self::ik_with`] does not search. Levenberg and Marquardt's method from
    /// 32 joint vectors takes a millisecond; a narrower minimum may be missed.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the pose is not finite or not a rigid transform.
    pub fn nearest_approach(&self, pose: &Pose) -> Result<Approach, Error> {
        Ok(self.approach_of(&checked_pose(pose)?))
    }

    /// An explanation, with the nearest approach to the pose where no solution is. Joint 7, which a
    /// search keeps inside its limits, is inside them; other limits are not regarded.
    pub(super) fn with_approach(&self, explanation: Explanation, pose: &Pose) -> Explanation {
        match explanation {
            Explanation::NoRoots { certified, .. } => {
                Explanation::NoRoots { certified, approach: Some(self.approach_of(pose)) }
            }
            explanation => explanation,
        }
    }

    fn approach_of(&self, pose: &Pose) -> Approach {
        let mut nearest = (f64::INFINITY, [0.0; N]);
        for found in self.approaches(pose) {
            nearest = if found.0 < nearest.0 { found } else { nearest };
        }
        let residual = self.residual(&nearest.1, pose);
        Approach { position: residual.position, rotation: residual.rotation }
    }

    /// The minima that are found from all over the range of joints, as [`Self::minimized`] has them.
    pub(super) fn approaches(&self, pose: &Pose) -> impl Iterator<Item = (f64, [f64; N])> {
        (0..STARTS).map(|index| self.minimized(pose, start(index)))
    }

    /// The square of the way that is left at the minimum next to a joint vector, and its joints.
    pub(super) fn minimized(&self, pose: &Pose, start: [f64; N]) -> (f64, [f64; N]) {
        let rows = &self.mdh().rows;
        let lengths: f64 = rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
        let mut q = self.with_joint_7_inside(start);
        let mut way = self.way(pose, lengths, &q);
        let mut damping = DAMPING;
        for _ in 0..STEPS {
            let mut jacobian = self.jacobian(&q, JacobianFrame::Base);
            jacobian.fixed_rows_mut::<3>(3).scale_mut(lengths);
            self.lock_joint_7(&mut jacobian, &q, &way);
            let square = jacobian.transpose() * jacobian;
            let damped = square + SMatrix::<f64, N, N>::identity() * (damping * lengths * lengths);
            let Some(factors) = damped.cholesky() else { break };
            let step = factors.solve(&(jacobian.transpose() * way));
            let ahead = core::array::from_fn(|joint| q[joint] + step[joint]);
            let ahead = self.with_joint_7_inside(ahead);
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

    fn with_joint_7_inside(&self, mut q: [f64; N]) -> [f64; N] {
        if let (Some(angle), Some([low, high])) = (q.get_mut(6), self.limits().to_array().get(6)) {
            *angle = angle.clamp(*low, *high);
        }
        q
    }

    /// Leave joint 7 out of a step where it is at a limit and the way is beyond it.
    fn lock_joint_7(&self, jacobian: &mut SMatrix<f64, 6, N>, q: &[f64; N], way: &Vector6<f64>) {
        let limits = self.limits().to_array();
        let (Some(angle), Some([low, high])) = (q.get(6), limits.get(6)) else { return };
        let ahead = jacobian.column(6).dot(way);
        if (ahead < 0.0 && angle <= low) || (ahead > 0.0 && angle >= high) {
            jacobian.column_mut(6).fill(0.0);
        }
    }

    /// Return the way that is missing to a pose: along, then about, each axis of the base [m].
    fn way(&self, pose: &Pose, lengths: f64, q: &[f64; N]) -> Vector6<f64> {
        let tool = self.fk(q);
        let along = pose.translation.vector - tool.translation.vector;
        let about = rotation_vector(&(pose.rotation * tool.rotation.inverse())) * lengths;
        Vector6::new(along.x, along.y, along.z, about.x, about.y, about.z)
    }
}

/// Joint vectors all over the range of joints: multiples of the roots of primes, which have no
/// common measure.
fn start<const N: usize>(index: usize) -> [f64; N] {
    const PRIMES: [f64; 7] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0];
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    let angle = |prime: &f64| wrap(index as f64 * prime.sqrt() * PI);
    core::array::from_fn(|joint| PRIMES.get(joint).map_or(0.0, angle))
}
