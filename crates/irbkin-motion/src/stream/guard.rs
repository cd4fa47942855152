//! The guard: references in, set points out.

use super::ahead::Ahead;
use super::brake::{Bounds, Brake, End, braking};
use super::limit::{Goal, Limited};
use super::options::{GuardOptions, OnViolation, State, Step};
use super::reason::{NOT_FREE, Reason};
use super::tool::ToolSpeed;
use super::track::Track;
use crate::arm::Arm;
use crate::cell::{Boxes, Cell, Other};
use crate::error::Error;
use crate::go::{check_free, inside};
use crate::prelude::*;
use irbkin::Pose;
use irbkin::follow::Follower;
use irbkin::internal::{largest, largest_step, steps};

/// How far control points may be outside limits [rad]: half of what counts as inside, for the
/// rounding of the steps of a braking motion is less than the other half.
const LIMIT_SLACK: f64 = 5e-10;

/// Looks at eight parts of the motion ahead, after which it counts as not free: of a reference, and
/// of a shorter step in its place.
const LOOKS: [usize; 2] = [3, 1];

/// References that do not fit, though they stay near, that are refused in a row with
/// [`OnViolation::Brake`].
const REFUSED: usize = 2;

/// A guard in front of a control loop: in each cycle a reference, or none, and a set point.
///
/// Every set point is inside the limits and within the bounds, as is the motion to it: the cubic of
/// the joint angles and velocities at both ends. After each one a braking motion exists that is so
/// too; both are proven free in the cell.
#[derive(Clone)]
pub struct Guard<const N: usize> {
    arm: Arm<N>,
    cycle: f64,
    bounds: [Bounds; N],
    limits: [[f64; 2]; N],
    tool_speed: Option<ToolSpeed<N>>,
    /// `None` if nothing is proven.
    boxes: Option<Boxes<N>>,
    on_violation: OnViolation,
    /// The last three control points.
    points: [[f64; N]; 3],
    /// The references of each joint.
    tracks: [Track; N],
    /// References in a row that are near and do not fit.
    misfits: usize,
    /// For how long the guard goes on without a reference [s].
    hold: f64,
    /// Cycles in a row without one.
    missing: u32,
    state: State,
    /// Whether the last motion that was looked at is not free: the order of looks at the next one.
    was_blocked: bool,
}

impl<const N: usize> Guard<N> {
    /// A guard of an arm at rest at `start` [rad], in a cell; without one nothing is proven free.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] for a cycle or a limit that is not positive, or a cycle of more
    /// than 0.5 s; [`irbkin::Error::InvalidModel`] if neither the options nor the robot have limits of
    /// velocity; [`Error::NoMotion`] if the start is outside the limits or collides;
    /// [`irbkin::Error::InvalidJoints`] for a start that is not finite; [`Error::InvalidBody`] if the arm
    /// has no body, or a margin is negative.
    pub fn new(
        arm: &Arm<N>,
        start: &[f64; N],
        cell: Option<&Cell>,
        options: &GuardOptions<N>,
    ) -> Result<Self, Error> {
        let [velocity, acceleration, jerk] = options.checked(arm)?;
        let start = inside(arm, "start", start)?;
        let boxes = cell.map(|cell| Boxes::new(arm, cell, options.margin)).transpose()?;
        if let Some(boxes) = &boxes {
            check_free(&mut boxes.checker()?, "start", &start)?;
        }
        Ok(Self {
            arm: arm.clone(),
            cycle: options.cycle,
            bounds: core::array::from_fn(|joint| {
                Bounds::new(options.cycle, velocity[joint], acceleration[joint], jerk[joint])
            }),
            limits: arm.free_ranges(),
            tool_speed: options.max_tool_speed.map(|limit| ToolSpeed::new(arm, limit)),
            boxes,
            on_violation: options.on_violation,
            points: [start; 3],
            tracks: start.map(Track::new),
            misfits: 0,
            hold: options.hold,
            missing: 0,
            state: State::Holding,
            was_blocked: false,
        })
    }

    /// The arm.
    #[must_use]
    pub fn arm(&self) -> &Arm<N> {
        &self.arm
    }

