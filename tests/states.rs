//! Jerk-limited motion from any state to rest at a target, and to a standstill.
#![allow(clippy::unreadable_literal)]
#![allow(clippy::approx_constant, reason = "random numbers")]

use irbkin_motion::Error;
use irbkin_motion::trajectory::state::{between, brake, to_rest};
use irbkin_motion::trajectory::{AxisLimits, AxisMotion, AxisState, Profile, Trajectory};

use crate::common::{Rng, enough};

/// Position, velocity and acceleration at the start, the target, limits of velocity, acceleration
/// and jerk of each joint; and the duration [s] of the shortest of ruckig 0.19.4's motions, asked
/// by irbkin's Python before there was one of its own.
#[rustfmt::skip]
const BY_RUCKIG: [(&[[f64; 7]], f64); 30] = [
    (&[[1.013, 0.0, 0.0, 1.58, 4.619, 17.43, 11.11]], 1.1776231270806712),
    (&[[-0.64, 0.02506, -2.028, -2.012, 0.1366, 3.035, 22.18]], 10.17224515762478),
    (&[[0.09249, -0.3513, -0.4032, 0.0904, 1.505, 3.276, 895.1]], 0.25783151400469345),
    (&[[1.081, -0.4255, -2.875, 1.065, 0.4115, 4.746, 90.43]], 0.36138803739610076),
    (&[[1.099, 0.0, 0.0, 1.1, 0.4455, 15.14, 19.24]], 0.1184808888263892),
    (&[[1.912, -1.74, -0.2218, 2.3, 2.929, 16.56, 224.4]], 0.550233612564361),
    (&[[0.5117, -0.04841, -0.337, 0.5252, 0.1245, 0.5952, 141.7]], 0.41364101006765974),
    (&[[-0.06266, -7.217, 7.254, -0.08942, 5.783, 9.296, 160.9]], 1.9030601221689463),
    (&[[0.4295, 0.0, 0.0, 0.4223, 9.845, 3.636, 63.07]], 0.15401152265302567),
    (&[[-1.937, 1.121, 1.264, -1.944, 1.589, 4.268, 3.335]], 3.288592431773554),
    (&[[0.4637, -0.4228, 6.712, 0.3099, 2.983, 9.71, 113.6]], 0.36623849240319906),
    (&[[-0.7862, 1.684, -0.1871, -0.6518, 4.354, 4.143, 30.08]], 1.1053631354486813),
    (&[[0.8628, 0.0, 0.0, 0.8941, 1.773, 8.867, 55.62]], 0.26211252680237596),
    (&[[1.281, -3.187, -0.32, 1.27, 7.487, 0.5478, 580.3]], 14.04390193943783),
    (&[[1.161, 0.09344, -0.0902, 1.156, 0.1168, 9.858, 10.29]], 0.4195942887661961),
    (&[[-1.167, -0.2361, -0.5557, -1.205, 0.2396, 0.391, 347.3]], 1.1980141276535095),
    (&[[-0.2102, 0.0, 0.0, -0.2097, 0.2335, 1.09, 8.851]], 0.12181736859428795),
    (&[[-0.2111, 0.03749, 0.1305, -0.3002, 0.2718, 0.4247, 47.25]], 1.0264989174066512),
    (&[[1.126, 1.594, 0.7085, 1.397, 6.007, 3.228, 543.3]], 0.9019888607389553),
    (&[[0.2265, 0.318, -0.5237, 0.2778, 0.4122, 0.7694, 6.276]], 0.8002508304484006),
    (&[[0.3815, 0.0, 0.0, 0.3712, 0.2781, 1.512, 338.7], [1.185, 0.0, 0.0, 1.211, 6.094, 3.545, 37.66], [-1.54, 0.0, 0.0, -1.599, 3.099, 6.579, 35.2]], 0.37712597167990397),
    (&[[-0.4264, 1.696, -0.07366, -1.706, 2.016, 0.5198, 596.2], [1.456, -0.09168, -0.4297, 1.13, 0.1328, 0.4979, 11.18], [-0.3498, -0.7499, -0.1026, -0.3308, 1.652, 9.939, 130.0]], 8.844114697826724),
    (&[[0.7973, 0.5005, -0.1003, 1.021, 0.9834, 2.02, 43.07], [-1.564, 0.3002, 0.3673, -1.684, 0.3501, 0.4631, 66.31], [1.228, -0.05517, -3.841, 1.23, 0.1127, 4.555, 90.85]], 2.0435966540189097),
    (&[[-1.321, 0.2651, -3.515, -1.194, 0.1796, 8.759, 203.8], [0.2168, 0.4386, 4.496, 0.2116, 1.078, 6.858, 214.3], [0.2197, -0.1868, -0.6221, 0.2185, 0.7686, 0.7289, 287.9]], 0.7623359663731445),
    (&[[-1.855, 0.0, 0.0, -1.835, 0.1098, 29.73, 217.3], [0.09215, 0.0, 0.0, 0.07443, 6.523, 4.786, 249.3], [-1.8, 0.0, 0.0, -1.89, 4.152, 5.815, 755.1]], 0.2566350168507056),
    (&[[-1.685, -0.3202, 0.5193, -1.67, 0.3742, 0.9457, 218.5], [1.702, 0.01371, -2.642, 2.411, 0.1289, 12.83, 348.0], [1.836, 0.00634, -0.7889, 1.84, 0.9425, 1.22, 37.05]], 5.545239329698906),
    (&[[-1.994, 2.534, 0.2968, -0.6046, 3.576, 0.5739, 294.9], [1.566, -0.6884, 0.3041, 1.572, 0.835, 1.132, 20.83], [1.446, 0.2119, -2.38, 1.3, 0.3077, 5.764, 104.9]], 9.835923592780667),
    (&[[-1.714, 0.2666, 0.5285, -1.768, 0.3301, 2.837, 166.0], [0.02151, -0.03807, -4.803, -0.103, 0.1043, 7.356, 86.46], [-1.217, 0.04751, -4.148, -1.2, 2.608, 3.558, 60.69]], 1.2343588442043993),
    (&[[0.8762, 0.0, 0.0, 0.8655, 1.475, 4.536, 31.25], [-0.6475, 0.0, 0.0, -0.5816, 0.4528, 3.425, 3.212], [-0.1046, 0.0, 0.0, -0.1025, 0.9031, 1.035, 21.0]], 0.8691337581965894),
    (&[[-1.014, 8.739, -1.289, -1.025, 9.759, 3.149, 240.1], [0.1342, -0.03734, -0.4177, 0.1317, 0.1319, 0.6758, 28.39], [-1.275, -0.1909, 0.1758, -1.241, 1.852, 0.3865, 126.7]], 6.713726984575567),
];

