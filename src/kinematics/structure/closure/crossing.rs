//! The self-motions through a configuration: several where they cross.
//!
//! Docs: general.md, eq. 103.

use nalgebra::SVector;

use super::chain::{Closure, Target};
use super::curve::SECOND;
use super::member::Member;
use super::member::SWEEPS;
use super::self_motion::{STEP, SelfMotion};

/// Self-motions that cross in one configuration, at most.
const MOST_CROSSING: usize = 6;

/// Cosine of the angle of two that are one [1].
const ALIKE: f64 = 0.95;

impl Closure {
    /// The self-motions through a configuration: several where they cross.
    pub(crate) fn self_motions<'a>(
        &'a self,
        target: &'a Target,
        theta: &[f64; 6],
    ) -> impl Iterator<Item = SelfMotion<'a>> + use<'a> {
        let starts = self.starts(target, theta).unwrap_or_default();
        let motion = |start| SelfMotion { closure: self, target, start };
        starts.into_iter().flatten().map(motion)
    }

    /// A member of each self-motion through a configuration: itself, or a step ahead of a crossing.
    fn starts(&self, target: &Target, theta: &[f64; 6]) -> Option<[Option<Member>; MOST_CROSSING]> {
        let mut starts = [None; MOST_CROSSING];
        let (jacobian, _) = self.linear(target, theta);
        let svd = jacobian.try_svd(false, true, f64::EPSILON, SWEEPS)?;
        let v_t = svd.v_t?;
        let values = svd.singular_values;
        if values[4] > SECOND {
            let direction = v_t.row(5).transpose().into();
            starts[0] = Some(Member { theta: *theta, direction });
            return Some(starts);
        }
        let origin = SVector::from(*theta);
        let mut found = [SVector::<f64, 6>::zeros(); MOST_CROSSING];
        let mut count = 0;
        for number in 0..36 {
            // What is free of one joint, or of two that turn with, or against, one another.
            let (one, other) = (number / 6, number % 6);
            let sign = f64::from(u8::from(one < other)) - f64::from(u8::from(one > other));
            let mut way = SVector::<f64, 6>::zeros();
            for row in (0..6).filter(|row| values[*row] <= SECOND) {
                let free = v_t.row(row).transpose();
                way += free * (free[one] + sign * free[other]);
            }
            let way = way.normalize();
            let from = Member { theta: *theta, direction: way.into() };
            let guess = (origin + way * STEP).into();
            let Some(member) = self.member_ahead(target, &from, STEP, guess) else { continue };
            let way = (SVector::from(member.theta) - origin).normalize();
            let is_new = found.iter().all(|one| one.dot(&way).abs() < ALIKE);
            if is_new && count < MOST_CROSSING {
                (found[count], starts[count]) = (way, Some(member));
                count += 1;
            }
        }
        Some(starts)
    }
}
