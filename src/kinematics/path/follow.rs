//! One continuous joint path along a path of poses.

use alloc::vec::Vec;
use core::f64::consts::TAU;
use core::fmt;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{IsometryMatrix3, Rotation3, Translation3};

use crate::error::Error;
use crate::kinematics::answer::check::{check_seed_near, check_weights};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::angles::rotation_vector;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::{
    EXAMINED_STEP, JUMP_BLIND, JUMP_GROWTH, JUMP_LEAST, PATH_WRIST_SIN, SEEDED_FREE, STEADY_STEP,
};
use crate::report::{Explanation, FreeJoint};

/// Number of times that a segment of the path is bisected in search of a continuous way through it:
/// down to a millionth of it.
const HALVINGS: u32 = 20;

/// A pose of the path where the joints cannot follow without a jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    /// Index of the pose that is not reached, or that the joints reach by a jump.
    pub pose_index: usize,
    /// The cause.
    pub reason: BreakReason,
}

/// The reason why the joints cannot follow the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BreakReason {
    /// No solution inside the limits.
    Unreachable(Explanation),
    /// A joint must turn while the tool does not move.
    Jump {
        /// The joint, from 1.
        joint: usize,
        /// The angle by which it turns [rad].
        by: f64,
        /// The singularities where it turns; empty if a joint limit is the cause.
        kinds: SingularityKind,
    },
    /// No joint vector inside the limits brings the tool center point there with the wrist, or axis
    /// 4, locked as the singularity mode requires.
    Locked,
    /// The singularity mode stops at a wrist singularity.
    Stopped {
        /// Joint 5 [rad].
        q5: f64,
    },
}

impl fmt::Display for Break {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "pose {}: {}", self.pose_index, self.reason)
    }
}

impl fmt::Display for BreakReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            BreakReason::Unreachable(explanation) => explanation.fmt(f),
            BreakReason::Jump { joint, by, kinds } => {
                write!(f, "J{joint} must turn by {:.1} deg on the spot, ", by.to_degrees())?;
                match kinds.word() {
                    Some(kind) => write!(f, "at the {kind} singularity"),
                    None => write!(f, "the branch ends at a joint limit or at the edge of reach"),
                }
            }
            BreakReason::Locked => {
                write!(f, "out of reach or outside the limits with the wrist locked")
            }
            BreakReason::Stopped { q5 } => {
                write!(f, "stopped at the wrist singularity, J5 is {:.4} deg", q5.to_degrees())
            }
        }
    }
}

/// Follows a path pose by pose, each time with the solution that continues the previous one. Does
/// not allocate.
#[derive(Clone, Debug)]
pub struct Follower<'a, const N: usize = 6> {
    robot: &'a Robot<N>,
    weights: [f64; N],
    at: Progress<N>,
}

/// How far a path was followed.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Progress<const N: usize> {
    /// The pose of the previous step.
    last: Option<Pose>,
    pub q: [f64; N],
    /// The previous step of the joints: where the path is heading.
    velocity: [f64; N],
}

impl<'a, const N: usize> Follower<'a, N> {
    /// A follower that starts at `seed` [rad].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] when the seed or a weight is not finite or a weight is negative.
    pub fn new(robot: &'a Robot<N>, seed: &[f64; N], weights: &[f64; N]) -> Result<Self, Error> {
        check_seed_near(seed, robot.limits(), weights)?;
        check_weights(weights)?;
        let mut q = *seed;
        if let Some((joint, angle)) = robot.locked_joint() {
            q[joint - 1] = angle;
        }
        let at = Progress { last: None, q, velocity: [0.0; N] };
        Ok(Self { robot, weights: *weights, at })
    }

    /// A follower of the robot that goes on from where another one was.
    #[doc(hidden)]
    pub fn resumed(robot: &'a Robot<N>, weights: &[f64; N], at: Progress<N>) -> Self {
        Self { robot, weights: *weights, at }
    }

    /// How far the path was followed.
    #[doc(hidden)]
    pub fn progress(&self) -> Progress<N> {
        self.at
    }

    /// Continue from `q` [rad] at `pose`.
    pub(crate) fn continue_from(&mut self, pose: &Pose, q: [f64; N]) {
        self.at = Progress { last: Some(*pose), q, velocity: [0.0; N] };
    }

