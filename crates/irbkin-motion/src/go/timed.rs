//! The motion along a path: its corners rounded as far as that is free, at the fastest pace.

use super::GoOptions;
use super::search::{Evidence, RESOLUTION, Space, between};
use crate::cell;
use crate::error::Error;
use crate::prelude::*;
use crate::trajectory::{
    AxisLimits, Profile, Synchronization, Trajectory, distance, joint_within, paced, rounded,
};
use irbkin::Robot;

/// Even motions that are tried first.
const DIRECT: usize = 16;

/// How much of a side a rounded corner takes at most [1].
const LARGEST: f64 = 0.45;

/// How far the sides of a corner are looked at, as a part of what it takes of them [1].
const BEYOND: f64 = 1.1;

/// Halvings of a corner, after which the motion stops there.
const HALVINGS: i32 = 6;

/// Joint vectors that are one [rad].
const LEAST: f64 = 1e-12;

/// Velocity over acceleration of a joint without limits of acceleration [s].
const RISE: f64 = 0.5;

/// Limits of the joints.
pub(super) struct Pace<const N: usize> {
    velocity: [f64; N],
    acceleration: [f64; N],
}

impl<const N: usize> Pace<N> {
    pub(super) fn new(robot: &Robot<N>, options: &GoOptions<N>) -> Result<Self, Error> {
        let own = robot.max_velocity().copied().unwrap_or([1.0; N]);
        let velocity = options.max_velocity.unwrap_or(own);
        let default = velocity.map(|velocity| velocity / RISE);
        let pace = Self { velocity, acceleration: options.max_acceleration.unwrap_or(default) };
        // Refuses limits that are not positive.
        pace.straight(&[[0.0; N]; 2])?;
        Ok(pace)
    }

    /// From rest to rest, the joints along a straight line.
    fn straight(&self, [from, to]: &[[f64; N]; 2]) -> Result<Trajectory, Error> {
        // A motion over less would take no time that counts.
        let from = if distance(from, to) < LEAST { to } else { from };
        let limits: [_; N] = core::array::from_fn(|joint| AxisLimits {
            velocity: self.velocity[joint],
            acceleration: self.acceleration[joint],
            jerk: f64::INFINITY,
        });
        joint_within(Profile::Trapezoid, from, to, &limits, Synchronization::Phase)
    }

    /// From rest to rest along a path with rounded corners, with a stop at those that are not.
    fn along(&self, path: &[[f64; N]], cuts: &[f64]) -> Result<Trajectory, Error> {
        let mut motion: Option<Trajectory> = None;
        let mut first = 0;
        for last in 1..path.len() {
            if last + 1 < path.len() && cuts[last - 1] > 0.0 {
                continue;
            }
            let part = match &path[first..=last] {
                [from, to] => self.straight(&[*from, *to])?,
                part => {
                    let path = rounded(part, &cuts[first..last - 1]);
                    paced(&path, &self.velocity, &self.acceleration)?
                }
            };
            motion = Some(match motion {
                Some(motion) => motion.then(&part)?,
                None => part,
            });
            first = last;
        }
        motion.map_or_else(|| self.straight(&[path[0]; 2]), Ok)
    }
}

impl<const N: usize> Space<'_, N> {
    /// The shortest even motion from a start to a goal, of those that are proven free.
    pub(super) fn direct(
        &mut self,
        [starts, goals]: &[Vec<[f64; N]>; 2],
        pace: &Pace<N>,
    ) -> Result<Option<Trajectory>, Error> {
        let goals = |start| goals.iter().map(move |goal| (distance(start, goal), [*start, *goal]));
        let mut both: Vec<_> = starts.iter().flat_map(goals).collect();
        both.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        for (_, [start, goal]) in both.into_iter().take(DIRECT) {
            if self.is_free(&start, &goal) {
                let motion = self.timed(&[start, goal], pace)?;
                if motion.is_some() {
                    return Ok(motion);
                }
            }
        }
        Ok(None)
    }

    /// The motion along a path once it is shorter, if that is proven free.
    pub(super) fn motion(
        &mut self,
        path: &[[f64; N]],
        seed: u64,
        pace: &Pace<N>,
    ) -> Result<Option<Trajectory>, Error> {
        let shorter = self.shortened(path, seed);
        self.timed(&shorter, pace)
    }

    /// The motion along a path that is proven free.
    fn timed(&mut self, path: &[[f64; N]], pace: &Pace<N>) -> Result<Option<Trajectory>, Error> {
        // Corners by what they count as free, at last none.
        let corners: &[Option<Evidence>] = match self.evidence {
            _ if path.len() == 2 => &[None],
            Evidence::States => &[Some(Evidence::States), Some(Evidence::Proof), None],
            Evidence::Proof => &[Some(Evidence::Proof), None],
        };
        for evidence in corners {
            let cuts = match evidence {
                Some(evidence) => self.cuts(path, *evidence),
                None => vec![0.0; path.len() - 2],
            };
            let motion = pace.along(path, &cuts)?;
            if self.checker.is_free(&motion, cell::RESOLUTION) {
                return Ok(Some(motion));
            }
        }
        Ok(None)
    }

    /// How far before and behind each corner it is rounded, so that the path is free.
    fn cuts(&mut self, path: &[[f64; N]], evidence: Evidence) -> Vec<f64> {
        let sides: Vec<f64> = path.windows(2).map(|ends| distance(&ends[0], &ends[1])).collect();
        let mut cuts: Vec<f64> =
            sides.windows(2).map(|sides| LARGEST * sides[0].min(sides[1])).collect();
        for (corner, cut) in cuts.iter_mut().enumerate() {
            let [before, at, behind] = [0, 1, 2].map(|place| path[corner + place]);
            let mut is_free = |cut: &f64| {
                let from = |part: f64| between(&at, &before, part * cut / sides[corner]);
                let to = |part: f64| between(&at, &behind, part * cut / sides[corner + 1]);
                let is_free =
                    self.are_free(2.0 * cut, |part| between(&from(1.0 - part), &to(part), part));
                is_free
                    && (evidence == Evidence::States || {
                        let path = rounded(&[from(BEYOND), at, to(BEYOND)], &[*cut]);
                        self.checker.is_free(&path, RESOLUTION)
                    })
            };
            let largest = *cut;
            let mut smaller = (0..HALVINGS).map(|halving| largest * 0.5_f64.powi(halving));
            *cut = smaller.find(|cut| is_free(cut)).unwrap_or(0.0);
        }
        cuts
    }
}
