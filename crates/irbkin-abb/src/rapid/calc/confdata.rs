//! How far joints are from the quarters of a configuration.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::rapid::data::finding::{Code, Finding};
use irbkin::{Configuration, ConfigurationRequest, Pose, Robot};

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
    let (_, zero) = robot.counted_joints().ok()?;
    over_quarters_from(zero, robot, q, wanted)
}

/// As above, with a quarter 0 that begins at an angle [rad].
fn over_quarters_from<const N: usize>(
    zero: f64,
    robot: &Robot<N>,
    q: &[f64; N],
    wanted: Configuration,
) -> Option<Over> {
    let found = robot.configuration(q).ok()?;
    if found.cfx != wanted.cfx {
        return None;
    }
    let (joints, _) = robot.counted_joints().ok()?;
    let quarters = [wanted.cf1, wanted.cf4, wanted.cf6];
    let over = AXES.into_iter().zip(joints).zip(quarters).map(|((axis, joint), cf)| {
        let quarter = core::f64::consts::FRAC_PI_2;
        let (begin, angle) = (zero + f64::from(cf) * quarter, q[joint]);
        let by = (begin - angle).max(angle - begin - quarter).max(0.0);
        Over { axis, joint: joint + 1, angle, by }
    });
    over.max_by(|a, b| a.by.total_cmp(&b.by))
}

/// Whether the cfx of a `YuMi` has an old form, of digits 0 and 1.
pub(in crate::rapid) fn is_old_form<const N: usize>(cfx: i32) -> bool {
    let mut digits = [100, 10, 1].map(|place| cfx / place % 10).into_iter();
    N == 7 && (10..=111).contains(&cfx) && digits.all(|it| it <= 1)
}

/// The confdata in the new form of a flange pose with an old one, whose quarters begin at multiples
/// of 90 deg; `None` but for cfx 11, which is 4: docs/guide/abb.md has the evidence.
pub(in crate::rapid) fn of_old_form<const N: usize>(
    robot: &Robot<N>,
    pose: &Pose,
    old: &ConfigurationRequest<N>,
) -> Option<Configuration> {
    let wanted = Configuration { cfx: 4, ..old.configuration };
    if old.configuration.cfx != 11 {
        return None;
    }
    let inside = robot.ik_inside_at(pose, old.arm_angle).unwrap_or_default();
    let near = inside.into_iter().filter_map(|q| {
        let over = over_quarters_from(0.0, robot, &q, wanted)?;
        // As of a new one that is met: up to a quarter.
        (over.by <= core::f64::consts::FRAC_PI_2).then_some((q, over.by))
    });
    let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1));
    let found = nearest.and_then(|(q, _)| robot.configuration(&q).ok());
    Some(found.unwrap_or(wanted))
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