/// Rounding of a sum of seven phases, each evaluated in ten operations: a part of its terms [1].
const ROUNDING: f64 = 70.0 * f64::EPSILON;

/// A joint on its way: its state, its limits, and the target.
#[derive(Debug)]
struct Case {
    start: AxisState,
    limits: AxisLimits,
    target: f64,
}

impl Case {
    /// Limits over decades; a state within `most` of them; a target near or far, or near where the
    /// joint would stop.
    fn random(rng: &mut Rng, most: f64) -> Self {
        let mut decades = |low: f64, high: f64| 10.0_f64.powf(rng.between(low, high));
        let (velocity, acceleration, jerk) =
            (decades(-1.0, 1.0), decades(-1.0, 2.0), decades(0.0, 4.0));
        let way = decades(-6.0, 0.5);
        let limits = AxisLimits { velocity, acceleration, jerk };
        // No more acceleration than limits of velocity leave room to end.
        let useful = acceleration.min((2.0 * velocity * jerk).sqrt());
        let start = AxisState {
            position: rng.between(-3.0, 3.0),
            velocity: most * velocity * rng.between(-1.0, 1.0),
            acceleration: most * useful * rng.between(-1.0, 1.0),
        };
        let near =
            if rng.unit() < 0.3 { stop_of(&start, &limits).position } else { start.position };
        Self { start, limits, target: near + way * rng.sign() }
    }

    fn motion(&self) -> AxisMotion {
        let mut motions = [AxisMotion::still(0.0, 0.0)];
        to_rest(&[self.start], &[self.target], &[self.limits], &mut motions).unwrap();
        motions[0]
    }

