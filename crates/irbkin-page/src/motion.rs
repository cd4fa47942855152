//! `motion`: a routine as one motion.

use alloc::string::String;
use alloc::vec::Vec;

use irbkin::{Pose, Robot};
use irbkin_abb::rapid;
use irbkin_abb::rapid::MotionOptions;
use serde::Serialize;

use super::program::Program;
use super::request::{Refusal, Request};

/// Most samples of an answer: a page plays some minutes smoothly with them.
const MOST_SAMPLES: usize = 4000;

/// The moves of a routine as one motion.
#[derive(Debug, Serialize)]
pub struct Motion {
    /// The routine; null for moves outside routines.
    pub routine: Option<String>,
    /// Duration [s]: a kinematic lower bound.
    pub duration: f64,
    /// Number of samples of the motion.
    pub samples: usize,
    /// Whether the answer has some of them only, evenly chosen, the first and the last included.
    pub thinned: bool,
    /// Times of the samples [s].
    pub t: Vec<f64>,
    /// Joint angles of the samples [rad], one sample after the other.
    pub q: Vec<f64>,
    /// Positions of the samples [m], one after the other: of the tool or, if that is stationary, of
    /// the work object that the robot carries.
    pub way: Vec<f64>,
    /// The move, by its index in `moves`, that each sample belongs to.
    pub move_index: Vec<usize>,
    /// The moves, in order.
    pub moves: Vec<Move>,
}

/// A move of a motion.
#[derive(Debug, Serialize)]
pub struct Move {
    /// The module, from 0.
    pub module: usize,
    /// "MoveJ", "MoveL", "MoveC", "MoveAbsJ" or "MoveExtJ".
    pub kind: &'static str,
    /// Line, from 1.
    pub line: usize,
    /// When it begins [s].
    pub start: f64,
    /// When it ends [s].
    pub end: f64,
    /// The joints at its target [rad]; null if it is left out.
    pub q: Option<Vec<f64>>,
    /// Whether it is made as it is programmed.
    pub as_programmed: bool,
}

impl Motion {
    pub(crate) fn of<const N: usize>(
        robot: &Robot<N>,
        program: &Program,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let routine = request.optional_text("routine")?;
        let first = request.index("module", program.modules.len())?;
        // The routine is one of the first module.
        let order: Vec<_> =
            (first..=first).chain((0..program.modules.len()).filter(|it| *it != first)).collect();
        let modules: Vec<_> = order.iter().filter_map(|it| program.modules.get(*it)).collect();
        let motion = rapid::motion(robot, &modules, routine, &MotionOptions::default())?;
        let flange = robot.clone().with_tool(&Pose::identity())?;
        let samples = motion.t.len();
        let chosen = chosen(samples);
        let each = || chosen.iter().copied();
        let place = |index: usize| -> Option<[f64; 3]> {
            let step = motion.moves.get(*motion.move_index.get(index)?)?;
            let pose = flange.fk(motion.q.get(index)?) * step.tool;
            Some(pose.translation.vector.into())
        };
        Ok(Self {
            routine: motion.routine.clone(),
            duration: motion.t.last().copied().unwrap_or_default(),
            samples,
            thinned: chosen.len() < samples,
            t: each().filter_map(|index| motion.t.get(index).copied()).collect(),
            q: each().filter_map(|index| motion.q.get(index)).flatten().copied().collect(),
            way: each().filter_map(place).flatten().collect(),
            move_index: each().filter_map(|index| motion.move_index.get(index).copied()).collect(),
            moves: motion.moves.iter().filter_map(|it| Move::of(it, &order)).collect(),
        })
    }
}

impl Move {
    /// A move of modules that were given in another order.
    fn of<const N: usize>(step: &rapid::MotionMove<N>, order: &[usize]) -> Option<Self> {
        Some(Self {
            module: *order.get(step.module)?,
            kind: step.kind.name(),
            line: step.line,
            start: step.start,
            end: step.end,
            q: step.q.map(|q| q.to_vec()),
            as_programmed: step.as_programmed,
        })
    }
}

/// The samples that are returned of so many: evenly chosen, the first and the last included.
fn chosen(samples: usize) -> Vec<usize> {
    if samples <= MOST_SAMPLES {
        return (0..samples).collect();
    }
    let (last, intervals) = (samples - 1, MOST_SAMPLES - 1);
    // The product of two numbers of samples does not fit in the 32 bits of WebAssembly.
    let (whole, rest) = (last / intervals, last % intervals);
    let at = |index: usize| whole * index + rest * index / intervals;
    (0..MOST_SAMPLES).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_samples_include_both_ends_and_are_even() {
        assert_eq!(chosen(3), [0, 1, 2]);
        for samples in [MOST_SAMPLES + 1, 123_457, 10_000_000] {
            let chosen = chosen(samples);
            assert_eq!((chosen.len(), chosen[0]), (MOST_SAMPLES, 0));
            assert_eq!(chosen[MOST_SAMPLES - 1], samples - 1);
            let steps: Vec<_> = chosen.windows(2).map(|pair| pair[1] - pair[0]).collect();
            assert!(steps.iter().max().unwrap() - steps.iter().min().unwrap() <= 1);
        }
    }
}
