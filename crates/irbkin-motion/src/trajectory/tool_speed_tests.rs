use std::string::ToString;
use std::vec::Vec;

use super::*;
use crate::rng::Rng;

const DOF: usize = 3;

/// A path of joints, the lengths of its tool's path, and limits of velocity and acceleration.
struct Case {
    q: Vec<f64>,
    lengths: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
}

impl Case {
    fn random(rng: &mut Rng, rows: usize) -> Self {
        let mut lengths = std::vec![rng.between(-1.0, 1.0)];
        for row in 1..rows {
            lengths.push(lengths[row - 1] + rng.between(0.01, 0.1));
        }
        let mut between = |low, high| (0..DOF).map(|_| rng.between(low, high)).collect::<Vec<_>>();
        let (velocity, acceleration) = (between(0.5, 5.0), between(2.0, 50.0));
        let q = (0..rows * DOF).map(|_| rng.between(-1.0, 1.0)).collect();
        Self { q, lengths, velocity, acceleration }
    }

    fn limits(&self) -> ToolSpeedLimits {
        tool_speed_limits(&self.q, &self.lengths, &self.velocity, &self.acceleration).unwrap()
    }

    fn at(&self, speed: f64) -> Result<Trajectory, crate::Error> {
        at_tool_speed(&self.q, &self.lengths, speed, &self.velocity, &self.acceleration)
    }

    /// The parts of their limits that the joints reach, velocity and acceleration of each.
    fn parts(&self, motion: &Trajectory) -> Vec<[f64; 2]> {
        let limits = self.velocity.iter().zip(&self.acceleration);
        let peaks = motion.peaks();
        let parts = peaks.iter().zip(limits);
        parts.map(|(peaks, (v, a))| [peaks.velocity / v, peaks.acceleration / a]).collect()
    }
}

#[test]
fn the_fastest_constant_speed_reaches_a_limit_of_the_joint_that_is_named_and_exceeds_none() {
    let mut rng = Rng::new(31);
    let mut between_rows = 0;
    for case in 0..300 {
        let mut own = Case::random(&mut rng, [2, 3, 4, 30][case % 4]);
        if case % 3 == 0 {
            own.acceleration = std::vec![f64::INFINITY; DOF];
        }
        let limits = own.limits();
        let motion = own.at(limits.fastest).unwrap();
        let parts = own.parts(&motion);
        assert!(parts.iter().flatten().all(|part| *part <= 1.0 + 1e-9), "{parts:?}");
        let [velocity, acceleration] = parts[limits.fastest_joint - 1];
        assert!(velocity.max(acceleration) >= 1.0 - 1e-9, "{parts:?} {limits:?}");
        let way = own.lengths[own.lengths.len() - 1] - own.lengths[0];
        assert!((motion.duration() * limits.fastest / way - 1.0).abs() < 1e-12);
        let least = limits.speed.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(limits.fastest <= least * (1.0 + 1e-12));
        between_rows += usize::from(limits.fastest < least * 0.999);
        let refused = own.at(limits.fastest * 1.001).unwrap_err().to_string();
        let named = std::format!("joint {} allows", limits.fastest_joint);
        let row = std::format!("at row {} of q", limits.fastest_row);
        assert!(refused.contains(&named) && refused.contains(&row), "{refused}");
    }
    assert!(between_rows > 20, "{between_rows}");
}

