//! Tables whose structure is unknown, read in another way.

use crate::kinematics::chain::dh::{DhRow, Mdh, Sdh};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::any::AnyStructure;
use crate::kinematics::structure::arity::{Arity, Joints, StructureOf};
use crate::kinematics::thresholds::MOST_LENGTH;
use crate::report::{Columns, Reading};

/// Which Denavit-Hartenberg convention a table has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Convention {
    Modified,
    Standard,
}

/// Orders of columns that textbooks and programs have.
const ORDERS: [Columns; 8] = [
    ["alpha", "a", "d", "theta"],
    ["theta", "d", "a", "alpha"],
    ["d", "theta", "a", "alpha"],
    ["a", "alpha", "d", "theta"],
    ["a", "d", "alpha", "theta"],
    ["d", "a", "alpha", "theta"],
    ["theta", "d", "alpha", "a"],
    ["alpha", "a", "theta", "d"],
];

/// How far an angle of another reading may be from a right angle and still be one [rad]: 1.5708 is.
const SNAP: f64 = 1e-5;

/// The first other reading of rows in which the arm has a known structure: by the other
/// convention, in degrees, with columns in another order. None where there is none.
pub(crate) fn other_reading<const N: usize>(rows: &[DhRow; N], given: Convention) -> Option<Reading>
where
    Joints<N>: Arity<N>,
{
    let (other, name) = match given {
        Convention::Modified => (Convention::Standard, "standard"),
        Convention::Standard => (Convention::Modified, "modified"),
    };
    let mut readings = ORDERS.into_iter().flat_map(|columns| {
        [false, true].into_iter().flat_map(move |degrees| {
            let conventions = [(given, None), (other, Some(name))];
            conventions.into_iter().map(move |convention| (columns, degrees, convention))
        })
    });
    readings.find_map(|(columns, degrees, (convention, other))| {
        let rows = rows.map(|row| read(row, columns, degrees));
        let structure = structure(rows, convention)?;
        Some(Reading { columns, degrees, other, structure })
    })
}

/// A row whose numbers have these meanings.
fn read(row: DhRow, columns: Columns, degrees: bool) -> DhRow {
    let mut read = DhRow::default();
    let angle = |value: f64| if degrees { value.to_radians() } else { value };
    for (column, value) in columns.into_iter().zip(row.to_array()) {
        match column {
            "alpha" => read.alpha = angle(value),
            "a" => read.a = value,
            "d" => read.d = value,
            _ => read.theta = angle(value),
        }
    }
    read
}

/// Name of the known structure of a table.
fn structure<const N: usize>(rows: [DhRow; N], convention: Convention) -> Option<&'static str>
where
    Joints<N>: Arity<N>,
{
    let is_near = |row: &DhRow| row.to_array().iter().all(|number| number.abs() <= MOST_LENGTH);
    if !rows.iter().all(is_near) {
        return None;
    }
    let (base, flange) = (Pose::identity(), Pose::identity());
    let table = match convention {
        Convention::Modified => Mdh { base, rows, flange },
        Convention::Standard => Sdh { base, rows, flange }.into(),
    };
    let (_, structure) = StructureOf::<N>::recognize(&table.snapped(SNAP).ok()?);
    let arm = structure.arm();
    arm.unknown().is_none().then(|| arm.name())
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;
    use crate::kinematics::robot::Robot;

    const UR5E: [[f64; 4]; 6] = [
        [1.570_796_326_794_896_6, 0.0, 0.1625, 0.0],
        [0.0, -0.425, 0.0, 0.0],
        [0.0, -0.3922, 0.0, 0.0],
        [1.570_796_326_794_896_6, 0.0, 0.1333, 0.0],
        [-1.570_796_326_794_896_6, 0.0, 0.0997, 0.0],
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

    fn ends(built: Result<Robot<6>, crate::Error>, words: &str) {
        let refusal = built.unwrap_err().to_string();
        assert!(refusal.ends_with(words), "{refusal}");
    }

    #[test]
    fn a_table_in_the_other_convention_is_refused_with_its_name() {
        ends(modified(UR5E), "; as a standard table it has three parallel axes: use from_sdh");
        let rows = standard(UR5E).unwrap().mdh().rows.map(DhRow::to_array);
        ends(standard(rows), "; as a modified table it has three parallel axes: use from_mdh");
    }

    #[test]
    fn a_table_in_another_order_is_refused_with_the_order() {
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
    fn what_no_reading_makes_known_is_refused_without_one() {
        let mut rows = UR5E;
        (rows[2][0], rows[4][1]) = (0.3, 0.2);
        let refusal = modified(rows).unwrap_err().to_string();
        assert!(!refusal.contains("use from") && !refusal.contains("columns"), "{refusal}");
    }
}
