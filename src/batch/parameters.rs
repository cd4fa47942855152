//! Poses of a corrected arm and their Jacobians in its parameters, of many joint vectors.

use super::pace::Pace;
use super::rows::{check_length, is_finite, rows, rows_out};
use crate::error::Error;
use crate::kinematics::{Corrections, Robot, pose_to_rows};

/// Joint vectors that are worked on at a time: some hundred microseconds of work.
const PART: usize = 256;

/// Jacobians in the parameters: rows of `N` joint angles to rows of 6 times [`Corrections::COUNT`]
/// elements.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not hold as many rows as `q`.
pub fn parameter_jacobian<const N: usize>(
    robot: &Robot<N>,
    corrections: &Corrections<N>,
    q: &[f64],
    jacobians: &mut [f64],
) -> Result<(), Error> {
    Pace::steady(None).parameter_jacobian(robot, corrections, q, jacobians)
}

/// Poses of a corrected arm: rows of `N` joint angles to rows of 16 pose elements.
///
/// # Errors
///
/// As [`parameter_jacobian`].
pub fn corrected_fk<const N: usize>(
    robot: &Robot<N>,
    corrections: &Corrections<N>,
    q: &[f64],
    poses: &mut [f64],
) -> Result<(), Error> {
    Pace::steady(None).corrected_fk(robot, corrections, q, poses)
}

impl Pace<'_> {
    /// [`parameter_jacobian`]
    pub(crate) fn parameter_jacobian<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        corrections: &Corrections<N>,
        q: &[f64],
        jacobians: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let size = 6 * Corrections::<N>::COUNT;
        check_length("jacobians", jacobians.len(), q.len() * size)?;
        let parts = q.chunks(PART).zip(jacobians.chunks_mut(PART * size));
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

    /// [`corrected_fk`]
    pub(crate) fn corrected_fk<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        corrections: &Corrections<N>,
        q: &[f64],
        poses: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        let poses = rows_out::<16, f64>("poses", poses, q.len())?;
        self.run(q.len(), q.chunks(PART).zip(poses.chunks_mut(PART)), |(q, poses), _| {
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
