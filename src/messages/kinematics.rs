//! Messages of poses, joints, models, answers and paths.

use std::string::String;
use std::vec;
use std::vec::Vec;

use super::{Row, Table, rows};
use crate::error::{CalibratedFault, Error, JointFault, ModelFault, NoConfiguration, PoseFault};
use crate::kinematics::thresholds::{
    MOST_ANGLE, MOST_EULER, MOST_LENGTH, MOST_REACH, MOST_SNAP, MOST_TOOL, QUATERNION_NORM_BOUND,
    ROTATION_REPAIR_BOUND,
};
use crate::kinematics::{Break, BreakReason, Mdh, Robot, SingularityKind};
use crate::report::{Approach, Condition, Configuration, Explanation, FreeJoint, Reach, Relation};

pub(super) fn tables() -> Vec<Table> {
    vec![
        Table { name: "poses", rows: poses() },
        Table { name: "joints", rows: joints() },
        Table { name: "models", rows: models() },
        Table { name: "structures", rows: structures() },
        Table { name: "answers", rows: answers() },
        Table { name: "paths", rows: paths() },
        Table { name: "others", rows: others() },
    ]
}

fn poses() -> Vec<Row> {
    rows! { PoseFault;
        PoseFault::NotFinite { .. } => PoseFault::NotFinite { row: 0, column: 1, value: f64::NAN },
            "NaN or inf in a 4x4 matrix", "leave the pose out; in a batch its row is INVALID";
        PoseFault::TooFar { field: "pose", .. } =>
            PoseFault::TooFar { field: "pose", index: 0, value: 2e6, bound: MOST_LENGTH },
            "a translation too large to keep its digits", "meters are wanted; move the base nearer";
        PoseFault::TooFar { .. } =>
            PoseFault::TooFar { field: "xyz", index: 2, value: 2e6, bound: MOST_LENGTH },
            "the same of `irbkin.pose`", "as above";
        PoseFault::LastRow { transposed: true, .. } =>
            PoseFault::LastRow { row: [0.857, 0.241, 1.113, 1.0], transposed: true },
            "a matrix whose columns are rows, as of column-major programs", "pass `T.T`";
        PoseFault::LastRow { .. } =>
            PoseFault::LastRow { row: [0.5, 0.0, 0.0, 1.0], transposed: false },
            "a matrix that is no rigid transform, or a projective one",
            "look where its last row is made";
        PoseFault::NotOrthonormal { .. } =>
            PoseFault::NotOrthonormal { deviation: 3.0, bound: ROTATION_REPAIR_BOUND },
            "a scaled or sheared rotation, or one written with four digits",
            "normalize the rotation; write six digits or more";
        PoseFault::Mirrored { .. } => PoseFault::Mirrored { determinant: -1.0 },
            "a left-handed frame", "negate the axis that was negated";
        PoseFault::QuaternionNorm { .. } =>
            PoseFault::QuaternionNorm { norm: 5.477_226, bound: QUATERNION_NORM_BOUND, order: "w, x, y, z" },
            "a quaternion that is not of length 1",
            "normalize it; look at the order of its elements";
        PoseFault::EulerAngle { .. } =>
            PoseFault::EulerAngle { index: 0, value: 90.0, bound: MOST_EULER },
            "Euler angles in degrees", "pass `np.radians(angles)`; remove whole turns";
        PoseFault::ToolTooLong { .. } =>
            PoseFault::ToolTooLong { length: 110.0, bound: MOST_TOOL },
            "a tool in millimeters", "divide its translation by 1000";
        PoseFault::FieldNotFinite { .. } =>
            PoseFault::FieldNotFinite { field: "xyz", index: 1, value: f64::NAN },
            "NaN or inf in `xyz`, a quaternion or Euler angles", "leave the pose out";
    }
}

