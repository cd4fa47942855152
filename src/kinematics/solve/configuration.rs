//! ABB's confdata: selects one of the solutions of a pose and one of its 2 pi equivalents.

use core::f64::consts::FRAC_PI_2;

use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::{Error, JointFault, ModelFault, NoConfiguration};
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::answer::select::{Cost, Turns};
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::correction::DAMPED;
use crate::kinematics::solve::nearest::Wanted;
use crate::kinematics::solve::seeded::Inverse as _;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::Structure as _;
use crate::kinematics::structure::spherical_wrist::SphericalWrist;
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, MOST_ANGLE, SEEDED_FREE, SOLUTION_OFF};
use crate::lanes::{nearest_whole, whole_below};
use crate::report::Configuration;

/// How closely the slot of a solution must match that of a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Closeness {
    /// The same slot, or axis 5 is zero to rounding.
    Same,
    /// The same slot after an elbow that is straight to rounding is bent.
    Bent,
    /// Either of two slots that meet at a singularity, or within the edge.
    Met,
}

/// The axes whose quarter turns a configuration counts, from 0.
const COUNTED: [usize; 3] = [0, 3, 5];

/// The other axes.
const UNCOUNTED: [usize; 3] = [1, 2, 4];

/// Largest number of quarter turns of an angle within [`MOST_ANGLE`].
#[expect(clippy::cast_possible_truncation, reason = "some ten thousands")]
const MOST_QUARTERS: i32 = (MOST_ANGLE / FRAC_PI_2) as i32;

impl Configuration {
    /// The configuration of a joint vector, with the number of its slot.
    fn of(q: &[f64; 6], cfx: i32) -> Self {
        let [cf1, cf4, cf6] = COUNTED.map(|joint| quarter(q[joint]));
        Self { cf1, cf4, cf6, cfx }
    }

    /// Check that the arm can have a configuration with these numbers.
    pub(crate) fn check(&self, coupled: bool) -> Result<(), Error> {
        let quarters = [-MOST_QUARTERS, MOST_QUARTERS];
        let slots = if coupled { [0, 0] } else { [0, 7] };
        for (field, value, bounds) in [
            ("cf1", self.cf1, quarters),
            ("cf4", self.cf4, quarters),
            ("cf6", self.cf6, quarters),
            ("cfx", self.cfx, slots),
        ] {
            if value < bounds[0] || value > bounds[1] {
                return Err(JointFault::Configuration { field, value, bounds }.into());
            }
        }
        Ok(())
    }

    /// The ranges [rad] that it permits for axes 1, 4 and 6, widened by `edge` [rad].
    fn ranges(&self, edge: f64) -> [(usize, [f64; 2]); 3] {
        let quarters = [self.cf1, self.cf4, self.cf6].map(f64::from);
        core::array::from_fn(|i| {
            (COUNTED[i], [quarters[i] * FRAC_PI_2 - edge, (quarters[i] + 1.0) * FRAC_PI_2 + edge])
        })
    }
}

/// The quarter turn of an angle: its floor. An angle that differs from an edge only by the rounding
/// of degrees to radians counts as that edge.
#[expect(clippy::cast_possible_truncation, reason = "no more than MOST_QUARTERS")]
fn quarter(angle: f64) -> i32 {
    let quarters = angle / FRAC_PI_2;
    let edge = nearest_whole(quarters);
    if (quarters - edge).abs() <= 2.0 * f64::EPSILON * edge.abs() {
        edge as i32
    } else {
        whole_below(quarters) as i32
    }
}

/// The slot of a joint vector; a spherical wrist always has one.
fn slot_of(arm: &SphericalWrist, q: &[f64; 6]) -> Slot {
    arm.slot(q).unwrap_or(Slot::new(0))
}

impl Robot<6> {
    /// ABB's confdata of a joint vector [rad]. On the edge of a quarter turn, it is that of the one
    /// which begins there.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] when an angle is not finite or exceeds [`MOST_ANGLE`],
    /// [`Error::InvalidModel`] for an arm without a spherical wrist, whose controller uses other
    /// numbers.
    pub fn configuration(&self, q: &[f64; 6]) -> Result<Configuration, Error> {
        let arm = self.counted()?;
        check_seed("q", q)?;
        Ok(self.configuration_of(arm, q))
    }

