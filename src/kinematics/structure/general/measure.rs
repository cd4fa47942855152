//! The constants of a general arm, from its table.

use super::choice::{chosen, taken};
use super::geometry::General;
use crate::kinematics::chain::corrections::about_y;
use crate::kinematics::chain::dh::{DhRow, Mdh, screw_x};
use crate::kinematics::chain::skew::{TiltedRow, tilted_rows};
use crate::kinematics::pose::translation_z;
use crate::kinematics::structure::closure::Closure;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::joint_map::JointMap;
use crate::report::{Pattern, UnknownStructure};

/// Any six axes.
pub(super) static PATTERN: Pattern =
    Pattern { name: "general", title: "six joints in general", conditions: &[] };

impl General {
    /// The arm of a table. The first and the last row's constants before joint 1 and behind joint 6
    /// are part of the base and the flange.
    pub(crate) fn of(mdh: &Mdh<6>) -> Result<Self, UnknownStructure> {
        Self::measured(mdh, None)
    }

    /// Measure an arm that may differ by a link from another one, whose splits are taken if they
    /// serve it, too: to choose takes milliseconds.
    pub(super) fn measured(mdh: &Mdh<6>, other: Option<&Self>) -> Result<Self, UnknownStructure> {
        let mut tilted = tilted_rows(&mdh.rows);
        let rows = tilted.map(|TiltedRow { row, .. }| row);
        let offsets = rows.map(|row| -row.theta);
        let [first, .., last] = rows;
        (tilted[0].row, tilted[5].row.d) = (DhRow::default(), 0.0);
        let closure = Closure::of(&tilted);
        let links: [Frame; 5] = core::array::from_fn(|i| {
            // From joint i to the next: along z of row i, then about and along x of the next row.
            let TiltedRow { row: next, beta } = tilted[i + 1];
            let link = translation_z(tilted[i].row.d) * screw_x(next.alpha, next.a) * about_y(beta);
            Frame::of(&link).in_units(1.0 / closure.reach)
        });
        closure.check_freedom(&tilted.map(|TiltedRow { row, .. }| row))?;
        let taken = other.and_then(|other| taken(other, &links, &closure));
        let (splits, roots) = taken.unwrap_or_else(|| chosen(&links, &closure, &offsets));
        let joint_map = JointMap {
            signs: [1.0; 6],
            offsets,
            coupling: 0.0,
            t_base_shoulder: mdh.base * screw_x(first.alpha, first.a) * translation_z(first.d),
            t_wrist_flange: translation_z(last.d) * mdh.flange,
        };
        Ok(Self { closure, joint_map, splits, roots })
    }
}
