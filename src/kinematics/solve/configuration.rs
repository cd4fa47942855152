//! ABB's confdata: which of the solutions of a pose, and which turn of it.

use core::f64::consts::FRAC_PI_2;

use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::{Error, JointFault, ModelFault, NoConfiguration};
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::answer::select::Turns;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::nearest::Inverse as _;
use crate::kinematics::structure::Structure as _;
use crate::kinematics::structure::spherical_wrist::SphericalWrist;
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, MOST_ANGLE};
use crate::report::Configuration;

/// Slots of the arms that have configurations.
const SLOTS: usize = 8;

/// The axes that a configuration counts quarter turns of, from 0.
const COUNTED: [usize; 3] = [0, 3, 5];

/// The others.
const UNCOUNTED: [usize; 3] = [1, 2, 4];

/// Most quarter turns that an angle can have that is not too large to calculate with.
#[expect(clippy::cast_possible_truncation, reason = "some ten thousands")]
const MOST_QUARTERS: i32 = (MOST_ANGLE / FRAC_PI_2) as i32;

impl Configuration {
    /// Of a joint vector, with the number of its slot.
    fn of(q: &[f64; 6], cfx: i32) -> Self {
        let [cf1, cf4, cf6] = COUNTED.map(|joint| quarter(q[joint]));
        Self { cf1, cf4, cf6, cfx }
    }

    /// Numbers that a configuration of the arm can have.
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

    /// The ranges [rad] that it leaves axes 1, 4 and 6, widened by `edge` [rad].
    fn ranges(&self, edge: f64) -> [(usize, [f64; 2]); 3] {
        let quarters = [self.cf1, self.cf4, self.cf6].map(f64::from);
        core::array::from_fn(|i| {
            (COUNTED[i], [quarters[i] * FRAC_PI_2 - edge, (quarters[i] + 1.0) * FRAC_PI_2 + edge])
        })
    }
}

/// The number of an angle's quarter turn: its floor, an angle that is an edge but for the rounding of degrees to radians being one.
#[expect(clippy::cast_possible_truncation, reason = "no more than MOST_QUARTERS")]
fn quarter(angle: f64) -> i32 {
    let quarters = angle / FRAC_PI_2;
    let edge = quarters.round();
    if (quarters - edge).abs() <= 2.0 * f64::EPSILON * edge.abs() {
        edge as i32
    } else {
        quarters.floor() as i32
    }
}

impl Robot<6> {
    /// ABB's confdata of a joint vector [rad]: on the edge of a quarter turn, that of the one which begins there.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] when an angle is not finite or exceeds [`MOST_ANGLE`], [`Error::InvalidModel`] for an arm without a spherical wrist, whose
    /// controller counts otherwise.
    pub fn configuration(&self, q: &[f64; 6]) -> Result<Configuration, Error> {
        let arm = self.counted()?;
        check_seed("q", q)?;
        Ok(self.configuration_of(arm, q))
    }

    fn configuration_of(&self, arm: &SphericalWrist, q: &[f64; 6]) -> Configuration {
        let slot = arm.slot(q).filter(|_| !self.is_coupled());
        Configuration::of(q, slot.map_or(0, Slot::number))
    }

    /// The solution inside the limits that has the configuration `wanted`, which chooses the turns of axes 1, 4 and 6, too.
    ///
    /// An angle within [`CONFIGURATION_EDGE`] of the edge of a quarter turn is taken for either side of it, and axis 5 next to zero or a
    /// straight elbow for either slot. Where the pose leaves a joint free, it takes the configuration's side. Of an arm with coupled axes the
    /// branches in front of the lower arm are looked at first.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; [`Error::NoConfiguration`], which lists those that exist; [`Error::InvalidJoints`] for a `cfx` that the arm
    /// does not have; [`Error::InvalidModel`] as [`Robot::configuration`].
    pub fn ik_configured(&self, pose: &Pose, wanted: Configuration) -> Result<Solution<6>, Error> {
        self.ik_configured_checked(checked_pose(pose)?, wanted)
    }

    /// [`Robot::ik_configured`] or, where no solution has that configuration, the one nearest to `seed` [rad].
    ///
    /// Many programs write `[0, 0, 0, 0]` without having calculated it.
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

    /// [`Robot::ik_configured_or_nearest`] for arguments that were checked where they came in.
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

