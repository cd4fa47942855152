//! `ik`: all solutions of a pose.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use irbkin::{Error, Explanation, Pose, Robot, Solutions};
use irbkin_motion::Arm;
use irbkin_motion::cell::Cell;
use serde::Serialize;

use super::posture::{Margin, arm_angle, collides, confdata, words};
use super::request::{Refusal, Request};

/// Steps on the way to a pose that is not reached, longer and shorter ones.
const STEPS: usize = 40;
/// Change of a joint on it that is a jump [rad].
const JUMP: f64 = 1.0;

/// All solutions of a pose.
#[derive(Debug, Serialize)]
pub struct PoseSolutions {
    /// The solutions, in the order of their slots.
    pub solutions: Vec<Solution>,
    /// Whether these are certain to be all.
    pub certified: bool,
    /// The outcome in a sentence: how many solutions there are, or why there are none inside the
    /// limits.
    pub outcome: String,
    /// The reason for no solution; null if one exists.
    pub reason: Option<String>,
    /// The solution inside the limits that is nearest to the seed, turns of 2 pi considered; null
    /// without a seed, and if there is none.
    pub nearest: Option<Nearest>,
    /// Without a solution inside the limits: joint angles from the seed towards the pose, as
    /// far as the arm gets on the straight way without a jump [rad].
    pub towards: Option<Vec<f64>>,
    /// Joint 7 of all solutions, of seven joints [rad].
    pub q7: Option<f64>,
}

/// The solution nearest to a seed.
#[derive(Debug, Serialize)]
pub struct Nearest {
    /// The index in `solutions` of the one in its slot; null if there is none.
    pub index: Option<usize>,
    /// Joint angles [rad], at the turns that are nearest to the seed.
    pub q: Vec<f64>,
}

/// A solution.
#[derive(Debug, Serialize)]
pub struct Solution {
    /// Joint angles [rad].
    pub q: Vec<f64>,
    /// The slot: always the same for a branch of the arm.
    pub slot: usize,
    /// The name of the slot, if slots have names.
    pub words: Option<&'static str>,
    /// Whether every joint is inside its limits.
    pub within_limits: bool,
    /// ABB's confdata.
    pub confdata: Option<[i32; 4]>,
    /// The arm angle [rad].
    pub arm_angle: Option<f64>,
    /// The singularities that it is at: "wrist", "elbow", "shoulder".
    pub singularities: Vec<&'static str>,
    /// The joint that the pose leaves free, in words.
    pub free_joint: Option<String>,
    /// Margin to limits and singularities.
    pub margin: Margin,
    /// Whether the arm collides, if that is asked.
    pub collides: Option<bool>,
}

impl PoseSolutions {
    pub(crate) fn read<const N: usize>(
        robot: &Arm<N>,
        cell: &Cell,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let pose = request.pose("T")?;
        let seed = request.has("seed").then(|| request.joints("seed")).transpose()?;
        let cell = request.flag("collide")?.then_some(cell);
        let q7 = request.has("q7").then(|| request.angle("q7")).transpose()?;
        let mut found = Self::without_way(robot, cell, &pose, seed, q7)?;
        if let (None, Some(seed)) = (&found.nearest, seed) {
            found.towards = Some(towards(robot, &pose, seed).to_vec());
        }
        Ok(found)
    }

    fn without_way<const N: usize>(
        robot: &Arm<N>,
        cell: Option<&Cell>,
        pose: &Pose,
        seed: Option<[f64; N]>,
        q7: Option<f64>,
    ) -> Result<Self, Refusal> {
        if N == 7 && q7.is_none() {
            let Some(seed) = seed else {
                return Err("q7 is missing, and so is seed: seven joints need one"
                    .to_owned()
                    .into());
            };
            return Self::along_redundancy(robot, cell, pose, &seed);
        }
        let solutions = robot.ik_with(pose, q7)?;
        let nearest = match seed {
            None => None,
            // Among these, as joint 7 is given.
            Some(seed) if N == 7 => inside(solutions.nearest(&seed, &[1.0; N]))?.ok(),
            Some(seed) => inside(robot.ik_nearest(pose, &seed, &[1.0; N]))?.ok(),
        };
        Self::of(robot, cell, &solutions, nearest.as_ref(), q7)
    }

