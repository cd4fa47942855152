//! The rest of a self-motion of an arm that is slightly off: several solutions next to a
//! singularity, on the curve on which five conditions hold.
//!
//! Docs: general.md, eq. 104d.

use arrayvec::ArrayVec;

use super::self_motion::{Member, SelfMotion};

/// Rate of the condition that is left at which it is least [1].
const LEAST_RATE: f64 = 1e-12;

impl SelfMotion<'_> {
    /// Pass the solutions on the curve: where the condition that is left changes its sign, and where
    /// it is least, for it may be zero next to there.
    pub(super) fn solutions(&self, pass: &mut dyn FnMut([f64; 6])) {
        self.around(&mut |ends| {
            let middle = self.least_between(ends);
            let ends = [Some(ends[0]), middle.as_ref(), Some(ends[1])];
            let ends: ArrayVec<&Member, 3> = ends.into_iter().flatten().collect();
            for pair in ends.windows(2) {
                let across = (pair[1].missing - pair[0].missing).normalize();
                let left = |one: &Member| one.missing.dot(&across);
                let zero = self.zero_between([pair[0], pair[1]], left, self.closure.rounding);
                if let Some(zero) = zero {
                    pass(zero.theta);
                }
            }
            if let Some(middle) = middle {
                pass(middle.theta);
            }
        });
    }

    /// Return the member between two of them at which the condition that is left is least.
    fn least_between(&self, ends: [&Member; 2]) -> Option<Member> {
        let [one, next] = ends;
        let is_less_between = one.missing.dot(&one.rate) < 0.0
            && next.missing.dot(&next.rate) > 0.0
            && one.missing.dot(&next.missing) > 0.0;
        let along = (next.rate - one.rate).normalize();
        is_less_between
            .then(|| self.zero_between(ends, |one| one.rate.dot(&along), LEAST_RATE))
            .flatten()
    }
}