    /// Time from one set point to the next [s].
    #[must_use]
    pub fn cycle(&self) -> f64 {
        self.cycle
    }

    /// For how long the guard goes on without a reference [s].
    #[must_use]
    pub fn hold(&self) -> f64 {
        self.hold
    }

    /// The state after the last step.
    #[must_use]
    pub fn state(&self) -> State {
        self.state
    }

    /// The last set point [rad].
    #[must_use]
    pub fn q(&self) -> [f64; N] {
        self.set_point()[0]
    }

    /// Whether set points are proven free.
    #[must_use]
    pub fn proves_free(&self) -> bool {
        self.boxes.is_some()
    }

    /// The next set point, for a reference of joint angles [rad].
    pub fn step(&mut self, reference: &[f64; N]) -> Step<N> {
        let checked = self.check_angles(reference);
        self.go(reference, checked)
    }

    /// The next set point, for the pose of the tool: joints on the branch of the last ones.
    pub fn step_pose(&mut self, pose: &Pose) -> Step<N> {
        match self.joints_at(pose) {
            Ok(reference) => self.step(&reference),
            Err(reason) => self.refuse(reason),
        }
    }

    /// The next set point, without a reference: the guard goes on towards the last one as long as
    /// it holds, else it brakes.
    pub fn step_none(&mut self) -> Step<N> {
        self.missing = self.missing.saturating_add(1);
        // The hold may be a whole number of cycles, but for rounding.
        let is_over = f64::from(self.missing) > self.hold / self.cycle + 1e-9;
        if is_over || self.state != State::Following {
            return self.refuse(Reason::Missing);
        }
        let last = core::array::from_fn(|joint| self.tracks[joint].point());
        let goals = self.goals(&last);
        let next = self.toward(&goals);
        match self.admit(&next, LOOKS[0]) {
            Ok(()) => self.advance(next, State::Following, Some(Reason::Missing)),
            Err(reason) => self.refuse(reason),
        }
    }

    /// The next set point, where the reference is no pose: the guard brakes.
    #[doc(hidden)]
    pub fn step_not_rigid(&mut self) -> Step<N> {
        self.refuse(Reason::NotRigid)
    }

    /// A reason in words, with the name of the obstacle.
    #[must_use]
    pub fn words(&self, reason: &Reason) -> String {
        if let Reason::Blocked { pair: Some((link, Other::Obstacle(place))) } = reason
            && let Some(boxes) = &self.boxes
            && let Some((name, _)) = boxes.cell().obstacles().get(*place)
        {
            return format!("{NOT_FREE}: link {link} and {name} come too near to each other");
        }
        reason.to_string()
    }

    fn check_angles(&self, reference: &[f64; N]) -> Result<(), Reason> {
        for (joint, value) in reference.iter().copied().enumerate() {
            let (limits, joint) = (self.limits[joint], joint + 1);
            if !value.is_finite() {
                return Err(Reason::NotFinite { joint, value });
            }
            if value < limits[0] - LIMIT_SLACK || value > limits[1] + LIMIT_SLACK {
                return Err(Reason::Outside { joint, value, limits });
            }
        }
        match self.arm.limits().linkage_excess(reference) {
            0.0 => Ok(()),
            excess => Err(Reason::Linkage { excess }),
        }
    }

    /// The joints that reach a pose, on the branch of the last control point.
    fn joints_at(&self, pose: &Pose) -> Result<[f64; N], Reason> {
        let (here, weights) = (&self.points[2], [1.0; N]);
        let reason = |error: irbkin::Error| match error {
            irbkin::Error::Unreachable(explanation) => Reason::Unreachable(explanation),
            irbkin::Error::InvalidPose(_) => Reason::NotRigid,
            _ => Reason::NoInverse,
        };
        let follower = Follower::new(&self.arm, here, &weights).map_err(reason)?;
        let Some(found) = follower.continued(pose).map_err(reason)? else {
            if self.arm.is_redundant() {
                return Err(Reason::NotContinued);
            }
            let solutions = self.arm.ik_with(pose, None).map_err(reason)?;
            return Err(Reason::Unreachable(solutions.explain()));
        };
        let slots = (self.arm.slot_of(here), self.arm.slot_of(&found.q));
        let (Some(from), Some(to)) = slots else { return Ok(found.q) };
        if from == to {
            return Ok(found.q);
        }
        let lost = Reason::Branch { from, to };
        if self.arm.is_redundant() {
            return Err(lost);
        }
        let solutions = self.arm.ik_with(pose, None).map_err(reason)?;
        let own = solutions.slot(from.index()).ok_or(lost)?;
        self.arm.limits().wrapped_near(&own.q, here).ok_or(lost)
    }

