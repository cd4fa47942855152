//! Every joint vector that makes a pose is found again, nothing else is, nothing twice, on many random poses.
//!
//! One by one and in a batch. `make million` runs a million poses on each instruction set and prints the table; `make test` runs fewer.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common;

use std::f64::consts::PI;

use crate::common::{Rng, apart, asked_set, reach_of};
use irbkin::{
    Error, JacobianFrame, JointLimits, OpwParameters, Pose, Robot, SLOTS, Status, batch,
    pose_to_rows,
};

#[derive(Default)]
struct Tally {
    poses: usize,
    lost: usize,
    coarse: usize,
    wrong: usize,
    twice: usize,
    solutions: usize,
    position: f64,
    rotation: f64,
    recall: f64,
}

/// Poses of a batch: a million at once would take half a gigabyte. No multiple of any lane count.
const PART: usize = 1003;

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(20_000, |count| count.parse().unwrap())
}

impl Tally {
    /// Holds the answers for a pose against forward kinematics and against the joint vector that made it.
    fn take<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        reach: f64,
        q: &[f64; N],
        pose: &Pose,
        answers: &[[f64; N]],
    ) {
        self.poses += 1;
        self.solutions += answers.len();
        let nearest = answers.iter().map(|answer| apart(answer, q)).fold(f64::INFINITY, f64::min);
        self.recall = self.recall.max(nearest);
        self.lost += usize::from(nearest > 1e-9 && nearest > rounding_bound(robot, reach, q));
        self.coarse += usize::from(nearest > 1e-9);
        for (i, answer) in answers.iter().enumerate() {
            let residual = robot.residual(answer, pose);
            self.position = self.position.max(residual.position);
            self.rotation = self.rotation.max(residual.rotation);
            self.wrong +=
                usize::from(residual.position > 3e-15 * reach || residual.rotation > 1e-14);
            self.twice +=
                answers.iter().skip(i + 1).filter(|other| apart(other, answer) < 1e-9).count();
        }
    }
}

/// A robot that solves one pose and many, of seven joints with joint 7 as in the joint vectors that made them.
trait Solves<const N: usize> {
    fn alone(&self, pose: &Pose, q: &[f64; N]) -> Vec<[f64; N]>;
    fn together(&self, rows: &[f64], joints: &[[f64; N]], q: &mut [f64], status: &mut [u8]);
}

impl Solves<6> for Robot<6> {
    fn alone(&self, pose: &Pose, _: &[f64; 6]) -> Vec<[f64; 6]> {
        self.ik(pose).unwrap().iter().map(|solution| solution.q).collect()
    }

    fn together(&self, rows: &[f64], _: &[[f64; 6]], q: &mut [f64], status: &mut [u8]) {
        batch::ik(self, rows, q, status, 1).unwrap();
    }
}

impl Solves<7> for Robot<7> {
    fn alone(&self, pose: &Pose, q: &[f64; 7]) -> Vec<[f64; 7]> {
        self.ik(pose, q[6]).unwrap().iter().map(|solution| solution.q).collect()
    }

    fn together(&self, rows: &[f64], joints: &[[f64; 7]], q: &mut [f64], status: &mut [u8]) {
        let told: Vec<f64> = joints.iter().map(|q| q[6]).collect();
        batch::ik_with_q7(self, rows, &told, q, status, 1).unwrap();
    }
}

/// Solves random poses inside the limits, one by one and in batches.
fn tally<const N: usize>(robot: &Robot<N>, reach: f64) -> [Tally; 2]
where
    Robot<N>: Solves<N>,
{
    let mut rng = Rng::new(0x5eed);
    let [mut alone, mut together] = [Tally::default(), Tally::default()];
    let mut left = poses();
    while left > 0 {
        let joints: Vec<_> = (0..left.min(PART)).map(|_| rng.inside(robot.limits())).collect();
        let poses: Vec<_> = joints.iter().map(|q| robot.fk(q)).collect();
        for ((q, pose), answers) in
            joints.iter().zip(&poses).zip(solved_together(robot, &poses, &joints))
        {
            alone.take(robot, reach, q, pose, &robot.alone(pose, q));
            together.take(robot, reach, q, pose, &answers);
        }
        left -= joints.len();
    }
    [alone, together]
}

