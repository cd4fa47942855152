//! Rows of poses of a seven-axis arm with one joint given.

use super::inverse::SMALL_PART;
use super::pace::Pace;
use super::rows::{check_length, rows, rows_for, rows_out};
use crate::error::Error;
use crate::kinematics::{GivenJoint, Status, check_seed, check_weights, pose_from_rows};

impl Pace<'_> {
    /// The solutions of rows of poses, as [`ik_with`](super::ik_with) has them; `angles` are those
    /// of the joint, if they are not the prepared one.
    pub(crate) fn ik_given(
        &mut self,
        given: &GivenJoint,
        poses: &[f64],
        angles: Option<&[f64]>,
        q: &mut [f64],
        status: &mut [u8],
    ) -> Result<(), Error> {
        let (poses, slots) = (rows::<16>("poses", poses)?, given.six().slot_count());
        if let Some(angles) = angles {
            check_length("given", angles.len(), poses.len())?;
        }
        check_length("q", q.len(), slots * 7 * poses.len())?;
        check_length("status", status.len(), slots * poses.len())?;
        let solve = |row: usize| {
            let angle = angles.map_or(given.angle(), |angles| angles[row]);
            check_seed("given", &[angle])?;
            given.ik_checked(&pose_from_rows(&poses[row])?, angle)
        };
        let q = q.as_chunks_mut::<7>().0;
        let parts = q.chunks_mut(SMALL_PART * slots).zip(status.chunks_mut(SMALL_PART * slots));
        self.run(poses.len(), parts.enumerate(), |(part, (q, status)), _| {
            q.fill([f64::NAN; 7]);
            let rows = q.chunks_mut(slots).zip(status.chunks_mut(slots));
            for (row, (q, status)) in (SMALL_PART * part..).zip(rows) {
                let Ok(solutions) = solve(row) else {
                    status.fill(Status::INVALID.bits());
                    continue;
                };
                for (to, from) in status.iter_mut().zip(&*solutions.status()) {
                    *to = from.bits();
                }
                for solution in &solutions {
                    q[solution.slot.index()] = solution.q;
                }
            }
        });
        Ok(())
    }

    /// The solutions nearest to seeds, as [`ik_nearest`](super::ik_nearest) has them.
    pub(crate) fn ik_nearest_given(
        &mut self,
        given: &GivenJoint,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; 7],
        q: &mut [f64],
    ) -> Result<(), Error> {
        check_weights(weights)?;
        let poses = rows::<16>("poses", poses)?;
        let seeds = rows_for::<7>("seeds", seeds, poses.len())?;
        let q = rows_out::<7, f64>("q", q, poses.len())?;
        let solve = |row: usize| {
            check_seed("seed", &seeds[row])?;
            given.nearest_checked(&pose_from_rows(&poses[row])?, &seeds[row], weights)
        };
        self.run(poses.len(), q.chunks_mut(SMALL_PART).enumerate(), |(part, q), _| {
            for (row, q) in (SMALL_PART * part..).zip(q) {
                *q = solve(row).map_or([f64::NAN; 7], |solution| solution.q);
            }
        });
        Ok(())
    }
}
