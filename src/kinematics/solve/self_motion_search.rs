//! The self-motion along a free joint that moves more than a partner: a bounded walk from corner to
//! corner, with the members in closed form.
//!
//! Between two corners the branches neither meet nor end. A step is short where the joints move
//! fast, so that none of it is passed over (docs/theory/singularities.md, section 6).

use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow::{Break, Continue};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::solve::minimum::minimum;
use crate::kinematics::solve::nearest::{NearestSearch, UNCERTAIN_SIN_5, Wanted};
use crate::kinematics::solve::pair::Pair;
use crate::kinematics::structure::continuum::{Steps, walk};
use crate::kinematics::structure::family::Family;
use crate::kinematics::thresholds::LIMIT_SLACK;
use crate::report::FreeJoint;

/// How far the joints move in a step, and at most [rad].
const STEP: f64 = 0.12;
const LONGEST_STEP: f64 = 0.3;

/// Steps along an arc [1], and how many the first would make.
const STEPS: Steps =
    Steps { first: PI, least: 0.0, longest: f64::INFINITY, shorter: 0.25, most: 320 };
const FIRST_STEPS: f64 = 6.0;

/// How far beside a solution it is tried whether the pose is met [rad], and in how many parts of an
/// arc where the solution does not name the self-motion.
const BESIDE: f64 = 0.05;
const ARC_PARTS: u32 = 16;

/// Parts of an arc at whose ends any member is looked for.
const ANY_PARTS: u32 = 8;

/// Step that is taken however far the joints move [1]: the root of the rounding of an angle.
const LEAST_STEP: f64 = 1e-8;

/// How much farther the joints may move between three members than from one to the next [1].
const MOST_DETOUR: f64 = 2.0;

/// A part of a turn of the free joint between two corners. Its angles are taken at a cosine: next
/// to an edge of reach the joints, which move with the root of the free joint, move with that
/// steadily.
#[derive(Clone, Copy)]
struct Arc {
    middle: f64,
    half: f64,
}

impl Arc {
    fn at(&self, part: f64) -> f64 {
        self.middle - self.half * part.cos()
    }

    /// Return the parts, from 0 at the lower corner to pi at the upper one, inside a window; `None`
    /// where the arc is outside.
    fn inside(&self, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
        let apart = ((low + high) * 0.5 - self.middle).abs();
        let part = |angle: f64| ((self.middle - angle) / self.half).clamp(-1.0, 1.0).acos();
        (apart < self.half + 0.5 * (high - low)).then(|| [part(low), part(high)])
    }
}

/// The self-motion of a solution.
#[derive(Clone, Copy)]
struct Along<'a, const N: usize> {
    family: &'a dyn Family<N>,
    from: &'a Solution<N>,
    free: FreeJoint,
}

/// Two members on different branches, at one part of an arc.
#[derive(Clone, Copy)]
struct Sample<const N: usize> {
    part: f64,
    q: [Option<[f64; N]>; 2],
    /// How far the farthest joint is outside its limits or, inside them, less than zero and the
    /// less the nearer to the seed.
    heights: [f64; 2],
}

impl<const N: usize> Sample<N> {
    /// Return how far the joints move to another sample [rad]; infinity where a branch ends between
    /// them.
    fn to(&self, other: &Self) -> f64 {
        let moved = |(from, to): (&Option<[f64; N]>, &Option<[f64; N]>)| match (from, to) {
            (Some(from), Some(to)) => {
                from.iter().zip(to).map(|(from, to)| wrap(to - from).powi(2)).sum::<f64>().sqrt()
            }
            (None, None) => 0.0,
            _ => f64::INFINITY,
        };
        self.q.iter().zip(&other.q).map(moved).fold(0.0, f64::max)
    }
}

