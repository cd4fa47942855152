//! RAPID's records, as they are written: nothing is normalised.

use core::fmt;

use alloc::string::String;

use super::kind::{DataType, Kind, Scalars};
use super::write::write_scalars;
use crate::kinematics::Configuration;

/// What stands for an external axis that is not there.
pub const NOT_THERE: f64 = 9e9;

/// `pose`: a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RapidPose {
    /// Position [mm].
    pub trans_mm: [f64; 3],
    /// Quaternion w, x, y, z.
    pub rot: [f64; 4],
}

/// `robtarget`: a pose of the tool in the work object, which solution, and external axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobTarget {
    /// Position [mm].
    pub trans_mm: [f64; 3],
    /// Quaternion w, x, y, z.
    pub rot: [f64; 4],
    /// Quarter turns and slot.
    pub robconf: Configuration,
    /// External axes [deg or mm]; 9e9 is one that is not there.
    pub extax: [f64; 6],
}

/// `jointtarget`: angles of the robot's axes and external axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointTarget {
    /// The controller's angles [deg].
    pub robax_deg: [f64; 6],
    /// External axes [deg or mm]; 9e9 is one that is not there.
    pub extax: [f64; 6],
}

/// `loaddata`: mass and inertia of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadData {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Centre of gravity [mm].
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
    /// The tool in the frame of the flange; in the world where the robot does not hold it.
    pub tframe: RapidPose,
    /// The tool's load.
    pub tload: LoadData,
}

/// `wobjdata`: a work object, `uframe * oframe` in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct WobjData {
    /// Whether the robot holds the work object.
    pub robhold: bool,
    /// Whether the user frame is fixed; a mechanical unit moves it where it is not.
    pub ufprog: bool,
    /// Name of the mechanical unit that moves the user frame.
    pub ufmec: String,
    /// User frame.
    pub uframe: RapidPose,
    /// Object frame, in the user frame.
    pub oframe: RapidPose,
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

/// A value of any type that is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `robtarget`.
    RobTarget(RobTarget),
    /// `jointtarget`.
    JointTarget(JointTarget),
    /// `tooldata`.
    ToolData(ToolData),
    /// `wobjdata`.
    WobjData(WobjData),
    /// `pose`.
    Pose(RapidPose),
    /// `pos` [mm].
    Pos([f64; 3]),
    /// `orient`, a quaternion w, x, y, z.
    Orient([f64; 4]),
    /// `confdata`.
    ConfData(Configuration),
    /// `extjoint` [deg or mm].
    ExtJoint([f64; 6]),
    /// `loaddata`.
    LoadData(LoadData),
    /// `num` or `dnum`.
    Num(f64),
}

impl Value {
    /// Its type.
    #[must_use]
    pub fn data_type(&self) -> DataType {
        match self {
            Self::RobTarget(_) => DataType::RobTarget,
            Self::JointTarget(_) => DataType::JointTarget,
            Self::ToolData(_) => DataType::ToolData,
            Self::WobjData(_) => DataType::WobjData,
            Self::Pose(_) => DataType::Pose,
            Self::Pos(_) => DataType::Pos,
            Self::Orient(_) => DataType::Orient,
            Self::ConfData(_) => DataType::ConfData,
            Self::ExtJoint(_) => DataType::ExtJoint,
            Self::LoadData(_) => DataType::LoadData,
            Self::Num(_) => DataType::Num,
        }
    }

    /// The name of its type in RAPID.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        self.data_type().name()
    }

    pub(super) fn scalars(&self) -> Scalars {
        let mut scalars = Scalars::new();
        match self {
            Self::RobTarget(target) => target.add_to(&mut scalars),
            Self::JointTarget(target) => target.add_to(&mut scalars),
            Self::ToolData(tool) => tool.add_to(&mut scalars),
            Self::WobjData(wobj) => wobj.add_to(&mut scalars),
            Self::Pose(pose) => pose.add_to(&mut scalars),
            Self::Pos(pos) => scalars.extend(pos),
            Self::Orient(orient) => scalars.extend(orient),
            Self::ConfData(robconf) => add_configuration(*robconf, &mut scalars),
            Self::ExtJoint(extax) => scalars.extend(extax),
            Self::LoadData(load) => load.add_to(&mut scalars),
            Self::Num(number) => scalars.push(*number),
        }
        scalars
    }

    /// The value of a type from all its scalars.
    pub(super) fn from_scalars(data_type: DataType, scalars: &Scalars) -> Self {
        match data_type {
            DataType::RobTarget => Self::RobTarget(RobTarget::from_scalars(scalars)),
            DataType::JointTarget => Self::JointTarget(JointTarget::from_scalars(scalars)),
            DataType::ToolData => Self::ToolData(ToolData::from_scalars(scalars)),
            DataType::WobjData => Self::WobjData(WobjData::from_scalars(scalars)),
            DataType::Pose => Self::Pose(pose_at(scalars, 0)),
            DataType::Pos => Self::Pos(scalars.at(0)),
            DataType::Orient => Self::Orient(scalars.at(0)),
            DataType::ConfData => Self::ConfData(configuration_at(scalars, 0)),
            DataType::ExtJoint => Self::ExtJoint(scalars.at(0)),
            DataType::LoadData => Self::LoadData(load_at(scalars, 0)),
            DataType::Num => Self::Num(scalars.at::<1>(0)[0]),
        }
    }
}

