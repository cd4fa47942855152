//! Messages of EGM: what is written is read, and no bytes do harm.

use irbkin_abb::Error;
use irbkin_abb::egm::{
    EgmData, EgmHeader, EgmPose, EgmPosition, EgmRobot, EgmSensor, EgmSpeed, EgmState, EgmTimestamp,
};
use proptest::collection::vec;
use proptest::option::of;
use proptest::prelude::*;
use proptest::sample::Index;

fn headers() -> impl Strategy<Value = EgmHeader> {
    (of(any::<u32>()), of(any::<u32>()), of(any::<i32>()))
        .prop_map(|(seqno, tm, mtype)| EgmHeader { seqno, tm, mtype })
}

fn doubles() -> impl Strategy<Value = Vec<f64>> {
    vec(-1e9..1e9, 0..8)
}

fn positions() -> impl Strategy<Value = EgmPosition> {
    let poses = (of(any::<[f64; 3]>()), of(any::<[f64; 4]>()), of(any::<[f64; 3]>()))
        .prop_map(|(pos, orient, euler)| EgmPose { pos, orient, euler });
    let stamps =
        (of(any::<u64>()), of(any::<u64>())).prop_map(|(sec, nsec)| EgmTimestamp { sec, nsec });
    (of(doubles()), of(poses), of(doubles()), of(any::<[u64; 2]>()), of(stamps)).prop_map(
        |(joints, cartesian, external_joints, time, time_stamp)| EgmPosition {
            joints,
            cartesian,
            external_joints,
            time,
            time_stamp,
        },
    )
}

fn data() -> impl Strategy<Value = EgmData> {
    (of(any::<bool>()), doubles()).prop_map(|(flag, values)| EgmData { flag, values })
}

fn robots() -> impl Strategy<Value = EgmRobot> {
    let states = || of(any::<i32>().prop_map(EgmState));
    let first = (of(headers()), of(positions()), of(positions()), states(), states());
    let second = (of(any::<bool>()), of(doubles()), states(), of(data()), of(any::<f64>()));
    let third = (of(any::<u32>()), of(data()), of(data()), of(doubles()));
    (first, second, third).prop_map(|(a, b, c)| EgmRobot {
        header: a.0,
        feedback: a.1,
        planned: a.2,
        motor_state: a.3,
        mci_state: a.4,
        mci_convergence_met: b.0,
        test_signals: b.1,
        rapid_exec_state: b.2,
        measured_force: b.3,
        utilization_rate: b.4,
        move_index: c.0,
        collision_info: c.1,
        rapid_from_robot: c.2,
        torque_ref: c.3,
    })
}

fn sensors() -> impl Strategy<Value = EgmSensor> {
    let speeds = (of(doubles()), of(doubles()), of(doubles())).prop_map(
        |(joints, cartesians, external_joints)| EgmSpeed { joints, cartesians, external_joints },
    );
    (of(headers()), of(positions()), of(speeds), of(data())).prop_map(
        |(header, planned, speed_ref, rapid_to_robot)| EgmSensor {
            header,
            planned,
            speed_ref,
            rapid_to_robot,
        },
    )
}

proptest! {
    #[test]
    fn what_is_written_is_read(robot in robots(), sensor in sensors()) {
        prop_assert_eq!(EgmRobot::decode(&robot.encode()?)?, robot);
        prop_assert_eq!(EgmSensor::decode(&sensor.encode()?)?, sensor);
    }

    #[test]
    fn bytes_that_are_cut_off_are_refused_or_the_fields_before(robot in robots(), at in any::<Index>()) {
        let bytes = robot.encode()?;
        let end = at.index(bytes.len() + 1);
        match EgmRobot::decode(&bytes[..end]) {
            Ok(part) => prop_assert_eq!(part.encode()?, &bytes[..end]),
            Err(Error::InvalidMessage(fault)) => prop_assert!(fault.at <= end),
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in vec(any::<u8>(), 0..200)) {
        if let Ok(sensor) = EgmSensor::decode(&bytes) {
            prop_assert!(EgmSensor::decode(&sensor.encode()?).is_ok());
        }
    }
}
