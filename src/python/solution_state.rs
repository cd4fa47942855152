//! Solutions as numbers and words, for pickle: exactly what a solve answered, not the pose to be
//! solved again, which another instruction set would do with other rounding.

use pyo3::prelude::*;

use super::errors::Fault;
use super::found::Found;
use crate::kinematics::{Pose, Robot, Slot, Solution, Status, pose_from_rows, pose_to_rows};
use crate::report::{Explanation, FreeJoint, Reach};

/// The pose that was solved, 4x4 in row-major order.
pub(super) type PoseState = Vec<f64>;

/// (slot, flags, joint angles, the free joint). A merged slot has no angles.
pub(super) type SolutionState = (usize, u8, Vec<f64>, Option<String>);

/// (what, a count, a count or a joint, a length or an angle).
type OutcomeState = (String, usize, usize, f64);

/// (what the slots hold, reach, why the last selection left nothing, the list of turns, whether the
/// solutions are certain to be all, the angle of joint 7 that was passed).
pub(super) type FoundState = (
    Vec<SolutionState>,
    OutcomeState,
    Option<OutcomeState>,
    Option<Vec<SolutionState>>,
    bool,
    Option<f64>,
);

fn damaged(py: Python<'_>) -> PyErr {
    Fault::Model.error(py, "the pickled solution is damaged".to_owned())
}

pub(super) fn of_pose(pose: &Pose) -> PoseState {
    pose_to_rows(pose).to_vec()
}

/// The pose of a state.
pub(super) fn pose(py: Python<'_>, state: &[f64]) -> PyResult<Pose> {
    let rows = <&[f64; 16]>::try_from(state).map_err(|_| damaged(py))?;
    pose_from_rows(rows).map_err(|_| damaged(py))
}

pub(super) fn of_solution<const N: usize>(solution: &Solution<N>) -> SolutionState {
    let free = solution.free_joint.map(|free| format!("{free:?}"));
    (solution.slot.index(), solution.status.bits(), solution.q.to_vec(), free)
}

/// The solution of a state.
pub(super) fn solution<const N: usize>(
    py: Python<'_>,
    robot: &Robot<N>,
    state: &SolutionState,
) -> PyResult<Solution<N>> {
    let (slot, flags, q, free) = state;
    let read = || {
        let slot = (*slot < robot.slot_count()).then(|| Slot::new(*slot))?;
        let q = <[f64; N]>::try_from(&q[..]).ok()?;
        let free_joint = match free {
            Some(name) => Some(FreeJoint::all().find(|free| format!("{free:?}") == *name)?),
            None => None,
        };
        let status = Status::from_bits(*flags)?;
        let of_others = Status::MERGED | Status::INVALID | Status::UNCERTIFIED;
        let is_whole = status.contains(Status::FOUND) && !status.intersects(of_others);
        is_whole.then_some(Solution { q, slot, status, free_joint })
    };
    read().ok_or_else(|| damaged(py))
}

fn solutions<const N: usize>(
    py: Python<'_>,
    robot: &Robot<N>,
    states: &[SolutionState],
) -> PyResult<Vec<Solution<N>>> {
    states.iter().map(|state| solution(py, robot, state)).collect()
}

pub(super) fn of_found<const N: usize>(found: &Found<N>) -> FoundState {
    let solutions = &found.solutions;
    let status = solutions.status();
    let slots = status.iter().enumerate().filter_map(|(slot, flags)| match solutions.slot(slot) {
        Some(solution) => Some(of_solution(solution)),
        None if flags.contains(Status::MERGED) => {
            Some((slot, (*flags - Status::UNCERTIFIED).bits(), Vec::new(), None))
        }
        None => None,
    });
    (
        slots.collect(),
        of_outcome(Explanation::OutOfReach(solutions.reach())),
        solutions.emptied.map(of_outcome),
        found.turned.as_ref().map(|turned| turned.iter().map(of_solution).collect()),
        solutions.is_certified(),
        found.q7,
    )
}

/// The answer of a state: `found` is empty, of the same robot and pose.
pub(super) fn restored<const N: usize>(
    py: Python<'_>,
    mut found: Found<N>,
    (slots, reach, emptied, turned, certified, q7): &FoundState,
) -> PyResult<Found<N>> {
    let robot = &found.robot;
    for state in slots {
        match state {
            (slot, flags, q, None) if q.is_empty() && *slot < robot.slot_count() => {
                let flags = Status::from_bits(*flags).ok_or_else(|| damaged(py))?;
                found.solutions.put_merged(Slot::new(*slot), flags);
            }
            _ => found.solutions.put(solution(py, robot, state)?),
        }
    }
    found.solutions.reach = match outcome(py, reach)? {
        Explanation::OutOfReach(reach) => reach,
        _ => return Err(damaged(py)),
    };
    found.solutions.is_certified = *certified;
    found.solutions.emptied = emptied.as_ref().map(|emptied| outcome(py, emptied)).transpose()?;
    found.q7 = *q7;
    found.turned = turned.as_ref().map(|turned| solutions(py, robot, turned)).transpose()?;
    Ok(found)
}

fn of_outcome(outcome: Explanation) -> OutcomeState {
    let (what, count, other, figure) = match outcome {
        Explanation::Found { solutions, inside } => ("found", solutions, inside, 0.0),
        Explanation::OutsideLimits { solutions, joint, excess } => {
            ("outside limits", solutions, joint, excess)
        }
        Explanation::OutsideLinkage { solutions, excess } => {
            ("outside linkage", solutions, 0, excess)
        }
        Explanation::OutOfReach(Reach::Reached) => ("reached", 0, 0, 0.0),
        Explanation::OutOfReach(Reach::TooFar { shortfall }) => ("too far", 0, 0, shortfall),
        Explanation::OutOfReach(Reach::NoRoots) => ("no roots", 0, 0, 0.0),
        Explanation::NoRoots { certified, .. } => ("without roots", usize::from(certified), 0, 0.0),
        Explanation::OutOfReach(Reach::TooNear { shortfall }) => ("too near", 0, 0, shortfall),
        Explanation::FreeOutOfReach { joint, value } => ("free out of reach", 0, joint, value),
        Explanation::NoArmAngle { arm_angle } => ("no arm angle", 0, 0, arm_angle),
        Explanation::FilteredOut => ("filtered out", 0, 0, 0.0),
    };
    (what.to_owned(), count, other, figure)
}

fn outcome(py: Python<'_>, (what, count, other, figure): &OutcomeState) -> PyResult<Explanation> {
    let (solutions, other, figure) = (*count, *other, *figure);
    Ok(match what.as_str() {
        "found" => Explanation::Found { solutions, inside: other },
        "outside limits" => Explanation::OutsideLimits { solutions, joint: other, excess: figure },
        "outside linkage" => Explanation::OutsideLinkage { solutions, excess: figure },
        "reached" => Explanation::OutOfReach(Reach::Reached),
        "too far" => Explanation::OutOfReach(Reach::TooFar { shortfall: figure }),
        "no roots" => Explanation::OutOfReach(Reach::NoRoots),
        "without roots" => Explanation::NoRoots { certified: solutions == 1, approach: None },
        "too near" => Explanation::OutOfReach(Reach::TooNear { shortfall: figure }),
        "free out of reach" => Explanation::FreeOutOfReach { joint: other, value: figure },
        "no arm angle" => Explanation::NoArmAngle { arm_angle: figure },
        "filtered out" => Explanation::FilteredOut,
        _ => return Err(damaged(py)),
    })
}
