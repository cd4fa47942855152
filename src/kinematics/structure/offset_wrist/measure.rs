//! Recognizes an offset wrist in a modified Denavit-Hartenberg table.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use alloc::boxed::Box;

use super::geometry::{Constants, Lengths, OffsetWrist, Twists};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::axes::Link;
use crate::kinematics::chain::dh::{DhRow, Mdh};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::general::General;
use crate::kinematics::thresholds::{LEAST_TWIST_SIN, POSITION_ROUNDING};
use crate::report::{OFFSET_WRIST, Pattern, Relation, UnknownStructure};

/// The conditions of an offset wrist.
pub(crate) static PATTERN: Pattern = Pattern {
    name: OFFSET_WRIST,
    title: "an offset wrist (axes 2 and 3 parallel, axes 4 and 5 meeting)",
    conditions: &[
        (Relation::Perpendicular, (1, 2)),
        (Relation::Parallel, (2, 3)),
        (Relation::Meeting, (4, 5)),
    ],
};

/// Measure the geometry of a table (docs/theory/offset_wrist.md, section 1).
pub(super) fn measure(mdh: &Mdh<6>) -> Result<OffsetWrist, UnknownStructure> {
    let rows = &mdh.rows;
    let links = rows.map(Link::new);
    let (s1, e) = (links[1].sin_alpha, links[2].cos_alpha);
    let (sin_3, cos_3) = (links[3].sin_alpha, links[3].cos_alpha);
    // Quarter turns on from x3 in the plane of the arm, seen with x1 to the right and z1 up.
    let m = -(s1 * e) * sin_3;
    let (along, across) = (links[3].a, m * links[3].d);
    let forearm = along.hypot(across);
    PATTERN.check_lengths([
        ("upper arm (distance of axes 2 and 3)", links[2].a.abs()),
        ("forearm (distance of axis 3 from the wrist point)", forearm),
    ])?;
    for (field, sin) in [
        ("forearm times the sine of the angle between axes 3 and 4", sin_3),
        ("forearm times the sine of the angle between axes 4 and 5", links[4].sin_alpha),
        // Joint 6 would not turn axis 5, nor the condition of its direction.
        ("forearm times the sine of the angle between axes 5 and 6", links[5].sin_alpha),
    ] {
        let (value, bound) = (forearm * sin.abs(), forearm * LEAST_TWIST_SIN);
        if value < bound {
            return Err(UnknownStructure::too_short(&PATTERN, (field, value), bound));
        }
    }
    let v = [along / forearm, across / forearm];
    let lateral = [links[1].d, e * links[2].d, e * cos_3 * links[3].d];
    let extent = rows.iter().map(|row| row.a.abs() + row.d.abs()).sum::<f64>();
    let b = lateral.iter().sum::<f64>();
    let b = if b.abs() <= POSITION_ROUNDING * extent { 0.0 } else { b };
    let [a1, cos_4] = [links[1].a, links[4].cos_alpha];
    let is_even = v[0] == 0.0 || (v[1] == 0.0 && cos_4 == 0.0);
    let is_square = is_even && [a1, b, cos_3].iter().all(|term| *term == 0.0);
    let lengths = Lengths {
        a1,
        upper: links[2].a,
        forearm,
        v,
        b,
        s1,
        e,
        cos_3,
        cos_4,
        m,
        a5: links[5].a,
        d5: links[4].d,
        sin_5: links[5].sin_alpha,
        cos_5: links[5].cos_alpha,
        circle: links[5].a.hypot(links[4].d * links[5].sin_alpha),
        extent,
        is_square,
    };
    let mut bare = *rows;
    bare[0] = DhRow::default();
    (bare[5].d, bare[5].theta) = (0.0, 0.0);
    for row in &mut bare {
        row.theta = 0.0;
    }
    let chain = Chain::new(Mdh { base: Pose::identity(), rows: bare, flange: Pose::identity() });
    let twists = Twists {
        sin_3,
        cos_3,
        sin_4: links[4].sin_alpha,
        sin_5: links[5].sin_alpha,
        cos_5: links[5].cos_alpha,
    };
    let general = Box::new(General::of(mdh)?);
    let constants = Constants { lengths, twists, closure: *general.closure() };
    Ok(OffsetWrist { chain, constants, general })
}
