//! Regular poses, several at once.

use arrayvec::ArrayVec;
use fearless_simd::Simd;

use super::method::{ByRoots, SLOTS};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::in_order;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::SimpleRoots;
use crate::lanes::{LANES, VectorKernel, run_vectors};

/// How far a solution may be from its root [rad]: what is farther away may be that of another root.
const AT_ROOT: f64 = 1e-6;

/// The solutions of up to eight poses.
pub(crate) struct Regular {
    solved: ArrayVec<Solved, LANES>,
}

impl Regular {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self { solved: ArrayVec::new() }
    }

    /// Solve for some poses of the last frame.
    pub(crate) fn solve(&mut self, method: &impl ByRoots, poses: &[Frame]) -> &[Solved] {
        run_vectors(Solve { method, poses, solved: &mut self.solved });
        &self.solved
    }
}

/// How many of some poses are regular.
pub(crate) fn regular_of(method: &impl ByRoots, poses: &[Frame]) -> usize {
    let mut regular = Regular::new();
    poses.iter().filter(|pose| regular.solve(method, &[**pose])[0].is_regular).count()
}

/// The solutions of a pose.
pub(crate) struct Solved {
    theta: ArrayVec<[f64; 6], SLOTS>,
    /// Whether these are certain to be all.
    pub(crate) is_regular: bool,
}

impl Solved {
    #[inline(always)]
    fn new() -> Self {
        Self { theta: ArrayVec::new(), is_regular: true }
    }

    /// The solutions, by their first angles that differ: angles of the table [rad].
    pub(crate) fn as_slice(&self) -> &[[f64; 6]] {
        &self.theta
    }

    fn push(&mut self, theta: [f64; 6]) {
        self.is_regular &= self.theta.try_push(theta).is_ok();
    }

    /// Put the solutions in order; two that are the same are not regular.
    fn sort(&mut self) {
        self.theta.sort_unstable_by(in_order);
        self.is_regular &= self.theta.windows(2).all(|pair| in_order(&pair[0], &pair[1]).is_ne());
    }
}

/// The solve of poses that may be regular, compiled for each instruction set.
struct Solve<'a, M: ByRoots> {
    method: &'a M,
    poses: &'a [Frame],
    solved: &'a mut ArrayVec<Solved, LANES>,
}

impl<M: ByRoots> VectorKernel for Solve<'_, M> {
    type Answer = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { method, poses, solved } = self;
        let mut posed = ArrayVec::<M::Posed, LANES>::new();
        let mut roots = SimpleRoots::new();
        solved.clear();
        for pose in poses {
            posed.push(method.posed(simd, pose));
            roots.push(method.polynomial(simd, &posed[posed.len() - 1]));
            solved.push(Solved::new());
        }
        let closure = method.closure();
        for number in 0..roots.isolate(simd) {
            let block = roots.block(simd, number);
            method.candidates(simd, &posed, &block, &mut |candidates, block| {
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
