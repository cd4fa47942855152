//! The self-motions through a configuration: several where they cross.
//!
//! Docs: general.md, eq. 103.

use nalgebra::{SMatrix, SVector};

use super::chain::{Closure, Target};
use super::curve::SECOND;
use super::member::Member;
use super::member::SWEEPS;
use super::self_motion::{STEP, SelfMotion};

/// Self-motions that cross in one configuration, at most.
const MOST_CROSSING: usize = 6;

/// Ways ahead that are tried: by each two joints.
const WAYS: usize = 36;

/// Cosine of the angle of two that are one [1].
const ALIKE: f64 = 0.95;

impl Closure {
    /// The self-motions through a configuration: several where they cross.
    pub(crate) fn self_motions<'a>(
        &'a self,
        target: &'a Target,
        theta: &[f64; 6],
    ) -> impl Iterator<Item = SelfMotion<'a>> + use<'a> {
        let alone = self.curve(target, theta).map(|curve| *curve.direction());
        let alone = alone.map(|direction| Member { theta: *theta, direction });
        let crossing = if alone.is_none() { Crossing::of(self, target, theta) } else { None };
        let starts = alone.into_iter().chain(crossing.into_iter().flatten());
        starts.map(|start| SelfMotion { closure: self, target, start })
    }
}

/// A member of each self-motion that crosses others in a configuration: a step ahead.
struct Crossing<'a> {
    closure: &'a Closure,
    target: &'a Target,
    theta: SVector<f64, 6>,
    /// The directions that are free, row by row; the others are zero.
    free: SMatrix<f64, 6, 6>,
    /// The next way ahead that is tried.
    number: usize,
    /// The ways of those that were found.
    found: [SVector<f64, 6>; MOST_CROSSING],
    count: usize,
}

impl<'a> Crossing<'a> {
    fn of(closure: &'a Closure, target: &'a Target, theta: &[f64; 6]) -> Option<Self> {
        let (jacobian, _) = closure.linear(target, theta);
        let svd = jacobian.try_svd(false, true, f64::EPSILON, SWEEPS)?;
        let mut free = svd.v_t?;
        for row in (0..6).filter(|row| svd.singular_values[*row] > SECOND) {
            free.row_mut(row).fill(0.0);
        }
        let found = [SVector::zeros(); MOST_CROSSING];
        let theta = SVector::from(*theta);
        Some(Self { closure, target, theta, free, number: 0, found, count: 0 })
    }

    /// What is free of one joint, or of two that turn with, or against, one another.
    fn way(&self, number: usize) -> SVector<f64, 6> {
        let (one, other) = (number / 6, number % 6);
        let sign = f64::from(u8::from(one < other)) - f64::from(u8::from(one > other));
        let free = self.free;
        (free.transpose() * (free.column(one) + free.column(other) * sign)).normalize()
    }
}

impl Iterator for Crossing<'_> {
    type Item = Member;

    fn next(&mut self) -> Option<Member> {
        while self.number < WAYS && self.count < MOST_CROSSING {
            let way = self.way(self.number);
            self.number += 1;
            let from = Member { theta: self.theta.into(), direction: way.into() };
            let guess = (self.theta + way * STEP).into();
            let ahead = self.closure.member_ahead(self.target, &from, STEP, guess);
            let Some(member) = ahead else { continue };
            let way = (SVector::from(member.theta) - self.theta).normalize();
            let is_new = self.found[..self.count].iter().all(|one| one.dot(&way).abs() < ALIKE);
            if is_new {
                self.found[self.count] = way;
                self.count += 1;
                return Some(member);
            }
        }
        None
    }
}
