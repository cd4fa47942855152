//! Many joint vectors in a cell.

use super::pace::Batch;
use super::rows::{check_length, rows};
use crate::cell::{Cell, Placed};
use crate::error::Error;
use crate::kinematics::{Robot, check_seed, pose_from_rows};

/// Joint vectors that a thread takes at a time.
const JOINT_VECTORS: usize = 256;

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
        robot: &Robot<N>,
        q: &[f64],
        collides: &mut [bool],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        check_length("collides", collides.len(), q.len())?;
        q.iter().try_for_each(|q| check_seed("q", q))?;
        Placed::of(robot)?;
        let parts = q.chunks(JOINT_VECTORS).zip(collides.chunks_mut(JOINT_VECTORS));
        self.run(q.len(), parts, |(q, collides), _| {
            let Ok(mut placed) = Placed::of(robot) else { return };
            for (collides, free) in collides.iter_mut().zip(cell.free_postures(&mut placed, q)) {
                *collides = !free;
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
        robot: &Robot<N>,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; N],
        q: &mut [f64],
    ) -> Result<(), Error> {
        Placed::of(robot)?;
        self.seeded(poses, seeds, weights, q, |poses, seeds, q| {
            for ((pose, seed), q) in poses.iter().zip(seeds).zip(q) {
                let nearest = pose_from_rows(pose)
                    .and_then(|pose| cell.ik_nearest(robot, &pose, seed, weights));
                *q = nearest.map_or([f64::NAN; N], |nearest| nearest.q);
            }
        })
    }
}