fn joints() -> Vec<Row> {
    rows! { JointFault;
        JointFault::NotFinite { .. } =>
            JointFault::NotFinite { field: "q", joint: 3, value: f64::NAN },
            "NaN or inf in a joint vector", "leave the vector out; in a batch its row is NaN";
        JointFault::TooLarge { .. } =>
            JointFault::TooLarge { field: "seed", joint: 4, value: -1e15, bound: MOST_ANGLE },
            "an angle of so many turns that its digits are lost",
            "remove whole turns: `np.arctan2(np.sin(q), np.cos(q))`";
        JointFault::NotOfPose { .. } => JointFault::NotOfPose { off: 1e-3, bound: 1e-6 },
            "`with_free_joint` of a solution of another pose or robot",
            "pass the pose that the solution is of";
        JointFault::Zone { .. } => JointFault::Zone { value: -1.0 },
            "`follow(zone=)`", "give a bound of abs(sin q5), such as 0.0175";
        JointFault::Configuration { bounds: [0, 0], .. } =>
            JointFault::Configuration { field: "cfx", value: 3, bounds: [0, 0] },
            "cfx of a coupled robot, whose controller does not use it", "write 0";
        JointFault::Configuration { .. } =>
            JointFault::Configuration { field: "cfx", value: 9, bounds: [0, 7] },
            "a number that no configuration has", "write one of the range";
        JointFault::NoJoint { .. } => JointFault::NoJoint { joint: 8, dof: 7 },
            "`given={8: 0.2}`", "count joints from 1";
        JointFault::MissingArmAngle => JointFault::MissingArmAngle,
            "`ik_configured` of a YuMi, a robtarget whose eax_a is 9E9", "give `arm_angle`";
        JointFault::ArmAngle { .. } => JointFault::ArmAngle { value: f64::NAN, bound: MOST_ANGLE },
            "NaN or inf in `arm_angle`, or many turns", "leave the row out, or remove whole turns";
        JointFault::Weight { .. } => JointFault::Weight { joint: 6, value: -2.0 },
            "`weights`", "give costs of moving each joint, 0 or more";
    }
}

