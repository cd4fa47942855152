//! Codes and messages of calls that fail, and the guard around each call.

use core::cell::RefCell;
use core::ffi::c_char;
use core::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use irbkin::Error as RobotError;
use irbkin_motion::Error;

/// The outcome of a call. irbkin_last_error() has the sentence.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IrbkinCode {
    /// The call succeeded.
    Ok = 0,
    /// An argument is NULL, misaligned, of another length, no UTF-8, or none of its values.
    InvalidArgument = 1,
    /// A pose is not a rigid transform.
    InvalidPose = 2,
    /// Joint angles are not finite, or do not fit the arm.
    InvalidJoints = 3,
    /// The arm cannot be built, or cannot do what was asked.
    InvalidModel = 4,
    /// An option of a plan is invalid.
    InvalidPlan = 5,
    /// A box, a margin or a body is invalid, or the arm has no body.
    InvalidBody = 6,
    /// The catalog has no arm of that name.
    UnknownRobot = 7,
    /// No solution is inside the limits.
    Unreachable = 8,
    /// No solution has that configuration.
    NoConfiguration = 9,
    /// The joints cannot follow the path without a break. What they can follow is written.
    BrokenPath = 10,
    /// An error inside irbkin. Outputs are undetermined.
    Panic = 11,
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum Fault {
    #[error("{argument} is NULL")]
    Null { argument: &'static str },
    #[error("{argument} is misaligned: its address must be a multiple of {wanted}")]
    Misaligned { argument: &'static str, wanted: usize },
    #[error("{argument} has {found} elements, it must have {wanted}")]
    Length { argument: &'static str, found: usize, wanted: usize },
    #[error("{argument} has {found} elements, it must have at most {most}")]
    TooLong { argument: &'static str, found: usize, most: usize },
    #[error("{argument} overlaps {other}: they must be apart")]
    Overlap { argument: &'static str, other: &'static str },
    #[error("{argument} is not UTF-8 from byte {at} on")]
    Text { argument: &'static str, at: usize },
    #[error("{argument} is {value}, it must be {wanted}")]
    Choice { argument: &'static str, value: i64, wanted: &'static str },
    #[error("{argument} is not a living handle: it was freed, or is of another type")]
    NoHandle { argument: &'static str },
    #[error(
        "{argument}[{index}] is {value:e} rad, it must be finite and its size at most {bound:e} rad"
    )]
    Angle { argument: &'static str, index: usize, value: f64, bound: f64 },
    #[error("{argument}: {error}")]
    Of { argument: &'static str, error: Box<Error> },
    #[error("{argument}[{index}]: {error}")]
    Item { argument: &'static str, index: usize, error: Box<Error> },
    #[error(transparent)]
    Other(Box<Error>),
    #[error("{0}")]
    Broken(String),
}

impl<E: Into<Error>> From<E> for Fault {
    fn from(error: E) -> Self {
        Self::Other(Box::new(error.into()))
    }
}

impl Fault {
    /// The fault of what an argument holds.
    pub(crate) fn of<E: Into<Error>>(argument: &'static str) -> impl Fn(E) -> Self {
        move |error| Self::Of { argument, error: Box::new(error.into()) }
    }

    /// The fault of one element of an argument.
    pub(crate) fn item<E: Into<Error>>(argument: &'static str, index: usize) -> impl Fn(E) -> Self {
        move |error| Self::Item { argument, index, error: Box::new(error.into()) }
    }

    fn code(&self) -> IrbkinCode {
        match self {
            Self::Angle { .. } => IrbkinCode::InvalidJoints,
            Self::Broken(_) => IrbkinCode::BrokenPath,
            Self::Of { error, .. } | Self::Item { error, .. } | Self::Other(error) => {
                code_of(error)
            }
            _ => IrbkinCode::InvalidArgument,
        }
    }
}

fn code_of(error: &Error) -> IrbkinCode {
    match error {
        Error::Robot(RobotError::InvalidPose(_)) => IrbkinCode::InvalidPose,
        Error::Robot(RobotError::InvalidJoints(_)) => IrbkinCode::InvalidJoints,
        Error::Robot(RobotError::InvalidModel(_)) | Error::InvalidUrdf(_) => {
            IrbkinCode::InvalidModel
        }
        Error::Robot(RobotError::UnknownRobot(_)) => IrbkinCode::UnknownRobot,
        Error::Robot(RobotError::Unreachable(_)) => IrbkinCode::Unreachable,
        Error::Robot(RobotError::NoConfiguration(_)) => IrbkinCode::NoConfiguration,
        Error::InvalidPlan(_) | Error::InvalidMotion(_) => IrbkinCode::InvalidPlan,
        Error::InvalidBody(_) => IrbkinCode::InvalidBody,
        _ => IrbkinCode::InvalidArgument,
    }
}

/// Longest message [bytes], with its final zero: longer ones are cut off.
const MOST_MESSAGE: usize = 2048;

thread_local! {
    /// The message of the last call of this thread that failed: a call that fails needs no heap.
    static LAST: RefCell<Message> = const { RefCell::new(Message::EMPTY) };
}

/// A text in a buffer of its own, that ends with a zero.
struct Message {
    bytes: [u8; MOST_MESSAGE],
    len: usize,
}

impl Message {
    const EMPTY: Self = Self { bytes: [0; MOST_MESSAGE], len: 0 };
}

impl fmt::Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = MOST_MESSAGE - 1 - self.len;
        let end = (0..=room.min(text.len())).rev().find(|end| text.is_char_boundary(*end));
        let text = text.get(..end.unwrap_or_default()).unwrap_or_default();
        let free = self.bytes.iter_mut().skip(self.len);
        free.zip(text.bytes().chain([0])).for_each(|(to, from)| *to = from);
        self.len += text.len();
        Ok(())
    }
}

/// Keep the message of a call that fails.
fn keep(words: impl fmt::Display) {
    LAST.with_borrow_mut(|last| {
        last.len = 0;
        // Writing into the buffer cannot fail.
        let _ = fmt::Write::write_fmt(last, format_args!("{words}"));
    });
}

/// Keep the message of a fault; its code.
pub(crate) fn report(fault: &Fault) -> IrbkinCode {
    keep(fault);
    fault.code()
}

/// The address of the last message of this thread.
pub(crate) fn last() -> *const c_char {
    LAST.with(|last| {
        let last = last.as_ptr();
        // SAFETY: it is the address of a living value of this thread.
        unsafe { &raw const (*last).bytes }.cast()
    })
}

/// Make a call: its faults become codes and messages, and so does a panic.
pub(crate) fn guarded(call: impl FnOnce() -> Result<(), Fault>) -> IrbkinCode {
    let call = || match call() {
        Ok(()) => IrbkinCode::Ok,
        Err(fault) => report(&fault),
    };
    // After a panic nothing of the call is left but its outputs, which are plain numbers.
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let words = panic.downcast_ref::<&str>().copied();
        let words = words.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        keep(format_args!(
            "an error inside irbkin, please report it: {}",
            words.unwrap_or("panic")
        ));
        IrbkinCode::Panic
    })
}
