//! The constants of a general arm, from its table.

use alloc::sync::Arc;

use super::General;
use super::choice::chosen;
use super::moments::Motion;
use crate::kinematics::chain::dh::{DhRow, Mdh, screw_x};
use crate::kinematics::pose::translation_z;
use crate::kinematics::structure::closure::Closure;
use crate::kinematics::structure::joint_map::JointMap;
use crate::report::{Pattern, UnknownStructure};

/// Any six axes.
pub(super) static PATTERN: Pattern =
    Pattern { name: "general", title: "six joints in general", conditions: &[] };

impl General {
    /// The arm of a table. The first and the last row's constants before joint 1 and behind joint 6
    /// are part of the base and the flange.
    pub(crate) fn of(mdh: &Mdh<6>) -> Result<Self, UnknownStructure> {
        let mut rows = mdh.rows;
        let offsets = rows.map(|row| -row.theta);
        let [first, .., last] = rows;
        (rows[0], rows[5].d) = (DhRow::default(), 0.0);
        let closure = Closure::of(&rows);
        let links: [Motion; 5] = core::array::from_fn(|i| {
            // From joint i to the next: along z of row i, then about and along x of the next row.
            let before = if i == 0 { 0.0 } else { rows[i].d };
            let next = rows[i + 1];
            let link = translation_z(before) * screw_x(next.alpha, next.a);
            Motion::of(&link, closure.reach)
        });
        closure.check_freedom(&rows)?;
        let splits = chosen(&links, &closure, &offsets);
        let joint_map = JointMap {
            signs: [1.0; 6],
            offsets,
            coupled: false,
            t_base_shoulder: mdh.base * screw_x(first.alpha, first.a) * translation_z(first.d),
            t_wrist_flange: translation_z(last.d) * mdh.flange,
        };
        Ok(Self { closure, joint_map, splits: Arc::new(splits), nearest: None })
    }
}
