//! The motion ahead: the motion to the next set point and the braking motion after it
//! (docs/theory/stream.md, eq. 1), and its proof.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::brake::Brake;
use crate::cell::{Boxes, RESOLUTION};
use irbkin::JointLimits;
use irbkin::internal::lanes::LANES;

/// By how much a box of joint angles is wider [rad]: the phases of a braking motion and the steps
/// that are made in their place differ by less, 1e-10 in tests.
const WIDER: f64 = 1e-9;

/// Parts that are looked at first move anything at most so far, if eight are enough [m].
const LONG: f64 = 0.03;

/// Parts that may wait for a look [1].
const PARTS: usize = 4 * LANES;

/// The control points that the motion ahead depends on, and where its parts are.
pub(super) struct Ahead<const N: usize> {
    /// The last three control points and the next one.
    pub(super) points: [[f64; N]; 4],
    /// The braking motions behind the next one.
    pub(super) brakes: [Brake; N],
}

/// A box: its middle, and how far it goes to either side [rad].
pub(super) type Middle<const N: usize> = ([f64; N], [f64; N]);

impl<const N: usize> Ahead<N> {
    /// Cycles until the arm is at rest.
    pub(super) fn cycles(&self) -> f64 {
        self.brakes.iter().fold(0.0, |most, brake| brake.steps.max(most)) + 3.0
    }

    fn point(&self, joint: usize, index: f64) -> f64 {
        match index {
            0.0 => self.points[0][joint],
            1.0 => self.points[1][joint],
            2.0 => self.points[2][joint],
            _ => self.brakes[joint].at(index - 3.0),
        }
    }

    /// The least and the greatest of the control points from one to another.
    fn hull(&self, joint: usize, first: f64, last: f64) -> [f64; 2] {
        let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
        for (index, points) in [0.0, 1.0, 2.0].into_iter().zip(&self.points) {
            if first <= index && index <= last {
                (low, high) = (low.min(points[joint]), high.max(points[joint]));
            }
        }
        if last >= 3.0 {
            let brake = self.brakes[joint].range((first - 3.0).max(0.0), last - 3.0);
            (low, high) = (low.min(brake[0]), high.max(brake[1]));
        }
        [low, high]
    }