#[test]
fn at_each_row_the_joint_that_is_named_has_its_limit() {
    let mut rng = Rng::new(32);
    let mut by_acceleration = 0;
    for _ in 0..50 {
        let own = Case::random(&mut rng, 12);
        let limits = own.limits();
        // Without limits, the path at each row's own speed.
        let none = std::vec![f64::INFINITY; DOF];
        for (row, (speed, joint)) in limits.speed.iter().zip(&limits.joint).enumerate() {
            let motion = at_tool_speed(&own.q, &own.lengths, *speed, &none, &none).unwrap();
            let time = (own.lengths[row] - own.lengths[0]) / speed;
            let [mut q, mut dq, mut ddq] = [[0.0; DOF]; 3];
            motion.sample(&[time.min(motion.duration())], &mut q, &mut dq, &mut ddq).unwrap();
            for (found, wanted) in q.iter().zip(&own.q[row * DOF..]) {
                assert!((found - wanted).abs() < 1e-12);
            }
            let part = |joint: usize| {
                [dq[joint] / own.velocity[joint], ddq[joint] / own.acceleration[joint]]
                    .map(f64::abs)
            };
            let largest = (0..DOF).flat_map(part).fold(0.0, f64::max);
            let [velocity, acceleration] = part(joint - 1);
            assert!((velocity.max(acceleration) - 1.0).abs() < 1e-8 && largest < 1.0 + 1e-8);
            by_acceleration += usize::from(acceleration > velocity);
        }
    }
    assert!((100..500).contains(&by_acceleration), "{by_acceleration}");
}

#[test]
fn a_path_retimed_by_its_tool_keeps_every_limit_and_has_the_speed_where_it_can() {
    let mut rng = Rng::new(33);
    let mut has_it = 0;
    for case in 0..60 {
        let mut own = Case::random(&mut rng, [2, 5, 40][case % 3]);
        // Rows that are near enough to each other.
        own.q.iter_mut().for_each(|angle| *angle *= 0.04);
        let asked = own.limits().fastest * [0.3, 3.0][case % 2];
        // The length of the tool's path as one more joint, whose velocity is the tool's speed.
        let rows = own.q.chunks_exact(DOF).zip(&own.lengths);
        let q: Vec<f64> = rows.flat_map(|(q, length)| [q, &[*length]].concat()).collect();
        let [velocity, acceleration] = [&own.velocity, &own.acceleration]
            .map(|limits| [&limits[..], &[f64::INFINITY]].concat());
        let motion = retime_tool(&q, &own.lengths, asked, &velocity, &acceleration).unwrap();
        let parts = own.parts(&motion);
        assert!(parts.iter().flatten().all(|part| *part <= 1.0 + 1e-9), "{parts:?}");
        assert!(motion.peaks()[DOF].velocity <= asked * (1.0 + 1e-9));
        let most = parts.iter().flatten().copied().fold(0.0, f64::max);
        assert!(most >= 0.98 || motion.peaks()[DOF].velocity >= asked * (1.0 - 1e-9));
        // At rest at both ends.
        let ends = [0.0, motion.duration()];
        let [mut q, mut dq, mut ddq] = [(); 3].map(|()| std::vec![0.0; 2 * (DOF + 1)]);
        motion.sample(&ends, &mut q, &mut dq, &mut ddq).unwrap();
        assert!(dq.iter().all(|dq| dq.abs() < 1e-9), "{dq:?}");
        // Below the fastest constant speed, it is constant except near the ends.
        if case % 6 == 4 {
            let middle = [0.45, 0.5, 0.55].map(|part| part * motion.duration());
            let [mut q, mut dq, mut ddq] = [(); 3].map(|()| std::vec![0.0; 3 * (DOF + 1)]);
            motion.sample(&middle, &mut q, &mut dq, &mut ddq).unwrap();
            let speeds = [3, 7, 11].map(|index| dq[index] / asked);
            assert!(speeds.iter().all(|speed| (speed - 1.0).abs() < 1e-9), "{case} {speeds:?}");
            has_it += 1;
        }
    }
    assert!(has_it == 10, "{has_it}");
}

#[test]
fn an_unlimited_tool_speed_is_no_limit() {
    // Along a straight path of joints both parameters are the same but for a factor.
    let (velocity, acceleration) = ([1.0, 1.5], [4.0, 4.0]);
    let q = [0.0, 0.0, 0.04, -0.08, 0.08, -0.16];
    let timed = retime(&q, &velocity, &acceleration).unwrap();
    let tool = retime_tool(&q, &[0.0, 0.2, 0.4], 1e6, &velocity, &acceleration).unwrap();
    assert!((tool.duration() / timed.duration() - 1.0).abs() < 1e-12);
}