/// The solutions of each pose of a batch.
fn solved_together<const N: usize>(
    robot: &Robot<N>,
    poses: &[Pose],
    joints: &[[f64; N]],
) -> Vec<Vec<[f64; N]>>
where
    Robot<N>: Solves<N>,
{
    let rows: Vec<f64> = poses.iter().flat_map(pose_to_rows).collect();
    let (mut q, mut status) = (vec![[0.0; N]; SLOTS * poses.len()], vec![0; SLOTS * poses.len()]);
    robot.together(&rows, joints, q.as_flattened_mut(), &mut status);
    let found = |(q, flags): (&[f64; N], &u8)| (flags & Status::FOUND.bits() != 0).then_some(*q);
    let of_a_pose =
        |(q, status): (&[[f64; N]], &[u8])| q.iter().zip(status).filter_map(found).collect();
    q.chunks(SLOTS).zip(status.chunks(SLOTS)).map(of_a_pose).collect()
}

/// How far rounding of the pose may move the joints: a pose is rounded by its forward kinematics (measured: 1e-15 x reach, 2e-15 rad) and
/// the inverse of the Jacobian of the joints that are solved for turns that into joint angles. Only next to a singularity is this above 1e-9.
fn rounding_bound<const N: usize>(robot: &Robot<N>, reach: f64, q: &[f64; N]) -> f64 {
    let solved = robot.jacobian(q, JacobianFrame::Base).fixed_columns::<6>(0).into_owned();
    4e-15 * (1.0 + reach) / solved.singular_values()[5]
}

fn check<const N: usize>(name: &str, robot: &Robot<N>)
where
    Robot<N>: Solves<N>,
{
    let (set, reach) = (asked_set().name(), reach_of(robot));
    for (way, tally) in ["one by one", "in a batch"].iter().zip(tally(robot, reach)) {
        let Tally { poses, lost, coarse, wrong, twice, solutions, position, rotation, recall } =
            tally;
        #[expect(clippy::cast_precision_loss, reason = "a mean")]
        let mean = solutions as f64 / poses as f64;
        println!(
            "{name:20} {set:8} {way} {poses:8} poses  {lost} lost ({coarse} found only to worse than 1e-9 rad)  {wrong} wrong  {twice} twice  \
             {mean:.2} solutions  worst: {position:.1e} m ({:.2e} x reach)  {rotation:.1e} rad  recall {recall:.1e} rad",
            position / reach
        );
        assert_eq!((lost, wrong, twice), (0, 0, 0), "{name} {way} on {set}");
    }
}

#[test]
fn every_generating_joint_vector_is_found() {
    for name in [
        "IRB 2600-12/1.65",
        "IRB 120-3/0.58",
        "IRB 140-6/0.81",
        "IRB 1600-6/1.45",
        "IRB 6700-150/3.2",
        "IRB 2400-10/1.55",
    ] {
        check(name, &Robot::<6>::named(name).unwrap());
    }
}

#[test]
fn arms_of_other_makers_lose_nothing() -> Result<(), Error> {
    check("KUKA KR 6 R700", &common::kuka_kr6()?);
    let lateral =
        OpwParameters { b: 0.05, ..OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1) };
    check("lateral offset 50 mm", &Robot::from_opw(lateral)?);
    Ok(())
}

#[test]
fn arms_with_three_parallel_axes_lose_nothing() {
    for name in ["UR3", "UR5e", "UR10e", "UR20"] {
        // Their joints turn twice: each pose would be drawn as often with full turns as without.
        let robot =
            Robot::named(name).unwrap().with_limits(JointLimits::new([[-PI, PI]; 6]).unwrap());
        check(name, &robot);
    }
}

#[test]
fn arms_of_seven_axes_lose_nothing() {
    for name in ["Panda", "FR3"] {
        check(name, &Robot::<7>::named(name).unwrap());
    }
}
