//! Free motion: from joint angles or a pose to joint angles or a pose, without touching anything
//! (docs/guide/cell.md).

mod ends;
pub(crate) mod fault;
mod samples;
mod search;
mod shorten;
mod timed;

pub(crate) use ends::{check_free, inside};

use search::{Evidence, Space};

use crate::arm::Arm;
use crate::cell::Cell;
use crate::error::Error;
use crate::go::fault::GoFault;
use crate::trajectory::Trajectory;
use irbkin::{Interrupt, Pose};

/// An end of a free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End<const N: usize> {
    /// Joint angles [rad].
    Joints([f64; N]),
    /// A pose of the tool, with any of its solutions.
    Pose(Pose),
}

/// How a free motion is sought and timed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GoOptions<const N: usize> {
    /// Which samples are taken: one seed gives one motion.
    pub seed: u64,
    /// Limits of the velocities [rad/s]; the robot's if `None`, 1 rad/s if they are unknown.
    pub max_velocity: Option<[f64; N]>,
    /// Limits of the accelerations [rad/s^2]; if `None`, full velocity in half a second.
    pub max_acceleration: Option<[f64; N]>,
}

impl<const N: usize> Arm<N> {
    /// A motion from one end to another, from rest to rest, that is proven free at every instant
    /// ([`Cell::check_trajectory`]). Each joint moves evenly to the nearest goal if that is free;
    /// else a path is sought, shortened and rounded.
    ///
    /// The search goes on until it is interrupted, which is asked for each sample; a motion depends
    /// on the seed alone.
    ///
    /// ```
    /// use irbkin_motion::Arm;
    /// use irbkin::Interrupt;
    /// use irbkin_motion::body::Shape;
    /// use irbkin_motion::cell::Cell;
    /// use irbkin_motion::go::{End, GoOptions};
    ///
    /// let arm: Arm<6> = Arm::named("UR5e")?;
    /// let post = Shape::sphere(0.2, [-0.6, 0.0, 0.4])?;
    /// let cell = Cell::new(vec![("post".into(), post)], 0.01)?;
    /// let [start, goal] = [[-1.0, -1.0, 1.2, -1.6, -1.5, 0.0], [1.0, -1.0, 1.2, -1.6, -1.5, 0.0]];
    /// let samples = core::cell::Cell::new(0);
    /// let is_enough = || samples.replace(samples.get() + 1) >= 10_000;
    /// let motion = arm.go(
    ///     &End::Joints(start),
    ///     &End::Joints(goal),
    ///     &cell,
    ///     &GoOptions::default(),
    ///     Interrupt::when(&is_enough),
    /// )?;
    /// assert!(cell.check_trajectory(&arm, &motion)?.is_none());
    /// # Ok::<(), irbkin_motion::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::NoMotion`] if an end collides, is not reached or is outside the limits, or if no
    /// motion was found, which its words keep apart; [`irbkin::Error::InvalidPose`] and
    /// [`irbkin::Error::InvalidJoints`] for ends that are not finite; [`Error::InvalidMotion`] for limits
    /// that are not positive; [`Error::InvalidBody`] if the arm has no body.
    pub fn go(
        &self,
        start: &End<N>,
        goal: &End<N>,
        cell: &Cell,
        options: &GoOptions<N>,
        interrupt: Interrupt<'_>,
    ) -> Result<Trajectory, Error> {
        let pace = timed::Pace::new(self, options)?;
        let mut checker = cell.checker(self)?;
        let ends = ends::free_ends(&mut checker, self, [start, goal])?;
        let mut space = Space { robot: self, checker, evidence: Evidence::States, samples: 0 };
        if let Some(motion) = space.direct(&ends, &pace)? {
            return Ok(motion);
        }
        // A path that is free at states of it mostly is in between.
        let path = space.path(&ends, options.seed, interrupt)?;
        if let Some(motion) = space.motion(&path, options.seed, &pace)? {
            return Ok(motion);
        }
        space.evidence = Evidence::Proof;
        if let Some(motion) = space.motion(&path, options.seed, &pace)? {
            return Ok(motion);
        }
        let path = space.path(&ends, options.seed, interrupt)?;
        let motion = space.motion(&path, options.seed, &pace)?;
        Ok(motion.ok_or(GoFault::NotFound { samples: space.samples })?)
    }
}
