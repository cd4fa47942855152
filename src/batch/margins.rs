//! How much room the solutions of many poses leave.

use alloc::vec;
use core::num::NonZeroUsize;

use super::inverse::check_structure;
use super::pace::Pace;
use super::rows::{check_length, rows};
use crate::error::Error;
use crate::kinematics::{Arity, Joints, Margin, RedundancyOf, Robot, Rows, Status};

/// Poses that a thread takes at a time: some ten microseconds of work.
const PART: usize = 64;

/// Where the answers of [`ik_margin`] are written, an element for each pose.
#[derive(Debug)]
pub struct Margins<'a> {
    /// The largest [`Margin::least`] of the solutions inside the limits, each with the full turns
    /// that leave the most room; NaN where there is none.
    pub margin: &'a mut [f64],
    /// The largest [`Margin::singularities`] of them; NaN where there is none.
    pub singularities: &'a mut [f64],
    /// Their number.
    pub solutions: &'a mut [u8],
}

/// How much room the solutions of poses leave to limits and singularities: rows of 16 pose
/// elements, and what is given with each, as [`ik_with`](super::ik_with) takes them. A row that is
/// invalid has no solution.
///
/// On up to `threads` threads, as [`ik_with`](super::ik_with).
///
/// # Errors
///
/// As [`ik_with`](super::ik_with).
pub fn ik_margin<const N: usize>(
    robot: &Robot<N>,
    poses: &[f64],
    redundancy: &[RedundancyOf<N>],
    answers: Margins<'_>,
    threads: Option<NonZeroUsize>,
) -> Result<(), Error>
where
    Joints<N>: Arity<N>,
{
    Pace::steady(threads).ik_margin(robot, poses, redundancy, answers)
}

impl Pace<'_> {
    /// [`ik_margin`]
    pub(crate) fn ik_margin<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        redundancy: &[RedundancyOf<N>],
        answers: Margins<'_>,
    ) -> Result<(), Error>
    where
        Joints<N>: Arity<N>,
    {
        check_structure(robot)?;
        let poses = rows::<16>("poses", poses)?;
        let Margins { margin, singularities, solutions: count } = answers;
        check_length("redundancy", redundancy.len(), poses.len())?;
        check_length("margin", margin.len(), poses.len())?;
        check_length("singularities", singularities.len(), poses.len())?;
        check_length("solutions", count.len(), poses.len())?;
        let asked = poses.chunks(PART).zip(redundancy.chunks(PART));
        let numbers = margin.chunks_mut(PART).zip(singularities.chunks_mut(PART));
        let parts = asked.zip(numbers.zip(count.chunks_mut(PART)));
        let slots = robot.slot_count();
        self.run(poses.len(), parts, |((poses, redundancy), ((margin, room), count)), _| {
            let mut q = vec![f64::NAN; poses.len() * slots * N];
            let mut status = vec![0; poses.len() * slots];
            robot.ik_rows(Rows { poses, redundancy, q: &mut q, status: &mut status });
            let solved = q.as_chunks::<N>().0.chunks(slots).zip(status.chunks(slots));
            for (row, (q, status)) in solved.enumerate() {
                (margin[row], room[row], count[row]) = most_room(robot, q, status);
            }
        });
        Ok(())
    }
}

/// The largest margin of the solutions inside the limits, their largest distance from
/// singularities, and their number.
fn most_room<const N: usize>(robot: &Robot<N>, q: &[[f64; N]], status: &[u8]) -> (f64, f64, u8)
where
    Joints<N>: Arity<N>,
{
    let (mut margin, mut singularities, mut count) = (f64::NAN, f64::NAN, 0);
    for (q, status) in q.iter().zip(status) {
        if Status::from_bits_truncate(*status).contains(Status::WITHIN_LIMITS) {
            let room: Margin = robot.margin_of_any_turn(q);
            // NaN is not larger.
            margin = margin.max(room.least());
            singularities = singularities.max(room.singularities);
            count += 1;
        }
    }
    (margin, singularities, count)
}