    /// The velocity when the acceleration is brought to zero.
    fn eased(&self) -> f64 {
        let AxisState { velocity, acceleration, .. } = self.start;
        velocity + acceleration * acceleration.abs() / (2.0 * self.limits.jerk)
    }

    /// The largest velocity and acceleration that cannot be avoided, or are allowed.
    fn most(&self) -> [f64; 2] {
        let AxisState { velocity, acceleration, .. } = self.start;
        let fastest = velocity.abs().max(self.eased().abs()).max(self.limits.velocity);
        [fastest, acceleration.abs().max(self.limits.acceleration)]
    }

    /// Sizes of what is added up in positions, velocities and accelerations of a motion: a time
    /// since a phase began has the rounding of the duration.
    fn sizes(&self, duration: f64) -> [f64; 3] {
        let [velocity, acceleration] = self.most();
        let position = self.start.position.abs() + self.target.abs() + velocity * duration;
        [position, velocity + acceleration * duration, acceleration + self.limits.jerk * duration]
    }
}

fn stop_of(start: &AxisState, limits: &AxisLimits) -> AxisState {
    let motion = brake(start, limits).unwrap();
    motion.state(motion.duration())
}

/// The states at the ends of the phases, and their times. Between two of them the acceleration is
/// linear, so that the extremes of velocity are there or where the acceleration is zero.
fn ends_of_phases(motion: &AxisMotion) -> Vec<(f64, AxisState)> {
    let whole = Trajectory::of_axes(&[*motion]);
    whole.knots().iter().map(|time| (*time, motion.state(*time))).collect()
}

/// The largest velocity and acceleration of a motion, exactly.
fn peaks(motion: &AxisMotion) -> [f64; 3] {
    let peaks = Trajectory::of_axes(&[*motion]).peaks()[0];
    [peaks.velocity, peaks.acceleration, peaks.jerk]
}

fn check_ends_and_limits(case: &Case, motion: &AxisMotion, rounding: f64) {
    let (duration, sizes) = (motion.duration(), case.sizes(motion.duration()));
    let [start, end] = [motion.state(0.0), motion.state(duration)];
    for (found, wanted, size) in [
        (start.position, case.start.position, sizes[0]),
        (start.velocity, case.start.velocity, sizes[1]),
        (start.acceleration, case.start.acceleration, sizes[2]),
        (end.position, case.target, sizes[0]),
        (end.velocity, 0.0, sizes[1]),
        (end.acceleration, 0.0, sizes[2]),
    ] {
        assert!((found - wanted).abs() <= rounding * size, "{found} {wanted} {case:?}");
    }
    let ([velocity, acceleration, jerk], most) = (peaks(motion), case.most());
    assert!(velocity <= most[0] + rounding * sizes[1], "{velocity} {case:?}");
    assert!(acceleration <= most[1] + rounding * sizes[2], "{acceleration} {case:?}");
    assert!(jerk <= case.limits.jerk * (1.0 + rounding), "{jerk} {case:?}");
}

#[test]
fn every_motion_keeps_its_limits_and_ends_at_rest_at_the_target() {
    let mut rng = Rng::new(1);
    for most in [0.0, 0.7, 1.0, 3.0] {
        for _ in 0..5_000 {
            let case = Case::random(&mut rng, most);
            check_ends_and_limits(&case, &case.motion(), ROUNDING);
        }
    }
}

#[test]
fn positions_velocities_and_accelerations_are_continuous() {
    let mut rng = Rng::new(2);
    for _ in 0..5_000 {
        let case = Case::random(&mut rng, 1.5);
        let motion = case.motion();
        let sizes = case.sizes(motion.duration());
        let states = ends_of_phases(&motion);
        for window in states.windows(2) {
            let [(from, first), (to, second)] = [window[0], window[1]];
            let t = to - from;
            let jerk = (second.acceleration - first.acceleration) / t;
            assert!(jerk.abs() <= case.limits.jerk * (1.0 + 1e-6) || t < 1e-6, "{jerk} {case:?}");
            let velocity = first.velocity + t * (first.acceleration + second.acceleration) / 2.0;
            assert!((velocity - second.velocity).abs() <= ROUNDING * sizes[1], "{case:?}");
            let position = first.position
                + t * (first.velocity + t * (2.0 * first.acceleration + second.acceleration) / 6.0);
            assert!((position - second.position).abs() <= ROUNDING * sizes[0], "{case:?}");
        }
    }
}

