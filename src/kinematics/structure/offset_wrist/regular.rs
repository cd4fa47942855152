//! Regular poses, several at once: every root of the resultant is simple, and the branch at it
//! closes away from every singularity.
//!
//! Docs: offset_wrist.md, section 6.

use fearless_simd::prelude::*;

use super::SLOTS;
use super::at_roots::AtRoots;
use super::geometry::Constants;
use super::resultant::{Hand, polynomial};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::in_order;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{RootBlock, RootRoom, SimpleRoots};
use crate::lanes::{LANES, Vector, VectorKernel, run_vectors};

/// How far a solution may be from its root [rad]: what is farther away may be that of another root.
const AT_ROOT: f64 = 1e-6;

/// Room for the solution of one pose.
pub(super) type One = Regular<1, 3, 3>;

/// The same for eight, with sixteen roots each. Parts that wait are divided before they are more
/// than those of one.
pub(super) type Eight = Regular<LANES, 6, 17>;

/// Room for the solution of regular poses, with so many blocks of parts of arcs and of roots.
pub(super) struct Regular<const POSES: usize, const PARTS: usize, const ROOTS: usize> {
    roots: RootRoom<POSES, PARTS, ROOTS>,
    solved: [Solved; POSES],
}

impl<const POSES: usize, const PARTS: usize, const ROOTS: usize> Regular<POSES, PARTS, ROOTS> {
    pub(super) const NEW: Self = Self { roots: RootRoom::NEW, solved: [Solved::NONE; POSES] };

    /// Solve for some poses of frame 6.
    pub(super) fn solve(&mut self, constants: &Constants, poses: &[Frame]) -> &[Solved] {
        let solved = &mut self.solved[..poses.len()];
        run_vectors(Solve { constants, poses, roots: self.roots.search(poses.len()), solved });
        &self.solved[..poses.len()]
    }
}

/// The solutions of a pose.
#[derive(Clone, Copy)]
pub(super) struct Solved {
    theta: [[f64; 6]; SLOTS],
    count: usize,
    /// Whether these are certain to be all.
    pub(super) is_regular: bool,
}

impl Solved {
    const NONE: Self = Self { theta: [[0.0; 6]; SLOTS], count: 0, is_regular: true };

    /// The solutions, by their first angles that differ: angles of the table [rad].
    pub(super) fn as_slice(&self) -> &[[f64; 6]] {
        &self.theta[..self.count]
    }

    fn push(&mut self, theta: [f64; 6]) {
        match self.theta.get_mut(self.count) {
            Some(place) => {
                *place = theta;
                self.count += 1;
            }
            None => self.is_regular = false,
        }
    }

    /// Put the solutions in order; two that are the same are not regular.
    fn sort(&mut self) {
        let all = &mut self.theta[..self.count];
        all.sort_unstable_by(in_order);
        self.is_regular &= all.windows(2).all(|pair| in_order(&pair[0], &pair[1]).is_ne());
    }
}

/// The solve of poses that may be regular, compiled for each instruction set.
struct Solve<'a> {
    constants: &'a Constants,
    poses: &'a [Frame],
    roots: SimpleRoots<'a>,
    solved: &'a mut [Solved],
}

impl VectorKernel for Solve<'_> {
    type Answer = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let Constants { lengths, closure, .. } = self.constants;
        for (number, pose) in self.poses.iter().enumerate() {
            self.roots.put(number, polynomial(simd, lengths, &Hand::of(lengths, pose)));
            (self.solved[number].count, self.solved[number].is_regular) = (0, true);
        }
        for number in 0..self.roots.isolate(simd) {
            let Some(RootBlock { of, angles, count }) = self.roots.block(simd, number) else {
                continue;
            };
            let last = Frame::of_lanes(simd, self.poses, &of);
            let at_roots =
                AtRoots::new(self.constants, &last, Vector::load_array_ref(simd, &angles));
            for number in 0..lengths.per_root() {
                let candidates = at_roots.converge(&at_roots.served(number).nearest);
                for lane in 0..count {
                    let (theta, solved) = (candidates.theta(lane), &mut self.solved[of[lane]]);
                    solved.is_regular &= candidates.is_regular(closure, lane)
                        && wrap(theta[5] - angles[lane]).abs() <= AT_ROOT;
                    solved.push(theta);
                }
            }
        }
        for (number, solved) in self.solved.iter_mut().enumerate() {
            solved.is_regular &= self.roots.are_all(number);
            if solved.is_regular {
                solved.sort();
            }
        }
    }
}
