//! Joints 5 and 6: two ways to turn the forearm so that the shoulder is where the hand frame has
//! it; and joints 1, 2 and 3, which have the remaining rotation.

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::elbow::{Elbow, Links, Target};
use crate::kinematics::pose::angles::{sign_of, wrap};
use crate::kinematics::structure::free_choice::SeedPolicy;
use crate::kinematics::structure::zyz::{First, Zyz, zyz};
use crate::kinematics::thresholds::{REGULAR_WRIST_SIN, SEEDED_FREE, SHOULDER_MERGE};
use crate::report::FreeJoint;

/// One pair of angles of joints 5 and 6.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrist {
    pub(super) fifth: Turn,
    pub(super) sixth: Turn,
}

/// Both pairs; without the second, they are one.
#[derive(Debug)]
pub(super) struct Wrists {
    pub(super) first: Wrist,
    pub(super) second: Option<Wrist>,
    /// The joint that the pose leaves undetermined, and how many it does.
    pub(super) free: Option<FreeJoint>,
    pub(super) freedom: usize,
    /// How far rounding may rotate the upper arm [rad].
    pub(super) error: f64,
}

impl Links {
    /// Both branches of the wrist (eq. 60 to 62), or the distance of the shoulder from where this
    /// elbow can bring it [m].
    pub(super) fn wrists(&self, elbow: &Elbow, target: &Target<'_>) -> Result<Wrists, f64> {
        let (across, along, rho, high) =
            (elbow.across.abs(), elbow.along.abs(), target.rho, target.seen[1].abs());
        // Both expressions are equal; each is accurate where the distance that it is computed from
        // is the larger one.
        let aside_2 = if high < rho {
            (across - high) * (across + high)
        } else {
            (rho - along) * (rho + along)
        };
        let off = (across - high).hypot(rho - along);
        let rounding = self.position_rounding();
        if aside_2 < 0.0 && off > target.tolerance.max(rounding) {
            return Err(off);
        }
        let aside = if off <= rounding { 0.0 } else { aside_2.max(0.0).sqrt() };
        let (on_axis_5, on_axis_6) = (across <= SHOULDER_MERGE, rho <= SHOULDER_MERGE);
        let error = self.wrist_error(elbow, target, aside);
        if on_axis_5 || on_axis_6 {
            let first = if on_axis_5 {
                on_5(elbow, target, aside, rounding, on_axis_6)
            } else {
                on_6(elbow, target, aside, rounding)
            };
            let free = Some(if on_axis_5 { FreeJoint::Forearm } else { FreeJoint::Hand });
            let freedom = usize::from(on_axis_5) + usize::from(on_axis_6);
            return Ok(Wrists { first, second: None, free, freedom, error });
        }
        let both = |aside: f64| Wrist {
            fifth: fifth(elbow, target, aside),
            sixth: sixth(elbow, target, aside),
        };
        Ok(Wrists {
            first: both(aside),
            second: (aside > 0.0).then(|| both(-aside)),
            free: None,
            freedom: 0,
            error,
        })
    }

    /// How far rounding may rotate the upper arm about the line from the shoulder to the
    /// intersection of axes 5 and 6 [rad].
    fn wrist_error(&self, elbow: &Elbow, target: &Target<'_>, aside: f64) -> f64 {
        let (across, rho) = (elbow.across.abs(), target.rho);
        let [speed_across, speed_along] = self.speeds(elbow);
        let (lever, speed) =
            if target.seen[1].abs() < rho { (across, speed_across) } else { (rho, speed_along) };
        let moved = self.direction_rounding() + speed.abs() * elbow.error;
        // The root of what rounding adds to the square of `aside`, from zero or from its value.
        let aside_error = (lever * moved / aside).min((2.0 * lever * moved).sqrt());
        match (across <= SHOULDER_MERGE, rho <= SHOULDER_MERGE) {
            (true, true) => 0.0,
            (true, false) => moved / rho,
            (false, true) => moved / across,
            (false, false) => aside_error * (1.0 / across + 1.0 / rho),
        }
    }
}

/// Joint 5 from the distance `aside` of the shoulder from the plane of axes 5 and 6 (eq. 61).
fn fifth(elbow: &Elbow, target: &Target<'_>, aside: f64) -> Turn {
    let side = sign_of(elbow.across);
    Turn::towards(-target.seen[1] * side, aside * side)
}

/// Joint 6 from the same distance (eq. 62).
fn sixth(elbow: &Elbow, target: &Target<'_>, aside: f64) -> Turn {
    let [x, _, z] = target.seen;
    Turn::towards(aside * z - elbow.along * x, aside * x + elbow.along * z)
}

