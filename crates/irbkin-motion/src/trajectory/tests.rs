use std::vec::Vec;

use super::*;
use crate::rng::Rng;

const ROUNDING: f64 = 1e-12;

/// Between two positive bounds, each power of ten as often.
fn log_between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    rng.between(low.ln(), high.ln()).exp()
}

fn limits(rng: &mut Rng) -> AxisLimits {
    AxisLimits {
        velocity: log_between(rng, 0.1, 10.0),
        acceleration: log_between(rng, 0.1, 100.0),
        jerk: log_between(rng, 1.0, 1e4),
    }
}

/// How far a limit may be exceeded: a time is known to a rounding of the duration, in which a
/// derivative changes by the next one.
fn allowed(duration: f64, limits: &AxisLimits) -> [f64; 3] {
    let rounding = 4.0 * f64::EPSILON * duration;
    [
        1.0 + ROUNDING + rounding * limits.acceleration / limits.velocity,
        1.0 + ROUNDING + rounding * limits.jerk / limits.acceleration,
        1.0 + ROUNDING,
    ]
}

fn keeps(motion: &Trajectory, peaks: &Peaks, limits: &AxisLimits) -> bool {
    let allowed = allowed(motion.duration(), limits);
    ratios(peaks, limits).into_iter().zip(allowed).all(|(ratio, allowed)| ratio <= allowed)
}

fn ratios(peaks: &Peaks, limits: &AxisLimits) -> [f64; 3] {
    [
        peaks.velocity / limits.velocity,
        peaks.acceleration / limits.acceleration,
        peaks.jerk / limits.jerk,
    ]
}

#[test]
fn a_motion_within_limits_meets_both_ends_keeps_every_limit_and_reaches_one() {
    let mut rng = Rng::new(1);
    let mut most = [0.0_f64; 3];
    for _ in 0..20_000 {
        let limits = limits(&mut rng);
        let (start, way) = (rng.between(-3.0, 3.0), log_between(&mut rng, 1e-6, 10.0));
        let end = if rng.between(0.0, 1.0) < 0.5 { start + way } else { start - way };
        for profile in [Profile::Quintic, Profile::Cubic, Profile::Trapezoid, Profile::SCurve] {
            let axis = AxisMotion::within(profile, start, end, &limits);
            let motion = Trajectory::of_axes(&[axis]);
            let [first, last] = motion.ends();
            assert!((first[0] - start).abs() <= ROUNDING && (last[0] - end).abs() <= ROUNDING);
            let mut reached = ratios(&motion.peaks()[0], &limits);
            // A trapezoid and a cubic have no limit of jerk.
            if matches!(profile, Profile::Trapezoid | Profile::Cubic) {
                reached[2] = 0.0;
            }
            let allowed = allowed(motion.duration(), &limits);
            for ((most, reached), allowed) in most.iter_mut().zip(reached).zip(allowed) {
                assert!(reached <= allowed, "{profile:?} {start} {end} {limits:?}");
                *most = most.max(reached);
            }
            let best = reached.into_iter().fold(0.0, f64::max);
            assert!(best >= 1.0 - 1e-9, "{profile:?} {start} {end} {limits:?}: {best}");
        }
    }
    assert!(most.iter().all(|most| *most > 1.0 - 1e-9), "{most:?}");
}

#[test]
fn position_velocity_and_acceleration_have_no_jump() {
    let mut rng = Rng::new(2);
    for _ in 0..2000 {
        let axis =
            AxisMotion::within(Profile::SCurve, 0.0, rng.between(0.01, 5.0), &limits(&mut rng));
        let motion = Trajectory::of_axes(&[axis, AxisMotion::still(1.0, 0.0)]);
        let at = |time: f64| {
            let [mut q, mut dq, mut ddq] = [[0.0; 2]; 3];
            motion.sample(&[time], &mut q, &mut dq, &mut ddq).unwrap();
            assert_eq!((q[1], dq[1], ddq[1]), (1.0, 0.0, 0.0));
            [q[0], dq[0], ddq[0]]
        };
        let peak = motion.peaks()[0];
        let sizes = [peak.velocity, peak.acceleration, peak.jerk];
        for knot in &motion.knots()[1..motion.knots().len() - 1] {
            let before = knot * (1.0 - 1e-13);
            let (left, right) = (at(before), at(*knot));
            for ((left, right), rate) in left.into_iter().zip(right).zip(sizes) {
                let moved = 2e-13 * knot * rate + 1e-15 * right.abs().max(1.0);
                assert!((left - right).abs() <= 2.0 * moved, "{left} {right} {rate}");
            }
        }
    }
}