#[test]
fn no_motion_is_slower_than_ruckig_found_it() {
    for (joints, duration) in BY_RUCKIG {
        let start: Vec<_> = joints
            .iter()
            .map(|joint| AxisState {
                position: joint[0],
                velocity: joint[1],
                acceleration: joint[2],
            })
            .collect();
        let target: Vec<_> = joints.iter().map(|joint| joint[3]).collect();
        let limits: Vec<_> = joints
            .iter()
            .map(|joint| AxisLimits { velocity: joint[4], acceleration: joint[5], jerk: joint[6] })
            .collect();
        let mut motions = vec![AxisMotion::still(0.0, 0.0); joints.len()];
        let found = to_rest(&start, &target, &limits, &mut motions).unwrap();
        assert!(found <= duration * (1.0 + 1e-9), "{found} {duration} {joints:?}");
        let rest: Vec<_> = target.iter().map(|angle| AxisState::at_rest(*angle)).collect();
        let whole = between(&start, &rest, &limits).unwrap();
        assert_eq!(whole.duration(), found);
    }
}

#[test]
fn a_motion_that_touches_the_limit_of_acceleration_in_one_point_is_found() {
    // Jerks j, -j, -j, 0, j, each for a / j, move by 6 a^3 / j^2 from a velocity of a^2 / j to rest.
    // ruckig 0.19.4 takes 2.4 times as long.
    for (acceleration, jerk) in [(1.4, 7.0), (2.0, 10.0), (0.5, 5.0), (10.0, 40.0)] {
        let case = Case {
            start: AxisState {
                position: 0.0,
                velocity: acceleration * acceleration / jerk,
                acceleration: 0.0,
            },
            limits: AxisLimits { velocity: acceleration, acceleration, jerk },
            target: 6.0 * acceleration.powi(3) / (jerk * jerk),
        };
        let motion = case.motion();
        let late = (ROUNDING * case.target / jerk).cbrt();
        assert!((motion.duration() - 5.0 * acceleration / jerk).abs() <= late, "{motion:?}");
    }
}

#[test]
fn from_rest_to_rest_it_is_the_s_curve() {
    let mut rng = Rng::new(3);
    for _ in 0..5_000 {
        let case = Case::random(&mut rng, 0.0);
        let curve =
            AxisMotion::within(Profile::SCurve, case.start.position, case.target, &case.limits);
        let motion = case.motion();
        // The way is a difference of positions; its cube root counts.
        let lost = 4.0 * f64::EPSILON * (case.start.position.abs() + case.target.abs());
        let late = (lost / case.limits.jerk).cbrt() + 1e-12 * curve.duration();
        assert!((motion.duration() - curve.duration()).abs() <= late, "{case:?}");
    }
}

#[test]
fn a_motion_under_way_takes_no_longer_than_its_rest() {
    let mut rng = Rng::new(4);
    for _ in 0..2_000 {
        let case = Case::random(&mut rng, 1.0);
        let motion = case.motion();
        let time = motion.duration() * rng.unit();
        let rest = Case { start: motion.state(time), ..case }.motion();
        let lost = ROUNDING * case.sizes(motion.duration())[0];
        let late = 3.0 * (lost / case.limits.jerk).cbrt();
        assert!(rest.duration() <= motion.duration() - time + late, "{case:?} {time}");
    }
}

#[test]
fn beyond_a_limit_of_velocity_a_joint_returns_and_stays_inside() {
    let mut rng = Rng::new(5);
    let mut beyond = 0;
    for _ in 0..5_000 {
        let case = Case::random(&mut rng, 3.0);
        let motion = case.motion();
        let bound = case.limits.velocity + ROUNDING * case.sizes(motion.duration())[1];
        let states = ends_of_phases(&motion);
        let outside: Vec<_> =
            states.iter().map(|(_, state)| state.velocity.abs() > bound).collect();
        // Out at once or while the acceleration of the start ends, then inside for good.
        let changes = outside.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let is_pushed = case.eased().abs() > bound;
        assert!(changes <= usize::from(outside[0]) + 2 * usize::from(is_pushed), "{case:?}");
        assert!(!outside[outside.len() - 1]);
        beyond += usize::from(outside[0]);
    }
    assert!(enough(beyond > 2_000));
}

