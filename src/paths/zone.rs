//! The size of a corner.

use crate::error::{Error, MotionFault};

/// How far around a corner of a polyline the tool may leave the way to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Zone {
    /// Distance from the corner at which the position leaves the line [m]; 0 for a corner that is
    /// met.
    pub position: f64,
    /// Distance from the corner at which the orientation begins to leave its way [m]; at least
    /// `position` counts.
    pub orientation: f64,
    /// The same as an angle that is left to turn [rad]: the smaller of both counts.
    pub angle: f64,
}

/// ABB's predefined zones: name, tool [mm], orientation [mm], orientation [deg].
/// Source: the zonedata table of the RAPID reference manual.
pub(crate) const PREDEFINED: [(&str, f64, f64, f64); 15] = [
    ("fine", 0.0, 0.0, 0.0),
    ("z0", 0.3, 0.3, 0.03),
    ("z1", 1.0, 1.0, 0.1),
    ("z5", 5.0, 8.0, 0.8),
    ("z10", 10.0, 15.0, 1.5),
    ("z15", 15.0, 23.0, 2.3),
    ("z20", 20.0, 30.0, 3.0),
    ("z30", 30.0, 45.0, 4.5),
    ("z40", 40.0, 60.0, 6.0),
    ("z50", 50.0, 75.0, 7.5),
    ("z60", 60.0, 90.0, 9.0),
    ("z80", 80.0, 120.0, 12.0),
    ("z100", 100.0, 150.0, 15.0),
    ("z150", 150.0, 225.0, 23.0),
    ("z200", 200.0, 300.0, 30.0),
];

impl Zone {
    /// A corner that is met.
    pub const FINE: Self = Self { position: 0.0, orientation: 0.0, angle: 0.0 };

    /// A zone with one radius for position and orientation [m].
    #[must_use]
    pub const fn radius(radius: f64) -> Self {
        Self { position: radius, orientation: radius, angle: f64::INFINITY }
    }

    /// One of ABB's predefined zones, "fine", "z0" .. "z200"; `None` for another name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (_, position, orientation, angle) =
            PREDEFINED.iter().find(|(own, ..)| own.eq_ignore_ascii_case(name))?;
        Some(Self::of_zonedata([*position, *orientation], *angle))
    }

    /// A zone in the units of zonedata: position and orientation [mm], angle [deg].
    pub(crate) fn of_zonedata([position, orientation]: [f64; 2], angle: f64) -> Self {
        Self {
            position: position * 1e-3,
            orientation: orientation * 1e-3,
            angle: angle.to_radians(),
        }
    }

    pub(super) fn check(&self, index: usize) -> Result<(), Error> {
        for value in [self.position, self.orientation] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(MotionFault::Zone { index, value }.into());
            }
        }
        if self.angle.is_nan() || self.angle < 0.0 {
            return Err(MotionFault::Zone { index, value: self.angle }.into());
        }
        Ok(())
    }
}
