//! Records that answers are returned in.

use pyo3::basic::CompareOp;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyTuple, PyType};

use super::figure::Figure;
use super::record::{self, record, record_methods};
use irbkin::follow::BreakReason;
use irbkin::{Explanation, Reach, SingularityKind, Status};

/// An array, or what a field holds in place of one.
pub(crate) type Array = Py<PyAny>;

/// ABB's confdata `[cf1, cf4, cf6, cfx]`: quarter turns of axes 1, 4 and 6, and the branch of the
/// arm.
///
/// A quarter turn's number is `floor(angle / 90 deg)`. `cfx` is 4 (wrist center behind axis 1) + 2
/// (behind the lower arm) + 1 (q5 < 0). Arms of other structures count as their
/// [`ConfigurationRule`] says.
#[pyclass(module = "irbkin", frozen, get_all, sequence, from_py_object)]
#[derive(Clone, Copy)]
pub(crate) struct Configuration {
    /// Quarter turn of axis 1.
    pub(crate) cf1: i32,
    /// Quarter turn of axis 4.
    pub(crate) cf4: i32,
    /// Quarter turn of axis 6.
    pub(crate) cf6: i32,
    /// The branch of an arm that bends backwards; zero for one with coupled axes 2 and 3.
    pub(crate) cfx: i32,
}

impl From<irbkin::Configuration> for Configuration {
    fn from(configuration: irbkin::Configuration) -> Self {
        let irbkin::Configuration { cf1, cf4, cf6, cfx } = configuration;
        Self { cf1, cf4, cf6, cfx }
    }
}

record_methods!(Configuration { cf1: i32, cf4: i32, cf6: i32, cfx: i32 });

record! {
    "irbkin.records";
    /// Solutions of many poses.
    IkBatch {
        /// Joint angles [rad], shape (..., slots, n), NaN where a slot is empty.
        q: Array,
        /// `Status` of each slot, shape (..., slots).
        status: Array,
    }

    /// The joint that a singular pose leaves undetermined.
    FreeJoint {
        /// Its number, from 1.
        joint: usize,
        /// Joints that stay fixed along the self-motion: "q4 + q6", "q4 - q6", "q2, q3", "q1, q3"
        /// or, with coupled axes 2 and 3, "q1, q3 - q2" or "q1, q3 + q2"; "q1, q5" of three
        /// parallel axes; "q1 + q3", "q1 - q3", "q4, q6" or "q4, q5" of seven axes. Of an arm
        /// without a closed form the joints that stand still, or "nothing".
        fixed: String,
    }

    /// A place where the joints cannot follow a path without a jump.
    Break {
        /// Index of the pose that is not met, or at which the joints arrive by a jump.
        pose_index: usize,
        /// Where and why, in a sentence.
        reason: String,
        /// Index of the path among several; empty for one.
        path: Py<PyTuple>,
        /// The cause, a `BreakReason`.
        kind: Py<PyAny>,
    }

    /// A joint path along a path of poses.
    FollowResult {
        /// Joint angles [rad], shape (..., m, n), NaN where a pose is not met.
        q: Array,
        /// Angle between the orientations of tool and pose [rad], shape (..., m), NaN
        /// where a pose is not met.
        orientation_error: Array,
        /// Each `Break`: where the joints cannot follow, and why.
        breaks: Py<PyTuple>,
    }

    /// ABB's confdata of many joint vectors: int32 arrays of shape (...).
    ConfigurationBatch {
        /// Quarter turns of axis 1: floor(q1 / 90 deg).
        cf1: Array,
        /// Quarter turns of axis 4.
        cf4: Array,
        /// Quarter turns of axis 6.
        cf6: Array,
        /// The slots, as `Configuration.cfx`.
        cfx: Array,
    }

    /// Distances of joint vectors from the singularities: numbers for one, arrays of shape (...)
    /// for many. NaN where an arm has no such singularity.
    Singularity {
        /// Angle of joint 5 from 0 or 180 deg [rad]; of seven axes, between the plane of axes 5 and
        /// 6 and the line to the shoulder.
        wrist: Array,
        /// Angle between upper arm and forearm from stretched or folded [rad].
        elbow: Array,
        /// Distance of the wrist center from axis 1 [m]; with a lateral offset, from the plane
        /// through it along axis 2; of seven axes, distance of the upper arm's end from axis 1.
        shoulder: Array,
        /// Smallest singular value of the Jacobian at the tool, its rows in m and rad as they are.
        min_singular_value: Figure,
        /// sqrt(det(J J^T)), the product of the singular values.
        manipulability: Figure,
        /// The singularities that the joint vector is at, those at which branches merge, a
        /// `SingularityKind`; for many its values, uint8. Empty beside them, however near; `near`
        /// has a zone.
        kinds: Array,
    }

