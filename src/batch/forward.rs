//! Poses, frames, Jacobians and distances from singularities of many joint vectors.

use super::pace::Pace;
use super::rows::{is_finite, rows, rows_out};
use crate::error::Error;
use crate::kinematics::{JacobianFrame, Robot, Singularity, pose_to_rows};
use crate::report::Configuration;

/// Joint vectors that are worked on at a time: some ten microseconds of work.
const PART: usize = 1024;

/// Forward kinematics: rows of `N` joint angles to rows of 16 pose elements.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not hold as many rows as `q`.
pub fn fk<const N: usize>(robot: &Robot<N>, q: &[f64], poses: &mut [f64]) -> Result<(), Error> {
    Pace::steady(None).fk(robot, q, poses)
}

/// Link frames: rows of `N` joint angles to `N + 1` times 16 pose elements a row.
///
/// # Errors
///
/// As [`fk`].
pub fn link_frames<const N: usize>(
    robot: &Robot<N>,
    q: &[f64],
    frames: &mut [f64],
) -> Result<(), Error> {
    Pace::steady(None).link_frames(robot, q, frames)
}

/// Geometric Jacobians: rows of `N` joint angles to rows of 6 times `N` elements.
///
/// # Errors
///
/// As [`fk`].
pub fn jacobian<const N: usize>(
    robot: &Robot<N>,
    q: &[f64],
    frame: JacobianFrame,
    jacobians: &mut [f64],
) -> Result<(), Error> {
    Pace::steady(None).jacobian(robot, q, frame, jacobians)
}

/// Distances from the singularities, one record a row of `N` joint angles; `None` for a row that is
/// not finite.
///
/// # Errors
///
/// As [`fk`].
pub fn singularity<'a, const N: usize>(
    robot: &'a Robot<N>,
    q: &'a [f64],
) -> Result<impl Iterator<Item = Option<Singularity>> + 'a, Error> {
    Ok(robot.singularities(rows::<N>("q", q)?))
}

/// Configurations, one a row of six joint angles; an error for a row that is not finite.
///
/// # Errors
///
/// As [`fk`], and [`Error::InvalidModel`] for an arm without a spherical wrist.
pub fn configuration<'a>(
    robot: &'a Robot<6>,
    q: &'a [f64],
) -> Result<impl Iterator<Item = Result<Configuration, Error>> + 'a, Error> {
    robot.configuration_rule()?;
    Ok(rows::<6>("q", q)?.iter().map(|q| robot.configuration(q)))
}

impl Pace<'_> {
    /// [`fk`]
    pub(crate) fn fk<const N: usize>(
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

    /// [`link_frames`]
    pub(crate) fn link_frames<const N: usize>(
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

    /// [`jacobian`]
    pub(crate) fn jacobian<const N: usize>(
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

    /// [`singularity`], with `write` called for parts: their number and records.
    #[cfg(feature = "python")]
    pub(crate) fn singularity<const N: usize, C: Send>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        columns: impl Iterator<Item = C> + Send,
        write: impl Fn(C, &mut dyn Iterator<Item = Option<Singularity>>) + Sync,
    ) -> Result<(), Error> {
        let count = rows::<N>("q", q)?.len();
        self.run(count, q.chunks(Self::SINGULARITIES * N).zip(columns), |(q, columns), _| {
            // The part has whole rows.
            if let Ok(mut records) = singularity(robot, q) {
                write(columns, &mut records);
            }
        });
        Ok(())
    }

    /// Rows of a part of [`Self::singularity`].
    #[cfg(feature = "python")]
    pub(crate) const SINGULARITIES: usize = 256;
}
