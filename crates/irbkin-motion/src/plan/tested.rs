//! The tests that joint vectors of a plan must pass: the caller's own, and a cell's.

use super::answer::StrandReason;
use super::graph::Values;
use super::options::{Accept, PlanOptions, Test};
use crate::arm::Arm;
use crate::cell::{Checker, Contact, Nearest};
use crate::error::Error;
use crate::plan::fault::PlanFault;
use crate::prelude::*;

/// The tests of a plan, if it has any.
pub(super) struct Tests<'a, 'b, const N: usize> {
    accept: Option<&'a mut Accept<'b, N>>,
    checker: Option<Checker<'a, N>>,
}

impl<'a, 'b, const N: usize> Tests<'a, 'b, N> {
    pub(super) fn new(
        arm: &'a Arm<N>,
        options: &'a PlanOptions<N>,
        accept: Option<&'a mut Accept<'b, N>>,
    ) -> Result<Self, Error> {
        let checker = match &options.cell {
            Some(_) if !options.external.is_empty() => return Err(PlanFault::CellMoves.into()),
            Some(cell) => Some(cell.checker(arm)?),
            None => None,
        };
        Ok(Self { accept, checker })
    }

    pub(super) fn is_any(&self) -> bool {
        self.accept.is_some() || self.checker.is_some()
    }

    pub(super) fn postures(&mut self, q: &[[f64; N]]) -> Option<Vec<bool>> {
        let mut passed = match &mut self.checker {
            Some(checker) => checker.free_postures(q),
            None => vec![true; q.len()],
        };
        if let Some(accept) = &mut self.accept {
            let verdicts = accept(q).filter(|verdicts| verdicts.len() == q.len())?;
            for (passed, accepted) in passed.iter_mut().zip(verdicts) {
                *passed &= accepted;
            }
        }
        Some(passed)
    }

    pub(super) fn motions(&mut self, q: &[[f64; N]]) -> Vec<bool> {
        match &mut self.checker {
            Some(checker) => checker.free_motions(q),
            None => vec![true; q.len().saturating_sub(1)],
        }
    }

    /// The reason why a joint vector, or the motion between two, does not pass.
    pub(super) fn reason(&mut self, q: &[[f64; N]]) -> StrandReason {
        match self.checker.as_mut().and_then(|checker| checker.contact(q)) {
            Some(Contact { nearest: Nearest { link, near, .. }, .. }) => {
                StrandReason::Collides { link, near, is_between: q.len() > 1 }
            }
            None => StrandReason::Rejected,
        }
    }
}

/// The tests of the joint vectors that six joints and the values of free axes make.
pub(super) struct OfSix<'a, 'b, 'c, const N: usize, F> {
    pub(super) tests: &'a mut Tests<'b, 'c, N>,
    pub(super) all: F,
}

impl<const N: usize, F: Fn(&[f64; 6], &Values) -> [f64; N]> OfSix<'_, '_, '_, N, F> {
    fn all(&self, q: &[[f64; 6]], values: &[Values]) -> Vec<[f64; N]> {
        q.iter().zip(values).map(|(q, values)| (self.all)(q, values)).collect()
    }
}

impl<const N: usize, F: Fn(&[f64; 6], &Values) -> [f64; N]> Test for OfSix<'_, '_, '_, N, F> {
    fn postures(&mut self, q: &[[f64; 6]], values: &[Values]) -> Option<Vec<bool>> {
        self.tests.postures(&self.all(q, values))
    }

    fn motions(&mut self, q: &[[f64; 6]], values: &[Values]) -> Vec<bool> {
        self.tests.motions(&self.all(q, values))
    }

    fn reason(&mut self, q: &[[f64; 6]], values: &[Values]) -> StrandReason {
        self.tests.reason(&self.all(q, values))
    }
}
