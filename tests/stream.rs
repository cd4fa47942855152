//! Laws of the guard: whatever the references, set points and the motion between them are within
//! the bounds and free, and a braking motion that is so exists after every cycle.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "counts of cycles"
)]

use crate::common::{Rng, poses_or};

use irbkin::Pose;
use irbkin_motion::Arm;
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;
use irbkin_motion::stream::{Guard, GuardOptions, OnViolation, State, Step};
use irbkin_motion::trajectory::state::to_rest;
use irbkin_motion::trajectory::{
    AxisLimits, AxisMotion, AxisState, Profile, Synchronization, Trajectory, joint_within,
};

const CYCLE: f64 = 0.004;

/// Velocity, acceleration and jerk of all joints [rad, s].
const LIMITS: AxisLimits = AxisLimits { velocity: 1.8, acceleration: 8.0, jerk: 60.0 };

/// By how much a bound may be exceeded: part of it, as a checked trajectory may.
const PART: f64 = 1e-8;

/// Box, cylinder and floor around an arm that reaches so far.
fn cell(reach: f64) -> Cell {
    let at = |x: f64, y: f64, z: f64| Pose::translation(reach * x, reach * y, reach * z);
    let size = [0.3 * reach; 3];
    let obstacles = vec![
        ("box".to_string(), Shape::cuboid(size, &at(0.65, 0.25, 0.2)).unwrap()),
        ("post".to_string(), Shape::cylinder(0.06 * reach, reach, &at(-0.1, 0.6, 0.4)).unwrap()),
        ("floor".to_string(), Shape::half_space([0.0, 0.0, 1.0], [0.0, 0.0, -0.01]).unwrap()),
    ];
    Cell::new(obstacles, 0.005).unwrap()
}

/// An arm, its cell, a start and a guard.
struct Case<const N: usize> {
    robot: Arm<N>,
    cell: Cell,
    guard: Guard<N>,
    last: Step<N>,
}

impl<const N: usize> Case<N> {
    fn new(robot: Arm<N>, cell: Cell, start: [f64; N], options: &GuardOptions<N>) -> Self {
        let mut guard = Guard::new(&robot, &start, Some(&cell), options).unwrap();
        let last = guard.step(&start);
        assert!(last.accepted);
        Self { robot, cell, guard, last }
    }

    /// Check the motion from the last set point to the next one: the cubic of joint angles and
    /// velocities at both ends.
    fn check(&mut self, step: Step<N>) {
        let (one, two) = (&self.last, &step);
        let mut middle = [0.0; N];
        for joint in 0..N {
            let (q, next) = (one.q[joint], two.q[joint]);
            let (dq, after) = (one.dq[joint], two.dq[joint]);
            let slope = (next - q) / CYCLE;
            let bend = (3.0 * slope - 2.0 * dq - after) / CYCLE;
            let jerk = 6.0 * (dq + after - 2.0 * slope) / (CYCLE * CYCLE);
            let turn = if jerk == 0.0 { 0.0 } else { (-2.0 * bend / jerk).clamp(0.0, CYCLE) };
            let velocity = |t: f64| dq + t * (2.0 * bend + 0.5 * t * jerk);
            // Rounding of the set points, over the cycle.
            let digits = 32.0 * f64::EPSILON * (1.0 + q.abs());
            for time in [0.0, turn, CYCLE] {
                let most = LIMITS.velocity * (1.0 + PART) + digits / CYCLE;
                assert!(velocity(time).abs() <= most, "joint {joint}: {}", velocity(time));
            }
            for acceleration in [2.0 * bend, 2.0 * bend + CYCLE * jerk, two.ddq[joint]] {
                let most = LIMITS.acceleration * (1.0 + PART) + digits / CYCLE.powi(2);
                assert!(acceleration.abs() <= most, "joint {joint}: {acceleration}");
            }
            let most = LIMITS.jerk * (1.0 + PART) + 6.0 * digits / CYCLE.powi(3);
            assert!(jerk.abs() <= most, "joint {joint}: {jerk}");
            let half = 0.5 * CYCLE;
            middle[joint] = q + half * (dq + half * (bend + half * jerk / 6.0));
        }
        assert!(self.robot.limits().contains(&two.q), "{:?}", two.q);
        assert!(self.robot.limits().contains(&middle));
        for q in [&two.q, &middle] {
            assert!(!self.cell.collides(&self.robot, q).unwrap(), "{q:?}");
        }
        assert_eq!(step.accepted, step.reason.is_none());
        self.last = step;
    }

