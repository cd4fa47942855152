//! Arms of every kind that the kernels tell apart, and poses of every kind that a batch may bring.

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{
    Definition, JointLimits, OpwParameters, Pose, Robot, pose_from_euler_zyx, pose_to_rows,
};
use nalgebra::Translation3;

use crate::common::parallel_arm::ParallelArm;
use crate::common::{Rng, kuka_kr6};

pub type PoseRow = [f64; 16];

pub struct Subject {
    pub name: &'static str,
    pub robot: Robot<6>,
    form: Form,
}

/// What poses of an arm are made from.
enum Form {
    Wrist(OpwParameters),
    Parallel(Box<ParallelArm>),
}

/// No maker's: every parameter plays a part.
fn odd_parallel() -> ParallelArm {
    ParallelArm {
        a1: 0.07,
        b: [0.2, -0.13, 0.04],
        c1: 0.3,
        c2: 0.5,
        c3: 0.43,
        d5: 0.08,
        d6: 0.11,
        signs: [1.0, -1.0, 1.0, 1.0, -1.0, -1.0],
        offsets: [0.3, -0.2, -FRAC_PI_2, 0.1, -0.4, 0.5],
        base: pose_from_euler_zyx([0.1, -0.2, 0.05], [0.4, 0.1, -0.3]).unwrap(),
        flange: pose_from_euler_zyx([0.02, 0.01, 0.03], [-0.7, 0.2, 0.5]).unwrap(),
    }
}

/// No maker's: every parameter plays a part.
const LATERAL: OpwParameters = OpwParameters {
    a1: 0.15,
    a2: -0.11,
    b: 0.05,
    c1: 0.45,
    c2: 0.6,
    c3: 0.64,
    c4: 0.1,
    offsets: [0.3, -0.2, -FRAC_PI_2, 0.1, -0.4, 0.5],
    signs: [1, -1, 1, 1, -1, -1],
};

/// Catalogue arms; signs, offsets up to many turns, a lateral offset; tools and bases with and without rotation; limits that leave out
/// nothing, much, ask for full turns, or lie where more than one is needed.
pub fn subjects() -> Vec<Subject> {
    let named = |name: &str| Robot::<6>::named(name).unwrap();
    let limited = |robot: Robot<6>, limits| robot.with_limits(JointLimits::new(limits).unwrap());
    let lateral = |offsets| Robot::from_opw(OpwParameters { offsets, ..LATERAL }).unwrap();
    let irb_2600 = || named("IRB 2600-12/1.65");
    let tool = pose_from_euler_zyx([0.03, -0.02, 0.2], [0.3, -0.7, 1.1]).unwrap();
    let base = pose_from_euler_zyx([0.8, -0.5, 0.3], [-1.9, 0.4, 0.2]).unwrap();
    let straight_tool = pose_from_euler_zyx([0.01, -0.02, 0.3], [0.0; 3]).unwrap();
    let infinite = f64::INFINITY;
    let robots = vec![
        ("IRB 2600-12/1.65", irb_2600()),
        ("IRB 120-3/0.58", named("IRB 120-3/0.58")),
        ("IRB 1600-6/1.45", named("IRB 1600-6/1.45")),
        ("IRB 6700-150/3.2", named("IRB 6700-150/3.2")),
        ("signs and offsets", kuka_kr6().unwrap()),
        ("lateral offset", lateral(LATERAL.offsets)),
        ("offsets of many turns", lateral([50.0, -49.0, 31.4, -3.2, 12.5, 7.0])),
        ("straight tool", irb_2600().with_tool(&straight_tool).unwrap()),
        ("tool and base", irb_2600().with_tool(&tool).unwrap().with_base(&base).unwrap()),
        (
            "lateral, tool and base",
            lateral(LATERAL.offsets).with_tool(&tool).unwrap().with_base(&base).unwrap(),
        ),
        ("no limits", limited(irb_2600(), [[-infinite, infinite]; 6])),
        ("narrow limits", limited(irb_2600(), [[-0.4, 0.9]; 6])),
        (
            "limits beyond half a turn",
            limited(
                irb_2600(),
                [[-7.0, 1.0], [-1.0, 4.5], [-4.7, -0.2], [-9.0, 9.0], [-PI, 0.3], [-0.3, PI]],
            ),
        ),
        (
            "limits more than a turn away",
            limited(
                irb_2600(),
                [[4.0, 7.0], [-PI, PI], [-PI, PI], [-7.0, -4.0], [-PI, PI], [9.0, 16.0]],
            ),
        ),
        (
            "limits on one side",
            limited(
                lateral(LATERAL.offsets),
                [
                    [-infinite, 1.0],
                    [-1.0, infinite],
                    [-PI, PI],
                    [-3.5, 3.5],
                    [-2.0, 2.0],
                    [-9.0, 1.0],
                ],
            ),
        ),
    ];
    let wrists = robots.into_iter().map(|(name, robot)| {
        let Definition::Opw(opw) = *robot.definition() else {
            unreachable!("{name} is built from its parameters")
        };
        Subject { name, robot, form: Form::Wrist(opw) }
    });
    wrists.chain(parallel_subjects([tool, straight_tool], base)).collect()
}