fn models() -> Vec<Row> {
    rows! { ModelFault;
        ModelFault::NotFinite { index: 0, .. } =>
            ModelFault::NotFinite { field: "a1", index: 0, value: f64::NAN },
            "NaN or inf in a parameter", "give a number";
        ModelFault::NotFinite { .. } =>
            ModelFault::NotFinite { field: "alpha of row", index: 3, value: f64::NAN },
            "NaN or inf in a table", "give a number";
        ModelFault::TooShort { .. } =>
            ModelFault::TooShort { field: "upper arm c2", value: 0.0, bound: 1e-6 },
            "a link without length", "look at the order of the parameters";
        ModelFault::TooLarge { index: 0, .. } =>
            ModelFault::TooLarge { field: "c2", index: 0, value: 1e100, bound: MOST_LENGTH },
            "a number too large to keep its digits", "meters and radians are wanted";
        ModelFault::TooLarge { .. } =>
            ModelFault::TooLarge { field: "a of row", index: 2, value: 1e100, bound: MOST_LENGTH },
            "the same of a table, or of a limit", "for no limit give inf";
        ModelFault::Degrees { .. } =>
            ModelFault::Degrees { field: "alpha of row", index: 2, value: 90.0 },
            "angles of a table, or `offsets`, in degrees", "pass `np.radians(angles)`";
        ModelFault::TooFar { .. } =>
            ModelFault::TooFar { axis: 1, distance: 1632.0, bound: MOST_REACH },
            "lengths in millimeters", "divide the lengths by 1000";
        ModelFault::LimitsInDegrees { .. } =>
            ModelFault::LimitsInDegrees { joint: 1, lower: -180.0, upper: 180.0, bound: 50.0 },
            "limits in degrees", "pass `np.radians(limits)`; for no limit give inf";
        ModelFault::NoLimit { .. } => ModelFault::NoLimit {
            field: "upper limit of joint", index: 5, value: f64::NAN, none: f64::INFINITY,
        },
            "NaN in limits", "give the limit, or inf for none";
        ModelFault::NoLimit { .. } => ModelFault::NoLimit {
            field: "lower limit of joint", index: 5, value: f64::INFINITY,
            none: f64::NEG_INFINITY,
        },
            "inf on the wrong side", "give -inf below, inf above";
        ModelFault::Snap { .. } => ModelFault::Snap { value: 0.1, bound: MOST_SNAP },
            "`snap=`", "give 1e-5 for angles with four decimals";
        ModelFault::Sign { .. } => ModelFault::Sign { joint: 6, value: 0.5 },
            "`from_opw(signs=)`", "give 1 or -1";
        ModelFault::EmptyLimit { .. } =>
            ModelFault::EmptyLimit { joint: 3, lower: 1.2, upper: -0.5 },
            "a lower limit above the upper one", "swap them";
        ModelFault::EmptyLinkageLimit { .. } =>
            ModelFault::EmptyLinkageLimit { lower: 0.5, upper: -0.5 },
            "the same of `linkage_limits`", "swap them";
        ModelFault::NoLinkage => ModelFault::NoLinkage,
            "`with_linkage_limits` of a robot without a linkage", "take its `coupled()` twin";
        ModelFault::NotCoupled { .. } =>
            ModelFault::NotCoupled { reason: "they turn in opposite senses" },
            "`coupled()`", "give axes 2 and 3 the same sign";
        ModelFault::Velocity { .. } => ModelFault::Velocity { joint: 2, value: -1.0 },
            "a velocity limit", "give a positive one";
        ModelFault::JointCount { .. } => ModelFault::JointCount { found: 7, wanted: 6 },
            "`Robot<6>` of an arm of seven joints", "take `Robot<7>`";
        ModelFault::UnknownStructure(_) => ModelFault::UnknownStructure(dependent()),
            "six joints that are not independent; `ik` of seven whose first six are not",
            "change the table; seven joints have `fk` and `jacobian` all the same, six in Rust by \
             `Robot::serial_chain`";
        ModelFault::NoConfiguration { .. } =>
            ModelFault::NoConfiguration { structure: "three parallel axes" },
            "`configuration`, `ik_configured`", "take `slot` of a solution";
        ModelFault::NoArmAngle => ModelFault::NoArmAngle,
            "`arm_angle` of another arm than a YuMi", "give the angle of a joint: `given`";
        ModelFault::NoSphericalWrist => ModelFault::NoSphericalWrist,
            "`follow(singularity_mode=)` \"wrist\" or \"lock_axis4\"",
            "take \"through\" or \"error\"";
        ModelFault::AxisDirection { .. } => ModelFault::AxisDirection { axis: 2 },
            "`JointAxis`", "give a direction";
        ModelFault::NearlyParallel { snap: Some(_), .. } => ModelFault::NearlyParallel {
            axes: (2, 3), off: 4.6e-8, distance: 1.5e7, bound: MOST_LENGTH, snap: Some(1e-7),
        },
            "right angles with few digits in a URDF", "write all digits, or give `snap`";
        ModelFault::NearlyParallel { .. } => ModelFault::NearlyParallel {
            axes: (1, 2), off: 1e-8, distance: 2e7, bound: MOST_LENGTH, snap: None,
        },
            "the same where no `snap` helps", "write all digits";
        ModelFault::LeftNearlyParallel { .. } => ModelFault::LeftNearlyParallel {
            joint: 4, angle: 1.570_796_336_794_897, axes: (3, 5), off: 1e-8, bound: 8.1e-8,
        },
            "`given`", "give the angle that makes them parallel, or one farther from it";
        ModelFault::Calibrated(CalibratedFault::Coupled) =>
            ModelFault::Calibrated(CalibratedFault::Coupled),
            "`with_corrections`, `calibrate` or `with_nominal` of a robot with a linkage",
            "take its `uncoupled()` twin";
        ModelFault::Calibrated(CalibratedFault::Structure { .. }) =>
            ModelFault::Calibrated(CalibratedFault::Structure { structure: "offset wrist" }),
            "`with_nominal`", "give the arm of the data sheet";
        ModelFault::Calibrated(CalibratedFault::Far { .. }) =>
            ModelFault::Calibrated(CalibratedFault::Far {
                position: 0.7, rotation: 0.3, bound: [0.1, 0.05],
            }),
            "`with_nominal` of another arm", "give the arm that was calibrated";
        ModelFault::Urdf(_) => ModelFault::Urdf(crate::error::UrdfFault::NotUtf8 { byte: 13 }),
            "`from_urdf`", "see [URDF](#urdf)";
    }
}

fn table_of(name: &str, change: impl FnOnce(&mut Mdh<6>)) -> Mdh<6> {
    let mut table = Robot::<6>::named(name).unwrap().mdh().clone();
    change(&mut table);
    table
}

/// What keeps the arm of a table from a closed form.
fn missing(table: Mdh<6>) -> crate::UnknownStructure {
    match Robot::from_mdh(table) {
        Ok(robot) => robot.missing_form().unwrap(),
        Err(Error::InvalidModel(ModelFault::UnknownStructure(reason))) => reason,
        other => panic!("{other:?}"),
    }
}

fn dependent() -> crate::UnknownStructure {
    let table = table_of("IRB 2600-12/1.65", |table| table.rows[4].alpha = 0.0);
    match Robot::from_mdh(table) {
        Err(Error::InvalidModel(ModelFault::UnknownStructure(reason))) => reason,
        other => panic!("{other:?}"),
    }
}