    /// Check that the guard can brake: set points within the bounds until it holds.
    fn check_brake(&self) {
        let (robot, cell) = (self.robot.clone(), self.cell.clone());
        let mut other = Self { robot, cell, guard: self.guard.clone(), last: self.last };
        for _ in 0..3000 {
            let step = other.guard.step_none();
            other.check(step);
            if step.state == State::Holding {
                assert_eq!((step.dq, step.ddq), ([0.0; N], [0.0; N]));
                assert_eq!(other.guard.step_none().q, step.q);
                return;
            }
        }
        panic!("no rest");
    }
}

/// References of one kind for a while.
enum Burst<const N: usize> {
    Missing,
    Broken(f64),
    Goal([f64; N]),
    Ramp([f64; N]),
    Noise(f64),
    Pose([f64; N]),
    Swing([f64; N]),
    Recorded(Trajectory, f64),
}

impl<const N: usize> Burst<N> {
    fn drawn(case: &Case<N>, rng: &mut Rng) -> Self {
        let here = case.guard.q();
        let limits = case.robot.limits();
        match rng.bits() % 9 {
            0 => Self::Missing,
            1 => Self::Broken([f64::NAN, f64::INFINITY, 1e9, -1e300][(rng.bits() % 4) as usize]),
            2 => Self::Goal(rng.inside(limits)),
            3 => Self::Ramp(core::array::from_fn(|_| rng.between(-2.2, 2.2) * CYCLE)),
            4 => Self::Noise(10.0_f64.powf(rng.between(-7.0, -1.0))),
            5 => Self::Pose(core::array::from_fn(|_| rng.between(-1.0, 1.0) * 3e-3)),
            6 => Self::Swing(core::array::from_fn(|_| rng.between(-0.3, 0.3))),
            7 => Self::Goal(core::array::from_fn(|i| {
                let [low, high] = limits.to_array()[i];
                if rng.unit() < 0.3 { if rng.unit() < 0.5 { low } else { high } } else { here[i] }
            })),
            _ => Self::recorded(case, rng),
        }
    }

    fn recorded(case: &Case<N>, rng: &mut Rng) -> Self {
        let (here, goal) = (case.guard.q(), rng.inside(case.robot.limits()));
        let synchronization = Synchronization::Time;
        let motion = joint_within(Profile::SCurve, &here, &goal, &[LIMITS; N], synchronization);
        Self::Recorded(motion.unwrap(), rng.between(0.9, 1.05))
    }

    fn step(&self, case: &mut Case<N>, at: usize, rng: &mut Rng) -> Step<N> {
        let time = at as f64 * CYCLE;
        let here = case.guard.q();
        let moved = |by: &dyn Fn(usize) -> f64| core::array::from_fn(|i| here[i] + by(i));
        match self {
            Self::Missing => case.guard.step_none(),
            Self::Broken(value) => {
                let mut q = here;
                q[at % N] = *value;
                case.guard.step(&q)
            }
            Self::Goal(q) => case.guard.step(q),
            Self::Ramp(pace) => case.guard.step(&moved(&|i| 2.0 * pace[i])),
            Self::Noise(size) => {
                let noise: [f64; N] = core::array::from_fn(|_| size * rng.between(-1.0, 1.0));
                case.guard.step(&moved(&|i| noise[i]))
            }
            Self::Pose(pace) => {
                let pose = case.robot.fk(&moved(&|i| pace[i]));
                case.guard.step_pose(&pose)
            }
            Self::Swing(size) => {
                case.guard.step(&moved(&|i| size[i] * ((3.0 * time).sin() - 0.1).powi(3) * 0.1))
            }
            Self::Recorded(motion, pace) => {
                let mut q = [0.0; N];
                let at = (pace * time).min(motion.duration());
                motion.sample(&[at], &mut q, &mut [0.0; N], &mut [0.0; N]).unwrap();
                case.guard.step(&q)
            }
        }
    }
}

