//! Inverse kinematics of many poses.

use alloc::borrow::Cow;
use alloc::vec;
use core::num::NonZeroUsize;

use super::pace::Pace;
use super::rows::{check_length, rows, rows_for, rows_out};
use crate::error::Error;
use crate::kinematics::{ConfigurationRequest, Robot, Rows, check_weights, pose_from_rows};
use crate::report::Configuration;

/// Poses that a thread takes at a time: some ten microseconds of work.
const PART: usize = 512;

/// Poses that a thread takes where a pose may take a thousand times as long, next to a singularity.
pub(super) const SMALL_PART: usize = 64;

/// Each number of the configuration of an invalid row; no solution has it.
pub const NO_CONFIGURATION: i32 = i32::MIN;

/// The configuration of an invalid row.
const NONE: Configuration = Configuration {
    cf1: NO_CONFIGURATION,
    cf4: NO_CONFIGURATION,
    cf6: NO_CONFIGURATION,
    cfx: NO_CONFIGURATION,
};

/// Inverse kinematics: rows of 16 pose elements, and of seven joints the angle of joint 7 [rad] in
/// each, to [`Robot::slot_count`] slots of `N` joint angles and as many [`Status`](crate::Status)
/// bytes a row. Empty slots are NaN.
///
/// `angles` is empty for six joints and where a joint is locked at one angle. They belong to the
/// locked joint if that is the first or the last.
///
/// On up to `threads` threads, but no more than there are cores; without the feature `std`, on the
/// caller's.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not hold as many rows as `poses`,
/// [`Error::InvalidModel`] when the structure of the arm is unknown.
pub fn ik_with<const N: usize>(
    robot: &Robot<N>,
    poses: &[f64],
    angles: &[f64],
    q: &mut [f64],
    status: &mut [u8],
    threads: Option<NonZeroUsize>,
) -> Result<(), Error> {
    Pace::steady(threads).ik_with(robot, poses, angles, q, status)
}

/// [`ik_with`] of an arm of six joints.
///
/// # Errors
///
/// As [`ik_with`].
pub fn ik(
    robot: &Robot<6>,
    poses: &[f64],
    q: &mut [f64],
    status: &mut [u8],
    threads: Option<NonZeroUsize>,
) -> Result<(), Error> {
    Pace::steady(threads).ik(robot, poses, q, status)
}

/// Inverse kinematics next to seeds: rows of 16 pose elements and of joint angles to rows of joint
/// angles, as [`Robot::ik_nearest`] has them. A row that has none, or whose pose or seed is
/// invalid, is NaN.
///
/// On up to `threads` threads, as [`ik_with`].
///
/// # Errors
///
/// As [`ik`], and [`Error::InvalidJoints`] for a weight that is negative or not finite.
pub fn ik_nearest<const N: usize>(
    robot: &Robot<N>,
    poses: &[f64],
    seeds: &[f64],
    weights: &[f64; N],
    q: &mut [f64],
    threads: Option<NonZeroUsize>,
) -> Result<(), Error> {
    Pace::steady(threads).ik_nearest(robot, poses, seeds, weights, q)
}

/// Inverse kinematics by configurations: rows of 16 pose elements, and a configuration for each, to
/// rows of joint angles, as [`Robot::ik_configured`] has them or, with `seeds`,
/// [`Robot::ik_configured_or_nearest`]. A row that has none, or whose pose or seed is invalid, or
/// whose configuration marks an invalid row ([`NO_CONFIGURATION`]), is NaN.
///
/// On up to `threads` threads, as [`ik_with`].
///
/// # Errors
///
/// As [`ik`], [`Error::InvalidModel`] for an arm without a spherical wrist, and
/// [`Error::InvalidJoints`] for a number of a configuration that no configuration of the arm has.
pub fn ik_configured(
    robot: &Robot<6>,
    poses: &[f64],
    configurations: &[Configuration],
    seeds: Option<&[f64]>,
    q: &mut [f64],
    threads: Option<NonZeroUsize>,
) -> Result<(), Error> {
    let asked = Configured { configurations, arm_angles: None, seeds, or_nearest: seeds.is_some() };
    Pace::steady(threads).ik_configured(robot, poses, &asked, q)
}

