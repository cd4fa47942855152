//! Inverse kinematics of many poses.

use alloc::borrow::Cow;
use alloc::vec;

use super::pace::Batch;
use super::rows::{check_length, rows, rows_for, rows_out};
use crate::error::Error;
use crate::kinematics::{ConfigurationRequest, Robot, Rows, check_weights, pose_from_rows};
use crate::report::Configuration;

/// Poses that a thread takes at a time: some ten microseconds of work.
const PART: usize = 512;

/// As [`PART`], where a pose next to a singularity may take a thousand times as long.
pub(super) const SMALL_PART: usize = 64;

/// Each number of the configuration of an invalid row; no solution has such a configuration.
pub const NO_CONFIGURATION: i32 = i32::MIN;

/// The configuration of an invalid row.
const NONE: Configuration = Configuration {
    cf1: NO_CONFIGURATION,
    cf4: NO_CONFIGURATION,
    cf6: NO_CONFIGURATION,
    cfx: NO_CONFIGURATION,
};

/// Configurations of rows of poses, with what chooses among several solutions.
#[derive(Clone, Copy, Debug)]
pub struct Configured<'a> {
    /// The configuration of each row.
    pub configurations: &'a [Configuration],
    /// The arm angle of each row [rad].
    pub arm_angles: Option<&'a [f64]>,
    /// The joint angles of each row [rad] to which the solution is the nearest.
    pub seeds: Option<&'a [f64]>,
    /// Whether a row without its configuration gets the solution nearest to its seed.
    pub or_nearest: bool,
}

