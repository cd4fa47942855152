//! Bytes that are no EGM message.

use thiserror::Error;

/// Why bytes are not a message, and where.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("byte {at}: {field} {kind}")]
pub struct EgmFault {
    /// Index of the byte, from 0.
    pub at: usize,
    /// The innermost field that is read, or "message".
    pub field: &'static str,
    /// The reason.
    pub kind: EgmFaultKind,
}

/// The faults of a field. Wire types are protobuf's: 0 varint, 1 eight bytes, 2 a length and its
/// bytes, 5 four bytes.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EgmFaultKind {
    #[error("ends in the middle, {missing} bytes are missing at least (was the datagram cut off?)")]
    Truncated { missing: usize },
    #[error("has a varint of more than {most} bytes")]
    Varint { most: usize },
    #[error("is {value}, it must be at most {most}")]
    TooLarge { value: u64, most: u64 },
    #[error("has the field number {found}, it must be 1 to {most}")]
    Number { found: u64, most: u64 },
    #[error("has wire type {found}, it must be {wanted} (is it a message of another kind?)")]
    WireType { found: u64, wanted: &'static str },
    #[error("lacks its required element {number} of {count}")]
    Missing { number: usize, count: usize },
    #[error("has {found} bytes, a datagram has {most} at most")]
    TooLong { found: usize, most: usize },
}
