//! Joints of a plan: their limits, their turns, the cost of a step, the cost of joint angles.

use core::f64::consts::TAU;

use crate::error::Error;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::MOST_TURN_STATES;
use crate::prelude::*;
use irbkin::Robot;
use irbkin::internal::lanes::{nearest_whole, whole_below};
use irbkin::internal::nearest_turn;
use irbkin::internal::thresholds::LIMIT_TOLERANCE;

/// Turns of a joint without limits, where the search has to count them: two to each side.
const FREE_TURNS: usize = 5;

/// How far from a limit an angle is at it, or limits from a full turn are one [rad].
const EITHER_END: f64 = 4.0 * LIMIT_TOLERANCE;

/// Turns of a joint that has a limit on one side only.
const HALF_FREE_TURNS: f64 = 64.0;

/// Turns of a joint from which its limits are wide: which turn it has costs nothing.
const WIDE_TURNS: usize = 65;

/// The joints of an arm in a plan (docs/theory/plan.md, eq. 2, 3).
#[derive(Clone, Debug)]
pub(super) struct PlannedJoints {
    /// The least and the greatest angle that count as inside [rad].
    low: [f64; 6],
    high: [f64; 6],
    /// Whether the limits are less than a turn apart: no direction has more than one angle inside.
    pub(super) are_narrow: [bool; 6],
    /// How many turns an angle may have inside the limits.
    counts: [usize; 6],
    /// The turn around which the turns of a joint without limits are counted.
    middle: [i32; 6],
    /// Whether the step of a joint is taken modulo a turn: if it may have more than one.
    pub(super) wraps: [bool; 6],
    /// Velocity limits [rad/s]; ones where none is known.
    pub(super) velocity: [f64; 6],
    pub(super) weights: [f64; 6],
}

impl PlannedJoints {
    pub(super) fn of(robot: &Robot<6>, weights: [f64; 6]) -> Self {
        let limits = robot.limits().to_array();
        let wide = TAU * HALF_FREE_TURNS;
        // A missing limit is that many turns from the other one, if that is there.
        let beside = |own: f64, other: f64, way: f64| {
            if own.is_infinite() && other.is_finite() { other + way } else { own }
        };
        let low = limits.map(|[lower, upper]| beside(lower, upper, -wide) - LIMIT_TOLERANCE);
        let high = limits.map(|[lower, upper]| beside(upper, lower, wide) + LIMIT_TOLERANCE);
        let counts = core::array::from_fn(|joint| {
            let span = high[joint] - low[joint];
            match span {
                span if !span.is_finite() => FREE_TURNS,
                // A full turn has two angles at its ends only: `beside` chooses.
                span if span <= TAU + EITHER_END => 1,
                span => 1 + count(whole_below(span / TAU)),
            }
        });
        let are_narrow = core::array::from_fn(|joint| high[joint] - low[joint] < TAU);
        let velocity = robot.max_velocity().copied().unwrap_or([1.0; 6]);
        let (wraps, middle) = (counts.map(|count| count > 1), [0; 6]);
        Self { low, high, are_narrow, counts, middle, wraps, velocity, weights }
    }

    /// Count the turns of joints without limits around the turns of `q`, and those of joints with
    /// more turns than a search can count.
    pub(super) fn around(mut self, q: &[f64; 6]) -> Self {
        let half = TAU * HALF_FREE_TURNS;
        for joint in 0..6 {
            if self.counts[joint] <= MOST_TURN_STATES {
                continue;
            }
            self.low[joint] = self.low[joint].max(q[joint] - half);
            self.high[joint] = self.high[joint].min(q[joint] + half);
            self.counts[joint] = 1 + count(whole_below((self.high[joint] - self.low[joint]) / TAU));
        }
        self.middle = core::array::from_fn(|joint| {
            #[expect(clippy::cast_possible_truncation, reason = "angles are small")]
            let turn = nearest_whole(q[joint] / TAU) as i32;
            turn
        });
        self
    }

    pub(super) fn is_unlimited(&self, joint: usize) -> bool {
        !(self.high[joint] - self.low[joint]).is_finite()
    }

    /// Whether limits, as those of an axis 6 that may turn hundreds of times, are so far apart that
    /// the costs of its turns are one.
    pub(super) fn is_wide(&self, joint: usize) -> bool {
        self.counts[joint] >= WIDE_TURNS
    }

    /// The 2 pi equivalent of an angle with which its turns are counted from 0: the first one
    /// inside the limits.
    pub(super) fn first_turn(&self, joint: usize, angle: f64) -> f64 {
        if self.is_unlimited(joint) {
            return nearest_turn(angle, 0.0);
        }
        if !self.wraps[joint] {
            return angle;
        }
        let turns = whole_below((angle - self.low[joint]) / TAU);
        if turns == 0.0 { angle } else { angle - TAU * turns }
    }

