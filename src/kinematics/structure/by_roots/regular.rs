//! Regular poses, several at once.

use core::f64::consts::TAU;

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::method::ByRoots;
use super::search::quasi_random;
use super::solved::{RootRows, Solved};
use crate::kinematics::structure::closure::Candidates;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::JointRow;
use crate::kinematics::structure::trigonometric::{RootBlock, SimpleRoots};
use crate::lanes::{LANES, Vector, VectorKernel, run_vectors, transposed};

/// How far a solution may be from its root [rad]: farther away it may belong to another root.
const AT_ROOT: f64 = 1e-6;

/// Solve for poses of the last frame, up to eight, by joint angles.
pub(crate) fn solve(
    method: &impl ByRoots,
    joints: &JointRow,
    poses: &[Frame],
    solved: &mut [Solved],
) {
    run_vectors(Solve { method, joints, poses, solved });
}

/// How many of some poses are regular.
pub(crate) fn regular_of(method: &impl ByRoots, poses: &[Frame]) -> usize {
    let mut solved = [Solved::NEW];
    let is_regular = |pose: &&Frame| {
        solve(method, &JointRow::OF_TABLE, &[**pose], &mut solved);
        solved[0].is_regular
    };
    poses.iter().filter(is_regular).count()
}

/// How far values of a polynomial may be off at least, relative to its size at other poses [1]: next
/// to singularities of the elimination it may vanish as a whole, by factors of 1e-20 and less.
pub(crate) const NOISE_OF_SIZE: f64 = f64::EPSILON;

/// Random poses that show how large a polynomial is.
const POSES: usize = 15;

/// Return how large the polynomial of a method is at random poses: the median.
pub(crate) fn size_of(method: &impl ByRoots) -> f64 {
    let size = |index| run_vectors(Size(method, method.closure().last_frame(&quasi_random(index))));
    let mut sizes: [f64; POSES] = core::array::from_fn(size);
    sizes.sort_unstable_by(f64::total_cmp);
    sizes[POSES / 2]
}

/// The size of the polynomial of a pose.
struct Size<'a, M: ByRoots>(&'a M, Frame);

impl<M: ByRoots> VectorKernel for Size<'_, M> {
    type Answer = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        let Self(method, last) = self;
        let size = method.polynomial(simd, &method.posed(simd, &last)).size();
        if size.is_finite() { size } else { 0.0 }
    }
}

/// The solve of poses that may be regular, compiled for each instruction set.
struct Solve<'a, M: ByRoots> {
    method: &'a M,
    joints: &'a JointRow,
    poses: &'a [Frame],
    solved: &'a mut [Solved],
}

impl<M: ByRoots> VectorKernel for Solve<'_, M> {
    type Answer = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { method, joints, poses, solved } = self;
        let mut posed = ArrayVec::<M::Posed, LANES>::new();
        let mut found = ArrayVec::<RootRows, LANES>::new();
        let mut roots = SimpleRoots::new();
        for pose in poses {
            posed.push(method.posed(simd, pose));
            roots.push(method.polynomial(simd, &posed[posed.len() - 1]).in_doubt());
            found.push(RootRows::new());
        }
        let closure = method.closure();
        for number in 0..roots.isolate(simd) {
            let block = roots.block(simd, number);
            method.candidates(
                simd,
                &posed,
                &block,
                #[inline(always)]
                |candidates, block| {
                    let at_roots = at_roots(simd, method, candidates, block);
                    let [a, b, c, d, e, f] = &candidates.theta;
                    let none = &[0.0; LANES];
                    let rows = transposed(simd, &[a, b, c, d, e, f, none, none]);
                    for lane in 0..block.count {
                        let is_regular =
                            at_roots >> lane & 1 == 1 && candidates.is_regular(closure, lane);
                        found[block.of[lane]].push(rows[lane], is_regular);
                    }
                },
            );
        }
        for (number, (found, solved)) in found.iter_mut().zip(solved).enumerate() {
            found.is_regular &= roots.are_all(number);
            solved.take(simd, found, joints);
        }
    }
}

/// The lanes, as bits, of candidates that are at their roots.
#[inline(always)]
fn at_roots<S: Simd>(
    simd: S,
    method: &impl ByRoots,
    candidates: &Candidates,
    block: &RootBlock,
) -> u64 {
    let (joint, sign) = method.searched();
    let angle = Vector::load_array_ref(simd, &candidates.theta[joint]) * sign;
    let from_root = (angle - Vector::load_array_ref(simd, &block.angles)).abs();
    // A root may be a turn on.
    from_root.min((from_root - TAU).abs()).simd_le(AT_ROOT).to_bitmask()
}
