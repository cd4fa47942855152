//! A quintic between two joint vectors of an IRB 2600, by duration and by limits.

use irbkin::Robot;
use irbkin_motion::Error;
use irbkin_motion::trajectory::{
    AxisLimits, AxisState, Peaks, Profile, Synchronization, Trajectory, joint, joint_within,
};

// Joint angles of the controller [deg]; as angles of a Denavit-Hartenberg table, J2 is less by 90
// and J6 by 180.
const START: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 90.0, 0.0];
const END: [f64; 6] = [90.0, -10.0, 40.0, 10.0, 60.0, 60.0];
/// Of each joint [deg/s^2]: no catalog has it.
const ACCELERATION: f64 = 500.0;

fn row(label: &str, angles: impl IntoIterator<Item = f64>) -> String {
    let degrees: Vec<String> =
        angles.into_iter().map(|angle| format!("{:8.2}", angle.to_degrees())).collect();
    format!("{label:>12} {}", degrees.join(" "))
}

/// Joint angles, velocities and accelerations at one time.
fn state(motion: &Trajectory, time: f64) -> Result<[[f64; 6]; 3], Error> {
    let [mut q, mut dq, mut ddq] = [[0.0; 6]; 3];
    motion.sample(&[time], &mut q, &mut dq, &mut ddq)?;
    Ok([q, dq, ddq])
}

fn main() -> Result<(), Error> {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    let (start, end) = (START.map(f64::to_radians), END.map(f64::to_radians));
    let motion =
        joint(Profile::Quintic, &start.map(AxisState::at_rest), &end.map(AxisState::at_rest), 1.0)?;
    let times = motion.times(50)?;
    println!("{} samples over {:.3} s, in degrees\n", times.len(), motion.duration());
    println!("       t [s]       J1       J2       J3       J4       J5       J6");
    for time in times.iter().step_by(7) {
        println!("{}", row(&format!("{time:.3}"), state(&motion, *time)?[0]));
    }

    let peaks = motion.peaks();
    let velocities = robot.max_velocity().copied().unwrap_or([f64::INFINITY; 6]);
    let of = |number: fn(&Peaks) -> f64| peaks.iter().map(number).collect::<Vec<_>>();
    println!("\nthe largest velocity and acceleration, between samples too, per second");
    println!("{}", row("velocity", of(|peaks| peaks.velocity)));
    println!("{}", row("catalog's", velocities));
    println!("{}", row("acceleration", of(|peaks| peaks.acceleration)));

    // The same way as fast as the limits allow.
    let acceleration = ACCELERATION.to_radians();
    let limits =
        velocities.map(|velocity| AxisLimits { velocity, acceleration, jerk: f64::INFINITY });
    let fast = joint_within(Profile::Quintic, &start, &end, &limits, Synchronization::Time)?;
    let peaks = fast.peaks();
    let used = peaks.iter().map(|peaks| peaks.acceleration / acceleration);
    let (most, part) =
        used.enumerate().fold((0, 0.0), |most, own| if own.1 > most.1 { own } else { most });
    println!("\nwithin the catalog's velocities and 500 deg/s^2: {:.3} s", fast.duration());
    println!("J{} uses {:.1} % of its acceleration", most + 1, 100.0 * part);

    // The middle of the motion, exactly; nothing jumps at the ends.
    println!("{}", row("at 0.5 s", state(&motion, 0.5)?[0]));
    for time in [0.0, motion.duration()] {
        let [_, velocity, acceleration] = state(&motion, time)?;
        assert!(velocity.iter().chain(&acceleration).all(|number| number.abs() < 1e-12));
    }
    Ok(())
}
