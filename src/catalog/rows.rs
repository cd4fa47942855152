//! Reads the rows of `arms.txt`, whose head describes the fields.

use alloc::vec::Vec;

use nalgebra::Vector3;

use super::{AngleUnit, CatalogArm, CatalogGeometry, Linkage};

const ARMS: &str = include_str!("arms.txt");

/// A row of which only name and maker have been read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) maker: &'static str,
    text: &'static str,
}

/// The row of each arm, in the order of the catalog.
pub(super) fn rows() -> impl Iterator<Item = Row> {
    ARMS.split("\n\n").filter(|text| !text.starts_with('#')).filter_map(Row::of)
}

impl Row {
    fn of(text: &'static str) -> Option<Self> {
        let mut fields = fields(text);
        Some(Self { name: fields.next()?, maker: fields.next()?, text })
    }

    /// The arm; `None` if a field cannot be read, which a test excludes.
    pub(super) fn arm(self) -> Option<CatalogArm> {
        let mut arm = CatalogArm {
            name: self.name,
            maker: self.maker,
            payload: None,
            reach: None,
            geometry: CatalogGeometry::Mdh(Vec::new()),
            angles: AngleUnit::Degrees,
            limits: Vec::new(),
            max_velocity: None,
            max_acceleration: None,
            sources: 0,
            provenance: "",
        };
        for field in fields(self.text).skip(2) {
            let (keyword, values) = field.split_once(' ').unwrap_or((field, ""));
            match keyword {
                "payload" => arm.payload = Some(values.parse().ok()?),
                "reach" => arm.reach = Some(values.parse().ok()?),
                "radians" => arm.angles = AngleUnit::Radians,
                "limits" => arm.limits = values.split(' ').map(limit).collect::<Option<_>>()?,
                "speeds" => arm.max_velocity = Some(numbers(values)?),
                "accelerations" => arm.max_acceleration = Some(numbers(values)?),
                "sources" => {
                    let (count, provenance) = values.split_once(": ")?;
                    arm.sources = count.parse().ok()?;
                    arm.provenance = provenance;
                }
                _ => read_geometry(&mut arm.geometry, keyword, values)?,
            }
        }
        Some(arm)
    }
}

fn read_geometry(geometry: &mut CatalogGeometry, keyword: &str, values: &str) -> Option<()> {
    match (keyword, geometry) {
        ("opw", geometry) => {
            let [a1, a2, c1, c2, c3, c4] = array(values)?;
            *geometry = CatalogGeometry::Abb { a1, a2, c1, c2, c3, c4, linkage: Linkage::None };
        }
        ("linkage", CatalogGeometry::Abb { linkage, .. }) => {
            *linkage = match values {
                "unknown" => Linkage::LimitsUnknown,
                limits => Linkage::Limits(limit(limits)?),
            };
        }
        ("three-parallel", geometry) => {
            let [d1, a2, a3, d4, d5, d6] = array(values)?;
            *geometry = CatalogGeometry::ThreeParallel { d1, a2, a3, d4, d5, d6 };
        }
        ("crx", geometry) => {
            let [d1, a2, d4, d5, d6] = array(values)?;
            *geometry = CatalogGeometry::Crx { d1, a2, d4, d5, d6 };
        }
        ("standing", geometry) => {
            let (xyz, turns) = values.split_once(", ")?;
            let (xyz, turns) = (array(xyz)?, array(turns)?);
            *geometry = CatalogGeometry::StandingMdh { xyz, turns, rows: Vec::new() };
        }
        ("mdh", CatalogGeometry::Mdh(rows) | CatalogGeometry::StandingMdh { rows, .. }) => {
            *rows = values.split(", ").map(array).collect::<Option<_>>()?;
        }
        ("joints", geometry) => {
            let origins = values.split(", ").map(joint).collect::<Option<_>>()?;
            *geometry = CatalogGeometry::Joints { origins, tip: [0.0; 6] };
        }
        ("tip", CatalogGeometry::Joints { tip, .. }) => *tip = array(values)?,
        _ => return None,
    }
    Some(())
}

/// The origin of a joint, and its axis: x, y or z.
fn joint(text: &str) -> Option<([f64; 6], Vector3<f64>)> {
    let (origin, axis) = text.rsplit_once(' ')?;
    let axis = match axis {
        "x" => Vector3::x(),
        "y" => Vector3::y(),
        "z" => Vector3::z(),
        _ => return None,
    };
    Some((array(origin)?, axis))
}

fn fields(text: &str) -> impl Iterator<Item = &str> {
    text.lines().flat_map(|line| line.split(" | "))
}

/// (lower, upper), written "-63..110", or "+-180" if they differ in sign alone.
fn limit(text: &str) -> Option<[f64; 2]> {
    if let Some(limit) = text.strip_prefix("+-") {
        let limit: f64 = limit.parse().ok()?;
        return Some([-limit, limit]);
    }
    let (lower, upper) = text.split_once("..")?;
    Some([lower.parse().ok()?, upper.parse().ok()?])
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(' ').map(|number| number.parse().ok()).collect()
}

fn array<const N: usize>(text: &str) -> Option<[f64; N]> {
    numbers(text)?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_read() {
        let arms = ARMS.split("\n\n").filter(|text| !text.starts_with('#'));
        for text in arms {
            assert!(Row::of(text).and_then(Row::arm).is_some(), "{text}");
        }
    }

    #[test]
    fn a_row_with_a_field_that_cannot_be_read_is_none() {
        let row = |fields| Row { name: "", maker: "", text: fields }.arm();
        assert!(row("A | B | payload 3\nlimits +-180 -90..90").is_some());
        for fields in [
            "payload",
            "payload 3 kg",
            "height 3",
            "limits 180",
            "limits -90.. 90",
            "speeds 180,",
            "opw 1 2 3 4 5",
            "linkage 70",
            "mdh 0 0 0",
            "crx 1 2 3 4 5 | mdh 0 0 0 0",
        ] {
            let text = std::format!("A | B | {fields}");
            assert!(row(text.leak()).is_none(), "{fields}");
        }
    }
}
