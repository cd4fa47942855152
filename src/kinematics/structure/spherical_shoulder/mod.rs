//! Arms of seven axes with a spherical shoulder and an offset elbow, the angle of the last joint being told: axes 1, 2, 3 through one point,
//! axes 5 and 6 meeting, axis 7 anywhere.
//!
//! `docs/seven_axes.md` has the derivation; its equation numbers stand beside the code.

mod block;
mod branch;
mod elbow;
mod joint_7;
mod links;
mod quartic;
mod recognise;
mod shoulder;
mod single;
mod solve;
mod solver;
mod target;
mod turn;
mod wrist;

pub(crate) use joint_7::EDGES;
pub(crate) use recognise::recognise;
pub(crate) use single::Single;
pub(crate) use solver::SevenSolver;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use links::Links;

use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::structure::joint_map::Placement;
use crate::kinematics::thresholds::{ROTATION_ROUNDING, WRIST_MERGE_SIN};

/// The geometry between the shoulder, where axes 1, 2 and 3 meet, and the flange.
#[derive(Clone, Debug, PartialEq)]
pub struct SphericalShoulder {
    links: Links,
    /// Its last frame is that of joint 7: what stands behind it is constant.
    placement: Placement<7>,
    /// From where axes 5 and 6 meet to the frame of joint 7 at theta_7 = 0.
    t_hand_seven: Pose,
}

impl SphericalShoulder {
    /// The same arm between a base and a tool, which add to what a pose's rounding grows with.
    pub(crate) fn standing_between(self, base: &Pose, tool: &Pose) -> Self {
        let fixed = [
            base,
            &self.placement.t_base_shoulder,
            &self.t_hand_seven,
            &self.placement.t_wrist_flange,
            tool,
        ];
        Self { links: self.links.between(fixed), ..self }
    }

    /// How far rounding moves a pose of this arm at most [m, rad].
    pub(crate) fn rounding(&self) -> f64 {
        self.links.position_rounding().max(ROTATION_ROUNDING)
    }

    fn theta(&self, q: &[f64; 7]) -> [f64; 7] {
        self.placement.theta(q)
    }

    /// The slot of a joint vector (eq. 65).
    pub(crate) fn slot(&self, q: &[f64; 7]) -> u8 {
        let [_, theta_2, _, theta_4, theta_5, ..] = self.theta(q);
        let bits =
            [theta_2.sin() < 0.0, self.links.elbow_angle(theta_4).sin() < 0.0, theta_5.cos() < 0.0];
        4 * u8::from(bits[0]) + 2 * u8::from(bits[1]) + u8::from(bits[2])
    }

    /// Distance of the shoulder from the plane of axes 5 and 6 (eq. 60), signed [m].
    fn aside(&self, q: &[f64; 7]) -> f64 {
        let [_, _, _, theta_4, theta_5, ..] = self.theta(q);
        self.links.elbow_at(theta_4).across * theta_5.cos()
    }

    /// The determinant of the geometric Jacobian of joints 1 to 6 (eq. 66).
    #[must_use]
    pub fn jacobian_determinant(&self, q: &[f64; 7]) -> f64 {
        let [_, theta_2, _, theta_4, ..] = self.theta(q);
        let signs = self.placement.signs[..6].iter().product::<f64>();
        -signs
            * self.links.product()
            * self.links.elbow_angle(theta_4).sin()
            * self.aside(q)
            * theta_2.sin()
    }

    /// How far `q` is from each singularity.
    #[must_use]
    pub fn singular_distances(&self, q: &[f64; 7]) -> SingularDistances {
        let [_, theta_2, _, theta_4, theta_5, ..] = self.theta(q);
        let elbow = self.links.elbow_at(theta_4);
        SingularDistances {
            wrist: self.aside(q).abs().atan2((elbow.across * theta_5.sin()).hypot(elbow.along)),
            elbow: distance_from_half_turns(self.links.elbow_angle(theta_4)),
            shoulder: self.links.c3 * theta_2.sin().abs(),
        }
    }

    /// The singularities at which `q` stands, by the thresholds that merge the branches of a solve. A solve, which does not know `q`, also
    /// merges a shoulder by what the pose leaves open of elbow and wrist.
    #[must_use]
    pub fn kinds(&self, q: &[f64; 7]) -> Status {
        let [_, theta_2, _, theta_4, theta_5, ..] = self.theta(q);
        let mut kinds = Status::empty();
        kinds.set(Status::WRIST, self.links.wrist_is_one(&self.links.elbow_at(theta_4), theta_5));
        kinds.set(Status::ELBOW, self.links.is_straight(theta_4));
        kinds.set(Status::SHOULDER, theta_2.sin().abs() <= WRIST_MERGE_SIN);
        kinds
    }
}

#[cfg(test)]
mod tests;
