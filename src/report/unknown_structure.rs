//! What a kinematic structure asks of the axes of an arm, and what keeps an arm from having it.

use core::fmt;

/// How two axes of a known structure stand to one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Relation {
    /// At right angles.
    Perpendicular,
    /// Parallel.
    Parallel,
    /// Meeting in a point.
    Meeting,
    /// In one plane, at right angles to the axis between them.
    Coplanar,
}

/// A condition that an arm does not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// How the axes should stand.
    pub relation: Relation,
    /// The axes, from 1.
    pub axes: (usize, usize),
    /// How far they are off: an angle [rad] or, for axes that should meet or lie in one plane, a
    /// distance [m].
    pub off: f64,
}

/// Most conditions that a structure has.
pub(crate) const MOST_CONDITIONS: usize = 10;

/// What a kinematic structure asks of the axes of an arm.
#[derive(Debug, PartialEq)]
pub(crate) struct Pattern {
    /// Name of the structure.
    pub(crate) name: &'static str,
    /// What an arm of this structure has, in words.
    pub(crate) title: &'static str,
    /// Relation of two axes, from 1.
    pub(crate) conditions: &'static [(Relation, (usize, usize))],
}

/// Why an arm has none of the known structures: every condition that the nearest of them asks for
/// and the arm does not meet.
#[derive(Clone, Copy, Debug)]
pub struct UnknownStructure {
    reason: Reason,
    hint: Hint,
}

/// What would give the arm a known structure. One of them at most, for an error is small.
#[derive(Clone, Copy, Debug)]
enum Hint {
    Nothing,
    /// A `snap` [rad].
    Snap(f64),
    Reading(Reading),
}

/// Which Denavit-Hartenberg convention a table has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Convention {
    Modified,
    Standard,
}

/// Names of the four columns of a table, in their order.
pub(crate) type Columns = [&'static str; 4];

/// Another way to read a table, in which its structure is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reading {
    /// The order of its columns, an index into [`ORDERS`].
    pub(crate) order: u8,
    /// The convention, where it is not the one that was given.
    pub(crate) other: Option<Convention>,
    /// Name of the structure.
    pub(crate) structure: &'static str,
}

/// Orders of columns: first the one that tables are given in, then those of textbooks and programs.
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

/// What an arm lacks is the same whether it was read from text, which could be snapped, or from the
/// table of it.
impl PartialEq for UnknownStructure {
    fn eq(&self, other: &Self) -> bool {
        self.reason == other.reason
    }
}

