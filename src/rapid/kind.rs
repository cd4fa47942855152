//! RAPID's types and their components: one table, which reading, writing and component access go by.

use alloc::string::String;

/// A type of data that is read.
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
    /// `num`, and `dnum`, which is read as `num`.
    Num,
}

impl DataType {
    /// Every type, in the order of the enum.
    pub const ALL: [Self; 11] = [
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
        Self::Num,
    ];

    /// The type's name in RAPID.
    #[must_use]
    pub fn name(self) -> &'static str {
        Kind::from(self).name()
    }

    /// The type of a name in any case; none for one that is not read.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        if name.eq_ignore_ascii_case("dnum") {
            return Some(Self::Num);
        }
        Self::ALL.into_iter().find(|data_type| data_type.name().eq_ignore_ascii_case(name))
    }
}

/// A type of data or of a component of data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Num,
    /// A number of confdata.
    Whole,
    Bool,
    Text,
    Pos,
    Orient,
    ConfData,
    ExtJoint,
    RobJoint,
    Pose,
    LoadData,
    RobTarget,
    JointTarget,
    ToolData,
    WobjData,
}

impl From<DataType> for Kind {
    fn from(data_type: DataType) -> Self {
        match data_type {
            DataType::RobTarget => Self::RobTarget,
            DataType::JointTarget => Self::JointTarget,
            DataType::ToolData => Self::ToolData,
            DataType::WobjData => Self::WobjData,
            DataType::Pose => Self::Pose,
            DataType::Pos => Self::Pos,
            DataType::Orient => Self::Orient,
            DataType::ConfData => Self::ConfData,
            DataType::ExtJoint => Self::ExtJoint,
            DataType::LoadData => Self::LoadData,
            DataType::Num => Self::Num,
        }
    }
}

use Kind::{Bool, ConfData, ExtJoint, LoadData, Num, Orient, Pos, Pose, RobJoint, Text, Whole};

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Num | Whole => "num",
            Bool => "bool",
            Text => "string",
            Pos => "pos",
            Orient => "orient",
            ConfData => "confdata",
            ExtJoint => "extjoint",
            RobJoint => "robjoint",
            Pose => "pose",
            LoadData => "loaddata",
            Self::RobTarget => "robtarget",
            Self::JointTarget => "jointtarget",
            Self::ToolData => "tooldata",
            Self::WobjData => "wobjdata",
        }
    }

    /// The components, in order; none of an atomic type.
    pub(super) fn components(self) -> &'static [(&'static str, Kind)] {
        match self {
            Num | Whole | Bool | Text => &[],
            Pos => &[("x", Num), ("y", Num), ("z", Num)],
            Orient => &[("q1", Num), ("q2", Num), ("q3", Num), ("q4", Num)],
            ConfData => &[("cf1", Whole), ("cf4", Whole), ("cf6", Whole), ("cfx", Whole)],
            ExtJoint => &[
                ("eax_a", Num),
                ("eax_b", Num),
                ("eax_c", Num),
                ("eax_d", Num),
                ("eax_e", Num),
                ("eax_f", Num),
            ],
            RobJoint => &[
                ("rax_1", Num),
                ("rax_2", Num),
                ("rax_3", Num),
                ("rax_4", Num),
                ("rax_5", Num),
                ("rax_6", Num),
            ],
            Pose => &[("trans", Pos), ("rot", Orient)],
            LoadData => &[
                ("mass", Num),
                ("cog", Pos),
                ("aom", Orient),
                ("ix", Num),
                ("iy", Num),
                ("iz", Num),
            ],
            Self::RobTarget => {
                &[("trans", Pos), ("rot", Orient), ("robconf", ConfData), ("extax", ExtJoint)]
            }
            Self::JointTarget => &[("robax", RobJoint), ("extax", ExtJoint)],
            Self::ToolData => &[("robhold", Bool), ("tframe", Pose), ("tload", LoadData)],
            Self::WobjData => &[
                ("robhold", Bool),
                ("ufprog", Bool),
                ("ufmec", Text),
                ("uframe", Pose),
                ("oframe", Pose),
            ],
        }
    }

    /// How many numbers and truth values it holds.
    pub(super) fn width(self) -> usize {
        match self {
            Num | Whole | Bool => 1,
            Text => 0,
            _ => self.components().iter().map(|(_, kind)| kind.width()).sum(),
        }
    }

    /// A component of the name, with the number of scalars before it.
    pub(super) fn component(self, wanted: &str) -> Option<(usize, Kind)> {
        let mut before = 0;
        for (name, kind) in self.components() {
            if name.eq_ignore_ascii_case(wanted) {
                return Some((before, *kind));
            }
            before += kind.width();
        }
        None
    }

    /// Whether a value of another kind may stand where this one must.
    pub(super) fn takes(self, other: Self) -> bool {
        self == other || (matches!(self, Num | Whole) && matches!(other, Num | Whole))
    }

    /// What must stand there, for a message.
    pub(super) fn wanted(self) -> &'static str {
        match self {
            Num | Whole => "a number",
            Bool => "TRUE or FALSE",
            Text => "a string",
            _ => self.name(),
        }
    }
}

/// Most numbers and truth values that a type holds: those of tooldata.
pub(super) const MOST_SCALARS: usize = 19;

/// A value as its numbers in order, TRUE and FALSE as 1 and 0, with its only string.
#[derive(Clone, Debug)]
pub(super) struct Scalars {
    numbers: [f64; MOST_SCALARS],
    count: usize,
    /// `ufmec` of wobjdata.
    pub(super) text: String,
}

impl Scalars {
    pub(super) fn new() -> Self {
        Self { numbers: [0.0; MOST_SCALARS], count: 0, text: String::new() }
    }

    pub(super) fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }

    /// Adds a number; a negative zero becomes a positive one, as RAPID has no other.
    pub(super) fn push(&mut self, number: f64) {
        if let Some(place) = self.numbers.get_mut(self.count) {
            *place = number + 0.0;
            self.count += 1;
        }
    }

    pub(super) fn extend(&mut self, numbers: &[f64]) {
        for number in numbers {
            self.push(*number);
        }
    }

    /// `N` numbers from a place on; zeros behind the last.
    pub(super) fn at<const N: usize>(&self, from: usize) -> [f64; N] {
        core::array::from_fn(|i| self.numbers().get(from + i).copied().unwrap_or(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_type_has_room() {
        let widths = DataType::ALL.map(|data_type| Kind::from(data_type).width());
        assert_eq!(widths, [17, 12, 19, 16, 7, 3, 4, 4, 6, 11, 1]);
        assert_eq!(widths.into_iter().max(), Some(MOST_SCALARS));
    }

    #[test]
    fn types_are_named_in_any_case() {
        for data_type in DataType::ALL {
            assert_eq!(DataType::named(&data_type.name().to_uppercase()), Some(data_type));
        }
        assert_eq!(DataType::named("DNUM"), Some(DataType::Num));
        assert_eq!(DataType::named("bool"), None);
    }
}
