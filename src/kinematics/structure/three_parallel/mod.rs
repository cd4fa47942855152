//! Arms with three parallel axes, as those of Universal Robots: axis 1 square to axes 2, 3 and 4, which are parallel, axis 5 square to them
//! and axis 6 square to axis 5.
//!
//! `docs/three_parallel.md` has the derivation; its equation numbers, from 31 on, stand beside the code.

mod block;
mod branch;
mod plane;
mod reaching;
mod recognise;
mod single;
mod solve;
mod solver;
mod wrist;

pub(crate) use recognise::recognise;
pub(crate) use single::Single;
pub(crate) use solver::ParallelSolver;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::structure::joint_map::Placement;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::thresholds::WRIST_MERGE_SIN;

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist, where axes 5 and 6 meet.
#[derive(Clone, Debug, PartialEq)]
pub struct ThreeParallel {
    /// Up to axis 4.
    planar: PlanarArm,
    /// Distance of the wrist from axis 4, along axis 5 [m].
    d5: f64,
    placement: Placement<6>,
}

impl ThreeParallel {
    /// The same arm between a base and a tool, which add to what a pose's rounding grows with.
    pub(crate) fn standing_between(self, base: &Pose, tool: &Pose) -> Self {
        let fixed = [base, &self.placement.t_base_shoulder, &self.placement.t_wrist_flange, tool];
        let planar = self.planar.between(fixed);
        Self { planar: PlanarArm { extent: planar.extent + self.d5, ..planar }, ..self }
    }

    /// x of the wrist in the plane of the arm (eq. 41) [m].
    fn x_of_wrist(&self, q: &[f64; 6]) -> f64 {
        let [_, theta_2, theta_3, theta_4, ..] = self.placement.theta(q);
        self.planar.x_of_end(theta_2, theta_3) + self.d5 * (theta_2 + theta_3 + theta_4).sin()
    }

    /// sin q5, signed.
    pub(crate) fn sin_5(&self, q: &[f64; 6]) -> f64 {
        self.placement.theta(q)[4].sin()
    }

    /// The determinant of the geometric Jacobian at the wrist, which is that of the tool's (eq. 41).
    #[must_use]
    pub fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        let PlanarArm { c2, k, .. } = self.planar;
        let elbow = self.planar.sin_elbow(self.placement.theta(q)[2]);
        -self.placement.signs.iter().product::<f64>()
            * c2
            * k
            * elbow
            * self.x_of_wrist(q)
            * self.sin_5(q)
    }

    /// How far `q` is from each singularity.
    #[must_use]
    pub fn singular_distances(&self, q: &[f64; 6]) -> SingularDistances {
        let [_, _, theta_3, _, theta_5, _] = self.placement.theta(q);
        SingularDistances {
            wrist: distance_from_half_turns(theta_5),
            elbow: distance_from_half_turns(self.planar.elbow_angle(theta_3)),
            shoulder: self.x_of_wrist(q).abs(),
        }
    }

    /// The singularities at which `q` stands, by the thresholds that merge the branches of a solve. A solve, which does not know `q`, also
    /// merges a wrist by what the pose leaves open of axis 1.
    #[must_use]
    pub fn kinds(&self, q: &[f64; 6]) -> Status {
        let mut kinds = Status::empty();
        kinds.set(Status::WRIST, self.sin_5(q).abs() <= WRIST_MERGE_SIN);
        kinds.set(Status::ELBOW, self.planar.is_straight(self.placement.theta(q)[2]));
        kinds.set(Status::SHOULDER, self.x_of_wrist(q).abs() <= self.planar.shoulder_merge());
        kinds
    }
}
