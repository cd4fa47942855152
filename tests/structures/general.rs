//! Arms of six joints in general.

use irbkin::{DhRow, Mdh, Pose, Robot, Sdh};

use super::by_table::{structure as of_tables, subject, table};
use super::{Structure, Subject};
use crate::rng::Rng;

/// Tables that others solved completely.
const CASES: &str = include_str!("../data/general_6r.json");

/// Errors of a calibrated table: [rad], [m].
const ERRORS: [f64; 2] = [2e-3, 1e-3];

/// Arms that are drawn.
const RANDOM: usize = 12;

pub fn structure() -> Structure<6> {
    let mut rng = Rng::new(0x6e6e);
    let makers = ["IRB 2600-12/1.65", "UR5e", "CRB 15000-5/0.95", "IRB 140-6/0.81", "xArm6"];
    let makers = makers.map(|name| calibrated(name, &mut rng));
    let drawn = ["random 0", "random 1"].map(|name| subject(name, random(&mut rng)));
    let cases = [("Manseur-Doty", "md"), ("random of others", "rand0")]
        .map(|(name, key)| subject(name, case(key)));
    let yumi = [3, 5, 7].map(|joint| yumi_given(joint, 0.4));
    let subjects = makers.into_iter().chain(drawn).chain(cases).chain(yumi).collect();
    of_tables("general", subjects, (0..RANDOM).map(move |_| random(&mut rng)))
}

/// An arm of the catalog as a calibration finds it, with its limits.
fn calibrated(name: &str, rng: &mut Rng) -> Subject<6> {
    let robot = Robot::<6>::named(name).unwrap();
    let mut mdh = robot.mdh().clone();
    let [turn, length] = ERRORS;
    for row in &mut mdh.rows {
        row.alpha += rng.between(-turn, turn);
        row.a += rng.between(-length, length);
        row.d += rng.between(-length, length);
        row.theta += rng.between(-turn, turn);
    }
    subject(&format!("{name}, calibrated"), mdh).with_robot(|it| it.with_limits(*robot.limits()))
}

/// The six other joints of a YuMi.
fn yumi_given(joint: usize, angle: f64) -> Subject<6> {
    let yumi = Robot::<7>::named("IRB 14050").unwrap();
    let six = yumi.locked(joint, angle).unwrap().six_joints().unwrap().unwrap();
    subject(&format!("YuMi, joint {joint} given"), six.mdh().clone()).with_robot(|_| six)
}

/// A standard table of the cases, without its last twist and length, which are a tool's.
fn case(key: &str) -> Mdh<6> {
    let cases: serde_json::Value = serde_json::from_str(CASES).unwrap();
    let rows: [[f64; 4]; 6] = serde_json::from_value(cases[key]["rows"].clone()).unwrap();
    let rows =
        rows.map(|[a, alpha, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta.to_radians()));
    Sdh { base: Pose::identity(), rows, flange: Pose::identity() }.into()
}

/// Any arm.
fn random(rng: &mut Rng) -> Mdh<6> {
    table(std::array::from_fn(|_| {
        let alpha = rng.sign() * rng.between(15.0, 165.0);
        let lengths = [(); 2].map(|()| rng.between(-0.5, 0.5));
        [alpha, lengths[0], lengths[1], rng.angle().to_degrees()]
    }))
}