    /// [`Robot::ik_configured`] for a pose that was checked.
    pub(crate) fn ik_configured_checked(
        &self,
        pose: Pose,
        wanted: Configuration,
    ) -> Result<Solution<6>, Error> {
        let arm = self.counted()?;
        wanted.check(self.is_coupled())?;
        let solutions = self.ik_checked(pose, ())?;
        for edge in [0.0, CONFIGURATION_EDGE] {
            let Some(limits) = self.limits().narrowed(&wanted.ranges(edge)) else { continue };
            for candidates in self.candidates(arm, &solutions, wanted, edge) {
                if let Some(found) = self.configured(&solutions, candidates, limits)? {
                    return Ok(found);
                }
            }
        }
        Err(self.no_configuration(arm, &solutions, wanted)?)
    }

    /// The slots of which a solution may have the configuration, those to be looked at first before others.
    fn candidates(
        &self,
        arm: &SphericalWrist,
        solutions: &Solutions<6>,
        wanted: Configuration,
        edge: f64,
    ) -> [[bool; SLOTS]; 2] {
        if self.is_coupled() {
            return [
                core::array::from_fn(|slot| slot & 2 == 0),
                core::array::from_fn(|slot| slot & 2 != 0),
            ];
        }
        let cfx = usize::try_from(wanted.cfx).unwrap_or(0);
        let merged = solutions.status()[cfx];
        let merged = if merged.contains(Status::MERGED) { merged } else { Status::empty() };
        let may_be = |slot: usize| {
            let Some(solution) = solutions.slot(slot) else { return false };
            let distances = arm.singular_distances(&solution.q);
            let open = [
                (Status::WRIST, 1, distances.wrist <= edge),
                (Status::ELBOW, 2, distances.elbow <= edge),
                (Status::SHOULDER, 4, false),
            ];
            let open = open
                .iter()
                .filter(|(kind, _, near)| *near || merged.contains(*kind))
                .map(|(_, bit, _)| bit)
                .sum::<usize>();
            (slot ^ cfx) & !open == 0
        };
        let (exact, others): ([bool; SLOTS], [bool; SLOTS]) = (
            core::array::from_fn(|slot| slot == cfx),
            core::array::from_fn(|slot| slot != cfx && may_be(slot)),
        );
        [exact, others]
    }

    /// The solution in one of the slots that is inside `limits`, at some turn or with another angle of a free joint.
    fn configured(
        &self,
        solutions: &Solutions<6>,
        slots: [bool; SLOTS],
        limits: JointLimits<6>,
    ) -> Result<Option<Solution<6>>, Error> {
        let mut within = solutions.clone();
        within.limits = limits;
        for (place, taken) in within.places_mut().iter_mut().zip(slots) {
            if !taken {
                *place = Place::Empty;
            }
        }
        if within.is_empty() {
            return Ok(None);
        }
        self.nearest_of(&within, &limits.rest(), &[1.0; 6])
    }

    /// Why no solution has a configuration: which others there are, or that no solution is inside the limits.
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
            free: solutions.iter().find_map(|found| found.free),
        };
        for solution in solutions {
            self.list_turns(arm, solutions.limits(), solution, &mut none);
        }
        if none.existing.is_empty() {
            // Of a family, another one than that which stands for it may be inside.
            let Some(inside) = self.nearest_of(solutions, &self.limits().rest(), &[1.0; 6])? else {
                return Ok(Error::Unreachable(solutions.explain()));
            };
            self.list_turns(arm, solutions.limits(), &inside, &mut none);
        }
        Ok(Error::NoConfiguration(none))
    }

    /// Adds the configurations of a solution's turns inside the limits, each once, as long as there is room.
    fn list_turns(
        &self,
        arm: &SphericalWrist,
        limits: &JointLimits<6>,
        solution: &Solution<6>,
        none: &mut NoConfiguration,
    ) {
        let Some(q) = limits.turned_to(&solution.q, &solution.q) else { return };
        // Turns of the other axes have the same configurations.
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

    /// The geometry whose branches a configuration tells apart.
    pub(crate) fn counted(&self) -> Result<&SphericalWrist, Error> {
        self.spherical_wrist()
            .ok_or_else(|| ModelFault::NoConfiguration { family: self.family() }.into())
    }
}