    fn end(&self, joint: usize) -> End {
        End::of(self.points.map(|point| point[joint]))
    }

    /// Go to a reference, or towards it; brake if neither can be.
    fn go(&mut self, reference: &[f64; N], checked: Result<(), Reason>) -> Step<N> {
        let refused = checked.and_then(|()| self.behind(reference).map(|_| ())).err();
        if let Some(reason @ Reason::NotFinite { .. }) = refused {
            return self.refuse(reason);
        }
        let goals = self.goals(reference);
        let is_borne = self.is_borne(reference, refused.as_ref());
        self.missing = 0;
        let next = match (self.on_violation, refused) {
            (OnViolation::Brake, None) if !is_borne => *reference,
            (OnViolation::Brake, Some(reason)) if !is_borne => return self.refuse(reason),
            _ => self.toward(&goals),
        };
        let (joint, step) = largest_step(&next, reference);
        let reason = (step != 0.0).then(|| refused.unwrap_or(Reason::Arriving { joint }));
        match self.admit(&next, LOOKS[0]) {
            Ok(()) => self.advance(next, State::Following, reason),
            Err(reason) => self.go_less(next, reason),
        }
    }

    /// Go less far than to a control point that cannot be, or brake.
    fn go_less(&mut self, next: [f64; N], reason: Reason) -> Step<N> {
        let is_linkage = matches!(reason, Reason::Linkage { .. });
        // At rest half of a step is next to nothing.
        let is_at_rest = self.state == State::Holding && !is_linkage;
        if self.on_violation == OnViolation::Brake || is_at_rest {
            return self.refuse(reason);
        }
        let brake = self.braking();
        let halfway = core::array::from_fn(|joint| 0.5 * (next[joint] + brake[joint]));
        let mut others = [halfway; 3];
        if is_linkage {
            // One of the two joints may leave the limit, or move along it.
            for (other, joint) in [(0, 1), (1, 2)] {
                others[other] = next;
                others[other][joint] = brake[joint];
            }
        }
        let count = if is_linkage { 3 } else { 1 };
        match others[..count].iter().find(|other| self.admit(other, LOOKS[1]).is_ok()) {
            Some(other) => self.advance(*other, State::Following, Some(reason)),
            None => self.refuse(reason),
        }
    }

    /// Brake.
    fn refuse(&mut self, reason: Reason) -> Step<N> {
        let next = self.braking();
        self.advance(next, State::Braking, Some(reason))
    }

    /// The next control point of the braking motion.
    fn braking(&self) -> [f64; N] {
        core::array::from_fn(|joint| {
            let end = self.end(joint);
            end.then(braking(end, &self.bounds[joint])).point
        })
    }

    /// Whether a reference that does not fit is so near that the guard goes towards it all the same:
    /// as far as the joints may have gone since the last one, and not the first of its kind.
    fn is_borne(&mut self, reference: &[f64; N], refused: Option<&Reason>) -> bool {
        let cycles = 1.0 + f64::from(self.missing);
        let is_near = (0..N).all(|joint| {
            let end = self.end(joint);
            let far = (reference[joint] - end.point - end.first).abs();
            far <= cycles * self.bounds[joint].first
        });
        match refused {
            None if self.tracks.iter().all(Track::fits) => self.misfits = 0,
            None => {}
            Some(Reason::Beyond { .. }) if is_near => self.misfits += 1,
            Some(_) => self.misfits = 0,
        }
        self.misfits > REFUSED
    }

