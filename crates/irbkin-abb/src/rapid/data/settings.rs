//! How moves are made: what ConfL, ConfJ, SingArea and CirPathMode set.

use crate::rapid::text::words::words;

/// Settings of the instructions before a move in its routine. The default is set at the beginning
/// of a routine, as when a program starts.
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

words! {
    /// The behavior near the wrist singularity: a switch of `SingArea`.
    #[derive(Default)]
    pub enum SingArea {
        /// The tool keeps its orientation.
        #[default]
        Off = "Off",
        /// The wrist goes straight through, the orientation gives way.
        Wrist = "Wrist",
        /// Axis 4 stays at 0 or +-180 deg.
        LockAxis4 = "LockAxis4",
    }

    /// The orientation in a `MoveC`: a switch of `CirPathMode`.
    #[derive(Default)]
    pub enum CirPathMode {
        /// It turns evenly relative to the path.
        #[default]
        PathFrame = "PathFrame",
        /// It turns evenly relative to the work object.
        ObjectFrame = "ObjectFrame",
        /// It turns evenly to the orientation of the point on the circle, then to the target's.
        CirPointOri = "CirPointOri",
        /// Axes 4 and 5 go evenly.
        Wrist45 = "Wrist45",
        /// Axes 4 and 6 go evenly.
        Wrist46 = "Wrist46",
        /// Axes 5 and 6 go evenly.
        Wrist56 = "Wrist56",
    }
}

impl MotionSettings {
    /// Set what an instruction with a switch sets; without one it sets the default. Returns whether
    /// there is such an instruction and such a switch.
    pub(crate) fn set(&mut self, instruction: &str, switch: Option<&str>) -> bool {
        fn put<T>(place: &mut T, value: Option<T>) -> bool {
            value.map(|value| *place = value).is_some()
        }
        let is_on = match switch.map(str::to_ascii_lowercase).as_deref() {
            None | Some("on") => Some(true),
            Some("off") => Some(false),
            Some(_) => None,
        };
        match instruction.to_ascii_lowercase().as_str() {
            "confl" => put(&mut self.conf_l, is_on),
            "confj" => put(&mut self.conf_j, is_on),
            "singarea" => {
                put(&mut self.sing_area, switch.map_or(Some(SingArea::default()), SingArea::named))
            }
            "cirpathmode" => put(
                &mut self.cir_path_mode,
                switch.map_or(Some(CirPathMode::default()), CirPathMode::named),
            ),
            _ => false,
        }
    }
}
