//! How much room many joint vectors, and the solutions of many poses, leave.

use alloc::vec;

use super::inverse::part_of;
use super::pace::Batch;
use super::rows::{check_length, is_finite, rows};
use crate::error::Error;
use crate::kinematics::{Margin, Robot, Rows, Status};

/// Poses that a thread takes at a time: some ten microseconds of work.
const PART: usize = 64;

/// Joint vectors that a thread takes at a time.
const JOINT_VECTORS: usize = 1024;

/// Where [`Batch::ik_margin`] writes its answers, an element for each pose.
#[derive(Debug)]
pub struct Margins<'a> {
    /// The largest [`Margin::least`] of the solutions inside the limits, each with the full turns
    /// that leave the most room; NaN without an answer.
    pub margin: &'a mut [f64],
    /// The largest [`Margin::singularities`] of them; NaN without an answer.
    pub singularities: &'a mut [f64],
    /// Their number.
    pub solutions: &'a mut [u8],
}

impl Batch<'_> {
    /// How far rows of `N` joint angles are from limits and singularities, the two numbers of
    /// [`Robot::margin`] for each row; NaN for a row that is not finite.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when a slice does not hold as many rows as `q`.
    pub fn margin<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        q: &[f64],
        limits: &mut [f64],
        singularities: &mut [f64],
    ) -> Result<(), Error> {
        let q = rows::<N>("q", q)?;
        check_length("limits", limits.len(), q.len())?;
        check_length("singularities", singularities.len(), q.len())?;
        let answers = limits.chunks_mut(JOINT_VECTORS).zip(singularities.chunks_mut(JOINT_VECTORS));
        let parts = q.chunks(JOINT_VECTORS).zip(answers);
        self.run(q.len(), parts, |(q, (limits, singularities)), _| {
            for (row, q) in q.iter().enumerate() {
                let unknown = Margin { limits: f64::NAN, singularities: f64::NAN };
                let margin = if is_finite(q) { robot.margin(q) } else { unknown };
                (limits[row], singularities[row]) = (margin.limits, margin.singularities);
            }
        });
        Ok(())
    }

    /// How much room the solutions of poses leave to limits and singularities: rows of 16 pose
    /// elements, and the angles, as [`Self::ik_with`] takes them. A row that is invalid has no
    /// solution.
    ///
    /// # Errors
    ///
    /// As [`Self::ik_with`].
    pub fn ik_margin<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        angles: &[f64],
        answers: Margins<'_>,
    ) -> Result<(), Error> {
        self.ik_margin_without(robot, poses, angles, answers, |_, _| ())
    }

    /// [`Self::ik_margin`] without the solutions of which `leave_out` takes [`Status::WITHIN_LIMITS`].
    #[doc(hidden)]
    pub fn ik_margin_without<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        poses: &[f64],
        angles: &[f64],
        answers: Margins<'_>,
        leave_out: impl Fn(&[[f64; N]], &mut [u8]) + Sync,
    ) -> Result<(), Error> {
        robot.check_structure()?;
        let poses = rows::<16>("poses", poses)?;
        let Margins { margin, singularities, solutions: count } = answers;
        let angles = &*robot.angles_of_rows(angles, poses.len())?;
        check_length("margin", margin.len(), poses.len())?;
        check_length("singularities", singularities.len(), poses.len())?;
        check_length("solutions", count.len(), poses.len())?;
        let asked = poses.chunks(PART).enumerate();
        let numbers = margin.chunks_mut(PART).zip(singularities.chunks_mut(PART));
        let parts = asked.zip(numbers.zip(count.chunks_mut(PART)));
        let slots = robot.slot_count();
        self.run(poses.len(), parts, |((part, poses), ((margin, room), count)), _| {
            let mut q = vec![f64::NAN; poses.len() * slots * N];
            let mut status = vec![0; poses.len() * slots];
            let locked = part_of(angles, PART * part);
            robot.ik_rows(Rows { poses, locked, q: &mut q, status: &mut status });
            leave_out(q.as_chunks().0, &mut status);
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
fn most_room<const N: usize>(robot: &Robot<N>, q: &[[f64; N]], status: &[u8]) -> (f64, f64, u8) {
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

#[cfg(test)]
mod tests {
    use core::num::NonZeroUsize;
    use std::string::ToString;
    use std::vec::Vec;

    use super::*;
    use crate::kinematics::pose_to_rows;
    use crate::rng::Rng;

    fn margins(robot: &Robot<6>, poses: &[f64], threads: usize) -> (Vec<f64>, Vec<f64>, Vec<u8>) {
        let count = poses.len() / 16;
        let (mut margin, mut singularities) = (vec![9.0; count], vec![9.0; count]);
        let mut solutions = vec![9; count];
        let answers = Margins {
            margin: &mut margin,
            singularities: &mut singularities,
            solutions: &mut solutions,
        };
        let mut batch = Batch::new(NonZeroUsize::new(threads));
        batch.ik_margin(robot, poses, &[], answers).unwrap();
        (margin, singularities, solutions)
    }

    #[test]
    fn the_best_of_each_pose_is_that_of_its_solutions_in_any_batch() {
        for name in ["IRB 2600-12/1.65", "IRB 2400-16/1.55", "UR5e"] {
            let robot: Robot<6> = Robot::named(name).unwrap();
            let mut rng = Rng::new(5);
            let mut poses: Vec<f64> = Vec::new();
            for _ in 0..700 {
                let mut pose = robot.fk(&rng.inside(robot.limits()));
                pose.translation.x += rng.between(-0.3, 0.3);
                poses.extend(pose_to_rows(&pose));
            }
            poses[16 * 70] = f64::NAN;
            let (margin, singularities, solutions) = margins(&robot, &poses, 1);
            assert_eq!(solutions[70], 0);
            let mut empty = 0;
            for (row, pose) in poses.chunks(16).enumerate() {
                // Alone, to the last bit.
                let alone = margins(&robot, pose, 1);
                assert_eq!(alone.0[0].to_bits(), margin[row].to_bits());
                assert_eq!(alone.1[0].to_bits(), singularities[row].to_bits());
                assert_eq!(alone.2[0], solutions[row]);
                let Ok(pose) = crate::pose::from_rows(pose.first_chunk().unwrap()) else {
                    continue;
                };
                let found = robot.ik(&pose).unwrap().within_limits();
                assert_eq!(usize::from(solutions[row]), found.len());
                let rooms: Vec<_> = found.turns().map(|turn| robot.margin(&turn.q)).collect();
                if rooms.is_empty() {
                    assert!(margin[row].is_nan() && singularities[row].is_nan());
                    empty += 1;
                    continue;
                }
                let most = rooms.iter().map(Margin::least).fold(-9.0, f64::max);
                assert!((margin[row] - most).abs() < 1e-9, "{name} {row}");
                let most = rooms.iter().map(|room| room.singularities).fold(-9.0, f64::max);
                assert!((singularities[row] - most).abs() < 1e-9, "{name} {row}");
            }
            assert!((1..600).contains(&empty), "{name}: {empty}");
            // Enough for two threads.
            let bits = |(margin, ..): (Vec<f64>, Vec<f64>, Vec<u8>)| {
                margin.into_iter().map(f64::to_bits).collect::<Vec<_>>()
            };
            let many = poses.repeat(16);
            assert_eq!(bits(margins(&robot, &many, 2)), bits((margin.repeat(16), vec![], vec![])));
        }
    }

    #[test]
    fn a_row_has_the_margin_that_it_has_alone() {
        let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
        let mut rng = Rng::new(7);
        let mut q: Vec<f64> = (0..10_000).flat_map(|_| rng.inside(robot.limits())).collect();
        q[6 * 70 + 3] = f64::INFINITY;
        for threads in [1, 2] {
            let (mut limits, mut singularities) = (vec![9.0; 10_000], vec![9.0; 10_000]);
            let mut batch = Batch::new(NonZeroUsize::new(threads));
            batch.margin(&robot, &q, &mut limits, &mut singularities).unwrap();
            assert!(limits[70].is_nan() && singularities[70].is_nan());
            for (row, q) in q.as_chunks().0.iter().enumerate().filter(|(row, _)| *row != 70) {
                let alone = robot.margin(q);
                assert_eq!(limits[row].to_bits(), alone.limits.to_bits());
                assert_eq!(singularities[row].to_bits(), alone.singularities.to_bits());
            }
        }
        let error = Batch::new(None).margin(&robot, &q, &mut [0.0; 3], &mut [0.0; 3]).unwrap_err();
        assert!(error.to_string().contains("limits"), "{error}");
    }

    #[test]
    fn an_output_of_another_length_is_named() {
        let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
        let (mut margin, mut singularities, mut solutions) = ([0.0; 2], [0.0; 1], [0; 2]);
        let answers = Margins {
            margin: &mut margin,
            singularities: &mut singularities,
            solutions: &mut solutions,
        };
        let error = Batch::new(None).ik_margin(&robot, &[0.0; 32], &[], answers).unwrap_err();
        assert!(error.to_string().contains("singularities"), "{error}");
    }
}