    /// The joint vector of the next pose of the path [rad], with the reason if it is reached by a
    /// jump; if there is no solution, no joint vector and the reason.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`].
    pub fn step(
        &mut self,
        pose: &Pose,
    ) -> Result<(Option<Solution<N>>, Option<BreakReason>), Error> {
        let pose = checked_pose(pose)?;
        let mut next = match self.nearest(&pose)? {
            Ok(next) => next,
            Err(explanation) => {
                (self.at.last, self.at.velocity) = (None, [0.0; N]);
                return Ok((None, Some(BreakReason::Unreachable(explanation))));
            }
        };
        let mut jump = None;
        if let Some(last_pose) = self.at.last {
            let usual = largest(&self.at.velocity).max(JUMP_LEAST / JUMP_GROWTH);
            let step = largest(&steps(&self.at.q, &next.q));
            if step > (JUMP_GROWTH * usual).min(JUMP_BLIND) {
                (next, jump) = self.examined(&last_pose, &pose, next)?;
            }
        }
        self.at.velocity = if self.at.last.is_none() || jump.is_some() {
            [0.0; N]
        } else {
            steps(&self.at.q, &next.q)
        };
        self.at.q = next.q;
        self.at.last = Some(pose);
        Ok((Some(next), jump))
    }

    /// The solution nearest to where the joints are heading.
    fn nearest(&self, pose: &Pose) -> Result<Result<Solution<N>, Explanation>, Error> {
        let start = self.at.last.is_none().then(|| self.robot.at_limits(pose, &self.at.q));
        if let Some(start) = start.flatten() {
            return Ok(Ok(start));
        }
        // A joint that swings while it passes a singularity does not continue to swing, nor do seven
        // joints drift along their self-motion.
        let steady = self.robot.redundancy().is_none() && largest(&self.at.velocity) <= STEADY_STEP;
        let heading = if steady {
            core::array::from_fn(|i| self.at.q[i] + self.at.velocity[i])
        } else {
            self.at.q
        };
        if let Some(mut next) = self.robot.continued(pose, &heading, &self.weights)? {
            self.balance(&mut next, &heading, pose);
            return Ok(Ok(next));
        }
        // Another solution than the continuing ones may be inside the limits: at a singular pose,
        // or of seven joints.
        match self.robot.nearest_checked(*pose, &heading, &self.weights) {
            Ok(next) => Ok(Ok(next)),
            Err(Error::Unreachable(explanation)) => Ok(Err(explanation)),
            Err(error) => Err(error),
        }
    }

    /// The solution that continues at a pose from where the joints are; none elsewhere is sought.
    #[doc(hidden)]
    pub fn continued(&self, pose: &Pose) -> Result<Option<Solution<N>>, Error> {
        let pose = checked_pose(pose)?;
        let mut next = self.robot.continued(&pose, &self.at.q, &self.weights)?;
        if let Some(next) = &mut next {
            self.balance(next, &self.at.q, &pose);
        }
        Ok(next)
    }

    /// Near wrist singularities the residual was put on joint 6 alone; split it with joint 4 as far
    /// as the pose permits.
    fn balance(&self, next: &mut Solution<N>, heading: &[f64; N], pose: &Pose) {
        let is_near = |sin_5: f64| sin_5.abs() <= PATH_WRIST_SIN;
        let is_near = self.robot.sin_5(&next.q).is_some_and(is_near);
        let Some(wrist) = self.robot.singular_wrist().filter(|_| is_near) else { return };
        let sign = match next.free_joint.unwrap_or_else(|| wrist.wrist_pair(&next.q)) {
            FreeJoint::WristSum => 1.0,
            FreeJoint::WristDifference => -1.0,
            _ => return,
        };
        let over = next.q[5] - heading[5];
        let over = over - TAU * (over / TAU).round();
        let mut balanced = next.q;
        balanced[3] += sign * over / 2.0;
        balanced[5] -= over / 2.0;
        if self.robot.limits().contains(&balanced)
            && self.robot.residual(&balanced, pose).largest() <= SEEDED_FREE
        {
            next.q = balanced;
        }
    }