fn options<const N: usize>(on_violation: OnViolation) -> GuardOptions<N> {
    GuardOptions {
        max_velocity: Some([LIMITS.velocity; N]),
        max_jerk: Some([LIMITS.jerk; N]),
        on_violation,
        ..GuardOptions::new(CYCLE, [LIMITS.acceleration; N])
    }
}

fn reach<const N: usize>(robot: &Arm<N>) -> f64 {
    crate::common::reach_of(robot)
}

/// A joint vector inside the limits that touches nothing.
fn free_start<const N: usize>(robot: &Arm<N>, cell: &Cell, rng: &mut Rng) -> [f64; N] {
    loop {
        let q = rng.inside(robot.limits());
        let is_inside = robot.limits().contains(&q);
        if is_inside && !cell.collides(robot, &q).unwrap() {
            return q;
        }
    }
}

fn bounds_hold<const N: usize>(robot: &Arm<N>, cycles: usize) {
    let cell = cell(reach(robot));
    for on_violation in [OnViolation::Brake, OnViolation::Limit] {
        let mut rng = Rng::new(60);
        let start = free_start(robot, &cell, &mut rng);
        let options = options(on_violation);
        let mut case = Case::new(robot.clone(), cell.clone(), start, &options);
        let (mut done, mut accepted, mut states) = (0, 0, [0; 3]);
        while done < cycles {
            let burst = Burst::drawn(&case, &mut rng);
            // A recorded motion begins at rest; of several, the guard is at rest in every other.
            let waits = matches!(burst, Burst::Recorded(..)) && rng.unit() < 0.5;
            while waits && case.last.state != State::Holding {
                let step = case.guard.step_none();
                case.check(step);
            }
            let burst = if waits { Burst::recorded(&case, &mut rng) } else { burst };
            for at in 0..=(rng.bits() % 250) as usize {
                let step = burst.step(&mut case, at, &mut rng);
                case.check(step);
                accepted += usize::from(step.accepted);
                states[step.state as usize] += 1;
                done += 1;
                if rng.bits().is_multiple_of(199) {
                    case.check_brake();
                }
            }
        }
        println!("{} {on_violation:?}: {accepted} of {done} accepted, {states:?}", robot.name());
        // In "limit" a random reference is seldom where the bounds lead.
        let least = if on_violation == OnViolation::Brake { cycles / 50 } else { cycles / 400 };
        assert!(accepted > least && states.iter().all(|count| *count > cycles / 100));
    }
}

fn six(name: &str) -> Arm<6> {
    Arm::named(name).unwrap()
}

/// Cycles of each arm and mode.
fn cycles() -> usize {
    poses_or(4000)
}

#[test]
fn bounds_hold_for_spherical_wrists() {
    bounds_hold(&six("IRB 2600-12/1.65"), cycles());
    bounds_hold(&six("IRB 6650S-90/3.9"), cycles());
}

#[test]
fn bounds_hold_for_a_linkage() {
    let robot = six("IRB 2400-10/1.55");
    let robot = robot.map(|robot| robot.with_linkage_limits(Some([-1.2, 0.6]))).unwrap();
    assert!(robot.is_coupled());
    bounds_hold(&robot, cycles());
}

#[test]
fn bounds_hold_for_others() {
    for name in ["UR5e", "GoFa 5", "xArm6"] {
        bounds_hold(&six(name), cycles());
    }
}

#[test]
fn bounds_hold_for_seven_axes() {
    bounds_hold(&Arm::<7>::named("Panda").unwrap(), cycles());
}