/// Why six joints do not move the flange in six independent ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Freedom {
    /// Every link has length zero.
    NoLengths,
    /// This axis, from 1, and the next are one line.
    OneLine(usize),
    /// This axis, from 1, and the next three are parallel.
    FourParallel(usize),
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Reason {
    /// No structure has this number of joints.
    JointCount(usize),
    /// How far each condition of the structure is off; zero where it is met.
    Off { pattern: &'static Pattern, off: [f64; MOST_CONDITIONS] },
    /// Six joints that do not move the flange in six independent ways, but in so many.
    Freedom { freedom: Freedom, freedoms: usize },
    /// A length that the structure needs and the arm does not have [m].
    TooShort { pattern: &'static Pattern, field: &'static str, value: f64, bound: f64 },
}

impl UnknownStructure {
    /// An arm whose number of joints alone rules a structure out.
    pub(crate) fn joint_count(joints: usize) -> Self {
        Self::new(Reason::JointCount(joints))
    }

    /// An arm whose joints are not independent.
    pub(crate) fn freedom(freedom: Freedom, freedoms: usize) -> Self {
        Self::new(Reason::Freedom { freedom, freedoms })
    }

    fn new(reason: Reason) -> Self {
        Self { reason, hint: Hint::Nothing }
    }

    /// The same, proposing a `snap` with which the arm would be taken, or none.
    pub(crate) fn proposing(self, snap: Option<f64>) -> Self {
        Self { hint: snap.map_or(Hint::Nothing, Hint::Snap), ..self }
    }

    /// The same, with another reading of the table, or none.
    pub(crate) fn reading_as(self, reading: Option<Reading>) -> Self {
        Self { hint: reading.map_or(Hint::Nothing, Hint::Reading), ..self }
    }

    /// The least power of ten [rad] that, given as `snap`, gives the arm a known structure; none
    /// where none does.
    #[must_use]
    pub fn snap(&self) -> Option<f64> {
        match self.hint {
            Hint::Snap(snap) => Some(snap),
            Hint::Nothing | Hint::Reading(_) => None,
        }
    }

    /// An arm that is off these conditions of a structure by so much; zero where one is met.
    pub(crate) fn off(pattern: &'static Pattern, off: [f64; MOST_CONDITIONS]) -> Self {
        Self::new(Reason::Off { pattern, off })
    }

    /// An arm with a link shorter than `bound` [m].
    pub(crate) fn too_short(
        pattern: &'static Pattern,
        (field, value): (&'static str, f64),
        bound: f64,
    ) -> Self {
        Self::new(Reason::TooShort { pattern, field, value, bound })
    }

    /// Whether a link is too short.
    pub(crate) fn is_length(&self) -> bool {
        matches!(self.reason, Reason::TooShort { .. })
    }

    /// This, or another that was missed by less: by fewer conditions, then by less of them.
    pub(crate) fn nearer_of(self, other: Option<Self>) -> Self {
        let miss = |reason: &Self| {
            (
                reason.conditions().count(),
                reason.conditions().map(|condition| condition.off).sum::<f64>(),
            )
        };
        match other {
            Some(other) if miss(&other) <= miss(&self) => other,
            _ => self,
        }
    }

    /// The conditions that are not met. None is off where the arm has a structure but a link
    /// without length, or another number of joints.
    pub fn conditions(&self) -> impl Iterator<Item = Condition> {
        let (conditions, off) = match self.reason {
            Reason::Off { pattern, off } => (pattern.conditions, off),
            Reason::JointCount(_) | Reason::Freedom { .. } | Reason::TooShort { .. } => {
                (&[][..], [0.0; MOST_CONDITIONS])
            }
        };
        let off = conditions.iter().zip(off).filter(|(_, off)| *off > 0.0);
        off.map(|((relation, axes), off)| Condition { relation: *relation, axes: *axes, off })
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { relation, axes: (i, j), off } = *self;
        match relation {
            Relation::Perpendicular => write!(
                f,
                "axes {i} and {j} must be at right angles, they are {} deg off",
                Figure(off.to_degrees())
            ),
            Relation::Parallel => write!(
                f,
                "axes {i} and {j} must be parallel, they are {} deg off",
                Figure(off.to_degrees())
            ),
            Relation::Meeting => {
                write!(f, "axes {i} and {j} must meet, they pass {} mm apart", Figure(off * 1e3))
            }
            Relation::Coplanar => write!(
                f,
                "axes {i} and {j} must lie in one plane, they pass {} mm apart",
                Figure(off * 1e3)
            ),
        }
    }
}

/// A size with six decimals, or with its exponent where they would all be zeros.
struct Figure(f64);

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(size) = *self;
        if size < 1e-6 { write!(f, "{size:.2e}") } else { write!(f, "{size:.6}") }
    }
}

impl fmt::Display for UnknownStructure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reason {
            Reason::JointCount(joints) => {
                write!(f, "it has {joints} joints, the known structures have 6 or 7")
            }
            Reason::Freedom { freedom, freedoms } => {
                match freedom {
                    Freedom::NoLengths => write!(f, "every a and d is zero"),
                    Freedom::OneLine(i) => write!(f, "axes {i} and {} are one line", i + 1),
                    Freedom::FourParallel(i) => write!(f, "axes {i} to {} are parallel", i + 3),
                    Freedom::Other => write!(f, "its joints are not independent"),
                }?;
                write!(
                    f,
                    ", so that the flange moves in {freedoms} independent ways, it must be 6: \
                     change the table"
                )
            }
            Reason::TooShort { pattern, field, value, bound } => {
                write!(
                    f,
                    "for {}, {field} is {value} m, it must be at least {bound:e} m",
                    pattern.title
                )
            }
            Reason::Off { pattern, .. } => {
                write!(f, "for {}", pattern.title)?;
                self.conditions().enumerate().try_for_each(|(i, condition)| {
                    write!(f, "{} {condition}", if i == 0 { "," } else { ";" })
                })
            }
        }?;
        match self.hint {
            Hint::Nothing => Ok(()),
            Hint::Snap(snap) => {
                write!(f, " (write the angles with all their digits); snap={snap:e} would take it")
            }
            Hint::Reading(reading) => reading.fmt(f),
        }
    }
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { order, other, structure } = self;
        let reordered = *order > 0;
        let list =
            |f: &mut fmt::Formatter<'_>, [a, b, c, d]: Columns| write!(f, "{a}, {b}, {c}, {d}");
        let mut between = ";";
        if reordered {
            write!(f, "{between} with its columns as ")?;
            list(f, ORDERS[usize::from(*order)])?;
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
            write!(f, " reorder them to ")?;
            list(f, ORDERS[0])?;
            between = " and";
        }
        match *other {
            Some(Convention::Standard) => write!(f, "{between} use from_sdh"),
            Some(Convention::Modified) => write!(f, "{between} use from_mdh"),
            None => Ok(()),
        }
    }
}
