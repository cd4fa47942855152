//! Prints what the tests in C compare the library's answers with, as a header: inputs, and what the
//! Rust crate answers to them.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

use std::fmt::Display;

use irbkin::batch::Batch;
use irbkin::follow::{Break, Follower};
use irbkin::{
    Configuration, JacobianFrame, JointLimits, Mdh, OpwParameters, Pose, Robot, Sdh, Status, pose,
};
use irbkin_motion::Arm;
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;
use irbkin_motion::plan::{PlanError, PlanOptions, ToolAxis, ToolRotation};

const URDF: &str = include_str!("../../../tests/data/ur5e.urdf");

/// Numbers in [-1, 1): a linear congruential generator.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / f64::from(1_u32 << 31) - 1.0
    }

    fn array<const N: usize>(&mut self) -> [f64; N] {
        core::array::from_fn(|_| self.next())
    }
}

fn list<T: Display>(values: impl IntoIterator<Item = T>) -> String {
    values.into_iter().map(|value| value.to_string() + ",").collect()
}

/// Digits that are read back as the same numbers.
fn numbers<'a>(values: impl IntoIterator<Item = &'a f64>) -> String {
    let digits = |value: &f64| match value {
        value if value.is_nan() => "NAN".to_owned(),
        value if value.is_infinite() => format!("{}INFINITY", if *value < 0.0 { "-" } else { "" }),
        value => format!("{value:e}"),
    };
    list(values.into_iter().map(digits))
}

fn print(name: &str, values: &[f64]) {
    println!("static const double {name}[] = {{{}}};", numbers(values));
}

/// An arm at joint angles: what C must answer, too.
fn print_arm<const N: usize>(robot: &Robot<N>, q: &[f64; N]) {
    let pose = robot.fk(q);
    let q7 = q.get(6).copied();
    let solutions = robot.ik_with(&pose, q7).unwrap();
    let mut all = vec![f64::NAN; N * robot.slot_count()];
    for solution in &solutions {
        all[N * solution.slot.index()..][..N].copy_from_slice(&solution.q);
    }
    let seed = q.map(|angle| angle + 0.05);
    let mut weights = [1.0; N];
    weights[2] = 0.25;
    let nearest = robot.ik_nearest(&pose, &seed, &weights).unwrap().q;
    let jacobians = [JacobianFrame::Base, JacobianFrame::Tool]
        .map(|frame| numbers(robot.jacobian(q, frame).transpose().as_slice()));
    println!(
        "{{{:?}, {N}, {}, {{{}}}, {{{}}}, {{{{{}}}, {{{}}}}}, {{{}}}, {{{}}}, {}, {:?}, {{{}}}, \
         {{{}}}, {{{}}}, {{{}}}}},",
        robot.name(),
        robot.slot_count(),
        numbers(q),
        numbers(&pose::to_rows(&pose)),
        jacobians[0],
        jacobians[1],
        numbers(&all),
        list(solutions.status().iter().map(Status::bits)),
        solutions.len(),
        solutions.explain().to_string(),
        numbers(&seed),
        numbers(&weights),
        numbers(&nearest),
        numbers(robot.limits().to_array().as_flattened()),
    );
}

/// Poses on a line, and what `follow` and `plan` answer.
fn print_path(name: &str, robot: &Arm<6>, path: &[Pose], seed: &[f64; 6], cell: &Cell) {
    let rows: Vec<f64> = path.iter().flat_map(pose::to_rows).collect();
    print(&format!("{name}_POSES"), &rows);
    let mut follower = Follower::new(robot, seed, &[1.0; 6]).unwrap();
    let steps: Vec<_> = path.iter().map(|pose| follower.step(pose).unwrap()).collect();
    let q = steps.iter().flat_map(|(found, _)| found.map_or([f64::NAN; 6], |found| found.q));
    print(&format!("{name}_FOLLOWED"), &q.collect::<Vec<_>>());
    let breaks = steps.iter().map(|(_, broken)| u8::from(broken.is_some()));
    println!("static const bool {name}_BREAKS[] = {{{}}};", list(breaks));
    let message = steps.iter().enumerate().find_map(|(index, (_, broken))| {
        broken.map(|reason| Break { pose_index: index, reason }.to_string())
    });
    println!("static const char {name}_BREAK[] = {:?};", message.unwrap_or_default());
    let options = PlanOptions {
        rotation: Some(ToolRotation::new(9, -0.5, 0.5, ToolAxis::Z).unwrap()),
        cell: Some(cell.clone().into()),
        ..PlanOptions::default()
    };
    let (plan, message) = match robot.plan(path, &options) {
        Ok(plan) => (plan, String::new()),
        Err(PlanError::NoPlan(gap)) => (gap.plan.clone(), gap.to_string()),
        Err(error) => panic!("{error}"),
    };
    let q: Vec<f64> = plan.q.iter().flat_map(|q| q.unwrap_or([f64::NAN; 6])).collect();
    print(&format!("{name}_PLANNED"), &q);
    print(&format!("{name}_ANGLES"), &plan.tool_angle);
    let slots = plan.slot.iter().map(|slot| slot.map_or(-1, |slot| i32::try_from(slot).unwrap()));
    println!("static const int32_t {name}_SLOTS[] = {{{}}};", list(slots));
    println!(
        "static const IrbkinPlanReport {name}_REPORT = {{{:e}, {:e}, {}, {}}};",
        plan.cost,
        plan.bottleneck,
        plan.breaks.len(),
        i32::from(plan.certified)
    );
    println!("static const char {name}_NO_PLAN[] = {message:?};");
}