#[test]
fn a_tool_that_stays_is_refused_where_its_joints_move_and_left_out_where_they_do_not() {
    let limits = [1.0; 2];
    let at = |q: &[f64], lengths: &[f64]| tool_speed_limits(q, lengths, &limits, &limits);
    let turning = at(&[0.0, 0.0, 0.1, 0.0, 0.1, 0.2], &[0.0, 0.1, 0.1]).unwrap_err().to_string();
    assert!(turning.contains("moves by 0.0e0 m to row 2 of q, where its joints move"), "{turning}");
    let back = at(&[0.0, 0.0, 0.1, 0.0], &[0.0, -0.1]).unwrap_err().to_string();
    assert!(back.contains("moves by -1.0e-1 m to row 1"), "{back}");
    let once = at(&[0.0, 0.0, 0.1, 0.2], &[0.0, 0.1]).unwrap();
    let twice = at(&[0.0, 0.0, 0.0, 1e-12, 0.1, 0.2, 0.1, 0.2], &[0.0, 1e-12, 0.1, 0.1]).unwrap();
    assert_eq!(twice.speed, [once.speed[0], once.speed[0], once.speed[1], once.speed[1]]);
    assert_eq!((once.speed[0], once.joint[0], once.fastest_joint), (0.5, 2, 2));
    // One place: nothing limits.
    let still = at(&[0.3, 0.4], &[0.0]).unwrap();
    assert_eq!((still.speed[0], still.joint[0], still.fastest), (f64::INFINITY, 0, f64::INFINITY));
    for motion in [
        at_tool_speed(&[0.3, 0.4], &[0.0], 1.0, &limits, &limits).unwrap(),
        retime_tool(&[0.3, 0.4, 0.3, 0.4], &[0.0, 0.0], 1.0, &limits, &limits).unwrap(),
    ] {
        assert_eq!((motion.duration(), motion.ends()[1].as_slice()), (0.0, &[0.3, 0.4][..]));
    }
}

#[test]
fn what_is_no_path_of_a_tool_is_refused() {
    let one = [1.0];
    let limits = |q: &[f64], lengths: &[f64], velocity: &[f64], acceleration: &[f64]| {
        tool_speed_limits(q, lengths, velocity, acceleration).unwrap_err().to_string()
    };
    for (refused, words) in [
        (limits(&[0.0, 1.0], &[0.0, f64::NAN], &one, &one), "lengths[1] is NaN"),
        (limits(&[0.0, f64::NAN], &[0.0, 1.0], &one, &one), "row 1 of q: joint 1 is NaN"),
        (limits(&[0.0, 1.0], &[0.0], &one, &one), "q has 2 elements, it must have 1"),
        (limits(&[], &[], &one, &one), "q has 0 rows"),
        (limits(&[], &[], &[], &[]), "q has no joints"),
        (limits(&[0.0], &[0.0], &[0.0], &one), "max_velocity[0] is 0.0"),
        (limits(&[0.0], &[0.0], &one, &[-1.0]), "max_acceleration[0] is -1.0"),
        (limits(&[0.0], &[0.0], &one, &[]), "max_acceleration has 0 elements"),
    ] {
        assert!(refused.contains(words), "{refused}");
    }
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let at = at_tool_speed(&[0.0, 1.0], &[0.0, 1.0], speed, &one, &one).unwrap_err();
        assert!(at.to_string().contains("speed is "), "{at}");
        let most = retime_tool(&[0.0, 1.0], &[0.0, 1.0], speed, &one, &one).unwrap_err();
        assert!(most.to_string().contains("max_tool_speed is "), "{most}");
    }
    let slow = at_tool_speed(&[0.0, 1.0], &[0.0, 1.0], 1e-12, &one, &one).unwrap_err();
    assert!(slow.to_string().contains("it must take 1e-9 to 1e9 s"), "{slow}");
}
