//! The conditions of a kinematic structure on the axes of an arm, and the ones that an arm does not
//! meet.

use core::f64::consts::FRAC_PI_2;
use core::fmt;

use alloc::format;
use alloc::string::String;

use thiserror::Error;

/// How two axes of a known structure lie to one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relation {
    /// At right angles.
    Perpendicular,
    Parallel,
    /// Meeting in a point.
    Meeting,
    /// In one plane, at right angles to the axis between them.
    Coplanar,
}

/// Values of `snap` that are proposed for an arm that needs one [rad]; the least that helps is
/// named.
pub const SNAPS: [f64; 6] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];

/// Name of the structure of a proposal that is no closed form.
pub const OFFSET_WRIST: &str = "offset wrist";

/// Most conditions that a structure has.
pub(crate) const MOST_CONDITIONS: usize = 10;

/// The conditions of a kinematic structure.
#[derive(Debug, PartialEq)]
pub(crate) struct Pattern {
    pub(crate) name: &'static str,
    /// The name in a sentence: "for {title}, axes ..".
    pub(crate) title: &'static str,
    /// Relation of two axes, from 1.
    pub(crate) conditions: &'static [(Relation, (usize, usize))],
}

/// Why an arm has none of the known structures: every condition of the nearest one that it does not
/// meet.
#[derive(Clone, Copy, Debug, Error)]
#[error("{reason}{hint}")]
pub struct UnknownStructure {
    reason: Reason,
    hint: Hint,
}

/// Compare reasons only: a hint depends on whether the arm was read from text or from its table.
impl PartialEq for UnknownStructure {
    fn eq(&self, other: &Self) -> bool {
        self.reason == other.reason
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Error)]
enum Reason {
    #[error("it has {0} joints, the known structures have 5, 6 or 7")]
    JointCount(usize),
    /// How far the arm is off each condition; zero where it is met.
    #[error("for {}{}", .pattern.title, Missed(.pattern, .off))]
    Off { pattern: &'static Pattern, off: [f64; MOST_CONDITIONS] },
    /// Six joints that move the flange in fewer independent ways.
    #[error(
        "{freedom}, so that the flange moves in {freedoms} independent ways, it must be 6: change \
         the table"
    )]
    Freedom { freedom: Freedom, freedoms: usize },
    /// A link that is too short [m].
    #[error(
        "for {}, {field} is {value} m, it must be at least {bound:e} m", .pattern.title
    )]
    TooShort { pattern: &'static Pattern, field: &'static str, value: f64, bound: f64 },
}

/// Why six joints do not move the flange in six independent ways. Axes count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub(crate) enum Freedom {
    #[error("every a and d is zero")]
    NoLengths,
    /// The first of two axes.
    #[error("axes {} and {} are one line", .0, .0 + 1)]
    OneLine(usize),
    /// The first of four axes.
    #[error("axes {} to {} are parallel", .0, .0 + 3)]
    FourParallel(usize),
    #[error("its joints are not independent")]
    Other,
}

/// How the arm would have a known structure: one proposal, so that an error stays small.
#[derive(Clone, Copy, Debug, Error)]
enum Hint {
    #[error("")]
    Nothing,
    /// `snap`: the place in [`SNAPS`]. `structure`: what it gives the arm. `moves`: how far that moves
    /// the tool at most [m].
    #[error(
        " (write the angles with all their digits, which moves the tool by up to {moves:.1e} m); \
         snap={:e} would take it{}",
        SNAPS[usize::from(*.snap)],
        if *.structure == OFFSET_WRIST { ", as an offset wrist" } else { "" }
    )]
    Snap { snap: u8, structure: &'static str, moves: f32 },
    /// The fields of a [`Reading`], which alone would be 8 bytes more.
    #[error("{}", Reading { order: *.order, other: *.other, structure })]
    Reading { order: u8, other: Option<Convention>, structure: &'static str },
}

/// A Denavit-Hartenberg convention.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum Convention {
    Modified,
    Standard,
}

/// Names of the four columns of a table, in their order.
pub(crate) type Columns = [&'static str; 4];

/// Orders of columns: first irbkin's, then the ones of textbooks and programs.
pub(crate) const ORDERS: [Columns; 8] = [
    ["alpha", "a", "d", "theta"],
    ["theta", "d", "a", "alpha"],
    ["d", "theta", "a", "alpha"],
    ["a", "alpha", "d", "theta"],
    ["a", "d", "alpha", "theta"],
    ["d", "a", "alpha", "theta"],
    ["theta", "d", "alpha", "a"],
    ["alpha", "a", "theta", "d"],
];

/// Another way to read a table, in which its structure is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reading {
    /// The order of its columns, an index into [`ORDERS`].
    pub(crate) order: u8,
    /// The convention, if it is not the one that was given.
    pub(crate) other: Option<Convention>,
    pub(crate) structure: &'static str,
}

impl UnknownStructure {
    /// Refuse an arm for its number of joints.
    pub(crate) fn joint_count(joints: usize) -> Self {
        Self::new(Reason::JointCount(joints))
    }

    /// Refuse an arm whose joints are not independent.
    pub(crate) fn freedom(freedom: Freedom, freedoms: usize) -> Self {
        Self::new(Reason::Freedom { freedom, freedoms })
    }