impl<const N: usize> NearestSearch<'_, N> {
    /// Search the self-motion of a solution, on both its branches.
    pub(super) fn look_along_self_motion(&mut self, from: &Solution<N>, free: FreeJoint) {
        let Some((motions, pose)) = self.robot.self_motions(self.known.pose()) else { return };
        let q_and_rest = [&from.q, self.wanted.seed];
        motions.with_family(&pose, q_and_rest, free, &mut |family| {
            if self.is_first_of(from, free.joint(), family.bit()) {
                self.look_along_family(Along { family, from, free });
            }
        });
    }

    fn look_along_family(&mut self, along: Along<'_, N>) {
        let Wanted { seed, weights, .. } = self.wanted;
        let apart = |joint: usize| weights[joint] * wrap(along.from.q[joint] - seed[joint]).powi(2);
        let still: f64 = along.free.still().iter().map(|joint| apart(joint - 1)).sum();
        // The joints that stand still may cost more than what was found.
        if self.best.is_some_and(|best| still > best.cost) {
            return;
        }
        let joint = along.free.joint() - 1;
        let seed = seed[joint];
        for angle in [along.from.q[joint], seed] {
            for turned in [angle, angle + PI] {
                let sample = self.sample(along, turned);
                for (side, q) in sample.q.into_iter().enumerate() {
                    if let (Some(q), None) = (q, self.best) {
                        let member = along.member((q, side == 1));
                        self.move_onto_pose(&member.q, LIMIT_SLACK, &member);
                    }
                }
            }
        }
        let mut corners = along.family.corners().map(|corner| seed + wrap(corner - seed));
        corners.sort_unstable_by(f64::total_cmp);
        let [first, ..] = corners;
        let arcs: [Arc; 6] = core::array::from_fn(|number| {
            let high = corners.get(number + 1).copied().unwrap_or(first + TAU);
            Arc { middle: 0.5 * (corners[number] + high), half: 0.5 * (high - corners[number]) }
        });
        if self.takes_any && self.has_any(along, &arcs) {
            return;
        }
        for (number, corner) in corners.into_iter().enumerate() {
            if number == 0 || corner > corners[number - 1] {
                self.look_at_corner(along, corner);
            }
        }
        if self.is_family(along, &arcs) {
            for arc in arcs.into_iter().filter(|arc| arc.half > 0.0) {
                self.look_along_arc(along, arc);
            }
        }
    }

    /// Whether a member is inside the limits that the coarse parts of arcs show.
    fn has_any(&mut self, along: Along<'_, N>, arcs: &[Arc; 6]) -> bool {
        for arc in arcs.iter().filter(|arc| arc.half > 0.0) {
            for number in 1..ANY_PARTS {
                self.sample(along, arc.at(PI * f64::from(number) / f64::from(ANY_PARTS)));
            }
        }
        self.best.is_some()
    }

    /// Whether the pose is met elsewhere than at the solution: next to a singularity it is not, or
    /// on a part of an arc only that an uncertain plane of the arm leaves undetermined.
    fn is_family(&self, along: Along<'_, N>, arcs: &[Arc; 6]) -> bool {
        let parts = if along.from.free_joint == Some(along.free) { 2 } else { ARC_PARTS };
        let own = along.from.q[along.free.joint() - 1];
        let of_arcs = arcs.iter().flat_map(|arc| {
            (1..parts).map(|number| arc.at(PI * f64::from(number) / f64::from(parts)))
        });
        [own + BESIDE, own - BESIDE].into_iter().chain(of_arcs).any(|at| self.is_met(along, at))
    }

    /// Whether a member with the free joint at an angle meets the pose.
    fn is_met(&self, along: Along<'_, N>, angle: f64) -> bool {
        let (robot, pose) = (self.robot, self.known.pose());
        let mut members = along.family.at(angle).into_iter().flatten();
        members.any(|(q, _)| robot.residual(&q, pose).largest() <= self.allowed)
    }

    /// Search the pair of joints that may be undetermined at a corner, too.
    fn look_at_corner(&mut self, along: Along<'_, N>, corner: f64) {
        let Wanted { limits, seed, weights, .. } = self.wanted;
        for (q, is_second) in along.family.at(corner).into_iter().flatten() {
            let pair = Pair::at(along.family.pair(&q), &q);
            if let Some(angle) = pair.nearest(limits, seed, weights) {
                let member = along.member((pair.put(&q, angle), is_second));
                self.take_if_met(&member, along.from);
            }
            if self.robot.sin_5(&q).is_some_and(|sin_5| sin_5.abs() <= UNCERTAIN_SIN_5) {
                self.look_at_wrist(&along.member((q, is_second)));
            }
        }
    }

    /// Search the part of an arc that may cost less than what was found.
    fn look_along_arc(&mut self, along: Along<'_, N>, arc: Arc) {
        let joint = along.free.joint() - 1;
        let (seed, half) = (self.wanted.seed[joint], self.farthest(joint));
        if along.family.at(arc.middle).iter().all(Option::is_none) {
            return;
        }
        if half >= PI {
            return self.look_along_parts(along, arc, [0.0, PI]);
        }
        // An arc across half a turn from the seed has parts on either side.
        for turns in [0.0, TAU] {
            if let Some(parts) = arc.inside([seed - half + turns, seed + half + turns]) {
                self.look_along_parts(along, arc, parts);
            }
        }
    }

    /// Walk from one part of an arc to another, and look into the valleys.
    fn look_along_parts(&mut self, along: Along<'_, N>, arc: Arc, [low, high]: [f64; 2]) {
        let start = self.sample_at(along, arc, low);
        let mut passed = [None, Some(start)];
        walk(start, Steps { first: (high - low) / FIRST_STEPS, ..STEPS }, |here, step| {
            let next = self.sample_at(along, arc, (here.part + step).min(high));
            let moved = here.to(&next);
            if moved > LONGEST_STEP && step > LEAST_STEP {
                return None;
            }
            self.look_into_valleys(along, arc, [passed[0], Some(*here), Some(next)]);
            passed = [Some(*here), Some(next)];
            let growth = (STEP / moved).clamp(0.25, 3.0);
            Some(if next.part < high { Continue((next, growth)) } else { Break(()) })
        });
        self.look_into_valleys(along, arc, [passed[0], passed[1], None]);
    }

    /// Search between three samples where the joints of a branch are the least outside the limits,
    /// or the nearest to the seed.
    fn look_into_valleys(&mut self, along: Along<'_, N>, arc: Arc, of: [Option<Sample<N>>; 3]) {
        let [before, Some(here), next] = of else { return };
        let width = [before, next].into_iter().flatten().map(|other| here.to(&other)).sum::<f64>();
        let [low, high] = [before, next].map(|end| end.unwrap_or(here).part);
        for side in 0..2 {
            let height =
                |sample: Option<Sample<N>>| sample.map_or(f64::INFINITY, |s| s.heights[side]);
            let is_valley =
                here.heights[side] < height(before) && here.heights[side] <= height(next);
            if is_valley && self.may_be_nearer(here.heights[side], width) {
                let at = |part| self.sample_at(along, arc, part).heights[side];
                minimum(at, [low, here.part, high], here.heights[side]);
            }
        }
    }

    /// Whether a valley of this height and width may have a member that is nearer than what was
    /// found.
    fn may_be_nearer(&self, height: f64, width: f64) -> bool {
        let reach = MOST_DETOUR * width;
        if height >= 0.0 {
            return height <= reach;
        }
        let Some(best) = self.best else { return true };
        let heaviest = self.wanted.weights.iter().copied().fold(0.0, f64::max);
        let cost = -1.0 / height - 1.0;
        cost.sqrt() - best.cost.sqrt() < heaviest.sqrt() * reach
    }

    /// How far from the seed a joint, from 0, may be without costing more than what was found by
    /// itself [rad].
    fn farthest(&self, joint: usize) -> f64 {
        self.best.map_or(f64::INFINITY, |best| {
            (best.cost / self.wanted.weights[joint]).sqrt().max(f64::MIN_POSITIVE)
        })
    }

    fn sample_at(&mut self, along: Along<'_, N>, arc: Arc, part: f64) -> Sample<N> {
        Sample { part, ..self.sample(along, arc.at(part)) }
    }

    /// Take the members with the free joint at an angle.
    fn sample(&mut self, along: Along<'_, N>, angle: f64) -> Sample<N> {
        let mut sample = Sample { part: 0.0, q: [None; 2], heights: [f64::INFINITY; 2] };
        for member in along.family.at(angle).into_iter().flatten() {
            let side = usize::from(member.1);
            sample.q[side] = Some(member.0);
            sample.heights[side] = self.take_if_met(&along.member(member), along.from);
        }
        sample
    }
}

impl<const N: usize> Along<'_, N> {
    /// Return a member, on the second branch or not, as a solution.
    fn member(&self, (mut q, is_second): ([f64; N], bool)) -> Solution<N> {
        let Self { family, from, free } = *self;
        // A locked joint keeps its angle.
        if let (Some(last), Some(locked)) = (q.get_mut(6), from.q.get(6)) {
            *last = *locked;
        }
        let bit = if is_second { family.bit() } else { 0 };
        let slot = Slot::new(from.slot.index() & !family.bit() | bit);
        let own = match free {
            FreeJoint::Base => Status::SHOULDER,
            FreeJoint::Upper | FreeJoint::UpperCoupled | FreeJoint::UpperOpposed => Status::ELBOW,
            _ => Status::WRIST,
        };
        // Other singularities come and go along it.
        let all = Status::SHOULDER | Status::ELBOW | Status::WRIST;
        Solution { q, slot, free_joint: Some(free), status: from.status & !(all & !own) }
    }
}
