use std::vec::Vec;

use super::polynomial::derivatives;
use super::*;
use crate::rng::Rng;

struct Case {
    dof: usize,
    points: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    jerk: Vec<f64>,
}

impl Case {
    /// Random waypoints, a line, or a way there and back.
    fn random(rng: &mut Rng, case: usize) -> Self {
        let dof = 1 + case % 4;
        let count = [2, 3, 5, 20][case / 4 % 4];
        let mut points: Vec<f64> = (0..dof * count).map(|_| rng.between(-1.0, 1.0)).collect();
        if case.is_multiple_of(5) {
            points.extend_from_within(..dof);
        }
        let mut each = |low: f64, high: f64| -> Vec<f64> {
            (0..dof).map(|_| rng.between(low.ln(), high.ln()).exp()).collect()
        };
        let (velocity, acceleration, jerk) = (each(0.1, 10.0), each(0.1, 100.0), each(1e-2, 1e6));
        Self { dof, points, velocity, acceleration, jerk }
    }

    fn retimed(&self, max_jerk: Option<&[f64]>) -> Trajectory {
        let within = Retiming::within(&self.velocity, &self.acceleration);
        Retiming { max_jerk, ..within }.along(&self.points).unwrap()
    }
}

/// The largest jump of a derivative at a knot, rest before the first and behind the last one, for
/// position, velocity and acceleration.
fn jumps(motion: &Trajectory) -> [f64; 3] {
    let mut jumps = [0.0_f64; 3];
    for joint in 0..motion.dof() {
        let [start, end] = motion.ends().map(|q| q[joint]);
        let mut before = [start, 0.0, 0.0];
        for piece in 0..motion.pieces() {
            let terms = &motion.terms[piece * motion.dof() + joint];
            let length = motion.knots[piece + 1] - motion.knots[piece];
            for (order, jump) in jumps.iter_mut().enumerate() {
                *jump = jump.max((derivatives(terms, 0.0)[order] - before[order]).abs());
                before[order] = derivatives(terms, length)[order];
            }
        }
        for (order, rest) in [end, 0.0, 0.0].into_iter().enumerate() {
            jumps[order] = jumps[order].max((rest - before[order]).abs());
        }
    }
    jumps
}

#[test]
fn a_path_with_a_limit_of_jerk_keeps_every_limit_and_goes_from_rest_to_rest_without_a_jump() {
    let mut rng = Rng::new(31);
    for number in 0..100 {
        let case = Case::random(&mut rng, number);
        let motion = case.retimed(Some(&case.jerk));
        let (mut fastest, mut sharpest) = (0.0_f64, 0.0_f64);
        for (joint, peaks) in motion.peaks().iter().enumerate() {
            assert!(peaks.velocity <= case.velocity[joint] * (1.0 + 1e-12), "{number}");
            assert!(peaks.acceleration <= case.acceleration[joint] * (1.0 + 1e-12), "{number}");
            assert!(peaks.jerk <= case.jerk[joint] * (1.0 + 1e-12), "{number}");
            fastest = fastest.max(peaks.velocity);
            sharpest = sharpest.max(peaks.acceleration);
        }
        let [position, velocity, acceleration] = jumps(&motion);
        assert!(position <= 1e-9, "{number}: {position}");
        assert!(velocity <= 1e-8 * fastest, "{number}: {velocity}");
        assert!(acceleration <= 1e-7 * sharpest, "{number}: {acceleration}");
        let [first, last] = motion.ends();
        for joint in 0..case.dof {
            let wanted = case.points[case.points.len() - case.dof + joint];
            assert!((first[joint] - case.points[joint]).abs() <= 1e-12);
            assert!((last[joint] - wanted).abs() <= 1e-9, "{number}: {}", last[joint] - wanted);
        }
        assert!(motion.duration() > case.retimed(None).duration());
    }
}

