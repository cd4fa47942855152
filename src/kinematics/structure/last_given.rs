//! Any arm of seven joints, with the angle of the last one given: the six others are an arm of
//! their own, of whatever structure they have.
//!
//! ```text
//! T_base_6(q1 .. q6) = T_base_7 (Rx(alpha7) Tx(a7) Rz(theta7 + q7) Tz(d7))^-1
//! ```
//!
//! The last joint only moves the pose that the six must reach, so nothing is prepared for its
//! angle.

use nalgebra::{Rotation3, Vector3};

use super::any::{AnyStructure, SixJoints};
use super::branches::Branches;
use super::free_choice::{FreeChoice, SeedPolicy};
use super::joint_map::JointMap;
use super::lanes::NoKernel;
use super::{Structure, TakeStep};
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::{MOST_SLOTS, Slot};
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::{SingularityKind, Status};
use crate::kinematics::chain::dh::{DhRow, Mdh, screw_x};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, translation_z};
use crate::report::{Pattern, UnknownStructure};

/// No conditions: the six joints have their own.
static PATTERN: Pattern =
    Pattern { name: "general", title: "six joints before the last", conditions: &[] };

/// The first six joints as an arm, and the last link.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LastGiven {
    six: SixJoints,
    last: DhRow,
    joint_map: JointMap<7>,
    /// How far the table is from a structure with a closed form.
    nearest: Option<UnknownStructure>,
}

impl LastGiven {
    /// The pose of frame 6 for that of frame 7 with joint 7 at `q7`.
    fn before_last(&self, t_base_7: &Pose, q7: f64) -> Pose {
        let DhRow { alpha, a, d, theta } = self.last;
        let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), theta + q7);
        t_base_7 * (screw_x(alpha, a) * turned * translation_z(d)).inverse()
    }
}

fn first_six(q: &[f64; 7]) -> [f64; 6] {
    core::array::from_fn(|joint| q[joint])
}

impl Structure<7, MOST_SLOTS> for LastGiven {
    const PATTERN: &'static Pattern = &PATTERN;
    const IS_CLOSED_FORM: bool = false;
    const SLOT_NAMES: Option<&'static [&'static str; MOST_SLOTS]> = None;

    type Redundancy = f64;
    // The six joints are solved in lanes where their structure has them.
    type Kernel = NoKernel<f64>;

    fn measure(mdh: &mut Mdh<7>) -> Result<Self, UnknownStructure> {
        let [rows @ .., last] = mdh.rows;
        let identity = Pose::identity();
        let (_, six) = SixJoints::recognize(&Mdh { base: identity, rows, flange: identity });
        if let Some(reason) = six.arm().unknown() {
            return Err(reason);
        }
        let joint_map = JointMap {
            signs: [1.0; 7],
            offsets: [0.0; 7],
            coupled: false,
            t_base_shoulder: mdh.base,
            t_wrist_flange: mdh.flange,
        };
        Ok(Self { six, last, joint_map, nearest: None })
    }

    fn joint_map(&self) -> &JointMap<7> {
        &self.joint_map
    }

    fn between(self, base: &Pose, tool: &Pose, coupled: bool) -> Self {
        let _ = (base, tool, coupled);
        self
    }

    fn noting(self, nearest: Option<UnknownStructure>) -> Self {
        Self { nearest, ..self }
    }

    fn nearest(&self) -> Option<UnknownStructure> {
        self.nearest
    }

    fn kernel(&self) -> Option<NoKernel<f64>> {
        None
    }

    fn solve(&self, t_base_7: &Pose, q7: f64, free: &FreeChoice<7>) -> Branches<7, MOST_SLOTS> {
        let pose = self.before_last(t_base_7, q7);
        let mut solutions =
            Solutions::none(self.six.slot_count(), pose, JointLimits::<6>::UNLIMITED);
        let free = FreeChoice { q: first_six(&free.q), policy: free.policy };
        let is_regular = matches!(free.policy, SeedPolicy::Pose | SeedPolicy::Seed)
            && self.six.solve_in_lanes(&mut solutions, ());
        if !is_regular {
            // A known structure solves every pose.
            let _ = self.six.arm().solve(&mut solutions, (), &free);
        }
        let mut branches = Branches::empty(solutions.reach());
        branches.is_certified = solutions.is_certified();
        for (slot, status) in solutions.status().iter().enumerate() {
            branches.flags[slot] = *status - Status::FOUND - Status::WITHIN_LIMITS;
        }
        for solution in &solutions {
            let slot = solution.slot.index();
            let [q1, q2, q3, q4, q5, q6] = solution.q;
            branches.q[slot] = Some([q1, q2, q3, q4, q5, q6, q7]);
            branches.free[slot] = solution.free_joint;
        }
        branches
    }

    fn singular_distances(&self, q: &[f64; 7]) -> Option<SingularDistances> {
        self.six.arm().singular_distances(&first_six(q))
    }

    fn singularities(&self, q: &[f64; 7]) -> SingularityKind {
        let singular = self.six.arm().singular(&first_six(q));
        singular.map_or(SingularityKind::empty(), |(_, singularities)| singularities)
    }

    fn jacobian_determinant(&self, q: &[f64; 7]) -> f64 {
        self.six.arm().jacobian_determinant(&first_six(q)).unwrap_or(f64::NAN)
    }

    fn slot(&self, q: &[f64; 7]) -> Option<Slot> {
        self.six.arm().slot(&first_six(q))
    }

    fn member(&self, t: &Pose, q: &[f64; 7], joint: usize, value: f64) -> Option<[f64; 7]> {
        let pose = self.before_last(t, q[6]);
        let [q1, q2, q3, q4, q5, q6] = self.six.arm().member(&pose, &first_six(q), joint, value)?;
        Some([q1, q2, q3, q4, q5, q6, q[6]])
    }

    fn walk(&self, t: &Pose, q: &[f64; 7], pass: &mut TakeStep<'_, 7>) {
        let seven = |[q1, q2, q3, q4, q5, q6]: [f64; 6]| [q1, q2, q3, q4, q5, q6, q[6]];
        let pose = self.before_last(t, q[6]);
        let pass = &mut |start: &[f64; 6], end: &[f64; 6]| pass(&seven(*start), &seven(*end));
        self.six.arm().walk(&pose, &first_six(q), pass);
    }
}