#[test]
fn joints_end_together_and_each_keeps_its_limits() {
    let mut rng = Rng::new(6);
    let mut slowed = 0;
    for most in [0.0, 0.7, 1.0, 2.0] {
        for _ in 0..1_000 {
            let cases: [Case; 6] = std::array::from_fn(|_| Case::random(&mut rng, most));
            let starts = cases.each_ref().map(|case| case.start);
            let targets = cases.each_ref().map(|case| case.target);
            let bounds = cases.each_ref().map(|case| case.limits);
            let mut motions = [AxisMotion::still(0.0, 0.0); 6];
            let duration = to_rest(&starts, &targets, &bounds, &mut motions).unwrap();
            let alone = cases.each_ref().map(|case| case.motion().duration());
            let longest = alone.iter().copied().fold(0.0, f64::max);
            assert_eq!(duration, longest);
            for (case, (motion, alone)) in cases.iter().zip(motions.iter().zip(alone)) {
                // A stretch to the last digit changes a jerk by 3e-12 of it.
                check_ends_and_limits(case, motion, ROUNDING + 3e-12);
                // The way beyond the stop has the rounding of all positions, and so has the cruise
                // velocity, as a part.
                let way = (case.target - stop_of(&case.start, &case.limits).position).abs();
                let early = duration - motion.duration();
                let rounding = ROUNDING * case.sizes(duration)[0] / way;
                assert!((0.0..=rounding * duration).contains(&early), "{early} {case:?}");
                slowed += usize::from(alone < 0.9 * duration && early == 0.0);
            }
        }
    }
    assert!(enough(slowed > 15_000), "{slowed}");
}

#[test]
fn a_brake_ends_at_rest_and_turns_round_only_if_it_must() {
    let mut rng = Rng::new(7);
    for most in [0.5, 1.0, 3.0] {
        for _ in 0..5_000 {
            let case = Case::random(&mut rng, most);
            let motion = brake(&case.start, &case.limits).unwrap();
            let target = motion.state(motion.duration()).position;
            let case = Case { target, ..case };
            check_ends_and_limits(&case, &motion, ROUNDING);
            let states = ends_of_phases(&motion);
            assert!(states.len() <= 4);
            let sizes = case.sizes(motion.duration());
            // The velocity goes to zero, or first to where the acceleration is zero if that leads
            // away from zero.
            let (velocity, eased) = (case.start.velocity, case.eased());
            let turn = if case.start.acceleration * eased > 0.0 { eased } else { 0.0 };
            let [low, high] = [velocity.min(turn).min(0.0), velocity.max(turn).max(0.0)];
            let rounding = ROUNDING * sizes[1];
            for (_, state) in &states {
                assert!(low - rounding <= state.velocity, "{case:?}");
                assert!(state.velocity <= high + rounding, "{case:?}");
            }
            let turns = states.windows(2).filter(|pair| {
                pair[0].1.acceleration * pair[1].1.acceleration < -ROUNDING * sizes[2] * sizes[2]
            });
            assert!(turns.count() <= usize::from(turn != 0.0), "{case:?}");
        }
    }
}

#[test]
fn a_brake_is_the_shortest_motion_to_where_it_ends() {
    let mut rng = Rng::new(8);
    for _ in 0..2_000 {
        let case = Case::random(&mut rng, 1.0);
        let motion = brake(&case.start, &case.limits).unwrap();
        let target = motion.state(motion.duration()).position;
        let other = Case { target, ..case }.motion();
        let late = 1e-12 * motion.duration();
        assert!((other.duration() - motion.duration()).abs() <= late, "{case:?}");
    }
}