/// Conditions by themselves, and what else a refusal says.
fn structures() -> Vec<Row> {
    let mut all = rows! { Condition;
        Condition { relation: Relation::Perpendicular, .. } =>
            Condition { relation: Relation::Perpendicular, axes: (1, 2), off: 0.4646 },
            "an alpha that is no right angle", "write `np.pi / 2`; look at the order of columns";
        Condition { relation: Relation::Parallel, .. } =>
            Condition { relation: Relation::Parallel, axes: (2, 3), off: 1e-3 },
            "an alpha that is not 0", "look at the order of columns";
        Condition { relation: Relation::Meeting, .. } =>
            Condition { relation: Relation::Meeting, axes: (4, 5), off: 0.07 },
            "a wrist with an offset, as of GoFa", "nothing: it is solved by a polynomial";
        Condition { relation: Relation::Coplanar, .. } =>
            Condition { relation: Relation::Coplanar, axes: (3, 5), off: 0.01 },
            "a seven-axis arm with another elbow", "nothing: it is solved by a polynomial";
    };
    let few_digits = missing(table_of("UR5e", |table| {
        for row in &mut table.rows {
            row.alpha = (row.alpha * 1e4).round() / 1e4;
        }
    }));
    all.push(Row {
        message: std::format!("...{}", tail(&few_digits)),
        trigger: "1.5708 for pi/2",
        remedy: "write all digits, or give this `snap`",
    });
    let standard = crate::Sdh::from(Robot::<6>::named("UR5e").unwrap().mdh().clone());
    let identity = crate::Pose::identity();
    let swapped = missing(Mdh { base: identity, rows: standard.rows, flange: identity });
    all.push(Row {
        message: std::format!("...{}", tail(&swapped)),
        trigger: "standard rows given to `from_mdh`, columns in another order",
        remedy: "do what it says",
    });
    all
}

/// What a refusal says after its conditions.
fn tail(reason: &crate::UnknownStructure) -> String {
    let words = std::string::ToString::to_string(reason);
    let at = words.find(" (write").or_else(|| words.find("; as ")).unwrap();
    words[at..].into()
}

fn answers() -> Vec<Row> {
    let mut all = rows! { Explanation;
        Explanation::Found { solutions: 1, .. } => Explanation::Found { solutions: 1, inside: 1 },
            "a pose with one solution", "-";
        Explanation::Found { .. } => Explanation::Found { solutions: 8, inside: 4 },
            "a pose with solutions", "-";
        Explanation::OutsideLimits { .. } => Explanation::OutsideLimits {
            solutions: 4, joint: 5, excess: 3.1_f64.to_radians(),
        },
            "limits", "move the pose, or widen the limits where the robot's are wider";
        Explanation::OutsideLinkage { .. } => Explanation::OutsideLinkage {
            solutions: 2, excess: 3.1_f64.to_radians(),
        },
            "limits of the parallelogram linkage", "as above";
        Explanation::OutOfReach(Reach::TooNear { .. }) =>
            Explanation::OutOfReach(Reach::TooNear { shortfall: 0.012 }),
            "a pose inside the folded arm", "move it away by so much";
        Explanation::OutOfReach(_) =>
            Explanation::OutOfReach(Reach::TooFar { shortfall: 0.012 }),
            "a pose beyond the stretched arm", "move it nearer by so much; look at the tool";
        Explanation::OutOfReach(_) =>
            Explanation::OutOfReach(Reach::TooFar { shortfall: 1423.4115 }),
            "a pose in millimeters", "divide its translation by 1000";
        Explanation::NoRoots { certified: true, .. } => Explanation::NoRoots {
                certified: true,
                approach: Some(Approach { position: 0.012, rotation: 0.02 }),
            },
            "a pose out of reach of an arm without a closed form", "move the pose";
        Explanation::NoRoots { .. } =>
            Explanation::NoRoots { certified: false, approach: None },
            "the same next to a singularity, or over all angles of joint 7",
            "move the pose, next to a singularity by 1e-6 m";
        Explanation::FreeOutOfReach { .. } =>
            Explanation::FreeOutOfReach { joint: 6, value: 1.0 },
            "`with_free_joint`", "choose another angle";
        Explanation::NoArmAngle { .. } => Explanation::NoArmAngle { arm_angle: 1.8 },
            "a target of a YuMi", "take another arm angle: `ik_nearest` finds one";
        Explanation::FilteredOut => Explanation::FilteredOut,
            "`filter`", "look at the condition";
    };
    all.extend(rows! { Error;
        Error::NoConfiguration(_) => Error::NoConfiguration(NoConfiguration {
            wanted: Configuration { cf1: 0, cf4: 0, cf6: 0, cfx: 0 },
            existing: vec![
                Configuration { cf1: 0, cf4: -1, cf6: 0, cfx: 1 },
                Configuration { cf1: -2, cf4: 0, cf6: 0, cfx: 4 },
            ],
            more: false,
            free: Some(FreeJoint::WristSum),
        }),
            "confdata that no solution inside the limits has",
            "take one that exists, or `fallback=\"nearest\"`";
        _ => Error::Unreachable(Explanation::OutOfReach(Reach::TooFar { shortfall: 0.012 })),
            "`ik_nearest`, `nearest` without a solution inside the limits", "as above";
    });
    all
}

