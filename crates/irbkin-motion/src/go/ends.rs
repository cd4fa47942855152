//! The joint vectors at which a free motion may begin and end.

use core::f64::consts::{PI, TAU};

use super::End;
use crate::cell::{Checker, Nearest};
use crate::error::Error;
use crate::go::fault::GoFault;
use crate::prelude::*;
use crate::trajectory::distance;
use irbkin::internal::{at_limit, check_seed, checked_pose};
use irbkin::{Pose, Robot, Solutions};

/// Angles of joint 7 of which the solutions are taken.
const ANGLES: u32 = 24;

/// Most joint vectors at an end [1].
const MOST: usize = 64;

/// Joint vectors that are equal [rad].
const EQUAL: f64 = 1e-9;

/// An end of a motion, before what collides is left out.
struct Candidates<'a, const N: usize> {
    field: &'static str,
    /// Joint vectors of the other end, and whether turns away from them are taken too.
    near: &'a [[f64; N]],
    has_turns: bool,
}

/// The joint vectors at the start and at the goal that do not collide, the nearest first. A pose
/// has all its solutions at the turns of the joints nearest to the other end; at one end, other turns
/// too.
pub(super) fn free_ends<const N: usize>(
    checker: &mut Checker<'_, N>,
    robot: &Robot<N>,
    [start, goal]: [&End<N>; 2],
) -> Result<[Vec<[f64; N]>; 2], Error> {
    let (near, has_turns) = match goal {
        End::Joints(q) if q.iter().copied().all(f64::is_finite) => ([*q], true),
        _ => ([robot.limits().rest()], false),
    };
    let start =
        Candidates { field: "start", near: &near, has_turns }.free(checker, robot, start)?;
    let goal =
        Candidates { field: "goal", near: &start, has_turns: true }.free(checker, robot, goal)?;
    Ok([start, goal])
}