impl Batch<'_> {
    /// Inverse kinematics: rows of 16 pose elements, and of seven joints the angle of joint 7 [rad]
    /// in each, to [`Robot::slot_count`] slots of `N` joint angles and as many
    /// [`Status`](crate::Status) bytes a row. Empty slots are NaN.
    ///
    /// `angles` is empty for six joints and where a joint is locked at one angle. They are angles
    /// of the locked joint if that is the first or the last.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when a slice does not hold as many rows as `poses`,
    /// [`Error::InvalidModel`] when the structure of the arm is unknown.
    pub fn ik_with<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        angles: &[f64],
        q: &mut [f64],
        status: &mut [u8],
    ) -> Result<(), Error> {
        robot.check_structure()?;
        let (poses, slots) = (rows::<16>("poses", poses)?, robot.slot_count());
        let angles = &*robot.angles_of_rows(angles, poses.len())?;
        check_length("q", q.len(), slots * N * poses.len())?;
        check_length("status", status.len(), slots * poses.len())?;
        let answers = q.chunks_mut(PART * slots * N).zip(status.chunks_mut(PART * slots));
        let asked = poses.chunks(PART).enumerate();
        self.run(poses.len(), asked.zip(answers), |((part, poses), (q, status)), _| {
            let locked = part_of(angles, PART * part);
            robot.ik_rows(Rows { poses, locked, q, status });
        });
        Ok(())
    }

    /// [`Self::ik_with`] of an arm of six joints.
    ///
    /// # Errors
    ///
    /// As [`Self::ik_with`].
    pub fn ik(
        &mut self,
        robot: &Robot<6>,
        poses: &[f64],
        q: &mut [f64],
        status: &mut [u8],
    ) -> Result<(), Error> {
        self.ik_with(robot, poses, &[], q, status)
    }

    /// Inverse kinematics next to seeds: rows of 16 pose elements and of joint angles to rows of
    /// joint angles, as [`Robot::ik_nearest`] returns them. A row without a solution, or whose pose
    /// or seed is invalid, is NaN.
    ///
    /// # Errors
    ///
    /// As [`Self::ik_with`], and [`Error::InvalidJoints`] for a weight that is negative or not
    /// finite.
    pub fn ik_nearest<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; N],
        q: &mut [f64],
    ) -> Result<(), Error> {
        robot.check_structure()?;
        self.seeded(poses, seeds, weights, q, |poses, seeds, q| {
            robot.nearest_rows(poses, seeds, weights, q);
        })
    }

    /// Call `solve` for parts of rows of poses, of seeds and of answers.
    #[doc(hidden)]
    pub fn seeded<const N: usize>(
        &mut self,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; N],
        q: &mut [f64],
        solve: impl Fn(&[[f64; 16]], &[[f64; N]], &mut [[f64; N]]) + Sync,
    ) -> Result<(), Error> {
        check_weights(weights)?;
        let poses = rows::<16>("poses", poses)?;
        let seeds = rows_for::<N>("seeds", seeds, poses.len())?;
        let q = rows_out::<N, f64>("q", q, poses.len())?;
        let asked = poses.chunks(SMALL_PART).zip(seeds.chunks(SMALL_PART));
        let parts = asked.zip(q.chunks_mut(SMALL_PART));
        self.run(poses.len(), parts, |((poses, seeds), q), _| solve(poses, seeds, q));
        Ok(())
    }

    /// Inverse kinematics by configurations: rows of 16 pose elements, with what is asked of each,
    /// to rows of joint angles, as [`Robot::ik_configured`] returns them. A row without such a
    /// solution, or whose pose or seed is invalid, or with the configuration of an invalid row
    /// ([`NO_CONFIGURATION`]), is NaN.
    ///
    /// # Errors
    ///
    /// As [`Self::ik_with`], [`Error::InvalidModel`] for an arm without configurations, and
    /// [`Error::InvalidJoints`] for a number of a configuration that no configuration of the arm
    /// has.
    pub fn ik_configured<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        asked: &Configured<'_>,
        q: &mut [f64],
    ) -> Result<(), Error> {
        robot.configuration_rule()?;
        let (poses, configurations) = (rows::<16>("poses", poses)?, asked.configurations);
        check_length("configurations", configurations.len(), poses.len())?;
        for configuration in configurations.iter().filter(|configuration| **configuration != NONE) {
            configuration.check(robot.is_coupled())?;
        }
        let seeds = match asked.seeds {
            Some(seeds) => Some(rows_for::<N>("seeds", seeds, poses.len())?),
            None => None,
        };
        if let Some(arm_angles) = asked.arm_angles {
            check_length("arm_angles", arm_angles.len(), poses.len())?;
        }
        let solve = |row: usize| {
            let request = ConfigurationRequest {
                configuration: configurations[row],
                arm_angle: asked.arm_angles.map(|angles| angles[row]),
                seed: seeds.map(|seeds| seeds[row]),
                or_nearest: asked.or_nearest,
            };
            request.check()?;
            robot.configured_checked(pose_from_rows(&poses[row])?, &request)
        };
        let q = rows_out::<N, f64>("q", q, poses.len())?;
        self.run(poses.len(), q.chunks_mut(SMALL_PART).enumerate(), |(part, q), _| {
            for (row, q) in (SMALL_PART * part..).zip(q) {
                *q = solve(row).map_or([f64::NAN; N], |solution| solution.q);
            }
        });
        Ok(())
    }

    /// Arm angles [rad] of rows of seven joint angles, as [`Robot::arm_angle`] returns them; NaN
    /// where the row has no answer.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when `angles` does not hold as many numbers as `q` has rows,
    /// [`Error::InvalidModel`] for an arm that has no arm angle.
    pub fn arm_angle(
        &mut self,
        robot: &Robot<7>,
        q: &[f64],
        angles: &mut [f64],
    ) -> Result<(), Error> {
        robot.arm_angle(&[0.0; 7])?;
        let q = rows::<7>("q", q)?;
        check_length("arm_angles", angles.len(), q.len())?;
        let parts = q.chunks(PART).zip(angles.chunks_mut(PART));
        self.run(q.len(), parts, |(q, angles), _| {
            for (q, angle) in q.iter().zip(angles) {
                *angle = robot.arm_angle(q).ok().flatten().unwrap_or(f64::NAN);
            }
        });
        Ok(())
    }

    /// Configurations: rows of `N` joint angles to rows of cf1, cf4, cf6, cfx; four times
    /// [`NO_CONFIGURATION`] for a row that is invalid.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when `numbers` does not hold as many rows as `q`,
    /// [`Error::InvalidModel`] for an arm without configurations.
    pub fn configuration<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        numbers: &mut [i32],
    ) -> Result<(), Error> {
        robot.configuration_rule()?;
        let q = rows::<N>("q", q)?;
        let numbers = rows_out::<4, i32>("configurations", numbers, q.len())?;
        self.run(q.len(), q.chunks(PART).zip(numbers.chunks_mut(PART)), |(q, numbers), _| {
            for (q, numbers) in q.iter().zip(numbers) {
                let Configuration { cf1, cf4, cf6, cfx } = robot.configuration(q).unwrap_or(NONE);
                *numbers = [cf1, cf4, cf6, cfx];
            }
        });
        Ok(())
    }
}

/// The angles of the rows from one on; none if there are none.
pub(super) fn part_of(angles: &[f64], from: usize) -> &[f64] {
    angles.get(from..).unwrap_or(&[])
}

impl<const N: usize> Robot<N> {
    /// The angle of the locked joint in each of some rows [rad]: as it is given, or its own.
    pub(super) fn angles_of_rows<'a>(
        &self,
        angles: &'a [f64],
        rows: usize,
    ) -> Result<Cow<'a, [f64]>, Error> {
        match self.locked_joint() {
            Some((_, angle)) if angles.is_empty() => return Ok(Cow::Owned(vec![angle; rows])),
            // Another angle of a joint between the ends is another chain.
            Some((2..=6, _)) => check_length("angles", angles.len(), 0)?,
            None if N < 7 => check_length("angles", angles.len(), 0)?,
            _ => check_length("angles", angles.len(), rows)?,
        }
        Ok(Cow::Borrowed(angles))
    }
}