#[test]
fn checked_trajectories_are_followed() {
    let robot = six("IRB 2600-12/1.65");
    let mut rng = Rng::new(7);
    let (cell, limits) = (Cell::default(), [LIMITS; 6]);
    let mut kinds = [0; 2];
    for _ in 0..poses_or(4000) / 40 {
        let start = free_start(&robot, &cell, &mut rng);
        let mut near = || -> [f64; 6] {
            let q: [f64; 6] = rng.inside(robot.limits());
            core::array::from_fn(|i| start[i] + 0.3 * (q[i] - start[i]))
        };
        let goal = near();
        let profiles = [Profile::SCurve, Profile::Quintic];
        let mut motions: Vec<Trajectory> = profiles
            .into_iter()
            .map(|profile| joint_within(profile, &start, &goal, &limits, Synchronization::Time))
            .map(Result::unwrap)
            .collect();
        motions.retain(|motion| cell.check_trajectory(&robot, motion).unwrap().is_none());
        for motion in motions {
            for on_violation in [OnViolation::Brake, OnViolation::Limit] {
                let mut guard =
                    Guard::new(&robot, &start, Some(&cell), &options(on_violation)).unwrap();
                let count = (motion.duration() / CYCLE) as usize + 4;
                let mut q = [0.0; 6];
                for cycle in 0..count {
                    let time = (cycle as f64 * CYCLE).min(motion.duration());
                    motion.sample(&[time], &mut q, &mut [0.0; 6], &mut [0.0; 6]).unwrap();
                    let step = guard.step(&q);
                    assert!(step.accepted, "{cycle} of {count}: {:?}", step.reason);
                }
                assert_eq!(guard.q(), q);
                kinds[on_violation as usize] += 1;
            }
        }
    }
    println!("{kinds:?} trajectories followed");
    assert!(kinds[0] > 50);
}

#[test]
fn goals_are_reached_nearly_as_fast_as_they_can_be() {
    let robot = six("UR5e");
    let cell = Cell::default();
    let mut rng = Rng::new(11);
    let (mut reached, mut tried, mut changes, mut slowest) = (0, 0, 0, 0.0_f64);
    while tried < poses_or(4000) / 40 {
        let start: [f64; 6] = free_start(&robot, &cell, &mut rng);
        let goal: [f64; 6] = core::array::from_fn(|i| start[i] + rng.between(-1.0, 1.0));
        let path = cell.check_path(&robot, &[start, goal]).unwrap();
        if !robot.limits().contains(&goal) || path.is_some() {
            continue;
        }
        tried += 1;
        let state = |position| AxisState { position, velocity: 0.0, acceleration: 0.0 };
        let mut motions = [AxisMotion::still(0.0, 0.0); 6];
        let least = to_rest(&start.map(state), &goal, &[LIMITS; 6], &mut motions).unwrap();
        let options = options(OnViolation::Limit);
        let mut guard = Guard::new(&robot, &start, Some(&cell), &options).unwrap();
        let (mut at, mut was_accepted) = (None, false);
        for cycle in 0..(2.0 * least / CYCLE) as usize + 100 {
            let step = guard.step(&goal);
            changes += usize::from(was_accepted && !step.accepted);
            was_accepted = step.accepted;
            if at.is_none() && step.q == goal {
                at = Some(cycle as f64 * CYCLE);
            }
        }
        if let Some(time) = at {
            reached += usize::from(time <= 1.5 * least);
            slowest = slowest.max(time / least);
        }
    }
    println!("{reached} of {tried} reached, the slowest in {slowest:.3} x, {changes} changes");
    assert!(100 * reached >= 95 * tried, "{reached} of {tried}");
    assert_eq!(changes, 0);
}

/// What a reference is disturbed by.
#[derive(Clone, Copy, Debug)]
enum Disturbance {
    /// Evenly within a size [rad].
    Noise(f64),
    /// Of the time, evenly within so many cycles.
    Jitter(f64),
    /// To a unit [rad].
    Rounding(f64),
}

