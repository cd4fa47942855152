//! Regular poses, several at once.

use fearless_simd::Simd;

use super::method::{ByRoots, SLOTS};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::in_order;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{RootRoom, SimpleRoots};
use crate::lanes::{LANES, VectorKernel, run_vectors};

/// How far a solution may be from its root [rad]: what is farther away may be that of another root.
const AT_ROOT: f64 = 1e-6;

/// Room for the solution of one pose.
pub(crate) type One<M> = Regular<M, 1, 4, 3>;

/// The same for eight, with sixteen roots each. Parts that wait are divided before they are more
/// than those of one.
pub(crate) type Eight<M> = Regular<M, LANES, 6, 17>;

/// Room for the solution of regular poses, with so many blocks of parts of arcs and of roots.
pub(crate) struct Regular<M: ByRoots, const POSES: usize, const PARTS: usize, const ROOTS: usize> {
    posed: [M::Posed; POSES],
    roots: RootRoom<POSES, PARTS, ROOTS>,
    solved: [Solved; POSES],
}

impl<M: ByRoots, const POSES: usize, const PARTS: usize, const ROOTS: usize>
    Regular<M, POSES, PARTS, ROOTS>
{
    pub(crate) const NEW: Self =
        Self { posed: [M::NONE; POSES], roots: RootRoom::NEW, solved: [Solved::NONE; POSES] };

    /// Solve for some poses of the last frame.
    pub(crate) fn solve(&mut self, method: &M, poses: &[Frame]) -> &[Solved] {
        let many = poses.len();
        let (posed, solved) = (&mut self.posed[..many], &mut self.solved[..many]);
        run_vectors(Solve { method, poses, posed, roots: self.roots.search(many), solved });
        solved
    }
}

/// How many of some poses are regular.
pub(crate) fn regular_of<M: ByRoots>(method: &M, poses: &[Frame]) -> usize {
    let mut one = One::NEW;
    poses.iter().filter(|pose| one.solve(method, &[**pose])[0].is_regular).count()
}

/// The solutions of a pose.
#[derive(Clone, Copy)]
pub(crate) struct Solved {
    theta: [[f64; 6]; SLOTS],
    count: usize,
    /// Whether these are certain to be all.
    pub(crate) is_regular: bool,
}

impl Solved {
    const NONE: Self = Self { theta: [[0.0; 6]; SLOTS], count: 0, is_regular: true };

    /// The solutions, by their first angles that differ: angles of the table [rad].
    pub(crate) fn as_slice(&self) -> &[[f64; 6]] {
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
struct Solve<'a, M: ByRoots> {
    method: &'a M,
    poses: &'a [Frame],
    posed: &'a mut [M::Posed],
    roots: SimpleRoots<'a>,
    solved: &'a mut [Solved],
}

impl<M: ByRoots> VectorKernel for Solve<'_, M> {
    type Answer = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { method, poses, posed, mut roots, solved } = self;
        for (number, pose) in poses.iter().enumerate() {
            posed[number] = method.posed(simd, pose);
            roots.put(number, method.polynomial(simd, &posed[number]));
            (solved[number].count, solved[number].is_regular) = (0, true);
        }
        let closure = method.closure();
        for number in 0..roots.isolate(simd) {
            let block = roots.block(simd, number);
            method.candidates(simd, posed, &block, &mut |candidates, block| {
                for lane in 0..block.count {
                    let (theta, solved) = (candidates.theta(lane), &mut solved[block.of[lane]]);
                    let from_root = wrap(method.root_of(&theta) - block.angles[lane]).abs();
                    solved.is_regular &=
                        candidates.is_regular(closure, lane) && from_root <= AT_ROOT;
                    solved.push(theta);
                }
            });
        }
        for (number, solved) in solved.iter_mut().enumerate() {
            solved.is_regular &= roots.are_all(number);
            if solved.is_regular {
                solved.sort();
            }
        }
    }
}
