//! The number of solutions, found another way: by turning joint 6 until the arm closes.

use nalgebra::Vector3;

use super::*;

/// Length of the upper arm that each turn of joint 6 would need, the elbow on one or the other side of axis 5, less what it has [m].
fn closures(arm: &Arm, hand: &Pose, theta_6: f64) -> [f64; 2] {
    let [_, a4, c5, upper] = lengths(arm);
    let (sin, cos) = theta_6.sin_cos();
    // Axis 5 is z of the hand turned back by joint 6.
    let axis_5 = hand.rotation * Vector3::new(-sin, 0.0, cos);
    let foot = hand.translation.vector - axis_5 * c5;
    let aside = -foot - axis_5 * axis_5.dot(&-foot);
    let towards = aside / aside.norm();
    [1.0, -1.0].map(|side| (foot - towards * (side * a4)).norm() - upper)
}

/// a3, a4, c5 and the length of the upper arm, read off the table of the arm.
fn lengths(arm: &Arm) -> [f64; 4] {
    let rows = &arm.chain.mdh().rows;
    let frames = arm.chain.link_frames(&[0.0; 7]).0;
    let front = frames[2].rotation * Vector3::x() * rows[3].a.signum();
    let upper_arm = frames[2].rotation * Vector3::z() * rows[2].d.signum();
    let forearm = frames[4].rotation * Vector3::z() * rows[4].d.signum();
    let a4 = rows[4].a
        * (frames[3].rotation * Vector3::x()).dot(&upper_arm.cross(&front).cross(&forearm));
    [rows[3].a.abs(), a4, rows[4].d.abs(), rows[3].a.hypot(rows[2].d)]
}

/// How many turns of joint 6 close the arm; `None` where two cannot be told from none.
fn count(arm: &Arm, hand: &Pose) -> Option<usize> {
    const STEPS: i32 = 2000;
    let angle = |step: i32| TAU * f64::from(step) / f64::from(STEPS);
    let mut crossings = 0;
    for side in 0..2 {
        let at = |theta_6: f64| closures(arm, hand, theta_6)[side];
        for step in 0..STEPS {
            let [before, here, next] = [step - 1, step, step + 1].map(|step| at(angle(step)));
            crossings += usize::from((here < 0.0) != (next < 0.0));
            if here.abs() > before.abs()
                || here.abs() > next.abs()
                || (before < 0.0) != (next < 0.0)
                || (here < 0.0) != (next < 0.0)
            {
                continue;
            }
            // Two may hide where the closure turns back towards zero.
            let nearest =
                least(|theta_6| at(theta_6) * here.signum(), angle(step - 1), angle(step + 1));
            if nearest.abs() < 1e-10 {
                return None;
            }
            crossings += if nearest < 0.0 { 2 } else { 0 };
        }
    }
    Some(crossings)
}

/// The least value of a function with one valley.
fn least(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..80 {
        let third = (high - low) / 3.0;
        if value(low + third) < value(high - third) { high -= third } else { low += third }
    }
    value(0.5 * (low + high))
}

#[test]
fn there_are_no_other_solutions() {
    let mut rng = Rng::new(8);
    for arm in [panda(), oblique(), onto_itself()] {
        let (mut by_count, mut unsure) = ([0_u32; 9], 0);
        for _ in 0..poses(20_000) / 20 {
            let q = rng.anywhere();
            let pose = arm.chain.fk(&q);
            let branches = arm.solve(&pose, &FreeChoice::rest(q));
            let Some(expected) = count(&arm, &arm.chain_hand(&pose, q[6])) else {
                unsure += 1;
                continue;
            };
            let found = branches.q.iter().flatten().count();
            assert_eq!(found, 2 * expected, "{}: {q:?}\n{branches:#?}", arm.name);
            by_count[found] += 1;
        }
        std::println!(
            "{}: poses by number of solutions {by_count:?}, not counted {unsure}",
            arm.name
        );
        assert!(unsure < poses(20_000) / 1000);
    }
}

impl Arm {
    /// The hand seen from the shoulder, from the chain's table alone: z along axis 5 and y along axis 6 where joint 6 is zero, up to a turn
    /// about axis 6.
    fn chain_hand(&self, pose: &Pose, q7: f64) -> Pose {
        let frames = self.chain.link_frames(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, q7]);
        let t_six_tool = frames.0[5].inverse() * frames.1;
        let six = pose * t_six_tool.inverse();
        let back = self.chain.mdh().rows[5].d;
        let (axis_6, x) = (six.rotation * Vector3::z(), six.rotation * Vector3::x());
        let rotation =
            nalgebra::Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_columns(&[
                axis_6.cross(&x),
                axis_6,
                x,
            ]));
        let shoulder = frames.0[0].translation.vector;
        Pose::from_parts((six.translation.vector - axis_6 * back - shoulder).into(), rotation)
    }
}
