//! How far joints are from the quarters of a configuration.

use alloc::format;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::Robot;
use crate::rapid::data::finding::{Code, Finding};
use crate::report::Configuration;

/// Axes of a configuration, from 0, and their names in it.
pub(in crate::rapid) const AXES: [(usize, &str); 3] = [(0, "cf1"), (3, "cf4"), (5, "cf6")];

/// The axis that is farthest over the edge of its quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::rapid) struct Over {
    /// From 0.
    pub(in crate::rapid) axis: usize,
    /// Its angle [rad].
    pub(in crate::rapid) angle: f64,
    /// How far it is over the edge [rad].
    pub(in crate::rapid) by: f64,
}

/// How far joints [rad] are over the quarters of a configuration; `None` if they are on another
/// branch.
pub(in crate::rapid) fn over_quarters(
    robot: &Robot<6>,
    q: &[f64; 6],
    wanted: Configuration,
) -> Option<Over> {
    let found = robot.configuration(q).ok()?;
    if found.cfx != wanted.cfx {
        return None;
    }
    let over = AXES.into_iter().zip([wanted.cf1, wanted.cf4, wanted.cf6]).map(|((axis, _), cf)| {
        let quarter = core::f64::consts::FRAC_PI_2;
        let begin = f64::from(cf) * quarter;
        let by = (begin - q[axis]).max(q[axis] - begin - quarter).max(0.0);
        Over { axis, angle: q[axis], by }
    });
    over.max_by(|a, b| a.by.total_cmp(&b.by))
}

/// A target that is a little over the edge of a quarter.
pub(in crate::rapid) fn near(over: &Over, wanted: Configuration, found: Configuration) -> Finding {
    let words = format!(
        "axis {} is at {:.2} deg, {:.2} deg over the quarter of its confdata {wanted}; it is met \
         with {found}",
        over.axis + 1,
        over.angle.to_degrees(),
        over.by.to_degrees(),
    );
    Finding::new(Code::NearConfdata, words).of_joint(over.axis + 1).with_value(over.by, 0.0)
}
