//! Messages of ABB's Externally Guided Motion (EGM): UDP datagrams of protobuf's proto2.
//!
//! ```
//! use irbkin_abb::egm::{EgmHeader, EgmPosition, EgmSensor};
//!
//! let header = EgmHeader { seqno: Some(1), tm: Some(4), mtype: Some(3) };
//! let planned = EgmPosition { joints: Some(vec![0.0; 6]), ..Default::default() };
//! let sent = EgmSensor { header: Some(header), planned: Some(planned), ..Default::default() };
//! let bytes = sent.encode()?;
//! assert_eq!(EgmSensor::decode(&bytes)?, sent);
//! # Ok::<(), irbkin_abb::Error>(())
//! ```
//!
//! Field numbers are from the public egm.proto of RobotWare 7, of which RobotWare 6 has the first
//! part. A message that only wraps one list, one vector or one number is a field here.

pub(crate) mod fault;
mod message;
mod wire;

pub use message::{
    EgmData, EgmHeader, EgmPose, EgmPosition, EgmRobot, EgmSensor, EgmSpeed, EgmState, EgmTimestamp,
};
