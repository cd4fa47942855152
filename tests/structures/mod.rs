//! The test subjects: arms of every structure with a closed form, with the independent knowledge of
//! their tests.
//!
//! A new structure is one line of `on_every_structure` and one folder here that implements [`Arm`];
//! laws, hard sets, recall and lanes then run on it. One whose slots are ordinals is its tables and
//! one line of `on_structures_of_ordinals`: laws, recall and lanes run on it, as far as they ask
//! for nothing but the table.

pub mod by_table;
pub mod general;
pub mod offset_wrist;
pub mod place;
pub mod spherical_shoulder;
pub mod spherical_wrist;
pub mod three_parallel;

use std::fmt::Debug;
use std::num::NonZeroUsize;
use std::rc::Rc;

use irbkin::batch::Batch;
use irbkin::{Error, JacobianFrame, Pose, Robot, Solution, Solutions};
use proptest::strategy::BoxedStrategy;

use crate::common::Rng;
use place::{At, Made, Place, Posture, Verdict};

/// Makes a test of each law for each structure: `laws::spherical_wrist::every_solution_closes`.
///
/// A law is a generic function of a [`Structure`].
macro_rules! on_every_structure {
    ($($(#[$attribute:meta])? $law:ident),* $(,)?) => {
        $crate::structures::on_a_structure!(spherical_wrist, 6: $($(#[$attribute])? $law),*);
        $crate::structures::on_a_structure!(three_parallel, 6: $($(#[$attribute])? $law),*);
        $crate::structures::on_a_structure!(spherical_shoulder, 7: $($(#[$attribute])? $law),*);
    };
}

/// Makes a test of each law for each structure whose slots are ordinals.
macro_rules! on_structures_of_ordinals {
    ($($(#[$attribute:meta])? $law:ident),* $(,)?) => {
        $crate::structures::on_a_structure!(offset_wrist, 6: $($(#[$attribute])? $law),*);
        $crate::structures::on_a_structure!(general, 6: $($(#[$attribute])? $law),*);
    };
}

/// Makes a test of each law for one structure.
macro_rules! on_a_structure {
    ($structure:ident, $joints:literal: $($(#[$attribute:meta])? $law:ident),*) => {
        mod $structure {
            $(
                #[test]
                $(#[$attribute])?
                fn $law() {
                    super::$law::<$joints>(&$crate::structures::$structure::structure());
                }
            )*
        }
    };
}

pub(crate) use {on_a_structure, on_every_structure, on_structures_of_ordinals};

/// What the tests know of a structure.
pub struct Structure<const N: usize> {
    /// The value of `Robot::structure`.
    pub name: &'static str,
    /// Arms of makers and unusual ones.
    pub subjects: Vec<Subject<N>>,
    /// An arm whose joints are zero many turns away, for the lanes.
    pub many_turns: Subject<N>,
    /// Arms with random lengths, signs, offsets and, where the table has them, ends.
    pub random: BoxedStrategy<Subject<N>>,
}

/// The mathematics of an arm that the tests know independently, from its lengths alone.
pub trait Arm<const N: usize>: Debug {
    /// The robot, without limits.
    fn robot(&self) -> Robot<N>;

    /// The lengths that its accuracy is relative to: the reach of its flange [m].
    fn reach(&self) -> f64;

    /// Angles of the derivation.
    fn theta(&self, q: &[f64; N]) -> [f64; N];

    /// Joint angles of angles of the derivation.
    fn q(&self, theta: [f64; N]) -> [f64; N];

    /// The slot of angles of the derivation.
    fn slot(&self, theta: &[f64; N]) -> usize;

    /// The determinant of the Jacobian of joints 1 to 6, by the factors that the structure has.
    fn determinant(&self, robot: &Robot<N>, q: &[f64; N]) -> f64;

    /// What is incorrect between two solutions whose slots differ in the wrist alone.
    fn wrist_flip(&self, slots: [&Solution<N>; 2]) -> Result<(), String>;

    /// Whether the bits of a slot follow from the angles of the derivation: not if a link has no
    /// length and its axis points either way, nor if slots are ordinals.
    fn has_slots(&self) -> bool {
        true
    }

    /// Bounds of a residual: roundings of the lengths and of a rotation [m, rad].
    fn closure(&self, reach: f64) -> [f64; 2] {
        [3e-15 * (1.0 + reach), 1e-14]
    }

    /// The residual of a singular pose, relative to the reach.
    fn singular_residual(&self) -> f64 {
        3e-15
    }

    /// The residual of a pose that is out of reach by less than the tolerance, relative to that
    /// distance.
    fn spread(&self) -> f64 {
        1.0
    }

    /// How far a solution of a slot that is just beyond reach may be off the pose, in addition to
    /// rounding: [m], [rad].
    fn beyond_in(&self, _robot: &Robot<N>, _made: &Made<N>, _solution: &Solution<N>) -> [f64; 2] {
        [0.0; 2]
    }

    /// Where the arm can be singular.
    fn singular_places(&self) -> &'static [At];

    /// Angles of the derivation at a place; `None` if this arm cannot get there.
    fn at(&self, place: &Place, rng: &mut Rng) -> Option<[f64; N]>;

    /// Singular postures that no place draws.
    fn postures(&self) -> Vec<Posture<N>> {
        Vec::new()
    }

    /// A pose that is out of reach by so much, and out of reach of all other branches by more.
    fn beyond(&self, beyond: f64, rng: &mut Rng) -> Option<Made<N>>;

    /// Judges the answer to a pose of a hard set. Residuals are already judged.
    fn judge(
        &self,
        robot: &Robot<N>,
        made: &Made<N>,
        solutions: &Solutions<N>,
        rng: &mut Rng,
    ) -> Verdict;
}

/// What differs by the number of joints: how to call the solver, with joint 7 as in a joint vector.
pub struct Calls<const N: usize> {
    pub ik: fn(&Robot<N>, &Pose, &[f64; N]) -> Result<Solutions<N>, Error>,
    /// Rows of poses, of the joint vectors that made them, of answers and of their status; threads.
    pub ik_rows: RowCall<N>,
}

type RowCall<const N: usize> =
    fn(&Robot<N>, &[f64], &[[f64; N]], &mut [f64], &mut [u8], usize) -> Result<(), Error>;

pub const SIX: Calls<6> = Calls {
    ik: |robot, pose, _| robot.ik(pose),
    ik_rows: |robot, rows, _, q, status, threads| {
        Batch::new(NonZeroUsize::new(threads)).ik(robot, rows, q, status)
    },
};

pub const SEVEN: Calls<7> = Calls {
    ik: |robot, pose, q| robot.ik(pose, q[6]),
    ik_rows: |robot, rows, joints, q, status, threads| {
        let q7: Vec<f64> = joints.iter().map(|q| q[6]).collect();
        Batch::new(NonZeroUsize::new(threads)).ik_with(robot, rows, &q7, q, status)
    },
};

/// An arm with a robot, which may have limits, base and tool.
#[derive(Clone)]
pub struct Subject<const N: usize> {
    pub name: String,
    pub arm: Rc<dyn Arm<N>>,
    pub robot: Robot<N>,
    pub calls: &'static Calls<N>,
}

impl<const N: usize> Debug for Subject<N> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}: {:?}", self.name, self.arm)
    }
}

impl<const N: usize> Subject<N> {
    pub fn new(name: &str, arm: impl Arm<N> + 'static, calls: &'static Calls<N>) -> Self {
        Self { name: name.to_owned(), robot: arm.robot(), arm: Rc::new(arm), calls }
    }

    pub fn with_robot(self, change: impl FnOnce(Robot<N>) -> Robot<N>) -> Self {
        Self { robot: change(self.robot), ..self }
    }

    pub fn named(self, name: &str) -> Self {
        Self { name: name.to_owned(), ..self }
    }

    pub fn ik(&self, pose: &Pose, q: &[f64; N]) -> Solutions<N> {
        (self.calls.ik)(&self.robot, pose, q).unwrap()
    }

    /// The lengths that accuracy is relative to, including base and tool [m].
    pub fn reach(&self) -> f64 {
        let ends = [self.robot.base(), self.robot.tool()];
        self.arm.reach() + ends.map(|end| end.translation.vector.norm()).iter().sum::<f64>()
    }

    /// Bounds of a residual [m, rad].
    pub fn closure(&self) -> [f64; 2] {
        self.arm.closure(self.reach())
    }

    /// Whether slots are ordinals, without names.
    pub fn has_ordinals(&self) -> bool {
        self.robot.slot_names().is_none()
    }

    /// The slot of a joint vector.
    pub fn slot(&self, q: &[f64; N]) -> usize {
        self.arm.slot(&self.arm.theta(q))
    }

    /// The least distance of a joint vector from a singularity [rad, m]; the least singular value
    /// of an arm whose singularities have no distances [m/rad, 1].
    pub fn clearance(&self, q: &[f64; N]) -> f64 {
        match self.robot.singularity(q).distances {
            Some(distances) => distances.wrist.min(distances.elbow).min(distances.shoulder),
            None => self.least_singular_value(q),
        }
    }

    /// Whether a joint vector is so far from singularities that its slot and its branches are those
    /// of its neighbors.
    pub fn is_regular(&self, q: &[f64; N]) -> bool {
        // A singular value is a distance times what it changes.
        self.clearance(q) > if self.has_ordinals() { 0.02 } else { 0.05 }
    }

    /// How far rounding of the pose moves the joints that are solved for: 40 roundings over the
    /// least singular value [rad].
    pub fn joint_bound(&self, q: &[f64; N]) -> f64 {
        40.0 * f64::EPSILON * (1.0 + self.reach()) / self.least_singular_value(q)
    }

    /// Of the Jacobian of joints 1 to 6.
    pub fn least_singular_value(&self, q: &[f64; N]) -> f64 {
        let jacobian = self.robot.jacobian(q, JacobianFrame::Base);
        jacobian.fixed_columns::<6>(0).into_owned().singular_values()[5]
    }
}
