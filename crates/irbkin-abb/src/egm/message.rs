//! The messages of EGM. Every field may be missing.

use super::fault::EgmFault;
use super::wire::{Field, Message, Reader, Value};
use crate::Error;
use crate::prelude::*;

/// Define messages by numbers, names and types of their fields.
macro_rules! messages {
    ($(
        $(#[doc = $doc:literal])*
        $Name:ident {
            $($(#[doc = $field_doc:literal])* $number:literal $field:ident: $Type:ty,)*
        }
    )*) => {$(
        $(#[doc = $doc])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $Name {
            $($(#[doc = $field_doc])* pub $field: $Type,)*
        }

        impl Message for $Name {
            fn put_fields(&self, out: &mut Vec<u8>) {
                $(Field::put(&self.$field, $number, out);)*
            }

            fn take_field(
                &mut self, number: u64, wire: u64, from: &mut Reader,
            ) -> Result<bool, EgmFault> {
                match number {
                    $($number => Field::take(&mut self.$field, wire, from, stringify!($field))?,)*
                    _ => return Ok(false),
                }
                Ok(true)
            }
        }
    )*};
}

/// Passes the messages to a macro: names, and numbers, names and types of their fields.
#[doc(hidden)]
#[macro_export]
macro_rules! egm_messages {
    ($then:ident) => {
        $then! {
            /// The head of every message.
            EgmHeader {
                /// Sequence number, 32 bits, after the largest again 0.
                1 seqno: Option<u32>,
                /// When it was sent [ms], by the sender's clock.
                2 tm: Option<u32>,
                /// 2 data of the controller, 3 correction by the sensor, 4 path correction.
                3 mtype: Option<i32>,
            }

            /// A pose of the tool in the work object.
            EgmPose {
                /// Position x, y, z [mm].
                1 pos: Option<[f64; 3]>,
                /// Quaternion w, x, y, z.
                2 orient: Option<[f64; 4]>,
                /// Euler angles x, y, z [deg], which go before the quaternion where there are both.
                3 euler: Option<[f64; 3]>,
            }

            /// A time of the precision time protocol.
            EgmTimestamp {
                /// Seconds.
                1 sec: Option<u64>,
                /// Nanoseconds.
                2 nsec: Option<u64>,
            }

            /// Where the robot is, or is to be.
            EgmPosition {
                /// Axes 1 to 6 [deg].
                1 joints: Option<Vec<f64>>,
                /// The tool.
                2 cartesian: Option<EgmPose>,
                /// External axes [deg or mm]; the first is axis 7 of seven.
                3 external_joints: Option<Vec<f64>>,
                /// Seconds and microseconds since 1970.
                4 time: Option<[u64; 2]>,
                /// Seconds and nanoseconds of another clock.
                5 time_stamp: Option<EgmTimestamp>,
            }

            /// Speeds that go with a position.
            EgmSpeed {
                /// Axes 1 to 6 [deg/s].
                1 joints: Option<Vec<f64>>,
                /// The tool: x, y, z [mm/s], and what follows.
                2 cartesians: Option<Vec<f64>>,
                /// External axes [deg/s or mm/s].
                3 external_joints: Option<Vec<f64>>,
            }

            /// A flag and numbers: of a measured force whether it is active, of a collision whether one was
            /// detected, of RAPID's data the digital value and up to 40 numbers.
            EgmData {
                /// The flag.
                1 flag: Option<bool>,
                /// The numbers.
                2 values: Vec<f64>,
            }

            /// A message of the controller.
            EgmRobot {
                /// Number, time and kind.
                1 header: Option<EgmHeader>,
                /// Where the robot is.
                2 feedback: Option<EgmPosition>,
                /// Where the controller wants it to be.
                3 planned: Option<EgmPosition>,
                /// Motors: 1 on, 2 off.
                4 motor_state: Option<EgmState>,
                /// EGM itself: 1 error, 2 stopped, 3 running.
                5 mci_state: Option<EgmState>,
                /// Whether the condition that ends the motion is met.
                6 mci_convergence_met: Option<bool>,
                /// Test signals.
                7 test_signals: Option<Vec<f64>>,
                /// The RAPID program: 1 stopped, 2 running.
                8 rapid_exec_state: Option<EgmState>,
                /// Measured force [N, Nm].
                9 measured_force: Option<EgmData>,
                /// How much of what the robot can do is used [%].
                10 utilization_rate: Option<f64>,
                /// Number of the move, in path correction.
                11 move_index: Option<u32>,
                /// Whether a collision was detected, and the level of each axis.
                12 collision_info: Option<EgmData>,
                /// Data that RAPID sends.
                13 rapid_from_robot: Option<EgmData>,
                /// Torque of each axis.
                14 torque_ref: Option<Vec<f64>>,
            }

            /// A message to the controller.
            EgmSensor {
                /// Number, time and kind.
                1 header: Option<EgmHeader>,
                /// Where the robot is to be.
                2 planned: Option<EgmPosition>,
                /// Speeds there.
                3 speed_ref: Option<EgmSpeed>,
                /// Data that RAPID receives.
                4 rapid_to_robot: Option<EgmData>,
            }
        }
    };
}
egm_messages!(messages);

/// A message of one required number, the state of something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EgmState(pub i32);

impl Value for EgmState {
    const WIRE: u64 = <[i32; 1]>::WIRE;

    fn put(&self, out: &mut Vec<u8>) {
        [self.0].put(out);
    }

    fn take(&mut self, from: &mut Reader, field: &'static str) -> Result<(), EgmFault> {
        let mut state = [0];
        state.take(from, field)?;
        [self.0] = state;
        Ok(())
    }
}

/// Define the ends of messages that are datagrams.
macro_rules! datagrams {
    ($($Name:ident)*) => {$(
        impl $Name {
            /// Read a datagram. Unknown fields are skipped.
            ///
            /// # Errors
            ///
            /// [`Error::InvalidMessage`]: the bytes are no such message.
            pub fn decode(bytes: &[u8]) -> Result<Self, Error> {
                let mut message = Self::default();
                let take = |number, wire, from: &mut _| message.take_field(number, wire, from);
                Reader::new(bytes)?.fields(take)?;
                Ok(message)
            }

            /// Write a datagram, its fields in the order of their numbers.
            ///
            /// # Errors
            ///
            /// [`Error::InvalidMessage`]: it has more bytes than a datagram.
            pub fn encode(&self) -> Result<Vec<u8>, Error> {
                let mut out = Vec::new();
                self.put_fields(&mut out);
                Reader::new(&out)?;
                Ok(out)
            }
        }
    )*};
}
datagrams! { EgmRobot EgmSensor }