    /// Whether an angle is at an end of limits that are a full turn apart: it may as well be at the
    /// other.
    pub(super) fn is_either_end(&self, joint: usize, angle: f64) -> bool {
        let (low, high) = (self.low[joint], self.high[joint]);
        !self.wraps[joint]
            && high - low >= TAU
            && (angle - low < EITHER_END || high - angle < EITHER_END)
    }

    /// Joint angles; one that may be at either end of its limits is at the end nearer to a
    /// neighbor.
    pub(super) fn beside(&self, q: &[f64; 6], neighbor: &[f64; 6]) -> [f64; 6] {
        core::array::from_fn(|joint| {
            let step = q[joint] - neighbor[joint];
            if self.is_either_end(joint, q[joint]) {
                q[joint] - TAU * nearest_whole(step / TAU)
            } else {
                q[joint]
            }
        })
    }

    /// The last turn that an angle may have, counted from [`Self::first_turn`].
    pub(super) fn last_turn(&self, joint: usize, first: f64) -> i32 {
        if self.is_unlimited(joint) {
            return whole(FREE_TURNS) - 1;
        }
        #[expect(clippy::cast_possible_truncation, reason = "limits are a few turns wide")]
        let last = whole_below((self.high[joint] - first) / TAU) as i32;
        last
    }

    pub(super) fn angle(&self, joint: usize, first: f64, turn: i32) -> f64 {
        let turn = turn + self.offset(joint);
        if turn == 0 { first } else { first + TAU * f64::from(turn) }
    }

    /// The turn of an angle, counted from [`Self::first_turn`].
    pub(super) fn turn_of(&self, joint: usize, first: f64, angle: f64) -> i32 {
        #[expect(clippy::cast_possible_truncation, reason = "angles are small")]
        let turn = nearest_whole((angle - first) / TAU) as i32;
        turn - self.offset(joint)
    }

    /// The full turns that an angle takes at turn 0.
    pub(super) fn offset(&self, joint: usize) -> i32 {
        if self.is_unlimited(joint) { self.middle[joint] - whole(FREE_TURNS / 2) } else { 0 }
    }

    /// Joint angles at the turns nearest to the middle of their limits: with room to both sides.
    pub(super) fn amid(&self, q: &[f64; 6]) -> [f64; 6] {
        core::array::from_fn(|joint| {
            if !self.wraps[joint] || self.is_unlimited(joint) {
                return q[joint];
            }
            nearest_turn(q[joint], 0.5 * (self.low[joint] + self.high[joint]))
        })
    }

    pub(super) fn contain(&self, q: &[f64; 6]) -> bool {
        (0..6).all(|joint| q[joint] >= self.low[joint] && q[joint] <= self.high[joint])
    }

    /// The limits of a joint [rad].
    pub(super) fn limits(&self, joint: usize) -> [f64; 2] {
        [self.low[joint] + LIMIT_TOLERANCE, self.high[joint] - LIMIT_TOLERANCE]
    }

    /// The step of a joint from one angle to another, modulo a turn where that is free (eq. 3),
    /// and the turns that were taken off.
    pub(super) fn step(&self, joint: usize, from: f64, to: f64) -> (f64, i32) {
        let step = to - from;
        if !self.wraps[joint] {
            return (step, 0);
        }
        let turns = nearest_whole(step * (1.0 / TAU));
        #[expect(clippy::cast_possible_truncation, reason = "a few turns")]
        let carried = turns as i32;
        (step - TAU * turns, carried)
    }

    /// Joint angles inside the limits, and where steps lead from there, inside too.
    pub(super) fn inside(&self, q: &[f64; 6], steps: &[f64; 6]) -> Option<[[f64; 6]; 2]> {
        let (mut from, mut to) = (*q, *q);
        for joint in 0..6 {
            let turns = 0..=self.last_turn(joint, q[joint]);
            let mut angles = turns.map(|turn| self.angle(joint, q[joint], turn));
            from[joint] = angles.find(|angle| {
                let next = angle + steps[joint];
                next >= self.low[joint] && next <= self.high[joint]
            })?;
            to[joint] = from[joint] + steps[joint];
        }
        Some([from, to])
    }

    pub(super) fn steps(&self, from: &[f64; 6], to: &[f64; 6]) -> [f64; 6] {
        core::array::from_fn(|joint| self.step(joint, from[joint], to[joint]).0)
    }
}

/// The cost of being near limits and near singularities [rad^2/s^2] (docs/theory/plan.md, eq. 4).
#[derive(Clone, Copy)]
pub(super) struct NodeCost<'a> {
    robot: &'a Robot<6>,
    limits: f64,
    singularities: f64,
}

