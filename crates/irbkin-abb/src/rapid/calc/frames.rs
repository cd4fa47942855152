//! The flange pose for a tool pose in a work object: the frames of tooldata and wobjdata.

use super::units::Units;
use crate::Error;
use crate::rapid::data::records::{RapidPose, ToolData, WobjData};
use crate::rapid::text::fault::FrameFault;
use irbkin::pose::{from_wxyz as pose_from_wxyz, to_wxyz as pose_to_wxyz};
use irbkin::{Error as RobotError, Pose, Robot};

/// A tool and a work object, one of which the robot carries while the other is fixed in the world.
/// The default is the flange in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::rapid) struct Frames {
    pub(in crate::rapid) t_flange_carried: Pose,
    t_world_fixed: Pose,
    /// Whether the tool is fixed: the robot carries the work object.
    is_stationary: bool,
}

impl Frames {
    /// The frames of a tool, by default the robot's own, and a work object, by default the world.
    pub(in crate::rapid) fn new<const N: usize>(
        robot: &Robot<N>,
        tool: Option<&ToolData>,
        wobj: Option<&WobjData>,
    ) -> Result<Self, Error> {
        Self::at(robot, tool, wobj, (&Units::default(), &[0.0; 6]))
    }

    /// The frames where the external axes of units have values [deg or mm].
    pub(in crate::rapid) fn at<const N: usize>(
        robot: &Robot<N>,
        tool: Option<&ToolData>,
        wobj: Option<&WobjData>,
        (units, extax): (&Units, &[f64; 6]),
    ) -> Result<Self, Error> {
        let tool_carried = tool.is_none_or(|tool| tool.robhold);
        let wobj_carried = wobj.is_some_and(|wobj| wobj.robhold);
        if tool_carried == wobj_carried {
            return Err(FrameFault::Held { both: tool_carried }.into());
        }
        let t_tool = match tool {
            Some(tool) => pose_in(&tool.tframe, "tframe")?,
            None => *robot.tool(),
        };
        let t_wobj = match wobj {
            Some(wobj) => {
                let own = pose_in(&wobj.uframe, "uframe")? * pose_in(&wobj.oframe, "oframe")?;
                if wobj.ufprog { own } else { units.moved(&wobj.ufmec, extax)? * own }
            }
            None => Pose::identity(),
        };
        // The robot is left where it is, the world is displaced.
        let t_carrier_world = units.carried(extax)?.inverse();
        let [t_flange_carried, fixed] =
            if tool_carried { [t_tool, t_wobj] } else { [t_wobj, t_tool] };
        let t_world_fixed = t_carrier_world * fixed;
        Ok(Self { t_flange_carried, t_world_fixed, is_stationary: !tool_carried })
    }

    /// The tool in the world frame, for the flange in it.
    pub(in crate::rapid) fn tcp(&self, t_world_flange: &Pose) -> Pose {
        if self.is_stationary { self.t_world_fixed } else { t_world_flange * self.t_flange_carried }
    }

    /// The flange in the world frame, for the tool in the work object.
    pub(in crate::rapid) fn flange(&self, t_wobj_tool: &Pose) -> Pose {
        let t_fixed_carried = if self.is_stationary { t_wobj_tool.inverse() } else { *t_wobj_tool };
        self.t_world_fixed * t_fixed_carried * self.t_flange_carried.inverse()
    }

    /// The tool in the work object, for the flange in the world frame.
    pub(in crate::rapid) fn tool(&self, t_world_flange: &Pose) -> Pose {
        let t_fixed_carried = self.t_world_fixed.inverse() * t_world_flange * self.t_flange_carried;
        if self.is_stationary { t_fixed_carried.inverse() } else { t_fixed_carried }
    }
}

/// Convert a pose in millimeters to one in meters.
pub(in crate::rapid) fn pose_in(pose: &RapidPose, field: &'static str) -> Result<Pose, Error> {
    pose_from_wxyz(pose.trans_mm.map(|mm| mm / 1e3), pose.rot).map_err(|error| match error {
        RobotError::InvalidPose(fault) => FrameFault::Pose { field, fault }.into(),
        other => other.into(),
    })
}

/// Convert a pose in meters to one in millimeters.
#[doc(hidden)]
pub fn rapid_pose(pose: &Pose) -> RapidPose {
    let (xyz, rot) = pose_to_wxyz(pose);
    RapidPose { trans_mm: xyz.map(|m| m * 1e3), rot }
}
