//! What a program has by itself with std, for builds without it: the heap, and functions of numbers.

pub use alloc::borrow::ToOwned;
pub use alloc::boxed::Box;
pub use alloc::string::{String, ToString};
pub use alloc::vec::Vec;
#[cfg(not(feature = "std"))]
pub use nalgebra::{ComplexField as _, RealField as _};
