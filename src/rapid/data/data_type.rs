//! The data types that are read.

/// A data type that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DataType {
    /// `robtarget`.
    RobTarget,
    /// `jointtarget`.
    JointTarget,
    /// `tooldata`.
    ToolData,
    /// `wobjdata`.
    WobjData,
    /// `pose`.
    Pose,
    /// `pos`.
    Pos,
    /// `orient`.
    Orient,
    /// `confdata`.
    ConfData,
    /// `extjoint`.
    ExtJoint,
    /// `loaddata`.
    LoadData,
    /// `speeddata`.
    SpeedData,
    /// `zonedata`.
    ZoneData,
    /// `num`, and `dnum`, which is read as `num`.
    Num,
}

impl DataType {
    /// Every type, in the order of the enum.
    pub const ALL: [Self; 13] = [
        Self::RobTarget,
        Self::JointTarget,
        Self::ToolData,
        Self::WobjData,
        Self::Pose,
        Self::Pos,
        Self::Orient,
        Self::ConfData,
        Self::ExtJoint,
        Self::LoadData,
        Self::SpeedData,
        Self::ZoneData,
        Self::Num,
    ];

    /// The name of the type in RAPID.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RobTarget => "robtarget",
            Self::JointTarget => "jointtarget",
            Self::ToolData => "tooldata",
            Self::WobjData => "wobjdata",
            Self::Pose => "pose",
            Self::Pos => "pos",
            Self::Orient => "orient",
            Self::ConfData => "confdata",
            Self::ExtJoint => "extjoint",
            Self::LoadData => "loaddata",
            Self::SpeedData => "speeddata",
            Self::ZoneData => "zonedata",
            Self::Num => "num",
        }
    }

    /// The type with a name, in any case; `None` if it is not read.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        if name.eq_ignore_ascii_case("dnum") {
            return Some(Self::Num);
        }
        Self::ALL.into_iter().find(|data_type| data_type.name().eq_ignore_ascii_case(name))
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
        assert_eq!(DataType::named("DNUM"), Some(DataType::Num));
        assert_eq!(DataType::named("bool"), None);
    }
}