/// Cycles [s] and limits of controllers.
fn common_limits() -> [(f64, AxisLimits); 4] {
    let of = |velocity, acceleration, jerk| AxisLimits { velocity, acceleration, jerk };
    [
        (0.001, of(2.0, 8.0, 60.0)),
        (0.004, of(2.0, 8.0, 60.0)),
        (0.004, of(1.0, 2.0, 10.0)),
        (0.004, of(3.0, 20.0, 400.0)),
    ]
}

const START: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 0.5, 0.0];

/// A guard that proves nothing.
fn bare(cycle: f64, limits: AxisLimits, on_violation: OnViolation, hold: f64) -> Guard<6> {
    let options = GuardOptions {
        max_velocity: Some([limits.velocity; 6]),
        max_jerk: Some([limits.jerk; 6]),
        on_violation,
        hold,
        ..GuardOptions::new(cycle, [limits.acceleration; 6])
    };
    Guard::new(&six("IRB 2600-12/1.65"), &START, None, &options).unwrap()
}

/// Give joint 1 a reference.
fn turned(angle: f64) -> [f64; 6] {
    let mut q = START;
    q[0] = angle;
    q
}

/// A sine with at most a part of the limits of velocity, acceleration and jerk, eased in.
fn sine(limits: AxisLimits, part: f64) -> impl Fn(f64) -> f64 {
    let AxisLimits { velocity, acceleration, jerk } = limits;
    let rate = (acceleration / velocity).min((jerk / velocity).sqrt());
    move |time| {
        let turn = (rate * time / core::f64::consts::TAU).min(1.0);
        let ease = turn.powi(4) * (35.0 - 84.0 * turn + 70.0 * turn.powi(2) - 20.0 * turn.powi(3));
        part * velocity / rate * (rate * time).sin() * ease
    }
}

/// How far a joint goes beyond one cycle of lag from a clean reference that it gets disturbed, and
/// the largest deviation of the references [rad].
fn disturbed(guard: &mut Guard<6>, clean: impl Fn(f64) -> f64, by: Disturbance) -> [f64; 2] {
    let cycle = guard.cycle();
    let mut rng = Rng::new(5);
    let [mut most, mut lag, mut deviation] = [0.0_f64; 3];
    for count in 0..(12.0 / cycle) as usize {
        let time = count as f64 * cycle;
        let own = clean(time);
        let given = match by {
            Disturbance::Noise(size) => own + size * rng.between(-1.0, 1.0),
            Disturbance::Jitter(cycles) => clean(time + cycles * cycle * rng.between(-1.0, 1.0)),
            Disturbance::Rounding(unit) => (own / unit).round() * unit,
        };
        let q = guard.step(&turned(given)).q[0];
        most = most.max((q - own).abs());
        lag = lag.max((own - clean(time - cycle)).abs());
        deviation = deviation.max((given - own).abs());
    }
    [most - lag, deviation]
}

#[test]
fn noise_jitter_and_rounding_are_amplified_by_three_at_most() {
    use Disturbance::{Jitter, Noise, Rounding};
    let noises = [1e-6, 1e-5, 1e-4, 1e-3].map(Noise);
    let others = [Rounding(1e-5), Rounding(1e-4), Rounding(1.745e-4), Rounding(1e-3)];
    let others = [&others[..], &[Jitter(0.1), Jitter(1.0)]].concat();
    for (cycle, limits) in common_limits() {
        // The least change of a set point that a limit of jerk allows.
        let least = limits.jerk * cycle.powi(3);
        for part in [0.0, 0.05, 0.1, 0.25] {
            let kinds = if part > 0.0 { &others[..] } else { &[] };
            for by in noises.iter().chain(kinds) {
                let mut guard = bare(cycle, limits, OnViolation::Limit, 0.0);
                let [beyond, deviation] = disturbed(&mut guard, sine(limits, part), *by);
                println!("{cycle} s, {part} of {limits:?}, {by:?}: {:.2}", beyond / deviation);
                let most = 3.0 * deviation + 8.0 * least;
                assert!(beyond <= most, "{cycle} s, {part} of {limits:?}, {by:?}: {beyond}");
            }
        }
    }
}