    /// The nearest two of links and obstacles.
    CellDistance {
        /// How far they are apart [m], shape (...); less than zero if they touch, infinite if there
        /// is nothing to compare.
        distance: Array,
        /// The names of each two, one after the other: "link 3", "table".
        pair: Py<PyTuple>,
        /// The nearest points of the two in the world [m], shape (..., 2, 3).
        points: Array,
        /// How the distance changes with each joint [m/rad], shape (..., n); NaN if that is not
        /// known: where the points are one, and of the axis of a capsule inside a solid.
        gradient: Array,
    }

    /// Where a motion first touches something.
    CellContact {
        /// When: the index of the row before it, plus the part of the way to the next row that is
        /// behind; of a trajectory the time [s].
        at: f64,
        /// The joint angles there [rad], shape (n,).
        q: Array,
        /// The names of the two that touch: "link 3", "table".
        pair: (String, String),
        /// How deep the two get into each other, or into the margin, until they are apart [m]: of
        /// 16 postures to the next row or knot and one at each that follows.
        depth: f64,
    }

    /// How far joint vectors are from limits and singularities, each as a part of the farthest that
    /// they can be: 1 in the middle, 0 at one, negative outside limits.
    Margin {
        /// The least over all joints of 1 - |q - middle| / half the range, shape (...).
        limits: Array,
        /// The least of three distances, each at most 1, shape (...): from the wrist and from the
        /// elbow singularity as a part of 90 deg, from the shoulder singularity as a part of half
        /// the length of upper arm and forearm. Of six joints of another structure the distance in
        /// joint space to first order, as a part of 90 deg. NaN of other arms.
        singularities: Array,
    }

    /// How much room the solutions of poses leave.
    IkMargin {
        /// The largest margin (the smaller part of `Margin`) of the solutions inside the limits,
        /// each with the full turns that leave the most room, shape (...). NaN without an answer.
        margin: Array,
        /// Their largest `Margin.singularities`, shape (...). NaN without an answer.
        singularities: Array,
        /// Their number, shape (...).
        solutions: Array,
    }

    /// Whether a pose can be reached.
    PoseCheck {
        /// Some joint vector brings the tool there.
        reachable: bool,
        /// One of them is inside the joint limits.
        within_limits: bool,
        /// The outcome in a sentence.
        reason: String,
    }

    /// Data of an arm in the catalog.
    CatalogEntry {
        /// The maker's type name.
        name: String,
        /// The maker: "ABB", "Universal Robots", "Franka", "FANUC" or "UFACTORY".
        maker: String,
        /// Other names that `Robot` takes for it, beside spellings in which case, blanks and dashes
        /// differ.
        aliases: Py<PyTuple>,
        /// Number of joints.
        dof: usize,
        /// Payload [kg], as the type name or the data sheet gives it; of several generations the
        /// least. None where it is not known.
        payload: Option<f64>,
        /// Reach [m], as the type name or the data sheet gives it: rounded, of ABB's arms to the
        /// wrist center. None where it is not known.
        reach: Option<f64>,
        /// Lower and upper limit of each joint [rad], shape (n, 2).
        limits: Array,
        /// Largest velocity of each joint [rad/s], shape (n,), or None where no source has it.
        max_velocity: Option<Array>,
        /// Largest acceleration of each joint [rad/s^2], shape (n,), or None where no source has
        /// it.
        max_acceleration: Option<Array>,
        /// Whether a parallelogram linkage couples axes 2 and 3.
        is_coupled: bool,
        /// Number of independent sources of the lengths: the confidence in them.
        sources: usize,
        /// These sources; after semicolons, of other figures, what disagrees, what is not modeled.
        provenance: String,
    }

    /// The state of the joints at times.
    TrajectorySample {
        /// Joint angles [rad], shape (..., n).
        q: Array,
        /// Joint velocities [rad/s], shape (..., n).
        dq: Array,
        /// Joint accelerations [rad/s^2], shape (..., n).
        ddq: Array,
    }

    /// The largest sizes of each joint's derivatives.
    MotionPeaks {
        /// Velocities [rad/s], shape (n,).
        velocity: Array,
        /// Accelerations [rad/s^2], shape (n,).
        acceleration: Array,
        /// Jerks [rad/s^3], shape (n,).
        jerk: Array,
    }

