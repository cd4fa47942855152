//! Poses, frames, Jacobians and distances from singularities of many joint vectors.

use super::pace::Batch;
use super::rows::{check_length, is_finite, rows, rows_out};
use crate::error::Error;
use crate::kinematics::{Corrections, JacobianFrame, Robot, Singularity, pose_to_rows};

/// Joint vectors that a thread takes at a time: some ten microseconds of work.
const PART: usize = 1024;

/// As [`PART`], for work that takes some hundred nanoseconds a row.
const SMALL_PART: usize = 256;

impl Batch<'_> {
    /// Forward kinematics: rows of `N` joint angles to rows of 16 pose elements.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when a slice does not hold as many rows as `q`.
    pub fn fk<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        poses: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let poses = rows_out::<16, f64>("poses", poses, q.len())?;
        self.run(q.len(), q.chunks(PART).zip(poses.chunks_mut(PART)), |(q, poses), _| {
            robot.fk_rows(q, poses);
        });
        Ok(())
    }

    /// Link frames: rows of `N` joint angles to `N + 1` times 16 pose elements a row.
    ///
    /// # Errors
    ///
    /// As [`Self::fk`].
    pub fn link_frames<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        frames: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let frames = rows_out::<16, f64>("frames", frames, q.len() * (N + 1))?;
        let parts = q.chunks(PART).zip(frames.chunks_mut(PART * (N + 1)));
        self.run(q.len(), parts, |(q, frames), _| {
            for (q, frames) in q.iter().zip(frames.chunks_exact_mut(N + 1)) {
                if !is_finite(q) {
                    frames.fill([f64::NAN; 16]);
                    continue;
                }
                let (links, tool) = robot.link_frames(q);
                for (to, from) in frames.iter_mut().zip(links.iter().chain([&tool])) {
                    *to = pose_to_rows(from);
                }
            }
        });
        Ok(())
    }

    /// Geometric Jacobians: rows of `N` joint angles to rows of 6 times `N` elements.
    ///
    /// # Errors
    ///
    /// As [`Self::fk`].
    pub fn jacobian<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        frame: JacobianFrame,
        jacobians: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let jacobians = rows_out::<N, f64>("jacobians", jacobians, q.len() * 6)?;
        let jacobians = jacobians.as_chunks_mut::<6>().0;
        self.run(q.len(), q.chunks(PART).zip(jacobians.chunks_mut(PART)), |(q, jacobians), _| {
            robot.jacobians(q, frame, jacobians);
        });
        Ok(())
    }

    /// Distances from the singularities, a record for each row of `N` joint angles; `None` for a
    /// row that is not finite.
    ///
    /// # Errors
    ///
    /// As [`Self::fk`].
    pub fn singularity<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        records: &mut [Option<Singularity>],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        check_length("records", records.len(), q.len())?;
        let parts = q.chunks(SMALL_PART).zip(records.chunks_mut(SMALL_PART));
        self.run(q.len(), parts, |(q, records), _| {
            for (record, found) in records.iter_mut().zip(robot.singularities(q)) {
                *record = found;
            }
        });
        Ok(())
    }

    /// Jacobians in the parameters: rows of `N` joint angles to rows of 6 times
    /// [`Corrections::COUNT`] elements.
    ///
    /// # Errors
    ///
    /// As [`Self::fk`].
    pub fn parameter_jacobian<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        corrections: &Corrections<N>,
        q: &[f64],
        jacobians: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let size = 6 * Corrections::<N>::COUNT;
        check_length("jacobians", jacobians.len(), q.len() * size)?;
        let parts = q.chunks(SMALL_PART).zip(jacobians.chunks_mut(SMALL_PART * size));
        self.run(q.len(), parts, |(q, jacobians), _| {
            for (q, jacobian) in q.iter().zip(jacobians.chunks_exact_mut(size)) {
                // Of the right length, it is written in any case.
                let written = robot.parameter_jacobian(corrections, q, jacobian);
                if written.is_err() || !is_finite(q) {
                    jacobian.fill(f64::NAN);
                }
            }
        });
        Ok(())
    }

    /// Poses of a corrected arm: rows of `N` joint angles to rows of 16 pose elements.
    ///
    /// # Errors
    ///
    /// As [`Self::fk`].
    pub fn corrected_fk<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        corrections: &Corrections<N>,
        q: &[f64],
        poses: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let poses = rows_out::<16, f64>("poses", poses, q.len())?;
        let parts = q.chunks(SMALL_PART).zip(poses.chunks_mut(SMALL_PART));
        self.run(q.len(), parts, |(q, poses), _| {
            for (q, pose) in q.iter().zip(poses) {
                *pose = if is_finite(q) {
                    pose_to_rows(&robot.corrected_fk(corrections, q))
                } else {
                    [f64::NAN; 16]
                };
            }
        });
        Ok(())
    }
}
