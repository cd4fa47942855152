//! Newton's method from eight joint vectors at once.

use crate::kinematics::pose::Pose;
use crate::kinematics::structure::closure::{Candidates, Closure};
use crate::kinematics::structure::end_frames::{Frame, Seen};
use crate::lanes::{Column, Kernel, LANES, atan2, run, sin_cos};

/// Eight configurations after Newton's method.
pub(super) struct Refinement {
    /// Angles of the table [rad].
    pub(super) theta: [Column; 6],
    /// The largest condition that is left [1].
    pub(super) residual: Column,
    /// The least singular value, to a small factor [1].
    pub(super) least: Column,
}

/// Bring eight configurations, by angles of the table [rad], onto a pose.
pub(super) fn refined(
    closure: &Closure,
    seen: &Seen,
    pose: &Pose,
    theta: &[Column; 6],
) -> Refinement {
    run(Refine { closure, seen, pose, theta })
}

struct Refine<'a> {
    closure: &'a Closure,
    seen: &'a Seen,
    pose: &'a Pose,
    theta: &'a [Column; 6],
}

impl Kernel for Refine<'_> {
    type Answer = Refinement;
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Refinement {
        let Self { closure, seen, pose, theta } = self;
        let mut theta = *theta;
        let target = closure.target(&seen.of::<FUSED>(&Frame::of(pose)));
        let mut on = Candidates::NEW;
        for joint in 0..6 {
            for lane in 0..LANES {
                (on.sin[joint][lane], on.cos[joint][lane]) = sin_cos::<FUSED>(theta[joint][lane]);
            }
        }
        closure.converge::<FUSED>(&target, &mut on);
        for joint in 0..6 {
            for lane in 0..LANES {
                theta[joint][lane] = atan2::<FUSED>(on.sin[joint][lane], on.cos[joint][lane]);
            }
        }
        Refinement { theta, residual: on.residual, least: on.least }
    }
}