    /// The solution of seven joints that is nearest to a seed, and the solutions at its joint 7.
    fn along_redundancy<const N: usize>(
        robot: &Arm<N>,
        cell: Option<&Cell>,
        pose: &Pose,
        seed: &[f64; N],
    ) -> Result<Self, Refusal> {
        match inside(robot.ik_nearest(pose, seed, &[1.0; N]))? {
            Ok(nearest) => {
                let q7 = nearest.q.last().copied();
                let solutions = robot.ik_with(pose, q7)?;
                Self::of(robot, cell, &solutions, Some(&nearest), q7)
            }
            Err(reason) => Ok(Self {
                solutions: Vec::new(),
                certified: false,
                outcome: reason.clone(),
                reason: Some(reason),
                nearest: None,
                towards: None,
                q7: None,
            }),
        }
    }

    fn of<const N: usize>(
        robot: &Arm<N>,
        cell: Option<&Cell>,
        solutions: &Solutions<N>,
        nearest: Option<&irbkin::Solution<N>>,
        q7: Option<f64>,
    ) -> Result<Self, Refusal> {
        let outcome = explained(robot, solutions).to_string();
        let nearest = nearest.map(|nearest| Nearest {
            index: solutions.iter().position(|solution| solution.slot == nearest.slot),
            q: nearest.q.to_vec(),
        });
        let each = solutions.iter().map(|solution| Solution::of(robot, cell, solution));
        Ok(Self {
            solutions: each.collect::<Result<_, _>>()?,
            certified: solutions.is_certified(),
            reason: solutions.is_empty().then(|| outcome.clone()),
            outcome,
            nearest,
            towards: None,
            q7,
        })
    }
}

/// How far the arm gets from a seed on the straight way to a pose, without a jump.
fn towards<const N: usize>(robot: &Robot<N>, pose: &Pose, seed: [f64; N]) -> [f64; N] {
    let from = robot.fk(&seed);
    let (mut q, mut reached, mut step) = (seed, 0.0, 0.5);
    for _ in 0..STEPS {
        let next = from.try_lerp_slerp(pose, reached + step, 1e-9);
        let found = next.and_then(|next| robot.ik_nearest(&next, &q, &[1.0; N]).ok());
        let near =
            |it: &irbkin::Solution<N>| it.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < JUMP);
        if let Some(solution) = found.filter(near) {
            (q, reached) = (solution.q, reached + step);
            step = f64::min(2.0 * step, 1.0 - reached);
        } else {
            step /= 2.0;
        }
    }
    q
}

/// The outcome; of an arm without a closed form, with how near it gets to a pose out of reach.
fn explained<const N: usize>(robot: &Robot<N>, solutions: &Solutions<N>) -> Explanation {
    match solutions.explain() {
        Explanation::NoRoots { certified, .. } if N == 6 => {
            let approach = robot.nearest_approach(solutions.pose()).ok();
            Explanation::NoRoots { certified, approach }
        }
        explanation => explanation,
    }
}

/// The solution inside the limits, or the reason why there is none.
fn inside<const N: usize>(
    nearest: Result<irbkin::Solution<N>, Error>,
) -> Result<Result<irbkin::Solution<N>, String>, Refusal> {
    match nearest {
        Ok(nearest) => Ok(Ok(nearest)),
        Err(Error::Unreachable(reason)) => Ok(Err(reason.to_string())),
        Err(error) => Err(error.into()),
    }
}

impl Solution {
    pub(crate) fn of<const N: usize>(
        robot: &Arm<N>,
        cell: Option<&Cell>,
        solution: &irbkin::Solution<N>,
    ) -> Result<Self, Refusal> {
        let slot = solution.slot.index();
        let free =
            |free: irbkin::FreeJoint| format!("J{} is free, {} fixed", free.joint(), free.fixed());
        Ok(Self {
            q: solution.q.to_vec(),
            slot,
            words: robot.slot_names().and_then(|names| names.get(slot).copied()),
            within_limits: solution.is_within_limits(),
            confdata: confdata(robot, &solution.q),
            arm_angle: arm_angle(robot, &solution.q),
            singularities: words(solution.singularities()),
            free_joint: solution.free_joint.map(free),
            margin: Margin::of(robot, &solution.q),
            collides: collides(robot, cell, &solution.q)?,
        })
    }
}
