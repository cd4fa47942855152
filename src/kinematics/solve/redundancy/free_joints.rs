//! What a pose leaves open besides joint 7: at a singularity whole families of joint vectors meet it.

use core::f64::consts::TAU;

use super::Search;
use super::samples::{Sample, Samples};
use crate::error::Error;

/// The joints, from 0, of which a solve takes the angle that it is given where the pose leaves them open.
const OPEN: [usize; 3] = [0, 4, 5];

/// Angles of a joint that are looked at in a turn; between the best one's neighbors its valley is narrowed.
const PLACES: u32 = 32;

/// Probes: each leaves 62 % of the way, all of them 1e-9 rad.
const NARROWINGS: u32 = 42;

/// Where an interval is cut so that the larger part is cut alike: the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Rounds in which several open joints are chosen, one after the other.
const ROUNDS: u32 = 8;

impl Search<'_> {
    /// Looks for the nearest of the joint vectors among which the open joints choose, from those of a sample on.
    pub(super) fn choose_free_joints(&mut self, sample: &Sample) -> Result<(), Error> {
        let (mut best, mut rest) = (*sample, sample.q);
        for _ in 0..ROUNDS {
            let before = best;
            for joint in OPEN {
                if let Some(found) = self.choose(&rest, joint)?
                    && found.is_better_than(Some(&best))
                {
                    (best, rest) = (found, found.q);
                }
            }
            // A round that gains nothing is the last.
            if (before.outside, before.cost) <= (best.outside, best.cost * (1.0 + 1e-12)) {
                break;
            }
        }
        Ok(())
    }

    /// The best solution of every angle of one joint; `None` where the pose determines it.
    fn choose(&mut self, rest: &[f64; 7], joint: usize) -> Result<Option<Sample>, Error> {
        let step = TAU / f64::from(PLACES);
        let (here, next) = (self.with(rest, joint, 0.0)?, self.with(rest, joint, step)?);
        if here.slots.iter().flatten().map(|sample| sample.q).eq(next
            .slots
            .iter()
            .flatten()
            .map(|sample| sample.q))
        {
            return Ok(None);
        }
        let (mut middle, mut best) = (0.0, here.best());
        for place in 1..PLACES {
            let turn = f64::from(place) * step;
            let found = self.with(rest, joint, turn)?.best();
            if found
                .is_some_and(|found| !best.is_some_and(|best| best.is_better_than(Some(&found))))
            {
                (middle, best) = (turn, found);
            }
        }
        let (mut low, mut high) = (middle - step, middle + step);
        for _ in 0..NARROWINGS {
            let probe = if high - middle > middle - low {
                middle + GOLDEN * (high - middle)
            } else {
                middle - GOLDEN * (middle - low)
            };
            let found = self.with(rest, joint, probe)?.best();
            if found.is_some_and(|found| found.is_better_than(best.as_ref())) {
                *(if probe > middle { &mut low } else { &mut high }) = middle;
                (middle, best) = (probe, found);
            } else {
                *(if probe > middle { &mut high } else { &mut low }) = probe;
            }
        }
        Ok(best)
    }

    fn with(&mut self, rest: &[f64; 7], joint: usize, turn: f64) -> Result<Samples, Error> {
        let mut rest = *rest;
        rest[joint] += turn;
        self.samples(&rest)
    }
}
