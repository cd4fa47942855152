//! Motions in a cell: free all the way, or the first instant at which something touches.
//!
//! Boxes of joint angles that contain parts of the motion are proven free (docs/theory/cell.md,
//! eq. 2), eight at a time; a part that is not is halved.

use core::array;
use core::mem::replace;

use super::block::{Query, bits};
use super::checker::Checker;
use super::obstacles::Cell;
use super::postures::Nearest;
use crate::arm::Arm;
use crate::error::Error;
use crate::prelude::*;
use crate::trajectory::Trajectory;
use irbkin::internal::lanes::LANES;
use irbkin::internal::{check_length, check_seed};

/// Links that come nearer than this count as touching in a motion [m]: it bounds the halvings.
pub const RESOLUTION: f64 = 1e-4;

/// Parts of a motion that are tried first move anything at most so far [m].
const LONG: f64 = 0.5;

/// Postures at which the depth of a contact is measured until the end of its piece, and in all: one
/// at the end of each piece that follows, while the two touch.
const SAMPLES: u32 = 16;
const MOST_SAMPLES: u32 = 1000;

/// A motion in pieces.
#[doc(hidden)]
pub trait Motion<const N: usize> {
    /// Check that its joint angles are finite, and as many as the arm has.
    fn check(&self) -> Result<(), Error>;

    fn pieces(&self) -> usize;

    /// When it is at a part of a piece.
    fn instant(&self, piece: usize, part: f64) -> f64;

    /// Where the joint angles of a piece are from one part of it to another; a part is from 0 to 1.
    fn range(&self, piece: usize, part: [f64; 2]) -> Range<N>;
}

/// Joint angles `middle + u turns + e` with |u| <= 1 and |e| <= `beside` [rad].
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Range<const N: usize> {
    pub(super) middle: [f64; N],
    pub(super) turns: [f64; N],
    pub(super) beside: [f64; N],
}

impl<const N: usize> Range<N> {
    /// How far the joints turn from the middle to either side at most.
    pub(super) fn spans(&self) -> [f64; N] {
        array::from_fn(|joint| self.turns[joint].abs() + self.beside[joint])
    }
}

/// Joint vectors, each joint moving evenly from one to the next.
impl<const N: usize> Motion<N> for [[f64; N]] {
    fn check(&self) -> Result<(), Error> {
        Ok(self.iter().try_for_each(|q| check_seed("q", q))?)
    }

    fn pieces(&self) -> usize {
        // A single joint vector rests.
        if self.len() == 1 { 1 } else { self.len().saturating_sub(1) }
    }

    #[expect(clippy::cast_precision_loss, reason = "there are fewer than 2^52 joint vectors")]
    fn instant(&self, piece: usize, part: f64) -> f64 {
        piece as f64 + part
    }

    fn range(&self, piece: usize, [from, to]: [f64; 2]) -> Range<N> {
        let (first, last) = (&self[piece], &self[(piece + 1).min(self.len() - 1)]);
        let (part, half) = (0.5 * (from + to), 0.5 * (to - from));
        let way: [f64; N] = array::from_fn(|joint| last[joint] - first[joint]);
        let middle = array::from_fn(|joint| first[joint] + part * way[joint]);
        Range { middle, turns: way.map(|way| half * way), beside: [0.0; N] }
    }
}

impl<const N: usize> Motion<N> for Trajectory {
    fn check(&self) -> Result<(), Error> {
        Ok(check_length("trajectory", self.dof(), N)?)
    }

    fn pieces(&self) -> usize {
        self.pieces()
    }

    fn instant(&self, piece: usize, part: f64) -> f64 {
        self.time(piece, part)
    }

    fn range(&self, piece: usize, part: [f64; 2]) -> Range<N> {
        let lines: [_; N] = array::from_fn(|joint| self.line(joint, piece, part));
        Range {
            middle: lines.map(|[middle, ..]| middle),
            turns: lines.map(|[_, turns, _]| turns),
            beside: lines.map(|[.., beside]| beside),
        }
    }
}

/// Where a motion first touches something.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact<const N: usize> {
    /// When: the index of the joint vector before it, plus the part of the way to the next one that
    /// is behind; of a trajectory the time [s].
    pub at: f64,
    /// The joint angles there [rad].
    pub q: [f64; N],
    /// The nearest pair there.
    pub nearest: Nearest,
    /// How deep the two get into each other, or into the margin, until they are apart: of 16
    /// postures to the end of the piece and one at the end of each that follows [m].
    pub depth: f64,
}

/// A part of a piece that is not proven free yet.
#[derive(Clone, Copy)]
struct Part {
    piece: usize,
    part: [f64; 2],
}

impl Part {
    /// Its halves, the first one last.
    fn halves(self) -> [Self; 2] {
        let Self { piece, part: [from, to] } = self;
        let middle = 0.5 * (from + to);
        [Self { piece, part: [middle, to] }, Self { piece, part: [from, middle] }]
    }
}