    fn configuration_of(&self, arm: &SphericalWrist, q: &[f64; 6]) -> Configuration {
        let cfx = if self.is_coupled() { 0 } else { slot_of(arm, q).number() };
        Configuration::of(q, cfx)
    }

    /// The solution inside the limits that has the configuration `wanted`, which also selects the 2
    /// pi equivalents of axes 1, 4 and 6.
    ///
    /// An angle within [`CONFIGURATION_EDGE`] of the edge of a quarter turn matches either side of
    /// it; axis 5 near zero and a straight elbow match either slot. A joint that the pose leaves
    /// undetermined takes the side that the configuration names. For an arm with coupled axes the
    /// branches in front of the lower arm are tried first.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; [`Error::NoConfiguration`], which lists the configurations that
    /// exist; [`Error::InvalidJoints`] for a `cfx` that the arm does not have;
    /// [`Error::InvalidModel`] as [`Robot::configuration`].
    pub fn ik_configured(&self, pose: &Pose, wanted: Configuration) -> Result<Solution<6>, Error> {
        self.ik_configured_checked(checked_pose(pose)?, wanted)
    }

    /// [`Robot::ik_configured`] or, if no solution has that configuration, the solution nearest to
    /// `seed` [rad].
    ///
    /// Many programs contain `[0, 0, 0, 0]` without having computed it.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_configured`] and [`Robot::ik_nearest`]; never [`Error::NoConfiguration`].
    pub fn ik_configured_or_nearest(
        &self,
        pose: &Pose,
        wanted: Configuration,
        seed: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        check_seed("seed", seed)?;
        self.ik_configured_or_nearest_checked(checked_pose(pose)?, wanted, seed)
    }

    /// [`Robot::ik_configured_or_nearest`] with arguments that are already checked.
    pub(crate) fn ik_configured_or_nearest_checked(
        &self,
        pose: Pose,
        wanted: Configuration,
        seed: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        match self.ik_configured_checked(pose, wanted) {
            Err(Error::NoConfiguration(_)) => self.nearest_checked(pose, seed, &[1.0; 6]),
            answer => answer,
        }
    }

    /// [`Robot::ik_configured`] with a pose that is already checked.
    pub(crate) fn ik_configured_checked(
        &self,
        pose: Pose,
        wanted: Configuration,
    ) -> Result<Solution<6>, Error> {
        let arm = self.counted()?;
        wanted.check(self.is_coupled())?;
        let mut solutions = self.unsolved(pose);
        let found = if self.solve_in_lanes(&mut solutions, ()) {
            self.configured_regular(arm, &solutions, wanted)
        } else {
            self.solve_at_rest(&mut solutions, ())?;
            self.configured_singular(arm, &solutions, wanted)?
        };
        if let Some(found) = found {
            return Ok(found);
        }
        Err(self.no_configuration(arm, &solutions, wanted)?)
    }