    /// A box that contains the joint angles from one cycle to another (eq. 1): the control points
    /// of all cycles in between, or in one cycle the ones of the part.
    pub(super) fn range(&self, [from, to]: [f64; 2]) -> Middle<N> {
        let first = from.floor();
        let is_one = to <= first + 1.0;
        let ranges: [[f64; 2]; N] = core::array::from_fn(|joint| {
            if !is_one {
                return self.hull(joint, first, to.ceil() + 2.0);
            }
            let own = [0.0, 1.0, 2.0, 3.0].map(|next| self.point(joint, first + next));
            let (a, b) = (from - first, to - first);
            let corners = [[a, a, a], [a, a, b], [a, b, b], [b, b, b]];
            let corners = corners.map(|at| blossom(own, at));
            corners.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], corner| {
                [low.min(corner), high.max(corner)]
            })
        });
        let middle = ranges.map(|[low, high]| 0.5 * (low + high));
        (middle, ranges.map(|[low, high]| 0.5 * (high - low) + WIDER))
    }

    /// The first differences at an instant, in cycles: the velocities times the cycle.
    pub(super) fn pace(&self, at: f64) -> [f64; N] {
        let first = at.floor();
        let part = at - first;
        core::array::from_fn(|joint| {
            let own = [0.0, 1.0, 2.0, 3.0].map(|next| self.point(joint, first + next));
            let weights =
                [0.5 * (1.0 - part) * (1.0 - part), 0.5 + part * (1.0 - part), 0.5 * part * part];
            (0..3).map(|next| weights[next] * (own[next + 1] - own[next])).sum()
        })
    }

    /// By how much the linkage of axes 2 and 3 would be outside its limits [rad]; `None` inside.
    pub(super) fn linkage_excess(&self, limits: &JointLimits<N>) -> Option<f64> {
        limits.linkage()?;
        let (mut index, mut most) = (3.0, 0.0_f64);
        while index <= self.cycles() {
            most = most.max(limits.linkage_excess(&core::array::from_fn(|joint| {
                if joint == 1 || joint == 2 { self.point(joint, index) } else { 0.0 }
            })));
            index += 1.0;
        }
        (most > 0.0).then_some(most)
    }

    /// Up to eight parts: the cycle ahead, and parts of the braking motion that are about equally
    /// long at an even deceleration; a single one is all of it.
    pub(super) fn parts(&self, count: usize) -> [[f64; 2]; LANES] {
        let rest = self.cycles() - 1.0;
        let mut from = 0.0;
        core::array::from_fn(|lane| {
            #[expect(clippy::cast_precision_loss, reason = "there are eight")]
            let left = if lane + 1 < count { 1.0 - lane as f64 / (count - 1) as f64 } else { 0.0 };
            let to = 1.0 + (rest * (1.0 - left.sqrt())).ceil().min(rest);
            let part = [from, to];
            from = to;
            part
        })
    }

    /// Prove the motion free in a bounded number of looks at up to eight boxes each; else a box
    /// that is left open. Where the arm would rest is looked at first, or if one look is not
    /// enough.
    pub(super) fn prove(
        &self,
        boxes: &mut Boxes<N>,
        looks: usize,
        stop_first: bool,
    ) -> Result<(), Middle<N>> {
        let rest = (self.brakes.map(|brake| brake.stop), [WIDER; N]);
        if stop_first && boxes.open(&[rest.0], &[rest.1]) != 0 {
            return Err(rest);
        }
        let whole = self.range([0.0, self.cycles()]).1;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 8")]
        let count = (boxes.most_motion(whole) / LONG).ceil().clamp(1.0, 8.0) as usize;
        let mut parts = [[0.0; 2]; PARTS];
        parts[..LANES].copy_from_slice(&self.parts(count));
        let mut left = count;
        for look in 0..looks {
            let count = left.min(LANES);
            left -= count;
            let mut looked = [[0.0; 2]; LANES];
            looked[..count].copy_from_slice(&parts[left..left + count]);
            let (mut q, mut spans) = ([[0.0; N]; LANES], [[0.0; N]; LANES]);
            for (lane, part) in looked[..count].iter().enumerate() {
                (q[lane], spans[lane]) = self.range(*part);
            }
            let open = boxes.open(&q[..count], &spans[..count]);
            let lanes = || (0..count).filter(|lane| open >> lane & 1 == 1);
            let Some(first) = lanes().next() else {
                if left == 0 {
                    return Ok(());
                }
                continue;
            };
            if look == 0 && !stop_first && boxes.open(&[rest.0], &[rest.1]) != 0 {
                return Err(rest);
            }
            let pieces = (LANES / lanes().count()).max(2);
            let is_short = |lane: usize| boxes.most_motion(spans[lane]) <= RESOLUTION;
            let is_last = look + 1 == looks || left + pieces * lanes().count() > PARTS;
            if is_last || lanes().any(is_short) {
                return Err((q[first], spans[first]));
            }
            for [from, to] in lanes().map(|lane| looked[lane]) {
                #[expect(clippy::cast_precision_loss, reason = "there are eight")]
                let at = |piece: usize| from + (to - from) * piece as f64 / pieces as f64;
                for piece in 0..pieces {
                    parts[left] = [at(piece), at(piece + 1)];
                    left += 1;
                }
            }
        }
        Err(self.range(parts[left.saturating_sub(1)]))
    }
}

/// The polar form of the cubic with four control points: at equal arguments the cubic itself, else
/// a control point of one of its parts (Farin, Curves and Surfaces for CAGD, 2002, 8.1).
fn blossom(points: [f64; 4], [x, y, z]: [f64; 3]) -> f64 {
    let [a, b, c, d] = points;
    let first = [
        ((1.0 - x) * a + (2.0 + x) * b) / 3.0,
        ((2.0 - x) * b + (1.0 + x) * c) / 3.0,
        ((3.0 - x) * c + x * d) / 3.0,
    ];
    let second = [
        0.5 * ((1.0 - y) * first[0] + (1.0 + y) * first[1]),
        0.5 * ((2.0 - y) * first[1] + y * first[2]),
    ];
    (1.0 - z) * second[0] + z * second[1]
}
