//! Values of pickles. Loading runs the checks of the constructors.

use std::sync::Arc;

use pyo3::prelude::*;

use super::arm::{Arm, ByJoints};
use super::found::Found;
use super::robot::PyRobot;
use super::solution::{Member, PySolution};
use super::solutions::PySolutions;
use super::state::{Answer, One, damaged, read};
use super::trajectory::PyTrajectory;
use crate::kinematics::{Robot, Solution, Status};
use crate::trajectory::Trajectory;

/// Restore a pickled value.
#[pyfunction(name = "_restore")]
pub(super) fn restore<'py>(
    py: Python<'py>,
    kind: &str,
    state: &[u8],
) -> PyResult<Bound<'py, PyAny>> {
    let (class, bytes) = (kind, state);
    Ok(match class {
        "Robot" => {
            let robot: ByJoints<Robot<6>, Robot<7>> = read(py, class, bytes)?;
            let arm: Arm = match robot {
                ByJoints::Six(robot) => robot.into(),
                ByJoints::Seven(robot) => robot.into(),
            };
            Bound::new(py, PyRobot::from(arm))?.into_any()
        }
        "Solutions" => {
            let found: PySolutions = match read(py, class, bytes)? {
                ByJoints::Six(answer) => found::<6>(py, answer)?.into(),
                ByJoints::Seven(answer) => found::<7>(py, answer)?.into(),
            };
            Bound::new(py, found)?.into_any()
        }
        "Solution" => {
            let member: PySolution = match read(py, class, bytes)? {
                ByJoints::Six(one) => member::<6>(py, one)?.into(),
                ByJoints::Seven(one) => member::<7>(py, one)?.into(),
            };
            Bound::new(py, member)?.into_any()
        }
        "Trajectory" => {
            let (motion, times): (Trajectory, Vec<f64>) = read(py, class, bytes)?;
            Bound::new(py, PyTrajectory::new(py, motion, times)?)?.into_any()
        }
        _ => return Err(damaged(py, class, "unknown class")),
    })
}

fn found<const N: usize>(py: Python<'_>, answer: Answer<N>) -> PyResult<Found<N>> {
    let Answer { robot, solutions, turned, q7 } = answer;
    let slots = robot.slot_count();
    let is_whole = solutions.slot_count() == slots
        && solutions.is_consistent()
        && solutions.iter().chain(turned.iter().flatten()).all(|one| fits(one, slots));
    if is_whole {
        Ok(Found { robot: Arc::new(robot), solutions, turned, q7 })
    } else {
        Err(damaged(py, "Solutions", "a slot or a joint does not exist"))
    }
}

fn member<const N: usize>(py: Python<'_>, one: One<N>) -> PyResult<Member<N>> {
    let One { robot, pose, solution } = one;
    if fits(&solution, robot.slot_count()) {
        Ok(Member { robot: Arc::new(robot), pose, solution })
    } else {
        Err(damaged(py, "Solution", "a slot or a joint does not exist"))
    }
}

/// Whether slot, flags and free joint of a solution exist.
fn fits<const N: usize>(solution: &Solution<N>, slots: usize) -> bool {
    let of_others = Status::MERGED | Status::INVALID | Status::UNCERTIFIED;
    solution.slot.index() < slots
        && solution.status.contains(Status::FOUND)
        && !solution.status.intersects(of_others)
        && solution.free_joint.is_none_or(|free| (1..=N).contains(&free.joint()))
}
