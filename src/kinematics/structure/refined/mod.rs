//! A calibrated arm by way of its nominal one: every branch of the nominal arm, brought onto the
//! pose by Newton's method (docs/theory/calibrate.md, section 5).
//!
//! It finds the branches of the nominal arm. A pair of branches that the calibrated arm
//! has and the nominal one has not is not seen: that happens next to folds.

use alloc::sync::Arc;

use super::closure::{Accepted, Candidates, Closure};
use super::end_frames::EndFrames;
use super::end_frames::Frame;
use super::free_choice::{FreeChoice, SeedPolicy};
use super::inverse::Inverse;
use super::joint_map::JointMap;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::{MOST_SLOTS, Slot};
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::{SingularityKind, Status};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::chain::skew::{TiltedRow, tilted_rows};
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::lanes::LANES;

/// Largest difference of two solutions that are the same [rad].
const SAME: f64 = 1e-6;

/// Least singular value below which two branches may have met [1].
const MET: f64 = 1e-3;

/// A calibrated arm with the structure that it nominally has.
#[derive(Clone, Debug)]
pub(crate) struct Refined {
    nominal: Arc<dyn Inverse<6>>,
    /// The nominal arm between the base and the tool of the calibrated one.
    nominal_chain: Chain<6>,
    closure: Closure,
    end_frames: EndFrames,
    joint_map: JointMap<6>,
}

impl Refined {
    /// The calibrated arm `chain` by way of its nominal one.
    pub(crate) fn new(
        nominal: &dyn Inverse<6>,
        nominal_chain: Chain<6>,
        chain: &Chain<6>,
        limits: &JointLimits<6>,
    ) -> Self {
        let nominal_chain = nominal_chain
            .with_base(*chain.base())
            .with_tool(*chain.tool())
            .with_coupling(chain.coupling());
        let mdh = chain.mdh();
        let tilted = tilted_rows(&mdh.rows);
        let joint_map = JointMap {
            signs: [1.0; 6],
            offsets: tilted.map(|TiltedRow { row, .. }| -row.theta),
            coupling: chain.coupling(),
            t_base_shoulder: mdh.base,
            t_wrist_flange: mdh.flange,
        };
        let ends = [chain.base(), &mdh.base, &mdh.flange, chain.tool()];
        let ends = ends.iter().map(|pose| pose.translation.vector.norm()).sum();
        Self {
            nominal: nominal.between(&nominal_chain, limits),
            nominal_chain,
            closure: Closure::of(&tilted).between(ends),
            end_frames: EndFrames::new(&joint_map, chain),
            joint_map,
        }
    }

    /// Bring the solutions of the nominal arm onto the pose.
    fn refine(&self, solutions: &mut Solutions<6>) -> Outcome {
        // A pair of branches that the nominal arm has not is not seen.
        solutions.is_certified = false;
        let mut outcome = Outcome { is_whole: true, lost: [None; MOST_SLOTS] };
        let (pose, limits) = (solutions.pose, solutions.limits);
        let mut are_near = false;
        for (part, places) in solutions.places_mut().chunks_mut(LANES).enumerate() {
            let q = core::array::from_fn(|lane| places.get(lane)?.found().map(|found| found.q));
            let Some(Candidates { theta, residual, least }) = self.refined_of(&pose, &q) else {
                continue;
            };
            for (lane, place) in places.iter_mut().enumerate() {
                let Place::Found(solution) = place else { continue };
                are_near |= least[lane] < MET;
                let theta = theta.map(|column| column[lane]);
                if residual[lane] <= self.closure.accepts() {
                    *place = self.place(theta, solution.slot, &limits);
                } else {
                    outcome.is_whole = false;
                    outcome.lost[LANES * part + lane] = Some(theta);
                    *place = Place::Merged(Status::MERGED);
                }
            }
        }
        if are_near {
            outcome.is_whole &= !merge(solutions.places_mut());
        }
        outcome
    }

    /// Bring up to eight joint vectors onto a pose; `None` if there are no joint vectors.
    fn refined_of(&self, pose: &Pose, q: &[Option<[f64; 6]>; LANES]) -> Option<Candidates> {
        // Empty lanes follow another one: they must not take more steps.
        let any = q.iter().flatten().next()?;
        let theta = q.map(|q| self.joint_map.theta(q.as_ref().unwrap_or(any)));
        let theta = core::array::from_fn(|joint| theta.map(|theta| theta[joint]));
        let target = self.closure.target(self.end_frames.seen.of::<false>(&Frame::of(pose)));
        Some(self.closure.converged(&target, &theta))
    }

    /// A solution of the calibrated arm, inside the limits if it can be.
    fn place(&self, theta: [f64; 6], slot: Slot, limits: &JointLimits<6>) -> Place<6> {
        let q = limits.wrap(self.joint_map.joints(theta));
        let mut status = Status::FOUND;
        status.set(Status::WITHIN_LIMITS, limits.contains(&q));
        Place::Found(Solution { q, slot, status, free_joint: None })
    }