#[test]
fn phase_is_a_line_and_time_is_never_longer() {
    let mut rng = Rng::new(3);
    for _ in 0..2000 {
        let own: Vec<AxisLimits> = (0..6).map(|_| limits(&mut rng)).collect();
        let (start, end): (Vec<f64>, Vec<f64>) =
            (0..6).map(|_| (rng.between(-3.0, 3.0), rng.between(-3.0, 3.0))).unzip();
        let of = |how| joint_within(Profile::SCurve, &start, &end, &own, how).unwrap();
        let (time, phase) = (of(Synchronization::Time), of(Synchronization::Phase));
        assert!(time.duration() <= phase.duration() * (1.0 + ROUNDING));
        for motion in [&time, &phase] {
            for (peaks, limits) in motion.peaks().iter().zip(&own) {
                assert!(keeps(motion, peaks, limits));
            }
        }
        let [mut q, mut dq, mut ddq] = [[0.0; 6]; 3];
        let middle = rng.between(0.0, phase.duration());
        phase.sample(&[middle], &mut q, &mut dq, &mut ddq).unwrap();
        let along: Vec<f64> = (0..6).map(|i| (q[i] - start[i]) / (end[i] - start[i])).collect();
        assert!(along.iter().all(|part| (part - along[0]).abs() <= 1e-9), "{along:?}");
    }
}

#[test]
fn splines_pass_their_waypoints_and_are_as_smooth_as_they_say() {
    let mut rng = Rng::new(4);
    for kind in [SplineKind::Cubic, SplineKind::Quintic] {
        for count in [2, 3, 4, 20] {
            let points: Vec<f64> = (0..2 * count).map(|_| rng.between(-1.0, 1.0)).collect();
            let mut times = std::vec![0.0];
            for index in 1..count {
                times.push(times[index - 1] + rng.between(0.5, 1.5));
            }
            let curve = spline(kind, &points, 2, &times).unwrap();
            let n = times.len();
            let [mut q, mut dq, mut ddq] = [(); 3].map(|()| std::vec![0.0; 2 * n]);
            curve.sample(&times, &mut q, &mut dq, &mut ddq).unwrap();
            for (found, wanted) in q.iter().zip(&points) {
                assert!((found - wanted).abs() <= 1e-12, "{kind:?} {count}");
            }
            let before: Vec<f64> = times[1..n - 1].iter().map(|t| t * (1.0 - 1e-13)).collect();
            let inner = before.len() * 2;
            let [mut q1, mut dq1, mut ddq1] = [(); 3].map(|()| std::vec![0.0; inner]);
            curve.sample(&before, &mut q1, &mut dq1, &mut ddq1).unwrap();
            for index in 0..inner {
                assert!((dq1[index] - dq[index + 2]).abs() <= 1e-10);
                assert!((ddq1[index] - ddq[index + 2]).abs() <= 1e-9);
            }
            let ends = [0, 1, 2 * n - 2, 2 * n - 1];
            assert!(ends.iter().all(|index| dq[*index].abs() <= 1e-11));
            let rests = ends.iter().all(|index| ddq[*index].abs() <= 1e-10);
            assert!(rests || matches!(kind, SplineKind::Cubic), "{kind:?} {count} {ddq:?}");
        }
    }
}

#[test]
fn retimed_paths_keep_their_limits_and_use_them() {
    let mut rng = Rng::new(5);
    for case in 0..60 {
        let count = [2, 3, 5, 20, 200][case % 5];
        let points: Vec<f64> = (0..3 * count).map(|_| rng.between(-1.0, 1.0)).collect();
        let own: Vec<AxisLimits> = (0..3).map(|_| limits(&mut rng)).collect();
        let velocity: Vec<f64> = own.iter().map(|own| own.velocity).collect();
        let acceleration: Vec<f64> = own.iter().map(|own| own.acceleration).collect();
        let timed = retime(&points, &velocity, &acceleration).unwrap();
        let peaks = timed.peaks();
        let mut most: f64 = 0.0;
        for (peaks, limits) in peaks.iter().zip(&own) {
            let [v, a, _] = ratios(peaks, limits);
            assert!(v <= 1.0 + 1e-9 && a <= 1.0 + 1e-9, "{case}: {v} {a}");
            most = most.max(v).max(a);
        }
        assert!(most >= 0.98, "{case}: {most}");
        let [first, last] = timed.ends();
        for joint in 0..3 {
            assert!((first[joint] - points[joint]).abs() <= 1e-12);
            assert!((last[joint] - points[3 * count - 3 + joint]).abs() <= 1e-11);
        }
    }
}

