//! The solution of an arm with a spherical wrist that has a configuration: there is one, at one of
//! its 2 pi equivalents.

use super::rule::Quarters;
use crate::error::Error;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::correction::DAMPED;
use crate::kinematics::solve::nearest::Wanted;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, SEEDED_FREE, SOLUTION_OFF};
use crate::report::{Configuration, ConfigurationRule};

/// How closely the slot of a solution must match a configuration's.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Closeness {
    /// Equal, or axis 5 is zero to rounding.
    Same,
    /// Equal after an elbow that is straight to rounding is bent.
    Bent,
    /// Either of two slots that meet at a singularity, or within the edge.
    Met,
}

const QUARTERS: Quarters = Quarters::of(&ConfigurationRule::SphericalWrist);

impl Robot<6> {
    /// [`Robot::ik_configured`] of an arm with a spherical wrist, for a pose that is checked.
    pub(super) fn configured_wrist(
        &self,
        pose: Pose,
        wanted: Configuration,
    ) -> Result<Solution<6>, Error> {
        let mut solutions = self.unsolved(pose);
        let found = if self.solve_in_lanes(&mut solutions, f64::NAN) {
            self.configured_regular(&solutions, wanted)
        } else {
            self.solve_singular(&mut solutions, f64::NAN)?;
            self.configured_singular(&solutions, wanted)?
        };
        if let Some(found) = found {
            return Ok(found);
        }
        Err(self.no_configuration(&ConfigurationRule::SphericalWrist, &solutions, wanted)?)
    }

    /// The slot of a joint vector; a spherical wrist always has one.
    fn wrist_slot(&self, q: &[f64; 6]) -> Slot {
        self.slot_of(q).unwrap_or(Slot::new(0))
    }

    /// The solution of a regular pose that has the configuration, at some 2 pi equivalent.
    fn configured_regular(
        &self,
        solutions: &Solutions<6>,
        wanted: Configuration,
    ) -> Option<Solution<6>> {
        for edge in [0.0, CONFIGURATION_EDGE] {
            let Some(limits) = self.limits().narrowed(&QUARTERS.ranges(wanted, edge)) else {
                continue;
            };
            for closeness in [Closeness::Same, Closeness::Met] {
                let mut candidates = solutions.clone();
                candidates.limits = limits;
                for place in candidates.places_mut() {
                    let has_slot = |solution: &Solution<6>| {
                        self.has_slot(solution, solution.slot, wanted, edge, closeness)
                    };
                    if !place.found().is_some_and(has_slot) {
                        *place = Place::Empty;
                    }
                }
                let found = candidates.cheapest(&limits.rest(), &[1.0; 6], Cost::Distance);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// The solution of a singular pose that has the configuration, with any angles of the
    /// undetermined joints.
    fn configured_singular(
        &self,
        solutions: &Solutions<6>,
        wanted: Configuration,
    ) -> Result<Option<Solution<6>>, Error> {
        for allowed in [meets(solutions.pose()), SOLUTION_OFF] {
            for edge in [0.0, CONFIGURATION_EDGE] {
                let Some(limits) = self.limits().narrowed(&QUARTERS.ranges(wanted, edge)) else {
                    continue;
                };
                for closeness in [Closeness::Same, Closeness::Bent, Closeness::Met] {
                    let accepts = &|solution: &Solution<6>| {
                        let slot = self.wrist_slot(&solution.q);
                        self.has_slot(solution, slot, wanted, edge, closeness)
                    };
                    let (seed, weights) = (&limits.rest(), &[1.0; 6]);
                    let asked = Wanted { limits, seed, weights, accepts };
                    let found = self.nearest_within(solutions, &asked, allowed)?;
                    let Some((_, found)) = found else { continue };
                    let found = self.on_side(solutions, found, wanted);
                    let same =
                        self.is_coupled() || self.wrist_slot(&found.q).number() == wanted.cfx;
                    if same || closeness == Closeness::Met {
                        return Ok(Some(found));
                    }
                }
            }
        }
        Ok(None)
    }

    /// Whether a solution in `slot` has the slot of a configuration or, with `Closeness::Met`, one
    /// that meets it within `edge` [rad].
    ///
    /// A coupled arm has no slot: the branches in front of the lower arm are tried first.
    fn has_slot(
        &self,
        solution: &Solution<6>,
        slot: Slot,
        wanted: Configuration,
        edge: f64,
        closeness: Closeness,
    ) -> bool {
        let slot = slot.number();
        if self.is_coupled() {
            return (slot & 2 == 0) == (closeness == Closeness::Same);
        }
        if slot == wanted.cfx {
            return true;
        }
        let singular = self.inverse().map(|inverse| inverse.singular(&solution.q));
        let Some((Some(near), singularities)) = singular else { return false };
        let open = match closeness {
            Closeness::Same => [near.wrist <= SEEDED_FREE, false, false],
            Closeness::Bent => {
                [near.wrist <= SEEDED_FREE, singularities.contains(SingularityKind::ELBOW), false]
            }
            Closeness::Met => {
                let singularities = singularities | solution.singularities();
                [
                    near.wrist <= edge || singularities.contains(SingularityKind::WRIST),
                    near.elbow <= edge || singularities.contains(SingularityKind::ELBOW),
                    singularities.contains(SingularityKind::SHOULDER),
                ]
            }
        };
        let open = [1, 2, 4].iter().zip(open).filter(|(_, open)| *open).map(|(bit, _)| bit);
        (slot ^ wanted.cfx) & !open.sum::<i32>() == 0
    }

    /// The solution with an axis 5 that is zero to rounding, or an elbow that is straight to
    /// rounding, moved to the side that the configuration names.
    fn on_side(
        &self,
        solutions: &Solutions<6>,
        solution: Solution<6>,
        wanted: Configuration,
    ) -> Solution<6> {
        let (Some(inverse), Some(wrist)) = (self.inverse(), self.singular_wrist()) else {
            return solution;
        };
        let moved_onto_pose = |start: [f64; 6], kept: usize| {
            let limits = self.limits();
            let (q, off) = self.corrected(solutions.pose(), start, limits, &[kept], DAMPED);
            (off <= meets(solutions.pose()) && limits.contains(&q)).then_some(q)
        };
        let mut q = solution.q;
        if self.is_coupled() || self.wrist_slot(&q).number() == wanted.cfx {
            return solution;
        }
        if (self.wrist_slot(&q).number() ^ wanted.cfx) & 2 != 0
            && inverse.singular(&q).1.contains(SingularityKind::ELBOW)
        {
            let bent = wrist.with_bent_elbow(&q, wanted.cfx & 2 != 0);
            q = moved_onto_pose(bent, 2).unwrap_or(q);
        }
        if (self.wrist_slot(&q).number() ^ wanted.cfx) & 1 != 0 {
            let sides = [1.0, -1.0].map(|side| wrist.with_straight_wrist(&q, side));
            let there = |q: &[f64; 6]| (self.wrist_slot(q).number() ^ wanted.cfx) & 1 == 0;
            q = sides.into_iter().filter(there).find_map(|q| moved_onto_pose(q, 4)).unwrap_or(q);
        }
        if self.wrist_slot(&q).number() == wanted.cfx {
            Solution { q, ..solution }
        } else {
            solution
        }
    }
}
