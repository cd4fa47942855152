//! The family of three parallel axes, from corner to corner.
//!
//! Along the family the arm bends and straightens, and where it is stretched or folded the family
//! ends or comes back on the other elbow. The angles of joint 6 at which it turns about or ends,
//! its corners, are known (docs/theory/three_parallel.md). Between two of them the family may be
//! narrower than any step of a turn, and next to one of them the elbow moves with the root of the
//! free joint.

use core::f64::consts::{PI, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::Error;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::solve::nearest::NearestSearch;
use crate::kinematics::solve::self_motion_search::{
    COARSE_STEPS, LEAST_STEPS, STEPS, Sample, VALLEYS,
};
use crate::report::FreeJoint;

/// How often the way to a corner that is in reach is halved at most: from five degrees to 1e-15
/// rad.
const MOST_HALVINGS: i32 = 46;

/// The part of the elbow's angle at a corner down to which the free joint is taken next to it [1].
const NARROW: f64 = 0.02;

/// Parts of an arc at whose ends it is tried whether the pose is met there.
const ARC_PARTS: u32 = 16;

/// A part of a turn of the free joint between two corners. Its angles are taken at a cosine: next
/// to a corner the elbow, which moves with the root of the free joint, moves with that steadily.
struct Arc {
    middle: f64,
    half: f64,
}

impl Arc {
    fn between([low, high]: [f64; 2]) -> Self {
        Self { middle: 0.5 * (low + high), half: 0.5 * (high - low) }
    }

    fn at(&self, part: f64) -> f64 {
        self.middle - self.half * part.cos()
    }

    /// Return the part at which the angle is taken: from 0 at the lower corner to pi at the upper
    /// one.
    fn part(&self, angle: f64) -> f64 {
        ((self.middle - angle) / self.half).clamp(-1.0, 1.0).acos()
    }

    /// The parts inside a window; none where none are.
    fn inside(&self, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
        let apart = (low + high) * 0.5 - self.middle;
        let meets = apart.abs() < self.half + 0.5 * (high - low);
        (self.half > 0.0 && meets).then(|| [self.part(low), self.part(high)])
    }
}

impl<const N: usize> NearestSearch<'_, N> {
    /// Looks at the family of a solution with these corners (`Structure::corners`), on both elbows.
    pub(super) fn look_between_corners(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        corners: [f64; 6],
    ) -> Result<(), Error> {
        let joint = free.joint() - 1;
        let seed = self.wanted.seed[joint];
        for turning in &corners[..2] {
            self.look_at_turning(from, free, *turning)?;
        }
        let mut corners = corners.map(|corner| seed + wrap(corner - seed));
        corners.sort_unstable_by(f64::total_cmp);
        let [first, ..] = corners;
        for (number, low) in corners.into_iter().enumerate() {
            let high = corners.get(number + 1).copied().unwrap_or(first + TAU);
            let arc = Arc::between([low, high]);
            if arc.half > 0.0 && self.is_met_on(from, free, &arc)? {
                self.look_along_arc(from, free, &arc)?;
            }
        }
        Ok(())
    }

    /// Whether the pose is met on an arc. The arm is in reach all along or nowhere, but an
    /// uncertain plane may determine the free joint on a part of it only.
    fn is_met_on(&mut self, from: &Solution<N>, free: FreeJoint, arc: &Arc) -> Result<bool, Error> {
        let parts = if from.free_joint == Some(free) { 2 } else { ARC_PARTS };
        for number in 1..parts {
            let angle = arc.at(PI * f64::from(number) / f64::from(parts));
            if self.sample(from, free, angle)?.least_height().is_finite() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Looks where the arm turns from bending to straightening, ever closer to there.
    fn look_at_turning(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        turning: f64,
    ) -> Result<(), Error> {
        let coarse = TAU / f64::from(COARSE_STEPS);
        let (members, _) = self.members(from, free, turning)?;
        let elbow = |member: &Solution<N>| Some(self.robot.singular_distances(&member.q)?.elbow);
        let Some((member, elbow)) = members
            .iter()
            .filter_map(|member| Some((member, elbow(member)?)))
            .find(|(_, elbow)| *elbow <= coarse)
        else {
            return Ok(());
        };
        self.look_along_upper_arm(member, free)?;
        // The arm turns about within as much of the free joint as it is bent there.
        let mut last = 1;
        while last < MOST_HALVINGS && coarse * 0.5_f64.powi(last) > NARROW * elbow {
            last += 1;
        }
        let off =
            |number: i32| f64::from(number.signum()) * coarse * 0.5_f64.powi(last - number.abs());
        let mut valleys = VALLEYS;
        let mut before = self.sample(from, free, turning + off(-last))?;
        let mut here = self.sample(from, free, turning + off(1 - last))?;
        for number in 2 - last..=last {
            let mut next = self.sample(from, free, turning + off(number))?;
            // Next to there a step halves the way, and the elbow moves as in a coarse one.
            next.place = here.place + coarse;
            self.look_into_valleys(from, free, [&before, &here, &next], &mut valleys)?;
            (before, here) = (here, next);
        }
        Ok(())
    }

    /// Looks at an arm that is folded onto axis 2, where the upper arm may point anywhere with the
    /// free joint where it is.
    fn look_along_upper_arm(&mut self, folded: &Solution<N>, free: FreeJoint) -> Result<(), Error> {
        let joint = free.joint() - 1;
        let others = self.others;
        self.others[joint] = folded.q[joint];
        if self.is_undetermined(folded, FreeJoint::Upper)? {
            self.look_along_self_motion(folded, FreeJoint::Upper)?;
        }
        self.others = others;
        Ok(())
    }

    /// Looks along the part of an arc that may cost less than what was found.
    fn look_along_arc(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        arc: &Arc,
    ) -> Result<(), Error> {
        let joint = free.joint() - 1;
        let (seed, half) = (self.wanted.seed[joint], self.farthest(joint));
        let whole = half >= PI - TAU / f64::from(COARSE_STEPS);
        if whole {
            return self.look_along_parts(from, free, arc, [0.0, PI]);
        }
        // An arc across half a turn from the seed has parts on either side.
        for turns in [0.0, TAU] {
            if let Some(parts) = arc.inside([seed - half + turns, seed + half + turns]) {
                self.look_along_parts(from, free, arc, parts)?;
            }
        }
        Ok(())
    }

    fn look_along_parts(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        arc: &Arc,
        [low, high]: [f64; 2],
    ) -> Result<(), Error> {
        let of_turn = if self.best.is_some() { COARSE_STEPS } else { STEPS };
        let step = TAU / f64::from(of_turn);
        let steps = (LEAST_STEPS..STEPS)
            .find(|steps| f64::from(*steps) * step >= (high - low) * arc.half)
            .unwrap_or(STEPS);
        let mut valleys = VALLEYS;
        let mut here = self.sample(from, free, arc.at(low))?;
        let mut before = Sample::nothing(here.angle);
        for number in 1..=steps {
            let part = low + (high - low) * f64::from(number) / f64::from(steps);
            let mut next = self.sample(from, free, arc.at(part))?;
            next.place = here.place + (high - low) * arc.half / f64::from(steps);
            self.look_into_valleys(from, free, [&before, &here, &next], &mut valleys)?;
            (before, here) = (here, next);
        }
        let mut beyond = Sample::nothing(here.angle);
        beyond.place = here.place;
        self.look_into_valleys(from, free, [&before, &here, &beyond], &mut valleys)
    }
}
