//! Many joint vectors in a cell.

use irbkin::batch::{Batch, Margins};
use irbkin::internal::lanes::LANES;
use irbkin::internal::{check_length, check_seed, rows};
use irbkin::{Robot, Status, pose};

use super::checker::Checker;
use super::obstacles::Cell;
use crate::arm::Arm;
use crate::error::Error;
use crate::prelude::*;

/// Joint vectors that a thread takes at a time.
const JOINT_VECTORS: usize = 1024;

/// Parts of a joint's range by which joint vectors are ordered.
const PARTS: u8 = 16;

impl Cell {
    /// [`Self::collides`] for rows of `N` joint angles.
    ///
    /// # Errors
    ///
    /// As [`Self::collides`], of the first row that is not finite; [`irbkin::Error::WrongLength`]
    /// when `collides` does not hold as many elements as `q` has rows.
    pub fn collides_batch<const N: usize>(
        &self,
        batch: &mut Batch<'_>,
        arm: &Arm<N>,
        q: &[f64],
        collides: &mut [bool],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        check_length("collides", collides.len(), q.len())?;
        q.iter().try_for_each(|q| check_seed("q", q))?;
        arm.needed_body()?;
        let parts = q.chunks(JOINT_VECTORS).zip(collides.chunks_mut(JOINT_VECTORS));
        batch.run(q.len(), parts, |(q, collides), _| {
            let Ok(mut checker) = self.checker(arm) else { return };
            for rows in by_posture(arm, q).chunks(LANES) {
                let mut own = [[0.0; N]; LANES];
                for (own, row) in own.iter_mut().zip(rows) {
                    *own = q[*row];
                }
                let colliding = checker.colliding(&own[..rows.len()]);
                for (lane, row) in rows.iter().enumerate() {
                    collides[*row] = colliding >> lane & 1 == 1;
                }
            }
        });
        Ok(())
    }

    /// [`Self::ik_nearest`] for rows of 16 pose elements and of `N` joint angles; NaN for a row
    /// without an answer.
    ///
    /// # Errors
    ///
    /// As [`Batch::ik_nearest`] and [`Self::collides`].
    pub fn ik_nearest_batch<const N: usize>(
        &self,
        batch: &mut Batch<'_>,
        arm: &Arm<N>,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; N],
        q: &mut [f64],
    ) -> Result<(), Error> {
        arm.needed_body()?;
        batch.seeded(poses, seeds, weights, q, |poses, seeds, q| {
            let Ok(mut checker) = self.checker(arm) else { return };
            for ((pose, seed), q) in poses.iter().zip(seeds).zip(q) {
                let nearest = pose::from_rows(pose)
                    .map_err(Error::from)
                    .and_then(|pose| checker.ik_nearest(&pose, seed, weights));
                *q = nearest.map_or([f64::NAN; N], |nearest| nearest.q);
            }
        })?;
        Ok(())
    }

    /// [`Batch::ik_margin`] of the solutions that do not collide.
    ///
    /// # Errors
    ///
    /// As [`Batch::ik_margin`]; [`Error::InvalidBody`] if the arm has no body.
    pub fn ik_margin_batch<const N: usize>(
        &self,
        batch: &mut Batch<'_>,
        arm: &Arm<N>,
        poses: &[f64],
        angles: &[f64],
        answers: Margins<'_>,
    ) -> Result<(), Error> {
        arm.check_structure()?;
        arm.needed_body()?;
        batch.ik_margin_without(arm, poses, angles, answers, |q, status| {
            if let Ok(mut checker) = self.checker(arm) {
                leave_out(&mut checker, q, status);
            }
        })?;
        Ok(())
    }
}

/// The places of joint vectors, ordered by the angles of the shoulder and the elbow: what is far
/// from one of eight that are looked at together is mostly far from all.
fn by_posture<const N: usize>(robot: &Robot<N>, q: &[[f64; N]]) -> Vec<usize> {
    let (limits, parts) = (robot.limits().to_array(), usize::from(PARTS));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few parts")]
    let part = |q: &[f64; N], joint: usize| {
        let [lower, upper] = limits[joint];
        let part = (q[joint] - lower) / (upper - lower) * f64::from(PARTS);
        (part as usize).min(parts - 1)
    };
    let key = |q: &[f64; N]| parts * part(q, 1) + part(q, (N - 1) / 2);
    let keys: Vec<usize> = q.iter().map(key).collect();
    // Counted, then put in place.
    let (mut ends, mut order) = (vec![0; parts * parts], vec![0; q.len()]);
    for key in &keys {
        ends[*key] += 1;
    }
    for key in 1..ends.len() {
        ends[key] += ends[key - 1];
    }
    for (row, key) in keys.iter().enumerate() {
        ends[*key] -= 1;
        order[ends[*key]] = row;
    }
    order
}

/// Take solutions that collide for outside the limits.
fn leave_out<const N: usize>(checker: &mut Checker<'_, N>, q: &[[f64; N]], status: &mut [u8]) {
    let within = Status::WITHIN_LIMITS;
    let is_within = |slot: &usize| Status::from_bits_truncate(status[*slot]).contains(within);
    let slots: Vec<usize> = (0..q.len()).filter(is_within).collect();
    let postures: Vec<[f64; N]> = slots.iter().map(|&slot| q[slot]).collect();
    for (slot, is_free) in slots.into_iter().zip(checker.free_postures(&postures)) {
        status[slot] &= if is_free { u8::MAX } else { !within.bits() };
    }
}