impl Cell {
    /// [`Checker::check_path`] of an arm.
    ///
    /// # Errors
    ///
    /// As [`Self::collides`].
    pub fn check_path<const N: usize>(
        &self,
        arm: &Arm<N>,
        q: &[[f64; N]],
    ) -> Result<Option<Contact<N>>, Error> {
        self.checker(arm)?.check_path(q)
    }

    /// [`Checker::check_trajectory`] of an arm.
    ///
    /// # Errors
    ///
    /// As [`Checker::check_trajectory`]; [`Error::InvalidBody`] if the arm has no body.
    pub fn check_trajectory<const N: usize>(
        &self,
        arm: &Arm<N>,
        trajectory: &Trajectory,
    ) -> Result<Option<Contact<N>>, Error> {
        self.checker(arm)?.check_trajectory(trajectory)
    }
}

impl<const N: usize> Checker<'_, N> {
    /// Where a motion first collides or comes nearer than [`RESOLUTION`] to a collision; `None` if
    /// it is proven that it does not, at no instant.
    ///
    /// # Errors
    ///
    /// As [`Self::collides`].
    pub fn check_path(&mut self, q: &[[f64; N]]) -> Result<Option<Contact<N>>, Error> {
        self.check_motion(q)
    }

    /// [`Self::check_path`] along a trajectory.
    ///
    /// # Errors
    ///
    /// [`irbkin::Error::WrongLength`] if the trajectory has another number of joints.
    pub fn check_trajectory(
        &mut self,
        trajectory: &Trajectory,
    ) -> Result<Option<Contact<N>>, Error> {
        self.check_motion(trajectory)
    }

    /// [`Self::check_path`] of any motion, until it is interrupted.
    #[doc(hidden)]
    pub fn check_motion<M: Motion<N> + ?Sized>(
        &mut self,
        motion: &M,
    ) -> Result<Option<Contact<N>>, Error> {
        motion.check()?;
        let contact = self.contact(motion);
        self.interrupt.check(0)?;
        Ok(contact)
    }

    /// Where a motion first touches something; its joint angles must be finite. What is not proven
    /// when it is interrupted counts as touching.
    #[doc(hidden)]
    pub fn contact<M: Motion<N> + ?Sized>(&mut self, motion: &M) -> Option<Contact<N>> {
        let Part { piece, part } = self.first_part(motion, RESOLUTION)?;
        let q = motion.range(piece, part).middle;
        let (first, apart) = self.deepest(&q)?;
        let mut depth = self.depth(first.other, &apart);
        let pairs = self.like(&first);
        for sample in 1..=MOST_SAMPLES {
            // Evenly over this piece, then at the ends of the others.
            let (later, at) = match sample.checked_sub(SAMPLES) {
                None => (piece, part[0] + (1.0 - part[0]) * f64::from(sample) / f64::from(SAMPLES)),
                Some(more) => (piece + more as usize, 1.0),
            };
            if later >= motion.pieces() || self.interrupt.is_raised() {
                break;
            }
            let standing = self.at(&motion.range(later, [at; 2]).middle);
            let depths =
                pairs.iter().map(|pair| self.depth(pair.other, &self.separation(pair, &standing)));
            let own = depths.fold(f64::NEG_INFINITY, f64::max);
            depth = depth.max(own);
            if own <= 0.0 && sample >= SAMPLES {
                break;
            }
        }
        let at = motion.instant(piece, 0.5 * (part[0] + part[1]));
        Some(Contact { at, q, nearest: self.named(first, &apart), depth })
    }

    /// Whether a motion is proven free; what comes nearer than `resolution` [m] counts as a contact.
    pub(crate) fn is_free<M: Motion<N> + ?Sized>(&mut self, motion: &M, resolution: f64) -> bool {
        let mut left = Vec::new();
        for piece in 0..motion.pieces() {
            let most = self.most_motion(motion.range(piece, [0.0, 1.0]).spans());
            let mut from = 0.0;
            while from < 1.0 {
                let to = if most > LONG { (from + LONG / most).min(1.0) } else { 1.0 };
                left.push(Part { piece, part: [from, to] });
                from = to;
            }
        }
        while !left.is_empty() {
            let next = left.split_off(left.len().saturating_sub(LANES));
            let verdicts = self.verdicts(motion, &next, resolution);
            for (own, verdict) in next.iter().zip(verdicts) {
                match verdict {
                    Verdict::Free => {}
                    Verdict::Open if !self.interrupt.is_raised() => left.extend(own.halves()),
                    _ => return false,
                }
            }
        }
        true
    }

    /// The first part of a motion that is not free, as short as the resolution asks [m]; the start,
    /// if it collides.
    fn first_part<M: Motion<N> + ?Sized>(&mut self, motion: &M, resolution: f64) -> Option<Part> {
        let (mut contact, mut is_start_asked) = (None, true);
        // The first part is the last one here.
        let mut left = whole(motion.pieces());
        while !left.is_empty() {
            if self.interrupt.is_raised() {
                return left.pop();
            }
            let next = left.split_off(left.len().saturating_sub(LANES));
            let verdicts = self.verdicts(motion, &next, resolution);
            // The start is in the first piece, and free where that is.
            if replace(&mut is_start_asked, false) && verdicts[next.len() - 1] != Verdict::Free {
                let start = Part { piece: 0, part: [0.0, 0.0] };
                if self.touches(&motion.range(start.piece, start.part).middle) {
                    return Some(start);
                }
            }
            let touching = self.touching_middles(motion, &next, verdicts);
            for (lane, own) in next.iter().enumerate() {
                match verdicts[lane] {
                    Verdict::Free => {}
                    Verdict::Open if touching >> lane & 1 == 1 => {
                        // The half behind the middle does not count.
                        let [behind, before] = own.halves();
                        contact = Some(Part { part: [behind.part[0]; 2], ..behind });
                        left.clear();
                        left.push(before);
                    }
                    Verdict::Open => left.extend(own.halves()),
                    Verdict::Contact => {
                        contact = Some(*own);
                        left.clear();
                    }
                }
            }
        }
        contact
    }

    /// The open parts whose middles collide, as bits.
    fn touching_middles<M: Motion<N> + ?Sized>(
        &mut self,
        motion: &M,
        parts: &[Part],
        verdicts: [Verdict; LANES],
    ) -> u64 {
        if !verdicts[..parts.len()].iter().any(|verdict| matches!(verdict, Verdict::Open)) {
            return 0;
        }
        let mut q = [[0.0; N]; LANES];
        for (q, own) in q.iter_mut().zip(parts) {
            let middle = 0.5 * (own.part[0] + own.part[1]);
            *q = motion.range(own.piece, [middle; 2]).middle;
        }
        self.colliding(&q[..parts.len()])
    }

    /// Whether the motion from each joint vector to the next one is free.
    pub(crate) fn free_motions(&mut self, q: &[[f64; N]]) -> Vec<bool> {
        let mut free = vec![true; q.len().saturating_sub(1)];
        let mut left = whole(free.len());
        while !left.is_empty() {
            let next = left.split_off(left.len().saturating_sub(LANES));
            for (own, verdict) in next.iter().zip(self.verdicts(q, &next, RESOLUTION)) {
                match verdict {
                    Verdict::Open if free[own.piece] => left.extend(own.halves()),
                    Verdict::Contact => free[own.piece] = false,
                    _ => {}
                }
            }
        }
        free
    }

    /// Look at up to eight parts of a motion.
    fn verdicts<M: Motion<N> + ?Sized>(
        &mut self,
        motion: &M,
        parts: &[Part],
        resolution: f64,
    ) -> [Verdict; LANES] {
        let rest = Range { middle: [0.0; N], turns: [0.0; N], beside: [0.0; N] };
        let mut ranges = [rest; LANES];
        for (range, own) in ranges.iter_mut().zip(parts) {
            *range = motion.range(own.piece, own.part);
        }
        let q = ranges.map(|range| range.middle);
        let some = Query::Swept(&ranges[..parts.len()]);
        let touching = self.touching(&q[..parts.len()], some);
        array::from_fn(|lane| {
            if touching >> lane & 1 == 0 {
                Verdict::Free
            } else if self.most_motion(ranges[lane].spans()) <= resolution {
                Verdict::Contact
            } else {
                Verdict::Open
            }
        })
    }

    /// Whether an even motion is free: at eight states spread over it, and in each eighth, by a proof
    /// or at `blocks` more states.
    #[expect(clippy::cast_precision_loss, reason = "there are fewer than 2^52")]
    pub(crate) fn is_free_or_looked_at(&mut self, blocks: usize, ends: &[[f64; N]; 2]) -> bool {
        let eighth = |lane: usize| [lane, lane + 1].map(|end| end as f64 / LANES as f64);
        let at = |part| ends[..].range(0, [part; 2]).middle;
        if !self.are_free(1, at) {
            return false;
        }
        let ranges: [_; LANES] = array::from_fn(|lane| ends[..].range(0, eighth(lane)));
        let open = self.touching(&ranges.map(|range| range.middle), Query::Roughly(&ranges));
        // An eighth takes a block of states at least.
        let own = blocks.div_ceil(LANES);
        if open.count_ones() as usize * own >= blocks {
            return self.are_free(blocks, at);
        }
        bits(open).all(|lane| {
            let [from, to] = eighth(lane);
            self.are_free(own, |part| at(from + part * (to - from)))
        })
    }
}

/// All pieces, the first one last.
fn whole(pieces: usize) -> Vec<Part> {
    (0..pieces).rev().map(|piece| Part { piece, part: [0.0, 1.0] }).collect()
}

/// The proof of a part of a motion.
#[derive(Clone, Copy, PartialEq)]
enum Verdict {
    /// It is proven free.
    Free,
    /// It is not, and its halves may be.
    Open,
    /// It is not, and it is as short as the resolution asks.
    Contact,
}