    /// Bisect the way from the last pose to the next one: a step that is only large shrinks with
    /// the segment, a jump does not. Return where the way ends: at the joints that were found at
    /// once, or at those of the branch that it follows; with the reason if there is none.
    fn examined(
        &self,
        from: &Pose,
        to: &Pose,
        direct: Solution<N>,
    ) -> Result<(Solution<N>, Option<BreakReason>), Error> {
        let mut scout = self.clone();
        scout.at.velocity = [0.0; N];
        let whole = largest(&steps(&self.at.q, &direct.q));
        let bound = (whole / 4.0).min(EXAMINED_STEP);
        let (mut done, mut width, mut depth) = (0.0, 1.0, 0);
        loop {
            let end = if done + width >= 1.0 { 1.0 } else { done + width };
            let pose = if end < 1.0 { between(from, to, end) } else { *to };
            let Ok(next) = scout.nearest(&pose)? else {
                // The straight line between two poses may leave the workspace where the path does
                // not: only the size of the step can decide.
                let is_jump = whole > JUMP_BLIND;
                let jump = is_jump.then(|| self.jump(&direct, from, &scout.at.q)).transpose()?;
                return Ok((direct, jump));
            };
            if largest(&steps(&scout.at.q, &next.q)) > bound {
                if depth == HALVINGS {
                    let jump = self.jump(&direct, &pose, &scout.at.q)?;
                    return Ok((direct, Some(jump)));
                }
                (width, depth) = (width / 2.0, depth + 1);
                continue;
            }
            if end >= 1.0 {
                // Joints that the pose leaves free, and those of a redundant arm, may end anywhere
                // near.
                let apart = largest(&steps(&next.q, &direct.q));
                return Ok((if apart <= bound { direct } else { next }, None));
            }
            (scout.at.q, done) = (next.q, end);
            if depth > 0 {
                (width, depth) = (width * 2.0, depth - 1);
            }
        }
    }

    /// The jump from the current joints to `to`, at the pose where it is unavoidable.
    fn jump(&self, to: &Solution<N>, pose: &Pose, at: &[f64; N]) -> Result<BreakReason, Error> {
        let (joint, by) = largest_step(&self.at.q, &to.q);
        let solutions = self.robot.solve(*pose, &FreeChoice::seed(*at))?;
        let kinds = solutions.iter().fold(self.robot.singularity(at).kinds, |kinds, solution| {
            kinds | solution.singularities()
        });
        Ok(BreakReason::Jump { joint, by, kinds })
    }
}

/// A joint path along a path of poses.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed<const N: usize = 6> {
    /// Joint angles for each pose [rad]; `None` if the pose is not reached.
    pub q: Vec<Option<[f64; N]>>,
    /// Angle between the tool's orientation and the orientation of each pose [rad].
    pub orientation_error: Vec<Option<f64>>,
    /// Where the joints cannot follow, with the reason.
    pub breaks: Vec<Break>,
}

/// The pose at a fraction of the way from one pose to another: straight, at a constant rate of
/// rotation.
pub(super) fn between(from: &Pose, to: &Pose, part: f64) -> Pose {
    let turn = rotation_vector(&(from.rotation.inverse() * to.rotation)) * part;
    let position = from.translation.vector.lerp(&to.translation.vector, part);
    IsometryMatrix3::from_parts(Translation3::from(position), from.rotation * Rotation3::new(turn))
}

/// The steps from one joint vector to another [rad].
pub fn steps<const N: usize>(from: &[f64; N], to: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|joint| to[joint] - from[joint])
}

/// The largest size of steps [rad].
pub fn largest<const N: usize>(steps: &[f64; N]) -> f64 {
    steps.iter().fold(0.0, |most, step| most.max(step.abs()))
}

/// The joint (from 1) that moves most from one joint vector to another, and its step [rad].
#[doc(hidden)]
pub fn largest_step<const N: usize>(from: &[f64; N], to: &[f64; N]) -> (usize, f64) {
    let steps = steps(from, to);
    let joint = (0..N).fold(0, |most, i| if steps[i].abs() > steps[most].abs() { i } else { most });
    (joint + 1, steps[joint])
}