/// The same of arms with three parallel axes.
fn parallel_subjects([tool, straight_tool]: [Pose; 2], base: Pose) -> Vec<Subject> {
    let limited = |(arm, robot): (_, Robot<6>), limits| {
        (arm, robot.with_limits(JointLimits::new(limits).unwrap()))
    };
    let universal = ParallelArm::universal;
    let odd = || (odd_parallel(), odd_parallel().robot());
    let many_turns =
        ParallelArm { offsets: [50.0, -49.0, 31.4, -3.2, 12.5, 7.0], ..odd_parallel() };
    let (ur3, ur3_robot) = universal("UR3");
    let (bare, bare_robot) = odd();
    let infinite = f64::INFINITY;
    let arms = vec![
        ("UR3", universal("UR3")),
        ("UR10e", universal("UR10e")),
        ("odd frames", odd()),
        ("odd frames, offsets of many turns", (many_turns.clone(), many_turns.robot())),
        (
            "UR3 with a straight tool",
            (ur3.clone(), ur3_robot.clone().with_tool(&straight_tool).unwrap()),
        ),
        (
            "UR3, tool and base",
            (ur3, ur3_robot.with_tool(&tool).unwrap().with_base(&base).unwrap()),
        ),
        (
            "odd frames, tool and base",
            (bare, bare_robot.with_tool(&tool).unwrap().with_base(&base).unwrap()),
        ),
        ("UR3, no limits", limited(universal("UR3"), [[-infinite, infinite]; 6])),
        ("UR3, narrow limits", limited(universal("UR3"), [[-0.4, 0.9]; 6])),
        (
            "odd frames, limits beyond half a turn",
            limited(
                odd(),
                [[-7.0, 1.0], [-1.0, 4.5], [-4.7, -0.2], [-9.0, 9.0], [-PI, 0.3], [-0.3, PI]],
            ),
        ),
        (
            "UR3, limits more than a turn away",
            limited(
                universal("UR3"),
                [[4.0, 7.0], [-PI, PI], [-PI, PI], [-7.0, -4.0], [-PI, PI], [9.0, 16.0]],
            ),
        ),
        (
            "odd frames, limits on one side",
            limited(
                odd(),
                [
                    [-infinite, 1.0],
                    [-1.0, infinite],
                    [-PI, PI],
                    [-3.5, 3.5],
                    [-2.0, 2.0],
                    [-9.0, 1.0],
                ],
            ),
        ),
    ];
    arms.into_iter()
        .map(|(name, (arm, robot))| Subject { name, robot, form: Form::Parallel(Box::new(arm)) })
        .collect()
}

