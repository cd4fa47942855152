//! The joint vectors of a pose that no angle of joint 7 determines, of an arm whose slots are
//! ordinals: a surface of them where the other six joints move by themselves, or a single one at
//! the edge of reach.

use super::Search;
use super::free_joints::{LEAST_GAIN, LOCKED};
use super::samples::Sample;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::thresholds::NEAR_CROSSING;

/// Steps towards the seed, at most: each of the seven joints may reach a limit, and a surface
/// bends.
const STEPS: u32 = 32;

/// How often a step is halved that leads to nothing nearer to the seed.
const HALVINGS: u32 = 8;

impl Search<'_> {
    /// Move along the self-motion of a sample: to the best of the members that a walk passes, and
    /// from there towards the seed.
    pub(super) fn choose_member(&mut self, sample: &Sample) {
        let mut best = *sample;
        let mut pass = |_: &[f64; 7], end: &[f64; 7]| {
            let member = self.sample(self.turned(end));
            if !best.is_better_than(Some(&member)) {
                best = member;
            }
        };
        if let Some((motions, pose)) = self.robot.self_motions(self.pose) {
            motions.walk(&pose, &sample.q, &mut pass);
        }
        self.slide_on_surface(best);
    }

    /// Take what meets the pose next to a joint vector, singular or not, and what is nearer to the
    /// seed on the same self-motion.
    pub(super) fn start_at(&mut self, q: &[f64; 7]) {
        if let Some(start) = self.met_next_to(q)
            && self.is_singular(&start.q)
        {
            let start = self.sample(self.turned(&start.q));
            self.slide_on_surface(start);
        }
    }

    /// Start from all over the range of joints: at the edge of reach a pose may have solutions
    /// at single angles of joint 7, which no sample meets.
    pub(super) fn start_anywhere(&mut self) {
        let robot = self.robot;
        robot.approaches(self.pose).for_each(|(_, q)| self.start_at(&q));
    }

    /// Whether the curve crosses itself nearby, or ends there; elsewhere a descent follows it.
    fn is_singular(&self, q: &[f64; 7]) -> bool {
        let scaled = self.scaled(q, &[1.0; 7]);
        scaled.is_none_or(|scaled| scaled.sizes.min() <= NEAR_CROSSING * scaled.sizes.max())
    }

    /// Move towards the seed, tool in place, until a step gains nothing. A joint that reaches a
    /// limit is locked there.
    fn slide_on_surface(&mut self, from: Sample) {
        let (mut best, mut weights) = (from, self.weights);
        self.keep(&best.q);
        for _ in 0..STEPS {
            let Some(way) = self.still_tool(&best.q, &weights) else { return };
            let (part, blocked) = self.inside_part(&best.q, &way, &weights);
            let way = way.map(|angle| part * angle);
            match (self.step_on_surface(&best, &way), blocked) {
                (Some(next), _) => best = next,
                (None, Some(joint)) => weights[joint] = LOCKED,
                (None, None) => return,
            }
        }
    }

    /// Go a part of a way, as far as that gains.
    fn step_on_surface(&mut self, from: &Sample, way: &[f64; 7]) -> Option<Sample> {
        let mut part = 1.0;
        for _ in 0..=HALVINGS {
            let ahead = core::array::from_fn(|joint| from.q[joint] + part * way[joint]);
            let next = self.met_next_to(&ahead)?;
            if (next.outside, next.cost) < (from.outside, from.cost * (1.0 - LEAST_GAIN)) {
                self.keep(&next.q);
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }

    /// The joint vector next to another one that meets the pose.
    fn met_next_to(&self, q: &[f64; 7]) -> Option<Sample> {
        let (_, q) = self.robot.minimized(self.pose, *q);
        (self.robot.residual(&q, self.pose).largest() <= meets(self.pose)).then(|| self.sample(q))
    }
}
