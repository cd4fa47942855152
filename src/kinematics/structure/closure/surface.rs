//! Self-motions on which two directions are free at every member, to first order at least: surfaces,
//! and curves at which two have merged.
//!
//! Docs: general.md, eq. 103b.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{SMatrix, SVector};

use super::chain::{Closure, Target};
use super::configuration::{Configuration, Kind};
use super::curve::SECOND;
use super::member::SWEEPS;
use crate::kinematics::pose::angles::wrap;

/// Singular value up to which a direction may be free at a member nearby [1]: as far away is it.
pub(super) const NEARLY_FREE: f64 = 1e-3;

/// Singular value below which rounding decides [1].
const LEAST: f64 = 1e-7;

/// How far ahead the chain must be free in two directions again [rad].
const AHEAD: f64 = 0.02;

/// Part of that by which it must have moved [1].
const MOVED: f64 = 0.5;

/// How far ahead the derivatives are compared [rad], and by how much they change along a surface at
/// most [1/rad].
const LITTLE: f64 = 1e-4;
const MOST_CHANGE: f64 = 0.01;

/// Angle by which a joint that moves does so there [rad].
const MOVES: f64 = 2e-4;

/// Step of a way [rad], and how many it has at most: along the surface, and to a member nearby.
const STEP: f64 = 0.3;
const MOST_STEPS: usize = 30;
const FEW_STEPS: usize = 5;

/// Part of the rest of the way that is along the surface at least [1].
const ALONG: f64 = 0.05;

/// How near a way must come to its goal [rad].
const AT_GOAL: f64 = 2e-6;

/// Correction, and rest of a way, that is the last [rad].
const CONVERGED: f64 = 1e-7;

/// A surface of configurations.
pub(super) struct Surface<'a> {
    closure: &'a Closure,
    target: &'a Target,
    /// How many directions are free, to first order.
    directions: usize,
}

/// A place next to a surface.
struct Place {
    /// The correction to the surface.
    correction: SVector<f64, 6>,
    /// The directions that are free, row by row; the others are zero.
    free: SMatrix<f64, 6, 6>,
    /// The conditions that are met in every direction, column by column; the others are zero.
    fixed: SMatrix<f64, 6, 6>,
    /// The largest singular value of those that are small on the surface [1].
    largest: f64,
}

impl Closure {
    /// The member of the surface through a configuration with a joint at an angle, if a way along
    /// the surface comes there.
    pub(crate) fn member_of_surface(
        &self,
        target: &Target,
        theta: &[f64; 6],
        joint: usize,
        angle: f64,
    ) -> Option<Configuration> {
        let surface = Surface::next_to(self, target, theta)?;
        surface.moving(theta)?;
        surface.at_angle(theta, joint, angle)
    }
}

impl<'a> Surface<'a> {
    /// What may be a surface next to a configuration: none where no two directions are nearly free.
    pub(super) fn next_to(
        closure: &'a Closure,
        target: &'a Target,
        theta: &[f64; 6],
    ) -> Option<Self> {
        let values = closure.derivatives(theta).singular_values();
        let directions = values.iter().filter(|value| **value <= NEARLY_FREE).count();
        (directions > 1).then_some(Self { closure, target, directions })
    }

    /// The configuration next to an approximate one: of a surface, or where solutions merge in two
    /// directions.
    pub(super) fn configuration(&self, theta: &[f64; 6]) -> Option<Configuration> {
        let theta = self.toward(theta, theta, FEW_STEPS)?;
        let kind = self.moving(&theta).map_or(Kind::FOLD, Kind::Surface);
        self.closure.accepted(self.target, theta, 0.0, kind)
    }

    /// The joints that move from a member on: none where the chain is less free a step ahead.
    fn moving(&self, theta: &[f64; 6]) -> Option<[bool; 6]> {
        let here = self.place(theta)?;
        if self.least_turn(theta, &here) > MOST_CHANGE {
            return None;
        }
        let (mut moving, mut moves) = ([false; 6], false);
        for row in here.free.row_iter().skip(6 - self.directions) {
            let goal = core::array::from_fn(|i| theta[i] + AHEAD * row[i]);
            let Some(ahead) = self.toward(theta, &goal, FEW_STEPS) else { continue };
            let apart = SVector::<f64, 6>::from_fn(|i, _| wrap(ahead[i] - theta[i]));
            // Of a curve, one direction is no way.
            if apart.norm() > MOVED * AHEAD {
                if self.place(&ahead)?.largest > SECOND {
                    return None;
                }
                moves = true;
                for joint in 0..6 {
                    moving[joint] |= apart[joint].abs() > MOVES;
                }
            }
        }
        moves.then_some(moving)
    }