/// The shoulder is on axis 5: joint 5 is undetermined, and joint 6 compensates for it.
fn on_5(elbow: &Elbow, target: &Target<'_>, aside: f64, rounding: f64, on_axis_6: bool) -> Wrist {
    let (policy, free, across) = (target.free.policy, target.free_theta[4], elbow.across.abs());
    let fifth = if policy.forces(5) || across <= policy.radius().max(rounding) {
        Turn::of(free)
    } else {
        Turn::from_pose(
            [fifth(elbow, target, aside), fifth(elbow, target, -aside)],
            free,
            across,
            policy,
        )
    };
    let sixth = if on_axis_6 && (policy.forces(6) || target.rho <= policy.radius().max(rounding)) {
        Turn::of(target.free_theta[5])
    } else {
        sixth(elbow, target, elbow.across * fifth.cos)
    };
    Wrist { fifth, sixth }
}

/// The shoulder is on axis 6: joint 6 is undetermined, and joint 5 compensates for it.
fn on_6(elbow: &Elbow, target: &Target<'_>, aside: f64, rounding: f64) -> Wrist {
    let (policy, free) = (target.free.policy, target.free_theta[5]);
    let sixth = if policy.forces(6) || target.rho <= policy.radius().max(rounding) {
        Turn::of(free)
    } else {
        Turn::from_pose(
            [sixth(elbow, target, aside), sixth(elbow, target, -aside)],
            free,
            target.rho,
            policy,
        )
    };
    let [x, _, z] = target.seen;
    Wrist { fifth: fifth(elbow, target, x * sixth.cos + z * sixth.sin), sixth }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub(super) theta: f64,
    pub(super) sin: f64,
    pub(super) cos: f64,
}

impl Turn {
    pub(super) fn of(theta: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        Self { theta, sin, cos }
    }

    /// The angle of the direction (cos, sin), of any length; `None` for length zero.
    pub(super) fn towards(sin: f64, cos: f64) -> Self {
        let norm = sin.hypot(cos);
        if norm == 0.0 {
            return Self { theta: 0.0, sin: 0.0, cos: 1.0 };
        }
        Self { theta: sin.atan2(cos), sin: sin / norm, cos: cos / norm }
    }

    /// Of two angles that a pose determines for a joint with lever at most `lever` [m], the one
    /// nearer to the angle `free`. A path keeps `free` as far as that moves the pose within its
    /// uncertainty: no leap from the angle that an undetermined pose left.
    pub(super) fn from_pose(twins: [Self; 2], free: f64, lever: f64, policy: SeedPolicy) -> Self {
        let [a, b] = twins;
        let nearer = if (b.theta - free).cos() > (a.theta - free).cos() { b } else { a };
        if policy != SeedPolicy::Path {
            return nearer;
        }
        let open = (SEEDED_FREE / lever).min(1.0).asin();
        Self::of(nearer.theta + wrap(free - nearer.theta).clamp(-open, open))
    }
}

/// The angles of the shoulder (eq. 63 and 64). `error` is how far rounding may rotate the upper
/// arm.
pub(super) fn shoulder(elbow: &Elbow, wrist: &Wrist, target: &Target<'_>, error: f64) -> Zyz {
    let upper_arm = target.rotation * upper_arm_to_hand(elbow, wrist).transpose();
    let first = First { joint: 1, theta: target.free_theta[0], policy: target.free.policy };
    // Even if elbow and wrist are more uncertain than that, the upper arm is not, once they are
    // chosen.
    zyz(&upper_arm, &first, error.min(REGULAR_WRIST_SIN))
}

/// `Ry(theta_4) Rz(theta_5) Ry(theta_6)`.
fn upper_arm_to_hand(elbow: &Elbow, wrist: &Wrist) -> Matrix3<f64> {
    let (s4, c4) = (elbow.sin_4, elbow.cos_4);
    let (s5, c5) = (wrist.fifth.sin, wrist.fifth.cos);
    let (s6, c6) = (wrist.sixth.sin, wrist.sixth.cos);
    Matrix3::new(
        c4 * (c5 * c6) - s4 * s6,
        -c4 * s5,
        c4 * (c5 * s6) + s4 * c6,
        s5 * c6,
        c5,
        s5 * s6,
        -s4 * (c5 * c6) - c4 * s6,
        s4 * s5,
        c4 * c6 - s4 * (c5 * s6),
    )
}