    /// Where the joints are to go for a reference, or for the last one again.
    fn goals(&mut self, reference: &[f64; N]) -> [Goal; N] {
        core::array::from_fn(|joint| {
            let (bounds, [lower, upper]) = (&self.bounds[joint], self.limits[joint]);
            let end = self.end(joint);
            let track = &mut self.tracks[joint];
            let is_followed = end.point - track.point() == 0.0;
            track.take(reference[joint].max(lower).min(upper), bounds);
            track.goal(bounds, is_followed)
        })
    }

    /// The next control point towards a reference (eq. 11, 12).
    fn toward(&self, goals: &[Goal; N]) -> [f64; N] {
        core::array::from_fn(|joint| {
            let (bounds, end) = (&self.bounds[joint], self.end(joint));
            let limits = self.tracks[joint].limits(self.limits[joint]);
            Limited { bounds, end, limits }.toward(&goals[joint])
        })
    }

    /// The end of the control points with one more, or the bound that it exceeds.
    fn behind(&self, next: &[f64; N]) -> Result<[End; N], Reason> {
        let mut behind = [End::default(); N];
        for (joint, behind) in behind.iter_mut().enumerate() {
            let checked = self.bounds[joint].check(self.end(joint), next[joint], self.cycle);
            *behind = checked.map_err(|(bound, value, limit)| Reason::Beyond {
                joint: joint + 1,
                bound,
                value,
                limit,
            })?;
        }
        Ok(behind)
    }

    /// Whether a control point may follow: within the bounds, and with a braking motion behind it
    /// that is inside the limits and, as the way to it, free.
    fn admit(&mut self, next: &[f64; N], looks: usize) -> Result<(), Reason> {
        let behind = self.behind(next)?;
        let brakes: [Brake; N] =
            core::array::from_fn(|joint| Brake::new(behind[joint], &self.bounds[joint]));
        for (joint, brake) in brakes.iter().enumerate() {
            let ([low, high], limits) = (brake.extent(), self.limits[joint]);
            if low < limits[0] - LIMIT_SLACK || high > limits[1] + LIMIT_SLACK {
                let value = if low < limits[0] - LIMIT_SLACK { low } else { high };
                return Err(Reason::NoWayToBrake { joint: joint + 1, value, limits });
            }
        }
        let [first, second, third] = self.points;
        let ahead = Ahead { points: [first, second, third, *next], brakes };
        if let Some(excess) = ahead.linkage_excess(self.arm.limits()) {
            return Err(Reason::Linkage { excess });
        }
        if let Some(speed) = &self.tool_speed {
            let checked = speed.check(&self.arm, &ahead, &self.bounds, self.cycle);
            checked.map_err(|(value, limit)| Reason::ToolSpeed { value, limit })?;
        }
        let Some(boxes) = &mut self.boxes else { return Ok(()) };
        let stop_first = self.was_blocked;
        let proven = ahead
            .prove(boxes, looks, stop_first)
            .map_err(|(q, spans)| Reason::Blocked { pair: boxes.blocked(&q, &spans) });
        self.was_blocked = proven.is_err();
        proven
    }

    /// Take a control point, and answer with the set point.
    fn advance(&mut self, next: [f64; N], state: State, reason: Option<Reason>) -> Step<N> {
        let [_, second, third] = self.points;
        self.points = [second, third, next];
        let is_at_rest = largest(&steps(&second, &third)) + largest(&steps(&third, &next)) == 0.0;
        self.state = if state == State::Braking && is_at_rest { State::Holding } else { state };
        let [q, dq, ddq] = self.set_point();
        Step { q, dq, ddq, accepted: reason.is_none(), state: self.state, reason }
    }

    /// Joint angles, velocities and accelerations by the last control points (eq. 1).
    fn set_point(&self) -> [[f64; N]; 3] {
        let (cycle, [a, b, c]) = (self.cycle, &self.points);
        [
            core::array::from_fn(|i| b[i] + ((c[i] - b[i]) - (b[i] - a[i])) / 6.0),
            core::array::from_fn(|i| (c[i] - a[i]) / (2.0 * cycle)),
            core::array::from_fn(|i| ((c[i] - b[i]) - (b[i] - a[i])) / (cycle * cycle)),
        ]
    }
}
