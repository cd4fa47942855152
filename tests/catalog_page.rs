//! The tables of docs/evidence/catalog.md match the catalog. With IRBKIN_WRITE=1
//! (`make docs`) they are written.

use std::fs;
use std::path::Path;

use irbkin::catalog;
use irbkin::catalog::{CatalogArm, CatalogGeometry, left_out};
use irbkin_motion::AnyArm;

/// Name of a table in the page, the columns that describe its geometry.
const TABLES: [(&str, &[&str]); 6] = [
    ("abb", &["a1", "a2", "c1", "c2", "c3", "c4"]),
    ("universal robots", &["d1", "a2", "a3", "d4", "d5", "d6"]),
    ("franka", &[]),
    ("yumi", &[]),
    ("five axes", &[]),
    ("offset wrists", &["d1", "a1", "a2", "a3", "d4", "d5", "a5", "d6"]),
];

/// The table that lists an arm, and its cells there.
fn geometry(arm: &CatalogArm) -> (&'static str, Vec<String>) {
    let lengths = |mm: [f64; 6]| mm.map(|length| length.to_string()).to_vec();
    match arm.geometry {
        CatalogGeometry::Abb { a1, a2, c1, c2, c3, c4, .. } => {
            ("abb", lengths([a1, a2, c1, c2, c3, c4]))
        }
        CatalogGeometry::ThreeParallel { d1, a2, a3, d4, d5, d6 } => {
            ("universal robots", lengths([d1, a2, a3, d4, d5, d6]))
        }
        CatalogGeometry::Crx { d1, a2, d4, d5, d6 } => {
            let lengths = [d1, 0.0, a2, 0.0, d4, d5, 0.0, d6];
            ("offset wrists", lengths.map(|length: f64| length.to_string()).to_vec())
        }
        CatalogGeometry::Mdh(ref rows) => match rows[..] {
            [one, two, three, four, five, six] => {
                let lengths = [one[2], two[1], three[1], four[1], four[2], five[2], six[1], six[2]];
                ("offset wrists", lengths.map(|length| length.to_string()).to_vec())
            }
            _ if arm.maker == "ABB" => ("yumi", Vec::new()),
            _ => ("franka", Vec::new()),
        },
        CatalogGeometry::StandingMdh { .. } => ("yumi", Vec::new()),
        CatalogGeometry::Joints { .. } => ("five axes", Vec::new()),
        _ => panic!("{} has no row", arm.name),
    }
}

/// The first columns of a table. The name of an ABB arm has its payload and its reach.
fn head(table: &str) -> &'static [&'static str] {
    if table == "abb" { &["arm"] } else { &["arm", "payload [kg]", "reach [m]"] }
}

fn row(cells: impl IntoIterator<Item = String>) -> String {
    format!("| {} |\n", cells.into_iter().collect::<Vec<_>>().join(" | "))
}

/// Payload and reach, if the table has them.
fn figures(table: &str, arm: &CatalogArm) -> Vec<String> {
    let known =
        |figure: Option<f64>| figure.map_or_else(|| "-".to_owned(), |figure| figure.to_string());
    if table == "abb" { Vec::new() } else { vec![known(arm.payload), known(arm.reach)] }
}

/// How far 95 % of the surface of the capsules of the worst link is outside its mesh at most [mm].
fn body(arm: &CatalogArm) -> String {
    let robot = AnyArm::from_catalog(arm).unwrap();
    let body = match &robot {
        AnyArm::Six(robot) => robot.body().unwrap(),
        AnyArm::Seven(robot) => robot.body().unwrap(),
        AnyArm::Five(robot) => robot.body().unwrap(),
    };
    if body.is_approximate() {
        return "approximate".to_owned();
    }
    format!("{:.0}", 1e3 * body.excess().iter().copied().fold(0.0, f64::max))
}

/// Values of the arms of a row, or the one that all have.
fn joined(values: &[String]) -> String {
    if values.iter().all(|value| *value == values[0]) {
        return values[0].clone();
    }
    values.join(", ")
}

/// A row for all arms with the same cells: their names, the cells, their bodies, the number of their
/// sources.
fn table(name: &str, columns: &[&str]) -> String {
    let heads = || head(name).iter().chain(columns).chain(&["body [mm]", "sources"]);
    let mut table = row(heads().map(|&head| head.to_owned()))
        + &format!("|{}\n", "---|".repeat(heads().count()));
    let mut rows: Vec<(Vec<&str>, Vec<String>, [Vec<_>; 2])> = Vec::new();
    for arm in catalog() {
        let (place, lengths) = geometry(&arm);
        if place != name {
            continue;
        }
        let cells = [figures(name, &arm), lengths].concat();
        let [body, sources] = [body(&arm), arm.sources.to_string()];
        if let Some((names, _, own)) = rows.iter_mut().find(|(_, known, _)| *known == cells) {
            names.push(arm.name);
            own[0].push(body);
            own[1].push(sources);
        } else {
            rows.push((vec![arm.name], cells, [vec![body], vec![sources]]));
        }
    }
    for (names, cells, [bodies, counts]) in rows {
        let last = vec![joined(&bodies), counts.join(", ")];
        table += &row([vec![names.join(", ")], cells, last].concat());
    }
    table
}

fn left_out_table() -> String {
    let rows = left_out().map(|arm| row([arm.name.to_owned(), arm.reason.to_owned()]));
    format!("| arm | why |\n|---|---|\n{}", rows.collect::<String>())
}

#[test]
fn the_tables_of_the_page_are_those_of_the_catalog() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/evidence/catalog.md");
    let page = fs::read_to_string(&path).unwrap();
    let mut made = page.clone();
    let tables = TABLES.map(|(name, columns)| (name, table(name, columns)));
    for (name, table) in tables.into_iter().chain([("left out", left_out_table())]) {
        let start = format!("<!-- {name}: written by make docs -->\n");
        let (before, rest) = made.split_once(&start).unwrap();
        let (_, after) = rest.split_once("<!-- end -->").unwrap();
        made = format!("{before}{start}\n{table}\n<!-- end -->{after}");
    }
    if std::env::var("IRBKIN_WRITE").is_ok_and(|write| write == "1") {
        fs::write(&path, made).unwrap();
    } else {
        assert!(
            page == made,
            "docs/evidence/catalog.md is not what the catalog says: make docs writes it"
        );
    }
}
