//! The one configuration that stands for a self-motion.
//!
//! Docs: general.md, eq. 103.

use core::ops::ControlFlow;

use super::accepted::{Accepted, ROOM};
use super::chain::{Closure, Target};
use super::configuration::{Configuration, ISOLATED, Kind};
use super::member::Member;
use super::members::part_with;
use super::self_motion::SelfMotion;

/// Angle by which a joint that moves does so on the way [rad].
const MOVES: f64 = 1e-3;

/// Angle by which some joint of a self-motion moves [rad].
const MOVES_AT_ALL: f64 = 0.02;

/// A step of a walk on which a joint passes its angle, and how far the other joints are there.
#[derive(Clone, Copy)]
struct Passed {
    ends: [Member; 2],
    distance: f64,
}

/// What a walk along a self-motion has passed.
#[derive(Clone, Copy)]
struct Way {
    first: Option<[f64; 6]>,
    /// How far each joint was from its first angle, at most [rad].
    most: [f64; 6],
    /// Where each joint passes its given angle: of several places the nearest.
    passed: [Option<Passed>; 6],
}

impl Way {
    const NONE: Self = Self { first: None, most: [0.0; 6], passed: [None; 6] };

    fn pass(&mut self, ends: [&Member; 2], near: &[f64; 6]) {
        let [one, next] = ends;
        // Where self-motions cross, a start that is off closes to rounding too: the members behind
        // it count.
        let first = self.first.get_or_insert(next.theta);
        for joint in 0..6 {
            self.most[joint] = self.most[joint].max((next.theta[joint] - first[joint]).abs());
            let Some(part) = part_with(ends, joint, near[joint]) else { continue };
            let between = |i: usize| one.theta[i] + part * (next.theta[i] - one.theta[i]);
            let place =
                Configuration { theta: core::array::from_fn(between), ..Configuration::NONE };
            let distance = place.distance(near);
            let passed = &mut self.passed[joint];
            if passed.is_none_or(|other| distance < other.distance) {
                *passed = Some(Passed { ends: [*one, *next], distance });
            }
        }
    }

    fn moves_at_all(&self) -> bool {
        self.most.iter().any(|most| *most > MOVES_AT_ALL)
    }

    /// The member where the first joint that moves passes its angle, or else another one.
    fn member(
        &self,
        motion: &SelfMotion<'_>,
        near: &[f64; 6],
        other: Configuration,
    ) -> Configuration {
        // Those of two self-motions that nearly cross may stand still to rounding on a long part of
        // the way.
        let moving = self.most.map(|most| most > MOVES);
        let passed = moving.iter().position(|moves| *moves).and_then(|first| {
            let Passed { ends: [one, next], .. } = self.passed[first].as_ref()?;
            motion.member_between([one, next], first, near)
        });
        Configuration { kind: Kind::Free(moving), ..passed.unwrap_or(other) }
    }
}

impl Accepted {
    /// Keep one configuration of each self-motion: that whose first joint that moves has its angle
    /// of `near`, if the self-motion passes there. What then is the same stands once.
    pub(crate) fn represent(&mut self, closure: &Closure, target: &Target, near: &[f64; 6]) {
        let mut members = [(Configuration::NONE, Configuration::NONE); ROOM];
        let mut count = 0;
        self.walk_along_each(closure, target, near, &mut |one, motion, way| {
            members[count] = (*one, way.member(motion, near, *one));
            count += 1;
        });
        let kept = self.emptied();
        for one in kept.as_slice() {
            let member = members[..count].iter().find(|(kept, _)| kept == one);
            let mut member = member.map_or(*one, |(_, member)| *member);
            if let Kind::Surface(moving) = one.kind
                && let Some(joint) = moving.iter().position(|moves| *moves)
                && let Some(there) =
                    closure.member_of_surface(target, &one.theta, joint, near[joint])
            {
                member = Configuration { kind: one.kind, ..there };
            }
            self.insert(closure, member);
        }
    }

    /// Keep the first configuration of each self-motion.
    pub(super) fn thin(&mut self, closure: &Closure, target: &Target) {
        self.walk_along_each(closure, target, &[0.0; 6], &mut |_, _, _| {});
    }

    /// Walk along each self-motion and remove what it meets: that is one of its own. What does not
    /// move is none.
    fn walk_along_each(
        &mut self,
        closure: &Closure,
        target: &Target,
        near: &[f64; 6],
        take: &mut dyn FnMut(&Configuration, &SelfMotion<'_>, &Way),
    ) {
        self.thin_surfaces(closure, target);
        let mut index = 0;
        while let Some(one) = self.as_slice().get(index).copied() {
            if let Kind::Free(_) = one.kind {
                let motion = closure.self_motions(target, &one.theta).next();
                let mut way = Way::NONE;
                if let Some(motion) = &motion {
                    motion.around(&mut |start, end| {
                        way.pass([start, end], near);
                        self.remove_met(motion, &one, [start, end]);
                        ControlFlow::Continue(())
                    });
                }
                // It is kept, though earlier ones may have been removed.
                index = self.as_slice().iter().position(|kept| *kept == one).unwrap_or(index);
                match motion.filter(|_| way.moves_at_all()) {
                    Some(motion) => take(&one, &motion, &way),
                    None => self.replace(index, Configuration { kind: Kind::FOLD, ..one }),
                }
            }
            index += 1;
        }
    }

    /// Remove what is on a step of a self-motion, but for the one that is kept.
    fn remove_met(&mut self, motion: &SelfMotion<'_>, kept: &Configuration, ends: [&Member; 2]) {
        let mut other = 0;
        while other < self.as_slice().len() {
            let one = self.as_slice()[other];
            // A solution of its own is not singular, to rounding.
            let may_be = one != *kept && (one.kind != Kind::Regular || one.least <= ISOLATED);
            if may_be && motion.passes(ends, &one.theta) {
                self.remove(other);
            } else {
                other += 1;
            }
        }
    }
}