#[test]
fn whatever_the_references_a_joint_stays_within_25_times_their_deviation() {
    let mut worst = 0.0_f64;
    for (cycle, limits) in common_limits() {
        for size in [1e-5, 1e-4, 1e-3, 1e-2, 1e-1] {
            let mut rng = Rng::new(9);
            let mut guard = bare(cycle, limits, OnViolation::Limit, 0.0);
            for _ in 0..poses_or(4000) / 50 {
                let rate = 10.0_f64.powf(rng.between(-3.0, 0.5));
                let (kind, period) = (rng.bits() % 4, 1 + rng.bits() % 60);
                let offset = rng.between(-1.0, 1.0);
                for count in 0..200_u32 {
                    let angle = rate * f64::from(count);
                    let given = match kind {
                        0 => (angle + offset).sin(),
                        1 => (angle + offset).sin().signum(),
                        2 => {
                            if u64::from(count) % period == 0 {
                                offset
                            } else {
                                -offset
                            }
                        }
                        _ => rng.between(-1.0, 1.0),
                    };
                    let q = guard.step(&turned(size * given)).q[0];
                    worst = worst.max(q.abs() / size);
                    assert!(q.abs() <= 25.0 * size, "{cycle} s, {limits:?}, {size}: {q}");
                }
            }
        }
    }
    println!("at most {worst:.2} times");
    assert!(worst > 1.0);
}

#[test]
fn rounded_references_are_followed_by_a_guard_that_brakes() {
    let limits = LIMITS;
    for by in [Disturbance::Rounding(1.745e-4), Disturbance::Noise(1e-5)] {
        let mut guard = bare(CYCLE, limits, OnViolation::Brake, 0.0);
        let [beyond, deviation] = disturbed(&mut guard, sine(limits, 0.1), by);
        println!("{by:?}: {:.2}", beyond / deviation);
        assert!(beyond <= 3.0 * deviation, "{by:?}: {beyond}");
        let here = guard.q()[0];
        for count in 0..500 {
            let step = guard.step(&turned(here + 0.5));
            assert!(!step.accepted && step.state != State::Following, "{count}");
        }
        assert!((guard.q()[0] - here).abs() < 0.1);
    }
}

#[test]
fn references_at_30_hz_are_gone_towards_for_the_time_of_the_hold() {
    for on_violation in [OnViolation::Brake, OnViolation::Limit] {
        let clean = sine(LIMITS, 0.25);
        let mut guard = bare(CYCLE, LIMITS, on_violation, 0.04);
        let (mut last, mut most) = (-1, 0.0_f64);
        for count in 0..3000 {
            let time = f64::from(count) * CYCLE;
            let frame = (30.0 * time).floor() as i32;
            let step = if frame == last {
                guard.step_none()
            } else {
                guard.step(&turned(clean(f64::from(frame) / 30.0)))
            };
            last = frame;
            most = most.max((step.q[0] - clean(time)).abs());
        }
        // A reference is a thirtieth of a second old at most.
        let oldest = 0.25 * LIMITS.velocity / 30.0;
        println!("{on_violation:?}: {:.2} of the way in a frame", most / oldest);
        assert!(most <= 3.0 * oldest, "{on_violation:?}: {most}");
        let states: Vec<State> = (0..200).map(|_| guard.step_none().state).collect();
        let held = states.iter().take_while(|state| **state == State::Following).count();
        assert!((2..=10).contains(&held) && states[199] == State::Holding, "{held}");
    }
}

#[test]
fn a_hold_is_from_nothing_to_ten_seconds() {
    for hold in [-0.1, f64::NAN, 40.0] {
        let options = GuardOptions { hold, ..options(OnViolation::Brake) };
        let fault = Guard::new(&six("IRB 2600-12/1.65"), &START, None, &options).err().unwrap();
        assert!(fault.to_string().contains("it must be from 0 to 10 s"), "{fault}");
    }
}
