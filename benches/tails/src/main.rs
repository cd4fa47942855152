//! Time of one pose at and next to every singularity: p50, p99, p99.9 and the most, of irbkin and,
//! for spherical wrists, of rs-opw-kinematics on the same poses.
//!
//! Joints are drawn inside the limits; the seed is the joints that made a pose, each off by up to
//! 0.01 rad. A pose counts with the best of three calls, in turns with the other library: what
//! interrupts a call is not its own.

use std::hint::black_box;
use std::time::Instant;

use irbkin::{Definition, OpwParameters, Pose, Robot};
use rs_opw_kinematics::constraints::{BY_PREV, Constraints};
use rs_opw_kinematics::glam::{DMat3, DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

const SETS: [&str; 9] = [
    "random",
    "J5 = 1e-3",
    "J5 = 1e-6",
    "J5 = 0",
    "elbow 1e-6 off straight",
    "elbow straight",
    "wrist center on axis 1",
    "multiples of 90 deg",
    "multiples of 45 deg",
];

/// Numbers between 0 and 1.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// The angle of a joint, inside its limits, at which a distance from a singularity is the least, by
/// a scan and a ternary search.
fn nearest(
    q: &[f64; 6],
    joint: usize,
    [low, high]: [f64; 2],
    distance: impl Fn(&[f64; 6]) -> f64,
) -> f64 {
    let at = |angle: f64| {
        let mut q = *q;
        q[joint] = angle;
        distance(&q)
    };
    let angles = (0..2000).map(|step| low + (high - low) * f64::from(step) / 2000.0);
    let first = angles.min_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap_or(0.0);
    let (mut low, mut high) = (first - 4e-3, first + 4e-3);
    for _ in 0..90 {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) { high -= third } else { low += third }
    }
    low
}

/// Joints of a set, inside the limits; `None` if this draw has none or the set is not of this arm.
fn draw(robot: &Robot<6>, set: &str, random: &mut Random) -> Option<[f64; 6]> {
    let limits = robot.limits().to_array();
    let mut q: [f64; 6] = std::array::from_fn(|joint| {
        let [low, high] = limits[joint].map(|limit: f64| limit.clamp(-3.1, 3.1));
        random.between(low, high)
    });
    let has_names = robot.singular_distances(&q).is_some();
    let distances = |q: &[f64; 6]| robot.singular_distances(q);
    match set {
        "random" => {}
        "multiples of 90 deg" | "multiples of 45 deg" => {
            let step = if set.contains("90") { 90_f64 } else { 45.0 }.to_radians();
            q = q.map(|angle| (angle / step).round() * step);
        }
        _ if !has_names => return None,
        "J5 = 1e-3" => q[4] = 1e-3,
        "J5 = 1e-6" => q[4] = 1e-6,
        "J5 = 0" => q[4] = 0.0,
        "wrist center on axis 1" => {
            q[1] = nearest(&q, 1, limits[1], |q| distances(q).map_or(9.0, |d| d.shoulder));
        }
        _ => {
            let off = if set == "elbow straight" { 0.0 } else { 1e-6 };
            q[2] = off + nearest(&q, 2, limits[2], |q| distances(q).map_or(9.0, |d| d.elbow));
        }
    }
    robot.limits().contains(&q).then_some(q)
}

/// Build the arm in rs-opw-kinematics, whose poses must agree.
fn opw(robot: &Robot<6>, parameters: &OpwParameters) -> OPWKinematics {
    let OpwParameters { a1, a2, b, c1, c2, c3, c4, .. } = *parameters;
    let limits = robot.limits().to_array();
    let peer = OPWKinematics::new_with_constraints(
        Parameters {
            a1,
            a2,
            b,
            c1,
            c2,
            c3,
            c4,
            offsets: parameters.offsets,
            sign_corrections: parameters.signs,
            dof: 6,
        },
        Constraints::new(limits.map(|limit| limit[0]), limits.map(|limit| limit[1]), BY_PREV),
    );
    let q = [0.1, 0.2, -0.3, 0.4, 0.5, -0.6];
    let apart = peer.forward(&q).translation - opw_pose(&robot.fk(&q)).translation;
    assert!(apart.length() < 1e-9, "{}: {apart}", robot.name());
    peer
}

fn opw_pose(pose: &Pose) -> OpwPose {
    let t = pose.translation.vector;
    let column = |index: usize| {
        let column = pose.rotation.matrix().column(index);
        DVec3::new(column[0], column[1], column[2])
    };
    let rotation = DMat3::from_cols(column(0), column(1), column(2));
    OpwPose::from_parts(DVec3::new(t.x, t.y, t.z), DQuat::from_mat3(&rotation))
}

fn nanoseconds<T>(call: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(call());
    start.elapsed().as_secs_f64() * 1e9
}

/// p50, p99, p99.9 and the most, as text.
fn tail(mut times: Vec<f64>) -> String {
    times.sort_by(f64::total_cmp);
    let at = |part: f64| times[((times.len() - 1) as f64 * part) as usize];
    let [a, b, c, d] = [0.5, 0.99, 0.999, 1.0].map(|part| at(part) / 1e3);
    format!("{a:7.2} {b:7.2} {c:7.2} {d:7.2}")
}

fn run(name: &str, set: &str, poses: usize) {
    let robot = Robot::<6>::named(name).expect("a catalog name");
    let peer = match robot.definition() {
        Definition::Opw(parameters) => Some(opw(&robot, parameters)),
        _ => None,
    };
    let mut random = Random(88_172_645_463_325_252);
    let mut times: [Vec<f64>; 4] = std::array::from_fn(|_| Vec::new());
    for _ in 0..40 * poses {
        if times[0].len() == poses {
            break;
        }
        let Some(q) = draw(&robot, set, &mut random) else { continue };
        let pose = robot.fk(&q);
        let seed = q.map(|angle| angle + random.between(-0.01, 0.01));
        let theirs = opw_pose(&pose);
        let mut best = [f64::INFINITY; 4];
        for _ in 0..3 {
            let mut take = |call: usize, time: f64| best[call] = best[call].min(time);
            take(0, nanoseconds(|| robot.ik(&pose)));
            take(1, nanoseconds(|| robot.ik_nearest(&pose, &seed, &[1.0; 6])));
            if let Some(peer) = &peer {
                take(2, nanoseconds(|| peer.inverse(&theirs)));
                take(3, nanoseconds(|| peer.inverse_continuing(&theirs, &seed)));
            }
        }
        times.iter_mut().zip(best).for_each(|(times, best)| times.push(best));
    }
    let [ik, nearest, inverse, continuing] = times;
    if ik.is_empty() {
        return;
    }
    println!("{name:17} {set:23} {:5} ik          {}", ik.len(), tail(ik));
    println!("{:47} ik_nearest  {}", "", tail(nearest));
    if peer.is_some() {
        println!("{:47} rs-opw      {}", "", tail(inverse));
        println!("{:47} its nearest {}", "", tail(continuing));
    }
}

fn main() {
    let poses = std::env::var("POSES").map_or(2000, |poses| poses.parse().expect("a number"));
    println!("us, p50, p99, p99.9 and the most; best of three calls of a pose\n");
    for name in ["IRB 2600-12/1.65", "IRB 120-3/0.58", "UR5e", "GoFa 5", "CRX-10iA/L"] {
        for set in SETS {
            run(name, set, poses);
        }
    }
}
