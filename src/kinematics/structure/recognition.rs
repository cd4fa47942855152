//! What a known form asks of the axes of an arm, and what keeps an arm from having it.

use core::f64::consts::{FRAC_PI_2, PI};
use core::fmt;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::kinematics::thresholds::{FORM_TOLERANCE, LEAST_LINK};

/// How two axes of a known form stand to one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// How far they are off: an angle [rad] or, for axes that should meet or lie in one plane, a distance [m].
    pub off: f64,
}

/// Most conditions that a form has.
const MOST_CONDITIONS: usize = 10;

/// A form of arm with a closed-form inverse.
#[derive(Debug, PartialEq)]
pub(crate) struct Form {
    /// What an arm of this form is said to have.
    pub(crate) name: &'static str,
    pub(crate) conditions: &'static [(Relation, (usize, usize))],
}

/// Every condition that keeps an arm from having a closed form here.
#[derive(Clone, Copy, Debug)]
pub struct NotRecognised {
    reason: Reason,
    snap: Option<f64>,
}

/// What an arm lacks is the same whether it was read from text, which could be snapped, or from the table of it.
impl PartialEq for NotRecognised {
    fn eq(&self, other: &Self) -> bool {
        self.reason == other.reason
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Reason {
    /// No form has this number of joints.
    JointCount(usize),
    /// How far each condition of the form is off; zero where it is met.
    Off { form: &'static Form, off: [f64; MOST_CONDITIONS] },
    /// A length that the form needs and the arm does not have [m].
    TooShort { form: &'static Form, field: &'static str, value: f64 },
}

impl NotRecognised {
    /// An arm whose number of joints alone rules a closed form out.
    pub(crate) fn joint_count(joints: usize) -> Self {
        Self::new(Reason::JointCount(joints))
    }

    fn new(reason: Reason) -> Self {
        Self { reason, snap: None }
    }

    /// The same, proposing a `snap` with which the arm would be taken, or none.
    pub(crate) fn proposing(self, snap: Option<f64>) -> Self {
        Self { snap, ..self }
    }

    /// The least power of ten [rad] that, given as `snap`, makes the arm one of a known form; none where none does.
    #[must_use]
    pub fn snap(&self) -> Option<f64> {
        self.snap
    }

    /// The conditions that are not met. None is off where the arm has a form but a link without length, or another number of joints.
    pub fn conditions(&self) -> impl Iterator<Item = Condition> {
        let (conditions, off) = match self.reason {
            Reason::Off { form, off } => (form.conditions, off),
            Reason::JointCount(_) | Reason::TooShort { .. } => (&[][..], [0.0; MOST_CONDITIONS]),
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

impl fmt::Display for NotRecognised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reason {
            Reason::JointCount(joints) => write!(f, "{joints} joints, the known forms have 6 or 7"),
            Reason::TooShort { form, field, value } => {
                write!(
                    f,
                    "for {}, {field} is {value} m, it must be at least {LEAST_LINK:e} m",
                    form.name
                )
            }
            Reason::Off { form, .. } => {
                write!(f, "for {}", form.name)?;
                self.conditions().enumerate().try_for_each(|(i, condition)| {
                    write!(f, "{} {condition}", if i == 0 { "," } else { ";" })
                })
            }
        }?;
        self.snap.map_or(Ok(()), |snap| write!(f, "; snap={snap:e} would take it"))
    }
}

impl Form {
    /// Checks that each of the lengths (name and meaning, value [m]) is one.
    pub(crate) fn check_lengths<const N: usize>(
        &'static self,
        lengths: [(&'static str, f64); N],
    ) -> Result<(), NotRecognised> {
        match lengths.into_iter().find(|(_, value)| *value < LEAST_LINK) {
            Some((field, value)) => {
                Err(NotRecognised::new(Reason::TooShort { form: self, field, value }))
            }
            None => Ok(()),
        }
    }

    /// The table with what is within [`FORM_TOLERANCE`] of the form made exactly so: row `i + 1` holds the angle and the distance between
    /// axes `i` and `i + 1`.
    pub(crate) fn square_up<const N: usize>(
        &'static self,
        mdh: &Mdh<N>,
    ) -> Result<Mdh<N>, NotRecognised> {
        let mut squared = mdh.clone();
        let mut failed = [0.0; MOST_CONDITIONS];
        for ((relation, axes), failed) in self.conditions.iter().zip(&mut failed) {
            let row = &mut squared.rows[axes.0];
            let alpha = row.alpha;
            let (value, exact) = match relation {
                Relation::Parallel => (&mut row.alpha, nearest_of(alpha, 0.0)),
                Relation::Perpendicular => (&mut row.alpha, nearest_of(alpha, FRAC_PI_2)),
                // Between its neighbours' feet on it, the middle axis runs for d of its own row, which is the row before that of the last.
                Relation::Meeting | Relation::Coplanar if axes.1 == axes.0 + 2 => (&mut row.d, 0.0),
                Relation::Meeting | Relation::Coplanar => (&mut row.a, 0.0),
            };
            let off = (*value - exact).abs();
            if off > FORM_TOLERANCE {
                *failed = off;
            } else {
                *value = exact;
            }
        }
        let met = failed.iter().all(|off| *off <= FORM_TOLERANCE);
        if met {
            Ok(squared)
        } else {
            Err(NotRecognised::new(Reason::Off { form: self, off: failed }))
        }
    }
}

/// The angle nearest to `alpha` that is `base` and half turns.
pub(crate) fn nearest_of(alpha: f64, base: f64) -> f64 {
    base + PI * ((alpha - base) / PI).round()
}

pub(crate) fn sign_of(value: f64) -> f64 {
    if value < 0.0 { -1.0 } else { 1.0 }
}

/// The angle of a unit vector from `zero` towards `quarter`.
pub(crate) fn angle(direction: &Vector3<f64>, zero: &Vector3<f64>, quarter: &Vector3<f64>) -> f64 {
    direction.dot(quarter).atan2(direction.dot(zero))
}

pub(crate) fn axes(x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[*x, *y, *z])
}

pub(crate) fn rotation_pose(rotation: Matrix3<f64>) -> Pose {
    IsometryMatrix3::from_parts(
        Translation3::identity(),
        Rotation3::from_matrix_unchecked(rotation),
    )
}

/// A frame as its axes and its origin.
pub(crate) struct Frame {
    pub(crate) x: Vector3<f64>,
    pub(crate) y: Vector3<f64>,
    pub(crate) z: Vector3<f64>,
    pub(crate) origin: Vector3<f64>,
}

impl Frame {
    pub(crate) fn of(pose: &Pose) -> Self {
        let axes = pose.rotation.matrix();
        Self {
            x: axes.column(0).into(),
            y: axes.column(1).into(),
            z: axes.column(2).into(),
            origin: pose.translation.vector,
        }
    }
}