    /// Look for the solutions that branches next to a fold have lost, where Newton's method ended,
    /// and for the one that continues from a seed.
    #[cold]
    fn recover(&self, solutions: &mut Solutions<6>, outcome: &Outcome, free: &FreeChoice<6>) {
        let (pose, limits) = (solutions.pose, solutions.limits);
        let target = self.closure.target_of(&self.end_frames.wrist_pose(&pose));
        let places = solutions.places_mut();
        for slot in 0..places.len() {
            let Some(theta) = &outcome.lost[slot] else { continue };
            let candidates = self.closure.converged(&target, &theta.map(|theta| [theta; LANES]));
            let mut found = Accepted::new();
            found.take(&self.closure, &target, &candidates, 1);
            for found in found.as_slice() {
                let place = self.place(found.theta, Slot::new(slot), &limits);
                if places[slot].found().is_none() && !is_known(places, &place) {
                    places[slot] = place;
                }
            }
        }
        if !matches!(free.policy, SeedPolicy::Seed | SeedPolicy::Path) {
            return;
        }
        let mut seeds = [None; LANES];
        seeds[0] = Some(free.q);
        let Some(Candidates { theta, residual, .. }) = self.refined_of(&pose, &seeds) else {
            return;
        };
        let empty = places.iter().position(|place| matches!(place, Place::Merged(_)));
        if let Some(slot) = empty.filter(|_| residual[0] <= self.closure.accepts()) {
            let theta = theta.map(|column| column[0]);
            let place = self.place(theta, Slot::new(slot), &limits);
            if !is_known(places, &place) {
                places[slot] = place;
            }
        }
    }
}

/// The outcome of refining the branches of the nominal arm.
struct Outcome {
    /// Whether each led to a solution of its own.
    is_whole: bool,
    /// Where Newton's method ended of those that did not close.
    lost: [Option<[f64; 6]>; MOST_SLOTS],
}

/// Merge solutions that have become the same; returns whether there are any.
#[cold]
fn merge(places: &mut [Place<6>]) -> bool {
    let mut has_merged = false;
    for slot in 1..places.len() {
        let (before, place) = places.split_at_mut(slot);
        if is_known(before, &place[0]) {
            (place[0], has_merged) = (Place::Merged(Status::MERGED), true);
        }
    }
    has_merged
}

/// Whether a solution is among others, turns not counted.
fn is_known(places: &[Place<6>], place: &Place<6>) -> bool {
    let Some(new) = place.found() else { return false };
    places
        .iter()
        .filter_map(Place::found)
        .any(|known| known.q.iter().zip(new.q).all(|(known, new)| wrap(known - new).abs() <= SAME))
}

impl Inverse<6> for Refined {
    fn name(&self) -> &'static str {
        match self.nominal.name() {
            "spherical wrist" => "refined spherical wrist",
            "three parallel axes" => "refined three parallel axes",
            _ => "refined",
        }
    }

    fn slot_count(&self) -> usize {
        self.nominal.slot_count()
    }

    fn slot_names(&self) -> Option<&'static [&'static str]> {
        self.nominal.slot_names()
    }

    fn between(&self, chain: &Chain<6>, limits: &JointLimits<6>) -> Arc<dyn Inverse<6>> {
        Arc::new(Self::new(&*self.nominal, self.nominal_chain.clone(), chain, limits))
    }

    /// Regular is a pose that is regular for the nominal arm, every branch of which leads to one of
    /// the calibrated arm.
    fn solve_in_lanes(&self, solutions: &mut Solutions<6>, locked: f64) -> bool {
        self.nominal.solve_in_lanes(solutions, locked) && self.refine(solutions).is_whole
    }

    fn solve_on_path(&self, solutions: &mut Solutions<6>, locked: f64) -> bool {
        self.nominal.solve_on_path(solutions, locked) && self.refine(solutions).is_whole
    }

    fn solve(&self, solutions: &mut Solutions<6>, locked: f64, free: &FreeChoice<6>) {
        self.nominal.solve(solutions, locked, free);
        let outcome = self.refine(solutions);
        if !outcome.is_whole || solutions.status().iter().any(|s| s.contains(Status::MERGED)) {
            self.recover(solutions, &outcome, free);
        }
    }

    fn singular(&self, q: &[f64; 6]) -> (Option<SingularDistances>, SingularityKind) {
        self.nominal.singular(q)
    }

    fn jacobian_determinant(&self, _: &[f64; 6]) -> Option<f64> {
        None
    }

    fn slot(&self, q: &[f64; 6]) -> Option<Slot> {
        self.nominal.slot(q)
    }

    #[cfg(test)]
    fn without_lanes(&self) -> Arc<dyn Inverse<6>> {
        Arc::new(self.clone())
    }
}
