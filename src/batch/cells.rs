//! Many joint vectors in a cell.

use alloc::vec;
use alloc::vec::Vec;

use super::pace::Batch;
use super::rows::{check_length, rows};
use crate::arm::Arm;
use crate::cell::Cell;
use crate::error::Error;
use crate::kinematics::{Robot, check_seed, pose_from_rows};
use crate::lanes::LANES;

/// Joint vectors that a thread takes at a time.
const JOINT_VECTORS: usize = 1024;

/// Parts of a joint's range by which joint vectors are ordered.
const PARTS: u8 = 16;

impl Batch<'_> {
    /// [`Cell::collides`] for rows of `N` joint angles.
    ///
    /// # Errors
    ///
    /// As [`Cell::collides`], of the first row that is not finite; [`Error::WrongLength`] when
    /// `collides` does not hold as many elements as `q` has rows.
    pub fn collides<const N: usize>(
        &mut self,
        cell: &Cell,
        arm: &Arm<N>,
        q: &[f64],
        collides: &mut [bool],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        check_length("collides", collides.len(), q.len())?;
        q.iter().try_for_each(|q| check_seed("q", q))?;
        arm.needed_body()?;
        let parts = q.chunks(JOINT_VECTORS).zip(collides.chunks_mut(JOINT_VECTORS));
        self.run(q.len(), parts, |(q, collides), _| {
            let Ok(mut checker) = cell.checker(arm) else { return };
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

    /// [`Cell::ik_nearest`] for rows of 16 pose elements and of `N` joint angles; NaN for a row
    /// without an answer.
    ///
    /// # Errors
    ///
    /// As [`Self::ik_nearest`] and [`Cell::collides`].
    pub fn ik_nearest_free<const N: usize>(
        &mut self,
        cell: &Cell,
        arm: &Arm<N>,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; N],
        q: &mut [f64],
    ) -> Result<(), Error> {
        arm.needed_body()?;
        self.seeded(poses, seeds, weights, q, |poses, seeds, q| {
            let Ok(mut checker) = cell.checker(arm) else { return };
            for ((pose, seed), q) in poses.iter().zip(seeds).zip(q) {
                let nearest =
                    pose_from_rows(pose).and_then(|pose| checker.ik_nearest(&pose, seed, weights));
                *q = nearest.map_or([f64::NAN; N], |nearest| nearest.q);
            }
        })
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
