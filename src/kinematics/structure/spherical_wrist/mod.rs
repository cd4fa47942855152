//! Arms with an ortho-parallel basis and a spherical wrist: axis 1 square to axis 2, axes 2 and 3 parallel, axes 4, 5, 6 through one point.
//!
//! `docs/ik_derivation.md` has the derivation; its equation numbers stand beside the code.

mod arm;
mod block;
mod branch;
mod held;
mod opw;
mod recognise;
mod single;
mod solve;
mod solver;
mod wrist;

pub use opw::OpwParameters;
pub(crate) use recognise::recognise;
pub(crate) use single::Single;
pub(crate) use solver::WristSolver;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use core::f64::consts::PI;

use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::structure::joint_map::Placement;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::thresholds::WRIST_MERGE_SIN;

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist centre.
#[derive(Clone, Debug, PartialEq)]
pub struct SphericalWrist {
    planar: PlanarArm,
    placement: Placement<6>,
}

impl SphericalWrist {
    pub(crate) fn from_opw(opw: &OpwParameters) -> Self {
        Self {
            planar: PlanarArm::new([opw.a1, opw.a2, opw.b, opw.c2, opw.c3]),
            placement: Placement {
                signs: opw.signs.map(f64::from),
                offsets: opw.offsets,
                coupled: false,
                t_base_shoulder: translation_z(opw.c1),
                t_wrist_flange: translation_z(opw.c4),
            },
        }
        .standing_between(&Pose::identity(), &Pose::identity())
    }

    /// The same arm between a base and a tool, which add to what a pose's rounding grows with.
    pub(crate) fn standing_between(self, base: &Pose, tool: &Pose) -> Self {
        let fixed = [base, &self.placement.t_base_shoulder, &self.placement.t_wrist_flange, tool];
        Self { planar: self.planar.between(fixed), ..self }
    }

    /// The same arm with the joint angles of a controller that couples axes 2 and 3, or with its own.
    fn with_coupling(mut self, coupled: bool) -> Self {
        self.placement.coupled = coupled;
        self
    }

    /// Whether joint angles are those of a controller that couples axes 2 and 3.
    pub(crate) fn is_coupled(&self) -> bool {
        self.placement.coupled
    }

    /// Whether axes 2 and 3 turn in the same sense, so that q2 + q3 is a pitch.
    pub(crate) fn may_be_coupled(&self) -> bool {
        self.placement.signs[1].total_cmp(&self.placement.signs[2]).is_eq()
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        self.placement.theta(q)
    }

    /// The sine of the elbow angle, x of the wrist centre in the plane of the arm [m], and the sine of joint 5, signed (eq. 21).
    fn factors(&self, q: &[f64; 6]) -> [f64; 3] {
        let [_, theta_2, theta_3, _, theta_5, _] = self.theta(q);
        [self.planar.sin_elbow(theta_3), self.planar.x_of_end(theta_2, theta_3), theta_5.sin()]
    }

    /// sin q5, signed.
    pub(crate) fn sin_5(&self, q: &[f64; 6]) -> f64 {
        self.theta(q)[4].sin()
    }

    /// The angle of joint 4 nearest to that of `q` at which axis 5 is parallel to axes 2 and 3 [rad]: 0 or 180 deg for ABB's arms.
    pub(crate) fn axis_4_in_plane(&self, q: &[f64; 6]) -> f64 {
        let theta_4 = self.theta(q)[3];
        q[3] + self.placement.signs[3] * (PI * (theta_4 / PI).round() - theta_4)
    }

    /// `q` with joint 5 at its singularity, to one or the other side of it by the least that is seen of it.
    pub(crate) fn with_straight_wrist(&self, q: &[f64; 6], side: f64) -> [f64; 6] {
        let theta_5 = self.theta(q)[4];
        let straight = PI * (theta_5 / PI).round();
        let mut q = *q;
        q[4] += self.placement.signs[4] * (straight + side * 2.0 * f64::EPSILON - theta_5);
        q
    }

    /// `q` with an elbow that is just not straight any more, behind the lower arm or in front of it.
    pub(crate) fn with_bent_elbow(&self, q: &[f64; 6], behind: bool) -> [f64; 6] {
        let PlanarArm { c2, k, .. } = self.planar;
        let elbow = self.planar.elbow_angle(self.theta(q)[2]);
        let straight = PI * (elbow / PI).round();
        let r = (c2 + k * straight.cos()).abs();
        let bend = 1.1 * (self.planar.straight_m2(r).sqrt() / (c2 * k));
        let side = if behind { -straight.cos() } else { straight.cos() };
        let mut q = *q;
        q[2] += self.placement.signs[2] * (straight + side * bend - elbow);
        q
    }

    /// The slot of the branch that `q` is on (eq. 13); of two that meet at a singularity of the arm, the one in front.
    pub(crate) fn slot(&self, q: &[f64; 6]) -> u8 {
        let [elbow, x, wrist] = self.factors(q);
        let met = self.kinds(q);
        let behind_axis_1 = x < 0.0 && !met.contains(Status::SHOULDER);
        let behind_lower_arm = elbow < 0.0 && !met.contains(Status::ELBOW);
        4 * u8::from(behind_axis_1) + 2 * u8::from(behind_lower_arm) + u8::from(wrist < 0.0)
    }

    /// The determinant of the geometric Jacobian at the wrist centre, which is that of the tool's (eq. 21).
    #[must_use]
    pub fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        let [elbow, x, wrist] = self.factors(q);
        -self.placement.signs.iter().product::<f64>()
            * self.planar.c2
            * self.planar.k
            * elbow
            * x
            * wrist
    }

    /// How far `q` is from each singularity.
    #[must_use]
    pub fn singular_distances(&self, q: &[f64; 6]) -> SingularDistances {
        let [_, _, t3, _, t5, _] = self.theta(q);
        SingularDistances {
            wrist: distance_from_half_turns(t5),
            elbow: distance_from_half_turns(self.planar.elbow_angle(t3)),
            shoulder: self.factors(q)[1].abs(),
        }
    }

    /// The singularities at which `q` stands, by the thresholds that merge the branches of a solve. A solve, which does not know `q`, also
    /// merges a wrist by what the pose leaves open of the forearm.
    #[must_use]
    pub fn kinds(&self, q: &[f64; 6]) -> Status {
        let [_, x, wrist] = self.factors(q);
        let mut kinds = Status::empty();
        kinds.set(Status::WRIST, wrist.abs() <= WRIST_MERGE_SIN);
        kinds.set(Status::ELBOW, self.planar.is_straight(self.theta(q)[2]));
        kinds.set(Status::SHOULDER, x.abs() <= self.planar.shoulder_merge());
        kinds
    }
}