    /// The solution of a regular pose that has the configuration, at some 2 pi equivalent.
    fn configured_regular(
        &self,
        arm: &SphericalWrist,
        solutions: &Solutions<6>,
        wanted: Configuration,
    ) -> Option<Solution<6>> {
        for edge in [0.0, CONFIGURATION_EDGE] {
            let Some(limits) = self.limits().narrowed(&wanted.ranges(edge)) else { continue };
            for closeness in [Closeness::Same, Closeness::Met] {
                let mut candidates = solutions.clone();
                candidates.limits = limits;
                for place in candidates.places_mut() {
                    let has_slot = |solution: &Solution<6>| {
                        self.has_slot(arm, solution, solution.slot, wanted, edge, closeness)
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
        arm: &SphericalWrist,
        solutions: &Solutions<6>,
        wanted: Configuration,
    ) -> Result<Option<Solution<6>>, Error> {
        for allowed in [meets(solutions.pose()), SOLUTION_OFF] {
            for edge in [0.0, CONFIGURATION_EDGE] {
                let Some(limits) = self.limits().narrowed(&wanted.ranges(edge)) else { continue };
                for closeness in [Closeness::Same, Closeness::Bent, Closeness::Met] {
                    let accepts = &|solution: &Solution<6>| {
                        let slot = slot_of(arm, &solution.q);
                        self.has_slot(arm, solution, slot, wanted, edge, closeness)
                    };
                    let (seed, weights) = (&limits.rest(), &[1.0; 6]);
                    let asked = Wanted { limits, seed, weights, accepts };
                    let found = self.nearest_within(solutions, &asked, allowed)?;
                    let Some((_, found)) = found else { continue };
                    let found = self.on_side(arm, solutions, found, wanted);
                    let same = self.configuration_of(arm, &found.q).cfx == wanted.cfx;
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
        arm: &SphericalWrist,
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
        let Some(near) = arm.singular_distances(&solution.q) else { return false };
        let singularities = arm.singularities(&solution.q);
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
        arm: &SphericalWrist,
        solutions: &Solutions<6>,
        solution: Solution<6>,
        wanted: Configuration,
    ) -> Solution<6> {
        let moved_onto_pose = |start: [f64; 6], kept: usize| {
            let limits = self.limits();
            let (q, off) = self.corrected(solutions.pose(), start, limits, &[kept], DAMPED);
            (off <= meets(solutions.pose()) && limits.contains(&q)).then_some(q)
        };
        let mut q = solution.q;
        if self.is_coupled() || slot_of(arm, &q).number() == wanted.cfx {
            return solution;
        }
        if (slot_of(arm, &q).number() ^ wanted.cfx) & 2 != 0
            && arm.singularities(&q).contains(SingularityKind::ELBOW)
        {
            let bent = arm.with_bent_elbow(&q, wanted.cfx & 2 != 0);
            q = moved_onto_pose(bent, 2).unwrap_or(q);
        }
        if (slot_of(arm, &q).number() ^ wanted.cfx) & 1 != 0 {
            let sides = [1.0, -1.0].map(|side| arm.with_straight_wrist(&q, side));
            let there = |q: &[f64; 6]| (slot_of(arm, q).number() ^ wanted.cfx) & 1 == 0;
            q = sides.into_iter().filter(there).find_map(|q| moved_onto_pose(q, 4)).unwrap_or(q);
        }
        if slot_of(arm, &q).number() == wanted.cfx { Solution { q, ..solution } } else { solution }
    }

    /// The reason why no solution has a configuration: the configurations that exist, or that no
    /// solution is inside the limits.
    fn no_configuration(
        &self,
        arm: &SphericalWrist,
        solutions: &Solutions<6>,
        wanted: Configuration,
    ) -> Result<Error, Error> {
        let mut none = NoConfiguration {
            wanted,
            existing: Vec::new(),
            more: false,
            free: solutions.iter().find_map(|found| found.free_joint),
        };
        for solution in solutions {
            self.list_turns(arm, solutions.limits(), solution, &mut none);
        }
        if none.existing.is_empty() {
            // Another member of a self-motion than its representative may be inside.
            let Some(inside) = self.nearest_of(solutions, &self.limits().rest(), &[1.0; 6])? else {
                return Ok(Error::Unreachable(solutions.explain()));
            };
            self.list_turns(arm, solutions.limits(), &inside, &mut none);
        }
        Ok(Error::NoConfiguration(none))
    }

    /// Add the configurations of a solution's 2 pi equivalents inside the limits, each once, while
    /// there is room.
    fn list_turns(
        &self,
        arm: &SphericalWrist,
        limits: &JointLimits<6>,
        solution: &Solution<6>,
        none: &mut NoConfiguration,
    ) {
        let Some(q) = limits.wrapped_near(&solution.q, &solution.q) else { return };
        // 2 pi equivalents of the other axes have the same configurations.
        let Some(limits) = limits.narrowed(&UNCOUNTED.map(|joint| (joint, [q[joint]; 2]))) else {
            return;
        };
        for turn in Turns::of(&limits, &Solution { q, ..*solution }) {
            let configuration = self.configuration_of(arm, &turn.q);
            if none.existing.contains(&configuration) {
                continue;
            }
            if none.existing.len() == NoConfiguration::MOST {
                none.more = true;
                return;
            }
            none.existing.push(configuration);
        }
    }

    /// The geometry whose branches a configuration distinguishes.
    pub(crate) fn counted(&self) -> Result<&SphericalWrist, Error> {
        self.spherical_wrist()
            .ok_or_else(|| ModelFault::NoConfiguration { structure: self.structure() }.into())
    }
}
