//! A value of any type that is read.

use core::fmt;

use alloc::string::String;

use super::data_type::DataType;
use super::parts::{Part, PartMut};
use super::records::{
    JointTarget, LoadData, RapidPose, RobTarget, SpeedData, ToolData, WobjData, ZoneData,
};
use crate::report::Configuration;

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
    /// `speeddata`.
    SpeedData(SpeedData),
    /// `zonedata`.
    ZoneData(ZoneData),
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
            Self::SpeedData(_) => DataType::SpeedData,
            Self::ZoneData(_) => DataType::ZoneData,
            Self::Num(_) => DataType::Num,
        }
    }

    /// The name of its type in RAPID.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        self.data_type().name()
    }

    /// A value of a type with all numbers zero, to be read from a text.
    pub(crate) fn zero(data_type: DataType) -> Self {
        match data_type {
            DataType::RobTarget => Self::RobTarget(Record::ZERO),
            DataType::JointTarget => Self::JointTarget(Record::ZERO),
            DataType::ToolData => Self::ToolData(Record::ZERO),
            DataType::WobjData => Self::WobjData(Record::ZERO),
            DataType::Pose => Self::Pose(Record::ZERO),
            DataType::Pos => Self::Pos([0.0; 3]),
            DataType::Orient => Self::Orient([0.0; 4]),
            DataType::ConfData => Self::ConfData(NO_TURNS),
            DataType::ExtJoint => Self::ExtJoint([0.0; 6]),
            DataType::LoadData => Self::LoadData(Record::ZERO),
            DataType::SpeedData => Self::SpeedData(Record::ZERO),
            DataType::ZoneData => Self::ZoneData(Record::ZERO),
            DataType::Num => Self::Num(0.0),
        }
    }

    /// The value with its components.
    pub(crate) fn part(&self) -> Part<'_> {
        match self {
            Self::RobTarget(target) => Part::RobTarget(target),
            Self::JointTarget(target) => Part::JointTarget(target),
            Self::ToolData(tool) => Part::ToolData(tool),
            Self::WobjData(wobj) => Part::WobjData(wobj),
            Self::Pose(pose) => Part::Pose(pose),
            Self::Pos(numbers) => Part::Pos(numbers),
            Self::Orient(numbers) => Part::Orient(numbers),
            Self::ConfData(robconf) => Part::ConfData(robconf),
            Self::ExtJoint(numbers) => Part::ExtJoint(numbers),
            Self::LoadData(load) => Part::LoadData(load),
            Self::SpeedData(speed) => Part::SpeedData(speed),
            Self::ZoneData(zone) => Part::ZoneData(zone),
            Self::Num(number) => Part::Num(number),
        }
    }

    /// The value with its components, to be read from a text.
    pub(crate) fn part_mut(&mut self) -> PartMut<'_> {
        match self {
            Self::RobTarget(target) => PartMut::RobTarget(target),
            Self::JointTarget(target) => PartMut::JointTarget(target),
            Self::ToolData(tool) => PartMut::ToolData(tool),
            Self::WobjData(wobj) => PartMut::WobjData(wobj),
            Self::Pose(pose) => PartMut::Pose(pose),
            Self::Pos(numbers) => PartMut::Pos(numbers),
            Self::Orient(numbers) => PartMut::Orient(numbers),
            Self::ConfData(robconf) => PartMut::ConfData(robconf),
            Self::ExtJoint(numbers) => PartMut::ExtJoint(numbers),
            Self::LoadData(load) => PartMut::LoadData(load),
            Self::SpeedData(speed) => PartMut::SpeedData(speed),
            Self::ZoneData(zone) => PartMut::ZoneData(zone),
            Self::Num(number) => PartMut::Num(number),
        }
    }
}

impl fmt::Display for Value {
    /// As RAPID writes it: `[[x, y, z], ...]` without blanks.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.part().write(f)
    }
}

const NO_TURNS: Configuration = Configuration { cf1: 0, cf4: 0, cf6: 0, cfx: 0 };
const ZERO_POSE: RapidPose = RapidPose { trans_mm: [0.0; 3], rot: [0.0; 4] };
const ZERO_LOAD: LoadData =
    LoadData { mass_kg: 0.0, cog_mm: [0.0; 3], aom: [0.0; 4], inertia: [0.0; 3] };

/// A record that is a value of its own type.
pub(crate) trait Record: Sized {
    /// The value with all numbers zero, to be read from a text.
    const ZERO: Self;

    /// The value with its components, to be read from a text.
    fn part_mut(&mut self) -> PartMut<'_>;
}

/// Makes a type a record, which is written as RAPID does.
macro_rules! records {
    ($($Record:ident in $Part:ident from $zero:expr;)*) => {$(
        impl Record for $Record {
            const ZERO: Self = $zero;

            fn part_mut(&mut self) -> PartMut<'_> {
                PartMut::$Part(self)
            }
        }

        impl fmt::Display for $Record {
            /// As RAPID writes it, without blanks.
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                Part::$Part(self).write(f)
            }
        }
    )*};
}

records!(
    RapidPose in Pose from ZERO_POSE;
    LoadData in LoadData from ZERO_LOAD;
    RobTarget in RobTarget from RobTarget {
        trans_mm: [0.0; 3],
        rot: [0.0; 4],
        robconf: NO_TURNS,
        extax: [0.0; 6],
    };
    JointTarget in JointTarget from JointTarget { robax_deg: [0.0; 6], extax: [0.0; 6] };
    ToolData in ToolData from ToolData { robhold: false, tframe: ZERO_POSE, tload: ZERO_LOAD };
    WobjData in WobjData from WobjData {
        robhold: false,
        ufprog: false,
        ufmec: String::new(),
        uframe: ZERO_POSE,
        oframe: ZERO_POSE,
    };
    SpeedData in SpeedData from SpeedData {
        v_tcp_mm_s: 0.0,
        v_ori_deg_s: 0.0,
        v_leax_mm_s: 0.0,
        v_reax_deg_s: 0.0,
    };
    ZoneData in ZoneData from ZoneData {
        finep: false,
        pzone_tcp_mm: 0.0,
        pzone_ori_mm: 0.0,
        pzone_eax_mm: 0.0,
        zone_ori_deg: 0.0,
        zone_leax_mm: 0.0,
        zone_reax_deg: 0.0,
    };
);
