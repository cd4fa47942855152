//! How far joints are from the quarters of a configuration.

use alloc::format;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::Robot;
use crate::rapid::data::finding::{Code, Finding};
use crate::report::Configuration;

/// Axes that a configuration counts, by ABB's numbers.
pub(in crate::rapid) const AXES: [usize; 3] = [1, 4, 6];

/// The axis that is farthest over the edge of its quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::rapid) struct Over {
    /// By ABB's number.
    pub(in crate::rapid) axis: usize,
    /// From 1.
    pub(in crate::rapid) joint: usize,
    /// Its angle [rad].
    pub(in crate::rapid) angle: f64,
    /// How far it is over the edge [rad].
    pub(in crate::rapid) by: f64,
}

/// How far joints [rad] are over the quarters of a configuration; `None` if they are on another
/// branch.
pub(in crate::rapid) fn over_quarters<const N: usize>(
    robot: &Robot<N>,
    q: &[f64; N],
    wanted: Configuration,
) -> Option<Over> {
    let found = robot.configuration(q).ok()?;
    if found.cfx != wanted.cfx {
        return None;
    }
    let (joints, zero) = robot.counted_joints().ok()?;
    let quarters = [wanted.cf1, wanted.cf4, wanted.cf6];
    let over = AXES.into_iter().zip(joints).zip(quarters).map(|((axis, joint), cf)| {
        let quarter = core::f64::consts::FRAC_PI_2;
        let (begin, angle) = (zero + f64::from(cf) * quarter, q[joint]);
        let by = (begin - angle).max(angle - begin - quarter).max(0.0);
        Over { axis, joint: joint + 1, angle, by }
    });
    over.max_by(|a, b| a.by.total_cmp(&b.by))
}

/// The confdata that is meant by an old one of a `YuMi`, whose cfx has digits that are bits, as 11:
/// docs/guide/abb.md has the evidence.
pub(in crate::rapid) fn of_old_form<const N: usize>(old: Configuration) -> Option<Configuration> {
    let digits = [100, 10, 1].map(|place| old.cfx / place % 10);
    let is_old = N == 7 && (10..=111).contains(&old.cfx) && digits.iter().all(|it| *it <= 1);
    let cfx = digits.iter().fold(0, |bits, digit| 2 * bits + digit);
    is_old.then_some(Configuration { cfx, ..old })
}

/// A target that is a little over the edge of a quarter.
pub(in crate::rapid) fn near(over: &Over, wanted: Configuration, found: Configuration) -> Finding {
    let words = format!(
        "axis {} is at {:.2} deg, {:.2} deg over the quarter of its confdata {wanted}; it is met \
         with {found}",
        over.axis,
        over.angle.to_degrees(),
        over.by.to_degrees(),
    );
    let finding = Finding::new(Code::NearConfdata, words).caused_by(format!("{wanted}{found}"));
    finding.of_joint(over.joint).with_value(over.by, 0.0)
}
