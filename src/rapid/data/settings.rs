//! How moves are made: what ConfL, ConfJ, SingArea and CirPathMode set.

use alloc::string::String;

/// What the instructions before a move set, in its routine. At the beginning of a routine it is
/// what a program starts with: that is the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotionSettings {
    /// `ConfL`: whether `MoveL` and `MoveC` must arrive with the configuration of the target.
    pub conf_l: bool,
    /// `ConfJ`: whether `MoveJ` must arrive with the configuration of the target; the nearest one
    /// is taken otherwise.
    pub conf_j: bool,
    /// `SingArea`: what happens near the wrist singularity.
    pub sing_area: SingArea,
    /// `CirPathMode`: what the orientation does in a `MoveC`.
    pub cir_path_mode: CirPathMode,
}

impl Default for MotionSettings {
    fn default() -> Self {
        Self {
            conf_l: true,
            conf_j: true,
            sing_area: SingArea::default(),
            cir_path_mode: CirPathMode::default(),
        }
    }
}

/// What happens near the wrist singularity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SingArea {
    /// `\Off`: the tool keeps its orientation.
    #[default]
    Off,
    /// `\Wrist`: the wrist goes straight through, the orientation gives way.
    Wrist,
    /// `\LockAxis4`: axis 4 stays at 0 or +-180 deg.
    LockAxis4,
}

/// What the orientation does in a `MoveC`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CirPathMode {
    /// `\PathFrame`: it turns evenly relative to the path.
    #[default]
    PathFrame,
    /// `\ObjectFrame`: it turns evenly relative to the work object.
    ObjectFrame,
    /// `\CirPointOri`: it turns evenly to that of the point on the circle, then to that of the
    /// target.
    CirPointOri,
    /// `\Wrist45`: axes 4 and 5 go evenly.
    Wrist45,
    /// `\Wrist46`: axes 4 and 6 go evenly.
    Wrist46,
    /// `\Wrist56`: axes 5 and 6 go evenly.
    Wrist56,
}

impl SingArea {
    /// Every one.
    pub const ALL: [Self; 3] = [Self::Off, Self::Wrist, Self::LockAxis4];

    /// The name of its switch.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "Off",
            Self::Wrist => "Wrist",
            Self::LockAxis4 => "LockAxis4",
        }
    }
}

impl CirPathMode {
    /// Every one.
    pub const ALL: [Self; 6] = [
        Self::PathFrame,
        Self::ObjectFrame,
        Self::CirPointOri,
        Self::Wrist45,
        Self::Wrist46,
        Self::Wrist56,
    ];

    /// The name of its switch.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PathFrame => "PathFrame",
            Self::ObjectFrame => "ObjectFrame",
            Self::CirPointOri => "CirPointOri",
            Self::Wrist45 => "Wrist45",
            Self::Wrist46 => "Wrist46",
            Self::Wrist56 => "Wrist56",
        }
    }
}

impl MotionSettings {
    /// The names of the instructions that set them.
    pub(crate) const INSTRUCTIONS: [&str; 4] = ["ConfL", "ConfJ", "SingArea", "CirPathMode"];

    /// Set what an instruction with a switch sets; without one it sets the default. Returns whether
    /// there is such an instruction and such a switch.
    pub(crate) fn set(&mut self, instruction: &str, switch: Option<&str>) -> bool {
        let is = |name: &str| instruction.eq_ignore_ascii_case(name);
        let found = |names: &[&str]| match switch {
            None => Some(0),
            Some(switch) => names.iter().position(|name| name.eq_ignore_ascii_case(switch)),
        };
        let Self { conf_l, conf_j, sing_area, cir_path_mode } = self;
        for (name, conf) in [("ConfL", conf_l), ("ConfJ", conf_j)] {
            if is(name) {
                let place = found(&["On", "Off"]);
                *conf = place.map_or(*conf, |place| place == 0);
                return place.is_some();
            }
        }
        if is("SingArea") {
            let place = found(&SingArea::ALL.map(SingArea::name));
            *sing_area = place.map_or(*sing_area, |place| SingArea::ALL[place]);
            return place.is_some();
        }
        if is("CirPathMode") {
            let place = found(&CirPathMode::ALL.map(CirPathMode::name));
            *cir_path_mode = place.map_or(*cir_path_mode, |place| CirPathMode::ALL[place]);
            return place.is_some();
        }
        false
    }
}

/// An instruction that sets how the moves after it are made, as it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Setting {
    pub(crate) line: usize,
    pub(crate) column: usize,
    pub(crate) routine: Option<String>,
    pub(crate) text: String,
}
