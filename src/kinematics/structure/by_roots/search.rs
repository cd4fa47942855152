//! Every solution of a pose that is not regular: at all roots and clusters of one polynomial after
//! another, and from starts all over the joints.
//!
//! Docs: general.md, section 7.

use super::attempt::{Shown, attempt};
use super::method::ByRoots;
use crate::kinematics::structure::closure::{Accepted, Closure, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::LANES;

/// Joint vectors from which Newton's method starts where no polynomial shows all solutions, and how
/// often it goes on from there.
const STARTS: usize = 128;
const ROUNDS: usize = 4;

/// The search for all solutions of a pose.
pub(crate) struct Search<'a> {
    closure: &'a Closure,
    last: &'a Frame,
    target: Target,
    /// The angles at which self-motions are to be represented [rad].
    near: [f64; 6],
    accepted: &'a mut Accepted,
    shown: Shown,
    /// How many polynomials must show that the solutions are all.
    wanted: usize,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        closure: &'a Closure,
        last: &'a Frame,
        near: [f64; 6],
        accepted: &'a mut Accepted,
        wanted: usize,
    ) -> Self {
        let target = closure.target(*last);
        // Nothing is beyond the sum of the lengths.
        let shown = if target.is_beyond() { Shown::All } else { Shown::Some };
        Self { closure, last, target, near, accepted, shown, wanted }
    }

    /// Take what is at the roots of a polynomial, unless earlier ones have shown enough.
    pub(crate) fn attempt(&mut self, method: &impl ByRoots) {
        let is_done = match self.shown {
            Shown::Some => false,
            Shown::Counted | Shown::Closed => !self.accepted.are_regular(),
            Shown::All => true,
        };
        if is_done {
            return;
        }
        let mut shown = attempt(method, self.last, &self.target, self.accepted);
        if shown == Shown::All && self.wanted > 1 {
            (shown, self.wanted) = (Shown::Counted, self.wanted - 1);
        }
        self.shown = self.shown.max(shown);
    }

    /// Take what Newton's method leads to from all over the joints, if no polynomial has shown
    /// enough, and represent self-motions. Returns whether the solutions are certified to be all.
    pub(crate) fn finish(mut self) -> bool {
        if self.shown < Shown::Closed {
            self.accepted.follow(self.closure, &self.target);
        }
        if self.shown < Shown::Counted {
            self.represent();
            self.start_anywhere();
            self.accepted.take_closest(self.closure, &self.target);
        }
        self.represent();
        self.shown == Shown::All
    }

    fn represent(&mut self) {
        if self.accepted.has_self_motion() {
            self.accepted.represent(self.closure, &self.target, &self.near);
        }
    }

    /// Start Newton's method all over the joints (eq. 104a).
    #[cold]
    fn start_anywhere(&mut self) {
        let Self { closure, target, accepted, .. } = self;
        let mut starts = (0..STARTS).map(quasi_random);
        // Rounds that are left in each lane: one that closes, or has none left, takes a new start.
        let (mut theta, mut left) = ([[0.0; LANES]; 6], [0; LANES]);
        loop {
            for lane in 0..LANES {
                if left[lane] == 0
                    && let Some(start) = starts.next()
                {
                    left[lane] = ROUNDS;
                    for joint in 0..6 {
                        theta[joint][lane] = start[joint];
                    }
                }
            }
            if left == [0; LANES] {
                break;
            }
            let mut candidates = closure.converged(target, &theta);
            theta = candidates.theta;
            for (residual, left) in candidates.residual.iter_mut().zip(&mut left) {
                let is_done = *left == 1 || *left > 0 && *residual <= closure.accepts();
                *left = if is_done { 0 } else { left.saturating_sub(1) };
                if !is_done {
                    *residual = f64::INFINITY;
                }
            }
            accepted.take(closure, target, &candidates, LANES);
        }
    }
}

/// Angles of a quasi-random sequence: multiples of powers of the inverse of the root of
/// x^7 = x + 1. Reference: Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.
pub(crate) fn quasi_random(index: usize) -> [f64; 6] {
    let root = 1.112_775_684_278_705_5_f64;
    let mut step = 1.0;
    core::array::from_fn(|_| {
        step /= root;
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let part = 0.5 + step * (index + 1) as f64;
        let whole = crate::lanes::whole_below(part);
        core::f64::consts::PI * (2.0 * (part - whole) - 1.0)
    })
}