    /// Refuse an arm that is so far off each condition of a structure; zero where one is met.
    pub(crate) fn off(pattern: &'static Pattern, off: [f64; MOST_CONDITIONS]) -> Self {
        Self::new(Reason::Off { pattern, off })
    }

    /// Refuse an arm with a link shorter than `bound` [m].
    pub(crate) fn too_short(
        pattern: &'static Pattern,
        (field, value): (&'static str, f64),
        bound: f64,
    ) -> Self {
        Self::new(Reason::TooShort { pattern, field, value, bound })
    }

    fn new(reason: Reason) -> Self {
        Self { reason, hint: Hint::Nothing }
    }

    /// Propose one of [`SNAPS`], with the structure that it gives the arm, a closed form or an offset
    /// wrist, and how far it moves the tool at most [m].
    pub(crate) fn proposing(self, snap: Option<(u8, &'static str, f32)>) -> Self {
        let hint = |(snap, structure, moves)| Hint::Snap { snap, structure, moves };
        Self { hint: snap.map_or(Hint::Nothing, hint), ..self }
    }

    /// Propose another reading of the table.
    pub(crate) fn reading_as(self, reading: Option<Reading>) -> Self {
        let hint = |Reading { order, other, structure }| Hint::Reading { order, other, structure };
        Self { hint: reading.map_or(Hint::Nothing, hint), ..self }
    }

    /// The least power of ten [rad] that, given as `snap`, gives the arm a closed form.
    #[must_use]
    pub fn snap(&self) -> Option<f64> {
        match self.hint {
            Hint::Snap { snap, structure, .. } if structure != OFFSET_WRIST => {
                Some(SNAPS[usize::from(snap)])
            }
            _ => None,
        }
    }

    /// The structure that a `snap` gives the arm, in words.
    #[doc(hidden)]
    pub fn helpful_snap(&self) -> Option<String> {
        let Hint::Snap { snap, structure, moves } = self.hint else { return None };
        let moves = format!("moves the tool by up to {moves:.1e} m");
        Some(format!("snap={:e} gives {structure}, {moves}", SNAPS[usize::from(snap)]))
    }

    /// Whether a link is too short.
    pub(crate) fn is_length(&self) -> bool {
        matches!(self.reason, Reason::TooShort { .. })
    }

    /// Return this or the other one, whichever misses fewer conditions, or as many by less.
    pub(crate) fn nearer_of(self, other: Option<Self>) -> Self {
        let miss = |missed: &Self| match missed.reason {
            Reason::Off { off, .. } => {
                let off = off.into_iter().filter(|off| *off > 0.0);
                (off.clone().count(), off.sum())
            }
            _ => (0, 0.0),
        };
        match other {
            Some(other) if miss(&other) <= miss(&self) => other,
            _ => self,
        }
    }
}

/// The conditions that an arm does not meet, and how far it is off each.
struct Missed<'a>(&'static Pattern, &'a [f64; MOST_CONDITIONS]);

impl fmt::Display for Missed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut between = ",";
        for (&(relation, (i, j)), &off) in self.0.conditions.iter().zip(self.1) {
            if off > 0.0 {
                let wanted = match relation {
                    Relation::Perpendicular => "be at right angles",
                    Relation::Parallel => "be parallel",
                    Relation::Meeting => "meet",
                    Relation::Coplanar => "lie in one plane",
                };
                write!(f, "{between} axes {i} and {j} must {wanted}, they ")?;
                // As far off as can be is the other of both.
                let is_other = (off - FRAC_PI_2).abs() < 1e-6;
                match relation {
                    Relation::Perpendicular if is_other => f.write_str("are parallel"),
                    Relation::Parallel if is_other => f.write_str("are at right angles"),
                    Relation::Perpendicular | Relation::Parallel => {
                        write!(f, "are {} deg off", figure(off.to_degrees()))
                    }
                    Relation::Meeting | Relation::Coplanar => {
                        write!(f, "pass {} mm apart", figure(off * 1e3))
                    }
                }?;
                between = ";";
            }
        }
        Ok(())
    }
}

/// A size with six decimals, or with its exponent where they would all be zeros.
fn figure(size: f64) -> String {
    if size < 1e-6 { format!("{size:.2e}") } else { format!("{size:.6}") }
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { order, other, structure } = self;
        let reordered = *order > 0;
        let columns = |[a, b, c, d]: Columns| format!("{a}, {b}, {c}, {d}");
        let mut between = ";";
        if reordered {
            write!(f, "{between} with its columns as {}", columns(ORDERS[usize::from(*order)]))?;
            between = ",";
        }
        match other {
            Some(Convention::Standard) => write!(f, "{between} as a standard table")?,
            Some(Convention::Modified) => write!(f, "{between} as a modified table")?,
            None => {}
        }
        let article = if structure.ends_with('s') { "" } else { "a " };
        write!(f, " it has {article}{structure}:")?;
        let mut between = "";
        if reordered {
            write!(f, " reorder them to {}", columns(ORDERS[0]))?;
            between = " and";
        }
        match *other {
            Some(Convention::Standard) => write!(f, "{between} use from_sdh"),
            Some(Convention::Modified) => write!(f, "{between} use from_mdh"),
            None => Ok(()),
        }
    }
}
