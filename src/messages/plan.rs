//! Messages of plans.

use core::f64::consts::{PI, TAU};

use super::{Row, Table, rows};
use crate::error::{PlanFault, PoseFault};
use crate::kinematics::SingularityKind;
use crate::plan::{StrandEnd, StrandReason};
use crate::report::{Explanation, Reach};

pub(super) fn tables() -> [Table; 2] {
    [Table { name: "plan", rows: faults() }, Table { name: "strands", rows: ends() }]
}

fn faults() -> std::vec::Vec<Row> {
    rows! { PlanFault;
        PlanFault::NoPoses => PlanFault::NoPoses, "an empty path", "give a pose";
        PlanFault::Pose { .. } =>
            PlanFault::Pose { index: 7, fault: PoseFault::Mirrored { determinant: -1.0 } },
            "a pose of the path; in Python an `InvalidPoseError`", "leave it out, or repair it";
        PlanFault::Time { .. } => PlanFault::Time { index: 3, value: 0.2, before: 0.2 },
            "`times`", "give times that increase";
        PlanFault::RotationSteps { .. } =>
            PlanFault::RotationSteps { found: 0, bounds: [2, 3600] },
            "`steps` of a tool rotation", "give a count between";
        PlanFault::RotationRange { .. } =>
            PlanFault::RotationRange { lower: -180.0, upper: 180.0 },
            "`lower` and `upper` of a tool rotation", "give radians, lower <= upper";
        PlanFault::EndOff { .. } =>
            PlanFault::EndOff { field: "start", position: 0.02, rotation: 0.1, bound: 1e-6 },
            "`start`, `end`; in Python an `InvalidJointsError`",
            "take a solution of that pose, or begin the path where the arm is";
        PlanFault::EndAngle { .. } =>
            PlanFault::EndAngle { field: "start", angle: 1.0, bounds: [-0.5, 0.5] },
            "`start`, `end`", "widen the tool rotation";
        PlanFault::EndExternal { .. } =>
            PlanFault::EndExternal { field: "start", found: 0, wanted: 1 },
            "`start`, `end` with a carrier",
            "append a value for each axis to the joint angles";
        PlanFault::EndValue { .. } =>
            PlanFault::EndValue { field: "start", index: 0, value: 2.5, bounds: [-1.0, 1.0] },
            "`start`, `end` with a carrier or a tolerance", "give one inside";
        PlanFault::AxisRange { .. } =>
            PlanFault::AxisRange { field: "track", lower: 1.0, upper: -1.0, most: 1000.0 },
            "`lower` and `upper` of an axis", "give meters or radians, lower < upper";
        PlanFault::AxisSteps { .. } =>
            PlanFault::AxisSteps { field: "track", found: 1, bounds: [2, 1001] },
            "`steps` of an axis", "give a count between, an odd one of a cone";
        PlanFault::AxisVector { .. } =>
            PlanFault::AxisVector { field: "track", index: 0, value: 0.0 },
            "`axis` or `point` of an external axis", "give three finite numbers, not all 0";
        PlanFault::AxisVelocity { .. } => PlanFault::AxisVelocity { value: 0.0 },
            "`max_velocity` of an external axis", "give a positive number";
        PlanFault::AxisWeight { .. } => PlanFault::AxisWeight { value: -1.0 },
            "`weight` of an external axis", "give 0 or more";
        PlanFault::Cost { .. } => PlanFault::Cost { field: "limit_cost", value: -1.0 },
            "`limit_cost`, `singularity_cost` of a plan", "give 0 or more";
        PlanFault::ConeAngle { .. } => PlanFault::ConeAngle { angle: 15.0, most: PI / 2.0 },
            "`angle` of a tool cone", "give radians";
        PlanFault::External { .. } => PlanFault::External { found: 4, most: 3 },
            "`carrier`", "leave axes out, or plan for some values of them";
        PlanFault::Nodes { .. } => PlanFault::Nodes { found: 1 << 29, most: 1 << 28 },
            "a long path with many values of axes", "take fewer steps: they are refined";
        PlanFault::EndOutside { .. } =>
            PlanFault::EndOutside { field: "end", joint: 5, value: 2.5, bounds: [-2.0, 2.0] },
            "`start`, `end`; in Python an `InvalidJointsError`", "give one inside";
        PlanFault::Open { .. } =>
            PlanFault::Open { position: 0.01, rotation: 0.0, bound: 1e-6 },
            "`closed`", "append the first pose, or leave it out";
        PlanFault::ClosedEnd => PlanFault::ClosedEnd, "`closed` with `end`", "give `start` only";
        PlanFault::Turns { .. } => PlanFault::Turns { found: TAU * 1000.0, most: 4096 },
            "joints with many turns that all matter", "narrow the limits with `with_limits`";
    }
}

fn ends() -> std::vec::Vec<Row> {
    let at = |reason| StrandEnd { slot: 2, pose_index: 57, reason };
    rows! { StrandEnd;
        StrandEnd { reason: StrandReason::Unreachable(_), .. } => at(StrandReason::Unreachable(
            Explanation::OutOfReach(Reach::TooFar { shortfall: 0.012 }),
        )), "a pose out of reach", "move it, or the base";
        StrandEnd { reason: StrandReason::Limit { .. }, .. } => at(StrandReason::Limit {
            joint: 6, value: TAU + 1.0, bounds: [-TAU, TAU],
        }), "a limit, turns regarded", "free the tool rotation, or begin at another turn";
        StrandEnd { reason: StrandReason::Speed { .. }, .. } =>
            at(StrandReason::Speed { joint: 4, ratio: 1.31 }),
            "`times` too close", "give more time";
        StrandEnd { reason: StrandReason::AxisSpeed { .. }, .. } =>
            at(StrandReason::AxisSpeed { axis: 1, ratio: 1.31 }),
            "`times` too close for a `carrier`", "give more time, or a faster axis";
        StrandEnd { reason: StrandReason::Jump { .. }, .. } => at(StrandReason::Jump {
            joint: 4, by: 3.1, kinds: SingularityKind::WRIST,
        }), "a singularity, or a way out of reach between two poses",
            "free the tool rotation, or turn the tool a little";
        StrandEnd { reason: StrandReason::Ended, .. } => at(StrandReason::Ended),
            "the edge of reach, a singularity", "as above";
        StrandEnd { reason: StrandReason::Rejected, .. } => at(StrandReason::Rejected),
            "`accept`", "";
        StrandEnd { reason: StrandReason::NotAtEnd, .. } => at(StrandReason::NotAtEnd),
            "`end`, `closed`", "give another one, or leave it out";
    }
}
