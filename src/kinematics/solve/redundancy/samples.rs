//! The solutions of all slots for an angle of joint 7.

use core::cmp::Ordering;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use crate::error::Error;
use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::SAMPLE_LEAP;

/// A solution, at its 2 pi equivalents nearest to the seed if those are inside the limits.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) q: [f64; 7],
    /// The joints outside their limits, one bit each, and the largest excess [rad].
    pub(super) joints_outside: u8,
    pub(super) outside: f64,
    pub(super) cost: f64,
    /// Whether the pose may leave a joint besides joint 7 undetermined: a straight elbow may leave
    /// the shoulder on axis 5 to rounding.
    pub(super) is_free: bool,
    /// Whether it is one of a self-motion at its angle of joint 7. Which one, a solve chooses: it
    /// shows nothing of where others end or how far they move.
    pub(super) is_chosen: bool,
}

impl Sample {
    fn leaps_to(&self, other: &Self) -> bool {
        self.q.iter().zip(&other.q).any(|(a, b)| wrap(a - b).abs() > SAMPLE_LEAP)
    }

    /// Sum of the squared angles between two samples, whole turns not regarded.
    fn apart(&self, other: &Self) -> f64 {
        self.q.iter().zip(&other.q).map(|(a, b)| wrap(a - b).powi(2)).sum()
    }

    pub(super) fn is_better_than(&self, other: Option<&Self>) -> bool {
        let better = |other: &Self| {
            (self.outside, self.cost).partial_cmp(&(other.outside, other.cost))
                != Some(Ordering::Greater)
        };
        other.is_none_or(better)
    }
}

#[derive(Clone, Copy)]
pub(super) struct Samples {
    pub(super) q7: f64,
    /// Whether a slot is the same branch at every angle of joint 7. Where slots are ordinals, the
    /// nearest sample is the same branch.
    pub(super) are_named: bool,
    pub(super) slots: [Option<Sample>; MOST_SLOTS],
}

impl Samples {
    pub(super) const NONE: Self = Self { q7: 0.0, are_named: true, slots: [None; MOST_SLOTS] };

    pub(super) fn are_none(&self) -> bool {
        self.slots.iter().all(Option::is_none)
    }

    /// The sample of the same branch as one in a slot of neighboring samples.
    pub(super) fn same_branch(&self, slot: usize, sample: &Sample) -> Option<&Sample> {
        if self.are_named {
            return self.slots[slot].as_ref();
        }
        let others = self.slots.iter().flatten().filter(|other| !sample.leaps_to(other));
        others.min_by(|a, b| sample.apart(a).total_cmp(&sample.apart(b)))
    }

    /// Whether a joint of some slot moves so far to the other samples that something may be missed
    /// between them. At an edge of reach a slot continues in a twin with another elbow or wrist but
    /// the same shoulder.
    pub(super) fn leap_to(&self, other: &Self) -> bool {
        if !(self.are_named && other.are_named) {
            let is_alone = |sample: &Sample, others: &Self| {
                !sample.is_chosen
                    && others.slots.iter().flatten().all(|other| sample.leaps_to(other))
            };
            return self.slots.iter().flatten().any(|sample| is_alone(sample, other))
                || other.slots.iter().flatten().any(|sample| is_alone(sample, self));
        }
        let ends = |slot: usize, end: &Sample, others: &Self| {
            let shoulder = slot / 4 * 4;
            let mut twins = others.slots[shoulder..shoulder + 4].iter().flatten();
            twins.all(|twin| end.leaps_to(twin))
        };
        self.slots.iter().zip(&other.slots).enumerate().any(|(slot, pair)| match pair {
            (Some(from), Some(to)) => from.leaps_to(to),
            (Some(from), None) => ends(slot, from, other),
            (None, Some(to)) => ends(slot, to, self),
            (None, None) => false,
        })
    }

    pub(super) fn best(&self) -> Option<Sample> {
        let better = |best: Option<Sample>, sample: &Sample| {
            if sample.is_better_than(best.as_ref()) { Some(*sample) } else { best }
        };
        self.slots.iter().flatten().fold(None, better)
    }
}

impl Search<'_> {
    /// The solutions with joint 7, and the other undetermined joints, at their values in `rest`.
    pub(super) fn samples(&mut self, rest: &[f64; 7]) -> Result<Samples, Error> {
        let solutions = self.robot.solve(*self.pose, &FreeChoice::seed(*rest))?;
        if !(self.are_named || solutions.is_certified()) {
            self.uncertain = self.uncertain.saturating_sub(1);
        }
        let slots = core::array::from_fn(|slot| {
            let solution = solutions.slot(slot)?;
            let is_chosen = solution.free_joint.is_some();
            Some(Sample {
                is_free: is_chosen || solution.status.contains(Status::ELBOW),
                is_chosen,
                ..self.sample(self.turned(&solution.q))
            })
        });
        slots.iter().flatten().for_each(|sample: &Sample| self.keep(&sample.q));
        // As the explanation counts it: at the best turn.
        let outside = slots
            .iter()
            .flatten()
            .map(|sample: &Sample| self.robot.limits().worst_overrun(&sample.q).max(0.0))
            .fold(f64::INFINITY, f64::min);
        self.miss(solutions.reach().shortfall(), outside, solutions.explain());
        Ok(Samples { q7: rest[6], are_named: self.are_named, slots })
    }

    /// A joint vector of the pose.
    pub(super) fn sample(&self, q: [f64; 7]) -> Sample {
        Sample {
            q,
            joints_outside: self.joints_outside(&q),
            outside: self.outside(&q),
            cost: self.cost(&q),
            is_free: false,
            is_chosen: false,
        }
    }

    /// The solutions with joint 7 at an angle, the other undetermined joints at the seed's.
    pub(super) fn samples_at(&mut self, q7: f64) -> Result<Samples, Error> {
        let mut rest = self.seed;
        rest[6] = q7;
        self.samples(&rest)
    }
}