impl<const N: usize> Candidates<'_, N> {
    /// The joint vectors of an end that do not collide.
    fn free(
        &self,
        checker: &mut Checker<'_, N>,
        robot: &Robot<N>,
        end: &End<N>,
    ) -> Result<Vec<[f64; N]>, Error> {
        let pose = match end {
            End::Joints(q) => {
                let q = inside(robot, self.field, q)?;
                check_free(checker, self.field, &q)?;
                return Ok(vec![q]);
            }
            End::Pose(pose) => checked_pose(pose)?,
        };
        let (solutions, is_all) = self.solutions(robot, &pose)?;
        let is_free = checker.free_postures(&solutions);
        let free = solutions.iter().zip(is_free).filter(|(_, is_free)| *is_free);
        let free: Vec<_> = free.map(|(q, _)| *q).collect();
        if free.is_empty()
            && let Some(collision) = checker.collision(&solutions[0])
        {
            return Err(collides(self.field, collision, Some(solutions.len()), is_all).into());
        }
        Ok(self.turned(robot, &free))
    }

    /// The solutions of a pose inside the limits, the nearest first, and whether there are no others;
    /// of seven joints with joint 7 at some angles.
    fn solutions(&self, robot: &Robot<N>, pose: &Pose) -> Result<(Vec<[f64; N]>, bool), Error> {
        let field = self.field;
        let nearest = robot.ik_nearest(pose, &self.near[0], &[1.0; N]);
        let nearest = nearest.map_err(|error| match error {
            irbkin::Error::Unreachable(reason) => GoFault::Unreachable { field, reason }.into(),
            other => Error::from(other),
        })?;
        let (mut q, mut is_all) = (vec![nearest.q], !robot.is_redundant());
        let mut take = |solutions: &Solutions<N>| {
            is_all &= solutions.is_certified();
            is_all &= solutions.iter().all(|solution| solution.free_joint.is_none());
            q.extend(solutions.iter().filter_map(|solution| self.nearest_turn(robot, &solution.q)));
        };
        if robot.is_redundant() {
            let [low, high] = robot.limits().to_array()[N - 1];
            let (low, high) = (low.max(-PI), high.min(PI));
            for index in 0..ANGLES {
                let part = (f64::from(index) + 0.5) / f64::from(ANGLES);
                take(&robot.ik_with(pose, low + (high - low) * part)?);
            }
        } else {
            take(&robot.ik_with(pose, None)?);
        }
        Ok((self.sorted(q.into_iter()), is_all))
    }

    /// A solution at the turns of its joints that are nearest to the other end.
    fn nearest_turn(&self, robot: &Robot<N>, q: &[f64; N]) -> Option<[f64; N]> {
        let turned = self.near.iter().filter_map(|near| {
            let turned = robot.limits().wrapped_near(q, near)?;
            Some((distance(&turned, near), turned))
        });
        turned.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, turned)| turned)
    }

    /// Joint vectors at other turns too, inside the limits and less than one turn from the other end.
    fn turned(&self, robot: &Robot<N>, q: &[[f64; N]]) -> Vec<[f64; N]> {
        let mut all = q.to_vec();
        for q in q.iter().filter(|_| self.has_turns) {
            let first = all.len();
            all.push(*q);
            for joint in 0..N {
                for at in first..all.len() {
                    for turn in [-TAU, TAU] {
                        let mut turned = all[at];
                        turned[joint] += turn;
                        let is_near =
                            self.near.iter().any(|near| (turned[joint] - near[joint]).abs() < TAU);
                        if is_near && robot.limits().contains(&turned) {
                            all.push(turned);
                        }
                    }
                }
            }
        }
        let mut all = self.sorted(all.into_iter());
        all.truncate(MOST);
        all
    }

    /// Joint vectors by their distances from the other end, each one once.
    fn sorted(&self, all: impl Iterator<Item = [f64; N]>) -> Vec<[f64; N]> {
        let near = self.near;
        let from =
            |q: &[f64; N]| near.iter().map(|near| distance(q, near)).fold(f64::INFINITY, f64::min);
        let mut all: Vec<_> = all.map(|q| (from(&q), q)).collect();
        all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        all.dedup_by(|(_, a), (_, b)| distance(a, b) <= EQUAL);
        all.into_iter().map(|(_, q)| q).collect()
    }
}

/// The fault of an end that collides; `solutions` and `is_proven` as of [`GoFault::Collides`].
fn collides(
    field: &'static str,
    (Nearest { link, near, .. }, depth): (Nearest, f64),
    solutions: Option<usize>,
    is_proven: bool,
) -> GoFault {
    GoFault::Collides { field, solutions, link, other: near.to_string(), depth, is_proven }
}

pub(crate) fn check_free<const N: usize>(
    checker: &mut Checker<'_, N>,
    field: &'static str,
    q: &[f64; N],
) -> Result<(), Error> {
    let collision = if checker.touches(q) { checker.collision(q) } else { None };
    match collision {
        Some(collision) => Err(collides(field, collision, None, true).into()),
        None => Ok(()),
    }
}

/// Joint angles, checked: a locked joint is at its angle, the others are inside their limits, or at
/// a limit that they exceed by at most
/// [`START_TOLERANCE`](irbkin::internal::thresholds::START_TOLERANCE).
pub(crate) fn inside<const N: usize>(
    robot: &Robot<N>,
    field: &'static str,
    q: &[f64; N],
) -> Result<[f64; N], Error> {
    check_seed(field, q)?;
    let mut inside = *q;
    for (joint, (angle, bounds)) in inside.iter_mut().zip(robot.free_ranges()).enumerate() {
        let value = *angle;
        *angle = at_limit(value, bounds).ok_or(GoFault::Outside {
            field,
            joint: joint + 1,
            value,
            bounds,
        })?;
    }
    match robot.limits().linkage_excess(&inside) {
        0.0 => Ok(inside),
        excess => Err(GoFault::Linkage { field, excess }.into()),
    }
}