    /// By how much the derivatives that are zero change along a free direction, at least: by
    /// nothing along a surface.
    fn least_turn(&self, theta: &[f64; 6], Place { fixed, free, .. }: &Place) -> f64 {
        let derivatives = |theta: &[f64; 6]| {
            fixed.transpose() * self.closure.derivatives(theta) * free.transpose()
        };
        let here = derivatives(theta);
        let first = 6 - self.directions;
        let turn = |row: usize| {
            let ahead = core::array::from_fn(|i| theta[i] + LITTLE * free[(row, i)]);
            (derivatives(&ahead) - here) / LITTLE
        };
        let turns: [_; 6] = core::array::from_fn(|row| if row < first { here } else { turn(row) });
        let products = SMatrix::<f64, 6, 6>::from_fn(|row, column| {
            if row.min(column) >= first {
                turns[row].dot(&turns[column])
            } else {
                f64::from(u8::from(row == column))
            }
        });
        products.singular_values().min().sqrt()
    }

    fn place(&self, theta: &[f64; 6]) -> Option<Place> {
        let (jacobian, missing) = self.closure.linear(self.target, theta);
        let svd = jacobian.try_svd(true, true, f64::EPSILON, SWEEPS)?;
        let (mut fixed, mut free) = (svd.u?, svd.v_t?);
        let first = 6 - self.directions;
        let (mut correction, mut flat) = (SVector::zeros(), SVector::zeros());
        for (row, value) in svd.singular_values.iter().enumerate().filter(|one| *one.1 > LEAST) {
            let part = free.row(row).transpose() * (fixed.column(row).dot(&missing) / value);
            if row < first {
                correction += part;
            } else {
                // Newton's method goes half of the way to a double root.
                flat += part * 2.0;
            }
        }
        correction += flat * (STEP / flat.norm().max(STEP));
        for row in 0..first {
            free.row_mut(row).fill(0.0);
            fixed.column_mut(row).fill(0.0);
        }
        Some(Place { correction, free, fixed, largest: svd.singular_values[first] })
    }

    /// The member that a way along the surface reaches which always heads for a goal: the goal
    /// itself, or one with no member next to it that is nearer.
    fn toward(&self, from: &[f64; 6], goal: &[f64; 6], steps: usize) -> Option<[f64; 6]> {
        self.led(from, steps, |theta, free| {
            let way = SVector::<f64, 6>::from_fn(|i, _| wrap(goal[i] - theta[i]));
            let along = free.transpose() * (free * way);
            if along.norm() > ALONG * way.norm() { along } else { SVector::zeros() }
        })
    }

    /// The member that a way along the surface reaches on which a joint always heads for an angle,
    /// if it comes there.
    fn at_angle(&self, from: &[f64; 6], joint: usize, angle: f64) -> Option<Configuration> {
        let off = |theta: &SVector<f64, 6>| wrap(angle - theta[joint]);
        let mut theta = self.led(from, MOST_STEPS, |theta, free| {
            let column = free.column(joint);
            let square = column.norm_squared();
            let turn = if square > ALONG * ALONG { off(theta) / square } else { 0.0 };
            free.transpose() * column * turn
        })?;
        let rest = off(&theta.into());
        theta[joint] += rest;
        let member = self.closure.accepted(self.target, theta, 0.0, Kind::FOLD)?;
        (rest.abs() < AT_GOAL).then_some(member)
    }

    /// The member to which a way along the surface leads from a configuration next to it.
    fn led(
        &self,
        from: &[f64; 6],
        steps: usize,
        along: impl Fn(&SVector<f64, 6>, &SMatrix<f64, 6, 6>) -> SVector<f64, 6>,
    ) -> Option<[f64; 6]> {
        let mut theta = SVector::from(*from);
        for _ in 0..steps {
            let Place { correction, free, .. } = self.place(&theta.into())?;
            let along = along(&theta, &free);
            theta += correction + along * (STEP / along.norm().max(STEP));
            if correction.amax().max(along.amax()) < CONVERGED {
                break;
            }
        }
        let theta = theta.into();
        self.closure.closes(self.target, &theta).then_some(theta)
    }

    /// Whether a way along the surface joins two configurations.
    pub(super) fn joins(&self, one: &Configuration, other: &Configuration) -> bool {
        let reaches = |from: &Configuration, to: &Configuration| {
            let end = self.toward(&from.theta, &to.theta, MOST_STEPS);
            end.is_some_and(|end| to.is_within(AT_GOAL, &end))
        };
        reaches(one, other) || reaches(other, one)
    }
}