/// At the turning point every joint stands still along the path, whatever the pace: coefficients of
/// the limits cancel there.
#[test]
fn a_path_that_goes_back_on_itself_keeps_its_limits() {
    let mut rng = Rng::new(6);
    for case in 0..500 {
        let dof = 1 + case % 4;
        let [there, turn]: [Vec<f64>; 2] =
            [(); 2].map(|()| (0..dof).map(|_| rng.between(-3.0, 3.0)).collect());
        let mut each = || (0..dof).map(|_| log_between(&mut rng, 1e-3, 1e3)).collect::<Vec<f64>>();
        let [velocity, acceleration] = [(); 2].map(|()| each());
        let timed =
            retime(&[&there[..], &turn, &there].concat(), &velocity, &acceleration).unwrap();
        for (joint, peaks) in timed.peaks().iter().enumerate() {
            let excess = (peaks.velocity / velocity[joint] - 1.0)
                .max(peaks.acceleration / acceleration[joint] - 1.0);
            assert!(excess <= 1e-9, "{case}: {excess}");
        }
    }
}

#[test]
fn a_straight_path_takes_the_time_of_a_trapezoid() {
    // Along a line the fastest pace is a trapezoid's.
    let timed = retime(&[0.0, 0.0, 1.0, -2.0], &[1.0, 1.5], &[4.0, 4.0]).unwrap();
    let none = f64::INFINITY;
    let shared = AxisLimits { velocity: 0.75, acceleration: 2.0, jerk: none };
    let best = AxisMotion::within(Profile::Trapezoid, 0.0, 1.0, &shared);
    let excess = timed.duration() / best.duration() - 1.0;
    assert!((0.0..1e-3).contains(&excess), "{excess}");
}

#[test]
fn parts_and_sums_are_the_whole() {
    let axes = [
        AxisMotion::s_curve(0.0, 1.0, 2.0),
        AxisMotion::quintic(AxisState::at_rest(2.0), AxisState::at_rest(-1.0), 3.0),
    ];
    let whole = Trajectory::of_axes(&axes);
    let joined = whole.slice(0.0, 1.3).unwrap().then(&whole.slice(1.3, 3.0).unwrap()).unwrap();
    assert!((joined.duration() - 3.0).abs() < 1e-15);
    let times: Vec<f64> = (0..=300).map(|step| f64::from(step) * 0.01).collect();
    let sampled = |trajectory: &Trajectory| {
        let [mut q, mut dq, mut ddq] = [(); 3].map(|()| std::vec![0.0; 2 * times.len()]);
        trajectory.sample(&times, &mut q, &mut dq, &mut ddq).unwrap();
        [q, dq, ddq].concat()
    };
    let (one, other) = (sampled(&whole), sampled(&joined));
    assert!(one.iter().zip(&other).all(|(one, other)| (one - other).abs() < 1e-11));
    let slow = whole.clone().stretched(2.0).unwrap();
    assert!((slow.peaks()[1].velocity * 2.0 - whole.peaks()[1].velocity).abs() < 1e-12);
    assert!(whole.slice(1.0, 1.0).is_err() && whole.slice(-0.1, 1.0).is_err());
    assert!(whole.clone().then(&whole).is_err());
}