fn main() {
    let irb = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let panda = Arm::<7>::named("Panda").unwrap();
    let urdf = Arm::<6>::from_urdf(URDF, None, Some("tool0")).unwrap();
    let mdh = Mdh { base: Pose::identity(), flange: Pose::identity(), ..irb.mdh().clone() };
    let sdh =
        Sdh { base: Pose::identity(), flange: Pose::identity(), rows: Sdh::from(mdh.clone()).rows };
    let opw = OpwParameters::abb(0.1, -0.1, 0.6, 0.7, 0.8, 0.2);
    let tool = pose::from_euler_zyx([0.05, 0.0, 0.35], [0.1, 0.2, 0.3]).unwrap();
    let base = pose::from_euler_zyx([1.0, 2.0, 0.5], [0.7, 0.0, 0.0]).unwrap();
    let limits = [
        [-1.0, 1.5],
        [-1.2, 1.2],
        [f64::NEG_INFINITY, f64::INFINITY],
        [-3.0, 3.0],
        [-2.0, 2.0],
        [-7.0, 7.0],
    ];
    let changed = irb.robot().clone().with_tool(&tool).unwrap().with_base(&base).unwrap();
    let changed = changed.with_limits(JointLimits::new(limits).unwrap());

    println!("// Printed by crates/irbkin-capi/examples/expected.rs.");
    print("MDH", &mdh.rows.iter().flat_map(|row| row.to_array()).collect::<Vec<_>>());
    print("SDH", &sdh.rows.iter().flat_map(|row| row.to_array()).collect::<Vec<_>>());
    println!(
        "static const IrbkinOpwParameters OPW = {{{}, {{{}}}, {{{}}}}};",
        numbers(&[opw.a1, opw.a2, opw.b, opw.c1, opw.c2, opw.c3, opw.c4]).trim_end_matches(','),
        numbers(&opw.offsets),
        list(opw.signs)
    );
    print("TOOL", &pose::to_rows(&tool));
    print("BASE", &pose::to_rows(&base));
    print("LIMITS", limits.as_flattened());
    println!("static const Arm ARMS[] = {{");
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    print_arm(&irb, &q);
    print_arm(&panda, &[0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6]);
    print_arm(&urdf, &[0.3, -1.2, 1.4, -0.5, 0.6, 0.7]);
    print_arm(&Robot::from_mdh(mdh).unwrap(), &q);
    print_arm(&Robot::from_sdh(sdh).unwrap(), &q);
    print_arm(&Robot::from_opw(opw).unwrap(), &q);
    print_arm(&changed, &q);
    // At the wrist singularity, twins are merged.
    print_arm(&irb, &[0.3, -0.2, 0.4, 0.5, 0.0, 0.7]);
    println!("}};");

    // A row that is no pose is among them; enough rows for a second thread.
    let mut random = Numbers(1);
    let joints: Vec<f64> = (0..4200).flat_map(|_| random.array::<6>()).collect();
    let (mut batch, mut poses) = (Batch::new(None), vec![0.0; 16 * 4200]);
    batch.fk(&irb, &joints, &mut poses).unwrap();
    print("MANY_JOINTS", &joints);
    print("MANY_POSES", &poses);
    poses[16 * 7] = f64::NAN;
    let (mut all, mut status) = (vec![0.0; 48 * 4200], vec![0; 8 * 4200]);
    batch.ik(&irb, &poses, &mut all, &mut status).unwrap();
    print("MANY_SOLUTIONS", &all);
    println!("static const uint8_t MANY_STATUS[] = {{{}}};", list(&status));

    let at = Pose::translation(1.0, 0.0, 0.6);
    let wall = Shape::cuboid([0.4, 2.0, 0.5], &at).unwrap();
    let cell = Cell::new(vec![("wall".to_owned(), wall)], 0.01).unwrap();
    for (name, cell) in [("MANY_COLLIDE", &cell), ("MANY_FOLD", &Cell::default())] {
        let mut collides = vec![false; 4200];
        cell.collides_batch(&mut batch, &irb, &joints, &mut collides).unwrap();
        println!(
            "static const bool {name}[] = {{{}}};",
            list(collides.iter().map(|it| u8::from(*it)))
        );
    }
    print("WALL", &pose::to_rows(&at));

    let line = |x: f64| pose::from_euler_zyx([x, 0.3, 1.2], [0.0, 2.2, 0.1]).unwrap();
    let seed = irb.ik(&line(0.8)).unwrap().within_limits().iter().next().unwrap().q;
    print("SEED", &seed);
    let path: Vec<Pose> = (0..40).map(|step| line(0.8 + 0.005 * f64::from(step))).collect();
    print_path("LINE", &irb, &path, &seed, &cell);
    let path: Vec<Pose> = (0..40).map(|step| line(0.8 + 0.03 * f64::from(step))).collect();
    print_path("FAR", &irb, &path, &seed, &Cell::default());

    let Configuration { cf1, cf4, cf6, cfx } = irb.configuration(&q).unwrap();
    println!("static const int32_t CONFDATA[] = {{{cf1}, {cf4}, {cf6}, {cfx}}};");
    let wanted = Configuration { cf1, cf4, cf6, cfx };
    print("CONFIGURED", &irb.ik_configured(&irb.fk(&q), wanted).unwrap().q);
}