    /// The constant speed of the tool along a path that the limits of the joints allow.
    ToolSpeedLimits {
        /// The highest at each sample [m/s], shape (m,); infinite where no limit binds.
        speed: Array,
        /// The joint that limits it, from 1, shape (m,); 0 where none does.
        joint: Array,
        /// The fastest constant speed on the whole path [m/s], between the samples too.
        fastest: f64,
        /// The joint that limits the fastest speed, from 1; 0 where none does.
        fastest_joint: usize,
        /// The sample at which it does, or the last one before the place.
        fastest_index: usize,
    }

    /// A part of a path that the joints cannot follow.
    PlanBreak {
        /// The last pose before it; None where the path begins with it.
        leave: Option<usize>,
        /// The first pose after it; None where the path ends with it.
        enter: Option<usize>,
    }

    /// Where and why a branch of a path ends.
    StrandEnd {
        /// Its slot.
        slot: usize,
        /// The first pose that it does not reach.
        pose_index: usize,
        /// The reason in a sentence.
        reason: String,
    }

    /// The best joint path along a path of poses.
    Plan {
        /// Joint angles [rad], shape (m, n); NaN where a plan with breaks has none.
        q: Array,
        /// The angle by which the tool is turned at each pose [rad], shape (m,), without jumps of a
        /// full turn; zeros without a free rotation.
        tool_angle: Array,
        /// The slot of the branch at each pose, shape (m,); -1 without a branch.
        slot: Array,
        /// Values of the external axes of `carrier` at each pose [m, rad], shape (m, k); NaN where
        /// a plan with breaks has none.
        external: Array,
        /// Deviation within `tolerance` at each pose, shape (m, t): the tilts about the two axes
        /// that the tool does not point in [rad]; t is 0 without a cone.
        tolerance: Array,
        /// Weighted sum of the squares of all joint steps, with the costs of being near limits and
        /// singularities [rad^2].
        cost: f64,
        /// The largest velocity of a joint as a part of its limit. Without `times`, the time [s]
        /// that the path takes at least if its poses are equally far apart in time.
        bottleneck: f64,
        /// Each `PlanBreak`: empty, but for the plan of a `PathError`.
        breaks: Py<PyTuple>,
        /// Whether every step, apart from breaks, was shown to be continuous between its two poses.
        certified: bool,
        /// Pose of the tool at each pose of the path, `robot.fk(plan.q)`, shape (m, 4, 4),
        /// translation [m]: with all that `rotation` and `tolerance` add to the path, and with
        /// external axes as the arm sees it, its base where the robot has it. NaN where `q` is.
        T: Array,
    }
}

/// `irbkin.SingularityKind` of singularities, each made once: that takes longer than to find them.
pub(super) fn kinds(py: Python<'_>, kinds: SingularityKind) -> PyResult<Bound<'_, PyAny>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    static MEMBERS: [PyOnceLock<Py<PyAny>>; 256] = [const { PyOnceLock::new() }; 256];
    let bits = kinds.bits();
    let made = || {
        let class = CLASS.import(py, "irbkin.records", "SingularityKind")?;
        Ok::<_, PyErr>(class.call1((bits,))?.unbind())
    };
    Ok(MEMBERS[usize::from(bits)].get_or_try_init(py, made)?.bind(py).clone())
}

pub(super) fn status(py: Python<'_>, status: Status) -> PyResult<Bound<'_, PyAny>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    CLASS.import(py, "irbkin.records", "Status")?.call1((status.bits(),))
}

/// `irbkin.Reach` without its shortfall.
pub(super) fn reach(py: Python<'_>, reach: Reach) -> PyResult<Bound<'_, PyAny>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    CLASS.import(py, "irbkin.records", "Reach")?.getattr(match reach {
        Reach::Reached => "REACHED",
        Reach::TooFar { .. } => "TOO_FAR",
        Reach::TooNear { .. } => "TOO_NEAR",
        Reach::NoRoots => "NO_ROOTS",
        Reach::Turned { .. } => "TURNED",
    })
}

pub(super) fn break_reason<'py>(
    py: Python<'py>,
    reason: &BreakReason,
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    CLASS.import(py, "irbkin.records", "BreakReason")?.getattr(match reason {
        BreakReason::Unreachable(_) => "UNREACHABLE",
        BreakReason::Jump { .. } => "JUMP",
        BreakReason::Locked => "LOCKED",
        BreakReason::Stopped { .. } => "STOPPED",
    })
}

impl From<&Explanation> for PoseCheck {
    fn from(explanation: &Explanation) -> Self {
        let within_limits = matches!(explanation, Explanation::Found { .. });
        let reachable = within_limits
            || matches!(
                explanation,
                Explanation::OutsideLimits { .. } | Explanation::OutsideLinkage { .. }
            );
        Self { reachable, within_limits, reason: explanation.to_string() }
    }
}