fn paths() -> Vec<Row> {
    let at = |reason| Break { pose_index: 50, reason };
    let jump = |kinds| at(BreakReason::Jump { joint: 4, by: -3.487, kinds });
    rows! { Break;
        Break { reason: BreakReason::Unreachable(_), .. } => at(BreakReason::Unreachable(
            Explanation::OutOfReach(Reach::TooFar { shortfall: 0.012 }),
        )),
            "a pose that is not reached", "its row is NaN; the next pose starts afresh";
        Break { reason: BreakReason::Jump { .. }, .. } => jump(SingularityKind::WRIST),
            "a path through the wrist singularity", "`singularity_mode=\"wrist\"`, or slow down";
        Break { reason: BreakReason::Jump { .. }, .. } => jump(SingularityKind::SHOULDER),
            "a path over axis 1", "go around it";
        Break { reason: BreakReason::Jump { .. }, .. } => jump(SingularityKind::ELBOW),
            "a path to the edge of reach and back", "start on the other elbow";
        Break { reason: BreakReason::Jump { .. }, .. } => jump(SingularityKind::empty()),
            "a limit on the way", "start with another turn or branch";
        Break { reason: BreakReason::Locked, .. } => at(BreakReason::Locked),
            "modes \"wrist\" and \"lock_axis4\"", "take \"through\"";
        Break { reason: BreakReason::Stopped { .. }, .. } => at(BreakReason::Stopped { q5: 0.017 }),
            "mode \"error\"", "take another mode";
    }
}

fn others() -> Vec<Row> {
    rows! { Error;
        Error::InvalidPose(_) =>
            PoseFault::Mirrored { determinant: -1.0 }.into(), "see [poses](#poses)", "";
        Error::InvalidJoints(_) =>
            JointFault::Weight { joint: 1, value: -1.0 }.into(), "see [joints](#joints)", "";
        Error::InvalidModel(_) => ModelFault::NoLinkage.into(), "see [models](#models)", "";
        Error::InvalidMotion(_) => crate::error::MotionFault::Repeats { index: 3 }.into(),
            "see [trajectories](#trajectories)", "";
        Error::InvalidPlan(_) => crate::error::PlanFault::NoPoses.into(),
            "see [plans](#plans)", "";
        Error::UnknownRobot(_) => Robot::<6>::named("IRB 2600-12/1.66").unwrap_err(),
            "a name that is not in the catalog", "take one that is close, or `irbkin.catalog()`";
        Error::Unreachable(_) => Error::Unreachable(Explanation::FilteredOut),
            "see [answers](#answers)", "";
        Error::NoConfiguration(_) => Error::NoConfiguration(NoConfiguration {
            wanted: Configuration::default(), existing: Vec::new(), more: true, free: None,
        }), "see [answers](#answers)", "";
        Error::NoInstructionSet { .. } => Error::NoInstructionSet { name: "avx512" },
            "`InstructionSet::force`", "take one that is available";
        Error::WrongLength { .. } =>
            Error::WrongLength { field: "poses", found: 20, wanted: 32 },
            "slices of `irbkin::batch`", "give whole rows";
        Error::Rapid(_) => crate::error::RapidFault {
            line: 1, column: 12, kind: crate::error::RapidFaultKind::SecondModule,
        }.into(), "see [RAPID](#rapid)", "";
        Error::Frame(_) => crate::error::FrameFault::Held { both: true }.into(),
            "see [RAPID](#rapid)", "";
    }
}