fn pose_at(scalars: &Scalars, from: usize) -> RapidPose {
    RapidPose { trans_mm: scalars.at(from), rot: scalars.at(from + 3) }
}

fn load_at(scalars: &Scalars, from: usize) -> LoadData {
    let [mass_kg] = scalars.at(from);
    LoadData {
        mass_kg,
        cog_mm: scalars.at(from + 1),
        aom: scalars.at(from + 4),
        inertia: scalars.at(from + 8),
    }
}

fn configuration_at(scalars: &Scalars, from: usize) -> Configuration {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the numbers of confdata are whole and in range where they are read"
    )]
    let [cf1, cf4, cf6, cfx] = scalars.at(from).map(|number: f64| number as i32);
    Configuration { cf1, cf4, cf6, cfx }
}

fn add_configuration(Configuration { cf1, cf4, cf6, cfx }: Configuration, scalars: &mut Scalars) {
    scalars.extend(&[cf1, cf4, cf6, cfx].map(f64::from));
}

impl RapidPose {
    fn add_to(&self, scalars: &mut Scalars) {
        scalars.extend(&self.trans_mm);
        scalars.extend(&self.rot);
    }
}

impl RobTarget {
    pub(super) fn from_scalars(scalars: &Scalars) -> Self {
        let RapidPose { trans_mm, rot } = pose_at(scalars, 0);
        Self { trans_mm, rot, robconf: configuration_at(scalars, 7), extax: scalars.at(11) }
    }

    fn add_to(&self, scalars: &mut Scalars) {
        RapidPose { trans_mm: self.trans_mm, rot: self.rot }.add_to(scalars);
        add_configuration(self.robconf, scalars);
        scalars.extend(&self.extax);
    }
}

impl JointTarget {
    pub(super) fn from_scalars(scalars: &Scalars) -> Self {
        Self { robax_deg: scalars.at(0), extax: scalars.at(6) }
    }

    fn add_to(&self, scalars: &mut Scalars) {
        scalars.extend(&self.robax_deg);
        scalars.extend(&self.extax);
    }
}

impl LoadData {
    fn add_to(&self, scalars: &mut Scalars) {
        scalars.push(self.mass_kg);
        scalars.extend(&self.cog_mm);
        scalars.extend(&self.aom);
        scalars.extend(&self.inertia);
    }
}

impl ToolData {
    pub(super) fn from_scalars(scalars: &Scalars) -> Self {
        let [robhold] = scalars.at(0);
        Self { robhold: robhold != 0.0, tframe: pose_at(scalars, 1), tload: load_at(scalars, 8) }
    }

    fn add_to(&self, scalars: &mut Scalars) {
        scalars.push(f64::from(u8::from(self.robhold)));
        self.tframe.add_to(scalars);
        self.tload.add_to(scalars);
    }
}

impl WobjData {
    pub(super) fn from_scalars(scalars: &Scalars) -> Self {
        let [robhold, ufprog] = scalars.at(0).map(|number: f64| number != 0.0);
        Self {
            robhold,
            ufprog,
            ufmec: scalars.text.clone(),
            uframe: pose_at(scalars, 2),
            oframe: pose_at(scalars, 9),
        }
    }

    fn add_to(&self, scalars: &mut Scalars) {
        scalars.extend(&[self.robhold, self.ufprog].map(|is| f64::from(u8::from(is))));
        scalars.text.clone_from(&self.ufmec);
        self.uframe.add_to(scalars);
        self.oframe.add_to(scalars);
    }
}

impl fmt::Display for Value {
    /// As RAPID writes it: `[[x, y, z], ...]` without blanks.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_scalars(f, Kind::from(self.data_type()), &self.scalars())
    }
}

/// A record that is a value of its own type.
pub(super) trait Record: Sized {
    /// That type.
    const DATA_TYPE: DataType;

    /// The record of a value; nothing of a value of another type.
    fn of(value: Value) -> Option<Self>;
}

/// Gives a record its type and the words of its value.
macro_rules! written_as_value {
    ($($record:ident => $variant:ident),*) => {$(
        impl Record for $record {
            const DATA_TYPE: DataType = DataType::$variant;

            fn of(value: Value) -> Option<Self> {
                if let Value::$variant(record) = value { Some(record) } else { None }
            }
        }

        impl fmt::Display for $record {
            /// As RAPID writes it, without blanks.
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                Value::$variant(self.clone()).fmt(f)
            }
        }
    )*};
}

written_as_value!(
    RapidPose => Pose,
    RobTarget => RobTarget,
    JointTarget => JointTarget,
    LoadData => LoadData,
    ToolData => ToolData,
    WobjData => WobjData
);
