//! RAPID's records, as they are written: nothing is normalized.

use alloc::collections::BTreeMap;
use core::fmt;

use super::types::{
    Atoms, JOINTTARGET, LOADDATA, POSE, Part, ROBTARGET, Record, SPEEDDATA, Source, TOOLDATA, Type,
    WOBJDATA, ZONEDATA,
};
use crate::prelude::*;
use irbkin::Configuration;

/// Value of an external axis that does not exist.
pub const NOT_THERE: f64 = 9e9;

/// Defines records: structs that consist of RAPID's atoms.
macro_rules! records {
    ($(
        $(#[doc = $doc:literal])*
        $Record:ident: $TYPE:ident as $class:literal $(with $Derived:ident)? {
            $($(#[doc = $field_doc:literal])* $field:ident: $Field:ty $(= $default:expr)?,)*
        }
    )*) => {$(
        $(#[doc = $doc])*
        #[derive(Clone, $($Derived,)? Debug, PartialEq)]
        pub struct $Record {
            $($(#[doc = $field_doc])* pub $field: $Field,)*
        }

        impl Part for $Record {
            fn put(&self, atoms: &mut Atoms) {
                $(self.$field.put(atoms);)*
            }

            fn take(atoms: &mut Source) -> Option<Self> {
                Some(Self { $($field: Part::take(atoms)?,)* })
            }
        }

        impl Record for $Record {
            const TYPE: &'static Type = &$TYPE;
        }

        impl fmt::Display for $Record {
            /// As RAPID writes it, without blanks.
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let mut atoms = Atoms::new();
                self.put(&mut atoms);
                Self::TYPE.write(f, &mut atoms.iter())
            }
        }
    )*};
}

/// Passes the records to a macro: names, types in RAPID, classes of Python, and fields with the
/// defaults that constructors of these take.
#[doc(hidden)]
#[macro_export]
macro_rules! rapid_records {
    ($then:ident) => {
        $then! {
            /// `pose`: a frame.
            RapidPose: POSE as "Pose" with Copy {
                /// Position [mm].
                trans_mm: [f64; 3] = [0.0; 3],
                /// Quaternion w, x, y, z.
                rot: [f64; 4] = $crate::rapid::RapidPose::IDENTITY.rot,
            }

            /// `robtarget`: a pose of the tool in the work object, a configuration, and external axes.
            RobTarget: ROBTARGET as "RobTarget" with Copy {
                /// Position [mm].
                trans_mm: [f64; 3],
                /// Quaternion w, x, y, z.
                rot: [f64; 4] = $crate::rapid::RapidPose::IDENTITY.rot,
                /// Quarter turns of axes 1, 4 and 6, and the slot.
                robconf: Configuration = Configuration::default(),
                /// External axes [deg or mm]; 9e9 for an axis that does not exist.
                extax: [f64; 6] = [$crate::rapid::NOT_THERE; 6],
            }

            /// `jointtarget`: angles of the robot's axes, and external axes.
            JointTarget: JOINTTARGET as "JointTarget" with Copy {
                /// The controller's angles [deg].
                robax_deg: [f64; 6],
                /// External axes [deg or mm]; 9e9 for an axis that does not exist.
                extax: [f64; 6] = [$crate::rapid::NOT_THERE; 6],
            }

            /// `loaddata`: mass and inertia of a load; kinematics does not use them.
            LoadData: LOADDATA as "LoadData" with Copy {
                /// Mass [kg].
                mass_kg: f64 = $crate::rapid::LoadData::LOAD0.mass_kg,
                /// Center of gravity [mm].
                cog_mm: [f64; 3] = $crate::rapid::LoadData::LOAD0.cog_mm,
                /// Axes of moment, a quaternion w, x, y, z.
                aom: [f64; 4] = $crate::rapid::LoadData::LOAD0.aom,
                /// Moments of inertia ix, iy, iz [kg m^2].
                inertia: [f64; 3] = $crate::rapid::LoadData::LOAD0.inertia,
            }

            /// `tooldata`: a tool. The default is tool0.
            ToolData: TOOLDATA as "ToolData" with Copy {
                /// Whether the robot holds it; a tool that it does not hold is stationary.
                robhold: bool = true,
                /// The frame of the tool in the flange frame; in the world frame if it is stationary.
                tframe: $crate::rapid::RapidPose = $crate::rapid::RapidPose::IDENTITY,
                /// Its load.
                tload: $crate::rapid::LoadData = $crate::rapid::LoadData::LOAD0,
            }

            /// `wobjdata`: a work object, at `uframe * oframe`. The default is wobj0.
            WobjData: WOBJDATA as "WobjData" {
                /// Whether the robot holds it, under a stationary tool.
                robhold: bool = false,
                /// Whether the user frame is fixed; otherwise `ufmec` moves it.
                ufprog: bool = true,
                /// The mechanical unit that moves the user frame.
                ufmec: String = String::new(),
                /// User frame in the world frame; in the flange frame if the robot holds the work object.
                uframe: $crate::rapid::RapidPose = $crate::rapid::RapidPose::IDENTITY,
                /// Object frame in the user frame.
                oframe: $crate::rapid::RapidPose = $crate::rapid::RapidPose::IDENTITY,
            }

            /// `speeddata`: how fast a move is.
            SpeedData: SPEEDDATA as "SpeedData" with Copy {
                /// Speed of the tool center point [mm/s].
                v_tcp_mm_s: f64,
                /// Speed of its reorientation [deg/s].
                v_ori_deg_s: f64 = $crate::rapid::SpeedData::of(0.0).v_ori_deg_s,
                /// Speed of linear external axes [mm/s].
                v_leax_mm_s: f64 = $crate::rapid::SpeedData::of(0.0).v_leax_mm_s,
                /// Speed of rotating external axes [deg/s].
                v_reax_deg_s: f64 = $crate::rapid::SpeedData::of(0.0).v_reax_deg_s,
            }

            /// `zonedata`: how a move ends. The default is fine.
            ZoneData: ZONEDATA as "ZoneData" with Copy {
                /// Whether the robot stops at the target.
                finep: bool = true,
                /// Radius around the target in which the tool center point leaves the line [mm].
                pzone_tcp_mm: f64 = 0.0,
                /// Radius in which the reorientation leaves its way [mm].
                pzone_ori_mm: f64 = 0.0,
                /// Radius for external axes [mm].
                pzone_eax_mm: f64 = 0.0,
                /// Reorientation that is left where it leaves its way [deg].
                zone_ori_deg: f64 = 0.0,
                /// Way of linear external axes that is left where they leave it [mm].
                zone_leax_mm: f64 = 0.0,
                /// Way of rotating external axes that is left where they leave it [deg].
                zone_reax_deg: f64 = 0.0,
            }
        }
    };
}
rapid_records!(records);

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

/// The type of [`tools`](crate::rapid::CheckOptions::tools).
pub type GivenTools = BTreeMap<Option<String>, ToolData>;

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

impl ZoneData {
    /// RAPID's `fine`: the robot stops at the target.
    pub(crate) const FINE: Self = Self {
        finep: true,
        pzone_tcp_mm: 0.0,
        pzone_ori_mm: 0.0,
        pzone_eax_mm: 0.0,
        zone_ori_deg: 0.0,
        zone_leax_mm: 0.0,
        zone_reax_deg: 0.0,
    };
}

impl SpeedData {
    /// RAPID's own speeddata with a speed of the tool center point [mm/s].
    #[doc(hidden)]
    pub const fn of(v_tcp_mm_s: f64) -> Self {
        Self { v_tcp_mm_s, v_ori_deg_s: 500.0, v_leax_mm_s: 5000.0, v_reax_deg_s: 1000.0 }
    }
}
