//! Where a hard set places an arm, and the verdict on the answer there.

use std::{format, vec};

use irbkin::{Pose, Robot};

use crate::rng::Rng;

/// A singularity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    Wrist,
    Shoulder,
    /// Stretched or folded.
    Elbow,
    Stretched,
    Folded,
    /// The shoulder of a seven-axis arm on axis 5.
    Forearm,
    /// The shoulder of a seven-axis arm on axis 6.
    Hand,
}

/// The singularities that a posture is near, and the distances [rad, m].
#[derive(Clone, Debug, Default)]
pub struct Place(pub Vec<(At, f64)>);

impl Place {
    pub fn of(at: At, off: f64) -> Self {
        Self(vec![(at, off)])
    }

    pub fn off(&self, at: At) -> Option<f64> {
        self.0.iter().find(|(other, _)| *other == at).map(|(_, off)| *off)
    }

    pub fn wrist(&self) -> Option<f64> {
        self.off(At::Wrist)
    }

    pub fn shoulder(&self) -> Option<f64> {
        self.off(At::Shoulder)
    }

    pub fn elbow(&self) -> Option<f64> {
        self.off(At::Elbow)
    }

    pub fn without(&self, at: At) -> Self {
        Self(self.0.iter().copied().filter(|(other, _)| *other != at).collect())
    }

    pub fn name(&self) -> String {
        let parts: Vec<_> = self.0.iter().map(|(at, off)| format!("{at:?} {off:e}")).collect();
        parts.join(", ")
    }
}

/// A pose with the joint vector that made it.
#[derive(Clone, Debug)]
pub struct Made<const N: usize> {
    pub place: Place,
    pub theta: [f64; N],
    pub q: [f64; N],
    pub pose: Pose,
    /// How far the pose is out of reach [m].
    pub beyond: f64,
}

impl<const N: usize> Made<N> {
    pub fn new(robot: &Robot<N>, place: &Place, theta: [f64; N], q: [f64; N]) -> Self {
        Self { place: place.clone(), theta, q, pose: robot.fk(&q), beyond: 0.0 }
    }
}

/// Draws angles of the derivation; `None` if a draw is not usable.
pub type Draw<const N: usize> = Box<dyn Fn(&mut Rng) -> Option<[f64; N]>>;

/// A singular posture with a name of its own.
pub struct Posture<const N: usize> {
    pub name: &'static str,
    /// The singularities that it is at.
    pub place: Place,
    /// Draws its angles of the derivation.
    pub draw: Draw<N>,
}

/// The verdict on an answer.
#[derive(Debug, Default)]
pub struct Verdict {
    /// Whether the joint vector that made the pose is among the solutions.
    pub found: bool,
    /// Incorrect solutions.
    pub incorrect: usize,
    /// Pairs of duplicate solutions.
    pub duplicates: usize,
    /// Whether every singularity that the pose is at is flagged.
    pub flagged: bool,
}