/// The request for the solutions of rows of poses.
pub(crate) struct Configured<'a> {
    pub(crate) configurations: &'a [Configuration],
    /// The arm angle of each [rad].
    pub(crate) arm_angles: Option<&'a [f64]>,
    /// A joint vector for each [rad].
    pub(crate) seeds: Option<&'a [f64]>,
    /// Whether a row without its configuration gets the solution nearest to its seed.
    pub(crate) or_nearest: bool,
}

impl Pace<'_> {
    /// [`ik_with`]
    pub(crate) fn ik_with<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        angles: &[f64],
        q: &mut [f64],
        status: &mut [u8],
    ) -> Result<(), Error> {
        check_structure(robot)?;
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

    /// [`ik`]
    pub(crate) fn ik(
        &mut self,
        robot: &Robot<6>,
        poses: &[f64],
        q: &mut [f64],
        status: &mut [u8],
    ) -> Result<(), Error> {
        self.ik_with(robot, poses, &[], q, status)
    }

    /// [`ik_nearest`]
    pub(crate) fn ik_nearest<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        seeds: &[f64],
        weights: &[f64; N],
        q: &mut [f64],
    ) -> Result<(), Error> {
        check_structure(robot)?;
        check_weights(weights)?;
        let poses = rows::<16>("poses", poses)?;
        let seeds = rows_for::<N>("seeds", seeds, poses.len())?;
        let q = rows_out::<N, f64>("q", q, poses.len())?;
        let asked = poses.chunks(SMALL_PART).zip(seeds.chunks(SMALL_PART));
        let parts = asked.zip(q.chunks_mut(SMALL_PART));
        self.run(poses.len(), parts, |((poses, seeds), q), _| {
            robot.nearest_rows(poses, seeds, weights, q);
        });
        Ok(())
    }

    /// [`ik_configured`]
    pub(crate) fn ik_configured<const N: usize>(
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

    /// The arm angles of rows of seven joint angles [rad]; NaN where it does not exist.
    #[cfg(feature = "python")]
    pub(crate) fn arm_angles(
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

    /// The configurations of rows of joint angles, number by number; [`NO_CONFIGURATION`] of a row
    /// that is invalid.
    #[cfg(feature = "python")]
    pub(crate) fn configurations<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        numbers: [&mut [i32]; 4],
    ) -> Result<(), Error> {
        robot.configuration_rule()?;
        let q = rows::<N>("q", q)?;
        for numbers in &numbers {
            check_length("configurations", numbers.len(), q.len())?;
        }
        let [cf1, cf4, cf6, cfx] = numbers.map(|numbers| numbers.chunks_mut(PART));
        let parts = q.chunks(PART).zip(cf1.zip(cf4).zip(cf6.zip(cfx)));
        self.run(q.len(), parts, |(q, ((cf1, cf4), (cf6, cfx))), _| {
            let counts = cf1.iter_mut().zip(cf4).zip(cf6.iter_mut().zip(cfx));
            for (q, ((cf1, cf4), (cf6, cfx))) in q.iter().zip(counts) {
                let counted = robot.configuration(q).unwrap_or(NONE);
                (*cf1, *cf4, *cf6, *cfx) = (counted.cf1, counted.cf4, counted.cf6, counted.cfx);
            }
        });
        Ok(())
    }
}

/// The angles of the rows from one on, or no angles if the list is empty.
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

/// Whether the structure of an arm is known.
pub(super) fn check_structure<const N: usize>(robot: &Robot<N>) -> Result<(), Error> {
    robot.known_inverse().map(|_| ())
}
