//! Tables whose structure is unknown, read in another way.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::chain::dh::{DhRow, Mdh, Sdh};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::known::{Known, closed_form};
use crate::kinematics::thresholds::MOST_LENGTH;
use crate::report::{Columns, Convention, ORDERS, Reading};

/// How far an angle of another reading may be from a right angle and still be one [rad]: 1.5708 is.
const SNAP: f64 = 1e-5;

/// How far an angle may be from a multiple of 15 deg and still be one that was written as it [rad]:
/// text with four decimals.
const WRITTEN: f64 = 1e-4;

/// The first other reading of rows in which the arm has a known structure: by the other
/// convention, or with columns in another order. `None` where there is no such reading.
///
/// A column of lengths, read as theta, says nothing against a structure. So another order is looked
/// for only where the angles of the given one are not as tables have them, and the angles of
/// the other are.
pub(crate) fn other_reading<const N: usize>(
    rows: &[DhRow; N],
    given: Convention,
    known: &Known<N>,
) -> Option<Reading> {
    let other = match given {
        Convention::Modified => Convention::Standard,
        Convention::Standard => Convention::Modified,
    };
    let orders = if has_usual_angles(rows) { &ORDERS[..1] } else { &ORDERS[..] };
    let mut readings = (0..).zip(orders).flat_map(|(order, columns)| {
        let conventions = [(given, None), (other, Some(other))];
        conventions.into_iter().map(move |convention| (order, *columns, convention))
    });
    readings.find_map(|(order, columns, (convention, other))| {
        let rows = rows.map(|row| read(row, columns));
        if order > 0 && !has_usual_angles(&rows) {
            return None;
        }
        let structure = structure(rows, convention, known)?;
        Some(Reading { order, other, structure })
    })
}

/// Whether every alpha and theta is a multiple of 15 deg, and not every axis parallel.
fn has_usual_angles(rows: &[DhRow]) -> bool {
    let is_multiple = |angle: f64| {
        let steps = angle / (PI / 12.0);
        (steps - steps.round()).abs() * (PI / 12.0) <= WRITTEN
    };
    rows.iter().all(|row| is_multiple(row.alpha) && is_multiple(row.theta))
        && rows.iter().filter(|row| row.alpha.abs() > WRITTEN).count() > 1
}

/// A row whose numbers have these meanings.
fn read(row: DhRow, columns: Columns) -> DhRow {
    let mut read = DhRow::default();
    for (column, value) in columns.into_iter().zip(row.to_array()) {
        match column {
            "alpha" => read.alpha = value,
            "a" => read.a = value,
            "d" => read.d = value,
            _ => read.theta = value,
        }
    }
    read
}

/// Name of the known structure of a table.
fn structure<const N: usize>(
    rows: [DhRow; N],
    convention: Convention,
    known: &Known<N>,
) -> Option<&'static str> {
    let is_near = |row: &DhRow| row.to_array().iter().all(|number| number.abs() <= MOST_LENGTH);
    if !rows.iter().all(is_near) {
        return None;
    }
    let (base, flange) = (Pose::identity(), Pose::identity());
    let table = match convention {
        Convention::Modified => Mdh { base, rows, flange },
        Convention::Standard => Sdh { base, rows, flange }.into(),
    };
    let solved = closed_form(&table.snapped(SNAP).ok()?, known).ok();
    solved.map(|(_, inverse)| inverse.name())
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_2;
    use std::string::ToString;

    use super::*;
    use crate::kinematics::robot::Robot;

    const UR5E: [[f64; 4]; 6] = [
        [FRAC_PI_2, 0.0, 0.1625, 0.0],
        [0.0, -0.425, 0.0, 0.0],
        [0.0, -0.3922, 0.0, 0.0],
        [FRAC_PI_2, 0.0, 0.1333, 0.0],
        [-FRAC_PI_2, 0.0, 0.0997, 0.0],
        [0.0, 0.0, 0.0996, 0.0],
    ];

    fn modified(rows: [[f64; 4]; 6]) -> Result<Robot<6>, crate::Error> {
        let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
        Robot::from_mdh(Mdh { base: Pose::identity(), rows, flange: Pose::identity() })
    }

    fn standard(rows: [[f64; 4]; 6]) -> Result<Robot<6>, crate::Error> {
        let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
        Robot::from_sdh(Sdh { base: Pose::identity(), rows, flange: Pose::identity() })
    }

    /// The words on an arm without a closed form: of one that is solved, or of one that is refused.
    fn noted(built: Result<Robot<6>, crate::Error>) -> std::string::String {
        match built {
            Ok(robot) => robot.missing_form().unwrap().to_string(),
            Err(refusal) => refusal.to_string(),
        }
    }

    fn ends(built: Result<Robot<6>, crate::Error>, words: &str) {
        let missing = noted(built);
        assert!(missing.ends_with(words), "{missing}");
    }

    #[test]
    fn a_table_in_the_other_convention_is_noted_with_its_name() {
        ends(modified(UR5E), "; as a standard table it has three parallel axes: use from_sdh");
        let rows = standard(UR5E).unwrap().mdh().rows.map(DhRow::to_array);
        ends(standard(rows), "; as a modified table it has three parallel axes: use from_mdh");
    }

    #[test]
    fn a_table_in_another_order_is_noted_with_the_order() {
        let rows = UR5E.map(|[alpha, a, d, theta]| [d, theta, a, alpha]);
        ends(
            standard(rows),
            "; with its columns as d, theta, a, alpha it has three parallel axes: reorder them to \
             alpha, a, d, theta",
        );
        ends(
            modified(rows),
            "; with its columns as d, theta, a, alpha, as a standard table it has three parallel \
             axes: reorder them to alpha, a, d, theta and use from_sdh",
        );
    }

    #[test]
    fn what_no_reading_makes_known_is_noted_without_one() {
        let mut rows = UR5E;
        (rows[2][0], rows[4][1]) = (0.3, 0.2);
        let missing = noted(modified(rows));
        assert!(!missing.contains("use from") && !missing.contains("columns"), "{missing}");
        // A wrist with an offset along axis 5: with d read as theta it would be a spherical one.
        let quarter = FRAC_PI_2;
        let offset = [
            [0.0, 0.0, 0.445, 0.0],
            [-quarter, 0.15, 0.0, -quarter],
            [0.0, 0.7, 0.0, 0.0],
            [-quarter, 0.115, 0.795, 0.0],
            [quarter, 0.0, 0.13, 0.0],
            [-quarter, 0.0, 0.085, 2.0 * quarter],
        ];
        let missing = noted(modified(offset));
        assert!(!missing.contains("use from") && !missing.contains("columns"), "{missing}");
    }
}