impl Subject {
    fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        match &self.form {
            Form::Wrist(opw) => {
                std::array::from_fn(|i| f64::from(opw.signs[i]) * (theta[i] + opw.offsets[i]))
            }
            Form::Parallel(arm) => arm.q(theta),
        }
    }

    /// The lengths that a position of the tool is summed from [m].
    pub fn extent(&self) -> f64 {
        let ends = self.robot.base().translation.vector.norm()
            + self.robot.tool().translation.vector.norm();
        let arm = match &self.form {
            Form::Wrist(OpwParameters { a1, a2, b, c1, c2, c3, c4, .. }) => {
                a1.abs() + b.abs() + c1 + c2 + a2.hypot(*c3) + c4
            }
            Form::Parallel(arm) => arm.reach(),
        };
        arm + ends
    }

    /// theta_3 of the stretched arm.
    fn straight(&self) -> f64 {
        match &self.form {
            Form::Wrist(opw) => -opw.a2.atan2(opw.c3),
            Form::Parallel(_) => 0.0,
        }
    }

    /// A pose that has the wrist `x` from axis 1 at the height of the upper arm's end, seen past base and tool.
    fn above_the_shoulder(&self, x: f64, rng: &mut Rng) -> Pose {
        let turned = [rng.between(-PI, PI), rng.between(-1.5, 1.5), rng.between(-PI, PI)];
        let flange = match &self.form {
            Form::Wrist(opw) => {
                pose_from_euler_zyx([x, opw.b, opw.c1 + 0.9 * opw.c2], turned).unwrap()
                    * Translation3::new(0.0, 0.0, opw.c4)
            }
            Form::Parallel(arm) => {
                let wrist =
                    pose_from_euler_zyx([x, arm.b(), arm.c1 + 0.9 * arm.c2], turned).unwrap();
                arm.base * wrist * Translation3::new(0.0, arm.d6, 0.0) * arm.flange
            }
        };
        self.robot.base() * flange * self.robot.tool()
    }

    /// Rows of all kinds, of which each stands in a block with the others.
    pub fn rows(&self, count: usize) -> Vec<PoseRow> {
        let mut rng = Rng::new(0x1a9e5);
        (0..count).map(|i| self.row(i, &mut rng)).collect()
    }

    /// A row of one of 24 kinds, every other one plain.
    fn row(&self, kind: usize, rng: &mut Rng) -> PoseRow {
        let theta: [f64; 6] = std::array::from_fn(|_| rng.between(-PI, PI));
        let near = [0.0, 1e-12, 1e-9, 9e-7, 1.1e-6, 1e-4][kind / 24 % 6];
        let made = |theta| pose_to_rows(&self.robot.fk(&self.q(theta)));
        let mut row = made(theta);
        let [_, t2, _, t4, _, t6] = theta;
        let straight = self.straight();
        match kind % 24 {
            1 => row = made([theta[0], t2, theta[2], t4, near, t6]),
            3 => row = made([theta[0], t2, straight + near, t4, theta[4], t6]),
            5 => row = pose_to_rows(&self.above_the_shoulder(near, rng)),
            7 => {
                row = made(
                    [0.0, 0.4, 0.0, 0.0, 0.5, 0.0]
                        .map(|angle: f64| if rng.unit() < 0.5 { angle } else { -angle }),
                )
            }
            9 => row = self.anywhere(rng),
            11 => row[3 + 4 * (kind / 24 % 3)] = [1e6, -1e7, 1e300][kind / 72 % 3],
            13 => row[kind / 24 % 12] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][kind / 24 % 3],
            15 => [row[2], row[6], row[10]] = [-row[2], -row[6], -row[10]],
            17 => row[kind / 24 % 3] += [1e-3, -2e-3][kind / 24 % 2],
            // Repaired: by rounding in single precision, and just within and beyond what is taken as it is.
            19 => row[kind / 24 % 3] += [1e-7, 1e-14, 3e-15, 1e-6][kind / 24 % 4],
            // The last row, taken and not.
            21 => row[12 + kind / 24 % 4] += [1e-12, 9e-10, 1e-6][kind / 24 % 3],
            // Zeros of both signs.
            23 => {
                row = [
                    0.0, 0.0, 1.0, 0.6, -0.0, 1.0, -0.0, -0.0, -1.0, 0.0, 0.0, 0.7, 0.0, -0.0, 0.0,
                    1.0,
                ]
            }
            _ => {}
        }
        row
    }

    /// A pose in and around the reach.
    fn anywhere(&self, rng: &mut Rng) -> PoseRow {
        let far = 1.3 * self.extent();
        let (xyz, zyx) = (
            [0.0; 3].map(|_: f64| rng.between(-far, far)),
            [0.0; 3].map(|_: f64| rng.between(-PI, PI)),
        );
        pose_to_rows(&pose_from_euler_zyx(xyz, zyx).unwrap())
    }
}

/// Joint vectors with angles of many turns; some rows are not finite.
pub fn joint_rows<const N: usize>(count: usize) -> Vec<[f64; N]> {
    let mut rng = Rng::new(0x10b);
    let row = |i: usize| {
        let most = [PI, 400.0, 1e5, 1.1e5, 1e9, 1e15, 0.0][i % 7];
        let mut q: [f64; N] = std::array::from_fn(|_| rng.between(-most, most));
        match i % 11 {
            5 => q[i % N] = [f64::NAN, f64::INFINITY][i % 2],
            7 => q[i % N] = 1e9,
            8 => q[i % N] = -0.0,
            _ => {}
        }
        q
    };
    (0..count).map(row).collect()
}
