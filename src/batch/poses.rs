//! Many poses from and to translations with orientations.

use std::sync::{Mutex, PoisonError};

use super::pace::Batch;
use super::rows::{rows, rows_for, rows_out};
use crate::error::Error;
use crate::kinematics::{Pose, pose_from_rows, pose_to_rows};

/// Poses that are worked on at a time.
const PART: usize = 1024;

impl Batch<'_> {
    /// Makes poses of translations and of orientations of `R` numbers each; returns the first row
    /// that is invalid, and why.
    #[doc(hidden)]
    pub fn make_poses<const R: usize>(
        &mut self,
        xyz: &[f64],
        orientations: &[f64],
        poses: &mut [f64],
        make: impl Fn([f64; 3], [f64; R]) -> Result<Pose, Error> + Sync,
    ) -> Result<Option<(usize, Error)>, Error> {
        let xyz = rows::<3>("xyz", xyz)?;
        let orientations = rows_for::<R>("orientation", orientations, xyz.len())?;
        let poses = rows_out::<16, f64>("poses", poses, xyz.len())?;
        let refused = Mutex::new(None);
        let asked = xyz.chunks(PART).zip(orientations.chunks(PART)).enumerate();
        self.run(xyz.len(), asked.zip(poses.chunks_mut(PART)), |((part, asked), poses), _| {
            let mut refused = refused.lock().unwrap_or_else(PoisonError::into_inner);
            let rows = asked.0.iter().zip(asked.1).zip(poses).enumerate();
            for (row, ((xyz, orientation), pose)) in rows {
                match make(*xyz, *orientation) {
                    Ok(made) => *pose = pose_to_rows(&made),
                    Err(error) if refused.is_none() => *refused = Some((PART * part + row, error)),
                    Err(_) => {}
                }
            }
        });
        Ok(refused.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// Takes poses apart into translations and orientations of `R` numbers each; NaN for an
    /// invalid row.
    #[doc(hidden)]
    pub fn take_apart<const R: usize>(
        &mut self,
        poses: &[f64],
        xyz: &mut [f64],
        orientations: &mut [f64],
        take: impl Fn(&Pose) -> ([f64; 3], [f64; R]) + Sync,
    ) -> Result<(), Error> {
        let poses = rows::<16>("poses", poses)?;
        let xyz = rows_out::<3, f64>("xyz", xyz, poses.len())?;
        let orientations = rows_out::<R, f64>("orientation", orientations, poses.len())?;
        let answers = xyz.chunks_mut(PART).zip(orientations.chunks_mut(PART));
        self.run(
            poses.len(),
            poses.chunks(PART).zip(answers),
            |(poses, (xyz, orientations)), _| {
                for ((pose, xyz), orientation) in poses.iter().zip(xyz).zip(orientations) {
                    let nothing = ([f64::NAN; 3], [f64::NAN; R]);
                    (*xyz, *orientation) = pose_from_rows(pose).map_or(nothing, |pose| take(&pose));
                }
            },
        );
        Ok(())
    }
}