#[test]
fn the_way_to_a_moving_end_begins_at_rest() {
    let mut rng = Rng::new(9);
    for _ in 0..1_000 {
        let cases: [Case; 3] = std::array::from_fn(|_| Case::random(&mut rng, 0.5));
        let start = cases.each_ref().map(|case| case.start);
        let end = cases.each_ref().map(|case| AxisState {
            position: case.target,
            velocity: -case.start.velocity,
            acceleration: 0.3 * case.start.acceleration,
        });
        let limits = cases.each_ref().map(|case| case.limits);
        let motion = between(&start, &end, &limits).unwrap();
        let time = [0.0, motion.duration()];
        let [mut q, mut dq, mut ddq] = [[0.0; 6]; 3];
        motion.sample(&time, &mut q, &mut dq, &mut ddq).unwrap();
        for (joint, case) in cases.iter().enumerate() {
            let sizes = case.sizes(motion.duration());
            for (row, state) in [(0, start[joint]), (3, end[joint])] {
                let rounding = ROUNDING * sizes[0];
                assert!((q[row + joint] - state.position).abs() <= rounding + 1e-12, "{case:?}");
                assert!((dq[row + joint] - state.velocity).abs() <= 1e-9, "{case:?}");
                assert!((ddq[row + joint] - state.acceleration).abs() <= 1e-9 * sizes[2]);
            }
            let peaks = motion.peaks()[joint];
            assert!(peaks.velocity <= case.limits.velocity * (1.0 + 1e-9), "{case:?}");
            assert!(peaks.acceleration <= case.limits.acceleration * (1.0 + 1e-9), "{case:?}");
            assert!(peaks.jerk <= case.limits.jerk * (1.0 + 1e-9), "{case:?}");
        }
    }
}

#[test]
fn what_cannot_be_is_named() {
    let state = AxisState::at_rest(0.0);
    let limits = AxisLimits { velocity: 1.0, acceleration: 1.0, jerk: 1.0 };
    let words = |start: AxisState, limits: AxisLimits| {
        let error: Error = brake(&start, &limits).unwrap_err();
        error.to_string()
    };
    let fast = AxisState { velocity: f64::NAN, ..state };
    assert!(words(fast, limits).contains("velocity[0] is NaN"), "{}", words(fast, limits));
    let free = AxisLimits { jerk: f64::INFINITY, ..limits };
    assert!(words(state, free).contains("max_jerk[0] is inf"), "{}", words(state, free));
    let none = AxisLimits { acceleration: 0.0, ..limits };
    assert!(words(state, none).contains("max_acceleration[0] is 0"), "{}", words(state, none));
    let mut motions = [AxisMotion::still(0.0, 0.0)];
    let error = to_rest(&[state], &[1.0, 2.0], &[limits], &mut motions).unwrap_err();
    let wrong = irbkin::Error::WrongLength { field: "target", found: 2, wanted: 1 };
    assert_eq!(error, wrong.into());
    assert!(to_rest(&[state], &[f64::NAN], &[limits], &mut motions).is_err());
    let far = AxisState { velocity: 1e300, ..state };
    assert!(to_rest(&[far], &[0.0], &[limits], &mut motions).is_err());
    assert!(brake(&far, &limits).is_err());
    let error = between(&[], &[], &[]).unwrap_err().to_string();
    assert!(error.contains("end has no joints"), "{error}");
    let error = between(&[state], &[state; 2], &[limits; 2]).unwrap_err();
    let wrong = irbkin::Error::WrongLength { field: "start", found: 1, wanted: 2 };
    assert_eq!(error, wrong.into());
}

#[test]
fn a_motion_whose_accelerations_overflow_is_refused() {
    for most in [1e155, f64::MAX] {
        let limits = AxisLimits { velocity: 1.0, acceleration: most, jerk: most };
        let tense = AxisState { acceleration: most, ..AxisState::at_rest(0.0) };
        assert!(brake(&tense, &limits).is_err());
        let calm = AxisState::at_rest(0.0);
        assert!(between(&[tense], &[calm], &[limits]).is_err());
        assert!(between(&[calm], &[tense], &[limits]).is_err());
    }
    let fast = AxisLimits { velocity: 1.0, acceleration: 1.0, jerk: f64::MAX };
    let state = AxisState { velocity: 1.0, ..AxisState::at_rest(0.0) };
    assert!((brake(&state, &fast).unwrap().duration() - 1.0).abs() < 1e-12);
}