/// One joint goes forward all the way: where it is, the others are the same at either pace.
#[test]
fn the_path_is_kept() {
    let mut rng = Rng::new(32);
    for _ in 0..20 {
        let points: Vec<f64> =
            (0..8).flat_map(|row| [f64::from(row), rng.between(-0.3, 0.3)]).collect();
        let (velocity, acceleration) = (vec![2.0; 2], vec![8.0; 2]);
        let jerk = vec![rng.between(1.0_f64.ln(), 1e4_f64.ln()).exp(); 2];
        let case = Case { dof: 2, points, velocity, acceleration, jerk };
        let [wanted, motion] = [case.retimed(None), case.retimed(Some(&case.jerk))];
        let at = |motion: &Trajectory, time: f64| {
            let (mut q, mut dq, mut ddq) = ([0.0; 2], [0.0; 2], [0.0; 2]);
            motion.sample(&[time], &mut q, &mut dq, &mut ddq).unwrap();
            q
        };
        for time in motion.times(100).unwrap() {
            let [along, across] = at(&motion, time);
            let (mut low, mut high) = (0.0, wanted.duration());
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if at(&wanted, middle)[0] < along { low = middle } else { high = middle }
            }
            assert!((at(&wanted, low)[1] - across).abs() <= 1e-8);
        }
    }
}

#[test]
fn a_limit_of_jerk_costs_less_the_higher_it_is_and_nothing_in_the_end() {
    let mut rng = Rng::new(33);
    for number in 0..20 {
        let case = Case::random(&mut rng, number);
        let fastest = case.retimed(None).duration();
        let mut before = f64::INFINITY;
        for jerk in [1e1, 1e3, 1e5, 1e7, 1e9] {
            let cost = case.retimed(Some(&vec![jerk; case.dof])).duration() / fastest - 1.0;
            assert!(cost > 0.0 && cost <= before, "{number}: {cost}");
            before = cost;
        }
        assert!(before <= 3e-3, "{number}: {before}");
    }
}

/// With a part at full velocity it is the S-curve; without one an acceleration that turns over in
/// one ramp takes up to 3 2^(2/3) / 4 of its time.
#[test]
fn a_straight_path_takes_about_the_time_of_an_s_curve() {
    let (velocity, acceleration) = (1.5, 4.0);
    for (jerk, most) in [(0.1, 1.2), (1.0, 1.2), (10.0, 1.001), (100.0, 1.001), (1e4, 1.001)] {
        let limits = AxisLimits { velocity, acceleration, jerk };
        let best = AxisMotion::within(Profile::SCurve, 0.0, 2.0, &limits).duration();
        let within = Retiming::within(&[1.5], &[4.0]);
        let motion = Retiming { max_jerk: Some(&[jerk]), ..within }.along(&[0.0, 1.0, 2.0]);
        let ratio = motion.unwrap().duration() / best;
        assert!((1.0..most).contains(&ratio), "{jerk}: {ratio}");
    }
}

#[test]
fn a_wrong_limit_of_jerk_and_a_speed_at_an_end_are_refused() {
    let within = Retiming::within(&[1.0; 2], &[1.0; 2]);
    let refused =
        |retiming: Retiming<'_>| retiming.along(&[0.0, 0.0, 1.0, 1.0]).unwrap_err().to_string();
    let max_jerk = Some(&[1.0, -1.0][..]);
    let words = refused(Retiming { max_jerk, ..within });
    assert_eq!(words, "max_jerk[1] is -1.0, it must be positive");
    let words = refused(Retiming { max_jerk: Some(&[1.0]), ..within });
    assert!(words.contains("max_jerk"), "{words}");
    let (max_jerk, end_velocity) = (Some(&[1.0; 2][..]), Some(&[0.1; 2][..]));
    let words = refused(Retiming { max_jerk, end_velocity, ..within });
    assert_eq!(
        words,
        "end_velocity must be zero with max_jerk: such a motion goes from rest to rest"
    );
}
