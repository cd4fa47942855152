//! Arms with bodies for [`irbkin`]: cells and collisions, paths and trajectories, plans, free
//! motions, guards of control loops, URDF.
//!
//! Whether a UR5e touches itself or the floor:
//!
//! ```
//! use irbkin_motion::Arm;
//! use irbkin_motion::body::Shape;
//! use irbkin_motion::cell::Cell;
//!
//! let arm: Arm<6> = Arm::named("UR5e")?;
//! let floor = Shape::half_space([0.0, 0.0, 1.0], [0.0; 3])?;
//! let cell = Cell::new(vec![("floor".into(), floor)], 0.01)?;
//! let mut checker = cell.checker(&arm)?;
//! assert!(!checker.collides(&[0.3, -1.2, 1.4, -0.5, 0.6, 0.7])?);
//! assert!(checker.collides(&[0.3, 0.6, 1.4, -0.5, 0.6, 0.7])?);
//! # Ok::<(), irbkin_motion::Error>(())
//! ```
//!
//! | feature | default | provides |
//! |---|---|---|
//! | `std` | yes | as of [`irbkin`] |
//! | `libm` | | as of [`irbkin`] |
//! | `urdf` | yes | `Arm::from_urdf`, `Arm::to_urdf` |
//! | `serde` | | `Serialize` and `Deserialize` of [`Arm`] and [`AnyArm`]; reading one runs every check of its constructors |
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg(hide(feature = "std", feature = "libm"))))]
#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::float_cmp)
)]
// If another crate of the build links std, its float methods shadow those imported for no_std.
#![cfg_attr(not(feature = "std"), allow(unused_imports))]

#[macro_use]
extern crate alloc;
#[cfg(test)]
extern crate std;

mod arm;
pub mod body;
pub mod cell;
mod error;
pub mod go;
pub mod paths;
pub mod plan;
mod prelude;
#[cfg(test)]
#[path = "../../../tests/common/rng.rs"]
#[allow(dead_code, unreachable_pub)]
mod rng;
#[cfg(test)]
#[path = "../../../tests/common/sets.rs"]
#[allow(unreachable_pub)]
mod sets;
mod spline;
pub mod stream;
pub mod trajectory;
#[cfg(feature = "urdf")]
mod urdf;

pub use arm::{AnyArm, Arm};
pub use error::Error;

/// What the crates above this one use of it besides its public names. No stable interface: their
/// versions are equal.
#[doc(hidden)]
pub mod internal {
    pub use crate::cell::{Memory, Motion};
    pub use crate::error::{MotionFault, check_most_near};
    pub use crate::go::fault::GoFault;
    pub use crate::paths::line::part;
    pub use crate::paths::polyline::{Corner, Leg, PREDEFINED, Rounded};
    pub use crate::paths::thresholds::{LEAST_WAY, MOST_SAMPLES, STEP_ROUNDING};
    pub use crate::plan::fault::PlanFault;
    pub use crate::plan::thresholds::MOST_TOOL_ANGLES;
    pub use crate::trajectory::check::check_positive;
    pub use crate::trajectory::thresholds::{LIMIT_ROUNDING, MOST_DURATION};
    pub use crate::trajectory::{evenly, within_times};
    #[cfg(feature = "urdf")]
    pub use crate::urdf::{Carrier, UrdfArm, fault::UrdfFault, read_document};

    pub mod prelude {
        pub use crate::prelude::*;
    }
}
