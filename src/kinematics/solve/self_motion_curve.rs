//! The curve on which the joints of a seven-axis arm move while its tool stands still.
//!
//! Reference: Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, chapter 2.

use nalgebra::{SMatrix, SVector, Vector3};

use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::thresholds::POSITION_ROUNDING;

/// Seven joint angles [rad].
pub(in crate::kinematics) type Joints = SVector<f64, 7>;

/// Rounds in which Newton's method has come to rest, if it does.
const ROUNDS: u32 = 12;

/// Correction beyond which a point is not next to the curve [rad].
const LARGEST_CORRECTION: f64 = 0.5;

/// Correction below which a point is on the curve to rounding, next to a singularity too [rad].
const AT_REST: f64 = 1e-11;

/// The joint vectors that bring the tool to a pose.
#[derive(Clone, Copy)]
pub(in crate::kinematics) struct SelfMotion<'a> {
    pub(in crate::kinematics) robot: &'a Robot<7>,
    pub(in crate::kinematics) pose: &'a Pose,
    /// How far rounding moves a pose of the arm at most [m, rad].
    pub(in crate::kinematics) rounding: f64,
}

/// A point of the curve, and the direction of the curve there, of length one.
#[derive(Clone, Copy)]
pub(in crate::kinematics) struct Point {
    pub(in crate::kinematics) q: Joints,
    pub(in crate::kinematics) along: Joints,
}

impl Point {
    pub(in crate::kinematics) fn joints(&self) -> [f64; 7] {
        self.q.into()
    }
}

impl SelfMotion<'_> {
    /// The point of the curve next to `q`, which may be off it.
    pub(in crate::kinematics) fn nearest(&self, q: &Joints) -> Option<Point> {
        // Where the arm is singular with one joint standing still, it is not with every other.
        let along = [6, 4, 2, 0, 1, 3, 5].into_iter().find_map(|joint| {
            let border = Joints::ith(joint, 1.0);
            self.direction(q, &border)
        })?;
        self.across(q, &along)
    }

    /// The point of the curve in the plane through `q` that is square to `along`.
    pub(in crate::kinematics) fn across(&self, q: &Joints, along: &Joints) -> Option<Point> {
        self.newton(*q, along, along.dot(q))
    }

    /// The point of the curve near `q` at which joint `joint`, from 0, stands at `angle`.
    pub(in crate::kinematics) fn with_joint_at(
        &self,
        q: &Joints,
        joint: usize,
        angle: f64,
    ) -> Option<Point> {
        self.newton(*q, &Joints::ith(joint, 1.0), angle)
    }

    /// The point of the curve near `q` at which `border . q` has a value.
    fn newton(&self, mut q: Joints, border: &Joints, value: f64) -> Option<Point> {
        let mut rest = f64::INFINITY;
        for _ in 0..ROUNDS {
            let mut wanted = self.off(&q).push(0.0);
            wanted[6] = value - border.dot(&q);
            let bordered = self.bordered(&q, border).lu();
            let correction = bordered.solve(&wanted)?;
            let size = correction.amax();
            // Next to a singularity of the curve rounding keeps corrections large that change
            // nothing of the pose.
            if wanted.amax() <= self.rounding && size >= 0.5 * rest {
                return Some(Point { q, along: unit(bordered.solve(&Joints::ith(6, 1.0))?)? });
            }
            if size.is_nan() || size > LARGEST_CORRECTION {
                return None;
            }
            q += correction;
            // At rest where it does not shrink any more.
            if size <= AT_REST && (size >= 0.5 * rest || size <= POSITION_ROUNDING) {
                return Some(Point { q, along: unit(bordered.solve(&Joints::ith(6, 1.0))?)? });
            }
            rest = size;
        }
        None
    }

    /// The direction of the curve at `q`, to the side to which `border` points.
    fn direction(&self, q: &Joints, border: &Joints) -> Option<Joints> {
        unit(self.bordered(q, border).lu().solve(&Joints::ith(6, 1.0))?)
    }

    /// The Jacobian over one more row.
    fn bordered(&self, q: &Joints, border: &Joints) -> SMatrix<f64, 7, 7> {
        let mut matrix = SMatrix::<f64, 7, 7>::zeros();
        matrix
            .fixed_rows_mut::<6>(0)
            .copy_from(&self.robot.jacobian(&(*q).into(), JacobianFrame::Base));
        matrix.row_mut(6).copy_from(&border.transpose());
        matrix
    }

    /// From the tool at `q` to the pose: translation [m] and, for small angles, turn [rad].
    fn off(&self, q: &Joints) -> SVector<f64, 6> {
        let at = self.robot.fk(&(*q).into());
        let turn = (self.pose.rotation * at.rotation.inverse()).into_inner();
        let turn = 0.5
            * Vector3::new(
                turn[(2, 1)] - turn[(1, 2)],
                turn[(0, 2)] - turn[(2, 0)],
                turn[(1, 0)] - turn[(0, 1)],
            );
        let shift = self.pose.translation.vector - at.translation.vector;
        SVector::<f64, 6>::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
    }
}

fn unit(direction: Joints) -> Option<Joints> {
    let length = direction.norm();
    (length.is_finite() && length > 0.0).then(|| direction / length)
}
