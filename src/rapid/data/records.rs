//! RAPID's records, as they are written: nothing is normalized.

use alloc::string::String;

use crate::report::Configuration;

/// Value of an external axis that does not exist.
pub const NOT_THERE: f64 = 9e9;

/// `pose`: a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RapidPose {
    /// Position [mm].
    pub trans_mm: [f64; 3],
    /// Quaternion w, x, y, z.
    pub rot: [f64; 4],
}

/// `robtarget`: a pose of the tool in the work object, a configuration, and external axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobTarget {
    /// Position [mm].
    pub trans_mm: [f64; 3],
    /// Quaternion w, x, y, z.
    pub rot: [f64; 4],
    /// Quarter turns and slot.
    pub robconf: Configuration,
    /// External axes [deg or mm]; 9e9 for an axis that does not exist.
    pub extax: [f64; 6],
}

/// `jointtarget`: angles of the robot's axes and external axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointTarget {
    /// The controller's angles [deg].
    pub robax_deg: [f64; 6],
    /// External axes [deg or mm]; 9e9 for an axis that does not exist.
    pub extax: [f64; 6],
}

/// `loaddata`: mass and inertia of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadData {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Center of gravity [mm].
    pub cog_mm: [f64; 3],
    /// Axes of moment, a quaternion w, x, y, z.
    pub aom: [f64; 4],
    /// Moments of inertia ix, iy, iz [kg m^2].
    pub inertia: [f64; 3],
}

/// `tooldata`: a tool in the frame of the flange.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolData {
    /// Whether the robot holds the tool.
    pub robhold: bool,
    /// The tool in the flange frame or, if the robot does not hold it, in the world frame.
    pub tframe: RapidPose,
    /// The tool's load.
    pub tload: LoadData,
}

/// `wobjdata`: a work object, at `uframe * oframe` in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct WobjData {
    /// Whether the robot holds the work object.
    pub robhold: bool,
    /// Whether the user frame is fixed; otherwise a mechanical unit moves it.
    pub ufprog: bool,
    /// Name of the mechanical unit that moves the user frame.
    pub ufmec: String,
    /// User frame.
    pub uframe: RapidPose,
    /// Object frame, in the user frame.
    pub oframe: RapidPose,
}

/// `speeddata`: how fast a move is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedData {
    /// Speed of the tool center point [mm/s].
    pub v_tcp_mm_s: f64,
    /// Speed of its reorientation [deg/s].
    pub v_ori_deg_s: f64,
    /// Speed of linear external axes [mm/s].
    pub v_leax_mm_s: f64,
    /// Speed of rotating external axes [deg/s].
    pub v_reax_deg_s: f64,
}

/// `zonedata`: how a move ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZoneData {
    /// Whether the robot stops at the target.
    pub finep: bool,
    /// Radius around the target in which the tool center point leaves the line [mm].
    pub pzone_tcp_mm: f64,
    /// Radius in which the reorientation leaves its way [mm].
    pub pzone_ori_mm: f64,
    /// Radius for external axes [mm].
    pub pzone_eax_mm: f64,
    /// Reorientation that is left where it leaves its way [deg].
    pub zone_ori_deg: f64,
    /// The same for linear external axes [mm].
    pub zone_leax_mm: f64,
    /// The same for rotating external axes [deg].
    pub zone_reax_deg: f64,
}

impl RapidPose {
    /// No displacement and no rotation.
    pub const IDENTITY: Self = Self { trans_mm: [0.0; 3], rot: [1.0, 0.0, 0.0, 0.0] };
}

impl LoadData {
    /// RAPID's `load0`, the least load.
    pub const LOAD0: Self = Self {
        mass_kg: 0.001,
        cog_mm: [0.0, 0.0, 0.001],
        aom: [1.0, 0.0, 0.0, 0.0],
        inertia: [0.0; 3],
    };
}

impl ToolData {
    /// RAPID's `tool0`, the flange.
    pub const TOOL0: Self =
        Self { robhold: true, tframe: RapidPose::IDENTITY, tload: LoadData::LOAD0 };
}

impl WobjData {
    /// RAPID's `wobj0`, the world.
    pub const WOBJ0: Self = Self {
        robhold: false,
        ufprog: true,
        ufmec: String::new(),
        uframe: RapidPose::IDENTITY,
        oframe: RapidPose::IDENTITY,
    };
}
