//! A value of any type that is read.

use core::fmt;

use super::records::{
    JointTarget, LoadData, RapidPose, RobTarget, SpeedData, ToolData, WobjData, ZoneData,
};
use super::types::{
    Atoms, CONFDATA, DNUM, EXTJOINT, JOINTTARGET, LOADDATA, NUM, ORIENT, POS, POSE, Part,
    ROBTARGET, SPEEDDATA, TOOLDATA, Type, WOBJDATA, ZONEDATA,
};
use irbkin::Configuration;

macro_rules! values {
    ($($(#[doc = $doc:literal])* $Name:ident($Value:ty): $TYPE:ident;)*) => {
        /// A data type that is read.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum DataType {
            $($(#[doc = $doc])* $Name,)*
        }

        impl DataType {
            /// Every type, in the order of the enum.
            pub const ALL: [Self; 14] = [$(Self::$Name),*];

            /// Its name and its components.
            pub(crate) fn described(self) -> &'static Type {
                match self {
                    $(Self::$Name => &$TYPE,)*
                }
            }
        }

        /// A value of any type that is read.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Value {
            $($(#[doc = $doc])* $Name($Value),)*
        }

        impl Value {
            /// Its type.
            #[must_use]
            pub fn data_type(&self) -> DataType {
                match self {
                    $(Self::$Name(_) => DataType::$Name,)*
                }
            }

                    pub(crate) fn atoms(&self) -> Atoms {
                let mut atoms = Atoms::new();
                match self {
                    $(Self::$Name(value) => value.put(&mut atoms),)*
                }
                atoms
            }

            /// The value of a type with these atoms; `None` if they are of another one.
            pub(crate) fn of(data_type: DataType, atoms: Atoms) -> Option<Self> {
                let atoms = &mut atoms.into_iter();
                match data_type {
                    $(DataType::$Name => Part::take(atoms).map(Self::$Name),)*
                }
            }
        }
    };
}

values! {
    /// `robtarget`.
    RobTarget(RobTarget): ROBTARGET;
    /// `jointtarget`.
    JointTarget(JointTarget): JOINTTARGET;
    /// `tooldata`.
    ToolData(ToolData): TOOLDATA;
    /// `wobjdata`.
    WobjData(WobjData): WOBJDATA;
    /// `pose`.
    Pose(RapidPose): POSE;
    /// `pos` [mm].
    Pos([f64; 3]): POS;
    /// `confdata`.
    ConfData(Configuration): CONFDATA;
    /// `orient`, a quaternion w, x, y, z.
    Orient([f64; 4]): ORIENT;
    /// `extjoint` [deg or mm].
    ExtJoint([f64; 6]): EXTJOINT;
    /// `loaddata`.
    LoadData(LoadData): LOADDATA;
    /// `speeddata`.
    SpeedData(SpeedData): SPEEDDATA;
    /// `zonedata`.
    ZoneData(ZoneData): ZONEDATA;
    /// `num`.
    Num(f64): NUM;
    /// `dnum`, whose values are read as numbers of the same precision as a `num`.
    Dnum(f64): DNUM;
}

impl DataType {
    /// The name of the type in RAPID.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.described().name
    }

    /// The type with a name, in any case; `None` if it is not read.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|data_type| data_type.name().eq_ignore_ascii_case(name))
    }
}

impl Value {
    /// The value as one of a type, which a number may be too: a `num` becomes a `dnum`.
    #[doc(hidden)]
    pub fn into_type(self, data_type: DataType) -> Self {
        match self {
            Self::Num(number) if data_type == DataType::Dnum => Self::Dnum(number),
            other => other,
        }
    }

    /// The name of its type in RAPID.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        self.data_type().name()
    }
}

impl fmt::Display for Value {
    /// As RAPID writes it: `[[x, y, z], ...]` without blanks.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.data_type().described().write(f, &mut self.atoms().iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_named_in_any_case() {
        for data_type in DataType::ALL {
            assert_eq!(DataType::named(&data_type.name().to_uppercase()), Some(data_type));
        }
        assert_eq!(DataType::named("bool"), None);
    }
}