impl<'a> NodeCost<'a> {
    /// `None` if neither costs anything.
    pub(super) fn new(robot: &'a Robot<6>, limits: f64, singularities: f64) -> Option<Self> {
        (limits > 0.0 || singularities > 0.0).then_some(Self { robot, limits, singularities })
    }

    /// The cost of joint angles at which a step ends that takes `time` [s].
    pub(super) fn at(&self, q: &[f64; 6], time: f64) -> f64 {
        let mut cost = 0.0;
        if self.limits > 0.0 {
            cost += self.limits * self.robot.nearness_to_limits(q);
        }
        if self.singularities > 0.0 {
            cost += self.singularities * self.robot.nearness_to_singularities(q);
        }
        cost * time * time
    }
}

/// The joints whose turns a search counts: one state for each combination.
#[derive(Clone, Debug)]
pub(super) struct TurnStates {
    /// These joints, with the number of turns of each.
    joints: [Option<usize>; 6],
    /// The turn of each joint in each state; 0 of the other joints.
    pub(super) turns: Vec<[i32; 6]>,
    /// Step of a state's code for a turn of each joint; 0 if its turns are not counted.
    pub(super) strides: [f64; 6],
    /// The code of each state, and the state of each code: there are codes of one turn before the
    /// first and of one after the last, too.
    codes: Vec<f64>,
    by_code: Vec<Option<usize>>,
}

impl Default for TurnStates {
    fn default() -> Self {
        Self::new([None; 6])
    }
}

impl TurnStates {
    fn new(joints: [Option<usize>; 6]) -> Self {
        let (mut strides, mut size) = ([0.0; 6], 1);
        for (stride, count) in strides.iter_mut().zip(joints) {
            let Some(count) = count else { continue };
            *stride = f64::from(whole(size));
            size *= count + 2;
        }
        let states = 0..joints.iter().flatten().product();
        let turns: Vec<[i32; 6]> = states.map(|state| decoded(&joints, state)).collect();
        let code = |turns: &[i32; 6]| {
            turns.iter().zip(strides).map(|(turn, stride)| f64::from(turn + 1) * stride).sum()
        };
        let codes: Vec<f64> = turns.iter().map(code).collect();
        let mut by_code = vec![None; size];
        for (state, code) in codes.iter().enumerate() {
            by_code[count(*code)] = Some(state);
        }
        Self { joints, turns, strides, codes, by_code }
    }

    /// Count the turns of other joints.
    pub(super) fn add(&mut self, others: &[usize], joints: &PlannedJoints) -> Result<(), Error> {
        let turns = others.iter().map(|joint| joints.counts[*joint]);
        let found = turns.fold(self.len(), usize::saturating_mul);
        if found > MOST_TURN_STATES {
            #[expect(clippy::cast_precision_loss, reason = "for a message")]
            let found = found as f64;
            return Err(PlanFault::Turns { found, most: MOST_TURN_STATES }.into());
        }
        let mut counted = self.joints;
        for joint in others {
            counted[*joint] = Some(joints.counts[*joint]);
        }
        *self = Self::new(counted);
        Ok(())
    }

    /// The state from which an edge leads to another, by the code of the turns that it carries, at
    /// most one of each joint.
    #[inline]
    pub(super) fn before(&self, state: usize, carried: f64) -> Option<usize> {
        *self.by_code.get(count(self.codes[state] + carried))?
    }

    pub(super) fn has(&self, joint: usize) -> bool {
        self.joints[joint].is_some()
    }

    pub(super) fn len(&self) -> usize {
        self.turns.len()
    }

    pub(super) fn state(&self, turns: &[i32; 6]) -> Option<usize> {
        let (mut state, mut size) = (0, 1);
        for (count, turn) in self.joints.iter().zip(turns) {
            let Some(count) = count else { continue };
            let turn = usize::try_from(*turn).ok().filter(|turn| turn < count)?;
            state += size * turn;
            size *= count;
        }
        Some(state)
    }

    /// Whether every joint whose turns are counted may have its turn of a state.
    pub(super) fn holds(&self, joints: &PlannedJoints, q: &[f64; 6], state: usize) -> bool {
        let turns = self.turns[state];
        (0..6).all(|joint| !self.has(joint) || turns[joint] <= joints.last_turn(joint, q[joint]))
    }
}

/// The turn of each joint in a state; 0 of a joint whose turns are not counted.
fn decoded(joints: &[Option<usize>; 6], mut state: usize) -> [i32; 6] {
    joints.map(|count| match count {
        None => 0,
        Some(count) => {
            let turn = state % count;
            state /= count;
            whole(turn)
        }
    })
}

fn count(number: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "limits are a few turns wide"
    )]
    let count = number.max(0.0) as usize;
    count
}

/// A count of turns as a number that may be negative.
pub(super) fn whole(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}
