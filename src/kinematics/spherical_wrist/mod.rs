//! Arms with an ortho-parallel basis and a spherical wrist: axis 1 square to axis 2, axes 2 and 3 parallel, axes 4, 5, 6 through one point.
//!
//! `docs/ik_derivation.md` has the derivation; its equation numbers stand beside the code.

mod arm;
mod block;
mod branch;
mod columns;
mod held;
mod opw;
mod poses;
mod recognise;
mod single;
mod solve;
mod solver;
mod target;
mod wrist;

pub(crate) use block::{AnswerRow, Blocks, StatusRow};
pub use opw::OpwParameters;
pub(crate) use poses::PoseRow;
pub(crate) use recognise::recognise;
pub use recognise::{Condition, NotRecognised, Relation};
pub(crate) use single::Single;
pub(crate) use solver::WristSolver;
pub(crate) use target::FreeChoice;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use core::f64::consts::PI;

use super::angles::distance_from_half_turns;
use super::pose::{Pose, translation_z};
use super::status::Status;
use super::thresholds::{LATERAL_MERGE, POSITION_ROUNDING, SHOULDER_MERGE, WRIST_MERGE_SIN};

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist centre.
#[derive(Clone, Debug, PartialEq)]
pub struct SphericalWrist {
    a1: f64,
    a2: f64,
    b: f64,
    c2: f64,
    c3: f64,
    /// Length of the forearm, hypot(a2, c3).
    k: f64,
    signs: [f64; 6],
    offsets: [f64; 6],
    t_base_shoulder: Pose,
    t_wrist_flange: Pose,
    /// The lengths that a position of the tool is summed from [m].
    extent: f64,
}

/// How far a joint vector is from each singularity of a spherical-wrist arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularDistances {
    /// Angle of joint 5 from 0 or 180 deg [rad].
    pub wrist: f64,
    /// Angle between upper arm and forearm from stretched or folded [rad].
    pub elbow: f64,
    /// Distance of the wrist centre from the plane through axis 1 that holds axis 2's direction [m]; from axis 1 itself where b = 0.
    pub shoulder: f64,
}

impl SphericalWrist {
    pub(crate) fn from_opw(opw: &OpwParameters) -> Self {
        Self {
            a1: opw.a1,
            a2: opw.a2,
            b: opw.b,
            c2: opw.c2,
            c3: opw.c3,
            k: opw.a2.hypot(opw.c3),
            signs: opw.signs.map(f64::from),
            offsets: opw.offsets,
            t_base_shoulder: translation_z(opw.c1),
            t_wrist_flange: translation_z(opw.c4),
            extent: 0.0,
        }
        .standing_between(&Pose::identity(), &Pose::identity())
    }

    /// The same arm between a base and a tool, which add to what a pose's rounding grows with.
    pub(crate) fn standing_between(self, base: &Pose, tool: &Pose) -> Self {
        let fixed = [base, &self.t_base_shoulder, &self.t_wrist_flange, tool];
        let extent = self.a1.abs() + self.b.abs() + self.c2 + self.k + fixed.map(|pose| pose.translation.vector.norm()).iter().sum::<f64>();
        Self { extent, ..self }
    }

    pub(crate) fn t_base_shoulder(&self) -> &Pose {
        &self.t_base_shoulder
    }

    pub(crate) fn t_wrist_flange(&self) -> &Pose {
        &self.t_wrist_flange
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        core::array::from_fn(|i| self.signs[i] * q[i] - self.offsets[i])
    }

    /// The sine of the elbow angle, x of the wrist centre in the plane of the arm [m], and the sine of joint 5, signed (eq. 21).
    fn factors(&self, q: &[f64; 6]) -> [f64; 3] {
        let [_, t2, t3, _, t5, _] = self.theta(q);
        let (sin_2, cos_2) = t2.sin_cos();
        let (sin_3, cos_3) = t3.sin_cos();
        let (sin_23, cos_23) = (sin_2 * cos_3 + cos_2 * sin_3, cos_2 * cos_3 - sin_2 * sin_3);
        let elbow = (self.a2 * cos_3 + self.c3 * sin_3) / self.k;
        let x = self.a1 + self.c2 * sin_2 + self.c3 * sin_23 + self.a2 * cos_23;
        [elbow, x, t5.sin()]
    }

    /// sin q5, signed.
    pub(crate) fn sin_5(&self, q: &[f64; 6]) -> f64 {
        self.theta(q)[4].sin()
    }

    /// The angle of joint 4 nearest to that of `q` at which axis 5 is parallel to axes 2 and 3 [rad]: 0 or 180 deg for ABB's arms.
    pub(crate) fn axis_4_in_plane(&self, q: &[f64; 6]) -> f64 {
        let theta_4 = self.theta(q)[3];
        q[3] + self.signs[3] * (PI * (theta_4 / PI).round() - theta_4)
    }

    /// The determinant of the geometric Jacobian at the wrist centre, which is that of the tool's (eq. 21).
    #[must_use]
    pub fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        let [elbow, x, wrist] = self.factors(q);
        -self.signs.iter().product::<f64>() * self.c2 * self.k * elbow * x * wrist
    }

    /// How far `q` is from each singularity.
    #[must_use]
    pub fn singular_distances(&self, q: &[f64; 6]) -> SingularDistances {
        let [_, _, t3, _, t5, _] = self.theta(q);
        SingularDistances {
            wrist: distance_from_half_turns(t5),
            elbow: distance_from_half_turns(t3 + self.a2.atan2(self.c3)),
            shoulder: self.factors(q)[1].abs(),
        }
    }

    /// The singularities at which `q` stands, by the thresholds that merge the branches of a solve. A solve, which does not know `q`, also
    /// merges a wrist by what the pose leaves open of the forearm.
    #[must_use]
    pub fn kinds(&self, q: &[f64; 6]) -> Status {
        let [elbow, x, wrist] = self.factors(q);
        let cos_elbow = (self.theta(q)[2] + self.a2.atan2(self.c3)).cos();
        let mut kinds = Status::empty();
        kinds.set(Status::WRIST, wrist.abs() <= WRIST_MERGE_SIN);
        let r = (self.c2 * self.c2 + self.k * self.k + 2.0 * self.c2 * self.k * cos_elbow).max(0.0).sqrt();
        let folded_onto_axis_2 = r <= self.position_rounding();
        kinds.set(Status::ELBOW, folded_onto_axis_2 || (self.c2 * self.k * elbow).powi(2) <= self.straight_m2(r));
        kinds.set(Status::SHOULDER, x.abs() <= self.shoulder_merge());
        kinds
    }

    /// How far rounding moves a position of this arm at most [m].
    fn position_rounding(&self) -> f64 {
        POSITION_ROUNDING * self.extent
    }

    /// How far rounding commonly moves a position of this arm [m]: a link of lever l turns by this over l.
    fn direction_rounding(&self) -> f64 {
        2.0 * f64::EPSILON * self.extent
    }

    /// The square of m (eq. 8) below which a straight arm reaches the wrist centre too, to half the rounding of a position.
    fn straight_m2(&self, r: f64) -> f64 {
        self.position_rounding() * r * self.c2 * self.k
    }

    fn shoulder_merge(&self) -> f64 {
        SHOULDER_MERGE.max((self.b.abs() * LATERAL_MERGE).sqrt())
    }
}
