//! The curve on which the joints of a seven-axis arm move while its tool stays in place.
//!
//! Reference: Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, chapter 2.

use nalgebra::{Const, LU, SMatrix, SVector, Vector3};

use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::thresholds::POSITION_ROUNDING;

/// Seven joint angles [rad].
pub(in crate::kinematics) type Joints = SVector<f64, 7>;

/// The factors of a matrix of seven rows and columns.
type Factors = LU<f64, Const<7>, Const<7>>;

/// Rounds in which Newton's method converges, if it does.
const ROUNDS: u32 = 12;

/// Correction beyond which a point is not near the curve [rad].
const LARGEST_CORRECTION: f64 = 0.5;

/// Correction below which a point is on the curve to rounding, near a singularity too [rad].
const AT_REST: f64 = 1e-11;

/// The joint vectors that bring the tool to a pose.
#[derive(Clone, Copy)]
pub(in crate::kinematics) struct SelfMotion<'a> {
    pub(in crate::kinematics) robot: &'a Robot<7>,
    pub(in crate::kinematics) pose: &'a Pose,
    /// Upper bound of the rounding of a pose of the arm [m, rad].
    pub(in crate::kinematics) rounding: f64,
}

/// A point of the curve, and its first two derivatives by the way in the direction `along`, a unit
/// vector.
#[derive(Clone, Copy)]
pub(in crate::kinematics) struct Point {
    pub(in crate::kinematics) q: Joints,
    pub(in crate::kinematics) along: Joints,
    pub(in crate::kinematics) bend: Joints,
}

impl Point {
    pub(in crate::kinematics) fn joints(&self) -> [f64; 7] {
        self.q.into()
    }

    /// A point of the curve with its Jacobian, extended by one row that is not zero along the curve,
    /// and the factors of this matrix.
    fn new(q: Joints, extended: &SMatrix<f64, 7, 7>, factors: &Factors) -> Option<Self> {
        let along = unit(factors.solve(&Joints::ith(6, 1.0))?)?;
        // Accelerations of the tool if all joints went on evenly along the tangent.
        let mut turned = Vector3::<f64>::zeros();
        let mut accelerations = Joints::zeros();
        for (joint, speed) in along.iter().enumerate() {
            let moves = *speed * extended.fixed_view::<3, 1>(0, joint);
            let turns = *speed * extended.fixed_view::<3, 1>(3, joint);
            let mut linear = accelerations.fixed_rows_mut::<3>(0);
            linear += (2.0 * turned + turns).cross(&moves);
            let mut angular = accelerations.fixed_rows_mut::<3>(3);
            angular += turned.cross(&turns);
            turned += turns;
        }
        let bend = -factors.solve(&accelerations)?;
        Some(Self { q, along, bend: bend - along * along.dot(&bend) })
    }
}

impl SelfMotion<'_> {
    /// The point of the curve near `q`, which may be off it.
    pub(in crate::kinematics) fn nearest(&self, q: &Joints) -> Option<Point> {
        // An arm that is singular with one joint fixed is not singular with every other one fixed.
        let along = [6, 4, 2, 0, 1, 3, 5].into_iter().find_map(|joint| {
            let border = Joints::ith(joint, 1.0);
            unit(self.bordered(q, &border).lu().solve(&Joints::ith(6, 1.0))?)
        })?;
        self.across(q, &along)
    }

    /// The point of the curve in the plane through `q` perpendicular to `along`.
    pub(in crate::kinematics) fn across(&self, q: &Joints, along: &Joints) -> Option<Point> {
        let value = along.dot(q);
        self.newton(*q, |q| (*along, value - along.dot(q)))
    }

    /// The point of the curve near `q` at which joint `joint`, from 0, is at `angle`.
    pub(in crate::kinematics) fn with_joint_at(
        &self,
        q: &Joints,
        joint: usize,
        angle: f64,
    ) -> Option<Point> {
        self.newton(*q, |q| (Joints::ith(joint, 1.0), angle - q[joint]))
    }

    /// The point of the curve near `q` at which a seventh quantity has the value that is wanted:
    /// `seventh` returns its gradient, and how far it is from that value.
    pub(in crate::kinematics) fn newton(
        &self,
        mut q: Joints,
        seventh: impl Fn(&Joints) -> (Joints, f64),
    ) -> Option<Point> {
        let mut rest = f64::INFINITY;
        for _ in 0..ROUNDS {
            let (border, off) = seventh(&q);
            let wanted = self.robot.off(self.pose, &q.into()).push(off);
            let bordered = self.bordered(&q, &border);
            let factors = bordered.lu();
            let correction = factors.solve(&wanted)?;
            let size = correction.amax();
            // Near a singularity of the curve, rounding keeps corrections large that do not change
            // the pose.
            if wanted.amax() <= self.rounding && size >= 0.5 * rest {
                return Point::new(q, &bordered, &factors);
            }
            if size.is_nan() || size > LARGEST_CORRECTION {
                return None;
            }
            q += correction;
            // Converged when it no longer shrinks.
            if size <= AT_REST && (size >= 0.5 * rest || size <= POSITION_ROUNDING) {
                return Point::new(q, &bordered, &factors);
            }
            rest = size;
        }
        None
    }

    /// The Jacobian extended by one row.
    fn bordered(&self, q: &Joints, border: &Joints) -> SMatrix<f64, 7, 7> {
        let mut matrix = SMatrix::<f64, 7, 7>::zeros();
        matrix
            .fixed_rows_mut::<6>(0)
            .copy_from(&self.robot.jacobian(&(*q).into(), JacobianFrame::Base));
        matrix.row_mut(6).copy_from(&border.transpose());
        matrix
    }
}

fn unit(direction: Joints) -> Option<Joints> {
    let length = direction.norm();
    (length.is_finite() && length > 0.0).then(|| direction / length)
}
