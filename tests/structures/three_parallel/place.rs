//! Where a hard set places an arm with three parallel axes, and the uncertainty of its joints
//! from rounding there.

use std::f64::consts::PI;

use irbkin::thresholds;

use super::arm::ParallelArm;
use crate::common::wrapped;
use crate::rng::Rng;
use crate::structures::place::{At, Place};

/// The elbow angle of a stretched arm below which it is straight to rounding: sqrt(2 rounding of
/// the position / lever), 9e-8 for a UR10e.
const STRAIGHT: f64 = 1e-7;
/// How near the joints that a pose determines must be to those that made it [rad].
pub const FOUND: f64 = 1e-6;
/// With a larger uncertainty, joint 6 is not determined by the pose [rad].
pub const UNDETERMINED: f64 = 0.1;

/// Distance of the wrist from the shoulder's singularity where a set does not ask for it [m].
pub fn clear_of_axis_1(arm: &ParallelArm) -> f64 {
    0.2 * arm.c2
}

/// A joint vector of the set, as theta.
pub fn at(arm: &ParallelArm, place: &Place, rng: &mut Rng) -> Option<[f64; 6]> {
    let mut theta: [f64; 6] = rng.angles();
    for (joint, at) in [(4, At::Wrist), (2, At::Elbow)] {
        theta[joint] = match place.off(at) {
            Some(off) => rng.half_turn() + rng.sign() * off,
            None => rng.sign() * rng.between(0.2, 2.9),
        };
    }
    if let Some(off) = place.shoulder() {
        theta[1] = theta_2(arm, &theta, rng.sign() * off, rng)?;
    } else if arm.x(&theta).abs() < clear_of_axis_1(arm) {
        return None;
    }
    Some(theta)
}

/// A theta_2 that puts the wrist `x` before axis 1; `None` if it cannot get there.
fn theta_2(arm: &ParallelArm, theta: &[f64; 6], x: f64, rng: &mut Rng) -> Option<f64> {
    let (elbow, last) = (theta[2], theta[2] + theta[3]);
    let along = arm.c2 + arm.c3 * elbow.cos() + arm.d5 * last.cos();
    let across = arm.c3 * elbow.sin() + arm.d5 * last.sin();
    let sine = (x - arm.a1) / along.hypot(across);
    let forward = if rng.unit() < 0.5 { sine.asin() } else { PI - sine.asin() };
    (sine.abs() < 0.99).then_some(forward - across.atan2(along))
}

/// How far the joints found may be from those that made the pose, by their uncertainty from
/// rounding (docs/evidence/accuracy.md, sections 3 to 5).
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// theta_1 and theta_5 [rad].
    pub plane: f64,
    /// theta_6 [rad].
    pub six: f64,
    /// theta_2 and theta_3 [rad].
    pub arm: [f64; 2],
}

impl Bounds {
    pub fn of(arm: &ParallelArm, theta: &[f64; 6], place: &Place) -> Self {
        let b = arm.b();
        let position = 8.0 * f64::EPSILON * (1.0 + arm.reach());
        // x^2 = rho^2 - b^2; below the merge threshold one x stands for both.
        let x = match place.shoulder() {
            None => position * (1.0 + b / clear_of_axis_1(arm)),
            Some(off) => {
                let merged = (2.0 * b * thresholds::POSITION_ROUNDING * arm.reach()).sqrt();
                let root = (2.0 * b * position).sqrt().min(2.0 * b * position / off.max(1e-300))
                    + position;
                root + if off <= 2.0 * merged { 2.0 * (off + merged) } else { 0.0 }
            }
        };
        let plane = x / b + 2.0 * position;
        let six = (plane / place.wrist().unwrap_or(0.19).max(1e-300)).min(PI);
        let end = x + position + arm.d5 * (plane + six);
        let elbow = |elbows: [f64; 2]| elbows.map(|angle| FOUND + angle.min(PI));
        Self {
            plane: FOUND + plane,
            six: FOUND + six,
            arm: elbow(Self::elbow(arm, theta[2], place.elbow(), end)),
        }
    }

    /// How far theta_2 and theta_3 may be off where the end of the planar arm is off by `end` [m].
    fn elbow(arm: &ParallelArm, theta_3: f64, off: Option<f64>, end: f64) -> [f64; 2] {
        let (c2, c3) = (arm.c2, arm.c3);
        let (longest, shortest) = (c2 + c3, (c2 - c3).abs());
        let Some(off) = off else {
            // sin theta_3 is at least 0.19, and so is r / longest for a folding angle of 0.24.
            let lever = 0.19 * c2.min(c3);
            return [2.0 * end / lever; 2];
        };
        let merged = if off <= 2.0 * STRAIGHT { off + STRAIGHT } else { 0.0 };
        let r = if theta_3.cos() > 0.0 { longest } else { shortest };
        if r < 1e-9 {
            // Folded onto axis 2: r = c2 theta_3, and only the direction to the end determines
            // theta_2.
            return [2.0 * end / (c2 * off.max(1e-300)), 2.0 * end / c2 + merged];
        }
        // A deviation e of theta_3 moves the end by c2 c3 e^2 / (2 r), and turns the upper arm by
        // up to longest / r times e.
        let lever = c2 * c3 / r;
        let root = (2.0 * end / lever).sqrt().min(2.0 * end / (lever * off.max(1e-300)));
        [(root + merged) * (longest / r) + end / r, root + merged]
    }

    /// Whether a joint vector is the one that made the pose.
    pub fn hold(&self, found: &[f64; 6], made: &[f64; 6]) -> bool {
        let off = |joint: usize| wrapped(found[joint] - made[joint]);
        self.hold_plane(found, made)
            && (self.six > UNDETERMINED
                || (off(5) <= self.six && off(1) <= self.arm[0] && off(2) <= self.arm[1]))
            && (self.six > UNDETERMINED || wrapped(phi(found) - phi(made)) <= self.plane + self.six)
    }

    /// Whether a joint vector has its plane and joint 5, up to its sign, as the one that made the
    /// pose.
    pub fn hold_plane(&self, found: &[f64; 6], made: &[f64; 6]) -> bool {
        let five = (wrapped(found[4]) - wrapped(made[4])).abs();
        wrapped(found[0] - made[0]) <= self.plane && five <= self.plane
    }
}

pub fn phi(theta: &[f64; 6]) -> f64 {
    theta[1] + theta[2] + theta[3]
}