/// A path cut at a sample, with the velocity there at both ends, is as fast as in one; and what is
/// faster, or in another direction, is refused.
#[test]
fn a_path_is_retimed_in_parts_that_go_on_where_the_last_one_ends() {
    let mut rng = Rng::new(7);
    let (velocity, acceleration) = ([2.0, 1.5, 3.0], [9.0, 8.0, 7.0]);
    for case in 0..50 {
        let [from, to]: [Vec<f64>; 2] =
            [(); 2].map(|()| (0..3).map(|_| rng.between(-2.0, 2.0)).collect());
        // A line: its parts are the same splines as the whole.
        let row = |step: u32| {
            let part = f64::from(step) / 40.0;
            from.iter().zip(&to).map(move |(from, to)| from + part * (to - from))
        };
        let rows: Vec<f64> = (0..=40).flat_map(row).collect();
        let whole = retime(&rows, &velocity, &acceleration).unwrap();
        let range = whole.range();
        for (joint, [least, most]) in range.iter().enumerate() {
            let ends = [from[joint], to[joint]];
            assert!((least - ends[0].min(ends[1])).abs() < 1e-12, "{least} {ends:?}");
            assert!((most - ends[0].max(ends[1])).abs() < 1e-12, "{most} {ends:?}");
        }
        assert!(whole.inside(&range).is_ok());
        let cut = 3 * (1 + case % 38);
        let [mut q, mut dq, mut ddq] = [[0.0; 3]; 3];
        let [mut low, mut high] = [0.0, whole.duration()];
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            whole.sample(&[middle], &mut q, &mut dq, &mut ddq).unwrap();
            let is_before = (q[0] - from[0]).abs() < (rows[cut] - from[0]).abs();
            [low, high] = if is_before { [middle, high] } else { [low, middle] };
        }
        let rest = Retiming::within(&velocity, &acceleration);
        let first = Retiming { end_velocity: Some(&dq), ..rest }.along(&rows[..cut + 3]).unwrap();
        let second = Retiming { start_velocity: Some(&dq), ..rest }.along(&rows[cut..]).unwrap();
        let joined = first.then(&second).unwrap();
        assert!((joined.duration() / whole.duration() - 1.0).abs() < 2e-3);
        for (peaks, [v, a]) in joined.peaks().iter().zip([[2.0, 9.0], [1.5, 8.0], [3.0, 7.0]]) {
            assert!(peaks.velocity <= v * (1.0 + 1e-9) && peaks.acceleration <= a * (1.0 + 1e-9));
        }
        let aside = [dq[0], dq[1] + 1e-3, dq[2]];
        for wrong in [dq.map(|rate| -rate), aside, dq.map(|rate| 20.0 * rate)] {
            let ends = [
                Retiming { start_velocity: Some(&wrong), ..rest },
                Retiming { end_velocity: Some(&wrong), ..rest },
            ];
            assert!(ends.iter().all(|ends| ends.along(&rows).is_err()), "{wrong:?}");
        }
    }
}

#[test]
fn a_curve_that_leaves_limits_between_waypoints_is_refused_with_the_farthest_place() {
    let limits = [[-1.0, 1.0], [-0.5, 1.0]];
    let rows = [0.0, 0.0, 1.0, -0.5, 1.0, 0.0];
    let motion = spline(SplineKind::Quintic, &rows, 2, &[0.0, 1.0, 3.0]).unwrap();
    let Err(crate::Error::InvalidMotion(fault)) = motion.inside(&limits) else {
        panic!("{:?}", motion.range());
    };
    let crate::error::MotionFault::Outside { joint, time, value, limit } = fault else {
        panic!("{fault}");
    };
    let [mut q, mut dq, mut ddq] = [[0.0; 2]; 3];
    motion.sample(&[time], &mut q, &mut dq, &mut ddq).unwrap();
    assert!((q[joint - 1] - value).abs() < 1e-12 && dq[joint - 1].abs() < 1e-6);
    let excess = (value - limit).abs();
    for (range, limits) in motion.range().iter().zip(&limits) {
        assert!(limits[0] - range[0] <= excess && range[1] - limits[1] <= excess);
    }
    // Rounding is no excess, and 2e-9 rad are one.
    let mut near = motion.range();
    near[0][0] += 9e-10;
    assert!(motion.inside(&near).is_ok());
    near[0][0] += 2e-9;
    assert!(motion.inside(&near).is_err());
    assert!(motion.inside(&[[0.0, -1.0], [0.0, 1.0]]).is_err() && motion.inside(&[]).is_err());
}

/// Of 20,000 rough rows the pieces, and with them the memory, are a few a row.
#[test]
fn a_long_rough_path_has_few_pieces_and_keeps_its_limits() {
    let mut rng = Rng::new(8);
    let mut q = 0.0;
    let mut walk = || {
        q += rng.between(-0.1, 0.1);
        q
    };
    let rows: Vec<f64> = (0..40_000).map(|_| walk()).collect();
    let timed = retime(&rows, &[2.0, 3.0], &[9.0, 8.0]).unwrap();
    assert!(timed.knots().len() <= 5 * 20_000, "{}", timed.knots().len());
    for (peaks, [v, a]) in timed.peaks().iter().zip([[2.0, 9.0], [3.0, 8.0]]) {
        assert!(peaks.velocity <= v * (1.0 + 1e-9) && peaks.acceleration <= a * (1.0 + 1e-9));
    }
}

#[test]
fn samples_are_no_farther_apart_than_asked_and_no_nearer_than_need_be() {
    let motion = spline(SplineKind::Cubic, &[0.0, 1.0], 1, &[0.0, 1.5]).unwrap();
    for (dt, steps) in [(0.1, 16), (0.4, 5), (1.5, 2), (f64::INFINITY, 2), (1e-300, usize::MAX)] {
        assert_eq!(motion.steps_of(dt).unwrap(), steps, "{dt}");
    }
    assert!([0.0, -1.0, f64::NAN].iter().all(|dt| motion.steps_of(*dt).is_err()));
}
